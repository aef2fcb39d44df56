/* The list of agents that ride: those whose state rides, those that take a lift on their way, and
   those that are in a car when they change their mind; and their choice among the lifts of a set.
 */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "world/lift_parts.h"

/* Returns the seconds of a ride by jox_lift_estimate_ride, with the way to the door, straight. */
static double estimate_time(const JoWorld *w, uint32_t lift, uint32_t stop, JoxV2 at,
                            const JoxRider *rider) {
    const uint32_t from = jox_lift_near_stop(&w->scratch.lifts.view, lift, at);
    const JoxV2 door = jox_lift_outside(&w->model.lifts[lift], from, &w->model.storeys);
    return (double)jox_length(jox_sub(door, at)) / (double)JOX_LIFT_PACE +
           jox_lift_estimate_ride(w, lift, from, stop, rider);
}

/* Finds the lift and stop that an agent rides to: of a set, that which takes least time; another
   one than its own only if that saves time. */
static bool find_lift(const JoWorld *w, uint32_t i, int32_t goal, const JoxRider *rider, bool has,
                      uint32_t *lift, uint32_t *stop) {
    const JoxLiftView *view = &w->scratch.lifts.view;
    const JoxPlace *place = goal < 0 ? NULL : &w->model.places[goal];
    const JoxV2 at = {w->state.agents.x[i], w->state.agents.y[i]};
    double least = INFINITY;
    if (!place || !jox_place_is_set(place))
        return place && jox_lift_find_place(view, goal, lift, stop);
    for (uint32_t m = 0; m < place->member_count; m++) {
        uint32_t l, s;
        if (!jox_lift_find_place(view, place->members[m], &l, &s))
            continue;
        const bool own = has && l == rider->lift;
        const double time = estimate_time(w, l, s, at, rider) - (own ? JOX_LIFT_LOYAL : 0.0);
        if (time < least) {
            least = time;
            *lift = l;
            *stop = s;
        }
    }
    return least < INFINITY;
}

/* Returns whether it is an agent's turn to choose, once a second. */
static bool is_turn(const JoWorld *w, uint32_t id) {
    const uint32_t every = (uint32_t)(1.0 / w->model.def.dt) + 1;
    return (w->state.tick + id) % every == 0;
}

/* Returns whether an agent that rides to a set of places chooses its lift anew in this step. */
static bool chooses_again(const JoWorld *w, const JoxRider *rider) {
    return rider->goal >= 0 && jox_place_is_set(&w->model.places[rider->goal]) &&
           rider->phase <= JOX_RIDE_WAIT && is_turn(w, rider->id);
}

/* ---- the list ---- */

/* Updates an agent that walks to a place, on its own storey or not; false: it takes no lift. */
static bool update_walker(const JoWorld *w, uint32_t i, int32_t goal, JoxRider *rider, bool has) {
    const bool same = has && rider->itself && rider->goal == goal;
    const bool inside = has && rider->phase > JOX_RIDE_WAIT && rider->phase != JOX_RIDE_OVER;
    if (goal < 0 || !(jox_param(&w->state.agents, JOX_PARAM_lifts, i) > JOX_LIFTS_NEVER) ||
        (same && rider->phase == JOX_RIDE_OVER))
        return false;
    if (same && (inside || !is_turn(w, rider->id)))
        return true;
    if (!same && !is_turn(w, rider->id) && w->state.agents.entered[i] != w->state.tick)
        return false;
    JoxRider next = *rider;
    next.goal = goal;
    next.itself = 1;
    if (!jox_lift_find_on_way(w, i, &next, same, &next))
        return false;
    if (!same || next.lift != rider->lift || next.from != rider->from) {
        next.phase = JOX_RIDE_APPROACH;
        next.spot = -1;
    }
    *rider = next;
    return true;
}

/* Updates an agent whose state rides to a goal; false: it rides in no lift. */
static bool update_ride(const JoWorld *w, uint32_t i, int32_t goal, JoxRider *rider, bool has) {
    const bool same = has && !rider->itself && rider->goal == goal;
    uint32_t lift = rider->lift, stop = rider->to;
    if (same && !chooses_again(w, rider))
        return true;
    if (!find_lift(w, i, goal, rider, same, &lift, &stop))
        return false;
    if (same && lift == rider->lift)
        stop = rider->to;
    const bool inside = has && (rider->phase == JOX_RIDE_INSIDE || rider->phase == JOX_RIDE_LEAVE);
    if ((!inside && !same) || lift != rider->lift) {
        rider->phase = JOX_RIDE_APPROACH;
        rider->spot = -1;
    }
    rider->goal = goal;
    rider->lift = lift;
    rider->to = stop;
    rider->itself = 0;
    return true;
}

static JoxRider make_rider(uint32_t id) {
    return (JoxRider){.id = id, .goal = -1, .phase = JOX_RIDE_APPROACH, .spot = -1};
}

/* Returns the lift in whose car an agent stands, with its door open or not; -1: none. */
static int32_t find_car(const JoWorld *w, uint32_t i, bool open) {
    const int32_t l = jox_machines_car(&w->machines, i);
    return l >= 0 && (w->state.lifts.cars[l].door == JOX_DOOR_OPEN) == open ? l : -1;
}

