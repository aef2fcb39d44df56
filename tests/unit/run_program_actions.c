/* Tests of jostle_act.h, by which a program acts on a running scene: each call has its effect, or
 * is refused with a reason, and plays back from the input log to the same state. */
#include <math.h>

#include "unit/gate_ball_scene.h"

#define OWN                                                                                        \
    "local mine = memory { met = false, hits = 0 }\n" MACHINE_START                                \
    "\"Walk\", defaults = { speed = normal(1.2, 0.2) }, states = {\n"                              \
    "  Walk = { steer = seek(own.goal), { to = \"Rest\", when = mine.hits:above(2) } },\n"         \
    "  Rest = { steer = hold, set = { met = true } },\n"                                           \
    "  Left = { removes = true } } }\n"
#define WESTWARD                                                                                   \
    "groups: {people: {behaviour: own.lua, at: [[0, 0], [1, 0.1], [2, -0.3], [3, 0.2]],"           \
    " set: {mass: 80, goal: west}}}\n"
#define PLACES "places: {west: {point: [-20, 0]}, east: {point: [20, 0]}}\n"

static JoScene *scene;
static JoWorld *world;
static JoError error;

static void load_acted_scene(void) {
    scene = load_scene_text(
        jox_bodies_available() ? GATE_AND_BODIES PLACES WESTWARD : GATE_ALONE PLACES WESTWARD, OWN);
    world = jo_scene_world(scene);
    error = (JoError){0};
}

static JoAgent find_agent_by_rank(uint32_t rank) {
    JoAgent all[16];
    assert_true(rank < jo_world_agents(world, all, 16));
    return all[rank];
}

#define REFUSED(call, because)                                                                     \
    do {                                                                                           \
        const uint64_t refused_before = jo_world_hash(world);                                      \
        error = (JoError){0};                                                                      \
        assert_false(call);                                                                        \
        if (!strstr(error.text, because))                                                          \
            fail_msg("%s: not '%s'", error.text, because);                                         \
        assert_int_equal(error.code, JO_INPUT);                                                    \
        assert_true(refused_before == jo_world_hash(world));                                       \
    } while (0)

static void adds_and_moves_people(void **state) {
    (void)state;
    load_acted_scene();
    JoAgent one = jo_world_spawn(world, "people", 5, 2, &error);
    assert_true(jo_agent_is_live(world, one));
    assert_int_equal(jo_agent_state(world, one).id, 4);
    assert_string_equal(jo_agent_state(world, one).state, "Walk");
    double mass;
    assert_true(jo_agent_parameter(world, one, "mass", &mass) &&
                mass == 80.0); /* set by its group */
    JoAgent crowded = jo_world_spawn(world, "people", 5, 2, &error);
    step_scene(scene, 1);
    const JoAgentState a = jo_agent_state(world, one), b = jo_agent_state(world, crowded);
    assert_true(hypot(a.x - b.x, a.y - b.y) > 0.25); /* the second was put beside the first */
    assert_true(jo_agent_teleport(world, one, 12, -3, &error));
    assert_true(jo_agent_state(world, one).x == 12.0 && jo_agent_state(world, one).vx == 0.0);
    assert_true(jo_agent_teleport(world, crowded, 30, 0, &error)); /* in a wall: beside it */
    assert_true(fabs(jo_agent_state(world, crowded).x - 30.0) > 0.19);
    step_scene(scene, 20);
    assert_true(jo_agent_state(world, one).x < 11.5); /* walks to the west */
    jo_world_remove_agent(world, one);
    assert_false(jo_agent_is_live(world, one));
    assert_int_equal(jo_world_agent_count(world), 5);
    step_scene(scene, 5);
    jo_scene_free(scene);
}

