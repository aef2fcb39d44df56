/* Tests of sources: on which side of walls people come in, how many of the people due come, and
 * when. */
#include "run/results/demand.h"
#include "unit/gate_ball_scene.h"

#define STANDER MACHINE_START "\"Stand\", states = { Stand = { steer = hold } } }\n"
#define SOURCE(walls, place, more)                                                                 \
    "jostle: 1\nwalls: [" walls "]\nplaces: {door: {" place "}}\n"                                 \
    "groups: {people: {behaviour: own.lua, count: 0}}\n"                                           \
    "sources: [{at: door, like: people" more "}]\n"

/* ---- sides of walls ---- */

typedef struct Side {
    const char *name, *yaml;
    JoxV2 low, high; /* m: box in which all people come in */
} Side;

#define ROOM "{line: [[0, 0], [10, 0], [10, 10], [0, 10]], closed: true}"
#define FENCE "{line: [[0, -30], [0, 30]]}"
static const Side SIDES[] = {
    {"a circle across a fence",
     SOURCE(FENCE, "point: [0.4, 0], radius: 1.5", ", rate: 20"),
     {0, -9},
     {9, 9}},
    {"a polygon that leaves a room",
     SOURCE(ROOM, "polygon: [[-1, 2], [4, 2], [4, 8], [-1, 8]]", ", rate: 40"),
     {0, 0},
     {10, 10}},
    {"a line on the wall of a room",
     SOURCE(ROOM, "line: [[0, 2], [0, 8]]", ", rate: 20"),
     {0, 0},
     {10, 10}},
    {"its other direction", SOURCE(ROOM, "line: [[0, 8], [0, 2]]", ", rate: 20"), {0, 0}, {10, 10}},
    {"a line on a fence, left of it",
     SOURCE(FENCE, "line: [[0, 2], [0, 8]]", ", rate: 20"),
     {-9, -9},
     {0, 19}},
    {"a line along a solid",
     SOURCE("{solid: [[-2, -9], [0, -9], [0, 9], [-2, 9]]}", "line: [[0, -3], [0, 3]]",
            ", rate: 20"),
     {0, -19},
     {9, 19}},
    {"a polygon about most of a solid",
     SOURCE("{solid: [[-3, -3], [3, -3], [3, 3], [-3, 3]]}",
            "polygon: [[-2, -2], [5, -2], [5, 2], [-2, 2]]", ", rate: 20"),
     {3, -9},
     {19, 9}},
    {"a circle as small as a point",
     SOURCE(FENCE, "point: [0.1, 0], radius: 0.01", ", rate: 2, even: true"),
     {0, -9},
     {9, 9}},
    {"people who are kept",
     SOURCE(ROOM, "polygon: [[-1, 2], [4, 2], [4, 8], [-1, 8]]", ", keep: 40"),
     {0, 0},
     {10, 10}},
};

static void nobody_comes_in_beyond_a_wall(void **state) {
    (void)state;
    for (size_t n = 0; n < sizeof SIDES / sizeof *SIDES; n++) {
        const Side *side = &SIDES[n];
        JoScene *scene = load_scene_text(side->yaml, STANDER);
        const JoxAgents *a = &scene->world->state.agents;
        for (int k = 0; k < 40; k++) {
            step_scene(scene, 1);
            for (uint32_t i = 0; i < a->count; i++)
                if (!jox_is_within(jox_v2(a->x[i], a->y[i]), side->low, side->high))
                    fail_msg("%s: person %u stands at %g, %g", side->name, a->id[i],
                             (double)a->x[i], (double)a->y[i]);
        }
        if (a->count < 2)
            fail_msg("%s: %u came", side->name, a->count);
        jo_scene_free(scene);
    }
}

/* A wall goes up across a source, then covers it, and goes down again. */
static void sources_respect_gates_that_open_and_close(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        SOURCE("{line: [[1, -30], [1, 30]], name: fence, open: true}, "
               "{solid: [[-4, -4], [4, -4], [4, 4], [-4, 4]], name: block, open: true}",
               "polygon: [[-2, -2], [2, -2], [2, 2], [-2, 2]]", ", rate: 2, even: true"),
        STANDER);
    const JoxAgents *a = &scene->world->state.agents;
    apply_input(scene, "close fence");
    step_scene(scene, 100); /* 5 s */
    assert_in_range(a->count, 9, 10);
    for (uint32_t i = 0; i < a->count; i++)
        assert_true(a->x[i] < 1.0f);
    apply_input(scene, "close block");
    step_scene(scene, 100);
    assert_in_range(a->count, 9, 11);
    assert_in_range((int)jox_source_waiting(scene->world, 0), 8, 11);
    apply_input(scene, "open block");
    step_scene(scene, 20);
    assert_in_range(a->count, 20, 22);
    assert_int_equal((int)jox_source_waiting(scene->world, 0), 0);
    jo_scene_free(scene);
}

