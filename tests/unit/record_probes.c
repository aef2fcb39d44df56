/* Probes of crowds whose figures can be computed by hand. */
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

#include "record_crowd.h"

/* ---- flow ---- */

static const JoxV2 DOOR[] = {{0, 1}, {0, -1}}; /* +x crosses it from right to left */

static void ten_walkers_pass_a_second_apart(void **state) {
    (void)state;
    JoxProbeDef def = default_probe_def(JOX_PROBE_FLOW, DOOR, 2);
    JoxProbe *p = jox_probe_create(&def);
    reset_crowd(10);
    for (int step = 0; step <= 300; step++) { /* walker i is at the door at 5.03 + i seconds */
        double t = 0.05 * step;
        for (uint32_t i = 0; i < 10; i++)
            crowd.x[i] = (float)(1.2 * (t - 5.03 - i));
        show_crowd(p, t);
    }
    assert_near(figure_value(p, "passages"), 10, 0);
    assert_near(figure_value(p, "forward"), 10, 0);
    assert_near(figure_value(p, "back"), 0, 0);
    assert_near(figure_value(p, "first"), 5.03, 1e-4);
    assert_near(figure_value(p, "last"), 14.03, 1e-4);
    assert_near(figure_value(p, "flow"), 1, 1e-4);
    assert_near(figure_value(p, "specific_flow"), 0.5, 1e-4);
    assert_near(figure_value(p, "lapse_median"), 1, 1e-4);
    assert_near(figure_value(p, "lapse_max"), 1, 1e-4);
    /* Walls leave 0.8 m of the line: the same flow through a smaller width. */
    const JoxV2 jambs[2][2] = {{{0, -9}, {0, -0.4f}}, {{-3, 0.4f}, {3, 0.4f}}};
    for (int w = 0; w < 2; w++)
        jox_walls_add_polyline(&crowd.walls, jambs[w], 2, false, INFINITY);
    show_crowd(p, 16);
    assert_near(figure_value(p, "specific_flow"), 1 / 0.8, 0.05);
    jox_walls_free(&crowd.walls);
    jox_probe_free(p);
}

static void middle_flow_leaves_out_both_ends(void **state) {
    (void)state;
    /* 10 passages: two early, two late, and six every half second. */
    static const double AT[] = {1, 4, 10, 10.5, 11, 11.5, 12, 12.5, 18, 25};
    JoxProbeDef def = default_probe_def(JOX_PROBE_FLOW, DOOR, 2);
    JoxProbe *p = jox_probe_create(&def);
    reset_crowd(10);
    for (int step = 0; step <= 300; step++) {
        for (uint32_t i = 0; i < 10; i++)
            crowd.x[i] = (float)(0.1 * step - AT[i] + 0.001);
        show_crowd(p, 0.1 * step);
    }
    assert_near(figure_value(p, "flow"), 2, 1e-3);
    assert_near(figure_value(p, "flow_all"), 9.0 / 24, 1e-3);
    assert_near(figure_value(p, "lapse_max"), 7, 1e-3);
    jox_probe_free(p);
}

static void stepping_back_revokes_passage(void **state) {
    (void)state;
    static const float X[] = {-1, 1, -1, 1, 1};
    JoxProbeDef def = default_probe_def(JOX_PROBE_FLOW, DOOR, 2);
    JoxProbe *p = jox_probe_create(&def);
    reset_crowd(2); /* the second person passes beside the line */
    crowd.y[1] = 3;
    for (int step = 0; step < 5; step++) {
        crowd.x[0] = crowd.x[1] = X[step];
        show_crowd(p, step);
    }
    assert_near(figure_value(p, "forward"), 2, 0);
    assert_near(figure_value(p, "back"), 1, 0);
    assert_near(figure_value(p, "passages"), 1, 0);
    assert_near(figure_value(p, "first"), 2.5, 1e-6);
    jox_probe_free(p);
}