static void sets_goals_parameters_memory_and_states(void **state) {
    (void)state;
    load_acted_scene();
    step_scene(scene, 10);
    const JoAgent one = find_agent_by_rank(0),
                  two = find_agent_by_rank(3); /* agents without followers */
    double value;
    assert_true(jo_agent_state(world, one).vx < 0.0);
    assert_true(jo_agent_teleport(world, one, 0, -9, &error)); /* out of the others' way */
    assert_true(jo_agent_set_goal(world, one, "east", &error));
    assert_true(jo_agent_set_parameter(world, two, "speed", 0.5, &error));
    step_scene(scene, 60);
    assert_true(jo_agent_state(world, one).vx > 0.0);
    assert_true(fabs(jo_agent_state(world, two).vx + 0.5) < 0.05);
    assert_true(jo_agent_set_memory(world, two, "hits", 3, &error));
    assert_true(jo_agent_memory(world, two, "hits", &value) && value == 3.0);
    step_scene(scene, 1);
    assert_string_equal(jo_agent_state(world, two).state, "Rest");
    assert_true(jo_agent_memory(world, two, "met", &value) && value == 1.0);
    assert_true(jo_agent_set_state(world, one, "Rest", &error));
    assert_string_equal(jo_agent_state(world, one).state, "Rest");
    assert_true(jo_agent_memory(world, one, "met", &value) && value == 0.0);
    step_scene(scene, 1); /* on_enter runs in the next step */
    assert_true(jo_agent_memory(world, one, "met", &value) && value == 1.0);
    assert_true(jo_agent_set_state(world, one, "Left", &error));
    step_scene(scene, 1);
    assert_false(jo_agent_is_live(world, one));
    jo_scene_free(scene);
}

static void refused_calls_change_nothing(void **state) {
    (void)state;
    load_acted_scene();
    step_scene(scene, 2);
    const JoAgent one = find_agent_by_rank(0), gone = find_agent_by_rank(3), none = {0};
    jo_world_remove_agent(world, gone);
    REFUSED(jo_world_spawn(world, "peple", 1, 1, &error).generation, "Did you mean 'people'?");
    REFUSED(jo_world_spawn(world, "people", NAN, 1, &error).generation, "X of 'spawn'");
    REFUSED(jo_world_spawn(world, "people", 1, 2e4, &error).generation, "10000 m");
    REFUSED(jo_agent_teleport(world, gone, 1, 1, &error), "no agent");
    REFUSED(jo_agent_teleport(world, none, 1, 1, &error), "no agent");
    REFUSED(jo_agent_teleport(world, one, INFINITY, 1, &error), "10000");
    REFUSED(jo_agent_set_goal(world, one, "easst", &error), "Did you mean 'east'?");
    REFUSED(jo_agent_set_state(world, one, "Wlk", &error), "Did you mean 'Walk'?");
    REFUSED(jo_agent_set_state(world, one, "", &error), "from 1 to 120 bytes");
    REFUSED(jo_agent_set_memory(world, one, "hit", 1, &error), "Did you mean 'hits'?");
    REFUSED(jo_agent_set_memory(world, one, "hits", NAN, &error), "VALUE");
    REFUSED(jo_agent_set_memory(world, one, "met", 0.5, &error), "true or false");
    REFUSED(jo_agent_set_parameter(world, one, "sped", 1, &error), "Did you mean 'speed'?");
    REFUSED(jo_agent_set_parameter(world, one, "mass", -1, &error), "mass must be from");
    REFUSED(jo_body_remove(world, (JoBody){0, 77}, &error), "no body");
    REFUSED(jo_world_add_wall(world, "w", (double[]){0, 0, 1, 1, 2, 2}, 3, &error), "2 or 4");
    REFUSED(jo_world_add_wall(world, "w", (double[]){1, 1, 1, 1}, 2, &error), "apart");
    REFUSED(jo_world_add_wall(world, "w", (double[]){0, 0, 1, 1, 1, 0, 0, 1}, 4, &error), "cross");
    REFUSED(jo_world_remove_wall(world, "gate", &error), "was added");
    REFUSED(jo_world_open_wall(world, "gat", true, &error), "Did you mean 'gate'?");
    /* A handle from another scene, whose agent has the same slot. */
    JoWorldDef def = jo_default_world_def();
    JoWorld *other = jo_world_create(&def, NULL);
    REFUSED(jo_world_spawn(other, "people", 0, 0, &error).generation, "there is no group");
    JoAgentDef person = jo_default_agent_def();
    const JoAgent stranger = jo_world_add_agent(other, &person, &error);
    REFUSED(jo_agent_set_state(other, stranger, "Walk", &error), "no behaviour");
    jo_world_free(other);
    jo_scene_free(scene);
}

