#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/cli.h"

typedef struct Mods {
    JoSceneDef def;
    CliList mods;
    double at;
    uint64_t agent;
    bool of_scene, trusted, has_at, has_agent;
} Mods;

static const CliOption OPTIONS[] = {
    CLI_MOD_OPTIONS(Mods, def),
    {"agent", "ID",
     "with `why`: show the value of this agent, and what set it: of "
     "a parameter (speed), of its memory "
     "(hits) or of its own values",
     CLI_TO(Mods, agent), CLI_GIVEN(Mods, has_agent), CLI_RANGE(0, UINT32_MAX)},
    {"at", "S", "with --agent: after S simulated seconds", "0", CLI_TO(Mods, at),
     CLI_GIVEN(Mods, has_at), CLI_RANGE(0, 1e6)},
    CLI_TRUSTED_OPTION(Mods)};

/* Prints a setting that is no number, and what else it may be: "polite (polite, rude)". */
static void print_choice(const JoModSetting *set) {
    const char *between = "";
    printf("%s (", set->text);
    if (set->kind == JO_SETTING_BOOL)
        printf("true, false");
    for (const char *c = set->choices; *c; c += strcspn(c, "\n") + 1) {
        printf("%s%.*s", between, (int)strcspn(c, "\n"), c);
        between = ", ";
    }
    putchar(')');
}

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
        printf("     %s = ", set->name);
        if (set->kind == JO_SETTING_NUMBER)
            printf("%g %s (%g to %g)", set->value, set->unit, set->least, set->greatest);
        else
            print_choice(set);
        printf("%s%s\n", *set->meaning ? ": " : "", set->meaning);
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
    if (!mods)
        fputs("jostle mod: out of memory\n", stderr);
    const int status = !mods ? JO_FAILED : mods->errors ? JO_INPUT : JO_OK;
    jo_free(mods);
    return status;
}

enum { LONGEST_SHOWN = 60 }; /* bytes of a value */

static void print_setting(const JoSetting *setting) {
    const char *value = setting->removes ? "taken away" : setting->value;
    size_t shown = strlen(value);
    if (!isnan(setting->time))
        printf("  t=%.2f", setting->time);
    if (setting->by == JO_SET_UNSEEN) {
        puts("  by a function or a program, before it was asked about");
        return;
    }
    if (setting->by == JO_SET_FUNCTION || setting->by == JO_SET_PROGRAM) {
        printf("  by %s",
               setting->by == JO_SET_FUNCTION ? "a function" : "a program, an input log or a page");
        printf(*setting->file ? ", %s:%d\n" : "\n", setting->file, setting->line);
        return;
    }
    if (setting->by == JO_SET_DEFAULT) {
        printf("  the default: %s%s%s\n", value, *setting->unit ? " " : "", setting->unit);
        return;
    }
    const bool cut = shown > LONGEST_SHOWN;
    shown = cut ? LONGEST_SHOWN - 3 : shown;
    while (cut && ((unsigned char)value[shown] & 0xc0) == 0x80)
        shown--; /* not within a UTF-8 character */
    printf("  %s:%d:%d: %.*s%s", setting->file, setting->line, setting->column, (int)shown, value,
           cut ? "..." : "");
    if (*setting->where)
        printf("   (%s)", setting->where);
    if (*setting->mod)
        printf("   (mod %s%s%s)", setting->mod, *setting->version ? " " : "", setting->version);
    putchar('\n');
}

static void print_settings(const JoSettings *settings) {
    for (uint32_t s = 0; s < settings->count; s++)
        print_setting(&settings->items[s]);
    if (settings->count > 1)
        puts(settings->items[settings->count - 1].extends
                 ? "  the last one counts, and what it extends with it"
                 : "  the last one counts");
}

static int why(const JoSceneDef *def, const char *path) {
    JoError error = {0};
    JoSettings *settings = jo_mods_why(def, path, &error);
    if (!settings) {
        cli_report_error(&cli_mod, &error, false);
        return JO_INPUT;
    }
    puts(path);
    print_settings(settings);
    jo_free(settings);
    return JO_OK;
}

