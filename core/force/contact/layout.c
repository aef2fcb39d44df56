/* Lays out the contacts found for the solve, in an order that depends on ids alone, each with the
   impulse that it had in the last step; keeps the impulses afterwards. */
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "force/kernels.h"

#define X(name, isa) [isa] = jox_start_packets_##name,
static JoxStartKernel *const KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

/* Advances *at through the kept impulses, as contacts come in ascending order of ids. */
float jox_kept_impulse(const JoxKeptImpulses *kept, size_t *at, uint32_t id, uint32_t other) {
    const JoxKeptImpulse *items = kept->items;
    while (*at < kept->count &&
           (items[*at].id < id || (items[*at].id == id && items[*at].other < other)))
        ++*at;
    bool found = *at < kept->count && items[*at].id == id && items[*at].other == other;
    return found ? items[*at].impulse : 0.0f;
}

static inline const JoxFoundPair *get_found(const JoxForces *f, uint32_t i) {
    return (const JoxFoundPair *)f->found.items + f->found_first[i];
}

static inline JoxPairSlot *get_slots(const JoxForces *f, uint32_t i) {
    return (JoxPairSlot *)f->slots.items + f->found_first[i];
}

/* Prefetches the data of an agent that comes AHEAD agents later: consecutive ids are scattered in
   memory. */
enum { AHEAD = 6 };
static inline void prefetch_agent(const JoxForces *f, uint32_t i) {
    __builtin_prefetch(get_slots(f, i));
    __builtin_prefetch(&f->colours_of[i], 1);
    __builtin_prefetch(&f->found_number[i]);
    __builtin_prefetch(&f->end_starts[i], 1);
}

/* Gives each pair, in ascending order of ids, the first colour that neither of its agents has, and
   its number among the contacts of either agent. Finds where the kept impulses of each agent
   begin. */
static void colour_pairs(JoxForces *f) {
    const JoxAgents *a = f->step.agents;
    const JoxKeptImpulses *were = &f->kept_pairs;
    uint32_t listed = 0, kept = 0;
    memset(f->colours_of, 0, a->count * sizeof *f->colours_of);
    memset(f->end_starts, 0, ((size_t)a->count + 1) * sizeof *f->end_starts);
    for (uint32_t r = 0; r < a->count; r++) {
        const uint32_t i = a->by_rank[r], id = a->rank_id[r], number = f->found_number[i];
        if (r + AHEAD < a->count)
            prefetch_agent(f, a->by_rank[r + AHEAD]);
        if (!number)
            continue;
        while (kept < were->count && were->items[kept].id < id)
            kept++;
        f->listed[i] = (JoxListed){listed, kept};
        JoxPairSlot *slot = get_slots(f, i);
        for (uint32_t k = 0; k < number; k++, slot++) {
            const uint64_t open = ~(f->colours_of[i] | f->colours_of[slot->other]);
            if (open == 0) { /* only in a heap of hundreds of agents */
                slot->colour = JOX_NO_COLOUR;
                continue;
            }
            slot->colour = (uint8_t)__builtin_ctzll(open);
            f->colours_of[i] |= (uint64_t)1 << slot->colour;
            f->colours_of[slot->other] |= (uint64_t)1 << slot->colour;
            slot->first_end = (uint8_t)f->end_starts[i]++;
            slot->second_end = (uint8_t)f->end_starts[slot->other]++;
            listed++;
        }
    }
    uint32_t ends = 0;
    for (uint32_t i = 0; i <= a->count; i++) { /* turns numbers of contacts into starts */
        const uint32_t number = i < a->count ? f->end_starts[i] : 0;
        f->end_starts[i] = ends;
        ends += number;
    }
    JOX_ASSERT(ends == 2 * listed);
    f->pairs.count = listed;
}

/* Counts the pairs of each colour that agents [begin, end) found. */
static void count_chunk(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)end, (void)worker;
    JoxForces *f = context;
    const uint32_t chunk = begin / JOX_FORCE_GRAIN, first = chunk * f->slots.room;
    const JoxPairSlot *slots = (const JoxPairSlot *)f->slots.items + first;
    uint32_t *sizes = f->colour_sizes[chunk];
    memset(sizes, 0, sizeof f->colour_sizes[chunk]);
    for (uint32_t n = 0; n < f->found.counts[chunk]; n++)
        if (slots[n].colour != JOX_NO_COLOUR)
            sizes[slots[n].colour]++;
}

