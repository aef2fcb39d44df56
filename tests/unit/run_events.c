/* Tests of the events of scenes: their times, their effects, and that an edited scene keeps the
 * effects. */
#include <math.h>

#include "unit/scene_loader.h"

#define STAY MACHINE_START "\"A\", states = { A = { steer = hold } } }\n"
#define EVENTS(list)                                                                               \
    "jostle: 1\nwalls: [{line: [[5, -5], [5, 5]], name: gate}]\n"                                  \
    "groups: {people: {behaviour: own.lua, at: [[0, 0], [90, 90]]}}\n"                             \
    "events:\n" list

static JoxStatistics *read_event_counts(JoScene *scene) {
    return &scene->world->state.statistics;
}

static bool is_gate_open(const JoScene *scene) {
    return scene->world->model.all_walls.rings[0].open;
}

/* ---- times ---- */

static void events_happen_at_their_times(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(EVENTS("  - {at: 0, signal: a}\n"
                                            "  - {at: 0.1, every: 0.1, until: 0.3, signal: b}\n"
                                            "  - {at: 0.12, signal: c}\n"),
                                     STAY);
    const uint64_t wanted[12] = {1, 1, 2, 3, 4, 4, 5, 5, 5, 5, 5, 5}; /* steps of 0.05 s */
    for (int n = 0; n < 12; n++) {
        step_scene(scene, 1);
        assert_int_equal(read_event_counts(scene)->announced, wanted[n]);
    }
    jo_scene_free(scene);
}

static void events_between_two_steps_all_happen(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text(EVENTS("  - {at: 0, every: 0.01, until: 0.11, signal: a}\n"), STAY);
    const uint64_t wanted[5] = {1, 6, 11, 12, 12};
    for (int n = 0; n < 5; n++) {
        step_scene(scene, 1);
        assert_int_equal(read_event_counts(scene)->announced, wanted[n]);
    }
    jo_scene_free(scene);
}

static void event_in_every_step_happens_once_a_step(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(EVENTS("  - {at: 0.05, every: 0.05, signal: a}\n"
                                            "  - {at: 0.7, every: 0.3, signal: a}\n"),
                                     STAY);
    step_scene(scene, 2001); /* up to 100 s: sums of rounded times neither miss one nor repeat it */
    assert_int_equal(read_event_counts(scene)->announced, 2000 + 332);
    jo_scene_free(scene);
}

static void events_are_ordered_by_time_then_by_list(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(EVENTS("  - {at: 0.04, close: gate}\n"
                                            "  - {at: 0.02, open: gate}\n"
                                            "  - {at: 0.2, close: gate}\n"
                                            "  - {at: 0.2, open: gate}\n"),
                                     STAY);
    step_scene(scene, 2);
    assert_int_equal(read_event_counts(scene)->opened + read_event_counts(scene)->closed, 2);
    assert_false(is_gate_open(scene));
    step_scene(scene, 3);
    assert_true(is_gate_open(scene));
    jo_scene_free(scene);
}

/* ---- signals ---- */

static void signal_reaches_everybody(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text(EVENTS("  - {at: 0.2, signal: alarm}\n"), MACHINE_START
                        "\"Z\", defaults = { perception = 1 }, states = { Z = { steer = hold, "
                        "{ to = \"B\", when = heard(\"alarm\", 0.5) } }, B = { steer = hold, "
                        "{ to = \"Z\", when = heard \"alarm\" } } } }\n");
    const JoxAgents *a = &scene->world->state.agents;
    step_scene(scene, 4);
    uint16_t waits = a->state[0];
    assert_int_equal(a->state[1], waits);
    step_scene(scene, 1); /* the step whose time is 0.2 s */
    assert_true(a->state[0] != waits && a->state[1] != waits);
    step_scene(scene, 5); /* heard once, in one step */
    assert_true(a->state[0] != waits && a->state[1] != waits);
    assert_true(jo_scene_signal(scene, "alarm", NULL));
    step_scene(scene, 1);
    assert_true(a->state[0] == waits && a->state[1] == waits);
    jo_scene_free(scene);
}

