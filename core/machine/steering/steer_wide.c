/* The kernel of prefer: a lane is an agent of a batch. */
#include "agents/param_lanes.h"
#include "base/assert.h"
#include "machine/kernels.h"
#include "simd/vectors.h"

/* Of the wanted speed: a term that asks for more, or for what is no number, is left out. Above what
   the words allow (drift). */
#define MOST_SHARE 1e6f
#define MOVES 0.0025f /* m2/s2: who is slower keeps looking where it looked */

static inline JoxVector pick(const float *x, const float *y, JoxInts at) {
    return (JoxVector){jf_pick(x, at), jf_pick(y, at)};
}

static inline JoxFloats length2(JoxVector a) {
    return jv_dot(a, a);
}

/* jox_unit: zero stays zero. */
static inline JoxVector unit(JoxVector a) {
    const JoxFloats zero = jf_set(0.0f), length = jf_sqrt(length2(a));
    return jv_select(jf_lt(zero, length), jv_scale(a, 1.0f / length), (JoxVector){zero, zero});
}

static inline JoxFloats clamp(JoxFloats x, float low, float high) {
    return jf_min(jf_max(x, jf_set(low)), jf_set(high));
}

/* jox_segment_nearest */
static inline JoxVector nearest_on_axis(const JoxPlace *place, JoxVector p) {
    const JoxV2 a = place->axis_a, ab = jox_sub(place->axis_b, a);
    const float l2 = jox_length2(ab);
    const JoxVector start = {jf_set(a.x), jf_set(a.y)}, way = {jf_set(ab.x), jf_set(ab.y)};
    if (!(l2 > 0.0f))
        return start;
    const JoxVector from = {p.x - start.x, p.y - start.y};
    return jv_add(start, jv_scale(way, clamp(jv_dot(from, way) / l2, 0.0f, 1.0f)));
}

/* Round a solid, counter-clockwise: T - w N with N outward from the stadium about it. The inward
   weight w makes the density follow a profile that falls from the wall outwards. */
static JoxVector orbit(const JoxSteer *s, JoxInts at) {
    const JoxAgents *a = s->agents;
    const double *o = s->args;
    const float near = (float)o[JOX_ORBIT_DENSITY_NEAR], far = (float)o[JOX_ORBIT_DENSITY_FAR];
    const JoxVector p = pick(a->x, a->y, at), axis = nearest_on_axis(s->place, p);
    const JoxVector out = {p.x - axis.x, p.y - axis.y};
    const JoxFloats distance = jf_sqrt(length2(out)) - s->place->axis_radius;
    const JoxVector normal = unit(out);
    const JoxFloats share = clamp(distance / (float)o[JOX_ORBIT_FAR], 0.0f, 1.0f);
    const JoxFloats wanted = near + (far - near) * share;
    const JoxFloats lacks = clamp(wanted - jf_pick(a->density, at), -0.1f, 1.0f);
    JoxFloats inward = (float)o[JOX_ORBIT_INWARD] * lacks;
    inward = jf_select(jf_lt(jf_set((float)o[JOX_ORBIT_RETURN]), distance), jf_set(0.6f), inward);
    const JoxVector inwards = jv_scale(normal, inward);
    return unit((JoxVector){-normal.y - inwards.x, normal.x - inwards.y});
}

void JOX_WIDE(jox_steer_orbit)(JoxSteer *s) {
    const JoxInts begin = ji_set((int32_t)s->begin), end = ji_set((int32_t)s->end);
    for (uint32_t n = s->begin / JOX_WIDTH * JOX_WIDTH; n < s->end; n += JOX_WIDTH) {
        const JoxInts number = ji_add(ji_set((int32_t)n), ji_lane());
        const JoxMask asked = jm_without(ji_less(number, end), ji_less(number, begin));
        JoxVector way = {jf_set(0.0f), jf_set(0.0f)};
        if (s->place)
            way = orbit(s, ji_load(s->index + n));
        jv_store(s->way_x, s->way_y, n, jv_select(asked, way, jv_load(s->way_x, s->way_y, n)));
    }
}

/* jox_steer_arrive */
void JOX_WIDE(jox_steer_arrive)(JoxSteer *s) {
    const JoxAgents *a = s->agents;
    const JoxFloats zero = jf_set(0.0f), one = jf_set(1.0f);
    for (uint32_t n = 0; n < s->count; n += JOX_WIDTH) {
        const JoxInts at = ji_load(s->index + n);
        const JoxVector before = jv_load(s->way_x, s->way_y, n);
        const JoxVector way = jv_sub(jv_load(s->to_x, s->to_y, n), pick(a->x, a->y, at));
        const JoxFloats distance = jf_sqrt(length2(way));
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
        const JoxMask bounded = jf_le(length2(way), jf_set(MOST_SHARE * MOST_SHARE));
        const JoxVector term = jv_scale(jv_select(bounded, way, (JoxVector){zero, zero}), by);
        jv_store(s->sum_x, s->sum_y, n, jv_select(counts, jv_add(sum, term), sum));
    }
}

void JOX_WIDE(jox_steer_finish)(JoxSteer *s) {
    JoxAgents *a = s->agents;
    for (uint32_t n = 0; n < s->count; n += JOX_WIDTH) {
        const JoxInts at = ji_load(s->index + n);
        JoxVector sum = jv_load(s->sum_x, s->sum_y, n);
        sum = jv_select(jf_lt(jf_set(1.0f), length2(sum)), unit(sum), sum);
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
        const JoxVector velocity = pick(a->vx, a->vy, at);
        const uint32_t moves = jm_bits(jf_lt(jf_set(MOVES), length2(velocity)));
        jv_store(s->way_x, s->way_y, n, unit(velocity));
        for (uint32_t lane = 0; lane < JOX_WIDTH && n + lane < s->count; lane++) {
            if (!(moves >> lane & 1))
                continue;
            a->face_x[s->index[n + lane]] = s->way_x[n + lane];
            a->face_y[s->index[n + lane]] = s->way_y[n + lane];
        }
    }
}
