/* Checks of machines and of the results of their stages. Builds with assertions call them through
   JOX_CHECK; checks that return text also serve restored state. */
#include <math.h>

#include "base/assert.h"
#include "machine/machine_parts.h"

/* Returns whether an index is -1 or below `count`. */
static bool is_index(int64_t index, uint32_t count) {
    return index >= -1 && index < (int64_t)count;
}

uint32_t jox_op_inputs(JoxOp op) {
    if (op == JOX_OP_CLAMP || op == JOX_OP_EITHER)
        return 3;
    if (op == JOX_OP_NEG || op == JOX_OP_ABS || op == JOX_OP_SQRT || op == JOX_OP_NOT)
        return 1;
    if (op >= JOX_OP_ADD && op <= JOX_OP_OR)
        return 2;
    return op == JOX_OP_NEAR || op == JOX_OP_AFTER || op == JOX_OP_STUCK || op == JOX_OP_INCOMING ||
           op == JOX_OP_HEARD || op == JOX_OP_LIST_HAS || op == JOX_OP_EVERY ||
           op == JOX_OP_OUTER_AFTER || op == JOX_OP_OUTER_EVERY;
}

static void check_operands(const JoxMachine *m, const JoxInstruction *in) {
    const JoxOp op = (JoxOp)in->op;
    JOX_ASSERT(is_index(in->target, m->target_count) && is_index(in->place, m->target_count));
    JOX_ASSERT(op != JOX_OP_NOW || (in->arg >= 0 && in->arg < JOX_NOW_COUNT));
    JOX_ASSERT(op != JOX_OP_OWN || (uint32_t)in->arg < m->own_count);
    JOX_ASSERT(op != JOX_OP_MEMORY || (uint32_t)in->arg < m->memory_count);
    JOX_ASSERT((op != JOX_OP_PLACE_DENSITY && op != JOX_OP_PLACE_COUNT && op != JOX_OP_SHUT) ||
               in->place >= 0);
    JOX_ASSERT(op != JOX_OP_LEFT || in->place >= 0);
    JOX_ASSERT((op != JOX_OP_QUEUED && op != JOX_OP_ARRIVED) || in->place >= 0);
    JOX_ASSERT((op != JOX_OP_TOLD && op != JOX_OP_MESSAGE) ||
               (in->name >= 0 && (uint32_t)in->name < m->name_count));
    JOX_ASSERT(op < JOX_OP_LIST_HAS || op > JOX_OP_LIST_LAST ||
               ((uint32_t)in->arg < m->memory_count && jox_memory_is_list(&m->memory[in->arg])));
    JOX_ASSERT(op != JOX_OP_MESSAGE || (uint32_t)in->arg < m->name_count);
    JOX_ASSERT((op != JOX_OP_HEARD && op != JOX_OP_THEIRS && op != JOX_OP_OPEN &&
                op != JOX_OP_PROGRAM_NUMBER && op != JOX_OP_PROGRAM_CONDITION) ||
               (in->name >= 0 && (uint32_t)in->name < m->name_count));
    JOX_ASSERT((op != JOX_OP_NEIGHBOURS && op != JOX_OP_THEIRS && op != JOX_OP_OF) ||
               in->target >= 0);
    JOX_ASSERT(op != JOX_OP_OF || (in->arg >= 0 && in->arg < JOX_NOW_COUNT));
    JOX_ASSERT(op != JOX_OP_SAME || (in->target >= 0 && in->place >= 0));
    JOX_ASSERT((op != JOX_OP_OUTER_AFTER && op != JOX_OP_OUTER_LASTED && op != JOX_OP_OUTER_TIME &&
                op != JOX_OP_OUTER_EVERY) ||
               (uint32_t)in->arg < m->memory_count);
    JOX_ASSERT(op != JOX_OP_DONE || (in->arg >= 0 && in->arg < JOX_MOST_LEVELS));
}

/* Asserts that an expression reads only registers it has written, and that its last instruction
   writes register 0. */
static void check_expression(const JoxMachine *m, const JoxExpression *expression) {
    uint64_t written = 0;
    JOX_ASSERT(expression->count > 0 && expression->code[expression->count - 1].to == 0);
    for (uint32_t k = 0; k < expression->count; k++) {
        const JoxInstruction *in = &expression->code[k];
        const uint8_t inputs[3] = {in->a, in->b, in->c};
        JOX_ASSERT(in->op < JOX_OP_COUNT && in->to < JOX_MOST_REGISTERS);
        JOX_ASSERT(k + in->skip < expression->count);
        JOX_ASSERT(!in->skip || expression->code[k + in->skip].to == in->to);
        for (uint32_t n = 0; n < jox_op_inputs((JoxOp)in->op); n++)
            JOX_ASSERT(inputs[n] < JOX_MOST_REGISTERS && (written >> inputs[n] & 1));
        check_operands(m, in);
        written |= (uint64_t)1 << in->to;
    }
}

