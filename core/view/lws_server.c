/* Opens the server and runs the serving thread: ports, connections and web sockets, by
   libwebsockets. */
#include <errno.h>
#include <netinet/in.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <arpa/inet.h>

#include "base/clock.h"
#include "base/mem.h"
#include "task/thread.h"
#include "view/access.h"
#include "view/lws_server.h"

enum { PATIENCE = 5, PING = 15, HANG_UP = 30 }; /* s */
enum { SEND_BUFFER = 128 << 10, MOST_CONNECTIONS = 512 };

/* Sends queued data to a client until the socket is full, at most 8 fragments, so that each client
   gets its turn. */
static int write_socket(JoxView *view, JoxClient *client) {
    unsigned char *to = view->transport->scratch + LWS_PRE;
    for (int i = 0; i < 8; i++) {
        if (client->bad)
            return -1;
        if (lws_send_pipe_choked(client->wsi))
            break;
        if (!jox_serving_choose_message(view, client))
            return 0;
        const JoxMessage *message = client->sending;
        size_t n = message->length - client->sent;
        n = n < JOX_VIEW_FRAGMENT ? n : JOX_VIEW_FRAGMENT;
        bool first = client->sent == 0, last = client->sent + n == message->length;
        int flags =
            lws_write_ws_flags(client->text ? LWS_WRITE_TEXT : LWS_WRITE_BINARY, first, last);
        memcpy(to, message->data + client->sent, n);
        if (lws_write(client->wsi, to, n, (enum lws_write_protocol)flags) < (int)n)
            return -1;
        client->sent += n;
        if (last)
            jox_serving_finish_message(view, client);
    }
    if (jox_serving_has_work(view, client))
        lws_callback_on_writable(client->wsi);
    return 0;
}

/* Fetches new messages, asks to write to clients that need them, and disconnects bad ones. */
static void schedule_writes(JoxView *view) {
    jox_serving_fetch(view);
    for (uint32_t c = 0; c < JOX_VIEW_CLIENTS; c++) {
        JoxClient *client = view->connected[c];
        if (client && client->bad) /* not left to a write: it may never be writable */
            lws_set_timeout(client->wsi, PENDING_TIMEOUT_USER_OK, LWS_TO_KILL_ASYNC);
        else if (client && jox_serving_has_work(view, client))
            lws_callback_on_writable(client->wsi);
    }
}

static int join_client(JoxView *view, struct lws *wsi, JoxSession *session) {
    int size = SEND_BUFFER; /* small, so that old frames do not queue in the kernel */
    setsockopt(lws_get_socket_fd(wsi), SOL_SOCKET, SO_SNDBUF, &size, sizeof size);
    session->client = jox_serving_join(view, wsi);
    return session->client ? 0 : -1;
}

/* Registers a new connection as unknown until its request shows a token. If there are too many, the
   oldest one is closed. */
static void add_unknown(JoxView *view, struct lws *wsi) {
    JoxTransport *t = view->transport;
    if (t->unknown_count == JOX_VIEW_UNKNOWN) {
        lws_set_timeout(t->unknown[0], PENDING_TIMEOUT_USER_OK, LWS_TO_KILL_ASYNC);
        jox_http_drop_from_unknown(view, t->unknown[0]);
    }
    t->unknown[t->unknown_count++] = wsi;
}

/* Handles an event of libwebsockets. */
static int handle_event(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in,
                        size_t length) {
    JoxSession *session = user;
    JoxView *view = wsi ? lws_context_user(lws_get_context(wsi)) : NULL;
    JoxClient *client = session ? session->client : NULL;
    switch (reason) {
    case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
        schedule_writes(view);
        return 0;
    case LWS_CALLBACK_SERVER_NEW_CLIENT_INSTANTIATED:
        add_unknown(view, wsi);
        return 0;
    case LWS_CALLBACK_WSI_DESTROY:
        jox_http_drop_from_unknown(view, wsi);
        return 0;
    case LWS_CALLBACK_HTTP:
        return jox_http_serve_file(view, wsi, in);
    case LWS_CALLBACK_RAW_ADOPT: /* reached by the method CONNECT */
    case LWS_CALLBACK_RAW_RX:
    case LWS_CALLBACK_HTTP_BODY: /* no request here may have a body */
        return -1;
    case LWS_CALLBACK_HTTP_CONFIRM_UPGRADE:
        return jox_http_check_upgrade(view, wsi, in);
    case LWS_CALLBACK_ESTABLISHED:
        return join_client(view, wsi, session);
    case LWS_CALLBACK_SERVER_WRITEABLE:
        return client ? write_socket(view, client) : 0;
    case LWS_CALLBACK_RECEIVE:
        if (!client)
            return -1;
        jox_serving_receive(view, client, in, length,
                            lws_is_final_fragment(wsi) && lws_remaining_packet_payload(wsi) == 0,
                            !lws_frame_is_binary(wsi), jox_clock_wall());
        return client->bad ? -1 : 0;
    case LWS_CALLBACK_CLOSED:
        if (client)
            jox_serving_leave(view, client);
        session->client = NULL;
        return 0;
    default:
        return lws_callback_http_dummy(wsi, reason, user, in, length);
    }
}

