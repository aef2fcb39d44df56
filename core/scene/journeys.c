/* Journeys: steps that the agents of a group do one after another. Reads the steps, and writes a
   behaviour for them in Lua, which is loaded like one that a user has written. A step has parts
   (walk, queue, wait, ...), of which each becomes a state of the behaviour. Called by groups.c. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/number/pi.h"
#include "base/text.h"
#include "geom/polygon.h"
#include "scene/scene_draft.h"

enum { MOST_STEPS = 50, MOST_QUEUES = 16, LONGEST_NAME = 60 };

/* ---- reading steps ---- */

/* Reads a duration, a number in s or with a unit, or a distribution; stores its text in Lua. */
void jox_key_read_duration(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    JoxJourneyStep *step = item;
    double seconds;
    JoxDist dist;
    if (!node)
        return;
    if (node->kind != JOX_YAML_SCALAR || !jox_read_dist(r, node, &dist)) {
        if (!jox_read_number(r, node, "s", &seconds))
            return;
        dist = jox_dist_constant(seconds);
    }
    if (dist.kind == JOX_DIST_CONSTANT && !(dist.a >= 0.0 && dist.a <= 1e6)) {
        jox_scene_error(r, node, "out-of-range", NULL, "%s must be from 0 to 1e6 s", key->name);
        return;
    }
    JoxText text = {0};
    jox_dist_print(&dist, &text);
    *JOX_MEMBER(char *, item, key->offset) = jox_arena_text(r->arena, text.data);
    jox_text_free(&text);
    if (!strcmp(key->name, "service"))
        step->served = fabs(jox_dist_middle(&dist));
}

void jox_key_read_queues(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    JoxJourneyStep *step = item;
    const JoxYaml *const *names;
    const uint32_t count = node ? jox_read_names(r, node, &names) : 0;
    (void)key;
    step->queues = jox_arena_take(r->arena, (size_t)count + 1, sizeof *step->queues);
    if (count > MOST_QUEUES)
        jox_scene_error(r, node, "too-many", NULL, "people choose among %d queues at most",
                        MOST_QUEUES);
    for (uint32_t n = 0; n < count && n < MOST_QUEUES; n++) {
        const int32_t place = jox_scene_find_place(r, names[n]);
        if (place < 0)
            continue;
        if (!jox_place_is_queue(&r->draft->scene->places[place]))
            jox_scene_error(r, names[n], "bad-place", "gate: {queue: [[0, 0], [0, 5]]}",
                            "'%.60s' is no queue", names[n]->text);
        step->queues[step->queue_count++] = (uint32_t)place;
    }
}

/* Reads a place of a lift, or a set of such places. */
void jox_key_read_ride(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    JoxJourneyStep *step = item;
    const JoxSceneSpec *s = r->draft->scene;
    step->ride = -1;
    if (!jox_key_read_scalar(r, key, node, "name"))
        return;
    const int32_t place = jox_scene_find_place(r, node);
    if (place < 0)
        return;
    const uint32_t members = s->places[place].member_count;
    int32_t other = members || jox_scene_is_lift_place(s, place) ? -1 : place;
    for (uint32_t m = 0; m < members && other < 0; m++)
        if (!jox_scene_is_lift_place(s, s->places[place].members[m]))
            other = s->places[place].members[m];
    if (other < 0)
        step->ride = place;
    else
        jox_scene_error(r, node, "bad-place", "Places of lifts are LIFT.STOREY: ride: east.first",
                        "the place '%.60s' is no lift's", s->places[other].name);
}

/* Reads the name of walls. */
void jox_key_read_gate(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    if (!jox_key_read_scalar(r, key, node, "name"))
        return;
    jox_scene_check_wall(r, node, false);
    *JOX_MEMBER(char *, item, key->offset) = jox_arena_text(r->arena, node->text);
}

