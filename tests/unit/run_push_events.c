/* Tests of pushes as events of scenes: which agents they reach, and how long they last. */
#include <math.h>

#include "unit/scene_loader.h"

#define STAY MACHINE_START "\"A\", states = { A = { steer = hold } } }\n"
#define PUSHED(list)                                                                               \
    "jostle: 1\nforces: {enabled: true}\n"                                                         \
    "places: {stand: {polygon: [[-1, -1], [1, -1], [1, 1], [-1, 1]]}}\n"                           \
    "bodies: [{name: crate, shape: {box: {size: [1, 1, 1]}}, mass: 20, at: [5, 5, 0.5], "          \
    "friction: 0},\n"                                                                              \
    "  {name: rock, shape: {box: {size: [1, 1, 1]}}, mass: 0, at: [20, 20, 0.5]}]\n"               \
    "groups: {people: {behaviour: own.lua, at: [[0, 0], [9, 0]]}}\n"                               \
    "events:\n" list

static float read_force(const JoScene *scene, uint32_t id) {
    const JoxAgents *a = &scene->world->state.agents;
    return a->last_ext_x[jox_agents_find(a, id)];
}

static void push_acts_on_agents_in_its_place_while_it_lasts(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text(PUSHED("  - {at: 0.1, push: stand, force: [100, 0], lasts: 0.15}\n"), STAY);
    const float wanted[8] = {0, 0, 100, 100, 100, 0, 0, 0}; /* steps of 0.05 s */
    for (int n = 0; n < 8; n++) {
        step_scene(scene, 1);
        assert_float_equal(read_force(scene, 0), wanted[n], 0);
        assert_float_equal(read_force(scene, 1), 0, 0);
    }
    const JoxAgents *a = &scene->world->state.agents;
    assert_true(a->x[jox_agents_find(a, 0)] > 0.01f);
    jo_scene_free(scene);
}

static void pushes_repeat_and_add_up(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        PUSHED("  - {at: 0, every: 0.2, until: 0.3, push: stand, force: [10, 0], lasts: 0.1}\n"
               "  - {at: 0.05, push: stand, force: [1, 0], lasts: 0.2}\n"),
        STAY);
    const float wanted[8] = {10, 11, 1, 1, 11, 10, 0, 0};
    for (int n = 0; n < 8; n++) {
        step_scene(scene, 1);
        assert_float_equal(read_force(scene, 0), wanted[n], 0);
    }
    jo_scene_free(scene);
}

/* 40 N for 1 s on 20 kg without friction. */
static void pushed_body_gains_the_momentum(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoScene *scene =
        load_scene_text(PUSHED("  - {at: 0.5, push: crate, force: [0, 40], lasts: 1}\n"), STAY);
    JoxBodies *bodies = scene->world->state.bodies;
    JoxPose pose;
    step_scene(scene, 40);
    assert_true(jox_bodies_pose(bodies, jox_bodies_find_name(bodies, "crate"), &pose));
    assert_float_equal(pose.velocity.y, 2.0, 0.1);
    assert_float_equal(pose.velocity.x, 0.0, 1e-3);
    assert_float_equal(pose.spin.z, 0.0, 0.05);
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(push_acts_on_agents_in_its_place_while_it_lasts),
        cmocka_unit_test(pushes_repeat_and_add_up),
        cmocka_unit_test(pushed_body_gains_the_momentum),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
