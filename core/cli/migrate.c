/* The command `migrate`: rewrites renamed words in scenes and behaviours by jo_migrate. */
#include <stdio.h>

#include "base/format/noun.h"
#include "cli/cli.h"

typedef struct Migrate {
    bool check, trusted;
} Migrate;

static const CliOption OPTIONS[] = {
    {"check", NULL, "change nothing; print what would be changed", CLI_TO(Migrate, check)},
    CLI_TRUSTED_OPTION(Migrate),
};

static int migrate_paths(const CliList *paths, const Migrate *options) {
    CliReach reach = {CLI_READING};
    for (size_t p = 0; p < paths->count; p++) {
        cli_reach_scene(&reach, paths->items[p]);
        if (!options->check)
            cli_reach_output(&reach, paths->items[p]);
    }
    cli_confine_work(&reach, options->trusted);
    JoError error = {0};
    size_t names = 0, errors = 0;
    char number[JOX_NOUN];
    if (!jo_migrate(paths->items, paths->count, !options->check, cli_print, stdout, &names, &errors,
                    &error))
        return cli_failed(&cli_migrate, &error, false);
    printf("%s %s\n", jox_noun(number, names, "name"),
           options->check ? "to be renamed" : "renamed");
    if (errors > 0)
        printf("%s left, which `jostle check` shows\n", jox_noun(number, errors, "error"));
    return errors > 0 ? JO_INPUT : options->check && names > 0 ? JO_FAILED : JO_OK;
}

static int run_migrate(int argc, char **argv) {
    Migrate options = {0};
    CliList paths = {0};
    int status = cli_parse(&cli_migrate, argc, argv, &options, &paths);
    if (status == CLI_GO_ON)
        status = cli_scenes(&cli_migrate, &paths) ? migrate_paths(&paths, &options) : JO_INPUT;
    cli_free(&cli_migrate, &options, &paths);
    return status;
}

const CliCommand cli_migrate = {
    .name = "migrate",
    .what = "rewrite names that have changed",
    .usage = "PATH... [--check]",
    .about = "Rewrites old names in scenes (.yaml), behaviours (.lua) and folders of them: changed "
             "words of the language, renamed shipped behaviours, and names that a behaviour lists "
             "as `renamed`. Comments, layout and all other bytes stay as they are; changes are "
             "printed. `jostle check` reports other errors.",
    .notes = "exit status: 0 done, 1 it could not be done or, with --check, there is something to "
             "change, 2 wrong usage, 3 errors of another kind are left",
    .options = OPTIONS,
    .option_count = sizeof OPTIONS / sizeof *OPTIONS,
    .takes = "path",
    .least = 1,
    .none_said = "no path given",
    .run = run_migrate,
};
