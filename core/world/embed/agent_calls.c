/* Public calls of jostle.h about agents: adds, lists and reads them. */
#include <math.h>

#include "base/assert.h"
#include "base/guard.h"
#include "world/embed/argument_checks.h"
#include "world/embed/storey_points.h"
#include "world/world.h"

enum { AGENT_COOKIE = 0x4a4f4147 };

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

/* Reads the parameters of a def, and checks their ranges. */
static bool read_parameters(const JoAgentDef *def, double values[JOX_PARAM_COUNT], JoError *error) {
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
        if (!jox_argument_is_within(info->name, info->unit, values[p], info->least, info->greatest,
                                    error))
            return false;
    }
    return jox_argument_is_within("x", "m", def->x, -(double)JOX_WORLD_FARTHEST,
                                  (double)JOX_WORLD_FARTHEST, error) &&
           jox_argument_is_within("y", "m", def->y, -(double)JOX_WORLD_FARTHEST,
                                  (double)JOX_WORLD_FARTHEST, error);
}

static JoxV2 find_position(const JoWorld *world, const JoAgentDef *def) {
    return (JoxV2){(float)def->x, (float)jox_world_move_to_storey(world, def->storey, def->y)};
}

static void refuse_birth(const JoWorld *world, JoxBirthSpot spot, const JoAgentDef *def,
                         JoError *error) {
    JoxText why = {0};
    jox_world_explain_unplaced(&world->model.storeys, spot, find_position(world, def), &why);
    jox_error(error, JO_INPUT, "the agent is not added: %s", why.data);
    jox_text_free(&why);
}

JoAgent jo_world_add_agent(JoWorld *world, const JoAgentDef *def, JoError *error) {
    JOX_REQUIRE(world && !world->busy && def && def->cookie == AGENT_COOKIE, (JoAgent){0});
    double values[JOX_PARAM_COUNT];
    JOX_GUARD (world->heap, error)
        return (JoAgent){0};
    if (!read_parameters(def, values, error) || !jox_world_check_storey(world, def->storey, error))
        return (JoAgent){0};
    JoxAgents *a = &world->state.agents;
    const JoxBirthWish wish = {.at = find_position(world, def),
                               .radius =
                                   jox_parameter_store(JOX_PARAM_radius, values[JOX_PARAM_radius])};
    JoxV2 spot;
    jox_world_apply_walls(world);
    const JoxBirthSpot found = jox_nav_find_birth(world->scratch.nav, a, &wish, &spot);
    if (!jox_birth_succeeds(found)) {
        world->state.statistics.not_placed++;
        refuse_birth(world, found, def, error);
        return (JoAgent){0};
    }
    const uint32_t i = jox_world_add_agent(world, spot.x, spot.y);
    a->machine[i] = JOX_NO_MACHINE;
    for (int p = 0; p < JOX_PARAM_COUNT; p++)
        jox_param_set(a, p, i, jox_parameter_store((JoxParameter)p, values[p]));
    jox_nav_note_birth(world->scratch.nav, a, i);
    world->state.statistics.shifted_at_birth += found == JOX_BIRTH_SHIFTED;
    return jox_world_agent_handle(world, i);
}

bool jo_agent_is_live(const JoWorld *world, JoAgent agent) {
    JOX_REQUIRE(world, false);
    return jox_world_find_agent(world, agent) != JOX_NO_INDEX;
}

JoAgentState jo_agent_state(const JoWorld *world, JoAgent agent) {
    JOX_REQUIRE(world, (JoAgentState){.state = ""});
    uint32_t i = jox_world_find_agent(world, agent);
    if (i == JOX_NO_INDEX)
        return (JoAgentState){.state = ""};
    const JoxAgents *a = &world->state.agents;
    const char *state = a->machine[i] == JOX_NO_MACHINE
                            ? ""
                            : world->model.machines.items[a->machine[i]]->states[a->state[i]].name;
    const JoxV2 at = {a->x[i], a->y[i]}, plan = jox_in_plan(&world->model.storeys, at);
    return (JoAgentState){.id = a->id[i],
                          .x = plan.x,
                          .y = plan.y,
                          .storey = jox_storey_at(&world->model.storeys, at),
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
    uint32_t i = jox_world_find_agent(world, agent);
    if (i == JOX_NO_INDEX)
        return;
    world->state.agents.pref_x[i] = (float)vx;
    world->state.agents.pref_y[i] = (float)vy;
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
        out[n] = jox_world_agent_handle(world, a->by_rank[n]);
    return n;
}
