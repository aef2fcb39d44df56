/* Scenes of others are read first by a child that could do no harm if they took it over, and are
   loaded from what it read. */
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/format/path.h"
#include "base/mem.h"
#include "base/text.h"
#include "cli/cli.h"

enum { SECONDS = 20 };
static const size_t MEMORY = (size_t)2 << 30, LARGEST = (size_t)512 << 20;

/* What the child sends: a head, then so many bytes of a name and of a text. */
typedef enum Kind { READ_FILE, MESSAGE, LOADED, REFUSED, OUT_OF_MEMORY } Kind;
typedef struct Head {
    uint32_t kind;
    uint64_t name, text;
} Head;

/* ---- the child ---- */

typedef struct Child {
    int out;
} Child;

static void put(const Child *child, const void *bytes, size_t count) {
    for (const char *at = bytes; count > 0;) {
        const ssize_t done = write(child->out, at, count);
        if (done < 0 && errno != EINTR)
            _exit(JO_FAILED);
        at += done > 0 ? done : 0;
        count -= done > 0 ? (size_t)done : 0;
    }
}

static void send_it(const Child *child, Kind kind, const char *name, const char *text,
                    size_t length) {
    const Head head = {.kind = kind, .name = strlen(name), .text = length};
    put(child, &head, sizeof head);
    put(child, name, head.name);
    put(child, text, length);
}

static void send_file(void *context, const char *path, const char *text, size_t length) {
    send_it(context, READ_FILE, path, text, length);
}

static void send_message(void *context, const char *text) {
    send_it(context, MESSAGE, "", text, strlen(text));
}

/* Reads and compiles, and says what it read; does not return. */
static void read_it(const JoSceneDef *given, int out) {
    Child child = {out};
    JoError error = {0};
    JoSceneDef def = *given;
    def.threads = 1;
    def.dry = true;
    def.message = send_message;
    def.message_context = &child;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    CliReach reach = {.memory = MEMORY, .seconds = SECONDS};
    cli_reach_def(&reach, &def);
    cli_confine(&reach);
    const JoxOverlay overlay = {.told = send_file, .context = &child};
    jox_overlay_use(&overlay);
    JoScene *scene = jo_scene_load(&def, &error);
    const Kind end = scene ? LOADED : error.code == JO_FAILED ? OUT_OF_MEMORY : REFUSED;
    send_it(&child, end, "", "", 0);
    _exit(JO_OK); /* nothing of the program's that it shares with the child is ended twice */
}

/* ---- the parent ---- */

typedef struct Parent {
    const CliCommand *command;
    const char *scene;
    JoxOverlay *files;
    JoxText said;
    size_t taken; /* bytes */
} Parent;

static bool get(int from, void *bytes, size_t count) {
    for (char *at = bytes; count > 0;) {
        const ssize_t done = read(from, at, count);
        if (done == 0 || (done < 0 && errno != EINTR))
            return false;
        at += done > 0 ? done : 0;
        count -= done > 0 ? (size_t)done : 0;
    }
    return true;
}

/* Takes what the child sends up to its end, which is returned; -1 where it ends without. */
static int receive(Parent *parent, int from) {
    Head head;
    while (get(from, &head, sizeof head)) {
        if (head.kind > OUT_OF_MEMORY || head.name >= JOX_LONGEST_PATH || head.text > LARGEST ||
            (parent->taken += head.name + head.text) > LARGEST)
            return -1;
        if (head.kind >= LOADED)
            return (int)head.kind;
        char *name = jox_alloc(head.name + 1, 1), *text = jox_alloc(head.text + 1, 1);
        const bool whole = get(from, name, head.name) && get(from, text, head.text);
        if (whole && head.kind == READ_FILE)
            jox_overlay_put(parent->files, name, text, head.text);
        else if (whole)
            jox_text_append(&parent->said, text, head.text);
        jox_free(name);
        jox_free(text);
        if (!whole)
            return -1;
    }
    return -1;
}

