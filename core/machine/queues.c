/* Queues: the order of those who steer in one. An agent takes the next place when it comes to the
   queue, anywhere from its head to its end, and keeps its turn through all states that queue there.
   So nobody is waited for who is still on the way, and in a lane those ahead go first. */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "base/sort.h"
#include "machine/machine_parts.h"
#include "machine/way_between.h"

#define COMES_TO 1.0f /* m: an agent this near to a queue takes its place */
#define HELD_UP 3.0f  /* s: an agent that has not moved for this time takes a place twice as far */
/* An agent stands in the way of another that is beside it if it is nearer to the other's spot. */
#define BESIDE 0.1f /* m: gap */
#define AHEAD 0.3f  /* spacings */

int16_t jox_queue_target(const JoxState *state) {
    for (uint32_t t = 0; t < state->steer_count; t++)
        if (state->steer[t].kind == JOX_STEER_QUEUE)
            return state->steer[t].target;
    return -1;
}

/* Orders agents by queue, turn, id; those who have no turn yet are the last of a queue. */
static int compare_queue_turns(const void *first, const void *second, const void *context) {
    const JoxMachineRun *run = context;
    const JoxMachineScratch *s = run->scratch;
    const JoxAgents *a = run->agents;
    const uint32_t i = *(const uint32_t *)first, j = *(const uint32_t *)second;
    if (s->queue[i] != s->queue[j])
        return s->queue[i] < s->queue[j] ? -1 : 1;
    if (a->queued[i] != a->queued[j])
        return a->queued[i] < a->queued[j] ? -1 : 1;
    return (a->id[i] > a->id[j]) - (a->id[i] < a->id[j]);
}

/* Lists the agents that queue, by queue and turn. `settles`: those that come to another queue lose
   their turn; else they are left out. */
static uint32_t list_queues(JoxMachineRun *run, bool settles) {
    JoxMachineScratch *s = run->scratch;
    JoxAgents *a = run->agents;
    uint32_t count = 0, *list = s->list;
    if (run->place_count > s->place_capacity) {
        s->place_capacity = run->place_count + 16;
        s->place_people = jox_realloc(s->place_people, s->place_capacity, sizeof(uint32_t));
        s->place_queue = jox_realloc(s->place_queue, s->place_capacity, sizeof(uint32_t));
    }
    if (run->place_count)
        memset(s->place_queue, 0, run->place_count * sizeof *s->place_queue);
    for (uint32_t b = 0; b < s->batch_count; b++) {
        const JoxBatchRange *batch = &s->batches[b];
        int16_t target = jox_queue_target(&run->set->items[batch->machine]->states[batch->state]);
        for (uint32_t n = 0; target >= 0 && n < batch->count; n++) {
            uint32_t i = s->grouped[batch->begin + n];
            s->queue[i] = jox_target_place(run, i, target);
            const uint32_t at = jox_reference(s->queue[i]);
            if (!settles && a->queue_at[i] != at)
                continue;
            if (a->queue_at[i] != at || !at) { /* without a place there is no turn */
                a->queue_at[i] = at;
                a->queued[i] = JOX_NO_TURN;
            }
            if (s->queue[i] >= 0)
                s->place_queue[s->queue[i]]++;
            list[count++] = i;
        }
    }
    jox_sort(list, count, sizeof *list, compare_queue_turns, run, s->spare);
    return count;
}

/* Returns the point of a queue, as far as `end` m behind its head, that is nearest to a point. */
static JoxV2 find_nearest_in_queue(const JoxPlace *queue, float end, JoxV2 at) {
    JoxV2 best = queue->points[0];
    float begin = 0.0f;
    for (uint32_t k = 0; k + 1 < queue->count && begin < end; k++) {
        const JoxV2 from = queue->points[k];
        const float length = jox_length(jox_sub(queue->points[k + 1], from));
        const JoxV2 to = jox_place_queue_point(queue, jox_minf(begin + length, end));
        const JoxV2 nearest = jox_segment_nearest(from, to, at);
        if (jox_length2(jox_sub(nearest, at)) < jox_length2(jox_sub(best, at)))
            best = nearest;
        begin += length;
    }
    return best;
}

