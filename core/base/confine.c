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

enum {
    LAST_SECONDS = 5, /* of processor time, for who works to say why it ends */
    FEW_FILES = 64
};

/* ---- files: Landlock, whose calls the C library does not have ---- */

static const uint64_t READING = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
static const uint64_t WRITING = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR |
                                LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_MAKE_REG |
                                LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_REMOVE_FILE |
                                LANDLOCK_ACCESS_FS_REMOVE_DIR;
static const uint64_t OF_FILES =
    LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_EXECUTE;
/* Where programs lie, and what they need to start. */
static const char *const PROGRAMS[] = {"/usr", "/bin", "/lib", "/lib64", "/opt"};

/* All that the first version of Landlock can forbid: the bits up to this one. */
static const uint64_t ALL = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1) - 1;

static bool has_landlock(void) {
    return syscall(SYS_landlock_create_ruleset, NULL, 0, LANDLOCK_CREATE_RULESET_VERSION) >= 1;
}

static bool allow(int rules, const char *path, uint64_t access) {
    struct stat info;
    struct landlock_path_beneath_attr rule = {.allowed_access = access};
    rule.parent_fd = open(path, O_PATH | O_CLOEXEC);
    if (rule.parent_fd < 0)
        return true; /* it is not there */
    if (fstat(rule.parent_fd, &info) == 0 && !S_ISDIR(info.st_mode))
        rule.allowed_access &= OF_FILES;
    const bool good =
        syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0) == 0 ||
        errno == EBADFD; /* a pipe, which is not confined */
    close(rule.parent_fd);
    return good;
}

static bool confine_files(const JoxConfines *confines) {
    const struct landlock_ruleset_attr attributes = {.handled_access_fs = ALL};
    const int rules = (int)syscall(SYS_landlock_create_ruleset, &attributes,
                                   sizeof attributes.handled_access_fs, 0);
    bool good = rules >= 0;
    for (size_t f = 0; good && f < confines->folder_count; f++)
        good = allow(rules, confines->folders[f], READING);
    for (size_t f = 0; good && f < confines->output_count; f++)
        good = allow(rules, confines->outputs[f], WRITING);
    for (size_t p = 0; good && confines->programs && p < sizeof PROGRAMS / sizeof *PROGRAMS; p++)
        good = allow(rules, PROGRAMS[p], READING | LANDLOCK_ACCESS_FS_EXECUTE);
    if (good && confines->program)
        good = allow(rules, confines->program, READING | LANDLOCK_ACCESS_FS_EXECUTE);
    good = good && syscall(SYS_landlock_restrict_self, rules, 0) == 0;
    if (rules >= 0)
        close(rules);
    return good;
}

/* ---- both, and limits ---- */

JoxConfining jox_confine_can(void) {
    return (JoxConfining){.files = has_landlock(), .calls = jox_confine_has_calls()};
}

/* Bytes of address space that the process has: tools that check memory take terabytes. */
static size_t size_now(void) {
    unsigned long long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (file && fscanf(file, "%llu", &pages) != 1)
        pages = 0;
    if (file)
        fclose(file);
    return (size_t)pages * (size_t)sysconf(_SC_PAGESIZE);
}

/* `spare`: how far the limit that ends the process lies above the one that it is told of. */
static bool limit(int what, rlim_t most, rlim_t spare) {
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
            limit(RLIMIT_CPU, confines->seconds, confines->works ? LAST_SECONDS : 0)) &&
           (!files || limit(RLIMIT_NOFILE, files, 0)) &&
           (!confines->file_size || limit(RLIMIT_FSIZE, confines->file_size, 0)) &&
           (!confines->memory || limit(RLIMIT_AS, size_now() + confines->memory, 0));
}

size_t jox_confine_memory_left(void) {
    struct rlimit now;
    const size_t size = size_now();
    if (getrlimit(RLIMIT_AS, &now) != 0 || now.rlim_cur == RLIM_INFINITY)
        return 0;
    return now.rlim_cur > size ? now.rlim_cur - size : 1;
}

bool jox_confine(const JoxConfines *confines) {
    const JoxConfining can = jox_confine_can();
    const bool good = limit(RLIMIT_CORE, 0, 0) && jox_confine_limits(confines) &&
                      prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
                      (!can.files || confine_files(confines));
    return good && (!can.calls || jox_confine_calls(confines));
}
