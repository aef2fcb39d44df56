/* Sends messages from agent to agent, delivers and uses them. What actions tell in a step waits for
   its receiver from the next one on, until an item of its state that rests on it by `told` is
   taken. think.c delivers and uses messages, signals.c sends them; inbox.c finds those that wait.
 */
#include <assert.h>
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/sort.h"
#include "machine/machine_parts.h"

static JoxMessage *add_sent(JoxMachineState *state, const JoxMessage *message) {
    JOX_RESERVE(state->sent, state->sent_capacity, state->sent_count + 1);
    state->sent[state->sent_count] = *message;
    return &state->sent[state->sent_count++];
}

bool jox_message_send(JoxMachineRun *run, const JoxMessage *message) {
    if (run->state->sent_count >= JOX_MOST_SENT)
        return false;
    add_sent(run->state, message);
    return true;
}

/* Returns the counts of messages of a name. */
static JoxMessageTally *find_counts(const JoxMachineRun *run, uint32_t name) {
    JoxMachineState *state = run->state;
    if (name >= state->tally_count) {
        const uint32_t count = run->set->name_count;
        JOX_RESERVE(state->tallies, state->tally_capacity, count);
        memset(state->tallies + state->tally_count, 0,
               (count - state->tally_count) * sizeof *state->tallies);
        state->tally_count = count;
    }
    return &state->tallies[name];
}

void jox_message_to_nobody(JoxMachineRun *run, uint32_t name) {
    run->state->messages_to_nobody++;
    find_counts(run, name)->to_nobody++;
}

/* Returns the message that an agent tells, without a receiver. */
static JoxMessage compose_message(JoxMachineRun *run, const JoxMachine *machine,
                                  const JoxTell *tell, uint32_t i) {
    JoxMessage message = {.from = run->agents->id[i],
                          .name = machine->names[tell->name].number,
                          .sent = run->tick,
                          .count = tell->count};
    for (uint32_t v = 0; v < tell->count; v++) {
        const struct JoxCarried *carried = &tell->carries[v];
        const double value = carried->target >= 0
                                 ? jox_target_draw_who(run, i, carried->target, UINT32_MAX - v)
                                 : jox_value(run, machine, &carried->value, i);
        if (!isfinite(value))
            jox_odd_note(run, i, JOX_ACTION_TELL, &carried->value, value);
        message.names[v] = machine->names[carried->name].number;
        message.values[v] = isfinite(value) ? value : 0.0;
        message.somebody |= (carried->target >= 0 ? 1u : 0u) << v;
    }
    return message;
}

void jox_tell(JoxMachineRun *run, const JoxMachine *machine, const JoxTell *tell, uint32_t i) {
    JoxMessage message = compose_message(run, machine, tell, i);
    uint32_t heard[JOX_SMALL_CROWD];
    if (tell->all) {
        const uint32_t count = jox_list_wanted(run, &machine->targets[tell->to], i, heard);
        if (count == 0)
            jox_message_to_nobody(run, message.name);
        for (uint32_t n = 0; n < count; n++) {
            message.to = run->agents->id[heard[n]];
            add_sent(run->state, &message);
        }
        return;
    }
    const uint32_t j = jox_who_agent(run, jox_target_who(run, i, tell->to));
    if (j == JOX_NO_INDEX) {
        jox_message_to_nobody(run, message.name);
        return;
    }
    message.to = run->agents->id[j];
    add_sent(run->state, &message);
}

/* ---- delivery ---- */

/* Returns whether a machine asks for messages of this name. */
static bool asks_for(const JoxMachine *machine, uint32_t name) {
    for (uint32_t n = 0; n < machine->name_count; n++)
        if (machine->names[n].number == name && (machine->names[n].uses & JOX_NAME_TOLD))
            return true;
    return machine->hears_functions;
}

/* Returns whether a machine, or one that its agents may become, asks for messages of this name. */
static bool may_ask_for(const JoxMachineSet *set, uint32_t machine, uint32_t name) {
    static_assert(JOX_MOST_MACHINES <= 64, "a bit for each machine");
    uint64_t reached = (uint64_t)1 << machine, looked = 0;
    while (reached != looked)
        for (uint32_t m = 0; m < set->count; m++) {
            if (!((reached & ~looked) >> m & 1))
                continue;
            if (asks_for(set->items[m], name))
                return true;
            looked |= (uint64_t)1 << m;
            for (uint32_t s = 0; s < set->items[m]->state_count; s++)
                if (set->items[m]->states[s].become_machine >= 0)
                    reached |= (uint64_t)1 << set->items[m]->states[s].become_machine;
        }
    return false;
}

