/* The live page of a recording, driven by a client: plays, pauses, steps and seeks. */
#include "live_recording.h"

#include <pthread.h>

#include "view_client.h"

static char address[300];
static volatile int stop;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

static void keep_page_address(void *context, const char *text) {
    (void)context;
    pthread_mutex_lock(&lock);
    snprintf(address, sizeof address, "%s", text);
    pthread_mutex_unlock(&lock);
}

static void *serve_recording(void *context) {
    const JoViewRecordingDef *def = context;
    JoError error = {0};
    bool good = jo_view_recording(def, &error);
    if (!good)
        print_message("%s\n", error.text);
    return good ? context : NULL;
}

/* Waits for the next JSON message of a type, or for a frame if `type` is NULL; the caller frees
   it. */
static char *wait_for(int fd, const char *type, size_t *length) {
    char key[64];
    snprintf(key, sizeof key, "{\"type\": \"%s\"", type ? type : "");
    for (int n = 0; n < 500; n++) {
        int kind;
        char *message = get_message(fd, &kind, length, 5);
        if (!message)
            break;
        if (type ? kind == FRAME_TEXT && strncmp(message, key, strlen(key)) == 0
                 : kind == FRAME_BINARY && get32((uint8_t *)message) == 1)
            return message;
        free(message);
    }
    fail_msg("no %s came", type ? type : "frame");
    return NULL;
}

/* Waits for a message of a type whose member `key` has a value. */
static void wait_for_number(int fd, const char *type, const char *key, double value) {
    for (int n = 0; n < 100; n++) {
        size_t length;
        char *message = wait_for(fd, type, &length);
        JoxText text = {.data = message};
        parse_numbers(&text);
        free(message);
        if (fabs(number_at(key, 0, 0, 0) - value) < 1e-6)
            return;
    }
    fail_msg("%s never was %g", key, value);
}

static void recording_page_plays_pauses_and_seeks(void **state) {
    (void)state;
    record_room();
    pthread_t thread;
    JoViewRecordingDef def = jo_default_view_recording_def();
    write_test_file("index.html", "a page");
    def.recording = path;
    def.page = test_folder;
    def.stop = &stop;
    def.opened = keep_page_address;
    assert_int_equal(pthread_create(&thread, NULL, serve_recording, &def), 0);
    char token[64] = "";
    int port = 0;
    for (int n = 0; n < 500 && !port; n++) {
        usleep(10000);
        pthread_mutex_lock(&lock);
        sscanf(address, "http://127.0.0.1:%d/?token=%63s", &port, token);
        pthread_mutex_unlock(&lock);
    }
    assert_true(port > 0);
    int fd = open_socket(port, token);
    assert_true(fd >= 0);
    size_t length;
    char *message = wait_for(fd, "scene", &length);
    assert_non_null(strstr(message, "\"session\": \"replay\""));
    free(message);
    double first = NAN, last = NAN; /* it plays */
    for (int n = 0; n < 4; n++) {
        message = wait_for(fd, NULL, &length);
        const Seen seen = decode_bytes((uint8_t *)message, length);
        first = n ? first : seen.time;
        last = seen.time;
        free(message);
    }
    assert_true(last > first);
    put_text(fd, "{\"do\": \"pause\", \"on\": true}");
    put_text(fd, "{\"do\": \"seek\", \"time\": 5.04}");
    wait_for_number(fd, "time", "at", 5.04);
    wait_for_number(fd, "status", "jumps", 2); /* the first one is the start */
    put_text(fd, "{\"do\": \"step\", \"n\": 2}");
    wait_for_number(fd, "status", "time", 5.2);
    put_text(fd, "{\"do\": \"step\", \"n\": -1}");
    wait_for_number(fd, "status", "time", 5.1);
    put_text(fd, "{\"do\": \"seek\", \"time\": 1e9}");
    wait_for_number(fd, "time", "at", 10);
    wait_for_number(fd, "status", "jumps", 4); /* one frame back is no jump, two ahead are one */
    put_text(fd, "{\"do\": \"seek\", \"time\": null}");
    free(wait_for(fd, "refused", &length));
    put_text(fd, "{\"do\": \"input\", \"line\": \"open gate\"}");
    message = wait_for(fd, "refused", &length);
    assert_non_null(strstr(message, "cannot be changed"));
    free(message);
    put_text(fd, "{\"do\": \"speed\", \"factor\": 100}");
    put_text(fd,
             "{\"do\": \"pause\", \"on\": false}"); /* at the end, plays again from the beginning */
    wait_for_number(fd, "status", "speed", 100);
    wait_for_number(fd, "time", "at", 10);
    stop = 1;
    void *good;
    pthread_join(thread, &good);
    assert_non_null(good);
    close(fd);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(recording_page_plays_pauses_and_seeks)};
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
