#include "world/behaviour_look.h"

#include "base/assert.h"
#include "nav/near/perceive.h"
#include "world/world.h"

void jox_world_look(JoWorld *w, JoxBehaviourLook *look) {
    JoxMachineRun *machines = &w->machines;
    *look = (JoxBehaviourLook){0};
    jox_bodies_objects(w->state.bodies, &w->scratch.objects);
    jox_objects_lay(&w->scratch.objects);
    machines->objects = &w->scratch.objects;
    machines->places = w->model.places;
    machines->place_count = w->model.place_count;
    machines->walls_version = w->state.walls_version;
    machines->inputs = w->state.input.present;
    machines->input_count = w->state.input.present_count;
    jox_machines_look(machines, w->scratch.pool, &look->neighbours, (uint32_t)w->state.tick,
                      &look->before);
}

void jox_world_look_at(JoWorld *w, JoxBehaviourLook *look, uint32_t agent) {
    JOX_ASSERT(agent < w->state.agents.count && w->machines.neighbours == &look->neighbours);
    jox_perceive_alone(&w->state.agents, agent, w->model.def.literal, &look->neighbours);
}

void jox_world_end_look(JoWorld *w, JoxBehaviourLook *look) {
    jox_machines_end_look(&w->machines, &look->before);
    jox_neighbours_free(&look->neighbours);
}
