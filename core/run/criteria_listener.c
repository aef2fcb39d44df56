/* The listener that samples what criteria need, and their verdicts in summaries and last lines. */
#include "run/criteria_listener.h"

#include <math.h>

#include "base/assert.h"
#include "base/format/plurals.h"
#include "base/mem.h"
#include "jostle_tools.h"
#include "run/figure_listeners.h"
#include "run/probe_listener.h"
#include "run/run.h"

static bool begin_criteria(void *self, JoScene *scene, const void *options, JoError *error) {
    (void)options, (void)error;
    *(JoxCriteria **)self = jox_criteria_create(scene->spec->criteria, scene->spec->criterion_count,
                                                scene->spec->places, scene->spec->place_count);
    return true;
}

static bool sample_criteria(void *self, JoScene *scene, JoError *error) {
    (void)error;
    jox_criteria_sample(*(JoxCriteria **)self, jox_run_danger(scene));
    return true;
}

static void list_criteria_sections(void *self, JoxSections *s) {
    jox_criteria_sections(*(JoxCriteria **)self, s);
}

static void free_criteria(void *self) {
    jox_criteria_free(*(JoxCriteria **)self);
}

static const JoxListenerKind CRITERIA = {.name = "criteria",
                                         .size = sizeof(JoxCriteria *),
                                         .begin = begin_criteria,
                                         .frame = sample_criteria,
                                         .sections = list_criteria_sections,
                                         .goes_on = true,
                                         .release = free_criteria};

void jox_run_collect_criteria(JoScene *scene) {
    if (scene->spec->criterion_count && jox_run_collect_danger(scene, NULL))
        jox_run_attach_listener(scene, &CRITERIA, NULL, NULL);
}

static const JoxCriteria *find_criteria(const JoScene *scene) {
    void **self = jox_run_find_listener(scene, &CRITERIA);
    return self ? *self : NULL;
}

uint32_t jox_run_count_criteria(const JoScene *scene) {
    return jox_criteria_count(find_criteria(scene));
}

/* Returns the evidence of a run; the caller frees its list of probes. */
static JoxCriterionEvidence collect_evidence(const JoScene *scene) {
    uint32_t count = 0;
    while (jox_run_probe(scene, count))
        count++;
    const JoxProbe **probes = jox_alloc(count + 1, sizeof *probes);
    for (uint32_t p = 0; p < count; p++)
        probes[p] = jox_run_probe(scene, p);
    return (JoxCriterionEvidence){.danger = jox_run_danger(scene),
                                  .exits = &scene->world->state.exits,
                                  .inside = scene->world->state.agents.count,
                                  .to_come = jox_world_expects_people(scene->world),
                                  .until = jo_world_time(scene->world),
                                  .probes = probes,
                                  .probe_count = count};
}

JoxVerdict jox_run_judge(const JoScene *scene, uint32_t number) {
    const JoxCriterionEvidence evidence = collect_evidence(scene);
    const JoxVerdict verdict = jox_criteria_judge(find_criteria(scene), number, &evidence);
    jox_free((void *)(uintptr_t)evidence.probes);
    return verdict;
}

void jox_run_add_criteria(const JoScene *scene, JoxJson *json) {
    const JoxCriterionEvidence evidence = collect_evidence(scene);
    jox_criteria_json(find_criteria(scene), &evidence, json);
    jox_free((void *)(uintptr_t)evidence.probes);
}

void jox_run_say_criteria(const JoScene *scene, JoxText *out) {
    for (uint32_t k = 0; k < jox_run_count_criteria(scene); k++) {
        const JoxVerdict v = jox_run_judge(scene, k);
        jox_text_printf(out, " Criterion %.60s: %s", v.criterion->name, jox_verdict_names[v.kind]);
        if (isfinite(v.figure))
            jox_text_printf(out, " (%.4g of at most %.4g %s)", v.figure, v.limit, v.unit);
        jox_text_add(out, ".");
    }
}

bool jo_scene_meets_criteria(const JoScene *scene) {
    JOX_REQUIRE(scene, false);
    for (uint32_t k = 0; k < jox_run_count_criteria(scene); k++)
        if (jox_run_judge(scene, k).kind != JOX_VERDICT_MET)
            return false;
    return true;
}
