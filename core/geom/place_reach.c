#include "geom/place.h"

#include "geom/wall_grid.h"
#include "geom/wall_way.h"

static const float BEYOND = 0.01f; /* m beyond the end of a segment: a gate at its end cuts it */

/* Returns whether one ring cuts the segment from p to q. */
static bool cuts_way(const JoxWalls *walls, uint32_t r, JoxV2 p, JoxV2 q) {
    const struct JoxWallRing *ring = &walls->rings[r];
    for (uint32_t v = ring->first; v < ring->first + ring->count; v++)
        if (jox_edge_lies_between(walls->vertices[v].point,
                                  walls->vertices[walls->vertices[v].next].point, p, q))
            return true;
    return false;
}

/* Returns whether a closed wall cuts the segment from p to a place's nearest point q. `leaves`:
   people leave the world at q, so closed gates at q count too. */
static bool is_way_cut(const JoxWalls *walls, JoxV2 p, JoxV2 q, bool leaves) {
    const JoxV2 beyond = jox_add(q, jox_scale(jox_unit(jox_sub(q, p)), BEYOND));
    for (uint32_t r = 0; walls && r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        const bool shuts = leaves && ring->name;
        if (!ring->open && cuts_way(walls, r, p, shuts ? beyond : q) &&
            (shuts || !ring->solid || !jox_walls_ring_holds(walls, r, q)))
            return true;
    }
    return false;
}

bool jox_place_has_way(const JoxPlace *places, uint32_t index, const JoxWalls *walls, JoxV2 point) {
    const JoxPlace *place = &places[index];
    if (jox_place_is_area(place))
        return true;
    if (!jox_place_is_set(place))
        return !is_way_cut(walls, point, jox_place_nearest(places, index, point), true);
    for (uint32_t m = 0; m < place->member_count; m++)
        if (jox_place_is_reached(places, (uint32_t)place->members[m], walls, point))
            return true;
    return false;
}

void jox_place_is_reached_each(const JoxPlace *places, uint32_t index, const JoxWalls *walls,
                               const JoxV2 *points, uint32_t count, bool *in) {
    jox_place_contains_each(places, index, points, count, in);
    for (uint32_t k = 0; walls && walls->ring_count > 0 && k < count; k++)
        in[k] = in[k] && jox_place_has_way(places, index, walls, points[k]);
}

/* Returns whether a point is on the landing of a place or of a member. */
static bool is_on_landing(const JoxPlace *places, uint32_t index, const JoxWalls *walls,
                          JoxV2 point) {
    const JoxPlace *place = &places[index];
    if (jox_length(jox_sub(place->landing, point)) < place->landing_radius)
        return !is_way_cut(walls, point, place->landing, false);
    for (uint32_t m = 0; m < place->member_count; m++)
        if (is_on_landing(places, (uint32_t)place->members[m], walls, point))
            return true;
    return false;
}

bool jox_place_is_arrival(const JoxPlace *places, uint32_t index, const JoxWalls *walls,
                          JoxV2 point) {
    return jox_place_is_reached(places, index, walls, point) ||
           is_on_landing(places, index, walls, point);
}

void jox_place_is_arrival_each(const JoxPlace *places, uint32_t index, const JoxWalls *walls,
                               const JoxV2 *points, uint32_t count, bool *in) {
    jox_place_is_reached_each(places, index, walls, points, count, in);
    for (uint32_t k = 0; k < count; k++)
        in[k] = in[k] || is_on_landing(places, index, walls, points[k]);
}

bool jox_place_is_near(const JoxPlace *places, uint32_t index, const JoxWalls *walls, JoxV2 point,
                       double distance) {
    const JoxPlace *place = &places[index];
    if (!((double)jox_place_distance(places, index, point) < distance))
        return false;
    if (!walls || walls->ring_count == 0)
        return true;
    if (!jox_place_is_set(place))
        return !is_way_cut(walls, point, jox_place_nearest(places, index, point), false);
    for (uint32_t m = 0; m < place->member_count; m++)
        if (jox_place_is_near(places, (uint32_t)place->members[m], walls, point, distance))
            return true;
    return false;
}
