/* Replaces a machine by a new version while agents are in it (a reload). A plan with all
   comparisons by name is prepared beforehand on any thread; the swap then touches an agent only
   where something differs. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/format/plurals.h"
#include "base/mem.h"
#include "machine/machine_parts.h"

enum { AHEAD = 12 }; /* agents ahead whose draws are prefetched */

/* A parameter that the new version sets differently in a state. */
typedef struct Assignment {
    int parameter;
    int32_t own; /* own slot that holds the value; -1: `value`, the same for all agents */
    float value; /* as the column stores it */
} Assignment;

struct JoxReplacement {
    const JoxMachine *old;
    JoxMachine *next;
    int32_t *state;  /* old state -> next, or -1 */
    int32_t *own;    /* next slot -> old, or -1 */
    uint32_t *moved; /* next slots that continue from another index */
    uint32_t moved_count;
    int32_t *memory; /* next slot -> old of the same type, or -1 */
    bool own_moves, memory_moves, states_move;
    int8_t (*truth)[JOX_MOST_TRANSITIONS]; /* old state: next transition -> old, or -1 */
    bool *truth_moves;                     /* per old state */
    Assignment (*assign)[JOX_PARAM_COUNT]; /* per old state: parameters that the next state sets
                                              differently */
    uint32_t *assign_count;
    bool *tags_change; /* per old state: ignore or push_only differ */
    uint32_t *redrawn; /* next slots that are drawn again */
    uint32_t redrawn_count;
    bool *is_redrawn; /* per next slot */
    double *drawn;    /* by id, a value for each redrawn slot */
    uint32_t drawn_count;
    double *before; /* an agent's own values or memory before the swap */
};

/* Returns the state of `next` that continues `name`, or -1. */
static int find_next_state(const JoxMachine *next, const char *name) {
    const char *now = jox_machine_renamed(next, JOX_PART_STATE, name);
    return jox_machine_entry(next, now ? now : name);
}

/* Returns the old slot that continues as next->own[slot], or -1. Slots without a name are matched
   by their order among the slots of that name. */
static int32_t find_old_own_slot(const JoxMachine *old, const JoxMachine *next, uint32_t slot) {
    const char *before = jox_name_before(old, next, JOX_PART_OWN, next->own[slot].name);
    uint32_t nth = 0;
    for (uint32_t s = 0; s < slot; s++)
        nth += strcmp(next->own[s].name, next->own[slot].name) == 0;
    for (uint32_t s = 0; s < old->own_count; s++)
        if (strcmp(old->own[s].name, before) == 0 && nth-- == 0)
            return (int32_t)s;
    return -1;
}

/* Keeps own values that the scene gave although the new version does not read them: a line that is
   removed and put back changes nothing. */
static void keep_given(const JoxMachine *old, JoxMachine *next) {
    for (int p = JOX_FIRST_RARE_PARAM; p < JOX_PARAM_COUNT; p++)
        if (old->defaults[p].kind == JOX_VALUE_OWN)
            jox_machine_own_parameter(next, (JoxParameter)p);
    for (uint32_t o = 0; o < old->own_count; o++) {
        const JoxOwnSlot *slot = &old->own[o];
        if (!*slot->name || jox_parameter_find(slot->name) >= 0 ||
            jox_machine_has(next, JOX_PART_OWN, slot->name) ||
            jox_machine_renamed(next, JOX_PART_OWN, slot->name))
            continue;
        next->own = jox_realloc(next->own, next->own_count + 1, sizeof *next->own);
        next->own[next->own_count] = *slot;
        next->own[next->own_count].kept = true;
        next->own[next->own_count++].name = jox_strdup(slot->name);
    }
}

/* Returns whether slot `slot` of the new version is a list that held more items before. */
static bool shortens_list(const JoxReplacement *r, uint32_t slot) {
    const int32_t was = r->memory[slot];
    return was >= 0 && !r->next->memory[slot].dormant &&
           r->next->memory[slot].capacity < r->old->memory[was].capacity;
}

/* Maps own values and memory of the new version to old slots, and draws own values whose
   distribution changed. */
