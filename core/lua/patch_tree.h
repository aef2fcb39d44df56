/* Lua tables as trees for base/format/patch.h. patch.c is the only caller. */
#ifndef JOX_LUA_PATCH_TREE_H
#define JOX_LUA_PATCH_TREE_H

#include "base/format/patch.h"
#include "lua/language/script.h"

/* Nodes of a tree: each is the index of a Lua value in a list on the stack, which keeps the value
   alive. */
typedef struct JoxLuaNodes {
    JoxScript *script;
    lua_State *L;
    int list; /* stack index of the list */
    lua_Integer count;
    uint32_t source; /* number of the patch's source */
    int table;       /* stack index of the machine's table, which is changed */
    int copies; /* stack index of the set of tables that were copied, of which `runs` is read as
                   the table of the machine there */
} JoxLuaNodes;

/* Pushes the value of a node; returns its stack index. */
int jox_nodes_push_value(JoxLuaNodes *nodes, void *node);
/* Pushes a copy of the table at `index`, with the same items. */
void jox_table_push_copy(lua_State *L, int index);
/* Returns whether the table at `index` is a list and nothing else. */
bool jox_table_is_list(lua_State *L, int index);
/* patch_names.c: writes states of the patch's table, on top of the stack, that it names as
   "Guard.Walk" as parts of what the outer state runs, in a copy that replaces it. */
void jox_nodes_expand_states(JoxLuaNodes *nodes);
/* Makes a node of the value on top of the stack, which is popped; NULL for nil. */
void *jox_nodes_pop_value(JoxLuaNodes *nodes);
/* Operations on Lua tables; set its context to a JoxLuaNodes. They raise errors, so use them within
   jox_vm_call. */
extern const JoxPatchTree jox_lua_tree;

#endif
