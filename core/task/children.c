#include "task/children.h"

#include <errno.h>
#include <fcntl.h>
#include <setjmp.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/assert.h"
#include "base/confine.h"
#include "base/file.h"
#include "base/mem.h"

enum { WAIT_MS = 20, WAITS = 10, OUT_OF_MEMORY = 99 /* exit status */ };

typedef struct Child {
    uint64_t job;
    pid_t process;    /* 0: free slot */
    int result, said; /* files in memory: the result, and standard error */
} Child;

struct JoxChildren {
    Child *all;
    uint32_t most, count;
    size_t memory; /* bytes that a child may allocate beyond those of the fork; 0: no limit */
};

static void close_child(JoxChildren *c, Child *child) {
    close(child->result);
    close(child->said);
    *child = (Child){0};
    c->count--;
}

static void kill_children(void *children) {
    JoxChildren *c = children;
    for (uint32_t k = 0; k < c->most; k++) {
        Child *child = &c->all[k];
        if (child->process == 0)
            continue;
        kill(child->process, SIGKILL);
        while (waitpid(child->process, NULL, 0) < 0 && errno == EINTR)
            continue;
        close_child(c, child);
    }
}

JoxChildren *jox_children_create(uint32_t most) {
    JOX_ASSERT(most > 0);
    JoxChildren *c = jox_alloc(1, sizeof *c);
    c->all = jox_alloc(most, sizeof *c->all);
    c->most = most;
    c->memory = most > 1 ? jox_confine_memory_left() / most : 0;
    return jox_heap_register(c, kill_children);
}

void jox_children_free(JoxChildren *c) {
    if (!c)
        return;
    jox_heap_unregister(c);
    kill_children(c);
    jox_free(c->all);
    jox_free(c);
}

bool jox_children_has_room(const JoxChildren *c) {
    return c->count < c->most;
}

uint32_t jox_children_count(const JoxChildren *c) {
    return c->count;
}

/* Runs the work in the forked child, without SIGINT, SIGHUP and SIGTERM, with standard input and
   output closed. Does not return. */
static void run_child(const Child *child, size_t memory, pid_t parent, JoxChildWork *work,
                      void *context) {
    JoxRecovery recovery;
    JoxText result = {0};
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) /* the parent ended before prctl took effect */
        _exit(1);
    /* Ctrl-C, and batch systems that cancel a job, also reach the parent, which kills its children:
       a run that they end is no run that failed */
    signal(SIGINT, SIG_IGN);
    signal(SIGHUP, SIG_IGN);
    signal(SIGTERM, SIG_IGN);
    signal(SIGXCPU, SIG_DFL); /* the parent's handler finishes files; a child has none */
    const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
    dup2(nothing, 0);
    dup2(nothing, 1);
    dup2(child->said, 2);
    jox_confine_limits(&(JoxConfines){.memory = memory, .works = true});
    jox_heap_use(NULL);
    jox_recovery_push(&recovery);
    if (setjmp(recovery.jump) != 0)
        _exit(OUT_OF_MEMORY);
    work(context, child->job, &result);
    const bool good = jox_file_send(child->result, result.data, result.length);
    _exit(good ? 0 : 1); /* not exit(): it would flush and close what the parent also has */
}

bool jox_children_start(JoxChildren *c, uint64_t job, JoxChildWork *work, void *context) {
    Child *child = c->all;
    JOX_ASSERT(jox_children_has_room(c));
    while (child->process)
        child++;
    const Child fresh = {.job = job,
                         .result = memfd_create("result", MFD_CLOEXEC),
                         .said = memfd_create("said", MFD_CLOEXEC)};
    const pid_t parent = getpid();
    fflush(NULL);
    const pid_t process = fresh.result >= 0 && fresh.said >= 0 ? fork() : -1;
    if (process == 0)
        run_child(&fresh, c->memory, parent, work, context);
    if (process < 0) {
        const int why = errno;
        close(fresh.result);
        close(fresh.said);
        errno = why;
        return false;
    }
    *child = fresh;
    child->process = process;
    c->count++;
    return true;
}

/* Appends the last `most` bytes of a file to `out`. */
static void read_file_end(int file, size_t most, JoxText *out) {
    struct stat info;
    char bytes[1 << 14];
    off_t at = 0;
    if (fstat(file, &info) == 0 && info.st_size > (off_t)most)
        at = info.st_size - (off_t)most;
    for (ssize_t n; (n = pread(file, bytes, sizeof bytes, at)) > 0; at += n)
        jox_text_append(out, bytes, (size_t)n);
}

static void say_why(const Child *child, int status, char why[400]) {
    JoxText said = {0};
    read_file_end(child->said, 200, &said);
    if (said.data)
        jox_text_clean(said.data);
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        snprintf(why, 400, "it took the processor time that its process may");
    else if (WIFSIGNALED(status))
        snprintf(why, 400, "its process was ended by signal %d (%s)%s", WTERMSIG(status),
                 strsignal(WTERMSIG(status)),
                 WTERMSIG(status) == SIGKILL ? ", as systems that run out of memory end processes"
                                             : "");
    else if (WEXITSTATUS(status) == OUT_OF_MEMORY)
        snprintf(why, 400, "out of memory");
    else
        snprintf(why, 400, "its process ended with status %d", WEXITSTATUS(status));
    if (said.length)
        snprintf(why + strlen(why), 400 - strlen(why), ": %s", said.data);
    jox_text_free(&said);
}

bool jox_children_wait(JoxChildren *c, JoxChildEnd *end) {
    for (int w = 0; w < WAITS && c->count > 0; w++) {
        for (uint32_t k = 0; k < c->most; k++) {
            Child *child = &c->all[k];
            int status;
            /* Waits for each child by its id: the host program's other children are left alone. */
            if (!child->process || waitpid(child->process, &status, WNOHANG) != child->process)
                continue;
            *end = (JoxChildEnd){.job = child->job};
            end->good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
            end->killed = WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
            if (end->good)
                read_file_end(child->result, SIZE_MAX >> 1, &end->result);
            else
                say_why(child, status, end->why);
            close_child(c, child);
            return true;
        }
        if (usleep(WAIT_MS * 1000) != 0) /* interrupted */
            return false;
    }
    return false;
}

bool jox_children_do(JoxChildWork *work, void *context, JoxText *result, JoxText *why) {
    JoxChildren *c = jox_children_create(1);
    JoxChildEnd end = {.good = true};
    if (jox_children_start(c, 0, work, context))
        while (!jox_children_wait(c, &end))
            continue;
    else
        work(context, 0, result);
    if (end.good)
        jox_text_append(result, end.result.data ? end.result.data : "", end.result.length);
    else
        jox_text_add(why, end.why);
    jox_text_free(&end.result);
    jox_children_free(c);
    return end.good;
}
