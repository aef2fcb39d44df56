/* The owner of all scripts of a run, and the names of the scene that a behaviour may use. */
#ifndef JOX_LUA_LANGUAGE_SCOPE_H
#define JOX_LUA_LANGUAGE_SCOPE_H

#include "base/format/mod.h"
#include "geom/place.h"
#include "geom/walls.h"
#include "jostle.h"
#include "lua/vm/script_limits.h"

/* All scripts of a run with their limits (NULL: the defaults), which are copied. Freeing it frees
   the scripts and so the functions of all machines, but not the machines. */
typedef struct JoxLua JoxLua;
JoxLua *jox_lua_create(const JoxLuaLimits *limits);
void jox_lua_free(JoxLua *lua);

/* Checks words of the program: names, texts, functions. False with a sentence in `why`. */
bool jox_program_words_check(const JoWord *words, size_t count, JoxText *why);
/* Sets the words of the program that scripts may use, before any is loaded; the caller owns
   them. */
void jox_lua_set_words(JoxLua *lua, const JoWord *words, uint32_t count);

enum { JOX_ACT_NUMBERS = 4 };
/* An action of the program that an agent has called for in this step. */
typedef struct JoxAct {
    uint32_t word, agent_id, count;
    double numbers[JOX_ACT_NUMBERS];
} JoxAct;
/* Returns the actions of this step, in the order of the calls; valid until a function runs. */
const JoxAct *jox_lua_acts(const JoxLua *lua, uint32_t *count);
void jox_lua_forget_acts(JoxLua *lua);

/* Names of the scene that a behaviour may use; the caller owns them while a behaviour loads. If not
   `complete`, as in a check without a scene, any name is accepted and places have index -1. */
typedef struct JoxScopeGroup {
    const char *name, *team; /* team: NULL: none; team number is 1 + that of its first group */
} JoxScopeGroup;

typedef struct JoxScope {
    const JoxPlace *places;
    uint32_t place_count;
    uint32_t car_count;      /* places, the first ones, that are floors of lifts' cars */
    const char *const *tags; /* the index is the tag's bit */
    uint32_t tag_count;
    const JoxScopeGroup *groups; /* the index is the group's number */
    uint32_t group_count;
    const char *const *set_teams; /* teams that states set and no group has, by number */
    uint32_t set_team_count;
    const JoxWalls *walls; /* named walls are gates */
    bool complete;
    const JoxMod *mods; /* in order of loading; their patches are applied to the behaviour */
    uint32_t mod_count;
} JoxScope;

#endif
