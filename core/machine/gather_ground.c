/* The ground of places in which agents wait, and of the whole floor, and the spots on it, kept from
   step to step. Called by steering/gather.c and steering/lead.c. */

#include <math.h>

#include "base/hash.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "base/number/pi.h"
#include "machine/gather.h"

static const float COMFORTABLE = 0.9f; /* m: spacing of spots while there is room: 1.4 people per
                                          m2 */
static const float CLOSER = 0.98f;     /* ratio of the spacings of a level and the one before */
static const float CLOSEST = 0.511f;   /* m: 4.4 people per m2 */
static const float WIDEST = 12.0f;     /* m: spacing of the fewest agents who spread over a place */
static const float CLEAR = 0.25f;      /* m: distance of spots from walls */
static const float ABOUT = 3.0f;       /* m: width of the ground around a place that belongs to
                                          it */
/* Most cells of the ground of a place, and of the whole floor, which then measures 410 m square. */
static const float PLACE_CELLS = 262144.0f, FLOOR_CELLS = 2097152.0f;

const JoxSteerTerm *jox_gather_term(const JoxState *state) {
    for (uint32_t t = 0; t < state->steer_count; t++)
        if (state->steer[t].kind == JOX_STEER_GATHER)
            return &state->steer[t];
    return NULL;
}

static void include_disc(JoxV2 *low, JoxV2 *high, JoxV2 p, float radius) {
    *low = jox_v2(jox_minf(low->x, p.x - radius), jox_minf(low->y, p.y - radius));
    *high = jox_v2(jox_maxf(high->x, p.x + radius), jox_maxf(high->y, p.y + radius));
}

/* Returns the box around all walls and fixed bodies, as a place; without points if there are none.
   `corners`: room for its points. */
static JoxPlace find_floor_box(const JoxMachineRun *run, JoxV2 corners[4]) {
    JoxV2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    const JoxWalls *const both[] = {run->walls, run->wall_images};
    for (uint32_t k = 0; k < 2; k++)
        for (uint32_t v = 0; both[k] && v < both[k]->count; v++)
            include_disc(&low, &high, both[k]->vertices[v].point, ABOUT);
    for (uint32_t row = 0; run->objects && row < run->objects->count; row++) {
        const JoxObject *o = &run->objects->rows[row];
        if (jox_standable_is_fixed(o))
            include_disc(&low, &high, jox_v2(o->position.x, o->position.y),
                         ABOUT + (o->footprint_count ? o->disc : o->round));
    }
    corners[0] = low;
    corners[1] = jox_v2(high.x, low.y);
    corners[2] = high;
    corners[3] = jox_v2(low.x, high.y);
    return (JoxPlace){.points = corners, .count = low.x < high.x ? 4 : 0, .low = low, .high = high};
}

/* Hashes the inputs of a ground: its polygon, the walls, and fixed bodies on it. */
static uint64_t hash_ground(const JoxMachineRun *run, const JoxPlace *place) {
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
    const bool whole = index == JOX_WHOLE_FLOOR;
    JoxV2 corners[4];
    const JoxPlace place = whole ? find_floor_box(run, corners) : run->places[index];
    const uint64_t from = hash_ground(run, &place);
    if (place.count && (!ground->cells.part || ground->from != from))
        jox_standable_lay(&ground->cells, &place, whole ? 0.0f : ABOUT,
                          whole ? FLOOR_CELLS : PLACE_CELLS, run->walls, run->wall_images,
                          run->objects);
    ground->from = from;
    ground->checked = true;
    return ground;
}

static void lay_spots(JoxMachineRun *run, JoxGatherPlace *g, float spacing) {
    g->spacing = spacing;
    jox_lattice_lay(&g->spots, &run->places[g->place], &jox_gather_ground(run, g->place)->cells,
                    g->part, g->ahead, spacing, CLEAR);
}

/* Lays spots with the widest spacing that yields `need` of them, but not closer than `least`, m;
   not wider than is comfortable, unless the agents spread. */
static void lay_enough_spots(JoxMachineRun *run, JoxGatherPlace *g, uint32_t need, float least) {
    const float closest = jox_maxf(least, CLOSEST);
    float spacing = COMFORTABLE;
    lay_spots(run, g, spacing);
    const float area = (float)g->spots.count * COMFORTABLE * COMFORTABLE;
    if (g->spreads) /* a little wider than that of as many spots */
        spacing = jox_clampf(1.2f * sqrtf(area / (float)need), COMFORTABLE, WIDEST);
    while (spacing * CLOSER >= closest && area < (float)need * spacing * spacing)
        spacing *= CLOSER;
    if (spacing != g->spacing)
        lay_spots(run, g, spacing);
    for (; g->spots.count < need && spacing * CLOSER >= closest; lay_spots(run, g, spacing))
        spacing *= CLOSER;
}

JoxGatherPlace *jox_gather_place(JoxMachineRun *run, const JoxGathering *entry, uint32_t need,
                                 float least) {
    JoxMachineScratch *s = run->scratch;
    const uint64_t from = jox_gather_ground(run, entry->place)->from;
    const double angle = entry->front * JOX_DEGREE;
    uint32_t k = 0;
    while (k < s->gather_count &&
           (s->gather_places[k].place != entry->place ||
            s->gather_places[k].front != entry->front || s->gather_places[k].part != entry->part ||
            s->gather_places[k].spreads != entry->spreads))
        k++;
    if (k == s->gather_count) {
        JOX_RESERVE(s->gather_places, s->gather_place_capacity, k + 1);
        s->gather_places[s->gather_count++] =
            (JoxGatherPlace){.place = entry->place,
                             .front = entry->front,
                             .part = entry->part,
                             .spreads = entry->spreads,
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
