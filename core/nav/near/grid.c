/* The grid of agents that perceive searches: cells, row by row. jox_nav_sort keeps the agents in
   the order of their cells, so that the agents of neighbouring cells of a row are consecutive.
   Between two sorts agents move, so searches widen the range of cells by the bounds of that
   drift. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/pi.h"
#include "nav/near/perceive.h"

/* Sides of a cell as shares of the mean search radius. Few rows of narrow cells lie within reach,
   so that few agents outside the radius are looked at. */
static const float CELL_WIDTH = 0.45f, CELL_HEIGHT = 1.3f;
static const float CELL_LEAST = 0.25f, CELL_MOST = 8.0f; /* m */
/* Neighbours expected within the radius while no agent has searched yet, and cells per agent at
   most. */
static const float FIRST_NEIGHBOURS = 12.0f, CELLS_EACH = 8.0f;
enum { SORT_EVERY = 8, CELLS_LEAST = 4096 };

/* Returns the mean search radius of the agents, m; estimated from the area per agent while no agent
   has searched yet. */
static float compute_mean_search(const JoxAgents *a, JoxV2 extent) {
    double sum = 0.0;
    uint32_t searched = 0;
    for (uint32_t i = 0; i < a->count; i++) {
        sum += (double)a->search_radius[i];
        searched += a->search_radius[i] > 0.0f;
    }
    if (searched)
        return (float)(sum / searched);
    return sqrtf(FIRST_NEIGHBOURS * extent.x * extent.y / ((float)JOX_PI * (float)a->count));
}

/* Returns one side of a cell, m, within CELL_LEAST and CELL_MOST. */
static float clamp_cell_side(float share, float search) {
    return jox_minf(CELL_MOST, jox_maxf(CELL_LEAST, share * search));
}

static uint32_t count_cells(float extent, float cell) {
    return (uint32_t)(extent / cell) + 1;
}

/* Finds the extent along y of the agents of each sheet, m: in low the least and in high the
   greatest y; low above high where there is nobody. Returns the sum of all extents. */
static float find_sheet_extents(const JoxAgents *a, float *low, float *high) {
    const JoxStoreys *s = a->storeys;
    float sum = 0.0f;
    for (uint32_t k = 0; k < s->sheet_count; k++) {
        low[k] = INFINITY;
        high[k] = -INFINITY;
    }
    for (uint32_t i = 0; i < a->count; i++) {
        const uint32_t k = jox_sheet_of(s, a->y[i]);
        low[k] = jox_minf(low[k], a->y[i]);
        high[k] = jox_maxf(high[k], a->y[i]);
    }
    for (uint32_t k = 0; k < s->sheet_count; k++)
        sum += jox_maxf(high[k] - low[k], 0.0f);
    return sum;
}

/* Gives each sheet its rows, of this height, m; returns how many there are. */
static uint32_t lay_bands(JoxNav *nav, const JoxStoreys *s, const float *low, const float *high,
                          float height) {
    uint32_t rows = 0;
    nav->bands = jox_realloc(nav->bands, s->sheet_count, sizeof *nav->bands);
    for (uint32_t k = 0; k < s->sheet_count; k++) {
        const bool empty = low[k] > high[k];
        nav->bands[k] = (JoxNavBand){empty ? 0.0f : low[k], rows,
                                     empty ? 1 : count_cells(high[k] - low[k], height) + 1};
        rows += nav->bands[k].rows;
    }
    return rows;
}

/* Lays the cells over the bounding box of the agents; returns the greatest coordinate in it, m. */
static float fit_cells(JoxNav *nav, const JoxAgents *a) {
    JoxV2 high = {-INFINITY, -INFINITY};
    nav->low = (JoxV2){INFINITY, INFINITY};
    for (uint32_t i = 0; i < a->count; i++) {
        nav->low.x = jox_minf(nav->low.x, a->x[i]);
        nav->low.y = jox_minf(nav->low.y, a->y[i]);
        high.x = jox_maxf(high.x, a->x[i]);
        high.y = jox_maxf(high.y, a->y[i]);
    }
    JoxV2 extent = jox_sub(high, nav->low);
    const uint32_t sheets = a->storeys ? a->storeys->sheet_count : 0;
    float lows[JOX_MOST_STOREYS + JOX_MOST_STAIRS], highs[JOX_MOST_STOREYS + JOX_MOST_STAIRS];
    if (sheets)
        extent.y = find_sheet_extents(a, lows, highs);
    nav->search_radius = compute_mean_search(a, extent);
    float width = clamp_cell_side(CELL_WIDTH, nav->search_radius),
          height = clamp_cell_side(CELL_HEIGHT, nav->search_radius);
    const float most = CELLS_LEAST + CELLS_EACH * (float)a->count;
    while ((extent.x / width + 1.0f) * (extent.y / height + 1.0f + (float)sheets) > most) {
        width *= 1.5f;
        height *= 1.5f;
    }
    nav->per_metre = (JoxV2){1.0f / width, 1.0f / height};
    nav->columns = count_cells(extent.x, width) + 1; /* one more than rounding can reach */
    nav->rows = sheets ? lay_bands(nav, a->storeys, lows, highs, height)
                       : count_cells(extent.y, height) + 1;
    nav->storeys = a->storeys;
    const uint32_t cells = nav->columns * nav->rows;
    if (cells + 1 > nav->cell_capacity) {
        /* Cells get smaller as a crowd gets denser; a crowd of uniform density has half as many
           cells as agents. */
        nav->cell_capacity = 2 * (cells > a->count ? cells : a->count) + 64;
        nav->cell_first = jox_realloc(nav->cell_first, nav->cell_capacity, sizeof(uint32_t));
    }
    return jox_maxf(jox_maxf(fabsf(nav->low.x), fabsf(high.x)),
                    jox_maxf(fabsf(nav->low.y), fabsf(high.y)));
}