bool jox_finish_step(const JoxReader *r, const JoxYaml *map, void *item, bool good) {
    JoxJourneyStep *step = item;
    const bool any = jox_yaml_get(map, "to") || jox_yaml_get(map, "exit") ||
                     jox_yaml_get(map, "queue") || jox_yaml_get(map, "wait") ||
                     jox_yaml_get(map, "until") || jox_yaml_get(map, "open") ||
                     jox_yaml_get(map, "ride");
    if (!any)
        jox_scene_error(r, map, "missing-key", "{to: hall}, {queue: [gate]} or {exit: door}",
                        "a step has one of to, queue, wait, until, open, ride and exit");
    if (jox_yaml_get(map, "firemen") && !jox_yaml_get(map, "ride"))
        jox_scene_error(r, jox_yaml_get(map, "firemen"), "bad-value", NULL,
                        "firemen belongs to a ride");
    if (jox_yaml_get(map, "service") && !jox_yaml_get(map, "queue"))
        jox_scene_error(r, jox_yaml_get(map, "service"), "bad-value", NULL,
                        "service belongs to a queue");
    if (jox_yaml_get(map, "front") && !jox_yaml_get(map, "to"))
        jox_scene_error(r, jox_yaml_get(map, "front"), "bad-value", "{to: hall, front: stage}",
                        "front belongs to a place to wait in");
    if (step->until && (strlen(step->until) > LONGEST_NAME || strpbrk(step->until, "\"\\\n")))
        jox_scene_error(r, jox_yaml_get(map, "until"), "bad-value", NULL,
                        "a signal's name has up to %d letters, and no quotes", LONGEST_NAME);
    if (step->exit >= 0 && jox_scene_is_lift_place(r->draft->scene, step->exit))
        jox_scene_error(r, jox_yaml_get(map, "exit"), "bad-place",
                        "{ride: east.first}, then an exit on that storey",
                        "people cannot leave by a lift: they ride in it to another storey");
    if (!isfinite(step->share))
        step->share = 1.0;
    return good && any;
}

/* ---- writing the behaviour ---- */

typedef struct Journey {
    const JoxReader *reader;
    const JoxGroup *group;
    JoxText text; /* the behaviour as far as it is written */
} Journey;

static const char *get_place_name(const Journey *j, int32_t place) {
    return j->reader->draft->scene->places[place].name;
}

static const JoxPlace *get_place(const Journey *j, int32_t place) {
    return &j->reader->draft->scene->places[place];
}

/* Parts of a step, and the beginnings of their states' names. A name is the number of the step, the
   part and a place, signal or gate: "3 Queue at gate_1". */
static const char *const PARTS[] = {"Walk to",    "Look round", "Choose",  "Go to",
                                    "Queue at",   "Served at",  "Wait",    "Until",
                                    "Until open", "Ride to",    "Leave by"};
typedef enum { WALK, LOOK, CHOOSE, APPROACH, QUEUE, SERVED, WAIT, UNTIL, OPEN, RIDE, LEAVE } Part;

static void print_state_name(const Journey *j, uint32_t step, Part part, uint32_t queue,
                             char out[256]) {
    const JoxJourneyStep *s = &j->group->journey[step];
    const char *what = part == WALK || part == LOOK ? get_place_name(j, s->to)
                       : part == LEAVE              ? get_place_name(j, s->exit)
                       : part == RIDE               ? get_place_name(j, s->ride)
                       : part == UNTIL              ? s->until
                       : part == OPEN               ? s->gate
                       : part == WAIT || part == CHOOSE
                           ? ""
                           : get_place_name(j, (int32_t)s->queues[queue]);
    snprintf(out, 256, "%u %s%s%.60s", step + 1, PARTS[part], *what ? " " : "", what);
}

/* Whether agents that wait in a step fill an area. */
static bool fills_area(const Journey *j, const JoxJourneyStep *s) {
    return s->to >= 0 && jox_place_is_area(get_place(j, s->to)) && (s->wait || s->until || s->gate);
}