static void pushes_and_places_bodies(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    load_acted_scene();
    step_scene(scene, 1);
    const JoBody ball = jo_world_find_body(world, "ball"),
                 pillar = jo_world_find_body(world, "pillar");
    assert_true(jo_body_is_live(world, ball) && jo_body_is_live(world, pillar));
    assert_int_equal(jo_world_find_body(world, "bal").generation, 0);
    assert_true(
        jo_body_impulse(world, ball, (double[]){3, 0, 0}, NULL, &error)); /* the ball has 1 kg */
    assert_true(fabs(jo_body_state(world, ball).vx - 3.0) < 1e-5);
    assert_true(jo_body_place(world, ball, (double[]){10, 4, 1}, NULL, &error));
    assert_true(jo_body_state(world, ball).x == 10.0 && jo_body_state(world, ball).vx == 0.0);
    assert_true(jo_body_set_velocity(world, ball, (double[]){0, 2, 0}, NULL, &error));
    step_scene(scene, 2);
    assert_true(fabs(jo_body_state(world, ball).y - 4.2) < 0.02);
    assert_true(jo_body_place(world, pillar, (double[]){2, 9, 1}, (double[]){0, 0, 0.6, 0.8},
                              &error)); /* static bodies, too */
    assert_true(fabs(jo_body_state(world, pillar).qz - 0.6) < 1e-5);
    REFUSED(jo_body_impulse(world, pillar, (double[]){3, 0, 0}, NULL, &error), "static");
    REFUSED(jo_body_impulse(world, ball, (double[]){NAN, 0, 0}, NULL, &error), "IX");
    REFUSED(jo_body_place(world, ball, (double[]){0, 0, 1}, (double[]){0, 0, 0, 0.5}, &error),
            "unit quaternion");
    REFUSED(jo_body_set_velocity(world, ball, (double[]){0, 0, 101}, NULL, &error), "100 m/s");
    assert_true(jo_body_remove(world, ball, &error));
    assert_false(jo_body_is_live(world, ball));
    REFUSED(jo_body_remove(world, ball, &error), "no body");
    step_scene(scene, 2);
    jo_scene_free(scene);
}

static void adds_and_removes_walls(void **state) {
    (void)state;
    load_acted_scene();
    step_scene(scene, 5);
    const JoAgent first = find_agent_by_rank(0); /* goes west, from about x = 0 */
    assert_true(jo_world_add_wall(world, "block", (double[]){-2, -9, -2, 9}, 2, &error));
    step_scene(scene, 80);
    assert_true(jo_agent_state(world, first).x > -2.0);
    assert_true(jo_world_open_wall(world, "block", true, &error));
    step_scene(scene, 40);
    assert_true(jo_agent_state(world, first).x < -2.0);
    assert_true(
        jo_world_add_wall(world, "solid", (double[]){-60, -9, -4, -9, -4, 9, -60, 9}, 4, &error));
    step_scene(scene, 1); /* moves out the agent that stood there */
    assert_true(jo_agent_state(world, first).x > -4.0);
    assert_true(jo_world_remove_wall(world, "solid", &error) &&
                jo_world_remove_wall(world, "block", &error));
    step_scene(scene, 40);
    assert_true(jo_agent_state(world, first).x < -4.0);
    jo_scene_free(scene);
}

