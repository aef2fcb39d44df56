/* Bodies in Bullet's world: creates the world, adds and removes bodies, applies impulses, and
   reads poses. */
#include "body/bullet.h"

#include <new>
#include <string.h>

static const float REACH = 10000.0f;

static void release_bodies_heap(void *bodies) {
    jox_bullet_free_heap(static_cast<JoxBodies *>(bodies)->heap);
}

JoxBodies *jox_bodies_create(const JoxBodiesDef *def) {
    jox_bullet_use_memory();
    JoxBodies *b = static_cast<JoxBodies *>(jox_alloc(1, sizeof(JoxBodies)));
    b->heap = jox_heap_used();
    jox_heap_register(b, release_bodies_heap);
    b->def = *def;
    b->last_dt = 0.05f;
    return b;
}

/* Creates objects of Bullet's classes that lack its own operator new, so that they too come from
   its memory functions. */
template <typename T, typename... Arguments>
static T *create_bullet_object(Arguments... arguments) {
    return new (btAlignedAlloc(sizeof(T), 16)) T(arguments...);
}

template <typename T> static void destroy_bullet_object(T *object) {
    object->~T();
    btAlignedFree(object);
}

static void create_bullet_world(JoxBodies *b) {
    btDefaultCollisionConstructionInfo info;
    info.m_defaultMaxPersistentManifoldPoolSize = 512;
    info.m_defaultMaxCollisionAlgorithmPoolSize = 512;
    b->configuration = create_bullet_object<JoxBulletConfiguration>(info);
    b->dispatcher = create_bullet_object<btCollisionDispatcher>(b->configuration);
    b->broadphase = create_bullet_object<btDbvtBroadphase>();
    b->solver = new JoxBulletSolver();
    b->world = new JoxBulletWorld(b->dispatcher, b->broadphase, b->solver, b->configuration);
    /* With friction in one direction alone, bodies under pressure creep. */
    b->world->getSolverInfo().m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
    /* Overlap of touching bodies, m: with faces that just meet, Bullet finds now their edges,
       now the faces in contact, and boxes pressed together rock. */
    b->world->getSolverInfo().m_linearSlop = 0.002f;
    /* Solve each group of touching bodies until a pass changes no velocity by more than 1 um/s;
       groups are solved apart, so that a converged one does not wait for the others. */
    b->world->getSolverInfo().m_leastSquaresResidualThreshold = 1e-12f;
    b->world->getSolverInfo().m_minimumSolverBatchSize = 1;
    b->world->setForceUpdateAllAabbs(false); /* sleeping bodies do not move */
    b->world->setGravity(btVector3(0, 0, float(-b->def.gravity)));
    if (!b->def.ground)
        return;
    b->ground_shape = new btStaticPlaneShape(btVector3(0, 0, 1), 0);
    b->ground = jox_static_make(b->ground_shape, btTransform::getIdentity(), -1);
    b->world->addRigidBody(b->ground);
}

void jox_bodies_ensure(JoxBodies *b) {
    if (!b->world)
        create_bullet_world(b);
    if (!b->walls_raised)
        jox_bodies_raise_walls(b);
}

void jox_bodies_set_sheets(JoxBodies *b, float origin, float pitch) {
    b->origin = origin;
    b->pitch = pitch;
}

void jox_bodies_set_walls(JoxBodies *b, const JoxWalls *walls, float height) {
    if (!(height > 0))
        return;
    jox_bodies_drop_walls(b);
    jox_walls_standing(&b->standing, walls, true);
    b->wall_grid.walls = &b->standing;
    b->wall_height = height;
    b->walls_raised = false;
    for (uint32_t k = 0; k < b->live; k++) /* wake bodies that leant on a removed wall */
        b->rows[b->order[k]].body->activate();
    if (b->live) /* else the first body raises them: most worlds have none */
        jox_bodies_raise_walls(b);
}

/* Frees the members of a row whose body has left Bullet's world. */
static void empty_row(JoxBodies *b, JoxRow *r) {
    delete r->body;
    jox_body_shape_free(&r->shape);
    jox_free(r->name);
    jox_row_leave_path(r);
    JOX_ASSERT(!r->bonds || b->bonded > 0);
    b->bonded -= r->bonds ? 1 : 0;
    jox_bonds_free(r->bonds);
    r->bonds = nullptr;
    r->live = false;
    r->name = nullptr;
    r->body = nullptr;
}

