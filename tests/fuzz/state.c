/* Edits a saved state (support/edits.h) and corrects its checksum. A state that is restored runs
   for a few steps; then the original state is restored and must give the same hashes. FUZZ_SHOW=1
   prints what each edit changes. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/guard.h"
#include "run/run.h"
#include "support/edits.h"
#include "support/fuzz.h"

/* A small scene that fills every section of the state. */
static const char SCENE[] =
    "jostle: 1\n"
    "seed: 1\n"
    "places:\n"
    "  goal: {point: [3.2, 0.8], radius: 0.3}\n"
    "  desk: {queue: [[1.4, 2.1], [0.3, 2.1]], spacing: 0.6}\n"
    "  out: {polygon: [[2.8, 1.8], [3.5, 1.8], [3.5, 2.3], [2.8, 2.3]]}\n"
    "  ends: {set: [goal, out]}\n"
    "walls:\n"
    "  - {line: [[0, 0], [3.6, 0], [3.6, 2.4], [0, 2.4]], closed: true}\n"
    "  - {line: [[2, 1.8], [2, 2.4]], name: gate}\n"
    "bodies:\n"
    "  - {name: blocks, at: [2.6, 0.3, 0.25], shape: {blocks: {size: [0.2, 0.2, 0.25],"
    " count: [1, 2, 2], bond: 800 N, block_mass: 3 kg}}}\n"
    "  - {name: ball, at: [0.7, 1.2, 0.12], shape: {sphere: {radius: 0.12}}, mass: 0.5,"
    " tags: [ball]}\n"
    "  - {name: door, at: [3.4, 0.4, 3], shape: {box: {size: [0.1, 0.5, 1]}}, kinematic: true,"
    " path: {through: [[3.4, 1.5, 3]], speed: 1, wait: 0.2, end: back}}\n"
    "  - {name: bar, at: [1.2, 1.6, 3], shape: {box: {size: [1, 0.1, 0.2]}}, kinematic: true,"
    " spin: [0, 0, 1]}\n"
    "  - {name: crate, at: [1.6, 0.4, 0.3], shape: {box: {size: [0.7, 0.4, 0.6]}}, mass: 60}\n"
    "groups:\n"
    "  pairs: {behaviour: own.lua, at: [[0.5, 0.5], [0.5, 1], [1.2, 1.2]], party: 2, tags: [red]}\n"
    "  round: {behaviour: own.lua, at: [[2.4, 1.2]], set: {aim: antipode}}\n"
    "sources: [{at: goal, like: pairs, every: 1, people: 1}]\n"
    "sinks: [{at: out}]\n"
    "events: [{at: 4, signal: all}, {at: 6.6, open: gate}]\n";
static const char BEHAVIOUR[] =
    "local mine, ball = memory { turns = 0, calm = true, mate = nobody, met = list(3, nobody),\n"
    "  times = list(2) }, nearest \"ball\"\n"
    "local hello, mate = told \"hello\", nearest \"red\"\n"
    "return machine { name = \"m\", version = 1, start = \"Walk\",\n"
    "  defaults = { speed = normal(1.3, 0.2), push = uniform(0, 60), perception = 3 },\n"
    "  own = { aim = \"goal\" },\n"
    "  states = {\n"
    "    Walk = { steer = field \"goal\", lasts = normal(1, 0.3), push = 100, take = ball,\n"
    "      on_enter = function(me) me.turns = me.turns + 1 end, set = { mate = mate },\n"
    "      { when = hello, every = 0.3, set = { met = mine.met:push(hello.sender),\n"
    "        times = mine.times:push(now.time) } },\n"
    "      { when = after(0), tell = { neighbours \"red\", \"hello\", n = mine.turns, "
    "who = "
    "mate } },\n"
    "      { to = \"Queue\", when = lasted, chance = 0.7 }, { to = \"Throw\", when = has(ball) } "
    "},\n"
    "    Queue = { steer = queue \"desk\", signal = { \"all\", every = 0.3 },\n"
    "      { to = \"Roam\", when = first_in \"desk\" & after(0.5) },\n"
    "      { to = \"Roam\", when = stuck(0.4) } },\n"
    "    Throw = { steer = hold, throw = { ball, at = \"goal\", speed = 6 },\n"
    "      { to = \"Hold\", when = ~has(ball) | after(1) } },\n"
    "    Hold = { grasp = mine.mate, grip = 200, { to = \"Walk\", when = after(0.8) },\n"
    "      runs = machine { start = \"Pull\", states = {\n"
    "        Pull = { steer = seek(last_seen(mine.mate)), lasts = uniform(0.1, 0.2), { to = "
    "\"Look\", "
    "when = lasted } },\n"
    "        Look = { steer = hold, { to = back, when = after(0.1) } } } } },\n"
    "    Roam = { steer = seek(own.aim) + 0.3 * evade, lasts = uniform(0.5, 1),\n"
    "      { to = \"Walk\", when = heard \"all\" | lasted, set = { calm = false } } } } }\n";

