/* Tests of walls that appear among people: which agents are moved, and that none is moved through a
 * wall. */
#include <math.h>

#include "geom/wall_way.h"
#include "unit/effort.h"
#include "unit/gate_ball_scene.h"
#include "unit/shipped_scenes.h"

#define STAY MACHINE_START "\"A\", states = { A = { steer = hold } } }\n"
#define SEEK                                                                                       \
    MACHINE_START                                                                                  \
    "\"A\", defaults = { speed = 1.3 }, states = { A = { steer = seek(own.goal), push = 500 "      \
    "} }, own = { goal = \"out\" } }\n"

static const JoxStatistics *counted(const JoWorld *world) {
    return &world->state.statistics;
}

static const JoxStatistics *counts(const JoScene *scene) {
    return counted(scene->world);
}

/* ---- gates ---- */

/* People push against the end of a sealed hall, closer together than their widths. */
#define HALL(gate)                                                                                 \
    "jostle: 1\n"                                                                                  \
    "places: {hall: {polygon: [[4, 1], [9.5, 1], [9.5, 5], [4, 5]]}, out: {point: [14, 3]}}\n"     \
    "walls:\n"                                                                                     \
    "  - {line: [[0, 0], [10, 0], [10, 6], [0, 6]], closed: true}\n"                               \
    "  - " gate "\n"                                                                               \
    "groups: {people: {behaviour: own.lua, count: 120, in: hall, fill: random}}\n"                 \
    "events: [{at: 10, close: gate}]\n"

static void all_are_in_the_hall(const JoScene *scene) {
    const JoxAgents *a = &scene->world->state.agents;
    for (uint32_t i = 0; i < a->count; i++)
        if (!(a->x[i] > 0.0f && a->x[i] < 10.0f && a->y[i] > 0.0f && a->y[i] < 6.0f))
            fail_msg("agent %u at (%g, %g)", a->id[i], (double)a->x[i], (double)a->y[i]);
}

static void gate_far_from_a_dense_crowd_moves_nobody(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text(HALL("{line: [[1, 2], [1, 4]], name: gate, open: true}"), SEEK);
    step_scene(scene, 205);
    assert_int_equal(counts(scene)->closed, 1);
    assert_int_equal(counts(scene)->moved_out + counts(scene)->not_moved_out, 0);
    all_are_in_the_hall(scene);
    jo_scene_free(scene);
}

static void closing_gate_leaves_each_agent_on_its_side(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text(HALL("{line: [[8.5, 0], [8.5, 6]], name: gate, open: true}"), SEEK);
    const JoxAgents *a = &scene->world->state.agents;
    bool before[120];
    uint32_t across = 0;
    step_scene(scene, 200);
    assert_int_equal(a->count, 120);
    for (uint32_t i = 0; i < a->count; i++) {
        before[a->id[i]] = a->x[i] < 8.5f;
        across += fabsf(a->x[i] - 8.5f) < 0.7f * 0.2f;
    }
    assert_true(across >= 3);
    for (int n = 0; n < 40; n++) {
        step_scene(scene, 1);
        for (uint32_t i = 0; i < a->count; i++)
            assert_true(before[a->id[i]] == (a->x[i] < 8.5f));
    }
    assert_int_equal(counts(scene)->moved_out + counts(scene)->not_moved_out, across);
    all_are_in_the_hall(scene);
    jo_scene_free(scene);
}

/* ---- solids that appear over people ---- */

static void people_leave_a_new_solid_through_no_other_wall(void **state) {
    (void)state;
    /* The nearest ways out lead through the line at x = 6.4. */
    JoScene *scene = load_scene_text(
        "jostle: 1\n"
        "walls:\n"
        "  - {line: [[6.4, -3], [6.4, 3]]}\n"
        "  - {solid: [[4, -1], [7, -1], [7, 1], [4, 1]], name: block, open: true}\n"
        "groups: {people: {behaviour: own.lua, at: [[6.3, 0], [6.5, 0.1], [5, 0.9]]}}\n"
        "events: [{at: 0.1, close: block}]\n",
        STAY);
    const JoxAgents *a = &scene->world->state.agents;
    step_scene(scene, 3);
    assert_int_equal(counts(scene)->moved_out, 3);
    for (uint32_t i = 0; i < a->count; i++) {
        assert_false(jox_walls_contain(&scene->world->scratch.walls, jox_v2(a->x[i], a->y[i])));
        assert_true((a->x[i] > 6.4f) == (a->id[i] == 1));
    }
    jo_scene_free(scene);
}

