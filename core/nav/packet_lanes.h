/* The half-planes of a packet of agents as solve sees them. They stand in rows, one of each lane in
   a row: first those of walls, of contacts, of neighbours, of bodies, then that of force. A lane
   that has fewer of a kind than another has rows of zeros there, which no velocity violates and
   which the programs pass over; so each lane meets its own half-planes in their order, and gets
   what it would get alone.

   Those of neighbours, by ORCA or of walkers, are made for all lanes at once, those
   of walls, contacts and bodies one lane at a time. For kernels: part of those that include it. */
#ifndef JOX_NAV_PACKET_LANES_H
#define JOX_NAV_PACKET_LANES_H

#include <math.h>
#include <string.h>

#include "agents/param_lanes.h"
#include "geom/wall_grid_lanes.h"
#include "nav/kernels.h"
#include "nav/rest_lanes.h"
#include "nav/walk_lanes.h"

typedef struct JoxPacket {
    const JoxSolve *s;
    uint32_t first; /* agent of lane 0 */
    uint32_t lanes; /* bits of those that plan in this step */
    uint32_t near_walls, touching, pressed,
        walkers;                      /* of them; pressed: who touches or is forced */
    uint32_t contacts, hard, objects; /* rows from which on these stand; hard: neighbours */
    JoxHalfPlaneCounts made[JOX_WIDTH];
    uint32_t counted; /* lanes of which they are not all 0 */
    uint32_t count;   /* rows */
    JoxRow rows[JOX_MOST_CONSTRAINTS];
    JoxHalfPlane list[JOX_MOST_CONSTRAINTS]; /* of one lane */
    JoxRest *unmet, *far; /* who waits: for the least violation, and to be kept within reach */
} JoxPacket;

/* Rows up to `count` are there; new ones are zeros. */
static inline void jox_rows_open(JoxPacket *p, uint32_t count) {
    if (count > p->count) {
        memset(&p->rows[p->count], 0, (count - p->count) * sizeof *p->rows);
        p->count = count;
    }
}

/* ---- half-planes that are made for one lane at a time ---- */

typedef uint32_t JoxMaker(const JoxSolve *solve, uint32_t agent, JoxHalfPlane *out);

/* Puts what a maker says of some lanes (bits) into rows from `row` on; `at`: place of their number
   in JoxHalfPlaneCounts. */
static inline void jox_put_each(JoxPacket *p, uint32_t lanes, uint32_t row, JoxMaker *make,
                                size_t at) {
    p->counted |= lanes;
    for (uint32_t lane = 0; lanes >> lane; lane++) {
        if (!(lanes >> lane & 1))
            continue;
        uint32_t count = make(p->s, p->first + lane, p->list);
        memcpy((char *)&p->made[lane] + at, &count, sizeof count);
        jox_rows_open(p, row + count);
        for (uint32_t k = 0; k < count; k++) {
            p->rows[row + k].x[lane] = p->list[k].normal.x;
            p->rows[row + k].y[lane] = p->list[k].normal.y;
            p->rows[row + k].offset[lane] = p->list[k].offset;
        }
    }
}
#define JOX_PUT_EACH(packet, lanes, row, make, kind)                                               \
    jox_put_each(packet, lanes, row, make, offsetof(JoxHalfPlaneCounts, kind))

/* ---- half-planes by ORCA, as of orca.c, to the bit ---- */

/* Two who may meet: where the other is from the agent, m, the agent's velocity less the other's,
   m/s, and the sum of their radii, m. */
typedef struct JoxPair {
    JoxFloats x, y, vx, vy, radii;
} JoxPair;

/* What ORCA's half-planes of one agent have in common: its velocity, m/s, the inverse of its
   horizon, 1/s, and its share of the correction. */
typedef struct JoxOrcaSelf {
    JoxVector velocity;
    JoxFloats inverse, share;
} JoxOrcaSelf;

/* Half of the work for a neighbour: the velocity obstacle is bounded by a disc and by two legs;
   what both cases need, one root and one quotient, is computed once, of what the case of the lane
   takes. Roots and quotients take long: those of all neighbours are begun before one of them is
   used. */
