/* Frames of worlds with storeys: positions on sheets in, figures as of one plane out. */
#include "record_storeys.h"

#include <stdio.h>
#include <stdlib.h>

#include "record/danger/danger.h"
#include "record/fields/density.h"
#include "record/fields/voronoi_people.h"
#include "record/frame_track.h"
#include "record/probes/probe.h"

/* ---- tracks ---- */

static void agent_over_a_seam_walks_on_and_crosses_each_line_once(void **state) {
    (void)state;
    JoxStoreys storeys = lay_out_two_storeys();
    const uint32_t stair = storeys.stairs[0].sheet, key[1] = {0};
    const JoxV2 at[] = {jox_v2(7.95f, 5.2f), jox_on_sheet(&storeys, stair, jox_v2(8.1f, 5.1f))};
    const JoxV2 below[2] = {jox_v2(7.97f, 6), jox_v2(7.97f, 4)};
    const JoxV2 above[2] = {jox_on_sheet(&storeys, stair, jox_v2(8.02f, 6)),
                            jox_on_sheet(&storeys, stair, jox_v2(8.02f, 4))};
    JoxTrack track = {0};
    JoxStretch way;
    for (int k = 0; k < 2; k++) {
        const JoxFrame frame = {.time = 0.1 * k,
                                .count = 1,
                                .keys = 1,
                                .key = key,
                                .x = &at[k].x,
                                .y = &at[k].y,
                                .storeys = &storeys};
        jox_track_reserve(&track, &frame);
        assert_int_equal(jox_track_step(&track, &frame, 0, &way), k);
    }
    assert_near(way.by.x, 0.15, 1e-5);
    assert_near(way.by.y, -0.1, 1e-4);
    double time = 0.0;
    assert_int_equal(jox_stretch_crosses(&way, below[0], below[1], &time), 1);
    assert_near(time, 0.1 * 0.02 / 0.15, 1e-4);
    assert_int_equal(jox_stretch_crosses(&way, above[0], above[1], &time), 1);
    assert_near(time, 0.1 * 0.07 / 0.15, 1e-4);
    jox_free(track.items);
    jox_storeys_free(&storeys);
}

/* ---- densities ---- */

/* Fails where the densities of a floor, 1/m2, differ by more than `within`, between x = from and
   x = to. */
static void compare_floors(const Plan *p, const JoxDensity *flat, const JoxDensity *sheets,
                           float from, float to, double within) {
    double most = 0.0;
    for (float x = from + 0.1f; x < to; x += 0.2f)
        for (float y = 0.3f; y < 9.8f; y += 0.2f) {
            const JoxV2 plan = turn_point(p, x, y), at = put_on_sheet(p, x, y);
            size_t a, b;
            if (x > WEST - 0.3f && x < EAST + 0.3f && (y < 4.4f || y > 5.6f))
                continue;
            assert_true(jox_density_cell_of(flat, plan.x, plan.y, &a));
            assert_true(jox_density_cell_of(sheets, at.x, at.y, &b));
            most = fmax(most, fabs((double)flat->now[a] - (double)sheets->now[b]));
        }
    if (most > within)
        fail_msg("densities differ by %g", most);
}

static double count_people(const JoxDensity *d) {
    double people = 0.0;
    for (size_t k = 0; k < (size_t)d->columns * d->rows; k++)
        people += (double)d->now[k] * (double)jox_density_area(d, k);
    return people;
}

