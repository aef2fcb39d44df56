/* The contacts found, laid out for the solve in an order that depends on ids alone, each with the
   impulse that it had in the step before. */
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "force/internal.h"

/* Walks the impulses kept from the last step along with contacts that come by ascending ids: 0 for
   one that was not there. */
float jox_kept_impulse(const JoxKeptImpulses *kept, size_t *at, uint32_t id, uint32_t other) {
    const JoxKeptImpulse *items = kept->items;
    while (*at < kept->count &&
           (items[*at].id < id || (items[*at].id == id && items[*at].other < other)))
        ++*at;
    bool found = *at < kept->count && items[*at].id == id && items[*at].other == other;
    return found ? items[*at].impulse : 0.0f;
}

static inline const JoxFoundPair *found_of(const JoxForces *f, uint32_t i) {
    return (const JoxFoundPair *)f->found.items + f->found_first[i];
}

/* Gives each pair the first colour that neither of its agents has yet, in ascending ids, and counts
   the ends of each agent. place[n] is left with the colour of pair n. */
static void colour_pairs(JoxForces *f) {
    const JoxAgents *a = f->step.agents;
    JoxPairs *p = &f->pairs;
    uint32_t n = 0, sizes[JOX_CONTACT_MOST_COLOURS] = {0};
    if (a->count)
        memset(f->colours_of, 0, a->count * sizeof *f->colours_of);
    memset(f->end_starts, 0, ((size_t)a->count + 1) * sizeof *f->end_starts);
    for (uint32_t r = 0; r < a->count; r++) {
        uint32_t i = a->by_rank[r];
        const JoxFoundPair *found = found_of(f, i);
        for (uint32_t k = 0; k < f->found_number[i]; k++) {
            uint32_t j = found[k].other;
            uint64_t open = ~(f->colours_of[i] | f->colours_of[j]);
            if (open == 0) { /* in a heap of hundreds */
                p->place[n++] = JOX_NO_INDEX;
                continue;
            }
            uint32_t colour = (uint32_t)__builtin_ctzll(open);
            f->colours_of[i] |= (uint64_t)1 << colour;
            f->colours_of[j] |= (uint64_t)1 << colour;
            f->end_starts[i]++;
            f->end_starts[j]++;
            sizes[colour]++;
            p->place[n++] = colour;
        }
    }
    JOX_ASSERT(n == p->listed);
    p->colours = 0;
    uint32_t sum = 0;
    for (uint32_t c = 0; c < JOX_CONTACT_MOST_COLOURS; c++) {
        p->starts[c] = sum;
        sum += sizes[c];
        if (sizes[c])
            p->colours = c + 1;
    }
    p->starts[JOX_CONTACT_MOST_COLOURS] = p->count = sum;
    for (uint32_t i = 0, ends = 0; i <= a->count; i++) { /* to where the agent's ends begin */
        uint32_t number = i < a->count ? f->end_starts[i] : 0;
        f->end_starts[i] = ends;
        ends += number;
    }
}

