/* Walls that come and go: opened, closed, or edited while the crowd runs. */
#include <string.h>

#include "base/assert.h"
#include "world/world.h"

static void change(JoWorld *world) {
    world->state.walls_set = false;
    world->state.walls_version++;
}

void jox_world_set_walls(JoWorld *world, JoxWalls *walls) {
    JoxWalls old = world->model.all_walls;
    world->model.all_walls = *walls;
    *walls = (JoxWalls){0};
    for (uint32_t r = 0; r < world->model.all_walls.ring_count; r++) {
        struct JoxWallRing *ring = &world->model.all_walls.rings[r];
        for (uint32_t o = 0; ring->name && o < old.ring_count; o++) {
            if (!old.rings[o].set || strcmp(old.rings[o].name, ring->name) != 0)
                continue;
            ring->open = old.rings[o].open;
            ring->set = true;
        }
    }
    jox_walls_free(&old);
    world->state.walls_came = true;
    change(world);
}

uint32_t jox_world_open_walls(JoWorld *world, const char *name, bool open) {
    uint32_t count = 0;
    for (uint32_t r = 0; r < world->model.all_walls.ring_count; r++) {
        struct JoxWallRing *ring = &world->model.all_walls.rings[r];
        if (!ring->name || strcmp(ring->name, name) != 0)
            continue;
        count++;
        ring->set = true;
        if (ring->open == open)
            continue;
        ring->open = open;
        world->state.walls_came |= !open;
        change(world);
    }
    return count;
}

void jox_world_raise_walls(JoWorld *world) {
    if (world->state.walls_set)
        return;
    world->state.walls_set = true;
    if (world->model.all_walls.count == 0 && world->scratch.walls.count == 0)
        return;
    jox_walls_standing(&world->scratch.walls, &world->model.all_walls, true);
    JOX_ASSERT(world->scratch.walls.count <= world->model.all_walls.count);
    jox_nav_set_walls(world->scratch.nav, &world->scratch.walls);
    jox_forces_set_walls(world->scratch.forces, &world->scratch.walls);
    jox_bodies_set_walls(world->state.bodies, &world->scratch.walls, JOX_WALL_HEIGHT);
}

JoxPlacement jox_world_resolve_placement(JoWorld *world) {
    JoxPlacement settled = {0};
    jox_world_raise_walls(world);
    if (world->state.settled && !world->state.walls_came)
        return settled;
    uint32_t first =
        world->state.settled ? world->state.agents.next_id : world->state.first_unsettled;
    settled = jox_nav_resolve_placement(world->scratch.nav, &world->state.agents, first,
                                        world->state.walls_came);
    JOX_ASSERT(first <= world->state.agents.next_id);
    JOX_ASSERT(settled.moved <= world->state.agents.count);
    world->state.statistics.moved_out += settled.moved;
    world->state.settled = true;
    world->state.walls_came = false;
    return settled;
}
