/* Kinematic bodies: moves them by their velocities or along their paths, and slows them at their
   force limit. */
#include "body/bullet.h"

#include <algorithm>
#include <cstring>

static void set_linear_velocity(JoxRow *r, const double v[3]) {
    r->body->setLinearVelocity(btVector3(float(v[0]), float(v[1]), float(v[2])));
}

/* Starts the path of a definition. It is given for the shape's own frame, and stored for the
   centre of mass, about which a body turns. */
void jox_row_begin_path(JoxRow *r, const JoxBodyDef *def) {
    const btVector3 &centre = r->body->getWorldTransform().getOrigin();
    jox_row_set_path(r, &def->path);
    for (uint32_t n = 0; n < 3 * def->path.count; n++)
        r->path.points[n] += double(centre[int(n % 3)]) - def->position[n % 3];
    set_linear_velocity(r, jox_path_spot(&r->path, 0).velocity);
}

void jox_row_set_path(JoxRow *r, const JoxBodyPath *path) {
    r->path = *path;
    r->path.points = static_cast<double *>(jox_alloc(3 * size_t(path->count), sizeof(double)));
    memcpy(r->path.points, path->points, 3 * size_t(path->count) * sizeof(double));
    r->path_time = 0;
}

void jox_row_leave_path(JoxRow *r) {
    jox_free(r->path.points);
    r->path = JoxBodyPath();
    r->path_time = 0;
    r->goes_back = false;
}

/* ---- force limit ---- */

/* Returns the velocity with which a body goes on along its path, m/s. */
static btVector3 compute_path_velocity(const JoxRow *r) {
    const JoxPathSpot spot = jox_path_spot(&r->path, r->path_time);
    return (r->goes_back ? -1.0f : 1.0f) *
           btVector3(float(spot.velocity[0]), float(spot.velocity[1]), float(spot.velocity[2]));
}

bool jox_bodies_hold_up(JoxBodies *b, uint32_t row, float share) {
    JoxRow *r = jox_live_row(b, row);
    if (!r || !r->kinematic)
        return false;
    JOX_ASSERT(share >= 0.0f && share <= 1.0f);
    r->reaches_limit = true;
    r->way_share = share;
    return !r->reached_limit;
}

bool jox_bodies_ends_run(const JoxBodies *b, uint32_t row) {
    const JoxRow *r = jox_live_row(b, row);
    return r && r->kinematic && r->ends_run;
}

void jox_bodies_begin_drive(JoxBodies *b) {
    for (uint32_t k = 0; k < b->live; k++) {
        JoxRow *r = &b->rows[b->order[k]];
        if (!r->kinematic)
            continue;
        r->held_up = r->reaches_limit ? 1.0f - r->way_share : 0.0f;
        r->reached_limit = r->reaches_limit;
        r->reaches_limit = false;
        if (r->reached_limit && r->path.reopens && !r->goes_back) {
            r->goes_back = true;
            r->held_up = 1.0f;
        }
        r->drive = jox_v3(r->body->getLinearVelocity());
        r->drive_spin = jox_v3(r->body->getAngularVelocity());
    }
}

/* Advances the time along a path by dt, s, or back. Time held up delays everything later on the
   path. */
static void advance_path_time(JoxRow *r, double dt) {
    if (r->goes_back) {
        const double began = jox_path_leg_began(&r->path, r->path_time);
        r->path_time = std::max(began, r->path_time - dt);
        if (r->path_time == began) { /* waits at the start of the leg as before setting out */
            r->path_time = std::max(0.0, began - r->path.wait);
            r->goes_back = false;
        }
    } else {
        r->path_time += dt;
    }
}

void jox_row_make_kinematic(JoxRow *r) {
    const int flags = r->body->getCollisionFlags() & ~btCollisionObject::CF_STATIC_OBJECT;
    JOX_ASSERT(r->shape.still);
    r->kinematic = true;
    r->body->setCollisionFlags(flags | btCollisionObject::CF_KINEMATIC_OBJECT);
}

/* Keeps a moving body awake, so that it wakes bodies that it touches; a body at rest lets them
 * sleep. */
static void update_activation(JoxRow *r) {
    const bool moves =
        r->body->getLinearVelocity().length2() > 0 || r->body->getAngularVelocity().length2() > 0;
    r->body->forceActivationState(moves ? ACTIVE_TAG : ISLAND_SLEEPING);
    r->body->setDeactivationTime(0);
}

void jox_bodies_drive(JoxBodies *b, float dt) {
    for (uint32_t k = 0; k < b->live; k++) {
        JoxRow *r = &b->rows[b->order[k]];
        if (!r->kinematic)
            continue;
        const float share = 1.0f - r->held_up;
        if (r->path.count) { /* velocity to the exact position on the path, so that rounding does
                                not add up */
            advance_path_time(r, double(dt) * double(share));
            const JoxPathSpot spot = jox_path_spot(&r->path, r->path_time);
            const btVector3 &at = r->body->getWorldTransform().getOrigin();
            double v[3];
            for (int i = 0; i < 3; i++)
                v[i] = (spot.at[i] - double(at[i])) / double(dt);
            set_linear_velocity(r, v);
        } else if (r->held_up > 0.0f) {
            r->body->setLinearVelocity(share * jox_bt(r->drive));
            r->body->setAngularVelocity(share * jox_bt(r->drive_spin));
        }
        update_activation(r);
    }
}

void jox_bodies_end_drive(JoxBodies *b) {
    for (uint32_t k = 0; k < b->live; k++) {
        JoxRow *r = &b->rows[b->order[k]];
        if (!r->kinematic)
            continue;
        if (r->path.count) {
            r->body->setLinearVelocity(compute_path_velocity(r));
        } else if (r->held_up > 0.0f) {
            r->body->setLinearVelocity(jox_bt(r->drive));
            r->body->setAngularVelocity(jox_bt(r->drive_spin));
        }
    }
}
