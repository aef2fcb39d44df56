/* Finds the contacts between agents, and of agents with walls and bodies, by the kernel of the
   run's instruction set, chunk by chunk. */
#include <string.h>

#include "base/mem.h"
#include "force/contact/contacts.h"

#define X(name, isa) [isa] = jox_find_packets_##name,
static JoxFindKernel *const KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

static void find_contacts_of_chunk(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    JoxFoundContacts *found = &f->contacts->found;
    const uint32_t chunk = begin / JOX_FORCE_GRAIN;
    jox_chunk_clear(&found->pairs, chunk);
    jox_chunk_clear(&found->walls, chunk);
    found->overlaps[chunk] = 0;
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
    JoxFoundContacts *found = &f->contacts->found;
    uint32_t n = f->step.agents->count;
    jox_chunks_reserve(&found->pairs, &f->found_memory, f->chunks,
                       jox_most_chunk_agents(f) * JOX_FOUND_RUN, sizeof(JoxFoundPair));
    jox_chunks_reserve(&found->slots, NULL, f->chunks, found->pairs.room, sizeof(JoxPairSlot));
    jox_chunks_reserve(&found->walls, NULL, f->chunks,
                       jox_most_chunk_agents(f) * JOX_CONTACT_MOST_WALLS, sizeof(JoxFoundWall));
    JOX_RESERVE(found->first_pair, found->first_pair_capacity, n + JOX_LANES);
    JOX_RESERVE(found->pair_count, found->pair_count_capacity, n + JOX_LANES);
    JOX_RESERVE(found->first_wall, found->first_wall_capacity, n + JOX_LANES);
    JOX_RESERVE(found->wall_count, found->wall_count_capacity, n + JOX_LANES);
    JOX_RESERVE(found->overlaps, found->overlap_capacity, f->chunks);
    if (f->has_bodies)
        jox_touches_reserve(f);
    found->has_full_list = n && has_full_list(f->step.neighbours, n);
    jox_parallel_for(f->step.pool, n, JOX_FORCE_GRAIN, find_contacts_of_chunk, f);
    for (uint32_t c = 0; c < f->chunks; c++)
        f->totals.pairs += found->overlaps[c];
}

void jox_found_contacts_free(JoxFoundContacts *found) {
    void *owned[] = {found->first_pair, found->first_wall, found->pair_count, found->wall_count,
                     found->overlaps};
    jox_chunks_free(&found->pairs);
    jox_chunks_free(&found->slots);
    jox_chunks_free(&found->walls);
    for (size_t i = 0; i < sizeof owned / sizeof *owned; i++)
        jox_free(owned[i]);
}
