/* The page (index.html) of a report on a recording, and the recording as the subject of a
   report. */
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/format/path.h"
#include "base/format/plurals.h"
#include "base/hash.h"
#include "base/mem.h"
#include "picture/html.h"
#include "picture/html_sections.h"
#include "picture/plot.h"
#include "report/page_parts.h"
#include "report/report.h"

/* Lists the figures of a recording. */
static JoxPageFigures collect_recording_figures(const JoxReport *r) {
    const JoxTrajectories *t = r->crowd;
    JoxPageFigures f = {0};
    JoxFrame first = {0}, last = {0};
    jox_trajectories_frame(t, 0, &first);
    jox_trajectories_frame(t, t->frame_count - 1, &last);
    f.group = "The recording";
    jox_page_add_figure(&f, "", t->people, "people");
    jox_page_add_figure(&f, "", t->frame_count, "frames with people");
    jox_page_add_figure(&f, "s", first.time, "time of the first frame");
    jox_page_add_figure(&f, "s", last.time, "time of the last frame");
    jox_page_add_exits(&f, &r->exits, (uint32_t)(t->people - r->exits.left));
    jox_page_add_danger(&f, r->danger);
    for (uint32_t p = 0; p < r->count; p++)
        jox_page_add_probe(&f, r->probes[p]);
    return f;
}

static void put_recording_figures(FILE *out, const JoxReport *r, const JoxSubject *s) {
    JoxPageFigures f = collect_recording_figures(r);
    jox_html_heading(out, "All figures");
    jox_html_paragraph(out,
                       "A person has left at the first frame in which they are missing, if they "
                       "never return. Where a recording shows only a part of a place, leaving "
                       "means leaving the picture.");
    jox_page_put_figures(out, s, &f, "figure|>value", NULL);
    jox_page_release(&f);
}

/* Writes what the page is worth: forces are a model's, positions are those of the recording. */
static void put_recording_validation(FILE *out, const JoxReport *r) {
    bool forces = jox_danger_has_measure(r->danger, JOX_DANGER_LOAD);
    jox_page_put_validation(out);
    jox_html_paragraph(
        out, forces
                 ? "None of that validates this recording. It is a simulated crowd; its geometry, "
                   "numbers of people, behaviours and parameters are what its author gave. "
                   "Load in particular is a model's: forces inside real crowds of this size "
                   "have hardly been measured, and the limits come from single persons and from "
                   "what was found after disasters. Read the limits as places and times to look "
                   "at, not as a count of injured."
                 : "All figures of this report follow from positions alone and are as accurate as "
                   "these. "
                   "Velocities are displacements over 0.2 s before and after, unless the recording "
                   "gives them; body sway and tracking noise add to crowd pressure. Read "
                   "the limits as places and times to look at, not as a count of injured.");
}

/* Computes the SHA-256 of a file, mapped as it may be large; "-" if it cannot be mapped. */
static void hash_file(const char *path, char out[65]) {
    struct stat info;
    int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    void *data = MAP_FAILED;
    snprintf(out, 65, "-");
    if (file >= 0 && fstat(file, &info) == 0 && info.st_size > 0)
        data = mmap(NULL, (size_t)info.st_size, PROT_READ, MAP_PRIVATE, file, 0);
    if (data != MAP_FAILED) {
        jox_sha256_hex(data, (size_t)info.st_size, out);
        munmap(data, (size_t)info.st_size);
    }
    if (file >= 0)
        close(file);
}

/* Writes the command that repeats the report, and its input files with their hashes. */
static void put_recording_inputs(FILE *out, const JoxReport *r, const JoxSubject *s,
                                 const char hash[65]) {
    char path[JOX_LONGEST_PATH];
    JoxPageTable table = jox_page_table(s, "files", "file|what it is|SHA-256");
    jox_html_heading(out, "How to repeat the report");
    fputs("<p><code>jostle report ", out);
    jox_html_argument(out, jox_page_path(r->def->recording, NULL, path));
    if (r->def->scene) {
        fputs(" --scene ", out);
        jox_html_argument(out, jox_page_path(r->def->scene, NULL, path));
    }
    if (r->def->fps > 0.0)
        fprintf(out, " --fps %g", r->def->fps);
    if (r->def->unit > 0.0)
        fprintf(out, " --unit %s", r->def->unit == 1.0 ? "m" : "cm");
    fputs(" --out DIR</code></p>\n", out);
    jox_page_add_file(&table, r->def->scene, "recording", r->def->recording, hash);
    for (uint32_t f = 0; r->spec && f < r->spec->file_count; f++)
        jox_page_add_file(&table, r->def->scene, f ? "part of the scene" : "scene",
                          r->spec->files[f].path, r->spec->files[f].sha256);
    jox_table_put(out, &table);
}