/* A snapshot holds added walls, and whether gates are open. */
static void snapshot_holds_added_walls(void **state) {
    (void)state;
    scene = load_scene_text(GATE_ALONE PLACES WESTWARD, OWN);
    world = jo_scene_world(scene);
    JoxText empty = {0}, walled = {0};
    assert_true(jox_world_snapshot(world, &empty, &error));
    assert_true(jo_world_add_wall(world, "a", (double[]){-1, -9, -1, 9}, 2, &error) &&
                jo_world_add_wall(world, "b", (double[]){-2, -9, -2, 9}, 2, &error) &&
                jo_world_open_wall(world, "a", true, &error));
    step_scene(scene, 3);
    assert_true(jox_world_snapshot(world, &walled, &error));
    const uint64_t then = jo_world_hash(world);
    step_scene(scene, 30);
    const uint64_t later = jo_world_hash(world);
    assert_true(jox_world_restore(world, empty.data, empty.length, &error));
    assert_int_equal(world->model.all_walls.ring_count, 1);
    assert_true(jox_world_restore(world, walled.data, walled.length, &error));
    assert_true(jo_world_hash(world) == then);
    step_scene(scene, 30);
    assert_true(jo_world_hash(world) == later);
    jox_text_free(&empty);
    jox_text_free(&walled);
    jo_scene_free(scene);
}

static void logged_calls_play_back_to_the_same_state(void **state) {
    (void)state;
    const char *log = test_path("acts.input");
    load_acted_scene();
    assert_true(jo_scene_log_input(scene, log, &error));
    step_scene(scene, 3);
    const JoAgent added = jo_world_spawn(world, "people", 4.1, 3.7, &error);
    assert_true(jo_agent_set_goal(world, added, "east", &error));
    assert_true(jo_agent_teleport(world, find_agent_by_rank(1), 9.3, 1.0 / 3.0, &error));
    jo_agent_apply_force(world, find_agent_by_rank(0), 120.5, -33);
    step_scene(scene, 4);
    assert_true(jo_agent_set_parameter(world, added, "speed", 0.7, &error) &&
                jo_agent_set_memory(world, find_agent_by_rank(2), "hits", 3, &error) &&
                jo_agent_set_state(world, find_agent_by_rank(3), "Rest", &error) &&
                jo_world_add_wall(world, "a wall", (double[]){12, -4, 12, 4}, 2, &error) &&
                jo_world_signal(world, "go", &error));
    if (jox_bodies_available()) {
        const JoBody ball = jo_world_find_body(world, "ball");
        assert_true(
            jo_body_place(world, ball, (double[]){6, 1, 1.5}, NULL, &error) &&
            jo_body_impulse(world, ball, (double[]){-3, 0.1, 0}, (double[]){6, 1, 1.6}, &error) &&
            jo_body_remove(world, jo_world_find_body(world, "pillar"), &error));
    }
    step_scene(scene, 20);
    jo_world_remove_agent(world, find_agent_by_rank(0));
    assert_true(jo_world_remove_wall(world, "a wall", &error));
    step_scene(scene, 10);
    const uint64_t hash = jo_world_hash(world);
    assert_true(jo_scene_finish(scene, &error));
    jo_scene_free(scene);
    JoSceneDef def = define_scene(test_path("scene.yaml"));
    def.input_log = log;
    def.threads = 2;
    scene = load_defined_scene(&def);
    step_scene(scene, 37);
    assert_true(jo_world_hash(jo_scene_world(scene)) == hash);
    jo_scene_free(scene);
    assert_int_equal(remove(log), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(adds_and_moves_people),
        cmocka_unit_test(sets_goals_parameters_memory_and_states),
        cmocka_unit_test(refused_calls_change_nothing),
        cmocka_unit_test(pushes_and_places_bodies),
        cmocka_unit_test(adds_and_removes_walls),
        cmocka_unit_test(snapshot_holds_added_walls),
        cmocka_unit_test(logged_calls_play_back_to_the_same_state),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
