/* Levels of service, lines, congestion and loads on walls, in crowds whose figures are computed by
   hand. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "record/danger/danger_parts.h"

enum { MOST = 400 };
static const double DT = 0.1; /* s */

static struct {
    uint32_t count, key[MOST];
    float x[MOST], y[MOST], vx[MOST], vy[MOST];
    JoxWalls walls;
    JoxWallLoad loads[3];
    uint32_t load_count;
    JoxV2 period;
} crowd;

/* Creates danger on a floor of 20 m x 20 m with a line of 2 m at x = 10, crossed forward to the
   east. */
static JoxDanger *create_danger_with_door(uint32_t count) {
    memset(&crowd, 0, sizeof crowd);
    crowd.count = count;
    for (uint32_t i = 0; i < MOST; i++)
        crowd.key[i] = i;
    JoxDanger *danger = jox_danger_create((JoxV2){0, 0}, (JoxV2){20, 20}, NULL);
    jox_danger_add_line(danger, "door", (JoxV2){10, 11}, (JoxV2){10, 9});
    jox_danger_add_line(danger, "again", (JoxV2){10, 11}, (JoxV2){10, 9});
    assert_int_equal(danger->lines.count, 1);
    return danger;
}

static void show_door_frame(JoxDanger *danger, double t) {
    const JoxFrame frame = {.time = t,
                            .count = crowd.count,
                            .period = crowd.period,
                            .keys = MOST,
                            .key = crowd.key,
                            .x = crowd.x,
                            .y = crowd.y,
                            .vx = crowd.vx,
                            .vy = crowd.vy,
                            .walls = &crowd.walls,
                            .wall_loads = crowd.load_count ? crowd.loads : NULL,
                            .wall_load_count = crowd.load_count};
    jox_danger_frame(danger, &frame, NULL);
}

/* Places a block at rest, 6.25 people per m2, whose east side is 0.3 m before the line. */
static void place_block(uint32_t from, uint32_t count) {
    for (uint32_t k = 0; k < count; k++) {
        crowd.x[from + k] = 9.7f - 0.4f * (float)(k / 6);
        crowd.y[from + k] = 9.0f + 0.4f * (float)(k % 6);
    }
}

static void levels_have_fruins_edges(void **state) {
    (void)state;
    const double areas[] = {1.22, 1.20, 0.92, 0.64, 0.27, 0.18};
    for (int k = 0; k < JOX_LEVELS; k++)
        assert_int_equal(jox_level_of_queue(1.0 / areas[k]), k);
    assert_int_equal(jox_level_of_queue(0.0), 0);
    const double flows[] = {22, 32, 48, 65, 81, 83}; /* per m min, at low density */
    for (int k = 0; k < JOX_LEVELS; k++)
        assert_int_equal(jox_level_of_walkway(flows[k] / 60.0, 0.1), k);
    /* Without flow, the level follows from the area per person. */
    assert_int_equal(jox_level_of_walkway(0.0, 1.0 / 0.94), 0);
    assert_int_equal(jox_level_of_walkway(0.0, 1.0 / 0.92), 4);
    assert_int_equal(jox_level_of_walkway(0.0, 1.0 / 0.45), 5);
    assert_int_equal(jox_level_of_walkway(1.2, 1.0 / 0.45), 5);
    assert_int_equal(jox_level_of_walkway(0.0, NAN), 0); /* there is nobody */
}

/* A person every 1.25 s, at 1 m/s, through a line of 2 m: 0.4 per m s, 24 per m min. */
static void flow_counts_passages(void **state) {
    (void)state;
    JoxDanger *danger = create_danger_with_door(16);
    for (uint32_t i = 0; i < crowd.count; i++)
        crowd.y[i] = 10.0f;
    crowd.period.x = 20.0f; /* people re-enter over the periodic edge */
    for (int step = 0; step <= 400; step++) {
        for (uint32_t i = 0; i < crowd.count; i++)
            crowd.x[i] = fmodf(1.25f * (float)i + 0.1f * (float)step + 0.05f, 20.0f);
        show_door_frame(danger, DT * step);
    }
    const JoxDangerLine *line = &danger->lines.items[0];
    assert_in_range(line->forward, 31, 33); /* 40 s / 1.25 s */
    assert_int_equal(line->back, 0);
    assert_float_equal(line->flow_most, 0.4, 1e-9);
    assert_int_equal(line->rows[line->row_count - 1].side, 0);
    assert_int_equal(line->worst, 1); /* B: 24 is over 23 */
    assert_float_equal(line->level_s[1], 30.5, 0.01);
    assert_float_equal(line->stop_and_go.seconds, 0.0, 0.0);
    assert_int_equal(line->rows[19].level, -1); /* at 9.5 s: too early */
    assert_true(isnan(line->rows[19].flow) && !isnan(line->rows[20].flow));
    jox_danger_free(danger);
}

