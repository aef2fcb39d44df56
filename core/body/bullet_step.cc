/* Advances the bodies by a step in substeps, sweeps fast bodies against people, and writes the
   objects that agents see. */
#include <cstring>

#include "body/bullet.h"

bool jox_row_is_fast(const JoxRow *r, float dt) {
    const float way2 = r->body->getLinearVelocity().length2() * dt * dt;
    return way2 > 0.0099f && !r->held && r->shape.mass > 0 && r->shape.bound <= 0.75f &&
           r->body->getLinearVelocity().length() * dt > 0.1f;
}

bool jox_bodies_any_fast(const JoxBodies *b, float dt) {
    for (uint32_t k = 0; k < b->live; k++) {
        const JoxRow *r = &b->rows[b->order[k]];
        if (r->swept || jox_row_is_fast(r, dt))
            return true;
    }
    return false;
}

static uint32_t compute_substep_count(const JoxBodies *b, float dt) {
    float need = ceilf(dt * 60.0f - 1e-4f);
    for (uint32_t k = 0; k < b->live; k++) {
        const JoxRow *r = &b->rows[b->order[k]];
        if (!jox_row_is_fast(r, dt))
            continue;
        float n = ceilf(r->body->getLinearVelocity().length() * dt / r->shape.inner);
        const float most = ceilf(dt * 480.0f - 1e-4f);
        n = n < most ? n : most;
        need = n > need ? n : need;
    }
    return need < 1 ? 1 : uint32_t(need);
}

static void apply_person_hit(JoxBodies *b, uint32_t row, JoxDisc *discs, const JoxSweep *sweep,
                             const JoxSweepHit *hit) {
    JoxRow *r = &b->rows[row];
    JoxDisc *d = &discs[hit->disc];
    btVector3 n = jox_bt(hit->normal), arm = n * -sweep->radius;
    float inverse[9];
    for (int i = 0; i < 9; i++)
        inverse[i] = r->body->getInvInertiaTensorWorld()[i / 3][i % 3];
    float e = float(r->body->getRestitution() * b->def.person_hardness);
    float j = jox_sweep_impulse(jox_v3(r->body->getLinearVelocity()),
                                jox_v3(r->body->getAngularVelocity()), 1.0f / r->shape.mass,
                                inverse, jox_v3(arm), hit->normal, d, e);
    if (!(j > 0))
        return;
    btTransform at = r->body->getWorldTransform();
    at.setOrigin(at.getOrigin() + r->body->getLinearVelocity() * hit->time);
    r->body->setWorldTransform(at);
    r->body->setInterpolationWorldTransform(at);
    btVector3 before = r->body->getLinearVelocity();
    float was_x = d->vx, was_y = d->vy;
    r->body->applyImpulse(n * j, arm);
    jox_row_count_impulse(r, n * j, arm);
    if (r->bonds)
        jox_row_add_impulse(r, at.getOrigin() + arm, n * j);
    d->vx -= j * n.x() / d->mass;
    d->vy -= j * n.y() / d->mass;
    btVector3 change = r->body->getLinearVelocity() - before;
    b->hit_impulse += j;
    const double residual =
        hypot(double(r->shape.mass) * change.x() + double(d->mass) * (d->vx - was_x),
              double(r->shape.mass) * change.y() + double(d->mass) * (d->vy - was_y));
    JOX_ASSERT(!(residual > 1e-5 * (j + r->shape.mass * before.length() +
                                    d->mass * jox_length(jox_v2(was_x, was_y)))));
    b->hit_residual += residual;
    b->hit_body_change += hypot(double(change.x()), double(change.y()));
    b->hit_person_change += hypot(double(d->vx - was_x), double(d->vy - was_y));
    jox_reserve(b->hits, b->hit_capacity, b->hit_count + 1);
    b->hits[b->hit_count++] =
        JoxDiscHit{hit->disc, row, jox_v3(at.getOrigin() + arm), JoxV2{-j * n.x(), -j * n.y()}};
}

