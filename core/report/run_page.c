/* jo_scene_page: index.html of a run's report, with its summary, figures, how far half the step
   changes them, and how to repeat it. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/format/plurals.h"
#include "base/guard.h"
#include "base/mem.h"
#include "jostle_tools.h"
#include "picture/html.h"
#include "picture/html_sections.h"
#include "picture/paths.h"
#include "picture/plot.h"
#include "record/danger/trust.h"
#include "report/page_inputs.h"
#include "report/page_parts.h"
#include "report/run_subject.h"
#include "run/criteria_listener.h"
#include "run/figure_listeners.h"
#include "run/literal_notes.h"
#include "run/orca_flow_note.h"
#include "run/probe_listener.h"
#include "run/results/demand.h"
#include "run/results/result_structs.h"
#include "run/run.h"

enum { MOST_GROUPS = 12 }; /* groups named in the summary */

/* Appends per source the people due, arrived, and waiting at the end. */
static void add_demand_figures(JoxPageFigures *f, const JoScene *scene) {
    f->group = "Arrivals by source";
    for (uint32_t s = 0; s < scene->spec->source_count; s++) {
        const JoxDemand demand = jox_run_demand(scene, s);
        JoxText name = {0};
        jox_source_append_name(scene->world, s, &name);
        jox_page_add_figure(f, "", demand.due, "people due at %.100s", name.data);
        jox_page_add_figure(f, "", demand.entered, "people who arrived at %.100s", name.data);
        jox_page_add_figure(f, "", demand.waiting, "people waiting for room at %.100s at the end",
                            name.data);
        jox_page_add_figure(f, "", demand.did_not_come,
                            "people who did not arrive before %.100s ended", name.data);
        jox_text_free(&name);
    }
}

/* Lists the figures of a run, in the same order for any two runs of a scene. */
static JoxPageFigures collect_run_figures(const JoScene *scene) {
    const JoxStatistics *s = &scene->world->state.statistics;
    JoxPageFigures f = {0};
    jox_page_add_exits(&f, &scene->world->state.exits, scene->world->state.agents.count);
    add_demand_figures(&f, scene);
    jox_page_add_danger(&f, jox_run_danger(scene));
    jox_page_add_lifts(&f, scene);
    const JoxRegions *regions = jox_run_regions(scene);
    char group[64] = "Regions";
    if (scene->spec->heatmap_from > 0.0)
        snprintf(group, sizeof group, "Regions (from %.6g s on)", scene->spec->heatmap_from);
    f.group = group;
    for (uint32_t r = 0; regions && r < regions->count; r++)
        jox_page_add_figure(&f, "m/s",
                            regions->items[r].people ? jox_region_speed(&regions->items[r]) : NAN,
                            "mean speed in %.60s", regions->items[r].name);
    const JoxProbe *probe;
    for (uint32_t p = 0; (probe = jox_run_probe(scene, p)); p++)
        jox_page_add_probe(&f, probe);
    f.group = "Accuracy of the simulation";
    jox_page_add_figure(
        &f, "", jox_statistics_overlap_p99(s),
        "overlap of two people that 99 %% of people stay below, share of a person's depth");
    jox_page_add_figure(&f, "m", jox_statistics_depth_p99(s),
                        "overlap of two people that 99 %% of those who touch stay below");
    jox_page_add_figure(
        &f, "", jox_statistics_overlap_share(s, JOX_TRUST_OVERLAP),
        "share of people's time in which they overlap by more than %.0f %% of their depth",
        100.0 * JOX_TRUST_OVERLAP);
    jox_page_add_figure(&f, "", jox_statistics_share(s, s->failures),
                        "share of steps of people in which no velocity met all constraints");
    jox_page_add_figure(&f, "", jox_statistics_share(s, s->turned_aside),
                        "share of steps of people in which they turned aside to get past others");
    jox_page_add_figure(&f, "", jox_statistics_share(s, s->plans_bounded),
                        "share of steps of people in which their contacts or forces asked for more "
                        "than they can do");
    return f;
}

/* ---- parts of the page ---- */

/* Writes the table of all figures, beside those at half the step (`half`), or the reason `why`
   the run was not repeated. */
