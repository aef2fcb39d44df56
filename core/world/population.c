#include "world/population.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "base/sort.h"
#include "geom/area.h"
#include "geom/polygon.h"
#include "geom/storey_text.h"
#include "nav/spots/spots.h"
#include "world/world.h"

const char *const jox_clothes_names[] = {
#define X(clothes, name) name,
    JOX_CLOTHES(X)
#undef X
};
const uint32_t jox_clothes_count = sizeof jox_clothes_names / sizeof *jox_clothes_names;

static const float FARTHEST_POINT = 1e6f; /* m: no plan is larger */

/* ---- one agent ---- */

/* Draws the machine of an agent from the mix of its group. */
static uint32_t pick_machine(const JoWorld *world, const JoxGroup *group, uint32_t id) {
    double u = jox_random_unit(world->model.def.seed, id, 0, JOX_DRAW_MIX, 0);
    JOX_ASSERT(group->mix_count > 0);
    for (uint32_t m = 0; m + 1 < group->mix_count; m++) {
        if (u < group->mix[m].weight)
            return group->mix[m].machine;
        u -= group->mix[m].weight;
    }
    return group->mix[group->mix_count - 1].machine;
}

/* Draws the profile of an agent; NULL if its group has none. */
static const JoxProfile *pick_profile(const JoWorld *world, const JoxGroup *group, uint32_t id) {
    double sum = 0.0;
    for (uint32_t p = 0; p < group->profile_count; p++)
        sum += group->profiles[p].share;
    double u = sum * jox_random_unit(world->model.def.seed, id, 0, JOX_DRAW_PROFILE, 0);
    for (uint32_t p = 0; p < group->profile_count; p++) {
        if (u < group->profiles[p].share || p + 1 == group->profile_count)
            return &group->profiles[p];
        u -= group->profiles[p].share;
    }
    return NULL;
}

static int32_t add_spot(JoWorld *world, JoxV2 at) {
    JOX_ASSERT(world->model.place_count < world->model.place_capacity);
    JoxPlace *place = &world->model.places[world->model.place_count];
    *place = (JoxPlace){
        .name = jox_strdup("antipode"), .points = jox_alloc(1, sizeof *place->points), .start = -1};
    jox_place_make_spot(place, at, 0.5f);
    jox_place_finish(place);
    return (int32_t)world->model.place_count++;
}

/* Adds the place of an agent that goes to the opposite side of its circle. */
static int32_t add_antipode(JoWorld *world, const JoxGroup *group, JoxV2 from) {
    return add_spot(world, (JoxV2){2 * group->centre.x - from.x, 2 * group->centre.y - from.y});
}

/* Values that a group sets, in the order of a machine's slots: as many as that has are valid. */
enum { MOST_PLACES = 16 };
typedef struct Overrides {
    const JoxDist *own[JOX_MOST_GIVEN], *memory[JOX_MOST_GIVEN];
    JoxDist places[MOST_PLACES];
    uint32_t place_count;
} Overrides;

static uint32_t limit_slots(uint32_t slots) {
    return slots < JOX_MOST_GIVEN ? slots : JOX_MOST_GIVEN;
}

static void override_memory(const JoxGroupValue *values, uint32_t count, uint32_t machine,
                            Overrides *o) {
    for (uint32_t v = 0; v < count; v++) {
        const uint16_t slot = values[v].slots[machine];
        if (slot > 0)
            o->memory[slot - 1] = &values[v].dist;
    }
}

static void override_own(JoWorld *world, const JoxGroup *group, const JoxGroupValue *values,
                         uint32_t count, uint32_t machine, JoxV2 at, Overrides *o) {
    for (uint32_t v = 0; v < count; v++) {
        const JoxGroupValue *set = &values[v];
        const uint16_t slot = set->slots[machine];
        if (slot == 0)
            continue;
        o->own[slot - 1] = &set->dist;
        if (set->kind != JOX_SET_NUMBER && o->place_count < MOST_PLACES) {
            int32_t place =
                set->kind == JOX_SET_PLACE ? set->place : add_antipode(world, group, at);
            o->places[o->place_count] = jox_dist_constant(place);
            o->own[slot - 1] = &o->places[o->place_count++];
        }
    }
}

