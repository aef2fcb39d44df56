/* Builds a JoxMachine from the table that a behaviour returns. Every error is reported, not only
   the first. The loader calls jox_build once the file has run and mods have changed the table. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/format/name.h"
#include "base/mem.h"
#include "lua/infer_kinds.h"
#include "lua/language/vocabulary.h"
#include "lua/read_table.h"

/* Returns whether the value at a stack index can name a state or machine. */
static bool is_valid_name_at(lua_State *L, int index) {
    if (lua_type(L, index) != LUA_TSTRING)
        return false;
    const char *text = lua_tostring(L, index);
    return strlen(text) == lua_rawlen(L, index) && jox_name_is_plain(text);
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

/* Reads `renamed`: old names of states, own values and memory. */
static void read_renamed(JoxBuild *b, int index) {
    lua_State *L = b->script->vm.L;
    JoxMachine *m = b->machine;
    if (jox_read_field(L, index, "renamed") == LUA_TTABLE) {
        lua_pushnil(L);
        while (lua_next(L, -2)) {
            if (lua_type(L, -1) == LUA_TSTRING && lua_type(L, -2) == LUA_TSTRING) {
                JOX_RESERVE(m->renamed, b->renamed_capacity, m->renamed_count + 1);
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

/* Adds the hidden slots for the items of memory that is a list. */
static void add_items(JoxBuild *b, int32_t list) {
    const JoxMemorySlot slot = b->machine->memory[list];
    for (uint32_t k = 0; k < slot.capacity; k++) {
        const char role[] = {*JOX_IDENTITY_ITEM, (char)('a' + k), 0};
        const int32_t item = jox_build_hidden(b, role, slot.name,
                                              slot.kind == JOX_MEMORY_PEOPLE ? JOX_MEMORY_SOMEBODY
                                                                             : JOX_MEMORY_NUMBER);
        if (k == 0)
            b->machine->memory[list].items = (uint32_t)item;
    }
}

/* Builds the machine of the value on top of the stack; may raise errors of the VM. */
static void build_machine(JoxBuild *build) {
    JoxScript *script = build->script;
    const JoxSource *source = build->source;
    lua_State *L = script->vm.L;
    JoxNode *node = jox_node_get(L, -1);
    jox_misuse_find(build);
    jox_list_copies_find(build);
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
        m->memory[slot].capacity = script->memory[i].capacity;
    }
    for (uint32_t i = 0; i < script->memory_count; i++)
        add_items(build, (int32_t)i);
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
    jox_read_parameter_values(build);
    jox_nest_collect(build, node);
    jox_nest_read(build);
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
    jox_nest_free(&build);
}
