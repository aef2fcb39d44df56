/* Checks sources that lie in walls, and goals that walls, gates and bodies keep people from.
   build_scene.c and `jostle check` call it; standstill.c and results/ use its sentences. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/format/plurals.h"
#include "base/mem.h"
#include "base/sort.h"
#include "geom/storey_text.h"
#include "run/run.h"
#include "run/wall_checks.h"
#include "world/routes/hindrance.h"

/* ---- sources ---- */

static const double LEAST_SHARE = 0.02; /* share of a place: less is within its resolution */

/* Lays the walls that are no gates, as gates may open, and their images beyond joined edges. */
static void lay_lasting_walls(const JoScene *scene, JoxWalls *walls) {
    const JoxAgents *a = &scene->world->state.agents;
    jox_walls_standing(walls, &scene->world->model.all_walls, false);
    jox_wall_images_add(walls, a->origin, a->period, (JoxV2){0.0f, 0.0f});
}

/* Says what covers the blocked part of a place. */
static const char *name_cause(const JoxEntrance *entrance) {
    return entrance->outside == 0.0                 ? "in a wall or beyond one"
           : entrance->outside >= entrance->blocked ? "outside the walkable area"
                                                    : "in walls or outside the walkable area";
}

/* Warns if part of an entrance is blocked, or all of one of a set. Returns why nobody can come
   in there; NULL: people can. */
static const char *check_entrance(const JoScene *scene, const JoxAgentSource *source, uint32_t door,
                                  JoxWallGrid *grid, JoxDiagnostics *diagnostics) {
    const JoxPlace *places = scene->world->model.places;
    JoxEntrance entrance;
    jox_entrance_make(&entrance, &scene->world->model.storeys, grid, &places[door]);
    const bool shut = entrance.cut && entrance.open_count == 0;
    const char *cause = name_cause(&entrance);
    if (shut && door != source->place)
        jox_diag_warn(diagnostics, source->position, "source-in-wall",
                      "Move it to where people can stand, or take it out of the set",
                      "nobody can come in at '%.60s', one of '%.60s': it lies %s",
                      places[door].name, places[source->place].name, cause);
    else if (!shut && entrance.cut && entrance.blocked > LEAST_SHARE)
        jox_diag_warn(diagnostics, source->position, "source-across-wall",
                      "Move or cut the place; give parts on both sides of a wall a place each, and "
                      "the source a set of them",
                      "%.0f %% of '%.60s' lies %s: nobody comes in there", 100.0 * entrance.blocked,
                      places[door].name, cause);
    jox_entrance_free(&entrance);
    return shut ? cause : NULL;
}

static void check_source(const JoScene *scene, const JoxAgentSource *source, JoxWallGrid *grid,
                         JoxDiagnostics *diagnostics) {
    const JoxPlace *place = &scene->world->model.places[source->place];
    const bool set = jox_place_is_set(place);
    const uint32_t doors = set ? place->member_count : 1;
    const char *cause = NULL;
    uint32_t shut = 0;
    for (uint32_t m = 0; m < doors; m++) {
        const char *why = check_entrance(
            scene, source, set ? (uint32_t)place->members[m] : source->place, grid, diagnostics);
        shut += why != NULL;
        cause = why ? why : cause;
    }
    if (shut == doors)
        jox_diag_error(diagnostics, source->position, "source-in-wall",
                       "Move the place to where people can stand",
                       "nobody of '%.60s' can come in at '%.60s': it lies %s",
                       scene->spec->groups[source->like].name, place->name, cause);
}

void jox_run_check_sources(const JoScene *scene, JoxDiagnostics *diagnostics) {
    JoxWalls walls = {0};
    JoxWallGrid grid = {.walls = &walls};
    if (scene->spec->source_count == 0)
        return;
    lay_lasting_walls(scene, &walls);
    for (uint32_t s = 0; s < scene->spec->source_count; s++)
        check_source(scene, &scene->spec->sources[s], &grid, diagnostics);
    jox_wall_grid_free(&grid);
    jox_walls_free(&walls);
}

/* ---- ways to goals ---- */

/* Looks at the people who are there at the start and at one more for each source, before the
   first step of a world that never steps. */

enum { MOST_GOALS = 16384 }; /* of one agent: more than a machine has steering terms */

/* An agent, and a place that it goes to. */
typedef struct Aim {
    uint32_t place, agent;
} Aim;

