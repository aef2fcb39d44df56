/* Who leaves a world, and where: sinks, which take agents out that stand in a place, and figures of
   all who left. */
#ifndef JOX_WORLD_EXITS_H
#define JOX_WORLD_EXITS_H

#include <stdint.h>

#include "base/sections.h"

typedef struct JoWorld JoWorld;

typedef struct JoxAgentSink {
    uint32_t place;
    int32_t group; /* -1: everyone */
} JoxAgentSink;

/* Who left, and where. */
typedef struct JoxExits {
    struct JoxExit {
        char *name;
        uint32_t people;
        double last; /* s */
    } * items;
    uint32_t count, capacity;
    uint64_t left; /* everyone, through these or otherwise */
    double last;   /* s; when the last of all left */
} JoxExits;
/* The exit of a name, made where there is none. */
struct JoxExit *jox_exits_get(JoxExits *exits, const char *name);
void jox_exits_free(JoxExits *exits);

/* Sinks of a world, in place of those before; they stay the caller's, and have to stay until they
   are replaced. Their exits are listed before anybody has left. */
void jox_world_set_sinks(JoWorld *world, const JoxAgentSink *sinks, uint32_t count);
/* After a step: takes out who stands in a sink (at every fourth), and counts all who left. */
void jox_world_empty_sinks(JoWorld *world);
/* Lists the figures; no step reads them, so they are no part of the hash. */
void jox_exits_sections(JoxExits *exits, JoxSections *sections);

#endif
