/* The scene message has all parts of a running scene, and its version changes with them. */
#include "live/inspect.h"
#include "live_bytes.h"

static void scene_message_has_all_parts_of_tawaf(void **state) {
    (void)state;
    JoScene *scene = load_tawaf("300");
    const JoWorld *world = scene->world;
    JoxText text = {0};
    jox_live_scene(scene, true, &text);
    parse_numbers(&text);
    assert_near(number_at("protocol", 0, 0, 0), JOX_LIVE_PROTOCOL, 0);
    assert_near(number_at("dt", 0, 0, 0), 0.05, 1e-9);
    assert_near(number_at("duration", 0, 0, 0), 600, 0);
    for (uint32_t p = 0; p < scene->spec->place_count; p++) {
        check_name_in(&text, world->model.places[p].name);
        for (uint32_t i = 0; i < world->model.places[p].count; i++) {
            assert_near(number_at("places.%d.points.%d.0", (int)p, (int)i, 0),
                        world->model.places[p].points[i].x, 1e-4);
            assert_near(number_at("places.%d.points.%d.1", (int)p, (int)i, 0),
                        world->model.places[p].points[i].y, 1e-4);
            assert_true(number_at("area.0.0", 0, 0, 0) <
                        (double)world->model.places[p].points[i].x);
            assert_true(number_at("area.1.1", 0, 0, 0) >
                        (double)world->model.places[p].points[i].y);
        }
    }
    for (uint32_t r = 0; r < scene->spec->region_count; r++)
        check_name_in(&text, scene->spec->regions[r].name);
    for (uint32_t m = 0; m < world->model.machines.count; m++) {
        check_name_in(&text, world->model.machines.items[m]->name);
        for (uint32_t s = 0; s < world->model.machines.items[m]->state_count; s++)
            check_name_in(&text, world->model.machines.items[m]->states[s].name);
    }
    check_name_in(&text, "pilgrims");
    /* Walls as in the scene: a solid, a line of 13 points (both sides once), a solid. */
    static const int POINTS[] = {4, 13, 4};
    for (int w = 0; w < 3; w++) {
        assert_false(isnan(number_at("walls.%d.points.%d.1", w, POINTS[w] - 1, 0)));
        assert_true(isnan(number_at("walls.%d.points.%d.1", w, POINTS[w], 0)));
    }
    assert_true(isnan(number_at("walls.3.height", 0, 0, 0)));
    assert_near(number_at("walls.1.height", 0, 0, 0), 1.31, 1e-4);
    assert_near(number_at("walls.1.points.12.0", 0, 0, 0), -5.91, 1e-5);
    assert_near(number_at("colours.density.most", 0, 0, 0), 8, 0);
    assert_non_null(strstr(text.data, "\"gates\": false"));
    assert_non_null(strstr(text.data, "\"parameters\": true"));
    jox_text_free(&text);
    jo_scene_free(scene);
}

static void check_part(const JoxText *text, const char *part) {
    if (!strstr(text->data, part))
        fail_msg("the message lacks %s", part);
}

static void scene_message_of_bodies_and_a_player(void **state) {
    (void)state;
    JoScene *scene = load_scene_file("scenes/dodgeball.yaml", NULL, 0);
    JoxText text = {0};
    jox_live_scene(scene, true, &text);
    parse_numbers(&text);
    check_name_in(&text, "ball");
    assert_near(number_at("bodies.0.mass", 0, 0, 0), 0.4, 1e-6);
    assert_near(number_at("bodies.0.parts.0.size.0", 0, 0, 0), 0.11, 1e-6);
    assert_near(number_at("bodies.0.parts.0.turn.3", 0, 0, 0), 1, 1e-6);
    assert_non_null(strstr(text.data, "\"shape\": \"sphere\""));
    assert_near(number_at("tools.players.0", 0, 0, 0), 0, 0);
    /* A closed wall is a line whose last point repeats the first. */
    for (int k = 0; k < 2; k++)
        assert_near(number_at("walls.0.points.4.%d", k, 0, 0),
                    number_at("walls.0.points.0.%d", k, 0, 0), 0);
    assert_true(isnan(number_at("walls.1.height", 0, 0, 0)));
    step_scene(scene, 3);
    JoxBytes frame = {0};
    jox_live_frame(scene, JOX_LIVE_COLOUR_state, NULL, &frame);
    Seen seen = decode_frame(&frame, scene->world);
    check_frame_people(scene, &seen);
    assert_int_equal(seen.bodies, 1);
    JoxPose pose;
    assert_true(jox_bodies_pose(scene->world->state.bodies, 0, &pose));
    assert_near(get_float(seen.body), pose.position.x, 1e-6);
    assert_near(get_float(seen.body + 8), pose.position.z, 1e-6);
    assert_near((int16_t)(seen.body[18] | seen.body[19] << 8) / 32767.0, pose.turn[3], 1e-4);
    const uint32_t red =
        scene->world->state.agents.slot[jox_agents_find(&scene->world->state.agents, 0)];
    const uint32_t blue =
        scene->world->state.agents.slot[jox_agents_find(&scene->world->state.agents, 1)];
    assert_int_equal(seen.slot[8 * red + 7] & 4, 4);
    assert_int_equal(seen.slot[8 * blue + 7] & 4, 0);
    jox_bytes_free(&frame);
    jox_text_free(&text);
    jo_scene_free(scene);
}

