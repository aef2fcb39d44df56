/* The half-planes of what an agent touches: `force` writes them after the forces of a step are
   known, `nav` solves them as hard constraints. They allow the velocities that do not approach what
   is touched faster than contact lets the two move together; the velocity that the forces
   give by the end of the step meets all of them, but for what followers allow those ahead to brake.
 */
#ifndef JOX_AGENTS_CONTACT_PLANES_H
#define JOX_AGENTS_CONTACT_PLANES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/vec.h"

/* What one agent can touch at a time: people, and bodies. */
enum { JOX_MOST_TOUCHED = 32, JOX_MOST_BODIES_TOUCHED = 4 };

/* normal . v >= offset, with a unit normal that points to the agent; m/s. */
typedef struct JoxContactPlane {
    JoxV2 normal;
    float offset;
    uint32_t other; /* index of an agent, or row of a body */
    float apart;    /* least distance of the centres of two agents, m */
} JoxContactPlane;

typedef struct JoxContactPlanes {
    /* Of agent i: planes[starts[i]] to planes[starts[i] + people[i] + bodies[i]], people first.
       `people` and `bodies` may be read up to a whole packet behind the last agent. */
    uint32_t *starts;
    uint8_t *people, *bodies;
    JoxContactPlane *planes;
    uint32_t agents; /* how many agents have planes; 0: no contact was looked for in this step */
    size_t starts_capacity, people_capacity, bodies_capacity, plane_capacity;
} JoxContactPlanes;

#endif
