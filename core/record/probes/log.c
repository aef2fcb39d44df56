/* Probe `log`: events of single people: a person enters a state, kicks or throws a body, or is hit
   by a fast one; the highest point and the end of the flight of a body that a person kicked or
   threw. A row gives person and body as they were at the beginning of the step, which is what the
   person's machine saw; for a new state, the body is the moving one nearest to the person. The last
   column says how near to the person a body in the air passes, the least of all. */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "record/probes/probe_parts.h"
#include "record/storey_figures.h"

typedef enum { ENTERS, KICKS, HIT, PEAKS, LANDS, EVENTS } Event;
static const char *const EVENT_NAMES[] = {"enters", "kicks", "hit", "peaks", "lands"};

typedef struct Before { /* a person in the last frame */
    float x, y, speed;
    uint32_t state; /* index in `names` */
    uint8_t known;  /* 0 or 1; not a bool, since a checkpoint may hold any byte */
} Before;

typedef struct Action {
    double time; /* s: end of the step */
    uint32_t person;
    Event event;
    uint32_t group, state; /* indices in `names`; the state is the one after the step */
    Before before;
    int32_t body; /* id of the body; -1: none */
    JoxV3 at;
    float speed, gap; /* speed of the body, m/s; gap between person and body, m */
    float passes; /* m: least distance at which a body in the air passes; INFINITY: none comes */
    uint8_t grounded;
} Action;

typedef struct Flight { /* a body in the air that a person kicked or threw */
    uint32_t row, body; /* row in the objects, and id */
    uint32_t person;    /* key */
    uint32_t rises;     /* 0 or 1: it has not begun to fall */
} Flight;

typedef struct Log {
    char **names; /* names of states and groups, copied: a reload may free those of the frame */
    uint32_t name_count, name_capacity;
    uint32_t *states; /* index in `names` of each state of the frame */
    uint32_t state_capacity;
    Before *before; /* by key */
    uint32_t before_capacity;
    Action *actions;
    uint32_t count, capacity;
    Flight *flights;
    uint32_t flight_count, flight_capacity;
    uint32_t counts[EVENTS];
} Log;

/* Returns the index of a name, adding a copy of it if it is new. */
static uint32_t intern_name(Log *log, const char *text) {
    uint32_t n = 0;
    while (n < log->name_count && strcmp(log->names[n], text) != 0)
        n++;
    if (n == log->name_count) {
        JOX_RESERVE(log->names, log->name_capacity, n + 1);
        log->names[log->name_count++] = jox_strdup(text);
    }
    return n;
}

static float measure_gap(const Before *person, const JoxObject *body, float radius) {
    const float reach = body->footprint_count ? body->disc : body->round;
    return jox_length(jox_v2(body->position.x - person->x, body->position.y - person->y)) - reach -
           radius;
}

/* Returns the row of the moving body nearest to a person; -1 if there is none. */
static int32_t find_nearest_body(const JoxFrame *frame, const Before *person) {
    int32_t best = -1;
    float least = INFINITY;
    for (uint32_t o = 0; frame->objects && o < frame->objects->count; o++) {
        const JoxObject *body = &frame->objects->rows[o];
        const float d2 =
            jox_length2(jox_v2(body->position.x - person->x, body->position.y - person->y));
        if (body->live && body->moves && d2 < least) {
            least = d2;
            best = (int32_t)o;
        }
    }
    return best;
}

/* Returns the least distance at which a body in the air passes a person, m. */
static float find_least_pass(const JoxFrame *frame, const Before *person) {
    float least = INFINITY;
    for (uint32_t o = 0; frame->objects && o < frame->objects->count; o++) {
        const JoxObject *body = &frame->objects->rows[o];
        const JoxV2 offset = {body->position.x - person->x, body->position.y - person->y};
        if (jox_object_flies(body))
            least = jox_minf(least,
                             jox_pass_distance(offset, jox_v2(body->velocity.x, body->velocity.y)));
    }
    return least;
}

/* Adds a row: the person as before the step, and the body in row `row` of the objects, -1 for
   none. */
static void add_action(Log *log, const JoxFrame *frame, uint32_t i, Event event, int32_t row) {
    const Before *before = &log->before[frame->key[i]];
    JOX_RESERVE(log->actions, log->capacity, log->count + 1);
    Action *action = &log->actions[log->count++];
    *action =
        (Action){.time = frame->time,
                 .person = frame->key[i],
                 .event = event,
                 .group = intern_name(
                     log, frame->group && frame->groups ? frame->groups[frame->group[i]] : ""),
                 .state = frame->state ? log->states[frame->state[i]] : 0,
                 .before = *before,
                 .body = -1,
                 .gap = NAN,
                 .passes = find_least_pass(frame, before)};
    log->counts[event]++;
    if (row < 0 || !frame->objects || (uint32_t)row >= frame->objects->count)
        return;
    const JoxObject *body = &frame->objects->rows[row];
    action->body = (int32_t)body->id;
    action->at = body->position;
    action->speed = sqrtf(jox_length2(jox_v2(body->velocity.x, body->velocity.y)) +
                          body->velocity.z * body->velocity.z);
    action->gap = measure_gap(before, body, jox_frame_radius(frame, i, 0.0f));
    action->grounded = body->grounded;
}

