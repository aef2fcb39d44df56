/* Reads `own`, own values besides the parameters, and `public`, the memory that others may read, of
   a machine's table. Called by build.c. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "lua/read_table.h"

/* Returns the place that a string names, as a distribution of one value, its index; the value
   -1 if the script is read without a scene. An unknown name is an error.
 */
static JoxDist read_own_place(JoxBuild *b, const char *path) {
    lua_State *L = b->script->vm.L;
    const JoxScope *scope = b->script->scope;
    const char *name = lua_tostring(L, -1);
    const int32_t place =
        scope->places ? jox_place_find(scope->places, scope->place_count, name) : -1;
    if (place < 0 && scope->complete)
        jox_build_error(b, jox_read_at(b, path), "unknown-place", NULL,
                        "the scene has no place '%.60s'", name);
    return jox_dist_constant(place);
}

/* Reads the own value on top of the stack into *dist; pops it. */
static void read_own_dist(JoxBuild *b, const char *path, JoxDist *dist) {
    static const JoxParameterInfo ANY = {"an own value", "", "", -1e12, 1e12, 0};
    lua_State *L = b->script->vm.L;
    if (lua_type(L, -1) == LUA_TSTRING || lua_type(L, -1) == LUA_TBOOLEAN) {
        *dist = lua_type(L, -1) == LUA_TSTRING ? read_own_place(b, path)
                                               : jox_dist_constant(lua_toboolean(L, -1));
        lua_pop(L, 1);
        return;
    }
    bool is_dist;
    const JoxValue value = jox_read_value(b, path, &ANY, &is_dist, dist);
    if (!is_dist && value.kind == JOX_VALUE_CONST)
        *dist = jox_dist_constant(value.number);
    else if (!is_dist && value.kind != JOX_VALUE_UNSET)
        jox_build_error(b, jox_read_at(b, path), "bad-value",
                        "What changes belongs in memory, or into the expression itself",
                        "an own value is drawn once: a number, a distribution or a place");
}

/* Returns whether the machine that is read is `nest`, or runs within it. */
static bool is_within(const JoxBuild *b, uint32_t nest) {
    uint32_t n = b->nest;
    while (n != nest && n != 0)
        n = b->nested[n].parent;
    return n == nest;
}

/* Warns of an own value that another machine, not around this one, declares otherwise. */
static void compare_declared(JoxBuild *b, const char *path, const JoxOwnSlot *own, bool is_place,
                             const JoxDist *dist) {
    char first[256], all[256], text[256];
    if (is_within(b, own->nest) || (is_place == own->is_place && jox_dist_same(dist, &own->dist)))
        return;
    jox_read_join(all, b->nested[own->nest].path, "own");
    jox_read_join(first, all, own->name);
    const JoxPosition was = jox_read_at(b, first), at = jox_read_at(b, path);
    snprintf(text, sizeof text,
             "own.%.60s is declared otherwise at %.100s:%d:%d, by a machine of another state, and "
             "that holds",
             own->name, was.file ? was.file : "", was.line, was.column);
    if (!jox_diag_lists(b->script->diagnostics, at, "doubled-own", text))
        jox_diag_warn(b->script->diagnostics, at, "doubled-own",
                      "Give one of them another name, or declare it in the machine around both",
                      "%s", text);
}

/* Reads the own value on top of the stack; pops it. */
static void read_own_value(JoxBuild *b, const char *path, const char *name) {
    lua_State *L = b->script->vm.L;
    const int32_t slot = jox_build_own(b, name);
    const bool is_place = lua_type(L, -1) == LUA_TSTRING;
    JoxDist dist = jox_dist_constant(0.0);
    read_own_dist(b, path, &dist);
    JoxOwnSlot *own = &b->machine->own[slot];
    if (own->declared) { /* by a machine before this one, or around it */
        compare_declared(b, path, own, is_place, &dist);
        return;
    }
    own->declared = true;
    own->nest = b->nest;
    own->is_place |= is_place;
    own->dist = dist;
}

