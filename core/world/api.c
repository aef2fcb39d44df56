/* The public jo_world_*: checks what comes in, then calls the world. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "geom/polygon.h"
#include "jostle_tools.h"
#include "simd/isa.h"
#include "world/world.h"

enum { WORLD_COOKIE = 0x4a4f5744, AGENT_COOKIE = 0x4a4f4147, BODY_COOKIE = 0x4a4f424f };
static const double FARTHEST = 10000.0; /* m: floats still resolve a millimetre there */

const char *jo_version(void) {
    return JOX_VERSION;
}

void jo_set_assert_handler(JoAssertHandler *handler) {
    jox_assert_set_handler(handler);
}

void jo_free(void *result) {
    jox_free(result);
}

/* False, with an error that names the field and its range, if `value` is outside it or NaN. */
static bool within(const char *field, const char *unit, double value, double least, double greatest,
                   JoError *error) {
    if (value >= least && value <= greatest)
        return true;
    jox_error(error, JO_INPUT, "%s must be from %g to %g %s, not %g", field, least, greatest, unit,
              value);
    return false;
}

/* False, with an error that lists the values, if `value` is none of an enumeration from 0 on. */
static bool is_one_of(const char *field, uint32_t value, uint32_t count, const char *values,
                      JoError *error) {
    if (value < count)
        return true;
    jox_error(error, JO_INPUT, "%s must be one of %s, not %d", field, values, (int)value);
    return false;
}

