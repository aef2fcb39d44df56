/* Entrances of a world's places, made at first use: the floors on which agents of sources come in.
 */
#ifndef JOX_WORLD_ENTRANCE_CACHE_H
#define JOX_WORLD_ENTRANCE_CACHE_H

#include "geom/entrance.h"

/* Zero-initialised is empty. */
typedef struct JoxEntrances {
    JoxEntrance **items; /* by place; NULL: not made yet */
    uint32_t count;
    JoxWallGrid grid;
} JoxEntrances;

/* Returns the entrance of a place that is no set, one of `count` of a scene, between standing
   walls. */
const JoxEntrance *jox_entrances_get(JoxEntrances *entrances, const JoxStoreys *storeys,
                                     const JoxWalls *walls, const JoxPlace *places, uint32_t count,
                                     uint32_t place);
/* Frees all entrances; call it if places or standing walls changed. */
void jox_entrances_clear(JoxEntrances *entrances);

#endif
