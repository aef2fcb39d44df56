/* Writes the graph of a behaviour in the language of Graphviz (`jostle graph`, jo_graph): a box for
   each state, with what it does, and an arrow for each transition, with its condition as the file
   has it. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/format/path.h"
#include "base/format/quote.h"
#include "base/guard.h"
#include "base/mem.h"
#include "jostle_tools.h"
#include "machine/why.h"
#include "picture/graphviz.h"
#include "picture/palette.h"
#include "run/messages.h"
#include "run/run.h"

enum { STATE_WIDTH = 36, ARROW_WIDTH = 30, NOTE_WIDTH = 60, MOST_LINES = 5, LONGEST_NAME = 120 };

typedef struct Graph {
    const JoxLua *lua;
    const JoxScope *scope;
    const JoxMachine *machine;
    const JoxInk *inks; /* colours of its states */
    JoxText out;
    const char *margin; /* before each line of a text but that which begins with "if" */
    JoxText seen;       /* text written so far, searched for the variables that it names */
} Graph;

/* ---- texts ---- */

/* Returns the length of the first line of a text that is longer than `width`: up to an operator
   between conditions, if one is about there, else up to a blank; a long word stays whole. */
static size_t find_break(const char *text, size_t width) {
    const size_t length = strlen(text), most = width * 4 / 3;
    for (size_t at = length < most ? length : most; at > width / 2; at--)
        if (text[at] == ' ' && (text[at + 1] == '&' || text[at + 1] == '|'))
            return at;
    for (size_t at = width; at > width / 2; at--)
        if (text[at] == ' ')
            return at;
    return width + strcspn(text + width, " ");
}

/* Adds a text to a label, in left-aligned lines of about `width` characters; cut after
   MOST_LINES. */
static void add_lines(Graph *g, const char *text, size_t width) {
    for (int n = 0; *text && n < MOST_LINES; n++) {
        const size_t length = strlen(text),
                     line = length > width ? find_break(text, width) : length;
        JoxText shown = {0};
        jox_text_append(&shown, text, line);
        text += line;
        text += *text == ' ';
        if (*text && n == MOST_LINES - 1)
            jox_text_add(&shown, " ...");
        if (strncmp(shown.data, "if ", 3) != 0)
            jox_text_add(&g->out, g->margin);
        jox_quote_xml(&g->out, shown.data);
        jox_text_add(&g->out, "<br align=\"left\"/>");
        jox_text_free(&shown);
    }
}

/* Appends "PREFIX TEXT", the text without the braces and blanks around it. */
static void add_within_braces(const char *prefix, const char *text, JoxText *line) {
    size_t length = strlen(text);
    const char *inner = text + 1 + strspn(text + 1, " ");
    if (length > 1 && text[length - 1] == '}')
        length--;
    while (length > 1 && text[length - 1] == ' ')
        length--;
    jox_text_printf(line, "%s%.*s", prefix,
                    inner < text + length ? (int)(text + length - inner) : 0, inner);
}

/* Adds "PREFIX TEXT", the text being what the files have at a path, without braces around it; a
   function becomes "function, FILE:LINE". Returns whether it was found: what code builds is not. */
static bool add_written(Graph *g, const char *prefix, const char *path, size_t width) {
    JoxWritten written;
    JoxText line = {0};
    if (!jox_lua_written_or_built(g->lua, g->machine, path, g->scope, &written))
        return false;
    const char *text = written.text.data ? written.text.data : "";
    if (strncmp(text, "function", 8) == 0)
        jox_text_printf(&line, "%sfunction, %s:%d", prefix, jox_path_name(written.file),
                        written.line);
    else if (*text == '{')
        add_within_braces(prefix, text, &line);
    else
        jox_text_printf(&line, "%s%s", prefix, text);
    jox_text_printf(&g->seen, "%s\n", line.data);
    add_lines(g, line.data, width);
    jox_text_free(&line);
    jox_text_free(&written.text);
    return true;
}

/* Adds the key of a transition of a state's own list, if a file writes it out. */
static bool add_transition_key(Graph *g, const JoxState *from, const JoxTransition *t,
                               const char *prefix, const char *key) {
    const size_t width = t->stays ? STATE_WIDTH : ARROW_WIDTH;
    char state[256], path[2 * sizeof state];
    jox_state_path(from, state);
    snprintf(path, sizeof path, "%s.@%.*s.%s", state, LONGEST_NAME, t->id, key);
    if (add_written(g, prefix, path, width))
        return true;
    snprintf(path, sizeof path, "%s.%u.%s", state, t->item + 1u, key);
    return add_written(g, prefix, path, width);
}

