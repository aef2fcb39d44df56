/* The kernels of the stage prefer; each lane is an agent of a batch. */
#include "agents/param_lanes.h"
#include "machine/kernels.h"
#include "simd/vectors.h"

/* Greatest velocity of a term, in multiples of the wanted speed, far above what terms can ask for
   (drift); longer ones and NaN are dropped. */
#define MOST_SHARE 1e6f
#define MOVES 0.0025f /* m2/s2: slower agents keep their facing direction */

static inline JoxVector pick_vectors(const float *x, const float *y, JoxInts at) {
    return (JoxVector){jf_pick(x, at), jf_pick(y, at)};
}

static inline JoxFloats square_lengths(JoxVector a) {
    return jv_dot(a, a);
}

/* Normalises vectors as jox_unit does: zero stays zero. */
static inline JoxVector normalise_lanes(JoxVector a) {
    const JoxFloats zero = jf_set(0.0f), length = jf_sqrt(square_lengths(a));
    return jv_select(jf_lt(zero, length), jv_scale(a, 1.0f / length), (JoxVector){zero, zero});
}

static inline JoxFloats clamp_lanes(JoxFloats x, float low, float high) {
    return jf_min(jf_max(x, jf_set(low)), jf_set(high));
}

/* Does the same as jox_segment_nearest. */
static inline JoxVector nearest_on_axis(const JoxPlace *place, JoxVector p) {
    const JoxV2 a = place->axis_a, ab = jox_sub(place->axis_b, a);
    const float l2 = jox_length2(ab);
    const JoxVector start = {jf_set(a.x), jf_set(a.y)}, way = {jf_set(ab.x), jf_set(ab.y)};
    if (!(l2 > 0.0f))
        return start;
    const JoxVector from = {p.x - start.x, p.y - start.y};
    return jv_add(start, jv_scale(way, clamp_lanes(jv_dot(from, way) / l2, 0.0f, 1.0f)));
}

/* Returns the direction round a solid, counter-clockwise: T - w N with N outward from the stadium
   around it. The inward weight w makes the density follow a profile that falls outwards from the
   wall. */
static JoxVector find_orbit_ways(const JoxSteer *s, JoxInts at) {
    const JoxAgents *a = s->agents;
    const double *o = s->args;
    const float near = (float)o[JOX_ORBIT_DENSITY_NEAR], far = (float)o[JOX_ORBIT_DENSITY_FAR];
    const JoxVector p = pick_vectors(a->x, a->y, at), axis = nearest_on_axis(s->place, p);
    const JoxVector out = {p.x - axis.x, p.y - axis.y};
    const JoxFloats distance = jf_sqrt(square_lengths(out)) - s->place->axis_radius;
    const JoxVector normal = normalise_lanes(out);
    const JoxFloats share = clamp_lanes(distance / (float)o[JOX_ORBIT_FAR], 0.0f, 1.0f);
    const JoxFloats wanted = near + (far - near) * share;
    const JoxFloats lacks = clamp_lanes(wanted - jf_pick(a->density, at), -0.1f, 1.0f);
    JoxFloats inward = (float)o[JOX_ORBIT_INWARD] * lacks;
    inward = jf_select(jf_lt(jf_set((float)o[JOX_ORBIT_RETURN]), distance), jf_set(0.6f), inward);
    const JoxVector inwards = jv_scale(normal, inward);
    return normalise_lanes((JoxVector){-normal.y - inwards.x, normal.x - inwards.y});
}

void JOX_WIDE(jox_steer_orbit)(JoxSteer *s) {
    const JoxInts begin = ji_set((int32_t)s->begin), end = ji_set((int32_t)s->end);
    for (uint32_t n = s->begin / JOX_WIDTH * JOX_WIDTH; n < s->end; n += JOX_WIDTH) {
        const JoxInts number = ji_add(ji_set((int32_t)n), ji_lane());
        const JoxMask asked = jm_without(ji_less(number, end), ji_less(number, begin));
        JoxVector way = {jf_set(0.0f), jf_set(0.0f)};
        if (s->place)
            way = find_orbit_ways(s, ji_load(s->index + n));
        jv_store(s->way_x, s->way_y, n, jv_select(asked, way, jv_load(s->way_x, s->way_y, n)));
    }
}

