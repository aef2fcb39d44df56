/* The trace of one agent between its transitions: a line when a term of a condition that it waits
   for has changed. A term that changes often has at most one line a second. think.c calls it. */
#include <string.h>

#include "base/mem.h"
#include "machine/machine_parts.h"
#include "machine/why.h"

static const double QUIET = 1.0; /* s: least time between two lines on one term */

/* A term, or the result of a function, of a transition of the present state. */
typedef struct Traced {
    bool told, last;      /* it held when it was last told of, and in the last step */
    uint32_t changes, at; /* since it was last told of; tick of that */
} Traced;

struct JoxTraceTerms {
    const JoxMachine *version; /* version whose text has these terms */
    uint16_t machine, state;
    uint32_t entered; /* tick at which the state was entered; the terms are of that stay */
    Traced *terms;
    uint32_t count;
    size_t capacity;
    bool begun;
};

/* Begins anew if the agent is in another state than in the last step. */
static void begin_stay(struct JoxTraceTerms *trace, const JoxMachineRun *run, uint32_t i) {
    const JoxAgents *a = run->agents;
    if (trace->begun && trace->version == jox_machine_of(run, i) &&
        trace->machine == a->machine[i] && trace->state == a->state[i] &&
        trace->entered == a->entered[i])
        return;
    trace->begun = true;
    trace->version = jox_machine_of(run, i);
    trace->machine = a->machine[i];
    trace->state = a->state[i];
    trace->entered = a->entered[i];
    trace->count = 0;
}

/* Compares a term with what was told of it; appends a line if it differs, and it is time. */
static void trace_term(JoxMachineRun *run, uint32_t number, bool holds, const JoxTransition *t,
                       const char *text, const char *note) {
    struct JoxTraceTerms *trace = run->trace_terms;
    const JoxMachine *machine = run->set->items[trace->machine];
    if (number >= trace->count) { /* the first step of the stay */
        JOX_RESERVE(trace->terms, trace->capacity, number + 1);
        trace->terms[number] = (Traced){.told = holds, .last = holds};
        trace->count = number + 1;
        return;
    }
    Traced *term = &trace->terms[number];
    term->changes += term->last != holds;
    term->last = holds;
    if (term->told == holds || (term->at > 0 && (run->tick - term->at) * run->dt < QUIET))
        return;
    jox_text_printf(&run->trace, "t=%.2f agent %u %s: in %s, for %s: %s %s%s%s",
                    run->tick * run->dt, run->trace_id, machine->name,
                    machine->states[trace->state].name,
                    t->stays  ? "its reaction"
                    : t->back ? "back"
                              : machine->states[t->to].name,
                    text, holds ? "now holds" : "no longer holds", *note ? ": " : "", note);
    if (term->changes > 1)
        jox_text_printf(&run->trace, " (the last of %u changes)", term->changes);
    jox_text_add(&run->trace, "\n");
    *term = (Traced){.told = holds, .last = holds, .at = run->tick};
}

/* Writes the value of a term as text: "3.2 m; agent 12, 3.2 m away". */
static void write_note(const JoxWhyTerm *term, JoxText *out) {
    out->length = 0;
    if (term->measured)
        jox_text_printf(out, "%.4g%s%s", term->value, *term->unit ? " " : "", term->unit);
    if (term->note.length)
        jox_text_printf(out, "%s%s", out->length ? "; " : "", term->note.data);
}

void jox_trace_waiting(JoxMachineRun *run) {
    const JoxAgents *a = run->agents;
    const uint32_t i =
        run->trace_id < a->next_id ? jox_agents_find(a, run->trace_id) : JOX_NO_INDEX;
    if (i == JOX_NO_INDEX || a->machine[i] == JOX_NO_MACHINE)
        return;
    if (!run->trace_terms)
        run->trace_terms = jox_alloc(1, sizeof *run->trace_terms);
    begin_stay(run->trace_terms, run, i);
    const JoxState *state = &run->set->items[a->machine[i]]->states[a->state[i]];
    const size_t begun = run->trace.length;
    uint32_t number = 0;
    JoxText note = {0};
    for (uint32_t k = 0; k < state->transition_count; k++) {
        JoxWhyTransition why;
        jox_why_transition(run, i, k, &why);
        if (why.is_function)
            trace_term(run, number++, why.held_before, &state->transitions[k], "its function", "");
        for (uint32_t n = 0; n < why.count; n++) {
            if (why.terms[n].kind != JOX_WHY_WORD)
                continue;
            write_note(&why.terms[n], &note);
            trace_term(run, number++, why.terms[n].holds, &state->transitions[k],
                       why.terms[n].text.data, note.data ? note.data : "");
        }
        jox_why_free(&why);
    }
    jox_text_free(&note);
    if (run->scratch->fired[i] >= 0) /* the transition is told of instead */
        run->trace.length = begun;
}

void jox_trace_free(JoxMachineRun *run) {
    if (run->trace_terms)
        jox_free(run->trace_terms->terms);
    jox_free(run->trace_terms);
    run->trace_terms = NULL;
}
