/* Contacts between agents: which pairs touch, and what the solve needs of them. A lane is an agent
   with one of its neighbours. find_wide.c includes it for packets, find_alone.c at width
   1. */
#ifndef JOX_FORCE_CONTACT_FIND_LANES_H
#define JOX_FORCE_CONTACT_FIND_LANES_H

#include "agents/param_lanes.h"
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
    JoxFoundPair found[JOX_WIDTH][JOX_MOST_NEIGHBOURS];
} JoxFindPacket;

/* Data of an agent that is the same for all of its contacts. */
typedef struct JoxContactSelf {
    JoxFloats x, y, vx, vy, breadth, radius, mass, restitution;
    JoxInts least_id; /* neighbours of lesser id find the contact themselves */
    JoxV2 period;     /* m; 0: none */
} JoxContactSelf;

static inline JoxContactSelf jox_load_contact_self(const JoxAgents *a, uint32_t first) {
    return (JoxContactSelf){jf_load(a->x + first),
                            jf_load(a->y + first),
                            jf_load(a->vx + first),
                            jf_load(a->vy + first),
                            jf_load(a->breadth + first),
                            jox_param_lanes(a, JOX_PARAM_radius, first),
                            jox_param_lanes(a, JOX_PARAM_mass, first),
                            jox_param_lanes(a, JOX_PARAM_restitution, first),
                            ji_load(a->id + first),
                            a->period};
}

/* Data of one neighbour of each lane. */
typedef struct JoxContactCandidates {
    JoxFloats x, y; /* position of the agent relative to the neighbour, m */
    JoxFloats distance2, distance, gap, squeeze; /* m2, m, m, N */
    JoxVector velocity; /* velocity of the agent relative to the neighbour, m/s */
    JoxFloats mass;     /* mass of the neighbour, kg */
} JoxContactCandidates;

/* Returns those of `lanes` (bits) whose gap to their neighbour may close within the step, and fills
   *m. A contact is found a little before the discs meet: agents that would meet within the step are
   kept from moving into each other, so that agents at rest neither overlap nor lose and regain
   contact from step to step. */
static inline uint32_t jox_find_touching(const JoxForces *f, const JoxContactSelf *self,
                                         const uint32_t *others, uint32_t lanes,
                                         JoxContactCandidates *m) {
    const float *motions = &f->step.neighbours->motions[0].x;
    const JoxParameterColumn radius = f->step.agents->param[JOX_PARAM_radius];
    const JoxFloats zero = jf_set(0.0f), least = jf_set(JOX_TOUCH_LEAST);
    JoxFloats motion[4], build[4];
    jf_records_at(motions, others, motion);
    m->x = self->x - motion[0];
    m->y = self->y - motion[1];
    if (self->period.x > 0.0f || self->period.y > 0.0f) {
        m->x = jf_wrap(m->x, self->period.x);
        m->y = jf_wrap(m->y, self->period.y);
    }
    m->distance2 = m->x * m->x + m->y * m->y;
    const JoxFloats whole = self->radius + jox_param_of(radius, others);
    const JoxFloats most = whole + least + JOX_TOUCH_MOST;
    lanes &= jm_bits(jf_lt(m->distance2, most * most));
    if (!lanes)
        return 0;
    jf_records_at(&f->records[0].breadth, others, build);
    lanes &= ~jm_bits(ji_less(jf_bits(build[3]), self->least_id));
    const JoxFloats sum = self->breadth + build[0], slack = whole - sum;
    m->distance = jf_sqrt(m->distance2);
    m->gap = m->distance - sum;
    JoxFloats into = whole - m->distance;
    into = jf_select(jf_lt(into, zero), zero, jf_select(jf_lt(slack, into), slack, into));
    m->squeeze = JOX_SQUEEZE * into;
    m->velocity = (JoxVector){self->vx - motion[2], self->vy - motion[3]};
    m->mass = build[2];
    JoxFloats closing = jf_sqrt(jv_dot(m->velocity, m->velocity));
    closing *= (float)f->step.timing.dt;
    const JoxFloats reach = least + jf_min(jf_set(JOX_TOUCH_MOST), closing);
    const JoxMask apart = jm_and(jf_lt(least, m->gap), jf_lt(reach, m->gap));
    return lanes & ~jm_bits(jm_without(apart, jf_lt(zero, m->squeeze)));
}