static void people_enclosed_in_a_solid_stay_and_are_reported(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        "jostle: 1\n"
        "walls:\n"
        "  - {line: [[-1, -1], [1, -1], [1, 1], [-1, 1]], closed: true}\n"
        "  - {solid: [[-3, -3], [3, -3], [3, 3], [-3, 3]], name: block, open: true}\n"
        "groups: {people: {behaviour: own.lua, at: [[0.5, 0.25], [2, 0]]}}\n"
        "events: [{at: 0.1, close: block}]\n",
        STAY);
    const JoxAgents *a = &scene->world->state.agents;
    step_scene(scene, 10);
    assert_int_equal(counts(scene)->moved_out, 1);
    assert_int_equal(counts(scene)->not_moved_out, 1);
    assert_non_null(scene_messages.data);
    assert_non_null(strstr(scene_messages.data,
                           "t = 0.10 s: 1 person in the way of a wall that came could "
                           "not be moved"));
    assert_non_null(strstr(scene_messages.data, "agent 0 at (0.50, 0.25)"));
    const uint32_t first = jox_agents_find(a, 0);
    assert_true(fabsf(a->x[first]) < 1.0f && fabsf(a->y[first]) < 1.0f);
    JoFigures *told = jo_scene_figures(scene);
    assert_float_equal(jo_figure(told, "events.moved_out"), 1, 0);
    assert_float_equal(jo_figure(told, "events.not_moved_out"), 1, 0);
    jo_free(told);
    jo_scene_free(scene);
}

/* ---- reloads ---- */

#define EDITED(walls)                                                                              \
    "jostle: 1\n"                                                                                  \
    "places: {hall: {polygon: [[4, 1], [9.5, 1], [9.5, 5], [4, 5]]}, out: {point: [14, 3]}}\n"     \
    "walls:\n" walls                                                                               \
    "groups: {people: {behaviour: own.lua, count: 120, in: hall, fill: random}}\n"

/* The same wall, with other walls before it, another first vertex and the other direction. */
static void reload_moves_nobody_for_an_unchanged_wall(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        EDITED("  - {line: [[0, 0], [10, 0], [10, 6], [0, 6]], closed: true}\n"), SEEK);
    step_scene(scene, 200);
    edit_scene(scene, EDITED("  - {line: [[20, 0], [20, 6]]}\n"
                             "  - {line: [[10, 6], [10, 0], [0, 0], [0, 6]], closed: true}\n"));
    step_scene(scene, 5);
    assert_int_equal(scene->world->scratch.walls.ring_count, 3);
    assert_int_equal(counts(scene)->moved_out + counts(scene)->not_moved_out, 0);
    all_are_in_the_hall(scene);
    /* One side of the solid moves inwards, over people; the others stay. */
    const JoxAgents *a = &scene->world->state.agents;
    uint32_t on_it = 0;
    for (uint32_t i = 0; i < a->count; i++)
        on_it += fabsf(a->x[i] - 9.0f) < 0.7f * 0.2f;
    assert_true(on_it > 2);
    edit_scene(scene, EDITED("  - {line: [[9, 0], [9, 6]]}\n"
                             "  - {line: [[20, 0], [20, 6]]}\n"
                             "  - {line: [[10, 6], [10, 0], [0, 0], [0, 6]], closed: true}\n"));
    step_scene(scene, 1);
    assert_int_equal(counts(scene)->moved_out + counts(scene)->not_moved_out, on_it);
    all_are_in_the_hall(scene);
    jo_scene_free(scene);
}

/* People within a ring of thin walls are inside a solid once the ring becomes one. */
static void ring_that_becomes_solid_counts_as_new(void **state) {
    (void)state;
    static const char OPEN[] = "jostle: 1\n"
                               "walls: [{line: [[0, 0], [4, 0], [4, 4], [0, 4]], closed: true}]\n"
                               "groups: {people: {behaviour: own.lua, at: [[2, 2], [9, 9]]}}\n";
    JoScene *scene = load_scene_text(OPEN, STAY);
    step_scene(scene, 2);
    edit_scene(scene, "jostle: 1\n"
                      "walls: [{solid: [[0, 0], [4, 0], [4, 4], [0, 4]]}]\n"
                      "groups: {people: {behaviour: own.lua, at: [[2, 2], [9, 9]]}}\n");
    step_scene(scene, 1);
    assert_int_equal(counts(scene)->moved_out, 1);
    jo_scene_free(scene);
}

/* ---- births ---- */

static JoAgent add_agent_at(JoWorld *world, double x, double y, JoError *error) {
    JoAgentDef agent = jo_default_agent_def();
    agent.x = x;
    agent.y = y;
    return jo_world_add_agent(world, &agent, error);
}