/* Begins the flight of the body in row `row`; ends one that it had. */
static void begin_flight(Log *log, const JoxFrame *frame, uint32_t person, uint32_t row) {
    if (!frame->objects || row >= frame->objects->count)
        return;
    const uint32_t body = frame->objects->rows[row].id;
    uint32_t n = 0;
    while (n < log->flight_count && log->flights[n].body != body)
        n++;
    if (n == log->flight_count) {
        JOX_RESERVE(log->flights, log->flight_capacity, n + 1);
        log->flight_count++;
    }
    log->flights[n] = (Flight){.row = row, .body = body, .person = person, .rises = 1};
}

/* Returns the index of a person in a frame; UINT32_MAX if it has left. */
static uint32_t find_person(const JoxFrame *frame, uint32_t key) {
    for (uint32_t i = 0; i < frame->count; i++)
        if (frame->key[i] == key)
            return i;
    return UINT32_MAX;
}

/* Adds rows for flights that are at their highest point or end, and drops those that have ended: on
   the ground, in somebody's hands, or with the body or person gone. */
static void follow_flights(Log *log, const JoxFrame *frame) {
    uint32_t kept = 0;
    for (uint32_t n = 0; n < log->flight_count; n++) {
        Flight flight = log->flights[n];
        const uint32_t i = find_person(frame, flight.person);
        const JoxObject *body = frame->objects && flight.row < frame->objects->count
                                    ? &frame->objects->rows[flight.row]
                                    : NULL;
        if (!body || !body->live || body->id != flight.body || body->held || i == UINT32_MAX)
            continue;
        if (flight.rises && body->velocity.z <= 0.0f && !body->grounded) {
            add_action(log, frame, i, PEAKS, (int32_t)flight.row);
            flight.rises = 0;
        }
        if (body->grounded && !flight.rises)
            add_action(log, frame, i, LANDS, (int32_t)flight.row);
        if (!body->grounded ||
            (flight.rises && body->velocity.z > 0.0f)) /* just leaves the ground */
            log->flights[kept++] = flight;
    }
    log->flight_count = kept;
}

static void take_log_frame(const JoxProbeDef *def, void *state, const JoxFrame *frame,
                           const uint8_t *seen) {
    Log *log = state;
    (void)def;
    JOX_RESERVE_ZEROED(log->before, log->before_capacity, frame->keys);
    intern_name(log, ""); /* name 0 is for people without a state or group */
    JOX_RESERVE(log->states, log->state_capacity, frame->state_count + 1);
    for (uint32_t s = 0; frame->state && s < frame->state_count; s++)
        log->states[s] = intern_name(log, frame->states[s]);
    follow_flights(log, frame);
    for (uint32_t i = 0; i < frame->count; i++) {
        Before *before = &log->before[frame->key[i]];
        const uint32_t now = frame->state ? log->states[frame->state[i]] : 0;
        if (seen[i] && before->known) {
            if (now != before->state)
                add_action(log, frame, i, ENTERS, find_nearest_body(frame, before));
            if (frame->kicked && frame->kicked[i]) {
                add_action(log, frame, i, KICKS, (int32_t)frame->kicked[i] - 1);
                begin_flight(log, frame, frame->key[i], frame->kicked[i] - 1);
            }
            if (frame->struck && frame->struck[i])
                add_action(log, frame, i, HIT, (int32_t)frame->struck[i] - 1);
        }
        *before = (Before){frame->x[i], frame->y[i], jox_length(jox_v2(frame->vx[i], frame->vy[i])),
                           now, true};
    }
}

static void add_log_figures(const JoxProbeDef *def, const void *state, JoxFigures *out) {
    const Log *log = state;
    (void)def;
    jox_figure_add(out, "entered", "entries into states", "", log->counts[ENTERS]);
    jox_figure_add(out, "kicks", "kicks and throws of bodies", "", log->counts[KICKS]);
    jox_figure_add(out, "hits", "hits of people by bodies", "", log->counts[HIT]);
    jox_figure_add(out, "flights", "flights of kicked and thrown bodies that came down", "",
                   log->counts[LANDS]);
}

