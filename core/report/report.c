/* jo_report: measures a recording with a scene's probes, or default ones, and writes tables,
   pictures and a page. `jostle report` is the caller. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "picture/plot.h"
#include "picture/probe_files.h"
#include "report/danger_outputs.h"
#include "report/report.h"
#include "run/messages.h"
#include "task/children.h"

enum { REPORT_COOKIE = 0x4a4f5250 };
/* m: margin around all positions, for the area measured without a scene */
static const float EDGE = 0.5f;

JoReportDef jo_default_report_def(void) {
    return (JoReportDef){.cookie = REPORT_COOKIE};
}

static void add_probe_error(JoxReport *r, const char *file, const char *hint, const char *format,
                            const char *probe, const char *what) {
    JoxPosition at = {file, 0, 0, 0};
    jox_diag_error(&r->diagnostics, at, "bad-probe", hint, format, probe, what);
}

/* Maps the groups that a probe of the scene names to the recording's groups. Returns false with
   an error. */
static bool find_recorded_groups(JoxReport *r, const JoxProbeDef *def, uint16_t *out) {
    for (uint32_t g = 0; g < def->group_count; g++) {
        const char *name = r->spec->groups[def->groups[g]].name;
        uint32_t found = 0;
        while (found < r->crowd->group_count && strcmp(r->crowd->groups[found], name) != 0)
            found++;
        if (found == r->crowd->group_count) {
            add_probe_error(
                r, r->def->recording,
                r->crowd->group_count ? NULL : "Take `group` out of the probe",
                "probe '%.60s' measures the group '%.60s', which this recording does not name",
                def->name, name);
            return false;
        }
        out[g] = (uint16_t)found;
    }
    return true;
}

/* Adds a probe of the scene, adapted to the recording. Returns false with an error if the
   recording lacks what it measures. */
static bool add_recording_probe(JoxReport *r, const JoxProbeDef *of) {
    JoxProbeDef def = *of;
    uint16_t *groups = jox_alloc(def.group_count + 1, sizeof *groups);
    bool good = find_recorded_groups(r, &def, groups);
    if (good && (def.kind == JOX_PROBE_FAILURES || def.kind == JOX_PROBE_VISIT)) {
        add_probe_error(r, r->def->scene, "Measure it during a run",
                        "probe '%.60s' needs to know %s; no recording does", def.name,
                        def.kind == JOX_PROBE_VISIT ? "who is in which state"
                                                    : "whose 2-D program failed");
        good = false;
    }
    def.groups = groups;
    JoxV2 low, high;
    def.storeys = jox_trajectories_plan_area(r->crowd, &low, &high);
    if (def.kind == JOX_PROBE_MAP && def.low.x > def.high.x) {
        def.low = jox_sub(low, (JoxV2){EDGE, EDGE});
        def.high = jox_add(high, (JoxV2){EDGE, EDGE});
        def.all_storeys = def.storeys != NULL;
    }
    if (good)
        r->probes[r->count++] = jox_probe_create(&def);
    jox_free(groups);
    return good;
}

/* Adds default probes, for a recording without a scene with probes: fields, and densities and
   speeds over time, over the whole area walked. */
static void add_default_probes(JoxReport *r) {
    JoxV2 low, high;
    const JoxStoreys *storeys = jox_trajectories_plan_area(r->crowd, &low, &high);
    low = jox_sub(low, (JoxV2){EDGE, EDGE});
    high = jox_add(high, (JoxV2){EDGE, EDGE});
    JoxV2 corners[4] = {low, {high.x, low.y}, high, {low.x, high.y}};
    JoxProbeDef map = {.name = "map",
                       .kind = JOX_PROBE_MAP,
                       .until = INFINITY,
                       .low = storeys ? high : low, /* the area of all storeys */
                       .high = storeys ? low : high,
                       .every = 1.0,
                       .cell = JOX_DENSITY_CELL,
                       .kernel = JOX_DENSITY_KERNEL};
    JoxProbeDef all = {.name = "all",
                       .kind = JOX_PROBE_MEASURE,
                       .until = INFINITY,
                       .points = corners,
                       .count = 4,
                       .every = 1.0,
                       .cutoff = 1.0};
    add_recording_probe(r, &map);
    if (!storeys)
        add_recording_probe(r, &all);
    for (uint32_t k = 0; storeys && k < storeys->storey_count; k++) {
        for (int c = 0; c < 4; c++)
            corners[c].y += k > 0 ? storeys->pitch : 0.0f;
        all.name = storeys->storeys[k].name;
        add_recording_probe(r, &all);
    }
}

