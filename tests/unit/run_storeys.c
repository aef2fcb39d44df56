/* Runs of scenes with storeys: people find their way over stairs, also stairs one above the other.
 */
#include <math.h>

#include "run/probe_listener.h"
#include "unit/scene_loader.h"

#define TOWER                                                                                      \
    "jostle: 1\n"                                                                                  \
    "storeys: {ground: {height: 0}, first: {height: 3.5}, second: {height: 7}}\n"                  \
    "stairs:\n"                                                                                    \
    "  a: {from: ground, to: first, path: [[8, 2], [12, 2], [12, 3.6], [8, 3.6]], width: 1.4}\n"   \
    "  b: {from: first, to: second, path: [[8, 2], [12, 2], [12, 3.6], [8, 3.6]], width: 1.4}\n"   \
    "walls:\n"                                                                                     \
    "  - {line: [[0, 9], [0, 0], [20, 0], [20, 12], [0, 12], [0, 11]]}\n"                          \
    "  - {line: [[0, 0], [20, 0], [20, 12], [0, 12]], closed: true, storey: [first, second]}\n"    \
    "places:\n"                                                                                    \
    "  one: {polygon: [[2, 1], [18, 1], [18, 11], [2, 11]], storey: first}\n"                      \
    "  two: {polygon: [[2, 1], [18, 1], [18, 11], [2, 11]], storey: second}\n"                     \
    "  street: {line: [[-2, 8], [-2, 12]]}\n"                                                      \
    "groups: {people: {count: 30, in: [one, two], journey: [{exit: street}]}}\n"

static void stairs_one_above_the_other_empty_a_tower(void **state) {
    (void)state;
    JoScene *scene = load_scene_file(write_test_file("scene.yaml", TOWER), NULL, 0);
    const JoWorld *w = scene->world;
    assert_null(scene_messages.data);
    for (uint32_t i = 0; i < w->state.agents.count; i++) /* nobody starts below a stair */
        assert_true(
            jox_is_floor(&w->model.storeys, jox_v2(w->state.agents.x[i], w->state.agents.y[i])));
    step_scene_seconds(scene, 60);
    assert_int_equal(w->state.agents.count, 0);
    jo_scene_free(scene);
}

#define TWO_STAIRS                                                                                 \
    "jostle: 1\n"                                                                                  \
    "storeys: {ground: {height: 0}, first: {height: 3}}\n"                                         \
    "stairs:\n"                                                                                    \
    "  near: {from: ground, to: first, path: [[18, 3], [13, 3]], width: 1.4}\n"                    \
    "  far: {from: ground, to: first, path: [[18, 9], [13, 9]], width: 1.4}\n"                     \
    "walls: [{line: [[0, 0], [20, 0], [20, 12], [0, 12]], closed: true, storey: first}]\n"         \
    "places: {hall: {polygon: [[1, 1], [5, 1], [5, 5], [1, 5]], storey: first}, "                  \
    "street: {line: [[26, 5], [26, 1]]}}\n"                                                        \
    "groups: {people: {count: 12, in: hall, journey: [{exit: street}]}}\n"                         \
    "events: [{at: 1, close: near}, {at: 100, open: near}]\n"

static void nobody_sets_out_over_a_closed_stair(void **state) {
    (void)state;
    JoScene *scene = load_scene_file(write_test_file("scene.yaml", TWO_STAIRS), NULL, 0);
    JoWorld *w = scene->world;
    JoxText why = {0}, saved = {0};
    JoError error;
    uint32_t on_far = 0;
    for (int s = 0; s < 40; s++) {
        step_scene_seconds(scene, 1);
        for (uint32_t i = 0; i < w->state.agents.count; i++) {
            const int32_t stair =
                jox_stair_at(&w->model.storeys, jox_v2(w->state.agents.x[i], w->state.agents.y[i]));
            assert_true(stair != 0);
            on_far += stair == 1;
        }
    }
    assert_true(on_far > 0);
    assert_int_equal(w->state.agents.count, 0);
    assert_true(jox_world_snapshot(w, &saved, &error));
    assert_false(jox_event_open(w, "farr", true, &why));
    assert_non_null(strstr(why.data, "no wall or stair named 'farr'. Did you mean 'far'?"));
    assert_true(jox_event_open(w, "near", true, &why));
    assert_false(w->model.storeys.stairs[0].closed);
    assert_true(jox_world_restore(w, saved.data, saved.length, &error));
    assert_true(w->model.storeys.stairs[0].closed); /* part of the state */
    jox_text_free(&saved);
    jox_text_free(&why);
    jo_scene_free(scene);
}

