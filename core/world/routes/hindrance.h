/* Finds what keeps an agent from a place: walls, a gap, a body or a gate. Called between steps, by
   checks and for display; never in a step, as it makes fields at once. */
#ifndef JOX_WORLD_HINDRANCE_H
#define JOX_WORLD_HINDRANCE_H

#include "world/routes/routes.h"

typedef enum JoxHindranceKind {
    JOX_HINDRANCE_NONE,
    JOX_HINDRANCE_WALL,   /* walls that never open */
    JOX_HINDRANCE_NARROW, /* every gap between such walls is narrower than the person */
    JOX_HINDRANCE_FILLED, /* a body that nothing moves */
    JOX_HINDRANCE_GATE,   /* a closed gate */
    JOX_HINDRANCE_BODY,   /* a body that is driven, or can be pushed */
    JOX_HINDRANCE_KINDS
} JoxHindranceKind;

typedef struct JoxHindrance {
    JoxHindranceKind kind;
    uint32_t by; /* GATE: ring of all_walls; FILLED, BODY: id of the body; else UINT32_MAX */
    JoxV2 at; /* m: NARROW: where the way is cut; GATE: middle of the gate; FILLED, BODY: middle of
                 the body; WALL: the given point */
} JoxHindrance;

/* Returns the ring of the closed gate on which a point or line lies, by which no agent leaves while
   it is closed; UINT32_MAX: none. */
uint32_t jox_hindrance_find_gate(const JoxRouteStage *stage, uint32_t place);

/* Returns the width of the narrowest gap through which an agent of a radius squeezes, m. */
float jox_hindrance_narrowest(float radius);

/* Fields to one place, made as needed. */
typedef struct JoxHindrances JoxHindrances;

/* Creates it for one place. The stage and what it points to must outlive it unchanged. Bodies are
   where routes saw them last. `opening`: by ring of all_walls, whether something opens that gate;
   NULL: none. */
JoxHindrances *jox_hindrances_create(const JoxRouteStage *stage, uint32_t place,
                                     const bool *opening);
void jox_hindrances_free(JoxHindrances *hindrances);
/* Finds what keeps an agent of `radius` m at a point from the place; a gate that nothing opens if
   every way has one. Agents squeeze through gaps of 1.4 radii and through none below 1.2; radii are
   rounded down to 0.02 m. */
JoxHindrance jox_hindrances_find(JoxHindrances *hindrances, JoxV2 from, float radius);
/* Returns the kind alone, without tracing the way; GATE for BODY too. */
JoxHindranceKind jox_hindrances_kind(JoxHindrances *hindrances, JoxV2 from, float radius);

#endif
