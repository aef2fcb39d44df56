#include "geom/wall_way.h"

#include <math.h>

#include "base/assert.h"
#include "geom/polygon.h"

static const float SKIN = 0.001f; /* m: distance kept from a wall that stopped a move */
#define MOST_PIECES                                                                                \
    1e5f /* greatest number of pieces of a move; longer ones lead out of                           \
            the world */

/* Finds the first edge that the move p -> q crosses from its outer side; t in [0, 1] along the
   move. */
static bool find_first_crossed(const JoxWallGrid *grid, JoxV2 p, JoxV2 q, uint32_t *edge,
                               float *t) {
    uint32_t count;
    const uint32_t *edges = jox_wall_grid_at(grid, p, &count);
    float best = 2.0f;
    JoxV2 way = jox_sub(q, p);
    for (uint32_t i = 0; i < count; i++) {
        const JoxWallVertex *v = &grid->walls->vertices[edges[i]];
        JoxV2 a = v->point, b = grid->walls->vertices[v->next].point;
        float before = jox_det(v->direction, jox_sub(p, a));
        float after = jox_det(v->direction, jox_sub(q, a));
        /* Outside is to the right: negative. Points on the line count as outside. */
        if (before > 0.0f || after < 0.0f || before == after)
            continue;
        float at = before / (before - after);
        float along = jox_dot(jox_sub(jox_add(p, jox_scale(way, at)), a), v->direction);
        if (along < -SKIN || along > jox_length(jox_sub(b, a)) + SKIN || at >= best)
            continue;
        best = at;
        *edge = edges[i];
        *t = at;
    }
    return best <= 1.0f;
}

/* Stops a move at the wall that it would cross, and lets it slide along the wall. */
static JoxV2 stop_at_walls(const JoxWallGrid *grid, JoxV2 p, JoxV2 q) {
    for (int round = 0; round < 3; round++) {
        uint32_t edge = 0;
        float t;
        if (!find_first_crossed(grid, p, q, &edge, &t))
            return q;
        JOX_ASSERT(edge < grid->walls->count && t >= 0.0f && t <= 1.0f);
        JoxV2 normal = jox_scale(jox_left(grid->walls->vertices[edge].direction), -1.0f);
        JoxV2 a = grid->walls->vertices[edge].point;
        float outside = jox_dot(jox_sub(q, a), normal);
        q = jox_add(q, jox_scale(normal, SKIN - outside));
    }
    return p; /* a corner narrower than the move: stay */
}

/* Splits a move that is longer than the grid's reach. Returns the start of the piece in which a
   wall stops it, or of the last one, and sets *q to that piece's end. */
static JoxV2 find_blocked_piece(const JoxWallGrid *grid, JoxV2 p, JoxV2 *q) {
    const JoxV2 way = jox_sub(*q, p);
    const float length = jox_length(way), pieces = ceilf(length / grid->reach);
    if (!(pieces > 1.0f && pieces < MOST_PIECES))
        return p;
    JoxV2 from = p, to = p;
    for (float n = 1.0f; n <= pieces; n++) {
        uint32_t edge;
        float t;
        from = to;
        to = jox_add(p, jox_scale(way, n / pieces));
        if (find_first_crossed(grid, from, to, &edge, &t))
            break;
    }
    *q = to;
    return from;
}

/* Moves a point out of walls that are nearer than the radius. */
static JoxV2 keep_clear(const JoxWallGrid *grid, JoxV2 p, float radius) {
    uint32_t count;
    const uint32_t *edges = jox_wall_grid_at(grid, p, &count);
    for (uint32_t i = 0; i < count; i++) {
        const JoxWallVertex *v = &grid->walls->vertices[edges[i]];
        JoxV2 a = v->point, b = grid->walls->vertices[v->next].point;
        if (jox_det(v->direction, jox_sub(p, a)) >= 0.0f)
            continue;
        JoxV2 out = jox_sub(p, jox_segment_nearest(a, b, p));
        float d2 = jox_length2(out);
        if (d2 >= radius * radius || d2 == 0.0f)
            continue;
        float distance = sqrtf(d2);
        p = jox_add(p, jox_scale(out, (radius - distance) / distance));
    }
    return p;
}

/* Returns on which side of the line through a and b a point lies: 1 left, -1 right, 0 on it. */
static int find_line_side(JoxV2 a, JoxV2 b, JoxV2 p) {
    const double d =
        ((double)b.x - a.x) * ((double)p.y - a.y) - ((double)b.y - a.y) * ((double)p.x - a.x);
    return (d > 0.0) - (d < 0.0);
}

bool jox_edge_lies_between(JoxV2 a, JoxV2 b, JoxV2 p, JoxV2 q) {
    return jox_boxes_meet(a, b, p, q) && find_line_side(a, b, p) * find_line_side(a, b, q) < 0 &&
           find_line_side(p, q, a) * find_line_side(p, q, b) <= 0;
}

/* For assertions: returns whether a move crosses an edge on whose outer side it clearly begins. */
static bool leads_through_edge(const JoxWallGrid *grid, JoxV2 p, JoxV2 q) {
    uint32_t count;
    const uint32_t *edges = jox_wall_grid_at(grid, p, &count);
    for (uint32_t i = 0; i < count; i++) {
        const JoxWallVertex *v = &grid->walls->vertices[edges[i]];
        if (jox_det(v->direction, jox_sub(p, v->point)) < -0.5f * SKIN &&
            jox_edge_lies_between(v->point, grid->walls->vertices[v->next].point, p, q))
            return true;
    }
    return false;
}

JoxV2 jox_way_by_walls(const JoxWallGrid *grid, JoxV2 from, JoxV2 to, float radius) {
    uint32_t near;
    if (jox_length2(jox_sub(to, from)) > grid->reach * grid->reach)
        from = find_blocked_piece(grid, from, &to);
    jox_wall_grid_at(grid, from, &near);
    if (near == 0)
        return to;
    const JoxV2 clear = keep_clear(grid, stop_at_walls(grid, from, to), radius);
    const JoxV2 end = stop_at_walls(grid, from, clear);
    JOX_ASSERT(!leads_through_edge(grid, from, end));
    return end;
}

bool jox_walls_lie_between(const JoxWalls *walls, JoxV2 p, JoxV2 q, const bool *passable) {
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        for (uint32_t i = 0; i < ring->count && !(passable && passable[r]); i++) {
            const JoxWallVertex *v = &walls->vertices[ring->first + i];
            if (jox_edge_lies_between(v->point, walls->vertices[v->next].point, p, q))
                return true;
        }
    }
    return false;
}
