/* Contacts of one agent, in plain C: with agents, where its neighbour list does not cover touch
   range (find_lanes.h at width 1), and with walls. */
#define JOX_ISA_scalar

#include "base/assert.h"
#include "force/contact/find_lanes.h"

static bool is_in_touch_list(const JoxNeighbours *near, uint32_t i, uint32_t other) {
    const uint32_t *index = near->touch_index + (size_t)i * JOX_MOST_NEIGHBOURS;
    for (uint32_t k = 0; k < near->touch_count[i]; k++)
        if (index[k] == other)
            return true;
    return false;
}

/* Returns whether an agent's list of agents within touch range is full, so that it may lack
   some. */
static bool is_touch_list_full(const JoxNeighbours *near, uint32_t i) {
    return near->touch_count && near->touch_count[i] == JOX_MOST_NEIGHBOURS;
}

uint32_t jox_find_contacts_alone(JoxForces *f, uint32_t i, bool walls, JoxFoundPair *out) {
    const JoxAgents *a = f->step.agents;
    const JoxNeighbours *near = f->step.neighbours;
    const bool covered = !near->touch_count || near->touch_count[i] == JOX_TOUCH_AMONG_NEIGHBOURS;
    const uint32_t count =
        covered ? jox_touch_candidate_counts(near, f->widest)[i] : near->touch_count[i];
    JoxFindPacket packet = {.f = f, .first = i, .lanes = 1, .walls = walls};
    JoxContactSelf self = jox_load_contact_self(a, i);
    self.least_id = INT32_MIN; /* the loop below compares the ids itself */
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t other = covered ? near->index[jox_neighbour_at(near, i, k)]
                                       : near->touch_index[(size_t)i * JOX_MOST_NEIGHBOURS + k];
        JoxContactCandidates m;
        if (a->id[other] < a->id[i] &&
            (!is_touch_list_full(near, other) || is_in_touch_list(near, other, i)))
            continue;
        if (jox_find_touching(f, &self, &other, 1, &m))
            jox_add_contacts(&packet, &self, 1, &other, &m);
    }
    JOX_ASSERT(packet.count[0] <= JOX_MOST_NEIGHBOURS);
    memcpy(out, packet.found[0], packet.count[0] * sizeof *out);
    return packet.count[0];
}

/* Finds the point of an edge nearest to p if it belongs to this edge: its inner points, and a
   convex start corner seen from beyond both of its edges. Returns false otherwise. */
static bool find_edge_contact(const JoxWalls *walls, uint32_t edge, JoxV2 p, JoxFoundWall *out) {
    const JoxWallVertex *a = &walls->vertices[edge], *b = &walls->vertices[a->next];
    if (jox_det(a->direction, jox_sub(p, a->point)) >= 0.0f)
        return false; /* on the inner side */
    float length = jox_length(jox_sub(b->point, a->point));
    float along = jox_dot(jox_sub(p, a->point), a->direction);
    if (along > length)
        return false; /* belongs to the next edge, or to none */
    JoxV2 at = jox_add(a->point, jox_scale(a->direction, jox_maxf(along, 0.0f)));
    if (along < 0.0f) {
        const JoxWallVertex *before = &walls->vertices[a->previous];
        JoxV2 from_start = jox_sub(p, before->point);
        float reached = jox_dot(from_start, before->direction);
        if (a->continued || !a->convex || reached < jox_length(jox_sub(a->point, before->point)))
            return false;
    }
    JoxV2 out_of = jox_sub(p, at);
    float distance = jox_length(out_of);
    JoxV2 normal = distance > 1e-6f ? jox_scale(out_of, 1.0f / distance)
                                    : jox_scale(jox_left(a->direction), -1.0f);
    *out = (JoxFoundWall){
        .edge = edge, .normal = normal, .gap = distance, .along = jox_maxf(along, 0.0f)};
    return true;
}

uint32_t jox_find_wall_contacts(const JoxForces *f, uint32_t i,
                                JoxFoundWall out[JOX_CONTACT_MOST_WALLS]) {
    const JoxWallLoads *wall_loads = &f->contacts->wall_loads;
    const JoxAgents *a = f->step.agents;
    JoxV2 at = {a->x[i], a->y[i]};
    uint32_t count, found = 0;
    const JoxNearEdge *near = jox_wall_grid_nearest(f->in.walls, at, &count);
    float radius = a->breadth[i];
    float closing = jox_length(jox_v2(a->vx[i], a->vy[i])) * (float)f->step.timing.dt;
    float most = JOX_TOUCH_LEAST + jox_minf(JOX_TOUCH_MOST, closing);
    for (uint32_t k = 0; k < count && near[k].away <= radius + most; k++) {
        JoxFoundWall contact;
        const uint32_t edge = near[k].edge;
        if (!find_edge_contact(f->in.walls->walls, edge, at, &contact))
            continue;
        if (wall_loads->images) /* a contact with an image counts for its wall */
            contact.edge = jox_wall_images_origin(wall_loads->images, edge, &contact.along);
        contact.gap -= radius;
        if (contact.gap > most)
            continue;
        uint32_t place = found < JOX_CONTACT_MOST_WALLS ? found++ : found;
        if (place == JOX_CONTACT_MOST_WALLS) {
            if (contact.gap >= out[place - 1].gap)
                continue;
            place--;
        }
        for (; place > 0 && out[place - 1].gap > contact.gap; place--)
            out[place] = out[place - 1];
        out[place] = contact;
    }
    return found;
}