/* Names from files, with any characters, are escaped in the scene message. */
static void scene_message_escapes_names(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        "jostle: 1\n"
        "title: \"a \\\"title\\\" \\\\ with\\ttab, \\x01, \xC3\xA9 and \xE2\x82\xAC\"\n"
        "view: {tools: [throw, gates, push], colour: speed, field: pressure}\n"
        "gravity: 1.62\n"
        "camera: {position: [1, -2, 3], target: [0, 0.5, 0]}\n"
        "places: {\"y\xC3\xA4rd 1.b\": {polygon: [[0, 0], [9, 0], [9, 9], [0, 9]]}}\n"
        "walls:\n"
        "  - {line: [[0, 0], [0, 5], [3, 5]], name: \"g\xC3\xA4-te\", open: true}\n"
        "  - {line: [[5, 0], [5, 5]], name: \"g\xC3\xA4-te\"}\n"
        "probes: {out: {flow: [[0, 0], [0, 4]]}}\n"
        "groups: {\"p\xC3\xA9 ople\": {behaviour: own.lua, count: 4, fill: grid, in: "
        "\"y\xC3\xA4rd 1.b\"}}\n",
        STANDING_AT_SPEED("1", ""));
    JoxText text = {0};
    jox_live_scene(scene, true, &text);
    parse_numbers(&text);
    check_name_in(&text, scene->spec->title);
    check_name_in(&text, "g\xC3\xA4-te");
    check_name_in(&text, "p\xC3\xA9 ople");
    assert_non_null(strstr(
        text.data, "\"view\": {\"given\": true, \"colour\": \"speed\", \"field\": \"pressure\"}"));
    assert_non_null(strstr(text.data, "\"throw\": true"));
    assert_non_null(strstr(text.data, "\"gates\": true"));
    assert_non_null(strstr(text.data, "\"parameters\": false"));
    assert_non_null(strstr(text.data, "\"walls\": [\"g\xC3\xA4-te\"]"));
    assert_non_null(strstr(text.data, "\"charts\": [\"out\"]"));
    assert_near(number_at("tools.gravity", 0, 0, 0), 1.62, 0);
    assert_near(number_at("camera.at.1", 0, 0, 0), -2, 0);
    assert_near(number_at("camera.look.1", 0, 0, 0), 0.5, 0);
    /* The status, before and after the first step. */
    for (int k = 0; k < 2; k++) {
        JoxText status = {0};
        jox_live_status(scene, &(JoxLiveSession){.speed = 1, .dropped = 7}, &status);
        parse_numbers(&status);
        assert_near(number_at("agents", 0, 0, 0), 4, 0);
        assert_near(number_at("states.0.0", 0, 0, 0), 4, 0);
        assert_near(number_at("dropped", 0, 0, 0), 7, 0);
        assert_near(number_at("time", 0, 0, 0), 0.05 * k, 1e-9);
        jox_text_free(&status);
        step_scene(scene, 1);
    }
    jox_text_free(&text);
    jo_scene_free(scene);
}

