/* Tests of jostle_read.h, by which a program reads a running scene. */
#include <math.h>

#include "unit/gate_ball_scene.h"

#define OWN                                                                                        \
    "local mine = memory { hits = 0 }\n" MACHINE_START                                             \
    "\"Walk\", defaults = { speed = 1.2 }, states = {\n"                                           \
    "  Walk = { steer = drift(1, 0), { to = \"Call\", when = mine.hits:above(2) } },\n"            \
    "  Call = { steer = hold, signal = \"here\" } } }\n"
#define PLACES "places: {west: {point: [-20, 0]}, east: {point: [40, 0]}}\n"

static JoScene *scene;
static JoWorld *world;
static JoError error;

static void load_read_scene(void) {
    scene = load_scene_text(jox_bodies_available() ? GATE_AND_BODIES PLACES FOUR_WALKERS
                                                   : GATE_ALONE PLACES FOUR_WALKERS,
                            OWN);
    world = jo_scene_world(scene);
}

static void columns_point_at_the_state(void **state) {
    (void)state;
    load_read_scene();
    step_scene(scene, 3);
    const JoColumn id = jo_world_column(world, "id"), x = jo_world_column(world, "x"),
                   mass = jo_world_column(world, "mass"),
                   machine = jo_world_column(world, "machine");
    assert_true(id.type == JO_U32 && id.stride == 4 && x.type == JO_F32 && machine.type == JO_U16);
    assert_int_equal(x.count, 4);
    for (uint32_t i = 0; i < x.count; i++) {
        const JoAgent agent = jo_world_agent_of(world, ((const uint32_t *)id.data)[i]);
        const JoAgentState s = jo_agent_state(world, agent);
        assert_true(s.x == (double)*(const float *)((const char *)x.data + i * x.stride));
        assert_true(((const float *)mass.data)[i] == 80.0f);
    }
    assert_true(x.data == world->state.agents.x); /* no copy */
    uint32_t names = 0;
    for (; jo_column_name(names); names++)
        assert_non_null(jo_world_column(world, jo_column_name(names)).data);
    assert_true(names > 30);
    assert_null(jo_world_column(world, "none").data);
    assert_int_equal(jo_world_agent_of(world, 99).generation, 0);
    assert_string_equal(jo_world_group_name(world, 0), "people");
    const uint32_t walks = ((const uint16_t *)jo_world_column(world, "state").data)[0];
    assert_string_equal(jo_world_state_name(world, 0, walks), "Walk");
    assert_string_equal(jo_world_state_name(world, 0, 1 - walks), "Call");
    assert_string_equal(jo_world_state_name(world, 0, 2), "");
    assert_string_equal(jo_world_machine_name(world, 7), "");
    assert_string_equal(jo_world_place_name(world, 1), "east");
    jo_scene_free(scene);
}

/* The chest points to +x at first, so the left end of the axis lies on +y. */
static void columns_have_torsos(void **state) {
    (void)state;
    const JoWorldDef def = jo_default_world_def();
    const JoAgentDef person = jo_default_agent_def();
    world = jo_world_create(&def, &error);
    const JoAgent agent = jo_world_add_agent(world, &person, &error);
    assert_true(jo_agent_set_parameter(world, agent, "breadth", 0.45, &error));
    assert_true(jo_agent_set_parameter(world, agent, "depth", 0.25, &error));
    jo_world_step(world, 1);
    static const struct {
        const char *name;
        float value;
    } SEEN[] = {{"chest_x", 1.0f}, {"chest_y", 0.0f}, {"spin", 0.0f},
                {"axis_x", 0.0f},  {"axis_y", 0.1f},  {"contact_radius", 0.125f}};
    for (size_t k = 0; k < sizeof SEEN / sizeof *SEEN; k++) {
        const JoColumn column = jo_world_column(world, SEEN[k].name);
        assert_true(column.type == JO_F32 && column.count == 1);
        assert_float_equal(*(const float *)column.data, SEEN[k].value, 1e-6);
    }
    jo_world_free(world);
}

