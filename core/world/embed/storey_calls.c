/* Public calls of jostle_read.h and jostle_act.h about storeys: names and heights, points of the
   plane in plan, and calls that take a point on a storey. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "machine/lifts.h"
#include "world/embed/storey_points.h"

static const JoxStoreys *get_storeys(const JoWorld *world) {
    return &world->model.storeys;
}

uint32_t jo_world_storey_count(const JoWorld *world) {
    JOX_REQUIRE(world, 0);
    return get_storeys(world)->storey_count;
}

const char *jo_world_storey_name(const JoWorld *world, uint32_t storey) {
    JOX_REQUIRE(world, "");
    const JoxStoreys *s = get_storeys(world);
    return storey < s->storey_count ? s->storeys[storey].name : "";
}

double jo_world_storey_height(const JoWorld *world, uint32_t storey) {
    JOX_REQUIRE(world, NAN);
    const JoxStoreys *s = get_storeys(world);
    return storey < s->storey_count ? (double)s->storeys[storey].height : (double)NAN;
}

uint32_t jo_world_find_storey(const JoWorld *world, const char *name) {
    JOX_REQUIRE(world && name, JO_NO_STOREY);
    const JoxStoreys *s = get_storeys(world);
    for (uint32_t k = 0; k < s->storey_count; k++)
        if (strcmp(s->storeys[k].name, name) == 0)
            return k;
    return JO_NO_STOREY;
}

uint32_t jo_world_stair_count(const JoWorld *world) {
    JOX_REQUIRE(world, 0);
    return get_storeys(world)->stair_count;
}

JoStairState jo_world_stair(const JoWorld *world, uint32_t stair) {
    JOX_REQUIRE(world, (JoStairState){.name = ""});
    const JoxStoreys *s = get_storeys(world);
    if (stair >= s->stair_count)
        return (JoStairState){.name = ""};
    const JoxStair *at = &s->stairs[stair];
    return (JoStairState){.name = at->name,
                          .lower = at->lower,
                          .upper = at->upper,
                          .width = (double)at->width,
                          .length = (double)jox_stair_length(at),
                          .rise = (double)at->rise,
                          .belt = (double)at->belt,
                          .closed = at->closed};
}

_Static_assert((int)JO_LIFT_IN_USE == JOX_LIFT_IN_USE &&
                   (int)JO_LIFT_OUT_OF_USE == JOX_LIFT_OUT_OF_USE &&
                   (int)JO_LIFT_FIREMEN == JOX_LIFT_FIREMEN,
               "modes are numbered alike");

uint32_t jo_world_lift_count(const JoWorld *world) {
    JOX_REQUIRE(world, 0);
    return world->model.lift_count;
}

JoLiftState jo_world_lift(const JoWorld *world, uint32_t lift) {
    JOX_REQUIRE(world, (JoLiftState){.name = ""});
    if (lift >= world->model.lift_count)
        return (JoLiftState){.name = ""};
    const JoxLift *at = &world->model.lifts[lift];
    const JoxCarLook car = jox_world_car_look(world, lift);
    return (JoLiftState){.name = at->name,
                         .mode = (JoLiftMode)car.mode,
                         .capacity = at->capacity,
                         .people = car.people,
                         .waiting = jox_world_lift_waiting(world, lift),
                         .storey = at->stops[car.stop].storey,
                         .moves = world->state.lifts.cars[lift].target >= 0,
                         .height = (double)car.height,
                         .open = (double)car.open};
}

JoWhere jox_world_where(const JoWorld *world, JoxV2 at) {
    const JoxStoreys *s = get_storeys(world);
    const JoxV2 plan = jox_in_plan(s, at);
    const int32_t stair = jox_stair_at(s, at);
    return (JoWhere){.x = (double)plan.x,
                     .y = (double)plan.y,
                     .height = (double)jox_floor_height(s, at),
                     .storey = jox_storey_at(s, at),
                     .stair = stair < 0 ? JO_NO_STAIR : (uint32_t)stair,
                     .lift = JO_NO_LIFT,
                     .since = NAN};
}

/* Where nobody is. */
static const JoWhere NOWHERE = {.stair = JO_NO_STAIR, .lift = JO_NO_LIFT, .since = NAN};

static JoWhere find_agent(const JoWorld *world, uint32_t i) {
    static const JoRide RIDES[] = {[JOX_RIDE_APPROACH] = JO_RIDE_APPROACHES,
                                   [JOX_RIDE_WAIT] = JO_RIDE_WAITS,
                                   [JOX_RIDE_INSIDE] = JO_RIDE_RIDES};
    const JoxAgents *a = &world->state.agents;
    JoWhere where = jox_world_where(world, (JoxV2){a->x[i], a->y[i]});
    const JoxRider *rider;
    const JoxRidePhase phase = jox_machines_ride(&world->machines, i, &rider);
    where.height = (double)jox_machines_height(&world->machines, i);
    if (phase == JOX_RIDE_OVER)
        return where;
    where.lift = rider->lift;
    where.ride = RIDES[phase];
    if (phase != JOX_RIDE_APPROACH)
        where.since =
            (phase == JOX_RIDE_INSIDE ? rider->boarded : rider->since) * world->model.def.dt;
    return where;
}

JoWhere jo_world_where(const JoWorld *world, double x, double y) {
    JOX_REQUIRE(world && isfinite(x) && isfinite(y), NOWHERE);
    return jox_world_where(world, (JoxV2){(float)x, (float)y});
}

