/* Tests of the state of a world: a restored state continues exactly, each cell of it is hashed, and
 * scratch memory may be cleared before any step. */
#include <math.h>

#include "unit/effort.h"
#include "unit/gate_ball_scene.h"

enum { BEFORE = 130, AFTER = 120 };

/* A crowd that uses queues, routes, signals, memory, random durations and pushes, with a gate
 * before the goal. */
#define TOWN                                                                                       \
    "jostle: 1\n"                                                                                  \
    "places:\n"                                                                                    \
    "  goal: {point: [14, 3], radius: 0.6}\n"                                                      \
    "  desk: {queue: [[3, 9], [0.5, 9]], spacing: 0.6}\n"                                          \
    "  east: {point: [13, 9]}\n"                                                                   \
    "  west: {point: [1, 1]}\n"                                                                    \
    "  ends: {set: [east, west]}\n"                                                                \
    "  square: {polygon: [[1, 1], [5, 1], [5, 8], [1, 8]]}\n"                                      \
    "walls:\n"                                                                                     \
    "  - {line: [[0, 0], [16, 0], [16, 11], [0, 11]], closed: true}\n"                             \
    "  - {line: [[6, 0], [6, 2]]}\n"                                                               \
    "  - {line: [[6, 4], [6, 8]]}\n"                                                               \
    "  - {line: [[6, 10], [6, 11]]}\n"                                                             \
    "  - {line: [[6, 2], [6, 4]], name: gate}\n"                                                   \
    "groups: {people: {behaviour: own.lua, count: 60, fill: random, in: square}}\n"
#define TOWNSFOLK(wait)                                                                            \
    "local mine = memory { turns = 0, waited = false }\n" MACHINE_START "\"Come\",\n"              \
    "  defaults = { speed = normal(1.3, 0.2), push = uniform(0, 60), perception = 3 },\n"          \
    "  states = {\n"                                                                               \
    "  Come = { steer = field \"goal\", lasts = normal(2, 0.6),\n"                                 \
    "    on_enter = function(me) me.turns = me.turns + 1 end,\n"                                   \
    "    { to = \"Queue\", when = lasted, chance = 0.7 },\n"                                       \
    "    { to = \"Roam\", when = pushed:above(60) } },\n"                                          \
    "  Queue = { steer = queue \"desk\", signal = { \"room\", every = 0.3 }, speed = 1,\n"         \
    "    { to = \"Roam\", when = first_in \"desk\" & after(" wait ") },\n"                         \
    "    { to = \"Roam\", when = stuck(0.4) } },\n"                                                \
    "  Roam = { steer = seek(one_of \"ends\") + 0.3 * evade, lasts = uniform(1, 3),\n"             \
    "    perception = 12, max_speed = clamp(headway, 0.4, 2),\n"                                   \
    "    { to = \"Come\", when = heard \"crowd\" },\n"                                             \
    "    { to = \"Come\", when = heard \"room\", chance = 0.3 },\n"                                \
    "    { to = \"Come\", when = lasted, set = { waited = true } } } } }\n"

static JoScene *load_town(void) {
    return load_scene_text(TOWN, TOWNSFOLK("1"));
}

static void take_snapshot(JoScene *scene, JoxText *out) {
    JoError error = {0};
    out->length = 0;
    if (!jox_world_snapshot(scene->world, out, &error))
        fail_msg("%s", error.text);
}

static void restore_snapshot(JoScene *scene, const JoxText *from) {
    JoError error = {0};
    if (!jox_world_restore(scene->world, from->data, from->length, &error))
        fail_msg("%s", error.text);
}

/* Steps to a moment with unfinished work of each kind: called and announced signals, a pending
 * entry hook, a set parameter, a route that is being made. */
