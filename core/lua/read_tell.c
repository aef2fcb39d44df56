/* Reads `tell` of a state or transition: a message, its receiver and what it carries. Called by
   actions.c. */
#include <string.h>

#include "base/mem.h"
#include "lua/read_table.h"

/* Reads the receiver of a message, the first item of the table at `table`: a target, or
   neighbours(tag) for all those. */
static void read_receiver(JoxBuild *b, int table, const char *path, JoxTell *tell) {
    lua_State *L = b->script->vm.L;
    lua_rawgeti(L, table, 1);
    JoxNode *node = jox_node_target(L, jox_node_get(L, -1));
    tell->all = node && node->kind == JOX_NODE_NUMBER && node->op == JOX_OP_NEIGHBOURS;
    if (tell->all)
        node = node->target;
    if (node && node->kind == JOX_NODE_TARGET && jox_target_kind_moves(node->target_kind))
        tell->to = jox_build_target(b, node);
    else if (!node || node->kind != JOX_NODE_ERROR)
        jox_build_error(b, jox_read_at(b, path), "bad-value",
                        "Example: tell = { nearest \"people\", \"shot\", damage = 2 }",
                        "tell needs whom it tells as its first item: a target that is a person, or "
                        "neighbours(tag)");
    lua_pop(L, 1);
}

/* Returns the key of the table at `table` that comes first after `last` by name; NULL: none. */
static const char *find_next_key(lua_State *L, int table, const char *last) {
    const char *next = NULL;
    lua_pushnil(L);
    while (lua_next(L, table)) {
        lua_pop(L, 1);
        const char *key = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : NULL;
        if (key && (!last || strcmp(key, last) > 0) && (!next || strcmp(key, next) < 0))
            next = key;
    }
    return next;
}

/* Reads a value that a message carries, under a key of the table at `table`. */
static void read_carried(JoxBuild *b, int table, const char *path, const char *key,
                         struct JoxCarried *carried) {
    static const JoxParameterInfo ANY = {"this", "", "", -1e12, 1e12, 0};
    lua_State *L = b->script->vm.L;
    char full[256];
    bool is_dist = false;
    JoxDist dist;
    jox_read_join(full, path, key);
    *carried = (struct JoxCarried){
        .name = jox_build_name_at(b, key, JOX_NAME_CARRIED, jox_read_at(b, full)), .target = -1};
    const int type = jox_read_field(L, table, key);
    const JoxNode *node = jox_node_get(L, -1);
    if (type == LUA_TSTRING || (node && node->kind == JOX_NODE_TARGET)) {
        lua_pop(L, 1);
        carried->target = jox_read_target(b, table, full, key);
        return;
    }
    if (type == LUA_TBOOLEAN) {
        carried->value = (JoxValue){JOX_VALUE_CONST, lua_toboolean(L, -1), 0, 0, 0};
        lua_pop(L, 1);
        return;
    }
    if (node && node->kind == JOX_NODE_CONDITION) { /* 1 while it holds */
        carried->value = (JoxValue){JOX_VALUE_EXPRESSION, 0.0,
                                    jox_build_expression(b, node, jox_read_at(b, full)), 0, 0};
        if (carried->value.index < 0)
            carried->value.kind = JOX_VALUE_UNSET;
        lua_pop(L, 1);
        return;
    }
    if (node && node->kind == JOX_NODE_LIST) {
        jox_build_error(b, jox_read_at(b, full), "bad-value",
                        "Tell its .first, .last or .size, or one message for each item",
                        "a message carries numbers, conditions and targets, not a list");
        lua_pop(L, 1);
        return;
    }
    carried->value = jox_read_value(b, full, &ANY, &is_dist, &dist);
    if (is_dist)
        jox_build_error(b, jox_read_at(b, full), "bad-value", "Use an own value for what is drawn",
                        "a message carries numbers, conditions and targets");
}

void jox_read_tell(JoxBuild *b, int index, const char *path, JoxActions *actions) {
    static const char EXAMPLE[] = "Example: tell = { nearest \"people\", \"shot\", damage = 2 }";
    lua_State *L = b->script->vm.L;
    char full[256];
    jox_read_join(full, path, "tell");
    const int type = jox_read_field(L, index, "tell"), table = lua_gettop(L);
    if (type == LUA_TTABLE) {
        const size_t errors = b->script->diagnostics->errors;
        JoxTell tell = {.to = -1, .name = -1};
        read_receiver(b, table, full, &tell);
        if (lua_rawgeti(L, table, 2) == LUA_TSTRING && lua_rawlen(L, -1) > 0 &&
            lua_rawlen(L, -1) <= 60)
            tell.name =
                jox_build_name_at(b, lua_tostring(L, -1), JOX_NAME_SENT, jox_read_at(b, full));
        else
            jox_build_error(
                b, jox_read_at(b, full), "bad-value", EXAMPLE,
                "tell needs the name of the message as its second item, of 1 to 60 bytes");
        lua_pop(L, 1);
        for (const char *key = NULL; (key = find_next_key(L, table, key));) {
            if (strcmp(key, "sender") == 0) {
                jox_build_error(b, jox_read_at(b, full), "bad-key", "Give the value another name",
                                "`sender` is who told the message");
                break;
            }
            if (tell.count == JOX_MOST_CARRIED || strlen(key) > 60 || !*key) {
                jox_build_error(b, jox_read_at(b, full), "too-many", NULL,
                                "a message carries at most %d values, with names of 1 to 60 "
                                "bytes",
                                JOX_MOST_CARRIED);
                break;
            }
            read_carried(b, table, full, key, &tell.carries[tell.count++]);
        }
        if (tell.to >= 0 && b->script->diagnostics->errors == errors) {
            actions->tell = jox_alloc(1, sizeof *actions->tell);
            *actions->tell = tell;
        }
    } else if (type != LUA_TNIL) {
        jox_build_error(b, jox_read_at(b, full), "bad-value", EXAMPLE, "tell must be a table");
    }
    lua_settop(L, table - 1);
}
