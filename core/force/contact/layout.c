/* Lays out the contacts found for the solve, in an order that depends on ids alone, each with the
   impulse that it had in the last step; keeps the impulses afterwards. */
#include <math.h>
#include <string.h>

#include "agents/torso.h"
#include "base/assert.h"
#include "base/mem.h"
#include "force/contact/contacts.h"

#define X(name, isa) [isa] = jox_start_motions_##name,
static JoxMotionKernel *const KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

/* Advances *at through the kept impulses, as contacts come in ascending order of ids. */
const JoxKeptImpulse *jox_find_kept(const JoxKeptImpulses *kept, size_t *at, uint32_t id,
                                    uint32_t other) {
    static const JoxKeptImpulse NONE;
    const JoxKeptImpulse *items = kept->items;
    while (*at < kept->count &&
           (items[*at].id < id || (items[*at].id == id && items[*at].other < other)))
        ++*at;
    bool found = *at < kept->count && items[*at].id == id && items[*at].other == other;
    return found ? &items[(*at)++] : &NONE;
}

static inline const JoxFoundPair *get_found_pairs(const JoxForces *f, uint32_t i) {
    const JoxFoundContacts *found = &f->contacts->found;
    return (const JoxFoundPair *)found->pairs.items + found->first_pair[i];
}

static inline JoxPairSlot *get_slots(const JoxForces *f, uint32_t i) {
    const JoxFoundContacts *found = &f->contacts->found;
    return (JoxPairSlot *)found->slots.items + found->first_pair[i];
}

/* Prefetches the data of an agent that comes AHEAD agents later: consecutive ids are scattered in
   memory. */
enum { AHEAD = 6 };
static inline void prefetch_agent(const JoxForces *f, uint32_t i) {
    const JoxPairs *pairs = &f->contacts->pairs;
    __builtin_prefetch(get_slots(f, i));
    __builtin_prefetch(&pairs->colours_of[i], 1);
    __builtin_prefetch(&f->contacts->found.pair_count[i]);
    __builtin_prefetch(&pairs->end_starts[i], 1);
}

/* Gives each pair, in ascending order of ids, the first colour that neither of its agents has, and
   its number among the contacts of either agent. Finds where the kept impulses of each agent
   begin. */
static void colour_pairs(JoxForces *f) {
    JoxPairs *pairs = &f->contacts->pairs;
    const JoxAgents *a = f->step.agents;
    const JoxKeptImpulses *were = &f->contacts->kept[JOX_KEPT_PAIRS];
    uint32_t listed = 0, kept = 0;
    memset(pairs->colours_of, 0, a->count * sizeof *pairs->colours_of);
    memset(pairs->end_starts, 0, ((size_t)a->count + 1) * sizeof *pairs->end_starts);
    for (uint32_t r = 0; r < a->count; r++) {
        const uint32_t i = a->by_rank[r], id = a->rank_id[r],
                       number = f->contacts->found.pair_count[i];
        if (r + AHEAD < a->count)
            prefetch_agent(f, a->by_rank[r + AHEAD]);
        if (!number)
            continue;
        while (kept < were->count && were->items[kept].id < id)
            kept++;
        pairs->orders[i] = (JoxPairOrder){listed, kept};
        JoxPairSlot *slot = get_slots(f, i);
        for (uint32_t k = 0; k < number; k++, slot++) {
            const uint64_t open = ~(pairs->colours_of[i] | pairs->colours_of[slot->other]);
            if (open == 0) { /* only in a heap of hundreds of agents */
                slot->colour = JOX_NO_COLOUR;
                continue;
            }
            slot->colour = (uint8_t)__builtin_ctzll(open);
            pairs->colours_of[i] |= (uint64_t)1 << slot->colour;
            pairs->colours_of[slot->other] |= (uint64_t)1 << slot->colour;
            slot->first_end = (uint8_t)pairs->end_starts[i]++;
            slot->second_end = (uint8_t)pairs->end_starts[slot->other]++;
            listed++;
        }
    }
    uint32_t ends = 0;
    for (uint32_t i = 0; i <= a->count; i++) { /* turns numbers of contacts into starts */
        const uint32_t number = i < a->count ? pairs->end_starts[i] : 0;
        pairs->end_starts[i] = ends;
        ends += number;
    }
    JOX_ASSERT(ends == 2 * listed);
    pairs->count = listed;
}

