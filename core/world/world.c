#include "world/world.h"

#include <math.h>
#include <string.h>

#include "agents/stair_law.h"
#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "simd/isa.h"
#include "task/processors.h"

JoWorld *jox_world_create(const JoWorldDef *def) {
    JoWorld *world = jox_alloc(1, sizeof *world);
    world->model.def = *def;
    world->model.def.isa = jox_isa_resolve(def->isa);
    world->model.walking = jox_walk_law();
    world->heap = jox_heap_used();
    world->scratch.pool = jox_pool_create(def->threads ? def->threads : jox_count_processors());
    jox_pool_set_jobs(world->scratch.pool, def->jobs);
    world->scratch.nav = jox_nav_create(&world->model.walking);
    jox_nav_set_literal(world->scratch.nav, def->literal);
    jox_nav_set_isa(world->scratch.nav, world->model.def.isa);
    jox_nav_set_memory(world->scratch.nav, &world->scratch.memory);
    JoxForceOptions options = jox_force_default_options();
    options.literal = def->literal;
    world->scratch.forces = jox_forces_create(&options);
    jox_forces_set_isa(world->scratch.forces, world->model.def.isa);
    jox_forces_set_memory(world->scratch.forces, &world->scratch.memory);
    JoxBodiesDef bodies = jox_bodies_def();
    bodies.gravity = def->gravity;
    bodies.lost = def->lost_bodies;
    world->state.bodies = jox_bodies_create(&bodies);
    world->machines.set = &world->model.machines;
    world->machines.count_left = jox_exits_count;
    world->machines.exits = &world->state.exits;
    world->machines.state = &world->state.machines;
    world->machines.agents = &world->state.agents;
    world->machines.seed = def->seed;
    world->machines.dt = def->dt;
    world->machines.gravity = def->gravity;
    world->machines.isa = world->model.def.isa;
    world->machines.walls = &world->model.all_walls;
    world->machines.wall_images = &world->scratch.images_only;
    world->state.routes = jox_routes_create();
    world->state.walls_applied = true;
    return world;
}

void jox_world_set_walking(JoWorld *world, const JoxWalkLaw *law) {
    JOX_ASSERT(world->state.tick == 0);
    world->model.walking = *law;
}

/* Sets how slow people are on each flight, for the distance fields. */
static void slow_flights(JoxStoreys *storeys) {
    for (uint32_t f = 0; f < storeys->flight_count; f++) {
        JoxFlight *flight = &storeys->flights[f];
        const float belt = storeys->stairs[flight->stair].belt;
        for (int way = 0; way < 2; way++)
            flight->slowness[way] = belt != 0.0f ? jox_belt_slowness(flight->slope, belt)
                                                 : jox_stair_slowness(flight->slope, way == 0);
    }
}

void jox_world_set_storeys(JoWorld *world, const JoxStoreys *storeys) {
    JOX_ASSERT(world->state.tick == 0 && world->model.storeys.storey_count == 0);
    jox_storeys_copy(&world->model.storeys, storeys);
    slow_flights(&world->model.storeys);
    world->state.agents.flights = storeys->flight_count ? &world->model.storeys : NULL;
    if (!jox_has_storeys(&world->model.storeys))
        return;
    world->state.agents.storeys = &world->model.storeys;
    world->state.agents.pitch = storeys->pitch;
    jox_bodies_set_sheets(world->state.bodies, storeys->origin, storeys->pitch);
}

void jox_world_set_timed(JoWorld *world, bool timed) {
    world->scratch.timed = timed;
    jox_bodies_set_timed(world->state.bodies, timed);
}

static void free_places(JoWorld *world) {
    for (uint32_t i = 0; i < world->model.place_count; i++)
        jox_place_free(&world->model.places[i]);
    jox_free(world->model.places);
}

