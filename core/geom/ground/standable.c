/* Finds cells in which people can stand, by their distance from walls, and ways over them. Adjacent
   cells are less than two clearances apart, so no wall lies between two free ones. */
#include "geom/ground/standable.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "base/number/pi.h"
#include "geom/polygon.h"

static const float CELL = 0.28f;   /* m */
static const float CLEAR = 0.72f;  /* cells: least distance of free cells from walls, more than half
                                      a diagonal */
static const float SAMPLES = 2.0f; /* tests per cell along a straight way */
enum { WAYS = 4096, CORNERS = 12 };

/* ---- cells ---- */

static void append_ground_edge(JoxStandable *s, JoxV2 a, JoxV2 b, JoxV2 low, JoxV2 high) {
    if (!jox_boxes_meet(a, b, low, high))
        return;
    JOX_RESERVE(s->edges, s->edge_capacity, 2 * (size_t)s->edge_count + 2);
    s->edges[2 * s->edge_count] = a;
    s->edges[2 * s->edge_count + 1] = b;
    s->edge_count++;
}

bool jox_standable_is_fixed(const JoxObject *o) {
    return o->live && o->in_band && !o->moves && !o->kinematic && !o->held;
}

static void append_body_edges(JoxStandable *s, const JoxObject *o, JoxV2 low, JoxV2 high) {
    JoxV2 ring[JOX_FOOTPRINT_POINTS];
    _Static_assert(CORNERS <= (int)JOX_FOOTPRINT_POINTS, "room for a circle");
    uint32_t count = o->footprint_count;
    for (uint32_t k = 0; k < count; k++)
        ring[k] = o->footprint[k];
    for (uint32_t k = 0; count == 0 && k < CORNERS; k++) {
        const double angle = JOX_TURN * k / CORNERS;
        ring[k] = jox_v2(o->position.x + o->round * (float)jox_cos(angle),
                         o->position.y + o->round * (float)jox_sin(angle));
    }
    count = count ? count : CORNERS;
    for (uint32_t k = 0; k < count; k++)
        append_ground_edge(s, ring[k], ring[(k + 1) % count], low, high);
}

static void append_wall_edges(JoxStandable *s, JoxV2 low, JoxV2 high, const JoxWalls *walls) {
    for (uint32_t r = 0; walls && r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        for (uint32_t v = ring->first; !ring->open && v < ring->first + ring->count; v++)
            if (!walls->vertices[v].absent)
                append_ground_edge(s, walls->vertices[v].point,
                                   walls->vertices[walls->vertices[v].next].point, low, high);
    }
}

static void collect_edges(JoxStandable *s, JoxV2 low, JoxV2 high, const JoxWalls *walls,
                          const JoxWalls *images, const JoxObjects *objects) {
    s->edge_count = 0;
    append_wall_edges(s, low, high, walls);
    append_wall_edges(s, low, high, images);
    for (uint32_t row = 0; objects && row < objects->count; row++)
        if (jox_standable_is_fixed(&objects->rows[row]))
            append_body_edges(s, &objects->rows[row], low, high);
}

static JoxV2 cell_middle(const JoxStandable *s, uint32_t cell) {
    return jox_v2(s->low.x + ((float)(cell % s->columns) + 0.5f) * s->cell,
                  s->low.y + ((float)(cell / s->columns) + 0.5f) * s->cell);
}

/* Returns the column or row of a coordinate, clamped to the grid. */
static uint32_t clamp_index(float at, float low, float cell, uint32_t count) {
    return (uint32_t)jox_clampf((at - low) / cell, 0.0f, (float)(count - 1));
}

/* Blocks the cells near an edge. */
static void block_cells(JoxStandable *s, JoxV2 a, JoxV2 b) {
    const float clear = CLEAR * s->cell;
    const uint32_t left = clamp_index(jox_minf(a.x, b.x) - clear, s->low.x, s->cell, s->columns);
    const uint32_t right = clamp_index(jox_maxf(a.x, b.x) + clear, s->low.x, s->cell, s->columns);
    const uint32_t top = clamp_index(jox_maxf(a.y, b.y) + clear, s->low.y, s->cell, s->rows);
    uint32_t row = clamp_index(jox_minf(a.y, b.y) - clear, s->low.y, s->cell, s->rows);
    for (; row <= top; row++)
        for (uint32_t column = left; column <= right; column++) {
            const uint32_t cell = row * s->columns + column;
            const JoxV2 p = cell_middle(s, cell), on = jox_segment_nearest(a, b, p);
            if (jox_length2(jox_sub(on, p)) < clear * clear)
                s->part[cell] = 0;
        }
}