/* Edits that change storeys, stairs or how deep the plan is wait for the next start, whole; others
   are taken over on their sheets. */
static void edits_that_move_sheets_wait(void **state) {
    (void)state;
    char text[2000];
    JoScene *scene = load_scene_file(write_test_file("scene.yaml", TWO_STAIRS), NULL, 0);
    const JoxPlace *street = &scene->world->model.places[1];
    step_scene_seconds(scene, 1);
    snprintf(text, sizeof text, "%s%s", TWO_STAIRS, "floor: wood\n");
    memcpy(strstr(text, "[26, 5]"), "[27, 5]", 7);
    edit_scene(scene, text);
    assert_non_null(strstr(scene_messages.data, "places, floor changed, live"));
    assert_true(street->points[0].x == 27.0f);
    memcpy(strstr(text, "[27, 5]"), "[27, 6]", 7);
    memcpy(strstr(text, "width: 1.4"), "width: 1.6", 10);
    edit_scene(scene, text);
    assert_non_null(strstr(scene_messages.data, "places, stairs (the world is made with them): "
                                                "takes effect at the next start"));
    assert_true(street->points[0].y == 5.0f);
    snprintf(text, sizeof text, "%s%s", TWO_STAIRS, "regions: {a: [[0, 90], [1, 90], [1, 91]]}\n");
    edit_scene(scene, text);
    assert_non_null(strstr(scene_messages.data, "as storeys are laid out anew"));
    jo_scene_free(scene);
}

/* Public calls take points on a storey and give them in plan. */
static void programs_read_and_write_points_in_plan(void **state) {
    (void)state;
    JoScene *scene = load_scene_file(write_test_file("scene.yaml", TWO_STAIRS), NULL, 0);
    JoWorld *w = scene->world;
    JoError error;
    uint32_t ids[16];
    double length;
    JoWhere way[400], all[16];
    assert_int_equal(jo_world_storey_count(w), 2);
    assert_string_equal(jo_world_storey_name(w, 1), "first");
    assert_string_equal(jo_world_storey_name(w, 2), "");
    assert_true(jo_world_storey_height(w, 1) == 3.0 && isnan(jo_world_storey_height(w, 2)));
    assert_int_equal(jo_world_stair_count(w), 2);
    assert_string_equal(jo_world_stair(w, 1).name, "far");
    assert_true(fabs(jo_world_stair(w, 1).length - 5.0) < 1e-4);
    assert_int_equal(jo_world_stair(w, 1).upper, 1);
    assert_string_equal(jo_world_stair(w, 2).name, "");
    assert_int_equal(jo_world_wheres(w, all, 16), 12);
    for (int k = 0; k < 12; k++)
        assert_true(all[k].storey == 1 && all[k].stair == JO_NO_STAIR && all[k].y < 5.5 &&
                    all[k].height == 3.0);
    const JoAgent agent = jo_world_agent_of(w, 3);
    const JoAgentState at = jo_agent_state(w, agent);
    assert_true(at.storey == 1 && at.y < 5.5);
    /* People on one storey are no neighbours of a point of another. */
    assert_int_equal(jo_world_neighbours_on(w, 1, at.x, at.y, 10, ids, NULL, 16), 12);
    assert_int_equal(jo_world_neighbours_on(w, 0, at.x, at.y, 10, ids, NULL, 16), 0);
    assert_int_equal(jo_world_neighbours(w, at.x, at.y, 10, ids, NULL, 16), 0);
    assert_true(jo_world_density_on(w, 1, at.x, at.y) > 0.3);
    assert_true(jo_world_density_on(w, 0, at.x, at.y) == 0.0);
    const double west[2] = {-0.5, at.y}, east[2] = {at.x, at.y};
    const JoCast wall = jo_world_cast_on(w, 1, west, east, 0.0, JO_CAST_WALLS);
    assert_true(wall.hit && fabs(wall.x) < 1e-3 && fabs(wall.y - at.y) < 1e-3);
    assert_false(jo_world_cast_on(w, 0, west, east, 0.0, JO_CAST_ALL).hit);
    /* A way leads down a stair, without jumps. */
    const uint32_t points = jo_world_path_on(w, 1, 3, 3, "street", way, 400, &length);
    bool stairs = false;
    assert_true(points > 20 && points < 400 && length > 20 && length < 60);
    for (uint32_t k = 0; k < points; k++) {
        stairs |= way[k].stair != JO_NO_STAIR;
        assert_true(k == 0 || hypot(way[k].x - way[k - 1].x, way[k].y - way[k - 1].y) < 0.6);
        assert_true(k == 0 || way[k].height <= way[k - 1].height + 0.2);
    }
    assert_true(stairs && way[0].storey == 1 && way[points - 1].storey == 0);
    /* People are put on a storey. */
    assert_true(jo_agent_teleport_on(w, agent, 0, 10, 6, &error));
    assert_int_equal(jo_agent_where(w, agent).storey, 0);
    assert_true(jo_agent_teleport_on(w, agent, 1, 10, 6, &error));
    assert_true(jo_agent_where(w, agent).storey == 1 && jo_agent_state(w, agent).y == 6.0);
    assert_int_equal(jo_agent_where(w, jo_world_spawn_on(w, "people", 1, 9, 9, &error)).storey, 1);
    assert_false(jo_agent_teleport_on(w, agent, 2, 10, 6, &error));
    assert_non_null(strstr(error.text, "there is no storey 2: the storeys are 0 to 1"));
    jo_scene_free(scene);
}

