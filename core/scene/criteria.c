/* Reads the criteria that a scene is held against. */
#include <math.h>
#include <string.h>

#include "scene/scene_draft.h"

/* Reads the name of the probe that a criterion of flow or waiting takes its figure from. */
void jox_key_read_criterion_probe(const JoxReader *r, const JoxKey *key, const JoxYaml *node,
                                  void *item) {
    enum { MOST_NAMES = 256 };
    JoxCriterion *criterion = item;
    const JoxSceneSpec *s = r->draft->scene;
    const char *names[MOST_NAMES], *name = jox_key_read_scalar(r, key, node, "name");
    uint32_t count = s->probe_count < MOST_NAMES ? s->probe_count : MOST_NAMES;
    criterion->probe = -1;
    for (uint32_t p = 0; name && p < s->probe_count; p++)
        if (strcmp(s->probes[p].name, name) == 0)
            criterion->probe = (int32_t)p;
    for (uint32_t p = 0; p < count; p++)
        names[p] = s->probes[p].name;
    if (name && criterion->probe < 0)
        jox_scene_error(r, node, "unknown-probe", jox_scene_suggest(r, name, names, count),
                        "there is no probe '%.60s'", name);
}

bool jox_finish_criterion(const JoxReader *r, const JoxYaml *map, void *item, bool good) {
    JoxCriterion *criterion = item;
    const JoxYaml *at = jox_yaml_get(map, "at"), *of = jox_yaml_get(map, "of");
    const JoxYaml *lasting = jox_yaml_get(map, "lasting"), *margin = jox_yaml_get(map, "margin");
    const bool density = criterion->kind == JOX_CRITERION_DENSITY;
    const bool waiting = criterion->kind == JOX_CRITERION_WAITING;
    const bool probed = waiting || criterion->kind == JOX_CRITERION_FLOW;
    if (!good)
        return true;
    if ((at || lasting) && !density)
        jox_scene_error(r, at ? at : lasting, "bad-criterion", "density: 4",
                        "'%s' goes with density", at ? "at" : "lasting");
    if (margin && criterion->kind != JOX_CRITERION_CLEARED)
        jox_scene_error(r, margin, "bad-criterion", "cleared: 120", "'margin' goes with cleared");
    if (of && !probed)
        jox_scene_error(r, of, "bad-criterion", "Leave it out", "'of' goes with flow and waiting");
    if (!of && probed)
        jox_scene_error(r, map, "bad-criterion", "of: NAME, the name of a probe",
                        "the criterion '%.60s' needs a probe", criterion->name);
    if (probed && criterion->probe >= 0) {
        const JoxProbeDef *probe = &r->draft->scene->probes[criterion->probe];
        const JoxProbeKind kind = probe->kind;
        const bool fits =
            waiting ? kind == JOX_PROBE_TRANSIT || kind == JOX_PROBE_VISIT : kind == JOX_PROBE_FLOW;
        if (!fits)
            jox_scene_error(r, of, "bad-criterion", NULL, "%s takes its figure from a probe of %s",
                            waiting ? "waiting" : "flow", waiting ? "transit or visit" : "flow");
        else if (!waiting && (probe->from > 0.0 || isfinite(probe->until) || probe->group_count))
            jox_scene_error(r, of, "bad-criterion", "Name a probe of this line without these keys",
                            "a flow is held against its limit over the whole run and of everybody, "
                            "but the probe '%.60s' has from, until or group",
                            probe->name);
    }
    return true;
}
