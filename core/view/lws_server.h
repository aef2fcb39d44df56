/* Shared by the files that call libwebsockets: lws_server.c runs the serving thread and its
   connections, lws_http.c answers requests. */
#ifndef JOX_VIEW_LWS_SERVER_H
#define JOX_VIEW_LWS_SERVER_H

#include <libwebsockets.h>
#include <pthread.h>

#include "view/view_threads.h"

enum { JOX_VIEW_UNKNOWN = 48 }; /* most connections without a valid token */

typedef struct JoxTransport {
    struct lws_context *context;
    struct lws_vhost *vhost;
    pthread_t thread;
    bool running;
    struct lws *unknown[JOX_VIEW_UNKNOWN]; /* connections that have not shown a token yet, the
                                              oldest first */
    unsigned unknown_count;
    unsigned char scratch[LWS_PRE + JOX_VIEW_FRAGMENT];
} JoxTransport;

/* Data of a connection, kept by libwebsockets. */
typedef struct JoxSession {
    JoxClient *client; /* client of a web socket; else NULL */
} JoxSession;

/* lws_http.c: answers a request for a file. Returns what libwebsockets expects: nonzero closes the
   connection. */
int jox_http_serve_file(JoxView *view, struct lws *wsi, const char *path);
/* Returns 0 if a web socket may be opened; otherwise answers with the reason and returns the value
   for libwebsockets. */
int jox_http_check_upgrade(JoxView *view, struct lws *wsi, const char *to);

/* Removes a connection from `unknown`: it has shown a token, or is closed. */
void jox_http_drop_from_unknown(JoxView *view, const struct lws *wsi);

#endif
