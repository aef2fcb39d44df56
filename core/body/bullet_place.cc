/* Bodies that somebody puts elsewhere. */
#include "body/bullet.h"

bool jox_bodies_place(JoxBodies *b, uint32_t row, const double position[3], const double turn[4]) {
    if (row >= b->count || !b->rows[row].live)
        return false;
    JoxRow *r = &b->rows[row];
    btTransform frame = jox_row_frame(r);
    frame.setOrigin(btVector3(btScalar(position[0]), btScalar(position[1]), btScalar(position[2])));
    if (turn) {
        const btQuaternion q{float(turn[0]), float(turn[1]), float(turn[2]), float(turn[3])};
        frame.setRotation(q.normalized());
    }
    if (r->held)
        jox_bodies_let_go(b, row, JoxV3{0, 0, 0});
    const btTransform at = frame * r->shape.frame;
    r->body->setWorldTransform(at);
    r->body->setInterpolationWorldTransform(at);
    if (r->shape.mass > 0) {
        jox_bodies_set_velocity(b, row, JoxV3{0, 0, 0}, JoxV3{0, 0, 0});
        r->body->setInterpolationLinearVelocity(btVector3(0, 0, 0));
        r->body->setInterpolationAngularVelocity(btVector3(0, 0, 0));
        r->body->updateInertiaTensor();
    }
    b->world->updateSingleAabb(r->body);
    for (uint32_t k = 0; k < b->live; k++) /* what leant on it falls */
        if (b->rows[b->order[k]].shape.mass > 0)
            b->rows[b->order[k]].body->activate(true);
    JOX_CHECK(jox_bodies_check(b));
    return true;
}
