/* The live page's server: who is served, what is refused, and that nobody holds it up. */
#include <malloc.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/stat.h>

#include <cmocka.h>

#include "unit/view_client.h"
#include "view/access.h"
#include "view/command.h"
#include "view/view.h"

static char folder[] = "/tmp/jostle-view-XXXXXX";
static JoxView *view;
static char token[64];
static int port;
static const char HELLO[] = "<!doctype html>the page";

static void write_page(const char *name, const char *text) {
    char path[300];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static const char *in_folder(const char *name) {
    static char path[300];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static int make_pages(void **state) {
    (void)state;
    char secret[300];
    if (!mkdtemp(folder))
        return -1;
    mkdir(in_folder("page"), 0700);
    mkdir(in_folder("page/parts"), 0700);
    mkdir(in_folder("three"), 0700);
    mkdir(in_folder("three/build"), 0700);
    write_page("page/index.html", HELLO);
    write_page("page/parts/one.js", "export default 1");
    write_page("page/.hidden.js", "hidden");
    write_page("page/notes.txt", "notes");
    write_page("secret.js", "secret");
    write_page("three/three.js", "three");
    snprintf(secret, sizeof secret, "%s", in_folder("secret.js"));
    if (symlink("../three.js", in_folder("three/build/three.module.js")) ||
        symlink(secret, in_folder("page/out.js")))
        return -1;
    return 0;
}

static int remove_pages(void **state) {
    (void)state;
    static const char *const FILES[] = {
        "page/index.html", "page/parts/one.js", "page/.hidden.js", "page/notes.txt",
        "page/out.js",     "secret.js",         "three/three.js",  "three/build/three.module.js"};
    static const char *const FOLDERS[] = {"page/parts", "page", "three/build", "three", ""};
    for (size_t i = 0; i < sizeof FILES / sizeof *FILES; i++)
        unlink(in_folder(FILES[i]));
    for (size_t i = 0; i < sizeof FOLDERS / sizeof *FOLDERS; i++)
        rmdir(in_folder(FOLDERS[i]));
    return 0;
}

static JoxView *open_with(int at, const char *address, double patience) {
    char page[300], three[300];
    snprintf(page, sizeof page, "%s/page", folder);
    snprintf(three, sizeof three, "%s/three", folder);
    JoxViewOptions options = {
        .page = page, .three = three, .port = at, .address = address, .patience = patience};
    JoxText why = {0};
    JoxView *opened = jox_view_open(&options, &why);
    if (!opened)
        fail_msg("%s", why.data);
    return opened;
}

static int open_view(void **state) {
    (void)state;
    view = open_with(0, NULL, 1.0);
    return sscanf(jox_view_address(view), "http://127.0.0.1:%d/?token=%63s", &port, token) == 2
               ? 0
               : -1;
}

static int close_view(void **state) {
    (void)state;
    jox_view_close(view);
    return 0;
}

/* ---- what the tests do ---- */

static char answer[16384];

/* The status of a request of the page's own address, with more headers. */
static int fetch_with(const char *method, const char *path, const char *more) {
    char request[8192];
    int fd = dial(port);
    assert_true(fd >= 0);
    snprintf(request, sizeof request,
             "%s %s HTTP/1.1\r\nHost: 127.0.0.1:%d\r\nConnection: close\r\n%s\r\n", method, path,
             port, more);
    int status = ask(fd, request, answer, sizeof answer);
    close(fd);
    return status;
}

/* With the token in the query. */
static int fetch(const char *path) {
    char whole[512];
    snprintf(whole, sizeof whole, "%s?token=%s", path, token);
    return fetch_with("GET", whole, "");
}

static const char *body(void) {
    const char *end = strstr(answer, "\r\n\r\n");
    return end ? end + 4 : "";
}

/* The next that the stepping thread is told, within two seconds. */
static JoxViewTaken take(uint32_t *client, char text[JOX_VIEW_MOST_COMMAND + 1]) {
    for (double until = clock_now() + 2.0; clock_now() < until;) {
        JoxViewTaken taken = jox_view_take(view, client, text, JOX_VIEW_MOST_COMMAND + 1);
        if (taken != JOX_VIEW_NOTHING)
            return taken;
        jox_view_wait(view, 0.1);
    }
    return JOX_VIEW_NOTHING;
}

/* A page that is connected, and what the server calls it. */
static int join(uint32_t *client) {
    char text[JOX_VIEW_MOST_COMMAND + 1];
    int fd = open_socket(port, token);
    assert_true(fd >= 0);
    assert_int_equal(take(client, text), JOX_VIEW_JOINED);
    return fd;
}

static void leave(int fd) {
    char text[JOX_VIEW_MOST_COMMAND + 1];
    uint32_t client;
    close(fd);
    JoxViewTaken taken;
    while ((taken = take(&client, text)) == JOX_VIEW_COMMAND)
        ;
    assert_int_equal(taken, JOX_VIEW_LEFT);
}

static bool wait_for(uint64_t (*count)(const JoxView *), uint64_t least) {
    for (double until = clock_now() + 3.0; clock_now() < until;) {
        if (count(view) >= least)
            return true;
        usleep(2000);
    }
    return false;
}

/* ---- tests ---- */

static void the_page_is_served_with_its_headers(void **state) {
    (void)state;
    char expected[64];
    assert_int_equal(fetch("/"), 200);
    assert_string_equal(body(), HELLO);
    static const char *const HEADERS[] = {
        "content-type: text/html; charset=utf-8\r\n",
        "x-content-type-options: nosniff\r\n",
        "cache-control: no-store\r\n",
        "referrer-policy: no-referrer\r\n",
        "content-security-policy: default-src 'none'; script-src 'self';",
        "; SameSite=Strict; HttpOnly\r\n"};
    for (size_t i = 0; i < sizeof HEADERS / sizeof *HEADERS; i++)
        if (!strstr(answer, HEADERS[i]))
            fail_msg("no '%s' in\n%s", HEADERS[i], answer);
    snprintf(expected, sizeof expected, "connect-src 'self' ws://127.0.0.1:%d;", port);
    assert_non_null(strstr(answer, expected));
    assert_int_equal(fetch("/parts/one.js"), 200);
    assert_non_null(strstr(answer, "content-type: text/javascript"));
    assert_int_equal(fetch("/three/build/three.module.js"), 200); /* a link inside its folder */
    assert_string_equal(body(), "three");
}

static void other_files_are_not(void **state) {
    (void)state;
    static const char *const PATHS[] = {"/parts",
                                        "/nothing.js",
                                        "/.hidden.js",
                                        "/notes.txt",
                                        "/out.js",
                                        "/../secret.js",
                                        "/%2e%2e/secret.js",
                                        "/parts/../../secret.js",
                                        "/three/",
                                        "/..%2fsecret.js",
                                        "/%2e%2e%2fsecret.js",
                                        "/three/../../secret.js",
                                        "/three",
                                        "/parts/..\\secret.js",
                                        "//etc/hostname.js",
                                        "/three/../secret.js",
                                        "/parts/one.js/",
                                        "/index.html%00.js",
                                        "/three/build/../../x",
                                        "/three/%2e%2e/secret.js"};
    for (size_t i = 0; i < sizeof PATHS / sizeof *PATHS; i++) {
        int status = fetch(PATHS[i]);
        if (status != 404 && status != 403 && status != 0)
            fail_msg("%s: %d", PATHS[i], status);
        assert_null(strstr(answer, "secret"));
    }
}

static void who_has_no_token_is_refused(void **state) {
    (void)state;
    char path[256], cookie[256], wrong[64];
    snprintf(wrong, sizeof wrong, "%s", token);
    wrong[31] = wrong[31] == '0' ? '1' : '0';
    assert_int_equal(fetch_with("GET", "/", ""), 403);
    assert_int_equal(fetch_with("GET", "/?token=", ""), 403);
    assert_int_equal(fetch_with("GET", "/?nottoken=1", ""), 403);
    snprintf(path, sizeof path, "/?token=%s", wrong);
    assert_int_equal(fetch_with("GET", path, ""), 403);
    snprintf(path, sizeof path, "/?token=%s0", token);
    assert_int_equal(fetch_with("GET", path, ""), 403);
    snprintf(path, sizeof path, "/?token=%.31s", token);
    assert_int_equal(fetch_with("GET", path, ""), 403);
    assert_null(strstr(answer, "the page"));
    snprintf(cookie, sizeof cookie, "Cookie: a=b; jostle_%d=%s\r\n", port, wrong);
    assert_int_equal(fetch_with("GET", "/parts/one.js", cookie), 403);
    snprintf(cookie, sizeof cookie, "Cookie: a=b; jostle_%d=%s; c=d\r\n", port, token);
    assert_int_equal(fetch_with("GET", "/parts/one.js", cookie), 200);
    assert_null(strstr(answer, "set-cookie")); /* it has it */
    snprintf(cookie, sizeof cookie, "Cookie: jostle_%d=%s\r\n", port + 1, token);
    assert_int_equal(fetch_with("GET", "/parts/one.js", cookie), 403);
}

static void other_hosts_and_methods_are_refused(void **state) {
    (void)state;
    static const char *const HOSTS[] = {
        "evil.example",      "127.0.0.1",       "127.0.0.1:1",  "localhost",
        "127.0.0.1.evil:%d", "evil.example:%d", "127.0.0.2:%d", ""};
    char host[64], request[512];
    for (size_t i = 0; i < sizeof HOSTS / sizeof *HOSTS; i++) {
        snprintf(host, sizeof host, HOSTS[i], port);
        snprintf(request, sizeof request,
                 "GET /?token=%s HTTP/1.1\r\nHost: %s\r\nConnection: close\r\n\r\n", token, host);
        int fd = dial(port), status = ask(fd, request, answer, sizeof answer);
        close(fd);
        if (status != 403 && status != 0)
            fail_msg("%s: %d", host, status);
    }
    static const char *const NAMES[] = {"localhost:%d", "[::1]:%d", "LOCALHOST:%d"};
    for (size_t i = 0; i < sizeof NAMES / sizeof *NAMES; i++) {
        snprintf(host, sizeof host, NAMES[i], port);
        snprintf(request, sizeof request,
                 "GET /?token=%s HTTP/1.1\r\nHost: %s\r\nConnection: close\r\n\r\n", token, host);
        int fd = dial(port);
        assert_int_equal(ask(fd, request, answer, sizeof answer), 200);
        close(fd);
    }
    static const char *const METHODS[] = {"POST", "PUT", "DELETE", "HEAD", "OPTIONS", "CONNECT"};
    char path[128];
    snprintf(path, sizeof path, "/?token=%s", token);
    for (size_t i = 0; i < sizeof METHODS / sizeof *METHODS; i++) {
        int status = fetch_with(METHODS[i], path, "Content-Length: 0\r\n");
        if (status != 405 && status != 403 && status != 0)
            fail_msg("%s: %d", METHODS[i], status);
        assert_null(strstr(answer, "the page"));
    }
}

static void sockets_of_other_pages_are_refused(void **state) {
    (void)state;
    char host[64], origin[96], other[96];
    int status;
    snprintf(host, sizeof host, "127.0.0.1:%d", port);
    snprintf(origin, sizeof origin, "http://%s", host);
    snprintf(other, sizeof other, "http://127.0.0.1:%d", port + 1);
    int fd = open_socket_as(port, host, origin, token, &status);
    assert_true(fd >= 0);
    close(fd);
    const char *const ORIGINS[] = {NULL, "http://evil.example", "null", "file://", other,
                                   "",   "https://127.0.0.1"};
    for (size_t i = 0; i < sizeof ORIGINS / sizeof *ORIGINS; i++) {
        assert_int_equal(open_socket_as(port, host, ORIGINS[i], token, &status), -1);
        assert_true(status == 403 || status == 0);
    }
    assert_int_equal(open_socket_as(port, host, origin, NULL, &status), -1);
    assert_int_equal(status, 403);
    assert_int_equal(
        open_socket_as(port, host, origin, "0123456789abcdef0123456789abcdef", &status), -1);
    assert_int_equal(open_socket_as(port, "evil.example", "http://evil.example", token, &status),
                     -1);
    snprintf(other, sizeof other, "h2c");
    assert_int_not_equal(fetch_with("GET", "/", "Upgrade: h2c\r\nHTTP2-Settings: AAMAAABkAAQ\r\n"),
                         101);
    uint32_t client;
    char text[JOX_VIEW_MOST_COMMAND + 1];
    assert_int_equal(take(&client, text), JOX_VIEW_JOINED); /* one alone came in */
    assert_int_equal(take(&client, text), JOX_VIEW_LEFT);
    assert_int_equal(jox_view_take(view, &client, text, sizeof text), JOX_VIEW_NOTHING);
}

static uint64_t dropped_of(const JoxView *v) {
    return jox_view_dropped(v);
}

static void commands_arrive_and_garbage_is_dropped(void **state) {
    (void)state;
    static const char *const GARBAGE[] = {"",
                                          "{",
                                          "null",
                                          "[1, 2]",
                                          "{\"do\": 3}",
                                          "{}",
                                          "{\"a\": 1}",
                                          "do",
                                          "{\"do\": \"x\"} y",
                                          "{\"do\": {\"a\": 1}}",
                                          "{\"do\": \"a\\nb\"}",
                                          "{\"do\": \"pause\", \"on\": nan}",
                                          "{\"do\": \"\\ud800\"}"};
    enum { COUNT = sizeof GARBAGE / sizeof *GARBAGE };
    uint32_t client, from;
    char text[JOX_VIEW_MOST_COMMAND + 1];
    int fd = join(&client);
    for (size_t i = 0; i < COUNT; i++)
        assert_true(put_text(fd, GARBAGE[i]));
    assert_true(put_frame(fd, FRAME_BINARY, true, true, "{\"do\": \"pause\"}", 15));
    assert_true(put_frame(fd, FRAME_TEXT, true, false, "{\"do\": \"pa", 10)); /* in two parts */
    assert_true(put_frame(fd, FRAME_TEXT, false, true, "use\"}", 5));
    assert_int_equal(take(&from, text), JOX_VIEW_COMMAND);
    assert_string_equal(text, "{\"do\": \"pause\"}");
    assert_int_equal(from, client);
    assert_int_equal(jox_view_dropped(view), COUNT + 1);
    /* as long as may be, and one byte longer */
    char *longest = malloc(JOX_VIEW_MOST_COMMAND + 2);
    int n = snprintf(longest, 32, "{\"do\": \"input\", \"line\": \"");
    memset(longest + n, 'x', JOX_VIEW_MOST_COMMAND + 1 - (size_t)n);
    strcpy(longest + JOX_VIEW_MOST_COMMAND - 2, "\"}");
    assert_true(put_text(fd, longest));
    assert_int_equal(take(&from, text), JOX_VIEW_COMMAND);
    assert_string_equal(text, longest);
    strcpy(longest + JOX_VIEW_MOST_COMMAND - 2, "x\"}");
    assert_true(put_text(fd, longest));
    assert_true(wait_for(dropped_of, COUNT + 2));
    free(longest);
    leave(fd);
}

static void a_huge_message_ends_the_connection(void **state) {
    (void)state;
    uint32_t client;
    int fd = join(&client), kind;
    size_t size = 8 << 20, length;
    char *huge = calloc(size, 1), *message;
    memset(huge, 'x', size);
    put_frame(fd, FRAME_TEXT, true, true, huge, size); /* not to its end, as it seems */
    free(huge);
    while ((message = get_message(fd, &kind, &length, 1.0)) != NULL)
        free(message);
    leave(fd);
    assert_true(jox_view_dropped(view) >= 1);
    assert_int_equal(fetch("/"), 200);
}

static void who_says_too_much_is_not_heard(void **state) {
    (void)state;
    enum { SAID = 1000 };
    uint32_t client, from;
    char text[JOX_VIEW_MOST_COMMAND + 1];
    int fd = join(&client), heard = 0;
    double begun = clock_now();
    for (int i = 0; i < SAID; i++)
        assert_true(put_text(fd, "{\"do\": \"pause\"}"));
    while (take(&from, text) == JOX_VIEW_COMMAND)
        heard++;
    double took = clock_now() - begun;
    assert_int_equal(heard + (int)jox_view_dropped(view), SAID);
    assert_true(heard >= 200 && heard <= 200 + 200 * took + 1); /* and 200 a second more */
    leave(fd);
}

static void noise_harms_nobody(void **state) {
    (void)state;
    uint32_t client, random = 12345;
    enum { NOISE = 1 << 20 };
    char *noise = malloc(NOISE);
    for (int i = 0; i < NOISE; i++) {
        random = random * 1664525u + 1013904223u;
        noise[i] = (char)(random >> 24);
    }
    int other = join(&client), fd = dial(port);
    put(fd, noise, NOISE); /* in place of a request */
    close(fd);
    fd = join(&client);
    put(fd, noise, NOISE); /* in place of frames */
    leave(fd);
    for (int i = 0; i < 64; i++) { /* requests cut off or garbled somewhere */
        char request[256];
        int n = snprintf(request, sizeof request, "GET /?token=%s HTTP/1.1\r\nHost: 127.0.0.1:%d",
                         token, port);
        memcpy(request + i, noise + i * 16, 16);
        fd = dial(port);
        put(fd, request, (size_t)n);
        put(fd, "\r\n\r\n", 4);
        close(fd);
    }
    free(noise);
    assert_int_equal(fetch("/"), 200);
    jox_view_send(view, 0, "{\"type\": \"say\"}");
    int kind;
    size_t length;
    char *message = get_message(other, &kind, &length, 2.0);
    assert_non_null(message);
    assert_string_equal(message, "{\"type\": \"say\"}");
    free(message);
    leave(other);
}

static void half_open_connections_do_not_stay(void **state) {
    (void)state;
    enum { HALF = 300 };
    static int half[HALF];
    for (int i = 0; i < HALF; i++) {
        half[i] = dial(port);
        assert_true(half[i] >= 0);
        if (i % 3 == 1)
            put(half[i], "GET / HT", 8);
        if (i % 3 == 2)
            put(half[i], "GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nX-Long: ", 41);
    }
    double begun = clock_now();
    assert_int_equal(fetch("/"), 200); /* at once, and not behind them */
    assert_true(clock_now() - begun < 1.0);
    int gone = 0;
    for (int i = 0; i < HALF; i++) {
        char block[512];
        ssize_t n;
        while ((n = get(half[i], block, sizeof block, 6.0 - (clock_now() - begun))) > 0)
            ;
        gone += n == 0;
        close(half[i]);
    }
    assert_int_equal(gone, HALF);
}

static void there_is_room_for_so_many_pages(void **state) {
    (void)state;
    int fds[JOX_VIEW_CLIENTS], status;
    uint32_t client;
    char host[64], origin[80];
    snprintf(host, sizeof host, "127.0.0.1:%d", port);
    snprintf(origin, sizeof origin, "http://%s", host);
    for (int i = 0; i < JOX_VIEW_CLIENTS; i++)
        fds[i] = join(&client);
    assert_int_equal(jox_view_clients(view), JOX_VIEW_CLIENTS);
    assert_int_equal(open_socket_as(port, host, origin, token, &status), -1);
    assert_int_equal(status, 503);
    leave(fds[0]);
    fds[0] = join(&client);
    for (int i = 0; i < JOX_VIEW_CLIENTS; i++)
        leave(fds[i]);
    assert_int_equal(jox_view_clients(view), 0);
}

/* Bytes in use, of all arenas. */
static size_t in_use(void) {
    struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

/* Resident memory, bytes. */
static size_t resident(void) {
    long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (file && fscanf(file, "%*s %ld", &pages) != 1)
        pages = 0;
    if (file)
        fclose(file);
    return (size_t)pages * (size_t)sysconf(_SC_PAGESIZE);
}

static void pages_come_and_go(void **state) {
    (void)state;
    const char *more = getenv("JOSTLE_VIEW_CYCLES"); /* the whole tests set it */
    int cycles = more ? atoi(more) : 1000;
    static char frame[20000];
    size_t before = 0, at_first = 0;
    double longest = 0.0, begun = clock_now();
    for (int i = 0; i < cycles + 100; i++) {
        uint32_t client;
        double from = clock_now();
        int fd = join(&client), kind;
        size_t length;
        jox_view_send(view, client, "{\"type\": \"hello\"}");
        jox_view_listen(view, client, 1u << JOX_VIEW_FRAMES);
        jox_view_publish(view, JOX_VIEW_FRAMES, frame, sizeof frame);
        char *message = get_message(fd, &kind, &length, 2.0);
        assert_non_null(message);
        assert_int_equal(kind, FRAME_TEXT);
        free(message);
        if (i % 3 == 0) { /* some wait for the frame, some vanish under way */
            message = get_message(fd, &kind, &length, 2.0);
            assert_non_null(message);
            assert_int_equal(length, sizeof frame);
            free(message);
        }
        if (i % 3 == 1)
            put_frame(fd, FRAME_CLOSE, true, true, "\x03\xe8", 2);
        leave(fd);
        double took = clock_now() - from;
        longest = took > longest ? took : longest;
        if (i == 99) {
            before = in_use();
            at_first = resident();
        }
    }
    size_t after = in_use(), at_last = resident();
    print_message("%d pages in %.1f s, the slowest %.1f ms; %zu kB resident before, %zu after\n",
                  cycles, clock_now() - begun, longest * 1e3, at_first / 1000, at_last / 1000);
    if (after > before + 65536)
        fail_msg("%zu bytes in use after, %zu before", after, before);
#ifndef __SANITIZE_ADDRESS__ /* which keeps what was freed for a while */
    assert_true(at_last < at_first + (4 << 20));
#endif
    assert_true(longest < 2.0);
}

static void a_slow_reader_gets_the_newest(void **state) {
    (void)state;
    enum { FRAMES = 400, SIZE = 300000 };
    uint32_t client, number;
    int fd = join(&client), kind, received = 0;
    jox_view_listen(view, client, 1u << JOX_VIEW_FRAMES);
    char *frame = calloc(SIZE, 1), *message;
    double longest = 0.0;
    for (uint32_t i = 1; i <= FRAMES; i++) {
        memcpy(frame, &i, sizeof i);
        memcpy(frame + SIZE - sizeof i, &i, sizeof i);
        double from = clock_now();
        jox_view_publish(view, JOX_VIEW_FRAMES, frame, SIZE);
        double took = clock_now() - from;
        longest = took > longest ? took : longest;
        usleep(500);
    }
    uint32_t last = 0;
    size_t length;
    while (last != FRAMES && (message = get_message(fd, &kind, &length, 2.0)) != NULL) {
        assert_int_equal(kind, FRAME_BINARY);
        assert_int_equal(length, SIZE);
        memcpy(&number, message, sizeof number);
        assert_true(number > last); /* in order, whole, some left out */
        last = number;
        memcpy(&number, message + SIZE - sizeof number, sizeof number);
        assert_int_equal(number, last);
        received++;
        free(message);
    }
    assert_int_equal(last, FRAMES);
    assert_true(received < FRAMES / 2);
    assert_true(longest < 0.05); /* a copy; the machine may be busy */
    free(frame);
    leave(fd);
}

static void who_never_reads_is_cut_off(void **state) {
    (void)state;
    uint32_t client;
    int fd = join(&client);
    enum { PART = 1 << 20 };
    char *text = malloc(PART + 1);
    memset(text, ' ', PART);
    text[PART] = 0;
    for (int i = 0; i < 60 && jox_view_clients(view); i++) {
        jox_view_send(view, client, text);
        usleep(1000);
    }
    free(text);
    char said[JOX_VIEW_MOST_COMMAND + 1];
    assert_int_equal(take(&client, said), JOX_VIEW_LEFT);
    close(fd);
}

static void what_is_sent_precedes_what_is_published_after(void **state) {
    (void)state;
    uint32_t client;
    int fd = join(&client), kind;
    size_t length;
    jox_view_listen(view, client, 1u << JOX_VIEW_FRAMES | 1u << JOX_VIEW_STATUS);
    for (int i = 0; i < 200; i++) {
        char text[32];
        jox_view_publish(view, JOX_VIEW_FRAMES, "old", 3);
        snprintf(text, sizeof text, "{\"hello\": %d}", i);
        jox_view_forget(view);
        jox_view_send(view, client, text);
        jox_view_publish(view, JOX_VIEW_FRAMES, "new", 3);
        bool greeted = false, shown = false;
        while (!shown) {
            char *message = get_message(fd, &kind, &length, 2.0);
            assert_non_null(message);
            if (kind == FRAME_TEXT)
                greeted = strcmp(message, text) == 0;
            else if (greeted)
                shown = strcmp(message, "new") == 0;
            if (greeted && kind == FRAME_BINARY)
                assert_string_equal(message, "new");
            else if (kind == FRAME_BINARY)
                assert_string_equal(message, "old");
            free(message);
        }
    }
    leave(fd);
}

static void ports_and_folders(void **state) {
    (void)state;
    JoxView *second = open_with(0, NULL, 0);
    int next;
    assert_int_equal(sscanf(jox_view_address(second), "http://127.0.0.1:%d/", &next), 1);
    assert_true(next > port); /* the first is taken */
    jox_view_close(second);
    JoxText why = {0};
    JoxViewOptions options = {.page = in_folder("page"), .three = "/nowhere", .port = port};
    assert_null(jox_view_open(&options, &why));
    assert_non_null(strstr(why.data, "libjs-three"));
    jox_text_free(&why);
    char page[300], three[300];
    snprintf(page, sizeof page, "%s/page", folder);
    snprintf(three, sizeof three, "%s/three", folder);
    options = (JoxViewOptions){.page = page, .three = three, .port = port};
    assert_null(jox_view_open(&options, &why));
    assert_non_null(strstr(why.data, "Address already in use"));
    jox_text_free(&why);
    options = (JoxViewOptions){.page = "/nowhere", .three = three};
    assert_null(jox_view_open(&options, &why));
    assert_non_null(strstr(why.data, "--page"));
    jox_text_free(&why);
    options = (JoxViewOptions){.page = page, .three = three, .address = "not.an.address"};
    assert_null(jox_view_open(&options, &why));
    assert_non_null(strstr(why.data, "no address"));
    jox_text_free(&why);
    /* an address of one's own: hosts may be named as they are, tokens are still wanted */
    JoxView *open_to_all = open_with(0, "0.0.0.0", 0);
    char other[64], request[512];
    assert_int_equal(
        sscanf(jox_view_address(open_to_all), "http://127.0.0.1:%d/?token=%63s", &next, other), 2);
    for (int good = 0; good < 2; good++) {
        snprintf(request, sizeof request,
                 "GET /?token=%s HTTP/1.1\r\nHost: box.example:%d\r\nConnection: close\r\n\r\n",
                 good ? other : token, next);
        int fd = dial(next);
        assert_int_equal(ask(fd, request, answer, sizeof answer), good ? 200 : 403);
        close(fd);
    }
    jox_view_close(open_to_all);
}

static void commands_are_read(void **state) {
    (void)state;
    JoxCommand command;
    assert_true(
        jox_command_read(" {\"do\" : \"input\", \"line\":\"open \\\"Tor \\u00fc\\\" \xc3\xa4\","
                         "\"n\": -1.5e2 , \"on\":true, \"off\":false,\"slot\":null } ",
                         &command));
    assert_string_equal(command.verb, "input");
    assert_string_equal(jox_command_text(&command, "line", "?"), "open \"Tor \xc3\xbc\" \xc3\xa4");
    assert_true(jox_command_number(&command, "n", 0) == -150.0);
    assert_true(jox_command_bool(&command, "on", false));
    assert_false(jox_command_bool(&command, "off", true));
    assert_string_equal(jox_command_text(&command, "n", "?"), "?"); /* of another kind */
    assert_true(jox_command_number(&command, "slot", 7) == 7);
    assert_true(jox_command_read("{\"do\": \"\\ud83d\\ude00\"}", &command));
    assert_string_equal(command.verb, "\xf0\x9f\x98\x80");
    static const char *const BAD[] = {"{\"do\": \"a\", }",
                                      "{\"do\": \"a\" \"b\": 1}",
                                      "{\"do\": \"\xff\"}",
                                      "{\"do\": \"\xc0\x80\"}",
                                      "{\"do\": \"\xed\xa0\x80\"}",
                                      "{\"do\": \"a\", \"b\": 1e999}",
                                      "{\"do\": \"a\", \"b\": 0x10}",
                                      "{\"do\": \"a\", \"b\": +1}",
                                      "{\"do\": \"a\", \"b\": inf}",
                                      "{\"do\": \"\\u0007\"}",
                                      "{\"do\": \"\x1b[2J\"}",
                                      "{\"do\": \"\\ude00\"}",
                                      "{\"do\": \"a\"",
                                      "{\"do\": \"a",
                                      "{do: \"a\"}"};
    for (size_t i = 0; i < sizeof BAD / sizeof *BAD; i++)
        if (jox_command_read(BAD[i], &command))
            fail_msg("%s", BAD[i]);
    char many[1024] = "{\"do\": \"a\"";
    for (int i = 0; i < JOX_COMMAND_KEYS; i++)
        snprintf(many + strlen(many), 32, ", \"k%d\": 1", i);
    strcat(many, "}");
    assert_false(jox_command_read(many, &command));
}

static void the_last_page_may_stay(void **state) {
    (void)state;
    uint32_t client;
    int fd = join(&client);
    jox_view_send(view, client, "{\"type\": \"say\"}"); /* unread, and closed under it */
    jox_view_close(view);
    view = open_with(0, NULL, 1.0);
    close(fd);
}

#define WITH_VIEW(test) cmocka_unit_test_setup_teardown(test, open_view, close_view)

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(commands_are_read),
        WITH_VIEW(the_page_is_served_with_its_headers),
        WITH_VIEW(other_files_are_not),
        WITH_VIEW(who_has_no_token_is_refused),
        WITH_VIEW(other_hosts_and_methods_are_refused),
        WITH_VIEW(sockets_of_other_pages_are_refused),
        WITH_VIEW(commands_arrive_and_garbage_is_dropped),
        WITH_VIEW(a_huge_message_ends_the_connection),
        WITH_VIEW(who_says_too_much_is_not_heard),
        WITH_VIEW(noise_harms_nobody),
        WITH_VIEW(half_open_connections_do_not_stay),
        WITH_VIEW(there_is_room_for_so_many_pages),
        WITH_VIEW(pages_come_and_go),
        WITH_VIEW(a_slow_reader_gets_the_newest),
        WITH_VIEW(who_never_reads_is_cut_off),
        WITH_VIEW(what_is_sent_precedes_what_is_published_after),
        WITH_VIEW(ports_and_folders),
        WITH_VIEW(the_last_page_may_stay),
    };
    return cmocka_run_group_tests(tests, make_pages, remove_pages);
}
