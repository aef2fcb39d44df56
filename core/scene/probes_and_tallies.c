/* Reads probes, which measure a run or a recording, and tallies, which count agents for scores. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "scene/scene_draft.h"

/* Keys of each kind of probe besides those of all kinds: "this|that". */
static const char *const OPTIONS[JOX_PROBE_KINDS] = {
#define X(kind, name, form, options, example, meaning) [JOX_PROBE_##kind] = options,
    JOX_PROBES(X)
#undef X
};
static const char *const NAMES[JOX_PROBE_KINDS] = {
#define X(kind, name, form, options, example, meaning) [JOX_PROBE_##kind] = #name,
    JOX_PROBES(X)
#undef X
};

void jox_key_read_states(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    JoxProbeDef *probe = item;
    bool good = node->kind == JOX_YAML_LIST && node->count == 2;
    for (uint32_t s = 0; good && s < 2; s++)
        good = node->items[s]->kind == JOX_YAML_SCALAR;
    if (!good) {
        jox_scene_error(r, node, "bad-type", "visit: [Wait, Served]",
                        "%s is a list of the names of two states", key->name);
        return;
    }
    for (uint32_t s = 0; s < 2; s++)
        probe->states[s] = jox_arena_text(r->arena, node->items[s]->text);
}

void jox_key_read_true(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    (void)item;
    if (node->kind != JOX_YAML_SCALAR || strcmp(node->text, "true") != 0)
        jox_scene_error(r, node, "bad-probe", "Take the probe away", "%s is true, or is not there",
                        key->name);
}

void jox_key_read_groups(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    const JoxYaml *const *names;
    uint32_t count = jox_read_names(r, node, &names), known = 0;
    uint16_t *groups = jox_arena_take(r->arena, count, sizeof *groups);
    for (uint32_t n = 0; n < count; n++) {
        int32_t group = jox_scene_find_group(r, names[n]);
        if (group >= 0)
            groups[known++] = (uint16_t)group;
    }
    JOX_ASSERT(known <= count);
    *JOX_MEMBER(const uint16_t *, item, key->offset) = groups;
    *JOX_MEMBER(uint32_t, item, key->count_offset) = known;
}

/* Reports keys that other kinds of probes have, but not this one. */
static void check_probe_options(const JoxReader *r, const JoxYaml *map, JoxProbeKind kind) {
    for (uint32_t k = 0; k < map->count; k++) {
        bool option = false;
        for (int other = 0; other < JOX_PROBE_KINDS; other++)
            option |= jox_choice_find(OPTIONS[other], map->keys[k]) >= 0;
        if (option && jox_choice_find(OPTIONS[kind], map->keys[k]) < 0)
            jox_scene_error(r, map->items[k], "bad-probe", "Leave it out",
                            "a probe of %s does not take '%s'", NAMES[kind], map->keys[k]);
    }
}

bool jox_finish_probe(const JoxReader *r, const JoxYaml *map, void *item, bool good) {
    JoxProbeDef *probe = item;
    const JoxYaml *until = jox_yaml_get(map, "until"), *along = jox_yaml_get(map, "along");
    probe->until = until ? probe->until : (double)INFINITY;
    if (until && probe->until <= probe->from)
        jox_scene_error(r, until, "bad-probe", NULL, "until (%g s) must be after from (%g s)",
                        probe->until, probe->from);
    if (!good)
        return true;
    JOX_ASSERT(probe->kind < JOX_PROBE_KINDS);
    check_probe_options(r, map, probe->kind);
    const JoxYaml *group = jox_yaml_get(map, "group");
    if (group && probe->kind == JOX_PROBE_BODIES)
        jox_scene_error(r, group, "bad-probe", "Leave it out", "bodies are in no group");
    if (along && probe->count && jox_length(probe->points[0]) < 1e-6f)
        jox_scene_error(r, along, "bad-probe", "[1, 0]", "a direction has a length");
    return true;
}

bool jox_finish_tally(const JoxReader *r, const JoxYaml *map, void *item, bool good) {
    JoxTally *tally = item;
    const JoxYaml *take = jox_yaml_get(map, "take"), *memory = jox_yaml_get(map, "memory"),
                  *state = jox_yaml_get(map, "state");
    tally->memory_position = memory ? memory->position : tally->position;
    tally->state_position = state ? state->position : tally->position;
    if (good && take && !tally->memory)
        jox_scene_error(r, take, "bad-value", "memory: hits",
                        "a tally takes the values of a `memory`; without one it counts agents");
    return true;
}