/* Collects what the agent's group, its profile and `memory` set in place of the machine's values.
 */
static void collect_overrides(JoWorld *world, const JoxGroup *group, const JoxProfile *profile,
                              const JoxGroupValue *memory, uint32_t memory_count, uint32_t index,
                              JoxV2 at, Overrides *o) {
    const JoxMachine *machine = world->model.machines.items[index];
    o->place_count = 0;
    memset(o->own, 0, limit_slots(machine->own_count) * sizeof *o->own);
    memset(o->memory, 0, limit_slots(machine->memory_count) * sizeof *o->memory);
    override_own(world, group, group->set, group->set_count, index, at, o);
    if (profile)
        override_own(world, group, profile->set, profile->set_count, index, at, o);
    override_memory(group->memory, group->memory_count, index, o);
    override_memory(memory, memory_count, index, o); /* a source's, where it gives some */
}

/* Returns the team of a group's next agent: that of the group, or of its party. */
static uint32_t next_team(JoWorld *world, uint32_t number) {
    JoxPopulation *population = &world->state.population;
    const JoxWorldModel *model = &world->model;
    const JoxGroup *group = &model->groups[number];
    if (group->party < 2)
        return group->team_number;
    if (population->party_left[number] == 0) {
        uint32_t first = model->group_count + 1; /* lower numbers are teams of groups */
        population->party_team[number] =
            (first + population->next_party++ % (JOX_FIRST_SET_TEAM - first));
        population->party_left[number] = group->party;
    }
    JOX_ASSERT(population->party_team[number] > model->group_count);
    population->party_left[number]--;
    return population->party_team[number];
}

JoxBirth jox_world_birth(const JoWorld *world, uint32_t group, JoxV2 at) {
    const JoxGroup *of = &world->model.groups[group];
    return (JoxBirth){group, of->memory, of->memory_count, {.at = at}};
}

/* Lets an agent look, and its chest point, along a unit vector. */
static void set_facing(JoxAgents *a, uint32_t i, JoxV2 along) {
    a->face_x[i] = a->chest_x[i] = along.x;
    a->face_y[i] = a->chest_y[i] = along.y;
}

/* Gives an agent with a machine the properties of its group. */
static void join_group(JoWorld *world, uint32_t i, uint32_t number) {
    const JoxGroup *group = &world->model.groups[number];
    JoxAgents *a = &world->state.agents;
    if (a->group[i] != number)
        a->group[i] = (uint16_t)number;
    a->team[i] = (uint16_t)next_team(world, number);
    a->tags[i] |= group->tag_bits;
    if (isfinite(group->facing))
        set_facing(a, i, (JoxV2){(float)jox_cos(group->facing), (float)jox_sin(group->facing)});
}

