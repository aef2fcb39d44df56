/* Lets mods change a behaviour's table before it is read: runs their files and merges the tables
   that they return, or replaces the behaviour's. Called by the loader; base/format/patch.h does the
   merging. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/format/path.h"
#include "base/mem.h"
#include "lua/loader.h"
#include "lua/patch_tree.h"
#include "lua/read_table.h"

bool jox_lua_patch_target(const char *text, size_t length, char target[128], bool *replaces,
                          int *line, int *column) {
    JoxSource source = {.text = jox_strndup(text, length), .length = length};
    bool found = false;
    jox_source_scan(&source);
    for (size_t i = 0; i + 1 < source.token_count && !found; i++) {
        const JoxToken *t = &source.tokens[i];
        bool patch = jox_token_is(t, "patch"), replace = jox_token_is(t, "replace");
        size_t at = i + 1 + jox_token_is(t + 1, "(");
        if ((!patch && !replace) || at >= source.token_count ||
            source.tokens[at].kind != JOX_TOKEN_STRING)
            continue;
        snprintf(target, 128, "%.*s", (int)source.tokens[at].length, source.tokens[at].text);
        *replaces = replace;
        *line = source.tokens[at].line;
        *column = source.tokens[at].column;
        found = true;
    }
    jox_source_free(&source);
    return found;
}

/* Returns whether a patch is for the machine whose table is at `index`: by the machine's name,
   unless it comes from a mod, or by the name of its file. */
static bool is_patch_target(JoxScript *script, int index, const char *target) {
    lua_State *L = script->vm.L;
    const JoxScope *scope = script->scope;
    const char *path = script->vm.sources[0]->path;
    bool named =
        jox_read_field(L, index, "name") == LUA_TSTRING && !strcmp(lua_tostring(L, -1), target);
    lua_pop(L, 1);
    for (uint32_t m = 0; m < scope->mod_count; m++)
        named = named && !jox_path_below(path, scope->mods[m].folder);
    return named || jox_patch_is_target(target, path, scope->mods, scope->mod_count);
}

/* Runs a file of a mod and leaves its patch on the stack; NULL with diagnostics. */
static JoxNode *run_mod_file(JoxScript *script, int32_t mod, const JoxModPatch *patch,
                             uint32_t *number) {
    lua_State *L = script->vm.L;
    *number = (uint32_t)script->vm.source_count;
    jox_vm_note_path(&script->vm, patch->path);
    if (!jox_script_read(script, patch->path, NULL, 0, (JoxPosition){0}))
        return NULL;
    script->mod = &script->scope->mods[mod];
    if (!jox_vm_compile(&script->vm, *number))
        lua_error(L);
    lua_call(L, 0, 1);
    script->mod = NULL;
    JoxNode *node = jox_node_get(L, -1);
    if (node && (node->kind == JOX_NODE_PATCH || node->kind == JOX_NODE_REPLACE))
        return node;
    if (!node || node->kind != JOX_NODE_ERROR)
        jox_diag_error(script->diagnostics, ((JoxPosition){patch->path, 0, 0, 0}), "no-patch",
                       "End the file with: return patch \"NAME\" { ... }",
                       "this file must return one patch or replacement");
    return NULL;
}

/* Merges the patch into the machine's table at stack index `table`, or replaces that. */
static void merge_mod_patch(JoxScript *script, int table, const JoxNode *node, uint32_t mod,
                            uint32_t source) {
    lua_State *L = script->vm.L;
    luaL_checkstack(L, 40, "patch");
    lua_newtable(L);
    lua_newtable(L);
    JoxLuaNodes nodes = {script, L, lua_gettop(L) - 1, 0, source, table, lua_gettop(L)};
    JoxPatchTree tree = jox_lua_tree;
    tree.context = &nodes;
    const JoxPatch patch = {&tree,        &script->changes, script->scope->mods,
                            (int32_t)mod, source,           script->diagnostics};
    lua_rawgeti(L, LUA_REGISTRYINDEX, node->hook);
    if (node->kind == JOX_NODE_PATCH)
        jox_nodes_expand_states(&nodes);
    void *change = jox_nodes_pop_value(&nodes);
    if (node->kind == JOX_NODE_REPLACE) {
        jox_patch_replaces(&patch, change);
        jox_nodes_push_value(&nodes, change);
    } else {
        lua_pushvalue(L, table);
        void *base = jox_nodes_pop_value(&nodes);
        jox_nodes_push_value(&nodes, jox_patch_apply(&patch, base, change));
    }
    lua_replace(L, table);
    lua_settop(L, table);
}

bool jox_patch_behaviour(JoxScript *script) {
    lua_State *L = script->vm.L;
    JoxNode *machine = jox_node_get(L, -1);
    const JoxScope *scope = script->scope;
    if (!machine || machine->kind != JOX_NODE_MACHINE || scope->mod_count == 0)
        return true;
    const size_t errors = script->diagnostics->errors;
    const int top = lua_gettop(L), table = top + 1;
    lua_rawgeti(L, LUA_REGISTRYINDEX, machine->hook);
    for (uint32_t m = 0; m < scope->mod_count; m++)
        for (uint32_t f = 0; f < scope->mods[m].patch_count; f++) {
            const JoxModPatch *file = &scope->mods[m].patches[f];
            uint32_t source;
            if (!file->lua || !file->target || !is_patch_target(script, table, file->target))
                continue;
            const JoxNode *node = run_mod_file(script, (int32_t)m, file, &source);
            if (node)
                merge_mod_patch(script, table, node, m, source);
            lua_settop(L, table);
        }
    lua_rawseti(L, LUA_REGISTRYINDEX, machine->hook);
    JOX_ASSERT(lua_gettop(L) == top);
    return script->diagnostics->errors == errors;
}
