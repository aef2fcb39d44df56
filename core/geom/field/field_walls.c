/* The effect of walls on a field: edges by cell, samples inside solids, nodes, and their links by
   sight. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "geom/field/field_sheets.h"

const int JOX_FIELD_RING[8][2] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                  {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};

static const float NEAR = 0.5f;    /* m: walls slow people down within this distance */
static const float SLOWING = 0.5f; /* additional s/m next to a wall */
/* Share of the clearance that ways between two nodes keep: a way round a corner cuts into it a
   little. */
static const float CORNER = 0.85f;
static const float EXACT_CELLS = 2e4f; /* distance from the origin, in cells; see is_exact */

/* ---- edges by cell ---- */

static void collect_edges_of_walls(JoxField *f, const JoxWalls *walls) {
    f->edges = jox_alloc(walls->count + 1, sizeof *f->edges);
    for (uint32_t r = 0; r < walls->ring_count; r++)
        for (uint32_t k = 0; k < walls->rings[r].count; k++) {
            const JoxWallVertex *v = &walls->vertices[walls->rings[r].first + k];
            JoxV2 a = v->point, b = walls->vertices[v->next].point;
            if (v->absent)
                continue;
            bool back = b.x < a.x || (!(a.x < b.x) && b.y < a.y);
            if (back && !walls->rings[r].solid)
                continue; /* thin walls run there and back: once is enough */
            JOX_ASSERT(f->edge_count < walls->count);
            f->edges[f->edge_count++] = (JoxFieldEdge){a, b, walls->rings[r].solid};
        }
}

/* Lists an edge in all cells whose centre is within `reach` of it; only counts them while refs is
   NULL. Works row by row, so that a long slanted edge does not visit its whole bounding box. */
static void list_edge(JoxFieldWork *w, uint32_t edge, float reach) {
    JoxField *f = w->f;
    JoxV2 a = f->edges[edge].a, b = f->edges[edge].b;
    int r0, r1, c0, c1;
    jox_field_span(jox_minf(a.y, b.y) - reach, jox_maxf(a.y, b.y) + reach, f->low.y, f->size,
                   f->rows, &r0, &r1);
    for (int r = r0; r <= r1; r++) {
        float y = f->low.y + ((float)r + 0.5f) * f->size, rise = b.y - a.y;
        float s = 0.0f, t = 1.0f;
        if (fabsf(rise) > 1e-6f) { /* the part of the edge near this row */
            float u = (y - reach - a.y) / rise, v = (y + reach - a.y) / rise;
            s = jox_clampf(jox_minf(u, v), 0.0f, 1.0f);
            t = jox_clampf(jox_maxf(u, v), 0.0f, 1.0f);
        }
        float x0 = a.x + s * (b.x - a.x), x1 = a.x + t * (b.x - a.x);
        jox_field_span(jox_minf(x0, x1) - reach, jox_maxf(x0, x1) + reach, f->low.x, f->size,
                       f->columns, &c0, &c1);
        for (int c = c0; c <= c1; c++) {
            int cell = r * f->columns + c;
            JoxV2 p = jox_field_sample(f, cell, JOX_FIELD_MIDDLE);
            if (jox_length2(jox_sub(p, jox_segment_nearest(a, b, p))) > reach * reach)
                continue;
            if (f->refs)
                f->refs[--w->walled.first[cell]] = edge;
            else
                w->walled.first[cell]++;
        }
    }
}

/* Lists the edges within `reach` of each cell, in refs. */
static void list_edges_by_cell(JoxFieldWork *w, float reach) {
    JoxField *f = w->f;
    for (uint32_t e = 0; e < f->edge_count; e++)
        list_edge(w, e, reach);
    for (int i = 0; i < w->count; i++)
        w->walled.first[i + 1] += w->walled.first[i];
    f->ref_count = w->walled.first[w->count];
    f->refs = jox_alloc((size_t)f->ref_count + 1, sizeof *f->refs);
    for (uint32_t e = f->edge_count; e-- > 0;) /* backwards, as lists are filled from their end */
        list_edge(w, e, reach);
    JOX_ASSERT(w->walled.first[0] == 0);
}

