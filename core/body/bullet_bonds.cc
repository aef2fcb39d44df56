/* Bodies of bonded blocks, which are one compound in Bullet while intact: gathers the loads of
   their bonds from Bullet's contacts, and splits broken bodies into pieces. */
#include "body/bullet.h"

namespace {

struct Triple {
    double at[3];
};

Triple make_triple(const btVector3 &v) {
    return Triple{{v.x(), v.y(), v.z()}};
}

const float TOUCHING = 0.005f; /* m: contact points with a smaller gap count as touching */

} // namespace

/* ---- contacts ---- */

/* Appends the contacts of a manifold on a bonded body `own` as a run; `sign` is 1 if it is the
   manifold's first body, else -1. */
static void add_contact_loads(JoxBodies *b, const btPersistentManifold *manifold,
                              const btCollisionObject *own, const btCollisionObject *other,
                              float sign) {
    int row = own->getUserIndex();
    if (row < 0 || !b->rows[row].bonds || b->rows[row].held || !own->isActive())
        return;
    JoxContactRun run = {uint64_t(row) << 32 | uint32_t(other->getUserIndex()),
                         b->contact_load_count, 0};
    for (int c = 0; c < manifold->getNumContacts(); c++) {
        const btManifoldPoint &p = manifold->getContactPoint(c);
        if (p.getDistance() > TOUCHING && !(p.m_appliedImpulse > 0))
            continue;
        btVector3 impulse = p.m_normalWorldOnB * p.m_appliedImpulse +
                            p.m_lateralFrictionDir1 * p.m_appliedImpulseLateral1 +
                            p.m_lateralFrictionDir2 * p.m_appliedImpulseLateral2;
        if (!jox_finite(impulse))
            continue;
        int child =
            sign > 0 ? p.m_index0 : p.m_index1; /* child shapes are in the order of blocks */
        uint32_t block = child >= 0 && uint32_t(child) < b->rows[row].bonds->count ? child : 0;
        jox_reserve(b->contact_loads, b->contact_load_capacity, b->contact_load_count + 1);
        b->contact_loads[b->contact_load_count] =
            JoxContactLoad{block, sign > 0 ? p.getPositionWorldOnA() : p.getPositionWorldOnB(),
                           impulse * sign, p.m_normalWorldOnB * sign};
        b->contact_load_count++;
    }
    run.count = b->contact_load_count - run.first;
    if (run.count == 0)
        return;
    jox_reserve(b->contact_runs, b->contact_run_capacity, b->contact_run_count + 1);
    b->contact_runs[b->contact_run_count++] = run;
}

static int compare_run_keys(const void *a, const void *b, const void *) {
    const JoxContactRun *x = static_cast<const JoxContactRun *>(a);
    const JoxContactRun *y = static_cast<const JoxContactRun *>(b);
    return (x->key > y->key) - (x->key < y->key);
}

/* Lists the contact loads of all bonded bodies, sorted so that the runs of one body with one
   other body are adjacent. */
static void list_contact_loads(JoxBodies *b) {
    b->contact_load_count = b->contact_run_count = 0;
    for (int m = 0; m < b->dispatcher->getNumManifolds(); m++) {
        const btPersistentManifold *manifold = b->dispatcher->getManifoldByIndexInternal(m);
        const btCollisionObject *one = manifold->getBody0(), *two = manifold->getBody1();
        add_contact_loads(b, manifold, one, two, 1);
        add_contact_loads(b, manifold, two, one, -1);
    }
    const uint32_t count = b->contact_run_count;
    jox_reserve(b->contact_runs, b->contact_run_capacity, count + uint32_t(JOX_SORT_SPARE(count)));
    jox_sort(b->contact_runs, count, sizeof *b->contact_runs, compare_run_keys, nullptr,
             b->contact_runs + count);
    JOX_CHECK(jox_contact_loads_check(b));
}

/* Appends the contacts of a run, in the body's own frame, at index `count`, and adds up their
   normals. Returns the new count. */
static uint32_t append_run(JoxBodies *b, const JoxContactRun *run, const btTransform &frame,
                           uint32_t count, btVector3 *normal) {
    for (uint32_t k = run->first; k < run->first + run->count; k++) {
        const JoxContactLoad *load = &b->contact_loads[k];
        Triple at = make_triple(frame.invXform(load->point));
        Triple p = make_triple(load->impulse * frame.getBasis());
        JoxBondContact *to = &b->contacts[count++];
        to->block = load->block;
        for (int i = 0; i < 3; i++) {
            to->point[i] = at.at[i];
            to->impulse[i] = p.at[i];
        }
        *normal += load->normal;
    }
    return count;
}

void jox_bodies_gather_contacts(JoxBodies *b) {
    list_contact_loads(b);
    jox_reserve(b->contacts, b->contact_capacity, b->contact_load_count);
    btTransform frame;
    for (uint32_t k = 0; k < b->contact_run_count;) {
        const uint64_t key = b->contact_runs[k].key;
        JoxRow *r = &b->rows[key >> 32];
        if (k == 0 || key >> 32 != b->contact_runs[k - 1].key >> 32)
            frame = jox_row_frame(r);
        btVector3 normal(0, 0, 0);
        uint32_t count = 0;
        for (; k < b->contact_run_count && b->contact_runs[k].key == key; k++)
            count = append_run(b, &b->contact_runs[k], frame, count, &normal);
        normal = normal.length2() > 1e-12f ? normal.normalized() : btVector3(0, 0, 0);
        Triple n = make_triple(normal * frame.getBasis());
        jox_bonds_add_contacts(r->bonds, b->contacts, count, n.at);
    }
}