/* Lists the parts of a step in order and returns their number. Of a queue it lists CHOOSE alone. */
static uint32_t list_parts(const Journey *j, uint32_t step, Part parts[8]) {
    const JoxJourneyStep *s = &j->group->journey[step];
    uint32_t count = 0;
    if (s->to >= 0)
        parts[count++] = WALK;
    if (fills_area(j, s) && s->wait) /* the wait begins when they stand */
        parts[count++] = LOOK;
    if (s->queue_count)
        parts[count++] = CHOOSE;
    if (s->wait)
        parts[count++] = WAIT;
    if (s->until)
        parts[count++] = UNTIL;
    if (s->gate)
        parts[count++] = OPEN;
    if (s->ride >= 0)
        parts[count++] = RIDE;
    if (s->exit >= 0)
        parts[count++] = LEAVE;
    JOX_ASSERT(count > 0);
    return count;
}

/* Writes the transitions out of a part of a step, on condition `when`: to the step's next part, or
   to the next steps, each with its share of agents, up to one that all agents do. */
static void write_transitions(Journey *j, uint32_t step, Part part, const char *when) {
    Part parts[8];
    char name[256];
    const uint32_t count = list_parts(j, step, parts);
    for (uint32_t k = 0; k + 1 < count; k++)
        if (parts[k] == part) {
            print_state_name(j, step, parts[k + 1], 0, name);
            jox_text_printf(&j->text, "\n      { to = \"%s\", when = %s },", name, when);
            return;
        }
    for (uint32_t next = step + 1; next < j->group->journey_count; next++) {
        const JoxJourneyStep *s = &j->group->journey[next];
        list_parts(j, next, parts);
        print_state_name(j, next, parts[0], 0, name);
        jox_text_printf(&j->text, "\n      { to = \"%s\", when = %s", name, when);
        if (s->share < 1.0)
            jox_text_printf(&j->text, ", chance = %.9g", s->share);
        jox_text_add(&j->text, " },");
        if (s->share >= 1.0)
            return;
    }
    jox_text_printf(&j->text, "\n      { to = \"Stay\", when = %s },", when);
}

static void open_state(Journey *j, uint32_t step, Part part, uint32_t queue) {
    char name[256];
    print_state_name(j, step, part, queue, name);
    jox_text_printf(&j->text, "    [\"%s\"] = {", name);
}

static void close_state(Journey *j) {
    jox_text_add(&j->text, " },\n");
}

static void write_walk(Journey *j, int32_t place) {
    jox_text_printf(&j->text,
                    " steer = field \"%s\", push = crowd.nudge, push_when = crowd.held_up,",
                    get_place_name(j, place));
}

/* Writes the cost of a queue, s: serving those in it, the way there, and the agent's own error. */
static void write_queue_cost(Journey *j, uint32_t step, uint32_t queue) {
    const JoxJourneyStep *s = &j->group->journey[step];
    const char *name = get_place_name(j, (int32_t)s->queues[queue]);
    jox_text_printf(&j->text, "%.9g * queued \"%s\" + distance(\"%s\") / own.speed + own.whim_%u",
                    s->served > 0.5 ? s->served : 0.5, name, name, queue + 1);
}

/* Writes the states of a choice of queues, and of each queue: the way there, in it, and at its
   head. */
