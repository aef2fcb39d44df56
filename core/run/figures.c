/* What every report of a run draws on: mean speeds of the scene's regions, the field of density,
   and where people were squeezed. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "run/run.h"

static const double SAMPLE = 2.0; /* s between samples of density and of the regions' speeds */
/* m between the points at which density_max is read, farther in areas of more than MOST_POINTS. The
   kernel is smooth over that distance; a report's map has finer cells for its picture, and takes
   six times as long. */
static const float PEAK_CELL = 0.5f;
static const float MOST_POINTS = 1e6f;

/* Whether the frame of now is a sample. */
static bool is_sample(const JoScene *scene) {
    const JoWorld *world = scene->world;
    uint64_t every = (uint64_t)jox_maxf(1.0f, (float)(SAMPLE / world->model.def.dt + 0.5));
    return world->state.tick % every == 0 &&
           (double)world->state.tick * world->model.def.dt >= scene->spec->heatmap_from;
}

/* ---- regions: in every scene that has some ---- */

typedef struct RegionSpeeds {
    JoxRegions *regions;
} RegionSpeeds;

static bool regions_begin(void *self, JoScene *scene, const void *options, JoError *error) {
    RegionSpeeds *r = self;
    (void)options, (void)error;
    r->regions = jox_regions_create();
    for (uint32_t i = 0; i < scene->spec->region_count; i++)
        jox_regions_add(r->regions, scene->spec->regions[i].name, scene->spec->regions[i].points,
                        scene->spec->regions[i].count);
    return true;
}

static bool regions_frame(void *self, JoScene *scene, JoError *error) {
    RegionSpeeds *r = self;
    const JoxAgents *a = &scene->world->state.agents;
    (void)error;
    if (is_sample(scene))
        jox_regions_frame(r->regions, a->x, a->y, a->prev_x, a->prev_y, a->count,
                          scene->world->model.def.dt);
    return true;
}

static void regions_release(void *self) {
    jox_regions_free(((RegionSpeeds *)self)->regions);
}

static const JoxListenerKind REGIONS = {.name = "speeds of regions",
                                        .size = sizeof(RegionSpeeds),
                                        .begin = regions_begin,
                                        .frame = regions_frame,
                                        .release = regions_release};

void jox_run_collect_regions(JoScene *scene) {
    if (scene->spec->region_count)
        jox_run_listen(scene, &REGIONS, NULL, NULL);
}

const JoxRegions *jox_run_regions(const JoScene *scene) {
    const RegionSpeeds *r = jox_run_listener(scene, &REGIONS);
    return r ? r->regions : NULL;
}

/* ---- density: of every run for its greatest value, and finer for a report's map ---- */

typedef struct DensityField {
    JoxDensity *density;
} DensityField;

static bool density_begin(void *self, JoScene *scene, const void *options, JoError *error) {
    JoxV2 low, high;
    (void)options, (void)error;
    jox_run_area(scene, &low, &high);
    ((DensityField *)self)->density =
        jox_density_create(low, high, JOX_DENSITY_CELL, JOX_DENSITY_KERNEL);
    return true;
}

static bool peak_begin(void *self, JoScene *scene, const void *options, JoError *error) {
    JoxV2 low, high;
    (void)options, (void)error;
    jox_run_area(scene, &low, &high);
    float cell = sqrtf((high.x - low.x) * (high.y - low.y) / MOST_POINTS);
    ((DensityField *)self)->density =
        jox_density_create(low, high, jox_maxf(cell, PEAK_CELL), JOX_DENSITY_KERNEL);
    return true;
}

static void add_density(DensityField *field, const JoScene *scene) {
    const JoxAgents *a = &scene->world->state.agents;
    jox_density_add(field->density, a->x, a->y, a->count, jo_world_time(scene->world));
}

static bool density_frame(void *self, JoScene *scene, JoError *error) {
    (void)error;
    if (is_sample(scene))
        add_density(self, scene);
    return true;
}