static void events_list_what_happened_in_the_step(void **state) {
    (void)state;
    load_read_scene();
    JoEvents e = jo_world_events(world);
    assert_int_equal(e.entered_count, 4);
    assert_int_equal(e.entered[3].agent, 3);
    step_scene(scene, 1);
    const JoAgent second = jo_world_agent_of(world, 1);
    assert_true(jo_agent_set_memory(world, second, "hits", 3, &error));
    jo_world_remove_agent(world, jo_world_agent_of(world, 2));
    const JoAgent added = jo_world_spawn(world, "people", 9, -4, &error);
    step_scene(scene, 1);
    e = jo_world_events(world);
    assert_int_equal(e.transition_count, 1);
    assert_int_equal(e.transitions[0].agent, 1);
    assert_string_equal(jo_world_state_name(world, e.transitions[0].machine, e.transitions[0].to),
                        "Call");
    assert_int_equal(e.said_count, 1);
    assert_string_equal(jo_world_signal_name(world, e.said[0].signal), "here");
    assert_true(e.entered_count == 1 && e.entered[0].agent == 4 && e.entered[0].x > 8.9f);
    assert_true(e.left_count == 1 && e.left[0].agent == 2 && fabs(e.left[0].x - 2.0) < 0.2);
    const JoEvents again = jo_world_events(world); /* the events of the same step */
    assert_true(again.entered_count == 1 && again.transition_count == 1);
    step_scene(scene, 1);
    e = jo_world_events(world);
    assert_int_equal(e.entered_count + e.left_count + e.transition_count, 0);
    assert_true(jo_agent_is_live(world, added));
    jo_scene_free(scene);
}

/* An agent that walks into a wall touches it; the touch begins once. */
static void touch_begins_once(void **state) {
    (void)state;
    scene = load_scene_text(
        "jostle: 1\nwalls: [{line: [[0, -0.3], [3, -0.3], [3, 0.3], [0, 0.3]]}]\n"
        "groups: {people: {behaviour: own.lua, at: [[2, 0], [1.4, 0]]}}\n",
        MACHINE_START "\"Walk\", defaults = { speed = 1.5, push = 300, push_reach = 1 }, "
                      "states = { Walk = { steer = drift(1, 0) } } }\n");
    world = jo_scene_world(scene);
    uint32_t walls_begun = 0, walls = 0, people_begun = 0;
    for (int n = 0; n < 60; n++) {
        jo_agent_apply_force(world, jo_world_agent_of(world, 0), 400, 0);
        jo_agent_apply_force(world, jo_world_agent_of(world, 1), 400, 0);
        step_scene(scene, 1);
        const JoEvents e = jo_world_events(world);
        for (uint32_t k = 0; k < e.touch_count; k++) {
            assert_true(e.touches[k].force > 0.0f);
            assert_true(k == 0 || e.touches[k - 1].agent <= e.touches[k].agent);
            walls += e.touches[k].kind == JO_TOUCHED_WALL;
            walls_begun += e.touches[k].kind == JO_TOUCHED_WALL && e.touches[k].began;
            people_begun += e.touches[k].kind == JO_TOUCHED_AGENT && e.touches[k].began;
        }
    }
    assert_true(walls > 10 && walls_begun >= 1 && walls_begun < walls / 2 && people_begun >= 1);
    jo_scene_free(scene);
}

static void kicks_are_listed(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    scene = load_scene_text(
        "jostle: 1\nplaces: {goal: {point: [9, 0]}}\n"
        "bodies: [{name: post, shape: {box: {size: [1, 1, 1]}}, at: [20, 20, 0.5]},\n"
        "  {name: ball, shape: {sphere: {radius: 0.1}}, mass: 0.4, at: [1, 0, 0.1],"
        " tags: [ball]}]\n"
        "groups: {people: {behaviour: own.lua, at: [[0, 0]]}}\n",
        MACHINE_START "\"Go\", states = { Go = { steer = seek(nearest \"ball\"), "
                      "approach = nearest \"ball\", "
                      "kick = { nearest \"ball\", at = \"goal\", impulse = 6 }, "
                      "{ to = \"Stop\", when = kicked(nearest \"ball\") } }, "
                      "Stop = { steer = hold } } }\n");
    world = jo_scene_world(scene);
    uint32_t kicks = 0;
    for (int n = 0; n < 40; n++) {
        step_scene(scene, 1);
        const JoEvents e = jo_world_events(world);
        for (uint32_t k = 0; k < e.action_count; k++, kicks++) {
            assert_true(e.actions[k].agent == 0 && e.actions[k].kind == JO_DONE_KICK);
            assert_string_equal(jo_world_body_name(world, e.actions[k].other), "ball");
            assert_true(e.actions[k].x > 0.3f && e.actions[k].x < 1.0f);
        }
    }
    assert_int_equal(kicks, 1);
    jo_scene_free(scene);
}

