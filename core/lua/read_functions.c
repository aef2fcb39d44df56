/* Reads the plain functions of states and transitions, with the functions of mods that extend them.
   Called by read_state.c and read_table.c. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "lua/language/vocabulary.h"
#include "lua/read_table.h"

/* Prints a path for people: "states.Circle.2.on_take" is "state Circle > transition 2 > on_take".
 */
static void print_part_path(const char *path, JoxText *out) {
    char part[128];
    for (int depth = 0; *path; depth++) {
        path += strncmp(path, "runs.states.", 12) == 0 ? 12 : 0; /* a state within a state */
        size_t n = strcspn(path, ".");
        snprintf(part, sizeof part, "%.*s", (int)n, path);
        bool number = part[strspn(part, "0123456789")] == 0;
        if (depth > 0)
            jox_text_printf(out, "%s%s%s", depth > 1 ? " > " : "",
                            depth == 1               ? "state "
                            : number || *part == '@' ? "transition "
                                                     : "",
                            *part == '@' ? part + 1 : part);
        path += n + (path[n] == '.');
    }
}

/* Returns the name of the mod that wrote the value at a path; NULL: the behaviour itself. Functions
   that extend it do not count. */
static const char *find_writing_mod(const JoxScript *script, const char *path) {
    const JoxPatchChanges *changes = &script->changes;
    const char *rest;
    for (uint32_t c = changes->count; c-- > 0;) {
        const JoxPatchChange *change = &changes->items[c];
        if (!change->extends && jox_patch_leads(change, path, &rest))
            return change->mod < 0 ? NULL : script->scope->mods[change->mod].name;
    }
    return NULL;
}

/* Adds a hook for the function on top of the stack, which is popped: that at a path, or a layer of
   a mod that extends it. */
static int32_t add_hook(JoxBuild *b, const char *path, JoxLayer layer, const char *mod) {
    JoxScript *script = b->script;
    JoxText where = {0};
    print_part_path(path, &where);
    if (mod)
        jox_text_printf(&where, " (%s%smod %s)", jox_layer_word(layer), layer ? ", " : "", mod);
    JOX_RESERVE(script->hooks, script->hook_capacity, script->hook_count + 1);
    script->hooks[script->hook_count] = (JoxHook){.ref = luaL_ref(script->vm.L, LUA_REGISTRYINDEX),
                                                  .layer = layer,
                                                  .previous = -1,
                                                  .expression = -1,
                                                  .previous_ref = LUA_NOREF,
                                                  .where = where.data};
    b->machine->hook_count = script->hook_count + 1;
    return (int32_t)script->hook_count++;
}

bool jox_read_is_function(lua_State *L, int index) {
    const JoxNode *node = jox_node_get(L, index);
    return lua_type(L, index) == LUA_TFUNCTION || (node && node->kind == JOX_NODE_LAYER);
}

int32_t jox_read_function(JoxBuild *b, const char *path, int32_t *extends) {
    lua_State *L = b->script->vm.L;
    JOX_ASSERT(jox_read_is_function(L, -1));
    const JoxNode *node = jox_node_get(L, -1);
    *extends = -1;
    if (!node)
        return add_hook(b, path, JOX_LAYER_ALONE, find_writing_mod(b->script, path));
    lua_pop(L, 1);
    luaL_checkstack(L, 10, "functions of mods");
    int32_t previous = -1;
    if (lua_rawgeti(L, LUA_REGISTRYINDEX, node->arg) == LUA_TFUNCTION ||
        jox_read_is_function(L, -1))
        previous = jox_read_function(b, path, extends);
    lua_rawgeti(L, LUA_REGISTRYINDEX, node->hook);
    const int32_t number = add_hook(b, path, (JoxLayer)node->op, node->name);
    JoxHook *hook = &b->script->hooks[number];
    hook->previous = previous;
    if (hook->layer == JOX_LAYER_AROUND)
        hook->previous_ref = jox_hook_make_previous(b->script, number);
    if (previous < 0)
        *extends = number;
    return number;
}
