/* Lattices over areas, and points thrown at random. */
#include "geom/fill.h"

#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/random.h"

/* Points of a lattice inside the area, row by row; the caller frees them. */
static uint32_t lattice(const JoxArea *area, const JoxAreaIndex *index, bool hex, double step,
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

/* ---- at random ---- */

static const float BODY = 0.4f; /* m: the breadth of most people; who fits stands so far apart */
/* Of the width of the square that each has: points so far apart still find room when they are
   thrown at random, one after the other, as they cover 38 % of the area and jam at 54.7 %. */
static const double LOOSE = 0.7;
/* Throws in a row, for each point that is there and each time that the area goes into its extent,
   after which there is no more room; times that points close up. */
enum { IN_VAIN = 100, CLOSER = 80 };
/* Throws in all for one group, whatever is asked for: a bound on the time that a narrow area takes,
   most of whose extent lies outside of it. */
static const uint64_t MOST_THROWS = 20000000;

/* One point of a cell, at INFINITY where there is none, and a list of the others, of which there
   are few: cells are hardly wider than points are apart. */
typedef struct Cell {
    JoxV2 first;
    uint32_t others; /* UINT32_MAX: none */
} Cell;

/* Points that are there, by cells as wide as they are apart. */
typedef struct Thrown {
    JoxV2 *points;
    uint32_t count, capacity;
    Cell *cells;
    uint32_t *next; /* of each point in its cell's list */
    uint32_t columns, rows, next_capacity;
    JoxV2 low, period; /* period 0: the area's ends are not joined */
    float cell, apart;
} Thrown;

/* Distance along one axis, the shorter way where its ends are joined. */
static float between(float a, float b, float period) {
    const float d = fabsf(a - b);
    return period > 0.0f ? jox_minf(d, fabsf(period - d)) : d;
}

static uint32_t cell_of(const Thrown *t, float at, float low, uint32_t most) {
    const float cell = floorf((at - low) / t->cell);
    return cell <= 0.0f ? 0 : cell >= (float)most ? most - 1 : (uint32_t)cell;
}

static bool is_close(const Thrown *t, JoxV2 a, JoxV2 b) {
    const float dx = between(a.x, b.x, t->period.x), dy = between(a.y, b.y, t->period.y);
    return dx * dx + dy * dy < t->apart * t->apart;
}

static bool is_near_in(const Thrown *t, uint32_t column, uint32_t row, JoxV2 p) {
    const Cell *cell = &t->cells[row * t->columns + column];
    if (is_close(t, cell->first, p))
        return true;
    for (uint32_t i = cell->others; i != UINT32_MAX; i = t->next[i])
        if (is_close(t, t->points[i], p))
            return true;
    return false;
}

/* Whether one that is there is nearer than they are apart. Joined ends are looked at from both. */
static bool is_near(const Thrown *t, JoxV2 p) {
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
                        is_near_in(t, (uint32_t)column, (uint32_t)row, p))
                        return true;
        }
    return false;
}

static void put(Thrown *t, JoxV2 p) {
    JOX_RESERVE(t->points, t->capacity, t->count + 1);
    JOX_RESERVE(t->next, t->next_capacity, t->count + 1);
    JOX_ASSERT(t->count < t->capacity && t->count < t->next_capacity);
    Cell *cell = &t->cells[cell_of(t, p.y, t->low.y, t->rows) * t->columns +
                           cell_of(t, p.x, t->low.x, t->columns)];
    t->points[t->count] = p;
    if (cell->first.x < INFINITY) {
        t->next[t->count] = cell->others;
        cell->others = t->count;
    } else {
        cell->first = p;
    }
    t->count++;
}

/* Sorts what is there, and others who stand there already, by cells for points `apart`. */
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
        put(t, t->points[i]);
}

/* Points are drawn so many throws ahead, and the cells about them fetched into the caches
   meanwhile: of a large area each is somewhere else in memory. */
