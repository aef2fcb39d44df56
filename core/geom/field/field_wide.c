/* Kernel of field lookups; each lane is a point. Points outside the box, and points in a ninth of a
   cell that an edge crosses, are left to the scalar code of field.c. */
#include <math.h>

#include "geom/field/field_parts.h"
#include "simd/vectors.h"

enum {
    PATCH_Y = offsetof(JoxFieldPatch, y) / sizeof(float),
    PATCH_LENGTH = offsetof(JoxFieldPatch, length) / sizeof(float),
    PATCH_CUT = offsetof(JoxFieldPatch, cut) / sizeof(float)
};
_Static_assert(sizeof(JoxFieldCell) == 4 * sizeof(float) &&
                   offsetof(JoxFieldCell, patch) == 3 * sizeof(float),
               "a cell is a record of lanes");
_Static_assert(sizeof(JoxFieldPatch) == 30 * sizeof(float), "as find_patch_offsets counts");
_Static_assert(offsetof(JoxFieldPatch, cut) % sizeof(float) == 0 &&
                   offsetof(JoxFieldPatch, on_edge) == offsetof(JoxFieldPatch, cut) + 2,
               "`cut` is the lower half of a word");

/* Points in the grid: m, and in cells. */
typedef struct Spot {
    JoxVector at, in_cells;
    JoxInts column, row, cell;
} Spot;

/* A way: direction, and length in m. */
typedef struct Way {
    JoxVector direction;
    JoxFloats length;
} Way;

static inline JoxFloats find_cell_lanes(const JoxField *f, JoxInts row, JoxFloats column) {
    /* exact: there are fewer cells than integers that a float can represent */
    return ji_to_floats(row) * (float)f->columns + column;
}

static inline JoxInts clamp_to_index(JoxFloats x, int most) {
    JoxInts whole = jf_to_ints(x);
    return ji_select(ji_less(whole, ji_set(most)), whole, ji_set(most));
}

/* Returns where points lie along y in the grid of a field over storeys, as jox_field_pack. */
static JoxFloats pack_lanes(const JoxField *f, JoxFloats y) {
    float at[JOX_WIDTH];
    jf_store(at, y);
    for (uint32_t lane = 0; lane < JOX_WIDTH; lane++)
        at[lane] = jox_field_pack(f, (JoxV2){0.0f, at[lane]}).y;
    return jf_load(at);
}

/* Does the same as locate_point of field.c; lanes outside the box are in no cell. */
static inline JoxMask locate_lanes(const JoxField *f, JoxVector p, Spot *s) {
    const JoxFloats zero = jf_set(0.0f), size = jf_set(f->size);
    if (f->sheets)
        p.y = pack_lanes(f, p.y);
    s->at = p;
    s->in_cells = (JoxVector){(p.x - f->low.x) / size, (p.y - f->low.y) / size};
    JoxMask within = jm_and(jf_le(zero, s->in_cells.x), jf_le(zero, s->in_cells.y));
    within = jm_and(within, jm_and(jf_le(s->in_cells.x, jf_set((float)f->columns)),
                                   jf_le(s->in_cells.y, jf_set((float)f->rows))));
    s->in_cells = jv_select(within, s->in_cells, (JoxVector){zero, zero});
    s->column = clamp_to_index(s->in_cells.x, f->columns - 1);
    s->row = clamp_to_index(s->in_cells.y, f->rows - 1);
    s->cell = jf_to_ints(find_cell_lanes(f, s->row, ji_to_floats(s->column)));
    return within;
}

static inline JoxVector unit_lanes(JoxVector a) {
    const JoxFloats zero = jf_set(0.0f), length = jf_sqrt(jv_dot(a, a));
    return jv_select(jf_lt(zero, length), jv_scale(a, 1.0f / length), (JoxVector){zero, zero});
}

/* ---- between four centres ---- */

typedef struct Corners {
    JoxInts cell[4], column[2], row[2]; /* columns: west and east; rows: south and north */
    JoxFloats weight[4];
} Corners;

