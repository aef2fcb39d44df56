/* The density by packets of people, strips of rows and steps of reached cells, compared bit by bit
   with plain loops, for the kernels of each instruction set. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/mem.h"
#include "base/number/elementary.h"
#include "record/fields/density_parts.h"
#include "record_draw.h"

enum { PEOPLE = 403, FIELDS = JOX_DENSITY_FIELDS };

typedef struct Crowd {
    float x[PEOPLE], y[PEOPLE], weights[2][PEOPLE];
    uint8_t seen[PEOPLE];
} Crowd;

/* Draws people in 0..wide by 0..high and a little outside; each seventh in the middle of a cell,
   and two with positions that are NAN or huge. */
static JoxDensityCrowd draw_density_crowd(Crowd *c, const JoxDensity *d, float wide, float high,
                                          uint32_t count) {
    uint32_t chance = count;
    for (uint32_t i = 0; i < count; i++) {
        c->x[i] = wide * (1.04f * draw_uniform(&chance) - 0.02f);
        c->y[i] = high * (1.04f * draw_uniform(&chance) - 0.02f);
        if (i % 7 == 0) {
            c->x[i] = (floorf(c->x[i] / d->cell) + 0.5f) * d->cell;
            c->y[i] = (floorf(c->y[i] / d->cell) + 0.5f) * d->cell;
        }
        c->weights[0][i] = 3.0f * draw_uniform(&chance) - 1.5f;
        c->weights[1][i] = 3.0f * draw_uniform(&chance) - 1.5f;
        c->seen[i] = draw_uniform(&chance) < 0.8f;
    }
    if (count > 10) {
        c->x[8] = NAN;
        c->y[9] = 1e30f;
    }
    return (JoxDensityCrowd){.count = count,
                             .x = c->x,
                             .y = c->y,
                             .seen = c->seen,
                             .weights = {NULL, c->weights[0], c->weights[1]}};
}

/* Adds people one by one to the nodes of all rows. */
static void put_one_by_one(const JoxDensity *d, const JoxDensityCrowd *crowd,
                           float *const mass[FIELDS]) {
    const int across = crowd->period.x > 0.0f, up = crowd->period.y > 0.0f;
    for (uint32_t i = 0; i < crowd->count; i++)
        for (int c = -across; c <= across; c++)
            for (int r = -up; r <= up; r++) {
                uint32_t nodes[4];
                float shares[4];
                const int count = jox_density_share_person(
                    d, crowd->x[i] + (float)c * crowd->period.x,
                    crowd->y[i] + (float)r * crowd->period.y, nodes, shares);
                for (int k = 0; k < count && crowd->seen[i]; k++)
                    for (int f = 0; f < FIELDS; f++)
                        mass[f][nodes[k]] +=
                            shares[k] * (crowd->weights[f] ? crowd->weights[f][i] : 1.0f);
            }
}

static void assert_equal_bits(const float *got, const float *expected, size_t count, JoIsa isa) {
    for (size_t c = 0; c < count; c++)
        if (got[c] != expected[c])
            fail_msg("%s: %zu of %zu is %.9g, not %.9g", jox_isa_name(isa), c, count,
                     (double)got[c], (double)expected[c]);
}

static size_t count_grid_cells(const JoxDensity *d) {
    return (size_t)d->wide * (size_t)d->high;
}

static void alloc_fields(float *fields[FIELDS], size_t cells) {
    for (int f = 0; f < FIELDS; f++)
        fields[f] = jox_alloc(cells, sizeof(float));
}
static void free_fields(float *fields[FIELDS]) {
    for (int f = 0; f < FIELDS; f++)
        jox_free(fields[f]);
}

#define EACH_ISA(isa)                                                                              \
    for (JoIsa isa = JO_ISA_SCALAR; isa < (JoIsa)JOX_ISA_ROOM; isa++)                              \
        if (jox_isa_runs(isa))

/* With and without walls and periodic edges, in strips of any height. */
static void packets_put_people_as_one_by_one(void **state) {
    (void)state;
    static Crowd people;
    JoxWalls walls = {0};
    add_wall_line(&walls, -1, 12, 17, 15);
    add_wall_line(&walls, 12, 1, 12.3f, 11);
    for (int kind = 0; kind < 8; kind++) {
        const bool walled = kind & 1, sparse = kind & 2, periodic = kind & 4;
        JoxDensity *d = jox_density_create(jox_v2(0, 0), jox_v2(20, 15), 0.3f, JOX_DENSITY_KERNEL);
        JoxDensityCrowd crowd = draw_density_crowd(&people, d, 20, 15, sparse ? 5 : PEOPLE);
        crowd.period = periodic ? jox_v2(20, 15) : jox_v2(0, 0);
        jox_density_walls(d, walled ? &walls : NULL);
        float *plain[FIELDS];
        alloc_fields(plain, count_grid_cells(d));
        put_one_by_one(d, &crowd, plain);
        EACH_ISA(isa) {
            d->isa = isa;
            for (int rows = walled ? d->high : 1; rows <= d->high; rows = 3 * rows + 1)
                for (int first = 0; first < d->high; first += rows) {
                    const int end = first + rows < d->high ? first + rows : d->high;
                    const size_t from = (size_t)first * (size_t)d->wide;
                    jox_density_clear_strip(d, FIELDS, first, end);
                    jox_density_put_crowd(d, &crowd);
                    for (int f = 0; f < FIELDS; f++)
                        assert_equal_bits(d->work.mass[f], plain[f] + from,
                                          (size_t)(end - first) * (size_t)d->wide, isa);
                }
        }
        free_fields(plain);
        jox_density_free(d);
    }
    jox_walls_free(&walls);
}