#define OPEN_STOREYS(more)                                                                         \
    "jostle: 1\nstoreys: {ground: {height: 0}, first: {height: 3}}\n"                              \
    "places: {far: {point: [0, 9]}}\n" more

/* People and bodies that leave the plan would come to the next storey: they are reported, as those
   with invalid numbers are. */
#define BODY_STOREYS                                                                               \
    "jostle: 1\n"                                                                                  \
    "storeys: {ground: {height: 0}, first: {height: 3}}\n"                                         \
    "walls: [{line: [[0, 0], [20, 0], [20, 12], [0, 12]], closed: true, storey: [ground, "         \
    "first]}]\n"                                                                                   \
    "bodies: [{shape: {sphere: {radius: 0.2}}, mass: 2, at: [5, 5, 0.2], name: ball}]\n"

/* Bodies, agents and walls of programs lie on the storey that is given; unknown storeys are refused
   with their number. */
static void programs_put_bodies_agents_and_walls_on_storeys(void **state) {
    (void)state;
    JoScene *scene = load_scene_file(write_test_file("scene.yaml", BODY_STOREYS), NULL, 0);
    JoWorld *w = scene->world;
    JoError error;
    const JoBody ball = jo_world_find_body(w, "ball");
    const uint32_t first = jo_world_find_storey(w, "first");
    assert_int_equal(first, 1);
    assert_true(jo_world_find_storey(w, "attic") == JO_NO_STOREY);
    assert_true(jo_body_place_on(w, ball, first, (double[]){8, 6, 0.2}, NULL, &error));
    step_scene(scene, 2);
    JoBodyState at = jo_body_state(w, ball);
    assert_true(at.storey == 1 && at.x > 7.9 && at.x < 8.1 && at.y > 5.9 && at.y < 6.1);
    assert_true(
        jo_body_impulse_on(w, ball, (double[]){4, 0, 0}, first, (double[]){8, 6, 0.2}, &error));
    step_scene(scene, 2);
    at = jo_body_state(w, ball);
    assert_true(at.vx > 1.0 && fabs(at.vy) < 0.1); /* pushed through its centre, not turned */
    assert_true(jo_scene_throw_on(scene, 0, "ball", (double[]){3, 3, 1}, NULL, NULL, &error));
    step_scene(scene, 2);
    at = jo_body_state(w, ball);
    assert_true(at.storey == 0 && at.x > 2.9 && at.x < 3.1);
    JoBodyDef box = jo_default_body_def();
    box.x = 10;
    box.y = 4;
    box.storey = first;
    const JoBody there = jo_world_add_body(w, &box, &error);
    at = jo_body_state(w, there);
    assert_true(at.storey == 1 && at.y == 4.0);
    JoAgentDef person = jo_default_agent_def();
    person.x = 15;
    person.y = 9;
    person.storey = first;
    const JoAgentState stands = jo_agent_state(w, jo_world_add_agent(w, &person, &error));
    assert_true(stands.storey == 1 && stands.x == 15.0 && stands.y == 9.0);
    const double across[] = {12, 0, 12, 12}, from[2] = {11, 6}, to[2] = {13, 6};
    assert_true(jo_world_add_wall_on(w, "shut", first, across, 2, &error));
    step_scene(scene, 1);
    assert_true(jo_world_cast_on(w, first, from, to, 0.1, JO_CAST_WALLS).hit);
    assert_false(jo_world_cast_on(w, 0, from, to, 0.1, JO_CAST_WALLS).hit);
    /* no such storey */
    person.storey = box.storey = 2;
    error.text[0] = 0;
    assert_true(jo_world_add_agent(w, &person, &error).generation == 0);
    assert_non_null(strstr(error.text, "there is no storey 2: the storeys are 0 to 1"));
    assert_true(jo_world_add_body(w, &box, &error).generation == 0);
    assert_false(jo_body_place_on(w, ball, 2, (double[]){8, 6, 0.2}, NULL, &error));
    assert_false(
        jo_body_impulse_on(w, ball, (double[]){1, 0, 0}, 7, (double[]){8, 6, 0.2}, &error));
    assert_non_null(strstr(error.text, "there is no storey 7"));
    assert_false(jo_world_add_wall_on(w, "shut", 2, across, 2, &error));
    assert_false(jo_scene_throw_on(scene, 2, "ball", (double[]){3, 3, 1}, NULL, NULL, &error));
    jo_scene_free(scene);
}