static void times_and_groups_select_people(void **state) {
    (void)state;
    const uint16_t group = 1;
    JoxProbeDef def = default_probe_def(JOX_PROBE_FLOW, DOOR, 2);
    def.from = 4;
    def.until = 8;
    def.groups = &group;
    def.group_count = 1;
    JoxProbe *p = jox_probe_create(&def);
    reset_crowd(10);
    for (int step = 0; step <= 100; step++) {
        for (uint32_t i = 0; i < 10; i++) { /* at the door at i + 0.55 s; odd ones are measured */
            crowd.x[i] = (float)(0.1 * step - i - 0.55);
            crowd.group[i] = i % 2;
        }
        show_crowd(p, 0.1 * step);
    }
    assert_near(figure_value(p, "passages"), 2, 0); /* 5 and 7 */
    jox_probe_free(p);
}

static void periodic_edge_counts_once(void **state) {
    (void)state;
    static const JoxV2 AT_EDGE[] = {{10, 1}, {10, -1}}, INSIDE[] = {{5, 1}, {5, -1}};
    for (int edge = 0; edge < 2; edge++) {
        JoxProbeDef def = default_probe_def(JOX_PROBE_FLOW, edge ? AT_EDGE : INSIDE, 2);
        JoxProbe *p = jox_probe_create(&def);
        reset_crowd(1);
        crowd.period = (JoxV2){10, 0};
        for (int step = 0; step <= 500; step++) { /* 1 m/s: five rounds */
            double way = 0.1 * step + 0.05;
            crowd.x[0] = (float)(way - 10 * floor(way / 10));
            show_crowd(p, 0.1 * step);
        }
        assert_near(figure_value(p, "forward"), 5, 0);
        assert_near(figure_value(p, "back"), 0, 0);
        assert_near(figure_value(p, "flow"), 0.1, 1e-4);
        jox_probe_free(p);
    }
}

/* ---- density ---- */

static void lattice_density_is_measured(void **state) {
    (void)state;
    static const JoxV2 SQUARE[] = {{2, 2}, {4, 2}, {4, 4}, {2, 4}};
    static const JoxV2 LOWER[] = {{0, -0.5f}, {8, -0.5f}}, UPPER[] = {{8, 0.5f}, {0, 0.5f}};
    static const JoxV2 PART[] = {{2, -0.5f}, {6, -0.5f}, {6, 0.5f}, {2, 0.5f}};
    JoxProbeDef def = default_probe_def(JOX_PROBE_MEASURE, SQUARE, 4);
    JoxProbe *p = jox_probe_create(&def);
    reset_crowd(576);
    for (uint32_t i = 0; i < 576; i++) { /* 0.25 m apart: 16 per m2, 0.5 m/s */
        crowd.x[i] = 0.25f * (float)(i % 24) + 0.125f;
        crowd.y[i] = 0.25f * (float)(i / 24) + 0.125f;
        crowd.vx[i] = 0.3f;
        crowd.vy[i] = 0.4f;
    }
    for (int step = 1; step <= 30; step++)
        show_crowd(p, 0.1 * step);
    assert_near(figure_value(p, "intervals"), 3, 0);
    assert_near(figure_value(p, "people"), 64, 0);
    assert_near(figure_value(p, "density_classical"), 16, 1e-6);
    assert_near(figure_value(p, "density"), 16, 1e-4);
    assert_near(figure_value(p, "density_p90"), 16, 1e-4);
    assert_near(figure_value(p, "speed"), 0.5, 1e-6);
    assert_near(figure_value(p, "specific_flow"), 8, 1e-4);
    jox_probe_free(p);
    /* A file of people 0.8 m apart between walls. */
    def = default_probe_def(JOX_PROBE_MEASURE, PART, 4);
    p = jox_probe_create(&def);
    reset_crowd(10);
    jox_walls_add_polyline(&crowd.walls, LOWER, 2, false, INFINITY);
    jox_walls_add_polyline(&crowd.walls, UPPER, 2, false, INFINITY);
    for (uint32_t i = 0; i < 10; i++)
        crowd.x[i] = 0.8f * (float)i + 0.4f;
    show_crowd(p, 0);
    assert_near(figure_value(p, "density"), 1.25, 1e-5);
    jox_probe_free(p);
    jox_walls_free(&crowd.walls);
}

/* Ten people pass the door at 0.55, 1.55, ... 9.55 s: the middle 60 % of them from 2.55 to 7.55 s.
   During that time two people are in the square, one of them standing; before and after it twenty
   run. */
