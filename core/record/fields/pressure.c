/* Collects samples in four quarters of the span, and computes crowd pressure when a quarter is
   complete. */
#include "record/fields/pressure.h"

#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "base/vec.h"

enum { QUARTERS = 4 };
/* Least share of the whole variance that lies within a quarter of the span, if the flow is
   steady. */
static const float STEADY = 0.25f;
static const float NOBODY = 0.02f; /* 1/m2: at lower density a cell has no velocity */

/* Sums of a cell over the samples of a quarter. */
typedef struct Sums {
    float density, vx, vy, square;
} Sums;

struct JoxPressure {
    uint32_t columns, rows;
    size_t cells;
    float cell;            /* m */
    uint32_t *first, *end; /* rows of the block of each row; NULL: all are one block */
    /* Summed-area tables of pressures and of measured cells; one column and row more than the
       grid. */
    double *sum;
    uint32_t *count;
    Sums *quarters[QUARTERS]; /* the last one is being filled */
    float *now;
    int samples[QUARTERS], filled; /* samples in each quarter; number of complete quarters */
    double begun, last;            /* s: beginning of the last quarter; time of the last sample */
};

JoxPressure *jox_pressure_create(uint32_t columns, uint32_t rows, float cell) {
    JoxPressure *p = jox_alloc(1, sizeof *p);
    const size_t cells = (size_t)columns * rows, corners = ((size_t)columns + 1) * (rows + 1);
    p->columns = columns;
    p->rows = rows;
    p->cells = cells;
    p->cell = cell;
    p->sum = jox_alloc(corners, sizeof *p->sum);
    p->count = jox_alloc(corners, sizeof *p->count);
    for (int q = 0; q < QUARTERS; q++)
        p->quarters[q] = jox_alloc(cells, sizeof(Sums));
    p->now = jox_alloc(cells, sizeof *p->now);
    for (size_t c = 0; c < cells; c++)
        p->now[c] = NAN;
    p->last = NAN;
    return p;
}

void jox_pressure_set_blocks(JoxPressure *p, const uint32_t *first, const uint32_t *end) {
    p->first = jox_realloc(p->first, p->rows, sizeof *p->first);
    p->end = jox_realloc(p->end, p->rows, sizeof *p->end);
    memcpy(p->first, first, p->rows * sizeof *first);
    memcpy(p->end, end, p->rows * sizeof *end);
}

static void begin_quarter(JoxPressure *p, double t) {
    Sums *oldest = p->quarters[0];
    memmove(p->quarters, p->quarters + 1, (QUARTERS - 1) * sizeof *p->quarters);
    memmove(p->samples, p->samples + 1, (QUARTERS - 1) * sizeof *p->samples);
    p->quarters[QUARTERS - 1] = oldest;
    memset(oldest, 0, p->cells * sizeof *oldest);
    p->samples[QUARTERS - 1] = 0;
    p->begun = t;
}

/* Returns the second smallest of four values. */
static float find_second_least(const float v[QUARTERS]) {
    float least = jox_minf(v[0], v[1]), next = jox_maxf(v[0], v[1]);
    for (int q = 2; q < QUARTERS; q++) {
        next = jox_minf(next, jox_maxf(v[q], least));
        least = jox_minf(least, v[q]);
    }
    return next;
}

/* Returns the pressure of a cell over four complete quarters; NAN if it was too sparse or the
   flow was not steady. */
static float measure_cell_pressure(const JoxPressure *p, size_t c) {
    float density = 0.0f, vx = 0.0f, vy = 0.0f, square = 0.0f, within[QUARTERS];
    for (int q = 0; q < QUARTERS; q++) {
        const Sums *s = &p->quarters[q][c];
        const float n = (float)p->samples[q], x = s->vx / n, y = s->vy / n;
        if (s->density < JOX_PRESSURE_LEAST * n)
            return NAN;
        within[q] = s->square / n - x * x - y * y;
        density += s->density / n;
        vx += x;
        vy += y;
        square += s->square / n;
    }
    vx /= QUARTERS;
    vy /= QUARTERS;
    float variance = jox_maxf(square / QUARTERS - vx * vx - vy * vy, 0.0f);
    if (find_second_least(within) < STEADY * variance)
        return NAN;
    return density / QUARTERS * variance;
}

