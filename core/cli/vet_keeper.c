/* The keeper: a process that reads edited files while a scene runs. A process with threads must not
   fork, so the keeper is forked before they start, and forks the confined children that read files.
   It keeps the scene as it was vetted last, as edited files are read on top of it. */
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <setjmp.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/mem.h"
#include "cli/cli.h"

struct CliKeeper {
    JoVetter vetter;
    pthread_mutex_t lock; /* one request at a time */
    pid_t process;
    int socket;
};

/* ---- in the keeper's process ---- */

typedef struct Kept {
    int socket;
    const JoSceneDef *def;
    JoxOverlay files; /* files with which the scene was vetted last */
    JoScene *scene;   /* loaded dry from these; NULL until needed */
} Kept;

static void ignore_message(void *context, const char *text) {
    (void)context;
    (void)text;
}

/* Loads the kept scene dry from its kept texts. */
static void load_kept_scene(Kept *kept, JoError *error) {
    JoSceneDef def = *kept->def;
    def.threads = 1;
    def.dry = true;
    def.message = ignore_message;
    const JoxOverlay *before = jox_overlay_use(&kept->files);
    kept->scene = jo_scene_load(&def, error);
    jox_overlay_use(before);
}

/* Answers a request: with the files that the child read and how it ended, or, if it was ended, at
   which file and why. */
static void send_answer(const Kept *kept, int end, const CliVetted *what) {
    if (end < 0) {
        cli_send(kept->socket, CLI_ENDED, what->file, what->why.data, what->why.length);
        return;
    }
    for (size_t f = 0; f < what->files->count; f++)
        cli_send(kept->socket, CLI_FILE, what->files->files[f].path, what->files->files[f].text,
                 what->files->files[f].length);
    cli_send(kept->socket, (CliSent)end, "", "", 0);
}

static void free_vetted(CliVetted *what) {
    jox_overlay_free(what->files);
    jox_text_free(&what->said);
    jox_text_free(&what->why);
}

/* Reads the whole scene in a child; if it loads, its files replace the kept ones. */
static void read_whole_scene(Kept *kept) {
    JoxOverlay fresh = {0};
    CliVetted what = {.def = kept->def, .stop = kept->socket, .files = &fresh};
    const int end = cli_read_confined(&what);
    send_answer(kept, end, &what);
    if (end == CLI_LOADED) {
        const JoxOverlay before = kept->files;
        kept->files = fresh;
        fresh = before;
        jo_scene_free(kept->scene);
        kept->scene = NULL;
    }
    free_vetted(&what);
}

/* Reads edited files in a child. The request's text has the paths of behaviours, each
   zero-terminated; its name is not empty if the scene's file was edited, too. */
static void read_edited_files(Kept *kept, const CliReceived *asked) {
    const char *paths[1000];
    JoxOverlay fresh = {0};
    JoVetting edited = {.behaviours = paths, .scene = *asked->name, .stop = -1};
    for (size_t at = 0; at < asked->length && edited.behaviour_count < 1000;
         at += strlen(asked->text + at) + 1)
        paths[edited.behaviour_count++] = asked->text + at;
    JoError error = {0};
    if (!kept->scene)
        load_kept_scene(kept, &error);
    CliVetted what = {.def = kept->def,
                      .edited = &edited,
                      .scene = kept->scene,
                      .stop = kept->socket,
                      .files = &fresh};
    if (!kept->scene)
        jox_text_printf(&what.why, "the scene as it was cannot be read once more: %s", error.text);
    send_answer(kept, kept->scene ? cli_read_confined(&what) : -1, &what);
    free_vetted(&what);
}

/* Serves requests until the socket is closed; does not return. */
static void serve_requests(int socket, const JoSceneDef *def, const JoxOverlay *files) {
    Kept kept = {.socket = socket, .def = def, .files = *files};
    JoxRecovery recovery;
    CliReceived asked;
    int kind;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    signal(SIGINT, SIG_IGN); /* Ctrl-C also reaches the parent, which kills the keeper */
    signal(SIGHUP, SIG_IGN);
    signal(SIGTERM, SIG_DFL);
    const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
    for (int standard = 0; standard < 3; standard++)
        dup2(nothing, standard);
    jox_heap_use(NULL);
    jox_recovery_push(&recovery);
    if (setjmp(recovery.jump) != 0)
        _exit(JO_FAILED);
    for (;;) {
        CliSource source = {.from = socket, .stop = -1};
        kind = cli_receive(&source, &asked);
        if (kind < 0)
            _exit(JO_OK);
        if (kind == CLI_WHOLE)
            read_whole_scene(&kept);
        else if (kind == CLI_EDITED)
            read_edited_files(&kept, &asked);
        cli_free_received(&asked); /* CLI_STOP here is too late, and ignored */
    }
}

