/* Records for watched agents: the last message of each name that came to them, and the last call of
   each signal, with the place where they were. No step reads them. */
#include <stdio.h>

#include "base/mem.h"
#include "machine/machine_parts.h"

/* Returns the record of messages of a name, which is made if there is none. */
static struct JoxCame *find_came(JoxWatched *watched, uint32_t name) {
    for (uint32_t k = 0; k < watched->came_count; k++)
        if (watched->came[k].name == name)
            return &watched->came[k];
    JOX_RESERVE(watched->came, watched->came_capacity, watched->came_count + 1);
    watched->came[watched->came_count] = (struct JoxCame){.name = name};
    return &watched->came[watched->came_count++];
}

/* Returns the record of the receiver of a message; NULL: it is not watched. */
static JoxWatched *find_watched(const JoxMachineRun *run, uint32_t id) {
    for (uint32_t n = 0; n < run->watched_count; n++)
        if (run->watched[n].agent_id == id)
            return &run->watched[n];
    return NULL;
}

void jox_watch_message(const JoxMachineRun *run, const JoxMessage *message) {
    JoxWatched *watched = find_watched(run, message->to);
    if (!watched)
        return;
    struct JoxCame *came = find_came(watched, message->name);
    *came = (struct JoxCame){.name = message->name,
                             .count = came->count + 1,
                             .sent = message->sent,
                             .from = message->from};
}

/* Returns the record of a message, if that is the last one of its name which came to a watched
   agent; else NULL. */
static struct JoxCame *find_last_came(const JoxMachineRun *run, const JoxMessage *message) {
    JoxWatched *watched = find_watched(run, message->to);
    struct JoxCame *came = watched ? find_came(watched, message->name) : NULL;
    return came && came->sent == message->sent && came->from == message->from ? came : NULL;
}

void jox_watch_lost_message(const JoxMachineRun *run, const JoxMessage *message) {
    struct JoxCame *came = find_last_came(run, message);
    if (!came)
        return;
    came->fate = JOX_CAME_LOST;
    came->tick = run->tick;
}

void jox_watch_used_message(const JoxMachineRun *run, const JoxMessage *message,
                            const JoxMachine *machine, const JoxTransition *item) {
    struct JoxCame *came = find_last_came(run, message);
    if (!came)
        return;
    came->fate = JOX_CAME_USED;
    came->tick = run->tick;
    if (!machine || !item)
        snprintf(came->by, sizeof came->by, "a function");
    else if (item->stays)
        snprintf(came->by, sizeof came->by, "a reaction (%.60s:%d)",
                 jox_machine_file(machine, item->source), item->line);
    else
        snprintf(came->by, sizeof came->by, "its transition to %.40s (line %d)",
                 jox_transition_leads_to(machine, item), item->line);
}

/* Records a call, unless one of the same step was nearer. */
static void note_call(JoxWatched *watched, struct JoxOverheard call) {
    uint32_t k = 0;
    while (k < watched->overheard_count && watched->overheard[k].name != call.name)
        k++;
    if (k == watched->overheard_count) {
        JOX_RESERVE(watched->overheard, watched->overheard_capacity, k + 1);
        watched->overheard_count++;
        watched->overheard[k] = call;
        return;
    }
    const struct JoxOverheard *was = &watched->overheard[k];
    if (was->tick == call.tick && call.agent_id == watched->agent_id)
        return; /* it does not hear itself */
    const JoxV2 own = {call.own_x, call.own_y};
    const bool nearer =
        was->agent_id != UINT32_MAX && jox_length2(jox_sub(jox_v2(call.x, call.y), own)) <
                                           jox_length2(jox_sub(jox_v2(was->x, was->y), own));
    if (was->tick != call.tick || was->agent_id == watched->agent_id || nearer)
        watched->overheard[k] = call;
}

void jox_watch_calls(const JoxMachineRun *run) {
    const JoxMachineState *state = run->state;
    for (uint32_t w = 0; w < run->watched_count; w++) {
        JoxWatched *watched = &run->watched[w];
        const uint32_t i = jox_agents_find(run->agents, watched->agent_id);
        if (i == JOX_NO_INDEX)
            continue;
        struct JoxOverheard call = {
            .tick = run->tick, .own_x = run->agents->x[i], .own_y = run->agents->y[i]};
        for (uint32_t n = 0; n < state->announced_count; n++) {
            call.name = state->announced[n];
            call.agent_id = UINT32_MAX;
            note_call(watched, call);
        }
        for (uint32_t n = 0; n < state->called_count; n++) {
            const JoxSignal *called = &state->called[n];
            call.name = called->name;
            call.agent_id = called->agent_id;
            call.x = called->x;
            call.y = called->y;
            note_call(watched, call);
        }
    }
}
