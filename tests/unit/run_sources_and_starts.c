/* Tests that sources, parties, exits and events belong to the world: they work for a program that
 * steps the world of a scene, and a restored state continues exactly. */
#include "unit/gate_ball_scene.h"

#include "agents/torso.h"
#include "jostle_tools.h"
#include "nav/nav_state.h"

/* People come from two sources in parties of three and walk through a gate to an exit; others cross
 * a circle to the opposite side. */
#define CROWD(bodies, events)                                                                      \
    "jostle: 1\n"                                                                                  \
    "places:\n"                                                                                    \
    "  yard: {polygon: [[1, 1], [5, 1], [5, 9], [1, 9]]}\n"                                        \
    "  door: {polygon: [[12, 3], [15, 3], [15, 7], [12, 7]]}\n"                                    \
    "  ring: {point: [5, 30], radius: 4}\n"                                                        \
    "walls:\n"                                                                                     \
    "  - {line: [[8, -5], [8, 4]]}\n"                                                              \
    "  - {line: [[8, 4], [8, 6]], name: gate}\n"                                                   \
    "  - {line: [[8, 6], [8, 15]]}\n" bodies "groups:\n"                                           \
    "  people: {behaviour: own.lua, count: 20, party: 3, in: yard, set: {goal: door}}\n"           \
    "  others: {behaviour: own.lua, count: 6, fill: circle, in: ring, set: {goal: antipode}}\n"    \
    "sources:\n"                                                                                   \
    "  - {at: yard, like: people, rate: 1.7, from: 0.5}\n"                                         \
    "  - {at: yard, like: people, keep: 22}\n"                                                     \
    "sinks: [{at: door}]\n"                                                                        \
    "events:\n"                                                                                    \
    "  - {at: 2, open: gate}\n"                                                                    \
    "  - {at: 11, close: gate}\n"                                                                  \
    "  - {at: 13, every: 0.7, open: gate}\n"                                                       \
    "  - {at: 7, signal: hurry}\n" events
#define CRATE                                                                                      \
    "bodies: [{name: crate, shape: {box: {size: [0.6, 0.6, 0.6]}}, mass: 15, at: [10, 5, 0.3]}]\n"
#define THROW "  - {at: 8, throw: crate, from: [11, 5, 2], velocity: [-4, 0, 1]}\n"
#define WALKER_TO                                                                                  \
    MACHINE_START                                                                                  \
    "\"Walk\", states = {\n"                                                                       \
    "  Walk = { steer = seek(own.goal), { to = \"Run\", when = heard \"hurry\" } },\n"             \
    "  Run = { steer = seek(own.goal), speed = 2 } } }\n"

enum { SAVED = JOX_BODIES_REINSERT_STEPS, AFTER = 200 };

static JoScene *load_crowd(void) {
    JoScene *scene =
        load_scene_text(jox_bodies_available() ? CROWD(CRATE, THROW) : CROWD("", ""), WALKER_TO);
    scene->world->model.reinserts_bodies = true;
    return scene;
}

/* Uses jo_scene_load, jo_scene_world and jo_world_step alone. */
static void program_can_step_the_world_of_a_scene(void **state) {
    (void)state;
    JoScene *scene = load_crowd();
    JoWorld *world = jo_scene_world(scene);
    const uint32_t before = jo_world_agent_count(world);
    assert_int_equal(before, 26);
    jo_world_step(world, 39); /* 1.95 s: two have come, and the gate is shut */
    assert_in_range(jo_world_agent_count(world), 28, 30);
    for (uint32_t i = 0; i < world->state.agents.count; i++)
        assert_true(world->state.agents.x[i] < 8.0f);
    assert_int_equal(world->state.exits.left, 0);
    jo_world_step(world, 241); /* 14 s */
    assert_true(world->state.exits.left > 5);
    assert_int_equal(world->state.exits.count, 1);
    assert_string_equal(world->state.exits.items[0].name, "door");
    assert_int_equal(world->state.exits.items[0].people, world->state.exits.left);
    assert_int_equal(world->state.statistics.opened, 3);
    assert_int_equal(world->state.statistics.closed, 1);
    assert_int_equal(world->state.statistics.announced, 1);
    if (jox_bodies_available())
        assert_int_equal(world->state.statistics.throws, 1);
    const uint64_t hash = jo_world_hash(world);
    jo_scene_free(scene);

    scene = load_crowd(); /* the scene's own steps are the same */
    step_scene(scene, 280);
    assert_true(jo_world_hash(jo_scene_world(scene)) == hash);
    jo_scene_free(scene);
}

