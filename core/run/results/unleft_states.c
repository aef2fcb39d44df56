#include "run/results/unleft_states.h"

#include <string.h>

#include "base/assert.h"
#include "base/format/plurals.h"
#include "base/mem.h"
#include "run/run.h"
#include "run/scene_machines.h"

/* s: nobody is expected to leave a state sooner; and people must have been in a state for so long
   in all before its transitions are expected to fire */
static const double SHORTEST_STAY = 10.0, SHORTEST_TOTAL = 10.0;
enum { MOST_STATES = 4, MOST_TRANSITIONS = 6 }; /* named in sentences */

/* People in a state at the end. */
typedef struct Stay {
    const JoxMachine *machine;
    const JoxState *state;
    uint32_t people;
    double since; /* s: entry of the first of them */
} Stay;

static uint32_t state_number(const JoxMachine *machine, const JoxState *state) {
    return (uint32_t)(state - machine->states);
}

/* Returns how often agents took a transition out of a state, in all versions of the machine. */
static uint64_t count_departures(const JoxMachineCounts *counts, const JoxState *state) {
    uint64_t sum = 0;
    for (uint32_t k = 0; k < state->transition_count; k++)
        sum += state->transitions[k].stays ? 0 : counts->taken[state->first_transition + k];
    for (uint32_t b = 0; b < counts->before_count; b++)
        sum += strcmp(counts->before[b].from, state->name) == 0 ? counts->before[b].taken : 0;
    return sum;
}

static bool has_transitions(const JoxState *state) {
    for (uint32_t k = 0; k < state->transition_count; k++)
        if (!state->transitions[k].stays)
            return true;
    return false;
}

/* Returns how often agents went into a state by transitions of this version. */
static uint64_t count_arrivals(const JoxMachine *machine, const JoxMachineCounts *counts,
                               uint32_t state) {
    uint64_t sum = 0;
    for (uint32_t s = 0; s < machine->state_count; s++)
        for (uint32_t k = 0; k < machine->states[s].transition_count; k++)
            if (machine->states[s].transitions[k].to == state &&
                !machine->states[s].transitions[k].stays)
                sum += counts->taken[machine->states[s].first_transition + k];
    return sum;
}

/* Returns whether a sink took people out of a state, as far as counts can tell: they left it in
   another way than by a transition. */
static bool may_have_been_removed(const JoScene *scene, const JoxMachineCounts *counts,
                                  const Stay *stay) {
    const uint32_t number = state_number(stay->machine, stay->state);
    if (scene->world->state.statistics.removed == 0)
        return false;
    return number == stay->machine->start || counts->before_count > 0 ||
           count_arrivals(stay->machine, counts, number) > stay->people;
}

/* Finds who is in a state at the end. */
static Stay find_stay(const JoScene *scene, uint32_t machine, uint32_t state) {
    const JoxAgents *a = &scene->world->state.agents;
    const double dt = scene->world->model.def.dt;
    const JoxMachine *m = scene->world->machines.set->items[machine];
    Stay stay = {.machine = m, .state = &m->states[state]};
    for (uint32_t i = 0; i < a->count; i++) {
        if (a->machine[i] != machine || a->state[i] != state)
            continue;
        const double since = a->entered[i] * dt;
        stay.since = stay.people == 0 || since < stay.since ? since : stay.since;
        stay.people++;
    }
    return stay;
}

/* Lists the states that nobody left, most people first; the caller frees the list. */
static Stay *list_unleft(const JoScene *scene, uint32_t *count) {
    const JoxMachineSet *set = scene->world->machines.set;
    const double now = jo_world_time(scene->world);
    Stay *list = NULL;
    size_t room = 0;
    *count = 0;
    for (uint32_t m = 0; m < set->count; m++) {
        const JoxMachineCounts *counts = &scene->world->machines.state->counts[m];
        for (uint32_t s = 0; s < set->items[m]->state_count; s++) {
            const JoxState *state = &set->items[m]->states[s];
            if (!has_transitions(state) || count_departures(counts, state) > 0)
                continue;
            const Stay stay = find_stay(scene, m, s);
            if (stay.people == 0 || now - stay.since < SHORTEST_STAY ||
                may_have_been_removed(scene, counts, &stay))
                continue;
            JOX_RESERVE(list, room, *count + 1);
            uint32_t at = (*count)++;
            for (; at > 0 && list[at - 1].people < stay.people; at--)
                list[at] = list[at - 1];
            list[at] = stay;
        }
    }
    return list;
}

/* Returns whether a transition of a state is another one as well: of an outer state, which each
   state within it has. */
static bool is_same_item(const JoxState *a, const JoxTransition *of_a, const JoxState *b,
                         const JoxTransition *of_b) {
    return of_a->level == of_b->level && of_a->item == of_b->item &&
           (a == b || (of_a->level < a->depth && of_a->level < b->depth &&
                       a->around[of_a->level] == b->around[of_a->level]));
}

/* Fate of a transition; for one of an outer state, over all states within it. */
typedef struct Fate {
    bool first;      /* no state before has it, too */
    double spent;    /* s: in all, by all agents, in states that have it */
    uint64_t taken;  /* how often it was taken */
    uint64_t leaves; /* how often agents left these states */
} Fate;

