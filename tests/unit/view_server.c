/* The live page's server: who is served, and what is refused. */
#include "unit/view_open.h"

#include <sys/resource.h>
#include <sys/wait.h>

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
    snprintf(cookie, sizeof cookie, "Cookie: jostle_%d=%s\r\n", port, token);
    assert_int_equal(fetch_with("GET", "/parts/one.js", cookie), 403);
}

/* Other servers of 127.0.0.1 are sent the page's cookie: it is worth the page's files alone. */
static void the_cookie_opens_files_and_no_socket(void **state) {
    (void)state;
    char path[256], cookie[512], pass[64] = "";
    snprintf(path, sizeof path, "/?token=%s", token);
    assert_int_equal(fetch_with("GET", path, ""), 200);
    const char *set = strstr(answer, "set-cookie: ");
    assert_non_null(set);
    assert_int_equal(sscanf(strchr(set, '='), "=%32[0-9a-f]", pass), 1);
    assert_string_not_equal(pass, token);
    snprintf(cookie, sizeof cookie, "Cookie: a=b; jostle_%d=%s; c=d\r\n", port, pass);
    assert_int_equal(fetch_with("GET", "/parts/one.js", cookie), 200);
    assert_null(strstr(answer, "set-cookie")); /* it has it */
    snprintf(cookie, sizeof cookie, "Cookie: jostle_%d=%s\r\n", port + 1, pass);
    assert_int_equal(fetch_with("GET", "/parts/one.js", cookie), 403);
    snprintf(cookie, sizeof cookie,
             "Cookie: jostle_%d=%s\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
             "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n"
             "Sec-WebSocket-Protocol: jostle\r\nOrigin: http://127.0.0.1:%d\r\n",
             port, pass, port);
    assert_int_equal(fetch_with("GET", "/socket", cookie), 403);
    snprintf(path, sizeof path, "/socket?token=%s", pass);
    assert_int_equal(fetch_with("GET", path, cookie), 403);
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
    static const char *const METHODS[] = {"POST",    "PUT",     "DELETE", "HEAD",
                                          "OPTIONS", "CONNECT", "TRACE"};
    char path[128];
    snprintf(path, sizeof path, "/?token=%s", token);
    for (size_t i = 0; i < sizeof METHODS / sizeof *METHODS; i++) {
        double begun = clock_now();
        int status = fetch_with(METHODS[i], path, "Content-Length: 0\r\n");
        assert_true(clock_now() - begun < 15.0); /* which ends the connection */
        if (status != 405 && status != 403 && status != 0)
            fail_msg("%s: %d", METHODS[i], status);
        assert_null(strstr(answer, "the page"));
    }
}

static void sockets_of_other_pages_are_refused(void **state) {
    (void)state;
    char host[64], origin[96], other[96];
    int status = 0;
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
    while ((message = get_message(fd, &kind, &length, 10.0)) != NULL)
        free(message);
    leave(fd);
    assert_true(jox_view_dropped(view) >= 1);
    assert_int_equal(fetch("/"), 200);
}

/* What no browser sends: first byte, second byte, and what follows the mask. */
static void malformed_frames_end_the_connection(void **state) {
    (void)state;
    static const struct {
        const char *what;
        uint8_t bytes[24];
        size_t length;
    } CASES[] = {
        {"an opcode that there is not", {0x83, 0x81, 0, 0, 0, 0, 'x'}, 7},
        {"a control opcode that there is not", {0x8b, 0x80, 0, 0, 0, 0}, 6},
        {"a reserved bit", {0xc1, 0x81, 0, 0, 0, 0, 'x'}, 7},
        {"a ping that is too long", {0x89, 0xfe, 0, 200, 0, 0, 0, 0}, 8},
        {"a ping in parts", {0x09, 0x81, 0, 0, 0, 0, 'x'}, 7},
        {"the rest of nothing", {0x80, 0x81, 0, 0, 0, 0, 'x'}, 7},
        {"a message within another",
         {0x01, 0x81, 0, 0, 0, 0, 'x', 0x81, 0x81, 0, 0, 0, 0, 'y'},
         14},
        {"a length beyond all", {0x81, 0xff, 0xff, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 14},
        {"text that is no UTF-8", {0x81, 0x82, 0, 0, 0, 0, 0xc3, 0x28}, 8},
        {"text that ends within a character", {0x81, 0x81, 0, 0, 0, 0, 0xc3}, 7},
    };
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; c++) {
        uint32_t client;
        char text[JOX_VIEW_MOST_COMMAND + 1];
        int fd = join(&client), kind;
        size_t length;
        assert_true(put(fd, CASES[c].bytes, CASES[c].length));
        char *said = get_message(fd, &kind, &length, 10.0), more;
        if (said ? kind != FRAME_CLOSE : get(fd, &more, 1, 0.0) != 0)
            fail_msg("%s does not end the connection", CASES[c].what);
        free(said);
        put_text(fd, "{\"do\": \"pause\"}"); /* nobody hears it */
        close(fd);
        assert_int_equal(take(&client, text), JOX_VIEW_LEFT);
    }
    assert_int_equal(fetch("/"), 200);
}