typedef struct JoxOrcaHalf {
    JoxVector w;  /* relative velocity less that which makes them meet at the horizon, m/s */
    JoxMask disc; /* else a leg */
    JoxFloats length, by, round; /* of w or of a leg; 1 / that, or 1 / distance^2; of the disc */
} JoxOrcaHalf;

/* Of the lanes, only those of `wanted` (bits) are of any meaning. Adds those of which the two
   coincide to `coincide`. */
static inline __attribute__((always_inline)) JoxOrcaHalf jox_orca_begin(const JoxPair *q,
                                                                        const JoxOrcaSelf *self,
                                                                        float dt, uint32_t wanted,
                                                                        uint32_t *coincide) {
    const JoxFloats one = jf_set(1.0f), zero = jf_set(0.0f);
    const JoxFloats d2 = q->x * q->x + q->y * q->y;
    const JoxFloats r2 = q->radii * q->radii;
    const JoxMask overlap = jf_le(d2, r2);
    JoxFloats inverse = self->inverse, round = q->radii * inverse;
    if (jm_bits(overlap) & wanted) { /* they are to part within dt */
        inverse = jf_select(overlap, jf_set(1.0f / dt), inverse);
        round = jf_select(overlap, q->radii / dt, round);
        *coincide |= jm_bits(jf_le(d2, zero)) & wanted;
    }
    const JoxVector w = {q->vx - q->x * inverse, q->vy - q->y * inverse};
    const JoxFloats w2 = jv_dot(w, w), along = w.x * q->x + w.y * q->y;
    const JoxMask before = jm_and(jf_lt(along, zero), jf_lt(r2 * w2, along * along));
    const JoxMask disc = jm_or(overlap, before);
    const JoxFloats length = jf_sqrt(jf_select(disc, w2, d2 - r2));
    const JoxFloats by = one / jf_select(disc, length, d2);
    return (JoxOrcaHalf){w, disc, length, by, round};
}

/* The half-plane for a neighbour: see jox_orca_half_plane. Its normal is out along w, or that of
   the nearer leg, whose direction is (ny, -nx); (1, 0) where the centres coincide and move alike.
 */
static inline __attribute__((always_inline)) JoxPlaneLanes
jox_orca_end(const JoxPair *q, const JoxOrcaSelf *self, const JoxOrcaHalf *h) {
    const JoxFloats one = jf_set(1.0f), zero = jf_set(0.0f);
    const JoxMask left = jf_lt(zero, q->x * h->w.y - q->y * h->w.x);
    const JoxFloats side = jf_select(left, h->length, -h->length);
    const JoxFloats leg_x = q->x * side - q->y * q->radii;
    const JoxFloats leg_y = q->x * q->radii + q->y * side;
    const JoxMask rests = jm_without(h->disc, jf_lt(jf_set(1e-6f), h->length));
    const JoxFloats x = jf_select(h->disc, h->w.x, -leg_y);
    const JoxFloats y = jf_select(h->disc, h->w.y, leg_x);
    const JoxFloats nx = jf_select(rests, one, x * h->by);
    const JoxFloats ny = jf_select(rests, zero, y * h->by);
    const JoxFloats into = nx * q->vx + ny * q->vy;
    const JoxFloats change = jf_select(h->disc, h->round - h->length, -into);
    const JoxFloats own = nx * self->velocity.x + ny * self->velocity.y;
    return (JoxPlaneLanes){nx, ny, own + change * self->share};
}

/* ---- half-planes of neighbours ---- */

/* What does not change from neighbour to neighbour. */
typedef struct JoxSelf {
    JoxFloats x, y, radius;
    JoxFloats room; /* that a walker leaves to whom it follows, a share of the law's */
    JoxOrcaSelf orca;
} JoxSelf;

/* Whom agents touch: a row has one of each lane, or itself. */
typedef struct JoxTouched {
    uint32_t rows;
    uint32_t other[JOX_MOST_TOUCHED][JOX_WIDTH];
} JoxTouched;

