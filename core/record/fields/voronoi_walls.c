/* Cells bounded by walls. The part of a convex cell that a person sees is star-shaped about the
   person. Between two adjacent directions, to end points and crossings of edges, a single straight
   edge bounds it, of the cell or of a wall; so it is a fan of triangles. */
#include <math.h>

#include "record/fields/voronoi.h"

#include "base/sort.h"

enum { MOST_EDGES = 512, MOST_DIRECTIONS = 4096 };
static const double SAME = 1e-9; /* rad: directions closer than this count as one */

typedef struct Edge {
    double ax, ay, bx, by; /* m, relative to the person */
} Edge;

typedef struct View {
    Edge edges[MOST_EDGES]; /* edges of the cell, then of walls */
    uint32_t count, of_cell;
    double directions[MOST_DIRECTIONS]; /* rad */
    uint32_t direction_count;
} View;

static void add_direction(View *v, double x, double y) {
    if (v->direction_count < MOST_DIRECTIONS)
        v->directions[v->direction_count++] = atan2(y, x);
}

/* Adds the direction of the crossing of two edges, if there is one. */
static void add_crossing_direction(View *v, const Edge *e, const Edge *f) {
    double ex = e->bx - e->ax, ey = e->by - e->ay, fx = f->bx - f->ax, fy = f->by - f->ay;
    double turn = ex * fy - ey * fx, ox = f->ax - e->ax, oy = f->ay - e->ay;
    if (turn == 0.0)
        return;
    double s = (ox * fy - oy * fx) / turn, t = (ox * ey - oy * ex) / turn;
    if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0)
        add_direction(v, e->ax + s * ex, e->ay + s * ey);
}

/* Returns the squared distance of the person from an edge, m2. */
static double measure_edge_distance2(const Edge *e) {
    double x = e->bx - e->ax, y = e->by - e->ay, l2 = x * x + y * y;
    double t = l2 > 0.0 ? fmin(fmax(-(e->ax * x + e->ay * y) / l2, 0.0), 1.0) : 0.0;
    double nx = e->ax + t * x, ny = e->ay + t * y;
    return nx * nx + ny * ny;
}

/* Returns the distance along the direction (x, y) to the line through an edge, m; INFINITY if the
   line is behind or parallel. With `inside`, the ray must meet the edge itself. */
static double measure_ray(const Edge *e, double x, double y, bool inside) {
    double ex = e->bx - e->ax, ey = e->by - e->ay, turn = x * ey - y * ex;
    if (turn == 0.0)
        return INFINITY;
    double along = (e->ax * ey - e->ay * ex) / turn, share = (e->ax * y - e->ay * x) / turn;
    return along < 0.0 || (inside && (share < 0.0 || share > 1.0)) ? INFINITY : along;
}

/* Collects the edges of the cell and of walls near enough to bound it. Returns false if no wall
   is. */
static bool gather_view_edges(View *v, const JoxCell *cell, JoxV2 at, const JoxBars *bars) {
    double far2 = jox_cell_reach2(cell);
    v->count = v->direction_count = 0;
    for (uint32_t c = 0; c < cell->count; c++) {
        uint32_t n = c + 1 < cell->count ? c + 1 : 0;
        v->edges[v->count++] = (Edge){cell->x[c], cell->y[c], cell->x[n], cell->y[n]};
        add_direction(v, cell->x[c], cell->y[c]);
    }
    v->of_cell = v->count;
    for (uint32_t b = 0; b < bars->count && v->count < MOST_EDGES; b++) {
        Edge e = {(double)bars->items[b].from.x - at.x, (double)bars->items[b].from.y - at.y,
                  (double)bars->items[b].to.x - at.x, (double)bars->items[b].to.y - at.y};
        if (measure_edge_distance2(&e) >= far2)
            continue;
        for (uint32_t k = 0; k < v->count; k++)
            add_crossing_direction(v, &v->edges[k], &e);
        add_direction(v, e.ax, e.ay);
        add_direction(v, e.bx, e.by);
        v->edges[v->count++] = e;
    }
    return v->count > v->of_cell;
}

void jox_cell_visible_area(const JoxCell *cell, JoxV2 at, const JoxBars *bars, const JoxV2 *ring,
                           uint32_t count, double *whole, double *within) {
    View v;
    if (bars->count == 0 || !gather_view_edges(&v, cell, at, bars)) {
        *whole = jox_cell_area(cell);
        *within = jox_cell_area_within(cell, at, ring, count);
        return;
    }
    *whole = *within = 0.0;
    jox_sort_doubles(v.directions, v.direction_count);
    for (uint32_t d = 0; d < v.direction_count; d++) {
        bool last = d + 1 == v.direction_count;
        double from = v.directions[d];
        double to = last ? v.directions[0] + 2.0 * acos(-1.0) : v.directions[d + 1];
        if (to - from < SAME)
            continue;
        double x = cos(0.5 * (from + to)), y = sin(0.5 * (from + to)), nearest = INFINITY;
        const Edge *edge = NULL;
        for (uint32_t e = 0; e < v.count; e++) {
            double away = measure_ray(&v.edges[e], x, y, true);
            if (away < nearest) {
                nearest = away;
                edge = &v.edges[e];
            }
        }
        double a = edge ? measure_ray(edge, cos(from), sin(from), false) : INFINITY;
        double b = edge ? measure_ray(edge, cos(to), sin(to), false) : INFINITY;
        if (!isfinite(a) || !isfinite(b))
            continue;
        JoxCell part = {.x = {0.0, a * cos(from), b * cos(to)},
                        .y = {0.0, a * sin(from), b * sin(to)},
                        .count = 3};
        *whole += jox_cell_area(&part);
        *within += jox_cell_area_within(&part, at, ring, count);
    }
}
