/* Doors and motion of a lift's car, and its choice of the next stop. In use it serves calls in its
   direction of travel before it turns (collective control); left to firemen it fetches people from
   the storey that comes first, or from the highest, collects others on the way down, and takes all
   to its home storey; out of use it lets its riders out at the next storey. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "world/lift_parts.h"

static const double HOLD = 1.5;     /* s: for which the door stays open after a passage, at least */
static const double PATIENCE = 8.0; /* s without a passage, after which the door waits for nobody */
static const double REOPEN = 2.0;   /* s until a door that met somebody closes again */
static const double GO_HOME = 10.0; /* s after the last call */
static const double NEAR_STOP = 1e-4; /* m */
static const float LIGHT = 30.0f;     /* kg: room for a child, at least */
static const double NEARLY = 1e-6;    /* m, s */

/* Calls of a lift at its stops. */
typedef struct Calls {
    bool to[JOX_MOST_STOREYS], up[JOX_MOST_STOREYS], down[JOX_MOST_STOREYS];
} Calls;

static Calls list_calls(const JoxLiftTurn *t) {
    const JoxLiftState *state = &t->world->state.lifts;
    Calls calls = {0};
    for (uint32_t r = 0; r < state->rider_count; r++) {
        const JoxRider *rider = &state->riders[r];
        if (rider->lift != t->number)
            continue;
        if (rider->phase == JOX_RIDE_INSIDE || rider->phase == JOX_RIDE_LEAVE)
            calls.to[rider->to] = true;
        else if (rider->phase == JOX_RIDE_WAIT && t->car->mode != JOX_LIFT_OUT_OF_USE &&
                 jox_lift_suits(t->world, t->world->scratch.lifts.index[r], t->lift, rider->from,
                                rider->to))
            (rider->to > rider->from ? calls.up : calls.down)[rider->from] = true;
    }
    return calls;
}

static bool has_room(const JoxLiftTurn *t) {
    return t->car->people < t->lift->capacity && t->car->mass + LIGHT <= t->lift->load;
}

/* Returns whether the car, with room or not, has to stop at `s` on its way in a direction; 0: in
   any. */
static bool is_called(const Calls *calls, uint32_t s, int32_t direction, bool room) {
    return calls->to[s] ||
           (room && ((direction >= 0 && calls->up[s]) || (direction <= 0 && calls->down[s])));
}

/* Returns whether the car can still stop at a stop ahead. */
static bool can_stop_at(const JoxLiftTurn *t, uint32_t s) {
    const double way = (double)t->lift->stops[s].height - t->car->height;
    const double v = t->car->speed;
    return v == 0.0 ||
           (way * v > 0.0 && fabs(way) + NEARLY >= v * v / (2.0 * (double)t->lift->acceleration));
}

/* Returns the nearest stop ahead in a direction that is called in that direction; else the farthest
   that is called at all; -1: none. */
static int32_t find_ahead(const JoxLiftTurn *t, const Calls *calls, int32_t direction) {
    const bool room = has_room(t);
    int32_t farthest = -1;
    for (uint32_t n = 0; n < t->lift->stop_count; n++) {
        const uint32_t s = direction > 0 ? n : t->lift->stop_count - 1 - n;
        const double way = (double)t->lift->stops[s].height - t->car->height;
        if (way * direction <= NEARLY || !can_stop_at(t, s))
            continue;
        if (is_called(calls, s, direction, room))
            return (int32_t)s;
        if (is_called(calls, s, 0, room))
            farthest = (int32_t)s;
    }
    return farthest;
}

/* Returns the nearest stop that is called; -1: none. */
static int32_t find_nearest_call(const JoxLiftTurn *t, const Calls *calls) {
    int32_t best = -1;
    double least = INFINITY;
    for (uint32_t s = 0; s < t->lift->stop_count; s++) {
        const double way = fabs((double)t->lift->stops[s].height - t->car->height);
        if (is_called(calls, s, 0, has_room(t)) && way < least) {
            least = way;
            best = (int32_t)s;
        }
    }
    return best;
}

/* Chooses the stop of a car that stands, in use; its own one: the door opens. -1: none. */
static int32_t choose_in_use(JoxLiftTurn *t, const Calls *calls) {
    JoxLiftCar *car = t->car;
    const bool room = has_room(t);
    if (car->direction != 0) {
        const int32_t ahead = find_ahead(t, calls, car->direction);
        if (is_called(calls, car->stop, car->direction, room && !car->refuses))
            return (int32_t)car->stop;
        if (ahead >= 0)
            return ahead;
        car->direction = 0;
    }
    return find_nearest_call(t, calls);
}

