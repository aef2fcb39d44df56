/* Forces between agents, and between agents and bodies: equations 5 to 12 of the paper.
   world/step.c calls the stages in this order: begin, push, contact, sum, (solve and move of nav),
   infer. Each stage reads the agents and writes columns of its own; forces between agents are
   collected, then summed by the receiver in ascending id of the giver, so that neither threads nor
   the order in memory change a bit. The stages are in the rooms below this folder (README.md). */
#ifndef JOX_FORCE_FORCE_H
#define JOX_FORCE_FORCE_H

#include <stdbool.h>
#include <stdint.h>

#include "agents/step.h"
#include "geom/objects.h"
#include "geom/wall_grid.h"
#include "geom/wall_images.h"
#include "jostle.h"
#include "task/pool.h"
#include "task/stage_memory.h"

typedef struct JoxForces JoxForces;

typedef struct JoxForceOptions {
    bool literal; /* as printed in the paper, instead of the physical reading */
    bool react;   /* pushers feel the reaction to their pushes; otherwise the ground takes it */
    uint32_t iterations; /* physical mode: most passes over the contacts of a step */
    float tolerance;     /* N: passes end when none changes a contact force by more */
    float friction;      /* physical mode: coefficient, of torsos on each other and on walls */
    float reach;         /* physical mode: gap over which a bracing agent passes a force on, m */
    float filter;        /* physical mode: time over which passed-on forces arrive, s; 0: at once */
    float least;         /* m/s2: least |f|/m that makes a half-plane */
} JoxForceOptions;

/* Further inputs of a step, for begin. All may be zero. It must stay valid from begin to infer.
   Whole packets are read past the last agent of each column, as of those of JoxAgents. */
typedef struct JoxForceInputs {
    const JoxWallGrid *walls; /* grid that jox_nav_touching_walls returns; NULL: no walls */
    const float *unhidden2;   /* m2, before agents move: no wall hides neighbours nearer than this;
                                 NULL: unknown */
    const uint8_t *push_on;   /* per agent, 0: does not push now; NULL: all may push */
    const uint8_t *push_nearest; /* per agent, 1: pushes the nearest target only; NULL: all */
    /* Direction of the push per agent, of any length; (0, 0) or NULL: the preferred velocity. */
    const float *push_toward_x, *push_toward_y;
} JoxForceInputs;

typedef struct JoxForceTotals {
    uint32_t pushers; /* agents that pushed something this step */
    uint32_t pairs;   /* overlapping pairs of agents */
    uint32_t touches; /* contacts of agents with bodies */
    uint32_t inside;  /* agents whose centre is in a driven body */
    uint32_t passed;  /* forces that the last infer passed on */
    uint32_t passes;  /* over the contacts */
    float residual;   /* N: greatest change of a contact force in the last pass */
    /* N s: momentum of the step's pushes, whose reaction the ground takes; zero with the option
       `react`, as pushers then take it */
    double ground_x, ground_y;
    /* N s: given to moving bodies by pushes; given to agents by contacts with such bodies, and the
       sum of the magnitudes of that. */
    double pushed_x, pushed_y, touched_x, touched_y, touched;
} JoxForceTotals;

JoxForceOptions jox_force_default_options(void);
/* Makes the forces of one world, with `options` or, at NULL, the default ones. They own the memory
   of all stages, except what jox_forces_set_memory lends; it grows to its peak and stays until
   jox_forces_free. */
JoxForces *jox_forces_create(const JoxForceOptions *options);
void jox_forces_free(JoxForces *forces);
void jox_forces_set_options(JoxForces *forces, const JoxForceOptions *options);
/* Sets the instruction set of the kernels, which changes no result. Default: the widest that
   runs. */
void jox_forces_set_isa(JoxForces *forces, JoIsa isa);

/* Sets the memory that the stages share with other ones from jox_force_begin on. Default: its
   own. */
void jox_forces_set_memory(JoxForces *forces, JoxStageMemory *memory);

/* Sets the walls whose loads are measured, and their images beyond joined edges, which count for
   them. They are not copied; call it again when they change. NULL: none. */
