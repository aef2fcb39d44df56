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

enum { WAIT_MS = 20, WAITS = 10, OUT_OF_MEMORY = 99 };

typedef struct Child {
    uint64_t job;
    pid_t process; /* 0: none */
    int result, said;
} Child;

struct JoxChildren {
    Child *all;
    uint32_t most, count;
    size_t memory; /* bytes that each may take besides what it has; 0: any */
};

static void forget(JoxChildren *c, Child *child) {
    close(child->result);
    close(child->said);
    *child = (Child){0};
    c->count--;
}

static void end_all(void *children) {
    JoxChildren *c = children;
    for (uint32_t k = 0; k < c->most; k++) {
        Child *child = &c->all[k];
        if (child->process == 0)
            continue;
        kill(child->process, SIGKILL);
        while (waitpid(child->process, NULL, 0) < 0 && errno == EINTR)
            continue;
        forget(c, child);
    }
}

JoxChildren *jox_children_create(uint32_t most) {
    JOX_ASSERT(most > 0);
    JoxChildren *c = jox_alloc(1, sizeof *c);
    c->all = jox_alloc(most, sizeof *c->all);
    c->most = most;
    c->memory = most > 1 ? jox_confine_memory_left() / most : 0;
    return jox_hold(c, end_all);
}

void jox_children_free(JoxChildren *c) {
    if (!c)
        return;
    jox_let_go(c);
    end_all(c);
    jox_free(c->all);
    jox_free(c);
}

bool jox_children_has_room(const JoxChildren *c) {
    return c->count < c->most;
}

uint32_t jox_children_count(const JoxChildren *c) {
    return c->count;
}

/* Does not return. */
static void work_on(const Child *child, size_t memory, pid_t parent, JoxChildWork *work,
                    void *context) {
    JoxRecovery recovery;
    JoxText result = {0};
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) /* which has ended meanwhile */
        _exit(1);
    signal(SIGINT, SIG_IGN); /* Ctrl-C is for the parent, which ends its children */
    signal(SIGHUP, SIG_IGN);
    signal(SIGTERM, SIG_DFL);
    signal(SIGXCPU, SIG_DFL); /* it has no files to finish */
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
    _exit(good ? 0 : 1); /* nothing that it shares with the parent is ended twice */
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
        work_on(&fresh, c->memory, parent, work, context);
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

/* What a file in memory holds, or the last `most` bytes of it. */
static void read_all(int file, size_t most, JoxText *out) {
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
    read_all(child->said, 200, &said);
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
            /* The program's other processes are not waited for. */
            if (!child->process || waitpid(child->process, &status, WNOHANG) != child->process)
                continue;
            *end = (JoxChildEnd){.job = child->job};
            end->good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
            if (end->good)
                read_all(child->result, SIZE_MAX >> 1, &end->result);
            else
                say_why(child, status, end->why);
            forget(c, child);
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