/* The version changes when a body breaks, but not when a gate opens. */
static void version_changes_with_bodies_but_not_with_gates(void **state) {
    (void)state;
    JoScene *scene = load_scene_file("scenes/wall-breaking.yaml", NULL, 0);
    uint64_t version = jox_live_version(scene);
    const uint32_t bodies = jox_bodies_count(scene->world->state.bodies);
    for (int t = 0; t < 600 && jox_bodies_count(scene->world->state.bodies) == bodies; t++) {
        assert_true(jox_live_version(scene) == version);
        step_scene(scene, 1);
    }
    assert_true(jox_bodies_count(scene->world->state.bodies) > bodies);
    assert_true(jox_live_version(scene) != version);
    JoxText text = {0};
    JoxBytes frame = {0};
    jox_live_scene(scene, true, &text);
    parse_numbers(&text);
    jox_live_frame(scene, JOX_LIVE_COLOUR_state, NULL, &frame);
    Seen seen = decode_frame(&frame, scene->world);
    assert_false(isnan(number_at("bodies.%d.mass", (int)seen.bodies - 1, 0, 0)));
    assert_true(isnan(number_at("bodies.%d.mass", (int)seen.bodies, 0, 0)));
    jox_bytes_free(&frame);
    jox_text_free(&text);
    jo_scene_free(scene);
    scene = load_scene_file("scenes/gates.yaml", NULL, 0);
    version = jox_live_version(scene);
    step_scene(scene, 20 * 30);
    assert_true(scene->world->state.statistics.opened > 0);
    assert_true(jox_live_version(scene) == version);
    jo_scene_free(scene);
}

#define WALK                                                                                       \
    "jostle: 1\n"                                                                                  \
    "places: {out: {point: [9, 2], radius: 1}}\n"                                                  \
    "bodies: [{name: coach, shape: {box: {size: [4, 2, 2]}}, kinematic: true, at: [5, 9, 1]}]\n"   \
    "groups: {g: {at: [[1, 1], [1, 2], [1, 3]], journey: [{exit: out}]}}\n"

/* Scenery is sent to the page, changes the version of the message, and moves nobody. */
static void scenery_is_sent_and_does_not_enter_the_hash(void **state) {
    (void)state;
    JoxText text = {0};
    JoScene *bare = load_scene_text(WALK "walls: [{line: [[0, -9], [3, -9]], height: 3}]\n", "");
    step_scene(bare, 60);
    JoScene *dressed = load_scene_text(
        WALK "floor: marble\n"
             "walls: [{line: [[0, -9], [3, -9]], height: 3, drawn: 0.5}]\n"
             "scenery:\n"
             "  - {kind: bush, at: [[5, 2], [0, 4]], faces: [0, 2]}\n"
             "  - {kind: hedge, through: [[0, 0], [3, 0]], size: [0, 0, 2], colour: sky}\n"
             "  - {kind: train, at: [[0, 0], [0, 3]], turn: 90, doors: [1 m, -1], body: coach}\n",
        "");
    assert_true(jox_live_version(dressed) != jox_live_version(bare));
    step_scene(dressed, 60);
    assert_true(jo_world_hash(dressed->world) == jo_world_hash(bare->world));
    jox_live_scene(dressed, true, &text);
    parse_numbers(&text);
    assert_near(number_at("walls.0.height", 0, 0, 0), 0.5, 1e-6);
    check_part(&text, "\"floor\": \"marble\"");
    check_part(&text, "\"colour\": \"#56b4e9\"");
    check_part(&text, "\"body\": \"coach\"");
    assert_near(number_at("scenery.0.at.0.0", 0, 0, 0), 5, 1e-6);
    assert_near(number_at("scenery.0.size.0", 0, 0, 0), 1.2, 1e-6);
    assert_near(number_at("scenery.1.through.1.0", 0, 0, 0), 3, 1e-6);
    assert_near(number_at("scenery.1.size.1", 0, 0, 0), 0.7, 1e-6);
    assert_near(number_at("scenery.1.size.2", 0, 0, 0), 2, 1e-6);
    assert_near(number_at("scenery.2.at.1.1", 0, 0, 0), 3, 1e-6);
    assert_near(number_at("scenery.0.turns.0", 0, 0, 0), -90, 1e-4); /* the front looks to -x */
    assert_near(number_at("scenery.0.turns.1", 0, 0, 0), 0, 1e-4);
    assert_near(number_at("scenery.2.turns.1", 0, 0, 0), 90, 1e-6);
    assert_near(number_at("scenery.2.doors.1", 0, 0, 0), -1, 1e-6);
    jox_text_free(&text);
    jo_scene_free(dressed);
    jo_scene_free(bare);
}

