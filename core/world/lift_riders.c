/* Agents that ride in lifts: how far each has come, who may go in, and where each stands. Those
   inside leave first; then those who wait go in, in the order in which they called, as far as there
   is room. Riders that stand in the way of others who leave step out for them. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "geom/polygon.h"
#include "geom/wall_way.h"
#include "world/lift_parts.h"

static const float LOBBY = 4.0f;    /* m from the door: an agent this near and in sight calls */
static const float LOST = 9.0f;     /* m: one that waits and is moved this far has to come anew */
static const float OUTSIDE = 0.6f;  /* m beyond the door: an agent there has left the car */
static const float DOORWAY = 0.05f; /* m: gap of an agent to a door that may shut */
static const float STANDING = 0.7f; /* radii to a wall, as people are moved out of new walls */
static const float CROWDED = 0.5f;  /* share of the capacity from which riders step out */

/* ---- geometry ---- */

static uint32_t get_sheet(const JoxLiftTurn *t) {
    return t->lift->stops[t->car->stop].storey;
}

static JoxV2 get_plan(const JoWorld *w, uint32_t i) {
    return jox_in_plan(&w->model.storeys, (JoxV2){w->state.agents.x[i], w->state.agents.y[i]});
}

/* Returns whether agent i stands in the car. */
static bool is_in_car(const JoxLiftTurn *t, uint32_t i) {
    const JoWorld *w = t->world;
    const JoxStoreys *s = &w->model.storeys;
    const JoxV2 at = {w->state.agents.x[i], w->state.agents.y[i] - (float)get_sheet(t) * s->pitch};
    return jox_lift_contains(t->lift, at);
}

/* Returns how far an agent is before a door, and how far beside its middle, m. */
static JoxV2 get_before_door(const JoxLiftStop *stop, JoxV2 plan) {
    const JoxV2 from = jox_sub(plan, stop->middle);
    return (JoxV2){jox_dot(from, jox_left(stop->out)), jox_dot(from, stop->out)};
}

/* Returns the point of the plan that is so far beside the middle of a door, and before it. */
static JoxV2 get_point_at_door(const JoxLiftStop *stop, float beside, float before) {
    return jox_add(stop->middle,
                   jox_add(jox_scale(jox_left(stop->out), beside), jox_scale(stop->out, before)));
}

void jox_lift_count_people(JoxLiftTurn *t) {
    const JoxAgents *a = &t->world->state.agents;
    const JoxLiftStop *stop = &t->lift->stops[t->car->stop];
    if (t->car->door == JOX_DOOR_SHUT && t->world->state.tick > 0)
        return;
    t->car->people = 0;
    t->car->mass = 0.0f;
    const float shift = (float)get_sheet(t) * t->world->model.storeys.pitch;
    double mass = 0.0;
    for (uint32_t rank = 0; rank < a->count;
         rank++) { /* in an order that does not depend on memory */
        const uint32_t i = a->by_rank[rank];
        const JoxV2 plan = {a->x[i], a->y[i] - shift};
        if (!jox_is_within(plan, jox_sub(t->lift->low, jox_v2(1.0f, 1.0f)),
                           jox_add(t->lift->high, jox_v2(1.0f, 1.0f))))
            continue;
        if (jox_lift_contains(t->lift, plan)) {
            t->car->people++;
            mass += (double)jox_param(a, JOX_PARAM_mass, i);
        }
        const JoxV2 at = get_before_door(stop, plan);
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
        if (!is_in_car(t, i))
            continue;
        a->y[i] += by;
        a->prev_y[i] += by;
        a->still_y[i] += by;
    }
    jox_nav_invalidate_order(w->scratch.nav);
}

/* ---- waiting ---- */

/* Returns whether a standing wall, open gates and doors of lifts aside, lies between two positions.
 */
static bool is_walled_off(const JoWorld *w, JoxV2 from, JoxV2 to) {
    return jox_walls_lie_between(jox_world_walls(w), from, to, NULL);
}

/* Lays out the spots where people wait before a door: to either side of the way out, and behind one
   another. */
