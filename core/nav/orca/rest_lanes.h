/* The rest of solve, in lanes: agents for which the first program found no velocity, or one too far
   from the wanted one under forces and contacts (out of reach). They are gathered from many packets
   into full ones. Each gets what jox_solve_one would give it, to the bit. Included by solve_wide.c,
   and by solve_one.c at width 1. */
#ifndef JOX_NAV_REST_LANES_H
#define JOX_NAV_REST_LANES_H

#include <string.h>

#include "nav/orca/program_lanes.h"
#include "nav/orca/solve.h"

/* The wanted and the forced velocity of agents, m/s, their half-plane of force, the lanes that
   touch something, those that touch something or feel a force, and those that want to stand. In
   literal mode the last two are none. */
typedef struct JoxPressed {
    JoxVector wanted, forced;
    JoxPlaneLanes force;
    JoxMask touching, pressed, stands;
} JoxPressed;

/* Waiting agents, one per lane, with the rows of half-planes that they had in their packets. Hard
   rows end before row JOX_REST_HARD, where the soft ones begin. */
enum { JOX_REST_HARD = JOX_MOST_WALLS + JOX_MOST_CONTACTS };
typedef struct JoxRest {
    uint32_t count;
    uint32_t agent[JOX_WIDTH];
    bool failed[JOX_WIDTH]; /* a row could not be met */
    /* Rows: the one that failed; the first of contacts; that of force. */
    uint32_t failed_at[JOX_WIDTH], contacts[JOX_WIDTH], force[JOX_WIDTH];
    JoxHalfPlaneCounts made[JOX_WIDTH]; /* without the number of neighbours */
    float wanted_x[JOX_WIDTH], wanted_y[JOX_WIDTH], velocity_x[JOX_WIDTH], velocity_y[JOX_WIDTH];
    uint32_t hard, soft; /* rows in use, over all lanes */
    JoxRow rows[JOX_MOST_CONSTRAINTS];
} JoxRest;

static inline void jox_rest_clear(JoxRest *r) {
    r->count = r->hard = r->soft = 0;
}

/* Makes room for `hard` and `soft` rows; new ones are zeros. */
static inline void jox_rest_open(JoxRest *r, uint32_t hard, uint32_t soft) {
    if (hard > r->hard) {
        memset(&r->rows[JOX_REST_HARD - hard], 0, (hard - r->hard) * sizeof *r->rows);
        r->hard = hard;
    }
    if (soft > r->soft) {
        memset(&r->rows[JOX_REST_HARD + r->soft], 0, (soft - r->soft) * sizeof *r->rows);
        r->soft = soft;
    }
}

/* Places of a list that lanes of other rows get: place `at` gets lane from[at], for places from
   `first` to before `end`; `left`: lanes (bits) without a place. */
typedef struct JoxPlacing {
    uint32_t first, end, left, from[JOX_WIDTH];
} JoxPlacing;

/* Gives free places to as many of `lanes` (bits) as it can; the caller fills them. */
static inline JoxPlacing jox_rest_place(JoxRest *r, uint32_t lanes) {
    JoxPlacing p = {.first = r->count};
    for (; lanes && r->count < JOX_WIDTH; lanes &= lanes - 1)
        p.from[r->count++] = (uint32_t)__builtin_ctz(lanes);
    p.end = r->count;
    p.left = lanes;
    return p;
}

/* Copies rows, of which the first `hard` are hard, from the lanes to their places. */
static inline void jox_rest_copy_rows(JoxRest *r, const JoxPlacing *p, const JoxRow *rows,
                                      uint32_t hard, uint32_t soft) {
    const JoxInts from = ji_load(p->from);
    const JoxMask places = jm_of_bits(jox_first_lanes(p->end) & ~jox_first_lanes(p->first));
    jox_rest_open(r, hard, soft);
    JoxRow *to = &r->rows[JOX_REST_HARD - hard];
    for (uint32_t k = 0; k < hard + soft; k++) {
        const JoxVector normal = jox_row_normal(&rows[k]), old = jox_row_normal(&to[k]);
        const JoxVector arranged = {jf_arrange(normal.x, from), jf_arrange(normal.y, from)};
        const JoxFloats offset = jf_arrange(jf_load(rows[k].offset), from);
        const JoxVector both = jv_select(places, arranged, old);
        jf_store(to[k].x, both.x);
        jf_store(to[k].y, both.y);
        jf_store(to[k].offset, jf_select(places, offset, jf_load(to[k].offset)));
    }
}

