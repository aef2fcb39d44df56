/* The guard: bodies whose numbers go wrong, that leave the world or pass a wall, before Bullet
   meets them again. */
#include <cstring>

#include "body/bullet.h"

static const float FARTHEST = 10000.0f; /* m from the origin */
static const float REACH = 2.5f; /* m in a substep: who goes farther is compared with all walls */

void jox_bodies_guard_begin(JoxBodies *b) {
    for (uint32_t k = 0; k < b->live; k++) {
        JoxRow *r = &b->rows[b->order[k]];
        r->body->getWorldTransform().serializeFloat(r->before);
    }
}

static btVector3 before(const JoxRow *r) {
    btVector3 at;
    at.deSerializeFloat(r->before.m_origin);
    return at;
}

static bool is_far(const btVector3 &at) {
    return fabsf(at.x()) > FARTHEST || fabsf(at.y()) > FARTHEST || fabsf(at.z()) > FARTHEST;
}

/* The height of the wall that an edge belongs to, m. */
static float height_of(const JoxBodies *b, uint32_t edge) {
    const JoxWalls *walls = &b->standing;
    uint32_t ring = 0;
    while (edge >= walls->rings[ring].first + walls->rings[ring].count)
        ring++;
    JOX_ASSERT(ring < walls->ring_count);
    const float height = walls->rings[ring].height;
    return std::isfinite(height) ? height : b->wall_height;
}

/* Whether the middle of a body went through a wall, below its top. Of shapes whose middle is a part
   of them: a compound may stand astride. */
static bool passed_wall(JoxBodies *b, const JoxRow *r) {
    const btVector3 from = before(r), &to = r->body->getWorldTransform().getOrigin();
    if (b->standing.count == 0 || r->held || (r->shape.part_count != 1 && !r->bonds) ||
        (from.x() == to.x() && from.y() == to.y()))
        return false;
    jox_wall_grid_fit(&b->wall_grid, REACH);
    uint32_t count = b->standing.count;
    const JoxV2 p = {from.x(), from.y()}, q = {to.x(), to.y()};
    const bool near = jox_length2(jox_sub(q, p)) < REACH * REACH;
    const uint32_t *edges = near ? jox_wall_grid_at(&b->wall_grid, p, &count) : nullptr;
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t edge = near ? edges[k] : k;
        const JoxWallVertex *v = &b->standing.vertices[edge];
        if (jox_segments_cross(v->point, b->standing.vertices[v->next].point, p, q) &&
            0.5f * (from.z() + to.z()) < height_of(b, edge))
            return true;
    }
    return false;
}

static bool is_lost(JoxBodies *b, const JoxRow *r, JoxBodyEnd *why) {
    const btVector3 &at = r->body->getWorldTransform().getOrigin();
    const bool moves = r->shape.mass > 0;
    if (!jox_finite(at) || !jox_finite(r->body->getLinearVelocity()) ||
        !jox_finite(r->body->getAngularVelocity()))
        *why = JOX_BODY_NOT_FINITE;
    else if (moves && at.z() < b->def.kill_height)
        *why = JOX_BODY_FELL;
    else if ((moves || r->kinematic) && is_far(at))
        *why = JOX_BODY_LEFT;
    else if (moves && r->body->isActive() && passed_wall(b, r))
        *why = JOX_BODY_PASSED_WALL;
    else
        return false;
    return true;
}

/* Where it was, at rest; taken out of Bullet's world and put back, as numbers that are no numbers
   have gone into its search tree. */
static void put_back(JoxBodies *b, JoxRow *r) {
    b->world->remove(r->body);
    btTransform at;
    at.deSerializeFloat(r->before);
    r->body->setWorldTransform(at);
    r->body->setInterpolationWorldTransform(at);
    r->body->setLinearVelocity(btVector3(0, 0, 0));
    r->body->setAngularVelocity(btVector3(0, 0, 0));
    r->body->clearForces();
    b->world->addRigidBody(r->body);
}

static void list_gone(JoxBodies *b, uint32_t row, JoxBodyEnd why) {
    const JoxRow *r = &b->rows[row];
    JoxBodyGone gone = {};
    gone.row = row;
    gone.id = r->id;
    gone.why = why;
    gone.at = jox_v3(r->body->getWorldTransform().getOrigin());
    gone.before = jox_v3(before(r));
    gone.velocity = jox_v3(r->body->getLinearVelocity());
    gone.force = r->pushed;
    strncpy(gone.name, r->name ? r->name : "", sizeof gone.name - 1);
    jox_reserve(b->gone, b->gone_capacity, b->gone_count + 1);
    b->gone[b->gone_count++] = gone;
}

/* A body that is lost; false where it is gone for good. */
static __attribute__((noinline)) bool lose(JoxBodies *b, uint32_t row, JoxBodyEnd why) {
    list_gone(b, row, why);
    if (b->def.lost == JO_LOST_STOP)
        put_back(b, &b->rows[row]);
    else
        jox_bodies_drop(b, row);
    return b->def.lost == JO_LOST_STOP;
}

void jox_bodies_guard(JoxBodies *b) {
    for (uint32_t k = 0; k < b->live;) {
        JoxBodyEnd why;
        if (!is_lost(b, &b->rows[b->order[k]], &why) || lose(b, b->order[k], why))
            k++;
    }
}
