#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/cli.h"

static const char HELP[] =
    "usage: jostle check PATH... [--json]\n\n"
    "Reports every error of scenes (.yaml), behaviours (.lua) and folders of them; runs "
    "nothing.\n\n"
    "  --json        one array of {file, line, column, end, severity, code, message, hint}\n"
    "  --reference   print the reference of the scene format\n\n"
    "exit status: 0 nothing wrong, 2 wrong usage, 3 errors found\n";

static void print(void *context, const char *text) {
    fputs(text, context);
}

int cli_check(int argc, char **argv) {
    static const char *const known[] = {"json", "reference", "help", NULL};
    CliArgs args = {.argc = argc, .argv = argv, .next = 1, .command = "check"};
    const char **paths = calloc((size_t)argc, sizeof *paths);
    const char *option, *plain;
    size_t count = 0;
    bool json = false, reference = false;
    int status = -1;
    while ((option = cli_next(&args, &plain)) || plain) {
        if (plain) {
            paths[count++] = plain;
        } else if (!strcmp(option, "json")) {
            json = true;
        } else if (!strcmp(option, "reference")) {
            reference = true;
        } else if (!strcmp(option, "help") || !strcmp(option, "h")) {
            fputs(HELP, stdout);
            status = JO_OK;
            break;
        } else {
            status = cli_unknown(&args, option, known);
            break;
        }
    }
    if (status < 0 && reference) {
        char *text = jo_scene_reference();
        fputs(text, stdout);
        jo_free(text);
        status = JO_OK;
    }
    if (status < 0 && count == 0) {
        fputs("jostle check: no path given\n", stderr);
        status = JO_USAGE;
    }
    if (status < 0) {
        size_t errors = jo_check(paths, count, json, print, stdout);
        status = errors ? JO_INPUT : JO_OK;
        if (!json)
            printf(errors ? "%zu error%s\n" : "nothing wrong\n", errors, errors == 1 ? "" : "s");
    }
    free(paths);
    return status;
}