static void record_hashes(JoScene *scene, uint64_t hashes[AFTER]) {
    for (int n = 0; n < AFTER; n++) {
        step_scene(scene, 1);
        hashes[n] = jo_world_hash(scene->world);
    }
}

static void saved_crowd_continues_exactly(void **state) {
    (void)state;
    uint64_t first[AFTER], second[AFTER];
    JoScene *scene = load_crowd(), *other = load_crowd();
    JoxText saved = {0};
    JoError error = {0};
    step_scene(scene, SAVED);
    assert_true(jox_world_snapshot(scene->world, &saved, &error));
    const JoxExits then = scene->world->state.exits;
    record_hashes(scene, first);
    assert_true(scene->world->state.exits.left > then.left);
    for (int run = 0; run < 2; run++) { /* the scene itself, and a new one */
        JoScene *restored = run ? other : scene;
        if (!jox_world_restore(restored->world, saved.data, saved.length, &error))
            fail_msg("%s", error.text);
        assert_int_equal(restored->world->state.exits.left, then.left);
        assert_string_equal(restored->world->state.exits.items[0].name, "door");
        record_hashes(restored, second);
        for (int n = 0; n < AFTER; n++)
            if (first[n] != second[n])
                fail_msg("run %d: the hashes differ from step %d behind the snapshot on", run, n);
    }
    jox_text_free(&saved);
    jo_scene_free(scene);
    jo_scene_free(other);
}

/* The counts of sources and the open party decide who comes next, so they are hashed. */
static void counts_of_sources_are_hashed(void **state) {
    (void)state;
    JoScene *scene = load_crowd();
    step_scene(scene, 40);
    JoxPopulation *p = &scene->world->state.population;
    const uint64_t before = jo_world_hash(scene->world);
    scene->world->state.sources.made[0] += 1.0;
    assert_true(jo_world_hash(scene->world) != before);
    scene->world->state.sources.made[0] -= 1.0;
    scene->world->state.sources.arrivals[0].next += 0.5;
    assert_true(jo_world_hash(scene->world) != before);
    scene->world->state.sources.arrivals[0].next -= 0.5;
    assert_true(jo_world_hash(scene->world) == before);
    p->party_left[0]++;
    assert_true(jo_world_hash(scene->world) != before);
    p->party_left[0]--;
    p->next_party++;
    assert_true(jo_world_hash(scene->world) != before);
    p->next_party--;
    scene->world->model.places[scene->world->model.scene_places].points[0].x += 1.0f;
    assert_true(jo_world_hash(scene->world) != before);
    jo_scene_free(scene);
}

/* ---- sources in full places ---- */

#define FULL_YARD(shape)                                                                           \
    "jostle: 1\n"                                                                                  \
    "places: {yard: {" shape "}}\n"                                                                \
    "groups: {people: {behaviour: own.lua, count: 0, in: yard}}\n"                                 \
    "sources: [{at: yard, like: people, rate: 400}]\n"
#define STANDER MACHINE_START "\"Stand\", states = { Stand = { steer = hold } } }\n"

/* An agent without room waits, and comes in once others have left. */
static void expect_waiting(const char *yaml, uint32_t most) {
    JoScene *scene = load_scene_text(yaml, STANDER);
    JoWorld *world = jo_scene_world(scene);
    JoxAgents *a = &world->state.agents;
    step_scene(scene, 40);
    const uint32_t full = a->count;
    assert_in_range(full, 3, most);
    for (uint32_t i = 0; i < a->count; i++) {
        assert_true(fabsf(a->x[i]) < 5.0f && fabsf(a->y[i]) < 5.0f);
        a->removed[i] = true;
    }
    jox_agents_compact(a);
    step_scene(scene, 3);
    assert_in_range(world->state.statistics.spawned, full + 3, 2 * most);
    assert_in_range(a->count, 3, most);
    jo_scene_free(scene);
}

