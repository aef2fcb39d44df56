/* The steering word `gather`: agents that wait in an area fill it from its front, as far apart as
   is comfortable while there is room, and closer as more come in. Each has its turn from when it
   came in: earlier before later, nearer to the front before farther. Row by row, the spots are
   given to those whose turn it is, in the order in which they stand across. So nobody owns a spot,
   all move up as others come or leave, and hardly any ways cross. */
#include <math.h>

#include "base/assert.h"
#include "base/hash.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "base/number/random.h"
#include "base/sort.h"
#include "geom/lattice.h"
#include "machine/internal.h"

/* One agent that gathers. */
typedef struct JoxGathering {
    uint32_t agent, id;
    int32_t place;
    float front; /* deg */
    uint32_t turn;
    bool outside; /* of the place */
    float across; /* m: to the left of the way to the front */
} JoxGathering;

/* The spots of a place, kept from step to step: they follow from the model, the walls and the
   spacing alone. */
typedef struct JoxGatherPlace {
    int32_t place;
    float front;   /* deg */
    uint64_t from; /* hash of the place's points and of the version of the walls */
    JoxV2 ahead;
    uint32_t level; /* of spacing */
    float area;     /* m2, that can be stood on */
    JoxLattice spots;
} JoxGatherPlace;

static const float COMFORTABLE = 0.9f; /* m between people who have room: 1.4 per m2 */
static const float CLOSER = 0.96f;     /* of the spacing, by level */
enum { LEVELS = 14 };                  /* down to 0.53 m: 4.1 per m2 */
static const float CLEAR = 0.25f;      /* m between a spot and walls */
static const float NEAR = 0.4f;        /* of the spacing: who is so near to a spot has come to it */
static const float APART = 0.8f;       /* of the spacing: who is nearer than that is too near */
static const float SHIFT = 0.02f;      /* m: how far who stands wants to shift at present */
static const double TURN_TIME = 5.0;   /* s within which who stands farther in front has a turn */
static const double SWAY_TIME = 12.0;  /* s in which that turns into another direction */
static const double DEGREE = 3.141592653589793 / 180.0;

const JoxSteerTerm *jox_gather_term(const JoxState *state) {
    for (uint32_t t = 0; t < state->steer_count; t++)
        if (state->steer[t].kind == JOX_STEER_GATHER)
            return &state->steer[t];
    return NULL;
}

static JoxV2 direction_of(float degrees) {
    return jox_v2((float)jox_cos(degrees * DEGREE), (float)jox_sin(degrees * DEGREE));
}

/* The turn of an agent that comes to gather: by a span of time, and within it by the way to the
   front. Not 0. */
static uint32_t find_turn(const JoxMachineRun *run, const JoxPlace *place, JoxV2 at, JoxV2 ahead) {
    const double span = run->tick * run->dt / TURN_TIME;
    float front = -INFINITY;
    for (uint32_t k = 0; k < place->count; k++)
        front = jox_maxf(front, jox_dot(place->points[k], ahead));
    const float centimetres = 100.0f * (front - jox_dot(at, ahead));
    return (uint32_t)(span < 65535.0 ? span : 65535.0) << 16 |
           (uint32_t)jox_clampf(centimetres, 1.0f, 65535.0f);
}

/* False where there is no area: the agent then stands where it is. */
static bool find_area(const JoxMachineRun *run, uint32_t i, const JoxSteerTerm *term,
                      JoxGathering *out) {
    const JoxAgents *a = run->agents;
    const int32_t index = jox_target_place(run, i, term->target);
    const JoxV2 at = {a->x[i], a->y[i]};
    if (index < 0 || run->places[index].kind != JOX_PLACE_POLYGON)
        return false;
    const JoxV2 ahead = direction_of((float)term->args[0]);
    if (!a->turn[i])
        run->agents->turn[i] = find_turn(run, &run->places[index], at, ahead);
    *out = (JoxGathering){.agent = i,
                          .id = a->id[i],
                          .place = index,
                          .front = (float)term->args[0],
                          .turn = a->turn[i],
                          .outside = !jox_place_contains(run->places, (uint32_t)index, at),
                          .across = jox_dot(at, jox_left(ahead))};
    return true;
}

static int by_turn(const void *left, const void *right, const void *context) {
    const JoxGathering *a = left, *b = right;
    (void)context;
    if (a->place != b->place)
        return a->place < b->place ? -1 : 1;
    if (a->front != b->front)
        return a->front < b->front ? -1 : 1;
    if (a->turn != b->turn)
        return a->turn < b->turn ? -1 : 1;
    return (a->id > b->id) - (a->id < b->id);
}

static int by_across(const void *left, const void *right, const void *context) {
    const JoxGathering *a = left, *b = right;
    (void)context;
    if (a->across != b->across)
        return a->across < b->across ? -1 : 1;
    return (a->id > b->id) - (a->id < b->id);
}

/* ---- spots ---- */

static float spacing_of(uint32_t level) {
    float spacing = COMFORTABLE;
    for (uint32_t k = 0; k < level; k++)
        spacing *= CLOSER;
    return spacing;
}

