/* Tags and teams of a machine get the numbers that they have in the run that it is put into. */
#include "base/assert.h"
#include "machine/machine.h"

/* The bit that a bit of the machine becomes. */
static uint32_t bit_now(const JoxMachine *m, const uint16_t *numbers, uint32_t bit) {
    for (uint32_t n = 0; n < m->belonging_count; n++)
        if (!m->belongings[n].is_team && m->belongings[n].number == bit)
            return numbers[n];
    return bit;
}

static void renumber_tags(const JoxMachine *m, const uint16_t *numbers, uint64_t *tags) {
    uint64_t now = 0;
    for (uint32_t bit = 0; bit < 64; bit++)
        if (*tags >> bit & 1)
            now |= (uint64_t)1 << bit_now(m, numbers, bit);
    *tags = now;
}

static void renumber_actions(const JoxMachine *m, const uint16_t *numbers, JoxActions *actions) {
    renumber_tags(m, numbers, &actions->tags);
    for (uint32_t n = 0; n < m->belonging_count && actions->sets_team; n++)
        if (m->belongings[n].is_team && m->belongings[n].number == actions->team) {
            actions->team = numbers[n];
            break;
        }
}

void jox_machine_renumber(JoxMachine *m, const uint16_t *numbers) {
    bool moves = false;
    for (uint32_t n = 0; n < m->belonging_count; n++)
        moves |= m->belongings[n].number != numbers[n];
    if (!moves)
        return;
    for (uint32_t t = 0; t < m->target_count; t++)
        if (m->targets[t].kind == JOX_TARGET_NEAREST)
            m->targets[t].arg = (int32_t)bit_now(m, numbers, (uint32_t)m->targets[t].arg);
    for (uint32_t s = 0; s < m->state_count; s++) {
        JoxState *state = &m->states[s];
        renumber_tags(m, numbers, &state->ignore);
        renumber_tags(m, numbers, &state->push_only);
        renumber_actions(m, numbers, &state->enters);
        for (uint32_t t = 0; t < state->transition_count; t++)
            renumber_actions(m, numbers, &state->transitions[t].does);
    }
    for (uint32_t n = 0; n < m->belonging_count; n++)
        m->belongings[n].number = numbers[n];
}
