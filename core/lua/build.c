/* Builds a JoxMachine from the table that a behaviour returns. Every error is reported, not only
   the first. The loader calls jox_build once the file has run and mods have changed the table. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/format/name.h"
#include "base/mem.h"
#include "lua/infer_kinds.h"
#include "lua/language/vocabulary.h"
#include "lua/read_table.h"

/* Reads `defaults`. Every parameter gets an own value of its name, so that a group of the scene can
   set it. */
static void read_defaults(JoxBuild *b, int index) {
    lua_State *L = b->script->vm.L;
    JOX_ASSERT(lua_istable(L, index) && b->machine->own_count == 0);
    const char *known[JOX_PARAM_COUNT];
    for (int p = 0; p < JOX_PARAM_COUNT; p++) {
        const JoxParameterInfo *info = &jox_parameters[p];
        known[p] = info->name;
        int32_t slot = jox_build_own(b, info->name);
        b->machine->own[slot].dist = jox_dist_constant(info->value);
        b->machine->defaults[p] = (JoxValue){JOX_VALUE_OWN, 0.0, slot, 0, 0};
    }
    if (jox_read_field(L, index, "defaults") == LUA_TTABLE) {
        int table = lua_gettop(L);
        jox_read_check(b, table, "defaults", known, JOX_PARAM_COUNT, false);
        for (int p = 0; p < JOX_PARAM_COUNT; p++) {
            char path[256];
            bool is_dist;
            JoxDist dist;
            jox_read_join(path, "defaults", known[p]);
            if (jox_read_field(L, table, known[p]) == LUA_TNIL) {
                lua_pop(L, 1);
                continue;
            }
            JoxValue value = jox_read_value(b, path, &jox_parameters[p], &is_dist, &dist);
            b->machine->defaults[p].line = value.line;
            b->machine->defaults[p].source = value.source;
            if (is_dist)
                b->machine->own[p].dist = dist;
            else if (value.kind == JOX_VALUE_CONST)
                b->machine->own[p].dist = jox_dist_constant(value.number);
            else if (value.kind != JOX_VALUE_UNSET)
                b->machine->defaults[p] = value;
        }
    } else if (!lua_isnil(L, -1)) {
        jox_build_error(b, jox_read_at(b, "defaults"), "bad-value", NULL,
                        "defaults must be a table");
    }
    lua_pop(L, 1);
}

/* Returns whether the value at a stack index can name a state or machine. */
static bool is_valid_name_at(lua_State *L, int index) {
    if (lua_type(L, index) != LUA_TSTRING)
        return false;
    const char *text = lua_tostring(L, index);
    return strlen(text) == lua_rawlen(L, index) && jox_name_is_plain(text);
}

/* Adds a blank state for each name in the table, in ascending order, as tables have no order. */
static void add_blank_states(JoxBuild *b, int table) {
    lua_State *L = b->script->vm.L;
    JOX_ASSERT(lua_istable(L, table) && b->machine->state_count == 0);
    JoxMachine *m = b->machine;
    lua_pushnil(L);
    while (lua_next(L, table)) {
        bool good = is_valid_name_at(L, -2) && lua_type(L, -1) == LUA_TTABLE;
        const char *name = lua_type(L, -2) == LUA_TSTRING ? lua_tostring(L, -2) : "?";
        char path[256];
        jox_read_join(path, "states", name);
        if (lua_type(L, -2) == LUA_TSTRING && !is_valid_name_at(L, -2))
            jox_build_error(b, jox_read_at(b, path), "bad-name", JOX_NAME_RULE,
                            "'%.60s' is no name for a state", name);
        else if (!good || m->state_count >= 1000)
            jox_build_error(b, jox_read_at(b, path), "bad-value",
                            "Example: Walk = { steer = seek(goal) }",
                            "states must be tables with names");
        lua_pop(L, 1);
        if (!good || m->state_count >= 1000)
            continue;
        JOX_RESERVE(m->states, b->state_capacity, m->state_count + 1);
        uint32_t place = m->state_count++;
        for (; place > 0 && strcmp(m->states[place - 1].name, name) > 0; place--)
            m->states[place] = m->states[place - 1];
        m->states[place] = jox_state_blank(jox_strdup(name));
    }
}

