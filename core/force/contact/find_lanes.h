/* Contacts between agents: which pairs touch, and what the solve needs of them. A lane is an agent
   with one of its neighbours. find_wide.c includes it for packets, find_alone.c at width
   1. */
#ifndef JOX_FORCE_CONTACT_FIND_LANES_H
#define JOX_FORCE_CONTACT_FIND_LANES_H

#include "agents/fold_lanes.h"
#include "agents/torso_lanes.h"
#include "base/assert.h"
#include "force/contact/contacts.h"
#include "simd/vectors.h"

/* The agents of a packet, and the contacts found so far of each, by ascending id of the other
   agent. */
typedef struct JoxFindPacket {
    JoxForces *f;
    uint32_t first;  /* agent of lane 0 */
    uint32_t lanes;  /* bits of the lanes that have an agent */
    uint32_t walls;  /* bits of the lanes near walls */
    uint32_t walled; /* bits of the lanes that may touch a wall */
    uint32_t count[JOX_WIDTH];
    JoxFoundPair found[JOX_WIDTH][JOX_CONTACT_MOST_FOUND];
} JoxFindPacket;

/* Data of the agents of the lanes that is the same for all of their contacts. */
typedef struct JoxContactSelf {
    JoxFloats x, y, vx, vy, radius, outer, mass, restitution;
    JoxVector axis; /* m */
    JoxFloats inverse_half2;
    JoxInts least_id; /* neighbours of lesser id find the contact themselves */
} JoxContactSelf;

/* Loads the agents of a packet. */
static inline JoxContactSelf jox_load_contact_self(const JoxForces *f, uint32_t first) {
    const JoxAgents *a = f->step.agents;
    const JoxFloats zero = jf_set(0.0f);
    JoxFloats shape[4] = {zero, zero, zero, zero}, build[4];
    jf_fours((const float *)&f->records[first], 4, build);
    if (f->step.neighbours->has_torsos)
        jf_fours((const float *)&f->step.neighbours->shapes[first], 4, shape);
    return (JoxContactSelf){.x = jf_load(a->x + first),
                            .y = jf_load(a->y + first),
                            .vx = jf_load(a->vx + first),
                            .vy = jf_load(a->vy + first),
                            .radius = build[0],
                            .outer = build[1],
                            .mass = build[2],
                            .restitution = jox_param_lanes(a, JOX_PARAM_restitution, first),
                            .axis = {shape[0], shape[1]},
                            .inverse_half2 = shape[3],
                            .least_id = ji_load(a->id + first)};
}

/* Loads any agents; neighbours of lesser id count for them, too. */
static inline JoxContactSelf jox_pick_contact_self(const JoxForces *f, const uint32_t *agents) {
    const JoxNeighbours *near = f->step.neighbours;
    const JoxAgents *a = f->step.agents;
    const JoxFloats zero = jf_set(0.0f);
    JoxFloats motion[4], shape[4] = {zero, zero, zero, zero}, build[4];
    jf_records_at(&near->motions[0].x, agents, motion);
    jf_records_at(&f->records[0].radius, agents, build);
    if (near->has_torsos)
        jf_records_at(&near->shapes[0].axis_x, agents, shape);
    return (JoxContactSelf){.x = motion[0],
                            .y = motion[1],
                            .vx = motion[2],
                            .vy = motion[3],
                            .radius = build[0],
                            .outer = build[1],
                            .mass = build[2],
                            .restitution = jox_param_of(a->param[JOX_PARAM_restitution], agents),
                            .axis = {shape[0], shape[1]},
                            .inverse_half2 = shape[3],
                            .least_id = ji_set(INT32_MIN)};
}

/* Data of one neighbour of each lane. */
typedef struct JoxContactCandidates {
    JoxVector offset;    /* position of the agent relative to the neighbour, m */
    JoxFloats distance2; /* of the centres, m2 */
    JoxVector velocity;  /* velocity of the agent relative to the neighbour, m/s */
    JoxFloats mass;      /* mass of the neighbour, kg */
    JoxFloats radii;     /* sum of the radii, m */
    JoxFloats reach;     /* m: gaps up to this are contacts */
    JoxVector axis;      /* of the neighbour, m */
    JoxFloats inverse_half2;
} JoxContactCandidates;

