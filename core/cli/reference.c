#include <stdio.h>
#include <string.h>

#include "cli/cli.h"

static const char HELP[] =
    "usage: jostle reference [WHAT]\n\n"
    "  behaviours    every word, parameter and key of behaviours, as Markdown (the default)\n"
    "  scenes        every key of scenes and mods, as Markdown\n"
    "  lua-ls        definitions for lua-language-server\n"
    "  luacheck      a standard for luacheck\n"
    "  inputs        lines of input logs, as Markdown\n"
    "  scene-schema  JSON Schema of scenes, for yaml-language-server\n"
    "  mod-schema    JSON Schema of mod.yaml\n";

int cli_reference(int argc, char **argv) {
    const char *what = argc > 1 ? argv[1] : "behaviours";
    if (!strcmp(what, "--help") || !strcmp(what, "-h")) {
        fputs(HELP, stdout);
        return JO_OK;
    }
    char *text = argc > 2 ? NULL : jo_reference(what);
    if (!text) {
        fprintf(stderr, "jostle reference: there is no '%s'\n\n%s", what, HELP);
        return JO_USAGE;
    }
    fputs(text, stdout);
    jo_free(text);
    return JO_OK;
}