/* More than the server has room for, none of whom says who it is, for as long as it may. */
static void who_says_nothing_delays_nobody(void **state) {
    (void)state;
    enum { COUNT = 600 };
    int idle[COUNT];
    struct rlimit files;
    assert_int_equal(getrlimit(RLIMIT_NOFILE, &files), 0);
    const rlim_t before = files.rlim_cur;
    files.rlim_cur = files.rlim_max < 4096 ? files.rlim_max : 4096;
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &files), 0);
    if (files.rlim_cur < 2048)
        skip();
    JoxView *first = view;
    const int old = port;
    char other[64], kept[64];
    snprintf(kept, sizeof kept, "%s", token);
    view = open_with(0, NULL, 600.0); /* a patience that the test has not */
    assert_int_equal(
        sscanf(jox_view_address(view), "http://127.0.0.1:%d/?token=%63s", &port, other), 2);
    snprintf(token, sizeof token, "%s", other);
    uint32_t client;
    const int page = join(&client);
    for (int i = 0; i < COUNT; i++)
        assert_true((idle[i] = dial(port)) >= 0);
    assert_int_equal(fetch("/"), 200);
    leave(join(&client));
    assert_true(put_text(page, "{\"do\": \"pause\"}")); /* and who was there is not sent away */
    char text[JOX_VIEW_MOST_COMMAND + 1];
    assert_int_equal(take(&client, text), JOX_VIEW_COMMAND);
    leave(page);
    for (int i = 0; i < COUNT; i++)
        close(idle[i]);
    jox_view_close(view);
    view = first;
    port = old;
    snprintf(token, sizeof token, "%s", kept);
    files.rlim_cur = before;
    setrlimit(RLIMIT_NOFILE, &files);
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

/* Each finds a port though all look for one in the same moment. */
static void many_that_begin_at_once(void **state) {
    (void)state;
    enum { COUNT = 12, ROUNDS = 5 };
    for (int r = 0; r < ROUNDS; r++) {
        int begin[2], done[2];
        assert_int_equal(pipe(begin), 0);
        assert_int_equal(pipe(done), 0);
        pid_t ids[COUNT];
        for (int i = 0; i < COUNT; i++) {
            assert_true((ids[i] = fork()) >= 0);
            if (ids[i] == 0) {
                char c;
                close(begin[1]);
                close(done[1]);
                bool waited = read(begin[0], &c, 1) == 0; /* its end is what they wait for */
                JoxText why = {0};
                JoxViewOptions options = {.page = "page", .three = "three"};
                JoxView *opened = waited && !chdir(folder) ? jox_view_open(&options, &why) : NULL;
                if (!opened)
                    fprintf(stderr, "%s\n", why.data ? why.data : "no view");
                bool kept = opened && read(done[0], &c, 1) == 0; /* till all have theirs */
                _exit(kept ? 0 : 1);
            }
        }
        close(begin[0]);
        close(done[0]);
        close(begin[1]);
        usleep(300000);
        close(done[1]);
        for (int i = 0; i < COUNT; i++) {
            int status;
            assert_int_equal(waitpid(ids[i], &status, 0), ids[i]);
            assert_true(WIFEXITED(status));
            assert_int_equal(WEXITSTATUS(status), 0);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        WITH_VIEW(the_page_is_served_with_its_headers),
        WITH_VIEW(other_files_are_not),
        WITH_VIEW(who_has_no_token_is_refused),
        WITH_VIEW(the_cookie_opens_files_and_no_socket),
        WITH_VIEW(other_hosts_and_methods_are_refused),
        WITH_VIEW(sockets_of_other_pages_are_refused),
        WITH_VIEW(commands_arrive_and_garbage_is_dropped),
        WITH_VIEW(a_huge_message_ends_the_connection),
        WITH_VIEW(malformed_frames_end_the_connection),
        WITH_VIEW(who_says_nothing_delays_nobody),
        WITH_VIEW(ports_and_folders),
        cmocka_unit_test(many_that_begin_at_once),
    };
    return cmocka_run_group_tests(tests, make_pages, remove_pages);
}
