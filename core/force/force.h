/* Forces between people, and between people and bodies: equations 5 to 12 of the paper. Every stage
   reads the agents as they stand and writes its own columns; what one agent gives another is
   collected and then summed by the receiver in ascending id of the giver, so that neither threads
   nor the order in memory change a bit. In a step the calls are, in this order: begin, push,
   contact, sum, (solve, move), infer. */
#ifndef JOX_FORCE_FORCE_H
#define JOX_FORCE_FORCE_H

#include <stdbool.h>
#include <stdint.h>

#include "agents/agents.h"
#include "agents/contact_planes.h"
#include "agents/neighbours.h"
#include "geom/objects.h"
#include "geom/wall_grid.h"
#include "geom/wall_images.h"
#include "jostle.h"
#include "task/pool.h"
#include "task/stage_memory.h"

typedef struct JoxForces JoxForces;

typedef struct JoxForceOptions {
    bool literal; /* as printed in the paper, in place of the physical reading */
    bool react;   /* pushers feel the reaction of their pushes; otherwise the ground takes it */
    uint32_t iterations; /* most passes over the contacts of a step, physical mode */
    float tolerance;     /* N: passes end when none changes a contact force by more */
    float reach;         /* gap over which a braced person passes a force on, m; physical mode */
    float filter;        /* time over which passed-on forces arrive, s; 0 at once; physical mode */
    float least;         /* |f|/m below which no half-plane is made, m/s2 */
} JoxForceOptions;

/* What a step works on. Everything but `agents`, `neighbours` and `dt` may be left zero. It must
   stay valid, and the order of the agents the same, from begin to infer. The neighbours' distances
   are those of the agents' positions until the move. */
typedef struct JoxForceStep {
    JoxAgents *agents;
    const JoxNeighbours *neighbours;
    const JoxObjects *objects;
    const JoxWallGrid *walls; /* as far as jox_nav_touching_walls serves; NULL: none */
    const float *clear2; /* m2: no wall hides who is nearer, until people move; NULL: unknown */
    JoxPool *pool;
    double time; /* s: simulated, at the beginning of the step */
    uint64_t seed;
    bool turning;         /* people turn their shoulders among others: where contacts are solved */
    double dt;            /* s, above 0 */
    double planning_time; /* s: how far ahead velocities are planned; 0: dt */
    double response;      /* share of the way to the planned velocity gone in dt; 0: all */
    double interval; /* s: between plans of those who are not pressed where they stand; 0: dt */
    double interval_response; /* the share gone in that time */
    double interval_forced;   /* s: a force that acted so long at the interval's beginning, all at
                                 once,   would have the effect at its end that it has step by step; 0:
                                 interval */
    const uint8_t *push_on;   /* per agent, 0: does not push now; NULL: all push */
    const uint8_t
        *push_nearest; /* per agent, 1: the whole push goes to the nearest; NULL: shared */
    /* Direction of the push per agent, of any length; (0, 0) or NULL: the preferred velocity. */
    const float *push_toward_x, *push_toward_y;
} JoxForceStep;

typedef struct JoxForceTotals {
    uint32_t pushers; /* agents that pushed something this step */
    uint32_t pairs;   /* overlapping pairs of agents */
    uint32_t touches; /* contacts of agents with bodies */
    uint32_t inside;  /* agents whose middle is in a driven body */
    uint32_t passed;  /* forces passed on by the last infer */
    uint32_t passes;  /* over the contacts */
    float residual;   /* N: by which the last pass still changed a contact force */
    /* Momentum of the step's pushes that came from the ground, N s: zero with `react`. */
    double ground_x, ground_y;
    /* N s: given to moving bodies by pushes; given to agents by contacts with such bodies, and the
       sum of the sizes of these. */
    double pushed_x, pushed_y, touched_x, touched_y, touched;
} JoxForceTotals;