void jox_bodies_drop_row(JoxBodies *b, uint32_t row) {
    b->world->remove(b->rows[row].body);
    empty_row(b, &b->rows[row]);
    uint32_t k = 0;
    while (b->order[k] != row) {
        k++;
        JOX_ASSERT(k < b->live);
    }
    for (b->live--; k < b->live; k++)
        b->order[k] = b->order[k + 1];
}

void jox_bodies_free(JoxBodies *b) {
    if (!b)
        return;
    jox_heap_unregister(b);
    if (b->world) {
        b->world->release_predictions();
        jox_bodies_remove_pairs(b);
        jox_bodies_drop_walls(b);
        if (b->ground)
            jox_static_drop(b, b->ground);
        JOX_ASSERT(b->dispatcher->getNumManifolds() == 0);
        delete b->ground_shape;
        delete b->world; /* takes all bodies out at once; removing one searches the whole list */
        for (uint32_t k = 0; k < b->live; k++)
            empty_row(b, &b->rows[b->order[k]]);
        delete b->solver;
        destroy_bullet_object(b->broadphase);
        destroy_bullet_object(b->dispatcher);
        destroy_bullet_object(b->configuration);
    }
    void *owned[] = {b->walls,  b->rows,           b->order,          b->objects,      b->hits,
                     b->gone,   b->corners,        b->contact_loads,  b->contact_runs, b->contacts,
                     b->breaks, b->saved_contacts, b->object_contacts};
    for (void *memory : owned)
        jox_free(memory);
    jox_walls_free(&b->standing);
    jox_disc_grid_free(&b->grid);
    jox_footprint_free(&b->footprint);
    jox_free(b);
}

static bool are_values_within(const double *values, int n, double most) {
    for (int i = 0; i < n; i++)
        if (!(fabs(values[i]) <= most))
            return false;
    return true;
}

static const char *find_definition_fault(const JoxBodyDef *d) {
    if (!are_values_within(d->position, 3, REACH))
        return "a body must lie within 10 km of the origin";
    if (!are_values_within(d->turn, 4, 1e6))
        return "a body's turn must be a finite quaternion";
    if (!are_values_within(d->velocity, 3, 500) || !are_values_within(d->spin, 3, 500))
        return "a body's velocity must be below 500 m/s and its spin below 500 rad/s";
    if (!(d->mass >= 0 && d->mass <= 1e9) || !(d->density >= 0 && d->density <= 1e6))
        return "a body's mass must lie between 0 and 1e9 kg, its density below 1e6 kg/m3";
    if (!(d->friction >= 0 && d->friction <= 10))
        return "a body's friction must lie between 0 and 10";
    double shares[3] = {d->restitution, d->damping, d->spin_damping};
    for (double share : shares)
        if (!(share >= 0 && share <= 1))
            return "a body's restitution and dampings must lie between 0 and 1";
    if (!(d->force_limit >= 0 && d->force_limit <= 1e6) ||
        (d->path.reopens && !(d->force_limit > 0)))
        return "a body presses with up to 1e6 N; one that reopens has such a limit";
    if (d->path.count && !d->kinematic)
        return "a path is for a kinematic body";
    return d->path.count ? jox_path_find_fault(&d->path) : nullptr;
}

static uint32_t find_free_row(JoxBodies *b) {
    for (uint32_t i = 0; i < b->count && b->live < b->count; i++)
        if (!b->rows[i].live)
            return i;
    jox_reserve(b->rows, b->capacity, b->count + 1);
    return b->count++;
}

static btVector3 vector_from_doubles(const double v[3]) {
    return btVector3(float(v[0]), float(v[1]), float(v[2]));
}

