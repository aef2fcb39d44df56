#include "geom/field.h"

#include <math.h>

#include "base/mem.h"

enum { MOST_CELLS = 4000000 };
static const float NEAR = 0.5f; /* m: walls slow people down within this */
static const float SLOWEST = 0.35f;

typedef struct Cell {
    float time; /* to walk to the goal at 1 m/s, s */
    float direction[2];
    float wall;    /* distance to the nearest wall edge, m; NEAR where it is farther */
    float away[2]; /* unit vector from that wall */
    bool blocked;  /* too close to a wall, or in a solid */
} Cell;

struct JoxField {
    JoxV2 low;
    float size; /* of a cell, m */
    int columns, rows;
    Cell *cells;
};

typedef struct Heap {
    int *items;
    int *place; /* of a cell in items; -1 is not in it */
    int count;
} Heap;

static JoxV2 centre_of(const JoxField *f, int column, int row) {
    return (JoxV2){f->low.x + ((float)column + 0.5f) * f->size,
                   f->low.y + ((float)row + 0.5f) * f->size};
}

/* Columns or rows that an interval touches, kept within the grid. */
static void span(float from, float to, float low, float size, int most, int *first, int *last) {
    float a = floorf((from - low) / size), b = floorf((to - low) / size);
    *first = a < 0.0f ? 0 : a > (float)(most - 1) ? most - 1 : (int)a;
    *last = b < 0.0f ? 0 : b > (float)(most - 1) ? most - 1 : (int)b;
}

static void mark_edge(JoxField *f, JoxV2 a, JoxV2 b) {
    int c0, c1, r0, r1;
    span(jox_minf(a.x, b.x) - NEAR, jox_maxf(a.x, b.x) + NEAR, f->low.x, f->size, f->columns, &c0,
         &c1);
    span(jox_minf(a.y, b.y) - NEAR, jox_maxf(a.y, b.y) + NEAR, f->low.y, f->size, f->rows, &r0,
         &r1);
    for (int r = r0; r <= r1; r++)
        for (int c = c0; c <= c1; c++) {
            Cell *cell = &f->cells[r * f->columns + c];
            JoxV2 p = centre_of(f, c, r), away = jox_sub(p, jox_segment_nearest(a, b, p));
            float distance = jox_length(away);
            if (distance >= cell->wall)
                continue;
            cell->wall = distance;
            away = distance > 1e-6f ? jox_scale(away, 1.0f / distance)
                                    : jox_left(jox_unit(jox_sub(b, a)));
            cell->away[0] = away.x;
            cell->away[1] = away.y;
        }
}

static void mark_solid(JoxField *f, const JoxWalls *walls, const struct JoxWallRing *ring) {
    JoxV2 low, high, *points = jox_alloc(ring->count, sizeof *points);
    for (uint32_t k = 0; k < ring->count; k++)
        points[k] = walls->vertices[ring->first + k].point;
    jox_bounds(points, ring->count, &low, &high);
    int c0, c1, r0, r1;
    span(low.x, high.x, f->low.x, f->size, f->columns, &c0, &c1);
    span(low.y, high.y, f->low.y, f->size, f->rows, &r0, &r1);
    for (int r = r0; r <= r1; r++)
        for (int c = c0; c <= c1; c++)
            if (jox_polygon_contains(points, ring->count, centre_of(f, c, r))) {
                Cell *cell = &f->cells[r * f->columns + c];
                cell->blocked = true; /* the way out is towards the wall, not away from it */
                cell->away[0] = -cell->away[0];
                cell->away[1] = -cell->away[1];
            }
    jox_free(points);
}

static void mark_walls(JoxField *f, const JoxWalls *walls, float clearance) {
    /* A band this wide on both sides of a thin wall lets no way slip through between two cells. */
    float closed = jox_maxf(clearance, 0.75f * f->size);
    for (uint32_t i = 0; i < walls->count; i++)
        mark_edge(f, walls->vertices[i].point, walls->vertices[walls->vertices[i].next].point);
    for (int i = 0; i < f->columns * f->rows; i++)
        f->cells[i].blocked = f->cells[i].wall < closed;
    for (uint32_t r = 0; r < walls->ring_count; r++)
        if (walls->rings[r].solid)
            mark_solid(f, walls, &walls->rings[r]);
}

/* ---- a heap of cells by time; equal times by number, so that the order is one ---- */

static bool sooner(const JoxField *f, int a, int b) {
    return f->cells[a].time != f->cells[b].time ? f->cells[a].time < f->cells[b].time : a < b;
}