/* Writes the head of the page, with the facts of the recording, and lines to sign. */
static void put_recording_title(FILE *out, const JoxReport *r, const JoxSubject *s,
                                const char hash[65], const JoxVerdict *verdicts, uint32_t count) {
    JoxText criteria = {0};
    const JoxSceneReport given = jox_page_head(r->spec ? &r->spec->report : NULL, &r->def->head);
    char path[JOX_LONGEST_PATH], foot[400], program[64], measured[120];
    jox_page_path(r->def->recording, NULL, path);
    snprintf(foot, sizeof foot, "Jostle %s, %.200s, SHA-256 %.16s", jo_version(),
             jox_path_name(path), hash);
    snprintf(program, sizeof program, "Jostle %s", jo_version());
    snprintf(measured, sizeof measured, "%.6g to %.6g s, %g frames a second", s->from, s->until,
             r->crowd->fps);
    jox_page_begin(out, s, &given, "A report on a recording.", foot);
    jox_html_fact(out, "Recording", path);
    jox_html_fact(out, "SHA-256 of the recording", hash);
    if (r->def->scene)
        jox_html_fact(out, "Scene of its plan", jox_page_path(r->def->scene, NULL, path));
    jox_html_fact(out, "Measured", measured);
    jox_html_fact(out, "Program", program);
    jox_page_say_criteria(verdicts, count, &criteria);
    jox_html_fact(out, "Criteria", criteria.data);
    jox_text_free(&criteria);
    jox_html_table_end(out);
    jox_page_put_signatures(out, &given);
}

static void put_recording_summary(FILE *out, const JoxReport *r, const JoxSubject *subject) {
    JoxText text = {0};
    jox_html_heading(out, "Summary");
    fputs("<div class=summary>\n", out);
    char path[JOX_LONGEST_PATH];
    jox_text_printf(&text, "The recording %s: ", jox_page_path(r->def->recording, NULL, path));
    jox_text_noun(&text, r->crowd->people, "person|people");
    jox_text_printf(&text, ", %.1f to %.1f s, ", subject->from, subject->until);
    jox_text_noun(&text, r->crowd->frame_count, "frame");
    jox_text_printf(&text, ", %g a second; measured by Jostle %s.", r->crowd->fps, jo_version());
    jox_html_statement(out, "What was measured.", text.data);
    jox_text_free(&text);
    jox_summary_crowd(out, subject);
    jox_html_statement(
        out, "What is validated, and what is not.",
        jox_danger_has_measure(r->danger, JOX_DANGER_LOAD)
            ? "It is a simulated crowd: the engine is compared with published "
              "measurements (jostle reproduce), this scenario is not."
            : "All figures follow from positions alone and are as accurate as these; "
              "forces on people are not known.");
    fputs("</div>\n", out);
}

bool jox_report_page(const JoxReport *r, JoxText *error) {
    FILE *page = jox_plot_open(r->def->directory, "index.html", error);
    JoxHtmlBody body;
    char hash[65];
    if (!page)
        return false;
    JoxSubject subject = jox_report_subject(r);
    subject.error = error;
    hash_file(r->def->recording, hash);
    jox_html_body_begin(&body);
    FILE *out = body.out;
    if (out) {
        const JoxCriterionEvidence evidence = jox_report_evidence(r);
        const uint32_t count = jox_criteria_count(r->criteria);
        JoxVerdict *verdicts = jox_alloc(count + 1, sizeof *verdicts);
        for (uint32_t k = 0; k < count; k++)
            verdicts[k] = jox_criteria_judge(r->criteria, k, &evidence);
        put_recording_title(page, r, &subject, hash, verdicts, count);
        put_recording_summary(out, r, &subject);
        jox_page_put_criteria(out, &subject, verdicts, count);
        jox_page_put_crowd(out, &subject);
        put_recording_figures(out, r, &subject);
        jox_html_heading(out, "Definitions");
        jox_page_put_definitions(out, subject.danger);
        put_recording_validation(out, r);
        put_recording_inputs(out, r, &subject, hash);
        jox_html_body_put(page, &body);
        jox_free(verdicts);
        jox_html_end(page);
    }
    return jox_plot_close(page, "index.html", error) && out && !error->length;
}

JoxCriterionEvidence jox_report_evidence(const JoxReport *r) {
    return (JoxCriterionEvidence){.danger = r->danger,
                                  .exits = &r->exits,
                                  .inside = (uint32_t)(r->crowd->people - r->exits.left),
                                  .until = (double)r->crowd->last / r->crowd->fps,
                                  .probes = (const JoxProbe *const *)r->probes,
                                  .probe_count = r->count};
}

const JoxWalls *jox_report_walls(const JoxReport *r) {
    return r->spec && r->spec->walls.ring_count && !r->crowd->history ? &r->spec->walls
                                                                      : &r->crowd->walls;
}

const char *jox_report_title(const JoxReport *r) {
    return r->def->head.title          ? r->def->head.title
           : r->spec && r->spec->title ? r->spec->title
                                       : jox_path_name(r->def->recording);
}

JoxSubject jox_report_subject(const JoxReport *r) {
    const JoxTrajectories *t = r->crowd;
    JoxFrame first = {0};
    jox_trajectories_frame(t, 0, &first);
    return (JoxSubject){.title = jox_report_title(r),
                        .folder = r->def->directory,
                        .danger = r->danger,
                        .grid = jox_danger_local(r->danger)->grid,
                        .mean_from = first.time,
                        .exits = &r->exits,
                        .story = &r->story,
                        .bodies = &r->story.moments[JOX_MOMENT_START].bodies,
                        .walls = jox_report_walls(r),
                        .storeys = first.storeys,
                        .lifts = first.lifts,
                        .lift_count = first.lift_count,
                        .places = r->spec ? r->spec->places : NULL,
                        .place_count = r->spec ? r->spec->place_count : 0,
                        .probes = (const JoxProbe *const *)r->probes,
                        .probe_count = r->count,
                        .inside = (uint32_t)(t->people - r->exits.left),
                        .from = first.time,
                        .until = (double)t->last / t->fps,
                        .overlap_p99 = NAN,
                        .depth_p99 = NAN};
}
