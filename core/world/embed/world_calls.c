/* Public calls of jostle.h about the engine and a world as a whole: creates it, adds walls, steps
   it, reads its time and statistics, and takes snapshots. */
#include <math.h>

#include "base/assert.h"
#include "base/format/installed.h"
#include "base/guard.h"
#include "base/mem.h"
#include "geom/polygon.h"
#include "jostle_tools.h"
#include "simd/isa.h"
#include "task/processors.h"
#include "world/embed/argument_checks.h"
#include "world/world.h"

enum { WORLD_COOKIE = 0x4a4f5744 };

const char *jo_version(void) {
    return JOX_VERSION;
}

const char *jo_data_folder(void) {
    return jox_data_folder();
}

void jo_set_assert_handler(JoAssertHandler *handler) {
    jox_assert_set_handler(handler);
}

void jo_free(void *result) {
    jox_free(result);
}

static bool is_lost(const char *field, JoLost lost, JoError *error) {
    return jox_argument_is_one_of(field, lost, JO_LOST_STOP + 1,
                                  "JO_LOST_END, JO_LOST_REMOVE, JO_LOST_STOP", error);
}

JoWorldDef jo_default_world_def(void) {
    return (JoWorldDef){.dt = 0.05,
                        .seed = 1,
                        .threads = 1,
                        .forces = true,
                        .gravity = 9.81,
                        .lost_bodies = JO_LOST_REMOVE,
                        .cookie = WORLD_COOKIE};
}

static bool isa_runs(JoIsa isa, const char *name, JoError *error) {
    char all[80];
    if (isa == JO_ISA_WIDEST ? !name : jox_isa_runs(isa))
        return true;
    jox_isa_list(all, sizeof all);
    jox_error(error, JO_INPUT, "%s '%.60s'; it runs %s",
              isa == JO_ISA_WIDEST ? "there are no kernels for" : "this machine does not run",
              name ? name : jox_isa_name(isa), all);
    return false;
}

bool jo_isa_find(const char *name, JoIsa *isa, JoError *error) {
    JOX_REQUIRE(name && isa, false);
    *isa = jox_isa_named(name);
    return isa_runs(*isa, name, error);
}

const char *jo_isa_name(JoIsa isa) {
    return jox_isa_name(jox_isa_resolve(isa));
}

uint32_t jo_count_processors(void) {
    return jox_count_processors();
}

static JoWorld *create_in(JoxHeap *heap, const JoWorldDef *def, JoError *error) {
    JOX_GUARD (heap, error)
        return NULL;
    return jox_world_create(def);
}

JoWorld *jo_world_create(const JoWorldDef *def, JoError *error) {
    JOX_REQUIRE(def && def->cookie == WORLD_COOKIE && (!def->jobs || def->jobs->run), NULL);
    if (!jox_argument_is_within("dt", "s", def->dt, 0.001, 0.2, error) ||
        !jox_argument_is_within("threads", "threads", def->threads, 0, 64, error) ||
        !jox_argument_is_within("gravity", "m/s2", def->gravity, -100, 100, error) ||
        !is_lost("lost_people", def->lost_people, error) ||
        !is_lost("lost_bodies", def->lost_bodies, error) || !isa_runs(def->isa, NULL, error))
        return NULL;
    JoxHeap *heap = jox_heap_create();
    if (!heap) {
        jox_memory_error(error);
        return NULL;
    }
    JoWorld *world = create_in(heap, def, error);
    if (world)
        world->owns_heap = true;
    else
        jox_heap_free(heap);
    return world;
}

/* Checks and converts points of a wall. Returns NULL with `error` if they are wrong; the caller
 * frees. */
static JoxV2 *read_points(const JoWorld *world, const double *xy, size_t count, size_t least,
                          JoError *error) {
    if (world->state.tick > 0 || count < least || count > 100000) {
        jox_error(error, JO_INPUT,
                  world->state.tick > 0 ? "walls cannot be added after the first step"
                                        : "a wall has %zu to 100,000 points",
                  least);
        return NULL;
    }
    JoxV2 *points = jox_alloc(count, sizeof *points);
    for (size_t i = 0; i < count; i++) {
        if (!(fabs(xy[2 * i]) <= (double)JOX_WORLD_FARTHEST &&
              fabs(xy[2 * i + 1]) <= (double)JOX_WORLD_FARTHEST)) {
            jox_error(error, JO_INPUT, "point %zu of a wall must be within 10 km of the origin", i);
            jox_free(points);
            return NULL;
        }
        points[i] = (JoxV2){(float)xy[2 * i], (float)xy[2 * i + 1]};
    }
    return points;
}