static void put(Heap *h, int at, int cell) {
    h->items[at] = cell;
    h->place[cell] = at;
}

static void rise(const JoxField *f, Heap *h, int at) {
    int cell = h->items[at];
    for (; at > 0 && sooner(f, cell, h->items[(at - 1) / 2]); at = (at - 1) / 2)
        put(h, at, h->items[(at - 1) / 2]);
    put(h, at, cell);
}

static int pop(const JoxField *f, Heap *h) {
    int top = h->items[0], last = h->items[--h->count], at = 0;
    h->place[top] = -1;
    while (h->count > 0) {
        int child = 2 * at + 1;
        if (child >= h->count)
            break;
        child += child + 1 < h->count && sooner(f, h->items[child + 1], h->items[child]);
        if (!sooner(f, h->items[child], last))
            break;
        put(h, at, h->items[child]);
        at = child;
    }
    if (h->count > 0)
        put(h, at, last);
    return top;
}

/* ---- marching ---- */

static float time_at(const JoxField *f, int column, int row) {
    if (column < 0 || row < 0 || column >= f->columns || row >= f->rows)
        return INFINITY;
    const Cell *cell = &f->cells[row * f->columns + column];
    return cell->blocked ? INFINITY : cell->time;
}

static float slowness(const Cell *cell) {
    float share = jox_clampf(cell->wall / NEAR, 0.0f, 1.0f);
    return 1.0f / (SLOWEST + (1.0f - SLOWEST) * share);
}

/* Upwind solution of |grad T| = slowness. */
static float solve(const JoxField *f, int column, int row) {
    float a = jox_minf(time_at(f, column - 1, row), time_at(f, column + 1, row));
    float b = jox_minf(time_at(f, column, row - 1), time_at(f, column, row + 1));
    float cost = slowness(&f->cells[row * f->columns + column]) * f->size;
    float low = jox_minf(a, b), high = jox_maxf(a, b);
    if (high - low >= cost)
        return low + cost;
    return 0.5f * (a + b + sqrtf(jox_maxf(0.0f, 2.0f * cost * cost - (a - b) * (a - b))));
}

