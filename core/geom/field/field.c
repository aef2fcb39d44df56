#include "geom/field/field.h"

#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "geom/field/field_parts.h"
#include "geom/field/field_sheets.h"

static const float MOST_CELLS = 4000000.0f;
static const float LEAST_CELL = 0.1f, MOST_CELL = 2.0f; /* m */
static const float LEAST_CLEARANCE = 0.05f;             /* m */
static const float FARTHEST = 1e6f;                     /* m: no world is larger */

static void include_place(const JoxPlace *places, uint32_t index, JoxV2 *low, JoxV2 *high) {
    const JoxPlace *place = &places[index];
    for (uint32_t k = 0; k < place->member_count; k++)
        include_place(places, (uint32_t)place->members[k], low, high);
    for (uint32_t k = 0; k < jox_place_goal_points(place); k++) {
        JoxV2 p = place->points[k];
        *low = (JoxV2){jox_minf(low->x, p.x), jox_minf(low->y, p.y)};
        *high = (JoxV2){jox_maxf(high->x, p.x), jox_maxf(high->y, p.y)};
    }
}

/* Sets the box and its cells: bounds are finite and ordered and include the place; cells are of a
   size that can be computed. */
static void set_grid(JoxField *f, const JoxPlace *places, uint32_t place, JoxV2 low, JoxV2 high,
                     float cell) {
    if (!(high.x >= low.x && high.y >= low.y)) {
        low = (JoxV2){INFINITY, INFINITY};
        high = (JoxV2){-INFINITY, -INFINITY};
    }
    include_place(places, place, &low, &high);
    low = (JoxV2){jox_clampf(low.x, -FARTHEST, FARTHEST), jox_clampf(low.y, -FARTHEST, FARTHEST)};
    high = (JoxV2){jox_clampf(high.x, low.x, FARTHEST), jox_clampf(high.y, low.y, FARTHEST)};
    cell = jox_clampf(cell > 0.0f ? cell : LEAST_CELL, LEAST_CELL, MOST_CELL);
    float width = jox_maxf(high.x - low.x, cell), height = jox_maxf(high.y - low.y, cell);
    while ((width / cell + 1.0f) * (height / cell + 1.0f) > MOST_CELLS)
        cell *= 1.1f;
    f->low = low;
    f->size = cell;
    f->columns = (int)ceilf(width / cell);
    f->rows = (int)ceilf(height / cell);
    JOX_ASSERT(f->columns > 0 && f->rows > 0);
}

/* Fills a field whose grid is set. */
static void fill_field(JoxField *f, const JoxWalls *walls, const JoxPlace *places, uint32_t place,
                       float clearance, const JoxFieldCrowd *crowd, const JoxFieldLifts *lifts,
                       JoxFieldMarks **marks) {
    f->clearance = clearance > LEAST_CLEARANCE ? clearance : LEAST_CLEARANCE;
    size_t count = (size_t)f->columns * (size_t)f->rows;
    f->cells = jox_alloc(count, sizeof *f->cells);
    JoxFieldWork work = {.f = f,
                         .count = (int)count,
                         .lifts = lifts,
                         .time = jox_alloc(count, sizeof(float)),
                         .slowness = jox_alloc(count, sizeof(float))};
    JoxFieldMarks *own = NULL;
    if (lifts)
        f->first_stops = jox_alloc(count, sizeof *f->first_stops);
    jox_field_mark(&work, walls, marks ? marks : &own);
    jox_field_crowd(&work, crowd);
    jox_field_march(&work, places, place);
    jox_field_patch(&work);
    jox_field_marks_free(own);
    jox_free(work.time);
    jox_free(work.slowness);
}

JoxField *jox_field_create(const JoxWalls *walls, const JoxPlace *places, uint32_t place, JoxV2 low,
                           JoxV2 high, float cell, float clearance, const JoxFieldCrowd *crowd,
                           const JoxStoreys *storeys, const JoxFieldLifts *lifts,
                           JoxFieldMarks **marks) {
    JoxField *f = jox_alloc(1, sizeof *f);
    if (!jox_has_storeys(storeys)) {
        set_grid(f, places, place, low, high, cell);
        fill_field(f, walls, places, place, clearance, crowd, NULL, marks);
        return f;
    }
    JoxWalls packed_walls = {0};
    JoxFieldCrowd packed_crowd = {0};
    uint32_t count;
    low.y = 0.0f;
    high.y = jox_field_height_of_sheets(storeys, cell);
    set_grid(f, places, place, low, high, cell);
    jox_field_lay_sheets(f, storeys);
    JoxPlace *goal = jox_field_pack_goal(f, places, place, &count);
    jox_field_pack_walls(f, walls, &packed_walls);
    if (crowd)
        jox_field_pack_crowd(f, crowd, &packed_crowd);
    fill_field(f, &packed_walls, goal, 0, clearance, crowd ? &packed_crowd : NULL, lifts, marks);
    jox_places_free_goal(goal, count);
    jox_walls_free(&packed_walls);
    jox_free(packed_crowd.at);
    return f;
}

