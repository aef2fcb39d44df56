/* Collects why agents stay in their states. */
#include "base/assert.h"
#include "base/mem.h"
#include "machine/lifts.h"
#include "run/why/why.h"

/* Returns whether an item of a state comes before another: transitions before reactions, then the
   nearer one. */
static bool comes_before(const JoxTransition *a, const JoxTransition *b, JoxWhyGap of_a,
                         JoxWhyGap of_b) {
    return a->stays != b->stays ? b->stays : jox_why_is_nearer(of_a, of_b);
}

/* Sorts the items of a state: nearest to firing first, else in the order of the state. */
static void sort_by_gap(const JoxState *state, uint32_t *order, const JoxWhyGap *gaps) {
    const uint32_t count = state->transition_count;
    for (uint32_t k = 0; k < count; k++) {
        uint32_t at = k;
        for (; at > 0 && comes_before(&state->transitions[k], &state->transitions[order[at - 1]],
                                      gaps[k], gaps[order[at - 1]]);
             at--)
            order[at] = order[at - 1];
        order[at] = k;
    }
}

bool jox_why_leads_to(const JoxMachine *machine, const JoxTransition *t, const char *to) {
    return !t->stays && !t->back && jox_state_is_in(&machine->states[t->to], to);
}

uint32_t jox_why_count_leading(const JoxState *state) {
    uint32_t count = 0;
    for (uint32_t k = 0; k < state->transition_count; k++)
        count += !state->transitions[k].stays;
    return count;
}

/* Finds the shortest way of transitions from the agent's state to the one that is asked for. */
static void find_way(JoxWhyAgent *why) {
    const JoxMachine *m = why->machine;
    const uint16_t begin = (uint16_t)(why->state - m->states);
    uint16_t *from = jox_alloc(m->state_count, sizeof *from);
    uint16_t *reached = jox_alloc(m->state_count, sizeof *reached);
    bool *known = jox_alloc(m->state_count, sizeof *known);
    uint32_t count = 1, at = 0;
    bool found = false;
    reached[0] = begin;
    known[begin] = true;
    for (; at < count && !found; at++) {
        const JoxState *state = &m->states[reached[at]];
        for (uint32_t k = 0; k < state->transition_count && !found; k++) {
            const JoxTransition *t = &state->transitions[k];
            const bool itself = at == 0 && !t->stays;
            const uint16_t to = itself ? why->transitions[k].to : t->to;
            if (t->stays || (t->back && !itself) || known[to])
                continue;
            known[to] = true;
            from[to] = reached[at];
            reached[count++] = to;
            found = jox_state_is_in(&m->states[to], why->to);
        }
    }
    if (found) {
        uint32_t steps = 1;
        for (uint16_t s = reached[count - 1]; s != begin; s = from[s])
            steps++;
        why->way = jox_alloc(steps, sizeof *why->way);
        why->way_count = steps;
        for (uint16_t s = reached[count - 1]; steps-- > 0; s = from[s])
            why->way[steps] = s;
    }
    jox_free(from);
    jox_free(reached);
    jox_free(known);
}

bool jox_why_is_asked(const JoxWhyAgent *why, uint32_t transition) {
    const JoxMachine *m = why->machine;
    const uint16_t to = why->transitions[transition].to;
    if (why->way_count < 2)
        return true;
    if (why->state->transitions[transition].stays)
        return false;
    return why->way_count == 2 ? jox_state_is_in(&m->states[to], why->to) : to == why->way[1];
}

void jox_why_agent(JoScene *scene, JoxBehaviourLook *look, uint32_t agent, const char *to,
                   JoxWhyAgent *out) {
    const JoWorld *world = scene->world;
    const JoxAgents *a = &world->state.agents;
    const double dt = world->model.def.dt;
    JOX_ASSERT(agent < a->count && a->machine[agent] != JOX_NO_MACHINE);
    const JoxMachine *machine = world->machines.set->items[a->machine[agent]];
    JoxWhyGap gaps[JOX_MOST_TRANSITIONS];
    *out = (JoxWhyAgent){.agent = agent,
                         .machine = machine,
                         .state = &machine->states[a->state[agent]],
                         .since = a->entered[agent] * dt,
                         .to = to,
                         .now = (double)world->state.tick * dt};
    for (uint32_t n = 0; n < world->machines.watched_count; n++)
        if (world->machines.watched[n].agent_id == a->id[agent])
            out->watched = &world->machines.watched[n];
    jox_world_look_at(scene->world, look, agent);
    for (uint32_t k = 0; k < out->state->transition_count; k++) {
        jox_why_transition(&world->machines, agent, k, &out->transitions[k]);
        gaps[k] = out->transitions[k].gap;
    }
    jox_why_add_deeds(&world->machines, agent, &out->deeds);
    sort_by_gap(out->state, out->order, gaps);
    if (to && !jox_state_is_in(out->state, to))
        find_way(out);
}

