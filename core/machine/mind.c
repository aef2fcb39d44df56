/* Adding, spawning and replacing machines. */
#include "machine/mind.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "machine/internal.h"

uint32_t jox_mind_add(JoxMind *mind, JoxMachine *machine) {
    JOX_RESERVE(mind->machines, mind->machine_capacity, mind->machine_count + 1);
    mind->machines[mind->machine_count] = machine;
    jox_mind_number_names(mind, machine);
    jox_agents_widen(mind->agents, machine->own_count, machine->memory_count);
    return mind->machine_count++;
}

static void draw_own(const JoxMind *mind, uint32_t i, uint32_t slot, const JoxDist *dist) {
    const JoxAgents *a = mind->agents;
    a->own[(size_t)i * a->own_stride + slot] =
        jox_dist_draw(dist, mind->seed, a->id[i], 0, JOX_DRAW_OWN, slot);
}

static void draw_values(JoxMind *mind, uint32_t agent, const JoxMachine *kind,
                        const JoxDist *const *own, const JoxDist *const *memory) {
    JoxAgents *a = mind->agents;
    for (uint32_t s = 0; s < kind->own_count; s++)
        draw_own(mind, agent, s, own && own[s] ? own[s] : &kind->own[s].dist);
    for (uint32_t s = 0; s < kind->memory_count; s++) {
        double value = kind->memory[s].initial;
        if (memory && memory[s])
            value = jox_dist_draw(memory[s], mind->seed, a->id[agent], 0, JOX_DRAW_MEMORY, s);
        a->memory[(size_t)agent * a->memory_stride + s] = value;
    }
}

void jox_mind_spawn(JoxMind *mind, uint32_t agent, uint32_t machine, const JoxDist *const *own,
                    const JoxDist *const *memory) {
    JoxAgents *a = mind->agents;
    const JoxMachine *kind = mind->machines[machine];
    a->machine[agent] = (uint16_t)machine;
    draw_values(mind, agent, kind, own, memory);
    for (uint32_t s = 0; own && s < kind->own_count && s < 64; s++)
        a->given[agent] |= own[s] ? (uint64_t)1 << s : 0;
    mind->spawning = true; /* it has no neighbours yet */
    jox_mind_enter(mind, agent, kind->start);
    mind->spawning = false;
    const JoxState *start = &kind->states[kind->start];
    const JoxActions *does = &start->enters;
    if (start->on_enter < 0 && start->lasts_program < 0 && !does->set_count && does->signal < 0)
        return;
    if (!mind->scratch)
        mind->scratch = jox_alloc(1, sizeof *mind->scratch);
    JoxMindScratch *s = mind->scratch;
    JOX_RESERVE(s->pending, s->pending_capacity, s->pending_count + 1);
    s->pending[s->pending_count++] = a->id[agent];
}

/* Whether an own value goes along when an agent becomes another machine: its body and what is no
   parameter (a goal, a court), and whatever the scene gave it. */
static bool goes_along(const JoxAgents *a, uint32_t i, const JoxOwnSlot *slot, uint32_t number) {
    int parameter = jox_parameter_find(slot->name);
    bool given = number < 64 && (a->given[i] >> number & 1);
    return *slot->name &&
           (given || parameter < 0 || parameter == JOX_PARAM_radius || parameter == JOX_PARAM_mass);
}

void jox_mind_set_own(JoxMind *mind, uint32_t i, uint32_t slot, double value) {
    JoxAgents *a = mind->agents;
    a->own[(size_t)i * a->own_stride + slot] = value;
    a->given[i] |= slot < 64 ? (uint64_t)1 << slot : 0;
    jox_mind_write_parameters(mind, i);
}

/* Writes what the agent's state says of a parameter, where it is a number or an own value. */
static void write_parameter(JoxMind *mind, uint32_t i, int p) {
    const JoxMachine *machine = jox_machine_of(mind, i);
    const JoxValue *value =
        jox_state_parameter(machine, &machine->states[mind->agents->state[i]], p);
    if (value->kind == JOX_VALUE_CONST || value->kind == JOX_VALUE_OWN)
        mind->agents->param[p][i] =
            jox_parameter_store((JoxParameter)p, jox_value(mind, machine, value, i));
}

