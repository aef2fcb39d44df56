/* Commands on files of others give up what they do not need before they read one. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/confine.h"
#include "base/file.h"
#include "base/format/path.h"
#include "base/mem.h"
#include "base/text.h"
#include "cli/cli.h"

/* What libraries read by themselves: fonts, time zones, processors. */
static const char *const SYSTEM[] = {"/usr",
                                     "/lib",
                                     "/lib64",
                                     "/etc/fonts",
                                     "/etc/ld.so.cache",
                                     "/etc/localtime",
                                     "/etc/timezone",
                                     "/dev/urandom",
                                     "/var/cache/fontconfig",
                                     JOX_DATADIR,
                                     "/proc/self",
                                     "/sys/devices/system"};
enum { DAY = 86400, MOST_FILES = 1024 };
static const size_t LARGEST_FILE = (size_t)256 << 30;
static const char *const ALWAYS_WRITTEN[] = {"/dev/null", "/dev/stdout", "/dev/stderr"};

static void put(CliPaths *paths, char *path) {
    JOX_RESERVE(paths->items, paths->capacity, paths->count + 1);
    paths->items[paths->count++] = path;
}

static void free_all(CliPaths *paths) {
    for (size_t p = 0; p < paths->count; p++)
        jox_free(paths->items[p]);
    jox_free(paths->items);
    *paths = (CliPaths){0};
}

/* What lies at `rest` as seen from the folder of a file. */
static void put_beside(CliPaths *paths, const char *file, const char *rest) {
    JoxText text = {0};
    jox_text_printf(&text, "%.*s%s", (int)jox_path_folder(file), file, rest);
    put(paths, text.data);
}

/* The user's folder of mods, or the list of those that are on. */
static void put_home(CliPaths *paths, const char *variable, const char *usual) {
    const char *set = getenv(variable), *home = getenv("HOME");
    JoxText text = {0};
    if (set && *set)
        jox_text_printf(&text, "%s/jostle", set);
    else
        jox_text_printf(&text, "%s/%s/jostle", home ? home : "", usual);
    put(paths, text.data);
}

static bool is_folder(const char *path) {
    struct stat info;
    return stat(path, &info) == 0 && S_ISDIR(info.st_mode);
}

void cli_reach_file(CliReach *reach, const char *path) {
    static const char *const OF_SQLITE[] = {"", "-journal", "-wal", "-shm"};
    for (size_t e = 0; path && e < sizeof OF_SQLITE / sizeof *OF_SQLITE; e++) {
        JoxText text = {0};
        jox_text_printf(&text, "%s%s", path, OF_SQLITE[e]);
        put(&reach->reads, text.data);
    }
}

void cli_reach_folder(CliReach *reach, const char *path) {
    if (path)
        put(&reach->reads, jox_strdup(path));
}

/* What mods in a folder may need: the project P, as its scenes do, where that is P/mods; else one
   another. */
static void reach_mods_in(CliReach *reach, const char *folder) {
    static const char *const PARTS[] = {"..", "../../behaviours", "../../scripts"};
    const bool project = !strcmp(jox_path_name(folder), "mods");
    for (size_t p = 0; project && p < sizeof PARTS / sizeof *PARTS; p++) {
        JoxText text = {0};
        jox_text_printf(&text, "%s/%s", folder, PARTS[p]);
        put(&reach->reads, text.data);
    }
    char **names = project ? NULL : jox_folder_names(folder, false);
    for (char **name = names; name && *name; name++) {
        JoxText mod = {0}, sheet = {0};
        jox_text_printf(&mod, "%s/%s", folder, *name);
        jox_text_printf(&sheet, "%s/mod.yaml", mod.data);
        if (access(sheet.data, F_OK) == 0)
            put(&reach->reads, mod.data);
        else
            jox_text_free(&mod);
        jox_text_free(&sheet);
    }
    jox_free(names);
}