static void check_value(const JoxMachine *m, const JoxValue *value) {
    JOX_ASSERT(value->kind != JOX_VALUE_OWN || (uint32_t)value->index < m->own_count);
    JOX_ASSERT(value->kind != JOX_VALUE_EXPRESSION || (uint32_t)value->index < m->expression_count);
}

static void check_actions(const JoxMachine *m, const JoxActions *actions) {
    JOX_ASSERT(is_index(actions->signal, m->name_count));
    const JoxTell *tell = actions->tell;
    JOX_ASSERT(!tell || (tell->to >= 0 && (uint32_t)tell->to < m->target_count && tell->name >= 0 &&
                         (uint32_t)tell->name < m->name_count));
    for (uint32_t v = 0; tell && v < tell->count; v++) {
        JOX_ASSERT((uint32_t)tell->carries[v].name < m->name_count);
        JOX_ASSERT(is_index(tell->carries[v].target, m->target_count));
        check_value(m, &tell->carries[v].value);
    }
    for (uint32_t n = 0; n < actions->set_count; n++) {
        JOX_ASSERT((uint32_t)actions->set[n].slot < m->memory_count);
        JOX_ASSERT(is_index(actions->set[n].target, m->target_count));
        check_value(m, &actions->set[n].value);
    }
}

static void check_transitions(const JoxMachine *m, const JoxState *state) {
    JOX_ASSERT(state->transition_count <= JOX_MOST_TRANSITIONS);
    for (uint32_t k = 0; k < state->transition_count; k++) {
        const JoxTransition *t = &state->transitions[k];
        JOX_ASSERT(t->to < m->state_count && is_index(t->when, m->expression_count));
        JOX_ASSERT(t->level <= state->depth && (k == 0 || t[-1].level <= t->level));
        JOX_ASSERT(t->when < 0 || t->when_hook < 0); /* a condition is an expression or a
                                                        function */
        check_value(m, &t->chance);
        check_actions(m, &t->does);
    }
}

/* Asserts what is said of the outer states around a state. */
static void check_levels(const JoxMachine *m, const JoxState *state) {
    JOX_ASSERT(state->depth <= JOX_MOST_LEVELS && state->came_from <= m->memory_count);
    for (uint32_t l = 0; l < state->depth; l++)
        JOX_ASSERT(state->around[l] < m->outer_count && m->outer[state->around[l]].depth == l);
}

static void check_machine_state(const JoxMachine *m, const JoxState *state) {
    check_levels(m, state);
    const int16_t targets[] = {state->push_toward, state->face,    state->approach, state->kick,
                               state->kick_at,     state->take,    state->toss,     state->toss_at,
                               state->grasp,       state->stays_in};
    for (size_t n = 0; n < sizeof targets / sizeof *targets; n++)
        JOX_ASSERT(is_index(targets[n], m->target_count));
    JOX_ASSERT(is_index(state->push_when, m->expression_count));
    JOX_ASSERT(is_index(state->lasts_expression, m->expression_count));
    JOX_ASSERT(!(state->has_lasts && state->lasts_expression >= 0));
    JOX_ASSERT(!(state->signal_every > 0.0) || state->enters.signal >= 0);
    JOX_ASSERT(state->steer_count <= JOX_MOST_TERMS);
    for (uint32_t t = 0; t < state->steer_count; t++) {
        JOX_ASSERT(is_index(state->steer[t].target, m->target_count));
        check_value(m, &state->steer[t].weight);
        check_value(m, &state->steer[t].drift[0]);
        check_value(m, &state->steer[t].drift[1]);
    }
    for (int p = 0; p < JOX_PARAM_COUNT; p++)
        check_value(m, &state->param[p]);
    check_value(m, &state->kick_impulse);
    check_value(m, &state->kick_speed);
    check_value(m, &state->kick_lift);
    check_value(m, &state->toss_speed);
    check_value(m, &state->grip);
    check_actions(m, &state->enters);
    check_transitions(m, state);
}

