/* Routes round walls and large bodies: a distance field for each place that some agent asks its
   way to, made beside the steps. */
#ifndef JOX_WORLD_ROUTES_H
#define JOX_WORLD_ROUTES_H

#include "base/sections.h"

typedef struct JoxRoutes JoxRoutes;
typedef struct JoWorld JoWorld;

JoxRoutes *jox_routes_create(void);
void jox_routes_free(JoxRoutes *routes);
/* Before think of each step. In the first step: makes all fields that agents ask for in the states
   they are in. Later: what was asked for at a tick is used from half a second of simulated time
   after it on, however long it takes to make. A field is renewed where walls went up or down; where
   large bodies moved (see obstacles.h), at most every 2 s; and only if somebody still asks. */
void jox_world_routes(JoWorld *world);
/* Places moved: all fields are renewed. */
void jox_world_renew_routes(JoWorld *world);
/* Lists the fields in use, those under way, which are finished first, and when they come into use.
 */
void jox_routes_sections(JoWorld *world, JoxSections *sections);

#endif
