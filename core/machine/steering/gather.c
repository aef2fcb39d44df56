/* The steering term `gather`: agents that wait in an area fill it from its front, spread as far as
   there is room, and close up as more come in. Each agent has a turn from its arrival: earlier
   before later, nearer to the front before farther. Spots are assigned row by row in order of turn,
   and within a row in the order in which the agents stand across, so that few ways cross. Agents
   that are hindered on their way exchange turns with neighbours (gather_move.c). */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "base/number/pi.h"
#include "base/sort.h"
#include "machine/gather.h"

static const double TURN_TIME = 5.0; /* s: arrivals within it are ordered by distance from the
                                        front */
static const float BREADTHS = 1.2f;  /* least spacing, in mean diameters of the agents */

static JoxV2 find_direction(float degrees) {
    return jox_v2((float)jox_cos(degrees * JOX_DEGREE), (float)jox_sin(degrees * JOX_DEGREE));
}

/* Returns the turn of an agent that begins to gather: the number of its time span, and within it
   the distance from the front, cm. Never 0. */
static uint32_t find_turn(const JoxMachineRun *run, const JoxPlace *place, JoxV2 at, JoxV2 ahead) {
    const double span = run->tick * run->dt / TURN_TIME;
    float front = -INFINITY;
    for (uint32_t k = 0; k < place->count; k++)
        front = jox_maxf(front, jox_dot(place->points[k], ahead));
    const float centimetres = 100.0f * (front - jox_dot(at, ahead));
    return (uint32_t)(span < 65535.0 ? span : 65535.0) << 16 |
           (uint32_t)jox_clampf(centimetres, 1.0f, 65535.0f);
}

/* Fills the entry of an agent; false if the target is no area, and the agent stands where it is. */
static bool find_area(JoxMachineRun *run, uint32_t i, const JoxSteerTerm *term, JoxGathering *out) {
    const JoxAgents *a = run->agents;
    const int32_t index = jox_target_place(run, i, term->target);
    const JoxV2 at = {a->x[i], a->y[i]};
    if (index < 0 || !jox_place_is_area(&run->places[index]))
        return false;
    const JoxV2 ahead = find_direction((float)term->args[0]);
    if (!a->turn[i])
        run->agents->turn[i] = find_turn(run, &run->places[index], at, ahead);
    const JoxStandable *cells = &jox_gather_ground(run, index)->cells;
    *out = (JoxGathering){.agent = i,
                          .id = a->id[i],
                          .place = index,
                          .front = (float)term->args[0],
                          .spreads = term->args[1] != 0.0,
                          .part = jox_standable_part(cells, jox_standable_cell(cells, at)),
                          .turn = a->turn[i],
                          .outside = !jox_place_contains(run->places, (uint32_t)index, at),
                          .across = jox_dot(at, jox_left(ahead))};
    return true;
}

static int compare_gather_turns(const void *left, const void *right, const void *context) {
    const JoxGathering *a = left, *b = right;
    (void)context;
    if (a->place != b->place)
        return a->place < b->place ? -1 : 1;
    if (a->front != b->front)
        return a->front < b->front ? -1 : 1;
    if (a->spreads != b->spreads)
        return a->spreads ? 1 : -1;
    if (a->part != b->part)
        return a->part < b->part ? -1 : 1;
    if (a->turn != b->turn)
        return a->turn < b->turn ? -1 : 1;
    return (a->id > b->id) - (a->id < b->id);
}

static int compare_across(const void *left, const void *right, const void *context) {
    const JoxGathering *a = left, *b = right;
    (void)context;
    if (a->across != b->across)
        return a->across < b->across ? -1 : 1;
    return (a->id > b->id) - (a->id < b->id);
}

/* ---- assignment of spots ---- */

/* A run of agents in a row that get adjacent spots: isotonic regression keeps their order and
   minimises the ways. */
typedef struct Block {
    float sum; /* sum over its agents: index of the nearest spot less index in the row */
    uint32_t count;
} Block;

