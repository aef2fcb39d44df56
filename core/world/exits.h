/* Sinks, which remove agents that stand in a place, and counts of the agents that left by each
   exit. */
#ifndef JOX_WORLD_EXITS_H
#define JOX_WORLD_EXITS_H

#include <stdint.h>

#include "base/sections.h"

typedef struct JoWorld JoWorld;

typedef struct JoxAgentSink {
    uint32_t place;
    int32_t group; /* -1: all agents */
} JoxAgentSink;

/* Counts of agents that left, by exit: a place that is the sink, or that they last stood in. */
typedef struct JoxExits {
    struct JoxExit {
        char *name;
        uint32_t people;
        double last; /* s: when the last agent left here */
    } * items;
    uint32_t count, capacity;
    uint64_t left; /* all agents, by these exits or elsewhere */
    double last;   /* s: when the last of all left */
} JoxExits;
/* Returns the exit of a name, added if new. */
struct JoxExit *jox_exits_get(JoxExits *exits, const char *name);
/* Returns how many agents left by the exit of a name; `exits` is a JoxExits. */
uint32_t jox_exits_count(const void *exits, const char *place);
void jox_exits_free(JoxExits *exits);

/* Sets the sinks of a world, in place of those before. The caller keeps them until they are
   replaced. Their exits are listed before any agent left. */
void jox_world_set_sinks(JoWorld *world, const JoxAgentSink *sinks, uint32_t count);
/* After a step: removes agents in sinks, at every fourth step, and counts all that left. */
void jox_world_empty_sinks(JoWorld *world);
/* Lists the counts. */
void jox_exits_sections(JoxExits *exits, JoxSections *sections);

#endif