static void densities_over_seams_are_those_of_one_plane(void **state) {
    (void)state;
    const struct {
        float turn;
        double within; /* 1/m2: rows of a turned stair lie between those of the one plane */
    } CASES[] = {{0.0f, 0.001}, {0.5f, 0.1}, {2.0f, 0.1}};
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; k++) {
        Plan *p = make_plan(CASES[k].turn);
        const JoxV2 low = {-21, -11}, high = {21, 26};
        JoxDensity *flat = jox_density_create(low, high, 0.2f, JOX_DENSITY_KERNEL);
        JoxDensity *sheets =
            jox_density_create_on_storeys(low, high, 0.2f, JOX_DENSITY_KERNEL, &p->storeys);
        jox_density_walls(flat, &p->flat_walls);
        jox_density_walls(sheets, &p->sheet_walls);
        jox_density_add(flat, jox_v2(0, 0), p->x, p->flat, p->count, 0.0);
        jox_density_add(sheets, jox_v2(0, 0), p->x, p->sheets, p->count, 0.0);
        compare_floors(p, flat, sheets, 0, WEST + 1, CASES[k].within);
        compare_floors(p, flat, sheets, EAST - 1, 20, CASES[k].within);
        assert_near(count_people(sheets), p->count, 0.5);
        jox_density_free(sheets);
        /* A map of one storey counts who is on the stair near it. */
        for (uint32_t storey = 0; storey < 2; storey++) {
            sheets = jox_density_create(jox_on_sheet(&p->storeys, storey, low),
                                        jox_on_sheet(&p->storeys, storey, high), 0.2f,
                                        JOX_DENSITY_KERNEL);
            jox_density_storeys(sheets, &p->storeys);
            jox_density_walls(sheets, &p->sheet_walls);
            jox_density_add(sheets, jox_v2(0, 0), p->x, p->sheets, p->count, 0.0);
            compare_floors(p, flat, sheets, storey ? EAST : 0, storey ? 20 : WEST, CASES[k].within);
            jox_density_free(sheets);
        }
        jox_density_free(flat);
        free_plan(p);
    }
}

static void rows_of_a_density_leave_out_what_is_not_floor(void **state) {
    (void)state;
    JoxStoreys near = lay_out_two_storeys(), far = lay_out_two_storeys();
    const JoxV2 low = {-1, -1}, high = {21, 11};
    jox_storeys_lay_out(&far, jox_v2(0, -500), jox_v2(20, 500));
    assert_true(far.pitch > 20 * near.pitch);
    JoxDensity *d = jox_density_create_on_storeys(low, high, 0.2f, JOX_DENSITY_KERNEL, &near);
    JoxDensity *e = jox_density_create_on_storeys(low, high, 0.2f, JOX_DENSITY_KERNEL, &far);
    assert_int_equal(d->rows, 60 + 1 + 60 + 1 + 14);
    assert_int_equal(e->rows, d->rows);
    JoxWalls walls = {0};
    jox_storeys_add_walls(&far, &walls);
    jox_density_walls(e, &walls);
    double area = 0.0;
    for (size_t k = 0; k < (size_t)e->columns * e->rows; k++)
        area += (double)jox_density_area(e, k);
    assert_near(area, 2 * (22 * 12 - 12) + 12, 0.1); /* two storeys without the stair; the stair */
    for (uint32_t sheet = 0; sheet < 3; sheet++) {
        size_t cell;
        const JoxV2 at = jox_on_sheet(&far, sheet, jox_v2(9.1f, 5.1f));
        assert_true(jox_density_cell_of(e, at.x, at.y, &cell));
        assert_near(jox_density_middle(e, cell).x, at.x, 0.1001);
        assert_near(jox_density_middle(e, cell).y, at.y, 0.1001);
    }
    jox_walls_free(&walls);
    jox_density_free(d);
    jox_density_free(e);
    jox_storeys_free(&near);
    jox_storeys_free(&far);
}

/* ---- Voronoi cells ---- */

