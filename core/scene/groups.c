/* Groups of a scene: behaviours, and what agents of a group have in common. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/format/path.h"
#include "base/number/pi.h"
#include "base/overlay.h"
#include "base/text.h"
#include "scene/internal.h"

/* The behaviour's file: beside the scene, in ../behaviours, or installed; NULL with an error. */
static char *find_behaviour(const JoxLoad *l, const char *name, JoxPosition position) {
    JoxArena *arena = l->reader.arena;
    /* Overrides are of no file: the scene's folder is meant. */
    const char *from = strcmp(position.file, JOX_LOAD_OVERRIDE) ? position.file : l->scene->path;
    char path[JOX_LONGEST_PATH], installed[JOX_LONGEST_PATH];
    const char *const folders[] = {"", "../behaviours/", installed, NULL};
    snprintf(installed, sizeof installed, "%s/behaviours/", l->datadir ? l->datadir : JOX_DATADIR);
    if (l->options && jox_mod_find(l->options->mods, l->options->mod_count, name, path))
        return jox_arena_text(arena, path);
    if (jox_path_find(from, name, ".lua", folders, path)) {
        jox_path_clean(path);
        return jox_arena_text(arena, path);
    }
    jox_diag_error(l->reader.diagnostics, position, "missing-file",
                   "Looked beside the scene, in ../behaviours and in the installed ones",
                   "there is no behaviour '%.200s'", name);
    return NULL;
}

void jox_key_behaviour(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    JoxGroup *group = item;
    if (node && node->kind != JOX_YAML_SCALAR)
        jox_scene_error(r, node, "bad-type", NULL, "%s must be a name", key->name);
    if (!node || node->kind != JOX_YAML_SCALAR)
        return;
    group->mix = jox_arena_take(r->arena, 1, sizeof *group->mix);
    *group->mix = (JoxGroupMix){.weight = 1, .position = node->position};
    group->mix->behaviour = find_behaviour(r->load, node->text, node->position);
    group->mix_count = group->mix->behaviour != NULL;
}

void jox_key_mix(const JoxReader *r, const JoxKey *key, const JoxYaml *map, void *item) {
    JoxGroup *group = item;
    double sum = 0;
    if (map && (map->kind != JOX_YAML_MAP || map->count == 0))
        jox_scene_error(r, map, "bad-type", "mix: {walker.lua: 3, runner.lua: 1}",
                        "a %s maps behaviours to weights", key->name);
    if (!map || map->kind != JOX_YAML_MAP || map->count == 0)
        return;
    group->mix = jox_arena_take(r->arena, map->count, sizeof *group->mix);
    group->mix_count = 0;
    for (uint32_t i = 0; i < map->count; i++) {
        JoxGroupMix *entry = &group->mix[group->mix_count];
        *entry = (JoxGroupMix){.position = map->key_positions[i]};
        if (!jox_read_number(r, map->items[i], "", &entry->weight))
            continue;
        if (!(entry->weight > 0 && entry->weight <= 1e6)) {
            jox_scene_error(r, map->items[i], "out-of-range", NULL, "a weight must be above 0");
            continue;
        }
        entry->behaviour = find_behaviour(r->load, map->keys[i], entry->position);
        sum += entry->weight;
        group->mix_count += entry->behaviour != NULL;
    }
    JOX_ASSERT(group->mix_count <= map->count);
    for (uint32_t i = 0; i < group->mix_count; i++)
        group->mix[i].weight /= sum;
}

/* rad; NAN where it is not given. */
void jox_key_facing(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    *JOX_MEMBER(float, item, key->offset) = (float)(jox_key_number(r, key, node) * JOX_DEGREE);
}

bool jox_finish_group(const JoxReader *r, const JoxYaml *map, void *item, bool good) {
    JoxGroup *group = item;
    const JoxYaml *one = jox_yaml_get(map, "behaviour"), *mix = jox_yaml_get(map, "mix");
    const JoxYaml *journey = jox_yaml_get(map, "journey");
    const size_t errors = r->diagnostics->errors;
    jox_load_positions(r, map, group);
    if (!one + !mix + !journey != 2)
        jox_scene_error(r, map, "missing-key", "behaviour: walker.lua",
                        "a group needs one of a behaviour, a mix of them and a journey");
    else if (journey && good && errors == 0)
        jox_load_journey(r, map, group);
    return true; /* a wrong one is known by its name */
}
