#include "base/confine_calls.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/landlock.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "base/process_memory.h"

enum {
    LAST_SECONDS = 5, /* processor time between SIGXCPU and the end of a worker, s */
    FEW_FILES = 64    /* open files of a reader */
};

/* ---- files: Landlock, by raw system calls, which the C library does not wrap ---- */

static const uint64_t READING = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
static const uint64_t WRITING = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR |
                                LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_MAKE_REG |
                                LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_REMOVE_FILE |
                                LANDLOCK_ACCESS_FS_REMOVE_DIR;
static const uint64_t OF_FILES =
    LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_EXECUTE;
/* Folders of the system's programs and of the libraries that they load. */
static const char *const PROGRAMS[] = {"/usr", "/bin", "/lib", "/lib64", "/opt"};

/* All rights that the first version of Landlock can restrict: the bits up to MAKE_SYM. */
static const uint64_t ALL = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1) - 1;

static bool has_landlock(void) {
    return syscall(SYS_landlock_create_ruleset, NULL, 0, LANDLOCK_CREATE_RULESET_VERSION) >= 1;
}

/* Adds a rule that grants `access` beneath a path. A path that does not exist is skipped. */
static bool allow_path(int rules, const char *path, uint64_t access) {
    struct stat info;
    struct landlock_path_beneath_attr rule = {.allowed_access = access};
    rule.parent_fd = open(path, O_PATH | O_CLOEXEC);
    if (rule.parent_fd < 0)
        return true; /* the path does not exist */
    if (fstat(rule.parent_fd, &info) == 0 && !S_ISDIR(info.st_mode))
        rule.allowed_access &= OF_FILES;
    const bool good =
        syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0) == 0 ||
        errno == EBADFD; /* a pipe: Landlock does not restrict those */
    close(rule.parent_fd);
    return good;
}

static bool confine_files(const JoxConfines *confines) {
    const struct landlock_ruleset_attr attributes = {.handled_access_fs = ALL};
    const int rules = (int)syscall(SYS_landlock_create_ruleset, &attributes,
                                   sizeof attributes.handled_access_fs, 0);
    bool good = rules >= 0;
    for (size_t f = 0; good && f < confines->folder_count; f++)
        good = allow_path(rules, confines->folders[f], READING);
    for (size_t f = 0; good && f < confines->output_count; f++)
        good = allow_path(rules, confines->outputs[f], WRITING);
    for (size_t p = 0; good && confines->programs && p < sizeof PROGRAMS / sizeof *PROGRAMS; p++)
        good = allow_path(rules, PROGRAMS[p], READING | LANDLOCK_ACCESS_FS_EXECUTE);
    if (good && confines->program)
        good = allow_path(rules, confines->program, READING | LANDLOCK_ACCESS_FS_EXECUTE);
    good = good && syscall(SYS_landlock_restrict_self, rules, 0) == 0;
    if (rules >= 0)
        close(rules);
    return good;
}

/* ---- limits, and all together ---- */

JoxConfining jox_confine_can(void) {
    return (JoxConfining){.files = has_landlock(), .calls = jox_confine_has_calls()};
}

/* Lowers a resource limit: the soft one, of which a process is told, to `most`, and the hard one to
   `spare` more. Never raises either. */
static bool lower_limit(int what, rlim_t most, rlim_t spare) {
    struct rlimit old;
    if (getrlimit((__rlimit_resource_t)what, &old) != 0)
        return false;
    const rlim_t last = most + spare < old.rlim_max ? most + spare : old.rlim_max;
    const rlim_t told = last > spare ? last - spare : last;
    most = most < told ? most : told;
    return setrlimit((__rlimit_resource_t)what, &(struct rlimit){most, last}) == 0;
}

bool jox_confine_limits(const JoxConfines *confines) {
    const unsigned files = confines->files || confines->works ? confines->files : FEW_FILES;
    return (!confines->seconds ||
            lower_limit(RLIMIT_CPU, confines->seconds, confines->works ? LAST_SECONDS : 0)) &&
           (!files || lower_limit(RLIMIT_NOFILE, files, 0)) &&
           (!confines->file_size || lower_limit(RLIMIT_FSIZE, confines->file_size, 0)) &&
           (!confines->memory ||
            lower_limit(RLIMIT_AS, jox_read_process_memory().addresses + confines->memory, 0));
}

size_t jox_confine_memory_left(void) {
    struct rlimit now;
    const uint64_t size = jox_read_process_memory().addresses;
    if (getrlimit(RLIMIT_AS, &now) != 0 || now.rlim_cur == RLIM_INFINITY)
        return 0;
    return now.rlim_cur > size ? now.rlim_cur - size : 1;
}

bool jox_confine(const JoxConfines *confines) {
    const JoxConfining can = jox_confine_can();
    const bool good = lower_limit(RLIMIT_CORE, 0, 0) && jox_confine_limits(confines) &&
                      prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
                      (!can.files || confine_files(confines));
    return good && (!can.calls || jox_confine_calls(confines));
}
