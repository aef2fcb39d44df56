/* Finds contacts of agents with bodies ("touches"), chunk by chunk, and sorts them. */
#include <math.h>
#include <string.h>

#include "agents/torso.h"
#include "base/assert.h"
#include "base/mem.h"
#include "base/sort.h"
#include "force/contact/contacts.h"

/* Finds the contact of a point of agent i's axis, `own` m from its centre, with body `row`. Returns
   false if the gap cannot close within the step, or a wall stands between them. */
static bool find_touch_at(const JoxForces *f, uint32_t i, JoxV2 own, uint32_t row,
                          JoxTouch *touch) {
    const JoxAgents *a = f->step.agents;
    const JoxObject *body = &f->step.objects->rows[row];
    const JoxV2 centre = {a->x[i], a->y[i]};
    JoxFootprintPoint at = jox_footprint_nearest(body, jox_add(centre, own));
    JoxV2 towards = jox_sub(jox_v2(a->vx[i], a->vy[i]), jox_object_velocity_at(body, at.point));
    const float half = jox_torso_half(a, i);
    float closing = (jox_length(towards) + (half > 0.0f ? fabsf(a->spin[i]) * half : 0.0f)) *
                    (float)f->step.timing.dt;
    float gap = at.gap - a->contact_radius[i];
    if (!(gap < JOX_TOUCH_LEAST + jox_minf(JOX_TOUCH_MOST, closing)))
        return false;
    if (at.gap > 0.0f && f->in.walls &&
        jox_wall_grid_has_wall_between(f->in.walls, centre, at.point))
        return false;
    JOX_ASSERT(jox_is_unit(at.normal));
    JoxV3 point = {at.point.x, at.point.y, jox_touch_height(body)};
    *touch = (JoxTouch){.agent = i, .object = row, .normal = at.normal, .point = point, .gap = gap};
    if (half > 0.0f)
        touch->lever = jox_det(own, at.normal) / jox_torso_gyration(a, i);
    return true;
}

/* Returns the point of agent i's axis, from its centre, m, at which a body is near as seen from one
   `end` (-1 or 1): the end itself, or where the axis passes a corner or a round side. */
static JoxV2 find_near_point(const JoxForces *f, uint32_t i, JoxV2 axis, float end, uint32_t row) {
    const JoxObject *body = &f->step.objects->rows[row];
    const JoxV2 centre = {f->step.agents->x[i], f->step.agents->y[i]};
    const float half2 = jox_length2(axis);
    for (int k = 0; k < 6; k++) {
        const JoxV2 own = jox_scale(axis, end);
        const JoxFootprintPoint at = jox_footprint_nearest(body, jox_add(centre, own));
        const float along = jox_dot(jox_sub(at.point, centre), axis) / half2;
        const float next = jox_clampf(along, -1.0f, 1.0f), step = next - end;
        if (!(at.gap > 0.0f) || !(step * step * half2 > 1e-6f))
            return own;
        end = next;
    }
    return jox_scale(axis, end);
}

/* Finds the contacts of agent i with body `row`, the nearest first. Returns how many. */
static uint32_t find_touches(const JoxForces *f, uint32_t i, uint32_t row, JoxTouch out[2]) {
    const JoxAgents *a = f->step.agents;
    const JoxV2 axis = {a->axis_x[i], a->axis_y[i]};
    if (axis.x == 0.0f && axis.y == 0.0f)
        return find_touch_at(f, i, axis, row, &out[0]);
    const JoxV2 right = find_near_point(f, i, axis, -1.0f, row);
    const JoxV2 left = find_near_point(f, i, axis, 1.0f, row);
    uint32_t count = find_touch_at(f, i, right, row, &out[0]);
    if (jox_length2(jox_sub(left, right)) < JOX_SECOND_APART * JOX_SECOND_APART)
        return count;
    count += find_touch_at(f, i, left, row, &out[count]);
    if (count == 2 && out[1].gap < out[0].gap) {
        const JoxTouch nearer = out[1];
        out[1] = out[0];
        out[0] = nearer;
    }
    return count;
}

void jox_touches_reserve(JoxForces *f) {
    const uint32_t n = f->step.agents->count;
    JoxTouches *touches = &f->contacts->touches;
    jox_chunks_reserve(&touches->found, NULL, f->chunks,
                       2 * jox_most_chunk_agents(f) * JOX_MOST_BODIES_TOUCHED, sizeof(JoxTouch));
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
        float reach =
            a->contact_radius[i] + jox_torso_half(a, i) + JOX_TOUCH_LEAST + JOX_TOUCH_MOST;
        JoxNearest nearest;
        jox_nearest_begin(&nearest, JOX_MOST_BODIES_TOUCHED);
        JoxObjectWalk walk = jox_objects_near(f->step.objects, at, reach);
        JoxTouch touch[2];
        uint32_t row;
        while (jox_objects_next(&walk, &row)) {
            const JoxObject *body = &f->step.objects->rows[row];
            if (!body->swept && jox_referred(a->parting[i]) != (int32_t)row &&
                jox_object_reaches(body, at, reach) && find_touches(f, i, row, touch))
                jox_nearest_offer(&nearest, touch[0].gap, row);
        }
        touches->number[i] = 0;
        for (uint32_t k = 0; k < nearest.count; k++) {
            const uint32_t found = find_touches(f, i, nearest.rows[k], touch);
            for (uint32_t n = 0; n < found; n++)
                list[touches->found.counts[chunk]++] = touch[n];
            touches->number[i] += (uint8_t)found;
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
    if (x->object != y->object)
        return x->object < y->object ? -1 : 1;
    return (x->lever > y->lever) - (x->lever < y->lever);
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
