/* Takes over an edited scene file: applies what can change while the scene runs, and names what
   waits for the next start. reload_swap.c calls it between two steps. */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "run/event_signals.h"
#include "run/group_links.h"
#include "run/reload.h"
#include "run/run.h"
#include "run/starting_people.h"
#include "run/wall_checks.h"

static const float SHEET_MARGIN = 5.0f; /* m along y that sheets may begin earlier or later */

typedef struct SceneReload {
    JoScene *scene;
    JoxSceneSpec *old, *new;
    JoxText done, later; /* list of what changed; list of what waits for the next start */
} SceneReload;

static void add_to_list(JoxText *list, const char *what) {
    jox_text_printf(list, "%s%s", list->length ? ", " : "", what);
}

static bool same_points(const JoxV2 *a, uint32_t n, const JoxV2 *b, uint32_t m) {
    return n == m && (n == 0 || memcmp(a, b, n * sizeof *a) == 0);
}

static bool same_text(const char *a, const char *b) {
    return a == b || (a && b && strcmp(a, b) == 0);
}

/* ---- places: geometry of those of the same names ---- */

static void replace_places(SceneReload *r) {
    JoWorld *world = r->scene->world;
    bool moved = false, names = r->old->place_count == r->new->place_count;
    for (uint32_t p = 0; names && p < r->old->place_count; p++)
        names = !strcmp(r->old->places[p].name, r->new->places[p].name) &&
                r->old->places[p].kind == r->new->places[p].kind;
    if (!names) {
        add_to_list(&r->later, "places (other names, kinds or order)");
        return;
    }
    for (uint32_t p = 0; p < r->new->place_count; p++) {
        const JoxPlace *from = &r->new->places[p];
        JoxPlace *to = &world->model.places[p];
        /* Compared with the world's place: the old specification may lag behind. */
        if (jox_place_same(to, from))
            continue;
        moved = true;
        jox_place_free(to);
        jox_place_copy(to, from);
    }
    if (moved) {
        jox_routes_renew(world->state.routes);
        jox_entrances_clear(&world->scratch.entrances);
        add_to_list(&r->done, "places");
    }
}

/* ---- walls ---- */

/* Whether walls are the same, apart from gates that were opened or closed during the run: these
   stay as they are. */
static bool same_walls(const JoxWalls *a, const JoxWalls *b) {
    if (a->count != b->count || a->ring_count != b->ring_count)
        return false;
    for (uint32_t i = 0; i < a->count; i++)
        if (memcmp(&a->vertices[i].point, &b->vertices[i].point, sizeof(JoxV2)) != 0 ||
            a->vertices[i].next != b->vertices[i].next)
            return false;
    for (uint32_t i = 0; i < a->ring_count; i++)
        if (a->rings[i].height != b->rings[i].height || a->rings[i].drawn != b->rings[i].drawn ||
            a->rings[i].solid != b->rings[i].solid ||
            !same_text(a->rings[i].name, b->rings[i].name) ||
            (!a->rings[i].set && a->rings[i].open != b->rings[i].open))
            return false;
    return true;
}

static void replace_walls(SceneReload *r) {
    JoWorld *world = r->scene->world;
    if (same_walls(&world->model.all_walls, &r->new->walls))
        return;
    jox_world_set_walls(world, &r->new->walls);
    add_to_list(&r->done, "walls");
}

/* ---- groups: values that they set ---- */

static bool same_dist(const JoxDist *a, const JoxDist *b) {
    return a->kind == b->kind && a->a == b->a && a->b == b->b && a->lo == b->lo && a->hi == b->hi &&
           a->choices == b->choices &&
           !memcmp(a->values, b->values, (size_t)a->choices * sizeof *a->values);
}

void jox_run_give_group_value(JoScene *scene, int32_t which, uint32_t group,
                              const JoxGroupValue *set) {
    JoxMachineRun *machines = &scene->world->machines;
    JoxAgents *a = machines->agents;
    for (uint32_t i = 0; i < a->count; i++) {
        if (a->group[i] != group || a->machine[i] == JOX_NO_MACHINE ||
            (which >= 0 && a->machine[i] != which))
            continue;
        const uint16_t slot = set->slots[a->machine[i]];
        if (slot == 0)
            continue;
        const double value =
            set->kind == JOX_SET_PLACE
                ? set->place
                : jox_dist_draw(&set->dist, machines->seed, a->id[i], 0, JOX_DRAW_OWN, slot - 1);
        jox_machines_set_own(machines, i, slot - 1, value);
    }
}

