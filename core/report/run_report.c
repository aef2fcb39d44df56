/* jo_scene_report and jo_scene_data: listeners of a run (run/listener.h) that write its report
   at the end: CSV files of probes, danger and sources, and for the first also plots, maps and
   snapshots. */
#include <errno.h>
#include <stdio.h>

#include "base/assert.h"
#include "base/file.h"
#include "base/format/path.h"
#include "base/format/quote.h"
#include "base/guard.h"
#include "base/mem.h"
#include "jostle_tools.h"
#include "picture/paths.h"
#include "picture/plot.h"
#include "picture/probe_files.h"
#include "report/danger_outputs.h"
#include "report/drawn_values.h"
#include "report/lift_times.h"
#include "report/run_subject.h"
#include "run/figure_listeners.h"
#include "run/present_frame.h"
#include "run/probe_listener.h"
#include "run/results/demand.h"
#include "task/children.h"

/* s: interval between points of paths, or a step if that is longer */
static const double PACE = 0.1;

/* State of the listener, attached by jo_scene_report or jo_scene_data. */
typedef struct RunReport {
    JoScene *scene;
    char *folder;
    FILE *folder_lock; /* lock on the folder, held until release */
    JoxPaths *paths;   /* NULL for jo_scene_data: CSV files only */
    JoxStory story;
    JoxDrawnValues drawn;
    JoxLiftTimes lifts;
} RunReport;

static const JoxListenerKind REPORT;

/* Locks the folder and starts the collection of danger. Returns false with `error`. */
static bool begin_data_files(void *self, JoScene *scene, const void *folder, JoError *error) {
    RunReport *r = self;
    JoxText why = {0};
    if (!jox_plot_folder(folder, &why))
        return jox_run_fill_error(error, &why);
    r->folder_lock = jox_folder_claim(folder);
    if (!r->folder_lock) {
        jox_text_printf(&why, "cannot write into '%s': %s", (const char *)folder,
                        jox_file_error_text(errno));
        return jox_run_fill_error(error, &why);
    }
    r->scene = scene;
    r->folder = jox_strdup(folder);
    return jox_run_collect_danger(scene, error);
}

static bool begin_report_files(void *self, JoScene *scene, const void *folder, JoError *error) {
    RunReport *r = self;
    if (!begin_data_files(self, scene, folder, error))
        return false;
    r->paths = jox_paths_create();
    return true;
}

/* Adds a sample to the story whenever the density was sampled in this step. */
static void sample_story(RunReport *r, JoScene *scene) {
    const JoxLocal *local = jox_run_local_densities(scene);
    if (local->time != jo_world_time(scene->world))
        return;
    jox_story_add_sample(&r->story,
                         &(JoxStorySample){.frame = jox_run_present_frame(scene, JOX_FRAME_WHOLE),
                                           .grid = local->grid,
                                           .walls = &scene->world->model.all_walls,
                                           .left = scene->world->state.exits.left,
                                           .bodies = scene->world->state.bodies});
}

/* Samples the story, and every PACE seconds the positions of the first JOX_MOST_PATHS agents and
   of moving bodies. */
static bool sample_run(void *self, JoScene *scene, JoError *error) {
    RunReport *r = self;
    const JoWorld *world = scene->world;
    const JoxAgents *a = &world->state.agents;
    float time = (float)jo_world_time(world);
    (void)error;
    sample_story(r, scene);
    jox_lift_times_add(&r->lifts, scene);
    jox_drawn_values_add(&r->drawn, world);
    if (!jox_run_is_sample_due(scene, PACE))
        return true;
    for (uint32_t rank = 0; rank < a->count; rank++) {
        uint32_t i = a->by_rank[rank];
        if (a->id[i] >= JOX_MOST_PATHS)
            break;
        jox_paths_add(r->paths, a->id[i], false, a->group[i], time, a->x[i], a->y[i]);
    }
    for (uint32_t o = 0; o < world->scratch.objects.count; o++) {
        const JoxObject *object = &world->scratch.objects.rows[o];
        if (object->live && object->moves)
            jox_paths_add(r->paths, object->id, true, 0, time, object->position.x,
                          object->position.y);
    }
    return true;
}

/* Draws paths.png with the area of the scene, widened to contain all paths. */
static bool draw_paths(const RunReport *r, const JoScene *scene, const char *title, JoxText *why) {
    const char *names[256];
    JoxColour colours[256];
    uint32_t count = scene->spec->group_count < 256 ? scene->spec->group_count : 256;
    JoxV2 low, high;
    for (uint32_t g = 0; g < count; g++) {
        names[g] = scene->spec->groups[g].name;
        colours[g] = scene->spec->groups[g].colour;
    }
    const JoxStoreys *storeys = jox_run_find_plan_area(scene, &low, &high);
    for (uint32_t p = 0; p < r->paths->count; p++)
        for (uint32_t i = 0; i < r->paths->items[p].count; i++) {
            const JoxPathPoint *point = &r->paths->items[p].points[i];
            const JoxV2 at = jox_in_plan(storeys, (JoxV2){point->x, point->y});
            low = (JoxV2){jox_minf(low.x, at.x - 1), jox_minf(low.y, at.y - 1)};
            high = (JoxV2){jox_maxf(high.x, at.x + 1), jox_maxf(high.y, at.y + 1)};
        }
    return jox_plot_paths(r->folder, r->paths, names, colours, count,
                          &scene->world->model.all_walls, storeys, low, high, title, why);
}

