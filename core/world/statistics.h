/* Figures gathered while a world steps: counts are exact, so they do not depend on threads. */
#ifndef JOX_WORLD_STATISTICS_H
#define JOX_WORLD_STATISTICS_H

#include <stdbool.h>

#include "agents/agents.h"
#include "agents/neighbours.h"
#include "base/clock.h"
#include "jostle.h"

enum { JOX_OVERLAP_BINS = 1000 };

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

/* Momentum that passes between people and bodies by contacts and hits, in the plane: what people
   are given against how the momentum of the bodies in Bullet changes. */
typedef struct JoxExchange {
    uint64_t contacts;
    double impulse;  /* sum of their sizes, N s */
    double residual; /* sum over the steps of the size of what does not cancel, N s */
} JoxExchange;

/* Of bonds between blocks. */
typedef struct JoxBondStatistics {
    uint64_t broken;
    uint32_t pieces; /* bodies that came of it */
    double first_s;  /* when the first broke */
    uint32_t rows;   /* then: rows that press, the first on the body, each on the one before; with
                        at least half as many people as the first */
    uint32_t people; /* then: in those chains */
    bool touched;    /* anybody touched a bonded body; the first time: */
    double touch_s;  /* when that was */
    double front_speed; /* before: mean speed of those within 0.3 m of it, over a second, m/s */
    uint32_t front;     /* and the most there were */
} JoxBondStatistics;

/* What driven bodies press people with whom they move towards. */
typedef struct JoxDriveStatistics {
    uint64_t
        held_up;   /* times that one met its force limit, which it had not met in the step before */
    double force;  /* N: the greatest, of all whom one pressed; then: */
    double at_s;   /* when that was */
    uint32_t body; /* its id */
    uint32_t people; /* whom it pressed */
    double hardest;  /* N: what one of them bore of it */
    uint32_t inside; /* most people at a time whose middle was in driven bodies */
} JoxDriveStatistics;

typedef struct JoxStatistics {
    uint64_t steps, agent_steps;
    double stage_s[JO_STAGE_COUNT]; /* wall time */
    double bullet_s;                /* of that, Bullet's own steps */
    double objects_s;               /* likewise, to tell agents of the bodies near them */
    double wall_s, cpu_s;           /* of stepping; CPU time of the process */
    uint64_t failures;              /* agent-steps whose 2-D program was infeasible */
    double failure_peak;            /* greatest share of a second's agent-steps */
    uint64_t second_failures, second_agent_steps;
    uint64_t walls_relaxed;  /* agent-steps in which a wall had to give */
    uint64_t contact_passes; /* of the solve of contacts, over all steps */
    double contact_residual; /* N: the most by which a last pass still changed a force */
    uint64_t transitions, kicks, throws, pickups, spawned, removed, hits;
    uint64_t dropped;                   /* bodies that their carriers had no room for any more */
    uint64_t shifted_at_birth;          /* to a free spot, out of walls or others */
    uint64_t not_placed;                /* who were to be born, and found no spot */
    uint64_t most_without_spot;         /* agents at a time that waited where there was no room */
    uint64_t moved_out, not_moved_out;  /* in whose way a wall came: moved; without a free spot */
    uint64_t people_lost, bodies_lost;  /* that the guard found */
    uint64_t opened, closed, announced; /* walls by name, and signals to everybody */
    /* Agents by their deepest overlap, as a share of their diameter, in bins of 0.1 %; sampled once
       a simulated second. */
    uint64_t overlap[JOX_OVERLAP_BINS];
    uint64_t overlap_samples;
    JoxBondStatistics bonds;
    JoxDriveStatistics drives;
    JoxExchange exchange;
} JoxStatistics;

/* Counts this step's failures and, once a second, overlaps. `tick` counts from 0. */
void jox_statistics_observe(JoxStatistics *statistics, const JoxAgents *agents,
                            const JoxNeighbours *neighbours, uint64_t tick, double dt);
/* The overlap that 99 % of the sampled agents stay below, as a share of their diameter; NAN
   where none was sampled, as in runs of less than a second. */
double jox_statistics_overlap_p99(const JoxStatistics *statistics);
/* Share of the sampled agents that overlap by more than a share of their diameter; NAN of none. */
double jox_statistics_overlap_share(const JoxStatistics *statistics, double over);

#endif
