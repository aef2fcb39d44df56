/* Tests filling areas: exact counts, spacing, distance from walls, the same result for the same
   seed. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/mem.h"
#include "geom/place_kinds.h"
#include "geom/polygon.h"
#include "geom/start_positions.h"
#include "geom/wall_grid.h"

static void counts_and_spacing_are_kept(void **state) {
    (void)state;
    JoxV2 square[] = {{0, 0}, {20, 0}, {20, 20}, {0, 20}};
    JoxV2 pillar[] = {{8, 8}, {12, 8}, {12, 12}, {8, 12}};
    JoxPlace place = {.kind = JOX_PLACE_POLYGON, .points = square, .count = 4, .start = -1};
    JoxWalls walls = {0};
    jox_walls_add_solid(&walls, pillar, 4, INFINITY);
    uint32_t in = 0;
    JoxArea area = {.places = &place, .in = &in, .in_count = 1, .walls = &walls, .clear = 0.2f};
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

static void floor_reaches_to_walls_and_leaves_out_solids(void **state) {
    (void)state;
    JoxV2 room[] = {{0, 0}, {3, 0}, {3, 2}, {0, 2}};
    JoxV2 pillar[] = {{1, 0.5f}, {2, 0.5f}, {2, 1.5f}, {1, 1.5f}};
    JoxPlace place = {.kind = JOX_PLACE_POLYGON, .points = room, .count = 4, .start = -1};
    JoxWalls walls = {0};
    uint32_t in = 0;
    JoxArea area = {.places = &place, .in = &in, .in_count = 1, .walls = &walls, .clear = 0.2f};
    jox_walls_add_outline(&walls, room, 4, INFINITY);
    assert_float_equal(jox_area_floor(&area), 6, 0.03);
    assert_true(jox_area_size(&area) < 5); /* 2.6 x 1.6 m, which `clear` leaves */
    jox_walls_add_solid(&walls, pillar, 4, INFINITY);
    assert_float_equal(jox_area_floor(&area), 5, 0.03);
    jox_walls_free(&walls);
}

