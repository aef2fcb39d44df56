/* Voronoi cells against lattices, and against points of a fine grid. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "geom/polygon.h"
#include "record/fields/voronoi.h"
#include "record_draw.h"

#define assert_near(value, wanted, within)                                                         \
    do {                                                                                           \
        double was = (value), right = (wanted);                                                    \
        if (!(fabs(was - right) <= (within)))                                                      \
            fail_msg("%s is %.9g, not %.9g", #value, was, right);                                  \
    } while (0)

static void lattice_has_known_cells(void **state) {
    (void)state;
    JoxSites sites = {0};
    JoxCell cell;
    jox_sites_clear(&sites);
    for (uint32_t i = 0; i < 400; i++)
        jox_sites_add(&sites, jox_v2(0.5f * (float)(i % 20), 0.5f * (float)(i / 20)), i);
    jox_sites_sort(&sites, 1.0);
    jox_sites_cell(&sites, 10 * 20 + 10, 1.0, &cell);
    assert_near(jox_cell_area(&cell), 0.25, 1e-9);
    /* At a corner of the lattice the cell ends at the cutoff: a quarter of the 32-gon, and a square
       and stripes towards the neighbours. */
    jox_sites_cell(&sites, 0, 1.0, &cell);
    assert_true(jox_cell_area(&cell) > 0.7 && jox_cell_area(&cell) < 1.4);
    jox_sites_clear(&sites); /* alone: half the sum of 32 triangles */
    jox_sites_add(&sites, jox_v2(3, 4), 7);
    jox_sites_sort(&sites, 1.0);
    jox_sites_cell(&sites, 0, 1.0, &cell);
    assert_near(jox_cell_area(&cell), 16 * sin(2 * 3.14159265358979 / 32), 1e-9);
    jox_sites_free(&sites);
}

/* Cells of people at random places against points of a fine grid, each assigned to the nearest
   person. */
static void cell_is_nearest_part_of_plane(void **state) {
    (void)state;
    enum { PEOPLE = 60, FINE = 400 };
    const double side = 5.0, step = side / FINE, cutoff = 0.8;
    static const JoxV2 L[] = {{1, 1},       {4, 1},    {4, 2.5f},
                              {2.2f, 2.5f}, {2.2f, 4}, {1, 4}}; /* an L */
    JoxSites sites = {0};
    double areas[PEOPLE] = {0}, within[PEOPLE] = {0};
    for (uint32_t i = 0; i < PEOPLE; i++)
        jox_sites_add(&sites,
                      jox_v2((float)(side * draw_from_counter(2 * i + 1)),
                             (float)(side * draw_from_counter(2 * i + 2))),
                      i);
    jox_sites_sort(&sites, cutoff);
    for (int r = -FINE / 5; r < FINE + FINE / 5; r++)
        for (int c = -FINE / 5; c < FINE + FINE / 5; c++) {
            double x = (c + 0.5) * step, y = (r + 0.5) * step, best = INFINITY;
            uint32_t nearest = 0;
            for (uint32_t i = 0; i < PEOPLE; i++) {
                double dx = x - sites.points[i].x, dy = y - sites.points[i].y;
                if (dx * dx + dy * dy < best) {
                    best = dx * dx + dy * dy;
                    nearest = i;
                }
            }
            bool in_l = x > 1 && y > 1 && x < 4 && y < 4 && (y < 2.5 || x < 2.2);
            areas[nearest] += best < cutoff * cutoff ? step * step : 0.0;
            within[nearest] += best < cutoff * cutoff && in_l ? step * step : 0.0;
        }
    for (uint32_t i = 0; i < PEOPLE; i++) {
        JoxCell cell;
        jox_sites_cell(&sites, i, cutoff, &cell);
        /* The polygon of 32 corners has up to 0.7 % less area than the disc. */
        assert_near(jox_cell_area(&cell), areas[i], 0.02);
        assert_near(jox_cell_area_within(&cell, sites.points[i], L, 6), within[i], 0.02);
    }
    jox_sites_free(&sites);
}