/* Returns whether the scene lays storeys out as the recording does; false adds an error. */
static bool check_storeys(JoxReport *r) {
    const JoxStoreys *own = &r->crowd->storeys, *scene = r->spec ? &r->spec->storeys : own;
    const JoxPosition at = {r->def->scene, 0, 0, 0};
    if (own->sheet_count == scene->sheet_count && own->pitch == scene->pitch &&
        own->origin == scene->origin)
        return true;
    jox_diag_error(&r->diagnostics, at, "other-storeys",
                   "Give the scene as it was when it was recorded, or none",
                   "the recording has other storeys and stairs than this scene, or a plan of "
                   "another extent");
    return false;
}

/* Sets how far maps show each storey: as far as people and walls were. */
static void set_shown_extent(JoxReport *r) {
    JoxV2 low, high;
    if (!jox_trajectories_plan_area(r->crowd, &low, &high))
        return;
    r->crowd->storeys.low = low.y - EDGE;
    r->crowd->storeys.high = high.y + EDGE;
}

/* Loads the scene and the recording that the def names and creates the probes. Returns false
   with errors. */
static bool load_report(JoxReport *r) {
    const JoReportDef *def = r->def;
    JoxTrajectoryOptions options = {.fps = def->fps, .unit = def->unit};
    if (def->scene && !(r->spec = jox_scene_read(def->scene, NULL, &r->diagnostics)))
        return false;
    if (r->spec && (r->spec->periodic_x || r->spec->periodic_y)) {
        JoxV2 size = jox_sub(r->spec->high, r->spec->low);
        options.period =
            (JoxV2){r->spec->periodic_x ? size.x : 0.0f, r->spec->periodic_y ? size.y : 0.0f};
    }
    if (!(r->crowd = jox_trajectories_read(def->recording, &options, &r->diagnostics)))
        return false;
    set_shown_extent(r);
    r->probes = jox_alloc((r->spec ? r->spec->probe_count : 0) + 2 + r->crowd->storeys.storey_count,
                          sizeof(JoxProbe *));
    if (jox_is_sqlite(def->recording))
        r->body_reader = jox_trajectory_reader_open(def->recording, &options, &r->diagnostics);
    if (r->body_reader && !jox_trajectory_reader_info(r->body_reader).has_bodies) {
        jox_trajectory_reader_close(r->body_reader);
        r->body_reader = NULL;
    }
    bool good = check_storeys(r);
    if (!r->spec || r->spec->probe_count == 0)
        add_default_probes(r);
    for (uint32_t p = 0; r->spec && p < r->spec->probe_count; p++)
        good = add_recording_probe(r, &r->spec->probes[p]) && good;
    return good;
}

/* Writes all files of the report. A JoxChildWork, run in a child process, since the drawing
   libraries may exit when memory runs out. `why` states the reason of a failure and stays empty
   on success. */
static void write_report_in_child(void *report, uint64_t job, JoxText *why) {
    const JoxReport *r = report;
    const char *folder = r->def->directory, *title = jox_report_title(r);
    (void)job;
    bool good = jox_plot_folder(folder, why);
    for (uint32_t p = 0; good && p < r->count; p++)
        good = jox_probe_write(r->probes[p], folder, jox_report_walls(r), title, why);
    good = good && jox_danger_write(r->danger, folder, title, why);
    const JoxSubject subject = jox_report_subject(r);
    good = good && jox_draw_maps(&subject, why) && jox_draw_snapshots(&subject, why) &&
           jox_report_page(r, why);
    if (!good && !why->length)
        jox_text_add(why, "writing failed");
}

