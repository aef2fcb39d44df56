/* Mods change a scene's tree before it is read: maps are merged key by key, other values take the
   place of the old; `~` takes a key away. A list is changed by a map: `append` adds items, `remove`
   takes some away, and an item's name or number changes it. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/internal.h"

#include "base/path.h"

enum { DEEPEST = 12 };

typedef struct Patch {
    JoxLoad *load;
    uint32_t mod;
} Patch;

/* Keeps what was set where; two mods that set one path without knowing each other are named. */
static void keep(const Patch *p, const char *path, JoxPosition at, bool removes) {
    JoxLoad *l = p->load;
    JoxSceneSpec *scene = l->scene;
    const JoxMod *mods = l->options->mods;
    if (scene->change_count == l->change_capacity) {
        uint32_t wider = l->change_capacity ? 2 * l->change_capacity : 16;
        JoxSceneChange *changes = jox_arena_take(l->reader.arena, wider, sizeof *changes);
        if (scene->change_count)
            memcpy(changes, scene->changes, scene->change_count * sizeof *changes);
        scene->changes = changes;
        l->change_capacity = wider;
    }
    for (uint32_t c = 0; c < scene->change_count; c++) {
        const JoxSceneChange *other = &scene->changes[c];
        if (other->mod == p->mod || !jox_mod_overlaps(other->path, path) ||
            (mods[p->mod].after >> other->mod & 1))
            continue;
        jox_mod_conflict(l->reader.diagnostics, &mods[p->mod], at, &mods[other->mod],
                         other->position, path);
        break;
    }
    scene->changes[scene->change_count++] =
        (JoxSceneChange){jox_arena_text(l->reader.arena, path), at, p->mod, removes};
}

static bool is_null(const JoxYaml *node) {
    return node->kind == JOX_YAML_SCALAR && !node->quoted &&
           (!*node->text || !strcmp(node->text, "~") || !strcmp(node->text, "null"));
}

static void join(char path[512], const char *prefix, const char *key) {
    snprintf(path, 512, "%.400s%s%.100s", prefix, *prefix ? "." : "", key);
}

static JoxYaml *merge(const Patch *p, const JoxYaml *base, const JoxYaml *change, const char *path,
                      int depth);

static JoxYaml *merge_map(const Patch *p, const JoxYaml *base, const JoxYaml *change,
                          const char *path, int depth) {
    JoxArena *arena = p->load->reader.arena;
    JoxYaml *result = jox_yaml_copy(arena, base);
    for (uint32_t k = 0; k < change->count; k++) {
        const char *key = change->keys[k];
        char whole[512];
        if (depth == 0 &&
            (!strcmp(key, "patch") || !strcmp(key, "replace") || !strcmp(key, "jostle")))
            continue;
        join(whole, path, key);
        JoxYaml *now = jox_yaml_get(result, key);
        if (is_null(change->items[k])) {
            if (!now)
                jox_diag_error(
                    p->load->reader.diagnostics, change->key_positions[k], "unknown-key",
                    jox_scene_suggest(&p->load->reader, key, result->keys, result->count),
                    "there is no '%.60s' to take away", key);
            jox_yaml_remove(result, key);
            keep(p, whole, change->key_positions[k], true);
        } else if (now && change->items[k]->kind == JOX_YAML_MAP && depth < DEEPEST &&
                   now->kind != JOX_YAML_SCALAR) {
            jox_yaml_set(arena, result, key, merge(p, now, change->items[k], whole, depth + 1));
        } else {
            jox_yaml_put(arena, result, key, change->key_positions[k], change->items[k]);
            keep(p, whole, change->key_positions[k], false);
        }
    }
    return result;
}

/* An item of a list, by its `name` or number; the list's length where there is none. */
static uint32_t find_item(const JoxYaml *list, const char *key) {
    for (uint32_t i = 0; i < list->count; i++) {
        const JoxYaml *name = jox_yaml_get(list->items[i], "name");
        if (name && name->kind == JOX_YAML_SCALAR && !strcmp(name->text, key))
            return i;
    }
    bool digits = *key && strlen(key) < 9 && key[strspn(key, "0123456789")] == 0;
    unsigned long i = digits ? strtoul(key, NULL, 10) : list->count;
    return i < list->count ? (uint32_t)i : list->count;
}

