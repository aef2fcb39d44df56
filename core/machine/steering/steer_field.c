/* The steering term `field`, by batch: shortest ways round walls and large bodies, from distance
   fields. Also finds the goals that fields must be made for. */
#include <math.h>

#include "base/assert.h"
#include "machine/kernels.h"
#include "machine/lifts.h"

#define X(name, isa) [isa] = jox_field_look_##name,
static JoxFieldKernel *const LOOK[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

/* The agents of a batch that head for one place. */
typedef struct Asking {
    const JoxMachineRun *run;
    const JoxSteerTerm *term;
    JoxSteer *s;
    uint32_t place;
    uint8_t number[JOX_BATCH]; /* index of each agent in the batch */
    JoxFieldPoints now, other; /* lookups in the field NOW, and in another kind */
} Asking;
_Static_assert(JOX_BATCH - 1 <= UINT8_MAX && JOX_BATCH <= (int)JOX_FIELD_POINTS,
               "room for a batch");

/* Returns a field, NULL if there is none yet, and requests it, so that it is made and renewed. The
   order of threads does not affect the result. */
static const JoxField *request_field(const Asking *q, JoxRouteKind kind) {
    const JoxMachineRun *run = q->run;
    const uint8_t bit = (uint8_t)(1 << kind);
    if (!(__atomic_load_n(&run->wanted[q->place], __ATOMIC_RELAXED) & bit))
        __atomic_fetch_or(&run->wanted[q->place], bit, __ATOMIC_RELAXED);
    return run->fields[q->place * JOX_ROUTE_KINDS + kind];
}

/* Stores the place that a walker is bound for and the way left, m; the walking law ranks agents by
   it. */
static void store_bound_place(const Asking *q, uint32_t k, const JoxField *field, float way) {
    JoxAgents *a = q->run->agents;
    const uint32_t i = q->s->index[q->number[k]];
    if (!jox_walks(a, i) || !field)
        return;
    a->bound[i] = jox_reference((int32_t)q->place);
    a->way_left[i] = way;
}

bool jox_is_place_elsewhere(const JoxMachineRun *run, uint32_t index, JoxV2 at) {
    const JoxPlace *place = &run->places[index];
    return (place->count == 0 && place->member_count == 0) ||
           jox_leads_off_sheet(run->agents->storeys, at, jox_place_nearest(run->places, index, at));
}

/* Returns the direction straight to the place, (0, 0) in it. */
static JoxV2 find_straight_way(const Asking *q, uint32_t i) {
    const JoxV2 at = {q->run->agents->x[i], q->run->agents->y[i]};
    return jox_unit(jox_sub(jox_place_nearest(q->run->places, q->place, at), at));
}

/* Writes the direction of an agent; straight towards the target where no way is known. */
static void write_way(const Asking *q, uint32_t k, JoxV2 direction) {
    JoxSteer *s = q->s;
    const uint32_t n = q->number[k];
    const JoxAgents *a = q->run->agents;
    const JoxV2 at = {a->x[s->index[n]], a->y[s->index[n]]};
    if (!(jox_length2(direction) > 0.0f) &&
        !(a->storeys && jox_is_place_elsewhere(q->run, q->place, at)))
        direction = q->term->kind == JOX_STEER_RIDE
                        ? find_straight_way(q, s->index[n])
                        : jox_steer_seek(q->run, s->index[n], q->term->target);
    s->way_x[n] = direction.x;
    s->way_y[n] = direction.y;
}

static void look_up_ways(const Asking *q, const JoxField *field, JoxFieldPoints *points) {
    if (points->count)
        LOOK[jox_isa_resolve(q->run->isa)](field, points);
}

/* Looks up another kind of field for agents with `asks` set. `at`: index in q->other of each agent,
   or UINT32_MAX. */
static const JoxField *look_up_other_field(Asking *q, JoxRouteKind kind, const bool *asks,
                                           uint32_t *at) {
    JoxFieldPoints *other = &q->other;
    other->count = 0;
    for (uint32_t k = 0; k < q->now.count; k++) {
        at[k] = UINT32_MAX;
        if (!asks[k])
            continue;
        at[k] = other->count;
        other->x[other->count] = q->now.x[k];
        other->y[other->count++] = q->now.y[k];
    }
    const JoxField *field = other->count ? request_field(q, kind) : NULL;
    if (field)
        look_up_ways(q, field, other);
    return field;
}

/* Directs agents by the field NOW, or by CROWD under the walking law. Agents that NOW does not
   reach use OPEN. */
static void lead_by_fields(Asking *q) {
    const JoxAgents *a = q->run->agents;
    const JoxField *now = request_field(q, JOX_ROUTE_NOW);
    JoxFieldPoints *p = &q->now;
    bool asks[JOX_BATCH], shut[JOX_BATCH];
    uint32_t at[JOX_BATCH];
    if (now)
        look_up_ways(q, now, p);
    for (uint32_t k = 0; k < p->count; k++) {
        const JoxV2 way = {p->way_x[k], p->way_y[k]};
        shut[k] = now && jox_length2(way) == 0.0f && !(p->length[k] < INFINITY);
        asks[k] = !shut[k] && jox_walks(a, q->s->index[q->number[k]]);
    }
    const JoxField *crowd = look_up_other_field(q, JOX_ROUTE_CROWD, asks, at);
    for (uint32_t k = 0; k < p->count; k++) {
        JoxV2 way = now ? (JoxV2){p->way_x[k], p->way_y[k]} : (JoxV2){0.0f, 0.0f};
        if (shut[k])
            continue;
        if (crowd && at[k] != UINT32_MAX) {
            const JoxV2 round = {q->other.way_x[at[k]], q->other.way_y[at[k]]};
            way = jox_length2(round) > 0.0f ? round : way;
        }
        store_bound_place(q, k, now, now ? p->length[k] : 0.0f);
        write_way(q, k, way);
    }
    const JoxField *open = look_up_other_field(q, JOX_ROUTE_OPEN, shut, at);
    for (uint32_t k = 0; k < p->count; k++) {
        if (!shut[k])
            continue;
        JoxV2 way = {0.0f, 0.0f};
        if (open)
            way = (JoxV2){q->other.way_x[at[k]], q->other.way_y[at[k]]};
        store_bound_place(q, k, open, open ? q->other.length[at[k]] : 0.0f);
        write_way(q, k, way);
    }
}

/* Directs all agents from `first` on that head for the same place as that one; those that reached
   it stand still. */
static void lead_to_place(Asking *q, int32_t *places, uint32_t first) {
    const JoxMachineRun *run = q->run;
    const JoxAgents *a = run->agents;
    const int32_t place = places[first];
    JoxV2 at[JOX_BATCH];
    uint8_t number[JOX_BATCH]; /* index in the batch */
    bool there[JOX_BATCH];
    uint32_t count = 0;
    for (uint32_t n = first; n < q->s->count; n++) {
        if (places[n] != place)
            continue;
        places[n] = -1;
        at[count] = (JoxV2){a->x[q->s->index[n]], a->y[q->s->index[n]]};
        number[count++] = (uint8_t)n;
    }
    jox_place_is_arrival_each(run->places, (uint32_t)place, run->walls, at, count, there);
    q->place = (uint32_t)place;
    q->now.count = 0;
    for (uint32_t n = 0; n < count; n++) {
        const uint32_t k = q->now.count;
        q->number[k] = number[n];
        if (!run->fields || there[n]) {
            write_way(q, k, (JoxV2){0.0f, 0.0f});
            continue;
        }
        q->now.x[k] = at[n].x;
        q->now.y[k] = at[n].y;
        q->now.count++;
    }
    if (q->now.count)
        lead_by_fields(q);
}

/* ---- over storeys ---- */

/* Returns the field of a place for agents that cannot use stairs, on foot or by lifts, requested;
   NULL: there is none yet. */
static const JoxField *request_stepless(Asking *q, int32_t place, JoxRouteKind kind) {
    q->place = (uint32_t)place;
    return request_field(q, kind);
}

/* Requests the field of a place by lifts for an agent that takes them and has farther to go than
   over its storey. */
static void request_way_by_lifts(Asking *q, uint32_t i, int32_t place) {
    const JoxMachineRun *run = q->run;
    const JoxV2 at = {run->agents->x[i], run->agents->y[i]};
    const float lifts = jox_param(run->agents, JOX_PARAM_lifts, i);
    const bool stepless = lifts > JOX_LIFTS_ONLY;
    if (!run->lifts || !run->fields || !(lifts > JOX_LIFTS_NEVER))
        return;
    const JoxField *walk =
        run->fields[place * JOX_ROUTE_KINDS + (stepless ? JOX_ROUTE_STEPLESS : JOX_ROUTE_NOW)];
    q->place = (uint32_t)place;
    if (jox_is_place_elsewhere(run, q->place, at) ||
        (walk && !(jox_field_distance(walk, at) < INFINITY)))
        request_field(q, stepless ? JOX_ROUTE_STEPLESS_LIFTS : JOX_ROUTE_LIFTS);
}

int32_t jox_find_refuge(const JoxMachineRun *run, JoxV2 at) {
    const JoxStoreys *storeys = run->agents->storeys;
    int32_t best = -1;
    float least = INFINITY;
    for (uint32_t p = 0; p < run->place_count; p++) {
        const JoxPlace *place = &run->places[p];
        if (!place->refuge || place->count == 0 ||
            jox_sheet_of(storeys, place->centre.y) != jox_sheet_of(storeys, at.y))
            continue;
        const float way = jox_length(jox_sub(jox_place_nearest(run->places, p, at), at));
        if (way < least) {
            least = way;
            best = (int32_t)p;
        }
    }
    return best;
}

/* Directs an agent without stairs: to its place, to the lift that it will take, to a refuge, or it
   stands. */
static void lead_without_stairs(Asking *q, uint32_t n, int32_t place) {
    const JoxMachineRun *run = q->run;
    const JoxAgents *a = run->agents;
    const uint32_t i = q->s->index[n];
    const JoxV2 at = {a->x[i], a->y[i]};
    const JoxField *field = run->fields ? request_stepless(q, place, JOX_ROUTE_STEPLESS) : NULL;
    q->number[0] = (uint8_t)n;
    if (field && !jox_place_is_arrival(run->places, (uint32_t)place, run->walls, at) &&
        !(jox_field_distance(field, at) < INFINITY)) {
        if (run->lifts)
            field = request_stepless(q, place, JOX_ROUTE_STEPLESS_LIFTS);
        if (!run->lifts || (field && !(jox_field_distance(field, at) < INFINITY))) {
            place = jox_find_refuge(run, at);
            field = place >= 0 ? request_stepless(q, place, JOX_ROUTE_STEPLESS) : NULL;
        }
    }
    if (!field || jox_place_is_arrival(run->places, (uint32_t)place, run->walls, at))
        return;
    const JoxV2 way = jox_field_direction(field, at);
    store_bound_place(q, 0, field, jox_field_distance(field, at));
    q->s->way_x[n] = way.x;
    q->s->way_y[n] = way.y;
}

/* Redirects agents that take a lift to a place by themselves: to its door by a field, or to where
   the lift wants them, and leads those that cannot use stairs. Both leave -1 in `left` where the
   way is written. */
static void lead_over_storeys(Asking *q, int32_t *left) {
    const JoxMachineRun *run = q->run;
    for (uint32_t n = 0; n < q->s->count; n++) {
        const uint32_t i = q->s->index[n];
        if (left[n] < 0)
            continue;
        const JoxRider *rider = jox_rider_find(run->lifts, run->agents->id[i]);
        const bool rides = rider && (rider->stray || (rider->itself && rider->goal == left[n]));
        request_way_by_lifts(q, i, left[n]);
        if (rides && rider->phase != JOX_RIDE_APPROACH) {
            jox_steer_rider(run, rider, q->s, n);
            left[n] = -1;
            continue;
        }
        if (rides)
            left[n] = run->lifts->lifts[rider->lift].stops[rider->from].place;
        if (jox_param(run->agents, JOX_PARAM_lifts, i) > JOX_LIFTS_ONLY) {
            lead_without_stairs(q, n, left[n]);
            left[n] = -1;
        }
    }
}

void jox_steer_to_places(const JoxMachineRun *run, const JoxSteerTerm *term, JoxSteer *s,
                         const int32_t *places) {
    int32_t left[JOX_BATCH];
    Asking q; /* arrays are filled as far as they are read */
    q.run = run;
    q.term = term;
    q.s = s;
    JOX_ASSERT(s->count <= JOX_BATCH);
    for (uint32_t n = 0; n < s->count; n++) {
        s->way_x[n] = s->way_y[n] = 0.0f;
        left[n] = jox_weight_counts(s->by[n]) ? places[n] : -1;
    }
    if (run->agents->storeys)
        lead_over_storeys(&q, left);
    for (uint32_t n = 0; n < s->count; n++)
        if (left[n] >= 0)
            lead_to_place(&q, left, n);
}

/* Directs the agents of a batch whose target is a place; the others get no way. `places`: of each
   agent, -1 for what is no place. */
static void lead_to_places(const JoxMachineRun *run, const JoxMachine *machine,
                           const JoxSteerTerm *term, JoxSteer *s, int32_t *places) {
    if (term->kind == JOX_STEER_RIDE)
        for (uint32_t n = 0; n < s->count; n++)
            places[n] = jox_ride_approach(run, s->index[n],
                                          jox_target_place(run, s->index[n], term->target));
    else
        jox_target_places(run, machine, term->target, s->index, s->count, places);
    jox_steer_to_places(run, term, s, places);
}

void jox_steer_field(const JoxMachineRun *run, const JoxMachine *machine, const JoxSteerTerm *term,
                     JoxSteer *s) {
    int32_t places[JOX_BATCH];
    lead_to_places(run, machine, term, s, places);
    for (uint32_t n = 0; n < s->count; n++) {
        if (places[n] >= 0 || !jox_weight_counts(s->by[n]))
            continue;
        const JoxV2 way = jox_steer_lead(run, machine, term, s->index[n]);
        s->way_x[n] = way.x;
        s->way_y[n] = way.y;
    }
}

void jox_machines_ask_routes(JoxMachineRun *run) {
    const JoxAgents *a = run->agents;
    JoxSteer s = {.agents = run->agents, .count = 1, .by = {1.0f}};
    int32_t place;
    for (uint32_t i = 0; i < a->count; i++) {
        if (a->machine[i] == JOX_NO_MACHINE)
            continue;
        const JoxMachine *machine = jox_machine_of(run, i);
        const JoxState *state = &machine->states[a->state[i]];
        s.index[0] = i;
        for (uint32_t t = 0; t < state->steer_count; t++)
            if (state->steer[t].kind == JOX_STEER_RIDE ||
                (state->steer[t].kind == JOX_STEER_FIELD &&
                 !machine->targets[state->steer[t].target].score))
                lead_to_places(run, machine, &state->steer[t], &s, &place);
    }
}

uint32_t jox_machines_goals(const JoxMachineRun *run, uint32_t i, int32_t *places, uint32_t most) {
    const JoxMachine *machine = jox_machine_of(run, i);
    uint32_t count = 0;
    for (uint32_t s = 0; s < machine->state_count; s++)
        for (uint32_t t = 0; t < machine->states[s].steer_count && count < most; t++) {
            const int32_t index = machine->states[s].steer[t].target;
            if (machine->states[s].steer[t].kind != JOX_STEER_FIELD || index < 0 ||
                (machine->targets[index].kind != JOX_TARGET_PLACE &&
                 machine->targets[index].kind != JOX_TARGET_OWN_PLACE))
                continue;
            places[count] = jox_target_place(run, i, index);
            count += places[count] >= 0;
        }
    return count;
}

/* Returns whether a field exists and leads nowhere from a point. */
static bool leads_nowhere(const JoxField *field, JoxV2 from) {
    return field && !(jox_field_distance(field, from) < INFINITY);
}

/* Returns whether no way that an agent takes leads to a place, on foot or by lifts, with gates as
   they stand. */
static bool seems_shut(const JoxMachineRun *run, uint32_t i, int32_t place) {
    const JoxV2 from = {run->agents->x[i], run->agents->y[i]};
    const JoxAgentWays ways = jox_agent_ways(run->agents, i);
    JoxField *const *fields = &run->fields[(uint32_t)place * JOX_ROUTE_KINDS];
    const JoxField *by_lifts = ways == JOX_WAYS_STEPLESS ? fields[JOX_ROUTE_STEPLESS_LIFTS]
                               : ways == JOX_WAYS_EITHER ? fields[JOX_ROUTE_LIFTS]
                                                         : NULL;
    return leads_nowhere(fields[ways == JOX_WAYS_STEPLESS ? JOX_ROUTE_STEPLESS : JOX_ROUTE_NOW],
                         from) &&
           (!by_lifts || leads_nowhere(by_lifts, from));
}

/* Returns the n-th place that an agent heads for by a field and has not reached; -1: there are
   fewer. */
static int32_t find_field_goal(const JoxMachineRun *run, uint32_t i, uint32_t n) {
    const JoxAgents *a = run->agents;
    if (!run->fields || a->machine[i] == JOX_NO_MACHINE)
        return -1;
    const JoxState *state = &jox_machine_of(run, i)->states[a->state[i]];
    const JoxV2 p = {a->x[i], a->y[i]};
    for (uint32_t t = 0; t < state->steer_count; t++) {
        if (state->steer[t].kind != JOX_STEER_FIELD)
            continue;
        const int32_t place = jox_target_place(run, i, state->steer[t].target);
        if (place >= 0 && !jox_place_is_arrival(run->places, (uint32_t)place, run->walls, p) &&
            n-- == 0)
            return place;
    }
    return -1;
}

int32_t jox_machines_field_goal(const JoxMachineRun *run, uint32_t i, bool *shut) {
    const int32_t place = find_field_goal(run, i, 0);
    if (shut)
        *shut = place >= 0 && !jox_rider_find(run->lifts, run->agents->id[i]) &&
                seems_shut(run, i, place);
    return place;
}

int32_t jox_machines_no_way(const JoxMachineRun *run, uint32_t i) {
    const JoxV2 p = {run->agents->x[i], run->agents->y[i]};
    int32_t place;
    const bool stepless = jox_agent_ways(run->agents, i) == JOX_WAYS_STEPLESS;
    if (jox_rider_find(run->lifts, run->agents->id[i])) /* a lift leads there */
        return -1;
    for (uint32_t n = 0; (place = find_field_goal(run, i, n)) >= 0; n++) {
        const JoxField *open = run->fields[(uint32_t)place * JOX_ROUTE_KINDS + JOX_ROUTE_OPEN];
        if (seems_shut(run, i, place) && (stepless || !open || leads_nowhere(open, p)))
            return place;
    }
    return -1;
}