/* A person who steps to and fro over a line does not pass it, and hides no jam. */
static void stepping_back_is_no_passage(void **state) {
    (void)state;
    JoxDanger *danger = create_danger_with_door(43);
    place_block(0, 42);
    for (int step = 0; step <= 300; step++) {
        crowd.x[42] = step % 4 < 2 ? 9.9f : 10.1f;
        crowd.y[42] = 10.0f;
        show_door_frame(danger, DT * step);
    }
    const JoxDangerLine *line = &danger->lines.items[0];
    assert_true(line->forward > 60 && line->back > 60);
    assert_true(line->flow_most <= 1.0 / (10.0 * 2.0) + 1e-9);
    /* Nobody passes while it is full: from 10 s to 30 s. */
    assert_float_equal(line->stop_and_go.first, 10.0, 1e-6);
    assert_float_equal(line->stop_and_go.seconds, 20.5, 0.01);
    assert_int_equal(line->worst, JOX_LEVELS - 1);   /* although hardly anybody passes */
    assert_float_equal(line->growth_most, 0.0, 0.0); /* nobody comes */
    jox_danger_free(danger);
}

/* Returns the greatest growth of a queue that `rate` people per second join, behind a wall if
   `hidden`. */
static double measure_queue_growth(double rate, bool hidden, double *when) {
    JoxDanger *danger = create_danger_with_door(42);
    place_block(0, 42);
    if (hidden) {
        const JoxV2 wall[2] = {{6, 0}, {6, 20}};
        jox_walls_add_polyline(&crowd.walls, wall, 2, false, INFINITY);
    }
    for (int step = 0; step <= 400; step++) {
        const double t = DT * step, came = fmin(fmax(t - 15.0, 0.0), 10.0) * rate;
        for (; crowd.count < 42 + (uint32_t)(came + 1e-9); crowd.count++) {
            crowd.x[crowd.count] = 3.0f + 0.4f * (float)(crowd.count % 6);
            crowd.y[crowd.count] = 7.0f + 0.6f * (float)((crowd.count - 42) / 6);
        }
        show_door_frame(danger, t);
    }
    const double most = danger->lines.items[0].growth_most;
    *when = danger->lines.items[0].growth_most_time;
    jox_walls_free(&crowd.walls);
    jox_danger_free(danger);
    return most;
}

static void queue_grows_by_inflow_less_outflow(void **state) {
    (void)state;
    double when;
    /* 3 per s from 15 s to 25 s: the mean over ten seconds is greatest at 25 s. */
    assert_float_equal(measure_queue_growth(3.0, false, &when), 3.0, 1e-9);
    assert_float_equal(when, 25.0, 0.11);
    assert_float_equal(measure_queue_growth(1.4, false, &when), 1.4, 1e-9);
    assert_float_equal(measure_queue_growth(3.0, true, &when), 0.0, 0.0); /* out of sight */
}

/* Measures 42 people who stand still at 6.25 per m2 from `from` to `until`, are far apart at other
   times, and leave at `gone`. */
static JoxCongestionFound measure_block_congestion(double from, double until, double gone,
                                                   double end) {
    JoxDanger *danger = create_danger_with_door(42);
    for (int step = 0; step <= (int)(end / DT + 0.5); step++) {
        const double t = DT * step;
        for (uint32_t i = 0; i < 42; i++) {
            crowd.x[i] = 1.0f + 3.0f * (float)(i % 7);
            crowd.y[i] = 1.0f + 3.0f * (float)(i / 7);
        }
        if (t > from && t <= until + 1e-6)
            place_block(0, 42);
        crowd.count = t < gone - 1e-6 ? 42 : 0;
        show_door_frame(danger, t);
    }
    JoxCongestionFound found = jox_congestion_find(&danger->congestion, danger->local->grid);
    jox_danger_free(danger);
    return found;
}

/* A region above 4 per m2 for more than a tenth of the time until everybody has left is congested,
   regardless of its outflow. */
