/* Reads groups of a scene: their behaviours, and the direction that their agents face. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/format/installed.h"
#include "base/format/path.h"
#include "base/number/pi.h"
#include "base/overlay.h"
#include "base/text.h"
#include "scene/scene_draft.h"

/* Finds the file of a behaviour: of a mod, beside the scene, in ../behaviours, or installed; NULL
   with an error. */
static char *find_behaviour_file(const JoxSceneDraft *draft, const char *name,
                                 JoxPosition position) {
    JoxArena *arena = draft->reader.arena;
    /* A value of --set stands in no file: look from the scene. */
    const char *from = strcmp(position.file, JOX_SET_OPTION) ? position.file : draft->scene->path;
    char path[JOX_LONGEST_PATH], installed[JOX_LONGEST_PATH];
    const char *const folders[] = {"", "../behaviours/", installed, NULL};
    snprintf(installed, sizeof installed, "%s/behaviours/",
             draft->datadir ? draft->datadir : jox_data_folder());
    if (draft->options && jox_mod_find(draft->options->mods, draft->options->mod_count, name, path))
        return jox_arena_text(arena, path);
    if (jox_path_find(from, name, ".lua", folders, path)) {
        jox_path_clean(path);
        return jox_arena_text(arena, path);
    }
    jox_diag_error(draft->reader.diagnostics, position, "missing-file",
                   "Looked beside the scene, in ../behaviours and in the installed ones",
                   "there is no behaviour '%.200s'", name);
    return NULL;
}

void jox_key_read_behaviour(const JoxReader *r, const JoxKey *key, const JoxYaml *node,
                            void *item) {
    JoxGroup *group = item;
    if (!jox_key_read_scalar(r, key, node, "name"))
        return;
    group->mix = jox_arena_take(r->arena, 1, sizeof *group->mix);
    *group->mix = (JoxGroupMix){.weight = 1, .position = node->position};
    group->mix->behaviour = find_behaviour_file(r->draft, node->text, node->position);
    group->mix_count = group->mix->behaviour != NULL;
}

void jox_key_read_mix(const JoxReader *r, const JoxKey *key, const JoxYaml *map, void *item) {
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
        entry->behaviour = find_behaviour_file(r->draft, map->keys[i], entry->position);
        sum += entry->weight;
        group->mix_count += entry->behaviour != NULL;
    }
    JOX_ASSERT(group->mix_count <= map->count);
    for (uint32_t i = 0; i < group->mix_count; i++)
        group->mix[i].weight /= sum;
}

void jox_scene_copy_behaviours(const JoxGroup *from, JoxSceneSpec *to, uint32_t group) {
    JoxGroup *copy = &to->groups[group];
    copy->mix_count = from->mix_count;
    copy->mix = jox_arena_take(to->memory, from->mix_count, sizeof *copy->mix);
    for (uint32_t m = 0; m < from->mix_count; m++) {
        copy->mix[m] = from->mix[m];
        copy->mix[m].behaviour = jox_arena_text(to->memory, from->mix[m].behaviour);
        copy->mix[m].text = jox_arena_text(to->memory, from->mix[m].text);
        copy->mix[m].position = copy->position;
    }
}

/* Reads a direction in deg and stores it in rad; NAN if it is missing. */
void jox_key_read_facing(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    *JOX_MEMBER(float, item, key->offset) = (float)(jox_key_read_number(r, key, node) * JOX_DEGREE);
}

bool jox_finish_group(const JoxReader *r, const JoxYaml *map, void *item, bool good) {
    JoxGroup *group = item;
    const JoxYaml *one = jox_yaml_get(map, "behaviour"), *mix = jox_yaml_get(map, "mix");
    const JoxYaml *journey = jox_yaml_get(map, "journey");
    const size_t errors = r->diagnostics->errors;
    if (jox_yaml_get(map, "storey") && !jox_yaml_get(map, "at") && !jox_yaml_get(map, "starts"))
        jox_scene_error(r, jox_yaml_get(map, "storey"), "bad-group",
                        "Write it to the places of `in`",
                        "`storey` is for the points of `at` and `starts`");
    if (r->draft->measuring)
        return true;
    jox_place_group(r, map, group);
    if (!one + !mix + !journey != 2)
        jox_scene_error(r, map, "missing-key", "behaviour: walker.lua",
                        "a group needs one of a behaviour, a mix of them and a journey");
    else if (journey && good && errors == 0)
        jox_write_journey_behaviour(r, map, group);
    return true; /* keep it if it is wrong, too: its name is known then */
}
