/* Worlds and people with torsos, for tests of loads. */
#ifndef TESTS_UNIT_LOAD_TORSO_H
#define TESTS_UNIT_LOAD_TORSO_H

#include "unit/load_energy.h"

#include "agents/torso.h"

/* Adds a person with a torso whose chest points along `angle`. */
static inline JoAgent add_torso(JoWorld *w, double x, double y, double angle, double breadth,
                                double depth) {
    JoAgentDef def = jo_default_agent_def();
    JoError error;
    def.x = x;
    def.y = y;
    def.radius = 0.1;
    const JoAgent one = jo_world_add_agent(w, &def, &error);
    if (!one.generation)
        fail_msg("%s", error.text);
    JoxAgents *a = &w->state.agents;
    const uint32_t i = jox_world_find_agent(w, one);
    a->x[i] = a->prev_x[i] = (float)x;
    a->y[i] = a->prev_y[i] = (float)y;
    a->chest_x[i] = a->face_x[i] = (float)cos(angle);
    a->chest_y[i] = a->face_y[i] = (float)sin(angle);
    jo_agent_set_parameter(w, one, "breadth", breadth, NULL);
    jo_agent_set_parameter(w, one, "depth", depth, NULL);
    jox_nav_invalidate_order(w->scratch.nav);
    return one;
}

static inline JoWorld *open_world(double dt) {
    JoWorldDef def = jo_default_world_def();
    def.dt = dt;
    return jo_world_create(&def, NULL);
}

#endif
