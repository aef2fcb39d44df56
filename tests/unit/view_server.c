/* Tests of the live page's server: which requests are served, and which are refused. */
#include "unit/view_open.h"

#include <sys/resource.h>
#include <sys/wait.h>

#include "view/view_threads.h"

static void page_is_served_with_security_headers(void **state) {
    (void)state;
    char expected[64];
    assert_int_equal(fetch_page("/"), 200);
    assert_string_equal(get_body(), HELLO);
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
    assert_int_equal(fetch_page("/parts/one.js"), 200);
    assert_non_null(strstr(answer, "content-type: text/javascript"));
    /* A link to a file in the page's folder */
    assert_int_equal(fetch_page("/links/two.js"), 200);
    assert_string_equal(get_body(), "two");
}

static void files_outside_the_folders_are_refused(void **state) {
    (void)state;
    static const char *const PATHS[] = {
        "/parts",         "/nothing.js",          "/.hidden.js",         "/notes.txt",
        "/out.js",        "/../secret.js",        "/%2e%2e/secret.js",   "/parts/../../secret.js",
        "/links/",        "/..%2fsecret.js",      "/%2e%2e%2fsecret.js", "/links/../../secret.js",
        "/links",         "/parts/..\\secret.js", "//etc/hostname.js",   "/links/../secret.js",
        "/parts/one.js/", "/index.html%00.js",    "/links/two/../../x",  "/links/%2e%2e/secret.js"};
    for (size_t i = 0; i < sizeof PATHS / sizeof *PATHS; i++) {
        int status = fetch_page(PATHS[i]);
        if (status != 404 && status != 403 && status != 0)
            fail_msg("%s: %d", PATHS[i], status);
        assert_null(strstr(answer, "secret"));
    }
}

static void requests_without_token_are_refused(void **state) {
    (void)state;
    char path[256], cookie[256], wrong[64];
    snprintf(wrong, sizeof wrong, "%s", token);
    wrong[31] = wrong[31] == '0' ? '1' : '0';
    assert_int_equal(fetch_with_headers("GET", "/", ""), 403);
    assert_int_equal(fetch_with_headers("GET", "/?token=", ""), 403);
    assert_int_equal(fetch_with_headers("GET", "/?nottoken=1", ""), 403);
    snprintf(path, sizeof path, "/?token=%s", wrong);
    assert_int_equal(fetch_with_headers("GET", path, ""), 403);
    snprintf(path, sizeof path, "/?token=%s0", token);
    assert_int_equal(fetch_with_headers("GET", path, ""), 403);
    snprintf(path, sizeof path, "/?token=%.31s", token);
    assert_int_equal(fetch_with_headers("GET", path, ""), 403);
    assert_null(strstr(answer, "the page"));
    snprintf(cookie, sizeof cookie, "Cookie: a=b; jostle_%d=%s\r\n", port, wrong);
    assert_int_equal(fetch_with_headers("GET", "/parts/one.js", cookie), 403);
    snprintf(cookie, sizeof cookie, "Cookie: jostle_%d=%s\r\n", port, token);
    assert_int_equal(fetch_with_headers("GET", "/parts/one.js", cookie), 403);
}

/* Browsers send the page's cookie to all servers on 127.0.0.1, so it must open the page's files
   only. */
static void cookie_opens_files_but_no_socket(void **state) {
    (void)state;
    char path[256], cookie[512], pass[64] = "";
    snprintf(path, sizeof path, "/?token=%s", token);
    assert_int_equal(fetch_with_headers("GET", path, ""), 200);
    const char *set = strstr(answer, "set-cookie: ");
    assert_non_null(set);
    assert_int_equal(sscanf(strchr(set, '='), "=%32[0-9a-f]", pass), 1);
    assert_string_not_equal(pass, token);
    snprintf(cookie, sizeof cookie, "Cookie: a=b; jostle_%d=%s; c=d\r\n", port, pass);
    assert_int_equal(fetch_with_headers("GET", "/parts/one.js", cookie), 200);
    assert_null(strstr(answer, "set-cookie")); /* the client has the cookie already */
    snprintf(cookie, sizeof cookie, "Cookie: jostle_%d=%s\r\n", port + 1, pass);
    assert_int_equal(fetch_with_headers("GET", "/parts/one.js", cookie), 403);
    snprintf(cookie, sizeof cookie,
             "Cookie: jostle_%d=%s\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
             "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n"
             "Sec-WebSocket-Protocol: jostle\r\nOrigin: http://127.0.0.1:%d\r\n",
             port, pass, port);
    assert_int_equal(fetch_with_headers("GET", "/socket", cookie), 403);
    snprintf(path, sizeof path, "/socket?token=%s", pass);
    assert_int_equal(fetch_with_headers("GET", path, cookie), 403);
}

