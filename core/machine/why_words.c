#include "machine/why_words.h"

#include <math.h>
#include <string.h>

#include "machine/way_between.h"

static const char *const UNITS[] = {
#define X(name, word, unit, ...) unit,
    JOX_MEASURED(X)
#undef X
};

const char *jox_why_unit(const JoxInstruction *in) {
    switch ((JoxOp)in->op) {
    case JOX_OP_NOW:
    case JOX_OP_OF:
        return UNITS[in->arg];
    case JOX_OP_DISTANCE:
        return "m";
    case JOX_OP_PLACE_DENSITY:
        return "1/m2";
    default:
        return "";
    }
}

/* ---- words ---- */

static void set_measure(JoxWhyTerm *term, double value, const char *relation, double bound,
                        const char *unit) {
    term->measured = true;
    term->value = value;
    term->relation = relation;
    term->bound = bound;
    term->unit = unit;
}

/* Measures the distance from a place; `reach` is that at which its word holds, m. */
static void measure_place(const JoxMachineRun *run, uint32_t i, const JoxInstruction *in,
                          JoxWhyTerm *term) {
    const int32_t place = jox_target_place(run, i, in->place);
    if (place < 0) {
        jox_why_add_target(run, i, in->place, &term->note);
        return;
    }
    const JoxPlace *p = &run->places[place];
    JoxV2 at = jox_why_position(run, i);
    if (in->target >= 0) {
        const JoxSpot spot = jox_target_find(run, i, in->target);
        if (!jox_why_add_target(run, i, in->target, &term->note))
            return;
        at = (JoxV2){spot.x, spot.y};
    }
    const double distance = (double)jox_distance_to_place(run, (uint32_t)place, at);
    const double reach = jox_place_is_spot(p)    ? (double)p->radius
                         : jox_place_is_queue(p) ? (double)p->spacing / 2.0
                         : jox_place_is_line(p)  ? 0.5
                                                 : 0.0;
    set_measure(term, distance, "<=", reach, "m");
    if (jox_place_contains(run->places, (uint32_t)place, at) &&
        !jox_place_is_reached(run->places, (uint32_t)place, run->walls, at))
        jox_text_add(&term->note, "a wall is between");
    else if (in->target < 0)
        jox_why_add_target(run, i, in->place, &term->note);
}

static void measure_nearness(const JoxMachineRun *run, uint32_t i, const JoxInstruction *in,
                             double a, JoxWhyTerm *term) {
    const int32_t place = jox_target_place(run, i, in->target);
    const double distance = (double)jox_target_distance(run, i, in->target);
    const bool found = jox_why_add_target(run, i, in->target, &term->note);
    if (found)
        set_measure(term, distance, "<", a, "m");
    if (place >= 0 && distance < a &&
        !jox_place_is_near(run->places, (uint32_t)place, run->walls, jox_why_position(run, i), a))
        jox_text_printf(&term->note, "%sa wall is between", term->note.length ? ", " : "");
}

/* Says on which side of a line an agent is. */
static void say_side(const JoxMachineRun *run, uint32_t i, const JoxInstruction *in,
                     JoxWhyTerm *term) {
    const int32_t place = jox_target_place(run, i, in->place);
    if (place < 0) {
        jox_why_add_target(run, i, in->place, &term->note);
        return;
    }
    const JoxPlace *line = &run->places[place];
    if (!jox_place_is_line(line))
        return;
    const JoxV2 at = jox_why_position(run, i), along = jox_sub(line->points[1], line->points[0]);
    const bool left = jox_det(along, jox_sub(at, line->points[0])) > 0.0f;
    jox_text_printf(&term->note, "%.3g m away, on its %s; a crossing counts from right to left",
                    (double)jox_distance_to_place(run, (uint32_t)place, at),
                    left ? "left" : "right");
}

/* Says when something that is done every so many seconds is next due. */
static void say_next(double time, double every, JoxText *out) {
    if (every > 0.0)
        jox_text_printf(out, "%.4g s in the state, next at %.4g s", time,
                        (floor(time / every + 1e-9) + 1.0) * every);
}

/* Says where the machine is that the outer state on a level runs. */
static void say_end(const JoxMachine *machine, const JoxState *state, uint32_t level,
                    JoxText *out) {
    if (level < state->depth)
        jox_text_printf(out, "what %s runs goes on, in %s",
                        machine->outer[state->around[level]].name, state->name);
}

