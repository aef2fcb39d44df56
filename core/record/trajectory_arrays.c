/* Adds rows to a recording in memory, returns its frames, and frees it. */
#include "record/trajectories.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"

size_t jox_trajectories_add_row(JoxTrajectories *t) {
    if (t->count == t->capacity) {
        size_t wider = t->capacity ? 2 * t->capacity : 1024;
        t->number = jox_realloc(t->number, wider, sizeof *t->number);
        t->id = jox_realloc(t->id, wider, sizeof *t->id);
        t->line = jox_realloc(t->line, wider, sizeof *t->line);
        t->x = jox_realloc(t->x, wider, sizeof *t->x);
        t->y = jox_realloc(t->y, wider, sizeof *t->y);
        t->vx = jox_realloc(t->vx, wider, sizeof *t->vx);
        t->vy = jox_realloc(t->vy, wider, sizeof *t->vy);
        t->capacity = wider;
    }
    return t->count++;
}

bool jox_trajectories_frame(const JoxTrajectories *t, uint32_t f, JoxFrame *out) {
    if (f >= t->frame_count)
        return false;
    size_t first = t->first[f];
    *out = (JoxFrame){
        .time = (double)t->number[first] / t->fps,
        .count = (uint32_t)(t->first[f + 1] - first),
        .period = t->period,
        .keys = t->keys,
        .key = t->key + first,
        .x = t->x + first,
        .y = t->y + first,
        .vx = t->vx + first,
        .vy = t->vy + first,
        .force = t->force ? t->force + first : NULL,
        .compression = t->compression ? t->compression + first : NULL,
        .load = t->load ? t->load + first : NULL,
        .radius = t->radius ? t->radius + first : NULL,
        .axis_x = t->axis_x ? t->axis_x + first : NULL,
        .axis_y = t->axis_y ? t->axis_y + first : NULL,
        .contact_radius = t->contact_radius ? t->contact_radius + first : NULL,
        .fallen = t->fallen ? t->fallen + first : NULL,
        .walls = t->history ? jox_wall_history_standing(t->history, t->number[first]) : &t->walls,
        .dividing = t->history ? jox_wall_history_dividing(t->history, t->number[first]) : NULL,
        .group = t->group ? t->group + first : NULL,
        .groups = (const char *const *)t->groups,
        .group_count = t->group_count,
        .group_colours = t->group_colours,
        .state = t->state ? t->state + first : NULL,
        .states = (const char *const *)t->states,
        .state_count = t->state_count,
        .state_colours = t->state_colours,
        .storeys = jox_has_storeys(&t->storeys) ? &t->storeys : NULL,
        .cars = jox_lift_history_cars(t->lifts, t->number[first])};
    out->lifts = jox_lift_history_lifts(t->lifts, &out->lift_count);
    return true;
}

const JoxWalls *jox_trajectories_walls(const JoxTrajectories *t, uint32_t f) {
    JOX_ASSERT(f < t->frame_count);
    return t->history ? jox_wall_history_at(t->history, t->number[t->first[f]]) : &t->walls;
}

const JoxStoreys *jox_trajectories_plan_area(const JoxTrajectories *t, JoxV2 *low, JoxV2 *high) {
    *low = t->low;
    *high = t->high;
    if (!jox_has_storeys(&t->storeys))
        return NULL;
    low->y = INFINITY;
    high->y = -INFINITY;
    for (size_t i = 0; i < t->count; i++) {
        const float y = jox_in_plan(&t->storeys, (JoxV2){t->x[i], t->y[i]}).y;
        low->y = jox_minf(low->y, y);
        high->y = jox_maxf(high->y, y);
    }
    for (uint32_t k = 0; k < t->walls.count; k++) {
        const JoxV2 at = jox_in_plan(&t->storeys, t->walls.vertices[k].point);
        *low = (JoxV2){jox_minf(low->x, at.x), jox_minf(low->y, at.y)};
        *high = (JoxV2){jox_maxf(high->x, at.x), jox_maxf(high->y, at.y)};
    }
    return &t->storeys;
}

void jox_trajectories_free(JoxTrajectories *t) {
    if (!t)
        return;
    void *columns[] = {t->number,
                       t->id,
                       t->line,
                       t->key,
                       t->x,
                       t->y,
                       t->vx,
                       t->vy,
                       t->force,
                       t->compression,
                       t->load,
                       t->group,
                       t->first,
                       t->state,
                       t->radius,
                       t->face_x,
                       t->face_y,
                       t->group_colours,
                       t->group_clothes,
                       t->state_colours,
                       t->axis_x,
                       t->axis_y,
                       t->contact_radius,
                       t->fallen};
    for (size_t c = 0; c < sizeof columns / sizeof *columns; c++)
        jox_free(columns[c]);
    for (uint32_t g = 0; g < t->group_count; g++)
        jox_free(t->groups[g]);
    jox_free(t->groups);
    for (uint32_t s = 0; s < t->state_count; s++)
        jox_free(t->states[s]);
    jox_free(t->states);
    jox_walls_free(&t->walls);
    jox_wall_history_free(t->history);
    jox_storeys_free(&t->storeys);
    jox_lift_history_free(t->lifts);
    jox_free(t);
}
