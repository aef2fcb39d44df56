/* Agents that ride in lifts: how far each has come, who may go in, and where each stands. Those
   inside leave first; then those who wait go in, in the order in which they called, as far as there
   is room. Riders that stand in the way of others who leave step out for them. Whoever gets in
   without a turn, pushed or passing, stays if there is room, else goes out again. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "geom/polygon.h"
#include "geom/wall_way.h"
#include "world/lift_parts.h"

static const float LOBBY = 4.0f;    /* m from the door: an agent this near and in sight calls */
static const float LOST = 9.0f;     /* m: one that waits and is moved this far has to come anew */
static const float OUTSIDE = 1.0f;  /* m beyond the door: an agent there has left the car */
static const float DOORWAY = 0.05f; /* m: gap of an agent to a door that may shut */
static const float STANDING = 0.7f; /* radii to a wall, as people are moved out of new walls */
static const float CROWDED = 0.5f;  /* share of the capacity from which riders step out */

/* ---- people in the car ---- */

void jox_lift_count_people(JoxLiftTurn *t) {
    const JoxAgents *a = &t->world->state.agents;
    const JoxLiftStop *stop = &t->lift->stops[t->car->stop];
    if (t->car->door == JOX_DOOR_SHUT && t->world->state.tick > 0)
        return;
    t->car->people = 0;
    t->car->mass = 0.0f;
    const uint32_t sheet = t->lift->stops[t->car->stop].storey;
    const float shift = (float)sheet * t->world->model.storeys.pitch;
    double mass = 0.0;
    for (uint32_t rank = 0; rank < a->count;
         rank++) { /* in an order that does not depend on memory */
        const uint32_t i = a->by_rank[rank];
        const JoxV2 plan = {a->x[i], a->y[i] - shift};
        if (!jox_is_within(plan, jox_sub(t->lift->low, jox_v2(1.0f, 1.0f)),
                           jox_add(t->lift->high, jox_v2(1.0f, 1.0f))))
            continue;
        if (jox_lift_contains(t->lift, plan)) {
            const float its = jox_param(a, JOX_PARAM_mass, i);
            const JoxRider *rider = jox_rider_find(&t->world->scratch.lifts.view, a->id[i]);
            t->car->people++;
            mass += (double)its;
            if (!rider || rider->lift != t->number) {
                t->others++;
                t->other_mass += its;
            }
        }
        const JoxV2 at = jox_lift_before_door(stop, plan);
        const float clear = STANDING * jox_param(a, JOX_PARAM_radius, i) + DOORWAY;
        t->blocked |= fabsf(at.y) < clear && fabsf(at.x) < stop->half + clear;
    }
    t->car->mass = (float)mass;
}

void jox_lift_shift_people(JoxLiftTurn *t, uint32_t from, uint32_t to) {
    JoWorld *w = t->world;
    JoxAgents *a = &w->state.agents;
    const JoxStoreys *s = &w->model.storeys;
    JOX_ASSERT(t->car->stop == from);
    const float by =
        ((float)t->lift->stops[to].storey - (float)t->lift->stops[from].storey) * s->pitch;
    for (uint32_t i = 0; i < a->count; i++) {
        if (!jox_lift_holds(t, i))
            continue;
        a->y[i] += by;
        a->prev_y[i] += by;
        a->still_y[i] += by;
    }
    jox_nav_invalidate_order(w->scratch.nav);
}

/* ---- phases ---- */

/* Counts the end of a ride, if the car departed with the rider. */
static void end_ride(JoxLiftTurn *t, JoxRider *rider) {
    rider->spot = -1;
    if (!rider->carried)
        return;
    rider->carried = 0;
    t->figures->let_out++;
    t->figures->ride_s += (double)(t->world->state.tick - rider->boarded) * t->world->model.def.dt;
}

static void begin_waiting(JoxLiftTurn *t, JoxRider *rider, uint32_t i) {
    const JoWorld *w = t->world;
    end_ride(t, rider);
    rider->phase = JOX_RIDE_WAIT;
    rider->since = (uint32_t)w->state.tick;
    jox_lift_take_lobby_spot(t, rider);
    rider->x = w->state.agents.x[i]; /* stays where it is if there is no spot */
    rider->y = w->state.agents.y[i];
}

static void come_in(JoxLiftTurn *t, JoxRider *rider) {
    rider->phase = JOX_RIDE_INSIDE;
    if (!rider->carried) { /* else it stepped out for others on its way */
        rider->from = t->car->stop;
        rider->boarded = (uint32_t)t->world->state.tick;
    }
    rider->spot = -1;
    jox_lift_arrange_inside(t);
    t->car->quiet = 0.0;
    if (t->car->direction == 0 && rider->to != t->car->stop)
        t->car->direction = rider->to > t->car->stop ? 1 : -1;
}

