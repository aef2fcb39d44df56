/* Contacts over a re-insertion. Bullet gathers the points at which two bodies touch over several
   steps, and its solver begins from their last impulses. They are noted before everything is taken
   out and put into the contacts that are found anew: what stands needs not come to rest again. */
#include "body/bullet.h"

#include "base/sort.h"

/* Id of a body; of ground and walls, the negative number that they have. */
static int32_t name_of(const JoxBodies *b, const btCollisionObject *object) {
    const int index = object->getUserIndex();
    JOX_ASSERT(index < 0 ? index >= -1 - int(b->wall_count) : b->rows[index].body == object);
    return index < 0 ? index : int32_t(b->rows[index].id);
}

static float *put(float *to, const btVector3 &v) {
    for (int i = 0; i < 3; i++)
        *to++ = v[i];
    return to;
}

static btVector3 vector(const float *v) {
    return btVector3(v[0], v[1], v[2]);
}

/* A point of a manifold as a record; the body of the lower name is the first. */
static JoxContactRecord record_of(const JoxBodies *b, const btPersistentManifold *manifold,
                                  const btManifoldPoint &p) {
    const int32_t one = name_of(b, manifold->getBody0()), two = name_of(b, manifold->getBody1());
    const bool swap = two < one;
    JoxContactRecord record = JoxContactRecord();
    record.who[0] = swap ? two : one;
    record.who[1] = swap ? one : two;
    record.who[2] = swap ? p.m_index1 : p.m_index0;
    record.who[3] = swap ? p.m_index0 : p.m_index1;
    put(record.points[0], swap ? p.m_localPointB : p.m_localPointA);
    put(record.points[1], swap ? p.m_localPointA : p.m_localPointB);
    put(record.normal, swap ? -p.m_normalWorldOnB : p.m_normalWorldOnB);
    record.impulse[0] = p.m_appliedImpulse;
    record.impulse[1] = p.m_appliedImpulseLateral1;
    record.impulse[2] = p.m_appliedImpulseLateral2;
    return record;
}

static int by_who(const void *a, const void *b, const void *context) {
    (void)context;
    const JoxContactRecord *one = static_cast<const JoxContactRecord *>(a);
    const JoxContactRecord *two = static_cast<const JoxContactRecord *>(b);
    for (int k = 0; k < 4; k++)
        if (one->who[k] != two->who[k])
            return one->who[k] < two->who[k] ? -1 : 1;
    return 0;
}

uint32_t jox_bodies_note_contacts(const JoxBodies *b, JoxContactRecord *&contacts,
                                  uint32_t &capacity) {
    uint32_t count = 0;
    for (int m = 0; b->world && m < b->dispatcher->getNumManifolds(); m++) {
        const btPersistentManifold *manifold = b->dispatcher->getManifoldByIndexInternal(m);
        for (int c = 0; c < manifold->getNumContacts(); c++) {
            jox_reserve(contacts, capacity, count + 1);
            contacts[count++] = record_of(b, manifold, manifold->getContactPoint(c));
        }
    }
    jox_sort(contacts, count, sizeof *contacts, by_who, nullptr, nullptr);
    return count;
}

