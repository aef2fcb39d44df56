/* What of the behaviours came to nothing in a run: states that nobody entered, transitions that
   never fired, goals that nobody reached, cycles without time, distances beyond sight. It is worked
   out from counts that the machines keep (machine/counts.c), when it is asked for. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "base/pack.h"
#include "run/run.h"
#include "run/scene_machines.h"

enum { HEAD, ITEMS }; /* parts of a pack */
enum { MOST_HINTS = 20 };
static const double ALWAYS = 0.9;       /* share of the steps */
static const double SHORTEST = 20.0;    /* s, of a run in which something ought to have happened */
static const double STEPS_STAYED = 1.5; /* in a state, on average, that lasts no time */
enum { OFTEN = 100 };                   /* transitions between two states, of a cycle */

/* One machine as it is judged. */
typedef struct Judged {
    const JoScene *scene;
    const JoxMachine *machine;
    const JoxMachineCounts *counts;
    double seconds; /* that this version ran */
    bool is_over;   /* the whole of the scene's duration */
    uint64_t goals; /* bits of targets of which it was said: those below 64 */
    JoxPack *pack;
    JoHints *head;
} Judged;

static uint64_t taken_of(const Judged *j, const JoxState *from, uint32_t transition) {
    return j->counts->taken[from->first_transition + transition];
}

static const JoxStateCounts *counts_of(const Judged *j, const JoxState *state) {
    return &j->counts->states[state - j->machine->states];
}

static uint64_t times_entered(const Judged *j, uint32_t state) {
    const JoxMachine *m = j->machine;
    uint64_t times = 0;
    for (uint32_t s = 0; s < m->state_count; s++)
        for (uint32_t t = 0; t < m->states[s].transition_count; t++)
            if (m->states[s].transitions[t].to == state)
                times += taken_of(j, &m->states[s], t);
    return times;
}

/* Adds one at the place of a transition's key, or of the transition. */
static void add(const Judged *j, JoHintKind kind, const JoxState *from, const JoxTransition *t,
                const char *way_out, JoxText *text) {
    char path[300];
    JoxWritten written = {0};
    if (j->head->count < MOST_HINTS) {
        snprintf(path, sizeof path, "states.%.120s.@%.120s.when", from->name, t->id);
        const bool found =
            jox_lua_written(j->scene->lua, j->machine, path, &j->scene->scope, &written);
        JoHint *hint = jox_pack_add(j->pack, ITEMS, sizeof *hint);
        hint->kind = kind;
        hint->line = found ? written.line : t->line;
        jox_text_clean(text->data);
        jox_pack_text(j->pack, ITEMS, &hint->behaviour, j->machine->name);
        jox_pack_text(j->pack, ITEMS, &hint->file,
                      found ? written.file : jox_machine_file(j->machine, t->source));
        jox_pack_text(j->pack, ITEMS, &hint->text, text->data);
        jox_pack_text(j->pack, ITEMS, &hint->way_out, way_out);
        j->head->count++;
    }
    jox_text_free(&written.text);
    jox_text_free(text);
}

/* ---- what never happened ---- */

static bool is_place(const JoxMachine *m, int16_t target) {
    return target >= 0 && (m->targets[target].kind < JOX_TARGET_NEAREST ||
                           m->targets[target].kind == JOX_TARGET_HOME);
}

/* Whether what an instruction asks for is bound to come about as time goes on, where a behaviour
   does what it is meant to. *asks: whether it asks for anything. */
static bool is_expected(const JoxMachine *m, const JoxInstruction *in, bool *asks) {
    switch ((JoxOp)in->op) {
    case JOX_OP_INSIDE:
    case JOX_OP_NEAR:
        *asks = true;
        return is_place(m, in->op == JOX_OP_NEAR ? in->target : in->place) &&
               (in->op == JOX_OP_NEAR || in->target < 0);
    case JOX_OP_CROSSES:
    case JOX_OP_FIRST_IN:
    case JOX_OP_LASTED:
    case JOX_OP_MEMORY:
        *asks = true;
        return true;
    case JOX_OP_NOW:
        return in->arg == JOX_NOW_x || in->arg == JOX_NOW_y || in->arg == JOX_NOW_time;
    default:
        return in->op <= JOX_OP_AND && in->op != JOX_OP_NOW;
    }
}

