/* The machines of a scene as JSON: states with their parameters and the place that set each, and
   transitions as they are written. Also the line of Lua that would set a parameter. Called for the
   scene message (live_scene.c) and the command `lua` (scene_commands.c). */
#include <ctype.h>
#include <math.h>

#include "live/inspect.h"
#include "run/set_parameter.h"

/* ---- the place that set a value ---- */

/* The value of a parameter and the place that set it. */
typedef struct SetBy {
    /* "state Circle behaviours/tawaf.lua:21", "mod calm ...", "program or page", "engine" */
    JoxText where;
    JoxText text;  /* the value as its file writes it */
    double number; /* the value; NAN if it differs between agents or over time */
    int line; /* in the file that sets it; 0: the engine's value, JOX_LINE_LIVE: set at run time */
} SetBy;

/* Appends "KIND FILE:LINE", or the mod that set the value. `kind` is "defaults" or "state
   Circle". */
static void print_written_place(const char *kind, const JoxWritten *written, JoxText *out) {
    if (written->mod)
        jox_text_printf(out, "mod %s %s:%d", written->mod, written->file, written->line);
    else
        jox_text_printf(out, "%s %s:%d", kind, written->file, written->line);
}

/* Looks up a parameter (an index of jox_parameters) of a state, or of the machine's defaults where
   `state` is NULL or does not set it. The caller frees the result. */
static SetBy find_setter(const JoScene *scene, const JoxMachine *machine, const JoxState *state,
                         int p) {
    SetBy by = {0};
    char path[256], kind[160] = "defaults";
    JoxWritten written = {0};
    const JoxValue *value = &machine->defaults[p];
    const JoxState *setter = NULL;
    bool found = false;
    if (state && state->param[p].kind != JOX_VALUE_UNSET) {
        setter = jox_parameter_setter(machine, state, p);
        value = &state->param[p];
        if (setter) /* else the defaults of a machine that an outer state runs */
            snprintf(kind, sizeof kind, "state %.120s", setter->name);
        snprintf(path, sizeof path, "states.%.120s.%s", state->name, jox_parameters[p].name);
    } else {
        snprintf(path, sizeof path, "defaults.%s", jox_parameters[p].name);
    }
    by.line = value->line;
    if (value->line == JOX_LINE_LIVE) {
        jox_text_add(&by.where, "program or page");
        if (setter && setter != state)
            jox_text_printf(&by.where, ", %s", kind);
    } else if (value->line > 0) {
        found = jox_lua_written_or_built(scene->lua, machine, path, &scene->scope, &written);
        if (!found) /* the value was computed by a function, so its path is not in the text */
            written =
                (JoxWritten){.file = jox_machine_file(machine, value->source), .line = value->line};
        print_written_place(kind, &written, &by.where);
    } else {
        jox_text_add(&by.where, "engine");
    }
    if (found)
        by.text = written.text;
    else if (value->kind == JOX_VALUE_CONST)
        jox_text_printf(&by.text, "%.9g", value->number);
    by.number = NAN;
    if (value->kind == JOX_VALUE_CONST) {
        by.number = value->number;
    } else if (value->kind == JOX_VALUE_OWN) { /* the same for all unless a group gives another */
        const JoxDist *dist = &machine->own[value->index].dist;
        by.number = dist->kind == JOX_DIST_CONSTANT ? dist->a : NAN;
    } else if (value->kind == JOX_VALUE_UNSET) {
        by.number = jox_parameters[p].value;
    }
    return by;
}

static void free_setter(SetBy *by) {
    jox_text_free(&by->where);
    jox_text_free(&by->text);
}

/* ---- the graph ---- */

/* Adds a parameter, an index of jox_parameters, as `state` has it, or the machine's defaults where
   that is NULL. The caller ends the object. */
static void begin_parameter(const JoScene *scene, const JoxMachine *machine, const JoxState *state,
                            int p, JoxJson *json) {
    const JoxParameterInfo *info = &jox_parameters[p];
    SetBy by = find_setter(scene, machine, state, p);
    jox_json_object(json, NULL);
    jox_json_string(json, "name", info->name);
    jox_json_number(json, "value", by.number);
    jox_json_string(json, "text", by.text.data ? by.text.data : "");
    jox_json_string(json, "set", by.where.data);
    jox_json_number(json, "least", info->least);
    jox_json_number(json, "most", info->greatest);
    jox_json_string(json, "unit", info->unit);
    free_setter(&by);
}

