/* The half-planes of a packet of agents for solve. They stand in rows, with one half-plane of each
   lane in a row: first those of walls, then contacts, neighbours, bodies, force. A lane with fewer
   of a kind than another has rows of zeros there, which no velocity violates and the programs skip;
   so each lane meets its own half-planes in their order, and gets the result that it would get
   alone. Half-planes of neighbours are made for all lanes at once, by ORCA or by the walking law;
   those of walls, contacts and bodies one lane at a time. Included by solve_wide.c. */
#ifndef JOX_NAV_PACKET_LANES_H
#define JOX_NAV_PACKET_LANES_H

#include <math.h>
#include <string.h>

#include "agents/fold_lanes.h"
#include "agents/param_lanes.h"
#include "geom/wall_grid_lanes.h"
#include "nav/orca/pair_lanes.h"
#include "nav/orca/rest_lanes.h"
#include "nav/orca/solve.h"

typedef struct JoxPacket {
    const JoxSolve *s;
    uint32_t first;                   /* agent of lane 0 */
    uint32_t lanes;                   /* bits of the lanes that plan in this step */
    uint32_t near_walls, touching;    /* bits of these lanes */
    uint32_t pressed;                 /* bits of lanes that touch something or feel a force */
    uint32_t walkers;                 /* bits of lanes that walk by the law */
    uint32_t contacts, hard, objects; /* first rows of these kinds; hard: first row of neighbours */
    JoxHalfPlaneCounts made[JOX_WIDTH];
    uint32_t counted; /* bits of lanes whose `made` is not all 0 */
    uint32_t count;   /* number of rows */
    JoxRow rows[JOX_MOST_CONSTRAINTS];
    JoxHalfPlane list[JOX_MOST_CONSTRAINTS]; /* half-planes of one lane */
    JoxRest *unmet, *far; /* waiting agents: for the least violation; to be pulled within reach */
} JoxPacket;

/* Makes rows up to `count` exist; new ones are zeros. */
static inline void jox_rows_open(JoxPacket *p, uint32_t count) {
    if (count > p->count) {
        memset(&p->rows[p->count], 0, (count - p->count) * sizeof *p->rows);
        p->count = count;
    }
}

/* ---- half-planes made for one lane at a time ---- */

typedef uint32_t JoxMaker(const JoxSolve *solve, uint32_t agent, JoxHalfPlane *out);

/* Puts the half-planes that `make` returns for lanes (bits) into rows from `row` on. `at`: offset
   of their number in JoxHalfPlaneCounts. */