/* Places that people go to. */
typedef struct Goals {
    Aim *aims; /* by place, then agent */
    uint32_t count;
    size_t capacity;
    bool *opening; /* by ring of walls: whether something opens it */
    uint32_t first_of_sources;
    uint32_t *source_of; /* by agent from that one on: the source of which it is the one more */
} Goals;

/* People of a group or source whom one kind of hindrance keeps from a place. */
typedef struct KeptCount {
    uint32_t people;
    float widest;       /* m: their greatest radius */
    JoxHindrance first; /* the hindrance of the first of them */
} KeptCount;

/* Adds one agent for each source. Returns the index of the first. */
static uint32_t add_person_per_source(JoScene *scene, uint32_t **source_of) {
    JoWorld *world = scene->world;
    const uint32_t first = world->state.agents.count;
    uint32_t count = 0;
    *source_of = jox_alloc((size_t)scene->spec->source_count + 1, sizeof **source_of);
    for (uint32_t s = 0; s < scene->spec->source_count; s++) {
        const JoxEntrance *entrance = jox_source_entrance(world, s, 0);
        if (entrance->cut && entrance->open_count == 0)
            continue;
        uint32_t agent = JOX_NO_INDEX;
        jox_world_spawn_at(world, scene->spec->sources[s].like,
                           entrance->cut ? jox_entrance_pick(entrance, 0.5)
                                         : world->model.places[jox_source_door(world, s, 0)].centre,
                           &agent);
        if (agent != JOX_NO_INDEX)
            (*source_of)[count++] = s;
    }
    return first;
}

/* Returns whether people may not take each stair both ways. */
static bool has_limited_stairs(const JoxStoreys *storeys) {
    bool any = false;
    for (uint32_t k = 0; k < storeys->stair_count; k++)
        any |= storeys->stairs[k].closed || storeys->stairs[k].way != JOX_STAIR_BOTH_WAYS;
    return any;
}

const char *jox_run_name_of_lift(const JoScene *scene, const JoxHindrance *hindrance) {
    const JoWorld *w = scene->world;
    return hindrance->by < w->model.lift_count ? w->model.lifts[hindrance->by].name : "";
}

static bool is_left_to_firemen(const JoScene *scene, const JoxHindrance *hindrance) {
    const JoWorld *w = scene->world;
    return hindrance->by < w->model.lift_count &&
           w->state.lifts.cars[hindrance->by].mode == JOX_LIFT_FIREMEN;
}

void jox_run_say_hindrance(const JoScene *scene, const JoxHindrance *hindrance, JoxText *out) {
    const JoxBodies *bodies = scene->world->state.bodies;
    const uint32_t row = jox_bodies_find(bodies, hindrance->by);
    const char *body = row == JOX_NO_BODY ? "" : jox_bodies_name(bodies, row);
    const char *gate = NULL;
    if (hindrance->kind == JOX_HINDRANCE_GATE)
        gate = scene->world->model.all_walls.rings[hindrance->by].name;
    switch (hindrance->kind) {
    case JOX_HINDRANCE_WALL:
        jox_text_add(out, has_limited_stairs(&scene->world->model.storeys)
                              ? "walls, or stairs that are closed or lead one way, lie between"
                              : "walls lie between");
        return;
    case JOX_HINDRANCE_NARROW:
        jox_text_add(out, "the way is narrower than they are");
        break;
    case JOX_HINDRANCE_GATE:
        jox_text_printf(out, "gate '%.60s' is closed", gate);
        break;
    case JOX_HINDRANCE_LIFT:
        jox_text_printf(out, "lift '%.60s' is %s", jox_run_name_of_lift(scene, hindrance),
                        is_left_to_firemen(scene, hindrance) ? "left to firemen" : "out of use");
        break;
    case JOX_HINDRANCE_STAIRS:
        jox_text_add(out, "only stairs lead there, which they cannot use");
        return;
    case JOX_HINDRANCE_NO_LIFTS:
        jox_text_add(out, "only lifts lead there, which they do not take");
        return;
    case JOX_HINDRANCE_FILLED:
    case JOX_HINDRANCE_BODY:
        jox_text_printf(out, *body ? "the body '%.60s' %s" : "a body%.60s %s", body,
                        hindrance->kind == JOX_HINDRANCE_FILLED ? "fills the way"
                                                                : "shuts the way");
        break;
    default:
        return;
    }
    jox_text_add(out, " at ");
    jox_text_position(out, &scene->world->model.storeys, hindrance->at, 1);
}

