/* Sources of a scene that lie in walls or beyond them, so that some or all who are due cannot come.
 */
#include "run/run.h"

static const double WORTH =
    0.02; /* share of a place: less is no more than how finely it is drawn */

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
    const bool set = place->kind == JOX_PLACE_SET;
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
    jox_walls_standing(&walls, &scene->world->model.all_walls, false); /* gates may open */
    for (uint32_t s = 0; s < scene->spec->source_count; s++)
        check_source(scene, &scene->spec->sources[s], &grid, diagnostics);
    jox_wall_grid_free(&grid);
    jox_walls_free(&walls);
}
