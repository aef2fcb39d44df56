/* Tests of routes in a running scene: when a field takes effect, and that it follows gates and
 * bodies. */
#include "unit/scene_loader.h"

/* A court with a wall at x = 6 m that has a near gap (y from 2 to 4) and a far one (y from 8 to
 * 10). */
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
#define GOES MACHINE_START "\"Go\", states = { Go = { steer = field \"goal\" } } }\n"
#define WAITS                                                                                      \
    MACHINE_START                                                                                  \
    "\"Wait\", states = { Wait = { steer = hold, { to = \"Go\", when = after(1) } },\n"            \
    "Go = { steer = field \"goal\" } } }\n"

enum { DELAY = 10 }; /* steps of 0.05 s: half a second */

static const JoxField *find_route_field(const JoScene *scene) {
    return scene->world->machines.fields ? scene->world->machines.fields[0] : NULL;
}

/* Returns the y component of the route's direction at the start of the agent. */
static float read_north_component(const JoScene *scene) {
    return jox_field_direction(find_route_field(scene), (JoxV2){4.0f, 3.0f}).y;
}

static void route_to_a_known_goal_exists_from_the_first_step(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(COURT("", ""), GOES);
    step_scene(scene, 1);
    assert_non_null(find_route_field(scene));
    assert_float_equal(read_north_component(scene), 0, 0.1);
    assert_true(scene->world->state.agents.pref_x[0] > 0.5f);
    jo_scene_free(scene);
}

/* Fields are kept by place, whoever asks for them. */
static void groups_bound_for_one_place_share_its_field(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text("jostle: 1\n"
                        "places: {goal: {point: [9, 3], radius: 0.4}, elsewhere: {point: [1, 9]}}\n"
                        "walls: [{line: [[0, 0], [10, 0], [10, 11], [0, 11]], closed: true}]\n"
                        "groups:\n"
                        "  left: {behaviour: own.lua, at: [[2, 3]]}\n"
                        "  right: {behaviour: own.lua, at: [[2, 6]], set: {radius: 0.3}}\n",
                        GOES);
    step_scene(scene, 1);
    uint32_t made = 0;
    for (uint32_t k = 0; k < 2 * JOX_ROUTE_KINDS; k++)
        made += scene->world->machines.fields[k] != NULL;
    assert_int_equal(scene->world->state.agents.count, 2);
    assert_int_equal(made, 1);
    jo_scene_free(scene);
}

static void new_route_is_used_from_a_fixed_step_on(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(COURT("", ""), WAITS);
    int waited = 0;
    const JoxMachineRun *machines = &scene->world->machines;
    while (strcmp(machines->set->items[0]->states[machines->agents->state[0]].name, "Go") != 0)
        step_scene(scene, 1);
    for (; !find_route_field(scene) && waited < 100; waited++) /* requested in the step before */
        step_scene(scene, 1);
    assert_int_equal(waited, DELAY + 1);
    jo_scene_free(scene);
}

static void route_leads_round_standing_bodies(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoScene *scene = load_scene_text(COURT("", BLOCK), GOES);
    step_scene(scene, 1);
    assert_true(read_north_component(scene) > 0.5f);
    /* Once the block is moved away, the route leads through the near gap within 2.5 s. */
    const double away[3] = {2, 9, 0.5};
    assert_true(jo_scene_throw(scene, "block", away, NULL, NULL, NULL));
    step_scene(scene, 20);
    assert_true(read_north_component(scene) > 0.5f); /* 2 s between renewals have not passed */
    step_scene(scene, 35);
    assert_float_equal(read_north_component(scene), 0, 0.1);
    jo_scene_free(scene);
}

static void route_is_renewed_at_most_every_two_seconds(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoScene *scene = load_scene_text(COURT("", BLOCK), GOES);
    int renewals = 0;
    step_scene(scene, 1);
    const JoxField *last = find_route_field(scene);
    for (int n = 0; n < 160; n++) { /* 8 s */
        const double at[3] = {2.0 + 0.01 * n, 9, 0.5};
        assert_true(jo_scene_throw(scene, "block", at, NULL, NULL, NULL));
        step_scene(scene, 1);
        renewals += find_route_field(scene) != last;
        last = find_route_field(scene);
    }
    assert_in_range(renewals, 2, 4);
    jo_scene_free(scene);
}

static void route_follows_a_gate(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(COURT(GATE, ""), GOES);
    step_scene(scene, 1);
    assert_true(read_north_component(scene) > 0.5f);
    assert_true(jo_scene_open_wall(scene, "gate", true, NULL));
    step_scene(scene, DELAY);
    assert_true(read_north_component(scene) > 0.5f);
    step_scene(scene, 1);
    assert_float_equal(read_north_component(scene), 0, 0.1);
    assert_true(jo_scene_open_wall(scene, "gate", false, NULL));
    step_scene(scene, DELAY + 1);
    assert_true(read_north_component(scene) > 0.5f);
    jo_scene_free(scene);
}

/* Only routes that agents still use are renewed. */
static void unused_route_is_not_renewed(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text(COURT(GATE, ""), MACHINE_START
                        "\"Go\", states = { Go = { steer = field \"goal\", { to = \"Rest\", "
                        "when = after(0.2) } }, Rest = { steer = hold } } }\n");
    step_scene(scene, 20);
    const JoxField *first = find_route_field(scene);
    assert_true(jo_scene_open_wall(scene, "gate", true, NULL));
    step_scene(scene, 3 * DELAY);
    assert_ptr_equal(find_route_field(scene), first);
    jo_scene_free(scene);
}

/* With both gaps closed, an agent goes to the gate that could open, not straight to the wall. */
static void agent_without_a_way_waits_at_the_gate(void **state) {
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
        cmocka_unit_test(route_to_a_known_goal_exists_from_the_first_step),
        cmocka_unit_test(groups_bound_for_one_place_share_its_field),
        cmocka_unit_test(new_route_is_used_from_a_fixed_step_on),
        cmocka_unit_test(route_leads_round_standing_bodies),
        cmocka_unit_test(route_is_renewed_at_most_every_two_seconds),
        cmocka_unit_test(route_follows_a_gate),
        cmocka_unit_test(unused_route_is_not_renewed),
        cmocka_unit_test(agent_without_a_way_waits_at_the_gate),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
