#include "world/verbs/verbs.h"

#include <assert.h>

#include "base/assert.h"
#include "world/world.h"

/* ---- what the verbs do ---- */

/* Index of the living agent with an id, or JOX_NO_INDEX with a sentence in `why`. */
static uint32_t find_agent(const JoWorld *world, uint32_t id, JoxText *why) {
    const JoxAgents *a = &world->state.agents;
    uint32_t i = jox_agents_find(a, id);
    if (i != JOX_NO_INDEX)
        return i;
    if (id < a->next_id)
        jox_text_printf(why, "agent %u has left", id);
    else
        jox_text_printf(why, "there is no agent %u; ids go up to %u", id,
                        a->next_id ? a->next_id - 1 : 0);
    return JOX_NO_INDEX;
}

static bool push(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    JoxAgents *a = &world->state.agents;
    uint32_t i = find_agent(world, entry->number, why);
    if (i == JOX_NO_INDEX)
        return false;
    a->ext_x[i] += (float)entry->numbers[0];
    a->ext_y[i] += (float)entry->numbers[1];
    return true;
}

/* A log may speak of players who are yet to come. */
static bool drive(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    if (entry->line == 0 && find_agent(world, entry->number, why) == JOX_NO_INDEX)
        return false;
    jox_input_player(&world->state.input, entry->number, (float)entry->numbers[0],
                     (float)entry->numbers[1]);
    return true;
}

static bool throw(JoWorld * world, const JoxInputEntry *entry, JoxText *why) {
    const double *v = entry->numbers;
    return jox_event_throw(world, entry->names[0], entry->here ? NULL : v, v + 3, v + 6, why);
}

static bool add_box(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    const double *v = entry->numbers;
    bool good = jox_world_add_box(world, v, v + 3, v[6], v[7], why) != JOX_NO_BODY;
    if (!good && !why->length)
        jox_text_add(why, "the box was refused");
    return good;
}

static bool pull(JoWorld *world, const JoxInputEntry *entry, bool anew, JoxText *why) {
    const unsigned row = entry->number;
    switch (jox_world_grab(world, row, entry->numbers, anew)) {
    case JOX_GRAB_DONE:
        return true;
    case JOX_GRAB_NONE:
        jox_text_printf(why, "there is no body %u", row);
        break;
    case JOX_GRAB_STATIC:
        jox_text_printf(why, "body %u is static: it cannot be moved", row);
        break;
    case JOX_GRAB_FREE:
        jox_text_printf(why, "body %u is not held; grab it first", row);
        break;
    case JOX_GRAB_FULL:
        jox_text_printf(why, "%d bodies are held already; release one first", JOX_MOST_GRABS);
        break;
    }
    return false;
}

static bool grab(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    return pull(world, entry, true, why);
}

static bool drag(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    return pull(world, entry, false, why);
}

static bool release(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    bool good = jox_world_release(world, entry->number);
    if (!good)
        jox_text_printf(why, "body %u is not held", entry->number);
    return good;
}

static bool open(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    return jox_event_open(world, entry->names[0], true, why);
}

static bool close(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    return jox_event_open(world, entry->names[0], false, why);
}

static bool call_out(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    return jox_event_signal(world, entry->names[0], why);
}

/* ---- the table ---- */

/* clang-format off */
#define METRES(axis)      {axis, JOX_WORD_NUMBER, -1e4, 1e4, "m"}
#define SPEED(axis, most) {axis, JOX_WORD_NUMBER, -(most), most, "m/s"}
#define SPIN(axis)        {axis, JOX_WORD_NUMBER, -100, 100, "rad/s"}
#define FORCE(axis)       {axis, JOX_WORD_NUMBER, -1e4, 1e4, "N"}
#define ID(what)          {what, JOX_WORD_WHOLE, 0, UINT32_MAX - 1.0, ""}
#define CALLED(what)      {what, JOX_WORD_NAME, 0, 0, ""}
#define FILES             {"N", JOX_WORD_FILES, 1, JOX_INPUT_FILE_COUNT, "files"}