/* Interval, s, at which the agent is asked about. One that is not asked about for longer is no
   longer watched, and the writers of its values are not known (jo_agent_why). */
static const double ASKED_EACH = 2.0;

/* Prints that there is no such agent: when it left, if it was there, and the ids of those
   present. */
static void say_gone(const JoWorld *world, uint64_t id, double left) {
    const uint32_t count = jo_world_agent_count(world);
    JoAgent *agents = calloc(count ? count : 1, sizeof *agents);
    fprintf(stderr, "jostle mod: there is no agent %llu at %.2f s", (unsigned long long)id,
            jo_world_time(world));
    if (left > 0.0)
        fprintf(stderr, ": it left at %.2f s", left);
    if (agents && jo_world_agents(world, agents, count) > 0)
        fprintf(stderr, "; those who are there have ids from %u to %u",
                jo_agent_state(world, agents[0]).id, jo_agent_state(world, agents[count - 1]).id);
    else
        fputs("; nobody is there", stderr);
    fputs("\n", stderr);
    free(agents);
}

/* Prints the value `name` of the agent with an id, and what set it. The agent is asked about now
   and then from its appearance on, so that the writers of its values are known. */
static int why_now(const Mods *options, const char *name) {
    JoError error = {0};
    JoSettings *settings = NULL;
    JoScene *scene = jo_scene_load(&options->def, &error);
    double value = 0.0, asked = -INFINITY, left = 0.0;
    if (!scene)
        return cli_report_error(&cli_mod, &error, true);
    JoWorld *world = jo_scene_world(scene);
    const uint64_t steps = (uint64_t)(options->at / jo_scene_stats(scene).dt + 0.5);
    bool good = true;
    for (uint64_t n = 0; good; n++) {
        const JoAgent agent = jo_world_agent_of(world, (uint32_t)options->agent);
        const double now = jo_world_time(world);
        if (!agent.generation && isfinite(asked) && left <= 0.0)
            left = now;
        if (agent.generation && (n == steps || now - asked >= ASKED_EACH)) {
            jo_free(settings);
            settings = jo_agent_why(scene, agent, name, &value, &error);
            asked = now;
            good = settings != NULL;
        }
        if (n == steps || !good)
            break;
        good = jo_scene_step(scene, &error);
    }
    const JoAgent agent = jo_world_agent_of(world, (uint32_t)options->agent);
    if (!good) {
        cli_report_error(&cli_mod, &error, false);
    } else if (agent.generation) {
        const JoAgentState is = jo_agent_state(world, agent);
        printf("%s of agent %u at %.2f s, in state %s: %s\n", name, is.id, jo_world_time(world),
               is.state, settings->now);
        print_settings(settings);
    } else {
        say_gone(world, options->agent, left);
        good = false;
    }
    jo_free(settings);
    jo_scene_free(scene);
    return good ? JO_OK : JO_INPUT;
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

static int check_mods(const char *const *folders, size_t count) {
    JoError error;
    size_t errors = jo_check(folders, count, false, cli_print, stdout, &error);
    if (errors == SIZE_MAX)
        return cli_report_error(&cli_mod, &error, false);
    return errors ? JO_INPUT : JO_OK;
}

/* The arguments of a verb: allowed numbers of words; the last one may be a scene. */
typedef struct Verb {
    const char *name, *takes;
    size_t least, most; /* most 0: any number */
    bool scene;
} Verb;

static const Verb VERBS[] = {{"list", "[SCENE]", 0, 1, true},
                             {"enable", "NAME|DIR [SCENE]", 1, 2, true},
                             {"disable", "NAME|DIR [SCENE]", 1, 2, true},
                             {"why", "PATH SCENE", 2, 2, true},
                             {"check", "DIR...", 1, 0, false}};
enum { VERB_COUNT = sizeof VERBS / sizeof *VERBS };

/* Returns the verb of the arguments; NULL with a message if it is unknown or has the wrong number
   of arguments. */
static const Verb *find_verb(const CliList *plain) {
    const char *names[VERB_COUNT];
    const size_t given = plain->count - 1;
    char why[160];
    for (size_t v = 0; v < VERB_COUNT; v++) {
        names[v] = VERBS[v].name;
        if (strcmp(plain->items[0], names[v]) != 0)
            continue;
        if (given >= VERBS[v].least && (given <= VERBS[v].most || VERBS[v].most == 0))
            return &VERBS[v];
        snprintf(why, sizeof why, "%s takes %s, not %zu argument%s", names[v], VERBS[v].takes,
                 given, given == 1 ? "" : "s");
        cli_report_misuse(&cli_mod, why);
        return NULL;
    }
    cli_report_unknown(&cli_mod, "verb", plain->items[0], names, VERB_COUNT);
    return NULL;
}

/* Confines the process to what the verb needs. */
static void confine(const Mods *options, const Verb *verb, const CliList *plain) {
    CliReach reach = {CLI_READING};
    cli_reach_def(&reach, &options->def);
    for (size_t p = 1; p < plain->count && !strcmp(verb->name, "check"); p++)
        cli_reach_scene(&reach, plain->items[p]);
    if (verb->least == 1 && verb->scene) { /* enable, disable */
        cli_reach_folder(&reach, plain->items[1]);
        cli_reach_settings(&reach);
    }
    cli_confine_work(&reach, options->trusted);
}

static int run_verb(Mods *options, const CliList *plain) {
    const Verb *verb = find_verb(plain);
    if (!verb)
        return JO_USAGE;
    const char *name = verb->name, *first = plain->count > 1 ? plain->items[1] : NULL;
    if ((options->has_agent || options->has_at) &&
        (strcmp(name, "why") != 0 || !options->has_agent))
        return cli_report_misuse(&cli_mod, "--at goes with --agent, and that with why");
    options->def.mods = options->mods.items;
    options->def.mod_count = options->mods.count;
    if (verb->scene && verb->most == plain->count - 1) {
        options->def.path = cli_scene(&cli_mod, plain->items[plain->count - 1], &options->mods);
        if (!options->def.path)
            return JO_INPUT;
    }
    for (size_t p = 1; p < plain->count && !strcmp(name, "check"); p++) {
        const char *folder =
            access(plain->items[p], F_OK) == 0 ? NULL : cli_mod_folder(plain->items[p]);
        plain->items[p] = folder ? folder : plain->items[p];
    }
    confine(options, verb, plain);
    return !strcmp(name, "list")      ? list(&options->def)
           : !strcmp(name, "check")   ? check_mods(plain->items + 1, plain->count - 1)
           : strcmp(name, "why") != 0 ? enable(&options->def, first, !strcmp(name, "enable"))
           : options->has_agent       ? why_now(options, first)
                                      : why(&options->def, first);
}

static int run_mod(int argc, char **argv) {
    Mods options = {.def = jo_default_scene_def()};
    CliList plain = {0};
    int status = cli_parse(&cli_mod, argc, argv, &options, &plain);
    if (status == CLI_GO_ON)
        status = run_verb(&options, &plain);
    cli_free(&cli_mod, &options, &plain);
    return status;
}

const CliCommand cli_mod = {
    .name = "mod",
    .what = "list mods, turn them on and off, and show where a value is set",
    .usage = "list [SCENE] [--mod DIR]...\n"
             "enable|disable NAME|DIR [SCENE]\n"
             "why PATH SCENE [--mod DIR]...\n"
             "why NAME SCENE --agent ID [--at S] [--mod DIR]...\n"
             "check DIR...",
    .about =
        "  list    lists the mods that a run of the scene loads, in order, with what they change "
        "and "
        "their settings; and the mods that are off\n"
        "  enable  turns a mod on for all runs; when its files change, it is off again\n"
        "  disable turns a mod off\n"
        "  why     lists every place that sets a value, such as tawaf.Circle.push or "
        "bodies.ball.mass; the last one counts. With --agent: the value of one agent in a run, "
        "and what set it\n"
        "  check   reports every error of mods, without running",
    .notes = "exit status: 0 done, 1 it could not be done, 2 wrong usage, 3 errors found or no "
             "such path",
    .options = OPTIONS,
    .option_count = sizeof OPTIONS / sizeof *OPTIONS,
    .takes = "verb",
    .least = 1,
    .none_said = "list, enable, disable, why or check?",
    .run = run_mod,
};
