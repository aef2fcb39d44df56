/* Supports: what holds bodies while agents press on them, that is weight, the floor and its
   friction, walls, and other bodies in the way. The contacts that Bullet found are solved together
   with those of agents, so that a box at a wall bears the pressure from the first step on, and
   yields in the step in which the wall is gone. The result matters only for the forces that agents
   feel: the bodies themselves move as Bullet says, from the same impulses. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "force/support/supports.h"

enum {
    LINKS = 4 /* bodies in a row, from the touched one on; the next one acts as a wall */
};

static JoxV3 add_scaled(JoxV3 a, JoxV3 b, float times) {
    return (JoxV3){a.x + b.x * times, a.y + b.y * times, a.z + b.z * times};
}

static JoxFour to_four(JoxV3 v) {
    return (JoxFour){v.x, v.y, v.z, 0.0f};
}

static JoxV3 to_three(JoxFour v) {
    return (JoxV3){v[0], v[1], v[2]};
}

/* Returns the vector from a body's centre to a point, m. */
static JoxV3 find_arm(const JoxObject *body, JoxV3 point) {
    return add_scaled(point, body->position, -1.0f);
}

JoxV3 jox_body_velocity(const JoxForces *f, uint32_t row, JoxV3 point) {
    if (row == JOX_NO_OBJECT)
        return (JoxV3){0.0f, 0.0f, 0.0f};
    const JoxBodyMotion *m = &f->supports->motions[row];
    JoxV3 turning = jox_cross3(to_three(m->spin), find_arm(&f->step.objects->rows[row], point));
    return add_scaled(to_three(m->velocity), turning, 1.0f);
}

void jox_body_apply_impulse(JoxForces *f, uint32_t row, JoxV3 point, JoxV3 impulse) {
    JoxSupports *supports = f->supports;
    if (row == JOX_NO_OBJECT || !supports->motions[row].solved)
        return;
    const JoxObject *body = &f->step.objects->rows[row];
    JoxBodyMotion *m = &supports->motions[row];
    JoxV3 turn = jox_cross3(find_arm(body, point), impulse);
    JoxV3 turned = jox_transform3(body->inverse_inertia, turn);
    m->velocity += to_four(impulse) * body->inverse_mass;
    m->spin += to_four(turned);
    m->unrest += sqrtf(jox_dot3(impulse, impulse) * body->inverse_mass + jox_dot3(turn, turned));
}

/* Loads the motions of all bodies, and behind them the static world at rest. Marks the touched
   bodies; those that can be pushed are solved for. */
static void reset_motions(JoxForces *f, const JoxTouch *touches, uint32_t count) {
    JoxSupports *supports = f->supports;
    const JoxObjects *objects = f->step.objects;
    JOX_RESERVE(supports->motions, supports->motion_capacity, objects->count + 1);
    supports->motions[objects->count] = (JoxBodyMotion){0};
    for (uint32_t row = 0; row < objects->count; row++)
        supports->motions[row] = (JoxBodyMotion){.velocity = to_four(objects->rows[row].velocity),
                                                 .spin = to_four(objects->rows[row].spin)};
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t row = touches[k].object;
        supports->motions[row].touched = true;
        supports->motions[row].solved = objects->rows[row].moves;
    }
}

/* Returns whether a body is solved for already, at `link` or nearer to a touched body. */
static bool is_in_reach_of_link(const JoxForces *f, uint32_t row, uint32_t link) {
    const JoxSupports *supports = f->supports;
    return row != JOX_NO_OBJECT && supports->motions[row].solved &&
           supports->motions[row].link <= link;
}

/* Marks a movable body that is not solved for yet as one link farther than `link`. */
static void link_next(JoxForces *f, uint32_t row, uint32_t link) {
    JoxSupports *supports = f->supports;
    if (row == JOX_NO_OBJECT || supports->motions[row].solved || !f->step.objects->rows[row].moves)
        return;
    supports->motions[row].solved = true;
    supports->motions[row].link = (uint8_t)(link + 1);
}

/* Marks the bodies that stand behind touched ones, up to LINKS deep, as solved for. */
static void link_bodies(JoxForces *f, JoxObjectContacts contacts) {
    for (uint32_t link = 0; link < LINKS; link++)
        for (uint32_t k = 0; k < contacts.count; k++) {
            const JoxObjectContact *c = &contacts.items[k];
            if (is_in_reach_of_link(f, c->first, link))
                link_next(f, c->second, link);
            if (is_in_reach_of_link(f, c->second, link))
                link_next(f, c->first, link);
        }
}

/* Makes two unit vectors that are orthogonal to a unit vector and to each other. */
static void make_orthogonal(JoxV3 n, JoxV3 across[2]) {
    JoxV3 axis = fabsf(n.z) < 0.7f ? (JoxV3){0.0f, 0.0f, 1.0f} : (JoxV3){1.0f, 0.0f, 0.0f};
    JoxV3 side = jox_cross3(n, axis);
    across[0] = add_scaled((JoxV3){0.0f, 0.0f, 0.0f}, side, 1.0f / sqrtf(jox_dot3(side, side)));
    across[1] = jox_cross3(n, across[0]);
}

