/* Half-planes of optimal reciprocal collision avoidance between discs. */
#include "base/assert.h"
#include "nav/internal.h"

/* The half-plane of outward normal n whose border passes through own + share * u, where the least
   change u of the relative velocity, which is along n, is `change` long. */
static JoxHalfPlane half_plane_through(JoxV2 normal, JoxV2 own, float change, float share) {
    JOX_ASSERT(jox_is_unit(normal));
    return (JoxHalfPlane){normal, jox_dot(normal, own) + change * share};
}

/* Outward from a disc of the velocity obstacle: its centre is at `centre` in velocity space. */
static JoxHalfPlane from_disc(JoxV2 v, JoxV2 centre, float radius, JoxV2 own, float share,
                              JoxV2 away) {
    JoxV2 w = jox_sub(v, centre);
    float length = jox_length(w);
    JoxV2 normal = length > 1e-6f ? jox_scale(w, 1.0f / length) : away;
    return half_plane_through(normal, own, radius - length, share);
}

JoxHalfPlane jox_orca_half_plane(JoxV2 p, JoxV2 v, float radius, float tau, float dt, JoxV2 own,
                                 float share, JoxV2 away) {
    JOX_ASSERT(tau > 0.0f && dt > 0.0f && radius >= 0.0f);
    float d2 = jox_length2(p), r2 = radius * radius;
    if (d2 <= r2) /* overlapping: apart within one step */
        return from_disc(v, jox_scale(p, 1.0f / dt), radius / dt, own, share, away);
    float inverse = 1.0f / tau;
    JoxV2 w = jox_sub(v, jox_scale(p, inverse));
    float along = jox_dot(w, p);
    if (along < 0.0f && along * along > r2 * jox_length2(w)) /* the cut-off disc is nearest */
        return from_disc(v, jox_scale(p, inverse), radius * inverse, own, share, away);
    /* Else one of the cone's legs; the left one if w points to the left of p. */
    float leg = sqrtf(d2 - r2), by = 1.0f / d2;
    bool left = jox_det(p, w) > 0.0f;
    JoxV2 direction = left ? (JoxV2){p.x * leg - p.y * radius, p.x * radius + p.y * leg}
                           : (JoxV2){-p.x * leg - p.y * radius, p.x * radius - p.y * leg};
    JoxV2 normal = jox_left(jox_scale(direction, by));
    return half_plane_through(normal, own, -jox_dot(normal, v), share);
}
