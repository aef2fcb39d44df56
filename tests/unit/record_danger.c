/* Danger in crowds whose figures can be computed by hand, trust in a simulation, and parts of
   pages. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "picture/html.h"
#include "record/danger/danger_parts.h"
#include "record/danger/trust.h"
#include "world/statistics.h"

enum { SIDE = 25, MOST = SIDE * SIDE };
static const float SPACING = 0.4f; /* m: 6.25 people per m2 */

/* A square of people about the centre of a floor of 20 m x 20 m. */
static struct {
    uint32_t count, key[MOST];
    float x[MOST], y[MOST], vx[MOST], vy[MOST], compression[MOST], load[MOST];
} crowd;

static JoxDanger *create_crowd_square(uint32_t side) {
    memset(&crowd, 0, sizeof crowd);
    crowd.count = side * side;
    for (uint32_t i = 0; i < crowd.count; i++) {
        crowd.key[i] = i;
        crowd.x[i] = 10.0f + SPACING * ((float)(i % side) - (float)(side - 1) / 2.0f);
        crowd.y[i] = 10.0f + SPACING * ((float)(i / side) - (float)(side - 1) / 2.0f);
    }
    return jox_danger_create((JoxV2){0, 0}, (JoxV2){20, 20}, NULL);
}

static void show_square(JoxDanger *danger, double t) {
    const JoxFrame frame = {.time = t,
                            .count = crowd.count,
                            .keys = crowd.count,
                            .key = crowd.key,
                            .x = crowd.x,
                            .y = crowd.y,
                            .vx = crowd.vx,
                            .vy = crowd.vy,
                            .compression = crowd.compression,
                            .load = crowd.load};
    jox_danger_frame(danger, &frame, NULL);
}

static int find_limit(const char *key) {
    int l = 0;
    while (strcmp(jox_danger_limits[l].key, key) != 0)
        assert_true(++l < JOX_DANGER_LIMITS);
    return l;
}

static void still_crowd_is_dense_and_calm(void **state) {
    (void)state;
    JoxDanger *danger = create_crowd_square(SIDE);
    for (int step = 0; step <= 400; step++)
        show_square(danger, 0.05 * step);
    JoxDangerMost density = jox_danger_most(danger, JOX_DANGER_DENSITY);
    assert_float_equal(density.value, 6.25, 0.15); /* 1 / spacing2 */
    JoxDangerCount five = jox_danger_count(danger, find_limit("density_5"));
    /* All but those near the border, where half of the kernel is empty: within 0.5 m of it, 5 of 25
       rows. */
    assert_in_range(five.people, 19 * 19, 23 * 23);
    assert_float_equal(five.person_s, 20.0 * five.people, 1e-6);
    assert_float_equal(five.first, 0.0, 1e-9);
    assert_int_equal(jox_danger_count(danger, find_limit("density_7")).people, 0);
    assert_true(isnan(jox_danger_count(danger, find_limit("density_7")).first));
    assert_float_equal(jox_danger_most(danger, JOX_DANGER_PRESSURE).value, 0.0, 1e-6);
    assert_int_equal(jox_danger_count(danger, find_limit("pressure_002")).people, 0);
    jox_danger_free(danger);
}

/* Returns the greatest crowd pressure of people who sway by +-a along x, two seconds each way, on
   top of a drift: the mean velocity is the drift, the variance a2. The velocity of a step is that
   at its middle. */
static double measure_sway_pressure(double a, double drift, uint32_t side) {
    JoxDanger *danger = create_crowd_square(side);
    for (int step = 0; step <= 800; step++) {
        double t = 0.05 * step, v = drift + (fmod(t + 3.975, 4.0) < 2.0 ? a : -a);
        if (step > 0)
            for (uint32_t i = 0; i < crowd.count; i++) {
                crowd.x[i] += (float)(0.05 * v);
                crowd.vx[i] = (float)v;
            }
        show_square(danger, t);
    }
    double value = jox_danger_most(danger, JOX_DANGER_PRESSURE).value;
    JoxDangerCount count = jox_danger_count(danger, find_limit("pressure_002"));
    assert_int_equal(count.people > 0, value >= 0.02);
    jox_danger_free(danger);
    return value;
}

static void pressure_is_density_times_variance_over_time(void **state) {
    (void)state;
    assert_float_equal(measure_sway_pressure(0.1, 0.0, SIDE), 6.25 * 0.01, 0.004);
    assert_float_equal(measure_sway_pressure(0.2, 0.0, SIDE), 6.25 * 0.04, 0.016);
    /* a common drift has no variance */
    assert_true(measure_sway_pressure(0.0, 0.05, SIDE) < 1e-4);
    /* three people are never dense enough */
    assert_true(isnan(measure_sway_pressure(0.5, 0.0, 2)));
}