/* Puts the agents, given in the order of their ids, into the order of their cells; agents of one
   cell stay in the order of their ids. */
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
    for (uint32_t cell = 0; cell <= cells; cell++) { /* sums up to the end of each cell */
        sum += first[cell];
        first[cell] = sum;
    }
    for (uint32_t k = a->count; k-- > 0;) /* fills each cell backwards, from its end */
        order[--first[a->cell[by_id[k]]]] = by_id[k];
}

/* Finds the first agent of each cell again after agents have left; the others keep their order. */
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

/* Finds the strays after agents have left. */
static void find_strays_again(JoxNav *nav, const JoxAgents *a) {
    uint32_t kept = 0;
    for (uint32_t k = 0; k < nav->stray_count; k++) {
        const uint32_t i = jox_agents_find(a, nav->stray_ids[k]);
        if (i == JOX_NO_INDEX)
            continue;
        nav->strays[kept] = i;
        nav->stray_ids[kept] = nav->stray_ids[k];
        nav->stray_x[kept] = nav->stray_x[k];
        nav->stray_y[kept++] = nav->stray_y[k];
    }
    nav->stray_count = kept;
}

void jox_nav_sort(JoxNav *nav, JoxAgents *a, uint64_t tick) {
    /* The order still holds if no agent was added. */
    const bool holds = nav->sorted_next_id == a->next_id && isfinite(nav->drift.farthest) &&
                       nav->sorted_count >= a->count;
    if ((holds && tick % SORT_EVERY != 0) || a->count == 0) {
        if (nav->sorted_count != a->count) {
            close_cells(nav, a);
            find_strays_again(nav, a);
        }
        return;
    }
    jox_nav_reserve(nav, a->count);
    const float farthest = fit_cells(nav, a);
    jox_stage_memory_begin(nav->memory, jox_stage_memory_bytes(a->count, sizeof(uint32_t)) +
                                            jox_stage_memory_bytes(a->count, sizeof(uint64_t)));
    uint32_t *order = jox_stage_memory_take(nav->memory, a->count, sizeof *order);
    sort_by_cell(nav, a, a->by_rank, order);
    jox_agents_permute(a, order, jox_stage_memory_take(nav->memory, a->count, sizeof(uint64_t)));
    nav->sorted_count = a->count;
    nav->sorted_next_id = a->next_id;
    nav->stray_count = 0;
    /* More than the rounding errors of positions and of squared distances: a neighbour within the
       radius is never missed. */
    const float least = 1e-6f * (1.0f + jox_maxf(farthest, a->period.x + a->period.y));
    nav->drift = (JoxDrift){least, {-least, -least}, {least, least}};
    JOX_CHECK(jox_nav_cells_check(nav, a));
}

/* Returns whether an agent is listed twice as a stray: it may have come back to its own cell. */
static bool has_repeated_stray(const JoxNav *nav) {
    for (uint32_t k = 0; k < nav->stray_count; k++)
        for (uint32_t other = 0; other < k; other++)
            if (nav->strays[k] == nav->strays[other])
                return true;
    return false;
}

void jox_nav_place_strays(JoxNav *nav, const JoxAgents *a) {
    if (nav->stray_count > JOX_MOST_STRAYS || has_repeated_stray(nav)) {
        nav->drift = jox_drift_unknown();
        nav->stray_count = 0;
    }
    for (uint32_t k = 0; k < nav->stray_count; k++) {
        nav->stray_ids[k] = a->id[nav->strays[k]];
        nav->stray_x[k] = a->x[nav->strays[k]];
        nav->stray_y[k] = a->y[nav->strays[k]];
    }
}