static void count_unasked(JoxMachineRun *run, uint32_t name) {
    run->state->messages_unasked++;
    find_counts(run, name)->unasked++;
}

void jox_messages_recheck(JoxMachineRun *run, uint32_t i) {
    uint32_t count;
    const JoxMessage *first = jox_messages_of(run, i, &count);
    for (uint32_t m = 0; m < count; m++) {
        if (first[m].used || may_ask_for(run->set, run->agents->machine[i], first[m].name))
            continue;
        count_unasked(run, first[m].name);
        run->state->waiting[(uint32_t)(first - run->state->waiting) + m].used = JOX_MESSAGE_USED;
    }
}

/* Returns whether a message has a receiver that asks for it, or may come to; counts it if not. */
static bool is_deliverable(JoxMachineRun *run, const JoxMessage *message) {
    const uint32_t i = jox_agents_find(run->agents, message->to);
    if (i == JOX_NO_INDEX) {
        jox_message_to_nobody(run, message->name);
        return false;
    }
    if (run->agents->machine[i] != JOX_NO_MACHINE &&
        may_ask_for(run->set, run->agents->machine[i], message->name)) {
        JoxMessageTally *told = find_counts(run, message->name);
        *told = (JoxMessageTally){told->count + 1, told->to_nobody, told->unasked, told->lost,
                                  message->sent,   message->from,   message->to,   0};
        if (run->watched_count)
            jox_watch_message(run, message);
        return true;
    }
    count_unasked(run, message->name);
    return false;
}

static int compare_receivers(const void *a, const void *b, const void *context) {
    const JoxMessage *one = a, *other = b;
    (void)context;
    return (one->to > other->to) - (one->to < other->to);
}

/* Reports that a message is dropped because too many wait, once for each name. */
static void tell_lost(JoxMachineRun *run, const JoxMessage *lost) {
    JoxMachineState *state = run->state;
    state->messages_lost++;
    find_counts(run, lost->name)->lost++;
    if (run->watched_count)
        jox_watch_lost_message(run, lost);
    for (uint32_t n = 0; n < run->lost_name_count; n++)
        if (run->lost_names[n] == lost->name)
            return;
    JOX_RESERVE(run->lost_names, run->lost_name_capacity, run->lost_name_count + 1);
    run->lost_names[run->lost_name_count++] = lost->name;
    jox_text_printf(
        &run->notes,
        "t = %.2f s: more than %d messages wait for agent %u: the oldest, '%.60s' of agent "
        "%u, is dropped. Further ones are counted. Ask for it by told \"%.60s\" in each "
        "state that it can come in, or tell it less often\n",
        run->tick * run->dt, JOX_MOST_WAITING, lost->to, run->set->names[lost->name], lost->from,
        run->set->names[lost->name]);
}

/* Removes used messages, those of agents that have left, and the oldest ones beyond
   JOX_MOST_WAITING. */
static void drop_messages(JoxMachineRun *run) {
    JoxMachineState *state = run->state;
    uint32_t kept = 0;
    for (uint32_t m = 0; m < state->waiting_count;) {
        const uint32_t to = state->waiting[m].to;
        const bool gone = jox_agents_find(run->agents, to) == JOX_NO_INDEX;
        uint32_t end = m, unused = 0;
        for (; end < state->waiting_count && state->waiting[end].to == to; end++)
            unused += !state->waiting[end].used;
        for (; m < end; m++) {
            if (state->waiting[m].used || gone)
                continue;
            if (unused > JOX_MOST_WAITING) {
                tell_lost(run, &state->waiting[m]);
                unused--;
                continue;
            }
            state->waiting[kept++] = state->waiting[m];
        }
    }
    state->waiting_count = kept;
}

