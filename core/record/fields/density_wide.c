/* Kernels of density_kernels.h: positions between nodes, sums of rows, and steps of diffusion. */
#include <math.h>
#include <string.h>

#include "record/fields/density_kernels.h"
#include "simd/lanes.h"

/* ---- people ---- */

/* Places image k of the people in a packet, and returns the mask of those wanted. */
static JoxMask place_image(const JoxDensityAxis *axis, JoxFloats at, uint32_t k, size_t to,
                           JoxDensityPlaced *placed) {
    const float shift = ((float)k - 1.0f) * axis->period;
    const JoxFloats place = (at + shift - axis->low) / axis->cell;
    const JoxFloats from_node = place - 0.5f;
    const JoxInts node = jf_to_ints(from_node); /* floor: wanted positions are positive */
    ji_store(placed->node[k] + to, node);
    jf_store(placed->share[k] + to, from_node - ji_to_floats(node));
    return jm_and(jf_le(jf_set(axis->first), place), jf_lt(place, jf_set(axis->end)));
}

/* Places all images of a packet of people. Returns whether any image is wanted. */
static uint32_t place_packet(const JoxDensityAxis *axis, JoxFloats at, size_t to,
                             JoxDensityPlaced *placed) {
    const uint32_t from = axis->period > 0.0f ? 0 : 1, end = axis->period > 0.0f ? 3 : 2;
    JoxInts images = ji_set(0);
    uint32_t nonzero = 0;
    for (uint32_t k = from; k < end; k++) {
        const JoxMask wanted = place_image(axis, at, k, to, placed);
        nonzero |= jm_bits(wanted);
        images = ji_or(images, ji_select(wanted, ji_set(1 << k), ji_set(0)));
    }
    ji_store(placed->images + to, images);
    return nonzero;
}

bool JOX_WIDE(jox_density_place)(const JoxDensityAxis *axis, const float *at, uint32_t count,
                                 JoxDensityPlaced *placed) {
    uint32_t nonzero = 0, i = 0;
    for (; i + JOX_WIDTH <= count; i += JOX_WIDTH)
        nonzero |= place_packet(axis, jf_load(at + i), i, placed);
    if (i < count) { /* unused lanes are NAN, which is never wanted */
        float rest[JOX_WIDTH];
        for (uint32_t l = 0; l < JOX_WIDTH; l++)
            rest[l] = i + l < count ? at[i + l] : NAN;
        nonzero |= place_packet(axis, jf_load(rest), i, placed);
    }
    return nonzero != 0;
}

uint64_t JOX_WIDE(jox_density_find_nonzero)(const float *cells, int count) {
    uint64_t nonzero = 0;
    int c = 0;
    for (; c + JOX_WIDTH <= count; c += JOX_WIDTH) {
        const JoxMask none = jf_le(jf_abs(jf_load(cells + c)), jf_set(0.0f));
        nonzero |= (uint64_t)(~jm_bits(none) & JOX_ALL_LANES) << c;
    }
    for (; c < count; c++)
        nonzero |= (uint64_t) !(fabsf(cells[c]) <= 0.0f) << c;
    return nonzero;
}

/* ---- sums of rows ---- */

enum { BLOCK = 4 }; /* packets whose sums are kept in registers */

/* Sums `packets` packets of columns from column `at` on over all rows. */
static inline void sum_packets(const float *const *rows, const float *taps, int count, float scale,
                               float *out, int at, int packets) {
    JoxFloats sums[BLOCK];
    JOX_UNROLL
    for (int p = 0; p < packets; p++)
        sums[p] = jf_set(0.0f);
    for (int k = 0; k < count; k++) {
        const float *row = rows[k] + at;
        const JoxFloats tap = jf_set(taps[k]);
        JOX_UNROLL
        for (int p = 0; p < packets; p++)
            sums[p] += tap * jf_load(row + p * JOX_WIDTH);
    }
    JOX_UNROLL
    for (int p = 0; p < packets; p++)
        jf_store(out + at + p * JOX_WIDTH, sums[p] * scale);
}

