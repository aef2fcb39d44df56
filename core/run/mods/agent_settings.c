/* Finds the present value of a parameter, own value or memory of one agent, and the places that set
   it: files, mods, the scene, and what the run wrote since the agent is watched (jo_agent_why). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "run/mods/settings.h"
#include "world/agent_inspection.h"

/* The agent, and the list being made. */
typedef struct Search {
    JoScene *scene;
    uint32_t i; /* index of the agent */
    const JoxMachine *machine;
    const JoxState *state;
    const JoxWatched *watched;
    JoxPack *pack;
    JoSettings *head;  /* head of the list, in the pack */
    const char *where; /* JoSetting.where of the places that add_place adds */
} Search;

/* Adds a setting that a visit of settings finds. */
static void add_place(void *context, const JoSetting *setting) {
    const Search *search = context;
    JoSetting one = *setting;
    one.where = search->where;
    one.time = (double)NAN;
    jox_settings_add(search->pack, &one);
}

static void add_written(const Search *search, JoSetBy by, JoxWritten *written, const char *where,
                        double time) {
    jox_settings_add(search->pack, &(JoSetting){.by = written->mod ? JO_SET_MOD : by,
                                                .value = written->text.data,
                                                .file = written->file,
                                                .line = written->line,
                                                .column = written->column,
                                                .mod = written->mod,
                                                .where = where,
                                                .time = time});
    jox_text_free(&written->text);
}

/* Returns the value that the agent's group sets for a parameter or memory, or NULL. */
static const JoxGroupValue *find_group_value(const Search *search, const char *name, bool memory) {
    const JoxSceneSpec *spec = search->scene->spec;
    const uint32_t group = search->scene->world->state.agents.group[search->i];
    if (group >= spec->group_count)
        return NULL;
    const JoxGroup *of = &spec->groups[group];
    const JoxGroupValue *values = memory ? of->memory : of->set;
    const uint32_t count = memory ? of->memory_count : of->set_count;
    for (uint32_t s = 0; s < count; s++)
        if (strcmp(values[s].name, name) == 0)
            return &values[s];
    return NULL;
}

static const char *name_place(const JoxSceneSpec *spec, int32_t place) {
    return place >= 0 && (uint32_t)place < spec->place_count ? spec->places[place].name
                                                             : "no place";
}

static bool add_group_value(const Search *search, const JoxGroupValue *value, const char *profile) {
    const JoxSceneSpec *spec = search->scene->spec;
    char where[200];
    JoxText text = {0};
    if (!value)
        return false;
    snprintf(where, sizeof where, "groups.%.80s%s%.80s",
             spec->groups[search->scene->world->state.agents.group[search->i]].name,
             profile ? ".profiles." : "", profile ? profile : "");
    if (value->kind == JOX_SET_NUMBER)
        jox_dist_print(&value->dist, &text);
    else
        jox_text_add(&text,
                     value->kind == JOX_SET_ANTIPODE ? "antipode" : name_place(spec, value->place));
    jox_settings_add(search->pack,
                     &(JoSetting){.by = JO_SET_SCENE,
                                  .value = text.data,
                                  .file = value->position.file ? value->position.file : spec->path,
                                  .line = value->position.line,
                                  .column = value->position.column,
                                  .where = where,
                                  .time = (double)NAN});
    jox_text_free(&text);
    return true;
}

/* Adds the value that the agent's group sets, then each of the group's profiles that sets the very
   number the agent has. Returns whether any was added. */
static bool add_group_settings(const Search *search, const char *name, double own) {
    const JoxSceneSpec *spec = search->scene->spec;
    const uint32_t group = search->scene->world->state.agents.group[search->i];
    bool given = add_group_value(search, find_group_value(search, name, false), NULL);
    for (uint32_t k = 0; group < spec->group_count && k < spec->groups[group].profile_count; k++) {
        const JoxProfile *profile = &spec->groups[group].profiles[k];
        for (uint32_t s = 0; s < profile->set_count; s++)
            if (strcmp(profile->set[s].name, name) == 0 &&
                profile->set[s].dist.kind == JOX_DIST_CONSTANT && profile->set[s].dist.a == own)
                given |= add_group_value(search, &profile->set[s], profile->name);
    }
    return given;
}

