/* Where agents meet bodies, and equation 7: their contacts with them. */
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

/* The nearest bodies whose footprints come nearer than `reach` to a point, in ascending row. */
static JoxNearest nearest_bodies(const JoxForces *f, JoxV2 point, float reach) {
    JoxNearest nearest = {.most = JOX_FORCE_MOST_TOUCHES};
    JoxObjectWalk walk = jox_objects_near(f->step.objects, point, reach);
    uint32_t row;
    while (jox_objects_next(&walk, &row)) {
        const JoxObject *body = &f->step.objects->rows[row];
        if (body->swept || !jox_object_reaches(body, point, reach))
            continue;
        float gap = jox_footprint_nearest(body, point).gap;
        if (gap < reach)
            jox_nearest_offer(&nearest, gap, row);
    }
    jox_nearest_by_row(&nearest);
    return nearest;
}

void jox_touches_find(JoxForces *f, uint32_t begin, uint32_t end) {
    JoxAgents *a = f->step.agents;
    const float *radius = a->param[JOX_PARAM_radius];
    uint32_t chunk = begin / JOX_FORCE_GRAIN;
    JoxTouch *list = (JoxTouch *)f->touches.items + (size_t)chunk * f->touches.room;
    for (uint32_t i = begin; i < end; i++) {
        JoxV2 centre = {a->x[i], a->y[i]};
        JoxNearest nearest = nearest_bodies(f, centre, radius[i]);
        for (uint32_t n = 0; n < nearest.count; n++) {
            const JoxObject *body = &f->step.objects->rows[nearest.rows[n]];
            JoxFootprintPoint at = jox_footprint_nearest(body, centre);
            JOX_ASSERT(jox_is_unit(at.normal));
            JoxV3 point = {at.point.x, at.point.y, jox_touch_height(body)};
            list[f->touches.counts[chunk]++] = (JoxTouch){
                .agent = i, .object = nearest.rows[n], .normal = at.normal, .point = point};
        }
        JOX_ASSERT(f->touches.counts[chunk] <= f->touches.room);
        a->contacts[i] = (uint8_t)(a->contacts[i] + nearest.count);
        f->touch_number[i] = (uint8_t)nearest.count;
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
    if (!count)
        return;
    JOX_RESERVE(f->motions, f->motion_capacity, f->step.objects->count);
    for (uint32_t t = count; t-- > 0;) {
        f->first_touch[f->touch[t].agent] = t;
        f->motions[f->touch[t].object].touches = 0;
    }
    for (uint32_t t = 0; t < count; t++)
        f->motions[f->touch[t].object].touches++;
}

static JoxV3 arm_of(const JoxObject *body, JoxV3 point) {
    return (JoxV3){point.x - body->position.x, point.y - body->position.y,
                   point.z - body->position.z};
}

/* Normal velocity of the agent relative to the body at the point of contact. */
static float approach(const JoxForces *f, const JoxTouch *t) {
    const JoxBodyMotion *motion = &f->motions[t->object];
    JoxV3 turning = jox_cross3(motion->spin, arm_of(&f->step.objects->rows[t->object], t->point));
    float x = f->work_x[t->agent] - (motion->velocity.x + turning.x);
    float y = f->work_y[t->agent] - (motion->velocity.y + turning.y);
    return x * t->normal.x + y * t->normal.y;
}

static void reset_motions(JoxForces *f) {
    for (uint32_t t = 0; t < f->touch_count; t++) {
        const JoxObject *body = &f->step.objects->rows[f->touch[t].object];
        f->motions[f->touch[t].object].velocity = body->velocity;
        f->motions[f->touch[t].object].spin = body->spin;
    }
}

void jox_touches_prepare(JoxForces *f) {
    const JoxAgents *a = f->step.agents;
    reset_motions(f);
    for (uint32_t i = 0; i < f->touch_count; i++) {
        JoxTouch *t = &f->touch[i];
        const JoxObject *body = &f->step.objects->rows[t->object];
        float people = 1.0f / a->param[JOX_PARAM_mass][t->agent];
        float restitution = jox_minf(a->param[JOX_PARAM_restitution][t->agent], body->restitution);
        float own = jox_body_inverse_mass(body, t->point, t->normal);
        float speed = approach(f, t);
        t->impulse = 0.0f;
        /* Each share of a mass that is split over its contacts. */
        t->give =
            people * (float)a->contacts[t->agent] + own * (float)f->motions[t->object].touches;
        t->bounce = speed < 0.0f ? -restitution * speed : 0.0f;
        JOX_ASSERT(t->give > 0.0f);
    }
}

/* One pass over the touches, then the bodies' motion with all impulses so far; in ascending agent
   id, on one thread: touches are few. */
void jox_touches_pass(JoxForces *f) {
    for (uint32_t i = 0; i < f->touch_count; i++) {
        JoxTouch *t = &f->touch[i];
        t->impulse = jox_maxf(0.0f, t->impulse + (t->bounce - approach(f, t)) / t->give);
    }
    reset_motions(f);
    for (uint32_t i = 0; i < f->touch_count; i++) {
        const JoxTouch *t = &f->touch[i];
        const JoxObject *body = &f->step.objects->rows[t->object];
        JoxBodyMotion *motion = &f->motions[t->object];
        JoxV3 impulse = {-t->normal.x * t->impulse, -t->normal.y * t->impulse, 0.0f};
        JoxV3 turn = jox_turn3(body->inverse_inertia, jox_cross3(arm_of(body, t->point), impulse));
        motion->velocity.x += impulse.x * body->inverse_mass;
        motion->velocity.y += impulse.y * body->inverse_mass;
        motion->spin.x += turn.x;
        motion->spin.y += turn.y;
        motion->spin.z += turn.z;
    }
}

/* Forces on the agents, impulses for the bodies: the same numbers with opposite signs. */
void jox_touches_finish(JoxForces *f) {
    JoxAgents *a = f->step.agents;
    JoxForceTotals *totals = &f->totals;
    float per_second = 1.0f / (float)f->step.dt;
    for (uint32_t k = 0; k < f->touch_count; k++) {
        const JoxTouch *t = &f->touch[k];
        if (!(t->impulse > 0.0f))
            continue;
        JOX_ASSERT(jox_is_unit(t->normal) && t->agent < a->count);
        JoxV2 impulse = jox_scale(t->normal, t->impulse);
        uint32_t i = t->agent;
        a->contact_x[i] += impulse.x * per_second;
        a->contact_y[i] += impulse.y * per_second;
        a->compression[i] +=
            t->impulse * per_second / jox_circumference(a->param[JOX_PARAM_radius][i]);
        if (!(f->step.objects->rows[t->object].inverse_mass > 0.0f))
            continue;
        totals->touched_x += (double)(impulse.x * per_second) * f->step.dt;
        totals->touched_y += (double)(impulse.y * per_second) * f->step.dt;
        totals->touched += t->impulse;
        jox_force_add_impulse(f, a->id[i], t->object, (JoxV3){-impulse.x, -impulse.y, 0.0f},
                              t->point);
    }
}
