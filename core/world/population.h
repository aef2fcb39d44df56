/* Who is in a world and who enters it: groups of agents made alike, and sources that make more of
   them as time goes on. The descriptions are part of the model: plain data that whoever loads a
   scene fills and owns. */
#ifndef JOX_WORLD_POPULATION_H
#define JOX_WORLD_POPULATION_H

#include "base/format/colour.h"
#include "base/format/diag.h"
#include "base/number/distribution.h"
#include "base/sections.h"
#include "geom/fill.h"
#include "machine/run.h"
#include "nav/nav.h"

typedef struct JoWorld JoWorld;

/* A parameter or own name that a group sets: a distribution of numbers, a place, or a rule. */
typedef struct JoxGroupValue {
    char *name;
    enum { JOX_SET_NUMBER, JOX_SET_PLACE, JOX_SET_ANTIPODE } kind;
    JoxDist dist;
    int32_t place; /* index of places; JOX_SET_PLACE only */
    /* By machine of the world: 1 + the slot of the value there, 0: it has none. Filled when the
       scene is linked. */
    uint16_t slots[JOX_MOST_MACHINES];
    JoxPosition position;
} JoxGroupValue;

typedef struct JoxGroupMix {
    char *behaviour;  /* the path as found on disk */
    uint32_t machine; /* its index in the world; filled when the scene is linked */
    double weight;    /* share; the weights of a group sum to 1 */
    char *text;       /* of a journey, for which there is no file; NULL: it is read */
    JoxPosition position;
} JoxGroupMix;

/* A kind of people in a group, who get values of their own. */
typedef struct JoxProfile {
    char *name;
    double share; /* weight among those of the group */
    JoxGroupValue *set;
    uint32_t set_count;
    JoxPosition position;
} JoxProfile;

/* A stage of a journey: what there is of it is done in this order. Indices of places, -1: none. */
typedef struct JoxJourneyStep {
    double share;     /* of people who do it, 0 to 1 */
    int32_t to, exit; /* where they walk; where they leave */
    int32_t front;    /* what they look at while they wait, and gather before */
    uint32_t *queues; /* one of which they stand in: the one that takes them least time */
    uint32_t queue_count;
    char *service, *wait, *until,
        *gate;     /* as a behaviour has it: s, s; a signal; a gate; or NULL */
    double served; /* s: about how long a service takes */
    JoxPosition position;
} JoxJourneyStep;

/* When and where somebody comes in, and how: m/s, NAN where that is not given. */
typedef struct JoxStart {
    double time; /* s */
    JoxV2 at, velocity;
    uint32_t group;
} JoxStart;

/* Agents made alike. */
typedef struct JoxGroup {
    char *name;
    JoxPosition position;
    JoxColour colour; /* in pictures */
    JoxGroupMix *mix;
    uint32_t mix_count;
    JoxFillMode fill;
    uint32_t *in, *outside; /* places that they fill, and that they keep out of: indices */
    uint32_t in_count, outside_count;
    JoxV2 *positions; /* where they stand at the start, m */
    uint32_t count;
    /* In order of time, or NULL; the first `count` are those of `positions`, at 0 s. */
    JoxStart *starts;
    uint32_t start_count;
    float facing;         /* rad, anti-clockwise from +x; NAN: not given */
    JoxV2 centre;         /* of a circle fill, and the mirror of `antipode` */
    char *team;           /* or NULL */
    uint16_t team_number; /* filled when the scene is linked; 0: no team */
    uint32_t party;       /* agents in a row that are a team of their own; 1: none */
    char **tags;
    uint32_t tag_count;
    uint64_t tag_bits; /* the same by their numbers; filled when the scene is linked */
    JoxGroupValue *set;
    uint32_t set_count;
    JoxGroupValue *memory; /* initial memory; numbers only */
    uint32_t memory_count;
    JoxProfile *profiles;
    uint32_t profile_count;
    JoxJourneyStep *journey; /* what its behaviour was made of; NULL: it has one of its own */
    uint32_t journey_count;
} JoxGroup;

/* State. Zero-initialised is nobody. */
typedef struct JoxPopulation {
    uint32_t *party_left; /* per group: places left in the party that fills up, */
    uint32_t *party_team; /* and its team */
    uint32_t next_party;
    uint8_t *entered;   /* per start of the model: whether that one is in */
    uint32_t all_until; /* before this start all are */
} JoxPopulation;

/* Groups of a world, in place of those before; they stay the caller's, and have to stay until they
   are replaced. They must be as many as before, if there were some. */
void jox_world_set_groups(JoWorld *world, const JoxGroup *groups, uint32_t count);
/* How the agents of a group that stand there at the start were placed. */
typedef struct JoxPlaced {
    uint32_t shifted;    /* to a free spot */
    uint32_t not_placed; /* for whom there is none */
    uint32_t in_solid;   /* of these, whose point lies in a wall */
    uint32_t not_found;  /* of these, whose search for a spot was ended by its bound */
    uint32_t first;      /* of these, the first: index of its position */
    float farthest;      /* m: the longest way that one was shifted */
} JoxPlaced;
/* Makes the agents of all groups that stand there at the start, as far as they fit; fills one of
   `placed` for each group. */
void jox_world_populate(JoWorld *world, JoxPlaced *placed);
/* People of a group whose time to come in has passed and who wait until the spot where they begin
   is free. */
uint32_t jox_world_starts_waiting(const JoWorld *world, uint32_t group);
/* Who is to be born: of a group, at a point or near it. */
typedef struct JoxBirth {
    uint32_t group;
    const JoxGroupValue *memory;
    uint32_t memory_count;
    JoxBirthWish wish; /* its radius is drawn */
} JoxBirth;
/* One of a group, with the group's memory and no place. */
JoxBirth jox_world_birth(const JoWorld *world, uint32_t group, JoxV2 at);
/* Makes the agent at its point, or on the nearest free spot with no wall between
   (jox_nav_find_birth). Where there is none nothing is done, and nothing is counted; else *agent is
   its index. */
JoxBirthSpot jox_world_spawn(JoWorld *world, JoxBirth *birth, uint32_t *agent);
/* The same of a group, at a point, m. */
JoxBirthSpot jox_world_spawn_at(JoWorld *world, uint32_t group, JoxV2 at, uint32_t *agent);
/* Says why somebody could not be placed at a point, for messages. */
void jox_world_explain_unplaced(JoxBirthSpot spot, double x, double y, JoxText *out);
/* Before a step: brings in whose start has come. Who would stand in another waits until that one
   has gone on; those behind do not wait for it. */
void jox_world_spawn_due_starts(JoWorld *world);
/* Lists parties, who has come in and the places of single agents as state. */
void jox_population_sections(JoWorld *world, JoxSections *sections);

#endif
