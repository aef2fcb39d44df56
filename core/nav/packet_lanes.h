/* The half-planes of a packet of agents as solve sees them. They stand in rows, one of each lane in
   a row: first those of walls, of contacts, of neighbours, of bodies, then that of force. A lane
   that has fewer of a kind than another has rows of zeros there, which no velocity violates and
   which the programs pass over; so each lane meets its own half-planes in their order, and gets
   what it would get alone.

   Those of neighbours, by ORCA (orca_lanes.h) or of walkers, are made for all lanes at once, those
   of walls, contacts and bodies one lane at a time. For kernels: part of those that include it. */
#ifndef JOX_NAV_PACKET_LANES_H
#define JOX_NAV_PACKET_LANES_H

#include <math.h>
#include <string.h>

#include "geom/wall_grid_lanes.h"
#include "nav/kernels.h"
#include "nav/orca_lanes.h"
#include "nav/rest_lanes.h"
#include "nav/walk_lanes.h"

typedef struct JoxPacket {
    const JoxSolve *s;
    uint32_t first; /* agent of lane 0 */
    uint32_t lanes; /* bits of those that plan in this step */
    uint32_t near_walls, touching, pressed,
        walkers;                      /* of them; pressed: who touches or is forced */
    uint32_t contacts, hard, objects; /* rows from which on these stand; hard: neighbours */
    JoxHalfPlaneCounts made[JOX_LANES];
    uint32_t count; /* rows */
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

/* ---- half-planes of neighbours ---- */

/* What does not change from neighbour to neighbour. */
typedef struct JoxSelf {
    JoxFloats x, y, radius;
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
    for (uint32_t lane = 0; planes && p->lanes >> lane; lane++) {
        const uint32_t i = p->first + lane;
        for (uint32_t k = 0; (p->lanes >> lane & 1) && k < planes->people[i]; k++) {
            for (; t->rows <= k; t->rows++)
                memset(t->other[t->rows], 0xff, sizeof t->other[0]);
            t->other[k][lane] = planes->planes[planes->starts[i] + k].other;
        }
    }
}

/* Of some lanes, those that ignore somebody, mean to touch somebody or stand near walls: who of
   their neighbours has no half-plane is asked one by one. */
static inline uint32_t jox_picky_lanes(const JoxPacket *p) {
    const JoxAgents *a = p->s->agents;
    uint32_t picky = p->s->touched ? p->near_walls : 0;
    for (uint32_t lane = 0; p->lanes >> lane; lane++) {
        const uint32_t i = p->first + lane;
        picky |= (uint32_t)(a->ignore[i] || jox_is_close_to_some(a, i)) << lane;
    }
    return picky & p->lanes;
}

/* Of `lanes`, those that mind their neighbour, whose indices are given. */
static inline uint32_t jox_minding(const JoxPacket *p, const JoxTouched *t, uint32_t lanes,
                                   uint32_t picky, JoxInts others) {
    uint32_t index[JOX_WIDTH];
    JoxMask touched = jm_of_bits(0);
    for (uint32_t k = 0; k < t->rows; k++)
        touched = jm_or(touched, ji_equal(others, ji_load(t->other[k])));
    lanes &= ~jm_bits(touched);
    picky &= lanes;
    ji_store(index, others);
    for (uint32_t lane = 0; picky >> lane; lane++)
        if ((picky >> lane & 1) && jox_solve_passes_over(p->s, p->first + lane, index[lane]))
            lanes &= ~(1u << lane);
    return lanes;
}

static inline JoxSelf jox_self_of(const JoxPacket *p) {
    const JoxAgents *a = p->s->agents;
    const uint32_t i = p->first;
    return (JoxSelf){
        .x = jf_load(a->x + i),
        .y = jf_load(a->y + i),
        .radius = jf_load(a->param[JOX_PARAM_radius] + i),
        .orca = {.velocity = jv_load(a->vx, a->vy, i),
                 .inverse = jf_div(jf_set(1.0f), jf_load(a->param[JOX_PARAM_horizon] + i)),
                 .share =
                     p->s->nav->literal ? jf_set(0.5f) : jf_load(a->param[JOX_PARAM_yield] + i)},
    };
}

/* The half-planes of walkers in place of ORCA's, of those who mind their neighbours, and who they
   are; their offset is q->x, q->y: see walker_half_plane in half_planes.c. */
static inline JoxPlaneLanes jox_walker_lanes(const JoxPacket *p, const JoxPair *q, JoxInts others,
                                             JoxVector velocity, JoxMask *there) {
    const JoxAgents *a = p->s->agents;
    const JoxWalkLaw *law = p->s->nav->walk;
    const JoxFloats one = jf_set(1.0f), zero = jf_set(0.0f);
    const JoxVector offset = {q->x, q->y};
    const JoxMindsLanes minds = jox_minds_lanes(p->s->nav, a, p->first, others, offset);
    const JoxFloats room =
        jf_sub(one, jf_mul(jf_set((float)law->room_eager), jf_load(a->eager + p->first)));
    const JoxFloats follows = jf_mul(jf_mul(q->radii, jf_set((float)law->width)), room);
    const JoxFloats crosses = jf_mul(q->radii, jf_set((float)law->width_cross));
    const JoxFloats distance = jf_sqrt(jv_dot(offset, offset));
    const JoxFloats gap = jf_sub(distance, jf_select(minds.crossing, crosses, follows));
    const JoxFloats by = jf_div(one, distance);
    const JoxVector towards = {jf_mul(q->x, by), jf_mul(q->y, by)};
    const JoxFloats leaves = jv_dot(towards, velocity);
    const JoxFloats share = jf_select(minds.crossing, jf_set(0.5f), one);
    const JoxFloats closes =
        jf_div(jf_mul(share, jf_max(gap, zero)), jf_set((float)law->close_time));
    *there = jm_without(jm_or(minds.ahead, minds.crossing), jf_le(jf_set((float)law->close), gap));
    return (JoxPlaneLanes){jf_neg(towards.x), jf_neg(towards.y),
                           jf_neg(jf_add(jf_max(zero, leaves), closes))};
}

static inline JoxPlaneLanes jox_select_plane(JoxMask m, JoxPlaneLanes a, JoxPlaneLanes b) {
    return (JoxPlaneLanes){jf_select(m, a.x, b.x), jf_select(m, a.y, b.y),
                           jf_select(m, a.offset, b.offset)};
}

/* The rows of the neighbours, at most so many of each. Returns the lanes that coincide with a
   neighbour, of which the half-plane depends on who they are. */
static inline __attribute__((always_inline)) uint32_t jox_put_rows(JoxPacket *p, uint32_t most,
                                                                   const bool periodic) {
    const JoxSolve *s = p->s;
    const JoxAgents *a = s->agents;
    const JoxSelf self = jox_self_of(p);
    const JoxPlaneLanes none = {jf_set(0.0f), jf_set(0.0f), jf_set(0.0f)};
    const JoxMask walkers = jm_of_bits(p->walkers);
    const uint32_t picky = jox_picky_lanes(p);
    uint32_t coincide = 0, counts[JOX_WIDTH];
    JoxTouched touched;
    jox_note_touched(p, &touched);
    for (uint32_t lane = 0; lane < JOX_WIDTH; lane++)
        counts[lane] = p->lanes >> lane & 1 ? s->neighbours->count[p->first + lane] : 0;
    for (uint32_t k = 0; k < most; k++) {
        const JoxMask there = ji_less(ji_set((int32_t)k), ji_load(counts));
        const JoxInts listed =
            ji_load(s->neighbours->index + jox_neighbour_at(s->neighbours, p->first, k));
        const JoxInts others = ji_select(there, listed, ji_set(0));
        JoxMask minds = jm_of_bits(jox_minding(p, &touched, jm_bits(there), picky, others));
        JoxFloats record[4];
        jf_records(&s->nav->records[0].x, others, record);
        JoxPair q = {jf_sub(record[0], self.x), jf_sub(record[1], self.y),
                     jf_sub(self.orca.velocity.x, record[2]),
                     jf_sub(self.orca.velocity.y, record[3]),
                     jf_add(self.radius, jf_pick(a->param[JOX_PARAM_radius], others))};
        if (periodic) {
            q.x = jf_wrap(q.x, a->period.x);
            q.y = jf_wrap(q.y, a->period.y);
        }
        JoxFloats apart = jf_max(jf_abs(q.x), jf_abs(q.y));
        coincide |= jm_bits(jm_and(minds, jf_le(apart, none.x)));
        JoxPlaneLanes plane = none;
        if (p->lanes & ~p->walkers)
            plane = jox_orca_lanes(&q, &self.orca, s->planning_time, minds);
        if (p->walkers) {
            JoxMask has;
            plane = jox_select_plane(
                walkers, jox_walker_lanes(p, &q, others, (JoxVector){record[2], record[3]}, &has),
                plane);
            minds = jm_without(minds, jm_without(walkers, has));
        }
        plane = jox_select_plane(minds, plane, none);
        jf_store(p->rows[p->hard + k].x, plane.x);
        jf_store(p->rows[p->hard + k].y, plane.y);
        jf_store(p->rows[p->hard + k].offset, plane.offset);
    }
    return coincide;
}

static inline uint32_t jox_put_rows_bounded(JoxPacket *p, uint32_t most) {
    return jox_put_rows(p, most, false);
}

static inline uint32_t jox_put_rows_periodic(JoxPacket *p, uint32_t most) {
    return jox_put_rows(p, most, true);
}

static inline void jox_put_neighbours(JoxPacket *p) {
    const JoxAgents *a = p->s->agents;
    const uint8_t *counts = p->s->neighbours->count + p->first;
    uint32_t most = 0;
    for (uint32_t lane = 0; p->lanes >> lane; lane++)
        if ((p->lanes >> lane & 1) && counts[lane] > most)
            most = counts[lane];
    jox_rows_open(p, p->hard + most);
    const bool periodic = a->period.x > 0.0f || a->period.y > 0.0f;
    const uint32_t alone = (periodic ? jox_put_rows_periodic : jox_put_rows_bounded)(p, most);
    for (uint32_t lane = 0; alone >> lane; lane++)
        for (uint32_t row = p->hard; (alone >> lane & 1) && row < p->hard + most; row++)
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
    for (uint32_t lane = 0; forced >> lane; lane++)
        p->made[lane].force = forced >> lane & 1;
}

static inline void jox_put_half_planes(JoxPacket *p) {
    p->count = 0;
    memset(p->made, 0, sizeof p->made);
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
