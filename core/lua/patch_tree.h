/* Lua tables as trees for base/patch.h. */
#ifndef JOX_LUA_PATCH_TREE_H
#define JOX_LUA_PATCH_TREE_H

#include "base/format/patch.h"
#include "lua/language/script.h"

/* Values of Lua as nodes: a node is the number of a value in a list on the stack. */
typedef struct JoxLuaNodes {
    JoxScript *script;
    lua_State *L;
    int list; /* stack index */
    lua_Integer count;
    uint32_t source; /* number of the patch's file */
    int table;       /* stack index of the machine's table that is changed */
} JoxLuaNodes;

/* Pushes a node's value; its stack index. */
int jox_nodes_push_value(JoxLuaNodes *nodes, void *node);
/* The node of the value on top of the stack, popped; NULL of nil. */
void *jox_nodes_pop_value(JoxLuaNodes *nodes);
/* The operations; the context, a JoxLuaNodes, is to be set. Raises errors: within jox_vm_call. */
extern const JoxPatchTree jox_lua_tree;

#endif