void jox_why_agent_free(JoxWhyAgent *why) {
    for (uint32_t k = 0; k < why->state->transition_count; k++)
        jox_why_free(&why->transitions[k]);
    jox_free(why->way);
    jox_text_free(&why->deeds);
}

/* ---- many agents in one state ---- */

/* Counts a transition of one agent; keeps its tree if it is the nearest so far, else frees it. */
static void count_transition(struct JoxWhyCrowdTransition *t, uint32_t agent,
                             JoxWhyTransition *one) {
    const bool first = t->nearest == JOX_NO_INDEX;
    if (first && one->count)
        t->holders = jox_alloc(one->count, sizeof *t->holders);
    for (uint32_t k = 0; k < one->count; k++)
        t->holders[k] += one->terms[k].holds;
    t->fires += one->fires;
    t->lost += one->chance == JOX_WHY_LOST;
    t->held += one->is_function ? one->held_before : one->holds;
    if (first || jox_why_is_nearer(one->gap, t->shown.gap)) {
        jox_why_free(&t->shown);
        t->shown = *one;
        t->nearest = agent;
    } else {
        jox_why_free(one);
    }
}

/* Counts an agent for the lift that it uses. */
static void count_ride(const JoxMachineRun *run, uint32_t agent, JoxWhyCrowd *crowd) {
    const JoxRider *rider;
    const JoxRidePhase phase = jox_machines_ride(run, agent, &rider);
    if (phase == JOX_RIDE_OVER)
        return;
    struct JoxWhyCrowdLift *lift = &crowd->lifts[rider->lift];
    const double since = rider->since * run->dt;
    lift->approach += phase == JOX_RIDE_APPROACH;
    lift->ride += phase == JOX_RIDE_INSIDE;
    if (phase == JOX_RIDE_WAIT && (lift->wait++ == 0 || since < lift->since)) {
        lift->since = since;
        lift->first = agent;
    }
}

void jox_why_crowd(JoScene *scene, JoxBehaviourLook *look, const uint32_t *agents, uint32_t count,
                   JoxWhyCrowd *out) {
    const JoWorld *world = scene->world;
    const JoxAgents *a = &world->state.agents;
    const double dt = world->model.def.dt;
    JOX_ASSERT(count > 0);
    const JoxMachine *machine = world->machines.set->items[a->machine[agents[0]]];
    *out =
        (JoxWhyCrowd){.machine = machine,
                      .state = &machine->states[a->state[agents[0]]],
                      .people = count,
                      .longest = agents[0],
                      .lifts = jox_alloc((size_t)world->model.lift_count + 1, sizeof *out->lifts)};
    for (uint32_t k = 0; k < out->state->transition_count; k++)
        out->transitions[k].nearest = JOX_NO_INDEX;
    for (uint32_t n = 0; n < count; n++) {
        const uint32_t i = agents[n];
        const double since = a->entered[i] * dt;
        out->longest = a->entered[i] < a->entered[out->longest] ? i : out->longest;
        out->earliest = n == 0 || since < out->earliest ? since : out->earliest;
        out->latest = since > out->latest ? since : out->latest;
        count_ride(&world->machines, i, out);
        jox_world_look_at(scene->world, look, i);
        for (uint32_t k = 0; k < out->state->transition_count; k++) {
            JoxWhyTransition one;
            jox_why_transition(&world->machines, i, k, &one);
            count_transition(&out->transitions[k], i, &one);
        }
    }
    JoxWhyGap gaps[JOX_MOST_TRANSITIONS];
    for (uint32_t k = 0; k < out->state->transition_count; k++)
        gaps[k] = out->transitions[k].shown.gap;
    sort_by_gap(out->state, out->order, gaps);
    jox_world_look_at(scene->world, look, out->longest);
    if (!jox_why_add_deeds(&world->machines, out->longest, &out->deeds))
        out->deeds.length = 0;
}

void jox_why_crowd_free(JoxWhyCrowd *crowd) {
    jox_text_free(&crowd->deeds);
    jox_free(crowd->lifts);
    for (uint32_t k = 0; k < crowd->state->transition_count; k++) {
        jox_free(crowd->transitions[k].holders);
        jox_why_free(&crowd->transitions[k].shown);
    }
}
