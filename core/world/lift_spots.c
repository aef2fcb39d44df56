/* Where riders of lifts stand and go: spots before a door and in the car, and the ways in and out
   through the door. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "geom/polygon.h"
#include "geom/wall_way.h"
#include "world/lift_parts.h"

static const float LOBBY = 4.0f; /* m before a door: who stands there without a spot steps aside */
static const float WAY_OUT = 2.6f; /* m before a door: nobody waits in the way out */

/* ---- geometry ---- */

static uint32_t get_sheet(const JoxLiftTurn *t) {
    return t->lift->stops[t->car->stop].storey;
}

JoxV2 jox_lift_plan_of(const JoWorld *w, uint32_t i) {
    return jox_in_plan(&w->model.storeys, (JoxV2){w->state.agents.x[i], w->state.agents.y[i]});
}

bool jox_lift_holds(const JoxLiftTurn *t, uint32_t i) {
    const JoWorld *w = t->world;
    const JoxStoreys *s = &w->model.storeys;
    const JoxV2 at = {w->state.agents.x[i], w->state.agents.y[i] - (float)get_sheet(t) * s->pitch};
    return jox_lift_contains(t->lift, at);
}

JoxV2 jox_lift_before_door(const JoxLiftStop *stop, JoxV2 plan) {
    const JoxV2 from = jox_sub(plan, stop->middle);
    return (JoxV2){jox_dot(from, jox_left(stop->out)), jox_dot(from, stop->out)};
}

JoxV2 jox_lift_point_at_door(const JoxLiftStop *stop, float beside, float before) {
    return jox_add(stop->middle,
                   jox_add(jox_scale(jox_left(stop->out), beside), jox_scale(stop->out, before)));
}

/* ---- spots ---- */

/* Returns whether a standing wall, open gates and doors of lifts aside, lies between two positions.
 */
static bool is_walled_off(const JoWorld *w, JoxV2 from, JoxV2 to) {
    return jox_walls_lie_between(jox_world_walls(w), from, to, NULL);
}

/* Adds a spot to a lobby, in the order of its cost, if there is room or a dearer one gives way. */
static void add_spot(JoxLobby *lobby, float *costs, JoxV2 at, float cost) {
    if (lobby->count == JOX_MOST_LOBBY_SPOTS && cost >= costs[lobby->count - 1])
        return;
    uint32_t n = lobby->count < JOX_MOST_LOBBY_SPOTS ? lobby->count++ : lobby->count - 1;
    for (; n > 0 && costs[n - 1] > cost; n--) {
        costs[n] = costs[n - 1];
        lobby->spots[n] = lobby->spots[n - 1];
    }
    costs[n] = cost;
    lobby->spots[n] = at;
}

/* Returns whether a point of the plan lies before the door of another lift on a storey. */
static bool is_before_other_door(const JoxLiftTurn *t, uint32_t storey, JoxV2 plan) {
    const float CLEAR = 0.3f; /* m */
    for (uint32_t l = 0; l < t->world->model.lift_count; l++) {
        const JoxLift *lift = &t->world->model.lifts[l];
        const int32_t s = jox_lift_stop_at(lift, storey);
        if (l == t->number || s < 0)
            continue;
        const JoxV2 at = jox_lift_before_door(&lift->stops[s], plan);
        if (fabsf(at.x) < lift->stops[s].half + CLEAR && at.y > 0.0f && at.y < WAY_OUT)
            return true;
    }
    return false;
}

/* Lays out the spots where people wait before a door: to either side of the way out, and behind one
   another; in the way out itself only far from the door, and last. */
