/* Clothes of groups in a scene message, and whether floor, scenery or clothes have changed. */
#include <string.h>

#include "base/hash.h"
#include "live/live_parts.h"

void jox_live_add_clothes(const char *group, uint32_t clothes, JoxJson *json) {
    if (clothes)
        jox_json_string(json, group, jox_clothes_names[clothes]);
}

void jox_live_hash_scenery(const JoxSceneSpec *spec, JoxHash *hash) {
    jox_hash_add(hash, &spec->floor, sizeof spec->floor);
    for (uint32_t g = 0; g < spec->group_count; g++)
        jox_hash_add(hash, &spec->groups[g].clothes, sizeof spec->groups[g].clothes);
    for (uint32_t i = 0; i < spec->scenery_count; i++) {
        const JoxScenery *s = &spec->scenery[i];
        jox_hash_add(hash, &s->kind, sizeof s->kind);
        jox_hash_add(hash, s->at, s->at_count * sizeof *s->at);
        jox_hash_add(hash, s->through, s->through_count * sizeof *s->through);
        jox_hash_add(hash, s->faces, s->face_count * sizeof *s->faces);
        jox_hash_add(hash, &s->turn, sizeof s->turn);
        jox_hash_add(hash, s->size, sizeof s->size);
        jox_hash_add(hash, s->doors, s->door_count * sizeof *s->doors);
        jox_hash_add(hash, &s->colour, sizeof s->colour);
        if (s->body)
            jox_hash_add(hash, s->body, strlen(s->body) + 1);
    }
}
