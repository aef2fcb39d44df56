/* Actions of states besides the preferred velocity: computed parameters, pushing, approaching,
   kicking, picking up, throwing, holding on. The stage think calls jox_machines_act after the
   transitions. */
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "base/number/pi.h"
#include "machine/obstacles.h"

static const double KICK_PAUSE = 0.3; /* s between two kicks of one agent */
static const float AT_REST = 0.1f;    /* m/s: slower bodies do not pass their kicker */

/* Evaluates the computed parameters of a batch, and notes those that are odd. */
static void write_programs(const JoxMachineRun *run, const JoxBatchRange *batch,
                           JoxRegisters registers, JoxOdd *odd) {
    const JoxMachine *machine = run->set->items[batch->machine];
    const JoxState *state = &machine->states[batch->state];
    const uint32_t *agents = run->scratch->grouped + batch->begin;
    for (int p = 0; p < JOX_PARAM_COUNT; p++) {
        const JoxValue *value = jox_state_parameter(machine, state, p);
        if (value->kind != JOX_VALUE_EXPRESSION)
            continue;
        JOX_ASSERT(run->agents->param[p].mask); /* differ_by_programs gave it cells */
        jox_eval(run, machine, &machine->expressions[value->index], agents, batch->count,
                 registers);
        jox_odd_look(run, agents, batch->count, p, registers[0], odd);
        jox_parameter_store_all((JoxParameter)p, registers[0], agents, batch->count,
                                run->agents->param[p].cells);
    }
}

/* Sets a column of bytes for agents in ascending index; a contiguous range is filled at once. */
static void fill_bytes(uint8_t *column, const uint32_t *agents, uint32_t count, uint8_t value) {
    if (agents[count - 1] - agents[0] == count - 1) {
        jox_mem_fill(column + agents[0], value, count);
        return;
    }
    for (uint32_t n = 0; n < count; n++)
        column[agents[n]] = value;
}

/* Zeroes a column of words for agents in ascending index. */
static void clear_words(uint32_t *words, const uint32_t *agents, uint32_t count) {
    if (agents[count - 1] - agents[0] == count - 1) {
        jox_mem_fill(words + agents[0], 0, count * sizeof *words);
        return;
    }
    for (uint32_t n = 0; n < count; n++)
        words[agents[n]] = 0;
}

/* Writes what the state of a batch says of pushing and approaching, and ends holds. */
static void write_pushing(const JoxMachineRun *run, const JoxBatchRange *batch,
                          JoxRegisters registers) {
    const JoxMachine *machine = run->set->items[batch->machine];
    const JoxState *state = &machine->states[batch->state];
    const uint32_t *agents = run->scratch->grouped + batch->begin;
    if (state->push_when >= 0)
        jox_eval(run, machine, &machine->expressions[state->push_when], agents, batch->count,
                 registers);
    fill_bytes(run->push_on, agents, batch->count, 1);
    for (uint32_t n = 0; state->push_when >= 0 && n < batch->count; n++)
        run->push_on[agents[n]] = registers[0][n] != 0.0;
    fill_bytes(run->push_nearest, agents, batch->count, state->push_nearest);
    clear_words(run->agents->approach, agents, batch->count);
    clear_words(run->agents->approached, agents, batch->count);
    if (state->grasp < 0)
        clear_words(run->agents->grasped, agents, batch->count); /* lets go */
    for (uint32_t n = 0; state->push_toward >= 0 && n < batch->count; n++) {
        const uint32_t i = agents[n];
        JoxSpot spot = jox_target_find(run, i, state->push_toward);
        JoxV2 way = {spot.x - run->agents->x[i], spot.y - run->agents->y[i]};
        way = spot.found ? jox_unit(way) : (JoxV2){0.0f, 0.0f};
        run->push_toward_x[i] = way.x;
        run->push_toward_y[i] = way.y;
    }
    for (uint32_t n = 0; state->approach >= 0 && n < batch->count; n++) {
        const uint32_t i = agents[n];
        const JoxSpot spot = jox_target_find(run, i, state->approach);
        run->agents->approach[i] = jox_reference(spot.object);
        if (spot.agent != JOX_NO_INDEX)
            run->agents->approached[i] = run->agents->id[spot.agent] + 1;
    }
}

/* Gives a cell per agent to each parameter that an expression computes, since worker threads write
   them. */
