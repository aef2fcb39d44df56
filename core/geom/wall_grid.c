/* Builds the grid over the edges of walls, and answers queries on it. */
#include "geom/wall_grid.h"

#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "geom/polygon.h"
#include "simd/four.h"

enum { MOST_CELLS = 1 << 20 };
static const float SLACK = 1e-5f; /* relative to coordinates: exceeds the rounding of distances */

static const JoxWallVertex *get_edge_end(const JoxWalls *walls, uint32_t edge) {
    return &walls->vertices[walls->vertices[edge].next];
}

void jox_wall_grid_free(JoxWallGrid *grid) {
    jox_free(grid->first);
    jox_free(grid->edges);
    jox_free(grid->nearest);
    *grid = (JoxWallGrid){0};
}

typedef struct CellRange {
    uint32_t x0, x1, y0, y1;
} CellRange;

static uint32_t clamp_cell(float at, uint32_t count) {
    return at <= 0.0f ? 0 : at >= (float)(count - 1) ? count - 1 : (uint32_t)at;
}

/* Returns the cells that the bounding box of an edge reaches, extended by `reach`. */
static CellRange find_cells_near_edge(const JoxWallGrid *g, uint32_t edge) {
    JoxV2 a = g->walls->vertices[edge].point, b = get_edge_end(g->walls, edge)->point;
    return (CellRange){
        clamp_cell(floorf((jox_minf(a.x, b.x) - g->reach - g->low.x) / g->cell), g->columns),
        clamp_cell(floorf((jox_maxf(a.x, b.x) + g->reach - g->low.x) / g->cell), g->columns),
        clamp_cell(floorf((jox_minf(a.y, b.y) - g->reach - g->low.y) / g->cell), g->rows),
        clamp_cell(floorf((jox_maxf(a.y, b.y) + g->reach - g->low.y) / g->cell), g->rows)};
}

/* Returns the square, m2, of the distance from a point to an edge. */
static float find_edge_distance2(const JoxWalls *walls, uint32_t edge, JoxV2 p) {
    const JoxV2 near =
        jox_segment_nearest(walls->vertices[edge].point, get_edge_end(walls, edge)->point, p);
    return jox_length2(jox_sub(near, p));
}

/* Returns a bound for the distance, m, of all points of a cell to an edge. */
static float find_edge_away(const JoxWallGrid *g, uint32_t x, uint32_t y, uint32_t edge) {
    const JoxV2 centre = {g->low.x + ((float)x + 0.5f) * g->cell,
                          g->low.y + ((float)y + 0.5f) * g->cell};
    return sqrtf(find_edge_distance2(g->walls, edge, centre)) - 0.7072f * g->cell -
           SLACK * (fabsf(centre.x) + fabsf(centre.y));
}

/* Sets the grid's box and cell size: 1 m, or more if it would have more than MOST_CELLS cells. */
static void size_grid(JoxWallGrid *g) {
    JoxV2 high = {-INFINITY, -INFINITY};
    g->low = (JoxV2){INFINITY, INFINITY};
    for (uint32_t i = 0; i < g->walls->count; i++) {
        JoxV2 p = g->walls->vertices[i].point;
        g->low = (JoxV2){jox_minf(g->low.x, p.x), jox_minf(g->low.y, p.y)};
        high = (JoxV2){jox_maxf(high.x, p.x), jox_maxf(high.y, p.y)};
    }
    g->low = jox_sub(g->low, (JoxV2){g->reach, g->reach});
    high = jox_add(high, (JoxV2){g->reach, g->reach});
    g->cell = jox_maxf(1.0f, sqrtf((high.x - g->low.x) * (high.y - g->low.y) / MOST_CELLS));
    g->cell = jox_maxf(g->cell, jox_maxf(high.x - g->low.x, high.y - g->low.y) / 32768.0f);
    g->columns = (uint32_t)((high.x - g->low.x) / g->cell) + 1;
    g->rows = (uint32_t)((high.y - g->low.y) / g->cell) + 1;
}