static void voronoi_cells_over_seams_are_those_of_one_plane(void **state) {
    (void)state;
    for (float turn = 0.0f; turn < 3.0f; turn += 0.7f) {
        Plan *p = make_plan(turn);
        float *here = jox_alloc(p->count, sizeof *here), *of[2];
        for (uint32_t i = 0; i < p->count; i++)
            here[i] = 5.0f;
        for (int k = 0; k < 2; k++) {
            JoxVoronoiPeople voronoi = {0};
            const JoxDensityCrowd crowd = {.count = p->count,
                                           .x = p->x,
                                           .y = k ? p->sheets : p->flat,
                                           .storeys = k ? &p->storeys : NULL};
            of[k] = jox_alloc(p->count, sizeof *here);
            jox_voronoi_people_measure(&voronoi, &crowd, k ? &p->sheet_walls : &p->flat_walls, 1,
                                       here, of[k]);
            jox_voronoi_people_free(&voronoi);
        }
        for (uint32_t i = 0; i < p->count; i++)
            assert_near(of[1][i] / of[0][i], 1.0, 1e-3);
        jox_free(here);
        jox_free(of[0]);
        jox_free(of[1]);
        free_plan(p);
    }
}

/* Measures a square of 1 m beside a seam, before it or beyond, in one plane or on its sheet. */
static JoxFigures measure_square(Plan *p, float x, bool on_sheets) {
    JoxV2 square[4];
    uint32_t key[CROWD];
    float still[CROWD] = {0};
    const float corners[4][2] = {
        {x - 0.5f, 4.5f}, {x + 0.5f, 4.5f}, {x + 0.5f, 5.5f}, {x - 0.5f, 5.5f}};
    for (int k = 0; k < 4; k++)
        square[k] =
            jox_on_sheet(&p->storeys, on_sheets && x > WEST ? p->storeys.stairs[0].sheet : 0,
                         turn_point(p, corners[k][0], corners[k][1]));
    for (uint32_t i = 0; i < p->count; i++)
        key[i] = i;
    JoxProbeDef def = {.name = "square",
                       .kind = JOX_PROBE_MEASURE,
                       .points = square,
                       .count = 4,
                       .every = 1.0,
                       .cutoff = 1.0,
                       .until = INFINITY};
    const JoxFrame frame = {.time = 0.5,
                            .count = p->count,
                            .keys = p->count,
                            .key = key,
                            .x = p->x,
                            .y = on_sheets ? p->sheets : p->flat,
                            .vx = still,
                            .vy = still,
                            .walls = on_sheets ? &p->sheet_walls : &p->flat_walls,
                            .storeys = on_sheets ? &p->storeys : NULL};
    JoxProbe *probe = jox_probe_create(&def);
    jox_probe_frame(probe, &frame);
    const JoxFigures figures = jox_probe_figures(probe);
    jox_probe_free(probe);
    return figures;
}

static void measured_squares_beside_a_seam_are_those_of_one_plane(void **state) {
    (void)state;
    Plan *p = make_plan(0.4f);
    for (int beyond = 0; beyond < 2; beyond++) {
        const float x = beyond ? WEST + 0.5f : WEST - 0.5f;
        const JoxFigures flat = measure_square(p, x, false), sheets = measure_square(p, x, true);
        assert_true(flat.count > 5 && flat.items[3].value > 3.0);
        for (uint32_t f = 0; f < 7; f++)
            assert_near(sheets.items[f].value, flat.items[f].value, 1e-3);
    }
    free_plan(p);
}

/* ---- figures ---- */

/* Shows danger a frame of people at points that are not turned. */
static void show_points(JoxDanger *danger, const Plan *p, double time, const float (*points)[2],
                        uint32_t count) {
    float x[8], y[8], still[8] = {0};
    uint32_t key[8];
    for (uint32_t i = 0; i < count; i++) {
        const JoxV2 at = put_on_sheet(p, points[i][0], points[i][1]);
        x[i] = at.x;
        y[i] = at.y;
        key[i] = i;
    }
    const JoxFrame frame = {.time = time,
                            .count = count,
                            .keys = count,
                            .key = key,
                            .x = x,
                            .y = y,
                            .vx = still,
                            .vy = still,
                            .walls = &p->sheet_walls,
                            .storeys = &p->storeys};
    jox_danger_frame(danger, &frame, NULL);
}

