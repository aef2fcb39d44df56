/* The page of a run's report, with the same run at half the step beside it. */
#include <stdio.h>

#include "cli/cli.h"
#include "jostle_tools.h"

static const double LEAST_DT = 0.001; /* s */

static JoScene *load_half(const CliReportPage *page, JoError *error) {
    const bool vetted = page->files && page->files->sealed;
    const JoxOverlay *before = vetted ? jox_overlay_use(page->files) : NULL;
    JoScene *half = jo_scene_half_step(page->def, page->scene, error);
    if (vetted)
        jox_overlay_use(before);
    return half;
}

/* All its steps; false where it was interrupted, or with `error`. */
static bool run_half(const CliReportPage *page, JoScene *half, JoError *error) {
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

int cli_report_page(const CliCommand *command, const CliReportPage *page) {
    JoError error = {0}, written = {0};
    const char *why = cli_signal                                      ? "the run was interrupted"
                      : page->no_half                                 ? "--no-half-step was given"
                      : jo_scene_stats(page->scene).dt / 2 < LEAST_DT ? "it would be below 0.001 s"
                                                                      : NULL;
    JoScene *half = why ? NULL : load_half(page, &error);
    if (!why && !half)
        why = error.text;
    if (half && !run_half(page, half, &error)) {
        why = cli_signal ? "it was interrupted" : error.text;
        jo_scene_free(half);
        half = NULL;
    }
    const bool ok = jo_scene_page(page->scene, half, why, page->folder, &written);
    jo_scene_free(half);
    return ok ? JO_OK : cli_failed(command, &written, false);
}
