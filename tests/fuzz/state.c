/* Bytes as edits of a saved state, 16 bytes each, with a checksum that is right: a number becomes
   another, a cell that of its neighbour, a list longer or shorter. What the restore takes for a
   state runs for a few steps; then the state as it was is restored, and goes on to the bit.
   FUZZ_SHOW=1 prints what each edit changes. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/guard.h"
#include "base/hash.h"
#include "run/run.h"
#include "support/fuzz.h"

/* A crowd and a few bodies that leave no section empty, and the state small. */
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
    "local mine, ball = memory { turns = 0, calm = true }, nearest \"ball\"\n"
    "return machine { name = \"m\", version = 1, start = \"Walk\",\n"
    "  defaults = { speed = normal(1.3, 0.2), push = uniform(0, 60), perception = 3 },\n"
    "  own = { aim = \"goal\" },\n"
    "  states = {\n"
    "    Walk = { steer = field \"goal\", lasts = normal(1, 0.3), push = 100, take = ball,\n"
    "      on_enter = function(me) me.turns = me.turns + 1 end,\n"
    "      { to = \"Queue\", when = lasted, chance = 0.7 }, { to = \"Throw\", when = has(ball) } "
    "},\n"
    "    Queue = { steer = queue \"desk\", signal = { \"all\", every = 0.3 },\n"
    "      { to = \"Roam\", when = first_in \"desk\" & after(0.5) },\n"
    "      { to = \"Roam\", when = stuck(0.4) } },\n"
    "    Throw = { steer = hold, throw = { ball, at = \"goal\", speed = 6 },\n"
    "      { to = \"Walk\", when = ~has(ball) | after(1) } },\n"
    "    Roam = { steer = seek(own.aim) + 0.3 * evade, lasts = uniform(0.5, 1),\n"
    "      { to = \"Walk\", when = heard \"all\" | lasted, set = { calm = false } } } } }\n";

enum { EDIT = 16, MOST_EDITS = 8, STEPS = 4, HEAD = 24 };

static JoScene *scene;
static JoxText base;
static uint64_t base_hash, later_hash;

/* What stands before the cells of a section. */
typedef struct Head {
    uint64_t name, size, count;
} Head;

/* ---- a world with something of each kind under way ---- */

static bool restore(const JoxText *state, JoError *error) {
    JOX_GUARD (scene->heap, error)
        return false;
    return jox_world_restore(scene->world, state->data, state->length, error);
}

/* Steps, until one fails. */
static void go_on(int steps) {
    JOX_GUARD (scene->heap, NULL)
        return;
    while (steps-- > 0 && jox_world_step(scene->world))
        jox_text_free(&scene->world->scratch.news);
    jox_text_free(&scene->world->scratch.news);
}

static bool save(JoxText *out) {
    JoError error = {0};
    JOX_GUARD (scene->heap, &error)
        return false;
    return jox_world_snapshot(scene->world, out, &error);
}

static void do_it(const char *line) {
    JoError error = {0};
    if (!jo_scene_input(scene, line, &error)) {
        fprintf(stderr, "%s: %s\n", line, error.text);
        abort();
    }
}

static void end(void) {
    jox_text_free(&base);
    jo_scene_free(scene);
}

static void begin(void) {
    JoError error = {0};
    fuzz_write("own.lua", BEHAVIOUR, strlen(BEHAVIOUR));
    scene = fuzz_load(fuzz_path("state.yaml"), SCENE, 1);
    FUZZ_CHECK(scene);
    scene->world->model.reinserts_bodies = true;
    go_on(JOX_BODIES_REINSERT_STEPS / 2);
    do_it("wall post 3.5 0.1 3.5 0.4");
    do_it("box 1.6 1.2 1 0 0 0 0.3 10");
    do_it("grab 5 1.4 1.6 1");
    go_on(JOX_BODIES_REINSERT_STEPS / 2);
    do_it("set m Queue speed 0.5");
    do_it("spawn pairs 0.5 1.7");
    do_it("player 1 0.5 0");
    do_it("signal all");
    FUZZ_CHECK(save(&base));
    FUZZ_CHECK(restore(&base, &error));
    base_hash = jo_world_hash(scene->world);
    go_on(STEPS);
    later_hash = jo_world_hash(scene->world);
    FUZZ_CHECK(restore(&base, &error));
    atexit(end);
}

