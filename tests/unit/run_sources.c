/* Sources: on which side of walls people come in, and how many of those who are due do. */
#include "unit/run_acted.h"

#define STANDER HEAD "\"Stand\", states = { Stand = { steer = hold } } }\n"
#define SOURCE(walls, place, more)                                                                 \
    "jostle: 1\nwalls: [" walls "]\nplaces: {door: {" place "}}\n"                                 \
    "groups: {people: {behaviour: own.lua, count: 0}}\n"                                           \
    "sources: [{at: door, like: people" more "}]\n"

/* ---- sides of walls ---- */

typedef struct Side {
    const char *name, *yaml;
    JoxV2 low, high; /* m: within which all come in */
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
     SOURCE(FENCE, "point: [0.1, 0], radius: 0.01", ", rate: 2"),
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
        JoScene *scene = load_own(side->yaml, STANDER);
        const JoxAgents *a = &scene->world->state.agents;
        for (int k = 0; k < 40; k++) {
            step(scene, 1);
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

/* A wall that goes up across a source, and all over it, and down again. */
static void sources_heed_gates_as_they_stand(void **state) {
    (void)state;
    JoScene *scene =
        load_own(SOURCE("{line: [[1, -30], [1, 30]], name: fence, open: true}, "
                        "{solid: [[-4, -4], [4, -4], [4, 4], [-4, 4]], name: block, open: true}",
                        "polygon: [[-2, -2], [2, -2], [2, 2], [-2, 2]]", ", rate: 2"),
                 STANDER);
    const JoxAgents *a = &scene->world->state.agents;
    does(scene, "close fence");
    step(scene, 100); /* 5 s */
    assert_in_range(a->count, 9, 10);
    for (uint32_t i = 0; i < a->count; i++)
        assert_true(a->x[i] < 1.0f);
    does(scene, "close block");
    step(scene, 100);
    assert_in_range(a->count, 9, 11);
    assert_in_range((int)jox_source_waiting(scene->world, 0), 8, 11);
    does(scene, "open block");
    step(scene, 20);
    assert_in_range(a->count, 20, 22);
    assert_int_equal((int)jox_source_waiting(scene->world, 0), 0);
    jo_scene_free(scene);
}

/* ---- demand ---- */

/* A yard for some 20 people; a few more stand about it. */
#define YARD "polygon: [[0, 0], [1.8, 0], [1.8, 1.8], [0, 1.8]]"

static void demand_that_is_not_met_is_counted(void **state) {
    (void)state;
    JoScene *scene = load_own(SOURCE("", YARD, ", rate: 20, until: 10"), STANDER);
    JoxDemand demand;
    step(scene, 21); /* the last begins at 1 s */
    demand = jox_run_demand(scene, 0);
    assert_int_equal(demand.due, 20);
    assert_int_equal(demand.came + demand.waiting, 20);
    step(scene, 400); /* to 21 s */
    demand = jox_run_demand(scene, 0);
    assert_int_equal(demand.due, 200);
    assert_int_equal(demand.came, scene->world->state.agents.count);
    assert_int_equal(demand.waiting, 200 - demand.came);
    assert_in_range(demand.came, 15, 60);
    jo_scene_free(scene);

    scene = load_own(SOURCE("", YARD, ", keep: 50"), STANDER);
    step(scene, 101);
    demand = jox_run_demand(scene, 0);
    assert_int_equal(demand.due, 50);
    assert_int_equal(demand.waiting, 50 - scene->world->state.agents.count);
    jo_scene_free(scene);

    scene = load_own(SOURCE("", "polygon: [[0, 0], [9, 0], [9, 9], [0, 9]]", ", rate: 3, until: 9"),
                     STANDER);
    step(scene, 240); /* 12 s */
    demand = jox_run_demand(scene, 0);
    assert_int_equal(demand.due, 27);
    assert_int_equal(demand.came, 27);
    assert_int_equal(demand.waiting, 0);
    jo_scene_free(scene);
}

/* What `until` ends does not depend on the step. */
static void people_due_do_not_depend_on_the_step(void **state) {
    (void)state;
    static const char *const STEPS[] = {"step=0.01", "step=0.07", "step=0.1"};
    write_file("own.lua", STANDER);
    write_file(
        "scene.yaml",
        SOURCE("", "polygon: [[0, 0], [20, 0], [20, 20], [0, 20]]",
               ", rate: 7, every: 2, people: 3, from: 1, until: 11, curve: [[0, 2], [20, 2]]"));
    for (int n = 0; n < 3; n++) {
        char path[300];
        snprintf(path, sizeof path, "%s/scene.yaml", folder);
        JoScene *scene = load(path, &STEPS[n], 1);
        while (jo_world_time(scene->world) < 12.0)
            step(scene, 1);
        assert_int_equal(jox_run_demand(scene, 0).came, 70 + 22 + 15);
        jo_scene_free(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(nobody_comes_in_beyond_a_wall),
                                       cmocka_unit_test(sources_heed_gates_as_they_stand),
                                       cmocka_unit_test(demand_that_is_not_met_is_counted),
                                       cmocka_unit_test(people_due_do_not_depend_on_the_step)};
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