static inline void jox_put_lane_by_lane(JoxPacket *p, uint32_t lanes, uint32_t row, JoxMaker *make,
                                        size_t at) {
    p->counted |= lanes;
    for (; lanes; lanes &= lanes - 1) {
        const uint32_t lane = (uint32_t)__builtin_ctz(lanes);
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
#define JOX_PUT_LANE_BY_LANE(packet, lanes, row, make, kind)                                       \
    jox_put_lane_by_lane(packet, lanes, row, make, offsetof(JoxHalfPlaneCounts, kind))

/* ---- half-planes of neighbours ---- */

/* Indices of the agents that lanes touch: one per lane in a row, JOX_NO_INDEX where a lane has
   fewer. */
typedef struct JoxTouched {
    uint32_t rows;
    uint32_t other[JOX_MOST_TOUCHED][JOX_WIDTH];
} JoxTouched;

/* Lists the agents that the lanes touch. */
static inline void jox_note_touched(const JoxPacket *p, JoxTouched *t) {
    const JoxContactPlanes *planes = p->s->step.touched;
    t->rows = 0;
    for (uint32_t lanes = p->touching; lanes; lanes &= lanes - 1) {
        const uint32_t lane = (uint32_t)__builtin_ctz(lanes), i = p->first + lane;
        for (uint32_t k = 0; k < planes->people[i]; k++) {
            for (; t->rows <= k; t->rows++)
                memset(t->other[t->rows], 0xff, sizeof t->other[0]);
            t->other[k][lane] = planes->planes[planes->starts[i] + k].other;
        }
    }
}

/* Returns those of `lanes` that avoid their neighbour, whose indices are given. `scalar_tested`:
   lanes that need the scalar test jox_solve_passes_over. */
static inline uint32_t jox_find_avoiding(const JoxPacket *p, const JoxTouched *t, uint32_t lanes,
                                         uint32_t scalar_tested, const uint32_t *index) {
    JoxMask touched = jm_of_bits(0);
    for (uint32_t k = 0; k < t->rows; k++)
        touched = jm_or(touched, ji_equal(ji_load(index), ji_load(t->other[k])));
    lanes &= ~jm_bits(touched);
    scalar_tested &= lanes;
    for (; scalar_tested; scalar_tested &= scalar_tested - 1) {
        const uint32_t lane = (uint32_t)__builtin_ctz(scalar_tested);
        if (jox_solve_passes_over(p->s, p->first + lane, index[lane]))
            lanes &= ~(1u << lane);
    }
    return lanes;
}

static inline JoxPlaneLanes jox_select_plane(JoxMask m, JoxPlaneLanes a, JoxPlaneLanes b) {
    return (JoxPlaneLanes){jf_select(m, a.x, b.x), jf_select(m, a.y, b.y),
                           jf_select(m, a.offset, b.offset)};
}

/* Numbers of neighbours of the lanes that plan: of each lane, and the least and most of any. */
typedef struct JoxNeighbourCounts {
    JoxInts each;
    uint32_t least, most;
} JoxNeighbourCounts;

/* Counts the neighbours of the lanes. */
static inline JoxNeighbourCounts jox_count_neighbours(const JoxPacket *p) {
    const uint8_t *count = p->s->step.neighbours->count + p->first;
    JoxNeighbourCounts n = {ji_select(jm_of_bits(p->lanes), ji_load_bytes(count), ji_set(0)),
                            JOX_MOST_NEIGHBOURS, 0};
    for (uint32_t lane = 0; lane < JOX_WIDTH; lane++) {
        const uint32_t has = p->lanes >> lane & 1 ? count[lane] : 0;
        n.least = has < n.least ? has : n.least;
        n.most = has > n.most ? has : n.most;
    }
    return n;
}

/* Returns the lanes that have more than k neighbours. */
static inline uint32_t jox_have_more(const JoxNeighbourCounts *n, uint32_t k) {
    return k < n->least ? JOX_ALL_LANES : jm_bits(ji_less(ji_set((int32_t)k), n->each));
}

/* One neighbour of each lane: the pair, the neighbour's velocity, m/s, and the first half of
   ORCA. */
typedef struct JoxNeighbour {
    JoxPair pair;
    JoxVector velocity;
    JoxOrcaHalf half;
} JoxNeighbour;

/* Returns the distance of two agents, m, within which a wall between them counts: where they would
   else touch, or soon could. */
static inline JoxFloats jox_walled_reach(JoxFloats radii) {
    return radii + JOX_TOUCH_LEAST + JOX_TOUCH_MOST;
}

/* Returns the lanes (bits) that have a wall nearer than neighbours may be when it counts. `widest`:
   greatest sum of radii with one, m. */
static inline uint32_t jox_find_walled(const JoxPacket *p, JoxFloats widest) {
    const JoxFloats reach = jox_walled_reach(widest);
    if (!p->s->step.touched || !p->near_walls)
        return 0;
    return p->near_walls & ~jm_bits(jox_wall_grid_clear_lanes(p->s->unhidden2, p->first, reach));
}

/* Returns the lanes from which a wall may hide the neighbour, whose indices are given;
   is_hidden_by_wall of half_planes.c decides. `periodic`: it may be beyond a periodic edge, where
   no walls were measured. */
static inline uint32_t jox_may_be_hidden(const JoxSolve *s, uint32_t first, const JoxPair *q,
                                         const uint32_t *others, bool periodic) {
    const JoxFloats d2 = q->x * q->x + q->y * q->y, zero = jf_set(0.0f);
    const JoxFloats near = jox_walled_reach(q->radii);
    const JoxMask is_near = jf_le(d2, near * near);
    if (!s->unhidden2 || !jm_bits(is_near))
        return jm_bits(is_near);
    const JoxWallGrid *walls = &s->nav->grid;
    const JoxFloats own = jox_wall_grid_unhidden_lanes(walls, jf_load(s->unhidden2 + first), zero);
    const JoxFloats its =
        periodic ? zero
                 : jox_wall_grid_unhidden_lanes(walls, jf_pick_at(s->unhidden2, others), zero);
    return jm_bits(jm_and(is_near, jox_wall_grid_may_cross_lanes(d2, own, its)));
}

/* Fits the radii of pairs that do not walk by the law to their torsos. Returns the greatest, m. */
static inline JoxFloats jox_fit_radii(const JoxPacket *p, uint32_t most, uint32_t walkers,
                                      JoxNeighbour *pairs) {
    const JoxStep *step = &p->s->step;
    const uint32_t *others =
        step->neighbours->index + jox_neighbour_at(step->neighbours, p->first, 0);
    JoxFloats widest = jf_set(0.0f);
    for (uint32_t k = 0; k < most; k++, others += JOX_LANES) {
        JoxPair *q = &pairs[k].pair;
        q->radii = jf_select(jm_of_bits(walkers), q->radii,
                             jox_radii_of_torsos(step, p->first, others, q));
        widest = jf_max(widest, q->radii);
    }
    return widest;
}

/* Makes the velocities of the `most` first neighbours those that agents see from their own belts.
 */
static inline void jox_see_from_belts(const JoxPacket *p, uint32_t most, uint32_t walkers,
                                      JoxNeighbour *out) {
    const JoxNeighbours *near = p->s->step.neighbours;
    const JoxVector belt = jv_load(near->belt_x, near->belt_y, p->first);
    for (uint32_t k = 0; k < most; k++) {
        out[k].pair.vx += belt.x;
        out[k].pair.vy += belt.y;
        if (walkers)
            out[k].velocity = jv_sub(out[k].velocity, belt);
    }
}

/* Loads the pairs with the `most` first neighbours of the lanes. A lane with fewer gets arbitrary
   ones. Returns the greatest sum of radii, m. */
static inline __attribute__((always_inline)) JoxFloats
jox_fetch_pairs(const JoxPacket *p, const JoxSelf *self, uint32_t most, const uint32_t walkers,
                const bool periodic, JoxNeighbour out[JOX_MOST_NEIGHBOURS]) {
    const JoxNeighbours *near = p->s->step.neighbours;
    const JoxAgents *a = p->s->step.agents;
    const float *motions = &near->motions[0].x;
    const JoxParameterColumn radius = a->param[JOX_PARAM_radius];
    const uint32_t *others = near->index + jox_neighbour_at(near, p->first, 0);
    JoxFloats widest = jf_set(0.0f);
    for (uint32_t k = 0; k < most; k++, others += JOX_LANES) {
        JoxFloats motion[4];
        jf_records_at(motions, others, motion);
        const JoxFloats other = jox_param_of(radius, others);
        JoxPair q = {motion[0] - self->x, motion[1] - self->y, self->orca.velocity.x - motion[2],
                     self->orca.velocity.y - motion[3], self->radius + other};
        if (periodic) {
            const JoxVector apart = jox_fold_lanes(a, (JoxVector){q.x, q.y});
            q.x = apart.x;
            q.y = apart.y;
        }
        out[k].pair = q;
        widest = jf_max(widest, q.radii);
        if (walkers)
            out[k].velocity = (JoxVector){motion[2], motion[3]};
    }
    if (near->has_belts)
        jox_see_from_belts(p, most, walkers, out);
    if (jox_may_be_pressed(&p->s->step))
        return jox_fit_radii(p, most, walkers, out);
    return widest;
}

/* Makes the half-planes of walkers for one neighbour of each lane; *there: lanes that have one. */
static inline JoxPlaneLanes jox_walker_lanes(const JoxPacket *p, const JoxNeighbour *near,
                                             const JoxWalkerGap *gap, JoxInts others,
                                             JoxMask *there) {
    const JoxNav *nav = p->s->nav;
    const JoxVector offset = {near->pair.x, near->pair.y};
    JoxFloats heading[4];
    jf_records(&nav->headings[0].aim_x, others, heading);
    const JoxMindsLanes minds =
        jox_minds_lanes(p->s->step.agents, p->first, others, heading, offset);
    const JoxVector towards = jv_scale(offset, 1.0f / gap->distance);
    return jox_walker_plane(nav->walk, gap, &minds, towards, near->velocity, there);
}

/* Makes the half-planes of `lanes` (bits) for one neighbour of each; zeros in the other lanes.
   `walkers`: lanes that walk by the law; `all`: lanes of the packet. */
static inline __attribute__((always_inline)) void
jox_plane_lanes(const JoxPacket *p, const JoxSelf *self, uint32_t lanes, uint32_t all,
                const uint32_t walkers, const JoxNeighbour *near, const JoxWalkerGap *gap,
                const uint32_t *others, JoxPlaneLanes *plane) {
    const JoxPlaneLanes none = {jf_set(0.0f), jf_set(0.0f), jf_set(0.0f)};
    JoxMask minds = jm_of_bits(lanes);
    *plane = none;
    if (all & ~walkers)
        *plane = jox_orca_end(&near->pair, &self->orca, &near->half);
    if (walkers) {
        JoxMask has;
        const JoxMask walk = jm_of_bits(walkers);
        *plane =
            jox_select_plane(walk, jox_walker_lanes(p, near, gap, ji_load(others), &has), *plane);
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

/* Appends the rows of neighbours that all lanes have and avoid, in packets without walkers. */
static inline void jox_put_whole_rows(JoxPacket *p, const JoxSelf *self,
                                      const JoxNeighbour *nearest, uint32_t count) {
    for (uint32_t k = 0; k < count; k++) {
        const JoxPlaneLanes plane = jox_orca_end(&nearest[k].pair, &self->orca, &nearest[k].half);
        jox_store_plane(&p->rows[p->count + k], &plane);
    }
    p->count += count;
}

/* Appends the rows of the neighbours, except rows in which no lane avoids its neighbour. `walkers`:
   lanes that walk by the law. Returns the lanes whose centre may coincide with a neighbour's; those
   half-planes depend on the ids. */
static inline __attribute__((always_inline)) uint32_t
jox_put_rows(JoxPacket *p, const uint32_t walkers, const bool periodic) {
    const JoxSolve *s = p->s;
    const JoxNeighbours *near = s->step.neighbours;
    const JoxSelf self = jox_self_of(s, p->first, walkers);
    const uint32_t all = p->lanes;
    const JoxNeighbourCounts counts = jox_count_neighbours(p);
    const uint32_t scalar_tested = jox_scalar_test_lanes(p->s->step.agents, p->first) & p->lanes;
    uint32_t coincide = 0;
    JoxTouched touched;
    jox_note_touched(p, &touched);
    JoxNeighbour nearest[JOX_MOST_NEIGHBOURS];
    const uint32_t walled =
        jox_find_walled(p, jox_fetch_pairs(p, &self, counts.most, walkers, periodic, nearest));
    const uint32_t some_tested = scalar_tested | walled | (touched.rows ? p->touching : 0);
    for (uint32_t k = 0; (all & ~walkers) && k < counts.most; k++)
        nearest[k].half =
            jox_orca_begin(&nearest[k].pair, &self.orca, (float)s->step.timing.planning_time,
                           jox_have_more(&counts, k), &coincide);
    if (!walkers && !some_tested && counts.least == counts.most) {
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
        if (lanes & some_tested)
            lanes = jox_find_avoiding(
                p, &touched, lanes,
                scalar_tested | (walled ? walled & jox_may_be_hidden(s, p->first, &nearest[k].pair,
                                                                     others, periodic)
                                        : 0),
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

/* jox_put_rows for packets that see no periodic edge, and for packets that do. The first has a copy
   compiled for packets without walkers. */
static inline uint32_t jox_put_rows_bounded(JoxPacket *p) {
    return p->walkers ? jox_put_rows(p, p->walkers, false) : jox_put_rows(p, 0, false);
}

static inline uint32_t jox_put_rows_periodic(JoxPacket *p) {
    return jox_put_rows(p, p->walkers, true);
}

/* Returns whether neighbours of a packet's agents may stand beyond a periodic edge or a seam. */
static inline bool jox_sees_over_edges(const JoxPacket *p) {
    const JoxAgents *a = p->s->step.agents;
    const JoxFloats margin = jf_set(1e-3f); /* m: more than the rounding of positions */
    const JoxFloats reach = jf_load(a->search_radius + p->first) + margin;
    JoxMask over = jm_of_bits(0);
    if (a->pitch > 0.0f)
        return true;
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

/* Appends the rows of neighbours; lanes with a coincident neighbour get theirs from
   half_planes.c. */
static inline void jox_put_neighbours(JoxPacket *p) {
    const uint32_t alone =
        (jox_sees_over_edges(p) ? jox_put_rows_periodic : jox_put_rows_bounded)(p);
    for (uint32_t lane = 0; alone >> lane; lane++)
        for (uint32_t row = p->hard; (alone >> lane & 1) && row < p->count; row++)
            p->rows[row].x[lane] = p->rows[row].y[lane] = p->rows[row].offset[lane] = 0.0f;
    if (alone)
        JOX_PUT_LANE_BY_LANE(p, alone, p->hard, jox_solve_neighbours, agents);
}

/* Appends the row of the forces' half-planes, and sets `pressed`: no lane in literal mode, whose
   velocities nothing bounds but the half-planes and the speed limit. */
static inline void jox_put_force(JoxPacket *p) {
    const JoxAgents *a = p->s->step.agents;
    const JoxFloats zero = jf_set(0.0f);
    JoxFloats x = jf_load(a->half_plane_x + p->first), y = jf_load(a->half_plane_y + p->first);
    JoxMask there = jm_and(jf_lt(zero, jf_max(jf_abs(x), jf_abs(y))), jm_of_bits(p->lanes));
    const uint32_t row = p->count, forced = jm_bits(there);
    p->pressed = p->s->nav->literal ? 0 : p->touching | forced;
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

/* Makes all rows of a packet. */
static inline void jox_put_half_planes(JoxPacket *p) {
    p->count = 0;
    for (uint32_t lane = 0; p->counted >> lane; lane++)
        if (p->counted >> lane & 1)
            p->made[lane] = (JoxHalfPlaneCounts){0};
    p->counted = 0;
    if (p->near_walls)
        JOX_PUT_LANE_BY_LANE(p, p->near_walls, 0, jox_solve_walls, walls);
    p->contacts = p->count;
    if (p->touching)
        JOX_PUT_LANE_BY_LANE(p, p->touching, p->contacts, jox_solve_contacts, contacts);
    p->hard = p->count;
    jox_put_neighbours(p);
    p->objects = p->count;
    if (p->s->step.objects && p->s->step.objects->count)
        JOX_PUT_LANE_BY_LANE(p, p->lanes, p->objects, jox_solve_objects, objects);
    jox_put_force(p);
}

#endif
