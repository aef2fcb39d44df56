/* Opens and closes a server of the live page over a temporary folder with a few files, for the
   tests of the server. */
#ifndef JOX_TESTS_VIEW_OPEN_H
#define JOX_TESTS_VIEW_OPEN_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/stat.h>

#include <cmocka.h>

#include "unit/test_folder.h"
#include "unit/view_client.h"
#include "view/view.h"

static JoxView *view;
static char token[64];
static int port;
static const char HELLO[] = "<!doctype html>the page";

static inline int make_page_folder(void **state) {
    if (make_test_folder(state) != 0)
        return -1;
    write_test_file("page/index.html", HELLO);
    write_test_file("page/parts/one.js", "export default 1");
    write_test_file("page/.hidden.js", "hidden");
    write_test_file("page/notes.txt", "notes");
    write_test_file("secret.js", "secret");
    write_test_file("page/parts/two.js", "two");
    mkdir(test_path("page/links"), 0700);
    if (symlink("../parts/two.js", test_path("page/links/two.js")) ||
        symlink(test_path("secret.js"), test_path("page/out.js")))
        return -1;
    return 0;
}

static inline JoxView *open_view_at(int at, const char *address, double patience) {
    JoxViewOptions options = {
        .page = test_path("page"), .port = at, .address = address, .patience = patience};
    JoxText why = {0};
    JoxView *opened = jox_view_open(&options, &why);
    if (!opened)
        fail_msg("%s", why.data);
    return opened;
}

static inline int open_view(void **state) {
    (void)state;
    view = open_view_at(0, NULL, 3.0);
    return sscanf(jox_view_address(view), "http://127.0.0.1:%d/?token=%63s", &port, token) == 2
               ? 0
               : -1;
}

static inline int close_view(void **state) {
    (void)state;
    jox_view_close(view);
    return 0;
}

/* ---- requests and events ---- */

static char answer[16384];

/* Sends a request to the server with more header lines; returns the status, and leaves the answer
   in `answer`. */
static inline int fetch_with_headers(const char *method, const char *path, const char *more) {
    char request[8192];
    int fd = connect_to(port);
    assert_true(fd >= 0);
    snprintf(request, sizeof request,
             "%s %s HTTP/1.1\r\nHost: 127.0.0.1:%d\r\nConnection: close\r\n%s\r\n", method, path,
             port, more);
    int status = send_request(fd, request, answer, sizeof answer);
    close(fd);
    return status;
}

/* Fetches a path with the token in the query. */
static inline int fetch_page(const char *path) {
    char whole[512];
    snprintf(whole, sizeof whole, "%s?token=%s", path, token);
    return fetch_with_headers("GET", whole, "");
}

static inline const char *get_body(void) {
    const char *end = strstr(answer, "\r\n\r\n");
    return end ? end + 4 : "";
}

/* Takes the next event of the server within 10 s. */
static inline JoxViewTaken take_event(uint32_t *client, char text[JOX_VIEW_MOST_COMMAND + 1]) {
    for (double until = clock_now() + 10.0; clock_now() < until;) {
        JoxViewTaken taken = jox_view_next_event(view, client, text, JOX_VIEW_MOST_COMMAND + 1);
        if (taken != JOX_VIEW_NOTHING)
            return taken;
        jox_view_wait(view, 0.1);
    }
    return JOX_VIEW_NOTHING;
}

/* Connects a page; returns its socket, and its id at the server. */
static inline int join_page(uint32_t *client) {
    char text[JOX_VIEW_MOST_COMMAND + 1];
    int fd = open_socket(port, token);
    assert_true(fd >= 0);
    assert_int_equal(take_event(client, text), JOX_VIEW_JOINED);
    return fd;
}

static inline void leave_page(int fd) {
    char text[JOX_VIEW_MOST_COMMAND + 1];
    uint32_t client;
    close(fd);
    JoxViewTaken taken;
    while ((taken = take_event(&client, text)) == JOX_VIEW_COMMAND)
        ;
    assert_int_equal(taken, JOX_VIEW_LEFT);
}

static inline bool wait_for_count(uint64_t (*count)(const JoxView *), uint64_t least) {
    for (double until = clock_now() + 10.0; clock_now() < until;) {
        if (count(view) >= least)
            return true;
        usleep(2000);
    }
    return false;
}

#define WITH_VIEW(test) cmocka_unit_test_setup_teardown(test, open_view, close_view)

#endif
