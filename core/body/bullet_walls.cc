/* Static bodies in Bullet's world: the ground and the walls. */
#include "body/bullet.h"

#include <numeric>

static const uint32_t FEW_WALLS = 2000;

btRigidBody *jox_static_make(btCollisionShape *shape, const btTransform &at, int index) {
    btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, shape);
    info.m_startWorldTransform = at;
    info.m_friction = info.m_restitution = 1;
    btRigidBody *body = new btRigidBody(info);
    body->setUserIndex(index);
    return body;
}

void jox_static_drop(JoxBodies *b, btRigidBody *body) {
    b->world->remove(body);
    delete body;
}

void jox_bodies_drop_walls(JoxBodies *b) {
    for (uint32_t i = 0; i < b->wall_count; i++) {
        btCollisionShape *shape = b->walls[i]->getCollisionShape();
        jox_static_drop(b, b->walls[i]);
        delete shape;
    }
    b->wall_count = 0;
    jox_wall_grid_free(&b->wall_grid);
}

/* Adds the walls to Bullet's world. Its tree of boxes is not balanced: boxes added in spatial
   order would each hang below the last one, and every further box would pass all of them. Large
   numbers are added in an order that jumps across the plan. */
static void add_walls_to_world(JoxBodies *b) {
    const uint32_t n = b->wall_count;
    uint64_t step = n > FEW_WALLS ? uint64_t(n * 0.618034) | 1u : 1;
    while (std::gcd(step, uint64_t(n)) > 1)
        step += 2;
    for (uint32_t k = 0; k < n; k++)
        b->world->addRigidBody(b->walls[k * step % n]);
}

/* Makes a box 4 cm thick for each edge; a thin wall, whose edges run along it and back, gets one
   box per pair. */
void jox_bodies_raise_walls(JoxBodies *b) {
    const JoxWalls *walls = &b->standing;
    b->walls_raised = true;
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        uint32_t first = walls->rings[r].first, n = walls->rings[r].count;
        float tall =
            std::isfinite(walls->rings[r].height) ? walls->rings[r].height : b->wall_height;
        for (uint32_t i = first; i < first + n; i++) {
            JoxV2 p = walls->vertices[i].point, d = walls->vertices[i].direction;
            JoxV2 q = walls->vertices[walls->vertices[i].next].point;
            if (!walls->rings[r].solid && (p.x > q.x || (p.x == q.x && p.y > q.y)))
                continue;
            float half = 0.5f * jox_length(jox_sub(q, p));
            if (!(half > 0))
                continue;
            btTransform at(btMatrix3x3(d.x, -d.y, 0, d.y, d.x, 0, 0, 0, 1),
                           btVector3((p.x + q.x) / 2, (p.y + q.y) / 2, tall / 2));
            jox_reserve(b->walls, b->wall_capacity, b->wall_count + 1);
            int index = -2 - int(b->wall_count);
            b->walls[b->wall_count++] =
                jox_static_make(new btBoxShape(btVector3(half, 0.02f, tall / 2)), at, index);
        }
    }
    add_walls_to_world(b);
}
