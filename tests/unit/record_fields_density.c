/* Densities against known results: integrals, even crowds, and a person between walls, whose
   density is the sum of the mirror images. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/mem.h"
#include "geom/polygon.h"
#include "record/fields/density_parts.h"
#include "record_draw.h"
#include "unit/assert_near.h"

static const double S = 0.70710678; /* m: standard deviation of the kernel with R = 1 m */
static const JoxV2 NO_PERIOD = {0, 0};

static JoxDensity *create_square_density(float low, float high, float cell) {
    return jox_density_create((JoxV2){low, low}, (JoxV2){high, high}, cell, JOX_DENSITY_KERNEL);
}

static double read_density_at(const JoxDensity *d, float x, float y) {
    size_t cell;
    assert_true(jox_density_cell_of(d, x, y, &cell));
    return d->now[cell];
}

/* Returns the number of people on the floor of the area. */
static double sum_people(const JoxDensity *d) {
    double sum = 0.0;
    for (size_t c = 0; c < (size_t)d->columns * d->rows; c++)
        sum += (double)d->now[c] * jox_density_area(d, c);
    return sum;
}

/* Returns the number of people where inside(x, y). */
static double sum_people_where(const JoxDensity *d, bool (*inside)(JoxV2)) {
    double sum = 0.0;
    for (size_t c = 0; c < (size_t)d->columns * d->rows; c++)
        if (inside(jox_density_middle(d, c)))
            sum += (double)d->now[c] * jox_density_area(d, c);
    return sum;
}

static void add_box_wall(JoxWalls *walls, float x0, float y0, float x1, float y1) {
    const JoxV2 ring[] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    jox_walls_add_polyline(walls, ring, 4, true, 3);
}

static void open_floor_has_gaussian(void **state) {
    (void)state;
    JoxWalls far = {0};
    add_wall_line(&far, -9, -9, -9, 9);
    for (int walls = 0; walls < 2; walls++)
        for (float cell = 0.2f; cell < 0.41f; cell += 0.1f) {
            JoxDensity *d = create_square_density(-10, 10, cell);
            float x = 0.13f, y = -0.08f;
            jox_density_walls(d, walls ? &far : NULL);
            jox_density_add(d, NO_PERIOD, &x, &y, 1, 0);
            for (size_t c = 0; c < (size_t)d->columns * d->rows; c++) {
                JoxV2 p = jox_density_middle(d, c);
                double d2 = (p.x - x) * (p.x - x) + (p.y - y) * (p.y - y);
                double gauss = exp(-d2) / 3.14159265358979;
                assert_near(d->now[c], gauss, 0.08 * cell * cell / 0.09);
            }
            assert_near(sum_people(d), 1.0, 1e-3);
            jox_density_free(d);
        }
    jox_walls_free(&far);
}

/* Returns the density of a person at `from` between walls at 0 and `wide`, by mirror images. */
static double density_between_walls(double x, double from, double wide) {
    double sum = 0.0;
    for (int k = -20; k <= 20; k++) {
        double a = x - from - 2 * k * wide, b = x + from - 2 * k * wide;
        sum += exp(-a * a / (2 * S * S)) + exp(-b * b / (2 * S * S));
    }
    return sum / (S * sqrt(2 * 3.14159265358979));
}
static double density_along_walls(double y) {
    return exp(-y * y / (2 * S * S)) / (S * sqrt(2 * 3.14159265358979));
}

/* Returns the variance of people along (-s, c), m2. */
static double measure_variance_along(const JoxDensity *d, float c, float s) {
    double sum = 0.0, first = 0.0, second = 0.0;
    for (size_t i = 0; i < (size_t)d->columns * d->rows; i++) {
        JoxV2 p = jox_density_middle(d, i);
        double here = (double)d->now[i] * jox_density_area(d, i), way = -s * p.x + c * p.y;
        sum += here;
        first += here * way;
        second += here * way * way;
    }
    return second / sum - first / sum * (first / sum);
}

