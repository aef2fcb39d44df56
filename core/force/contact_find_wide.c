/* The kernel that finds contacts. A lane is an agent: of all lanes of a packet the nearest
   neighbours are looked at, then the second nearest, and so on, until nobody's can touch. What was
   found is written one by one, as it is little; so are contacts with walls, and contacts of those
   whose neighbours may lack somebody who touches (contact_near.c). */
#include "agents/param_lanes.h"
#include "base/assert.h"
#include "force/kernels.h"
#include "geom/wall_grid_lanes.h"
#include "simd/vectors.h"

typedef struct Packet {
    JoxForces *f;
    uint32_t first;  /* agent of lane 0 */
    uint32_t lanes;  /* bits of those that are there, */
    uint32_t walls;  /* of those near walls, */
    uint32_t walled; /* and of those, who may touch some */
    uint32_t count[JOX_WIDTH];
    JoxFoundPair found[JOX_WIDTH][JOX_MOST_NEIGHBOURS];
} Packet;

/* What does not change from neighbour to neighbour. */
typedef struct Self {
    JoxFloats x, y, vx, vy, breadth, radius, mass, restitution;
    JoxInts id;
    JoxV2 period; /* m; 0: none */
} Self;

/* The same for one neighbour of each lane, less what the agent itself has. */
typedef struct Meeting {
    JoxFloats x, y; /* from the neighbour to the agent, m */
    JoxFloats distance2, distance, gap, squeeze;
    JoxVector velocity; /* of the agent relative to the neighbour, m/s */
    JoxFloats mass;     /* of the neighbour, kg */
} Meeting;

/* Of `lanes`, those whose gap to their neighbour may close within the step: see `touches` in
   contact_near.c. */
static uint32_t meet(const JoxForces *f, const Self *self, const uint32_t *others, uint32_t lanes,
                     Meeting *m) {
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
    jf_records_at(&f->builds[0].breadth, others, build);
    lanes &= ~jm_bits(ji_less(jf_bits(build[3]), self->id));
    const JoxFloats sum = self->breadth + build[0], slack = whole - sum;
    m->distance = jf_sqrt(m->distance2);
    m->gap = m->distance - sum;
    JoxFloats into = whole - m->distance;
    into = jf_select(jf_lt(into, zero), zero, jf_select(jf_lt(slack, into), slack, into));
    m->squeeze = JOX_SQUEEZE * into;
    m->velocity = (JoxVector){self->vx - motion[2], self->vy - motion[3]};
    m->mass = build[2];
    JoxFloats closing = jf_sqrt(jv_dot(m->velocity, m->velocity));
    closing *= (float)f->step.dt;
    const JoxFloats reach = least + jf_min(jf_set(JOX_TOUCH_MOST), closing);
    const JoxMask apart = jm_and(jf_lt(least, m->gap), jf_lt(reach, m->gap));
    return lanes & ~jm_bits(jm_without(apart, jf_lt(zero, m->squeeze)));
}

/* Least normal velocities after contacts: see jox_contact_target. */
static JoxFloats targets_of(const JoxForces *f, const Self *self, const uint32_t *others,
                            const Meeting *m, JoxVector normal) {
    const JoxFloats zero = jf_set(0.0f);
    const JoxFloats closes = -m->gap / (float)f->step.dt;
    const JoxFloats target = jf_select(jf_lt(zero, m->gap), closes, zero);
    if (!jm_bits(jf_lt(zero, self->restitution)))
        return target;
    const JoxParameterColumn column = f->step.agents->param[JOX_PARAM_restitution];
    const JoxFloats restitution = jf_min(self->restitution, jox_param_of(column, others));
    const JoxFloats speed = jv_dot(m->velocity, normal);
    const JoxMask bounces = jm_and(jf_lt(zero, restitution), jf_lt(speed, target));
    return jf_select(bounces, jf_max(target, -restitution * speed), target);
}

static void note(Packet *p, const Self *self, uint32_t lanes, const uint32_t *other,
                 const Meeting *m) {
    JoxForces *f = p->f;
    const JoxAgents *a = f->step.agents;
    const JoxFloats zero = jf_set(0.0f), one = jf_set(1.0f), by = one / m->distance;
    const JoxMask together = jf_le(m->distance, zero); /* they part along x */
    const JoxVector normal = {jf_select(together, one, m->x * by),
                              jf_select(together, zero, m->y * by)};
    float x[JOX_WIDTH], y[JOX_WIDTH], nx[JOX_WIDTH], ny[JOX_WIDTH], gap[JOX_WIDTH];
    float squeeze[JOX_WIDTH], target[JOX_WIDTH], mass[JOX_WIDTH];
    jf_store(x, m->x);
    jf_store(y, m->y);
    jv_store(nx, ny, 0, normal);
    jf_store(gap, m->gap);
    jf_store(squeeze, m->squeeze);
    jf_store(target, targets_of(f, self, other, m, normal));
    jf_store(mass, self->mass * m->mass / (self->mass + m->mass));
    for (uint32_t lane = 0; lanes >> lane; lane++) {
        const uint32_t i = p->first + lane;
        if (!(lanes >> lane & 1))
            continue;
        JoxV2 at = {a->x[i], a->y[i]};
        if ((p->walls >> lane & 1) &&
            jox_wall_grid_separates(f->step.walls, at, jox_sub(at, jox_v2(x[lane], y[lane]))))
            continue;
        f->chunk[i / JOX_FORCE_GRAIN].overlaps += gap[lane] < 0.0f;
        const JoxFoundPair pair = {.other = other[lane],
                                   .other_id = a->id[other[lane]],
                                   .normal = {nx[lane], ny[lane]},
                                   .squeeze = squeeze[lane],
                                   .target = target[lane],
                                   .mass = mass[lane]};
        JOX_ASSERT(jox_is_unit(pair.normal));
        jox_pair_insert(p->found[lane], p->count[lane]++, &pair);
    }
}

