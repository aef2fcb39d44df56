/* Equation 7: contacts of agents with bodies ("touches"). The supports of the bodies are solved
   with them (support/supports.c). */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/sort.h"
#include "force/equations.h"
#include "force/forces.h"

/* Finds the contact of agent i with body `row`. Returns false if the gap cannot close within the
   step, or a wall stands between them. */
static bool find_touch(const JoxForces *f, uint32_t i, uint32_t row, JoxTouch *touch) {
    const JoxAgents *a = f->step.agents;
    const JoxObject *body = &f->step.objects->rows[row];
    JoxFootprintPoint at = jox_footprint_nearest(body, jox_v2(a->x[i], a->y[i]));
    JoxV2 towards = jox_sub(jox_v2(a->vx[i], a->vy[i]), jox_object_velocity_at(body, at.point));
    float closing = jox_length(towards) * (float)f->step.dt;
    float gap = at.gap - a->breadth[i];
    if (!(gap < JOX_TOUCH_LEAST + jox_minf(JOX_TOUCH_MOST, closing)))
        return false;
    JoxV2 own = {a->x[i], a->y[i]};
    if (at.gap > 0.0f && f->step.walls &&
        jox_wall_grid_has_wall_between(f->step.walls, own, at.point))
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
            if (!body->swept && jox_object_reaches(body, at, reach) &&
                find_touch(f, i, row, &touch))
                jox_nearest_offer(&nearest, touch.gap, row);
        }
        f->touch_number[i] = (uint8_t)nearest.count;
        for (uint32_t k = 0; k < nearest.count; k++) {
            find_touch(f, i, nearest.rows[k], &touch);
            list[f->touches.counts[chunk]++] = touch;
        }
        JOX_ASSERT(f->touches.counts[chunk] <= f->touches.room);
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
    jox_sort(f->touch, count, sizeof *f->touch, compare_touches, a, f->touch + count);
    f->totals.touches = count;
    for (uint32_t t = count; t-- > 0;)
        f->touch_first[f->touch[t].agent] = t;
}

float jox_touch_speed_before(const JoxForces *f, const JoxTouch *t) {
    const JoxObject *body = &f->step.objects->rows[t->object];
    const JoxV3 velocity = body->kinematic ? body->drive : body->velocity;
    const JoxV3 at = t->point, c = body->position;
    JoxV3 turning = jox_cross3(body->kinematic ? body->drive_spin : body->spin,
                               (JoxV3){at.x - c.x, at.y - c.y, at.z - c.z});
    return (velocity.x + turning.x) * t->normal.x + (velocity.y + turning.y) * t->normal.y;
}

float jox_touch_speed_after(const JoxForces *f, const JoxTouch *t) {
    JoxV3 velocity = jox_body_velocity(f, t->object, t->point);
    return velocity.x * t->normal.x + velocity.y * t->normal.y;
}

/* Applies an impulse, N s, to the agent and the opposite one to the body of a touch. */
static void apply_touch_impulse(JoxForces *f, const JoxTouch *t, float impulse) {
    float inverse_mass = f->inverse_mass[t->agent];
    f->velocities[t->agent].x += t->normal.x * impulse * inverse_mass;
    f->velocities[t->agent].y += t->normal.y * impulse * inverse_mass;
    jox_body_apply_impulse(f, t->object, t->point,
                           (JoxV3){-t->normal.x * impulse, -t->normal.y * impulse, 0.0f});
}

/* ---- driven bodies ----

   A kinematic body presses the agents in its way with a limited force. Where the sum would exceed
   the limit, all contacts ahead are scaled down together, pass by pass, and the body goes only as
   fast as those agents give way. So a body that they stop presses with its limit, and one that
   nothing resists moves as driven. */

static const float MET = 0.999f; /* share of the limit that counts as reached */

static float measure_level_speed(JoxV3 velocity) {
    return jox_length(jox_v2(velocity.x, velocity.y));
}

/* Returns the index of a body's drive, made at its first use; -1 for a body that does not move by
   itself. */