/* Returns whether a state lists an item itself, and not an outer state around it. */
static bool is_own_item(const JoxState *state, const JoxTransition *t) {
    return t->level == state->depth;
}

/* Adds condition, chance and actions of item `k` of a state: of a transition with its number among
   several, of a reaction with "if". */
static void add_item_lines(Graph *g, const JoxState *from, uint32_t k) {
    const JoxTransition *t = &from->transitions[k];
    char prefix[16] = "if ", text[96];
    uint32_t number = 0, count = 0;
    for (uint32_t o = 0; o < from->transition_count; o++) {
        const bool counts = is_own_item(from, &from->transitions[o]) && !from->transitions[o].stays;
        number += o <= k && counts;
        count += counts;
    }
    if (!t->stays)
        *prefix = 0;
    if (!t->stays && count > 1)
        snprintf(prefix, sizeof prefix, "%u. ", number);
    g->margin = t->stays ? "&#160;&#160;&#160;" : "";
    const bool over = !t->stays && (t->when >= 0 || t->when_hook >= 0) && t->level == from->depth &&
                      jox_state_is_step(g->machine, from);
    const bool written = !over && add_transition_key(g, from, t, prefix, "when");
    const bool every = !over && add_transition_key(g, from, t,
                                                   written    ? "every "
                                                   : t->stays ? "if every "
                                                              : "every ",
                                                   "every");
    if (!written && !every) {
        const bool always = t->when < 0 && t->when_hook < 0;
        snprintf(text, sizeof text, "%s%s", prefix,
                 over       ? "when it is over"
                 : !always  ? "a condition built here"
                 : t->stays ? "it is in this state"
                            : "at once");
        if (!always && !over)
            snprintf(text + strlen(text), sizeof text - strlen(text), ", line %d", t->line);
        add_lines(g, text, ARROW_WIDTH);
    }
    if (t->chance.kind != JOX_VALUE_UNSET && !add_transition_key(g, from, t, "chance ", "chance") &&
        t->chance.kind == JOX_VALUE_CONST) {
        snprintf(text, sizeof text, "chance %g", t->chance.number);
        add_lines(g, text, ARROW_WIDTH);
    }
    static const char *const ACTIONS[][2] = {
        {"set: ", "set"}, {"signal: ", "signal"}, {"tell: ", "tell"}, {"on_take: ", "on_take"}};
    for (size_t a = 0; a < sizeof ACTIONS / sizeof *ACTIONS; a++)
        add_transition_key(g, from, t, ACTIONS[a][0], ACTIONS[a][1]);
    g->margin = "";
}

/* ---- states ---- */

/* Writes a colour, mixed with so much white, as "#rrggbb". */
static void print_tint(JoxText *out, JoxInk ink, double white) {
    const double of[] = {ink.r, ink.g, ink.b};
    jox_text_add(out, "\"#");
    for (int c = 0; c < 3; c++)
        jox_text_printf(out, "%02x", (unsigned)(of[c] + white * (255.0 - of[c]) + 0.5));
    jox_text_add(out, "\"");
}

/* Adds the steering or duration of a step, which no file has as a key of a state. */
static void add_step_line(Graph *g, const JoxState *state, const char *key) {
    JoxText line = {0};
    if (strcmp(key, "steer") == 0)
        jox_why_spell_steering(g->machine, state, &line);
    if (strcmp(key, "lasts") == 0 && state->has_lasts) {
        jox_text_add(&line, "lasts ");
        jox_dist_print(&state->lasts, &line);
        jox_text_add(&line, " s");
    }
    if (line.length)
        add_lines(g, line.data, STATE_WIDTH);
    jox_text_free(&line);
}