static bool is_lost(const char *field, JoLost lost, JoError *error) {
    return is_one_of(field, lost, JO_LOST_STOP + 1, "JO_LOST_END, JO_LOST_REMOVE, JO_LOST_STOP",
                     error);
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

static JoWorld *create_in(JoxHeap *heap, const JoWorldDef *def, JoError *error) {
    JOX_GUARD (heap, error)
        return NULL;
    return jox_world_create(def);
}

JoWorld *jo_world_create(const JoWorldDef *def, JoError *error) {
    JOX_REQUIRE(def && def->cookie == WORLD_COOKIE && (!def->jobs || def->jobs->run), NULL);
    if (!within("dt", "s", def->dt, 0.001, 0.2, error) ||
        !within("threads", "threads", def->threads, 0, 64, error) ||
        !within("gravity", "m/s2", def->gravity, -100, 100, error) ||
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

/* Checks and converts points; NULL with `error` if something is wrong. The caller frees. */
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
        if (!(fabs(xy[2 * i]) <= FARTHEST && fabs(xy[2 * i + 1]) <= FARTHEST)) {
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
        jox_world_wall_came(world);
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
    jox_world_wall_came(world);
    jox_free(points);
    return true;
}

JoAgentDef jo_default_agent_def(void) {
    return (JoAgentDef){.radius = jox_parameters[JOX_PARAM_radius].value,
                        .mass = jox_parameters[JOX_PARAM_mass].value,
                        .speed = jox_parameters[JOX_PARAM_speed].value,
                        .max_speed = jox_parameters[JOX_PARAM_max_speed].value,
                        .perception = jox_parameters[JOX_PARAM_perception].value,
                        .horizon = jox_parameters[JOX_PARAM_horizon].value,
                        .time_gap = jox_parameters[JOX_PARAM_time_gap].value,
                        .haste = jox_parameters[JOX_PARAM_haste].value,
                        .cookie = AGENT_COOKIE};
}

/* The parameters that a JoAgentDef holds, by the table's names and ranges. */
static bool agent_parameters(const JoAgentDef *def, double values[JOX_PARAM_COUNT],
                             JoError *error) {
    for (int p = 0; p < JOX_PARAM_COUNT; p++)
        values[p] = jox_parameters[p].value;
    values[JOX_PARAM_radius] = def->radius;
    values[JOX_PARAM_mass] = def->mass;
    values[JOX_PARAM_speed] = def->speed;
    values[JOX_PARAM_max_speed] = def->max_speed;
    values[JOX_PARAM_perception] = def->perception;
    values[JOX_PARAM_horizon] = def->horizon;
    values[JOX_PARAM_push] = def->push;
    values[JOX_PARAM_time_gap] = def->time_gap;
    values[JOX_PARAM_haste] = def->haste;
    for (int p = 0; p < JOX_PARAM_COUNT; p++) {
        const JoxParameterInfo *info = &jox_parameters[p];
        if (!within(info->name, info->unit, values[p], info->least, info->greatest, error))
            return false;
    }
    return within("x", "m", def->x, -FARTHEST, FARTHEST, error) &&
           within("y", "m", def->y, -FARTHEST, FARTHEST, error);
}

JoAgent jox_world_handle(const JoWorld *world, uint32_t index) {
    uint32_t slot = world->state.agents.slot[index];
    JOX_ASSERT(world->state.agents.slot_index[slot] == index);
    JOX_ASSERT(world->state.agents.slot_generation[slot] > 0); /* 0 is no agent */
    return (JoAgent){slot, world->state.agents.slot_generation[slot]};
}

static void refuse_birth(JoxBirthSpot spot, const JoAgentDef *def, JoError *error) {
    JoxText why = {0};
    jox_world_say_unplaced(spot, def->x, def->y, &why);
    jox_error(error, JO_INPUT, "the agent is not added: %s", why.data);
    jox_text_free(&why);
}

JoAgent jo_world_add_agent(JoWorld *world, const JoAgentDef *def, JoError *error) {
    JOX_REQUIRE(world && !world->busy && def && def->cookie == AGENT_COOKIE, (JoAgent){0});
    double values[JOX_PARAM_COUNT];
    JOX_GUARD (world->heap, error)
        return (JoAgent){0};
    if (!agent_parameters(def, values, error))
        return (JoAgent){0};
    JoxAgents *a = &world->state.agents;
    const JoxBirthWish wish = {.at = {(float)def->x, (float)def->y},
                               .radius =
                                   jox_parameter_store(JOX_PARAM_radius, values[JOX_PARAM_radius])};
    JoxV2 spot;
    jox_world_raise_walls(world);
    const JoxBirthSpot found = jox_nav_find_birth(world->scratch.nav, a, &wish, &spot);
    if (!jox_birth_succeeds(found)) {
        world->state.statistics.not_placed++;
        refuse_birth(found, def, error);
        return (JoAgent){0};
    }
    const uint32_t i = jox_world_add_agent(world, spot.x, spot.y);
    a->machine[i] = JOX_NO_MACHINE;
    for (int p = 0; p < JOX_PARAM_COUNT; p++)
        jox_param_set(a, p, i, jox_parameter_store((JoxParameter)p, values[p]));
    jox_nav_note_birth(world->scratch.nav, a, i);
    world->state.statistics.shifted_at_birth += found == JOX_BIRTH_SHIFTED;
    return jox_world_handle(world, i);
}

uint32_t jox_world_find(const JoWorld *world, JoAgent agent) {
    const JoxAgents *a = &world->state.agents;
    if (jox_heap_has_failed(world->heap) || agent.generation == 0 || agent.slot >= a->slot_count ||
        a->slot_generation[agent.slot] != agent.generation)
        return JOX_NO_INDEX;
    return a->slot_index[agent.slot];
}

bool jo_agent_is_live(const JoWorld *world, JoAgent agent) {
    JOX_REQUIRE(world, false);
    return jox_world_find(world, agent) != JOX_NO_INDEX;
}

JoAgentState jo_agent_state(const JoWorld *world, JoAgent agent) {
    JOX_REQUIRE(world, (JoAgentState){.state = ""});
    uint32_t i = jox_world_find(world, agent);
    if (i == JOX_NO_INDEX)
        return (JoAgentState){.state = ""};
    const JoxAgents *a = &world->state.agents;
    const char *state = a->machine[i] == JOX_NO_MACHINE
                            ? ""
                            : world->model.machines.items[a->machine[i]]->states[a->state[i]].name;
    return (JoAgentState){.id = a->id[i],
                          .x = a->x[i],
                          .y = a->y[i],
                          .vx = a->vx[i],
                          .vy = a->vy[i],
                          .fx = a->force_x[i],
                          .fy = a->force_y[i],
                          .compression = a->compression[i],
                          .load = a->load[i],
                          .radius = jox_param(a, JOX_PARAM_radius, i),
                          .state = state};
}

void jo_agent_set_preferred(JoWorld *world, JoAgent agent, double vx, double vy) {
    JOX_REQUIRE(world && !world->busy && fabs(vx) <= 1e6 && fabs(vy) <= 1e6, );
    uint32_t i = jox_world_find(world, agent);
    if (i == JOX_NO_INDEX)
        return;
    world->state.agents.pref_x[i] = (float)vx;
    world->state.agents.pref_y[i] = (float)vy;
}

JoBodyDef jo_default_body_def(void) {
    return (JoBodyDef){.shape = JO_BOX,
                       .size = {1.0, 1.0, 1.0},
                       .mass = 10.0,
                       .z = 0.5,
                       .friction = 0.6,
                       .force_limit = JOX_DRIVE_FORCE,
                       .cookie = BODY_COOKIE};
}

/* The path of a body, from where the body begins; its points are the caller's. */
static JoxBodyPath path_of(const JoBodyDef *def) {
    const JoPath *p = &def->path;
    if (!p->points || p->count >= JOX_PATH_POINTS) /* too many are refused when it is added */
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
    return path;
}

JoBody jo_world_add_body(JoWorld *world, const JoBodyDef *def, JoError *error) {
    JOX_REQUIRE(world && !world->busy && def && def->cookie == BODY_COOKIE, (JoBody){0});
    static const JoxShapeKind KINDS[] = {[JO_SPHERE] = JOX_SHAPE_SPHERE,
                                         [JO_BOX] = JOX_SHAPE_BOX,
                                         [JO_CYLINDER] = JOX_SHAPE_CYLINDER};
    if (!is_one_of("shape", def->shape, JO_CYLINDER + 1, "JO_SPHERE, JO_BOX, JO_CYLINDER", error) ||
        !is_one_of("path.end", def->path.points ? def->path.end : JO_PATH_STAY, JO_PATH_ROUND + 1,
                   "JO_PATH_STAY, JO_PATH_BACK, JO_PATH_ROUND", error))
        return (JoBody){0};
    JOX_GUARD (world->heap, error)
        return (JoBody){0};
    JoxBodyDef body = jox_body_def();
    body.shape.kind = KINDS[def->shape];
    memcpy(body.shape.size, def->size, sizeof def->size);
    body.mass = def->mass;
    body.still = def->mass == 0.0;
    body.kinematic = def->kinematic;
    memcpy(body.position, (double[]){def->x, def->y, def->z}, sizeof body.position);
    body.turn[2] = jox_sin(def->turn / 2.0);
    body.turn[3] = jox_cos(def->turn / 2.0);
    memcpy(body.velocity, (double[]){def->vx, def->vy, def->vz}, sizeof body.velocity);
    body.friction = def->friction;
    body.restitution = def->restitution;
    body.path = path_of(def);
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

uint32_t jox_world_find_body(const JoWorld *world, JoBody body) {
    if (jox_heap_has_failed(world->heap) || body.generation == 0 ||
        jox_bodies_id(world->state.bodies, body.slot) != body.generation - 1)
        return JOX_NO_BODY;
    return body.slot;
}

JoBodyState jo_body_state(const JoWorld *world, JoBody body) {
    JOX_REQUIRE(world, (JoBodyState){0});
    JoxPose pose;
    if (jox_world_find_body(world, body) == JOX_NO_BODY ||
        !jox_bodies_pose(world->state.bodies, body.slot, &pose))
        return (JoBodyState){0};
    return (JoBodyState){pose.centre.x,   pose.centre.y,  pose.centre.z, pose.turn[0],
                         pose.turn[1],    pose.turn[2],   pose.turn[3],  pose.velocity.x,
                         pose.velocity.y, pose.velocity.z};
}

uint32_t jo_world_body_count(const JoWorld *world) {
    JOX_REQUIRE(world, 0);
    return jox_bodies_count(world->state.bodies);
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

uint32_t jo_world_agent_count(const JoWorld *world) {
    JOX_REQUIRE(world, 0);
    return world->state.agents.count;
}

uint32_t jo_world_agents(const JoWorld *world, JoAgent *out, uint32_t capacity) {
    JOX_REQUIRE(world && (out || capacity == 0), 0);
    const JoxAgents *a = &world->state.agents;
    uint32_t n = 0;
    if (jox_heap_has_failed(world->heap))
        return 0;
    for (; n < a->count && n < capacity; n++)
        out[n] = jox_world_handle(world, a->by_rank[n]);
    return n;
}

uint64_t jo_world_hash(const JoWorld *world) {
    JOX_REQUIRE(world, 0);
    JOX_GUARD (world->heap, NULL)
        return 0;
    return jox_world_hash(world);
}
