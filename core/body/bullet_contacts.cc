/* Contacts across a re-insertion, and contacts as agents see them. Bullet gathers the contact
   points of two bodies over several steps, and its solver starts from their last impulses. Both
   are noted before all bodies are taken out and copied into the contacts that are found anew:
   standing bodies need not settle again. */
#include "body/bullet.h"

#include "base/sort.h"

/* Returns the id of a body, or the negative user index of the ground or a wall. */
static int32_t find_contact_id(const JoxBodies *b, const btCollisionObject *object) {
    const int index = object->getUserIndex();
    JOX_ASSERT(index < 0 ? index >= -1 - int(b->wall_count) : b->rows[index].body == object);
    return index < 0 ? index : int32_t(b->rows[index].id);
}

static float *copy_vector(float *to, const btVector3 &v) {
    for (int i = 0; i < 3; i++)
        *to++ = v[i];
    return to;
}

static btVector3 vector_from_floats(const float *v) {
    return btVector3(v[0], v[1], v[2]);
}

/* Makes a record of a manifold's point; the body with the lower id comes first. */
static JoxContactRecord make_contact_record(const JoxBodies *b,
                                            const btPersistentManifold *manifold,
                                            const btManifoldPoint &p) {
    const int32_t one = find_contact_id(b, manifold->getBody0()),
                  two = find_contact_id(b, manifold->getBody1());
    const bool swap = two < one;
    JoxContactRecord record = JoxContactRecord();
    record.ids[0] = swap ? two : one;
    record.ids[1] = swap ? one : two;
    record.ids[2] = swap ? p.m_index1 : p.m_index0;
    record.ids[3] = swap ? p.m_index0 : p.m_index1;
    copy_vector(record.points[0], swap ? p.m_localPointB : p.m_localPointA);
    copy_vector(record.points[1], swap ? p.m_localPointA : p.m_localPointB);
    copy_vector(record.normal, swap ? -p.m_normalWorldOnB : p.m_normalWorldOnB);
    record.impulse[0] = p.m_appliedImpulse;
    record.impulse[1] = p.m_appliedImpulseLateral1;
    record.impulse[2] = p.m_appliedImpulseLateral2;
    return record;
}

static int compare_contact_ids(const void *a, const void *b, const void *context) {
    (void)context;
    const JoxContactRecord *one = static_cast<const JoxContactRecord *>(a);
    const JoxContactRecord *two = static_cast<const JoxContactRecord *>(b);
    for (int k = 0; k < 4; k++)
        if (one->ids[k] != two->ids[k])
            return one->ids[k] < two->ids[k] ? -1 : 1;
    return 0;
}

uint32_t jox_bodies_note_contacts(const JoxBodies *b, JoxContactRecord *&contacts,
                                  uint32_t &capacity) {
    uint32_t count = 0;
    for (int m = 0; b->world && m < b->dispatcher->getNumManifolds(); m++) {
        const btPersistentManifold *manifold = b->dispatcher->getManifoldByIndexInternal(m);
        for (int c = 0; c < manifold->getNumContacts(); c++) {
            jox_reserve(contacts, capacity, count + 1);
            contacts[count++] = make_contact_record(b, manifold, manifold->getContactPoint(c));
        }
    }
    jox_sort(contacts, count, sizeof *contacts, compare_contact_ids, nullptr, nullptr);
    return count;
}