static void map_slots(JoxReplacement *r, uint64_t seed) {
    const JoxMachine *old = r->old, *next = r->next;
    r->own_moves = false;
    for (uint32_t s = 0; s < next->own_count; s++) {
        r->own[s] = find_old_own_slot(old, next, s);
        JOX_ASSERT(r->own[s] < (int32_t)old->own_count);
        r->own_moves |= r->own[s] != (int32_t)s;
        if (r->own[s] >= 0 && r->own[s] != (int32_t)s)
            r->moved[r->moved_count++] = s;
        if (r->own[s] >= 0 && jox_dist_same(&old->own[r->own[s]].dist, &next->own[s].dist))
            continue;
        r->is_redrawn[s] = true;
        r->redrawn[r->redrawn_count++] = s;
    }
    r->drawn = jox_alloc((size_t)r->drawn_count * r->redrawn_count + 1, sizeof *r->drawn);
    for (uint32_t d = 0; d < r->redrawn_count; d++) {
        uint32_t s = r->redrawn[d];
        for (uint32_t id = 0; id < r->drawn_count; id++)
            r->drawn[(size_t)id * r->redrawn_count + d] =
                jox_dist_draw(&next->own[s].dist, seed, id, 0, JOX_DRAW_OWN, s);
    }
    for (uint32_t s = 0; s < next->memory_count; s++) {
        r->memory[s] = jox_memory_before(old, next, s);
        r->memory_moves |= r->memory[s] != (int32_t)s || shortens_list(r, s);
    }
}

/* Returns whether a parameter that is written on entering a state has the same value in both
   versions for all agents. */
static bool stays_same_value(const JoxReplacement *r, const JoxValue *a, const JoxValue *b) {
    if (a->kind != b->kind)
        return false;
    if (b->kind == JOX_VALUE_CONST)
        return a->number == b->number;
    if (b->kind == JOX_VALUE_OWN)
        return r->own[b->index] == a->index && !r->is_redrawn[b->index];
    return true; /* expressions are computed each step */
}

/* Maps an old state: its successor, the parameters that differ, and the transitions that
   continue. */
static void map_state(JoxReplacement *r, uint32_t from) {
    const JoxState *was = &r->old->states[from];
    int to = find_next_state(r->next, was->name);
    r->state[from] = to;
    r->states_move |= to != (int)from;
    if (to < 0)
        return;
    const JoxState *is = &r->next->states[to];
    for (int p = 0; p < JOX_PARAM_COUNT; p++) {
        const JoxValue *value = jox_state_parameter(r->next, is, p);
        if (stays_same_value(r, jox_state_parameter(r->old, was, p), value) ||
            value->kind == JOX_VALUE_EXPRESSION)
            continue;
        Assignment *assign = &r->assign[from][r->assign_count[from]++];
        double number = value->kind == JOX_VALUE_CONST ? value->number : jox_parameters[p].value;
        *assign = (Assignment){p, value->kind == JOX_VALUE_OWN ? value->index : -1,
                               jox_parameter_store((JoxParameter)p, number)};
    }
    r->tags_change[from] = was->ignore != is->ignore || was->push_only != is->push_only;
    r->truth_moves[from] = was->transition_count != is->transition_count;
    for (uint32_t k = 0; k < JOX_MOST_TRANSITIONS; k++) {
        r->truth[from][k] = -1;
        for (uint32_t o = 0; k < is->transition_count && o < was->transition_count; o++)
            if (strcmp(was->transitions[o].id, is->transitions[k].id) == 0 &&
                was->transitions[o].level == is->transitions[k].level)
                r->truth[from][k] = (int8_t)o;
        r->truth_moves[from] |= k < is->transition_count && r->truth[from][k] != (int8_t)k;
    }
}