/* Whether a transition ought to have been taken by somebody in the end. */
static bool ought_to_fire(const Judged *j, const JoxTransition *t) {
    const JoxMachine *m = j->machine;
    bool asks = false, expected = true;
    if (t->when < 0 || t->when_hook >= 0 || t->chance.kind != JOX_VALUE_UNSET)
        return false;
    const JoxExpression *e = &m->expressions[t->when];
    for (uint32_t k = 0; k < e->count && expected; k++)
        expected = is_expected(m, &e->code[k], &asks);
    return expected && asks;
}

/* The place that a state goes to and its transition waits for, or -1. */
static int16_t goal_of(const JoxMachine *m, const JoxState *state, const JoxTransition *t) {
    const JoxExpression *e = &m->expressions[t->when];
    for (uint32_t k = 0; k < e->count; k++) {
        const JoxInstruction *in = &e->code[k];
        const int16_t at = in->op == JOX_OP_NEAR ? in->target : in->place;
        for (uint32_t s = 0; s < state->steer_count; s++)
            if ((in->op == JOX_OP_NEAR || in->op == JOX_OP_INSIDE) && at >= 0 &&
                state->steer[s].target == at)
                return at;
    }
    return -1;
}

static void judge_transition(Judged *j, const JoxState *from, const JoxTransition *t) {
    const char *to = j->machine->states[t->to].name;
    const int16_t goal = goal_of(j->machine, from, t);
    JoxText text = {0};
    const uint64_t bit = goal >= 0 && goal < 64 ? (uint64_t)1 << goal : 0;
    if (goal >= 0 && j->goals & bit)
        return;
    if (goal >= 0) {
        j->goals |= bit;
        jox_text_printf(&text, "nobody in state '%s' reached '%s' in %.0f s", from->name,
                        j->machine->targets[goal].name, j->seconds);
        add(j, JO_HINT_GOAL, from, t,
            "See with --view where they stand: is there a way, and is the run long enough, or is "
            "it meant so?",
            &text);
        return;
    }
    const bool entered = times_entered(j, t->to) > 0 || j->counts->states[t->to].spent > 0;
    if (entered)
        jox_text_printf(
            &text,
            "the transition from '%s' to '%s' was never taken in %.0f s, though somebody "
            "was always in '%s'",
            from->name, to, j->seconds, from->name);
    else
        jox_text_printf(&text,
                        "nobody was ever in state '%s': in %.0f s the transition to it was never "
                        "taken, though somebody was always in '%s'",
                        to, j->seconds, from->name);
    add(j, entered ? JO_HINT_TRANSITION : JO_HINT_STATE, from, t,
        "The live page (--view) shows what its condition is made of; take it out if it is not "
        "needed",
        &text);
}

/* Where sinks take people out, they may be gone before a transition sees them arrive. */
static bool has_sink(const Judged *j) {
    const JoxExits *exits = &j->scene->world->state.exits;
    bool any = false;
    for (uint32_t e = 0; e < exits->count; e++)
        any |= exits->items[e].people > 0;
    return any;
}

static void judge_transitions(Judged *j) {
    const JoxMachine *m = j->machine;
    const double steps = j->seconds / j->scene->world->model.def.dt;
    if (!j->is_over || j->seconds < SHORTEST || j->counts->before_count || has_sink(j))
        return;
    for (uint32_t s = 0; s < m->state_count; s++) {
        const JoxState *from = &m->states[s];
        if ((double)counts_of(j, from)->steps < ALWAYS * steps)
            continue;
        for (uint32_t t = 0; t < from->transition_count; t++)
            if (taken_of(j, from, t) == 0 && ought_to_fire(j, &from->transitions[t]))
                judge_transition(j, from, &from->transitions[t]);
    }
}

/* ---- cycles without time ---- */

/* The transition by which most leave a state that lasts a step on average, and is left often; -1.
 */
static int32_t way_on(const Judged *j, uint32_t state) {
    const JoxState *from = &j->machine->states[state];
    uint64_t left = 0, most = 0;
    int32_t way = -1;
    for (uint32_t t = 0; t < from->transition_count; t++) {
        const uint64_t taken = taken_of(j, from, t);
        left += taken;
        if (taken > most) {
            most = taken;
            way = (int32_t)t;
        }
    }
    const double spent = (double)j->counts->states[state].spent;
    return left >= OFTEN && 2 * most >= left && spent <= STEPS_STAYED * (double)left ? way : -1;
}

