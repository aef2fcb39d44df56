/* Builds the tree of a condition: executes its straight-line code for one agent and joins what the
   registers stand for. `not` is carried down to the words, so that trees consist of ALL and ANY. */
#include "machine/why.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "machine/why_words.h"

/* What is known of a register while a condition is built. */
typedef struct Built {
    JoxSpelled spelled;
    uint32_t term; /* JOX_WHY_NONE: it is a number or a word without a term yet */
    double value;
    const char *unit;
    const JoxInstruction *about; /* of a number: what measures a target in it; NULL: nothing */
} Built;

/* A condition that is being built. */
typedef struct Building {
    const JoxMachineRun *run;
    const JoxMachine *machine;
    uint32_t agent;
    JoxWhyTransition *out;
    Built built[JOX_MOST_REGISTERS];
} Building;

static uint32_t add_term(JoxWhyTransition *out, JoxWhyTerm term) {
    JOX_RESERVE(out->terms, out->capacity, out->count + 1);
    term.first = term.first ? term.first : JOX_WHY_NONE;
    term.next = JOX_WHY_NONE;
    out->terms[out->count] = term;
    return out->count++;
}

/* Makes a term of a word or a comparison. */
static uint32_t add_word(Building *b, const Built *of, JoxWhyTerm term) {
    term.kind = JOX_WHY_WORD;
    term.holds = of->value != 0.0;
    jox_text_add(&term.text, of->spelled.plain.data ? of->spelled.plain.data : "");
    return add_term(b->out, term);
}

/* Returns the term of a register, which is made if it has none: memory as a condition, `true`. */
static uint32_t find_term(Building *b, uint8_t reg) {
    Built *of = &b->built[reg];
    if (of->term == JOX_WHY_NONE)
        of->term = add_word(b, of, (JoxWhyTerm){.unit = ""});
    return of->term;
}

/* Appends an input to a list of inputs: if it is of the same kind, its inputs. */
static void append_input(JoxWhyTransition *out, JoxWhyKind kind, uint32_t input, uint32_t *first,
                         uint32_t *last) {
    uint32_t from = input;
    if (out->terms[input].kind == kind)
        from = out->terms[input].first;
    if (*first == JOX_WHY_NONE)
        *first = from;
    else
        out->terms[*last].next = from;
    for (*last = from; out->terms[*last].next != JOX_WHY_NONE;)
        *last = out->terms[*last].next;
}

static uint32_t join_terms(Building *b, JoxWhyKind kind, uint32_t left, uint32_t right,
                           bool holds) {
    uint32_t first = JOX_WHY_NONE, last = JOX_WHY_NONE;
    append_input(b->out, kind, left, &first, &last);
    append_input(b->out, kind, right, &first, &last);
    const uint32_t joined = add_term(b->out, (JoxWhyTerm){.kind = kind, .holds = holds});
    b->out->terms[joined].first = first;
    return joined;
}

/* Negates a term: carries `not` down to its words. */
static void negate_term(JoxWhyTransition *out, uint32_t index) {
    static const char *const OPPOSITES[][2] = {{">", "<="}, {">=", "<"}, {"is", "is not"},
                                               {"<", ">="}, {"<=", ">"}, {"is not", "is"}};
    JoxWhyTerm *term = &out->terms[index];
    term->holds = !term->holds;
    if (term->kind != JOX_WHY_WORD) {
        term->kind = term->kind == JOX_WHY_ALL ? JOX_WHY_ANY : JOX_WHY_ALL;
        for (uint32_t k = term->first; k != JOX_WHY_NONE; k = out->terms[k].next)
            negate_term(out, k);
        return;
    }
    term->negated = !term->negated;
    for (size_t o = 0; term->measured && o < sizeof OPPOSITES / sizeof *OPPOSITES; o++)
        if (strcmp(term->relation, OPPOSITES[o][0]) == 0) {
            term->relation = OPPOSITES[o][1];
            return;
        }
}

/* Puts `not` before the words that are negated. */
static void write_negations(JoxWhyTransition *out) {
    for (uint32_t k = 0; k < out->count; k++) {
        JoxWhyTerm *term = &out->terms[k];
        if (!term->negated)
            continue;
        JoxText text = {0};
        jox_text_printf(&text, term->is_infix ? "not (%s)" : "not %s", term->text.data);
        jox_text_free(&term->text);
        term->text = text;
    }
}

/* Returns how far a word is from holding: the distance of its value from its bound, as a share of
   the greater of both; 1 where nothing is measured. */
static JoxWhyGap measure_gap(const JoxWhyTerm *term) {
    if (term->holds)
        return (JoxWhyGap){0, 0.0};
    double far = 1.0;
    if (term->measured && isfinite(term->value) && isfinite(term->bound)) {
        const double scale = fmax(fabs(term->value), fabs(term->bound));
        far = scale > 0.0 ? fmin(1.0, fabs(term->value - term->bound) / scale) : 0.0;
    }
    return (JoxWhyGap){1, far};
}

