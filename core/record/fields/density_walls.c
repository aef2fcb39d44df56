/* The floor that walls leave: the nodes of cells, where one can go from one to the next, and the
   area that belongs to each. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "base/mem.h"
#include "geom/polygon.h"
#include "record/fields/density_parts.h"

typedef struct JoxDensityBar Bar;
/* Points by which a cell is judged, a lattice of Fibonacci: along every axis all different. */
enum { FINE = 89, TURN = 55, SIDE = 16 }; /* SIDE: along a side of it */
static const double TOUCHES = 1e-9;       /* of a length: as near as that is on it */
static const float OFF = 0.02f;           /* of a cell: nodes are at least so far from walls */
static const float LEAST_AREA = 0.1f; /* of a cell: of a node that has less, those beside take it */

/* ---- which walls pass through which cells ---- */

/* Shows each cell that a bar passes through to the count of `first`, or with `fill` to the list. */
static void pass_through(JoxDensity *d, uint32_t bar, bool fill) {
    JoxDensityFloor *f = d->floor;
    const Bar *b = &f->bars[bar];
    const JoxV2 low = jox_density_corner(d);
    const double h = d->cell, e = 1e-3;
    double ax = (b->ax - low.x) / h, ay = (b->ay - low.y) / h;
    double bx = (b->bx - low.x) / h, by = (b->by - low.y) / h;
    if (fmax(ax, bx) < -e || fmax(ay, by) < -e || fmin(ax, bx) > d->wide + e ||
        fmin(ay, by) > d->high + e)
        return;
    int last = jox_density_clamped(fmax(ay, by) + e, d->high - 1);
    for (int row = jox_density_clamped(fmin(ay, by) - e, d->high - 1); row <= last; row++) {
        double from = 0.0, to = 1.0; /* the stretch of the bar within the row */
        if (fabs(by - ay) > TOUCHES) {
            double s = (row - e - ay) / (by - ay), t = (row + 1 + e - ay) / (by - ay);
            from = fmax(from, fmin(s, t));
            to = fmin(to, fmax(s, t));
        }
        double x = ax + from * (bx - ax), y = ax + to * (bx - ax);
        if (from > to || fmax(x, y) < -e || fmin(x, y) > d->wide + e)
            continue;
        int right = jox_density_clamped(fmax(x, y) + e, d->wide - 1);
        for (int c = jox_density_clamped(fmin(x, y) - e, d->wide - 1); c <= right; c++) {
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
    JOX_RESERVE(f->node, f->node_capacity, f->first[cells] + 1);
    for (uint32_t b = f->bar_count; b-- > 0;)
        pass_through(d, b, true);
}

/* ---- nodes ---- */

static JoxV2 fine_point(const JoxDensity *d, int column, int row, int k) {
    const JoxV2 low = jox_density_corner(d);
    return jox_v2(low.x + ((float)column + ((float)k + 0.5f) / FINE) * d->cell,
                  low.y + ((float)row + ((float)(k * TURN % FINE) + 0.5f) / FINE) * d->cell);
}

/* Whether a node can stand at p: on the floor, and not on a wall. */
static bool stands(const JoxDensity *d, size_t cell, JoxV2 p, JoxDensitySolids *solids) {
    const JoxDensityFloor *f = d->floor;
    float off = OFF * d->cell;
    for (uint32_t k = f->first[cell]; k < f->first[cell + 1]; k++) {
        const Bar *b = &f->bars[f->passing[k]];
        JoxV2 from = {(float)b->ax, (float)b->ay}, to = {(float)b->bx, (float)b->by};
        if (jox_length2(jox_sub(jox_segment_nearest(from, to, p), p)) < off * off)
            return false;
    }
    return !jox_density_within(solids, p);
}

/* The middle of each cell, or where that cannot be walked on the nearest point that can. `per` is 1
   where there is one. Cells without walls are as the one before them in their row. */
static void place_nodes(JoxDensity *d, JoxDensitySolids *solids) {
    JoxDensityFloor *f = d->floor;
    const JoxV2 low = jox_density_corner(d);
    for (int row = 0; row < d->high; row++)
        for (int column = 0; column < d->wide; column++) {
            size_t cell = (size_t)row * (size_t)d->wide + (size_t)column;
            JoxV2 middle = {low.x + ((float)column + 0.5f) * d->cell,
                            low.y + ((float)row + 0.5f) * d->cell};
            if (jox_density_has_wall(f, cell))
                f->node[f->first[cell]] = middle;
            f->near[cell] = 0;
            if (!jox_density_has_wall(f, cell) && column > 0 &&
                !jox_density_has_wall(f, cell - 1)) {
                f->per[cell] = f->per[cell - 1];
                continue;
            }
            f->per[cell] = stands(d, cell, middle, solids) ? 1.0f : 0.0f;
            float nearest = INFINITY;
            for (int k = 0; k < FINE && jox_density_has_wall(f, cell) && f->per[cell] == 0.0f;
                 k++) {
                JoxV2 p = fine_point(d, column, row, k);
                float away = jox_length2(jox_sub(p, middle));
                if (away < nearest && stands(d, cell, p, solids)) {
                    nearest = away;
                    f->node[f->first[cell]] = p;
                }
            }
            if (nearest < INFINITY)
                f->per[cell] = 1.0f;
        }
}

/* The node to which a point of the floor belongs; false: none that is seen from there. */
static bool owner_of(const JoxDensity *d, JoxV2 p, JoxDensitySolids *solids, int *node) {
    const JoxDensityFloor *f = d->floor;
    const JoxV2 low = jox_density_corner(d);
    int column = jox_density_clamped((p.x - low.x) / d->cell, d->wide - 1);
    int row = jox_density_clamped((p.y - low.y) / d->cell, d->high - 1);
    const int cell = row * d->wide + column;
    *node = cell;
    if (!f->near[cell])
        return true;
    /* Without a wall in it a cell lies within a solid, or outside, as its node does. */
    if ((jox_density_has_wall(f, (size_t)cell) ? jox_density_within(solids, p)
                                               : f->per[cell] <= 0.0f) ||
        jox_density_node(d, p.x, p.y, &column, &row) != JOX_DENSITY_SEEN)
        return false;
    *node = row * d->wide + column;
    return true;
}

static JoxV2 node_of(const JoxDensity *d, int cell) {
    return jox_density_node_at(d, cell % d->wide, cell / d->wide);
}

/* People go from node a to node b over so much of a side. */
static void link(JoxDensity *d, int a, int b, float side) {
    JoxDensityFloor *f = d->floor;
    const int first = a < b ? a : b, away = abs(b - a);
    if (away == 1)
        f->open_x[first] += side;
    else if (away == d->wide)
        f->open_y[first] += side;
    else if (away > 0) { /* aslant: they are farther from each other */
        JOX_RESERVE(f->slants, f->slant_capacity, f->slant_count + 1);
        f->slants[f->slant_count++] = (struct JoxDensitySlant){
            (uint32_t)a, (uint32_t)b,
            side * d->cell / jox_maxf(jox_length(jox_sub(node_of(d, a), node_of(d, b))), d->cell)};
    }
}

/* The ways over the side from `from` by `along` between the cell and the one beyond. */
static void link_side(JoxDensity *d, int cell, int beyond, JoxV2 from, JoxV2 along,
                      JoxDensitySolids *solids) {
    const JoxDensityFloor *f = d->floor;
    const JoxV2 off = {along.y * 1e-3f, along.x * 1e-3f}; /* to the cell beyond */
    if (!f->near[cell] && !f->near[beyond]) {
        link(d, cell, beyond, 1.0f);
        return;
    }
    for (int k = 0; k < SIDE; k++) {
        int a, b;
        JoxV2 p = jox_add(from, jox_scale(along, ((float)k + 0.5f) / SIDE));
        JoxV2 before = jox_sub(p, off), behind = jox_add(p, off);
        if (owner_of(d, before, solids, &a) && owner_of(d, behind, solids, &b) && a != b &&
            !jox_density_hidden(d, before, behind))
            link(d, a, b, 1.0f / SIDE);
    }
}

/* Where one can go. Nothing goes beyond the outermost cells but one. */
static void open_ways(JoxDensity *d, JoxDensitySolids *solids) {
    JoxDensityFloor *f = d->floor;
    const JoxV2 low = jox_density_corner(d);
    const int wide = d->wide;
    const size_t size = (size_t)wide * (size_t)d->high * sizeof(float);
    memset(f->open_x, 0, size);
    memset(f->open_y, 0, size);
    f->slant_count = 0;
    for (int row = 1; row < d->high - 1; row++)
        for (int column = 1; column < wide - 1; column++) {
            const int cell = row * wide + column;
            const float x = low.x + (float)column * d->cell, y = low.y + (float)row * d->cell;
            if (column + 2 < wide)
                link_side(d, cell, cell + 1, jox_v2(x + d->cell, y), jox_v2(0, d->cell), solids);
            if (row + 2 < d->high)
                link_side(d, cell, cell + wide, jox_v2(x, y + d->cell), jox_v2(d->cell, 0), solids);
        }
}

/* Which cells' people have walls or solids between them and the nodes around. */
static void mark_near(JoxDensity *d) {
    JoxDensityFloor *f = d->floor;
    for (int row = 0; row < d->high; row++)
        for (int column = 0; column < d->wide; column++) {
            size_t cell = (size_t)row * (size_t)d->wide + (size_t)column;
            if (!jox_density_has_wall(f, cell) && f->per[cell] > 0.0f)
                continue;
            for (int r = row - 1; r <= row + 1; r++)
                for (int c = column - 1; c <= column + 1; c++)
                    if (r >= 0 && c >= 0 && r < d->high && c < d->wide)
                        f->near[r * d->wide + c] = 1;
        }
}

/* ---- areas ---- */

/* What a cell's floor gives to the nodes around, if people stand anywhere on it alike. */
static void share_area(JoxDensity *d, int column, int row, JoxDensitySolids *solids) {
    JoxDensityFloor *f = d->floor;
    size_t cell = (size_t)row * (size_t)d->wide + (size_t)column;
    if (!f->near[cell]) { /* means of the shares over the cell: 3/4 of each side, 1/8 to the next */
        static const float MEAN[3] = {0.125f, 0.75f, 0.125f};
        for (int r = -1; r <= 1; r++)
            for (int c = -1; c <= 1; c++)
                f->area[(row + r) * d->wide + column + c] += MEAN[r + 1] * MEAN[c + 1];
        return;
    }
    if (!jox_density_has_wall(f, cell) && f->per[cell] <= 0.0f)
        return;
    for (int k = 0; k < FINE; k++) {
        uint32_t nodes[4];
        float shares[4];
        JoxV2 p = fine_point(d, column, row, k);
        if (jox_density_has_wall(f, cell) && jox_density_within(solids, p))
            continue;
        int n = jox_density_share(d, p.x, p.y, nodes, shares);
        for (int s = 0; s < n; s++)
            f->area[nodes[s]] += shares[s] / FINE;
    }
}

static void measure(JoxDensity *d, JoxDensitySolids *solids) {
    JoxDensityFloor *f = d->floor;
    memset(f->area, 0, (size_t)d->wide * (size_t)d->high * sizeof *f->area);
    for (int row = 1; row < d->high - 1; row++)
        for (int column = 1; column < d->wide - 1; column++)
            share_area(d, column, row, solids);
}

/* Narrows the ways of nodes with little area, so that no more leaves in a step than is there. */
static void narrow_ways(JoxDensity *d) {
    JoxDensityFloor *f = d->floor;
    const int wide = d->wide, last = wide * (d->high - 1);
    float *room = jox_density_spare(d); /* the ways from a node, then how much of them is used */
    for (int c = wide; c < last; c++)
        room[c] = f->open_x[c] + f->open_x[c - 1] + f->open_y[c] + f->open_y[c - wide];
    for (uint32_t s = 0; s < f->slant_count; s++) {
        room[f->slants[s].a] += f->slants[s].open;
        room[f->slants[s].b] += f->slants[s].open;
    }
    for (int c = wide; c < last; c++) {
        float area = jox_maxf(f->area[c], LEAST_AREA);
        room[c] = jox_minf(1.0f, area / jox_maxf(JOX_DENSITY_SHARE * room[c], 1e-6f));
        f->per[c] = f->per[c] > 0.0f ? 1.0f / area : 0.0f;
    }
    for (int c = wide; c < last - wide; c++) {
        f->open_x[c] *= jox_minf(room[c], room[c + 1]);
        f->open_y[c] *= jox_minf(room[c], room[c + wide]);
    }
    for (uint32_t s = 0; s < f->slant_count; s++)
        f->slants[s].open *= jox_minf(room[f->slants[s].a], room[f->slants[s].b]);
}

/* Once more where nodes have next to no area of their own, which they leave to those beside. */
static void make_ways(JoxDensity *d, JoxDensitySolids *solids) {
    JoxDensityFloor *f = d->floor;
    mark_near(d);
    open_ways(d, solids);
    measure(d, solids);
    bool fewer = false;
    for (int cell = 0; cell < d->wide * d->high; cell++)
        if (f->per[cell] > 0.0f && f->area[cell] < LEAST_AREA) {
            f->per[cell] = 0.0f;
            fewer = true;
        }
    if (fewer) {
        mark_near(d);
        open_ways(d, solids);
        measure(d, solids);
    }
    narrow_ways(d);
}

static void make_floor(JoxDensity *d) {
    const size_t cells = (size_t)d->wide * (size_t)d->high;
    JoxDensityFloor *f = d->floor = jox_alloc(1, sizeof *f);
    f->open_x = jox_alloc(cells, sizeof *f->open_x);
    f->open_y = jox_alloc(cells, sizeof *f->open_y);
    f->near = jox_alloc(cells, sizeof *f->near);
    f->area = jox_alloc(cells, sizeof *f->area);
    f->per = jox_alloc(cells, sizeof *f->per);
    f->first = jox_alloc(cells + 1, sizeof *f->first);
    f->run_first = jox_alloc((size_t)d->high + 1, sizeof *f->run_first);
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
    JoxDensitySolids *solids = jox_density_solids_create(d, walls);
    list_bars(d, walls);
    place_nodes(d, solids);
    make_ways(d, solids);
    jox_density_list_floor(d);
    jox_density_solids_free(solids);
}

uint64_t jox_density_walls_hash(const JoxDensity *d) {
    return d->floor ? d->floor->hash : 0;
}

void jox_density_free_floor(JoxDensityFloor *f) {
    if (!f)
        return;
    void *arrays[] = {f->node, f->open_x, f->open_y,  f->slants, f->near,      f->area,  f->per,
                      f->bars, f->first,  f->passing, f->runs,   f->run_first, f->right, f->up};
    for (size_t a = 0; a < sizeof arrays / sizeof *arrays; a++)
        jox_free(arrays[a]);
    jox_free(f);
}
