/* Kernel of jox_wall_grid_unhidden_distance2; each lane is a point. Few points have edges nearby,
   and these are handled one by one. */
#include <math.h>

#include "geom/wall_grid_lanes.h"

void JOX_WIDE(jox_wall_unhidden)(const JoxWallGrid *grid, const float *x, const float *y,
                                 uint32_t count, float *unhidden2) {
    for (uint32_t n = 0; n < count; n += JOX_WIDTH) {
        uint32_t near = jm_bits(jox_wall_grid_near_lanes(grid, jf_load(x + n), jf_load(y + n)));
        jf_store(unhidden2 + n, jf_set(INFINITY));
        for (; near; near &= near - 1) {
            const uint32_t k = n + (uint32_t)__builtin_ctz(near);
            unhidden2[k] = jox_wall_grid_unhidden_distance2(grid, (JoxV2){x[k], y[k]});
        }
    }
}