void jox_machine_check(const JoxMachine *m) {
    JOX_ASSERT(m->start < m->state_count);
    for (uint32_t e = 0; e < m->expression_count; e++)
        check_expression(m, &m->expressions[e]);
    for (uint32_t s = 0; s < m->state_count; s++)
        check_machine_state(m, &m->states[s]);
    for (uint32_t o = 0; o < m->outer_count; o++) {
        check_machine_state(m, &m->outer[o]);
        JOX_ASSERT(m->outer[o].start < m->state_count);
    }
    for (uint32_t l = 0; l < JOX_MOST_LEVELS; l++)
        JOX_ASSERT(m->clock[l] <= m->memory_count && m->lasting[l] <= m->memory_count);
    for (int p = 0; p < JOX_PARAM_COUNT; p++)
        check_value(m, &m->defaults[p]);
    for (uint32_t t = 0; t < m->target_count; t++) {
        const JoxTarget *target = &m->targets[t];
        JOX_ASSERT((target->kind != JOX_TARGET_OWN_PLACE && target->kind != JOX_TARGET_ONE_OF_OWN &&
                    target->kind != JOX_TARGET_BEST_OWN) ||
                   (uint32_t)target->arg < m->own_count);
        JOX_ASSERT(target->kind != JOX_TARGET_NEAREST || (target->arg >= 0 && target->arg < 64));
        JOX_ASSERT(target->kind != JOX_TARGET_MEMORY || (uint32_t)target->arg < m->memory_count);
        JOX_ASSERT(target->kind != JOX_TARGET_MESSAGE || ((uint32_t)target->arg < m->name_count &&
                                                          is_index(target->field, m->name_count)));
        JOX_ASSERT(target->kind != JOX_TARGET_ITEM ||
                   ((uint32_t)target->arg < m->memory_count &&
                    jox_memory_is_list(&m->memory[target->arg])));
        JOX_ASSERT(target->kind != JOX_TARGET_LAST_SEEN ||
                   (uint32_t)target->arg < m->sighting_count);
        JOX_ASSERT(target->score >= 0 && (uint32_t)target->score <= m->expression_count);
        JOX_ASSERT(target->kind != JOX_TARGET_HOME || (m->home && m->home < m->memory_count));
        const JoxAgentFilter *filter = &target->filter;
        JOX_ASSERT(!filter->some || (is_index(filter->state, m->name_count) &&
                                     is_index(filter->machine, m->name_count) &&
                                     is_index(filter->memory, m->name_count)));
    }
    for (uint32_t c = 0; c < m->counter_count; c++) {
        const JoxCounter *counter = &m->counters[c];
        JOX_ASSERT(is_index(counter->target, m->target_count));
        JOX_ASSERT(counter->state < -1 ? -2 - counter->state < (int32_t)m->outer_count
                                       : is_index(counter->state, m->state_count));
        JOX_ASSERT((uint32_t)counter->value < m->memory_count);
        JOX_ASSERT((uint32_t)counter->angle < m->memory_count);
        JOX_ASSERT((uint32_t)counter->begun < m->memory_count);
    }
}

void jox_groups_check(const JoxMachineRun *run) {
    const JoxMachineScratch *s = run->scratch;
    const JoxAgents *a = run->agents;
    uint32_t grouped = 0, running = 0;
    JOX_ASSERT(s->capacity >= a->count);
    for (uint32_t i = 0; i < a->count; i++)
        running += a->machine[i] != JOX_NO_MACHINE;
    for (uint32_t b = 0; b < s->batch_count; b++) {
        const JoxBatchRange *batch = &s->batches[b];
        JOX_ASSERT(batch->begin == grouped && batch->count > 0 && batch->count <= JOX_BATCH);
        grouped += batch->count;
        for (uint32_t n = 0; n < batch->count; n++) {
            const uint32_t *i = &s->grouped[batch->begin + n];
            JOX_ASSERT(*i < a->count && (n == 0 || i[-1] < *i));
            JOX_ASSERT(a->machine[*i] == batch->machine && a->state[*i] == batch->state);
        }
    }
    JOX_ASSERT(grouped == running); /* each agent with a machine is in exactly one batch */
}

void jox_queues_check(const JoxMachineRun *run, const uint32_t *list, uint32_t count) {
    const JoxMachineScratch *s = run->scratch;
    const JoxAgents *a = run->agents;
    JOX_ASSERT(count <= a->count);
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t i = list[k];
        JOX_ASSERT(s->rank[i] <= k && (a->queued[i] <= run->tick || a->queued[i] == JOX_NO_TURN));
        JOX_ASSERT(a->queue_at[i] <= run->place_count);
        if (s->rank[i] == 0)
            continue;
        const uint32_t before = list[k - 1];
        JOX_ASSERT(s->queue[before] == s->queue[i]);
        if (s->rank[before] + 1 == s->rank[i])
            continue;
        JOX_ASSERT(s->rank[before] == s->rank[i]); /* they had no turn; one may have got it now */
        JOX_ASSERT(a->queued[before] == JOX_NO_TURN || a->queued[i] == JOX_NO_TURN);
    }
}