static void unheard_signals_are_warned_of(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(EVENTS("  - {at: 1, signal: alarms}\n"), MACHINE_START
                                     "\"A\", states = { A = { steer = hold, { to = \"A\", when = "
                                     "heard \"alarm\" } } } }\n");
    assert_non_null(strstr(scene_messages.data, "scene.yaml:5:21: warning: "));
    assert_non_null(strstr(scene_messages.data, "Did you mean 'alarm'?"));
    jo_scene_free(scene);
    scene = load_scene_text(EVENTS("  - {at: 1, signal: alarm}\n"), MACHINE_START
                            "\"A\", states = { A = { steer = hold, { to = \"A\", when = "
                            "heard \"alarm\" } } } }\n");
    assert_null(scene_messages.data); /* a signal of the scene that a machine hears */
    jo_scene_free(scene);
}

/* ---- walls ---- */

#define WALK                                                                                       \
    MACHINE_START                                                                                  \
    "\"A\", defaults = { speed = 1.3, max_speed = 1.5 }, states = { A = { steer = drift(1, "       \
    "0) "                                                                                          \
    "} } }\n"

static void closed_gate_is_not_passed(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(EVENTS("  - {at: 8, open: gate}\n"), WALK);
    const JoxAgents *a = &scene->world->state.agents;
    step_scene(scene, 160);
    assert_float_equal(a->x[0], 4.875, 0.01); /* half the depth of a torso */
    step_scene(scene, 40);
    assert_true(a->x[0] > 6.0f);
    jo_scene_free(scene);
}

static void walls_may_begin_open(void **state) {
    (void)state;
    JoScene *scene = load_scene_text("jostle: 1\n"
                                     "walls: [{line: [[2, -5], [2, 5]], name: a, open: true},\n"
                                     "        {line: [[4, -5], [4, 5]], name: b, open: true},\n"
                                     "        {line: [[6, -5], [6, 5]], name: b, open: true}]\n"
                                     "groups: {people: {behaviour: own.lua, at: [[0, 0]]}}\n"
                                     "events: [{at: 2.6, close: b}]\n",
                                     WALK);
    step_scene(scene, 200);
    assert_float_equal(scene->world->state.agents.x[0], 3.875, 0.01); /* one name shuts two walls */
    assert_int_equal(scene->world->scratch.walls.ring_count, 2);
    jo_scene_free(scene);
}

static void agent_in_the_way_of_a_wall_is_moved(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        "jostle: 1\n"
        "walls: [{solid: [[4, -2], [6, -2], [6, 2], [4, 2]], name: block, open: true}]\n"
        "groups: {people: {behaviour: own.lua, at: [[5, 0], [5.5, 1], [4.1, -1.9], [9, "
        "0], [3.8, 0]]}}\n"
        "events: [{at: 0.2, close: block}]\n",
        STAY);
    const JoxAgents *a = &scene->world->state.agents;
    step_scene(scene, 4);
    assert_int_equal(read_event_counts(scene)->moved_out, 0);
    step_scene(scene, 1);
    assert_int_equal(read_event_counts(scene)->moved_out, 3);
    for (uint32_t id = 0; id < 5; id++) {
        uint32_t i = jox_agents_find(a, id);
        float dx = fabsf(a->x[i] - 5.0f) - 1.0f, dy = fabsf(a->y[i]) - 2.0f;
        assert_true(dx > 0.19f || dy > 0.19f);
    }
    uint32_t far = jox_agents_find(a, 3), beside = jox_agents_find(a, 4);
    assert_true(a->x[far] == 9.0f && a->y[far] == 0.0f);
    assert_float_equal(a->x[beside], 3.8, 0.01);
    jo_scene_free(scene);
}

