/* Fills areas with agents: lattices, and random sequential placement. */
#include "geom/start_positions.h"

#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/random.h"

/* Lists the points of a lattice inside the area, row by row; the caller frees them. */
static uint32_t list_lattice(const JoxArea *area, const JoxAreaIndex *index, bool hex, double step,
                             JoxV2 **out) {
    JoxV2 low, high;
    *out = NULL;
    if (!jox_area_extent(area, &low, &high) || !(step > 0))
        return 0;
    double rise = hex ? step * 0.8660254037844386 : step;
    double nx = floor(((double)high.x - low.x) / step) + 2;
    double ny = floor(((double)high.y - low.y) / rise) + 1;
    uint32_t count = 0, capacity = 0;
    if (!(nx * ny <= 5e7))
        return 0;
    for (double j = 0; j < ny; j++)
        for (double i = 0; i < nx; i++) {
            double shift = hex && fmod(j, 2) > 0 ? 0 : 0.5;
            JoxV2 p = {(float)(low.x + (i + shift) * step), (float)(low.y + (j + 0.5) * rise)};
            if (!jox_area_contains(index, p))
                continue;
            JOX_RESERVE(*out, capacity, count + 1);
            JOX_ASSERT(count < capacity);
            (*out)[count++] = p;
        }
    return count;
}

/* ---- random placement ---- */

static const float BODY = 0.4f; /* m: spacing of random points if there is room: most people's
                                   diameter */
/* Spacing of random points, in widths of the square of floor that each has. Sequential placement
   then still finds room: the discs cover 38 % of the area, and jam at 54.7 %. */
static const double LOOSE = 0.7;
/* Consecutive misses after which there is no more room, per point and per ratio of bounding box to
   area; and how often the spacing is reduced. */
enum { IN_VAIN = 100, CLOSER = 80 };
/* Greatest number of trials for one group. It bounds the time for narrow areas, which fill only a
   small part of their bounding box. */
static const uint64_t MOST_THROWS = 20000000;

/* One point of a cell, INFINITY if it is empty, and a list of the others, which are few, as cells
   are hardly wider than the spacing. */
typedef struct Cell {
    JoxV2 first;
    uint32_t others; /* UINT32_MAX: none */
} Cell;

/* The points placed so far, in cells as wide as the spacing. */
typedef struct Thrown {
    JoxV2 *points;
    uint32_t count, capacity;
    Cell *cells;
    uint32_t *next; /* per point: next one in its cell's list */
    uint32_t columns, rows, next_capacity;
    JoxV2 low, period; /* period 0: edges of the area are not joined */
    float cell, apart;
} Thrown;

/* Returns the distance along one axis, m, across joined edges if that is shorter. */
static float measure_axis_gap(float a, float b, float period) {
    const float d = fabsf(a - b);
    return period > 0.0f ? jox_minf(d, fabsf(period - d)) : d;
}

static uint32_t find_axis_cell(const Thrown *t, float at, float low, uint32_t most) {
    const float cell = floorf((at - low) / t->cell);
    return cell <= 0.0f ? 0 : cell >= (float)most ? most - 1 : (uint32_t)cell;
}

static bool is_close(const Thrown *t, JoxV2 a, JoxV2 b) {
    const float dx = measure_axis_gap(a.x, b.x, t->period.x),
                dy = measure_axis_gap(a.y, b.y, t->period.y);
    return dx * dx + dy * dy < t->apart * t->apart;
}

static bool is_crowded_cell(const Thrown *t, uint32_t column, uint32_t row, JoxV2 p) {
    const Cell *cell = &t->cells[row * t->columns + column];
    if (is_close(t, cell->first, p))
        return true;
    for (uint32_t i = cell->others; i != UINT32_MAX; i = t->next[i])
        if (is_close(t, t->points[i], p))
            return true;
    return false;
}

