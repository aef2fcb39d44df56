/* Messages that wait for agents: which ones, and what they carry. tell.c sends, delivers and uses
   them. */
#include "machine/machine_parts.h"

/* Returns the index of the first message that waits for an agent of at least this id. */
static uint32_t find_first_of(const JoxMachineState *state, uint32_t id) {
    uint32_t low = 0, high = state->waiting_count;
    while (low < high) {
        const uint32_t middle = (low + high) / 2;
        if (state->waiting[middle].to < id)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

const JoxMessage *jox_messages_of(const JoxMachineRun *run, uint32_t agent, uint32_t *count) {
    const JoxMachineState *state = run->state;
    const uint32_t id = run->agents->id[agent], first = find_first_of(state, id);
    *count = 0;
    while (first + *count < state->waiting_count && state->waiting[first + *count].to == id)
        ++*count;
    return state->waiting + first;
}

/* Returns the oldest message of a name that waits for the agent and has none of these uses. */
static JoxMessage *find_unless(const JoxMachineRun *run, uint32_t agent, uint32_t name,
                               uint32_t uses) {
    const JoxMachineState *state = run->state;
    if (state->waiting_count == 0)
        return NULL;
    const uint32_t id = run->agents->id[agent];
    for (uint32_t m = find_first_of(state, id);
         m < state->waiting_count && state->waiting[m].to == id; m++)
        if (state->waiting[m].name == name && !(state->waiting[m].used & uses))
            return &state->waiting[m];
    return NULL;
}

const JoxMessage *jox_message_find(const JoxMachineRun *run, uint32_t agent, uint32_t name) {
    return find_unless(run, agent, name, JOX_MESSAGE_USED);
}

const JoxMessage *jox_message_take(JoxMachineRun *run, uint32_t agent, uint32_t name) {
    JoxMessage *message = find_unless(run, agent, name, JOX_MESSAGE_USED | JOX_MESSAGE_BY_FUNCTION);
    if (!message)
        return NULL;
    if (!message->used && run->watched_count)
        jox_watch_used_message(run, message, NULL, NULL);
    message->used |= run->thinks ? JOX_MESSAGE_BY_FUNCTION : JOX_MESSAGE_USED;
    return message;
}

double jox_message_value(const JoxMessage *message, uint32_t name, bool somebody) {
    for (uint32_t v = 0; message && v < message->count; v++)
        if (message->names[v] == name && (message->somebody >> v & 1) == somebody)
            return message->values[v];
    return 0.0;
}
