#include "world/scheduled_events.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "world/world.h"

enum { MOST_NAMES = 256, LONGEST_NAME = 60 };
static const double NEARLY = 1e-9;   /* s: times of steps are sums of rounded steps */
static const double FASTEST = 100.0; /* m/s, rad/s */
static const double FAR = 10000.0;   /* m */

/* ---- actions ---- */

/* Lists the names of what can be opened and closed: walls and stairs. */
static uint32_t list_gate_names(const JoWorld *world, const char *names[MOST_NAMES]) {
    uint32_t count = 0;
    for (uint32_t r = 0; r < world->model.all_walls.ring_count && count < MOST_NAMES; r++)
        if (world->model.all_walls.rings[r].name)
            names[count++] = world->model.all_walls.rings[r].name;
    for (uint32_t k = 0; k < world->model.storeys.stair_count && count < MOST_NAMES; k++)
        names[count++] = world->model.storeys.stairs[k].name;
    return count;
}

static uint32_t list_body_names(const JoWorld *world, const char *names[MOST_NAMES]) {
    uint32_t count = 0;
    for (uint32_t row = 0; row < jox_bodies_rows(world->state.bodies) && count < MOST_NAMES; row++)
        if (*jox_bodies_name(world->state.bodies, row))
            names[count++] = jox_bodies_name(world->state.bodies, row);
    return count;
}

bool jox_event_refuse_name(const char *kind, const char *name, const char *const *names,
                           uint32_t count, JoxText *why) {
    const char *near = jox_suggest(name, names, count);
    jox_text_printf(why, "there is no %s '%.60s'%s%.60s%s", kind, name,
                    near ? ". Did you mean '" : "", near ? near : "", near ? "'?" : "");
    return false;
}

static bool check_range(const char *what, const double v[3], double most, const char *unit,
                        JoxText *why) {
    for (int k = 0; k < 3; k++)
        if (!(fabs(v[k]) <= most)) {
            jox_text_printf(why, "%s must be from %g to %g %s, not %g", what, -most, most, unit,
                            v[k]);
            return false;
        }
    return true;
}

static uint32_t find_body(const JoWorld *world, const char *name, JoxText *why) {
    const uint32_t row = jox_bodies_find_name(world->state.bodies, name);
    if (row == JOX_NO_BODY) {
        const char *names[MOST_NAMES];
        jox_event_refuse_name("body named", name, names, list_body_names(world, names), why);
    }
    return row;
}

bool jox_event_throw(JoWorld *world, const char *body, const double from[3],
                     const double velocity[3], const double spin[3], JoxText *why) {
    static const double NONE[3] = {0.0, 0.0, 0.0};
    const double *v = velocity ? velocity : NONE, *turn = spin ? spin : NONE;
    if ((from && !check_range("from", from, FAR, "m", why)) ||
        !check_range("velocity", v, FASTEST, "m/s", why) ||
        !check_range("spin", turn, FASTEST, "rad/s", why))
        return false;
    const uint32_t row = find_body(world, body, why);
    if (row == JOX_NO_BODY)
        return false;
    if (jox_world_throw(world, row, from, v, turn))
        return true;
    jox_text_printf(why, "the body '%.60s' is static: it cannot be thrown", body);
    return false;
}

bool jox_event_move(JoWorld *world, const char *body, const double velocity[3],
                    const double spin[3], JoxText *why) {
    const uint32_t row = find_body(world, body, why);
    JoxPose pose;
    if (row == JOX_NO_BODY)
        return false;
    if (!jox_bodies_pose(world->state.bodies, row, &pose) || !pose.kinematic) {
        jox_text_printf(why, "the body '%.60s' is not kinematic: it can be thrown or pushed", body);
        return false;
    }
    const JoxV3 v = {(float)velocity[0], (float)velocity[1], (float)velocity[2]};
    const JoxV3 turn = {(float)spin[0], (float)spin[1], (float)spin[2]};
    return jox_bodies_set_velocity(world->state.bodies, row, v, turn);
}

bool jox_event_open(JoWorld *world, const char *wall, bool open, JoxText *why) {
    if (jox_world_is_lift_door(world, wall)) {
        jox_text_printf(why, "'%.60s' is the door of a lift, which the lift opens and closes",
                        wall);
        return false;
    }
    const bool walls = jox_world_open_walls(world, wall, open) > 0;
    const bool stair = jox_world_close_stair(world, wall, !open);
    if (!walls && !stair) {
        const char *names[MOST_NAMES];
        uint32_t count = list_gate_names(world, names);
        return jox_event_refuse_name(world->model.storeys.stair_count ? "wall or stair named"
                                                                      : "wall named",
                                     wall, names, count, why);
    }
    *(open ? &world->state.statistics.opened : &world->state.statistics.closed) += 1;
    return true;
}

bool jox_event_signal(JoWorld *world, const char *name, JoxText *why) {
    if (!*name || strlen(name) > LONGEST_NAME) {
        jox_text_printf(why, "a signal's name has from 1 to %d bytes", LONGEST_NAME);
        return false;
    }
    JoxMachineRun *machines = &world->machines;
    jox_machines_announce(machines, jox_machines_name(machines, name));
    world->state.statistics.announced++;
    return true;
}

