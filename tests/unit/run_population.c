/* Sources, parties, exits and events are the world's own: a program that steps the world of a scene
   gets them, and a state that was saved in their midst goes on to the bit. */
#include "unit/run_acted.h"

/* People who come from two sources, in parties of three, walk through a gate to where they leave;
   others cross a circle, each to a place of its own. */
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
    HEAD "\"Walk\", states = {\n"                                                                  \
         "  Walk = { steer = seek(own.goal), { to = \"Run\", when = heard \"hurry\" } },\n"        \
         "  Run = { steer = seek(own.goal), speed = 2 } } }\n"

enum { SAVED = JOX_BODIES_REINSERT_STEPS, AFTER = 200 };

static JoScene *crowd(void) {
    JoScene *scene =
        load_own(jox_bodies_available() ? CROWD(CRATE, THROW) : CROWD("", ""), WALKER_TO);
    scene->world->model.reinserts_bodies = true;
    return scene;
}

/* jo_scene_load, jo_scene_world, jo_world_step, and nothing else. */
static void a_program_steps_the_world_of_a_scene(void **state) {
    (void)state;
    JoScene *scene = crowd();
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

    scene = crowd(); /* the scene's own steps are the same */
    step(scene, 280);
    assert_true(jo_world_hash(jo_scene_world(scene)) == hash);
    jo_scene_free(scene);
}

static void note(JoScene *scene, uint64_t hashes[AFTER]) {
    for (int n = 0; n < AFTER; n++) {
        step(scene, 1);
        hashes[n] = jo_world_hash(scene->world);
    }
}

static void a_saved_crowd_goes_on_to_the_bit(void **state) {
    (void)state;
    uint64_t first[AFTER], second[AFTER];
    JoScene *scene = crowd(), *other = crowd();
    JoxText saved = {0};
    JoError error = {0};
    step(scene, SAVED);
    assert_true(jox_world_snapshot(scene->world, &saved, &error));
    const JoxExits then = scene->world->state.exits;
    note(scene, first);
    assert_true(scene->world->state.exits.left > then.left);
    for (int run = 0; run < 2; run++) { /* the same scene, and one that has not begun */
        JoScene *restored = run ? other : scene;
        if (!jox_world_restore(restored->world, saved.data, saved.length, &error))
            fail_msg("%s", error.text);
        assert_int_equal(restored->world->state.exits.left, then.left);
        assert_string_equal(restored->world->state.exits.items[0].name, "door");
        note(restored, second);
        for (int n = 0; n < AFTER; n++)
            if (first[n] != second[n])
                fail_msg("run %d: the hashes differ from step %d behind the snapshot on", run, n);
    }
    jox_text_free(&saved);
    jo_scene_free(scene);
    jo_scene_free(other);
}

/* What sources have made and whom the next party takes decides what comes: it is hashed. */
static void counts_of_sources_are_hashed(void **state) {
    (void)state;
    JoScene *scene = crowd();
    step(scene, 40);
    JoxPopulation *p = &scene->world->state.population;
    const uint64_t before = jo_world_hash(scene->world);
    p->made[0] += 1.0;
    assert_true(jo_world_hash(scene->world) != before);
    p->made[0] -= 1.0;
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

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_program_steps_the_world_of_a_scene),
                                       cmocka_unit_test(a_saved_crowd_goes_on_to_the_bit),
                                       cmocka_unit_test(counts_of_sources_are_hashed)};
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