static void lay(const JoxMachineRun *run, JoxGatherPlace *g, uint32_t level) {
    g->level = level;
    jox_lattice_lay(&g->spots, &run->places[g->place], run->walls, g->ahead, spacing_of(level),
                    CLEAR);
}

static uint64_t hash_of_area(const JoxMachineRun *run, int32_t index) {
    const JoxPlace *place = &run->places[index];
    JoxHash hash = jox_hash_begin();
    jox_hash_add(&hash, place->points, place->count * sizeof *place->points);
    jox_hash_add(&hash, &run->walls_version, sizeof run->walls_version);
    return jox_hash_end(&hash);
}

static JoxGatherPlace *find_place(JoxMachineRun *run, int32_t index, float front) {
    JoxMachineScratch *s = run->scratch;
    const uint64_t from = hash_of_area(run, index);
    uint32_t k = 0;
    while (k < s->gather_count &&
           (s->gather_places[k].place != index || s->gather_places[k].front != front))
        k++;
    if (k == s->gather_count) {
        JOX_RESERVE(s->gather_places, s->gather_place_capacity, k + 1);
        s->gather_places[s->gather_count++] =
            (JoxGatherPlace){.place = index, .front = front, .ahead = direction_of(front)};
    } else if (s->gather_places[k].from == from) {
        return &s->gather_places[k];
    }
    JoxGatherPlace *g = &s->gather_places[k];
    g->from = from;
    lay(run, g, 0);
    g->area = (float)g->spots.count * COMFORTABLE * COMFORTABLE;
    return g;
}

/* The widest spacing at which there are `need` spots, or the closest that there is. Depends on what
   is needed alone, not on what was laid before. */
static void lay_for(const JoxMachineRun *run, JoxGatherPlace *g, uint32_t need) {
    uint32_t level = 0;
    for (; level + 1 < LEVELS; level++)
        if (g->area >= (float)need * spacing_of(level) * spacing_of(level))
            break;
    if (level != g->level)
        lay(run, g, level);
}

/* ---- who stands where ---- */

/* Agents of a row, in the order in which they stand across, and the spots that they get: in their
   order, and as near as can be (isotonic regression). */
typedef struct Block {
    float sum; /* of the spots that its agents would have, less their numbers */
    uint32_t count;
} Block;

/* Number of the spot in a row that is nearest to a place across. */
static float nearest_spot(const JoxV2 *spots, uint32_t count, JoxV2 left, float across) {
    uint32_t low = 0, high = count - 1;
    while (low < high) {
        const uint32_t middle = (low + high) / 2;
        if (jox_dot(jox_add(spots[middle], spots[middle + 1]), left) < 2.0f * across)
            low = middle + 1;
        else
            high = middle;
    }
    return (float)low;
}

/* A direction that turns slowly, of length 1 at most. */
static JoxV2 sway(const JoxMachineRun *run, uint32_t id) {
    const double own = jox_random_unit(run->seed, id, 0, JOX_DRAW_SWAY, 2);
    const double time = run->tick * run->dt / SWAY_TIME + own, knot = floor(time);
    const double t = time - knot, smooth = t * t * (3.0 - 2.0 * t);
    double at[2];
    for (uint32_t k = 0; k < 2; k++) {
        const double from = jox_random_unit(run->seed, id, (uint64_t)knot, JOX_DRAW_SWAY, k);
        const double to = jox_random_unit(run->seed, id, (uint64_t)knot + 1, JOX_DRAW_SWAY, k);
        at[k] = 2.0 * (from + (to - from) * smooth) - 1.0;
    }
    return jox_v2((float)at[0], (float)at[1]);
}

/* How far an agent wants to move away from those who stand too near, m. */
static JoxV2 find_room(const JoxMachineRun *run, uint32_t i, float spacing) {
    const JoxNeighbours *n = run->neighbours;
    JoxV2 sum = {0.0f, 0.0f};
    for (uint32_t k = 0; k < n->count[i]; k++) {
        const JoxV2 to = jox_offset(run->agents, i, n->index[jox_neighbour_at(n, i, k)]);
        const float distance = jox_length(to), missing = APART * spacing - distance;
        if (missing <= 0.0f) /* they come by distance */
            break;
        if (distance > 0.0f)
            sum = jox_sub(sum, jox_scale(to, 0.5f * missing / distance));
    }
    return sum;
}

/* Where an agent goes that has a spot: nobody walks to the very spot, or all would shuffle for
   ever; who is near it keeps apart from others and shifts about. */
static JoxV2 point_near(const JoxMachineRun *run, const JoxGathering *entry, JoxV2 spot,
                        float spacing) {
    const JoxAgents *a = run->agents;
    const uint32_t i = entry->agent;
    const JoxV2 at = {a->x[i], a->y[i]}, way = jox_sub(spot, at), room = find_room(run, i, spacing);
    const float distance = jox_length(way), near = entry->outside ? 0.0f : NEAR * spacing;
    JoxV2 to = jox_scale(sway(run, a->id[i]), SHIFT);
    if (distance > near)
        to = jox_scale(way, (distance - near) / distance);
    return jox_add(at, jox_add(to, room));
}