/* The same of a path that is a mod, lies in one or is P/mods. */
static void reach_mods(CliReach *reach, const char *path) {
    static const char *const UP[] = {"", "/..", "/../.."};
    for (size_t u = 0; u < sizeof UP / sizeof *UP; u++) {
        JoxText folder = {0};
        jox_text_printf(&folder, "%.*s%s%s",
                        is_folder(path) ? (int)strlen(path) : (int)jox_path_folder(path), path,
                        is_folder(path) ? "" : ".", UP[u]);
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
    /* A project's behaviours and what these require lie beside its folder of scenes. */
    static const char *const BESIDE[] = {".", "../behaviours", "../scripts"};
    for (size_t b = 0; b < sizeof BESIDE / sizeof *BESIDE; b++) {
        JoxText text = {0};
        if (is_folder(path)) {
            jox_text_printf(&text, "%s/%s", path, BESIDE[b]);
            put(&reach->reads, text.data);
        } else {
            put_beside(&reach->reads, path, BESIDE[b]);
        }
    }
    reach_mods(reach, path);
}

void cli_reach_def(CliReach *reach, const JoSceneDef *def) {
    cli_reach_scene(reach, def->path);
    cli_reach_folder(reach, def->input_log);
    for (size_t m = 0; m < def->mod_count; m++) {
        cli_reach_folder(reach, def->mods[m]);
        if (is_folder(def->mods[m]))
            reach_mods(reach, def->mods[m]);
    }
}

void cli_reach_output(CliReach *reach, const char *path) {
    if (!path || !strcmp(path, "-"))
        return;
    put(&reach->writes, jox_strdup(path));
    if (is_folder(path))
        return;
    char *folder = jox_strdup(path); /* where it is made, or its folder */
    bool above;
    do {
        char *slash = strrchr(folder, '/');
        above = slash != NULL;
        if (above)
            slash[slash == folder] = 0; /* "/" stays */
    } while (above && !is_folder(folder));
    put(&reach->writes, above ? folder : jox_strdup("."));
    if (!above)
        jox_free(folder);
}

void cli_reach_settings(CliReach *reach) {
    CliPaths settings = {0};
    put_home(&settings, "XDG_CONFIG_HOME", ".config");
    JoxText file = {0}; /* some file in the folder, which may have to be made */
    jox_text_printf(&file, "%s/mods", settings.items[0]);
    cli_reach_output(reach, file.data);
    jox_text_free(&file);
    free_all(&settings);
}

bool cli_confine(CliReach *reach) {
    put_home(&reach->reads, "XDG_DATA_HOME", ".local/share");
    put_home(&reach->reads, "XDG_CONFIG_HOME", ".config");
    for (size_t s = 0; s < sizeof SYSTEM / sizeof *SYSTEM; s++)
        cli_reach_folder(reach, SYSTEM[s]);
    for (size_t a = 0; a < sizeof ALWAYS_WRITTEN / sizeof *ALWAYS_WRITTEN; a++)
        put(&reach->writes, jox_strdup(ALWAYS_WRITTEN[a]));
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
    if (!good) /* as on systems that have neither Landlock nor seccomp */
        fputs("jostle: this system does not confine the process that reads files of others\n",
              stderr);
    free_all(&reach->reads);
    free_all(&reach->writes);
    return good;
}

static char late[160]; /* what is said then */

/* The processor time of the command is over, but for a few seconds to finish its files in. */
static void tell_late(int number) {
    signal(number, SIG_IGN); /* it comes again each second */
    const ssize_t written = write(2, late, strlen(late));
    (void)written;
    if (!cli_end_soon(number))
        _exit(JO_FAILED);
}

/* Of commands that simulate, draw or serve for long: enough for all work, and the machine stays of
   use to others. */
static void limit_work(CliReach *reach) {
    const size_t memory = (size_t)sysconf(_SC_PHYS_PAGES) * (size_t)sysconf(_SC_PAGESIZE);
    const long processors = sysconf(_SC_NPROCESSORS_CONF);
    reach->memory = reach->memory ? reach->memory : memory / 4 * 3;
    reach->seconds = reach->seconds ? reach->seconds : DAY * (unsigned)processors;
    reach->file_size = reach->file_size ? reach->file_size : LARGEST_FILE;
    reach->files = reach->files ? reach->files : MOST_FILES;
}

static void catch_late(const CliReach *reach) {
    snprintf(late, sizeof late,
             "jostle: the command took the processor time that it may, %u s or what the system "
             "left; with --trusted there is no limit\n",
             reach->seconds);
    signal(SIGXCPU, tell_late);
}

void cli_limit_work(bool trusted) {
    CliReach reach = {.works = true};
    limit_work(&reach);
    if (trusted)
        return;
    catch_late(&reach);
    jox_confine_limits(&(JoxConfines){.memory = reach.memory,
                                      .file_size = reach.file_size,
                                      .files = reach.files,
                                      .seconds = reach.seconds,
                                      .works = true});
}

void cli_confine_work(CliReach *reach, bool trusted) {
    reach->works = true;
    limit_work(reach);
    if (!trusted)
        catch_late(reach);
    if (trusted) {
        free_all(&reach->reads);
        free_all(&reach->writes);
    } else {
        cli_confine(reach);
    }
}
