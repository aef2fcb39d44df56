/* What holds bodies while people press on them: weight, the floor and its friction, walls, and
   other bodies that stand in the way. These contacts, as Bullet found them, are solved together
   with those of people, so that a box at a wall bears what it is pressed with from the first step
   on, and yields in the step in which the wall is gone. What comes of it here is only what people
   feel: the bodies themselves move as Bullet says, from the same impulses. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "force/equations.h"
#include "force/internal.h"

enum {
    LINKS = 4, /* bodies behind each other, from the one that is touched; the next is as a wall */
    SWEEPS = 2 /* over these contacts in a pass over all */
};

static JoxV3 plus(JoxV3 a, JoxV3 b, float times) {
    return (JoxV3){a.x + b.x * times, a.y + b.y * times, a.z + b.z * times};
}

static JoxV3 arm_of(const JoxObject *body, JoxV3 point) {
    return plus(point, body->position, -1.0f);
}

JoxV3 jox_body_velocity(const JoxForces *f, uint32_t row, JoxV3 point) {
    if (row == JOX_NO_OBJECT)
        return (JoxV3){0.0f, 0.0f, 0.0f};
    const JoxBodyMotion *m = &f->motions[row];
    return plus(m->velocity, jox_cross3(m->spin, arm_of(&f->step.objects->rows[row], point)), 1.0f);
}

void jox_body_give(JoxForces *f, uint32_t row, JoxV3 point, JoxV3 impulse) {
    if (row == JOX_NO_OBJECT || !f->motions[row].solved)
        return;
    const JoxObject *body = &f->step.objects->rows[row];
    JoxBodyMotion *m = &f->motions[row];
    JoxV3 turn = jox_cross3(arm_of(body, point), impulse);
    m->velocity = plus(m->velocity, impulse, body->inverse_mass);
    m->spin = plus(m->spin, jox_turn3(body->inverse_inertia, turn), 1.0f);
}

/* Velocity along a unit vector that a body gains from 1 N s there. */
static float gain(const JoxForces *f, uint32_t row, JoxV3 point, JoxV3 along) {
    if (row == JOX_NO_OBJECT || !f->motions[row].solved)
        return 0.0f;
    const JoxObject *body = &f->step.objects->rows[row];
    JoxV3 turn = jox_cross3(arm_of(body, point), along);
    return body->inverse_mass + jox_dot3(turn, jox_turn3(body->inverse_inertia, turn));
}

/* All bodies as they are; those that are touched, and what they stand at, are solved for. */
static void reset_motions(JoxForces *f) {
    const JoxObjects *objects = f->step.objects;
    JOX_RESERVE(f->motions, f->motion_capacity, objects->count);
    for (uint32_t row = 0; row < objects->count; row++)
        f->motions[row] = (JoxBodyMotion){.velocity = objects->rows[row].velocity,
                                          .spin = objects->rows[row].spin};
    for (uint32_t k = 0; k < f->touch_count; k++)
        f->motions[f->touch[k].object].solved = f->motions[f->touch[k].object].touched = true;
}

/* Whether a body is solved for by now, before this link. */
static bool is_reached(const JoxForces *f, uint32_t row, uint32_t link) {
    return row != JOX_NO_OBJECT && f->motions[row].solved && f->motions[row].link <= link;
}

static void reach_next(JoxForces *f, uint32_t row, uint32_t link) {
    if (row == JOX_NO_OBJECT || f->motions[row].solved)
        return;
    f->motions[row].solved = true;
    f->motions[row].link = (uint8_t)(link + 1);
}

static void reach_bodies(JoxForces *f) {
    const JoxObjects *objects = f->step.objects;
    for (uint32_t link = 0; link < LINKS; link++)
        for (uint32_t k = 0; k < objects->contact_count; k++) {
            const JoxObjectContact *c = &objects->contacts[k];
            if (is_reached(f, c->first, link))
                reach_next(f, c->second, link);
            if (is_reached(f, c->second, link))
                reach_next(f, c->first, link);
        }
}

/* Two unit vectors that are square to a unit vector and to each other. */
static void square_to(JoxV3 n, JoxV3 across[2]) {
    JoxV3 axis = fabsf(n.z) < 0.7f ? (JoxV3){0.0f, 0.0f, 1.0f} : (JoxV3){1.0f, 0.0f, 0.0f};
    JoxV3 side = jox_cross3(n, axis);
    across[0] = plus((JoxV3){0.0f, 0.0f, 0.0f}, side, 1.0f / sqrtf(jox_dot3(side, side)));
    across[1] = jox_cross3(n, across[0]);
}

static float mass_along(const JoxForces *f, const JoxObjectContact *c, JoxV3 along) {
    return 1.0f / (gain(f, c->first, c->point, along) + gain(f, c->second, c->point, along));
}

static void give_both(JoxForces *f, const JoxSupport *s, JoxV3 along, float impulse) {
    const JoxV3 zero = {0.0f, 0.0f, 0.0f};
    jox_body_give(f, s->first, s->point, plus(zero, along, impulse));
    jox_body_give(f, s->second, s->point, plus(zero, along, -impulse));
}

