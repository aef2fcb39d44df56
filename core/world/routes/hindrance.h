/* Finds what keeps an agent from a place: walls, a gap, a body or a gate. Called between steps, by
   checks and for display; never in a step, as it makes fields at once. */
#ifndef JOX_WORLD_HINDRANCE_H
#define JOX_WORLD_HINDRANCE_H

#include "machine/lifts.h"
#include "world/routes/routes.h"

typedef enum JoxHindranceKind {
    JOX_HINDRANCE_NONE,
    JOX_HINDRANCE_WALL,     /* walls that never open */
    JOX_HINDRANCE_NARROW,   /* every gap between such walls is narrower than the person */
    JOX_HINDRANCE_FILLED,   /* a body that nothing moves */
    JOX_HINDRANCE_GATE,     /* a closed gate */
    JOX_HINDRANCE_BODY,     /* a body that is driven, or can be pushed */
    JOX_HINDRANCE_LIFT,     /* a lift that is out of use */
    JOX_HINDRANCE_STAIRS,   /* only stairs lead there, which it cannot use */
    JOX_HINDRANCE_NO_LIFTS, /* only lifts lead there, which it does not take */
    JOX_HINDRANCE_KINDS
} JoxHindranceKind;

typedef struct JoxHindrance {
    JoxHindranceKind kind;
    uint32_t by; /* GATE: ring of all_walls; FILLED, BODY: id of the body; LIFT: its index; else
                    UINT32_MAX */
    JoxV2 at; /* m: NARROW: where the way is cut; GATE: middle of the gate; FILLED, BODY: middle of
                 the body; LIFT: before its door; else the given point */
} JoxHindrance;

/* Agent that is kept from a place, or what one would be. */
typedef struct JoxKept {
    JoxV2 at;     /* m */
    float radius; /* m */
    JoxAgentWays ways;
} JoxKept;
/* Returns the same of an agent. */
JoxKept jox_hindrance_of_agent(const JoxAgents *agents, uint32_t index);

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
/* Finds what keeps an agent from the place; a gate that nothing opens if every way has one. Ways
   lead over stairs and by lifts, as far as the agent takes these. Agents squeeze through gaps
   of 1.4 radii and through none below 1.2; radii are rounded down to 0.02 m. */
JoxHindrance jox_hindrances_find(JoxHindrances *hindrances, const JoxKept *kept);
/* Returns the kind alone, without tracing the way; GATE for BODY too. */
JoxHindranceKind jox_hindrances_kind(JoxHindrances *hindrances, const JoxKept *kept);

#endif
