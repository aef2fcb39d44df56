/* What the files that know the transport share. */
#ifndef JOX_VIEW_LWS_SERVER_H
#define JOX_VIEW_LWS_SERVER_H

#include <libwebsockets.h>

#include "view/internal.h"

enum { JOX_VIEW_UNKNOWN = 48 }; /* connections at most that have not shown the token */

typedef struct JoxTransport {
    struct lws_context *context;
    struct lws_vhost *vhost;
    pthread_t thread;
    bool running;
    struct lws *unknown[JOX_VIEW_UNKNOWN]; /* the oldest first */
    unsigned unknown_count;
    unsigned char scratch[LWS_PRE + JOX_VIEW_FRAGMENT];
} JoxTransport;

/* What is kept of a connection. */
typedef struct JoxSession {
    JoxClient *client; /* of a socket */
} JoxSession;

/* lws_http.c: answers a request for a file. As the transport wants: nonzero closes. */
int jox_http_answer(JoxView *view, struct lws *wsi, const char *path);
/* Whether a socket may be opened: 0, or what the transport is to be told after a refusal. */
int jox_http_upgrade(JoxView *view, struct lws *wsi, const char *to);

/* It has shown the token or the pass, or is gone: it is no longer among the unknown. */
void jox_http_is_known(JoxView *view, const struct lws *wsi);

#endif
