/* The linear programs over half-planes and a disc of velocities, for all lanes in lock step: in two
   dimensions the velocity nearest to the wanted one (de Berg et al., Computational Geometry, ch.
   4); in three the one with the least violation (van den Berg et al. 2011). solve_wide.c includes
   it for packets, linear_program.c at width 1. */
#ifndef JOX_NAV_PROGRAM_LANES_H
#define JOX_NAV_PROGRAM_LANES_H

#include <string.h>

#include "nav/orca/solve.h"
#include "simd/vectors.h"

/* Half-planes n . v >= offset (m/s), one of each lane. A lane without one has zeros: any velocity
   meets them, and they bound no other. */
typedef struct JoxRow {
    float x[JOX_WIDTH], y[JOX_WIDTH], offset[JOX_WIDTH];
} JoxRow;

/* A half-plane n . v >= offset (m/s) of each lane, in registers; zeros: none. */
typedef struct JoxPlaneLanes {
    JoxFloats x, y, offset;
} JoxPlaneLanes;

static inline JoxVector jox_row_normal(const JoxRow *row) {
    return (JoxVector){jf_load(row->x), jf_load(row->y)};
}

/* The part of a row's border within the speed limit that the rows before it leave: the points foot
   + t * direction (m/s) for t from `low` to `high`. jox_border_lanes returns the lanes in which
   nothing is left. */
typedef struct JoxBorder {
    JoxVector foot, direction;
    JoxFloats low, high;
} JoxBorder;

/* Computes what is left of a row's border; returns the lanes in which nothing is. */
static inline JoxMask jox_border_lanes(const JoxRow *rows, uint32_t row, JoxFloats limit,
                                       JoxBorder *b) {
    const JoxFloats epsilon = jf_set(1e-5f), zero = jf_set(0.0f);
    const JoxVector normal = jox_row_normal(&rows[row]);
    const JoxFloats offset = jf_load(rows[row].offset);
    JoxFloats half2 = limit * limit - offset * offset;
    JoxMask none = jf_lt(half2, zero);
    JoxFloats half = jf_sqrt(half2), low = -half, high = half;
    b->direction = (JoxVector){normal.y, -normal.x};
    b->foot = (JoxVector){normal.x * offset, normal.y * offset};
    for (uint32_t k = 0; k < row; k++) {
        const JoxVector other = jox_row_normal(&rows[k]);
        JoxFloats across = jv_dot(other, b->direction);
        JoxFloats missing = jf_load(rows[k].offset) - jv_dot(other, b->foot);
        JoxMask parallel = jf_le(jf_abs(across), epsilon);
        none = jm_or(none, jm_and(parallel, jf_lt(epsilon, missing)));
        JoxFloats t = missing / across;
        JoxMask up = jf_lt(zero, across);
        low = jf_select(jm_without(up, parallel), jf_max(low, t), low);
        high = jf_select(jm_or(up, parallel), high, jf_min(high, t));
    }
    b->low = low;
    b->high = high;
    return jm_or(none, jf_lt(high, low));
}

/* A direction in which the program of the least violation looks for the best velocity. Along a
   border that leads there by less than `least`, per unit of length, it keeps to the wanted one. */
typedef struct JoxTowards {
    JoxVector direction;
    JoxFloats least;
} JoxTowards;

/* Values of `least`: rounding, and what it takes for agents that want to stand to go aside. Two
   nearly opposite half-planes, of a push from behind and of the agent ahead, leave a valley; along
   it feet would throw an agent aside to lessen their conflict by next to nothing. */
#define JOX_TOWARDS_ROUNDING 1e-5f
#define JOX_TOWARDS_STANDING 0.1f

static inline JoxFloats jox_least_towards(JoxMask stands) {
    return jf_select(stands, jf_set(JOX_TOWARDS_STANDING), jf_set(JOX_TOWARDS_ROUNDING));
}

/* Returns the best velocities on borders: nearest to `wanted`, or, where `towards` is given,
   farthest along it. */
static inline JoxVector jox_along_border_lanes(const JoxBorder *b, JoxVector wanted,
                                               const JoxTowards *towards) {
    const JoxFloats share = jf_set(JOX_ASIDE_RIGHT_FIRST);
    if (towards)
        wanted = (JoxVector){wanted.x - (-wanted.y * share), wanted.y - wanted.x * share};
    JoxVector away = {wanted.x - b->foot.x, wanted.y - b->foot.y};
    JoxFloats t = jv_dot(b->direction, away);
    t = jf_select(jf_lt(t, b->low), b->low, jf_select(jf_lt(b->high, t), b->high, t));
    if (towards) {
        JoxFloats gain = jv_dot(towards->direction, b->direction);
        t = jf_select(jf_lt(towards->least, gain), b->high, t);
        t = jf_select(jf_lt(gain, -towards->least), b->low, t);
    }
    return (JoxVector){b->foot.x + b->direction.x * t, b->foot.y + b->direction.y * t};
}

