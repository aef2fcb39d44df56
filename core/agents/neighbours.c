#include "agents/neighbours.h"

#include "base/mem.h"

void jox_neighbours_reserve(JoxNeighbours *n, uint32_t agents, uint32_t stride) {
    if (agents <= n->agents && stride <= n->stride)
        return;
    uint32_t room = (agents + agents / 8 + JOX_LANES) / JOX_LANES * JOX_LANES;
    JoxNeighbours larger = {.agents = room > n->agents ? room : n->agents,
                            .stride = stride > n->stride ? stride : n->stride};
    jox_neighbours_free(n);
    *n = larger;
    size_t entries = (size_t)n->agents * n->stride;
    n->index = jox_alloc_aligned(entries, sizeof *n->index);
    n->count = jox_alloc_aligned(n->agents, sizeof *n->count);
    n->close = jox_alloc_aligned(n->agents, sizeof *n->close);
    n->crowding2 = jox_alloc_aligned(n->agents, sizeof *n->crowding2);
    n->motions = jox_alloc_aligned(n->agents, sizeof *n->motions);
    n->shapes = jox_alloc_aligned(n->agents, sizeof *n->shapes);
    n->touch_index =
        jox_alloc_aligned((size_t)n->agents * JOX_MOST_NEIGHBOURS, sizeof *n->touch_index);
    n->touch_count = jox_alloc_aligned(n->agents, sizeof *n->touch_count);
}

void jox_neighbours_reserve_belts(JoxNeighbours *n) {
    if (n->belt_x)
        return;
    n->belt_x = jox_alloc_aligned(n->agents, sizeof *n->belt_x);
    n->belt_y = jox_alloc_aligned(n->agents, sizeof *n->belt_y);
}

void jox_neighbours_free(JoxNeighbours *n) {
    jox_free(n->index);
    jox_free(n->count);
    jox_free(n->close);
    jox_free(n->crowding2);
    jox_free(n->motions);
    jox_free(n->shapes);
    jox_free(n->belt_x);
    jox_free(n->belt_y);
    jox_free(n->touch_index);
    jox_free(n->touch_count);
    *n = (JoxNeighbours){0};
}
