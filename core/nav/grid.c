/* Sorted grid: rows of fixed height, agents sorted along x within a row, the rows one after the
   other in memory. Between sorts agents drift, so ranges are widened by the greatest drift. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "nav/internal.h"

/* m: somewhat more than people search in a crowd, so that three rows hold what one searches. */
static const float ROW_HEIGHT = 1.2f;
enum { SORT_EVERY = 8, MOST_ROWS = 1 << 15 };

/* Bits of a float in an order that unsigned comparison understands. */
static uint32_t ordered_bits(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

/* For so few that counting digits would take longer. */
enum { FEW = 32 };
static void insertion_sort(uint64_t *keys, uint32_t *order, uint32_t count) {
    for (uint32_t i = 1; i < count; i++) {
        const uint64_t key = keys[i];
        const uint32_t agent = order[i];
        uint32_t at = i;
        for (; at > 0 && keys[at - 1] > key; at--) {
            keys[at] = keys[at - 1];
            order[at] = order[at - 1];
        }
        keys[at] = key;
        order[at] = agent;
    }
}

/* Stable radix sort of keys[0] / order[0] by the low 48 bits; six passes end where they began. */
static void radix_sort(JoxNav *nav, uint32_t count) {
    for (int pass = 0; pass < 6; pass++) {
        uint64_t *from = nav->keys[pass & 1], *to = nav->keys[~pass & 1];
        uint32_t *order = nav->order[pass & 1], *sorted = nav->order[~pass & 1];
        uint32_t start[256] = {0};
        for (uint32_t i = 0; i < count; i++)
            start[from[i] >> (8 * pass) & 255]++;
        for (uint32_t digit = 0, sum = 0; digit < 256; digit++) {
            uint32_t here = start[digit];
            start[digit] = sum;
            sum += here;
        }
        for (uint32_t i = 0; i < count; i++) {
            uint32_t at = start[from[i] >> (8 * pass) & 255]++;
            to[at] = from[i];
            sorted[at] = order[i];
        }
    }
}

static void fit_rows(JoxNav *nav, const JoxAgents *a) {
    JoxV2 high = {-INFINITY, -INFINITY};
    nav->low = (JoxV2){INFINITY, INFINITY};
    for (uint32_t i = 0; i < a->count; i++) {
        nav->low.x = jox_minf(nav->low.x, a->x[i]);
        nav->low.y = jox_minf(nav->low.y, a->y[i]);
        high.y = jox_maxf(high.y, a->y[i]);
    }
    nav->height = jox_maxf(ROW_HEIGHT, (high.y - nav->low.y) / (MOST_ROWS - 1));
    nav->rows = (uint32_t)((high.y - nav->low.y) / nav->height) + 1;
    if (nav->rows + 1 > nav->row_capacity) {
        nav->row_capacity = nav->rows + nav->rows / 4 + 64;
        nav->row_first = jox_realloc(nav->row_first, nav->row_capacity, sizeof(uint32_t));
    }
}

/* m: more than what positions and what is computed from them are rounded by. Ranges are widened by
   it, so that who lies within a radius by the squared distance that is computed is never missed. */
static float rounding(const JoxNav *nav, const JoxAgents *a) {
    float farthest = jox_maxf(fabsf(nav->low.y), fabsf(nav->low.y + nav->rows * nav->height));
    farthest = jox_maxf(farthest, fabsf(nav->low.x));
    for (uint32_t row = 0; row < nav->rows; row++)
        if (nav->row_first[row] < nav->row_first[row + 1])
            farthest = jox_maxf(farthest, fabsf(a->x[nav->row_first[row + 1] - 1]));
    return 1e-6f * (1.0f + jox_maxf(farthest, a->period.x + a->period.y));
}

void jox_nav_sort(JoxNav *nav, JoxAgents *a, uint64_t tick) {
    bool same =
        nav->sorted_count == a->count && nav->sorted_next_id == a->next_id && isfinite(nav->drift);
    if ((same && tick % SORT_EVERY != 0) || a->count == 0) {
        nav->sorted_count = a->count;
        return;
    }
    jox_nav_reserve(nav, a->count);
    fit_rows(nav, a);
    jox_agents_by_id(a, nav->order[0]); /* a stable sort from here breaks ties by id */
    for (uint32_t i = 0; i < a->count; i++) {
        uint32_t at = nav->order[0][i];
        nav->keys[0][i] = (uint64_t)jox_row_of(nav, a->y[at]) << 32 | ordered_bits(a->x[at]);
    }
    if (a->count <= FEW)
        insertion_sort(nav->keys[0], nav->order[0], a->count);
    else
        radix_sort(nav, a->count);
    uint32_t row = 0;
    for (uint32_t i = 0; i < a->count; i++)
        for (uint32_t here = (uint32_t)(nav->keys[0][i] >> 32); row <= here; row++)
            nav->row_first[row] = i;
    for (; row <= nav->rows; row++)
        nav->row_first[row] = a->count;
    jox_agents_permute(a, nav->order[0]);
    memcpy(nav->sorted_x, a->x, a->count * sizeof(float));
    nav->sorted_count = a->count;
    nav->sorted_next_id = a->next_id;
    nav->drift = rounding(nav, a);
    JOX_CHECK(jox_nav_rows_check(nav, a));
}
