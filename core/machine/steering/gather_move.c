/* Moves agents that gather to their spots, and keeps them apart there. Called by gather.c. */
#include <math.h>

#include "base/number/random.h"
#include "machine/gather.h"

static const float NEAR = 0.3f;       /* spacings: an agent this near to its spot has arrived */
static const float APART = 0.8f;      /* spacings: an agent nearer than that is too near */
static const float LITTLE = 0.03f;    /* m: an agent without a spot ignores less */
static const float SHIFT = 0.02f;     /* m: how far a standing agent shifts */
static const double SWAY_TIME = 12.0; /* s between two directions of shifting */
static const float HINDERED =
    0.25f;                          /* share of the wanted speed below which an agent is hindered */
static const float GAIN = 0.25f;    /* m2: least saving of an exchange, of squared ways */
enum { MOST_ASKED = 8, PAUSE = 4 }; /* neighbours looked at; steps between looks */

void jox_gather_find_way(const JoxMachineRun *run, JoxStandable *ground, JoxGathering *entry) {
    const JoxAgents *a = run->agents;
    const JoxV2 at = {a->x[entry->agent], a->y[entry->agent]};
    entry->way = jox_standable_way(ground, at, entry->spot, &entry->next);
}

/* ---- exchange of turns ---- */

/* Returns the way of an agent to the spot of `owner`, m, less `near`; 0 if the owner has none. */
static float find_remaining_way(const JoxMachineRun *run, JoxStandable *ground,
                                const JoxGathering *entry, const JoxGathering *owner, float near) {
    const JoxAgents *a = run->agents;
    JoxV2 next;
    if (!owner->has_spot)
        return 0.0f;
    const float way =
        entry == owner ? entry->way
                       : jox_standable_way(ground, jox_v2(a->x[entry->agent], a->y[entry->agent]),
                                           owner->spot, &next);
    return jox_maxf(0.0f, way - near);
}

/* Returns whether an agent on its way to its spot is much slower than it wants to be. */
static bool is_hindered(const JoxMachineRun *run, const JoxGathering *entry, float near) {
    const JoxAgents *a = run->agents;
    const uint32_t i = entry->agent;
    if (!entry->has_spot || !(entry->way > near + 0.5f * near))
        return false;
    const JoxV2 way = jox_unit(jox_sub(entry->next, jox_v2(a->x[i], a->y[i])));
    return a->vx[i] * way.x + a->vy[i] * way.y < HINDERED * jox_param(a, JOX_PARAM_speed, i);
}

/* Returns the saving, m2, if two agents exchange their spots. Ways are squared: several short moves
   are preferred to one long move past the others. */
static float find_gain(const JoxMachineRun *run, JoxStandable *ground, const JoxGathering *one,
                       const JoxGathering *other, float near) {
    const float own = find_remaining_way(run, ground, one, one, near);
    const float theirs = find_remaining_way(run, ground, other, other, near);
    const float to_theirs = find_remaining_way(run, ground, one, other, near);
    const float to_own = find_remaining_way(run, ground, other, one, near);
    return own * own + theirs * theirs - to_theirs * to_theirs - to_own * to_own;
}

static void swap_turns(JoxMachineRun *run, JoxGathering *one, JoxGathering *other) {
    uint32_t *turns = run->agents->turn;
    const uint32_t turn = one->turn;
    turns[one->agent] = one->turn = other->turn;
    turns[other->agent] = other->turn = turn;
}

void jox_gather_exchange(JoxMachineRun *run, JoxStandable *ground, JoxGathering *entries,
                         uint32_t count, float spacing) {
    const JoxMachineScratch *s = run->scratch;
    const JoxNeighbours *n = run->neighbours;
    const float near = NEAR * spacing;
    for (uint32_t k = 0; k < count; k++) {
        JoxGathering *entry = &entries[k], *best = NULL;
        const uint32_t i = entry->agent;
        float most = GAIN;
        if ((run->tick + entry->id) % PAUSE != 0 || !is_hindered(run, entry, near))
            continue;
        for (uint32_t m = 0; m < n->count[i] && m < MOST_ASKED; m++) {
            const uint32_t j = n->index[jox_neighbour_at(n, i, m)];
            const uint32_t number = s->gather_number[j];
            if (number >= count || entries[number].agent != j)
                continue;
            JoxGathering *other = &entries[number];
            if (other->has_spot && other->row == entry->row)
                continue;
            const float gain = find_gain(run, ground, entry, other, near);
            if (gain > most) {
                most = gain;
                best = other;
            }
        }
        if (best)
            swap_turns(run, entry, best);
    }
}

/* ---- points to head for ---- */

/* Returns a direction that turns slowly, of length 1 at most. */
static JoxV2 find_sway(const JoxMachineRun *run, uint32_t id) {
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

/* Returns the move away from neighbours that are nearer than `apart`, m. */
static JoxV2 find_elbow_room(const JoxMachineRun *run, uint32_t i, float apart) {
    const JoxNeighbours *n = run->neighbours;
    JoxV2 sum = {0.0f, 0.0f};
    for (uint32_t k = 0; k < n->count[i]; k++) {
        const JoxV2 to = jox_offset(run->agents, i, n->index[jox_neighbour_at(n, i, k)]);
        const float distance = jox_length(to), missing = apart - distance;
        if (missing <= 0.0f) /* neighbours are sorted by distance */
            break;
        if (distance > 0.0f)
            sum = jox_sub(sum, jox_scale(to, 0.5f * missing / distance));
    }
    return sum;
}

/* Agents stop short of the exact spot, else all would shuffle for ever. Near it they keep apart and
   shift about; without a spot they only keep apart. */
JoxV2 jox_gather_point(const JoxMachineRun *run, const JoxGathering *entry, float spacing) {
    const JoxAgents *a = run->agents;
    const uint32_t i = entry->agent;
    const JoxV2 at = {a->x[i], a->y[i]};
    const JoxV2 room = find_elbow_room(run, i, APART * spacing);
    if (!entry->has_spot)
        return jox_length(room) > LITTLE ? jox_add(at, room) : at;
    const float near = entry->outside ? 0.0f : NEAR * spacing;
    JoxV2 to = jox_scale(find_sway(run, entry->id), SHIFT);
    if (entry->way > near)
        to = jox_scale(jox_unit(jox_sub(entry->next, at)), entry->way - near);
    return jox_add(at, jox_add(to, room));
}

/* Follows the field to the place; straight while there is none yet. */
JoxV2 jox_gather_approach(const JoxMachineRun *run, const JoxGathering *entry) {
    const JoxAgents *a = run->agents;
    const uint32_t place = (uint32_t)entry->place;
    const JoxV2 at = {a->x[entry->agent], a->y[entry->agent]};
    if (!entry->outside)
        return at;
    if (!run->fields)
        return jox_place_nearest(run->places, place, at);
    run->wanted[place] |= 1 << JOX_ROUTE_NOW;
    const JoxField *field = run->fields[place * JOX_ROUTE_KINDS + JOX_ROUTE_NOW];
    if (!field)
        return jox_place_nearest(run->places, place, at);
    const float way = jox_field_distance(field, at);
    return way < INFINITY ? jox_add(at, jox_scale(jox_field_direction(field, at), way)) : at;
}