/* Writes the names in a table to `names`, ascending, as tables have no order; returns how many. */
enum { MOST_NAMES = 64 };
static uint32_t list_sorted_names(JoxBuild *b, int table, const char *path, const char **names) {
    lua_State *L = b->script->vm.L;
    uint32_t count = 0;
    lua_pushnil(L);
    while (lua_next(L, table)) {
        lua_pop(L, 1);
        const char *name = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : NULL;
        if (!name || !*name || strlen(name) > 60 || count == MOST_NAMES) {
            jox_build_error(b, jox_read_at(b, path), "bad-key", "own = { courage = uniform(0, 1) }",
                            "own maps up to %d names to values", MOST_NAMES);
            continue;
        }
        uint32_t at = count++;
        for (; at > 0 && strcmp(names[at - 1], name) > 0; at--)
            names[at] = names[at - 1];
        names[at] = name;
    }
    return count;
}

void jox_read_own(JoxBuild *b, int index, const char *prefix) {
    lua_State *L = b->script->vm.L;
    JOX_ASSERT(lua_istable(L, index));
    char all[256];
    jox_read_join(all, prefix, "own");
    const int type = jox_read_field(L, index, "own"), table = lua_gettop(L);
    const char *names[MOST_NAMES];
    uint32_t count = 0;
    if (type == LUA_TTABLE)
        count = list_sorted_names(b, table, all, names);
    else if (type != LUA_TNIL)
        jox_build_error(b, jox_read_at(b, all), "bad-value", "own = { courage = uniform(0, 1) }",
                        "own must be a table");
    for (uint32_t n = 0; n < count; n++) {
        char path[256];
        jox_read_join(path, all, names[n]);
        if (jox_parameter_find(names[n]) >= 0) {
            jox_build_error(b, jox_read_at(b, path), "bad-key", "Put it into `defaults`",
                            "'%s' is a parameter, which every agent has", names[n]);
            continue;
        }
        jox_read_field(L, table, names[n]);
        read_own_value(b, path, names[n]);
    }
    lua_settop(L, table - 1);
}

/* Makes the memory public whose name is on top of the stack; pops the name. */
static void make_memory_public(JoxBuild *b, const char *path) {
    lua_State *L = b->script->vm.L;
    JoxMachine *m = b->machine;
    const char *name = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : NULL, *names[64];
    const int32_t slot = name ? jox_read_memory(b, name) : -1;
    size_t count = 0;
    char hint[JOX_HINT];
    for (uint32_t s = 0; s < b->script->memory_count && count < 64; s++)
        names[count++] = b->script->memory[s].name;
    if (slot >= 0)
        m->memory[slot].is_public = true;
    else
        jox_build_error(b, jox_read_at(b, path), "unknown-memory",
                        name ? jox_did_you_mean(name, names, count, hint) : NULL,
                        name ? "memory has no '%.60s' to make public" : "public lists names%s",
                        name ? name : "");
    if (slot >= 0 && m->memory[slot].kind >= JOX_MEMORY_SOMEBODY)
        jox_build_error(b, jox_read_at(b, "public"), "bad-value", "Tell it, by `tell`",
                        "'%.60s' is %s: public memory is a number, or true or false", name,
                        m->memory[slot].kind == JOX_MEMORY_SOMEBODY ? "somebody" : "a list");
    for (uint32_t c = 0; slot >= 0 && c < m->counter_count; c++)
        if (m->counters[c].value == slot)
            jox_build_error(
                b, jox_read_at(b, path), "bad-value", "Copy it with `set` where it changes",
                "'%.60s' counts by itself while others look: it cannot be public", name);
    lua_pop(L, 1);
}

void jox_read_public(JoxBuild *b, int index, const char *prefix) {
    lua_State *L = b->script->vm.L;
    char path[256];
    jox_read_join(path, prefix, "public");
    const int type = jox_read_field(L, index, "public"), table = lua_gettop(L);
    if (type == LUA_TSTRING) {
        lua_pushvalue(L, table);
        make_memory_public(b, path);
    } else if (type == LUA_TTABLE) {
        for (lua_Integer n = 1; lua_rawgeti(L, table, n) != LUA_TNIL && n <= MOST_NAMES; n++)
            make_memory_public(b, path);
    } else if (type != LUA_TNIL) {
        jox_build_error(b, jox_read_at(b, path), "bad-value", "public = { \"infected\" }",
                        "public lists names of memory");
    }
    lua_settop(L, table - 1);
}
