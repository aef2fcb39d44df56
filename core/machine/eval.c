/* Evaluates expressions over batches: one dispatch per instruction for up to JOX_BATCH agents.
   Arithmetic and the agents' columns are left to the kernel (eval_wide.c); words on the
   surroundings are evaluated here, agent by agent. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/number/pi.h"
#include "machine/kernels.h"
#include "machine/lifts.h"

/* Kernels by instruction set; scalar if none was chosen. */
#define X(name, isa) [isa] = jox_eval_numbers_##name,
static JoxEvalKernel *const KERNELS[JOX_ISA_ROOM] = {[JO_ISA_WIDEST] = jox_eval_numbers_scalar,
                                                     JOX_ISAS(X)};
#undef X

static double find_counted_people(const JoxMachineRun *run, int32_t place) {
    uint32_t people = run->scratch->place_people[place];
    return people == UINT32_MAX ? 0.0 : people;
}

/* Returns the area over which people of a place are counted, m2: the polygon, else a disc of 2
   m. */
static double find_counted_area(const JoxPlace *place) {
    return jox_place_is_area(place) ? jox_polygon_area(place->points, place->count) : 4.0 * JOX_PI;
}

static bool is_inside(const JoxMachineRun *run, uint32_t i, int32_t target, int32_t place) {
    if (place < 0)
        return false;
    const JoxV2 own = {run->agents->x[i], run->agents->y[i]};
    if (target < 0)
        return jox_place_is_reached(run->places, (uint32_t)place, run->walls, own);
    const JoxSpot spot = jox_target_find(run, i, target);
    return spot.found &&
           jox_place_is_reached(run->places, (uint32_t)place, run->walls, jox_v2(spot.x, spot.y));
}

/* Evaluates INSIDE for agents that all ask about the same place and about themselves. */
static void eval_inside_one_place(const JoxMachineRun *run, const uint32_t *agents, uint32_t count,
                                  uint32_t place, double *to) {
    JoxV2 at[JOX_BATCH];
    bool there[JOX_BATCH];
    for (uint32_t n = 0; n < count; n++)
        at[n] = (JoxV2){run->agents->x[agents[n]], run->agents->y[agents[n]]};
    jox_place_is_reached_each(run->places, place, run->walls, at, count, there);
    for (uint32_t n = 0; n < count; n++)
        to[n] = there[n];
}

static void eval_inside(const JoxMachineRun *run, const JoxMachine *machine,
                        const JoxInstruction *in, const uint32_t *agents, uint32_t count,
                        double *to) {
    int32_t places[JOX_BATCH];
    jox_target_places(run, machine, in->place, agents, count, places);
    uint32_t alike = 0;
    while (alike < count && places[alike] == places[0])
        alike++;
    if (alike == count && in->target < 0 && places[0] >= 0) {
        eval_inside_one_place(run, agents, count, (uint32_t)places[0], to);
        return;
    }
    for (uint32_t n = 0; n < count; n++)
        to[n] = is_inside(run, agents[n], in->target, places[n]);
}

/* Evaluates CROSSES for agents that all ask about place `index`, -1: none. */
static void eval_crossing_of_line(const JoxMachineRun *run, const uint32_t *agents, uint32_t count,
                                  int32_t index, double *to) {
    const JoxAgents *a = run->agents;
    const JoxPlace *line = index < 0 ? NULL : &run->places[index];
    const bool is_line = line && jox_place_is_line(line);
    const JoxV2 from = is_line ? line->points[0] : (JoxV2){0.0f, 0.0f};
    const JoxV2 end = is_line ? line->points[1] : (JoxV2){0.0f, 0.0f};
    for (uint32_t n = 0; n < count; n++) {
        const uint32_t i = agents[n];
        to[n] = is_line && jox_segment_crossing(from, end, (JoxV2){a->prev_x[i], a->prev_y[i]},
                                                (JoxV2){a->x[i], a->y[i]}) == 1;
    }
}

static void eval_crosses(const JoxMachineRun *run, const JoxMachine *machine,
                         const JoxInstruction *in, const uint32_t *agents, uint32_t count,
                         double *to) {
    const bool one = in->place >= 0 && machine->targets[in->place].kind == JOX_TARGET_PLACE;
    const uint32_t step = one ? count : 1; /* a target that is a place is the same for all agents */
    for (uint32_t n = 0; n < count; n += step)
        eval_crossing_of_line(run, agents + n, step, jox_target_place(run, agents[n], in->place),
                              to + n);
}

