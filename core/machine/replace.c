/* A machine takes the place of another while agents are in it. All comparing of names is done
   beforehand; at the swap each agent is touched only where something differs. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "machine/internal.h"

struct JoxReplacement {
    const JoxMachine *old;
    JoxMachine *next;
    int32_t *state;  /* old state -> next, or -1 */
    int32_t *own;    /* next slot -> old, or -1 */
    int32_t *memory; /* next slot -> old of the same type, or -1 */
    bool own_moves, memory_moves, states_move;
    int8_t (*truth)[JOX_MOST_TRANSITIONS]; /* old state: next transition -> old, or -1 */
    bool *truth_moves;                     /* per old state */
    uint32_t *changed;      /* old state: bit per parameter that the next one sets otherwise */
    const JoxValue **value; /* old state, parameter: what the next one writes; NULL where nothing */
    uint32_t changed_all;   /* bit per parameter that some state changes */
    bool *tags_change;      /* old state: ignore or push_only differ */
    double **drawn;         /* next slot: values by id, or NULL where the old one goes on */
    uint32_t drawn_count;
    bool draws;
    double *before; /* one agent's row as it was */
};

/* The state of `next` that continues `name`, or -1. */
static int continued(const JoxMachine *next, const char *name) {
    int state = jox_machine_state(next, name);
    for (uint32_t r = 0; state < 0 && r < next->renamed_count; r++)
        if (strcmp(next->renamed[r].from, name) == 0)
            state = jox_machine_state(next, next->renamed[r].to);
    return state;
}

/* Which of the old names goes on as next[slot]: the n-th of the same name for the n-th of that
   name, since slots without a name are several. -1 if there is none. */
#define BEFORE(old, old_count, next, slot)                                                         \
    do {                                                                                           \
        uint32_t nth = 0;                                                                          \
        for (uint32_t s = 0; s < (slot); s++)                                                      \
            nth += strcmp((next)[s].name, (next)[slot].name) == 0;                                 \
        for (uint32_t s = 0; s < (old_count); s++)                                                 \
            if (strcmp((old)[s].name, (next)[slot].name) == 0 && nth-- == 0)                       \
                return (int32_t)s;                                                                 \
        return -1;                                                                                 \
    } while (0)

static int32_t own_before(const JoxMachine *old, const JoxMachine *next, uint32_t slot) {
    BEFORE(old->own, old->own_count, next->own, slot);
}
static int32_t memory_before(const JoxMachine *old, const JoxMachine *next, uint32_t slot) {
    BEFORE(old->memory, old->memory_count, next->memory, slot);
}

static bool same_dist(const JoxDist *a, const JoxDist *b) {
    if (a->kind != b->kind || a->a != b->a)
        return false;
    if (a->kind == JOX_DIST_CONSTANT)
        return true;
    if (a->kind == JOX_DIST_CHOOSE)
        return a->choices == b->choices &&
               !memcmp(a->values, b->values, (size_t)a->choices * sizeof *a->values);
    return a->b == b->b && (a->kind == JOX_DIST_UNIFORM || (a->lo == b->lo && a->hi == b->hi));
}

static void map_slots(JoxReplacement *r, uint64_t seed) {
    const JoxMachine *old = r->old, *next = r->next;
    r->own_moves = false;
    for (uint32_t s = 0; s < next->own_count; s++) {
        r->own[s] = own_before(old, next, s);
        r->own_moves |= r->own[s] != (int32_t)s;
        if (r->own[s] >= 0 && same_dist(&old->own[r->own[s]].dist, &next->own[s].dist))
            continue;
        r->draws = true;
        bool constant = next->own[s].dist.kind == JOX_DIST_CONSTANT;
        r->drawn[s] = jox_alloc(constant ? 1 : r->drawn_count + 1, sizeof **r->drawn);
        for (uint32_t id = 0; !constant && id < r->drawn_count; id++)
            r->drawn[s][id] = jox_dist_draw(&next->own[s].dist, seed, id, 0, JOX_DRAW_OWN, s);
    }
    for (uint32_t s = 0; s < next->memory_count; s++) {
        int32_t from = memory_before(old, next, s);
        bool same = from >= 0 && old->memory[from].kind == next->memory[s].kind;
        r->memory[s] = same ? from : -1;
        r->memory_moves |= r->memory[s] != (int32_t)s;
    }
}

/* Whether a value that is written on entering a state stays the same for all agents. */
static bool same_value(const JoxReplacement *r, const JoxValue *a, const JoxValue *b) {
    if (a->kind != b->kind)
        return false;
    if (b->kind == JOX_VALUE_CONST)
        return a->number == b->number;
    if (b->kind == JOX_VALUE_OWN)
        return r->own[b->index] == a->index && !r->drawn[b->index];
    return true; /* programs are computed each step */
}

