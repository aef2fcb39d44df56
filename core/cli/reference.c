/* The command `reference`: prints reference pages, the schemas and the manual page. */
#include <stdio.h>
#include <string.h>

#include "base/guard.h"
#include "cli/cli.h"

typedef struct Reference {
    JoSceneDef def;
    CliList mods;
    bool of_scene, trusted;
} Reference;

static const CliOption OPTIONS[] = {CLI_MOD_OPTIONS(Reference, def), CLI_TRUSTED_OPTION(Reference)};

static const char *const PAGES[] = {"behaviours", "scenes",       "lua-ls",     "luacheck", "mods",
                                    "inputs",     "scene-schema", "mod-schema", "manual"};
enum { PAGE_COUNT = sizeof PAGES / sizeof *PAGES };

static bool is_page_name(const char *what) {
    for (size_t p = 0; p < PAGE_COUNT; p++)
        if (!strcmp(PAGES[p], what))
            return true;
    return false;
}

/* Makes the page of mods, the only one that reads files, which is confined first. */
static char *make_mods_page(Reference *options, const char *scene) {
    options->def.path = scene;
    options->def.mods = options->mods.items;
    options->def.mod_count = options->mods.count;
    CliReach reach = {CLI_READING};
    cli_reach_def(&reach, &options->def);
    cli_confine_work(&reach, options->trusted);
    return jo_mods_reference(&options->def);
}

static int print_page(Reference *options, const char *what, const char *scene) {
    char *text = !strcmp(what, "manual") ? cli_format_manual()
                 : !strcmp(what, "mods") ? make_mods_page(options, scene)
                                         : jo_reference(what);
    JoError error;
    if (!text && is_page_name(what)) {
        jox_memory_error(&error);
        return cli_report_error(&cli_reference, &error, false);
    }
    if (!text)
        return cli_report_unknown(&cli_reference, "page", what, PAGES, PAGE_COUNT);
    fputs(text, stdout);
    jo_free(text);
    return JO_OK;
}

static int run_reference(int argc, char **argv) {
    Reference options = {.def = jo_default_scene_def()};
    CliList plain = {0};
    int status = cli_parse(&cli_reference, argc, argv, &options, &plain);
    if (status == CLI_GO_ON) {
        const char *what = plain.count ? plain.items[0] : "behaviours";
        const char *given = plain.count > 1 ? plain.items[1] : NULL;
        const char *scene = given ? cli_scene(&cli_reference, given, &options.mods) : NULL;
        status = given && !scene ? JO_INPUT
                 : strcmp(what, "mods") != 0 && (scene || options.mods.count)
                     ? cli_report_misuse(&cli_reference, "a scene and --mod go with 'mods' alone")
                     : print_page(&options, what, scene);
    }
    cli_free(&cli_reference, &options, &plain);
    return status;
}

const CliCommand cli_reference = {
    .name = "reference",
    .what = "print every word and key, for people and for editors",
    .usage = "[WHAT]\n"
             "mods [SCENE] [--mod DIR]...",
    .about =
        "  behaviours    every word, parameter and key of behaviours, as Markdown (the default)\n"
        "  scenes        every key of scenes and mods, as Markdown\n"
        "  lua-ls        definitions for lua-language-server\n"
        "  luacheck      a standard for luacheck\n"
        "  mods          what mods that are on or named define for others: behaviours, functions\n"
        "                and values, with the comments before them, as Markdown\n"
        "  inputs        lines of input logs, as Markdown\n"
        "  scene-schema  JSON Schema of scenes, for yaml-language-server\n"
        "  mod-schema    JSON Schema of mod.yaml\n"
        "  manual        the manual page of this program, as roff",
    .options = OPTIONS,
    .option_count = sizeof OPTIONS / sizeof *OPTIONS,
    .takes = "page",
    .most = 2,
    .run = run_reference,
};