/* Agents are sorted again in the same step, so that neighbours of the new spot see the agent. */
static void moved_agent_is_seen_in_the_same_step(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        "jostle: 1\n"
        "walls: [{solid: [[3, -3], [7, -3], [7, 3], [3, 3]], name: block, open: true}]\n"
        "groups: {people: {behaviour: own.lua, at: [[5, 0], [1.6, 0], [8.4, 0]]}}\n"
        "events: [{at: 0.25, close: block}]\n",
        MACHINE_START
        "\"A\", defaults = { perception = 2.5 }, states = { A = { steer = hold } } }\n");
    const JoxAgents *a = &scene->world->state.agents;
    const JoxNeighbours *n = &scene->world->scratch.neighbours;
    step_scene(scene, 5); /* every fourth step sorts anyway; the next does not */
    assert_int_equal(n->count[jox_agents_find(a, 1)] + n->count[jox_agents_find(a, 2)], 0);
    step_scene(scene, 1);
    assert_int_equal(read_event_counts(scene)->moved_out, 1);
    assert_int_equal(n->count[jox_agents_find(a, 1)] + n->count[jox_agents_find(a, 2)], 1);
    jo_scene_free(scene);
}

/* A passage full of people: the nearest free spot would be outside of it. */
static void agents_are_not_moved_through_another_wall(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text("jostle: 1\n"
                        "walls:\n"
                        "  - {line: [[0, -0.25], [9, -0.25]]}\n"
                        "  - {line: [[0, 0.25], [9, 0.25]]}\n"
                        "  - {line: [[5, -0.25], [5, 0.25]], name: gate, open: true}\n"
                        "groups: {people: {behaviour: own.lua, at: [[5, 0], [5.32, 0], "
                        "[5.7, 0], [6.1, 0], [4.68, 0], [4.3, 0], [3.9, 0]]}}\n"
                        "events: [{at: 0.1, close: gate}]\n",
                        STAY);
    const JoxAgents *a = &scene->world->state.agents;
    step_scene(scene, 3);
    assert_int_equal(read_event_counts(scene)->moved_out, 1);
    assert_true(fabsf(a->x[jox_agents_find(a, 0)] - 5.0f) > 1.0f);
    for (uint32_t i = 0; i < a->count; i++)
        assert_true(fabsf(a->y[i]) < 0.1f);
    jo_scene_free(scene);
}

#define BALL                                                                                       \
    "bodies: [{name: ball, shape: {sphere: {radius: 0.2}}, mass: 2, at: [8, 2, 0.2], friction: "   \
    "0, "                                                                                          \
    "velocity: [-1.5, 0, 0]},\n"                                                                   \
    "  {name: rock, shape: {box: {size: [1, 1, 1]}}, mass: 0, at: [20, 20, 0.5]}]\n"

static void bodies_collide_with_gates(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoScene *scene = load_scene_text(
        EVENTS("  - {at: 5, open: gate}\n"
               "  - {at: 5, throw: ball, velocity: [-3, 0, 0]}\n"
               "  - {at: 8, close: gate}\n"
               "  - {at: 8, throw: ball, from: [4, 2, 0.2], velocity: [3, 0, 0]}\n") BALL,
        STAY);
    step_scene(scene, 100);
    assert_float_equal(find_body_pose(scene, "ball").centre.x, 5.22,
                       0.05); /* it rests at the gate */
    step_scene(scene, 40);
    assert_true(find_body_pose(scene, "ball").centre.x < 3.0f);
    step_scene(scene, 60);
    assert_true(find_body_pose(scene, "ball").centre.x < 5.0f);
    jo_scene_free(scene);
}

