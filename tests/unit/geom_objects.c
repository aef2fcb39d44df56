/* Tests the grid of bodies: an iteration yields each body nearby once, and the list of the nearest
   is correct. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/mem.h"
#include "base/number/random.h"
#include "geom/objects.h"

enum { BODIES = 300 };

static float draw_body_number(uint32_t trial, uint32_t i, uint32_t k) {
    return (float)jox_random_unit(trial, i, 0, JOX_DRAW_FILL, k);
}

/* Makes discs and boxes of many sizes; some cannot be met. */
static void make_random_bodies(JoxObject *rows, uint32_t trial) {
    float side = trial % 2 ? 10.0f : 60.0f;
    for (uint32_t i = 0; i < BODIES; i++) {
        float size = 0.1f + (i % 40 == 7 ? 12.0f : 0.9f) * draw_body_number(trial, i, 2);
        rows[i] = (JoxObject){.live = i % 11 != 3, .in_band = i % 13 != 5};
        rows[i].position = (JoxV3){side * draw_body_number(trial, i, 0),
                                   side * draw_body_number(trial, i, 1), 1.0f};
        rows[i].disc = rows[i].round = size;
        if (i % 3)
            continue;
        rows[i].footprint_count = 4;
        for (uint32_t k = 0; k < 4; k++) /* a box with its corners on the disc */
            rows[i].footprint[k] =
                jox_v2(rows[i].position.x + size * (k == 1 || k == 2 ? 0.8f : -0.8f),
                       rows[i].position.y + size * (k >= 2 ? 0.6f : -0.6f));
    }
}

static bool can_be_met(const JoxObject *o) {
    return o->live && o->in_band;
}

static void an_iteration_yields_each_body_nearby_once(void **state) {
    (void)state;
    static JoxObject rows[BODIES];
    JoxObjects objects = {.rows = rows, .count = BODIES};
    uint32_t met_in_all = 0;
    for (uint32_t trial = 0; trial < 20; trial++) {
        make_random_bodies(rows, trial);
        jox_objects_lay(&objects);
        for (uint32_t query = 0; query < 50; query++) {
            JoxV2 at = {70.0f * draw_body_number(trial, query, 3) - 5.0f,
                        70.0f * draw_body_number(trial, query, 4) - 5.0f};
            float reach = query % 5 == 0 ? 40.0f : 3.0f * draw_body_number(trial, query, 5);
            uint8_t met[BODIES] = {0};
            JoxObjectWalk walk = jox_objects_near(&objects, at, reach);
            uint32_t row;
            while (jox_objects_next(&walk, &row)) {
                assert_true(row < BODIES && can_be_met(&rows[row]));
                met[row]++;
                met_in_all++;
            }
            for (uint32_t i = 0; i < BODIES; i++) {
                assert_true(met[i] <= 1);
                if (can_be_met(&rows[i]) && jox_object_reaches(&rows[i], at, reach))
                    assert_int_equal(met[i], 1);
            }
        }
    }
    assert_true(met_in_all < 20 * 50 * BODIES / 2); /* the iteration skips most bodies */
    jox_objects_free_grid(&objects);
}

static void nearest_list_holds_the_nearest_bodies(void **state) {
    (void)state;
    static JoxObject rows[BODIES];
    JoxObjects objects = {.rows = rows, .count = BODIES};
    for (uint32_t trial = 0; trial < 40; trial++) {
        make_random_bodies(rows, trial);
        for (uint32_t i = 100; i < 110; i++) /* equally near */
            rows[i] = rows[99];
        jox_objects_lay(&objects);
        JoxV2 at = {rows[99].position.x + 0.3f, rows[99].position.y};
        JoxNearest nearest = {.most = 1 + trial % JOX_MOST_NEAREST};
        JoxObjectWalk walk = jox_objects_near(&objects, at, 200.0f);
        uint32_t row, last = 0;
        while (jox_objects_next(&walk, &row))
            jox_nearest_offer(&nearest, jox_footprint_nearest(&rows[row], at).gap, row);
        assert_int_equal(nearest.count, nearest.most);
        float worst = nearest.gaps[nearest.count - 1];
        uint32_t worst_row = nearest.rows[nearest.count - 1];
        uint8_t chosen[BODIES] = {0};
        jox_nearest_by_row(&nearest);
        for (uint32_t k = 0; k < nearest.count; k++) {
            assert_true(k == 0 || nearest.rows[k] > last);
            last = nearest.rows[k];
            chosen[last] = 1;
        }
        for (uint32_t i = 0; i < BODIES; i++) {
            if (!can_be_met(&rows[i]))
                continue;
            float gap = jox_footprint_nearest(&rows[i], at).gap;
            assert_int_equal(chosen[i], gap < worst || (gap == worst && i <= worst_row));
        }
    }
    jox_objects_free_grid(&objects);
}

static void moving_bodies_allocate_nothing(void **state) {
    (void)state;
    static JoxObject rows[BODIES];
    JoxObjects objects = {.rows = rows, .count = BODIES};
    make_random_bodies(rows, 0);
    jox_objects_lay(&objects);
    uint64_t allocations = jox_alloc_count();
    for (uint32_t trial = 1; trial < 20; trial++) {
        make_random_bodies(rows, trial);
        jox_objects_lay(&objects);
    }
    assert_int_equal(jox_alloc_count(), allocations);
    jox_objects_free_grid(&objects);
}

/* Bodies at extreme positions, huge and invalid ones: every iteration ends, and the others are
   found. */
static void extreme_bodies_are_found_or_skipped(void **state) {
    (void)state;
    JoxObject rows[8];
    for (uint32_t i = 0; i < 8; i++)
        rows[i] = (JoxObject){.live = true, .in_band = true, .disc = 0.5f, .round = 0.5f};
    JoxObjects objects = {.rows = rows};
    jox_objects_lay(&objects);
    uint32_t row;
    JoxObjectWalk walk = jox_objects_near(&objects, jox_v2(0, 0), 5.0f);
    assert_false(jox_objects_next(&walk, &row));
    objects.count = 8;
    rows[1].position.x = NAN;
    rows[2].position.y = INFINITY;
    rows[3].position.x = 9e6f;
    rows[4].disc = 5e6f;
    rows[5].position.y = -1e9f;
    rows[6].position = (JoxV3){1.0f, 1.0f, 0.0f};
    rows[7].disc = INFINITY;
    jox_objects_lay(&objects);
    const JoxV2 points[] = {{0, 0}, {NAN, 0}, {0, -INFINITY}, {1e30f, 0}, {9e6f, 0}};
    for (int p = 0; p < 5; p++) {
        uint32_t met = 0;
        walk = jox_objects_near(&objects, points[p], 1.0f);
        while (jox_objects_next(&walk, &row))
            met |= 1u << row;
        assert_int_equal(met & 0xa6, 0);
        if (p == 0)
            assert_int_equal(met & 0x51, 0x51);
        if (p == 4)
            assert_int_equal(met & 0x08, 0x08);
    }
    jox_objects_free_grid(&objects);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_iteration_yields_each_body_nearby_once),
        cmocka_unit_test(nearest_list_holds_the_nearest_bodies),
        cmocka_unit_test(moving_bodies_allocate_nothing),
        cmocka_unit_test(extreme_bodies_are_found_or_skipped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