/* Returns the index of the first of `count` sorted records that is not before `record`. */
static uint32_t find_first_record(const JoxContactRecord *contacts, uint32_t count,
                                  const JoxContactRecord *record) {
    uint32_t low = 0, high = count;
    while (low < high) {
        const uint32_t middle = (low + high) / 2;
        if (compare_contact_ids(&contacts[middle], record, nullptr) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Replaces the points of a manifold by the noted points between the same parts; values that
   follow from both bodies, such as friction, are copied from a point that Bullet found. */
static void restore_manifold(const JoxBodies *b, btPersistentManifold *manifold,
                             const JoxContactRecord *contacts, uint32_t count) {
    const btManifoldPoint found = manifold->getContactPoint(0);
    const JoxContactRecord like = make_contact_record(b, manifold, found);
    const bool swap =
        find_contact_id(b, manifold->getBody1()) < find_contact_id(b, manifold->getBody0());
    uint32_t k = find_first_record(contacts, count, &like);
    if (k == count || compare_contact_ids(&contacts[k], &like, nullptr) != 0)
        return;
    manifold->clearManifold();
    for (; k < count && compare_contact_ids(&contacts[k], &like, nullptr) == 0 &&
           manifold->getNumContacts() < MANIFOLD_CACHE_SIZE;
         k++) {
        btManifoldPoint p = found;
        p.m_localPointA = vector_from_floats(contacts[k].points[swap]);
        p.m_localPointB = vector_from_floats(contacts[k].points[!swap]);
        p.m_normalWorldOnB =
            swap ? -vector_from_floats(contacts[k].normal) : vector_from_floats(contacts[k].normal);
        p.m_appliedImpulse = contacts[k].impulse[0];
        p.m_appliedImpulseLateral1 = contacts[k].impulse[1];
        p.m_appliedImpulseLateral2 = contacts[k].impulse[2];
        manifold->addManifoldPoint(p);
    }
    JOX_ASSERT(manifold->getNumContacts() > 0);
    manifold->refreshContactPoints(manifold->getBody0()->getWorldTransform(),
                                   manifold->getBody1()->getWorldTransform());
}

/* Makes Bullet find all contacts. It looks only at bodies that are awake, so all wake for a
   moment. */
static void detect_all_contacts(JoxBodies *b) {
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
    detect_all_contacts(b);
    for (int m = 0; m < b->dispatcher->getNumManifolds(); m++) {
        btPersistentManifold *manifold = b->dispatcher->getManifoldByIndexInternal(m);
        if (manifold->getNumContacts() > 0)
            restore_manifold(b, manifold, contacts, count);
    }
}

/* ---- contacts of bodies as agents see them ---- */

/* Returns the row of a dynamic body, or JOX_NO_OBJECT. */
static uint32_t find_dynamic_row(const JoxBodies *b, const btCollisionObject *object) {
    const int index = object->getUserIndex();
    return index >= 0 && b->rows[index].shape.mass > 0 ? uint32_t(index) : JOX_NO_OBJECT;
}

/* Returns the row of a dynamic or kinematic body, or JOX_NO_OBJECT. */
static uint32_t find_partner_row(const JoxBodies *b, const btCollisionObject *object) {
    return object->isKinematicObject() ? uint32_t(object->getUserIndex())
                                       : find_dynamic_row(b, object);
}

/* Appends the contacts of two objects, at least one of them dynamic, at index `count`; returns
   the new count. Gaps are computed from the present poses, as Bullet measured them before it
   moved the bodies. */
static uint32_t append_manifold_contacts(JoxBodies *b, const btPersistentManifold *manifold,
                                         float per_second, uint32_t count) {
    const btCollisionObject *one = manifold->getBody0(), *two = manifold->getBody1();
    const uint32_t row = find_dynamic_row(b, one);
    const bool swap = row == JOX_NO_OBJECT;
    const uint32_t first = swap ? find_dynamic_row(b, two) : row;
    const uint32_t second = find_partner_row(b, swap ? one : two);
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

/* Adds contacts along the rim on which a cylinder stands. Bullet has only those on the side to
   which it rocks at the moment, but the whole rim near the ground keeps it from tipping. The
   added points have no force so far. Returns the new count. */
static uint32_t append_rim_contacts(JoxBodies *b, const btPersistentManifold *manifold,
                                    uint32_t count) {
    static const float near =
        0.05f; /* m; points farther from the ground hardly reach it within a step */
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
        contact.first = find_dynamic_row(b, body);
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
            (find_dynamic_row(b, manifold->getBody0()) == JOX_NO_OBJECT &&
             find_dynamic_row(b, manifold->getBody1()) == JOX_NO_OBJECT))
            continue;
        count = append_manifold_contacts(b, manifold, per_second, count);
        count = append_rim_contacts(b, manifold, count);
    }
    return {b->object_contacts, count};
}