static void differ_by_programs(JoxMachineRun *run) {
    const JoxMachineScratch *s = run->scratch;
    const JoxState *last = NULL; /* batches of one state are adjacent */
    for (uint32_t b = 0; b < s->batch_count; b++) {
        const JoxMachine *machine = run->set->items[s->batches[b].machine];
        const JoxState *state = &machine->states[s->batches[b].state];
        for (JoxParameter p = 0; state != last && p < JOX_PARAM_COUNT; p++)
            if (jox_state_parameter(machine, state, p)->kind == JOX_VALUE_EXPRESSION)
                jox_param_differ(run->agents, p);
        last = state;
    }
}

static void act_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    const JoxMachineRun *run = context;
    JOX_ASSERT(worker < run->scratch->workers);
    for (uint32_t b = begin; b < end; b++) {
        write_programs(run, &run->scratch->batches[b], run->scratch->registers[worker],
                       &run->scratch->odd[worker]);
        write_pushing(run, &run->scratch->batches[b], run->scratch->registers[worker]);
    }
}

/* Returns whether agent i still passes the body that it kicked: nobody kicks against an own foot.
   It does until the body is clear of it and moves away, or has come to rest. */
static bool still_passes(const JoxMachineRun *run, uint32_t i) {
    const JoxAgents *a = run->agents;
    const uint32_t row = (uint32_t)jox_referred(a->parting[i]);
    if (!run->objects || row >= run->objects->count)
        return false;
    const JoxObject *body = &run->objects->rows[row];
    const JoxV2 offset = {body->position.x - a->x[i], body->position.y - a->y[i]};
    const JoxV2 relative = {body->velocity.x - a->vx[i], body->velocity.y - a->vy[i]};
    const float reach = body->footprint_count ? body->disc : body->round;
    const bool clear = jox_length(offset) > reach + jox_param(a, JOX_PARAM_radius, i);
    return body->live && !body->held && jox_length2(relative) > AT_REST * AT_REST &&
           !(clear && jox_dot(offset, relative) >= 0.0f);
}

static void end_passing(JoxMachineRun *run) {
    JoxAgents *a = run->agents;
    for (uint32_t i = 0; i < a->count; i++)
        if (a->parting[i] && !still_passes(run, i))
            a->parting[i] = 0;
}

/* Returns the impulse of a kick on a body, N s: along `way`, a horizontal unit vector, raised by
   the lift. A kick with a speed also takes the velocity that the body had. */
static JoxV3 find_kick_impulse(JoxMachineRun *run, const JoxMachine *machine, const JoxState *state,
                               uint32_t i, const JoxObject *body, JoxV2 way) {
    JOX_ASSERT(body->inverse_mass > 0.0f); /* a body that moves has a finite mass */
    const bool sets = state->kick_speed.kind != JOX_VALUE_UNSET;
    const double change =
        sets ? jox_action_number(run, machine, JOX_ACTION_KICK_SPEED, &state->kick_speed, i)
             : jox_action_number(run, machine, JOX_ACTION_KICK, &state->kick_impulse, i);
    const float impulse = (float)change / body->inverse_mass;
    const double lift =
        jox_action_number(run, machine, JOX_ACTION_LIFT, &state->kick_lift, i) * JOX_DEGREE;
    const float level = impulse * (float)jox_cos(lift), up = impulse * (float)jox_sin(lift);
    JoxV3 kick = {way.x * level, way.y * level, up};
    if (sets) {
        kick.x -= body->velocity.x / body->inverse_mass;
        kick.y -= body->velocity.y / body->inverse_mass;
        kick.z -= body->velocity.z / body->inverse_mass;
    }
    return kick;
}

/* Finds the body that an action is about; returns why it cannot be moved by hand or foot, if so. */
static JoxObstacle find_body(const JoxMachineRun *run, int16_t target, uint32_t i, JoxSpot *spot) {
    *spot = jox_target_find(run, i, target);
    if (spot->object < 0)
        return spot->found ? JOX_OBSTACLE_KIND : JOX_OBSTACLE_ABSENT;
    const JoxObject *object = &run->objects->rows[spot->object];
    return !object->moves ? JOX_OBSTACLE_FIXED
           : object->held ? JOX_OBSTACLE_HELD
                          : JOX_OBSTACLE_NONE;
}

JoxObstacle jox_find_kick_obstacle(const JoxMachineRun *run, const JoxState *state, uint32_t i,
                                   JoxSpot *spot) {
    const JoxAgents *a = run->agents;
    const JoxObstacle found = find_body(run, state->kick, i, spot);
    if (found != JOX_OBSTACLE_NONE)
        return found;
    if (jox_spot_gap(run, i, spot) >= JOX_KICK_REACH)
        return JOX_OBSTACLE_FAR;
    if (!run->objects->rows[spot->object].in_band)
        return JOX_OBSTACLE_HIGH;
    const bool hidden =
        jox_is_hidden(run, jox_v2(a->x[i], a->y[i]), jox_v2(spot->x, spot->y), true);
    return hidden ? JOX_OBSTACLE_BLOCKED : JOX_OBSTACLE_NONE;
}

