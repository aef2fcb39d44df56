/* Files and summaries of probes, and that steady frames allocate no memory. */
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
#include "record_draw.h"

/* ---- files ---- */

static bool file_begins_with(const char *path, const char *first) {
    char start[256] = "";
    FILE *file = fopen(path, "rb");
    size_t got = file ? fread(start, 1, sizeof start - 1, file) : 0;
    if (file)
        fclose(file);
    return got > 0 && strncmp(start, first, strlen(first)) == 0;
}

/* Each kind writes its files, with and without people. */
static void every_kind_writes_its_files(void **state) {
    (void)state;
    static const JoxV2 POINTS[] = {{0, 1}, {0, -1}, {2, -1}, {2, 1}};
    static const char *const ENDS[] = {"csv", "png", "svg", "plt"};
    char folder[] = "/tmp/jostle-probes-XXXXXX", path[128];
    assert_non_null(mkdtemp(folder));
    JoxWalls walls = {0};
    jox_walls_add_polyline(&walls, POINTS, 4, false, INFINITY);
    for (int kind = 0; kind < JOX_PROBE_KINDS; kind++)
        for (uint32_t people = 0; people < 3; people++) {
            JoxProbeDef def = default_probe_def((JoxProbeKind)kind, POINTS,
                                                kind == JOX_PROBE_DISPLACEMENT ? 0 : 4);
            JoxProbe *p = jox_probe_create(&def);
            JoxText error = {0};
            reset_crowd(people);
            for (int step = 0; step < 30; step++) {
                for (uint32_t i = 0; i < people; i++) {
                    crowd.x[i] = 0.1f * (float)step - 0.95f * (float)(i + 1);
                    crowd.vx[i] = 1;
                }
                show_crowd(p, 0.1 * step);
            }
            assert_true(
                jox_probe_write(p, folder, &walls, "it's a \"test\" `of` $(titles)", &error));
            assert_null(error.data);
            for (int e = 0; e < 4; e++) {
                static const char *const STARTS[] = {"", "\x89PNG", "<?xml", "reset"};
                snprintf(path, sizeof path, "%s/probe.%s", folder, ENDS[e]);
                assert_true(file_begins_with(path, STARTS[e]));
                assert_int_equal(unlink(path), 0);
            }
            jox_probe_free(p);
        }
    JoxProbeDef def = default_probe_def(JOX_PROBE_FLOW, POINTS, 2);
    JoxProbe *p = jox_probe_create(&def);
    JoxText error = {0};
    assert_false(jox_probe_write(p, "/proc/none", &walls, "", &error));
    assert_non_null(strstr(error.data, "cannot write"));
    jox_text_free(&error);
    jox_probe_free(p);
    jox_walls_free(&walls);
    snprintf(path, sizeof path, "%s/walls.dat", folder);
    unlink(path);
    assert_int_equal(rmdir(folder), 0);
}

static void summary_is_json(void **state) {
    (void)state;
    JoxProbeDef def =
        default_probe_def(JOX_PROBE_TRANSIT, (const JoxV2[]){{0, 0}, {0, 1}, {1, 0}, {1, 1}}, 4);
    JoxProbe *p = jox_probe_create(&def);
    JoxText out = {0};
    JoxJson json = jox_json_begin(&out, 0);
    jox_probe_json(p, &json, NULL);
    assert_string_equal(
        out.data,
        "{\"passages\": 0, \"under_way\": 0, \"mean\": null, \"median\": null, "
        "\"p95\": null, \"least\": null, \"greatest\": null, \"from\": 0, \"until\": null}");
    jox_text_free(&out);
    jox_probe_free(p);
}

/* Two people and two moving bodies: the first person enters a state, with the nearer body in the
   row, then kicks the farther one; the second person is hit. The farther one flies at both. Rows
   have positions before the step. */
static void log_has_each_action(void **state) {
    (void)state;
    static const JoxProbeDef DEF = {
        .name = "probe", .kind = JOX_PROBE_LOG, .until = INFINITY, .every = 1};
    JoxObject rows[3] = {
        {.id = 7, .live = true, .moves = true, .round = 0.1f, .grounded = true},
        {.id = 8, .live = true, .moves = true, .round = 0.1f},
        {.id = 9, .live = true}}; /* a static body at the first person's position */
    rows[0].position = (JoxV3){2, 0, 0.1f};
    rows[1].position = (JoxV3){0, 3, 0.5f};
    rows[1].velocity = (JoxV3){0, -3, 4};
    const JoxObjects objects = {.rows = rows, .count = 3};
    uint32_t kicked[2] = {0, 0}, struck[2] = {0, 0};
    JoxProbe *p = jox_probe_create(&DEF);
    reset_crowd(2);
    crowd.objects = &objects;
    crowd.kicked = kicked;
    crowd.struck = struck;
    crowd.y[1] = 2;
    show_crowd(p, 0.1);
    crowd.state[0] = 1;
    crowd.x[0] = 0.5f; /* after the step: rows have the position before */
    show_crowd(p, 0.2);
    kicked[0] = 1;
    struck[1] = 2;
    show_crowd(p, 0.3);
    assert_near(figure_value(p, "entered"), 1, 0);
    assert_near(figure_value(p, "kicks"), 1, 0);
    assert_near(figure_value(p, "hits"), 1, 0);
    char text[1024];
    read_probe_csv(p, text, sizeof text);
    assert_non_null(strstr(text, "\n0.2000,enters,0,,Walk,Wait,0.0000,0.0000,0.0000,"
                                 "7,2.0000,0.0000,0.1000,0.0000,1.9000,1,0.0000\n"));
    assert_non_null(strstr(text, "\n0.3000,kicks,0,,Wait,Wait,0.5000,0.0000,0.0000,"
                                 "7,2.0000,0.0000,0.1000,0.0000,1.4000,1,0.5000\n"));
    assert_non_null(strstr(text, "\n0.3000,hit,1,,Walk,Walk,0.0000,2.0000,0.0000,"
                                 "8,0.0000,3.0000,0.5000,5.0000,0.9000,0,0.0000\n"));
    jox_probe_free(p);
}