static const JoxLobby *get_lobby(const JoxLiftTurn *t, uint32_t s) {
    const float GRID = 0.7f, BEFORE = 0.65f, FAR = 4.2f, WAY_OUT = 2.6f, SIDE = 0.25f;
    JoWorld *w = t->world;
    JoxLobby *lobby = &w->scratch.lifts.lobbies[t->number * w->scratch.lifts.stride + s];
    const JoxLiftStop *stop = &t->lift->stops[s];
    const JoxStoreys *storeys = &w->model.storeys;
    if (lobby->laid && lobby->walls_version == w->state.walls_version)
        return lobby;
    *lobby = (JoxLobby){.laid = true, .walls_version = w->state.walls_version};
    const JoxV2 front = jox_on_sheet(storeys, stop->storey, get_point_at_door(stop, 0.0f, BEFORE));
    float costs[JOX_MOST_LOBBY_SPOTS];
    const int columns = (int)(FAR / GRID), rows = columns;
    for (int row = 0; row < rows; row++)
        for (int column = -columns; column <= columns; column++) {
            const float before = BEFORE + (float)row * GRID;
            const float beside = (float)column * GRID;
            if (fabsf(beside) < stop->half + 0.15f && before < WAY_OUT)
                continue;
            const float cost = before + fabsf(beside);
            const JoxV2 at =
                jox_on_sheet(storeys, stop->storey, get_point_at_door(stop, beside, before));
            const JoxV2 aside = jox_scale(jox_left(stop->out), beside < 0.0f ? -SIDE : SIDE);
            if (is_walled_off(w, front, jox_add(at, aside)) ||
                is_walled_off(w, at, jox_add(at, jox_scale(stop->out, SIDE))) ||
                !jox_is_floor(storeys, at))
                continue;
            uint32_t n = lobby->count < JOX_MOST_LOBBY_SPOTS ? lobby->count++ : lobby->count - 1;
            if (n == lobby->count - 1 && lobby->count == JOX_MOST_LOBBY_SPOTS && cost >= costs[n] &&
                n > 0 && lobby->spots[n].x != 0.0f)
                continue;
            for (; n > 0 && costs[n - 1] > cost; n--) {
                costs[n] = costs[n - 1];
                lobby->spots[n] = lobby->spots[n - 1];
            }
            costs[n] = cost;
            lobby->spots[n] = at;
        }
    return lobby;
}

/* Returns the first spot, of `count`, that no other rider of this lift has who is at the same stop
   and inside or outside as this one; -1: none. */
static int32_t find_free_spot(const JoxLiftTurn *t, const JoxRider *rider, bool inside,
                              uint32_t count) {
    const JoxLiftState *state = &t->world->state.lifts;
    for (uint32_t k = 0; k < count; k++) {
        bool taken = false;
        for (uint32_t r = 0; r < state->rider_count && !taken; r++) {
            const JoxRider *other = &state->riders[r];
            const bool in = other->phase == JOX_RIDE_INSIDE || other->phase == JOX_RIDE_LEAVE ||
                            other->phase == JOX_RIDE_ASIDE;
            const bool waits = other->phase == JOX_RIDE_WAIT || other->phase == JOX_RIDE_BOARD;
            taken = other != rider && other->lift == t->number && other->spot == (int32_t)k &&
                    (inside ? in : waits && other->from == rider->from);
        }
        if (!taken)
            return (int32_t)k;
    }
    return -1;
}

/* ---- phases ---- */

static void begin_waiting(JoxLiftTurn *t, JoxRider *rider, uint32_t i) {
    const JoWorld *w = t->world;
    rider->phase = JOX_RIDE_WAIT;
    rider->since = (uint32_t)w->state.tick;
    rider->spot = find_free_spot(t, rider, false, get_lobby(t, rider->from)->count);
    rider->x = w->state.agents.x[i]; /* stays where it is if there is no spot */
    rider->y = w->state.agents.y[i];
}

