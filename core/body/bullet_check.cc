/* Assertions on the rows of bodies and Bullet's world; builds with assertions call them. */
#include "body/bullet.h"

static bool is_rigid_frame(const btTransform &t) {
    return std::fabs(t.getBasis().determinant() - 1) < 1e-3f && jox_finite(t.getOrigin());
}

static void check_convex_part(const JoxConvexPart *p) {
    JOX_ASSERT(p->kind <= JOX_SHAPE_HULL && is_rigid_frame(p->frame));
    JOX_ASSERT((p->kind == JOX_SHAPE_SPHERE) == (p->corner_count == 0));
    for (uint32_t e = 0; e < p->edge_count; e++) {
        JOX_ASSERT(p->edges[2 * e] < p->corner_count && p->edges[2 * e + 1] < p->corner_count);
        JOX_ASSERT(p->edges[2 * e] != p->edges[2 * e + 1]);
    }
}

void jox_body_shape_check(const JoxBodyShape *s) {
    uint32_t numbers = 0;
    JOX_ASSERT(s->collision && s->part_count > 0 && s->child_count == s->part_count);
    JOX_ASSERT(s->still == (s->mass == 0) && is_rigid_frame(s->frame));
    for (int i = 0; i < 3 && !s->still; i++) {
        const float two = s->inertia[(i + 1) % 3] + s->inertia[(i + 2) % 3];
        JOX_ASSERT(s->inertia[i] > 0 &&
                   s->inertia[i] <= 1.001f * two); /* triangle inequality of moments */
    }
    JOX_ASSERT(s->inner > 0 &&
               s->inner <= 1.01f * s->bound + 0.01f); /* tolerance for Bullet's margins */
    for (uint32_t p = 0; p < s->part_count; p++) {
        check_convex_part(&s->parts[p]);
        numbers += 3 * s->source[p].point_count;
    }
    JOX_ASSERT(numbers == s->source_point_count);
}

static void check_row(const JoxBodies *b, uint32_t row) {
    const JoxRow *r = &b->rows[row];
    const int no_response = btCollisionObject::CF_NO_CONTACT_RESPONSE;
    JOX_ASSERT(r->live && r->id < b->next_id);
    JOX_ASSERT(r->body && r->body->getUserIndex() == int(row));
    JOX_ASSERT(r->body->getCollisionShape() == r->shape.collision);
    JOX_ASSERT(r->body->isStaticOrKinematicObject() == r->shape.still);
    JOX_ASSERT(r->body->isKinematicObject() == r->kinematic);
    JOX_ASSERT(!r->path.count || (r->kinematic && !jox_path_find_fault(&r->path)));
    JOX_ASSERT((r->body->getInvMass() > 0) == (r->shape.mass > 0));
    JOX_ASSERT(r->held == ((r->body->getCollisionFlags() & no_response) != 0));
    JOX_ASSERT(!r->shape.still || !(r->held || r->bonds));
    if (!r->bonds)
        return;
    jox_bonds_check(r->bonds);
    JOX_ASSERT(r->bonds->count == r->shape.part_count); /* one part per block */
    JOX_ASSERT(r->bonds->bond_count > 0);
}

void jox_bodies_check(const JoxBodies *b) {
    uint32_t live = 0, bonded = 0;
    for (uint32_t row = 0; row < b->count; row++) {
        live += b->rows[row].live;
        JOX_ASSERT(b->rows[row].live || !(b->rows[row].body || b->rows[row].bonds));
    }
    JOX_ASSERT(live == b->live && b->count <= b->capacity);
    for (uint32_t k = 0; k < b->live; k++) {
        JOX_ASSERT(b->order[k] < b->count);
        JOX_ASSERT(k == 0 || b->rows[b->order[k - 1]].id < b->rows[b->order[k]].id);
        check_row(b, b->order[k]);
        bonded += b->rows[b->order[k]].bonds != nullptr;
    }
    JOX_ASSERT(bonded == b->bonded);
    for (uint32_t n = 0; n < b->wall_count; n++)
        JOX_ASSERT(b->walls[n]->getUserIndex() == -2 - int(n) && b->walls[n]->isStaticObject());
    if (b->world)
        JOX_ASSERT(uint32_t(b->world->getNumCollisionObjects()) ==
                   b->live + b->wall_count + (b->ground ? 1 : 0));
}

void jox_bodies_report_check(const JoxBodies *b, uint32_t disc_count) {
    for (uint32_t k = 0; k < b->live; k++) {
        const btRigidBody *body = b->rows[b->order[k]].body;
        JOX_ASSERT(jox_finite(body->getWorldTransform().getOrigin()));
        JOX_ASSERT(jox_finite(body->getLinearVelocity()) && jox_finite(body->getAngularVelocity()));
    }
    for (uint32_t n = 0; n < b->hit_count; n++) {
        JOX_ASSERT(b->hits[n].disc < disc_count && b->hits[n].object < b->count);
        JOX_ASSERT(std::isfinite(b->hits[n].impulse.x) && std::isfinite(b->hits[n].impulse.y));
    }
    for (uint32_t n = 0; n < b->gone_count; n++) {
        const JoxRow *r = &b->rows[b->gone[n].row]; /* a new piece may use the row since */
        JOX_ASSERT(b->gone[n].id < b->next_id);
        JOX_ASSERT(b->def.lost == JO_LOST_STOP || !(r->live && r->id <= b->gone[n].id));
    }
    for (uint32_t n = 0; n < b->break_count; n++) {
        JOX_ASSERT(b->breaks[n].bonds > 0 && b->breaks[n].pieces > 0);
        JOX_ASSERT(b->rows[b->breaks[n].row].id == b->breaks[n].id);
        JOX_ASSERT(n == 0 || b->breaks[n - 1].id < b->breaks[n].id);
    }
}

void jox_contact_loads_check(const JoxBodies *b) {
    uint32_t count = 0;
    for (uint32_t k = 0; k < b->contact_run_count; k++) {
        const JoxContactRun *run = &b->contact_runs[k];
        JOX_ASSERT(k == 0 || b->contact_runs[k - 1].key <= run->key);
        JOX_ASSERT((run->key >> 32) < b->count && b->rows[run->key >> 32].bonds);
        JOX_ASSERT(run->count > 0 && run->first + run->count <= b->contact_load_count);
        for (uint32_t n = run->first; n < run->first + run->count; n++) {
            const JoxContactLoad *load = &b->contact_loads[n];
            JOX_ASSERT(load->block < b->rows[run->key >> 32].bonds->count);
            JOX_ASSERT(jox_finite(load->point) && std::fabs(load->normal.length2() - 1) < 1e-2f);
        }
        count += run->count;
    }
    JOX_ASSERT(count == b->contact_load_count);
}