static const int8_t RING[8][2] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                  {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};

/* Returns neighbour `k` on the grid, JOX_NO_CELL beyond its border. */
static uint32_t grid_neighbour(const JoxStandable *s, uint32_t cell, int k) {
    const uint32_t column = cell % s->columns + (uint32_t)RING[k][0];
    const uint32_t row = cell / s->columns + (uint32_t)RING[k][1];
    return column < s->columns && row < s->rows ? row * s->columns + column : JOX_NO_CELL;
}

enum { FREE = UINT32_MAX, WITHIN = UINT32_MAX - 1 }; /* not numbered yet */

/* Floods cells of one kind from the listed ones, breadth first: each gets the number of the cell
   that it was reached from. */
static void spread_numbers(JoxStandable *s, uint32_t kind, uint32_t listed) {
    for (uint32_t at = 0; at < listed; at++)
        for (int k = 0; k < 8; k++) {
            const uint32_t next = grid_neighbour(s, s->open[at].cell, k);
            if (next == JOX_NO_CELL || s->part[next] != kind)
                continue;
            s->part[next] = s->part[s->open[at].cell];
            s->open[listed++].cell = next;
        }
}

/* Numbers the parts: free cells inside the place that are connected inside it, then free cells
   around it, which join the part nearest by grid steps. */
static void number_parts(JoxStandable *s, const JoxPlace *place) {
    const uint32_t cells = s->columns * s->rows;
    uint32_t within = 0;
    for (uint32_t cell = 0; cell < cells; cell++)
        if (s->part[cell] &&
            jox_polygon_contains(place->points, place->count, cell_middle(s, cell)))
            s->part[cell] = WITHIN;
    s->part_count = 0;
    for (uint32_t cell = 0; cell < cells; cell++) {
        if (s->part[cell] != WITHIN)
            continue;
        s->part[cell] = ++s->part_count;
        s->open[0].cell = cell;
        spread_numbers(s, WITHIN, 1);
    }
    for (uint32_t cell = 0; cell < cells; cell++)
        if (s->part[cell] && s->part[cell] <= s->part_count)
            s->open[within++].cell = cell;
    spread_numbers(s, FREE, within);
    for (uint32_t cell = 0; cell < cells; cell++)
        if (s->part[cell] == FREE)
            s->part[cell] = 0;
}

void jox_standable_lay(JoxStandable *s, const JoxPlace *place, float about, float most_cells,
                       const JoxWalls *walls, const JoxWalls *images, const JoxObjects *objects) {
    const JoxV2 low = jox_sub(place->low, jox_v2(about, about));
    const JoxV2 high = jox_add(place->high, jox_v2(about, about));
    const float width = high.x - low.x, height = high.y - low.y;
    s->cell = jox_maxf(CELL, 1.01f * sqrtf(width * height / most_cells));
    s->low = low;
    s->columns = (uint32_t)(width / s->cell) + 1;
    s->rows = (uint32_t)(height / s->cell) + 1;
    const uint32_t cells = s->columns * s->rows;
    const JoxV2 reach = {2.0f * s->cell, 2.0f * s->cell};
    collect_edges(s, jox_sub(low, reach), jox_add(high, reach), walls, images, objects);
    JOX_RESERVE(s->part, s->part_capacity, cells);
    JOX_RESERVE(s->nodes, s->node_capacity, cells);
    JOX_RESERVE(s->open, s->open_capacity, 2 * (size_t)cells);
    if (!s->ways)
        s->ways = jox_alloc(WAYS, sizeof *s->ways);
    memset(s->part, 0xff, cells * sizeof *s->part);
    memset(s->nodes, 0, cells * sizeof *s->nodes);
    memset(s->ways, 0xff, WAYS * sizeof *s->ways);
    s->searches = 0;
    for (uint32_t e = 0; e < s->edge_count; e++)
        block_cells(s, s->edges[2 * e], s->edges[2 * e + 1]);
    number_parts(s, place);
}

