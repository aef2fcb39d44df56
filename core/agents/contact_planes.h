/* Half-planes of contacts. `force` writes them once the forces of a step are known; `nav` solves
   them as hard constraints. They forbid an agent to approach the one it touches faster than the
   contact lets both move together. The velocity that results from the forces satisfies all of them,
   except where followers let agents ahead brake. */
#ifndef JOX_AGENTS_CONTACT_PLANES_H
#define JOX_AGENTS_CONTACT_PLANES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/vec.h"

/* Greatest numbers of agents and bodies that one agent touches at a time. */
enum { JOX_MOST_TOUCHED = 32, JOX_MOST_BODIES_TOUCHED = 4 };

/* Allowed velocities: normal . v >= offset, m/s; the unit normal points to the agent. */
typedef struct JoxContactPlane {
    JoxV2 normal;
    float offset;
    uint32_t other; /* index of the agent, or row of the body, that is touched */
    float apart;    /* least distance of the centres of two agents along the normal, m */
} JoxContactPlane;

typedef struct JoxContactPlanes {
    /* Half-planes of agent i: planes[starts[i]] and following, people[i] for agents, then bodies[i]
       for bodies. `people` and `bodies` are readable for one packet behind the last agent. */
    uint32_t *starts, *own_starts; /* starts: own ones where agents touch bodies */
    uint8_t *people, *bodies;
    JoxContactPlane *planes;
    uint32_t agents; /* number of agents with half-planes; 0: contacts were not searched in this
                        step */
    size_t starts_capacity, people_capacity, bodies_capacity;
} JoxContactPlanes;

#endif
