/* Tags and teams that a script names. The scene need not have them, as a state may give them to its
   agents; whether any state does is checked once all machines are loaded. */
#include <string.h>

#include "base/mem.h"
#include "lua/language/script.h"

/* Returns the number of a team that the scene has, or -1. */
static int32_t find_team(const JoxScope *scope, const char *name) {
    for (uint32_t g = 0; g < scope->group_count; g++)
        if (scope->groups[g].team && strcmp(scope->groups[g].team, name) == 0)
            return (int32_t)g + 1; /* the first group of a team gives its number */
    for (uint32_t t = 0; t < scope->set_team_count; t++)
        if (strcmp(scope->set_teams[t], name) == 0)
            return JOX_FIRST_SET_TEAM + (int32_t)t;
    return -1;
}

/* Returns the bit of a tag that the scene has, or -1. */
static int32_t find_tag(const JoxScope *scope, const char *name) {
    for (uint32_t t = 0; t < scope->tag_count; t++)
        if (strcmp(scope->tags[t], name) == 0)
            return (int32_t)t;
    return -1;
}

/* Returns the first number that neither the scene nor the script uses; -1: there is none. */
static int32_t next_number(const JoxScript *script, bool is_team) {
    const JoxScope *scope = script->scope;
    int32_t next =
        is_team ? JOX_FIRST_SET_TEAM + (int32_t)scope->set_team_count : (int32_t)scope->tag_count;
    for (uint32_t n = 0; n < script->belonging_count; n++)
        if (script->belongings[n].is_team == is_team && script->belongings[n].number >= next)
            next = script->belongings[n].number + 1;
    return next < (is_team ? JOX_FIRST_SET_TEAM + JOX_MOST_SET_TEAMS : 64) ? next : -1;
}

int32_t jox_script_tag_or_team(JoxScript *script, const char *name, bool is_team, bool is_set,
                               JoxPosition at) {
    JoxBelonging *known = NULL;
    if (!script->scope->complete)
        return is_team ? find_team(script->scope, name) : find_tag(script->scope, name);
    for (uint32_t n = 0; n < script->belonging_count && !known; n++)
        if (script->belongings[n].is_team == is_team &&
            strcmp(script->belongings[n].name, name) == 0)
            known = &script->belongings[n];
    if (!known) {
        int32_t number = is_team ? find_team(script->scope, name) : find_tag(script->scope, name);
        if (number < 0)
            number = next_number(script, is_team);
        if (number < 0)
            return -1;
        JOX_RESERVE(script->belongings, script->belonging_capacity, script->belonging_count + 1);
        known = &script->belongings[script->belonging_count++];
        *known = (JoxBelonging){.name = jox_strdup(name),
                                .is_team = is_team,
                                .number = (uint16_t)number,
                                .line = at.line,
                                .column = at.column,
                                .end_column = at.end_column};
        for (uint32_t s = 0; s < script->vm.source_count; s++)
            if (at.file && strcmp(script->vm.sources[s]->path, at.file) == 0)
                known->source = s;
    }
    known->is_set |= is_set;
    known->is_asked |= !is_set;
    return known->number;
}
