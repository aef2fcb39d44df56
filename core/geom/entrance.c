#include "geom/entrance.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/pi.h"

static const float CLEAR = 0.1f;  /* m: least distance from walls at which people can enter */
static const float FINEST = 0.2f; /* m: the smallest cells */
static const float MOST_CELLS = 40000.0f;
static const double ALIKE = 0.9; /* pieces with at least this share of the largest one count as
                                    equally large */

/* ---- the floor ---- */

/* Makes the floor from the place's shape, with room for at least one person: a circle of
   JOX_ENTRANCE_REACH. */
static void lay_floor(JoxEntrance *e, const JoxPlace *place) {
    const double circle = JOX_PI * (double)JOX_ENTRANCE_REACH * (double)JOX_ENTRANCE_REACH;
    JOX_ASSERT(!jox_place_is_set(place));
    jox_place_copy(&e->floor, place);
    e->area = jox_place_floor(place);
    if (e->area < circle) {
        e->area = circle;
        jox_place_make_spot(&e->floor, place->centre, JOX_ENTRANCE_REACH);
    } else if (!jox_place_is_area(place) && !jox_place_is_spot(place)) {
        jox_place_make_line(&e->floor);
    }
    jox_place_finish(&e->floor);
}

static bool is_on_floor(const JoxEntrance *e, JoxV2 p) {
    return jox_place_contains(&e->floor, 0, p);
}

/* Returns whether a point of the floor belongs to the original place. */
static bool belongs_to_place(const JoxPlace *place, float cell, JoxV2 p) {
    if (jox_place_is_area(place))
        return jox_polygon_contains(place->points, place->count, p);
    if (jox_place_is_spot(place))
        return jox_length(jox_sub(p, place->centre)) <= jox_maxf(place->radius, cell);
    const JoxV2 nearest = jox_segment_nearest(place->points[0], place->points[1], p);
    return jox_length(jox_sub(p, nearest)) <= CLEAR;
}

/* ---- cells ---- */

static JoxV2 find_cell_middle(const JoxEntrance *e, uint32_t cell) {
    const float x = (float)(cell % e->columns) + 0.5f, y = (float)(cell / e->columns) + 0.5f;
    return (JoxV2){e->low.x + x * e->cell, e->low.y + y * e->cell};
}

/* Returns the cell at a point, clamped to the box. */
static uint32_t find_floor_cell(const JoxEntrance *e, JoxV2 p) {
    const float x = jox_clampf(floorf((p.x - e->low.x) / e->cell), 0.0f, (float)(e->columns - 1)),
                y = jox_clampf(floorf((p.y - e->low.y) / e->cell), 0.0f, (float)(e->rows - 1));
    return (uint32_t)y * e->columns + (uint32_t)x;
}

/* Finds the corners of the floor's bounding box. */
static void find_box(const JoxEntrance *e, JoxV2 *low, JoxV2 *high) {
    const JoxPlace *floor = &e->floor;
    const float beside = jox_place_is_spot(floor)   ? floor->radius
                         : jox_place_is_line(floor) ? JOX_ENTRANCE_REACH
                                                    : 0.0f;
    jox_bounds(floor->points, floor->count, low, high);
    *low = jox_sub(*low, (JoxV2){beside, beside});
    *high = jox_add(*high, (JoxV2){beside, beside});
}

/* Returns whether an edge of a wall comes near a box. */
static bool has_edges(const JoxWalls *walls, JoxV2 low, JoxV2 high) {
    low = jox_sub(low, (JoxV2){CLEAR, CLEAR});
    high = jox_add(high, (JoxV2){CLEAR, CLEAR});
    for (uint32_t v = 0; v < walls->count; v++)
        if (jox_boxes_meet(low, high, walls->vertices[v].point,
                           walls->vertices[walls->vertices[v].next].point))
            return true;
    return false;
}

static bool has_outlines(const JoxWalls *walls) {
    for (uint32_t r = 0; r < walls->ring_count; r++)
        if (walls->rings[r].outline)
            return true;
    return false;
}

/* Returns the number of closed thin walls around a point: a room within a hall has two. */
static uint32_t count_rooms(const JoxWalls *walls, JoxV2 p) {
    uint32_t rooms = 0;
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        bool closed, twin;
        jox_walls_given(walls, r, &closed, &twin);
        if (!twin)
            continue;
        JoxV2 *points = jox_walls_ring_points(walls, r);
        rooms += jox_polygon_contains(points, walls->rings[r].count, p);
        jox_free(points);
        r++;
    }
    return rooms;
}