bool jox_run_has_gate_opener(const JoScene *scene, const char *gate) {
    const JoxInputLog *input = &scene->world->state.input;
    const JoxWalls *walls = &scene->world->model.all_walls;
    bool closes = false, set = false;
    for (uint32_t e = 0; e < scene->spec->event_count; e++) {
        const JoxEvent *event = &scene->spec->events[e];
        const bool names = event->name && strcmp(event->name, gate) == 0;
        if (names && event->kind == JOX_EVENT_OPEN)
            return true;
        closes |= names && event->kind == JOX_EVENT_CLOSE;
    }
    for (uint32_t e = 0; e < input->count; e++)
        if (input->entries[e].verb == JOX_INPUT_OPEN &&
            strcmp(input->entries[e].names[0], gate) == 0)
            return true;
    for (uint32_t r = 0; r < walls->ring_count; r++)
        set |=
            walls->rings[r].name && strcmp(walls->rings[r].name, gate) == 0 && walls->rings[r].set;
    return set && !closes; /* set by a person at the page, or by a program */
}

bool *jox_run_list_gates_with_opener(const JoScene *scene) {
    const JoxWalls *walls = &scene->world->model.all_walls;
    bool *opening = jox_alloc((size_t)walls->ring_count + 1, sizeof *opening);
    for (uint32_t r = 0; r < walls->ring_count; r++)
        opening[r] = walls->rings[r].name && jox_run_has_gate_opener(scene, walls->rings[r].name);
    return opening;
}

/* Returns whether an event or a line of the input log puts a lift in use, or leaves it to firemen.
 */
static bool has_lift_opener(const JoScene *scene, const JoxHindrance *h) {
    const JoxInputLog *input = &scene->world->state.input;
    const char *lift = jox_run_name_of_lift(scene, h);
    bool any = false;
    for (uint32_t e = 0; e < scene->spec->event_count && !any; e++) {
        const JoxEvent *event = &scene->spec->events[e];
        any = event->kind == JOX_EVENT_LIFT && event->mode != JOX_LIFT_OUT_OF_USE &&
              (strcmp(event->name, lift) == 0 || strcmp(event->name, "all") == 0);
    }
    for (uint32_t e = 0; e < input->count && !any; e++)
        any = input->entries[e].verb == JOX_INPUT_LIFT &&
              (strcmp(input->entries[e].names[0], lift) == 0 ||
               strcmp(input->entries[e].names[0], "all") == 0);
    return any;
}

bool jox_run_is_fault(const JoScene *scene, const JoxHindrance *h) {
    switch (h->kind) {
    case JOX_HINDRANCE_WALL:
    case JOX_HINDRANCE_NARROW:
    case JOX_HINDRANCE_FILLED:
    case JOX_HINDRANCE_STAIRS:
    case JOX_HINDRANCE_NO_LIFTS:
        return true;
    case JOX_HINDRANCE_LIFT:
        return !has_lift_opener(scene, h);
    case JOX_HINDRANCE_GATE:
        return !jox_run_has_gate_opener(scene, scene->world->model.all_walls.rings[h->by].name);
    default:
        return false;
    }
}

bool jox_run_waits_in_refuge(const JoScene *scene, const JoxKept *kept, JoxHindranceKind kind) {
    return kept->ways == JOX_WAYS_STEPLESS &&
           (kind == JOX_HINDRANCE_STAIRS || kind == JOX_HINDRANCE_LIFT) &&
           jox_find_refuge(&scene->world->machines, kept->at) >= 0;
}

static void write_hint(const KeptCount *kept, char out[JOX_HINT]) {
    const double room = ceil(200.0 * (double)kept->widest - 1e-3) / 100.0; /* m, to the cm */
    switch (kept->first.kind) {
    case JOX_HINDRANCE_GATE:
        snprintf(out, JOX_HINT, "Add an event that opens it, or begin with it open");
        break;
    case JOX_HINDRANCE_LIFT:
        snprintf(out, JOX_HINT, "Add an event that puts it in use, or begin with it in use");
        break;
    case JOX_HINDRANCE_STAIRS:
        snprintf(out, JOX_HINT, "Add a ramp or a lift, or a place with `refuge: true` to wait in");
        break;
    case JOX_HINDRANCE_NO_LIFTS:
        snprintf(out, JOX_HINT, "Let them take lifts (`set: {lifts: either}`), or add stairs");
        break;
    case JOX_HINDRANCE_FILLED:
        snprintf(out, JOX_HINT,
                 "Leave %.2f m beside the body, twice a radius, or give it a mass to push it by",
                 room);
        break;
    case JOX_HINDRANCE_NARROW:
        snprintf(out, JOX_HINT,
                 "Leave a gap of %.2f m at least, twice a radius, or lower the radius", room);
        break;
    default:
        snprintf(
            out, JOX_HINT,
            "Leave a gap of %.2f m at least, name a wall that is to be opened, or move the goal",
            room);
    }
}

