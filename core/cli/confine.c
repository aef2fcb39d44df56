/* Confines commands before they read files of unknown origin: collects the paths that a command
   needs (cli_reach_*), then gives up everything else (base/confine.h). */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/confine.h"
#include "base/file.h"
#include "base/format/installed.h"
#include "base/format/path.h"
#include "base/mem.h"
#include "base/text.h"
#include "cli/cli.h"

/* Files that system libraries read: fonts, time zones, processors. */
static const char *const SYSTEM[] = {"/usr",
                                     "/lib",
                                     "/lib64",
                                     "/etc/fonts",
                                     "/etc/ld.so.cache",
                                     "/etc/localtime",
                                     "/etc/timezone",
                                     "/dev/urandom",
                                     "/var/cache/fontconfig",
                                     "/proc/self",
                                     "/sys/devices/system"};
enum { DAY = 86400, MOST_FILES = 1024 };
static const size_t LARGEST_FILE = (size_t)256 << 30;
static const char *const ALWAYS_WRITTEN[] = {"/dev/null", "/dev/stdout", "/dev/stderr"};

static void add_reach_path(CliPaths *paths, char *path) {
    JOX_RESERVE(paths->items, paths->capacity, paths->count + 1);
    paths->items[paths->count++] = path;
}

static void free_paths(CliPaths *paths) {
    for (size_t p = 0; p < paths->count; p++)
        jox_free(paths->items[p]);
    jox_free(paths->items);
    *paths = (CliPaths){0};
}

/* Adds the path `rest` relative to the folder of a file. */
static void add_reach_path_beside(CliPaths *paths, const char *file, const char *rest) {
    JoxText text = {0};
    jox_text_printf(&text, "%.*s%s", (int)jox_path_folder(file), file, rest);
    add_reach_path(paths, text.data);
}

/* Adds the folder jostle of an XDG directory of the user. */
static void add_home_path(CliPaths *paths, const char *variable, const char *usual) {
    const char *set = getenv(variable), *home = getenv("HOME");
    JoxText text = {0};
    if (set && *set)
        jox_text_printf(&text, "%s/jostle", set);
    else
        jox_text_printf(&text, "%s/%s/jostle", home ? home : "", usual);
    add_reach_path(paths, text.data);
}