static void area_is_measured_during_middle_passages(void **state) {
    (void)state;
    static const JoxV2 SQUARE[] = {{20, 20}, {24, 20}, {24, 24}, {20, 24}};
    for (int during = 0; during < 2; during++) {
        JoxProbeDef def = default_probe_def(JOX_PROBE_MEASURE, SQUARE, 4);
        def.during = during ? DOOR : NULL;
        def.during_count = during ? 2 : 0;
        JoxProbe *p = jox_probe_create(&def);
        reset_crowd(30);
        for (int step = 0; step <= 120; step++) {
            const double t = 0.1 * step;
            const bool within = t > 3.05 && t < 8.05; /* intervals are 1 s long */
            for (uint32_t i = 0; i < 30; i++) {
                crowd.x[i] = i < 10 ? (float)(t - i - 0.55) : 20.5f + 0.15f * (float)(i - 10);
                crowd.y[i] = i < 10 ? 0.0f : within && i >= 12 ? 40.0f : 22.0f;
                crowd.vx[i] = within ? i == 10 ? 0.02f : 0.1f : 1.0f;
            }
            show_crowd(p, t);
        }
        if (during) {
            assert_near(figure_value(p, "intervals"), 5, 0);
            assert_near(figure_value(p, "people"), 2, 1e-9);
            assert_near(figure_value(p, "speed"), 0.06, 1e-6);
            assert_near(figure_value(p, "speed_deviation"), 0.04, 1e-6);
            assert_near(figure_value(p, "standing"), 0.5, 1e-9);
        } else {
            assert_true(figure_value(p, "people") > 10 && figure_value(p, "speed") > 0.4);
        }
        jox_probe_free(p);
    }
    JoxProbeDef def =
        default_probe_def(JOX_PROBE_MEASURE, SQUARE, 4); /* nobody passes: there is no such time */
    def.during = DOOR;
    def.during_count = 2;
    JoxProbe *p = jox_probe_create(&def);
    reset_crowd(1);
    crowd.x[0] = crowd.y[0] = 22;
    for (int step = 0; step <= 50; step++)
        show_crowd(p, 0.1 * step);
    assert_near(figure_value(p, "intervals"), 0, 0);
    assert_true(isnan(figure_value(p, "density")) && isnan(figure_value(p, "standing")) &&
                isnan(figure_value(p, "speed_deviation")));
    jox_probe_free(p);
}

static void cells_reach_over_periodic_edges(void **state) {
    (void)state;
    static const JoxV2 AT_EDGE[] = {{0, 0.5f}, {2, 0.5f}, {2, 2.5f}, {0, 2.5f}};
    JoxProbeDef def = default_probe_def(JOX_PROBE_MEASURE, AT_EDGE, 4);
    JoxProbe *p = jox_probe_create(&def);
    reset_crowd(96);
    crowd.period = (JoxV2){6, 0};
    for (uint32_t i = 0; i < 96; i++) { /* half a metre apart, across the periodic edge, too */
        crowd.x[i] = 0.5f * (float)(i % 12);
        crowd.y[i] = 0.5f * (float)(i / 12) - 0.25f;
    }
    show_crowd(p, 0);
    assert_near(figure_value(p, "density"), 4, 1e-4);
    jox_probe_free(p);
}

/* ---- other probes ---- */

/* Four people queue at 1, 2, 3 and 4 s; the first is served at 5 s, the third at 6 s, the second at
   7 s, the fourth never. One of the three pairs of served people changed order. */
static void visit_is_from_state_to_state(void **state) {
    (void)state;
    JoxProbeDef def = default_probe_def(JOX_PROBE_VISIT, NULL, 0);
    JoxProbe *probe = jox_probe_create(&def);
    static const double WAITS[] = {1, 2, 3, 4}, SERVED[] = {5, 7, 6, 99};
    reset_crowd(4);
    for (int tick = 0; tick <= 80; tick++) {
        double t = tick * 0.1;
        for (int i = 0; i < 4; i++)
            crowd.state[i] = t > SERVED[i] - 1e-6 ? 2 : t > WAITS[i] - 1e-6 ? 1 : 0;
        show_crowd(probe, t);
    }
    assert_near(figure_value(probe, "passages"), 3, 0);
    assert_near(figure_value(probe, "under_way"), 1, 0);
    assert_near(figure_value(probe, "mean"), 4, 1e-6);
    assert_near(figure_value(probe, "inversions"), 1.0 / 3.0, 1e-9);
    jox_probe_free(probe);
}

