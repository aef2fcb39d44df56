/* Adds machines to a world, and lets agents begin to run them: at spawning, and when they switch to
   another machine. */
#include "machine/run.h"

#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "machine/machine_parts.h"

/* Numbers the names of a state within outer ones that are parts of its whole name: of "A.B.C" these
   are A, A.B, B, B.C and C. */
static void number_other_names(JoxMachineRun *run, JoxState *state) {
    const char *begin = state->name;
    state->also_count = 0;
    for (uint32_t first = 0; first <= state->depth && state->depth > 0; first++) {
        const char *end = begin;
        for (uint32_t last = first; last <= state->depth; last++) {
            char part[256];
            end += strcspn(end, ".");
            snprintf(part, sizeof part, "%.*s", (int)(end - begin), begin);
            if (first > 0 || last < state->depth)
                state->also[state->also_count++] = jox_machines_name(run, part);
            end += *end == '.';
        }
        begin += strcspn(begin, ".") + 1;
    }
    JOX_ASSERT(state->also_count <= sizeof state->also / sizeof *state->also);
}

void jox_machine_number_names(JoxMachineRun *run, JoxMachine *machine) {
    uint32_t transitions = 0;
    machine->name_number = jox_machines_name(run, machine->name);
    for (uint32_t n = 0; n < machine->name_count; n++)
        machine->names[n].number = jox_machines_name(run, machine->names[n].text);
    for (uint32_t s = 0; s < machine->memory_count; s++)
        if (machine->memory[s].is_public)
            machine->memory[s].name_number = jox_machines_name(run, machine->memory[s].name);
    for (uint32_t s = 0; s < machine->state_count; s++) {
        machine->states[s].name_number = jox_machines_name(run, machine->states[s].name);
        number_other_names(run, &machine->states[s]);
        machine->states[s].first_transition = transitions;
        transitions += machine->states[s].transition_count;
    }
}

/* Returns whether a machine reads preferred velocities of the last step: evade, headway, or
   functions, which may. */
static bool reads_headings(const JoxMachine *machine) {
    bool asks = machine->hook_count > 0;
    for (uint32_t s = 0; s < machine->state_count; s++)
        for (uint32_t t = 0; t < machine->states[s].steer_count; t++)
            asks |= machine->states[s].steer[t].kind == JOX_STEER_EVADE;
    for (uint32_t e = 0; e < machine->expression_count; e++)
        for (uint32_t k = 0; k < machine->expressions[e].count; k++) {
            const JoxInstruction *in = &machine->expressions[e].code[k];
            asks |= in->op == JOX_OP_NOW && in->arg == JOX_NOW_headway;
        }
    return asks;
}

static bool asks_for_arrival(const JoxMachine *machine) {
    for (uint32_t e = 0; e < machine->expression_count; e++)
        for (uint32_t k = 0; k < machine->expressions[e].count; k++)
            if (machine->expressions[e].code[k].op == JOX_OP_ARRIVED)
                return true;
    return false;
}

static bool has_reactions(const JoxMachine *machine) {
    for (uint32_t s = 0; s < machine->state_count; s++)
        for (uint32_t t = 0; t < machine->states[s].transition_count; t++)
            if (machine->states[s].transitions[t].stays)
                return true;
    return false;
}

void jox_machines_put(JoxMachineRun *run, uint32_t index, JoxMachine *machine) {
    JOX_ASSERT(index <= run->set->count && index < JOX_MOST_MACHINES);
    JOX_CHECK(jox_machine_check(machine));
    jox_machine_number_names(run, machine);
    machine->headings = reads_headings(machine);
    machine->arrivals = asks_for_arrival(machine);
    machine->reacts = has_reactions(machine);
    jox_agents_widen(run->agents, machine->own_count, machine->memory_count);
    run->set->items[index] = run->set->built[index] = machine;
    jox_counts_begin(&run->state->counts[index], machine, run->tick);
}

uint32_t jox_machines_add(JoxMachineRun *run, JoxMachine *machine) {
    JOX_ASSERT(run->set->count < JOX_MOST_MACHINES);
    jox_machines_put(run, run->set->count, machine);
    return run->set->count++;
}

