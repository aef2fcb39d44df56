/* What a value of one agent is in a run, and what set it. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "run/mods/settings.h"
#include "world/inspected.h"

/* One agent, and the list that is made. */
typedef struct Now {
    JoScene *scene;
    uint32_t i; /* index */
    const JoxMachine *machine;
    const JoxState *state;
    const JoxWatched *watched;
    JoxPack *pack;
    JoSettings *head;  /* of what is listed, in the pack */
    const char *where; /* of places that are visited */
} Now;

static void add_place(void *context, const JoSetting *setting) {
    const Now *now = context;
    JoSetting one = *setting;
    one.where = now->where;
    one.time = (double)NAN;
    jox_settings_add(now->pack, &one);
}

static void add_written(const Now *now, JoSetBy by, JoxWritten *written, const char *where,
                        double time) {
    jox_settings_add(now->pack, &(JoSetting){.by = written->mod ? JO_SET_MOD : by,
                                             .value = written->text.data,
                                             .file = written->file,
                                             .line = written->line,
                                             .column = written->column,
                                             .mod = written->mod,
                                             .where = where,
                                             .time = time});
    jox_text_free(&written->text);
}

/* What the agent's group in the scene gives a name, or NULL. */
static const JoxGroupValue *group_value(const Now *now, const char *name, bool memory) {
    const JoxSceneSpec *spec = now->scene->spec;
    const uint32_t group = now->scene->world->state.agents.group[now->i];
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

static const char *place_name(const JoxSceneSpec *spec, int32_t place) {
    return place >= 0 && (uint32_t)place < spec->place_count ? spec->places[place].name
                                                             : "no place";
}

static bool add_group(const Now *now, const JoxGroupValue *value, const char *profile) {
    const JoxSceneSpec *spec = now->scene->spec;
    char where[200];
    JoxText text = {0};
    if (!value)
        return false;
    snprintf(where, sizeof where, "groups.%.80s%s%.80s",
             spec->groups[now->scene->world->state.agents.group[now->i]].name,
             profile ? ".profiles." : "", profile ? profile : "");
    if (value->kind == JOX_SET_NUMBER)
        jox_dist_print(&value->dist, &text);
    else
        jox_text_add(&text,
                     value->kind == JOX_SET_ANTIPODE ? "antipode" : place_name(spec, value->place));
    jox_settings_add(now->pack,
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

/* What the group gives, and after it a kind of people in it that has the very value; whether there
   is any. */
static bool add_given(const Now *now, const char *name, double own) {
    const JoxSceneSpec *spec = now->scene->spec;
    const uint32_t group = now->scene->world->state.agents.group[now->i];
    bool given = add_group(now, group_value(now, name, false), NULL);
    for (uint32_t k = 0; group < spec->group_count && k < spec->groups[group].profile_count; k++) {
        const JoxProfile *profile = &spec->groups[group].profiles[k];
        for (uint32_t s = 0; s < profile->set_count; s++)
            if (strcmp(profile->set[s].name, name) == 0 &&
                profile->set[s].dist.kind == JOX_DIST_CONSTANT && profile->set[s].dist.a == own)
                given |= add_group(now, &profile->set[s], profile->name);
    }
    return given;
}

/* ---- who wrote it in the run ---- */

static const JoxWrote *find_wrote(const Now *now, bool memory, uint32_t index) {
    const uint16_t machine = now->scene->world->state.agents.machine[now->i];
    for (uint32_t n = 0; n < now->watched->wrote_count; n++) {
        const JoxWrote *wrote = &now->watched->wrote[n];
        if (wrote->is_memory == memory && wrote->index == index && wrote->machine == machine)
            return wrote;
    }
    return NULL;
}

/* A `set` of a transition or of a state. */
static void add_set(const Now *now, const JoxWrote *wrote, const char *name, double time) {
    const JoxState *state = &now->machine->states[wrote->state];
    const bool taken = wrote->by == JOX_WROTE_TRANSITION;
    const JoxTransition *t = taken ? &state->transitions[wrote->transition] : NULL;
    char path[400], where[160];
    JoxWritten written;
    if (taken) {
        snprintf(path, sizeof path, "states.%.120s.@%.120s.set.%.100s", state->name, t->id, name);
        snprintf(where, sizeof where, "to %.120s", now->machine->states[t->to].name);
    } else {
        snprintf(path, sizeof path, "states.%.120s.set.%.100s", state->name, name);
        snprintf(where, sizeof where, "state %.120s", state->name);
    }
    if (!jox_lua_written(now->scene->lua, now->machine, path, &now->scene->scope, &written))
        written =
            (JoxWritten){.file = jox_machine_file(now->machine, taken ? t->source : state->source),
                         .line = taken ? t->line : state->line};
    add_written(now, JO_SET_BEHAVIOUR, &written, where, time);
}

/* The last who wrote it since the agent is watched. */
static void add_wrote(const Now *now, const JoxWrote *wrote, const char *name) {
    if (!wrote)
        return;
    const double time = wrote->tick * now->scene->world->model.def.dt;
    if (wrote->by == JOX_WROTE_TRANSITION || wrote->by == JOX_WROTE_STATE)
        add_set(now, wrote, name, time);
    else
        jox_settings_add(
            now->pack,
            &(JoSetting){.by = wrote->by == JOX_WROTE_FUNCTION ? JO_SET_FUNCTION : JO_SET_PROGRAM,
                         .file = wrote->file,
                         .line = wrote->line,
                         .where = "",
                         .time = time});
}

/* ---- parameters, own values, memory ---- */

/* One without a place in a file, at an unknown time. */
static void add_unplaced(const Now *now, JoSetBy by, const char *where) {
    jox_settings_add(now->pack, &(JoSetting){.by = by, .where = where, .time = (double)NAN});
}

/* A value of the defaults or of a state, where it is written. */
static void add_value(Now *now, const JoxValue *value, const char *path, const char *where) {
    const JoxLua *lua = now->scene->lua;
    const JoxScope *scope = &now->scene->scope;
    JoxWritten written = {0};
    now->where = where;
    if (value->line == JOX_LINE_LIVE) {
        add_unplaced(now, JO_SET_PROGRAM, where);
    } else if (value->line > 0 && !jox_lua_written(lua, now->machine, path, scope, &written)) {
        /* made by a function: no text says so */
        written = (JoxWritten){.file = jox_machine_file(now->machine, value->source),
                               .line = value->line};
        add_written(now, JO_SET_BEHAVIOUR, &written, where, (double)NAN);
    } else {
        jox_text_free(&written.text);
        jox_lua_why(lua, now->machine, path, scope, add_place, now);
    }
}

static void add_parameter(Now *now, int p) {
    const JoxAgents *a = &now->scene->world->state.agents;
    const char *name = jox_parameters[p].name;
    const JoxValue *inherited = &now->machine->defaults[p], *set = &now->state->param[p];
    const bool own = set->kind == JOX_VALUE_UNSET;
    const JoxValue *value = own ? inherited : set;
    const bool slot = value->kind == JOX_VALUE_OWN && (uint32_t)value->index < a->own_count;
    char path[256], where[160];
    snprintf(path, sizeof path, "defaults.%s", name);
    add_value(now, inherited, path, "defaults");
    const bool drawn =
        inherited->kind == JOX_VALUE_OWN && (uint32_t)inherited->index < a->own_count;
    const bool given = drawn && inherited->index < 64 && (a->given[now->i] >> inherited->index & 1);
    const bool said =
        add_given(now, name, drawn ? jox_own(a, now->i, (uint32_t)inherited->index) : (double)NAN);
    const JoxWrote *wrote = find_wrote(now, false, (uint32_t)p);
    const double meant = value->kind == JOX_VALUE_CONST ? value->number
                         : slot                         ? jox_own(a, now->i, (uint32_t)value->index)
                                                        : (double)NAN;
    /* Written into the column itself: that holds until the next state that says otherwise. */
    const bool apart =
        !isnan(meant) && jox_parameter_store((JoxParameter)p, meant) != jox_param(a, p, now->i);
    if (given && !said && !wrote)
        add_unplaced(now, JO_SET_UNSEEN, "");
    if (!apart)
        add_wrote(now, wrote, name);
    if (!own) {
        snprintf(path, sizeof path, "states.%.120s.%s", now->state->name, name);
        snprintf(where, sizeof where, "state %.120s", now->state->name);
        add_value(now, set, path, where);
    }
    if (apart && wrote)
        add_wrote(now, wrote, name);
    else if (apart)
        add_unplaced(now, JO_SET_UNSEEN, "");
}

static void add_memory(Now *now, uint32_t slot) {
    const char *name = now->machine->memory[slot].name;
    char path[160];
    JoxWritten written;
    if (jox_lua_memory(now->scene->lua, now->machine, name, &written))
        add_written(now, JO_SET_BEHAVIOUR, &written, "memory", (double)NAN);
    add_group(now, group_value(now, name, true), NULL);
    for (uint32_t c = 0; c < now->machine->counter_count; c++)
        if (now->machine->counters[c].value == (int32_t)slot) {
            now->where = "counts";
            snprintf(path, sizeof path, "counts.%.120s", name);
            jox_lua_why(now->scene->lua, now->machine, path, &now->scene->scope, add_place, now);
        }
    add_wrote(now, find_wrote(now, true, slot), name);
}

static void add_own(Now *now, const char *name, double value) {
    char path[160];
    now->where = "own";
    snprintf(path, sizeof path, "own.%.120s", name);
    jox_lua_why(now->scene->lua, now->machine, path, &now->scene->scope, add_place, now);
    add_given(now, name, value);
}

/* Keeps what the value is now, as text. */
static void say_value(const Now *now, double value, bool truth, bool place) {
    char number[32];
    snprintf(number, sizeof number, "%.6g", value);
    jox_settings_now(now->pack, now->head,
                     place   ? place_name(now->scene->spec, (int32_t)value)
                     : truth ? (value != 0.0 ? "true" : "false")
                             : number);
}

/* Whether the agent has such a value, which is then listed. */
static bool list(Now *now, const char *name, double *value) {
    const JoxAgents *a = &now->scene->world->state.agents;
    const int p = jox_parameter_find(name);
    const int32_t slot = jox_machine_memory(now->machine, name);
    if (slot >= 0) {
        *value = a->memory[(size_t)now->i * a->memory_stride + (uint32_t)slot];
        say_value(now, *value, now->machine->memory[slot].kind == JOX_MEMORY_BOOLEAN, false);
        add_memory(now, (uint32_t)slot);
        return true;
    }
    if (p >= 0) {
        *value = jox_parameter_value((JoxParameter)p, jox_param(a, p, now->i));
        say_value(now, *value, false, false);
        add_parameter(now, p);
        return true;
    }
    for (uint32_t s = 0; s < now->machine->own_count; s++)
        if (strcmp(now->machine->own[s].name, name) == 0) {
            *value = jox_own(a, now->i, s);
            say_value(now, *value, false, now->machine->own[s].is_place);
            add_own(now, name, *value);
            return true;
        }
    return false;
}

/* Says that the agent has no such value, and which may have been meant. */
static void not_there(const Now *now, const char *name, JoError *error) {
    const char *names[256];
    uint32_t count = 0;
    for (int p = 0; p < JOX_PARAM_COUNT; p++)
        names[count++] = jox_parameters[p].name;
    for (uint32_t s = 0; s < now->machine->memory_count && count < 256; s++)
        if (*now->machine->memory[s].name)
            names[count++] = now->machine->memory[s].name;
    for (uint32_t s = 0; s < now->machine->own_count && count < 256; s++)
        names[count++] = now->machine->own[s].name;
    const char *near = jox_suggest(name, names, count);
    jox_error(error, JO_INPUT, "an agent of '%s' has no value named '%.60s'%s%s",
              now->machine->name, name, near ? "; did you mean " : "", near ? near : "");
}

static Now now_of(JoScene *scene, uint32_t i, const JoxWatched *watched, JoxPack *pack) {
    const JoxAgents *a = &scene->world->state.agents;
    const JoxMachine *machine = scene->world->machines.set->items[a->machine[i]];
    return (Now){.scene = scene,
                 .head = jox_settings_begin(pack),
                 .i = i,
                 .machine = machine,
                 .state = &machine->states[a->state[i]],
                 .watched = watched,
                 .pack = pack};
}

JoSettings *jox_run_parameter_why(JoScene *scene, uint32_t i, const JoxWatched *watched,
                                  int parameter) {
    JoxPack pack = {0};
    Now now = now_of(scene, i, watched, &pack);
    add_parameter(&now, parameter);
    return jox_settings_end(&pack);
}

/* What jo_agent_why asks, within its guard. */
static JoSettings *why(JoScene *scene, JoAgent agent, const char *name, double *value,
                       JoError *error) {
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
    Now now = now_of(scene, i, watched, &pack);
    const bool found = list(&now, name, value);
    JoSettings *settings = jox_settings_end(&pack);
    if (found)
        return jox_disown(settings);
    not_there(&now, name, error);
    jox_free(settings);
    return NULL;
}

JoSettings *jo_agent_why(JoScene *scene, JoAgent agent, const char *name, double *value,
                         JoError *error) {
    JOX_REQUIRE(scene && name && value, NULL);
    JOX_GUARD (scene->heap, error)
        return NULL;
    return why(scene, agent, name, value, error);
}