static void hit_of_a_ball_is_listed(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    load_read_scene();
    const JoBody ball = jo_world_find_body(world, "ball");
    assert_true(jo_body_place(world, ball, (double[]){6, 0.2, 1.2}, NULL, &error));
    assert_true(jo_body_set_velocity(world, ball, (double[]){-12, 0, 0}, NULL, &error));
    uint32_t hits = 0;
    for (int n = 0; n < 10; n++) {
        step_scene(scene, 1);
        const JoEvents e = jo_world_events(world);
        for (uint32_t k = 0; k < e.hit_count; k++, hits++) {
            assert_int_equal(jo_world_body_at(world, e.hits[k].body).generation, ball.generation);
            assert_true(e.hits[k].impulse > 1.0f && e.hits[k].z > 0.5f);
            assert_int_equal(e.hits[k].agent, 3); /* the agent nearest to the ball */
        }
        if (hits)
            break;
    }
    assert_int_equal(hits, 1);
    jo_scene_free(scene);
}

static void queries_have_exact_answers(void **state) {
    (void)state;
    load_read_scene();
    uint32_t ids[8];
    float away[8];
    assert_int_equal(jo_world_neighbours(world, 0, 0, 2.1, ids, away, 8), 3);
    assert_true(ids[0] == 0 && ids[1] == 1 && ids[2] == 2 && away[0] == 0.0f);
    assert_int_equal(jo_world_neighbours(world, 0, 0, 2.1, ids, NULL, 1), 3);
    const double r = jo_agent_state(world, jo_world_agent_of(world, 0)).radius;
    JoCast c = jo_world_cast(world, (double[]){-4, 0}, (double[]){6, 0}, 0.1, JO_CAST_ALL);
    assert_true(c.hit && c.kind == JO_TOUCHED_AGENT && c.what == 0);
    assert_true(fabs(c.x + r + 0.1) < 1e-5 && fabs(c.nx + 1.0) < 1e-6);
    c = jo_world_cast(world, (double[]){25, 2}, (double[]){35, 2}, 0, JO_CAST_WALLS);
    assert_true(c.hit && c.kind == JO_TOUCHED_WALL && fabs(c.share - 0.5) < 1e-6);
    c = jo_world_cast(world, (double[]){35, 2}, (double[]){25, 2}, 0.5, JO_CAST_WALLS);
    assert_true(c.hit && fabs(c.x - 30.5) < 1e-5 && fabs(c.nx - 1.0) < 1e-6);
    c = jo_world_cast(world, (double[]){25, 5.3}, (double[]){35, 5.3}, 0.5, JO_CAST_WALLS);
    assert_true(c.hit && fabs(c.x - 29.6) < 1e-4); /* the wall's end: 0.4 before it, 0.3 beside */
    c = jo_world_cast(world, (double[]){25, 5.3}, (double[]){35, 5.3}, 0.2, JO_CAST_WALLS);
    assert_true(!c.hit && c.share == 1.0 && c.x == 35.0);
    c = jo_world_cast(world, (double[]){0, 0}, (double[]){0, 0}, 0,
                      JO_CAST_AGENTS); /* starts within an agent */
    assert_true(c.hit && c.share == 0.0);
    assert_true(jo_scene_open_wall(scene, "gate", true, &error));
    assert_false(jo_world_cast(world, (double[]){25, 2}, (double[]){35, 2}, 0, JO_CAST_WALLS).hit);
    assert_int_equal(jo_world_walls(world, NULL, 0), 0);
    assert_true(jo_scene_open_wall(scene, "gate", false, &error));
    double edges[8];
    assert_int_equal(jo_world_walls(world, edges, 2), 2); /* both directions of an edge */
    assert_true(edges[0] == 30.0 && edges[6] == 30.0);
    if (jox_bodies_available()) {
        step_scene(scene, 1);
        c = jo_world_cast(world, (double[]){10, 5}, (double[]){20, 5}, 0.25, JO_CAST_BODIES);
        assert_true(c.hit && c.kind == JO_TOUCHED_BODY && fabs(c.x - 14.25) < 1e-4);
        assert_string_equal(jo_world_body_name(world, c.what), "pillar");
        double ring[32];
        assert_int_equal(jo_body_outline(world, jo_world_find_body(world, "pillar"), ring, 16), 4);
        assert_true(fabs(fabs(ring[0] - 15.0) - 0.5) < 1e-5);
    }
    jo_scene_free(scene);
}