static void body_on_a_wall_falls_when_it_is_removed(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoScene *scene = load_scene_text(
        "jostle: 1\n"
        "walls: [{line: [[0, -2], [0, 2]], name: gate, height: 0.5}]\n"
        "bodies: [{name: ball, shape: {box: {size: [1, 1, 0.4]}}, mass: 5, at: [0, 0, 0.7]}]\n"
        "groups: {people: {behaviour: own.lua, at: [[9, 0]]}}\n"
        "events: [{at: 6, open: gate}]\n",
        STAY);
    step_scene(scene, 120); /* asleep by now */
    assert_float_equal(find_body_pose(scene, "ball").centre.z, 0.7, 0.05);
    step_scene(scene, 30);
    assert_float_equal(find_body_pose(scene, "ball").centre.z, 0.2, 0.05);
    jo_scene_free(scene);
}

/* ---- throws ---- */

static void throw_sets_position_and_velocity(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoScene *scene = load_scene_text(EVENTS("  - {at: 60, signal: a}\n") BALL, STAY);
    const double from[3] = {1, 2, 3}, velocity[3] = {4, 5, 6}, spin[3] = {7, 8, 9};
    step_scene(scene, 10);
    assert_true(jo_scene_throw(scene, "ball", from, velocity, spin, NULL));
    JoxPose pose = find_body_pose(scene, "ball");
    assert_true(pose.centre.x == 1 && pose.centre.y == 2 && pose.centre.z == 3);
    assert_true(pose.velocity.x == 4 && pose.velocity.y == 5 && pose.velocity.z == 6);
    assert_true(pose.spin.x == 7 && pose.spin.y == 8 && pose.spin.z == 9);
    step_scene(scene, 1);
    pose = find_body_pose(scene, "ball");
    assert_float_equal(pose.centre.x, 1.2, 0.001);
    assert_true(jo_scene_throw(scene, "ball", NULL, NULL, NULL, NULL)); /* stopped in the air */
    assert_true(find_body_pose(scene, "ball").centre.x == pose.centre.x);
    assert_true(find_body_pose(scene, "ball").velocity.z == 0);
    assert_int_equal(read_event_counts(scene)->throws, 2);
    jo_scene_free(scene);
}

/* Picking a body up is counted apart from throwing it. */
static void picking_up_is_not_counted_as_a_throw(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    static const char FETCH[] = MACHINE_START
        "\"Take\", states = {\n"
        "  Take = { steer = hold, take = nearest \"ball\", { to = \"Wait\", when = after(0.5) "
        "} },\n"
        "  Wait = { steer = hold, { to = \"Throw\", when = after(1) } },\n"
        "  Throw = { steer = hold, throw = { nearest \"ball\", at = \"post\", speed = 6 },\n"
        "    { to = \"End\", when = after(0.5) } }, End = { steer = hold } } }\n";
    JoScene *scene = load_scene_text("jostle: 1\nplaces: {post: {point: [20, 0]}}\n"
                                     "groups: {people: {behaviour: own.lua, at: [[0, 0]]}}\n"
                                     "bodies: [{name: b, shape: {sphere: {radius: 0.1}}, mass: 1, "
                                     "at: [0.5, 0, 0.1], tags: [ball]}]\n",
                                     FETCH);
    step_scene(scene, 15);
    assert_int_equal(read_event_counts(scene)->pickups, 1);
    assert_int_equal(read_event_counts(scene)->throws, 0);
    step_scene(scene, 60);
    assert_int_equal(read_event_counts(scene)->pickups, 1);
    assert_int_equal(read_event_counts(scene)->throws, 1);
    JoFigures *told = jo_scene_figures(scene);
    assert_float_equal(jo_figure(told, "events.throws"), 1, 0);
    assert_float_equal(jo_figure(told, "events.pickups"), 1, 0);
    jo_free(told);
    jo_scene_free(scene);
}

