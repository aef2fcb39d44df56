/* Names in a scene: of places and groups, which must be there, and of what is new. */
#include <string.h>

#include "base/assert.h"
#include "scene/internal.h"

enum { MOST_NAMES = 512 }; /* that a misspelt one is compared with */

int32_t jox_load_place(const JoxReader *r, const JoxYaml *name) {
    const char *names[MOST_NAMES];
    const JoxSceneSpec *s = r->load->scene;
    const uint32_t count = s->place_count < MOST_NAMES ? s->place_count : MOST_NAMES;
    int place = jox_place_find(s->places, s->place_count, name->text);
    JOX_ASSERT(place < (int)s->place_count);
    if (place >= 0)
        return place;
    for (uint32_t i = 0; i < count; i++)
        names[i] = s->places[i].name;
    jox_scene_error(r, name, "unknown-place", jox_scene_suggest(r, name->text, names, count),
                    "there is no place '%.60s'", name->text);
    return -1;
}

int32_t jox_load_group(const JoxReader *r, const JoxYaml *name) {
    const char *names[MOST_NAMES];
    const JoxSceneSpec *s = r->load->scene;
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

/* The node if it is a name; else NULL, with an error where it is something else. */
static const JoxYaml *name_of(const JoxReader *r, const JoxKey *key, const JoxYaml *node) {
    if (node && node->kind != JOX_YAML_SCALAR)
        jox_scene_error(r, node, "bad-type", NULL, "%s must be a name", key->name);
    return node && node->kind == JOX_YAML_SCALAR ? node : NULL;
}

void jox_key_place(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    const JoxYaml *name = name_of(r, key, node);
    *JOX_MEMBER(int32_t, item, key->offset) = name ? jox_load_place(r, name) : -1;
}

void jox_key_group(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    const JoxYaml *name = name_of(r, key, node);
    *JOX_MEMBER(int32_t, item, key->offset) = name ? jox_load_group(r, name) : -1;
}

void jox_key_name(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    const JoxYaml *name = name_of(r, key, node);
    if (name && *name->text)
        jox_scene_name(r, name->position, key->name, name->text);
    *JOX_MEMBER(char *, item, key->offset) = name ? jox_arena_text(r->arena, name->text) : NULL;
}

void jox_key_tags(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    const JoxYaml *const *names;
    uint32_t count = jox_read_names(r, node, &names);
    char **tags = jox_arena_take(r->arena, count, sizeof *tags);
    for (uint32_t i = 0; i < count; i++) {
        tags[i] = jox_arena_text(r->arena, names[i]->text);
        jox_scene_name(r, names[i]->position, "tag", tags[i]);
    }
    *JOX_MEMBER(char **, item, key->offset) = tags;
    *JOX_MEMBER(uint32_t, item, key->counter) = count;
}

void jox_key_colour(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    const char *text = node && node->kind == JOX_YAML_SCALAR ? node->text : "";
    JoxText hint = {0};
    if (!node || jox_colour_read(text, JOX_MEMBER(JoxColour, item, key->offset)))
        return;
    jox_colour_hint(text, &hint);
    if (*text)
        jox_scene_error(r, node, "bad-value", hint.data, "'%.40s' is no colour", text);
    else /* YAML takes '#' behind a blank for the beginning of a comment */
        jox_scene_error(r, node, "bad-value", hint.data, "%s needs a name of a colour", key->name);
    jox_text_free(&hint);
}
