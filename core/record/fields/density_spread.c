/* The kernel without walls: the Gaussian, first along x, then along y, in strips of rows. Results
   along x are kept for as many rows as the Gaussian reaches. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "record/fields/density_kernels.h"
#include "record/fields/density_parts.h"

#define X(name, isa) [isa] = {jox_density_find_nonzero_##name, jox_density_sum_##name},
static const struct Kernels {
    JoxDensityNonzeroKernel *find_nonzero;
    JoxDensitySumKernel *sum;
} KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

enum {
    MOST_TAPS = 2 * JOX_DENSITY_MOST_REACH + 1,
    STRIP_CELLS = 1 << 18 /* cells of one field in a strip, so that it fits into the cache */
};

float jox_density_variance(const JoxDensity *d) {
    float wide = d->kernel / d->cell;
    return jox_maxf(wide * wide - 1.0f / 6.0f, 0.0f);
}

/* The Gaussian along one axis, from -reach to reach; the sum is 1. */
typedef struct Taps {
    int reach, count;
    float values[MOST_TAPS];
} Taps;

/* Tabulates the Gaussian of the variance that remains, over three standard deviations. */
static void tabulate_taps(const JoxDensity *d, Taps *taps) {
    double v = jox_density_variance(d), sum = 0.0;
    const int reach = taps->reach =
        (int)jox_clampf(3.0f * sqrtf((float)v) + 1.0f, 1.0f, JOX_DENSITY_MOST_REACH);
    float *middle = taps->values + reach;
    taps->count = 2 * reach + 1;
    for (int k = 0; k <= reach; k++) {
        middle[k] = v > 0.0 ? (float)jox_exp(-0.5 * k * k / v) : (k == 0);
        sum += (k ? 2.0 : 1.0) * middle[k];
    }
    for (int k = 0; k <= reach; k++)
        middle[k] = middle[-k] = middle[k] / (float)sum;
}

/* ---- non-zero columns ---- */

static float *strip_row(const JoxDensity *d, int field, int row) {
    return d->work.mass[field] + (size_t)(row - d->work.first) * (size_t)d->wide;
}

/* Zeros add exactly nothing to a sum, so columns without a mark are skipped. */

/* Returns the marks of a row of the strip. */
static uint64_t mark_row(const JoxDensity *d, int field, int row) {
    JoxDensityNonzeroKernel *const find_nonzero = KERNELS[jox_isa_resolve(d->isa)].find_nonzero;
    const float *cells = strip_row(d, field, row);
    uint64_t marks = 0;
    for (int c = 0; c < d->wide; c += 64) {
        uint64_t nonzero = find_nonzero(cells + c, d->wide - c < 64 ? d->wide - c : 64);
        while (nonzero) {
            const int first = __builtin_ctzll(nonzero), beyond = ((first >> d->stretch) + 1)
                                                                 << d->stretch;
            marks |= UINT64_C(1) << ((c + first) >> d->stretch);
            nonzero = beyond < 64 ? nonzero & ~UINT64_C(0) << beyond : 0;
        }
    }
    return marks;
}

/* Takes the first group of adjacent marks out of `marks` and sets the columns from..to that it
   covers. Returns false if there are no marks. */
static bool take_marked_span(const JoxDensity *d, uint64_t *marks, int *from, int *to) {
    if (!*marks)
        return false;
    const int first = __builtin_ctzll(*marks);
    const uint64_t beyond = ~(*marks >> first);
    const int count = beyond ? __builtin_ctzll(beyond) : 64;
    const int end = (first + count) << d->stretch;
    *from = first << d->stretch;
    *to = (end < d->wide ? end : d->wide) - 1;
    *marks &= first + count < 64 ? ~UINT64_C(0) << (first + count) : 0;
    return true;
}

/* Returns the marks of columns from..to. */
static uint64_t mark_columns(const JoxDensity *d, int from, int to) {
    const int first = from >> d->stretch, last = to >> d->stretch;
    return (~UINT64_C(0) >> (63 - last)) & (~UINT64_C(0) << first);
}

/* Returns the marks of all columns within `reach` of a mark. */
static uint64_t widen_marks(const JoxDensity *d, uint64_t marks, int reach) {
    uint64_t about = 0;
    for (int from, to; take_marked_span(d, &marks, &from, &to);)
        about |= mark_columns(d, from > reach ? from - reach : 0,
                              to + reach < d->wide ? to + reach : d->wide - 1);
    return about;
}