const JoxVerb jox_input_verbs[] = {
    [JOX_INPUT_PLAYER] = {"player", {ID("AGENT"), SPEED("VX", 20), SPEED("VY", 20)}, 3, 3,
     "player 0 1.5 0",
     "from here on the player of the agent with this id wants that velocity", "player", drive},
    [JOX_INPUT_THROW] = {"throw",
     {CALLED("BODY"), METRES("X"), METRES("Y"), METRES("Z"), SPEED("VX", 100), SPEED("VY", 100),
      SPEED("VZ", 100), SPIN("WX"), SPIN("WY"), SPIN("WZ")}, 7, 10,
     "throw ball here 5 0 3",
     "throws a body of the scene by its name, from a point, or, with `here` in place of the point, "
     "from where it is; who carries it loses it", "throw", throw},
    [JOX_INPUT_BOX] = {"box",
     {METRES("X"), METRES("Y"), METRES("Z"), SPEED("VX", 100), SPEED("VY", 100), SPEED("VZ", 100),
      {"SIZE", JOX_WORD_NUMBER, 0.05, 5, "m"}, {"MASS", JOX_WORD_NUMBER, 0.1, 1e4, "kg"}}, 8, 8,
     "box 1 2 1.5 5 0 3 0.4 10",
     "a new cube; of more than 200 the oldest is taken out", "throw", add_box},
    [JOX_INPUT_GRAB] = {"grab", {ID("BODY"), METRES("X"), METRES("Y"), METRES("Z")}, 4, 4,
     "grab 0 1 2 0.5",
     "from here on the centre of the body in this row is pulled to a point, with up to 4,000 N "
     "besides its weight and at up to 6 m/s", "drag", grab},
    [JOX_INPUT_DRAG] = {"drag", {ID("BODY"), METRES("X"), METRES("Y"), METRES("Z")}, 4, 4,
     "drag 0 1 3 0.5", "moves the point to which it is pulled", "drag", drag},
    [JOX_INPUT_RELEASE] = {"release", {ID("BODY")}, 1, 1, "release 0", "lets the body go", "drag", release},
    [JOX_INPUT_PUSH] = {"push", {ID("AGENT"), FORCE("FX"), FORCE("FY")}, 3, 3, "push 7 300 0",
     "a force on the agent with this id, during the step", "push", push},
    [JOX_INPUT_OPEN] = {"open", {CALLED("WALL")}, 1, 1, "open gate",
     "opens the walls of a name", "gates", open},
    [JOX_INPUT_CLOSE] = {"close", {CALLED("WALL")}, 1, 1, "close gate",
     "closes them; who stands in one is moved out", "gates", close},
    [JOX_INPUT_SIGNAL] = {"signal", {CALLED("NAME")}, 1, 1, "signal run",
     "everybody hears the name, wherever they are", "signals", call_out},
    [JOX_INPUT_SET] = {"set",
     {CALLED("MACHINE"), CALLED("STATE"), CALLED("PARAMETER"),
      {"VALUE", JOX_WORD_NUMBER, -1e9, 1e9, ""}}, 4, 4,
     "set walker Walk speed 1.2",
     "a parameter of a state (or of `defaults`) of a machine, for all who are in it and who will "
     "be, until the behaviour is reloaded", "parameters", NULL},
    [JOX_INPUT_BEGAN] = {"began",
     {CALLED("SEED"), {"DT", JOX_WORD_NUMBER, 0.001, 0.2, "s"}}, 2, 2, "began 1 0.05",
     "seed and time step of the run that was logged", NULL, NULL},
    [JOX_INPUT_MADE] = {"made", {{"PATH", JOX_WORD_PATH, 0, 0, ""}, CALLED("SHA256")}, 2, 2,
     "made scenes/office.yaml f845cd",
     "a file that it was made of; a replay says which have changed", NULL, NULL},
    [JOX_INPUT_BEFORE] = {"before", {FILES}, 1, 1, "before 1",
     "files that are about to be reloaded, as they were when the run began: a replay begins with "
     "them", NULL, NULL},
    [JOX_INPUT_FILES] = {"files", {FILES}, 1, 1, "files 1",
     "files that were saved and went live, together; a replay takes them from here, not from the "
     "disk", NULL, NULL}};