/* Returns whether the gap to a spot is below `gap`, m; agents and bodies behind a wall are never
   touched. */
static bool is_touching(const JoxMachineRun *run, uint32_t i, const JoxSpot *spot, float gap) {
    const JoxV2 at = {run->agents->x[i], run->agents->y[i]};
    return jox_spot_gap(run, i, spot) < gap &&
           (spot->place >= 0 || !jox_is_hidden(run, at, (JoxV2){spot->x, spot->y}, true));
}

/* Returns whether a target is nearer than `metres`; a place only if no wall lies between. */
static bool is_target_near(const JoxMachineRun *run, uint32_t i, int32_t target, double metres) {
    const int32_t place = jox_target_place(run, i, target);
    if (place < 0)
        return jox_target_distance(run, i, target) < metres;
    return jox_place_is_near(run->places, (uint32_t)place, run->walls,
                             (JoxV2){run->agents->x[i], run->agents->y[i]}, metres);
}

/* Returns whether the spot, at its present velocity, passes within `reach` m of the agent. */
static bool is_incoming(const JoxMachineRun *run, uint32_t i, const JoxSpot *spot, double reach) {
    const JoxV2 offset = {spot->x - run->agents->x[i], spot->y - run->agents->y[i]};
    return spot->found && jox_pass_distance(offset, jox_v2(spot->vx, spot->vy)) < (float)reach;
}

/* Returns the number of agents that left the world from a place, or from the members of a set. */
static double count_left(const JoxMachineRun *run, int32_t index) {
    const JoxPlace *place = index < 0 || !run->count_left ? NULL : &run->places[index];
    if (!place)
        return 0.0;
    if (!jox_place_is_set(place))
        return run->count_left(run->exits, place->name);
    double sum = 0.0;
    for (uint32_t m = 0; m < place->member_count; m++)
        sum += run->count_left(run->exits, run->places[place->members[m]].name);
    return sum;
}

/* Evaluates a word about a list in memory; `item` is the number that it may contain. */
static double eval_list(const JoxMachineRun *run, const JoxMachine *machine, uint32_t i,
                        const JoxInstruction *in, double item) {
    const double *memory = run->agents->memory + (size_t)i * run->agents->memory_stride;
    double items[JOX_MOST_ITEMS];
    if (in->op == JOX_OP_LIST_SIZE)
        return jox_list_read(run, machine, memory, in->arg, items);
    if (in->op != JOX_OP_LIST_HAS)
        return jox_list_end(run, machine, memory, in->arg, in->op == JOX_OP_LIST_LAST);
    const double who = in->target >= 0 ? jox_target_who(run, i, in->target) : item;
    return (in->target < 0 || who != JOX_NOBODY) &&
           jox_list_has(run, machine, memory, in->arg, who);
}

/* Returns whether both targets are the same person, body or place. */
static bool is_same_target(const JoxMachineRun *run, uint32_t i, const JoxInstruction *in) {
    const double who = jox_target_who(run, i, in->target);
    return who != JOX_NOBODY && who == jox_target_who(run, i, in->place);
}