/* Returns those of `lanes` (bits) whose neighbour is near enough to touch them within the step, if
   shape and direction allow it, and fills *m. A contact is found a little before the surfaces meet:
   agents that would meet within the step are kept from moving into each other, so that agents at
   rest neither overlap nor lose and regain contact from step to step. */
static inline uint32_t jox_find_candidates(const JoxForces *f, const JoxContactSelf *self,
                                           const uint32_t *others, uint32_t lanes,
                                           JoxContactCandidates *m) {
    const JoxNeighbours *near = f->step.neighbours;
    const JoxFloats zero = jf_set(0.0f), least = jf_set(JOX_TOUCH_LEAST);
    JoxFloats motion[4], build[4], shape[4] = {zero, zero, zero, zero};
    jf_records_at(&near->motions[0].x, others, motion);
    m->offset = (JoxVector){self->x - motion[0], self->y - motion[1]};
    if (jox_folds(f->step.agents))
        m->offset = jox_fold_lanes(f->step.agents, m->offset);
    m->distance2 = jv_dot(m->offset, m->offset);
    const JoxFloats most = self->outer + least + (JOX_TOUCH_MOST + f->widest);
    lanes &= jm_bits(jf_lt(m->distance2, most * most));
    if (!lanes)
        return 0;
    jf_records_at(&f->records[0].radius, others, build);
    lanes &= ~jm_bits(ji_less(jf_bits(build[3]), self->least_id));
    if (near->has_torsos)
        jf_records_at(&near->shapes[0].axis_x, others, shape);
    m->axis = (JoxVector){shape[0], shape[1]};
    m->inverse_half2 = shape[3];
    m->radii = self->radius + build[0];
    const JoxFloats whole = self->outer + build[1], distance = jf_sqrt(m->distance2);
    m->velocity = (JoxVector){self->vx - motion[2], self->vy - motion[3]};
    m->mass = build[2];
    JoxFloats closing = jf_sqrt(jv_dot(m->velocity, m->velocity));
    closing *= (float)f->step.timing.dt;
    m->reach = least + jf_min(jf_set(JOX_TOUCH_MOST), closing);
    return lanes & jm_bits(jf_lt(distance, whole + m->reach));
}

/* A point at which two torsos are nearest: how far along the axes of both it is, -1 to 1, and the
   vector from the axis of the neighbour to that of the agent. */
typedef struct JoxNearPoint {
    JoxFloats own, other;
    JoxVector apart;
    JoxFloats distance2;
} JoxNearPoint;

static inline JoxFloats jox_clamp_to_axis(JoxFloats along) {
    return jf_max(jf_set(-1.0f), jf_min(jf_set(1.0f), along));
}

/* Returns the point where one end of the agent's axis (`end`: -1 or 1) is nearest to the axis of
   the neighbour. */
static inline JoxNearPoint jox_own_end(const JoxContactSelf *self, const JoxContactCandidates *m,
                                       float end) {
    const JoxVector at = jv_add(m->offset, jv_scale(self->axis, jf_set(end)));
    const JoxFloats along = jox_clamp_to_axis(jv_dot(at, m->axis) * m->inverse_half2);
    const JoxVector apart = jv_sub(at, jv_scale(m->axis, along));
    return (JoxNearPoint){jf_set(end), along, apart, jv_dot(apart, apart)};
}

/* The same for one end of the neighbour's axis. */
static inline JoxNearPoint jox_other_end(const JoxContactSelf *self, const JoxContactCandidates *m,
                                         float end) {
    const JoxVector at = jv_sub(jv_scale(m->axis, jf_set(end)), m->offset);
    const JoxFloats along = jox_clamp_to_axis(jv_dot(at, self->axis) * self->inverse_half2);
    const JoxVector apart = jv_sub(jv_scale(self->axis, along), at);
    return (JoxNearPoint){along, jf_set(end), apart, jv_dot(apart, apart)};
}

