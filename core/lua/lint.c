/* Warns of parts of a machine that have no effect: states that cannot be reached or left,
   transitions that never fire, distances beyond perception, fields of `me` that memory hides. The
   machine runs all the same. Called by build.c. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "lua/language/vocabulary.h"
#include "lua/read_table.h"

/* Adds a warning, or an error, unless another use of the same machine has given it. */
static void add_finding(JoxBuild *b, JoxSeverity severity, JoxPosition at, const char *code,
                        const char *hint, const char *text) {
    if (!jox_diag_lists(b->script->diagnostics, at, code, text))
        jox_diag_add(b->script->diagnostics, severity, at, code, hint, NULL, NULL, "%s", text);
}

static void add_warning(JoxBuild *b, const char *path, const char *code, const char *hint,
                        const char *text) {
    add_finding(b, JOX_SEVERITY_WARNING, jox_read_at(b, path), code, hint, text);
}

/* Returns the name of a state in the machine that has it, as its file writes it. */
static const char *get_written_name(const JoxState *state) {
    const char *dot = state->depth ? strrchr(state->name, '.') : NULL;
    return dot ? dot + 1 : state->name;
}

/* ---- states ---- */

/* Marks the states that can be reached by transitions from a state. */
static void mark_reachable(const JoxMachine *m, uint32_t from, bool *reached) {
    uint32_t open[1000], count = 0;
    JOX_ASSERT(m->state_count <= 1000);
    reached[from] = true;
    open[count++] = from;
    while (count > 0) {
        const JoxState *state = &m->states[open[--count]];
        for (uint32_t t = 0; t < state->transition_count; t++)
            if (!reached[state->transitions[t].to]) {
                reached[state->transitions[t].to] = true;
                open[count++] = state->transitions[t].to;
            }
    }
}

/* Returns whether no state within an outer state is reached. */
static bool is_outer_unreached(const JoxMachine *m, const bool *reached, uint32_t outer) {
    const uint32_t level = m->outer[outer].depth;
    for (uint32_t s = 0; s < m->state_count; s++)
        if (m->states[s].depth > level && m->states[s].around[level] == outer && reached[s])
            return false;
    return true;
}

/* Returns the outermost state around an unreached one of which nothing is reached, or itself. */
static const JoxState *find_unreached(const JoxMachine *m, const bool *reached, uint32_t state) {
    const JoxState *is = &m->states[state];
    for (uint32_t l = 0; l < is->depth; l++)
        if (is_outer_unreached(m, reached, is->around[l]))
            return &m->outer[is->around[l]];
    return is;
}

/* Returns whether an unreached state is told of with an earlier one, by the same outer state. */
static bool is_told_with_outer(const JoxMachine *m, const bool *reached, uint32_t state) {
    const JoxState *told = find_unreached(m, reached, state);
    return told != &m->states[state] &&
           jox_first_state_within(m, (uint32_t)(told - m->outer)) != &m->states[state];
}

/* Warns of states that cannot be reached. In a patch that is an error if the name looks misspelt.
 */
static void check_reachable(JoxBuild *b) {
    const JoxMachine *m = b->machine;
    bool reached[1000] = {false};
    mark_reachable(m, m->start, reached);
    for (uint32_t s = 0; s < m->state_count; s++) {
        if (reached[s] || is_told_with_outer(m, reached, s))
            continue;
        char path[256], hint[JOX_HINT], text[160];
        const char *names[64], *near = NULL;
        size_t count = 0;
        const JoxState *state = find_unreached(m, reached, s);
        jox_state_path(state, path);
        const JoxPatchChange *origin = jox_patch_leading(&b->script->changes, path);
        bool added = origin && origin->mod >= 0 && strcmp(origin->path, path) == 0;
        for (uint32_t o = 0; added && o < m->state_count && count < 64; o++)
            if (o != s)
                names[count++] = m->states[o].name;
        near = jox_did_you_mean(state->name, names, count, hint);
        snprintf(text, sizeof text, "nothing leads to state '%.100s'", get_written_name(state));
        add_finding(b, near ? JOX_SEVERITY_ERROR : JOX_SEVERITY_WARNING, jox_read_at(b, path),
                    "unreachable-state", near, text);
    }
}