static int32_t choose_for_firemen(const JoxLiftTurn *t, const Calls *calls) {
    const JoxLift *lift = t->lift;
    const uint32_t home = lift->home, at = t->car->stop;
    const bool any = t->car->people > 0;
    if (any && at == home)
        return (int32_t)home;
    if (!any && lift->first >= 0 && (uint32_t)lift->first != home &&
        is_called(calls, (uint32_t)lift->first, 0, true))
        return lift->first;
    for (uint32_t n = 0; n < lift->stop_count && (!any || has_room(t)); n++) {
        const uint32_t s = lift->stop_count - 1 - n; /* the highest first */
        const bool between = (s <= at && s > home) || (s >= at && s < home);
        if (s != home && (!any || (between && !(s == at && t->car->refuses))) &&
            is_called(calls, s, 0, true))
            return (int32_t)s;
    }
    return any || at != home ? (int32_t)home : -1;
}

/* Chooses the stop of a car that stands. */
static int32_t choose_stop(JoxLiftTurn *t) {
    const Calls calls = list_calls(t);
    JoxLiftCar *car = t->car;
    int32_t stop = -1;
    if (car->mode == JOX_LIFT_FIREMEN)
        return choose_for_firemen(t, &calls);
    if (car->mode == JOX_LIFT_OUT_OF_USE)
        return car->people ? (int32_t)car->stop : -1;
    stop = choose_in_use(t, &calls);
    car->idle = stop >= 0 ? 0.0 : car->idle + t->world->model.def.dt;
    if (stop < 0 && t->lift->returns && car->idle > GO_HOME && car->stop != t->lift->home)
        stop = (int32_t)t->lift->home;
    return stop;
}

/* Chooses anew where a car that moves stops. */
static void choose_on_the_way(JoxLiftTurn *t) {
    JoxLiftCar *car = t->car;
    const int32_t up = car->speed > 0.0 ? 1 : -1;
    if (car->speed == 0.0 || car->mode == JOX_LIFT_FIREMEN)
        return;
    Calls calls = list_calls(t);
    for (uint32_t s = 0; car->mode == JOX_LIFT_OUT_OF_USE && s < t->lift->stop_count; s++)
        calls.to[s] = true; /* the next one */
    const int32_t stop = find_ahead(t, &calls, up);
    const bool sooner =
        (stop - car->target) * up < 0; /* else it may brake for its target already */
    if (stop >= 0 && (sooner || !is_called(&calls, (uint32_t)car->target, 0, has_room(t))))
        car->target = stop;
}

/* Moves a car towards its target; returns whether it arrived. */
static bool move_car(JoxLiftTurn *t) {
    JoxLiftCar *car = t->car;
    const double dt = t->world->model.def.dt, a = (double)t->lift->acceleration;
    const double to = (double)t->lift->stops[car->target].height;
    const double way = to - car->height, side = way < 0.0 ? -1.0 : 1.0;
    const double before = fabs(car->speed);
    /* greatest speed after this step from which it can brake within the rest of the way */
    const double root = a * a * dt * dt + 8.0 * a * fabs(way) - 4.0 * a * before * dt;
    const double braking = root > 0.0 ? fmax(0.5 * (sqrt(root) - a * dt), 0.0) : 0.0;
    const double v = fmin(fmin(before + a * dt, (double)t->lift->speed), braking);
    const double moved = 0.5 * (before + v) * dt;
    if (moved + NEARLY >= fabs(way) || (v <= a * dt && fabs(way) < 0.5 * a * dt * dt + NEAR_STOP)) {
        t->figures->metres += fabs(way);
        car->height = to;
        car->speed = 0.0;
        return true;
    }
    t->figures->metres += moved;
    car->height += side * moved;
    car->speed = side * v;
    return false;
}

static void set_door(JoxLiftTurn *t, JoxLiftDoor phase, double seconds) {
    JoxLiftCar *car = t->car;
    const bool open = phase == JOX_DOOR_OPEN;
    if (open || phase == JOX_DOOR_CLOSING)
        jox_world_set_lift_door(t->world, t->lift->stops[car->stop].name, open);
    if (open)
        t->figures->open_now = 0.0;
    car->door = phase;
    car->left = seconds;
    car->quiet = 0.0;
}

static void arrive_at_stop(JoxLiftTurn *t) {
    JoxLiftCar *car = t->car;
    const uint32_t from = car->stop, to = (uint32_t)car->target;
    if (from != to && car->people)
        jox_lift_shift_people(t, from, to);
    car->stop = to;
    car->target = -1;
    const Calls calls = list_calls(t);
    if (car->mode == JOX_LIFT_OUT_OF_USE ? car->people > 0 : is_called(&calls, to, 0, true))
        set_door(t, JOX_DOOR_OPENING, (double)t->lift->opening);
}