/* Updates an agent that is outside: on its way, or waiting. */
static void update_outside(JoxLiftTurn *t, JoxRider *rider, uint32_t i) {
    const JoWorld *w = t->world;
    const JoxStoreys *s = &w->model.storeys;
    const JoxV2 at = {w->state.agents.x[i], w->state.agents.y[i]};
    if (rider->phase == JOX_RIDE_APPROACH && !rider->itself) /* else its way says from where */
        rider->from = jox_lift_near_stop(&w->scratch.lifts.view, t->number, at);
    const JoxLiftStop *stop = &t->lift->stops[rider->from];
    const JoxV2 front = jox_on_sheet(s, stop->storey, jox_lift_point_at_door(stop, 0.0f, 0.3f));
    const float way = jox_length(jox_sub(at, front));
    if (rider->phase == JOX_RIDE_APPROACH) {
        if (rider->from == rider->to && jox_sheet_of(s, at.y) == stop->storey)
            rider->phase = JOX_RIDE_OVER;
        else if (way < LOBBY && !jox_walls_lie_between(jox_world_walls(w), at, front, NULL))
            begin_waiting(t, rider, i);
    } else if (way > LOST) {
        rider->phase = JOX_RIDE_APPROACH;
        rider->spot = -1;
    }
}

/* Updates an agent that stands in the car. */
static void update_inside(JoxLiftTurn *t, JoxRider *rider) {
    const bool open = t->car->door == JOX_DOOR_OPEN;
    if (rider->phase == JOX_RIDE_ASIDE) {
        rider->phase = JOX_RIDE_INSIDE;
        t->car->quiet = 0.0;
    } else if (rider->phase != JOX_RIDE_INSIDE && rider->phase != JOX_RIDE_LEAVE) {
        if (rider->phase == JOX_RIDE_APPROACH || rider->phase == JOX_RIDE_OVER)
            rider->since =
                (uint32_t)t->world->state.tick; /* it began here, and waited for nothing */
        come_in(t, rider);
    }
    if (t->car->mode == JOX_LIFT_FIREMEN)
        rider->to = t->lift->home;
    else if (t->car->mode == JOX_LIFT_OUT_OF_USE && t->car->door != JOX_DOOR_SHUT)
        rider->to = t->car->stop;
    if (rider->to == t->car->stop && open)
        rider->phase = JOX_RIDE_LEAVE;
    else if (rider->phase == JOX_RIDE_LEAVE)
        rider->phase = JOX_RIDE_INSIDE;
}

static void let_out(JoxLiftTurn *t, JoxRider *rider) {
    rider->phase = JOX_RIDE_OVER;
    t->car->quiet = 0.0;
    end_ride(t, rider);
}

void jox_lift_turn_away(JoxLiftTurn *t, JoxRider *rider) {
    if (rider->carried)
        rider->since = (uint32_t)t->world->state.tick; /* it waits anew, for the rest of its way */
    end_ride(t, rider);
    rider->phase = JOX_RIDE_WAIT;
    rider->from = t->car->stop;
    t->figures->turned_away++;
}

/* Returns whether a rider that stays in the car stands between the door and one who leaves. */
static bool stands_in_way(const JoxLiftTurn *t, JoxV2 at) {
    const JoWorld *w = t->world;
    const JoxLiftStop *stop = &t->lift->stops[t->car->stop];
    const float before = jox_lift_before_door(stop, at).y;
    for (uint32_t r = 0; r < w->state.lifts.rider_count; r++) {
        const JoxRider *rider = &w->state.lifts.riders[r];
        if (rider->lift != t->number || rider->phase != JOX_RIDE_LEAVE)
            continue;
        const JoxV2 leaver =
            jox_lift_before_door(stop, jox_lift_plan_of(w, w->scratch.lifts.index[r]));
        if (leaver.y < before)
            return true;
    }
    return false;
}

/* ---- room ---- */

/* People whom a car holds or has promised a place, and their mass, kg. */
typedef struct Aboard {
    uint32_t people;
    float mass;
} Aboard;

static Aboard sum_aboard(const JoxLiftTurn *t) {
    const JoWorld *w = t->world;
    Aboard sum = {t->others, t->other_mass};
    for (uint32_t r = 0; r < w->state.lifts.rider_count; r++) {
        const JoxRider *rider = &w->state.lifts.riders[r];
        const uint32_t i = w->scratch.lifts.index[r];
        if (rider->lift != t->number)
            continue;
        if (rider->phase != JOX_RIDE_BOARD && rider->phase != JOX_RIDE_INSIDE &&
            rider->phase != JOX_RIDE_ASIDE &&
            !(rider->phase == JOX_RIDE_LEAVE && jox_lift_holds(t, i)))
            continue;
        sum.people++;
        sum.mass += jox_param(&w->state.agents, JOX_PARAM_mass, i);
    }
    return sum;
}

