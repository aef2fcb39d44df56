/* Builds the floor that walls leave: the nodes of cells, the ways between adjacent nodes, and the
   area of each node. jox_density_walls rebuilds it when walls change. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "base/mem.h"
#include "geom/polygon.h"
#include "record/fields/density_parts.h"

typedef struct JoxDensityBar Bar;
/* Sample points of a cell: a Fibonacci lattice of FINE points, whose coordinates along each axis
   are all different. */
enum { FINE = 89, TURN = 55, SIDE = 16 }; /* SIDE: sample points along a side of a cell */
static const double TOUCHES = 1e-9;       /* share of a length that counts as touching */
static const float OFF = 0.02f;           /* cells: least distance of a node from walls */
/* Cells: a node with less area is dropped; its area goes to nodes beside it. */
static const float LEAST_AREA = 0.1f;

/* ---- wall edges by cell ---- */

/* Enters a bar for each cell that it passes through: counts it in `first` or, with `fill`, lists
   it. */
static void enter_bar(JoxDensity *d, uint32_t bar, bool fill) {
    JoxDensityFloor *f = d->floor;
    const Bar *b = &f->bars[bar];
    const JoxV2 low = jox_density_corner(d);
    const double h = d->cell, e = 1e-3;
    double ax = (b->ax - low.x) / h, ay = (b->ay - low.y) / h;
    double bx = (b->bx - low.x) / h, by = (b->by - low.y) / h;
    if (fmax(ax, bx) < -e || fmax(ay, by) < -e || fmin(ax, bx) > d->wide + e ||
        fmin(ay, by) > d->high + e)
        return;
    int last = jox_density_clamp_index(fmax(ay, by) + e, d->high - 1);
    for (int row = jox_density_clamp_index(fmin(ay, by) - e, d->high - 1); row <= last; row++) {
        double from = 0.0, to = 1.0; /* part of the bar within the row */
        if (fabs(by - ay) > TOUCHES) {
            double s = (row - e - ay) / (by - ay), t = (row + 1 + e - ay) / (by - ay);
            from = fmax(from, fmin(s, t));
            to = fmin(to, fmax(s, t));
        }
        double x = ax + from * (bx - ax), y = ax + to * (bx - ax);
        if (from > to || fmax(x, y) < -e || fmin(x, y) > d->wide + e)
            continue;
        int right = jox_density_clamp_index(fmax(x, y) + e, d->wide - 1);
        for (int c = jox_density_clamp_index(fmin(x, y) - e, d->wide - 1); c <= right; c++) {
            uint32_t *n = &f->first[row * d->wide + c];
            if (fill)
                f->passing[--*n] = bar;
            else
                ++*n;
        }
    }
}

/* Lists the edges of standing walls, and by cell the edges that pass through it. */
static void list_bars(JoxDensity *d, const JoxWalls *walls) {
    JoxDensityFloor *f = d->floor;
    const size_t cells = (size_t)d->wide * (size_t)d->high;
    f->bar_count = 0;
    if (d->sheets)
        jox_density_add_packed_bars(d, walls);
    for (uint32_t r = 0; !d->sheets && r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        for (uint32_t v = ring->first; v < ring->first + ring->count && !ring->open; v++)
            jox_density_add_bar(d, walls->vertices[v].point,
                                walls->vertices[walls->vertices[v].next].point);
    }
    memset(f->first, 0, (cells + 1) * sizeof *f->first);
    for (uint32_t b = 0; b < f->bar_count; b++)
        enter_bar(d, b, false);
    for (size_t c = 0; c < cells;
         c++) /* `first` becomes the end of each list; filling moves it down to the beginning */
        f->first[c + 1] += f->first[c];
    JOX_RESERVE(f->passing, f->passing_capacity, f->first[cells] + 1);
    JOX_RESERVE(f->node, f->node_capacity, f->first[cells] + 1);
    for (uint32_t b = f->bar_count; b-- > 0;)
        enter_bar(d, b, true);
}

/* ---- nodes ---- */

static JoxV2 sample_point(const JoxDensity *d, int column, int row, int k) {
    const JoxV2 low = jox_density_corner(d);
    return jox_v2(low.x + ((float)column + ((float)k + 0.5f) / FINE) * d->cell,
                  low.y + ((float)row + ((float)(k * TURN % FINE) + 0.5f) / FINE) * d->cell);
}

/* Returns whether a node can be at p: on the floor, and off the walls. */
static bool can_hold_node(const JoxDensity *d, size_t cell, JoxV2 p, JoxDensitySolids *solids) {
    const JoxDensityFloor *f = d->floor;
    float off = OFF * d->cell;
    for (uint32_t k = f->first[cell]; k < f->first[cell + 1]; k++) {
        const Bar *b = &f->bars[f->passing[k]];
        JoxV2 from = {(float)b->ax, (float)b->ay}, to = {(float)b->bx, (float)b->by};
        if (jox_length2(jox_sub(jox_segment_nearest(from, to, p), p)) < off * off)
            return false;
    }
    return !jox_density_is_within_solid(solids, p);
}

