#include <stdio.h>
#include <string.h>

#include "base/guard.h"
#include "cli/cli.h"

/* Whether the help lists it. */
static bool is_page(const char *what) {
    const size_t length = strlen(what);
    for (const char *line = cli_reference.about; line; line = strchr(line, '\n')) {
        line += strspn(line, " \n");
        if (!strncmp(line, what, length) && line[length] == ' ')
            return true;
    }
    return false;
}

static int print_reference(const char *what) {
    char *text = !strcmp(what, "manual") ? cli_manual() : jo_reference(what);
    JoError error;
    if (!text && is_page(what)) {
        jox_memory_error(&error);
        return cli_failed(&cli_reference, &error, false);
    }
    if (!text) {
        char why[120];
        snprintf(why, sizeof why, "there is no '%.60s'", what);
        return cli_misused(&cli_reference, why);
    }
    fputs(text, stdout);
    jo_free(text);
    return JO_OK;
}

static int run(int argc, char **argv) {
    CliList plain = {0};
    int status = cli_parse(&cli_reference, argc, argv, NULL, &plain);
    if (status == CLI_GO_ON)
        status = print_reference(plain.count ? plain.items[0] : "behaviours");
    cli_free(&cli_reference, NULL, &plain);
    return status;
}

const CliCommand cli_reference = {
    .name = "reference",
    .what = "print every word and key, for people and for editors",
    .usage = "[WHAT]",
    .about =
        "  behaviours    every word, parameter and key of behaviours, as Markdown (the default)\n"
        "  scenes        every key of scenes and mods, as Markdown\n"
        "  lua-ls        definitions for lua-language-server\n"
        "  luacheck      a standard for luacheck\n"
        "  inputs        lines of input logs, as Markdown\n"
        "  scene-schema  JSON Schema of scenes, for yaml-language-server\n"
        "  mod-schema    JSON Schema of mod.yaml\n"
        "  manual        the manual page of this program, as roff",
    .takes = "page",
    .most = 1,
    .run = run,
};