/* A room of 2 x 2 m with a thin wall: it has room for some, and none is placed outside. */
static void births_in_a_full_room_are_refused(void **state) {
    (void)state;
    const JoWorldDef def = jo_default_world_def();
    JoWorld *world = jo_world_create(&def, NULL);
    const double room[] = {0, 0, 2, 0, 2, 2, 0, 2, 0, 0};
    JoError error = {0};
    uint32_t came = 0;
    assert_true(jo_world_add_line(world, room, 5, NULL));
    for (int n = 0; n < 200; n++) {
        const JoAgent one = add_agent_at(world, 0.5 + 0.01 * (n % 100), 1.0, &error);
        came += one.generation != 0;
        if (one.generation == 0)
            assert_non_null(strstr(error.text, "there is no free spot within 25 m of ("));
    }
    assert_in_range(came, 20, 40);
    assert_int_equal(jo_world_agent_count(world), came);
    assert_int_equal(counted(world)->not_placed, 200 - came);
    jo_world_step(world, 20);
    for (uint32_t i = 0; i < came; i++) {
        const JoxAgents *a = &world->state.agents;
        assert_true(a->x[i] > 0.0f && a->x[i] < 2.0f && a->y[i] > 0.0f && a->y[i] < 2.0f);
    }
    jo_world_free(world);
}

/* All fit within 25 m, each on the nearest free spot. */
static void thousands_of_births_at_a_point_spread_round_it(void **state) {
    (void)state;
    const JoWorldDef def = jo_default_world_def();
    JoWorld *world = jo_world_create(&def, NULL);
    enum { PEOPLE = 2500 / EFFORT_EACH };
    for (int n = 0; n < PEOPLE; n++)
        assert_true(add_agent_at(world, 3.0, -2.0, NULL).generation != 0);
    assert_int_equal(counted(world)->shifted_at_birth, PEOPLE - 1);
    const JoxAgents *a = &world->state.agents;
    float farthest = 0.0f;
    for (uint32_t i = 0; i < PEOPLE; i++)
        farthest = jox_maxf(farthest, hypotf(a->x[i] - 3.0f, a->y[i] + 2.0f));
    const float density = PEOPLE / (float)M_PI / (farthest * farthest); /* 1/m2 */
    assert_true(density > 8.0f && density < 14.0f);
    jo_world_free(world);
}

/* A world whose state was saved between births, and the world that restored it, continue alike. */
static void births_after_a_snapshot_are_equal_in_the_restored_world(void **state) {
    (void)state;
    const JoWorldDef def = jo_default_world_def();
    JoWorld *worlds[2] = {jo_world_create(&def, NULL), jo_world_create(&def, NULL)};
    JoxText saved = {0};
    JoError error = {0};
    for (int n = 0; n < 300; n++)
        add_agent_at(worlds[0], 0.1 * (n % 3), 0.0, NULL);
    assert_true(jox_world_snapshot(worlds[0], &saved, &error));
    if (!jox_world_restore(worlds[1], saved.data, saved.length, &error))
        fail_msg("%s", error.text);
    for (int w = 0; w < 2; w++) {
        for (int n = 0; n < 300; n++)
            add_agent_at(worlds[w], 0.05 * (n % 7), 0.1, NULL);
        jo_world_step(worlds[w], 3);
    }
    assert_true(jo_world_hash(worlds[0]) == jo_world_hash(worlds[1]));
    jox_text_free(&saved);
    jo_world_free(worlds[0]);
    jo_world_free(worlds[1]);
}

/* There is room behind the wall, and a little in the place. */
static void people_of_a_place_are_shifted_within_it_on_their_side(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        "jostle: 1\n"
        "places: {strip: {polygon: [[0, 0.2], [20, 0.2], [20, 1.2], [0, 1.2]]}}\n"
        "walls: [{line: [[-5, 0], [25, 0]]}]\n"
        "groups: {people: {behaviour: own.lua, count: 150, in: strip, fill: random}}\n",
        STAY);
    const JoxAgents *a = &scene->world->state.agents;
    assert_int_equal(a->count, 150);
    assert_true(counts(scene)->shifted_at_birth > 20);
    for (uint32_t i = 0; i < a->count; i++)
        if (!(a->x[i] > -0.01f && a->x[i] < 20.01f && a->y[i] > 0.19f && a->y[i] < 1.21f))
            fail_msg("agent %u at (%g, %g)", a->id[i], (double)a->x[i], (double)a->y[i]);
    jo_scene_free(scene);
}