void jox_messages_deliver(JoxMachineRun *run) {
    JoxMachineState *state = run->state;
    uint32_t count = 0;
    for (uint32_t m = 0; m < state->sent_count; m++)
        if (is_deliverable(run, &state->sent[m]))
            state->sent[count++] = state->sent[m];
    state->sent_count = 0;
    if (count == 0 && state->waiting_count == 0)
        return;
    JOX_RESERVE(state->sent, state->sent_capacity, count + JOX_SORT_SPARE(count));
    jox_sort(state->sent, count, sizeof *state->sent, compare_receivers, NULL,
             state->sent + count); /* keeps the order of those of one receiver */
    JOX_RESERVE(state->waiting, state->waiting_capacity, state->waiting_count + count);
    uint32_t from = state->waiting_count, at = from + count;
    state->waiting_count = at;
    while (count > 0) /* merged from the end; older ones of a receiver come first */
        if (from > 0 && state->waiting[from - 1].to > state->sent[count - 1].to) {
            from--;
            state->waiting[--at] = state->waiting[from];
        } else {
            state->waiting[--at] = state->sent[--count];
        }
    drop_messages(run);
}

/* ---- using ---- */

/* Bits of an agent's messages that the value in each register rests on. */
typedef uint32_t Rests[JOX_MOST_REGISTERS];

/* Returns the bit of the message of a name that conditions read; 0 if none waits. */
static uint32_t find_read_message(uint32_t name, const JoxMessage *first, uint32_t count) {
    for (uint32_t m = 0; m < count; m++)
        if (first[m].name == name && !(first[m].used & JOX_MESSAGE_USED))
            return 1u << m;
    return 0;
}

/* Returns the bits that a target of an instruction rests on: whom or what a message carries. */
static uint32_t find_target_rest(const JoxMachine *machine, int32_t target, const JoxMessage *first,
                                 uint32_t count) {
    if (target < 0 || machine->targets[target].kind != JOX_TARGET_MESSAGE)
        return 0;
    return find_read_message(machine->names[machine->targets[target].arg].number, first, count);
}

/* Returns the bits that the result of an instruction rests on: of AND those of both sides, or of
   the sides that do not hold; of OR those of the first side that holds. */
static uint32_t find_rest(const JoxMachine *machine, const JoxInstruction *in, const Rests rests,
                          JoxRegisters values, const JoxMessage *first, uint32_t count) {
    const bool a = values[in->a][0] != 0.0, b = values[in->b][0] != 0.0;
    if (in->op == JOX_OP_AND)
        return (a && !b ? 0 : rests[in->a]) | (b && !a ? 0 : rests[in->b]);
    if (in->op == JOX_OP_OR)
        return a ? rests[in->a] : b ? rests[in->b] : rests[in->a] | rests[in->b];
    if (in->op == JOX_OP_EITHER)
        return rests[in->a] | rests[a ? in->b : in->c];
    uint32_t bits = find_target_rest(machine, in->target, first, count) |
                    find_target_rest(machine, in->place, first, count);
    if (in->op == JOX_OP_TOLD || in->op == JOX_OP_MESSAGE)
        bits |= find_read_message(machine->names[in->name].number, first, count);
    const uint8_t from[] = {in->a, in->b, in->c};
    for (uint32_t k = 0; k < jox_op_inputs((JoxOp)in->op); k++)
        bits |= rests[from[k]];
    return bits;
}

void jox_messages_use(JoxMachineRun *run, const JoxMachine *machine, const JoxTransition *t,
                      uint32_t i) {
    static _Thread_local JoxRegisters values;
    const JoxExpression *expression = &machine->expressions[t->rests];
    Rests rests = {0};
    uint32_t count;
    const JoxMessage *first = jox_messages_of(run, i, &count);
    for (uint32_t k = 0; count > 0 && k < expression->count; k++) {
        JoxInstruction in = expression->code[k];
        in.skip = 0;
        const JoxExpression one = {&in, 1};
        const uint32_t rest = find_rest(machine, &in, rests, values, first, count);
        jox_eval(run, machine, &one, &i, 1, values);
        rests[in.to] = rest;
    }
    for (uint32_t m = 0; m < count; m++)
        if (rests[0] >> m & 1) {
            if (!first[m].used && run->watched_count)
                jox_watch_used_message(run, &first[m], machine, t);
            run->state->waiting[(uint32_t)(first - run->state->waiting) + m].used |=
                JOX_MESSAGE_BY_ITEM;
        }
}

void jox_messages_settle(JoxMachineRun *run) {
    JoxMachineState *state = run->state;
    for (uint32_t m = 0; m < state->waiting_count; m++)
        if (state->waiting[m].used)
            state->waiting[m].used = JOX_MESSAGE_USED;
}