/* Counts the pairs of each colour that agents [begin, end) found. */
static void count_colours(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    uint32_t *sizes = f->contacts->pairs.colour_sizes[begin / JOX_FORCE_GRAIN];
    memset(sizes, 0, sizeof *f->contacts->pairs.colour_sizes);
    for (uint32_t i = begin; i < end; i++) {
        const JoxPairSlot *slots = get_slots(f, i);
        for (uint32_t k = 0; k < f->contacts->found.pair_count[i]; k++)
            if (slots[k].colour != JOX_NO_COLOUR)
                sizes[slots[k].colour]++;
    }
}

/* Turns the counts of pairs, per chunk and colour, into the place of the first one. */
static void find_colour_starts(JoxForces *f) {
    JoxPairs *pairs = &f->contacts->pairs;
    uint32_t sum = 0;
    pairs->colours = 0;
    for (uint32_t colour = 0; colour < JOX_CONTACT_MOST_COLOURS; colour++) {
        pairs->starts[colour] = sum;
        for (uint32_t chunk = 0; chunk < f->chunks; chunk++) {
            const uint32_t size = pairs->colour_sizes[chunk][colour];
            pairs->colour_sizes[chunk][colour] = sum;
            sum += size;
        }
        if (sum > pairs->starts[colour])
            pairs->colours = colour + 1;
    }
    JOX_ASSERT(sum == pairs->count);
    pairs->starts[JOX_CONTACT_MOST_COLOURS] = sum;
}

/* Writes the pairs that agents [begin, end) found into the ranges of their colours, with the kept
   impulses. */
static void place_pairs(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    const JoxKeptImpulses *last = &f->contacts->kept[JOX_KEPT_PAIRS];
    JoxFoundContacts *lists = &f->contacts->found;
    JoxPairs *pairs = &f->contacts->pairs;
    const JoxAgents *a = f->step.agents;
    uint32_t *next = pairs->colour_sizes[begin / JOX_FORCE_GRAIN];
    for (uint32_t i = begin; i < end; i++) {
        const JoxFoundPair *found = get_found_pairs(f, i);
        const JoxPairSlot *slots = get_slots(f, i);
        size_t kept = lists->pair_count[i] ? pairs->orders[i].first_kept : 0;
        for (uint32_t k = 0; k < lists->pair_count[i]; k++) {
            if (slots[k].colour == JOX_NO_COLOUR)
                continue;
            const uint32_t at = next[slots[k].colour]++, j = found[k].other;
            const JoxKeptImpulse *was = jox_find_kept(last, &kept, a->id[i], found[k].other_id);
            JoxPair *pair = &pairs->items[at];
            *pair = (JoxPair){.first = i,
                              .second = j,
                              .again = found[k].again,
                              .impulse = was->impulse,
                              .at = found[k].at};
            pair->at.borne = was->borne;
            pair->at.parted = was->parted;
            pairs->ends[pairs->end_starts[i] + slots[k].first_end] = (JoxPairEnd){at, j};
            pairs->ends[pairs->end_starts[j] + slots[k].second_end] = (JoxPairEnd){at, i};
        }
    }
}

/* Sorts the contacts of an agent with walls by edge, those with one edge from its start on. */
static void sort_by_edge(JoxFoundWall *found, uint32_t count) {
    for (uint32_t k = 1; k < count; k++) {
        const JoxFoundWall moved = found[k];
        uint32_t at = k;
        for (; at > 0 && (found[at - 1].edge > moved.edge ||
                          (found[at - 1].edge == moved.edge && found[at - 1].along > moved.along));
             at--)
            found[at] = found[at - 1];
        found[at] = moved;
    }
}

/* Computes the levers and masses of a contact with a wall. */
static void find_wall_levers(const JoxAgents *a, const JoxFoundWall *found, JoxWallContact *out) {
    const uint32_t i = out->agent;
    const float mass = jox_param(a, JOX_PARAM_mass, i);
    const float gyration = jox_torso_gyration(a, i);
    out->mass = mass;
    if (!(gyration > 0.0f))
        return;
    const float turns = 1.0f / gyration;
    out->lever = turns * jox_det(found->own, found->normal);
    out->slip_lever = turns * (jox_dot(found->own, found->normal) - a->contact_radius[i]);
    out->mass = mass / (1.0f + out->lever * out->lever);
    out->slip_mass = mass / (1.0f + out->slip_lever * out->slip_lever);
}

