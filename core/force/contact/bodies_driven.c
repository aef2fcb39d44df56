/* Driven bodies. A kinematic body presses the agents in its way with a limited force. Where the sum
   would exceed the limit, all contacts ahead are scaled down together, pass by pass, and the body
   goes only as fast as those agents give way. So a body that they stop presses with its limit, and
   one that nothing resists moves as driven. */
#include <math.h>

#include "base/mem.h"
#include "force/contact/contacts.h"
#include "force/support/supports.h"

static const float LIMIT_REACHED = 0.999f; /* share of the limit that counts as reached */

static float measure_level_speed(JoxV3 velocity) {
    return jox_length(jox_v2(velocity.x, velocity.y));
}

/* Returns the index of a body's drive, made at its first use; -1 for a body that does not move by
   itself. */
static int find_drive(JoxForces *f, uint32_t row) {
    JoxDrives *drives = &f->contacts->drives;
    JoxSupports *supports = f->supports;
    const JoxObject *body = &f->step.objects->rows[row];
    if (!body->kinematic || !(measure_level_speed(body->drive) > 0.0f ||
                              jox_dot3(body->drive_spin, body->drive_spin) > 0.0f))
        return -1;
    for (uint32_t d = 0; d < drives->count; d++)
        if (drives->items[d].row == row)
            return (int)d;
    if (drives->count == INT16_MAX)
        return -1;
    JOX_RESERVE(drives->items, drives->capacity, drives->count + 1);
    drives->items[drives->count] = (JoxDrive){
        .row = row,
        .speed = measure_level_speed(body->drive),
        .most = body->force_limit > 0.0f ? body->force_limit * (float)f->step.timing.dt : INFINITY};
    supports->motions[row].velocity = (JoxFour){body->drive.x, body->drive.y, body->drive.z, 0.0f};
    supports->motions[row].spin =
        (JoxFour){body->drive_spin.x, body->drive_spin.y, body->drive_spin.z, 0.0f};
    return (int)drives->count++;
}

/* Sums the impulses along the way of each drive. */
static void sum_drives(JoxForces *f) {
    JoxDrives *drives = &f->contacts->drives;
    JoxTouches *touches = &f->contacts->touches;
    for (uint32_t d = 0; d < drives->count; d++)
        drives->items[d].pressed = 0.0f;
    for (uint32_t k = 0; drives->count && k < touches->count; k++)
        if (touches->items[k].ahead > 0.0f)
            drives->items[touches->items[k].drive].pressed +=
                touches->items[k].ahead * touches->items[k].impulse;
}

void jox_drives_find(JoxForces *f) {
    JoxDrives *drives = &f->contacts->drives;
    JoxTouches *touches = &f->contacts->touches;
    drives->count = 0;
    for (uint32_t k = 0; k < touches->count; k++) {
        JoxTouch *t = &touches->items[k];
        t->drive = (int16_t)find_drive(f, t->object);
        t->ahead = t->drive < 0 ? 0.0f : jox_maxf(0.0f, jox_touch_speed_before(f, t));
        if (t->drive >= 0)
            drives->items[t->drive].speed = jox_maxf(drives->items[t->drive].speed, t->ahead);
    }
    for (uint32_t k = 0; k < touches->count; k++)
        if (touches->items[k].ahead > 0.0f)
            touches->items[k].ahead /= drives->items[touches->items[k].drive].speed;
    sum_drives(f);
    for (uint32_t k = 0; k < touches->count; k++) { /* before the kept impulses are applied */
        JoxTouch *t = &touches->items[k];
        const JoxDrive *d = t->ahead > 0.0f ? &drives->items[t->drive] : NULL;
        if (d && d->pressed > d->most)
            t->impulse *= d->most / d->pressed;
    }
}

void jox_drives_limit_impulses(JoxForces *f) {
    JoxDrives *drives = &f->contacts->drives;
    JoxTouches *touches = &f->contacts->touches;
    sum_drives(f);
    for (uint32_t k = 0; drives->count && k < touches->count; k++) {
        JoxTouch *t = &touches->items[k];
        const JoxDrive *d = t->ahead > 0.0f ? &drives->items[t->drive] : NULL;
        if (!d || !(d->pressed > d->most))
            continue;
        const float less = t->impulse * (d->most / d->pressed) - t->impulse;
        t->impulse += less;
        jox_touch_apply_impulse(f, t, less);
    }
}

/* Returns the share of its way that a body at its limit goes: that of the pressed agent that gives
   way least. */
static float find_way_share(const JoxForces *f, uint32_t drive) {
    const JoxTouches *touches = &f->contacts->touches;
    float share = 1.0f;
    for (uint32_t k = 0; k < touches->count; k++) {
        const JoxTouch *t = &touches->items[k];
        if (t->drive != (int)drive || !(t->ahead > 0.0f && t->impulse > 0.0f))
            continue;
        const float gives =
            jox_speed_along(&f->contacts->solve.motions[t->agent], t->normal, t->lever) +
            jox_maxf(0.0f, t->gap) / (float)f->step.timing.dt;
        share = jox_minf(share, gives / (t->ahead * f->contacts->drives.items[drive].speed));
    }
    return jox_clampf(share, 0.0f, 1.0f);
}

void jox_drives_slow_bodies(JoxForces *f) {
    JoxDrives *drives = &f->contacts->drives;
    JoxTouches *touches = &f->contacts->touches;
    JoxSupports *supports = f->supports;
    const JoxAgents *a = f->step.agents;
    sum_drives(f);
    JOX_RESERVE(drives->loads, drives->load_capacity, drives->count);
    for (uint32_t d = 0; d < drives->count; d++) {
        const JoxDrive *drive = &drives->items[d];
        JoxDriveLoad *load = &drives->loads[d];
        *load = (JoxDriveLoad){.row = drive->row,
                               .force = drive->pressed / (float)f->step.timing.dt,
                               .met = drive->pressed >= LIMIT_REACHED * drive->most,
                               .share = 1.0f,
                               .agent = JOX_NO_INDEX};
        uint32_t pressed = JOX_NO_INDEX;
        float force = 0.0f; /* N: on that agent */
        for (uint32_t k = 0; k < touches->count; k++) {
            const JoxTouch *t = &touches->items[k];
            if (t->drive != (int)d || !(t->ahead > 0.0f && t->impulse > 0.0f))
                continue;
            if (t->agent != pressed) { /* touches of one agent are neighbours */
                load->people++;
                pressed = t->agent;
                force = 0.0f;
            }
            force += t->impulse / (float)f->step.timing.dt;
            if (force > load->hardest) {
                load->hardest = force;
                load->agent = a->id[t->agent];
            }
        }
        if (!load->met)
            continue;
        load->share = find_way_share(f, d);
        supports->motions[drive->row].velocity *= load->share;
        supports->motions[drive->row].spin *= load->share;
    }
}

const JoxDriveLoad *jox_force_drive_loads(const JoxForces *f, uint32_t *count) {
    const JoxDrives *drives = &f->contacts->drives;
    *count = drives->count;
    return drives->loads;
}