static void draw_own(const JoxMachineRun *run, uint32_t i, uint32_t slot, const JoxDist *dist) {
    JoxAgents *a = run->agents;
    jox_own_set(a, i, slot, jox_dist_draw(dist, run->seed, a->id[i], 0, JOX_DRAW_OWN, slot));
}

static bool overrides_slot(const JoxDist *const *given, uint32_t slot) {
    return given && slot < JOX_MOST_GIVEN && given[slot];
}

static void draw_values(JoxMachineRun *run, uint32_t agent, const JoxMachine *kind,
                        const JoxDist *const *own, const JoxDist *const *memory) {
    JoxAgents *a = run->agents;
    for (uint32_t s = 0; s < kind->own_count; s++)
        draw_own(run, agent, s, overrides_slot(own, s) ? own[s] : &kind->own[s].dist);
    for (uint32_t s = kind->own_count; s < a->own_count; s++)
        jox_own_set(a, agent, s, 0.0);
    for (uint32_t s = 0; s < kind->own_count; s++) /* values of the scene hold in all states */
        if (kind->own[s].general && overrides_slot(own, kind->own[s].general - 1))
            jox_own_set(a, agent, s, jox_own(a, agent, kind->own[s].general - 1));
    for (uint32_t s = 0; s < kind->memory_count; s++) {
        double value = kind->memory[s].initial;
        if (overrides_slot(memory, s))
            value = jox_dist_draw(memory[s], run->seed, a->id[agent], 0, JOX_DRAW_MEMORY, s);
        a->memory[(size_t)agent * a->memory_stride + s] = value;
    }
    if (kind->home && !overrides_slot(memory, kind->home - 1))
        jox_set_home_post(run, agent);
}

void jox_set_home_post(JoxMachineRun *run, uint32_t agent) {
    double *post = jox_home_position(run, agent);
    post[0] = run->agents->x[agent];
    post[1] = run->agents->y[agent];
}

/* Enters a state outside a step, and queues what needs neighbours for the next think. */
static void enter_between_steps(JoxMachineRun *run, uint32_t agent, uint16_t to) {
    JoxMachineState *pending = run->state;
    const JoxState *state = &jox_machine_of(run, agent)->states[to];
    const JoxActions *does = &state->enters;
    run->spawning = true;
    jox_machines_enter(run, agent, to);
    run->spawning = false;
    if (state->depth == 0 && state->on_enter < 0 && state->lasts_expression < 0 &&
        !does->set_count && does->signal < 0 && !does->tell)
        return;
    JOX_RESERVE(pending->pending, pending->pending_capacity, pending->pending_count + 1);
    pending->pending[pending->pending_count++] = run->agents->id[agent];
}

float jox_machines_birth_radius(const JoxMachineRun *run, uint32_t id, uint32_t machine,
                                const JoxDist *const *own) {
    const JoxMachine *kind = run->set->items[machine];
    const JoxValue *value = jox_state_parameter(kind, &kind->states[kind->start], JOX_PARAM_radius);
    double radius = jox_parameters[JOX_PARAM_radius].value; /* for a radius that is computed in the
                                                               step */
    if (value->kind == JOX_VALUE_CONST)
        radius = value->number;
    if (value->kind == JOX_VALUE_OWN) {
        const uint32_t general = kind->own[value->index].general;
        const bool follows = general && overrides_slot(own, general - 1);
        const uint32_t slot = follows ? general - 1 : (uint32_t)value->index;
        const JoxDist *dist = overrides_slot(own, slot) ? own[slot] : &kind->own[slot].dist;
        radius = jox_dist_draw(dist, run->seed, id, 0, JOX_DRAW_OWN, slot);
    }
    return jox_parameter_store(JOX_PARAM_radius, radius);
}

