#include <stdio.h>

#include "cli/cli.h"

typedef struct Check {
    bool json, reference, trusted;
} Check;

static const CliOption OPTIONS[] = {
    {"json", NULL, "one array of {file, line, column, end, severity, code, message, hint}",
     CLI_TO(Check, json)},
    {"reference", NULL, "print the reference of the scene format", CLI_TO(Check, reference)},
    CLI_TRUSTED_OPTION(Check),
};

static int check_paths(const CliList *paths, bool json, bool trusted) {
    if (paths->count == 0)
        return cli_report_misuse(&cli_check, "no path given");
    CliReach reach = {CLI_READING};
    for (size_t p = 0; p < paths->count; p++)
        cli_reach_scene(&reach, paths->items[p]);
    cli_confine_work(&reach, trusted);
    JoError error;
    if (json)
        cli_output_is_data();
    size_t errors = jo_check(paths->items, paths->count, json, cli_print, stdout, &error);
    if (errors == SIZE_MAX)
        return cli_report_error(&cli_check, &error, false);
    return errors ? JO_INPUT : JO_OK;
}

static int run_check(int argc, char **argv) {
    Check options = {0};
    CliList paths = {0};
    int status = cli_parse(&cli_check, argc, argv, &options, &paths);
    if (status == CLI_GO_ON && options.reference) {
        char *text = jo_scene_reference();
        status = text ? JO_OK : JO_FAILED;
        fputs(text ? text : "", stdout); /* main says where that fails */
        jo_free(text);
    } else if (status == CLI_GO_ON) {
        status = options.json || cli_scenes(&cli_check, &paths)
                     ? check_paths(&paths, options.json, options.trusted)
                     : JO_INPUT;
    }
    cli_free(&cli_check, &options, &paths);
    return status;
}

const CliCommand cli_check = {
    .name = "check",
    .what = "find every error in scenes and behaviours, without running",
    .usage = "PATH... [--json]",
    .about = "Reports every error of scenes (.yaml), behaviours (.lua) and folders of them; runs "
             "nothing.",
    .notes = "exit status: 0 nothing wrong, 1 it could not be done, 2 wrong usage, 3 errors found",
    .options = OPTIONS,
    .option_count = sizeof OPTIONS / sizeof *OPTIONS,
    .takes = "path",
    .run = run_check,
};
