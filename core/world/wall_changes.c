/* Walls that change while a world runs: opened, closed, added, removed, or edited. Changes are
   applied before the next step, and agents moved out of new walls. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/format/plurals.h"
#include "base/mem.h"
#include "geom/polygon.h"
#include "geom/storey_text.h"
#include "world/world.h"

static void note_change(JoWorld *world) {
    world->state.walls_applied = false;
    world->state.walls_version++;
}

void jox_world_note_new_wall(JoWorld *world) {
    JoxWalls *walls = &world->model.all_walls;
    JOX_ASSERT(world->state.tick == 0 && walls->ring_count > 0);
    world->state.walls_applied = false;
    if (world->state.agents.count == 0)
        return;
    jox_walls_mark_ring_new(walls, walls->ring_count - 1);
    world->state.has_new_walls = true;
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
    world->model.added_ring = world->model.all_walls.ring_count;
    world->model.added_vertex = world->model.all_walls.count;
    jox_world_append_added_walls(world);
    if (world->state.agents.count > 0) /* else there are no agents to move out */
        world->state.has_new_walls |= jox_walls_mark_new(&world->model.all_walls, &old);
    jox_walls_free(&old);
    note_change(world);
}

/* ---- walls that are added ---- */

void jox_world_mark_added_walls(JoWorld *world) {
    if (world->state.added_count > 0)
        return;
    world->model.added_ring = world->model.all_walls.ring_count;
    world->model.added_vertex = world->model.all_walls.count;
}

/* Appends an added wall as one ring, so that wall m is ring added_ring + m. */
static void append_added_wall(JoWorld *world, const JoxAddedWall *made) {
    JoxWalls *walls = &world->model.all_walls;
    const uint32_t ring = walls->ring_count;
    if (made->count == 2)
        jox_walls_add_polyline(walls, made->points, 2, false, INFINITY);
    else
        jox_walls_add_solid(walls, made->points, made->count, INFINITY);
    JOX_ASSERT(walls->ring_count == ring + 1);
    jox_walls_name(walls, ring, made->name, made->open);
    walls->rings[ring].set = true;
    if (made->is_new)
        jox_walls_mark_ring_new(walls, ring);
}

void jox_world_append_added_walls(JoWorld *world) {
    JoxWalls *walls = &world->model.all_walls;
    JOX_ASSERT(world->model.added_ring <= walls->ring_count);
    while (walls->ring_count > world->model.added_ring)
        jox_free(walls->rings[--walls->ring_count].name);
    walls->count = world->model.added_vertex;
    for (uint32_t m = 0; m < world->state.added_count; m++)
        append_added_wall(world, &world->state.added_walls[m]);
}

bool jox_world_add_wall(JoWorld *world, const char *name, const JoxV2 *points, uint32_t count,
                        JoxText *why) {
    JoxWorldState *state = &world->state;
    const JoxWalls *walls = &world->model.all_walls;
    JoxAddedWall made = {.count = count};
    uint32_t a, b;
    JOX_ASSERT((count == 2 || count == 4) && strlen(name) < sizeof made.name);
    memcpy(made.points, points, count * sizeof *points);
    memcpy(made.name, name, strlen(name));
    if (state->added_count == JOX_MOST_ADDED_WALLS)
        jox_text_printf(why, "%d walls were added already; take some out first",
                        JOX_MOST_ADDED_WALLS);
    else if (count == 2 && jox_length(jox_sub(points[1], points[0])) < 1e-3f)
        jox_text_add(why, "the ends of a wall must lie apart");
    else if (count == 4 && (jox_polygon_self_crosses(points, count, &a, &b) ||
                            jox_polygon_area(points, count) == 0.0f))
        jox_text_add(why, "a solid must enclose an area and not cross itself");
    if (why->length)
        return false;
    for (uint32_t r = 0; r < walls->ring_count; r++) /* open or closed as others of its name */
        if (walls->rings[r].name && strcmp(walls->rings[r].name, name) == 0)
            made.open = walls->rings[r].open;
    made.is_new = !made.open;
    jox_world_mark_added_walls(world);
    JOX_RESERVE(state->added_walls, state->added_capacity, state->added_count + 1);
    state->added_walls[state->added_count++] = made;
    append_added_wall(world, &made);
    state->has_new_walls |= !made.open;
    note_change(world);
    return true;
}

bool jox_world_remove_walls(JoWorld *world, const char *name) {
    JoxWorldState *state = &world->state;
    uint32_t kept = 0;
    const uint32_t before = state->added_count;
    for (uint32_t m = 0; m < before; m++)
        if (strcmp(state->added_walls[m].name, name) != 0)
            state->added_walls[kept++] = state->added_walls[m];
    if (kept == before)
        return false;
    state->added_count = kept;
    jox_world_append_added_walls(world);
    note_change(world);
    return true;
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
        if (!open)
            jox_walls_mark_ring_new(&world->model.all_walls, r);
        if (world->state.added_count > 0 && r >= world->model.added_ring) {
            world->state.added_walls[r - world->model.added_ring].open = open;
            world->state.added_walls[r - world->model.added_ring].is_new |= !open;
        }
        world->state.has_new_walls |= !open;
        note_change(world);
    }
    return count;
}

