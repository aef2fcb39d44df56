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

/* The state of `next` that continues `name`, or -1. */
static int continued(const JoxMachine *next, const char *name) {
    int state = jox_machine_state(next, name);
    for (uint32_t r = 0; state < 0 && r < next->renamed_count; r++)
        if (strcmp(next->renamed[r].from, name) == 0)
            state = jox_machine_state(next, next->renamed[r].to);
    return state;
}

const char *jox_mind_refuses(const JoxMind *mind, uint32_t index, const JoxMachine *next, char *why,
                             uint32_t size) {
    const JoxMachine *old = mind->machines[index];
    const JoxAgents *a = mind->agents;
    for (uint32_t s = 0; s < old->state_count; s++) {
        if (continued(next, old->states[s].name) >= 0)
            continue;
        uint32_t people = 0;
        for (uint32_t i = 0; i < a->count; i++)
            people += a->machine[i] == index && a->state[i] == s;
        if (people == 0)
            continue;
        snprintf(why, size, "%u agent%s in '%s', which this version lacks (see `renamed`)", people,
                 people == 1 ? " is" : "s are", old->states[s].name);
        return why;
    }
    return NULL;
}

/* Which slot of the old version goes on in slot `slot` of the new one: the n-th of the same name
   for the n-th of that name, since slots without a name are several. -1 if there is none. */
static int own_before(const JoxMachine *old, const JoxMachine *next, uint32_t slot) {
    uint32_t nth = 0;
    for (uint32_t s = 0; s < slot; s++)
        nth += strcmp(next->own[s].name, next->own[slot].name) == 0;
    for (uint32_t s = 0; s < old->own_count; s++)
        if (strcmp(old->own[s].name, next->own[slot].name) == 0 && nth-- == 0)
            return (int)s;
    return -1;
}

static int memory_before(const JoxMachine *old, const JoxMachine *next, uint32_t slot) {
    uint32_t nth = 0;
    for (uint32_t s = 0; s < slot; s++)
        nth += strcmp(next->memory[s].name, next->memory[slot].name) == 0;
    for (uint32_t s = 0; s < old->memory_count; s++)
        if (strcmp(old->memory[s].name, next->memory[slot].name) == 0 && nth-- == 0)
            return (int)s;
    return -1;
}

static void carry_values(JoxMind *mind, const JoxMachine *old, const JoxMachine *next, uint32_t i) {
    JoxAgents *a = mind->agents;
    double *own = a->own + (size_t)i * a->own_stride, before[256];
    double *memory = a->memory + (size_t)i * a->memory_stride;
    for (uint32_t s = 0; s < old->own_count && s < 256; s++)
        before[s] = own[s];
    for (uint32_t s = 0; s < next->own_count; s++) {
        int from = own_before(old, next, s);
        if (from >= 0 && from < 256)
            own[s] = before[from];
        else
            draw_own(mind, i, s, &next->own[s].dist);
    }
    for (uint32_t s = 0; s < old->memory_count && s < 256; s++)
        before[s] = memory[s];
    for (uint32_t s = 0; s < next->memory_count; s++) {
        int from = memory_before(old, next, s);
        bool same = from >= 0 && from < 256 && old->memory[from].kind == next->memory[s].kind;
        memory[s] = same ? before[from] : next->memory[s].initial;
    }
}

/* Which of the new state's conditions held last step: by the transitions' ids. */
static uint32_t carry_truth(const JoxState *old, const JoxState *next, uint32_t was) {
    uint32_t result = 0;
    for (uint32_t k = 0; k < next->transition_count; k++)
        for (uint32_t o = 0; o < old->transition_count; o++)
            if (strcmp(old->transitions[o].id, next->transitions[k].id) == 0)
                result |= (was >> o & 1) << k;
    return result;
}

JoxMachine *jox_mind_replace(JoxMind *mind, uint32_t index, JoxMachine *next) {
    JoxMachine *old = mind->machines[index];
    JoxAgents *a = mind->agents;
    jox_agents_widen(a, next->own_count, next->memory_count);
    mind->machines[index] = next;
    next->version = old->version + 1;
    for (uint32_t i = 0; i < a->count; i++) {
        if (a->machine[i] != index)
            continue;
        const JoxState *was = &old->states[a->state[i]];
        int state = continued(next, was->name);
        a->state[i] = state >= 0 ? (uint16_t)state : next->start;
        a->was_true[i] = carry_truth(was, &next->states[a->state[i]], a->was_true[i]);
        carry_values(mind, old, next, i);
        jox_mind_write_parameters(mind, i);
    }
    return old;
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
    for (uint32_t n = 0; n < mind->name_count; n++)
        jox_free(mind->names[n]);
    jox_free(mind->names);
    jox_text_free(&mind->trace);
    jox_mind_scratch_free(mind);
}