/* Lists the contacts with walls, in ascending order of agent ids. */
static void lay_out_walls(JoxForces *f) {
    const JoxKeptImpulses *last = &f->contacts->kept[JOX_KEPT_WALLS];
    JoxFoundContacts *lists = &f->contacts->found;
    JoxWallContacts *walls = &f->contacts->walls;
    const JoxAgents *a = f->step.agents;
    const JoxParameterColumn e = a->param[JOX_PARAM_restitution];
    const float dt = (float)f->step.timing.dt;
    size_t kept = 0;
    for (uint32_t r = 0; r < a->count; r++) {
        uint32_t i = a->by_rank[r];
        JoxFoundWall *found = (JoxFoundWall *)lists->walls.items + lists->first_wall[i];
        if (lists->wall_count[i])
            lists->first_wall[i] = walls->groups[walls->group_count++] = walls->count;
        sort_by_edge(found, lists->wall_count[i]);
        for (uint32_t k = 0; k < lists->wall_count[i]; k++) {
            float speed = jox_dot(jox_v2(a->vx[i], a->vy[i]), found[k].normal);
            const JoxKeptImpulse *was = jox_find_kept(last, &kept, a->id[i], found[k].edge);
            JoxWallContact contact = {.agent = i,
                                      .edge = found[k].edge,
                                      .normal = found[k].normal,
                                      .along = found[k].along,
                                      .gap = found[k].gap,
                                      .target =
                                          jox_contact_target(found[k].gap, speed, jox_at(e, i), dt),
                                      .impulse = was->impulse,
                                      .borne = was->borne,
                                      .parted = was->parted};
            find_wall_levers(a, &found[k], &contact);
            walls->items[walls->count++] = contact;
        }
    }
    walls->groups[walls->group_count] = walls->count;
}

/* Makes room for all contacts. */
static void reserve_layout(JoxForces *f, uint32_t pair_count, uint32_t wall_count) {
    JoxPairs *pairs = &f->contacts->pairs;
    JoxWallContacts *walls = &f->contacts->walls;
    JoxContactSolve *solve = &f->contacts->solve;
    const uint32_t agents = f->step.agents->count;
    /* Room for a dense crowd from the start, so that a steady step never allocates. */
    const uint32_t room = pair_count > 4 * agents ? pair_count : 4 * agents;
    pairs->colours_of = jox_stage_memory_take(f->memory, agents, sizeof *pairs->colours_of);
    JOX_RESERVE(pairs->colour_sizes, pairs->colour_size_capacity, f->chunks);
    JOX_RESERVE(pairs->orders, pairs->order_capacity, agents);
    JOX_RESERVE(pairs->end_starts, pairs->end_start_capacity, (size_t)agents + 1);
    jox_chunk_memory_reserve(&f->pair_memory, room * sizeof *pairs->items);
    pairs->items = f->pair_memory.bytes;
    JOX_RESERVE(pairs->ends, pairs->end_capacity, 2 * (size_t)room);
    solve->motions = (JoxContactMotion *)(void *)f->records; /* which are read no more */
    JOX_RESERVE(walls->items, walls->capacity, wall_count);
    JOX_RESERVE(walls->groups, walls->group_capacity, (size_t)wall_count + 1);
}