/* A page for frames has its token in the path, which its modules' relative addresses repeat:
   cookies and queries open nothing, so that only who knows the address can show it. */
static void page_for_frames_is_opened_by_its_path_alone(void **state) {
    (void)state;
    char path[256], cookie[512], wrong[64];
    JoxText why = {0};
    JoxViewOptions options = {.page = test_path("page"),
                              .frame = "http://localhost:* vscode-webview:"};
    JoxView *framed = jox_view_open(&options, &why);
    const int before = port;
    assert_non_null(framed);
    assert_int_equal(
        sscanf(jox_view_address(framed), "http://127.0.0.1:%d/%63[0-9a-f]/", &port, wrong), 2);
    snprintf(path, sizeof path, "/%s/", wrong);
    assert_int_equal(fetch_with_headers("GET", path, ""), 200);
    assert_string_equal(get_body(), HELLO);
    assert_non_null(strstr(answer, "frame-ancestors http://localhost:* vscode-webview:\r\n"));
    assert_null(strstr(answer, "set-cookie"));
    snprintf(path, sizeof path, "/%s/parts/one.js", wrong);
    assert_int_equal(fetch_with_headers("GET", path, ""), 200);
    snprintf(path, sizeof path, "/%s/../%s/../secret.js", wrong, wrong);
    assert_int_not_equal(fetch_with_headers("GET", path, ""), 200);
    snprintf(path, sizeof path, "/?token=%s", wrong);
    assert_int_equal(fetch_with_headers("GET", path, ""), 403);
    snprintf(cookie, sizeof cookie, "Cookie: jostle_%d=%s\r\n", port, framed->pass);
    assert_int_equal(fetch_with_headers("GET", "/parts/one.js", cookie), 403);
    snprintf(path, sizeof path, "/%s", wrong);
    assert_int_equal(fetch_with_headers("GET", path, ""), 403);
    int fd = open_socket(port, wrong);
    assert_true(fd >= 0);
    close(fd);
    wrong[0] = wrong[0] == '0' ? '1' : '0';
    snprintf(path, sizeof path, "/%s/", wrong);
    assert_int_equal(fetch_with_headers("GET", path, ""), 403);
    jox_view_close(framed);
    port = before;
    assert_int_equal(fetch_page("/"), 200); /* other pages: none may show them */
    assert_non_null(strstr(answer, "frame-ancestors 'none'"));
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
        int fd = connect_to(port), status = send_request(fd, request, answer, sizeof answer);
        close(fd);
        if (status != 403 && status != 0)
            fail_msg("%s: %d", host, status);
    }
    static const char *const NAMES[] = {"localhost:%d", "[::1]:%d", "LOCALHOST:%d"};
    for (size_t i = 0; i < sizeof NAMES / sizeof *NAMES; i++) {
        snprintf(host, sizeof host, NAMES[i], port);
        snprintf(request, sizeof request,
                 "GET /?token=%s HTTP/1.1\r\nHost: %s\r\nConnection: close\r\n\r\n", token, host);
        int fd = connect_to(port);
        assert_int_equal(send_request(fd, request, answer, sizeof answer), 200);
        close(fd);
    }
    static const char *const METHODS[] = {"POST",    "PUT",     "DELETE", "HEAD",
                                          "OPTIONS", "CONNECT", "TRACE"};
    char path[128];
    snprintf(path, sizeof path, "/?token=%s", token);
    for (size_t i = 0; i < sizeof METHODS / sizeof *METHODS; i++) {
        double begun = clock_now();
        int status = fetch_with_headers(METHODS[i], path, "Content-Length: 0\r\n");
        assert_true(clock_now() - begun < 15.0); /* the server closes the connection */
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
    assert_int_not_equal(
        fetch_with_headers("GET", "/", "Upgrade: h2c\r\nHTTP2-Settings: AAMAAABkAAQ\r\n"), 101);
    uint32_t client;
    char text[JOX_VIEW_MOST_COMMAND + 1];
    /* Only the first socket was accepted */
    assert_int_equal(take_event(&client, text), JOX_VIEW_JOINED);
    assert_int_equal(take_event(&client, text), JOX_VIEW_LEFT);
    assert_int_equal(jox_view_next_event(view, &client, text, sizeof text), JOX_VIEW_NOTHING);
}