/* Handles an event; if memory runs out, closes only the connection concerned. */
static int guard_event(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in,
                       size_t length) {
    JoxRecovery recovery;
    jox_recovery_push(&recovery);
    if (setjmp(recovery.jump) != 0)
        return -1;
    int result = handle_event(wsi, reason, user, in, length);
    jox_recovery_pop(&recovery);
    return result;
}

static const struct lws_protocols PROTOCOLS[] = {{.name = "jostle",
                                                  .callback = guard_event,
                                                  .per_session_data_size = sizeof(JoxSession),
                                                  .rx_buffer_size = 4096},
                                                 {0}};

/* Browsers answer pings by themselves; a connection that does not is dead. */
static const lws_retry_bo_t LIVENESS = {.secs_since_valid_ping = PING,
                                        .secs_since_valid_hangup = HANG_UP};

static void *run_server(void *argument) {
    JoxView *view = argument;
    jox_heap_use(view->heap);
    while (!atomic_load(&view->stop) && lws_service(view->transport->context, 0) >= 0)
        ;
    return NULL;
}

static void wake_server(JoxView *view) {
    if (view->transport && view->transport->running)
        lws_cancel_service(view->transport->context);
}

/* Tests whether the port can be bound: 0 or errno. */
static int try_port(const char *address, int port) {
    struct sockaddr_storage to = {0};
    struct sockaddr_in *four = (struct sockaddr_in *)&to;
    struct sockaddr_in6 *six = (struct sockaddr_in6 *)&to;
    socklen_t size = sizeof *four;
    if (inet_pton(AF_INET, address, &four->sin_addr) == 1) {
        four->sin_family = AF_INET;
        four->sin_port = htons((uint16_t)port);
    } else if (inet_pton(AF_INET6, address, &six->sin6_addr) == 1) {
        six->sin6_family = AF_INET6;
        six->sin6_port = htons((uint16_t)port);
        size = sizeof *six;
    } else {
        return EINVAL;
    }
    int one = 1, fd = socket(to.ss_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (fd < 0)
        return errno;
    setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &one, sizeof one);
    int failed = bind(fd, (struct sockaddr *)&to, size) || listen(fd, 1) ? errno : 0;
    close(fd);
    return failed;
}

static bool has_file(const char *folder, const char *name) {
    char path[4200];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return access(path, R_OK) == 0;
}

/* Checks the options; appends the fault to `why`. */
static bool check_view_options(const JoxViewOptions *options, const char *address, JoxText *why) {
    if (!options->page || !has_file(options->page, "index.html"))
        jox_text_printf(why,
                        "the live page is not in '%s' (no index.html there): run make, which "
                        "bundles it, install Jostle, or give its folder by --page",
                        options->page ? options->page : "");
    else if (options->frame &&
             !jox_access_sources_are_clean(options->frame, sizeof((JoxView *)0)->frame))
        jox_text_printf(why,
                        "'%s' does not name pages that may show this one in a frame: a list as "
                        "'http://localhost:8888 https://notes.example', separated by spaces",
                        options->frame);
    else if (options->port < 0 || options->port > 65535)
        jox_text_printf(why, "there is no port %d", options->port);
    else if (try_port(address, 0) == EINVAL)
        jox_text_printf(why, "'%s' is no address of this machine, as 127.0.0.1 or 0.0.0.0 is",
                        address);
    else
        return true;
    return false;
}

/* Set when an allocation of libwebsockets fails on this thread. */
static _Thread_local bool is_out_of_memory;

/* The allocator of libwebsockets: allocates, grows, or frees if `size` is 0. */
static void *reallocate_lws(void *memory, size_t size, const char *reason) {
    (void)reason;
    if (size == 0) {
        free(memory);
        return NULL;
    }
    void *made = realloc(memory, size);
    is_out_of_memory |= !made;
    return made;
}

/* Creates a context of libwebsockets that listens at view->port. Returns false if that fails, also
   if memory ran out on the way: libwebsockets would go on without some of its tables, and crash at
   the first request. */