/* Computes the gaps of a term and of all terms below it. */
static JoxWhyGap compute_gap(JoxWhyTransition *out, uint32_t index) {
    JoxWhyTerm *term = &out->terms[index];
    JoxWhyGap sum = {0, 0.0}, least = {UINT32_MAX, 0.0};
    for (uint32_t k = term->first; k != JOX_WHY_NONE; k = out->terms[k].next) {
        const JoxWhyGap gap = compute_gap(out, k);
        sum = (JoxWhyGap){sum.misses + gap.misses, sum.far + gap.far};
        least = jox_why_is_nearer(gap, least) ? gap : least;
    }
    term->gap = term->kind == JOX_WHY_WORD  ? measure_gap(term)
                : term->kind == JOX_WHY_ALL ? sum
                                            : least;
    return term->gap;
}

/* Makes the term of a comparison of two numbers. */
static uint32_t add_comparison(Building *b, const JoxInstruction *in, const Built *of) {
    const Built *left = &b->built[in->a], *right = &b->built[in->b];
    JoxWhyTerm term = {.measured = true,
                       .value = left->value,
                       .bound = right->value,
                       .is_infix = true,
                       .relation = jox_operation_sign((JoxOp)in->op),
                       .unit = *left->unit ? left->unit : right->unit};
    /* Of a computed number, the values of its words. */
    const bool computed = !right->spelled.constant || left->spelled.binding != JOX_BINDS_ALL;
    if (computed)
        jox_text_add(&term.note, of->spelled.valued.data);
    const JoxInstruction *about = left->about ? left->about : right->about;
    if (about) {
        JoxText target = {0};
        if (about->op == JOX_OP_NEIGHBOURS)
            jox_why_add_count(b->run, b->agent, about->target, &target);
        else
            jox_why_add_target(b->run, b->agent, about->target, &target);
        if (target.length)
            jox_text_printf(&term.note, "%s%s", computed ? "; " : "", target.data);
        jox_text_free(&target);
    }
    return add_word(b, of, term);
}

/* Returns what measures a target in the result of an instruction; NULL: nothing does. */
static const JoxInstruction *find_about(const Building *b, const JoxInstruction *in) {
    const JoxOp op = (JoxOp)in->op;
    const uint8_t inputs[] = {in->a, in->b, in->c};
    const JoxInstruction *about = NULL;
    if (in->target >= 0 && (op == JOX_OP_DISTANCE || op == JOX_OP_OF || op == JOX_OP_THEIRS ||
                            op == JOX_OP_NEIGHBOURS))
        return in;
    for (uint32_t k = 0; k < jox_op_inputs(op); k++)
        about = about ? about : b->built[inputs[k]].about;
    return about;
}

static void build_instruction(Building *b, const JoxInstruction *in, double value) {
    JoxSpelled spelled[JOX_MOST_REGISTERS];
    const JoxOp op = (JoxOp)in->op;
    Built to = {.term = JOX_WHY_NONE, .value = value, .unit = ""};
    for (uint32_t r = 0; r < JOX_MOST_REGISTERS; r++)
        spelled[r] = b->built[r].spelled;
    jox_spell_instruction(b->machine, in, spelled, value, &to.spelled);
    if (op >= JOX_OP_GT && op <= JOX_OP_EQ) {
        to.term = add_comparison(b, in, &to);
    } else if (op == JOX_OP_AND || op == JOX_OP_OR) {
        const uint32_t left = find_term(b, in->a), right = find_term(b, in->b);
        to.term =
            join_terms(b, op == JOX_OP_AND ? JOX_WHY_ALL : JOX_WHY_ANY, left, right, value != 0.0);
    } else if (op == JOX_OP_NOT) {
        to.term = find_term(b, in->a);
        negate_term(b->out, to.term);
    } else if (jox_op_is_condition(op)) {
        JoxWhyTerm term = {.unit = ""};
        jox_why_measure(b->run, b->agent, in, b->built[in->a].value, &term);
        to.term = add_word(b, &to, term);
    } else {
        to.unit = jox_why_unit(in);
        to.about = find_about(b, in);
    }
    jox_spelled_free(&b->built[in->to].spelled);
    b->built[in->to] = to;
}

static void build_condition(const JoxMachineRun *run, uint32_t agent,
                            const JoxExpression *expression, JoxWhyTransition *out) {
    static _Thread_local JoxRegisters values;
    Building b = {.run = run, .machine = jox_machine_of(run, agent), .agent = agent, .out = out};
    for (uint32_t r = 0; r < JOX_MOST_REGISTERS; r++)
        b.built[r] = (Built){.term = JOX_WHY_NONE, .unit = ""};
    for (uint32_t k = 0; k < expression->count; k++) {
        const JoxInstruction *in = &expression->code[k];
        JoxExpression one = {(JoxInstruction *)in, 1};
        jox_eval(run, b.machine, &one, &agent, 1, values);
        build_instruction(&b, in, values[in->to][0]);
    }
    out->root = find_term(&b, 0);
    for (uint32_t r = 0; r < JOX_MOST_REGISTERS; r++)
        jox_spelled_free(&b.built[r].spelled);
    write_negations(out);
    out->gap = compute_gap(out, out->root);
    out->holds = out->terms[out->root].holds;
    JOX_ASSERT(out->holds == (values[0][0] != 0.0) && out->holds == (out->gap.misses == 0));
}