/* A corridor 1 m wide, at different offsets to the grid, along an axis or oblique to it. */
static void narrow_corridor_has_mirror_images(void **state) {
    (void)state;
    for (float shift = 0.0f; shift < 0.41f; shift += 0.05f)
        for (float from = 0.1f; from < 0.95f; from += 0.2f)
            for (float cell = 0.2f; cell < 0.31f; cell += 0.1f)
                for (int turned = 0; turned < 2; turned++) {
                    JoxWalls walls = {0};
                    float c = turned ? 0.8f : 1.0f, s = turned ? 0.6f : 0.0f;
                    JoxDensity *d = create_square_density(-8, 8, cell);
                    for (int side = 0; side < 2; side++) {
                        float x = shift + (float)side;
                        add_wall_line(&walls, c * x + s * 7, s * x - c * 7, c * x - s * 7,
                                      s * x + c * 7);
                    }
                    float x = c * (shift + from), y = s * (shift + from);
                    jox_density_walls(d, &walls);
                    jox_density_add(d, NO_PERIOD, &x, &y, 1, 0);
                    double there = density_between_walls(from, from, 1) * density_along_walls(0);
                    assert_near(sum_people(d), 1.0, 0.01);
                    if (turned) /* oblique walls become stairs of cells, which slow the spread along
                                   them */
                        assert_in_range(1000 * d->most / there, 950, cell < 0.25f ? 1200 : 1450);
                    else
                        assert_near(d->most, there, 0.08 * there * cell * cell / 0.04);
                    assert_near(measure_variance_along(d, c, s), S * S,
                                (turned ? 0.35 : 0.04) * S * S);
                    for (float beyond = -0.6f; beyond < 1.7f; beyond += 2.2f) /* nothing outside */
                        assert_near(read_density_at(d, c * (shift + beyond), s * (shift + beyond)),
                                    0.0, 1e-9);
                    jox_density_free(d);
                    jox_walls_free(&walls);
                }
}

static bool is_right_of_wall(JoxV2 p) {
    return p.x > 0.07f;
}

/* Ten people on one side of a thin wall, one on the other, each 0.2 m from it. */
static void thin_wall_separates_its_sides(void **state) {
    (void)state;
    for (int open = 0; open < 2; open++) {
        JoxWalls all = {0}, walls = {0};
        JoxDensity *d = create_square_density(-5, 5, 0.2f);
        float x[11], y[11];
        add_wall_line(&all, 0.07f, -6, 0.07f, 6);
        jox_walls_name(&all, 0, "gate", open);
        jox_walls_standing(&walls, &all, true);
        for (int i = 0; i < 11; i++) {
            x[i] = i < 10 ? -0.13f : 0.27f;
            y[i] = 0;
        }
        jox_density_walls(d, &walls);
        jox_density_add(d, NO_PERIOD, x, y, 11, 0);
        assert_near(sum_people(d), 11.0, 0.01);
        if (!open) { /* one mirror image of each at the wall */
            double own = 1 + exp(-0.4 * 0.4);
            assert_near(read_density_at(d, -0.13f, 0), 10 * own / 3.14159265, 0.6);
            assert_near(read_density_at(d, 0.27f, 0), own / 3.14159265, 0.05);
            assert_near(sum_people_where(d, is_right_of_wall), 1.0, 0.01);
        } else {
            assert_near(read_density_at(d, -0.13f, 0), (10 + exp(-0.16)) / 3.14159265, 0.1);
            assert_near(read_density_at(d, 0.27f, 0), (1 + 10 * exp(-0.16)) / 3.14159265, 0.1);
        }
        jox_density_free(d);
        jox_walls_free(&walls);
        jox_walls_free(&all);
    }
}

/* An even crowd in a room has the same density in the middle, at walls and in corners, with thin
   walls or solids. */