JoxReplacement *jox_replacement_prepare(const JoxMachine *old, JoxMachine *next, uint64_t seed,
                                        uint32_t next_id) {
    JoxReplacement *r = jox_alloc(1, sizeof *r);
    uint32_t states = old->state_count;
    keep_given(old, next);
    jox_dormant_keep(old, next);
    r->old = old;
    r->next = next;
    r->drawn_count = next_id;
    r->state = jox_alloc(states + 1, sizeof *r->state);
    r->truth = jox_alloc(states + 1, sizeof *r->truth);
    r->truth_moves = jox_alloc(states + 1, sizeof *r->truth_moves);
    r->assign = jox_alloc(states + 1, sizeof *r->assign);
    r->assign_count = jox_alloc(states + 1, sizeof *r->assign_count);
    r->tags_change = jox_alloc(states + 1, sizeof *r->tags_change);
    r->own = jox_alloc(next->own_count + 1, sizeof *r->own);
    r->memory = jox_alloc(next->memory_count + 1, sizeof *r->memory);
    r->moved = jox_alloc(next->own_count + 1, sizeof *r->moved);
    r->redrawn = jox_alloc(next->own_count + 1, sizeof *r->redrawn);
    r->is_redrawn = jox_alloc(next->own_count + 1, sizeof *r->is_redrawn);
    r->before = jox_alloc((size_t)old->own_count + old->memory_count + 1, sizeof *r->before);
    map_slots(r, seed);
    for (uint32_t s = 0; s < states; s++)
        map_state(r, s);
    for (uint32_t s = 0; s < next->memory_count && r->states_move; s++)
        r->memory_moves |= next->memory[s].kind == JOX_MEMORY_STATE;
    return r;
}

void jox_replacement_free(JoxReplacement *r) {
    if (!r)
        return;
    jox_free(r->moved);
    jox_free(r->redrawn);
    jox_free(r->is_redrawn);
    jox_free(r->drawn);
    jox_free(r->before);
    jox_free(r->state);
    jox_free(r->own);
    jox_free(r->memory);
    jox_free(r->truth);
    jox_free(r->truth_moves);
    jox_free(r->assign);
    jox_free(r->assign_count);
    jox_free(r->tags_change);
    jox_free(r);
}

uint32_t jox_people_within(const JoxMachine *machine, uint32_t outer, const uint32_t *people) {
    uint32_t all = 0;
    for (uint32_t s = 0; s < machine->state_count; s++)
        if (jox_state_is_within(&machine->states[s], machine->outer[outer].depth, outer))
            all += people[s];
    return all;
}

void jox_machines_people(const JoxMachineRun *run, uint32_t index, uint32_t *people) {
    const JoxAgents *a = run->agents;
    memset(people, 0, run->set->items[index]->state_count * sizeof *people);
    for (uint32_t i = 0; i < a->count; i++)
        if (a->machine[i] == index)
            people[a->state[i]]++;
}

const char *jox_machines_refuses(const JoxMachineRun *run, uint32_t index, const JoxReplacement *r,
                                 char *why, uint32_t size) {
    const JoxMachine *old = run->set->items[index];
    uint32_t people[1000];
    if (old->state_count > 1000)
        return NULL;
    jox_machines_people(run, index, people);
    for (uint32_t s = 0; s < old->state_count; s++) {
        if (r->state[s] >= 0 || people[s] == 0)
            continue;
        char agents[JOX_NOUN];
        snprintf(why, size,
                 "%s in '%s', which this version lacks. Name the state that they go on in: "
                 "renamed = { %s%s%s = \"...\" }",
                 jox_noun(agents, people[s], "agent is|agents are"), old->states[s].name,
                 old->states[s].depth ? "[\"" : "", old->states[s].name,
                 old->states[s].depth ? "\"]" : "");
        return why;
    }
    return NULL;
}

/* Maps the bits of given slots from the old version to the new one. */
static uint64_t map_given(const JoxReplacement *r, uint64_t given) {
    uint64_t now = 0;
    for (uint32_t s = 0; s < r->next->own_count && s < 64; s++)
        if (r->own[s] >= 0 && r->own[s] < 64)
            now |= (given >> r->own[s] & 1) << s;
    return now;
}

/* Moves the agent's own values to their new slots. */
static void carry_own(JoxMachineRun *run, const JoxReplacement *r, uint32_t i) {
    JoxAgents *a = run->agents;
    for (uint32_t k = 0; k < r->moved_count; k++)
        r->before[k] = jox_own(a, i, (uint32_t)r->own[r->moved[k]]);
    for (uint32_t k = 0; k < r->moved_count; k++)
        jox_own_set(a, i, r->moved[k], r->before[k]);
}