/* Adds what a state does. */
static void add_state_lines(Graph *g, const JoxState *state) {
    static const char *const KEYS[][2] = {
        {"", "steer"},        {"lasts ", "lasts"},        {"signal: ", "signal"},
        {"set: ", "set"},     {"tell: ", "tell"},         {"kick: ", "kick"},
        {"take: ", "take"},   {"drop: ", "drop"},         {"throw: ", "throw"},
        {"grasp: ", "grasp"}, {"on_enter: ", "on_enter"}, {"on_exit: ", "on_exit"}};
    char of[256], path[2 * sizeof of];
    jox_state_path(state, of);
    for (size_t k = 0; k < sizeof KEYS / sizeof *KEYS; k++) {
        snprintf(path, sizeof path, "%s.%s", of, KEYS[k][1]);
        if (!add_written(g, KEYS[k][0], path, STATE_WIDTH) && jox_state_is_step(g->machine, state))
            add_step_line(g, state, KEYS[k][1]);
    }
    if (state->become) {
        snprintf(path, sizeof path, "becomes %.100s", state->become);
        add_lines(g, path, STATE_WIDTH);
    }
    if (state->removes)
        add_lines(g, "leaves the world", STATE_WIDTH);
    if (state->ends)
        add_lines(g, "the machine ends", STATE_WIDTH);
    for (uint32_t k = 0; k < state->transition_count; k++)
        if (state->transitions[k].stays && is_own_item(state, &state->transitions[k]))
            add_item_lines(g, state, k);
}

/* Adds name and lines of a state, as the label of its box or frame. */
static void add_label(Graph *g, const JoxState *state) {
    const JoxMachine *m = g->machine;
    JoxText *out = &g->out;
    const size_t around =
        state->depth > 0 ? strlen(m->outer[state->around[state->depth - 1]].name) + 1 : 0;
    jox_text_add(out, "label=<<b>");
    jox_quote_xml(out, state->name + around);
    jox_text_add(out, "</b><br/><font point-size=\"9\">");
    const size_t before = out->length;
    add_state_lines(g, state);
    if (out->length == before)
        jox_text_add(out, " ");
    jox_text_add(out, "</font>>");
}

/* Adds the box of a state. */
static void add_state(Graph *g, uint32_t s) {
    const JoxState *state = &g->machine->states[s];
    jox_text_printf(&g->out, "  s%u [id=\"state%u\"%s, color=", s, s,
                    state->removes || state->become || state->ends ? ", peripheries=2" : "");
    print_tint(&g->out, g->inks[s], 0.0);
    jox_text_add(&g->out, ", fillcolor=");
    print_tint(&g->out, g->inks[s], 0.82);
    jox_text_add(&g->out, ", ");
    add_label(g, state);
    jox_text_add(&g->out, "];\n");
}

/* Adds the states of a machine: the behaviour's own (`outer` -1), or that which an outer state
   runs, which stands in a frame. */
static void add_states(Graph *g, int32_t outer) {
    const JoxMachine *m = g->machine;
    const uint8_t depth = outer < 0 ? 0 : (uint8_t)(m->outer[outer].depth + 1);
    for (uint32_t s = 0; s < m->state_count; s++)
        if (m->states[s].depth == depth && (outer < 0 || m->states[s].around[depth - 1] == outer))
            add_state(g, s);
    for (uint32_t o = 0; o < m->outer_count; o++) {
        if (m->outer[o].depth != depth || (outer >= 0 && m->outer[o].around[depth - 1] != outer))
            continue;
        jox_text_printf(
            &g->out,
            "  subgraph cluster_%u {\n  style=rounded; color=\"#666666\"; fontsize=11;\n  ", o);
        add_label(g, &m->outer[o]);
        jox_text_add(&g->out, ";\n");
        add_states(g, (int32_t)o);
        jox_text_add(&g->out, "  }\n");
    }
}

/* Adds the transitions that a state lists itself. Those of an outer state begin at the frame of its
   machine: at the state where that begins, as far as the frame hides the arrow. */
static void add_transitions(Graph *g, const JoxState *from, uint32_t node, int32_t frame) {
    for (uint32_t k = 0; k < from->transition_count; k++) {
        const JoxTransition *t = &from->transitions[k];
        if (t->stays || !is_own_item(from, t))
            continue;
        char to[32];
        snprintf(to, sizeof to, "s%u", t->to);
        if (t->back) {
            snprintf(to, sizeof to, "back%u_%d_%u", node, frame + 1, k);
            jox_text_printf(&g->out, "  %s [shape=plaintext, style=\"\", label=\"back\"];\n", to);
        }
        jox_text_printf(&g->out, "  s%u -> %s [id=\"transition%u_%u\", ", node, to, node, k);
        if (t->back)
            jox_text_add(&g->out, "style=dashed, ");
        if (frame >= 0)
            jox_text_printf(&g->out, "ltail=cluster_%d, penwidth=1.8, color=\"#666666\"", frame);
        else
            jox_text_add(&g->out, "color=");
        if (frame < 0)
            print_tint(&g->out, g->inks[node], 0.0);
        jox_text_add(&g->out, ", label=<");
        add_item_lines(g, from, k);
        jox_text_add(&g->out, ">];\n");
    }
}

