/* Which agents a force can reach: those in a cone, with no wall between. push/ and
   literal.c call it. */
#include <math.h>

#include "base/assert.h"
#include "force/forces.h"

bool jox_wall_stops_force(const JoxForces *f, JoxV2 from, JoxV2 to) {
    /* Tests from either end, as the grid lists edges up to half of the distance only. */
    const JoxWallGrid *walls = f->in.walls;
    return walls && (jox_wall_grid_has_wall_between(walls, from, to) ||
                     jox_wall_grid_has_wall_between(walls, to, from));
}

/* Returns a distance, m, within which no wall is now that agents have moved: that before, less
   their way, which is long over a periodic edge. Below 0: unknown. */
static float find_unhidden_distance(const JoxForces *f, uint32_t i) {
    const JoxAgents *a = f->step.agents;
    const JoxV2 way = {a->x[i] - a->prev_x[i], a->y[i] - a->prev_y[i]};
    return f->in.unhidden2 ? sqrtf(jox_unhidden2_by_grid(f, i)) - jox_length(way) : -1.0f;
}

/* Removes the agents from `found` that a wall separates from agent i. Returns how many are left. */
static uint32_t drop_walled_off(const JoxForces *f, uint32_t i, uint32_t *found, uint32_t count) {
    const JoxAgents *a = f->step.agents;
    const JoxV2 at = {a->x[i], a->y[i]};
    if (!f->in.walls || !count)
        return count;
    const float unhidden = find_unhidden_distance(f, i);
    uint32_t n = 0;
    for (uint32_t k = 0; k < count; k++) {
        const JoxV2 offset = jox_offset(a, i, found[k]);
        found[n] = found[k];
        n += jox_length(offset) < unhidden || !jox_wall_stops_force(f, at, jox_add(at, offset));
    }
    return n;
}

uint32_t jox_find_people_in_cone(const JoxForces *f, uint32_t i, JoxV2 axis, uint32_t *found) {
    const JoxAgents *a = f->step.agents;
    const JoxNeighbours *near = f->step.neighbours;
    const JoxParameterColumn radius = a->param[JOX_PARAM_radius];
    float cosine = jox_param(a, JOX_PARAM_brace_angle, i);
    uint32_t n = 0;
    for (uint32_t k = 0; k < near->count[i]; k++) {
        uint32_t other = near->index[jox_neighbour_at(near, i, k)];
        JoxV2 offset = jox_offset(a, i, other);
        float most = jox_at(radius, i) + jox_at(radius, other) + f->options.reach;
        bool near_enough = f->options.literal | (jox_length2(offset) <= most * most);
        found[n] = other; /* kept only if it counts; no branch to mispredict */
        n += near_enough & jox_cone_holds(offset, axis, cosine);
    }
    n = f->options.literal ? n : drop_walled_off(f, i, found, n);
    JOX_ASSERT(n <= near->count[i]);
    return n;
}
