/* The kernel where there are no walls: the Gaussian itself, along x and then along y, strip by
   strip of rows. What is along x is kept for as many rows as the Gaussian reaches over. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "record/fields/density_kernels.h"
#include "record/fields/density_parts.h"

#define X(name, isa) [isa] = {jox_density_held_##name, jox_density_sum_##name},
static const struct Kernels {
    JoxDensityHeldKernel *held;
    JoxDensitySumKernel *sum;
} KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

enum {
    MOST_TAPS = 2 * JOX_DENSITY_MOST_REACH + 1,
    STRIP_CELLS = 1 << 18 /* of a field at a time, which caches hold */
};

float jox_density_variance(const JoxDensity *d) {
    float wide = d->kernel / d->cell;
    return jox_maxf(wide * wide - 1.0f / 6.0f, 0.0f);
}

/* The Gaussian along one axis, from -reach to reach; its sum is one. */
typedef struct Taps {
    int reach, count;
    float values[MOST_TAPS];
} Taps;

static void tabulate(const JoxDensity *d, Taps *taps) {
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

/* ---- where there is something ---- */

static float *row_of(const JoxDensity *d, int field, int row) {
    return d->work.mass[field] + (size_t)(row - d->work.first) * (size_t)d->wide;
}

/* What is nothing adds nothing, to the bit, so that columns are passed over of which no mark is
   set. */

/* Of a row of the strip. */
static uint64_t marks_in(const JoxDensity *d, int field, int row) {
    JoxDensityHeldKernel *const look = KERNELS[jox_isa_resolve(d->isa)].held;
    const float *cells = row_of(d, field, row);
    uint64_t marks = 0;
    for (int c = 0; c < d->wide; c += 64) {
        uint64_t some = look(cells + c, d->wide - c < 64 ? d->wide - c : 64);
        while (some) {
            const int first = __builtin_ctzll(some), beyond = ((first >> d->stretch) + 1)
                                                              << d->stretch;
            marks |= UINT64_C(1) << ((c + first) >> d->stretch);
            some = beyond < 64 ? some & ~UINT64_C(0) << beyond : 0;
        }
    }
    return marks;
}

/* Takes the first stretches that stand side by side out of the marks: columns from..to. */
static bool next_span(const JoxDensity *d, uint64_t *marks, int *from, int *to) {
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

/* The marks of columns from..to. */
static uint64_t marks_of(const JoxDensity *d, int from, int to) {
    const int first = from >> d->stretch, last = to >> d->stretch;
    return (~UINT64_C(0) >> (63 - last)) & (~UINT64_C(0) << first);
}

/* The marks of all that lies within `reach` of what is marked. */
static uint64_t marks_about(const JoxDensity *d, uint64_t marks, int reach) {
    uint64_t about = 0;
    for (int from, to; next_span(d, &marks, &from, &to);)
        about |= marks_of(d, from > reach ? from - reach : 0,
                          to + reach < d->wide ? to + reach : d->wide - 1);
    return about;
}

/* The next span of columns that are read, counted from the first of them. */
static bool next_read(const JoxDensity *d, uint64_t *marks, int *from, int *count) {
    for (int first, last; next_span(d, marks, &first, &last);) {
        *from = first > d->edge ? first - d->edge : 0;
        *count = (last - d->edge < (int)d->columns ? last - d->edge + 1 : (int)d->columns) - *from;
        if (*count > 0)
            return true;
    }
    return false;
}

/* ---- rows ---- */

static float *line_of(const JoxDensity *d, const Taps *taps, int field, int row) {
    return d->work.lines[field] + (size_t)(row % taps->count) * d->columns;
}

/* A row of the strip along x, where `marks` has something of it. */
static void along_x(JoxDensity *d, const Taps *taps, int field, int row, uint64_t marks,
                    JoxDensitySumKernel *sum) {
    const float *in = row_of(d, field, row);
    float *out = line_of(d, taps, field, row);
    const float *from[MOST_TAPS];
    memset(out, 0, d->columns * sizeof *out);
    for (int first, count; next_read(d, &marks, &first, &count);) {
        for (int k = 0; k < taps->count; k++)
            from[k] = in + d->edge + first + taps->reach - k;
        sum(from, taps->values, taps->count, 1.0f, out + first, count);
    }
}

/* A row that is read, of those about it along y. */
static void along_y(const JoxDensity *d, const Taps *taps, int field, int row, float *out,
                    JoxDensitySumKernel *sum) {
    const float per = 1.0f / (d->cell * d->cell);
    const uint64_t *marks = d->work.marks;
    uint64_t any = 0;
    memset(out, 0, d->columns * sizeof *out);
    for (int r = row - taps->reach; r <= row + taps->reach; r++)
        any |= marks[r];
    for (int first, count; next_read(d, &any, &first, &count);) {
        const uint64_t here = marks_of(d, d->edge + first, d->edge + first + count - 1);
        const float *from[MOST_TAPS];
        float values[MOST_TAPS];
        int rows = 0;
        for (int k = 0; k < taps->count; k++) {
            const int r = row - taps->reach + k;
            if (!(marks[r] & here))
                continue;
            from[rows] = line_of(d, taps, field, r) + first;
            values[rows++] = taps->values[k];
        }
        sum(from, values, rows, per, out + first, count);
    }
}

static void spread_row(JoxDensity *d, const Taps *taps, int row, float *const *out) {
    JoxDensitySumKernel *const sum = KERNELS[jox_isa_resolve(d->isa)].sum;
    const int done = row - taps->reach; /* all that it is made of is there */
    const int read = done - d->edge;
    uint64_t marks = 0;
    for (int f = 0; f < d->work.fields; f++)
        marks |= marks_in(d, f, row);
    marks = d->work.marks[row] = marks_about(d, marks, taps->reach);
    for (int f = 0; f < d->work.fields && marks; f++)
        along_x(d, taps, f, row, marks, sum);
    for (int f = 0; f < d->work.fields && read >= 0 && read < (int)d->rows; f++)
        along_y(d, taps, f, done, out[f] + (size_t)read * d->columns, sum);
}

void jox_density_spread(JoxDensity *d, const JoxDensityCrowd *crowd, int fields,
                        float *const *out) {
    JoxDensityWork *w = &d->work;
    const int rows = jox_density_clamped((double)STRIP_CELLS / d->wide, d->high - 1) + 1;
    Taps taps;
    tabulate(d, &taps);
    JOX_ASSERT(taps.reach < d->edge);
    if (!w->marks)
        w->marks = jox_alloc((size_t)d->high, sizeof *w->marks);
    for (int f = 0; f < fields; f++)
        if (!w->lines[f])
            w->lines[f] = jox_alloc((size_t)taps.count * d->columns, sizeof(float));
    for (int first = 0; first < d->high; first += rows) {
        jox_density_strip(d, fields, first, first + rows < d->high ? first + rows : d->high);
        jox_density_put(d, crowd);
        for (int row = first; row < w->end; row++)
            spread_row(d, &taps, row, out);
    }
}
