/* The nine stages of a step, in their order. Each is a function over a context that holds all it
   may touch: const members are read, others written. step.c fills the contexts from the world and
   calls the stages once in each substep; the world owns all that contexts point to. */
#ifndef JOX_WORLD_STAGES_H
#define JOX_WORLD_STAGES_H

#include "agents/step.h"
#include "body/body.h"
#include "force/force.h"
#include "geom/hand_reach.h"
#include "machine/run.h"
#include "nav/nav.h"
#include "world/agent_inspection.h"
#include "world/dragged_bodies.h"
#include "world/routes/routes.h"
#include "world/statistics.h"
#include "world/step_events/step_events.h"

/* One of the equal substeps of a step that is longer than agents plan ahead; think runs in the
   first only, observe in the last only. The world fills it once a substep. */
typedef struct JoxSubstep {
    bool first, last, only; /* only: the step has this one substep */
    uint32_t plan_every;    /* steps from one plan to the next */
    double end;             /* s: simulated time at its end */
    bool fallen;            /* agents lie, who want and plan nothing */
    JoxStep step;           /* given to nav and force; keeps the timing until the next substep */
} JoxSubstep;

typedef struct JoxPerceiveStage {
    const JoxSubstep *substep;
    uint64_t tick;
    bool timed;
    JoxPool *pool;
    JoxBodies *bodies; /* read alone: writes `objects` from them */
    JoxNav *nav;
    JoxAgents *agents; /* sorted; writes search_radius, density, failed */
    JoxNeighbours *neighbours;
    JoxObjects *objects;
    JoxStatistics *statistics;
} JoxPerceiveStage;
void jox_stage_perceive(const JoxPerceiveStage *stage);

typedef struct JoxThinkStage {
    const JoxSubstep *substep;
    JoxPool *pool;
    const JoxRouteStage *route;
    JoxMachineRun *machines; /* machine/run.h says what it reads and writes */
    JoxStatistics *statistics;
} JoxThinkStage;
void jox_stage_think(const JoxThinkStage *stage);

typedef struct JoxPreferStage {
    const JoxSubstep *substep; /* writes aim, walk, eager, course of agents that walk by the law */
    bool literal;              /* the paper as printed: no agent walks by the walking law */
    JoxNav *nav;               /* reads its grid of walls */
    JoxMachineRun *machines;   /* machine/run.h says what it reads and writes */
    JoxStatistics *statistics;
} JoxPreferStage;
void jox_stage_prefer(const JoxPreferStage *stage);

typedef struct JoxPushStage {
    /* Writes the agents' push, contact, force, plane, disc, compression, load, contacts; clears
       ext. */
    const JoxSubstep *substep;
    bool literal;                  /* forces as the paper prints them */
    bool forces;                   /* false: agents feel no forces */
    JoxNav *nav;                   /* reads its grid of walls */
    const JoxMachineRun *machines; /* targets of pushes */
    JoxForces *forces_of;
    JoxInspection *inspection;
} JoxPushStage;
void jox_stage_push(const JoxPushStage *stage);

typedef struct JoxSolveStage {
    const JoxSubstep *substep; /* writes the agents' next, failed */
    JoxForces *forces_of;      /* totals of the contact solve */
    JoxNav *nav;
    JoxInspection *inspection;
    JoxStatistics *statistics;
} JoxSolveStage;
void jox_stage_solve(const JoxSolveStage *stage);

typedef struct JoxMoveStage {
    const JoxSubstep *substep; /* writes the agents' position, velocity, prev, still */
    JoxNav *nav;
    JoxV2 *walked; /* per agent, m: displacement in the substeps so far; if there are several */
} JoxMoveStage;
void jox_stage_move(const JoxMoveStage *stage);

/* Agents as upright cylinders that fast bodies may hit, and the index of each. Scratch. */
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
    const JoxObjects *objects;     /* as they were before the bodies move */
    const JoxMachineRun *machines; /* kicks; bodies that are picked up and thrown */
    JoxForces *forces_of;          /* impulses on bodies, loads of driven bodies */
    JoxDiscList *discs;
    JoxHands *hands;   /* scratch */
    JoxAgents *agents; /* velocity, force, compression, contacts of agents that are hit */
    JoxBodies *bodies;
    JoxDrags *drags;
    JoxStatistics *statistics;
    JoxBodyGone *lost;      /* set to the first body that is lost in this substep */
    JoxDriveLoad *overload; /* likewise: driven body that met a force limit that ends the world */
    JoxStepEvents *step_events; /* gets hits and breaks */
} JoxBodyStage;
void jox_stage_bodies(const JoxBodyStage *stage);
/* The parts of the stage bodies, in the order in which it calls them: picks up, carries and throws
   bodies; applies forces to dragged ones; notes agents before a bonded body until one touches it;
   exchanges impulses and steps Bullet; notes broken bonds. */
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

/* Positions, m, of the agents that left of their own accord in the last step. */
typedef struct JoxDepartures {
    JoxV2 *items;
    uint32_t count;
    size_t capacity;
} JoxDepartures;

typedef struct JoxObserveStage {
    const JoxSubstep *substep;
    uint64_t tick;
    double dt; /* s: length of the whole step */
    const JoxNeighbours *neighbours;
    const JoxV2 *walked;
    JoxAgents *agents; /* prev; removes agents that leave */
    JoxDepartures *departures;
    JoxStatistics *statistics;
} JoxObserveStage;
void jox_stage_observe(const JoxObserveStage *stage);

#endif