/* Kicks the target of the state if the agent touches it: an impulse through the body's centre,
   towards kick_at; straight ahead without it, or if there is none in sight. */
static void kick_body(JoxMachineRun *run, const JoxMachine *machine, const JoxState *state,
                      uint32_t i) {
    JoxAgents *a = run->agents;
    JoxSpot ball;
    if (run->tick < a->kick_ready[i] ||
        jox_find_kick_obstacle(run, state, i, &ball) != JOX_OBSTACLE_NONE)
        return;
    const JoxObject *object = &run->objects->rows[ball.object];
    JoxV2 way = {ball.x - a->x[i], ball.y - a->y[i]};
    if (state->kick_at >= 0) {
        JoxSpot at = jox_target_find(run, i, state->kick_at);
        if (at.found)
            way = (JoxV2){at.x - ball.x, at.y - ball.y};
    }
    way = jox_unit(way);
    if (jox_length2(way) == 0.0f)
        return;
    const JoxV3 impulse = find_kick_impulse(run, machine, state, i, object, way);
    if (impulse.x == 0.0f && impulse.y == 0.0f && impulse.z == 0.0f)
        return;
    JOX_RESERVE(run->kicks, run->kick_capacity, run->kick_count + 1);
    run->kicks[run->kick_count++] = (JoxImpulse){
        .object = (uint32_t)ball.object, .impulse = impulse, .point = object->position};
    a->kicked[i] = a->parting[i] = jox_reference(ball.object);
    jox_throwers_note(run, object->id, a->id[i]);
    a->kick_ready[i] = run->tick + (uint32_t)(KICK_PAUSE / run->dt + 0.5);
}

/* Adds a pick-up or throw, unless another agent has one of the same body. */
static void add_grip(JoxMachineRun *run, JoxGrip grip) {
    for (uint32_t g = 0; g < run->grip_count; g++)
        if (run->grips[g].object == grip.object)
            return; /* the agent with the lower id was first */
    JOX_RESERVE(run->grips, run->grip_capacity, run->grip_count + 1);
    run->grips[run->grip_count++] = grip;
}

/* Returns whether an agent's hands reach a body, past walls and fixed bodies. */
static bool hands_reach(const JoxMachineRun *run, uint32_t i, const JoxSpot *body) {
    const JoxV2 from = {run->agents->x[i], run->agents->y[i]}, to = {body->x, body->y};
    JoxHands *hands = &run->scratch->hands;
    jox_hands_look(hands, run->walls, run->wall_images, run->objects, (uint32_t)body->object, from,
                   jox_length(jox_sub(to, from)));
    return jox_hands_reach(hands, from, to);
}

JoxObstacle jox_find_take_obstacle(const JoxMachineRun *run, const JoxState *state, uint32_t i,
                                   JoxSpot *spot) {
    const JoxAgents *a = run->agents;
    const JoxObstacle found = find_body(run, state->take, i, spot);
    const JoxV2 relative = {spot->vx - a->vx[i], spot->vy - a->vy[i]};
    if (found != JOX_OBSTACLE_NONE)
        return found;
    if (!(jox_spot_gap(run, i, spot) < JOX_TAKE_REACH))
        return JOX_OBSTACLE_FAR;
    if (!(spot->z < 2.0f))
        return JOX_OBSTACLE_HIGH;
    if (!(jox_length(relative) < JOX_CATCHABLE))
        return JOX_OBSTACLE_FAST;
    return hands_reach(run, i, spot) ? JOX_OBSTACLE_NONE : JOX_OBSTACLE_BLOCKED;
}

/* Picks up the target of the state unless the agent holds it, or something keeps it from it. */
static void pick_up_body(JoxMachineRun *run, const JoxState *state, uint32_t i) {
    JoxSpot spot;
    if (jox_held_body_row(run, i, state->take) < 0 &&
        jox_find_take_obstacle(run, state, i, &spot) == JOX_OBSTACLE_NONE)
        add_grip(run, (JoxGrip){.object = (uint32_t)spot.object,
                                .agent_id = run->agents->id[i],
                                .takes = true});
}

/* Throws the held body at the target with a given horizontal speed, and the vertical speed with
   which it arrives at the target's height. */
