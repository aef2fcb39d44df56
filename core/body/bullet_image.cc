/* Re-insertion of all bodies into Bullet's world at fixed steps, capture of their state into an
   image, and rebuilding from one. */
#include "body/bullet.h"

#include <string.h>

/* ---- re-insertion ---- */

void jox_bodies_reinsert(JoxBodies *b) {
    if (!b->world)
        return;
    if (!b->restored)
        b->saved_contact_count =
            jox_bodies_note_contacts(b, b->saved_contacts, b->saved_contact_capacity);
    jox_bodies_remove_pairs(b);
    for (uint32_t k = b->live; k > 0; k--)
        b->world->removeRigidBody(b->rows[b->order[k - 1]].body);
    for (uint32_t n = b->wall_count; n > 0; n--)
        b->world->removeRigidBody(b->walls[n - 1]);
    if (b->ground)
        b->world->removeRigidBody(b->ground);
    JOX_ASSERT(b->world->getNumCollisionObjects() == 0);
    JOX_ASSERT(b->dispatcher->getNumManifolds() == 0);
    b->broadphase->resetPool(b->dispatcher);
    b->solver->reset();
    if (b->ground)
        b->world->addRigidBody(b->ground);
    for (uint32_t n = 0; n < b->wall_count; n++)
        b->world->addRigidBody(b->walls[n]);
    for (uint32_t k = 0; k < b->live; k++)
        b->world->addRigidBody(b->rows[b->order[k]].body);
    jox_bodies_renew_contacts(b, b->saved_contacts, b->saved_contact_count);
    JOX_CHECK(jox_bodies_check(b));
}

/* ---- capture ---- */

static float *capture_vector(float *to, const btVector3 &v) {
    for (int i = 0; i < 3; i++)
        *to++ = v[i];
    return to;
}

static float *capture_transform(float *to, const btTransform &t) {
    for (int i = 0; i < 3; i++)
        to = capture_vector(to, t.getBasis()[i]);
    return capture_vector(to, t.getOrigin());
}

static void capture_motion(JoxBodyRecord *record, const btRigidBody *body) {
    float *to = capture_transform(record->motion, body->getWorldTransform());
    to = capture_transform(to, body->getInterpolationWorldTransform());
    to = capture_vector(to, body->getLinearVelocity());
    to = capture_vector(to, body->getAngularVelocity());
    to = capture_vector(to, body->getInterpolationLinearVelocity());
    capture_vector(to, body->getInterpolationAngularVelocity());
    record->activation = uint32_t(body->getActivationState());
    record->deactivation_time = body->getDeactivationTime();
}

static void capture_shape(JoxBodiesImage *image, JoxBodyRecord *record, const JoxBodyShape &shape) {
    const uint32_t parts = shape.part_count, points = shape.source_point_count;
    record->part_count = parts;
    jox_reserve(image->parts, image->part_capacity, image->part_count + parts);
    memcpy(image->parts + image->part_count, shape.source, parts * sizeof *image->parts);
    image->part_count += parts;
    jox_reserve(image->points, image->point_capacity, image->point_count + points);
    if (points)
        memcpy(image->points + image->point_count, shape.source_points, points * sizeof(double));
    image->point_count += points;
}

static void capture_path(JoxBodiesImage *image, JoxBodyRecord *record, const JoxRow *r) {
    const uint32_t numbers = 3 * r->path.count;
    record->path_count = r->path.count;
    record->path_end = r->path.end;
    record->path_speed = r->path.speed;
    record->path_after = r->path.after;
    record->path_wait = r->path.wait;
    record->path_time = r->path_time;
    record->path_back = r->goes_back;
    jox_reserve(image->path_points, image->path_point_capacity, image->path_point_count + numbers);
    if (numbers)
        memcpy(image->path_points + image->path_point_count, r->path.points,
               numbers * sizeof(double));
    image->path_point_count += numbers;
}

static void capture_row(const JoxBodies *b, JoxBodiesImage *image, uint32_t row) {
    const JoxRow *r = &b->rows[row];
    jox_reserve(image->bodies, image->body_capacity, image->body_count + 1);
    JoxBodyRecord *record = &image->bodies[image->body_count++];
    *record = JoxBodyRecord();
    record->row = row;
    record->id = r->id;
    record->tags[0] = uint32_t(r->tags);
    record->tags[1] = uint32_t(r->tags >> 32);
    record->held = r->held;
    record->holder = r->held ? r->holder : 0;
    record->grounded = r->grounded;
    record->swept = jox_row_is_fast(r, b->last_dt); /* as the next step will set it */
    const float material[4] = {r->material.friction, r->material.restitution, r->material.damping,
                               r->material.spin_damping};
    memcpy(record->material, material, sizeof material);
    capture_vector(record->force, jox_bt(r->force));
    capture_motion(record, r->body);
    record->still = r->kinematic ? JOX_BODY_KINEMATIC : r->shape.still ? JOX_BODY_STATIC : 0;
    capture_shape(image, record, r->shape);
    capture_path(image, record, r);
    record->force_limit = r->force_limit;
    record->held_up = r->held_up;
    record->drive = (r->path.reopens ? JOX_DRIVE_REOPENS : 0) | (r->ends_run ? JOX_DRIVE_ENDS : 0) |
                    (r->reached_limit ? JOX_DRIVE_MET : 0);
    if (r->bonds)
        jox_bodies_image_add_bonds(image, record, r->bonds);
    record->name_length = r->name ? uint32_t(strlen(r->name)) : 0;
    jox_reserve(image->names, image->name_capacity, image->name_count + record->name_length);
    if (record->name_length)
        memcpy(image->names + image->name_count, r->name, record->name_length);
    image->name_count += record->name_length;
}

