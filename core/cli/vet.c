/* Files of others are read first by a child that could do no harm if they took it over, and are
   loaded from what it read. */
#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/file.h"
#include "base/mem.h"
#include "base/text.h"
#include "cli/cli.h"

enum { SECONDS = 20 };               /* of processor time */
static const double LONGEST = 600.0; /* s that a child is waited for: it may sleep */
static const size_t MEMORY = (size_t)2 << 30, LARGEST = (size_t)512 << 20;

/* ---- what goes through the pipe ---- */

bool cli_send(int out, CliSent kind, const char *name, const char *text, size_t length) {
    const CliHead head = {.kind = kind, .name = strlen(name), .text = length};
    return jox_file_send(out, &head, sizeof head) && jox_file_send(out, name, head.name) &&
           jox_file_send(out, text, length);
}

/* Whether there is more to read, or the end, before it is to stop. */
static bool await(CliSource *source) {
    while (!source->fault) {
        const double left = source->until > 0.0 ? source->until - jox_clock_wall() : 1e6;
        struct pollfd fds[2] = {{.fd = source->from, .events = POLLIN},
                                {.fd = source->stop, .events = POLLIN}};
        const int ready = poll(fds, source->stop >= 0 ? 2 : 1, left > 0.0 ? (int)(left * 1e3) : 0);
        if (source->stop >= 0 && ready > 0 && fds[1].revents)
            source->fault = "is no longer wanted";
        else if (ready > 0)
            return true;
        else if (ready == 0 && left <= 0.0)
            source->fault = "takes longer than it may";
        else if (ready < 0 && errno != EINTR)
            source->fault = strerror(errno);
    }
    return false;
}

static bool get(CliSource *source, void *bytes, size_t count) {
    for (char *at = bytes; count > 0;) {
        if (!await(source))
            return false;
        const ssize_t done = read(source->from, at, count);
        if (done == 0 || (done < 0 && errno != EINTR))
            return false;
        at += done > 0 ? done : 0;
        count -= done > 0 ? (size_t)done : 0;
    }
    return true;
}

int cli_get(CliSource *source, CliGot *got) {
    CliHead head;
    *got = (CliGot){0};
    if (!get(source, &head, sizeof head))
        return -1;
    source->taken += head.name + head.text;
    if (head.kind >= CLI_SENT_COUNT || head.name >= sizeof got->name || head.text > LARGEST ||
        source->taken > LARGEST) {
        source->fault = "reads more than it may";
        return -1;
    }
    got->text = jox_alloc(head.text + 1, 1);
    got->length = head.text;
    if (get(source, got->name, head.name) && get(source, got->text, head.text))
        return (int)head.kind;
    cli_got_free(got);
    return -1;
}

void cli_got_free(CliGot *got) {
    jox_free(got->text);
    got->text = NULL;
}

/* ---- the child ---- */

static void send_file(void *context, const char *path, const char *text, size_t length) {
    if (!cli_send(*(const int *)context, CLI_FILE, path, text, length))
        _exit(JO_FAILED);
}

static void send_message(void *context, const char *text) {
    if (!cli_send(*(const int *)context, CLI_MESSAGE, "", text, strlen(text)))
        _exit(JO_FAILED);
}