/* Presses person 0 from 2 s to 12 s and knocks person 1 in one step. */
static JoxDangerCount press_and_knock(double dt, JoxDangerMost *most) {
    JoxDanger *danger = create_crowd_square(2);
    int steps = (int)(20.0 / dt + 0.5);
    for (int step = 0; step <= steps; step++) {
        double t = dt * step;
        crowd.load[0] = t > 2.0 + dt / 2 && t < 12.0 + dt / 2 ? 1000.0f : 0.0f;
        crowd.load[1] = step == steps / 2 ? (float)(500.0 / dt) : 0.0f;
        crowd.compression[2] = 9000.0f; /* no limit is for compression */
        show_square(danger, t);
    }
    *most = jox_danger_most(danger, JOX_DANGER_LOAD);
    JoxDangerCount count = jox_danger_count(danger, find_limit("load_623"));
    assert_int_equal(jox_danger_count(danger, find_limit("load_1112")).people, 0);
    assert_float_equal(jox_danger_most(danger, JOX_DANGER_COMPRESSION).value, 9000.0, 1.0);
    assert_float_equal(jox_danger_minutes_since(danger, count.first), (20.0 - count.first) / 60.0,
                       1e-6);
    assert_true(isnan(jox_danger_minutes_since(danger, NAN)));
    jox_danger_free(danger);
    return count;
}

static void held_load_counts_and_knock_does_not(void **state) {
    (void)state;
    /* The mean over 1 s approaches 1000 N as 1 - exp(-t), and falls as exp(-t). */
    const double up = -log(1.0 - 623.0 / 1000.0), down = log(1000.0 / 623.0);
    for (double dt = 0.0125; dt < 0.11; dt *= 2) {
        JoxDangerMost most;
        JoxDangerCount count = press_and_knock(dt, &most);
        /* The knock of 500 Ns raises the mean to 500 N at most. */
        assert_int_equal(count.people, 1);
        assert_float_equal(count.first, 2.0 + up, 1.01 * dt);
        assert_float_equal(count.person_s, 10.0 - up + down, 2.01 * dt);
        assert_float_equal(count.longest, count.person_s, 1e-9);
        assert_float_equal(count.first_at.x, crowd.x[0], 1e-6);
        assert_float_equal(most.value, 1000.0, 1.0);
        assert_float_equal(most.time, 12.0, 1.01 * dt);
    }
}

/* Returns the dose of a load borne for `seconds` and then released. */
static double measure_dose(double load, double seconds) {
    const double dt = 0.05;
    JoxDanger *danger = create_crowd_square(2);
    for (int step = 0; step <= (int)((seconds + 5.0) / dt + 0.5); step++) {
        crowd.load[3] = step > 0 && step * dt < seconds + dt / 2 ? (float)load : 0.0f;
        show_square(danger, step * dt);
    }
    double dose = jox_danger_most(danger, JOX_DANGER_DOSE).value;
    JoxDangerCount count = jox_danger_count(danger, find_limit("dose_1"));
    assert_int_equal(count.people, dose >= 1.0);
    assert_int_equal(jox_danger_count(danger, find_limit("load_623")).people, load > 623.0);
    jox_danger_free(danger);
    return dose;
}

static void dose_is_one_at_the_published_times(void **state) {
    (void)state;
    /* The rise of the mean costs the integral of 1 - (1 - exp -t)^1.739, 1.45 s; its fall gives 1 /
       1.739 = 0.58 s: 0.88 s less in all. */
    assert_float_equal(measure_dose(1112.0, 300.0 + 0.88), 1.0, 0.001);
    assert_float_equal(measure_dose(6227.0, 15.0 + 0.88), 1.0, 0.01);
    /* Between the two times, and below, the law is a line through both in logarithms: 2632 N is the
       geometric mean of the loads, 67.1 s that of the times; 623 N takes 300 s (1112 / 623)^1.739 =
       822 s. */
    assert_float_equal(measure_dose(2631.5, 67.08 + 0.88), 1.0, 0.004);
    assert_float_equal(measure_dose(622.9, 411.0 + 0.88), 0.5, 0.001);
    assert_float_equal(measure_dose(1112.0, 600.0 + 0.88), 2.0, 0.002);
}

