/* Groups of agents made alike: their descriptions, and how agents of them are made at the start and
   at given times. Descriptions are plain data of the model; the loader of a scene owns them. */
#ifndef JOX_WORLD_POPULATION_H
#define JOX_WORLD_POPULATION_H

#include "base/format/colour.h"
#include "base/format/diag.h"
#include "base/number/distribution.h"
#include "base/sections.h"
#include "geom/start_positions.h"
#include "geom/storeys.h"
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
    char *text; /* text of a journey's behaviour, which has no file; NULL: read from the path */
    JoxPosition position;
} JoxGroupMix;

/* A kind of people in a group, with values of its own. */
typedef struct JoxProfile {
    char *name;
    double share; /* weight among the profiles of the group */
    JoxGroupValue *set;
    uint32_t set_count;
    JoxPosition position;
} JoxProfile;

/* A stage of a journey; its parts are done in this order. Places are indices, -1: none. */
typedef struct JoxJourneyStep {
    double share;     /* share of people that do it, 0 to 1 */
    int32_t to, exit; /* place to walk to; place to leave by */
    int32_t front;    /* place that they gather at and face while they wait */
    uint32_t *queues; /* queues to choose from: the one with the least expected time */
    uint32_t queue_count;
    char *service, *wait, *until,
        *gate; /* expressions of a behaviour: durations, s; names of a signal and a gate; or NULL */
    int32_t ride;  /* place of a lift, or a set of them, to ride to */
    bool firemen;  /* of a ride: waits also for a lift that is not in use */
    double served; /* s: expected duration of a service */
    JoxPosition position;
} JoxJourneyStep;

/* Time and point at which an agent enters, and its velocity, m/s; NAN: not given. */
typedef struct JoxStart {
    double time; /* s */
    JoxV2 at, velocity;
    uint32_t group;
} JoxStart;

/* Clothes that the live page draws, in the order of the choices of the key `clothes`. */
#define JOX_CLOTHES(X)                                                                             \
    X(CASUAL, "casual")                                                                            \
    X(IHRAM, "ihram")                                                                              \
    X(SPORT, "sport")                                                                              \
    X(WORK, "work")

extern const char *const jox_clothes_names[];
extern const uint32_t jox_clothes_count;

/* Agents made alike. */
typedef struct JoxGroup {
    char *name;
    JoxPosition position;
    JoxColour colour; /* in pictures */
    uint32_t clothes; /* index in JOX_CLOTHES */
    JoxGroupMix *mix;
    uint32_t mix_count;
    JoxFillMode fill;
    uint32_t *in, *outside; /* indices of places that they fill and of places that they avoid */
    uint32_t in_count, outside_count;
    JoxV2 *positions; /* m: positions at the start */
    uint32_t count;
    /* Ordered by time, or NULL; the first `count` belong to `positions`, at 0 s. */
    JoxStart *starts;
    uint32_t start_count;
    float facing;         /* rad, anti-clockwise from +x; NAN: not given */
    JoxV2 centre;         /* m: centre of a circle fill; `antipode` mirrors at it */
    char *team;           /* or NULL */
    uint16_t team_number; /* filled when the scene is linked; 0: no team */
    uint32_t party;       /* size of parties: consecutive agents that are a team; 1: none */
    char **tags;
    uint32_t tag_count;
    uint64_t tag_bits; /* the same by their numbers; filled when the scene is linked */
    JoxGroupValue *set;
    uint32_t set_count;
    JoxGroupValue *memory; /* initial memory; numbers only */
    uint32_t memory_count;
    JoxProfile *profiles;
    uint32_t profile_count;
    char *basis; /* source of its numbers, for reports; NULL: none */
    JoxJourneyStep
        *journey; /* from which its behaviour is made; NULL: the behaviour is in a file */
    uint32_t journey_count;
} JoxGroup;

/* State. Zero-initialised is empty. */
typedef struct JoxPopulation {
    uint32_t *party_left; /* per group: agents that the present party still lacks */
    uint32_t *party_team; /* per group: team of that party */
    uint32_t next_party;
    uint8_t *entered;   /* per start of the model: 1 if that agent entered */
    uint32_t all_until; /* all starts before this one entered */
} JoxPopulation;

/* Sets the groups of a world, in place of those before, if any as many. The caller keeps them until
   they are replaced. */
void jox_world_set_groups(JoWorld *world, const JoxGroup *groups, uint32_t count);
/* How the agents of a group were placed at the start. */
typedef struct JoxPlaced {
    uint32_t shifted;    /* agents on a free spot near their position */
    uint32_t not_placed; /* positions without a free spot */
    uint32_t in_solid;   /* of `not_placed`: positions in a wall */
    uint32_t not_found;  /* of `not_placed`: the search reached its bound */
    uint32_t first;      /* of `not_placed`: index of the first position */
    float farthest;      /* m: greatest shift of an agent */
} JoxPlaced;
/* Makes the agents of all groups at the start, as far as they fit; fills one of `placed` for each
   group. */
void jox_world_populate(JoWorld *world, JoxPlaced *placed);
/* Returns how many agents of a group are late: their start has passed, and their point is not free
   yet. */
uint32_t jox_world_starts_waiting(const JoWorld *world, uint32_t group);
/* An agent to be made: its group, its initial memory, and the wish for its spot. */
typedef struct JoxBirth {
    uint32_t group;
    const JoxGroupValue *memory;
    uint32_t memory_count;
    JoxBirthWish wish; /* the radius is drawn by jox_world_spawn */
} JoxBirth;
/* Returns a birth in a group at a point, m, with the group's memory and no place. */
JoxBirth jox_world_birth(const JoWorld *world, uint32_t group, JoxV2 at);
/* Makes an agent at its point, or on the nearest free spot with no wall between
   (jox_nav_find_birth), and writes its index to *agent. Without a free spot it does and counts
   nothing. */
JoxBirthSpot jox_world_spawn(JoWorld *world, JoxBirth *birth, uint32_t *agent);
/* Makes an agent of a group at a point, m, or near it. */
JoxBirthSpot jox_world_spawn_at(JoWorld *world, uint32_t group, JoxV2 at, uint32_t *agent);
/* Appends why no agent could be placed at a position. */
void jox_world_explain_unplaced(const JoxStoreys *storeys, JoxBirthSpot spot, JoxV2 at,
                                JoxText *out);
/* Before a step: makes agents whose start has come. One whose point is not free waits; later ones
   do not wait for it. */
void jox_world_spawn_due_starts(JoWorld *world);
/* Lists parties, entered starts and places of single agents as state. */
void jox_population_sections(JoWorld *world, JoxSections *sections);

#endif