/* Returns whether all names of actions are in the table, as after a restore. */
static bool are_actions_valid(const Log *log) {
    for (uint32_t k = 0; k < log->before_capacity; k++)
        if (log->before[k].known && log->before[k].state >= log->name_count)
            return false;
    for (uint32_t n = 0; n < log->count; n++) {
        const Action *action = &log->actions[n];
        if (action->group >= log->name_count || action->state >= log->name_count ||
            action->before.state >= log->name_count || (uint32_t)action->event >= EVENTS)
            return false;
    }
    return true;
}

static void list_log_sections(void *state, JoxSections *s) {
    Log *log = state;
    uint32_t names = (uint32_t)jox_section_count(s, "names", log->name_count, 1);
    while (log->name_count < names) { /* when restoring: the names follow below */
        JOX_RESERVE(log->names, log->name_capacity, log->name_count + 1);
        log->names[log->name_count++] = NULL;
    }
    for (uint32_t n = 0; n < log->name_count; n++) {
        jox_section_string(s, "name", &log->names[n]);
        if (!log->names[n])
            log->names[n] = jox_strdup("");
    }
    JOX_SECTION_ROOM(s, "before", log->before, log->before_capacity);
    JOX_SECTION_ARRAY(s, "actions", log->actions, log->count, log->capacity);
    JOX_SECTION_ARRAY(s, "flights", log->flights, log->flight_count, log->flight_capacity);
    JOX_SECTION(s, "counts", log->counts);
    if (!s->failed && !are_actions_valid(log))
        jox_sections_fail(s, "actions", "an action has an unknown state or group");
    if (s->failed)
        log->count = log->before_capacity = log->flight_count = 0;
}

static void write_log_csv(const JoxProbeDef *def, const void *state, FILE *out) {
    const Log *log = state;
    fputs("time [s],what,person,group,from,state,x [m],y [m],speed [m/s],body,body_x [m],"
          "body_y [m],body_z [m],body_speed [m/s],gap [m],lies,passes [m]",
          out);
    jox_csv_put_storey_title(out, def->storeys);
    fputc('\n', out);
    for (uint32_t n = 0; n < log->count; n++) {
        const Action *d = &log->actions[n];
        const JoxV2 at = {d->before.x, d->before.y}, plan = jox_in_plan(def->storeys, at);
        const JoxV2 ball = jox_in_plan(def->storeys, (JoxV2){d->at.x, d->at.y});
        fprintf(out, "%.4f,%s,%u,%s,%s,%s,%.4f,%.4f,%.4f,", d->time, EVENT_NAMES[d->event],
                d->person, log->names[d->group], log->names[d->before.state], log->names[d->state],
                (double)plan.x, (double)plan.y, (double)d->before.speed);
        if (d->body < 0)
            fputs(",,,,,,", out);
        else
            fprintf(out, "%d,%.4f,%.4f,%.4f,%.4f,%.4f,%d", d->body, (double)ball.x, (double)ball.y,
                    (double)d->at.z, (double)d->speed, (double)d->gap, d->grounded != 0);
        fputc(',', out);
        if (isfinite(d->passes))
            fprintf(out, "%.4f", (double)d->passes);
        jox_csv_put_storey(out, def->storeys, at, true);
        fputc('\n', out);
    }
}

static void plot_log(const JoxProbeDef *def, const void *state, bool walls, JoxText *out) {
    const Log *log = state;
    (void)def, (void)walls;
    if (log->count == 0) {
        jox_plot_reason(out, "nothing happened");
        return;
    }
    jox_text_printf(out, "set xlabel 'time (s)'\nset ylabel 'person'\nset yrange [-0.5:*]\n"
                         "set key outside\nplot ");
    static const char *const COLOURS[EVENTS] = {"#1f77b4", "#2ca02c", "#d62728", "#9467bd",
                                                "#8c564b"};
    for (int w = 0; w < EVENTS; w++)
        jox_text_printf(out,
                        "%scsv skip 1 using 1:(strcol(2) eq '%s' ? $3 : NaN) with points pt 7 "
                        "ps %.1f lc '%s' title '%s'",
                        w ? ", " : "", EVENT_NAMES[w], 1.6 - 0.3 * w, COLOURS[w], EVENT_NAMES[w]);
    jox_text_printf(out, "\n");
}

static void free_log_names(void *state) {
    Log *log = state;
    for (uint32_t n = 0; n < log->name_count; n++)
        jox_free(log->names[n]);
}

const JoxProbeCalls jox_probe_log = {
    JOX_PROBE_KIND(Log, log, 1000, 600),
    .frame = take_log_frame,
    .pace = JOX_PACE_ALL,
    .owned = {JOX_OWNED(Log, names), JOX_OWNED(Log, states), JOX_OWNED(Log, before),
              JOX_OWNED(Log, actions), JOX_OWNED(Log, flights)},
    .release = free_log_names,
};