/* ---- demand ---- */

/* A yard with room for some 20 people; a few more stand round it. */
#define YARD "polygon: [[0, 0], [1.8, 0], [1.8, 1.8], [0, 1.8]]"

static void people_who_did_not_come_are_counted(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text(SOURCE("", YARD, ", rate: 20, even: true, until: 10"), STANDER);
    JoxDemand demand;
    step_scene(scene, 21); /* the last begins at 1 s */
    demand = jox_run_demand(scene, 0);
    assert_int_equal(demand.due, 20);
    assert_int_equal(demand.entered + demand.waiting, 20);
    step_scene(scene, 400); /* to 21 s */
    demand = jox_run_demand(scene, 0);
    assert_int_equal(demand.due, 200);
    assert_int_equal(demand.entered, scene->world->state.agents.count);
    assert_int_equal(demand.waiting, 0); /* it ended at 10 s */
    assert_int_equal(demand.did_not_come, 200 - demand.entered);
    assert_in_range(demand.entered, 15, 60);
    jo_scene_free(scene);

    scene = load_scene_text(SOURCE("", YARD, ", keep: 50"), STANDER);
    step_scene(scene, 101);
    demand = jox_run_demand(scene, 0);
    assert_int_equal(demand.due, 50);
    assert_int_equal(demand.waiting, 50 - scene->world->state.agents.count);
    jo_scene_free(scene);

    scene = load_scene_text(
        SOURCE("", "polygon: [[0, 0], [9, 0], [9, 9], [0, 9]]", ", rate: 3, even: true, until: 9"),
        STANDER);
    step_scene(scene, 240); /* 12 s */
    demand = jox_run_demand(scene, 0);
    assert_int_equal(demand.due, 27);
    assert_int_equal(demand.entered, 27);
    assert_int_equal(demand.waiting, 0);
    jo_scene_free(scene);
}

/* The number of people due until `until` does not depend on the step. */
static void people_due_do_not_depend_on_the_step(void **state) {
    (void)state;
    static const char *const STEPS[] = {"step=0.01", "step=0.07", "step=0.1"};
    write_test_file("own.lua", STANDER);
    write_test_file("scene.yaml",
                    SOURCE("", "polygon: [[0, 0], [20, 0], [20, 20], [0, 20]]",
                           ", rate: 7, even: true, every: 2, people: 3, from: 1, until: "
                           "11, curve: [[0, 2], [20, 2]]"));
    for (int n = 0; n < 3; n++) {
        JoScene *scene = load_scene_file(test_path("scene.yaml"), &STEPS[n], 1);
        while (jo_world_time(scene->world) < 12.0)
            step_scene(scene, 1);
        assert_int_equal(jox_run_demand(scene, 0).entered, 70 + 20 + 15);
        jo_scene_free(scene);
    }
}

/* ---- arrivals ---- */

enum { STREAMS = 64, SEEDS = 40, TOTALS = STREAMS * SEEDS };

/* Counts arrivals in the first and in the second 6 s at sources that are walled off, so that
 * arrivals are counted as they wait. */
