/* The kernel within walls: diffusion by steps from node to node, as in finite volumes. In a step
   the share l of the difference of two nodes' densities goes over each whole side between them. So
   what one loses the other gets, what is even stays even, and the variance along each axis grows by
   2 l cells2. */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "record/fields/density_kernels.h"
#include "record/fields/density_parts.h"

#define X(name, isa) [isa] = {jox_density_step_mixed_##name, jox_density_step_plain_##name},
static const struct {
    JoxDensityStepKernel *mixed, *plain;
} STEP[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

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

/* Columns and rows, the last included. */
typedef struct Box {
    int left, low, right, top;
} Box;

/* One step over the given cells. Those without nodes are zero and stay so. */
static void step(const JoxDensity *d, float share, const float *from, float *to, Box box) {
    const JoxDensityFloor *f = d->floor;
    JoxDensityStepKernel *const mixed = STEP[jox_isa_resolve(d->isa)].mixed;
    JoxDensityStepKernel *const plain = STEP[jox_isa_resolve(d->isa)].plain;
    for (int row = box.low; row <= box.top; row++) {
        const size_t line = at(d, 0, row);
        const JoxDensityStep s = {.share = share,
                                  .wide = d->wide,
                                  .u = from + line,
                                  .open_x = f->open_x + line,
                                  .open_y = f->open_y + line,
                                  .per = f->per + line};
        for (uint32_t r = f->run_first[row]; r < f->run_first[row + 1]; r++) {
            const struct JoxDensityRun *run = &f->runs[r];
            const int first = run->from > box.left ? run->from : box.left;
            const int end = run->to < box.right + 1 ? run->to : box.right + 1;
            (run->plain ? plain : mixed)(&s, first, end, to + line);
        }
    }
    for (uint32_t s = 0; s < f->slant_count; s++) {
        const uint32_t a = f->slants[s].a, b = f->slants[s].b;
        const float moved = share * f->slants[s].open * (from[b] - from[a]);
        to[a] += f->per[a] * moved;
        to[b] -= f->per[b] * moved;
    }
}

/* The cells in which there may be anything; false: none. */
static bool box_of(const JoxDensity *d, Box *box) {
    uint64_t all = 0;
    *box = (Box){.low = d->high, .top = -1};
    for (int row = 0; row < d->high; row++) {
        all |= d->work.marks[row];
        if (d->work.marks[row] && row < box->low)
            box->low = row;
        if (d->work.marks[row])
            box->top = row;
    }
    if (!all)
        return false;
    box->left = __builtin_ctzll(all) << d->stretch;
    box->right = ((64 - __builtin_clzll(all)) << d->stretch) - 1;
    return true;
}

/* With `by` more at every side, of cells that have some on all sides. */
static Box grown(const JoxDensity *d, Box box, int by) {
    return (Box){box.left - by > 1 ? box.left - by : 1, box.low - by > 1 ? box.low - by : 1,
                 box.right + by < d->wide - 2 ? box.right + by : d->wide - 2,
                 box.top + by < d->high - 2 ? box.top + by : d->high - 2};
}

void jox_density_diffuse(JoxDensity *d, int field) {
    JoxDensityWork *w = &d->work;
    const float whole = 0.5f * jox_density_variance(d);
    const int steps = (int)ceilf(whole / JOX_DENSITY_SHARE);
    Box box;
    if (!box_of(d, &box))
        return;
    if (!w->spare)
        w->spare = jox_alloc((size_t)d->wide * (size_t)d->high, sizeof *w->spare);
    memset(w->spare, 0, (size_t)d->wide * (size_t)d->high * sizeof *w->spare);
    for (int row = box.low; row <= box.top; row++)
        for (int c = box.left; c <= box.right && c < d->wide; c++)
            w->mass[field][at(d, c, row)] *= d->floor->per[at(d, c, row)];
    for (int s = 1; s <= steps; s++) { /* as far as a slant reaches */
        step(d, whole / (float)steps, w->mass[field], w->spare, grown(d, box, 2 * s));
        float *swap = w->mass[field];
        w->mass[field] = w->spare;
        w->spare = swap;
    }
}
