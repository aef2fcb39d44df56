/* What agents call out, and who hears it; names that machines share. */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "machine/internal.h"

uint32_t jox_mind_name(JoxMind *mind, const char *name) {
    for (uint32_t n = 0; n < mind->name_count; n++)
        if (strcmp(mind->names[n], name) == 0)
            return n;
    JOX_RESERVE(mind->names, mind->name_capacity, mind->name_count + 1);
    mind->names[mind->name_count] = jox_strdup(name);
    return mind->name_count++;
}

void jox_mind_number_names(JoxMind *mind, JoxMachine *machine) {
    for (uint32_t n = 0; n < machine->name_count; n++)
        machine->names[n].number = jox_mind_name(mind, machine->names[n].text);
    for (uint32_t s = 0; s < machine->state_count; s++)
        machine->states[s].name_number = jox_mind_name(mind, machine->states[s].name);
}

void jox_mind_call(JoxMind *mind, uint32_t agent, uint32_t name) {
    const JoxAgents *a = mind->agents;
    JOX_RESERVE(mind->called, mind->called_capacity, mind->called_count + 1);
    mind->called[mind->called_count++] = (JoxSignal){name, a->id[agent], a->x[agent], a->y[agent]};
}

void jox_mind_announce(JoxMind *mind, uint32_t name) {
    JOX_RESERVE(mind->announced, mind->announced_capacity, mind->announced_count + 1);
    mind->announced[mind->announced_count++] = name;
}

static bool comes_before(const JoxSignal *a, const JoxSignal *b) {
    if (a->name != b->name)
        return a->name < b->name;
    return a->x != b->x ? a->x < b->x : a->agent_id < b->agent_id;
}

void jox_mind_listen(JoxMind *mind) {
    JoxSignal *swap = mind->heard;
    uint32_t capacity = mind->heard_capacity;
    mind->heard = mind->called;
    mind->heard_count = mind->called_count;
    mind->heard_capacity = mind->called_capacity;
    mind->called = swap;
    mind->called_capacity = capacity;
    mind->called_count = 0;
    uint32_t *names = mind->everywhere, room = mind->everywhere_capacity;
    mind->everywhere = mind->announced;
    mind->everywhere_count = mind->announced_count;
    mind->everywhere_capacity = mind->announced_capacity;
    mind->announced = names;
    mind->announced_capacity = room;
    mind->announced_count = 0;
    uint32_t count = mind->heard_count;
    for (uint32_t gap = count / 2; gap > 0; gap = gap == 2 ? 1 : gap * 5 / 11)
        for (uint32_t k = gap; k < count; k++) {
            JoxSignal moving = mind->heard[k];
            uint32_t at = k;
            for (; at >= gap && comes_before(&moving, &mind->heard[at - gap]); at -= gap)
                mind->heard[at] = mind->heard[at - gap];
            mind->heard[at] = moving;
        }
}

bool jox_heard(const JoxMind *mind, uint32_t i, uint32_t name, double reach) {
    const JoxAgents *a = mind->agents;
    for (uint32_t n = 0; n < mind->everywhere_count; n++)
        if (mind->everywhere[n] == name)
            return true;
    float r = jox_minf((float)reach, a->param[JOX_PARAM_perception][i]), x = a->x[i], y = a->y[i];
    JoxSignal from = {.name = name, .x = x - r};
    uint32_t low = 0, high = mind->heard_count;
    while (low < high) {
        uint32_t middle = (low + high) / 2;
        if (comes_before(&mind->heard[middle], &from))
            low = middle + 1;
        else
            high = middle;
    }
    for (; low < mind->heard_count; low++) {
        const JoxSignal *s = &mind->heard[low];
        if (s->name != name || s->x > x + r)
            return false;
        float dx = s->x - x, dy = s->y - y;
        if (s->agent_id != a->id[i] && dx * dx + dy * dy <= r * r)
            return true;
    }
    return false;
}

void jox_mind_repeat_signals(JoxMind *mind) {
    JoxMindScratch *s = mind->scratch;
    const JoxAgents *a = mind->agents;
    s->list_count = 0;
    for (uint32_t b = 0; b < s->batch_count; b++) {
        const JoxBatchRange *batch = &s->batches[b];
        const JoxState *state = &mind->machines[batch->machine]->states[batch->state];
        for (uint32_t n = 0; state->signal_every > 0.0 && n < batch->count; n++) {
            uint32_t i = s->grouped[batch->begin + n];
            double time = jox_time_in_state(mind, i), every = state->signal_every;
            if (floor(time / every + 1e-9) > floor((time - mind->dt) / every + 1e-9))
                s->list[s->list_count++] = i;
        }
    }
    jox_sort_by_id(mind, s->list, s->list_count);
    for (uint32_t n = 0; n < s->list_count; n++) {
        uint32_t i = s->list[n];
        const JoxMachine *machine = jox_machine_of(mind, i);
        const JoxState *state = &machine->states[a->state[i]];
        if (jox_time_in_state(mind, i) > 0.0) /* entering has called already */
            jox_mind_call(mind, i, machine->names[state->enters.signal].number);
    }
}

uint32_t jox_neighbours_of(const JoxMind *mind, uint32_t i, int32_t kind, int32_t name) {
    const JoxAgents *a = mind->agents;
    const JoxNeighbours *n = mind->neighbours;
    uint32_t count = 0;
    for (uint32_t k = 0; k < n->count[i]; k++) {
        uint32_t j = n->index[jox_neighbour_at(n, i, k)];
        bool wanted = kind == JOX_KIN_ALL         ? true
                      : kind == JOX_KIN_TEAMMATES ? a->team[j] && a->team[j] == a->team[i]
                      : kind == JOX_KIN_OPPONENTS
                          ? a->team[j] && a->team[i] && a->team[j] != a->team[i]
                          : (a->tags[j] >> kind & 1) != 0;
        if (!wanted || (name >= 0 && a->machine[j] == JOX_NO_MACHINE))
            continue;
        count +=
            name < 0 || jox_machine_of(mind, j)->states[a->state[j]].name_number == (uint32_t)name;
    }
    return count;
}

void jox_actions_do(JoxMind *mind, const JoxMachine *machine, const JoxActions *actions,
                    uint32_t i) {
    JoxAgents *a = mind->agents;
    for (uint32_t n = 0; n < actions->set_count; n++) {
        const struct JoxAssign *assign = &actions->set[n];
        double value = jox_value(mind, machine, &assign->value, i);
        if (isfinite(value))
            a->memory[(size_t)i * a->memory_stride + (uint32_t)assign->slot] = value;
    }
    if (actions->signal >= 0)
        jox_mind_call(mind, i, machine->names[actions->signal].number);
}