/* Reads `states` in ascending order of names. */
static void read_states(JoxBuild *b, int index) {
    lua_State *L = b->script->vm.L;
    JoxMachine *m = b->machine;
    if (jox_read_field(L, index, "states") != LUA_TTABLE) {
        jox_build_error(b, jox_read_at(b, "states"), "missing-key", "states = { Walk = { ... } }",
                        "a machine needs `states`, a table");
        lua_pop(L, 1);
        return;
    }
    int table = lua_gettop(L);
    add_blank_states(b, table);
    for (uint32_t s = 0; s < m->state_count; s++) {
        jox_read_field(L, table, m->states[s].name);
        jox_read_state(b, lua_gettop(L), &m->states[s], (int32_t)s);
        lua_settop(L, table);
    }
    if (m->state_count == 0)
        jox_build_error(b, jox_read_at(b, "states"), "no-states", NULL,
                        "a machine needs at least one state");
    lua_pop(L, 1);
}

/* Reads `version`, the author's number of the file, which messages show. */
static void read_version(JoxBuild *b, int index) {
    lua_State *L = b->script->vm.L;
    const int type = jox_read_field(L, index, "version");
    if (type == LUA_TNUMBER && isfinite(lua_tonumber(L, -1)))
        b->machine->version = lua_tonumber(L, -1);
    else if (type != LUA_TNIL)
        jox_build_error(b, jox_read_at(b, "version"), "bad-value", "version = 1",
                        "version must be a finite number, not %s",
                        type == LUA_TNUMBER ? "this one" : lua_typename(L, type));
    lua_pop(L, 1);
}

/* Reads `start`, the state that agents begin in. */
static void read_start_state(JoxBuild *b, int index) {
    lua_State *L = b->script->vm.L;
    JOX_ASSERT(b->machine->start == 0);
    JoxMachine *m = b->machine;
    const char *start =
        jox_read_field(L, index, "start") == LUA_TSTRING ? lua_tostring(L, -1) : NULL;
    int state = start ? jox_machine_state(m, start) : -1;
    if (state < 0 && m->state_count > 0)
        jox_build_error(b, jox_read_at(b, "start"), start ? "unknown-state" : "missing-key", NULL,
                        start ? "there is no state '%s' to start in"
                              : "a machine needs `start`, the name of a state%s",
                        start ? start : "");
    m->start = state < 0 ? 0 : (uint16_t)state;
    lua_pop(L, 1);
}

/* Reads `renamed`: old names of states, own values and memory. */
static void read_renamed(JoxBuild *b, int index) {
    lua_State *L = b->script->vm.L;
    JoxMachine *m = b->machine;
    size_t capacity = 0;
    if (jox_read_field(L, index, "renamed") == LUA_TTABLE) {
        lua_pushnil(L);
        while (lua_next(L, -2)) {
            if (lua_type(L, -1) == LUA_TSTRING && lua_type(L, -2) == LUA_TSTRING) {
                JOX_RESERVE(m->renamed, capacity, m->renamed_count + 1);
                m->renamed[m->renamed_count++] = (struct JoxRenamed){
                    jox_strdup(lua_tostring(L, -2)), jox_strdup(lua_tostring(L, -1))};
            } else {
                jox_build_error(b, jox_read_at(b, "renamed"), "bad-value",
                                "renamed = { Old = \"New\" }",
                                "renamed maps old names of states, own values and memory to new "
                                "ones");
            }
            lua_pop(L, 1);
        }
    }
    lua_pop(L, 1);
}

/* Returns where a state or own value is written, or first used. */
static JoxPosition locate_part(JoxBuild *b, JoxPart part, const char *name) {
    const JoxMachine *m = b->machine;
    char path[256];
    for (uint32_t o = 0; part == JOX_PART_OWN && o < m->own_count; o++) {
        const JoxOwnSlot *own = &m->own[o];
        if (own->line > 0 && strcmp(own->name, name) == 0)
            return (JoxPosition){b->script->vm.sources[own->source]->path, own->line, own->column,
                                 own->end_column};
    }
    jox_read_join(path, part == JOX_PART_OWN ? "own" : "states", name);
    return jox_read_at(b, path);
}

/* Reports an old name of a renamed part that a mod's file uses; the behaviour's author may use it
   again. */
static void check_part_name(JoxBuild *b, JoxPart part, const struct JoxRenamed *renamed) {
    const JoxMachine *m = b->machine;
    if (!jox_machine_has(m, part, renamed->to) || !jox_machine_has(m, part, renamed->from))
        return;
    const JoxPosition at = locate_part(b, part, renamed->from);
    if (at.file && strcmp(at.file, m->path) != 0)
        jox_diag_renamed(b->script->diagnostics, at, renamed->from, renamed->to);
}

