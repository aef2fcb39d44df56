/* The stage think: counters, then transitions with their hooks, then the actions of the states. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "base/number/pi.h"
#include "machine/machine_parts.h"

/* Returns the angle from a to b, rad. Steps turn little, where the series is exact to 1e-10. */
static double find_angle(JoxV2 a, JoxV2 b) {
    double sine = (double)a.x * b.y - (double)a.y * b.x,
           cosine = (double)a.x * b.x + (double)a.y * b.y;
    if (!(cosine > 0.0) || fabs(sine) > 0.1 * cosine)
        return jox_atan2(sine, cosine);
    double t = sine / cosine, t2 = t * t;
    return t * (1.0 - t2 * (1.0 / 3 - t2 * (1.0 / 5 - t2 * (1.0 / 7 - t2 / 9))));
}

/* Updates a counter of one agent about place `index`, by the angle of its last move. */
static void count_circuits(const JoxMachineRun *run, const JoxCounter *counter, uint32_t i,
                           int32_t index) {
    const JoxAgents *a = run->agents;
    double *memory = a->memory + (size_t)i * a->memory_stride;
    const JoxPlace *place = &run->places[index];
    JoxV2 from = {a->prev_x[i], a->prev_y[i]}, to = {a->x[i], a->y[i]};
    if (memory[counter->begun] == 0.0) {
        const JoxPlace *line = place->start >= 0 ? &run->places[place->start] : NULL;
        if (line && jox_segment_crossing(line->points[0], line->points[1], from, to) != 1)
            return;
        memory[counter->begun] = 1.0;
        memory[counter->angle] =
            memory[counter->value] * JOX_TURN; /* laps that the scene gave count */
        if (line)
            return; /* turns count from the start line on */
    }
    double angle = memory[counter->angle] +
                   find_angle(jox_sub(from, place->centre), jox_sub(to, place->centre));
    memory[counter->angle] = angle;
    memory[counter->value] = floor(angle / JOX_TURN + 1e-9);
}

/* Returns whether a transition whose condition has just become true is taken, by its chance. */
static bool roll_chance(const JoxMachineRun *run, const JoxMachine *machine, const JoxTransition *t,
                        uint32_t k, uint32_t i) {
    if (t->chance.kind == JOX_VALUE_UNSET)
        return true;
    double chance = jox_value(run, machine, &t->chance, i);
    const double drawn =
        jox_random_unit(run->seed, run->agents->id[i], run->tick, JOX_DRAW_CHANCE, k);
    if (run->watched_count)
        jox_watch_roll(run, i, k, drawn);
    return drawn < chance;
}

typedef struct Think {
    JoxMachineRun *run;
} Think;

static void count_circuits_of_batch(const JoxMachineRun *run, const JoxMachine *machine,
                                    const JoxCounter *counter, const uint32_t *agents,
                                    uint32_t count) {
    const bool one =
        counter->target >= 0 && machine->targets[counter->target].kind == JOX_TARGET_PLACE;
    int32_t index = -1;
    for (uint32_t n = 0; n < count; n++) {
        if (n == 0 || !one)
            index = jox_target_place(run, agents[n], counter->target);
        if (index >= 0)
            count_circuits(run, counter, agents[n], index);
    }
}

/* Notes that item k of its state is due for agent i. */
static void fire_item(JoxMachineScratch *s, const JoxTransition *t, uint32_t k, uint32_t i) {
    if (t->stays)
        s->reacts[i] |= 1u << k;
    else
        s->fired[i] = (int16_t)k;
}

/* Updates the counters of one batch and evaluates its compiled conditions; fills `fired`. */
static void think_batch(const JoxMachineRun *run, const JoxBatchRange *batch,
                        JoxRegisters registers) {
    JoxAgents *a = run->agents;
    const JoxMachine *machine = run->set->items[batch->machine];
    const JoxState *state = &machine->states[batch->state];
    const uint32_t *agents = run->scratch->grouped + batch->begin;
    for (uint32_t c = 0; c < machine->counter_count; c++)
        if (jox_counter_counts(machine, &machine->counters[c], batch->state))
            count_circuits_of_batch(run, machine, &machine->counters[c], agents, batch->count);
    int32_t known = -1;   /* expression whose result is in register 0 */
    uint32_t nobodys = 0; /* bits of the conditions that are false for all agents */
    for (uint32_t k = 0; k < state->transition_count; k++) {
        const JoxTransition *t = &state->transitions[k];
        if (t->when_hook >= 0)
            continue;
        if (t->when >= 0 && t->when != known) /* the condition of the transition before keeps its
                                                 result */
            jox_eval(run, machine, &machine->expressions[t->when], agents, batch->count, registers);
        known = t->when >= 0 ? t->when : known;
        uint32_t bit = 1u << k;
        if (t->when >= 0 && jox_holds_for_nobody(registers[0], batch->count)) {
            nobodys |= bit;
            continue;
        }
        for (uint32_t n = 0; n < batch->count; n++) {
            uint32_t i = agents[n];
            bool holds = t->when < 0 || registers[0][n] != 0.0;
            bool rises = holds && !(a->was_true[i] & bit);
            /* A transition without a chance is taken whenever its condition holds; with a chance,
               it is rolled once each time the condition becomes true. */
            if ((t->stays || run->scratch->fired[i] < 0) && holds &&
                (t->chance.kind == JOX_VALUE_UNSET || rises) && roll_chance(run, machine, t, k, i))
                fire_item(run->scratch, t, k, i);
            if (holds == !(a->was_true[i] & bit))
                a->was_true[i] ^= bit;
        }
    }
    for (uint32_t n = 0; nobodys && n < batch->count; n++)
        if (a->was_true[agents[n]] & nobodys)
            a->was_true[agents[n]] &= ~nobodys;
}