static void add_parameter_list(const JoScene *scene, const JoxMachine *machine,
                               const JoxState *state, JoxJson *json, const char *key) {
    jox_json_array(json, key);
    for (int p = 0; p < JOX_PARAM_COUNT; p++) {
        begin_parameter(scene, machine, state, p, json);
        jox_json_end(json);
    }
    jox_json_end(json);
}

/* Returns whether a state sets a parameter itself, or an outer state within the one on `level`
   does. */
static bool sets_apart(const JoxMachine *machine, const JoxState *state, uint32_t level, int p) {
    const JoxState *setter = jox_parameter_setter(machine, state, p);
    return setter && setter->depth > level;
}

/* Adds a parameter of an outer state, as the states within it have it that do not set it
   themselves, and the names of those that do ("apart"). */
static void add_outer_parameter(const JoScene *scene, const JoxMachine *machine, uint32_t outer,
                                int p, JoxJson *json) {
    const uint32_t level = machine->outer[outer].depth;
    const JoxState *shown = NULL;
    for (uint32_t s = 0; s < machine->state_count && !shown; s++)
        if (jox_state_is_within(&machine->states[s], level, outer) &&
            !sets_apart(machine, &machine->states[s], level, p))
            shown = &machine->states[s];
    begin_parameter(scene, machine, shown ? shown : &machine->outer[outer], p, json);
    jox_json_array(json, "apart");
    for (uint32_t s = 0; s < machine->state_count; s++)
        if (jox_state_is_within(&machine->states[s], level, outer) &&
            sets_apart(machine, &machine->states[s], level, p))
            jox_json_string(json, NULL, machine->states[s].name);
    jox_json_end(json);
    jox_json_end(json);
}

/* Adds a state that runs a machine. */
static void add_outer_state(const JoScene *scene, const JoxMachine *machine, uint32_t outer,
                            JoxJson *json) {
    jox_json_object(json, NULL);
    jox_json_string(json, "name", machine->outer[outer].name);
    jox_json_integer(json, "line", machine->outer[outer].line);
    jox_json_array(json, "within");
    for (uint32_t s = 0; s < machine->state_count; s++)
        if (jox_state_is_within(&machine->states[s], machine->outer[outer].depth, outer))
            jox_json_whole(json, NULL, s);
    jox_json_end(json);
    jox_json_array(json, "parameters");
    for (int p = 0; p < JOX_PARAM_COUNT; p++)
        add_outer_parameter(scene, machine, outer, p, json);
    jox_json_end(json);
    jox_json_end(json);
}

/* Adds the text that the machine's files have at a path, or "" if they have none. */
static void add_source_text(const JoScene *scene, const JoxMachine *machine, const char *path,
                            JoxJson *json, const char *key) {
    JoxWritten written;
    bool found = jox_lua_written_or_built(scene->lua, machine, path, &scene->scope, &written);
    jox_json_string(json, key, found && written.text.data ? written.text.data : "");
    jox_text_free(&written.text);
}

static void add_machine_state(const JoScene *scene, const JoxMachine *machine,
                              const JoxState *state, JoxJson *json) {
    char path[256];
    jox_json_object(json, NULL);
    jox_json_string(json, "name", state->name);
    jox_json_integer(json, "line", state->line);
    snprintf(path, sizeof path, "states.%.200s.steer", state->name);
    add_source_text(scene, machine, path, json, "steer");
    if (state->removes)
        jox_json_bool(json, "removes", true);
    if (state->become)
        jox_json_string(json, "become", state->become);
    add_parameter_list(scene, machine, state, json, "parameters");
    jox_json_end(json);
}

static void add_machine_transition(const JoScene *scene, const JoxMachine *machine,
                                   const JoxState *from, const JoxTransition *t, JoxJson *json) {
    char path[300];
    jox_json_object(json, NULL);
    jox_json_string(json, "id", t->id);
    jox_json_string(json, "from", from->name);
    jox_json_string(json, "to", machine->states[t->to].name);
    if (t->back)
        jox_json_bool(json, "back", true); /* "to" is where it leads if no state was left before */
    if (t->stays)
        jox_json_bool(json, "reaction", true);
    snprintf(path, sizeof path, "states.%.120s.@%.120s.when", from->name, t->id);
    add_source_text(scene, machine, path, json, "text");
    jox_json_integer(json, "line", t->line);
    jox_json_number(json, "chance",
                    t->chance.kind == JOX_VALUE_CONST ? t->chance.number : (double)NAN);
    if (t->chance.kind != JOX_VALUE_CONST && t->chance.kind != JOX_VALUE_UNSET) {
        snprintf(path, sizeof path, "states.%.120s.@%.120s.chance", from->name, t->id);
        add_source_text(scene, machine, path, json, "chance_text");
    }
    jox_json_end(json);
}