JoWhere jo_agent_where(const JoWorld *world, JoAgent agent) {
    JOX_REQUIRE(world, NOWHERE);
    const uint32_t i = jox_world_find_agent(world, agent);
    return i == JOX_NO_INDEX ? NOWHERE : find_agent(world, i);
}

uint32_t jo_world_wheres(const JoWorld *world, JoWhere *out, uint32_t capacity) {
    JOX_REQUIRE(world && (out || capacity == 0), 0);
    const JoxAgents *a = &world->state.agents;
    if (jox_heap_has_failed(world->heap))
        return 0;
    for (uint32_t i = 0; i < a->count && i < capacity; i++)
        out[i] = find_agent(world, i);
    return a->count;
}

/* ---- points on a storey ---- */

bool jox_world_has_storey(const JoWorld *world, uint32_t storey) {
    const uint32_t count = get_storeys(world)->storey_count;
    return storey < (count ? count : 1);
}

bool jox_world_check_storey(const JoWorld *world, uint32_t storey, JoError *error) {
    const uint32_t count = get_storeys(world)->storey_count;
    if (jox_world_has_storey(world, storey))
        return true;
    if (count)
        jox_error(error, JO_INPUT, "there is no storey %u: the storeys are 0 to %u", storey,
                  count - 1);
    else
        jox_error(error, JO_INPUT, "there is no storey %u: this world has no storeys, give 0",
                  storey);
    return false;
}

double jox_world_move_to_storey(const JoWorld *world, uint32_t storey, double y) {
    const JoxStoreys *s = get_storeys(world);
    return jox_has_storeys(s) ? y + (double)storey * (double)s->pitch : y;
}

uint32_t jo_world_neighbours_on(const JoWorld *world, uint32_t storey, double x, double y,
                                double radius, uint32_t *ids, float *distances, uint32_t capacity) {
    JOX_REQUIRE(world && jox_world_has_storey(world, storey), 0);
    return jo_world_neighbours(world, x, jox_world_move_to_storey(world, storey, y), radius, ids,
                               distances, capacity);
}

double jo_world_density_on(const JoWorld *world, uint32_t storey, double x, double y) {
    JOX_REQUIRE(world && jox_world_has_storey(world, storey), 0.0);
    return jo_world_density(world, x, jox_world_move_to_storey(world, storey, y));
}

JoCast jo_world_cast_on(const JoWorld *world, uint32_t storey, const double from[2],
                        const double to[2], double radius, uint32_t kinds) {
    JOX_REQUIRE(world && jox_world_has_storey(world, storey) && from && to, (JoCast){0});
    const double begin[2] = {from[0], jox_world_move_to_storey(world, storey, from[1])};
    const double end[2] = {to[0], jox_world_move_to_storey(world, storey, to[1])};
    JoCast cast = jo_world_cast(world, begin, end, radius, kinds);
    cast.y -= begin[1] - from[1];
    return cast;
}

JoAgent jo_world_spawn_on(JoWorld *world, const char *group, uint32_t storey, double x, double y,
                          JoError *error) {
    JOX_REQUIRE(world && !world->busy && group, (JoAgent){0});
    if (!jox_world_check_storey(world, storey, error))
        return (JoAgent){0};
    return jo_world_spawn(world, group, x, jox_world_move_to_storey(world, storey, y), error);
}

bool jo_agent_teleport_on(JoWorld *world, JoAgent agent, uint32_t storey, double x, double y,
                          JoError *error) {
    JOX_REQUIRE(world && !world->busy, false);
    return jox_world_check_storey(world, storey, error) &&
           jo_agent_teleport(world, agent, x, jox_world_move_to_storey(world, storey, y), error);
}

/* Sets `out` to a point on a storey as a position. Returns false with `error` if there is no such
   storey. */
static bool place_on_storey(const JoWorld *world, uint32_t storey, const double point[3],
                            double out[3], JoError *error) {
    if (!jox_world_check_storey(world, storey, error))
        return false;
    out[0] = point[0];
    out[1] = jox_world_move_to_storey(world, storey, point[1]);
    out[2] = point[2];
    return true;
}

bool jo_body_impulse_on(JoWorld *world, JoBody body, const double impulse[3], uint32_t storey,
                        const double point[3], JoError *error) {
    JOX_REQUIRE(world && !world->busy && impulse && point, false);
    double at[3];
    return place_on_storey(world, storey, point, at, error) &&
           jo_body_impulse(world, body, impulse, at, error);
}

bool jo_body_place_on(JoWorld *world, JoBody body, uint32_t storey, const double at[3],
                      const double turn[4], JoError *error) {
    JOX_REQUIRE(world && !world->busy && at, false);
    double position[3];
    return place_on_storey(world, storey, at, position, error) &&
           jo_body_place(world, body, position, turn, error);
}

bool jo_world_add_wall_on(JoWorld *world, const char *name, uint32_t storey, const double *xy,
                          size_t count, JoError *error) {
    enum { MOST_POINTS = 4 }; /* jo_world_add_wall refuses other numbers */
    JOX_REQUIRE(world && !world->busy && name && xy, false);
    double moved[2 * MOST_POINTS];
    if (!jox_world_check_storey(world, storey, error))
        return false;
    for (size_t k = 0; k < count && k < MOST_POINTS; k++) {
        moved[2 * k] = xy[2 * k];
        moved[2 * k + 1] = jox_world_move_to_storey(world, storey, xy[2 * k + 1]);
    }
    return jo_world_add_wall(world, name, moved, count, error);
}
