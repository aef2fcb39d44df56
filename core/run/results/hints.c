/* Hints at parts of behaviours that had no effect in a run: states that nobody entered, transitions
   that never fired, goals that nobody reached, cycles that take no time, distances beyond sight.
   They are derived on request from the counts that machines keep (JoxMachineCounts). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "base/result_block.h"
#include "run/run.h"
#include "run/scene_machines.h"

enum { HEAD, ITEMS }; /* parts of the pack of hints */
enum { MOST_HINTS = 20 };
static const double ALWAYS = 0.9;        /* share of the steps in which a state had people */
static const double SHORTEST_RUN = 20.0; /* s: shorter runs prove nothing about transitions */
static const double STEPS_STAYED = 1.5;  /* mean stay, steps, up to which a state takes no time */
enum { OFTEN = 100 };                    /* least departures from each state of a cycle */

/* A machine that is examined. */
typedef struct Examined {
    const JoScene *scene;
    const JoxMachine *machine;
    const JoxMachineCounts *counts;
    double seconds; /* that this version of the machine ran */
    bool is_over;   /* it ran for the whole duration of the scene */
    uint64_t goals; /* bit n: target n has a hint already; for n < 64 alone */
    JoxPack *pack;
    JoHints *head;
} Examined;

/* Returns how often agents took a transition, given by its number within its state. */
static uint64_t count_taken(const Examined *j, const JoxState *from, uint32_t transition) {
    return j->counts->taken[from->first_transition + transition];
}

static const JoxStateCounts *state_counts(const Examined *j, const JoxState *state) {
    return &j->counts->states[state - j->machine->states];
}

/* Returns how often agents went into a state by a transition. */
static uint64_t count_entered(const Examined *j, uint32_t state) {
    const JoxMachine *m = j->machine;
    uint64_t times = 0;
    for (uint32_t s = 0; s < m->state_count; s++)
        for (uint32_t t = 0; t < m->states[s].transition_count; t++)
            if (m->states[s].transitions[t].to == state && !m->states[s].transitions[t].stays)
                times += count_taken(j, &m->states[s], t);
    return times;
}

/* Adds a hint that points at the `when` of a transition, or else at the transition. Takes `text`.
 */