/* The part of a cell seen past walls with a gap, against points of a fine grid. */
static void walls_bound_cells(void **state) {
    (void)state;
    enum { FINE = 500 };
    static const JoxV2 BOX[] = {{-0.6f, -0.5f}, {0.7f, -0.5f}, {0.7f, 0.9f}, {-0.6f, 0.9f}};
    static struct JoxBar walls[] = {{{-2, 0.3f}, {-0.1f, 0.3f}},    {{0.2f, 0.3f}, {2, 0.3f}},
                                    {{0.2f, 0.3f}, {0.2f, 0.6f}},   {{-0.4f, -2}, {-0.5f, 2}},
                                    {{0.3f, -0.4f}, {0.9f, -0.4f}}, {{0.4f, -0.6f}, {0.5f, -0.1f}}};
    const JoxBars bars = {walls, sizeof walls / sizeof *walls, 0};
    for (uint32_t n = 0; n < 12; n++) {
        JoxV2 at = {(float)(0.6 * draw_from_counter(3 * n) - 0.3),
                    (float)(0.5 * draw_from_counter(3 * n + 1) - 0.25)};
        JoxCell cell;
        double whole, within, seen = 0.0, seen_within = 0.0, step = 2.0 / FINE;
        jox_cell_begin(&cell, 1.0);
        jox_cell_cut(&cell, 0.9, 0.3);
        jox_cell_cut(&cell, -0.3, -1.1);
        jox_cell_visible_area(&cell, at, &bars, BOX, 4, &whole, &within);
        for (int r = 0; r < FINE; r++)
            for (int c = 0; c < FINE; c++) {
                double x = (c + 0.5) * step - 1, y = (r + 0.5) * step - 1;
                bool inside = true, blocked = false;
                for (uint32_t k = 0; k < cell.count && inside; k++) {
                    uint32_t m = k + 1 < cell.count ? k + 1 : 0;
                    inside = (cell.x[m] - cell.x[k]) * (y - cell.y[k]) >=
                             (cell.y[m] - cell.y[k]) * (x - cell.x[k]);
                }
                JoxV2 there = {at.x + (float)x, at.y + (float)y};
                for (uint32_t b = 0; b < bars.count && inside && !blocked; b++)
                    blocked = jox_segment_crossing(walls[b].from, walls[b].to, at, there) != 0;
                bool in_box =
                    there.x > -0.6f && there.x < 0.7f && there.y > -0.5f && there.y < 0.9f;
                seen += inside && !blocked ? step * step : 0.0;
                seen_within += inside && !blocked && in_box ? step * step : 0.0;
            }
        assert_true(seen > 0.05);
        assert_near(whole, seen, 0.01);
        assert_near(within, seen_within, 0.01);
    }
}

/* A corridor 1 m wide has a person every half metre; people behind its walls are no neighbours. */
static void person_behind_wall_is_no_neighbour(void **state) {
    (void)state;
    static struct JoxBar walls[] = {{{-9, 0}, {9, 0}}, {{-9, 1}, {9, 1}}};
    const JoxBars bars = {walls, 2, 0};
    const JoxV2 all[] = {{-20, -20}, {20, -20}, {20, 20}, {-20, 20}};
    JoxSites sites = {0};
    JoxCell cell;
    double whole, within;
    for (int i = -8; i <= 8; i++) {
        jox_sites_add(&sites, jox_v2(0.5f * (float)i, 0.5f), 0);
        jox_sites_add(&sites, jox_v2(0.5f * (float)i, -0.1f), 1);
        jox_sites_add(&sites, jox_v2(0.5f * (float)i, 1.1f), 2);
    }
    jox_sites_sort(&sites, 1.0);
    for (int with = 0; with < 2; with++) {
        sites.bars = with ? &bars : NULL;
        jox_sites_cell(&sites, 3 * 8, 1.0, &cell);
        jox_cell_visible_area(&cell, sites.points[3 * 8], &bars, all, 4, &whole, &within);
        assert_near(whole, with ? 0.5 : 0.3, 1e-6);
    }
    jox_sites_free(&sites);
}

/* Sites at one point, and sites denser than people can stand, are searched in smaller bins; their
   cells must equal those cut by all other sites. */
static void crowded_cells_are_cut_by_all_sites(void **state) {
    (void)state;
    enum { HEAP = 3000, APART = 40 };
    const double cutoff = 1.0, sizes[] = {0.0, 1e-4, 0.3, 3.0};
    for (int k = 0; k < 4; k++) {
        JoxSites sites = {0};
        for (uint32_t i = 0; i < HEAP + APART; i++) {
            const double size = i < HEAP ? sizes[k] : 6.0;
            jox_sites_add(&sites,
                          jox_v2((float)(size * draw_from_counter(2 * i + 1)),
                                 (float)(size * draw_from_counter(2 * i + 2))),
                          i);
        }
        jox_sites_sort(&sites, cutoff);
        assert_true(k > 0 ||
                    sites.first[sites.columns * sites.rows] == APART + 1); /* distinct points */
        for (uint32_t i = 0; i < HEAP + APART; i += i < HEAP ? 97 : 1) {
            JoxCell cell, wanted;
            jox_cell_begin(&wanted, cutoff);
            for (uint32_t o = 0; o < HEAP + APART; o++)
                jox_cell_cut(&wanted, (double)sites.points[o].x - sites.points[i].x,
                             (double)sites.points[o].y - sites.points[i].y);
            jox_sites_cell(&sites, i, cutoff, &cell);
            assert_near(jox_cell_area(&cell), jox_cell_area(&wanted), 1e-9);
        }
        jox_sites_free(&sites);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lattice_has_known_cells), cmocka_unit_test(cell_is_nearest_part_of_plane),
        cmocka_unit_test(crowded_cells_are_cut_by_all_sites), cmocka_unit_test(walls_bound_cells),
        cmocka_unit_test(person_behind_wall_is_no_neighbour)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