/* Reads and compiles, and says what it read; does not return. */
static void read_it(const CliVetted *what, int out) {
    JoError error = {0};
    JoSceneDef def = *what->def;
    def.threads = 1;
    def.dry = true;
    def.message = send_message;
    def.message_context = &out;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    signal(SIGINT, what->edited ? SIG_IGN : SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    if (what->edited)
        signal(SIGHUP, SIG_IGN);
    else if (signal(SIGHUP, SIG_DFL) == SIG_IGN)
        signal(SIGHUP, SIG_IGN);
    CliReach reach = {.memory = MEMORY, .seconds = SECONDS};
    cli_reach_def(&reach, &def);
    cli_confine(&reach);
    const JoxOverlay overlay = {.told = send_file, .context = &out};
    jox_overlay_use(&overlay);
    CliSent end = CLI_LOADED;
    if (what->edited)
        end = jo_scene_try(what->scene, what->edited) ? CLI_LOADED : CLI_OUT_OF_MEMORY;
    else if (!jo_scene_load(&def, &error))
        end = error.code == JO_FAILED ? CLI_OUT_OF_MEMORY : CLI_REFUSED;
    cli_send(out, end, "", "", 0);
    _exit(JO_OK); /* nothing of the program's that it shares with the child is ended twice */
}

/* ---- the parent ---- */

/* Takes what the child sends up to its end, which is returned; -1 where it ends without. */
static int receive(CliVetted *what, CliSource *source) {
    for (;;) {
        CliGot got;
        const int kind = cli_get(source, &got);
        if (kind == CLI_FILE)
            jox_overlay_put(what->files, got.name, got.text, got.length);
        else if (kind == CLI_MESSAGE)
            jox_text_append(&what->said, got.text, got.length);
        else if (kind > CLI_OUT_OF_MEMORY)
            source->fault = "sends what it should not";
        cli_got_free(&got);
        if (kind != CLI_FILE && kind != CLI_MESSAGE)
            return source->fault ? -1 : kind;
    }
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

/* The system counts a limit by its ticks, and tells times by clocks: where processors are shared
   with others, a process may be ended for its time at nine tenths of it and less. */
static const double LATE = 0.75;

/* Says at which file the child ended, and why. A process ends by SIGKILL at its last second, too,
   which its times tell from a kill. */
static void say_ended(CliVetted *what, int end, int status, const struct rusage *usage,
                      const char *fault) {
    const JoxOverlay *files = what->files;
    const char *file = files->count                           ? files->files[files->count - 1].path
                       : what->edited && !what->edited->scene ? what->edited->behaviours[0]
                                                              : what->def->path;
    const int number = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    const bool late = used(usage) > LATE * allowed();
    JoxText *why = &what->why;
    snprintf(what->file, sizeof what->file, "%s", file);
    jox_text_printf(why, "reading this %s ", what->edited ? "file" : "scene");
    if (end == CLI_OUT_OF_MEMORY)
        jox_text_printf(why, "takes more memory than there is for it (%zu MB at most)",
                        MEMORY >> 20);
    else if (fault)
        jox_text_add(why, fault);
    else if (number == SIGXCPU || (number == SIGKILL && late))
        jox_text_printf(why, "takes more processor time than it may (%g s)", allowed());
    else if (number == SIGKILL)
        jox_text_printf(
            why, "was ended from outside, as systems that run out of memory do (it had %ld MB)",
            usage->ru_maxrss >> 10);
    else if (number == SIGINT || number == SIGTERM || number == SIGHUP)
        jox_text_add(why, "was interrupted");
    else if (number == SIGSYS)
        jox_text_add(why, "tried to start a program or to reach the network");
    else if (number)
        jox_text_printf(why, "broke the process that read it (%s); please report it",
                        strsignal(number));
    else
        jox_text_add(why, "ended the process that read it; please report it");
}

/* There is no child. */
static int say_none(CliVetted *what) {
    jox_text_printf(&what->why, "no process to read it in: %s", strerror(errno));
    snprintf(what->file, sizeof what->file, "%s", what->def->path);
    return -2;
}

int cli_read_confined(CliVetted *what) {
    int ends[2], status = 0;
    struct rusage usage = {0};
    fflush(NULL);
    what->files->sealed = true;
    if (pipe(ends) != 0)
        return say_none(what);
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        read_it(what, ends[1]);
    }
    const int why = errno;
    CliSource source = {.from = ends[0], .stop = what->stop, .until = jox_clock_wall() + LONGEST};
    close(ends[1]);
    const int end = child > 0 ? receive(what, &source) : -1;
    close(ends[0]); /* a child that sends on ends by it */
    errno = why;
    if (child < 0)
        return say_none(what);
    if (source.fault)
        kill(child, SIGKILL);
    while (wait4(child, &status, 0, &usage) < 0 && errno == EINTR)
        continue;
    if (end == CLI_LOADED || end == CLI_REFUSED)
        return end;
    say_ended(what, end, status, &usage, source.fault);
    return -1;
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

/* The first of what was said, but for what stands below it: the lines of the file. */
static void put_first(const JoxText *said, JoError *error) {
    const char *text = said->data ? said->data : "see what was said above";
    snprintf(error->text, sizeof error->text, "%.*s", (int)strcspn(text, "\n"), text);
}

int cli_vet(const CliCommand *command, const JoSceneDef *def, JoxOverlay *files, JoError *error) {
    CliVetted what = {.def = def, .files = files, .stop = -1};
    const int end = cli_read_confined(&what);
    if (end == CLI_REFUSED && what.said.data)
        tell_refused(command, &what.said);
    else if (end < 0)
        fprintf(stderr, "jostle %s: %s: error: %s\n", command->name, what.file, what.why.data);
    const int result = end == CLI_LOADED ? JO_OK : end == -2 ? JO_FAILED : JO_INPUT;
    if (error && result != JO_OK) {
        error->code = (JoCode)result;
        put_first(end < 0 ? &what.why : &what.said, error);
    }
    jox_text_free(&what.said);
    jox_text_free(&what.why);
    return result;
}