static int find_drive(JoxForces *f, uint32_t row) {
    const JoxObject *body = &f->step.objects->rows[row];
    if (!body->kinematic || !(measure_level_speed(body->drive) > 0.0f ||
                              jox_dot3(body->drive_spin, body->drive_spin) > 0.0f))
        return -1;
    for (uint32_t d = 0; d < f->drive_count; d++)
        if (f->drives[d].row == row)
            return (int)d;
    if (f->drive_count == INT16_MAX)
        return -1;
    JOX_RESERVE(f->drives, f->drive_capacity, f->drive_count + 1);
    f->drives[f->drive_count] = (JoxDrive){
        .row = row,
        .speed = measure_level_speed(body->drive),
        .most = body->force_limit > 0.0f ? body->force_limit * (float)f->step.dt : INFINITY};
    f->motions[row].velocity = (JoxFour){body->drive.x, body->drive.y, body->drive.z, 0.0f};
    f->motions[row].spin =
        (JoxFour){body->drive_spin.x, body->drive_spin.y, body->drive_spin.z, 0.0f};
    return (int)f->drive_count++;
}

/* Sums the impulses along the way of each drive. */
static void sum_drives(JoxForces *f) {
    for (uint32_t d = 0; d < f->drive_count; d++)
        f->drives[d].pressed = 0.0f;
    for (uint32_t k = 0; f->drive_count && k < f->touch_count; k++)
        if (f->touch[k].ahead > 0.0f)
            f->drives[f->touch[k].drive].pressed += f->touch[k].ahead * f->touch[k].impulse;
}

/* Finds the drives of the touched bodies, and scales kept impulses down to the limits. */
static void begin_drives(JoxForces *f) {
    f->drive_count = 0;
    for (uint32_t k = 0; k < f->touch_count; k++) {
        JoxTouch *t = &f->touch[k];
        t->drive = (int16_t)find_drive(f, t->object);
        t->ahead = t->drive < 0 ? 0.0f : jox_maxf(0.0f, jox_touch_speed_before(f, t));
        if (t->drive >= 0)
            f->drives[t->drive].speed = jox_maxf(f->drives[t->drive].speed, t->ahead);
    }
    for (uint32_t k = 0; k < f->touch_count; k++)
        if (f->touch[k].ahead > 0.0f)
            f->touch[k].ahead /= f->drives[f->touch[k].drive].speed;
    sum_drives(f);
    for (uint32_t k = 0; k < f->touch_count; k++) { /* before the kept impulses are applied */
        JoxTouch *t = &f->touch[k];
        const JoxDrive *d = t->ahead > 0.0f ? &f->drives[t->drive] : NULL;
        if (d && d->pressed > d->most)
            t->impulse *= d->most / d->pressed;
    }
}

/* Scales the impulses ahead of drives over their limit down, after each pass. */
static void limit_drives(JoxForces *f) {
    sum_drives(f);
    for (uint32_t k = 0; f->drive_count && k < f->touch_count; k++) {
        JoxTouch *t = &f->touch[k];
        const JoxDrive *d = t->ahead > 0.0f ? &f->drives[t->drive] : NULL;
        if (!d || !(d->pressed > d->most))
            continue;
        const float less = t->impulse * (d->most / d->pressed) - t->impulse;
        t->impulse += less;
        apply_touch_impulse(f, t, less);
    }
}

/* Returns the share of its way that a body at its limit goes: that of the pressed agent that gives
   way least. */
static float find_way_share(const JoxForces *f, uint32_t drive) {
    float share = 1.0f;
    for (uint32_t k = 0; k < f->touch_count; k++) {
        const JoxTouch *t = &f->touch[k];
        if (t->drive != (int)drive || !(t->ahead > 0.0f && t->impulse > 0.0f))
            continue;
        const float gives = jox_dot(f->velocities[t->agent], t->normal) +
                            jox_maxf(0.0f, t->gap) / (float)f->step.dt;
        share = jox_minf(share, gives / (t->ahead * f->drives[drive].speed));
    }
    return jox_clampf(share, 0.0f, 1.0f);
}

