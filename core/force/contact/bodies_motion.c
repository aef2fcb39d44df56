/* Speeds of bodies where agents touch them, and impulses there; bodies_solve.c and bodies_driven.c
   call it. */
#include "force/contact/contacts.h"
#include "force/support/supports.h"

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

void jox_touch_apply_impulse(JoxForces *f, const JoxTouch *t, float impulse) {
    JoxContactSolve *solve = &f->contacts->solve;
    jox_add_impulse(&solve->motions[t->agent], t->normal, t->lever, impulse);
    jox_body_apply_impulse(f, t->object, t->point,
                           (JoxV3){-t->normal.x * impulse, -t->normal.y * impulse, 0.0f});
}