/* Clothes of groups and poses of states are sent to the page, and move nobody. */
static void clothes_and_poses_are_sent_and_do_not_enter_the_hash(void **state) {
    (void)state;
    JoxText text = {0};
    JoScene *plain =
        load_scene_text("jostle: 1\ngroups: {g: {behaviour: own.lua, at: [[1, 1]]}, h: {behaviour: "
                        "own.lua, at: [[3, 3]]}}\n",
                        MACHINE_START "\"A\", states = { A = { steer = drift(1, 0) } } }\n");
    JoScene *dressed = load_scene_text(
        "jostle: 1\ngroups: {g: {behaviour: own.lua, at: [[1, 1]], clothes: ihram}, h: {behaviour: "
        "own.lua, at: [[3, 3]]}}\n",
        MACHINE_START "\"A\", states = { A = { steer = drift(1, 0), pose = \"raise\" } } }\n");
    assert_true(jox_live_version(dressed) != jox_live_version(plain));
    step_scene(plain, 40);
    step_scene(dressed, 40);
    assert_true(jo_world_hash(dressed->world) == jo_world_hash(plain->world));
    jox_live_scene(dressed, true, &text);
    check_part(&text, "\"clothes\": {\"g\": \"ihram\"}");
    check_part(&text, "\"pose\": \"raise\"");
    jox_text_free(&text);
    jo_scene_free(dressed);
    jo_scene_free(plain);
}

static void scene_message_has_states_that_run_machines(void **state) {
    (void)state;
    JoScene *scene = load_scene_file("tests/data/nested.yaml", NULL, 0);
    JoxText text = {0};
    assert_true(jo_scene_input(scene, "set guard Guard.Look push 5", NULL));
    assert_true(jo_scene_input(scene, "set guard Guard perception 3", NULL));
    jox_live_scene(scene, true, &text);
    check_part(&text, "{\"name\": \"Guard\", \"line\": 10, \"within\": [1, 2, 3]");
    check_part(&text, "\"unit\": \"N\", \"apart\": [\"Guard.Look\"]");
    check_part(&text, "\"set\": \"state Guard tests/data/nested/guard.lua:10\"");
    check_part(&text, "\"set\": \"defaults tests/data/nested/patrol.lua:6\"");
    check_part(&text, "\"set\": \"program or page, state Guard\"");
    check_part(&text, "\"name\": \"Guard.Walk\", \"line\": 9, \"steer\": \"seek \\\"east\\\"\"");
    check_part(&text, "\"to\": \"Guard.Walk\", \"back\": true");
    text.length = 0;
    assert_true(jox_live_lua_line(scene, "guard", "Guard.Walk", "push", 4, &text));
    assert_string_equal(text.data, "Walk = { push = 4, ... },   -- tests/data/nested/patrol.lua:9");
    jox_text_free(&text);
    jo_scene_free(scene);
}

static void ranges_follow_the_values_without_flicker(void **state) {
    (void)state;
    JoxLiveScale scale = {0};
    double now = 100.0;
    assert_true(jox_live_scale_is_due(&scale, now));
    /* From 3 at first to 12, then back and forth about 12, with two outliers of 1000. */
    uint32_t changes = 0;
    for (int k = 0; k < 400; k++, now += 0.25) {
        const float before = scale.most, size = k < 40 ? 3.0f : k % 2 ? 8.0f : 12.0f;
        JoxLiveSample sample = {.count = 0};
        for (uint32_t i = 0; i < 300; i++) {
            const float value = i < 100 ? 0.0f : i < 102 ? 1000.0f : size * (float)i / 300.0f;
            jox_live_sample_value(&sample, 1, i, value);
        }
        jox_live_sample_value(&sample, 1, 0, NAN);
        jox_live_adapt_scale(&scale, &sample, 1.0f, now);
        changes += scale.most != before;
        assert_false(jox_live_scale_is_due(&scale, now + 0.1));
        assert_true(scale.most == (k < 40 ? 5.0f : 20.0f));
    }
    assert_int_equal(changes, 2);
    /* Small values for a moment change nothing; for 10 s they narrow the range, down to the least.
     */
    const JoxLiveSample small = {.count = 1, .values = {0.3f}};
    for (double since = now; now < since + 9.5; now += 0.25) {
        jox_live_adapt_scale(&scale, &small, 1.0f, now);
        assert_true(scale.most == 20.0f);
    }
    jox_live_adapt_scale(&scale, &small, 1.0f, now + 1.0);
    assert_true(scale.most == 1.0f);
    /* Where a few bear 100 times as much as the others, the others fill the range. */
    JoxLiveScale robust = {0};
    JoxLiveSample loads = {.count = 0};
    for (uint32_t i = 0; i < 100; i++)
        jox_live_sample_value(&loads, 1, i, i % 10 == 0 ? 5000.0f : (float)(i % 50) + 1.0f);
    jox_live_adapt_scale(&robust, &loads, 1.0f, now);
    assert_true(robust.most >= 50.0f && robust.most <= 200.0f);
}

