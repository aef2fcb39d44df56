/* Marks the edges of walls that closed or were added (`is_new`), out of which the world then moves
   people. Called when gates close and scenes are edited. */
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/sort.h"
#include "geom/walls.h"

/* An undirected edge: the lesser end first. */
typedef struct Edge {
    JoxV2 a, b;
    bool solid, is_new;
} Edge;

static int compare_points(JoxV2 a, JoxV2 b) {
    if (a.x != b.x)
        return a.x < b.x ? -1 : 1;
    return a.y == b.y ? 0 : a.y < b.y ? -1 : 1;
}

static int compare_edges(const void *left, const void *right, const void *context) {
    const Edge *e = left, *f = right;
    const int first = compare_points(e->a, f->a);
    (void)context;
    if (first)
        return first;
    const int second = compare_points(e->b, f->b);
    return second ? second : (int)e->solid - (int)f->solid;
}

static Edge get_edge(const JoxWalls *walls, uint32_t v, bool solid) {
    const JoxV2 a = walls->vertices[v].point;
    const JoxV2 b = walls->vertices[walls->vertices[v].next].point;
    const bool turned = compare_points(a, b) > 0;
    return (Edge){turned ? b : a, turned ? a : b, solid, walls->vertices[v].is_new};
}

/* Lists the closed edges in order; the caller frees them. */
static Edge *list_standing(const JoxWalls *walls, uint32_t *count) {
    Edge *edges = jox_alloc((size_t)walls->count + 1, sizeof *edges);
    *count = 0;
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        for (uint32_t i = 0; i < ring->count && !ring->open; i++)
            edges[(*count)++] = get_edge(walls, ring->first + i, ring->solid);
    }
    JOX_ASSERT(*count <= walls->count);
    jox_sort(edges, *count, sizeof *edges, compare_edges, NULL, NULL);
    return edges;
}

/* Returns whether an edge is in the list, and was not marked as new there. */
static bool was_closed(const Edge *list, uint32_t count, const Edge *edge) {
    uint32_t low = 0, high = count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        const int order = compare_edges(&list[middle], edge, NULL);
        if (order == 0)
            return !list[middle].is_new;
        if (order < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return false;
}

void jox_walls_mark_ring_new(JoxWalls *walls, uint32_t ring) {
    const struct JoxWallRing *r = &walls->rings[ring];
    JOX_ASSERT(ring < walls->ring_count);
    for (uint32_t i = 0; i < r->count; i++)
        walls->vertices[r->first + i].is_new = true;
}

bool jox_walls_mark_new(JoxWalls *walls, const JoxWalls *before) {
    uint32_t count;
    Edge *list = list_standing(before, &count);
    bool any = false;
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        for (uint32_t i = 0; i < ring->count && !ring->open; i++) {
            const Edge edge = get_edge(walls, ring->first + i, ring->solid);
            JoxWallVertex *v = &walls->vertices[ring->first + i];
            v->is_new |= !was_closed(list, count, &edge);
            any |= v->is_new;
        }
    }
    jox_free(list);
    return any;
}

void jox_walls_clear_new_marks(JoxWalls *walls) {
    for (uint32_t v = 0; v < walls->count; v++)
        walls->vertices[v].is_new = false;
}