static void sweep_fast_bodies(JoxBodies *b, JoxDisc *discs, float begin, float span, float dt) {
    for (uint32_t k = 0; k < b->live; k++) {
        JoxRow *r = &b->rows[b->order[k]];
        if (!r->swept && !jox_row_is_fast(r, dt))
            continue;
        float radius = r->shape.parts[0].kind == JOX_SHAPE_SPHERE && r->shape.part_count == 1
                           ? r->shape.parts[0].radius
                           : 0.5f * (r->shape.inner + r->shape.bound);
        JoxSweep sweep = {jox_v3(r->body->getWorldTransform().getOrigin()),
                          jox_v3(r->body->getLinearVelocity()),
                          radius,
                          begin,
                          span,
                          dt,
                          float(b->def.person_height),
                          b->order[k]};
        JoxSweepHit hit;
        if (jox_sweep(&b->grid, discs, &sweep, &hit))
            apply_person_hit(b, b->order[k], discs, &sweep, &hit);
    }
}

static void mark_grounded(JoxBodies *b) {
    const int count = b->dispatcher->getNumManifolds();
    for (int m = 0; m < count; m++) {
        const btPersistentManifold *manifold = b->dispatcher->getManifoldByIndexInternal(m);
        const btCollisionObject *one = manifold->getBody0(), *two = manifold->getBody1();
        if (one->isStaticOrKinematicObject() == two->isStaticOrKinematicObject())
            continue;
        const btCollisionObject *mover = one->isStaticOrKinematicObject() ? two : one;
        const int row = mover->getUserIndex();
        if (row < 0 || b->rows[row].grounded)
            continue;
        JOX_ASSERT(b->rows[row].body == mover);
        float sign = mover == one ? 1.0f : -1.0f;
        for (int c = 0; c < manifold->getNumContacts(); c++) {
            const btManifoldPoint &p = manifold->getContactPoint(c);
            if (p.getDistance() < 0.01f && sign * p.m_normalWorldOnB.z() > 0.5f)
                b->rows[row].grounded = true;
        }
    }
}

/* Applies the pending forces, and one of n equal shares of the lasting impulses; `last` clears
   both. */
static void apply_pending_forces(JoxBodies *b, uint32_t n, bool last) {
    for (uint32_t k = 0; k < b->live; k++) {
        JoxRow *r = &b->rows[b->order[k]];
        if (jox_bt(r->lasting).length2() > 0) {
            r->body->applyCentralImpulse(jox_bt(r->lasting) / float(n));
            r->body->applyTorqueImpulse(jox_bt(r->lasting_turn) / float(n));
        }
        if (last)
            r->lasting = r->lasting_turn = JoxV3{0, 0, 0};
        if (jox_bt(r->force).length2() > 0) {
            r->body->activate(true);
            r->body->applyCentralForce(jox_bt(r->force));
        }
        r->pushed = r->force;
        if (last)
            r->force = JoxV3{0, 0, 0};
    }
}

void jox_bodies_set_timed(JoxBodies *b, bool timed) {
    b->timed = timed;
}