static inline Corners find_corner_lanes(const JoxField *f, const Spot *s) {
    const JoxFloats zero = jf_set(0.0f), half = jf_set(0.5f), one = jf_set(1.0f);
    const JoxFloats x = jf_min(jf_max(s->in_cells.x - half, zero), jf_set((float)(f->columns - 1)));
    const JoxFloats y = jf_min(jf_max(s->in_cells.y - half, zero), jf_set((float)(f->rows - 1)));
    Corners c = {.column = {jf_to_ints(x)}, .row = {jf_to_ints(y)}};
    const JoxInts last_column = ji_set(f->columns - 1), last_row = ji_set(f->rows - 1);
    c.column[1] =
        ji_select(ji_less(c.column[0], last_column), ji_add(c.column[0], ji_set(1)), c.column[0]);
    c.row[1] = ji_select(ji_less(c.row[0], last_row), ji_add(c.row[0], ji_set(1)), c.row[0]);
    for (int k = 0; k < 4; k++)
        c.cell[k] = jf_to_ints(find_cell_lanes(f, c.row[k >> 1], ji_to_floats(c.column[k & 1])));
    const JoxFloats u = x - ji_to_floats(c.column[0]);
    const JoxFloats v = y - ji_to_floats(c.row[0]);
    const JoxFloats rest_u = one - u, rest_v = one - v;
    c.weight[0] = rest_u * rest_v;
    c.weight[1] = u * rest_v;
    c.weight[2] = rest_u * v;
    c.weight[3] = u * v;
    return c;
}

/* Returns the centres of cells along one axis, m. */
static inline JoxFloats find_centres(JoxInts number, float low, float size) {
    const JoxFloats cells = ji_to_floats(number) + 0.5f;
    return low + cells * size;
}

/* Interpolates like jox_field_direction and jox_field_distance. `here`: way of each point's
   cell. */
static inline Way interpolate_lanes(const JoxField *f, const Spot *s, const Way *here) {
    const JoxFloats zero = jf_set(0.0f), one = jf_set(1.0f), size = jf_set(f->size);
    const JoxFloats infinite = jf_set(INFINITY), close = jf_set(JOX_FIELD_CLOSE * f->size);
    const Corners c = find_corner_lanes(f, s);
    JoxVector sum = {zero, zero};
    JoxFloats length = zero;
    JoxMask at_goal = jm_of_bits(~0u), reached = at_goal;
    for (int k = 0; k < 4; k++) {
        JoxFloats cell[4];
        jf_records(&f->cells[0].length, c.cell[k], cell);
        const JoxVector way = {cell[1], cell[2]};
        const JoxVector off = {s->at.x - find_centres(c.column[k & 1], f->low.x, f->size),
                               s->at.y - find_centres(c.row[k >> 1], f->low.y, f->size)};
        const JoxFloats slope = 0.5f * jv_dot(unit_lanes(way), off);
        length += c.weight[k] * (cell[0] - slope);
        sum = jv_add(sum, (JoxVector){c.weight[k] * way.x, c.weight[k] * way.y});
        reached = jm_and(reached, jf_lt(cell[0], infinite));
        at_goal = jm_and(at_goal, jf_lt(cell[0], close));
    }
    const JoxFloats length2 = jv_dot(sum, sum), along = jf_sqrt(length2);
    const JoxMask leads = jf_lt(jf_set(JOX_FIELD_ARRIVED * JOX_FIELD_ARRIVED), length2);
    JoxVector way = jv_scale(sum, one / along);
    const JoxVector else_way =
        jv_select(jf_lt(here->length, size), (JoxVector){zero, zero}, here->direction);
    way = jv_select(leads, way, else_way);
    length = jf_max(zero, jf_select(at_goal, along * close, length));
    return (Way){way, jf_select(reached, length, infinite)};
}

/* ---- at walls ---- */

/* Returns the offset of a patch in floats, 30 each. */
static inline JoxInts find_patch_offsets(JoxInts patch) {
    return ji_sub(ji_shift_left(patch, 5), ji_shift_left(patch, 1));
}

/* Looks up the samples of the ninths that contain the points. `near`: lanes in cells with a patch;
   `patch`: its index by lane. `passed` receives the lanes whose ninth an edge crosses. */