/* jox_contact_target, by lane. */
static inline JoxFloats jox_target_lanes(JoxFloats gap, JoxFloats speed, JoxFloats restitution,
                                         float dt) {
    const JoxFloats zero = jf_set(0.0f), target = jf_select(jf_lt(zero, gap), -gap / dt, zero);
    const JoxMask bounces = jm_and(jf_lt(zero, restitution), jf_lt(speed, target));
    return jf_select(bounces, jf_max(target, -restitution * speed), target);
}

/* Returns the targets (JoxPair) of the contacts with the lanes' neighbours, m/s. */
static inline JoxFloats jox_find_targets(const JoxForces *f, const JoxContactSelf *self,
                                         const uint32_t *others, const JoxContactCandidates *m,
                                         JoxVector normal) {
    const float dt = (float)f->step.timing.dt;
    const JoxFloats zero = jf_set(0.0f);
    if (!jm_bits(jf_lt(zero, self->restitution)))
        return jox_target_lanes(m->gap, zero, zero, dt);
    const JoxParameterColumn column = f->step.agents->param[JOX_PARAM_restitution];
    const JoxFloats restitution = jf_min(self->restitution, jox_param_of(column, others));
    return jox_target_lanes(m->gap, jv_dot(m->velocity, normal), restitution, dt);
}

/* Adds the contacts of `lanes` (bits) with their neighbours, unless a wall stands between. Agents
   at the same point part along x. */
static inline void jox_add_contacts(JoxFindPacket *p, const JoxContactSelf *self, uint32_t lanes,
                                    const uint32_t *other, const JoxContactCandidates *m) {
    JoxForces *f = p->f;
    const JoxAgents *a = f->step.agents;
    const JoxFloats zero = jf_set(0.0f), one = jf_set(1.0f), by = one / m->distance;
    const JoxMask together = jf_le(m->distance, zero);
    const JoxVector normal = {jf_select(together, one, m->x * by),
                              jf_select(together, zero, m->y * by)};
    float x[JOX_WIDTH], y[JOX_WIDTH], nx[JOX_WIDTH], ny[JOX_WIDTH], gap[JOX_WIDTH];
    float squeeze[JOX_WIDTH], target[JOX_WIDTH], mass[JOX_WIDTH];
    jf_store(x, m->x);
    jf_store(y, m->y);
    jv_store(nx, ny, 0, normal);
    jf_store(gap, m->gap);
    jf_store(squeeze, m->squeeze);
    jf_store(target, jox_find_targets(f, self, other, m, normal));
    jf_store(mass, self->mass * m->mass / (self->mass + m->mass));
    uint32_t may_be_hidden = p->walls;
    if (p->walls && f->in.unhidden2)
        may_be_hidden &= ~jm_bits(jf_lt(m->distance2, jf_load(f->in.unhidden2 + p->first)));
    for (uint32_t lane = 0; lanes >> lane; lane++) {
        const uint32_t i = p->first + lane;
        if (!(lanes >> lane & 1))
            continue;
        JoxV2 at = {a->x[i], a->y[i]};
        if ((may_be_hidden >> lane & 1) &&
            jox_wall_grid_has_wall_between(f->in.walls, at, jox_sub(at, jox_v2(x[lane], y[lane]))))
            continue;
        f->contacts->found.overlaps[i / JOX_FORCE_GRAIN] += gap[lane] < 0.0f;
        const JoxFoundPair pair = {.other = other[lane],
                                   .other_id = a->id[other[lane]],
                                   .normal = {nx[lane], ny[lane]},
                                   .squeeze = squeeze[lane],
                                   .target = target[lane],
                                   .mass = mass[lane]};
        JOX_ASSERT(jox_is_unit(pair.normal));
        jox_insert_pair(p->found[lane], p->count[lane]++, &pair);
    }
}

#endif
