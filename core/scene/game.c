/* Reads the game of a scene: its rules, and its levels, whose values replace those that groups
   set. */
#include <math.h>
#include <string.h>

#include "scene/scene_draft.h"

enum { MOST_NAMES = 64 }; /* names that a misspelt one is compared with */

void jox_key_read_tally(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    const JoxSceneSpec *s = r->draft->scene;
    const char *names[MOST_NAMES];
    const uint32_t count = s->tally_count < MOST_NAMES ? s->tally_count : MOST_NAMES;
    int32_t *index = JOX_MEMBER(int32_t, item, key->offset);
    *index = -1;
    if (!jox_key_read_scalar(r, key, node, "name"))
        return;
    for (uint32_t t = 0; t < s->tally_count; t++)
        if (strcmp(s->tallies[t].name, node->text) == 0)
            *index = (int32_t)t;
    for (uint32_t t = 0; t < count; t++)
        names[t] = s->tallies[t].name;
    if (*index < 0)
        jox_scene_error(r, node, "unknown-tally",
                        count ? jox_scene_suggest(r, node->text, names, count)
                              : "tally: {red: {memory: hits, group: blue}}",
                        "there is no tally '%.60s'", node->text);
}

bool jox_finish_level(const JoxReader *r, const JoxYaml *map, void *item, bool good) {
    const JoxGameLevel *level = item;
    const JoxYaml *set = jox_yaml_get(map, "set");
    if (good && set && level->group < 0)
        jox_scene_error(r, set, "bad-value", "Add group: NAME",
                        "a level sets values for the agents of a `group`");
    return true;
}

/* Returns the index of the level that is played, or -1 with an error. */
static int32_t find_played_level(const JoxReader *r, const JoxYaml *map, const JoxGame *game) {
    const char *names[MOST_NAMES];
    const JoxYaml *level = jox_yaml_get(map, "level");
    const uint32_t count = game->level_count < MOST_NAMES ? game->level_count : MOST_NAMES;
    if (!level)
        return game->level_count ? 0 : -1;
    for (uint32_t l = 0; game->level && l < game->level_count; l++)
        if (strcmp(game->levels[l].name, game->level) == 0)
            return (int32_t)l;
    for (uint32_t l = 0; l < count; l++)
        names[l] = game->levels[l].name;
    jox_scene_error(r, level, "unknown-level",
                    count ? jox_scene_suggest(r, level->text, names, count)
                          : "levels: {easy: {}, hard: {}}",
                    "there is no level '%.60s'", game->level ? game->level : "");
    return -1;
}

/* Gives a group the values of a level, in place of its own of the same names. */
static void apply_level(const JoxReader *r, const JoxGameLevel *level, JoxGroup *group) {
    JoxGroupValue *sets =
        jox_arena_take(r->arena, group->set_count + level->set_count, sizeof *sets);
    uint32_t count = 0;
    for (uint32_t s = 0; s < group->set_count + level->set_count; s++) {
        const bool own = s < group->set_count;
        const JoxGroupValue *value = own ? &group->set[s] : &level->set[s - group->set_count];
        bool replaced = false;
        for (uint32_t l = 0; own && l < level->set_count; l++)
            replaced |= strcmp(level->set[l].name, value->name) == 0;
        if (!replaced)
            sets[count++] = *value;
    }
    group->set = sets;
    group->set_count = count;
}

bool jox_finish_game(const JoxReader *r, const JoxYaml *map, void *item, bool good) {
    JoxGame *game = item;
    JoxSceneSpec *scene = r->draft->scene;
    if (!good)
        return true;
    if (game->ours == game->theirs)
        jox_scene_error(r, jox_yaml_get(map, "theirs"), "bad-value", NULL,
                        "ours and theirs are two tallies");
    if (!(game->points > 0.0) && !(game->time > 0.0) && game->all < 0)
        jox_scene_error(r, map, "missing-key", "points: 5",
                        "a game needs an end of its rounds: points, time or all");
    if (!jox_yaml_get(r->draft->root, "player"))
        jox_scene_error(r, map, "missing-key", "player: red", "a game needs a `player`");
    game->given = true;
    const int32_t played = find_played_level(r, map, game);
    if (played < 0)
        return true;
    const JoxGameLevel *level = &game->levels[played];
    game->level = level->name;
    if (level->group >= 0)
        apply_level(r, level, &scene->groups[level->group]);
    return true;
}