static void recordings_without_forces_have_no_loads(void **state) {
    (void)state;
    JoxDanger *danger = create_crowd_square(3);
    const JoxFrame frame = {.time = 1.0,
                            .count = crowd.count,
                            .keys = crowd.count,
                            .key = crowd.key,
                            .x = crowd.x,
                            .y = crowd.y,
                            .vx = crowd.vx,
                            .vy = crowd.vy};
    jox_danger_frame(danger, &frame, NULL);
    JoxText text = {0};
    JoxJson json = jox_json_begin(&text, 0);
    jox_json_object(&json, NULL);
    jox_danger_json(danger, &json);
    jox_json_end(&json);
    assert_non_null(strstr(text.data, "\"compression_max\": null"));
    assert_non_null(strstr(text.data, "\"load_max\": null"));
    assert_non_null(strstr(text.data, "\"dose_max\": null"));
    assert_non_null(strstr(text.data, "\"load_1112\": {\"people\": null"));
    assert_null(strstr(text.data, "\"density_max\": null"));
    jox_text_free(&text);
    jox_danger_free(danger);
}

static void exits_count_by_name(void **state) {
    (void)state;
    JoxExits exits = {0};
    JoxText text = {0};
    jox_exits_get(&exits, "west");
    jox_exits_get(&exits, "a \"door\"")->people = 3;
    jox_exits_get(&exits, "west")->people += 2;
    exits.left = 6;
    exits.last = 12.5;
    assert_int_equal(exits.count, 2);
    JoxJson json = jox_json_begin(&text, 0);
    jox_json_object(&json, NULL);
    jox_exits_json(&exits, 0, &json);
    jox_json_end(&json);
    assert_string_equal(text.data, "{\"left\": 6, \"inside\": 0, \"last_left_s\": 12.5, "
                                   "\"clearance_s\": 12.5, \"exits\": {\"west\": "
                                   "{\"people\": 2, \"last_s\": null}, \"a \\\"door\\\"\": "
                                   "{\"people\": 3, \"last_s\": null}}}");
    text.length = 0;
    json = jox_json_begin(&text, 0);
    jox_json_object(&json, NULL);
    jox_exits_json(&exits, 53, &json); /* people are still inside */
    jox_json_end(&json);
    assert_non_null(strstr(text.data, "\"left\": 6, \"inside\": 53, \"last_left_s\": 12.5, "
                                      "\"clearance_s\": null"));
    jox_text_free(&text);
    jox_exits_free(&exits);
}

static void pages_escape_what_they_show(void **state) {
    (void)state;
    char *data = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&data, &size);
    jox_html_begin(out, "<b>&\"'\x01");
    jox_html_table(out, "a|<i>");
    jox_html_row(out);
    jox_html_cell(out, "</table>");
    jox_html_cell_number(out, NAN, "m");
    jox_html_cell_number(out, 1.25, "1/m2");
    jox_html_table_end(out);
    jox_html_picture(out, "a b\"<#.png", NULL, "x\"><script>");
    jox_html_end(out);
    fclose(out);
    assert_non_null(strstr(data, "<h1>&lt;b&gt;&amp;&quot;&#39;?</h1>"));
    assert_non_null(strstr(data, "<th>a<th>&lt;i&gt;"));
    assert_non_null(
        strstr(data, "<td>&lt;/table&gt;<td class=n>&ndash;<td class=n>1.25&nbsp;per m\xc2\xb2"));
    assert_non_null(strstr(data, "src=\"a%20b%22%3C%23.png\""));
    assert_null(strstr(data, "<script"));
    free(data);
}

/* In a lattice, the Gaussian and the Voronoi density are equal; in a knot of a few people they
   differ. Walls cut cells, and a person alone in the open is not measured. */
