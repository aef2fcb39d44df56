/* Ways while a scene runs: when a field takes effect, and that it follows gates and bodies. */
#include "unit/scene_loader.h"

/* A court, x from 0 to 10, with a near gap (y 2 to 4) and a far one (y 8 to 10) in the wall at x
 * = 6. */
#define COURT(near, more)                                                                          \
    "jostle: 1\n"                                                                                  \
    "places: {goal: {point: [9, 3], radius: 0.4}}\n"                                               \
    "walls:\n"                                                                                     \
    "  - {line: [[0, 0], [10, 0], [10, 11], [0, 11]], closed: true}\n"                             \
    "  - {line: [[6, 0], [6, 2]]}\n"                                                               \
    "  - {line: [[6, 4], [6, 8]]}\n"                                                               \
    "  - {line: [[6, 10], [6, 11]]}\n" near                                                        \
    "groups: {people: {behaviour: own.lua, at: [[2, 3]]}}\n" more
#define BLOCK                                                                                      \
    "bodies: [{name: block, shape: {box: {size: [1, 1.9, 1]}}, mass: 3000, at: [6, 3, 0.5]}]\n"
#define GATE "  - {line: [[6, 2], [6, 4]], name: gate}\n"
#define GOES HEAD "\"Go\", states = { Go = { steer = field \"goal\" } } }\n"
#define WAITS                                                                                      \
    HEAD "\"Wait\", states = { Wait = { steer = hold, { to = \"Go\", when = after(1) } },\n"       \
         "Go = { steer = field \"goal\" } } }\n"

enum { DELAY = 10 }; /* steps of 0.05 s: half a second */

static const JoxField *field(const JoScene *scene) {
    return scene->world->machines.fields ? scene->world->machines.fields[0] : NULL;
}

/* The way from where the agent began: north is positive. */
static float northward(const JoScene *scene) {
    return jox_field_direction(field(scene), (JoxV2){4.0f, 3.0f}).y;
}

static void known_from_the_first_step_on(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(COURT("", ""), GOES);
    step_scene(scene, 1);
    assert_non_null(field(scene));
    assert_float_equal(northward(scene), 0, 0.1);
    assert_true(scene->world->state.agents.pref_x[0] > 0.5f);
    jo_scene_free(scene);
}

static void used_from_a_fixed_step_on(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(COURT("", ""), WAITS);
    int waited = 0;
    const JoxMachineRun *machines = &scene->world->machines;
    while (strcmp(machines->set->items[0]->states[machines->agents->state[0]].name, "Go") != 0)
        step_scene(scene, 1);
    for (; !field(scene) && waited < 100; waited++) /* asked for in the step that ended */
        step_scene(scene, 1);
    assert_int_equal(waited, DELAY + 1);
    jo_scene_free(scene);
}

static void leads_round_what_stands_there(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoScene *scene = load_scene_text(COURT("", BLOCK), GOES);
    step_scene(scene, 1);
    assert_true(northward(scene) > 0.5f);
    /* The block is put elsewhere: within 2.5 s the way is the near one. */
    const double away[3] = {2, 9, 0.5};
    assert_true(jo_scene_throw(scene, "block", away, NULL, NULL, NULL));
    step_scene(scene, 20);
    assert_true(northward(scene) > 0.5f); /* 2 s between renewals have not passed */
    step_scene(scene, 35);
    assert_float_equal(northward(scene), 0, 0.1);
    jo_scene_free(scene);
}

static void renewed_at_most_every_two_seconds(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoScene *scene = load_scene_text(COURT("", BLOCK), GOES);
    int renewals = 0;
    step_scene(scene, 1);
    const JoxField *last = field(scene);
    for (int n = 0; n < 160; n++) { /* 8 s */
        const double at[3] = {2.0 + 0.01 * n, 9, 0.5};
        assert_true(jo_scene_throw(scene, "block", at, NULL, NULL, NULL));
        step_scene(scene, 1);
        renewals += field(scene) != last;
        last = field(scene);
    }
    assert_in_range(renewals, 2, 4);
    jo_scene_free(scene);
}

static void follows_a_gate(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(COURT(GATE, ""), GOES);
    step_scene(scene, 1);
    assert_true(northward(scene) > 0.5f);
    assert_true(jo_scene_open_wall(scene, "gate", true, NULL));
    step_scene(scene, DELAY);
    assert_true(northward(scene) > 0.5f);
    step_scene(scene, 1);
    assert_float_equal(northward(scene), 0, 0.1);
    assert_true(jo_scene_open_wall(scene, "gate", false, NULL));
    step_scene(scene, DELAY + 1);
    assert_true(northward(scene) > 0.5f);
    jo_scene_free(scene);
}

/* Only what somebody still asks for is made anew. */
static void not_renewed_for_nobody(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        COURT(GATE, ""), HEAD "\"Go\", states = { Go = { steer = field \"goal\", { to = \"Rest\", "
                              "when = after(0.2) } }, Rest = { steer = hold } } }\n");
    step_scene(scene, 20);
    const JoxField *first = field(scene);
    assert_true(jo_scene_open_wall(scene, "gate", true, NULL));
    step_scene(scene, 3 * DELAY);
    assert_ptr_equal(field(scene), first);
    jo_scene_free(scene);
}

/* Both gaps shut: who finds no way goes to the gate that could open, not straight to the wall. */
static void who_has_no_way_waits_at_the_gate(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        COURT("  - {line: [[6, 2], [6, 4]]}\n  - {line: [[6, 8], [6, 10]], name: gate}\n", ""),
        GOES);
    const JoxAgents *a = &scene->world->state.agents;
    step_scene(scene, 300);
    assert_float_equal(a->x[0], 5.8, 0.15);
    assert_in_range(a->y[0] * 100, 750, 1020);
    assert_true(jo_scene_open_wall(scene, "gate", true, NULL));
    step_scene(scene, 200);
    assert_true(jox_place_contains(scene->world->model.places, 0, (JoxV2){a->x[0], a->y[0]}));
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_from_the_first_step_on),
        cmocka_unit_test(used_from_a_fixed_step_on),
        cmocka_unit_test(leads_round_what_stands_there),
        cmocka_unit_test(renewed_at_most_every_two_seconds),
        cmocka_unit_test(follows_a_gate),
        cmocka_unit_test(not_renewed_for_nobody),
        cmocka_unit_test(who_has_no_way_waits_at_the_gate),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