/* ---- edits ---- */

static Head head_at(const JoxText *state, size_t at) {
    Head head;
    memcpy(&head, state->data + at, sizeof head);
    return head;
}

/* Calls a function for each section, with where it and the one before it begin. */
typedef struct Search {
    uint16_t key;
    uint64_t name; /* of all, that whose low bits follow the key most closely, counted round */
    size_t count, wanted;
    size_t at, before;
} Search;
typedef void Visit(Search *search, Head head, size_t at, size_t before);

static void each_section(const JoxText *state, Visit *visit, Search *search) {
    enum { MAGIC = 8 };
    for (size_t at = MAGIC, before = MAGIC; at < state->length - sizeof(uint64_t);) {
        const Head head = head_at(state, at);
        visit(search, head, at, before);
        before = at;
        at += HEAD + head.size * head.count;
    }
}

static void take_name(Search *search, Head head, size_t at, size_t before) {
    const uint64_t was = search->name, is = head.name;
    (void)at, (void)before;
    if (!was || (uint16_t)(is - search->key) < (uint16_t)(was - search->key))
        search->name = is;
}

static void count_name(Search *search, Head head, size_t at, size_t before) {
    (void)at, (void)before;
    search->count += head.name == search->name;
}

static void take_place(Search *search, Head head, size_t at, size_t before) {
    if (head.name != search->name || search->count++ != search->wanted)
        return;
    search->at = at;
    search->before = before;
}

/* Where the section of an edit begins: by a key of its name, so that it is the same one after
   others came to be listed, and by its number among those of that name. Where the one before it
   begins, in *before. */
static size_t find(const JoxText *state, const uint8_t *edit, size_t *before) {
    Search search = {0};
    memcpy(&search.key, edit, sizeof search.key);
    each_section(state, take_name, &search);
    each_section(state, count_name, &search);
    search.wanted = edit[15] % search.count;
    search.count = 0;
    each_section(state, take_place, &search);
    *before = search.before;
    return search.at;
}

static uint64_t whole_number(uint8_t choice, uint64_t was) {
    const uint64_t odd[] = {0,        1,       2,         UINT64_MAX, INT32_MAX,
                            1u << 31, was + 1, was - 1,   was << 1,   UINT64_C(1) << 63,
                            0xffff,   0x8000,  1u << 24u, UINT32_MAX, 64,
                            1000};
    return odd[choice % 16];
}

static double odd_number(uint8_t choice, double was) {
    const double odd[] = {0.0,   -0.0, NAN,  INFINITY, -INFINITY, 1e300, -1e300, 1e30,
                          -1e30, 1e9,  -1e9, 1e-30,    5e-324,    1e4,   -was,   2.0 * was};
    return odd[choice % 16];
}

/* A number within a cell of `size` bytes, where it fits. */
static void put(char *cell, size_t size, const uint8_t *edit) {
    uint16_t offset;
    uint64_t value = 0;
    memcpy(&offset, edit + 6, sizeof offset);
    const size_t wide = edit[2] % 4 == 2 ? 4 : edit[2] % 4 == 3 ? 8 : (size_t)1 << edit[3] / 64;
    if (size < wide)
        return;
    char *to = cell + offset % (size / wide) * wide;
    memcpy(&value, edit[2] % 4 ? (const void *)to : edit + 8, wide);
    if (edit[2] % 4 == 1)
        value = whole_number(edit[3], value);
    if (edit[2] % 4 == 2) {
        float was;
        memcpy(&was, to, sizeof was);
        was = (float)odd_number(edit[3], was);
        memcpy(&value, &was, sizeof was);
    }
    if (edit[2] % 4 == 3) {
        double was;
        memcpy(&was, to, sizeof was);
        was = odd_number(edit[3], was);
        memcpy(&value, &was, sizeof was);
    }
    memcpy(to, &value, wide);
}

/* Cells are taken from a section, or its last one stands there once more: in the number of cells
   that stands before it, too. */