static void count_arrivals(const char *source, uint64_t seed, const char *length,
                           int half[2][STREAMS]) {
    char by_seed[40];
    snprintf(by_seed, sizeof by_seed, "seed=%d", (int)seed);
    const char *set[] = {by_seed, length};
    JoxText text = {0};
    jox_text_add(&text, "jostle: 1\nplaces: {door: {point: [0, 0], radius: 1}}\n"
                        "walls: [{solid: [[-3, -3], [3, -3], [3, 3], [-3, 3]], name: cover}]\n"
                        "groups: {people: {behaviour: own.lua, count: 0}}\nsources:\n");
    for (int s = 0; s < STREAMS; s++)
        jox_text_printf(&text, "  - {at: door, like: people, until: 12, %s}\n", source);
    write_test_file("own.lua", STANDER);
    write_test_file("scene.yaml", text.data);
    jox_text_free(&text);
    JoScene *scene = load_scene_file(test_path("scene.yaml"), set, 2);
    const int steps = (int)(6.0 / jo_scene_stats(scene).dt + 0.5);
    for (int h = 0; h < 2; h++) {
        step_scene(scene, h == 0 ? steps + 1 : steps);
        for (uint32_t s = 0; s < STREAMS; s++)
            half[h][s] = (int)jox_run_demand(scene, s).due - (h ? half[0][s] : 0);
    }
    assert_int_equal(scene->world->state.agents.count, 0);
    jo_scene_free(scene);
}

typedef struct Moments {
    double mean, variance, covariance; /* totals; covariance of the two halves */
} Moments;

static Moments measure_arrivals(const char *source) {
    double sum = 0.0, squares = 0.0, first = 0.0, second = 0.0, products = 0.0;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        int half[2][STREAMS];
        count_arrivals(source, seed, "step=0.1", half);
        for (int s = 0; s < STREAMS; s++) {
            const double a = half[0][s], b = half[1][s];
            sum += a + b;
            squares += (a + b) * (a + b);
            first += a, second += b, products += a * b;
        }
    }
    const double mean = sum / TOTALS;
    return (Moments){mean, squares / TOTALS - mean * mean,
                     products / TOTALS - first / TOTALS * (second / TOTALS)};
}

/* Bands of five standard errors. A Poisson total of mean m has the variance m. Over n runs its mean
 * has the standard error sqrt(m / n), its variance m sqrt((2 + 1 / m) / n), the covariance m / 2 /
 * sqrt n. */
static void arrivals_are_a_poisson_process(void **state) {
    (void)state;
    static const char *const SOURCES[] = {"rate: 2.5", "curve: [[0, 0], [6, 5], [12, 0]]",
                                          "rate: 1, curve: [[0, 1.5], [12, 1.5]]"};
    const double m = 30.0, n = TOTALS;
    for (int k = 0; k < 3; k++) {
        const Moments is = measure_arrivals(SOURCES[k]);
        if (fabs(is.mean - m) > 5 * sqrt(m / n) ||
            fabs(is.variance - m) > 5 * m * sqrt((2 + 1 / m) / n) ||
            fabs(is.covariance) > 5 * m / 2 / sqrt(n))
            fail_msg("%s: mean %g, variance %g, covariance %g", SOURCES[k], is.mean, is.variance,
                     is.covariance);
    }
    const Moments even = measure_arrivals("rate: 2.5, even: true");
    assert_true(even.mean == m && even.variance == 0.0);
}

static void arrivals_do_not_depend_on_the_step(void **state) {
    (void)state;
    int coarse[2][STREAMS], fine[2][STREAMS];
    count_arrivals("rate: 2.5", 7, "step=0.1", coarse);
    count_arrivals("rate: 2.5", 7, "step=0.01", fine);
    assert_memory_equal(coarse, fine, sizeof fine);
    count_arrivals("rate: 2.5", 8, "step=0.1", coarse);
    assert_memory_not_equal(coarse, fine, sizeof fine);
}

/* Arrivals at given times, and at once, are equal in number for each seed. */
static void timetables_are_exact(void **state) {
    (void)state;
    int half[2][STREAMS];
    for (uint64_t seed = 1; seed <= 3; seed++) {
        count_arrivals("every: 3, people: 4, times: [1, 7.5, 12]", seed, "step=0.1", half);
        for (int s = 0; s < STREAMS; s++) {
            assert_int_equal(half[0][s], 4 * 3 + 4); /* at 0, 3, 6 and 1 s */
            assert_int_equal(half[1][s], 4 + 4);     /* at 9 and 7.5 s, not at 12 */
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(nobody_comes_in_beyond_a_wall),
                                       cmocka_unit_test(sources_respect_gates_that_open_and_close),
                                       cmocka_unit_test(people_who_did_not_come_are_counted),
                                       cmocka_unit_test(people_due_do_not_depend_on_the_step),
                                       cmocka_unit_test(arrivals_are_a_poisson_process),
                                       cmocka_unit_test(arrivals_do_not_depend_on_the_step),
                                       cmocka_unit_test(timetables_are_exact)};
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
