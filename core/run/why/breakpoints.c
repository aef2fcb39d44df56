/* Breakpoints of a run (jo_scene_break): a listener that looks at the transitions, newcomers and
   signals of each step. The command `run` ends where one is met, the live page pauses. */
#include "run/why/breakpoints.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "jostle_tools.h"

typedef enum BreakVerb { BREAK_ENTERS, BREAK_LEAVES, BREAK_CALLS, BREAK_VERBS } BreakVerb;
static const char *const VERBS[BREAK_VERBS] = {"enters", "leaves", "calls"};

/* One breakpoint: who, does what. */
typedef struct Breakpoint {
    char *text;
    bool has_agent;
    uint32_t agent; /* id */
    int32_t group;  /* index; -1: any */
    BreakVerb verb;
    char *name;   /* of the state or signal */
    bool was_met; /* so far */
} Breakpoint;

enum { MOST_LINES = 8 };

typedef struct Breakpoints {
    Breakpoint *items;
    uint32_t count;
    size_t capacity;
    uint32_t known; /* next id in the step before */
    bool met;       /* in the last step */
    uint32_t agent; /* id of the first who met one */
    JoxText said;   /* breakpoints met in the last step, a line each */
    uint32_t lines; /* number of lines; MOST_LINES of them are written */
} Breakpoints;

/* ---- what happened in a step ---- */

/* Appends the reason of the last transition of a watched agent: ", when after(5) is true". */
static void add_reason(const JoxMachineRun *machines, uint32_t id, JoxText *out) {
    for (uint32_t n = 0; n < machines->watched_count; n++) {
        const JoxWatched *watched = &machines->watched[n];
        if (watched->agent_id != id || !watched->took || watched->tick != machines->tick)
            continue;
        const char *when = watched->why.data ? strstr(watched->why.data, "    when ") : NULL;
        if (when)
            jox_text_printf(out, ", %.*s", (int)strcspn(when + 4, "\n"), when + 4);
    }
}

/* Returns whether an agent that goes from a state to another (NULL: none) does what a breakpoint
   says of states: enters or leaves the named one, or an outer state of that name. */
static bool does_with_state(const Breakpoint *one, const JoxState *from, const JoxState *to) {
    const JoxState *is = one->verb == BREAK_ENTERS ? to : from;
    const JoxState *other = one->verb == BREAK_ENTERS ? from : to;
    return one->verb != BREAK_CALLS && is &&
           (strcmp(is->name, one->name) == 0 ||
            (jox_state_is_in(is, one->name) && !(other && jox_state_is_in(other, one->name))));
}

/* Notes that an agent went from a state to another (NULL: none), or gave a signal, if a breakpoint
   waits for it. */
static void note_deed(Breakpoints *b, const JoScene *scene, uint32_t id, const JoxState *from,
                      const JoxState *to, const char *signal) {
    const JoxMachineRun *machines = &scene->world->machines;
    const JoxAgents *a = machines->agents;
    const uint32_t i = jox_agents_find(a, id);
    for (uint32_t n = 0; n < b->count; n++) {
        const Breakpoint *one = &b->items[n];
        const bool does = signal ? one->verb == BREAK_CALLS && strcmp(one->name, signal) == 0
                                 : does_with_state(one, from, to);
        if (!does || (one->has_agent && one->agent != id) ||
            (one->group >= 0 && (i == JOX_NO_INDEX || a->group[i] != one->group)))
            continue;
        if (!b->met)
            b->agent = id;
        b->met = b->items[n].was_met = true;
        if (b->lines++ >= MOST_LINES)
            continue;
        jox_text_printf(&b->said, "t = %.2f s: breakpoint '%.120s': agent %u",
                        jo_world_time(scene->world), one->text, id);
        if (from && to)
            jox_text_printf(&b->said, " went from %.60s to %.60s", from->name, to->name);
        else if (to)
            jox_text_printf(&b->said, " came in, into %.60s", to->name);
        if (from)
            add_reason(machines, id, &b->said);
        jox_text_add(&b->said, "\n");
    }
}

static const JoxState *present_state(const JoxMachineRun *machines, uint32_t i) {
    const JoxAgents *a = machines->agents;
    return a->machine[i] == JOX_NO_MACHINE
               ? NULL
               : &machines->set->items[a->machine[i]]->states[a->state[i]];
}

/* Returns the state in which an agent came in: the one that it left, if it took a transition in its
   first step; else its present state, or NULL if it is gone. */
static const JoxState *find_first_state(const JoxMachineRun *machines, uint32_t id) {
    for (uint32_t k = 0; k < machines->taken_count; k++)
        if (machines->taken[k].agent_id == id)
            return &machines->set->items[machines->taken[k].machine]
                        ->states[machines->taken[k].from];
    const uint32_t i = jox_agents_find(machines->agents, id);
    return i == JOX_NO_INDEX ? NULL : present_state(machines, i);
}

static void note_newcomers(Breakpoints *b, const JoScene *scene) {
    const JoxAgents *a = &scene->world->state.agents;
    for (; b->known < a->next_id; b->known++) {
        const JoxState *state = find_first_state(&scene->world->machines, b->known);
        if (state)
            note_deed(b, scene, b->known, NULL, state, NULL);
    }
}

