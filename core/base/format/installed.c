/* Finds the folders of installed files, once per process. What looks for a shipped scene,
   behaviour, library of Lua or page calls it. */
#include "base/format/installed.h"

#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>
#if defined(__linux__) || defined(__APPLE__)
#include <dlfcn.h>
#endif
#ifdef __linux__
#include <sys/auxv.h>
#endif

#include "base/format/path.h"

enum { LONGEST_FOLDER = 4096 };
static char data_folder[LONGEST_FOLDER], page_folder[LONGEST_FOLDER];
static pthread_once_t found_once = PTHREAD_ONCE_INIT;

#ifdef __linux__
/* Writes the path of the program; false if `base` is not where it is loaded. dladdr names it as it
   was started, which may be relative to a folder left since. */
static bool find_program_file(const void *base, char path[LONGEST_FOLDER]) {
    Dl_info program;
    const void *entry = (const void *)getauxval(AT_ENTRY);
    if (!entry || !dladdr(entry, &program) || program.dli_fbase != base)
        return false;
    const ssize_t length = readlink("/proc/self/exe", path, LONGEST_FOLDER - 1);
    path[length > 0 ? length : 0] = 0;
    return length > 0;
}
#elif defined(__APPLE__)
static bool find_program_file(const void *base, char path[LONGEST_FOLDER]) {
    (void)base, (void)path;
    return false;
}
#endif

/* Writes the path of the program or shared library that contains this code, "" if the system does
   not tell it. */
static void find_own_file(char path[LONGEST_FOLDER]) {
    *path = 0;
#if defined(__linux__) || defined(__APPLE__)
    Dl_info own;
    if (dladdr((void *)data_folder, &own) && own.dli_fname &&
        !find_program_file(own.dli_fbase, path))
        snprintf(path, LONGEST_FOLDER, "%s", own.dli_fname);
#endif
}

/* Writes a folder of the build, which may be relative to the folder of the file `own`: "." is that
   folder itself. */
static void place_folder(char folder[LONGEST_FOLDER], const char *built, const char *own) {
    const size_t before = jox_path_folder(own);
    if (*built == '/' || !before)
        snprintf(folder, LONGEST_FOLDER, "%s", built);
    else if (!strcmp(built, "."))
        snprintf(folder, LONGEST_FOLDER, "%.*s", (int)(before - 1), own);
    else if (before + strlen(built) < LONGEST_FOLDER)
        snprintf(folder, LONGEST_FOLDER, "%.*s%s", (int)before, own, built);
}

static void find_folders(void) {
    static const char DATA[] = JOX_DATADIR, PAGE[] = JOX_PAGEDIR;
    char own[LONGEST_FOLDER] = ""; /* without it, they are relative to the current folder */
    if (*DATA != '/' || *PAGE != '/')
        find_own_file(own);
    place_folder(data_folder, DATA, own);
    place_folder(page_folder, PAGE, own);
}

const char *jox_data_folder(void) {
    pthread_once(&found_once, find_folders);
    return data_folder;
}

const char *jox_page_folder(void) {
    pthread_once(&found_once, find_folders);
    return page_folder;
}