/* Writes all files in a child process. Returns false with `error`. */
static bool write_report(JoxReport *r, JoError *error) {
    JoxText why = {0}, ended = {0};
    if (!jox_children_do(write_report_in_child, r, &why, &ended))
        jox_text_printf(&why, "the report in '%s' cannot be written: %s", r->def->directory,
                        ended.data);
    const bool good = why.length == 0;
    if (!good)
        jox_error(error, JO_FAILED, "%s", why.data);
    jox_text_free(&why);
    jox_text_free(&ended);
    return good;
}

/* ---- measuring ---- */

/* Creates the danger measures over the area that a run of the scene would use, else over the
   whole area walked. */
static JoxDanger *create_report_danger(const JoxReport *r) {
    const JoxSceneSpec *spec = r->spec;
    JoxV2 low, high;
    const JoxStoreys *storeys = jox_trajectories_plan_area(r->crowd, &low, &high);
    if (storeys)
        return jox_danger_create(jox_sub(low, (JoxV2){EDGE, EDGE}),
                                 jox_add(high, (JoxV2){EDGE, EDGE}), storeys);
    if (spec && spec->heatmap)
        return jox_danger_create(spec->heatmap_low, spec->heatmap_high, NULL);
    if (spec && spec->bounded)
        return jox_danger_create(spec->low, spec->high, NULL);
    if (spec)
        jox_criteria_extend_area(spec->criteria, spec->criterion_count, spec->places, &low, &high);
    return jox_danger_create(jox_sub(low, (JoxV2){EDGE, EDGE}), jox_add(high, (JoxV2){EDGE, EDGE}),
                             NULL);
}

/* Returns, per frame and once more for the end, how many people were in an earlier frame and are
   in none from there on. */
static uint32_t *count_leavers_by_frame(const JoxTrajectories *t) {
    uint32_t *left = jox_alloc(t->frame_count + 1, sizeof *left);
    /* per key: index of the last frame with the person, plus 1 */
    uint32_t *last = jox_alloc(t->keys + 1, sizeof *last);
    JoxFrame frame;
    for (uint32_t f = 0; jox_trajectories_frame(t, f, &frame); f++)
        for (uint32_t i = 0; i < frame.count; i++)
            last[frame.key[i]] = f + 1;
    for (uint32_t key = 0; key < t->keys; key++)
        if (last[key])
            left[last[key]]++;
    for (uint32_t f = 1; f <= t->frame_count; f++)
        left[f] += left[f - 1];
    jox_free(last);
    return left;
}

/* Sets the number of people who have left by a frame at `time`, s. */
static void set_leavers(JoxReport *r, uint32_t left, double time) {
    if (left > r->exits.left)
        r->exits.last = time;
    r->exits.left = left;
}

/* Passes the moment at which nobody is there any more, if the recording goes on without people
   after frame `f` of those with people, and its last moment. `left` people have left by then. */
static void measure_empty_frame(JoxReport *r, uint32_t f, uint32_t left, const JoxWalls *walls) {
    const JoxTrajectories *t = r->crowd;
    const int64_t next = t->number[t->first[f]] + 1;
    const bool is_last = f + 1 == t->frame_count;
    if (is_last ? next > t->last : next == t->number[t->first[f + 1]])
        return;
    JoxFrame frame = {.time = (double)next / t->fps, .keys = t->keys, .walls = walls};
    set_leavers(r, left, frame.time);
    jox_danger_frame(r->danger, &frame, &r->exits);
    if (!is_last || next == t->last)
        return;
    frame.time = (double)t->last / t->fps;
    jox_danger_frame(r->danger, &frame, &r->exits);
}