static inline void jox_note_touched(const JoxPacket *p, JoxTouched *t) {
    const JoxContactPlanes *planes = p->s->touched;
    t->rows = 0;
    for (uint32_t lane = 0; p->touching >> lane; lane++) {
        const uint32_t i = p->first + lane;
        for (uint32_t k = 0; (p->touching >> lane & 1) && k < planes->people[i]; k++) {
            for (; t->rows <= k; t->rows++)
                memset(t->other[t->rows], 0xff, sizeof t->other[0]);
            t->other[k][lane] = planes->planes[planes->starts[i] + k].other;
        }
    }
}

/* The lanes from which a wall may hide their neighbour: is_hidden of half_planes.c asks. */
static inline uint32_t jox_may_be_hidden(const JoxSolve *s, uint32_t first, const JoxPair *q) {
    const JoxFloats d2 = q->x * q->x + q->y * q->y;
    const JoxFloats near = q->radii + JOX_TOUCH_LEAST + JOX_TOUCH_MOST;
    const JoxMask far = jf_lt(near * near, d2);
    return ~jm_bits(s->clear2 ? jm_or(far, jf_lt(d2, jf_load(s->clear2 + first))) : far);
}

/* Of `lanes`, those that mind their neighbour, whose indices are given; `picky`: of whom that is
   asked one by one. */
static inline uint32_t jox_minding(const JoxPacket *p, const JoxTouched *t, uint32_t lanes,
                                   uint32_t picky, const uint32_t *index) {
    JoxMask touched = jm_of_bits(0);
    for (uint32_t k = 0; k < t->rows; k++)
        touched = jm_or(touched, ji_equal(ji_load(index), ji_load(t->other[k])));
    lanes &= ~jm_bits(touched);
    picky &= lanes;
    for (uint32_t lane = 0; picky >> lane; lane++)
        if ((picky >> lane & 1) && jox_solve_passes_over(p->s, p->first + lane, index[lane]))
            lanes &= ~(1u << lane);
    return lanes;
}

static inline JoxSelf jox_self_of(const JoxPacket *p) {
    const JoxAgents *a = p->s->agents;
    const uint32_t i = p->first;
    JoxFloats room = jf_set(1.0f);
    if (p->walkers)
        room -= (float)p->s->nav->walk->room_eager * jf_load(a->eager + i);
    return (JoxSelf){
        .x = jf_load(a->x + i),
        .y = jf_load(a->y + i),
        .radius = jox_param_lanes(a, JOX_PARAM_radius, i),
        .room = room,
        .orca = {.velocity = jv_load(a->vx, a->vy, i),
                 .inverse = 1.0f / jox_param_lanes(a, JOX_PARAM_horizon, i),
                 .share =
                     p->s->nav->literal ? jf_set(0.5f) : jox_param_lanes(a, JOX_PARAM_yield, i)},
    };
}

/* How far a walker and its neighbour are apart, and what their widths are, m: that of one who
   follows, and that of one who crosses. */
typedef struct JoxWalkerGap {
    JoxFloats distance, follows, crosses;
} JoxWalkerGap;

static inline JoxWalkerGap jox_walker_gap(const JoxWalkLaw *law, const JoxSelf *self,
                                          const JoxPair *q) {
    const JoxVector offset = {q->x, q->y};
    return (JoxWalkerGap){
        jf_sqrt(jv_dot(offset, offset)),
        q->radii * (float)law->width * self->room,
        q->radii * (float)law->width_cross,
    };
}

/* Those for whom a walker is too far away to have a half-plane, however they mind each other. */
static inline JoxMask jox_walker_is_far(const JoxWalkLaw *law, const JoxWalkerGap *g) {
    return jf_le(jf_set((float)law->close), g->distance - jf_max(g->crosses, g->follows));
}

/* The half-planes of walkers in place of ORCA's, of those who mind their neighbours, and who they
   are; their offset is q->x, q->y: see walker_half_plane in half_planes.c. */
