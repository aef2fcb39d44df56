/* The nine stages of a step. Each is given what it may touch, and nothing else: what it reads is
   const in its context, what it writes is not. step.c fills the contexts from the world. */
#ifndef JOX_WORLD_STAGES_H
#define JOX_WORLD_STAGES_H

#include "agents/step.h"
#include "body/body.h"
#include "force/force.h"
#include "geom/hands.h"
#include "machine/run.h"
#include "nav/nav.h"
#include "world/agent_inspection.h"
#include "world/dragged_bodies.h"
#include "world/routes/routes.h"
#include "world/statistics.h"
#include "world/step_events/step_events.h"

/* A step longer than people plan ahead is done in equal substeps; think and observe run once. The
   world fills it once a substep. */
typedef struct JoxSubstep {
    bool first, last, only; /* only: the step is not divided */
    uint32_t plan_every;    /* substeps, from plan to plan */
    double end;             /* s: simulated time at its end */
    JoxStep step;           /* what nav and force are given; keeps the timing until the next */
} JoxSubstep;

typedef struct JoxPerceiveStage {
    const JoxSubstep *substep;
    uint64_t tick;
    bool timed;
    JoxPool *pool;
    JoxBodies *bodies; /* their objects are told, nothing is changed */
    JoxNav *nav;
    JoxAgents *agents; /* their order; search_radius, density, failed */
    JoxNeighbours *neighbours;
    JoxObjects *objects;
    JoxStatistics *statistics;
} JoxPerceiveStage;
void jox_stage_perceive(const JoxPerceiveStage *stage);

typedef struct JoxThinkStage {
    const JoxSubstep *substep;
    JoxPool *pool;
    const JoxRouteStage *route;
    JoxMachineRun *machines; /* which says what machines read and write */
    JoxStatistics *statistics;
} JoxThinkStage;
void jox_stage_think(const JoxThinkStage *stage);

typedef struct JoxPreferStage {
    const JoxSubstep *substep; /* writes aim, walk, eager, course of those who walk by the law */
    bool literal;              /* then nobody walks by the law */
    JoxNav *nav;               /* its grid of walls */
    JoxMachineRun *machines;   /* which says what machines read and write */
    JoxStatistics *statistics;
} JoxPreferStage;
void jox_stage_prefer(const JoxPreferStage *stage);

typedef struct JoxPushStage {
    /* Writes the agents' push, contact, force, plane, disc, compression, load, contacts; ext is
       used up. */
    const JoxSubstep *substep;
    bool literal;                  /* forces as the paper prints them */
    bool forces;                   /* else people feel none */
    JoxNav *nav;                   /* its grid of walls */
    const JoxMachineRun *machines; /* who pushes, and whereto */
    JoxForces *forces_of;
    JoxInspection *inspection;
} JoxPushStage;
void jox_stage_push(const JoxPushStage *stage);

typedef struct JoxSolveStage {
    const JoxSubstep *substep;  /* writes the agents' next, failed */
    const JoxForces *forces_of; /* totals of the contact solve */
    JoxNav *nav;
    JoxInspection *inspection;
    JoxStatistics *statistics;
} JoxSolveStage;
void jox_stage_solve(const JoxSolveStage *stage);

typedef struct JoxMoveStage {
    const JoxSubstep *substep; /* writes the agents' position, velocity, prev, still */
    JoxNav *nav;
    JoxV2 *walked; /* per agent, m: during the substeps so far; only where there are several */
} JoxMoveStage;
void jox_stage_move(const JoxMoveStage *stage);

/* People as fast bodies meet them, and their indices. Scratch. */
typedef struct JoxDiscList {
    JoxDisc *discs;
    uint32_t *agents;
    uint32_t capacity;
} JoxDiscList;

typedef struct JoxBodyStage {
    const JoxSubstep *substep;
    bool forces;
    double gravity; /* m/s2 */
    const JoxNeighbours *neighbours;
    const JoxObjects *objects;     /* as they were before the step */
    const JoxMachineRun *machines; /* kicks, and what is picked up and thrown */
    JoxForces *forces_of;          /* whose impulses on bodies are sorted */
    JoxDiscList *discs;
    JoxHands *hands;   /* scratch */
    JoxAgents *agents; /* velocity, force, compression, contacts of those who are hit */
    JoxBodies *bodies;
    JoxDrags *drags;
    JoxStatistics *statistics;
    JoxBodyGone *lost;      /* becomes the first that is lost in this substep, if any is */
    JoxDriveLoad *overload; /* likewise of driven bodies that met limits at which the world ends */
    JoxStepEvents *step_events; /* hits and breaks, for those who ask */
} JoxBodyStage;
void jox_stage_bodies(const JoxBodyStage *stage);
/* Its steps: bodies that are picked up, carried and thrown; forces on those that are dragged; who
   is before a bonded body or touches it; the step of the bodies with what they do to people; what
   broke. */
void jox_stage_carry_bodies(const JoxBodyStage *stage);
void jox_stage_drag_bodies(const JoxBodyStage *stage);
void jox_stage_note_bond_touch(const JoxBodyStage *stage);
JoxBodiesReport jox_stage_step_bodies(const JoxBodyStage *stage);
void jox_stage_note_bond_breaks(const JoxBodyStage *stage, const JoxBodiesReport *report);

typedef struct JoxInferStage {
    bool forces;
    JoxForces *forces_of;
    JoxAgents *agents; /* inferred */
    JoxInspection *inspection;
} JoxInferStage;
void jox_stage_infer(const JoxInferStage *stage);

/* Where those stood who left of their own accord in the last step, m. */
typedef struct JoxDepartures {
    JoxV2 *items;
    uint32_t count;
    size_t capacity;
} JoxDepartures;

typedef struct JoxObserveStage {
    const JoxSubstep *substep;
    uint64_t tick;
    double dt; /* s, of the whole step */
    const JoxNeighbours *neighbours;
    const JoxV2 *walked;
    JoxAgents *agents; /* prev; those who leave are taken out */
    JoxDepartures *departures;
    JoxStatistics *statistics;
} JoxObserveStage;
void jox_stage_observe(const JoxObserveStage *stage);

#endif