/* Sets nodes to the middle of each cell or, if that is not walkable, to the nearest walkable sample
   point; `per` is 1 for cells with a node. A cell without walls has a node if the cell before it in
   its row has one, as no wall lies between them. */
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
            f->per[cell] = can_hold_node(d, cell, middle, solids) ? 1.0f : 0.0f;
            float nearest = INFINITY;
            for (int k = 0; k < FINE && jox_density_has_wall(f, cell) && f->per[cell] == 0.0f;
                 k++) {
                JoxV2 p = sample_point(d, column, row, k);
                float away = jox_length2(jox_sub(p, middle));
                if (away < nearest && can_hold_node(d, cell, p, solids)) {
                    nearest = away;
                    f->node[f->first[cell]] = p;
                }
            }
            if (nearest < INFINITY)
                f->per[cell] = 1.0f;
        }
}

/* Sets the node that a point of the floor belongs to. Returns false if no node is visible from
   it. */
static bool find_owner(const JoxDensity *d, JoxV2 p, JoxDensitySolids *solids, int *node) {
    const JoxDensityFloor *f = d->floor;
    const JoxV2 low = jox_density_corner(d);
    int column = jox_density_clamp_index((p.x - low.x) / d->cell, d->wide - 1);
    int row = jox_density_clamp_index((p.y - low.y) / d->cell, d->high - 1);
    const int cell = row * d->wide + column;
    *node = cell;
    if (!f->near[cell])
        return true;
    /* A cell without walls is entirely walkable or not, as its node tells. */
    if ((jox_density_has_wall(f, (size_t)cell) ? jox_density_is_within_solid(solids, p)
                                               : f->per[cell] <= 0.0f) ||
        jox_density_find_node(d, p.x, p.y, &column, &row) != JOX_DENSITY_SEEN)
        return false;
    *node = row * d->wide + column;
    return true;
}

static JoxV2 locate_node(const JoxDensity *d, int cell) {
    return jox_density_node_at(d, cell % d->wide, cell / d->wide);
}

/* Adds a way between nodes a and b of the width `side`, in cells. */
static void widen_way(JoxDensity *d, int a, int b, float side) {
    JoxDensityFloor *f = d->floor;
    const int first = a < b ? a : b, away = abs(b - a);
    if (away == 1)
        f->open_x[first] += side;
    else if (away == d->wide)
        f->open_y[first] += side;
    else if (away > 0) { /* not along x or y: the flow is lower by the longer distance */
        JOX_RESERVE(f->slants, f->slant_capacity, f->slant_count + 1);
        f->slants[f->slant_count++] = (struct JoxDensitySlant){
            (uint32_t)a, (uint32_t)b,
            side * d->cell /
                jox_maxf(jox_length(jox_sub(locate_node(d, a), locate_node(d, b))), d->cell)};
    }
}

/* Adds the ways over a side, which begins at `from` and extends by `along`, between a cell and the
   one beyond it. */
static void add_side_ways(JoxDensity *d, int cell, int beyond, JoxV2 from, JoxV2 along,
                          JoxDensitySolids *solids) {
    const JoxDensityFloor *f = d->floor;
    const JoxV2 off = {along.y * 1e-3f,
                       along.x * 1e-3f}; /* a small offset towards the cell beyond */
    if (!f->near[cell] && !f->near[beyond]) {
        widen_way(d, cell, beyond, 1.0f);
        return;
    }
    for (int k = 0; k < SIDE; k++) {
        int a, b;
        JoxV2 p = jox_add(from, jox_scale(along, ((float)k + 0.5f) / SIDE));
        JoxV2 before = jox_sub(p, off), behind = jox_add(p, off);
        if (find_owner(d, before, solids, &a) && find_owner(d, behind, solids, &b) && a != b &&
            !jox_density_is_hidden(d, before, behind))
            widen_way(d, a, b, 1.0f / SIDE);
    }
}

/* Returns the position of a cell's node in plan. */
static JoxV2 locate_in_plan(const JoxDensity *d, int cell) {
    const JoxV2 at = locate_node(d, cell);
    return jox_in_plan(jox_density_storeys_of(d), (JoxV2){at.x, jox_density_unpack(d, at.y)});
}

/* Adds a way between nodes a and b on both sides of a seam, over `side` metres of it. Widens the
   way added last if that joins the same nodes. */
static void widen_seam_way(JoxDensity *d, int a, int b, float side) {
    JoxDensityFloor *f = d->floor;
    const struct JoxDensitySlant *last = f->slant_count ? &f->slants[f->slant_count - 1] : NULL;
    const float apart = jox_length(jox_sub(locate_in_plan(d, a), locate_in_plan(d, b)));
    const float open = side / jox_maxf(apart, d->cell);
    if (last && last->a == (uint32_t)a && last->b == (uint32_t)b) {
        f->slants[f->slant_count - 1].open += open;
        return;
    }
    JOX_RESERVE(f->slants, f->slant_capacity, f->slant_count + 1);
    f->slants[f->slant_count++] = (struct JoxDensitySlant){(uint32_t)a, (uint32_t)b, open};
}

