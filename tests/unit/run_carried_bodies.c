/* Tests that walls and fixed bodies block hands: bodies that are picked up, carried, thrown or
 * kicked stay on the agent's side. */
#include <math.h>

#include "geom/wall_grid.h"
#include "jostle_tools.h"
#include "unit/scene_loader.h"

static const JoxStatistics *read_hand_counts(const JoScene *scene) {
    return &scene->world->state.statistics;
}

static uint32_t find_body_row(const JoScene *scene, const char *name) {
    return jox_bodies_find_name(scene->world->state.bodies, name);
}

static bool is_held(const JoScene *scene, const char *name) {
    JoxObjects *objects = &scene->world->scratch.objects;
    jox_bodies_objects(scene->world->state.bodies, objects);
    return objects->rows[find_body_row(scene, name)].held;
}

/* Behaviour that fetches the tagged body, walks towards the place `out`, and throws the body at it
 * after a time. */
#define CARRIER(take, walk)                                                                        \
    "local thing = nearest \"thing\"\n" MACHINE_START "\"Fetch\", defaults = { speed = 1.3, "      \
    "perception = 10 },\n"                                                                         \
    "  states = {\n"                                                                               \
    "    Fetch = { " take ", { to = \"Walk\", when = has(thing) } },\n"                            \
    "    Walk = { " walk ", { to = \"Throw\", when = after(4) } },\n"                              \
    "    Throw = { steer = hold, face = \"out\", throw = { thing, at = \"out\", speed = 6 },\n"    \
    "      { to = \"Rest\", when = after(0.2) } },\n"                                              \
    "    Rest = { steer = hold } } }\n"
#define FETCHES                                                                                    \
    CARRIER("steer = seek(thing), approach = thing, take = thing", "steer = seek \"out\"")
#define STANDS CARRIER("steer = hold, take = thing", "steer = hold, face = \"out\"")
#define ROOM(height, more)                                                                         \
    "jostle: 1\nplaces: {out: {point: [9, 0], radius: 1}}\n"                                       \
    "walls: [{line: [[-5, -5], [4, -5], [4, 5], [-5, 5]], closed: true, height: " height "}" more  \
    "]\ngroups: {people: {behaviour: own.lua, at: [[-1, 0]]}}\n"
#define BALL(at)                                                                                   \
    "bodies: [{name: b, shape: {sphere: {radius: 0.11}}, mass: 0.4, at: " at ", tags: [thing]}]\n"

static void carried_and_thrown_bodies_stay_in_a_sealed_room(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoScene *scene = load_scene_text(ROOM("3", "") BALL("[0, 0, 0.11]"), FETCHES);
    uint32_t held = 0;
    for (int n = 0; n < 200; n++) {
        step_scene(scene, 1);
        const bool now = is_held(scene, "b");
        held += now;
        assert_true(find_body_pose(scene, "b").centre.x < (now ? 4.0f - 0.11f : 4.0f));
    }
    assert_int_equal(read_hand_counts(scene)->throws, 1);
    assert_int_equal(read_hand_counts(scene)->dropped, 0);
    assert_true(held > 70);
    jo_scene_free(scene);
}

/* A carried ball's lowest point is at 1.09 m. */
static void hands_reach_over_walls_lower_than_the_body(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoScene *scene = load_scene_text(ROOM("1.0", "") BALL("[0, 0, 0.11]"), FETCHES);
    step_scene(scene, 200);
    assert_true(find_body_pose(scene, "b").centre.x > 5.0f);
    jo_scene_free(scene);
    scene = load_scene_text(ROOM("1.15", "") BALL("[0, 0, 0.11]"), FETCHES);
    for (int n = 0; n < 200; n++) {
        step_scene(scene, 1);
        assert_true(!is_held(scene, "b") || find_body_pose(scene, "b").centre.x < 4.0f - 0.11f);
    }
    jo_scene_free(scene);
}

static uint64_t pickups_from(const char *text) {
    JoScene *scene = load_scene_text(text, STANDS);
    step_scene(scene, 20);
    const uint64_t pickups = read_hand_counts(scene)->pickups;
    jo_scene_free(scene);
    return pickups;
}

/* The ball is seen over a wall of 1.2 m. */
static void body_behind_a_wall_is_not_picked_up(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    static const char WALL[] =
        ROOM("3", ", {line: [[-0.7, -5], [-0.7, 5]], height: 1.2}") BALL("[-0.5, 0, 0.11]");
    static const char LOW_WALL[] =
        ROOM("3", ", {line: [[-0.7, -5], [-0.7, 5]], height: 1.0}") BALL("[-0.5, 0, 0.11]");
    static const char GATE[] =
        ROOM("3", ", {line: [[-0.7, -5], [-0.7, 5]], height: 1.2, name: gate, open: true}")
            BALL("[-0.5, 0, 0.11]");
    assert_int_equal(pickups_from(WALL), 0);
    assert_int_equal(pickups_from(LOW_WALL), 1);
    assert_int_equal(pickups_from(GATE), 1);
}

#define BESIDE(mass, size, z)                                                                      \
    "bodies:\n"                                                                                    \
    "  - {name: b, shape: {sphere: {radius: 0.11}}, mass: 0.4, at: [-0.3, 0, 0.11], tags: "        \
    "[thing]}\n"                                                                                   \
    "  - {name: crate, shape: {box: {size: [0.2, 2, " size "]}}, mass: " mass ", at: [-0.6, 0, " z \
    "]}\n"

