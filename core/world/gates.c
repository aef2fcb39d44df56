/* Walls that come and go: opened, closed, or edited while the crowd runs. */
#include <string.h>

#include "world/world.h"

static void change(JoWorld *world) {
    world->walls_set = false;
    world->walls_version++;
}

void jox_world_set_walls(JoWorld *world, JoxWalls *walls) {
    JoxWalls old = world->all_walls;
    world->all_walls = *walls;
    *walls = (JoxWalls){0};
    for (uint32_t r = 0; r < world->all_walls.ring_count; r++) {
        struct JoxWallRing *ring = &world->all_walls.rings[r];
        for (uint32_t o = 0; ring->name && o < old.ring_count; o++) {
            if (!old.rings[o].set || strcmp(old.rings[o].name, ring->name) != 0)
                continue;
            ring->open = old.rings[o].open;
            ring->set = true;
        }
    }
    jox_walls_free(&old);
    world->walls_came = true;
    change(world);
}

uint32_t jox_world_open_walls(JoWorld *world, const char *name, bool open) {
    uint32_t count = 0;
    for (uint32_t r = 0; r < world->all_walls.ring_count; r++) {
        struct JoxWallRing *ring = &world->all_walls.rings[r];
        if (!ring->name || strcmp(ring->name, name) != 0)
            continue;
        count++;
        ring->set = true;
        if (ring->open == open)
            continue;
        ring->open = open;
        world->walls_came |= !open;
        change(world);
    }
    return count;
}

static void raise(JoWorld *world) {
    if (world->walls_set)
        return;
    world->walls_set = true;
    if (world->all_walls.count == 0 && world->walls.count == 0)
        return;
    jox_walls_standing(&world->walls, &world->all_walls, true);
    jox_nav_set_walls(world->nav, &world->walls);
    jox_bodies_set_walls(world->bodies, &world->walls, JOX_WALL_HEIGHT);
}

JoxPlacement jox_world_resolve_placement(JoWorld *world) {
    JoxPlacement settled = {0};
    raise(world);
    if (world->settled && !world->walls_came)
        return settled;
    uint32_t first = world->settled ? world->agents.next_id : world->first_unsettled;
    settled = jox_nav_resolve_placement(world->nav, &world->agents, first, world->walls_came);
    world->statistics.moved_out += settled.moved;
    world->settled = true;
    world->walls_came = false;
    return settled;
}