static void come_in(JoxLiftTurn *t, JoxRider *rider) {
    JoxLiftFigures *f = t->figures;
    const double dt = t->world->model.def.dt;
    JOX_RESERVE(f->waits, f->wait_capacity, f->wait_count + 1);
    f->waits[f->wait_count++] = (float)((double)(t->world->state.tick - rider->since) * dt);
    f->carried++;
    rider->phase = JOX_RIDE_INSIDE;
    rider->since = (uint32_t)t->world->state.tick;
    rider->spot = find_free_spot(t, rider, true, t->lift->spot_count);
    t->car->quiet = 0.0;
    if (t->car->direction == 0 && rider->to != t->car->stop)
        t->car->direction = rider->to > t->car->stop ? 1 : -1;
}

/* Updates an agent that is outside: on its way, or waiting. */
static void update_outside(JoxLiftTurn *t, JoxRider *rider, uint32_t i) {
    const JoWorld *w = t->world;
    const JoxStoreys *s = &w->model.storeys;
    const JoxV2 at = {w->state.agents.x[i], w->state.agents.y[i]};
    if (rider->phase == JOX_RIDE_APPROACH)
        rider->from = jox_lift_near_stop(&w->scratch.lifts.view, t->number, at);
    const JoxLiftStop *stop = &t->lift->stops[rider->from];
    const JoxV2 front = jox_on_sheet(s, stop->storey, get_point_at_door(stop, 0.0f, 0.3f));
    const float way = jox_length(jox_sub(at, front));
    if (rider->phase == JOX_RIDE_APPROACH) {
        if (rider->from == rider->to && jox_sheet_of(s, at.y) == stop->storey)
            rider->phase = JOX_RIDE_OVER;
        else if (way < LOBBY && !is_walled_off(w, at, front))
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
        rider->from = t->car->stop;
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
    rider->spot = -1;
    t->figures->let_out++;
    t->figures->ride_s += (double)(t->world->state.tick - rider->since) * t->world->model.def.dt;
    t->car->quiet = 0.0;
}

/* Returns whether a rider that stays in the car stands between the door and one who leaves. */
static bool stands_in_way(const JoxLiftTurn *t, JoxV2 at) {
    const JoWorld *w = t->world;
    const JoxLiftStop *stop = &t->lift->stops[t->car->stop];
    const float before = get_before_door(stop, at).y;
    for (uint32_t r = 0; r < w->state.lifts.rider_count; r++) {
        const JoxRider *rider = &w->state.lifts.riders[r];
        if (rider->lift != t->number || rider->phase != JOX_RIDE_LEAVE)
            continue;
        const JoxV2 leaver = get_before_door(stop, get_plan(w, w->scratch.lifts.index[r]));
        if (leaver.y < before)
            return true;
    }
    return false;
}

static void update_phase(JoxLiftTurn *t, JoxRider *rider, uint32_t i) {
    const JoxLiftStop *stop = &t->lift->stops[t->car->stop];
    const bool inside = is_in_car(t, i), open = t->car->door == JOX_DOOR_OPEN;
    switch ((JoxRidePhase)rider->phase) {
    case JOX_RIDE_LEAVE:
        if (inside)
            update_inside(t, rider);
        else if (get_before_door(stop, get_plan(t->world, i)).y > OUTSIDE || !open)
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
        break;
    case JOX_RIDE_APPROACH:
    case JOX_RIDE_WAIT:
    case JOX_RIDE_BOARD:
        if (inside && (open || rider->phase == JOX_RIDE_APPROACH))
            update_inside(t, rider);
        else
            update_outside(t, rider, i);
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
            rider->from != t->car->stop || (best && rider->since >= best->since))
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
    uint32_t coming = car->people;
    float mass = car->mass;
    for (uint32_t r = 0; r < state->rider_count; r++) {
        const JoxRider *rider = &state->riders[r];
        if (rider->lift != t->number)
            continue;
        if (rider->phase == JOX_RIDE_LEAVE)
            return;
        if (rider->phase == JOX_RIDE_BOARD || rider->phase == JOX_RIDE_ASIDE) {
            coming++;
            mass += jox_param(&t->world->state.agents, JOX_PARAM_mass,
                              t->world->scratch.lifts.index[r]);
        }
    }
    if (car->mode == JOX_LIFT_OUT_OF_USE || car->refuses ||
        (car->mode == JOX_LIFT_FIREMEN && car->stop == t->lift->home))
        return;
    if (car->mode == JOX_LIFT_IN_USE && car->direction != 0 && !has_work_ahead(t))
        car->direction = 0;
    JoxRider *next;
    while (coming < t->lift->capacity && (next = find_next_to_board(t))) {
        const uint32_t i = t->world->scratch.lifts.index[next - state->riders];
        mass += jox_param(&t->world->state.agents, JOX_PARAM_mass, i);
        if (mass > t->lift->load) {
            car->refuses = 1;
            break;
        }
        next->phase = JOX_RIDE_BOARD;
        coming++;
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
            stands_in_way(t, get_plan(w, w->scratch.lifts.index[r])))
            rider->phase = JOX_RIDE_ASIDE;
    }
    admit_waiting(t);
}