/* Draws changed own values again, except those that the agent was given. */
static void redraw_own(JoxMachineRun *run, const JoxReplacement *r, uint32_t i) {
    JoxAgents *a = run->agents;
    uint32_t id = a->id[i];
    uint64_t given = a->given[i];
    const double *drawn = r->drawn + (size_t)id * r->redrawn_count;
    for (uint32_t d = 0; d < r->redrawn_count; d++) {
        uint32_t s = r->redrawn[d];
        if (s < 64 && (given >> s & 1))
            continue;
        const uint32_t general = r->next->own[s].general;
        if (general && general <= 64 && (given >> (general - 1) & 1)) {
            jox_own_set(a, i, s, jox_own(a, i, general - 1));
            a->given[i] |= s < 64 ? (uint64_t)1 << s : 0;
            continue;
        }
        jox_own_set(a, i, s,
                    id < r->drawn_count
                        ? drawn[d]
                        : jox_dist_draw(&r->next->own[s].dist, run->seed, id, 0, JOX_DRAW_OWN, s));
    }
}

/* Returns the value of a slot that continues: a state is that which continues it, or 0. */
static double carry_slot(const JoxReplacement *r, uint32_t slot, double was) {
    if (r->next->memory[slot].kind != JOX_MEMORY_STATE)
        return was;
    const bool known = was >= 1.0 && was <= r->old->state_count;
    return known && r->state[(uint32_t)was - 1] >= 0 ? 1.0 + r->state[(uint32_t)was - 1] : 0.0;
}

/* Returns the value of a slot that begins at the reload. An outer state that is put around the
   agent's state was entered with it, and lasts for ever, as a state that has no duration yet. */
static double begin_slot(const JoxMachineRun *run, const JoxMemorySlot *slot, uint32_t i) {
    const char *identity = jox_memory_identity(slot);
    return *identity == *JOX_IDENTITY_CLOCK   ? run->agents->entered[i]
           : *identity == *JOX_IDENTITY_LASTS ? INFINITY
                                              : slot->initial;
}

/* Writes the newest items of a list that holds fewer in the new version. */
static void shorten_list(const JoxMachineRun *run, const JoxReplacement *r, uint32_t slot,
                         double *memory) {
    double items[JOX_MOST_ITEMS];
    const uint32_t count = jox_list_read(run, r->old, r->before, r->memory[slot], items);
    jox_list_fill(r->next, memory, (int32_t)slot, items, count);
}

/* Moves an agent's memory to its new slots; new memory gets its initial value. */
static void carry_memory(JoxMachineRun *run, const JoxReplacement *r, uint32_t i) {
    JoxAgents *a = run->agents;
    double *memory = a->memory + (size_t)i * a->memory_stride;
    memcpy(r->before, memory, r->old->memory_count * sizeof *memory);
    for (uint32_t s = 0; s < r->next->memory_count; s++)
        memory[s] = r->memory[s] >= 0 ? carry_slot(r, s, r->before[r->memory[s]])
                                      : begin_slot(run, &r->next->memory[s], i);
    for (uint32_t s = 0; s < r->next->memory_count; s++)
        if (shortens_list(r, s))
            shorten_list(run, r, s, memory);
    if (r->next->home && r->memory[r->next->home - 1] < 0)
        jox_set_home_post(run, i); /* first version with a post */
}

/* Moves an agent to the successor of its state, and updates its conditions, memory, parameters and
   tags. */
static void carry_agent(JoxMachineRun *run, const JoxReplacement *r, uint32_t i) {
    JoxAgents *a = run->agents;
    uint16_t was = a->state[i];
    uint16_t is = r->state[was] >= 0 ? (uint16_t)r->state[was] : r->next->start;
    JOX_ASSERT(was < r->old->state_count && is < r->next->state_count);
    a->state[i] = is;
    if (r->truth_moves[was]) {
        uint32_t truth = 0;
        for (uint32_t k = 0; k < r->next->states[is].transition_count; k++)
            if (r->truth[was][k] >= 0)
                truth |= (a->was_true[i] >> r->truth[was][k] & 1) << k;
        a->was_true[i] = truth;
    }
    if (r->memory_moves)
        carry_memory(run, r, i);
    const JoxState *state = &r->next->states[is];
    for (uint32_t k = 0; k < r->assign_count[was]; k++) {
        const Assignment *assign = &r->assign[was][k];
        jox_param_set(a, (JoxParameter)assign->parameter, i,
                      assign->own < 0 ? assign->value
                                      : jox_parameter_store((JoxParameter)assign->parameter,
                                                            jox_own(a, i, (uint32_t)assign->own)));
    }
    if (r->tags_change[was]) {
        a->ignore[i] = state->ignore;
        a->push_only[i] = state->push_only;
    }
}