static inline JoxNearPoint jox_select_point(JoxMask m, JoxNearPoint a, JoxNearPoint b) {
    return (JoxNearPoint){jf_select(m, a.own, b.own), jf_select(m, a.other, b.other),
                          jv_select(m, a.apart, b.apart), jf_select(m, a.distance2, b.distance2)};
}

/* Numbers of a point that the solve needs, by lane (JoxContactPoint). */
typedef struct JoxPointLanes {
    JoxVector normal;
    JoxFloats gap, mass, slip_mass, levers[2], slips[2];
} JoxPointLanes;

#define JOX_SECOND_GAP 0.05f   /* m: greatest gap of a second point */
#define JOX_SECOND_COSINE 0.7f /* least cosine between the normals of both points */

/* Finds the points at which the agents of `lanes` (bits) touch their neighbours: the nearest of the
   axes' ends to the other axis, and, where it is that near, the one farthest from it along the
   surface. Fills points[0] with the nearest; *second: lanes with another. Returns the lanes that
   touch. */
static inline uint32_t jox_find_points(const JoxContactSelf *self, const JoxContactCandidates *m,
                                       uint32_t lanes, JoxNearPoint points[2], uint32_t *second) {
    const JoxMask is_long = jf_lt(jf_set(0.0f), self->inverse_half2 + m->inverse_half2);
    const JoxFloats zero = jf_set(0.0f);
    *second = 0;
    points[0] = (JoxNearPoint){zero, zero, m->offset, m->distance2};
    const JoxFloats most = m->radii + m->reach;
    if (!(jm_bits(is_long) & lanes))
        return lanes & jm_bits(jf_le(points[0].distance2, most * most));
    const JoxNearPoint ends[4] = {jox_own_end(self, m, 1.0f), jox_own_end(self, m, -1.0f),
                                  jox_other_end(self, m, 1.0f), jox_other_end(self, m, -1.0f)};
    JoxNearPoint best = ends[0];
    for (int k = 1; k < 4; k++)
        best = jox_select_point(jf_lt(ends[k].distance2, best.distance2), ends[k], best);
    /* Axes that cross are parted along the line of the centres. */
    const JoxVector left = jv_add(m->offset, self->axis), right = jv_sub(m->offset, self->axis);
    const JoxVector up = jv_sub(m->axis, m->offset), down = jv_add(m->axis, m->offset);
    const JoxFloats own = jv_det(m->axis, left) * jv_det(m->axis, right);
    const JoxFloats theirs = jv_det(self->axis, up) * jv_det(self->axis, down);
    const JoxMask crosses = jm_and(jf_lt(own, zero), jf_lt(zero, theirs));
    const JoxNearPoint centre = {zero, zero, jv_scale(m->offset, jf_set(1e-3f)), zero};
    best = jox_select_point(crosses, centre, best);
    best.distance2 = jv_dot(best.apart, best.apart);
    points[0] = jox_select_point(is_long, best, points[0]);
    lanes &= jm_bits(jf_le(points[0].distance2, most * most));
    if (!lanes)
        return 0;
    const JoxFloats length = jf_sqrt(points[0].distance2), by = 1.0f / length;
    const JoxVector tangent = {-points[0].apart.y * by, points[0].apart.x * by};
    const JoxFloats along = jv_dot(tangent, self->axis);
    const JoxFloats near = m->radii + JOX_SECOND_GAP;
    JoxFloats farthest = jf_set(JOX_SECOND_APART);
    points[1] = points[0];
    JoxMask has = jm_of_bits(0);
    for (int k = 0; k < 4; k++) {
        const JoxFloats away = jf_abs((ends[k].own - points[0].own) * along);
        const JoxFloats size = jf_sqrt(ends[k].distance2);
        const JoxFloats facing = jv_dot(ends[k].apart, points[0].apart);
        JoxMask takes = jm_and(jf_lt(farthest, away), jf_lt(size, near));
        takes = jm_and(takes, jf_lt(JOX_SECOND_COSINE * size * length, facing));
        points[1] = jox_select_point(takes, ends[k], points[1]);
        farthest = jf_select(takes, away, farthest);
        has = jm_or(has, takes);
    }
    *second = lanes & jm_bits(jm_without(has, crosses));
    return lanes;
}

