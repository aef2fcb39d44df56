/* Public calls of jostle.h about bodies: adds, counts and reads them. */
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "world/embed/argument_checks.h"
#include "world/embed/storey_points.h"
#include "world/world.h"

enum { BODY_COOKIE = 0x4a4f424f };

JoBodyDef jo_default_body_def(void) {
    return (JoBodyDef){.shape = JO_BOX,
                       .size = {1.0, 1.0, 1.0},
                       .mass = 10.0,
                       .z = 0.5,
                       .friction = 0.6,
                       .force_limit = JOX_DRIVE_FORCE,
                       .cookie = BODY_COOKIE};
}

/* Returns the path of a def, starting at the position of the body; the caller frees its points. */
static JoxBodyPath make_path(const JoWorld *world, const JoBodyDef *def) {
    const JoPath *p = &def->path;
    if (!p->points || p->count >= JOX_PATH_POINTS) /* jox_bodies_add refuses too many */
        return (JoxBodyPath){.count = p->points ? JOX_PATH_POINTS + 1 : 0};
    JoxBodyPath path = {.points = jox_alloc(3 * ((size_t)p->count + 1), sizeof *path.points),
                        .count = p->count + 1,
                        .end = (uint32_t)p->end,
                        .speed = p->speed,
                        .after = p->after,
                        .wait = p->wait,
                        .reopens = p->reopens};
    memcpy(path.points, (double[]){def->x, def->y, def->z}, 3 * sizeof *path.points);
    memcpy(path.points + 3, p->points, 3 * (size_t)p->count * sizeof *path.points);
    for (uint32_t k = 0; k < path.count; k++)
        path.points[3 * k + 1] =
            jox_world_move_to_storey(world, def->storey, path.points[3 * k + 1]);
    return path;
}

JoBody jo_world_add_body(JoWorld *world, const JoBodyDef *def, JoError *error) {
    JOX_REQUIRE(world && !world->busy && def && def->cookie == BODY_COOKIE, (JoBody){0});
    static const JoxShapeKind KINDS[] = {[JO_SPHERE] = JOX_SHAPE_SPHERE,
                                         [JO_BOX] = JOX_SHAPE_BOX,
                                         [JO_CYLINDER] = JOX_SHAPE_CYLINDER};
    if (!jox_argument_is_one_of("shape", def->shape, JO_CYLINDER + 1,
                                "JO_SPHERE, JO_BOX, JO_CYLINDER", error) ||
        !jox_argument_is_one_of("path.end", def->path.points ? def->path.end : JO_PATH_STAY,
                                JO_PATH_ROUND + 1, "JO_PATH_STAY, JO_PATH_BACK, JO_PATH_ROUND",
                                error) ||
        !jox_world_check_storey(world, def->storey, error))
        return (JoBody){0};
    JOX_GUARD (world->heap, error)
        return (JoBody){0};
    JoxBodyDef body = jox_body_def();
    body.shape.kind = KINDS[def->shape];
    memcpy(body.shape.size, def->size, sizeof def->size);
    body.mass = def->mass;
    body.still = def->mass == 0.0;
    body.kinematic = def->kinematic;
    const double y = jox_world_move_to_storey(world, def->storey, def->y);
    memcpy(body.position, (double[]){def->x, y, def->z}, sizeof body.position);
    body.turn[2] = jox_sin(def->turn / 2.0);
    body.turn[3] = jox_cos(def->turn / 2.0);
    memcpy(body.velocity, (double[]){def->vx, def->vy, def->vz}, sizeof body.velocity);
    body.friction = def->friction;
    body.restitution = def->restitution;
    body.path = make_path(world, def);
    body.force_limit =
        def->path.points && def->path.force_limit > 0.0 ? def->path.force_limit : def->force_limit;
    body.ends_run = def->ends_world;
    JoxText why = {0};
    uint32_t row = jox_bodies_add(world->state.bodies, &body, &why);
    jox_free(body.path.points);
    if (row == JOX_NO_BODY) {
        jox_error(error, JO_INPUT, "%s", why.data ? why.data : "the body was refused");
        jox_text_free(&why);
        return (JoBody){0};
    }
    jox_bodies_objects(world->state.bodies, &world->scratch.objects);
    /* Ids of bodies are never reused, so that the id serves as the generation. */
    return (JoBody){row, world->scratch.objects.rows[row].id + 1};
}

JoBodyState jo_body_state(const JoWorld *world, JoBody body) {
    JOX_REQUIRE(world, (JoBodyState){0});
    JoxPose pose;
    if (jox_world_find_body(world, body) == JOX_NO_BODY ||
        !jox_bodies_pose(world->state.bodies, body.slot, &pose))
        return (JoBodyState){0};
    const JoxV2 at = {pose.centre.x, pose.centre.y};
    const JoxV2 plan = jox_in_plan(&world->model.storeys, at);
    return (JoBodyState){plan.x,
                         plan.y,
                         pose.centre.z,
                         pose.turn[0],
                         pose.turn[1],
                         pose.turn[2],
                         pose.turn[3],
                         pose.velocity.x,
                         pose.velocity.y,
                         pose.velocity.z,
                         jox_storey_at(&world->model.storeys, at)};
}

uint32_t jo_world_body_count(const JoWorld *world) {
    JOX_REQUIRE(world, 0);
    return jox_bodies_count(world->state.bodies);
}