static bool is_name_character(char c) {
    return c == '_' || isalnum((unsigned char)c);
}

/* Returns whether a text has a name as a word of its own. */
static bool has_word(const char *text, const char *name) {
    const size_t length = strlen(name);
    for (const char *at = text; at && (at = strstr(at, name)); at++)
        if ((at == text || !is_name_character(at[-1])) && !is_name_character(at[length]))
            return true;
    return false;
}

/* A local variable, in a list. */
typedef struct Local {
    char *name, *value;
    bool shown;
} Local;
typedef struct Locals {
    Local *items;
    size_t count, capacity;
} Locals;

static void keep_local(void *context, const char *name, const char *value) {
    Locals *all = context;
    JOX_RESERVE(all->items, all->capacity, all->count + 1);
    all->items[all->count++] = (Local){jox_strdup(name), jox_strdup(value), false};
}

/* Adds a note with the local variables that the graph names, also through one another. */
static void add_locals(Graph *g) {
    Locals all = {0};
    bool more = true, any = false;
    jox_lua_locals(g->lua, g->machine, keep_local, &all);
    while (more) {
        more = false;
        for (size_t v = 0; v < all.count; v++) {
            Local *local = &all.items[v];
            if (local->shown || !has_word(g->seen.data, local->name))
                continue;
            local->shown = more = any = true;
            jox_text_printf(&g->seen, "%s\n", local->value);
        }
    }
    if (any)
        jox_text_add(&g->out, "  where [shape=note, style=filled, fillcolor=\"#f7f7f7\", "
                              "color=\"#888888\", fontsize=9, label=<");
    for (size_t v = 0; v < all.count; v++) {
        JoxText line = {0};
        jox_text_printf(&line, "%s = %s", all.items[v].name, all.items[v].value);
        if (all.items[v].shown)
            add_lines(g, line.data, NOTE_WIDTH);
        jox_text_free(&line);
        jox_free(all.items[v].name);
        jox_free(all.items[v].value);
    }
    if (any)
        jox_text_add(&g->out, ">];\n");
    jox_free(all.items);
}

/* Writes the graph of a machine; `inks` has the colours of its states. Returns its text. */
static char *write_graph(const JoxLua *lua, const JoxScope *scope, const JoxMachine *machine,
                         const JoxInk *inks) {
    Graph g = {.lua = lua, .scope = scope, .machine = machine, .inks = inks, .margin = ""};
    jox_text_add(
        &g.out,
        "// The graph of a behaviour, by `jostle graph`; dot -Tsvg draws it.\n"
        "digraph behaviour {\n"
        "  graph [compound=true, rankdir=TB, nodesep=0.4, ranksep=0.45, fontname=\"Helvetica\", "
        "labelloc=t, fontsize=14, bgcolor=white, label=<<b>");
    jox_quote_xml(&g.out, machine->name);
    jox_text_add(&g.out, "</b>>];\n"
                         "  node [shape=box, style=\"rounded,filled\", fontname=\"Helvetica\", "
                         "fontsize=11, margin=\"0.12,0.06\", penwidth=1.5];\n"
                         "  edge [fontname=\"Helvetica\", fontsize=8, fontcolor=\"#333333\", "
                         "arrowsize=0.7];\n"
                         "  start [shape=circle, style=filled, fillcolor=black, width=0.14, "
                         "fixedsize=true, label=\"\"];\n");
    add_states(&g, -1);
    jox_text_printf(&g.out, "  start -> s%u;\n", machine->start);
    for (uint32_t o = 0; o < machine->outer_count; o++)
        add_transitions(&g, &machine->outer[o], machine->outer[o].start, (int32_t)o);
    for (uint32_t s = 0; s < machine->state_count; s++)
        add_transitions(&g, &machine->states[s], s, -1);
    add_locals(&g);
    jox_text_add(&g.out, "}\n");
    jox_text_free(&g.seen);
    return g.out.data;
}

/* ---- files ---- */

/* Writes the graph of one machine of a set; its states have the colours that they have in pictures
   of the set's crowd. */