void JOX_WIDE(jox_density_sum)(const float *const *rows, const float *taps, int count, float scale,
                               float *out, int columns) {
    int at = 0;
    for (; at + BLOCK * JOX_WIDTH <= columns; at += BLOCK * JOX_WIDTH)
        sum_packets(rows, taps, count, scale, out, at, BLOCK);
    for (; at + JOX_WIDTH <= columns; at += JOX_WIDTH)
        sum_packets(rows, taps, count, scale, out, at, 1);
    if (at < columns && columns >= JOX_WIDTH) {
        /* The last packet overlaps the one before: it computes the same values again. */
        sum_packets(rows, taps, count, scale, out, columns - JOX_WIDTH, 1);
        return;
    }
    for (; at < columns; at++) {
        float sum = 0.0f;
        for (int k = 0; k < count; k++)
            sum += taps[k] * rows[k][at];
        out[at] = sum * scale;
    }
}

/* ---- steps ---- */

void JOX_WIDE(jox_density_reach)(const uint64_t *restrict reached, const uint64_t *restrict right,
                                 const uint64_t *restrict up, int row, int from, int to,
                                 uint64_t *restrict next) {
    for (int i = from; i < to; i++)
        next[i] = reached[i] | (reached[i] & right[i]) << 1 |
                  (reached[i - 1] & right[i - 1]) >> 63 |
                  ((reached[i] >> 1 | reached[i + 1] << 63) & right[i]) |
                  (reached[i - row] & up[i - row]) | (reached[i + row] & up[i]);
}

static inline void step_mixed_packet(const JoxDensityStep *s, int c, float *out) {
    const float *at = s->u + c, *x = s->open_x + c, *y = s->open_y + c;
    const JoxFloats u = jf_load(at), share = s->share * jf_load(s->per + c);
    const JoxFloats right = jf_load(x) * (jf_load(at + 1) - u);
    const JoxFloats left = jf_load(x - 1) * (u - jf_load(at - 1));
    const JoxFloats up = jf_load(y) * (jf_load(at + s->wide) - u);
    const JoxFloats down = jf_load(y - s->wide) * (u - jf_load(at - s->wide));
    const JoxFloats gained = right - left + up - down;
    jf_store(out + c, u + share * gained);
}

/* As step_mixed_packet, where all open widths and `per` are 1. */
static inline void step_plain_packet(const JoxDensityStep *s, int c, float *out) {
    const float *at = s->u + c;
    const JoxFloats u = jf_load(at);
    const JoxFloats right = jf_load(at + 1) - u, left = u - jf_load(at - 1);
    const JoxFloats up = jf_load(at + s->wide) - u;
    const JoxFloats down = u - jf_load(at - s->wide);
    const JoxFloats gained = right - left + up - down;
    jf_store(out + c, u + s->share * gained);
}

static void step_cell(const JoxDensityStep *s, int c, float *out) {
    const float *u = s->u + c, *x = s->open_x + c, *y = s->open_y + c;
    out[c] = *u + s->share * s->per[c] *
                      (x[0] * (u[1] - *u) - x[-1] * (*u - u[-1]) + y[0] * (u[s->wide] - *u) -
                       y[-s->wide] * (*u - u[-s->wide]));
}

/* Steps cells in packets. The last packet may overlap cells computed before, and computes the same
   values again. */
#define STEP(name, packet)                                                                         \
    void JOX_WIDE(name)(const JoxDensityStep *s, int low, int from, int to, float *out) {          \
        for (; from + JOX_WIDTH <= to; from += JOX_WIDTH)                                          \
            packet(s, from, out);                                                                  \
        if (from < to && to - JOX_WIDTH >= low) {                                                  \
            packet(s, to - JOX_WIDTH, out);                                                        \
            return;                                                                                \
        }                                                                                          \
        for (; from < to; from++)                                                                  \
            step_cell(s, from, out);                                                               \
    }
STEP(jox_density_step_mixed, step_mixed_packet)
STEP(jox_density_step_plain, step_plain_packet)
