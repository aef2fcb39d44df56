/* The grid of agents: cells, row by row; agents are kept in the order of their cells, so that those
   of several cells of a row stand one after the other. Between sorts agents drift, so ranges are
   widened by what bounds the drift of all. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/pi.h"
#include "nav/internal.h"

/* Of the mean radius that people search. Few rows lie within reach, each of narrow cells, so that
   little is looked at that is not. */
static const float CELL_WIDTH = 0.45f, CELL_HEIGHT = 1.3f;
static const float CELL_LEAST = 0.25f, CELL_MOST = 8.0f; /* m */
/* Neighbours for whom room is made where nobody has searched yet, and cells for each agent. */
static const float FIRST_NEIGHBOURS = 12.0f, CELLS_EACH = 8.0f;
enum { SORT_EVERY = 8, CELLS_LEAST = 4096 };

/* m: what people search on average; by the space for each where nobody has searched. */
static float mean_search(const JoxAgents *a, JoxV2 extent) {
    double sum = 0.0;
    uint32_t searched = 0;
    for (uint32_t i = 0; i < a->count; i++) {
        sum += (double)a->search[i];
        searched += a->search[i] > 0.0f;
    }
    if (searched)
        return (float)(sum / searched);
    return sqrtf(FIRST_NEIGHBOURS * extent.x * extent.y / ((float)JOX_PI * (float)a->count));
}

/* One side of a cell, m. */
static float cell_of(float share, float search) {
    return jox_minf(CELL_MOST, jox_maxf(CELL_LEAST, share * search));
}

static uint32_t cells_along(float extent, float cell) {
    return (uint32_t)(extent / cell) + 1;
}

/* Lays cells over where the agents are; returns how far that reaches, m. */
static float fit_cells(JoxNav *nav, const JoxAgents *a) {
    JoxV2 high = {-INFINITY, -INFINITY};
    nav->low = (JoxV2){INFINITY, INFINITY};
    for (uint32_t i = 0; i < a->count; i++) {
        nav->low.x = jox_minf(nav->low.x, a->x[i]);
        nav->low.y = jox_minf(nav->low.y, a->y[i]);
        high.x = jox_maxf(high.x, a->x[i]);
        high.y = jox_maxf(high.y, a->y[i]);
    }
    const JoxV2 extent = jox_sub(high, nav->low);
    nav->search = mean_search(a, extent);
    float width = cell_of(CELL_WIDTH, nav->search), height = cell_of(CELL_HEIGHT, nav->search);
    const float most = CELLS_LEAST + CELLS_EACH * (float)a->count;
    while ((extent.x / width + 1.0f) * (extent.y / height + 1.0f) > most) {
        width *= 1.5f;
        height *= 1.5f;
    }
    nav->per_metre = (JoxV2){1.0f / width, 1.0f / height};
    nav->columns = cells_along(extent.x, width) + 1; /* one more than rounding can fill */
    nav->rows = cells_along(extent.y, height) + 1;
    const uint32_t cells = nav->columns * nav->rows;
    if (cells + 1 > nav->cell_capacity) {
        /* Cells get smaller as a crowd gets denser: of one that is everywhere as dense, there are
           half as many as people. */
        nav->cell_capacity = 2 * (cells > a->count ? cells : a->count) + 64;
        nav->cell_first = jox_realloc(nav->cell_first, nav->cell_capacity, sizeof(uint32_t));
    }
    return jox_maxf(jox_maxf(fabsf(nav->low.x), fabsf(high.x)),
                    jox_maxf(fabsf(nav->low.y), fabsf(high.y)));
}

/* Puts agents that are listed by id into the order of their cells, those of a cell by id. */
static void sort_by_cell(JoxNav *nav, const JoxAgents *a, const uint32_t *by_id, uint32_t *order) {
    const uint32_t cells = nav->columns * nav->rows;
    uint32_t *first = nav->cell_first;
    memset(first, 0, (cells + 1) * sizeof *first);
    for (uint32_t i = 0; i < a->count; i++) {
        a->cell[i] = jox_row_of(nav, a->y[i]) * nav->columns + jox_column_of(nav, a->x[i]);
        JOX_ASSERT(a->cell[i] < cells);
        first[a->cell[i]]++;
    }
    uint32_t sum = 0;
    for (uint32_t cell = 0; cell <= cells; cell++) { /* the ends of the cells */
        sum += first[cell];
        first[cell] = sum;
    }
    for (uint32_t k = a->count; k-- > 0;) /* from their ends back to their beginnings */
        order[--first[a->cell[by_id[k]]]] = by_id[k];
}

/* Some have left since, and the others stand in their order: where each cell begins now. */
static void close_cells(JoxNav *nav, const JoxAgents *a) {
    const uint32_t cells = nav->columns * nav->rows;
    uint32_t cell = 0;
    for (uint32_t i = 0; i < a->count; i++) {
        JOX_ASSERT(a->cell[i] < cells && (i == 0 || a->cell[i - 1] <= a->cell[i]));
        for (; cell <= a->cell[i]; cell++)
            nav->cell_first[cell] = i;
    }
    for (; cell <= cells; cell++)
        nav->cell_first[cell] = a->count;
    nav->sorted_count = a->count;
}

void jox_nav_sort(JoxNav *nav, JoxAgents *a, uint64_t tick) {
    /* Nobody has come, and nobody has left of whom there is an index. */
    const bool holds =
        nav->sorted_next_id == a->next_id && isfinite(nav->drift.farthest) &&
        (nav->sorted_count == a->count || (nav->sorted_count > a->count && nav->stray_count == 0));
    if ((holds && tick % SORT_EVERY != 0) || a->count == 0) {
        if (nav->sorted_count != a->count)
            close_cells(nav, a);
        return;
    }
    jox_nav_reserve(nav, a->count);
    const float farthest = fit_cells(nav, a);
    jox_stage_memory_begin(nav->memory, jox_stage_memory_bytes(a->count, sizeof(uint32_t)));
    uint32_t *order = jox_stage_memory_take(nav->memory, a->count, sizeof *order);
    sort_by_cell(nav, a, a->by_rank, order);
    jox_agents_permute(a, order);
    nav->sorted_count = a->count;
    nav->sorted_next_id = a->next_id;
    nav->stray_count = 0;
    /* Somewhat more than positions and what is computed from them are rounded by: who lies within a
       radius by the squared distance that is computed is never missed. */
    const float least = 1e-6f * (1.0f + jox_maxf(farthest, a->period.x + a->period.y));
    nav->drift = (JoxDrift){least, {-least, -least}, {least, least}};
    JOX_CHECK(jox_nav_cells_check(nav, a));
}

/* Whether somebody is listed twice: it may have come back to where its cell is. */
static bool stray_twice(const JoxNav *nav) {
    for (uint32_t k = 0; k < nav->stray_count; k++)
        for (uint32_t other = 0; other < k; other++)
            if (nav->strays[k] == nav->strays[other])
                return true;
    return false;
}

void jox_nav_place_strays(JoxNav *nav, const JoxAgents *a) {
    if (nav->stray_count > JOX_MOST_STRAYS || stray_twice(nav)) {
        nav->drift = jox_drift_unknown();
        nav->stray_count = 0;
    }
    for (uint32_t k = 0; k < nav->stray_count; k++) {
        nav->stray_x[k] = a->x[nav->strays[k]];
        nav->stray_y[k] = a->y[nav->strays[k]];
    }
}