static void free_world(JoWorld *world) {
    jox_routes_free(world->state.routes);
    jox_machines_free(&world->machines);
    jox_nav_free(world->scratch.nav);
    jox_forces_free(world->scratch.forces);
    jox_stage_memory_free(&world->scratch.memory);
    jox_bodies_free(world->state.bodies);
    jox_agents_free(&world->state.agents);
    jox_walls_free(&world->model.all_walls);
    jox_storeys_free(&world->model.storeys);
    jox_walls_free(&world->scratch.walls);
    jox_walls_free(&world->scratch.dividing);
    jox_wall_images_free(&world->scratch.images);
    jox_free(world->state.added_walls);
    jox_input_free(&world->state.input);
    jox_inspection_free(&world->scratch.inspection);
    jox_neighbours_free(&world->scratch.neighbours);
    jox_objects_free_grid(&world->scratch.objects);
    jox_free(world->scratch.walked);
    jox_falls_free(&world->scratch.falls);
    jox_free(world->scratch.departures.items);
    jox_step_events_free(&world->scratch.step_events);
    jox_free(world->scratch.discs.discs);
    jox_free(world->scratch.discs.agents);
    jox_hands_free(&world->scratch.hands);
    jox_lifts_free(world);
    free_places(world);
    jox_entrances_clear(&world->scratch.entrances);
    jox_free(world->state.sources.arrivals);
    jox_free(world->state.sources.made);
    jox_free(world->state.sources.figures);
    jox_free(world->state.population.party_left);
    jox_free(world->state.population.party_team);
    jox_free(world->state.population.entered);
    jox_free(world->model.starts);
    jox_exits_free(&world->state.exits);
    jox_text_free(&world->scratch.messages);
    jox_free(world->scratch.lost.ids);
    for (uint32_t i = 0; i < world->model.tag_count; i++)
        jox_free(world->model.tags[i]);
    for (uint32_t i = 0; i < world->model.set_team_count; i++)
        jox_free(world->model.set_teams[i]);
    jox_pool_free(world->scratch.pool);
    jox_free(world);
}

static void free_guarded(JoWorld *world) {
    JOX_GUARD (world->heap, NULL)
        return;
    free_world(world);
}

void jo_world_free(JoWorld *world) {
    if (!world)
        return;
    JOX_REQUIRE(!world->busy, );
    if (!world->owns_heap) {
        free_world(world);
        return;
    }
    JoxHeap *heap = world->heap;
    free_guarded(world); /* does nothing where memory ran out: the heap releases all of it */
    jox_heap_free(heap);
}

int jox_world_add_team(JoWorld *world, const char *name) {
    JoxWorldModel *model = &world->model;
    for (uint32_t i = 0; i < model->set_team_count; i++)
        if (strcmp(model->set_teams[i], name) == 0)
            return JOX_FIRST_SET_TEAM + (int)i;
    if (model->set_team_count == JOX_MOST_SET_TEAMS)
        return -1;
    model->set_teams[model->set_team_count] = jox_strdup(name);
    return JOX_FIRST_SET_TEAM + (int)model->set_team_count++;
}

int jox_world_add_tag(JoWorld *world, const char *name) {
    for (uint32_t i = 0; i < world->model.tag_count; i++)
        if (strcmp(world->model.tags[i], name) == 0)
            return (int)i;
    if (world->model.tag_count == JOX_MOST_TAGS)
        return -1;
    world->model.tags[world->model.tag_count] = jox_strdup(name);
    return (int)world->model.tag_count++;
}

void jox_world_set_places(JoWorld *world, JoxPlace *places, uint32_t count, uint32_t capacity) {
    JOX_ASSERT(count <= capacity);
    free_places(world);
    world->model.places = places;
    world->model.place_count = world->model.scene_places = count;
    world->model.place_capacity = capacity;
}

uint32_t jox_world_add_agent(JoWorld *world, float x, float y) {
    uint32_t i = jox_agents_add_alike(&world->state.agents);
    JoxAgents *a = &world->state.agents;
    a->x[i] = a->prev_x[i] = a->still_x[i] = x;
    a->y[i] = a->prev_y[i] = a->still_y[i] = y;
    world->state.statistics.spawned++;
    return i;
}

JoAgent jox_world_agent_handle(const JoWorld *world, uint32_t index) {
    uint32_t slot = world->state.agents.slot[index];
    JOX_ASSERT(world->state.agents.slot_index[slot] == index);
    JOX_ASSERT(world->state.agents.slot_generation[slot] > 0); /* 0 is no agent */
    return (JoAgent){slot, world->state.agents.slot_generation[slot]};
}

uint32_t jox_world_find_agent(const JoWorld *world, JoAgent agent) {
    const JoxAgents *a = &world->state.agents;
    if (jox_heap_has_failed(world->heap) || agent.generation == 0 || agent.slot >= a->slot_count ||
        a->slot_generation[agent.slot] != agent.generation)
        return JOX_NO_INDEX;
    return a->slot_index[agent.slot];
}

uint32_t jox_world_find_body(const JoWorld *world, JoBody body) {
    if (jox_heap_has_failed(world->heap) || body.generation == 0 ||
        jox_bodies_id(world->state.bodies, body.slot) != body.generation - 1)
        return JOX_NO_BODY;
    return body.slot;
}