JoxBodiesReport jox_bodies_step(JoxBodies *b, float dt, JoxDisc *discs, uint32_t disc_count) {
    JoxBodiesReport report = {};
    b->hit_count = b->gone_count = b->break_count = 0;
    b->hit_impulse = b->hit_residual = b->hit_body_change = b->hit_person_change = 0;
    b->restored = false;
    if (!b->world || !b->live || !(dt > 0 && dt <= 1))
        return report;
    b->last_dt = dt;
    bool people = discs && disc_count && jox_bodies_any_fast(b, dt);
    if (people)
        jox_disc_grid_build(&b->grid, discs, disc_count);
    bool driven = false;
    for (uint32_t k = 0; k < b->live; k++) {
        JoxRow *r = &b->rows[b->order[k]];
        if (r->body->isActive())
            r->grounded = false;
        JOX_ASSERT(r->kinematic || !r->path.count);
        driven |= r->kinematic;
    }
    if (driven)
        jox_bodies_begin_drive(b);
    uint32_t n = compute_substep_count(b, dt);
    float h = dt / float(n);
    for (uint32_t s = 0; s < n; s++) {
        jox_bodies_store_poses(b);
        if (driven)
            jox_bodies_drive(b, h);
        if (people)
            sweep_fast_bodies(b, discs, h * float(s), h, dt);
        apply_pending_forces(b, n, s + 1 == n);
        const double begun = b->timed ? jox_clock_wall() : 0;
        b->world->stepSimulation(h, 0);
        report.bullet_s += b->timed ? jox_clock_wall() - begun : 0;
        if (b->bonded)
            jox_bodies_gather_contacts(b);
        jox_bodies_handle_lost(b);
        mark_grounded(b);
    }
    if (driven)
        jox_bodies_end_drive(b);
    jox_bodies_keep_carried(b);
    if (b->bonded)
        jox_bodies_break(b, dt);
    JOX_CHECK(jox_bodies_check(b));
    JOX_CHECK(jox_bodies_report_check(b, disc_count));
    report.hits = b->hits;
    report.hit_count = b->hit_count;
    report.gone = b->gone;
    report.gone_count = b->gone_count;
    report.breaks = b->breaks;
    report.break_count = b->break_count;
    report.hit_impulse = b->hit_impulse;
    report.hit_residual = b->hit_residual;
    report.hit_body_change = b->hit_body_change;
    report.hit_person_change = b->hit_person_change;
    report.substeps = n;
    return report;
}

/* Writes the footprint of a body that is one sphere: a circle, without a ring of corners. */
static void write_sphere(const JoxRow *r, JoxObject *o) {
    const JoxConvexPart *sphere = &r->shape.parts[0];
    btVector3 centre = r->body->getWorldTransform() * sphere->frame.getOrigin();
    float away = jox_length(jox_v2(centre.x() - o->position.x, centre.y() - o->position.y));
    o->disc = away + sphere->radius;
    o->below = o->position.z - (centre.z() - sphere->radius);
    o->above = centre.z() + sphere->radius - o->position.z;
    o->low = jox_maxf(centre.z() - sphere->radius, JOX_BAND_LOW);
    o->high = jox_minf(centre.z() + sphere->radius, JOX_BAND_HIGH);
    o->round = jox_footprint_sphere(o->position.z, sphere->radius);
    o->in_band = o->high > o->low && o->round > 0.0f;
}

/* Adds a part's corners to the footprint, and updates the squared reach from the body's centre in
   the plane, m2. */
static void add_part_corners(JoxBodies *b, const JoxConvexPart *part, const btTransform &at,
                             JoxV3 centre, float *reach2) {
    jox_reserve(b->corners, b->corner_capacity, part->corner_count);
    for (uint32_t i = 0; i < part->corner_count; i++) {
        b->corners[i] = jox_v3(at * jox_bt(part->corners[i]));
        JoxV2 away = jox_v2(b->corners[i].x - centre.x, b->corners[i].y - centre.y);
        *reach2 = jox_maxf(*reach2, jox_length2(away));
    }
    jox_footprint_add(&b->footprint, b->corners, part->corner_count, part->edges, part->edge_count);
}

static void write_footprint(JoxBodies *b, const JoxRow *r, JoxObject *o) {
    const btTransform &at = r->body->getWorldTransform();
    const JoxConvexPart *first = &r->shape.parts[0];
    float reach2 = 0;
    jox_footprint_begin(&b->footprint);
    for (uint32_t p = 0; p < r->shape.part_count; p++) {
        const JoxConvexPart *part = &r->shape.parts[p];
        if (part->kind != JOX_SHAPE_SPHERE) {
            add_part_corners(b, part, at, o->position, &reach2);
            continue;
        }
        btVector3 c = at * part->frame.getOrigin();
        float away = jox_length(jox_v2(c.x() - o->position.x, c.y() - o->position.y));
        reach2 = jox_maxf(reach2, (away + part->radius) * (away + part->radius));
        jox_footprint_add_sphere(&b->footprint, jox_v3(c), part->radius);
    }
    o->disc = sqrtf(reach2);
    o->below = o->position.z - b->footprint.low;
    o->above = b->footprint.high - o->position.z;
    jox_footprint_end(&b->footprint, o);
    o->round = o->disc;
    if (r->shape.part_count == 1 && first->kind == JOX_SHAPE_CYLINDER &&
        fabsf((at.getBasis() * first->frame.getBasis())[2][2]) > 0.9999f) { /* upright */
        o->footprint_count = 0;
        o->round = first->radius;
    }
}