/* Crates lower than 1.3 m, over which the ball is seen. */
static void fixed_bodies_block_hands(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    assert_int_equal(pickups_from(ROOM("3", "") BESIDE("0", "1.25", "0.625")), 0);
    assert_int_equal(pickups_from(ROOM("3", "") BESIDE("0", "0.8", "0.4")), 1);
    assert_int_equal(pickups_from(ROOM("3", "") BESIDE("1000", "1.25", "0.625")), 0);
    assert_int_equal(pickups_from(ROOM("3", "") BESIDE("20", "1.25", "0.625")), 1);
}

static void kick_stops_at_any_wall(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    static const char KICK[] = MACHINE_START
        "\"A\", states = { A = { steer = hold, kick = { nearest \"thing\", at = \"out\", "
        "impulse = 5 } } } }\n";
    JoScene *scene = load_scene_text(ROOM("3", ", {line: [[-0.79, -5], [-0.79, 5]], height: 0.3}")
                                         BALL("[-0.66, 0, 0.11]"),
                                     KICK);
    step_scene(scene, 10);
    assert_int_equal(read_hand_counts(scene)->kicks, 0);
    jo_scene_free(scene);
    scene = load_scene_text(ROOM("3", "") BALL("[-0.66, 0, 0.11]"), KICK);
    step_scene(scene, 10);
    assert_true(read_hand_counts(scene)->kicks > 0);
    jo_scene_free(scene);
}

/* A plank 2 m long fits along a passage 1 m wide, and not across it. */
static void carried_body_without_room_is_dropped_and_reported(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    static const char PASSAGE[] =
        "jostle: 1\nplaces: {out: {point: [20, 0], radius: 1}}\n"
        "walls: [{line: [[2, 8], [2, 0.5], [15, 0.5]]}, {line: [[2, -8], [2, -0.5], [15, -0.5]]}]\n"
        "groups: {people: {behaviour: own.lua, at: [[-1, 0]]}}\n"
        "bodies: [{name: b, shape: {box: {size: [%s, 0.2]}}, mass: 5, at: [0.5, 0, 0.1], tags: "
        "[thing]}]\n";
    char text[600];
    snprintf(text, sizeof text, PASSAGE, "0.2, 2");
    JoScene *scene = load_scene_text(text, FETCHES);
    step_scene(scene, 100);
    assert_int_equal(read_hand_counts(scene)->dropped, 1);
    assert_true(find_body_pose(scene, "b").centre.x < 2.0f);
    char *closing = jo_scene_closing(scene);
    assert_non_null(strstr(closing, "1 body dropped for want of room"));
    jo_free(closing);
    JoFigures *told = jo_scene_figures(scene);
    assert_float_equal(jo_figure(told, "events.dropped"), 1, 0);
    jo_free(told);
    jo_scene_free(scene);
    snprintf(text, sizeof text, PASSAGE, "2, 0.2");
    scene = load_scene_text(text, FETCHES);
    step_scene(scene, 100);
    assert_int_equal(read_hand_counts(scene)->dropped, 0);
    assert_true(find_body_pose(scene, "b").centre.x > 3.0f);
    jo_scene_free(scene);
}

/* Returns whether a wall lies between the first agent and a corner of the body that it carries. */
static bool is_across_a_wall(const JoScene *scene, const JoxObject *body) {
    const JoxAgents *a = &scene->world->state.agents;
    const JoxWalls *walls = &scene->world->model.all_walls;
    const uint32_t i = jox_agents_find(a, body->holder);
    for (uint32_t v = 0; v < walls->count; v++)
        for (uint32_t k = 0; k < body->footprint_count; k++)
            if (jox_segments_cross(jox_v2(a->x[i], a->y[i]), body->footprint[k],
                                   walls->vertices[v].point,
                                   walls->vertices[walls->vertices[v].next].point))
                return true;
    return false;
}

static void carried_body_crosses_no_wall_when_its_carrier_turns(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoScene *scene = load_scene_text(
        "jostle: 1\nplaces: {room: {polygon: [[-3, -3], [3, -3], [3, 3], [-3, 3]]}}\n"
        "walls: [{line: [[-3, -3], [3, -3], [3, 3], [-3, 3]], closed: true},\n"
        "  {solid: [[1, 1], [1.4, 1], [1.2, 1.5]]}, {line: [[-1.5, -2], [-1.5, 2]]}]\n"
        "groups: {people: {behaviour: own.lua, count: 6, fill: grid, in: room}}\n"
        "bodies: [{shape: {box: {size: [0.8, 0.15, 0.3]}}, mass: 2, at: [-2.5, -2.5, 0.2], "
        "tags: [thing], repeat: {count: [4, 3, 1], step: [1.6, 1.5, 1]}}]\n",
        MACHINE_START "\"A\", defaults = { speed = 1.3, perception = 10 }, states = {\n"
                      "  A = { steer = wander(), take = nearest \"thing\" } } }\n");
    uint32_t held = 0;
    for (int n = 0; n < 400; n++) {
        step_scene(scene, 1);
        const JoxObjects *objects = &scene->world->scratch.objects;
        jox_bodies_objects(scene->world->state.bodies, &scene->world->scratch.objects);
        for (uint32_t o = 0; o < objects->count; o++) {
            held += objects->rows[o].held;
            if (objects->rows[o].held && is_across_a_wall(scene, &objects->rows[o]))
                fail_msg("body %u in step %d", o, n);
        }
    }
    assert_true(held > 1000);
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(carried_and_thrown_bodies_stay_in_a_sealed_room),
        cmocka_unit_test(hands_reach_over_walls_lower_than_the_body),
        cmocka_unit_test(body_behind_a_wall_is_not_picked_up),
        cmocka_unit_test(fixed_bodies_block_hands),
        cmocka_unit_test(kick_stops_at_any_wall),
        cmocka_unit_test(carried_body_without_room_is_dropped_and_reported),
        cmocka_unit_test(carried_body_crosses_no_wall_when_its_carrier_turns),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
