/* Agents of a scene: groups at the start, sources and sinks as time goes on. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/elementary.h"
#include "base/mem.h"
#include "run/run.h"

enum { AT_ONCE = 256 }; /* agents that one source makes in a step at most */

static uint32_t machine_index(const JoxMachineRun *machines, const char *path) {
    for (uint32_t m = 0; m < machines->set->count; m++)
        if (strcmp(machines->set->items[m]->path, path) == 0)
            return m;
    return 0;
}

/* Which behaviour of a mix an agent gets. */
static uint32_t pick_machine(const JoScene *scene, const JoxSceneGroup *group, uint32_t id) {
    double u = jox_random_unit(scene->world->model.def.seed, id, 0, JOX_DRAW_MIX, 0);
    for (uint32_t m = 0; m + 1 < group->mix_count; m++) {
        if (u < group->mix[m].weight)
            return machine_index(&scene->world->machines, group->mix[m].behaviour);
        u -= group->mix[m].weight;
    }
    return machine_index(&scene->world->machines, group->mix[group->mix_count - 1].behaviour);
}

/* A place of its own for an agent that is bound for the opposite side of its circle. */
static int32_t add_antipode(JoScene *scene, const JoxSceneGroup *group, JoxV2 from) {
    JoWorld *world = scene->world;
    JOX_ASSERT(world->model.place_count < scene->place_capacity);
    JoxPlace *place = &world->model.places[world->model.place_count];
    JoxV2 to = {2 * group->centre.x - from.x, 2 * group->centre.y - from.y};
    *place = (JoxPlace){.name = jox_strdup("antipode"),
                        .kind = JOX_PLACE_POINT,
                        .points = jox_alloc(1, sizeof *place->points),
                        .count = 1,
                        .radius = 0.5f,
                        .start = -1};
    place->points[0] = to;
    jox_place_finish(place);
    return (int32_t)world->model.place_count++;
}

/* Values that a group sets, in the order of a machine's slots. */
typedef struct Overrides {
    const JoxDist *own[256], *memory[256];
    JoxDist place; /* of an antipode */
    JoxDist places[16];
} Overrides;

static void remember(const JoxSceneSet *memory, uint32_t count, const JoxMachine *machine,
                     Overrides *o) {
    for (uint32_t s = 0; s < count; s++)
        for (uint32_t k = 0; k < machine->memory_count && k < 256; k++)
            if (strcmp(machine->memory[k].name, memory[s].name) == 0)
                o->memory[k] = &memory[s].dist;
}

static void override(JoScene *scene, const JoxSceneGroup *group, const JoxSceneSet *memory,
                     uint32_t memory_count, const JoxMachine *machine, JoxV2 at, Overrides *o) {
    uint32_t places = 0;
    memset(o->own, 0, sizeof o->own);
    memset(o->memory, 0, sizeof o->memory);
    for (uint32_t s = 0; s < group->set_count; s++)
        for (uint32_t k = 0; k < machine->own_count && k < 256; k++) {
            const JoxSceneSet *set = &group->set[s];
            if (strcmp(machine->own[k].name, set->name) != 0)
                continue;
            o->own[k] = &set->dist;
            if (set->kind != JOX_SET_NUMBER && places < 16) {
                int32_t place =
                    set->kind == JOX_SET_PLACE ? set->place : add_antipode(scene, group, at);
                o->places[places] = jox_dist_constant(place);
                o->own[k] = &o->places[places++];
            }
        }
    remember(group->memory, group->memory_count, machine, o);
    remember(memory, memory_count, machine, o); /* a source's, where it gives some */
}

static uint16_t team_number(const JoScene *scene, const char *team) {
    if (!team)
        return 0;
    for (uint32_t g = 0; g < scene->spec->group_count; g++)
        if (scene->spec->groups[g].team && strcmp(scene->spec->groups[g].team, team) == 0)
            return (uint16_t)(g + 1); /* the first group of the team gives its number */
    return 0;
}

