/* Filters of system calls (seccomp): programs of classic BPF, which the kernel runs before each
   call. A reader has a list of allowed calls, a worker one of forbidden calls. Each macro below
   yields instructions; those that test a call expect its number in the accumulator, and leave it
   there. */
#include "base/confine_calls.h"

#include <asm/ioctls.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#if defined __x86_64__
#define ARCHITECTURE AUDIT_ARCH_X86_64
#elif defined __aarch64__
#define ARCHITECTURE AUDIT_ARCH_AARCH64
#endif

#ifdef ARCHITECTURE
/* Loads a member of seccomp_data: `nr` is the call's number, `arch` the architecture. */
#define CALL(number) BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, number))
#define GIVE(action) BPF_STMT(BPF_RET | BPF_K, action)
#define WHERE(number, action) BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, number, 0, 1), GIVE(action)
#define MAY(name) WHERE(SYS_##name, SECCOMP_RET_ALLOW)
#define DIES(name) WHERE(SYS_##name, SECCOMP_RET_KILL_PROCESS)
/* Loads the lower half of an argument (both architectures are little-endian). */
#define ARGUMENT(n) BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, args[n]))
/* Allows a call that opens a file, with its flags in argument n, for reading alone. */
#define READS(name, n)                                                                             \
    BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_##name, 0, 4), ARGUMENT(n),                            \
        BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, O_ACCMODE | O_CREAT | O_TRUNC, 0, 1),                 \
        GIVE(SECCOMP_RET_ERRNO | EACCES), GIVE(SECCOMP_RET_ALLOW)

static const struct sock_filter READER[] = {
    CALL(arch), BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, ARCHITECTURE, 1, 0),
    GIVE(SECCOMP_RET_KILL_PROCESS), CALL(nr),
    /* reading, and writing to open descriptors */
    READS(openat, 2), MAY(read), MAY(pread64), MAY(readv), MAY(write), MAY(writev), MAY(close),
    MAY(lseek), MAY(fstat), MAY(newfstatat), MAY(statx), MAY(faccessat), MAY(faccessat2),
    MAY(readlinkat), MAY(getdents64), MAY(getcwd), MAY(fcntl), MAY(flock), MAY(ppoll),
    MAY(clock_nanosleep),
#ifdef __x86_64__
    READS(open, 1), MAY(stat), MAY(lstat), MAY(access), MAY(readlink), MAY(poll), MAY(getdents),
    MAY(time), MAY(arch_prctl),
#endif
    /* memory */
    MAY(brk), MAY(mmap), MAY(munmap), MAY(mremap), MAY(mprotect), MAY(madvise),
    /* the process itself */
    MAY(rt_sigaction), MAY(rt_sigprocmask), MAY(rt_sigreturn), MAY(sigaltstack), MAY(futex),
    MAY(getpid), MAY(gettid), MAY(getuid), MAY(geteuid), MAY(getgid), MAY(getegid), MAY(uname),
    MAY(sysinfo), MAY(getrusage), MAY(getrandom), MAY(clock_gettime), MAY(clock_getres),
    MAY(gettimeofday), MAY(sched_yield), MAY(sched_getaffinity), MAY(tgkill), MAY(membarrier),
    MAY(restart_syscall), MAY(exit), MAY(exit_group),
    /* calls that only an attack would make: fatal */
    DIES(execve), DIES(execveat), DIES(socket), DIES(ptrace), DIES(bpf), DIES(process_vm_writev),
    GIVE(SECCOMP_RET_ERRNO | EPERM)};

/* ---- a worker: all calls except those that reach beyond its files and itself ---- */

static const int FORBIDDEN[] = {
#ifndef __SANITIZE_ADDRESS__ /* AddressSanitizer uses ptrace to find leaks */
    SYS_ptrace,
#endif
    /* other processes */
    SYS_process_vm_readv, SYS_process_vm_writev, SYS_tkill, SYS_rt_sigqueueinfo,
    SYS_rt_tgsigqueueinfo, SYS_pidfd_open, SYS_pidfd_getfd, SYS_pidfd_send_signal, SYS_kcmp,
    SYS_shmget, SYS_shmat, SYS_msgget, SYS_semget,
    /* the network, and io_uring, which makes calls that no filter sees */
    SYS_connect, SYS_sendmsg, SYS_sendmmsg, SYS_io_uring_setup, SYS_io_uring_enter,
    SYS_io_uring_register,
    /* changes of files that Landlock does not restrict */
    SYS_openat2, SYS_open_by_handle_at, SYS_truncate, SYS_fchmod, SYS_fchmodat, SYS_fchown,
    SYS_fchownat, SYS_setxattr, SYS_lsetxattr, SYS_fsetxattr, SYS_removexattr, SYS_lremovexattr,
    SYS_fremovexattr, SYS_utimensat,
#ifdef __x86_64__
    SYS_chmod, SYS_chown, SYS_lchown, SYS_utime, SYS_utimes, SYS_futimesat,
#endif
    /* the system */
    SYS_bpf, SYS_perf_event_open, SYS_userfaultfd, SYS_add_key, SYS_request_key, SYS_keyctl,
    SYS_mount, SYS_umount2, SYS_pivot_root, SYS_chroot, SYS_unshare, SYS_setns, SYS_quotactl,
    SYS_swapon, SYS_swapoff, SYS_reboot, SYS_acct, SYS_init_module, SYS_finit_module,
    SYS_delete_module, SYS_kexec_load};