static void source_waits_while_its_place_is_full(void **state) {
    (void)state;
    expect_waiting(FULL_YARD("polygon: [[0, 0], [3, 0], [3, 3], [0, 3]]"), 110);
    expect_waiting(FULL_YARD("polygon: [[0, 0], [0.1, 0], [0.1, 0.1], [0, 0.1]]"), 12);
    expect_waiting(FULL_YARD("point: [0, 0], radius: 0.1"), 12);
    expect_waiting(FULL_YARD("line: [[0, 0], [2, 0]]"), 30);
}

/* ---- starts ---- */

#define STARTS(rows)                                                                               \
    "jostle: 1\n"                                                                                  \
    "places: {far: {point: [50, 0], radius: 1}}\n"                                                 \
    "groups: {people: {behaviour: own.lua, starts: " rows ", set: {goal: far}}}\n"
#define STAND                                                                                      \
    MACHINE_START "\"Stand\", states = {\n"                                                        \
                  "  Stand = { steer = hold, { to = \"Go\", when = heard \"go\" } },\n"            \
                  "  Go = { steer = seek(own.goal) } } }\n"

static bool stands_at(const JoWorld *w, uint32_t i, float x, float y) {
    return fabsf(w->state.agents.x[i] - x) < 1e-6f && fabsf(w->state.agents.y[i] - y) < 1e-6f;
}

/* Rows may be in any order. Agents that start at 0 s exist before the first step; others come in
 * with the first step that begins at their time or later. */
static void agents_start_at_their_times_and_places(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        STARTS("[[1.02, 3, 4], [0, 0, 0], [0.5, 9, 9, 0, -1.5], [0, 6, 0, 1, 0]]"), STAND);
    JoWorld *w = scene->world;
    const JoxAgents *a = &w->state.agents;
    assert_int_equal(a->count, 2);
    assert_true(stands_at(w, 0, 0, 0) && stands_at(w, 1, 6, 0));
    assert_true(a->vx[1] == 1.0f && a->face_x[1] == 1.0f && a->vx[0] == 0.0f);
    step_scene(scene, 10); /* 0.5 s */
    assert_int_equal(a->count, 2);
    step_scene(scene, 1);
    assert_int_equal(a->count, 3);
    const uint32_t third = a->slot_index[2];
    assert_true(fabsf(a->x[third] - 9) < 0.01f && a->y[third] < 9 && a->y[third] > 8.9f);
    assert_true(a->face_y[third] < -0.99f);
    step_scene(scene, 10); /* to 1.05 s: its step begins at 1.0 */
    assert_int_equal(a->count, 3);
    step_scene(scene, 1);
    assert_int_equal(a->count, 4);
    step_scene(scene, 100);
    assert_int_equal(a->count, 4);
    assert_int_equal(w->state.population.all_until, 2);
    jo_scene_free(scene);
}

static void expect_closing(const JoScene *scene, const char *text) {
    char *closing = jo_scene_closing(scene);
    if (!strstr(closing, text))
        fail_msg("%s", closing);
    jo_free(closing);
}

static void expect_starts_waiting(const JoScene *scene, double people) {
    JoFigures *figures = jo_scene_figures(scene);
    assert_true(jo_figure(figures, "starts_waiting") == people);
    jo_free(figures);
}

/* An agent waits while another stands at its start; agents with other starts do not wait for it. */
static void agent_waits_while_its_start_is_occupied(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text(STARTS("[[0, 0, 0], [0.5, 0.1, 0], [0.6, 5, 0], [0.7, 0.35, 0]]"), STAND);
    JoWorld *w = scene->world;
    const JoxAgents *a = &w->state.agents;
    step_scene(scene, 40);
    assert_int_equal(a->count, 3);
    assert_int_equal(w->state.statistics.shifted_at_birth, 0);
    assert_int_equal(w->state.population.all_until, 0);
    expect_closing(scene, "1 person of group 'people'");
    expect_closing(scene, "did not come in at the time given");
    expect_starts_waiting(scene, 1);
    jo_scene_free(scene);

    scene = load_scene_text(STARTS("[[0, 0, 0], [0.5, 0.1, 0], [0.6, 5, 0]]"), STAND);
    w = scene->world;
    step_scene(scene, 40);
    assert_int_equal(w->state.agents.count, 2);
    jo_world_remove_agent(w, (JoAgent){0, w->state.agents.slot_generation[0]});
    step_scene(scene, 1);
    assert_int_equal(w->state.agents.count, 2);
    assert_int_equal(w->state.population.all_until, 2);
    expect_starts_waiting(scene, 0);
    jo_scene_free(scene);
}