static void put_run_figures(FILE *out, const JoxSubject *s, const JoScene *scene,
                            const JoScene *half, const char *why) {
    JoxPageFigures whole = collect_run_figures(scene), other = {0};
    char heads[128], text[512];
    jox_html_heading(out, "All figures");
    if (half) {
        other = collect_run_figures(half);
        snprintf(
            text, sizeof text,
            "The same run with the same seed was repeated at half the step, %g s. A figure is "
            "worth no more digits than the two runs agree on. Random numbers differ at another "
            "step, too, so single runs differ as runs with two seeds do.",
            half->world->model.def.dt);
        snprintf(heads, sizeof heads, "figure|>step %g s|>step %g s|>difference",
                 scene->world->model.def.dt, half->world->model.def.dt);
    } else {
        snprintf(text, sizeof text, "The run was not repeated at half the step: %s.",
                 why ? why : "nobody asked for it");
        snprintf(heads, sizeof heads, "figure|>step %g s", scene->world->model.def.dt);
    }
    jox_html_paragraph(out, text);
    jox_page_put_figures(out, s, &whole, heads, half ? &other : NULL);
    jox_page_release(&whole);
    jox_page_release(&other);
}

/* ---- the summary ---- */

/* Writes what was run: the scene, its people by group, duration, step, seed and version. */
static void put_scene_statement(FILE *out, const JoScene *scene, const JoxSubject *subject) {
    const JoxSceneSpec *spec = scene->spec;
    const JoWorld *world = scene->world;
    JoxText text = {0}, demand = {0};
    char path[JOX_LONGEST_PATH];
    jox_text_printf(&text, "The scene %s (%s): ", subject->title,
                    jox_page_path(spec->path, NULL, path));
    jox_text_noun(&text, world->state.agents.next_id, "person|people");
    for (uint32_t g = 0; g < spec->group_count && spec->group_count > 1 && g < MOST_GROUPS; g++) {
        char count[JOX_NOUN];
        jox_text_printf(&text, "%s%.60s %s",
                        g ? ", " : " (groups at the start: ", spec->groups[g].name,
                        jox_number_text(count, spec->groups[g].count));
    }
    if (spec->group_count > 1)
        jox_text_add(&text, spec->group_count > MOST_GROUPS ? ", and others)" : ")");
    if (spec->source_count) {
        jox_text_add(&text, ", also from ");
        jox_text_noun(&text, spec->source_count, "source");
    }
    jox_text_printf(&text,
                    ", simulated once for %.1f s in steps of %g s with seed %llu by Jostle %s.",
                    subject->until, world->model.def.dt, (unsigned long long)world->model.def.seed,
                    jo_version());
    jox_html_statement(out, "What was run.", text.data);
    jox_run_say_demand(scene, &demand);
    if (demand.length)
        jox_html_statement(out, "Who did not arrive.", demand.data + 1);
    jox_text_free(&demand);
    jox_text_free(&text);
}

/* Writes how many people fell, if any did. */
static void put_falls(FILE *out, const JoScene *scene) {
    const JoxStatistics *s = &scene->world->state.statistics;
    JoxText text = {0};
    if (s->falls == 0)
        return;
    jox_text_add(&text, s->falls == 1 ? "There was " : "There were ");
    jox_text_noun(&text, s->falls, "fall|falls");
    jox_text_add(&text, "; at most ");
    jox_text_noun(&text, s->most_fallen, "person|people");
    jox_text_add(&text, " lay at a time.");
    jox_html_statement(out, "Who fell.", text.data);
    jox_text_free(&text);
}

/* Writes what went wrong in the run, and what is validated. */
static void put_caveats(FILE *out, const JoScene *scene) {
    char *troubles = jox_run_troubles(scene);
    if (troubles)
        jox_html_statement(out, "What went wrong.", troubles);
    jo_free(troubles);
    jox_html_statement(
        out, "What is validated, and what is not.",
        "The engine is compared with published measurements and standard tests (jostle "
        "reproduce). This scenario is not: its plan, numbers of people, behaviours and parameters "
        "are its author's, and nothing here was compared with a crowd that did this here. It is "
        "one run with one seed: others give other times; --seeds 20 shows how far they differ.");
}