/* Writes danger-sources.csv, if the scene has sources: people due, arrived and waiting. */
static bool write_source_table(const char *folder, const JoScene *scene, JoxText *why) {
    const uint32_t count = scene->spec->source_count;
    FILE *out = count ? jox_plot_open(folder, "danger-sources.csv", why) : NULL;
    if (!out)
        return count == 0;
    fputs("source,due,came,waiting,did_not_come\n", out);
    for (uint32_t s = 0; s < count; s++) {
        const JoxDemand demand = jox_run_demand(scene, s);
        JoxText name = {0};
        jox_source_append_name(scene->world, s, &name);
        jox_quote_put(out, jox_quote_csv, name.data);
        fprintf(out, ",%.0f,%.0f,%.0f,%.0f\n", demand.due, demand.entered, demand.waiting,
                demand.did_not_come);
        jox_text_free(&name);
    }
    return jox_plot_close(out, "danger-sources.csv", why);
}

/* Writes the files of probes, danger and sources; with a title, their plots too. */
static bool write_data_files(const RunReport *r, const JoScene *scene, const char *title,
                             JoxText *why) {
    const JoxProbe *probe;
    bool good = true;
    for (uint32_t p = 0; good && (probe = jox_run_probe(scene, p)); p++)
        good = jox_probe_write(probe, r->folder, &scene->world->model.all_walls, title, why);
    return good && jox_danger_write(jox_run_danger(scene), r->folder, title, why) &&
           write_source_table(r->folder, scene, why) &&
           jox_lift_times_write(&r->lifts, scene, r->folder, title, why);
}

static bool sample_data_files(void *self, JoScene *scene, JoError *error) {
    RunReport *r = self;
    (void)error;
    jox_lift_times_add(&r->lifts, scene);
    return true;
}

static bool end_data_files(void *self, JoScene *scene, JoError *error) {
    JoxText why = {0};
    return write_data_files(self, scene, NULL, &why) || jox_run_fill_error(error, &why);
}

/* Input of draw_report_in_child. */
typedef struct RunDrawing {
    const RunReport *report;
    const JoScene *scene;
    const JoxSubject *subject;
} RunDrawing;

/* Draws maps, snapshots, regions and paths, then writes the files of probes and danger. */
static bool draw_run_report(const RunDrawing *d, JoxText *why) {
    const RunReport *r = d->report;
    const JoScene *scene = d->scene;
    char title[256];
    const char *name = scene->spec->title ? scene->spec->title : jox_path_name(scene->spec->path);
    const double until = jo_world_time(scene->world);
    const JoxRegions *regions = jox_run_regions(scene);
    const bool paths = scene->world->state.agents.next_id <= JOX_MOST_PATHS && r->paths->count;
    bool good = jox_draw_maps(d->subject, why) && jox_draw_snapshots(d->subject, why);
    if (good && regions) {
        snprintf(title, sizeof title, "%.120s: mean speed per region, t = %.0f to %.0f s", name,
                 scene->spec->heatmap_from, until);
        good = jox_plot_regions(r->folder, regions, title, why);
    }
    if (good && paths) {
        snprintf(title, sizeof title,
                 "%.120s: paths (a dot is the beginning, a circle the end), %.1f s", name, until);
        good = draw_paths(r, scene, title, why);
    }
    return good && write_data_files(r, scene, name, why);
}

/* Draws the report. A JoxChildWork, run in a child process, since the drawing libraries may exit
   when memory runs out. `why` states the reason of a failure and stays empty on success. */
static void draw_report_in_child(void *drawing, uint64_t job, JoxText *why) {
    (void)job;
    if (!draw_run_report(drawing, why) && !why->length)
        jox_text_add(why, "writing failed");
}

/* Draws the report in a child process. Returns false with `error`. */
static bool end_run_report(void *self, JoScene *scene, JoError *error) {
    const RunReport *r = self;
    JoxText why = {0}, ended = {0};
    JoxSubject subject = jox_run_subject(scene, r->folder);
    RunDrawing drawing = {r, scene, &subject};
    if (!jox_children_do(draw_report_in_child, &drawing, &why, &ended))
        jox_text_printf(&why, "the report in '%s' cannot be drawn: %s", r->folder, ended.data);
    jox_run_subject_free(&subject);
    jox_text_free(&ended);
    if (why.length)
        return jox_run_fill_error(error, &why);
    jox_text_free(&why);
    return true;
}