/* Adds the ways through a seam. */
static void open_seam(JoxDensity *d, const JoxSeam *seam, JoxDensitySolids *solids) {
    const JoxStoreys *storeys = jox_density_storeys_of(d);
    const JoxV2 off = jox_scale(jox_left(seam->along), OFF * d->cell);
    const int count = (int)ceilf(seam->length / d->cell * SIDE);
    for (int k = 0; k < count; k++) {
        int a, b;
        const float at = ((float)k + 0.5f) / (float)count * seam->length;
        const JoxV2 p = jox_add(seam->a, jox_scale(seam->along, at));
        JoxV2 before = jox_on_sheet(storeys, seam->here, jox_sub(p, off));
        JoxV2 behind = jox_on_sheet(storeys, seam->there, jox_add(p, off));
        before.y = jox_density_pack(d, before.y);
        behind.y = jox_density_pack(d, behind.y);
        if (jox_density_holds(d, before) && jox_density_holds(d, behind) &&
            find_owner(d, before, solids, &a) && find_owner(d, behind, solids, &b))
            widen_seam_way(d, a, b, seam->length / (float)count);
    }
}

/* Adds all ways. The outermost ring of cells has none, so that no mass leaves the grid. */
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
                add_side_ways(d, cell, cell + 1, jox_v2(x + d->cell, y), jox_v2(0, d->cell),
                              solids);
            if (row + 2 < d->high)
                add_side_ways(d, cell, cell + wide, jox_v2(x, y + d->cell), jox_v2(d->cell, 0),
                              solids);
        }
    const JoxStoreys *storeys = jox_density_storeys_of(d);
    for (uint32_t k = 0; storeys && k < storeys->seam_count; k++)
        if (storeys->seams[k].enters) /* each seam is listed from either side */
            open_seam(d, &storeys->seams[k], solids);
}

/* Marks cells next to walls or solids, where these may lie between a point of the cell and nodes
   around. */
static void mark_near_walls(JoxDensity *d) {
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

/* Adds the floor of a cell to the areas of the nodes around, in the shares that people evenly
   spread over the cell would have. */
static void share_area(JoxDensity *d, int column, int row, JoxDensitySolids *solids) {
    JoxDensityFloor *f = d->floor;
    size_t cell = (size_t)row * (size_t)d->wide + (size_t)column;
    if (!f->near[cell]) { /* means of the shares over the cell: along each axis 3/4 for its node,
                             1/8 for each next one */
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
        JoxV2 p = sample_point(d, column, row, k);
        if (jox_density_has_wall(f, cell) && jox_density_is_within_solid(solids, p))
            continue;
        int n = jox_density_share_person(d, p.x, p.y, nodes, shares);
        for (int s = 0; s < n; s++)
            f->area[nodes[s]] += shares[s] / FINE;
    }
}

static void measure_areas(JoxDensity *d, JoxDensitySolids *solids) {
    JoxDensityFloor *f = d->floor;
    memset(f->area, 0, (size_t)d->wide * (size_t)d->high * sizeof *f->area);
    for (int row = 1; row < d->high - 1; row++)
        for (int column = 1; column < d->wide - 1; column++)
            share_area(d, column, row, solids);
}

/* Narrows the ways of nodes with little area, so that a step never moves more mass than a node
   has. */
static void narrow_ways(JoxDensity *d) {
    JoxDensityFloor *f = d->floor;
    const int wide = d->wide, last = wide * (d->high - 1);
    /* Total width of the ways of a node, then the factor for its ways. */
    float *room = jox_density_scratch(d);
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

/* Builds ways and areas. Nodes with too little area are dropped, and all is built again, so that
   nodes beside them get the area. */
static void make_ways(JoxDensity *d, JoxDensitySolids *solids) {
    JoxDensityFloor *f = d->floor;
    mark_near_walls(d);
    open_ways(d, solids);
    measure_areas(d, solids);
    bool fewer = false;
    for (int cell = 0; cell < d->wide * d->high; cell++)
        if (f->per[cell] > 0.0f && f->area[cell] < LEAST_AREA) {
            f->per[cell] = 0.0f;
            fewer = true;
        }
    if (fewer) {
        mark_near_walls(d);
        open_ways(d, solids);
        measure_areas(d, solids);
    }
    narrow_ways(d);
}

static void create_floor(JoxDensity *d) {
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

static uint64_t hash_rings(const JoxWalls *walls) {
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
    if ((!walls || walls->count == 0) && !d->sheets) {
        jox_density_free_floor(d->floor);
        d->floor = NULL;
        return;
    }
    const uint64_t hash = walls ? hash_rings(walls) : 0;
    if (d->floor && d->floor->hash == hash)
        return;
    if (!d->floor)
        create_floor(d);
    d->floor->hash = hash;
    d->floor->walled = walls != NULL;
    JoxWalls packed = {0};
    if (d->sheets)
        jox_density_pack_solids(d, walls, &packed);
    JoxDensitySolids *solids = jox_density_solids_create(d, d->sheets ? &packed : walls);
    list_bars(d, walls);
    place_nodes(d, solids);
    make_ways(d, solids);
    jox_density_list_floor(d);
    jox_density_solids_free(solids);
    jox_walls_free(&packed);
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