/* Follows the ways on from a state; whether they lead back to it, by states that come after it. */
static bool goes_round(const Judged *j, uint32_t first, JoxText *text) {
    uint32_t state = first;
    jox_text_printf(text, "people went round '%s'", j->machine->states[first].name);
    for (uint32_t n = 0; n < j->machine->state_count; n++) {
        const int32_t way = way_on(j, state);
        if (way < 0)
            return false;
        state = j->machine->states[state].transitions[way].to;
        jox_text_printf(text, " -> '%s'", j->machine->states[state].name);
        if (state <= first)
            return state == first;
    }
    return false;
}

static void judge_cycles(const Judged *j) {
    for (uint32_t s = 0; s < j->machine->state_count; s++) {
        const JoxState *from = &j->machine->states[s];
        const int32_t way = way_on(j, s);
        JoxText text = {0};
        if (way < 0 || !goes_round(j, s, &text)) {
            jox_text_free(&text);
            continue;
        }
        jox_text_printf(&text, ", a state a step, %llu times",
                        (unsigned long long)taken_of(j, from, (uint32_t)way));
        add(j, JO_HINT_CYCLE, from, &from->transitions[way],
            "Let one of its conditions wait for something, as after(1)", &text);
    }
}

/* ---- sight ---- */

/* Whether the load has said it: perception is a number of the behaviour. */
static bool was_linted(const JoxMachine *m, const JoxState *state, double asked) {
    const JoxValue *value = &state->param[JOX_PARAM_perception];
    if (value->kind == JOX_VALUE_UNSET)
        value = &m->defaults[JOX_PARAM_perception];
    if (value->kind == JOX_VALUE_OWN && m->own[value->index].dist.kind == JOX_DIST_CONSTANT)
        return asked > m->own[value->index].dist.a;
    return value->kind == JOX_VALUE_CONST && asked > value->number;
}

static void judge_sight_of(const Judged *j, const JoxState *from, const JoxTransition *t) {
    const JoxMachine *m = j->machine;
    const double sight = counts_of(j, from)->sight;
    const JoxExpression *e = &m->expressions[t->when];
    for (uint32_t k = 1; k < e->count; k++) {
        const JoxInstruction *in = &e->code[k], *asked = &e->code[k - 1];
        const bool looks =
            in->op == JOX_OP_HEARD || (in->op == JOX_OP_NEAR && !is_place(m, in->target));
        if (!looks || asked->op != JOX_OP_CONST || asked->to != in->a || !(asked->number > sight) ||
            asked->number >= JOX_MOST_WEIGHT || was_linted(m, from, asked->number))
            continue;
        JoxText text = {0};
        jox_text_printf(&text,
                        "a condition of state '%s' asks for %g m, and nobody there perceived "
                        "farther than %g m",
                        from->name, asked->number, sight);
        add(j, JO_HINT_SIGHT, from, t, "Raise perception in this state, or ask for less", &text);
        return;
    }
}

static void judge_sight(const Judged *j) {
    for (uint32_t s = 0; s < j->machine->state_count; s++) {
        const JoxState *from = &j->machine->states[s];
        for (uint32_t t = 0; t < from->transition_count; t++)
            if (counts_of(j, from)->sight > 0.0 && from->transitions[t].when >= 0)
                judge_sight_of(j, from, &from->transitions[t]);
    }
}

JoHints *jo_scene_hints(const JoScene *scene) {
    JOX_REQUIRE(scene, NULL);
    JOX_GUARD (NULL, NULL)
        return NULL;
    const JoWorld *world = scene->world;
    const JoxMachineRun *machines = &world->machines;
    const double duration = scene->spec->duration, dt = world->model.def.dt;
    JoxPack pack = {0};
    JoHints *head = jox_pack_add(&pack, HEAD, sizeof *head);
    jox_pack_list(&pack, HEAD, &head->items, ITEMS);
    for (uint32_t m = 0; m < machines->set->count; m++) {
        const JoxMachineCounts *counts = &machines->state->counts[m];
        const double seconds = (double)(world->state.tick - counts->since) * dt;
        Judged j = {.scene = scene,
                    .machine = machines->set->items[m],
                    .counts = counts,
                    .seconds = seconds,
                    .is_over = seconds > duration - 1.5 * dt,
                    .pack = &pack,
                    .head = head};
        if (jox_run_made(scene->spec, j.machine->path)) /* of a journey: nobody wrote it */
            continue;
        judge_transitions(&j);
        judge_cycles(&j);
        judge_sight(&j);
    }
    return jox_disown(jox_pack_end(&pack));
}