/* ---- writes during the run ---- */

static const JoxWrote *find_last_write(const Search *search, bool memory, uint32_t index) {
    const uint16_t machine = search->scene->world->state.agents.machine[search->i];
    for (uint32_t n = 0; n < search->watched->wrote_count; n++) {
        const JoxWrote *wrote = &search->watched->wrote[n];
        if (wrote->is_memory == memory && wrote->index == index && wrote->machine == machine)
            return wrote;
    }
    return NULL;
}

/* Adds a write by the `set` of a transition or of a state. */
static void add_set_action(const Search *search, const JoxWrote *wrote, const char *name,
                           double time) {
    const JoxMachine *machine = search->machine;
    const JoxState *state = wrote->state < machine->state_count
                                ? &machine->states[wrote->state]
                                : &machine->outer[wrote->state - machine->state_count];
    const bool taken = wrote->by == JOX_WROTE_TRANSITION;
    const JoxTransition *t = taken ? &state->transitions[wrote->transition] : NULL;
    char path[400], where[160];
    JoxWritten written;
    if (taken) {
        snprintf(path, sizeof path, "states.%.120s.@%.120s.set.%.100s", state->name, t->id, name);
        snprintf(where, sizeof where, "to %.120s", jox_transition_leads_to(machine, t));
    } else {
        snprintf(path, sizeof path, "states.%.120s.set.%.100s", state->name, name);
        snprintf(where, sizeof where, "state %.120s", state->name);
    }
    if (!jox_lua_written(search->scene->lua, search->machine, path, &search->scene->scope,
                         &written))
        written = (JoxWritten){
            .file = jox_machine_file(search->machine, taken ? t->source : state->source),
            .line = taken ? t->line : state->line};
    add_written(search, JO_SET_BEHAVIOUR, &written, where, time);
}

/* Adds the last write since the agent is watched, if there is one. */
static void add_last_write(const Search *search, const JoxWrote *wrote, const char *name) {
    if (!wrote)
        return;
    const double time = wrote->tick * search->scene->world->model.def.dt;
    if (wrote->by == JOX_WROTE_TRANSITION || wrote->by == JOX_WROTE_STATE)
        add_set_action(search, wrote, name, time);
    else
        jox_settings_add(
            search->pack,
            &(JoSetting){.by = wrote->by == JOX_WROTE_FUNCTION ? JO_SET_FUNCTION : JO_SET_PROGRAM,
                         .file = wrote->file,
                         .line = wrote->line,
                         .where = "",
                         .time = time});
}

/* ---- parameters, own values, memory ---- */

/* Adds a setting without a place in a file, at an unknown time. */
static void add_unplaced(const Search *search, JoSetBy by, const char *where) {
    jox_settings_add(search->pack, &(JoSetting){.by = by, .where = where, .time = (double)NAN});
}

/* Adds a value of the defaults or of a state, at the place that writes it. */
static void add_declared_value(Search *search, const JoxValue *value, const char *path,
                               const char *where) {
    const JoxLua *lua = search->scene->lua;
    const JoxScope *scope = &search->scene->scope;
    JoxWritten written = {0};
    search->where = where;
    if (value->line == JOX_LINE_LIVE) {
        add_unplaced(search, JO_SET_PROGRAM, where);
    } else if (value->line > 0 &&
               !jox_lua_written_or_built(lua, search->machine, path, scope, &written)) {
        /* computed by a function, so that no line of the file has it */
        written = (JoxWritten){.file = jox_machine_file(search->machine, value->source),
                               .line = value->line};
        add_written(search, JO_SET_BEHAVIOUR, &written, where, (double)NAN);
    } else {
        jox_text_free(&written.text);
        jox_lua_why(lua, search->machine, path, scope, add_place, search);
    }
}

