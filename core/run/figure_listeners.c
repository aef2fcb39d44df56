/* Listeners that collect what reports and results show: mean speeds in the scene's regions,
   local densities, danger to people. build_scene.c attaches the first two, reports the third. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "run/figure_listeners.h"
#include "run/present_frame.h"
#include "run/run.h"

/* Returns the collector (JoxRegions, JoxLocal or JoxDanger) of a listener, which holds its
   address alone; NULL: no such listener. */
static void *find_collector(const JoScene *scene, const JoxListenerKind *kind) {
    void **self = jox_run_find_listener(scene, kind);
    return self ? *self : NULL;
}

/* Attaches a listener unless it is there. False with `error` if the checkpoint of a resumed
   scene holds unsound data of it. */
static bool attach_collector(JoScene *scene, const JoxListenerKind *kind, const void *options,
                             JoError *error) {
    return jox_run_find_listener(scene, kind) ||
           jox_run_attach_listener(scene, kind, options, error);
}

/* ---- regions: in every scene that has some ---- */

static const double REGION_INTERVAL = 2.0; /* s between samples of the regions' speeds */

static bool begin_regions(void *self, JoScene *scene, const void *options, JoError *error) {
    JoxRegions *regions = *(JoxRegions **)self = jox_regions_create();
    (void)options, (void)error;
    for (uint32_t i = 0; i < scene->spec->region_count; i++)
        jox_regions_add(regions, scene->spec->regions[i].name, scene->spec->regions[i].points,
                        scene->spec->regions[i].count);
    return true;
}

static bool sample_regions(void *self, JoScene *scene, JoError *error) {
    const JoxAgents *a = &scene->world->state.agents;
    (void)error;
    if (jox_run_is_sample_due(scene, REGION_INTERVAL) &&
        jo_world_time(scene->world) >= scene->spec->heatmap_from)
        jox_regions_frame(*(JoxRegions **)self, a->x, a->y, a->prev_x, a->prev_y, a->count,
                          scene->world->model.def.dt);
    return true;
}

static void list_region_sections(void *self, JoxSections *s) {
    jox_regions_sections(*(JoxRegions **)self, s);
}

static void free_regions(void *self) {
    jox_regions_free(*(JoxRegions **)self);
}

static const JoxListenerKind REGIONS = {.name = "speeds of regions",
                                        .size = sizeof(JoxRegions *),
                                        .begin = begin_regions,
                                        .frame = sample_regions,
                                        .sections = list_region_sections,
                                        .goes_on = true,
                                        .release = free_regions};

void jox_run_collect_regions(JoScene *scene) {
    if (scene->spec->region_count)
        attach_collector(scene, &REGIONS, NULL, NULL);
}

const JoxRegions *jox_run_regions(const JoScene *scene) {
    return find_collector(scene, &REGIONS);
}

/* ---- density: of every run, unless it is told to do without ---- */

static bool begin_densities(void *self, JoScene *scene, const void *options, JoError *error) {
    JoxV2 low, high;
    (void)options, (void)error;
    const JoxStoreys *storeys = jox_run_find_plan_area(scene, &low, &high);
    JoxLocal *local = *(JoxLocal **)self = jox_local_create(low, high, storeys);
    local->mean_from = scene->spec->heatmap_from;
    local->grid->isa = scene->world->model.def.isa;
    return true;
}

static bool sample_densities(void *self, JoScene *scene, JoError *error) {
    JoxLocal *local = *(JoxLocal **)self;
    (void)error;
    if (jox_local_is_due(local, jo_world_time(scene->world)))
        jox_local_frame(
            local, jox_run_present_frame(scene, local->pressure ? JOX_FRAME_VELOCITIES : 0), NULL);
    return true;
}

static void list_density_sections(void *self, JoxSections *s) {
    jox_local_sections(*(JoxLocal **)self, s);
}

static void free_densities(void *self) {
    jox_local_free(*(JoxLocal **)self);
}