/* A lattice as wide as one agent's share of a corridor may miss the corridor with every point. */
static void few_agents_fit_into_any_narrow_area(void **state) {
    (void)state;
    JoxV2 corridors[3][4] = {{{0, 0}, {40, 0}, {40, 1}, {0, 1}},
                             {{0, 0}, {1, 0}, {1, 40}, {0, 40}},
                             {{0, 0}, {0.3f, 0}, {0.3f, 0.3f}, {0, 0.3f}}};
    for (int c = 0; c < 3; c++) {
        JoxPlace place = {
            .kind = JOX_PLACE_POLYGON, .points = corridors[c], .count = 4, .start = -1};
        jox_place_finish(&place);
        uint32_t in = 0;
        JoxArea area = {.places = &place, .in = &in, .in_count = 1, .clear = 0.2f};
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

enum { MANY = 2000 };
static JoxV2 hall_corners[] = {{0, 0}, {40, 0}, {40, 25}, {0, 25}};
static JoxPlace hall_place = {
    .kind = JOX_PLACE_POLYGON, .points = hall_corners, .count = 4, .start = -1};
static uint32_t hall_index;

static JoxArea make_hall_area(void) {
    return (JoxArea){.places = &hall_place, .in = &hall_index, .in_count = 1};
}

/* Returns the spectral power of the points for one wavelength along an axis, per point: 1 on
   average for random points, their number for a lattice of that spacing. */
static double find_power(const JoxV2 *p, uint32_t count, double length, bool y) {
    double c = 0, s = 0;
    for (uint32_t i = 0; i < count; i++) {
        const double phase = 6.283185307179586 * (double)(y ? p[i].y : p[i].x) / length;
        c += cos(phase);
        s += sin(phase);
    }
    return (c * c + s * s) / count;
}

/* With two agents per m2, over all seeds, each strip along either axis holds as many as chance
   gives, and no wavelength stands out as rows would make it. A lattice shaken by an eighth of its
   spacing yields 400 and more. */
static void random_is_uniform_along_both_axes(void **state) {
    (void)state;
    const JoxArea area = make_hall_area();
    uint32_t strips[2][10] = {{0}};
    for (uint64_t seed = 1; seed <= 5; seed++) {
        JoxV2 *p;
        assert_int_equal(jox_fill(&area, JOX_FILL_RANDOM, MANY, 0, seed, 3, &p), MANY);
        for (uint32_t i = 0; i < MANY; i++) {
            strips[0][(int)(p[i].x / 4.0f) % 10]++;
            strips[1][(int)(p[i].y / 2.5f) % 10]++;
            for (uint32_t j = 0; j < i; j++)
                assert_true(jox_length(jox_sub(p[i], p[j])) >= 0.3999f);
        }
        for (int axis = 0; axis < 2; axis++)
            for (double length = 0.3; length < 1.5; length *= 1.004) {
                const double is = find_power(p, MANY, length, axis);
                if (is > 20)
                    fail_msg("a wave of %.3g m along %c has a power of %.3g", length, "xy"[axis],
                             is);
            }
        jox_free(p);
    }
    for (int axis = 0; axis < 2; axis++)
        for (int s = 0; s < 10; s++) /* 1000 +- 4 standard deviations of chance */
            assert_in_range(strips[axis][s], 875, 1125);
}

/* Points keep their spacing from given points, and across joined edges. */
static void random_points_keep_spacing_across_joined_edges(void **state) {
    (void)state;
    JoxArea area = make_hall_area();
    JoxV2 *first, *second;
    area.period = jox_v2(40, 25);
    assert_int_equal(jox_fill(&area, JOX_FILL_RANDOM, 900, 0, 1, 1, &first), 900);
    area.taken = first;
    area.taken_count = 900;
    assert_int_equal(jox_fill(&area, JOX_FILL_RANDOM, 900, 0, 1, 1, &second), 900);
    for (uint32_t i = 0; i < 900; i++)
        for (uint32_t j = 0; j < 900; j++) {
            const JoxV2 *others[2] = {first, second};
            for (int k = 0; k < 2; k++) {
                float dx = fabsf(second[i].x - others[k][j].x),
                      dy = fabsf(second[i].y - others[k][j].y);
                dx = fminf(dx, 40 - dx), dy = fminf(dy, 25 - dy);
                if (!(k == 1 && i == j))
                    assert_true(dx * dx + dy * dy >= 0.3999f * 0.3999f);
            }
        }
    jox_free(first);
    jox_free(second);
}

/* A given spacing is kept: agents that do not fit are left out, and the search ends soon. */
static void a_given_spacing_limits_the_count(void **state) {
    (void)state;
    const JoxArea area = make_hall_area();
    JoxV2 *p;
    /* Discs placed one by one jam at a cover of 54.7 %; the hall's border adds a little. */
    const double jammed = 0.547 * 41 * 26 / (3.14159265 / 4);
    const uint32_t fit = jox_fill(&area, JOX_FILL_RANDOM, 100000, 1.0f, 1, 1, &p);
    assert_true(fit > 0.93 * jammed && fit < jammed);
    jox_free(p);
    assert_int_equal(jox_fill(&area, JOX_FILL_RANDOM, (uint32_t)(0.9 * jammed), 1.0f, 2, 1, &p),
                     (uint32_t)(0.9 * jammed));
    jox_free(p);
    assert_int_equal(jox_fill(&area, JOX_FILL_RANDOM, 7000, 0, 1, 1, &p), 7000); /* 7 per m2 */
    jox_free(p);
}

/* Testing the edges at a point's height gives the same result as testing all edges. */
static void area_index_agrees_with_all_edges(void **state) {
    (void)state;
    enum { CORNERS = 60 };
    JoxV2 corners[CORNERS];
    for (int k = 0; k < CORNERS; k++) { /* a star with rays of 4 and 10 m */
        const double angle = 6.283185307179586 * k / CORNERS;
        corners[k] = jox_scale(jox_v2((float)cos(angle), (float)sin(angle)), k % 2 ? 4 : 10);
    }
    JoxPlace star = {.kind = JOX_PLACE_POLYGON, .points = corners, .count = CORNERS, .start = -1};
    JoxWalls walls = {0};
    const JoxV2 pillar[] = {{1, 1}, {3, 1.5f}, {2, 4}}, line[] = {{-5, -5}, {0, 2}, {0, 7}};
    jox_walls_add_solid(&walls, pillar, 3, INFINITY);
    jox_walls_add_polyline(&walls, line, 3, false, INFINITY);
    const uint32_t in = 0;
    const JoxArea area = {
        .places = &star, .in = &in, .in_count = 1, .walls = &walls, .clear = 0.3f};
    JoxAreaIndex *index = jox_area_index(&area);
    uint32_t inside = 0, outside = 0;
    for (int y = -110; y <= 110; y++)
        for (int x = -110; x <= 110; x++) {
            const JoxV2 p = {0.1f * (float)x, 0.1f * (float)y};
            bool is = jox_polygon_contains(corners, CORNERS, p) && !jox_walls_contain(&walls, p);
            for (uint32_t v = 0; v < walls.count && is; v++) {
                const JoxWallVertex *from = &walls.vertices[v];
                const JoxV2 near =
                    jox_segment_nearest(from->point, walls.vertices[from->next].point, p);
                is = jox_length2(jox_sub(p, near)) >= 0.3f * 0.3f;
            }
            assert_int_equal(jox_area_contains(index, p), is);
            inside += is;
            outside += !is;
        }
    assert_true(inside > 5000 && outside > 5000);
    JoxV2 low, high;
    assert_true(jox_area_extent(&area, &low, &high));
    const double step = jox_area_sampling(low, high), w = (double)high.x - low.x,
                 h = (double)high.y - low.y, nx = floor(w / step) + 1, ny = floor(h / step) + 1;
    double hits = 0; /* the size is counted row by row: at the same points, with the same answers */
    for (double j = 0; j < ny; j++)
        for (double i = 0; i < nx; i++)
            hits += jox_area_contains(index, (JoxV2){(float)(low.x + (i + 0.5) * w / nx),
                                                     (float)(low.y + (j + 0.5) * h / ny)});
    assert_true(jox_area_size(&area) == hits / (nx * ny) * w * h);
    jox_area_index_free(index);
    jox_walls_free(&walls);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(area_index_agrees_with_all_edges),
        cmocka_unit_test(counts_and_spacing_are_kept),
        cmocka_unit_test(floor_reaches_to_walls_and_leaves_out_solids),
        cmocka_unit_test(random_is_uniform_along_both_axes),
        cmocka_unit_test(random_points_keep_spacing_across_joined_edges),
        cmocka_unit_test(a_given_spacing_limits_the_count),
        cmocka_unit_test(few_agents_fit_into_any_narrow_area)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