static inline JoxPlaneLanes jox_walker_lanes(const JoxPacket *p, const JoxPair *q,
                                             const JoxWalkerGap *g, JoxInts others,
                                             JoxVector velocity, JoxMask *there) {
    const JoxAgents *a = p->s->agents;
    const JoxWalkLaw *law = p->s->nav->walk;
    const JoxFloats one = jf_set(1.0f), zero = jf_set(0.0f);
    const JoxVector offset = {q->x, q->y};
    const JoxMindsLanes minds = jox_minds_lanes(p->s->nav, a, p->first, others, offset);
    const JoxFloats gap = g->distance - jf_select(minds.crossing, g->crosses, g->follows);
    const JoxFloats by = one / g->distance;
    const JoxVector towards = {q->x * by, q->y * by};
    const JoxFloats leaves = jv_dot(towards, velocity);
    const JoxFloats share = jf_select(minds.crossing, jf_set(0.5f), one);
    const JoxFloats closes = share * jf_max(gap, zero) / (float)law->close_time;
    *there = jm_without(jm_or(minds.ahead, minds.crossing), jf_le(jf_set((float)law->close), gap));
    return (JoxPlaneLanes){-towards.x, -towards.y, -(jf_max(zero, leaves) + closes)};
}

static inline JoxPlaneLanes jox_select_plane(JoxMask m, JoxPlaneLanes a, JoxPlaneLanes b) {
    return (JoxPlaneLanes){jf_select(m, a.x, b.x), jf_select(m, a.y, b.y),
                           jf_select(m, a.offset, b.offset)};
}

/* How many neighbours the lanes have that plan: all of them at least, and any of them at most. */
typedef struct JoxNeighbourCounts {
    JoxInts each;
    uint32_t least, most;
} JoxNeighbourCounts;

static inline JoxNeighbourCounts jox_count_neighbours(const JoxPacket *p) {
    const uint8_t *count = p->s->neighbours->count + p->first;
    JoxNeighbourCounts n = {ji_select(jm_of_bits(p->lanes), ji_load_bytes(count), ji_set(0)),
                            JOX_MOST_NEIGHBOURS, 0};
    for (uint32_t lane = 0; lane < JOX_WIDTH; lane++) {
        const uint32_t has = p->lanes >> lane & 1 ? count[lane] : 0;
        n.least = has < n.least ? has : n.least;
        n.most = has > n.most ? has : n.most;
    }
    return n;
}

/* The lanes that have more than k. */
static inline uint32_t jox_have_more(const JoxNeighbourCounts *n, uint32_t k) {
    return k < n->least ? JOX_ALL_LANES : jm_bits(ji_less(ji_set((int32_t)k), n->each));
}

/* A neighbour of each lane: the pair, its velocity, m/s, and half of ORCA's work for it. */
typedef struct JoxNeighbour {
    JoxPair pair;
    JoxVector velocity;
    JoxOrcaHalf half;
} JoxNeighbour;

/* The pairs with the `most` first neighbours of the lanes. A lane that has fewer gets somebody. */
static inline __attribute__((always_inline)) void
jox_fetch_pairs(const JoxPacket *p, const JoxSelf *self, uint32_t most, const uint32_t walkers,
                const bool periodic, JoxNeighbour out[JOX_MOST_NEIGHBOURS]) {
    const JoxNeighbours *near = p->s->neighbours;
    const JoxAgents *a = p->s->agents;
    const float *motions = &near->motions[0].x;
    const JoxParameterColumn radius = a->param[JOX_PARAM_radius];
    const uint32_t *others = near->index + jox_neighbour_at(near, p->first, 0);
    for (uint32_t k = 0; k < most; k++, others += JOX_LANES) {
        JoxFloats motion[4];
        jf_records_at(motions, others, motion);
        const JoxFloats other = jox_param_of(radius, others);
        JoxPair q = {motion[0] - self->x, motion[1] - self->y, self->orca.velocity.x - motion[2],
                     self->orca.velocity.y - motion[3], self->radius + other};
        if (periodic) {
            q.x = jf_wrap(q.x, a->period.x);
            q.y = jf_wrap(q.y, a->period.y);
        }
        out[k].pair = q;
        if (walkers)
            out[k].velocity = (JoxVector){motion[2], motion[3]};
    }
}

/* The half-planes of `lanes` for a neighbour of each: zeros for those who have none. `walkers`: of
   them; `all`: those of the packet. */