static void transit_is_from_line_to_line(void **state) {
    (void)state;
    static const JoxV2 LINES[] = {{0, -1}, {0, 1}, {5, -1}, {5, 1}};
    JoxProbeDef def = default_probe_def(JOX_PROBE_TRANSIT, LINES, 4);
    JoxProbe *p = jox_probe_create(&def);
    reset_crowd(3);
    for (int step = 0; step <= 100; step++) {
        double t = 0.1 * step;
        crowd.x[0] = (float)(1.25 * t - 1);   /* 4 s */
        crowd.x[1] = (float)(1.0 * t - 0.55); /* 5 s */
        crowd.x[2] = (float)(0.3 * t - 1);    /* under way */
        show_crowd(p, t);
    }
    assert_near(figure_value(p, "passages"), 2, 0);
    assert_near(figure_value(p, "under_way"), 1, 0);
    assert_near(figure_value(p, "mean"), 4.5, 1e-4);
    assert_near(figure_value(p, "least"), 4, 1e-4);
    assert_near(figure_value(p, "greatest"), 5, 1e-4);
    jox_probe_free(p);
}

static void push_front_has_a_speed(void **state) {
    (void)state;
    static const JoxV2 ALONG[] = {{0, -1}};
    for (int along = 0; along < 2; along++) {
        JoxProbeDef def = default_probe_def(JOX_PROBE_DISPLACEMENT, ALONG, along ? 1 : 0);
        def.rest = along ? 0.5 : 0.0;
        JoxProbe *p = jox_probe_create(&def);
        reset_crowd(5);
        for (int step = 0; step <= 400; step++) {
            double t = 0.01 * step;
            /* 0.4 m apart; each moves 0.2 s after the person behind. */
            for (uint32_t i = 0; i < 5; i++) {
                double go = t - 1 - 0.2 * i, way = go < 0 ? 0 : go < 0.4 ? go : fmax(0.8 - go, 0.1);
                crowd.y[i] = (float)(2 - 0.4 * i - way);
                crowd.x[i] = t < 0.5 ? (step % 2 ? 0.01f : -0.01f) : 0.03f;
            }
            show_crowd(p, t);
        }
        assert_near(figure_value(p, "people"), 5, 0);
        assert_near(figure_value(p, "moved"), 5, 0);
        assert_near(figure_value(p, "front_speed"), 2, along ? 1e-3 : 0.05);
        if (along) {
            assert_near(figure_value(p, "peak"), 0.4, 1e-4);
            assert_near(figure_value(p, "mean"), 0.1, 1e-4);
        } else {
            assert_near(figure_value(p, "mean"), hypot(0.1, 0.04), 1e-4); /* from -1 cm to 3 cm */
        }
        jox_probe_free(p);
    }
}

static void map_density_is_the_kernel(void **state) {
    (void)state;
    JoxProbeDef def = default_probe_def(JOX_PROBE_MAP, NULL, 0);
    JoxProbe *p = jox_probe_create(&def);
    reset_crowd(2); /* two people at one place who move apart at 0.6 m/s each */
    crowd.vx[0] = 0.6f;
    crowd.vx[1] = -0.6f;
    crowd.compression[1] = 250;
    crowd.x[0] = crowd.x[1] = 0.05f;
    crowd.y[0] = crowd.y[1] = 0.05f;
    show_crowd(p, 0);
    double peak = 2 / (2 * 3.14159265358979 * 0.25);
    assert_near(figure_value(p, "density_max"), peak, 0.02 * peak);
    assert_near(figure_value(p, "density_max_x"), 0.05, 0.01);
    assert_near(figure_value(p, "speed"), 0.6, 1e-6);
    assert_true(isnan(figure_value(p, "pressure_max"))); /* a single frame has no pressure */
    assert_near(figure_value(p, "compression_max"), 250, 0);
    show_crowd(p, 0.5); /* between samples */
    show_crowd(p, 1);
    assert_near(figure_value(p, "density_mean_max"), peak, 0.02 * peak);
    assert_near(figure_value(p, "samples"), 2, 0);
    jox_probe_free(p);
}

