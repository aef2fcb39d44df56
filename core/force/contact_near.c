/* What one agent touches, in plain C. A contact is looked for a little before the discs meet: what
   would meet within the step is kept from moving into each other, so that people at rest neither
   overlap nor lose and find each other from step to step. */
#include <math.h>

#include "base/assert.h"
#include "force/internal.h"

/* Least normal velocity after the contact: the gap may close within the step, no more; what meets
   in the step bounces as restitution has it. */
float jox_contact_target(float gap, float speed, float restitution, float dt) {
    float target = gap > 0.0f ? -gap / dt : 0.0f;
    if (restitution > 0.0f && speed < target)
        target = jox_maxf(target, -restitution * speed);
    return target;
}

/* The contact of agent i and j, over that gap (m); a normal of (0, 0): they stand in one place. */
static JoxFoundPair pair_of(const JoxForces *f, uint32_t i, uint32_t j, JoxV2 normal, float gap,
                            float squeeze) {
    const JoxAgents *a = f->step.agents;
    const JoxParameterColumn mass = a->param[JOX_PARAM_mass];
    const JoxParameterColumn e = a->param[JOX_PARAM_restitution];
    if (normal.x == 0.0f && normal.y == 0.0f)
        normal.x = 1.0f; /* people in one place part along x */
    float speed = (a->vx[i] - a->vx[j]) * normal.x + (a->vy[i] - a->vy[j]) * normal.y;
    JOX_ASSERT(jox_is_unit(normal));
    return (JoxFoundPair){
        .other = j,
        .other_id = a->id[j],
        .normal = normal,
        .squeeze = squeeze,
        .target =
            jox_contact_target(gap, speed, jox_minf(jox_at(e, i), jox_at(e, j)), (float)f->step.dt),
        .mass = jox_at(mass, i) * jox_at(mass, j) / (jox_at(mass, i) + jox_at(mass, j))};
}

static bool lists(const JoxNeighbours *near, uint32_t i, uint32_t other) {
    const uint32_t *index = near->touch_index + (size_t)i * JOX_MOST_NEIGHBOURS;
    for (uint32_t k = 0; k < near->touch_count[i]; k++)
        if (index[k] == other)
            return true;
    return false;
}

/* Whether more may be within touching range of an agent than its list holds. */
static bool is_cut(const JoxNeighbours *near, uint32_t i) {
    return near->touch_count && near->touch_count[i] == JOX_MOST_NEIGHBOURS;
}

/* Two agents, if the gap between them may close within the step. */
static bool touches(JoxForces *f, uint32_t i, uint32_t other, bool walls, JoxFoundPair *out) {
    const JoxAgents *a = f->step.agents;
    JoxV2 offset = jox_offset(a, other, i);
    float distance2 = jox_length2(offset);
    const JoxParameterColumn radius = a->param[JOX_PARAM_radius];
    float sum = a->breadth[i] + a->breadth[other];
    float whole = jox_at(radius, i) + jox_at(radius, other);
    float most = whole + JOX_TOUCH_LEAST + JOX_TOUCH_MOST;
    if (!(distance2 < most * most))
        return false;
    float distance = sqrtf(distance2), gap = distance - sum;
    float squeeze = JOX_SQUEEZE * jox_clampf(whole - distance, 0.0f, whole - sum);
    if (gap > JOX_TOUCH_LEAST && !(squeeze > 0.0f)) {
        JoxV2 towards = {a->vx[other] - a->vx[i], a->vy[other] - a->vy[i]};
        float closing = jox_length(towards) * (float)f->step.dt;
        if (gap > JOX_TOUCH_LEAST + jox_minf(JOX_TOUCH_MOST, closing))
            return false;
    }
    JoxV2 at = {a->x[i], a->y[i]};
    if (walls && jox_wall_grid_separates(f->step.walls, at, jox_sub(at, offset)))
        return false;
    f->chunk[i / JOX_FORCE_GRAIN].overlaps += gap < 0.0f;
    *out = pair_of(f, i, other, jox_unit(offset), gap, squeeze);
    return true;
}

uint32_t jox_contacts_of(JoxForces *f, uint32_t i, bool walls, JoxFoundPair *out) {
    const JoxAgents *a = f->step.agents;
    const JoxNeighbours *near = f->step.neighbours;
    bool seen = !near->touch_count || near->touch_count[i] == JOX_TOUCH_IS_SEEN;
    uint32_t count = seen ? jox_close_counts(near, f->widest)[i] : near->touch_count[i], found = 0;
    for (uint32_t k = 0; k < count; k++) {
        uint32_t other = seen ? near->index[jox_neighbour_at(near, i, k)]
                              : near->touch_index[(size_t)i * JOX_MOST_NEIGHBOURS + k];
        if (a->id[other] < a->id[i] && (!is_cut(near, other) || lists(near, other, i)))
            continue;
        JoxFoundPair pair;
        if (touches(f, i, other, walls, &pair))
            jox_pair_insert(out, found++, &pair);
    }
    JOX_ASSERT(found <= JOX_MOST_NEIGHBOURS);
    return found;
}

/* The nearest point of an edge, if it is this edge's to touch: its inner points, and a convex
   corner seen from beyond both of its edges, which counts for the edge that it starts. */
static bool edge_contact(const JoxWalls *walls, uint32_t edge, JoxV2 p, JoxFoundWall *out) {
    const JoxWallVertex *a = &walls->vertices[edge], *b = &walls->vertices[a->next];
    if (jox_det(a->direction, jox_sub(p, a->point)) >= 0.0f)
        return false; /* on the inner side */
    float length = jox_length(jox_sub(b->point, a->point));
    float along = jox_dot(jox_sub(p, a->point), a->direction);
    if (along > length)
        return false; /* the next edge's start, or nobody's */
    JoxV2 at = jox_add(a->point, jox_scale(a->direction, jox_maxf(along, 0.0f)));
    if (along < 0.0f) {
        const JoxWallVertex *before = &walls->vertices[a->previous];
        JoxV2 from_start = jox_sub(p, before->point);
        float reached = jox_dot(from_start, before->direction);
        if (!a->convex || reached < jox_length(jox_sub(a->point, before->point)))
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

uint32_t jox_contacts_walls_of(const JoxForces *f, uint32_t i,
                               JoxFoundWall out[JOX_CONTACT_MOST_WALLS]) {
    const JoxAgents *a = f->step.agents;
    JoxV2 at = {a->x[i], a->y[i]};
    uint32_t count, found = 0;
    const uint32_t *edges = jox_wall_grid_at(f->step.walls, at, &count);
    float radius = a->breadth[i];
    float closing = jox_length(jox_v2(a->vx[i], a->vy[i])) * (float)f->step.dt;
    float most = JOX_TOUCH_LEAST + jox_minf(JOX_TOUCH_MOST, closing);
    for (uint32_t k = 0; k < count; k++) {
        JoxFoundWall contact;
        if (!edge_contact(f->step.walls->walls, edges[k], at, &contact))
            continue;
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
