/* The floor that walls leave: the nodes of cells, where one can go from one to the next, and the area
   that belongs to each. */
#include <math.h>
#include <string.h>

#include "base/hash.h"
#include "base/mem.h"
#include "geom/polygon.h"
#include "record/fields/density_parts.h"

typedef struct JoxDensityBar Bar;
enum { FINE = 8 };                        /* points along each side of a cell by which it is judged */
static const double TOUCHES = 1e-9;       /* of a length: as near as that is on it */
static const float OFF = 0.02f;           /* of a cell: nodes are at least so far from walls */
static const float LEAST_AREA = 0.05f;    /* of a cell: what is less belongs to nobody */

/* A solid, so that one can ask what lies within. */
typedef struct Solid {
    JoxV2 *points, low, high;
    uint32_t count;
} Solid;

static JoxV2 corner(const JoxDensity *d) {
    return (JoxV2){d->low.x - (float)d->edge * d->cell, d->low.y - (float)d->edge * d->cell};
}
static int clamped(double value, int most) {
    return value < 0.0 ? 0 : value > most ? most : (int)value;
}

/* ---- which walls pass through which cells ---- */

/* Shows each cell that a bar passes through to the count of `first`, or with `fill` to the list. */
static void pass_through(JoxDensity *d, uint32_t bar, bool fill) {
    JoxDensityFloor *f = d->floor;
    const Bar *b = &f->bars[bar];
    const JoxV2 low = corner(d);
    const double h = d->cell, e = 1e-3;
    double ax = (b->ax - low.x) / h, ay = (b->ay - low.y) / h;
    double bx = (b->bx - low.x) / h, by = (b->by - low.y) / h;
    if (fmax(ax, bx) < -e || fmax(ay, by) < -e || fmin(ax, bx) > d->wide + e ||
        fmin(ay, by) > d->high + e)
        return;
    int last = clamped(fmax(ay, by) + e, d->high - 1);
    for (int row = clamped(fmin(ay, by) - e, d->high - 1); row <= last; row++) {
        double from = 0.0, to = 1.0; /* the stretch of the bar within the row */
        if (fabs(by - ay) > TOUCHES) {
            double s = (row - e - ay) / (by - ay), t = (row + 1 + e - ay) / (by - ay);
            from = fmax(from, fmin(s, t));
            to = fmin(to, fmax(s, t));
        }
        double x = ax + from * (bx - ax), y = ax + to * (bx - ax);
        if (from > to || fmax(x, y) < -e || fmin(x, y) > d->wide + e)
            continue;
        int right = clamped(fmax(x, y) + e, d->wide - 1);
        for (int c = clamped(fmin(x, y) - e, d->wide - 1); c <= right; c++) {
            uint32_t *n = &f->first[row * d->wide + c];
            if (fill)
                f->passing[--*n] = bar;
            else
                ++*n;
        }
    }
}

static void list_bars(JoxDensity *d, const JoxWalls *walls) {
    JoxDensityFloor *f = d->floor;
    const size_t cells = (size_t)d->wide * (size_t)d->high;
    f->bar_count = 0;
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        for (uint32_t v = ring->first; v < ring->first + ring->count && !ring->open; v++) {
            JoxV2 a = walls->vertices[v].point, b = walls->vertices[walls->vertices[v].next].point;
            JOX_RESERVE(f->bars, f->bar_capacity, f->bar_count + 1);
            f->bars[f->bar_count++] = (Bar){a.x, a.y, b.x, b.y};
        }
    }
    memset(f->first, 0, (cells + 1) * sizeof *f->first);
    for (uint32_t b = 0; b < f->bar_count; b++)
        pass_through(d, b, false);
    for (size_t c = 0; c < cells; c++) /* the ends of the cells' lists, which filling moves down */
        f->first[c + 1] += f->first[c];
    JOX_RESERVE(f->passing, f->passing_capacity, f->first[cells] + 1);
    for (uint32_t b = f->bar_count; b-- > 0;)
        pass_through(d, b, true);
}

static bool has_wall(const JoxDensityFloor *f, size_t cell) {
    return f->first[cell] < f->first[cell + 1];
}

/* Whether a-b touches a bar, of which a length of `slack` is nothing. */
static bool touches(const Bar *bar, double ax, double ay, double bx, double by) {
    double wx = bar->bx - bar->ax, wy = bar->by - bar->ay, px = bx - ax, py = by - ay;
    double a = wx * (ay - bar->ay) - wy * (ax - bar->ax);
    double b = wx * (by - bar->ay) - wy * (bx - bar->ax);
    double c = px * (bar->ay - ay) - py * (bar->ax - ax);
    double e = px * (bar->by - ay) - py * (bar->bx - ax);
    double slack = TOUCHES * (wx * wx + wy * wy + px * px + py * py);
    return !((a > slack && b > slack) || (a < -slack && b < -slack) || (c > slack && e > slack) ||
             (c < -slack && e < -slack));
}