static void step_until_busy(JoScene *scene, int steps, bool announces) {
    JoWorld *world = scene->world;
    const JoxMachineState *machines = &world->state.machines;
    step_scene(scene, steps);
    apply_input(scene, "set m Queue speed 0.5");
    apply_input(scene, "open gate");
    step_scene(scene, 2);
    for (int n = 0; n < 40 && machines->called_count == 0; n++)
        step_scene(scene, 1);
    if (announces) /* all agents respond to it, and not to the signals of others */
        apply_input(scene, "signal crowd");
    jox_machines_spawn(&world->machines, jox_world_add_agent(world, 2.0f, 2.0f), 0, NULL, NULL);
    assert_true(machines->called_count > 0 && machines->announced_count == announces);
    assert_true(machines->pending_count > 0 && machines->edit_count > 0);
}

/* Applies the same inputs after the snapshot each time. */
static void apply_inputs_of_step(JoScene *scene, int step_number) {
    switch (step_number) {
    case 10:
        apply_input(scene, "open gate");
        break;
    case 20:
        apply_input(scene, "set m defaults speed 0.7");
        break;
    case 30:
        apply_input(scene, "signal room");
        break;
    case 40:
        assert_true(reload_behaviour(scene, 0, TOWNSFOLK("0.5")));
        break;
    case 70:
        apply_input(scene, "close gate");
        break;
    case 90:
        assert_true(reload_behaviour(scene, 0, TOWNSFOLK("1")));
        break;
    }
}

static void record_next_hashes(JoScene *scene, uint64_t hashes[AFTER], bool meddles) {
    for (int n = 0; n < AFTER; n++) {
        if (meddles)
            apply_inputs_of_step(scene, n);
        step_scene(scene, 1);
        hashes[n] = jo_world_hash(scene->world);
    }
}

static void expect_same(const uint64_t a[AFTER], const uint64_t b[AFTER]) {
    for (int n = 0; n < AFTER; n++)
        if (a[n] != b[n])
            fail_msg("the hashes differ from step %d behind the snapshot on", n);
}

static void restored_world_continues_exactly(void **state) {
    (void)state;
    for (int meddles = 0; meddles < 2; meddles++) {
        JoScene *scene = load_town();
        JoxText saved = {0}, again = {0};
        uint64_t first[AFTER], second[AFTER];
        step_until_busy(scene, BEFORE + meddles,
                        meddles); /* so that agents are sorted at another step */
        take_snapshot(scene, &saved);
        uint64_t then = jo_world_hash(scene->world);
        record_next_hashes(scene, first, meddles);
        restore_snapshot(scene, &saved);
        assert_true(jo_world_hash(scene->world) == then);
        take_snapshot(scene, &again);
        JoxSections compared = jox_sections_compare(again.data, again.length);
        jox_world_sections(scene->world, &compared);
        assert_true(jox_sections_end(&compared));
        record_next_hashes(scene, second, meddles);
        expect_same(first, second);
        restore_snapshot(scene, &saved);
        record_next_hashes(scene, second, meddles);
        expect_same(first, second);
        jox_text_free(&saved);
        jox_text_free(&again);
        jo_scene_free(scene);
    }
}

/* Restores into the same world, and into another world of the same model. */
static void another_world_takes_over_the_state(void **state) {
    (void)state;
    JoScene *scene = load_town(), *other = load_town();
    JoxText saved = {0};
    uint64_t first[AFTER], second[AFTER];
    step_until_busy(scene, BEFORE, true);
    step_scene(other, 37);
    take_snapshot(scene, &saved);
    record_next_hashes(scene, first, false);
    restore_snapshot(other, &saved);
    record_next_hashes(other, second, false);
    expect_same(first, second);
    jox_text_free(&saved);
    jo_scene_free(scene);
    jo_scene_free(other);
}

/* People come in parties; some carry and throw a ball, others push over a wall of blocks, and
 * leave; at given times a gate opens and a ball is thrown in. */