JoxBirthSpot jox_world_spawn(JoWorld *world, JoxBirth *birth, uint32_t *agent) {
    const JoxGroup *group = &world->model.groups[birth->group];
    JoxBirthWish *wish = &birth->wish;
    const uint32_t id = world->state.agents.next_id, places = world->model.place_count;
    const uint32_t index = pick_machine(world, group, id);
    JOX_ASSERT(index < world->model.machines.count);
    Overrides set;
    collect_overrides(world, group, pick_profile(world, group, id), birth->memory,
                      birth->memory_count, index, wish->at, &set);
    wish->radius = jox_machines_birth_radius(&world->machines, id, index, set.own);
    JoxV2 spot;
    jox_world_apply_walls(world);
    const JoxBirthSpot found =
        jox_nav_find_birth(world->scratch.nav, &world->state.agents, wish, &spot);
    if (!jox_birth_succeeds(found)) {
        while (world->model.place_count > places) /* places of the agent: see add_antipode */
            jox_place_free(&world->model.places[--world->model.place_count]);
        return found;
    }
    const uint32_t i = *agent = jox_world_add_agent(world, spot.x, spot.y);
    join_group(world, i, birth->group);
    world->machines.tick = (uint32_t)world->state.tick;
    world->machines.places = world->model.places;
    world->machines.place_count = world->model.place_count;
    jox_machines_spawn(&world->machines, i, index, set.own, set.memory);
    JOX_ASSERT(world->state.agents.id[i] == id);
    JOX_ASSERT(jox_param(&world->state.agents, JOX_PARAM_radius, i) == wish->radius);
    jox_nav_note_birth(world->scratch.nav, &world->state.agents, i);
    world->state.statistics.shifted_at_birth += found == JOX_BIRTH_SHIFTED;
    return found;
}

JoxBirthSpot jox_world_spawn_at(JoWorld *world, uint32_t group, JoxV2 at, uint32_t *agent) {
    JOX_ASSERT(group < world->model.group_count);
    JoxBirth birth = jox_world_birth(world, group, at);
    return jox_world_spawn(world, &birth, agent);
}

void jox_world_explain_unplaced(const JoxStoreys *storeys, JoxBirthSpot spot, JoxV2 at,
                                JoxText *out) {
    JoxText where = {0};
    const JoxV2 plan = jox_in_plan(storeys, at);
    jox_text_printf(&where, "(%g, %g)", (double)plan.x, (double)plan.y);
    jox_text_storey(&where, storeys, at);
    if (spot == JOX_BIRTH_IN_SOLID)
        jox_text_printf(out, "%s lies in a wall", where.data);
    else if (spot == JOX_BIRTH_NOT_FOUND)
        jox_text_printf(out,
                        "the search for a free spot near %s was ended, as %d spots had been "
                        "looked at",
                        where.data, JOX_SPOTS_MOST);
    else
        jox_text_printf(out, "there is no free spot within 25 m of %s on its side of all walls",
                        where.data);
    jox_text_free(&where);
}

/* ---- starts ---- */

/* Distance to another agent, in its radii, below which no agent enters: nav/placement.c would shift
   it. */
static const float CLEAR = 1.5f;

static int compare_times(const void *left, const void *right, const void *context) {
    const JoxStart *a = left, *b = right;
    (void)context;
    return a->time < b->time ? -1 : a->time > b->time;
}

/* Lists the starts of all groups after 0 s, ordered by time. */
static void list_starts(JoWorld *world) {
    JoxWorldModel *model = &world->model;
    uint32_t count = 0;
    JOX_ASSERT(!model->starts && model->start_count == 0);
    for (uint32_t g = 0; g < model->group_count; g++)
        if (model->groups[g].starts)
            count += model->groups[g].start_count - model->groups[g].count;
    if (count == 0)
        return;
    model->starts = jox_alloc(count, sizeof *model->starts);
    for (uint32_t g = 0; g < model->group_count; g++)
        for (uint32_t s = model->groups[g].count; s < model->groups[g].start_count; s++) {
            model->starts[model->start_count] = model->groups[g].starts[s];
            model->starts[model->start_count++].group = g;
        }
    JOX_ASSERT(model->start_count == count);
    jox_sort(model->starts, count, sizeof *model->starts, compare_times, NULL, NULL);
    world->state.population.entered = jox_alloc(count, sizeof *world->state.population.entered);
}

/* Sets velocity and facing of an agent; NAN changes nothing. */
static void set_velocity(JoWorld *world, uint32_t agent, JoxV2 velocity) {
    JoxAgents *a = &world->state.agents;
    JOX_ASSERT(agent < a->count);
    if (!isfinite(velocity.x))
        return;
    a->vx[agent] = velocity.x;
    a->vy[agent] = velocity.y;
    const float speed = jox_length(velocity);
    if (speed < 1e-3f)
        return;
    set_facing(a, agent, (JoxV2){velocity.x / speed, velocity.y / speed});
}