static void paths_lead_round_walls(void **state) {
    (void)state;
    load_read_scene();
    double length, xy[800];
    const double straight = hypot(10.0, 5.0); /* to the wall's end, on either side of it */
    const uint32_t count = jo_world_path(world, 20, 0, "east", xy, 400, &length);
    assert_true(count > 60 && count < 400);
    assert_true(length > 2.0 * straight && length < 2.0 * straight + 1.5);
    assert_true(xy[0] == 20.0 && hypot(xy[2 * count - 2] - 40.0, xy[2 * count - 1]) < 0.6);
    for (uint32_t k = 1; k < count; k++)
        assert_true(hypot(xy[2 * k] - xy[2 * k - 2], xy[2 * k + 1] - xy[2 * k - 1]) < 0.51);
    assert_true(jo_scene_open_wall(scene, "gate", true, &error));
    jo_world_path(world, 20, 0, "east", NULL, 0, &length);
    assert_true(fabs(length - 20.0) < 0.6);
    assert_int_equal(jo_world_path(world, 20, 0, "nowhere", NULL, 0, &length), 0);
    assert_true(isinf(length));
    jo_scene_free(scene);
}

static void density_is_a_gaussian_that_walls_stop(void **state) {
    (void)state;
    scene = load_scene_text("jostle: 1\nwalls: [{line: [[0.5, -5], [0.5, 5]]}]\n"
                            "groups: {people: {behaviour: own.lua, at: [[0, 0], [1, 0]]}}\n",
                            OWN);
    world = jo_scene_world(scene);
    assert_true(fabs(jo_world_density(world, 0, 0) - 0.31830989) < 1e-6);
    assert_true(fabs(jo_world_density(world, 0, 1) - 0.31830989 * exp(-1.0)) < 1e-6);
    assert_true(jo_world_density(world, 60, 60) == 0.0);
    jo_scene_free(scene);
}

/* Without friction the momentum of a body is the sum of the impulses that people gave it. */
static void impulses_of_people_add_up_to_the_momentum_of_a_body(void **state) {
    (void)state;
    if (!jox_bodies_available())
        return;
    JoWorldDef def = jo_default_world_def();
    world = jo_world_create(&def, &error);
    JoAgentDef person = jo_default_agent_def();
    person.x = -1.0;
    person.push = 100;
    jo_agent_set_preferred(world, jo_world_add_agent(world, &person, &error), 1.3, 0);
    JoBodyDef box = jo_default_body_def();
    box.friction = 0;
    box.mass = 30;
    box.z = 0.5;
    const JoBody crate = jo_world_add_body(world, &box, &error);
    box.kinematic = true;
    box.y = 1.5;
    const JoBody door = jo_world_add_body(world, &box, &error);
    double sum = 0.0, impulse[3], turn[3];
    for (int s = 0; s < 60; s++) {
        jo_world_step(world, 1);
        assert_true(jo_body_pushed(world, crate, impulse, turn));
        sum += impulse[0];
        assert_true(jo_body_pushed(world, door, turn, NULL));
        assert_true(turn[0] == 0.0 && turn[1] == 0.0);
    }
    assert_true(sum > 5.0);
    assert_float_equal(sum, 30.0 * jo_body_state(world, crate).vx, 0.01 * sum);
    /* Impulses of the program do not count. */
    jo_world_step(world, 40);
    assert_true(jo_body_impulse(world, crate, (double[]){300, 0, 0}, NULL, &error));
    jo_world_step(world, 20);
    assert_true(jo_body_pushed(world, crate, impulse, NULL) && impulse[0] == 0.0);
    assert_true(jo_body_remove(world, crate, &error));
    assert_false(jo_body_pushed(world, crate, impulse, NULL));
    jo_world_free(world);
}

static void snapshot_continues_exactly(void **state) {
    (void)state;
    scene = load_scene_text(GATE_ALONE PLACES FOUR_WALKERS, OWN);
    world = jo_scene_world(scene);
    size_t size;
    step_scene(scene, 4);
    void *data = jo_world_snapshot(world, &size, &error);
    assert_non_null(data);
    step_scene(scene, 20);
    const uint64_t later = jo_world_hash(world);
    assert_false(jo_world_restore(world, data, size / 2, &error));
    assert_true(jo_world_hash(world) == later && error.text[0]);
    assert_true(jo_world_restore(world, data, size, &error));
    assert_int_equal(jo_world_tick(world), 4);
    step_scene(scene, 20);
    assert_true(jo_world_hash(world) == later);
    jo_free(data);
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(columns_point_at_the_state),
        cmocka_unit_test(columns_have_torsos),
        cmocka_unit_test(events_list_what_happened_in_the_step),
        cmocka_unit_test(touch_begins_once),
        cmocka_unit_test(kicks_are_listed),
        cmocka_unit_test(hit_of_a_ball_is_listed),
        cmocka_unit_test(queries_have_exact_answers),
        cmocka_unit_test(paths_lead_round_walls),
        cmocka_unit_test(density_is_a_gaussian_that_walls_stop),
        cmocka_unit_test(impulses_of_people_add_up_to_the_momentum_of_a_body),
        cmocka_unit_test(snapshot_continues_exactly),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
