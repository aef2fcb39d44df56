/* What every report of a run draws on: mean speeds of the scene's regions, the field of density,
   where people were squeezed, and who stood the longest. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "run/run.h"

static const double SAMPLE = 2.0; /* s between samples of the regions' speeds */
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

/* ---- density: of every run, unless it is told to do without ---- */

typedef struct LocalFigures {
    JoxLocal *local;
} LocalFigures;

static bool local_begin(void *self, JoScene *scene, const void *options, JoError *error) {
    LocalFigures *figures = self;
    JoxV2 low, high;
    (void)options, (void)error;
    jox_run_area(scene, &low, &high);
    figures->local = jox_local_create(low, high);
    figures->local->mean_from = scene->spec->heatmap_from;
    return true;
}

static bool local_frame(void *self, JoScene *scene, JoError *error) {
    JoxLocal *local = ((LocalFigures *)self)->local;
    (void)error;
    if (jox_local_is_due(local, jo_world_time(scene->world)))
        jox_local_frame(local, jox_run_frame(scene), NULL);
    return true;
}

static void local_release(void *self) {
    jox_local_free(((LocalFigures *)self)->local);
}

static const JoxListenerKind LOCAL = {.name = "density",
                                      .size = sizeof(LocalFigures),
                                      .begin = local_begin,
                                      .frame = local_frame,
                                      .release = local_release};

void jox_run_collect_local(JoScene *scene) {
    if (!jox_run_listener(scene, &LOCAL))
        jox_run_listen(scene, &LOCAL, NULL, NULL);
}

static JoxLocal *local_of(const JoScene *scene) {
    LocalFigures *figures = jox_run_listener(scene, &LOCAL);
    return figures ? figures->local : NULL;
}

const JoxLocal *jox_run_local(const JoScene *scene) {
    return local_of(scene);
}

const JoxLocal *jox_run_want_pressure(JoScene *scene) {
    jox_run_collect_local(scene);
    jox_local_want_pressure(local_of(scene));
    return local_of(scene);
}

double jox_run_density_max(const JoScene *scene) {
    const JoxLocal *local = local_of(scene);
    const JoxAgents *a = &scene->world->state.agents;
    JoxV2 low, high;
    if (!local || local->samples > 0)
        return local ? local->grid->most : NAN;
    jox_run_area(scene, &low, &high); /* no step yet: that of the present */
    JoxDensity *now = jox_density_create(low, high, local->grid->cell, JOX_DENSITY_KERNEL);
    jox_density_walls(now, &scene->world->scratch.walls);
    jox_density_add(now, a->period, a->x, a->y, a->count, jo_world_time(scene->world));
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

/* Of the run's own densities, unless an area is given. */
static bool danger_begin(void *self, JoScene *scene, const void *options, JoError *error) {
    const DangerArea *area = options;
    (void)error;
    JoxDanger *danger =
        area ? jox_danger_create(area->low, area->high) : jox_danger_create_on(local_of(scene));
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
    jox_run_collect_local(scene);
    if (!jox_run_listener(scene, &DANGER))
        jox_run_listen(scene, &DANGER, NULL, NULL);
}

const JoxDanger *jox_run_danger(const JoScene *scene) {
    const DangerFigures *figures = jox_run_listener(scene, &DANGER);
    return figures ? figures->danger : NULL;
}

/* ---- who stood the longest though they wanted to get on: each is looked at once a second ---- */

static const float MOVED = 0.25f; /* m: who has come so far does not stand */

typedef struct Stand {
    JoxV2 at;
    double since; /* s; NAN: did not want to get on when last seen */
    uint32_t id;
} Stand;

typedef struct Standing {
    Stand *people; /* by slot */
    size_t capacity;
    uint32_t seen; /* slots that were ever looked at */
    JoxStood longest;
} Standing;

/* Slots are used again: who is new in one has not stood yet. */
static Stand *stand_of(Standing *s, const JoxAgents *a, uint32_t i) {
    JOX_RESERVE(s->people, s->capacity, a->slot_count);
    for (; s->seen < a->slot_count; s->seen++)
        s->people[s->seen] = (Stand){.since = NAN};
    Stand *stand = &s->people[a->slot[i]];
    if (stand->id != a->id[i])
        *stand = (Stand){.since = NAN, .id = a->id[i]};
    return stand;
}

static void look(Standing *s, const JoWorld *world, uint32_t i) {
    const JoxAgents *a = &world->state.agents;
    double now = jo_world_time(world);
    JoxV2 at = {a->x[i], a->y[i]};
    Stand *stand = stand_of(s, a, i);
    if (jox_stands(a, i)) {
        stand->since = NAN;
        return;
    }
    JoxV2 moved = jox_wrap(a, jox_sub(at, stand->at));
    if (isnan(stand->since) || jox_length2(moved) > MOVED * MOVED) {
        stand->at = at;
        stand->since = now;
    }
    if (now - stand->since > s->longest.seconds)
        s->longest = (JoxStood){now - stand->since, now, stand->at, a->id[i]};
}

static bool standing_begin(void *self, JoScene *scene, const void *options, JoError *error) {
    Standing *s = self;
    (void)scene, (void)options, (void)error;
    s->longest.id = JOX_NO_INDEX;
    return true;
}

static bool standing_frame(void *self, JoScene *scene, JoError *error) {
    const JoWorld *world = scene->world;
    uint64_t every = (uint64_t)jox_maxf(1.0f, (float)(1.0 / world->model.def.dt + 0.5));
    (void)error;
    if (world->state.tick % every == 0)
        for (uint32_t i = 0; i < world->state.agents.count; i++)
            look(self, world, i);
    return true;
}

static void standing_release(void *self) {
    jox_free(((Standing *)self)->people);
}

static const JoxListenerKind STANDING = {.name = "who stood the longest",
                                         .size = sizeof(Standing),
                                         .begin = standing_begin,
                                         .frame = standing_frame,
                                         .release = standing_release};

void jox_run_collect_standing(JoScene *scene) {
    jox_run_listen(scene, &STANDING, NULL, NULL);
}

const JoxStood *jox_run_stood_longest(const JoScene *scene) {
    const Standing *s = jox_run_listener(scene, &STANDING);
    return s ? &s->longest : NULL;
}