static void turns_are_counted(void **state) {
    (void)state;
    static const JoxV2 MIDDLE[] = {{1, 2}};
    const double turn = 6.283185307179586;
    JoxProbeDef def = default_probe_def(JOX_PROBE_WINDING, MIDDLE, 1);
    JoxProbe *p = jox_probe_create(&def);
    reset_crowd(2);
    for (int step = 0; step <= 200; step++) {
        double there = step <= 100 ? -0.0125 * step : -1.25 + 0.0275 * (step - 100);
        double ways[] = {0.01625 * step, there}; /* 3.25 turns; 1.25 clockwise, then 2.75 back */
        for (uint32_t i = 0; i < 2; i++) {
            crowd.x[i] = (float)(1 + 3 * cos(turn * ways[i]));
            crowd.y[i] = (float)(2 + 3 * sin(turn * ways[i]));
        }
        show_crowd(p, 0.1 * step);
    }
    assert_near(figure_value(p, "greatest"), 3.25, 1e-4);
    assert_near(figure_value(p, "least"), 1.5, 1e-4);
    assert_near(figure_value(p, "least_running"), -1.25, 1e-4);
    assert_near(figure_value(p, "clockwise_laps"), 1, 0);
    jox_probe_free(p);
}

static void failures_are_shares(void **state) {
    (void)state;
    JoxProbeDef def = default_probe_def(JOX_PROBE_FAILURES, NULL, 0);
    JoxProbe *p = jox_probe_create(&def);
    reset_crowd(10);
    for (int step = 1; step <= 40; step++) { /* one of ten fails from 1 s to 2 s */
        crowd.failed[3] = step > 20 && step <= 40;
        crowd.failed[7] = step == 5;
        show_crowd(p, 0.05 * step);
    }
    assert_near(figure_value(p, "agent_steps"), 400, 0);
    assert_near(figure_value(p, "share"), 21.0 / 400, 1e-9);
    assert_near(figure_value(p, "peak"), 0.1, 1e-9);
    assert_near(figure_value(p, "peak_time"), 1.5, 1e-9);
    jox_probe_free(p);
}

static void lanes_have_order_parameter(void **state) {
    (void)state;
    for (int mixed = 0; mixed < 2; mixed++) {
        JoxProbeDef def = default_probe_def(JOX_PROBE_LANES, NULL, 0);
        def.low = (JoxV2){0, 0};
        def.high = (JoxV2){10, 4}; /* ten rows */
        JoxProbe *p = jox_probe_create(&def);
        reset_crowd(40);
        for (uint32_t i = 0; i < 40; i++) { /* four people in each row */
            crowd.x[i] = 1 + 2 * (float)(i % 4);
            crowd.y[i] = 0.4f * (float)(i / 4) + 0.2f;
            bool ahead = mixed ? i % 2 : i / 4 % 2;
            crowd.vx[i] = ahead ? 1.0f : -1.0f;
        }
        show_crowd(p, 0);
        assert_near(figure_value(p, "order"), mixed ? 0 : 1, 1e-9);
        assert_near(figure_value(p, "random"), 0.25, 1e-9);
        assert_near(figure_value(p, "density"), 1, 1e-6);
        assert_near(figure_value(p, "speed"), 1, 1e-6);
        crowd.vx[0] = -crowd.vx[0]; /* one of four turns round: (3 - 1)^2 / 16 for the four */
        show_crowd(p, 1);
        assert_near(figure_value(p, "order_last"), mixed ? 0.025 : 0.925, 1e-9);
        jox_probe_free(p);
    }
}

/* ---- bodies ---- */

/* Sets a body's rotation to a turn of `yaw` and then a tilt about the x axis, degrees. */
static void rotate_object(JoxObject *object, double yaw, double tilt) {
    const double a = yaw * 3.14159265358979 / 360, b = tilt * 3.14159265358979 / 360;
    const double turn[4] = {sin(b) * cos(a), -sin(b) * sin(a), cos(b) * sin(a), cos(b) * cos(a)};
    for (int k = 0; k < 4; k++)
        object->turn[k] = (float)turn[k];
}

