/* The guard of bodies: finds those with numbers that are not finite, outside the world or beyond
   a wall, before Bullet handles them again. */
#include <cstring>

#include "body/bullet.h"

static const float FARTHEST = 10000.0f; /* m from the origin */
static const float REACH =
    2.5f; /* m in a substep: a body that moves farther is tested against all walls */

void jox_bodies_store_poses(JoxBodies *b) {
    for (uint32_t k = 0; k < b->live; k++) {
        JoxRow *r = &b->rows[b->order[k]];
        r->body->getWorldTransform().serializeFloat(r->before);
    }
}

static btVector3 get_position_before(const JoxRow *r) {
    btVector3 at;
    at.deSerializeFloat(r->before.m_origin);
    return at;
}

static bool is_outside_world(const btVector3 &at) {
    return fabsf(at.x()) > FARTHEST || fabsf(at.y()) > FARTHEST || fabsf(at.z()) > FARTHEST;
}

/* Whether a body went from one sheet to the next, which is another storey. */
static bool has_left_sheet(const JoxBodies *b, const JoxRow *r, const btVector3 &at) {
    return b->pitch > 0.0f && floorf((at.y() - b->origin) / b->pitch) !=
                                  floorf((get_position_before(r).y() - b->origin) / b->pitch);
}

/* Returns the height of the wall to which an edge belongs, m. */
static float find_wall_height(const JoxBodies *b, uint32_t edge) {
    const JoxWalls *walls = &b->standing;
    uint32_t ring = 0;
    while (edge >= walls->rings[ring].first + walls->rings[ring].count)
        ring++;
    JOX_ASSERT(ring < walls->ring_count);
    const float height = walls->rings[ring].height;
    return std::isfinite(height) ? height : b->wall_height;
}

/* Whether the centre of a body passed through a wall, below its top. Tested only if the centre
   lies inside the shape: a compound may stand astride of a wall. */
static bool has_passed_wall(JoxBodies *b, const JoxRow *r) {
    const btVector3 from = get_position_before(r), &to = r->body->getWorldTransform().getOrigin();
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
            0.5f * (from.z() + to.z()) < find_wall_height(b, edge))
            return true;
    }
    return false;
}

static bool is_body_lost(JoxBodies *b, const JoxRow *r, JoxBodyEnd *why) {
    const btVector3 &at = r->body->getWorldTransform().getOrigin();
    const bool moves = r->shape.mass > 0;
    if (!jox_finite(at) || !jox_finite(r->body->getLinearVelocity()) ||
        !jox_finite(r->body->getAngularVelocity()))
        *why = JOX_BODY_NOT_FINITE;
    else if (moves && at.z() < b->def.kill_height)
        *why = JOX_BODY_FELL;
    else if ((moves || r->kinematic) && is_outside_world(at))
        *why = JOX_BODY_LEFT;
    else if ((moves || r->kinematic) && has_left_sheet(b, r, at))
        *why = JOX_BODY_LEFT_STOREY;
    else if (moves && r->body->isActive() && has_passed_wall(b, r))
        *why = JOX_BODY_PASSED_WALL;
    else
        return false;
    return true;
}

/* Puts a body back to its position before the substep, at rest. It leaves Bullet's world and
   returns, since numbers that are not finite have entered the search tree there. */
static void restore_position(JoxBodies *b, JoxRow *r) {
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

static void report_lost_body(JoxBodies *b, uint32_t row, JoxBodyEnd why) {
    const JoxRow *r = &b->rows[row];
    JoxBodyGone gone = {};
    gone.row = row;
    gone.id = r->id;
    gone.why = why;
    gone.at = jox_v3(r->body->getWorldTransform().getOrigin());
    gone.before = jox_v3(get_position_before(r));
    gone.velocity = jox_v3(r->body->getLinearVelocity());
    gone.force = r->pushed;
    strncpy(gone.name, r->name ? r->name : "", sizeof gone.name - 1);
    jox_reserve(b->gone, b->gone_capacity, b->gone_count + 1);
    b->gone[b->gone_count++] = gone;
}

/* Reports a lost body and puts it back or removes it; false if it was removed. */
static __attribute__((noinline)) bool handle_lost_body(JoxBodies *b, uint32_t row, JoxBodyEnd why) {
    report_lost_body(b, row, why);
    if (b->def.lost == JO_LOST_STOP)
        restore_position(b, &b->rows[row]);
    else
        jox_bodies_drop_row(b, row);
    return b->def.lost == JO_LOST_STOP;
}

void jox_bodies_handle_lost(JoxBodies *b) {
    for (uint32_t k = 0; k < b->live;) {
        JoxBodyEnd why;
        if (!is_body_lost(b, &b->rows[b->order[k]], &why) || handle_lost_body(b, b->order[k], why))
            k++;
    }
}
