/* Contacts of boxes with boxes and of bodies with the ground. Bullet's own algorithms for these two
   call functions of the C library whose last bits differ between systems (atan2f, sinf, cosf);
   these do not, so that a world with bodies has one hash everywhere. What else of Bullet moves
   bodies is made of + - * / and sqrt, or replaced in bullet_world.cc. */
#include "body/bullet.h"

#include <new>

/* Bullet's test of two boxes, from its btBoxBoxDetector.cpp: adds up to `most` contacts to
   `result`. A rotation is three rows of four numbers; `sizes` are whole lengths of the sides. */
int dBoxBox2(const btVector3 &at1, const float *rotation1, const btVector3 &sizes1,
             const btVector3 &at2, const float *rotation2, const btVector3 &sizes2,
             btVector3 &normal, float *depth, int *code, int most, struct dContactGeom *, int skip,
             btDiscreteCollisionDetectorInterface::Result &result);

namespace {

/* Two faces have at most this many contacts: the corners of their common octagon. */
const int MOST_OF_FACES = 8;

/* A box with its pose, as dBoxBox2 takes it. */
struct PlacedBox {
    btVector3 at, sizes;
    float rotation[12];

    explicit PlacedBox(const btCollisionObjectWrapper *wrapper)
        : at(wrapper->getWorldTransform().getOrigin()),
          sizes(2.0f * static_cast<const btBoxShape *>(wrapper->getCollisionShape())
                           ->getHalfExtentsWithMargin()) {
        for (int row = 0; row < 3; row++)
            for (int k = 0; k < 3; k++)
                rotation[4 * row + k] = wrapper->getWorldTransform().getBasis()[row][k];
    }
};

/* Takes the contacts of two boxes, and passes on the deepest and three more: those whose directions
   from the middle of all, in the plane of contact, are nearest to quarter turns from its own. */
struct SpreadContacts : btDiscreteCollisionDetectorInterface::Result {
    btVector3 normal, points[MOST_OF_FACES];
    float depths[MOST_OF_FACES]; /* m; negative where the boxes overlap */
    int count = 0;

    void setShapeIdentifiersA(int, int) override {}
    void setShapeIdentifiersB(int, int) override {}
    void addContactPoint(const btVector3 &towards_one, const btVector3 &point,
                         float depth) override {
        JOX_ASSERT(count < MOST_OF_FACES);
        normal = towards_one;
        points[count] = point;
        depths[count++] = depth;
    }
    void pass_on(int k, btManifoldResult *result) {
        result->addContactPoint(normal, points[k], depths[k]);
        points[k] = points[--count];
        depths[k] = depths[count];
    }
    /* Returns the contact whose direction from `middle` is nearest to `wanted`. */
    int find_nearest(const btVector3 &middle, const btVector3 &wanted) const {
        int best = 0;
        float most = -INFINITY;
        for (int k = 0; k < count; k++) {
            const btVector3 away = points[k] - middle;
            const float length = away.length();
            const float along = length > 0 ? away.dot(wanted) / length : 0;
            if (along > most) {
                most = along;
                best = k;
            }
        }
        return best;
    }
    void pass_on_all(btManifoldResult *result) {
        btVector3 middle(0, 0, 0);
        int deepest = 0;
        for (int k = 0; k < count; k++) {
            middle += points[k] / float(count);
            deepest = depths[k] < depths[deepest] ? k : deepest;
        }
        if (count > 4) {
            const btVector3 first = points[deepest] - middle, turned = normal.cross(first);
            pass_on(deepest, result);
            for (const btVector3 &wanted : {turned, -first, -turned})
                pass_on(find_nearest(middle, wanted), result);
        } else {
            for (int k = 0; k < count; k++)
                result->addContactPoint(normal, points[k], depths[k]);
        }
    }
};

/* Returns the manifold of an algorithm that has one, or NULL. */
btPersistentManifold *get_manifold(btCollisionAlgorithm *algorithm) {
    btManifoldArray manifolds;
    algorithm->getAllContactManifolds(manifolds);
    return manifolds.size() ? manifolds[0] : nullptr;
}

struct BoxContacts : btBoxBoxCollisionAlgorithm {
    btPersistentManifold *manifold;

    BoxContacts(const btCollisionAlgorithmConstructionInfo &info,
                const btCollisionObjectWrapper *one, const btCollisionObjectWrapper *two)
        : btBoxBoxCollisionAlgorithm(nullptr, info, one, two), manifold(get_manifold(this)) {}

