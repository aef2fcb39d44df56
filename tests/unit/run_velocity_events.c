/* Tests of events that set the velocity of kinematic bodies. */
#include <math.h>

#include "unit/scene_loader.h"

#define STAY MACHINE_START "\"A\", states = { A = { steer = hold } } }\n"
#define EVENTS(list)                                                                               \
    "jostle: 1\ngroups: {people: {behaviour: own.lua, at: [[0, 0]]}}\nevents:\n" list

static void event_sets_velocity_of_kinematic_body(void **state) {
    (void)state;
    if (!jox_bodies_available())
        return;
    JoScene *scene =
        load_scene_text(EVENTS("  - {at: 1, move: lift, velocity: [0, 0, 0.5]}\n"
                               "  - {at: 3, move: lift, velocity: [0, 0, 0], spin: [0, 0, "
                               "1]}\n") "bodies:\n  - {name: lift, shape: {box: {size: [2, "
                                        "2, 0.2]}}, kinematic: true, at: [0, 9, 1],\n"
                                        "     path: {through: [[0, 20, 1]], speed: 1, after: "
                                        "2}}\n",
                        STAY);
    JoxPose pose;
    step_scene(scene, 20);
    jox_bodies_pose(scene->world->state.bodies, 0, &pose);
    assert_float_equal(pose.position.z, 1.0, 1e-4);
    step_scene(scene, 20);
    jox_bodies_pose(scene->world->state.bodies, 0, &pose);
    assert_float_equal(pose.position.z, 1.5, 1e-3);
    assert_float_equal(pose.velocity.z, 0.5, 1e-6);
    step_scene(scene, 60); /* it left its path, and stands still from 3 s on */
    jox_bodies_pose(scene->world->state.bodies, 0, &pose);
    assert_float_equal(pose.position.z, 2.0, 1e-3);
    assert_float_equal(pose.position.y, 9.0, 1e-4);
    assert_float_equal(pose.spin.z, 1.0, 1e-6);
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(event_sets_velocity_of_kinematic_body)};
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