static uint64_t count_dropped(const JoxView *v) {
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
    int fd = join_page(&client);
    for (size_t i = 0; i < COUNT; i++)
        assert_true(put_text(fd, GARBAGE[i]));
    assert_true(send_frame(fd, FRAME_BINARY, true, true, "{\"do\": \"pause\"}", 15));
    assert_true(send_frame(fd, FRAME_TEXT, true, false, "{\"do\": \"pa", 10)); /* in two frames */
    assert_true(send_frame(fd, FRAME_TEXT, false, true, "use\"}", 5));
    assert_int_equal(take_event(&from, text), JOX_VIEW_COMMAND);
    assert_string_equal(text, "{\"do\": \"pause\"}");
    assert_int_equal(from, client);
    assert_int_equal(jox_view_dropped(view), COUNT + 1);
    /* A command of the greatest length is accepted; one byte more is not. */
    char *longest = malloc(JOX_VIEW_MOST_COMMAND + 2);
    int n = snprintf(longest, 32, "{\"do\": \"input\", \"line\": \"");
    memset(longest + n, 'x', JOX_VIEW_MOST_COMMAND + 1 - (size_t)n);
    strcpy(longest + JOX_VIEW_MOST_COMMAND - 2, "\"}");
    assert_true(put_text(fd, longest));
    assert_int_equal(take_event(&from, text), JOX_VIEW_COMMAND);
    assert_string_equal(text, longest);
    strcpy(longest + JOX_VIEW_MOST_COMMAND - 2, "x\"}");
    assert_true(put_text(fd, longest));
    assert_true(wait_for_count(count_dropped, COUNT + 2));
    free(longest);
    leave_page(fd);
}

static void huge_message_closes_the_connection(void **state) {
    (void)state;
    uint32_t client;
    int fd = join_page(&client), kind;
    size_t size = 8 << 20, length;
    char *huge = calloc(size, 1), *message;
    memset(huge, 'x', size);
    send_frame(fd, FRAME_TEXT, true, true, huge, size); /* the server closes before all is sent */
    free(huge);
    while ((message = get_message(fd, &kind, &length, 10.0)) != NULL)
        free(message);
    leave_page(fd);
    assert_true(jox_view_dropped(view) >= 1);
    assert_int_equal(fetch_page("/"), 200);
}

/* Frames that no browser sends, as the bytes of header, mask and payload. */
static void malformed_frames_close_the_connection(void **state) {
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
        int fd = join_page(&client), kind;
        size_t length;
        assert_true(send_bytes(fd, CASES[c].bytes, CASES[c].length));
        char *said = get_message(fd, &kind, &length, 10.0), more;
        if (said ? kind != FRAME_CLOSE : receive_bytes(fd, &more, 1, 0.0) != 0)
            fail_msg("%s does not end the connection", CASES[c].what);
        free(said);
        put_text(fd, "{\"do\": \"pause\"}"); /* must not arrive */
        close(fd);
        assert_int_equal(take_event(&client, text), JOX_VIEW_LEFT);
    }
    assert_int_equal(fetch_page("/"), 200);
}

/* Opens more silent connections than the server keeps unknown, while its patience is longer than
   the test. */
