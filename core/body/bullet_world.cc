/* Overrides of Bullet's world that skip work; moving bodies get the same results, bit for bit. */
#include "body/bullet.h"

/* Moves kinematic bodies by their velocities before contacts are found; Bullet would derive
   velocities from how the bodies were moved. */
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

/* Whether Bullet moves a body by its velocity. */
static bool is_integrated(const btRigidBody *body) {
    return body->isActive() && !body->isKinematicObject();
}

/* Predicts motion of bodies that are awake. Bullet would also damp and predict sleeping ones,
   whose velocities are 0. */
void JoxBulletWorld::predictUnconstraintMotion(btScalar dt) {
    for (int i = 0; i < m_nonStaticRigidBodies.size(); i++) {
        btRigidBody *body = m_nonStaticRigidBodies[i];
        if (!is_integrated(body))
            continue;
        body->applyDamping(dt);
        body->predictIntegratedTransform(dt, body->getInterpolationWorldTransform());
    }
}

/* Whether a body may exceed Bullet's threshold of motion for continuous collision detection. */
static bool may_exceed_ccd_threshold(const btRigidBody *body, btScalar dt) {
    const btScalar way2 = body->getLinearVelocity().length2() * dt * dt;
    return is_integrated(body) && !(way2 < 0.99f * body->getCcdSquareMotionThreshold());
}

void JoxBulletWorld::createPredictiveContacts(btScalar dt) {
    releasePredictiveContacts();
    for (int i = 0; i < m_nonStaticRigidBodies.size(); i++)
        if (may_exceed_ccd_threshold(m_nonStaticRigidBodies[i], dt))
            createPredictiveContactsInternal(&m_nonStaticRigidBodies[i], 1, dt);
}

void JoxBulletWorld::integrateTransforms(btScalar dt) {
    btTransform to;
    for (int i = 0; i < m_nonStaticRigidBodies.size(); i++) {
        btRigidBody *body = m_nonStaticRigidBodies[i];
        if (!is_integrated(body))
            continue;
        if (may_exceed_ccd_threshold(body, dt)) {
            integrateTransformsInternal(&m_nonStaticRigidBodies[i], 1, dt);
            continue;
        }
        body->predictIntegratedTransform(dt, to);
        body->proceedToTransform(to);
    }
}

/* Sorts the pairs in each substep, so that their order is that of the bodies and does not depend
   on the past; a single pair needs no sorting. */
void JoxBulletWorld::performDiscreteCollisionDetection() {
    updateAabbs();
    computeOverlappingPairs();
    btOverlappingPairCache *pairs = getPairCache();
    getDispatchInfo().m_deterministicOverlappingPairs = pairs->getNumOverlappingPairs() > 1;
    getDispatcher()->dispatchAllCollisionPairs(pairs, getDispatchInfo(), getDispatcher());
}
