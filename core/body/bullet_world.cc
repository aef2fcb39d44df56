/* Overrides of Bullet's world and solver, for two reasons. They skip work that changes nothing; and
   what Bullet computes by functions of the C library, whose last bits differ between systems, they
   compute by ours (base/number/elementary.h), so that a world with bodies has one hash everywhere.
 */
#include "body/bullet.h"

extern "C" {
#include "base/number/elementary.h"
}

/* Returns a pose after `dt` seconds with a velocity, m/s, and a spin, rad/s, that do not change:
   the exponential map of the spin. As in Bullet, a body turns by at most an eighth of a turn; for
   angles up to half of that the series of sine and cosine have errors below 1e-11. */
static btTransform move_pose(const btTransform &from, const btVector3 &velocity,
                             const btVector3 &spin, btScalar dt) {
    btTransform to(from.getBasis(), from.getOrigin() + velocity * dt);
    double rate2 = double(spin.length2()), scale = 0.5 * double(dt);
    if (!(rate2 > 0.0))
        return to;
    if (rate2 * scale * scale > M_PI * M_PI / 64)
        scale = M_PI / 8 / sqrt(rate2);
    const double h2 = rate2 * scale * scale; /* square of half the angle */
    const double sine = 1 - h2 / 6 * (1 - h2 / 20 * (1 - h2 / 42 * (1 - h2 / 72))); /* sin(h) / h */
    const double cosine =
        1 - h2 / 2 * (1 - h2 / 12 * (1 - h2 / 30 * (1 - h2 / 56 * (1 - h2 / 90))));
    const btVector3 axis = spin * float(scale * sine);
    btQuaternion turned =
        btQuaternion(axis.x(), axis.y(), axis.z(), float(cosine)) * from.getRotation();
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

/* A damping, the share of a velocity that is lost in 1 s, and the factor by which velocities fall
   in a substep; kept as most bodies have the same. */
struct Damping {
    btScalar damping = 0, factor = 1;

    btScalar find_factor(btScalar of_body, btScalar dt) {
        if (of_body != damping)
            factor = float(jox_pow(1.0 - double(of_body), double(dt)));
        damping = of_body;
        return factor;
    }
};

/* Damps bodies that are awake, and predicts their motion. Bullet would also do this to sleeping
   ones, whose velocities are 0. */
void JoxBulletWorld::predictUnconstraintMotion(btScalar dt) {
    Damping linear, angular;
    for (int i = 0; i < m_nonStaticRigidBodies.size(); i++) {
        btRigidBody *body = m_nonStaticRigidBodies[i];
        if (!is_integrated(body))
            continue;
        body->setLinearVelocity(body->getLinearVelocity() *
                                linear.find_factor(body->getLinearDamping(), dt));
        body->setAngularVelocity(body->getAngularVelocity() *
                                 angular.find_factor(body->getAngularDamping(), dt));
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

/* Moves a fast body by Bullet, which stops it where it hits something; Bullet's turn, by sinf and
   cosf, is replaced by one for the share of the way that the body went. */
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