void jox_machines_spawn(JoxMachineRun *run, uint32_t agent, uint32_t machine,
                        const JoxDist *const *own, const JoxDist *const *memory) {
    JoxAgents *a = run->agents;
    const JoxMachine *kind = run->set->items[machine];
    JOX_ASSERT(machine < run->set->count);
    if (a->machine[agent] != machine)
        a->machine[agent] = (uint16_t)machine;
    draw_values(run, agent, kind, own, memory);
    for (uint32_t s = 0; own && s < kind->own_count && s < 64; s++)
        a->given[agent] |=
            own[s] || (kind->own[s].general && overrides_slot(own, kind->own[s].general - 1))
                ? (uint64_t)1 << s
                : 0;
    for (JoxParameter p = 0; p < JOX_PARAM_COUNT; p++) /* for parameters that are computed in the
                                                          step */
        if (jox_state_parameter(kind, &kind->states[kind->start], p)->kind == JOX_VALUE_EXPRESSION)
            jox_param_set(a, p, agent, jox_parameter_store(p, jox_parameters[p].value));
    enter_between_steps(run, agent, kind->start);
}

/* Returns whether an own value is kept when an agent switches to another machine: radius, mass,
   values that are no parameter (a goal, a court), and all that the scene gave it. */
static bool is_carried_along(const JoxAgents *a, uint32_t i, const JoxOwnSlot *slot,
                             uint32_t number) {
    int parameter = jox_parameter_find(slot->name);
    bool given = number < 64 && (a->given[i] >> number & 1);
    return *slot->name && (given || (parameter < 0 && !slot->general) ||
                           parameter == JOX_PARAM_radius || parameter == JOX_PARAM_mass);
}

void jox_machines_set_own(JoxMachineRun *run, uint32_t i, uint32_t slot, double value) {
    JoxAgents *a = run->agents;
    JOX_ASSERT(slot < jox_machine_of(run, i)->own_count);
    const JoxMachine *machine = jox_machine_of(run, i);
    for (uint32_t s = 0; s < machine->own_count; s++) {
        if (s != slot && machine->own[s].general != slot + 1)
            continue;
        jox_own_set(a, i, s, value);
        a->given[i] |= s < 64 ? (uint64_t)1 << s : 0;
    }
    jox_machines_write_parameters(run, i);
}

void jox_clear_unused_slots(JoxAgents *a, uint32_t i, const JoxMachine *machine) {
    for (uint32_t s = machine->own_count; s < a->own_count; s++)
        jox_own_set(a, i, s, 0.0);
    for (uint32_t s = machine->memory_count; s < a->memory_stride; s++)
        a->memory[(size_t)i * a->memory_stride + s] = 0.0;
}

/* Returns whether a slot of memory goes on as one of another machine, by its name. */
static bool continues_memory(const JoxMemorySlot *was, const JoxMemorySlot *is) {
    return *is->name && was->kind == is->kind && strcmp(was->name, is->name) == 0;
}

/* A list that goes on in another machine. */
typedef struct KeptList {
    uint32_t slot, count; /* slot in the next machine */
    double items[JOX_MOST_ITEMS];
} KeptList;

/* Writes the lists of an agent that go on in its next machine; returns how many. */
static uint32_t keep_lists(const JoxMachineRun *run, uint32_t i, const JoxMachine *next,
                           KeptList lists[JOX_MOST_SET]) {
    const JoxAgents *a = run->agents;
    const JoxMachine *old = jox_machine_of(run, i);
    uint32_t count = 0;
    for (uint32_t n = 0; n < next->memory_count && count < JOX_MOST_SET; n++)
        for (uint32_t o = 0; jox_memory_is_list(&next->memory[n]) && o < old->memory_count; o++)
            if (continues_memory(&old->memory[o], &next->memory[n])) {
                lists[count] = (KeptList){.slot = n};
                lists[count].count =
                    jox_list_read(run, old, a->memory + (size_t)i * a->memory_stride, (int32_t)o,
                                  lists[count].items);
                count++;
                break;
            }
    return count;
}