static bool is_existing_folder(const char *path) {
    struct stat info;
    return stat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

static bool is_archive(const char *path) {
    const size_t length = strlen(path);
    return length > 4 && strcmp(path + length - 4, ".zip") == 0;
}

void cli_reach_file(CliReach *reach, const char *path) {
    static const char *const OF_SQLITE[] = {"", "-journal", "-wal", "-shm"};
    for (size_t e = 0; path && e < sizeof OF_SQLITE / sizeof *OF_SQLITE; e++) {
        JoxText text = {0};
        jox_text_printf(&text, "%s%s", path, OF_SQLITE[e]);
        add_reach_path(&reach->reads, text.data);
    }
}

void cli_reach_folder(CliReach *reach, const char *path) {
    if (path)
        add_reach_path(&reach->reads, jox_strdup(path));
}

/* Allows reading what mods in a folder may need: if the folder is P/mods, the project P, as for its
   scenes; else the other mods in it. */
static void reach_mods_in(CliReach *reach, const char *folder) {
    static const char *const PARTS[] = {"..", "../../behaviours", "../../scripts"};
    const bool project = !strcmp(jox_path_name(folder), "mods");
    for (size_t p = 0; project && p < sizeof PARTS / sizeof *PARTS; p++) {
        JoxText text = {0};
        jox_text_printf(&text, "%s/%s", folder, PARTS[p]);
        add_reach_path(&reach->reads, text.data);
    }
    char **names = project ? NULL : jox_folder_names(folder, false);
    for (char **name = names; name && *name; name++) {
        JoxText mod = {0}, sheet = {0};
        jox_text_printf(&mod, "%s/%s", folder, *name);
        jox_text_printf(&sheet, "%s/mod.yaml", mod.data);
        if (access(sheet.data, F_OK) == 0)
            add_reach_path(&reach->reads, mod.data);
        else
            jox_text_free(&mod);
        jox_text_free(&sheet);
    }
    jox_free(names);
}

/* Allows reading what mods need, for a path that is a mod, lies in one, or is P/mods. */
static void reach_mods(CliReach *reach, const char *path) {
    static const char *const UP[] = {"", "/..", "/../.."};
    for (size_t u = 0; u < sizeof UP / sizeof *UP; u++) {
        JoxText folder = {0};
        jox_text_printf(&folder, "%.*s%s%s",
                        is_existing_folder(path) ? (int)strlen(path) : (int)jox_path_folder(path),
                        path, is_existing_folder(path) ? "" : ".", UP[u]);
        char *real = realpath(folder.data, NULL);
        JoxText sheet = {0};
        jox_text_printf(&sheet, "%s/mod.yaml", folder.data);
        const bool is_mod = access(sheet.data, F_OK) == 0;
        char *slash = real ? strrchr(real, '/') : NULL;
        if (is_mod && slash && slash > real) {
            *slash = 0;
            reach_mods_in(reach, real);
        } else if (real && !u && !strcmp(jox_path_name(real), "mods")) {
            reach_mods_in(reach, real);
        }
        free(real);
        jox_text_free(&folder);
        jox_text_free(&sheet);
        if (is_mod)
            return;
    }
}

void cli_reach_scene(CliReach *reach, const char *path) {
    if (!path)
        return;
    /* Behaviours of a project, and the scripts that these require, lie beside its folder of
       scenes. */
    static const char *const BESIDE[] = {".", "../behaviours", "../scripts"};
    for (size_t b = 0; b < sizeof BESIDE / sizeof *BESIDE; b++) {
        JoxText text = {0};
        if (is_existing_folder(path)) {
            jox_text_printf(&text, "%s/%s", path, BESIDE[b]);
            add_reach_path(&reach->reads, text.data);
        } else {
            add_reach_path_beside(&reach->reads, path, BESIDE[b]);
        }
    }
    reach_mods(reach, path);
}

void cli_reach_def(CliReach *reach, const JoSceneDef *def) {
    cli_reach_scene(reach, def->path);
    cli_reach_folder(reach, def->input_log);
    for (size_t m = 0; m < def->mod_count; m++) {
        cli_reach_folder(reach, def->mods[m]);
        if (is_existing_folder(def->mods[m]) || is_archive(def->mods[m]))
            reach_mods(reach, def->mods[m]);
    }
}

void cli_reach_output(CliReach *reach, const char *path) {
    if (!path || !strcmp(path, "-"))
        return;
    add_reach_path(&reach->writes, jox_strdup(path));
    if (is_existing_folder(path))
        return;
    char *folder = jox_strdup(path); /* the nearest folder above that exists */
    bool above;
    do {
        char *slash = strrchr(folder, '/');
        above = slash != NULL;
        if (above)
            slash[slash == folder] = 0; /* keeps "/" of the root */
    } while (above && !is_existing_folder(folder));
    add_reach_path(&reach->writes, above ? folder : jox_strdup("."));
    if (!above)
        jox_free(folder);
}

void cli_reach_settings(CliReach *reach) {
    CliPaths settings = {0};
    add_home_path(&settings, "XDG_CONFIG_HOME", ".config");
    JoxText file = {0}; /* any file in the folder, so that the folder itself may be made */
    jox_text_printf(&file, "%s/mods", settings.items[0]);
    cli_reach_output(reach, file.data);
    jox_text_free(&file);
    free_paths(&settings);
}

bool cli_confine(CliReach *reach) {
    add_home_path(&reach->reads, "XDG_DATA_HOME", ".local/share");
    add_home_path(&reach->reads, "XDG_CONFIG_HOME", ".config");
    for (size_t s = 0; s < sizeof SYSTEM / sizeof *SYSTEM; s++)
        cli_reach_folder(reach, SYSTEM[s]);
    cli_reach_folder(reach, jox_data_folder());
    for (size_t a = 0; a < sizeof ALWAYS_WRITTEN / sizeof *ALWAYS_WRITTEN; a++)
        add_reach_path(&reach->writes, jox_strdup(ALWAYS_WRITTEN[a]));
    const bool good =
        jox_confine(&(JoxConfines){.folders = (const char *const *)reach->reads.items,
                                   .folder_count = reach->reads.count,
                                   .outputs = (const char *const *)reach->writes.items,
                                   .output_count = reach->writes.count,
                                   .memory = reach->memory,
                                   .file_size = reach->file_size,
                                   .files = reach->files,
                                   .seconds = reach->seconds,
                                   .works = reach->works,
                                   .programs = reach->programs,
                                   .program = reach->program,
                                   .serves = reach->serves});
    if (!good) /* the system has neither Landlock nor seccomp */
        fputs("jostle: this system does not confine the process that reads files of others\n",
              stderr);
    free_paths(&reach->reads);
    free_paths(&reach->writes);
    return good;
}

static char late[160]; /* message of handle_time_limit, made beforehand */

/* Handles SIGXCPU: the command is out of processor time, but for a few seconds to finish its files
   in. */
static void handle_time_limit(int number) {
    signal(number, SIG_IGN); /* the signal is repeated each second */
    const ssize_t written = write(2, late, strlen(late));
    (void)written;
    if (!cli_request_end(number))
        _exit(JO_FAILED);
}

/* Fills the limits that a command left open: enough for long work, while the machine stays usable
   for others. */
static void fill_work_limits(CliReach *reach) {
    const size_t memory = (size_t)sysconf(_SC_PHYS_PAGES) * (size_t)sysconf(_SC_PAGESIZE);
    const long processors = sysconf(_SC_NPROCESSORS_CONF);
    reach->memory = reach->memory ? reach->memory : memory / 4 * 3;
    reach->seconds = reach->seconds ? reach->seconds : DAY * (unsigned)processors;
    reach->file_size = reach->file_size ? reach->file_size : LARGEST_FILE;
    reach->files = reach->files ? reach->files : MOST_FILES;
}

/* Prepares the message and the handler for the end of the processor time. */
static void catch_time_limit(const CliReach *reach) {
    snprintf(late, sizeof late,
             "jostle: the command took the processor time that it may, %u s or what the system "
             "left; with --trusted there is no limit\n",
             reach->seconds);
    signal(SIGXCPU, handle_time_limit);
}

void cli_limit_work(bool trusted) {
    CliReach reach = {.works = true};
    fill_work_limits(&reach);
    if (trusted)
        return;
    catch_time_limit(&reach);
    jox_confine_limits(&(JoxConfines){.memory = reach.memory,
                                      .file_size = reach.file_size,
                                      .files = reach.files,
                                      .seconds = reach.seconds,
                                      .works = true});
}

void cli_confine_work(CliReach *reach, bool trusted) {
    reach->works = true;
    fill_work_limits(reach);
    if (!trusted)
        catch_time_limit(reach);
    if (trusted) {
        free_paths(&reach->reads);
        free_paths(&reach->writes);
    } else {
        cli_confine(reach);
    }
}