static bool same_starts(const JoxGroup *a, const JoxGroup *b) {
    bool same = a->start_count == b->start_count;
    for (uint32_t s = 0; same && s < a->start_count; s++) {
        const JoxStart *x = &a->starts[s], *y = &b->starts[s];
        same = x->time == y->time && x->at.x == y->at.x && x->at.y == y->at.y &&
               memcmp(&x->velocity, &y->velocity, sizeof x->velocity) == 0;
    }
    return same;
}

static bool same_behaviours(const JoxGroup *a, const JoxGroup *b) {
    bool same = a->mix_count == b->mix_count;
    for (uint32_t m = 0; same && m < a->mix_count; m++)
        same = same_text(a->mix[m].behaviour, b->mix[m].behaviour) &&
               same_text(a->mix[m].text, b->mix[m].text);
    return same;
}

/* Lists what differs at the next start of groups. If no group was edited, people start elsewhere
   because walls or places were. */
static void note_starts(SceneReload *r, bool counts, bool starts, bool behaviours) {
    if (behaviours)
        add_to_list(&r->later, "behaviours of groups");
    if ((counts || starts) && !jox_scene_differs(r->old, r->new, "groups"))
        add_to_list(&r->later, "where people start, by the edited walls and places");
    else if (counts || starts)
        add_to_list(&r->later, "counts and positions of groups");
}

/* Gives the living of each group the values that were edited. False if the groups have other
   names or order: the new specification is then not taken. */
static bool replace_group_values(SceneReload *r) {
    bool names = r->old->group_count == r->new->group_count, set_any = false;
    bool counts = false, starts = false, behaviours = false, colours = false;
    for (uint32_t g = 0; names && g < r->old->group_count; g++)
        names = !strcmp(r->old->groups[g].name, r->new->groups[g].name);
    if (!names) {
        add_to_list(&r->later, "groups (other names or order)");
        return false;
    }
    for (uint32_t g = 0; g < r->new->group_count; g++)
        if (!same_behaviours(&r->old->groups[g], &r->new->groups[g])) {
            jox_scene_copy_behaviours(&r->old->groups[g], r->new, g); /* others are not loaded */
            behaviours = true;
        }
    jox_run_link_groups(r->scene, r->new, NULL);
    for (uint32_t g = 0; g < r->new->group_count; g++) {
        const JoxGroup *was = &r->old->groups[g], *is = &r->new->groups[g];
        colours |= was->colour != is->colour;
        counts |= was->count != is->count;
        starts |= !same_points(was->positions, was->positions ? was->count : 0, is->positions,
                               is->positions ? is->count : 0) ||
                  !same_starts(was, is);
        for (uint32_t s = 0; s < is->set_count; s++) {
            const JoxGroupValue *set = &is->set[s], *before = NULL;
            for (uint32_t o = 0; o < was->set_count; o++)
                if (strcmp(was->set[o].name, set->name) == 0)
                    before = &was->set[o];
            bool same = before && before->kind == set->kind && before->place == set->place &&
                        same_dist(&before->dist, &set->dist);
            if (same || set->kind == JOX_SET_ANTIPODE)
                continue;
            jox_run_give_group_value(r->scene, -1, g, set);
            set_any = true;
        }
    }
    if (set_any)
        add_to_list(&r->done, "values that groups set");
    if (colours)
        add_to_list(&r->done, "colours of groups");
    note_starts(r, counts, starts, behaviours);
    return true;
}

/* ---- the rest ---- */

/* Returns whether sources or sinks were edited. Sources go on from the people they have made: a
   new rate counts from now. */
static bool note_sources(SceneReload *r) {
    if (!jox_scene_differs(r->old, r->new, "sources") &&
        !jox_scene_differs(r->old, r->new, "sinks"))
        return false;
    add_to_list(&r->done, "sources and sinks");
    return true;
}

/* Reports sources that lie in walls since the edit. */
static void check_new_sources(const SceneReload *r) {
    JoxDiagnostics blocked = {0};
    if (!jox_scene_differs(r->old, r->new, "sources") &&
        !jox_scene_differs(r->old, r->new, "places") && !jox_scene_differs(r->old, r->new, "walls"))
        return;
    jox_run_check_sources(r->scene, &blocked);
    jox_run_report_diagnostics(r->scene->message, r->scene->message_context, &blocked, NULL);
}