void jox_field_set_storeys(JoxField *f, const JoxStoreys *storeys) {
    const int rows = f ? f->rows : 0;
    if (!f || !jox_has_storeys(storeys))
        return;
    jox_field_lay_sheets(f, storeys);
    if (f->rows != rows) { /* the field is of other storeys: unused */
        jox_free(f->sheets);
        f->sheets = NULL;
        f->rows = rows;
    }
}

/* ---- sampling ---- */

/* A point in the grid, in cells; points outside the box are moved to the nearest point of the
   box. */
typedef struct GridPoint {
    float x, y;
    int column, row;
    const JoxFieldCell *cell;
    JoxV2 point, beyond; /* m: the point in the box, and the vector to it from a point outside */
} GridPoint;

static GridPoint locate_point(const JoxField *f, JoxV2 p) {
    float x = (p.x - f->low.x) / f->size, y = (p.y - f->low.y) / f->size;
    GridPoint s = {.point = p};
    s.x = x > 0.0f ? jox_minf(x, (float)f->columns) : 0.0f; /* NaN becomes 0 */
    s.y = y > 0.0f ? jox_minf(y, (float)f->rows) : 0.0f;
    if (s.x != x || s.y != y) {
        s.point = (JoxV2){f->low.x + s.x * f->size, f->low.y + s.y * f->size};
        s.beyond = jox_sub(s.point, p);
    }
    s.column = s.x < (float)f->columns ? (int)s.x : f->columns - 1;
    s.row = s.y < (float)f->rows ? (int)s.y : f->rows - 1;
    JOX_ASSERT(s.column >= 0 && s.column < f->columns && s.row >= 0 && s.row < f->rows);
    s.cell = &f->cells[s.row * f->columns + s.column];
    return s;
}

/* Finds the four cell centres around a point, and their weights. */
static void find_corners(const JoxField *f, const GridPoint *s, const JoxFieldCell **cells,
                         float *weights) {
    float x = jox_clampf(s->x - 0.5f, 0.0f, (float)(f->columns - 1));
    float y = jox_clampf(s->y - 0.5f, 0.0f, (float)(f->rows - 1));
    int c = (int)x, r = (int)y;
    int east = c + 1 < f->columns, north = r + 1 < f->rows ? f->columns : 0;
    float u = x - (float)c, v = y - (float)r;
    cells[0] = &f->cells[r * f->columns + c];
    cells[1] = cells[0] + east;
    cells[2] = cells[0] + north;
    cells[3] = cells[2] + east;
    weights[0] = (1.0f - u) * (1.0f - v);
    weights[1] = u * (1.0f - v);
    weights[2] = (1.0f - u) * v;
    weights[3] = u * v;
    JOX_ASSERT(u >= 0.0f && u <= 1.0f && v >= 0.0f && v <= 1.0f);
}

static int find_nearest_sample(const JoxField *f, const GridPoint *s, JoxV2 *sample) {
    int x = (int)((s->x - (float)s->column) * (float)JOX_FIELD_SIDE);
    int y = (int)((s->y - (float)s->row) * (float)JOX_FIELD_SIDE);
    int k = (y < JOX_FIELD_SIDE ? y : JOX_FIELD_SIDE - 1) * JOX_FIELD_SIDE +
            (x < JOX_FIELD_SIDE ? x : JOX_FIELD_SIDE - 1);
    *sample = jox_field_sample(f, s->row * f->columns + s->column, k);
    return k;
}

/* A sample: its position, the direction of the way from it, and the way's length, m. */
typedef struct Sampled {
    JoxV2 at, way;
    float length;
} Sampled;