static void think_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    const JoxMachineRun *run = ((Think *)context)->run;
    JOX_ASSERT(worker < run->scratch->workers);
    for (uint32_t b = begin; b < end; b++)
        think_batch(run, &run->scratch->batches[b], run->scratch->registers[worker]);
}

static bool has_function_whens(const JoxState *state) {
    for (uint32_t k = 0; k < state->transition_count; k++)
        if (state->transitions[k].when_hook >= 0)
            return true;
    return false;
}

/* Evaluates conditions that are Lua functions, for agents that no compiled transition takes or
   that have reactions, by id. */
static void evaluate_function_conditions(JoxMachineRun *run) {
    JoxMachineScratch *s = run->scratch;
    JoxAgents *a = run->agents;
    s->list_count = 0;
    for (uint32_t b = 0; b < s->batch_count && run->call; b++) {
        const JoxBatchRange *batch = &s->batches[b];
        if (!has_function_whens(&run->set->items[batch->machine]->states[batch->state]))
            continue;
        const bool reacts = run->set->items[batch->machine]->reacts;
        for (uint32_t n = 0; n < batch->count; n++)
            if (reacts || s->fired[s->grouped[batch->begin + n]] < 0)
                s->list[s->list_count++] = s->grouped[batch->begin + n];
    }
    jox_sort_by_id(run, s->list, s->list_count);
    for (uint32_t n = 0; n < s->list_count; n++) {
        uint32_t i = s->list[n];
        const JoxMachine *machine = jox_machine_of(run, i);
        const JoxState *state = &machine->states[a->state[i]];
        for (uint32_t k = 0; k < state->transition_count; k++) {
            const JoxTransition *t = &state->transitions[k];
            if (t->when_hook < 0 || (!t->stays && s->fired[i] >= 0))
                continue;
            double result[2] = {0.0, 0.0};
            bool holds =
                run->call(run->call_context, machine, t->when_hook, JOX_HOOK_WHEN, i, result) &&
                result[0] != 0.0;
            bool rises = holds && !(a->was_true[i] >> k & 1);
            if (holds && (t->chance.kind == JOX_VALUE_UNSET || rises) &&
                roll_chance(run, machine, t, k, i))
                fire_item(s, t, k, i);
            if (holds == !(a->was_true[i] >> k & 1))
                a->was_true[i] ^= 1u << k;
        }
    }
}

/* Enters a state by a transition on a level: actions and functions, then the switch to another
   machine if the state says so. */
static void enter_state(JoxMachineRun *run, uint32_t i, uint16_t to, uint32_t level) {
    const JoxState *state = &jox_machine_of(run, i)->states[to];
    jox_machines_enter_level(run, i, to, level);
    jox_complete_entry(run, i, level);
    if (state->become_machine < 0)
        return;
    JOX_ASSERT((uint32_t)state->become_machine < run->set->count);
    jox_machines_become(run, i, (uint32_t)state->become_machine);
    jox_complete_entry(run, i, 0); /* a start state cannot switch machines again */
}

/* Lists the agents that take a transition. Blocks without any are skipped, as few agents do in a
   step. */
static void list_fired(JoxMachineRun *run) {
    enum { BLOCK = 32 };
    JoxMachineScratch *s = run->scratch;
    const uint32_t count = run->agents->count;
    s->list_count = 0;
    for (uint32_t i = 0; i < count; i += BLOCK) {
        const uint32_t end = count - i < BLOCK ? count : i + BLOCK;
        int16_t all = -1;
        for (uint32_t k = i; k < end; k++)
            all &= s->fired[k];
        for (uint32_t k = i; all >= 0 && k < end; k++)
            if (s->fired[k] >= 0)
                s->list[s->list_count++] = k;
    }
}