/* Evaluates a word about the agent's surroundings; `a` is the first input. */
static double eval_surroundings(const JoxMachineRun *run, const JoxMachine *machine, uint32_t i,
                                const JoxInstruction *in, double a) {
    int32_t place;
    JoxSpot spot;
    switch ((JoxOp)in->op) {
    case JOX_OP_DISTANCE:
        return jox_target_distance(run, i, in->target);
    case JOX_OP_PLACE_DENSITY:
        place = jox_target_place(run, i, in->place);
        return place < 0 ? 0.0
                         : find_counted_people(run, place) / find_counted_area(&run->places[place]);
    case JOX_OP_PLACE_COUNT:
        place = jox_target_place(run, i, in->place);
        return place < 0 ? 0.0 : find_counted_people(run, place);
    case JOX_OP_ARRIVED:
        place = jox_target_place(run, i, in->place);
        return place >= 0 &&
               (run->agents->arrived_at[i] == jox_reference(place) || is_inside(run, i, -1, place));
    case JOX_OP_NEAR:
        return is_target_near(run, i, in->target, a);
    case JOX_OP_FIRST_IN:
        return run->scratch->rank[i] == 0 && run->agents->queued[i] != JOX_NO_TURN;
    case JOX_OP_JOINED:
        return run->scratch->rank[i] != UINT32_MAX && run->agents->queued[i] != JOX_NO_TURN;
    case JOX_OP_TOUCHES:
        spot = jox_target_find(run, i, in->target);
        return is_touching(run, i, &spot, 0.05f);
    case JOX_OP_GROUNDED:
        spot = jox_target_find(run, i, in->target);
        return spot.object >= 0 && run->objects->rows[spot.object].grounded;
    case JOX_OP_KICKED:
        return jox_target_means(run, i, in->target, jox_referred(run->agents->kicked[i]));
    case JOX_OP_HIT_BY: /* the body may have bounced off and be far away by now */
        if (jox_target_means(run, i, in->target, jox_referred(run->agents->struck[i])))
            return true;
        spot = jox_target_find(run, i, in->target);
        return is_touching(run, i, &spot, JOX_HIT_GAP) &&
               spot.vx * spot.vx + spot.vy * spot.vy > 1.0f;
    case JOX_OP_INCOMING:
        spot = jox_target_find(run, i, in->target);
        return is_incoming(run, i, &spot, a);
    case JOX_OP_SEES:
        return jox_target_find(run, i, in->target).found;
    case JOX_OP_HAS:
        return jox_holds_target(run, i, in->target);
    case JOX_OP_HEARD:
        return jox_heard(run, i, machine->names[in->name].number, a);
    case JOX_OP_NEIGHBOURS:
        return jox_neighbours_of(run, i, in->target);
    case JOX_OP_THEIRS:
        return jox_target_memory(run, i, in->target, machine->names[in->name].number);
    case JOX_OP_OF:
        return jox_target_measure(run, i, in->target, (JoxNow)in->arg);
    case JOX_OP_EXISTS:
        return jox_target_exists(run, i, in->target);
    case JOX_OP_LIST_HAS:
    case JOX_OP_LIST_SIZE:
    case JOX_OP_LIST_FIRST:
    case JOX_OP_LIST_LAST:
        return eval_list(run, machine, i, in, a);
    case JOX_OP_TOLD:
        return jox_message_find(run, i, machine->names[in->name].number) != NULL;
    case JOX_OP_MESSAGE:
        return jox_message_value(jox_message_find(run, i, machine->names[in->name].number),
                                 machine->names[in->arg].number, false);
    case JOX_OP_OUTER_EVERY:
        return jox_is_interval_over(jox_time_since(run, i, (uint32_t)in->arg), run->dt, a);
    case JOX_OP_EVERY:
        return jox_is_interval_over(jox_time_in_state(run, i), run->dt, a);
    case JOX_OP_SAME:
        return is_same_target(run, i, in);
    case JOX_OP_LEFT:
        return count_left(run, jox_target_place(run, i, in->place));
    case JOX_OP_QUEUED:
        place = jox_target_place(run, i, in->place);
        return place < 0 ? 0.0 : run->scratch->place_queue[place];
    case JOX_OP_RODE:
        return jox_has_ridden(run, i);
    case JOX_OP_RIDING:
        return jox_is_riding(run, i);
    case JOX_OP_IN_USE:
        return jox_is_lift_in_use(run, jox_target_place(run, i, in->place));
    case JOX_OP_SHUT:
        return jox_sees_shut(run, i, jox_target_place(run, i, in->place));
    default:
        return 0.0;
    }
}

/* Returns whether gates of this name exist and all of them are open. */
static bool are_gates_open(const JoxMachineRun *run, const char *gate) {
    bool any = false;
    for (uint32_t r = 0; run->walls && r < run->walls->ring_count; r++) {
        const struct JoxWallRing *ring = &run->walls->rings[r];
        if (!ring->name || strcmp(ring->name, gate) != 0)
            continue;
        if (!ring->open)
            return false;
        any = true;
    }
    return any;
}

/* Evaluates a word of the program. */
static void eval_program_word(JoxProgramWord *word, bool condition, const uint32_t *agents,
                              uint32_t count, double *to) {
    uint32_t invalid = 0;
    const JoxOutside outside = jox_guard_leave();
    word->values(word->context, word->world, agents, count, to);
    jox_guard_return(outside);
    for (uint32_t n = 0; n < count; n++) {
        invalid += !isfinite(to[n]);
        to[n] = !isfinite(to[n]) ? 0.0 : condition ? to[n] != 0.0 : to[n];
    }
    if (invalid)
        atomic_fetch_add(&word->invalid, invalid);
}

