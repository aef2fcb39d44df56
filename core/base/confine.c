#include "base/confine.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#if defined __x86_64__
#define ARCHITECTURE AUDIT_ARCH_X86_64
#elif defined __aarch64__
#define ARCHITECTURE AUDIT_ARCH_AARCH64
#endif

/* ---- files: Landlock, whose calls the C library does not have ---- */

static const uint64_t READING = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;

/* All that the first version of Landlock can forbid: the bits up to this one. */
static const uint64_t ALL = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1) - 1;

static bool has_landlock(void) {
    return syscall(SYS_landlock_create_ruleset, NULL, 0, LANDLOCK_CREATE_RULESET_VERSION) >= 1;
}

static bool allow(int rules, const char *path) {
    struct stat info;
    struct landlock_path_beneath_attr rule = {.allowed_access = READING};
    rule.parent_fd = open(path, O_PATH | O_CLOEXEC);
    if (rule.parent_fd < 0)
        return true; /* it is not there */
    if (fstat(rule.parent_fd, &info) == 0 && !S_ISDIR(info.st_mode))
        rule.allowed_access = LANDLOCK_ACCESS_FS_READ_FILE;
    const bool good =
        syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0) == 0;
    close(rule.parent_fd);
    return good;
}

static bool confine_files(const JoxConfines *confines) {
    const struct landlock_ruleset_attr attributes = {.handled_access_fs = ALL};
    const int rules = (int)syscall(SYS_landlock_create_ruleset, &attributes,
                                   sizeof attributes.handled_access_fs, 0);
    bool good = rules >= 0;
    for (size_t f = 0; good && f < confines->folder_count; f++)
        good = allow(rules, confines->folders[f]);
    good = good && syscall(SYS_landlock_restrict_self, rules, 0) == 0;
    if (rules >= 0)
        close(rules);
    return good;
}

/* ---- calls: seccomp ---- */

#ifdef ARCHITECTURE
#define CALL(number) BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, number))
#define GIVE(action) BPF_STMT(BPF_RET | BPF_K, action)
#define WHERE(number, action) BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, number, 0, 1), GIVE(action)
#define MAY(name) WHERE(SYS_##name, SECCOMP_RET_ALLOW)
#define DIES(name) WHERE(SYS_##name, SECCOMP_RET_KILL_PROCESS)
/* The lower half of an argument, on machines of both calls little-endian. */
#define ARGUMENT(n) BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, args[n]))
/* An opening, whose flags are argument n: for reading alone. */
#define READS(name, n)                                                                             \
    BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_##name, 0, 4), ARGUMENT(n),                            \
        BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, O_ACCMODE | O_CREAT | O_TRUNC, 0, 1),                 \
        GIVE(SECCOMP_RET_ERRNO | EACCES), GIVE(SECCOMP_RET_ALLOW)

static const struct sock_filter FILTER[] = {
    CALL(arch), BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, ARCHITECTURE, 1, 0),
    GIVE(SECCOMP_RET_KILL_PROCESS), CALL(nr),
    /* reading, and writing to what is open */
    READS(openat, 2), MAY(read), MAY(pread64), MAY(readv), MAY(write), MAY(writev), MAY(close),
    MAY(lseek), MAY(fstat), MAY(newfstatat), MAY(statx), MAY(faccessat), MAY(faccessat2),
    MAY(readlinkat), MAY(getdents64), MAY(getcwd), MAY(fcntl), MAY(flock), MAY(ppoll),
#ifdef __x86_64__
    READS(open, 1), MAY(stat), MAY(lstat), MAY(access), MAY(readlink), MAY(poll), MAY(getdents),
    MAY(time), MAY(arch_prctl),
#endif
    /* memory */
    MAY(brk), MAY(mmap), MAY(munmap), MAY(mremap), MAY(mprotect), MAY(madvise),
    /* itself */
    MAY(rt_sigaction), MAY(rt_sigprocmask), MAY(rt_sigreturn), MAY(sigaltstack), MAY(futex),
    MAY(getpid), MAY(gettid), MAY(getuid), MAY(geteuid), MAY(getgid), MAY(getegid), MAY(uname),
    MAY(sysinfo), MAY(getrusage), MAY(getrandom), MAY(clock_gettime), MAY(clock_getres),
    MAY(gettimeofday), MAY(sched_yield), MAY(sched_getaffinity), MAY(tgkill), MAY(membarrier),
    MAY(restart_syscall), MAY(exit), MAY(exit_group),
    /* what only an attack would do */
    DIES(execve), DIES(execveat), DIES(socket), DIES(ptrace), DIES(bpf), DIES(process_vm_writev),
    GIVE(SECCOMP_RET_ERRNO | EPERM)};

static bool confine_calls(void) {
    const struct sock_fprog program = {.len = sizeof FILTER / sizeof *FILTER,
                                       .filter = (struct sock_filter *)(uintptr_t)FILTER};
    return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}
#endif

static bool has_seccomp(void) {
#ifdef ARCHITECTURE
    const uint32_t action = SECCOMP_RET_KILL_PROCESS;
    return syscall(SYS_seccomp, SECCOMP_GET_ACTION_AVAIL, 0, &action) == 0;
#else
    return false;
#endif
}

JoxConfining jox_confine_can(void) {
    return (JoxConfining){.files = has_landlock(), .calls = has_seccomp()};
}

/* ---- both, and limits ---- */

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

static bool limit(int what, rlim_t most) {
    struct rlimit old;
    if (getrlimit((__rlimit_resource_t)what, &old) != 0)
        return false;
    most = most < old.rlim_max ? most : old.rlim_max;
    return setrlimit((__rlimit_resource_t)what, &(struct rlimit){most, most}) == 0;
}

bool jox_confine(const JoxConfines *confines) {
    const JoxConfining can = jox_confine_can();
    bool good = limit(RLIMIT_CORE, 0) && limit(RLIMIT_CPU, confines->seconds) &&
                limit(RLIMIT_NOFILE, 64) && limit(RLIMIT_AS, size_now() + confines->memory) &&
                prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0;
    good = good && (!can.files || confine_files(confines));
#ifdef ARCHITECTURE
    good = good && (!can.calls || confine_calls());
#endif
    return good;
}
