#include "world/entrance_cache.h"

#include "base/assert.h"
#include "base/mem.h"

const JoxEntrance *jox_entrances_get(JoxEntrances *e, const JoxStoreys *storeys,
                                     const JoxWalls *walls, const JoxPlace *places, uint32_t count,
                                     uint32_t place) {
    JOX_ASSERT(place < count && (!e->items || e->count == count));
    if (!e->items) {
        e->count = count;
        e->items = jox_alloc(count, sizeof *e->items);
        e->grid.walls = walls;
    }
    if (!e->items[place]) {
        e->items[place] = jox_alloc(1, sizeof *e->items[place]);
        jox_entrance_make(e->items[place], storeys, &e->grid, &places[place]);
    }
    return e->items[place];
}

void jox_entrances_clear(JoxEntrances *e) {
    for (uint32_t p = 0; p < e->count; p++)
        if (e->items[p]) {
            jox_entrance_free(e->items[p]);
            jox_free(e->items[p]);
        }
    jox_free(e->items);
    jox_wall_grid_free(&e->grid);
    *e = (JoxEntrances){0};
}