/* Solves the two-dimensional program over the first `count` rows, for the lanes of `all`. Returns
   the lanes in which not all rows can be met: there *failed_at is the first row that cannot, and
   *result meets the rows before it. `towards`, or NULL: see jox_along_border_lanes. */
static inline JoxMask jox_program_lanes(const JoxRow *rows, uint32_t count, JoxMask all,
                                        JoxFloats limit, JoxVector wanted,
                                        const JoxTowards *towards, JoxVector *result,
                                        JoxInts *failed_at) {
    JoxVector v = wanted;
    if (towards) {
        v = jv_scale(towards->direction, limit);
    } else {
        JoxFloats length2 = jv_dot(wanted, wanted);
        JoxFloats by = limit / jf_sqrt(length2);
        JoxVector shorter = {wanted.x * by, wanted.y * by};
        v = jv_select(jf_lt(limit * limit, length2), shorter, wanted);
    }
    JoxMask failed = jm_of_bits(0), left = all;
    *failed_at = ji_set(0);
    for (uint32_t row = 0; row < count; row++) {
        JoxFloats along = jv_dot(jox_row_normal(&rows[row]), v);
        JoxMask violated = jm_and(left, jf_lt(along, jf_load(rows[row].offset)));
        if (!jm_bits(violated))
            continue;
        JoxBorder border;
        JoxMask none = jm_and(violated, jox_border_lanes(rows, row, limit, &border));
        *failed_at = ji_select(none, ji_set((int32_t)row), *failed_at);
        failed = jm_or(failed, none);
        left = jm_without(left, none);
        v = jv_select(jm_without(violated, none), jox_along_border_lanes(&border, wanted, towards),
                      v);
    }
    *result = v;
    return failed;
}

/* Makes the rows of the projected program: they allow the velocities at which row `worst` is
   violated at least as much as the soft rows before it. Hard rows stay as they are. */
static inline void jox_project_lanes(const JoxRow *rows, uint32_t hard, uint32_t worst,
                                     JoxRow *out) {
    const JoxFloats epsilon = jf_set(1e-5f), zero = jf_set(0.0f), one = jf_set(1.0f);
    const JoxVector normal = jox_row_normal(&rows[worst]);
    const JoxFloats offset = jf_load(rows[worst].offset);
    for (uint32_t j = hard; j < worst; j++) {
        const JoxVector other = jox_row_normal(&rows[j]);
        JoxVector d = {other.x - normal.x, other.y - normal.y};
        JoxFloats length = jf_sqrt(jv_dot(d, d)), by = one / length;
        JoxMask there = jf_lt(jf_set(0.5f), jv_dot(other, other));
        there = jm_and(there, jf_lt(epsilon, length));
        JoxFloats moved = (jf_load(rows[j].offset) - offset) / length;
        jf_store(out[j].x, jf_select(there, d.x * by, zero));
        jf_store(out[j].y, jf_select(there, d.y * by, zero));
        jf_store(out[j].offset, jf_select(there, moved, zero));
    }
}

/* Solves the three-dimensional program for the lanes of `failed`, from the row that failed:
   minimises the greatest violation of the soft rows (from `hard` on) while the hard ones hold.
   `least`: see JoxTowards. */
static inline void jox_least_violation_lanes(const JoxRow *rows, uint32_t count, uint32_t hard,
                                             JoxMask failed, JoxInts failed_at, JoxFloats limit,
                                             JoxVector wanted, JoxFloats least, JoxVector *result) {
    JoxRow projected[JOX_MOST_CONSTRAINTS];
    JoxFloats violation = jf_set(0.0f);
    memcpy(projected, rows, hard * sizeof *rows);
    for (uint32_t row = hard; row < count; row++) {
        const JoxVector normal = jox_row_normal(&rows[row]);
        const JoxFloats offset = jf_load(rows[row].offset);
        JoxFloats over = offset - jv_dot(normal, *result);
        JoxMask there = jf_lt(jf_set(0.5f), jv_dot(normal, normal));
        JoxMask worse = jm_and(jm_and(failed, there), jf_lt(violation, over));
        worse = jm_without(worse, ji_less(ji_set((int32_t)row), failed_at));
        if (!jm_bits(worse))
            continue;
        jox_project_lanes(rows, hard, row, projected);
        JoxVector best;
        JoxInts unmet_at; /* fails only by rounding: the present result already lies there */
        const JoxTowards towards = {normal, least};
        JoxMask unmet =
            jox_program_lanes(projected, row, worse, limit, wanted, &towards, &best, &unmet_at);
        *result = jv_select(jm_without(worse, unmet), best, *result);
        over = offset - jv_dot(normal, *result);
        violation = jf_select(worse, over, violation);
    }
}

#endif
