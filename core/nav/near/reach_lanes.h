/* Cells of the grid within reach of the agents of a packet; perceive_wide.c includes it. */
#ifndef JOX_NAV_NEAR_REACH_LANES_H
#define JOX_NAV_NEAR_REACH_LANES_H

#include "nav/near/near_lanes.h"

/* Ranges of columns and rows of cells of each lane, both ends included. */
typedef struct Cells {
    uint32_t left[JOX_WIDTH], right[JOX_WIDTH], low[JOX_WIDTH], high[JOX_WIDTH];
} Cells;

/* Cells within reach of each lane, and of each lane together with the next one. */
typedef struct Reach {
    float x[JOX_WIDTH], y[JOX_WIDTH]; /* m: image of the agent that searches */
    float radius2[JOX_WIDTH];         /* m2 */
    Cells own, both;
    uint32_t pairs; /* lanes that reach few more cells together with the next lane than alone */
} Reach;

static inline JoxFloats find_cells(JoxFloats at, float low, float per_metre, uint32_t cells) {
    const JoxFloats from = (at - low) * per_metre;
    return jf_min(jf_max(jf_set(0.0f), from), jf_set((float)(cells - 1)));
}
/* Returns the rows at these y, m, within the bands of the sheets on which `on`, JOX_WIDTH cells,
   lie. */
static inline JoxFloats find_banded_rows(const Packet *packet, const float *on, JoxFloats y) {
    const JoxNav *nav = packet->p->nav;
    float at[JOX_WIDTH], row[JOX_WIDTH];
    jf_store(at, y);
    for (uint32_t lane = 0; lane < JOX_WIDTH; lane++)
        row[lane] = (float)jox_row_in_band(nav, jox_band_of(nav, on[lane]), at[lane]);
    return jf_load(row);
}
/* Stores the first (store_last: the last) cells in reach: `own` of each lane, `both` of each lane
   and the next. */
static inline void store_first(JoxFloats cells, uint32_t *own, uint32_t *both) {
    ji_store(own, jf_to_ints(cells));
    ji_store(both, jf_to_ints(jf_min(cells, jf_next(cells))));
}

static inline void store_last(JoxFloats cells, uint32_t *own, uint32_t *both) {
    ji_store(own, jf_to_ints(cells));
    ji_store(both, jf_to_ints(jf_max(cells, jf_next(cells))));
}

/* Returns the lanes that together with the next one reach many more cells along an axis than alone:
   the two agents do not stand side by side. */
static inline JoxMask reach_many_more(const uint32_t *first, const uint32_t *last,
                                      const uint32_t *first_both, const uint32_t *last_both) {
    const JoxInts alone = ji_sub(ji_load(last), ji_load(first));
    const JoxInts both = ji_sub(ji_load(last_both), ji_load(first_both));
    return ji_less(ji_add(alone, ji_set(1)), both);
}

/* Finds the cells in reach of the images of the lanes' agents, which are shifted by `shift` (m). */
static inline void find_reach(const Packet *packet, JoxV2 shift, Reach *reach) {
    const JoxNav *nav = packet->p->nav;
    const JoxV2 least = nav->drift.least, most = nav->drift.most, low = nav->low;
    const JoxFloats radius = jf_load(packet->radius);
    const JoxFloats x = jf_load(packet->at_x) + shift.x;
    const JoxFloats y = jf_load(packet->at_y) + shift.y;
    Cells *own = &reach->own, *both = &reach->both;
    jf_store(reach->x, x);
    jf_store(reach->y, y);
    jf_store(reach->radius2, radius * radius);
    store_first(find_cells(x - radius - most.x, low.x, nav->per_metre.x, nav->columns), own->left,
                both->left);
    store_last(find_cells(x + radius - least.x, low.x, nav->per_metre.x, nav->columns), own->right,
               both->right);
    const JoxFloats lowest = y - radius - most.y, highest = y + radius - least.y;
    if (nav->bands) {
        store_first(find_banded_rows(packet, reach->y, lowest), own->low, both->low);
        store_last(find_banded_rows(packet, reach->y, highest), own->high, both->high);
    } else {
        store_first(find_cells(lowest, low.y, nav->per_metre.y, nav->rows), own->low, both->low);
        store_last(find_cells(highest, low.y, nav->per_metre.y, nav->rows), own->high, both->high);
    }
    const JoxMask apart = jm_or(reach_many_more(own->left, own->right, both->left, both->right),
                                reach_many_more(own->low, own->high, both->low, both->high));
    reach->pairs = ~jm_bits(apart) & JOX_ALL_LANES >> 1; /* the last lane has no next one */
}

#endif