static bool is_point_free(const JoxAgents *a, JoxV2 at) {
    for (uint32_t i = 0; i < a->count; i++) {
        const float least = CLEAR * jox_param(a, JOX_PARAM_radius, i);
        if (jox_length2(jox_sub(at, jox_v2(a->x[i], a->y[i]))) < least * least)
            return false;
    }
    return true;
}

/* Gives up a start in a wall, with a message. */
static void give_up_start(JoWorld *world, const JoxStart *start) {
    const JoxGroup *group = &world->model.groups[start->group];
    JoxText *news = &world->scratch.messages;
    world->state.statistics.not_placed++;
    jox_text_printf(news, "%s:%d:%d: t = %.2f s: a person of group '%.60s' is not placed: ",
                    group->position.file, group->position.line, group->position.column,
                    (double)world->state.tick * world->model.def.dt, group->name);
    jox_world_explain_unplaced(&world->model.storeys, JOX_BIRTH_IN_SOLID, start->at, news);
    jox_text_add(news, "\n");
}

void jox_world_spawn_due_starts(JoWorld *world) {
    const JoxWorldModel *model = &world->model;
    JoxPopulation *p = &world->state.population;
    const double time = (double)world->state.tick * model->def.dt + 1e-9;
    for (uint32_t s = p->all_until; s < model->start_count && model->starts[s].time <= time; s++) {
        const JoxStart *start = &model->starts[s];
        if (p->entered[s] || !is_point_free(&world->state.agents, start->at))
            continue;
        uint32_t agent;
        const JoxBirthSpot spot = jox_world_spawn_at(world, start->group, start->at, &agent);
        if (spot == JOX_BIRTH_NO_ROOM || spot == JOX_BIRTH_NOT_FOUND)
            continue;
        if (spot == JOX_BIRTH_IN_SOLID)
            give_up_start(world, start);
        else
            set_velocity(world, agent, start->velocity);
        p->entered[s] = 1;
    }
    while (p->all_until < model->start_count && p->entered[p->all_until])
        p->all_until++;
}

uint32_t jox_world_starts_waiting(const JoWorld *world, uint32_t group) {
    const JoxWorldModel *model = &world->model;
    const JoxPopulation *p = &world->state.population;
    const double last =
        ((double)world->state.tick - 1.0) * model->def.dt + 1e-9; /* start of the last step */
    uint32_t waiting = 0;
    for (uint32_t s = p->all_until; s < model->start_count && model->starts[s].time <= last; s++)
        waiting += !p->entered[s] && model->starts[s].group == group;
    return waiting;
}

/* ---- model and state ---- */

void jox_world_set_groups(JoWorld *world, const JoxGroup *groups, uint32_t count) {
    JoxWorldModel *model = &world->model;
    JoxPopulation *p = &world->state.population;
    JOX_ASSERT(!model->groups || count == model->group_count);
    if (!p->party_left) {
        p->party_left = jox_alloc((size_t)count + 1, sizeof *p->party_left);
        p->party_team = jox_alloc((size_t)count + 1, sizeof *p->party_team);
    }
    model->groups = groups;
    model->group_count = count;
}

static bool area_contains(const void *area, JoxV2 spot) {
    return jox_area_contains(area, spot);
}

