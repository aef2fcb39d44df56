#include "world/routes/body_obstacles.h"

#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "base/number/pi.h"
#include "geom/polygon.h"

static const float LONG = 1.0f;  /* m: shorter bodies are passed or pushed aside */
static const float SLOW = 0.5f;  /* m/s: faster bodies are gone before a way round them is made */
static const float MOVED = 0.3f; /* m: displacement of a corner that counts */
enum { ROUND = 12 };             /* corners of the polygon round a circle */

static float measure_length(const JoxObject *o) {
    float most2 = 0.0f;
    for (uint32_t i = 0; i < o->footprint_count; i++)
        for (uint32_t k = 0; k < i; k++)
            most2 = jox_maxf(most2, jox_length2(jox_sub(o->footprint[i], o->footprint[k])));
    return o->footprint_count ? sqrtf(most2) : 2.0f * o->round;
}

static bool is_obstacle(const JoxObject *o) {
    if (!o->live || !o->in_band || o->held || o->swept)
        return false;
    if (!o->moves && !o->kinematic)
        return true;
    return jox_length2((JoxV2){o->velocity.x, o->velocity.y}) < SLOW * SLOW &&
           measure_length(o) > LONG;
}

/* Writes a body as an obstacle; a circle becomes the polygon round it. */
static void describe_obstacle(const JoxObject *o, JoxObstacle *out) {
    const JoxObstacleKind kind = o->moves       ? JOX_OBSTACLE_MOVABLE
                                 : o->kinematic ? JOX_OBSTACLE_DRIVEN
                                                : JOX_OBSTACLE_FIXED;
    *out = (JoxObstacle){.id = o->id, .kind = kind, .count = o->footprint_count};
    for (uint32_t i = 0; i < o->footprint_count; i++)
        out->ring[i] = o->footprint[i];
    if (o->footprint_count)
        return;
    out->count = ROUND;
    for (int i = 0; i < ROUND; i++) {
        double angle = JOX_TURN * i / ROUND;
        float r = o->round * 1.035f; /* 1 / cos(pi / 12) */
        out->ring[i] = (JoxV2){o->position.x + r * (float)jox_cos(angle),
                               o->position.y + r * (float)jox_sin(angle)};
    }
}

static const char *find_fault(const JoxObstacles *obstacles) {
    for (uint32_t i = 0; i < obstacles->count; i++) {
        const JoxObstacle *o = &obstacles->items[i];
        JOX_MUST(o->count > 0 && o->count <= JOX_FOOTPRINT_POINTS);
        JOX_MUST(o->kind < JOX_OBSTACLE_KINDS);
        for (uint32_t k = 0; k < o->count; k++)
            JOX_MUST(isfinite(o->ring[k].x) && isfinite(o->ring[k].y));
        for (uint32_t k = 0; k < i; k++)
            JOX_MUST(obstacles->items[k].id != o->id);
    }
    return NULL;
}

/* Returns whether a corner of `a` is farther than MOVED from the outline of `b`. */
static bool sticks_out(const JoxObstacle *a, const JoxObstacle *b) {
    for (uint32_t i = 0; i < a->count; i++) {
        float least2 = INFINITY;
        for (uint32_t k = 0; k < b->count; k++) {
            JoxV2 near = jox_segment_nearest(b->ring[k], b->ring[(k + 1) % b->count], a->ring[i]);
            least2 = jox_minf(least2, jox_length2(jox_sub(near, a->ring[i])));
        }
        if (least2 > MOVED * MOVED)
            return true;
    }
    return false;
}

static bool has_changed(const JoxObstacles *obstacles, const JoxObjects *objects) {
    uint32_t at = 0;
    for (uint32_t row = 0; row < objects->count; row++) {
        const JoxObject *o = &objects->rows[row];
        if (!is_obstacle(o))
            continue;
        if (at == obstacles->count || obstacles->items[at].id != o->id)
            return true;
        JoxObstacle now;
        const JoxObstacle *before = &obstacles->items[at++];
        if (!o->moves && !o->kinematic)
            continue;
        describe_obstacle(o, &now);
        if (sticks_out(&now, before) || sticks_out(before, &now))
            return true;
    }
    return at != obstacles->count;
}

void jox_obstacles_update(JoxObstacles *obstacles, const JoxObjects *objects) {
    if (!has_changed(obstacles, objects))
        return;
    obstacles->count = 0;
    for (uint32_t row = 0; row < objects->count; row++) {
        if (!is_obstacle(&objects->rows[row]))
            continue;
        JOX_RESERVE(obstacles->items, obstacles->capacity, obstacles->count + 1);
        describe_obstacle(&objects->rows[row], &obstacles->items[obstacles->count++]);
    }
    obstacles->version++;
    JOX_CHECK(JOX_NO_FAULT(find_fault(obstacles)));
}

void jox_obstacles_add(const JoxObstacles *obstacles, uint32_t kinds, JoxWalls *walls) {
    for (uint32_t i = 0; i < obstacles->count; i++) {
        const JoxObstacle *o = &obstacles->items[i];
        if ((kinds >> o->kind & 1) && o->count >= 3)
            jox_walls_add_solid(walls, o->ring, o->count, INFINITY);
    }
}

bool jox_obstacles_may_move(const JoxObstacles *obstacles) {
    bool any = false;
    for (uint32_t i = 0; i < obstacles->count; i++)
        any |= obstacles->items[i].kind != JOX_OBSTACLE_FIXED;
    return any;
}

void jox_obstacles_sections(JoxObstacles *obstacles, JoxSections *s) {
    JOX_SECTION_ARRAY(s, "obstacles", obstacles->items, obstacles->count, obstacles->capacity);
    JOX_SECTION(s, "obstacles_version", obstacles->version);
    if (s->mode == JOX_SECTIONS_RESTORE && find_fault(obstacles))
        jox_sections_fail(s, "obstacles", find_fault(obstacles));
}

void jox_obstacles_free(JoxObstacles *obstacles) {
    jox_free(obstacles->items);
    *obstacles = (JoxObstacles){0};
}
