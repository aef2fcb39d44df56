/* What walls keep people of a scene from: coming in by sources that lie in them, and goals to which
   they leave no way. */
#include <math.h>

#include "base/format/noun.h"
#include "base/mem.h"
#include "geom/field/field.h"
#include "run/run.h"

/* ---- sources ---- */

static const double WORTH =
    0.02; /* share of a place: less is no more than how finely it is drawn */

/* Lays the walls that are no gates, as gates may open, and their images beyond joined edges. */
static void lay_lasting_walls(const JoScene *scene, JoxWalls *walls) {
    const JoxAgents *a = &scene->world->state.agents;
    jox_walls_standing(walls, &scene->world->model.all_walls, false);
    jox_wall_images_add(walls, a->origin, a->period, (JoxV2){0.0f, 0.0f});
}

/* What takes a share of a place from those who come in there. */
static const char *cause_of(const JoxEntrance *entrance) {
    return entrance->outside == 0.0                 ? "in a wall or beyond one"
           : entrance->outside >= entrance->blocked ? "outside the walkable area"
                                                    : "in walls or outside the walkable area";
}

/* Warns where a part of a place is blocked, or all of one of a set. Returns why nobody can come in
   there, NULL where somebody can. */
static const char *check_door(const JoScene *scene, const JoxAgentSource *source, uint32_t door,
                              JoxWallGrid *grid, JoxDiagnostics *diagnostics) {
    const JoxPlace *places = scene->world->model.places;
    JoxEntrance entrance;
    jox_entrance_make(&entrance, grid, &places[door]);
    const bool shut = entrance.cut && entrance.open_count == 0;
    const char *cause = cause_of(&entrance);
    if (shut && door != source->place)
        jox_diag_warn(diagnostics, source->position, "source-in-wall",
                      "Move it to where people can stand, or take it out of the set",
                      "nobody can come in at '%.60s', one of '%.60s': it lies %s",
                      places[door].name, places[source->place].name, cause);
    else if (!shut && entrance.cut && entrance.blocked > WORTH)
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
        const char *why = check_door(
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

/* Of those who are there at the start, and of one who comes in by each source; asked before the
   first step, of a world that never steps. */

enum { MOST_GOALS = 64, MOST_PLACES = 64 }; /* of one person; that are looked at: bits of a mask */

/* Places that people go to, and who goes where. */
typedef struct Goals {
    uint32_t places[MOST_PLACES], count;
    uint64_t *of; /* by person: a bit for each of the places */
} Goals;

/* Whom walls keep from one place: people of each group, and sources. */
typedef struct Shut {
    uint32_t *groups; /* people, by group */
    bool *sources;
} Shut;

/* One person for each source, who is only looked at. Returns the first of them. */
static uint32_t add_from_sources(JoScene *scene, uint32_t **source_of) {
    JoWorld *world = scene->world;
    const uint32_t first = world->state.agents.count;
    uint32_t count = 0;
    *source_of = jox_alloc((size_t)scene->spec->source_count + 1, sizeof **source_of);
    for (uint32_t s = 0; s < scene->spec->source_count; s++) {
        const JoxEntrance *entrance = jox_source_entrance(world, s, 0);
        if (entrance->cut && entrance->open_count == 0)
            continue;
        uint32_t agent = JOX_NO_INDEX;
        jox_world_spawn(world, scene->spec->sources[s].like,
                        entrance->cut ? jox_entrance_pick(entrance, 0.5)
                                      : world->model.places[jox_source_door(world, s, 0)].centre,
                        &agent);
        if (agent != JOX_NO_INDEX)
            (*source_of)[count++] = s;
    }
    return first;
}

static void tell(const JoScene *scene, const Shut *shut, const char *goal,
                 JoxDiagnostics *diagnostics) {
    static const char HINT[] =
        "Leave a gap of 0.3 m at least, name a wall that is to be opened, or "
        "move the goal";
    for (uint32_t g = 0; g < scene->spec->group_count; g++) {
        const JoxGroup *group = &scene->spec->groups[g];
        char people[JOX_NOUN];
        if (shut->groups[g] == 0)
            continue;
        if (shut->groups[g] == group->count)
            jox_diag_warn(
                diagnostics, group->position, "no-way", HINT,
                "nobody of group '%.60s' can reach '%.60s': walls that are no gates lie between",
                group->name, goal);
        else
            jox_diag_warn(diagnostics, group->position, "no-way", HINT,
                          "%u of the %s of group '%.60s' cannot reach '%.60s': walls that are no "
                          "gates lie between",
                          shut->groups[g], jox_noun(people, group->count, "person|people"),
                          group->name, goal);
    }
    for (uint32_t s = 0; s < scene->spec->source_count; s++)
        if (shut->sources[s])
            jox_diag_warn(
                diagnostics, scene->spec->sources[s].position, "no-way", HINT,
                "who comes in at '%.60s' cannot reach '%.60s': walls that are no gates lie between",
                scene->spec->places[scene->spec->sources[s].place].name, goal);
}

static void list_goals(const JoWorld *world, Goals *goals) {
    const uint32_t people = world->state.agents.count;
    goals->of = jox_alloc((size_t)people + 1, sizeof *goals->of);
    for (uint32_t i = 0; i < people; i++) {
        int32_t places[MOST_GOALS];
        const uint32_t count = jox_machines_goals(&world->machines, i, places, MOST_GOALS);
        for (uint32_t k = 0; k < count; k++) {
            uint32_t n = 0;
            while (n < goals->count && goals->places[n] != (uint32_t)places[k])
                n++;
            if (n == goals->count && n < MOST_PLACES &&
                (uint32_t)places[k] < world->model.scene_places)
                goals->places[goals->count++] = (uint32_t)places[k];
            if (n < goals->count)
                goals->of[i] |= (uint64_t)1 << n;
        }
    }
}

/* Tells whom of those who go to the n-th goal walls keep from it. */
static void check_goal(JoScene *scene, const Goals *goals, uint32_t n, uint32_t first_of_sources,
                       const uint32_t *source_of, JoxDiagnostics *diagnostics) {
    const JoxPlace *places = scene->world->model.places;
    const JoxWalls *walls = &scene->world->model.all_walls;
    const JoxAgents *a = &scene->world->state.agents;
    const JoxRouteStage stage = jox_world_route_stage(scene->world);
    JoxField *field = jox_routes_look_ahead(&stage, goals->places[n]);
    Shut shut = {jox_alloc((size_t)scene->spec->group_count + 1, sizeof *shut.groups),
                 jox_alloc((size_t)scene->spec->source_count + 1, sizeof *shut.sources)};
    for (uint32_t i = 0; i < a->count; i++) {
        const JoxV2 at = {a->x[i], a->y[i]};
        if (!(goals->of[i] >> n & 1) || jox_place_is_reached(places, goals->places[n], walls, at) ||
            jox_field_distance(field, at) < INFINITY)
            continue;
        if (i < first_of_sources)
            shut.groups[a->group[i]]++;
        else
            shut.sources[source_of[i - first_of_sources]] = true;
    }
    tell(scene, &shut, places[goals->places[n]].name, diagnostics);
    jox_free(shut.groups);
    jox_free(shut.sources);
    jox_field_free(field);
}

/* ---- goals in walls ---- */

/* Whether walls fill an area: nobody is ever inside. Lines and queues are reached from beside. */
static bool is_filled(JoxWallGrid *grid, const JoxPlace *place) {
    if (!jox_place_is_spot(place) && !jox_place_is_area(place))
        return false;
    JoxEntrance entrance;
    jox_entrance_make(&entrance, grid, place);
    const bool filled = entrance.outside == 0.0 && entrance.blocked > 1.0 - WORTH;
    jox_entrance_free(&entrance);
    return filled;
}

/* Of a step of a journey, whose people go on once they are inside; `goal` may be -1. */
static void check_inside(const JoScene *scene, JoxPosition position, int32_t goal,
                         JoxWallGrid *grid, JoxDiagnostics *diagnostics) {
    const JoxPlace *places = scene->world->model.places;
    if (goal < 0)
        return;
    const bool set = jox_place_is_set(&places[goal]);
    for (uint32_t m = 0; m < (set ? places[goal].member_count : 1); m++) {
        const JoxPlace *place = set ? &places[places[goal].members[m]] : &places[goal];
        if (is_filled(grid, place))
            jox_diag_warn(diagnostics, position, "goal-in-wall",
                          "Move it to where people can stand, or widen it beyond the wall",
                          "nobody can be inside '%.60s': it lies in a wall", place->name);
    }
}

static void check_journeys(const JoScene *scene, JoxDiagnostics *diagnostics) {
    JoxWalls walls = {0};
    JoxWallGrid grid = {.walls = &walls};
    lay_lasting_walls(scene, &walls);
    for (uint32_t g = 0; g < scene->spec->group_count; g++) {
        const JoxGroup *group = &scene->spec->groups[g];
        for (uint32_t s = 0; s < group->journey_count; s++) {
            const JoxJourneyStep *step = &group->journey[s];
            check_inside(scene, step->position, step->to, &grid, diagnostics);
            check_inside(scene, step->position, step->exit, &grid, diagnostics);
        }
    }
    jox_wall_grid_free(&grid);
    jox_walls_free(&walls);
}

void jox_run_check_ways(JoScene *scene, JoxDiagnostics *diagnostics) {
    Goals goals = {.count = 0};
    uint32_t *source_of;
    if (scene->world->model.all_walls.count == 0)
        return;
    check_journeys(scene, diagnostics);
    const uint32_t first = add_from_sources(scene, &source_of);
    list_goals(scene->world, &goals);
    for (uint32_t n = 0; n < goals.count; n++)
        check_goal(scene, &goals, n, first, source_of, diagnostics);
    jox_free(goals.of);
    jox_free(source_of);
}
