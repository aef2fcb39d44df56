/* Merges the patches of mods into a scene's tree before it is read, by base/format/patch.h with
   nodes of YAML. Called by read_specification.c. In a patch `~` removes a key; a map changes a
   list: `append` adds items, `remove` removes some, the `name` or number of an item changes it. */
#include "base/format/patch.h"

#include <stdio.h>
#include <string.h>

#include "scene/scene_draft.h"

static JoxArena *get_arena(void *c) {
    return ((const JoxReader *)c)->arena;
}

static bool is_null(const JoxYaml *node) {
    return node->kind == JOX_YAML_SCALAR && !node->quoted &&
           (!*node->text || !strcmp(node->text, "~") || !strcmp(node->text, "null"));
}

static JoxPatchKind get_node_kind(void *c, void *node) {
    (void)c;
    const JoxYaml *n = node;
    return n->kind == JOX_YAML_MAP    ? JOX_PATCH_MAP
           : n->kind == JOX_YAML_LIST ? JOX_PATCH_LIST
           : is_null(n)               ? JOX_PATCH_NOTHING
                                      : JOX_PATCH_LEAF;
}

static void *copy_node(void *c, void *node) {
    return jox_yaml_copy(get_arena(c), node);
}

static uint32_t list_node_keys(void *c, void *map, const char *path, const char *from,
                               const char *const **names) {
    (void)c, (void)path, (void)from;
    const JoxYaml *n = map;
    *names = (const char *const *)n->keys;
    return n->kind == JOX_YAML_MAP ? n->count : 0;
}

static void *get_node_value(void *c, void *map, const char *key) {
    (void)c;
    return jox_yaml_get(map, key);
}

static JoxPosition find_change_position(void *c, const JoxPatchPlace *at) {
    (void)c;
    const JoxYaml *map = at->map, *value = at->value;
    for (uint32_t k = 0; map && k < map->count; k++)
        if (strcmp(map->keys[k], at->key) == 0)
            return map->key_positions[k];
    return value->position;
}

static void set_node_value(void *c, void *map, const char *key, const JoxPatchPlace *at,
                           void *value) {
    if (at)
        jox_yaml_set_at(get_arena(c), map, key, find_change_position(c, at), value);
    else
        jox_yaml_set(get_arena(c), map, key, value);
}

static void remove_node_key(void *c, void *map, const char *key) {
    (void)c;
    jox_yaml_remove(map, key);
}

static uint32_t count_node_items(void *c, void *node) {
    (void)c;
    const JoxYaml *n = node;
    return n->kind == JOX_YAML_LIST ? n->count : 0;
}

static void *get_node_item(void *c, void *node, uint32_t i) {
    (void)c;
    return ((JoxYaml *)node)->items[i];
}

static void put_node_item(void *c, void *node, uint32_t i, void *value) {
    (void)c;
    ((JoxYaml *)node)->items[i] = value;
}

static void insert_node_item(void *c, void *node, uint32_t i, void *value) {
    JoxYaml *list = node;
    jox_yaml_append(get_arena(c), list, value);
    for (uint32_t k = list->count - 1; k > i; k--)
        list->items[k] = list->items[k - 1];
    list->items[i] = value;
}

static void drop_removed_items(void *c, void *node) {
    (void)c;
    JoxYaml *list = node;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < list->count; i++)
        if (list->items[i])
            list->items[kept++] = list->items[i];
    list->count = kept;
}

static const char *get_node_text(void *c, void *leaf) {
    (void)c;
    const JoxYaml *n = leaf;
    return n->kind == JOX_YAML_SCALAR ? n->text : NULL;
}

/* Whether `id` is the `name` of item i, or its number from 0. */
static bool has_node_id(void *c, void *node, uint32_t i, const char *id) {
    (void)c;
    const JoxYaml *n = ((const JoxYaml *)node)->items[i];
    const char *name = n ? jox_yaml_name(n) : NULL;
    char number[16];
    snprintf(number, sizeof number, "%u", i);
    return n && ((name && strcmp(name, id) == 0) || strcmp(number, id) == 0);
}