/* ---- breaking ---- */

/* Gives a row its bond graph, or frees the graph if no bonds are left. */
static void attach_bonds(JoxBodies *b, uint32_t row, JoxBondGraph *bonds) {
    if (bonds->bond_count == 0) {
        jox_bonds_free(bonds);
        return;
    }
    b->rows[row].bonds = bonds;
    b->bonded++;
}

/* Motion of a whole body. Each piece keeps its spin, and moves as its own centre of mass did in
   the whole: so the pieces have the momentum and spin of the whole. */
struct Motion {
    btTransform frame;
    btVector3 centre, velocity, spin;
};

static void set_piece_motion(btRigidBody *body, const Motion &whole) {
    btVector3 away = body->getWorldTransform().getOrigin() - whole.centre;
    body->setLinearVelocity(whole.velocity + whole.spin.cross(away));
    body->setAngularVelocity(whole.spin);
    body->activate(true);
}

static uint32_t find_largest_piece(const JoxBondGraph *bonds, uint32_t pieces) {
    uint32_t best = 0, most = 0;
    for (uint32_t label = 0; label < pieces; label++) {
        uint32_t blocks = 0;
        for (uint32_t n = 0; n < bonds->count; n++)
            blocks += bonds->label[n] == label;
        if (blocks > most) {
            most = blocks;
            best = label;
        }
    }
    return best;
}

static void split_into_pieces(JoxBodies *b, uint32_t row, uint32_t pieces) {
    JoxRow *r = &b->rows[row];
    JoxBondGraph *bonds = r->bonds;
    const Motion whole = {jox_row_frame(r), r->body->getWorldTransform().getOrigin(),
                          r->body->getLinearVelocity(), r->body->getAngularVelocity()};
    const JoxMaterial material = r->material;
    const uint64_t tags = r->tags;
    uint32_t keeps = find_largest_piece(bonds, pieces);
    const float mass = r->shape.mass;
    btVector3 momentum(0, 0, 0);
    uint32_t blocks = 0;
    float sum = 0;
    b->world->remove(r->body);
    delete r->body;
    jox_body_shape_free(&r->shape);
    r->bonds = nullptr;
    b->bonded--;
    for (uint32_t label = 0; label < pieces; label++) {
        Triple centre;
        JoxBodyShape shape;
        JoxBondGraph *part = jox_bonds_extract(bonds, label, label != keeps, centre.at);
        /* Cannot fail: the shape of the whole, with the same blocks, was valid. */
        jox_body_shape_of_blocks(part, false, &shape, nullptr);
        uint32_t at = row;
        if (label == keeps) {
            b->rows[row].shape = shape;
            jox_row_create_body(b, row, whole.frame, material);
        } else {
            btTransform shift(
                btQuaternion::getIdentity(),
                btVector3(float(centre.at[0]), float(centre.at[1]), float(centre.at[2])));
            at = jox_row_add(b, &shape, whole.frame * shift, material, false);
            b->rows[at].tags = tags;
        }
        set_piece_motion(b->rows[at].body, whole);
        momentum += b->rows[at].body->getLinearVelocity() * shape.mass;
        sum += shape.mass;
        blocks += part->count;
        attach_bonds(b, at, part);
    }
    JOX_ASSERT(blocks == bonds->count && std::fabs(sum - mass) <= 1e-4f * mass);
    JOX_ASSERT((momentum - whole.velocity * mass).length() <=
               1e-4f * mass * (1 + whole.velocity.length() + whole.spin.length()));
    jox_bonds_free(bonds);
}

void jox_bodies_break(JoxBodies *b, float dt) {
    uint32_t bodies = b->live; /* new pieces are appended after these */
    for (uint32_t k = 0; k < bodies; k++) {
        uint32_t row = b->order[k];
        JoxRow *r = &b->rows[row];
        if (!r->bonds || r->held || !r->body->isActive())
            continue;
        Triple spin = make_triple(r->body->getAngularVelocity() * jox_row_frame(r).getBasis());
        uint32_t cut = jox_bonds_step(r->bonds, dt, spin.at);
        if (cut == 0)
            continue;
        uint32_t pieces = jox_bonds_label_pieces(r->bonds);
        jox_reserve(b->breaks, b->break_capacity, b->break_count + 1);
        b->breaks[b->break_count++] = JoxBodyBreak{row, r->id, cut, pieces};
        if (pieces > 1)
            split_into_pieces(b, row, pieces);
    }
}

bool jox_bodies_bonds(const JoxBodies *b, uint32_t row, JoxBodyBonds *bonds) {
    *bonds = JoxBodyBonds();
    if (row >= b->count || !b->rows[row].live || !b->rows[row].bonds)
        return false;
    const JoxBondGraph *g = b->rows[row].bonds;
    *bonds = JoxBodyBonds{g->count, g->bond_count};
    return true;
}