bool jox_density_hidden(const JoxDensity *d, JoxV2 a, JoxV2 b) {
    const JoxDensityFloor *f = d->floor;
    const JoxV2 low = corner(d);
    double ax = (a.x - low.x) / d->cell, ay = (a.y - low.y) / d->cell;
    double bx = (b.x - low.x) / d->cell, by = (b.y - low.y) / d->cell;
    int right = clamped(fmax(ax, bx), d->wide - 1), above = clamped(fmax(ay, by), d->high - 1);
    for (int r = clamped(fmin(ay, by), d->high - 1); r <= above; r++)
        for (int c = clamped(fmin(ax, bx), d->wide - 1); c <= right; c++) {
            size_t cell = (size_t)r * (size_t)d->wide + (size_t)c;
            for (uint32_t k = f->first[cell]; k < f->first[cell + 1]; k++)
                if (touches(&f->bars[f->passing[k]], a.x, a.y, b.x, b.y))
                    return true;
        }
    return false;
}

/* ---- nodes ---- */

static bool within(const Solid *solids, uint32_t count, JoxV2 p) {
    for (uint32_t s = 0; s < count; s++)
        if (p.x >= solids[s].low.x && p.x <= solids[s].high.x && p.y >= solids[s].low.y &&
            p.y <= solids[s].high.y && jox_polygon_contains(solids[s].points, solids[s].count, p))
            return true;
    return false;
}

static JoxV2 fine_point(const JoxDensity *d, int column, int row, int k) {
    const JoxV2 low = corner(d);
    return jox_v2(low.x + ((float)column + ((float)(k % FINE) + 0.5f) / FINE) * d->cell,
                  low.y + ((float)row + ((float)(k / FINE) + 0.5f) / FINE) * d->cell);
}

/* Whether a node can stand at p: on the floor, and not on a wall. */
static bool stands(const JoxDensity *d, size_t cell, JoxV2 p, const Solid *solids, uint32_t count) {
    const JoxDensityFloor *f = d->floor;
    float off = OFF * d->cell;
    for (uint32_t k = f->first[cell]; k < f->first[cell + 1]; k++) {
        const Bar *b = &f->bars[f->passing[k]];
        JoxV2 from = {(float)b->ax, (float)b->ay}, to = {(float)b->bx, (float)b->by};
        if (jox_length2(jox_sub(jox_segment_nearest(from, to, p), p)) < off * off)
            return false;
    }
    return !within(solids, count, p);
}

/* The middle of each cell, or where that cannot be walked on the nearest point that can. `per` is 1
   where there is one. Cells without walls are as the one before them in their row. */
static void place_nodes(JoxDensity *d, const Solid *solids, uint32_t count) {
    JoxDensityFloor *f = d->floor;
    const JoxV2 low = corner(d);
    for (int row = 0; row < d->high; row++)
        for (int column = 0; column < d->wide; column++) {
            size_t cell = (size_t)row * (size_t)d->wide + (size_t)column;
            JoxV2 middle = {low.x + ((float)column + 0.5f) * d->cell,
                            low.y + ((float)row + 0.5f) * d->cell};
            f->node[cell] = middle;
            f->near[cell] = 0;
            if (!has_wall(f, cell) && column > 0 && !has_wall(f, cell - 1)) {
                f->per[cell] = f->per[cell - 1];
                continue;
            }
            f->per[cell] = stands(d, cell, middle, solids, count) ? 1.0f : 0.0f;
            float nearest = INFINITY;
            for (int k = 0; k < FINE * FINE && has_wall(f, cell) && f->per[cell] == 0.0f; k++) {
                JoxV2 p = fine_point(d, column, row, k);
                float away = jox_length2(jox_sub(p, middle));
                if (away < nearest && stands(d, cell, p, solids, count)) {
                    nearest = away;
                    f->node[cell] = p;
                }
            }
            if (nearest < INFINITY)
                f->per[cell] = 1.0f;
        }
}

/* Where one can go, and which cells' people have walls or solids between them and the nodes around. */
static void open_ways(JoxDensity *d) {
    JoxDensityFloor *f = d->floor;
    for (int row = 0; row < d->high; row++)
        for (int column = 0; column < d->wide; column++) {
            size_t cell = (size_t)row * (size_t)d->wide + (size_t)column;
            size_t right = cell + 1, above = cell + (size_t)d->wide;
            f->open_x[cell] = f->open_y[cell] = 0.0f;
            if (column + 1 < d->wide && f->per[cell] > 0.0f && f->per[right] > 0.0f)
                f->open_x[cell] = !jox_density_hidden(d, f->node[cell], f->node[right]);
            if (row + 1 < d->high && f->per[cell] > 0.0f && f->per[above] > 0.0f)
                f->open_y[cell] = !jox_density_hidden(d, f->node[cell], f->node[above]);
            if (!has_wall(f, cell) && f->per[cell] > 0.0f)
                continue;
            for (int r = row - 1; r <= row + 1; r++)
                for (int c = column - 1; c <= column + 1; c++)
                    if (r >= 0 && c >= 0 && r < d->high && c < d->wide)
                        f->near[r * d->wide + c] = 1;
        }
}

