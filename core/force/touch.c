/* Equation 7: contacts of agents with bodies. What holds a body where it stands is solved with them
   (support.c). */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/sort.h"
#include "force/equations.h"
#include "force/internal.h"

static const float CHEST = 1.1f; /* m; people push and are hit there */

float jox_touch_height(const JoxObject *body) {
    return jox_minf(jox_maxf(CHEST, body->low), body->high);
}

/* Body `row` as agent i touches it: false where the gap cannot close within the step, or
   where a wall stands between them. */
static bool touches(const JoxForces *f, uint32_t i, uint32_t row, JoxTouch *touch) {
    const JoxAgents *a = f->step.agents;
    const JoxObject *body = &f->step.objects->rows[row];
    JoxFootprintPoint at = jox_footprint_nearest(body, jox_v2(a->x[i], a->y[i]));
    JoxV2 towards = jox_sub(jox_v2(a->vx[i], a->vy[i]), jox_object_velocity_at(body, at.point));
    float closing = jox_length(towards) * (float)f->step.dt;
    float gap = at.gap - a->breadth[i];
    if (!(gap < JOX_TOUCH_LEAST + jox_minf(JOX_TOUCH_MOST, closing)))
        return false;
    JoxV2 own = {a->x[i], a->y[i]};
    if (at.gap > 0.0f && f->step.walls && jox_wall_grid_separates(f->step.walls, own, at.point))
        return false;
    JOX_ASSERT(jox_is_unit(at.normal));
    JoxV3 point = {at.point.x, at.point.y, jox_touch_height(body)};
    *touch = (JoxTouch){.agent = i, .object = row, .normal = at.normal, .point = point, .gap = gap};
    return true;
}

void jox_touches_find(JoxForces *f, uint32_t begin, uint32_t end) {
    const JoxAgents *a = f->step.agents;
    uint32_t chunk = begin / JOX_FORCE_GRAIN;
    JoxTouch *list = (JoxTouch *)f->touches.items + (size_t)chunk * f->touches.room;
    jox_chunk_empty(&f->touches, chunk);
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
            if (!body->swept && jox_object_reaches(body, at, reach) && touches(f, i, row, &touch))
                jox_nearest_offer(&nearest, touch.gap, row);
        }
        f->touch_number[i] = (uint8_t)nearest.count;
        for (uint32_t k = 0; k < nearest.count; k++) {
            touches(f, i, nearest.rows[k], &touch);
            list[f->touches.counts[chunk]++] = touch;
        }
        JOX_ASSERT(f->touches.counts[chunk] <= f->touches.room);
    }
}

/* By agent id, then row. `context`: the agents. */
static int by_agent(const void *a, const void *b, const void *context) {
    const JoxTouch *x = a, *y = b;
    const uint32_t *id = ((const JoxAgents *)context)->id;
    if (x->agent != y->agent)
        return id[x->agent] < id[y->agent] ? -1 : 1;
    return (x->object > y->object) - (x->object < y->object);
}

void jox_touches_collect(JoxForces *f) {
    const JoxAgents *a = f->step.agents;
    uint32_t count = 0;
    for (uint32_t c = 0; c < f->chunks; c++)
        count += f->touches.counts[c];
    JOX_RESERVE(f->touch, f->touch_capacity, count + JOX_SORT_SPARE(count));
    f->touch_count = 0;
    for (uint32_t c = 0; c < f->chunks; c++) {
        const JoxTouch *list = (const JoxTouch *)f->touches.items + (size_t)c * f->touches.room;
        if (f->touches.counts[c])
            memcpy(f->touch + f->touch_count, list, f->touches.counts[c] * sizeof *list);
        f->touch_count += f->touches.counts[c];
    }
    jox_sort(f->touch, count, sizeof *f->touch, by_agent, a, f->touch + count);
    f->totals.touches = count;
    for (uint32_t t = count; t-- > 0;)
        f->touch_first[f->touch[t].agent] = t;
}

static const float AHEAD = 0.7f; /* cosine to how a body moves, of what it moves towards */

float jox_touch_speed_before(const JoxForces *f, const JoxTouch *t) {
    const JoxObject *body = &f->step.objects->rows[t->object];
    const JoxV3 at = t->point, c = body->position;
    JoxV3 turning = jox_cross3(body->spin, (JoxV3){at.x - c.x, at.y - c.y, at.z - c.z});
    return (body->velocity.x + turning.x) * t->normal.x +
           (body->velocity.y + turning.y) * t->normal.y;
}

float jox_touch_speed_after(const JoxForces *f, const JoxTouch *t) {
    JoxV3 velocity = jox_body_velocity(f, t->object, t->point);
    return velocity.x * t->normal.x + velocity.y * t->normal.y;
}

