/* The kernel. With walls: diffusion by steps from node to node, as in finite volumes. In a step the
   share l of the difference of two nodes' densities goes over each whole side between them. So what
   one loses the other gets, what is even stays even, and the variance along each axis grows by 2 l
   cells2. Without walls: the Gaussian itself, along x and then along y. Sharing somebody among the
   nodes around has added 1/6 cells2 already, in the mean over where one can stand. */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "base/number/elementary.h"
#include "record/fields/density_parts.h"

enum { MOST_TAPS = 512 };

/* Variance that is left to add, cells2. */
static float variance(const JoxDensity *d) {
    float wide = d->kernel / d->cell;
    return jox_maxf(wide * wide - 1.0f / 6.0f, 0.0f);
}

static size_t at(const JoxDensity *d, int column, int row) {
    return (size_t)row * (size_t)d->wide + (size_t)column;
}

/* ---- runs ---- */

typedef enum CellKind { NO_NODE, PLAIN, MIXED } CellKind;

static CellKind kind_of(const JoxDensity *d, size_t cell) {
    const JoxDensityFloor *f = d->floor;
    const bool open = f->open_x[cell] == 1.0f && f->open_x[cell - 1] == 1.0f &&
                      f->open_y[cell] == 1.0f && f->open_y[cell - (size_t)d->wide] == 1.0f;
    return f->per[cell] == 0.0f ? NO_NODE : open && f->per[cell] == 1.0f ? PLAIN : MIXED;
}

/* Short runs join those beside them, as what holds for any cell holds for theirs. */
static void add_run(JoxDensityFloor *f, uint32_t first, int from, int to, CellKind kind) {
    enum { SHORT = 8 };
    struct JoxDensityRun *last = f->run_count > first ? &f->runs[f->run_count - 1] : NULL;
    if (to - from < SHORT)
        kind = MIXED;
    if (kind == MIXED && last && !last->plain && last->to == from) {
        last->to = to;
    } else if (kind != NO_NODE) {
        JOX_RESERVE(f->runs, f->run_capacity, f->run_count + 1);
        f->runs[f->run_count++] = (struct JoxDensityRun){from, to, kind == PLAIN};
    }
}

void jox_density_list_runs(JoxDensity *d) {
    JoxDensityFloor *f = d->floor;
    f->run_count = 0;
    for (int row = 0; row < d->high; row++) {
        const uint32_t first = f->run_first[row] = f->run_count;
        const bool inner = row > 0 && row < d->high - 1;
        for (int from = 1, to; inner && from < d->wide - 1; from = to) {
            const CellKind kind = kind_of(d, at(d, from, row));
            for (to = from + 1; to < d->wide - 1 && kind_of(d, at(d, to, row)) == kind; to++)
                continue;
            add_run(f, first, from, to, kind);
        }
    }
    f->run_first[d->high] = f->run_count;
}

/* ---- steps ---- */

/* One step of cells from..to - 1 of a row. */
static void step_mixed(const JoxDensity *d, float share, const float *u, float *restrict out,
                       size_t line, int from, int to) {
    const JoxDensityFloor *f = d->floor;
    const float *up = u + d->wide, *down = u - d->wide;
    const float *x = f->open_x + line, *y = f->open_y + line, *y_down = y - d->wide;
    const float *per = f->per + line;
    for (int c = from; c < to; c++)
        out[c] = u[c] + share * per[c] *
                            (x[c] * (u[c + 1] - u[c]) - x[c - 1] * (u[c] - u[c - 1]) +
                             y[c] * (up[c] - u[c]) - y_down[c] * (u[c] - down[c]));
}

/* The same, where all that is multiplied by is 1. */
static void step_plain(const JoxDensity *d, float share, const float *u, float *restrict out,
                       int from, int to) {
    const float *up = u + d->wide, *down = u - d->wide;
    for (int c = from; c < to; c++)
        out[c] = u[c] + share * ((u[c + 1] - u[c]) - (u[c] - u[c - 1]) + (up[c] - u[c]) -
                                 (u[c] - down[c]));
}

/* One step over the given cells. Those without nodes are zero and stay so. */
static void step(const JoxDensity *d, float share, const float *from, float *to, const int box[4]) {
    const JoxDensityFloor *f = d->floor;
    for (int row = box[1]; row <= box[3]; row++) {
        const size_t line = at(d, 0, row);
        for (uint32_t r = f->run_first[row]; r < f->run_first[row + 1]; r++) {
            const struct JoxDensityRun *run = &f->runs[r];
            const int first = run->from > box[0] ? run->from : box[0];
            const int end = run->to < box[2] + 1 ? run->to : box[2] + 1;
            if (run->plain)
                step_plain(d, share, from + line, to + line, first, end);
            else
                step_mixed(d, share, from + line, to + line, line, first, end);
        }
    }
    for (uint32_t s = 0; s < f->slant_count; s++) {
        const uint32_t a = f->slants[s].a, b = f->slants[s].b;
        const float moved = share * f->slants[s].open * (from[b] - from[a]);
        to[a] += f->per[a] * moved;
        to[b] -= f->per[b] * moved;
    }
}

static int grown(int value, int by, int limit) {
    return by < 0 ? (value + by > limit ? value + by : limit)
                  : (value + by < limit ? value + by : limit);
}

