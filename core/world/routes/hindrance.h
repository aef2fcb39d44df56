/* What keeps people from a place: walls, a gap, a body or a gate. Asked between steps, by checks
   and by those who watch a run; a step never asks, as fields are made at once. */
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
    JoxV2 at;    /* m: of NARROW where the way is cut, of GATE its middle, of FILLED and BODY the
                    body's    middle, of WALL the person's point */
} JoxHindrance;

/* Ring of the closed gate on which a place lies that is a point or a line: nobody leaves there
   while it is closed. UINT32_MAX: none. */
uint32_t jox_hindrance_find_gate(const JoxRouteStage *stage, uint32_t place);

/* The fields to one place, made as they are needed. */
typedef struct JoxHindrances JoxHindrances;

/* The stage and what it points to outlive it and do not change. Bodies are taken as routes saw them
   last. `opening`: by ring of all_walls, whether it is a gate that something opens; NULL: none. */
JoxHindrances *jox_hindrances_create(const JoxRouteStage *stage, uint32_t place,
                                     const bool *opening);
void jox_hindrances_free(JoxHindrances *hindrances);
/* What keeps a person of `radius` m at a point from the place; of gates, one that nothing opens
   where every way leads through such. People squeeze through gaps of 1.4
   radii and through none of less than 1.2; radii are rounded down to 0.02 m. */
JoxHindrance jox_hindrances_find(JoxHindrances *hindrances, JoxV2 from, float radius);
/* Its kind alone, without tracing the way; GATE stands for BODY, too. */
JoxHindranceKind jox_hindrances_kind(JoxHindrances *hindrances, JoxV2 from, float radius);

#endif
