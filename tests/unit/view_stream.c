/* The live page's server under load: nobody holds it up, and nothing is left behind. */
#include <malloc.h>
#include <sys/resource.h>

#include "unit/view_open.h"

static void who_says_too_much_is_not_heard(void **state) {
    (void)state;
    enum { SAID = 1000 };
    uint32_t client, from;
    char text[JOX_VIEW_MOST_COMMAND + 1];
    int fd = join(&client), heard = 0;
    double begun = clock_now();
    for (int i = 0; i < SAID; i++)
        assert_true(put_text(fd, "{\"do\": \"pause\"}"));
    while (heard + (int)jox_view_dropped(view) < SAID && take(&from, text) == JOX_VIEW_COMMAND)
        heard++;
    while (jox_view_take(view, &from, text, sizeof text) == JOX_VIEW_COMMAND)
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
    char *message = get_message(other, &kind, &length, 10.0);
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
    char first;
    assert_int_equal(get(half[HALF - 1], &first, 1, 0.0), -1); /* which are still there */
    int gone = 0;
    for (int i = 0; i < HALF; i++) {
        char block[512];
        ssize_t n;
        while ((n = get(half[i], block, sizeof block, 30.0 - (clock_now() - begun))) > 0)
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
        jox_view_send(view, client, "{\"type\": \"scene\"}");
        jox_view_listen(view, client, 1u << JOX_VIEW_FRAMES);
        jox_view_publish(view, JOX_VIEW_FRAMES, frame, sizeof frame);
        char *message = get_message(fd, &kind, &length, 10.0);
        assert_non_null(message);
        assert_int_equal(kind, FRAME_TEXT);
        free(message);
        if (i % 3 == 0) { /* some wait for the frame, some vanish under way */
            message = get_message(fd, &kind, &length, 10.0);
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
    assert_true(longest < 10.0);
}

/* How often this thread has waited for something. */
static long waits(void) {
    struct rusage usage;
    getrusage(RUSAGE_THREAD, &usage);
    return usage.ru_nvcsw;
}

static void a_slow_reader_gets_the_newest(void **state) {
    (void)state;
    enum { FRAMES = 400, SIZE = 300000 };
    uint32_t client, number;
    int fd = join(&client), kind, received = 0, slept = 0;
    jox_view_listen(view, client, 1u << JOX_VIEW_FRAMES);
    char *frame = calloc(SIZE, 1), *message;
    long waited = waits();
    for (uint32_t i = 1; i <= FRAMES; i++) {
        memcpy(frame, &i, sizeof i);
        memcpy(frame + SIZE - sizeof i, &i, sizeof i);
        jox_view_publish(view, JOX_VIEW_FRAMES, frame, SIZE);
        if (i % 8 == 0) {
            slept++;
            usleep(4000);
        }
    }
    waited = waits() - waited;
    assert_in_range(waited, 0, slept + 10); /* memory may be late, browsers are not waited for */
    uint32_t last = 0;
    size_t length;
    while (last != FRAMES && (message = get_message(fd, &kind, &length, 10.0)) != NULL) {
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
            char *message = get_message(fd, &kind, &length, 10.0);
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

static void the_last_page_may_stay(void **state) {
    (void)state;
    uint32_t client;
    int fd = join(&client);
    jox_view_send(view, client, "{\"type\": \"say\"}"); /* unread, and closed under it */
    jox_view_close(view);
    view = open_with(0, NULL, 3.0);
    close(fd);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        WITH_VIEW(who_says_too_much_is_not_heard),
        WITH_VIEW(noise_harms_nobody),
        WITH_VIEW(half_open_connections_do_not_stay),
        WITH_VIEW(there_is_room_for_so_many_pages),
        WITH_VIEW(pages_come_and_go),
        WITH_VIEW(a_slow_reader_gets_the_newest),
        WITH_VIEW(who_never_reads_is_cut_off),
        WITH_VIEW(what_is_sent_precedes_what_is_published_after),
        WITH_VIEW(the_last_page_may_stay),
    };
    return cmocka_run_group_tests(tests, make_pages, remove_pages);
}