/* Whether a body has exactly the pose at which its object was last written; stores the present
   pose. This saves work in scenes full of sleeping bodies. */
static bool is_pose_unchanged(JoxRow *r) {
    const btTransform &at = r->body->getWorldTransform();
    float now[12];
    for (int i = 0; i < 3; i++) {
        now[i] = at.getOrigin()[i];
        for (int k = 0; k < 3; k++)
            now[3 + 3 * i + k] = at.getBasis()[i][k];
    }
    bool same = r->shown && memcmp(now, r->shown_at, sizeof now) == 0;
    memcpy(r->shown_at, now, sizeof now);
    r->shown = true;
    return same;
}

/* Writes the members of an object that depend on the body's pose. */
static void write_object_pose(JoxBodies *b, const JoxRow *r, JoxObject *o) {
    *o = JoxObject();
    o->id = r->id;
    o->live = true;
    o->moves = r->shape.mass > 0;
    o->kinematic = r->kinematic;
    o->position = jox_v3(r->body->getWorldTransform().getOrigin());
    const btQuaternion turn = r->body->getWorldTransform().getRotation();
    for (int i = 0; i < 4; i++)
        o->turn[i] = turn[i];
    o->inverse_mass = r->body->getInvMass();
    for (int i = 0; i < 9; i++)
        o->inverse_inertia[i] = r->body->getInvInertiaTensorWorld()[i / 3][i % 3];
    o->restitution = r->body->getRestitution();
    o->friction = r->body->getFriction();
    if (r->shape.part_count == 1 && r->shape.parts[0].kind == JOX_SHAPE_SPHERE)
        write_sphere(r, o);
    else
        write_footprint(b, r, o);
}

static void write_object(JoxBodies *b, JoxRow *r, JoxObject *o) {
    if (!is_pose_unchanged(r)) {
        write_object_pose(b, r, o);
        r->shown_in_band = o->in_band;
    }
    o->grounded = r->grounded;
    r->swept = jox_row_is_fast(r, b->last_dt);
    o->swept = r->swept;
    o->tags = r->tags;
    o->name = r->name ? r->name : "";
    const btVector3 &velocity = r->body->getLinearVelocity(), &spin = r->body->getAngularVelocity();
    const float share = 1.0f - r->held_up;
    o->velocity = jox_v3(share * velocity);
    o->spin = jox_v3(share * spin);
    o->drive = jox_v3(velocity);
    o->drive_spin = jox_v3(spin);
    o->force_limit = r->force_limit;
    o->held = r->held;
    o->holder = r->holder;
    o->in_band = r->shown_in_band && !r->held; /* a carried body does not push its carrier */
}

void jox_bodies_objects(JoxBodies *b, JoxObjects *objects) {
    jox_reserve(b->objects, b->object_capacity, b->count);
    for (uint32_t i = 0; i < b->count; i++) {
        if (b->rows[i].live)
            write_object(b, &b->rows[i], &b->objects[i]);
        else
            b->objects[i] = JoxObject();
    }
    objects->rows = b->objects;
    objects->count = b->count;
    objects->capacity = b->object_capacity;
    objects->list_contacts = jox_bodies_list_contacts;
    objects->next_part = jox_bodies_next_part;
    objects->bodies = b;
    objects->gravity = float(b->def.gravity);
}
