#include "world/input/verbs.h"

/* clang-format off */
#define METRES(axis)      {axis, JOX_WORD_NUMBER, -1e4, 1e4, "m"}
#define SPEED(axis, most) {axis, JOX_WORD_NUMBER, -(most), most, "m/s"}
#define SPIN(axis)        {axis, JOX_WORD_NUMBER, -100, 100, "rad/s"}
#define FORCE(axis)       {axis, JOX_WORD_NUMBER, -1e4, 1e4, "N"}
#define ID(what)          {what, JOX_WORD_WHOLE, 0, UINT32_MAX - 1.0, ""}
#define CALLED(what)      {what, JOX_WORD_NAME, 0, 0, ""}
#define FILES             {"N", JOX_WORD_FILES, 1, JOX_INPUT_FILE_COUNT, "files"}

const JoxVerb jox_input_verbs[JOX_INPUT_VERBS] = {
    [JOX_INPUT_PLAYER] = {"player", {ID("AGENT"), SPEED("VX", 20), SPEED("VY", 20)}, 3, 3,
     "player 0 1.5 0",
     "from here on the player of the agent with this id wants that velocity", "player"},
    [JOX_INPUT_THROW] = {"throw",
     {CALLED("BODY"), METRES("X"), METRES("Y"), METRES("Z"), SPEED("VX", 100), SPEED("VY", 100),
      SPEED("VZ", 100), SPIN("WX"), SPIN("WY"), SPIN("WZ")}, 7, 10,
     "throw ball here 5 0 3",
     "throws a body of the scene by its name, from a point, or, with `here` in place of the point, "
     "from where it is; who carries it loses it", "throw"},
    [JOX_INPUT_BOX] = {"box",
     {METRES("X"), METRES("Y"), METRES("Z"), SPEED("VX", 100), SPEED("VY", 100), SPEED("VZ", 100),
      {"SIZE", JOX_WORD_NUMBER, 0.05, 5, "m"}, {"MASS", JOX_WORD_NUMBER, 0.1, 1e4, "kg"}}, 8, 8,
     "box 1 2 1.5 5 0 3 0.4 10",
     "a new cube; of more than 200 the oldest is taken out", "throw"},
    [JOX_INPUT_GRAB] = {"grab", {ID("BODY"), METRES("X"), METRES("Y"), METRES("Z")}, 4, 4,
     "grab 0 1 2 0.5",
     "from here on the centre of the body in this row is pulled to a point, with up to 4,000 N "
     "besides its weight and at up to 6 m/s", "drag"},
    [JOX_INPUT_DRAG] = {"drag", {ID("BODY"), METRES("X"), METRES("Y"), METRES("Z")}, 4, 4,
     "drag 0 1 3 0.5", "moves the point to which it is pulled", "drag"},
    [JOX_INPUT_RELEASE] = {"release", {ID("BODY")}, 1, 1, "release 0", "lets the body go", "drag"},
    [JOX_INPUT_PUSH] = {"push", {ID("AGENT"), FORCE("FX"), FORCE("FY")}, 3, 3, "push 7 300 0",
     "a force on the agent with this id, during the step", "push"},
    [JOX_INPUT_OPEN] = {"open", {CALLED("WALL")}, 1, 1, "open gate",
     "opens the walls of a name", "gates"},
    [JOX_INPUT_CLOSE] = {"close", {CALLED("WALL")}, 1, 1, "close gate",
     "closes them; who stands in one is moved out", "gates"},
    [JOX_INPUT_SIGNAL] = {"signal", {CALLED("NAME")}, 1, 1, "signal run",
     "everybody hears the name, wherever they are", "signals"},
    [JOX_INPUT_SET] = {"set",
     {CALLED("MACHINE"), CALLED("STATE"), CALLED("PARAMETER"),
      {"VALUE", JOX_WORD_NUMBER, -1e9, 1e9, ""}}, 4, 4,
     "set walker Walk speed 1.2",
     "a parameter of a state (or of `defaults`) of a machine, for all who are in it and who will "
     "be, until the behaviour is reloaded", "parameters"},
    [JOX_INPUT_BEGAN] = {"began",
     {CALLED("SEED"), {"DT", JOX_WORD_NUMBER, 0.001, 0.2, "s"}}, 2, 2, "began 1 0.05",
     "seed and time step of the run that was logged", NULL},
    [JOX_INPUT_MADE] = {"made", {{"PATH", JOX_WORD_PATH, 0, 0, ""}, CALLED("SHA256")}, 2, 2,
     "made scenes/office.yaml f845cd",
     "a file that it was made of; a replay says which have changed", NULL},
    [JOX_INPUT_BEFORE] = {"before", {FILES}, 1, 1, "before 1",
     "files that are about to be reloaded, as they were when the run began: a replay begins with "
     "them", NULL},
    [JOX_INPUT_FILES] = {"files", {FILES}, 1, 1, "files 1",
     "files that were saved and went live, together; a replay takes them from here, not from the "
     "disk", NULL}};
/* clang-format on */

void jox_input_usage(const JoxVerb *verb, JoxText *out) {
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
    for (int v = 0; v < JOX_INPUT_VERBS; v++) {
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