static void diffuse(JoxDensity *d, int field) {
    float whole = 0.5f * variance(d);
    int steps = (int)ceilf(whole / JOX_DENSITY_SHARE);
    memset(d->spare, 0, (size_t)d->wide * (size_t)d->high * sizeof *d->spare);
    for (int row = d->from_y; row <= d->to_y; row++)
        for (int c = d->from_x; c <= d->to_x; c++)
            d->mass[field][at(d, c, row)] *= d->floor->per[at(d, c, row)];
    for (int s = 1; s <= steps; s++) {
        const int by = 2 * s; /* as far as a slant reaches */
        int box[4] = {grown(d->from_x, -by, 1), grown(d->from_y, -by, 1),
                      grown(d->to_x, by, d->wide - 2), grown(d->to_y, by, d->high - 2)};
        step(d, whole / (float)steps, d->mass[field], d->spare, box);
        float *swap = d->mass[field];
        d->mass[field] = d->spare;
        d->spare = swap;
    }
}

/* The Gaussian along one axis, by distance in cells; its sum over both sides is one. */
static int tabulate(const JoxDensity *d, float *taps) {
    double v = variance(d), sum = 0.0;
    int reach = (int)jox_clampf(3.0f * sqrtf((float)v) + 1.0f, 1.0f, MOST_TAPS - 1);
    for (int k = 0; k <= reach; k++) {
        taps[k] = v > 0.0 ? (float)jox_exp(-0.5 * k * k / v) : (k == 0);
        sum += (k ? 2.0 : 1.0) * taps[k];
    }
    for (int k = 0; k <= reach; k++)
        taps[k] /= (float)sum;
    return reach;
}

/* ---- where there is something ---- */

/* The columns of a row, in 64 stretches: a bit for each that may hold something. What is nothing
   adds nothing, to the bit, so the others are passed over. */
static int stretch_of(const JoxDensity *d) {
    return (d->wide + 63) / 64;
}

/* Marks the stretches of columns from..to. */
static uint64_t marks_of(const JoxDensity *d, int from, int to) {
    const int first = from / stretch_of(d), last = to / stretch_of(d);
    return (~0ull >> (63 - last)) & (~0ull << first);
}

/* Takes the first stretches that stand side by side out of the marks: columns from..to. */
static bool next_span(const JoxDensity *d, uint64_t *marks, int *from, int *to) {
    if (!*marks)
        return false;
    const int first = __builtin_ctzll(*marks);
    const uint64_t beyond = ~(*marks >> first);
    const int count = beyond ? __builtin_ctzll(beyond) : 64;
    *from = first * stretch_of(d);
    *to = (first + count) * stretch_of(d) - 1;
    *marks &= first + count < 64 ? ~0ull << (first + count) : 0;
    return true;
}

static uint64_t marks_of_row(const JoxDensity *d, const float *row, int from, int to) {
    const int wide = stretch_of(d);
    uint64_t marks = 0;
    for (int s = from / wide; s <= to / wide; s++) {
        const int end = (s + 1) * wide < d->wide ? (s + 1) * wide : d->wide;
        int some = 0;
        for (int c = s * wide; c < end; c++)
            some |= row[c] != 0.0f;
        marks |= (uint64_t)some << s;
    }
    return marks;
}

/* The marks of all that lies within `reach` of what is marked. */
static uint64_t marks_about(const JoxDensity *d, uint64_t marks, int reach) {
    uint64_t about = 0;
    for (int from, to; next_span(d, &marks, &from, &to);)
        about |= marks_of(d, grown(from, -reach, 0), grown(to, reach, d->wide - 1));
    return about;
}

/* out[c] += tap * in[c] for all that is marked, within low..high. */
static void add_marked(const JoxDensity *d, uint64_t marks, const float *in, float *restrict out,
                       float tap, int low, int high) {
    for (int from, to; next_span(d, &marks, &from, &to);) {
        const int first = from > low ? from : low, last = to < high ? to : high;
        for (int c = first; c <= last; c++)
            out[c] += tap * in[c];
    }
}

static void convolve(JoxDensity *d, int field) {
    float taps[MOST_TAPS];
    int reach = tabulate(d, taps), last = d->wide - 1, top = d->high - 1;
    int from = grown(d->from_x, -reach, 0), to = grown(d->to_x, reach, last);
    float *mass = d->mass[field];
    for (int row = d->from_y; row <= d->to_y; row++) {
        const float *in = mass + at(d, 0, row);
        float *out = d->spare + at(d, 0, row);
        const uint64_t marks = marks_of_row(d, in, d->from_x, d->to_x);
        memset(out + from, 0, (size_t)(to - from + 1) * sizeof *out);
        d->marks[row] = marks_about(d, marks, reach);
        for (int k = -reach; k <= reach; k++)
            add_marked(d, marks, in, out + k, taps[k < 0 ? -k : k],
                       d->from_x > from - k ? d->from_x : from - k,
                       d->to_x < to - k ? d->to_x : to - k);
    }
    for (int row = grown(d->from_y, -reach, 0); row <= grown(d->to_y, reach, top); row++) {
        float *out = mass + at(d, 0, row);
        memset(out + from, 0, (size_t)(to - from + 1) * sizeof *out);
        for (int k = -reach; k <= reach; k++)
            if (row + k >= d->from_y && row + k <= d->to_y)
                add_marked(d, d->marks[row + k], d->spare + at(d, 0, row + k), out,
                           taps[k < 0 ? -k : k], from, to);
    }
}

void jox_density_spread(JoxDensity *d, int field) {
    if (d->from_x > d->to_x)
        return;
    if (d->floor)
        diffuse(d, field);
    else
        convolve(d, field);
}