static void add_parameter(Search *search, int p) {
    const JoxAgents *a = &search->scene->world->state.agents;
    const char *name = jox_parameters[p].name;
    const JoxValue *inherited = &search->machine->defaults[p], *set = &search->state->param[p];
    const bool inherits = set->kind == JOX_VALUE_UNSET;
    const JoxValue *value = inherits ? inherited : set;
    const bool slot = value->kind == JOX_VALUE_OWN && (uint32_t)value->index < a->own_count;
    char path[256], where[160];
    snprintf(path, sizeof path, "defaults.%s", name);
    add_declared_value(search, inherited, path, "defaults");
    /* The default of a machine that an outer state runs is drawn, too: a group sets it likewise. */
    const bool general =
        !inherits && slot && search->machine->own[value->index].general == (uint32_t)p + 1;
    snprintf(path, sizeof path, "states.%.120s.%s", search->state->name, name);
    if (general)
        add_declared_value(search, set, path, "defaults");
    const bool drawn =
        inherited->kind == JOX_VALUE_OWN && (uint32_t)inherited->index < a->own_count;
    const bool given =
        drawn && inherited->index < 64 && (a->given[search->i] >> inherited->index & 1);
    const bool said = add_group_settings(
        search, name, drawn ? jox_own(a, search->i, (uint32_t)inherited->index) : (double)NAN);
    const JoxWrote *wrote = find_last_write(search, false, (uint32_t)p);
    const double meant = value->kind == JOX_VALUE_CONST ? value->number
                         : slot ? jox_own(a, search->i, (uint32_t)value->index)
                                : (double)NAN;
    /* The column differs from what the state sets: it was written directly, and keeps that value
       until a state sets another. */
    const bool apart =
        !isnan(meant) && jox_parameter_store((JoxParameter)p, meant) != jox_param(a, p, search->i);
    if (given && !said && !wrote)
        add_unplaced(search, JO_SET_UNSEEN, "");
    if (!apart)
        add_last_write(search, wrote, name);
    if (!inherits && !general) {
        const JoxState *by = jox_parameter_setter(search->machine, search->state, p);
        snprintf(where, sizeof where, by ? "state %.120s" : "defaults", by ? by->name : "");
        add_declared_value(search, set, path, where);
    }
    if (apart && wrote)
        add_last_write(search, wrote, name);
    else if (apart)
        add_unplaced(search, JO_SET_UNSEEN, "");
}

static void add_memory(Search *search, uint32_t slot) {
    const char *name = search->machine->memory[slot].name;
    char path[160];
    JoxWritten written;
    if (jox_lua_memory(search->scene->lua, search->machine, name, &written))
        add_written(search, JO_SET_BEHAVIOUR, &written, "memory", (double)NAN);
    add_group_value(search, find_group_value(search, name, true), NULL);
    for (uint32_t c = 0; c < search->machine->counter_count; c++)
        if (search->machine->counters[c].value == (int32_t)slot) {
            search->where = "counts";
            snprintf(path, sizeof path, "counts.%.120s", name);
            jox_lua_why(search->scene->lua, search->machine, path, &search->scene->scope, add_place,
                        search);
        }
    add_last_write(search, find_last_write(search, true, slot), name);
}

static void add_own(Search *search, const char *name, double value) {
    char path[160];
    search->where = "own";
    snprintf(path, sizeof path, "own.%.120s", name);
    jox_lua_why(search->scene->lua, search->machine, path, &search->scene->scope, add_place,
                search);
    add_group_settings(search, name, value);
}

/* Stores the present value as text. */
static void store_present_value(const Search *search, double value, bool place) {
    char number[32];
    snprintf(number, sizeof number, "%.6g", value);
    jox_settings_set_value(search->pack, search->head,
                           place ? name_place(search->scene->spec, (int32_t)value) : number);
}

/* Stores a value of memory as text. */
static void store_memory(const Search *search, int32_t slot) {
    const JoxAgents *a = &search->scene->world->state.agents;
    const JoxMachineRun *machines = &search->scene->world->machines;
    const double *memory = a->memory + (size_t)search->i * a->memory_stride;
    JoxText text = {0};
    jox_memory_print(machines, search->machine, memory, (uint32_t)slot, &text);
    jox_settings_set_value(search->pack, search->head, text.data);
    jox_text_free(&text);
}

