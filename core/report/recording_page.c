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
#include "picture/html.h"
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

static void put_recording_figures(FILE *out, const JoxReport *r) {
    JoxPageFigures f = collect_recording_figures(r);
    jox_html_heading(out, "All figures");
    jox_html_paragraph(out,
                       "A person has left at the first frame in which they are missing, if they "
                       "never return. Where a recording shows only a part of a place, leaving "
                       "means leaving the picture.");
    jox_page_put_figures(out, &f, "figure|>value", NULL, NULL);
    jox_page_release(&f);
}

/* Writes what the page is worth: forces are a model's, positions are those of the recording. */
static void put_recording_validation(FILE *out, const JoxReport *r) {
    bool forces = jox_danger_has_measure(r->danger, JOX_DANGER_LOAD);
    jox_page_put_validation(out);
    jox_html_paragraph(
        out,
        forces
            ? "None of that validates this recording. It is a simulated crowd; its geometry, "
              "numbers of people, behaviours and parameters are what its author gave. "
              "Load in particular is a model's: forces inside real crowds of this size "
              "have hardly been measured, and the limits come from single persons and from "
              "what was found after disasters. Read the limits as places and times to look "
              "at, not as a count of injured."
            : "All figures on this page follow from positions alone and are as accurate as these. "
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
static void put_recording_inputs(FILE *out, const JoxReport *r) {
    char hash[65];
    jox_html_heading(out, "How to repeat it");
    fputs("<p><code>jostle report ", out);
    jox_html_argument(out, r->def->recording);
    if (r->def->scene) {
        fputs(" --scene ", out);
        jox_html_argument(out, r->def->scene);
    }
    if (r->def->fps > 0.0)
        fprintf(out, " --fps %g", r->def->fps);
    if (r->def->unit > 0.0)
        fprintf(out, " --unit %s", r->def->unit == 1.0 ? "m" : "cm");
    fputs(" --out DIR</code></p>\n", out);
    jox_html_table(out, "input|SHA-256");
    hash_file(r->def->recording, hash);
    jox_html_row(out);
    jox_html_cell(out, r->def->recording);
    jox_html_cell(out, hash);
    for (uint32_t f = 0; r->spec && f < r->spec->file_count; f++) {
        jox_html_row(out);
        jox_html_cell(out, r->spec->files[f].path);
        jox_html_cell(out, r->spec->files[f].sha256);
    }
    jox_html_table_end(out);
}

static void put_recording_summary(FILE *out, const JoxReport *r, const JoxSubject *subject) {
    JoxText text = {0};
    jox_html_heading(out, "Summary");
    fputs("<div class=summary>\n", out);
    jox_text_printf(&text, "The recording %s: ", r->def->recording);
    jox_text_noun(&text, r->crowd->people, "person|people");
    jox_text_printf(&text, ", %.1f to %.1f s, ", subject->from, subject->until);
    jox_text_noun(&text, r->crowd->frame_count, "frame");
    jox_text_printf(&text, ", %g a second; measured by Jostle %s.", r->crowd->fps, jo_version());
    jox_html_statement(out, "What was measured.", text.data);
    jox_text_free(&text);
    jox_summary_crowd(out, subject);
    jox_html_statement(
        out, "What this is worth.",
        jox_danger_has_measure(r->danger, JOX_DANGER_LOAD)
            ? "It is a simulated crowd: the engine is compared with published "
              "measurements (jostle reproduce), this scenario is not."
            : "All figures follow from positions alone and are as accurate as these; "
              "forces on people are not known.");
    fputs("</div>\n", out);
}

bool jox_report_page(const JoxReport *r, JoxText *error) {
    FILE *out = jox_plot_open(r->def->directory, "index.html", error);
    if (!out)
        return false;
    const JoxSubject subject = jox_report_subject(r);
    jox_html_begin(out, subject.title);
    put_recording_summary(out, r, &subject);
    jox_page_put_crowd(out, &subject);
    put_recording_figures(out, r);
    jox_html_heading(out, "How danger is measured");
    jox_page_put_definitions(out, subject.danger);
    put_recording_validation(out, r);
    put_recording_inputs(out, r);
    jox_html_end(out);
    return jox_plot_close(out, "index.html", error);
}

const JoxWalls *jox_report_walls(const JoxReport *r) {
    return r->spec && r->spec->walls.ring_count && !r->crowd->history ? &r->spec->walls
                                                                      : &r->crowd->walls;
}

const char *jox_report_title(const JoxReport *r) {
    return r->spec && r->spec->title ? r->spec->title : jox_path_name(r->def->recording);
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
