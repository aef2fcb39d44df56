/* Kernel of jox_field_crowd: spreads each person over the cells around it. The loops over a row of
   cells are vectorised by compilers, with the same bits on each instruction set. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "geom/field/field_parts.h"
#include "simd/lanes.h"

static const float REACH = 2.0f; /* m: radius of the cone over which a person is spread */

/* The cells over which a person is spread, inclusive. */
typedef struct Span {
    int c0, c1, r0, r1;
} Span;

/* Computes the shares of `count` cells in a row: 1 at the person, 0 from REACH on. */
static void share_row(const float *restrict x, const float *restrict y, const float *restrict open,
                      JoxV2 at, int count, float *restrict shares) {
    for (int k = 0; k < count; k++) {
        const float dx = x[k] - at.x, dy = y[k] - at.y;
        const float share = 1.0f - sqrtf(dx * dx + dy * dy) / REACH;
        shares[k] = share > 0.0f ? share * open[k] : 0.0f;
    }
}

/* Adds numbers in eight sums side by side, which compilers turn into lanes. */
static float sum_lanes(const float *restrict numbers, int count) {
    enum { SUMS = 8 };
    float sums[SUMS] = {0.0f};
    int k = 0;
    for (; k + SUMS <= count; k += SUMS)
        for (int s = 0; s < SUMS; s++)
            sums[s] += numbers[k + s];
    for (int s = 0; k < count; k++, s++)
        sums[s] += numbers[k];
    return ((sums[0] + sums[4]) + (sums[2] + sums[6])) +
           ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

/* Spreads a person as a cone over walkable cells, not into walls: else the floor along walls would
   seem free. `shares`: room for the span's cells. */
static void spread_person(JoxFieldWork *w, const float *open, const Span *s, JoxV2 at,
                          float slowing, float *shares) {
    const JoxField *f = w->f;
    const int columns = s->c1 - s->c0 + 1, cells = columns * (s->r1 - s->r0 + 1);
    float area = f->size * f->size, *share = shares;
    for (int r = s->r0; r <= s->r1; r++, share += columns) {
        const int first = r * f->columns + s->c0;
        share_row(w->walled.x + first, w->walled.y + first, open + first, at, columns, share);
    }
    const float sum = sum_lanes(shares, cells);
    if (!(sum > 0.0f))
        return;
    const float by = slowing / (sum * area);
    share = shares;
    for (int r = s->r0; r <= s->r1; r++, share += columns) {
        float *slowness = w->slowness + r * f->columns + s->c0;
        for (int k = 0; k < columns; k++)
            slowness[k] += by * share[k];
    }
}

void JOX_WIDE(jox_field_spread)(JoxFieldWork *w, const JoxFieldCrowd *crowd, const float *open) {
    const JoxField *f = w->f;
    float *shares = NULL;
    size_t capacity = 0;
    for (uint32_t n = 0; n < crowd->count; n++) {
        JoxV2 at = crowd->at[n];
        Span s;
        JOX_ASSERT(crowd->held[n] >= 0.0f && crowd->held[n] <= 1.0f);
        jox_field_span(at.x - REACH, at.x + REACH, f->low.x, f->size, f->columns, &s.c0, &s.c1);
        jox_field_span(at.y - REACH, at.y + REACH, f->low.y, f->size, f->rows, &s.r0, &s.r1);
        if (s.c0 > s.c1 || s.r0 > s.r1)
            continue;
        JOX_RESERVE(shares, capacity, (size_t)(s.c1 - s.c0 + 1) * (size_t)(s.r1 - s.r0 + 1));
        spread_person(w, open, &s, at, crowd->slowing * crowd->held[n], shares);
    }
    jox_free(shares);
}