void jox_why_transition(const JoxMachineRun *run, uint32_t agent, uint32_t index,
                        JoxWhyTransition *out) {
    const JoxAgents *a = run->agents;
    const JoxMachine *machine = jox_machine_of(run, agent);
    JOX_ASSERT(index < machine->states[a->state[agent]].transition_count);
    const JoxTransition *t = &machine->states[a->state[agent]].transitions[index];
    *out = (JoxWhyTransition){
        .index = index, .to = jox_destination(run, t, agent), .root = JOX_WHY_NONE};
    out->held_before = a->was_true[agent] >> index & 1;
    out->is_function = t->when_hook >= 0;
    if (out->is_function)
        out->gap = out->held_before ? (JoxWhyGap){0, 0.0} : (JoxWhyGap){1, 1.0};
    else if (t->when >= 0)
        build_condition(run, agent, &machine->expressions[t->when], out);
    else
        out->holds = true;
    const bool holds = out->is_function ? out->held_before : out->holds;
    if (t->chance.kind != JOX_VALUE_UNSET) {
        out->chance_value = jox_value(run, machine, &t->chance, agent);
        out->chance = holds && out->held_before ? JOX_WHY_LOST : JOX_WHY_TO_ROLL;
        if (holds) /* something else than its condition keeps it back */
            out->gap = (JoxWhyGap){1, out->chance == JOX_WHY_LOST ? 1.0 : 0.0};
    }
    out->fires = holds && out->chance == JOX_WHY_CERTAIN && !out->is_function;
}

void jox_why_free(JoxWhyTransition *transition) {
    for (uint32_t k = 0; k < transition->count; k++) {
        jox_text_free(&transition->terms[k].text);
        jox_text_free(&transition->terms[k].note);
    }
    jox_free(transition->terms);
    *transition = (JoxWhyTransition){.root = JOX_WHY_NONE};
}

/* ---- the look ---- */

static JoxMessage *copy_messages(const JoxMessage *messages, uint32_t count) {
    JoxMessage *copy = jox_alloc((size_t)count + 1, sizeof *copy);
    if (count)
        memcpy(copy, messages, count * sizeof *copy);
    return copy;
}

/* Delivers messages in a copy of the state, which the look reads. */
static void deliver_to_copy(JoxMachineRun *run, JoxMachineLook *look) {
    JoxMachineState *copy = &look->delivered;
    copy->waiting = copy_messages(copy->waiting, copy->waiting_count);
    copy->sent = copy_messages(copy->sent, copy->sent_count);
    copy->waiting_capacity = copy->waiting_count + 1;
    copy->sent_capacity = copy->sent_count + 1;
    copy->tallies = jox_alloc((size_t)copy->tally_count + 1, sizeof *copy->tallies);
    if (copy->tally_count)
        memcpy(copy->tallies, look->state->tallies, copy->tally_count * sizeof *copy->tallies);
    copy->tally_capacity = copy->tally_count + 1;
    run->state = copy;
    run->watched_count = 0; /* what comes is recorded in the next step */
    jox_messages_deliver(run);
    run->watched_count = look->watched_count;
}

void jox_machines_look(JoxMachineRun *run, JoxPool *pool, const JoxNeighbours *neighbours,
                       uint32_t tick, JoxMachineLook *before) {
    JoxMachineScratch *s = jox_machines_scratch(run);
    *before = (JoxMachineLook){.neighbours = run->neighbours,
                               .tick = run->tick,
                               .heading = s->heading,
                               .state = run->state,
                               .delivered = *run->state,
                               .lost_name_count = run->lost_name_count,
                               .watched_count = run->watched_count,
                               .notes = run->notes.length};
    run->neighbours = neighbours;
    run->tick = tick;
    deliver_to_copy(run, before);
    s->heading = NULL; /* the preferred velocities are those of the last step until the next */
    jox_signals_peek(run);
    jox_machines_group_again(run, pool);
    jox_queues_look(run);
    jox_machines_count_places(run);
}

void jox_machines_end_look(JoxMachineRun *run, JoxMachineLook *before) {
    jox_free(before->delivered.waiting);
    jox_free(before->delivered.sent);
    jox_free(before->delivered.tallies);
    run->state = before->state;
    run->neighbours = before->neighbours;
    run->tick = before->tick;
    run->scratch->heading = before->heading;
    run->lost_name_count = before->lost_name_count;
    run->notes.length = before->notes;
}