/* Passes all frames of the recording to the probes, the danger measures and the story. */
static void measure_recording(JoxReport *r) {
    const JoxTrajectories *t = r->crowd;
    uint32_t *left = count_leavers_by_frame(t);
    JoxFrame frame;
    r->danger = create_report_danger(r);
    if (r->spec)
        jox_danger_add_plan(r->danger, r->spec->places, r->spec->place_count, r->spec->probes,
                            r->spec->probe_count);
    if (r->spec && r->spec->criterion_count)
        r->criteria = jox_criteria_create(r->spec->criteria, r->spec->criterion_count,
                                          r->spec->places, r->spec->place_count);
    for (uint32_t f = 0; jox_trajectories_frame(t, f, &frame); f++) {
        if (!t->history)
            frame.walls = jox_report_walls(r);
        set_leavers(r, left[f], frame.time);
        for (uint32_t p = 0; p < r->count; p++)
            jox_probe_frame(r->probes[p], &frame);
        jox_danger_frame(r->danger, &frame, &r->exits);
        if (r->criteria)
            jox_criteria_sample(r->criteria, r->danger);
        if (jox_danger_local(r->danger)->time == frame.time)
            jox_story_add_sample(
                &r->story, &(JoxStorySample){.frame = &frame,
                                             .grid = jox_danger_local(r->danger)->grid,
                                             .walls = t->history ? jox_trajectories_walls(t, f)
                                                                 : jox_report_walls(r),
                                             .left = r->exits.left,
                                             .body_reader = r->body_reader});
        measure_empty_frame(r, f, left[f + 1], frame.walls);
    }
    jox_free(left);
}

/* Returns the report's summary as JSON. */
static char *build_report_json(const JoxReport *r) {
    const JoxTrajectories *t = r->crowd;
    JoxText out = {0};
    JoxFrame first = {0}, last = {0};
    jox_trajectories_frame(t, 0, &first);
    jox_trajectories_frame(t, t->frame_count - 1, &last);
    JoxJson json = jox_json_begin(&out, 2);
    jox_json_object(&json, NULL);
    jox_json_string(&json, "recording", r->def->recording);
    jox_json_string(&json, "version", jo_version());
    jox_json_whole(&json, "people", t->people);
    jox_json_whole(&json, "frames", t->frame_count);
    jox_json_number(&json, "fps", t->fps);
    jox_json_number(&json, "from_s", first.time);
    jox_json_number(&json, "until_s", last.time);
    jox_json_object(&json, "danger");
    jox_exits_json(&r->exits, (uint32_t)(t->people - r->exits.left), &json);
    jox_danger_json(r->danger, &json);
    jox_json_end(&json);
    jox_json_object(&json, "probes");
    for (uint32_t p = 0; p < r->count; p++)
        jox_probe_json(r->probes[p], &json, jox_probe_def(r->probes[p])->name);
    jox_json_end(&json);
    const JoxCriterionEvidence evidence = jox_report_evidence(r);
    jox_criteria_json(r->criteria, &evidence, &json);
    jox_json_end(&json);
    jox_text_append(&out, "\n", 1);
    return out.data;
}

/* Loads, measures and writes a report. Returns its JSON, or NULL with `error`. */
static char *make_report(const JoReportDef *def, JoError *error) {
    JoxReport r = {.def = def};
    char *text = NULL;
    bool good = load_report(&r);
    if (good)
        measure_recording(&r);
    if (r.spec) /* lets errors quote their lines */
        for (uint32_t f = 0; f < r.spec->file_count; f++)
            jox_diag_attach_source(&r.diagnostics, r.spec->files[f].path, r.spec->files[f].text,
                                   r.spec->files[f].length);
    jox_run_report_diagnostics(def->message, def->message_context, &r.diagnostics, error);
    if (good && (!def->directory || write_report(&r, error)))
        text = build_report_json(&r);
    for (uint32_t p = 0; p < r.count; p++)
        jox_probe_free(r.probes[p]);
    jox_free(r.probes);
    jox_criteria_free(r.criteria);
    jox_danger_free(r.danger);
    jox_exits_free(&r.exits);
    jox_story_free(&r.story);
    jox_trajectory_reader_close(r.body_reader);
    jox_trajectories_free(r.crowd);
    jox_scene_free(r.spec);
    return text;
}

char *jo_report(const JoReportDef *def, JoError *error) {
    JOX_REQUIRE(def && def->cookie == REPORT_COOKIE && def->recording, NULL);
    JOX_REQUIRE(def->fps >= 0.0 && def->fps <= 1e5, NULL);
    JOX_REQUIRE(def->unit >= 0.0 && def->unit <= 1e3, NULL);
    JOX_GUARD (NULL, error) {
        jox_run_send_message(def->message, def->message_context, "out of memory\n");
        return NULL;
    }
    return jox_disown(make_report(def, error));
}