static JoxYaml *merge_list(const Patch *p, const JoxYaml *base, const JoxYaml *change,
                           const char *path, int depth) {
    JoxArena *arena = p->load->reader.arena;
    JoxYaml *result = jox_yaml_copy(arena, base);
    bool *gone = jox_arena_take(arena, base->count + 1, sizeof *gone);
    for (uint32_t k = 0; k < change->count; k++) {
        const char *key = change->keys[k];
        const JoxYaml *value = change->items[k];
        char whole[512];
        join(whole, path, key);
        if (!strcmp(key, "append")) {
            uint32_t count = value->kind == JOX_YAML_LIST ? value->count : 1;
            for (uint32_t i = 0; i < count; i++) {
                JoxYaml *item = value->kind == JOX_YAML_LIST ? value->items[i] : change->items[k];
                const JoxYaml *name = jox_yaml_get(item, "name");
                char number[16];
                snprintf(number, sizeof number, "%u", result->count);
                join(whole, path, name && name->kind == JOX_YAML_SCALAR ? name->text : number);
                jox_yaml_append(arena, result, item);
                keep(p, whole, item->position, false);
            }
            continue;
        }
        const JoxYaml *const *names = NULL;
        bool removes = !strcmp(key, "remove");
        const JoxYaml self = {
            .kind = JOX_YAML_SCALAR, .text = key, .position = change->key_positions[k]};
        const JoxYaml *selves[] = {&self};
        uint32_t count = removes ? jox_read_names(&p->load->reader, value, &names) : 1;
        names = removes ? names : selves;
        for (uint32_t n = 0; n < count; n++) {
            uint32_t at = find_item(base, names[n]->text);
            join(whole, path, names[n]->text);
            if (at == base->count) {
                jox_diag_error(
                    p->load->reader.diagnostics, names[n]->position, "unknown-item",
                    "Items go by their `name`, or by their number from 0; append: [...] adds",
                    "this list has no item '%.60s'", names[n]->text);
            } else if (removes || is_null(value)) {
                gone[at] = true;
                keep(p, whole, names[n]->position, true);
            } else {
                result->items[at] = merge(p, result->items[at], value, whole, depth + 1);
            }
        }
    }
    uint32_t kept = 0;
    for (uint32_t i = 0; i < result->count; i++)
        if (i >= base->count || !gone[i])
            result->items[kept++] = result->items[i];
    result->count = kept;
    return result;
}

static JoxYaml *merge(const Patch *p, const JoxYaml *base, const JoxYaml *change, const char *path,
                      int depth) {
    bool merges = change->kind == JOX_YAML_MAP && depth < DEEPEST;
    if (merges && base->kind == JOX_YAML_LIST)
        return merge_list(p, base, change, path, depth);
    if (merges && base->kind == JOX_YAML_MAP)
        return merge_map(p, base, change, path, depth);
    keep(p, path, change->position, false);
    return jox_yaml_copy(p->load->reader.arena, change);
}

/* Whether a patch's target is this scene: by its file, or by "mod:file" for one of a mod. */
static bool is_target(const JoxLoad *l, const char *target) {
    const char *path = l->scene->path, *stem = jox_path_name(path), *dot = strrchr(stem, '.');
    size_t n = dot ? (size_t)(dot - stem) : strlen(stem);
    for (uint32_t m = 0; m < l->options->mod_count; m++) {
        const JoxMod *mod = &l->options->mods[m];
        size_t name = strlen(mod->name);
        if (jox_path_below(path, mod->folder))
            return strncmp(target, mod->name, name) == 0 && target[name] == ':' &&
                   strncmp(target + name + 1, stem, n) == 0 && !target[name + 1 + n];
    }
    return strncmp(target, stem, n) == 0 && !target[n];
}

JoxYaml *jox_load_patches(JoxLoad *l, JoxYaml *root, JoxYamlFiles *files) {
    for (uint32_t m = 0; m < l->options->mod_count; m++)
        for (uint32_t f = 0; f < l->options->mods[m].patch_count; f++) {
            const JoxModPatch *patch = &l->options->mods[m].patches[f];
            if (patch->lua || !patch->target || !is_target(l, patch->target))
                continue;
            JoxYaml *change =
                jox_yaml_load(l->reader.arena, patch->path, NULL, 0, files, l->reader.diagnostics);
            if (!change || change->kind != JOX_YAML_MAP)
                continue;
            const Patch p = {l, m};
            if (patch->replaces) {
                keep(&p, "", change->position, false);
                root = jox_yaml_copy(l->reader.arena, change);
                jox_yaml_remove(root, "replace");
            } else {
                root = merge_map(&p, root, change, "", 0);
            }
        }
    return root;
}