static const JoxLobby *get_lobby(const JoxLiftTurn *t, uint32_t s) {
    const float GRID = 0.7f, BEFORE = 0.65f, CLEAR = 0.4f, SIDE = 0.25f, LAST = 3.0f; /* m */
    const int COLUMNS = 6, ROWS = 6; /* on either side; behind one another */
    JoWorld *w = t->world;
    JoxLobby *lobby = &w->scratch.lifts.lobbies[t->number * w->scratch.lifts.stride + s];
    const JoxLiftStop *stop = &t->lift->stops[s];
    const JoxStoreys *storeys = &w->model.storeys;
    if (lobby->laid && lobby->walls_version == w->state.walls_version)
        return lobby;
    *lobby = (JoxLobby){.laid = true, .walls_version = w->state.walls_version};
    const JoxV2 front =
        jox_on_sheet(storeys, stop->storey, jox_lift_point_at_door(stop, 0.0f, BEFORE));
    float costs[JOX_MOST_LOBBY_SPOTS];
    for (int row = 0; row < ROWS; row++)
        for (int column = -COLUMNS; column <= COLUMNS; column++) {
            const float before = BEFORE + (float)row * GRID;
            const float side = column < 0 ? -1.0f : column > 0 ? 1.0f : 0.0f;
            const float beside = side * (stop->half + CLEAR) + (float)(column - (int)side) * GRID;
            const JoxV2 plan = jox_lift_point_at_door(stop, beside, before);
            if ((column == 0 && before < WAY_OUT) || is_before_other_door(t, stop->storey, plan))
                continue;
            const JoxV2 at = jox_on_sheet(storeys, stop->storey, plan);
            const JoxV2 aside = jox_scale(jox_left(stop->out), beside < 0.0f ? -SIDE : SIDE);
            if (is_walled_off(w, front, jox_add(at, aside)) ||
                is_walled_off(w, at, jox_add(at, jox_scale(stop->out, SIDE))) ||
                !jox_is_floor(storeys, at))
                continue;
            add_spot(lobby, costs, at, before + fabsf(beside) + (column == 0 ? LAST : 0.0f));
        }
    return lobby;
}

/* Marks the spots near which a rider waits for another lift. */
static void mark_near(const JoxRider *other, const JoxV2 *spots, uint32_t count, bool *taken) {
    const float APART = 0.5f; /* m */
    for (uint32_t k = 0; k < count; k++)
        taken[k] |= jox_length(jox_sub((JoxV2){other->x, other->y}, spots[k])) < APART;
}

/* Returns the first spot, of `count`, that no other rider of this lift has that is at the same stop
   and inside or outside as this one, and near which nobody waits for another lift; -1: none. */
static int32_t find_free_spot(const JoxLiftTurn *t, const JoxRider *rider, const JoxV2 *spots,
                              uint32_t count, bool inside) {
    const JoxLiftState *state = &t->world->state.lifts;
    bool taken[JOX_CAR_SPOTS(JOX_MOST_CAPACITY)] = {false};
    JOX_ASSERT(count <= JOX_CAR_SPOTS(JOX_MOST_CAPACITY));
    for (uint32_t r = 0; r < state->rider_count; r++) {
        const JoxRider *other = &state->riders[r];
        const bool in = other->phase == JOX_RIDE_INSIDE || other->phase == JOX_RIDE_LEAVE ||
                        other->phase == JOX_RIDE_ASIDE;
        const bool waits = other->phase == JOX_RIDE_WAIT || other->phase == JOX_RIDE_BOARD;
        if (other == rider || other->spot < 0)
            continue;
        if (other->lift != t->number) {
            if (waits && !inside)
                mark_near(other, spots, count, taken);
        } else if ((uint32_t)other->spot < count &&
                   (inside ? in : waits && other->from == rider->from)) {
            taken[other->spot] = true;
        }
    }
    for (uint32_t k = 0; k < count; k++)
        if (!taken[k])
            return (int32_t)k;
    return -1;
}

void jox_lift_take_lobby_spot(JoxLiftTurn *t, JoxRider *rider) {
    const JoxLobby *lobby = get_lobby(t, rider->from);
    rider->spot = find_free_spot(t, rider, lobby->spots, lobby->count, false);
}

static float square_way(JoxV2 from, JoxV2 to) {
    const JoxV2 way = jox_sub(to, from);
    return jox_dot(way, way);
}

