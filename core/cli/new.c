/* jostle new: a commented start of a behaviour, a scene or a mod, that passes jostle check and
 * runs. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/assert.h"
#include "cli/cli.h"

static const char BEHAVIOUR[] =
    "-- NAME: walks to and fro between two ends. Save this file while a scene runs with --watch, "
    "and\n"
    "-- the crowd changes at once. Every word: jostle reference\n"
    "local mine = memory { rounds = 0 }            -- what each agent remembers; survives reloads\n"
    "local crowded = density_here:above(3)         -- a condition: people per square metre about "
    "it\n"
    "\n"
    "return machine {\n"
    "  name = \"NAME\", version = 1, start = \"Go\",\n"
    "  defaults = { speed = normal(1.3, 0.2, 0.6, 2), radius = 0.2 },  -- drawn once per agent\n"
    "\n"
    "  states = {\n"
    "    -- Named keys are parameters; the list below them are transitions, the first that holds "
    "wins.\n"
    "    Go = { steer = seek(own.goal) + 0.2 * spread,\n"
    "      { to = \"Wait\", when = crowded, chance = 0.02 },\n"
    "      { to = \"Back\", when = inside(own.goal), set = { rounds = mine.rounds + 1 } } },\n"
    "\n"
    "    Back = { steer = seek(own.home),\n"
    "      { to = \"Go\", when = inside(own.home) } },\n"
    "\n"
    "    Wait = { steer = hold, lasts = uniform(1, 3),\n"
    "      { to = \"Go\", when = lasted } },\n"
    "  },\n"
    "}\n";

static const char SCENE[] =
    "# NAME: forty people walk to and fro between two ends of a hall.\n"
    "# Run it:   jostle run FILE --report out\n"
    "# Check it: jostle check FILE          Every key: jostle reference scenes\n"
    "jostle: 1\n"
    "title: NAME\n"
    "seed: 1\n"
    "duration: 60\n"
    "places:                      # what behaviours name, in metres\n"
    "  hall: {polygon: [[0, 0], [20, 0], [20, 8], [0, 8]]}\n"
    "  west: {polygon: [[0, 0], [2, 0], [2, 8], [0, 8]]}\n"
    "  east: {polygon: [[18, 0], [20, 0], [20, 8], [18, 8]]}\n"
    "walls:\n"
    "  - {line: [[0, 0], [20, 0], [20, 8], [0, 8]], closed: true}\n"
    "groups:\n"
    "  eastward:\n"
    "    behaviour: BEHAVIOUR\n"
    "    count: 20\n"
    "    fill: random\n"
    "    in: west\n"
    "    set: {goal: east, home: west}   # values of the behaviour's own: own.goal, own.home\n"
    "  westward:\n"
    "    behaviour: BEHAVIOUR\n"
    "    count: 20\n"
    "    in: east\n"
    "    set: {goal: west, home: east}\n";

static const char MOD[] =
    "# NAME: a mod. Name it for one run: --mod; or turn it on: jostle mod enable NAME.\n"
    "name: NAME\n"
    "title: What it does, in a line\n"
    "version: 1.0.0\n"
    "api: 1\n"
    "# depends: [other-mod, \"third >= 1.2\"]     # must be taken too, and come before\n"
    "# load_after: [other-mod]                  # comes after it where both are taken\n"
    "# conflicts: [another]\n"
    "settings:               # --set mods.NAME.reach=4, or in a scene: mods: {NAME: {reach: 4}}\n"
    "  reach: {value: 3, unit: m, least: 1, greatest: 20, meaning: how far people see}\n";

static const char PATCH[] =
    "-- Changes the behaviour NAME:NAME of this mod; for one of the library write patch "
    "\"tawaf\".\n"
    "-- Other verbs in a state: change, replace, insert_before, insert_after, append, remove.\n"
    "return patch \"NAME:NAME\" {\n"
    "  defaults = { perception = settings.reach },\n"
    "  states = {\n"
    "    Wait = { face = own.goal, change = { Go = { when = lasted | pushed:above(150) } } },\n"
    "  },\n"
    "}\n";

static bool is_folder(const char *path) {
    struct stat info;
    return stat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

/* Files and folders that one call has made: all of them stay, or none. */
typedef struct Made {
    char paths[9][320];
    int count;
    bool failed;
} Made;

static void add_made(Made *made, const char *path) {
    JOX_ASSERT(made->count < (int)(sizeof made->paths / sizeof *made->paths));
    snprintf(made->paths[made->count++], sizeof *made->paths, "%s", path);
}

static void fail_to_make(Made *made, const char *what, const char *path, int why) {
    fprintf(stderr, "jostle new: cannot %s '%s': %s\n", what, path,
            why == EEXIST ? "it is there already, as a file, a folder or a link" : strerror(why));
    made->failed = true;
}

/* Removes what was made where something failed, else says what was written; the exit status. */
static int finish_made(Made *made) {
    for (int m = made->count - 1; made->failed && m >= 0; m--)
        remove(made->paths[m]);
    for (int m = 0; !made->failed && m < made->count; m++)
        if (!is_folder(made->paths[m]))
            printf("wrote %s\n", made->paths[m]);
    return made->failed ? JO_FAILED : JO_OK;
}

static void make_new_folder(Made *made, const char *path) {
    if (made->failed)
        return;
    if (mkdir(path, 0777) == 0)
        add_made(made, path);
    else
        fail_to_make(made, "make", path, errno);
}