static inline uint32_t jox_count_of(const JoxHalfPlaneCounts *made) {
    return made->walls + made->contacts + made->agents + made->objects + made->force;
}

/* Returns the square, m2/s2, of how far the own motion may take agents from the wanted velocity:
   see keep_within_reach in solve_one.c. */
static inline JoxFloats jox_reach2_lanes(const JoxPressed *p) {
    JoxFloats fx = p->forced.x - p->wanted.x, fy = p->forced.y - p->wanted.y;
    JoxFloats reach2 = fx * fx + fy * fy;
    JoxFloats along = jv_dot((JoxVector){p->force.x, p->force.y}, p->wanted);
    JoxFloats lacks = jf_max(jf_set(0.0f), p->force.offset - along);
    return jf_max(reach2, lacks * lacks);
}

/* Returns the lanes whose velocity is out of reach. */
static inline JoxMask jox_out_of_reach_lanes(const JoxPressed *p, JoxVector velocity) {
    JoxVector d = {velocity.x - p->wanted.x, velocity.y - p->wanted.y};
    return jm_without(p->pressed, jf_le(jv_dot(d, d), jox_reach2_lanes(p)));
}

/* Returns the forced velocity for agents in contact whose planned one differs from it only by the
   program's rounding: then contact alone acts, and keeps momentum. */
static inline JoxVector jox_snap_to_forced_lanes(const JoxPressed *p, JoxVector velocity) {
    const JoxFloats rounding = jf_set(2e-5f); /* m/s */
    JoxVector d = {velocity.x - p->forced.x, velocity.y - p->forced.y};
    JoxMask same = jm_and(p->touching, jf_lt(jv_dot(d, d), rounding * rounding));
    return jv_select(same, p->forced, velocity);
}

/* Writes the planned velocity of an agent, m/s. */
static inline void jox_write_plan(const JoxSolve *s, uint32_t agent, float x, float y,
                                  bool failed) {
    s->step.agents->next_x[agent] = x;
    s->step.agents->next_y[agent] = y;
    s->step.agents->failed[agent] |= failed;
}

/* ---- the gathered agents ---- */

/* Data of the gathered agents, in lanes. Lanes without an agent repeat the first. */
typedef struct JoxRestLanes {
    JoxMask all;
    JoxFloats limit;             /* m/s */
    JoxInts contacts, failed_at; /* rows: the first of contacts; the one that could not be met */
    uint32_t count, hard;        /* rows; the first soft row */
    JoxRow *rows;
    float unlowered[JOX_REST_HARD + 1][JOX_WIDTH]; /* m/s: offsets of the hard rows, and of force,
                                                  before any was lowered */
    JoxPressed pressed;
    JoxVector velocity;
} JoxRestLanes;

/* Loads the gathered agents into lanes. */
static inline void jox_rest_load(const JoxSolve *s, JoxRest *r, JoxRestLanes *l) {
    const JoxAgents *a = s->step.agents;
    uint32_t touching = 0, pressed = 0, stands = 0;
    uint32_t contacts[JOX_WIDTH] = {0}, failed_at[JOX_WIDTH] = {0};
    const uint32_t first = JOX_REST_HARD - r->hard;
    for (uint32_t k = r->count; k < JOX_WIDTH; k++)
        r->agent[k] = r->agent[0];
    l->hard = r->hard;
    l->count = r->hard + r->soft;
    l->rows = &r->rows[first];
    for (uint32_t k = 0; k < r->count; k++) {
        contacts[k] = r->contacts[k] - first;
        failed_at[k] = r->failed_at[k] - first;
        touching |= (r->made[k].contacts > 0) << k;
        pressed |= (!s->nav->literal && (r->made[k].contacts > 0 || r->made[k].force)) << k;
        stands |= (uint32_t)(!s->nav->literal && jox_stands(a, r->agent[k])) << k;
    }
    l->contacts = ji_load(contacts);
    l->failed_at = ji_load(failed_at);
    const JoxInts at = ji_load(r->agent);
    l->all = jm_of_bits((1u << r->count) - 1);
    l->limit = jf_pick(a->speed_limit, at);
    l->velocity = (JoxVector){jf_load(r->velocity_x), jf_load(r->velocity_y)};
    l->pressed = (JoxPressed){{jf_load(r->wanted_x), jf_load(r->wanted_y)},
                              {jf_pick(a->forced_x, at), jf_pick(a->forced_y, at)},
                              {jf_pick(a->half_plane_x, at), jf_pick(a->half_plane_y, at),
                               jf_pick(a->half_plane_offset, at)},
                              jm_of_bits(touching),
                              jm_of_bits(pressed),
                              jm_of_bits(stands)};
}