/* Lists an edge in the cells that it comes near; only counts if the list does not exist yet. */
static void enter_edge(JoxWallGrid *g, uint32_t edge) {
    if (g->walls->vertices[edge].covered)
        return;
    CellRange r = find_cells_near_edge(g, edge);
    JOX_ASSERT(r.x0 <= r.x1 && r.x1 < g->columns && r.y0 <= r.y1 && r.y1 < g->rows);
    for (uint32_t y = r.y0; y <= r.y1; y++)
        for (uint32_t x = r.x0; x <= r.x1; x++) {
            uint32_t *first = &g->first[(size_t)y * g->columns + x];
            const float away = find_edge_away(g, x, y, edge);
            if (!(away <= g->reach))
                continue;
            if (!g->edges) {
                ++*first;
                continue;
            }
            g->edges[--*first] = edge;
            g->nearest[*first] =
                (JoxNearEdge){jox_maxf(0.0f, away), edge, g->walls->vertices[edge].point,
                              get_edge_end(g->walls, edge)->point};
        }
}

/* Sorts the edges of each cell in `nearest`, nearest first. */
static void sort_by_distance(JoxWallGrid *g) {
    for (size_t c = 0; c < (size_t)g->columns * g->rows; c++)
        for (uint32_t k = g->first[c]; k < g->first[c + 1]; k++) {
            const JoxNearEdge own = g->nearest[k];
            uint32_t at = k;
            for (; at > g->first[c] && g->nearest[at - 1].away > own.away; at--)
                g->nearest[at] = g->nearest[at - 1];
            g->nearest[at] = own;
        }
}

/* Asserts that lists of cells are contiguous and ascending. */
static void check_wall_grid(const JoxWallGrid *g) {
    size_t cells = (size_t)g->columns * g->rows;
    JOX_ASSERT(cells > 0 && g->cell > 0.0f && g->reach > 0.0f);
    JOX_ASSERT(g->first[0] == 0);
    for (size_t c = 0; c < cells; c++) {
        JOX_ASSERT(g->first[c] <= g->first[c + 1]);
        for (uint32_t k = g->first[c]; k < g->first[c + 1]; k++) {
            JOX_ASSERT(g->edges[k] < g->walls->count);
            JOX_ASSERT(k == g->first[c] || g->edges[k - 1] < g->edges[k]);
            JOX_ASSERT(k == g->first[c] || g->nearest[k - 1].away <= g->nearest[k].away);
        }
    }
}

void jox_wall_grid_reset(JoxWallGrid *g, float reach) {
    const JoxWalls *walls = g->walls;
    jox_wall_grid_free(g);
    g->walls = walls;
    if (!walls || walls->count == 0 || !(reach > 0.0f))
        return;
    g->reach = reach;
    size_grid(g);
    size_t cells = (size_t)g->columns * g->rows;
    g->first = jox_alloc(cells + 1, sizeof *g->first);
    for (uint32_t e = 0; e < walls->count; e++)
        enter_edge(g, e);
    for (size_t c = 1; c <= cells; c++)
        g->first[c] += g->first[c - 1];
    g->edges = jox_alloc(g->first[cells] + 1, sizeof *g->edges);
    g->nearest = jox_alloc(g->first[cells] + 4, sizeof *g->nearest); /* four are loaded at once */
    for (uint32_t e = walls->count; e-- > 0;) /* backwards, as lists are filled from their end */
        enter_edge(g, e);
    sort_by_distance(g);
    JOX_CHECK(check_wall_grid(g));
}

void jox_wall_grid_fit(JoxWallGrid *g, float reach) {
    if (g->walls && g->walls->count > 0 && reach > g->reach)
        jox_wall_grid_reset(g, reach * 1.25f); /* with a margin, so that it is not rebuilt in each
                                                  step */
}

bool jox_wall_grid_is_near(const JoxWallGrid *grid, JoxV2 p, float clear) {
    uint32_t count;
    const JoxNearEdge *near = jox_wall_grid_nearest(grid, p, &count);
    for (uint32_t k = 0; k < count && near[k].away < clear; k++)
        if (find_edge_distance2(grid->walls, near[k].edge, p) < clear * clear)
            return true;
    return false;
}

bool jox_walls_ring_holds(const JoxWalls *walls, uint32_t ring, JoxV2 p) {
    const struct JoxWallRing *r = &walls->rings[ring];
    bool inside = false;
    for (uint32_t i = 0; i < r->count; i++) {
        JoxV2 a = walls->vertices[r->first + i].point, b = get_edge_end(walls, r->first + i)->point;
        if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x)
            inside = !inside;
    }
    return inside;
}