static void frames_fill_the_range_of_their_scene(void **state) {
    (void)state;
    JoxLiveScales scales = {.fixed = false};
    JoxBytes frame = {0};
    JoScene *scene = load_scene_file("scenes/office.yaml", NULL, 0);
    step_scene(scene, 20);
    jox_live_frame(scene, JOX_LIVE_COLOUR_density, &scales, &frame);
    const float most = get_float(frame.data + 40);
    assert_true(most == 2.0f); /* the least range of densities */
    scales.fixed = true;
    jox_live_frame(scene, JOX_LIVE_COLOUR_density, &scales, &frame);
    assert_true(get_float(frame.data + 40) == 8.0f);
    scales.fixed = false;
    jox_live_frame(scene, JOX_LIVE_COLOUR_service, &scales, &frame);
    assert_true(get_float(frame.data + 40) == 8.0f); /* levels of service are the same everywhere */
    jox_live_field(scene, JOX_LIVE_DENSITY, &scales, &frame);
    assert_true(get_float(frame.data + 28) >= 2.0f);
    jox_bytes_free(&frame);
    jo_scene_free(scene);
}

/* Returns the greatest density of a crowd of 60 in 25 m2, 1/m2, and R of the Gaussian, m. */
static double find_greatest_density(const char *places, const char *groups, double *r) {
    JoxText yaml = {0}, status = {0};
    jox_text_printf(&yaml,
                    "jostle: 1\nplaces: {yard: {polygon: [[0, 0], [5, 0], [5, 5], [0, 5]]}%s}\n"
                    "groups: {people: {behaviour: own.lua, count: 60, fill: random, in: yard}%s}\n",
                    places, groups);
    JoScene *scene = load_scene_text(yaml.data, MACHINE_START "\"A\", states = { A = {} } }\n");
    step_scene(scene, 4);
    jox_live_status(scene, &(JoxLiveSession){0}, &status);
    parse_numbers(&status);
    const double most = number_at("density_max", 0, 0, 0);
    *r = number_at("density_r", 0, 0, 0);
    jox_text_free(&yaml);
    jox_text_free(&status);
    jo_scene_free(scene);
    return most;
}

static void density_does_not_depend_on_empty_places(void **state) {
    (void)state;
    double r, far_r, wide_r;
    const double most = find_greatest_density("", "", &r);
    assert_true(most > 1.5);
    assert_near(r, 1, 1e-3);
    assert_near(find_greatest_density(", afar: {point: [300, 300]}", "", &far_r), most, 0);
    assert_near(far_r, r, 0);
    const double wide = find_greatest_density(
        ", far: {polygon: [[300, 300], [302, 300], [302, 302], [300, 302]]}",
        ", one: {behaviour: own.lua, count: 1, fill: random, in: far}", &wide_r);
    assert_true(wide < most && wide_r > 1.6); /* somebody is there */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scene_message_has_all_parts_of_tawaf),
        cmocka_unit_test(scene_message_of_bodies_and_a_player),
        cmocka_unit_test(scene_message_escapes_names),
        cmocka_unit_test(version_changes_with_bodies_but_not_with_gates),
        cmocka_unit_test(scenery_is_sent_and_does_not_enter_the_hash),
        cmocka_unit_test(clothes_and_poses_are_sent_and_do_not_enter_the_hash),
        cmocka_unit_test(scene_message_has_states_that_run_machines),
        cmocka_unit_test(ranges_follow_the_values_without_flicker),
        cmocka_unit_test(frames_fill_the_range_of_their_scene),
        cmocka_unit_test(density_does_not_depend_on_empty_places),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