static void add_hint(const Examined *j, JoHintKind kind, const JoxState *from,
                     const JoxTransition *t, const char *way_out, JoxText *text) {
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

/* ---- transitions that never fired ---- */

static bool is_place(const JoxMachine *m, int16_t target) {
    return target >= 0 && !jox_target_kind_moves(m->targets[target].kind);
}

/* Returns whether the test of an instruction becomes true in time if the behaviour works as meant,
   as reaching a place does. Sets *tests if the instruction tests anything. */
static bool is_expected(const JoxMachine *m, const JoxInstruction *in, bool *tests) {
    switch ((JoxOp)in->op) {
    case JOX_OP_INSIDE:
    case JOX_OP_ARRIVED:
    case JOX_OP_NEAR:
        *tests = true;
        return is_place(m, in->op == JOX_OP_NEAR ? in->target : in->place) &&
               (in->op == JOX_OP_NEAR || in->target < 0);
    case JOX_OP_CROSSES:
    case JOX_OP_FIRST_IN:
    case JOX_OP_JOINED:
    case JOX_OP_LASTED:
    case JOX_OP_MEMORY:
        *tests = true;
        return true;
    case JOX_OP_NOW:
        return in->arg == JOX_NOW_x || in->arg == JOX_NOW_y || in->arg == JOX_NOW_time;
    default:
        return in->op <= JOX_OP_AND && in->op != JOX_OP_NOW;
    }
}

/* Returns whether somebody should have taken the transition by the end of the run. */
static bool should_have_fired(const Examined *j, const JoxTransition *t) {
    const JoxMachine *m = j->machine;
    bool tests = false, expected = true;
    if (t->when < 0 || t->when_hook >= 0 || t->chance.kind != JOX_VALUE_UNSET)
        return false;
    const JoxExpression *e = &m->expressions[t->when];
    for (uint32_t k = 0; k < e->count && expected; k++)
        expected = is_expected(m, &e->code[k], &tests);
    return expected && tests;
}

/* Returns the target that the state steers to and its transition waits for, or -1. */
static int16_t find_goal(const JoxMachine *m, const JoxState *state, const JoxTransition *t) {
    const JoxExpression *e = &m->expressions[t->when];
    for (uint32_t k = 0; k < e->count; k++) {
        const JoxInstruction *in = &e->code[k];
        const int16_t at = in->op == JOX_OP_NEAR ? in->target : in->place;
        for (uint32_t s = 0; s < state->steer_count; s++)
            if ((in->op == JOX_OP_NEAR || in->op == JOX_OP_INSIDE || in->op == JOX_OP_ARRIVED) &&
                at >= 0 && state->steer[s].target == at)
                return at;
    }
    return -1;
}

static const char WAITS[] =
    "`jostle why`, or the live page (--view), says what it waits for; take it out if it is not "
    "needed";

static void examine_transition(Examined *j, const JoxState *from, const JoxTransition *t) {
    const char *to = j->machine->states[t->to].name;
    const int16_t goal = find_goal(j->machine, from, t);
    JoxText text = {0};
    const uint64_t bit = goal >= 0 && goal < 64 ? (uint64_t)1 << goal : 0;
    if (goal >= 0 && j->goals & bit)
        return;
    if (goal >= 0) {
        j->goals |= bit;
        jox_text_printf(&text, "nobody in state '%s' reached '%s' in %.0f s", from->name,
                        j->machine->targets[goal].name, j->seconds);
        add_hint(
            j, JO_HINT_GOAL, from, t,
            "See with --view where they stand: is there a way, and is the run long enough, or is "
            "it meant so?",
            &text);
        return;
    }
    if (t->stays) {
        jox_text_printf(&text,
                        "a reaction of state '%s' was never done in %.0f s, though somebody was "
                        "always in '%s'",
                        from->name, j->seconds, from->name);
        add_hint(j, JO_HINT_TRANSITION, from, t, WAITS, &text);
        return;
    }
    const bool entered = count_entered(j, t->to) > 0 || j->counts->states[t->to].spent > 0;
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
    add_hint(j, entered ? JO_HINT_TRANSITION : JO_HINT_STATE, from, t, WAITS, &text);
}

/* Returns whether sinks removed people, maybe before a transition saw them arrive. */
static bool sinks_removed_people(const Examined *j) {
    const JoxExits *exits = &j->scene->world->state.exits;
    bool any = false;
    for (uint32_t e = 0; e < exits->count; e++)
        any |= exits->items[e].people > 0;
    return any;
}

static void examine_transitions(Examined *j) {
    const JoxMachine *m = j->machine;
    const double steps = j->seconds / j->scene->world->model.def.dt;
    if (!j->is_over || j->seconds < SHORTEST_RUN || j->counts->before_count ||
        sinks_removed_people(j))
        return;
    for (uint32_t s = 0; s < m->state_count; s++) {
        const JoxState *from = &m->states[s];
        if ((double)state_counts(j, from)->steps < ALWAYS * steps)
            continue;
        for (uint32_t t = 0; t < from->transition_count; t++)
            if (count_taken(j, from, t) == 0 && should_have_fired(j, &from->transitions[t]))
                examine_transition(j, from, &from->transitions[t]);
    }
}

/* ---- cycles without time ---- */

/* Returns the transition by which at least half of the agents leave a state, if they leave it often
   and after a step on average; else -1. */
static int32_t find_main_transition(const Examined *j, uint32_t state) {
    const JoxState *from = &j->machine->states[state];
    uint64_t left = 0, most = 0;
    int32_t main = -1;
    for (uint32_t t = 0; t < from->transition_count; t++) {
        const uint64_t taken = from->transitions[t].stays ? 0 : count_taken(j, from, t);
        left += taken;
        if (taken > most) {
            most = taken;
            main = (int32_t)t;
        }
    }
    const double spent = (double)j->counts->states[state].spent;
    return left >= OFTEN && 2 * most >= left && spent <= STEPS_STAYED * (double)left ? main : -1;
}

/* Follows the main transitions from a state. Returns whether they lead back to it through states of
   higher index, so that each cycle is found once; `text` names the states. */
static bool follow_cycle(const Examined *j, uint32_t first, JoxText *text) {
    uint32_t state = first;
    jox_text_printf(text, "people went round '%s'", j->machine->states[first].name);
    for (uint32_t n = 0; n < j->machine->state_count; n++) {
        const int32_t next = find_main_transition(j, state);
        if (next < 0)
            return false;
        state = j->machine->states[state].transitions[next].to;
        jox_text_printf(text, " -> '%s'", j->machine->states[state].name);
        if (state <= first)
            return state == first;
    }
    return false;
}

static void examine_cycles(const Examined *j) {
    for (uint32_t s = 0; s < j->machine->state_count; s++) {
        const JoxState *from = &j->machine->states[s];
        const int32_t next = find_main_transition(j, s);
        JoxText text = {0};
        if (next < 0 || !follow_cycle(j, s, &text)) {
            jox_text_free(&text);
            continue;
        }
        jox_text_printf(&text, ", a state a step, %llu times",
                        (unsigned long long)count_taken(j, from, (uint32_t)next));
        add_hint(j, JO_HINT_CYCLE, from, &from->transitions[next],
                 "Let one of its conditions wait for something, as after(1)", &text);
    }
}

/* ---- sight ---- */

/* Returns whether loading already warned of it, as perception is a number in the behaviour. */
static bool was_warned_at_load(const JoxMachine *m, const JoxState *state, double asked) {
    const JoxValue *value = &state->param[JOX_PARAM_perception];
    if (value->kind == JOX_VALUE_UNSET)
        value = &m->defaults[JOX_PARAM_perception];
    if (value->kind == JOX_VALUE_OWN && m->own[value->index].dist.kind == JOX_DIST_CONSTANT)
        return asked > m->own[value->index].dist.a;
    return value->kind == JOX_VALUE_CONST && asked > value->number;
}

static void examine_sight_of(const Examined *j, const JoxState *from, const JoxTransition *t) {
    const JoxMachine *m = j->machine;
    const double sight = state_counts(j, from)->sight;
    const JoxExpression *e = &m->expressions[t->when];
    for (uint32_t k = 1; k < e->count; k++) {
        const JoxInstruction *in = &e->code[k], *asked = &e->code[k - 1];
        const bool looks =
            in->op == JOX_OP_HEARD || (in->op == JOX_OP_NEAR && !is_place(m, in->target));
        if (!looks || asked->op != JOX_OP_CONST || asked->to != in->a || !(asked->number > sight) ||
            asked->number >= JOX_MOST_WEIGHT || was_warned_at_load(m, from, asked->number))
            continue;
        JoxText text = {0};
        jox_text_printf(&text,
                        "a condition of state '%s' asks for %g m, and nobody there perceived "
                        "farther than %g m",
                        from->name, asked->number, sight);
        add_hint(j, JO_HINT_SIGHT, from, t, "Raise perception in this state, or ask for less",
                 &text);
        return;
    }
}

static void examine_sight(const Examined *j) {
    for (uint32_t s = 0; s < j->machine->state_count; s++) {
        const JoxState *from = &j->machine->states[s];
        for (uint32_t t = 0; t < from->transition_count; t++)
            if (state_counts(j, from)->sight > 0.0 && from->transitions[t].when >= 0)
                examine_sight_of(j, from, &from->transitions[t]);
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
        Examined j = {.scene = scene,
                      .machine = machines->set->items[m],
                      .counts = counts,
                      .seconds = seconds,
                      .is_over = seconds > duration - 1.5 * dt,
                      .pack = &pack,
                      .head = head};
        if (jox_run_journey_text(scene->spec,
                                 j.machine->path)) /* made of a journey, not written by the user */
            continue;
        examine_transitions(&j);
        examine_cycles(&j);
        examine_sight(&j);
    }
    return jox_disown(jox_pack_end(&pack));
}
