#include "world/world.h"

#include <math.h>
#include <string.h>

#include "base/guard.h"
#include "base/mem.h"

JoWorld *jox_world_create(const JoWorldDef *def) {
    JoWorld *world = jox_alloc(1, sizeof *world);
    world->def = *def;
    world->heap = jox_heap_used();
    world->pool = jox_pool_create(def->threads);
    world->nav = jox_nav_create();
    JoxForceOptions options = jox_force_default_options();
    options.literal = def->literal;
    world->forces = jox_forces_create(&options);
    JoxBodiesDef bodies = jox_bodies_def();
    bodies.gravity = def->gravity;
    world->bodies = jox_bodies_create(&bodies);
    world->mind.agents = &world->agents;
    world->mind.seed = def->seed;
    world->mind.dt = def->dt;
    world->mind.gravity = def->gravity;
    world->ways = jox_ways_create();
    world->walls_set = true;
    world->settled = true;
    return world;
}

static void free_places(JoWorld *world) {
    for (uint32_t i = 0; i < world->place_count; i++) {
        jox_free(world->places[i].name);
        jox_free(world->places[i].points);
        jox_free(world->places[i].members);
    }
    jox_free(world->places);
}

static void free_world(JoWorld *world) {
    jox_ways_free(world->ways);
    jox_mind_free(&world->mind);
    jox_nav_free(world->nav);
    jox_forces_free(world->forces);
    jox_bodies_free(world->bodies);
    jox_agents_free(&world->agents);
    jox_walls_free(&world->all_walls);
    jox_walls_free(&world->walls);
    jox_input_free(&world->input);
    jox_inspection_free(&world->inspection);
    jox_free(world->neighbours.index);
    jox_free(world->neighbours.distance2);
    jox_free(world->neighbours.count);
    jox_free(world->walked);
    jox_free(world->gone);
    jox_free(world->discs);
    jox_free(world->disc_agents);
    free_places(world);
    for (uint32_t i = 0; i < world->tag_count; i++)
        jox_free(world->tags[i]);
    jox_pool_free(world->pool);
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
    if (!world->owns_heap) {
        free_world(world);
        return;
    }
    JoxHeap *heap = world->heap;
    free_guarded(world); /* does nothing where memory ran out: the heap releases all of it */
    jox_heap_free(heap);
}

int jox_world_tag(JoWorld *world, const char *name) {
    for (uint32_t i = 0; i < world->tag_count; i++)
        if (strcmp(world->tags[i], name) == 0)
            return (int)i;
    if (world->tag_count == JOX_MOST_TAGS)
        return -1;
    world->tags[world->tag_count] = jox_strdup(name);
    return (int)world->tag_count++;
}

void jox_world_set_places(JoWorld *world, JoxPlace *places, uint32_t count) {
    free_places(world);
    world->places = places;
    world->place_count = count;
}

uint32_t jox_world_add_agent(JoWorld *world, float x, float y) {
    if (world->settled)
        world->first_unsettled = world->agents.next_id;
    world->settled = false;
    uint32_t i = jox_agents_add(&world->agents);
    JoxAgents *a = &world->agents;
    a->x[i] = a->prev_x[i] = a->still_x[i] = x;
    a->y[i] = a->prev_y[i] = a->still_y[i] = y;
    world->statistics.spawned++;
    return i;
}

/* Columns that carry state from one step to the next; the rest follows from them. */
static void hash_agent(JoxHash *hash, const JoxMind *mind, uint32_t i) {
    const JoxAgents *a = mind->agents;
    struct {
        uint32_t id, machine_state, entered, was_true, queued;
        int32_t goal, kicked, queue_at;
        float numbers[13];
    } row = {a->id[i],
             (uint32_t)a->machine[i] << 16 | a->state[i],
             a->entered[i],
             a->was_true[i],
             a->queued[i],
             a->goal[i],
             a->kicked[i],
             a->queue_at[i],
             {a->x[i], a->y[i], a->vx[i], a->vy[i], a->prev_x[i], a->prev_y[i], a->face_x[i],
              a->face_y[i], a->inferred_x[i], a->inferred_y[i], a->lasts[i], a->still[i],
              a->compression[i]}};
    jox_hash_add(hash, &row, sizeof row);
    for (int p = 0; p < JOX_PARAM_COUNT; p++)
        jox_hash_add(hash, &a->param[p][i], sizeof(float));
    if (a->machine[i] == JOX_NO_MACHINE)
        return;
    const JoxMachine *machine = mind->machines[a->machine[i]]; /* rows may be wider than it needs */
    if (machine->own_count)
        jox_hash_add(hash, a->own + (size_t)i * a->own_stride, machine->own_count * sizeof(double));
    if (machine->memory_count)
        jox_hash_add(hash, a->memory + (size_t)i * a->memory_stride,
                     machine->memory_count * sizeof(double));
}

uint64_t jox_world_hash(const JoWorld *world) {
    JoxHash hash = jox_hash_begin();
    jox_hash_add(&hash, &world->tick, sizeof world->tick);
    const JoxAgents *a = &world->agents;
    for (uint32_t rank = 0; rank < a->count; rank++)
        hash_agent(&hash, &world->mind, a->by_rank[rank]);
    jox_bodies_hash(world->bodies, &hash);
    JoxSections drags = jox_sections_hash();
    jox_drags_sections((JoxDrags *)&world->drags, &drags);
    const uint64_t dragged = jox_hash_end(&drags.hash);
    jox_hash_add(&hash, &dragged, sizeof dragged);
    if (world->mind.called_count) /* what will be heard in the next step */
        jox_hash_add(&hash, world->mind.called,
                     world->mind.called_count * sizeof *world->mind.called);
    if (world->mind.announced_count)
        jox_hash_add(&hash, world->mind.announced,
                     world->mind.announced_count * sizeof *world->mind.announced);
    for (uint32_t r = 0; r < world->all_walls.ring_count; r++)
        if (world->all_walls.rings[r].open)
            jox_hash_add(&hash, &r, sizeof r);
    return jox_hash_end(&hash);
}