/* ---- solids ---- */

/* Marks the samples between pairs of crossings in one row of samples. */
static void fill_row(JoxFieldWork *w, int row, const float *x, int crossings) {
    JoxField *f = w->f;
    float step = f->size / (float)JOX_FIELD_SIDE;
    int shift = row % JOX_FIELD_SIDE * JOX_FIELD_SIDE, base = row / JOX_FIELD_SIDE * f->columns;
    for (int k = 0; k + 1 < crossings; k += 2) {
        float from = ceilf((x[k] - f->low.x) / step - 0.5f);
        float to = floorf((x[k + 1] - f->low.x) / step - 0.5f);
        float most = (float)(f->columns * JOX_FIELD_SIDE - 1);
        int first = from > 0.0f ? (int)jox_minf(from, most + 1.0f) : 0;
        int last = to < most ? (int)jox_maxf(to, -1.0f) : (int)most;
        for (int j = first; j <= last; j++)
            w->walled.solid[base + j / JOX_FIELD_SIDE] |=
                (uint16_t)(1 << (shift + j % JOX_FIELD_SIDE));
    }
}

/* Marks the samples inside one solid, row by row, by crossing numbers; `x` has room for the
   crossings of a row. */
static void fill_solid(JoxFieldWork *w, const JoxWalls *walls, const struct JoxWallRing *ring,
                       float *x) {
    JoxField *f = w->f;
    float low = INFINITY, high = -INFINITY, step = f->size / (float)JOX_FIELD_SIDE;
    const JoxWallVertex *v = walls->vertices + ring->first;
    for (uint32_t k = 0; k < ring->count; k++) {
        low = jox_minf(low, v[k].point.y);
        high = jox_maxf(high, v[k].point.y);
    }
    int r0, r1;
    jox_field_span(low, high, f->low.y, step, f->rows * JOX_FIELD_SIDE, &r0, &r1);
    for (int r = r0; r <= r1; r++) {
        float y = f->low.y + ((float)r + 0.5f) * step;
        int crossings = 0;
        for (uint32_t k = 0; k < ring->count; k++) {
            JoxV2 a = v[k].point, b = v[(k + 1) % ring->count].point;
            if ((a.y > y) == (b.y > y))
                continue;
            float at = a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
            int n = crossings++;
            for (; n > 0 && x[n - 1] > at; n--)
                x[n] = x[n - 1];
            x[n] = at;
        }
        JOX_ASSERT(crossings % 2 == 0); /* a ring is left as often as it is entered */
        fill_row(w, r, x, crossings);
    }
}

static void fill_solids(JoxFieldWork *w, const JoxWalls *walls) {
    float *x = jox_alloc((size_t)walls->count + 1, sizeof *x);
    for (uint32_t r = 0; r < walls->ring_count; r++)
        if (walls->rings[r].solid)
            fill_solid(w, walls, &walls->rings[r], x);
    jox_free(x);
}

/* ---- nodes and links ---- */

/* Places a cell's node at the centre if that keeps the clearance, else at the sample farthest from
   walls. */
static void place_node(JoxFieldWork *w, int cell) {
    JoxField *f = w->f;
    uint32_t first = w->walled.first[cell], last = w->walled.first[cell + 1];
    float best = -1.0f, most = f->clearance + 1.5f * f->size; /* edges of other cells are farther
                                                                 away */
    if (first == last && !w->walled.solid[cell]) {
        w->walled.node[cell] = JOX_FIELD_MIDDLE;
        w->slowness[cell] = 1.0f;
        w->near[cell] = most;
        return;
    }
    w->walled.node[cell] = JOX_FIELD_BLOCKED;
    for (int k = 0; k < JOX_FIELD_SAMPLES; k++) {
        int s = k == 0 ? JOX_FIELD_MIDDLE : k <= JOX_FIELD_MIDDLE ? k - 1 : k;
        if (w->walled.solid[cell] >> s & 1)
            continue;
        float d = jox_field_nearest(f, first, last, jox_field_sample(f, cell, s), NULL, NULL);
        if (d < f->clearance || d <= best)
            continue;
        best = d;
        w->walled.node[cell] = (uint8_t)s;
        if (s == JOX_FIELD_MIDDLE)
            break;
    }
    float lack = 1.0f - jox_clampf(best / NEAR, 0.0f, 1.0f);
    w->slowness[cell] = 1.0f + SLOWING * lack * lack;
    w->near[cell] = jox_minf(best, most);
}

