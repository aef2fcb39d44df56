/* Looks up places, groups and walls by name, and reads names, tags and colours. */
#include <string.h>

#include "base/assert.h"
#include "scene/scene_draft.h"

enum { MOST_NAMES = 512 }; /* names that a misspelt one is compared with */

int32_t jox_scene_find_place(const JoxReader *r, const JoxYaml *name) {
    const char *names[MOST_NAMES];
    const JoxSceneSpec *s = r->draft->scene;
    const uint32_t count = s->place_count < MOST_NAMES ? s->place_count : MOST_NAMES;
    int place = jox_place_find(s->places, s->place_count, name->text);
    JOX_ASSERT(place < (int)s->place_count);
    if (place >= 0 || jox_scene_is_wrong_lift(r, name->text))
        return place;
    for (uint32_t i = 0; i < count; i++)
        names[i] = s->places[i].name;
    jox_scene_error(r, name, "unknown-place", jox_scene_suggest(r, name->text, names, count),
                    "there is no place '%.60s'", name->text);
    return -1;
}

int32_t jox_scene_find_group(const JoxReader *r, const JoxYaml *name) {
    const char *names[MOST_NAMES];
    const JoxSceneSpec *s = r->draft->scene;
    const uint32_t count = s->group_count < MOST_NAMES ? s->group_count : MOST_NAMES;
    for (uint32_t i = 0; i < s->group_count; i++) {
        if (i < MOST_NAMES)
            names[i] = s->groups[i].name;
        if (strcmp(s->groups[i].name, name->text) == 0)
            return (int32_t)i;
    }
    jox_scene_error(r, name, "unknown-group", jox_scene_suggest(r, name->text, names, count),
                    "there is no group '%.60s'", name->text);
    return -1;
}

void jox_scene_check_wall(const JoxReader *r, const JoxYaml *name, bool stairs) {
    const JoxWalls *walls = &r->draft->scene->walls;
    const char *names[MOST_NAMES];
    uint32_t count = 0;
    for (uint32_t i = 0; i < walls->ring_count; i++) {
        if (!walls->rings[i].name)
            continue;
        if (strcmp(walls->rings[i].name, name->text) == 0)
            return;
        if (count < MOST_NAMES)
            names[count++] = walls->rings[i].name;
    }
    const JoxStoreysDraft *storeys = &r->draft->storeys;
    for (uint32_t k = 0; k < storeys->stair_count; k++) {
        if (stairs && strcmp(storeys->stairs[k].stair.name, name->text) == 0)
            return;
        if (stairs && count < MOST_NAMES)
            names[count++] = storeys->stairs[k].stair.name;
    }
    if (r->draft->walls_wrong || jox_scene_is_wrong_lift(r, name->text))
        return;
    jox_scene_error(r, name, "unknown-wall",
                    count ? jox_scene_suggest(r, name->text, names, count)
                          : "Give walls names: {line: [[0, 0], [0, 2]], name: gate}",
                    stairs && storeys->stair_count ? "there is no wall or stair named '%.60s'"
                                                   : "there is no wall named '%.60s'",
                    name->text);
}

void jox_key_read_place(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    const bool named = jox_key_read_scalar(r, key, node, "name");
    *JOX_MEMBER(int32_t, item, key->offset) = named ? jox_scene_find_place(r, node) : -1;
}

void jox_key_read_group(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    const bool named = jox_key_read_scalar(r, key, node, "name");
    *JOX_MEMBER(int32_t, item, key->offset) = named ? jox_scene_find_group(r, node) : -1;
}

void jox_key_read_name(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    const char *name = jox_key_read_scalar(r, key, node, "name");
    if (name && *name)
        jox_scene_check_name(r, node->position, key->name, name);
    *JOX_MEMBER(char *, item, key->offset) = jox_arena_text(r->arena, name);
}

void jox_key_read_tags(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    const JoxYaml *const *names;
    uint32_t count = jox_read_names(r, node, &names);
    char **tags = jox_arena_take(r->arena, count, sizeof *tags);
    for (uint32_t i = 0; i < count; i++) {
        tags[i] = jox_arena_text(r->arena, names[i]->text);
        jox_scene_check_name(r, names[i]->position, "tag", tags[i]);
    }
    *JOX_MEMBER(char **, item, key->offset) = tags;
    *JOX_MEMBER(uint32_t, item, key->count_offset) = count;
}

void jox_key_read_colour(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    const char *text = node && node->kind == JOX_YAML_SCALAR ? node->text : "";
    JoxText hint = {0};
    if (!node || jox_colour_read(text, JOX_MEMBER(JoxColour, item, key->offset)))
        return;
    jox_colour_hint(text, &hint);
    if (*text)
        jox_scene_error(r, node, "bad-value", hint.data, "'%.40s' is no colour", text);
    else /* as in `colour: #f00`, where YAML takes '#' for the beginning of a comment */
        jox_scene_error(r, node, "bad-value", hint.data, "%s needs a name of a colour", key->name);
    jox_text_free(&hint);
}