bool jo_world_add_solid(JoWorld *world, const double *xy, size_t count, JoError *error) {
    JOX_REQUIRE(world && !world->busy && xy, false);
    JOX_GUARD (world->heap, error)
        return false;
    JoxV2 *points = read_points(world, xy, count, 3, error);
    if (!points)
        return false;
    uint32_t a, b;
    bool good = !jox_polygon_self_crosses(points, (uint32_t)count, &a, &b) &&
                jox_polygon_area(points, (uint32_t)count) != 0.0;
    if (good) {
        jox_walls_add_solid(&world->model.all_walls, points, (uint32_t)count, INFINITY);
        jox_world_note_new_wall(world);
    } else {
        jox_error(error, JO_INPUT, "a solid must enclose an area and not cross itself");
    }
    jox_free(points);
    return good;
}

bool jo_world_add_line(JoWorld *world, const double *xy, size_t count, JoError *error) {
    JOX_REQUIRE(world && !world->busy && xy, false);
    JOX_GUARD (world->heap, error)
        return false;
    JoxV2 *points = read_points(world, xy, count, 2, error);
    if (!points)
        return false;
    jox_walls_add_polyline(&world->model.all_walls, points, (uint32_t)count, false, INFINITY);
    jox_world_note_new_wall(world);
    jox_free(points);
    return true;
}

const char *jo_stage_name(int stage) {
    static const char *const NAMES[JO_STAGE_COUNT] = {
        "perceive", "think", "prefer", "push", "solve", "move", "bodies", "infer", "observe"};
    return stage >= 0 && stage < JO_STAGE_COUNT ? NAMES[stage] : "";
}

void jo_world_set_timed(JoWorld *world, bool timed) {
    JOX_REQUIRE(world, );
    jox_world_set_timed(world, timed);
}

JoStats jo_world_stats(const JoWorld *world) {
    JOX_REQUIRE(world, (JoStats){0});
    const JoxStatistics *s = &world->state.statistics;
    const double each = s->agent_steps ? 1e9 / (double)s->agent_steps : 0.0;
    JoStats stats = {.steps = s->steps,
                     .agent_steps = s->agent_steps,
                     .agents = world->state.agents.count,
                     .bodies = jox_bodies_count(world->state.bodies),
                     .dt = world->model.def.dt,
                     .simulated_s = (double)s->steps * world->model.def.dt,
                     .wall_s = s->wall_s,
                     .cpu_s = s->cpu_s,
                     .bullet_ns = s->bullet_s * each,
                     .objects_ns = s->objects_s * each,
                     .enter_ns = s->enter_s * each,
                     .leave_ns = s->leave_s * each,
                     .collect_ns = s->collect_s * each,
                     .shifted_at_birth = s->shifted_at_birth,
                     .not_placed = s->not_placed,
                     .moved_out = s->moved_out,
                     .not_moved_out = s->not_moved_out};
    for (int k = 0; k < JO_STAGE_COUNT; k++)
        stats.stage_ns[k] = s->stage_s[k] * each;
    return stats;
}

void jo_world_step(JoWorld *world, uint32_t steps) {
    JOX_REQUIRE(world && !world->busy, );
    JOX_GUARD (world->heap, NULL) {
        world->busy = false;
        return;
    }
    world->busy = true;
    for (uint32_t i = 0; i < steps && jox_world_step(world); i++)
        continue;
    world->busy = false;
}

const char *jo_world_failure(const JoWorld *world) {
    JOX_REQUIRE(world, NULL);
    if (jox_heap_has_failed(world->heap))
        return "out of memory";
    return world->failure[0] ? world->failure : NULL;
}

double jo_world_time(const JoWorld *world) {
    JOX_REQUIRE(world, 0.0);
    return (double)world->state.tick * world->model.def.dt;
}

uint64_t jo_world_tick(const JoWorld *world) {
    JOX_REQUIRE(world, 0);
    return world->state.tick;
}

uint64_t jo_world_hash(const JoWorld *world) {
    JOX_REQUIRE(world, 0);
    JOX_GUARD (world->heap, NULL)
        return 0;
    return jox_world_hash(world);
}

/* ---- snapshots ---- */

void *jo_world_snapshot(JoWorld *world, size_t *size, JoError *error) {
    JOX_REQUIRE(world && !world->busy && size, NULL);
    *size = 0;
    JOX_GUARD (world->heap, error)
        return NULL;
    JoxText out = {0};
    if (!jox_world_snapshot(world, &out, error)) {
        jox_text_free(&out);
        return NULL;
    }
    *size = out.length;
    return jox_disown(out.data);
}

bool jo_world_restore(JoWorld *world, const void *data, size_t size, JoError *error) {
    JOX_REQUIRE(world && !world->busy && data, false);
    JOX_GUARD (world->heap, error)
        return false;
    world->scratch.step_events.tick = 0; /* events are found anew */
    return jox_world_restore(world, data, size, error);
}