/* The team of a group's next agent: the group's, or its party's own. */
static uint16_t next_team(JoScene *scene, uint32_t number) {
    const JoxSceneSpec *spec = scene->spec;
    const JoxSceneGroup *group = &spec->groups[number];
    if (group->party < 2)
        return team_number(scene, group->team);
    if (!scene->party_left) {
        scene->party_left = jox_alloc(spec->group_count, sizeof *scene->party_left);
        scene->party_team = jox_alloc(spec->group_count, sizeof *scene->party_team);
    }
    if (scene->party_left[number] == 0) {
        uint32_t first = spec->group_count + 1; /* teams of groups come before */
        scene->party_team[number] = (uint16_t)(first + scene->next_party++ % (65535 - first));
        scene->party_left[number] = group->party;
    }
    scene->party_left[number]--;
    return scene->party_team[number];
}

static void spawn(JoScene *scene, uint32_t number, JoxV2 at, const JoxSceneSet *memory,
                  uint32_t memory_count) {
    const JoxSceneGroup *group = &scene->spec->groups[number];
    JoWorld *world = scene->world;
    uint32_t i = jox_world_add_agent(world, at.x, at.y);
    JoxAgents *a = &world->state.agents;
    a->group[i] = (uint16_t)number;
    a->team[i] = next_team(scene, number);
    for (uint32_t t = 0; t < group->tag_count; t++)
        a->tags[i] |= (uint64_t)1 << jox_world_tag(world, group->tags[t]);
    if (isfinite(group->facing)) {
        a->face_x[i] = (float)jox_cos(group->facing);
        a->face_y[i] = (float)jox_sin(group->facing);
    }
    uint32_t index = pick_machine(scene, group, a->id[i]);
    Overrides *o = &(Overrides){0};
    override(scene, group, memory, memory_count, world->model.machines.items[index], at, o);
    world->machines.tick = (uint32_t)world->state.tick;
    world->machines.places = world->model.places;
    world->machines.place_count = world->model.place_count;
    jox_machines_spawn(&world->machines, i, index, o->own, o->memory);
}

/* Names that a group sets must be known to every behaviour of its mix. */
static void check_names(const JoScene *scene, const JoxSceneGroup *group, const JoxSceneSet *sets,
                        uint32_t count, bool memory, JoxDiagnostics *diagnostics) {
    for (uint32_t m = 0; m < group->mix_count; m++) {
        const JoxMachineRun *machines = &scene->world->machines;
        const JoxMachine *machine =
            machines->set->items[machine_index(machines, group->mix[m].behaviour)];
        const char *names[256];
        uint32_t known = memory ? machine->memory_count : machine->own_count;
        known = known < 256 ? known : 256;
        for (uint32_t k = 0; k < known; k++)
            names[k] = memory ? machine->memory[k].name : machine->own[k].name;
        for (uint32_t s = 0; s < count; s++) {
            int32_t slot = -1;
            for (uint32_t k = 0; k < known; k++)
                slot = strcmp(names[k], sets[s].name) == 0 ? (int32_t)k : slot;
            bool place = sets[s].kind != JOX_SET_NUMBER;
            const char *near = slot < 0 ? jox_suggest(sets[s].name, names, known) : NULL;
            char hint[96] = "";
            if (near)
                strcat(strcat(strcpy(hint, "Did you mean '"), near), "'?");
            if (slot < 0)
                jox_diag_error(diagnostics, sets[s].position, "unknown-value", near ? hint : NULL,
                               "behaviour %s has no '%.60s'%s", machine->name, sets[s].name,
                               memory ? " in memory" : "");
            else if (!memory && machine->own[slot].is_place != place)
                jox_diag_error(diagnostics, sets[s].position, "bad-type", NULL,
                               "'%.60s' of behaviour %s is a %s", sets[s].name, machine->name,
                               place ? "number" : "place");
        }
    }
}