/* Checks renamed names once all parts are read: that the new name exists and no mod uses the old
   one. */
static void check_renamed_names(JoxBuild *b) {
    const JoxMachine *m = b->machine;
    for (uint32_t r = 0; r < m->renamed_count; r++) {
        const char *from = m->renamed[r].from, *to = m->renamed[r].to;
        char path[256];
        check_part_name(b, JOX_PART_STATE, &m->renamed[r]);
        check_part_name(b, JOX_PART_OWN, &m->renamed[r]);
        jox_read_join(path, "renamed", from);
        if (!jox_machine_has(m, JOX_PART_STATE, to) && !jox_machine_has(m, JOX_PART_OWN, to) &&
            !jox_machine_has(m, JOX_PART_MEMORY, to))
            jox_diag_warn(b->script->diagnostics, jox_read_at(b, path), "unknown-name",
                          "Give the name that it has in this version",
                          "there is no state, own value or memory '%.60s'", to);
    }
}

/* Builds the machine of the value on top of the stack; may raise errors of the VM. */
static void build_machine(JoxBuild *build) {
    JoxScript *script = build->script;
    const JoxSource *source = build->source;
    lua_State *L = script->vm.L;
    JoxNode *node = jox_node_get(L, -1);
    jox_misuse_find(build);
    if (!node || node->kind != JOX_NODE_MACHINE) {
        if (!node || node->kind != JOX_NODE_ERROR)
            jox_diag_error(
                script->diagnostics, ((JoxPosition){source->path, 0, 0, 0}), "no-machine",
                lua_istable(L, -1) ? "A plain table is no machine: return machine { ... }"
                                   : "End the file with: return machine { ... }",
                "a behaviour must return one machine, not %s",
                node ? "a value" : lua_typename(L, lua_type(L, -1)));
        return;
    }
    size_t errors = script->diagnostics->errors;
    JoxMachine *m = build->machine = script->built = jox_alloc(1, sizeof *m);
    m->version = (double)NAN;
    m->vm = -1;
    m->path = jox_strdup(source->path);
    m->files = jox_alloc(script->vm.source_count, sizeof *m->files);
    for (; m->file_count < script->vm.source_count; m->file_count++)
        m->files[m->file_count] = jox_strdup(script->vm.sources[m->file_count]->path);
    lua_rawgeti(L, LUA_REGISTRYINDEX, node->hook);
    int table = lua_gettop(L);
    for (uint32_t i = 0; i < script->memory_count; i++) {
        int32_t slot = jox_build_memory(build, script->memory[i].name);
        m->memory[slot].kind = script->memory[i].kind;
        m->memory[slot].initial = script->memory[i].initial;
    }
    read_renamed(build, table); /* first, as later keys may use old names */
    const char *known[16];
    jox_read_check(build, table, "", known, jox_table_key_names("machine", false, known, 16),
                   false);
    jox_read_field(L, table, "name");
    m->name = jox_strdup(is_valid_name_at(L, -1) ? lua_tostring(L, -1) : "machine");
    if (lua_type(L, -1) == LUA_TSTRING && !is_valid_name_at(L, -1))
        jox_build_error(build, jox_read_at(build, "name"), "bad-name", JOX_NAME_RULE,
                        "'%.60s' is no name for a machine", lua_tostring(L, -1));
    else if (!is_valid_name_at(L, -1))
        jox_build_error(build, jox_read_at(build, "name"), "missing-key", "name = \"walker\"",
                        "a machine needs a name");
    lua_pop(L, 1);
    read_version(build, table);
    read_defaults(build, table);
    jox_read_own(build, table);
    read_states(build, table);
    read_start_state(build, table);
    jox_read_counts(build, table, "", -1);
    jox_read_public(build, table);
    check_renamed_names(build);
    m->belongings = script->belongings;
    m->belonging_count = script->belonging_count;
    script->belongings = NULL;
    script->belonging_count = 0;
    if (script->diagnostics->errors == errors)
        jox_lint(build);
}

void jox_build(JoxScript *script, const JoxSource *source) {
    JoxBuild build = {.script = script, .source = source};
    build_machine(&build);
    jox_kinds_free(build.kinds);
}