/* Spreads all cells by the Gaussian, along x, then along y, adding in order. */
static void spread_all_cells(const JoxDensity *d, const float *mass, float *out) {
    const double v = (double)jox_density_variance(d);
    const int reach = (int)(3.0f * sqrtf((float)v) + 1.0f), wide = d->wide;
    float *taps = jox_alloc((size_t)reach + 1, sizeof *taps);
    float *along = jox_alloc(count_grid_cells(d), sizeof *along);
    double whole = 0.0;
    for (int k = 0; k <= reach; k++) {
        taps[k] = (float)jox_exp(-0.5 * k * k / v);
        whole += (k ? 2.0 : 1.0) * (double)taps[k];
    }
    for (int k = 0; k <= reach; k++)
        taps[k] /= (float)whole;
    for (int row = 0; row < d->high; row++)
        for (int c = reach; c < wide - reach; c++)
            for (int k = -reach; k <= reach; k++)
                along[row * wide + c] += taps[abs(k)] * mass[row * wide + c - k];
    for (int row = 0; row < (int)d->rows; row++)
        for (int c = 0; c < (int)d->columns; c++) {
            float sum = 0.0f;
            for (int k = -reach; k <= reach; k++)
                sum += taps[abs(k)] * along[(row + d->edge + k) * wide + c + d->edge];
            out[row * (int)d->columns + c] = sum * (1.0f / (d->cell * d->cell));
        }
    jox_free(along);
    jox_free(taps);
}

/* Small floors, and floors of several strips; few people, and many. */
static void strips_spread_like_whole_grid(void **state) {
    (void)state;
    static const JoxV2 SIZES[] = {{1.2f, 1.1f}, {9.0f, 30.0f}, {620.0f, 40.0f}, {30.0f, 1300.0f}};
    static Crowd people;
    for (size_t size = 0; size < sizeof SIZES / sizeof *SIZES; size++)
        for (uint32_t count = 3; count <= PEOPLE; count += 400) {
            JoxDensity *d = jox_density_create(jox_v2(0, 0), SIZES[size], 0.2f, JOX_DENSITY_KERNEL);
            const JoxDensityCrowd crowd =
                draw_density_crowd(&people, d, SIZES[size].x, SIZES[size].y, count);
            const size_t read = (size_t)d->columns * d->rows;
            float *mass[FIELDS], *plain[FIELDS], *got[FIELDS];
            alloc_fields(mass, count_grid_cells(d));
            alloc_fields(plain, read);
            alloc_fields(got, read);
            put_one_by_one(d, &crowd, mass);
            for (int f = 0; f < FIELDS; f++)
                spread_all_cells(d, mass[f], plain[f]);
            EACH_ISA(isa) {
                d->isa = isa;
                for (int f = 0; f < FIELDS; f++) /* shows that each value is written */
                    memset(got[f], 0xff, read * sizeof(float));
                jox_density_sample(d, &crowd, FIELDS, got);
                for (int f = 0; f < FIELDS; f++)
                    assert_equal_bits(got[f], plain[f], read, isa);
            }
            free_fields(mass);
            free_fields(plain);
            free_fields(got);
            jox_density_free(d);
        }
}

/* Steps each cell with the formula of a mixed cell. */
static void step_all_cells(const JoxDensity *d, float share, const float *u, float *out) {
    const JoxDensityFloor *f = d->floor;
    const int wide = d->wide;
    for (int c = wide + 1; c < wide * (d->high - 1) - 1; c++)
        out[c] =
            u[c] +
            share * f->per[c] *
                (f->open_x[c] * (u[c + 1] - u[c]) - f->open_x[c - 1] * (u[c] - u[c - 1]) +
                 f->open_y[c] * (u[c + wide] - u[c]) - f->open_y[c - wide] * (u[c] - u[c - wide]));
    for (uint32_t s = 0; s < f->slant_count; s++) {
        const struct JoxDensitySlant *slant = &f->slants[s];
        const float moved = share * slant->open * (u[slant->b] - u[slant->a]);
        out[slant->a] += f->per[slant->a] * moved;
        out[slant->b] -= f->per[slant->b] * moved;
    }
}

