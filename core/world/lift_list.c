/* The list of agents that ride, and their choice among the lifts of a set, or between lifts and
   stairs. */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "world/lift_parts.h"

static const double WALKS = 1.3; /* m/s: for choosing among lifts */
static const double LOYAL = 8.0; /* s: that another lift has to save */

/* Returns how many car loads of people have to be carried before an agent that takes a lift now;
   `before`: of those who wait, only those who called before this tick. */
static double count_loads_before(const JoWorld *w, uint32_t lift, uint32_t id, uint32_t before) {
    const JoxLiftState *state = &w->state.lifts;
    uint32_t people = 0;
    for (uint32_t r = 0; r < state->rider_count; r++) {
        const JoxRider *rider = &state->riders[r];
        people += rider->lift == lift && rider->id != id &&
                  (rider->phase <= JOX_RIDE_BOARD && rider->since <= before);
    }
    return (double)people / w->model.lifts[lift].capacity;
}

/* Returns the seconds that a lift may take an agent from a stop: waiting and riding. */
static double estimate_ride(const JoWorld *w, uint32_t lift, uint32_t from, uint32_t stop,
                            const JoxRider *rider) {
    const JoxLift *of = &w->model.lifts[lift];
    const JoxLiftCar *car = &w->state.lifts.cars[lift];
    const double height = (double)of->stops[from].height;
    const double ride = jox_lift_travel_time(of, (double)of->stops[stop].height - height);
    const double come = jox_lift_travel_time(of, car->height - height);
    const double doors = (double)of->opening + (double)of->closing + (double)of->dwell;
    const bool waits = rider->phase == JOX_RIDE_WAIT && rider->lift == lift;
    const double loads =
        count_loads_before(w, lift, rider->id, waits ? rider->since : (uint32_t)w->state.tick);
    return ride + come + doors + 2.0 * loads * (ride + doors) +
           (car->mode == JOX_LIFT_OUT_OF_USE ? 1e6 : 0.0);
}

/* Returns the same with the way to the door, straight. */
static double estimate_time(const JoWorld *w, uint32_t lift, uint32_t stop, JoxV2 at,
                            const JoxRider *rider) {
    const uint32_t from = jox_lift_near_stop(&w->scratch.lifts.view, lift, at);
    const JoxV2 door = jox_lift_outside(&w->model.lifts[lift], from, &w->model.storeys);
    return (double)jox_length(jox_sub(door, at)) / WALKS +
           estimate_ride(w, lift, from, stop, rider);
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
        const double time = estimate_time(w, l, s, at, rider) - (own ? LOYAL : 0.0);
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

/* ---- lifts on the way to a place ---- */

/* Returns the length of the way to a place by a field, m; INFINITY: none leads there, `unknown`
   where there is no field yet. */
static double measure_way(const JoWorld *w, int32_t place, bool stepless, JoxV2 from,
                          double unknown) {
    const JoxField *const *fields = (const JoxField *const *)w->machines.fields;
    const JoxRouteKind kind = stepless ? JOX_ROUTE_STEPLESS : JOX_ROUTE_NOW;
    const JoxField *field = fields ? fields[(uint32_t)place * JOX_ROUTE_KINDS + kind] : NULL;
    return field ? (double)jox_field_distance(field, from) : unknown;
}

/* Finds the lift and the stops by which an agent gets to a place on another storey in less time
   than over stairs; false: by none. */
static bool find_lift_on_way(const JoWorld *w, uint32_t i, const JoxRider *rider, bool has,
                             JoxRider *found) {
    const JoxAgents *a = &w->state.agents;
    const JoxStoreys *storeys = &w->model.storeys;
    const JoxV2 at = {a->x[i], a->y[i]};
    const bool only = jox_param(a, JOX_PARAM_lifts, i) > JOX_LIFTS_ONLY;
    const double speed = fmax((double)jox_param(a, JOX_PARAM_speed, i), 0.1);
    const uint32_t storey = jox_sheet_of(storeys, at.y);
    double least = measure_way(w, rider->goal, only, at, NAN) / speed;
    bool any = false;
    if (isnan(least) || storey >= storeys->storey_count) /* not known yet, or on a stair */
        return false;
    for (uint32_t l = 0; l < w->model.lift_count; l++) {
        const JoxLift *lift = &w->model.lifts[l];
        const uint32_t mode = w->state.lifts.cars[l].mode;
        const int32_t from = jox_lift_stop_at(lift, storey);
        if (from < 0 || (mode != JOX_LIFT_IN_USE && !(only && mode == JOX_LIFT_FIREMEN)))
            continue;
        const JoxV2 door = jox_lift_outside(lift, (uint32_t)from, storeys);
        const double way = measure_way(w, lift->stops[from].place, only, at,
                                       (double)jox_length(jox_sub(door, at)));
        for (uint32_t s = 0; s < lift->stop_count; s++) {
            if (s == (uint32_t)from || (mode == JOX_LIFT_FIREMEN && s != lift->home))
                continue;
            const double rest =
                measure_way(w, rider->goal, only, jox_lift_outside(lift, s, storeys), INFINITY);
            const bool own = has && rider->lift == l && rider->to == s;
            const double time = (way + rest) / speed +
                                estimate_ride(w, l, (uint32_t)from, s, rider) - (own ? LOYAL : 0.0);
            if (time < least) {
                least = time;
                found->lift = l;
                found->from = (uint32_t)from;
                found->to = s;
                any = true;
            }
        }
    }
    return any;
}

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
    if (!find_lift_on_way(w, i, &next, same, &next))
        return false;
    if (!same || next.lift != rider->lift) {
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

/* Returns the lift in whose car, with its door open, an agent stands; -1: none. */
static int32_t find_open_car(const JoWorld *w, uint32_t i) {
    const JoxStoreys *storeys = &w->model.storeys;
    const JoxV2 at = {w->state.agents.x[i], w->state.agents.y[i]};
    for (uint32_t l = 0; l < w->model.lift_count; l++) {
        const JoxLift *lift = &w->model.lifts[l];
        const JoxLiftCar *car = &w->state.lifts.cars[l];
        const float shift = (float)lift->stops[car->stop].storey * storeys->pitch;
        if (car->door == JOX_DOOR_OPEN && jox_lift_contains(lift, (JoxV2){at.x, at.y - shift}))
            return (int32_t)l;
    }
    return -1;
}

static JoxRider make_rider(uint32_t id) {
    return (JoxRider){.id = id, .goal = -1, .phase = JOX_RIDE_APPROACH, .spot = -1};
}

/* Makes an agent a stray of the car in which it stands and does not want to ride, its door being
   open: pushed in, or passing. `rides`: it is a rider. False: it is none. */
static bool begin_straying(const JoWorld *w, uint32_t i, bool rides, JoxRider *rider) {
    const int32_t l = rides && rider->phase > JOX_RIDE_WAIT ? -1 : find_open_car(w, i);
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
        const bool rides =
            ride >= 0 ? update_ride(w, i, ride, rider, has) : update_walker(w, i, walk, rider, has);
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
