/* Checks the results of the stages of navigation; called in builds with assertions only. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "nav/nav_state.h"

void jox_nav_cells_check(const JoxNav *nav, const JoxAgents *a) {
    const uint32_t cells = nav->rows * nav->columns;
    JOX_ASSERT(cells > 0 && nav->per_metre.x > 0.0f && nav->per_metre.y > 0.0f);
    JOX_ASSERT(nav->cell_first[0] == 0 && nav->cell_first[cells] == a->count);
    for (uint32_t cell = 0; cell < cells; cell++) {
        uint32_t first = nav->cell_first[cell], end = nav->cell_first[cell + 1];
        JOX_ASSERT(first <= end);
        for (uint32_t i = first; i < end; i++) {
            JOX_ASSERT(jox_row_of(nav, a->y[i]) == cell / nav->columns);
            JOX_ASSERT(jox_column_of(nav, a->x[i]) == cell % nav->columns);
            JOX_ASSERT(i == first || a->id[i - 1] < a->id[i]);
        }
    }
}

void jox_motions_check(const JoxNeighbours *n, const JoxAgents *a) {
    for (uint32_t i = 0; i < a->count; i++) {
        JoxMotion own = {a->x[i], a->y[i], a->vx[i], a->vy[i]};
        if (n->has_belts) {
            own.vx += n->belt_x[i];
            own.vy += n->belt_y[i];
        }
        JOX_ASSERT(memcmp(&n->motions[i], &own, sizeof own) == 0);
    }
}

void jox_neighbours_check(const JoxNeighbours *n, const JoxAgents *a) {
    JOX_ASSERT(n->agents >= a->count);
    for (uint32_t i = 0; i < a->count; i++) {
        const uint32_t count = n->count[i];
        const float perception = jox_param(a, JOX_PARAM_perception, i);
        float before = 0.0f;
        JOX_ASSERT(count <= n->stride && count <= (uint32_t)jox_param(a, JOX_PARAM_neighbours, i));
        JOX_ASSERT(a->density[i] >= 0.0f && a->search_radius[i] > 0.0f);
        for (uint32_t k = count; k < n->stride; k++) /* kernels read these unused entries too */
            JOX_ASSERT(n->index[jox_neighbour_at(n, i, k)] < n->agents);
        for (uint32_t k = 0; k < count; k++) {
            size_t at = jox_neighbour_at(n, i, k);
            JOX_ASSERT(n->index[at] < a->count && n->index[at] != i);
            const float distance = jox_length(jox_offset(a, i, n->index[at]));
            JOX_ASSERT(distance <= perception * 1.0001f);
            JOX_ASSERT(before <= distance * 1.0001f);
            for (uint32_t other = 0; other < k; other++)
                JOX_ASSERT(n->index[jox_neighbour_at(n, i, other)] != n->index[at]);
            before = distance;
        }
    }
}

void jox_half_planes_check(const JoxHalfPlane *half_planes, uint32_t count) {
    JOX_ASSERT(count <= JOX_MOST_CONSTRAINTS);
    for (uint32_t k = 0; k < count; k++)
        JOX_ASSERT(jox_is_unit(half_planes[k].normal));
}

void jox_linear_program_check(const JoxHalfPlane *half_planes, uint32_t count, float speed_limit,
                              JoxV2 velocity) {
    /* The intersection of nearly parallel borders has the greatest rounding errors. */
    const float tolerance = 1e-3f * (1.0f + speed_limit);
    JOX_ASSERT(!(jox_length(velocity) > speed_limit + tolerance));
    for (uint32_t k = 0; k < count; k++)
        JOX_ASSERT(!(half_planes[k].offset - jox_dot(half_planes[k].normal, velocity) > tolerance));
}