static void fixed_and_driven_bodies_are_left_out(void **state) {
    (void)state;
    JoxProbeDef def = default_probe_def(JOX_PROBE_BODIES, NULL, 0);
    JoxProbe *p = jox_probe_create(&def);
    reset_crowd(1);
    JoxObject rows[] = {{.id = 0, .live = true, .moves = true, .turn = {0, 0, 0, 1}},
                        {.id = 1, .live = true, .name = "pillar", .turn = {0, 0, 0, 1}},
                        {.id = 2, .live = true, .kinematic = true, .turn = {0, 0, 0, 1}}};
    const JoxObjects objects = {.rows = rows, .count = 3};
    crowd.objects = &objects;
    show_crowd(p, 0);
    for (int r = 0; r < 3; r++)
        rows[r].position.x = r == 1 ? 0.0f : 2.0f;
    show_crowd(p, 1);
    assert_near(figure_value(p, "bodies"), 1, 0);
    assert_near(figure_value(p, "mean"), 2, 1e-6);
    char text[1000];
    read_probe_csv(p, text, sizeof text);
    assert_null(strstr(text, "pillar"));
    jox_probe_free(p);
}

static void bodies_move_turn_and_topple(void **state) {
    (void)state;
    JoxProbeDef def = default_probe_def(JOX_PROBE_BODIES, NULL, 0);
    def.onset = 0.25;
    JoxProbe *p = jox_probe_create(&def);
    reset_crowd(1);
    show_crowd(p, 0); /* no bodies yet */
    assert_near(figure_value(p, "bodies"), 0, 0);
    assert_true(isnan(figure_value(p, "mean")));
    JoxObject rows[] = {{.id = 0, .live = true, .moves = true, .name = "desk"},
                        {.id = 1, .live = true, .moves = true},
                        {.id = 2, .live = true, .kinematic = true},
                        {.id = 3, .live = true, .moves = true}};
    const JoxObjects objects = {.rows = rows, .count = 4};
    crowd.objects = &objects;
    for (int r = 0; r < 4; r++)
        rotate_object(&rows[r], 70, 0);
    show_crowd(p, 1);
    rows[0].position = (JoxV3){0.3f, 0.4f, 9};
    rows[1].position = (JoxV3){0.2f, 0, 0};
    rows[2].position = (JoxV3){5, 5, 0}; /* is driven */
    rotate_object(&rows[0], 70 + 30, 0);
    rotate_object(&rows[1], 70, 60);
    rotate_object(&rows[3], 70, 60);
    show_crowd(p, 2);
    rotate_object(&rows[3], 70, 0); /* set upright again */
    show_crowd(p, 3);
    assert_near(figure_value(p, "bodies"), 3, 0);
    assert_near(figure_value(p, "moved"), 1, 0);
    assert_near(figure_value(p, "turned"), 1, 0);
    assert_near(figure_value(p, "toppled"), 1, 0);
    assert_near(figure_value(p, "mean"), 0.7 / 3, 1e-6);
    assert_near(figure_value(p, "greatest"), 0.5, 1e-6);
    char text[1000];
    read_probe_csv(p, text, sizeof text);
    assert_non_null(strstr(text, "\n0,desk,0.0000,0.0000,0.0000,0.3000,0.4000,9.0000,0.5000,0.5000,"
                                 "30.00,0.00,0.00\n"));
    assert_non_null(strstr(text, "\n3,,0.0000,0.0000,0.0000,0.0000,0.0000,0.0000,0.0000,0.0000,"));
    assert_non_null(strstr(text, ",60.00\n"));
    jox_probe_free(p);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ten_walkers_pass_a_second_apart),
        cmocka_unit_test(middle_flow_leaves_out_both_ends),
        cmocka_unit_test(stepping_back_revokes_passage),
        cmocka_unit_test(times_and_groups_select_people),
        cmocka_unit_test(periodic_edge_counts_once),
        cmocka_unit_test(lattice_density_is_measured),
        cmocka_unit_test(area_is_measured_during_middle_passages),
        cmocka_unit_test(cells_reach_over_periodic_edges),
        cmocka_unit_test(transit_is_from_line_to_line),
        cmocka_unit_test(visit_is_from_state_to_state),
        cmocka_unit_test(push_front_has_a_speed),
        cmocka_unit_test(map_density_is_the_kernel),
        cmocka_unit_test(turns_are_counted),
        cmocka_unit_test(failures_are_shares),
        cmocka_unit_test(lanes_have_order_parameter),
        cmocka_unit_test(fixed_and_driven_bodies_are_left_out),
        cmocka_unit_test(bodies_move_turn_and_topple),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