void jox_by_id_check(const JoxAgents *a, const uint32_t *list, uint32_t count) {
    for (uint32_t k = 0; k < count; k++) {
        JOX_ASSERT(list[k] < a->count);
        JOX_ASSERT(k == 0 || a->id[list[k - 1]] < a->id[list[k]]);
    }
}

void jox_heard_check(const JoxMachineRun *run) {
    const JoxMachineScratch *s = run->scratch;
    for (uint32_t k = 0; k < s->heard_count; k++) {
        const JoxSignal *is = &s->heard[k], *was = is - (k > 0);
        JOX_ASSERT(is->name < run->set->name_count && is->agent_id < run->agents->next_id);
        JOX_ASSERT(was->name < is->name || (was->name == is->name && !(was->x > is->x)));
    }
    for (uint32_t k = 0; k < s->everywhere_count; k++)
        JOX_ASSERT(s->everywhere[k] < run->set->name_count);
}

/* Returns the first broken condition of some messages; those that wait are sorted by receiver. */
static const char *messages_fault(const JoxMachineRun *run, const JoxMessage *messages,
                                  uint32_t count, bool sorted) {
    for (uint32_t n = 0; n < count; n++) {
        const JoxMessage *message = &messages[n];
        JOX_MUST(message->name < run->set->name_count && message->count <= JOX_MOST_CARRIED);
        JOX_MUST(message->from < run->agents->next_id && message->to < run->agents->next_id);
        JOX_MUST(!sorted || n == 0 || message[-1].to <= message->to);
        for (uint32_t v = 0; v < message->count; v++)
            JOX_MUST(message->names[v] < run->set->name_count && isfinite(message->values[v]));
    }
    return NULL;
}

const char *jox_signals_fault(const JoxMachineRun *run) {
    const JoxMachineState *state = run->state;
    for (uint32_t n = 0; n < state->called_count; n++) {
        const JoxSignal *called = &state->called[n];
        JOX_MUST(called->name < run->set->name_count && called->agent_id < run->agents->next_id);
        JOX_MUST(isfinite(called->x) && isfinite(called->y));
    }
    for (uint32_t n = 0; n < state->announced_count; n++)
        JOX_MUST(state->announced[n] < run->set->name_count);
    const char *fault = messages_fault(run, state->sent, state->sent_count, false);
    return fault ? fault : messages_fault(run, state->waiting, state->waiting_count, true);
}

/* Returns the first broken condition of an agent's own values and memory. Cells beyond the
   machine's slots are 0, since they are hashed. */
static const char *rows_fault(const JoxAgents *a, uint32_t i, const JoxMachine *machine) {
    JOX_MUST(machine->own_count <= a->own_count && machine->memory_count <= a->memory_stride);
    JOX_MUST(machine->own_count >= 64 || a->given[i] >> machine->own_count == 0);
    for (uint32_t s = machine->own_count; s < a->own_count; s++)
        JOX_MUST(jox_own(a, i, s) == 0.0);
    for (uint32_t s = machine->memory_count; s < a->memory_stride; s++)
        JOX_MUST(a->memory[(size_t)i * a->memory_stride + s] == 0.0);
    for (uint32_t s = 0; s < machine->memory_count; s++)
        JOX_MUST(machine->memory[s].kind != JOX_MEMORY_STATE ||
                 (a->memory[(size_t)i * a->memory_stride + s] >= 0.0 &&
                  a->memory[(size_t)i * a->memory_stride + s] <= machine->state_count));
    return NULL;
}

const char *jox_states_fault(const JoxMachineRun *run) {
    const JoxAgents *a = run->agents;
    for (uint32_t i = 0; i < a->count; i++) {
        if (a->machine[i] == JOX_NO_MACHINE)
            continue;
        JOX_MUST(a->machine[i] < run->set->count);
        const JoxMachine *machine = jox_machine_of(run, i);
        JOX_MUST(a->state[i] < machine->state_count);
        const uint32_t conditions = machine->states[a->state[i]].transition_count;
        JOX_MUST(conditions >= 32 || a->was_true[i] >> conditions == 0);
        JOX_MUST(a->entered[i] <= run->tick && !isnan(a->lasts[i]));
        const char *fault = rows_fault(a, i, machine);
        if (fault)
            return fault;
    }
    return NULL;
}

