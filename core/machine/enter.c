/* Entering a state: clock, duration, goal, and constant parameters. Called at spawning, by
   transitions and between steps. */
#include <math.h>

#include "base/assert.h"
#include "machine/machine_parts.h"

/* Draws a member of a set as the agent's goal, if a target of the state is "one of" a set. */
static void pick_goal(JoxMachineRun *run, const JoxMachine *machine, const JoxState *state,
                      uint32_t i) {
    JoxAgents *a = run->agents;
    int16_t asked[JOX_MOST_TERMS + 4];
    uint32_t count = 0;
    for (uint32_t t = 0; t < state->steer_count; t++)
        asked[count++] = state->steer[t].target;
    asked[count++] = state->face;
    asked[count++] = state->kick_at;
    asked[count++] = state->toss_at;
    asked[count++] = state->push_toward;
    for (uint32_t k = 0; k < count; k++) {
        const JoxTarget *target = asked[k] < 0 ? NULL : &machine->targets[asked[k]];
        if (!target || (target->kind != JOX_TARGET_ONE_OF && target->kind != JOX_TARGET_ONE_OF_OWN))
            continue;
        int32_t set = target->kind == JOX_TARGET_ONE_OF
                          ? target->arg
                          : (int32_t)jox_own(a, i, (uint32_t)target->arg);
        if (set < 0 || (uint32_t)set >= run->place_count || !run->places[set].member_count)
            continue;
        double u = jox_random_unit(run->seed, a->id[i], run->tick, JOX_DRAW_ONE_OF, 0);
        a->goal[i] = run->places[set].members[(uint32_t)(u * run->places[set].member_count)];
        JOX_ASSERT((uint32_t)a->goal[i] < run->place_count);
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

void jox_machines_enter(JoxMachineRun *run, uint32_t i, uint16_t to) {
    JoxAgents *a = run->agents;
    const JoxMachine *machine = jox_machine_of(run, i);
    const JoxState *state = &machine->states[to];
    JOX_ASSERT(to < machine->state_count && i < a->count);
    if (a->state[i] != to) /* columns that stay zero take no memory */
        a->state[i] = to;
    if (a->entered[i] != run->tick)
        a->entered[i] = run->tick;
    if (a->was_true[i])
        a->was_true[i] = 0;
    a->lasts[i] = INFINITY;
    if (jox_queue_target(state) < 0 && a->queue_at[i])
        a->queue_at[i] = 0;
    if (a->turn[i] && !jox_gather_term(state)) /* it keeps its turn in states that wait in the same
                                                  way */
        a->turn[i] = 0;
    if (state->has_lasts)
        a->lasts[i] =
            (float)jox_dist_draw(&state->lasts, run->seed, a->id[i], run->tick, JOX_DRAW_LASTS, 0);
    else if (state->lasts_expression >= 0 && !run->spawning)
        a->lasts[i] = jox_duration_of(run, machine, state, i);
    pick_goal(run, machine, state, i);
    jox_machines_write_parameters(run, i);
    if (state->removes)
        a->removed[i] = 1;
}