/* Returns whether a placed point is nearer than the spacing, also across joined edges. */
static bool is_crowded(const Thrown *t, JoxV2 p) {
    for (int y = -1; y <= 1; y++)
        for (int x = -1; x <= 1; x++) {
            const JoxV2 image = {p.x + (float)x * t->period.x, p.y + (float)y * t->period.y};
            if ((x && !(t->period.x > 0.0f)) || (y && !(t->period.y > 0.0f)))
                continue;
            const float cx = floorf((image.x - t->low.x) / t->cell);
            const float cy = floorf((image.y - t->low.y) / t->cell);
            for (float row = cy - 1; row <= cy + 1; row++)
                for (float column = cx - 1; column <= cx + 1; column++)
                    if (row >= 0 && column >= 0 && row < (float)t->rows &&
                        column < (float)t->columns &&
                        is_crowded_cell(t, (uint32_t)column, (uint32_t)row, p))
                        return true;
        }
    return false;
}

static void place_point(Thrown *t, JoxV2 p) {
    JOX_RESERVE(t->points, t->capacity, t->count + 1);
    JOX_RESERVE(t->next, t->next_capacity, t->count + 1);
    JOX_ASSERT(t->count < t->capacity && t->count < t->next_capacity);
    Cell *cell = &t->cells[find_axis_cell(t, p.y, t->low.y, t->rows) * t->columns +
                           find_axis_cell(t, p.x, t->low.x, t->columns)];
    t->points[t->count] = p;
    if (cell->first.x < INFINITY) {
        t->next[t->count] = cell->others;
        cell->others = t->count;
    } else {
        cell->first = p;
    }
    t->count++;
}

/* Sorts the placed and the given points into cells for a spacing of `apart`. */
static void spread_cells(Thrown *t, JoxV2 low, JoxV2 high, double apart) {
    t->low = low;
    t->apart = (float)apart;
    t->cell = (float)fmax(apart, sqrt(((double)high.x - low.x) * ((double)high.y - low.y) / 4e6));
    t->columns = (uint32_t)(((double)high.x - low.x) / t->cell) + 1;
    t->rows = (uint32_t)(((double)high.y - low.y) / t->cell) + 1;
    jox_free(t->cells);
    t->cells = jox_alloc((size_t)t->columns * t->rows, sizeof *t->cells);
    for (size_t c = 0; c < (size_t)t->columns * t->rows; c++)
        t->cells[c] = (Cell){{INFINITY, INFINITY}, UINT32_MAX};
    const uint32_t count = t->count;
    t->count = 0;
    for (uint32_t i = 0; i < count; i++)
        place_point(t, t->points[i]);
}

/* Points are drawn this many trials ahead, and their cells prefetched meanwhile, since in a large
   area each lies elsewhere in memory. */
enum { DRAWN_AHEAD = 8 };
typedef struct Draws {
    uint64_t seed;
    uint32_t stream, round;
    JoxV2 high;
    JoxV2 drawn[DRAWN_AHEAD];
} Draws;

static void draw_trial(Draws *draws, const Thrown *t, uint32_t n) {
    const uint32_t number = draws->round * 16;
    const double u = jox_random_unit(draws->seed, n, draws->stream, JOX_DRAW_FILL, number);
    const double v = jox_random_unit(draws->seed, n, draws->stream, JOX_DRAW_FILL, number + 1);
    const JoxV2 low = t->low, high = draws->high;
    const JoxV2 p = {(float)(low.x + ((double)high.x - low.x) * u),
                     (float)(low.y + ((double)high.y - low.y) * v)};
    const uint32_t column = find_axis_cell(t, p.x, low.x, t->columns);
    const uint32_t row = find_axis_cell(t, p.y, low.y, t->rows);
    for (uint32_t r = row > 0 ? row - 1 : 0; r <= row + 1 && r < t->rows; r++)
        __builtin_prefetch(&t->cells[r * t->columns + column]);
    draws->drawn[n % DRAWN_AHEAD] = p;
}

/* Tries random points until `whole` are placed, `patience` times their number of trials failed in a
   row, or *left trials are used up. */
static void throw_points(const JoxAreaIndex *index, Thrown *t, JoxV2 high, uint32_t whole,
                         double patience, uint64_t seed, uint32_t stream, uint32_t round,
                         uint64_t *left) {
    double missed = 0;
    Draws draws = {seed, stream, round, high, {{0.0f, 0.0f}}};
    for (uint32_t n = 0; n < DRAWN_AHEAD; n++)
        draw_trial(&draws, t, n);
    for (uint32_t n = 0; t->count < whole && missed < patience * (t->count + 100.0) && *left > 0;
         n++, --*left) {
        const JoxV2 p = draws.drawn[n % DRAWN_AHEAD];
        draw_trial(&draws, t, n + DRAWN_AHEAD);
        missed++;
        if (is_crowded(t, p) || !jox_area_contains(index, p))
            continue;
        place_point(t, p);
        missed = 0;
    }
}