static void *admit_node(void *c, void *node, void *value, const char *path, const char *keep,
                        const JoxPatchPlace *at, char id[JOX_PATCH_ID]) {
    (void)c, (void)path, (void)keep, (void)at;
    const char *name = jox_yaml_name(value);
    if (name)
        snprintf(id, JOX_PATCH_ID, "%s", name);
    else
        snprintf(id, JOX_PATCH_ID, "%u", ((const JoxYaml *)node)->count);
    return value;
}

static bool enter_node(void *c, void *node, void *change, const char *path, const char *from,
                       int depth) {
    (void)c, (void)change, (void)path, (void)from, (void)depth;
    return ((const JoxYaml *)node)->kind == JOX_YAML_LIST;
}

/* Skips the top-level keys that say which scene the patch is for. */
static bool skips_head_key(void *c, void *node, const JoxPatchPlace *at, int depth) {
    (void)c, (void)node;
    return depth == 0 &&
           (!strcmp(at->key, "patch") || !strcmp(at->key, "replace") || !strcmp(at->key, "jostle"));
}

static void report_missing_node(void *c, void *node, const char *name, const JoxPatchPlace *at,
                                bool is_of_list) {
    const JoxReader *reader = c;
    const JoxYaml *n = node;
    if (is_of_list)
        jox_diag_error(reader->diagnostics, find_change_position(c, at), "unknown-item",
                       "Items go by their `name`, or by their number from 0; append: [...] adds",
                       "this list has no item '%.60s'", name);
    else
        jox_diag_error(reader->diagnostics, find_change_position(c, at), "unknown-key",
                       jox_scene_suggest(reader, name, n->keys, n->count),
                       "there is no '%.60s' to take away", name);
}

JoxYaml *jox_mods_patch_scene(JoxSceneDraft *draft, JoxYaml *root, JoxYamlFiles *files) {
    const JoxSceneOptions *options = draft->options;
    const JoxPatchTree tree = {.context = &draft->reader,
                               .kind = get_node_kind,
                               .copy = copy_node,
                               .keys = list_node_keys,
                               .get = get_node_value,
                               .set = set_node_value,
                               .remove = remove_node_key,
                               .count = count_node_items,
                               .item = get_node_item,
                               .put = put_node_item,
                               .insert = insert_node_item,
                               .sweep = drop_removed_items,
                               .text = get_node_text,
                               .is_item = has_node_id,
                               .admit = admit_node,
                               .position = find_change_position,
                               .enter = enter_node,
                               .skips = skips_head_key,
                               .missing = report_missing_node,
                               .item_mark = "",
                               .verbs = 1u << JOX_PATCH_REMOVE | 1u << JOX_PATCH_APPEND,
                               .keys_are_ids = true,
                               .deepest = 12};
    for (uint32_t m = 0; m < options->mod_count; m++)
        for (uint32_t f = 0; f < options->mods[m].patch_count; f++) {
            const JoxModPatch *file = &options->mods[m].patches[f];
            if (file->lua || !file->target ||
                !jox_patch_is_target(file->target, draft->scene->path, options->mods,
                                     options->mod_count))
                continue;
            JoxYaml *change = jox_yaml_read(draft->reader.arena, file->path, NULL, 0, files,
                                            draft->reader.diagnostics);
            if (!change || change->kind != JOX_YAML_MAP)
                continue;
            const JoxPatch patch = {&tree, &draft->scene->changes,   options->mods, (int32_t)m,
                                    0,     draft->reader.diagnostics};
            if (file->replaces) {
                jox_patch_replaces(&patch, change);
                root = jox_yaml_copy(draft->reader.arena, change);
                jox_yaml_remove(root, "replace");
            } else {
                root = jox_patch_apply(&patch, root, change);
            }
        }
    return root;
}