/* Gives the next place to the agent that is nearest to a queue, or to another place at which people
   queue, of `count` without one. */
static void give_place(JoxMachineRun *run, uint32_t place, uint32_t rank, const uint32_t *list,
                       uint32_t count) {
    const JoxAgents *a = run->agents;
    const JoxPlace *queue = &run->places[place];
    uint32_t nearest = JOX_NO_INDEX;
    float least = INFINITY;
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t i = list[k];
        const JoxV2 at = {a->x[i], a->y[i]};
        const JoxV2 to = jox_place_is_queue(queue)
                             ? find_nearest_in_queue(queue, (float)rank * queue->spacing, at)
                             : jox_place_nearest(run->places, place, at);
        const float way = jox_length(jox_sub(to, at));
        if (way < least && way <= (a->still[i] > HELD_UP ? 2.0f * COMES_TO : COMES_TO) &&
            !jox_is_hidden(run, at, to, true)) {
            least = way;
            nearest = i;
        }
    }
    if (nearest != JOX_NO_INDEX)
        run->agents->queued[nearest] = run->tick;
}

/* Exchanges the turns of two agents of a queue if the second stands in the way of the first, and
   neither moves: nearer to the spot of `rank`, the first's, and beside it. Returns whether it did.
 */
static bool exchange_turns(JoxMachineRun *run, const JoxPlace *queue, uint32_t rank, uint32_t first,
                           uint32_t second) {
    JoxAgents *a = run->agents;
    const JoxV2 spot = jox_place_queue_point(queue, (float)rank * queue->spacing);
    const float way = jox_length(jox_sub(spot, jox_v2(a->x[first], a->y[first])));
    const float others = jox_length(jox_sub(spot, jox_v2(a->x[second], a->y[second])));
    const float radii =
        jox_param(a, JOX_PARAM_radius, first) + jox_param(a, JOX_PARAM_radius, second);
    if (a->still[first] <= HELD_UP || a->still[second] <= HELD_UP ||
        others >= way - AHEAD * queue->spacing ||
        jox_length(jox_way_between(a, first, second)) > radii + BESIDE)
        return false;
    const uint32_t turn = a->queued[first];
    a->queued[first] = a->queued[second];
    a->queued[second] = turn;
    return true;
}

void jox_queues_look(JoxMachineRun *run) {
    JoxMachineScratch *s = run->scratch;
    const uint32_t count = list_queues(run, false);
    for (uint32_t k = 0; k < count; k++) {
        const bool first = k == 0 || s->queue[s->list[k]] != s->queue[s->list[k - 1]];
        s->rank[s->list[k]] = first ? 0 : s->rank[s->list[k - 1]] + 1;
    }
}

void jox_queues_rank(JoxMachineRun *run) {
    JoxMachineScratch *s = run->scratch;
    const JoxAgents *a = run->agents;
    const uint32_t count = list_queues(run, true), *list = s->list;
    for (uint32_t first = 0, end; first < count; first = end) {
        const int32_t place = s->queue[list[first]];
        uint32_t turns = 0;
        for (end = first; end < count && s->queue[list[end]] == place; end++) {
            s->rank[list[end]] = turns;
            turns += a->queued[list[end]] != JOX_NO_TURN;
        }
        if (place < 0)
            continue;
        const bool has_spots = jox_place_is_queue(&run->places[place]);
        for (uint32_t rank = 0; has_spots && rank + 1 < turns; rank++)
            rank += exchange_turns(run, &run->places[place], rank, list[first + rank],
                                   list[first + rank + 1]);
        if (first + turns < end && (!turns || a->queued[list[first + turns - 1]] < run->tick))
            give_place(run, (uint32_t)place, turns, list + first + turns, end - first - turns);
    }
    JOX_CHECK(jox_queues_check(run, list, count));
}
