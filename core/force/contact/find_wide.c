/* The kernel that finds contacts. A lane is an agent: the nearest neighbours of all lanes of a
   packet are tested, then the second nearest, and so on, until none can touch; a lane is then one
   of those that may touch. Contacts are few, so they are written one at a time; so are contacts
   with walls, and contacts of agents whose neighbour list does not cover touch range
   (find_alone.c). */
#include "force/contact/find_lanes.h"
#include "geom/wall_grid_lanes.h"

/* Agents of a packet and neighbours that they may touch. */
typedef struct Meetings {
    uint32_t count;
    uint32_t agents[(JOX_MOST_NEIGHBOURS + 1) * JOX_WIDTH];
    uint32_t others[(JOX_MOST_NEIGHBOURS + 1) * JOX_WIDTH];
} Meetings;

/* Lists whom the agents of lanes whose neighbour list covers touch range may touch. */
static void list_meetings(const JoxFindPacket *p, uint32_t lanes, Meetings *out) {
    const JoxForces *f = p->f;
    const JoxNeighbours *near = f->step.neighbours;
    const uint32_t i = p->first;
    const JoxContactSelf self = jox_load_contact_self(f, i);
    const JoxInts most = ji_load_bytes(jox_touch_candidate_counts(near, f->widest) + i);
    const uint32_t *others = near->index + jox_neighbour_at(near, i, 0);
    const JoxInts own = ji_add(ji_set((int32_t)i), ji_lane());
    out->count = 0;
    for (uint32_t k = 0; k < near->stride; k++, others += JOX_LANES) {
        lanes &= jm_bits(ji_less(ji_set((int32_t)k), most));
        if (!lanes)
            break;
        JoxContactCandidates m;
        const uint32_t meeting = jox_find_candidates(f, &self, others, lanes, &m);
        if (!meeting)
            continue;
        ji_store_packed(out->agents + out->count, own, meeting);
        ji_store_packed(out->others + out->count, ji_load(others), meeting);
        out->count += jm_count(meeting);
    }
    ji_store(out->agents + out->count, ji_set((int32_t)i)); /* fill the last packet */
    ji_store(out->others + out->count, ji_set((int32_t)i));
}

/* Adds the contacts of lanes whose neighbour list covers touch range: a lane is then any agent of
   the packet with any of its neighbours, so that lanes are full. */
static void add_covered_contacts(JoxFindPacket *p, uint32_t lanes) {
    Meetings meetings;
    list_meetings(p, lanes, &meetings);
    for (uint32_t k = 0; k < meetings.count; k += JOX_WIDTH) {
        const uint32_t *agents = meetings.agents + k, *others = meetings.others + k;
        const JoxContactSelf self = jox_pick_contact_self(p->f, agents);
        JoxContactCandidates m;
        const uint32_t meeting =
            jox_find_candidates(p->f, &self, others, jox_first_lanes(meetings.count - k), &m);
        jox_add_contacts(p, &self, meeting, agents, others, &m);
    }
}

/* Returns the lanes whose neighbour list covers touch range. */
static uint32_t find_covered_lanes(const JoxFindPacket *p) {
    const uint8_t *touch_count = p->f->step.neighbours->touch_count;
    if (p->f->contacts->found.has_full_list)
        return 0;
    if (!touch_count)
        return p->lanes;
    const JoxInts count = ji_load_bytes(touch_count + p->first);
    return p->lanes & jm_bits(ji_equal(count, ji_set(JOX_TOUCH_AMONG_NEIGHBOURS)));
}

/* Writes that no agent of the packet touches anything. */
static void write_no_contacts(const JoxFindPacket *p) {
    JoxFoundContacts *lists = &p->f->contacts->found;
    const uint32_t i = p->first, chunk = i / JOX_FORCE_GRAIN;
    const uint32_t walls = chunk * lists->walls.room + lists->walls.counts[chunk];
    ji_store(lists->first_pair + i, ji_set(0));
    ji_store(lists->first_wall + i, ji_set((int32_t)walls));
    ji_store_bytes(lists->pair_count + i, ji_set(0));
    ji_store_bytes(lists->wall_count + i, ji_set(0));
}

