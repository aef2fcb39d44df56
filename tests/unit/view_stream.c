/* Tests of the live page's server under load: no browser delays it, and connections leave nothing
   behind. */
#include <malloc.h>
#include <sys/resource.h>

#include "base/process_memory.h"
#include "unit/view_open.h"

static void commands_above_the_rate_are_dropped(void **state) {
    (void)state;
    enum { SAID = 1000 };
    uint32_t client, from;
    char text[JOX_VIEW_MOST_COMMAND + 1];
    int fd = join_page(&client), heard = 0;
    double begun = clock_now();
    for (int i = 0; i < SAID; i++)
        assert_true(put_text(fd, "{\"do\": \"pause\"}"));
    while (heard + (int)jox_view_dropped(view) < SAID &&
           take_event(&from, text) == JOX_VIEW_COMMAND)
        heard++;
    while (jox_view_next_event(view, &from, text, sizeof text) == JOX_VIEW_COMMAND)
        heard++;
    double took = clock_now() - begun;
    assert_int_equal(heard + (int)jox_view_dropped(view), SAID);
    /* A burst of 200, and 200 per second */
    assert_true(heard >= 200 && heard <= 200 + 200 * took + 1);
    leave_page(fd);
}

static void random_bytes_do_not_disturb_other_pages(void **state) {
    (void)state;
    uint32_t client, random = 12345;
    enum { NOISE = 1 << 20 };
    char *noise = malloc(NOISE);
    for (int i = 0; i < NOISE; i++) {
        random = random * 1664525u + 1013904223u;
        noise[i] = (char)(random >> 24);
    }
    int other = join_page(&client), fd = connect_to(port);
    send_bytes(fd, noise, NOISE); /* instead of a request */
    close(fd);
    fd = join_page(&client);
    send_bytes(fd, noise, NOISE); /* instead of frames */
    leave_page(fd);
    for (int i = 0; i < 64; i++) { /* requests with random bytes at each place */
        char request[256];
        int n = snprintf(request, sizeof request, "GET /?token=%s HTTP/1.1\r\nHost: 127.0.0.1:%d",
                         token, port);
        memcpy(request + i, noise + i * 16, 16);
        fd = connect_to(port);
        send_bytes(fd, request, (size_t)n);
        send_bytes(fd, "\r\n\r\n", 4);
        close(fd);
    }
    free(noise);
    assert_int_equal(fetch_page("/"), 200);
    jox_view_send(view, 0, "{\"type\": \"say\"}");
    int kind;
    size_t length;
    char *message = get_message(other, &kind, &length, 10.0);
    assert_non_null(message);
    assert_string_equal(message, "{\"type\": \"say\"}");
    free(message);
    leave_page(other);
}

static void half_open_connections_are_closed(void **state) {
    (void)state;
    enum { HALF = 300 };
    static int half[HALF];
    for (int i = 0; i < HALF; i++) {
        half[i] = connect_to(port);
        assert_true(half[i] >= 0);
        if (i % 3 == 1)
            send_bytes(half[i], "GET / HT", 8);
        if (i % 3 == 2)
            send_bytes(half[i], "GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nX-Long: ", 41);
    }
    double begun = clock_now();
    assert_int_equal(fetch_page("/"), 200); /* served at once */
    char first;
    /* The half-open ones are still connected */
    assert_int_equal(receive_bytes(half[HALF - 1], &first, 1, 0.0), -1);
    int gone = 0;
    for (int i = 0; i < HALF; i++) {
        char block[512];
        ssize_t n;
        while ((n = receive_bytes(half[i], block, sizeof block, 30.0 - (clock_now() - begun))) > 0)
            ;
        gone += n == 0;
        close(half[i]);
    }
    assert_int_equal(gone, HALF);
}

static void seventeenth_page_is_refused(void **state) {
    (void)state;
    int fds[JOX_VIEW_CLIENTS], status;
    uint32_t client;
    char host[64], origin[80];
    snprintf(host, sizeof host, "127.0.0.1:%d", port);
    snprintf(origin, sizeof origin, "http://%s", host);
    for (int i = 0; i < JOX_VIEW_CLIENTS; i++)
        fds[i] = join_page(&client);
    assert_int_equal(jox_view_clients(view), JOX_VIEW_CLIENTS);
    assert_int_equal(open_socket_as(port, host, origin, token, &status), -1);
    assert_int_equal(status, 503);
    leave_page(fds[0]);
    fds[0] = join_page(&client);
    for (int i = 0; i < JOX_VIEW_CLIENTS; i++)
        leave_page(fds[i]);
    assert_int_equal(jox_view_clients(view), 0);
}