static bool density_end(void *self, JoScene *scene, JoError *error) {
    DensityField *field = self;
    (void)error;
    if (field->density->frames == 0) /* a run shorter than the first sample */
        add_density(field, scene);
    return true;
}

static void density_release(void *self) {
    jox_density_free(((DensityField *)self)->density);
}

static const JoxListenerKind DENSITY = {.name = "density",
                                        .size = sizeof(DensityField),
                                        .begin = density_begin,
                                        .frame = density_frame,
                                        .end = density_end,
                                        .release = density_release};

void jox_run_collect_density(JoScene *scene) {
    if (!jox_run_listener(scene, &DENSITY))
        jox_run_listen(scene, &DENSITY, NULL, NULL);
}

const JoxDensity *jox_run_density(const JoScene *scene) {
    const DensityField *field = jox_run_listener(scene, &DENSITY);
    return field ? field->density : NULL;
}

static const JoxListenerKind PEAK = {.name = "greatest density",
                                     .size = sizeof(DensityField),
                                     .begin = peak_begin,
                                     .frame = density_frame,
                                     .end = density_end,
                                     .release = density_release};

void jox_run_collect_peak(JoScene *scene) {
    if (!jox_run_listener(scene, &PEAK))
        jox_run_listen(scene, &PEAK, NULL, NULL);
}

const JoxDensity *jox_run_peak(const JoScene *scene) {
    const DensityField *field = jox_run_listener(scene, &PEAK);
    return field ? field->density : NULL;
}

double jox_run_density_max(const JoScene *scene) {
    const JoxDensity *peak = jox_run_peak(scene);
    const JoxAgents *a = &scene->world->state.agents;
    if (!peak || peak->frames)
        return peak ? peak->most : NAN;
    /* no sample yet: that of the present */
    JoxDensity *now = jox_density_create(
        peak->low,
        jox_add(peak->low, jox_scale((JoxV2){(float)peak->columns, (float)peak->rows}, peak->cell)),
        peak->cell, JOX_DENSITY_KERNEL);
    jox_density_add(now, a->x, a->y, a->count, jo_world_time(scene->world));
    double most = now->most;
    jox_density_free(now);
    return most;
}

/* ---- danger ---- */

typedef struct DangerFigures {
    JoxDanger *danger;
} DangerFigures;

typedef struct DangerArea {
    JoxV2 low, high;
} DangerArea;

static bool danger_begin(void *self, JoScene *scene, const void *options, JoError *error) {
    const DangerArea *area = options;
    (void)error;
    JoxDanger *danger = jox_danger_create(area->low, area->high);
    jox_danger_add_flows(danger, scene->spec->probes, scene->spec->probe_count);
    ((DangerFigures *)self)->danger = danger;
    return true;
}

static bool danger_frame(void *self, JoScene *scene, JoError *error) {
    (void)error;
    jox_danger_frame(((DangerFigures *)self)->danger, jox_run_frame(scene),
                     &scene->world->state.exits);
    return true;
}

static void danger_release(void *self) {
    jox_danger_free(((DangerFigures *)self)->danger);
}

static const JoxListenerKind DANGER = {.name = "danger",
                                       .size = sizeof(DangerFigures),
                                       .begin = danger_begin,
                                       .frame = danger_frame,
                                       .release = danger_release};

void jox_run_collect_danger_in(JoScene *scene, JoxV2 low, JoxV2 high) {
    DangerArea area = {low, high};
    if (!jox_run_listener(scene, &DANGER))
        jox_run_listen(scene, &DANGER, &area, NULL);
}

void jox_run_collect_danger(JoScene *scene) {
    JoxV2 low, high;
    jox_run_area(scene, &low, &high);
    jox_run_collect_danger_in(scene, low, high);
}

const JoxDanger *jox_run_danger(const JoScene *scene) {
    const DangerFigures *figures = jox_run_listener(scene, &DANGER);
    return figures ? figures->danger : NULL;
}