void jox_standable_free(JoxStandable *s) {
    jox_free(s->part);
    jox_free(s->edges);
    jox_free(s->nodes);
    jox_free(s->open);
    jox_free(s->ways);
    *s = (JoxStandable){0};
}

enum { NEAR_EDGES = 64 };

/* Lists the edges that meet a box; returns how many there are, also beyond the room. */
static uint32_t list_edges(const JoxStandable *s, JoxV2 low, JoxV2 high, uint32_t out[NEAR_EDGES]) {
    uint32_t count = 0;
    for (uint32_t e = 0; e < s->edge_count; e++)
        if (jox_boxes_meet(s->edges[2 * e], s->edges[2 * e + 1], low, high)) {
            if (count < NEAR_EDGES)
                out[count] = e;
            count++;
        }
    return count;
}

/* Returns whether an edge separates two points: one of `count` listed ones, or any if they are more
   than could be listed. */
static bool is_cut_off(const JoxStandable *s, const uint32_t *listed, uint32_t count, JoxV2 p,
                       JoxV2 q) {
    const bool all = count > NEAR_EDGES;
    const uint32_t tested = all ? s->edge_count : count;
    for (uint32_t n = 0; n < tested; n++) {
        const uint32_t e = all ? n : listed[n];
        if (jox_segment_crossing(s->edges[2 * e], s->edges[2 * e + 1], p, q))
            return true;
    }
    return false;
}

/* Returns the nearest free cell within two cells of a blocked one. */
static uint32_t find_cell_near(const JoxStandable *s, uint32_t middle, JoxV2 p) {
    uint32_t found = JOX_NO_CELL, near[NEAR_EDGES];
    const JoxV2 reach = {3.0f * s->cell, 3.0f * s->cell};
    const uint32_t edges = list_edges(s, jox_sub(p, reach), jox_add(p, reach), near);
    float least2 = INFINITY;
    for (uint32_t k = 0; k < 25; k++) {
        const uint32_t column = middle % s->columns + k % 5 - 2;
        const uint32_t row = middle / s->columns + k / 5 - 2, cell = row * s->columns + column;
        if (column >= s->columns || row >= s->rows || !s->part[cell])
            continue;
        const float off2 = jox_length2(jox_sub(cell_middle(s, cell), p));
        if (off2 < least2 && !is_cut_off(s, near, edges, p, cell_middle(s, cell))) {
            least2 = off2;
            found = cell;
        }
    }
    return found;
}

uint32_t jox_standable_cell(const JoxStandable *s, JoxV2 p) {
    const JoxV2 at = jox_scale(jox_sub(p, s->low), 1.0f / s->cell); /* in cells */
    if (!(at.x >= 0.0f && at.y >= 0.0f && at.x < (float)s->columns && at.y < (float)s->rows))
        return JOX_NO_CELL;
    const uint32_t middle = (uint32_t)at.y * s->columns + (uint32_t)at.x;
    return s->part[middle] ? middle : find_cell_near(s, middle, p);
}

uint32_t jox_standable_part(const JoxStandable *s, uint32_t cell) {
    return cell == JOX_NO_CELL ? 0 : s->part[cell];
}

/* ---- ways ---- */

/* Returns whether the straight line between two cell centres passes over free cells alone. */
static bool passes_freely(const JoxStandable *s, uint32_t from, uint32_t to) {
    const float x = (float)(from % s->columns) + 0.5f, y = (float)(from / s->columns) + 0.5f;
    const float dx = (float)(to % s->columns) + 0.5f - x, dy = (float)(to / s->columns) + 0.5f - y;
    const uint32_t steps = (uint32_t)(SAMPLES * jox_maxf(fabsf(dx), fabsf(dy))) + 1;
    for (uint32_t k = 1; k < steps; k++) {
        const float share = (float)k / (float)steps;
        const uint32_t column = (uint32_t)(x + share * dx), row = (uint32_t)(y + share * dy);
        if (!s->part[row * s->columns + column])
            return false;
    }
    return true;
}