static void write_queue_states(Journey *j, uint32_t step) {
    const JoxJourneyStep *s = &j->group->journey[step];
    char name[256], when[256];
    open_state(j, step, CHOOSE, 0);
    for (uint32_t q = 0; q < s->queue_count; q++) {
        print_state_name(j, step, APPROACH, q, name);
        jox_text_printf(&j->text, "\n      { to = \"%s\"", name);
        for (uint32_t o = q + 1; o < s->queue_count;
             o++) { /* the queues before q were not chosen */
            jox_text_add(&j->text, o == q + 1 ? ", when = (" : "\n          & (");
            write_queue_cost(j, step, q);
            jox_text_add(&j->text, "):at_most(");
            write_queue_cost(j, step, o);
            jox_text_add(&j->text, ")");
        }
        jox_text_add(&j->text, " },");
    }
    close_state(j);
    for (uint32_t q = 0; q < s->queue_count; q++) {
        const char *queue = get_place_name(j, (int32_t)s->queues[q]);
        open_state(j, step, APPROACH, q);
        write_walk(j, (int32_t)s->queues[q]);
        print_state_name(j, step, QUEUE, q, name);
        jox_text_printf(&j->text, "\n      { to = \"%s\", when = near(\"%s\", 2) },", name, queue);
        close_state(j);
        open_state(j, step, QUEUE, q);
        print_state_name(j, step, SERVED, q, name);
        jox_text_printf(&j->text,
                        " steer = queue \"%s\",\n      { to = \"%s\", when = first_in \"%s\" & "
                        "near(\"%s\", 0.5) },",
                        queue, name, queue, queue);
        close_state(j);
        open_state(j, step, SERVED, q); /* the agent stays at the head of the queue */
        jox_text_printf(&j->text, " steer = queue \"%s\", lasts = %s,", queue,
                        s->service ? s->service : "0");
        snprintf(when, sizeof when, "lasted");
        write_transitions(j, step, CHOOSE, when);
        close_state(j);
    }
}

static JoxV2 get_place_centre(const Journey *j, int32_t place) {
    return j->reader->draft->scene->places[place].centre;
}

/* Finds the point that agents come from to a step: the place of the last step before it that has
   one, or the centre of their positions at the start; false if neither is known. */
static bool find_origin(const Journey *j, uint32_t step, JoxV2 *from) {
    const JoxGroup *g = j->group;
    while (step-- > 0) {
        const JoxJourneyStep *s = &g->journey[step];
        if (s->to < 0 && !s->queue_count)
            continue;
        *from = get_place_centre(j, s->queue_count ? (int32_t)s->queues[0] : s->to);
        return true;
    }
    JoxV2 sum = {0.0f, 0.0f};
    for (uint32_t k = 0; k < g->count; k++)
        sum = jox_add(sum, g->positions[k]);
    *from = jox_scale(sum, g->count ? 1.0f / (float)g->count : 0.0f);
    return g->count > 0;
}

/* Returns the direction in which a step's area is filled, deg counter-clockwise from +x: towards
   `front`; else away from where agents come from; else away from their exit; else +y. */
static double compute_front(const Journey *j, uint32_t step) {
    const JoxGroup *g = j->group;
    const JoxJourneyStep *s = &g->journey[step];
    const JoxV2 middle = get_place_centre(j, s->to);
    JoxV2 ahead = {0.0f, 0.0f}, from;
    if (s->front >= 0)
        ahead = jox_sub(get_place_centre(j, s->front), middle);
    if (jox_length2(ahead) < 1.0f && find_origin(j, step, &from))
        ahead = jox_sub(middle, from);
    for (uint32_t k = step; jox_length2(ahead) < 1.0f && k < g->journey_count; k++)
        if (g->journey[k].exit >= 0)
            ahead = jox_sub(middle, get_place_centre(j, g->journey[k].exit));
    return jox_length2(ahead) < 1.0f ? 90.0 : atan2(ahead.y, ahead.x) / JOX_DEGREE;
}

/* Writes how agents wait: they fill an area from its front; elsewhere they stand. */
static void write_standing(Journey *j, uint32_t step) {
    const JoxJourneyStep *s = &j->group->journey[step];
    if (fills_area(j, s))
        jox_text_printf(&j->text, " steer = gather(\"%s\", %.6g),", get_place_name(j, s->to),
                        compute_front(j, step));
    else
        jox_text_add(&j->text, " steer = hold,");
    if (s->front >= 0)
        jox_text_printf(&j->text, " face = \"%s\",", get_place_name(j, s->front));
}

