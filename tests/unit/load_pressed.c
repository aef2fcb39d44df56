/* Crowds that press on a closed door at the end of a corridor, and on a very broad person: what the
   door bears hardly depends on the time step, and people neither sink into others nor stand denser
   than they can. */
#include "unit/effort.h"
#include "unit/load_torso.h"

enum { CROWD = 240, ROW = 5 };
static const double HALF = 1.5; /* m: of the corridor's width */
/* s: length of a run, and of what is left out */
static const double SECONDS = EFFORT_EACH > 1 ? 30.0 : 60.0, FIRST = 20.0;
static const double PUSH = 65.0;  /* N */
static const double SUNK = 0.02;  /* m: greatest depth of overlap, 99th percentile */
static const double WITHIN = 0.1; /* relative change of the load over time steps; 12 % for 120 */
/* 1/m2: densest packing of torsos of 0.45 by 0.25 m, one in each 2 sqrt(3) 0.125^2 + 0.2 0.25 m2 */
static const double DENSEST = 9.6;

typedef struct Reading {
    double load;    /* N: mean on the door */
    double depth;   /* m: 99th percentile of overlap, of those who touch */
    double density; /* 1/m2: greatest, by a Gaussian of R = 1 m, the door reflecting */
} Reading;

static double measure_door(const JoWorld *w, double dt) {
    size_t count;
    const JoxKeptImpulse *kept = jox_force_kept_impulses(w->scratch.forces, JOX_KEPT_WALLS, &count);
    double sum = 0.0;
    for (size_t k = 0; k < count; k++) {
        const JoxWallVertex *from = &w->model.all_walls.vertices[kept[k].other];
        const JoxWallVertex *to = &w->model.all_walls.vertices[from->next];
        if (fabsf(from->point.x) < 1e-3f && fabsf(to->point.x) < 1e-3f)
            sum += (double)kept[k].impulse / dt;
    }
    return sum;
}

static double measure_density(const JoxAgents *a, uint32_t i) {
    double sum = 0.0;
    for (uint32_t j = 0; j < a->count; j++) {
        const double x = (double)(a->x[j] - a->x[i]), y = (double)(a->y[j] - a->y[i]);
        const double mirrored = (double)(a->x[j] + a->x[i]);
        sum += exp(-x * x - y * y) + exp(-mirrored * mirrored - y * y);
    }
    return sum / (0.5 * TURN);
}

/* Adds the depths of all pairs that touch to bins of 1 mm. */
static void count_depths(const JoxAgents *a, uint32_t bins[100]) {
    for (uint32_t i = 0; i < a->count; i++)
        for (uint32_t j = i + 1; j < a->count; j++) {
            const double gap = (double)jox_torso_gap(a, i, j);
            if (gap < 0.002)
                bins[(int)fmin(99.0, 1e3 * fmax(0.0, -gap))]++;
        }
}

static double find_p99(const uint32_t bins[100]) {
    uint32_t all = 0, above = 0;
    for (int k = 0; k < 100; k++)
        all += bins[k];
    int bin = 99;
    for (; bin > 0 && (above += bins[bin]) <= all / 100; bin--)
        ;
    return 1e-3 * (bin + 1);
}

static Reading press_on_door(double dt, double push) {
    const double corridor[] = {-20.0, HALF, 0.0, HALF, 0.0, -HALF, -20.0, -HALF};
    JoWorld *w = open_world(dt);
    JoxAgents *a = &w->state.agents;
    Reading read = {0};
    uint32_t bins[100] = {0}, steps = 0;
    assert_true(jo_world_add_line(w, corridor, 4, NULL));
    for (int n = 0; n < CROWD; n++) {
        const JoAgent one = add_torso(
            w, -0.4 - 0.5 * (n / ROW),
            0.5 * (n % ROW - 2) + draw_between((uint64_t)n, 1, -0.05, 0.05), 0.0, 0.45, 0.25);
        jo_agent_set_parameter(w, one, "radius", 0.2, NULL);
        jo_agent_set_parameter(w, one, "push", push, NULL);
    }
    for (double t = 0.0; t < SECONDS - 1e-6; t += dt) {
        for (uint32_t i = 0; i < a->count; i++)
            jo_agent_set_preferred(w, jox_world_agent_handle(w, i), 1.3, 0.0);
        jo_world_step(w, 1);
        if (t < FIRST)
            continue;
        read.load += measure_door(w, dt);
        if (steps++ % (uint32_t)(1.0 / dt) > 0)
            continue;
        count_depths(a, bins);
        for (uint32_t i = 0; i < a->count; i++)
            read.density = fmax(read.density, measure_density(a, i));
    }
    assert_null(jo_world_failure(w));
    jo_world_free(w);
    read.load /= steps;
    read.depth = find_p99(bins);
    return read;
}

static void a_closed_door_bears_alike_at_any_step(void **state) {
    (void)state;
    const Reading coarse = press_on_door(0.05, PUSH), fine = press_on_door(0.0125, PUSH);
    const Reading none = press_on_door(0.05, 0.0);
    const Reading *reads[] = {&coarse, &fine, &none};
    for (int k = 0; k < 3; k++) {
        print_message("  door %.0f N, depth %.0f mm, density %.2f per m2\n", reads[k]->load,
                      1e3 * reads[k]->depth, reads[k]->density);
        assert_true(reads[k]->depth <= SUNK && reads[k]->density <= DENSEST);
    }
    assert_true(fabs(coarse.load - fine.load) <= WITHIN * fine.load);
    assert_true(none.load < 0.25 * coarse.load); /* the null: nobody pushes */
}

/* ---- a broad person ---- */

/* Lets a crowd press from both sides on a person who stands, 3 m broad. Returns the 99th percentile
   of how deep people are in that one, m. */
static double press_on_broad(void) {
    JoWorld *w = open_world(0.05);
    JoxAgents *a = &w->state.agents;
    uint32_t bins[100] = {0};
    const JoAgent broad = add_torso(w, 0.0, 0.0, 0.0, 3.0, 0.5);
    jo_agent_set_parameter(w, broad, "mass", 3000.0, NULL);
    for (int n = 0; n < CROWD; n++) {
        const double side = n % 2 ? 1.0 : -1.0;
        const JoAgent one = add_torso(w, side * (0.6 + 0.4 * (n / 2 / 8)), 0.4 * (n / 2 % 8 - 3.5),
                                      0.0, 0.45, 0.25);
        jo_agent_set_parameter(w, one, "push", PUSH, NULL);
    }
    for (int step = 0; step < 400; step++) {
        for (uint32_t i = 0; i < a->count; i++)
            if (a->id[i] != a->id[jox_world_find_agent(w, broad)])
                jo_agent_set_preferred(w, jox_world_agent_handle(w, i), a->x[i] > 0.0f ? -1.3 : 1.3,
                                       0.0);
        jo_world_step(w, 1);
        const uint32_t i = jox_world_find_agent(w, broad);
        for (uint32_t j = 0; j < a->count; j++)
            if (j != i && jox_torso_gap(a, i, j) < 0.002f)
                bins[(int)fmin(99.0, 1e3 * fmax(0.0, -(double)jox_torso_gap(a, i, j)))]++;
    }
    assert_null(jo_world_failure(w));
    jo_world_free(w);
    return find_p99(bins);
}

static void nobody_sinks_into_broad_person(void **state) {
    (void)state;
    const double depth = press_on_broad();
    print_message("  depth %.0f mm\n", 1e3 * depth);
    assert_true(depth <= SUNK);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_closed_door_bears_alike_at_any_step),
                                       cmocka_unit_test(nobody_sinks_into_broad_person)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