void jox_contacts_lay_pairs(JoxForces *f) {
    const JoxAgents *a = f->step.agents;
    JoxPairs *p = &f->pairs;
    p->count = p->listed = 0;
    for (uint32_t c = 0; c < f->chunks; c++)
        p->listed += f->found.counts[c];
    JOX_RESERVE(f->colours_of, f->colours_of_capacity, a->count);
    JOX_RESERVE(f->end_starts, f->end_start_capacity, (size_t)a->count + 1);
    /* Room for a dense crowd from the start, so that no steady step grows it. */
    uint32_t room = p->listed > 4 * a->count ? p->listed : 4 * a->count;
    JOX_RESERVE(p->items, p->capacity, room);
    JOX_RESERVE(p->place, p->place_capacity, room);
    JOX_RESERVE(f->ends, f->end_capacity, 2 * (size_t)room);
    if (!p->listed) { /* nobody touches anybody */
        p->colours = 0;
        memset(p->starts, 0, sizeof p->starts);
        memset(f->end_starts, 0, ((size_t)a->count + 1) * sizeof *f->end_starts);
        return;
    }
    colour_pairs(f);
    uint32_t fill[JOX_CONTACT_MOST_COLOURS], n = 0;
    memcpy(fill, p->starts, sizeof fill);
    size_t kept = 0;
    for (uint32_t r = 0; r < a->count; r++) {
        uint32_t i = a->by_rank[r];
        const JoxFoundPair *found = found_of(f, i);
        for (uint32_t k = 0; k < f->found_number[i]; k++, n++) {
            if (p->place[n] == JOX_NO_INDEX)
                continue;
            uint32_t at = fill[p->place[n]]++, j = found[k].other;
            p->place[n] = at;
            p->items[at] = (JoxPair){
                i,
                j,
                found[k].normal,
                found[k].target,
                found[k].mass,
                found[k].squeeze,
                jox_kept_impulse(&f->kept_pairs, &kept, a->rank_id[r], found[k].other_id)};
            f->ends[f->end_starts[i]++] = (JoxEnd){at, j};
            f->ends[f->end_starts[j]++] = (JoxEnd){at, i};
        }
    }
    for (uint32_t i = a->count; i-- > 0;) /* back from where the ends end */
        f->end_starts[i + 1] = f->end_starts[i];
    f->end_starts[0] = 0;
}

void jox_contacts_lay_walls(JoxForces *f) {
    const JoxAgents *a = f->step.agents;
    uint32_t count = 0;
    for (uint32_t c = 0; c < f->chunks; c++)
        count += f->found_walls.counts[c];
    f->wall_count = 0;
    f->wall_groups = 0;
    if (!count) {
        f->kept_walls.count = 0;
        return;
    }
    JOX_RESERVE(f->wall, f->wall_capacity, count);
    JOX_RESERVE(f->wall_group, f->wall_group_capacity, (size_t)count + 1);
    const float dt = (float)f->step.dt, *e = a->param[JOX_PARAM_restitution];
    size_t kept = 0;
    for (uint32_t r = 0; r < a->count; r++) {
        uint32_t i = a->by_rank[r];
        JoxFoundWall *found = (JoxFoundWall *)f->found_walls.items + f->wall_first[i];
        if (f->wall_number[i])
            f->wall_first[i] = f->wall_group[f->wall_groups++] = f->wall_count;
        for (uint32_t k = 1; k < f->wall_number[i]; k++) { /* by ascending edge */
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
                .target = jox_contact_target(found[k].gap, speed, e[i], dt),
                .impulse = jox_kept_impulse(&f->kept_walls, &kept, a->id[i], found[k].edge)};
        }
    }
    JOX_ASSERT(f->wall_count == count);
    f->wall_group[f->wall_groups] = count;
}

void jox_contacts_keep(JoxForces *f) {
    const JoxAgents *a = f->step.agents;
    const JoxPairs *p = &f->pairs;
    JOX_RESERVE(f->kept_pairs.items, f->kept_pairs.capacity, p->count);
    f->kept_pairs.count = 0;
    for (uint32_t n = 0; n < p->listed; n++) {
        if (p->place[n] == JOX_NO_INDEX)
            continue;
        const JoxPair *pair = &p->items[p->place[n]];
        f->kept_pairs.items[f->kept_pairs.count++] =
            (JoxKeptImpulse){a->id[pair->first], a->id[pair->second], pair->impulse};
    }
    JOX_ASSERT(f->kept_pairs.count == p->count);
    JOX_RESERVE(f->kept_walls.items, f->kept_walls.capacity, f->wall_count);
    f->kept_walls.count = f->wall_count;
    for (uint32_t k = 0; k < f->wall_count; k++)
        f->kept_walls.items[k] =
            (JoxKeptImpulse){a->id[f->wall[k].agent], f->wall[k].edge, f->wall[k].impulse};
}
