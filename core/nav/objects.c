/* Half-planes of rigid bodies: equation 4. */
#include <math.h>

#include "geom/polygon.h"
#include "nav/internal.h"

/* Nearest point of an object's footprint, and whether `at` is inside it. */
static JoxV2 footprint_nearest(const JoxObject *o, JoxV2 at, bool *inside) {
    *inside = o->footprint_count > 0 && jox_polygon_contains(o->footprint, o->footprint_count, at);
    JoxV2 best = {o->position.x, o->position.y};
    float least = INFINITY;
    for (uint32_t i = 0; i < o->footprint_count; i++) {
        JoxV2 q =
            jox_segment_nearest(o->footprint[i], o->footprint[(i + 1) % o->footprint_count], at);
        float d = jox_length2(jox_sub(at, q));
        if (d < least) {
            least = d;
            best = q;
        }
    }
    return best;
}

/* An object: its bounding disc from outside; within that disc, the nearest side of its true
   footprint, so that one can walk along a long wall. Objects never reciprocate: share 1. */
static bool half_plane_of(const JoxAgents *a, uint32_t i, const JoxObject *o, float planning_time,
                          bool approached, JoxHalfPlane *out) {
    JoxV2 at = {a->x[i], a->y[i]}, own = {a->vx[i], a->vy[i]};
    JoxV2 p = {o->position.x - at.x, o->position.y - at.y};
    JoxV2 moving = {o->velocity.x, o->velocity.y}, v = jox_sub(own, moving);
    float radius = a->param[JOX_PARAM_radius][i], reach = a->param[JOX_PARAM_perception][i];
    float d2 = jox_length2(p), sum = radius + o->disc;
    if (d2 > (reach + o->disc) * (reach + o->disc))
        return false;
    float tau = approached ? planning_time : a->param[JOX_PARAM_horizon][i];
    if (d2 > sum * sum || o->footprint_count == 0) {
        float disc = o->footprint_count == 0 ? o->round : o->disc;
        *out = jox_orca_half_plane(p, v, radius + disc, tau, planning_time, own, 1.0f,
                                   (JoxV2){1.0f, 0.0f});
        return true;
    }
    bool inside;
    JoxV2 side = footprint_nearest(o, at, &inside), out_way = jox_sub(at, side);
    float distance = jox_length(out_way);
    JoxV2 normal = distance > 1e-6f ? jox_scale(out_way, (inside ? -1.0f : 1.0f) / distance)
                                    : jox_unit(jox_scale(p, -1.0f));
    float gap = (inside ? -distance : distance) - radius;
    float time = gap < 0.0f ? planning_time : tau;
    *out = (JoxHalfPlane){normal, jox_dot(moving, normal) - gap / time};
    return jox_length2(normal) > 0.0f;
}

uint32_t jox_orca_objects(const JoxAgents *a, uint32_t i, const JoxObjects *objects,
                          float planning_time, JoxHalfPlane *out, uint32_t most) {
    uint32_t made = 0;
    for (uint32_t o = 0; o < objects->count && made < most; o++) {
        const JoxObject *object = &objects->rows[o];
        if (object->live && object->in_band && !(object->tags & a->ignore[i]))
            made += half_plane_of(a, i, object, planning_time, a->approach[i] == (int32_t)o,
                                  &out[made]);
    }
    return made;
}
