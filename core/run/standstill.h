/* People who want to get on and cannot: who stood the longest, crowds that stand still, and people
   who are kept from a place. */
#ifndef JOX_RUN_STANDSTILL_H
#define JOX_RUN_STANDSTILL_H

#include "base/vec.h"
#include "jostle.h"
#include "world/routes/hindrance.h"

/* Attaches the listener that watches for them. It says, while the run goes on, where a crowd has
   stood still for 30 s, and which places cannot be reached. */
void jox_run_collect_standstills(JoScene *scene);

/* The agent that wanted to get on and came no farther than 0.25 m for the longest time. */
typedef struct JoxLongestStand {
    double seconds, until; /* s: how long, and when it ended or was last seen */
    JoxV2 at;              /* m */
    uint32_t id;           /* JOX_NO_INDEX: there was none */
} JoxLongestStand;
/* NULL: no listener. */
const JoxLongestStand *jox_run_longest_stand(const JoScene *scene);

/* The longest standstill of a crowd: 10 people or more who wanted to get on, or half of all, came
   no farther than 0.25 m for 30 s or more. */
typedef struct JoxStandstill {
    double since, until; /* s */
    JoxV2 at;            /* m: where most of them were */
    uint32_t people;     /* the most at a time */
} JoxStandstill;
/* NULL: there was none. */
const JoxStandstill *jox_run_longest_standstill(const JoScene *scene);

/* People who are kept from a place that they go to, all by the same thing. */
typedef struct JoxKeptPeople {
    uint32_t place, people;
    uint32_t *groups; /* by group: how many of these people belong to it */
    JoxHindrance why; /* of the first person found */
    double since;     /* s: NAN unless a gate or a moving body keeps them */
    bool stands;      /* nothing in the scene, its events and inputs takes it away */
} JoxKeptPeople;
enum { JOX_MOST_KEPT = 16 };
typedef struct JoxKeptList {
    JoxKeptPeople items[JOX_MOST_KEPT];
    uint32_t count;
} JoxKeptList;
/* Lists people who are kept now from places that the listener has seen blocked; valid until the
   next step. NULL: no listener, or it has not looked yet. */
const JoxKeptList *jox_run_list_kept_people(const JoScene *scene);

#endif
