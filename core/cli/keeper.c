/* While a scene runs, with threads, files of others are read by children of another process, which
   was begun before. It keeps the scene as it was vetted last, for its children to read files of. */
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
    pthread_mutex_t lock; /* one question at a time */
    pid_t process;
    int socket;
};

/* ---- the other process ---- */

typedef struct Kept {
    int socket;
    const JoSceneDef *def;
    JoxOverlay files; /* the scene was vetted with these; */
    JoScene *scene;   /* of them; NULL until it is needed */
} Kept;

static void to_nobody(void *context, const char *text) {
    (void)context;
    (void)text;
}

static void load(Kept *kept) {
    JoSceneDef def = *kept->def;
    def.threads = 1;
    def.dry = true;
    def.message = to_nobody;
    const JoxOverlay *before = jox_overlay_use(&kept->files);
    kept->scene = jo_scene_load(&def, NULL);
    jox_overlay_use(before);
}

/* What was read, and how that ended. */
static void answer(const Kept *kept, int end, const CliVetted *what) {
    const JoxText *why = &what->why;
    for (size_t f = 0; end >= 0 && f < what->files->count; f++)
        cli_send(kept->socket, CLI_FILE, what->files->files[f].path, what->files->files[f].text,
                 what->files->files[f].length);
    cli_send(kept->socket, end >= 0 ? (CliSent)end : CLI_ENDED, end >= 0 ? "" : what->file,
             end >= 0 ? "" : why->data, end >= 0 ? 0 : why->length);
}

static void end_vetted(CliVetted *what) {
    jox_overlay_free(what->files);
    jox_text_free(&what->said);
    jox_text_free(&what->why);
}

static void read_whole(Kept *kept) {
    JoxOverlay fresh = {0};
    CliVetted what = {.def = kept->def, .stop = kept->socket, .files = &fresh};
    const int end = cli_read_confined(&what);
    answer(kept, end, &what);
    if (end == CLI_LOADED) {
        const JoxOverlay before = kept->files;
        kept->files = fresh;
        fresh = before;
        jo_scene_free(kept->scene);
        kept->scene = NULL;
    }
    end_vetted(&what);
}

/* `text`: the behaviours' paths, each with a zero byte; `name`: whether the scene was edited, too.
 */
static void read_edited(Kept *kept, const CliGot *asked) {
    const char *paths[1000];
    JoxOverlay fresh = {0};
    JoVetting edited = {.behaviours = paths, .scene = *asked->name, .stop = -1};
    for (size_t at = 0; at < asked->length && edited.behaviour_count < 1000;
         at += strlen(asked->text + at) + 1)
        paths[edited.behaviour_count++] = asked->text + at;
    if (!kept->scene)
        load(kept);
    CliVetted what = {.def = kept->def,
                      .edited = &edited,
                      .scene = kept->scene,
                      .stop = kept->socket,
                      .files = &fresh};
    if (!kept->scene)
        jox_text_add(&what.why, "the scene as it was cannot be read once more");
    answer(kept, kept->scene ? cli_read_confined(&what) : -1, &what);
    end_vetted(&what);
}

/* Does what it is asked for until nobody asks any more; does not return. */
static void keep(int socket, const JoSceneDef *def, const JoxOverlay *files) {
    Kept kept = {.socket = socket, .def = def, .files = *files};
    JoxRecovery recovery;
    CliGot asked;
    int kind;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    signal(SIGINT, SIG_IGN); /* Ctrl-C is for the other, which ends this one */
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
        kind = cli_get(&source, &asked);
        if (kind < 0)
            _exit(JO_OK);
        if (kind == CLI_WHOLE)
            read_whole(&kept);
        else if (kind == CLI_EDITED)
            read_edited(&kept, &asked);
        cli_got_free(&asked); /* CLI_STOP comes too late */
    }
}

/* ---- this one ---- */

static bool ask(const CliKeeper *keeper, const JoVetting *what) {
    JoxText paths = {0};
    for (size_t b = 0; b < what->behaviour_count; b++)
        jox_text_append(&paths, what->behaviours[b], strlen(what->behaviours[b]) + 1);
    const bool sent = what->whole ? cli_send(keeper->socket, CLI_WHOLE, "", "", 0)
                                  : cli_send(keeper->socket, CLI_EDITED, what->scene ? "scene" : "",
                                             paths.data ? paths.data : "", paths.length);
    jox_text_free(&paths);
    return sent;
}

/* Waits for an answer; false, and it is told so, once it is no longer wanted. */
static bool is_wanted(const CliKeeper *keeper, const JoVetting *what) {
    struct pollfd fds[2] = {{.fd = keeper->socket, .events = POLLIN},
                            {.fd = what->stop, .events = POLLIN}};
    while (poll(fds, what->stop >= 0 ? 2 : 1, -1) < 0 && errno == EINTR)
        continue;
    if (what->stop >= 0 && fds[1].revents)
        return !cli_send(keeper->socket, CLI_STOP, "", "", 0);
    return true;
}

/* As JoVetter.vet: what comes is whole, or was given up. */
static bool hear(const CliKeeper *keeper, JoVetting *what) {
    CliSource source = {.from = keeper->socket, .stop = -1};
    bool wanted = true;
    for (;;) {
        CliGot got;
        wanted = wanted && is_wanted(keeper, what);
        const int kind = cli_get(&source, &got);
        if (kind == CLI_FILE)
            what->read(what->read_context, got.name, got.text, got.length);
        else if (kind == CLI_ENDED) {
            snprintf(what->file, sizeof what->file, "%s", got.name);
            snprintf(what->why, sizeof what->why, "%s", got.text);
        } else if (kind < 0) {
            snprintf(what->why, sizeof what->why,
                     "the process that has edited files read is gone; begin the run anew");
        }
        cli_got_free(&got);
        if (kind != CLI_FILE)
            return kind == CLI_LOADED || kind == CLI_REFUSED;
    }
}

static bool vet(void *context, JoVetting *what) {
    CliKeeper *keeper = context;
    pthread_mutex_lock(&keeper->lock);
    const bool asked = ask(keeper, what), heard = asked && hear(keeper, what);
    pthread_mutex_unlock(&keeper->lock);
    if (!asked)
        snprintf(what->why, sizeof what->why,
                 "the process that has edited files read is gone; begin the run anew");
    if (!*what->file && what->behaviour_count)
        snprintf(what->file, sizeof what->file, "%s", what->behaviours[0]);
    return heard;
}

CliKeeper *cli_keeper_begin(const CliCommand *command, const JoSceneDef *def,
                            const JoxOverlay *files) {
    int ends[2];
    fflush(NULL);
    const bool good = socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0;
    const pid_t process = good ? fork() : -1;
    if (process == 0) {
        close(ends[0]);
        keep(ends[1], def, files);
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
    keeper->vetter = (JoVetter){.vet = vet,
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
