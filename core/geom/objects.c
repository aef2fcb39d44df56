/* Builds the grid of bodies, and keeps the list of those nearest to a point. */
#include "geom/objects.h"

#include <string.h>

#include "base/assert.h"
#include "base/mem.h"

/* Finds the bounds of a body in the plane; false if agents cannot meet it. */
static bool find_body_bounds(const JoxObject *body, JoxV2 *low, JoxV2 *high) {
    if (!body->live || !body->in_band)
        return false;
    float reach = jox_maxf(body->disc, body->round);
    *low = jox_v2(body->position.x - reach, body->position.y - reach);
    *high = jox_v2(body->position.x + reach, body->position.y + reach);
    for (uint32_t i = 0; i < body->footprint_count; i++) {
        JoxV2 p = body->footprint[i];
        *low = jox_v2(jox_minf(low->x, p.x), jox_minf(low->y, p.y));
        *high = jox_v2(jox_maxf(high->x, p.x), jox_maxf(high->y, p.y));
    }
    /* Bodies thrown far out of the world have no bounds either. */
    return low->x > -1e7f && low->y > -1e7f && high->x < 1e7f && high->y < 1e7f;
}

/* Returns the column or row of a coordinate, clamped to the grid. */
static inline uint32_t find_grid_cell(float place, float low, float cell, uint32_t count) {
    if (count == 1)
        return 0;
    float at = (place - low) / cell;
    return !(at > 0.0f) ? 0 : at >= (float)count ? count - 1 : (uint32_t)at;
}

typedef struct Range {
    uint32_t left, bottom, right, top;
} Range;

static inline Range find_cell_range(const JoxObjectGrid *g, JoxV2 low, JoxV2 high) {
    return (Range){find_grid_cell(low.x, g->low.x, g->cell, g->columns),
                   find_grid_cell(low.y, g->low.y, g->cell, g->rows),
                   find_grid_cell(high.x, g->low.x, g->cell, g->columns),
                   find_grid_cell(high.y, g->low.y, g->cell, g->rows)};
}

static bool is_met(const JoxCover *c) {
    return c->left <= c->right;
}

/* Computes the cells that each body covers at the present cell size; returns their total number. */
static size_t cover_cells(JoxObjects *objects) {
    const JoxObjectGrid *g = &objects->grid;
    size_t count = 0;
    for (uint32_t i = 0; i < objects->count; i++) {
        JoxCover *c = &g->covers[i];
        if (!is_met(c))
            continue;
        Range r = find_cell_range(g, c->low, c->high);
        c->left = r.left;
        c->bottom = r.bottom;
        c->right = r.right;
        c->top = r.top;
        count += (size_t)(r.right - r.left + 1) * (r.top - r.bottom + 1);
    }
    return count;
}

/* Chooses the cell size: at least 1 m, with not many more cells than bodies and no body in too many
   cells, so that visiting all cells costs little more than visiting all bodies. Returns the number
   of entries. */
static size_t choose_cells(JoxObjects *objects, uint32_t bodies) {
    JoxObjectGrid *g = &objects->grid;
    float width = g->high.x - g->low.x, height = g->high.y - g->low.y;
    for (g->cell = 1.0f;; g->cell *= 2.0f) {
        const float columns = (float)(1 + (uint32_t)(width / g->cell));
        const float rows = (float)(1 + (uint32_t)(height / g->cell));
        if (columns * rows > 4.0f * (float)bodies + 16.0f)
            continue;
        g->columns = (uint32_t)columns;
        g->rows = (uint32_t)rows;
        size_t entries = cover_cells(objects);
        if (entries <= 16 * (size_t)bodies)
            return entries;
    }
}

/* Counts each body in the cells that it covers, or lists it there, from the end of each list. */
static void list_bodies(JoxObjects *objects, bool count) {
    const JoxObjectGrid *g = &objects->grid;
    for (uint32_t i = objects->count; i-- > 0;) { /* backwards, so that rows ascend within a cell */
        const JoxCover *c = &g->covers[i];
        if (!is_met(c))
            continue;
        for (uint32_t row = c->bottom; row <= c->top; row++)
            for (uint32_t column = c->left; column <= c->right; column++) {
                uint32_t *at = &g->starts[(size_t)row * g->columns + column];
                if (count)
                    ++*at;
                else
                    g->members[--*at] = i;
            }
    }
}

/* Lists the bodies of each cell. */
static void list_by_cells(JoxObjects *objects, uint32_t cells) {
    JoxObjectGrid *g = &objects->grid;
    uint32_t sum = 0;
    memset(g->starts, 0, ((size_t)cells + 1) * sizeof *g->starts);
    list_bodies(objects, true);
    for (uint32_t c = 0; c <= cells; c++) {
        sum += g->starts[c];
        g->starts[c] = sum; /* the end of the list; listing backwards moves it to the start */
    }
    list_bodies(objects, false);
}

/* Lists the bodies of a grid of a single cell. */
static void list_single_cell(JoxObjects *objects) {
    JoxObjectGrid *g = &objects->grid;
    uint32_t count = 0;
    for (uint32_t i = 0; i < objects->count; i++)
        if (is_met(&g->covers[i]))
            g->members[count++] = i;
    g->starts[0] = 0;
    g->starts[1] = count;
}