/* Every exit of the scene, before anybody has left. */
static void name_exits(JoScene *scene) {
    const JoxSceneSpec *spec = scene->spec;
    for (uint32_t s = 0; s < spec->sink_count; s++) {
        const JoxPlace *of = &spec->places[spec->sinks[s].place];
        for (uint32_t m = 0; m < (of->kind == JOX_PLACE_SET ? of->member_count : 1); m++)
            jox_exits_get(&scene->exits,
                          of->kind == JOX_PLACE_SET ? spec->places[of->members[m]].name : of->name);
    }
}

bool jox_run_populate(JoScene *scene, JoxDiagnostics *diagnostics) {
    const JoxSceneSpec *spec = scene->spec;
    uint32_t total = 0;
    for (uint32_t g = 0; g < spec->group_count; g++) {
        const JoxSceneGroup *group = &spec->groups[g];
        check_names(scene, group, group->set, group->set_count, false, diagnostics);
        check_names(scene, group, group->memory, group->memory_count, true, diagnostics);
        total += group->count;
    }
    for (uint32_t s = 0; s < spec->source_count; s++)
        check_names(scene, &spec->groups[spec->sources[s].like], spec->sources[s].memory,
                    spec->sources[s].memory_count, true, diagnostics);
    if (diagnostics->errors)
        return false;
    jox_agents_reserve(&scene->world->state.agents, total);
    scene->spawned = jox_alloc(spec->source_count + 1, sizeof *scene->spawned);
    name_exits(scene);
    for (uint32_t g = 0; g < spec->group_count; g++)
        for (uint32_t i = 0; i < spec->groups[g].count; i++)
            spawn(scene, g, spec->groups[g].positions[i], spec->groups[g].memory,
                  spec->groups[g].memory_count);
    return true;
}

/* A point of a place, drawn for a source. */
static JoxV2 draw_point(const JoScene *scene, uint32_t source, uint32_t n) {
    const JoWorld *world = scene->world;
    const JoxPlace *place = &world->model.places[scene->spec->sources[source].place];
    JoxV2 low = place->centre, high = place->centre;
    if (place->kind != JOX_PLACE_POINT)
        jox_bounds(place->points, place->count, &low, &high);
    for (uint32_t attempt = 0; attempt < 64; attempt++) {
        uint32_t sub = (n * 64 + attempt) * 2;
        double u =
            jox_random_unit(world->model.def.seed, source, world->state.tick, JOX_DRAW_SOURCE, sub);
        double v = jox_random_unit(world->model.def.seed, source, world->state.tick,
                                   JOX_DRAW_SOURCE, sub + 1);
        if (place->kind == JOX_PLACE_LINE || place->kind == JOX_PLACE_QUEUE)
            return jox_add(place->points[0],
                           jox_scale(jox_sub(place->points[1], place->points[0]), (float)u));
        JoxV2 p = {low.x + (high.x - low.x) * (float)u, low.y + (high.y - low.y) * (float)v};
        if (place->kind == JOX_PLACE_POINT) {
            double angle = 6.283185307179586 * u, r = place->radius * sqrt(v);
            return (JoxV2){place->centre.x + (float)(r * jox_cos(angle)),
                           place->centre.y + (float)(r * jox_sin(angle))};
        }
        if (jox_polygon_contains(place->points, place->count, p))
            return p;
    }
    return place->centre;
}

/* How many agents a source owes now. A kept number is looked after once a second. */
static uint32_t owed(JoScene *scene, uint32_t s) {
    const JoxSceneSource *source = &scene->spec->sources[s];
    const JoWorld *world = scene->world;
    double time = (double)world->state.tick * world->model.def.dt;
    if (time < source->from || time >= source->until)
        return 0;
    double due = floor(source->rate * (time - source->from)) - scene->spawned[s];
    uint64_t second = (uint64_t)(1.0 / world->model.def.dt + 0.5);
    if (source->keep > 0 && world->state.tick % second == 0) {
        uint32_t present = 0;
        for (uint32_t i = 0; i < world->state.agents.count; i++)
            present += world->state.agents.group[i] == source->like;
        due += present < source->keep ? source->keep - present : 0;
    }
    return due <= 0.0 ? 0 : due > AT_ONCE ? AT_ONCE : (uint32_t)due;
}