void jox_states_check(const JoxMachineRun *run) {
    JOX_NO_FAULT(jox_states_fault(run));
}

static void check_kicks_and_grips(const JoxMachineRun *run) {
    const uint32_t objects = run->objects ? run->objects->count : 0;
    for (uint32_t k = 0; k < run->kick_count; k++) {
        JOX_ASSERT(run->kicks[k].object < objects && run->objects->rows[run->kicks[k].object].live);
        JOX_ASSERT(run->kicks[k].impulse.z >= 0.0f); /* kicks never press a body down */
    }
    for (uint32_t k = 0; k < run->grip_count; k++) {
        const JoxGrip *grip = &run->grips[k];
        JOX_ASSERT(grip->object < objects && run->objects->rows[grip->object].live);
        JOX_ASSERT(grip->takes != run->objects->rows[grip->object].held);
        JOX_ASSERT(k == 0 || grip[-1].agent_id <= grip->agent_id);
    }
    for (uint32_t i = 0; i < run->agents->count; i++) {
        JOX_ASSERT(run->agents->kicked[i] <= objects);
        JOX_ASSERT(run->agents->approach[i] <= objects);
        JOX_ASSERT(run->agents->parting[i] <= objects);
    }
}

void jox_acts_check(const JoxMachineRun *run) {
    const JoxAgents *a = run->agents;
    check_kicks_and_grips(run);
    for (uint32_t i = 0; i < a->count; i++) {
        const JoxV2 way = {run->push_toward_x[i], run->push_toward_y[i]};
        JOX_ASSERT((way.x == 0.0f && way.y == 0.0f) || jox_is_unit(way));
        for (int p = 0; p < JOX_PARAM_COUNT; p++)
            JOX_ASSERT(isfinite(jox_param(a, p, i)));
    }
}

void jox_taken_check(const JoxMachineRun *run) {
    for (uint32_t n = 0; n < run->taken_count; n++) {
        const JoxTaken *taken = &run->taken[n];
        JOX_ASSERT(n == 0 || taken[-1].agent_id < taken->agent_id); /* sorted by id, one per
                                                                       agent */
        const JoxState *from = &run->set->items[taken->machine]->states[taken->from];
        JOX_ASSERT(taken->transition < from->transition_count);
        JOX_ASSERT(from->transitions[taken->transition].to == taken->to ||
                   from->transitions[taken->transition].back);
    }
}

void jox_preferred_check(const JoxMachineRun *run) {
    const JoxAgents *a = run->agents;
    for (uint32_t i = 0; i < a->count; i++) {
        if (a->machine[i] == JOX_NO_MACHINE)
            continue;
        JOX_ASSERT(isfinite(a->pref_x[i]) && isfinite(a->pref_y[i]));
        JOX_ASSERT(jox_is_unit((JoxV2){a->face_x[i], a->face_y[i]}));
    }
}

const char *jox_edits_fault(const JoxMachineRun *run) {
    const JoxMachineState *state = run->state;
    for (uint32_t e = 0; e < state->edit_count; e++) {
        const JoxParameterEdit *edit = &state->edits[e];
        JOX_MUST(edit->machine < run->set->count);
        const JoxMachine *built = run->set->built[edit->machine];
        JOX_MUST(is_index(edit->state, built->state_count) ||
                 (edit->state < -1 && (uint32_t)(-2 - edit->state) < built->outer_count));
        JOX_MUST(edit->parameter >= 0 && edit->parameter < JOX_PARAM_COUNT);
        JOX_MUST(edit->value >= jox_parameters[edit->parameter].least &&
                 edit->value <= jox_parameters[edit->parameter].greatest);
        for (uint32_t o = 0; o < e; o++) /* one per parameter */
            JOX_MUST(edit->machine != state->edits[o].machine ||
                     edit->state != state->edits[o].state ||
                     edit->parameter != state->edits[o].parameter);
    }
    return NULL;
}

void jox_edits_check(const JoxMachineRun *run) {
    JOX_NO_FAULT(jox_edits_fault(run));
}

void jox_counts_carried_check(const JoxMachineCounts *was, const JoxMachineCounts *is) {
    uint64_t before = 0, now = 0, given = 0;
    for (uint32_t k = 0; k < was->taken_count; k++)
        before += was->taken[k];
    for (uint32_t k = 0; k < is->taken_count; k++)
        now += is->taken[k];
    for (uint32_t b = 0; b < is->before_count; b++)
        given += is->before[b].taken;
    JOX_ASSERT(now <= before && before - now <= given); /* counts of transitions without a successor
                                                           are kept by name */
}
