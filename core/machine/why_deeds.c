/* Tells where the steering of an agent's state leads, and why its actions do not work. run/why/
   calls it. */
#include "machine/lifts.h"
#include "machine/obstacles.h"
#include "machine/why_words.h"

/* Words of steering by kind. */
static const char *const STEERING[] = {
    [JOX_STEER_HOLD] = "hold",           [JOX_STEER_SEEK] = "seek",
    [JOX_STEER_AWAY_FROM] = "away_from", [JOX_STEER_DODGE] = "dodge",
    [JOX_STEER_ORBIT] = "orbit",         [JOX_STEER_QUEUE] = "queue",
    [JOX_STEER_FOLLOW] = "follow",       [JOX_STEER_DRIFT] = "drift",
    [JOX_STEER_SPREAD] = "spread",       [JOX_STEER_EVADE] = "evade",
    [JOX_STEER_ALONG] = "along",         [JOX_STEER_FIELD] = "field",
    [JOX_STEER_TOGETHER] = "together",   [JOX_STEER_WANDER] = "wander",
    [JOX_STEER_FORMATION] = "formation", [JOX_STEER_GATHER] = "gather",
    [JOX_STEER_RIDE] = "ride",           [JOX_STEER_PLAYER] = "player",
    [JOX_STEER_FUNCTION] = "a function",
};

/* Appends where a target is; returns whether it is found. */
static bool add_found(const JoxMachineRun *run, uint32_t i, int16_t index, JoxText *out) {
    const JoxSpot spot = jox_target_find(run, i, index);
    const size_t begun = out->length;
    jox_why_add_target(run, i, index, out);
    if (spot.found && out->length == begun)
        jox_text_printf(
            out, "%.2f m away",
            (double)jox_length(jox_sub(jox_v2(spot.x, spot.y), jox_why_position(run, i))));
    return spot.found;
}

/* Appends a term of steering: "field(mine.who)". */
static void spell_term(const JoxMachine *machine, const JoxSteerTerm *term, JoxText *out) {
    const bool spread = term->kind == JOX_STEER_GATHER && term->args[1] != 0.0;
    jox_text_add(out, spread ? "spread_over" : STEERING[term->kind]);
    if (term->target < 0)
        return;
    jox_text_add(out, "(");
    jox_spell_target(machine, &machine->targets[term->target], out);
    jox_text_add(out, ")");
}

void jox_why_spell_steering(const JoxMachine *machine, const JoxState *state, JoxText *out) {
    for (uint32_t t = 0; t < state->steer_count; t++) {
        jox_text_add(out, t ? " + " : "");
        spell_term(machine, &state->steer[t], out);
    }
}

/* Appends the line of the steering, if it has a target; returns whether a target is not found. */
static bool add_steering(const JoxMachineRun *run, uint32_t i, const JoxState *state,
                         JoxText *out) {
    uint32_t targets = 0, lost = 0;
    for (uint32_t t = 0; t < state->steer_count; t++)
        targets += state->steer[t].target >= 0;
    for (uint32_t t = 0; targets && t < state->steer_count; t++) {
        const JoxSteerTerm *term = &state->steer[t];
        jox_text_add(out, t ? "; " : "steering: ");
        spell_term(jox_machine_of(run, i), term, out);
        if (term->target < 0)
            continue;
        jox_text_add(out, ": ");
        lost += !add_found(run, i, term->target, out);
    }
    if (lost && lost == state->steer_count)
        jox_text_add(out, "; so it stands");
    if (targets)
        jox_text_add(out, "\n");
    return lost > 0;
}

/* Appends the line of an action that something keeps from its target, m: greatest gap; returns
   whether something does. */
static bool add_obstacle(const JoxMachineRun *run, uint32_t i, const char *word, int16_t target,
                         JoxObstacle obstacle, float gap, float reach, JoxText *out) {
    if (obstacle == JOX_OBSTACLE_NONE)
        return false;
    const JoxMachine *machine = jox_machine_of(run, i);
    jox_text_printf(out, "%s ", word);
    jox_spell_target(machine, &machine->targets[target], out);
    jox_text_add(out, ": ");
    add_found(run, i, target, out);
    switch (obstacle) {
    case JOX_OBSTACLE_KIND:
        jox_text_add(out,
                     reach == JOX_GRASP_REACH ? ", which is no other agent" : ", which is no body");
        break;
    case JOX_OBSTACLE_FIXED:
        jox_text_add(out, ", which is fixed");
        break;
    case JOX_OBSTACLE_HELD:
        jox_text_add(out, ", which somebody holds");
        break;
    case JOX_OBSTACLE_FAR:
        jox_text_printf(out, ": a gap of %.3g m, reach %.2g m", (double)gap, (double)reach);
        break;
    case JOX_OBSTACLE_HIGH:
        jox_text_add(out, ", too high");
        break;
    case JOX_OBSTACLE_FAST:
        jox_text_printf(out, ", too fast: not below %g m/s", (double)JOX_CATCHABLE);
        break;
    case JOX_OBSTACLE_BLOCKED:
        jox_text_add(out, ", behind a wall or a fixed body");
        break;
    case JOX_OBSTACLE_ABSENT:
    case JOX_OBSTACLE_NONE:
        break;
    }
    jox_text_add(out, "\n");
    return true;
}