static void march(JoxField *f, Heap *h, bool *done) {
    static const int STEP[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    while (h->count > 0) {
        int i = pop(f, h), column = i % f->columns, row = i / f->columns;
        done[i] = true;
        for (int s = 0; s < 4; s++) {
            int c = column + STEP[s][0], r = row + STEP[s][1], j = r * f->columns + c;
            if (c < 0 || r < 0 || c >= f->columns || r >= f->rows || f->cells[j].blocked || done[j])
                continue;
            float time = solve(f, c, r);
            if (time >= f->cells[j].time)
                continue;
            f->cells[j].time = time;
            if (h->place[j] < 0)
                put(h, h->count++, j);
            rise(f, h, h->place[j]);
        }
    }
}

/* Free cells at the place begin; the nearest ones where it lies too close to a wall. */
static void seed(JoxField *f, Heap *h, const JoxPlace *places, uint32_t place) {
    for (float reach = 0.75f * f->size; h->count == 0 && reach < 5.0f; reach *= 1.5f)
        for (int i = 0; i < f->columns * f->rows; i++) {
            if (f->cells[i].blocked)
                continue;
            float distance =
                jox_place_distance(places, place, centre_of(f, i % f->columns, i / f->columns));
            if (distance > reach)
                continue;
            f->cells[i].time = distance;
            put(h, h->count++, i);
            rise(f, h, h->count - 1);
        }
}

/* Down the gradient of the times; out of the margin of a wall away from it. */
static void point_cells(JoxField *f) {
    for (int i = 0; i < f->columns * f->rows; i++) {
        Cell *cell = &f->cells[i];
        int c = i % f->columns, r = i / f->columns;
        if (cell->blocked) {
            cell->direction[0] = cell->away[0];
            cell->direction[1] = cell->away[1];
            continue;
        }
        if (!(cell->time < INFINITY))
            continue;
        float left = time_at(f, c - 1, r), right = time_at(f, c + 1, r);
        float down = time_at(f, c, r - 1), up = time_at(f, c, r + 1);
        float x = jox_maxf(0.0f, cell->time - jox_minf(left, right));
        float y = jox_maxf(0.0f, cell->time - jox_minf(down, up));
        JoxV2 way = jox_unit((JoxV2){left < right ? -x : x, down < up ? -y : y});
        cell->direction[0] = way.x;
        cell->direction[1] = way.y;
    }
}

JoxField *jox_field_create(const JoxWalls *walls, const JoxPlace *places, uint32_t place, JoxV2 low,
                           JoxV2 high, float cell, float clearance) {
    JoxField *f = jox_alloc(1, sizeof *f);
    float width = jox_maxf(high.x - low.x, cell), height = jox_maxf(high.y - low.y, cell);
    while ((width / cell + 1.0f) * (height / cell + 1.0f) > (float)MOST_CELLS)
        cell *= 1.1f;
    f->low = low;
    f->size = cell;
    f->columns = (int)ceilf(width / cell);
    f->rows = (int)ceilf(height / cell);
    int count = f->columns * f->rows;
    f->cells = jox_alloc((size_t)count, sizeof *f->cells);
    Heap heap = {.items = jox_alloc((size_t)count, sizeof(int)),
                 .place = jox_alloc((size_t)count, sizeof(int))};
    bool *done = jox_alloc((size_t)count, sizeof *done);
    for (int i = 0; i < count; i++) {
        f->cells[i].time = INFINITY;
        f->cells[i].wall = NEAR;
        heap.place[i] = -1;
    }
    mark_walls(f, walls, clearance);
    seed(f, &heap, places, place);
    march(f, &heap, done);
    point_cells(f);
    jox_free(heap.items);
    jox_free(heap.place);
    jox_free(done);
    return f;
}

/* The cell about a point, and where in the square of four centres it lies. */
static const Cell *cell_at(const JoxField *f, JoxV2 p, float *u, float *v, int *column, int *row) {
    float x = jox_clampf((p.x - f->low.x) / f->size, 0.0f, (float)f->columns - 0.001f);
    float y = jox_clampf((p.y - f->low.y) / f->size, 0.0f, (float)f->rows - 0.001f);
    const Cell *own = &f->cells[(int)y * f->columns + (int)x];
    x = jox_clampf(x - 0.5f, 0.0f, (float)(f->columns - 1));
    y = jox_clampf(y - 0.5f, 0.0f, (float)(f->rows - 1));
    *column = (int)x;
    *row = (int)y;
    *u = x - (float)*column;
    *v = y - (float)*row;
    return own;
}

float jox_field_distance(const JoxField *f, JoxV2 p) {
    float u, v, sum = 0.0f, weights = 0.0f;
    int column, row;
    const Cell *own = cell_at(f, p, &u, &v, &column, &row);
    JoxV2 inside = {jox_clampf(p.x, f->low.x, f->low.x + (float)f->columns * f->size),
                    jox_clampf(p.y, f->low.y, f->low.y + (float)f->rows * f->size)};
    for (int k = 0; k < 4; k++) {
        int c = column + (k & 1), r = row + (k >> 1);
        float time = time_at(f, c, r);
        float weight = ((k & 1) ? u : 1.0f - u) * ((k >> 1) ? v : 1.0f - v);
        if (!(time < INFINITY) || weight <= 0.0f)
            continue;
        sum += weight * time;
        weights += weight;
    }
    if (weights <= 0.0f) { /* in a wall's margin: as from its free side */
        if (!own->blocked || own->wall >= NEAR)
            return INFINITY;
        JoxV2 out = {p.x + own->away[0] * 2.0f * f->size, p.y + own->away[1] * 2.0f * f->size};
        const Cell *free = cell_at(f, out, &u, &v, &column, &row);
        return free->blocked ? INFINITY : free->time + 2.0f * f->size;
    }
    return sum / weights + jox_length(jox_sub(p, inside));
}

JoxV2 jox_field_direction(const JoxField *f, JoxV2 p) {
    float u, v;
    int column, row;
    const Cell *own = cell_at(f, p, &u, &v, &column, &row);
    if (own->blocked)
        return (JoxV2){own->direction[0], own->direction[1]};
    JoxV2 sum = {0.0f, 0.0f};
    for (int k = 0; k < 4; k++) {
        int c = column + (k & 1), r = row + (k >> 1);
        if (c >= f->columns || r >= f->rows)
            continue;
        const Cell *cell = &f->cells[r * f->columns + c];
        float weight = ((k & 1) ? u : 1.0f - u) * ((k >> 1) ? v : 1.0f - v);
        if (!cell->blocked)
            sum = jox_add(sum, jox_scale((JoxV2){cell->direction[0], cell->direction[1]}, weight));
    }
    return jox_unit(sum);
}

void jox_field_free(JoxField *f) {
    if (!f)
        return;
    jox_free(f->cells);
    jox_free(f);
}