static void voronoi_density_is_for_one_person(void **state) {
    (void)state;
    enum { COUNT = 100 };
    uint32_t key[COUNT];
    float x[COUNT], y[COUNT], still[COUNT] = {0};
    JoxWalls walls = {0};
    const JoxV2 wall[2] = {{5.8f, 0}, {5.8f, 20}};
    for (uint32_t i = 0; i < COUNT; i++) {
        key[i] = i;
        x[i] = 6.0f + 0.4f * (float)(i % 10);
        y[i] = 6.0f + 0.4f * (float)(i / 10);
    }
    jox_walls_add_polyline(&walls, wall, 2, false, INFINITY);
    for (int walled = 0; walled < 2; walled++) {
        JoxDanger *danger = jox_danger_create((JoxV2){0, 0}, (JoxV2){20, 20}, NULL);
        const JoxFrame frame = {.count = COUNT,
                                .keys = COUNT,
                                .key = key,
                                .x = x,
                                .y = y,
                                .vx = still,
                                .vy = still,
                                .walls = walled ? &walls : NULL};
        jox_danger_frame(danger, &frame, NULL);
        assert_float_equal(danger->voronoi_density[45], 6.25, 1e-3);
        assert_float_equal(danger->gaussian_density[45], 6.25, 0.1);
        assert_true(walled ? fabsf(danger->voronoi_density[40] - 6.25f) < 1e-3f
                           : danger->voronoi_density[40] < 4.0f);
        assert_float_equal(jox_danger_most(danger, JOX_DANGER_VORONOI).value, 6.25, 1e-3);
        jox_danger_free(danger);
    }
    for (uint32_t i = 0; i < 7; i++) { /* seven people in the open, 0.4 m apart */
        x[i] = i ? 10.0f + 0.4f * cosf((float)i * 1.0471976f) : 10.0f;
        y[i] = i ? 10.0f + 0.4f * sinf((float)i * 1.0471976f) : 10.0f;
    }
    JoxDanger *danger = jox_danger_create((JoxV2){0, 0}, (JoxV2){20, 20}, NULL);
    JoxFrame frame = {.count = 7, .keys = 7, .key = key, .x = x, .y = y, .vx = still, .vy = still};
    jox_danger_frame(danger, &frame, NULL);
    assert_float_equal(jox_danger_most(danger, JOX_DANGER_VORONOI).value, 7.217, 1e-2);
    assert_true(jox_danger_most(danger, JOX_DANGER_DENSITY).value < 2.5);
    assert_int_equal(jox_danger_count(danger, find_limit("voronoi_7")).people, 1);
    jox_danger_free(danger);
    danger = jox_danger_create((JoxV2){0, 0}, (JoxV2){20, 20}, NULL);
    frame.count = 1;
    jox_danger_frame(danger, &frame, NULL);
    assert_true(isnan(jox_danger_most(danger, JOX_DANGER_VORONOI).value));
    assert_true(jox_danger_has_measure(danger, JOX_DANGER_VORONOI));
    jox_danger_free(danger);
    jox_walls_free(&walls);
}

static void distrust_names_overlap_and_density(void **state) {
    (void)state;
    JoxText text = {0};
    assert_true(jox_trust_holds(0.1, 10.0) && jox_trust_holds(NAN, NAN));
    jox_trust_append_signs(0.1, 0.02, 10.0, &text);
    assert_int_equal(text.length, 0);
    assert_false(jox_trust_holds(0.101, NAN) || jox_trust_holds(0.0, 10.1));
    jox_trust_append_signs(0.36, 0.0903, 12.7, &text);
    assert_non_null(strstr(text.data, "overlap by 36 % of their depth"));
    assert_non_null(strstr(text.data, "those that touch by 90 mm, and the density"));
    assert_non_null(strstr(text.data, "reached 12.7 per m"));
    jox_text_free(&text);
    JoxStatistics statistics = {.overlap_samples = 200};
    statistics.overlap[0] = 196;
    statistics.overlap[100] = 3; /* 10 % */
    statistics.overlap[300] = 1;
    assert_float_equal(jox_statistics_overlap_p99(&statistics), 0.1, 1e-9);
    assert_float_equal(jox_statistics_overlap_share(&statistics, 0.1), 0.02, 1e-9);
    statistics.overlap_depth[40] = 99; /* 20 mm */
    statistics.overlap_depth[80] = 1;
    statistics.overlapping = 100;
    assert_float_equal(jox_statistics_depth_p99(&statistics), 0.02, 1e-9);
    statistics.overlapping = 0;
    assert_float_equal(jox_statistics_depth_p99(&statistics), 0.0, 0);
    statistics.overlap_samples = 0;
    assert_true(isnan(jox_statistics_overlap_share(&statistics, 0.1)));
    assert_true(isnan(jox_statistics_depth_p99(&statistics)));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(voronoi_density_is_for_one_person),
        cmocka_unit_test(distrust_names_overlap_and_density),
        cmocka_unit_test(still_crowd_is_dense_and_calm),
        cmocka_unit_test(pressure_is_density_times_variance_over_time),
        cmocka_unit_test(held_load_counts_and_knock_does_not),
        cmocka_unit_test(dose_is_one_at_the_published_times),
        cmocka_unit_test(recordings_without_forces_have_no_loads),
        cmocka_unit_test(exits_count_by_name),
        cmocka_unit_test(pages_escape_what_they_show),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