static bool listen_at_port(JoxView *view, const char *address, double patience) {
    JoxTransport *transport = view->transport;
    struct rlimit files;
    rlim_t most = MOST_CONNECTIONS; /* and at most half of the allowed descriptors */
    if (getrlimit(RLIMIT_NOFILE, &files) == 0 && files.rlim_cur / 2 < most)
        most = files.rlim_cur / 2;
    unsigned seconds = patience >= 1.0 ? (unsigned)patience : PATIENCE;
    bool six = strchr(address, ':') != NULL;
    struct lws_context_creation_info info = {
        .port = view->port,
        .iface = address,
        .protocols = PROTOCOLS,
        .user = view,
        .fd_limit_per_thread = (unsigned)most,
        .timeout_secs = seconds,
        .timeout_secs_ah_idle = seconds,
        .keepalive_timeout = (int)seconds,
        .retry_and_idle_policy = &LIVENESS,
        .vhost_name = "jostle",
        .server_string = "jostle",
        .options = LWS_SERVER_OPTION_EXPLICIT_VHOSTS | LWS_SERVER_OPTION_FAIL_UPON_UNABLE_TO_BIND |
                   LWS_SERVER_OPTION_VALIDATE_UTF8 | (six ? 0 : LWS_SERVER_OPTION_DISABLE_IPV6)};
    lws_set_log_level(0, NULL);
    lws_set_allocator(reallocate_lws);
    is_out_of_memory = false;
    struct sigaction before; /* lws_create_context sets SIGPIPE to be ignored; it is restored, as
                                lws sends with MSG_NOSIGNAL */
    sigaction(SIGPIPE, NULL, &before);
    transport->context = lws_create_context(&info);
    sigaction(SIGPIPE, &before, NULL);
    transport->vhost = transport->context ? lws_create_vhost(transport->context, &info) : NULL;
    if (transport->vhost && !is_out_of_memory)
        return true;
    if (transport->context)
        lws_context_destroy(transport->context);
    transport->context = NULL;
    transport->vhost = NULL;
    return false;
}

/* Listens at the first free port. If another program takes it between the test and libwebsockets'
   own bind, it counts as in use. */
static bool listen_at_free_port(JoxView *view, const JoxViewOptions *options, const char *address,
                                JoxText *why) {
    int first = options->port ? options->port : JOX_VIEW_PORT;
    int count = options->port ? 1 : JOX_VIEW_PORTS, failed = 0;
    for (int p = first; p < first + count; p++) {
        failed = try_port(address, p);
        view->port = p;
        if (!failed && listen_at_port(view, address, options->patience))
            return true;
        if (!failed && is_out_of_memory)
            failed = ENOMEM;
        if (failed && failed != EADDRINUSE)
            break;
    }
    jox_text_printf(why, "cannot listen at %s, port %d: %s%s", address, first,
                    strerror(failed ? failed : EADDRINUSE),
                    failed == ENOMEM ? "" : "; --view=PORT takes another");
    return false;
}

/* Ends the serving thread and closes its connections. */
static void stop_server(void *opened) {
    JoxView *view = opened;
    JoxTransport *transport = view->transport;
    if (transport && transport->running) {
        atomic_store(&view->stop, true);
        lws_cancel_service(transport->context);
        pthread_join(transport->thread, NULL);
    }
    if (transport && transport->context)
        lws_context_destroy(transport->context);
    if (view->wake >= 0)
        close(view->wake);
    view->wake = -1;
}

JoxView *jox_view_open(const JoxViewOptions *options, JoxText *why) {
    const char *address = options->address ? options->address : "127.0.0.1";
    if (!check_view_options(options, address, why))
        return NULL;
    JoxView *view = jox_heap_register(jox_view_create(), stop_server);
    view->transport = jox_alloc(1, sizeof *view->transport);
    view->wake_transport = wake_server;
    view->any_host = options->address != NULL;
    snprintf(view->page, sizeof view->page, "%s", options->page);
    snprintf(view->frame, sizeof view->frame, "%s", options->frame ? options->frame : "");
    bool good =
        jox_access_make_token(view->token) && jox_access_make_token(view->pass) && view->wake >= 0;
    if (!good)
        jox_text_add(why, "the system has no random numbers or no file descriptors left");
    good = good && listen_at_free_port(view, options, address, why);
    if (good) {
        JoxTransport *transport = view->transport;
        good = transport->running = jox_thread_start(&transport->thread, run_server, view);
        if (!good)
            jox_text_add(why, "cannot start a thread that serves the live page");
    }
    if (!good) {
        jox_view_close(view);
        return NULL;
    }
    /* If it listens at all addresses, the page is opened by a local one. */
    bool any = !strcmp(address, "0.0.0.0") || !strcmp(address, "::");
    bool six = strchr(address, ':') && !any;
    snprintf(view->address, sizeof view->address, "http://%s%s%s:%d/%s%s%s", six ? "[" : "",
             any ? "127.0.0.1" : address, six ? "]" : "", view->port,
             options->frame ? "" : "?token=", view->token, options->frame ? "/" : "");
    return view;
}

void jox_view_close(JoxView *view) {
    if (!view)
        return;
    jox_heap_unregister(view);
    stop_server(view);
    jox_free(view->transport);
    view->transport = NULL;
    jox_view_free(view);
}
