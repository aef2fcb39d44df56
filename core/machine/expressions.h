/* Expressions as data: what is measured of agents, operations, and the straight-line programs that
   conditions and computed numbers are compiled to. Part of machine.h; lua/compile.c makes them,
   eval.c runs them. */
#ifndef JOX_MACHINE_EXPRESSIONS_H
#define JOX_MACHINE_EXPRESSIONS_H

#include <stdint.h>

enum { JOX_MOST_REGISTERS = 32 };

#define JOX_LOAD_MEANING                                                                           \
    "greatest push borne from any one direction: over directions d, the greatest sum of the "      \
    "positive parts of f.d over its contacts f"

/* Quantities measured of the agent itself. Each row is the complete definition: name (`now.NAME`),
   word, unit, meaning, and the value for agent `i` of `run` with columns `a`. Rows of
   JOX_MEASURED_WORDS can also be written as the plain word in their second column. */
/* clang-format off */
#define JOX_MEASURED_WORDS(X)                                                                      \
    X(density, density_here, "1/m2",                                                               \
      "people per square metre about the agent, from its neighbours' distances", a->density[i])    \
    X(headway, headway, "m",                                                                       \
      "free distance ahead to the next neighbour that does not come the other way; the perception " \
      "radius if there is none", jox_headway(run, i))                                                            \
    X(eagerness, eagerness, "",                                                                    \
      "how eager the agent is to get on, 0 to 1: the crowd about it raises it, within the bounds " \
      "of `haste`", a->eager[i])                                                                   \
    X(pushed, pushed, "N", "magnitude of the net force on the agent",                              \
      jox_length((JoxV2){a->force_x[i], a->force_y[i]}))                                           \
    X(compression, compression, "N/m", "sum of contact force magnitudes, divided by the circumference",      \
      a->compression[i])                                                                           \
    X(load, load, "N", JOX_LOAD_MEANING, a->load[i])                                               \
    X(contacts, contacts, "", "agents and bodies touched", a->contacts[i])                         \
    X(holders, holders, "", "agents that hold on to the agent (see `grasp`)", a->held[i])                \
    X(time_in_state, time_in_state, "s", "since the state was entered", jox_time_in_state(run, i))
#define JOX_MEASURED_OTHERS(X)                                                                     \
    X(speed, , "m/s", "present speed", jox_length((JoxV2){a->vx[i], a->vy[i]}))                    \
    X(fallen, , "s", "time since the agent fell; 0 while it stands", a->fallen[i])                 \
    X(x, , "m", "position east", a->x[i])                                                          \
    X(y, , "m", "position north; in a building with storeys, in plan", jox_in_plan(a->storeys, jox_v2(a->x[i], a->y[i])).y) \
    X(storey, , "", "number of the storey: 0 is the lowest one; on a stair, the nearer in height", \
      jox_storey_at(a->storeys, jox_v2(a->x[i], a->y[i])))                                         \
    X(height, , "m", "elevation of the floor on which the agent is, also of a lift's car; 0 without storeys", \
      jox_machines_height(run, i))                                                                 \
    X(neighbours, , "", "neighbours seen", run->neighbours->count[i])                              \
    X(driven, , "m/s", "speed that a person or an input log asks of the agent (`player`); 0: none", \
      jox_driven(run, i))                                                                          \
    X(played, , "", "1 once a person or an input log drives the agent (`player`), also while it is to " \
      "stand; before 0", jox_player_input(run, i) ? 1.0 : 0.0)                                                       \
    X(button, , "", "1 while the person who drives the agent holds the button, else 0",            \
      jox_player_input(run, i) ? jox_player_input(run, i)->button : 0.0)                                                                   \
    X(time, , "s", "simulated time", run->tick * run->dt)
#define JOX_MEASURED(X) JOX_MEASURED_OTHERS(X) JOX_MEASURED_WORDS(X)
/* clang-format on */

typedef enum JoxNow {
#define X(name, ...) JOX_NOW_##name,
    JOX_MEASURED(X)
#undef X
        JOX_NOW_COUNT
} JoxNow;