static inline __attribute__((always_inline)) void
jox_plane_lanes(const JoxPacket *p, const JoxSelf *self, uint32_t lanes, uint32_t all,
                const uint32_t walkers, const JoxNeighbour *near, const JoxWalkerGap *gap,
                const uint32_t *others, JoxPlaneLanes *plane) {
    const JoxPlaneLanes none = {jf_set(0.0f), jf_set(0.0f), jf_set(0.0f)};
    const JoxPair *q = &near->pair;
    JoxMask minds = jm_of_bits(lanes);
    *plane = none;
    if (all & ~walkers)
        *plane = jox_orca_end(q, &self->orca, &near->half);
    if (walkers) {
        JoxMask has;
        const JoxMask walk = jm_of_bits(walkers);
        *plane = jox_select_plane(
            walk, jox_walker_lanes(p, q, gap, ji_load(others), near->velocity, &has), *plane);
        minds = jm_without(minds, jm_without(walk, has));
    }
    if (walkers || lanes != JOX_ALL_LANES)
        *plane = jox_select_plane(minds, *plane, none);
}

static inline void jox_store_plane(JoxRow *row, const JoxPlaneLanes *plane) {
    jf_store(row->x, plane->x);
    jf_store(row->y, plane->y);
    jf_store(row->offset, plane->offset);
}

/* The rows of neighbours that all lanes have and mind, none of which walks by the law. */
static inline void jox_put_whole_rows(JoxPacket *p, const JoxSelf *self,
                                      const JoxNeighbour *nearest, uint32_t count) {
    for (uint32_t k = 0; k < count; k++) {
        const JoxPlaneLanes plane = jox_orca_end(&nearest[k].pair, &self->orca, &nearest[k].half);
        jox_store_plane(&p->rows[p->count + k], &plane);
    }
    p->count += count;
}

/* The rows of the neighbours, less those in which no lane has one that it minds. `walkers`: the
   lanes that walk by the law. Returns the lanes that may coincide with a neighbour, of which the
   half-plane depends on who they are. */
static inline __attribute__((always_inline)) uint32_t
jox_put_rows(JoxPacket *p, const uint32_t walkers, const bool periodic) {
    const JoxSolve *s = p->s;
    const JoxNeighbours *near = s->neighbours;
    const JoxSelf self = jox_self_of(p);
    const uint32_t all = p->lanes;
    const JoxNeighbourCounts counts = jox_count_neighbours(p);
    const uint32_t picky = jox_picky_lanes(p->s->agents, p->first) & p->lanes,
                   walled = s->touched ? p->near_walls : 0;
    uint32_t coincide = 0;
    JoxTouched touched;
    jox_note_touched(p, &touched);
    const uint32_t choosy = picky | walled | (touched.rows ? p->touching : 0);
    JoxNeighbour nearest[JOX_MOST_NEIGHBOURS];
    jox_fetch_pairs(p, &self, counts.most, walkers, periodic, nearest);
    for (uint32_t k = 0; (all & ~walkers) && k < counts.most; k++)
        nearest[k].half = jox_orca_begin(&nearest[k].pair, &self.orca, s->planning_time,
                                         jox_have_more(&counts, k), &coincide);
    if (!walkers && !choosy && counts.least == counts.most) {
        jox_put_whole_rows(p, &self, nearest, counts.most);
        return coincide;
    }
    const uint32_t *others = near->index + jox_neighbour_at(near, p->first, 0);
    JoxRow *row = &p->rows[p->count];
    for (uint32_t k = 0; k < counts.most; k++, others += JOX_LANES) {
        uint32_t lanes = jox_have_more(&counts, k);
        JoxWalkerGap gap;
        if (walkers) {
            gap = jox_walker_gap(s->nav->walk, &self, &nearest[k].pair);
            coincide |= walkers & lanes & jm_bits(jf_le(gap.distance, jf_set(0.0f)));
            lanes &= ~(walkers & jm_bits(jox_walker_is_far(s->nav->walk, &gap)));
        }
        if (lanes & choosy)
            lanes = jox_minding(p, &touched, lanes,
                                picky | (walled & jox_may_be_hidden(s, p->first, &nearest[k].pair)),
                                others);
        if (!lanes)
            continue;
        JoxPlaneLanes plane;
        jox_plane_lanes(p, &self, lanes, all, walkers, &nearest[k], &gap, others, &plane);
        jox_store_plane(row++, &plane);
    }
    p->count = (uint32_t)(row - p->rows);
    return coincide;
}

