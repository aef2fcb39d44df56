#include <stdio.h>
#include <string.h>

#include "cli/cli.h"

typedef struct Mods {
    JoSceneDef def;
    CliList mods;
    bool of_scene, trusted;
} Mods;

static const CliOption OPTIONS[] = {CLI_MOD_OPTIONS(Mods, def), CLI_TRUSTED_OPTION(Mods)};

static void print_taken(uint32_t number, const JoMod *mod) {
    printf("%u. %s %s%s%s (%s; %s)\n", number, mod->name, mod->version, *mod->title ? ": " : "",
           mod->title, mod->folder, mod->on == JO_MOD_ON ? "on" : "named");
    for (uint32_t p = 0; p < mod->patch_count; p++) {
        const JoModPatch *patch = &mod->patches[p];
        printf("     %s %s %s\n", patch->replaces ? "replaces" : "patches",
               patch->behaviour ? "behaviour" : "scene", *patch->target ? patch->target : "?");
    }
    for (uint32_t s = 0; s < mod->setting_count; s++) {
        const JoModSetting *set = &mod->settings[s];
        printf("     %s = %g %s (%g to %g)%s%s\n", set->name, set->value, set->unit, set->least,
               set->greatest, *set->meaning ? ": " : "", set->meaning);
    }
}

static int list(const JoSceneDef *def) {
    static const char *const SWITCHES[] = {
        [JO_MOD_OFF] = "off",
        [JO_MOD_CHANGED] = "off, as it has changed since it was turned on",
        [JO_MOD_ON] = "on, but not taken",
    };
    JoMods *mods = jo_mods_list(def);
    for (uint32_t m = 0; mods && m < mods->count; m++) {
        const JoMod *mod = &mods->items[m];
        if (mod->taken)
            print_taken(m + 1, mod);
        else
            printf("%s: %s %s%s%s (%s)\n", SWITCHES[mod->on], mod->name, mod->version,
                   *mod->title ? ": " : "", mod->title, mod->folder);
    }
    if (mods && mods->count == 0)
        puts("no mods found");
    jo_free(mods);
    return JO_OK;
}

enum { LONGEST_SHOWN = 60 }; /* bytes of a value */

static void print_setting(const JoSetting *setting) {
    const char *value = setting->removes ? "taken away" : setting->value;
    size_t shown = strlen(value);
    if (setting->by == JO_SET_DEFAULT) {
        printf("  the default: %s%s%s\n", value, *setting->unit ? " " : "", setting->unit);
        return;
    }
    const bool cut = shown > LONGEST_SHOWN;
    shown = cut ? LONGEST_SHOWN - 3 : shown;
    while (cut && ((unsigned char)value[shown] & 0xc0) == 0x80)
        shown--; /* no half of a letter */
    printf("  %s:%d:%d: %.*s%s", setting->file, setting->line, setting->column, (int)shown, value,
           cut ? "..." : "");
    if (*setting->mod)
        printf("   (mod %s %s)", setting->mod, setting->version);
    putchar('\n');
}

static int why(const JoSceneDef *def, const char *path) {
    JoError error = {0};
    JoSettings *settings = jo_mods_why(def, path, &error);
    if (!settings) {
        cli_failed(&cli_mod, &error, false);
        return JO_INPUT;
    }
    puts(path);
    for (uint32_t s = 0; s < settings->count; s++)
        print_setting(&settings->items[s]);
    if (settings->count > 1)
        puts("  the last one counts");
    jo_free(settings);
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

static int check(const char *const *folders, size_t count) {
    JoError error;
    size_t errors = jo_check(folders, count, false, cli_print, stdout, &error);
    if (errors == SIZE_MAX)
        return cli_failed(&cli_mod, &error, false);
    return errors ? JO_INPUT : JO_OK;
}

static int run(int argc, char **argv) {
    Mods options = {.def = jo_default_scene_def()};
    CliList plain = {0};
    int status = cli_parse(&cli_mod, argc, argv, &options, &plain);
    if (status == CLI_GO_ON) {
        const char *verb = plain.items[0];
        options.def.mods = options.mods.items;
        options.def.mod_count = options.mods.count;
        const bool on = !strcmp(verb, "enable"), turns = on || !strcmp(verb, "disable");
        options.def.path = plain.count > (turns ? 2 : 1) ? plain.items[plain.count - 1] : NULL;
        CliReach reach = {CLI_READING};
        cli_reach_def(&reach, &options.def);
        for (size_t p = 1; p < plain.count && !strcmp(verb, "check"); p++)
            cli_reach_scene(&reach, plain.items[p]);
        if (turns && plain.count > 1) {
            cli_reach_folder(&reach, plain.items[1]);
            cli_reach_settings(&reach);
        }
        cli_confine_work(&reach, options.trusted);
        if (!strcmp(verb, "list") && plain.count <= 2)
            status = list(&options.def);
        else if (!strcmp(verb, "why") && plain.count == 3)
            status = why(&options.def, plain.items[1]);
        else if (turns && (plain.count == 2 || plain.count == 3))
            status = enable(&options.def, plain.items[1], on);
        else if (!strcmp(verb, "check") && plain.count > 1)
            status = check(plain.items + 1, plain.count - 1);
        else
            status = cli_misused(&cli_mod, "what shall be done?");
    }
    cli_free(&cli_mod, &options, &plain);
    return status;
}

const CliCommand cli_mod = {
    .name = "mod",
    .what = "list mods, turn them on and off, and tell who set a value",
    .usage = "list [SCENE] [--mod DIR]...\n"
             "enable|disable NAME|DIR [SCENE]\n"
             "why PATH SCENE [--mod DIR]...\n"
             "check DIR...",
    .about = "  list    the mods that a run of the scene takes, in order, what they change, their "
             "settings; and those that are off\n"
             "  enable  turns a mod on for all runs: until then it is off, whatever folder it lies "
             "in; when its files change, it is off again\n"
             "  disable turns it off\n"
             "  why     who set a value, e.g. tawaf.Circle.push or bodies.ball.mass: every place, "
             "the last counts\n"
             "  check   every error of mods, without running",
    .notes = "exit status: 0 done, 1 it could not be done, 2 wrong usage, 3 errors found or no "
             "such path",
    .options = OPTIONS,
    .option_count = sizeof OPTIONS / sizeof *OPTIONS,
    .takes = "verb",
    .least = 1,
    .none_said = "what shall be done?",
    .run = run,
};
