/* What Bullet's world does differently: the same to the bit of bodies that move. */
#include "body/bullet.h"

/* Bullet would take the velocities of kinematic bodies from how they were moved; here they have
   velocities, and move by these, before contacts are looked for. */
void JoxBulletWorld::saveKinematicState(btScalar dt) {
    btTransform to;
    for (int i = 0; i < m_nonStaticRigidBodies.size(); i++) {
        btRigidBody *body = m_nonStaticRigidBodies[i];
        if (!body->isKinematicObject() || !body->isActive())
            continue;
        body->predictIntegratedTransform(dt, to);
        body->setCenterOfMassTransform(to);
    }
}

/* Whether Bullet moves a body on by its velocity. */
static bool is_moved(const btRigidBody *body) {
    return body->isActive() && !body->isKinematicObject();
}

/* Bullet damps and predicts bodies that sleep, too: velocities of 0, and where they lie. */
void JoxBulletWorld::predictUnconstraintMotion(btScalar dt) {
    for (int i = 0; i < m_nonStaticRigidBodies.size(); i++) {
        btRigidBody *body = m_nonStaticRigidBodies[i];
        if (!is_moved(body))
            continue;
        body->applyDamping(dt);
        body->predictIntegratedTransform(dt, body->getInterpolationWorldTransform());
    }
}

/* Whether Bullet may find that a body moves by more than its threshold of continuous collision. */
static bool is_fast(const btRigidBody *body, btScalar dt) {
    const btScalar way2 = body->getLinearVelocity().length2() * dt * dt;
    return is_moved(body) && !(way2 < 0.99f * body->getCcdSquareMotionThreshold());
}

void JoxBulletWorld::createPredictiveContacts(btScalar dt) {
    releasePredictiveContacts();
    for (int i = 0; i < m_nonStaticRigidBodies.size(); i++)
        if (is_fast(m_nonStaticRigidBodies[i], dt))
            createPredictiveContactsInternal(&m_nonStaticRigidBodies[i], 1, dt);
}

void JoxBulletWorld::integrateTransforms(btScalar dt) {
    btTransform to;
    for (int i = 0; i < m_nonStaticRigidBodies.size(); i++) {
        btRigidBody *body = m_nonStaticRigidBodies[i];
        if (!is_moved(body))
            continue;
        if (is_fast(body, dt)) {
            integrateTransformsInternal(&m_nonStaticRigidBodies[i], 1, dt);
            continue;
        }
        body->predictIntegratedTransform(dt, to);
        body->proceedToTransform(to);
    }
}

/* Bullet sorts the pairs in each substep, so that their order is that of the bodies and not one
   that follows from how they came about; a single one has no order. */
void JoxBulletWorld::performDiscreteCollisionDetection() {
    updateAabbs();
    computeOverlappingPairs();
    btOverlappingPairCache *pairs = getPairCache();
    getDispatchInfo().m_deterministicOverlappingPairs = pairs->getNumOverlappingPairs() > 1;
    getDispatcher()->dispatchAllCollisionPairs(pairs, getDispatchInfo(), getDispatcher());
}