/* Counts a rider that came in since the last departure. */
static void count_carried(JoxLiftTurn *t, JoxRider *rider) {
    JoxLiftFigures *f = t->figures;
    const double waited = (double)(rider->boarded - rider->since) * t->world->model.def.dt;
    JOX_RESERVE(f->waits, f->wait_capacity, f->wait_count + 1);
    f->waits[f->wait_count++] = (float)waited;
    f->carried++;
    rider->carried = 1;
}

static void depart(JoxLiftTurn *t, uint32_t to) {
    JoxLiftCar *car = t->car;
    car->target = (int32_t)to;
    if (car->mode == JOX_LIFT_IN_USE)
        car->direction = to > car->stop ? 1 : -1;
    car->refuses = 0;
    if (!car->people)
        return;
    JoxLiftState *state = &t->world->state.lifts;
    for (uint32_t r = 0; r < state->rider_count; r++)
        if (state->riders[r].lift == t->number && state->riders[r].phase == JOX_RIDE_INSIDE &&
            !state->riders[r].carried)
            count_carried(t, &state->riders[r]);
    t->figures->trips++;
    t->figures->full_trips += !has_room(t);
    t->figures->filled += (double)car->people / t->lift->capacity;
}

/* Counts who waits at this stop for the car's direction and finds no room. */
static uint32_t count_left_behind(const JoxLiftTurn *t) {
    const JoxLiftState *state = &t->world->state.lifts;
    uint32_t count = 0;
    const bool full = !has_room(t) || t->car->refuses;
    for (uint32_t r = 0; r < state->rider_count && full; r++) {
        const JoxRider *rider = &state->riders[r];
        count += rider->lift == t->number && rider->phase == JOX_RIDE_WAIT &&
                 rider->from == t->car->stop &&
                 (t->car->direction == 0 || (rider->to > rider->from) == (t->car->direction > 0));
    }
    return count;
}

/* Returns whether agents are on their way in or out; after a while without a passage the door waits
   for them no longer. */
static bool holds_door(JoxLiftTurn *t) {
    const JoxLiftState *state = &t->world->state.lifts;
    bool held = false;
    for (uint32_t r = 0; r < state->rider_count; r++) {
        JoxRider *rider = &state->riders[r];
        if (rider->lift != t->number ||
            (rider->phase != JOX_RIDE_BOARD && rider->phase != JOX_RIDE_ASIDE &&
             rider->phase != JOX_RIDE_LEAVE))
            continue;
        held |= t->car->quiet < PATIENCE;
        if (held || rider->phase == JOX_RIDE_LEAVE)
            continue;
        jox_lift_turn_away(t, rider);
        t->car->refuses = 1;
    }
    return held;
}

static void run_open_door(JoxLiftTurn *t) {
    JoxLiftCar *car = t->car;
    const double dt = t->world->model.def.dt;
    t->figures->open_now += dt;
    t->figures->open_most = fmax(t->figures->open_most, t->figures->open_now);
    car->quiet += dt;
    car->left -= dt;
    if (car->quiet < HOLD && car->left < HOLD - car->quiet && car->people)
        car->left = HOLD - car->quiet;
    if (car->left > 0.0 || holds_door(t))
        return;
    const bool overloaded = jox_lift_shed_load(t);
    if (t->blocked || overloaded) {
        t->figures->reopened++;
        car->left = REOPEN;
        jox_lift_arrange_inside(t); /* riders in the door get in */
        return;
    }
    t->figures->left_behind += count_left_behind(t);
    set_door(t, JOX_DOOR_CLOSING, (double)t->lift->closing);
}

/* Runs a car whose door is shut. */
static void run_shut_car(JoxLiftTurn *t) {
    JoxLiftCar *car = t->car;
    if (car->target < 0) {
        const int32_t stop = choose_stop(t);
        if (stop < 0)
            return;
        if ((uint32_t)stop == car->stop) {
            car->refuses = 0;
            set_door(t, JOX_DOOR_OPENING, (double)t->lift->opening);
            return;
        }
        depart(t, (uint32_t)stop);
    }
    choose_on_the_way(t);
    if (move_car(t))
        arrive_at_stop(t);
}

void jox_lift_run_car(JoxLiftTurn *t) {
    JoxLiftCar *car = t->car;
    const double dt = t->world->model.def.dt;
    switch ((JoxLiftDoor)car->door) {
    case JOX_DOOR_SHUT:
        run_shut_car(t);
        break;
    case JOX_DOOR_OPENING:
        car->left -= dt;
        if (car->left <= NEARLY)
            set_door(t, JOX_DOOR_OPEN, (double)t->lift->dwell);
        break;
    case JOX_DOOR_OPEN:
        run_open_door(t);
        break;
    case JOX_DOOR_CLOSING:
        car->left -= dt;
        if (car->left <= NEARLY)
            set_door(t, JOX_DOOR_SHUT, 0.0);
        break;
    }
    JOX_ASSERT(car->stop < t->lift->stop_count);
}
