/* Overrides of Bullet's world and solver, for two reasons. They skip work that changes nothing; and
   what Bullet computes by functions of the C library, whose last bits differ between systems, they
   compute by ours (base/number/elementary.h), so that a world with bodies has one hash everywhere.
 */
#include "body/bullet.h"

extern "C" {
#include "base/number/elementary.h"
}

/* Returns a pose after `dt` seconds with a velocity, m/s, and a spin, rad/s, that do not change:
   the exponential map of the spin. As in Bullet, a body turns by at most an eighth of a turn. */
static btTransform move_pose(const btTransform &from, const btVector3 &velocity,
                             const btVector3 &spin, btScalar dt) {
    btTransform to(from.getBasis(), from.getOrigin() + velocity * dt);
    const double rate = sqrt(double(spin.length2()));
    if (!(rate > 0.0))
        return to;
    const double half = 0.5 * btMin(rate * double(dt), M_PI / 4);
    const btVector3 axis = spin * float(jox_sin(half) / rate);
    const btQuaternion turn(axis.x(), axis.y(), axis.z(), float(jox_cos(half)));
    btQuaternion turned = turn * from.getRotation();
    if (turned.length2() > SIMD_EPSILON)
        to.setRotation(turned.normalize());
    return to;
}

static btTransform predict_pose(const btRigidBody *body, btScalar dt) {
    return move_pose(body->getWorldTransform(), body->getLinearVelocity(),
                     body->getAngularVelocity(), dt);
}

/* Moves kinematic bodies by their velocities before contacts are found; Bullet would derive
   velocities from how the bodies were moved. */
void JoxBulletWorld::saveKinematicState(btScalar dt) {
    for (int i = 0; i < m_nonStaticRigidBodies.size(); i++) {
        btRigidBody *body = m_nonStaticRigidBodies[i];
        if (body->isKinematicObject() && body->isActive())
            body->setCenterOfMassTransform(predict_pose(body, dt));
    }
}

/* Whether Bullet moves a body by its velocity. */
static bool is_integrated(const btRigidBody *body) {
    return body->isActive() && !body->isKinematicObject();
}

/* Returns the factor by which velocities fall in `dt` seconds with a damping, the share lost in 1
 * s. */
static btScalar compute_damping(btScalar damping, btScalar dt) {
    return float(jox_pow(1.0 - double(damping), double(dt)));
}

/* Damps bodies that are awake, and predicts their motion. Bullet would also do this to sleeping
   ones, whose velocities are 0. */
void JoxBulletWorld::predictUnconstraintMotion(btScalar dt) {
    for (int i = 0; i < m_nonStaticRigidBodies.size(); i++) {
        btRigidBody *body = m_nonStaticRigidBodies[i];
        if (!is_integrated(body))
            continue;
        body->setLinearVelocity(body->getLinearVelocity() *
                                compute_damping(body->getLinearDamping(), dt));
        body->setAngularVelocity(body->getAngularVelocity() *
                                 compute_damping(body->getAngularDamping(), dt));
        body->setInterpolationWorldTransform(predict_pose(body, dt));
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

/* Moves a fast body by Bullet, which stops it where it hits something, and turns it by the share of
   its way that it went. */
void JoxBulletWorld::integrate_fast(btRigidBody *body, btScalar dt) {
    const btTransform from = body->getWorldTransform();
    integrateTransformsInternal(&body, 1, dt);
    const btScalar whole = body->getLinearVelocity().length() * dt;
    const btScalar went = (body->getWorldTransform().getOrigin() - from.getOrigin()).length();
    const btScalar share = whole > 0 ? btMin(went / whole, 1.0f) : 1.0f;
    btTransform to = move_pose(from, btVector3(0, 0, 0), body->getAngularVelocity(), share * dt);
    to.setOrigin(body->getWorldTransform().getOrigin());
    body->proceedToTransform(to);
}

void JoxBulletWorld::integrateTransforms(btScalar dt) {
    for (int i = 0; i < m_nonStaticRigidBodies.size(); i++) {
        btRigidBody *body = m_nonStaticRigidBodies[i];
        if (!is_integrated(body))
            continue;
        if (may_exceed_ccd_threshold(body, dt))
            integrate_fast(body, dt);
        else
            body->proceedToTransform(predict_pose(body, dt));
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

/* Moves bodies that overlap apart, which Bullet would do in the call. */
btScalar JoxBulletSolver::solveGroupCacheFriendlyFinish(btCollisionObject **bodies, int count,
                                                        const btContactSolverInfo &info) {
    for (int i = 0; i < m_tmpSolverBodyPool.size() && info.m_splitImpulse; i++) {
        btSolverBody &body = m_tmpSolverBodyPool[i];
        if (body.m_pushVelocity.isZero() && body.m_turnVelocity.isZero())
            continue;
        body.m_worldTransform =
            move_pose(body.m_worldTransform, body.m_pushVelocity,
                      body.m_turnVelocity * info.m_splitImpulseTurnErp, info.m_timeStep);
        body.m_pushVelocity.setZero();
        body.m_turnVelocity.setZero();
    }
    return btSequentialImpulseConstraintSolver::solveGroupCacheFriendlyFinish(bodies, count, info);
}
