/* Bodies that move by velocities of their own: kinematic ones. */
#include "body/bullet.h"

#include <algorithm>
#include <cstring>

static void set_velocity(JoxRow *r, const double v[3]) {
    r->body->setLinearVelocity(btVector3(float(v[0]), float(v[1]), float(v[2])));
}

/* A path is given for the shape's own frame, and kept for the centre of mass, about which a body
   turns. */
void jox_row_begin_path(JoxRow *r, const JoxBodyDef *def) {
    const btVector3 &centre = r->body->getWorldTransform().getOrigin();
    jox_row_set_path(r, &def->path);
    for (uint32_t n = 0; n < 3 * def->path.count; n++)
        r->path.points[n] += double(centre[int(n % 3)]) - def->position[n % 3];
    set_velocity(r, jox_path_spot(&r->path, 0).velocity);
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

/* ---- what holds it up ---- */

/* How it goes on from where it is along its path, m/s. */
static btVector3 going(const JoxRow *r) {
    const JoxPathSpot spot = jox_path_spot(&r->path, r->path_time);
    return (r->goes_back ? -1.0f : 1.0f) *
           btVector3(float(spot.velocity[0]), float(spot.velocity[1]), float(spot.velocity[2]));
}

bool jox_bodies_hold_up(JoxBodies *b, uint32_t row, float share) {
    JoxRow *r = jox_row_of(b, row);
    if (!r || !r->kinematic)
        return false;
    JOX_ASSERT(share >= 0.0f && share <= 1.0f);
    r->meets = true;
    r->goes = share;
    return !r->met;
}

bool jox_bodies_ends_run(const JoxBodies *b, uint32_t row) {
    const JoxRow *r = jox_row_of(b, row);
    return r && r->kinematic && r->ends_run;
}

void jox_bodies_begin_drive(JoxBodies *b) {
    for (uint32_t k = 0; k < b->live; k++) {
        JoxRow *r = &b->rows[b->order[k]];
        if (!r->kinematic)
            continue;
        r->held_up = r->meets ? 1.0f - r->goes : 0.0f;
        r->met = r->meets;
        r->meets = false;
        if (r->met && r->path.reopens && !r->goes_back) {
            r->goes_back = true;
            r->held_up = 1.0f;
        }
        r->drive = jox_v3(r->body->getLinearVelocity());
        r->drive_spin = jox_v3(r->body->getAngularVelocity());
    }
}

/* On by dt along its path, or back: what is held up comes to all that follows so much later. */
static void go_on(JoxRow *r, double dt) {
    if (r->goes_back) {
        const double began = jox_path_leg_began(&r->path, r->path_time);
        r->path_time = std::max(began, r->path_time - dt);
        if (r->path_time == began) { /* there it waits, as it did before it set out */
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

/* What is under way is awake, and wakes what it touches; at rest it lets that sleep. */
static void wake(JoxRow *r) {
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
        if (r->path.count) { /* to where it has to be, whatever was rounded so far */
            go_on(r, double(dt) * double(share));
            const JoxPathSpot spot = jox_path_spot(&r->path, r->path_time);
            const btVector3 &at = r->body->getWorldTransform().getOrigin();
            double v[3];
            for (int i = 0; i < 3; i++)
                v[i] = (spot.at[i] - double(at[i])) / double(dt);
            set_velocity(r, v);
        } else if (r->held_up > 0.0f) {
            r->body->setLinearVelocity(share * jox_bt(r->drive));
            r->body->setAngularVelocity(share * jox_bt(r->drive_spin));
        }
        wake(r);
    }
}

void jox_bodies_driven(JoxBodies *b) {
    for (uint32_t k = 0; k < b->live; k++) {
        JoxRow *r = &b->rows[b->order[k]];
        if (!r->kinematic)
            continue;
        if (r->path.count) {
            r->body->setLinearVelocity(going(r));
        } else if (r->held_up > 0.0f) {
            r->body->setLinearVelocity(jox_bt(r->drive));
            r->body->setAngularVelocity(jox_bt(r->drive_spin));
        }
    }
}