/* Updates an agent that is in a car, and walks to another place than the one that it came in for:
   it gets out where that takes least time, as it would stand before a shut door otherwise. False:
   it is in no car, or no way leads on. */
static bool update_passenger(const JoWorld *w, uint32_t i, int32_t goal, JoxRider *rider,
                             bool has) {
    const bool rides = has && (rider->phase == JOX_RIDE_INSIDE || rider->phase == JOX_RIDE_LEAVE);
    JoxRider next = *rider;
    if (goal < 0 || (rides && rider->itself && rider->goal == goal))
        return false;
    if (!rides) {
        const int32_t lift = is_turn(w, rider->id) ? find_car(w, i, false) : -1;
        if (lift < 0)
            return false;
        next = make_rider(rider->id);
        next.lift = (uint32_t)lift;
        next.from = w->state.lifts.cars[lift].stop;
    }
    next.goal = goal;
    next.itself = 1;
    if (!jox_lift_choose_stop(w, i, &next))
        return rides; /* rides on to the stop that it came in for */
    *rider = next;
    return true;
}

/* Updates an agent whose state rides to a goal, at a lift or on the way to the lift. */
static bool update_ride_or_way(const JoWorld *w, uint32_t i, int32_t goal, JoxRider *rider,
                               bool has) {
    const JoxStoreys *storeys = &w->model.storeys;
    const int32_t door = jox_ride_approach(&w->machines, i, goal);
    const bool rides = has && rider->itself && rider->goal == door &&
                       rider->phase > JOX_RIDE_WAIT && rider->phase != JOX_RIDE_OVER;
    const bool elsewhere = door >= 0 && jox_sheet_of(storeys, w->model.places[door].centre.y) !=
                                            jox_sheet_of(storeys, w->state.agents.y[i]);
    uint32_t lift, stop;
    if (has && jox_lift_find_place(&w->scratch.lifts.view, door, &lift, &stop) &&
        lift != rider->lift && update_passenger(w, i, door, rider, has))
        return true;
    return ((rides || elsewhere) && update_walker(w, i, door, rider, has)) ||
           update_ride(w, i, goal, rider, has);
}

/* Makes an agent a stray of the car in which it stands and does not want to ride, its door being
   open: pushed in, or passing. `rides`: it is a rider. False: it is none. */
static bool begin_straying(const JoWorld *w, uint32_t i, bool rides, JoxRider *rider) {
    const int32_t l = rides && rider->phase > JOX_RIDE_WAIT ? -1 : find_car(w, i, true);
    if (l < 0 || (rides && rider->lift == (uint32_t)l))
        return false;
    *rider = make_rider(rider->id);
    rider->lift = (uint32_t)l;
    rider->phase = JOX_RIDE_LEAVE;
    rider->from = w->state.lifts.cars[l].stop;
    rider->stray = 1;
    return true;
}

/* Updates the rider of an agent that walks or rides somewhere; false: it rides in no lift. */
static bool update_rider(const JoWorld *w, uint32_t i, JoxRider *rider, bool has) {
    const int32_t ride = jox_machines_ride_goal(&w->machines, i);
    const int32_t walk = ride < 0 ? jox_machines_walk_goal(&w->machines, i) : -1;
    if (ride < 0 && walk < 0)
        return false;
    if (rider->stray && rider->phase == JOX_RIDE_OVER) {
        *rider = make_rider(rider->id);
        has = false;
    }
    if (!rider->stray) {
        if (update_passenger(w, i, walk, rider, has))
            return true;
        const bool rides = ride >= 0 ? update_ride_or_way(w, i, ride, rider, has)
                                     : update_walker(w, i, walk, rider, has);
        if (!begin_straying(w, i, rides, rider))
            return rides;
    }
    const JoxLiftCar *car = &w->state.lifts.cars[rider->lift];
    rider->to = car->target >= 0 ? (uint32_t)car->target : car->stop; /* where it gets out */
    return true;
}

void jox_lifts_list_riders(JoWorld *w) {
    JoxLiftState *state = &w->state.lifts;
    JoxLiftScratch *scratch = &w->scratch.lifts;
    const JoxAgents *a = &w->state.agents;
    uint32_t count = 0, old = 0;
    for (uint32_t rank = 0; rank < a->count; rank++) {
        const uint32_t i = a->by_rank[rank], id = a->id[i];
        if (a->machine[i] == JOX_NO_MACHINE)
            continue;
        while (old < state->rider_count && state->riders[old].id < id)
            old++;
        const bool has = old < state->rider_count && state->riders[old].id == id;
        JoxRider rider = has ? state->riders[old] : make_rider(id);
        if (!update_rider(w, i, &rider, has))
            continue;
        JOX_RESERVE(scratch->next, scratch->next_capacity, count + 1);
        JOX_RESERVE(scratch->index, scratch->index_capacity, count + 1);
        scratch->next[count] = rider;
        scratch->index[count++] = i;
    }
    JOX_RESERVE(state->riders, state->rider_capacity, count);
    if (count)
        memcpy(state->riders, scratch->next, count * sizeof *state->riders);
    state->rider_count = count;
}
