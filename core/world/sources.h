/* Sources: places where agents of a group enter as time goes on; how many are due, and how many
   entered. */
#ifndef JOX_WORLD_SOURCES_H
#define JOX_WORLD_SOURCES_H

#include "base/format/diag.h"
#include "base/sections.h"
#include "world/entrance_cache.h"

typedef struct JoWorld JoWorld;
typedef struct JoxGroupValue JoxGroupValue;

typedef struct JoxAgentSource {
    uint32_t place;
    double rate;     /* agents per second; 0: none */
    double every;    /* s: interval of times from `from` on; 0: none */
    double *times;   /* s: further times */
    double *curve;   /* pairs of time, s, and rate, 1/s; linear between, 0 outside */
    uint32_t people; /* agents at each of the times */
    uint32_t time_count, curve_count;
    bool even;             /* rate and curve: evenly spaced arrivals, else a Poisson process */
    uint32_t keep;         /* keeps the group at so many agents; 0: no */
    uint32_t like;         /* index of the agents' group */
    JoxGroupValue *memory; /* replaces the group's initial memory; or NULL */
    uint32_t memory_count;
    double from, until; /* s; until INFINITY unless given */
    JoxPosition position;
} JoxAgentSource;

/* Figures of one source, for reports. */
typedef struct JoxSourceFigures {
    double due; /* agents due by rate, curve and times, in the last step that the source ran */
    uint64_t entered; /* agents that entered, for `keep` too */
    uint64_t kept;    /* agents missing from `keep` that did not enter when last counted */
} JoxSourceFigures;

/* Arrivals of one source by rate and curve, a Poisson process drawn from the seed. Its time is the
   number of agents expected so far, so that arrivals do not depend on the length of the step. */
typedef struct JoxArrivals {
    double next;    /* expected agents at which the next one arrives */
    uint64_t count; /* agents that arrived */
} JoxArrivals;

/* State, by source. Zero-initialised: no sources. */
typedef struct JoxSourceState {
    JoxArrivals *arrivals;
    double *made; /* due agents by rate, curve and times that entered, or were due before the
                     source existed */
    JoxSourceFigures *figures; /* no step reads them */
} JoxSourceState;

/* Sets the sources of a world, in place of those before. The caller keeps them until they are
   replaced. Counts continue; with `anew` they start as if all due agents had entered, except agents
   that still wait at a source with the same place and group. */
void jox_world_set_sources(JoWorld *world, const JoxAgentSource *sources, uint32_t count,
                           bool anew);
/* Before a step: makes due agents. While a place is full they wait for room; agents that wait when
   the source ends do not enter. */
void jox_world_run_sources(JoWorld *world);

/* Returns the number of members of a source's place, 1 if it is no set; and the place of one. */
uint32_t jox_source_count_doors(const JoWorld *world, uint32_t source);
uint32_t jox_source_door(const JoWorld *world, uint32_t source, uint32_t number);
/* Returns the entrance of one member, between standing walls. */
const JoxEntrance *jox_source_entrance(JoWorld *world, uint32_t source, uint32_t number);
/* Returns how many due agents did not enter yet for want of room. */
double jox_source_waiting(const JoWorld *world, uint32_t source);
/* Returns whether a source has ended: agents still due do not enter. */
bool jox_source_is_over(const JoWorld *world, uint32_t source);
/* Returns whether anybody may still enter by a source. */
bool jox_source_can_bring(const JoWorld *world, uint32_t source);
/* Returns whether people may still come in: at a start time, late for want of room, or by a source.
 */
bool jox_world_expects_people(const JoWorld *world);
/* Appends the name of a source: that of its place, with its group if others have the same place. */
void jox_source_append_name(const JoWorld *world, uint32_t source, JoxText *out);
/* Lists counts as state. */
void jox_sources_sections(JoWorld *world, JoxSections *sections);

#endif