static bool is_separated(const JoxField *f, const JoxFieldPatch *patch, JoxV2 p, JoxV2 sample) {
    for (uint32_t k = patch->first; k < patch->first + patch->count; k++) {
        JOX_ASSERT(f->refs[k] < f->edge_count);
        const JoxFieldEdge *e = &f->edges[f->refs[k]];
        if (jox_segment_crossing(e->a, e->b, p, sample) != 0)
            return true;
    }
    return false;
}

/* Finds the nearest sample of one patch that no edge separates from a point; false if there is
   none. */
static bool find_nearest_visible_sample(const JoxField *f, const JoxFieldPatch *about, int cell,
                                        JoxV2 p, Sampled *sampled) {
    JOX_ASSERT((uint32_t)f->cells[cell].patch < f->patch_count);
    const JoxFieldPatch *patch = &f->patches[f->cells[cell].patch];
    float least = INFINITY;
    for (int k = 0; k < JOX_FIELD_SAMPLES; k++) {
        JoxV2 at = jox_field_sample(f, cell, k);
        float d2 = jox_length2(jox_sub(at, p));
        if (d2 >= least || patch->on_edge >> k & 1 || is_separated(f, about, p, at))
            continue;
        least = d2;
        *sampled = (Sampled){at, {patch->x[k], patch->y[k]}, patch->length[k]};
    }
    return least < INFINITY;
}

/* Finds the sample that applies to a point near a wall: that of its ninth of the cell, or, if an
   edge passes through that ninth, the nearest sample on the point's side. False if there is
   none. */
static bool find_sample_at_wall(const JoxField *f, const GridPoint *s, Sampled *sampled) {
    int cell = s->row * f->columns + s->column;
    const JoxFieldPatch *patch = &f->patches[s->cell->patch];
    int k = find_nearest_sample(f, s, &sampled->at);
    sampled->way = (JoxV2){patch->x[k], patch->y[k]};
    sampled->length = patch->length[k];
    if (!(patch->cut >> k & 1))
        return true;
    if (!(patch->on_edge >> k & 1) && !is_separated(f, patch, s->point, sampled->at))
        return true;
    if (find_nearest_visible_sample(f, patch, cell, s->point, sampled))
        return true;
    for (int n = 0; n < 8; n++) {
        int other = jox_field_next(f, cell, n);
        if (other >= 0 && f->cells[other].patch >= 0 &&
            find_nearest_visible_sample(f, patch, other, s->point, sampled))
            return true;
    }
    return false;
}

/* Returns jox_field_distance of a point in the grid. */
static float find_distance(const JoxField *f, JoxV2 p) {
    GridPoint s = locate_point(f, p);
    float beyond = jox_length(s.beyond);
    if (s.cell->patch == JOX_FIELD_PLAIN)
        return s.cell->length + beyond;
    if (s.cell->patch >= 0) {
        Sampled sampled;
        if (!find_sample_at_wall(f, &s, &sampled) || !(sampled.length < INFINITY))
            return INFINITY;
        float on = sampled.length - jox_dot(sampled.way, jox_sub(s.point, sampled.at));
        return jox_maxf(0.0f, on) + beyond;
    }
    const JoxFieldCell *cells[4];
    float weights[4], sum = 0.0f, close = JOX_FIELD_CLOSE * f->size;
    JoxV2 ways = {0.0f, 0.0f};
    bool at_goal = true;
    find_corners(f, &s, cells, weights);
    for (int k = 0; k < 4; k++) {
        const JoxFieldCell *cell = cells[k];
        if (!(cell->length < INFINITY))
            return INFINITY;
        /* Full slopes would extrapolate to lengths a little too short, and centres alone give
           lengths too long by the same amount, so half the slope is taken. */
        JoxV2 off = jox_sub(s.point, jox_field_sample(f, (int)(cell - f->cells), JOX_FIELD_MIDDLE));
        sum += weights[k] * (cell->length - 0.5f * jox_field_slope(cell, off));
        ways = jox_add(ways, (JoxV2){weights[k] * cell->x, weights[k] * cell->y});
        at_goal = at_goal && cell->length < close;
    }
    if (at_goal)
        sum = jox_length(ways) * close;
    return jox_maxf(0.0f, sum) + beyond;
}

float jox_field_distance(const JoxField *f, JoxV2 p) {
    return find_distance(f, jox_field_pack(f, p));
}