/* Plans one agent that can only move if hard half-planes are relaxed, with its half-planes as they
   were before any was lowered. Returns whether one was relaxed. */
static inline bool jox_rest_solve_one(const JoxSolve *s, const JoxRest *r, const JoxRestLanes *l,
                                      uint32_t k) {
    JoxHalfPlane list[JOX_MOST_CONSTRAINTS];
    JoxHalfPlaneCounts made = r->made[k];
    uint32_t count = 0;
    for (uint32_t row = 0; row < l->count; row++) {
        const JoxV2 normal = {l->rows[row].x[k], l->rows[row].y[k]};
        if (normal.x == 0.0f && normal.y == 0.0f)
            continue;
        const float offset = row < l->hard ? l->unlowered[row][k] : l->rows[row].offset[k];
        list[count++] = (JoxHalfPlane){normal, offset};
    }
    if (made.force)
        list[count - 1].offset = l->unlowered[l->hard][k];
    made.agents = count - (made.walls + made.contacts + made.objects + made.force);
    return jox_solve_one(s, r->agent[k], &made, list, jox_v2(r->wanted_x[k], r->wanted_y[k]));
}

/* Solves the program over rows for `lanes`. Returns the lanes in which a hard row cannot be met,
   whose result is invalid. */
static inline JoxMask jox_best_lanes(const JoxRow *rows, uint32_t count, uint32_t hard,
                                     JoxMask lanes, JoxFloats limit, JoxVector wanted,
                                     JoxMask stands, JoxVector *result) {
    JoxInts at;
    JoxMask failed = jox_program_lanes(rows, count, lanes, limit, wanted, NULL, result, &at);
    JoxMask unmet = jm_and(failed, ji_less(at, ji_set((int32_t)hard)));
    JoxMask soft = jm_without(failed, unmet);
    if (jm_bits(soft))
        jox_least_violation_lanes(rows, count, hard, soft, at, limit, wanted,
                                  jox_least_towards(stands), result);
    return unmet;
}

/* Lowers the half-planes of contacts and force until they allow the best velocity within reach, as
   keep_within_reach of solve_one.c does. Returns the lanes where any was lowered; *unmet: lanes in
   which a hard half-plane has to be relaxed, which jox_solve_one does. */
static inline JoxMask jox_lower_lanes(const JoxRest *r, JoxRestLanes *l, JoxMask *unmet) {
    const JoxFloats slack = jf_set(1e-5f);
    const JoxVector wanted = l->pressed.wanted, none = {jf_set(0.0f), jf_set(0.0f)};
    const JoxPlaneLanes *force = &l->pressed.force;
    JoxRow imposed[JOX_REST_HARD + 1];
    for (uint32_t row = 0; row <= l->hard; row++) {
        const bool is_hard = row < l->hard;
        JoxVector n = is_hard ? jox_row_normal(&l->rows[row]) : (JoxVector){force->x, force->y};
        JoxFloats offset = is_hard ? jf_load(l->rows[row].offset) : force->offset;
        jf_store(imposed[row].x, n.x);
        jf_store(imposed[row].y, n.y);
        jf_store(l->unlowered[row], offset);
        jf_store(imposed[row].offset, offset - jv_dot(n, wanted));
    }
    JoxVector change;
    *unmet =
        jox_best_lanes(imposed, l->hard + 1, l->hard, l->all,
                       jf_sqrt(jox_reach2_lanes(&l->pressed)), none, l->pressed.stands, &change);
    const JoxVector best = {wanted.x + change.x, wanted.y + change.y};
    JoxMask lowered = jm_of_bits(0);
    for (uint32_t row = 0; row < l->hard; row++) {
        JoxMask contact = jm_without(l->all, ji_less(ji_set((int32_t)row), l->contacts));
        JoxFloats least = jv_dot(jox_row_normal(&l->rows[row]), best);
        JoxFloats offset = jf_load(l->rows[row].offset);
        JoxMask lower = jm_without(contact, jf_le(offset, least + slack));
        jf_store(l->rows[row].offset, jf_select(lower, least - slack, offset));
        lowered = jm_or(lowered, lower);
    }
    JoxFloats least = jv_dot((JoxVector){force->x, force->y}, best);
    uint32_t lower = jm_bits(jm_without(l->all, jf_le(force->offset, least + slack)));
    float offsets[JOX_WIDTH];
    jf_store(offsets, least - slack);
    for (uint32_t k = 0; k < r->count; k++) {
        const uint32_t last = r->force[k] - (JOX_REST_HARD - r->hard);
        if (!r->made[k].force)
            lower &= ~(1u << k);
        else if (lower >> k & 1)
            l->rows[last].offset[k] = offsets[k];
    }
    return jm_or(lowered, jm_of_bits(lower));
}