static inline Way look_up_patches(const JoxField *f, const Spot *s, JoxMask near, JoxInts patch,
                                  JoxMask *passed) {
    const JoxFloats side = jf_set((float)JOX_FIELD_SIDE), half = jf_set(0.5f);
    const JoxFloats column = ji_to_floats(s->column), row = ji_to_floats(s->row);
    const JoxInts x = clamp_to_index((s->in_cells.x - column) * side, JOX_FIELD_SIDE - 1);
    const JoxInts y = clamp_to_index((s->in_cells.y - row) * side, JOX_FIELD_SIDE - 1);
    const JoxInts sample = ji_add(x, ji_add(y, ji_add(y, y)));
    const JoxInts first = find_patch_offsets(ji_select(near, patch, ji_set(0)));
    const JoxInts at = ji_add(first, sample);
    const float *table = f->patches[0].x;
    uint32_t words[JOX_WIDTH], samples[JOX_WIDTH], cut = 0;
    ji_store(words, ji_pick((const uint32_t *)(const void *)(table + PATCH_CUT), first));
    ji_store(samples, sample);
    for (uint32_t lane = 0; lane < JOX_WIDTH; lane++)
        cut |= (words[lane] >> samples[lane] & 1) << lane;
    *passed = jm_and(near, jm_of_bits(cut));
    const JoxVector way = {jf_pick(table, at), jf_pick(table + PATCH_Y, at)};
    const JoxFloats length = jf_pick(table + PATCH_LENGTH, at);
    const JoxVector in_cells = {column + (ji_to_floats(x) + half) / side,
                                row + (ji_to_floats(y) + half) / side};
    const JoxVector from = {f->low.x + in_cells.x * f->size, f->low.y + in_cells.y * f->size};
    const JoxFloats on = length - jv_dot(way, jv_sub(s->at, from));
    const JoxFloats infinite = jf_set(INFINITY);
    return (Way){way, jf_select(jf_lt(length, infinite), jf_max(jf_set(0.0f), on), infinite)};
}

/* ---- lookup ---- */

static inline JoxMask look_up_lanes(const JoxField *f, JoxVector p, Way *way) {
    Spot s;
    JoxFloats cell[4];
    JoxMask done = locate_lanes(f, p, &s);
    jf_records(&f->cells[0].length, s.cell, cell);
    const Way here = {{cell[1], cell[2]}, cell[0]};
    const JoxInts patch = jf_bits(cell[3]);
    *way = here;
    const JoxMask clear = ji_equal(patch, ji_set(JOX_FIELD_CLEAR));
    if (jm_bits(clear)) {
        const Way between = interpolate_lanes(f, &s, &here);
        way->direction = jv_select(clear, between.direction, way->direction);
        way->length = jf_select(clear, between.length, way->length);
    }
    const JoxMask near = ji_less(ji_set(-1), patch);
    if (jm_bits(near)) {
        JoxMask passed;
        const Way sampled = look_up_patches(f, &s, near, patch, &passed);
        way->direction = jv_select(near, sampled.direction, way->direction);
        way->length = jf_select(near, sampled.length, way->length);
        done = jm_without(done, passed);
    }
    return done;
}

void JOX_WIDE(jox_field_look)(const JoxField *f, JoxFieldPoints *points) {
    for (uint32_t n = 0; n < points->count; n += JOX_WIDTH) {
        Way way;
        const uint32_t asked = jox_first_lanes(points->count - n);
        const uint32_t done = jm_bits(look_up_lanes(f, jv_load(points->x, points->y, n), &way));
        jv_store(points->way_x, points->way_y, n, way.direction);
        jf_store(points->length + n, way.length);
        for (uint32_t lanes = asked & ~done; lanes; lanes &= lanes - 1) {
            const uint32_t k = n + (uint32_t)__builtin_ctz(lanes);
            const JoxV2 p = {points->x[k], points->y[k]}, direction = jox_field_direction(f, p);
            points->way_x[k] = direction.x;
            points->way_y[k] = direction.y;
            points->length[k] = jox_field_distance(f, p);
        }
    }
}