static void who_leaves_the_plan_is_reported(void **state) {
    (void)state;
    JoError error = {0};
    JoScene *scene = load_scene_text(
        OPEN_STOREYS("groups: {g: {behaviour: own.lua, at: [[0, 0]]}}\n"), MACHINE_START
        "\"A\", states = { A = { steer = function() return 0, 2 end, speed = 2 } } }\n");
    bool ended = false;
    for (int s = 0; s < 2000 && !ended; s++)
        ended = !jo_scene_step(scene, &error);
    assert_true(ended);
    assert_non_null(strstr(error.text, "agent 0 left the plan of its storey (machine m, state A), "
                                       "before at (0, "));
    assert_non_null(strstr(error.text, "on ground; enclose it by walls; the run cannot go on"));
    jo_scene_free(scene);
    scene = load_scene_text(
        OPEN_STOREYS("groups: {g: {behaviour: own.lua, at: [[0, 0]]}}\n"
                     "bodies: [{name: cart, shape: {box: {size: [1, 1, 1]}}, kinematic: true, at: "
                     "[5, 0, 0.6], velocity: [0, 5, 0], storey: first}]\n"),
        MACHINE_START "\"A\", states = { A = { steer = hold } } }\n");
    step_scene_seconds(scene, 12);
    assert_int_equal(scene->world->state.statistics.bodies_lost, 1);
    assert_non_null(strstr(scene_messages.data, "cart left the plan of its storey, at (5, "));
    jo_scene_free(scene);
}

/* `seek` leads over stairs to a place on another storey, and straight on the storey of the place.
 */
static void seekers_climb_stairs(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        "jostle: 1\nstoreys: {ground: {height: 0}, first: {height: 3}}\n"
        "stairs: {up: {from: ground, to: first, path: [[8, 3], [13, 3]], width: 1.4}}\n"
        "walls: [{line: [[0, 0], [20, 0], [20, 12], [0, 12]], closed: true, "
        "storey: [ground, first]}]\n"
        "places: {desk: {point: [4, 9], storey: first}}\n"
        "groups: {g: {behaviour: own.lua, at: [[3, 3], [4, 9]], storey: ground}}\n",
        MACHINE_START "\"A\", states = { A = { steer = seek \"desk\", speed = 1.3 } } }\n");
    const JoWorld *w = scene->world;
    step_scene_seconds(scene, 60);
    for (uint32_t i = 0; i < 2; i++) {
        const JoxV2 at = {w->state.agents.x[i], w->state.agents.y[i]};
        assert_int_equal(jox_sheet_of(&w->model.storeys, at.y), 1);
        assert_true(jox_length(jox_sub(at, w->model.places[0].centre)) < 1.0f);
    }
    jo_scene_free(scene);
}

/* ---- storeys that nothing joins ---- */

#define LONERS_HEAD                                                                                \
    "jostle: 1\n"                                                                                  \
    "storeys: {ground: {height: 0}, first: {height: 3}}\n"                                         \
    "walls:\n"                                                                                     \
    "  - {line: [[10, 1], [10, 0], [0, 0], [0, 10], [10, 10], [10, 9]], storey: ground}\n"         \
    "  - {line: [[0, 1.5], [0, 0], [10, 0], [10, 10], [0, 10], [0, 9]], storey: first}\n"          \
    "places:\n"                                                                                    \
    "  east: {polygon: [[13, 0], [14, 0], [14, 10], [13, 10]]}\n"                                  \
    "  west: {polygon: [[-4, 0], [-3, 0], [-3, 10], [-4, 10]], storey: first}\n"                   \
    "probes:\n"                                                                                    \
    "  low door: {flow: [[10, 9], [10, 1]]}\n"                                                     \
    "  high door: {flow: [[0, 1.5], [0, 9]], storey: first}\n"                                     \
    "groups:\n"

