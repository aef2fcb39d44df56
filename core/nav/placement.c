/* Places for agents that are born, are put elsewhere, or stand in the way of new walls, by the
   search of spots/. world/ calls it between two steps. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "geom/polygon.h"
#include "geom/wall_way.h"
#include "nav/nav_state.h"

static const float STANDING = 0.7f; /* radii: agents nearer than this to a new edge are moved; the
                                       next step pushes the others out */

/* ---- births ---- */

void jox_nav_end_births(JoxNav *nav) {
    jox_spots_free(&nav->spots);
}

/* Returns the table of the spots of all agents: that of the last birth if it still holds, else
   filled anew. */
static JoxSpots *fill_spots(JoxNav *nav, const JoxAgents *a, float radius) {
    JoxSpots *t = &nav->spots;
    if (t->agents == a && t->count == a->count && t->next_id == a->next_id && t->widest >= radius)
        return t;
    jox_spots_free(t);
    *t = jox_spots_begin(&nav->grid, a, radius);
    for (uint32_t i = 0; i < a->count; i++)
        jox_spots_enter(t, i);
    t->count = a->count;
    t->next_id = a->next_id;
    return t;
}

/* Finds a spot in the table `t`: within the place of the wish if it has one; elsewhere too unless
   the agent has to stay there. */
static JoxBirthSpot find_spot_in(JoxSpots *t, const JoxWallGrid *grid, const JoxBirthWish *wish,
                                 JoxV2 *spot) {
    JoxSpotWish search = {.at = wish->at,
                          .radius = wish->radius,
                          .contains = wish->contains,
                          .place = wish->place,
                          .low = wish->low,
                          .high = wish->high,
                          .kind = wish->place_number};
    JOX_ASSERT(!wish->contains == !wish->place_number && (wish->contains || !wish->stays));
    *spot = wish->at;
    if (jox_walls_contain(grid->walls, wish->at))
        return JOX_BIRTH_IN_SOLID;
    if (jox_spots_is_free(t, grid, wish->at, wish->radius))
        return JOX_BIRTH_AS_WISHED;
    t->ended = false;
    if (wish->contains && jox_spots_find(t, grid, &search, spot))
        return JOX_BIRTH_SHIFTED;
    const bool ended = t->ended;
    search.contains = NULL;
    search.kind = 0;
    const bool found = !wish->stays && jox_spots_find(t, grid, &search, spot);
    JOX_ASSERT(!found || !grid->walls ||
               !jox_walls_lie_between(grid->walls, wish->at, *spot, NULL));
    if (!found) /* the last spot that was looked at is taken */
        *spot = wish->at;
    return found ? JOX_BIRTH_SHIFTED : ended || t->ended ? JOX_BIRTH_NOT_FOUND : JOX_BIRTH_NO_ROOM;
}

JoxBirthSpot jox_nav_find_birth(JoxNav *nav, const JoxAgents *a, const JoxBirthWish *wish,
                                JoxV2 *spot) {
    const JoxBirthSpot found =
        find_spot_in(fill_spots(nav, a, wish->radius), &nav->grid, wish, spot);
    *spot = jox_agents_wrapped(a, *spot);
    return found;
}

void jox_nav_note_birth(JoxNav *nav, const JoxAgents *a, uint32_t agent) {
    JoxSpots *t = &nav->spots;
    JOX_ASSERT(t->agents == a && t->count + 1 == a->count && t->next_id + 1 == a->next_id);
    if (t->mask < a->count) { /* the table is too small: the next birth makes a larger one */
        jox_spots_free(t);
        return;
    }
    jox_spots_enter(t, agent);
    t->count = a->count;
    t->next_id = a->next_id;
}

JoxBirthSpot jox_nav_free_spot(JoxNav *nav, const JoxAgents *a, uint32_t agent, JoxV2 *at) {
    const JoxBirthWish wish = {.at = *at, .radius = jox_param(a, JOX_PARAM_radius, agent)};
    JoxSpots t = jox_spots_begin(&nav->grid, a, wish.radius);
    JOX_ASSERT(agent < a->count);
    for (uint32_t i = 0; i < a->count; i++)
        if (i != agent)
            jox_spots_enter(&t, i);
    const JoxBirthSpot found = find_spot_in(&t, &nav->grid, &wish, at);
    jox_spots_free(&t);
    return found;
}

/* ---- new walls ---- */

/* The solids that have a new edge. */
typedef struct NewSolids {
    struct NewSolid {
        JoxV2 low, high; /* m: bounding box */
        uint32_t ring;
    } * items;
    uint32_t count;
    bool *holds; /* by ring: the new solid covers the current agent */
} NewSolids;