/* Returns the inverse radius of gyration of a torso, 1/m; 0 of a disc. */
static inline JoxFloats jox_inverse_gyration(JoxVector axis, JoxFloats radius,
                                             JoxFloats inverse_half2) {
    const JoxFloats side = jf_sqrt(jv_dot(axis, axis)) + radius;
    const JoxFloats gyration = 0.5f * jf_sqrt(side * side + radius * radius);
    return jf_select(jf_lt(jf_set(0.0f), inverse_half2), 1.0f / gyration, jf_set(0.0f));
}

/* Computes what the solve needs of a point. Agents at the same point part along x. */
static inline JoxPointLanes jox_point_lanes(const JoxContactSelf *self,
                                            const JoxContactCandidates *m, const JoxNearPoint *p) {
    const JoxFloats zero = jf_set(0.0f), one = jf_set(1.0f), distance = jf_sqrt(p->distance2);
    const JoxFloats by = one / distance, other_radius = m->radii - self->radius;
    const JoxMask together = jf_le(distance, zero);
    JoxPointLanes out;
    out.normal = (JoxVector){jf_select(together, one, p->apart.x * by),
                             jf_select(together, zero, p->apart.y * by)};
    out.gap = distance - m->radii;
    const JoxVector at = jv_scale(self->axis, p->own), there = jv_scale(m->axis, p->other);
    const JoxFloats turns = jox_inverse_gyration(self->axis, self->radius, self->inverse_half2);
    const JoxFloats other_turns = jox_inverse_gyration(m->axis, other_radius, m->inverse_half2);
    out.levers[0] = turns * jv_det(at, out.normal);
    out.levers[1] = other_turns * jv_det(there, out.normal);
    /* Friction acts midway between the surfaces, on both at one point: else it would turn the two.
     */
    const JoxFloats midway = jf_set(0.5f) * out.gap;
    out.slips[0] = turns * (jv_dot(at, out.normal) - (self->radius + midway));
    out.slips[1] = other_turns * (jv_dot(there, out.normal) + (other_radius + midway));
    const JoxFloats inverse = one / self->mass, other = one / m->mass;
    out.mass = one / (inverse * (one + out.levers[0] * out.levers[0]) +
                      other * (one + out.levers[1] * out.levers[1]));
    /* Axes that cross have no point at which they rub. */
    const JoxMask rubs = jf_lt(zero, jf_abs(p->own) + jf_abs(p->other));
    const JoxMask turn = jm_and(rubs, jf_lt(zero, turns * other_turns));
    out.slip_mass = jf_select(turn,
                              one / (inverse * (one + out.slips[0] * out.slips[0]) +
                                     other * (one + out.slips[1] * out.slips[1])),
                              zero);
    return out;
}

/* jox_contact_target, by lane. */
static inline JoxFloats jox_target_lanes(JoxFloats gap, JoxFloats speed, JoxFloats restitution,
                                         float dt) {
    const JoxFloats zero = jf_set(0.0f), target = jf_select(jf_lt(zero, gap), -gap / dt, zero);
    const JoxMask bounces = jm_and(jf_lt(zero, restitution), jf_lt(speed, target));
    return jf_select(bounces, jf_max(target, -restitution * speed), target);
}

/* Returns the targets (JoxContactPoint) of the contacts with the lanes' neighbours, m/s. */
static inline JoxFloats jox_find_targets(const JoxForces *f, const JoxContactSelf *self,
                                         const uint32_t *others, const JoxContactCandidates *m,
                                         const JoxPointLanes *at) {
    const float dt = (float)f->step.timing.dt;
    const JoxFloats zero = jf_set(0.0f);
    if (!jm_bits(jf_lt(zero, self->restitution)))
        return jox_target_lanes(at->gap, zero, zero, dt);
    const JoxParameterColumn column = f->step.agents->param[JOX_PARAM_restitution];
    const JoxFloats restitution = jf_min(self->restitution, jox_param_of(column, others));
    return jox_target_lanes(at->gap, jv_dot(m->velocity, at->normal), restitution, dt);
}