/* Appends a group of people in rows `apart`, m, who walk to a place. */
static void add_loners(JoxText *out, const char *name, const char *to, const char *storey,
                       double apart) {
    jox_text_printf(out, "  %s: {behaviour: %s.lua, storey: %s, at: [", name, to, storey);
    const char *between = "";
    for (double x = 2.0; x < 7.5; x += apart)
        for (double y = 2.2; y < 7.7; y += apart) {
            jox_text_printf(out, "%s[%g, %g]", between, x, y);
            between = ", ";
        }
    jox_text_add(out, "]}\n");
}

/* Fate of the people of a storey: a hash over all steps, and those who passed its door. */
typedef struct Fate {
    uint64_t hash;
    uint32_t passed;
} Fate;

static void add_to_fate(Fate *fate, const JoxAgents *a, uint32_t i) {
    const float cells[] = {a->x[i], a->y[i], a->vx[i], a->vy[i]};
    for (size_t c = 0; c < sizeof cells; c++)
        fate->hash = (fate->hash ^ ((const unsigned char *)cells)[c]) * 1099511628211u;
}

/* Runs people on a storey, and on the other one if `both`, in rows `apart`, m. Those of the first
   have the lowest ids, on which random numbers depend. */
static void run_loners(uint32_t storey, bool both, double apart, Fate fates[2]) {
    static const char *const GROUPS[2][3] = {{"low", "east", "ground"}, {"high", "west", "first"}};
    JoxText text = {0};
    jox_text_add(&text, LONERS_HEAD);
    for (uint32_t k = 0; k < (both ? 2u : 1u); k++) {
        const char *const *group = GROUPS[(storey + k) % 2];
        add_loners(&text, group[0], group[1], group[2], apart);
    }
    static const char *const PLACES[] = {"east", "west"};
    for (int k = 0; k < 2; k++) {
        char file[32], machine[300];
        snprintf(file, sizeof file, "%s.lua", PLACES[k]);
        snprintf(machine, sizeof machine,
                 "return machine { name = \"%s\", version = 1, start = \"Go\", defaults = {speed = "
                 "1.3}, states = { Go = { steer = seek \"%s\" } } }\n",
                 PLACES[k], PLACES[k]);
        write_test_file(file, machine);
    }
    JoScene *scene = load_scene_file(write_test_file("scene.yaml", text.data), NULL, 0);
    const JoWorld *w = scene->world;
    fates[0] = fates[1] = (Fate){.hash = 14695981039346656037u};
    for (int n = 0; n < 500; n++) {
        step_scene(scene, 1);
        for (uint32_t rank = 0; rank < w->state.agents.count; rank++) {
            const uint32_t i = w->state.agents.by_rank[rank];
            add_to_fate(&fates[jox_sheet_of(&w->model.storeys, w->state.agents.y[i])],
                        &w->state.agents, i);
        }
    }
    for (uint32_t p = 0; p < 2; p++)
        fates[p].passed = jox_probe_passages(jox_run_probe(scene, p));
    jox_text_free(&text);
    jo_scene_free(scene);
}

/* People of two storeys walk to the bit as if the other storey were empty, as long as nobody is
   touched: contacts of all people are solved together, until the last one is. */
static void storeys_that_nothing_joins_are_two_scenes(void **state) {
    (void)state;
    for (uint32_t storey = 0; storey < 2; storey++)
        for (int dense = 0; dense < 2; dense++) {
            const double apart = dense ? 0.55 : 2.6;
            Fate both[2], alone[2];
            run_loners(storey, true, apart, both);
            run_loners(storey, false, apart, alone);
            assert_int_equal(alone[1 - storey].passed, 0);
            assert_true(both[0].passed >= 9 && both[1].passed >= 9);
            if (!dense)
                assert_true(both[storey].hash == alone[storey].hash);
            assert_in_range(both[storey].passed + 3u * (uint32_t)dense - alone[storey].passed, 0,
                            6 * dense);
            assert_true(!dense || both[storey].passed > 60);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stairs_one_above_the_other_empty_a_tower),
        cmocka_unit_test(nobody_sets_out_over_a_closed_stair),
        cmocka_unit_test(edits_that_move_sheets_wait),
        cmocka_unit_test(programs_read_and_write_points_in_plan),
        cmocka_unit_test(programs_put_bodies_agents_and_walls_on_storeys),
        cmocka_unit_test(who_leaves_the_plan_is_reported),
        cmocka_unit_test(seekers_climb_stairs),
        cmocka_unit_test(storeys_that_nothing_joins_are_two_scenes),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