void jox_forces_set_walls(JoxForces *forces, const JoxWalls *walls, const JoxWallImages *images);
/* Returns the greatest gap over which a bracing agent passes a force on, m. */
float jox_force_passing_reach(const JoxForces *forces);
/* Lists the state that outlasts a step: the impulses from which the next contact solve starts. */
void jox_forces_sections(JoxForces *forces, JoxSections *sections);

/* Starts a step: zeroes push, contact, compression, load and contacts, and empties the impulses.
   What `step` and `inputs` point to must stay valid, and the agents keep their order, until
   infer. */
void jox_force_begin(JoxForces *forces, const JoxStep *step, const JoxForceInputs *inputs);
/* Equation 5: writes push_x, push_y of the agents that are pushed, and impulses on bodies. */
void jox_force_push(JoxForces *forces);
/* Equations 6 and 7: writes contact_x, contact_y, contacts, compression, load, and impulses on
   bodies. In physical mode all contacts with agents, walls and bodies are solved together, from the
   velocities that the other forces give. */
void jox_force_contact(JoxForces *forces);
/* Equations 10 to 12: writes force_x, force_y, half_plane_x, half_plane_y, half_plane_offset,
   speed_limit. The limit is `max_speed`; only contact impulses raise it, to the speed that they
   give. Keeps the velocities for infer. Begin and sum alone make a step without forces. */
void jox_force_sum(JoxForces *forces);
/* Called once velocities are planned: where people have torsos, writes borne_x, borne_y, by which
   contacts keep the plans of agents from pressing their bodies into each other, likewise changes
   their spin, and writes parted_x, parted_y and parted_spin, by which bodies that overlap part;
   that moves them within the step, but is no velocity, which would add energy. */
void jox_force_bear(JoxForces *forces);
/* Returns the half-planes of contacts, valid from sum to the next begin; none in literal mode. */
const JoxContactPlanes *jox_force_contact_planes(const JoxForces *forces);
/* Returns the impulses of the contacts that the last step solved, in ascending order of ids:
   between agents, of agents with walls (edges) or with bodies (rows). */
typedef enum { JOX_KEPT_PAIRS, JOX_KEPT_WALLS, JOX_KEPT_TOUCHES } JoxKeptKind;
/* `other`: id of an agent, number of an edge, or row of a body. */
typedef struct JoxKeptImpulse {
    uint32_t id, other;
    float impulse; /* N s */
    float borne,
        parted; /* N s, by which torsos bear plans and part (jox_force_bear); 0 of bodies */
} JoxKeptImpulse;
const JoxKeptImpulse *jox_force_kept_impulses(const JoxForces *forces, JoxKeptKind kind,
                                              size_t *count);
/* Returns the load of each piece of the walls, from contact to the next begin. */
const JoxWallLoad *jox_force_wall_loads(const JoxForces *forces, uint32_t *count);
/* Equations 8 and 9, called once vx, vy hold the new velocities: writes inferred_x, inferred_y. */
void jox_force_infer(JoxForces *forces);

/* Returns the contact force of bodies on the agent that had an index in the step, N; valid between
   contact and the next begin. */
JoxV2 jox_force_of_bodies(const JoxForces *forces, uint32_t agent);
/* Returns the part of that agent's inferred force, N, that infer has just added for the slowing of
   others (equation 8; the rest is equation 9); *remaining: share of the previous force that the
   filter leaves. */
JoxV2 jox_force_from_slowing(const JoxForces *forces, uint32_t agent, float *remaining);

/* Load of a driven body on the agents in its way, in the last contact. */
typedef struct JoxDriveLoad {
    uint32_t row;
    uint32_t people, agent; /* number of agents; id of the most loaded, or JOX_NO_INDEX */
    float force, hardest;   /* N: on all, along the body's way; on that one */
    float share; /* share of its way that the body goes: below 1 only where it reached its limit */
    bool met;
} JoxDriveLoad;
const JoxDriveLoad *jox_force_drive_loads(const JoxForces *forces, uint32_t *count);

/* Returns the step's impulses on bodies, sorted by agent id, then row, pushes before contacts.
   Valid until the next begin. */
const JoxImpulse *jox_force_impulses(JoxForces *forces, uint32_t *count);
JoxForceTotals jox_force_totals(const JoxForces *forces);

#endif
