/* Contacts of a step: of agents with agents ("pairs"), walls and bodies ("touches"), and the
   impulses that keep them from moving into each other. contact/find*.c finds them, contact/layout.c
   lays them out, contact/solve.c solves them; contact/stage.c runs these in order. */
#ifndef JOX_FORCE_CONTACT_H
#define JOX_FORCE_CONTACT_H

#include "agents/agents.h"
#include "agents/contact_planes.h"
#include "agents/neighbours.h"
#include "geom/objects.h"
#include "geom/wall_grid.h"
#include "simd/four.h"

enum {
    JOX_NO_COLOUR = 255,           /* a contact that is left out */
    JOX_CONTACT_MOST_COLOURS = 64, /* most contacts of an agent with other agents */
    JOX_CONTACT_MOST_WALLS = 6     /* most edges that one agent touches at a time */
};

/* A contact that an agent was found to have; the normal points to the agent. One of the two agents
   finds a contact between them. */
typedef struct JoxFoundPair {
    uint32_t other, other_id;
    JoxV2 normal;
    float squeeze, target, mass; /* as in JoxPair */
} JoxFoundPair;
/* The part of a found pair that its layout needs, in few bytes: the other agent, its colour, and
   its number among the contacts of either agent. */
typedef struct JoxPairSlot {
    uint32_t other;
    uint8_t colour, first_end, second_end;
} JoxPairSlot;
typedef struct JoxFoundWall {
    uint32_t edge;
    JoxV2 normal;
    float gap, along; /* m; along: from the start of the edge */
} JoxFoundWall;

/* Data of an agent, other than its motion, that contacts need: one load fetches all of it. m,
   kg. */
typedef struct JoxBuild {
    float breadth, radius, mass;
    uint32_t id;
} JoxBuild;

/* A contact between two agents; the normal points to the first, which found it. Half a cache line,
   as every use reads all of it. */
typedef struct JoxPair {
    uint32_t first, second;
    JoxV2 normal;
    float target;  /* least normal velocity of the first relative to the second, m/s */
    float mass;    /* reduced mass, kg */
    float squeeze; /* N: force of turned shoulders, which overlap within the radii; added to the
                      impulse */
    float impulse; /* accumulated, not negative, N s */
} JoxPair;

/* For an agent with contacts: the number of its first contact in ascending order of ids, and the
   index of its first kept impulse (or that of the next agent that has some). */
typedef struct JoxListed {
    uint32_t pair, kept;
} JoxListed;

/* Contacts between agents, sorted by colour. No agent occurs twice in a colour, so that its
   contacts may be solved in any order, on any number of threads. */
typedef struct JoxPairs {
    uint32_t count, colours;
    uint32_t starts[JOX_CONTACT_MOST_COLOURS + 1]; /* first item of each colour */
    JoxPair *items;
    size_t capacity;
} JoxPairs;

/* A contact of an agent with an edge of a wall. */
typedef struct JoxWallContact {
    uint32_t agent, edge;
    JoxV2 normal;
    float along, target, impulse;
} JoxWallContact;

/* A contact of an agent with a body. A push on a body stores its force in `normal`. */
typedef struct JoxTouch {
    uint32_t agent, object;
    JoxV2 normal;
    JoxV3 point;
    float gap, target, mass, impulse; /* m, m/s, kg, N s */
    float before;                     /* N s: impulse before a pass */
    float ahead;   /* driven bodies: share of the body's speed that is towards the agent, 0 to 1 */
    int16_t drive; /* index of the body's drive, or -1 */
} JoxTouch;

/* A kinematic body that moves and touches agents (contact/bodies.c). */
typedef struct JoxDrive {
    uint32_t row;
    float speed;   /* m/s: greatest towards an agent that it touches, or of its centre */
    float most;    /* N s: greatest impulse per step */
    float pressed; /* N s: present impulse */
} JoxDrive;

/* One agent's end of a contact with another agent. */
typedef struct JoxEnd {
    uint32_t pair; /* index of the pair */
    uint32_t other;
} JoxEnd;

/* The impulse of a contact of the last step, from which the next solve starts, in ascending order
   of ids. `other`: id of an agent, number of an edge, or row of a body. */
typedef struct JoxKeptImpulse {
    uint32_t id, other;
    float impulse; /* N s */
} JoxKeptImpulse;
typedef struct JoxKeptImpulses {
    JoxKeptImpulse *items;
    size_t count, capacity;
} JoxKeptImpulses;

/* One direction of a contact between two bodies: lever and effect on each body of an impulse along
   it. The effect on a body that is not solved for is 0. */
typedef struct JoxSupportAxis {
    JoxFour along;                /* unit */
    JoxFour lever[2], turning[2]; /* m: arm x along; change of spin by 1 N s, 1/(kg m) */
    float inverse_mass[2];        /* 1/kg */
    float sway[2]; /* root of the speed that 1 N s gives the point along the axis, root of 1/kg */
    float mass, impulse; /* kg; impulse on the first body, N s */
} JoxSupportAxis;

/* A contact of a body with its support: solved along the normal and, for friction, across it. */
typedef struct JoxSupport {
    uint32_t rows[2];       /* indices of motions */
    float target, friction; /* m/s */
    JoxSupportAxis normal, across[2];
} JoxSupport;

/* Decides whether a support has to be solved again (support/solve.c). */
typedef struct JoxSupportWatch {
    uint32_t rows[2];
    float most_per_unrest[2]; /* greatest impulse per unrest of each body, root of kg */
    float tested_unrest[2];   /* unrest of each body when the support was tested last */
    float remaining;          /* N s: change that was left then */
} JoxSupportWatch;

/* Motion of a body while contacts are solved. */
typedef struct JoxBodyMotion {
    JoxFour velocity, spin;
    JoxV3 given, given_turn; /* by the agents that touch it, N s and N m s */
    float held;              /* share of `given` that its supports took */
    float unrest;            /* sum of all impulses times their sways: N s / root of kg */
    bool solved, touched;    /* solved: impulses change its motion; touched by agents */
    uint8_t link;            /* number of bodies between it and the nearest touched one */
} JoxBodyMotion;

#endif