static const JoxListenerKind LOCAL = {.name = "density",
                                      .size = sizeof(JoxLocal *),
                                      .begin = begin_densities,
                                      .frame = sample_densities,
                                      .sections = list_density_sections,
                                      .goes_on = true,
                                      .release = free_densities};

bool jox_run_collect_densities(JoScene *scene, JoError *error) {
    return attach_collector(scene, &LOCAL, NULL, error);
}

const JoxLocal *jox_run_local_densities(const JoScene *scene) {
    return find_collector(scene, &LOCAL);
}

const JoxLocal *jox_run_collect_pressure(JoScene *scene) {
    if (jox_run_collect_densities(scene, NULL))
        jox_local_enable_pressure(find_collector(scene, &LOCAL));
    return jox_run_local_densities(scene);
}

double jox_run_greatest_density(const JoScene *scene) {
    const JoxLocal *local = jox_run_local_densities(scene);
    const JoxAgents *a = &scene->world->state.agents;
    JoxV2 low, high;
    if (!local || local->samples > 0)
        return local ? local->grid->most : NAN;
    /* No sample yet: measure people as they stand. */
    const JoxStoreys *storeys = jox_run_find_plan_area(scene, &low, &high);
    JoxDensity *now =
        jox_density_create_on_storeys(low, high, local->grid->cell, JOX_DENSITY_KERNEL, storeys);
    jox_density_walls(now, jox_world_dividing_walls(scene->world));
    jox_density_add(now, a->period, a->x, a->y, a->count, jo_world_time(scene->world));
    double most = now->most;
    jox_density_free(now);
    return most;
}

/* ---- danger ---- */

typedef struct DangerArea {
    JoxV2 low, high;
} DangerArea;

/* Measures danger in an area if one is given, else on the densities that the run collects. */
static bool begin_danger(void *self, JoScene *scene, const void *options, JoError *error) {
    const DangerArea *area = options;
    (void)error;
    JoxDanger *danger = *(JoxDanger **)self =
        area ? jox_danger_create(area->low, area->high, scene->world->state.agents.storeys)
             : jox_danger_create_on(find_collector(scene, &LOCAL));
    jox_danger_add_plan(danger, scene->spec->places, scene->spec->place_count, scene->spec->probes,
                        scene->spec->probe_count);
    return true;
}

/* Fills velocities only if danger samples densities of its own now: crowd pressure needs them. */
static bool sample_danger(void *self, JoScene *scene, JoError *error) {
    JoxDanger *danger = *(JoxDanger **)self;
    const JoxLocal *local = jox_danger_local(danger);
    const bool own = local != find_collector(scene, &LOCAL);
    const bool due = own && jox_local_is_due(local, jo_world_time(scene->world));
    (void)error;
    jox_danger_frame(danger, jox_run_present_frame(scene, due ? JOX_FRAME_VELOCITIES : 0),
                     &scene->world->state.exits);
    return true;
}

static void list_danger_sections(void *self, JoxSections *s) {
    jox_danger_sections(*(JoxDanger **)self, s);
}

static void free_danger(void *self) {
    jox_danger_free(*(JoxDanger **)self);
}

static const JoxListenerKind DANGER = {.name = "danger",
                                       .size = sizeof(JoxDanger *),
                                       .begin = begin_danger,
                                       .frame = sample_danger,
                                       .sections = list_danger_sections,
                                       .goes_on = true,
                                       .release = free_danger};

void jox_run_collect_danger_in(JoScene *scene, JoxV2 low, JoxV2 high) {
    DangerArea area = {low, high};
    attach_collector(scene, &DANGER, &area, NULL);
}

bool jox_run_collect_danger(JoScene *scene, JoError *error) {
    return jox_run_collect_densities(scene, error) && attach_collector(scene, &DANGER, NULL, error);
}

const JoxDanger *jox_run_danger(const JoScene *scene) {
    return find_collector(scene, &DANGER);
}
