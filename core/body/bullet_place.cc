/* Bodies that agents carry or that are moved to another place. */
#include "body/bullet.h"

bool jox_bodies_set_carrier(JoxBodies *b, uint32_t row, uint32_t agent_id) {
    JoxRow *r = jox_live_row(b, row);
    if (!r || r->shape.mass <= 0)
        return false;
    r->held = true;
    r->holder = agent_id;
    r->body->setCollisionFlags(r->body->getCollisionFlags() |
                               btCollisionObject::CF_NO_CONTACT_RESPONSE);
    return true;
}

static void move_to_carrier(JoxRow *r) {
    btTransform at = r->body->getWorldTransform();
    at.setOrigin(jox_bt(r->carried));
    r->body->setWorldTransform(at);
    r->body->setInterpolationWorldTransform(at);
    r->body->setLinearVelocity(jox_bt(r->carried_along));
    r->body->setAngularVelocity(btVector3(0, 0, 0));
}

void jox_bodies_carry(JoxBodies *b, uint32_t row, JoxV3 centre, JoxV3 velocity) {
    JoxRow *r = jox_live_row(b, row);
    if (!r || !r->held || !jox_finite(jox_bt(centre)) || !jox_finite(jox_bt(velocity)))
        return;
    r->placed = true;
    r->carried = centre;
    r->carried_along = velocity;
    move_to_carrier(r);
    r->body->activate(true);
}

void jox_bodies_keep_carried(JoxBodies *b) {
    for (uint32_t k = 0; k < b->live; k++) {
        JoxRow *r = &b->rows[b->order[k]];
        if (r->held && r->placed)
            move_to_carrier(r);
        r->placed = false;
    }
}

void jox_bodies_end_carrying(JoxBodies *b, uint32_t row, JoxV3 velocity) {
    JoxRow *r = jox_live_row(b, row);
    if (!r || !r->held)
        return;
    r->held = false;
    r->body->setCollisionFlags(r->body->getCollisionFlags() &
                               ~btCollisionObject::CF_NO_CONTACT_RESPONSE);
    jox_bodies_set_velocity(b, row, velocity, JoxV3{0, 0, 0});
}

bool jox_bodies_place(JoxBodies *b, uint32_t row, const double position[3], const double turn[4]) {
    JoxRow *r = jox_live_row(b, row);
    if (!r)
        return false;
    btTransform frame = jox_row_frame(r);
    frame.setOrigin(btVector3(btScalar(position[0]), btScalar(position[1]), btScalar(position[2])));
    if (turn) {
        const btQuaternion q{float(turn[0]), float(turn[1]), float(turn[2]), float(turn[3])};
        frame.setRotation(q.normalized());
    }
    if (r->held)
        jox_bodies_end_carrying(b, row, JoxV3{0, 0, 0});
    const btTransform at = frame * r->shape.frame;
    r->body->setWorldTransform(at);
    r->body->setInterpolationWorldTransform(at);
    if (r->shape.mass > 0 || r->kinematic) {
        jox_bodies_set_velocity(b, row, JoxV3{0, 0, 0}, JoxV3{0, 0, 0});
        r->body->setInterpolationLinearVelocity(btVector3(0, 0, 0));
        r->body->setInterpolationAngularVelocity(btVector3(0, 0, 0));
        r->body->updateInertiaTensor();
    }
    b->world->updateSingleAabb(r->body);
    for (uint32_t k = 0; k < b->live; k++) /* wake bodies that leant on it */
        if (b->rows[b->order[k]].shape.mass > 0)
            b->rows[b->order[k]].body->activate(true);
    JOX_CHECK(jox_bodies_check(b));
    return true;
}
