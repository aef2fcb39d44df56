/* The listener that gives frames of a run to the scene's probes, each at its own interval. */
#include "run/probe_listener.h"
#include "base/assert.h"
#include "base/mem.h"
#include "run/present_frame.h"
#include "run/run.h"

typedef struct Probes {
    JoxProbe **items;
    uint32_t count;
} Probes;

static bool create_probes(void *self, JoScene *scene, const void *options, JoError *error) {
    Probes *p = self;
    const JoxSceneSpec *spec = scene->spec;
    (void)options, (void)error;
    p->items = jox_alloc(spec->probe_count, sizeof *p->items);
    p->count = spec->probe_count;
    for (uint32_t n = 0; n < p->count; n++) {
        JoxProbeDef def = spec->probes[n];
        JoxV2 low, high;
        def.storeys = jox_run_find_plan_area(scene, &low, &high);
        if (def.kind == JOX_PROBE_MAP && def.low.x > def.high.x) {
            def.low = low;
            def.high = high;
            def.all_storeys = def.storeys != NULL;
        }
        p->items[n] = jox_probe_create(&def);
    }
    return true;
}

static bool sample_probes(void *self, JoScene *scene, JoError *error) {
    const Probes *p = self;
    (void)error;
    for (uint32_t n = 0; n < p->count; n++)
        if (jox_probe_is_due(p->items[n], jo_world_time(scene->world)))
            jox_probe_frame(p->items[n], jox_run_present_frame(scene, JOX_FRAME_MEASURED));
    return true;
}

static void list_probe_sections(void *self, JoxSections *s) {
    const Probes *p = self;
    uint32_t count = p->count;
    JOX_SECTION(s, "count", count);
    if (count != p->count)
        jox_sections_fail(s, "count", "the scene has other probes");
    for (uint32_t n = 0; n < p->count && !s->failed; n++)
        jox_probe_sections(p->items[n], s);
}

static void free_probes(void *self) {
    Probes *p = self;
    for (uint32_t n = 0; n < p->count; n++)
        jox_probe_free(p->items[n]);
    jox_free(p->items);
}

static const JoxListenerKind PROBES = {.name = "probes",
                                       .size = sizeof(Probes),
                                       .begin = create_probes,
                                       .frame = sample_probes,
                                       .sections = list_probe_sections,
                                       .goes_on = true,
                                       .release = free_probes};

void jox_run_collect_probes(JoScene *scene) {
    if (scene->spec->probe_count)
        jox_run_attach_listener(scene, &PROBES, NULL, NULL);
}

const JoxProbe *jox_run_probe(const JoScene *scene, uint32_t n) {
    const Probes *p = jox_run_find_listener(scene, &PROBES);
    return p && n < p->count ? p->items[n] : NULL;
}

void jox_run_add_probes(const JoScene *scene, JoxJson *json) {
    const JoxProbe *probe = jox_run_probe(scene, 0);
    if (!probe)
        return;
    jox_json_object(json, "probes");
    for (uint32_t n = 0; (probe = jox_run_probe(scene, n)); n++)
        jox_probe_json(probe, json, jox_probe_def(probe)->name);
    jox_json_end(json);
}

const char *jo_scene_probe_name(const JoScene *scene, uint32_t n) {
    JOX_REQUIRE(scene, NULL);
    const JoxProbe *probe = jox_run_probe(scene, n);
    return probe ? jox_probe_def(probe)->name : NULL;
}