/* Returns whether agents in the ride of a step may hear the signal of a later one, for which they
   wait right after the ride. */
static bool hears_in(const Journey *j, uint32_t ride, uint32_t step) {
    const JoxJourneyStep *steps = j->group->journey;
    bool hears = ride < step && steps[ride].ride >= 0 && steps[step].until && !steps[step].wait &&
                 !steps[step].queue_count;
    for (uint32_t k = ride + 1; k < step; k++)
        hears &= steps[k].share < 1.0; /* steps that they may skip */
    return hears;
}

static bool hears_in_ride(const Journey *j, uint32_t step) {
    bool hears = false;
    for (uint32_t ride = 0; ride < step; ride++)
        hears |= hears_in(j, ride, step);
    return hears;
}

/* Writes the condition that the signal of a step is given, or was given in the ride before it. */
static void print_signal_given(const Journey *j, uint32_t step, char out[256]) {
    const char *signal = j->group->journey[step].until;
    if (hears_in_ride(j, step))
        snprintf(out, 256, "heard \"%.100s\" | in_ride.until_%u:above(0)", signal, step + 1);
    else
        snprintf(out, 256, "heard \"%.100s\"", signal);
}

static void write_part_state(Journey *j, uint32_t step, Part part) {
    const JoxJourneyStep *s = &j->group->journey[step];
    char when[512];
    if (part == CHOOSE) {
        write_queue_states(j, step);
        return;
    }
    open_state(j, step, part, 0);
    switch (part) {
    case WALK:
        write_walk(j, s->to);
        snprintf(when, sizeof when, "arrived \"%.100s\"", get_place_name(j, s->to));
        if (fills_area(j, s)) /* full: do not press into it */
            snprintf(when + strlen(when), sizeof when - strlen(when),
                     " | near(\"%.80s\", 2.5) & density(\"%.80s\"):above(3.8)",
                     get_place_name(j, s->to), get_place_name(j, s->to));
        if (s->until && !s->wait) { /* the signal may come on the way */
            char signal[256];
            print_signal_given(j, step, signal);
            write_transitions(j, step, UNTIL, signal);
        }
        break;
    case LOOK:
        jox_text_add(&j->text, " lasts = 60,");
        write_standing(j, step);
        snprintf(when, sizeof when,
                 "lasted | stuck(3) | now.speed:below(0.15) & after(1) | ~inside \"%.100s\"",
                 get_place_name(j, s->to));
        break;
    case WAIT:
        write_standing(j, step);
        jox_text_printf(&j->text, " lasts = %s,", s->wait);
        snprintf(when, sizeof when, "lasted");
        break;
    case UNTIL:
        write_standing(j, step);
        print_signal_given(j, step, when);
        break;
    case OPEN:
        write_standing(j, step);
        snprintf(when, sizeof when, "open \"%.100s\"", s->gate);
        break;
    case RIDE:
        jox_text_printf(&j->text, " steer = ride \"%s\",", get_place_name(j, s->ride));
        for (uint32_t n = step + 1; n < j->group->journey_count; n++)
            if (hears_in(j, step, n))
                jox_text_printf(&j->text,
                                "\n      { when = heard \"%.100s\", set = { until_%u = 1 } },",
                                j->group->journey[n].until, n + 1);
        snprintf(when, sizeof when, "rode");
        if (!s->firemen)
            snprintf(when, sizeof when, "rode | ~in_use \"%.100s\" & ~riding",
                     get_place_name(j, s->ride));
        break;
    default:
        write_walk(j, s->exit);
        snprintf(when, sizeof when, "inside \"%.100s\"", get_place_name(j, s->exit));
        jox_text_printf(&j->text, "\n      { to = \"Gone\", when = %s },", when);
        close_state(j);
        return;
    }
    write_transitions(j, step, part, when);
    close_state(j);
}

/* Writes the head of the behaviour. own.whim_N is an agent's error in judging queue N of a choice,
   s. */
