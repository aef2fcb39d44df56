/* Reads `defaults` of a machine, or of one that a state runs: parameters for all of its states,
   most of which are own values. Called by build.c and nest.c. */
#include <stdio.h>

#include "base/assert.h"
#include "lua/read_table.h"

/* Gives every parameter an own value of its name, so that a group of the scene can set it; rare
   ones get it when a group does (jox_machine_own_parameter). */
void jox_read_parameter_values(JoxBuild *b) {
    JOX_ASSERT(b->machine->own_count == 0);
    for (int p = 0; p < JOX_PARAM_COUNT; p++) {
        const JoxParameterInfo *info = &jox_parameters[p];
        if (p >= JOX_FIRST_RARE_PARAM) {
            b->machine->defaults[p] = (JoxValue){JOX_VALUE_CONST, info->value, 0, 0, 0};
            continue;
        }
        int32_t slot = jox_build_own(b, info->name);
        b->machine->own[slot].dist = jox_dist_constant(info->value);
        b->machine->defaults[p] = (JoxValue){JOX_VALUE_OWN, 0.0, slot, 0, 0};
    }
}

/* Stores a default of the behaviour's own machine. */
static void store_default(JoxBuild *b, int p, JoxValue value, const JoxDist *dist) {
    b->machine->defaults[p].line = value.line;
    b->machine->defaults[p].source = value.source;
    if (p >= JOX_FIRST_RARE_PARAM) {
        b->machine->defaults[p] = value;
        if (dist) {
            const int32_t slot = jox_build_own(b, jox_parameters[p].name);
            b->machine->own[slot].dist = *dist;
            b->machine->own[slot].declared = true;
            b->machine->defaults[p] =
                (JoxValue){JOX_VALUE_OWN, 0.0, slot, value.line, value.source};
        }
        return;
    }
    if (dist)
        b->machine->own[p].dist = *dist;
    else if (value.kind == JOX_VALUE_CONST)
        b->machine->own[p].dist = jox_dist_constant(value.number);
    else if (value.kind != JOX_VALUE_UNSET)
        b->machine->defaults[p] = value;
}

/* Stores a default of a machine that a state runs. What is drawn is an own value of that state. */
static void store_nested_default(JoxBuild *b, JoxNested *nested, int p, JoxValue value,
                                 const JoxDist *dist) {
    if (dist || (value.kind == JOX_VALUE_CONST && p < JOX_FIRST_RARE_PARAM)) {
        value.index = nested->defaults[p].index;
        b->machine->own[value.index].dist = dist ? *dist : jox_dist_constant(value.number);
        value.kind = JOX_VALUE_OWN;
    }
    nested->defaults[p] = value;
}

/* Adds the own values of the defaults that a machine that a state runs draws, before they are read,
   as one may refer to another. */
static void add_nested_values(JoxBuild *b, int table, JoxNested *nested) {
    lua_State *L = b->script->vm.L;
    for (int p = 0; p < JOX_PARAM_COUNT; p++) {
        const int type = jox_read_field(L, table, jox_parameters[p].name);
        const JoxNode *node = jox_node_get(L, -1);
        lua_pop(L, 1);
        const bool drawn = node && node->kind == JOX_NODE_DIST, rare = p >= JOX_FIRST_RARE_PARAM;
        if (nested->is_set[p] || !(drawn || (type == LUA_TNUMBER && !rare)))
            continue;
        char name[256];
        snprintf(name, sizeof name, "%.120s.%.60s", b->machine->outer[nested->outer].name,
                 jox_parameters[p].name);
        const int32_t slot = jox_build_own(b, name);
        b->machine->own[slot].general = rare ? 0 : (uint32_t)p + 1;
        b->machine->own[slot].declared = true; /* no group need set it */
        nested->defaults[p] = (JoxValue){JOX_VALUE_OWN, 0.0, slot, 0, 0};
    }
}

void jox_read_defaults(JoxBuild *b, int index, const char *prefix, uint32_t number) {
    lua_State *L = b->script->vm.L;
    JOX_ASSERT(lua_istable(L, index) && number < b->nested_count);
    JoxNested *nested = &b->nested[number];
    const char *known[JOX_PARAM_COUNT];
    char all[256];
    jox_read_join(all, prefix, "defaults");
    for (int p = 0; p < JOX_PARAM_COUNT; p++)
        known[p] = jox_parameters[p].name;
    if (jox_read_field(L, index, "defaults") == LUA_TTABLE) {
        int table = lua_gettop(L);
        jox_read_check(b, table, all, known, JOX_PARAM_COUNT, false);
        if (number > 0)
            add_nested_values(b, table, nested);
        for (int p = 0; p < JOX_PARAM_COUNT; p++) {
            char path[256];
            bool is_dist;
            JoxDist dist;
            jox_read_join(path, all, known[p]);
            if (jox_read_field(L, table, known[p]) == LUA_TNIL || nested->is_set[p]) {
                lua_pop(L, 1);
                continue;
            }
            JoxValue value = jox_read_value(b, path, &jox_parameters[p], &is_dist, &dist);
            nested->is_set[p] = true;
            if (number == 0)
                store_default(b, p, value, is_dist ? &dist : NULL);
            else
                store_nested_default(b, nested, p, value, is_dist ? &dist : NULL);
        }
    } else if (!lua_isnil(L, -1)) {
        jox_build_error(b, jox_read_at(b, all), "bad-value", NULL, "defaults must be a table");
    }
    lua_pop(L, 1);
}
