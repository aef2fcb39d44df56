/* What a substep is for the stages of nav and force: its times, and the agents and objects that it
   moves. world/step.c fills it once a substep; inspection reads the last one between steps. */
#ifndef JOX_AGENTS_STEP_H
#define JOX_AGENTS_STEP_H

#include "agents/agents.h"
#include "agents/contact_planes.h"
#include "agents/neighbours.h"

/* The times of a substep. Agents approach the planned velocity exponentially. */
typedef struct JoxTiming {
    uint64_t seed;            /* of the run's random numbers */
    double time;              /* s: simulated time at the start of the substep */
    double dt;                /* s: length of the substep, above 0 */
    double planning_time;     /* s: how far ahead velocities are planned */
    double response;          /* share of the way to the planned velocity covered in dt */
    double on_the_way;        /* mean of that share over dt */
    double interval;          /* s: between plans of agents that are not pressed while they stand */
    double interval_response; /* share of the way covered in that time */
    double interval_forced;   /* s: how long a force would have to act, at the start of the interval
                                 and all at once, to have the effect at its end that it has substep
                                 by substep */
    bool plans; /* agents plan anew; false: those that want to get on keep their plans */
} JoxTiming;

/* Returns the timing of agents that plan in each step of dt seconds, and reach the planned velocity
   at once. */
static inline JoxTiming jox_timing_at_once(double dt) {
    return (JoxTiming){.dt = dt,
                       .planning_time = dt,
                       .response = 1.0,
                       .on_the_way = 1.0,
                       .interval = dt,
                       .interval_response = 1.0,
                       .interval_forced = dt,
                       .plans = true};
}

/* Inputs of the stages. The pointers stay valid, and the agents keep their order, within the
   substep. */
typedef struct JoxStep {
    JoxTiming timing;
    JoxAgents *agents;
    const JoxNeighbours *neighbours;  /* found before the agents move */
    const struct JoxObjects *objects; /* bodies; NULL: none */
    const JoxContactPlanes *touched;  /* of the last force stages; NULL: none */
    struct JoxPool *pool;             /* NULL: the calling thread does it all */
} JoxStep;

#endif
