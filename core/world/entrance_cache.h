/* Entrances of a world's places, made when they are first asked for. */
#ifndef JOX_WORLD_ENTRANCES_H
#define JOX_WORLD_ENTRANCES_H

#include "geom/entrance.h"

/* Zero-initialised there are none. */
typedef struct JoxEntrances {
    JoxEntrance **items; /* by place; NULL: not asked for yet */
    uint32_t count;
    JoxWallGrid grid;
} JoxEntrances;

/* The entrance of a place that is no set, among `count` of a scene, by the walls that stand. */
const JoxEntrance *jox_entrances_get(JoxEntrances *entrances, const JoxWalls *walls,
                                     const JoxPlace *places, uint32_t count, uint32_t place);
/* Places moved, or other walls stand: forgets them all. */
void jox_entrances_clear(JoxEntrances *entrances);

#endif