/* Explains the transition that is due for an agent that is traced or watched. */
static void explain_due_of(JoxMachineRun *run, uint32_t id) {
    const JoxAgents *a = run->agents;
    const uint32_t i = id < a->next_id ? jox_agents_find(a, id) : JOX_NO_INDEX;
    if (i == JOX_NO_INDEX || run->scratch->fired[i] < 0)
        return;
    const uint16_t fired = (uint16_t)run->scratch->fired[i];
    const JoxTransition *t = &jox_machine_of(run, i)->states[a->state[i]].transitions[fired];
    const JoxTaken due = {id, a->machine[i], a->state[i], jox_destination(run, t, i), fired};
    if (run->traces && id == run->trace_id)
        jox_trace_due(run, &due);
    if (run->watched_count)
        jox_watch_due(run, &due);
}

/* Explains the transitions that are due, before reactions change what they rest on. */
static void explain_due(JoxMachineRun *run) {
    if (run->traces)
        explain_due_of(run, run->trace_id);
    for (uint32_t n = 0; n < run->watched_count; n++)
        explain_due_of(run, run->watched[n].agent_id);
}

/* Uses the messages on which the items rest that an agent is to carry out. */
static void use_messages_of(JoxMachineRun *run, uint32_t i) {
    const JoxMachine *machine = jox_machine_of(run, i);
    const JoxState *state = &machine->states[run->agents->state[i]];
    const uint32_t reacts = machine->reacts ? run->scratch->reacts[i] : 0;
    for (uint32_t k = 0; k < state->transition_count; k++) {
        const JoxTransition *t = &state->transitions[k];
        const bool due = reacts >> k & 1 || run->scratch->fired[i] == (int16_t)k;
        if (due && jox_asks_for_messages(machine, t->rests))
            jox_messages_use(run, machine, t, i);
    }
}

/* Uses the messages on which items rest, before these change what conditions read. The messages
   remain visible until the stage ends: all items of a step rest on the same ones. */
static void use_messages(JoxMachineRun *run) {
    const JoxMessage *waiting = run->state->waiting;
    for (uint32_t m = 0; m < run->state->waiting_count; m++) {
        const uint32_t i = m > 0 && waiting[m - 1].to == waiting[m].to
                               ? JOX_NO_INDEX
                               : jox_agents_find(run->agents, waiting[m].to);
        if (i != JOX_NO_INDEX && run->agents->machine[i] != JOX_NO_MACHINE)
            use_messages_of(run, i);
    }
}

/* Does what an item of the agent's state says. */
static void do_item(JoxMachineRun *run, const JoxMachine *machine, const JoxTransition *t,
                    uint32_t i) {
    jox_actions_do(run, machine, &t->does, i);
    jox_call_hook(run, t->on_take, JOX_HOOK_TAKE, i);
}

/* Carries out the reactions that are due for one agent, in order. */
static void react(JoxMachineRun *run, uint32_t i) {
    const JoxAgents *a = run->agents;
    const JoxMachine *machine = jox_machine_of(run, i);
    const JoxState *state = &machine->states[a->state[i]];
    for (uint32_t k = 0; k < state->transition_count; k++) {
        const JoxTransition *t = &state->transitions[k];
        if (!(run->scratch->reacts[i] >> k & 1))
            continue;
        const JoxTaken taken = {a->id[i], a->machine[i], a->state[i], t->to, (uint16_t)k};
        run->state->counts[a->machine[i]].taken[state->first_transition + k]++;
        if (run->traces && a->id[i] == run->trace_id)
            jox_trace_reaction(run, &taken);
        do_item(run, machine, t, i);
    }
}

/* Carries out reactions, by id of the agents. */
static void carry_out_reactions(JoxMachineRun *run) {
    JoxMachineScratch *s = run->scratch;
    s->list_count = 0;
    for (uint32_t b = 0; b < s->batch_count; b++) {
        const JoxBatchRange *batch = &s->batches[b];
        for (uint32_t n = 0; run->set->items[batch->machine]->reacts && n < batch->count; n++)
            if (s->reacts[s->grouped[batch->begin + n]])
                s->list[s->list_count++] = s->grouped[batch->begin + n];
    }
    jox_sort_by_id(run, s->list, s->list_count);
    for (uint32_t n = 0; n < s->list_count; n++)
        react(run, s->list[n]);
}