static char *write_graph_of_set(const JoxLua *lua, const JoxScope *scope,
                                const JoxMachine *const *machines, uint32_t count,
                                uint32_t chosen) {
    uint32_t total = 0, first = 0;
    for (uint32_t m = 0; m < count; m++) {
        first += m < chosen ? machines[m]->state_count : 0;
        total += machines[m]->state_count;
    }
    JoxColour *given = jox_alloc(total + 1, sizeof *given);
    JoxInk *inks = jox_alloc(total + 1, sizeof *inks);
    uint32_t at = 0;
    for (uint32_t m = 0; m < count; m++)
        for (uint32_t s = 0; s < machines[m]->state_count; s++)
            given[at++] = machines[m]->states[s].colour;
    jox_palette_classes(given, total, inks);
    char *text = write_graph(lua, scope, machines[chosen], inks + first);
    jox_free(given);
    jox_free(inks);
    return text;
}

/* Loads a behaviour by itself and writes its graph; NULL with `error`. */
static char *graph_behaviour(const JoSceneDef *def, JoError *error) {
    static const JoxScope ANY = {0};
    JoxDiagnostics diagnostics = {0};
    JoxLua *lua = jox_lua_create(NULL);
    JoxMachine *machine = jox_lua_load(lua, def->path, &ANY, &diagnostics);
    const JoxMachine *const machines[] = {machine};
    char *text = machine ? write_graph_of_set(lua, &ANY, machines, 1, 0) : NULL;
    jox_run_report_diagnostics(def->message, def->message_context, &diagnostics,
                               text ? NULL : error);
    jox_machine_free(machine);
    jox_lua_free(lua);
    return text;
}

/* Returns the number of the behaviour of a scene that is asked for, by its name or its file's; -1
   with `error` if there is none, or none is asked for and there are several. */
static int64_t choose_machine(const JoxMachineSet *set, const char *behaviour, JoError *error) {
    JoxText names = {0};
    for (uint32_t m = 0; m < set->count; m++) {
        const JoxMachine *machine = set->items[m];
        if (behaviour ? strcmp(machine->name, behaviour) == 0 ||
                            jox_path_same(machine->path, behaviour) ||
                            strcmp(jox_path_name(machine->path), behaviour) == 0
                      : set->count == 1)
            return m;
        jox_text_printf(&names, "%s%.60s", m ? ", " : "", machine->name);
    }
    if (set->count == 0)
        jox_error(error, JO_USAGE, "the scene has no behaviours");
    else if (behaviour)
        jox_error(error, JO_USAGE, "the scene has no behaviour '%.60s', but %s", behaviour,
                  names.data);
    else
        jox_error(error, JO_USAGE,
                  "the scene has several behaviours: say --behaviour with one of %s", names.data);
    jox_text_free(&names);
    return -1;
}

static char *graph_scene(const JoSceneDef *def, const char *behaviour, JoError *error) {
    JoScene *scene = jo_scene_load(def, error);
    char *text = NULL;
    if (!scene)
        return NULL;
    const JoxMachineSet *set = scene->world->machines.set;
    const int64_t chosen = choose_machine(set, behaviour, error);
    if (chosen >= 0)
        text = write_graph_of_set(scene->lua, &scene->scope, (const JoxMachine *const *)set->items,
                                  set->count, (uint32_t)chosen);
    jo_scene_free(scene);
    return text;
}

char *jo_graph(const JoSceneDef *def, const char *behaviour, JoError *error) {
    JOX_REQUIRE(def && def->path, NULL);
    JOX_GUARD (NULL, error)
        return NULL;
    const size_t length = strlen(def->path);
    const bool is_lua = length > 4 && strcmp(def->path + length - 4, ".lua") == 0;
    return jox_disown(is_lua ? graph_behaviour(def, error) : graph_scene(def, behaviour, error));
}

bool jo_graph_draw(const char *graph, const char *path, JoError *error) {
    static const char *const FORMATS[] = {"svg", "png", "pdf"};
    JOX_REQUIRE(graph && path, false);
    JOX_GUARD (NULL, error)
        return false;
    const char *dot = strrchr(jox_path_name(path), '.'), *format = NULL;
    for (size_t f = 0; dot && f < sizeof FORMATS / sizeof *FORMATS; f++)
        format = strcmp(dot + 1, FORMATS[f]) == 0 ? FORMATS[f] : format;
    JoxText why = {0};
    if (!format) {
        jox_error(error, JO_USAGE, "graphs are drawn into .svg, .png and .pdf, not '%.200s'", path);
        return false;
    }
    return jox_graphviz_draw(graph, format, path, &why) || jox_run_fill_error(error, &why);
}
