/* The kernel of breadth, the radius at which agents touch. Plain loops over the lanes of a packet,
   without branches or calls, which compilers vectorise. */
#include <string.h>

#include "agents/param_lanes.h"
#include "base/number/bits.h"
#include "base/number/random.h"
#include "force/stages/kernels.h"
#include "simd/vectors.h"

static const double TURN_INTERVAL = 1.0; /* s between the random values of an agent */
static const double TWO_TO_52 = 0x1p+52; /* doubles from this on are whole numbers */

/* Returns the greatest whole number up to x, for 0 <= x, far below TWO_TO_52. */
static inline double floor_small(double x) {
    const double nearest = (x + TWO_TO_52) - TWO_TO_52;
    return nearest - (nearest > x ? 1.0 : 0.0);
}

/* Maps the first 24 bits of a draw to 0 ... 1. */
static inline float map_to_share(uint64_t draw) {
    return (float)(jox_double_of(draw >> 40 | jox_double_bits(TWO_TO_52)) - TWO_TO_52) * 0x1p-24f;
}

/* Moments of the random values around a time, in units of TURN_INTERVAL: `base` is the last whole
   one, and knots[k] is the moment of base + k. An agent's phase is up to one unit ahead, so that it
   may need the second and third knot, or, where that rounds up, the third and fourth. */
typedef struct Moments {
    double base;
    uint64_t knots[4];
} Moments;

static Moments find_moments(double time) {
    Moments m = {.base = floor_small(time)};
    for (int k = 0; k < 4; k++)
        m.knots[k] = jox_random_moment(jox_double_bits(m.base + (double)k + TWO_TO_52) -
                                           jox_double_bits(TWO_TO_52),
                                       JOX_DRAW_TURN);
    return m;
}

/* Returns the breadth of an agent that wants to get on among others, m. It turns a shoulder to them
   by a share of `turn`, which runs linearly from one random value to the next within TURN_INTERVAL
   seconds: a pure function of id and time. */
static inline float compute_breadth(uint64_t stream, const Moments *m, uint32_t id, double time,
                                    float radius, float turn) {
    const double own =
        (double)id * 0.6180339887498949; /* agents do not turn in step with each other */
    const double phase = time + (own - floor_small(own)), floored = floor_small(phase);
    const double ahead = floored - m->base;
    const uint64_t from = ahead == 0.0 ? m->knots[0] : ahead == 1.0 ? m->knots[1] : m->knots[2];
    const uint64_t to = ahead == 0.0 ? m->knots[1] : ahead == 1.0 ? m->knots[2] : m->knots[3];
    const float first = map_to_share(jox_random_of(stream, id, 0, from));
    const float second = map_to_share(jox_random_of(stream, id, 0, to));
    return radius * (1.0f - turn * (first + (second - first) * (float)(phase - floored)));
}

void JOX_WIDE(jox_breadth_packets)(const JoxForces *f, uint32_t begin, uint32_t end) {
    const JoxAgents *a = f->step.agents;
    const uint64_t stream = jox_random_stream(f->step.timing.seed);
    const double time = f->step.timing.time / TURN_INTERVAL;
    const Moments moments = find_moments(time);
    const JoxFloats least2 = jf_set(JOX_STANDS * JOX_STANDS), zero = jf_set(0.0f);
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        const JoxFloats x = jf_load(a->pref_x + i), y = jf_load(a->pref_y + i);
        const JoxVector axis = jv_load(a->axis_x, a->axis_y, i);
        const JoxMask is_long = jf_lt(zero, jv_dot(axis, axis));
        const JoxMask stands = jm_or(is_long, jf_lt(x * x + y * y, least2));
        const JoxFloats turn = f->in.turning ? jox_param_lanes(a, JOX_PARAM_turn, i) : zero;
        float out[JOX_WIDTH], turned[JOX_WIDTH];
        jf_store(turned, jf_select(stands, zero, turn)); /* agents that stand do not turn */
        for (int lane = 0; lane < JOX_WIDTH; lane++)
            out[lane] = compute_breadth(stream, &moments, a->id[i + lane], time,
                                        a->contact_radius[i + lane], turned[lane]);
        memcpy(a->contact_radius + i, out, sizeof out);
    }
}