static bool has_way_out(const JoxState *state) {
    for (uint32_t t = 0; t < state->transition_count; t++)
        if (!state->transitions[t].stays)
            return true;
    return false;
}

/* Warns of states that no transition leaves: agents would stay in them for ever. */
static void check_exits(JoxBuild *b) {
    const JoxMachine *m = b->machine;
    for (uint32_t s = 0; s < m->state_count && m->state_count > 1; s++) {
        const JoxState *state = &m->states[s];
        bool stands = state->steer_count == 1 && (state->steer[0].kind == JOX_STEER_HOLD ||
                                                  state->steer[0].kind == JOX_STEER_GATHER);
        char path[256], text[160];
        jox_state_path(state, path);
        snprintf(text, sizeof text, "no transition leads out of state '%.100s'",
                 get_written_name(state));
        if (!has_way_out(state) && !state->removes && !state->become && !stands &&
            !(state->ends && state->depth == 0))
            add_warning(b, path, "no-way-out",
                        "Add a transition, or `removes = true`; a state with `steer = hold` may be "
                        "the end",
                        text);
    }
}

/* ---- transitions ---- */

/* Returns whether a transition is taken in any case. */
static bool is_unconditional(const JoxTransition *t) {
    return !t->stays && t->when < 0 && t->when_hook < 0 && t->chance.kind == JOX_VALUE_UNSET;
}

/* Returns the first operation `op` of a condition; NULL if it has none. */
static const JoxInstruction *find_operation(const JoxMachine *m, int32_t expression, JoxOp op) {
    const JoxExpression *e = expression < 0 ? NULL : &m->expressions[expression];
    for (uint32_t k = 0; e && k < e->count; k++)
        if (e->code[k].op == op)
            return &e->code[k];
    return NULL;
}

/* Returns operation `op` of a condition that requires it: it is joined to the rest by & alone. */
static const JoxInstruction *find_required(const JoxMachine *m, int32_t expression, JoxOp op) {
    return find_operation(m, expression, JOX_OP_OR) || find_operation(m, expression, JOX_OP_NOT)
               ? NULL
               : find_operation(m, expression, op);
}

/* Warns of transitions that never fire. Those of the outer states around are checked there. */
static void check_firing(JoxBuild *b, const JoxState *state) {
    const JoxMachine *m = b->machine;
    char full[256];
    for (uint32_t t = 0; t < state->transition_count; t++) {
        const JoxTransition *taken = &state->transitions[t];
        if (taken->level < state->depth)
            continue;
        jox_read_item_path(m, state, taken, full);
        const bool known = b->script->diagnostics->errors == 0; /* else a `when` may be missing */
        if (t > 0 && known && is_unconditional(&state->transitions[t - 1])) {
            add_warning(b, full, "never-fires", "Put it before that one",
                        "this transition never fires: the one before it is always taken");
            return;
        }
        if (!state->has_lasts && state->lasts_expression < 0 &&
            (find_required(m, taken->when, JOX_OP_LASTED) ||
             find_required(m, taken->when, JOX_OP_OUTER_LASTED)))
            add_warning(b, full, "never-fires", "Give the state one: lasts = 5, or write after(5)",
                        "this transition never fires: the state has no `lasts`");
        for (uint32_t o = 0; o < t; o++)
            if (state->transitions[o].when == taken->when && taken->when >= 0 &&
                !state->transitions[o].stays && !taken->stays &&
                state->transitions[o].chance.kind == JOX_VALUE_UNSET) {
                add_warning(b, full, "never-fires", NULL,
                            "this transition never fires: one before it has the same condition");
                break;
            }
    }
}

/* Returns whether an agent in a state may steer by a term, to the place that a target means; -1:
   any. */
