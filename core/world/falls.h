/* Falls: agents that are thrown off balance lie, hold others up, and get up after a while. Off
   unless an agent's parameter `balance` is above 0; core/walking.md has the rule and its
   sources. */
#ifndef JOX_WORLD_FALLS_H
#define JOX_WORLD_FALLS_H

#include "agents/step.h"
#include "force/force.h"
#include "world/statistics.h"

/* Which agents fall in a step; zero-initialise, free by jox_falls_free. */
typedef struct JoxFalls {
    JoxV2 *onto; /* per agent, N: how it presses on those who lie */
    bool *now;   /* per agent: falls in this step */
    uint32_t capacity;
} JoxFalls;

/* Returns whether any agent lies. */
bool jox_falls_lies_any(const JoxAgents *agents);
/* Returns whether agents may fall, lean or lie, so that jox_falls_step has something to do. */
bool jox_falls_matter(const JoxAgents *agents, bool literal);
/* Lets agents that lie want to stay where they are; after prefer. */
void jox_falls_hold(JoxAgents *agents);
/* Lets agents that lie plan to stay where they are; after solve. */
void jox_falls_plan(JoxAgents *agents);
/* Ends a step: lets those fall that lose their balance, and those get up that have lain long
   enough. Runs once the new velocities are known, before agents are removed or sorted. */
void jox_falls_step(JoxFalls *falls, const JoxStep *step, const JoxForces *forces,
                    JoxStatistics *statistics);
void jox_falls_free(JoxFalls *falls);

#endif