static void add_machine_graph(const JoScene *scene, const JoxMachine *machine, JoxJson *json) {
    jox_json_object(json, NULL);
    jox_json_string(json, "name", machine->name);
    jox_json_string(json, "path", machine->path);
    jox_json_number(json, "version", machine->version);
    jox_json_whole(json, "reloads", machine->reloads);
    jox_json_string(json, "start", machine->states[machine->start].name);
    add_parameter_list(scene, machine, NULL, json, "defaults");
    jox_json_array(json, "states");
    for (uint32_t s = 0; s < machine->state_count; s++)
        add_machine_state(scene, machine, &machine->states[s], json);
    jox_json_end(json);
    jox_json_array(json, "outer");
    for (uint32_t o = 0; o < machine->outer_count; o++)
        add_outer_state(scene, machine, o, json);
    jox_json_end(json);
    jox_json_array(json, "transitions");
    for (uint32_t s = 0; s < machine->state_count; s++)
        for (uint32_t k = 0; k < machine->states[s].transition_count; k++)
            add_machine_transition(scene, machine, &machine->states[s],
                                   &machine->states[s].transitions[k], json);
    jox_json_end(json);
    jox_json_end(json);
}

void jox_live_add_machines(const JoScene *scene, JoxJson *json, const char *key) {
    const JoxMachineRun *machines = &scene->world->machines;
    jox_json_array(json, key);
    for (uint32_t m = 0; m < machines->set->count; m++)
        add_machine_graph(scene, machines->set->items[m], json);
    jox_json_end(json);
}

/* ---- a line to paste ---- */

static bool is_identifier(const char *name) {
    bool good = isalpha((unsigned char)*name) || *name == '_';
    for (const char *c = name; *c && good; c++)
        good = isalnum((unsigned char)*c) || *c == '_';
    return good;
}

bool jox_live_lua_line(const JoScene *scene, const char *machine, const char *state,
                       const char *parameter, double value, JoxText *out) {
    JoError error;
    JoxParameterChoice choice;
    if (!jox_run_choose_parameter(scene, machine, state, parameter, value, &choice, &error)) {
        jox_text_add(out, error.text);
        return false;
    }
    const JoxMachine *found = scene->world->machines.set->built[choice.machine];
    const JoxState *of = choice.state >= 0   ? &found->states[choice.state]
                         : choice.state < -1 ? &found->outer[-2 - choice.state]
                                             : NULL;
    /* A state within an outer one is written by the last part of its name, in another table. */
    const char *last = of && of->depth > 0 ? strrchr(state, '.') : NULL;
    const char *name = last ? last + 1 : state;
    const bool inherits = of && !(of->sets >> choice.parameter & 1);
    char path[256], key[160];
    JoxWritten written = {0};
    snprintf(key, sizeof key, is_identifier(name) ? "%.120s" : "[\"%.120s\"]", name);
    snprintf(path, sizeof path, "%s%.120s.%s", of ? "states." : "", state, parameter);
    jox_text_printf(out, "%s = { %s = %.9g, ... },   -- ", key, parameter, value);
    if (!inherits && jox_lua_written_or_built(scene->lua, found, path, &scene->scope, &written)) {
        jox_text_printf(out, "%s:%d", written.file, written.line);
        if (written.mod)
            jox_text_printf(out, " (mod %s)", written.mod);
        jox_text_printf(out, ", where it is %s", written.text.data);
    } else {
        snprintf(path, sizeof path, "%s%.120s", of ? "states." : "", state);
        bool there = jox_lua_written_or_built(scene->lua, found, path, &scene->scope, &written);
        jox_text_printf(out, "%s:%d",
                        there ? written.file : jox_machine_file(found, of ? of->source : 0),
                        there ? written.line
                        : of  ? of->line
                              : 1);
    }
    jox_text_free(&written.text);
    return true;
}
