/* Checks whether solid scenery stands where people can walk, as nothing keeps them out of it.
   `jostle check` calls it (validate/check.c). */
#include "run/scenery_checks.h"

#include <math.h>

#include "base/mem.h"
#include "geom/ground/standable.h"
#include "geom/polygon.h"
#include "geom/storey_text.h"
#include "run/run.h"

static const float MOST_CELLS = 250000.0f; /* of the floor */
static const float BESIDE = 0.25f;         /* m: nearer to a wall, people do not walk */
static const float STEP = 0.5f;            /* m between points of a fence that are tested */
enum { ACROSS = 5 };                       /* points across a footprint that are tested */

/* The floor of a scene, and the parts of it that people walk on. */
typedef struct Floor {
    const JoxWalls *walls;
    JoxV2 low, high; /* m */
    JoxStandable ground;
    bool *walked; /* by part of the ground */
} Floor;

static void extend_box(Floor *floor, JoxV2 point) {
    floor->low = jox_v2(fminf(floor->low.x, point.x), fminf(floor->low.y, point.y));
    floor->high = jox_v2(fmaxf(floor->high.x, point.x), fmaxf(floor->high.y, point.y));
}

/* Finds the box around walls and people, within which people are taken to walk. */
static void measure_floor(Floor *floor, const JoScene *scene) {
    const JoxAgents *a = &scene->world->state.agents;
    floor->low = jox_v2(INFINITY, INFINITY);
    floor->high = jox_v2(-INFINITY, -INFINITY);
    for (uint32_t v = 0; v < floor->walls->count; v++)
        extend_box(floor, floor->walls->vertices[v].point);
    for (uint32_t i = 0; i < a->count; i++)
        extend_box(floor, jox_v2(a->x[i], a->y[i]));
    for (uint32_t s = 0; s < scene->spec->source_count; s++)
        extend_box(floor, scene->world->model.places[scene->spec->sources[s].place].centre);
}

static void mark_walked(Floor *floor, JoxV2 at) {
    floor->walked[jox_standable_part(&floor->ground, jox_standable_cell(&floor->ground, at))] =
        true;
}

/* Returns the kind of a place that is an area. */
static int find_area_kind(void) {
    int kind = 0;
    while (jox_place_kinds[kind].outline != JOX_OUTLINE_RING)
        kind++;
    return kind;
}

/* Divides the floor into parts, and marks those that people start on or come in on. */
static void lay_floor(Floor *floor, const JoScene *scene) {
    const JoxAgents *a = &scene->world->state.agents;
    JoxV2 corners[4] = {floor->low, jox_v2(floor->high.x, floor->low.y), floor->high,
                        jox_v2(floor->low.x, floor->high.y)};
    JoxPlace box = {.name = "", .kind = find_area_kind(), .points = corners, .count = 4};
    jox_place_finish(&box);
    jox_standable_lay(&floor->ground, &box, 0.0f, MOST_CELLS, floor->walls, NULL, NULL);
    floor->walked = jox_alloc((size_t)floor->ground.part_count + 1, sizeof *floor->walked);
    for (uint32_t i = 0; i < a->count; i++)
        mark_walked(floor, jox_v2(a->x[i], a->y[i]));
    for (uint32_t s = 0; s < scene->spec->source_count; s++)
        mark_walked(floor, scene->world->model.places[scene->spec->sources[s].place].centre);
    floor->walked[0] = false; /* blocked cells */
}

/* Whether people can walk to a point: within the box, in no wall and not beside one. */
static bool is_walked(const Floor *floor, JoxV2 point) {
    const JoxWalls *walls = floor->walls;
    if (point.x < floor->low.x || point.x > floor->high.x || point.y < floor->low.y ||
        point.y > floor->high.y)
        return false;
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        JoxV2 *points = jox_walls_ring_points(walls, r);
        const float away =
            jox_polygon_distance(points, walls->rings[r].count, point, walls->rings[r].solid);
        jox_free(points);
        if (away < BESIDE)
            return false;
    }
    return floor
        ->walked[jox_standable_part(&floor->ground, jox_standable_cell(&floor->ground, point))];
}

/* Finds a point of a copy's footprint that people can walk to. */
static bool find_walked_spot(const Floor *floor, const JoxV2 corners[4], JoxV2 *spot) {
    for (int i = 0; i < ACROSS; i++)
        for (int j = 0; j < ACROSS; j++) {
            const float u = ((float)i + 0.5f) / ACROSS, v = ((float)j + 0.5f) / ACROSS;
            const JoxV2 across = jox_sub(corners[1], corners[0]),
                        along = jox_sub(corners[3], corners[0]);
            *spot = jox_v2(corners[0].x + u * across.x + v * along.x,
                           corners[0].y + u * across.y + v * along.y);
            if (is_walked(floor, *spot))
                return true;
        }
    return false;
}

static bool find_walked_fence(const Floor *floor, const JoxScenery *fence, JoxV2 *spot) {
    for (uint32_t p = 0; p + 1 < fence->through_count; p++) {
        const JoxV2 from = fence->through[p], way = jox_sub(fence->through[p + 1], from);
        const int pieces = 1 + (int)(jox_length(way) / STEP);
        for (int k = 0; k <= pieces; k++) {
            const float share = (float)k / (float)pieces;
            *spot = jox_v2(from.x + share * way.x, from.y + share * way.y);
            if (is_walked(floor, *spot))
                return true;
        }
    }
    return false;
}

static bool find_walked(const Floor *floor, const JoxScenery *scenery, JoxV2 *spot) {
    if (jox_scenery_kinds[scenery->kind].form == JOX_SCENERY_FENCE)
        return find_walked_fence(floor, scenery, spot);
    for (uint32_t k = 0; k < scenery->at_count; k++) {
        JoxV2 corners[4];
        jox_scenery_footprint(scenery, k, corners);
        if (find_walked_spot(floor, corners, spot))
            return true;
    }
    return false;
}

static bool is_obstacle(const JoxScenery *scenery) {
    const JoxSceneryForm form = jox_scenery_kinds[scenery->kind].form;
    return !scenery->body && (form == JOX_SCENERY_SOLID || form == JOX_SCENERY_FENCE);
}

void jox_run_check_scenery(const JoScene *scene, JoxDiagnostics *diagnostics) {
    const JoxSceneSpec *spec = scene->spec;
    JoxWalls walls = {0};
    Floor floor = {.walls = &walls};
    uint32_t first = 0;
    while (first < spec->scenery_count && !is_obstacle(&spec->scenery[first]))
        first++;
    if (first == spec->scenery_count)
        return;
    jox_walls_standing(&walls, &scene->world->model.all_walls, true);
    measure_floor(&floor, scene);
    if (floor.low.x < floor.high.x && floor.low.y < floor.high.y) {
        lay_floor(&floor, scene);
        for (uint32_t i = first; i < spec->scenery_count; i++) {
            const JoxScenery *scenery = &spec->scenery[i];
            JoxText where = {0};
            JoxV2 spot;
            if (!is_obstacle(scenery) || !find_walked(&floor, scenery, &spot))
                continue;
            jox_text_position(&where, &spec->storeys, spot, 1);
            jox_diag_warn(diagnostics, scenery->position, "scenery-without-wall",
                          "Move it, or give it a wall: {solid: [[0, 0], [1, 0], [1, 1]]}",
                          "people can walk through this %s, at %s",
                          jox_scenery_kinds[scenery->kind].name, where.data);
            jox_text_free(&where);
        }
    }
    jox_standable_free(&floor.ground);
    jox_free(floor.walked);
    jox_walls_free(&walls);
}