/* ---- areas ---- */

/* What a cell's floor gives to the nodes around, if people stand anywhere on it alike. */
static void share_area(JoxDensity *d, int column, int row, const Solid *solids, uint32_t count) {
    JoxDensityFloor *f = d->floor;
    size_t cell = (size_t)row * (size_t)d->wide + (size_t)column;
    if (!f->near[cell]) { /* means of the shares over the cell: 3/4 of each side, 1/8 to the next */
        static const float MEAN[3] = {0.125f, 0.75f, 0.125f};
        for (int r = -1; r <= 1; r++)
            for (int c = -1; c <= 1; c++)
                f->area[(row + r) * d->wide + column + c] += MEAN[r + 1] * MEAN[c + 1];
        return;
    }
    if (!has_wall(f, cell) && f->per[cell] <= 0.0f)
        return;
    for (int k = 0; k < FINE * FINE; k++) {
        uint32_t nodes[4];
        float shares[4];
        JoxV2 p = fine_point(d, column, row, k);
        if (has_wall(f, cell) && within(solids, count, p))
            continue;
        int n = jox_density_share(d, p.x, p.y, nodes, shares);
        for (int s = 0; s < n; s++)
            f->area[nodes[s]] += shares[s] / (FINE * FINE);
    }
}

static void measure(JoxDensity *d, const Solid *solids, uint32_t count) {
    JoxDensityFloor *f = d->floor;
    const size_t cells = (size_t)d->wide * (size_t)d->high;
    memset(f->area, 0, cells * sizeof *f->area);
    for (int row = 1; row < d->high - 1; row++)
        for (int column = 1; column < d->wide - 1; column++)
            share_area(d, column, row, solids, count);
    jox_density_begin(d, 1); /* spread as people are: what is even stays even */
    memcpy(d->mass[0], f->area, cells * sizeof *f->area);
    d->from_x = d->from_y = 1;
    d->to_x = d->wide - 2;
    d->to_y = d->high - 2;
    jox_density_spread(d, 0);
    for (size_t c = 0; c < cells; c++)
        f->per[c] = f->per[c] > 0.0f && d->mass[0][c] >= LEAST_AREA
                        ? 1.0f / (d->mass[0][c] * d->cell * d->cell)
                        : 0.0f;
}

static uint32_t list_solids(const JoxWalls *walls, Solid **solids) {
    uint32_t count = 0;
    *solids = jox_alloc(walls->ring_count + 1, sizeof **solids);
    for (uint32_t r = 0; r < walls->ring_count; r++)
        if (walls->rings[r].solid && !walls->rings[r].open) {
            Solid *s = &(*solids)[count++];
            s->points = jox_walls_ring_points(walls, r);
            s->count = walls->rings[r].count;
            jox_bounds(s->points, s->count, &s->low, &s->high);
        }
    return count;
}

static void make_floor(JoxDensity *d) {
    const size_t cells = (size_t)d->wide * (size_t)d->high;
    JoxDensityFloor *f = d->floor = jox_alloc(1, sizeof *f);
    f->node = jox_alloc(cells, sizeof *f->node);
    f->open_x = jox_alloc(cells, sizeof *f->open_x);
    f->open_y = jox_alloc(cells, sizeof *f->open_y);
    f->near = jox_alloc(cells, sizeof *f->near);
    f->area = jox_alloc(cells, sizeof *f->area);
    f->per = jox_alloc(cells, sizeof *f->per);
    f->first = jox_alloc(cells + 1, sizeof *f->first);
}

static uint64_t hash_of(const JoxWalls *walls) {
    JoxHash hash = jox_hash_begin();
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        const uint32_t what[3] = {ring->count, ring->solid, ring->open};
        jox_hash_add(&hash, what, sizeof what);
        for (uint32_t v = ring->first; v < ring->first + ring->count; v++)
            jox_hash_add(&hash, &walls->vertices[v].point, sizeof walls->vertices[v].point);
    }
    return jox_hash_end(&hash);
}

void jox_density_walls(JoxDensity *d, const JoxWalls *walls) {
    Solid *solids;
    if (!walls || walls->count == 0) {
        jox_density_free_floor(d->floor);
        d->floor = NULL;
        return;
    }
    uint64_t hash = hash_of(walls);
    if (d->floor && d->floor->hash == hash)
        return;
    if (!d->floor)
        make_floor(d);
    d->floor->hash = hash;
    uint32_t count = list_solids(walls, &solids);
    list_bars(d, walls);
    place_nodes(d, solids, count);
    open_ways(d);
    measure(d, solids, count);
    for (uint32_t s = 0; s < count; s++)
        jox_free(solids[s].points);
    jox_free(solids);
}

void jox_density_free_floor(JoxDensityFloor *f) {
    if (!f)
        return;
    void *arrays[] = {f->node, f->open_x, f->open_y, f->near,   f->area,
                      f->per,  f->bars,   f->first,  f->passing};
    for (size_t a = 0; a < sizeof arrays / sizeof *arrays; a++)
        jox_free(arrays[a]);
    jox_free(f);
}