/* Random sequential placement. Without a given spacing, the spacing shrinks when points find no
   room; points that are placed already stay. */
static uint32_t fill_randomly(const JoxArea *area, const JoxAreaIndex *index, uint32_t count,
                              float spacing, uint64_t seed, uint32_t stream, JoxV2 **positions) {
    JoxV2 low, high;
    *positions = jox_alloc(count + 1, sizeof **positions);
    if (!jox_area_extent(area, &low, &high) || count == 0)
        return 0;
    const double size = fmax(jox_area_size(area), 1e-6),
                 whole = ((double)high.x - low.x) * ((double)high.y - low.y);
    const double patience = IN_VAIN * fmin(fmax(whole / size, 1.0), 1000.0);
    double apart = spacing > 0 ? spacing : fmin(BODY, LOOSE * sqrt(size / count));
    apart = fmax(apart, 1e-3);
    Thrown t = {.period = area->period};
    for (uint32_t i = 0; i < area->taken_count; i++) {
        JOX_RESERVE(t.points, t.capacity, t.count + 1);
        t.points[t.count++] = area->taken[i];
    }
    const uint32_t taken = t.count;
    uint64_t left = MOST_THROWS;
    for (uint32_t round = 0; round < CLOSER && t.count < taken + count && left > 0; round++) {
        spread_cells(&t, low, high, apart);
        throw_points(index, &t, high, taken + count, patience, seed, stream, round, &left);
        if (spacing > 0)
            break;
        apart *= 0.9;
    }
    const uint32_t have = t.count - taken;
    JOX_ASSERT(have <= count);
    for (uint32_t i = 0; i < have; i++)
        (*positions)[i] = t.points[taken + i];
    jox_free(t.points);
    jox_free(t.cells);
    jox_free(t.next);
    return have;
}

/* ---- lattices, and the choice between them ---- */

/* Fills an area with `count` points of a lattice; of more points, `count` are drawn. */
static uint32_t fill_lattice(const JoxArea *area, const JoxAreaIndex *index, bool hex,
                             uint32_t count, float spacing, uint64_t seed, uint32_t stream,
                             JoxV2 **positions) {
    double step = spacing;
    if (!(step > 0) && count > 0)
        step = sqrt(jox_area_size(area) / count * (hex ? 1.1547005383792515 : 1.0));
    double apart = step;
    uint32_t have = list_lattice(area, index, hex, apart, positions);
    /* A border may cost a row, and few points may all miss a narrow area: the lattice shrinks until
       the count fits. A given spacing is kept, except for a single agent, which has no
       neighbours. */
    JoxV2 low, high;
    bool closes =
        (!(spacing > 0) || (count == 1 && have == 0)) && jox_area_extent(area, &low, &high);
    double finest = closes ? jox_area_sampling(low, high) : 0;
    for (int i = 0; have < count && closes && (i < 40 || apart > finest); i++) {
        jox_free(*positions);
        apart *= 0.985;
        have = list_lattice(area, index, hex, apart, positions);
    }
    JoxV2 *p = *positions;
    JOX_ASSERT(have == 0 || p);
    if (have <= count)
        return have;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < have && kept < count; i++) {
        /* Selection sampling: keeps each point with probability wanted / remaining. */
        double u = jox_random_unit(seed, i, stream, JOX_DRAW_FILL, 0);
        if (u * (have - i) < count - kept)
            p[kept++] = p[i];
    }
    JOX_ASSERT(kept <= count && kept <= have);
    return kept;
}

uint32_t jox_fill(const JoxArea *area, JoxFillMode mode, uint32_t count, float spacing,
                  uint64_t seed, uint32_t stream, JoxV2 **positions) {
    JoxAreaIndex *index = jox_area_index(area);
    uint32_t have = mode == JOX_FILL_RANDOM
                        ? fill_randomly(area, index, count, spacing, seed, stream, positions)
                        : fill_lattice(area, index, mode == JOX_FILL_HEX, count, spacing, seed,
                                       stream, positions);
    jox_area_index_free(index);
    return have;
}
