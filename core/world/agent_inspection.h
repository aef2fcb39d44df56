/* Inspection of agents for display: their half-planes, the parts of their net force, their
   transitions. The stages write it for up to JOX_MOST_INSPECTED agents; no step reads it. */
#ifndef JOX_WORLD_AGENT_INSPECTION_H
#define JOX_WORLD_AGENT_INSPECTION_H

#include "force/force.h"
#include "machine/run.h"
#include "nav/nav.h"

enum { JOX_MOST_INSPECTED = 16 };

/* Parts of a net force, N, that add up to it: one per term, and parts separated from a term. */
typedef enum JoxForcePart {
    JOX_FORCE_PART_body,         /* separated from contact: bodies, and hits by fast ones */
    JOX_FORCE_PART_deceleration, /* separated from inferred: equation 8 */
#define PART(X, keep, role, name, label) JOX_FORCE_PART_##name,
    JOX_FORCE_TERMS(PART, ) JOX_FORCE_PARTS
#undef PART
} JoxForcePart;
extern const char *const jox_force_part_names[JOX_FORCE_PARTS];

typedef struct JoxInspected {
    uint32_t slot, id;
    uint32_t asked; /* tick of the last call of jox_world_inspect */
    bool seen;      /* the members below are known: of the last step, or of the present state */
    JoxConstraint planes[JOX_MOST_CONSTRAINTS];
    uint32_t plane_count;
    JoxV2 forces[JOX_FORCE_PARTS];
    JoxV2 summed;            /* N: net force before hits of fast bodies */
    JoxV2 slowed;            /* N: part of the inferred force by equation 8 */
    JoxV2 preferred, chosen; /* m/s */
    float speed_limit;       /* m/s */
    bool failed;
} JoxInspected;

/* Zero-initialise. */
typedef struct JoxInspection {
    JoxInspected agents[JOX_MOST_INSPECTED];
    JoxWatched watched[JOX_MOST_INSPECTED]; /* the same agents' transitions */
    uint32_t count;
} JoxInspection;

struct JoWorld;
/* Returns the inspection of the agent in a slot, and in *watched its transitions. Begins one if
   there is none, in place of the one asked for longest ago: it holds what the agent would choose in
   the present state, or is not `seen` if the agent was not in the last step or the world was
   restored since. NULL if the slot is empty, or if its inspected agent left, which ends the
   inspection. */
JoxInspected *jox_world_inspect(struct JoWorld *world, uint32_t slot, const JoxWatched **watched);
/* Write what the stages push, solve and infer of a step did. */
void jox_inspect_after_push(JoxInspection *inspection, const JoxAgents *agents,
                            const JoxForces *forces);
void jox_inspect_after_solve(JoxInspection *inspection, const JoxNav *nav, const JoxStep *step);
void jox_inspect_after_infer(JoxInspection *inspection, const JoxAgents *agents,
                             const JoxForces *forces);
/* Ends inspections that were not asked for in a while. */
void jox_inspect_end_old(struct JoWorld *world);
void jox_inspection_free(JoxInspection *inspection);

#endif