void jox_run_sources(JoScene *scene) {
    for (uint32_t s = 0; s < scene->spec->source_count; s++) {
        const JoxSceneSource *source = &scene->spec->sources[s];
        const JoxSceneGroup *group = &scene->spec->groups[source->like];
        uint32_t count = owed(scene, s);
        for (uint32_t n = 0; n < count; n++)
            spawn(scene, source->like, draw_point(scene, s, n),
                  source->memory_count ? source->memory : group->memory,
                  source->memory_count ? source->memory_count : group->memory_count);
        if (source->rate > 0)
            scene->spawned[s] += count;
    }
}

static void count_at(JoScene *scene, const JoxPlace *place) {
    struct JoxExit *exit = jox_exits_get(&scene->exits, place->name);
    exit->people++;
    exit->last = jo_world_time(scene->world);
}

/* Counts somebody who left at a point of a place: a set's member is the exit, not the set. */
static void count_exit(JoScene *scene, uint32_t place, JoxV2 at) {
    const JoxPlace *places = scene->world->model.places, *of = &places[place];
    for (uint32_t m = 0; of->kind == JOX_PLACE_SET && m < of->member_count; m++)
        if (jox_place_contains(places, (uint32_t)of->members[m], at)) {
            of = &places[of->members[m]];
            break;
        }
    count_at(scene, of);
}

/* Roughly, m2; what cannot be an exit: infinite. */
static double size_of(const JoxPlace *place) {
    switch (place->kind) {
    case JOX_PLACE_POINT:
        return 3.14159 * (double)place->radius * place->radius;
    case JOX_PLACE_LINE:
        return jox_length(jox_sub(place->points[1], place->points[0]));
    case JOX_PLACE_POLYGON:
        return fabs(jox_polygon_area(place->points, place->count));
    default:
        return INFINITY;
    }
}

/* Who left where a behaviour said so left by the smallest place that they stood in. */
void jox_run_leavers(JoScene *scene) {
    const JoWorld *world = scene->world;
    for (uint32_t g = 0; g < world->scratch.gone.count; g++) {
        const JoxPlace *of = NULL;
        for (uint32_t p = 0; p < scene->spec->place_count; p++) {
            const JoxPlace *place = &world->model.places[p];
            if (isfinite(size_of(place)) &&
                jox_place_contains(world->model.places, p, world->scratch.gone.items[g]) &&
                (!of || size_of(place) < size_of(of)))
                of = place;
        }
        if (of)
            count_at(scene, of);
    }
    if (world->state.statistics.removed > scene->exits.left) {
        scene->exits.left = world->state.statistics.removed;
        scene->exits.last = jo_world_time(world);
    }
}

void jox_run_sinks(JoScene *scene) {
    JoxAgents *a = &scene->world->state.agents;
    bool any = false;
    for (uint32_t s = 0; s < scene->spec->sink_count && scene->world->state.tick % 4 == 0; s++) {
        const JoxSceneSink *sink = &scene->spec->sinks[s];
        for (uint32_t i = 0; i < a->count; i++) {
            if (a->removed[i] || (sink->group >= 0 && a->group[i] != sink->group))
                continue;
            if (!jox_place_contains(scene->world->model.places, sink->place,
                                    (JoxV2){a->x[i], a->y[i]}))
                continue;
            count_exit(scene, sink->place, (JoxV2){a->x[i], a->y[i]});
            a->removed[i] = 1;
            any = true;
        }
    }
    if (any)
        scene->world->state.statistics.removed += jox_agents_compact(a);
}