    void processCollision(const btCollisionObjectWrapper *one, const btCollisionObjectWrapper *two,
                          const btDispatcherInfo &, btManifoldResult *result) override {
        if (!manifold)
            return;
        result->setPersistentManifold(manifold);
        const PlacedBox a(one), b(two);
        SpreadContacts contacts;
        btVector3 normal;
        float depth;
        int code;
        dBoxBox2(a.at, a.rotation, a.sizes, b.at, b.rotation, b.sizes, normal, &depth, &code,
                 MOST_OF_FACES, nullptr, 0, contacts);
        contacts.pass_on_all(result);
        result->refreshContactPoints();
    }
};

/* Contacts of a body with the ground, the plane z = 0. With fewer than three, more are searched:
   the lowest points of the body tilted a little to three sides. All are found in the first step, as
   a body would rock on one. */
struct GroundContacts : btConvexPlaneCollisionAlgorithm {
    btPersistentManifold *manifold;
    bool ground_first;

    GroundContacts(const btCollisionAlgorithmConstructionInfo &info,
                   const btCollisionObjectWrapper *one, const btCollisionObjectWrapper *two,
                   bool swapped)
        : btConvexPlaneCollisionAlgorithm(nullptr, info, one, two, swapped, 0, 0),
          manifold(get_manifold(this)), ground_first(swapped) {}

    void processCollision(const btCollisionObjectWrapper *one, const btCollisionObjectWrapper *two,
                          const btDispatcherInfo &, btManifoldResult *result) override {
        static const float SIDES[3][2] = {{1.0f, 0.0f}, {-0.5f, 0.8660254f}, {-0.5f, -0.8660254f}};
        if (!manifold)
            return;
        const btCollisionObjectWrapper *body = ground_first ? two : one;
        const btConvexShape *shape = static_cast<const btConvexShape *>(body->getCollisionShape());
        const btTransform &at = body->getWorldTransform();
        result->setPersistentManifold(manifold);
        add_lowest(shape, at, btVector3(0, 0, -1), result);
        /* Round bodies would roll on contacts beside their lowest point. */
        if (shape->isPolyhedral() && manifold->getNumContacts() < 3) {
            const float slope =
                btMin(gContactBreakingThreshold / shape->getAngularMotionDisc(), 0.4f);
            for (const float *side : SIDES)
                add_lowest(shape, at, btVector3(slope * side[0], slope * side[1], -1), result);
        }
        if (manifold->getNumContacts())
            result->refreshContactPoints();
    }

  private:
    /* Adds the point of a body that lies farthest in a direction, if it is near the ground. */
    void add_lowest(const btConvexShape *shape, const btTransform &at, const btVector3 &direction,
                    btManifoldResult *result) {
        const btVector3 lowest = at * shape->localGetSupportingVertex(direction * at.getBasis());
        if (lowest.z() < manifold->getContactBreakingThreshold())
            result->addContactPoint(btVector3(0, 0, 1), btVector3(lowest.x(), lowest.y(), 0),
                                    lowest.z());
    }
};

} // namespace

template <typename Algorithm, typename... Arguments>
static btCollisionAlgorithm *create_algorithm(const btCollisionAlgorithmConstructionInfo &info,
                                              Arguments... arguments) {
    return new (info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(Algorithm)))
        Algorithm(arguments...);
}

btCollisionAlgorithm *
JoxBoxContactsMaker::CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo &info,
                                              const btCollisionObjectWrapper *one,
                                              const btCollisionObjectWrapper *two) {
    return create_algorithm<BoxContacts>(info, info, one, two);
}

btCollisionAlgorithm *
JoxGroundContactsMaker::CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo &info,
                                                 const btCollisionObjectWrapper *one,
                                                 const btCollisionObjectWrapper *two) {
    return create_algorithm<GroundContacts>(info, info, one, two, m_swapped);
}

JoxBulletConfiguration::JoxBulletConfiguration(const btDefaultCollisionConstructionInfo &info)
    : btDefaultCollisionConfiguration(info) {
    ground_first.m_swapped = true;
}

btCollisionAlgorithmCreateFunc *JoxBulletConfiguration::getCollisionAlgorithmCreateFunc(int one,
                                                                                        int two) {
    if (one == BOX_SHAPE_PROXYTYPE && two == BOX_SHAPE_PROXYTYPE)
        return &boxes;
    if (btBroadphaseProxy::isConvex(one) && two == STATIC_PLANE_PROXYTYPE)
        return &ground;
    if (one == STATIC_PLANE_PROXYTYPE && btBroadphaseProxy::isConvex(two))
        return &ground_first;
    return btDefaultCollisionConfiguration::getCollisionAlgorithmCreateFunc(one, two);
}