void jox_lift_arrange_inside(JoxLiftTurn *t) {
    const float WORTH = 0.05f; /* m2 */
    const JoWorld *w = t->world;
    JoxRider *inside[JOX_MOST_CAPACITY];
    JoxV2 at[JOX_MOST_CAPACITY];
    uint32_t count = 0;
    for (uint32_t r = 0; r < w->state.lifts.rider_count && count < JOX_MOST_CAPACITY; r++) {
        JoxRider *rider = &w->state.lifts.riders[r];
        if (rider->lift != t->number || rider->phase != JOX_RIDE_INSIDE)
            continue;
        if (rider->spot < 0 || (uint32_t)rider->spot >= t->lift->spot_count)
            rider->spot = find_free_spot(t, rider, t->lift->spots, t->lift->spot_count, true);
        if (rider->spot < 0)
            continue;
        inside[count] = rider;
        at[count++] = jox_lift_plan_of(w, w->scratch.lifts.index[r]);
    }
    bool changed = count > 1;
    for (uint32_t pass = 0; changed && pass < count; pass++) {
        changed = false;
        for (uint32_t p = 0; p + 1 < count; p++)
            for (uint32_t q = p + 1; q < count; q++) {
                const JoxV2 *spots = t->lift->spots;
                const JoxV2 to_p = spots[inside[p]->spot], to_q = spots[inside[q]->spot];
                if (square_way(at[p], to_q) + square_way(at[q], to_p) + WORTH >=
                    square_way(at[p], to_p) + square_way(at[q], to_q))
                    continue;
                const int32_t spot = inside[p]->spot;
                inside[p]->spot = inside[q]->spot;
                inside[q]->spot = spot;
                changed = true;
            }
    }
}

/* ---- ways ---- */

static void send_to(const JoxLiftTurn *t, JoxRider *rider, uint32_t stop, JoxV2 plan) {
    const JoxV2 at = jox_on_sheet(&t->world->model.storeys, t->lift->stops[stop].storey, plan);
    rider->x = at.x;
    rider->y = at.y;
}

/* Returns whether an agent stands beside the shaft, not yet before its front. */
static bool is_beside_shaft(const JoxLiftStop *stop, JoxV2 plan) {
    const JoxV2 at = jox_lift_before_door(stop, plan);
    return at.y < 0.1f && fabsf(at.x) > stop->half;
}

/* Sends an agent from beside the shaft straight on to before its front. */
static void send_before(const JoxLiftTurn *t, JoxRider *rider, JoxV2 plan) {
    const JoxLiftStop *stop = &t->lift->stops[rider->from];
    const JoxV2 at = jox_lift_before_door(stop, plan);
    send_to(t, rider, rider->from, jox_lift_point_at_door(stop, at.x, 0.6f));
}

/* Sends an agent in through the door: round the corner of the shaft, in line with the door, in. */
static void send_in(const JoxLiftTurn *t, JoxRider *rider, JoxV2 plan) {
    const JoxLiftStop *stop = &t->lift->stops[t->car->stop];
    const JoxV2 at = jox_lift_before_door(stop, plan);
    JoxV2 to = {0.0f, -0.5f};
    if (is_beside_shaft(stop, plan)) {
        send_before(t, rider, plan);
        return;
    }
    if (fabsf(at.x) > stop->half - 0.2f)
        to = (JoxV2){at.x > 0.0f ? 0.1f : -0.1f, 0.3f};
    send_to(t, rider, t->car->stop, jox_lift_point_at_door(stop, to.x, to.y));
}

/* Sends an agent out: in line with the door, out. */
static void send_out(const JoxLiftTurn *t, JoxRider *rider, JoxV2 plan) {
    const JoxLiftStop *stop = &t->lift->stops[t->car->stop];
    const JoxV2 at = jox_lift_before_door(stop, plan);
    JoxV2 to = {0.0f, 1.8f};
    if (at.y < 0.0f && fabsf(at.x) > stop->half - 0.2f)
        to = (JoxV2){at.x > 0.0f ? 0.1f : -0.1f, -0.25f};
    send_to(t, rider, t->car->stop, jox_lift_point_at_door(stop, to.x, to.y));
}

/* Returns whether a rider goes out: it leaves, steps out for others, or found no room. */
static bool goes_out(const JoxLiftTurn *t, const JoxRider *rider, uint32_t i) {
    return rider->phase == JOX_RIDE_LEAVE || rider->phase == JOX_RIDE_ASIDE ||
           (rider->phase == JOX_RIDE_WAIT && t->car->door == JOX_DOOR_OPEN && jox_lift_holds(t, i));
}

/* Returns whether another rider that passes the door the same way is nearer to it, and beside this
   one, where the door is too narrow for both: it goes first. */