static NewSolids list_new_solids(const JoxWalls *walls) {
    NewSolids solids = {.items = jox_alloc((size_t)walls->ring_count + 1, sizeof *solids.items),
                        .holds = jox_alloc((size_t)walls->ring_count + 1, sizeof *solids.holds)};
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        struct NewSolid *solid = &solids.items[solids.count];
        bool is_new = false;
        *solid = (struct NewSolid){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}, r};
        for (uint32_t i = ring->first; i < ring->first + ring->count; i++) {
            const JoxV2 p = walls->vertices[i].point;
            is_new |= walls->vertices[i].is_new;
            solid->low = (JoxV2){jox_minf(solid->low.x, p.x), jox_minf(solid->low.y, p.y)};
            solid->high = (JoxV2){jox_maxf(solid->high.x, p.x), jox_maxf(solid->high.y, p.y)};
        }
        solids.count += ring->solid && is_new;
    }
    return solids;
}

static void free_new_solids(NewSolids *solids) {
    jox_free(solids->items);
    jox_free(solids->holds);
}

/* Marks the new solids that cover a point; returns whether there is one. */
static bool mark_covering_solids(const JoxWalls *walls, NewSolids *solids, JoxV2 p) {
    bool any = false;
    for (uint32_t s = 0; s < solids->count; s++) {
        const struct NewSolid *solid = &solids->items[s];
        const bool holds = jox_is_within(p, solid->low, solid->high) &&
                           jox_walls_ring_holds(walls, solid->ring, p);
        solids->holds[solid->ring] = holds;
        any |= holds;
    }
    return any;
}

/* Returns whether a new edge is nearer to p than `clear` (m) with no old edge before it. */
static bool is_near_new_edge(const JoxWallGrid *grid, JoxV2 p, float clear) {
    uint32_t count;
    const uint32_t *edges = jox_wall_grid_at(grid, p, &count);
    const JoxWallVertex *vertices = grid->walls->vertices;
    for (uint32_t e = 0; e < count; e++) {
        const JoxWallVertex *v = &vertices[edges[e]];
        const JoxV2 q = jox_segment_nearest(v->point, vertices[v->next].point, p);
        bool seen = v->is_new && jox_length2(jox_sub(p, q)) < clear * clear;
        for (uint32_t o = 0; o < count && seen; o++) {
            const JoxWallVertex *other = &vertices[edges[o]];
            seen = other->is_new ||
                   !jox_edge_lies_between(other->point, vertices[other->next].point, p, q);
        }
        if (seen)
            return true;
    }
    return false;
}

/* Moves one agent to the nearest free spot with no wall between, except new solids that cover its
   centre, which it has to leave. Returns false if there is none. */
static bool clear_agent(JoxSpots *t, JoxNav *nav, JoxAgents *a, uint32_t i, NewSolids *solids) {
    const JoxWalls *walls = nav->grid.walls;
    JoxSpotWish wish = {.at = {a->x[i], a->y[i]}, .radius = jox_param(a, JOX_PARAM_radius, i)};
    JoxV2 spot;
    if (mark_covering_solids(walls, solids, wish.at))
        wish.passable = solids->holds;
    if (!jox_spots_find(t, &nav->grid, &wish, &spot))
        return false;
    JOX_ASSERT(!jox_walls_lie_between(walls, wish.at, spot, wish.passable));
    a->x[i] = a->prev_x[i] = a->still_x[i] = spot.x;
    a->y[i] = a->prev_y[i] = a->still_y[i] = spot.y;
    jox_agents_wrap(a, i);
    return true;
}

JoxCleared jox_nav_clear_new_walls(JoxNav *nav, JoxAgents *a) {
    JoxCleared result = {0};
    const JoxWalls *walls = nav->grid.walls;
    if (!walls || walls->count == 0 || a->count == 0)
        return result;
    JoxSpots t = jox_spots_begin(&nav->grid, a, 0.0f);
    NewSolids solids = list_new_solids(walls);
    bool *moves = jox_alloc(a->count, sizeof *moves);
    for (uint32_t i = 0; i < a->count; i++) { /* agents that stay take their spots first */
        const JoxV2 p = {a->x[i], a->y[i]};
        moves[i] = mark_covering_solids(walls, &solids, p) ||
                   is_near_new_edge(&nav->grid, p, STANDING * jox_param(a, JOX_PARAM_radius, i));
        if (!moves[i])
            jox_spots_enter(&t, i);
    }
    for (uint32_t rank = 0; rank < a->count; rank++) {
        const uint32_t i = a->by_rank[rank];
        if (!moves[i])
            continue;
        if (clear_agent(&t, nav, a, i, &solids))
            result.moved++;
        else if (result.stuck++ == 0)
            result.first_stuck = i;
        jox_spots_enter(&t, i);
    }
    JOX_ASSERT(result.moved + result.stuck <= a->count);
    if (result.moved)
        nav->drift = jox_drift_unknown(); /* the order in memory no longer follows the cells */
    jox_spots_free(&t);
    free_new_solids(&solids);
    jox_free(moves);
    return result;
}