#define COME_IN(starts, set)                                                                       \
    "jostle: 1\ngroups: {people: {behaviour: own.lua, facing: 90, starts: " starts ", set: {" set  \
    "}}}\n"

/* Newcomers beside others turn their chests as far as they must; those in others all the same are
   counted. */
static void newcomers_turn_their_chests_out_of_others(void **state) {
    (void)state;
    JoScene *scene =
        load_scene_text(COME_IN("[[0, 0, 0], [0.5, 0.37, 0], [0.5, 0.74, 0], [0.5, 3, 0]]",
                                "breadth: 0.45, depth: 0.25"),
                        STANDER);
    const JoxAgents *a = &scene->world->state.agents;
    step_scene(scene, 11);
    assert_int_equal(a->count, 4);
    for (uint32_t i = 0; i < a->count; i++)
        assert_true(a->id[i] == 1 ? fabsf(a->chest_x[i]) > 0.95f : a->chest_y[i] > 0.95f);
    JoxTorsos torsos = {0};
    assert_true(jox_torsos_list(&torsos, a, false));
    for (uint32_t i = 0; i < a->count; i++)
        for (uint32_t j = 0; j < i; j++)
            assert_true(jox_torsos_gap(&torsos, a, i, j) > -2e-3f);
    jox_torsos_free(&torsos);
    assert_int_equal(scene->world->state.statistics.born_in_others, 0);
    apply_input(scene, "spawn people 3.37 0");
    step_scene(scene, 1);
    assert_true(a->id[4] == 4 && fabsf(a->chest_x[4]) > 0.95f);
    jo_scene_free(scene);

    scene = load_scene_text(COME_IN("[[0, 0, 0], [0.5, 0.16, 0], [0.6, 0, 3]]",
                                    "radius: 0.1, breadth: 0.29, depth: 0.25"),
                            STANDER);
    step_scene(scene, 40);
    assert_int_equal(scene->world->state.statistics.born_in_others, 1);
    expect_closing(scene, "1 person came in with their torso in another, up to 0.11 m deep");
    jo_scene_free(scene);
}

/* A search that ends at its limit does not prove that there is no room. */
static void search_for_room_that_hits_its_limit_is_reported(void **state) {
    (void)state;
    JoScene *scene = load_scene_text("jostle: 1\nplaces: {hall: {point: [0, 0], radius: 5}}\n"
                                     "groups: {people: {behaviour: own.lua, count: 569, fill: hex, "
                                     "in: hall, spacing: 0.4}}\n",
                                     STANDER);
    JoWorld *w = scene->world;
    uint32_t agent;
    JoxText told = {0};
    assert_int_equal(jox_world_spawn_at(w, 0, jox_v2(0, 0), &agent), JOX_BIRTH_SHIFTED);
    w->scratch.nav->spots.looked = JOX_SPOTS_MOST;
    const JoxBirthSpot spot = jox_world_spawn_at(w, 0, jox_v2(1, 0), &agent);
    assert_int_equal(spot, JOX_BIRTH_NOT_FOUND);
    jox_world_explain_unplaced(&w->model.storeys, spot, jox_v2(1, 0), &told);
    assert_non_null(strstr(told.data, "was ended, as 5000000 spots had been looked at"));
    jox_text_free(&told);
    w->scratch.nav->spots.looked = 0;
    assert_int_equal(jox_world_spawn_at(w, 0, jox_v2(1, 0), &agent), JOX_BIRTH_SHIFTED);
    jo_scene_free(scene);
}

/* Beside a thin wall there is no room for an agent: it is moved away from the wall, not through it,
 * also if the nearest room is on the other side. */