/* Asserts that the steps of a sample equal steps over all cells, for each instruction set. */
static void assert_steps_equal(JoxDensity *d, const JoxDensityCrowd *crowd) {
    const size_t cells = count_grid_cells(d);
    const float whole = 0.5f * jox_density_variance(d);
    const int steps = (int)ceilf(whole / JOX_DENSITY_SHARE);
    float *mass[FIELDS];
    alloc_fields(mass, cells);
    put_one_by_one(d, crowd, mass);
    for (int f = 0; f < FIELDS; f++) {
        float *next = jox_alloc(cells, sizeof *next);
        for (size_t c = 0; c < cells; c++)
            mass[f][c] *= d->floor->per[c];
        for (int s = 0; s < steps; s++) {
            step_all_cells(d, whole / (float)steps, mass[f], next);
            float *swap = mass[f];
            mass[f] = next;
            next = swap;
        }
        jox_free(next);
    }
    EACH_ISA(isa) {
        d->isa = isa;
        jox_density_clear_strip(d, FIELDS, 0, d->high);
        jox_density_put_crowd(d, crowd);
        for (int f = 0; f < FIELDS; f++) {
            jox_density_diffuse(d, f);
            assert_equal_bits(d->work.mass[f], mass[f], cells, isa);
        }
    }
    free_fields(mass);
}

/* Among walls in all directions, posts, oblique ways between them, and runs of open floor. */
static void steps_of_reached_cells_equal_all_steps(void **state) {
    (void)state;
    static Crowd people;
    uint32_t slants = 0, plain = 0, runs = 0, chance = 3;
    for (int plan = 0; plan < 6; plan++) {
        JoxWalls walls = {0};
        for (int w = 0; w < 12; w++) {
            const float x = 20 * draw_uniform(&chance), y = 14 * draw_uniform(&chance);
            add_wall_line(&walls, x, y, x + 6 * draw_uniform(&chance) - 3,
                          y + 6 * draw_uniform(&chance) - 3);
            const JoxV2 post[] = {{y, x}, {y + 0.35f, x + 0.1f}, {y + 0.2f, x + 0.45f}};
            jox_walls_add_solid(&walls, post, 3, 3);
        }
        for (float cell = 0.2f; cell < 0.41f; cell += 0.1f) {
            JoxDensity *d =
                jox_density_create(jox_v2(0, 0), jox_v2(20, 14), cell, JOX_DENSITY_KERNEL);
            jox_density_walls(d, &walls);
            slants += d->floor->slant_count;
            runs += d->floor->run_count;
            for (uint32_t r = 0; r < d->floor->run_count; r++)
                plain += d->floor->runs[r].plain;
            for (uint32_t count = 1; count <= PEOPLE; count = count * 20 + 3) {
                const JoxDensityCrowd crowd = draw_density_crowd(&people, d, 20, 14, count);
                assert_steps_equal(d, &crowd);
            }
            jox_density_free(d);
        }
        jox_walls_free(&walls);
    }
    assert_in_range(slants, 30, UINT32_MAX);
    assert_in_range(plain, runs / 4, runs - runs / 4);
}

/* Means are kept only if wanted. The saved format is the same, and a restored density equals the
   saved one. */
static void means_are_kept_if_wanted(void **state) {
    (void)state;
    const float x[] = {1, 2, 3}, y[] = {1, 1, 1};
    for (int wanted = 0; wanted < 2; wanted++) {
        JoxDensity *d = jox_density_create(jox_v2(0, 0), jox_v2(4, 2), 0.2f, JOX_DENSITY_KERNEL);
        JoxDensity *other =
            jox_density_create(jox_v2(0, 0), jox_v2(4, 2), 0.2f, JOX_DENSITY_KERNEL);
        JoxText saved = {0};
        if (wanted)
            jox_density_want_mean(d);
        jox_density_add(d, jox_v2(0, 0), x, y, 3, 0.5);
        jox_density_add(d, jox_v2(0, 0), x, y, 1, 1.0);
        assert_int_equal(d->frames, wanted ? 2 : 0);
        assert_true((jox_density_mean(d, 5, 5) > 0.1) == (wanted == 1));
        JoxSections out = jox_sections_save(&saved);
        jox_density_sections(d, &out);
        assert_true(jox_sections_end(&out));
        JoxSections in = jox_sections_restore(saved.data, saved.length);
        jox_density_sections(other, &in);
        assert_true(jox_sections_end(&in));
        assert_true((d->sum != NULL) == wanted && (other->sum != NULL) == wanted);
        assert_true(other->most == d->most && other->most_time == 0.5);
        for (uint32_t c = 0; c < d->columns; c++)
            assert_true(jox_density_mean(other, c, 5) == jox_density_mean(d, c, 5));
        jox_text_free(&saved);
        jox_density_free(d);
        jox_density_free(other);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(packets_put_people_as_one_by_one),
        cmocka_unit_test(strips_spread_like_whole_grid),
        cmocka_unit_test(steps_of_reached_cells_equal_all_steps),
        cmocka_unit_test(means_are_kept_if_wanted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
