/* Which agents a force can reach: those in a cone, with no wall between. */
#define JOX_ISA_scalar
#include <math.h>

#include "force/cone_lanes.h"

bool jox_wall_stops_force(const JoxForces *f, JoxV2 from, JoxV2 to) {
    /* Tests from either end, as the grid lists edges up to half of the distance only. */
    const JoxWallGrid *walls = f->in.walls;
    return walls && (jox_wall_grid_has_wall_between(walls, from, to) ||
                     jox_wall_grid_has_wall_between(walls, to, from));
}

uint32_t jox_find_walled_off(const JoxForces *f, uint32_t i, uint32_t doubtful) {
    const JoxV2 from = {f->step.agents->x[i], f->step.agents->y[i]};
    uint32_t walled_off = 0;
    while (doubtful) {
        const uint32_t bit = doubtful & -doubtful, other = jox_take_found(f, i, &doubtful);
        if (jox_wall_stops_force(f, from, jox_add(from, jox_offset(f->step.agents, i, other))))
            walled_off |= bit;
    }
    return walled_off;
}

uint32_t jox_literal_people_in_cone(const JoxForces *f, uint32_t i, JoxV2 axis) {
    const JoxConeReach reach = {JOX_PARAM_brace_angle, INFINITY, true};
    const JoxVector along = {axis.x, axis.y};
    return (uint32_t)jox_find_people_in_cone(f, i, 1, &reach, along, 0.0f).found;
}
