/* The last lines of a run. */
#include <stdio.h>
#include <string.h>

#include "cli/cli.h"

void cli_closing(const JoScene *scene, const CliRunFiles *files) {
    const struct {
        const char *what, *path, *more;
    } all[] = {{"report", files->report, "/index.html"}, {"tables", files->data, ""},
               {"recording", files->record, ""},         {"input log", files->log, ""},
               {"checkpoints", files->checkpoints, ""},  {"figures", files->summary, ""}};
    JoxText text = {0}, lines = {0};
    char *closing = jo_scene_closing(scene);
    if (!closing)
        return;
    jox_text_add(&text, closing);
    const char *before = " Files: ";
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        if (!all[k].path || strcmp(all[k].path, "-") == 0)
            continue;
        jox_text_printf(&text, "%s%s %s%s", before, all[k].what, all[k].path, all[k].more);
        before = ", ";
    }
    if (*before == ',')
        jox_text_add(&text, ".");
    cli_wrap(&lines, text.data, text.length, 0, 0);
    fputs(lines.data, stderr);
    jox_text_free(&text);
    jox_text_free(&lines);
    jo_free(closing);
}