static void put_run_summary(FILE *out, const JoScene *scene, const JoxSubject *subject) {
    jox_html_heading(out, "Summary");
    fputs("<div class=summary>\n", out);
    put_scene_statement(out, scene, subject);
    jox_summary_crowd(out, subject);
    put_falls(out, scene);
    put_caveats(out, scene);
    fputs("</div>\n", out);
}

/* Writes the figures that only pages of runs have: regions and paths. */
static void put_run_pictures(FILE *out, const JoScene *scene, const char *directory) {
    const JoxRegions *regions = jox_run_regions(scene);
    uint64_t people = 0;
    for (uint32_t r = 0; regions && r < regions->count; r++)
        people += regions->items[r].people;
    if (people)
        jox_html_figure(out, directory, "regions", "Mean speed of the regions", false);
    else if (regions)
        jox_html_paragraph(out, "Mean speed of the regions: nothing was measured, as nobody was in "
                                "a region at a sample (each 2 s).");
    if (scene->world->state.agents.next_id <= JOX_MOST_PATHS)
        jox_html_figure(out, directory, "paths", "Paths of all people", false);
}

/* Writes a note if flows are measured of people who do not follow the walking law, and one for each
   parameter that is set without effect in literal mode. */
static void put_model_notes(FILE *out, const JoScene *scene) {
    JoxDiagnostics notes = {0};
    jox_run_note_orca_flow(scene, &notes);
    jox_run_note_literal(scene, &notes);
    for (size_t n = 0; n < notes.count; n++) {
        const JoxDiagnostic *note = &notes.items[n];
        JoxText text = {0};
        jox_text_printf(&text, "Note: %s", note->message);
        if (note->file && note->line > 0)
            jox_text_printf(&text, " (%s:%d)", note->file, note->line);
        jox_text_printf(&text, ".%s%s%s", note->hint ? " " : "", note->hint ? note->hint : "",
                        note->hint ? "." : "");
        jox_html_paragraph(out, text.data);
        jox_text_free(&text);
    }
    jox_diag_free(&notes);
}

/* Writes the command that repeats the run, and its input files with their hashes. */
static void put_run_inputs(FILE *out, const JoScene *scene, const JoxSubject *s) {
    const JoSceneDef *def = &scene->def;
    const JoWorld *world = scene->world;
    char path[JOX_LONGEST_PATH];
    JoxPageTable table = jox_page_table(s, "files", "file|what it is|SHA-256");
    jox_html_heading(out, "How to repeat the run");
    fputs("<p><code>jostle run ", out);
    jox_html_argument(out, jox_page_path(def->path, NULL, path));
    fprintf(out, " --seed %llu --dt %g --steps %llu", (unsigned long long)world->model.def.seed,
            world->model.def.dt, (unsigned long long)world->state.statistics.steps);
    for (size_t i = 0; i < def->override_count; i++) {
        fputs(" --set ", out);
        jox_html_argument(out, def->overrides[i]);
    }
    fprintf(out, "</code>: state hash %016llx, whatever the number of threads.</p>\n",
            (unsigned long long)jox_world_hash(world));
    for (uint32_t f = 0; f < scene->spec->file_count; f++)
        jox_page_add_file(&table, scene->spec->path, f ? "part of the scene" : "scene",
                          scene->spec->files[f].path, scene->spec->files[f].sha256);
    for (uint32_t m = 0; m < world->model.machines.count; m++) {
        uint32_t count;
        const JoxLuaFile *files = jox_lua_files(scene->lua, world->model.machines.items[m], &count);
        for (uint32_t f = 0; f < count; f++)
            jox_page_add_file(&table, scene->spec->path, f ? "module" : "behaviour", files[f].path,
                              files[f].sha256);
    }
    if (scene->input_path)
        jox_page_add_file(&table, scene->spec->path, "input log", scene->input_path,
                          scene->input_sha256);
    jox_table_put(out, &table);
    for (uint32_t m = 0; m < scene->mods->count; m++) {
        char mod[300];
        snprintf(mod, sizeof mod, "With the mod %.100s %.40s.", scene->mods->items[m].name,
                 scene->mods->items[m].version);
        jox_html_paragraph(out, mod);
    }
}