/* Turns the counts of pairs, per chunk and colour, into the place of the first one. */
static void start_colours(JoxForces *f) {
    JoxPairs *p = &f->pairs;
    uint32_t sum = 0;
    p->colours = 0;
    for (uint32_t colour = 0; colour < JOX_CONTACT_MOST_COLOURS; colour++) {
        p->starts[colour] = sum;
        for (uint32_t chunk = 0; chunk < f->chunks; chunk++) {
            const uint32_t size = f->colour_sizes[chunk][colour];
            f->colour_sizes[chunk][colour] = sum;
            sum += size;
        }
        if (sum > p->starts[colour])
            p->colours = colour + 1;
    }
    JOX_ASSERT(sum == p->count);
    p->starts[JOX_CONTACT_MOST_COLOURS] = sum;
}

/* Writes the pairs that agents [begin, end) found into the ranges of their colours, with the kept
   impulses. */
static void place_chunk(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    const JoxAgents *a = f->step.agents;
    uint32_t *next = f->colour_sizes[begin / JOX_FORCE_GRAIN];
    for (uint32_t i = begin; i < end; i++) {
        const JoxFoundPair *found = get_found(f, i);
        const JoxPairSlot *slots = get_slots(f, i);
        size_t kept = f->found_number[i] ? f->listed[i].kept : 0;
        for (uint32_t k = 0; k < f->found_number[i]; k++) {
            if (slots[k].colour == JOX_NO_COLOUR)
                continue;
            const uint32_t at = next[slots[k].colour]++, j = found[k].other;
            f->pairs.items[at] =
                (JoxPair){i,
                          j,
                          found[k].normal,
                          found[k].target,
                          found[k].mass,
                          found[k].squeeze,
                          jox_kept_impulse(&f->kept_pairs, &kept, a->id[i], found[k].other_id)};
            f->ends[f->end_starts[i] + slots[k].first_end] = (JoxEnd){at, j};
            f->ends[f->end_starts[j] + slots[k].second_end] = (JoxEnd){at, i};
        }
    }
}

/* Lists the contacts with walls, in ascending order of agent ids. */
static void lay_walls(JoxForces *f) {
    const JoxAgents *a = f->step.agents;
    const JoxParameterColumn e = a->param[JOX_PARAM_restitution];
    const float dt = (float)f->step.dt;
    size_t kept = 0;
    for (uint32_t r = 0; r < a->count; r++) {
        uint32_t i = a->by_rank[r];
        JoxFoundWall *found = (JoxFoundWall *)f->found_walls.items + f->wall_first[i];
        if (f->wall_number[i])
            f->wall_first[i] = f->wall_group[f->wall_groups++] = f->wall_count;
        for (uint32_t k = 1; k < f->wall_number[i]; k++) { /* sorts by edge */
            JoxFoundWall moved = found[k];
            uint32_t at = k;
            for (; at > 0 && found[at - 1].edge > moved.edge; at--)
                found[at] = found[at - 1];
            found[at] = moved;
        }
        for (uint32_t k = 0; k < f->wall_number[i]; k++) {
            float speed = jox_dot(jox_v2(a->vx[i], a->vy[i]), found[k].normal);
            f->wall[f->wall_count++] = (JoxWallContact){
                .agent = i,
                .edge = found[k].edge,
                .normal = found[k].normal,
                .along = found[k].along,
                .target = jox_contact_target(found[k].gap, speed, jox_at(e, i), dt),
                .impulse = jox_kept_impulse(&f->kept_walls, &kept, a->id[i], found[k].edge)};
        }
    }
    f->wall_group[f->wall_groups] = f->wall_count;
}

static uint32_t sum_counts(const uint32_t *counts, uint32_t chunks) {
    uint32_t sum = 0;
    for (uint32_t c = 0; c < chunks; c++)
        sum += counts[c];
    return sum;
}

/* Makes room for all contacts. */
static void reserve_layout(JoxForces *f, uint32_t pairs, uint32_t walls) {
    const uint32_t agents = f->step.agents->count;
    /* Room for a dense crowd from the start, so that a steady step never allocates. */
    const uint32_t room = pairs > 4 * agents ? pairs : 4 * agents;
    f->colours_of = jox_stage_memory_take(f->memory, agents, sizeof *f->colours_of);
    JOX_RESERVE(f->colour_sizes, f->colour_size_capacity, f->chunks);
    JOX_RESERVE(f->listed, f->listed_capacity, agents);
    JOX_RESERVE(f->end_starts, f->end_start_capacity, (size_t)agents + 1);
    JOX_RESERVE(f->pairs.items, f->pairs.capacity, room);
    JOX_RESERVE(f->ends, f->end_capacity, 2 * (size_t)room);
    f->velocities = jox_stage_memory_take(f->memory, agents + JOX_LANES, sizeof *f->velocities);
    f->inverse_mass = jox_stage_memory_take(f->memory, agents + JOX_LANES, sizeof *f->inverse_mass);
    JOX_RESERVE(f->wall, f->wall_capacity, walls);
    JOX_RESERVE(f->wall_group, f->wall_group_capacity, (size_t)walls + 1);
}