static void even_crowd_is_even_up_to_walls(void **state) {
    (void)state;
    enum { SIDE = 100 }; /* 25 people per m2, so that random differences are small */
    static float x[SIDE * SIDE], y[SIDE * SIDE];
    for (int solid = 0; solid < 2; solid++)
        for (float cell = 0.2f; cell < 0.41f; cell += 0.2f) {
            const float low = 0.13f, size = 20.0f * SIDE / 500.0f;
            JoxWalls walls = {0};
            JoxDensity *d = create_square_density(-3, 8, cell);
            double least = INFINITY, most = 0;
            uint32_t chance = 7;
            if (solid) {
                for (int k = 0; k < 2; k++) {
                    float a = k ? low + size : low - 1, b = k ? low + size + 1 : low;
                    JoxV2 up[] = {{a, -1}, {b, -1}, {b, 6}, {a, 6}};
                    JoxV2 flat[] = {{-1, a}, {6, a}, {6, b}, {-1, b}};
                    jox_walls_add_solid(&walls, up, 4, 3);
                    jox_walls_add_solid(&walls, flat, 4, 3);
                }
            } else
                add_box_wall(&walls, low, low, low + size, low + size);
            for (int i = 0; i < SIDE * SIDE; i++) { /* a lattice with random offsets */
                x[i] = low + size * ((float)(i % SIDE) + draw_uniform(&chance)) / SIDE;
                y[i] = low + size * ((float)(i / SIDE) + draw_uniform(&chance)) / SIDE;
            }
            jox_density_walls(d, &walls);
            jox_density_add(d, NO_PERIOD, x, y, SIDE * SIDE, 0);
            assert_near(sum_people(d), SIDE * SIDE, 0.01 * SIDE * SIDE);
            for (float py = 0.01f; py < size; py += 0.07f)
                for (float px = 0.01f; px < size; px += 0.07f) {
                    double here = read_density_at(d, low + px, low + py);
                    least = fmin(least, here);
                    most = fmax(most, here);
                }
            double even = SIDE * SIDE / (size * size);
            assert_near(least, even, 0.03 * even);
            assert_near(most, even, 0.03 * even);
            jox_density_free(d);
            jox_walls_free(&walls);
        }
}

/* The number of people is kept in a plan of rooms, doors, posts and oblique walls. */
static void walls_keep_number_of_people(void **state) {
    (void)state;
    enum { PEOPLE = 3000 };
    static float x[PEOPLE], y[PEOPLE];
    JoxWalls walls = {0};
    const JoxV2 post[] = {{2, 2}, {2.4f, 2.1f}, {2.2f, 2.5f}};
    uint32_t chance = 3, count = 0;
    add_box_wall(&walls, 0, 0, 12, 9);
    add_wall_line(&walls, 4, 0, 4, 4);
    add_wall_line(&walls, 4, 5, 4, 9);
    add_wall_line(&walls, 4, 3, 7, 0.5f);
    add_wall_line(&walls, 6, 9, 9.3f, 3.1f);
    add_wall_line(&walls, 9.3f, 3.1f, 12, 3.3f);
    jox_walls_add_solid(&walls, post, 3, 3);
    for (int k = 0; k < PEOPLE; k++) {
        float px = 12 * draw_uniform(&chance), py = 9 * draw_uniform(&chance);
        if (px > 1.9f && px < 2.5f && py > 1.9f && py < 2.6f)
            continue;
        x[count] = px;
        y[count++] = py;
    }
    for (float cell = 0.2f; cell < 0.41f; cell += 0.1f) {
        JoxDensity *d = create_square_density(-2, 13, cell);
        jox_density_walls(d, &walls);
        jox_density_add(d, NO_PERIOD, x, y, count, 0);
        assert_near(sum_people(d), count, 0.01 * count);
        jox_density_free(d);
    }
    for (uint32_t i = 0; i < count; i += 37) { /* also for single people */
        JoxDensity *d = create_square_density(-2, 13, 0.25f);
        jox_density_walls(d, &walls);
        jox_density_add(d, NO_PERIOD, x + i, y + i, 1, 0);
        assert_near(sum_people(d), 1.0, 0.01);
        jox_density_free(d);
    }
    jox_walls_free(&walls);
}

