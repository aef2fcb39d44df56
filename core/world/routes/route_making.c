#include "world/routes/route_making.h"

#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "machine/lifts.h"
#include "world/routes/joined_edges.h"

/* m: sizes of cells; a field has the smallest with at most JOX_ROUTE_CELLS cells, so that it is
   done within DELAY. The largest still shows doors of half a metre. */
static const float CELLS[] = {0.125f, 0.18f, 0.25f, 0.3f};
static const float MOST_ROOM = 1.5f; /* greatest area of a reused box, in areas of a new one */
static const float SPARE = 3.0f;     /* m: margin added once agents went beyond the previous box */
static const float MARGIN = 3.0f;    /* m: margin round all walls and agents */

void jox_route_making_free(JoxRouteMaking *making) {
    jox_places_free_goal(making->places, making->place_count);
    jox_walls_free(&making->walls);
    jox_free(making->stairs.stairs);
    jox_free(making->crowd.at);
    jox_free(making->crowd.held);
    jox_field_free(making->field);
    jox_field_marks_free(making->marks);
    jox_free(making);
}

void jox_route_making_run(JoxWorkItem *item) {
    JoxRouteMaking *m = (JoxRouteMaking *)item;
    m->field = jox_field_create(&m->walls, m->places, 0, m->low, m->high, m->cell, m->clearance,
                                &m->crowd, m->storeys ? &m->stairs : NULL,
                                m->by_lifts ? &m->lifts : NULL, m->keeps_marks ? &m->marks : NULL);
    jox_field_set_storeys(m->field, m->storeys);
}

/* Returns whether the box of the previous field contains low..high, and is not much larger than a
   new box for it. */
static bool can_reuse_box(const JoxField *before, JoxV2 low, JoxV2 high, float cell) {
    JoxV2 from, to;
    float size;
    if (!before)
        return false;
    jox_field_box(before, &from, &to, &size);
    const float width = high.x - low.x + 2.0f * SPARE, height = high.y - low.y + 2.0f * SPARE;
    return size == cell && jox_is_within(low, from, to) && jox_is_within(high, from, to) &&
           (to.x - from.x) * (to.y - from.y) < MOST_ROOM * width * height;
}

/* Returns the height of a field's grid, m. */
static float measure_height(const JoxRouteStage *w, JoxV2 low, JoxV2 high, float cell) {
    return w->agents->storeys ? jox_field_height_of_sheets(w->agents->storeys, cell)
                              : high.y - low.y;
}

/* Sets the box of a field round all walls, open gates too, and agents; its corner is on the grid of
   cells. If possible it is the box of the previous field, so that narrow gaps are judged alike and
   marks of walls can be reused. */
static void set_box(const JoxRouteStage *w, const JoxField *before, float most_cells,
                    JoxRouteMaking *making) {
    const JoxWalls *walls = w->all_walls;
    JoxV2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (uint32_t i = 0; i < walls->count + w->agents->count; i++) {
        JoxV2 p = i < walls->count
                      ? walls->vertices[i].point
                      : (JoxV2){w->agents->x[i - walls->count], w->agents->y[i - walls->count]};
        low = (JoxV2){jox_minf(low.x, p.x), jox_minf(low.y, p.y)};
        high = (JoxV2){jox_maxf(high.x, p.x), jox_maxf(high.y, p.y)};
    }
    low = jox_sub(low, (JoxV2){MARGIN, MARGIN});
    high = jox_add(high, (JoxV2){MARGIN, MARGIN});
    const bool over_edges = jox_routes_lead_over_edges(w->agents, walls);
    if (over_edges)
        jox_routes_box_over_edges(w->agents, 0.0f, &low, &high);
    int c = 0;
    while (c < 3 && (high.x - low.x) * measure_height(w, low, high, CELLS[c]) >
                        most_cells * CELLS[c] * CELLS[c])
        c++;
    float cell = CELLS[c];
    if (w->agents->storeys) { /* inside the grid, whose rows depend on the cells alone */
        low.y = cell;
        high.y = 2.0f * cell;
    }
    if (over_edges)
        jox_routes_box_over_edges(w->agents, cell, &low, &high);
    JOX_ASSERT(low.x < high.x && low.y < high.y); /* there are walls or agents */
    if (can_reuse_box(before, low, high, cell)) {
        jox_field_box(before, &making->low, &making->high, &making->cell);
        return;
    }
    const float spare = before ? SPARE : 0.0f;
    low = jox_sub(low, (JoxV2){spare, spare});
    high = jox_add(high, (JoxV2){spare, spare});
    if (over_edges)
        jox_routes_box_over_edges(w->agents, cell, &low, &high);
    making->cell = cell;
    making->low = (JoxV2){floorf(low.x / cell) * cell, floorf(low.y / cell) * cell};
    making->high = high;
}

static void copy_stairs(const JoxStoreys *storeys, JoxRouteMaking *making) {
    making->storeys = storeys;
    if (!storeys)
        return;
    making->stairs = *storeys;
    making->stairs.stairs = jox_copy_array(storeys->stairs, storeys->stair_count, sizeof(JoxStair));
}

static void copy_lifts(const JoxLiftView *view, const JoxRouteFieldOptions *look,
                       JoxRouteMaking *making) {
    making->by_lifts = look->lifts && view;
    if (!making->by_lifts)
        return;
    making->lifts = (JoxFieldLifts){
        .lifts = view->lifts, .count = view->lift_count, .stepless = look->stepless};
    for (uint32_t l = 0; l < view->lift_count; l++)
        making->lifts.modes[l] = look->all_lifts ? JOX_LIFT_IN_USE : (uint8_t)view->cars[l].mode;
}

JoxRouteMaking *jox_route_making_prepare(const JoxRouteStage *w, const JoxObstacles *obstacles,
                                         uint32_t place, const JoxRouteFieldOptions *look,
                                         float most_cells, const JoxField *before) {
    JoxRouteMaking *making = jox_alloc(1, sizeof *making);
    making->item.run = jox_route_making_run;
    making->clearance = look->clearance;
    copy_stairs(w->agents->storeys, making);
    copy_lifts(w->machines->lifts, look, making);
    jox_walls_for_ways(&making->walls, w->all_walls, look->gates);
    jox_obstacles_add(obstacles, look->bodies, &making->walls);
    for (uint32_t k = 0; look->stepless && k < making->stairs.stair_count; k++)
        making->stairs.stairs[k].closed |= making->stairs.stairs[k].kind != JOX_STAIR_RAMP;
    making->places = jox_places_copy_goal(w->places, place, &making->place_count);
    if (jox_routes_lead_over_edges(w->agents, w->all_walls)) {
        jox_routes_add_wall_images(w->agents, &making->walls);
        jox_routes_add_goal_images(w->agents, &making->places, &making->place_count);
    }
    set_box(w, before, most_cells, making);
    return making;
}