/* Evaluates a word about the surroundings for `count` agents; `a` is its first input for each. */
static void eval_word(const JoxMachineRun *run, const JoxMachine *machine, const JoxInstruction *in,
                      const uint32_t *agents, uint32_t count, const double *a, double *to) {
    if (in->op == JOX_OP_INSIDE) {
        eval_inside(run, machine, in, agents, count, to);
    } else if (in->op == JOX_OP_PROGRAM_NUMBER || in->op == JOX_OP_PROGRAM_CONDITION) {
        eval_program_word(&run->program_words[in->arg], in->op == JOX_OP_PROGRAM_CONDITION, agents,
                          count, to);
    } else if (in->op == JOX_OP_CROSSES) {
        eval_crosses(run, machine, in, agents, count, to);
    } else if (in->op == JOX_OP_OPEN) {
        const double open = are_gates_open(run, machine->names[in->name].text);
        for (uint32_t n = 0; n < count; n++)
            to[n] = open;
    } else {
        for (uint32_t n = 0; n < count; n++)
            to[n] = eval_surroundings(run, machine, agents[n], in, a[n]);
    }
}

bool jox_holds_for_nobody(const double *values, uint32_t count) {
    uint32_t n = 0;
    while (n < count && values[n] == 0.0)
        n++;
    return n == count;
}

void jox_eval_scores(const JoxMachineRun *run, uint32_t agent, const JoxExpression *score,
                     const JoxSpot *candidates, uint32_t count, JoxRegisters registers) {
    JOX_ASSERT(count <= JOX_BATCH);
    const JoxMachine *machine = jox_machine_of(run, agent);
    uint32_t agents[JOX_BATCH];
    for (uint32_t n = 0; n < count; n++)
        agents[n] = agent;
    for (uint32_t k = 0; k < score->count; k++) {
        const JoxInstruction *in = &score->code[k];
        if (KERNELS[run->isa](run, in, agents, count, registers))
            continue;
        for (uint32_t n = 0; n < count; n++) {
            double one[1];
            jox_target_consider(&candidates[n]);
            eval_word(run, machine, in, &agent, 1, &registers[in->a][n], one);
            registers[in->to][n] = one[0];
        }
    }
    jox_target_consider(NULL);
}

void jox_eval(const JoxMachineRun *run, const JoxMachine *machine, const JoxExpression *expression,
              const uint32_t *agents, uint32_t count, JoxRegisters registers) {
    JOX_ASSERT(count <= JOX_BATCH);
    const JoxInstruction *code = expression->code;
    for (uint32_t i = 0; i < expression->count; i++) {
        const JoxInstruction *in = &code[i];
        if (!KERNELS[run->isa](run, in, agents, count, registers))
            eval_word(run, machine, in, agents, count, registers[in->a], registers[in->to]);
        while (code[i].skip && jox_holds_for_nobody(registers[code[i].to], count))
            i += code[i].skip; /* an AND: its result is its left side's, 0 for all */
    }
}

double jox_value(const JoxMachineRun *run, const JoxMachine *machine, const JoxValue *value,
                 uint32_t agent) {
    JOX_ASSERT(agent < run->agents->count);
    switch (value->kind) {
    case JOX_VALUE_CONST:
        return value->number;
    case JOX_VALUE_OWN:
        return jox_own(run->agents, agent, (uint32_t)value->index);
    case JOX_VALUE_EXPRESSION: {
        static _Thread_local JoxRegisters registers;
        jox_eval(run, machine, &machine->expressions[value->index], &agent, 1, registers);
        return registers[0][0];
    }
    case JOX_VALUE_UNSET:
        break;
    }
    return 0.0;
}

double jox_machines_expression(const JoxMachineRun *run, const JoxMachine *machine,
                               int32_t expression, uint32_t agent) {
    const JoxValue value = {.kind = JOX_VALUE_EXPRESSION, .index = expression};
    JOX_ASSERT(expression >= 0 && (uint32_t)expression < machine->expression_count);
    return jox_value(run, machine, &value, agent);
}