/* X(op): registers a, b, c are inputs; numbers are doubles; conditions are 0 or 1. Target -1 is the
   agent itself. x / 0 is 0. CLAMP: a within [b, c]. EITHER: b if a
   holds, else c. DISTANCE: metres from the agent's centre to the
   target, infinite when absent. PLACE_DENSITY, PLACE_COUNT: people in place (a polygon, else a disc
   of 2 m about it). INSIDE: target is in place. ARRIVED: the agent is in place, or agents who have
   arrived there keep it off. NEAR: target is nearer than a metres. CROSSES: the last move crossed
   line `place` from its right to its left. FIRST_IN: the agent heads its queue. JOINED: it has its
   place in its queue. AFTER: time in state is at least a. LASTED: the drawn duration of the state
   is over. STUCK: the agent has not moved 0.25 m for a seconds. FALLEN: the agent lies after a
   fall. TOUCHES: the gap to target is below 0.05 m. GROUNDED: target, a body, touches the ground.
   KICKED: the agent kicked target, or a body with its tag, in the last step. HIT_BY: target, faster
   than 1 m/s, touches the agent, or such a body hit it in the last step. INCOMING: target, at its
   present velocity, comes within a metres of where the agent stands during the next 2 s. SEES:
   target exists within perception. HAS: the agent holds target, a body or an agent. HEARD: another
   agent within perception, and within a metres, gave the signal `name` in the last step.
   NEIGHBOURS: number of neighbours that match target. THEIRS: memory `name` of the agent that is
   the target, if its machine makes that public; else 0. OF: what is measured of the target, a
   JoxNow in `arg`; 0 if there is none. EXISTS: target is in the world, seen or not. SAME: target
   and `place`, a second target, are the same person, body or place. TOLD: a message `name` waits
   for the agent. MESSAGE: the value called names[arg] of the oldest such message; 0 if there is
   none. EVERY: the time in state has reached a multiple of a, s, in this step. LIST_HAS: memory
   `arg`, a list, contains a, or target; LIST_SIZE, LIST_FIRST, LIST_LAST: its length and items.
   SHUT: a gate at place is closed, and the agent sees it. LEFT: number of agents that left the
   world from `place`. RODE: the agent's ride in a lift is over. RIDING: it is in the car.
   IN_USE: the lift of `place` is in
   use. QUEUED: number of agents in the queue `place`. OPEN: the gates called `name`
   are open. DONE: the machine that the outer state on level `arg` runs has ended. OUTER_AFTER,
   OUTER_LASTED, OUTER_TIME, OUTER_EVERY: AFTER, LASTED, the time in the state and EVERY, of the
   outer state whose clock is memory slot `arg`. Agents behind a wall are not seen, heard or
   touched. */
/* clang-format off */
#define JOX_OPS(X)                                                              \
    X(CONST) X(NOW) X(OWN) X(MEMORY)                                            \
    X(ADD) X(SUB) X(MUL) X(DIV) X(MIN) X(MAX) X(NEG) X(ABS) X(SQRT) X(CLAMP)    \
    X(EITHER)                                                                   \
    X(GT) X(GE) X(LT) X(LE) X(EQ) X(AND) X(OR) X(NOT)                           \
    X(DISTANCE) X(PLACE_DENSITY) X(PLACE_COUNT)                                 \
    X(INSIDE) X(ARRIVED) X(NEAR) X(CROSSES) X(FIRST_IN) X(JOINED) X(AFTER)      \
    X(LASTED) X(STUCK) X(TOUCHES) X(FALLEN) X(GROUNDED) X(KICKED) X(HIT_BY)     \
    X(INCOMING) X(SEES)                                                         \
    X(HAS) X(HEARD) X(NEIGHBOURS) X(THEIRS) X(OF) X(EXISTS) X(SAME) X(TOLD)     \
    X(MESSAGE) X(EVERY) X(SHUT)                                                 \
    X(PROGRAM_NUMBER) X(PROGRAM_CONDITION)                                      \
    X(RODE) X(RIDING) X(IN_USE) X(QUEUED) X(OPEN) X(LEFT) X(LIST_HAS) X(LIST_SIZE) X(LIST_FIRST) X(LIST_LAST) X(DONE) X(OUTER_AFTER) X(OUTER_LASTED) X(OUTER_TIME)      \
    X(OUTER_EVERY)
/* clang-format on */

typedef enum JoxOp {
#define X(name) JOX_OP_##name,
    JOX_OPS(X)
#undef X
        JOX_OP_COUNT
} JoxOp;

typedef struct JoxInstruction {
    uint8_t op, to, a, b, c;
    int16_t target, place; /* indices into the machine's targets; -1 none (or: the agent itself) */
    int16_t name;          /* index into the machine's names; -1 none */
    uint16_t skip; /* if `to` is 0 for all agents, the next `skip` instructions change nothing */
    int32_t arg;
    double number;
} JoxInstruction;

/* A compiled condition or number: straight-line code that leaves its result in register 0. Parts of
   it may be skipped: the right side of an AND if its left side is false for all agents. */
typedef struct JoxExpression {
    JoxInstruction *code;
    uint32_t count;
} JoxExpression;

#endif