void jox_row_create_body(JoxBodies *b, uint32_t row, const btTransform &frame,
                         const JoxMaterial &material) {
    JoxRow *r = &b->rows[row];
    const JoxBodyShape &shape = r->shape;
    r->material = material;
    r->shown = false;
    btRigidBody::btRigidBodyConstructionInfo info(shape.mass, nullptr, shape.collision,
                                                  shape.inertia);
    info.m_startWorldTransform = frame * shape.frame;
    info.m_friction = material.friction;
    info.m_restitution = material.restitution;
    info.m_linearDamping = material.damping;
    info.m_angularDamping = material.spin_damping;
    info.m_linearSleepingThreshold = 0.1f;
    info.m_angularSleepingThreshold = 0.2f;
    r->body = new btRigidBody(info);
    r->body->setUserIndex(int(row));
    if (shape.inertia.x() == shape.inertia.y() && shape.inertia.y() == shape.inertia.z())
        r->body->setFlags(r->body->getFlags() & ~BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY);
    if (shape.mass > 0) {
        r->body->setCcdMotionThreshold(shape.inner);
        r->body->setCcdSweptSphereRadius(0.8f * shape.inner);
    }
    if (r->kinematic)
        jox_row_make_kinematic(r);
    b->world->addRigidBody(r->body);
}

uint32_t jox_row_add(JoxBodies *b, const JoxBodyShape *shape, const btTransform &frame,
                     const JoxMaterial &material, bool kinematic) {
    uint32_t at = find_free_row(b);
    b->rows[at] = JoxRow();
    b->rows[at].live = true;
    b->rows[at].id = b->next_id++;
    b->rows[at].shape = *shape;
    b->rows[at].kinematic = kinematic;
    jox_row_create_body(b, at, frame, material);
    jox_reserve(b->order, b->order_capacity, b->live + 1);
    b->order[b->live++] = at;
    JOX_ASSERT(b->live == 1 || b->rows[b->order[b->live - 2]].id < b->rows[at].id);
    return at;
}

uint32_t jox_bodies_add(JoxBodies *b, const JoxBodyDef *def, JoxText *error) {
    const char *problem = find_definition_fault(def);
    if (problem) {
        if (error)
            jox_text_add(error, problem);
        return JOX_NO_BODY;
    }
    bool still = def->still || def->kinematic ||
                 (def->shape.kind != JOX_SHAPE_COMPOUND && def->mass <= 0 && def->density <= 0);
    JoxBodyShape shape;
    JoxBondGraph *bonds = nullptr;
    if (def->shape.kind == JOX_SHAPE_BLOCKS) {
        bonds = jox_row_make_bonds(def, error);
        if (!bonds || !jox_body_shape_of_blocks(bonds, still, &shape, error)) {
            jox_bonds_free(bonds);
            return JOX_NO_BODY;
        }
    } else if (!jox_body_shape_make(def, still, &shape, error)) {
        return JOX_NO_BODY;
    }
    jox_bodies_ensure(b);
    btQuaternion turn(float(def->turn[0]), float(def->turn[1]), float(def->turn[2]),
                      float(def->turn[3]));
    turn = turn.length2() > 1e-12f ? turn.normalized() : btQuaternion::getIdentity();
    JoxMaterial material = {float(def->friction), float(def->restitution), float(def->damping),
                            float(def->spin_damping)};
    uint32_t at = jox_row_add(b, &shape, btTransform(turn, vector_from_doubles(def->position)),
                              material, def->kinematic);
    if (jox_bodies_are_heaped(b, error)) {
        jox_bodies_drop_row(b, at);
        jox_bonds_free(bonds);
        return JOX_NO_BODY;
    }
    JoxRow *r = &b->rows[at];
    r->name = def->name ? jox_strdup(def->name) : nullptr;
    r->tags = def->tags;
    if (!still || def->kinematic) {
        r->body->setLinearVelocity(vector_from_doubles(def->velocity));
        r->body->setAngularVelocity(vector_from_doubles(def->spin));
    }
    r->force_limit = def->kinematic ? float(def->force_limit) : 0;
    r->ends_run = def->kinematic && def->ends_run;
    if (def->path.count)
        jox_row_begin_path(r, def);
    if (bonds && !still && bonds->bond_count > 0) {
        r->bonds = bonds;
        b->bonded++;
    } else {
        jox_bonds_free(bonds); /* a static body or a single block cannot break */
    }
    JOX_CHECK(jox_bodies_check(b));
    return at;
}

