/* Figures gathered while a world steps; whole counts, so that they do not depend on threads. The
   stages write them; run reports them. */
#ifndef JOX_WORLD_STATISTICS_H
#define JOX_WORLD_STATISTICS_H

#include <math.h>
#include <stdbool.h>

#include "agents/agents.h"
#include "agents/neighbours.h"
#include "base/clock.h"
#include "jostle.h"

enum { JOX_OVERLAP_BINS = 1000 };
#define JOX_OVERLAP_DEPTH 0.5f /* m: overlaps up to here are told apart */

typedef enum JoxStage {
    JOX_STAGE_PERCEIVE,
    JOX_STAGE_THINK,
    JOX_STAGE_PREFER,
    JOX_STAGE_PUSH,
    JOX_STAGE_SOLVE,
    JOX_STAGE_MOVE,
    JOX_STAGE_BODIES,
    JOX_STAGE_INFER,
    JOX_STAGE_OBSERVE
} JoxStage;

/* Momentum exchanged between agents and bodies by contacts and hits, in the plane; checks what
   agents get against the change of the momentum of the bodies in Bullet. */
typedef struct JoxExchange {
    uint64_t contacts;
    double impulse;  /* sum of magnitudes, N s */
    double residual; /* sum over the steps of the magnitude of what does not cancel, N s */
    /* m/s: sums over the hits by fast bodies of the magnitudes of changes of velocity. */
    double body_change, person_change;
} JoxExchange;

/* Bonds between blocks of bodies. */
typedef struct JoxBondStatistics {
    uint64_t broken;
    uint32_t pieces;    /* bodies that breaks made */
    double first_s;     /* s: when the first broke */
    uint32_t rows;      /* then: rows of agents that press, the first on the body, each on the one
                           before, each at least half as many as in the first */
    uint32_t people;    /* then: agents in all rows */
    bool touched;       /* an agent touched a bonded body */
    double touch_s;     /* s: when one first did */
    double front_speed; /* before: mean speed of agents within 0.3 m of it, over a second, m/s */
    uint32_t front;     /* before: most agents within 0.3 m of it */
} JoxBondStatistics;

/* Forces of driven bodies on agents that they move towards. */
typedef struct JoxDriveStatistics {
    uint64_t held_up; /* times a body met its force limit that it had not met in the step before */
    double force;     /* N: greatest force of one body on all agents that it pressed */
    double at_s;      /* s: when that was */
    uint32_t body;    /* id of that body */
    uint32_t people;  /* agents that it pressed then */
    double hardest;   /* N: greatest part on one of them */
    uint32_t inside;  /* most agents at a time with their centre in driven bodies */
} JoxDriveStatistics;

typedef struct JoxStatistics {
    uint64_t steps, agent_steps;
    double stage_s[JO_STAGE_COUNT]; /* wall time */
    double bullet_s;                /* part of that: steps of Bullet */
    double objects_s;               /* part of that: listing bodies for agents */
    double enter_s, leave_s;        /* wall time before the stages, and after them */
    double collect_s;               /* wall time of a scene's listeners */
    double wall_s, cpu_s;           /* time of stepping; CPU time of the process in it */
    uint64_t failures;              /* agent-steps whose 2-D program was infeasible */
    double failure_peak;            /* greatest share of a second's agent-steps */
    uint64_t turned_aside;          /* agent-steps in which the wanted velocity was turned aside */
    uint64_t plans_bounded;         /* agent-steps whose contacts or force asked for more than is
                                       within reach */
    uint64_t parts_left_out;        /* agent-steps, in literal mode, without half-planes for some
                                       parts of bodies that might have mattered */
    uint64_t second_failures, second_agent_steps;
    uint64_t walls_relaxed;  /* agent-steps in which a wall's half-plane was relaxed */
    uint64_t contact_passes; /* passes of the contact solve, over all steps */
    double contact_residual; /* N: greatest change of a force in a last pass */
    uint64_t transitions, kicks, throws, pickups, spawned, removed, hits;
    uint64_t falls, most_fallen; /* falls of agents; most agents that lay at a time */
    uint64_t dropped;            /* carried bodies that fell for want of room */
    uint64_t shifted_at_birth;   /* agents born on a free spot near their point */
    uint64_t born_in_others;     /* agents whose torso was deep in another as they came in */
    double deepest_birth;        /* m: most of these depths */
    uint64_t not_placed;         /* births without a free spot */
    uint64_t most_without_spot;  /* most agents at a time that waited for room at their goal */
    uint64_t most_without_way;   /* most agents at a time whose target no way leads to */
    uint64_t moved_out, not_moved_out;  /* agents in new walls: moved; without a free spot */
    uint64_t people_lost, bodies_lost;  /* found by number_guard.c */
    uint64_t opened, closed, announced; /* gates, and signals to all agents */
    /* Agents by their deepest overlap, as a share of their depth (a disc's diameter), in bins of
       0.1 %; and those that overlap anyone by that overlap in m, in bins of 0.5 mm. Sampled once a
       simulated second. */
    uint64_t overlap[JOX_OVERLAP_BINS], overlap_depth[JOX_OVERLAP_BINS];
    uint64_t overlap_samples, overlapping;
    JoxBondStatistics bonds;
    JoxDriveStatistics drives;
    JoxExchange exchange;
} JoxStatistics;

/* Counts this step's failures and plan notes and, once a second, overlaps. `tick` counts from 0. */
void jox_statistics_observe(JoxStatistics *statistics, const JoxAgents *agents,
                            const JoxNeighbours *neighbours, uint64_t tick, double dt);
/* Returns a number of agent-steps as a share of all; NAN before the first. */
static inline double jox_statistics_share(const JoxStatistics *statistics, uint64_t agent_steps) {
    return statistics->agent_steps ? (double)agent_steps / (double)statistics->agent_steps
                                   : (double)NAN;
}
/* Returns the overlap below which 99 % of the sampled agents stay, as a share of their depth; NAN
   without samples, as in runs of less than a second. */
double jox_statistics_overlap_p99(const JoxStatistics *statistics);
/* Returns the overlap below which 99 % of the sampled agents that overlap anyone stay, m; 0 where
   none did, NAN without samples. Agents that stand apart do not count: how deep contacts are does
   not depend on them. */
double jox_statistics_depth_p99(const JoxStatistics *statistics);
/* Returns the share of sampled agents that overlap by more than a share of their depth; NAN without
   samples. */
double jox_statistics_overlap_share(const JoxStatistics *statistics, double over);

#endif