/* clang-format on */
const uint32_t jox_input_verb_count = sizeof jox_input_verbs / sizeof *jox_input_verbs;
static_assert(sizeof jox_input_verbs / sizeof *jox_input_verbs <= JOX_INPUT_MOST_VERBS,
              "JOX_INPUT_MOST_VERBS");

/* What a verb takes has room in an entry. */
static void check_words(const JoxVerb *verb) {
    uint32_t numbers = 0, names = 0;
    JOX_ASSERT(verb->least <= verb->most);
    JOX_ASSERT(verb->most <= sizeof verb->words / sizeof *verb->words);
    for (uint32_t w = 0; w < verb->most; w++) {
        JOX_ASSERT(verb->words[w].name && verb->words[w].least <= verb->words[w].most);
        numbers += verb->words[w].kind == JOX_WORD_NUMBER;
        names += verb->words[w].kind == JOX_WORD_NAME || verb->words[w].kind == JOX_WORD_PATH;
    }
    JOX_ASSERT(numbers <= JOX_INPUT_NUMBERS && names <= JOX_INPUT_NAMES);
}

void jox_input_usage(const JoxVerb *verb, JoxText *out) {
    JOX_CHECK(check_words(verb));
    jox_text_add(out, verb->name);
    for (uint32_t w = 0; w < verb->most; w++)
        jox_text_printf(out, " %s%s%s", w == verb->least ? "[" : "", verb->words[w].name,
                        w >= verb->least && w + 1 == verb->most ? "]" : "");
}

/* Range and unit of each number, those that are alike once: "VX, VY: -20 to 20 m/s". */
static void print_ranges(const JoxVerb *verb, JoxText *out) {
    const char *between = "";
    for (uint32_t w = 0; w < verb->most; w++) {
        const JoxInputWord *word = &verb->words[w], *next = word + 1;
        if (word->kind != JOX_WORD_NUMBER || !*word->unit)
            continue;
        bool last = w + 1 == verb->most || next->kind != word->kind || next->most != word->most ||
                    next->unit != word->unit;
        jox_text_printf(out, "%s%s", between, word->name);
        between = last ? "; " : ", ";
        if (last)
            jox_text_printf(out, ": %g to %g %s", word->least, word->most, word->unit);
    }
}

void jox_input_reference(JoxText *out) {
    jox_text_add(
        out,
        "# Input logs\n\n"
        "What people did to a running scene, and files that were saved meanwhile, with the step in "
        "which it took\neffect. `jostle run SCENE --log-input FILE` writes one, `jostle run SCENE "
        "--input FILE` plays it back to the\nsame hash, for any number of threads. A scene may "
        "name one too: `input: FILE`.\n\n"
        "Text, one entry a line: `TICK VERB ...`. Ticks count steps from 0 and never decrease; "
        "several lines may have the\nsame. `#` starts a comment. A name with blanks stands in "
        "double quotes, where `\\\"` and `\\\\` are a quote and a\nbackslash.\n\n"
        "    40 push 7 300 0\n"
        "    52 throw \"red ball\" here 5 0 3   # from where it lies\n"
        "    60 open gate\n\n"
        "| line, behind its tick | numbers | what it does | example |\n|---|---|---|---|\n");
    for (uint32_t v = 0; v < jox_input_verb_count; v++) {
        jox_text_add(out, "| `");
        jox_input_usage(&jox_input_verbs[v], out);
        jox_text_add(out, "` | ");
        print_ranges(&jox_input_verbs[v], out);
        jox_text_printf(out, " | %s | `%s` |\n", jox_input_verbs[v].meaning,
                        jox_input_verbs[v].example);
    }
    jox_text_add(out,
                 "\n`began` and `made` open a log: a replay with another seed, step or file says "
                 "so. Behind `before N` and `files N`\nfollow N files: a line `PATH BYTES`, so "
                 "many bytes, and the end of a line. What lies on the disk under those\npaths is "
                 "not read in a replay.\n\n"
                 "    118 files 1\n"
                 "    behaviours/numbers.lua 12\n"
                 "    return 1.25\n"
                 "\n"
                 "    140 signal run\n");
}
