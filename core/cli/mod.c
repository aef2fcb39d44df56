#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/cli.h"

static const char HELP[] =
    "usage: jostle mod list [SCENE] [--mod DIR]...\n"
    "       jostle mod enable|disable NAME|DIR [SCENE]\n"
    "       jostle mod why PATH SCENE [--mod DIR]...\n"
    "       jostle mod check DIR...\n\n"
    "  list    the mods that a run of the scene takes, in order, what they change, their "
    "settings;\n"
    "          and those that are off\n"
    "  enable  turns a mod on for all runs: until it is, it is off, whatever folder it lies in. "
    "When\n"
    "          its files change, it is off again. Scenes can name their mods themselves\n"
    "  disable turns it off\n"
    "  why     who set a value, e.g. tawaf.Circle.push or groups.red.count: every place, the last "
    "counts\n"
    "  check   every error of mods, without running\n\n"
    "  --mod DIR    take a mod, as of jostle run\n"
    "  --no-mods    none but those, and those that the scene names\n\n"
    "exit status: 0 done, 2 wrong usage, 3 errors found or no such path\n";

static void print(void *context, const char *text) {
    fputs(text, context);
}

/* Scenes are files, or names of files in scenes/. */
static int why(JoSceneDef *def, const char *path) {
    JoError error = {0};
    char *text = jo_mods_why(def, path, &error);
    if (!text) {
        fprintf(stderr, "jostle mod: %s\n", error.text);
        return JO_INPUT;
    }
    fputs(text, stdout);
    jo_free(text);
    return JO_OK;
}

static int enable(const JoSceneDef *def, const char *mod, bool on) {
    JoError error = {0};
    if (!jo_mods_enable(def, mod, on, &error)) {
        fprintf(stderr, "jostle mod: %s\n", error.text);
        return (int)error.code;
    }
    printf("mod %s is %s\n", mod, on ? "on, until its files change" : "off");
    return JO_OK;
}

int cli_mod(int argc, char **argv) {
    static const char *const known[] = {"mod", "no-mods", "help", NULL};
    CliArgs args = {.argc = argc, .argv = argv, .next = 1, .command = "mod"};
    const char **mods = calloc((size_t)argc, sizeof *mods);
    const char **plains = calloc((size_t)argc, sizeof *plains), *option, *plain;
    JoSceneDef def = jo_default_scene_def();
    size_t count = 0;
    int status = -1;
    def.mods = mods;
    while (status < 0 && ((option = cli_next(&args, &plain)) || plain)) {
        if (plain) {
            plains[count++] = plain;
        } else if (!strcmp(option, "mod")) {
            mods[def.mod_count++] = cli_value(&args, option);
        } else if (!strcmp(option, "no-mods")) {
            def.named_mods_only = true;
        } else if (!strcmp(option, "help") || !strcmp(option, "h")) {
            fputs(HELP, stdout);
            status = JO_OK;
        } else {
            status = cli_unknown(&args, option, known);
        }
    }
    const char *verb = count ? plains[0] : "";
    if (status < 0 && !strcmp(verb, "list") && count <= 2) {
        def.path = count > 1 ? plains[1] : NULL;
        char *text = jo_mods_list(&def);
        fputs(text ? text : "", stdout);
        jo_free(text);
        status = JO_OK;
    } else if (status < 0 && !strcmp(verb, "why") && count == 3) {
        def.path = plains[2];
        status = why(&def, plains[1]);
    } else if (status < 0 && (!strcmp(verb, "enable") || !strcmp(verb, "disable")) &&
               (count == 2 || count == 3)) {
        def.path = count > 2 ? plains[2] : NULL;
        status = enable(&def, plains[1], !strcmp(verb, "enable"));
    } else if (status < 0 && !strcmp(verb, "check") && count > 1) {
        size_t errors = jo_check(plains + 1, count - 1, false, print, stdout);
        if (!errors)
            puts("nothing wrong");
        status = errors ? JO_INPUT : JO_OK;
    } else if (status < 0) {
        fprintf(stderr, "jostle mod: what shall be done?\n\n%s", HELP);
        status = JO_USAGE;
    }
    free(mods);
    free(plains);
    return status;
}
