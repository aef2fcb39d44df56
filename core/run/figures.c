/* What every report of a run draws on: mean speeds of the scene's regions, the field of density,
   where people were squeezed, and who stood the longest. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "run/run.h"

bool jox_run_is_due(const JoScene *scene, double interval) {
    const JoWorld *world = scene->world;
    uint64_t every = (uint64_t)jox_maxf(1.0f, (float)(interval / world->model.def.dt + 0.5));
    return world->state.tick % every == 0;
}

/* The listeners of regions, densities and danger each hold one thing that collects, by its address.
 */
static void *held(const JoScene *scene, const JoxListenerKind *kind) {
    void **self = jox_run_listener(scene, kind);
    return self ? *self : NULL;
}

static void collect(JoScene *scene, const JoxListenerKind *kind, const void *options) {
    if (!jox_run_listener(scene, kind))
        jox_run_listen(scene, kind, options, NULL);
}

/* ---- regions: in every scene that has some ---- */

static const double SAMPLE = 2.0; /* s between samples of the regions' speeds */

static bool regions_begin(void *self, JoScene *scene, const void *options, JoError *error) {
    JoxRegions *regions = *(JoxRegions **)self = jox_regions_create();
    (void)options, (void)error;
    for (uint32_t i = 0; i < scene->spec->region_count; i++)
        jox_regions_add(regions, scene->spec->regions[i].name, scene->spec->regions[i].points,
                        scene->spec->regions[i].count);
    return true;
}

static bool regions_frame(void *self, JoScene *scene, JoError *error) {
    const JoxAgents *a = &scene->world->state.agents;
    (void)error;
    if (jox_run_is_due(scene, SAMPLE) && jo_world_time(scene->world) >= scene->spec->heatmap_from)
        jox_regions_frame(*(JoxRegions **)self, a->x, a->y, a->prev_x, a->prev_y, a->count,
                          scene->world->model.def.dt);
    return true;
}

static void regions_sections(void *self, JoxSections *s) {
    jox_regions_sections(*(JoxRegions **)self, s);
}

static void regions_release(void *self) {
    jox_regions_free(*(JoxRegions **)self);
}

static const JoxListenerKind REGIONS = {.name = "speeds of regions",
                                        .size = sizeof(JoxRegions *),
                                        .begin = regions_begin,
                                        .frame = regions_frame,
                                        .sections = regions_sections,
                                        .goes_on = true,
                                        .release = regions_release};

void jox_run_collect_regions(JoScene *scene) {
    if (scene->spec->region_count)
        collect(scene, &REGIONS, NULL);
}

const JoxRegions *jox_run_regions(const JoScene *scene) {
    return held(scene, &REGIONS);
}

/* ---- density: of every run, unless it is told to do without ---- */

static bool local_begin(void *self, JoScene *scene, const void *options, JoError *error) {
    JoxV2 low, high;
    (void)options, (void)error;
    jox_run_area(scene, &low, &high);
    JoxLocal *local = *(JoxLocal **)self = jox_local_create(low, high);
    local->mean_from = scene->spec->heatmap_from;
    return true;
}

static bool local_frame(void *self, JoScene *scene, JoError *error) {
    JoxLocal *local = *(JoxLocal **)self;
    (void)error;
    if (jox_local_is_due(local, jo_world_time(scene->world)))
        jox_local_frame(local, jox_run_frame(scene), NULL);
    return true;
}

static void local_sections(void *self, JoxSections *s) {
    jox_local_sections(*(JoxLocal **)self, s);
}

static void local_release(void *self) {
    jox_local_free(*(JoxLocal **)self);
}

static const JoxListenerKind LOCAL = {.name = "density",
                                      .size = sizeof(JoxLocal *),
                                      .begin = local_begin,
                                      .frame = local_frame,
                                      .sections = local_sections,
                                      .goes_on = true,
                                      .release = local_release};

void jox_run_collect_local(JoScene *scene) {
    collect(scene, &LOCAL, NULL);
}

const JoxLocal *jox_run_local(const JoScene *scene) {
    return held(scene, &LOCAL);
}

const JoxLocal *jox_run_want_pressure(JoScene *scene) {
    jox_run_collect_local(scene);
    jox_local_want_pressure(held(scene, &LOCAL));
    return jox_run_local(scene);
}

double jox_run_density_max(const JoScene *scene) {
    const JoxLocal *local = jox_run_local(scene);
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

typedef struct DangerArea {
    JoxV2 low, high;
} DangerArea;

/* Of the run's own densities, unless an area is given. */
static bool danger_begin(void *self, JoScene *scene, const void *options, JoError *error) {
    const DangerArea *area = options;
    (void)error;
    JoxDanger *danger = *(JoxDanger **)self =
        area ? jox_danger_create(area->low, area->high) : jox_danger_create_on(held(scene, &LOCAL));
    jox_danger_add_plan(danger, scene->spec->places, scene->spec->place_count, scene->spec->probes,
                        scene->spec->probe_count);
    return true;
}

static bool danger_frame(void *self, JoScene *scene, JoError *error) {
    (void)error;
    jox_danger_frame(*(JoxDanger **)self, jox_run_frame(scene), &scene->world->state.exits);
    return true;
}

static void danger_sections(void *self, JoxSections *s) {
    jox_danger_sections(*(JoxDanger **)self, s);
}

static void danger_release(void *self) {
    jox_danger_free(*(JoxDanger **)self);
}

static const JoxListenerKind DANGER = {.name = "danger",
                                       .size = sizeof(JoxDanger *),
                                       .begin = danger_begin,
                                       .frame = danger_frame,
                                       .sections = danger_sections,
                                       .goes_on = true,
                                       .release = danger_release};

void jox_run_collect_danger_in(JoScene *scene, JoxV2 low, JoxV2 high) {
    DangerArea area = {low, high};
    collect(scene, &DANGER, &area);
}

void jox_run_collect_danger(JoScene *scene) {
    jox_run_collect_local(scene);
    collect(scene, &DANGER, NULL);
}

const JoxDanger *jox_run_danger(const JoScene *scene) {
    return held(scene, &DANGER);
}

/* ---- who stood the longest though they wanted to get on ---- */

static const double LOOK = 1.0;   /* s between looks at each person */
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
    (void)error;
    if (jox_run_is_due(scene, LOOK))
        for (uint32_t i = 0; i < world->state.agents.count; i++)
            look(self, world, i);
    return true;
}

static void standing_sections(void *self, JoxSections *s) {
    Standing *standing = self;
    JOX_SECTION_ARRAY(s, "people", standing->people, standing->seen, standing->capacity);
    JOX_SECTION(s, "longest", standing->longest);
}

static void standing_release(void *self) {
    jox_free(((Standing *)self)->people);
}

static const JoxListenerKind STANDING = {.name = "who stood the longest",
                                         .size = sizeof(Standing),
                                         .begin = standing_begin,
                                         .frame = standing_frame,
                                         .sections = standing_sections,
                                         .goes_on = true,
                                         .release = standing_release};

void jox_run_collect_standing(JoScene *scene) {
    collect(scene, &STANDING, NULL);
}

const JoxStood *jox_run_stood_longest(const JoScene *scene) {
    const Standing *s = jox_run_listener(scene, &STANDING);
    return s ? &s->longest : NULL;
}
