/* The ground of places in which agents wait, and the spots on it, both kept from step to step.
   Called by steering/gather.c. */

#include "base/hash.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "base/number/pi.h"
#include "machine/gather.h"

static const float COMFORTABLE = 0.9f; /* m: spacing of spots while there is room: 1.4 people per
                                          m2 */
static const float CLOSER = 0.98f;     /* ratio of the spacings of a level and the one before */
enum { LEVELS = 29 };                  /* the closest is 0.51 m: 4.4 people per m2 */
static const float CLEAR = 0.25f;      /* m: distance of spots from walls */
static const float ABOUT = 3.0f;       /* m: width of the ground around a place that belongs to
                                          it */

const JoxSteerTerm *jox_gather_term(const JoxState *state) {
    for (uint32_t t = 0; t < state->steer_count; t++)
        if (state->steer[t].kind == JOX_STEER_GATHER)
            return &state->steer[t];
    return NULL;
}

/* Hashes the inputs of a place's ground: its polygon, the walls, and fixed bodies near it. */
static uint64_t hash_ground(const JoxMachineRun *run, int32_t index) {
    const JoxPlace *place = &run->places[index];
    JoxHash hash = jox_hash_begin();
    jox_hash_add(&hash, place->points, place->count * sizeof *place->points);
    jox_hash_add(&hash, &run->walls_version, sizeof run->walls_version);
    if (!run->objects || !run->objects->count)
        return jox_hash_end(&hash);
    const JoxV2 middle = jox_scale(jox_add(place->low, place->high), 0.5f);
    const JoxV2 half = jox_sub(place->high, middle);
    JoxObjectWalk walk = jox_objects_near(run->objects, middle, ABOUT + jox_maxf(half.x, half.y));
    for (uint32_t row; jox_objects_next(&walk, &row);) {
        const JoxObject *o = &run->objects->rows[row];
        if (!jox_standable_is_fixed(o))
            continue;
        jox_hash_add(&hash, &o->id, sizeof o->id);
        jox_hash_add(&hash, &o->position, sizeof o->position);
        jox_hash_add(&hash, o->footprint, o->footprint_count * sizeof *o->footprint);
    }
    return jox_hash_end(&hash);
}

JoxGatherGround *jox_gather_ground(JoxMachineRun *run, int32_t index) {
    JoxMachineScratch *s = run->scratch;
    const JoxPlace *place = &run->places[index];
    uint32_t k = 0;
    while (k < s->ground_count && s->gather_grounds[k].place != index)
        k++;
    if (k == s->ground_count) {
        JOX_RESERVE(s->gather_grounds, s->ground_capacity, k + 1);
        s->gather_grounds[s->ground_count++] = (JoxGatherGround){.place = index};
    }
    JoxGatherGround *ground = &s->gather_grounds[k];
    if (ground->checked)
        return ground;
    const uint64_t from = hash_ground(run, index);
    if (!ground->cells.part || ground->from != from)
        jox_standable_lay(&ground->cells, place, ABOUT, run->walls, run->wall_images, run->objects);
    ground->from = from;
    ground->checked = true;
    return ground;
}

static float find_spacing(uint32_t level) {
    float spacing = COMFORTABLE;
    for (uint32_t k = 0; k < level; k++)
        spacing *= CLOSER;
    return spacing;
}

static void lay_spots(JoxMachineRun *run, JoxGatherPlace *g, uint32_t level) {
    g->spacing = find_spacing(level);
    jox_lattice_lay(&g->spots, &run->places[g->place], &jox_gather_ground(run, g->place)->cells,
                    g->part, g->ahead, g->spacing, CLEAR);
}

/* Lays spots with the widest spacing that yields `need` of them, but not closer than `least`, m. */
static void lay_enough_spots(JoxMachineRun *run, JoxGatherPlace *g, uint32_t need, float least) {
    uint32_t level = 0;
    lay_spots(run, g, 0);
    const float area = (float)g->spots.count * COMFORTABLE * COMFORTABLE;
    while (level + 1 < LEVELS && find_spacing(level + 1) >= least &&
           area < (float)need * find_spacing(level) * find_spacing(level))
        level++;
    if (level > 0)
        lay_spots(run, g, level);
    while (g->spots.count < need && level + 1 < LEVELS && find_spacing(level + 1) >= least)
        lay_spots(run, g, ++level);
}

JoxGatherPlace *jox_gather_place(JoxMachineRun *run, const JoxGathering *entry, uint32_t need,
                                 float least) {
    JoxMachineScratch *s = run->scratch;
    const uint64_t from = jox_gather_ground(run, entry->place)->from;
    const double angle = entry->front * JOX_DEGREE;
    uint32_t k = 0;
    while (k < s->gather_count &&
           (s->gather_places[k].place != entry->place ||
            s->gather_places[k].front != entry->front || s->gather_places[k].part != entry->part))
        k++;
    if (k == s->gather_count) {
        JOX_RESERVE(s->gather_places, s->gather_place_capacity, k + 1);
        s->gather_places[s->gather_count++] =
            (JoxGatherPlace){.place = entry->place,
                             .front = entry->front,
                             .part = entry->part,
                             .ahead = {(float)jox_cos(angle), (float)jox_sin(angle)}};
    }
    JoxGatherPlace *g = &s->gather_places[k];
    if (g->need == need && g->least == least && g->from == from)
        return g;
    g->from = from;
    g->need = need;
    g->least = least;
    lay_enough_spots(run, g, need, least);
    return g;
}

void jox_gatherings_forget(JoxMachineScratch *s) {
    for (uint32_t k = 0; k < s->gather_count; k++)
        s->gather_places[k].need = 0;
    for (uint32_t k = 0; k < s->ground_count; k++)
        s->gather_grounds[k].from++;
}

void jox_gatherings_free(JoxMachineScratch *s) {
    for (uint32_t k = 0; k < s->gather_count; k++)
        jox_lattice_free(&s->gather_places[k].spots);
    for (uint32_t k = 0; k < s->ground_count; k++)
        jox_standable_free(&s->gather_grounds[k].cells);
    jox_free(s->gather_places);
    jox_free(s->gather_grounds);
    jox_free(s->gathered);
    jox_free(s->gather_blocks);
    jox_free(s->gather_number);
}