bool jox_walls_contain(const JoxWalls *walls, JoxV2 p) {
    for (uint32_t r = 0; walls && r < walls->ring_count; r++)
        if (walls->rings[r].solid && jox_walls_ring_holds(walls, r, p))
            return true;
    return false;
}

bool jox_segments_cross(JoxV2 p, JoxV2 q, JoxV2 a, JoxV2 b) {
    JoxV2 way = jox_sub(q, p), edge = jox_sub(b, a);
    float p_side = jox_det(edge, jox_sub(p, a)), q_side = jox_det(edge, jox_sub(q, a));
    float a_side = jox_det(way, jox_sub(a, p)), b_side = jox_det(way, jox_sub(b, p));
    return (p_side > 0.0f) != (q_side > 0.0f) && (a_side > 0.0f) != (b_side > 0.0f);
}

/* Four edges of a cell, m. */
typedef struct FourEdges {
    JoxFour x, y, end_x, end_y; /* start and end */
    JoxFour way_x, way_y;       /* from start to end */
    JoxFourMask there;          /* which of them the cell has */
} FourEdges;

/* Loads four edges, of which the cell has the first `left`. */
static inline FourEdges load_edges(const JoxNearEdge *near, uint32_t left) {
    const JoxFourMask numbers = {0, 1, 2, 3};
    JoxFour ends[4];
    for (int k = 0; k < 4; k++)
        ends[k] = jox_load_four(&near[k].start.x);
    jox_transpose_four(ends);
    return (FourEdges){.x = ends[0],
                       .y = ends[1],
                       .end_x = ends[2],
                       .end_y = ends[3],
                       .way_x = ends[2] - ends[0],
                       .way_y = ends[3] - ends[1],
                       .there = numbers < (int)left};
}

/* Returns whether the segment p -> q crosses any of four edges, as jox_segments_cross does. */
static inline bool is_any_crossed(const FourEdges *e, JoxV2 p, JoxV2 q) {
    const JoxFour p_side = e->way_x * (p.y - e->y) - e->way_y * (p.x - e->x);
    const JoxFour q_side = e->way_x * (q.y - e->y) - e->way_y * (q.x - e->x);
    const JoxFourMask apart = ((p_side > 0.0f) ^ (q_side > 0.0f)) & e->there;
    if (!jox_any_of_four(apart))
        return false;
    const JoxV2 way = jox_sub(q, p);
    const JoxFour start_side = way.x * (e->y - p.y) - way.y * (e->x - p.x);
    const JoxFour end_side = way.x * (e->end_y - p.y) - way.y * (e->end_x - p.x);
    return jox_any_of_four(apart & ((start_side > 0.0f) ^ (end_side > 0.0f)));
}

bool jox_wall_grid_has_wall_between(const JoxWallGrid *g, JoxV2 from, JoxV2 to) {
    const float d2 = jox_length2(jox_sub(to, from));
    uint32_t count;
    const JoxNearEdge *near = jox_wall_grid_nearest(g, from, &count);
    for (uint32_t k = 0; k < count && near[k].away * near[k].away <= d2; k += 4) {
        const FourEdges edges = load_edges(near + k, count - k);
        if (is_any_crossed(&edges, from, to))
            return true;
    }
    return false;
}

float jox_wall_grid_unhidden_distance2(const JoxWallGrid *g, JoxV2 from) {
    const float size = fabsf(from.x) + fabsf(from.y);
    uint32_t count;
    const JoxNearEdge *near = jox_wall_grid_nearest(g, from, &count);
    float least = INFINITY;
    for (uint32_t k = 0; k < count && near[k].away < least; k++) {
        const JoxV2 direction = g->walls->vertices[near[k].edge].direction;
        const JoxV2 out = jox_sub(from, near[k].start);
        const float beside = fabsf(jox_det(direction, out));
        if (beside > least)
            continue;
        const float along = jox_dot(direction, out);
        const float length = jox_dot(direction, jox_sub(near[k].end, near[k].start));
        const float beyond = jox_maxf(-along, along - length);
        const float far = beyond > 0.0f ? jox_length(jox_v2(beside, beyond)) : beside;
        least = jox_minf(far - SLACK * (fabsf(out.x) + fabsf(out.y) + size), least);
    }
    least = jox_maxf(least, 0.0f);
    return least * least;
}
