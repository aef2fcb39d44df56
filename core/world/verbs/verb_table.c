#include "world/verbs/verb_table.h"

#include <assert.h>

#include "base/assert.h"
#include "world/verbs/verb_functions.h"

/* ---- the table ---- */

/* clang-format off */
#define METRES(axis)      {axis, JOX_WORD_NUMBER, -1e4, 1e4, "m"}
#define SPEED(axis, most) {axis, JOX_WORD_NUMBER, -(most), most, "m/s"}
#define SPIN(axis)        {axis, JOX_WORD_NUMBER, -100, 100, "rad/s"}
#define FORCE(axis)       {axis, JOX_WORD_NUMBER, -1e4, 1e4, "N"}
#define IMPULSE(axis)     {axis, JOX_WORD_NUMBER, -1e6, 1e6, "N s"}
#define TURN(axis)        {axis, JOX_WORD_NUMBER, -1, 1, ""}
#define ID(what)          {what, JOX_WORD_WHOLE, 0, UINT32_MAX - 1.0, ""}
#define CALLED(what)      {what, JOX_WORD_NAME, 0, 0, ""}
#define FILES             {"N", JOX_WORD_FILES, 1, JOX_INPUT_FILE_COUNT, "files"}

const JoxVerb jox_input_verbs[] = {
    [JOX_INPUT_PLAYER] = {"player", {ID("AGENT"), SPEED("VX", 20), SPEED("VY", 20),
     {"BUTTON", JOX_WORD_NUMBER, 0, 1, ""}}, 3, 4,
     "player 0 1.5 0",
     "sets the velocity that the player of the agent with this id wants from now on, and whether the "
     "player holds the button: 1 or 0", "player", jox_perform_player},
    [JOX_INPUT_THROW] = {"throw",
     {CALLED("BODY"), METRES("X"), METRES("Y"), METRES("Z"), SPEED("VX", 100), SPEED("VY", 100),
      SPEED("VZ", 100), SPIN("WX"), SPIN("WY"), SPIN("WZ")}, 7, 10,
     "throw ball here 5 0 3",
     "throws a body of the scene, given by name, from a point, or, with `here` in place of the "
     "point, from where it is; an agent that carries it loses it", "throw", jox_perform_throw},
    [JOX_INPUT_BOX] = {"box",
     {METRES("X"), METRES("Y"), METRES("Z"), SPEED("VX", 100), SPEED("VY", 100), SPEED("VZ", 100),
      {"SIZE", JOX_WORD_NUMBER, 0.05, 5, "m"}, {"MASS", JOX_WORD_NUMBER, 0.1, 1e4, "kg"}}, 8, 8,
     "box 1 2 1.5 5 0 3 0.4 10",
     "adds a cube; if there are more than 200, the oldest is removed", "throw", jox_perform_box},
    [JOX_INPUT_GRAB] = {"grab", {ID("BODY"), METRES("X"), METRES("Y"), METRES("Z")}, 4, 4,
     "grab 0 1 2 0.5",
     "pulls the centre of the body in this slot to a point from now on, with up to 4,000 N besides "
     "its weight and at up to 6 m/s", "drag", jox_perform_grab},
    [JOX_INPUT_DRAG] = {"drag", {ID("BODY"), METRES("X"), METRES("Y"), METRES("Z")}, 4, 4,
     "drag 0 1 3 0.5", "moves the point to which the body is pulled", "drag", jox_perform_drag},
    [JOX_INPUT_RELEASE] = {"release", {ID("BODY")}, 1, 1, "release 0", "stops pulling the body", "drag",
     jox_perform_release},
    [JOX_INPUT_PUSH] = {"push", {ID("AGENT"), FORCE("FX"), FORCE("FY")}, 3, 3, "push 7 300 0",
     "applies a force to the agent with this id, during the step", "push",
     jox_perform_push},
    [JOX_INPUT_OPEN] = {"open", {CALLED("WALL")}, 1, 1, "open gate",
     "opens the walls of this name", "gates", jox_perform_open},
    [JOX_INPUT_CLOSE] = {"close", {CALLED("WALL")}, 1, 1, "close gate",
     "closes the walls of this name; people who stand in one are moved out", "gates", jox_perform_close},
    [JOX_INPUT_SIGNAL] = {"signal", {CALLED("NAME")}, 1, 1, "signal run",
     "gives a signal, which every agent hears, wherever it is", "signals", jox_perform_signal},
    [JOX_INPUT_SET] = {"set",
     {CALLED("MACHINE"), CALLED("STATE"), CALLED("PARAMETER"),
      {"VALUE", JOX_WORD_NUMBER, -1e9, 1e9, ""}}, 4, 4,
     "set walker Walk speed 1.2",
     "sets a parameter of a state (or of `defaults`) of a machine, for all agents that are or come "
     "in this state, until the behaviour is reloaded; of a state that runs a machine for the states "
     "within it, too, that do not set it themselves", "parameters", NULL},
    [JOX_INPUT_BEGAN] = {"began",
     {CALLED("SEED"), {"DT", JOX_WORD_NUMBER, 0.001, 0.2, "s"}}, 2, 2, "began 1 0.05",
     "seed and time step of the run that was logged", NULL, NULL},
    [JOX_INPUT_MADE] = {"made", {{"PATH", JOX_WORD_PATH, 0, 0, ""}, CALLED("SHA256")}, 2, 2,
     "made scenes/office.yaml f845cd",
     "a file from which the run was loaded; a replay names files that have changed", NULL, NULL},
    [JOX_INPUT_BEFORE] = {"before", {FILES}, 1, 1, "before 1",
     "texts of files that are reloaded later, as they were when the run began: a replay begins with "
     "them", NULL, NULL},
    [JOX_INPUT_FILES] = {"files", {FILES}, 1, 1, "files 1",
     "texts of files that were saved and replaced the old ones together; a replay reads them from "
     "here, not from the disk", NULL, NULL},
    [JOX_INPUT_SPAWN] = {"spawn", {CALLED("GROUP"), METRES("X"), METRES("Y")}, 3, 3,
     "spawn visitors 3 4.5",
     "adds an agent of a group; it begins on the nearest free spot if it would overlap a wall or an "
     "agent", JOX_VERB_PROGRAM, jox_perform_spawn},
    [JOX_INPUT_REMOVE] = {"remove", {ID("AGENT")}, 1, 1, "remove 7", "removes the agent with this id",
     JOX_VERB_PROGRAM, jox_perform_remove},
    [JOX_INPUT_TELEPORT] = {"teleport", {ID("AGENT"), METRES("X"), METRES("Y")}, 3, 3,
     "teleport 7 3 4.5", "moves the agent to a point, or to the nearest free spot, at rest",
     JOX_VERB_PROGRAM, jox_perform_teleport},
    [JOX_INPUT_GOAL] = {"goal", {ID("AGENT"), CALLED("PLACE")}, 2, 2, "goal 7 exit",
     "makes this place the agent's goal", JOX_VERB_PROGRAM, jox_perform_goal},
    [JOX_INPUT_STATE] = {"state", {ID("AGENT"), CALLED("STATE")}, 2, 2, "state 7 Flee",
     "the agent enters a state of its behaviour", JOX_VERB_PROGRAM, jox_perform_state},
    [JOX_INPUT_MEMORY] = {"memory",
     {ID("AGENT"), CALLED("NAME"), {"VALUE", JOX_WORD_NUMBER, -1e15, 1e15, ""}}, 3, 3,
     "memory 7 hits 2", "sets a value of the agent's memory; false is 0, true is 1", JOX_VERB_PROGRAM,
     jox_perform_memory},
    [JOX_INPUT_PARAMETER] = {"parameter",
     {ID("AGENT"), CALLED("NAME"), {"VALUE", JOX_WORD_NUMBER, -1e9, 1e9, ""}}, 3, 3,
     "parameter 7 speed 1.6", "sets the agent's own value of a parameter, which holds in all states that do not set it",
     JOX_VERB_PROGRAM, jox_perform_parameter},
    [JOX_INPUT_IMPULSE] = {"impulse",
     {ID("BODY"), IMPULSE("IX"), IMPULSE("IY"), IMPULSE("IZ"), METRES("X"), METRES("Y"),
      METRES("Z")}, 4, 7,
     "impulse 0 20 0 0", "applies an impulse to the body in this slot, at a point or at its centre",
     JOX_VERB_PROGRAM, jox_perform_impulse},
    [JOX_INPUT_PLACE] = {"place",
     {ID("BODY"), METRES("X"), METRES("Y"), METRES("Z"), TURN("QX"), TURN("QY"), TURN("QZ"),
      TURN("QW")}, 4, 8,
     "place 0 1 2 0.5",
     "moves the body in this slot to a point, at rest, and turns it by a quaternion if one is given", JOX_VERB_PROGRAM,
     jox_perform_place},
    [JOX_INPUT_VELOCITY] = {"velocity",
     {ID("BODY"), SPEED("VX", 100), SPEED("VY", 100), SPEED("VZ", 100), SPIN("WX"), SPIN("WY"),
      SPIN("WZ")}, 4, 7,
     "velocity 0 1 0 0", "sets velocity and spin of the body in this slot", JOX_VERB_PROGRAM,
     jox_perform_velocity},
    [JOX_INPUT_DELETE] = {"delete", {ID("BODY")}, 1, 1, "delete 0", "removes the body in this slot",
     JOX_VERB_PROGRAM, jox_perform_delete},
    [JOX_INPUT_WALL] = {"wall",
     {CALLED("NAME"), METRES("X0"), METRES("Y0"), METRES("X1"), METRES("Y1"), METRES("X2"),
      METRES("Y2"), METRES("X3"), METRES("Y3")}, 5, 9,
     "wall barrier 0 0 4 0",
     "adds a wall, thin between two points, or a solid with four corners; people who stand there "
     "are moved out", JOX_VERB_PROGRAM, jox_perform_wall},
    [JOX_INPUT_UNWALL] = {"unwall", {CALLED("NAME")}, 1, 1, "unwall barrier",
     "removes the walls of this name that `wall` added", JOX_VERB_PROGRAM, jox_perform_unwall},
    [JOX_INPUT_SETTING] = {"setting", {CALLED("MOD"), CALLED("SETTING"), CALLED("VALUE")}, 3, 3,
     "setting gentle-queue chance 0.05",
     "changes a setting of a mod: the behaviours that it patches are loaded again, and go on from their states",
     "parameters", NULL},
    [JOX_INPUT_LIFT] = {"lift", {CALLED("LIFT"), CALLED("MODE")}, 2, 2, "lift east out_of_use",
     "sets the mode of a lift, or of `all` lifts: `in_use`, `out_of_use` or `firemen`",
     JOX_VERB_PROGRAM, jox_perform_lift}};
