/* Finds contacts of agents with bodies ("touches"), chunk by chunk, and sorts them. */
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/sort.h"
#include "force/contact/contacts.h"

/* Finds the contact of agent i with body `row`. Returns false if the gap cannot close within the
   step, or a wall stands between them. */
static bool find_touch(const JoxForces *f, uint32_t i, uint32_t row, JoxTouch *touch) {
    const JoxAgents *a = f->step.agents;
    const JoxObject *body = &f->step.objects->rows[row];
    JoxFootprintPoint at = jox_footprint_nearest(body, jox_v2(a->x[i], a->y[i]));
    JoxV2 towards = jox_sub(jox_v2(a->vx[i], a->vy[i]), jox_object_velocity_at(body, at.point));
    float closing = jox_length(towards) * (float)f->step.timing.dt;
    float gap = at.gap - a->breadth[i];
    if (!(gap < JOX_TOUCH_LEAST + jox_minf(JOX_TOUCH_MOST, closing)))
        return false;
    JoxV2 own = {a->x[i], a->y[i]};
    if (at.gap > 0.0f && f->in.walls && jox_wall_grid_has_wall_between(f->in.walls, own, at.point))
        return false;
    JOX_ASSERT(jox_is_unit(at.normal));
    JoxV3 point = {at.point.x, at.point.y, jox_touch_height(body)};
    *touch = (JoxTouch){.agent = i, .object = row, .normal = at.normal, .point = point, .gap = gap};
    return true;
}

void jox_touches_reserve(JoxForces *f) {
    const uint32_t n = f->step.agents->count;
    JoxTouches *touches = &f->contacts->touches;
    jox_chunks_reserve(&touches->found, f->chunks,
                       jox_most_chunk_agents(f) * JOX_MOST_BODIES_TOUCHED, sizeof(JoxTouch));
    JOX_RESERVE(touches->first, touches->first_capacity, n);
    JOX_RESERVE(touches->number, touches->number_capacity, n);
}

void jox_touches_find(JoxForces *f, uint32_t begin, uint32_t end) {
    JoxTouches *touches = &f->contacts->touches;
    const JoxAgents *a = f->step.agents;
    uint32_t chunk = begin / JOX_FORCE_GRAIN;
    JoxTouch *list = (JoxTouch *)touches->found.items + (size_t)chunk * touches->found.room;
    jox_chunk_clear(&touches->found, chunk);
    for (uint32_t i = begin; i < end; i++) {
        JoxV2 at = {a->x[i], a->y[i]};
        float reach = jox_param(a, JOX_PARAM_radius, i) + JOX_TOUCH_LEAST + JOX_TOUCH_MOST;
        JoxNearest nearest;
        jox_nearest_begin(&nearest, JOX_MOST_BODIES_TOUCHED);
        JoxObjectWalk walk = jox_objects_near(f->step.objects, at, reach);
        JoxTouch touch;
        uint32_t row;
        while (jox_objects_next(&walk, &row)) {
            const JoxObject *body = &f->step.objects->rows[row];
            if (!body->swept && jox_referred(a->parting[i]) != (int32_t)row &&
                jox_object_reaches(body, at, reach) && find_touch(f, i, row, &touch))
                jox_nearest_offer(&nearest, touch.gap, row);
        }
        touches->number[i] = (uint8_t)nearest.count;
        for (uint32_t k = 0; k < nearest.count; k++) {
            find_touch(f, i, nearest.rows[k], &touch);
            list[touches->found.counts[chunk]++] = touch;
        }
        JOX_ASSERT(touches->found.counts[chunk] <= touches->found.room);
    }
}

/* Compares by agent id, then row. `context`: the agents. */
static int compare_touches(const void *a, const void *b, const void *context) {
    const JoxTouch *x = a, *y = b;
    const uint32_t *id = ((const JoxAgents *)context)->id;
    if (x->agent != y->agent)
        return id[x->agent] < id[y->agent] ? -1 : 1;
    return (x->object > y->object) - (x->object < y->object);
}

void jox_touches_sort(JoxForces *f) {
    JoxTouches *touches = &f->contacts->touches;
    const JoxAgents *a = f->step.agents;
    uint32_t count = 0;
    for (uint32_t c = 0; c < f->chunks; c++)
        count += touches->found.counts[c];
    JOX_RESERVE(touches->items, touches->capacity, count + JOX_SORT_SPARE(count));
    touches->count = 0;
    for (uint32_t c = 0; c < f->chunks; c++) {
        const JoxTouch *list =
            (const JoxTouch *)touches->found.items + (size_t)c * touches->found.room;
        if (touches->found.counts[c])
            memcpy(touches->items + touches->count, list, touches->found.counts[c] * sizeof *list);
        touches->count += touches->found.counts[c];
    }
    jox_sort(touches->items, count, sizeof *touches->items, compare_touches, a,
             touches->items + count);
    f->totals.touches = count;
    for (uint32_t t = count; t-- > 0;)
        touches->first[touches->items[t].agent] = t;
}

void jox_touches_free(JoxTouches *touches, JoxDrives *drives) {
    void *owned[] = {touches->items, touches->first, touches->number, drives->items, drives->loads};
    jox_chunks_free(&touches->found);
    for (size_t i = 0; i < sizeof owned / sizeof *owned; i++)
        jox_free(owned[i]);
}
