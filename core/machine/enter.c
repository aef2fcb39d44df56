/* Entering a state: clock, duration, goal, and constant parameters. Called at spawning, by
   transitions and between steps. */
#include <math.h>

#include "base/assert.h"
#include "machine/machine_parts.h"

/* Draws a member of a set as the agent's goal, if a target of the state is "one of" a set. */
static void pick_goal(JoxMachineRun *run, const JoxMachine *machine, const JoxState *state,
                      uint32_t i) {
    JoxAgents *a = run->agents;
    int16_t asked[JOX_MOST_TERMS + 5];
    uint32_t count = 0;
    for (uint32_t t = 0; t < state->steer_count; t++)
        asked[count++] = state->steer[t].target;
    asked[count++] = state->face;
    asked[count++] = state->kick_at;
    asked[count++] = state->toss_at;
    asked[count++] = state->push_toward;
    asked[count++] = state->stays_in;
    for (uint32_t k = 0; k < count; k++) {
        const JoxTarget *target = asked[k] < 0 ? NULL : &machine->targets[asked[k]];
        const int32_t drawn = target ? jox_target_draw_place(run, i, target, 0) : -1;
        if (drawn < 0)
            continue;
        a->goal[i] = drawn;
        return;
    }
}

void jox_machines_write_parameters(JoxMachineRun *run, uint32_t i) {
    JoxAgents *a = run->agents;
    const JoxMachine *machine = jox_machine_of(run, i);
    const JoxState *state = &machine->states[a->state[i]];
    for (int p = 0; p < JOX_PARAM_COUNT; p++) {
        const JoxValue *value = jox_state_parameter(machine, state, p);
        if (value->kind == JOX_VALUE_EXPRESSION)
            continue;
        double number = value->kind == JOX_VALUE_UNSET ? jox_parameters[p].value
                                                       : jox_value(run, machine, value, i);
        jox_param_set(a, p, i, jox_parameter_store((JoxParameter)p, number));
        if (jox_is_odd(p, value->kind, number))
            jox_odd_note(run, i, p, value, number);
    }
    if (a->ignore[i] != state->ignore)
        a->ignore[i] = state->ignore;
    if (a->push_only[i] != state->push_only)
        a->push_only[i] = state->push_only;
}

float jox_duration_of(JoxMachineRun *run, const JoxMachine *machine, const JoxState *state,
                      uint32_t i) {
    const JoxValue lasts = {.kind = JOX_VALUE_EXPRESSION,
                            .index = state->lasts_expression,
                            .line = state->line,
                            .source = state->source};
    const double seconds = jox_value(run, machine, &lasts, i);
    if (isnan(seconds)) /* infinite is a way to say for ever */
        jox_odd_note(run, i, JOX_ACTION_LASTS, &lasts, seconds);
    return isnan(seconds) ? INFINITY : (float)seconds;
}

/* Draws a duration on entering a state by a transition on `level`; infinite if the state has none.
   Those of outer states have random numbers of their own. */
static float draw_lasts(JoxMachineRun *run, const JoxState *on, uint32_t i, uint32_t outer) {
    const JoxAgents *a = run->agents;
    return on->has_lasts ? (float)jox_dist_draw(&on->lasts, run->seed, a->id[i], run->tick,
                                                JOX_DRAW_LASTS, outer)
                         : INFINITY;
}

void jox_machines_draw_lasts(JoxMachineRun *run, uint32_t i, uint32_t level) {
    JoxAgents *a = run->agents;
    const JoxMachine *machine = jox_machine_of(run, i);
    const JoxState *state = &machine->states[a->state[i]],
                   *on = jox_state_on_level(machine, state, level);
    if (on->lasts_expression < 0)
        return;
    const float lasts = jox_duration_of(run, machine, on, i);
    if (level == state->depth)
        a->lasts[i] = lasts;
    else if (machine->lasting[level])
        a->memory[(size_t)i * a->memory_stride + machine->lasting[level] - 1] = lasts;
}

/* Starts the clocks of the outer states that a transition on `level` enters. */
static void start_outer_clocks(JoxMachineRun *run, const JoxMachine *machine, const JoxState *state,
                               uint32_t i, uint32_t level) {
    const JoxAgents *a = run->agents;
    const size_t first = (size_t)i * a->memory_stride;
    for (uint32_t l = level; l < state->depth; l++) {
        if (machine->clock[l])
            a->memory[first + machine->clock[l] - 1] = run->tick;
        if (machine->lasting[l])
            a->memory[first + machine->lasting[l] - 1] =
                draw_lasts(run, &machine->outer[state->around[l]], i, 1 + l);
    }
}

/* Returns the bits of the conditions of outer states that the agent does not leave. */
static uint32_t get_kept_conditions(const JoxState *state, uint32_t level) {
    uint32_t kept = 0;
    for (uint32_t k = 0; level > 0 && k < state->transition_count; k++)
        kept |= state->transitions[k].level < level ? 1u << k : 0;
    return kept;
}

void jox_machines_enter_level(JoxMachineRun *run, uint32_t i, uint16_t to, uint32_t level) {
    JoxAgents *a = run->agents;
    const JoxMachine *machine = jox_machine_of(run, i);
    const JoxState *state = &machine->states[to];
    JOX_ASSERT(to < machine->state_count && i < a->count && level <= state->depth);
    const bool keeps_goal = level > 0 && state->goal_level < (int8_t)level &&
                            machine->states[a->state[i]].goal_level == state->goal_level;
    if (a->state[i] != to) /* columns that stay zero take no memory */
        a->state[i] = to;
    if (a->entered[i] != run->tick)
        a->entered[i] = run->tick;
    if (a->was_true[i])
        a->was_true[i] &= get_kept_conditions(state, level);
    start_outer_clocks(run, machine, state, i, level);
    if (jox_queue_target(state) < 0 && a->queue_at[i])
        a->queue_at[i] = 0;
    if (a->turn[i] && !jox_gather_term(state)) /* it keeps its turn in states that wait in the same
                                                  way */
        a->turn[i] = 0;
    a->lasts[i] = draw_lasts(run, state, i, 0);
    if (!keeps_goal)
        pick_goal(run, machine, state, i);
    jox_machines_write_parameters(run, i);
    if (state->removes)
        a->removed[i] = 1;
}

void jox_machines_enter(JoxMachineRun *run, uint32_t i, uint16_t to) {
    jox_machines_enter_level(run, i, to, 0);
}
