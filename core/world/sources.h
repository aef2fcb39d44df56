/* Sources: where people come in as time goes on, how many are due, and how many of them came. */
#ifndef JOX_WORLD_SOURCES_H
#define JOX_WORLD_SOURCES_H

#include "base/format/diag.h"
#include "base/sections.h"
#include "world/entrance_cache.h"

typedef struct JoWorld JoWorld;
typedef struct JoxGroupValue JoxGroupValue;

typedef struct JoxAgentSource {
    uint32_t place;
    double rate;     /* agents a second; 0: none by rate */
    double every;    /* s from one time to the next, the first being `from`; 0: no */
    double *times;   /* s, others */
    double *curve;   /* times, s, each with a rate, 1/s: straight between them, 0 beyond */
    uint32_t people; /* at each of the times */
    uint32_t time_count, curve_count;
    bool even;             /* by rate and curve people come evenly; else as a Poisson process */
    uint32_t keep;         /* tops the group up to so many; 0: no */
    uint32_t like;         /* index of the group that they belong to */
    JoxGroupValue *memory; /* in place of the group's, where given */
    uint32_t memory_count;
    double from, until; /* s; until INFINITY unless given */
    JoxPosition position;
} JoxAgentSource;

/* Of one source, for those who read a run. */
typedef struct JoxSourceFigures {
    double due;       /* people, by rate, curve and times, when people last came in */
    uint64_t entered; /* people who came in, those of a kept number too */
    uint64_t
        kept; /* people who are missing from a kept number and did not come in when last counted */
} JoxSourceFigures;

/* Arrivals of one source by rate and curve, as a Poisson process that its seed draws: times of
   arrival are in people that were expected by then, so that they do not depend on the step. */
typedef struct JoxArrivals {
    double next;    /* people expected until the next one arrives */
    uint64_t count; /* people who have arrived */
} JoxArrivals;

/* State, by source. Zero-initialised is none. */
typedef struct JoxSourceState {
    JoxArrivals *arrivals;
    double *made; /* people due by rate, curve and times who came in, or were due before the source
                     was there */
    JoxSourceFigures *figures; /* no step reads them */
} JoxSourceState;

/* Sources of a world, in place of those before; they stay the caller's, and have to stay until they
   are replaced. They go on with the counts that they have, or, `anew`, as if they had given so far
   what they are due; but those whom a source of the same place and group kept waiting still wait.
 */
void jox_world_set_sources(JoWorld *world, const JoxAgentSource *sources, uint32_t count,
                           bool anew);
/* Before a step: makes the agents that sources are due. Where a place is full, they wait until
   there is room; whoever waits when a source ends does not come. */
void jox_world_run_sources(JoWorld *world);

/* How many members a source's place has, 1 where it is no set; and one of them. */
uint32_t jox_source_count_doors(const JoWorld *world, uint32_t source);
uint32_t jox_source_door(const JoWorld *world, uint32_t source, uint32_t number);
/* The entrance of one of them, by the walls that stand. */
const JoxEntrance *jox_source_entrance(JoWorld *world, uint32_t source, uint32_t number);
/* People who were due when people last came in, and did not come for want of room. */
double jox_source_waiting(const JoWorld *world, uint32_t source);
/* Whether a source has ended: whoever is still due does not come. */
bool jox_source_is_over(const JoWorld *world, uint32_t source);
/* Appends the name of a source: that of its place; where others share it, with its group. */
void jox_source_append_name(const JoWorld *world, uint32_t source, JoxText *out);
/* Lists counts as state. */
void jox_sources_sections(JoWorld *world, JoxSections *sections);

#endif
