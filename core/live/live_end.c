/* The member "end" of a status: why a run is over, and its figures up to then, of which the page
   makes the card that it shows; with the commands that run, compare and report the same scene. */
#include <math.h>

#include "base/format/quote.h"
#include "live/live_parts.h"
#include "record/danger/criteria.h"
#include "run/criteria_listener.h"
#include "run/figure_listeners.h"

static const char *const REASONS[] = {[JOX_LIVE_GOES_ON] = NULL,
                                      [JOX_LIVE_TIME_IS_UP] = "time",
                                      [JOX_LIVE_ALL_HAVE_LEFT] = "left",
                                      [JOX_LIVE_FAILED_RUN] = "failed"};

JoxLiveEnd jox_live_find_end(const JoScene *scene, const JoxLiveSession *session) {
    const JoWorld *world = scene->world;
    if (session->end != JOX_LIVE_GOES_ON)
        return session->end;
    return world->state.agents.count == 0 && world->state.exits.left > 0 &&
                   !jox_world_expects_people(world)
               ? JOX_LIVE_ALL_HAVE_LEFT
               : JOX_LIVE_GOES_ON;
}

/* Adds "density": the greatest of any place and time, 1/m2, where and when; null if it is not
   sampled. */
static void add_greatest_density(JoxJson *json, const JoScene *scene) {
    const JoxLocal *local = jox_run_local_densities(scene);
    JoxText where = {0};
    if (!local || local->samples == 0 || !(local->grid->most > 0.0f)) {
        jox_json_null(json, "density");
        return;
    }
    const JoxV2 at = local->grid->most_at;
    jox_place_where(scene->spec->places, scene->spec->place_count, at, true, &where);
    jox_json_object(json, "density");
    jox_json_digits(json, "most", (double)local->grid->most, 6);
    jox_json_numbers_of(json, "at", (double[]){(double)at.x, (double)at.y}, 2, 6);
    jox_json_number(json, "time", local->grid->most_time);
    jox_json_string(json, "where", where.data ? where.data : "");
    jox_json_end(json);
    jox_text_free(&where);
}

static void add_exits(JoxJson *json, const JoxExits *exits) {
    jox_json_array(json, "exits");
    for (uint32_t e = 0; e < exits->count; e++) {
        jox_json_object(json, NULL);
        jox_json_string(json, "name", exits->items[e].name);
        jox_json_whole(json, "people", exits->items[e].people);
        jox_json_number(json, "last", exits->items[e].last);
        jox_json_end(json);
    }
    jox_json_end(json);
}

/* Adds "criteria": those that the scene is held against, with their verdicts up to now. */
static void add_verdicts(JoxJson *json, const JoScene *scene) {
    jox_json_array(json, "criteria");
    for (uint32_t k = 0; k < jox_run_count_criteria(scene); k++) {
        const JoxVerdict v = jox_run_judge(scene, k);
        jox_json_object(json, NULL);
        jox_json_string(json, "name", v.criterion->name);
        jox_json_string(json, "verdict", jox_verdict_names[v.kind]);
        jox_json_number(json, "figure", v.figure);
        jox_json_number(json, "limit", v.limit);
        jox_json_string(json, "unit", v.unit);
        jox_json_end(json);
    }
    jox_json_end(json);
}

/* Appends " --NAME VALUE", quoted for a shell. */
static void append_option(JoxText *out, const char *name, const char *value) {
    jox_text_printf(out, " --%s ", name);
    jox_quote_shell(out, value);
}

/* Appends the settings and mods with which the scene was loaded. */
static void append_load_options(JoxText *out, const JoSceneDef *def) {
    for (size_t s = 0; s < def->override_count; s++)
        append_option(out, "set", def->overrides[s]);
    for (size_t m = 0; m < def->mod_count; m++)
        append_option(out, "mod", def->mods[m]);
    if (def->input_log)
        append_option(out, "input", def->input_log);
}

/* Adds "report" and "compare": commands on this scene with this seed, for a shell. */
static void add_commands(JoxJson *json, const JoScene *scene) {
    const unsigned long long seed = (unsigned long long)scene->world->model.def.seed;
    const double time = jo_world_time(scene->world);
    JoxText line = {0};
    jox_text_add(&line, "jostle run ");
    jox_quote_shell(&line, scene->spec->path);
    append_load_options(&line, &scene->def);
    jox_text_printf(&line, " --seed %llu --for %.6g --report report", seed, time);
    jox_json_string(json, "report", line.data);
    line.length = 0;
    jox_text_add(&line, "jostle compare ");
    jox_quote_shell(&line, scene->spec->path);
    jox_text_printf(&line, " changed.yaml --seed %llu --seeds 10 --for %.6g --out compared", seed,
                    time);
    jox_json_string(json, "compare", line.data);
    jox_text_free(&line);
}

void jox_live_add_end(const JoScene *scene, const JoxLiveSession *session, JoxJson *json) {
    const JoWorld *world = scene->world;
    const JoxLiveEnd end = jox_live_find_end(scene, session);
    if (end == JOX_LIVE_GOES_ON) {
        jox_json_null(json, "end");
        return;
    }
    jox_json_object(json, "end");
    jox_json_string(json, "why", REASONS[end]);
    jox_json_string(json, "failure", end == JOX_LIVE_FAILED_RUN ? session->failure : NULL);
    jox_json_number(json, "time", jo_world_time(world));
    jox_json_whole(json, "seed", world->model.def.seed);
    jox_json_whole(json, "people", world->state.agents.next_id);
    jox_json_whole(json, "left", world->state.exits.left);
    jox_json_whole(json, "inside", world->state.agents.count);
    jox_json_number(json, "last", world->state.exits.left ? world->state.exits.last : NAN);
    jox_json_whole(json, "falls", world->state.statistics.falls);
    jox_json_bool(json, "acted", scene->acted_on);
    add_exits(json, &world->state.exits);
    add_greatest_density(json, scene);
    add_verdicts(json, scene);
    add_commands(json, scene);
    jox_json_end(json);
}