enum { STEPS = 4 };

static JoScene *scene;
static JoxText base;
static uint64_t base_hash, later_hash;

/* ---- a world in which everything is under way ---- */

static bool restore_world(const JoxText *state, JoError *error) {
    JOX_GUARD (scene->heap, error)
        return false;
    return jox_world_restore(scene->world, state->data, state->length, error);
}

/* Runs steps until one fails. */
static void step_world(int steps) {
    JOX_GUARD (scene->heap, NULL)
        return;
    while (steps-- > 0 && jox_world_step(scene->world))
        jox_text_free(&scene->world->scratch.messages);
    jox_text_free(&scene->world->scratch.messages);
}

static bool save_world(JoxText *out) {
    JoError error = {0};
    JOX_GUARD (scene->heap, &error)
        return false;
    return jox_world_snapshot(scene->world, out, &error);
}

static void apply_line(const char *line) {
    JoError error = {0};
    if (!jo_scene_input(scene, line, &error)) {
        fprintf(stderr, "%s: %s\n", line, error.text);
        abort();
    }
}

static void free_busy_world(void) {
    jox_text_free(&base);
    jo_scene_free(scene);
}

static void save_busy_world(void) {
    JoError error = {0};
    fuzz_write("own.lua", BEHAVIOUR, strlen(BEHAVIOUR));
    scene = fuzz_load(fuzz_path("state.yaml"), SCENE, 1);
    FUZZ_CHECK(scene);
    scene->world->model.reinserts_bodies = true;
    step_world(JOX_BODIES_REINSERT_STEPS / 2);
    apply_line("wall post 3.5 0.1 3.5 0.4");
    apply_line("box 1.6 1.2 1 0 0 0 0.3 10");
    apply_line("grab 5 1.4 1.6 1");
    step_world(JOX_BODIES_REINSERT_STEPS / 2);
    apply_line("set m Queue speed 0.5");
    apply_line("set m Hold speed 0.8"); /* a state that runs a machine */
    apply_line("spawn pairs 0.5 1.7");
    apply_line("player 1 0.5 0");
    apply_line("signal all");
    const JoxMachineState *machines = scene->world->machines.state;
    FUZZ_CHECK(machines->waiting_count > 0 && machines->sent_count > 0); /* messages */
    FUZZ_CHECK(save_world(&base));
    FUZZ_CHECK(restore_world(&base, &error));
    base_hash = jo_world_hash(scene->world);
    step_world(STEPS);
    later_hash = jo_world_hash(scene->world);
    FUZZ_CHECK(restore_world(&base, &error));
    atexit(free_busy_world);
}

/* ---- one input ---- */

static void visit_world_sections(void *context, JoxSections *sections) {
    (void)context;
    jox_world_sections(scene->world, sections);
}

static void check_positions(const JoWorld *world) {
    const JoxAgents *a = &world->state.agents;
    for (uint32_t i = 0; i < a->count; i++)
        FUZZ_CHECK(isfinite(a->x[i]) && isfinite(a->y[i]) && isfinite(a->vx[i]));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    JoError error = {0};
    JoxText state = {0};
    if (!scene)
        save_busy_world();
    jox_text_append(&state, base.data, base.length);
    fuzz_edit(&state, data, size, visit_world_sections, NULL);
    const bool good = restore_world(&state, &error);
    FUZZ_CHECK(good || *error.text);
    if (getenv("FUZZ_SHOW"))
        fprintf(stderr, "%zu bytes: %s\n", state.length, good ? "a state" : error.text);
    jox_text_free(&state);
    if (good) {
        step_world(STEPS);
        check_positions(scene->world);
        jo_free(jo_scene_summary(scene));
        FUZZ_CHECK(restore_world(&base, &error));
        step_world(STEPS);
        FUZZ_CHECK(jo_world_hash(scene->world) == later_hash);
        FUZZ_CHECK(restore_world(&base, &error));
    }
    FUZZ_CHECK(jo_world_hash(scene->world) == base_hash);
    return 0;
}