/* Of some lanes, whose neighbours are all that they may touch. */
static void find_seen(Packet *p, uint32_t lanes) {
    const JoxForces *f = p->f;
    const JoxAgents *a = f->step.agents;
    const JoxNeighbours *near = f->step.neighbours;
    const uint32_t i = p->first;
    const Self self = {jf_load(a->x + i),
                       jf_load(a->y + i),
                       jf_load(a->vx + i),
                       jf_load(a->vy + i),
                       jf_load(a->breadth + i),
                       jox_param_lanes(a, JOX_PARAM_radius, i),
                       jox_param_lanes(a, JOX_PARAM_mass, i),
                       jox_param_lanes(a, JOX_PARAM_restitution, i),
                       ji_load(a->id + i),
                       a->period};
    const JoxInts most = ji_load_bytes(jox_close_counts(near, f->widest) + i);
    const uint32_t *others = near->index + jox_neighbour_at(near, i, 0);
    for (uint32_t k = 0; k < near->stride; k++, others += JOX_LANES) {
        lanes &= jm_bits(ji_less(ji_set((int32_t)k), most));
        if (!lanes)
            break;
        Meeting m;
        const uint32_t meeting = meet(f, &self, others, lanes, &m);
        if (meeting)
            note(p, &self, meeting, others, &m);
    }
}

/* Of the lanes, those whose neighbours are all that they may touch. */
static uint32_t lanes_seen(const Packet *p) {
    const uint8_t *touch_count = p->f->step.neighbours->touch_count;
    if (p->f->cut)
        return 0;
    if (!touch_count)
        return p->lanes;
    const JoxInts count = ji_load_bytes(touch_count + p->first);
    return p->lanes & jm_bits(ji_equal(count, ji_set(JOX_TOUCH_IS_SEEN)));
}

/* Writes that none of a packet's agents touches anything. */
static void write_none(const Packet *p) {
    JoxForces *f = p->f;
    const uint32_t i = p->first, chunk = i / JOX_FORCE_GRAIN;
    const uint32_t found = chunk * f->found.room + f->found.counts[chunk];
    const uint32_t walls = chunk * f->found_walls.room + f->found_walls.counts[chunk];
    ji_store(f->found_first + i, ji_set((int32_t)found));
    ji_store(f->wall_first + i, ji_set((int32_t)walls));
    ji_store_bytes(f->found_number + i, ji_set(0));
    ji_store_bytes(f->wall_number + i, ji_set(0));
}

/* Writes what each touches; looks for the contacts of those of whom not all are seen. */
static void write_each(Packet *p, uint32_t seen) {
    JoxForces *f = p->f;
    const uint32_t chunk = p->first / JOX_FORCE_GRAIN;
    JoxFoundPair *found = (JoxFoundPair *)f->found.items + (size_t)chunk * f->found.room;
    JoxPairSlot *slots = (JoxPairSlot *)f->slots.items + (size_t)chunk * f->slots.room;
    JoxFoundWall *walls = (JoxFoundWall *)f->found_walls.items;
    walls += (size_t)chunk * f->found_walls.room;
    uint32_t *n = &f->found.counts[chunk], *w = &f->found_walls.counts[chunk];
    for (uint32_t lane = 0; p->lanes >> lane; lane++) {
        const uint32_t i = p->first + lane;
        if (!(seen >> lane & 1))
            p->count[lane] = jox_contacts_of(f, i, p->walls >> lane & 1, p->found[lane]);
        JOX_ASSERT(*n + p->count[lane] <= f->found.room);
        f->found_first[i] = chunk * f->found.room + *n;
        f->found_number[i] = (uint8_t)p->count[lane];
        for (uint32_t k = 0; k < p->count[lane]; k++) {
            slots[*n].other = p->found[lane][k].other;
            found[(*n)++] = p->found[lane][k];
        }
        f->wall_first[i] = chunk * f->found_walls.room + *w;
        f->wall_number[i] =
            p->walled >> lane & 1 ? (uint8_t)jox_contacts_walls_of(f, i, walls + *w) : 0;
        *w += f->wall_number[i];
    }
}

static void find_packet(Packet *p) {
    const JoxForces *f = p->f;
    const JoxAgents *a = f->step.agents;
    const uint32_t seen = lanes_seen(p);
    p->walls = p->walled = 0;
    if (f->step.walls) {
        const JoxFloats touch = jf_set(JOX_TOUCH_LEAST + JOX_TOUCH_MOST);
        const JoxFloats reach = jf_load(a->breadth + p->first) + touch;
        p->walls = jm_bits(jox_wall_grid_near_lanes(f->step.walls, jf_load(a->x + p->first),
                                                    jf_load(a->y + p->first)));
        p->walled = p->walls & ~jm_bits(jox_wall_grid_clear_lanes(f->step.clear2, p->first, reach));
    }
    ji_store(p->count, ji_set(0));
    if (seen)
        find_seen(p, seen);
    const JoxInts none = ji_set(0);
    const uint32_t touching = ~jm_bits(ji_equal(ji_load(p->count), none)) | p->walled | ~seen;
    if (touching & p->lanes)
        write_each(p, seen);
    else
        write_none(p);
}

void JOX_WIDE(jox_find_packets)(JoxForces *f, uint32_t begin, uint32_t end) {
    Packet packet;
    packet.f = f;
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        packet.first = i;
        packet.lanes = jox_first_lanes(end - i);
        find_packet(&packet);
    }
}