static void give_row(JoxMachineRun *run, const JoxGatherPlace *g, uint32_t row,
                     const JoxGathering *entries, uint32_t count) {
    JoxMachineScratch *s = run->scratch;
    const JoxV2 *spots = g->spots.at + g->spots.row_first[row], left = jox_left(g->ahead);
    const uint32_t room = g->spots.row_first[row + 1] - g->spots.row_first[row];
    const float most = (float)(room - count), spacing = spacing_of(g->level);
    Block *blocks = s->gather_blocks;
    uint32_t n = 0;
    JOX_ASSERT(count <= room);
    for (uint32_t k = 0; k < count; k++) {
        blocks[n++] = (Block){nearest_spot(spots, room, left, entries[k].across) - (float)k, 1};
        for (; n > 1 && blocks[n - 2].sum * (float)blocks[n - 1].count >
                            blocks[n - 1].sum * (float)blocks[n - 2].count;
             n--) {
            blocks[n - 2].sum += blocks[n - 1].sum;
            blocks[n - 2].count += blocks[n - 1].count;
        }
    }
    for (uint32_t b = 0, k = 0; b < n; b++) {
        const float mean = floorf(blocks[b].sum / (float)blocks[b].count + 0.5f);
        const uint32_t shift = (uint32_t)jox_clampf(mean, 0.0f, most);
        for (uint32_t m = 0; m < blocks[b].count; m++, k++)
            s->row[entries[k].agent] = point_near(run, &entries[k], spots[k + shift], spacing);
    }
}

/* Those of one place, by turn. Those for whom there is no spot stay. */
static void give_spots(JoxMachineRun *run, JoxGathering *entries, uint32_t count) {
    JoxMachineScratch *s = run->scratch;
    JoxGatherPlace *g = find_place(run, entries->place, entries->front);
    lay_for(run, g, count + count / 32 + 1);
    uint32_t given = 0;
    for (uint32_t row = 0; row < g->spots.row_count && given < count; row++) {
        const uint32_t room = g->spots.row_first[row + 1] - g->spots.row_first[row];
        const uint32_t here = count - given < room ? count - given : room;
        jox_sort(entries + given, here, sizeof *entries, by_across, NULL,
                 s->gathered + s->gather_capacity);
        give_row(run, g, row, entries + given, here);
        given += here;
    }
    for (; given < count; given++) { /* there is no spot for them: they stand where they are */
        const uint32_t i = entries[given].agent;
        s->row[i] = point_near(run, &entries[given], s->row[i], spacing_of(g->level));
    }
}

static uint32_t find_gathered(JoxMachineRun *run) {
    JoxMachineScratch *s = run->scratch;
    const JoxAgents *a = run->agents;
    uint32_t count = 0;
    for (uint32_t b = 0; b < s->batch_count; b++) {
        const JoxBatchRange *batch = &s->batches[b];
        const JoxSteerTerm *term =
            jox_gather_term(&run->set->items[batch->machine]->states[batch->state]);
        if (!term)
            continue;
        if (s->gather_capacity < s->capacity) {
            s->gather_capacity = s->capacity;
            s->gathered = jox_realloc(s->gathered, s->capacity + JOX_SORT_SPARE(s->capacity),
                                      sizeof *s->gathered);
            s->gather_blocks = jox_realloc(s->gather_blocks, s->capacity, sizeof(Block));
        }
        for (uint32_t n = 0; n < batch->count; n++) {
            const uint32_t i = s->grouped[batch->begin + n];
            JOX_ASSERT(count < s->gather_capacity);
            s->row[i] = (JoxV2){a->x[i], a->y[i]};
            count += find_area(run, i, term, &s->gathered[count]);
        }
    }
    return count;
}

void jox_gatherings_form(JoxMachineRun *run) {
    JoxMachineScratch *s = run->scratch;
    const uint32_t count = find_gathered(run);
    if (!count)
        return;
    jox_sort(s->gathered, count, sizeof *s->gathered, by_turn, NULL,
             s->gathered + s->gather_capacity);
    for (uint32_t first = 0, last; first < count; first = last) {
        const JoxGathering *g = &s->gathered[first];
        for (last = first + 1; last < count; last++)
            if (s->gathered[last].place != g->place || s->gathered[last].front != g->front)
                break;
        give_spots(run, s->gathered + first, last - first);
    }
}

void jox_gatherings_forget(JoxMachineScratch *s) {
    for (uint32_t k = 0; k < s->gather_count; k++)
        s->gather_places[k].from++;
}

void jox_gatherings_free(JoxMachineScratch *s) {
    for (uint32_t k = 0; k < s->gather_count; k++)
        jox_lattice_free(&s->gather_places[k].spots);
    jox_free(s->gather_places);
    jox_free(s->gathered);
    jox_free(s->gather_blocks);
}