static void congestion_is_dense_for_a_tenth_of_the_time(void **state) {
    (void)state;
    JoxCongestionFound found = measure_block_congestion(5.0, 15.0, 50.0, 80.0);
    assert_true(found.known && found.cleared);
    assert_float_equal(found.time, 50.0, 1e-6);
    assert_int_equal(found.count, 1);
    assert_float_equal(found.regions[0].seconds, 10.0, 0.01);
    assert_float_equal(found.regions[0].first, 5.0, 0.01);
    assert_float_equal(found.regions[0].last, 15.0, 0.01);
    assert_true(found.regions[0].at.x > 7.0f && found.regions[0].at.x < 10.0f);
    assert_true(found.regions[0].area > 2.0 && found.regions[0].area < 6.7);
    jox_congestion_found_free(&found);
    /* 4.5 s are less than a tenth. */
    found = measure_block_congestion(5.0, 9.5, 50.0, 80.0);
    assert_true(found.known && found.count == 0);
    assert_float_equal(found.longest, 4.5, 0.01);
    jox_congestion_found_free(&found);
    /* People are still inside: a tenth of the time measured so far. */
    found = measure_block_congestion(5.0, 9.5, 99.0, 30.0);
    assert_true(found.known && !found.cleared && found.count == 1);
    assert_float_equal(found.time, 30.0, 1e-6);
    jox_congestion_found_free(&found);
    found = measure_block_congestion(1.0, 9.0, 99.0, 9.0); /* too short for a result */
    assert_true(!found.known && found.count == 0);
    jox_congestion_found_free(&found);
    found = measure_block_congestion(99.0, 99.0, 99.0, 30.0);
    assert_true(found.known && found.count == 0 && found.longest == 0.0 && isnan(found.first));
    jox_congestion_found_free(&found);
}

/* A line of 6 m across walls with a gap of 1.5 m has the width of the gap. */
static void walls_clip_lines(void **state) {
    (void)state;
    for (int k = 0; k < 3; k++) {
        JoxDanger *danger = create_danger_with_door(1);
        jox_danger_add_line(danger, "wide", (JoxV2){10, 13}, (JoxV2){10, 7});
        const JoxV2 along[2][2] = {{{10, 0}, {10, 9}}, {{10, 10.5f}, {10, 20}}};
        const JoxV2 across[2][2] = {{{0, 9}, {20, 9}}, {{20, 10.5f}, {0, 10.5f}}};
        const JoxV2 solid[2][4] = {{{9, 0}, {11, 0}, {11, 9}, {9, 9}},
                                   {{9, 10.5f}, {11, 10.5f}, {11, 20}, {9, 20}}};
        for (int side = 0; side < 2; side++)
            if (k == 2)
                jox_walls_add_solid(&crowd.walls, solid[side], 4, INFINITY);
            else
                jox_walls_add_polyline(&crowd.walls, k ? across[side] : along[side], 2, false,
                                       INFINITY);
        for (int step = 0; step <= 20; step++) { /* a step beyond the gap is no passage */
            crowd.x[0] = step % 2 ? 10.2f : 9.8f;
            crowd.y[0] = step < 10 ? 12.0f : 9.9f;
            show_door_frame(danger, DT * step);
        }
        const JoxDangerLine *line = &danger->lines.items[1];
        assert_float_equal(line->width, 1.5, 0.03);
        assert_in_range(line->forward + line->back, 10, 12);
        jox_walls_free(&crowd.walls);
        jox_danger_free(danger);
    }
}

static void people_have_levels(void **state) {
    (void)state;
    JoxDanger *danger = create_danger_with_door(2);
    crowd.x[0] = crowd.y[0] = 5.0f;
    crowd.x[1] = 15.0f, crowd.y[1] = 5.0f;
    for (int step = 0; step <= 100; step++)
        show_door_frame(danger, DT * step);
    assert_float_equal(danger->level_s[0], 20.0, 1e-6); /* two people alone for 10 s */
    const JoxDangerRow *row = &danger->rows[danger->row_count - 1];
    assert_int_equal(row->levels[0], 2);
    jox_danger_free(danger);
}

static void rails_bend_at_4500_newtons(void **state) {
    (void)state;
    JoxDanger *danger = create_danger_with_door(1);
    crowd.load_count = 2;
    crowd.loads[0] = (JoxWallLoad){.to = {0.5f, 0}};
    crowd.loads[1] = (JoxWallLoad){.from = {0.5f, 0}, .to = {1, 0}, .load = 1000.0f};
    for (int step = 0; step <= 200; step++) {
        crowd.loads[0].load = step > 50 && step <= 150 ? 6000.0f : 0.0f;
        if (step == 120) { /* a new list of loads: pieces are identified by their ends */
            JoxWallLoad first = crowd.loads[0];
            crowd.loads[0] = crowd.loads[1];
            crowd.loads[1] = first;
        }
        if (step >= 120) {
            crowd.loads[1].load = step <= 150 ? 6000.0f : 0.0f;
            crowd.loads[0].load = 1000.0f;
        }
        show_door_frame(danger, DT * step);
    }
    const JoxDangerWalls *walls = &danger->walls;
    assert_int_equal(walls->count, 2);
    assert_int_equal(walls->over, 1);
    const JoxDangerPiece *piece = &walls->items[walls->most];
    assert_float_equal(piece->from.x, 0.0, 0.0);
    assert_float_equal(piece->most, 6000.0, 1.0);
    assert_float_equal(piece->most_time, 15.0, 0.01);
    assert_float_equal(jox_danger_piece_line_load(piece), 12000.0, 2.0);
    /* The mean reaches 4500 of 6000 N after ln 4 s, and falls below it ln(4/3) s after the end. */
    assert_float_equal(piece->first, 5.0 + log(4.0), 0.11);
    assert_float_equal(piece->seconds, 10.0 - log(4.0) + log(4.0 / 3.0), 0.2);
    assert_float_equal(walls->items[1].load, 1000.0, 1.0);
    assert_float_equal(danger->rows[danger->row_count - 1].wall_most, 1000.0, 1.0);
    JoxText text = {0};
    JoxJson json = jox_json_begin(&text, 0);
    jox_json_object(&json, NULL);
    jox_danger_json(danger, &json);
    jox_json_end(&json);
    assert_non_null(strstr(text.data, "\"rail_4500\": {\"pieces\": 1, \"limit\": 4500, "));
    jox_text_free(&text);
    jox_danger_free(danger);
}

