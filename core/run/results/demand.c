/* People whom sources or start times had due and who did not come in: for the closing lines of a
   run and for its figures. */
#include "run/results/demand.h"
#include "base/format/plurals.h"
#include "run/run.h"

enum { MOST_TOLD = 5 }; /* sources named in the closing lines */

JoxDemand jox_run_demand(const JoScene *scene, uint32_t source) {
    const double late = jox_source_waiting(scene->world, source),
                 entered = (double)scene->world->state.sources.figures[source].entered;
    const bool over = jox_source_is_over(scene->world, source);
    return (JoxDemand){.due = entered + late,
                       .entered = entered,
                       .waiting = over ? 0.0 : late,
                       .did_not_come = over ? late : 0.0};
}

void jox_run_add_demand(const JoScene *scene, JoxJson *json) {
    if (scene->spec->source_count == 0)
        return;
    jox_json_object(json, "sources");
    for (uint32_t s = 0; s < scene->spec->source_count; s++) {
        const JoxDemand demand = jox_run_demand(scene, s);
        JoxText name = {0};
        jox_source_append_name(scene->world, s, &name);
        jox_json_object(json, name.data);
        jox_json_number(json, "due", demand.due);
        jox_json_number(json, "came", demand.entered);
        jox_json_number(json, "waiting", demand.waiting);
        jox_json_number(json, "did_not_come", demand.did_not_come);
        jox_json_end(json);
        jox_text_free(&name);
    }
    jox_json_end(json);
}

/* Returns whether an entrance of the source has floor that is free of walls. */
static bool has_free_entrance(const JoScene *scene, uint32_t source) {
    for (uint32_t d = 0; d < jox_source_count_doors(scene->world, source); d++)
        if (jox_source_entrance(scene->world, source, d)->area > 0.0)
            return true;
    return false;
}

void jox_run_say_demand(const JoScene *scene, JoxText *out) {
    uint32_t told = 0, more = 0;
    for (uint32_t s = 0; s < scene->spec->source_count; s++) {
        const JoxDemand demand = jox_run_demand(scene, s);
        const JoxPosition at = scene->spec->sources[s].position;
        char came[JOX_NOUN], due[JOX_NOUN];
        if (demand.waiting + demand.did_not_come <= 0.0)
            continue;
        if (told == MOST_TOLD) {
            more++;
            continue;
        }
        told++;
        jox_text_printf(out, " %s of %s due came: source '",
                        jox_number_text(came, (uint64_t)demand.entered),
                        jox_noun(due, (uint64_t)demand.due, "person|people"));
        jox_source_append_name(scene->world, s, out);
        jox_text_printf(out, "' (%.200s:%d) %s.", at.file, at.line,
                        has_free_entrance(scene, s) ? "was full" : "lies in walls");
        if (demand.did_not_come > 0.0)
            jox_text_printf(out, " It has ended: %s did not come.",
                            jox_noun(due, (uint64_t)demand.did_not_come, "person|people"));
    }
    if (more > 0) {
        jox_text_add(out, " So it is with ");
        jox_text_noun(out, more, "other source");
        jox_text_add(out, ".");
    }
}

void jox_run_add_starts(const JoScene *scene, JoxJson *json) {
    uint32_t waiting = 0;
    for (uint32_t g = 0; g < scene->spec->group_count; g++)
        waiting += jox_world_starts_waiting(scene->world, g);
    if (scene->world->model.start_count > 0)
        jox_json_whole(json, "starts_waiting", waiting);
}

void jox_run_say_starts(const JoScene *scene, JoxText *out) {
    for (uint32_t g = 0; g < scene->spec->group_count; g++) {
        const JoxGroup *group = &scene->spec->groups[g];
        const uint32_t waiting = jox_world_starts_waiting(scene->world, g);
        if (waiting == 0)
            continue;
        jox_text_add(out, " ");
        jox_text_noun(out, waiting, "person|people");
        jox_text_printf(
            out,
            " of group '%.60s' (%.200s:%d) did not come in at the time given, as others "
            "stood where they begin.",
            group->name, group->position.file, group->position.line);
    }
}

void jox_run_say_births(const JoScene *scene, JoxText *out) {
    const JoxStatistics *s = &scene->world->state.statistics;
    if (s->born_in_others == 0)
        return;
    jox_text_add(out, " ");
    jox_text_noun(out, s->born_in_others, "person|people");
    jox_text_printf(out,
                    " came in with their torso in another, up to %.2f m deep, however their chests "
                    "turned: widen the place where they come in, or let them come more slowly.",
                    s->deepest_birth);
}
