#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/cli.h"

static const char HELP[] =
    "usage: jostle test [PATH...] [options]\n\n"
    "Runs tests of behaviours: Lua files, or all *_test.lua of a folder; without a path those of\n"
    "tests/lua, tests and behaviours, else of this folder.\n\n"
    "  --only TEXT   those whose name contains it\n"
    "  --json        one array of {file, line, name, passed, simulated_s, message}\n\n"
    "  test(\"a walker reaches its goal\", function()\n"
    "    local s = scene { places = { goal = { point = { 8, 0 } } },\n"
    "      groups = { people = { behaviour = \"walker.lua\", at = { { 0, 0 } }, set = { goal = "
    "\"goal\" } } } }\n"
    "    s:reaches(\"Gone\", { within = 10 })\n"
    "  end)\n\n"
    "A scene, a table of the keys of YAML or a file's name, has run(s), step(n), time(), hash(),\n"
    "count(state), entered(state), reaches(state, {within, agents, count, any}),\n"
    "never(state, {during, agents}), slower_than(v, {during, agents}), faster_than(...),\n"
    "agents(group), agent(id), body(name). And equal(a, b), near(a, b, by), truthy(x),\n"
    "fails(function, text), refused(table, text).\n\n"
    "exit status: 0 all passed, 1 a test failed, 2 wrong usage, 3 a file could not be run\n";

static void print(void *context, const char *text) {
    fputs(text, context);
    fflush(context);
}

int cli_test(int argc, char **argv) {
    static const char *const known[] = {"only", "json", "help", NULL};
    static const char *const PLACES[] = {"tests/lua", "tests", "behaviours"};
    CliArgs args = {.argc = argc, .argv = argv, .next = 1, .command = "test"};
    const char **paths = calloc((size_t)argc + 4, sizeof *paths), *option, *plain, *only = NULL;
    size_t count = 0, passed = 0, failed = 0;
    bool json = false;
    int status = -1;
    while (status < 0 && ((option = cli_next(&args, &plain)) || plain)) {
        if (plain) {
            paths[count++] = plain;
        } else if (!strcmp(option, "only")) {
            only = cli_value(&args, option);
        } else if (!strcmp(option, "json")) {
            json = true;
        } else if (!strcmp(option, "help") || !strcmp(option, "h")) {
            fputs(HELP, stdout);
            status = JO_OK;
        } else {
            status = cli_unknown(&args, option, known);
        }
    }
    if (args.failed)
        status = JO_USAGE;
    struct stat info;
    for (size_t p = 0; count == 0 && p < 3; p++)
        if (stat(PLACES[p], &info) == 0)
            paths[count++] = PLACES[p];
    if (count == 0)
        paths[count++] = ".";
    if (status < 0) {
        bool good = jo_test(paths, count, only, json, print, stdout, &passed, &failed);
        status = !good ? JO_INPUT : failed ? JO_FAILED : JO_OK;
        if (!json)
            printf("%zu passed, %zu failed\n", passed, failed);
    }
    free(paths);
    return status;
}
