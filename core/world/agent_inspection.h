/* What a step did with agents that somebody looks at: their half-planes, what their forces were
   made of, why they changed state. Written beside the step; nothing of it is read by a step. */
#ifndef JOX_WORLD_INSPECTED_H
#define JOX_WORLD_INSPECTED_H

#include "force/force.h"
#include "machine/run.h"
#include "nav/nav.h"

enum { JOX_MOST_INSPECTED = 16 };

/* What is shown of a net force, N: a part for each of its terms, and parts that are told apart
   within a term, so that all parts add up to the net force. */
typedef enum JoxForcePart {
    JOX_FORCE_PART_body,         /* of contact: with bodies, and hits by fast ones */
    JOX_FORCE_PART_deceleration, /* of inferred: equation 8 */
#define PART(X, keep, role, name, label) JOX_FORCE_PART_##name,
    JOX_FORCE_TERMS(PART, ) JOX_FORCE_PARTS
#undef PART
} JoxForcePart;
extern const char *const jox_force_part_names[JOX_FORCE_PARTS];

typedef struct JoxInspected {
    uint32_t slot, id;
    uint32_t asked; /* tick at which somebody looked last */
    bool seen;      /* what follows is known: of the last step, or as it stands since */
    JoxConstraint planes[JOX_MOST_CONSTRAINTS];
    uint32_t plane_count;
    JoxV2 forces[JOX_FORCE_PARTS];
    JoxV2 summed; /* the net force before fast bodies hit, N */
    JoxV2 slowed; /* of its inferred force, what comes of equation 8 */
    JoxV2 preferred, chosen;
    float speed_limit; /* of that step, m/s */
    bool failed;
} JoxInspected;

/* Zero-initialise. */
typedef struct JoxInspection {
    JoxInspected agents[JOX_MOST_INSPECTED];
    JoxWatched watched[JOX_MOST_INSPECTED]; /* the same agents' transitions */
    uint32_t count;
} JoxInspection;

struct JoWorld;
/* The inspection of the agent that is in a slot; begun where there is none, in place of the one
   that was asked for longest ago: then it says what the agent would choose as everything stands, or
   is not `seen` where the agent was not in the last step or the world was restored since. NULL
   where nobody is in the slot, or who was inspected there is gone: that inspection then ends.
 */
JoxInspected *jox_world_inspect(struct JoWorld *world, uint32_t slot, const JoxWatched **watched);
/* In a step, behind the stages push, solve and infer. */
void jox_inspect_after_push(JoxInspection *inspection, const JoxAgents *agents,
                            const JoxForces *forces);
void jox_inspect_after_solve(JoxInspection *inspection, const JoxNav *nav, const JoxStep *step);
void jox_inspect_after_infer(JoxInspection *inspection, const JoxAgents *agents,
                             const JoxForces *forces);
/* Nobody has looked for a while: ends what is old. */
void jox_inspect_end_old(struct JoWorld *world);
void jox_inspection_free(JoxInspection *inspection);

#endif