static void compute_axis(JoxFieldAxis *axis, float low, float size, int most) {
    for (int c = 0; c < most; c++)
        for (int s = 0; s < JOX_FIELD_SIDE; s++, axis++) {
            axis->at = low + ((float)c + ((float)s + 0.5f) / (float)JOX_FIELD_SIDE) * size;
            const float x = (axis->at - low) / size - 0.5f;
            axis->first = (int)floorf(x);
            for (int k = 0; k < 2; k++)
                axis->share[k] = 1.0f - fabsf(x - (float)(axis->first + k));
        }
}

/* Computes the positions of samples and nodes: jox_field_sample of each. */
static void compute_positions(JoxFieldWork *w) {
    const JoxField *f = w->f;
    JoxFieldWalled *of = &w->walled;
    of->columns = jox_alloc((size_t)f->columns, JOX_FIELD_SIDE * sizeof *of->columns);
    of->rows = jox_alloc((size_t)f->rows, JOX_FIELD_SIDE * sizeof *of->rows);
    compute_axis(of->columns, f->low.x, f->size, f->columns);
    compute_axis(of->rows, f->low.y, f->size, f->rows);
    for (int r = 0; r < f->rows; r++)
        for (int c = 0; c < f->columns; c++) {
            const int cell = r * f->columns + c;
            const int node =
                of->node[cell] == JOX_FIELD_BLOCKED ? JOX_FIELD_MIDDLE : of->node[cell];
            of->x[cell] = of->columns[c * JOX_FIELD_SIDE + node % JOX_FIELD_SIDE].at;
            of->y[cell] = of->rows[r * JOX_FIELD_SIDE + node / JOX_FIELD_SIDE].at;
        }
}

/* Links a cell with its neighbours to the east and north. */
static void link_cell(JoxFieldWork *w, int column, int row) {
    const int cell = row * w->f->columns + column;
    const float least = CORNER * w->f->clearance;
    if (w->walled.node[cell] == JOX_FIELD_BLOCKED)
        return;
    for (int k = 0; k < 4; k++) {
        const int other = jox_field_next_to(w->f, column, row, k);
        if (other < 0 || w->walled.node[other] == JOX_FIELD_BLOCKED)
            continue;
        const JoxV2 p = jox_field_node(w, cell), q = jox_field_node(w, other);
        if ((jox_field_has_edges(w, cell) || jox_field_has_edges(w, other)) &&
            !jox_field_surely_sees(w, w->near[cell], w->near[other], p, q, least) &&
            !jox_field_sees_near(w, cell, p, q, least))
            continue;
        w->walled.links[cell] |= (uint8_t)(1 << k);
        w->walled.links[other] |= (uint8_t)(1 << (k + 4));
    }
}

static bool is_inside_triangle(JoxV2 a, JoxV2 b, JoxV2 c, JoxV2 p) {
    return jox_det(jox_sub(b, a), jox_sub(p, a)) >= 0.0f &&
           jox_det(jox_sub(c, b), jox_sub(p, b)) >= 0.0f &&
           jox_det(jox_sub(a, c), jox_sub(p, c)) >= 0.0f;
}

/* Returns bit t if the cell and its ring neighbours t and t + 1 are all linked to each other. */
static uint32_t find_linked_corners(const JoxFieldWork *w, int cell) {
    const uint32_t links = w->walled.links[cell];
    uint32_t across = 0;
    for (int k = 0; k < 8; k += 2) { /* from neighbours beside the cell, forward and back along the
                                        ring */
        if (!(links >> k & 1))
            continue;
        const int beside = cell + JOX_FIELD_RING[k][1] * w->f->columns + JOX_FIELD_RING[k][0];
        const uint32_t its = w->walled.links[beside];
        across |= (its >> ((k + 2) & 7) & 1) << k | (its >> ((k + 6) & 7) & 1) << ((k + 7) & 7);
    }
    return links & (links >> 1 | links << 7) & across;
}

