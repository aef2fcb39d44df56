/* Groups of a scene: behaviours, and what agents of a group have in common. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/overlay.h"
#include "base/text.h"
#include "scene/internal.h"

static const double DEGREE = 3.14159265358979323846 / 180.0;

/* The behaviour's file: beside the scene, in ../behaviours, or installed; NULL with an error. */
static char *find_behaviour(const JoxLoad *l, const char *name, JoxPosition position) {
    JoxArena *arena = l->reader.arena;
    /* Overrides are of no file: the scene's folder is meant. */
    const char *from = strcmp(position.file, JOX_LOAD_OVERRIDE) ? position.file : l->scene->path;
    char relative[512];
    const char *colon = strchr(name, ':');
    const char *lua = strlen(name) > 4 && !strcmp(name + strlen(name) - 4, ".lua") ? "" : ".lua";
    for (uint32_t m = 0; colon && l->options && m < l->options->mod_count; m++) {
        const JoxMod *mod = &l->options->mods[m]; /* "mod:name" */
        if (strncmp(mod->name, name, (size_t)(colon - name)) || mod->name[colon - name])
            continue;
        snprintf(relative, sizeof relative, "%.300s/behaviours/%.150s%s", mod->folder, colon + 1,
                 lua);
        if (!strstr(colon, "..") && jox_is_file(relative))
            return jox_arena_text(arena, relative);
    }
    const char *forms[] = {"%.400s%s", "../behaviours/%.400s%s", "%s/behaviours/%.300s%s"};
    for (int i = 0; i < 3; i++) {
        if (i < 2)
            snprintf(relative, sizeof relative, forms[i], name, lua);
        else
            snprintf(relative, sizeof relative, "%s/behaviours/%.300s%s",
                     l->datadir ? l->datadir : JOX_DATADIR, name, lua);
        char *path = jox_path_beside(arena, from, relative);
        if (jox_is_file(path)) {
            jox_path_clean(path);
            return path;
        }
    }
    jox_diag_error(l->reader.diagnostics, position, "missing-file",
                   "Looked beside the scene, in ../behaviours and in the installed ones",
                   "there is no behaviour '%.200s'", name);
    return NULL;
}

void jox_key_behaviour(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    JoxSceneGroup *group = item;
    if (node && node->kind != JOX_YAML_SCALAR)
        jox_scene_error(r, node, "bad-type", NULL, "%s must be a name", key->name);
    if (!node || node->kind != JOX_YAML_SCALAR)
        return;
    group->mix = jox_arena_take(r->arena, 1, sizeof *group->mix);
    *group->mix = (JoxSceneMix){.weight = 1, .position = node->position};
    group->mix->behaviour = find_behaviour(r->load, node->text, node->position);
    group->mix_count = group->mix->behaviour != NULL;
}

void jox_key_mix(const JoxReader *r, const JoxKey *key, const JoxYaml *map, void *item) {
    JoxSceneGroup *group = item;
    double sum = 0;
    if (map && (map->kind != JOX_YAML_MAP || map->count == 0))
        jox_scene_error(r, map, "bad-type", "mix: {walker.lua: 3, runner.lua: 1}",
                        "a %s maps behaviours to weights", key->name);
    if (!map || map->kind != JOX_YAML_MAP || map->count == 0)
        return;
    group->mix = jox_arena_take(r->arena, map->count, sizeof *group->mix);
    group->mix_count = 0;
    for (uint32_t i = 0; i < map->count; i++) {
        JoxSceneMix *entry = &group->mix[group->mix_count];
        *entry = (JoxSceneMix){.position = map->key_positions[i]};
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
    *JOX_MEMBER(float, item, key->offset) = (float)(jox_key_number(r, key, node) * DEGREE);
}

bool jox_finish_group(const JoxReader *r, const JoxYaml *map, void *item, bool good) {
    JoxSceneGroup *group = item;
    const JoxYaml *one = jox_yaml_get(map, "behaviour"), *mix = jox_yaml_get(map, "mix");
    (void)good;
    if (!one == !mix)
        jox_scene_error(r, map, "missing-key", "behaviour: walker.lua",
                        "a group needs a behaviour or a mix of them");
    jox_load_positions(r, map, group);
    return true; /* a wrong one is known by its name */
}