static void note_transitions(Breakpoints *b, const JoScene *scene) {
    const JoxMachineRun *machines = &scene->world->machines;
    for (uint32_t k = 0; k < machines->taken_count; k++) {
        const JoxTaken *taken = &machines->taken[k];
        const JoxMachine *machine = machines->set->items[taken->machine];
        const JoxState *from = &machine->states[taken->from], *to = &machine->states[taken->to];
        const uint32_t i = jox_agents_find(machines->agents, taken->agent_id);
        const JoxState *now = i == JOX_NO_INDEX ? NULL : present_state(machines, i);
        note_deed(b, scene, taken->agent_id, from, to, NULL);
        if (now && now != to) /* it became another: the state in which that begins */
            note_deed(b, scene, taken->agent_id, to, now, NULL);
    }
}

static bool look_at_step(void *self, JoScene *scene, JoError *error) {
    Breakpoints *b = self;
    const JoxMachineState *state = scene->world->machines.state;
    const JoxAgents *a = &scene->world->state.agents;
    (void)error;
    b->met = false;
    b->said.length = 0;
    b->lines = 0;
    note_newcomers(b, scene);
    note_transitions(b, scene);
    for (uint32_t k = 0; k < state->called_count; k++)
        note_deed(b, scene, state->called[k].agent_id, NULL, NULL,
                  scene->world->machines.set->names[state->called[k].name]);
    if (b->lines > MOST_LINES)
        jox_text_printf(&b->said, "and %u more\n", b->lines - MOST_LINES);
    for (uint32_t n = 0; n < b->count; n++) { /* keeps the agent watched, for its reason */
        const uint32_t i = b->items[n].has_agent && b->items[n].agent < a->next_id
                               ? jox_agents_find(a, b->items[n].agent)
                               : JOX_NO_INDEX;
        const JoxWatched *watched;
        if (i != JOX_NO_INDEX)
            jox_world_inspect(scene->world, a->slot[i], &watched);
    }
    return true;
}

static void free_breakpoints(void *self) {
    Breakpoints *b = self;
    for (uint32_t n = 0; n < b->count; n++) {
        jox_free(b->items[n].text);
        jox_free(b->items[n].name);
    }
    jox_free(b->items);
    jox_text_free(&b->said);
}

static const JoxListenerKind BREAKPOINTS = {.name = "breakpoints",
                                            .size = sizeof(Breakpoints),
                                            .frame = look_at_step,
                                            .release = free_breakpoints};

bool jox_run_broke(const JoScene *scene, uint32_t *agent) {
    const Breakpoints *b = jox_run_find_listener(scene, &BREAKPOINTS);
    *agent = b ? b->agent : 0;
    return b && b->met;
}

const char *jo_scene_broke(const JoScene *scene) {
    JOX_REQUIRE(scene, NULL);
    const Breakpoints *b = jox_run_find_listener(scene, &BREAKPOINTS);
    return b && b->met ? b->said.data : NULL;
}

/* Appends why a breakpoint on an agent was not met, as far as is known. */
static void say_why_unmet(const JoScene *scene, const Breakpoint *one, JoxText *out) {
    const JoxAgents *a = &scene->world->state.agents;
    const uint32_t i = one->agent < a->next_id ? jox_agents_find(a, one->agent) : JOX_NO_INDEX;
    const JoxState *state = i == JOX_NO_INDEX ? NULL : present_state(&scene->world->machines, i);
    if (one->agent >= a->next_id && a->next_id == 0)
        jox_text_add(out, ": nobody came in");
    else if (one->agent >= a->next_id)
        jox_text_printf(out, ": agent %u never came in, the last who did is agent %u", one->agent,
                        a->next_id - 1);
    else if (i == JOX_NO_INDEX)
        jox_text_printf(out, ": agent %u has left", one->agent);
    else if (!state)
        jox_text_printf(out, ": agent %u has no behaviour", one->agent);
    else if (one->verb != BREAK_CALLS &&
             jox_machine_entry(scene->world->machines.set->items[a->machine[i]], one->name) < 0)
        jox_text_printf(out, ": the behaviour %s of agent %u has no such state",
                        scene->world->machines.set->items[a->machine[i]]->name, one->agent);
    else if (one->verb == BREAK_ENTERS)
        jox_text_printf(out, ": agent %u is in %s; `jostle why SCENE --agent %u --to %s` says more",
                        one->agent, state->name, one->agent, one->name);
    else
        jox_text_printf(out, ": agent %u is in %s", one->agent, state->name);
}

char *jo_scene_unmet(const JoScene *scene) {
    JOX_REQUIRE(scene, NULL);
    JOX_GUARD (NULL, NULL)
        return NULL;
    const Breakpoints *b = jox_run_find_listener(scene, &BREAKPOINTS);
    JoxText out = {0};
    for (uint32_t n = 0; b && n < b->count; n++) {
        if (b->items[n].was_met)
            continue;
        jox_text_printf(&out, "breakpoint '%.120s' was not met in %g s", b->items[n].text,
                        jo_world_time(scene->world));
        if (b->items[n].has_agent)
            say_why_unmet(scene, &b->items[n], &out);
        jox_text_add(&out, "\n");
    }
    return jox_disown(out.data);
}