static void silent_connections_do_not_block_others(void **state) {
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
    view = open_view_at(0, NULL, 600.0); /* longer than the test */
    assert_int_equal(
        sscanf(jox_view_address(view), "http://127.0.0.1:%d/?token=%63s", &port, other), 2);
    snprintf(token, sizeof token, "%s", other);
    uint32_t client;
    const int page = join_page(&client);
    for (int i = 0; i < COUNT; i++)
        assert_true((idle[i] = connect_to(port)) >= 0);
    assert_int_equal(fetch_page("/"), 200);
    leave_page(join_page(&client));
    /* The page that was connected before stays */
    assert_true(put_text(page, "{\"do\": \"pause\"}"));
    char text[JOX_VIEW_MOST_COMMAND + 1];
    assert_int_equal(take_event(&client, text), JOX_VIEW_COMMAND);
    leave_page(page);
    for (int i = 0; i < COUNT; i++)
        close(idle[i]);
    jox_view_close(view);
    view = first;
    port = old;
    snprintf(token, sizeof token, "%s", kept);
    files.rlim_cur = before;
    setrlimit(RLIMIT_NOFILE, &files);
}

static void bad_ports_and_folders_are_reported(void **state) {
    (void)state;
    JoxView *second = open_view_at(0, NULL, 0);
    int next;
    assert_int_equal(sscanf(jox_view_address(second), "http://127.0.0.1:%d/", &next), 1);
    assert_true(next > port); /* the first port is in use */
    jox_view_close(second);
    JoxText why = {0};
    const char *page = test_path("page");
    JoxViewOptions options = {.page = page, .port = port};
    assert_null(jox_view_open(&options, &why));
    assert_non_null(strstr(why.data, "Address already in use"));
    jox_text_free(&why);
    options = (JoxViewOptions){.page = "/nowhere"};
    assert_null(jox_view_open(&options, &why));
    assert_non_null(strstr(why.data, "--page"));
    jox_text_free(&why);
    options = (JoxViewOptions){.page = page, .address = "not.an.address"};
    assert_null(jox_view_open(&options, &why));
    assert_non_null(strstr(why.data, "no address"));
    jox_text_free(&why);
    /* With an address given, any Host header is accepted; tokens are still required. */
    JoxView *open_to_all = open_view_at(0, "0.0.0.0", 0);
    char other[64], request[512];
    assert_int_equal(
        sscanf(jox_view_address(open_to_all), "http://127.0.0.1:%d/?token=%63s", &next, other), 2);
    for (int good = 0; good < 2; good++) {
        snprintf(request, sizeof request,
                 "GET /?token=%s HTTP/1.1\r\nHost: box.example:%d\r\nConnection: close\r\n\r\n",
                 good ? other : token, next);
        int fd = connect_to(next);
        assert_int_equal(send_request(fd, request, answer, sizeof answer), good ? 200 : 403);
        close(fd);
    }
    jox_view_close(open_to_all);
}

/* Servers that start at the same moment each find a port. */
static void servers_started_at_once_find_different_ports(void **state) {
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
                /* Waits until the parent closes the pipe */
                bool waited = read(begin[0], &c, 1) == 0;
                JoxText why = {0};
                JoxViewOptions options = {.page = "page"};
                JoxView *opened =
                    waited && !chdir(test_folder) ? jox_view_open(&options, &why) : NULL;
                if (!opened)
                    fprintf(stderr, "%s\n", why.data ? why.data : "no view");
                /* Keeps the port until all children have theirs */
                bool kept = opened && read(done[0], &c, 1) == 0;
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
        WITH_VIEW(page_is_served_with_security_headers),
        WITH_VIEW(files_outside_the_folders_are_refused),
        WITH_VIEW(requests_without_token_are_refused),
        WITH_VIEW(cookie_opens_files_but_no_socket),
        WITH_VIEW(page_for_frames_is_opened_by_its_path_alone),
        WITH_VIEW(other_hosts_and_methods_are_refused),
        WITH_VIEW(sockets_of_other_pages_are_refused),
        WITH_VIEW(commands_arrive_and_garbage_is_dropped),
        WITH_VIEW(huge_message_closes_the_connection),
        WITH_VIEW(malformed_frames_close_the_connection),
        WITH_VIEW(silent_connections_do_not_block_others),
        WITH_VIEW(bad_ports_and_folders_are_reported),
        cmocka_unit_test(servers_started_at_once_find_different_ports),
    };
    return cmocka_run_group_tests(tests, make_page_folder, remove_test_folder);
}