/* Computes the velocities of a chunk of agents without contacts. */
static void compute_start_velocities(JoxForces *f, uint32_t chunk) {
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

static void lay_out_part(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const Layout *layout = context;
    for (uint32_t part = begin; part < end; part++)
        if (part >= STARTS)
            compute_start_velocities(layout->forces, part - STARTS);
        else if (part == PAIRS && layout->pairs)
            colour_pairs(layout->forces);
        else if (part == WALLS && layout->walls)
            lay_out_walls(layout->forces);
}

void jox_contacts_lay_out(JoxForces *f) {
    JoxFoundContacts *found = &f->contacts->found;
    JoxWallContacts *walls = &f->contacts->walls;
    JoxPairs *pairs = &f->contacts->pairs;
    const uint32_t agents = f->step.agents->count;
    Layout layout = {f, jox_chunks_count(&found->pairs, f->chunks),
                     jox_chunks_count(&found->walls, f->chunks)};
    const bool touched = f->has_bodies && jox_chunks_count(&f->contacts->touches.found, f->chunks);
    reserve_layout(f, layout.pairs, layout.walls);
    walls->count = walls->group_count = 0;
    pairs->count = pairs->colours = 0;
    if (layout.pairs || layout.walls || touched || jox_feet_matter(f))
        jox_parallel_for(f->chunks > 1 ? f->step.pool : NULL,
                         STARTS + (f->options.literal ? 0 : f->chunks), 1, lay_out_part, &layout);
    JOX_ASSERT(walls->count == layout.walls);
    if (layout.pairs) {
        jox_parallel_for(f->step.pool, agents, JOX_FORCE_GRAIN, count_colours, f);
        find_colour_starts(f);
        jox_parallel_for(f->step.pool, agents, JOX_FORCE_GRAIN, place_pairs, f);
        return;
    }
    memset(pairs->end_starts, 0, ((size_t)agents + 1) * sizeof *pairs->end_starts);
}

/* Impulses of the pairs to be kept: those of forces, or of plans. */
typedef struct Keeping {
    JoxForces *forces;
    bool plans;
} Keeping;

/* Keeps the impulses of the pairs that agents [begin, end) found, in ascending order of ids. */
static void keep_pair_impulses(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const Keeping *keeping = context;
    JoxForces *f = keeping->forces;
    JoxKeptImpulse *items = f->contacts->kept[JOX_KEPT_PAIRS].items;
    JoxFoundContacts *lists = &f->contacts->found;
    JoxPairs *pairs = &f->contacts->pairs;
    const uint32_t *id = f->step.agents->id;
    for (uint32_t i = begin; i < end; i++) {
        const JoxFoundPair *found = get_found_pairs(f, i);
        const JoxPairSlot *slots = get_slots(f, i);
        uint32_t n = lists->pair_count[i] ? pairs->orders[i].first_pair : 0;
        for (uint32_t k = 0; k < lists->pair_count[i]; k++) {
            if (slots[k].colour == JOX_NO_COLOUR)
                continue;
            const uint32_t at = pairs->ends[pairs->end_starts[i] + slots[k].first_end].pair;
            const JoxPair *pair = &pairs->items[at];
            if (keeping->plans) {
                items[n].borne = pair->at.borne;
                items[n].parted = pair->impulse - pair->at.borne;
            } else
                items[n] = (JoxKeptImpulse){id[i], found[k].other_id, pair->impulse, 0.0f, 0.0f};
            n++;
        }
    }
}

void jox_contacts_keep_impulses(JoxForces *f) {
    JoxKeptImpulses *of_pairs = &f->contacts->kept[JOX_KEPT_PAIRS];
    JoxKeptImpulses *of_walls = &f->contacts->kept[JOX_KEPT_WALLS];
    JoxWallContacts *walls = &f->contacts->walls;
    JoxPairs *pairs = &f->contacts->pairs;
    const JoxAgents *a = f->step.agents;
    JOX_RESERVE(of_pairs->items, of_pairs->capacity, pairs->count);
    of_pairs->count = pairs->count;
    if (pairs->count)
        jox_parallel_for(f->step.pool, a->count, JOX_FORCE_GRAIN, keep_pair_impulses,
                         &(Keeping){f, false});
    JOX_RESERVE(of_walls->items, of_walls->capacity, walls->count);
    of_walls->count = walls->count;
    for (uint32_t k = 0; k < walls->count; k++)
        of_walls->items[k] = (JoxKeptImpulse){a->id[walls->items[k].agent], walls->items[k].edge,
                                              walls->items[k].impulse, 0.0f, 0.0f};
}

void jox_contacts_keep_plans(JoxForces *f) {
    const JoxWallContacts *walls = &f->contacts->walls;
    JoxKeptImpulse *of_walls = f->contacts->kept[JOX_KEPT_WALLS].items;
    if (f->contacts->pairs.count)
        jox_parallel_for(f->step.pool, f->step.agents->count, JOX_FORCE_GRAIN, keep_pair_impulses,
                         &(Keeping){f, true});
    for (uint32_t k = 0; k < walls->count; k++) {
        of_walls[k].borne = walls->items[k].borne;
        of_walls[k].parted = walls->items[k].impulse - walls->items[k].borne;
    }
}

void jox_pairs_free(JoxPairs *pairs) {
    void *owned[] = {pairs->ends, pairs->end_starts, pairs->orders, pairs->colour_sizes};
    for (size_t i = 0; i < sizeof owned / sizeof *owned; i++)
        jox_free(owned[i]);
}
