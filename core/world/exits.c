#include "world/exits.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "geom/polygon.h"
#include "world/world.h"

struct JoxExit *jox_exits_get(JoxExits *exits, const char *name) {
    for (uint32_t e = 0; e < exits->count; e++)
        if (strcmp(exits->items[e].name, name) == 0)
            return &exits->items[e];
    JOX_RESERVE(exits->items, exits->capacity, exits->count + 1);
    struct JoxExit *exit = &exits->items[exits->count++];
    *exit = (struct JoxExit){.name = jox_strdup(name), .last = NAN};
    return exit;
}

uint32_t jox_exits_count(const void *exits, const char *place) {
    const JoxExits *of = exits;
    for (uint32_t e = 0; e < of->count; e++)
        if (strcmp(of->items[e].name, place) == 0)
            return of->items[e].people;
    return 0;
}

void jox_exits_free(JoxExits *exits) {
    for (uint32_t e = 0; e < exits->count; e++)
        jox_free(exits->items[e].name);
    jox_free(exits->items);
    *exits = (JoxExits){0};
}

static double get_time(const JoWorld *world) {
    return (double)world->state.tick * world->model.def.dt;
}

void jox_world_set_sinks(JoWorld *world, const JoxAgentSink *sinks, uint32_t count) {
    world->model.sinks = sinks;
    world->model.sink_count = count;
    for (uint32_t s = 0; s < count; s++) {
        const JoxPlace *of = &world->model.places[sinks[s].place];
        for (uint32_t m = 0; m < (jox_place_is_set(of) ? of->member_count : 1); m++)
            jox_exits_get(&world->state.exits, jox_place_is_set(of)
                                                   ? world->model.places[of->members[m]].name
                                                   : of->name);
    }
}

static void count_at_exit(JoWorld *world, const JoxPlace *place) {
    JOX_ASSERT(place->name);
    struct JoxExit *exit = jox_exits_get(&world->state.exits, place->name);
    exit->people++;
    exit->last = get_time(world);
}

/* Counts an agent that left at a point of a place. The exit of a set is its member. */
static void count_at_place(JoWorld *world, uint32_t place, JoxV2 at) {
    const JoxPlace *places = world->model.places, *of = &places[place];
    for (uint32_t m = 0; jox_place_is_set(of) && m < of->member_count; m++)
        if (jox_place_is_reached(places, (uint32_t)of->members[m], &world->model.all_walls, at)) {
            of = &places[of->members[m]];
            break;
        }
    count_at_exit(world, of);
}

static bool can_be_exit(const JoxPlace *place) {
    return !jox_place_is_set(place) && !jox_place_is_queue(place);
}

/* Counts agents that left by their behaviour: the exit is the smallest place that they stood in. */
static void count_departures(JoWorld *world) {
    for (uint32_t g = 0; g < world->scratch.departures.count; g++) {
        const JoxPlace *of = NULL;
        for (uint32_t p = 0; p < world->model.scene_places; p++) {
            const JoxPlace *place = &world->model.places[p];
            if (can_be_exit(place) &&
                jox_place_is_reached(world->model.places, p, &world->model.all_walls,
                                     world->scratch.departures.items[g]) &&
                (!of || jox_place_floor(place) < jox_place_floor(of)))
                of = place;
        }
        JOX_ASSERT(!of || !jox_place_is_set(of)); /* a member is the exit */
        if (of)
            count_at_exit(world, of);
    }
    if (world->state.statistics.removed > world->state.exits.left) {
        world->state.exits.left = world->state.statistics.removed;
        world->state.exits.last = get_time(world);
    }
}

static void empty_sinks(JoWorld *world) {
    JoxAgents *a = &world->state.agents;
    bool any = false;
    for (uint32_t s = 0; s < world->model.sink_count && world->state.tick % 4 == 0; s++) {
        const JoxAgentSink *sink = &world->model.sinks[s];
        JOX_ASSERT(sink->place < world->model.scene_places);
        for (uint32_t i = 0; i < a->count; i++) {
            if (a->removed[i] || (sink->group >= 0 && a->group[i] != sink->group))
                continue;
            if (!jox_place_is_reached(world->model.places, sink->place, &world->model.all_walls,
                                      (JoxV2){a->x[i], a->y[i]}))
                continue;
            count_at_place(world, sink->place, (JoxV2){a->x[i], a->y[i]});
            a->removed[i] = 1;
            any = true;
        }
    }
    if (any)
        world->state.statistics.removed += jox_agents_compact(a);
}

void jox_world_empty_sinks(JoWorld *world) {
    empty_sinks(world);
    count_departures(world);
}

void jox_exits_sections(JoxExits *exits, JoxSections *s) {
    jox_sections_module(s, "exits");
    JOX_SECTION(s, "left", exits->left);
    JOX_SECTION(s, "last", exits->last);
    const size_t count = jox_section_count(s, "count", exits->count, 1);
    if (s->mode == JOX_SECTIONS_RESTORE && !s->failed) {
        while (exits->count > count)
            jox_free(exits->items[--exits->count].name);
        JOX_RESERVE_ZEROED(exits->items, exits->capacity, count);
        while (exits->count < count)
            exits->items[exits->count++] = (struct JoxExit){0};
    }
    for (uint32_t e = 0; e < exits->count; e++) {
        jox_section_string(s, "name", &exits->items[e].name);
        JOX_SECTION(s, "people", exits->items[e].people);
        JOX_SECTION(s, "last_here", exits->items[e].last);
    }
}