/* Appends the line of a throw that has no body, or no target. */
static bool add_throw(const JoxMachineRun *run, uint32_t i, const JoxState *state, JoxText *out) {
    const JoxMachine *machine = jox_machine_of(run, i);
    const bool holds = jox_held_body_row(run, i, state->toss) >= 0;
    if (holds && jox_target_find(run, i, state->toss_at).found)
        return false;
    jox_text_add(out, "throw ");
    jox_spell_target(machine, &machine->targets[state->toss], out);
    if (holds) {
        jox_text_add(out, " at ");
        jox_spell_target(machine, &machine->targets[state->toss_at], out);
        jox_text_add(out, ": ");
        add_found(run, i, state->toss_at, out);
    } else {
        jox_text_add(out, ": it does not hold it");
    }
    jox_text_add(out, "\n");
    return true;
}

/* Appends the lines of actions on bodies and agents that do not work. */
static bool add_actions(const JoxMachineRun *run, uint32_t i, const JoxState *state, JoxText *out) {
    bool fails = false;
    JoxSpot spot;
    if (state->take >= 0 && jox_held_body_row(run, i, state->take) < 0) {
        const JoxObstacle obstacle = jox_find_take_obstacle(run, state, i, &spot);
        fails |= add_obstacle(run, i, "take", state->take, obstacle, jox_spot_gap(run, i, &spot),
                              JOX_TAKE_REACH, out);
    }
    if (state->kick >= 0 && run->tick >= run->agents->kick_ready[i]) {
        const JoxObstacle obstacle = jox_find_kick_obstacle(run, state, i, &spot);
        fails |= add_obstacle(run, i, "kick", state->kick, obstacle, jox_spot_gap(run, i, &spot),
                              JOX_KICK_REACH, out);
    }
    if (state->grasp >= 0 && !run->agents->grasped[i]) {
        const JoxObstacle obstacle = jox_find_grasp_obstacle(run, state, i, &spot);
        fails |= add_obstacle(run, i, "grasp", state->grasp, obstacle, jox_spot_gap(run, i, &spot),
                              JOX_GRASP_REACH, out);
    }
    if (state->toss >= 0)
        fails |= add_throw(run, i, state, out);
    return fails;
}

/* Appends what a car does: "the car stands on first with 3 people". */
static void add_car(const JoxLiftView *view, uint32_t lift, JoxText *out) {
    const JoxLift *of = &view->lifts[lift];
    const JoxLiftCar *car = &view->cars[lift];
    const char *const *modes = jox_lift_mode_names;
    if (car->target < 0)
        jox_text_printf(out, "the car stands on %.60s",
                        view->storeys->storeys[of->stops[car->stop].storey].name);
    else
        jox_text_printf(out, "the car is at %.1f m, on its way to %.60s", car->height,
                        view->storeys->storeys[of->stops[car->target].storey].name);
    jox_text_printf(out, " with %u of %u people", car->people, of->capacity);
    if (car->mode != JOX_LIFT_IN_USE)
        jox_text_printf(out, ", %s", modes[car->mode]);
}

void jox_why_add_ride(const JoxMachineRun *run, uint32_t i, JoxText *out) {
    const JoxLiftView *view = run->lifts;
    const JoxRider *rider;
    const JoxRidePhase phase = jox_machines_ride(run, i, &rider);
    if (phase == JOX_RIDE_OVER)
        return;
    const JoxLift *lift = &view->lifts[rider->lift];
    const char *from = view->storeys->storeys[lift->stops[rider->from].storey].name;
    const char *to = view->storeys->storeys[lift->stops[rider->to].storey].name;
    jox_text_printf(out, "lift %.60s: ", lift->name);
    if (phase == JOX_RIDE_APPROACH)
        jox_text_printf(out, "it is on its way to the door on %.60s", from);
    else if (phase == JOX_RIDE_WAIT)
        jox_text_printf(out, "it waits before the door on %.60s, since %.2f s", from,
                        rider->since * run->dt);
    else
        jox_text_printf(out, "it is in the car, since %.2f s", rider->boarded * run->dt);
    jox_text_printf(out, ", to ride to %.60s; ", to);
    add_car(view, rider->lift, out);
}

bool jox_why_add_deeds(const JoxMachineRun *run, uint32_t i, JoxText *out) {
    const JoxMachine *machine = jox_machine_of(run, i);
    const JoxState *state = &machine->states[run->agents->state[i]];
    bool fails = add_steering(run, i, state, out);
    const size_t before = out->length;
    jox_why_add_ride(run, i, out);
    if (out->length > before)
        jox_text_add(out, "\n");
    if (state->face >= 0 && !jox_target_find(run, i, state->face).found) {
        jox_text_add(out, "face ");
        jox_spell_target(machine, &machine->targets[state->face], out);
        jox_text_add(out, ": ");
        add_found(run, i, state->face, out);
        jox_text_add(out, "\n");
        fails = true;
    }
    return add_actions(run, i, state, out) || fails;
}
