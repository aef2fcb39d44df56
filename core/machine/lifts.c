/* Lookups for behaviours that ride in lifts. */
#include "machine/lifts.h"

#include "machine/machine_parts.h"

bool jox_lift_find_place(const JoxLiftView *view, int32_t place, uint32_t *lift, uint32_t *stop) {
    for (uint32_t l = 0; view && place >= 0 && l < view->lift_count; l++)
        for (uint32_t s = 0; s < view->lifts[l].stop_count; s++)
            if (view->lifts[l].stops[s].place == place) {
                *lift = l;
                *stop = s;
                return true;
            }
    return false;
}

const JoxRider *jox_rider_find(const JoxLiftView *view, uint32_t id) {
    uint32_t low = 0, high = view ? view->rider_count : 0;
    while (low < high) {
        const uint32_t middle = (low + high) / 2;
        if (view->riders[middle].id < id)
            low = middle + 1;
        else
            high = middle;
    }
    return view && low < view->rider_count && view->riders[low].id == id ? &view->riders[low]
                                                                         : NULL;
}

JoxRidePhase jox_machines_ride(const JoxMachineRun *run, uint32_t agent, const JoxRider **rider) {
    *rider = jox_rider_find(run->lifts, run->agents->id[agent]);
    switch (*rider ? (JoxRidePhase)(*rider)->phase : JOX_RIDE_OVER) {
    case JOX_RIDE_APPROACH:
        return JOX_RIDE_APPROACH;
    case JOX_RIDE_WAIT:
    case JOX_RIDE_BOARD:
        return JOX_RIDE_WAIT;
    case JOX_RIDE_INSIDE:
    case JOX_RIDE_ASIDE:
    case JOX_RIDE_LEAVE:
        return JOX_RIDE_INSIDE;
    default:
        return JOX_RIDE_OVER;
    }
}

const JoxSteerTerm *jox_ride_term(const JoxState *state) {
    for (uint32_t t = 0; t < state->steer_count; t++)
        if (state->steer[t].kind == JOX_STEER_RIDE)
            return &state->steer[t];
    return NULL;
}

int32_t jox_machines_ride_goal(const JoxMachineRun *run, uint32_t agent) {
    const JoxAgents *a = run->agents;
    if (a->machine[agent] == JOX_NO_MACHINE)
        return -1;
    const JoxSteerTerm *term = jox_ride_term(&jox_machine_of(run, agent)->states[a->state[agent]]);
    return term ? jox_target_place(run, agent, term->target) : -1;
}

int32_t jox_machines_walk_goal(const JoxMachineRun *run, uint32_t agent) {
    const JoxAgents *a = run->agents;
    if (a->machine[agent] == JOX_NO_MACHINE)
        return -1;
    const JoxMachine *machine = jox_machine_of(run, agent);
    const JoxState *state = &machine->states[a->state[agent]];
    for (uint32_t t = 0; t < state->steer_count; t++) {
        const JoxSteerTerm *term = &state->steer[t];
        if ((term->kind != JOX_STEER_FIELD && term->kind != JOX_STEER_SEEK) ||
            (term->target >= 0 && machine->targets[term->target].score))
            continue;
        const int32_t place = jox_target_place(run, agent, term->target);
        if (place >= 0)
            return place;
    }
    return -1;
}

bool jox_has_ridden(const JoxMachineRun *run, uint32_t agent) {
    const JoxRider *rider = jox_rider_find(run->lifts, run->agents->id[agent]);
    return rider && !rider->itself && !rider->stray && rider->phase == JOX_RIDE_OVER;
}

bool jox_is_riding(const JoxMachineRun *run, uint32_t agent) {
    const JoxRider *rider = jox_rider_find(run->lifts, run->agents->id[agent]);
    return rider && !rider->stray &&
           (rider->phase == JOX_RIDE_INSIDE || rider->phase == JOX_RIDE_LEAVE);
}

bool jox_is_lift_in_use(const JoxMachineRun *run, int32_t place) {
    const JoxLiftView *view = run->lifts;
    uint32_t lift, stop;
    if (place < 0)
        return false;
    const JoxPlace *of = &run->places[place];
    for (uint32_t m = 0; jox_place_is_set(of) && m < of->member_count; m++)
        if (jox_lift_find_place(view, of->members[m], &lift, &stop) &&
            view->cars[lift].mode == JOX_LIFT_IN_USE)
            return true;
    return jox_lift_find_place(view, place, &lift, &stop) &&
           view->cars[lift].mode == JOX_LIFT_IN_USE;
}

uint32_t jox_lift_near_stop(const JoxLiftView *view, uint32_t lift, JoxV2 at) {
    const JoxLift *of = &view->lifts[lift];
    const uint32_t storey = jox_storey_at(view->storeys, at);
    uint32_t best = 0, least = UINT32_MAX;
    for (uint32_t s = 0; s < of->stop_count; s++) {
        const uint32_t here = of->stops[s].storey;
        const uint32_t apart = here > storey ? here - storey : storey - here;
        if (apart < least) {
            least = apart;
            best = s;
        }
    }
    return best;
}

int32_t jox_ride_approach(const JoxMachineRun *run, uint32_t agent, int32_t goal) {
    const JoxLiftView *view = run->lifts;
    const JoxRider *rider = jox_rider_find(view, run->agents->id[agent]);
    const JoxV2 at = {run->agents->x[agent], run->agents->y[agent]};
    uint32_t lift, stop;
    if (rider && rider->goal == goal)
        return rider->phase == JOX_RIDE_APPROACH ? view->lifts[rider->lift].stops[rider->from].place
                                                 : -1;
    if (goal >= 0 && jox_place_is_set(&run->places[goal]))
        goal = run->places[goal].member_count ? run->places[goal].members[0] : -1;
    if (!jox_lift_find_place(view, goal, &lift, &stop))
        return -1;
    return view->lifts[lift].stops[jox_lift_near_stop(view, lift, at)].place;
}