/* Returns the index of the spot in a row that is nearest to position `across`, m. */
static float find_nearest_spot(const JoxV2 *spots, uint32_t count, JoxV2 left, float across) {
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

/* Assigns the spots of one row to `count` agents, which are sorted across, so that the sum of
   squared distances is least. */
static void assign_row(JoxMachineRun *run, const JoxGatherPlace *g, uint32_t row,
                       JoxGathering *entries, uint32_t count) {
    JoxMachineScratch *s = run->scratch;
    const JoxV2 *spots = g->spots.at + g->spots.row_first[row], left = jox_left(g->ahead);
    const uint32_t room = g->spots.row_first[row + 1] - g->spots.row_first[row];
    const float most = (float)(room - count);
    Block *blocks = s->gather_blocks;
    uint32_t n = 0;
    JOX_ASSERT(count <= room);
    for (uint32_t k = 0; k < count; k++) {
        blocks[n++] =
            (Block){find_nearest_spot(spots, room, left, entries[k].across) - (float)k, 1};
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
        for (uint32_t m = 0; m < blocks[b].count; m++, k++) {
            entries[k].has_spot = true;
            entries[k].row = row;
            entries[k].spot = spots[k + shift];
        }
    }
}

/* Returns the least spacing of some agents, m, from the mean square of their diameters. */
static float find_least_spacing(const JoxMachineRun *run, const JoxGathering *entries,
                                uint32_t count) {
    double sum2 = 0.0;
    for (uint32_t k = 0; k < count; k++) {
        const double radius = jox_param(run->agents, JOX_PARAM_radius, entries[k].agent);
        sum2 += radius * radius;
    }
    return BREADTHS * 2.0f * (float)sqrt(sum2 / count);
}

/* Assigns spots to the agents of one part of a place, which are sorted by turn. */
static void assign_spots(JoxMachineRun *run, JoxGathering *entries, uint32_t count) {
    JoxMachineScratch *s = run->scratch;
    JoxStandable *cells = &jox_gather_ground(run, entries->place)->cells;
    const JoxGatherPlace *g =
        jox_gather_place(run, entries, count, find_least_spacing(run, entries, count));
    uint32_t given = 0;
    for (uint32_t row = 0; row < g->spots.row_count && given < count; row++) {
        const uint32_t room = g->spots.row_first[row + 1] - g->spots.row_first[row];
        const uint32_t here = count - given < room ? count - given : room;
        jox_sort(entries + given, here, sizeof *entries, compare_across, NULL,
                 s->gathered + s->gather_capacity);
        assign_row(run, g, row, entries + given, here);
        given += here;
    }
    run->without_spot += g->spots.count ? count - given : 0;
    for (uint32_t k = 0; k < count; k++) {
        s->gather_number[entries[k].agent] = k;
        if (entries[k].has_spot)
            jox_gather_find_way(run, cells, &entries[k]);
        s->row[entries[k].agent] = g->spots.count ? jox_gather_point(run, &entries[k], g->spacing)
                                                  : jox_gather_approach(run, &entries[k]);
    }
    jox_gather_exchange(run, cells, entries, count, g->spacing);
}

/* Lists all agents that gather in s->gathered, and returns their number. */
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
            s->gather_number = jox_realloc(s->gather_number, s->capacity, sizeof *s->gather_number);
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
    for (uint32_t k = 0; k < s->ground_count; k++)
        s->gather_grounds[k].checked = false;
    const uint32_t count = find_gathered(run);
    run->without_spot = 0;
    if (!count)
        return;
    jox_sort(s->gathered, count, sizeof *s->gathered, compare_gather_turns, NULL,
             s->gathered + s->gather_capacity);
    for (uint32_t first = 0, last; first < count; first = last) {
        const JoxGathering *g = &s->gathered[first];
        for (last = first + 1; last < count; last++)
            if (s->gathered[last].place != g->place || s->gathered[last].front != g->front ||
                s->gathered[last].spreads != g->spreads || s->gathered[last].part != g->part)
                break;
        if (g->part)
            assign_spots(run, s->gathered + first, last - first);
        else
            for (uint32_t k = first; k < last; k++)
                s->row[s->gathered[k].agent] = jox_gather_approach(run, &s->gathered[k]);
    }
}