static void stairs_have_figures_in_the_summary(void **state) {
    (void)state;
    Plan *p = make_plan(0.0f);
    JoxDanger *danger = jox_danger_create(jox_v2(-1, -1), jox_v2(21, 11), &p->storeys);
    /* One goes up, one down; one turns back; one comes in on the stair and goes up. */
    show_points(danger, p, 0.0, (const float[][2]){{7, 5}, {15, 5}, {7, 4.5f}, {9, 5}}, 4);
    show_points(danger, p, 0.5, (const float[][2]){{9, 4.5f}, {13, 5}, {9, 5.5f}, {10, 5}}, 4);
    show_points(danger, p, 1.0, (const float[][2]){{15, 5}, {7, 5}, {7, 5.5f}, {16, 5}}, 4);
    JoxText text = {0};
    JoxJson json = jox_json_begin(&text, 0);
    jox_json_object(&json, NULL);
    jox_danger_json(danger, &json);
    jox_json_end(&json);
    const char *stairs = strstr(text.data, "\"stairs\"");
    assert_non_null(stairs);
    assert_non_null(strstr(stairs, "\"north\": {\"up\": 2, \"down\": 1, \"people_max\": 4, "
                                   "\"width\": 2, \"used_s\": 0.5, \"first_s\": 0, "
                                   "\"last_s\": 0.5, \"flow_max\": null"));
    assert_non_null(strstr(stairs, "\"by_lift\": {\"up\": 0, \"down\": 0}"));
    /* Places are in plan, with the name of the storey or stair. */
    assert_non_null(strstr(text.data, "\"density_max_storey\": \"north\""));
    const char *y = strstr(text.data, "\"density_max_y\": ");
    assert_non_null(y);
    assert_near(strtod(y + 17, NULL), 5.0, 1.0);
    jox_text_free(&text);
    jox_danger_free(danger);
    free_plan(p);
}

enum { STAIR_STEP_MS = 500, STAIR_CROWD = 60 };

/* Shows danger a frame of people who follow each other up the stair at 1 m/s, one in each half
   second from 0 on, the first `count` of them. */
static void show_procession(JoxDanger *danger, const Plan *p, uint32_t step, uint32_t count) {
    float x[STAIR_CROWD], y[STAIR_CROWD], still[STAIR_CROWD] = {0};
    uint32_t key[STAIR_CROWD], present = 0;
    const float time = 0.001f * STAIR_STEP_MS * (float)step;
    for (uint32_t i = 0; i < count; i++) {
        const float way = time - 0.001f * STAIR_STEP_MS * (float)i;
        if (way < 0.0f || way > 9.0f)
            continue;
        const JoxV2 at = put_on_sheet(p, 6.75f + way, 5.0f);
        x[present] = at.x;
        y[present] = at.y;
        key[present++] = i;
    }
    const JoxFrame frame = {.time = (double)time,
                            .count = present,
                            .keys = STAIR_CROWD,
                            .key = key,
                            .x = x,
                            .y = y,
                            .vx = still,
                            .vy = still,
                            .walls = &p->sheet_walls,
                            .storeys = &p->storeys};
    jox_danger_frame(danger, &frame, NULL);
}

static double read_stair_figure(const JoxDanger *danger, const char *name) {
    JoxText text = {0};
    JoxJson json = jox_json_begin(&text, 0);
    jox_json_object(&json, NULL);
    jox_danger_json(danger, &json);
    jox_json_end(&json);
    char key[64];
    snprintf(key, sizeof key, "\"%s\": ", name);
    const char *at = strstr(strstr(text.data, "\"north\": {"), key);
    assert_non_null(at);
    at += strlen(key);
    const double value = strncmp(at, "null", 4) == 0 ? NAN : strtod(at, NULL);
    jox_text_free(&text);
    return value;
}

