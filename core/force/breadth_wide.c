/* The kernel of breadth: the radius at which people touch. Plain loops over the lanes of a packet,
   of numbers alone and without a branch, which the compiler makes vector operations of. */
#include <string.h>

#include "base/number/random.h"
#include "force/kernels.h"
#include "simd/lanes.h"

static const double TURNING = 1.0;   /* s */
static const double WHOLE = 0x1p+52; /* a number of doubles: those above it are whole */

static inline uint64_t bits_of(double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline double double_of(uint64_t bits) {
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* The greatest whole number up to x, which is 0 at least and much less than WHOLE. */
static inline double floor_of(double x) {
    const double nearest = (x + WHOLE) - WHOLE;
    return nearest - (nearest > x ? 1.0 : 0.0);
}

/* The first 24 bits of a draw, as a share. */
static inline float share_of(uint64_t draw) {
    return (float)(double_of(draw >> 40 | bits_of(WHOLE)) - WHOLE) * 0x1p-24f;
}

/* Who wants to get on among others turns a shoulder to them, now more and now less: a share of
   `turn` that goes evenly from one random value to the next within TURNING seconds, a pure function
   of id and time. */
static inline float breadth(uint64_t stream, uint32_t id, double time, float radius, float turn) {
    const double own = (double)id * 0.6180339887498949; /* nobody turns in step with others */
    const double phase = time + (own - floor_of(own)), floored = floor_of(phase);
    const uint64_t knot = bits_of(floored + WHOLE) - bits_of(WHOLE);
    const float first =
        share_of(jox_random_of(stream, id, 0, jox_random_moment(knot, JOX_DRAW_TURN)));
    const float second =
        share_of(jox_random_of(stream, id, 0, jox_random_moment(knot + 1, JOX_DRAW_TURN)));
    return radius * (1.0f - turn * (first + (second - first) * (float)(phase - floored)));
}

void JOX_WIDE(jox_breadth_packets)(const JoxForces *f, uint32_t begin, uint32_t end) {
    const JoxAgents *a = f->step.agents;
    const uint64_t stream = jox_random_stream(f->step.seed);
    const double time = f->step.time / TURNING;
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        const float *radius = a->param[JOX_PARAM_radius] + i, *x = a->pref_x + i;
        const float *turn = a->param[JOX_PARAM_turn] + i, *y = a->pref_y + i;
        float out[JOX_WIDTH], turned[JOX_WIDTH];
        for (int lane = 0; lane < JOX_WIDTH; lane++) /* who stands does not turn */
            turned[lane] = !f->step.turning || x[lane] * x[lane] + y[lane] * y[lane] <
                                                   (float)(JOX_STANDS * JOX_STANDS)
                               ? 0.0f
                               : turn[lane];
        for (int lane = 0; lane < JOX_WIDTH; lane++)
            out[lane] = breadth(stream, a->id[i + lane], time, radius[lane], turned[lane]);
        memcpy(a->breadth + i, out, sizeof out);
    }
}