static bool is_within(const JoxLiftTurn *t, Aboard sum) {
    return sum.people <= t->lift->capacity && sum.mass <= t->lift->load;
}

/* Returns the rider that was let in last and is not yet in; NULL: none. */
static JoxRider *find_last_to_board(const JoxLiftTurn *t) {
    JoxLiftState *state = &t->world->state.lifts;
    JoxRider *last = NULL;
    for (uint32_t r = 0; r < state->rider_count; r++) {
        JoxRider *rider = &state->riders[r];
        if (rider->lift == t->number && rider->phase == JOX_RIDE_BOARD &&
            !jox_lift_holds(t, t->world->scratch.lifts.index[r]) &&
            (!last || rider->since >= last->since))
            last = rider;
    }
    return last;
}

/* Finds room for agent i, which got in without a turn: free room, or that of a rider that is still
   outside, which waits on. False: there is none. */
static bool make_room(JoxLiftTurn *t, uint32_t i) {
    const JoxAgents *a = &t->world->state.agents;
    Aboard sum = sum_aboard(t);
    sum.people++;
    sum.mass += jox_param(a, JOX_PARAM_mass, i);
    if (is_within(t, sum))
        return true;
    JoxRider *last = find_last_to_board(t);
    if (!last)
        return false;
    sum.people--;
    sum.mass -= jox_param(a, JOX_PARAM_mass,
                          t->world->scratch.lifts.index[last - t->world->state.lifts.riders]);
    if (!is_within(t, sum))
        return false;
    jox_lift_turn_away(t, last);
    return true;
}

/* Makes a rider without room wait; it goes out again. */
static void keep_out(JoxLiftTurn *t, JoxRider *rider, uint32_t i) {
    if (rider->phase == JOX_RIDE_WAIT)
        return;
    rider->from = t->car->stop;
    begin_waiting(t, rider, i);
}

bool jox_lift_shed_load(JoxLiftTurn *t) {
    JoxLiftState *state = &t->world->state.lifts;
    const JoxLiftStop *stop = &t->lift->stops[t->car->stop];
    Aboard stay = {t->car->people, t->car->mass};
    JoxRider *nearest = NULL;
    float least = -INFINITY;
    if (is_within(t, stay))
        return false;
    for (uint32_t r = 0; r < state->rider_count; r++) {
        JoxRider *rider = &state->riders[r];
        const uint32_t i = t->world->scratch.lifts.index[r];
        if (rider->lift != t->number || !jox_lift_holds(t, i))
            continue;
        const float before = jox_lift_before_door(stop, jox_lift_plan_of(t->world, i)).y;
        if (rider->phase == JOX_RIDE_WAIT) { /* it goes out already */
            stay.people--;
            stay.mass -= jox_param(&t->world->state.agents, JOX_PARAM_mass, i);
        } else if (rider->phase == JOX_RIDE_INSIDE && before > least) {
            least = before;
            nearest = rider;
        }
    }
    if (nearest && !is_within(t, stay)) {
        jox_lift_turn_away(t, nearest);
    }
    t->car->refuses = 1;
    return true;
}

/* ---- updates ---- */

static void update_phase(JoxLiftTurn *t, JoxRider *rider, uint32_t i) {
    const JoxLiftStop *stop = &t->lift->stops[t->car->stop];
    const bool inside = jox_lift_holds(t, i), open = t->car->door == JOX_DOOR_OPEN;
    switch ((JoxRidePhase)rider->phase) {
    case JOX_RIDE_LEAVE:
        if (inside)
            update_inside(t, rider);
        else if (jox_lift_before_door(stop, jox_lift_plan_of(t->world, i)).y > OUTSIDE || !open)
            let_out(t, rider);
        break;
    case JOX_RIDE_INSIDE:
    case JOX_RIDE_ASIDE:
        if (inside)
            update_inside(t, rider);
        else if (open)
            rider->phase = JOX_RIDE_ASIDE;
        else
            begin_waiting(t, rider, i); /* the car left without it */
        break;
    case JOX_RIDE_OVER:
        if (inside && !open) /* it was pushed in again, and rides anew */
            update_inside(t, rider);
        break;
    case JOX_RIDE_APPROACH:
    case JOX_RIDE_WAIT:
    case JOX_RIDE_BOARD:
        if (!inside)
            update_outside(t, rider, i);
        else if (rider->phase == JOX_RIDE_BOARD || !open || make_room(t, i))
            update_inside(t, rider);
        else
            keep_out(t, rider, i);
        break;
    }
}

