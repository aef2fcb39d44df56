/* Where agents meet bodies, and equation 7: their contacts with them. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/sort.h"
#include "force/equations.h"
#include "force/internal.h"

static const float CHEST = 1.1f; /* m; people push and are hit there */
enum { MOST_CELLS = 1 << 16 };

/* Bounds of what a body covers in the plane; false where agents cannot touch it. */
static bool body_bounds(const JoxObject *body, float margin, JoxV2 *low, JoxV2 *high) {
    if (!body->live || !body->in_band || body->swept)
        return false;
    JoxV2 centre = {body->position.x, body->position.y};
    *low = jox_v2(centre.x - body->round, centre.y - body->round);
    *high = jox_v2(centre.x + body->round, centre.y + body->round);
    for (uint32_t i = 0; i < body->footprint_count; i++) {
        JoxV2 p = body->footprint[i];
        *low = i ? jox_v2(jox_minf(low->x, p.x), jox_minf(low->y, p.y)) : p;
        *high = i ? jox_v2(jox_maxf(high->x, p.x), jox_maxf(high->y, p.y)) : p;
    }
    *low = jox_v2(low->x - margin, low->y - margin);
    *high = jox_v2(high->x + margin, high->y + margin);
    /* False for bodies thrown to where numbers end, too. */
    return low->x > -1e7f && low->y > -1e7f && high->x < 1e7f && high->y < 1e7f;
}

/* Lays the grid over all bodies with cells of at least a metre, and not too many of them. */
static bool lay_grid(JoxBodyGrid *g, const JoxObjects *objects, float margin) {
    JoxV2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY}, a, b;
    for (uint32_t i = 0; i < objects->count; i++) {
        if (!body_bounds(&objects->rows[i], margin, &a, &b))
            continue;
        low = jox_v2(jox_minf(low.x, a.x), jox_minf(low.y, a.y));
        high = jox_v2(jox_maxf(high.x, b.x), jox_maxf(high.y, b.y));
    }
    if (!(low.x <= high.x))
        return false;
    float cell = 1.0f, width = high.x - low.x, height = high.y - low.y;
    while ((floorf(width / cell) + 1.0f) * (floorf(height / cell) + 1.0f) > (float)MOST_CELLS)
        cell *= 2.0f;
    g->low = low;
    g->cell = cell;
    g->columns = (uint32_t)(width / cell) + 1;
    g->rows = (uint32_t)(height / cell) + 1;
    JOX_ASSERT((size_t)g->columns * g->rows <= MOST_CELLS);
    return true;
}

/* Counts (members NULL) or enters the body into the cells it covers. */
static void enter_cells(JoxBodyGrid *g, uint32_t row, JoxV2 low, JoxV2 high, bool enter) {
    uint32_t x0 = (uint32_t)((low.x - g->low.x) / g->cell);
    uint32_t y0 = (uint32_t)((low.y - g->low.y) / g->cell);
    uint32_t x1 = (uint32_t)((high.x - g->low.x) / g->cell);
    uint32_t y1 = (uint32_t)((high.y - g->low.y) / g->cell);
    x1 = x1 < g->columns ? x1 : g->columns - 1;
    y1 = y1 < g->rows ? y1 : g->rows - 1;
    JOX_ASSERT(x0 <= x1 && y0 <= y1);
    for (uint32_t y = y0; y <= y1; y++)
        for (uint32_t x = x0; x <= x1; x++) {
            uint32_t *at = &g->starts[y * g->columns + x];
            if (enter)
                g->members[--*at] = row;
            else
                ++*at;
        }
}

void jox_body_grid_fill(JoxBodyGrid *g, const JoxObjects *objects, float margin) {
    g->columns = g->rows = 0;
    JoxV2 low, high;
    if (!lay_grid(g, objects, margin))
        return;
    uint32_t cells = g->columns * g->rows;
    JOX_RESERVE(g->starts, g->start_capacity, (size_t)cells + 1);
    memset(g->starts, 0, ((size_t)cells + 1) * sizeof *g->starts);
    for (uint32_t i = 0; i < objects->count; i++)
        if (body_bounds(&objects->rows[i], margin, &low, &high))
            enter_cells(g, i, low, high, false);
    uint32_t sum = 0;
    for (uint32_t c = 0; c <= cells; c++) {
        sum += g->starts[c];
        g->starts[c] = sum;
    }
    JOX_RESERVE(g->members, g->member_capacity, sum);
    /* Backwards, so that rows ascend within a cell. */
    for (uint32_t i = objects->count; i-- > 0;)
        if (body_bounds(&objects->rows[i], margin, &low, &high))
            enter_cells(g, i, low, high, true);
    JOX_CHECK(jox_body_grid_check(g, objects));
}

