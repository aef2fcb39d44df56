/* Finds scenes, mods and recordings by path or by name, and suggests similar names if there is
   none. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file.h"
#include "base/format/installed.h"
#include "base/mem.h"
#include "base/overlay.h"
#include "base/text.h"
#include "cli/cli.h"

static const struct {
    const char *name, *what;
} WORTH_SEEING[] = {
    {"tawaf", "35,000 pilgrims go round the Kaaba; some queue at the Black Stone"},
    {"office", "a crowd streams through an office and pushes its furniture about"},
    {"dodgeball", "two teams, one ball: throw, dodge, fetch"},
    {"wall-breaking", "a crowd presses against a wall of blocks until it breaks"},
    {"circle", "a thousand people cross to the other side of a circle"},
    {"two-bottlenecks", "a thousand people press through two narrow gaps"},
    {"evacuation", "people leave a hall; who is late, and where it gets dense"},
    {"running-through", "a runner pushes through a standing crowd"},
};

/* Folders in which scenes, and mods with scenes, are found by name; then the shipped ones. */
enum { PLACE_COUNT = 3 };
static const char *const PLACES[PLACE_COUNT] = {".", "scenes", NULL};
static const char *const MOD_PLACES[PLACE_COUNT] = {"mods", "scenes/mods", NULL};

/* Paths that cli_scene and cli_mod_folder returned, freed by cli_scenes_free. */
static CliPaths kept;

static const char *keep_path(char *path) {
    JOX_RESERVE(kept.items, kept.capacity, kept.count + 1);
    kept.items[kept.count++] = path;
    return path;
}

void cli_scenes_free(void) {
    for (size_t k = 0; k < kept.count; k++)
        jox_free(kept.items[k]);
    jox_free(kept.items);
    kept = (CliPaths){0};
}

/* Returns whether an argument may be the name of a scene, and is no path. */
static bool is_scene_name(const char *given) {
    return *given && strcspn(given, "/.") == strlen(given);
}

