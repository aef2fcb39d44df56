/* The command `test`: runs tests of behaviours by jo_test. */
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/format/path.h"
#include "cli/cli.h"

typedef struct Test {
    const char *only;
    bool json, trusted;
} Test;

static const CliOption OPTIONS[] = {
    {"only", "TEXT", "run only tests whose name contains TEXT", CLI_TO(Test, only)},
    {"json", NULL, "print a JSON array of {file, line, name, passed, simulated_s, message}",
     CLI_TO(Test, json)},
    CLI_TRUSTED_OPTION(Test),
};

/* Returns the default path of tests: the first of these that exists, else the present folder. */
static const char *find_default_path(void) {
    static const char *const PLACES[] = {"tests/lua", "tests", "behaviours"};
    struct stat info;
    for (size_t p = 0; p < sizeof PLACES / sizeof *PLACES; p++)
        if (stat(PLACES[p], &info) == 0)
            return PLACES[p];
    return ".";
}

/* Makes the folder for temporary files of tests, as behaviours that are written inside a test
   become files for a while. Only the user may access it; it stays for the next run. NULL if it
   cannot be made. */
static const char *make_temporary_folder(void) {
    static char room[64];
    struct stat info;
    snprintf(room, sizeof room, "/tmp/jostle-tests-%u", (unsigned)geteuid());
    (void)!mkdir(room, 0700);
    const bool own = lstat(room, &info) == 0 && S_ISDIR(info.st_mode) && info.st_uid == geteuid() &&
                     (info.st_mode & 077) == 0;
    return own && setenv("TMPDIR", room, 1) == 0 ? room : NULL;
}

/* Confines the process. Tests lie beside the behaviours and scenes that they test, or in a folder
   of their own. */
static void confine_test(const char *const *paths, size_t count, bool trusted) {
    static const char *const NEAR[] = {"../behaviours", "../scenes", "../../behaviours",
                                       "../../scenes"};
    CliReach reach = {.memory = (size_t)4 << 30, .seconds = 3600};
    for (size_t p = 0; p < count; p++) {
        struct stat info;
        const bool folder = stat(paths[p], &info) == 0 && S_ISDIR(info.st_mode);
        cli_reach_scene(&reach, paths[p]);
        for (size_t n = 0; n < sizeof NEAR / sizeof *NEAR; n++) {
            char path[2 * JOX_LONGEST_PATH];
            if (folder)
                snprintf(path, sizeof path, "%s/%s", paths[p], NEAR[n]);
            else
                snprintf(path, sizeof path, "%.*s%s", (int)jox_path_folder(paths[p]), paths[p],
                         NEAR[n]);
            cli_reach_folder(&reach, path);
        }
    }
    cli_reach_output(&reach, trusted ? NULL : make_temporary_folder());
    cli_confine_work(&reach, trusted);
}

static int run_test(int argc, char **argv) {
    Test options = {0};
    CliList paths = {0};
    int status = cli_parse(&cli_test, argc, argv, &options, &paths);
    if (status == CLI_GO_ON) {
        for (size_t p = 0; p < paths.count && !options.json; p++)
            if (!cli_check_exists(&cli_test, paths.items[p]))
                status = JO_INPUT;
    }
    if (status == CLI_GO_ON) {
        const char *usual = find_default_path();
        confine_test(paths.count ? paths.items : &usual, paths.count ? paths.count : 1,
                     options.trusted);
        size_t passed = 0, failed = 0;
        if (options.json)
            cli_output_is_data();
        JoError error = {0};
        bool good =
            jo_test(paths.count ? paths.items : &usual, paths.count ? paths.count : 1, options.only,
                    options.json, cli_print, stdout, &passed, &failed, &error);
        status = error.code ? cli_report_error(&cli_test, &error, false)
                 : !good    ? JO_INPUT
                 : failed   ? JO_FAILED
                            : JO_OK;
        if (!options.json && !error.code)
            printf("%zu passed, %zu failed\n", passed, failed);
    }
    cli_free(&cli_test, &options, &paths);
    return status;
}

const CliCommand cli_test = {
    .name = "test",
    .what = "run tests of behaviours, written in Lua",
    .usage = "[PATH...] [options]",
    .about =
        "Runs tests of behaviours: Lua files, or all *_test.lua of a folder; without a path, those "
        "of the first of tests/lua, tests and behaviours that exists, else of this folder.",
    .notes = "  test(\"a walker reaches its goal\", function()\n"
             "    local s = scene { places = { goal = { point = { 8, 0 } } },\n"
             "      groups = { people = { behaviour = \"walker.lua\", at = { { 0, 0 } },\n"
             "                            set = { goal = \"goal\" } } } }\n"
             "    s:reaches(\"Gone\", { within = 10 })\n"
             "  end)\n"
             "\n"
             "A scene, a table of the keys of YAML or a file's name, has run(s), step(n), time(), "
             "hash(), count(state), entered(state), reaches(state, {within, agents, count, any}), "
             "never(state, {during, agents}), slower_than(v, {during, agents}), faster_than(...), "
             "agents(group), agent(id) (a table: state, x, y, own.NAME, memory by name, in which a "
             "person is its id, a list a table, a place the text \"place 'north'\"), body(name), "
             "and why(id) or why({agents, state, to}), the "
             "text of "
             "`jostle why`, which a failing test shows of its last scene. And equal(a, b), near(a, "
             "b, by), truthy(x), "
             "fails(function, text), refused(table, text).\n"
             "\n"
             "exit status: 0 all passed, 1 a test failed or could not be run, 2 wrong usage, 3 a "
             "file could not be loaded",
    .options = OPTIONS,
    .option_count = sizeof OPTIONS / sizeof *OPTIONS,
    .takes = "path",
    .run = run_test,
};