/* Lists the state of the report as sections, with members of the scene that the page states. */
static void list_report_sections(void *self, JoxSections *s) {
    RunReport *r = self;
    JOX_SECTION(s, "swap_seconds", r->scene->swap_seconds);
    JOX_SECTION(s, "acted_on", r->scene->acted_on);
    jox_lift_times_sections(&r->lifts, r->scene, s);
    if (r->paths)
        jox_paths_sections(r->paths, s);
    if (r->paths)
        jox_story_sections(&r->story, s);
    if (r->paths)
        jox_drawn_values_sections(&r->drawn, s);
}

static void release_run_report(void *self) {
    RunReport *r = self;
    if (r->folder_lock)
        jox_file_close(r->folder_lock);
    jox_free(r->folder);
    jox_paths_free(r->paths);
    jox_story_free(&r->story);
    jox_free(r->drawn.items);
    jox_free(r->lifts.rows);
}

static const JoxListenerKind REPORT = {.name = "report",
                                       .size = sizeof(RunReport),
                                       .begin = begin_report_files,
                                       .frame = sample_run,
                                       .sections = list_report_sections,
                                       .goes_on = true,
                                       .end = end_run_report,
                                       .release = release_run_report};
static const JoxListenerKind DATA = {.name = "data files",
                                     .size = sizeof(RunReport),
                                     .begin = begin_data_files,
                                     .frame = sample_data_files,
                                     .sections = list_report_sections,
                                     .goes_on = true,
                                     .end = end_data_files,
                                     .release = release_run_report};

const JoxDrawnValues *jox_run_drawn_values(const JoScene *scene) {
    static const JoxDrawnValues none;
    const RunReport *report = jox_run_find_listener(scene, &REPORT);
    return report ? &report->drawn : &none;
}

JoxSubject jox_run_subject(const JoScene *scene, const char *folder) {
    const RunReport *report = jox_run_find_listener(scene, &REPORT);
    static const JoxStory none;
    const JoxLocal *local = jox_run_local_densities(scene);
    const JoxSceneSpec *spec = scene->spec;
    const JoxStatistics *statistics = &scene->world->state.statistics;
    const JoxProbe **probes = jox_alloc(spec->probe_count + 1, sizeof *probes);
    for (uint32_t p = 0; p < spec->probe_count; p++)
        probes[p] = jox_run_probe(scene, p);
    const uint32_t lift_count = scene->world->model.lift_count;
    JoxLiftResult *rides = jox_alloc((size_t)lift_count + 1, sizeof *rides);
    for (uint32_t l = 0; l < lift_count; l++)
        rides[l] = jox_run_lift_result(scene->world, l);
    const JoxStoreys *storeys = &scene->world->model.storeys;
    JoxStranded *stranded = jox_alloc((size_t)storeys->storey_count + 1, sizeof *stranded);
    for (uint32_t k = 0; k < storeys->storey_count; k++)
        stranded[k] = jox_world_count_stranded(scene->world, (int32_t)k);
    return (JoxSubject){.title = spec->title ? spec->title : jox_path_name(spec->path),
                        .folder = folder,
                        .danger = jox_run_danger(scene),
                        .grid = local->grid,
                        .mean_from = spec->heatmap_from,
                        .exits = &scene->world->state.exits,
                        .story = report ? &report->story : &none,
                        .bodies = report ? &report->story.moments[JOX_MOMENT_START].bodies : NULL,
                        .walls = &scene->world->model.all_walls,
                        .storeys = jox_has_storeys(storeys) ? storeys : NULL,
                        .lifts = scene->world->model.lifts,
                        .lift_count = scene->world->model.lift_count,
                        .places = spec->places,
                        .place_count = spec->place_count,
                        .probes = probes,
                        .probe_count = spec->probe_count,
                        .rides = rides,
                        .stranded = stranded,
                        .inside = scene->world->state.agents.count,
                        .until = jo_world_time(scene->world),
                        .simulated = true,
                        .overlap_p99 = jox_statistics_overlap_p99(statistics),
                        .depth_p99 = jox_statistics_depth_p99(statistics)};
}

void jox_run_subject_free(JoxSubject *s) {
    jox_free((void *)(uintptr_t)s->probes);
    jox_free((void *)(uintptr_t)s->rides);
    jox_free((void *)(uintptr_t)s->stranded);
    s->probes = NULL;
    s->rides = NULL;
    s->stranded = NULL;
}

bool jo_scene_report(JoScene *scene, const char *directory, JoError *error) {
    JOX_REQUIRE(scene && !scene->world->busy && directory && !jox_run_find_listener(scene, &REPORT),
                false);
    JOX_GUARD (scene->heap, error)
        return false;
    return jox_run_attach_listener(scene, &REPORT, directory, error) != NULL;
}

bool jo_scene_data(JoScene *scene, const char *directory, JoError *error) {
    JOX_REQUIRE(scene && !scene->world->busy && directory && !jox_run_find_listener(scene, &DATA),
                false);
    JOX_GUARD (scene->heap, error)
        return false;
    return jox_run_attach_listener(scene, &DATA, directory, error) != NULL;
}