static void throw_body(JoxMachineRun *run, const JoxMachine *machine, const JoxState *state,
                       uint32_t i) {
    JoxAgents *a = run->agents;
    int32_t row = jox_held_body_row(run, i, state->toss);
    JoxSpot at = jox_target_find(run, i, state->toss_at);
    if (row < 0 || !at.found || state->toss_at < 0)
        return;
    const double speed = jox_action_number(run, machine, JOX_ACTION_THROW, &state->toss_speed, i);
    if (!(speed > 0.1))
        return;
    JoxV2 way = {at.x - a->x[i], at.y - a->y[i]};
    float distance = jox_length(way), level = (float)speed;
    if (distance < 1e-3f)
        return;
    float flight = distance / level;
    /* A place lies on the ground; an agent is hit at the height of the hand. */
    float drop = at.place >= 0 ? JOX_HAND_HEIGHT : 0.0f;
    float rise = 0.5f * (float)run->gravity * flight - drop / flight;
    way = jox_scale(way, level / distance);
    add_grip(run, (JoxGrip){.object = (uint32_t)row,
                            .agent_id = a->id[i],
                            .velocity = {way.x, way.y, jox_clampf(rise, -20.0f, 20.0f)}});
    a->kicked[i] = jox_reference(row);
    jox_throwers_note(run, run->objects->rows[row].id, a->id[i]);
}

/* Lets the held body go, which falls with the agent's velocity. */
static void drop_body(JoxMachineRun *run, const JoxState *state, uint32_t i) {
    const JoxAgents *a = run->agents;
    const int32_t row = jox_held_body_row(run, i, state->drop);
    if (row >= 0)
        add_grip(run, (JoxGrip){.object = (uint32_t)row,
                                .agent_id = a->id[i],
                                .velocity = {a->vx[i], a->vy[i], 0.0f}});
}

/* Lists all agents whose state satisfies `matches` in scratch->list, by id. */
static void list_agents_in(JoxMachineRun *run, bool (*matches)(const JoxState *state)) {
    JoxMachineScratch *s = run->scratch;
    s->list_count = 0;
    for (uint32_t b = 0; b < s->batch_count; b++) {
        const JoxBatchRange *batch = &s->batches[b];
        const bool all = matches(&run->set->items[batch->machine]->states[batch->state]);
        for (uint32_t n = 0; all && n < batch->count; n++)
            s->list[s->list_count++] = s->grouped[batch->begin + n];
    }
    jox_sort_by_id(run, s->list, s->list_count);
}

static bool acts_on_bodies(const JoxState *state) {
    return state->kick >= 0 || state->take >= 0 || state->toss >= 0 || state->drop >= 0;
}

static bool holds_on(const JoxState *state) {
    return state->grasp >= 0;
}

/* Kicks, throws and picks up for all agents, by id. */
static void act_on_bodies(JoxMachineRun *run) {
    const JoxAgents *a = run->agents;
    JoxMachineScratch *s = run->scratch;
    list_agents_in(run, acts_on_bodies);
    for (uint32_t n = 0; n < s->list_count; n++) {
        uint32_t i = s->list[n];
        const JoxMachine *machine = jox_machine_of(run, i);
        const JoxState *state = &machine->states[a->state[i]];
        if (state->kick >= 0)
            kick_body(run, machine, state, i);
        if (state->toss >= 0)
            throw_body(run, machine, state, i);
        if (state->take >= 0)
            pick_up_body(run, state, i);
        if (state->drop >= 0)
            drop_body(run, state, i);
    }
}

void jox_machines_act(JoxMachineRun *run, JoxPool *pool) {
    JoxAgents *a = run->agents;
    if (a->count == 0)
        return;
    JOX_CHECK(jox_groups_check(run));
    jox_mem_fill(run->push_on, 1, a->count);
    jox_mem_fill(run->push_nearest, 0, a->count);
    jox_mem_fill(run->push_toward_x, 0, a->count * sizeof(float));
    jox_mem_fill(run->push_toward_y, 0, a->count * sizeof(float));
    jox_mem_fill(a->kicked, 0, a->count * sizeof *a->kicked);
    memset(run->scratch->odd, 0, run->scratch->workers * sizeof *run->scratch->odd);
    differ_by_programs(run);
    jox_parallel_for(pool, run->scratch->batch_count, 1, act_range, run);
    jox_odd_tell(run, jox_odd_first(run->scratch->odd, run->scratch->workers));
    end_passing(run);
    if (run->objects && run->objects->count)
        act_on_bodies(run);
    jox_mem_fill(a->held, 0, a->count);
    list_agents_in(run, holds_on);
    jox_machines_grasp(run, run->scratch->list, run->scratch->list_count);
    JOX_CHECK(jox_acts_check(run));
}
