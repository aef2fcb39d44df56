/* The owner of all behaviours, and what a behaviour may name of the scene that it is loaded for. */
#ifndef JOX_LUA_LANGUAGE_SCOPE_H
#define JOX_LUA_LANGUAGE_SCOPE_H

#include "base/format/mod.h"
#include "geom/place.h"
#include "geom/walls.h"
#include "lua/vm/limits.h"

/* All behaviours of a run, and the limits they work within (NULL: the defaults). */
typedef struct JoxLua JoxLua;
JoxLua *jox_lua_create(const JoxLuaLimits *limits);
void jox_lua_free(JoxLua *lua);

/* Names that a behaviour may use. Not complete: any name is accepted (checking a behaviour without
   a scene); places then stay unresolved, with index -1. */
typedef struct JoxScopeGroup {
    const char *name, *team; /* team: NULL none; the first group of a team gives its number */
} JoxScopeGroup;

typedef struct JoxScope {
    const JoxPlace *places;
    uint32_t place_count;
    const char *const *tags; /* the index is the bit */
    uint32_t tag_count;
    const JoxScopeGroup *groups; /* the index is the group's number */
    uint32_t group_count;
    const char *const
        *set_teams; /* that no group has, and states set, in the order of their numbers */
    uint32_t set_team_count;
    const JoxWalls *walls; /* those with names are gates */
    bool complete;
    const JoxMod *mods; /* in order; their patches of a behaviour are applied to it */
    uint32_t mod_count;
} JoxScope;

#endif