/* Finds a value of the agent by name and lists what set it; false if there is none. */
static bool list_value(Search *search, const char *name, double *value) {
    const JoxAgents *a = &search->scene->world->state.agents;
    const int p = jox_parameter_find(name);
    const int32_t slot = jox_machine_memory(search->machine, name);
    if (slot >= 0) {
        *value = a->memory[(size_t)search->i * a->memory_stride + (uint32_t)slot];
        store_memory(search, slot);
        add_memory(search, (uint32_t)slot);
        return true;
    }
    if (p >= 0) {
        *value = jox_parameter_value((JoxParameter)p, jox_param(a, p, search->i));
        store_present_value(search, *value, false);
        add_parameter(search, p);
        return true;
    }
    for (uint32_t s = 0; s < search->machine->own_count; s++)
        if (strcmp(search->machine->own[s].name, name) == 0) {
            *value = jox_own(a, search->i, s);
            store_present_value(search, *value, search->machine->own[s].is_place);
            add_own(search, name, *value);
            return true;
        }
    return false;
}

/* Reports that the agent has no such value, and a similar name. */
static void report_unknown_value(const Search *search, const char *name, JoError *error) {
    const char *names[256];
    uint32_t count = 0;
    for (int p = 0; p < JOX_PARAM_COUNT; p++)
        names[count++] = jox_parameters[p].name;
    for (uint32_t s = 0; s < search->machine->memory_count && count < 256; s++)
        if (*search->machine->memory[s].name)
            names[count++] = search->machine->memory[s].name;
    for (uint32_t s = 0; s < search->machine->own_count && count < 256; s++)
        names[count++] = search->machine->own[s].name;
    const char *near = jox_suggest(name, names, count);
    jox_error(error, JO_INPUT, "an agent of '%s' has no value named '%.60s'%s%s",
              search->machine->name, name, near ? "; did you mean " : "", near ? near : "");
}

static Search begin_search(JoScene *scene, uint32_t i, const JoxWatched *watched, JoxPack *pack) {
    const JoxAgents *a = &scene->world->state.agents;
    const JoxMachine *machine = scene->world->machines.set->items[a->machine[i]];
    return (Search){.scene = scene,
                    .head = jox_settings_begin(pack),
                    .i = i,
                    .machine = machine,
                    .state = &machine->states[a->state[i]],
                    .watched = watched,
                    .pack = pack};
}

JoSettings *jox_run_parameter_settings(JoScene *scene, uint32_t i, const JoxWatched *watched,
                                       int parameter) {
    JoxPack pack = {0};
    Search search = begin_search(scene, i, watched, &pack);
    add_parameter(&search, parameter);
    return jox_settings_end(&pack);
}

/* Does the work of jo_agent_why, within its guard. */
static JoSettings *list_agent_settings(JoScene *scene, JoAgent agent, const char *name,
                                       double *value, JoError *error) {
    const JoxAgents *a = &scene->world->state.agents;
    const JoxWatched *watched;
    if (!jo_agent_is_live(scene->world, agent) ||
        !jox_world_inspect(scene->world, agent.slot, &watched)) {
        jox_error(error, JO_INPUT, "the agent is gone");
        return NULL;
    }
    const uint32_t i = a->slot_index[agent.slot];
    if (a->machine[i] == JOX_NO_MACHINE) {
        jox_error(error, JO_INPUT, "the agent has no behaviour");
        return NULL;
    }
    JoxPack pack = {0};
    Search search = begin_search(scene, i, watched, &pack);
    const bool found = list_value(&search, name, value);
    JoSettings *settings = jox_settings_end(&pack);
    if (found)
        return jox_disown(settings);
    report_unknown_value(&search, name, error);
    jox_free(settings);
    return NULL;
}

JoSettings *jo_agent_why(JoScene *scene, JoAgent agent, const char *name, double *value,
                         JoError *error) {
    JOX_REQUIRE(scene && name && value, NULL);
    JOX_GUARD (scene->heap, error)
        return NULL;
    return list_agent_settings(scene, agent, name, value, error);
}