static void nobody_is_born_through_a_wall(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        STARTS("[[0, 0.6, -0.6], [0, 0.6, -0.3], [0, 0.6, 0], [0, 0.6, 0.3], "
               "[0, 0.6, 0.6], [0.1, 0.98, 0.05], [0.2, 1.02, 3]]") "walls: [{line: [[1, "
                                                                    "-20], [1, 20]]}]\n",
        STAND);
    const JoxAgents *a = &scene->world->state.agents;
    step_scene(scene, 10);
    assert_int_equal(a->count, 7);
    assert_int_equal(scene->world->state.statistics.shifted_at_birth, 2);
    for (uint32_t i = 0; i < a->count; i++)
        if (a->id[i] == 6 ? a->x[i] < 1.15f : a->x[i] > 0.85f)
            fail_msg("person %u stands at x = %g", a->id[i], (double)a->x[i]);
    jo_scene_free(scene);
}

/* A state saved while some agents have not started continues exactly, also in a new world; which
 * agents have started is hashed. */
static void started_agents_are_state(void **state) {
    (void)state;
    static const char ROWS[] = STARTS("[[0, 0, 0], [0.5, 0.1, 0], [1, 5, 0], [2.5, 8, 0], "
                                      "[2.6, 9, 3, 1, 1], [30, 1, 1]]");
    uint64_t first[AFTER], second[AFTER];
    JoScene *scene = load_scene_text(ROWS, WALKER_TO), *other = load_scene_text(ROWS, WALKER_TO);
    JoxText saved = {0};
    JoError error = {0};
    step_scene(scene, 30);
    assert_int_equal(scene->world->state.agents.count, 3);
    assert_true(jox_world_snapshot(scene->world, &saved, &error));
    const uint64_t before = jo_world_hash(scene->world);
    scene->world->state.population.entered[2] ^= 1;
    assert_true(jo_world_hash(scene->world) != before);
    scene->world->state.population.entered[2] ^= 1;
    record_hashes(scene, first);
    if (!jox_world_restore(other->world, saved.data, saved.length, &error))
        fail_msg("%s", error.text);
    record_hashes(other, second);
    assert_memory_equal(first, second, sizeof first);
    assert_int_equal(other->world->state.agents.count, 5);
    jox_text_free(&saved);
    jo_scene_free(scene);
    jo_scene_free(other);
}

/* A regression: 9 people were placed in 6 m2 at 2 per m2, as floor within 0.2 m of walls did not
 * count. */
static void density_counts_the_floor_up_to_walls(void **state) {
    (void)state;
    JoScene *scene = load_scene_text("jostle: 1\n"
                                     "places:\n"
                                     "  room: {polygon: [[0, 0], [3, 0], [3, 2], [0, 2]]}\n"
                                     "  hall: {polygon: [[5, 0], [15, 0], [15, 10], [5, 10]]}\n"
                                     "walls:\n"
                                     "  - {line: [[0, 0], [3, 0], [3, 2], [0, 2], [0, 0]]}\n"
                                     "  - {solid: [[8, 4], [10, 4], [10, 6], [8, 6]]}\n"
                                     "groups:\n"
                                     "  a: {behaviour: own.lua, density: 2, in: room}\n"
                                     "  b: {behaviour: own.lua, density: 2, in: hall}\n",
                                     WALKER);
    const JoxAgents *a = &scene->world->state.agents;
    uint32_t in_room = 0;
    for (uint32_t i = 0; i < a->count; i++) {
        assert_true(a->x[i] > 0.15f && a->y[i] > 0 && (a->x[i] < 2.85f || a->x[i] > 5));
        in_room += a->x[i] < 3;
    }
    assert_int_equal(in_room, 12);
    assert_int_equal(a->count - in_room, 192);
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(program_can_step_the_world_of_a_scene),
        cmocka_unit_test(density_counts_the_floor_up_to_walls),
        cmocka_unit_test(saved_crowd_continues_exactly),
        cmocka_unit_test(counts_of_sources_are_hashed),
        cmocka_unit_test(source_waits_while_its_place_is_full),
        cmocka_unit_test(agents_start_at_their_times_and_places),
        cmocka_unit_test(agent_waits_while_its_start_is_occupied),
        cmocka_unit_test(newcomers_turn_their_chests_out_of_others),
        cmocka_unit_test(search_for_room_that_hits_its_limit_is_reported),
        cmocka_unit_test(nobody_is_born_through_a_wall),
        cmocka_unit_test(started_agents_are_state)};
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