/* Does the same as jox_steer_arrive, for agents with `arrives` set. */
void JOX_WIDE(jox_steer_arrive)(JoxSteer *s) {
    const JoxAgents *a = s->agents;
    const JoxFloats zero = jf_set(0.0f), one = jf_set(1.0f);
    for (uint32_t n = 0; n < s->count; n += JOX_WIDTH) {
        const JoxInts at = ji_load(s->index + n);
        const JoxVector before = jv_load(s->way_x, s->way_y, n);
        const JoxVector way = jv_sub(jv_load(s->to_x, s->to_y, n), pick_vectors(a->x, a->y, at));
        const JoxFloats distance = jf_sqrt(square_lengths(way));
        const JoxFloats speed = jox_param_pick(a->param[JOX_PARAM_speed], at);
        JoxFloats share = jf_min(one, distance / (speed * JOX_SLOWING));
        share = jf_select(jf_lt(zero, speed), share, one);
        const JoxMask is_there = jf_lt(distance, jf_set(1e-4f));
        const JoxVector asked =
            jv_select(is_there, (JoxVector){zero, zero}, jv_scale(way, share / distance));
        const JoxMask arrives = ji_equal(ji_load(s->arrives + n), ji_set(-1));
        jv_store(s->way_x, s->way_y, n, jv_select(arrives, asked, before));
    }
}

void JOX_WIDE(jox_steer_add)(JoxSteer *s) {
    const JoxFloats zero = jf_set(0.0f), most = jf_set((float)JOX_MOST_WEIGHT);
    for (uint32_t n = 0; n < s->count; n += JOX_WIDTH) {
        const JoxFloats by = jf_load(s->by + n), size = jf_abs(by);
        const JoxVector way = jv_load(s->way_x, s->way_y, n), sum = jv_load(s->sum_x, s->sum_y, n);
        const JoxMask counts = jm_and(jf_lt(zero, size), jf_le(size, most));
        const JoxMask bounded = jf_le(square_lengths(way), jf_set(MOST_SHARE * MOST_SHARE));
        const JoxVector term = jv_scale(jv_select(bounded, way, (JoxVector){zero, zero}), by);
        jv_store(s->sum_x, s->sum_y, n, jv_select(counts, jv_add(sum, term), sum));
    }
}

void JOX_WIDE(jox_steer_finish)(JoxSteer *s) {
    JoxAgents *a = s->agents;
    for (uint32_t n = 0; n < s->count; n += JOX_WIDTH) {
        const JoxInts at = ji_load(s->index + n);
        JoxVector sum = jv_load(s->sum_x, s->sum_y, n);
        sum = jv_select(jf_lt(jf_set(1.0f), square_lengths(sum)), normalise_lanes(sum), sum);
        const JoxFloats speed = jf_min(jox_param_pick(a->param[JOX_PARAM_speed], at),
                                       jox_param_pick(a->param[JOX_PARAM_max_speed], at));
        jv_store(s->way_x, s->way_y, n, jv_scale(sum, speed));
    }
    for (uint32_t n = 0; n < s->count; n++) {
        a->pref_x[s->index[n]] = s->way_x[n];
        a->pref_y[s->index[n]] = s->way_y[n];
    }
}

void JOX_WIDE(jox_steer_face)(JoxSteer *s) {
    JoxAgents *a = s->agents;
    for (uint32_t n = 0; n < s->count; n += JOX_WIDTH) {
        const JoxInts at = ji_load(s->index + n);
        const JoxVector velocity = pick_vectors(a->vx, a->vy, at);
        const JoxFloats wanted = square_lengths(pick_vectors(a->pref_x, a->pref_y, at));
        const JoxMask stands = jf_lt(wanted, jf_set((float)(JOX_STANDS * JOX_STANDS)));
        const JoxMask is_fast = jf_lt(jf_set(MOVES), square_lengths(velocity));
        const uint32_t moves = jm_bits(jm_without(is_fast, stands));
        jv_store(s->way_x, s->way_y, n, normalise_lanes(velocity));
        for (uint32_t lane = 0; lane < JOX_WIDTH && n + lane < s->count; lane++) {
            if (!(moves >> lane & 1))
                continue;
            a->face_x[s->index[n + lane]] = s->way_x[n + lane];
            a->face_y[s->index[n + lane]] = s->way_y[n + lane];
        }
    }
}
