/* Reads files of unknown origin in a confined child process, which could do no harm if a file took
   it over. The scene is then loaded from the texts that the child read. */
#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
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

enum { SECONDS = 20 };                           /* s of processor time for the child */
static const double LONGEST = 600.0;             /* s of wall time for the child */
static const size_t MEMORY = (size_t)2 << 30;    /* bytes of memory for the child */
static const size_t LARGEST = (size_t)512 << 20; /* bytes of messages that it may send */

/* ---- messages ---- */

bool cli_send(int out, CliSent kind, const char *name, const char *text, size_t length) {
    const CliHead head = {.kind = kind, .name = strlen(name), .text = length};
    return jox_file_send(out, &head, sizeof head) && jox_file_send(out, name, head.name) &&
           jox_file_send(out, text, length);
}

/* Waits until there are data or the end to read; false if reading is to be given up. */
static bool await_data(CliSource *source) {
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

/* Receives exactly `count` bytes; false at the end of the data, or if reading is given up. */
static bool receive_bytes_of_child(CliSource *source, void *bytes, size_t count) {
    for (char *at = bytes; count > 0;) {
        if (!await_data(source))
            return false;
        const ssize_t done = read(source->from, at, count);
        if (done == 0 || (done < 0 && errno != EINTR))
            return false;
        at += done > 0 ? done : 0;
        count -= done > 0 ? (size_t)done : 0;
    }
    return true;
}

int cli_receive(CliSource *source, CliReceived *got) {
    CliHead head;
    *got = (CliReceived){0};
    if (!receive_bytes_of_child(source, &head, sizeof head))
        return -1;
    source->taken += head.name + head.text;
    if (head.kind >= CLI_SENT_COUNT || head.name >= sizeof got->name || head.text > LARGEST ||
        source->taken > LARGEST) {
        source->fault = "reads more than it may";
        return -1;
    }
    got->text = jox_alloc(head.text + 1, 1);
    got->length = head.text;
    if (receive_bytes_of_child(source, got->name, head.name) &&
        receive_bytes_of_child(source, got->text, head.text))
        return (int)head.kind;
    cli_free_received(got);
    return -1;
}

void cli_free_received(CliReceived *got) {
    jox_free(got->text);
    got->text = NULL;
}

/* ---- the child ---- */

static void send_file(void *context, const char *path, const char *text, size_t length) {
    if (!cli_send(*(const int *)context, CLI_FILE, path, text, length))
        _exit(JO_FAILED);
}

static void send_child_message(void *context, const char *text) {
    if (!cli_send(*(const int *)context, CLI_MESSAGE, "", text, strlen(text)))
        _exit(JO_FAILED);
}

/* Loads the scene dry, or the edited files, and sends every file that it reads; does not return. */
static void read_in_child(const CliVetted *what, int out) {
    JoError error = {0};
    JoSceneDef def = *what->def;
    def.threads = 1;
    def.dry = true;
    def.message = send_child_message;
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
    _exit(JO_OK); /* not exit(): it would flush and close what the parent also has */
}

/* ---- the parent ---- */

/* Receives the messages of the child; returns the last one, or -1 if it ended without. */
static int receive_all_messages(CliVetted *what, CliSource *source) {
    for (;;) {
        CliReceived got;
        const int kind = cli_receive(source, &got);
        if (kind == CLI_FILE)
            jox_overlay_put(what->files, got.name, got.text, got.length);
        else if (kind == CLI_MESSAGE)
            jox_text_append(&what->said, got.text, got.length);
        else if (kind > CLI_OUT_OF_MEMORY)
            source->fault = "sends what it should not";
        cli_free_received(&got);
        if (kind != CLI_FILE && kind != CLI_MESSAGE)
            return source->fault ? -1 : kind;
    }
}

/* Returns the child's processor time limit, s; that of this process may be lower. */
static double get_time_limit(void) {
    struct rlimit own;
    const bool fewer = getrlimit(RLIMIT_CPU, &own) == 0 && own.rlim_max < SECONDS;
    return fewer ? (double)own.rlim_max : SECONDS;
}

/* Returns the processor time that a process used, s. */
static double get_time_used(const struct rusage *usage) {
    const struct timeval user = usage->ru_utime, system = usage->ru_stime;
    return (double)(user.tv_sec + system.tv_sec) + 1e-6 * (double)(user.tv_usec + system.tv_usec);
}

/* Share of the limit from which a kill counts as its enforcement. The system enforces the limit by
   counting ticks but reports times by clocks; on shared processors the reported time may be nine
   tenths of the limit and less. */
static const double LATE = 0.75;

/* Describes at which file the child ended, and why. SIGKILL also enforces the processor time limit;
   the time used tells this from a kill. */
static void describe_end(CliVetted *what, int end, int status, const struct rusage *usage,
                         const char *fault) {
    const JoxOverlay *files = what->files;
    const char *file = files->count                           ? files->files[files->count - 1].path
                       : what->edited && !what->edited->scene ? what->edited->behaviours[0]
                                                              : what->def->path;
    const int number = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    const bool late = get_time_used(usage) > LATE * get_time_limit();
    JoxText *why = &what->why;
    snprintf(what->file, sizeof what->file, "%s", file);
    jox_text_printf(why, "reading this %s ", what->edited ? "file" : "scene");
    if (end == CLI_OUT_OF_MEMORY)
        jox_text_printf(why, "takes more memory than there is for it (%zu MB at most)",
                        MEMORY >> 20);
    else if (fault)
        jox_text_add(why, fault);
    else if (number == SIGXCPU || (number == SIGKILL && late))
        jox_text_printf(why, "takes more processor time than it may (%g s)", get_time_limit());
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

/* Describes why no child could be started; returns -2. */
static int describe_no_process(CliVetted *what) {
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
        return describe_no_process(what);
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        read_in_child(what, ends[1]);
    }
    const int why = errno;
    CliSource source = {.from = ends[0], .stop = what->stop, .until = jox_clock_wall() + LONGEST};
    close(ends[1]);
    const int end = child > 0 ? receive_all_messages(what, &source) : -1;
    close(ends[0]); /* a child that still sends ends by this */
    errno = why;
    if (child < 0)
        return describe_no_process(what);
    if (source.fault)
        kill(child, SIGKILL);
    while (wait4(child, &status, 0, &usage) < 0 && errno == EINTR)
        continue;
    if (end == CLI_LOADED || end == CLI_REFUSED)
        return end;
    describe_end(what, end, status, &usage, source.fault);
    return -1;
}

/* Prints the child's messages, and if a file was not accessible, which files are read. */
static void print_refused(const CliCommand *command, const JoxText *said) {
    fputs(said->data, stderr);
    if (strstr(said->data, strerror(EACCES)))
        fprintf(stderr,
                "jostle %s: of a scene, files in its folder, in ../behaviours, ../scripts and of "
                "mods are "
                "read; with --trusted, files anywhere are\n",
                command->name);
}

/* Copies the first line of the messages into `error`; the lines below it quote the file. */
static void copy_first_line(const JoxText *said, JoError *error) {
    const char *text = said->data ? said->data : "see what was said above";
    snprintf(error->text, sizeof error->text, "%.*s", (int)strcspn(text, "\n"), text);
}

int cli_vet(const CliCommand *command, const JoSceneDef *def, JoxOverlay *files, JoError *error) {
    CliVetted what = {.def = def, .files = files, .stop = -1};
    const int end = cli_read_confined(&what);
    if (end == CLI_REFUSED && what.said.data)
        print_refused(command, &what.said);
    else if (end < 0)
        fprintf(stderr, "jostle %s: %s: error: %s\n", command->name, what.file, what.why.data);
    const int result = end == CLI_LOADED ? JO_OK : end == -2 ? JO_FAILED : JO_INPUT;
    if (error && result != JO_OK) {
        error->code = (JoCode)result;
        copy_first_line(end < 0 ? &what.why : &what.said, error);
    }
    jox_text_free(&what.said);
    jox_text_free(&what.why);
    return result;
}
