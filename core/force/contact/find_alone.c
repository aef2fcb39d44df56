/* Contacts of one agent, in plain C: with agents, where its neighbour list does not cover touch
   range (find_lanes.h at width 1), and with walls. */
#define JOX_ISA_scalar

#include <math.h>

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
    JoxFindPacket packet; /* only the entries in use are initialised */
    packet.f = f;
    packet.first = i;
    packet.lanes = 1;
    packet.walls = walls;
    packet.walled = 0;
    packet.count[0] = 0;
    JoxContactSelf self = jox_load_contact_self(f, i);
    self.least_id = INT32_MIN; /* the loop below compares the ids itself */
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t other = covered ? near->index[jox_neighbour_at(near, i, k)]
                                       : near->touch_index[(size_t)i * JOX_MOST_NEIGHBOURS + k];
        JoxContactCandidates m;
        if (a->id[other] < a->id[i] &&
            (!is_touch_list_full(near, other) || is_in_touch_list(near, other, i)))
            continue;
        if (jox_find_candidates(f, &self, &other, 1, &m))
            jox_add_contacts(&packet, &self, 1, &i, &other, &m);
    }
    JOX_ASSERT(packet.count[0] <= JOX_CONTACT_MOST_FOUND);
    memcpy(out, packet.found[0], packet.count[0] * sizeof *out);
    return packet.count[0];
}

/* Finds the point of an edge nearest to p, a point of the axis of the agent at `centre`, if it
   belongs to this edge: its inner points, and a convex start corner seen from beyond both of its
   edges. The centre tells on which side of the wall the agent is. Returns false otherwise. */
static bool find_edge_contact(const JoxWalls *walls, uint32_t edge, JoxV2 centre, JoxV2 p,
                              JoxFoundWall *out) {
    const JoxWallVertex *a = &walls->vertices[edge], *b = &walls->vertices[a->next];
    const bool outside = jox_det(a->direction, jox_sub(centre, a->point)) < 0.0f;
    const float length = jox_length(jox_sub(b->point, a->point));
    const float along = jox_dot(jox_sub(p, a->point), a->direction);
    if (along > length)
        return false; /* belongs to the next edge, or to none */
    if (along >= 0.0f) {
        if (!outside)
            return false;
        const JoxV2 normal = jox_scale(jox_left(a->direction), -1.0f);
        *out = (JoxFoundWall){.edge = edge,
                              .normal = normal,
                              .gap = jox_dot(jox_sub(p, a->point), normal),
                              .along = along,
                              .own = jox_sub(p, centre)};
        return true;
    }
    const JoxWallVertex *before = &walls->vertices[a->previous];
    const float reached = jox_dot(jox_sub(p, before->point), before->direction);
    if (a->continued || !a->convex || reached < jox_length(jox_sub(a->point, before->point)))
        return false;
    if (!outside && jox_det(before->direction, jox_sub(centre, before->point)) >= 0.0f)
        return false; /* on the inner side of both edges */
    const JoxV2 out_of = jox_sub(p, a->point);
    const float distance = jox_length(out_of);
    const JoxV2 normal = distance > 1e-6f ? jox_scale(out_of, 1.0f / distance)
                                          : jox_scale(jox_left(a->direction), -1.0f);
    *out =
        (JoxFoundWall){.edge = edge, .normal = normal, .gap = distance, .own = jox_sub(p, centre)};
    return true;
}

/* Finds the contact of the start corner of an edge with the axis of a torso between its ends. */
static bool find_corner_contact(const JoxWalls *walls, uint32_t edge, JoxV2 centre, JoxV2 axis,
                                JoxFoundWall *out) {
    const JoxWallVertex *a = &walls->vertices[edge];
    const float along = jox_dot(jox_sub(a->point, centre), axis) / jox_length2(axis);
    if (a->continued || !a->convex || !(fabsf(along) < 1.0f))
        return false;
    const JoxV2 own = jox_scale(axis, along), out_of = jox_sub(jox_add(centre, own), a->point);
    const JoxV2 across = jox_unit(jox_left(axis));
    const float side = jox_dot(jox_sub(centre, a->point), across) < 0.0f ? -1.0f : 1.0f;
    *out = (JoxFoundWall){.edge = edge,
                          .normal = jox_scale(across, side),
                          .gap = side * jox_dot(out_of, across),
                          .own = own};
    return true;
}

/* Adds a contact to the list of the nearest ones, if its gap may close within the step. */
static void list_wall_contact(const JoxForces *f, JoxFoundWall contact, float radius, float most,
                              JoxFoundWall *out, uint32_t *found) {
    const JoxWallLoads *wall_loads = &f->contacts->wall_loads;
    if (wall_loads->images) /* a contact with an image counts for its wall */
        contact.edge = jox_wall_images_origin(wall_loads->images, contact.edge, &contact.along);
    contact.gap -= radius;
    if (contact.gap > most)
        return;
    uint32_t place = *found < JOX_CONTACT_MOST_WALLS ? (*found)++ : *found;
    if (place == JOX_CONTACT_MOST_WALLS) {
        if (contact.gap >= out[place - 1].gap)
            return;
        place--;
    }
    for (; place > 0 && out[place - 1].gap > contact.gap; place--)
        out[place] = out[place - 1];
    out[place] = contact;
}

uint32_t jox_find_wall_contacts(const JoxForces *f, uint32_t i,
                                JoxFoundWall out[JOX_CONTACT_MOST_WALLS]) {
    const JoxAgents *a = f->step.agents;
    const JoxWalls *walls = f->in.walls->walls;
    const JoxV2 at = {a->x[i], a->y[i]}, axis = {a->axis_x[i], a->axis_y[i]};
    const bool is_long = axis.x != 0.0f || axis.y != 0.0f;
    const float outer = a->contact_radius[i] + jox_length(axis), radius = a->contact_radius[i];
    const float tip = is_long ? fabsf(a->spin[i]) * jox_length(axis) : 0.0f;
    const float closing = (jox_length(jox_v2(a->vx[i], a->vy[i])) + tip) * (float)f->step.timing.dt;
    const float most = JOX_TOUCH_LEAST + jox_minf(JOX_TOUCH_MOST, closing);
    uint32_t count, found = 0;
    const JoxNearEdge *near = jox_wall_grid_nearest(f->in.walls, at, &count);
    for (uint32_t k = 0; k < count && near[k].away <= outer + most; k++) {
        JoxFoundWall contact;
        for (int end = is_long ? -1 : 0; end <= 1; end += 2) {
            const JoxV2 p = jox_add(at, jox_scale(axis, (float)end));
            if (find_edge_contact(walls, near[k].edge, at, p, &contact))
                list_wall_contact(f, contact, radius, most, out, &found);
        }
        if (is_long && find_corner_contact(walls, near[k].edge, at, axis, &contact))
            list_wall_contact(f, contact, radius, most, out, &found);
    }
    return found;
}
