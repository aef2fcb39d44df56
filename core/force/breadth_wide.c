/* The kernel of breadth: the radius at which people touch. Plain loops over the lanes of a packet,
   of numbers alone and without a branch, which the compiler makes vector operations of. */
#include <string.h>

#include "agents/param_lanes.h"
#include "base/number/bits.h"
#include "base/number/random.h"
#include "force/kernels.h"
#include "simd/lanes.h"

static const double TURNING = 1.0;   /* s */
static const double WHOLE = 0x1p+52; /* a number of doubles: those above it are whole */

/* The greatest whole number up to x, which is 0 at least and much less than WHOLE. */
static inline double floor_of(double x) {
    const double nearest = (x + WHOLE) - WHOLE;
    return nearest - (nearest > x ? 1.0 : 0.0);
}

/* The first 24 bits of a draw, as a share. */
static inline float share_of(uint64_t draw) {
    return (float)(jox_double_of(draw >> 40 | jox_double_bits(WHOLE)) - WHOLE) * 0x1p-24f;
}

/* The moments of the random values about a time: of the last at a whole second before it, and of
   those after. Whose phase is ahead by nearly a second is between the second of them and the third,
   or where that is rounded up, between the third and the last. */
typedef struct Moments {
    double base;
    uint64_t knots[4];
} Moments;

static Moments moments_about(double time) {
    Moments m = {.base = floor_of(time)};
    for (int k = 0; k < 4; k++)
        m.knots[k] = jox_random_moment(
            jox_double_bits(m.base + (double)k + WHOLE) - jox_double_bits(WHOLE), JOX_DRAW_TURN);
    return m;
}

/* Who wants to get on among others turns a shoulder to them, now more and now less: a share of
   `turn` that goes evenly from one random value to the next within TURNING seconds, a pure function
   of id and time. */
static inline float breadth(uint64_t stream, const Moments *m, uint32_t id, double time,
                            float radius, float turn) {
    const double own = (double)id * 0.6180339887498949; /* nobody turns in step with others */
    const double phase = time + (own - floor_of(own)), floored = floor_of(phase);
    const double ahead = floored - m->base;
    const uint64_t from = ahead == 0.0 ? m->knots[0] : ahead == 1.0 ? m->knots[1] : m->knots[2];
    const uint64_t to = ahead == 0.0 ? m->knots[1] : ahead == 1.0 ? m->knots[2] : m->knots[3];
    const float first = share_of(jox_random_of(stream, id, 0, from));
    const float second = share_of(jox_random_of(stream, id, 0, to));
    return radius * (1.0f - turn * (first + (second - first) * (float)(phase - floored)));
}

void JOX_WIDE(jox_breadth_packets)(const JoxForces *f, uint32_t begin, uint32_t end) {
    const JoxAgents *a = f->step.agents;
    const uint64_t stream = jox_random_stream(f->step.seed);
    const double time = f->step.time / TURNING;
    const Moments moments = moments_about(time);
    const JoxFloats least2 = jf_set(JOX_STANDS * JOX_STANDS), zero = jf_set(0.0f);
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        const JoxFloats x = jf_load(a->pref_x + i), y = jf_load(a->pref_y + i);
        const JoxMask stands = jf_lt(x * x + y * y, least2);
        const JoxFloats turn = f->step.turning ? jox_param_lanes(a, JOX_PARAM_turn, i) : zero;
        float out[JOX_WIDTH], turned[JOX_WIDTH];
        jf_store(turned, jf_select(stands, zero, turn)); /* who stands does not turn */
        for (int lane = 0; lane < JOX_WIDTH; lane++)
            out[lane] = breadth(stream, &moments, a->id[i + lane], time,
                                jox_param(a, JOX_PARAM_radius, i + lane), turned[lane]);
        memcpy(a->breadth + i, out, sizeof out);
    }
}