/* Asserts that cells list live bodies in ascending order. */
static void check_object_grid(const JoxObjects *objects) {
    const JoxObjectGrid *g = &objects->grid;
    JOX_ASSERT(g->columns > 0 && g->starts[0] == 0);
    for (uint32_t c = 0; c < g->columns * g->rows; c++) {
        JOX_ASSERT(g->starts[c] <= g->starts[c + 1]);
        for (uint32_t k = g->starts[c]; k < g->starts[c + 1]; k++) {
            JOX_ASSERT(g->members[k] < objects->count && objects->rows[g->members[k]].live);
            JOX_ASSERT(k == g->starts[c] || g->members[k - 1] < g->members[k]);
        }
    }
}

void jox_objects_lay(JoxObjects *objects) {
    JoxObjectGrid *g = &objects->grid;
    uint32_t bodies = 0;
    JOX_RESERVE(g->covers, g->cover_capacity, objects->count);
    g->laid = objects->count;
    g->columns = g->rows = 0;
    g->hides_people = false;
    g->low = (JoxV2){INFINITY, INFINITY};
    g->high = (JoxV2){-INFINITY, -INFINITY};
    for (uint32_t i = 0; i < objects->count; i++) {
        JoxCover *c = &g->covers[i];
        c->left = c->right = 0;
        if (!find_body_bounds(&objects->rows[i], &c->low, &c->high)) {
            c->left = 1; /* an empty range */
            continue;
        }
        g->low = jox_v2(jox_minf(g->low.x, c->low.x), jox_minf(g->low.y, c->low.y));
        g->high = jox_v2(jox_maxf(g->high.x, c->high.x), jox_maxf(g->high.y, c->high.y));
        g->hides_people |= jox_object_hides_people(&objects->rows[i]);
        bodies++;
    }
    if (!bodies)
        return;
    size_t entries = choose_cells(objects, bodies);
    uint32_t cells = g->columns * g->rows;
    /* Room for the most that there may be, so that moving bodies needs no more memory. */
    JOX_RESERVE(g->starts, g->start_capacity, 4 * (size_t)objects->count + 17);
    JOX_RESERVE(g->members, g->member_capacity, 16 * (size_t)objects->count);
    JOX_ASSERT(cells < g->start_capacity && entries <= g->member_capacity);
    if (cells == 1)
        list_single_cell(objects);
    else
        list_by_cells(objects, cells);
    JOX_ASSERT(g->starts[cells] == entries);
    JOX_CHECK(check_object_grid(objects));
}

void jox_objects_free_grid(JoxObjects *objects) {
    jox_free(objects->grid.starts);
    jox_free(objects->grid.members);
    jox_free(objects->grid.covers);
    objects->grid = (JoxObjectGrid){0};
}

JoxObjectWalk jox_objects_near(const JoxObjects *objects, JoxV2 point, float reach) {
    const JoxObjectGrid *g = &objects->grid;
    JOX_ASSERT(g->laid == objects->count);
    JoxObjectWalk walk = {.grid = g};
    JoxV2 low = {point.x - reach, point.y - reach}, high = {point.x + reach, point.y + reach};
    if (!g->columns ||
        !(low.x <= g->high.x && low.y <= g->high.y && high.x >= g->low.x && high.y >= g->low.y))
        return walk; /* a single cell with no member left */
    Range r = find_cell_range(g, low, high);
    walk.left = walk.column = r.left;
    walk.bottom = walk.row = r.bottom;
    walk.right = r.right;
    walk.top = r.top;
    walk.at = g->starts[(size_t)walk.row * g->columns + walk.column];
    walk.end = g->starts[(size_t)walk.row * g->columns + walk.column + 1];
    return walk;
}

static bool is_nearer(float gap, uint32_t row, float other_gap, uint32_t other_row) {
    return gap < other_gap || (gap == other_gap && row < other_row);
}

void jox_nearest_offer(JoxNearest *n, float gap, uint32_t row) {
    JOX_ASSERT(n->most > 0 && n->most <= JOX_MOST_NEAREST && n->count <= n->most);
    uint32_t at = n->count;
    if (isnan(gap) || (at == n->most && !is_nearer(gap, row, n->gaps[at - 1], n->rows[at - 1])))
        return;
    if (at == n->most)
        at--;
    else
        n->count++;
    for (; at > 0 && is_nearer(gap, row, n->gaps[at - 1], n->rows[at - 1]); at--) {
        n->gaps[at] = n->gaps[at - 1];
        n->rows[at] = n->rows[at - 1];
    }
    n->gaps[at] = gap;
    n->rows[at] = row;
}

void jox_nearest_by_row(JoxNearest *n) {
    for (uint32_t i = 1; i < n->count; i++) {
        uint32_t row = n->rows[i], j = i;
        for (; j > 0 && n->rows[j - 1] > row; j--)
            n->rows[j] = n->rows[j - 1];
        n->rows[j] = row;
    }
}