static void people_born_in_a_wall_are_reported(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        "jostle: 1\n"
        "walls: [{solid: [[4, -1], [7, -1], [7, 1], [4, 1]]}]\n"
        "groups: {people: {behaviour: own.lua, starts: [[0, 0, 0], [0.2, 5, 0], [0.2, 9, 0]]}}\n",
        STAY);
    step_scene(scene, 10);
    assert_int_equal(scene->world->state.agents.count, 2);
    assert_int_equal(counts(scene)->not_placed, 1);
    assert_non_null(strstr(scene_messages.data,
                           "scene.yaml:3:10: t = 0.20 s: a person of group 'people' is "
                           "not placed: (5, 0) lies in a wall"));
    JoError error = {0};
    assert_int_equal(jo_world_spawn(scene->world, "people", 6, 0, &error).generation, 0);
    assert_string_equal(error.text, "(6, 0) lies in a wall");
    assert_int_equal(jo_scene_stats(scene).not_placed, 2);
    jo_scene_free(scene);
}

/* ---- state ---- */

/* Between the call that closes a gate and the next step, the list of new edges is state. */
static void new_edges_are_saved(void **state) {
    (void)state;
    const char *yaml = HALL("{line: [[8.5, 0], [8.5, 6]], name: gate, open: true}");
    JoScene *scene = load_scene_text(yaml, SEEK), *other = load_scene_text(yaml, SEEK);
    JoxText saved = {0};
    JoError error = {0};
    step_scene(scene, 100);
    apply_input(scene, "wall post 5 2 6 3");
    assert_true(jo_scene_open_wall(scene, "gate", false, &error));
    assert_true(jox_world_snapshot(scene->world, &saved, &error));
    if (!jox_world_restore(other->world, saved.data, saved.length, &error))
        fail_msg("%s", error.text);
    step_scene(scene, 3);
    step_scene(other, 3);
    assert_true(counts(scene)->moved_out > 0);
    assert_int_equal(counts(scene)->moved_out, counts(other)->moved_out);
    assert_true(jo_world_hash(scene->world) == jo_world_hash(other->world));
    jox_text_free(&saved);
    jo_scene_free(scene);
    jo_scene_free(other);
}

/* ---- every scene that ships ---- */

/* Adds a wall and a solid at least 50 m from all people along both axes, as edges may be joined
 * along one. No farther: fields of ways reach as far as the walls, and are computed again. */
static void add_far_walls(JoScene *scene) {
    const JoxAgents *a = &scene->world->state.agents;
    JoxV2 at = {0};
    char line[200];
    for (uint32_t i = 0; i < a->count; i++)
        at = jox_v2(jox_maxf(at.x, a->x[i] + 50.0f), jox_maxf(at.y, a->y[i] + 50.0f));
    const double x = (double)at.x, y = (double)at.y;
    snprintf(line, sizeof line, "wall far %.1f %.1f %.1f %.1f", x, y, x + 4, y);
    apply_input(scene, line);
    snprintf(line, sizeof line, "wall far %.1f %.1f %.1f %.1f %.1f %.1f %.1f %.1f", x, y, x + 4, y,
             x + 4, y + 4, x, y + 4);
    apply_input(scene, line);
}

static void far_wall_moves_nobody_of(const char *path) {
    JoScene *scene = load_small_scene(path);
    const JoxV2 period = scene->world->state.agents.period;
    if (period.x > 0.0f && period.y > 0.0f) { /* no wall is far from all */
        jo_scene_free(scene);
        return;
    }
    step_scene(scene, 50);
    const uint64_t before = counts(scene)->moved_out + counts(scene)->not_moved_out;
    add_far_walls(scene);
    step_scene(scene, 1);
    if (counts(scene)->moved_out + counts(scene)->not_moved_out != before)
        fail_msg("%s: people were moved by a wall 50 m away", path);
    jo_scene_free(scene);
}

static void wall_50_m_away_moves_nobody_of_any_shipped_scene(void **state) {
    (void)state;
    assert_true(visit_shipped_scenes(far_wall_moves_nobody_of) > 70);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gate_far_from_a_dense_crowd_moves_nobody),
        cmocka_unit_test(closing_gate_leaves_each_agent_on_its_side),
        cmocka_unit_test(people_leave_a_new_solid_through_no_other_wall),
        cmocka_unit_test(people_enclosed_in_a_solid_stay_and_are_reported),
        cmocka_unit_test(reload_moves_nobody_for_an_unchanged_wall),
        cmocka_unit_test(ring_that_becomes_solid_counts_as_new),
        cmocka_unit_test(births_in_a_full_room_are_refused),
        cmocka_unit_test(thousands_of_births_at_a_point_spread_round_it),
        cmocka_unit_test(births_after_a_snapshot_are_equal_in_the_restored_world),
        cmocka_unit_test(people_of_a_place_are_shifted_within_it_on_their_side),
        cmocka_unit_test(people_born_in_a_wall_are_reported),
        cmocka_unit_test(new_edges_are_saved),
        cmocka_unit_test(wall_50_m_away_moves_nobody_of_any_shipped_scene),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