/* Takes the fired transitions, by id; hooks run in the order exit, take, enter. */
static void take_transitions(JoxMachineRun *run) {
    JoxMachineScratch *s = run->scratch;
    JoxAgents *a = run->agents;
    list_fired(run);
    jox_sort_by_id(run, s->list, s->list_count);
    JOX_RESERVE(run->taken, run->taken_capacity, s->list_count);
    for (uint32_t n = 0; n < s->list_count; n++) {
        uint32_t i = s->list[n];
        const JoxMachine *machine = jox_machine_of(run, i);
        const JoxState *from = &machine->states[a->state[i]];
        JOX_ASSERT((uint32_t)s->fired[i] < from->transition_count && run->taken_count <= n);
        const JoxTransition *t = &from->transitions[s->fired[i]];
        run->state->counts[a->machine[i]].taken[from->first_transition + (uint32_t)s->fired[i]]++;
        const uint16_t to = jox_destination(run, t, i);
        run->taken[run->taken_count++] =
            (JoxTaken){a->id[i], a->machine[i], a->state[i], to, (uint16_t)s->fired[i]};
        if (run->traces && a->id[i] == run->trace_id)
            jox_trace_transition(run);
        if (run->watched_count)
            jox_watch_taken(run, &run->taken[run->taken_count - 1]);
        jox_exit_states(run, i, t->level);
        do_item(run, machine, t, i);
        jox_note_left_state(run, t, i, to);
        enter_state(run, i, to, t->level);
    }
}

/* Completes entries outside a step, which had no neighbours: evaluates durations, carries out
   actions, calls on_enter. */
static void complete_entries(JoxMachineRun *run) {
    JoxMachineState *pending = run->state;
    JoxAgents *a = run->agents;
    for (uint32_t n = 0; n < pending->pending_count; n++) {
        uint32_t i = jox_agents_find(a, pending->pending[n]);
        if (i != JOX_NO_INDEX)
            jox_complete_entry(run, i, 0);
    }
    pending->pending_count = 0;
}

static bool any_views(const JoxMachineRun *run) {
    for (uint32_t m = 0; m < run->set->count; m++)
        if (run->set->items[m]->views)
            return true;
    return false;
}

static bool any_reacts(const JoxMachineRun *run) {
    for (uint32_t m = 0; m < run->set->count; m++)
        if (run->set->items[m]->reacts)
            return true;
    return false;
}

/* Keeps the preferred velocities of the last step, since the stage prefer overwrites them while
   other agents still read them. */
static void keep_headings(JoxMachineRun *run) {
    const JoxAgents *a = run->agents;
    JoxMachineScratch *s = run->scratch;
    bool asked = false;
    for (uint32_t m = 0; m < run->set->count; m++)
        asked |= run->set->items[m]->headings;
    if (!asked) {
        jox_free(s->heading);
        s->heading = NULL;
        s->heading_capacity = 0;
        return;
    }
    JOX_RESERVE(s->heading, s->heading_capacity, a->count);
    for (uint32_t i = 0; i < a->count; i++)
        s->heading[i] = (JoxV2){a->pref_x[i], a->pref_y[i]};
}

void jox_machines_think(JoxMachineRun *run, JoxPool *pool) {
    run->taken_count = run->kick_count = run->grip_count = 0;
    run->trace.length = 0;
    jox_machines_scratch(run);
    jox_machines_listen(run);
    jox_messages_deliver(run);
    jox_machines_group(run, pool);
    jox_counts_spend(run);
    keep_headings(run);
    if (run->set->count > 0) {
        bool views = run->bracket && any_views(run);
        if (views)
            run->bracket(run->call_context, true);
        jox_machines_count_places(run);
        jox_arrivals_note(run);
        jox_sightings_note(run);
        complete_entries(run);
        run->thinks = true;
        Think think = {run};
        if (run->agents->count) /* -1: no transition */
            memset(run->scratch->fired, 0xff, run->agents->count * sizeof *run->scratch->fired);
        if (any_reacts(run))
            jox_mem_fill(run->scratch->reacts, 0,
                         run->agents->count * sizeof *run->scratch->reacts);
        jox_parallel_for(pool, run->scratch->batch_count, 1, think_range, &think);
        evaluate_function_conditions(run);
        if (run->traces)
            jox_trace_waiting(run);
        explain_due(run);
        use_messages(run);
        carry_out_reactions(run);
        take_transitions(run);
        jox_messages_settle(run);
        run->thinks = false;
        JOX_CHECK(jox_taken_check(run));
        if (views)
            run->bracket(run->call_context, false);
        if (run->taken_count > 0)
            jox_machines_group(run, pool);
        jox_machines_repeat_signals(run);
    }
    JOX_CHECK(jox_states_check(run));
    jox_machines_act(run, pool);
}
