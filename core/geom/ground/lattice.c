/* Makes staggered lattices of spots to stand on; see lattice.h. */
#include "geom/ground/lattice.h"

#include <math.h>

#include "base/assert.h"
#include "base/mem.h"

enum {
    MOST_CELLS = 1 << 18
}; /* greatest number of lattice points; larger areas get a wider
      spacing */
static const float ROW_PITCH = 0.8660254f; /* distance of rows in a staggered lattice, in
                                              spacings */

/* A lattice seen towards its front: row 0 in front, columns from right to left. */
typedef struct Frame {
    JoxV2 ahead, left;  /* unit vectors */
    float front, right; /* m: coordinates of row 0 along `ahead` and of column 0 along `left` */
    float spacing;      /* m */
    uint32_t rows, columns;
} Frame;

static Frame make_frame(const JoxPlace *place, JoxV2 ahead, float spacing) {
    Frame l = {.ahead = ahead, .left = jox_left(ahead), .spacing = spacing};
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
    /* The remainder of whole rows and columns is divided between both sides. */
    l.front = high.x - 0.5f * (depth - (float)(l.rows - 1) * ROW_PITCH * l.spacing);
    if (l.rows > 1) /* the front is filled first, so it is as close as the sides */
        l.front = jox_maxf(l.front, high.x - 0.5f * l.spacing);
    l.right = low.y + 0.5f * (width - (float)(l.columns - 1) * l.spacing);
    return l;
}

static JoxV2 find_lattice_point(const Frame *l, uint32_t row, uint32_t column) {
    const float shift = row & 1 ? 0.5f : 0.0f;
    const float x = l->front - (float)row * ROW_PITCH * l->spacing;
    const float y = l->right + ((float)column + shift) * l->spacing;
    return jox_add(jox_scale(l->ahead, x), jox_scale(l->left, y));
}

static bool is_clear_of_edges(const JoxStandable *ground, JoxV2 p, float clear) {
    for (uint32_t e = 0; e < ground->edge_count; e++) {
        const JoxV2 on = jox_segment_nearest(ground->edges[2 * e], ground->edges[2 * e + 1], p);
        if (jox_length2(jox_sub(on, p)) < clear * clear)
            return false;
    }
    return true;
}

void jox_lattice_lay(JoxLattice *s, const JoxPlace *place, const JoxStandable *ground,
                     uint32_t part, JoxV2 ahead, float spacing, float clear) {
    JOX_ASSERT(jox_place_is_area(place) && spacing > 0.0f);
    const Frame l = make_frame(place, ahead, spacing);
    JOX_RESERVE(s->at, s->capacity, l.rows * l.columns);
    JOX_RESERVE(s->row_first, s->row_capacity, l.rows + 1);
    s->count = s->row_count = 0;
    for (uint32_t row = 0; row < l.rows; row++) {
        const uint32_t first = s->count;
        for (uint32_t column = 0; column < l.columns; column++) {
            const JoxV2 p = find_lattice_point(&l, row, column);
            if (jox_polygon_contains(place->points, place->count, p) &&
                jox_standable_part(ground, jox_standable_cell(ground, p)) == part &&
                is_clear_of_edges(ground, p, clear))
                s->at[s->count++] = p;
        }
        if (s->count > first)
            s->row_first[s->row_count++] = first;
    }
    s->row_first[s->row_count] = s->count;
}

void jox_lattice_free(JoxLattice *s) {
    jox_free(s->at);
    jox_free(s->row_first);
    *s = (JoxLattice){0};
}