static void flow_level_and_mean_density_of_a_stair_are_judged_if_enough_pass(void **state) {
    (void)state;
    for (int few = 0; few < 2; few++) {
        Plan *p = make_plan(0.0f);
        JoxDanger *danger = jox_danger_create(jox_v2(-1, -1), jox_v2(21, 11), &p->storeys);
        for (uint32_t step = 0; step <= 90; step++)
            show_procession(danger, p, step, few ? 9 : STAIR_CROWD);
        assert_near(read_stair_figure(danger, "up"), few ? 9 : STAIR_CROWD, 0);
        /* Two a second over 2 m, in the ten seconds before; Fruin's level F from 0.93 on. */
        const double flow = read_stair_figure(danger, "flow_max");
        const double at_f = read_stair_figure(danger, "F");
        if (few) {
            assert_true(isnan(flow) && isnan(at_f));
        } else {
            assert_near(flow, 1.0, 1e-9);
            assert_true(at_f > 15.0 && at_f < 30.0);
        }
        /* On the stair, 6 m long, from 1.5 s after the first one begins to 7 s after the last. */
        assert_near(read_stair_figure(danger, "first_s"), 1.5, 1e-6);
        assert_near(read_stair_figure(danger, "last_s"), few ? 11.0 : 36.5, 1e-6);
        assert_near(read_stair_figure(danger, "used_s"), few ? 10.0 : 35.5, 1e-6);
        const double mean = read_stair_figure(danger, "density_mean_max");
        assert_true(mean > 0.5 && mean <= read_stair_figure(danger, "density_max"));
        assert_near(read_stair_figure(danger, "over_limit_s"), 0.0, 0);
        jox_danger_free(danger);
        free_plan(p);
    }
}

static void danger_of_stairs_goes_on_after_a_checkpoint(void **state) {
    (void)state;
    Plan *p = make_plan(0.0f);
    JoxDanger *whole = jox_danger_create(jox_v2(-1, -1), jox_v2(21, 11), &p->storeys);
    JoxDanger *resumed = jox_danger_create(jox_v2(-1, -1), jox_v2(21, 11), &p->storeys);
    JoxText saved = {0};
    for (uint32_t step = 0; step <= 90; step++) {
        if (step == 50) {
            JoxSections save = jox_sections_save(&saved);
            jox_danger_sections(whole, &save);
            assert_true(jox_sections_end(&save));
            JoxSections restore = jox_sections_restore(saved.data, saved.length);
            jox_danger_sections(resumed, &restore);
            assert_true(jox_sections_end(&restore));
        }
        show_procession(whole, p, step, STAIR_CROWD);
        if (step >= 50)
            show_procession(resumed, p, step, STAIR_CROWD);
    }
    static const char *const FIGURES[] = {"up",       "people_max", "used_s",
                                          "flow_max", "flow_max_s", "last_s",
                                          "first_s",  "F",          "density_mean_max"};
    for (size_t f = 0; f < sizeof FIGURES / sizeof *FIGURES; f++)
        assert_near(read_stair_figure(resumed, FIGURES[f]), read_stair_figure(whole, FIGURES[f]),
                    0);
    jox_text_free(&saved);
    jox_danger_free(whole);
    jox_danger_free(resumed);
    free_plan(p);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agent_over_a_seam_walks_on_and_crosses_each_line_once),
        cmocka_unit_test(densities_over_seams_are_those_of_one_plane),
        cmocka_unit_test(rows_of_a_density_leave_out_what_is_not_floor),
        cmocka_unit_test(voronoi_cells_over_seams_are_those_of_one_plane),
        cmocka_unit_test(stairs_have_figures_in_the_summary),
        cmocka_unit_test(flow_level_and_mean_density_of_a_stair_are_judged_if_enough_pass),
        cmocka_unit_test(danger_of_stairs_goes_on_after_a_checkpoint),
        cmocka_unit_test(measured_squares_beside_a_seam_are_those_of_one_plane),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