static bool is_mod_folder(const char *path) {
    struct stat info;
    return stat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

static const char *join_scene_path(const char *folder, const char *name, const char *ending) {
    JoxText path = {0};
    const bool here = !strcmp(folder, ".");
    jox_text_printf(&path, "%s%s%s%s", here ? "" : folder, here ? "" : "/", name, ending);
    return keep_path(path.data);
}

/* Returns a folder of PLACES or MOD_PLACES; for NULL `shipped` in the folder of installed files. */
static const char *find_place(const char *place, const char *shipped) {
    return place ? place : join_scene_path(jox_data_folder(), shipped, "");
}

const char *cli_mod_folder(const char *mod) {
    const char *home = getenv("XDG_DATA_HOME"), *user = getenv("HOME");
    if (is_mod_folder(mod))
        return mod;
    if (strchr(mod, '/'))
        return NULL;
    for (size_t p = 0; p < PLACE_COUNT; p++) {
        const char *folder = join_scene_path(find_place(MOD_PLACES[p], "scenes/mods"), mod, "");
        if (is_mod_folder(folder))
            return folder;
    }
    JoxText path = {0};
    jox_text_printf(&path, "%s%s/jostle/mods/%s",
                    home && *home ? home
                    : user        ? user
                                  : "",
                    home && *home ? "" : "/.local/share", mod);
    return is_mod_folder(keep_path(path.data)) ? path.data : NULL;
}

/* Paths at which a name was found: the first of PLACES, and one in each mod. */
typedef struct Found {
    const char *paths[1 + 64];
    size_t count;
} Found;

/* Adds a path if the file exists and is not the same as one found before. */
static void add_found_path(Found *found, const char *folder, const char *name) {
    const char *path = join_scene_path(folder, name, ".yaml");
    struct stat info, other;
    bool known = !jox_is_file(path) || stat(path, &info) != 0 ||
                 found->count == sizeof found->paths / sizeof *found->paths;
    for (size_t f = 0; f < found->count && !known; f++)
        known = stat(found->paths[f], &other) == 0 && other.st_dev == info.st_dev &&
                other.st_ino == info.st_ino;
    if (!known)
        found->paths[found->count++] = path;
}

/* Looks for the scene NAME, or for "MOD:NAME" in that mod only. */
static Found find_scene_paths(const char *given, const CliList *mods) {
    Found found = {0};
    const char *colon = strchr(given, ':'), *name = colon ? colon + 1 : given;
    for (size_t p = 0; !colon && !found.count && p < PLACE_COUNT; p++)
        add_found_path(&found, find_place(PLACES[p], "scenes"), name);
    for (size_t m = 0; mods && m < mods->count; m++) {
        const char *folder = cli_mod_folder(mods->items[m]);
        const char *last = folder ? strrchr(folder, '/') : NULL;
        last = last ? last + 1 : folder;
        if (folder && (!colon || (strlen(last) == (size_t)(colon - given) &&
                                  !strncmp(last, given, strlen(last)))))
            add_found_path(&found, join_scene_path(folder, "scenes", ""), name);
    }
    return found;
}

/* Adds the names of a folder's files as suggestions; if `scenes`, only those of .yaml files,
   without the ending. */
static void add_suggestions(CliPaths *names, const char *folder, bool scenes) {
    char **all = jox_folder_names(folder, false);
    for (char **name = all; name && *name; name++) {
        const size_t n = strlen(*name);
        const bool yaml = n > 5 && !strcmp(*name + n - 5, ".yaml");
        if (scenes && !yaml)
            continue;
        JOX_RESERVE(names->items, names->capacity, names->count + 1);
        names->items[names->count++] = jox_strndup(*name, scenes ? n - 5 : n);
    }
    jox_free(all);
}

/* Prints that a name or path does not exist, and the most similar one that does. */
static void print_missing(const CliCommand *command, const char *given, bool scene,
                          const CliList *mods) {
    CliPaths names = {0};
    const size_t before = jox_path_folder(given);
    JoxText folder = {0};
    jox_text_append(&folder, given, before);
    for (size_t p = 0; scene && p < PLACE_COUNT; p++)
        add_suggestions(&names, find_place(PLACES[p], "scenes"), true);
    for (size_t m = 0; scene && mods && m < mods->count; m++)
        if (cli_mod_folder(mods->items[m]))
            add_suggestions(&names, join_scene_path(cli_mod_folder(mods->items[m]), "scenes", ""),
                            true);
    if (!scene)
        add_suggestions(&names, before ? folder.data : ".", false);
    const char *near =
        jox_suggest(jox_path_name(given), (const char *const *)names.items, names.count);
    fprintf(stderr,
            scene ? "jostle %s: there is no scene '%s' here, in scenes/ or among those that came "
                    "with Jostle"
                  : "jostle %s: '%s' cannot be read: there is no such file",
            command->name, given);
    if (near)
        fprintf(stderr, ". Did you mean '%.*s%s'?\n", (int)before, given, near);
    else
        fputs(scene ? "; `jostle` lists some that did\n" : "\n", stderr);
    for (size_t n = 0; n < names.count; n++)
        jox_free(names.items[n]);
    jox_free(names.items);
    jox_text_free(&folder);
}

static void print_ambiguous(const CliCommand *command, const char *given, const Found *found) {
    fprintf(stderr,
            "jostle %s: there are several scenes '%s'; give the path of one:", command->name,
            given);
    for (size_t f = 0; f < found->count; f++)
        fprintf(stderr, "%s %s", f ? " or" : "", found->paths[f]);
    fputs("\n", stderr);
}

const char *cli_scene(const CliCommand *command, const char *given, const CliList *mods) {
    if (jox_is_file(given) || (!is_scene_name(given) && access(given, F_OK) == 0))
        return given;
    const Found found = is_scene_name(given) ? find_scene_paths(given, mods) : (Found){0};
    if (found.count == 1)
        return found.paths[0];
    if (found.count)
        print_ambiguous(command, given, &found);
    else
        print_missing(command, given, is_scene_name(given), mods);
    return NULL;
}

bool cli_scenes(const CliCommand *command, CliList *list) {
    for (size_t n = 0; n < list->count; n++)
        if (access(list->items[n], F_OK) != 0 &&
            (list->count == 1 || is_scene_name(list->items[n])) &&
            !(list->items[n] = cli_scene(command, list->items[n], NULL)))
            return false;
    return true;
}

bool cli_check_exists(const CliCommand *command, const char *given) {
    const bool there = access(given, F_OK) == 0;
    if (!there)
        print_missing(command, given, false, NULL);
    return there;
}

bool cli_check_recording(const CliCommand *command, const char *given) {
    if (access(given, F_OK) == 0 || !is_scene_name(given) || !find_scene_paths(given, NULL).count)
        return cli_check_exists(command, given);
    fprintf(stderr,
            "jostle %s: '%s' is a scene, no recording: `jostle run %s --record FILE` makes one\n",
            command->name, given, given);
    return false;
}

bool cli_is_scene(const char *given) {
    return is_scene_name(given) && find_scene_paths(given, NULL).count > 0;
}

void cli_list_scenes(FILE *out) {
    fputs("\nWorth seeing, in a browser:\n\n", out);
    for (size_t s = 0; s < sizeof WORTH_SEEING / sizeof *WORTH_SEEING; s++)
        fprintf(out, "  jostle run %-16s --view  %s\n", WORTH_SEEING[s].name, WORTH_SEEING[s].what);
}
