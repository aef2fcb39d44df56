/* The trace of one agent between its transitions: a line when a term of a condition that it waits
   for has changed, and the first time that a reaction is done in a stay. Repetitions are counted:
   a term that changes often, and a reaction that is done often, has ever fewer lines. think.c calls
   it. */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "machine/machine_parts.h"
#include "machine/why.h"

/* s: least time between the first two lines on one term or reaction; it doubles with each line, up
   to the greatest. */
static const double QUIET = 1.0, LONGEST_QUIET = 64.0;

/* A term, or the result of a function, of a transition of the present state. */
typedef struct Traced {
    bool told, last;      /* it held when it was last told of, and in the last step */
    uint32_t changes, at; /* since it was last told of; tick of that */
    double quiet;         /* s: until the next line */
} Traced;

/* A reaction of the present state. */
typedef struct Reacted {
    bool known;           /* it was done in this stay */
    uint32_t again, at;   /* times since it was last told of; tick of that */
    uint32_t first, last; /* ticks of the first of these, and when it was last done */
    double quiet;         /* s: until the next line */
} Reacted;

struct JoxTraceTerms {
    const JoxMachine *version; /* version whose text has these terms */
    uint16_t machine, state;
    uint32_t entered; /* tick at which the state was entered; the terms are of that stay */
    Traced *terms;
    uint32_t count;
    size_t capacity;
    Reacted reactions[JOX_MOST_TRANSITIONS];
    JoxText ahead; /* explanation of the transition that is due in this step */
    bool begun;
};

static double lengthen_quiet(double quiet) {
    return quiet > 0.0 ? fmin(2.0 * quiet, LONGEST_QUIET) : QUIET;
}

/* ---- reactions ---- */

/* Appends how often a reaction was done since it was told of, if it was. */
static void tell_repeats(JoxMachineRun *run, uint32_t item) {
    const struct JoxTraceTerms *trace = run->trace_terms;
    Reacted *of = &run->trace_terms->reactions[item];
    const JoxMachine *machine = run->set->items[trace->machine];
    const JoxTransition *t = &machine->states[trace->state].transitions[item];
    if (of->again == 0)
        return;
    jox_text_printf(&run->trace, "t=%.2f agent %u %s: in %s, reaction (%s:%d) ",
                    run->tick * run->dt, run->trace_id, machine->name,
                    machine->states[trace->state].name, jox_machine_file(machine, t->source),
                    t->line);
    if (of->again == 1 && of->first == run->tick)
        jox_text_add(&run->trace, "again\n");
    else if (of->again == 1)
        jox_text_printf(&run->trace, "again, at t=%.2f\n", of->first * run->dt);
    else
        jox_text_printf(&run->trace, "again, %u times since t=%.2f\n", of->again,
                        of->first * run->dt);
    of->again = 0;
    of->at = run->tick;
    of->quiet = lengthen_quiet(of->quiet);
}

/* Tells the repetitions of all reactions of the stay. */
static void tell_all_repeats(JoxMachineRun *run) {
    const struct JoxTraceTerms *trace = run->trace_terms;
    const JoxState *state = &run->set->items[trace->machine]->states[trace->state];
    for (uint32_t k = 0; k < state->transition_count; k++)
        tell_repeats(run, k);
}

void jox_trace_reaction(JoxMachineRun *run, const JoxTaken *taken) {
    Reacted *of = &run->trace_terms->reactions[taken->transition];
    of->last = run->tick;
    run->trace_shows_item = !of->known;
    if (!of->known) {
        jox_machines_explain(run, taken, &run->trace);
        *of = (Reacted){.known = true, .at = run->tick, .last = run->tick, .quiet = QUIET};
        return;
    }
    of->first = of->again++ ? of->first : run->tick;
    if ((run->tick - of->at) * run->dt >= of->quiet)
        tell_repeats(run, taken->transition);
}

/* Returns whether item k is a reaction that is done in this step, or was in the one before, whose
   terms need no lines of their own. */
static bool is_reacting(const JoxMachineRun *run, uint32_t i, uint32_t k) {
    const Reacted *of = &run->trace_terms->reactions[k];
    const bool reacts =
        run->set->items[run->trace_terms->machine]->reacts && (run->scratch->reacts[i] >> k & 1);
    return reacts || (of->known && run->tick - of->last <= 1);
}

/* ---- terms ---- */

/* Begins anew if the agent is in another state than in the last step. */
static void begin_stay(struct JoxTraceTerms *trace, JoxMachineRun *run, uint32_t i) {
    const JoxAgents *a = run->agents;
    if (trace->begun && trace->version == jox_machine_of(run, i) &&
        trace->machine == a->machine[i] && trace->state == a->state[i] &&
        trace->entered == a->entered[i])
        return;
    if (trace->begun && trace->version == run->set->items[trace->machine])
        tell_all_repeats(run);
    memset(trace->reactions, 0, sizeof trace->reactions);
    trace->begun = true;
    trace->version = jox_machine_of(run, i);
    trace->machine = a->machine[i];
    trace->state = a->state[i];
    trace->entered = a->entered[i];
    trace->count = 0;
}

/* Compares a term with what was told of it; appends a line if it differs, and it is time. */
static void trace_term(JoxMachineRun *run, uint32_t number, bool holds, bool silent,
                       const JoxTransition *t, const char *text, const char *note) {
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
    if (silent) {
        term->told = holds;
        term->changes = 0;
        return;
    }
    if (term->told == holds || (term->at > 0 && (run->tick - term->at) * run->dt < term->quiet))
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
    *term = (Traced){
        .told = holds, .last = holds, .at = run->tick, .quiet = lengthen_quiet(term->quiet)};
}

/* Writes the value of a term as text: "3.2 m; agent 12, 3.2 m away". */
static void write_note(const JoxWhyTerm *term, JoxText *out) {
    out->length = 0;
    if (term->measured)
        jox_text_printf(out, "%.4g%s%s", term->value, *term->unit ? " " : "", term->unit);
    if (term->note.length)
        jox_text_printf(out, "%s%s", out->length ? "; " : "", term->note.data);
}

void jox_trace_due(JoxMachineRun *run, const JoxTaken *due) {
    run->trace_terms->ahead.length = 0;
    jox_machines_explain(run, due, &run->trace_terms->ahead);
}

void jox_trace_transition(JoxMachineRun *run) {
    tell_all_repeats(run);
    jox_text_add(&run->trace, run->trace_terms->ahead.data);
    run->trace_shows_item = true;
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
        const bool silent = is_reacting(run, i, k);
        jox_why_transition(run, i, k, &why);
        if (why.is_function)
            trace_term(run, number++, why.held_before, silent, &state->transitions[k],
                       "its function", "");
        for (uint32_t n = 0; n < why.count; n++) {
            if (why.terms[n].kind != JOX_WHY_WORD)
                continue;
            write_note(&why.terms[n], &note);
            trace_term(run, number++, why.terms[n].holds, silent || why.terms[n].beats,
                       &state->transitions[k], why.terms[n].text.data, note.data ? note.data : "");
        }
        jox_why_free(&why);
    }
    jox_text_free(&note);
    if (run->scratch->fired[i] >= 0) /* the transition is told of instead */
        run->trace.length = begun;
}

void jox_trace_free(JoxMachineRun *run) {
    if (run->trace_terms) {
        jox_free(run->trace_terms->terms);
        jox_text_free(&run->trace_terms->ahead);
    }
    jox_free(run->trace_terms);
    run->trace_terms = NULL;
}