bool jox_event_lift(JoWorld *world, const char *lift, uint32_t mode, JoxText *why) {
    const int32_t l = jox_world_find_lift(world, lift);
    if (l < 0 && (strcmp(lift, "all") != 0 || !world->model.lift_count)) {
        const char *names[JOX_MOST_LIFTS];
        for (uint32_t n = 0; n < world->model.lift_count; n++)
            names[n] = world->model.lifts[n].name;
        return jox_event_refuse_name("lift", lift, names, world->model.lift_count, why);
    }
    jox_world_set_lift_mode(world, l, (JoxLiftMode)mode);
    return true;
}

/* ---- times ---- */

static void run_event(JoWorld *world, const JoxEvent *event) {
    JoxText why = {0};
    bool good = false;
    switch (event->kind) {
    case JOX_EVENT_THROW:
        good = jox_event_throw(world, event->name, event->placed ? event->from : NULL,
                               event->velocity, event->spin, &why);
        break;
    case JOX_EVENT_MOVE:
        good = jox_event_move(world, event->name, event->velocity, event->spin, &why);
        break;
    case JOX_EVENT_OPEN:
    case JOX_EVENT_CLOSE:
        good = jox_event_open(world, event->name, event->kind == JOX_EVENT_OPEN, &why);
        break;
    case JOX_EVENT_SIGNAL:
        good = jox_event_signal(world, event->name, &why);
        break;
    case JOX_EVENT_LIFT:
        good = jox_event_lift(world, event->name, event->mode, &why);
        break;
    case JOX_EVENT_PUSH: /* applied each step while it lasts */
        good = event->place >= 0 || find_body(world, event->name, &why) != JOX_NO_BODY;
        break;
    }
    if (!good) /* the body was lost, or an edit adds it at the next start only */
        jox_text_printf(&world->scratch.messages, "%s:%d:%d: t = %.2f s: %s\n",
                        event->position.file, event->position.line, event->position.column,
                        (double)world->state.tick * world->model.def.dt, why.data ? why.data : "");
    jox_text_free(&why);
}

/* Returns the first time of an event later than `after`; INFINITY if there is none. */
static double find_next_time(const JoxEvent *event, double after) {
    if (event->at > after)
        return event->at;
    if (!(event->every > 0.0))
        return INFINITY;
    JOX_ASSERT(isfinite(after) && event->at <= after);
    double n = floor((after - event->at) / event->every), time = event->at + n * event->every;
    while (!(time > after)) /* division rounds */
        time = event->at + ++n * event->every;
    return time <= event->until + NEARLY ? time : INFINITY;
}

/* ---- pushes ---- */

/* Returns whether a push is under way at a time. */
static bool is_lasting(const JoxEvent *event, double now) {
    double began = event->at;
    if (now < began)
        return false;
    if (event->every > 0.0) {
        const double last = now < event->until ? now : event->until;
        began += floor((last - began) / event->every) * event->every;
    }
    return now < began + event->lasts;
}

static void push_people(JoWorld *world, const JoxEvent *event) {
    JoxAgents *a = &world->state.agents;
    JOX_ASSERT((uint32_t)event->place < world->model.place_count);
    for (uint32_t i = 0; i < a->count; i++) {
        if (!jox_place_contains(world->model.places, (uint32_t)event->place,
                                (JoxV2){a->x[i], a->y[i]}))
            continue;
        a->ext_x[i] += (float)event->force[0];
        a->ext_y[i] += (float)event->force[1];
    }
}

/* Pushes a body at its centre, without turning it. */
static void push_body(JoWorld *world, const JoxEvent *event) {
    const uint32_t row = jox_bodies_find_name(world->state.bodies, event->name);
    const double dt = world->model.def.dt;
    JoxPose pose;
    if (row == JOX_NO_BODY || !jox_bodies_pose(world->state.bodies, row, &pose))
        return;
    const JoxImpulse impulse = {
        .object = row,
        .impulse = {(float)(event->force[0] * dt), (float)(event->force[1] * dt), 0.0f},
        .point = pose.centre};
    jox_bodies_impulses(world->state.bodies, &impulse, 1);
}

/* Applies the pushes that are under way, in the order of the list. */
static void apply_pushes(JoWorld *world, double now) {
    for (uint32_t e = 0; e < world->model.event_count; e++) {
        const JoxEvent *event = &world->model.events[e];
        if (event->kind != JOX_EVENT_PUSH || !is_lasting(event, now))
            continue;
        if (event->place >= 0)
            push_people(world, event);
        else
            push_body(world, event);
    }
}

/* ---- the events of a step ---- */

void jox_world_run_events(JoWorld *world) {
    const double dt = world->model.def.dt;
    const double now = (double)world->state.tick * dt + NEARLY;
    double after = world->state.tick ? (double)(world->state.tick - 1) * dt + NEARLY : -1.0;
    uint32_t done = UINT32_MAX; /* events up to this one were run at time `after` */
    while (world->model.event_count > 0) {
        double least = INFINITY;
        uint32_t next = 0;
        for (uint32_t e = 0; e < world->model.event_count; e++) {
            bool same_time = done != UINT32_MAX && e > done; /* may be due at `after` itself */
            double time =
                find_next_time(&world->model.events[e], same_time ? nextafter(after, -1.0) : after);
            if (time < least) {
                least = time;
                next = e;
            }
        }
        if (!(least <= now))
            break;
        JOX_ASSERT(least > after || (least == after && next > done)); /* none runs twice */
        run_event(world, &world->model.events[next]);
        after = least;
        done = next;
    }
    apply_pushes(world, now);
}

void jox_world_set_events(JoWorld *world, const JoxEvent *events, uint32_t count) {
    world->model.events = events;
    world->model.event_count = count;
}
