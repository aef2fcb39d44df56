/* A live page served on another thread, and a client that plays the browser. */
#ifndef JOX_TESTS_LIVE_SESSION_H
#define JOX_TESTS_LIVE_SESSION_H

#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/stat.h>

#include <cmocka.h>

#include "base/text.h"
#include "jostle_tools.h"
#include "unit/test_folder.h"
#include "unit/view_client.h"

static const char SCENE[] =
    "jostle: 1\n"
    "seed: 3\n"
    "duration: 1000\n"
    "places:\n"
    "  yard: {polygon: [[0, 0], [20, 0], [20, 20], [0, 20]]}\n"
    "walls:\n"
    "  - {line: [[0, 10], [20, 10]], name: gate}\n"
    "view: {tools: [gates, parameters, signals]}\n"
    "groups: {people: {behaviour: walker.lua, count: 30, fill: grid, in: yard}}\n";
static const char WALKER[] =
    "return machine { name = \"walker\", version = 1, start = \"Stand\",\n"
    "  defaults = { speed = 1.2 },\n"
    "  states = {\n"
    "    Stand = { steer = hold, { to = \"Walk\", when = heard \"go\" } },\n"
    "    Walk = { steer = away_from \"yard\" },\n"
    "  },\n"
    "}\n";

static int make_session_folder(void **state) {
    if (make_test_folder(state) != 0)
        return -1;
    write_test_file("index.html", "page");
    return 0;
}

/* ---- the session ---- */

typedef struct Session {
    pthread_t thread;
    JoViewDef def;
    volatile int stop;
    pthread_mutex_t lock;
    pthread_cond_t opened;
    char address[256];
    JoxText said; /* under the lock */
    char *summary;
    bool good, done;
    JoError error;
    int fd;
} Session;

static Session session;

static void keep_session_address(void *context, const char *address) {
    Session *s = context;
    pthread_mutex_lock(&s->lock);
    snprintf(s->address, sizeof s->address, "%s", address);
    pthread_cond_signal(&s->opened);
    pthread_mutex_unlock(&s->lock);
}

static void keep_session_message(void *context, const char *text) {
    Session *s = context;
    pthread_mutex_lock(&s->lock);
    jox_text_add(&s->said, text);
    pthread_mutex_unlock(&s->lock);
}

static void *run_session(void *context) {
    Session *s = context;
    s->good = jo_view(&s->def, &s->error);
    pthread_mutex_lock(&s->lock);
    s->done = true;
    pthread_cond_signal(&s->opened);
    pthread_mutex_unlock(&s->lock);
    return NULL;
}

/* Starts a session of the folder's scene.yaml; `seconds`: as in JoViewDef. */
static inline void begin_session(double seconds) {
    session = (Session){.def = jo_default_view_def(),
                        .lock = PTHREAD_MUTEX_INITIALIZER,
                        .opened = PTHREAD_COND_INITIALIZER};
    JoViewDef *def = &session.def;
    def->scene.path = test_path("scene.yaml");
    def->scene.message = keep_session_message;
    def->scene.message_context = &session;
    def->scene.named_mods_only = true;
    def->page = test_folder;
    def->log_input = test_path("log.txt");
    def->seconds = seconds;
    def->stop = &session.stop;
    def->opened = keep_session_address;
    def->opened_context = &session;
    def->summary = &session.summary;
    assert_int_equal(pthread_create(&session.thread, NULL, run_session, &session), 0);
    pthread_mutex_lock(&session.lock);
    while (!*session.address && !session.done)
        pthread_cond_wait(&session.opened, &session.lock);
    pthread_mutex_unlock(&session.lock);
}

static inline void join_session(void) {
    int port;
    char token[64];
    if (session.done)
        fail_msg("%s", session.error.text);
    assert_int_equal(sscanf(session.address, "http://127.0.0.1:%d/?token=%63s", &port, token), 2);
    session.fd = open_socket(port, token);
    assert_true(session.fd >= 0);
}

static inline void end_session(void) {
    if (session.fd > 0)
        close(session.fd);
    __atomic_store_n(&session.stop, 1, __ATOMIC_RELAXED);
    pthread_join(session.thread, NULL);
    jox_text_free(&session.said);
}

static void send_command(const char *format, ...) {
    char text[2048];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    assert_true(put_text(session.fd, text));
}

/* Waits up to 20 s for a JSON message that has both texts (`second` may be NULL), and returns
   it. */
static char last[1 << 20];
static inline const char *wait_for_json(const char *first, const char *second) {
    for (double until = clock_now() + 20.0; clock_now() < until;) {
        int kind;
        size_t length;
        char *message = get_message(session.fd, &kind, &length, until - clock_now());
        if (!message)
            break;
        bool found =
            kind == FRAME_TEXT && strstr(message, first) && (!second || strstr(message, second));
        if (kind == FRAME_TEXT && strstr(message, first)) /* kept for the message of a failure */
            snprintf(last, sizeof last, "%s", message);
        free(message);
        if (found)
            return last;
    }
    fail_msg("nothing came with %s and %s; the last was %.500s", first, second ? second : "", last);
    return NULL;
}

/* Waits up to 20 s for a frame and returns its tick. */
static inline uint32_t wait_for_tick(void) {
    for (double until = clock_now() + 20.0; clock_now() < until;) {
        int kind;
        size_t length;
        uint32_t head[2];
        char *message = get_message(session.fd, &kind, &length, until - clock_now());
        if (!message)
            break;
        memcpy(head, message, kind == FRAME_BINARY && length >= 8 ? sizeof head : 0);
        free(message);
        if (kind == FRAME_BINARY && length >= 8 && head[0] == 1)
            return head[1];
    }
    fail_msg("no frame came");
    return 0;
}

static double read_member(const char *json, const char *key) {
    char quoted[64];
    snprintf(quoted, sizeof quoted, "\"%s\": ", key);
    const char *at = strstr(json, quoted);
    if (!at)
        fail_msg("no %s in %.400s", key, json);
    return strtod(at + strlen(quoted), NULL);
}

#endif