/* The first record that is not before this one, among `count`. */
static uint32_t find_first(const JoxContactRecord *contacts, uint32_t count,
                           const JoxContactRecord *record) {
    uint32_t low = 0, high = count;
    while (low < high) {
        const uint32_t middle = (low + high) / 2;
        if (by_who(&contacts[middle], record, nullptr) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Puts the points that were noted in the place of those found between the same parts; what follows
   from both bodies, such as their friction, is taken over from a point that was found. */
static void refill(const JoxBodies *b, btPersistentManifold *manifold,
                   const JoxContactRecord *contacts, uint32_t count) {
    const btManifoldPoint found = manifold->getContactPoint(0);
    const JoxContactRecord like = record_of(b, manifold, found);
    const bool swap = name_of(b, manifold->getBody1()) < name_of(b, manifold->getBody0());
    uint32_t k = find_first(contacts, count, &like);
    if (k == count || by_who(&contacts[k], &like, nullptr) != 0)
        return;
    manifold->clearManifold();
    for (; k < count && by_who(&contacts[k], &like, nullptr) == 0 &&
           manifold->getNumContacts() < MANIFOLD_CACHE_SIZE;
         k++) {
        btManifoldPoint p = found;
        p.m_localPointA = vector(contacts[k].points[swap]);
        p.m_localPointB = vector(contacts[k].points[!swap]);
        p.m_normalWorldOnB = swap ? -vector(contacts[k].normal) : vector(contacts[k].normal);
        p.m_appliedImpulse = contacts[k].impulse[0];
        p.m_appliedImpulseLateral1 = contacts[k].impulse[1];
        p.m_appliedImpulseLateral2 = contacts[k].impulse[2];
        manifold->addManifoldPoint(p);
    }
    JOX_ASSERT(manifold->getNumContacts() > 0);
    manifold->refreshContactPoints(manifold->getBody0()->getWorldTransform(),
                                   manifold->getBody1()->getWorldTransform());
}

/* Bullet looks for contacts of what is awake alone, so that all wakes for a moment. */
static void find_contacts(JoxBodies *b) {
    for (uint32_t k = 0; k < b->live; k++) {
        JoxRow *r = &b->rows[b->order[k]];
        r->activation = r->body->getActivationState();
        if (r->shape.mass > 0)
            r->body->forceActivationState(ACTIVE_TAG);
    }
    b->world->getDispatchInfo().m_timeStep = 0;
    b->world->performDiscreteCollisionDetection();
    for (uint32_t k = 0; k < b->live; k++) {
        JoxRow *r = &b->rows[b->order[k]];
        r->body->forceActivationState(r->activation);
    }
}

void jox_bodies_renew_contacts(JoxBodies *b, const JoxContactRecord *contacts, uint32_t count) {
    find_contacts(b);
    for (int m = 0; m < b->dispatcher->getNumManifolds(); m++) {
        btPersistentManifold *manifold = b->dispatcher->getManifoldByIndexInternal(m);
        if (manifold->getNumContacts() > 0)
            refill(b, manifold, contacts, count);
    }
}

/* ---- what holds bodies, for those who touch them ---- */

/* The row of a body that can be pushed, or JOX_NO_OBJECT. */
static uint32_t moving_row(const JoxBodies *b, const btCollisionObject *object) {
    const int index = object->getUserIndex();
    return index >= 0 && b->rows[index].shape.mass > 0 ? uint32_t(index) : JOX_NO_OBJECT;
}

/* What that touches: also a body that moves by a velocity of its own. */
static uint32_t other_row(const JoxBodies *b, const btCollisionObject *object) {
    return object->isKinematicObject() ? uint32_t(object->getUserIndex()) : moving_row(b, object);
}

/* Lists the contacts of two objects, one of which can be pushed, behind `count`; returns how many
   there are then. Bullet has measured the gaps before it moved the bodies for the last time. */
static uint32_t add_seen(JoxBodies *b, const btPersistentManifold *manifold, float per_second,
                         uint32_t count) {
    const btCollisionObject *one = manifold->getBody0(), *two = manifold->getBody1();
    const uint32_t row = moving_row(b, one);
    const bool swap = row == JOX_NO_OBJECT;
    const uint32_t first = swap ? moving_row(b, two) : row;
    const uint32_t second = other_row(b, swap ? one : two);
    const btTransform &at_one = one->getWorldTransform(), &at_two = two->getWorldTransform();
    JOX_ASSERT(first != JOX_NO_OBJECT);
    jox_reserve(b->object_contacts, b->object_contact_capacity,
                count + uint32_t(manifold->getNumContacts()));
    for (int c = 0; c < manifold->getNumContacts(); c++) {
        const btManifoldPoint &p = manifold->getContactPoint(c);
        const btVector3 on_one = at_one * p.m_localPointA, on_two = at_two * p.m_localPointB;
        JoxObjectContact *contact = &b->object_contacts[count++];
        contact->first = first;
        contact->second = second;
        contact->point = jox_v3((on_one + on_two) * 0.5f);
        contact->normal = jox_v3(swap ? -p.m_normalWorldOnB : p.m_normalWorldOnB);
        contact->gap = (on_one - on_two).dot(p.m_normalWorldOnB);
        contact->friction = p.m_combinedFriction;
        contact->force = p.m_appliedImpulse * per_second;
    }
    return count;
}

/* Of the rim upon which a cylinder stands, Bullet knows the side where it rocks at the moment; in
   truth the whole rim keeps it from tipping, as far as its gap to the ground leaves it. Adds points
   of the rim near the ground, which bore nothing so far, to the contacts. */
static uint32_t add_rim(JoxBodies *b, const btPersistentManifold *manifold, uint32_t count) {
    static const float near = 0.05f; /* m; what is farther away hardly meets it within a step */
    static const float h = 0.70710678f;
    static const float around[][2] = {{1, 0},  {h, h},   {0, 1},  {-h, h},
                                      {-1, 0}, {-h, -h}, {0, -1}, {h, -h}};
    const bool swap = manifold->getBody0() == b->ground;
    const btCollisionObject *body = swap ? manifold->getBody1() : manifold->getBody0();
    const btCollisionObject *other = swap ? manifold->getBody0() : manifold->getBody1();
    const btCollisionShape *shape = body->getCollisionShape();
    if (other != b->ground || shape->getShapeType() != CYLINDER_SHAPE_PROXYTYPE ||
        manifold->getNumContacts() == 0)
        return count;
    const btVector3 half = static_cast<const btCylinderShape *>(shape)->getHalfExtentsWithMargin();
    const btTransform at = body->getWorldTransform();
    const float end = at.getBasis()[2][2] > 0 ? -half.z() : half.z();
    for (const float *way : around) {
        const btVector3 point = at * btVector3(way[0] * half.x(), way[1] * half.x(), end);
        if (point.z() > near)
            continue;
        JoxObjectContact contact = JoxObjectContact();
        contact.first = moving_row(b, body);
        contact.second = JOX_NO_OBJECT;
        contact.point = jox_v3(point);
        contact.normal = jox_v3(btVector3(0, 0, 1));
        contact.gap = point.z();
        contact.friction = manifold->getContactPoint(0).m_combinedFriction;
        jox_reserve(b->object_contacts, b->object_contact_capacity, count + 1);
        b->object_contacts[count++] = contact;
    }
    return count;
}

JoxObjectContacts jox_bodies_list_contacts(void *bodies) {
    JoxBodies *b = static_cast<JoxBodies *>(bodies);
    const float substeps = ceilf(b->last_dt * 60.0f - 1e-4f);
    const float per_second = b->last_dt > 0 ? substeps / b->last_dt : 0;
    uint32_t count = 0;
    for (int m = 0; b->world && m < b->dispatcher->getNumManifolds(); m++) {
        const btPersistentManifold *manifold = b->dispatcher->getManifoldByIndexInternal(m);
        if (manifold->getNumContacts() == 0 ||
            (moving_row(b, manifold->getBody0()) == JOX_NO_OBJECT &&
             moving_row(b, manifold->getBody1()) == JOX_NO_OBJECT))
            continue;
        count = add_seen(b, manifold, per_second, count);
        count = add_rim(b, manifold, count);
    }
    return {b->object_contacts, count};
}
