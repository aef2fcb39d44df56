/* Offsets between the agents of a packet and others that they see. */
#ifndef JOX_AGENTS_FOLD_LANES_H
#define JOX_AGENTS_FOLD_LANES_H

#include "agents/agents.h"
#include "simd/vectors.h"

/* Returns whether agents may see each other across periodic edges or seams. */
static inline bool jox_folds(const JoxAgents *a) {
    return a->period.x > 0.0f || a->period.y > 0.0f || a->pitch > 0.0f;
}

/* Returns the vectors between agents that see each other and whose positions differ by d; as
   jox_fold. */
static inline JoxVector jox_fold_lanes(const JoxAgents *a, JoxVector d) {
    d.x = jf_wrap(d.x, a->period.x);
    d.y = a->pitch > 0.0f ? jf_fold(d.y, a->pitch) : jf_wrap(d.y, a->period.y);
    return d;
}

#endif