static bool may_steer(const JoxMachine *m, const JoxState *state, JoxSteerKind kind,
                      int16_t place) {
    for (uint32_t t = 0; t < state->steer_count; t++) {
        const JoxSteerTerm *term = &state->steer[t];
        if (term->kind != kind && term->kind != JOX_STEER_FUNCTION)
            continue;
        if (term->kind == JOX_STEER_FUNCTION || term->target < 0 || place < 0 ||
            m->targets[term->target].kind != JOX_TARGET_PLACE ||
            m->targets[place].kind != JOX_TARGET_PLACE || term->target == place)
            return true;
    }
    return false;
}

/* Warns of transitions that wait for a queue or a lift by which the agents of the state do not
   steer. */
static void check_waits(JoxBuild *b, const JoxState *state) {
    static const struct {
        JoxOp op;
        JoxSteerKind steer;
        const char *word, *lacks, *hint;
    } ASKS[] = {
        {JOX_OP_FIRST_IN, JOX_STEER_QUEUE, "first_in", "queue", "Let it: steer = queue(place)"},
        {JOX_OP_JOINED, JOX_STEER_QUEUE, "joined", "queue", "Let it: steer = queue(place)"},
        {JOX_OP_RODE, JOX_STEER_RIDE, "rode", "ride", "Let it: steer = ride \"LIFT.STOREY\""}};
    const JoxMachine *m = b->machine;
    char item[256], full[256], text[160];
    if (b->script->diagnostics->errors > 0) /* a term that is wrong is missing */
        return;
    for (uint32_t t = 0; t < state->transition_count; t++)
        for (size_t k = 0; k < sizeof ASKS / sizeof *ASKS; k++) {
            const JoxTransition *taken = &state->transitions[t];
            const JoxInstruction *in = find_required(m, taken->when, ASKS[k].op);
            if (!in || taken->level < state->depth || may_steer(m, state, ASKS[k].steer, in->place))
                continue;
            jox_read_item_path(m, state, taken, item);
            jox_read_join(full, item, "when");
            snprintf(text, sizeof text,
                     "`%s` never holds here: the agent does not %s in this state", ASKS[k].word,
                     ASKS[k].lacks);
            add_warning(b, full, "never-fires", ASKS[k].hint, text);
        }
}

/* Returns whether the machine that an outer state runs can end. */
static bool can_end(const JoxMachine *m, uint32_t outer) {
    const uint32_t level = m->outer[outer].depth;
    for (uint32_t s = 0; s < m->state_count; s++)
        if (m->states[s].depth > level && m->states[s].around[level] == outer &&
            (m->states[s].done >> level & 1))
            return true;
    return false;
}

/* Warns of `done` in a state that runs a machine which never ends. */
static void check_done(JoxBuild *b, uint32_t outer) {
    const JoxMachine *m = b->machine;
    const JoxState *state = &m->outer[outer];
    char item[256], full[256], text[160];
    for (uint32_t t = 0; t < state->transition_count && !can_end(m, outer); t++) {
        if (!find_operation(m, state->transitions[t].when, JOX_OP_DONE))
            continue;
        jox_read_item_path(m, state, &state->transitions[t], item);
        jox_read_join(full, item, "when");
        snprintf(text, sizeof text,
                 "`done` never holds here: no state of the machine that '%.80s' runs ends it",
                 get_written_name(state));
        add_warning(b, full, "never-fires", "Mark the state in which it ends: ends = true", text);
    }
}

/* Warns of two states that lead to each other in every step. */
static void check_cycle(JoxBuild *b, const JoxState *state, const char *path) {
    const JoxMachine *m = b->machine;
    if (state->transition_count == 0 || !is_unconditional(&state->transitions[0]))
        return;
    const JoxState *next = &m->states[state->transitions[0].to];
    if (next != state && next->transition_count && is_unconditional(&next->transitions[0]) &&
        &m->states[next->transitions[0].to] == state && next > state)
        add_warning(b, path, "no-time", "Give one of them a condition, as after(1)",
                    "two states lead to each other in every step, as neither waits for anything");
}