float jox_touch_height(const JoxObject *body) {
    return jox_minf(jox_maxf(CHEST, body->low), body->high);
}

/* Nearest point of a disc about the body's centre; from the centre itself, +x leads out. */
static JoxFootprintPoint disc_nearest(const JoxObject *body, JoxV2 point) {
    JoxV2 centre = {body->position.x, body->position.y};
    JoxV2 offset = jox_sub(point, centre);
    float distance = jox_length(offset);
    JoxV2 normal = distance > 0.0f ? jox_scale(offset, 1.0f / distance) : jox_v2(1.0f, 0.0f);
    return (JoxFootprintPoint){normal, jox_add(centre, jox_scale(normal, body->round)),
                               distance - body->round};
}

JoxFootprintPoint jox_footprint_nearest(const JoxObject *body, JoxV2 point) {
    uint32_t count = body->footprint_count;
    if (count < 2)
        return disc_nearest(body, point);
    float nearest2 = INFINITY, deepest = -INFINITY;
    JoxFootprintPoint inside = {{1.0f, 0.0f}, point, 0.0f};
    JoxV2 on_border = point;
    for (uint32_t i = 0; i < count; i++) {
        JoxV2 a = body->footprint[i], edge = jox_sub(body->footprint[(i + 1) % count], a);
        JoxV2 to = jox_sub(point, a);
        float length2 = jox_length2(edge);
        if (!(length2 > 0.0f))
            continue;
        float along = jox_clampf(jox_dot(to, edge) / length2, 0.0f, 1.0f);
        JoxV2 at = jox_add(a, jox_scale(edge, along));
        float away2 = jox_length2(jox_sub(point, at));
        if (away2 < nearest2) {
            nearest2 = away2;
            on_border = at;
        }
        JoxV2 outward = jox_scale(jox_v2(edge.y, -edge.x), 1.0f / sqrtf(length2));
        float height = jox_dot(to, outward);
        if (height > deepest) {
            deepest = height;
            inside =
                (JoxFootprintPoint){outward, jox_sub(point, jox_scale(outward, height)), height};
        }
    }
    JoxV2 away = jox_sub(point, on_border);
    float gap = jox_length(away);
    if (!(deepest > 0.0f) || !(gap > 0.0f)) /* within the ring, or on it */
        return inside;
    return (JoxFootprintPoint){jox_scale(away, 1.0f / gap), on_border, gap};
}

void jox_touches_find(JoxForces *f, uint32_t begin, uint32_t end) {
    JoxAgents *a = f->step.agents;
    const float *radius = a->param[JOX_PARAM_radius];
    uint32_t chunk = begin / JOX_FORCE_GRAIN;
    JoxTouch *list = (JoxTouch *)f->touches.items + (size_t)chunk * f->touches.room;
    for (uint32_t i = begin; i < end; i++) {
        const uint32_t *members = NULL;
        uint32_t count = jox_body_grid_near(&f->grid, a->x[i], a->y[i], &members), found = 0;
        for (uint32_t m = 0; m < count && found < JOX_FORCE_MOST_TOUCHES; m++) {
            const JoxObject *body = &f->step.objects->rows[members[m]];
            JoxFootprintPoint at = jox_footprint_nearest(body, jox_v2(a->x[i], a->y[i]));
            if (!(at.gap < radius[i]))
                continue;
            JOX_ASSERT(jox_is_unit(at.normal));
            JoxV3 point = {at.point.x, at.point.y, jox_touch_height(body)};
            list[f->touches.counts[chunk]++] =
                (JoxTouch){.agent = i, .object = members[m], .normal = at.normal, .point = point};
            found++;
        }
        JOX_ASSERT(found <= JOX_FORCE_MOST_TOUCHES && f->touches.counts[chunk] <= f->touches.room);
        a->contacts[i] = (uint8_t)(a->contacts[i] + found);
        f->touch_number[i] = (uint8_t)found;
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