bool jox_world_close_stair(JoWorld *world, const char *name, bool closed) {
    JoxStoreys *storeys = &world->model.storeys;
    bool found = false;
    for (uint32_t k = 0; k < storeys->stair_count; k++) {
        JoxStair *stair = &storeys->stairs[k];
        if (strcmp(stair->name, name) != 0)
            continue;
        found = true;
        if (stair->closed != closed)
            note_change(world);
        stair->closed = closed;
    }
    return found;
}

void jox_world_set_lift_door(JoWorld *world, const char *name, bool open) {
    for (uint32_t r = 0; r < world->model.all_walls.ring_count; r++) {
        struct JoxWallRing *ring = &world->model.all_walls.rings[r];
        if (!ring->is_lift_door || strcmp(ring->name, name) != 0)
            continue;
        ring->open = open;
        ring->set = true;
        world->state.walls_applied = false;
    }
}

bool jox_world_is_lift_door(const JoWorld *world, const char *name) {
    for (uint32_t r = 0; r < world->model.all_walls.ring_count; r++) {
        const struct JoxWallRing *ring = &world->model.all_walls.rings[r];
        if (ring->is_lift_door && strcmp(ring->name, name) == 0)
            return true;
    }
    return false;
}

static bool has_images(const JoWorld *world) {
    const JoxV2 period = world->state.agents.period;
    return period.x > 0.0f || period.y > 0.0f || world->state.agents.storeys;
}

const JoxWalls *jox_world_walls(const JoWorld *world) {
    return has_images(world) ? &world->scratch.images.walls : &world->scratch.walls;
}

const JoxWalls *jox_world_dividing_walls(const JoWorld *world) {
    return world->model.lift_count ? &world->scratch.dividing : &world->scratch.walls;
}

void jox_world_apply_walls(JoWorld *world) {
    if (world->state.walls_applied)
        return;
    world->state.walls_applied = true;
    if (world->model.all_walls.count == 0 && world->scratch.walls.count == 0)
        return;
    jox_walls_standing(&world->scratch.walls, &world->model.all_walls, true);
    JOX_ASSERT(world->scratch.walls.count <= world->model.all_walls.count);
    if (world->model.lift_count)
        jox_walls_dividing(&world->scratch.dividing, &world->model.all_walls);
    const bool joined = has_images(world);
    if (joined) {
        jox_wall_images_lay(&world->scratch.images, &world->scratch.walls,
                            world->state.agents.origin, world->state.agents.period);
        if (world->state.agents.storeys)
            jox_wall_images_lay_seams(&world->scratch.images, world->state.agents.storeys,
                                      JOX_SEAM_REACH);
        world->scratch.images_only = jox_wall_images_only(&world->scratch.images);
    }
    jox_entrances_clear(&world->scratch.entrances);
    jox_nav_set_walls(world->scratch.nav, jox_world_walls(world));
    jox_forces_set_walls(world->scratch.forces, &world->scratch.walls,
                         joined ? &world->scratch.images : NULL);
    jox_bodies_set_walls(world->state.bodies, &world->scratch.walls, JOX_WALL_HEIGHT);
}

/* Moves agents out of new walls, and adds a message about those that cannot be moved. */
static void clear_agents_from_new_walls(JoWorld *world) {
    const JoxAgents *a = &world->state.agents;
    JoxStatistics *s = &world->state.statistics;
    const JoxCleared cleared = jox_nav_clear_new_walls(world->scratch.nav, &world->state.agents);
    s->moved_out += cleared.moved;
    s->not_moved_out += cleared.stuck;
    if (cleared.stuck) {
        jox_text_printf(&world->scratch.messages,
                        "t = %.2f s: ", (double)world->state.tick * world->model.def.dt);
        jox_text_noun(&world->scratch.messages, cleared.stuck, "person|people");
        jox_text_printf(&world->scratch.messages,
                        " in the way of a wall that came could not be moved, as there is no free "
                        "spot on the same side of all walls: the first is agent %u at ",
                        a->id[cleared.first_stuck]);
        jox_text_position(&world->scratch.messages, &world->model.storeys,
                          jox_v2(a->x[cleared.first_stuck], a->y[cleared.first_stuck]), 2);
        jox_text_add(&world->scratch.messages, "\n");
    }
    jox_walls_clear_new_marks(&world->model.all_walls);
    jox_walls_clear_new_marks(&world->scratch.walls);
    jox_walls_clear_new_marks(&world->scratch.images.walls);
    for (uint32_t m = 0; m < world->state.added_count; m++)
        world->state.added_walls[m].is_new = 0;
    world->state.has_new_walls = false;
}

void jox_world_settle_walls(JoWorld *world) {
    jox_world_apply_walls(world);
    if (world->state.has_new_walls)
        clear_agents_from_new_walls(world);
}