static void say_queue(const JoxMachineRun *run, uint32_t i, JoxText *out) {
    const uint32_t rank = run->scratch->rank[i];
    if (rank == UINT32_MAX)
        jox_text_add(out, "it does not queue");
    else if (run->agents->queued[i] == JOX_NO_TURN)
        jox_text_add(out, "it has not come to the queue yet");
    else
        jox_text_printf(out, "it is number %u in the queue", rank + 1);
}

/* Says what an agent carries or holds on to. */
static void say_holding(const JoxMachineRun *run, uint32_t i, JoxText *out) {
    const uint32_t grasped = run->agents->grasped[i];
    for (uint32_t o = 0; run->objects && o < run->objects->count; o++) {
        const JoxObject *object = &run->objects->rows[o];
        if (object->live && object->held && object->holder == run->agents->id[i]) {
            jox_text_add(out, "it carries ");
            jox_why_add_somebody(run, JOX_NO_INDEX, (int32_t)o, out);
            return;
        }
    }
    if (grasped)
        jox_text_printf(out, "it holds on to agent %u", grasped - 1);
    else
        jox_text_add(out, "it holds nothing");
}

void jox_why_measure(const JoxMachineRun *run, uint32_t i, const JoxInstruction *in, double a,
                     JoxWhyTerm *term) {
    const JoxAgents *agents = run->agents;
    const JoxMachine *machine = jox_machine_of(run, i);
    JoxSpot spot;
    switch ((JoxOp)in->op) {
    case JOX_OP_AFTER:
        set_measure(term, jox_time_in_state(run, i), ">=", a, "s");
        break;
    case JOX_OP_LASTED:
        set_measure(term, jox_time_in_state(run, i), ">=", (double)agents->lasts[i], "s");
        break;
    case JOX_OP_OUTER_AFTER:
        set_measure(term, jox_time_since(run, i, (uint32_t)in->arg), ">=", a, "s");
        break;
    case JOX_OP_OUTER_LASTED:
        set_measure(term, jox_time_since(run, i, (uint32_t)in->arg),
                    ">=", agents->memory[(size_t)i * agents->memory_stride + (uint32_t)in->number],
                    "s");
        break;
    case JOX_OP_STUCK:
        set_measure(term, (double)agents->still[i], ">=", a, "s");
        jox_text_add(&term->note, "time without moving 0.25 m");
        break;
    case JOX_OP_INSIDE:
    case JOX_OP_ARRIVED:
        measure_place(run, i, in, term);
        break;
    case JOX_OP_NEAR:
        measure_nearness(run, i, in, a, term);
        break;
    case JOX_OP_CROSSES:
        say_side(run, i, in, term);
        break;
    case JOX_OP_TOUCHES:
        spot = jox_target_find(run, i, in->target);
        if (jox_why_add_target(run, i, in->target, &term->note))
            set_measure(term, (double)jox_spot_gap(run, i, &spot), "<", 0.05, "m");
        break;
    case JOX_OP_FIRST_IN:
    case JOX_OP_JOINED:
        say_queue(run, i, &term->note);
        break;
    case JOX_OP_HEARD:
        jox_why_add_call(run, i, machine->names[in->name].number, a, &term->note);
        break;
    case JOX_OP_TOLD:
        jox_why_add_told(run, i, machine->names[in->name].number, &term->note);
        break;
    case JOX_OP_EVERY:
        term->beats = true;
        say_next(jox_time_in_state(run, i), a, &term->note);
        break;
    case JOX_OP_OUTER_EVERY:
        term->beats = true;
        say_next(jox_time_since(run, i, (uint32_t)in->arg), a, &term->note);
        break;
    case JOX_OP_DONE:
        say_end(machine, &machine->states[agents->state[i]], (uint32_t)in->arg, &term->note);
        break;
    case JOX_OP_LIST_HAS:
        jox_text_printf(&term->note, "mine.%s is ", machine->memory[in->arg].name);
        jox_memory_print(run, machine, agents->memory + (size_t)i * agents->memory_stride,
                         (uint32_t)in->arg, &term->note);
        jox_why_add_identity(run, i, in->target, &term->note);
        break;
    case JOX_OP_HAS:
        say_holding(run, i, &term->note);
        break;
    case JOX_OP_EXISTS:
    case JOX_OP_SAME:
        jox_why_add_identity(run, i, in->target, &term->note);
        jox_why_add_identity(run, i, in->place, &term->note);
        break;
    case JOX_OP_GROUNDED:
    case JOX_OP_KICKED:
    case JOX_OP_HIT_BY:
    case JOX_OP_INCOMING:
    case JOX_OP_SEES:
        jox_why_add_target(run, i, in->target, &term->note);
        break;
    default:
        break;
    }
}