/* ---- reading ---- */

/* Reports a name that is not known, with the most similar of those that are. */
static bool refuse_break(const char *text, const char *what, const char *given,
                         const char *const *names, size_t count, JoError *error) {
    char hint[JOX_HINT];
    const char *near = jox_did_you_mean(given, names, count, hint);
    jox_error(error, JO_USAGE, "breakpoint '%.120s': there is no %s '%.60s'%s%s", text, what, given,
              near ? ". " : "", near ? near : "");
    return false;
}

/* Checks that some machine has a state, or gives a signal, of this name. */
static bool check_break_name(const JoScene *scene, const Breakpoint *one, JoError *error) {
    const JoxMachineSet *set = scene->world->machines.set;
    const char *names[512];
    size_t count = 0;
    for (uint32_t m = 0; m < set->count; m++) {
        const JoxMachine *machine = set->items[m];
        if (one->verb != BREAK_CALLS && jox_machine_entry(machine, one->name) >= 0)
            return true;
        for (uint32_t s = 0; one->verb != BREAK_CALLS && s < machine->state_count && count < 512;
             s++)
            names[count++] = machine->states[s].name;
        for (uint32_t o = 0; one->verb != BREAK_CALLS && o < machine->outer_count && count < 512;
             o++)
            names[count++] = machine->outer[o].name;
        for (uint32_t n = 0; one->verb == BREAK_CALLS && n < machine->name_count && count < 512;
             n++) {
            if (!(machine->names[n].uses & (JOX_NAME_SIGNALLED | JOX_NAME_HEARD)))
                continue;
            if (strcmp(machine->names[n].text, one->name) == 0)
                return true;
            names[count++] = machine->names[n].text;
        }
    }
    return refuse_break(one->text, one->verb == BREAK_CALLS ? "signal" : "state", one->name, names,
                        count, error);
}

/* Reads who a breakpoint is about: "agent 17", "anybody", or a group. */
static bool read_who(const JoScene *scene, const char *who, Breakpoint *one, JoError *error) {
    const JoxSceneSpec *spec = scene->spec;
    char rest;
    one->group = -1;
    if (strcmp(who, "anybody") == 0)
        return true;
    if (sscanf(who, "agent %u%c", &one->agent, &rest) == 1) {
        one->has_agent = true;
        return true;
    }
    const char **names = jox_alloc(spec->group_count + 1, sizeof *names);
    for (uint32_t g = 0; g < spec->group_count; g++) {
        names[g] = spec->groups[g].name;
        one->group = strcmp(names[g], who) == 0 ? (int32_t)g : one->group;
    }
    const bool found = one->group >= 0 || refuse_break(one->text, "group or agent", who, names,
                                                       spec->group_count, error);
    jox_free(names);
    return found;
}

/* Reads a breakpoint; its texts are freed with the breakpoints also if it is refused. */
static bool read_breakpoint(const JoScene *scene, const char *text, Breakpoint *one,
                            JoError *error) {
    one->text = jox_strdup(text);
    jox_text_clean(one->text);
    for (int verb = 0; verb < BREAK_VERBS; verb++) {
        char word[16];
        snprintf(word, sizeof word, " %s ", VERBS[verb]);
        const char *at = strstr(one->text, word);
        if (!at || at == one->text || !at[strlen(word)])
            continue;
        char *who = jox_strndup(one->text, (size_t)(at - one->text));
        one->verb = (BreakVerb)verb;
        one->name = jox_strdup(at + strlen(word));
        const bool good = read_who(scene, who, one, error) && check_break_name(scene, one, error);
        jox_free(who);
        return good;
    }
    jox_error(error, JO_USAGE,
              "breakpoint '%.120s' is none: it says who does what, as 'agent 17 enters Hide', "
              "'anybody leaves Lesson' or 'GROUP calls SIGNAL'",
              one->text);
    return false;
}

bool jo_scene_break(JoScene *scene, const char *text, JoError *error) {
    JOX_REQUIRE(scene && !scene->def.dry && !scene->world->busy && text, false);
    JOX_GUARD (scene->heap, error)
        return false;
    Breakpoints *b = jox_run_find_listener(scene, &BREAKPOINTS);
    if (!b)
        b = jox_run_attach_listener(scene, &BREAKPOINTS, NULL, error);
    if (!b)
        return false;
    if (b->count == 0)
        b->known = scene->world->state.tick ? scene->world->state.agents.next_id : 0;
    JOX_RESERVE_ZEROED(b->items, b->capacity, b->count + 1);
    b->items[b->count] = (Breakpoint){0};
    if (read_breakpoint(scene, text, &b->items[b->count], error)) {
        b->count++;
        return true;
    }
    jox_free(b->items[b->count].text);
    jox_free(b->items[b->count].name);
    return false;
}