/* Warns of people who are kept from a goal: of a group, `all` of them, or of a source (`all` 0).
   `who`: name of the group, or of the source's place. */
static void warn_of_kept_people(const JoScene *scene, JoxPosition position, const KeptCount *kept,
                                const char *who, uint32_t all, const char *goal,
                                JoxDiagnostics *diagnostics) {
    char hint[JOX_HINT], people[JOX_NOUN];
    JoxText why = {0};
    if (kept->people == 0 || !jox_run_is_fault(scene, &kept->first))
        return;
    const bool gate = kept->first.kind == JOX_HINDRANCE_GATE;
    jox_run_say_hindrance(scene, &kept->first, &why);
    if (gate)
        jox_text_add(&why, ", and nothing opens it");
    write_hint(kept, hint);
    const char *code = gate ? "never-opened" : "no-way";
    if (all == 0)
        jox_diag_warn(diagnostics, position, code, hint,
                      "who comes in at '%.60s' cannot reach '%.60s': %s", who, goal, why.data);
    else if (kept->people == all)
        jox_diag_warn(diagnostics, position, code, hint,
                      "nobody of group '%.60s' can reach '%.60s': %s", who, goal, why.data);
    else
        jox_diag_warn(diagnostics, position, code, hint,
                      "%u of the %s of group '%.60s' cannot reach '%.60s': %s", kept->people,
                      jox_noun(people, all, "person|people"), who, goal, why.data);
    jox_text_free(&why);
}

static int compare_aims(const void *left, const void *right, const void *context) {
    const Aim *a = left, *b = right;
    (void)context;
    return a->place != b->place ? (a->place > b->place) - (a->place < b->place)
                                : (a->agent > b->agent) - (a->agent < b->agent);
}

/* Lists each place that an agent goes to once. */
static void collect_goals(const JoWorld *world, Goals *goals) {
    int32_t *places = jox_alloc(MOST_GOALS, sizeof *places);
    uint8_t *listed = jox_alloc((size_t)world->model.scene_places + 1, 1);
    for (uint32_t i = 0; i < world->state.agents.count; i++) {
        const uint32_t count = jox_machines_goals(&world->machines, i, places, MOST_GOALS);
        const uint32_t first = goals->count;
        for (uint32_t k = 0; k < count; k++) {
            const uint32_t place = (uint32_t)places[k];
            if (place >= world->model.scene_places || listed[place])
                continue;
            listed[place] = 1;
            JOX_RESERVE(goals->aims, goals->capacity, (size_t)goals->count + 1);
            goals->aims[goals->count++] = (Aim){place, i};
        }
        for (uint32_t g = first; g < goals->count; g++)
            listed[goals->aims[g].place] = 0;
    }
    if (goals->count)
        jox_sort(goals->aims, goals->count, sizeof *goals->aims, compare_aims, NULL, NULL);
    jox_free(places);
    jox_free(listed);
}

/* Warns of people who are kept from one goal, of `count` aims at it. */
static void check_goal(JoScene *scene, const Goals *goals, const Aim *aims, uint32_t count,
                       JoxDiagnostics *diagnostics) {
    const JoxSceneSpec *spec = scene->spec;
    const JoxPlace *places = scene->world->model.places;
    const JoxWalls *walls = &scene->world->model.all_walls;
    const JoxAgents *a = &scene->world->state.agents;
    const JoxRouteStage stage = jox_world_route_stage(scene->world);
    const uint32_t rows = spec->group_count + spec->source_count;
    KeptCount *kept = jox_alloc((size_t)(rows + 1) * JOX_HINDRANCE_KINDS, sizeof *kept);
    JoxHindrances *hindrances = jox_hindrances_create(&stage, aims->place, goals->opening);
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t i = aims[k].agent;
        const JoxKept one = jox_hindrance_of_agent(a, i);
        if (jox_place_is_arrival(places, aims->place, walls, one.at))
            continue;
        const JoxHindranceKind kind = jox_hindrances_kind(hindrances, &one);
        const uint32_t row =
            i < goals->first_of_sources
                ? a->group[i]
                : spec->group_count + goals->source_of[i - goals->first_of_sources];
        KeptCount *of = &kept[row * JOX_HINDRANCE_KINDS + kind];
        if (kind == JOX_HINDRANCE_NONE || jox_run_waits_in_refuge(scene, &one, kind))
            continue;
        if (of->people++ == 0)
            of->first = jox_hindrances_find(hindrances, &one);
        of->widest = jox_maxf(of->widest, one.radius);
    }
    for (uint32_t k = 0; k < rows * JOX_HINDRANCE_KINDS; k++) {
        const uint32_t row = k / JOX_HINDRANCE_KINDS;
        const char *goal = places[aims->place].name;
        if (row < spec->group_count)
            warn_of_kept_people(scene, spec->groups[row].position, &kept[k], spec->groups[row].name,
                                spec->groups[row].count, goal, diagnostics);
        else
            warn_of_kept_people(scene, spec->sources[row - spec->group_count].position, &kept[k],
                                spec->places[spec->sources[row - spec->group_count].place].name, 0,
                                goal, diagnostics);
    }
    jox_hindrances_free(hindrances);
    jox_free(kept);
}