static void resize(JoxText *state, size_t at, size_t before, size_t more) {
    Head head = head_at(state, at), counts = head_at(state, before);
    const size_t end_at = at + HEAD + head.size * head.count;
    JoxText now = {0};
    jox_text_append(&now, state->data, end_at);
    const bool counted = counts.name == head.name && counts.size == sizeof(uint64_t) &&
                         counts.count == 1 && before != at;
    if (more % 8 == 0 && head.count) {
        head.count--;
        now.length -= head.size;
    } else if (head.size <= 4096) {
        static const char NOTHING[4096];
        for (size_t k = 0; k < more % 8; k++)
            jox_text_append(&now, head.count ? state->data + end_at - head.size : NOTHING,
                            head.size);
        head.count += more % 8;
    }
    jox_text_append(&now, state->data + end_at, state->length - end_at);
    memcpy(now.data + at, &head, sizeof head);
    if (counted)
        memcpy(now.data + before + HEAD, &head.count, sizeof head.count);
    jox_text_free(state);
    *state = now;
}

static void show(void *context, const char *section, size_t index, void *cell, size_t size,
                 bool hashed) {
    uint64_t *name = context;
    const char *dot = strchr(section, '.');
    JoxHash hash = jox_hash_begin();
    (void)cell, (void)hashed;
    jox_hash_add(&hash, section, (size_t)(dot - section));
    jox_hash_add(&hash, ".", 1);
    jox_hash_add(&hash, dot + 1, strlen(dot + 1));
    if (index == 0 && jox_hash_end(&hash) == *name) {
        fprintf(stderr, "%s, cells of %zu bytes\n", section, size);
        *name = 0; /* once, where several sections have the name */
    }
}

static void change(JoxText *state, const uint8_t *edit) {
    uint16_t number;
    size_t before = 0;
    memcpy(&number, edit + 4, sizeof number);
    const size_t at = find(state, edit, &before);
    const Head head = head_at(state, at);
    if (getenv("FUZZ_SHOW")) {
        uint64_t name = head.name;
        JoxSections s = jox_sections_visit(show, &name);
        jox_world_sections(scene->world, &s);
        fprintf(stderr, "  key %u, of %" PRIu64 " cells of %" PRIu64 " bytes: edit %d of cell %u\n",
                (unsigned)(head.name & 0xffff), head.count, head.size, edit[2] % 8, number);
    }
    if (edit[2] % 8 == 7) {
        resize(state, at, before, number);
        return;
    }
    if (head.count == 0)
        return;
    char *cells = state->data + at + HEAD, *cell = cells + number % head.count * head.size;
    if (edit[2] % 8 == 6)
        memcpy(cell, cells + edit[8] % head.count * head.size, head.size);
    else
        put(cell, head.size, edit);
}

static void seal(JoxText *state) {
    const size_t length = state->length - sizeof(uint64_t);
    JoxHash hash = jox_hash_begin();
    jox_hash_add(&hash, state->data, length);
    const uint64_t sum = jox_hash_end(&hash);
    memcpy(state->data + length, &sum, sizeof sum);
}

/* ---- a run of it ---- */

static void check_people(const JoWorld *world) {
    const JoxAgents *a = &world->state.agents;
    for (uint32_t i = 0; i < a->count; i++)
        FUZZ_CHECK(isfinite(a->x[i]) && isfinite(a->y[i]) && isfinite(a->vx[i]));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    JoError error = {0};
    JoxText state = {0};
    if (!scene)
        begin();
    jox_text_append(&state, base.data, base.length);
    for (size_t k = 0; k < MOST_EDITS && (k + 1) * EDIT <= size; k++)
        change(&state, data + k * EDIT);
    seal(&state);
    const bool good = restore(&state, &error);
    FUZZ_CHECK(good || *error.text);
    if (getenv("FUZZ_SHOW"))
        fprintf(stderr, "%zu bytes: %s\n", state.length, good ? "a state" : error.text);
    jox_text_free(&state);
    if (good) {
        go_on(STEPS);
        check_people(scene->world);
        jo_free(jo_scene_summary(scene));
        FUZZ_CHECK(restore(&base, &error));
        go_on(STEPS);
        FUZZ_CHECK(jo_world_hash(scene->world) == later_hash);
        FUZZ_CHECK(restore(&base, &error));
    }
    FUZZ_CHECK(jo_world_hash(scene->world) == base_hash);
    return 0;
}