static void throw_takes_the_body_from_its_carrier(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoScene *scene = load_scene_text(EVENTS("  - {at: 60, signal: a}\n") BALL, STAY);
    JoxBodies *bodies = scene->world->state.bodies;
    const double up[3] = {0, 0, 3};
    step_scene(scene, 1);
    assert_true(jox_bodies_set_carrier(bodies, jox_bodies_find_name(bodies, "ball"), 0));
    step_scene(scene, 1);
    assert_true(jo_scene_throw(scene, "ball", NULL, up, NULL, NULL));
    step_scene(scene, 1);
    const JoxObjects *objects = &scene->world->scratch.objects;
    assert_false(objects->rows[jox_bodies_find_name(bodies, "ball")].held);
    assert_true(find_body_pose(scene, "ball").velocity.z > 2);
    jo_scene_free(scene);
}

/* ---- errors of the calls ---- */

static void refused_calls_say_why(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(EVENTS("  - {at: 60, signal: a}\n"), STAY);
    JoError error = {0};
    const double much[3] = {0, NAN, 0};
    char longer[80];
    memset(longer, 'x', sizeof longer);
    longer[79] = 0;
    assert_false(jo_scene_open_wall(scene, "gates", true, &error));
    assert_string_equal(error.text, "there is no wall named 'gates'. Did you mean 'gate'?");
    assert_int_equal(error.code, JO_INPUT);
    assert_false(jo_scene_throw(scene, "ball", NULL, NULL, NULL, &error));
    assert_string_equal(error.text, "there is no body named 'ball'");
    assert_false(jo_scene_throw(scene, "ball", NULL, much, NULL, &error));
    assert_non_null(strstr(error.text, "velocity must be from -100 to 100 m/s"));
    assert_false(jo_scene_signal(scene, "", &error));
    assert_false(jo_scene_signal(scene, longer, &error));
    assert_non_null(strstr(error.text, "from 1 to 60 bytes"));
    assert_false(jo_scene_signal(scene, longer, NULL));
    jo_scene_free(scene);
    if (!jox_bodies_available())
        return;
    scene = load_scene_text(EVENTS("  - {at: 60, signal: a}\n") BALL, STAY);
    assert_false(jo_scene_throw(scene, "bal", NULL, NULL, NULL, &error));
    assert_string_equal(error.text, "there is no body named 'bal'. Did you mean 'ball'?");
    assert_false(jo_scene_throw(scene, "rock", NULL, NULL, NULL, &error));
    assert_string_equal(error.text, "the body 'rock' is static: it cannot be thrown");
    jo_scene_free(scene);
}

/* A lost body does not end the run. */
static void impossible_event_is_reported(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoScene *scene =
        load_scene_text(EVENTS("  - {at: 0.5, throw: ball, velocity: [1, 0, 0]}\n") BALL, STAY);
    JoxBodies *bodies = scene->world->state.bodies;
    step_scene(scene, 1);
    assert_true(jox_bodies_remove(bodies, jox_bodies_find_name(bodies, "ball")));
    jox_text_free(&scene_messages);
    step_scene(scene, 20);
    assert_non_null(scene_messages.data);
    assert_non_null(
        strstr(scene_messages.data, "scene.yaml:5:22: t = 0.50 s: there is no body named 'ball'"));
    jo_scene_free(scene);
}

/* ---- an edited scene ---- */

