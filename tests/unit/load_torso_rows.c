/* Rows of people with torsos of 0.45 by 0.25 m, chest to back, between a force and a wall: they
   bear the force one and all, and hardly sink into each other, at any time step. */
#include "unit/load_torso.h"

enum { ROW = 5, MOST_DEPTHS = 401 * ROW };
static const double DEPTH = 0.25, BREADTH = 0.45;
static const double SECONDS = 5.0, SETTLED = 0.5, LAST = 1.0; /* s */
static const double SUNK = 0.02;  /* m: greatest depth of overlap, 99th percentile */
static const double WITHIN = 0.1; /* relative error of a load */

typedef struct Row {
    double newtons, dt;
    uint32_t passes; /* of the contact solve; 0: as many as by default */
} Row;

typedef struct Reading {
    double depth;                 /* m: 99th percentile over all contacts and steps */
    double least_load, most_load; /* N: mean of a person over the last second */
} Reading;

static int compare_depths(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* Lists how deep each person is in the one ahead, and the first in the wall at x = 0, m. */
static size_t list_depths(const JoxAgents *a, const uint32_t row[ROW], double *out) {
    out[0] = fmax(0.0, (double)(a->x[row[0]] + jox_torso_reach(a, row[0], (JoxV2){1.0f, 0.0f})));
    for (int i = 1; i < ROW; i++)
        out[i] = fmax(0.0, -(double)jox_torso_gap(a, row[i - 1], row[i]));
    return ROW;
}

/* Presses a row against the wall, in a channel that leaves 1 mm. */
static Reading press_row(const Row *r) {
    static double depths[MOST_DEPTHS];
    const double left[] = {-3.0, 0.5 * BREADTH + 0.001, 1.0, 0.5 * BREADTH + 0.001};
    const double right[] = {-3.0, -0.5 * BREADTH - 0.001, 1.0, -0.5 * BREADTH - 0.001};
    const double end[] = {0.0, -1.0, 0.0, 1.0};
    JoWorld *w = open_world(r->dt);
    JoAgent people[ROW];
    uint32_t row[ROW];
    double loads[ROW] = {0.0};
    size_t count = 0, last = 0;
    assert_true(jo_world_add_line(w, left, 2, NULL) && jo_world_add_line(w, right, 2, NULL) &&
                jo_world_add_line(w, end, 2, NULL));
    for (int i = 0; i < ROW; i++)
        people[i] =
            add_torso(w, -0.5 * DEPTH - 0.001 - (DEPTH + 0.002) * i, 0.0, 0.0, BREADTH, DEPTH);
    if (r->passes) {
        JoxForceOptions options = jox_force_default_options();
        options.iterations = r->passes;
        jox_forces_set_options(w->scratch.forces, &options);
    }
    for (double t = 0.0; t < SECONDS - 1e-6; t += r->dt) {
        jo_agent_apply_force(w, people[ROW - 1], r->newtons, 0.0);
        jo_world_step(w, 1);
        for (int i = 0; i < ROW; i++)
            row[i] = jox_world_find_agent(w, people[i]);
        if (t >= SETTLED)
            count += list_depths(&w->state.agents, row, depths + count);
        if (t < SECONDS - LAST)
            continue;
        last++;
        for (int i = 0; i < ROW; i++)
            loads[i] += jo_agent_state(w, people[i]).load;
    }
    assert_null(jo_world_failure(w));
    jo_world_free(w);
    qsort(depths, count, sizeof *depths, compare_depths);
    Reading read = {.depth = depths[count * 99 / 100], .least_load = INFINITY};
    for (int i = 0; i < ROW; i++) {
        read.least_load = fmin(read.least_load, loads[i] / (double)last);
        read.most_load = fmax(read.most_load, loads[i] / (double)last);
    }
    return read;
}

static bool bears(const Row *r, const Reading *read) {
    return read->depth <= SUNK && read->least_load >= (1.0 - WITHIN) * r->newtons &&
           read->most_load <= (1.0 + WITHIN) * r->newtons;
}

static void rows_bear_great_forces(void **state) {
    (void)state;
    const double forces[] = {1000.0, 2000.0, 5000.0}, steps[] = {0.05, 0.0125};
    for (int k = 0; k < 6; k++) {
        const Row r = {.newtons = forces[k / 2], .dt = steps[k % 2]};
        const Reading read = press_row(&r);
        print_message("  %g N, dt %g s: depth %.1f mm, loads %.0f to %.0f N\n", r.newtons, r.dt,
                      1e3 * read.depth, read.least_load, read.most_load);
        assert_true(bears(&r, &read));
    }
}

/* The null: contacts that are solved in one pass each pass on a part of the force. */
static void rows_do_not_bear_by_single_passes(void **state) {
    (void)state;
    const Row r = {.newtons = 5000.0, .dt = 0.05, .passes = 1};
    const Reading read = press_row(&r);
    print_message("  one pass: depth %.1f mm, loads %.0f to %.0f N\n", 1e3 * read.depth,
                  read.least_load, read.most_load);
    assert_false(bears(&r, &read));
}

/* Two people stand chest to back, 0.3 m apart, as near as torsos and not discs allow. Returns how
   far they are apart after 2 s, m. */
static double stand_together(bool forces) {
    JoWorldDef def = jo_default_world_def();
    def.forces = forces;
    JoWorld *w = jo_world_create(&def, NULL);
    JoAgent people[2];
    for (int i = 0; i < 2; i++) {
        people[i] = add_torso(w, 0.3 * i, 0.0, 0.0, BREADTH, DEPTH);
        jo_agent_set_parameter(w, people[i], "radius", 0.2, NULL);
    }
    jo_world_step(w, 40);
    const JoAgentState one = jo_agent_state(w, people[0]), other = jo_agent_state(w, people[1]);
    jo_world_free(w);
    return hypot(other.x - one.x, other.y - one.y);
}

/* Forces alone press people nearer than the discs for which they keep room: without forces two who
   are that near part. The null: with forces they stay. */
static void without_forces_people_keep_their_discs(void **state) {
    (void)state;
    assert_true(stand_together(false) > 0.39);
    assert_true(stand_together(true) < 0.35);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_bear_great_forces),
        cmocka_unit_test(rows_do_not_bear_by_single_passes),
        cmocka_unit_test(without_forces_people_keep_their_discs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