static bool has_to_let_pass(const JoxLiftTurn *t, const JoxRider *rider, uint32_t i) {
    const float NEAR = 1.0f, BESIDE = 0.8f; /* m; share of the distance at which two touch */
    const JoWorld *w = t->world;
    const JoxAgents *a = &w->state.agents;
    const JoxLiftStop *stop = &t->lift->stops[t->car->stop];
    const bool out = goes_out(t, rider, i);
    const float side = out ? -1.0f : 1.0f; /* of the door from which they come */
    const float radius = jox_param(a, JOX_PARAM_radius, i);
    const JoxV2 at = jox_lift_before_door(stop, jox_lift_plan_of(w, i));
    const float way = jox_length(at);
    if (way > NEAR || side * at.y < 0.0f)
        return false;
    for (uint32_t r = 0; r < w->state.lifts.rider_count; r++) {
        const JoxRider *other = &w->state.lifts.riders[r];
        const uint32_t j = w->scratch.lifts.index[r];
        if (other == rider || other->lift != t->number ||
            !(out ? goes_out(t, other, j) : other->phase == JOX_RIDE_BOARD))
            continue;
        const float both = radius + jox_param(a, JOX_PARAM_radius, j);
        const JoxV2 its = jox_lift_before_door(stop, jox_lift_plan_of(w, j));
        const float its_way = side * its.y < 0.0f ? -jox_length(its) : jox_length(its);
        const bool first = its_way < way || (its_way == way && other->id < rider->id);
        if (first && way - its_way < BESIDE * both && stop->half < both)
            return true;
    }
    return false;
}

/* Sends an agent that stands before or in an open door, with no spot, out of the way. */
static void send_aside(const JoxLiftTurn *t, JoxRider *rider, JoxV2 plan) {
    const JoxLiftStop *stop = &t->lift->stops[rider->from];
    const JoxV2 at = jox_lift_before_door(stop, plan);
    const float clear = stop->half + 0.5f;
    if (fabsf(at.x) >= clear || at.y > LOBBY)
        send_to(t, rider, rider->from, plan);
    else
        send_to(t, rider, rider->from,
                jox_lift_point_at_door(stop, at.x < 0.0f ? -clear : clear, jox_maxf(at.y, 0.6f)));
}

static void place_rider(JoxLiftTurn *t, JoxRider *rider, uint32_t i) {
    const float BACK = 0.4f; /* m */
    const JoxLiftStop *stop = &t->lift->stops[t->car->stop];
    const JoxV2 plan = jox_lift_plan_of(t->world, i);
    const bool out = goes_out(t, rider, i);
    if ((out || rider->phase == JOX_RIDE_BOARD) && has_to_let_pass(t, rider, i)) {
        send_to(t, rider, t->car->stop, jox_add(plan, jox_scale(stop->out, out ? -BACK : BACK)));
        return;
    }
    if (out) {
        send_out(t, rider, plan);
        return;
    }
    switch ((JoxRidePhase)rider->phase) {
    case JOX_RIDE_WAIT:
        if (rider->spot < 0)
            jox_lift_take_lobby_spot(t, rider);
        if (is_beside_shaft(&t->lift->stops[rider->from], plan)) {
            send_before(t, rider, plan);
        } else if (rider->spot >= 0 && (uint32_t)rider->spot < get_lobby(t, rider->from)->count) {
            const JoxV2 spot = get_lobby(t, rider->from)->spots[rider->spot];
            rider->x = spot.x;
            rider->y = spot.y;
        } else {
            send_aside(t, rider, plan);
        }
        break;
    case JOX_RIDE_BOARD:
        send_in(t, rider, plan);
        break;
    case JOX_RIDE_INSIDE:
        send_to(t, rider, t->car->stop, rider->spot >= 0 ? t->lift->spots[rider->spot] : plan);
        break;
    case JOX_RIDE_OVER:
        send_to(t, rider, rider->to,
                jox_lift_point_at_door(&t->lift->stops[rider->to], 0.0f, 1.8f));
        break;
    case JOX_RIDE_APPROACH:
    case JOX_RIDE_ASIDE:
    case JOX_RIDE_LEAVE:
        break;
    }
}

void jox_lift_place_riders(JoxLiftTurn *t) {
    JoxLiftState *state = &t->world->state.lifts;
    for (uint32_t r = 0; r < state->rider_count; r++)
        if (state->riders[r].lift == t->number)
            place_rider(t, &state->riders[r], t->world->scratch.lifts.index[r]);
}