/* Prefetches the draws of an agent, which are stored by id and so far from those of its neighbours
   in memory. */
static void fetch_ahead(const JoxAgents *a, const JoxReplacement *r, uint32_t i) {
    if (a->id[i] < r->drawn_count)
        __builtin_prefetch(r->drawn + (size_t)a->id[i] * r->redrawn_count);
}

/* Moves the counts of transitions that continue; others are kept by the names of their states. */
static void carry_counts(const JoxReplacement *r, const JoxMachine *old, JoxMachineCounts *was,
                         JoxMachineCounts *is) {
    const JoxMachine *next = r->next;
    for (uint32_t s = 0; s < old->state_count; s++) {
        const JoxState *from = &old->states[s];
        const JoxState *to = r->state[s] < 0 ? NULL : &next->states[r->state[s]];
        for (uint32_t o = 0; o < from->transition_count; o++) {
            const JoxTransition *t = &from->transitions[o];
            uint64_t taken = was->taken[from->first_transition + o];
            uint32_t k = 0;
            while (to && k < to->transition_count &&
                   (r->truth[s][k] != (int8_t)o || to->transitions[k].to != r->state[t->to] ||
                    to->transitions[k].back != t->back))
                k++;
            if (to && k < to->transition_count)
                is->taken[to->first_transition + k] += taken;
            else if (taken && !t->stays) /* reactions are counted by this version alone */
                jox_counts_add_before(was, from->name, jox_transition_leads_to(old, t), taken);
        }
    }
    is->before = was->before;
    is->before_count = was->before_count;
    is->before_capacity = was->before_capacity;
    was->before = NULL;
    was->before_count = 0;
}

void jox_replacement_tell(const JoxReplacement *r, const char *people, JoxText *out) {
    jox_dormant_tell(r->old, r->next, people, out);
}

JoxMachine *jox_machines_replace(JoxMachineRun *run, uint32_t index, const JoxReplacement *r) {
    const JoxMachine *old = run->set->items[index];
    JoxMachine *built = run->set->built[index], *next = r->next;
    JoxAgents *a = run->agents;
    JoxMachineCounts *counts = &run->state->counts[index], was = *counts;
    JOX_ASSERT(r->old == old || r->old == built); /* the plan was prepared for the machine that
                                                     runs */
    *counts = (JoxMachineCounts){0};
    next->reloads = old->reloads + 1;
    jox_machines_put(run, index, next);
    carry_counts(r, old, &was, counts);
    JOX_CHECK(jox_counts_carried_check(&was, counts));
    jox_counts_free(&was);
    bool any = r->memory_moves || r->states_move;
    for (uint32_t s = 0; s < old->state_count; s++)
        any |= r->assign_count[s] || r->truth_moves[s] || r->tags_change[s];
    bool shorter = next->own_count < old->own_count || next->memory_count < old->memory_count;
    bool all = any || shorter || r->own_moves || r->redrawn_count;
    uint64_t given = 0, now = 0; /* bits of the last agent, which are mostly the same */
    for (uint32_t i = 0; all && i < a->count; i++) {
        if (r->redrawn_count && i + AHEAD < a->count)
            fetch_ahead(a, r, i + AHEAD);
        if (a->machine[i] != index)
            continue;
        if (r->own_moves) {
            if (a->given[i] != given)
                now = map_given(r, given = a->given[i]);
            a->given[i] = now;
            carry_own(run, r, i);
        }
        if (r->redrawn_count)
            redraw_own(run, r, i);
        if (any)
            carry_agent(run, r, i);
        if (shorter)
            jox_clear_unused_slots(a, i, next);
    }
    jox_shared_settle(a);
    jox_edits_end(run, index); /* frees the copy that `old` may be */
    JOX_CHECK(jox_states_check(run));
    return built;
}