bool jox_bodies_remove(JoxBodies *b, uint32_t row) {
    if (!jox_live_row(b, row))
        return false;
    jox_bodies_drop_row(b, row);
    for (uint32_t k = 0; k < b->live; k++) /* wake bodies that leant on it */
        b->rows[b->order[k]].body->activate();
    JOX_CHECK(jox_bodies_check(b));
    return true;
}

uint32_t jox_bodies_count(const JoxBodies *b) {
    return b->live;
}

uint32_t jox_bodies_rows(const JoxBodies *b) {
    return b->count;
}

uint32_t jox_bodies_find(const JoxBodies *b, uint32_t id) {
    for (uint32_t k = 0; k < b->live; k++)
        if (b->rows[b->order[k]].id == id)
            return b->order[k];
    return JOX_NO_BODY;
}

uint32_t jox_bodies_find_name(const JoxBodies *b, const char *name) {
    for (uint32_t k = 0; k < b->live; k++)
        if (strcmp(jox_bodies_name(b, b->order[k]), name) == 0)
            return b->order[k];
    return JOX_NO_BODY;
}

uint32_t jox_bodies_id(const JoxBodies *b, uint32_t row) {
    const JoxRow *r = jox_live_row(b, row);
    return r ? r->id : JOX_NO_BODY;
}

const char *jox_bodies_name(const JoxBodies *b, uint32_t row) {
    const JoxRow *r = jox_live_row(b, row);
    return r && r->name ? r->name : "";
}

bool jox_bodies_pose(const JoxBodies *b, uint32_t row, JoxPose *pose) {
    *pose = JoxPose();
    const JoxRow *r = jox_live_row(b, row);
    if (!r)
        return false;
    btTransform at = jox_row_frame(r);
    btQuaternion q = at.getRotation();
    pose->position = jox_v3(at.getOrigin());
    for (int i = 0; i < 4; i++)
        pose->turn[i] = q[i];
    pose->centre = jox_v3(r->body->getWorldTransform().getOrigin());
    const float share = 1.0f - r->held_up;
    pose->velocity = jox_v3(share * r->body->getLinearVelocity());
    pose->spin = jox_v3(share * r->body->getAngularVelocity());
    pose->mass = r->shape.mass;
    pose->inertia = jox_v3(r->shape.inertia);
    pose->kinematic = r->kinematic;
    return true;
}

bool jox_bodies_describe_part(const JoxBodies *b, uint32_t row, uint32_t part, JoxBodyLook *out) {
    *out = JoxBodyLook();
    const JoxRow *r = jox_live_row(b, row);
    if (!r || part >= r->shape.part_count)
        return false;
    const JoxConvexPart *p = &r->shape.parts[part];
    bool hull = p->kind == JOX_SHAPE_HULL; /* corners are in the frame of the centre of mass */
    btTransform at = hull ? r->shape.frame : r->shape.frame * p->frame;
    btQuaternion q = at.getRotation();
    out->kind = p->kind;
    out->at = jox_v3(at.getOrigin());
    for (int i = 0; i < 4; i++)
        out->turn[i] = q[i];
    const JoxV3 *c = p->corners;
    if (p->kind == JOX_SHAPE_BOX) { /* corner i: bits 0, 1, 2 choose the side along x, y, z */
        out->size[0] = jox_bt(c[0]).distance(jox_bt(c[1]));
        out->size[1] = jox_bt(c[0]).distance(jox_bt(c[2]));
        out->size[2] = jox_bt(c[0]).distance(jox_bt(c[4]));
    } else if (hull) {
        out->corners = c;
        out->corner_count = p->corner_count;
    } else {
        out->size[0] = p->radius;
        if (p->kind == JOX_SHAPE_CYLINDER) /* from the lower circle to the upper one */
            out->size[1] = jox_bt(c[0]).distance(jox_bt(c[p->corner_count / 2]));
    }
    return true;
}

bool jox_bodies_set_velocity(JoxBodies *b, uint32_t row, JoxV3 velocity, JoxV3 spin) {
    JoxRow *r = jox_live_row(b, row);
    if (!r || !(r->shape.mass > 0 || r->kinematic) || !jox_finite(jox_bt(velocity)) ||
        !jox_finite(jox_bt(spin)))
        return false;
    jox_row_leave_path(r);
    r->held_up = 0;
    r->reached_limit = r->reaches_limit = false;
    r->body->activate(true);
    r->body->setLinearVelocity(jox_bt(velocity));
    r->body->setAngularVelocity(jox_bt(spin));
    return true;
}