enum { DRAWN_AHEAD = 8 };
typedef struct Draws {
    uint64_t seed;
    uint32_t stream, round;
    JoxV2 high;
    JoxV2 drawn[DRAWN_AHEAD];
} Draws;

static void draw(Draws *draws, const Thrown *t, uint32_t n) {
    const uint32_t number = draws->round * 16;
    const double u = jox_random_unit(draws->seed, n, draws->stream, JOX_DRAW_FILL, number);
    const double v = jox_random_unit(draws->seed, n, draws->stream, JOX_DRAW_FILL, number + 1);
    const JoxV2 low = t->low, high = draws->high;
    const JoxV2 p = {(float)(low.x + ((double)high.x - low.x) * u),
                     (float)(low.y + ((double)high.y - low.y) * v)};
    const uint32_t column = cell_of(t, p.x, low.x, t->columns);
    const uint32_t row = cell_of(t, p.y, low.y, t->rows);
    for (uint32_t r = row > 0 ? row - 1 : 0; r <= row + 1 && r < t->rows; r++)
        __builtin_prefetch(&t->cells[r * t->columns + column]);
    draws->drawn[n % DRAWN_AHEAD] = p;
}

/* Throws until `whole` points are there, `patience` throws in a row, times those there, found no
   room, or *left throws are made. */
static void throw_points(const JoxAreaIndex *index, Thrown *t, JoxV2 high, uint32_t whole,
                         double patience, uint64_t seed, uint32_t stream, uint32_t round,
                         uint64_t *left) {
    double missed = 0;
    Draws draws = {seed, stream, round, high, {{0.0f, 0.0f}}};
    for (uint32_t n = 0; n < DRAWN_AHEAD; n++)
        draw(&draws, t, n);
    for (uint32_t n = 0; t->count < whole && missed < patience * (t->count + 100.0) && *left > 0;
         n++, --*left) {
        const JoxV2 p = draws.drawn[n % DRAWN_AHEAD];
        draw(&draws, t, n + DRAWN_AHEAD);
        missed++;
        if (is_near(t, p) || !jox_area_contains(index, p))
            continue;
        put(t, p);
        missed = 0;
    }
}

/* Random sequential placement. Where no spacing is asked for, points that find no room close up;
   those that stand already stay. */
static uint32_t at_random(const JoxArea *area, const JoxAreaIndex *index, uint32_t count,
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

/* ---- lattices, and all ---- */

static uint32_t on_lattice(const JoxArea *area, const JoxAreaIndex *index, bool hex, uint32_t count,
                           float spacing, uint64_t seed, uint32_t stream, JoxV2 **positions) {
    double step = spacing;
    if (!(step > 0) && count > 0)
        step = sqrt(jox_area_size(area) / count * (hex ? 1.1547005383792515 : 1.0));
    double apart = step;
    uint32_t have = lattice(area, index, hex, apart, positions);
    /* A border may cost a row, and few points may all miss a narrow area: close up until the count
       fits. A spacing that was asked for is kept, but by one agent, who has nobody to keep it from.
     */
    JoxV2 low, high;
    bool closes =
        (!(spacing > 0) || (count == 1 && have == 0)) && jox_area_extent(area, &low, &high);
    double finest = closes ? jox_area_sampling(low, high) : 0;
    for (int i = 0; have < count && closes && (i < 40 || apart > finest); i++) {
        jox_free(*positions);
        apart *= 0.985;
        have = lattice(area, index, hex, apart, positions);
    }
    JoxV2 *p = *positions;
    JOX_ASSERT(have == 0 || p);
    if (have <= count)
        return have;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < have && kept < count; i++) {
        /* Selection sampling: each point with the share still wanted of those still to come. */
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
                        ? at_random(area, index, count, spacing, seed, stream, positions)
                        : on_lattice(area, index, mode == JOX_FILL_HEX, count, spacing, seed,
                                     stream, positions);
    jox_area_index_free(index);
    return have;
}
