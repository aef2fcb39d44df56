/* Scenes by their names alone, and those worth seeing first. */
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "base/overlay.h"
#include "base/text.h"
#include "cli/cli.h"

static const struct {
    const char *name, *what;
} WORTH_SEEING[] = {
    {"tawaf", "35,000 pilgrims go round the Kaaba; some queue at the Black Stone"},
    {"office", "a crowd streams through an office and pushes its furniture about"},
    {"dodgeball", "two teams, one ball: throw, dodge, fetch"},
    {"wall-breaking", "a crowd presses against a wall of blocks until it breaks"},
    {"circle", "a thousand people cross to the other side of a circle"},
    {"two-bottlenecks", "a thousand people press through two narrow gaps"},
    {"evacuation", "people leave a hall; who is late, and where it gets dense"},
    {"running-through", "a runner pushes through a standing crowd"},
};

char *cli_scene(const char *given) {
    static const char *const PLACES[] = {"%s.yaml", "scenes/%s.yaml",
                                         JOX_DATADIR "/scenes/%s.yaml"};
    const bool is_name = *given && strcspn(given, "/.") == strlen(given);
    for (size_t p = 0; is_name && !jox_is_file(given) && p < sizeof PLACES / sizeof *PLACES; p++) {
        JoxText path = {0};
        const size_t before = strcspn(PLACES[p], "%");
        jox_text_printf(&path, "%.*s%s%s", (int)before, PLACES[p], given, PLACES[p] + before + 2);
        if (jox_is_file(path.data))
            return path.data;
        jox_text_free(&path);
    }
    if (is_name && !jox_is_file(given))
        fprintf(stderr,
                "jostle: no scene '%s' lies here or in scenes/, or came with Jostle; `jostle` "
                "lists some that did\n",
                given);
    return jox_strdup(given);
}

void cli_list_scenes(FILE *out) {
    fputs("\nWorth seeing, in a browser:\n\n", out);
    for (size_t s = 0; s < sizeof WORTH_SEEING / sizeof *WORTH_SEEING; s++)
        fprintf(out, "  jostle run %-16s --view  %s\n", WORTH_SEEING[s].name, WORTH_SEEING[s].what);
}