bool jox_field_first_lift(const JoxField *f, const JoxLift *lifts, uint32_t lift_count, JoxV2 at,
                          uint32_t *lift, uint32_t *stop) {
    const GridPoint s = locate_point(f, jox_field_pack(f, at));
    int cell = s.row * f->columns + s.column;
    for (int n = 0; n < 8 && !(f->cells[cell].length < INFINITY); n++) { /* as by a wall */
        const int other = jox_field_next_to(f, s.column, s.row, n);
        cell = other >= 0 ? other : cell;
    }
    uint32_t number = f->first_stops && f->cells[cell].length < INFINITY ? f->first_stops[cell] : 0;
    for (*lift = 0; *lift < lift_count && number > lifts[*lift].stop_count; ++*lift)
        number -= lifts[*lift].stop_count;
    *stop = number - 1;
    return number > 0 && *lift < lift_count; /* else the field is of other lifts */
}

/* Returns the direction of the way from a point in a cell with a patch. */
static JoxV2 find_direction_at_wall(const JoxField *f, const GridPoint *s) {
    const JoxFieldPatch *patch = &f->patches[s->cell->patch];
    Sampled sampled;
    bool found = find_sample_at_wall(f, s, &sampled);
    JoxV2 ignored, at = s->point;
    if (found &&
        (!(sampled.length < INFINITY) || !(patch->cut >> find_nearest_sample(f, s, &ignored) & 1)))
        return sampled.way;
    /* So close to a wall that the samples do not tell how close: adds a direction off the wall, or
       out of the solid. */
    uint32_t e = 0;
    float near = jox_field_nearest(f, patch->first, patch->first + patch->count, s->point, &at, &e);
    if (near >= f->clearance || near <= 0.0f)
        return found ? sampled.way : (JoxV2){0.0f, 0.0f};
    JoxV2 off = jox_scale(jox_sub(s->point, at), (1.0f - near / f->clearance) / near);
    if (found)
        return jox_unit(jox_add(sampled.way, off));
    JoxV2 along = jox_sub(f->edges[e].b, f->edges[e].a);
    bool within = f->edges[e].solid && jox_det(along, jox_sub(s->point, at)) > 0.0f;
    return jox_unit(jox_scale(off, within ? -1.0f : 1.0f));
}

JoxV2 jox_field_direction(const JoxField *f, JoxV2 p) {
    GridPoint s = locate_point(f, jox_field_pack(f, p));
    JoxV2 way = {s.cell->x, s.cell->y};
    if (s.cell->patch >= 0) {
        way = find_direction_at_wall(f, &s);
    } else if (s.cell->patch == JOX_FIELD_CLEAR) {
        const JoxFieldCell *cells[4];
        float weights[4];
        find_corners(f, &s, cells, weights);
        JoxV2 sum = {0.0f, 0.0f};
        for (int k = 0; k < 4; k++)
            sum = jox_add(sum, (JoxV2){weights[k] * cells[k]->x, weights[k] * cells[k]->y});
        float length2 = jox_length2(sum);
        if (length2 > JOX_FIELD_ARRIVED * JOX_FIELD_ARRIVED)
            way = jox_scale(sum, 1.0f / sqrtf(length2));
        else if (s.cell->length < f->size)
            way = (JoxV2){0.0f, 0.0f}; /* else two ways are equally good: one of them is taken */
    }
    if (s.beyond.x == 0.0f && s.beyond.y == 0.0f)
        return way;
    if (way.x == 0.0f && way.y == 0.0f && !(find_distance(f, s.point) < INFINITY))
        return way;
    /* Outside the box, the way leads to the box; within one cell of it, it turns into the way
       there. */
    float far = jox_length(s.beyond);
    if (!(far < INFINITY))
        return way;
    return jox_unit(jox_add(jox_scale(way, jox_maxf(0.0f, 1.0f - far / f->size)),
                            jox_scale(s.beyond, 1.0f / far)));
}

void jox_field_box(const JoxField *f, JoxV2 *low, JoxV2 *high, float *cell) {
    *cell = f->size;
    *low = f->low;
    /* inside the last cells, so that rounding adds none */
    *high = (JoxV2){f->low.x + ((float)f->columns - 0.5f) * f->size,
                    f->low.y + ((float)f->rows - 0.5f) * f->size};
}

uint32_t jox_field_cells(const JoxField *f) {
    return (uint32_t)(f->columns * f->rows);
}

void jox_field_free(JoxField *f) {
    if (!f)
        return;
    jox_free(f->cells);
    jox_free(f->patches);
    jox_free(f->edges);
    jox_free(f->refs);
    jox_free(f->sheets);
    jox_free(f->first_stops);
    jox_free(f);
}