static void map_state(JoxReplacement *r, uint32_t from) {
    const JoxState *was = &r->old->states[from];
    int to = continued(r->next, was->name);
    r->state[from] = to;
    r->states_move |= to != (int)from;
    if (to < 0)
        return;
    const JoxState *is = &r->next->states[to];
    for (int p = 0; p < JOX_PARAM_COUNT; p++)
        if (!same_value(r, jox_state_parameter(r->old, was, p),
                        jox_state_parameter(r->next, is, p)))
            r->changed[from] |= 1u << p;
    for (int p = 0; p < JOX_PARAM_COUNT; p++) {
        const JoxValue *value = jox_state_parameter(r->next, is, p);
        if ((r->changed[from] >> p & 1) && value->kind != JOX_VALUE_PROGRAM)
            r->value[from * JOX_PARAM_COUNT + (uint32_t)p] = value;
    }
    r->changed_all |= r->changed[from];
    r->tags_change[from] = was->ignore != is->ignore || was->push_only != is->push_only;
    r->truth_moves[from] = was->transition_count != is->transition_count;
    for (uint32_t k = 0; k < JOX_MOST_TRANSITIONS; k++) {
        r->truth[from][k] = -1;
        for (uint32_t o = 0; k < is->transition_count && o < was->transition_count; o++)
            if (strcmp(was->transitions[o].id, is->transitions[k].id) == 0)
                r->truth[from][k] = (int8_t)o;
        r->truth_moves[from] |= k < is->transition_count && r->truth[from][k] != (int8_t)k;
    }
}

JoxReplacement *jox_replacement_prepare(const JoxMachine *old, JoxMachine *next, uint64_t seed,
                                        uint32_t next_id) {
    JoxReplacement *r = jox_alloc(1, sizeof *r);
    uint32_t states = old->state_count;
    r->old = old;
    r->next = next;
    r->drawn_count = next_id;
    r->state = jox_alloc(states + 1, sizeof *r->state);
    r->truth = jox_alloc(states + 1, sizeof *r->truth);
    r->truth_moves = jox_alloc(states + 1, sizeof *r->truth_moves);
    r->changed = jox_alloc(states + 1, sizeof *r->changed);
    r->value = jox_alloc((states + 1) * JOX_PARAM_COUNT, sizeof *r->value);
    r->tags_change = jox_alloc(states + 1, sizeof *r->tags_change);
    r->own = jox_alloc(next->own_count + 1, sizeof *r->own);
    r->memory = jox_alloc(next->memory_count + 1, sizeof *r->memory);
    r->drawn = jox_alloc(next->own_count + 1, sizeof *r->drawn);
    r->before = jox_alloc((size_t)old->own_count + old->memory_count + 1, sizeof *r->before);
    map_slots(r, seed);
    for (uint32_t s = 0; s < states; s++)
        map_state(r, s);
    return r;
}

void jox_replacement_free(JoxReplacement *r) {
    if (!r)
        return;
    for (uint32_t s = 0; s < r->next->own_count; s++)
        jox_free(r->drawn[s]);
    jox_free(r->drawn);
    jox_free(r->before);
    jox_free(r->state);
    jox_free(r->own);
    jox_free(r->memory);
    jox_free(r->truth);
    jox_free(r->truth_moves);
    jox_free(r->changed);
    jox_free(r->value);
    jox_free(r->tags_change);
    jox_free(r);
}

void jox_mind_census(const JoxMind *mind, uint32_t index, uint32_t *people) {
    const JoxAgents *a = mind->agents;
    memset(people, 0, mind->machines[index]->state_count * sizeof *people);
    for (uint32_t i = 0; i < a->count; i++)
        if (a->machine[i] == index)
            people[a->state[i]]++;
}

const char *jox_mind_refuses(const JoxMind *mind, uint32_t index, const JoxReplacement *r,
                             char *why, uint32_t size) {
    const JoxMachine *old = mind->machines[index];
    uint32_t people[1000];
    if (old->state_count > 1000)
        return NULL;
    jox_mind_census(mind, index, people);
    for (uint32_t s = 0; s < old->state_count; s++) {
        if (r->state[s] >= 0 || people[s] == 0)
            continue;
        snprintf(why, size,
                 "%u agent%s in '%s', which this version lacks. Name the state that they go on in: "
                 "renamed = { %s = \"...\" }",
                 people[s], people[s] == 1 ? " is" : "s are", old->states[s].name,
                 old->states[s].name);
        return why;
    }
    return NULL;
}

/* The own values of an agent in their new slots. */
static void carry_own(JoxMind *mind, const JoxReplacement *r, uint32_t i) {
    JoxAgents *a = mind->agents;
    double *own = a->own + (size_t)i * a->own_stride;
    uint64_t given = a->given[i], now = 0;
    memcpy(r->before, own, r->old->own_count * sizeof *own);
    for (uint32_t s = 0; s < r->next->own_count; s++) {
        int32_t from = r->own[s];
        if (from >= 0)
            own[s] = r->before[from];
        now |= from >= 0 && from < 64 && s < 64 ? (given >> from & 1) << s : 0;
    }
    a->given[i] = now;
}