typedef struct Filter {
    struct sock_filter lines[256];
    unsigned short count;
} Filter;

static void add_instructions(Filter *filter, const struct sock_filter *lines, size_t count) {
    for (size_t l = 0; l < count; l++)
        filter->lines[filter->count++] = lines[l];
}

#define ADD(filter, ...)                                                                           \
    add_instructions(filter, (const struct sock_filter[]){__VA_ARGS__},                            \
                     sizeof(const struct sock_filter[]){__VA_ARGS__} / sizeof(struct sock_filter))
#define FAILS(number) WHERE(number, SECCOMP_RET_ERRNO | EPERM)
/* Loads the upper half of an argument. */
#define UPPER(n) BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, args[n]) + 4)
/* Makes a call fail if its argument n, masked, has (FAILS_WITH) or has not (FAILS_UNLESS) a value;
   loads the call's number again for the instructions that follow. */
#define FAILS_WITH(name, n, mask, value)                                                           \
    BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_##name, 0, 5), ARGUMENT(n),                            \
        BPF_STMT(BPF_ALU | BPF_AND | BPF_K, mask),                                                 \
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 0, 1), GIVE(SECCOMP_RET_ERRNO | EPERM),         \
        CALL(nr)
#define FAILS_UNLESS(name, n, mask, value)                                                         \
    BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_##name, 0, 5), ARGUMENT(n),                            \
        BPF_STMT(BPF_ALU | BPF_AND | BPF_K, mask),                                                 \
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 1, 0), GIVE(SECCOMP_RET_ERRNO | EPERM),         \
        CALL(nr)

static void fill_worker_filter(Filter *filter, const JoxConfines *confines) {
    enum { OTHER_CALLS = 0x40000000 /* x32: the same calls by other numbers */ };
    const unsigned none = 0xffffffff; /* number that a debugger sets to skip a call */
    ADD(filter, CALL(arch), BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, ARCHITECTURE, 1, 0),
        GIVE(SECCOMP_RET_KILL_PROCESS), CALL(nr), WHERE(none, SECCOMP_RET_ALLOW),
        BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, OTHER_CALLS, 0, 1), GIVE(SECCOMP_RET_KILL_PROCESS));
    for (size_t f = 0; f < sizeof FORBIDDEN / sizeof *FORBIDDEN; f++)
        ADD(filter, FAILS((unsigned)FORBIDDEN[f]));
    if (!confines->programs)
        ADD(filter, DIES(execve), DIES(execveat));
    if (!confines->program) /* a worker that runs another program must be allowed to kill it */
        ADD(filter, FAILS(SYS_kill));
    if (confines->serves) /* stream sockets alone, and sendto without an address */
        ADD(filter, FAILS_UNLESS(socket, 1, 0xf, SOCK_STREAM),
            BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_sendto, 0, 6), ARGUMENT(4),
            BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, 0, 0, 2), UPPER(4),
            BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, 0, 1, 0), GIVE(SECCOMP_RET_ERRNO | EPERM),
            CALL(nr));
    else
        ADD(filter, FAILS(SYS_socket));
    ADD(filter, FAILS_UNLESS(tgkill, 0, UINT32_MAX, (uint32_t)getpid()),
        /* O_TRUNC with O_RDONLY would empty a file that may only be read; the ioctls would type
           commands into a terminal */
        FAILS_WITH(openat, 2, O_ACCMODE | O_TRUNC, O_TRUNC),
        FAILS_WITH(ioctl, 1, UINT32_MAX, TIOCSTI), FAILS_WITH(ioctl, 1, UINT32_MAX, TIOCLINUX));
#ifdef __x86_64__
    ADD(filter, FAILS_WITH(open, 1, O_ACCMODE | O_TRUNC, O_TRUNC));
#endif
    ADD(filter, GIVE(SECCOMP_RET_ALLOW));
}

static bool install_filter(const struct sock_filter *lines, size_t count) {
    const struct sock_fprog program = {.len = (unsigned short)count,
                                       .filter = (struct sock_filter *)(uintptr_t)lines};
    return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

bool jox_confine_calls(const JoxConfines *confines) {
    Filter filter = {.count = 0};
    if (!confines->works)
        return install_filter(READER, sizeof READER / sizeof *READER);
    fill_worker_filter(&filter, confines);
    return install_filter(filter.lines, filter.count);
}

bool jox_confine_has_calls(void) {
    const uint32_t action = SECCOMP_RET_KILL_PROCESS;
    return syscall(SYS_seccomp, SECCOMP_GET_ACTION_AVAIL, 0, &action) == 0;
}
#else
bool jox_confine_calls(const JoxConfines *confines) {
    return confines != NULL;
}

bool jox_confine_has_calls(void) {
    return false;
}
#endif
