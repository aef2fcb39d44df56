/* Spots to stand on in a polygon. */
#include "geom/lattice.h"

#include <math.h>

#include "base/assert.h"
#include "base/mem.h"

enum { MOST_CELLS = 1 << 18 }; /* of a lattice; in a larger area spots are farther apart */
static const float ROW_PITCH = 0.8660254f; /* spacings between rows of a staggered lattice */

/* A lattice as one looks to its front: row 0 in front, columns from right to left. */
typedef struct Frame {
    JoxV2 ahead, left;  /* unit vectors */
    float front, right; /* m, coordinates along them of row 0 and of column 0 */
    float spacing;      /* m */
    uint32_t rows, columns;
    const JoxWalls *walls;
    uint32_t edge_count;
} Frame;

/* part[] of a cell that is no spot, and of one not reached yet; else the number of its part. */
enum { NO_SPOT = UINT32_MAX, UNREACHED = UINT32_MAX - 1 };

static Frame make_frame(const JoxPlace *place, const JoxWalls *walls, JoxV2 ahead, float spacing) {
    Frame l = {.ahead = ahead, .left = jox_left(ahead), .spacing = spacing, .walls = walls};
    JoxV2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (uint32_t k = 0; k < place->count; k++) {
        const JoxV2 p = {jox_dot(place->points[k], l.ahead), jox_dot(place->points[k], l.left)};
        low = jox_v2(jox_minf(low.x, p.x), jox_minf(low.y, p.y));
        high = jox_v2(jox_maxf(high.x, p.x), jox_maxf(high.y, p.y));
    }
    const float depth = high.x - low.x, width = high.y - low.y;
    l.spacing = jox_maxf(spacing, sqrtf(depth * width / (ROW_PITCH * MOST_CELLS)) * 1.01f);
    l.rows = (uint32_t)(depth / (ROW_PITCH * l.spacing)) + 1;
    l.columns = (uint32_t)(width / l.spacing) + 1;
    /* What is left of whole rows and columns is shared between both sides. */
    l.front = high.x - 0.5f * (depth - (float)(l.rows - 1) * ROW_PITCH * l.spacing);
    if (l.rows > 1) /* the front is filled first: it is as near as the sides are */
        l.front = jox_maxf(l.front, high.x - 0.5f * l.spacing);
    l.right = low.y + 0.5f * (width - (float)(l.columns - 1) * l.spacing);
    return l;
}

static JoxV2 cell_point(const Frame *l, uint32_t row, uint32_t column) {
    const float shift = row & 1 ? 0.5f : 0.0f;
    const float x = l->front - (float)row * ROW_PITCH * l->spacing;
    const float y = l->right + ((float)column + shift) * l->spacing;
    return jox_add(jox_scale(l->ahead, x), jox_scale(l->left, y));
}

static bool is_in_ring(const JoxWalls *walls, const struct JoxWallRing *ring, JoxV2 p) {
    bool in = false;
    for (uint32_t k = 0; k < ring->count; k++) {
        const JoxV2 a = walls->vertices[ring->first + k].point;
        const JoxV2 b = walls->vertices[ring->first + (k + 1) % ring->count].point;
        if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x)
            in = !in;
    }
    return in;
}

static bool is_in_solid(const JoxWalls *walls, JoxV2 p) {
    for (uint32_t r = 0; walls && r < walls->ring_count; r++)
        if (walls->rings[r].solid && !walls->rings[r].open &&
            is_in_ring(walls, &walls->rings[r], p))
            return true;
    return false;
}

/* The edges of walls within reach of the polygon. */
static uint32_t find_edges(JoxLattice *s, const JoxPlace *place, const JoxWalls *walls,
                           float clear) {
    const JoxV2 reach = {clear, clear};
    const JoxV2 low = jox_sub(place->low, reach), high = jox_add(place->high, reach);
    uint32_t count = 0;
    for (uint32_t r = 0; walls && r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        for (uint32_t k = 0; !ring->open && k < ring->count; k++) {
            const JoxWallVertex *v = &walls->vertices[ring->first + k];
            const JoxV2 a = v->point, b = walls->vertices[v->next].point;
            if (jox_maxf(a.x, b.x) < low.x || jox_minf(a.x, b.x) > high.x ||
                jox_maxf(a.y, b.y) < low.y || jox_minf(a.y, b.y) > high.y)
                continue;
            JOX_RESERVE(s->edges, s->edge_capacity, 2 * (size_t)count + 2);
            s->edges[2 * count] = a;
            s->edges[2 * count + 1] = b;
            count++;
        }
    }
    return count;
}