/* One slot drawn afresh for those from `begin` to `end` whose value came from the machine. */
static void draw_slot(JoxMind *mind, const JoxReplacement *r, uint32_t index, uint32_t slot,
                      uint32_t begin, uint32_t end) {
    enum { AHEAD = 12 }; /* agents: their rows lie far apart, and are asked for in time */
    JoxAgents *a = mind->agents;
    const JoxDist *dist = &r->next->own[slot].dist;
    const double *drawn = r->drawn[slot];
    uint64_t bit = slot < 64 ? (uint64_t)1 << slot : 0;
    double *own = a->own + slot;
    for (uint32_t i = begin; i < end; i++) {
        __builtin_prefetch(own + (size_t)(i + AHEAD) * a->own_stride, 1);
        if (a->machine[i] != index || (a->given[i] & bit))
            continue;
        own[(size_t)i * a->own_stride] =
            dist->kind == JOX_DIST_CONSTANT ? dist->a
            : a->id[i] < r->drawn_count
                ? drawn[a->id[i]]
                : jox_dist_draw(dist, mind->seed, a->id[i], 0, JOX_DRAW_OWN, slot);
    }
}

static void carry_memory(JoxMind *mind, const JoxReplacement *r, uint32_t i) {
    JoxAgents *a = mind->agents;
    double *memory = a->memory + (size_t)i * a->memory_stride;
    memcpy(r->before, memory, r->old->memory_count * sizeof *memory);
    for (uint32_t s = 0; s < r->next->memory_count; s++)
        memory[s] = r->memory[s] >= 0 ? r->before[r->memory[s]] : r->next->memory[s].initial;
}

static void carry_agent(JoxMind *mind, const JoxReplacement *r, uint32_t i) {
    JoxAgents *a = mind->agents;
    uint16_t was = a->state[i];
    uint16_t is = r->state[was] >= 0 ? (uint16_t)r->state[was] : r->next->start;
    a->state[i] = is;
    if (r->truth_moves[was]) {
        uint32_t truth = 0;
        for (uint32_t k = 0; k < r->next->states[is].transition_count; k++)
            if (r->truth[was][k] >= 0)
                truth |= (a->was_true[i] >> r->truth[was][k] & 1) << k;
        a->was_true[i] = truth;
    }
    if (r->memory_moves)
        carry_memory(mind, r, i);
    if (r->tags_change[was]) {
        a->ignore[i] = r->next->states[is].ignore;
        a->push_only[i] = r->next->states[is].push_only;
    }
}

/* One parameter of those from `begin` to `end` whose state sets it otherwise; they are still in
   their old states. */
static void write_parameter(JoxMind *mind, const JoxReplacement *r, uint32_t index, int p,
                            uint32_t begin, uint32_t end) {
    JoxAgents *a = mind->agents;
    const JoxParameterInfo *info = &jox_parameters[p];
    bool angle = p == JOX_PARAM_push_angle || p == JOX_PARAM_brace_angle;
    for (uint32_t i = begin; i < end; i++) {
        if (a->machine[i] != index)
            continue;
        const JoxValue *value = r->value[a->state[i] * JOX_PARAM_COUNT + (uint32_t)p];
        if (!value)
            continue;
        double number = value->kind == JOX_VALUE_CONST ? value->number
                        : value->kind == JOX_VALUE_OWN
                            ? a->own[(size_t)i * a->own_stride + (uint32_t)value->index]
                            : info->value;
        bool plain = !angle && number >= info->least && number <= info->greatest;
        a->param[p][i] = plain ? (float)number : jox_parameter_store((JoxParameter)p, number);
    }
}

JoxMachine *jox_mind_replace(JoxMind *mind, uint32_t index, const JoxReplacement *r) {
    enum { BLOCK = 256 };
    JoxMachine *old = mind->machines[index], *next = r->next;
    JoxAgents *a = mind->agents;
    jox_agents_widen(a, next->own_count, next->memory_count);
    jox_mind_number_names(mind, next);
    mind->machines[index] = next;
    next->version = old->version + 1;
    for (uint32_t i = 0; r->own_moves && i < a->count; i++)
        if (a->machine[i] == index)
            carry_own(mind, r, i);
    bool any = r->memory_moves || r->states_move;
    for (uint32_t s = 0; s < old->state_count; s++)
        any |= r->truth_moves[s] || r->tags_change[s];
    /* A block at a time: what one loop has fetched the next finds near. */
    for (uint32_t begin = 0; (any || r->draws || r->changed_all) && begin < a->count;
         begin += BLOCK) {
        uint32_t end = begin + BLOCK < a->count ? begin + BLOCK : a->count;
        for (uint32_t s = 0; r->draws && s < next->own_count; s++)
            if (r->drawn[s])
                draw_slot(mind, r, index, s, begin, end);
        for (uint32_t bits = r->changed_all; bits; bits &= bits - 1)
            write_parameter(mind, r, index, __builtin_ctz(bits), begin, end);
        for (uint32_t i = begin; any && i < end; i++)
            if (a->machine[i] == index)
                carry_agent(mind, r, i);
    }
    return old;
}