/* Writes text with every NAME (and BEHAVIOUR, FILE) put in. */
static void write_template(Made *made, const char *path, const char *text, const char *name,
                           const char *behaviour) {
    FILE *file = made->failed ? NULL : fopen(path, "wx"); /* also no link, wherever it leads */
    if (!file) {
        if (!made->failed)
            fail_to_make(made, "write", path, errno);
        return;
    }
    add_made(made, path);
    const struct {
        const char *word, *by;
    } WORDS[] = {{"NAME", name}, {"BEHAVIOUR", behaviour}, {"FILE", path}};
    while (*text) {
        size_t used = 0;
        for (size_t w = 0; w < sizeof WORDS / sizeof *WORDS && !used; w++)
            if (strncmp(text, WORDS[w].word, strlen(WORDS[w].word)) == 0) {
                fputs(WORDS[w].by, file);
                used = strlen(WORDS[w].word);
            }
        if (!used)
            fputc(*text++, file);
        text += used;
    }
    const bool good = !ferror(file);
    if (fclose(file) != 0 || !good)
        fail_to_make(made, "write", path, errno);
}

static int new_behaviour(const char *folder, const char *name) {
    Made made = {0};
    char path[320];
    snprintf(path, sizeof path, "%s%.200s.lua", folder, name);
    write_template(&made, path, BEHAVIOUR, name, "");
    const int status = finish_made(&made);
    if (!status)
        printf("Check it:     jostle check %s\nA scene of it: jostle new scene %s\n", path, name);
    return status;
}

static int new_scene(const char *folder, const char *behaviours, const char *name) {
    Made made = {0};
    char path[320], lua[320];
    struct stat info;
    snprintf(path, sizeof path, "%s%.200s.yaml", folder, name);
    snprintf(lua, sizeof lua, "%s%.200s.lua", behaviours, name);
    if (stat(lua, &info) != 0)
        write_template(&made, lua, BEHAVIOUR, name, "");
    snprintf(lua, sizeof lua, "%.200s.lua", name); /* found beside, or in ../behaviours */
    write_template(&made, path, SCENE, name, lua);
    const int status = finish_made(&made);
    if (!status)
        printf("Run it: jostle run %s\n", path);
    return status;
}

static int new_mod(const char *parent, const char *name) {
    static const char *const FOLDERS[] = {"", "/behaviours", "/scenes", "/patches"};
    Made made = {0};
    char folder[100], path[320];
    if (!is_folder(parent))
        make_new_folder(&made, parent);
    snprintf(folder, sizeof folder, "%s/%s", parent, name);
    for (int f = 0; f < 4; f++) {
        snprintf(path, sizeof path, "%s%s", folder, FOLDERS[f]);
        make_new_folder(&made, path);
    }
    const struct {
        const char *form, *text;
    } FILES[] = {{"%s/mod.yaml", MOD},
                 {"%s/behaviours/%s.lua", BEHAVIOUR},
                 {"%s/scenes/%s.yaml", SCENE},
                 {"%s/patches/%s.lua", PATCH}};
    char behaviour[100];
    snprintf(behaviour, sizeof behaviour, "%s.lua", name);
    for (int f = 0; f < 4; f++) {
        snprintf(path, sizeof path, FILES[f].form, folder, name);
        write_template(&made, path, FILES[f].text, name, behaviour);
    }
    const int status = finish_made(&made);
    if (!status)
        printf("Run it: jostle run %s/scenes/%s.yaml --mod %s\n", folder, name, folder);
    return status;
}

static int make_kind(const char *kind, const char *name) {
    static const char *const KINDS[] = {"behaviour", "scene", "mod"};
    const char *behaviours = is_folder("behaviours") ? "behaviours/" : "";
    const char *scenes = is_folder("scenes") ? "scenes/" : "";
    size_t n = strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789-_");
    if (n == 0 || n > 60 || name[n])
        return cli_report_misuse(&cli_new,
                                 "a name has up to 60 lower-case letters, digits, - and _");
    if (!strcmp(kind, "behaviour"))
        return new_behaviour(behaviours, name);
    if (!strcmp(kind, "scene")) /* scenes of scenes/ find their behaviours in ../behaviours */
        return new_scene(scenes, *scenes && *behaviours ? behaviours : scenes, name);
    if (!strcmp(kind, "mod"))
        return new_mod(*scenes ? "scenes/mods" : "mods", name);
    return cli_report_unknown(&cli_new, "kind", kind, KINDS, sizeof KINDS / sizeof *KINDS);
}

static int run_new(int argc, char **argv) {
    CliList plain = {0};
    int status = cli_parse(&cli_new, argc, argv, NULL, &plain);
    if (status == CLI_GO_ON)
        status = make_kind(plain.items[0], plain.items[1]);
    cli_free(&cli_new, NULL, &plain);
    return status;
}

const CliCommand cli_new = {
    .name = "new",
    .what = "write a commented start of a behaviour, scene or mod",
    .usage = "behaviour|scene|mod NAME",
    .about =
        "  behaviour   writes NAME.lua (in behaviours/, where there is such a folder)\n"
        "  scene       writes NAME.yaml (in scenes/), and NAME.lua for it where there is none\n"
        "  mod         writes mods/NAME/ (in scenes/mods/) with a behaviour, a scene and "
        "mod.yaml\n"
        "\n"
        "What exists is never overwritten; where one file cannot be written, none is. NAME has "
        "lower-case letters, digits, - and _.",
    .notes = "exit status: 0 done, 1 cannot write, 2 wrong usage",
    .takes = "kind and name",
    .least = 2,
    .most = 2,
    .none_said = "say what, and its name",
    .run = run_new,
};