/* Seconds of processor time that the child has: this process may be held to fewer. */
static double allowed(void) {
    struct rlimit own;
    const bool fewer = getrlimit(RLIMIT_CPU, &own) == 0 && own.rlim_max < SECONDS;
    return fewer ? (double)own.rlim_max : SECONDS;
}

static double used(const struct rusage *usage) {
    const struct timeval user = usage->ru_utime, system = usage->ru_stime;
    return (double)(user.tv_sec + system.tv_sec) + 1e-6 * (double)(user.tv_usec + system.tv_usec);
}

/* Says at which file the child ended, and why. A process ends by SIGKILL at its last second, too,
   which its times tell from a kill. */
static int ended(const Parent *parent, int end, int status, const struct rusage *usage) {
    const JoxOverlay *files = parent->files;
    const char *file = files->count ? files->files[files->count - 1].path : parent->scene;
    const int number = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    const bool late = used(usage) > 0.95 * allowed();
    fprintf(stderr, "jostle %s: %s: error: reading this scene ", parent->command->name, file);
    if (end == OUT_OF_MEMORY)
        fprintf(stderr, "takes more memory than there is for it (%zu MB at most)\n", MEMORY >> 20);
    else if (number == SIGXCPU || (number == SIGKILL && late))
        fprintf(stderr, "takes more processor time than it may (%g s)\n", allowed());
    else if (number == SIGKILL)
        fprintf(stderr,
                "was ended from outside, as systems that run out of memory do (it had %ld MB)\n",
                usage->ru_maxrss >> 10);
    else if (number == SIGSYS)
        fputs("tried to start a program or to reach the network\n", stderr);
    else if (number)
        fprintf(stderr, "broke the process that read it (%s); please report it\n",
                strsignal(number));
    else
        fprintf(stderr, "ended the process that read it; please report it\n");
    return JO_INPUT;
}

/* What the child said; and how files are read that lie where it may not look. */
static void tell_refused(const CliCommand *command, const JoxText *said) {
    fputs(said->data, stderr);
    if (strstr(said->data, strerror(EACCES)))
        fprintf(stderr,
                "jostle %s: of a scene, files in its folder, in ../behaviours, ../scripts and of "
                "mods are "
                "read; with --trusted, files anywhere are\n",
                command->name);
}

static int wait_for(pid_t child, struct rusage *usage) {
    int status = 0;
    while (wait4(child, &status, 0, usage) < 0 && errno == EINTR)
        continue;
    return status;
}

/* The first of what was said, but for what stands below it: the lines of the file. */
static void put_first(const JoxText *said, JoError *error) {
    const char *text = said->data ? said->data : "see what was said above";
    snprintf(error->text, sizeof error->text, "%.*s", (int)strcspn(text, "\n"), text);
}

int cli_vet(const CliCommand *command, const JoSceneDef *def, JoxOverlay *files, JoError *error) {
    int ends[2];
    Parent parent = {.command = command, .scene = def->path, .files = files};
    fflush(NULL);
    if (pipe(ends) != 0) {
        fprintf(stderr, "jostle %s: %s\n", command->name, strerror(errno));
        return JO_FAILED;
    }
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        read_it(def, ends[1]);
    }
    close(ends[1]);
    const int end = child > 0 ? receive(&parent, ends[0]) : -1;
    close(ends[0]); /* a child that sends on ends by it */
    struct rusage usage = {0};
    const int status = child > 0 ? wait_for(child, &usage) : 0;
    if (child < 0)
        fprintf(stderr, "jostle %s: no process to read the scene in\n", command->name);
    if (end == REFUSED && parent.said.data)
        tell_refused(command, &parent.said);
    files->sealed = true;
    const int result = child < 0        ? JO_FAILED
                       : end == LOADED  ? JO_OK
                       : end == REFUSED ? JO_INPUT
                                        : ended(&parent, end, status, &usage);
    if (error && result != JO_OK) {
        error->code = (JoCode)result;
        put_first(&parent.said, error);
    }
    jox_text_free(&parent.said);
    return result;
}