/* clang-format on */
const uint32_t jox_input_verb_count = sizeof jox_input_verbs / sizeof *jox_input_verbs;
static_assert(sizeof jox_input_verbs / sizeof *jox_input_verbs <= JOX_INPUT_MOST_VERBS,
              "JOX_INPUT_MOST_VERBS");

/* Checks that an entry has room for the words of a verb. */
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

void jox_input_append_usage(const JoxVerb *verb, JoxText *out) {
    JOX_CHECK(check_words(verb));
    jox_text_add(out, verb->name);
    for (uint32_t w = 0; w < verb->most; w++)
        jox_text_printf(out, " %s%s%s", w == verb->least ? "[" : "", verb->words[w].name,
                        w >= verb->least && w + 1 == verb->most ? "]" : "");
}

/* Appends range and unit of each number, equal ones once: "VX, VY: -20 to 20 m/s". */
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

void jox_input_append_reference(JoxText *out) {
    jox_text_add(
        out,
        "# Input logs\n\n"
        "An input log lists what people did to a running scene, and files that were saved "
        "meanwhile, "
        "with the step in which each\ntook effect. `jostle run SCENE --log-input FILE` writes one, "
        "`jostle run SCENE "
        "--input FILE` plays it back to the\nsame hash, for any number of threads. A scene may "
        "name one too: `input: FILE`.\n\n"
        "Text, one entry a line: `TICK VERB ...`. Ticks count steps from 0 and never decrease; "
        "several lines may have the\nsame. `#` starts a comment. A name with blanks is written in "
        "double quotes, where `\\\"` and `\\\\` are a quote and a\nbackslash.\n\n"
        "    40 push 7 300 0\n"
        "    52 throw \"red ball\" here 5 0 3   # from where it lies\n"
        "    60 open gate\n\n"
        "| line, after its tick | numbers | what it does | example |\n|---|---|---|---|\n");
    for (uint32_t v = 0; v < jox_input_verb_count; v++) {
        jox_text_add(out, "| `");
        jox_input_append_usage(&jox_input_verbs[v], out);
        jox_text_add(out, "` | ");
        print_ranges(&jox_input_verbs[v], out);
        jox_text_printf(out, " | %s | `%s` |\n", jox_input_verbs[v].meaning,
                        jox_input_verbs[v].example);
    }
    jox_text_add(out,
                 "\nA log begins with `began` and `made`: a replay with another seed, step or file "
                 "says so. After `before N` and `files N`\nfollow N files: a line `PATH BYTES`, "
                 "then so many bytes, then the end of a line. A replay does not read\nthese files "
                 "from the disk.\n\n"
                 "    118 files 1\n"
                 "    behaviours/numbers.lua 12\n"
                 "    return 1.25\n"
                 "\n"
                 "    140 signal run\n");
}
