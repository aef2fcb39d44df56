/* Public calls of jostle_act.h: actions on a running world. Each makes an entry of the input log
   and performs it at once. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "world/verbs/verb_table.h"
#include "world/world.h"

/* Finds the id of an agent; false with `error` for a null handle or an agent that left. */
static bool find_agent_id(const JoWorld *world, JoAgent agent, uint32_t *id, JoError *error) {
    const uint32_t i = jox_world_find_agent(world, agent);
    if (i == JOX_NO_INDEX)
        jox_error(error, JO_INPUT, "the handle is of no agent that is there");
    else
        *id = world->state.agents.id[i];
    return i != JOX_NO_INDEX;
}

static bool check_body(const JoWorld *world, JoBody body, JoError *error) {
    const bool good = jox_world_find_body(world, body) != JOX_NO_BODY;
    if (!good)
        jox_error(error, JO_INPUT, "the handle is of no body that is there");
    return good;
}

/* Performs an action on an agent, with a name (or NULL) and `count` numbers. */
static bool act_on_agent(JoWorld *world, JoAgent agent, JoxInputVerb verb, const char *name,
                         const double *numbers, uint32_t count, JoError *error) {
    JoxInputEntry entry = {.verb = verb, .names = {(char *)name}, .given = count};
    JOX_GUARD (world->heap, error)
        return false;
    if (!find_agent_id(world, agent, &entry.number, error))
        return false;
    for (uint32_t n = 0; n < count; n++)
        entry.numbers[n] = numbers[n];
    return jox_input_perform(world, &entry, error);
}

/* Performs an action on a body, with three numbers, and `more_count` others. */
static bool act_on_body(JoWorld *world, JoBody body, JoxInputVerb verb, const double *first,
                        const double *more, uint32_t more_count, JoError *error) {
    const JoBody to = body; /* longjmp may lose an argument in a register */
    JoxInputEntry entry = {.verb = verb, .number = to.slot};
    for (uint32_t n = 0; first && n < 3; n++)
        entry.numbers[entry.given++] = first[n];
    for (uint32_t n = 0; more && n < more_count; n++)
        entry.numbers[entry.given++] = more[n];
    JOX_GUARD (world->heap, error)
        return false;
    return check_body(world, to, error) && jox_input_perform(world, &entry, error);
}

static bool act_by_name(JoWorld *world, JoxInputVerb verb, const char *name, const double *numbers,
                        uint32_t count, JoError *error) {
    JoxInputEntry entry = {.verb = verb, .names = {(char *)name}, .given = count};
    JOX_GUARD (world->heap, error)
        return false;
    for (uint32_t n = 0; n < count; n++)
        entry.numbers[n] = numbers[n];
    return jox_input_perform(world, &entry, error);
}

/* ---- people ---- */

JoAgent jo_world_spawn(JoWorld *world, const char *group, double x, double y, JoError *error) {
    JOX_REQUIRE(world && !world->busy && group, (JoAgent){0});
    if (!act_by_name(world, JOX_INPUT_SPAWN, group, (double[]){x, y}, 2, error))
        return (JoAgent){0};
    const JoxAgents *a = &world->state.agents;
    return jox_world_agent_handle(world,
                                  a->by_rank[a->count - 1]); /* the new agent has the greatest id */
}

void jo_world_remove_agent(JoWorld *world, JoAgent agent) {
    JOX_REQUIRE(world && !world->busy, );
    act_on_agent(world, agent, JOX_INPUT_REMOVE, NULL, NULL, 0, NULL);
}

bool jo_agent_teleport(JoWorld *world, JoAgent agent, double x, double y, JoError *error) {
    JOX_REQUIRE(world && !world->busy, false);
    return act_on_agent(world, agent, JOX_INPUT_TELEPORT, NULL, (double[]){x, y}, 2, error);
}

bool jo_agent_set_goal(JoWorld *world, JoAgent agent, const char *place, JoError *error) {
    JOX_REQUIRE(world && !world->busy && place, false);
    return act_on_agent(world, agent, JOX_INPUT_GOAL, place, NULL, 0, error);
}

bool jo_agent_set_state(JoWorld *world, JoAgent agent, const char *state, JoError *error) {
    JOX_REQUIRE(world && !world->busy && state, false);
    return act_on_agent(world, agent, JOX_INPUT_STATE, state, NULL, 0, error);
}

bool jo_agent_set_memory(JoWorld *world, JoAgent agent, const char *name, double value,
                         JoError *error) {
    JOX_REQUIRE(world && !world->busy && name, false);
    return act_on_agent(world, agent, JOX_INPUT_MEMORY, name, &value, 1, error);
}

bool jo_agent_set_parameter(JoWorld *world, JoAgent agent, const char *name, double value,
                            JoError *error) {
    JOX_REQUIRE(world && !world->busy && name, false);
    return act_on_agent(world, agent, JOX_INPUT_PARAMETER, name, &value, 1, error);
}

bool jo_agent_memory(const JoWorld *world, JoAgent agent, const char *name, double *value) {
    JOX_REQUIRE(world && name && value, false);
    const JoxAgents *a = &world->state.agents;
    const uint32_t i = jox_world_find_agent(world, agent);
    if (i == JOX_NO_INDEX || a->machine[i] == JOX_NO_MACHINE)
        return false;
    const JoxMachine *machine = world->model.machines.items[a->machine[i]];
    const int32_t slot = jox_machine_memory(machine, name);
    if (slot >= 0)
        *value = a->memory[(size_t)i * a->memory_stride + (size_t)slot];
    return slot >= 0;
}