void jox_bodies_capture(const JoxBodies *b, JoxBodiesImage *image) {
    image->body_count = image->part_count = image->point_count = 0;
    image->name_count = image->block_count = image->bond_count = image->path_point_count = 0;
    image->counters = {b->next_id, b->count, 0, b->last_dt};
    for (uint32_t k = 0; k < b->live; k++)
        capture_row(b, image, b->order[k]);
    if (b->restored) {
        jox_reserve(image->contacts, image->contact_capacity, b->saved_contact_count);
        image->contact_count = b->saved_contact_count;
        if (b->saved_contact_count)
            memcpy(image->contacts, b->saved_contacts,
                   b->saved_contact_count * sizeof *b->saved_contacts);
    } else {
        image->contact_count =
            jox_bodies_note_contacts(b, image->contacts, image->contact_capacity);
    }
    JOX_ASSERT(jox_bodies_image_check(image, nullptr)); /* every captured image is valid */
}

/* ---- rebuild ---- */

static const float *read_vector(const float *from, btVector3 *v) {
    *v = btVector3(from[0], from[1], from[2]);
    return from + 3;
}

static const float *read_transform(const float *from, btTransform *t) {
    btVector3 rows[3], origin;
    for (btVector3 &row : rows)
        from = read_vector(from, &row);
    from = read_vector(from, &origin);
    *t = btTransform(btMatrix3x3(rows[0][0], rows[0][1], rows[0][2], rows[1][0], rows[1][1],
                                 rows[1][2], rows[2][0], rows[2][1], rows[2][2]),
                     origin);
    return from;
}

static void rebuild_motion(const JoxBodyRecord *record, btRigidBody *body) {
    btTransform world, interpolated;
    btVector3 v[4];
    const float *from = read_transform(record->motion, &world);
    from = read_transform(from, &interpolated);
    for (btVector3 &one : v)
        from = read_vector(from, &one);
    body->setWorldTransform(world);
    body->updateInertiaTensor();
    body->setLinearVelocity(v[0]);
    body->setAngularVelocity(v[1]);
    body->setInterpolationWorldTransform(interpolated);
    body->setInterpolationLinearVelocity(v[2]);
    body->setInterpolationAngularVelocity(v[3]);
    body->forceActivationState(int(record->activation));
    body->setDeactivationTime(record->deactivation_time);
}

/* Makes the shape of a record whose parts and points start at these indices; false if it is not
   valid. */
static bool rebuild_shape(const JoxBodiesImage *image, const JoxBodyRecord *record,
                          uint32_t first_part, uint32_t first_point, JoxBodyShape *out) {
    JoxBodyPart *parts =
        static_cast<JoxBodyPart *>(jox_alloc(record->part_count, sizeof(JoxBodyPart)));
    for (uint32_t p = 0; p < record->part_count; p++) {
        const JoxBodyPartRecord *from = &image->parts[first_part + p];
        parts[p].shape.kind = JoxShapeKind(from->kind);
        parts[p].shape.points = image->points + first_point;
        parts[p].shape.point_count = from->point_count;
        memcpy(parts[p].shape.size, from->size, sizeof from->size);
        memcpy(parts[p].position, from->position, sizeof from->position);
        memcpy(parts[p].turn, from->turn, sizeof from->turn);
        parts[p].mass = from->mass;
        parts[p].density = from->density;
        first_point += 3 * from->point_count;
    }
    JoxBodyDef def = jox_body_def();
    def.shape.kind = JOX_SHAPE_COMPOUND;
    def.shape.parts = parts;
    def.shape.part_count = record->part_count;
    bool made = jox_body_shape_make(&def, record->still != 0, out, nullptr);
    jox_free(parts);
    return made;
}

/* Indices at which the next body's parts, points, name, blocks, bonds and path points start. */
struct Cursor {
    uint32_t part, point, name, block, bond, path;
};

static void advance_cursor(Cursor *at, const JoxBodiesImage *image, const JoxBodyRecord *record) {
    for (uint32_t p = 0; p < record->part_count; p++)
        at->point += 3 * image->parts[at->part + p].point_count;
    at->part += record->part_count;
    at->name += record->name_length;
    at->block += record->block_count;
    at->bond += record->bond_count;
    at->path += 3 * record->path_count;
}

