#include "record/fields/density.h"

#include <math.h>
#include <string.h>

#include "base/elementary.h"
#include "base/mem.h"

enum { MOST_CELLS = 4000000, WIDEST = 256, SHIFTS = 16 };

/* The kernel along one axis of somebody who is at the share `inside` of a cell; sums to one over
   its cells. */
static void fill_kernel(const JoxDensity *d, float kernel, double inside, float *row) {
    int wide = 2 * d->reach + 1;
    double sum = 0.0;
    for (int k = 0; k < wide; k++) {
        double away = ((double)(k - d->reach) + 0.5 - inside) * d->cell;
        row[k] = (float)jox_exp(-away * away / (2.0 * kernel * kernel));
        sum += row[k];
    }
    for (int k = 0; k < wide; k++)
        row[k] /= (float)(sum * d->cell);
}

/* The kernel along one axis, for SHIFTS positions within a cell; the two-dimensional kernel is the
   product of two of these. */
static void tabulate(JoxDensity *d, float kernel) {
    d->reach = (int)jox_clampf(3.0f * kernel / d->cell, 1.0f, WIDEST);
    int wide = 2 * d->reach + 1;
    d->kernel = jox_alloc((size_t)SHIFTS * (size_t)wide, sizeof *d->kernel);
    for (int shift = 0; shift < SHIFTS; shift++)
        fill_kernel(d, kernel, (shift + 0.5) / SHIFTS, d->kernel + shift * wide);
    d->centred = jox_alloc((size_t)wide, sizeof *d->centred);
    fill_kernel(d, kernel, 0.5, d->centred);
}

/* The row of the table for a coordinate, and the first cell that it speaks of. */
static const float *factors(const JoxDensity *d, float at, int *first) {
    float cell = floorf(at / d->cell);
    int shift = (int)((at / d->cell - cell) * SHIFTS);
    *first = (int)cell - d->reach;
    return d->kernel + (shift < SHIFTS ? shift : SHIFTS - 1) * (2 * d->reach + 1);
}

void jox_density_spread(const JoxDensity *d, float *const *fields, const float *weights, int count,
                        float x, float y) {
    if (!(fabsf(x) < 1e6f && fabsf(y) < 1e6f))
        return;
    int column, row, wide = 2 * d->reach + 1, high = wide;
    const float *across = factors(d, x - d->low.x, &column), *up = factors(d, y - d->low.y, &row);
    int from = column < 0 ? -column : 0;
    int to = column + wide > (int)d->columns ? (int)d->columns - column : wide;
    for (int f = 0; f < count; f++)
        for (int r = 0; r < high; r++) {
            if (row + r < 0 || row + r >= (int)d->rows)
                continue;
            float *line = fields[f] + (size_t)(row + r) * d->columns, share = weights[f] * up[r];
            for (int c = from; c < to; c++)
                line[column + c] += share * across[c];
        }
}

JoxDensity *jox_density_create(JoxV2 low, JoxV2 high, float cell, float kernel) {
    JoxDensity *d = jox_alloc(1, sizeof *d);
    float width = jox_maxf(high.x - low.x, 1.0f), height = jox_maxf(high.y - low.y, 1.0f);
    d->low = low;
    d->cell = jox_maxf(cell, sqrtf(width * height / MOST_CELLS));
    d->columns = (uint32_t)ceilf(width / d->cell);
    d->rows = (uint32_t)ceilf(height / d->cell);
    d->now = jox_alloc((size_t)d->columns * d->rows, sizeof *d->now);
    d->sum = jox_alloc((size_t)d->columns * d->rows, sizeof *d->sum);
    tabulate(d, kernel);
    return d;
}

/* Spreads somebody along x in their row of `lines`. */
static void spread_line(const JoxDensity *d, float x, float y) {
    if (!(fabsf(x) < 1e6f && fabsf(y) < 1e6f))
        return;
    int column, line = (int)floorf((y - d->low.y) / d->cell) + d->reach;
    const float *across = factors(d, x - d->low.x, &column);
    int from = column < 0 ? 0 : column, to = column + 2 * d->reach + 1;
    to = to > (int)d->columns ? (int)d->columns : to;
    if (line < 0 || line >= (int)d->rows + 2 * d->reach || from >= to)
        return;
    float *cells = d->lines + (size_t)line * d->columns;
    for (int c = from; c < to; c++)
        cells[c] += across[c - column];
    d->from[line] = (uint32_t)from < d->from[line] ? (uint32_t)from : d->from[line];
    d->to[line] = (uint32_t)to > d->to[line] ? (uint32_t)to : d->to[line];
}

/* The frame's densities, of its lines. */
static void spread_rows(const JoxDensity *d) {
    memset(d->now, 0, (size_t)d->columns * d->rows * sizeof *d->now);
    for (uint32_t row = 0; row < d->rows; row++)
        for (int k = 0; k <= 2 * d->reach; k++) {
            const uint32_t line = row + (uint32_t)k;
            const float *from = d->lines + (size_t)line * d->columns;
            float *to = d->now + (size_t)row * d->columns, share = d->centred[k];
            for (uint32_t c = d->from[line]; c < d->to[line]; c++)
                to[c] += share * from[c];
        }
}

void jox_density_add(JoxDensity *d, const float *x, const float *y, uint32_t count, double t) {
    size_t cells = (size_t)d->columns * d->rows, lines = d->rows + 2 * (size_t)d->reach;
    if (!d->lines) { /* of those alone that are added to */
        d->lines = jox_alloc(lines * d->columns, sizeof *d->lines);
        d->from = jox_alloc(lines, sizeof *d->from);
        d->to = jox_alloc(lines, sizeof *d->to);
    }
    memset(d->lines, 0, lines * d->columns * sizeof *d->lines);
    memset(d->to, 0, lines * sizeof *d->to);
    for (size_t line = 0; line < lines; line++)
        d->from[line] = d->columns;
    for (uint32_t i = 0; i < count; i++)
        spread_line(d, x[i], y[i]);
    spread_rows(d);
    for (size_t c = 0; c < cells; c++) {
        d->sum[c] += d->now[c];
        if (d->now[c] > d->most) {
            d->most = d->now[c];
            d->most_time = t;
            d->most_at = (JoxV2){d->low.x + ((float)(c % d->columns) + 0.5f) * d->cell,
                                 d->low.y + ((float)(c / d->columns) + 0.5f) * d->cell};
        }
    }
    d->frames++;
}

double jox_density_mean(const JoxDensity *d, uint32_t column, uint32_t row) {
    return d->frames ? d->sum[(size_t)row * d->columns + column] / d->frames : 0.0;
}

void jox_density_free(JoxDensity *d) {
    if (!d)
        return;
    jox_free(d->now);
    jox_free(d->sum);
    jox_free(d->kernel);
    jox_free(d->centred);
    jox_free(d->lines);
    jox_free(d->from);
    jox_free(d->to);
    jox_free(d);
}
