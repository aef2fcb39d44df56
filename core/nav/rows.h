/* Rows of the grid of agents, for those who search it. */
#ifndef JOX_NAV_ROWS_H
#define JOX_NAV_ROWS_H

#include "base/assert.h"
#include "nav/internal.h"

static inline uint32_t jox_row_of(const JoxNav *nav, float y) {
    float row = floorf((y - nav->low.y) / nav->height);
    return row <= 0.0f ? 0 : row >= (float)(nav->rows - 1) ? nav->rows - 1 : (uint32_t)row;
}

/* First agent of a row whose x when sorted is at least `x`. Walks from a hint: neighbours in memory
   ask for nearly the same place, and the answer does not depend on the hint. */
static inline uint32_t jox_row_from(const JoxNav *nav, uint32_t row, float x, uint32_t hint) {
    JOX_ASSERT(row < nav->rows);
    uint32_t first = nav->row_first[row], end = nav->row_first[row + 1];
    const float *sx = nav->sorted_x;
    if (hint < first || hint > end || (hint > first + 32 && sx[hint - 32] >= x) ||
        (hint + 32 < end && sx[hint + 32] < x)) {
        uint32_t low = first, high = end;
        while (low < high) {
            uint32_t middle = (low + high) / 2;
            if (sx[middle] < x)
                low = middle + 1;
            else
                high = middle;
        }
        return low;
    }
    while (hint > first && sx[hint - 1] >= x)
        hint--;
    while (hint < end && sx[hint] < x)
        hint++;
    return hint;
}

/* Whether the image of a point that is shifted along one axis by `side` (-1, 0, 1) periods has to
   be looked at: it lies beyond a periodic edge, which is within `wide`. */
static inline bool jox_sees_image(float at, float origin, float period, float wide, int side) {
    if (side == 0)
        return true;
    return period > 0.0f && (side > 0 ? at - wide < origin : at + wide >= origin + period);
}

/* Where jox_row_from begins, by row: all 0 to begin with. */
enum { JOX_ROW_HINTS = 16 };

#endif