/* Lists the keys that nothing above compares: what is drawn, as the floor and the camera, and what
   a report says. */
static void note_other_keys(SceneReload *r, bool taken) {
    static const char *const COMPARED[] = {"places", "walls",  "groups", "sources",
                                           "sinks",  "events", "tally",  NULL};
    jox_scene_list_live_keys(r->old, r->new, COMPARED, taken ? &r->done : &r->later);
    if (r->done.length + r->later.length == 0) /* as clothes of groups */
        jox_scene_list_live_keys(r->old, r->new, &COMPARED[7], &r->done);
}

/* Returns whether storeys and stairs of both versions lie on the same sheets, so that positions of
   one are positions of the other, and lifts, whose shafts are walls, are the same. */
static bool keeps_sheets(const SceneReload *r) {
    const JoxStoreys *old = &r->old->storeys, *new = &r->new->storeys;
    return !jox_scene_differs(r->old, r->new, "storeys") &&
           !jox_scene_differs(r->old, r->new, "stairs") &&
           !jox_scene_differs(r->old, r->new, "lifts") &&
           old->pitch == new->pitch &&fabsf(old->origin - new->origin) <= SHEET_MARGIN;
}

/* Says that nothing of an edit is taken over, as storeys, stairs or lifts changed or the plan has
   become deeper than their sheets are. */
static void refuse_other_sheets(const SceneReload *r) {
    static const char *const NO_KEYS[] = {NULL};
    JoxText later = {0};
    jox_scene_list_live_keys(r->old, r->new, NO_KEYS, &later);
    jox_scene_list_restart_keys(r->old, r->new, &later);
    jox_run_tell_reloaded(r->scene, &(JoxReloadNews){.path = r->scene->spec->path,
                                                     .done = "",
                                                     .later = later.data ? later.data : ""});
    jox_run_say(r->scene, "%s: %s: takes effect at the next start, as %s anew\n",
                r->scene->spec->path, later.data ? later.data : "nothing",
                jox_scene_differs(r->old, r->new, "lifts") ? "lifts are built"
                                                           : "storeys are laid out");
    jox_run_tell_reloaded(r->scene, NULL);
    jox_text_free(&later);
}

void jox_run_reload_scene(JoScene *scene, JoxSceneSpec **spec, double written) {
    SceneReload r = {.scene = scene, .old = scene->spec, .new = *spec};
    double begun = jox_clock_wall();
    if (!keeps_sheets(&r)) {
        refuse_other_sheets(&r);
        return;
    }
    replace_places(&r);
    bool sources = false;
    bool groups = r.later.length == 0; /* places of other names: their numbers would mean others */
    replace_walls(&r);
    if (groups) {
        groups = replace_group_values(&r);
        if (groups)
            sources = note_sources(&r);
    }
    if (jox_scene_differs(r.old, r.new, "events"))
        add_to_list(groups ? &r.done : &r.later, "events");
    if (jox_scene_differs(r.old, r.new, "tally"))
        add_to_list(groups ? &r.done : &r.later, "tally");
    note_other_keys(&r, groups);
    jox_scene_list_restart_keys(r.old, r.new, &r.later);
    const double age = jox_clock_date() - written;
    char ago[40] = "";
    if (written > 0.0)
        snprintf(ago, sizeof ago, "saved %.0f ms ago, ", age * 1e3);
    jox_run_tell_reloaded(scene, &(JoxReloadNews){.path = scene->spec->path,
                                                  .done = r.done.data ? r.done.data : "",
                                                  .later = r.later.data ? r.later.data : ""});
    if (r.done.length)
        jox_run_say(scene, "%s: %s changed, live from t = %.2f s (%stook %.2f ms)\n",
                    scene->spec->path, r.done.data, jo_world_time(scene->world), ago,
                    (jox_clock_wall() - begun) * 1e3);
    if (r.later.length)
        jox_run_say(scene, "%s: %s: takes effect at the next start\n", scene->spec->path,
                    r.later.data);
    if (groups) { /* the old specification goes where the new one came from */
        *spec = scene->spec;
        scene->spec = r.new;
        r.new->duration = r.old->duration;
        jox_run_set_schedule(scene, sources);
        jox_run_number_event_signals(scene, NULL);
        check_new_sources(&r);
    }
    jox_run_tell_reloaded(scene, NULL);
    jox_text_free(&r.done);
    jox_text_free(&r.later);
}
