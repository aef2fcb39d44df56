/* Writes the page of a run's report, after the same run at half the time step, and the page of runs
   with many seeds from a sweep's file. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/file.h"
#include "base/mem.h"
#include "cli/cli.h"
#include "jostle_tools.h"

static const double LEAST_DT = 0.001; /* s */

static JoScene *load_half_step(const CliReportPage *page, JoError *error) {
    const JoxOverlay *before = jox_overlay_use(page->files);
    JoScene *half = jo_scene_half_step(page->def, page->scene, error);
    jox_overlay_use(before);
    return half;
}

/* Steps the run at half the time step to its end; false if interrupted, or with `error`. */
static bool run_half_step(const CliReportPage *page, JoScene *half, JoError *error) {
    const double dt = jo_scene_stats(half).dt;
    bool ok = true;
    if (!page->quiet) {
        fprintf(stderr, "once more at half the step, %g s:\n", dt);
        jo_scene_show_progress(half, (double)(2 * page->steps) * dt);
    }
    for (uint64_t i = 0; ok && i < 2 * page->steps && !cli_signal; i++)
        ok = jo_scene_step(half, error);
    return ok && !cli_signal && jo_scene_finish(half, error);
}

int cli_write_report_page(const CliCommand *command, const CliReportPage *page) {
    JoError error = {0}, written = {0};
    const char *why = cli_signal                                      ? "the run was interrupted"
                      : page->no_half                                 ? "--no-half-step was given"
                      : jo_scene_stats(page->scene).dt / 2 < LEAST_DT ? "it would be below 0.001 s"
                                                                      : NULL;
    JoScene *half = why ? NULL : load_half_step(page, &error);
    if (!why && !half)
        why = error.text;
    if (half && !run_half_step(page, half, &error)) {
        why = cli_signal ? "it was interrupted" : error.text;
        jo_scene_free(half);
        half = NULL;
    }
    const bool ok = jo_scene_page(page->scene, half, why, page->folder, &written);
    jo_scene_free(half);
    return ok ? JO_OK : cli_report_error(command, &written, false);
}

/* ---- runs with many seeds ---- */

bool cli_is_sweep(const char *path) {
    enum { AT = 68 }; /* offset of the application id in an SQLite file */
    unsigned char head[AT + 4] = {0};
    FILE *file = jox_file_open(path, "rb"); /* refuses pipes, which would block */
    const size_t got = file ? fread(head, 1, sizeof head, file) : 0;
    if (file)
        jox_file_close(file);
    return got == sizeof head && !memcmp(head, "SQLite format 3", 16) &&
           !memcmp(head + AT, "JSwp", 4);
}

bool cli_make_folder(const CliCommand *command, const char *path) {
    char *folder = jox_strdup(path);
    bool good = true;
    for (char *at = folder + 1; good && *folder; at++) {
        const char was = *at;
        if (was && was != '/')
            continue;
        *at = 0;
        good = mkdir(folder, 0777) == 0 || errno == EEXIST;
        if (!good)
            fprintf(stderr, "jostle %s: cannot make the folder '%s': %s\n", command->name, folder,
                    strerror(errno));
        *at = was;
        if (!was)
            break;
    }
    jox_free(folder);
    return good;
}

int cli_write_runs_page(const CliCommand *command, const char *runs, const char *folder,
                        const JoReportHead *head, bool quiet) {
    JoCompareDef def = jo_default_compare_def();
    JoError error = {0};
    def.sides = &runs;
    def.side_count = 1;
    def.out = folder;
    def.head = *head;
    char *text = jo_compare(&def, NULL, &error);
    if (!text)
        return cli_report_error(command, &error, false);
    if (!quiet)
        fprintf(stderr, "%s\nreport: %s/index.html\nruns: %s\n", text, folder, runs);
    jo_free(text);
    return JO_OK;
}