bool jox_standable_is_straight(const JoxStandable *s, JoxV2 p, JoxV2 q) {
    const uint32_t a = jox_standable_cell(s, p), b = jox_standable_cell(s, q);
    return a != JOX_NO_CELL && b != JOX_NO_CELL && (s->edge_count == 0 || passes_freely(s, a, b));
}

/* Returns a lower bound of the length of a way between two cells, in cells. */
static float least_between(const JoxStandable *s, uint32_t from, uint32_t to) {
    const float dx = fabsf((float)(from % s->columns) - (float)(to % s->columns));
    const float dy = fabsf((float)(from / s->columns) - (float)(to / s->columns));
    return jox_maxf(dx, dy) + 0.41421356f * jox_minf(dx, dy);
}

static bool precedes_open(JoxStandableOpen a, JoxStandableOpen b) {
    return a.least != b.least ? a.least < b.least : a.cell < b.cell;
}

static void push_open(JoxStandable *s, uint32_t *count, JoxStandableOpen item) {
    uint32_t at = (*count)++;
    JOX_RESERVE(s->open, s->open_capacity, *count);
    for (; at > 0 && precedes_open(item, s->open[(at - 1) / 2]); at = (at - 1) / 2)
        s->open[at] = s->open[(at - 1) / 2];
    s->open[at] = item;
}

static uint32_t pop_open(JoxStandable *s, uint32_t *count) {
    const uint32_t cell = s->open[0].cell;
    const JoxStandableOpen last = s->open[--*count];
    uint32_t at = 0;
    for (uint32_t child = 1; child < *count; child = 2 * at + 1) {
        child += child + 1 < *count && precedes_open(s->open[child + 1], s->open[child]);
        if (!precedes_open(s->open[child], last))
            break;
        s->open[at] = s->open[child];
        at = child;
    }
    s->open[at] = last;
    return cell;
}

/* Adds a cell to the search, if it was reached by a shorter way than before. */
static void open_cell(JoxStandable *s, uint32_t cell, uint32_t before, float length, uint32_t to,
                      uint32_t *count) {
    JoxStandableNode *node = &s->nodes[cell];
    if (node->search == s->searches && node->length <= length)
        return;
    *node = (JoxStandableNode){s->searches, before, length};
    push_open(s, count, (JoxStandableOpen){length + least_between(s, cell, to), cell});
}

/* Finds the shortest way over the grid between two cells of one part, by A*. */
static void search_way(JoxStandable *s, uint32_t from, uint32_t to) {
    uint32_t count = 0, cell;
    s->searches++;
    open_cell(s, from, from, 0.0f, to, &count);
    while ((cell = pop_open(s, &count)) != to) {
        const float length = s->nodes[cell].length;
        for (int k = 0; k < 8; k++) {
            const uint32_t next = grid_neighbour(s, cell, k);
            if (next != JOX_NO_CELL && s->part[next])
                open_cell(s, next, cell, length + (k & 1 ? 1.41421356f : 1.0f), to, &count);
        }
        JOX_ASSERT(count > 0); /* both are in one part */
    }
}

/* Returns the way between two cells of one part that is not straight; recent ones are cached. */
static const JoxStandableWay *find_way(JoxStandable *s, uint32_t from, uint32_t to) {
    JoxStandableWay *way = &s->ways[(from * 2654435761u ^ to * 2246822519u) >> 20];
    _Static_assert(WAYS == 1 << 12, "as many as a hash of 12 bits names");
    if (way->from == from && way->to == to)
        return way;
    search_way(s, from, to);
    uint32_t next = s->nodes[to].before;
    while (s->nodes[next].before != from && next != from && !passes_freely(s, from, next))
        next = s->nodes[next].before;
    *way = (JoxStandableWay){from, to, next, s->nodes[to].length * s->cell};
    return way;
}

float jox_standable_way(JoxStandable *s, JoxV2 from, JoxV2 to, JoxV2 *next) {
    const uint32_t a = jox_standable_cell(s, from), b = jox_standable_cell(s, to);
    *next = to;
    if (!jox_standable_part(s, a) || jox_standable_part(s, a) != jox_standable_part(s, b))
        return INFINITY;
    if (s->edge_count == 0 || passes_freely(s, a, b))
        return jox_length(jox_sub(to, from));
    const JoxStandableWay *way = find_way(s, a, b);
    *next = cell_middle(s, way->next);
    return way->length;
}