/* Builds the summed-area tables of pressures and of measured cells. */
static void build_sum_tables(JoxPressure *p) {
    const size_t wide = (size_t)p->columns + 1;
    for (uint32_t r = 0; r < p->rows; r++)
        for (uint32_t c = 0; c < p->columns; c++) {
            const float here = p->now[(size_t)r * p->columns + c];
            const size_t k = r * wide + c; /* corner at the lower left */
            p->sum[k + wide + 1] =
                p->sum[k + 1] + p->sum[k + wide] - p->sum[k] + (isnan(here) ? 0.0 : (double)here);
            p->count[k + wide + 1] =
                p->count[k + 1] + p->count[k + wide] - p->count[k] + !isnan(here);
        }
}

/* Replaces the pressure of each measured cell by the mean over the measured cells of the section
   around it. */
static void average_over_sections(JoxPressure *p) {
    const size_t wide = (size_t)p->columns + 1;
    const uint32_t half = (uint32_t)(0.5f * JOX_PRESSURE_SECTION / p->cell);
    const double enough = (double)JOX_PRESSURE_FLOOR / ((double)p->cell * p->cell);
    for (uint32_t r = 0; r < p->rows; r++)
        for (uint32_t c = 0; c < p->columns; c++) {
            float *here = &p->now[(size_t)r * p->columns + c];
            const uint32_t first = p->first ? p->first[r] : 0, end = p->end ? p->end[r] : p->rows;
            const size_t left = c > half ? c - half : 0, low = r > first + half ? r - half : first;
            const size_t right = c + half + 1 < p->columns ? c + half + 1 : p->columns;
            const size_t top = r + half + 1 < end ? r + half + 1 : end;
            const size_t a = top * wide + right, b = top * wide + left, d = low * wide + right;
            const size_t e = low * wide + left;
            const uint32_t count = p->count[a] - p->count[b] - p->count[d] + p->count[e];
            if (isnan(*here))
                continue;
            *here = count >= enough
                        ? (float)((p->sum[a] - p->sum[b] - p->sum[d] + p->sum[e]) / count)
                        : NAN;
        }
}

void jox_pressure_add(JoxPressure *p, double t, const float *density, const float *flow_x,
                      const float *flow_y) {
    const double quarter = JOX_PRESSURE_SPAN / QUARTERS;
    if (!(t > p->last && t - p->last <= 2.0 * JOX_PRESSURE_PACE)) {
        p->filled = 0;
        for (size_t c = 0; c < p->cells; c++)
            p->now[c] = NAN;
        begin_quarter(p, t);
    }
    p->last = t;
    Sums *sums = p->quarters[QUARTERS - 1];
    for (size_t c = 0; c < p->cells; c++) {
        if (density[c] < NOBODY)
            continue;
        float vx = flow_x[c] / density[c], vy = flow_y[c] / density[c];
        sums[c].density += density[c];
        sums[c].vx += vx;
        sums[c].vy += vy;
        sums[c].square += vx * vx + vy * vy;
    }
    p->samples[QUARTERS - 1]++;
    if (t - p->begun + JOX_PRESSURE_PACE < quarter - 1e-6)
        return;
    p->filled += p->filled < QUARTERS;
    for (size_t c = 0; c < p->cells; c++)
        p->now[c] = p->filled == QUARTERS ? measure_cell_pressure(p, c) : NAN;
    if (p->filled == QUARTERS) {
        build_sum_tables(p);
        average_over_sections(p);
    }
    begin_quarter(p, t + JOX_PRESSURE_PACE);
}

const float *jox_pressure_now(const JoxPressure *p) {
    return p->now;
}

void jox_pressure_sections(JoxPressure *p, JoxSections *s) {
    for (int q = 0; q < QUARTERS; q++)
        jox_section(s, "quarter", p->quarters[q], sizeof(Sums), p->cells);
    jox_section(s, "now", p->now, sizeof *p->now, p->cells);
    JOX_SECTION(s, "samples", p->samples);
    JOX_SECTION(s, "filled", p->filled);
    JOX_SECTION(s, "begun", p->begun);
    JOX_SECTION(s, "last", p->last);
}

void jox_pressure_free(JoxPressure *p) {
    if (!p)
        return;
    for (int q = 0; q < QUARTERS; q++)
        jox_free(p->quarters[q]);
    jox_free(p->first);
    jox_free(p->end);
    jox_free(p->now);
    jox_free(p->sum);
    jox_free(p->count);
    jox_free(p);
}
