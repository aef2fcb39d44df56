/* The way of one agent past walls within a step; the kernel of move calls it for agents near
   walls. */
#include <math.h>

#include "geom/wall_way.h"
#include "nav/move/move.h"

#define MOST_PIECES 1e5f /* pieces of a way; a longer way leaves the world */

JoxV2 jox_nav_move_past_walls(const JoxMove *m, JoxV2 from, JoxV2 to, float radius) {
    const JoxWallGrid *grid = &m->nav->grid;
    const JoxV2 way = jox_sub(to, from);
    const float pieces = ceilf(jox_length(way) / m->served);
    if (m->served >= grid->reach || !(pieces > 1.0f && pieces < MOST_PIECES))
        return jox_way_by_walls(grid, from, to, radius);
    JoxV2 at = from;
    for (float n = 1.0f; n <= pieces; n++) {
        const JoxV2 piece = jox_sub(jox_add(from, jox_scale(way, n / pieces)), at);
        const JoxV2 seen = jox_agents_wrapped(m->step.agents, at);
        const JoxV2 aim = jox_add(seen, piece);
        const JoxV2 end = jox_way_by_walls(grid, seen, aim, radius);
        at = jox_add(at, jox_sub(end, seen));
        if (end.x != aim.x || end.y != aim.y)
            break;
    }
    return at;
}