static void add_impulse(JoxForces *f, const JoxTouch *t, float impulse) {
    float lightness = f->lightness[t->agent];
    f->work[t->agent].x += t->normal.x * impulse * lightness;
    f->work[t->agent].y += t->normal.y * impulse * lightness;
    jox_body_give(f, t->object, t->point,
                  (JoxV3){-t->normal.x * impulse, -t->normal.y * impulse, 0.0f});
}

/* What a contact presses with at most, N s: a body that limits its force as it moves shares that
   among those whom it moves towards. */
static float most_of(const JoxForces *f, const JoxTouch *t) {
    const JoxObject *body = &f->step.objects->rows[t->object];
    const JoxV2 way = jox_unit((JoxV2){body->velocity.x, body->velocity.y});
    uint32_t met = 0;
    if (!(body->most_force > 0.0f) || !(jox_dot(way, t->normal) > AHEAD))
        return INFINITY;
    for (uint32_t k = 0; k < f->touch_count; k++)
        met += f->touch[k].object == t->object && jox_dot(way, f->touch[k].normal) > AHEAD;
    return body->most_force * (float)f->step.dt / (float)met;
}

void jox_touches_begin(JoxForces *f) {
    const JoxAgents *a = f->step.agents;
    size_t kept = 0;
    if (!f->touch_count)
        return;
    jox_supports_begin(f);
    for (uint32_t k = 0; k < f->touch_count; k++) {
        JoxTouch *t = &f->touch[k];
        const JoxObject *body = &f->step.objects->rows[t->object];
        float give = jox_body_inverse_mass(body, t->point, t->normal);
        float restitution =
            jox_minf(jox_param(a, JOX_PARAM_restitution, t->agent), body->restitution);
        float speed = jox_dot(jox_v2(a->vx[t->agent], a->vy[t->agent]), t->normal) -
                      jox_touch_speed_before(f, t);
        t->mass = 1.0f / (1.0f / jox_param(a, JOX_PARAM_mass, t->agent) + give);
        t->target =
            jox_contact_target(t->gap - JOX_BODY_SLACK, speed, restitution, (float)f->step.dt);
        t->most = most_of(f, t);
        t->impulse = jox_minf(
            t->most, jox_kept_impulse(&f->kept_touches, &kept, a->id[t->agent], t->object));
        JOX_ASSERT(t->mass > 0.0f);
    }
    for (uint32_t k = 0; k < f->touch_count; k++)
        add_impulse(f, &f->touch[k], f->touch[k].impulse);
}

/* In ascending agent id, on one thread: touches are few. */
float jox_touches_pass(JoxForces *f) {
    if (!f->touch_count)
        return 0.0f;
    float most = jox_supports_pass(f);
    for (uint32_t k = 0; k < f->touch_count; k++) {
        JoxTouch *t = &f->touch[k];
        float speed = jox_dot(f->work[t->agent], t->normal) - jox_touch_speed_after(f, t);
        float before = t->impulse;
        t->impulse = jox_clampf(before + (t->target - speed) * t->mass, 0.0f, t->most);
        most = jox_maxf(most, fabsf(t->impulse - before));
        add_impulse(f, t, t->impulse - before);
    }
    return most;
}

/* Impulses for the bodies: what people got, with the opposite sign. */
void jox_touches_finish(JoxForces *f) {
    const JoxAgents *a = f->step.agents;
    JoxForceTotals *totals = &f->totals;
    JOX_RESERVE(f->kept_touches.items, f->kept_touches.capacity, f->touch_count);
    f->kept_touches.count = f->touch_count;
    if (f->touch_count && !f->options.literal)
        jox_supports_finish(f);
    for (uint32_t k = 0; k < f->touch_count; k++) {
        const JoxTouch *t = &f->touch[k];
        f->kept_touches.items[k] = (JoxKeptImpulse){a->id[t->agent], t->object, t->impulse};
        const JoxObject *body = &f->step.objects->rows[t->object];
        const bool moves = body->inverse_mass > 0.0f;
        if (!(t->impulse > 0.0f) || !(moves || body->kinematic)) /* that feels it, and no more */
            continue;
        JOX_ASSERT(jox_is_unit(t->normal) && t->agent < a->count);
        JoxV2 impulse = jox_scale(t->normal, t->impulse);
        totals->touched_x += moves ? (double)impulse.x : 0.0;
        totals->touched_y += moves ? (double)impulse.y : 0.0;
        totals->touched += moves ? (double)t->impulse : 0.0;
        jox_force_add_impulse(f, a->id[t->agent], t->object, (JoxV3){-impulse.x, -impulse.y, 0.0f},
                              t->point, f->options.literal ? 0.0f : f->motions[t->object].held);
    }
}