/* ---- where they go ---- */

static void send_to(const JoxLiftTurn *t, JoxRider *rider, uint32_t stop, JoxV2 plan) {
    const JoxV2 at = jox_on_sheet(&t->world->model.storeys, t->lift->stops[stop].storey, plan);
    rider->x = at.x;
    rider->y = at.y;
}

/* Sends an agent in through the door: round the corner of the shaft, in line with the door, in. */
static void send_in(const JoxLiftTurn *t, JoxRider *rider, JoxV2 plan) {
    const JoxLiftStop *stop = &t->lift->stops[t->car->stop];
    const JoxV2 at = get_before_door(stop, plan);
    JoxV2 to = {0.0f, -0.5f};
    if (at.y < 0.1f && fabsf(at.x) > stop->half)
        to = (JoxV2){at.x, 0.6f};
    else if (fabsf(at.x) > stop->half - 0.2f)
        to = (JoxV2){at.x > 0.0f ? 0.1f : -0.1f, 0.3f};
    send_to(t, rider, t->car->stop, get_point_at_door(stop, to.x, to.y));
}

/* Sends an agent out: in line with the door, out. */
static void send_out(const JoxLiftTurn *t, JoxRider *rider, JoxV2 plan) {
    const JoxLiftStop *stop = &t->lift->stops[t->car->stop];
    const JoxV2 at = get_before_door(stop, plan);
    JoxV2 to = {0.0f, 1.8f};
    if (at.y < 0.0f && fabsf(at.x) > stop->half - 0.2f)
        to = (JoxV2){at.x > 0.0f ? 0.1f : -0.1f, -0.25f};
    send_to(t, rider, t->car->stop, get_point_at_door(stop, to.x, to.y));
}

static void place_rider(const JoxLiftTurn *t, JoxRider *rider, uint32_t i) {
    const JoxV2 plan = get_plan(t->world, i);
    const JoxLobby *lobby;
    switch ((JoxRidePhase)rider->phase) {
    case JOX_RIDE_APPROACH:
        break;
    case JOX_RIDE_WAIT:
        lobby = get_lobby(t, rider->from);
        if (rider->spot < 0)
            rider->spot = find_free_spot(t, rider, false, lobby->count);
        if (rider->spot >= 0 && (uint32_t)rider->spot < lobby->count) {
            rider->x = lobby->spots[rider->spot].x;
            rider->y = lobby->spots[rider->spot].y;
        }
        break;
    case JOX_RIDE_BOARD:
        send_in(t, rider, plan);
        break;
    case JOX_RIDE_INSIDE:
        if (rider->spot >= 0)
            send_to(t, rider, t->car->stop, t->lift->spots[rider->spot]);
        else
            send_to(t, rider, t->car->stop, plan);
        break;
    case JOX_RIDE_ASIDE:
    case JOX_RIDE_LEAVE:
        send_out(t, rider, plan);
        break;
    case JOX_RIDE_OVER:
        send_to(t, rider, rider->to, get_point_at_door(&t->lift->stops[rider->to], 0.0f, 1.8f));
        break;
    }
}

void jox_lift_place_riders(JoxLiftTurn *t) {
    JoxLiftState *state = &t->world->state.lifts;
    for (uint32_t r = 0; r < state->rider_count; r++)
        if (state->riders[r].lift == t->number)
            place_rider(t, &state->riders[r], t->world->scratch.lifts.index[r]);
}
