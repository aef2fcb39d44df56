/* People whom an obstacle keeps from their goal (JoxKeptPeople): for the closing lines of a run and
   for its figures. */
#include <math.h>

#include "base/format/plurals.h"
#include "run/results/kept_people.h"
#include "run/run.h"
#include "run/standstill.h"
#include "run/wall_checks.h"

void jox_run_say_kept(const JoScene *scene, JoxText *out) {
    const JoxKeptList *list = jox_run_list_kept_people(scene);
    for (uint32_t k = 0; list && k < list->count; k++) {
        const JoxKeptPeople *kept = &list->items[k];
        const char *name = scene->world->machines.places[kept->place].name;
        if (isnan(kept->since))
            continue;
        jox_text_add(out, " ");
        jox_text_noun(out, kept->people, "person waits|people wait");
        jox_text_printf(out, " to get to '%.60s'%s since %.0f s: ", name ? name : "their goal",
                        kept->people == 1 ? "," : ", the first", kept->since);
        jox_run_say_hindrance(scene, &kept->why, out);
        jox_text_add(out, ".");
    }
}

void jox_run_add_kept(const JoScene *scene, JoxJson *json) {
    static const char *const KINDS[JOX_HINDRANCE_KINDS] = {
        "", "walls", "narrow", "filled", "gate", "body", "lift", "only_stairs", "only_lifts"};
    const JoxKeptList *list = jox_run_list_kept_people(scene);
    const JoxBodies *bodies = scene->world->state.bodies;
    if (!list || list->count == 0)
        return;
    jox_json_array(json, "kept");
    for (uint32_t k = 0; k < list->count; k++) {
        const JoxKeptPeople *kept = &list->items[k];
        const char *name = scene->world->machines.places[kept->place].name, *by = "";
        const uint32_t row = jox_bodies_find(bodies, kept->why.by);
        if (kept->why.kind == JOX_HINDRANCE_GATE)
            by = scene->world->model.all_walls.rings[kept->why.by].name;
        else if (kept->why.kind == JOX_HINDRANCE_LIFT)
            by = jox_run_name_of_lift(scene, &kept->why);
        else if (row != JOX_NO_BODY)
            by = jox_bodies_name(bodies, row);
        jox_json_object(json, NULL);
        jox_json_string(json, "from", name ? name : "");
        jox_json_string(json, "cause", KINDS[kept->why.kind]);
        jox_json_string(json, "by", by ? by : "");
        jox_json_whole(json, "people", kept->people);
        jox_json_number(json, "since_s", kept->since);
        jox_json_end(json);
    }
    jox_json_end(json);
}
