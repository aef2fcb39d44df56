#include "geom/walls.h"

#include "base/assert.h"
#include "base/mem.h"
#include "geom/polygon.h"

/* Appends a ring of linked vertices. */
static void add_ring(JoxWalls *walls, const JoxV2 *points, uint32_t count, bool solid,
                     float height) {
    JOX_ASSERT(count >= 2);
    uint32_t first = walls->count;
    JOX_RESERVE(walls->vertices, walls->capacity, first + count);
    for (uint32_t i = 0; i < count; i++) {
        JoxV2 here = points[i], after = points[(i + 1) % count];
        JoxV2 before = points[(i + count - 1) % count];
        JoxV2 in = jox_sub(here, before), out = jox_sub(after, here);
        /* A polyline's end turns by half a circle: its determinant is zero, and it is convex. */
        float bend = jox_det(in, out);
        walls->vertices[first + i] = (JoxWallVertex){.point = here,
                                                     .direction = jox_unit(out),
                                                     .next = first + (i + 1) % count,
                                                     .previous = first + (i + count - 1) % count,
                                                     .convex = bend >= 0.0f};
    }
    walls->count += count;
    JOX_RESERVE(walls->rings, walls->ring_capacity, walls->ring_count + 1);
    walls->rings[walls->ring_count++] =
        (struct JoxWallRing){.first = first, .count = count, .solid = solid, .height = height};
}

void jox_walls_add_solid(JoxWalls *walls, const JoxV2 *ring, uint32_t count, float height) {
    JoxV2 *turned = jox_alloc(count, sizeof *turned);
    bool clockwise = jox_polygon_area(ring, count) < 0.0;
    for (uint32_t i = 0; i < count; i++)
        turned[i] = ring[clockwise ? count - 1 - i : i];
    add_ring(walls, turned, count, true, height);
    jox_free(turned);
}

void jox_walls_add_polyline(JoxWalls *walls, const JoxV2 *points, uint32_t count, bool closed,
                            float height) {
    if (closed) { /* two one-sided rings, back to back: the outer left-hand, the inner right-hand */
        JoxV2 *ring = jox_alloc(count, sizeof *ring);
        bool clockwise = jox_polygon_area(points, count) < 0.0;
        for (int side = 0; side < 2; side++) {
            for (uint32_t i = 0; i < count; i++)
                ring[i] = points[(clockwise != (side == 1)) ? count - 1 - i : i];
            add_ring(walls, ring, count, false, height);
        }
        jox_free(ring);
        return;
    }
    JOX_ASSERT(count >= 2);
    uint32_t length = 2 * count - 2; /* there and back */
    JoxV2 *ring = jox_alloc(length, sizeof *ring);
    for (uint32_t i = 0; i < length; i++)
        ring[i] = points[i < count ? i : length - i];
    add_ring(walls, ring, length, false, height);
    jox_free(ring);
}

void jox_walls_add_outline(JoxWalls *walls, const JoxV2 *points, uint32_t count, float height) {
    uint32_t ring = walls->ring_count; /* the first of the two is counter-clockwise */
    jox_walls_add_polyline(walls, points, count, true, height);
    walls->rings[ring].outline = true;
}

JoxV2 *jox_walls_ring_points(const JoxWalls *walls, uint32_t ring) {
    JOX_ASSERT(ring < walls->ring_count);
    const struct JoxWallRing *r = &walls->rings[ring];
    JoxV2 *points = jox_alloc(r->count, sizeof *points);
    for (uint32_t i = 0; i < r->count; i++)
        points[i] = walls->vertices[r->first + i].point;
    return points;
}

bool jox_walls_outline_all(const JoxWalls *walls, const JoxV2 *points, uint32_t count) {
    bool *within = jox_alloc((size_t)count + 1, sizeof *within), any = false;
    uint32_t held = 0;
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        if (!walls->rings[r].outline)
            continue;
        JoxV2 *ring = jox_walls_ring_points(walls, r);
        any = true;
        for (uint32_t i = 0; i < count; i++)
            if (!within[i] && jox_polygon_contains(ring, walls->rings[r].count, points[i])) {
                within[i] = true;
                held++;
            }
        jox_free(ring);
    }
    jox_free(within);
    return any && held == count;
}

void jox_walls_name(JoxWalls *walls, uint32_t first, const char *name, bool open) {
    for (uint32_t r = first; r < walls->ring_count; r++) {
        if (walls->rings[r].name)
            continue;
        walls->rings[r].name = jox_strdup(name);
        walls->rings[r].open = open;
    }
}

typedef enum Doors { NO_DOORS, SHUT_DOORS, ALL_DOORS } Doors;

/* Returns whether a ring stands; closed gates if `gates`, and these doors of lifts. */
static bool stands(const struct JoxWallRing *ring, bool gates, Doors doors) {
    if (ring->is_lift_door)
        return doors == ALL_DOORS || (doors == SHUT_DOORS && gates && !ring->open);
    return !ring->open && (gates || !ring->name);
}

/* Copies the rings that stand. */
static void copy_standing(JoxWalls *out, const JoxWalls *all, bool gates, Doors doors) {
    out->count = out->ring_count = 0;
    JOX_RESERVE(out->vertices, out->capacity, all->count);
    JOX_RESERVE(out->rings, out->ring_capacity, all->ring_count);
    for (uint32_t r = 0; r < all->ring_count; r++) {
        const struct JoxWallRing *ring = &all->rings[r];
        JOX_ASSERT(ring->first >= out->count && ring->first + ring->count <= all->count);
        if (!stands(ring, gates, doors))
            continue;
        uint32_t back = ring->first - out->count; /* rings are contiguous */
        for (uint32_t i = ring->first; i < ring->first + ring->count; i++) {
            JoxWallVertex *v = &out->vertices[out->count++];
            *v = all->vertices[i];
            v->next -= back;
            v->previous -= back;
        }
        out->rings[out->ring_count++] = (struct JoxWallRing){.first = ring->first - back,
                                                             .count = ring->count,
                                                             .solid = ring->solid,
                                                             .outline = ring->outline,
                                                             .height = ring->height};
    }
}

void jox_walls_standing(JoxWalls *out, const JoxWalls *all, bool gates) {
    copy_standing(out, all, gates, SHUT_DOORS);
}

void jox_walls_for_ways(JoxWalls *out, const JoxWalls *all, bool gates) {
    copy_standing(out, all, gates, NO_DOORS);
}

void jox_walls_dividing(JoxWalls *out, const JoxWalls *all) {
    copy_standing(out, all, true, ALL_DOORS);
}

uint32_t jox_walls_given(const JoxWalls *walls, uint32_t ring, bool *closed, bool *twin) {
    JOX_ASSERT(ring < walls->ring_count);
    const struct JoxWallRing *r = &walls->rings[ring];
    const JoxWallVertex *v = walls->vertices + r->first;
    const uint32_t n = r->count;
    bool back = !r->solid && n % 2 == 0 &&
                (n == 2 || (v[1].point.x == v[n - 1].point.x && v[1].point.y == v[n - 1].point.y));
    *closed = !back;
    *twin = !back && !r->solid;
    return back ? n / 2 + 1 : n;
}

void jox_walls_free(JoxWalls *walls) {
    for (uint32_t r = 0; r < walls->ring_count; r++)
        jox_free(walls->rings[r].name);
    jox_free(walls->vertices);
    jox_free(walls->rings);
    *walls = (JoxWalls){0};
}