static void edited_scene_keeps_effects_of_events(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text(EVENTS("  - {at: 0.5, open: gate}\n  - {at: 0.6, signal: a}\n"), STAY);
    step_scene(scene, 20); /* t = 1 s */
    assert_true(is_gate_open(scene));
    /* With another wall and another event the gate stays open, and past events do not happen again.
     */
    edit_scene(scene, "jostle: 1\n"
                      "walls: [{line: [[5, -5], [5, 5]], name: gate}, {line: [[8, 0], [9, 0]]}]\n"
                      "groups: {people: {behaviour: own.lua, at: [[0, 0], [90, 90]]}}\n"
                      "events:\n"
                      "  - {at: 0.5, open: gate}\n"
                      "  - {at: 0.6, signal: a}\n"
                      "  - {at: 0.7, signal: b}\n" /* too late */
                      "  - {at: 1.0, signal: c}\n" /* in the next step */
                      "  - {at: 1.5, close: gate}\n");
    assert_non_null(strstr(scene_messages.data, "walls, events changed, live from t = 1.00 s"));
    step_scene(scene, 1);
    assert_true(is_gate_open(scene));
    assert_int_equal(scene->world->scratch.walls.ring_count, 1);
    assert_int_equal(read_event_counts(scene)->announced, 2);
    assert_int_equal(read_event_counts(scene)->opened, 1);
    /* An edited title changes nothing in the world. */
    edit_scene(scene, "jostle: 1\n"
                      "title: Another\n"
                      "walls: [{line: [[5, -5], [5, 5]], name: gate}, {line: [[8, 0], [9, 0]]}]\n"
                      "groups: {people: {behaviour: own.lua, at: [[0, 0], [90, 90]]}}\n"
                      "events: [{at: 1.5, close: gate}]\n");
    assert_null(strstr(scene_messages.data, "walls"));
    step_scene(scene, 8);
    assert_true(is_gate_open(scene));
    step_scene(scene, 2);
    assert_false(is_gate_open(scene));
    assert_int_equal(scene->world->scratch.walls.ring_count, 2);
    jo_scene_free(scene);
}

/* A gate that no event has changed follows the file. */
static void edited_gate_without_events_follows_the_file(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(EVENTS("  - {at: 50, open: gate}\n"), STAY);
    step_scene(scene, 1);
    assert_false(is_gate_open(scene));
    edit_scene(scene, "jostle: 1\n"
                      "walls: [{line: [[5, -5], [5, 5]], name: gate, open: true}]\n"
                      "groups: {people: {behaviour: own.lua, at: [[0, 0], [90, 90]]}}\n");
    step_scene(scene, 1);
    assert_true(is_gate_open(scene));
    assert_int_equal(scene->world->scratch.walls.ring_count, 0);
    jo_scene_free(scene);
}

/* ---- cost ---- */

static void steps_without_events_allocate_nothing(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        EVENTS("  - {at: 0.5, open: gate}\n  - {at: 1, signal: a}\n  - {at: 900, signal: b}\n"),
        WALK);
    step_scene(scene, 100);
    uint64_t before = jox_alloc_count();
    step_scene(scene, 100);
    assert_int_equal(jox_alloc_count() - before, 0);
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(events_happen_at_their_times),
        cmocka_unit_test(events_between_two_steps_all_happen),
        cmocka_unit_test(event_in_every_step_happens_once_a_step),
        cmocka_unit_test(events_are_ordered_by_time_then_by_list),
        cmocka_unit_test(signal_reaches_everybody),
        cmocka_unit_test(unheard_signals_are_warned_of),
        cmocka_unit_test(closed_gate_is_not_passed),
        cmocka_unit_test(walls_may_begin_open),
        cmocka_unit_test(agent_in_the_way_of_a_wall_is_moved),
        cmocka_unit_test(moved_agent_is_seen_in_the_same_step),
        cmocka_unit_test(agents_are_not_moved_through_another_wall),
        cmocka_unit_test(bodies_collide_with_gates),
        cmocka_unit_test(body_on_a_wall_falls_when_it_is_removed),
        cmocka_unit_test(throw_sets_position_and_velocity),
        cmocka_unit_test(picking_up_is_not_counted_as_a_throw),
        cmocka_unit_test(throw_takes_the_body_from_its_carrier),
        cmocka_unit_test(refused_calls_say_why),
        cmocka_unit_test(impossible_event_is_reported),
        cmocka_unit_test(edited_scene_keeps_effects_of_events),
        cmocka_unit_test(edited_gate_without_events_follows_the_file),
        cmocka_unit_test(steps_without_events_allocate_nothing),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
