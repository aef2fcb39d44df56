/* The parts of bodies as their bounding spheres, which people avoid in literal mode. */
#include "body/bullet.h"

void jox_part_set_sphere(JoxConvexPart *part, const btVector3 &middle) {
    const btVector3 centre = part->frame * middle;
    part->middle = jox_v3(centre);
    part->sphere = part->kind == JOX_SHAPE_SPHERE ? part->radius : 0.0f;
    for (uint32_t i = 0; i < part->corner_count; i++)
        part->sphere = jox_maxf(part->sphere, (jox_bt(part->corners[i]) - centre).length());
}

/* Returns whether a part is within the height band of people, in a body with this pose. */
static bool is_part_in_band(const JoxConvexPart *part, const btTransform &at) {
    const float middle = (at * jox_bt(part->middle)).z();
    float low = middle - part->sphere, high = middle + part->sphere;
    if (part->kind != JOX_SHAPE_SPHERE) {
        low = INFINITY;
        high = -INFINITY;
        for (uint32_t i = 0; i < part->corner_count; i++) {
            const float z = (at * jox_bt(part->corners[i])).z();
            low = jox_minf(low, z);
            high = jox_maxf(high, z);
        }
    }
    return low < JOX_BAND_HIGH && high > JOX_BAND_LOW;
}

bool jox_bodies_next_part(const void *bodies, JoxPartWalk *walk, JoxObjectPart *out) {
    const JoxBodies *b = static_cast<const JoxBodies *>(bodies);
    const JoxRow *r = &b->rows[walk->row];
    const btTransform &at = r->body->getWorldTransform();
    const float share = 1.0f - r->held_up;
    while (walk->next < r->shape.part_count) {
        const JoxConvexPart *part = &r->shape.parts[walk->next++];
        const btVector3 arm = at.getBasis() * jox_bt(part->middle);
        const btVector3 centre = at.getOrigin() + arm;
        const JoxV2 offset = jox_v2(centre.x() - walk->point.x, centre.y() - walk->point.y);
        if (jox_length(offset) > walk->reach + part->sphere || !is_part_in_band(part, at))
            continue;
        const btVector3 velocity =
            share * (r->body->getLinearVelocity() + r->body->getAngularVelocity().cross(arm));
        out->at = jox_v2(centre.x(), centre.y());
        out->velocity = jox_v2(velocity.x(), velocity.y());
        out->radius = part->sphere;
        return true;
    }
    return false;
}
