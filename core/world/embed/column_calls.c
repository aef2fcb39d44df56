/* Public calls of jostle_read.h about columns: arrays of agents, and names of the numbers in them.
 */
#include <string.h>

#include "base/assert.h"
#include "world/world.h"

/* X(public name, column, type) */
#define COLUMNS(X)                                                                                 \
    X("id", id, JO_U32)                                                                            \
    X("x", x, JO_F32)                                                                              \
    X("y", y, JO_F32)                                                                              \
    X("vx", vx, JO_F32)                                                                            \
    X("vy", vy, JO_F32)                                                                            \
    X("force_x", force_x, JO_F32)                                                                  \
    X("force_y", force_y, JO_F32)                                                                  \
    X("compression", compression, JO_F32)                                                          \
    X("load", load, JO_F32)                                                                        \
    X("density", density, JO_F32)                                                                  \
    X("face_x", face_x, JO_F32)                                                                    \
    X("face_y", face_y, JO_F32)                                                                    \
    X("chest_x", chest_x, JO_F32)                                                                  \
    X("chest_y", chest_y, JO_F32)                                                                  \
    X("spin", spin, JO_F32)                                                                        \
    X("axis_x", axis_x, JO_F32)                                                                    \
    X("axis_y", axis_y, JO_F32)                                                                    \
    X("contact_radius", contact_radius, JO_F32)                                                    \
    X("pref_x", pref_x, JO_F32)                                                                    \
    X("pref_y", pref_y, JO_F32)                                                                    \
    X("eager", eager, JO_F32)                                                                      \
    X("contacts", contacts, JO_U8)                                                                 \
    X("group", group, JO_U16)                                                                      \
    X("machine", machine, JO_U16)                                                                  \
    X("state", state, JO_U16)                                                                      \
    X("team", team, JO_U16)                                                                        \
    X("goal", goal, JO_I32)                                                                        \
    X("slot", slot, JO_U32)                                                                        \
    X("tags", tags, JO_U64)

static const char *const NAMES[] = {
#define X(name, column, type) name,
    COLUMNS(X)
#undef X
};
enum { COLUMN_COUNT = sizeof NAMES / sizeof *NAMES };

const char *jo_column_name(uint32_t n) {
    if (n < COLUMN_COUNT)
        return NAMES[n];
    return n - COLUMN_COUNT < JOX_PARAM_COUNT ? jox_parameters[n - COLUMN_COUNT].name : NULL;
}

JoColumn jo_world_column(const JoWorld *world, const char *name) {
    JOX_REQUIRE(world && name, (JoColumn){0});
    const JoxAgents *a = &world->state.agents;
    if (jox_heap_has_failed(world->heap))
        return (JoColumn){0};
#define X(public, column, kind)                                                                    \
    if (strcmp(name, public) == 0)                                                                 \
        return (JoColumn){a->column, sizeof *a->column, a->count, kind};
    COLUMNS(X)
#undef X
    const int p = jox_parameter_find(name);
    if (p >= 0)
        return (JoColumn){a->param[p].cells, a->param[p].mask || !a->count ? sizeof(float) : 0,
                          a->count, JO_F32};
    return (JoColumn){0};
}

JoAgent jo_world_agent_of(const JoWorld *world, uint32_t id) {
    JOX_REQUIRE(world, (JoAgent){0});
    if (jox_heap_has_failed(world->heap))
        return (JoAgent){0};
    const uint32_t i = jox_agents_find(&world->state.agents, id);
    JoAgent agent = {0};
    if (i != JOX_NO_INDEX)
        agent = jox_world_agent_handle(world, i);
    return agent;
}

const char *jo_world_group_name(const JoWorld *world, uint32_t group) {
    JOX_REQUIRE(world, "");
    return group < world->model.group_count ? world->model.groups[group].name : "";
}

const char *jo_world_machine_name(const JoWorld *world, uint32_t machine) {
    JOX_REQUIRE(world, "");
    const JoxMachineSet *set = &world->model.machines;
    return machine < set->count ? set->items[machine]->name : "";
}

const char *jo_world_state_name(const JoWorld *world, uint32_t machine, uint32_t state) {
    JOX_REQUIRE(world, "");
    const JoxMachineSet *set = &world->model.machines;
    return machine < set->count && state < set->items[machine]->state_count
               ? set->items[machine]->states[state].name
               : "";
}

const char *jo_world_signal_name(const JoWorld *world, uint32_t name) {
    JOX_REQUIRE(world, "");
    const JoxMachineSet *set = &world->model.machines;
    return name < set->name_count ? set->names[name] : "";
}

const char *jo_world_place_name(const JoWorld *world, uint32_t place) {
    JOX_REQUIRE(world, "");
    return place < world->model.scene_places ? world->model.places[place].name : "";
}

const char *jo_world_body_name(const JoWorld *world, uint32_t slot) {
    JOX_REQUIRE(world, "");
    return jox_heap_has_failed(world->heap) ||
                   jox_bodies_id(world->state.bodies, slot) == JOX_NO_BODY
               ? ""
               : jox_bodies_name(world->state.bodies, slot);
}