static Fate find_fate(const JoScene *scene, uint32_t machine, const JoxState *from,
                      const JoxTransition *t) {
    const JoxMachine *m = scene->world->machines.set->items[machine];
    const JoxMachineCounts *counts = &scene->world->machines.state->counts[machine];
    Fate fate = {.first = true};
    for (const JoxState *s = m->states; s < m->states + m->state_count; s++)
        for (uint32_t k = 0; k < s->transition_count; k++) {
            if (!is_same_item(from, t, s, &s->transitions[k]))
                continue;
            fate.first = fate.first && s >= from;
            fate.spent +=
                (double)counts->states[state_number(m, s)].spent * scene->world->model.def.dt;
            fate.taken += counts->taken[s->first_transition + k];
            fate.leaves += count_departures(counts, s);
        }
    for (uint32_t b = 0; b < counts->before_count; b++)
        if (!strcmp(counts->before[b].from, from->name) &&
            !strcmp(counts->before[b].to, m->states[t->to].name))
            fate.taken += counts->before[b].taken;
    return fate;
}

/* Visits each transition that never fired, out of states that somebody left; returns how many. */
typedef void NeverVisit(void *context, const JoxMachine *machine, const JoxState *from,
                        const JoxTransition *t, uint32_t number);
static uint32_t visit_never_fired(const JoScene *scene, NeverVisit *visit, void *context) {
    const JoxMachineSet *set = scene->world->machines.set;
    uint32_t number = 0;
    for (uint32_t m = 0; m < set->count; m++) {
        if (jox_run_journey_text(scene->spec, set->items[m]->path)) /* not written by the user */
            continue;
        for (uint32_t s = 0; s < set->items[m]->state_count; s++) {
            const JoxState *from = &set->items[m]->states[s];
            for (uint32_t k = 0; k < from->transition_count; k++) {
                const Fate fate = find_fate(scene, m, from, &from->transitions[k]);
                if (fate.first && fate.taken == 0 && fate.leaves > 0 &&
                    fate.spent >= SHORTEST_TOTAL)
                    visit(context, set->items[m],
                          jox_state_on_level(set->items[m], from, from->transitions[k].level),
                          &from->transitions[k], number++);
            }
        }
    }
    return number;
}

/* Returns whether another transition that a state lists leads to the same state. */
static bool shares_ends(const JoxMachine *machine, const JoxState *from, const JoxTransition *t) {
    uint32_t count = 0;
    for (uint32_t k = 0; k < from->transition_count; k++)
        count += !from->transitions[k].stays && from->transitions[k].level == t->level &&
                 strcmp(jox_transition_leads_to(machine, &from->transitions[k]),
                        jox_transition_leads_to(machine, t)) == 0;
    return count > 1;
}

static void say_never_fired(void *context, const JoxMachine *machine, const JoxState *from,
                            const JoxTransition *t, uint32_t number) {
    if (number >= MOST_TRANSITIONS)
        return;
    jox_text_printf(context, "%s%.60s", number ? ", " : "", from->name);
    if (t->stays)
        jox_text_printf(context, " (reaction of line %d)", t->line);
    else
        jox_text_printf(context, " -> %.60s", jox_transition_leads_to(machine, t));
    if (!t->stays && shares_ends(machine, from, t))
        jox_text_printf(context, " (line %d)", t->line);
}

void jox_run_say_unleft(const JoScene *scene, JoxText *out) {
    uint32_t count;
    char people[JOX_NOUN];
    Stay *list = list_unleft(scene, &count);
    for (uint32_t n = 0; n < count && n < MOST_STATES; n++)
        jox_text_printf(
            out, "%s%.60s (%s%s, since %.0f s)", n ? ", " : " Nobody left ", list[n].state->name,
            jox_state_is_step(list[n].machine, list[n].state) ? "where the sequence waits, " : "",
            jox_noun(people, list[n].people, "person in it|people in it"), list[n].since);
    if (count > MOST_STATES)
        jox_text_printf(out, " and %u more states", count - MOST_STATES);
    if (count)
        jox_text_printf(out,
                        strchr(list[0].state->name, ' ')
                            ? ": `jostle why SCENE --state \"%.60s\"` says what they wait for."
                            : ": `jostle why SCENE --state %.60s` says what they wait for.",
                        list[0].state->name);
    jox_free(list);
    JoxText never = {0};
    const uint32_t fired = visit_never_fired(scene, say_never_fired, &never);
    if (fired)
        jox_text_printf(out, " Never fired, though people were in the state and left it: %s",
                        never.data);
    if (fired > MOST_TRANSITIONS)
        jox_text_printf(out, " and %u more", fired - MOST_TRANSITIONS);
    if (fired)
        jox_text_add(out, ".");
    jox_text_free(&never);
}

/* Adds an item of "never_fired", and begins that array before the first one. */
static void add_never_fired(void *context, const JoxMachine *machine, const JoxState *from,
                            const JoxTransition *t, uint32_t number) {
    JoxJson *json = context;
    if (number == 0)
        jox_json_array(json, "never_fired");
    jox_json_object(json, NULL);
    jox_json_string(json, "machine", machine->name);
    jox_json_string(json, "from", from->name);
    jox_json_string(json, "to", t->stays || t->back ? NULL : jox_transition_leads_to(machine, t));
    jox_json_string(json, "id", t->id);
    jox_json_end(json);
}

void jox_run_add_unleft(const JoScene *scene, JoxJson *json) {
    uint32_t count;
    Stay *list = list_unleft(scene, &count);
    if (count)
        jox_json_array(json, "unleft");
    for (uint32_t n = 0; n < count; n++) {
        jox_json_object(json, NULL);
        jox_json_string(json, "machine", list[n].machine->name);
        jox_json_string(json, "state", list[n].state->name);
        jox_json_whole(json, "people", list[n].people);
        jox_json_digits(json, "since_s", list[n].since, 6);
        jox_json_end(json);
    }
    if (count)
        jox_json_end(json);
    jox_free(list);
    if (visit_never_fired(scene, add_never_fired, json))
        jox_json_end(json);
}