bool jox_bodies_force(JoxBodies *b, uint32_t row, JoxV3 force) {
    JoxRow *r = jox_live_row(b, row);
    if (!r || r->shape.mass <= 0 || !jox_finite(jox_bt(force)))
        return false;
    r->force = jox_v3(jox_bt(r->force) + jox_bt(force));
    return true;
}

void jox_row_add_impulse(JoxRow *r, const btVector3 &point, const btVector3 &impulse) {
    btTransform frame = jox_row_frame(r);
    const btVector3 own_point = frame.invXform(point), own_impulse = impulse * frame.getBasis();
    const double at[3] = {own_point.x(), own_point.y(), own_point.z()};
    const double p[3] = {own_impulse.x(), own_impulse.y(), own_impulse.z()};
    jox_bonds_add_impulse(r->bonds, at, p);
}

uint32_t jox_bodies_impulses(JoxBodies *b, const JoxImpulse *impulses, uint32_t count) {
    uint32_t odd = 0;
    for (uint32_t i = 0; i < count; i++) {
        btVector3 p = jox_bt(impulses[i].impulse), at = jox_bt(impulses[i].point);
        JoxRow *r = jox_live_row(b, impulses[i].object);
        if (r && r->kinematic && jox_finite(p) && jox_finite(at)) { /* counted, but not applied */
            jox_row_count_impulse(r, p, at - r->body->getWorldTransform().getOrigin());
            continue;
        }
        if (!r || r->shape.mass <= 0 || !jox_finite(p) || !jox_finite(at)) {
            odd++;
            continue;
        }
        float change = p.length() / r->shape.mass, most = float(b->def.most_change);
        if (!(change <= most)) {
            odd++;
            /* Normalise by the greatest component first: the square of the length might
               overflow. */
            p /= p.absolute()[p.absolute().maxAxis()];
            p *= most * r->shape.mass / p.length();
        }
        btVector3 arm = at - r->body->getWorldTransform().getOrigin();
        btVector3 lasting = p * impulses[i].lasting;
        r->body->activate(true);
        r->body->applyImpulse(p - lasting, arm);
        jox_row_count_impulse(r, p, arm);
        r->lasting = jox_v3(jox_bt(r->lasting) + lasting);
        r->lasting_turn = jox_v3(jox_bt(r->lasting_turn) + arm.cross(lasting));
        if (r->bonds)
            jox_row_add_impulse(r, at, p);
    }
    return odd;
}

void jox_bodies_momentum(const JoxBodies *b, double out[3]) {
    out[0] = out[1] = out[2] = 0;
    for (uint32_t k = 0; k < b->live; k++) {
        const JoxRow *r = &b->rows[b->order[k]];
        for (int i = 0; i < 3; i++)
            out[i] += double(r->shape.mass) * r->body->getLinearVelocity()[i] +
                      double(jox_bt(r->lasting)[i]);
    }
}

bool jox_bodies_available(void) {
    return true;
}

/* ---- impulses of people on bodies ---- */

void jox_row_count_impulse(JoxRow *r, const btVector3 &impulse, const btVector3 &arm) {
    const btVector3 turn = arm.cross(impulse);
    for (int i = 0; i < 3; i++) {
        r->impulse_sums[i] += double(impulse[i]);
        r->impulse_sums[3 + i] += double(turn[i]);
    }
}

bool jox_bodies_impulse_sum(const JoxBodies *b, uint32_t row, double impulse[3], double turn[3]) {
    const JoxRow *r = jox_live_row(b, row);
    for (int i = 0; i < 3; i++) {
        impulse[i] = r ? r->impulse_sums[i] : 0;
        turn[i] = r ? r->impulse_sums[3 + i] : 0;
    }
    return r != nullptr;
}

void jox_bodies_reset_impulse_sums(JoxBodies *b) {
    for (uint32_t k = 0; k < b->live; k++)
        memset(b->rows[b->order[k]].impulse_sums, 0, sizeof b->rows[0].impulse_sums);
}