#define YARD                                                                                       \
    "jostle: 1\n"                                                                                  \
    "places:\n"                                                                                    \
    "  door: {line: [[1, 1], [1, 7]]}\n"                                                           \
    "  court: {polygon: [[2, 1], [5, 1], [5, 7], [2, 7]]}\n"                                       \
    "  goal: {polygon: [[11.5, 1], [15, 1], [15, 7], [11.5, 7]]}\n"                                \
    "walls:\n"                                                                                     \
    "  - {line: [[0, 0], [16, 0], [16, 8], [0, 8]], closed: true}\n"                               \
    "  - {line: [[11, 0], [11, 8]], name: gate}\n"                                                 \
    "bodies:\n"                                                                                    \
    "  - {name: blocks, at: [7, 4, 0.5], shape: {blocks: {size: [0.3, 0.5, 0.25],"                 \
    " count: [1, 16, 4], bond: 1300 N, block_mass: 3 kg}}}\n"                                      \
    "  - {name: ball, at: [2, 4, 0.2], shape: {sphere: {radius: 0.12}}, mass: 0.5, tags: "         \
    "[ball]}\n"                                                                                    \
    "  - {name: crate, at: [9, 2, 0.4], shape: {box: {size: [0.8, 0.8, 0.8]}}, mass: 20}\n"        \
    "groups: {people: {behaviour: own.lua, count: 40, fill: random, party: 3,"                     \
    " in: court}}\n"                                                                               \
    "sources: [{at: door, like: people, rate: 3}, {at: door, like: people, keep: 50}]\n"           \
    "sinks: [{at: goal}]\n"                                                                        \
    "events: [{at: 7, open: gate}, {at: 8, every: 1.5, throw: ball, from: [12, 4, 2],"             \
    " velocity: [-9, 1, 0]}, {at: 9, signal: press}]\n"
#define YARDFOLK                                                                                   \
    "local ball = nearest \"ball\"\n" MACHINE_START                                                \
    "\"Walk\", defaults = { speed = normal(1.2, 0.2), perception = 3 }, states = {\n"              \
    "  Walk = { steer = field \"goal\" + 0.1 * together(1), push = 150, take = ball,\n"            \
    "    { to = \"Aim\", when = has(ball) },\n"                                                    \
    "    { to = \"Rest\", when = heard \"press\" | stuck(4), chance = 0.5 } },\n"                  \
    "  Aim = { steer = hold, lasts = uniform(0.2, 0.8), { to = \"Throw\", when = lasted } },\n"    \
    "  Throw = { steer = hold, throw = { ball, at = \"goal\", speed = 8 },\n"                      \
    "    { to = \"Walk\", when = ~has(ball) | after(1) } },\n"                                     \
    "  Rest = { steer = hold, lasts = 1, { to = \"Walk\", when = lasted } } } }\n"

/* The second half adds inputs: boxes are thrown in, and the crate is dragged. */
static void apply_yard_inputs(JoScene *scene, int step_number) {
    if (step_number == 15)
        apply_input(scene, "box 10 4 0.6 -9 0 0 0.4 60");
    if (step_number == 25)
        apply_input(scene, "grab 2 9 5 1");
    if (step_number == 60)
        apply_input(scene, "release 2");
}

static void record_yard_hashes(JoScene *scene, uint64_t hashes[AFTER]) {
    for (int n = 0; n < AFTER; n++) {
        apply_yard_inputs(scene, n);
        step_scene(scene, 1);
        hashes[n] = jo_world_hash(scene->world);
    }
}

static void bodies_sources_and_events_continue_exactly(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    JoScene *scene = load_scene_text(YARD, YARDFOLK), *other = load_scene_text(YARD, YARDFOLK);
    JoxText saved = {0};
    JoError error = {0};
    uint64_t first[AFTER], second[AFTER];
    const JoxStatistics *did = &scene->world->state.statistics;
    scene->world->model.reinserts_bodies = other->world->model.reinserts_bodies = true;
    step_scene(scene, JOX_BODIES_REINSERT_STEPS - 1);
    assert_false(jox_world_snapshot(scene->world, &saved, &error));
    assert_non_null(strstr(error.text, "after every 128 steps"));
    step_scene(scene, 1);
    take_snapshot(scene, &saved);
    const JoxStatistics before = *did;
    record_yard_hashes(scene, first);
    assert_true(did->spawned > before.spawned && did->removed > before.removed);
    assert_true(did->bonds.broken > before.bonds.broken);
    assert_true(did->throws > before.throws && before.pickups > 0 && did->opened > before.opened);
    restore_snapshot(scene, &saved);
    record_yard_hashes(scene, second);
    expect_same(first, second);
    step_scene(other, 40);
    restore_snapshot(other, &saved);
    record_yard_hashes(other, second);
    expect_same(first, second);
    jox_text_free(&saved);
    jo_scene_free(scene);
    jo_scene_free(other);
}

