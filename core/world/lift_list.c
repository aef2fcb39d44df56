/* The list of agents that ride, and their choice among the lifts of a set. */
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

/* Returns the seconds that a lift may take an agent: the way to its door, waiting and riding. */
static double estimate_time(const JoWorld *w, uint32_t lift, uint32_t stop, JoxV2 at,
                            const JoxRider *rider) {
    const JoxLift *of = &w->model.lifts[lift];
    const JoxLiftCar *car = &w->state.lifts.cars[lift];
    const JoxLiftStop *near = &of->stops[jox_lift_near_stop(&w->scratch.lifts.view, lift, at)];
    const JoxV2 door = jox_on_sheet(&w->model.storeys, near->storey, near->middle);
    const double height = (double)near->height;
    const double ride = jox_lift_travel_time(of, (double)of->stops[stop].height - height);
    const double come = jox_lift_travel_time(of, car->height - height);
    const double doors = (double)of->opening + (double)of->closing + (double)of->dwell;
    const bool waits = rider->phase == JOX_RIDE_WAIT && rider->lift == lift;
    const double loads =
        count_loads_before(w, lift, rider->id, waits ? rider->since : (uint32_t)w->state.tick);
    return (double)jox_length(jox_sub(door, at)) / WALKS + ride + come +
           2.0 * loads * (ride + doors) + (car->mode == JOX_LIFT_OUT_OF_USE ? 1e6 : 0.0);
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

/* Returns whether an agent that rides to a set of places chooses its lift anew in this step. */
static bool chooses_again(const JoWorld *w, const JoxRider *rider) {
    const uint32_t every = (uint32_t)(1.0 / w->model.def.dt) + 1;
    return rider->goal >= 0 && jox_place_is_set(&w->model.places[rider->goal]) &&
           rider->phase <= JOX_RIDE_WAIT && (w->state.tick + rider->id) % every == 0;
}

void jox_lifts_list_riders(JoWorld *w) {
    JoxLiftState *state = &w->state.lifts;
    JoxLiftScratch *scratch = &w->scratch.lifts;
    const JoxAgents *a = &w->state.agents;
    bool rides[JOX_MOST_MACHINES], any = state->rider_count > 0;
    for (uint32_t m = 0; m < w->model.machines.count; m++) {
        rides[m] = jox_machine_rides(&w->machines, m);
        any |= rides[m];
    }
    uint32_t count = 0, old = 0;
    for (uint32_t rank = 0; any && rank < a->count; rank++) {
        const uint32_t i = a->by_rank[rank], id = a->id[i];
        if (a->machine[i] == JOX_NO_MACHINE || !rides[a->machine[i]])
            continue;
        const int32_t goal = jox_machines_ride_goal(&w->machines, i);
        while (old < state->rider_count && state->riders[old].id < id)
            old++;
        const bool has = old < state->rider_count && state->riders[old].id == id;
        JoxRider rider =
            has ? state->riders[old] : (JoxRider){.id = id, .phase = JOX_RIDE_APPROACH, .spot = -1};
        uint32_t lift = rider.lift, stop = rider.to;
        if (!has || rider.goal != goal || chooses_again(w, &rider)) {
            const bool same = has && rider.goal == goal;
            if (!find_lift(w, i, goal, &rider, same, &lift, &stop))
                continue;
            if (same && lift == rider.lift)
                stop = rider.to;
            const bool inside =
                has && (rider.phase == JOX_RIDE_INSIDE || rider.phase == JOX_RIDE_LEAVE);
            if ((!inside && !same) || lift != rider.lift) {
                rider.phase = JOX_RIDE_APPROACH;
                rider.spot = -1;
            }
            rider.goal = goal;
            rider.lift = lift;
            rider.to = stop;
        }
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