/* Of agents who see over no periodic edge, and of those who do. Where nobody walks by the law, the
   former is compiled for that. */
static inline uint32_t jox_put_rows_bounded(JoxPacket *p) {
    return p->walkers ? jox_put_rows(p, p->walkers, false) : jox_put_rows(p, 0, false);
}

static inline uint32_t jox_put_rows_periodic(JoxPacket *p) {
    return jox_put_rows(p, p->walkers, true);
}

/* Whether the neighbours of a packet's agents may stand beyond a periodic edge. */
static inline bool jox_sees_over_edges(const JoxPacket *p) {
    const JoxAgents *a = p->s->agents;
    const JoxFloats margin = jf_set(1e-3f); /* m: more than positions are rounded by */
    const JoxFloats reach = jf_load(a->search + p->first) + margin;
    JoxMask over = jm_of_bits(0);
    for (int axis = 0; axis < 2; axis++) {
        const float origin = axis ? a->origin.y : a->origin.x;
        const float period = axis ? a->period.y : a->period.x;
        const JoxFloats at = jf_load((axis ? a->y : a->x) + p->first);
        if (period > 0.0f)
            over = jm_or(over, jm_or(jf_lt(at - reach, jf_set(origin)),
                                     jf_lt(jf_set(origin + period), at + reach)));
    }
    return jm_bits(over) & p->lanes;
}

static inline void jox_put_neighbours(JoxPacket *p) {
    const uint32_t alone =
        (jox_sees_over_edges(p) ? jox_put_rows_periodic : jox_put_rows_bounded)(p);
    for (uint32_t lane = 0; alone >> lane; lane++)
        for (uint32_t row = p->hard; (alone >> lane & 1) && row < p->count; row++)
            p->rows[row].x[lane] = p->rows[row].y[lane] = p->rows[row].offset[lane] = 0.0f;
    if (alone)
        JOX_PUT_EACH(p, alone, p->hard, jox_solve_neighbours, agents);
}

static inline void jox_put_force(JoxPacket *p) {
    const JoxAgents *a = p->s->agents;
    const JoxFloats zero = jf_set(0.0f);
    JoxFloats x = jf_load(a->half_plane_x + p->first), y = jf_load(a->half_plane_y + p->first);
    JoxMask there = jm_and(jf_lt(zero, jf_max(jf_abs(x), jf_abs(y))), jm_of_bits(p->lanes));
    const uint32_t row = p->count, forced = jm_bits(there);
    p->pressed = p->touching | forced;
    if (!forced)
        return;
    jox_rows_open(p, row + 1);
    jf_store(p->rows[row].x, jf_select(there, x, zero));
    jf_store(p->rows[row].y, jf_select(there, y, zero));
    jf_store(p->rows[row].offset, jf_select(there, jf_load(a->half_plane_offset + p->first), zero));
    p->counted |= forced;
    for (uint32_t lane = 0; forced >> lane; lane++)
        p->made[lane].force = forced >> lane & 1;
}

static inline void jox_put_half_planes(JoxPacket *p) {
    p->count = 0;
    for (uint32_t lane = 0; p->counted >> lane; lane++)
        if (p->counted >> lane & 1)
            p->made[lane] = (JoxHalfPlaneCounts){0};
    p->counted = 0;
    if (p->near_walls)
        JOX_PUT_EACH(p, p->near_walls, 0, jox_solve_walls, walls);
    p->contacts = p->count;
    if (p->touching)
        JOX_PUT_EACH(p, p->touching, p->contacts, jox_solve_contacts, contacts);
    p->hard = p->count;
    jox_put_neighbours(p);
    p->objects = p->count;
    if (p->s->objects && p->s->objects->count)
        JOX_PUT_EACH(p, p->lanes, p->objects, jox_solve_objects, objects);
    jox_put_force(p);
}

#endif