typedef struct Flips {
    JoScene *scene;
    uint64_t hash;
    size_t cells, flipped;
    char last[120];
    size_t last_flipped;
} Flips;

static void flip_cell(void *context, const char *section, size_t index, void *cell, size_t size,
                      bool hashed) {
    Flips *f = context;
    bool anew = strcmp(f->last, section) != 0;
    f->cells++;
    snprintf(f->last, sizeof f->last, "%s", section);
    f->last_flipped = anew ? 0 : f->last_flipped + 1;
    /* Visits the first cells of large sections, then fewer and fewer. */
    if (!hashed || (f->last_flipped > 2 && f->last_flipped % 997 != 0))
        return;
    for (size_t byte = 0; byte<size; byte += size> 64 ? 61 : EFFORT_EACH) {
        ((unsigned char *)cell)[byte] ^= 1;
        if (jo_world_hash(f->scene->world) == f->hash)
            fail_msg("cell %zu, byte %zu of %s is not hashed", index, byte, section);
        ((unsigned char *)cell)[byte] ^= 1;
        f->flipped++;
    }
}

static void flip_all_cells(JoScene *scene, size_t least) {
    Flips f = {.scene = scene, .hash = jo_world_hash(scene->world)};
    JoxSections s = jox_sections_visit(flip_cell, &f);
    jox_world_sections(scene->world, &s);
    assert_true(jo_world_hash(scene->world) == f.hash);
    assert_true(f.flipped > least);
    jo_scene_free(scene);
}

static void each_cell_of_the_state_is_hashed(void **state) {
    (void)state;
    JoScene *scene = load_town();
    step_until_busy(scene, BEFORE, true);
    flip_all_cells(scene, 700 / EFFORT_EACH);
    if (!jox_bodies_available())
        return;
    scene = load_scene_text(YARD, YARDFOLK);
    step_scene(scene, JOX_BODIES_REINSERT_STEPS);
    apply_input(scene, "box 12 4 2 -6 0 0 0.4 10");
    apply_input(scene, "grab 2 9 5 1");
    flip_all_cells(scene, 1400 / EFFORT_EACH);
}

/* A value that scratch memory carried from step to step would change the hash. */
static void clear_scratch_each_step(const char *scene_text, const char *behaviour,
                                    void meddles(JoScene *scene, int step_number)) {
    uint64_t plain[AFTER], forgetful[AFTER];
    for (int forgets = 0; forgets < 2; forgets++) {
        JoScene *scene = load_scene_text(scene_text, behaviour);
        for (int n = 0; n < AFTER; n++) {
            if (forgets)
                jox_world_forget(scene->world);
            meddles(scene, n);
            step_scene(scene, 1);
            (forgets ? forgetful : plain)[n] = jo_world_hash(scene->world);
        }
        jo_scene_free(scene);
    }
    expect_same(plain, forgetful);
}

static void scratch_may_be_forgotten_at_every_step(void **state) {
    (void)state;
    clear_scratch_each_step(TOWN, TOWNSFOLK("1"), apply_inputs_of_step);
    if (jox_bodies_available())
        clear_scratch_each_step(YARD, YARDFOLK, apply_yard_inputs);
}

static void expect_refused(JoScene *scene, const JoxText *saved, const char *reason) {
    JoError error = {0};
    uint64_t before = jo_world_hash(scene->world);
    assert_false(jox_world_restore(scene->world, saved->data, saved->length, &error));
    if (!strstr(error.text, reason))
        fail_msg("'%s' does not say '%s'", error.text, reason);
    assert_true(jo_world_hash(scene->world) == before);
    step_scene(scene, 3);
}