/* Finds the triangles of a node with two adjacent ring neighbours that no wall intersects. */
static void find_free_corners(JoxFieldWork *w, int cell) {
    uint32_t corners = find_linked_corners(w, cell);
    for (int t = 0; t < 8 && jox_field_has_edges(w, cell); t++) {
        if (!(corners >> t & 1))
            continue;
        const int one = jox_field_next(w->f, cell, t),
                  two = jox_field_next(w->f, cell, (t + 1) & 7);
        JoxV2 a = jox_field_node(w, cell), b = jox_field_node(w, one), c = jox_field_node(w, two);
        bool empty = true; /* no edge crosses the sides: look for walls wholly inside */
        for (uint32_t k = w->walled.first[cell]; empty && k < w->walled.first[cell + 1]; k++)
            empty = !is_inside_triangle(a, b, c, w->f->edges[w->f->refs[k]].a);
        if (!empty)
            corners &= ~(1u << t);
    }
    w->walled.corners[cell] = (uint8_t)corners;
}

/* Finds the cells whose node, and all neighbours' nodes, are at their cells' centres. */
static void find_even_cells(JoxFieldWork *w) {
    const JoxField *f = w->f;
    memset(w->walled.even, true, (size_t)w->count * sizeof *w->walled.even);
    for (int i = 0; i < w->count; i++) {
        if (w->walled.node[i] == JOX_FIELD_MIDDLE)
            continue;
        w->walled.even[i] = false;
        for (int k = 0; k < 8; k++) {
            const int other = jox_field_next(f, i, k);
            if (other >= 0)
                w->walled.even[other] = false;
        }
    }
}

/* Returns whether cell sizes are equal within half a percent in spite of rounding, which grows with
   the distance from the origin. */
static bool is_exact(const JoxField *f) {
    const float most = EXACT_CELLS * f->size;
    return fabsf(f->low.x) < most && f->low.x + (float)f->columns * f->size < most &&
           fabsf(f->low.y) < most && f->low.y + (float)f->rows * f->size < most;
}

static void allocate_walled(JoxFieldWork *w) {
    const size_t count = (size_t)w->count;
    w->walled = (JoxFieldWalled){.first = jox_alloc(count + 1, sizeof(uint32_t)),
                                 .solid = jox_alloc(count, sizeof(uint16_t)),
                                 .node = jox_alloc(count, 1),
                                 .x = jox_alloc(count, sizeof(float)),
                                 .y = jox_alloc(count, sizeof(float)),
                                 .links = jox_alloc(count, 1),
                                 .corners = jox_alloc(count, 1),
                                 .even = jox_alloc(count, sizeof(bool))};
}

void jox_field_mark(JoxFieldWork *w, const JoxWalls *walls, JoxFieldMarks **marks) {
    JoxField *f = w->f;
    float reach = jox_maxf(NEAR, f->clearance + 1.5f * f->size) + 0.5f * f->size;
    w->exact = is_exact(f);
    collect_edges_of_walls(f, walls);
    if (jox_field_recall(w, *marks))
        return;
    allocate_walled(w);
    w->near = jox_alloc((size_t)w->count, sizeof *w->near);
    list_edges_by_cell(w, reach);
    fill_solids(w, walls);
    for (int i = 0; i < w->count; i++)
        place_node(w, i);
    if (f->storeys) {
        jox_field_block_beyond_floor(w);
        jox_field_slow_stairs(w);
    }
    compute_positions(w);
    for (int r = 0; r < f->rows; r++)
        for (int c = 0; c < f->columns; c++)
            link_cell(w, c, r);
    for (int i = 0; i < w->count; i++)
        find_free_corners(w, i);
    find_even_cells(w);
    jox_field_look_about(w);
    jox_free(w->near);
    jox_field_remember(w, marks);
}
