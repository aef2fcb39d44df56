/* What of a machine can be known to be of no use: states that nobody gets to or out of, transitions
   that never fire, targets farther than is seen. Warnings: the machine runs. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "lua/read.h"

static void warn(JoxBuild *b, const char *path, const char *code, const char *hint,
                 const char *text) {
    jox_diag_add(b->script->diagnostics, JOX_SEVERITY_WARNING, jox_read_at(b, path), code, hint,
                 NULL, NULL, "%s", text);
}

/* ---- states ---- */

/* Marks what transitions lead to from a state on. */
static void reach(const JoxMachine *m, uint32_t from, bool *reached) {
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

/* States that nothing leads to: a warning, in a patch an error, for there it is a misspelt name. */
static void judge_states(JoxBuild *b) {
    const JoxMachine *m = b->machine;
    bool reached[1000] = {false};
    reach(m, m->start, reached);
    for (uint32_t s = 0; s < m->state_count; s++) {
        if (reached[s])
            continue;
        char path[256], hint[JOX_HINT];
        const char *names[64], *near = NULL;
        size_t count = 0;
        jox_read_join(path, "states", m->states[s].name);
        const JoxPatchChange *origin = jox_patch_leading(&b->script->changes, path);
        bool added = origin && origin->mod >= 0 && strcmp(origin->path, path) == 0;
        for (uint32_t o = 0; added && o < m->state_count && count < 64; o++)
            if (o != s)
                names[count++] = m->states[o].name;
        near = jox_did_you_mean(m->states[s].name, names, count, hint);
        jox_diag_add(b->script->diagnostics, near ? JOX_SEVERITY_ERROR : JOX_SEVERITY_WARNING,
                     jox_read_at(b, path), "unreachable-state", near, NULL, NULL,
                     "nothing leads to state '%s'", m->states[s].name);
    }
}

/* Warns of states that no transition leaves: agents would stay in them for ever. */
static void judge_ends(JoxBuild *b) {
    const JoxMachine *m = b->machine;
    for (uint32_t s = 0; s < m->state_count && m->state_count > 1; s++) {
        const JoxState *state = &m->states[s];
        bool stands = state->steer_count == 1 && state->steer[0].kind == JOX_STEER_HOLD;
        char path[256];
        jox_read_join(path, "states", state->name);
        if (state->transition_count == 0 && !state->removes && !state->become && !stands)
            jox_diag_add(
                b->script->diagnostics, JOX_SEVERITY_WARNING, jox_read_at(b, path), "no-way-out",
                "Add a transition, or `removes = true`; a state with `steer = hold` may be "
                "the end",
                NULL, NULL, "no transition leads out of state '%s'", state->name);
    }
}

/* ---- transitions ---- */

static bool is_certain(const JoxTransition *t) {
    return t->when < 0 && t->when_hook < 0 && t->chance.kind == JOX_VALUE_UNSET;
}

/* Whether a condition can hold only where `op` does: it is joined to the rest by & alone. */
static bool needs(const JoxMachine *m, int32_t expression, JoxOp op) {
    bool found = false;
    if (expression < 0)
        return false;
    const JoxExpression *e = &m->expressions[expression];
    for (uint32_t k = 0; k < e->count; k++) {
        if (e->code[k].op == JOX_OP_OR || e->code[k].op == JOX_OP_NOT)
            return false;
        found |= e->code[k].op == op;
    }
    return found;
}

static void judge_transitions(JoxBuild *b, const JoxState *state, const char *path) {
    const JoxMachine *m = b->machine;
    char full[256], item[160];
    for (uint32_t t = 0; t < state->transition_count; t++) {
        const JoxTransition *taken = &state->transitions[t];
        snprintf(item, sizeof item, "%u", t + 1);
        jox_read_join(full, path, item);
        if (t > 0 && is_certain(&state->transitions[t - 1])) {
            warn(b, full, "never-fires", "Put it before that one",
                 "this transition never fires: the one before it is always taken");
            return;
        }
        if (!state->has_lasts && state->lasts_expression < 0 &&
            needs(m, taken->when, JOX_OP_LASTED))
            warn(b, full, "never-fires", "Give the state one: lasts = 5, or write after(5)",
                 "this transition never fires: the state has no `lasts`");
        for (uint32_t o = 0; o < t; o++)
            if (state->transitions[o].when == taken->when && taken->when >= 0 &&
                state->transitions[o].chance.kind == JOX_VALUE_UNSET) {
                warn(b, full, "never-fires", NULL,
                     "this transition never fires: one before it has the same condition");
                break;
            }
    }
}

/* Two states that lead to each other at once: nobody is in either for longer than a step. */
static void judge_cycle(JoxBuild *b, const JoxState *state, const char *path) {
    const JoxMachine *m = b->machine;
    if (state->transition_count == 0 || !is_certain(&state->transitions[0]))
        return;
    const JoxState *next = &m->states[state->transitions[0].to];
    if (next != state && next->transition_count && is_certain(&next->transitions[0]) &&
        &m->states[next->transitions[0].to] == state && next > state)
        warn(b, path, "no-time", "Give one of them a condition, as after(1)",
             "two states lead to each other in every step, as neither waits for anything");
}

/* ---- distances ---- */

/* How far people in a state see, m, where it is the same for all by the behaviour; else infinite.
 */
static double sight(const JoxMachine *m, const JoxState *state) {
    const JoxValue *value = &state->param[JOX_PARAM_perception];
    if (value->kind == JOX_VALUE_UNSET)
        value = &m->defaults[JOX_PARAM_perception];
    if (value->kind == JOX_VALUE_CONST)
        return value->number;
    const JoxDist *dist = value->kind == JOX_VALUE_OWN ? &m->own[value->index].dist : NULL;
    return dist && dist->kind == JOX_DIST_CONSTANT ? dist->a : JOX_MOST_WEIGHT;
}

/* Whether a condition asks whether somebody is nearer than people see: true of all who are seen. */
static void judge_sight(JoxBuild *b, const JoxState *state, const char *path) {
    const JoxMachine *m = b->machine;
    const double most = sight(m, state);
    char full[256], item[160], text[160];
    for (uint32_t t = 0; t < state->transition_count; t++) {
        if (state->transitions[t].when < 0)
            continue;
        const JoxExpression *e = &m->expressions[state->transitions[t].when];
        for (uint32_t k = 1; k < e->count; k++) {
            const JoxInstruction *in = &e->code[k], *asked = &e->code[k - 1];
            if ((in->op != JOX_OP_NEAR && in->op != JOX_OP_HEARD) || asked->op != JOX_OP_CONST ||
                !(asked->number > most && asked->number < JOX_MOST_WEIGHT))
                continue;
            if (in->op == JOX_OP_NEAR && (m->targets[in->target].kind < JOX_TARGET_NEAREST ||
                                          m->targets[in->target].kind == JOX_TARGET_HOME))
                continue;
            snprintf(item, sizeof item, "%u", t + 1);
            jox_read_join(full, path, item);
            snprintf(text, sizeof text,
                     "nobody is seen or heard as far as %g m: perception is %g m", asked->number,
                     most);
            warn(b, full, "out-of-sight", "Raise perception in this state, or ask for less", text);
        }
    }
}

void jox_lint(JoxBuild *b) {
    judge_states(b);
    judge_ends(b);
    for (uint32_t s = 0; s < b->machine->state_count; s++) {
        const JoxState *state = &b->machine->states[s];
        char path[256];
        jox_read_join(path, "states", state->name);
        judge_transitions(b, state, path);
        judge_cycle(b, state, path);
        judge_sight(b, state, path);
    }
}
