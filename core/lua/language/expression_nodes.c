/* Nodes: expressions of the language as Lua sees them, a userdata of one type that points to a
   JoxNode. The script owns the nodes. */

#include "base/assert.h"
#include "base/mem.h"
#include "lua/language/script.h"

static const char TYPE[] = "jostle value";

JoxNode *jox_node_push(lua_State *L, JoxNodeKind kind) {
    JOX_ASSERT(kind >= JOX_NODE_NUMBER && kind <= JOX_NODE_ERROR);
    JoxScript *script = jox_script_of(L);
    if (script->vm.running && !script->vm.loading)
        luaL_error(L, "values of the language are made while the file loads, not in functions");
    jox_vm_charge(L, 8);
    script->node_bytes += sizeof(JoxNode);
    if (script->node_bytes > script->owner->group.limits.memory)
        luaL_error(L, "it makes too many expressions");
    JoxNode **slot = lua_newuserdatauv(L, sizeof *slot, 0);
    luaL_setmetatable(L, TYPE);
    JoxNode *node = jox_alloc(1, sizeof *node);
    node->kind = kind;
    node->hook = LUA_NOREF;
    if (kind == JOX_NODE_STEER)
        node->term.target = node->term.hook = -1;
    JOX_RESERVE(script->nodes, script->node_capacity, script->node_count + 1);
    script->nodes[script->node_count++] = node;
    lua_Debug debug;
    if (lua_getstack(L, 1, &debug) && lua_getinfo(L, "l", &debug))
        node->position = (JoxPosition){script->vm.source_count ? script->vm.sources[0]->path : NULL,
                                       debug.currentline, 0, 0};
    return *slot = node;
}

JoxNode *jox_node_get(lua_State *L, int index) {
    JoxNode **slot = luaL_testudata(L, index, TYPE);
    return slot ? *slot : NULL;
}

void jox_node_repush(lua_State *L, JoxNode *node) {
    JOX_ASSERT(node && node->kind != 0);
    JoxNode **slot = lua_newuserdatauv(L, sizeof *slot, 0);
    luaL_setmetatable(L, TYPE);
    *slot = node;
}

JoxNode *jox_node_constant(lua_State *L, double value) {
    JoxNode *node = jox_node_push(L, JOX_NODE_NUMBER);
    node->op = JOX_OP_CONST;
    node->number = value;
    lua_pop(L, 1); /* the script keeps it */
    return node;
}

JoxNode *jox_node_number(lua_State *L, int index) {
    if (lua_type(L, index) == LUA_TNUMBER)
        return jox_node_constant(L, lua_tonumber(L, index));
    JoxNode *node = jox_node_get(L, index);
    return node && (node->kind == JOX_NODE_NUMBER || node->kind == JOX_NODE_OWN ||
                    node->kind == JOX_NODE_ERROR)
               ? node
               : NULL;
}

JoxNode *jox_node_target(lua_State *L, JoxNode *node) {
    if (!node || node->kind != JOX_NODE_NUMBER || node->op != JOX_OP_MESSAGE)
        return node;
    JoxNode *target = jox_node_push(L, JOX_NODE_TARGET);
    target->target_kind = JOX_TARGET_MESSAGE;
    target->name = node->name;
    target->field = node->field;
    target->written = node->written;
    lua_pop(L, 1); /* the script keeps it */
    return target;
}

bool jox_node_is_error(lua_State *L, int index) {
    JoxNode *node = jox_node_get(L, index);
    return node && node->kind == JOX_NODE_ERROR;
}

int jox_node_push_error(lua_State *L) {
    jox_node_push(L, JOX_NODE_ERROR);
    return 1;
}

const char *jox_node_kind(lua_State *L, int index) {
    static const char *const NAMES[] = {[JOX_NODE_NUMBER] = "a number",
                                        [JOX_NODE_CONDITION] = "a condition",
                                        [JOX_NODE_TARGET] = "a target",
                                        [JOX_NODE_OWN] = "an own value",
                                        [JOX_NODE_STEER] = "a steering",
                                        [JOX_NODE_DIST] = "a distribution",
                                        [JOX_NODE_CIRCUITS] = "circuits",
                                        [JOX_NODE_LIST] = "a list",
                                        [JOX_NODE_MACHINE] = "a machine",
                                        [JOX_NODE_PATCH] = "a patch",
                                        [JOX_NODE_REPLACE] = "a replacement",
                                        [JOX_NODE_NONE] = "`none`",
                                        [JOX_NODE_LAYER] = "an extended function",
                                        [JOX_NODE_WAIT] = "`wait`",
                                        [JOX_NODE_BACK] = "`back`",
                                        [JOX_NODE_ERROR] = "an error"};
    static_assert(sizeof NAMES / sizeof *NAMES == JOX_NODE_ERROR + 1, "every kind has a name");
    JoxNode *node = jox_node_get(L, index);
    return node ? NAMES[node->kind] : luaL_typename(L, index);
}

void jox_nodes_open(lua_State *L, const luaL_Reg *operators) {
    luaL_newmetatable(L, TYPE);
    luaL_setfuncs(L, operators, 0);
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_pushliteral(L, "value"); /* as type() names it */
    lua_setfield(L, -2, "__kind");
    lua_pop(L, 1);
}

JoxNode *jox_node_push_operation(lua_State *L, JoxNodeKind kind, int op, JoxNode *a, JoxNode *b) {
    JOX_ASSERT(a && (kind == JOX_NODE_NUMBER || kind == JOX_NODE_CONDITION));
    JoxNode *node = jox_node_push(L, kind);
    node->op = op;
    node->a = a;
    node->b = b;
    return node;
}