static void unknown_figures_are_null(void **state) {
    (void)state;
    JoxText text = {0};
    jox_danger_free(create_danger_with_door(1)); /* clears the crowd */
    JoxDanger *danger = jox_danger_create((JoxV2){0, 0}, (JoxV2){20, 20}, NULL);
    show_door_frame(danger, 0.0);
    JoxJson json = jox_json_begin(&text, 0);
    jox_json_object(&json, NULL);
    jox_danger_json(danger, &json);
    jox_json_end(&json);
    assert_non_null(strstr(text.data, "\"lines\": null"));
    assert_non_null(strstr(text.data, "\"walls\": null"));
    jox_text_free(&text);
    jox_danger_free(danger);
}

/* Gates of 1 m between blocks of 1 m, from wall to wall; the line extends beyond the walls. */
static void line_of_gates_is_measured_at_each(void **state) {
    (void)state;
    const JoxV2 line[2] = {{10, 14}, {10, 5}}, inner[2] = {{10, 12.5f}, {10, 6.5f}};
    const JoxV2 room[4] = {{5, 6}, {15, 6}, {15, 13}, {5, 13}};
    JoxWallOpenings openings;
    JoxWalls walls = {0};
    jox_walls_add_polyline(&walls, room, 4, true, INFINITY);
    for (int b = 0; b < 3; b++) {
        const float low = 7.0f + 2.0f * (float)b;
        const JoxV2 block[4] = {{9, low}, {11, low}, {11, low + 1}, {9, low + 1}};
        jox_walls_add_solid(&walls, block, 4, INFINITY);
    }
    jox_walls_openings(&walls, line, &openings);
    assert_int_equal(openings.count, 4); /* 6 to 7, 8 to 9, 10 to 11, 12 to 13 */
    assert_true(fabsf(openings.width - 4.0f) < 0.1f);
    assert_true(fabsf(openings.ends[0][0].y - 13.0f) < 0.02f);
    assert_true(fabsf(openings.ends[3][1].y - 6.0f) < 0.02f);
    /* An opening cut off by the end of the line is not counted: it may lead anywhere. */
    jox_walls_openings(&walls, inner, &openings);
    assert_int_equal(openings.count, 2);
    /* A closed door is no opening; a line inside one opening is measured about its middle. */
    const JoxV2 door[2] = {{10, 8.95f}, {10, 8.05f}}, shut[2] = {{10, 9}, {10, 8}};
    jox_walls_openings(&walls, door, &openings);
    assert_int_equal(openings.count, 1);
    assert_true(fabsf(openings.width - 0.9f) < 0.02f);
    jox_walls_add_polyline(&walls, shut, 2, false, INFINITY);
    jox_walls_openings(&walls, line, &openings);
    assert_int_equal(openings.count, 3);
    /* A line inside a block: nothing is left, so all of it is measured. */
    const JoxV2 within[2] = {{10, 9.9f}, {10, 9.1f}};
    jox_walls_openings(&walls, within, &openings);
    assert_true(openings.count == 1 && fabsf(openings.width - 0.8f) < 1e-5f);
    jox_walls_free(&walls);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(levels_have_fruins_edges),
        cmocka_unit_test(flow_counts_passages),
        cmocka_unit_test(stepping_back_is_no_passage),
        cmocka_unit_test(queue_grows_by_inflow_less_outflow),
        cmocka_unit_test(congestion_is_dense_for_a_tenth_of_the_time),
        cmocka_unit_test(walls_clip_lines),
        cmocka_unit_test(line_of_gates_is_measured_at_each),
        cmocka_unit_test(people_have_levels),
        cmocka_unit_test(rails_bend_at_4500_newtons),
        cmocka_unit_test(unknown_figures_are_null),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