/* ---- goals in walls ---- */

/* Whether walls fill a place, so that nobody is ever inside. Lines and queues are reached from
   beside. */
static bool is_filled_by_walls(const JoxStoreys *storeys, JoxWallGrid *grid,
                               const JoxPlace *place) {
    if (!jox_place_is_spot(place) && !jox_place_is_area(place))
        return false;
    JoxEntrance entrance;
    jox_entrance_make(&entrance, storeys, grid, place);
    const bool filled = entrance.outside == 0.0 && entrance.blocked > 1.0 - LEAST_SHARE;
    jox_entrance_free(&entrance);
    return filled;
}

/* Warns if a place of a journey's step lies in a wall: people go on once they are inside. `goal`
   may be -1. */
static void check_step_place(const JoScene *scene, JoxPosition position, int32_t goal,
                             JoxWallGrid *grid, JoxDiagnostics *diagnostics) {
    const JoxPlace *places = scene->world->model.places;
    if (goal < 0)
        return;
    const bool set = jox_place_is_set(&places[goal]);
    for (uint32_t m = 0; m < (set ? places[goal].member_count : 1); m++) {
        const JoxPlace *place = set ? &places[places[goal].members[m]] : &places[goal];
        if (is_filled_by_walls(&scene->world->model.storeys, grid, place))
            jox_diag_warn(diagnostics, position, "goal-in-wall",
                          "Move it to where people can stand, or widen it beyond the wall",
                          "nobody can be inside '%.60s': it lies in a wall", place->name);
    }
}

void jox_run_check_journeys(const JoScene *scene, JoxDiagnostics *diagnostics) {
    JoxWalls walls = {0};
    JoxWallGrid grid = {.walls = &walls};
    if (scene->world->model.all_walls.count == 0)
        return;
    lay_lasting_walls(scene, &walls);
    for (uint32_t g = 0; g < scene->spec->group_count; g++) {
        const JoxGroup *group = &scene->spec->groups[g];
        for (uint32_t s = 0; s < group->journey_count; s++) {
            const JoxJourneyStep *step = &group->journey[s];
            check_step_place(scene, step->position, step->to, &grid, diagnostics);
            check_step_place(scene, step->position, step->exit, &grid, diagnostics);
        }
    }
    jox_wall_grid_free(&grid);
    jox_walls_free(&walls);
}

void jox_run_check_goals(JoScene *scene, JoxDiagnostics *diagnostics) {
    Goals goals = {.count = 0};
    const JoxRouteStage stage = jox_world_route_stage(scene->world);
    jox_bodies_objects(scene->world->state.bodies, &scene->world->scratch.objects);
    if (scene->world->model.all_walls.count == 0 && stage.objects->count == 0)
        return;
    jox_routes_update_bodies(&stage);
    goals.first_of_sources = add_person_per_source(scene, &goals.source_of);
    collect_goals(scene->world, &goals);
    goals.opening = jox_run_list_gates_with_opener(scene);
    for (uint32_t from = 0, to; from < goals.count; from = to) {
        for (to = from + 1; to < goals.count && goals.aims[to].place == goals.aims[from].place;)
            to++;
        check_goal(scene, &goals, &goals.aims[from], to - from, diagnostics);
    }
    jox_free(goals.aims);
    jox_free(goals.opening);
    jox_free(goals.source_of);
}
