/* The page of runs with many seeds, which a sweep's file keeps. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/mem.h"
#include "cli/cli.h"
#include "jostle_tools.h"

bool cli_is_sweep(const char *path) {
    enum { AT = 68 }; /* of the number of who wrote an SQLite file */
    unsigned char head[AT + 4] = {0};
    FILE *file = fopen(path, "rb");
    const size_t got = file ? fread(head, 1, sizeof head, file) : 0;
    if (file)
        fclose(file);
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

int cli_runs_page(const CliCommand *command, const char *runs, const char *folder, bool quiet) {
    JoCompareDef def = jo_default_compare_def();
    JoError error = {0};
    def.sides = &runs;
    def.side_count = 1;
    def.out = folder;
    char *text = jo_compare(&def, NULL, &error);
    if (!text)
        return cli_failed(command, &error, false);
    if (!quiet)
        fprintf(stderr, "%s\nreport: %s/index.html\nruns: %s\n", text, folder, runs);
    jo_free(text);
    return JO_OK;
}