/* Makes an axis of the contact of the bodies of two rows, at a point. */
static JoxSupportAxis make_axis(const JoxForces *f, const uint32_t rows[2], JoxV3 point,
                                JoxV3 along) {
    JoxSupportAxis axis = {.along = to_four(along)};
    float gain = 0.0f; /* m/s per N s */
    for (int side = 0; side < 2; side++) {
        if (rows[side] == f->step.objects->count)
            continue;
        const JoxObject *body = &f->step.objects->rows[rows[side]];
        JoxV3 lever = jox_cross3(find_arm(body, point), along);
        axis.lever[side] = to_four(lever);
        if (!f->supports->motions[rows[side]].solved)
            continue;
        JoxV3 turning = jox_transform3(body->inverse_inertia, lever);
        axis.turning[side] = to_four(turning);
        axis.inverse_mass[side] = body->inverse_mass;
        float sway2 = body->inverse_mass + jox_dot3(lever, turning);
        axis.sway[side] = sqrtf(sway2);
        gain += sway2;
    }
    axis.mass = 1.0f / gain;
    return axis;
}

/* Makes the watch of a contact that is yet to be solved for the first time. */
static JoxSupportWatch make_watch(const JoxSupport *s) {
    const JoxSupportAxis *axes[] = {&s->normal, &s->across[0], &s->across[1]};
    JoxSupportWatch watch = {.rows = {s->rows[0], s->rows[1]}};
    for (int k = 0; k < 3; k++)
        for (int side = 0; side < 2; side++)
            watch.most_per_unrest[side] =
                jox_maxf(watch.most_per_unrest[side], axes[k]->mass * axes[k]->sway[side]);
    return watch;
}

/* Adds a contact that Bullet found, with the force that it had there as the first impulse. */
static void add_support(JoxForces *f, const JoxObjectContact *c) {
    JoxSupports *supports = f->supports;
    const float dt = (float)f->step.timing.dt;
    const uint32_t second = c->second == JOX_NO_OBJECT ? f->step.objects->count : c->second;
    JoxV3 across[2];
    JoxSupport *s = &supports->items[supports->count++];
    *s = (JoxSupport){.rows = {c->first, second},
                      .friction = c->friction,
                      .target = jox_contact_target(c->gap - JOX_BODY_SLACK, 0.0f, 0.0f, dt)};
    s->normal = make_axis(f, s->rows, c->point, c->normal);
    s->normal.impulse = jox_maxf(0.0f, c->force * dt);
    make_orthogonal(c->normal, across);
    for (int k = 0; k < 2; k++)
        s->across[k] = make_axis(f, s->rows, c->point, across[k]);
    supports->watches[supports->count - 1] = make_watch(s);
    JOX_ASSERT(isfinite(s->normal.mass) && s->normal.mass > 0.0f && isfinite(s->target));
}

void jox_supports_start_solve(JoxForces *f, const JoxTouch *touches, uint32_t count) {
    JoxSupports *supports = f->supports;
    const JoxObjects *objects = f->step.objects;
    const JoxObjectContacts contacts = jox_objects_contacts(objects);
    reset_motions(f, touches, count);
    link_bodies(f, contacts);
    for (uint32_t row = 0; row < objects->count; row++)
        if (supports->motions[row].solved && objects->rows[row].inverse_mass > 0.0f)
            supports->motions[row].velocity[2] -= objects->gravity * (float)f->step.timing.dt;
    supports->count = 0;
    JOX_RESERVE(supports->items, supports->capacity, contacts.count);
    JOX_RESERVE(supports->watches, supports->watch_capacity, contacts.count);
    for (uint32_t k = 0; k < contacts.count; k++) {
        const JoxObjectContact *c = &contacts.items[k];
        bool first = supports->motions[c->first].solved;
        if (first || (c->second != JOX_NO_OBJECT && supports->motions[c->second].solved))
            add_support(f, c);
    }
    jox_supports_apply_first_impulses(supports);
    uint32_t pushes; /* sorted by the pusher's id: the order in memory changes no bit */
    const JoxImpulse *push = jox_impulses_sort(&f->impulses, &pushes);
    for (uint32_t k = 0; k < pushes; k++)
        jox_body_apply_impulse(f, push[k].object, push[k].point, push[k].impulse);
}

/* Returns the share of the impulses that agents gave a body which its supports took: 1 if it is
   held, 0 if it is free. It compares work: the velocity gained along the impulses, against that of
   a free body. */
static float find_held_share(const JoxForces *f, uint32_t row) {
    const JoxObject *body = &f->step.objects->rows[row];
    const JoxBodyMotion *m = &f->supports->motions[row];
    JoxV3 turned = jox_transform3(body->inverse_inertia, m->given_turn);
    float free =
        jox_dot3(m->given, m->given) * body->inverse_mass + jox_dot3(m->given_turn, turned);
    float done = jox_dot3(m->given, add_scaled(to_three(m->velocity), body->velocity, -1.0f)) +
                 jox_dot3(m->given_turn, add_scaled(to_three(m->spin), body->spin, -1.0f));
    return free > 0.0f ? 1.0f - jox_clampf(done / free, 0.0f, 1.0f) : 0.0f;
}

void jox_supports_find_held_shares(JoxForces *f, const JoxTouch *touches, uint32_t count) {
    JoxSupports *supports = f->supports;
    for (uint32_t k = 0; k < count; k++) {
        const JoxTouch *t = &touches[k];
        const JoxV3 impulse = {-t->normal.x * t->impulse, -t->normal.y * t->impulse, 0.0f};
        JoxBodyMotion *m = &supports->motions[t->object];
        JoxV3 arm = find_arm(&f->step.objects->rows[t->object], t->point);
        m->given = add_scaled(m->given, impulse, 1.0f);
        m->given_turn = add_scaled(m->given_turn, jox_cross3(arm, impulse), 1.0f);
    }
    for (uint32_t row = 0; row < f->step.objects->count; row++)
        if (supports->motions[row].touched)
            supports->motions[row].held = find_held_share(f, row);
}

void jox_supports_free(JoxSupports *supports) {
    jox_free(supports->motions);
    jox_free(supports->items);
    jox_free(supports->watches);
    jox_free(supports);
}