static void rebuild_row(JoxBodies *b, const JoxBodiesImage *image, const JoxBodyRecord *record,
                        const Cursor &at, const JoxBodyShape &shape) {
    JoxRow *r = &b->rows[record->row];
    r->live = true;
    r->id = record->id;
    r->tags = uint64_t(record->tags[1]) << 32 | record->tags[0];
    r->shape = shape;
    r->kinematic = record->still == JOX_BODY_KINEMATIC;
    if (record->path_count) {
        const JoxBodyPath path = {image->path_points + at.path,
                                  record->path_count,
                                  record->path_end,
                                  record->path_speed,
                                  record->path_after,
                                  record->path_wait,
                                  (record->drive & JOX_DRIVE_REOPENS) != 0};
        jox_row_set_path(r, &path);
        r->path_time = record->path_time;
        r->goes_back = record->path_back != 0;
    }
    r->force_limit = float(record->force_limit);
    r->held_up = float(record->held_up);
    r->ends_run = (record->drive & JOX_DRIVE_ENDS) != 0;
    r->reached_limit = (record->drive & JOX_DRIVE_MET) != 0;
    r->grounded = record->grounded != 0;
    r->swept = record->swept != 0;
    r->force = JoxV3{record->force[0], record->force[1], record->force[2]};
    if (record->name_length)
        r->name = jox_strndup(image->names + at.name, record->name_length);
    if (record->block_count) {
        r->bonds = jox_bodies_image_bonds(image, record, at.block, at.bond);
        b->bonded++;
    }
    const float *m = record->material;
    jox_row_create_body(b, record->row, btTransform::getIdentity(),
                        JoxMaterial{m[0], m[1], m[2], m[3]});
    rebuild_motion(record, r->body);
    b->order[b->live++] = record->row;
    if (record->held)
        jox_bodies_set_carrier(b, record->row, record->holder);
}

/* Makes all shapes before anything changes; NULL if one is not valid. */
static JoxBodyShape *rebuild_shapes(const JoxBodiesImage *image) {
    JoxBodyShape *shapes =
        static_cast<JoxBodyShape *>(jox_alloc(size_t(image->body_count) + 1, sizeof(JoxBodyShape)));
    Cursor at = {};
    for (uint32_t n = 0; n < image->body_count; n++) {
        const JoxBodyRecord *record = &image->bodies[n];
        if (!rebuild_shape(image, record, at.part, at.point, &shapes[n])) {
            for (uint32_t made = 0; made < n; made++)
                jox_body_shape_free(&shapes[made]);
            jox_free(shapes);
            return nullptr;
        }
        advance_cursor(&at, image, record);
    }
    return shapes;
}

bool jox_bodies_rebuild(JoxBodies *b, const JoxBodiesImage *image, JoxText *error) {
    if (!jox_bodies_image_check(image, error))
        return false;
    JoxBodyShape *shapes = rebuild_shapes(image);
    if (!shapes) {
        if (error)
            jox_text_add(error, "a body's shape in the saved state makes no sense");
        return false;
    }
    while (b->live)
        jox_bodies_drop_row(b, b->order[b->live - 1]);
    if (image->body_count)
        jox_bodies_ensure(b);
    b->next_id = image->counters.next_id;
    b->last_dt = image->counters.last_dt;
    b->count = image->counters.row_count;
    jox_reserve(b->rows, b->capacity, b->count);
    for (uint32_t row = 0; row < b->count; row++)
        b->rows[row] = JoxRow();
    jox_reserve(b->order, b->order_capacity, image->body_count);
    Cursor at = {};
    for (uint32_t n = 0; n < image->body_count; n++) {
        rebuild_row(b, image, &image->bodies[n], at, shapes[n]);
        advance_cursor(&at, image, &image->bodies[n]);
    }
    jox_free(shapes);
    jox_reserve(b->saved_contacts, b->saved_contact_capacity, image->contact_count);
    b->saved_contact_count = image->contact_count;
    if (b->saved_contact_count)
        memcpy(b->saved_contacts, image->contacts,
               b->saved_contact_count * sizeof *b->saved_contacts);
    b->restored = true; /* cleared by the next step */
    jox_bodies_reinsert(b);
    return true;
}

/* ---- sections ---- */

void jox_bodies_sections(JoxBodies *b, JoxSections *s) {
    if (b->visited) {
        jox_bodies_image_sections(b->visited, s);
        return;
    }
    JoxBodiesImage image = JoxBodiesImage();
    if (s->mode != JOX_SECTIONS_RESTORE)
        jox_bodies_capture(b, &image);
    if (s->mode == JOX_SECTIONS_VISIT)
        b->visited = &image;
    jox_bodies_image_sections(&image, s);
    b->visited = nullptr;
    JoxText wrong = {};
    if (s->mode == JOX_SECTIONS_RESTORE && !s->failed && !jox_bodies_rebuild(b, &image, &wrong))
        jox_sections_fail(s, "bodies", wrong.data);
    jox_text_free(&wrong);
    jox_bodies_image_free(&image);
}

void jox_bodies_hash(const JoxBodies *bodies, JoxHash *hash) {
    JoxSections sections = jox_sections_hash();
    jox_bodies_sections(const_cast<JoxBodies *>(bodies),
                        &sections); /* hashing does not change them */
    const uint64_t sum = jox_hash_end(&sections.hash);
    jox_hash_add(hash, &sum, sizeof sum);
}
