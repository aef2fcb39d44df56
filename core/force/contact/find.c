/* Finds the contacts between agents, and of agents with walls and bodies, by the kernel of the
   run's instruction set, chunk by chunk. */
#include <string.h>

#include "base/assert.h"
#include "force/kernels.h"

#define X(name, isa) [isa] = jox_find_packets_##name,
static JoxFindKernel *const KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

static void find_chunk(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    const uint32_t chunk = begin / JOX_FORCE_GRAIN;
    jox_chunk_empty(&f->found, chunk);
    jox_chunk_empty(&f->found_walls, chunk);
    KERNELS[f->isa](f, begin, end);
    if (f->has_bodies)
        jox_touches_find(f, begin, end);
}

/* Returns whether an agent's list of agents within touch range is full, so that it may lack
   some. */
static bool has_full_list(const JoxNeighbours *near, uint32_t count) {
    return near->touch_count && memchr(near->touch_count, JOX_MOST_NEIGHBOURS, count);
}

void jox_contacts_find(JoxForces *f) {
    uint32_t n = f->step.agents->count;
    jox_chunks_begin(&f->found, f->chunks, jox_chunk_agents(f) * JOX_MOST_NEIGHBOURS,
                     sizeof(JoxFoundPair));
    jox_chunks_begin(&f->slots, f->chunks, f->found.room, sizeof(JoxPairSlot));
    jox_chunks_begin(&f->found_walls, f->chunks, jox_chunk_agents(f) * JOX_CONTACT_MOST_WALLS,
                     sizeof(JoxFoundWall));
    JOX_RESERVE(f->found_first, f->found_first_capacity, n + JOX_LANES);
    JOX_RESERVE(f->found_number, f->found_number_capacity, n + JOX_LANES);
    JOX_RESERVE(f->wall_first, f->wall_first_capacity, n + JOX_LANES);
    JOX_RESERVE(f->wall_number, f->wall_number_capacity, n + JOX_LANES);
    if (f->has_bodies) {
        jox_chunks_begin(&f->touches, f->chunks, jox_chunk_agents(f) * JOX_MOST_BODIES_TOUCHED,
                         sizeof(JoxTouch));
        JOX_RESERVE(f->touch_first, f->touch_first_capacity, n);
        JOX_RESERVE(f->touch_number, f->touch_number_capacity, n);
    }
    f->has_full_list = n && has_full_list(f->step.neighbours, n);
    jox_parallel_for(f->step.pool, n, JOX_FORCE_GRAIN, find_chunk, f);
    for (uint32_t c = 0; c < f->chunks; c++)
        f->totals.pairs += f->chunk[c].overlaps;
}
