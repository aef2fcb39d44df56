/* The equations of forces as functions of plain values, numbered as in the paper. N, m, s, kg. The
   stages of force apply them to columns. */
#ifndef JOX_FORCE_EQUATIONS_H
#define JOX_FORCE_EQUATIONS_H

#include <stdbool.h>

#include "base/number/elementary.h"
#include "base/vec.h"
#include "geom/objects.h"

/* Returns whether `offset` lies within the cone about the unit vector `axis` whose half-angle has
   this cosine. A zero offset counts as inside. */
static inline bool jox_cone_holds(JoxV2 offset, JoxV2 axis, float cosine) {
    float along = jox_dot(offset, axis);
    /* Squares that keep their sign avoid the root and a branch that would be mispredicted. */
    bool within = along * fabsf(along) >= cosine * fabsf(cosine) * jox_length2(offset);
    return within | (cosine <= -1.0f);
}

/* (5) Returns the part of one of `n` targets, at `offset` from the pusher, in a push of
   `newtons`. */
static inline JoxV2 jox_push_share(JoxV2 offset, float newtons, uint32_t n) {
    return jox_scale(jox_unit(offset), newtons / (float)n);
}

/* (6) Returns the impulse, N s, along the normal, which points to the first of two bodies, from the
   normal part of its velocity relative to the second; zero unless they approach. */
static inline float jox_contact_impulse(float normal_velocity, float restitution,
                                        float inverse_mass) {
    if (!(normal_velocity < 0.0f) || !(inverse_mass > 0.0f))
        return 0.0f;
    return -(1.0f + restitution) * normal_velocity / inverse_mass;
}

/* Returns the least normal velocity after a contact, m/s: the gap (m) may close within dt (s), but
   no more; agents that meet within it bounce by the restitution. `speed`: normal velocity before,
   m/s. */
static inline float jox_contact_target(float gap, float speed, float restitution, float dt) {
    const float target = gap > 0.0f ? -gap / dt : 0.0f;
    const bool bounces = restitution > 0.0f && speed < target;
    return bounces ? jox_maxf(target, -restitution * speed) : target;
}

static inline JoxV3 jox_cross3(JoxV3 a, JoxV3 b) {
    return (JoxV3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline float jox_dot3(JoxV3 a, JoxV3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline JoxV3 jox_transform3(const float m[9], JoxV3 v) {
    return (JoxV3){m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
                   m[6] * v.x + m[7] * v.y + m[8] * v.z};
}

/* (7) Returns the inverse of the mass that a body opposes to an impulse along the horizontal unit
   vector `normal` at `point`, 1/kg. The paper prints the body's own mass alone; with its rotation
   an off-centre hit does not add energy. */
static inline float jox_body_inverse_mass(const JoxObject *body, JoxV3 point, JoxV2 normal) {
    if (!(body->inverse_mass > 0.0f))
        return body->inverse_mass;
    JoxV3 arm = {point.x - body->position.x, point.y - body->position.y,
                 point.z - body->position.z};
    JoxV3 turn = jox_cross3(arm, (JoxV3){normal.x, normal.y, 0.0f});
    return body->inverse_mass + jox_dot3(turn, jox_transform3(body->inverse_inertia, turn));
}

/* A cached exp(-damping * time), computed anew when either changes. Initialise with damping -1. */
typedef struct JoxDecay {
    float damping, time, value;
} JoxDecay;

static inline float jox_decay(JoxDecay *decay, float damping, float time) {
    if (damping != decay->damping || time != decay->time)
        *decay = (JoxDecay){damping, time, (float)jox_exp(-(double)damping * (double)time)};
    return decay->value;
}

/* (11) Returns the velocity that the force alone would give; `decay` is exp(-damping dt). */
static inline JoxV2 jox_forced_velocity(JoxV2 velocity, JoxV2 force, float mass, float decay,
                                        float dt) {
    return jox_add(jox_scale(velocity, decay), jox_scale(force, dt / mass));
}

/* (9) Returns the force on each of n agents ahead of one that a force did not move by `shortfall`
   m/s. */
static inline JoxV2 jox_resistance(JoxV2 force_unit, float shortfall, float absorb, float mass,
                                   uint32_t n, float dt) {
    return jox_scale(force_unit, absorb * mass * shortfall / ((float)n * dt));
}

/* (8) Returns the change of velocity, cut to the length of the old velocity: else a turn would
   count as a harder stop than a full one. */
static inline JoxV2 jox_slowing(JoxV2 before, JoxV2 after) {
    JoxV2 change = jox_sub(after, before);
    float size = jox_length(change), most = jox_length(before);
    return size > most ? jox_scale(change, most / size) : change;
}

/* (8) Returns the force on each of n agents ahead of one that slowed by `change`: forward, along
   its momentum. The printed sign would pull them back. */
static inline JoxV2 jox_deceleration(JoxV2 change, float absorb, float mass, uint32_t n, float dt) {
    return jox_scale(change, -absorb * mass / ((float)n * dt));
}

/* (8) Returns the greatest share, up to 1, of a momentum (N s) that gives a mass (kg) of `speed`
   (m/s) along it at most `energy` (J). */
static inline float jox_share_within_energy(float momentum, float mass, float speed, float energy) {
    float most = mass * (sqrtf(speed * speed + 2.0f * energy / mass) - speed);
    return momentum > most ? most / momentum : 1.0f;
}

/* (8) Returns the force on the slowing agent itself, with no agent ahead: cut so that it does not
   reverse the motion. */
static inline JoxV2 jox_keep_from_reversing(JoxV2 force, JoxV2 velocity, float mass, float dt) {
    float against = -jox_dot(force, velocity), speed2 = jox_length2(velocity);
    if (!(against * dt > speed2 * mass) || !(speed2 > 0.0f))
        return force;
    /* Cuts only the part along the motion, to what stops it. */
    float surplus = (against - speed2 * mass / dt) / speed2;
    return jox_add(force, jox_scale(velocity, surplus));
}

/* Returns the share of a new passed-on force that arrives within a step; 1 without a filter. The
   mean delay is `filter` seconds for any step up to that length. */
static inline float jox_filter_share(double dt, double filter) {
    return filter > dt ? (float)(dt / filter) : 1.0f;
}

#endif