static void write_behaviour_head(Journey *j) {
    uint32_t most = 0;
    bool hears = false;
    for (uint32_t s = 0; s < j->group->journey_count; s++)
        if (j->group->journey[s].queue_count > most)
            most = j->group->journey[s].queue_count;
    jox_text_printf(&j->text,
                    "-- Made of the journey of group '%s'.\nlocal crowd = require \"crowd\"\n",
                    j->group->name);
    for (uint32_t s = 0, n = 0; s < j->group->journey_count; s++)
        if (hears_in_ride(j, s)) {
            jox_text_printf(&j->text, "%s until_%u = 0", n++ ? "," : "local in_ride = memory {",
                            s + 1);
            hears = true;
        }
    jox_text_printf(&j->text,
                    "%s\nreturn machine {\n  name = \"%s\", version = 1, start = \"Begin\",\n"
                    "  defaults = { speed = normal(1.34, 0.26, 0.6, 2.2), time_gap = "
                    "crowd.time_gap, perception = 3, radius = 0.19 },\n",
                    hears ? " }\n" : "", j->group->name);
    jox_text_add(&j->text, "  own = {");
    for (uint32_t q = 0; q < most; q++)
        jox_text_printf(&j->text, "%s whim_%u = uniform(0, 2)", q ? "," : "", q + 1);
    jox_text_add(&j->text, " },\n");
    jox_text_add(&j->text, "  states = {\n");
}

void jox_write_journey_behaviour(const JoxReader *r, const JoxYaml *map, JoxGroup *group) {
    Journey j = {.reader = r, .group = group};
    Part parts[8];
    JoxText path = {0};
    if (group->journey_count == 0 || group->journey_count > MOST_STEPS) {
        jox_scene_error(r, jox_yaml_get(map, "journey"), "too-many", "journey: [{exit: door}]",
                        "a journey has 1 to %d steps", MOST_STEPS);
        return;
    }
    for (uint32_t s = 0; s + 1 < group->journey_count; s++)
        if (group->journey[s].exit >= 0 && group->journey[s].share >= 1.0)
            jox_scene_error(r, jox_yaml_get(map, "journey"), "bad-value",
                            "Let the exit be the last step, or give it a share",
                            "nobody gets to step %u, as all leave by an exit before", s + 2);
    write_behaviour_head(&j);
    jox_text_add(&j.text, "    Begin = {");
    for (uint32_t next = 0; next < group->journey_count; next++) {
        char name[256];
        list_parts(&j, next, parts);
        print_state_name(&j, next, parts[0], 0, name);
        jox_text_printf(&j.text, "\n      { to = \"%s\"", name);
        if (group->journey[next].share < 1.0)
            jox_text_printf(&j.text, ", chance = %.9g", group->journey[next].share);
        jox_text_add(&j.text, " },");
        if (group->journey[next].share >= 1.0)
            break;
    }
    close_state(&j);
    for (uint32_t s = 0; s < group->journey_count; s++) {
        const uint32_t count = list_parts(&j, s, parts);
        for (uint32_t k = 0; k < count; k++)
            write_part_state(&j, s, parts[k]);
    }
    if (strstr(j.text.data, "to = \"Stay\""))
        jox_text_add(&j.text, "    Stay = { steer = hold },\n");
    if (strstr(j.text.data, "to = \"Gone\""))
        jox_text_add(&j.text, "    Gone = { removes = true },\n");
    jox_text_add(&j.text, "  },\n}\n");
    jox_text_printf(&path, "%s/%s.lua", r->draft->scene->path, group->name);
    group->mix = jox_arena_take(r->arena, 1, sizeof *group->mix);
    *group->mix = (JoxGroupMix){.weight = 1,
                                .position = group->position,
                                .behaviour = jox_arena_text(r->arena, path.data),
                                .text = jox_arena_text(r->arena, j.text.data)};
    group->mix_count = 1;
    jox_text_free(&j.text);
    jox_text_free(&path);
}