/* ---- admission ---- */

/* Returns the rider that has waited longest at the car's stop and may go in; NULL: none. */
static JoxRider *find_next_to_board(const JoxLiftTurn *t) {
    JoxLiftState *state = &t->world->state.lifts;
    JoxRider *best = NULL;
    for (uint32_t r = 0; r < state->rider_count; r++) {
        JoxRider *rider = &state->riders[r];
        if (rider->lift != t->number || rider->phase != JOX_RIDE_WAIT ||
            rider->from != t->car->stop || (best && rider->since >= best->since) ||
            !jox_lift_suits(t->world, t->world->scratch.lifts.index[r], t->lift, rider->from,
                            rider->to))
            continue;
        if (t->car->mode == JOX_LIFT_IN_USE && t->car->direction != 0 &&
            (rider->to > rider->from) != (t->car->direction > 0))
            continue;
        best = rider;
    }
    return best;
}

/* Returns whether any rider or call lies ahead of the car in its direction, or waits here for it.
 */
static bool has_work_ahead(const JoxLiftTurn *t) {
    const JoxLiftState *state = &t->world->state.lifts;
    const int32_t direction = t->car->direction, at = (int32_t)t->car->stop;
    for (uint32_t r = 0; r < state->rider_count; r++) {
        const JoxRider *rider = &state->riders[r];
        if (rider->lift != t->number)
            continue;
        const int32_t from = (int32_t)rider->from, to = (int32_t)rider->to;
        const bool rides = rider->phase == JOX_RIDE_INSIDE || rider->phase == JOX_RIDE_ASIDE ||
                           rider->phase == JOX_RIDE_BOARD;
        if ((rides && (to - at) * direction > 0) ||
            (rider->phase == JOX_RIDE_WAIT &&
             ((from - at) * direction > 0 || (from == at && (to - at) * direction > 0))))
            return true;
    }
    return false;
}

/* Lets those who wait go in, once nobody leaves any more. */
static void admit_waiting(JoxLiftTurn *t) {
    JoxLiftCar *car = t->car;
    JoxLiftState *state = &t->world->state.lifts;
    for (uint32_t r = 0; r < state->rider_count; r++) {
        const JoxRider *rider = &state->riders[r];
        if (rider->lift == t->number && (rider->phase == JOX_RIDE_LEAVE ||
                                         (rider->phase == JOX_RIDE_WAIT &&
                                          jox_lift_holds(t, t->world->scratch.lifts.index[r]))))
            return;
    }
    for (uint32_t r = 0; r < state->rider_count; r++) /* those who stepped out come back first */
        if (state->riders[r].lift == t->number && state->riders[r].phase == JOX_RIDE_ASIDE)
            state->riders[r].phase = JOX_RIDE_BOARD;
    Aboard sum = sum_aboard(t);
    if (car->mode == JOX_LIFT_OUT_OF_USE || car->refuses ||
        (car->mode == JOX_LIFT_FIREMEN && car->stop == t->lift->home))
        return;
    if (car->mode == JOX_LIFT_IN_USE && car->direction != 0 && !has_work_ahead(t))
        car->direction = 0;
    JoxRider *next;
    while (sum.people < t->lift->capacity && (next = find_next_to_board(t))) {
        const uint32_t i = t->world->scratch.lifts.index[next - state->riders];
        sum.people++;
        sum.mass += jox_param(&t->world->state.agents, JOX_PARAM_mass, i);
        if (!is_within(t, sum)) {
            car->refuses = 1;
            break;
        }
        next->phase = JOX_RIDE_BOARD;
        if (car->mode == JOX_LIFT_IN_USE && car->direction == 0)
            car->direction = next->to > next->from ? 1 : -1;
    }
}

void jox_lift_update_riders(JoxLiftTurn *t) {
    JoWorld *w = t->world;
    JoxLiftState *state = &w->state.lifts;
    for (uint32_t r = 0; r < state->rider_count; r++)
        if (state->riders[r].lift == t->number)
            update_phase(t, &state->riders[r], w->scratch.lifts.index[r]);
    if (t->car->door != JOX_DOOR_OPEN)
        return;
    for (uint32_t r = 0;
         r < state->rider_count && (float)t->car->people > CROWDED * (float)t->lift->capacity;
         r++) {
        JoxRider *rider = &state->riders[r];
        if (rider->lift == t->number && rider->phase == JOX_RIDE_INSIDE &&
            stands_in_way(t, jox_lift_plan_of(w, w->scratch.lifts.index[r])))
            rider->phase = JOX_RIDE_ASIDE;
    }
    admit_waiting(t);
}
