/* The kernel within walls: explicit diffusion on the nodes, a finite-volume scheme. In a step, the
   flow between two nodes is the share l of the difference of their densities, times the open part
   of the side between them. So mass is conserved, an even density stays even, and the variance
   along each axis grows by 2 l cells2. */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "record/fields/density_kernels.h"
#include "record/fields/density_parts.h"

#define X(name, isa)                                                                               \
    [isa] = {jox_density_find_nonzero_##name, jox_density_reach_##name,                            \
             jox_density_step_mixed_##name, jox_density_step_plain_##name},
static const struct Kernels {
    JoxDensityNonzeroKernel *find_nonzero;
    JoxDensityReachKernel *reach;
    JoxDensityStepKernel *mixed, *plain;
} KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

static size_t cell_index(const JoxDensity *d, int column, int row) {
    return (size_t)row * (size_t)d->wide + (size_t)column;
}

/* ---- runs ---- */

typedef enum CellKind { NO_NODE, PLAIN, MIXED } CellKind;

static CellKind classify_cell(const JoxDensity *d, size_t cell) {
    const JoxDensityFloor *f = d->floor;
    const bool open = f->open_x[cell] == 1.0f && f->open_x[cell - 1] == 1.0f &&
                      f->open_y[cell] == 1.0f && f->open_y[cell - (size_t)d->wide] == 1.0f;
    return f->per[cell] == 0.0f ? NO_NODE : open && f->per[cell] == 1.0f ? PLAIN : MIXED;
}

/* Adds a run of cells of one kind. A short run joins the one before as MIXED: the mixed kernel is
   valid for every cell. */
static void add_cell_run(JoxDensityFloor *f, uint32_t first, int from, int to, CellKind kind) {
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

/* Lists runs of cells of one kind, so that a step uses the cheaper kernel where all ways are
   open. */
static void list_runs(JoxDensity *d) {
    JoxDensityFloor *f = d->floor;
    f->run_count = 0;
    for (int row = 0; row < d->high; row++) {
        const uint32_t first = f->run_first[row] = f->run_count;
        const bool inner = row > 0 && row < d->high - 1;
        for (int from = 1, to; inner && from < d->wide - 1; from = to) {
            const CellKind kind = classify_cell(d, cell_index(d, from, row));
            for (to = from + 1;
                 to < d->wide - 1 && classify_cell(d, cell_index(d, to, row)) == kind; to++)
                continue;
            add_cell_run(f, first, from, to, kind);
        }
    }
    f->run_first[d->high] = f->run_count;
}

/* ---- reachable cells ---- */

/* Sets of cells are bits of words, row by row. */

static size_t count_words(const JoxDensity *d) {
    return jox_density_words(d) * (size_t)d->high;
}

/* Sets the bits of cells with a way to the right and up. */
static void list_ways(JoxDensity *d) {
    JoxDensityFloor *f = d->floor;
    if (!f->right) {
        f->right = jox_alloc(count_words(d), sizeof *f->right);
        f->up = jox_alloc(count_words(d), sizeof *f->up);
    }
    memset(f->right, 0, count_words(d) * sizeof *f->right);
    memset(f->up, 0, count_words(d) * sizeof *f->up);
    for (int row = 0; row < d->high; row++)
        for (int c = 0; c < d->wide; c++) {
            if (f->open_x[cell_index(d, c, row)] > 0.0f)
                *jox_density_word(d, f->right, c, row) |= jox_density_bit(c);
            if (f->open_y[cell_index(d, c, row)] > 0.0f)
                *jox_density_word(d, f->up, c, row) |= jox_density_bit(c);
        }
}

void jox_density_list_floor(JoxDensity *d) {
    list_runs(d);
    list_ways(d);
}

static void spread_reached_cell(const JoxDensity *d, uint32_t from, uint32_t to, uint64_t *reached,
                                uint64_t *next) {
    const int wide = d->wide, column = (int)from % wide, row = (int)from / wide;
    if (*jox_density_word(d, reached, column, row) & jox_density_bit(column))
        *jox_density_word(d, next, (int)to % wide, (int)to / wide) |=
            jox_density_bit((int)to % wide);
}

/* Sets `next` to the cells of `reached` and their neighbours over open ways: a step moves mass no
   farther. */
static void spread_reached(const JoxDensity *d, uint64_t *reached, uint64_t *next) {
    const JoxDensityFloor *f = d->floor;
    const int row = (int)jox_density_words(d);
    KERNELS[jox_isa_resolve(d->isa)].reach(reached, f->right, f->up, row, row, row * (d->high - 1),
                                           next);
    for (uint32_t s = 0; s < f->slant_count; s++) {
        spread_reached_cell(d, f->slants[s].a, f->slants[s].b, reached, next);
        spread_reached_cell(d, f->slants[s].b, f->slants[s].a, reached, next);
    }
}

/* Returns the first column from `from` on whose group of eight columns has a bit set or, if all
   bits of `flip` are set, has none; `to` if there is none before `to`. Groups begin at multiples of
   eight. */
static int find_column_group(const uint64_t *row, int from, int to, uint64_t flip) {
    while (from < to) {
        uint64_t word = row[from / 64];
        word |= word >> 4 & UINT64_C(0x0f0f0f0f0f0f0f0f);
        word |= word >> 2 & UINT64_C(0x3333333333333333);
        word |= word >> 1 & UINT64_C(0x5555555555555555);
        word = (word & UINT64_C(0x0101010101010101)) * 255;
        word = (word ^ flip) >> (from % 64);
        if (word) {
            from += __builtin_ctzll(word);
            break;
        }
        from += 64 - from % 64;
    }
    return from < to ? from : to;
}

/* ---- spans ---- */

/* Adds the cells of a run at which `reached` has bits. All other cells are zero in both arrays that
   steps alternate between, and stay zero: sets of cells only grow. */
static void add_spans(JoxDensityWork *w, const struct JoxDensityRun *run, int row,
                      const uint64_t *reached) {
    const int low =
        run->plain ? run->from : 1; /* the mixed kernel is valid for cells outside its run, too */
    for (int end, c = find_column_group(reached, run->from, run->to, 0); c < run->to;
         c = find_column_group(reached, end, run->to, 0)) {
        end = find_column_group(reached, c, run->to, ~UINT64_C(0));
        JOX_RESERVE(w->spans, w->span_capacity, w->span_count + 1);
        w->spans[w->span_count++] = (struct JoxDensitySpan){row, low, c, end, run->plain};
    }
}

/* Lists the parts of all runs that a step must compute. */
static void list_spans(JoxDensity *d, uint64_t *reached) {
    const JoxDensityFloor *f = d->floor;
    d->work.span_count = 0;
    for (int row = 1; row < d->high - 1; row++) {
        const uint64_t *bits = jox_density_word(d, reached, 0, row);
        uint64_t any = 0;
        for (size_t k = 0; k < jox_density_words(d); k++)
            any |= bits[k];
        for (uint32_t r = f->run_first[row]; r < f->run_first[row + 1] && any; r++)
            add_spans(&d->work, &f->runs[r], row, bits);
    }
}

/* ---- steps ---- */

/* Takes one step from `from` to `to`, for all spans and slanted ways. */
static void step_spans(const JoxDensity *d, float share, const float *from, float *to) {
    const JoxDensityFloor *f = d->floor;
    const struct Kernels *kernels = &KERNELS[jox_isa_resolve(d->isa)];
    for (size_t k = 0; k < d->work.span_count; k++) {
        const struct JoxDensitySpan *span = &d->work.spans[k];
        const size_t line = cell_index(d, 0, span->row);
        const JoxDensityStep s = {.share = share,
                                  .wide = d->wide,
                                  .u = from + line,
                                  .open_x = f->open_x + line,
                                  .open_y = f->open_y + line,
                                  .per = f->per + line};
        (span->plain ? kernels->plain : kernels->mixed)(&s, span->low, span->from, span->to,
                                                        to + line);
    }
    for (uint32_t s = 0; s < f->slant_count; s++) {
        const uint32_t a = f->slants[s].a, b = f->slants[s].b;
        const float moved = share * f->slants[s].open * (from[b] - from[a]);
        to[a] += f->per[a] * moved;
        to[b] -= f->per[b] * moved;
    }
}

/* Turns masses into densities and sets `nonzero_cells` to the cells that are not zero. */
static void divide_by_area(JoxDensity *d, float *mass, uint64_t *nonzero_cells) {
    JoxDensityNonzeroKernel *const find_nonzero = KERNELS[jox_isa_resolve(d->isa)].find_nonzero;
    for (int row = 0; row < d->high; row++)
        for (int c = 0; c < d->wide; c += 64) {
            const int count = d->wide - c < 64 ? d->wide - c : 64;
            const float *per = d->floor->per + cell_index(d, c, row);
            float *cells = mass + cell_index(d, c, row);
            const uint64_t nonzero = find_nonzero(cells, count);
            *jox_density_word(d, nonzero_cells, c, row) = nonzero;
            for (int k = 0; k < count && nonzero; k++)
                cells[k] *= per[k];
        }
}

float *jox_density_scratch(JoxDensity *d) {
    if (!d->work.spare)
        d->work.spare = jox_alloc((size_t)d->wide * (size_t)d->high, sizeof *d->work.spare);
    return d->work.spare;
}

void jox_density_diffuse(JoxDensity *d, int field) {
    enum { LISTED = 8 }; /* number of steps that use the same list of spans */
    JoxDensityWork *w = &d->work;
    const size_t cells = (size_t)d->wide * (size_t)d->high;
    const float whole = 0.5f * jox_density_variance(d);
    const int steps = (int)ceilf(whole / JOX_DENSITY_SHARE);
    for (int k = 0; k < 2; k++)
        if (!w->reached[k])
            w->reached[k] = jox_alloc(count_words(d), sizeof *w->reached[k]);
    memset(jox_density_scratch(d), 0, cells * sizeof *w->spare);
    divide_by_area(d, w->mass[field], w->reached[0]);
    for (int s = 0; s < steps; s++) {
        if (s % LISTED == 0) {
            for (int k = s; k < s + LISTED && k < steps; k++)
                spread_reached(d, w->reached[k % 2], w->reached[(k + 1) % 2]);
            list_spans(d, w->reached[(s + LISTED < steps ? s + LISTED : steps) % 2]);
        }
        step_spans(d, whole / (float)steps, w->mass[field], w->spare);
        float *swap = w->mass[field];
        w->mass[field] = w->spare;
        w->spare = swap;
    }
}