/* Classifies a cell by its middle; clear cells are BEYOND until their piece is opened. */
static JoxFloorCell judge_cell(const JoxEntrance *e, bool outlined, JoxV2 p) {
    const JoxWalls *walls = e->grid->walls;
    if (!is_on_floor(e, p))
        return JOX_FLOOR_NONE;
    if (!jox_area_contains(e->index, p))
        return jox_wall_grid_is_near(e->grid, p, CLEAR) ? JOX_FLOOR_TIGHT : JOX_FLOOR_SOLID;
    return outlined && !jox_walls_outline_all(walls, &p, 1) ? JOX_FLOOR_OUTSIDE : JOX_FLOOR_BEYOND;
}

/* ---- pieces ---- */

typedef struct Piece {
    uint32_t first, count; /* range of its cells in a list */
} Piece;

/* Appends the piece of a cell to the list, and marks its cells as listed. */
static Piece gather_piece(const JoxEntrance *e, uint32_t from, bool *listed, uint32_t *list,
                          uint32_t first) {
    Piece piece = {first, 1};
    listed[from] = true;
    list[first] = from;
    for (uint32_t k = first; k < first + piece.count; k++) {
        const uint32_t cell = list[k], x = cell % e->columns, y = cell / e->columns;
        const uint32_t next[] = {x > 0 ? cell - 1 : cell, x + 1 < e->columns ? cell + 1 : cell,
                                 y > 0 ? cell - e->columns : cell,
                                 y + 1 < e->rows ? cell + e->columns : cell};
        for (int n = 0; n < 4; n++) {
            if (listed[next[n]] || e->cells[next[n]] != JOX_FLOOR_BEYOND ||
                jox_wall_grid_has_wall_between(e->grid, find_cell_middle(e, cell),
                                               find_cell_middle(e, next[n])))
                continue;
            listed[next[n]] = true;
            list[first + piece.count++] = next[n];
        }
    }
    return piece;
}

/* Returns whether people enter on the second rather than the first of two equally large pieces. */
static bool is_preferred(const JoxEntrance *e, const uint32_t *list, Piece before, Piece piece) {
    const JoxV2 a = find_cell_middle(e, list[before.first]),
                b = find_cell_middle(e, list[piece.first]);
    const uint32_t rooms_a = count_rooms(e->grid->walls, a),
                   rooms_b = count_rooms(e->grid->walls, b);
    if (rooms_a != rooms_b || !jox_place_is_line(&e->floor))
        return rooms_b > rooms_a;
    const JoxV2 from = e->floor.points[0], way = jox_sub(e->floor.points[1], from);
    return jox_det(way, jox_sub(b, from)) > jox_det(way, jox_sub(a, from));
}

/* Opens the cells of the piece on which people enter. */
static void open_piece(JoxEntrance *e) {
    const uint32_t all = e->columns * e->rows;
    uint32_t *list = jox_alloc(all, sizeof *list), listed_count = 0, most = 0;
    bool *listed = jox_alloc(all, sizeof *listed);
    Piece *pieces = NULL, best = {0};
    uint32_t count = 0, capacity = 0;
    for (uint32_t cell = 0; cell < all; cell++) {
        if (listed[cell] || e->cells[cell] != JOX_FLOOR_BEYOND)
            continue;
        JOX_RESERVE(pieces, capacity, count + 1);
        pieces[count] = gather_piece(e, cell, listed, list, listed_count);
        listed_count += pieces[count].count;
        most = pieces[count].count > most ? pieces[count].count : most;
        count++;
    }
    for (uint32_t n = 0; n < count; n++)
        if (pieces[n].count >= ALIKE * most &&
            (best.count == 0 || is_preferred(e, list, best, pieces[n])))
            best = pieces[n];
    e->open = jox_alloc((size_t)best.count + 1, sizeof *e->open);
    for (uint32_t k = 0; k < best.count; k++) {
        e->open[e->open_count++] = list[best.first + k];
        e->cells[list[best.first + k]] = JOX_FLOOR_OPEN;
    }
    jox_free(pieces);
    jox_free(listed);
    jox_free(list);
}

/* Returns whether walls cut the floor, apart from the margin next to them. */
static bool is_floor_cut(const JoxEntrance *e) {
    for (uint32_t cell = 0; cell < e->columns * e->rows; cell++)
        if (e->cells[cell] == JOX_FLOOR_SOLID || e->cells[cell] == JOX_FLOOR_OUTSIDE ||
            e->cells[cell] == JOX_FLOOR_BEYOND)
            return true;
    return e->open_count == 0;
}