/* Makes the agents of one group, and returns how they were placed. */
static JoxPlaced place_group(JoWorld *world, uint32_t number) {
    const JoxGroup *group = &world->model.groups[number];
    const JoxArea area = {.places = world->model.places,
                          .in = group->in,
                          .out = group->outside,
                          .storeys = &world->model.storeys,
                          .in_count = group->in_count,
                          .out_count = group->outside_count};
    JoxAreaIndex *index = group->in_count ? jox_area_index(&area) : NULL;
    JoxPlaced placed = {0};
    for (uint32_t i = 0; i < group->count; i++) {
        JoxBirth birth = jox_world_birth(world, number, group->positions[i]);
        JoxBirthWish *wish = &birth.wish;
        if (index && jox_area_extent(&area, &wish->low, &wish->high)) {
            wish->contains = area_contains;
            wish->place = index;
            wish->place_number = number + 1;
            wish->stays = true;
        }
        uint32_t agent = JOX_NO_INDEX;
        const JoxBirthSpot spot = jox_world_spawn(world, &birth, &agent);
        placed.in_solid += spot == JOX_BIRTH_IN_SOLID;
        placed.not_found += spot == JOX_BIRTH_NOT_FOUND;
        if (agent == JOX_NO_INDEX) {
            placed.first = placed.not_placed++ ? placed.first : i;
            continue;
        }
        const JoxAgents *a = &world->state.agents;
        const JoxV2 way = jox_sub(jox_v2(a->x[agent], a->y[agent]), group->positions[i]);
        placed.shifted += spot == JOX_BIRTH_SHIFTED;
        placed.farthest = jox_maxf(placed.farthest, jox_length(way));
        if (group->starts)
            set_velocity(world, agent, group->starts[i].velocity);
    }
    if (index)
        jox_area_index_free(index);
    world->state.statistics.not_placed += placed.not_placed;
    return placed;
}

void jox_world_populate(JoWorld *world, JoxPlaced *placed) {
    const JoxWorldModel *p = &world->model;
    uint32_t total = 0;
    for (uint32_t g = 0; g < p->group_count; g++)
        total += p->groups[g].count;
    jox_agents_reserve(&world->state.agents, total);
    jox_agents_reserve_slots(&world->state.agents, total);
    for (uint32_t g = 0; g < p->group_count; g++)
        placed[g] = place_group(world, g);
    JOX_ASSERT(world->state.agents.count <= total);
    list_starts(world);
}

/* Lists the places of single agents by their points. */
static void list_points(JoWorld *world, JoxSections *s) {
    const uint32_t first = world->model.scene_places;
    const size_t count =
        jox_section_count(s, "points", world->model.place_count - first, sizeof(JoxV2));
    if (count > world->model.place_capacity - first)
        jox_sections_fail(s, "points", "there are more places of single agents than agents");
    if (s->failed)
        return;
    JoxV2 *points = jox_alloc(count + 1, sizeof *points);
    for (uint32_t p = 0; p < count && first + p < world->model.place_count; p++)
        points[p] = world->model.places[first + p].points[0];
    jox_section(s, "points", points, sizeof *points, count);
    for (size_t p = 0; s->mode == JOX_SECTIONS_RESTORE && p < count; p++)
        if (!(fabsf(points[p].x) <= FARTHEST_POINT && fabsf(points[p].y) <= FARTHEST_POINT))
            jox_sections_fail(s, "points", "a place of a single agent is nowhere");
    if (s->mode == JOX_SECTIONS_RESTORE && !s->failed) {
        while (world->model.place_count > first)
            jox_place_free(&world->model.places[--world->model.place_count]);
        for (uint32_t p = 0; p < count; p++)
            add_spot(world, points[p]);
    }
    jox_free(points);
}

void jox_population_sections(JoWorld *world, JoxSections *s) {
    JoxPopulation *p = &world->state.population;
    jox_sections_module(s, "population");
    jox_section(s, "party_left", p->party_left, sizeof *p->party_left, world->model.group_count);
    jox_section(s, "party_team", p->party_team, sizeof *p->party_team, world->model.group_count);
    JOX_SECTION(s, "next_party", p->next_party);
    jox_section(s, "entered", p->entered, sizeof *p->entered, world->model.start_count);
    JOX_SECTION(s, "all_until", p->all_until);
    list_points(world, s);
}