static bool is_clear(const JoxLattice *s, const Frame *l, JoxV2 p, float clear) {
    for (uint32_t e = 0; e < l->edge_count; e++) {
        const JoxV2 on = jox_segment_nearest(s->edges[2 * e], s->edges[2 * e + 1], p);
        if (jox_length2(jox_sub(on, p)) < clear * clear)
            return false;
    }
    return !is_in_solid(l->walls, p);
}

static bool is_way_free(const JoxLattice *s, const Frame *l, JoxV2 from, JoxV2 to) {
    for (uint32_t e = 0; e < l->edge_count; e++)
        if (jox_segment_crossing(s->edges[2 * e], s->edges[2 * e + 1], from, to))
            return false;
    return true;
}

/* Gives a cell and all that can be reached from it, step by step, the number of their part. Returns
   how many they are. */
static uint32_t fill_part(JoxLattice *s, const Frame *l, uint32_t cell, uint32_t number) {
    static const int STEPS[2][6][2] = {
        {{0, 1}, {0, -1}, {1, 0}, {1, -1}, {-1, 0}, {-1, -1}}, /* row, column from even rows */
        {{0, 1}, {0, -1}, {1, 0}, {1, 1}, {-1, 0}, {-1, 1}}};
    uint32_t open = 0, found = 1;
    s->part[cell] = number;
    s->open[open++] = cell;
    while (open) {
        cell = s->open[--open];
        const uint32_t row = cell / l->columns, column = cell % l->columns;
        for (int k = 0; k < 6; k++) {
            const uint32_t r = row + (uint32_t)STEPS[row & 1][k][0];
            const uint32_t c = column + (uint32_t)STEPS[row & 1][k][1];
            if (r >= l->rows || c >= l->columns || s->part[r * l->columns + c] != UNREACHED ||
                !is_way_free(s, l, cell_point(l, row, column), cell_point(l, r, c)))
                continue;
            s->part[r * l->columns + c] = number;
            s->open[open++] = r * l->columns + c;
            found++;
        }
    }
    return found;
}

/* The number of the largest part. */
static uint32_t find_parts(JoxLattice *s, const Frame *l) {
    uint32_t number = 0, largest = 0, most = 0;
    for (uint32_t cell = 0; cell < l->rows * l->columns; cell++) {
        if (s->part[cell] != UNREACHED)
            continue;
        const uint32_t found = fill_part(s, l, cell, number);
        if (found > most) {
            most = found;
            largest = number;
        }
        number++;
    }
    return largest;
}

void jox_lattice_lay(JoxLattice *s, const JoxPlace *place, const JoxWalls *walls, JoxV2 ahead,
                     float spacing, float clear) {
    JOX_ASSERT(place->kind == JOX_PLACE_POLYGON && spacing > 0.0f);
    Frame l = make_frame(place, walls, ahead, spacing);
    const uint32_t cells = l.rows * l.columns;
    l.edge_count = find_edges(s, place, walls, clear);
    JOX_RESERVE(s->part, s->part_capacity, cells);
    JOX_RESERVE(s->open, s->open_capacity, cells);
    JOX_RESERVE(s->at, s->capacity, cells);
    JOX_RESERVE(s->row_first, s->row_capacity, l.rows + 1);
    for (uint32_t cell = 0; cell < cells; cell++) {
        const JoxV2 p = cell_point(&l, cell / l.columns, cell % l.columns);
        const bool stands =
            jox_polygon_contains(place->points, place->count, p) && is_clear(s, &l, p, clear);
        s->part[cell] = stands ? UNREACHED : NO_SPOT;
    }
    const uint32_t largest = find_parts(s, &l);
    s->count = s->row_count = 0;
    for (uint32_t cell = 0; cell < cells; cell++) {
        const uint32_t first = s->row_count ? s->row_first[s->row_count - 1] : 0;
        if (cell % l.columns == 0 && (s->row_count == 0 || s->count > first)) /* no empty rows */
            s->row_first[s->row_count++] = s->count;
        if (s->part[cell] == largest)
            s->at[s->count++] = cell_point(&l, cell / l.columns, cell % l.columns);
    }
    if (s->row_count && s->row_first[s->row_count - 1] == s->count)
        s->row_count--;
    s->row_first[s->row_count] = s->count;
}

void jox_lattice_free(JoxLattice *s) {
    jox_free(s->at);
    jox_free(s->row_first);
    jox_free(s->edges);
    jox_free(s->part);
    jox_free(s->open);
    *s = (JoxLattice){0};
}
