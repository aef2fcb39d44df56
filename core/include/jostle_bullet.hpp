// Couples bodies of a program's own Bullet world with Jostle's people, for C++17: they push the crowd, and it pushes
// them. Each has a counterpart of the same shape, mass and friction in Jostle, which takes the body's pose before a
// step; after the step the body gets the impulse that people gave to the counterpart. Collisions between the bodies
// stay the program's.
//
//     jostle::BulletBridge bridge(world);      // a JoWorld; it must outlive the bridge
//     bridge.join(*body);                      // a btRigidBody
//     for (;;) {
//         bridge.before();
//         jo_world_step(world, 1);             // or jo_scene_step
//         bridge.after(dt);
//         bullet->stepSimulation(dt, 20, 1.0f / 240);
//     }
#ifndef JOSTLE_BULLET_HPP
#define JOSTLE_BULLET_HPP

#include <algorithm>
#include <btBulletDynamicsCommon.h>
#include <vector>

#include "jostle.hpp"

namespace jostle {

class BulletBridge {
  public:
    explicit BulletBridge(JoWorld *world) noexcept : world_(world) {}

    // Adds a counterpart of a body, which people meet from now on. Boxes, spheres and upright cylinders
    // (btCylinderShapeZ) keep their shape, other shapes become the bounding box in their own frame. A body without
    // mass, or a kinematic one, pushes people and is not pushed. It may be joined once, and must live until it
    // leaves. Throws Error if Jostle refuses it.
    JoBody join(btRigidBody &body) {
        JoBodyDef def = jo_default_body_def();
        shape_of(body, def);
        const btVector3 at = body.getWorldTransform().getOrigin();
        def.kinematic = body.isStaticOrKinematicObject();
        def.mass = def.kinematic ? 0 : 1 / static_cast<double>(body.getInvMass());
        def.x = at.x();
        def.y = at.y();
        def.z = at.z();
        def.force_limit = 0; // none: it follows the program's body; jo_body_pushed reports the push of people
        def.friction = body.getFriction();
        def.restitution = body.getRestitution();
        JoError error{};
        const JoBody like = jo_world_add_body(world_, &def, &error);
        detail::require(like.generation != 0, error);
        joined_.push_back({&body, like});
        return like;
    }

    // Removes the counterpart of a body; does nothing if it has not joined.
    void leave(btRigidBody &body) {
        const auto found = std::find_if(joined_.begin(), joined_.end(), [&](const Joined &one) { return one.own == &body; });
        if (found == joined_.end())
            return;
        JoError error{};
        jo_body_remove(world_, found->like, &error);
        joined_.erase(found);
    }

    // Moves the counterparts to the poses and velocities of the program's bodies. Call it before a step. Throws
    // Error.
    void before() const {
        for (const Joined &one : joined_) {
            const btTransform &frame = one.own->getWorldTransform();
            const btQuaternion turn = frame.getRotation();
            const double at[3] = {frame.getOrigin().x(), frame.getOrigin().y(), frame.getOrigin().z()};
            const double quaternion[4] = {turn.x(), turn.y(), turn.z(), turn.w()};
            double velocity[3], spin[3];
            for (int k = 0; k < 3; k++) {
                velocity[k] = std::clamp(static_cast<double>(one.own->getLinearVelocity()[k]), -100.0, 100.0);
                spin[k] = std::clamp(static_cast<double>(one.own->getAngularVelocity()[k]), -100.0, 100.0);
            }
            JoError error{};
            detail::require(jo_body_place(world_, one.like, at, quaternion, &error) &&
                                jo_body_set_velocity(world_, one.like, velocity, spin, &error),
                            error);
        }
    }

    // Applies the impulses that people gave the counterparts to the program's bodies, as forces throughout the
    // `seconds` of the program's next stepSimulation, so that a body held by friction is not jerked loose. Call it
    // after a step.
    void after(double seconds) const {
        for (const Joined &one : joined_) {
            double impulse[3], turn[3];
            if (!jo_body_pushed(world_, one.like, impulse, turn) || one.own->isStaticOrKinematicObject())
                continue;
            const btVector3 p = vector(impulse), t = vector(turn);
            if (p.fuzzyZero() && t.fuzzyZero())
                continue;
            one.own->activate(true);
            one.own->applyCentralForce(p / static_cast<btScalar>(seconds));
            one.own->applyTorque(t / static_cast<btScalar>(seconds));
        }
    }

  private:
    struct Joined {
        btRigidBody *own;
        JoBody like;
    };

    static btVector3 vector(const double v[3]) {
        return btVector3(static_cast<btScalar>(v[0]), static_cast<btScalar>(v[1]), static_cast<btScalar>(v[2]));
    }

    static void shape_of(const btRigidBody &body, JoBodyDef &def) {
        const btCollisionShape *shape = body.getCollisionShape();
        const int kind = shape->getShapeType();
        if (kind == SPHERE_SHAPE_PROXYTYPE) {
            def.shape = JO_SPHERE;
            def.size[0] = static_cast<const btSphereShape *>(shape)->getRadius();
            return;
        }
        btVector3 low, high;
        shape->getAabb(btTransform::getIdentity(), low, high);
        btVector3 size = high - low;
        if (kind == BOX_SHAPE_PROXYTYPE)
            size = 2 * static_cast<const btBoxShape *>(shape)->getHalfExtentsWithMargin();
        const bool upright =
            kind == CYLINDER_SHAPE_PROXYTYPE && static_cast<const btCylinderShape *>(shape)->getUpAxis() == 2;
        def.shape = upright ? JO_CYLINDER : JO_BOX;
        def.size[0] = upright ? size.x() / 2 : size.x();
        def.size[1] = upright ? size.z() : size.y();
        def.size[2] = size.z();
    }

    JoWorld *world_;
    std::vector<Joined> joined_;
};

} // namespace jostle

#endif