/* Takes the next columns that are read out of `marks`: `count` columns from `from` on, counted
   without the edge. Returns false if there are none. */
static bool take_read_span(const JoxDensity *d, uint64_t *marks, int *from, int *count) {
    for (int first, last; take_marked_span(d, marks, &first, &last);) {
        *from = first > d->edge ? first - d->edge : 0;
        *count = (last - d->edge < (int)d->columns ? last - d->edge + 1 : (int)d->columns) - *from;
        if (*count > 0)
            return true;
    }
    return false;
}

/* ---- rows ---- */

static float *x_row(const JoxDensity *d, const Taps *taps, int field, int row) {
    return d->work.lines[field] + (size_t)(row % taps->count) * d->columns;
}

/* Convolves a row of the strip along x, at marked columns. */
static void convolve_along_x(JoxDensity *d, const Taps *taps, int field, int row, uint64_t marks,
                             JoxDensitySumKernel *sum) {
    const float *in = strip_row(d, field, row);
    float *out = x_row(d, taps, field, row);
    const float *from[MOST_TAPS];
    memset(out, 0, d->columns * sizeof *out);
    for (int first, count; take_read_span(d, &marks, &first, &count);) {
        for (int k = 0; k < taps->count; k++)
            from[k] = in + d->edge + first + taps->reach - k;
        sum(from, taps->values, taps->count, 1.0f, out + first, count);
    }
}

/* Convolves along y to get an output row. */
static void convolve_along_y(const JoxDensity *d, const Taps *taps, int field, int row, float *out,
                             JoxDensitySumKernel *sum) {
    const float per = 1.0f / (d->cell * d->cell);
    const uint64_t *marks = d->work.marks;
    uint64_t any = 0;
    memset(out, 0, d->columns * sizeof *out);
    for (int r = row - taps->reach; r <= row + taps->reach; r++)
        any |= marks[r];
    for (int first, count; take_read_span(d, &any, &first, &count);) {
        const uint64_t here = mark_columns(d, d->edge + first, d->edge + first + count - 1);
        const float *from[MOST_TAPS];
        float values[MOST_TAPS];
        int rows = 0;
        for (int k = 0; k < taps->count; k++) {
            const int r = row - taps->reach + k;
            if (!(marks[r] & here))
                continue;
            from[rows] = x_row(d, taps, field, r) + first;
            values[rows++] = taps->values[k];
        }
        sum(from, values, rows, per, out + first, count);
    }
}

/* Convolves row `row` along x, then along y the row whose neighbours are complete by now. */
static void spread_row(JoxDensity *d, const Taps *taps, int row, float *const *out) {
    JoxDensitySumKernel *const sum = KERNELS[jox_isa_resolve(d->isa)].sum;
    const int done = row - taps->reach; /* the last row whose neighbours along y are complete */
    const int read = done - d->edge;
    uint64_t marks = 0;
    for (int f = 0; f < d->work.fields; f++)
        marks |= mark_row(d, f, row);
    marks = d->work.marks[row] = widen_marks(d, marks, taps->reach);
    for (int f = 0; f < d->work.fields && marks; f++)
        convolve_along_x(d, taps, f, row, marks, sum);
    for (int f = 0; f < d->work.fields && read >= 0 && read < (int)d->rows; f++)
        convolve_along_y(d, taps, f, done, out[f] + (size_t)read * d->columns, sum);
}

void jox_density_spread(JoxDensity *d, const JoxDensityCrowd *crowd, int fields,
                        float *const *out) {
    JoxDensityWork *w = &d->work;
    const int rows = jox_density_clamp_index((double)STRIP_CELLS / d->wide, d->high - 1) + 1;
    Taps taps;
    tabulate_taps(d, &taps);
    JOX_ASSERT(taps.reach < d->edge);
    if (!w->marks)
        w->marks = jox_alloc((size_t)d->high, sizeof *w->marks);
    for (int f = 0; f < fields; f++)
        if (!w->lines[f])
            w->lines[f] = jox_alloc((size_t)taps.count * d->columns, sizeof(float));
    for (int first = 0; first < d->high; first += rows) {
        jox_density_clear_strip(d, fields, first, first + rows < d->high ? first + rows : d->high);
        jox_density_put_crowd(d, crowd);
        for (int row = first; row < w->end; row++)
            spread_row(d, &taps, row, out);
    }
}