void jox_mind_set_parameter(JoxMind *mind, uint32_t index, int32_t number, int parameter,
                            double value) {
    JoxAgents *a = mind->agents;
    JoxMachine *machine = mind->machines[index];
    const JoxValue set = {JOX_VALUE_CONST, value, 0, JOX_LINE_LIVE};
    const char *name = jox_parameters[parameter].name;
    int32_t slot = -1;
    for (uint32_t s = 0; number < 0 && s < machine->own_count; s++)
        if (strcmp(machine->own[s].name, name) == 0)
            slot = (int32_t)s;
    if (slot >= 0)
        machine->own[slot].dist = jox_dist_constant(value);
    *(number < 0 ? &machine->defaults[parameter] : &machine->states[number].param[parameter]) = set;
    for (uint32_t i = 0; i < a->count; i++) {
        if (a->machine[i] != index || (number >= 0 && a->state[i] != number))
            continue;
        bool follows = slot >= 0 && !(slot < 64 && (a->given[i] >> slot & 1));
        if (follows)
            a->own[(size_t)i * a->own_stride + (uint32_t)slot] = value;
        for (int p = 0; p < JOX_PARAM_COUNT; p++) {
            const JoxState *state = &machine->states[a->state[i]];
            const JoxValue *held = jox_state_parameter(machine, state, p);
            if (p == parameter || (follows && held->kind == JOX_VALUE_OWN && held->index == slot))
                write_parameter(mind, i, p);
        }
    }
}

void jox_mind_become(JoxMind *mind, uint32_t i, uint32_t machine) {
    enum { MOST = 256 };
    JoxAgents *a = mind->agents;
    const JoxMachine *old = mind->machines[a->machine[i]], *next = mind->machines[machine];
    JoxDist kept[MOST], remembered[MOST];
    const JoxDist *own[MOST] = {0}, *memory[MOST] = {0};
    uint64_t given = 0;
    for (uint32_t n = 0; n < next->own_count && n < MOST; n++)
        for (uint32_t o = 0; o < old->own_count; o++)
            if (strcmp(old->own[o].name, next->own[n].name) == 0 &&
                goes_along(a, i, &old->own[o], o)) {
                kept[n] = jox_dist_constant(a->own[(size_t)i * a->own_stride + o]);
                own[n] = &kept[n];
                given |= n < 64 ? (uint64_t)1 << n : 0;
            }
    for (uint32_t n = 0; n < next->memory_count && n < MOST; n++)
        for (uint32_t o = 0; o < old->memory_count; o++)
            if (*next->memory[n].name && !strcmp(old->memory[o].name, next->memory[n].name) &&
                old->memory[o].kind == next->memory[n].kind) {
                remembered[n] = jox_dist_constant(a->memory[(size_t)i * a->memory_stride + o]);
                memory[n] = &remembered[n];
            }
    a->machine[i] = (uint16_t)machine;
    draw_values(mind, i, next, own, memory);
    a->given[i] = given;
    jox_mind_enter(mind, i, next->start);
}

void jox_mind_free(JoxMind *mind) {
    for (uint32_t m = 0; m < mind->machine_count; m++)
        jox_machine_free(mind->machines[m]);
    jox_free(mind->machines);
    jox_free(mind->taken);
    jox_free(mind->kicks);
    jox_free(mind->push_on);
    jox_free(mind->push_nearest);
    jox_free(mind->push_toward_x);
    jox_free(mind->push_toward_y);
    jox_free(mind->grips);
    jox_free(mind->called);
    jox_free(mind->heard);
    jox_free(mind->announced);
    jox_free(mind->everywhere);
    for (uint32_t n = 0; n < mind->name_count; n++)
        jox_free(mind->names[n]);
    jox_free(mind->names);
    jox_text_free(&mind->trace);
    jox_mind_scratch_free(mind);
}