/* Writes the points of all lanes. */
static inline void jox_write_points(const JoxPointLanes *p, JoxFloats target,
                                    JoxContactPoint out[JOX_WIDTH]) {
    const JoxFloats none = jf_set(0.0f);
    const JoxFloats rows[3][4] = {{p->normal.x, p->normal.y, p->levers[0], p->levers[1]},
                                  {target, p->mass, p->slip_mass, p->gap},
                                  {p->slips[0], p->slips[1], none, none}};
    _Static_assert(sizeof *out == sizeof(float[3][4]), "a point is three rows");
    for (int k = 0; k < 3; k++) {
        float *to[JOX_WIDTH];
        JOX_UNROLL
        for (int lane = 0; lane < JOX_WIDTH; lane++)
            to[lane] = &out[lane].normal.x + 4 * k;
        jf_put_rows(to, rows[k]);
    }
}

/* Returns whether a wall stands between an agent and a neighbour at `offset` from it, m. */
static inline bool jox_is_behind_wall(const JoxForces *f, uint32_t i, float x, float y) {
    const JoxV2 at = {f->step.agents->x[i], f->step.agents->y[i]};
    return jox_wall_grid_has_wall_between(f->in.walls, at, jox_sub(at, jox_v2(x, y)));
}

/* Adds the contacts of the agents of `lanes` (bits) with others, unless a wall stands between. Two
   points are in the order in which they lie along the tangent, so that each is the same from step
   to step. */
static inline void jox_add_contacts(JoxFindPacket *p, const JoxContactSelf *self, uint32_t lanes,
                                    const uint32_t *agents, const uint32_t *other,
                                    const JoxContactCandidates *m) {
    JoxForces *f = p->f;
    const JoxAgents *a = f->step.agents;
    JoxNearPoint near[2];
    uint32_t second;
    lanes = jox_find_points(self, m, lanes, near, &second);
    if (!lanes)
        return;
    JoxContactPoint points[2][JOX_WIDTH];
    float x[JOX_WIDTH], y[JOX_WIDTH], distance2[JOX_WIDTH], own[2][JOX_WIDTH];
    for (int k = 0; k < (second ? 2 : 1); k++) {
        const JoxPointLanes at = jox_point_lanes(self, m, &near[k]);
        jox_write_points(&at, jox_find_targets(f, self, other, m, &at), points[k]);
        jf_store(own[k], jv_det(at.normal, jv_scale(self->axis, near[k].own)));
    }
    jv_store(x, y, 0, m->offset);
    jf_store(distance2, m->distance2);
    for (uint32_t lane = 0; lanes >> lane; lane++) {
        const uint32_t i = agents[lane], own_lane = i - p->first;
        if (!(lanes >> lane & 1))
            continue;
        const bool unhidden = !(p->walls >> own_lane & 1) ||
                              (f->in.unhidden2 && distance2[lane] < f->in.unhidden2[i]);
        if (!unhidden && jox_is_behind_wall(f, i, x[lane], y[lane]))
            continue;
        f->contacts->found.overlaps[i / JOX_FORCE_GRAIN] += points[0][lane].gap < 0.0f;
        JoxFoundPair pair = {
            .other = other[lane], .other_id = a->id[other[lane]], .at = points[0][lane]};
        JOX_ASSERT(jox_is_unit(pair.at.normal));
        const bool both = second >> lane & 1, swapped = both && own[1][lane] < own[0][lane];
        pair.again = swapped;
        pair.at = points[swapped][lane];
        jox_insert_pair(p->found[own_lane], p->count[own_lane]++, &pair);
        if (!both)
            continue;
        pair.again = !swapped;
        pair.at = points[!swapped][lane];
        jox_insert_pair(p->found[own_lane], p->count[own_lane]++, &pair);
    }
}

#endif