/* Plans the gathered agents, from the velocity of their own program, after lowering contacts and
   force to what is within reach; empties the list. Returns how many had a hard half-plane
   relaxed. */
static inline uint32_t jox_rest_solve_far(const JoxSolve *s, JoxRest *r) {
    JoxRestLanes l;
    JoxVector lowest;
    JoxMask unmet, lowered;
    uint32_t relaxed = 0;
    float x[JOX_WIDTH], y[JOX_WIDTH];
    if (!r->count)
        return 0;
    jox_rest_load(s, r, &l);
    lowered = jox_lower_lanes(r, &l, &unmet);
    lowered = jm_without(lowered, unmet);
    if (jm_bits(lowered)) {
        unmet = jm_or(unmet, jox_best_lanes(l.rows, l.count, l.hard, lowered, l.limit,
                                            l.pressed.wanted, l.pressed.stands, &lowest));
        l.velocity = jv_select(lowered, lowest, l.velocity);
    }
    l.velocity = jox_snap_to_forced_lanes(&l.pressed, l.velocity);
    jf_store(x, l.velocity.x);
    jf_store(y, l.velocity.y);
    for (uint32_t k = 0; k < r->count; k++)
        if (jm_bits(unmet) >> k & 1) {
            relaxed += jox_rest_solve_one(s, r, &l, k);
        } else {
            jox_write_plan(s, r->agent[k], x[k], y[k], r->failed[k]);
            if (jm_bits(lowered) >> k & 1)
                s->step.agents->plan_notes[r->agent[k]] |= JOX_NOTE_BOUNDED;
        }
    jox_rest_clear(r);
    return relaxed;
}

/* Appends entries (bits) of a list to another one. Returns those for which there is no room. */
static inline uint32_t jox_rest_copy(const JoxRest *from, uint32_t entries, JoxRest *to) {
    const JoxPlacing p = jox_rest_place(to, entries);
    for (uint32_t at = p.first; at < p.end; at++) {
        const uint32_t k = p.from[at];
        to->agent[at] = from->agent[k];
        to->failed[at] = from->failed[k];
        to->failed_at[at] = from->failed_at[k];
        to->made[at] = from->made[k];
        to->wanted_x[at] = from->wanted_x[k];
        to->wanted_y[at] = from->wanted_y[k];
        to->velocity_x[at] = from->velocity_x[k];
        to->velocity_y[at] = from->velocity_y[k];
        to->contacts[at] = from->contacts[k];
        to->force[at] = from->force[k];
    }
    jox_rest_copy_rows(to, &p, &from->rows[JOX_REST_HARD - from->hard], from->hard, from->soft);
    return p.left;
}

/* Plans the gathered agents whose half-planes cannot all be met, with the least greatest violation.
   Agents that are then out of reach move on to `far`; if that gets full it is planned. Returns how
   many of those had a hard half-plane relaxed. */
static inline uint32_t jox_rest_solve_unmet(const JoxSolve *s, JoxRest *r, JoxRest *far) {
    JoxRestLanes l;
    uint32_t relaxed = 0;
    float x[JOX_WIDTH], y[JOX_WIDTH];
    if (!r->count)
        return 0;
    jox_rest_load(s, r, &l);
    jox_least_violation_lanes(l.rows, l.count, l.hard, l.all, l.failed_at, l.limit,
                              l.pressed.wanted, jox_least_towards(l.pressed.stands), &l.velocity);
    uint32_t out =
        jm_bits(jox_out_of_reach_lanes(&l.pressed, l.velocity)) & jox_first_lanes(r->count);
    const JoxVector planned = jox_snap_to_forced_lanes(&l.pressed, l.velocity);
    jf_store(r->velocity_x, l.velocity.x);
    jf_store(r->velocity_y, l.velocity.y);
    jf_store(x, planned.x);
    jf_store(y, planned.y);
    for (uint32_t k = 0; k < r->count; k++)
        if (!(out >> k & 1))
            jox_write_plan(s, r->agent[k], x[k], y[k], true);
    while (out) {
        out = jox_rest_copy(r, out, far);
        if (far->count == JOX_WIDTH)
            relaxed += jox_rest_solve_far(s, far);
    }
    jox_rest_clear(r);
    return relaxed;
}

#endif
