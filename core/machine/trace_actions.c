/* Appends to a trace what its items have set, told and called. signals.c calls it. */
#include "machine/machine_parts.h"

enum { MOST_RECEIVERS = 4 }; /* named of one message */

/* Appends a message, and to whom it was sent: "tells agent 3 'pass'". `first`: the first of
   them. */
static void add_told(const JoxMachineRun *run, const char *name, uint32_t first, JoxText *out) {
    const uint32_t count = run->state->sent_count - first;
    jox_text_add(out, count ? "tells " : "tells nobody");
    for (uint32_t n = 0; n < count && n < MOST_RECEIVERS; n++)
        jox_text_printf(out, "%sagent %u", n ? ", " : "", run->state->sent[first + n].to);
    if (count > MOST_RECEIVERS)
        jox_text_printf(out, " and %u more", count - MOST_RECEIVERS);
    jox_text_printf(out, " '%s'", name);
}

void jox_trace_actions(JoxMachineRun *run, const JoxMachine *machine, const JoxActions *actions,
                       uint32_t i, uint32_t first_sent) {
    const JoxAgents *a = run->agents;
    JoxText *out = &run->trace;
    const char *before = "    sets ";
    if (!run->trace_shows_item)
        return;
    for (uint32_t n = 0; n < actions->set_count; n++) {
        const uint32_t slot = (uint32_t)actions->set[n].slot;
        if (!*machine->memory[slot].name)
            continue;
        jox_text_printf(out, "%s%s = ", before, machine->memory[slot].name);
        jox_memory_print(run, machine, a->memory + (size_t)i * a->memory_stride, slot, out);
        before = ", ";
    }
    if (actions->tell) {
        jox_text_add(out, *before == ',' ? ", " : "    ");
        add_told(run, machine->names[actions->tell->name].text, first_sent, out);
        before = ", ";
    }
    if (actions->signal >= 0) {
        jox_text_printf(out, "%scalls '%s'", *before == ',' ? ", " : "    ",
                        machine->names[actions->signal].text);
        before = ", ";
    }
    if (*before == ',')
        jox_text_add(out, "\n");
}
