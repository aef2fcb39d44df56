/* The clock of `stuck`. eval_wide.c and why_words.c include it. */
#ifndef JOX_MACHINE_STUCK_TIME_H
#define JOX_MACHINE_STUCK_TIME_H

#include "machine/machine_parts.h"

/* Returns how long the agent has not moved 0.25 m within the state that asks, s: within an outer
   state, whose clock is memory slot `clock` (-1: within the agent's own state). */
static inline double jox_time_stuck(const JoxMachineRun *run, uint32_t agent, int32_t clock) {
    const double still = (double)run->agents->still[agent];
    const double within =
        clock < 0 ? jox_time_in_state(run, agent) : jox_time_since(run, agent, (uint32_t)clock);
    return still < within ? still : within;
}

#endif