/* Density across periodic edges, and after a gate has opened. */
static void periodic_edges_and_opened_gates(void **state) {
    (void)state;
    JoxDensity *d = create_square_density(0, 10, 0.2f);
    JoxWalls walls = {0};
    float x = 0.1f, y = 5.0f;
    jox_density_want_mean(d);
    jox_density_add(d, (JoxV2){10, 0}, &x, &y, 1, 0);
    assert_near(read_density_at(d, 9.9f, 5), exp(-0.04) / 3.14159265, 0.01);
    assert_near(sum_people(d), 1.0, 1e-3);
    add_wall_line(&walls, 5, 0, 5, 10);
    x = 4.9f;
    jox_density_walls(d, &walls);
    jox_density_add(d, NO_PERIOD, &x, &y, 1, 1);
    assert_near(read_density_at(d, 5.1f, 5), 0.0, 1e-9);
    walls.rings[0].open = true;
    jox_density_walls(d, &walls);
    jox_density_add(d, NO_PERIOD, &x, &y, 1, 2);
    assert_near(read_density_at(d, 5.1f, 5), exp(-0.04) / 3.14159265, 0.01);
    assert_int_equal(d->frames, 3);
    assert_near(d->most_time, 1.0, 0.0);
    jox_walls_free(&walls);
    jox_density_free(d);
}

/* Solids of any shape, overlapping: stars, splinters, and one whose outline crosses itself. */
static void within_agrees_with_polygon_test(void **state) {
    (void)state;
    enum { SOLIDS = 60, CORNERS = 40 };
    static JoxV2 rings[SOLIDS][CORNERS];
    uint32_t counts[SOLIDS], chance = 11, inside = 0;
    JoxWalls walls = {0};
    JoxDensity *d = create_square_density(-1, 9, 0.2f);
    for (int s = 0; s < SOLIDS; s++) {
        const JoxV2 middle = {8 * draw_uniform(&chance), 8 * draw_uniform(&chance)};
        counts[s] = s ? 3 + (uint32_t)(draw_uniform(&chance) * (CORNERS - 3)) : 5;
        for (uint32_t k = 0; k < counts[s]; k++) {
            const float angle = (s ? 1.0f : 2.0f) * 6.2831853f * (float)k / (float)counts[s];
            const float r = s ? 0.05f + draw_uniform(&chance) : 1.0f;
            rings[s][k] = jox_v2(middle.x + r * cosf(angle), middle.y + r * sinf(angle));
        }
        jox_walls_add_solid(&walls, rings[s], counts[s], 3);
    }
    JoxDensitySolids *solids = jox_density_solids_create(d, &walls);
    for (int n = 0; n < 40000; n++) {
        /* many points on each line, as nodes are, and the corners themselves */
        JoxV2 p = {-1 + 10 * draw_uniform(&chance),
                   -1 + 0.05f * floorf(200 * draw_uniform(&chance))};
        if (n % 8 == 0)
            p = rings[n / 8 % SOLIDS][n / 512 % counts[n / 8 % SOLIDS]];
        bool expected = false;
        for (uint32_t r = 0; r < walls.ring_count && !expected; r++) {
            JoxV2 *ring = jox_walls_ring_points(&walls, r);
            expected = jox_polygon_contains(ring, walls.rings[r].count, p);
            jox_free(ring);
        }
        inside += expected;
        if (jox_density_is_within_solid(solids, p) != expected)
            fail_msg("(%g, %g) is %s", (double)p.x, (double)p.y, expected ? "within" : "outside");
    }
    assert_in_range(inside, 8000, 36000);
    jox_density_solids_free(solids);
    jox_density_free(d);
    jox_walls_free(&walls);
}