void jox_machines_become(JoxMachineRun *run, uint32_t i, uint32_t machine) {
    JoxAgents *a = run->agents;
    const JoxMachine *old = run->set->items[a->machine[i]], *next = run->set->items[machine];
    JoxDist kept[JOX_MOST_GIVEN], remembered[JOX_MOST_GIVEN];
    const JoxDist *own[JOX_MOST_GIVEN] = {0}, *memory[JOX_MOST_GIVEN] = {0};
    uint64_t given = 0;
    for (uint32_t n = 0; n < next->own_count && n < JOX_MOST_GIVEN; n++)
        for (uint32_t o = 0; o < old->own_count; o++)
            if (strcmp(old->own[o].name, next->own[n].name) == 0 &&
                is_carried_along(a, i, &old->own[o], o)) {
                kept[n] = jox_dist_constant(jox_own(a, i, o));
                own[n] = &kept[n];
                given |= n < 64 ? (uint64_t)1 << n : 0;
            }
    for (uint32_t n = 0; n < next->own_count && n < 64; n++)
        if (next->own[n].general && overrides_slot(own, next->own[n].general - 1))
            given |= (uint64_t)1 << n;
    for (uint32_t n = 0; n < next->memory_count && n < JOX_MOST_GIVEN; n++)
        for (uint32_t o = 0; o < old->memory_count; o++)
            if (continues_memory(&old->memory[o], &next->memory[n])) {
                remembered[n] = jox_dist_constant(a->memory[(size_t)i * a->memory_stride + o]);
                memory[n] = &remembered[n];
            }
    KeptList lists[JOX_MOST_SET];
    const uint32_t list_count = keep_lists(run, i, next, lists);
    a->machine[i] = (uint16_t)machine;
    draw_values(run, i, next, own, memory);
    for (uint32_t n = 0; n < list_count; n++)
        jox_list_fill(next, a->memory + (size_t)i * a->memory_stride, (int32_t)lists[n].slot,
                      lists[n].items, lists[n].count);
    jox_clear_unused_slots(a, i, next);
    a->given[i] = given;
    jox_messages_recheck(run, i);
    jox_machines_enter(run, i, next->start);
}

void jox_machines_set_state(JoxMachineRun *run, uint32_t agent, uint16_t to) {
    JoxMachineState *pending = run->state;
    const JoxMachine *machine = jox_machine_of(run, agent);
    const int32_t next = machine->states[to].become_machine;
    uint32_t kept = 0; /* entries that are still queued for the old state are dropped */
    JOX_ASSERT(to < machine->state_count);
    for (uint32_t n = 0; n < pending->pending_count; n++)
        if (pending->pending[n] != run->agents->id[agent])
            pending->pending[kept++] = pending->pending[n];
    pending->pending_count = kept;
    if (next >= 0) {
        JOX_ASSERT((uint32_t)next < run->set->count);
        run->spawning = true;
        jox_machines_become(run, agent, (uint32_t)next);
        run->spawning = false;
        to = run->set->items[next]->start;
    }
    enter_between_steps(run, agent, to);
}

void jox_machines_free(JoxMachineRun *run) {
    JoxMachineSet *set = run->set;
    JoxMachineState *state = run->state;
    for (uint32_t m = 0; m < set->count; m++) {
        jox_edits_end(run, m);
        jox_machine_free(set->built[m]);
        jox_counts_free(&state->counts[m]);
    }
    for (uint32_t n = 0; n < set->name_count; n++)
        jox_free(set->names[n]);
    jox_free(set->names);
    jox_free(set->name_table);
    void *const owned[] = {state->sent,       state->waiting, run->lost_names,   state->calls,
                           state->tallies,    state->called,  state->announced,  state->pending,
                           state->edits,      state->thrown,  run->taken,        run->kicks,
                           run->grips,        run->push_on,   run->push_nearest, run->push_toward_x,
                           run->push_toward_y};
    for (size_t i = 0; i < sizeof owned / sizeof *owned; i++)
        jox_free(owned[i]);
    jox_text_free(&run->trace);
    jox_trace_free(run);
    jox_text_free(&run->notes);
    jox_free(run->told);
    jox_machines_scratch_free(run);
}