/* Measures the shares of the place that are blocked or outside, and the area of open cells. */
static void measure_shares(JoxEntrance *e, const JoxPlace *place) {
    uint32_t given = 0, blocked = 0, outside = 0;
    for (uint32_t cell = 0; cell < e->columns * e->rows; cell++) {
        const JoxFloorCell is = e->cells[cell];
        if (is == JOX_FLOOR_NONE || !belongs_to_place(place, e->cell, find_cell_middle(e, cell)))
            continue;
        given++;
        outside += is == JOX_FLOOR_OUTSIDE;
        blocked += is == JOX_FLOOR_OUTSIDE || is == JOX_FLOOR_SOLID || is == JOX_FLOOR_BEYOND;
    }
    e->blocked = given ? (double)blocked / given : 0.0;
    e->outside = given ? (double)outside / given : 0.0;
    e->area = (double)e->open_count * (double)e->cell * (double)e->cell;
}

void jox_entrance_make(JoxEntrance *e, const JoxStoreys *storeys, JoxWallGrid *grid,
                       const JoxPlace *place) {
    static const uint32_t FLOOR[] = {0};
    const JoxWalls *walls = grid->walls;
    JoxV2 high;
    *e = (JoxEntrance){.grid = grid};
    lay_floor(e, place);
    if (!walls || walls->count == 0)
        return;
    const bool outlined = has_outlines(walls);
    find_box(e, &e->low, &high);
    if (!has_edges(walls, e->low, high) && !jox_walls_contain(walls, e->floor.centre) &&
        !(outlined && !jox_walls_outline_all(walls, &e->floor.centre, 1)))
        return;
    const JoxV2 size = jox_sub(high, e->low);
    e->cell = jox_maxf(FINEST, sqrtf(size.x * size.y / MOST_CELLS));
    e->columns = (uint32_t)(size.x / e->cell) + 1;
    e->rows = (uint32_t)(size.y / e->cell) + 1;
    jox_wall_grid_fit(grid, 1.5f * e->cell);
    e->clear = (JoxArea){.places = &e->floor,
                         .in = FLOOR,
                         .in_count = 1,
                         .walls = walls,
                         .storeys = storeys,
                         .clear = CLEAR};
    e->index = jox_area_index(&e->clear);
    e->cells = jox_alloc((size_t)e->columns * e->rows, sizeof *e->cells);
    for (uint32_t cell = 0; cell < e->columns * e->rows; cell++)
        e->cells[cell] = judge_cell(e, outlined, find_cell_middle(e, cell));
    open_piece(e);
    e->cut = is_floor_cut(e);
    if (e->cut)
        measure_shares(e, place);
}

void jox_entrance_free(JoxEntrance *e) {
    if (e->index)
        jox_area_index_free(e->index);
    jox_place_free(&e->floor);
    jox_free(e->cells);
    jox_free(e->open);
    *e = (JoxEntrance){0};
}

/* ---- points ---- */

bool jox_entrance_holds(const JoxEntrance *e, JoxV2 p) {
    if (!is_on_floor(e, p) || !e->cut)
        return is_on_floor(e, p);
    const JoxFloorCell is = e->cells[find_floor_cell(e, p)];
    return is != JOX_FLOOR_BEYOND && is != JOX_FLOOR_SOLID && is != JOX_FLOOR_OUTSIDE;
}

bool jox_entrance_is_open(const JoxEntrance *e, JoxV2 p) {
    if (!e->cut)
        return true;
    if (!jox_area_contains(e->index, p))
        return false;
    const int32_t x = (int32_t)floorf((p.x - e->low.x) / e->cell),
                  y = (int32_t)floorf((p.y - e->low.y) / e->cell);
    for (int32_t row = y - 1; row <= y + 1; row++)
        for (int32_t column = x - 1; column <= x + 1; column++) {
            if (column < 0 || row < 0 || column >= (int32_t)e->columns || row >= (int32_t)e->rows)
                continue;
            const uint32_t cell = (uint32_t)row * e->columns + (uint32_t)column;
            if (e->cells[cell] == JOX_FLOOR_OPEN &&
                !jox_wall_grid_has_wall_between(e->grid, p, find_cell_middle(e, cell)))
                return true;
        }
    return false;
}

JoxV2 jox_entrance_pick(const JoxEntrance *e, double share) {
    JOX_ASSERT(e->open_count > 0 && share >= 0.0 && share < 1.0);
    return find_cell_middle(e, e->open[(uint32_t)(share * e->open_count)]);
}
