/* The kernels of density: people between nodes, sums of rows, steps of diffusion. */
#include <math.h>
#include <string.h>

#include "record/fields/density_kernels.h"
#include "simd/lanes.h"

/* ---- people ---- */

/* Image k of the people of a packet; which of them are wanted. */
static JoxMask place_image(const JoxDensityAxis *axis, JoxFloats at, uint32_t k, size_t to,
                           JoxDensityPlaced *placed) {
    const float shift = ((float)k - 1.0f) * axis->period;
    const JoxFloats place =
        jf_div(jf_sub(jf_add(at, jf_set(shift)), jf_set(axis->low)), jf_set(axis->cell));
    const JoxFloats from_node = jf_sub(place, jf_set(0.5f));
    const JoxInts node = jf_to_ints(from_node); /* what is wanted lies above zero */
    ji_store(placed->node[k] + to, node);
    jf_store(placed->share[k] + to, jf_sub(from_node, ji_to_floats(node)));
    return jm_and(jf_le(jf_set(axis->first), place), jf_lt(place, jf_set(axis->end)));
}

static uint32_t place_packet(const JoxDensityAxis *axis, JoxFloats at, size_t to,
                             JoxDensityPlaced *placed) {
    const uint32_t from = axis->period > 0.0f ? 0 : 1, end = axis->period > 0.0f ? 3 : 2;
    JoxInts images = ji_set(0);
    uint32_t some = 0;
    for (uint32_t k = from; k < end; k++) {
        const JoxMask wanted = place_image(axis, at, k, to, placed);
        some |= jm_bits(wanted);
        images = ji_or(images, ji_select(wanted, ji_set(1 << k), ji_set(0)));
    }
    ji_store(placed->images + to, images);
    return some;
}

bool JOX_WIDE(jox_density_place)(const JoxDensityAxis *axis, const float *at, uint32_t count,
                                 JoxDensityPlaced *placed) {
    uint32_t some = 0, i = 0;
    for (; i + JOX_WIDTH <= count; i += JOX_WIDTH)
        some |= place_packet(axis, jf_load(at + i), i, placed);
    if (i < count) { /* what is not a number is wanted nowhere */
        float rest[JOX_WIDTH];
        for (uint32_t l = 0; l < JOX_WIDTH; l++)
            rest[l] = i + l < count ? at[i + l] : NAN;
        some |= place_packet(axis, jf_load(rest), i, placed);
    }
    return some != 0;
}

/* ---- sums of rows ---- */

enum { BLOCK = 4 }; /* packets whose sums are in registers at a time */

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
            sums[p] = jf_add(sums[p], jf_mul(tap, jf_load(row + p * JOX_WIDTH)));
    }
    JOX_UNROLL
    for (int p = 0; p < packets; p++)
        jf_store(out + at + p * JOX_WIDTH, jf_mul(sums[p], jf_set(scale)));
}

void JOX_WIDE(jox_density_sum)(const float *const *rows, const float *taps, int count, float scale,
                               float *out, int columns) {
    int at = 0;
    for (; at + BLOCK * JOX_WIDTH <= columns; at += BLOCK * JOX_WIDTH)
        sum_packets(rows, taps, count, scale, out, at, BLOCK);
    for (; at + JOX_WIDTH <= columns; at += JOX_WIDTH)
        sum_packets(rows, taps, count, scale, out, at, 1);
    if (at < columns && columns >= JOX_WIDTH) { /* some of them once more, as they are */
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

/* ---- steps: loops of which compilers make lanes ---- */

void JOX_WIDE(jox_density_step_mixed)(const JoxDensityStep *s, int from, int to,
                                      float *restrict out) {
    const float share = s->share, *u = s->u, *up = u + s->wide, *down = u - s->wide;
    const float *x = s->open_x, *y = s->open_y, *y_down = y - s->wide, *per = s->per;
    for (int c = from; c < to; c++)
        out[c] = u[c] + share * per[c] *
                            (x[c] * (u[c + 1] - u[c]) - x[c - 1] * (u[c] - u[c - 1]) +
                             y[c] * (up[c] - u[c]) - y_down[c] * (u[c] - down[c]));
}

/* The same, where all that is multiplied by is 1. */
void JOX_WIDE(jox_density_step_plain)(const JoxDensityStep *s, int from, int to,
                                      float *restrict out) {
    const float share = s->share, *u = s->u, *up = u + s->wide, *down = u - s->wide;
    for (int c = from; c < to; c++)
        out[c] = u[c] + share * ((u[c + 1] - u[c]) - (u[c] - u[c - 1]) + (up[c] - u[c]) -
                                 (u[c] - down[c]));
}
