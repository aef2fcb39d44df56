/* Ways round walls and large bodies: a distance field for each place that some agent asks its way
   to, made beside the steps. */
#ifndef JOX_WORLD_WAYS_H
#define JOX_WORLD_WAYS_H

#include <stdint.h>

typedef struct JoxWays JoxWays;
typedef struct JoWorld JoWorld;

JoxWays *jox_ways_create(void);
void jox_ways_free(JoxWays *ways);
/* Before think of each step. In the first step: makes all fields that agents ask for in the states
   they are in. Later: what was asked for at a tick is used from half a second of simulated time
   after it on, however long it takes to make. A field is renewed where walls went up or down; where
   large bodies moved (see obstacles.h), at most every 2 s; and only if somebody still asks. */
void jox_world_ways(JoWorld *world);
/* Places moved: all fields are renewed. */
void jox_world_renew_ways(JoWorld *world);

#endif