bool jo_agent_parameter(const JoWorld *world, JoAgent agent, const char *name, double *value) {
    JOX_REQUIRE(world && name && value, false);
    const uint32_t i = jox_world_find_agent(world, agent);
    const int p = jox_parameter_find(name);
    if (i == JOX_NO_INDEX || p < 0)
        return false;
    *value = jox_parameter_value((JoxParameter)p, jox_param(&world->state.agents, p, i));
    return true;
}

void jo_agent_apply_force(JoWorld *world, JoAgent agent, double fx, double fy) {
    const double most = world && world->record
                            ? 1e4
                            : 1e6; /* limit of the verb push, or of a call that is not logged */
    JOX_REQUIRE(world && !world->busy && fabs(fx) <= most && fabs(fy) <= most, );
    if (world->record) {
        act_on_agent(world, agent, JOX_INPUT_PUSH, NULL, (double[]){fx, fy}, 2, NULL);
        return;
    }
    const uint32_t i = jox_world_find_agent(world, agent);
    if (i == JOX_NO_INDEX)
        return;
    world->state.agents.ext_x[i] += (float)fx;
    world->state.agents.ext_y[i] += (float)fy;
}

/* ---- bodies ---- */

JoBody jo_world_body_at(const JoWorld *world, uint32_t slot) {
    JOX_REQUIRE(world, (JoBody){0});
    const uint32_t id =
        jox_heap_has_failed(world->heap) ? JOX_NO_BODY : jox_bodies_id(world->state.bodies, slot);
    JoBody body = {0};
    if (id != JOX_NO_BODY)
        body = (JoBody){slot, id + 1};
    return body;
}

JoBody jo_world_find_body(const JoWorld *world, const char *name) {
    JOX_REQUIRE(world && name, (JoBody){0});
    if (!*name || jox_heap_has_failed(world->heap))
        return (JoBody){0};
    return jo_world_body_at(world, jox_bodies_find_name(world->state.bodies, name));
}

bool jo_body_is_live(const JoWorld *world, JoBody body) {
    JOX_REQUIRE(world, false);
    return jox_world_find_body(world, body) != JOX_NO_BODY;
}

bool jo_body_impulse(JoWorld *world, JoBody body, const double impulse[3], const double point[3],
                     JoError *error) {
    JOX_REQUIRE(world && !world->busy && impulse, false);
    return act_on_body(world, body, JOX_INPUT_IMPULSE, impulse, point, 3, error);
}

bool jo_body_place(JoWorld *world, JoBody body, const double at[3], const double turn[4],
                   JoError *error) {
    JOX_REQUIRE(world && !world->busy && at, false);
    return act_on_body(world, body, JOX_INPUT_PLACE, at, turn, 4, error);
}

bool jo_body_set_velocity(JoWorld *world, JoBody body, const double velocity[3],
                          const double spin[3], JoError *error) {
    JOX_REQUIRE(world && !world->busy && velocity, false);
    return act_on_body(world, body, JOX_INPUT_VELOCITY, velocity, spin, 3, error);
}

bool jo_body_remove(JoWorld *world, JoBody body, JoError *error) {
    JOX_REQUIRE(world && !world->busy, false);
    return act_on_body(world, body, JOX_INPUT_DELETE, NULL, NULL, 0, error);
}

/* ---- walls and signals ---- */

bool jo_world_add_wall(JoWorld *world, const char *name, const double *xy, size_t count,
                       JoError *error) {
    JOX_REQUIRE(world && !world->busy && name && xy, false);
    if (count == 2 || count == 4)
        return act_by_name(world, JOX_INPUT_WALL, name, xy, 2 * (uint32_t)count, error);
    jox_error(error, JO_INPUT, "a wall that is added has 2 or 4 points, not %zu", count);
    return false;
}

bool jo_world_remove_wall(JoWorld *world, const char *name, JoError *error) {
    JOX_REQUIRE(world && !world->busy && name, false);
    return act_by_name(world, JOX_INPUT_UNWALL, name, NULL, 0, error);
}

bool jo_world_open_wall(JoWorld *world, const char *name, bool open, JoError *error) {
    JOX_REQUIRE(world && !world->busy && name, false);
    return act_by_name(world, open ? JOX_INPUT_OPEN : JOX_INPUT_CLOSE, name, NULL, 0, error);
}

bool jo_world_set_lift_mode(JoWorld *world, const char *lift, JoLiftMode mode, JoError *error) {
    JOX_REQUIRE(world && !world->busy && lift && (uint32_t)mode < JOX_LIFT_MODES, false);
    JoxInputEntry entry = {
        .verb = JOX_INPUT_LIFT,
        .names = {(char *)(uintptr_t)lift, (char *)(uintptr_t)jox_lift_mode_names[mode]}};
    JOX_GUARD (world->heap, error)
        return false;
    return jox_input_perform(world, &entry, error);
}

bool jo_world_signal(JoWorld *world, const char *name, JoError *error) {
    JOX_REQUIRE(world && !world->busy && name, false);
    return act_by_name(world, JOX_INPUT_SIGNAL, name, NULL, 0, error);
}
