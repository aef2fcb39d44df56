/* The public call jo_world_path: the way from a point to a place, by a distance field that is kept
   until walls change or another place is asked for. */
#include <math.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "geom/polygon.h"
#include "world/embed/storey_points.h"
#include "world/routes/joined_edges.h"
#include "world/world.h"

static const float CLEARANCE = 0.25f, CELL = 0.2f, STRIDE = 0.25f, AROUND = 10.0f; /* m */
enum { MOST_STRIDES = 200000 };

/* Computes the box of the field: walls, places and the point, with a margin. */
static void find_box(const JoWorld *w, const JoxWalls *walls, JoxV2 from, JoxV2 *low, JoxV2 *high) {
    *low = *high = from;
    for (uint32_t v = 0; v < walls->count; v++) {
        const JoxV2 p = walls->vertices[v].point;
        *low = (JoxV2){jox_minf(low->x, p.x), jox_minf(low->y, p.y)};
        *high = (JoxV2){jox_maxf(high->x, p.x), jox_maxf(high->y, p.y)};
    }
    for (uint32_t p = 0; p < w->model.scene_places; p++) {
        const JoxPlace *place = &w->model.places[p];
        *low = (JoxV2){jox_minf(low->x, place->low.x), jox_minf(low->y, place->low.y)};
        *high = (JoxV2){jox_maxf(high->x, place->high.x), jox_maxf(high->y, place->high.y)};
    }
    *low = (JoxV2){low->x - AROUND, low->y - AROUND};
    *high = (JoxV2){high->x + AROUND, high->y + AROUND};
}

static const JoxField *get_field(JoWorld *w, uint32_t place, JoxV2 from) {
    JoxStepEvents *h = &w->scratch.step_events;
    if (h->field && h->field_place == place && h->field_walls == w->state.walls_version)
        return h->field;
    JoxWalls standing = {0};
    JoxV2 low, high;
    const JoxAgents *a = &w->state.agents;
    jox_walls_for_ways(&standing, &w->model.all_walls, true);
    find_box(w, &standing, from, &low, &high);
    JoxPlace *places = w->model.places;
    uint32_t count = w->model.place_count, goal = place;
    const bool over_edges = jox_routes_lead_over_edges(a, &standing);
    if (over_edges) {
        jox_routes_add_wall_images(a, &standing);
        jox_routes_box_over_edges(a, CELL, &low, &high);
        places = jox_places_copy_goal(w->model.places, place, &count);
        jox_routes_add_goal_images(a, &places, &count);
        goal = 0;
    }
    jox_field_free(h->field);
    jox_field_marks_free(h->marks);
    h->field = NULL;
    h->marks = NULL;
    h->field = jox_field_create(&standing, places, goal, low, high, CELL, CLEARANCE, NULL,
                                a->storeys, NULL, &h->marks);
    if (over_edges)
        jox_places_free_goal(places, count);
    h->field_place = place;
    h->field_walls = w->state.walls_version;
    jox_walls_free(&standing);
    return h->field;
}

static uint32_t trace_way(JoWorld *w, uint32_t place, JoxV2 at, double *xy, uint32_t capacity,
                          double *out) {
    const JoxField *field = get_field(w, place, at);
    uint32_t count = 0;
    double walked = 0.0, unused = 0.0, *length = out ? out : &unused;
    *length = INFINITY;
    if (!isfinite(jox_field_distance(field, at)))
        return 0;
    for (uint32_t n = 0; n < MOST_STRIDES; n++) {
        if (count < capacity && xy) {
            xy[2 * (size_t)count] = (double)at.x;
            xy[2 * (size_t)count + 1] = (double)at.y;
        }
        count++;
        if (jox_place_is_reached(w->model.places, place, &w->model.all_walls, at)) {
            *length = walked;
            return count;
        }
        const JoxV2 way = jox_field_direction(field, at);
        const JoxV2 goal = jox_place_nearest(w->model.places, place, at);
        const float left = jox_length(jox_sub(goal, at));
        const bool last = left <= STRIDE || jox_length2(way) == 0.0f;
        const JoxV2 next = last ? goal : jox_add(at, jox_scale(way, STRIDE));
        walked += (double)jox_length(jox_sub(next, at));
        at = jox_agents_wrapped(&w->state.agents, next);
        const JoxStoreys *storeys = w->state.agents.storeys;
        const JoxSeam *seam = storeys ? jox_find_crossed_seam(storeys, at) : NULL;
        at.y += seam ? seam->shift : 0.0f;
    }
    return 0; /* the way does not end */
}

static uint32_t trace_way_to(JoWorld *w, double x, double y, const char *place, double *xy,
                             uint32_t capacity, double *length) {
    const JoxV2 at = jox_agents_wrapped(&w->state.agents, (JoxV2){(float)x, (float)y});
    const int found = jox_place_find(w->model.places, w->model.scene_places, place);
    if (found >= 0)
        return trace_way(w, (uint32_t)found, at, xy, capacity, length);
    if (length)
        *length = INFINITY;
    return 0;
}

uint32_t jo_world_path(JoWorld *world, double x, double y, const char *place, double *xy,
                       uint32_t capacity, double *length) {
    JOX_REQUIRE(world && !world->busy && place && fabs(x) <= 1e4 && fabs(y) <= 1e4, 0);
    JOX_GUARD (world->heap, NULL)
        return 0;
    return trace_way_to(world, x, y, place, xy, capacity, length);
}

/* Does the same as trace_way_to, with points in plan. */
static uint32_t trace_way_in_plan(JoWorld *w, double x, double y, const char *place, JoWhere *out,
                                  uint32_t capacity, double *length) {
    double *xy = jox_alloc(2 * (size_t)capacity + 1, sizeof *xy);
    const uint32_t count = trace_way_to(w, x, y, place, xy, capacity, length);
    for (uint32_t k = 0; k < count && k < capacity; k++) {
        const double *at = &xy[2 * (size_t)k];
        out[k] = jox_world_where(w, (JoxV2){(float)at[0], (float)at[1]});
    }
    jox_free(xy);
    return count;
}

uint32_t jo_world_path_on(JoWorld *world, uint32_t storey, double x, double y, const char *place,
                          JoWhere *out, uint32_t capacity, double *length) {
    JOX_REQUIRE(world && !world->busy && place && fabs(x) <= 1e4 && fabs(y) <= 1e4, 0);
    JOX_REQUIRE(jox_world_has_storey(world, storey) && (out || capacity == 0), 0);
    JOX_GUARD (world->heap, NULL)
        return 0;
    return trace_way_in_plan(world, x, jox_world_move_to_storey(world, storey, y), place, out,
                             capacity, length);
}