/* ---- distances ---- */

/* Returns the perception of agents in a state, m, if the behaviour fixes one; else infinity. */
static double get_perception(const JoxMachine *m, const JoxState *state) {
    const JoxValue *value = &state->param[JOX_PARAM_perception];
    if (value->kind == JOX_VALUE_UNSET)
        value = &m->defaults[JOX_PARAM_perception];
    if (value->kind == JOX_VALUE_CONST)
        return value->number;
    const JoxDist *dist = value->kind == JOX_VALUE_OWN ? &m->own[value->index].dist : NULL;
    return dist && dist->kind == JOX_DIST_CONSTANT ? dist->a : JOX_MOST_WEIGHT;
}

/* Warns of a condition on a distance beyond perception, which holds for everything that is seen. */
static void check_distances(JoxBuild *b, const JoxState *state) {
    const JoxMachine *m = b->machine;
    const double most = get_perception(m, state);
    char full[256], text[160];
    for (uint32_t t = 0; t < state->transition_count; t++) {
        if (state->transitions[t].when < 0 || state->transitions[t].level < state->depth)
            continue;
        const JoxExpression *e = &m->expressions[state->transitions[t].when];
        for (uint32_t k = 1; k < e->count; k++) {
            const JoxInstruction *in = &e->code[k], *asked = &e->code[k - 1];
            if ((in->op != JOX_OP_NEAR && in->op != JOX_OP_HEARD) || asked->op != JOX_OP_CONST ||
                !(asked->number > most && asked->number < JOX_MOST_WEIGHT))
                continue;
            if (in->op == JOX_OP_NEAR && !jox_target_kind_moves(m->targets[in->target].kind))
                continue;
            jox_read_item_path(m, state, &state->transitions[t], full);
            snprintf(text, sizeof text,
                     "nobody is seen or heard as far as %g m: perception is %g m", asked->number,
                     most);
            add_warning(b, full, "out-of-sight", "Raise perception in this state, or ask for less",
                        text);
        }
    }
}

/* ---- memory ---- */

/* Returns what a field of `me` means; NULL if there is none of this name. */
static const char *find_field_meaning(const char *name) {
    for (size_t k = 0; k < jox_me_key_count; k++)
        if (strcmp(jox_me_keys[k].name, name) == 0)
            return jox_me_keys[k].meaning;
    const int p = jox_parameter_find(name);
    return p < 0 ? NULL : jox_parameters[p].meaning;
}

/* Warns of memory with the name of a field of `me`, which functions cannot read. */
static void check_hidden_fields(JoxBuild *b) {
    const JoxScript *script = b->script;
    for (uint32_t s = 0; script->hook_count && s < script->memory_count; s++) {
        const char *name = script->memory[s].name, *meaning = find_field_meaning(name);
        char text[200], hint[120];
        if (!meaning)
            continue;
        snprintf(text, sizeof text, "in functions memory '%.60s' hides me.%.60s: %.*s", name, name,
                 (int)strcspn(meaning, ";:."), meaning);
        snprintf(hint, sizeof hint, "Give it another name, as my_%.60s", name);
        add_finding(b, JOX_SEVERITY_WARNING, script->memory_at[s], "hidden-field", hint, text);
    }
}

void jox_lint(JoxBuild *b) {
    check_reachable(b);
    check_exits(b);
    check_hidden_fields(b);
    jox_lint_memory(b);
    for (uint32_t o = 0; o < b->machine->outer_count; o++) {
        check_firing(b, &b->machine->outer[o]);
        check_done(b, o);
        check_distances(b, &b->machine->outer[o]);
    }
    for (uint32_t s = 0; s < b->machine->state_count; s++) {
        const JoxState *state = &b->machine->states[s];
        char path[256];
        jox_state_path(state, path);
        check_firing(b, state);
        check_waits(b, state);
        check_cycle(b, state, path);
        check_distances(b, state);
    }
}