/* Writes the head of the page, with the facts of the run, and lines to sign. */
static void put_run_title(FILE *out, const JoScene *scene, const JoxSubject *s,
                          const JoxVerdict *verdicts, uint32_t count) {
    const JoxSceneSpec *spec = scene->spec;
    const JoWorld *world = scene->world;
    JoxText criteria = {0};
    char path[JOX_LONGEST_PATH], about[300] = "", foot[400], run[160], hash[32], program[64];
    snprintf(program, sizeof program, "Jostle %s", jo_version());
    jox_page_path(spec->path, NULL, path);
    snprintf(hash, sizeof hash, "%016llx", (unsigned long long)jox_world_hash(world));
    snprintf(foot, sizeof foot, "Jostle %s, %.200s, seed %llu, state %s", jo_version(),
             jox_path_name(path), (unsigned long long)world->model.def.seed, hash);
    snprintf(run, sizeof run, "%.6g s in steps of %g s, one run, seed %llu", s->until,
             world->model.def.dt, (unsigned long long)world->model.def.seed);
    if (spec->about) /* its first sentence; the others are about the live page */
        snprintf(about, sizeof about, "%.*s", (int)(strcspn(spec->about, ".") + 1), spec->about);
    jox_page_begin(out, s, &spec->report, about, foot);
    jox_html_fact(out, "Scene", path);
    jox_html_fact(out, "SHA-256 of the scene", spec->file_count ? spec->files[0].sha256 : NULL);
    jox_html_fact(out, "Simulated", run);
    jox_html_fact(out, "State hash at the end", hash);
    jox_html_fact(out, "Program", program);
    jox_page_say_criteria(verdicts, count, &criteria);
    jox_html_fact(out, "Criteria", criteria.data);
    jox_text_free(&criteria);
    jox_html_table_end(out);
    jox_page_put_signatures(out, &spec->report);
}

bool jo_scene_page(const JoScene *scene, const JoScene *half, const char *why,
                   const char *directory, JoError *error) {
    JOX_REQUIRE(scene && scene->finished && jox_run_danger(scene) && directory, false);
    JOX_REQUIRE(!half || (half->finished && jox_run_danger(half)), false);
    JOX_GUARD (NULL, error)
        return false;
    JoxText text = {0};
    JoxHtmlBody body;
    FILE *page = jox_plot_open(directory, "index.html", &text), *out = NULL;
    if (page) {
        jox_html_body_begin(&body);
        out = body.out;
    }
    if (out) {
        JoxSubject subject = jox_run_subject(scene, directory);
        subject.error = &text;
        const uint32_t count = jox_run_count_criteria(scene);
        JoxVerdict *verdicts = jox_alloc(count + 1, sizeof *verdicts);
        for (uint32_t k = 0; k < count; k++)
            verdicts[k] = jox_run_judge(scene, k);
        put_run_title(page, scene, &subject, verdicts, count);
        put_run_summary(out, scene, &subject);
        jox_page_put_criteria(out, &subject, verdicts, count);
        jox_page_put_inputs(out, scene, &subject, jox_run_drawn_values(scene));
        jox_page_put_crowd(out, &subject);
        put_run_pictures(out, scene, directory);
        put_run_figures(out, &subject, scene, half, why);
        jox_html_heading(out, "Definitions");
        jox_page_put_definitions(out, subject.danger);
        jox_page_put_validation(out);
        jox_html_paragraph(
            out,
            "None of that validates this scenario. Its geometry, numbers of people, behaviours "
            "and parameters are what its author gave; nothing in this report was compared with a "
            "crowd that did this here. Load in particular is a model's: forces inside real crowds "
            "of this size have hardly been measured, the contacts are those of rigid outlines, "
            "and the limits come from single persons and from what was found after disasters. "
            "Read the limits as places and times to look at, not as a count of injured; run "
            "several seeds before comparing plans.");
        put_model_notes(out, scene);
        put_run_inputs(out, scene, &subject);
        jox_run_subject_free(&subject);
        jox_html_body_put(page, &body);
        jox_free(verdicts);
        jox_html_end(page);
    }
    bool good = page && out && jox_plot_close(page, "index.html", &text) && !text.length;
    if (good)
        jox_run_say(scene, "report: %s/index.html\n", directory);
    else
        jox_error(error, JO_FAILED, "%s", text.data ? text.data : "writing failed");
    jox_text_free(&text);
    return good;
}