static void state_of_another_model_is_refused(void **state) {
    (void)state;
    JoScene *scene = load_town();
    JoxText saved = {0}, damaged = {0};
    step_scene(scene, 20);
    take_snapshot(scene, &saved);
    jox_text_append(&damaged, saved.data, saved.length);
    damaged.data[saved.length / 2] ^= 1;
    expect_refused(scene, &damaged, "checksum");
    damaged.length = 100;
    expect_refused(scene, &damaged, "damaged");
    jo_scene_free(scene);
    scene = load_scene_text(TOWN, MACHINE_START "\"A\", states = { A = { steer = hold } } }\n");
    expect_refused(scene, &saved, "machines.m: it has changed");
    jo_scene_free(scene);
    scene = load_scene_text(TOWN "seed: 9\n", TOWNSFOLK("1"));
    expect_refused(scene, &saved, "world.seed: it has changed");
    jo_scene_free(scene);
    jox_text_free(&saved);
    jox_text_free(&damaged);
}

static void step_until_called(JoScene *scene) {
    const JoxMachineState *machines = &scene->world->state.machines;
    for (int n = 0; n < 400 && machines->called_count == 0; n++)
        step_scene(scene, 1);
    assert_true(machines->called_count > 0);
}

/* Well-formed states with correct checksums and impossible values, which would be used as an index.
 */
static void invalid_state_is_refused(void **state) {
    (void)state;
    JoScene *scene = load_town();
    JoWorld *world = scene->world;
    JoxAgents *a = &world->state.agents;
    JoxText odd = {0};
    step_scene(scene, 20);
#define REFUSED_AS(reason, variable, value)                                                        \
    do {                                                                                           \
        const __typeof__(variable) was = (variable);                                               \
        (variable) = (value);                                                                      \
        take_snapshot(scene, &odd);                                                                \
        (variable) = was;                                                                          \
        expect_refused(scene, &odd, reason);                                                       \
    } while (0)
#define REFUSED(variable, value) REFUSED_AS("it is none of a run", variable, value)
    REFUSED(a->group[3], 7);
    REFUSED(a->goal[3], 9999);
    REFUSED(a->bound[3], UINT32_MAX);
    REFUSED(a->queue_at[3], INT32_MAX);
    REFUSED(a->arrived_at[3], INT32_MAX);
    REFUSED(a->kicked[3], 5);
    REFUSED(a->x[3], 1e30f);
    REFUSED(a->y[3], NAN);
    REFUSED(a->vx[3], INFINITY);
    REFUSED(a->vy[3], 1e30f);
    jox_param_differ(a, JOX_PARAM_radius);
    REFUSED(a->param[JOX_PARAM_radius].cells[3], -1.0f);
    jox_param_differ(a, JOX_PARAM_perception);
    REFUSED(a->param[JOX_PARAM_perception].cells[3], NAN);
    jox_param_differ(a, JOX_PARAM_neighbours);
    REFUSED(a->param[JOX_PARAM_neighbours].cells[3], 1e6f);
    REFUSED(world->state.tick, (uint64_t)1 << 40);
    REFUSED(world->state.statistics.removed, 1u << 30);
    REFUSED(world->state.statistics.failures, UINT64_MAX);
    REFUSED_AS("machines.state", a->was_true[3], UINT32_MAX);
    REFUSED_AS("machines.state", a->given[3], UINT64_MAX);
    step_until_called(scene);
    REFUSED_AS("machines.called", world->state.machines.called[0].x, NAN);
    step_until_called(scene);
    REFUSED_AS("machines.called", world->state.machines.called[0].agent_id, UINT32_MAX);
    jox_text_free(&odd);
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(restored_world_continues_exactly),
        cmocka_unit_test(another_world_takes_over_the_state),
        cmocka_unit_test(bodies_sources_and_events_continue_exactly),
        cmocka_unit_test(each_cell_of_the_state_is_hashed),
        cmocka_unit_test(scratch_may_be_forgotten_at_every_step),
        cmocka_unit_test(state_of_another_model_is_refused),
        cmocka_unit_test(invalid_state_is_refused),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
