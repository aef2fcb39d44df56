/* Filling areas: exact counts, spacing, walls kept clear, the same for the same seed. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/mem.h"
#include "geom/fill.h"

static void counts_and_spacing_are_kept(void **state) {
    (void)state;
    JoxV2 square[] = {{0, 0}, {20, 0}, {20, 20}, {0, 20}};
    JoxV2 pillar[] = {{8, 8}, {12, 8}, {12, 12}, {8, 12}};
    JoxPlace place = {.kind = JOX_PLACE_POLYGON, .points = square, .count = 4, .start = -1};
    JoxWalls walls = {0};
    jox_walls_add_solid(&walls, pillar, 4, INFINITY);
    uint32_t in = 0;
    JoxArea area = {&place, &in, NULL, 1, 0, &walls, 0.2f};
    assert_true(fabs(jox_area_size(&area) - (400 - 19.2)) < 4);
    for (int spread = 0; spread <= JOX_FILL_RANDOM; spread++) {
        JoxV2 *p, *q;
        assert_int_equal(jox_fill(&area, (JoxFillMode)spread, 300, 0.6f, 7, 1, &p), 300);
        assert_int_equal(jox_fill(&area, (JoxFillMode)spread, 300, 0.6f, 7, 1, &q), 300);
        assert_memory_equal(p, q, 300 * sizeof *p);
        for (int i = 0; i < 300; i++) {
            assert_false(p[i].x > 7.8f && p[i].x < 12.2f && p[i].y > 7.99f && p[i].y < 12.01f);
            for (int j = 0; j < i; j++)
                assert_true(jox_length(jox_sub(p[i], p[j])) > 0.599f);
        }
        jox_free(p), jox_free(q);
        assert_int_equal(jox_fill(&area, (JoxFillMode)spread, 1500, 0, 7, 1, &p), 1500);
        jox_free(p);
        assert_true(jox_fill(&area, (JoxFillMode)spread, 100000, 0.6f, 7, 1, &p) < 1400);
        jox_free(p);
    }
    jox_walls_free(&walls);
}

/* A lattice as wide as one agent's share of a corridor may miss it with every point. */
static void few_fit_wherever_there_is_room(void **state) {
    (void)state;
    JoxV2 corridors[3][4] = {{{0, 0}, {40, 0}, {40, 1}, {0, 1}},
                             {{0, 0}, {1, 0}, {1, 40}, {0, 40}},
                             {{0, 0}, {0.3f, 0}, {0.3f, 0.3f}, {0, 0.3f}}};
    for (int c = 0; c < 3; c++) {
        JoxPlace place = {
            .kind = JOX_PLACE_POLYGON, .points = corridors[c], .count = 4, .start = -1};
        uint32_t in = 0;
        JoxArea area = {&place, &in, NULL, 1, 0, NULL, 0.2f};
        for (int spread = 0; spread <= JOX_FILL_RANDOM; spread++)
            for (uint32_t count = 1; count <= (c < 2 ? 3 : 1); count++) {
                JoxV2 *p;
                assert_int_equal(jox_fill(&area, (JoxFillMode)spread, count, 0, 7, 1, &p), count);
                for (uint32_t i = 0; i < count; i++)
                    assert_true(jox_place_contains(&place, 0, p[i]));
                jox_free(p);
                assert_int_equal(jox_fill(&area, (JoxFillMode)spread, 1, 1.0f, 7, 1, &p), 1);
                jox_free(p);
            }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(counts_and_spacing_are_kept),
                                       cmocka_unit_test(few_fit_wherever_there_is_room)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