static void add_support(JoxForces *f, const JoxObjectContact *c) {
    float dt = (float)f->step.dt;
    JoxSupport *s = &f->support[f->support_count++];
    *s = (JoxSupport){.first = c->first,
                      .second = c->second,
                      .point = c->point,
                      .normal = c->normal,
                      .friction = c->friction,
                      .target = jox_contact_target(c->gap - JOX_BODY_SLACK, 0.0f, 0.0f, dt),
                      .impulse = jox_maxf(0.0f, c->force * dt),
                      .mass = mass_along(f, c, c->normal)};
    square_to(s->normal, s->across);
    for (int k = 0; k < 2; k++)
        s->across_mass[k] = mass_along(f, c, s->across[k]);
    JOX_ASSERT(isfinite(s->mass) && s->mass > 0.0f && isfinite(s->target));
}

void jox_supports_begin(JoxForces *f) {
    const JoxObjects *objects = f->step.objects;
    reset_motions(f);
    reach_bodies(f);
    for (uint32_t row = 0; row < objects->count; row++)
        if (f->motions[row].solved && objects->rows[row].inverse_mass > 0.0f)
            f->motions[row].velocity.z -= objects->gravity * (float)f->step.dt;
    f->support_count = 0;
    JOX_RESERVE(f->support, f->support_capacity, objects->contact_count);
    for (uint32_t k = 0; k < objects->contact_count; k++) {
        const JoxObjectContact *c = &objects->contacts[k];
        bool first = f->motions[c->first].solved;
        if (first || (c->second != JOX_NO_OBJECT && f->motions[c->second].solved))
            add_support(f, c);
    }
    for (uint32_t k = 0; k < f->support_count; k++)
        give_both(f, &f->support[k], f->support[k].normal, f->support[k].impulse);
    uint32_t pushes; /* sorted by who pushes: the order in memory changes no bit */
    const JoxImpulse *push = jox_force_impulses(f, &pushes);
    for (uint32_t k = 0; k < pushes; k++)
        jox_body_give(f, push[k].object, push[k].point, push[k].impulse);
}

static JoxV3 slip(const JoxForces *f, const JoxSupport *s) {
    return plus(jox_body_velocity(f, s->first, s->point), jox_body_velocity(f, s->second, s->point),
                -1.0f);
}

/* Friction, at most `friction` times what presses there. */
static void rub(JoxForces *f, JoxSupport *s) {
    float wanted[2], most = s->friction * s->impulse;
    JoxV3 speed = slip(f, s);
    for (int k = 0; k < 2; k++)
        wanted[k] = s->across_impulse[k] - jox_dot3(speed, s->across[k]) * s->across_mass[k];
    float size = jox_length((JoxV2){wanted[0], wanted[1]});
    float share = size > most ? most / size : 1.0f;
    for (int k = 0; k < 2; k++) {
        float before = s->across_impulse[k];
        s->across_impulse[k] = wanted[k] * share;
        give_both(f, s, s->across[k], s->across_impulse[k] - before);
    }
}

float jox_supports_pass(JoxForces *f) {
    float most = 0.0f;
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        most = 0.0f;
        for (uint32_t k = 0; k < f->support_count; k++) {
            JoxSupport *s = &f->support[k];
            float before = s->impulse, speed = jox_dot3(slip(f, s), s->normal);
            s->impulse = jox_maxf(0.0f, before + (s->target - speed) * s->mass);
            most = jox_maxf(most, fabsf(s->impulse - before));
            give_both(f, s, s->normal, s->impulse - before);
            rub(f, s);
        }
    }
    return most;
}

/* How much of what people give a body its supports take: all where it is held, nothing where it is
   free. By work: of impulses, the velocity gained along them, against that of a free body. */
static float held_share(const JoxForces *f, uint32_t row) {
    const JoxObject *body = &f->step.objects->rows[row];
    const JoxBodyMotion *m = &f->motions[row];
    JoxV3 turned = jox_turn3(body->inverse_inertia, m->given_turn);
    float free =
        jox_dot3(m->given, m->given) * body->inverse_mass + jox_dot3(m->given_turn, turned);
    float done = jox_dot3(m->given, plus(m->velocity, body->velocity, -1.0f)) +
                 jox_dot3(m->given_turn, plus(m->spin, body->spin, -1.0f));
    return free > 0.0f ? 1.0f - jox_clampf(done / free, 0.0f, 1.0f) : 0.0f;
}

void jox_supports_finish(JoxForces *f) {
    for (uint32_t k = 0; k < f->touch_count; k++) {
        const JoxTouch *t = &f->touch[k];
        const JoxV3 impulse = {-t->normal.x * t->impulse, -t->normal.y * t->impulse, 0.0f};
        JoxBodyMotion *m = &f->motions[t->object];
        JoxV3 arm = arm_of(&f->step.objects->rows[t->object], t->point);
        m->given = plus(m->given, impulse, 1.0f);
        m->given_turn = plus(m->given_turn, jox_cross3(arm, impulse), 1.0f);
    }
    for (uint32_t row = 0; row < f->step.objects->count; row++)
        if (f->motions[row].touched)
            f->motions[row].held = held_share(f, row);
}
