/* A minimal browser for tests of the server, on raw sockets: HTTP requests, the handshake and the
   frames of a web socket. */
#ifndef JOX_TESTS_VIEW_CLIENT_H
#define JOX_TESTS_VIEW_CLIENT_H

#include <arpa/inet.h>
#include <errno.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

static inline double clock_now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

/* Connects to a port of this machine; returns the socket, or -1. */
static inline int connect_to(int port) {
    int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0), one = 1;
    struct sockaddr_in to = {.sin_family = AF_INET,
                             .sin_port = htons((uint16_t)port),
                             .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    if (fd >= 0 && connect(fd, (struct sockaddr *)&to, sizeof to) != 0) {
        close(fd);
        return -1;
    }
    setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
    return fd;
}

/* Sends all bytes; false if the connection is closed. */
static inline bool send_bytes(int fd, const void *data, size_t length) {
    const char *at = data;
    while (length > 0) {
        ssize_t n = send(fd, at, length, MSG_NOSIGNAL);
        if (n <= 0)
            return false;
        at += n;
        length -= (size_t)n;
    }
    return true;
}

/* Receives up to `length` bytes within `seconds`. Returns how many; 0 if the connection is closed,
   -1 if nothing came in time. */
static inline ssize_t receive_bytes(int fd, void *data, size_t length, double seconds) {
    struct pollfd wait = {.fd = fd, .events = POLLIN};
    if (poll(&wait, 1, (int)(seconds * 1e3)) <= 0)
        return -1;
    ssize_t n = recv(fd, data, length, 0);
    return n < 0 ? 0 : n; /* a reset counts as closed */
}

static inline bool receive_all(int fd, void *data, size_t length, double seconds) {
    char *at = data;
    double until = clock_now() + seconds;
    while (length > 0) {
        ssize_t n = receive_bytes(fd, at, length, until - clock_now());
        if (n <= 0)
            return false;
        at += n;
        length -= (size_t)n;
    }
    return true;
}

/* Sends a request and reads the answer until the connection is closed (send "Connection: close"),
   or the headers of an upgrade. Returns the status; 0 if no answer came. */
static inline int send_request(int fd, const char *request, char *answer, size_t size) {
    size_t n = 0;
    answer[0] = 0;
    if (!send_bytes(fd, request, strlen(request)))
        return 0;
    while (n + 1 < size) {
        ssize_t got = receive_bytes(fd, answer + n,
                                    strstr(request, "Upgrade: websocket") ? 1 : size - n - 1, 20.0);
        if (got <= 0)
            break;
        n += (size_t)got;
        answer[n] = 0;
        if (strstr(request, "Upgrade: websocket") && strstr(answer, "\r\n\r\n"))
            break;
    }
    int status = 0;
    return sscanf(answer, "HTTP/1.%*d %d", &status) == 1 ? status : 0;
}

/* Opens a web socket with a token; -1 with the HTTP status if it is refused. */
static inline int open_socket_as(int port, const char *host, const char *origin, const char *token,
                                 int *status) {
    char request[1024], answer[2048];
    int fd = connect_to(port);
    if (fd < 0)
        return -1;
    snprintf(request, sizeof request,
             "GET /socket%s%s HTTP/1.1\r\nHost: %s\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
             "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n"
             "Sec-WebSocket-Protocol: jostle\r\n%s%s%s\r\n",
             token ? "?token=" : "", token ? token : "", host, origin ? "Origin: " : "",
             origin ? origin : "", origin ? "\r\n" : "");
    *status = send_request(fd, request, answer, sizeof answer);
    if (*status == 101 && strstr(answer, "s3pPLMBiTxaQ9kYGzzhZRbK+xOo="))
        return fd;
    close(fd);
    return -1;
}

static inline int open_socket(int port, const char *token) {
    char host[64], origin[80];
    int status;
    snprintf(host, sizeof host, "127.0.0.1:%d", port);
    snprintf(origin, sizeof origin, "http://%s", host);
    return open_socket_as(port, host, origin, token, &status);
}

enum { FRAME_TEXT = 1, FRAME_BINARY = 2, FRAME_CLOSE = 8, FRAME_PING = 9, FRAME_PONG = 10 };

/* Sends a masked frame, as browsers do; `first` and `last` mark the first and last frame of a
   message. */
static inline bool send_frame(int fd, int kind, bool first, bool last, const void *data,
                              size_t length) {
    static const uint8_t mask[4] = {0x12, 0x34, 0x56, 0x78};
    uint8_t head[14];
    size_t n = 2;
    head[0] = (uint8_t)((last ? 0x80 : 0) | (first ? kind : 0));
    if (length < 126) {
        head[1] = (uint8_t)(0x80 | length);
    } else if (length < 65536) {
        head[1] = 0x80 | 126;
        head[n++] = (uint8_t)(length >> 8);
        head[n++] = (uint8_t)length;
    } else {
        head[1] = 0x80 | 127;
        for (int i = 7; i >= 0; i--)
            head[n++] = (uint8_t)((uint64_t)length >> (8 * i));
    }
    memcpy(head + n, mask, 4);
    n += 4;
    uint8_t *masked = malloc(length + n);
    memcpy(masked, head, n);
    for (size_t i = 0; i < length; i++)
        masked[n + i] = ((const uint8_t *)data)[i] ^ mask[i & 3];
    bool good = send_bytes(fd, masked, n + length);
    free(masked);
    return good;
}

static inline bool put_text(int fd, const char *text) {
    return send_frame(fd, FRAME_TEXT, true, true, text, strlen(text));
}

/* Receives a whole message, to be freed; NULL with *kind 0 if none came in time. Answers pings. */
static inline char *get_message(int fd, int *kind, size_t *length, double seconds) {
    char *message = NULL;
    size_t n = 0;
    *kind = 0;
    for (;;) {
        uint8_t head[8];
        if (!receive_all(fd, head, 2, seconds))
            break;
        int opcode = head[0] & 15;
        bool last = head[0] & 0x80;
        uint64_t size = head[1] & 127;
        int more = size == 126 ? 2 : size == 127 ? 8 : 0;
        if (more && !receive_all(fd, head, (size_t)more, seconds))
            break;
        if (more)
            size = 0;
        for (int i = 0; i < more; i++)
            size = size << 8 | head[i];
        if (size > 64 << 20)
            break;
        message = realloc(message, n + size + 1);
        if (!receive_all(fd, message + n, size, seconds))
            break;
        if (opcode == FRAME_PING) {
            send_frame(fd, FRAME_PONG, true, true, message + n, size);
            continue;
        }
        n += size;
        message[n] = 0;
        *kind = opcode ? opcode : *kind;
        if (last) {
            *length = n;
            return message;
        }
    }
    free(message);
    *kind = 0;
    return NULL;
}

#endif
