/* Mods change a scene's tree before it is read: base/patch.h with nodes of YAML. `~` takes a key
   away. A list is changed by a map: `append` adds items, `remove` takes some away, and an item's
   name or number changes it. */
#include "base/format/patch.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/internal.h"

static JoxArena *arena_of(void *c) {
    return ((const JoxReader *)c)->arena;
}

static bool is_null(const JoxYaml *node) {
    return node->kind == JOX_YAML_SCALAR && !node->quoted &&
           (!*node->text || !strcmp(node->text, "~") || !strcmp(node->text, "null"));
}

static JoxPatchKind kind(void *c, void *node) {
    (void)c;
    const JoxYaml *n = node;
    return n->kind == JOX_YAML_MAP    ? JOX_PATCH_MAP
           : n->kind == JOX_YAML_LIST ? JOX_PATCH_LIST
           : is_null(n)               ? JOX_PATCH_NOTHING
                                      : JOX_PATCH_LEAF;
}

static void *copy(void *c, void *node) {
    return jox_yaml_copy(arena_of(c), node);
}

static uint32_t keys(void *c, void *map, const char *path, const char *from,
                     const char *const **names) {
    (void)c, (void)path, (void)from;
    const JoxYaml *n = map;
    *names = (const char *const *)n->keys;
    return n->kind == JOX_YAML_MAP ? n->count : 0;
}

static void *get(void *c, void *map, const char *key) {
    (void)c;
    return jox_yaml_get(map, key);
}

static JoxPosition position(void *c, const JoxPatchPlace *at) {
    (void)c;
    const JoxYaml *map = at->map, *value = at->value;
    for (uint32_t k = 0; map && k < map->count; k++)
        if (strcmp(map->keys[k], at->key) == 0)
            return map->key_positions[k];
    return value->position;
}

static void set(void *c, void *map, const char *key, const JoxPatchPlace *at, void *value) {
    if (at)
        jox_yaml_put(arena_of(c), map, key, position(c, at), value);
    else
        jox_yaml_set(arena_of(c), map, key, value);
}

static void remove_key(void *c, void *map, const char *key) {
    (void)c;
    jox_yaml_remove(map, key);
}

static uint32_t count(void *c, void *node) {
    (void)c;
    const JoxYaml *n = node;
    return n->kind == JOX_YAML_LIST ? n->count : 0;
}

static void *item(void *c, void *node, uint32_t i) {
    (void)c;
    return ((JoxYaml *)node)->items[i];
}

static void put(void *c, void *node, uint32_t i, void *value) {
    (void)c;
    ((JoxYaml *)node)->items[i] = value;
}

static void insert(void *c, void *node, uint32_t i, void *value) {
    JoxYaml *list = node;
    jox_yaml_append(arena_of(c), list, value);
    for (uint32_t k = list->count - 1; k > i; k--)
        list->items[k] = list->items[k - 1];
    list->items[i] = value;
}

static void sweep(void *c, void *node) {
    (void)c;
    JoxYaml *list = node;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < list->count; i++)
        if (list->items[i])
            list->items[kept++] = list->items[i];
    list->count = kept;
}

static const char *text(void *c, void *leaf) {
    (void)c;
    const JoxYaml *n = leaf;
    return n->kind == JOX_YAML_SCALAR ? n->text : NULL;
}

static const char *name_of(const JoxYaml *node) {
    const JoxYaml *name = jox_yaml_get(node, "name");
    return name && name->kind == JOX_YAML_SCALAR ? name->text : NULL;
}

/* An item goes by its `name` or by its number from 0. */
static bool is_item(void *c, void *node, uint32_t i, const char *id) {
    (void)c;
    const JoxYaml *n = ((const JoxYaml *)node)->items[i];
    const char *name = n ? name_of(n) : NULL;
    char number[16];
    snprintf(number, sizeof number, "%u", i);
    return n && ((name && strcmp(name, id) == 0) || strcmp(number, id) == 0);
}

static void *admit(void *c, void *node, void *value, const char *path, const char *keep,
                   const JoxPatchPlace *at, char id[JOX_PATCH_ID]) {
    (void)c, (void)path, (void)keep, (void)at;
    const char *name = name_of(value);
    if (name)
        snprintf(id, JOX_PATCH_ID, "%s", name);
    else
        snprintf(id, JOX_PATCH_ID, "%u", ((const JoxYaml *)node)->count);
    return value;
}

static bool enter(void *c, void *node, void *change, const char *path, const char *from,
                  int depth) {
    (void)c, (void)change, (void)path, (void)from, (void)depth;
    return ((const JoxYaml *)node)->kind == JOX_YAML_LIST;
}

/* The head of a mod's file says what it is for. */
static bool skips(void *c, void *node, const JoxPatchPlace *at, int depth) {
    (void)c, (void)node;
    return depth == 0 &&
           (!strcmp(at->key, "patch") || !strcmp(at->key, "replace") || !strcmp(at->key, "jostle"));
}

static void missing(void *c, void *node, const char *name, const JoxPatchPlace *at,
                    bool is_of_list) {
    const JoxReader *reader = c;
    const JoxYaml *n = node;
    if (is_of_list)
        jox_diag_error(reader->diagnostics, position(c, at), "unknown-item",
                       "Items go by their `name`, or by their number from 0; append: [...] adds",
                       "this list has no item '%.60s'", name);
    else
        jox_diag_error(reader->diagnostics, position(c, at), "unknown-key",
                       jox_scene_suggest(reader, name, n->keys, n->count),
                       "there is no '%.60s' to take away", name);
}

JoxYaml *jox_load_patches(JoxLoad *l, JoxYaml *root, JoxYamlFiles *files) {
    const JoxSceneOptions *options = l->options;
    const JoxPatchTree tree = {.context = &l->reader,
                               .kind = kind,
                               .copy = copy,
                               .keys = keys,
                               .get = get,
                               .set = set,
                               .remove = remove_key,
                               .count = count,
                               .item = item,
                               .put = put,
                               .insert = insert,
                               .sweep = sweep,
                               .text = text,
                               .is_item = is_item,
                               .admit = admit,
                               .position = position,
                               .enter = enter,
                               .skips = skips,
                               .missing = missing,
                               .item_mark = "",
                               .verbs = 1u << JOX_PATCH_REMOVE | 1u << JOX_PATCH_APPEND,
                               .keys_are_ids = true,
                               .deepest = 12};
    for (uint32_t m = 0; m < options->mod_count; m++)
        for (uint32_t f = 0; f < options->mods[m].patch_count; f++) {
            const JoxModPatch *file = &options->mods[m].patches[f];
            if (file->lua || !file->target ||
                !jox_patch_is_target(file->target, l->scene->path, options->mods,
                                     options->mod_count))
                continue;
            JoxYaml *change =
                jox_yaml_load(l->reader.arena, file->path, NULL, 0, files, l->reader.diagnostics);
            if (!change || change->kind != JOX_YAML_MAP)
                continue;
            const JoxPatch patch = {&tree, &l->scene->changes,   options->mods, (int32_t)m,
                                    0,     l->reader.diagnostics};
            if (file->replaces) {
                jox_patch_replaces(&patch, change);
                root = jox_yaml_copy(l->reader.arena, change);
                jox_yaml_remove(root, "replace");
            } else {
                root = jox_patch_apply(&patch, root, change);
            }
        }
    return root;
}