/* Two people kick a body each: the one flies, is at its highest and comes down, the other rolls.
   The one is still taken for grounded as it rises. */
static void log_follows_flights_of_kicked_bodies(void **state) {
    (void)state;
    static const JoxProbeDef DEF = {
        .name = "probe", .kind = JOX_PROBE_LOG, .until = INFINITY, .every = 1};
    static const struct {
        float z, rising;
        bool grounded;
    } FLIGHT[] = {{0.1f, 3, true},      {0.3f, 2, true},      {0.5f, 1, false},
                  {0.6f, -0.1f, false}, {0.4f, -2, false},    {0.1f, 1, true},
                  {0.2f, 0.5f, false},  {0.2f, -0.5f, false}, {0.1f, 0, true}}; /* a bounce */
    JoxObject rows[2] = {{.id = 7, .live = true, .moves = true, .round = 0.1f},
                         {.id = 8, .live = true, .moves = true, .round = 0.1f, .grounded = true}};
    const JoxObjects objects = {.rows = rows, .count = 2};
    uint32_t kicked[2] = {0, 0};
    JoxProbe *p = jox_probe_create(&DEF);
    reset_crowd(2);
    crowd.objects = &objects;
    crowd.kicked = kicked;
    show_crowd(p, 0.1);
    kicked[0] = 1;
    kicked[1] = 2;
    for (int n = 0; n < (int)(sizeof FLIGHT / sizeof *FLIGHT); n++) {
        rows[0].position.z = FLIGHT[n].z;
        rows[0].velocity.z = FLIGHT[n].rising;
        rows[0].grounded = FLIGHT[n].grounded;
        show_crowd(p, 0.2 + 0.1 * n);
        kicked[0] = kicked[1] = 0;
    }
    assert_near(figure_value(p, "kicks"), 2, 0);
    assert_near(figure_value(p, "flights"), 1, 0);
    char text[2048];
    read_probe_csv(p, text, sizeof text);
    assert_non_null(strstr(text, "\n0.5000,peaks,0,,Walk,Walk,0.0000,0.0000,0.0000,"
                                 "7,0.0000,0.0000,0.6000,0.1000,"));
    assert_non_null(strstr(text, "\n0.7000,lands,0,,Walk,Walk,0.0000,0.0000,0.0000,"
                                 "7,0.0000,0.0000,0.1000,1.0000,"));
    assert_null(strstr(strstr(text, "lands") + 1, "lands"));
    assert_null(strstr(strstr(text, "peaks") + 1, "peaks"));
    jox_probe_free(p);
}

static void steady_frames_allocate_nothing(void **state) {
    (void)state;
    static const JoxV2 POINTS[] = {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}};
    for (int kind = 0; kind < JOX_PROBE_KINDS; kind++) {
        JoxProbeDef def =
            default_probe_def((JoxProbeKind)kind, POINTS, kind == JOX_PROBE_DISPLACEMENT ? 0 : 4);
        def.every = 100; /* else lists of intervals grow from time to time */
        def.until = 99;
        JoxProbe *p = jox_probe_create(&def);
        reset_crowd(200);
        uint64_t before = 0;
        for (int step = 0; step < 100; step++) {
            for (uint32_t i = 0; i < 200; i++) {
                crowd.x[i] = (float)(4 * draw_from_counter(i) - 2 + 0.001 * step);
                crowd.y[i] = (float)(3 * draw_from_counter(i + 5000) - 5);
            }
            show_crowd(p, 0.1 * step);
            if (step == 50)
                before = jox_alloc_count();
        }
        assert_true(jox_alloc_count() == before);
        jox_probe_free(p);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_writes_its_files),
        cmocka_unit_test(summary_is_json),
        cmocka_unit_test(steady_frames_allocate_nothing),
        cmocka_unit_test(log_has_each_action),
        cmocka_unit_test(log_follows_flights_of_kicked_bodies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