/* Adds contacts of an agent to the list of its chunk; returns the place of the first. */
static uint32_t list_pairs(const JoxForces *f, uint32_t chunk, const JoxFoundPair *pairs,
                           uint32_t count) {
    JoxFoundContacts *lists = &f->contacts->found;
    uint32_t *n = &lists->pairs.counts[chunk];
    if (*n % JOX_FOUND_RUN + count > JOX_FOUND_RUN)
        *n += JOX_FOUND_RUN - *n % JOX_FOUND_RUN;
    JOX_ASSERT(*n + count <= lists->pairs.room);
    const size_t at = jox_chunk_run_place(f->chunks, chunk, *n, JOX_FOUND_RUN);
    JoxPairSlot *slots = (JoxPairSlot *)lists->slots.items + at;
    memcpy((JoxFoundPair *)lists->pairs.items + at, pairs, count * sizeof *pairs);
    for (uint32_t k = 0; k < count; k++)
        slots[k].other = pairs[k].other;
    *n += count;
    return (uint32_t)at;
}

/* Writes the contacts of each lane; finds those of lanes that are not in `covered` first. */
static void write_contacts(JoxFindPacket *p, uint32_t covered) {
    JoxForces *f = p->f;
    JoxFoundContacts *lists = &f->contacts->found;
    const uint32_t chunk = p->first / JOX_FORCE_GRAIN;
    JoxFoundWall *walls = (JoxFoundWall *)lists->walls.items;
    walls += (size_t)chunk * lists->walls.room;
    uint32_t *w = &lists->walls.counts[chunk];
    for (uint32_t lane = 0; p->lanes >> lane; lane++) {
        const uint32_t i = p->first + lane;
        if (!(covered >> lane & 1))
            p->count[lane] = jox_find_contacts_alone(f, i, p->walls >> lane & 1, p->found[lane]);
        lists->pair_count[i] = (uint8_t)p->count[lane];
        lists->first_pair[i] =
            p->count[lane] ? list_pairs(f, chunk, p->found[lane], p->count[lane]) : 0;
        lists->first_wall[i] = chunk * lists->walls.room + *w;
        lists->wall_count[i] =
            p->walled >> lane & 1 ? (uint8_t)jox_find_wall_contacts(f, i, walls + *w) : 0;
        *w += lists->wall_count[i];
    }
}

/* Finds the contacts of one packet of agents. */
static void find_packet(JoxFindPacket *p) {
    const JoxForces *f = p->f;
    const JoxAgents *a = f->step.agents;
    const uint32_t covered = find_covered_lanes(p);
    p->walls = p->walled = 0;
    if (f->in.walls) {
        const JoxFloats touch = jf_set(JOX_TOUCH_LEAST + JOX_TOUCH_MOST);
        const JoxFloats reach = jox_outer_lanes(a, p->first) + touch;
        p->walls = jm_bits(jox_wall_grid_near_lanes(f->in.walls, jf_load(a->x + p->first),
                                                    jf_load(a->y + p->first)));
        p->walled =
            p->walls & ~jm_bits(jox_wall_grid_clear_lanes(f->in.unhidden2, p->first, reach));
    }
    ji_store(p->count, ji_set(0));
    if (covered)
        add_covered_contacts(p, covered);
    const JoxInts none = ji_set(0);
    const uint32_t touching = ~jm_bits(ji_equal(ji_load(p->count), none)) | p->walled | ~covered;
    if (touching & p->lanes)
        write_contacts(p, covered);
    else
        write_no_contacts(p);
}

void JOX_WIDE(jox_find_packets)(JoxForces *f, uint32_t begin, uint32_t end) {
    JoxFindPacket packet;
    packet.f = f;
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        packet.first = i;
        packet.lanes = jox_first_lanes(end - i);
        find_packet(&packet);
    }
}