/* Returns the plain sum over people, in double precision, of the shares of the four nodes around
   each. */
static double sum_kernel_over_people(const JoxDensity *d, const float *x, const float *y,
                                     const float *weight, uint32_t count, JoxV2 p) {
    const double v = S * S - d->cell * d->cell / 6.0;
    const int reach = (int)(3.0 * sqrt(v) / d->cell + 1.0);
    double whole = 0.0, sum = 0.0;
    for (int k = -reach; k <= reach; k++)
        whole += exp(-0.5 * k * k * d->cell * d->cell / v);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t nodes[4];
        float shares[4];
        const int found = jox_density_share_person(d, x[i], y[i], nodes, shares);
        for (int n = 0; n < found; n++) {
            const JoxV2 low = jox_density_corner(d);
            const double column = nodes[n] % (uint32_t)d->wide, row = nodes[n] / (uint32_t)d->wide;
            const double across = floor((p.x - low.x) / d->cell) - column;
            const double up = floor((p.y - low.y) / d->cell) - row;
            if (fabs(across) <= reach && fabs(up) <= reach)
                sum += shares[n] * weight[i] *
                       exp(-0.5 * (across * across + up * up) * d->cell * d->cell / v);
        }
    }
    return sum / (whole * whole * d->cell * d->cell);
}

/* Columns without people are skipped: no mass may be missed, in crowds from a few distant people to
   one everywhere, nor weights that cancel each other. Some people stand in the middle of a cell, so
   that only one node has a share. */
static void skipping_empty_columns_changes_nothing(void **state) {
    (void)state;
    static const uint32_t COUNTS[] = {1, 2, 7, 60};
    static const float WIDTHS[] = {3.0f, 12.5f, 30.0f};
    uint32_t seed = 101;
    for (size_t trial = 0; trial < 12; trial++) {
        const uint32_t count = COUNTS[trial % 4];
        const float wide = WIDTHS[trial / 4];
        float x[60], y[60], one[60], weight[60];
        JoxDensity *d = create_square_density(-wide, wide, 0.5f);
        float *other = jox_alloc((size_t)d->columns * d->rows, sizeof *other);
        for (uint32_t i = 0; i < count; i++) {
            x[i] = i % 2 ? x[i - 1] + d->cell : wide * (2.1f * draw_uniform(&seed) - 1.05f);
            y[i] = i % 2 ? y[i - 1] : wide * (2.1f * draw_uniform(&seed) - 1.05f);
            if (i % 4 == 0) {
                x[i] = (floorf(x[i] / d->cell) + 0.5f) * d->cell;
                y[i] = (floorf(y[i] / d->cell) + 0.5f) * d->cell;
            }
            one[i] = 1.0f;
            weight[i] = i % 2 ? -1.0f : 1.0f;
        }
        const JoxDensityCrowd crowd = {.count = count, .x = x, .y = y, .weights = {one, weight}};
        jox_density_sample(d, &crowd, 2, (float *[]){d->now, other});
        for (size_t c = 0; c < (size_t)d->columns * d->rows; c += 1 + c % 5) {
            const JoxV2 p = jox_density_middle(d, c);
            assert_near(d->now[c], sum_kernel_over_people(d, x, y, one, count, p), 1e-5);
            assert_near(other[c], sum_kernel_over_people(d, x, y, weight, count, p), 1e-5);
        }
        jox_free(other);
        jox_density_free(d);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(open_floor_has_gaussian),
        cmocka_unit_test(narrow_corridor_has_mirror_images),
        cmocka_unit_test(thin_wall_separates_its_sides),
        cmocka_unit_test(even_crowd_is_even_up_to_walls),
        cmocka_unit_test(walls_keep_number_of_people),
        cmocka_unit_test(periodic_edges_and_opened_gates),
        cmocka_unit_test(within_agrees_with_polygon_test),
        cmocka_unit_test(skipping_empty_columns_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