JoxForceOptions jox_force_default_options(void);
JoxForces *jox_forces_create(const JoxForceOptions *options);
void jox_forces_free(JoxForces *forces);
void jox_forces_set_options(JoxForces *forces, const JoxForceOptions *options);
/* The instruction set of the kernels, which changes no result; at first the widest that runs. */
void jox_forces_set_isa(JoxForces *forces, JoIsa isa);

/* Memory that push, from jox_force_begin on, shares with other stages; at first its own. */
void jox_forces_set_memory(JoxForces *forces, JoxStageMemory *memory);

/* The walls whose loads are told, and their images beyond joined edges, which count for them; not
   copied; call again when they change. NULL: none. */
void jox_forces_set_walls(JoxForces *forces, const JoxWalls *walls, const JoxWallImages *images);
/* The greatest gap over which a braced person passes a force on, m. */
float jox_force_passing_reach(const JoxForces *forces);
/* Lists what outlasts a step: the impulses from which the next solve of contacts starts. */
void jox_forces_sections(JoxForces *forces, JoxSections *sections);

/* Starts a step: push, contact, compression, load and contacts become zero, the impulses empty. */
void jox_force_begin(JoxForces *forces, const JoxForceStep *step);
/* Equation 5: push_x, push_y of those that are pushed; impulses on bodies. */
void jox_force_push(JoxForces *forces);
/* Equations 6 and 7: contact_x, contact_y, contacts, compression, load; impulses on bodies. In
   physical mode all contacts with people, walls and bodies are solved together, from the
   velocities that the other forces give. */
void jox_force_contact(JoxForces *forces);
/* Equations 10 to 12: force_x, force_y, half_plane_x, half_plane_y, half_plane_offset, speed_limit.
   The limit is `max_speed`; only a contact impulse raises it, to the speed that it gives. Keeps the
   velocities for infer. Begin and sum alone give a step without forces. */
void jox_force_sum(JoxForces *forces);
/* The half-planes of what agents touch, from sum to the next begin; none in the mode literal. */
const JoxContactPlanes *jox_force_contact_planes(const JoxForces *forces);
/* Impulses of the contacts that the last step solved, in ascending ids: between agents, of agents
   with walls (edges) and with bodies (rows). */
typedef enum { JOX_KEPT_PAIRS, JOX_KEPT_WALLS, JOX_KEPT_TOUCHES } JoxKeptKind;
const struct JoxKeptImpulse *jox_force_kept(const JoxForces *forces, JoxKeptKind kind,
                                            size_t *count);
/* What each piece of the walls bears, from contact to the next begin. */
const JoxWallLoad *jox_force_wall_loads(const JoxForces *forces, uint32_t *count);
/* Equations 8 and 9, once vx, vy hold the new velocities: inferred_x, inferred_y. */
void jox_force_infer(JoxForces *forces);

/* Of the agent that had an index in the step: the contact force of bodies, N, between contact and
 * the next begin. */
JoxV2 jox_force_of_bodies(const JoxForces *forces, uint32_t agent);
/* And what infer has just added to its inferred force for the slowing of others (equation 8; the
   rest is equation 9), N; *kept: the share that it has kept of what was there before. */
JoxV2 jox_force_slowed(const JoxForces *forces, uint32_t agent, float *kept);

/* What a driven body under way presses people with whom it moves towards, in the last contact. */
typedef struct JoxDriveLoad {
    uint32_t row;
    uint32_t people, agent; /* so many; id of who bears most of it, JOX_NO_INDEX: nobody */
    float force, hardest;   /* N: of all, along its way; what that one bears */
    float share;            /* of its way that it goes: less than 1 only where it met its limit */
    bool met;
} JoxDriveLoad;
const JoxDriveLoad *jox_force_drive_loads(const JoxForces *forces, uint32_t *count);

/* The step's impulses on bodies, sorted by agent id, then by row; pushes before contacts. Valid
   until the next begin. */
const JoxImpulse *jox_force_impulses(JoxForces *forces, uint32_t *count);
JoxForceTotals jox_force_totals(const JoxForces *forces);

#endif