/* Returns the bytes that are allocated in all arenas. */
static size_t count_allocated_bytes(void) {
    struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

static void pages_that_come_and_go_leak_nothing(void **state) {
    (void)state;
    const char *more = getenv("JOSTLE_VIEW_CYCLES"); /* long test runs set it */
    int cycles = more ? atoi(more) : 1000;
    static char frame[20000];
    size_t before = 0, at_first = 0;
    double longest = 0.0, begun = clock_now();
    for (int i = 0; i < cycles + 100; i++) {
        uint32_t client;
        double from = clock_now();
        int fd = join_page(&client), kind;
        size_t length;
        jox_view_send(view, client, "{\"type\": \"scene\"}");
        jox_view_listen(view, client, 1u << JOX_VIEW_FRAMES);
        jox_view_publish(view, JOX_VIEW_FRAMES, frame, sizeof frame);
        char *message = get_message(fd, &kind, &length, 10.0);
        assert_non_null(message);
        assert_int_equal(kind, FRAME_TEXT);
        free(message);
        if (i % 3 == 0) { /* some wait for the frame, some leave before */
            message = get_message(fd, &kind, &length, 10.0);
            assert_non_null(message);
            assert_int_equal(length, sizeof frame);
            free(message);
        }
        if (i % 3 == 1)
            send_frame(fd, FRAME_CLOSE, true, true, "\x03\xe8", 2);
        leave_page(fd);
        double took = clock_now() - from;
        longest = took > longest ? took : longest;
        if (i == 99) {
            before = count_allocated_bytes();
            at_first = (size_t)jox_read_process_memory().resident;
        }
    }
    size_t after = count_allocated_bytes(), at_last = (size_t)jox_read_process_memory().resident;
    print_message("%d pages in %.1f s, the slowest %.1f ms; %zu kB resident before, %zu after\n",
                  cycles, clock_now() - begun, longest * 1e3, at_first / 1000, at_last / 1000);
    if (after > before + 65536)
        fail_msg("%zu bytes in use after, %zu before", after, before);
#ifndef __SANITIZE_ADDRESS__ /* it keeps freed memory for a while */
    assert_true(at_last < at_first + (4 << 20));
#endif
    assert_true(longest < 10.0);
}

/* Returns how often this thread has waited (voluntary context switches). */
static long count_waits(void) {
    struct rusage usage;
    getrusage(RUSAGE_THREAD, &usage);
    return usage.ru_nvcsw;
}

static void slow_reader_gets_the_newest_frame(void **state) {
    (void)state;
    enum { FRAMES = 400, SIZE = 300000 };
    uint32_t client, number;
    int fd = join_page(&client), kind, received = 0, slept = 0;
    jox_view_listen(view, client, 1u << JOX_VIEW_FRAMES);
    char *frame = calloc(SIZE, 1), *message;
    long waited = count_waits();
    for (uint32_t i = 1; i <= FRAMES; i++) {
        memcpy(frame, &i, sizeof i);
        memcpy(frame + SIZE - sizeof i, &i, sizeof i);
        jox_view_publish(view, JOX_VIEW_FRAMES, frame, SIZE);
        if (i % 8 == 0) {
            slept++;
            usleep(4000);
        }
    }
    waited = count_waits() - waited;
    assert_in_range(waited, 0, slept + 10); /* 10: waits for memory; none for a browser */
    uint32_t last = 0;
    size_t length;
    while (last != FRAMES && (message = get_message(fd, &kind, &length, 10.0)) != NULL) {
        assert_int_equal(kind, FRAME_BINARY);
        assert_int_equal(length, SIZE);
        memcpy(&number, message, sizeof number);
        assert_true(number > last); /* in order and whole; some are left out */
        last = number;
        memcpy(&number, message + SIZE - sizeof number, sizeof number);
        assert_int_equal(number, last);
        received++;
        free(message);
    }
    assert_int_equal(last, FRAMES);
    assert_true(received < FRAMES / 2);
    free(frame);
    leave_page(fd);
}

static void client_that_never_reads_is_disconnected(void **state) {
    (void)state;
    uint32_t client;
    int fd = join_page(&client);
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
    assert_int_equal(take_event(&client, said), JOX_VIEW_LEFT);
    close(fd);
}

static void text_arrives_before_frames_published_later(void **state) {
    (void)state;
    uint32_t client;
    int fd = join_page(&client), kind;
    size_t length;
    jox_view_listen(view, client, 1u << JOX_VIEW_FRAMES | 1u << JOX_VIEW_STATUS);
    for (int i = 0; i < 200; i++) {
        char text[32];
        jox_view_publish(view, JOX_VIEW_FRAMES, "old", 3);
        snprintf(text, sizeof text, "{\"hello\": %d}", i);
        jox_view_withdraw_all(view);
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
    leave_page(fd);
}

static void view_can_be_closed_with_a_page_connected(void **state) {
    (void)state;
    uint32_t client;
    int fd = join_page(&client);
    jox_view_send(view, client, "{\"type\": \"say\"}"); /* still unread when the view is closed */
    jox_view_close(view);
    view = open_view_at(0, NULL, 3.0);
    close(fd);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        WITH_VIEW(commands_above_the_rate_are_dropped),
        WITH_VIEW(random_bytes_do_not_disturb_other_pages),
        WITH_VIEW(half_open_connections_are_closed),
        WITH_VIEW(seventeenth_page_is_refused),
        WITH_VIEW(pages_that_come_and_go_leak_nothing),
        WITH_VIEW(slow_reader_gets_the_newest_frame),
        WITH_VIEW(client_that_never_reads_is_disconnected),
        WITH_VIEW(text_arrives_before_frames_published_later),
        WITH_VIEW(view_can_be_closed_with_a_page_connected),
    };
    return cmocka_run_group_tests(tests, make_page_folder, remove_test_folder);
}