/* ---- in the parent ---- */

/* Sends a request to the keeper; false if it is gone. */
static bool send_vetting_request(const CliKeeper *keeper, const JoVetting *what) {
    JoxText paths = {0};
    for (size_t b = 0; b < what->behaviour_count; b++)
        jox_text_append(&paths, what->behaviours[b], strlen(what->behaviours[b]) + 1);
    const bool sent = what->whole ? cli_send(keeper->socket, CLI_WHOLE, "", "", 0)
                                  : cli_send(keeper->socket, CLI_EDITED, what->scene ? "scene" : "",
                                             paths.data ? paths.data : "", paths.length);
    jox_text_free(&paths);
    return sent;
}

/* Waits for an answer. Returns false, after telling the keeper, once the answer is no longer
   wanted. */
static bool wait_for_answer(const CliKeeper *keeper, const JoVetting *what) {
    struct pollfd fds[2] = {{.fd = keeper->socket, .events = POLLIN},
                            {.fd = what->stop, .events = POLLIN}};
    while (poll(fds, what->stop >= 0 ? 2 : 1, -1) < 0 && errno == EINTR)
        continue;
    if (what->stop >= 0 && fds[1].revents)
        return !cli_send(keeper->socket, CLI_STOP, "", "", 0);
    return true;
}

/* Receives the answer to a request; returns as JoVetter.vet does, without a reason if the keeper is
   gone. */
static bool receive_answer(const CliKeeper *keeper, JoVetting *what) {
    CliSource source = {.from = keeper->socket, .stop = -1};
    bool wanted = true;
    for (;;) {
        CliReceived got;
        wanted = wanted && wait_for_answer(keeper, what);
        const int kind = cli_receive(&source, &got);
        if (kind == CLI_FILE)
            what->read(what->read_context, got.name, got.text, got.length);
        else if (kind == CLI_ENDED) {
            snprintf(what->file, sizeof what->file, "%s", got.name);
            snprintf(what->why, sizeof what->why, "%s", got.text);
        }
        cli_free_received(&got);
        if (kind != CLI_FILE)
            return kind == CLI_LOADED || kind == CLI_REFUSED;
    }
}

static bool ask_keeper(void *context, JoVetting *what) {
    CliKeeper *keeper = context;
    pthread_mutex_lock(&keeper->lock);
    const bool read = send_vetting_request(keeper, what) && receive_answer(keeper, what);
    pthread_mutex_unlock(&keeper->lock);
    if (!read && !*what->why)
        snprintf(what->why, sizeof what->why,
                 "the process that has edited files read is gone; begin the run anew");
    if (!*what->file && what->behaviour_count)
        snprintf(what->file, sizeof what->file, "%s", what->behaviours[0]);
    return read;
}

CliKeeper *cli_keeper_begin(const CliCommand *command, const JoSceneDef *def,
                            const JoxOverlay *files) {
    int ends[2];
    fflush(NULL);
    const bool good = socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0;
    const pid_t process = good ? fork() : -1;
    if (process == 0) {
        close(ends[0]);
        serve_requests(ends[1], def, files);
    }
    const int why = errno;
    if (good)
        close(ends[1]);
    if (process < 0) {
        if (good)
            close(ends[0]);
        fprintf(stderr,
                "jostle %s: no process to have edited files read: %s; --no-watch does without\n",
                command->name, strerror(why));
        return NULL;
    }
    CliKeeper *keeper = jox_alloc(1, sizeof *keeper);
    keeper->vetter = (JoVetter){.vet = ask_keeper,
                                .context = keeper,
                                .trust = "With --trusted it would be read by the run itself"};
    pthread_mutex_init(&keeper->lock, NULL);
    keeper->process = process;
    keeper->socket = ends[0];
    return keeper;
}

const JoVetter *cli_keeper_vetter(const CliKeeper *keeper) {
    return keeper ? &keeper->vetter : NULL;
}

void cli_keeper_end(CliKeeper *keeper) {
    if (!keeper)
        return;
    close(keeper->socket);
    kill(keeper->process, SIGKILL);
    while (waitpid(keeper->process, NULL, 0) < 0 && errno == EINTR)
        continue;
    pthread_mutex_destroy(&keeper->lock);
    jox_free(keeper);
}