/* Computes the velocities of a chunk of agents without contacts. */
static void start_chunk(JoxForces *f, uint32_t chunk) {
    const uint32_t count = f->step.agents->count, begin = chunk * JOX_FORCE_GRAIN;
    const uint32_t end = begin + JOX_FORCE_GRAIN;
    KERNELS[f->isa](f, begin, end < count ? end : count);
}

/* Tasks of the layout, which run at the same time: pairs and walls, each on one thread through all
   agents in the order of ids; from STARTS on, one task per chunk, which computes the velocities
   that the solve starts from. */
enum { PAIRS, WALLS, STARTS };
typedef struct Layout {
    JoxForces *forces;
    uint32_t pairs, walls; /* numbers found */
} Layout;

static void lay_part(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const Layout *layout = context;
    for (uint32_t part = begin; part < end; part++)
        if (part >= STARTS)
            start_chunk(layout->forces, part - STARTS);
        else if (part == PAIRS && layout->pairs)
            colour_pairs(layout->forces);
        else if (part == WALLS && layout->walls)
            lay_walls(layout->forces);
}

void jox_contacts_lay_out(JoxForces *f) {
    const uint32_t agents = f->step.agents->count;
    Layout layout = {f, sum_counts(f->found.counts, f->chunks),
                     sum_counts(f->found_walls.counts, f->chunks)};
    const bool touched = f->has_bodies && sum_counts(f->touches.counts, f->chunks);
    reserve_layout(f, layout.pairs, layout.walls);
    f->wall_count = f->wall_groups = 0;
    f->pairs.count = f->pairs.colours = 0;
    if (layout.pairs || layout.walls || touched)
        jox_parallel_for(f->chunks > 1 ? f->step.pool : NULL,
                         STARTS + (f->options.literal ? 0 : f->chunks), 1, lay_part, &layout);
    JOX_ASSERT(f->wall_count == layout.walls);
    if (layout.pairs) {
        jox_parallel_for(f->step.pool, agents, JOX_FORCE_GRAIN, count_chunk, f);
        start_colours(f);
        jox_parallel_for(f->step.pool, agents, JOX_FORCE_GRAIN, place_chunk, f);
        return;
    }
    memset(f->end_starts, 0, ((size_t)agents + 1) * sizeof *f->end_starts);
}

/* Keeps the impulses of the pairs that agents [begin, end) found, in ascending order of ids. */
static void keep_chunk(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    const uint32_t *id = f->step.agents->id;
    for (uint32_t i = begin; i < end; i++) {
        const JoxFoundPair *found = get_found(f, i);
        const JoxPairSlot *slots = get_slots(f, i);
        uint32_t n = f->found_number[i] ? f->listed[i].pair : 0;
        for (uint32_t k = 0; k < f->found_number[i]; k++) {
            if (slots[k].colour == JOX_NO_COLOUR)
                continue;
            const uint32_t at = f->ends[f->end_starts[i] + slots[k].first_end].pair;
            f->kept_pairs.items[n++] =
                (JoxKeptImpulse){id[i], found[k].other_id, f->pairs.items[at].impulse};
        }
    }
}

void jox_contacts_keep(JoxForces *f) {
    const JoxAgents *a = f->step.agents;
    JOX_RESERVE(f->kept_pairs.items, f->kept_pairs.capacity, f->pairs.count);
    f->kept_pairs.count = f->pairs.count;
    if (f->pairs.count)
        jox_parallel_for(f->step.pool, a->count, JOX_FORCE_GRAIN, keep_chunk, f);
    JOX_RESERVE(f->kept_walls.items, f->kept_walls.capacity, f->wall_count);
    f->kept_walls.count = f->wall_count;
    for (uint32_t k = 0; k < f->wall_count; k++)
        f->kept_walls.items[k] =
            (JoxKeptImpulse){a->id[f->wall[k].agent], f->wall[k].edge, f->wall[k].impulse};
}
