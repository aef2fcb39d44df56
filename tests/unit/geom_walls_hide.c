/* Tests jox_wall_grid_unhidden_distance2: no point within its distance is separated by a wall, and
   every instruction set gives the same result. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/number/random.h"
#include "geom/wall_grid.h"

enum { WALLS = 12, POINTS = 603, ROUNDS = 40, AIMS = 24 };

#define X(name, isa) [isa] = jox_wall_unhidden_##name,
static JoxWallUnhiddenKernel *const KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

static float draw_in_range(uint32_t round, uint32_t *drawn, double least, double most) {
    return (float)(least +
                   (most - least) * jox_random_unit(11, (*drawn)++, round, JOX_DRAW_FILL, 0));
}

/* Makes walls at any angle, some along an axis and some very short; far from the origin in some
   rounds. */
static void make_random_walls(JoxWalls *walls, uint32_t round, uint32_t *drawn, float far) {
    for (uint32_t w = 0; w < WALLS; w++) {
        const float longest = w % 4 == 3 ? 0.01f : 6.0f;
        JoxV2 line[3];
        for (int k = 0; k < 3; k++)
            line[k] = (JoxV2){far + draw_in_range(round, drawn, 0, (double)longest),
                              far + draw_in_range(round, drawn, 0, (double)longest)};
        if (w % 3 == 0)
            line[1].x = line[0].x;
        jox_walls_add_polyline(walls, line, w % 2 ? 2 : 3, false, INFINITY);
    }
}

static uint32_t expect_no_nearer_separation(const JoxWallGrid *g, uint32_t round, uint32_t *drawn,
                                            JoxV2 from, float unhidden2) {
    uint32_t beyond = 0;
    for (uint32_t k = 0; k < AIMS && unhidden2 < INFINITY; k++) {
        const float angle = draw_in_range(round, drawn, 0, 6.2831853), length = sqrtf(unhidden2);
        const JoxV2 way = {length * cosf(angle), length * sinf(angle)};
        for (float share = 0.9999f; share > 0.0f; share -= 0.3333f) {
            const JoxV2 offset = jox_scale(way, share);
            if (jox_length2(offset) < unhidden2)
                assert_false(jox_wall_grid_has_wall_between(g, from, jox_add(from, offset)));
        }
        beyond += jox_wall_grid_has_wall_between(g, from, jox_add(from, jox_scale(way, 1.5f)));
    }
    return beyond;
}

static void points_within_clear_distance_are_not_separated(void **state) {
    (void)state;
    uint32_t beyond = 0, clear = 0;
    for (uint32_t round = 0; round < ROUNDS; round++) {
        const float far = round % 4 == 0 ? 0.0f : round % 4 == 1 ? 100.0f : 3000.0f;
        JoxWalls walls = {0};
        JoxWallGrid grid = {.walls = &walls};
        uint32_t drawn = 0;
        float x[POINTS + 16] = {0}, y[POINTS + 16] = {0}, unhidden2[POINTS + 16];
        make_random_walls(&walls, round, &drawn, far);
        if (round != 7) /* without a grid: no walls */
            jox_wall_grid_fit(&grid, 1.5f);
        for (uint32_t i = 0; i < POINTS; i++) {
            x[i] = far + draw_in_range(round, &drawn, -3, 9);
            y[i] = far + draw_in_range(round, &drawn, -3, 9);
            if (i % 5 == 0) { /* on a wall */
                x[i] = walls.vertices[i % walls.count].point.x;
                y[i] = walls.vertices[i % walls.count].point.y;
            }
            const float own = jox_wall_grid_unhidden_distance2(&grid, (JoxV2){x[i], y[i]});
            clear += own > 0.01f && own < INFINITY;
            beyond += expect_no_nearer_separation(&grid, round, &drawn, (JoxV2){x[i], y[i]}, own);
        }
        for (JoIsa isa = JO_ISA_SCALAR; isa <= JO_ISA_NEON; isa++) {
            if (!jox_isa_runs(isa))
                continue;
            KERNELS[isa](&grid, x, y, POINTS, unhidden2);
            for (uint32_t i = 0; i < POINTS; i++)
                assert_true(unhidden2[i] ==
                            jox_wall_grid_unhidden_distance2(&grid, (JoxV2){x[i], y[i]}));
        }
        jox_wall_grid_free(&grid);
        jox_walls_free(&walls);
    }
    assert_true(clear > 1000 && beyond > 1000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_within_clear_distance_are_not_separated),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