/* Writes the loads of all drives, and slows bodies that reached their limit. */
static void finish_drives(JoxForces *f) {
    const JoxAgents *a = f->step.agents;
    sum_drives(f);
    JOX_RESERVE(f->drive_loads, f->drive_load_capacity, f->drive_count);
    for (uint32_t d = 0; d < f->drive_count; d++) {
        const JoxDrive *drive = &f->drives[d];
        JoxDriveLoad *load = &f->drive_loads[d];
        *load = (JoxDriveLoad){.row = drive->row,
                               .force = drive->pressed / (float)f->step.dt,
                               .met = drive->pressed >= MET * drive->most,
                               .share = 1.0f,
                               .agent = JOX_NO_INDEX};
        for (uint32_t k = 0; k < f->touch_count; k++) {
            const JoxTouch *t = &f->touch[k];
            if (t->drive != (int)d || !(t->ahead > 0.0f && t->impulse > 0.0f))
                continue;
            load->people++;
            if (t->impulse / (float)f->step.dt > load->hardest) {
                load->hardest = t->impulse / (float)f->step.dt;
                load->agent = a->id[t->agent];
            }
        }
        if (!load->met)
            continue;
        load->share = find_way_share(f, d);
        f->motions[drive->row].velocity *= load->share;
        f->motions[drive->row].spin *= load->share;
    }
}

const JoxDriveLoad *jox_force_drive_loads(const JoxForces *f, uint32_t *count) {
    *count = f->drive_count;
    return f->drive_loads;
}

/* ---- the solve ---- */

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
        t->impulse = jox_kept_impulse(&f->kept_touches, &kept, a->id[t->agent], t->object);
        JOX_ASSERT(t->mass > 0.0f);
    }
    begin_drives(f);
    for (uint32_t k = 0; k < f->touch_count; k++)
        apply_touch_impulse(f, &f->touch[k], f->touch[k].impulse);
}

/* Runs in ascending agent id, on one thread: touches are few. */
float jox_touches_pass(JoxForces *f) {
    if (!f->touch_count)
        return 0.0f;
    float most = jox_supports_pass(f);
    for (uint32_t k = 0; k < f->touch_count; k++) {
        JoxTouch *t = &f->touch[k];
        float speed = jox_dot(f->velocities[t->agent], t->normal) - jox_touch_speed_after(f, t);
        t->before = t->impulse;
        t->impulse = jox_maxf(0.0f, t->before + (t->target - speed) * t->mass);
        apply_touch_impulse(f, t, t->impulse - t->before);
    }
    limit_drives(f);
    for (uint32_t k = 0; k < f->touch_count; k++)
        most = jox_maxf(most, fabsf(f->touch[k].impulse - f->touch[k].before));
    return most;
}

/* Gives the bodies the opposite of the impulses that agents got. */
void jox_touches_finish(JoxForces *f) {
    const JoxAgents *a = f->step.agents;
    JoxForceTotals *totals = &f->totals;
    uint32_t inside = JOX_NO_INDEX; /* agent counted last: touches are sorted by agent */
    JOX_RESERVE(f->kept_touches.items, f->kept_touches.capacity, f->touch_count);
    f->kept_touches.count = f->touch_count;
    if (f->touch_count && !f->options.literal) {
        jox_supports_finish(f);
        finish_drives(f);
    }
    for (uint32_t k = 0; k < f->touch_count; k++) {
        const JoxTouch *t = &f->touch[k];
        f->kept_touches.items[k] = (JoxKeptImpulse){a->id[t->agent], t->object, t->impulse};
        const JoxObject *body = &f->step.objects->rows[t->object];
        const bool moves = body->inverse_mass > 0.0f;
        if (body->kinematic && t->gap + a->breadth[t->agent] < 0.0f && t->agent != inside) {
            inside = t->agent;
            totals->inside++;
        }
        if (!(t->impulse > 0.0f) || !(moves || body->kinematic)) /* other bodies feel nothing */
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
