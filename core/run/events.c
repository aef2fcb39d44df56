/* What happens at given times, and what people do to a scene while it runs. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "run/run.h"

enum { MOST_NAMES = 256, LONGEST_NAME = 60 };
static const double NEARLY = 1e-9;   /* s: times of steps are sums of rounded steps */
static const double FASTEST = 100.0; /* m/s, rad/s */
static const double FAR = 10000.0;   /* m */

/* ---- what is done ---- */

static uint32_t wall_names(const JoWorld *world, const char *names[MOST_NAMES]) {
    uint32_t count = 0;
    for (uint32_t r = 0; r < world->model.all_walls.ring_count && count < MOST_NAMES; r++)
        if (world->model.all_walls.rings[r].name)
            names[count++] = world->model.all_walls.rings[r].name;
    return count;
}

static uint32_t body_names(const JoxSceneSpec *spec, const char *names[MOST_NAMES]) {
    uint32_t count = 0;
    for (uint32_t b = 0; b < spec->body_count && count < MOST_NAMES; b++)
        if (spec->bodies[b].def.name)
            names[count++] = spec->bodies[b].def.name;
    return count;
}

static bool unknown(const char *kind, const char *name, const char *const *names, uint32_t count,
                    JoError *error) {
    const char *near = jox_suggest(name, names, count);
    jox_error(error, JO_INPUT, "there is no %s named '%.60s'%s%.60s%s", kind, name,
              near ? ". Did you mean '" : "", near ? near : "", near ? "'?" : "");
    return false;
}

static bool within(const char *what, const double v[3], double most, const char *unit,
                   JoError *error) {
    for (int k = 0; k < 3; k++)
        if (!(fabs(v[k]) <= most)) {
            jox_error(error, JO_INPUT, "%s must be from %g to %g %s, not %g", what, -most, most,
                      unit, v[k]);
            return false;
        }
    return true;
}

bool jox_run_throw(JoScene *scene, const char *body, const double from[3], const double velocity[3],
                   const double spin[3], JoError *error) {
    static const double NONE[3] = {0.0, 0.0, 0.0};
    JoWorld *world = scene->world;
    const double *v = velocity ? velocity : NONE, *turn = spin ? spin : NONE;
    if ((from && !within("from", from, FAR, "m", error)) ||
        !within("velocity", v, FASTEST, "m/s", error) ||
        !within("spin", turn, FASTEST, "rad/s", error))
        return false;
    uint32_t row = jox_bodies_find_name(world->state.bodies, body);
    if (row == JOX_NO_BODY) {
        const char *names[MOST_NAMES];
        uint32_t count = body_names(scene->spec, names);
        return unknown("body", body, names, count, error);
    }
    if (jox_world_throw(world, row, from, v, turn))
        return true;
    jox_error(error, JO_INPUT, "the body '%.60s' is static: it cannot be thrown", body);
    return false;
}

bool jox_run_open(JoScene *scene, const char *wall, bool open, JoError *error) {
    JoWorld *world = scene->world;
    if (jox_world_open_walls(world, wall, open) == 0) {
        const char *names[MOST_NAMES];
        uint32_t count = wall_names(world, names);
        return unknown("wall", wall, names, count, error);
    }
    *(open ? &world->state.statistics.opened : &world->state.statistics.closed) += 1;
    return true;
}

bool jox_run_signal(JoScene *scene, const char *name, JoError *error) {
    if (!*name || strlen(name) > LONGEST_NAME) {
        jox_error(error, JO_INPUT, "a signal's name has from 1 to %d bytes", LONGEST_NAME);
        return false;
    }
    JoxMachineRun *machines = &scene->world->machines;
    jox_machines_announce(machines, jox_machines_name(machines, name));
    scene->world->state.statistics.announced++;
    return true;
}

static void happen(JoScene *scene, const JoxSceneEvent *event) {
    JoError error = {0};
    bool good = false;
    switch (event->kind) {
    case JOX_EVENT_THROW:
        good = jox_run_throw(scene, event->name, event->placed ? event->from : NULL,
                             event->velocity, event->spin, &error);
        break;
    case JOX_EVENT_OPEN:
    case JOX_EVENT_CLOSE:
        good = jox_run_open(scene, event->name, event->kind == JOX_EVENT_OPEN, &error);
        break;
    case JOX_EVENT_SIGNAL:
        good = jox_run_signal(scene, event->name, &error);
        break;
    }
    if (!good) /* a body that fell off the world, or that an edit brings at the next start */
        jox_run_say(scene, "%s:%d:%d: t = %.2f s: %s\n", event->position.file, event->position.line,
                    event->position.column, jo_world_time(scene->world), error.text);
}

/* ---- when ---- */

/* The first time of an event that is later than `after`; INFINITY where there is none. */
static double next_time(const JoxSceneEvent *event, double after) {
    if (event->at > after)
        return event->at;
    if (!(event->every > 0.0))
        return INFINITY;
    double n = floor((after - event->at) / event->every), time = event->at + n * event->every;
    while (!(time > after)) /* division rounds */
        time = event->at + ++n * event->every;
    return time <= event->until + NEARLY ? time : INFINITY;
}

/* What is due follows from the step's number alone, so that an edited list goes on from here. */
void jox_run_events(JoScene *scene) {
    const JoxSceneSpec *spec = scene->spec;
    const double dt = scene->world->model.def.dt;
    const double now = (double)scene->world->state.tick * dt + NEARLY;
    double after =
        scene->world->state.tick ? (double)(scene->world->state.tick - 1) * dt + NEARLY : -1.0;
    uint32_t done = UINT32_MAX; /* at the time `after`: events up to this one */
    while (spec->event_count > 0) {
        double least = INFINITY;
        uint32_t next = 0;
        for (uint32_t e = 0; e < spec->event_count; e++) {
            bool same_time = done != UINT32_MAX && e > done; /* may fall on `after` itself */
            double time = next_time(&spec->events[e], same_time ? nextafter(after, -1.0) : after);
            if (time < least) {
                least = time;
                next = e;
            }
        }
        if (!(least <= now))
            break;
        happen(scene, &spec->events[next]);
        after = least;
        done = next;
    }
}

void jox_run_name_events(JoScene *scene, JoxDiagnostics *diagnostics) {
    JoxMachineRun *machines = &scene->world->machines;
    const char *names[MOST_NAMES];
    uint32_t count = 0;
    bool hooks = false;
    for (uint32_t m = 0; m < machines->set->count; m++) {
        const JoxMachine *machine = machines->set->items[m];
        hooks |= machine->hook_count > 0;
        for (uint32_t n = 0; n < machine->name_count && count < MOST_NAMES; n++)
            if (machine->names[n].uses & JOX_NAME_HEARD)
                names[count++] = machine->names[n].text;
    }
    for (uint32_t e = 0; e < scene->spec->event_count; e++) {
        const JoxSceneEvent *event = &scene->spec->events[e];
        bool heard = event->kind != JOX_EVENT_SIGNAL || hooks;
        if (event->kind == JOX_EVENT_SIGNAL)
            jox_machines_name(machines, event->name); /* steps then find it */
        for (uint32_t n = 0; n < count && !heard; n++)
            heard = strcmp(names[n], event->name) == 0;
        const char *near = heard ? NULL : jox_suggest(event->name, names, count);
        char hint[96] = "";
        if (near)
            strcat(strcat(strcpy(hint, "Did you mean '"), near), "'?");
        if (!heard && diagnostics)
            jox_diag_warn(diagnostics, event->position, "unheard-signal", near ? hint : NULL,
                          "no machine of the scene hears the signal '%.60s'", event->name);
    }
}
