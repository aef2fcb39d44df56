/* What the server's two threads share. The stepping thread owns what is made, the serving thread
   what is under way; messages change hands by atomic exchanges, so that neither waits. */
#ifndef JOX_VIEW_INTERNAL_H
#define JOX_VIEW_INTERNAL_H

#include <pthread.h>
#include <stdatomic.h>

#include "base/mem.h"
#include "view/view.h"

enum {
    JOX_VIEW_FRAGMENT = 32768,
    JOX_VIEW_MOST_UNREAD = 32 << 20,
    JOX_VIEW_MOST_WAITING = 1024, /* commands that were not taken yet */
    JOX_VIEW_RATE = 200           /* commands a second, of one client */
};

typedef enum JoxRequest { /* what a message asks of the serving thread */
                          JOX_REQUEST_TEXT,
                          JOX_REQUEST_LISTEN,
                          JOX_REQUEST_FORGET
} JoxRequest;

typedef struct JoxMessage {
    struct JoxMessage *next;
    size_t length, capacity;
    uint32_t client, refs;      /* refs: of the serving thread, for what is published */
    uint32_t what;              /* JoxRequest, or JoxViewTaken on the way back */
    uint32_t mask, epoch;       /* epoch: how often all had been forgotten */
    struct JoxChannel *channel; /* NULL: not published */
    unsigned char data[];
} JoxMessage;

/* Messages that one thread leaves for another. */
typedef struct JoxPost {
    _Atomic(JoxMessage *) newest;
} JoxPost;
void jox_post_put(JoxPost *post, JoxMessage *message);
/* All that was put, the oldest first. */
JoxMessage *jox_post_take(JoxPost *post);

typedef struct JoxChannel {
    _Atomic(JoxMessage *) fresh; /* not seen by the serving thread */
    JoxPost used;                /* back to the stepping thread */
    JoxMessage *spare;           /* the stepping thread's */
    JoxMessage *newest;          /* the serving thread's */
    uint64_t number;             /* of `newest`, from 1; 0: there is none */
} JoxChannel;

/* A connected browser; the serving thread's own. */
typedef struct JoxClient {
    struct lws *wsi;
    uint32_t id, mask;
    JoxMessage *first, *last; /* to be sent in order */
    size_t unread;            /* bytes of those */
    JoxMessage *sending;
    size_t sent; /* bytes of it */
    bool text;   /* whether it is text */
    uint64_t seen[JOX_VIEW_CHANNELS];
    uint32_t turn; /* the channel that is next */
    char command[JOX_VIEW_MOST_COMMAND + 1];
    size_t length; /* of the command as it comes in, also where it is too long */
    double allowance, since;
    bool bad; /* to be cut off */
} JoxClient;

struct JoxView {
    JoxHeap *heap; /* that what it holds and sends is allocated from */
    JoxChannel channels[JOX_VIEW_CHANNELS];
    JoxPost out, in;
    JoxMessage *taken; /* the stepping thread's: from `in`, in order */
    uint32_t epoch;    /* and how often it forgot */
    int wake;          /* eventfd: `in` has something */
    atomic_uint clients, waiting;
    atomic_ullong dropped;
    atomic_bool stop;
    struct JoxTransport *transport;
    void (*wake_transport)(JoxView *view); /* makes the serving thread look for messages */
    JoxClient *connected[JOX_VIEW_CLIENTS];
    uint32_t next_id;
    char token[33];
    char pass[33]; /* in the cookie: for the page's own files, and nothing else */
    int port;
    bool any_host; /* an address was given: requests may name it as they like */
    char page[4096], three[4096];
    char address[320];
};

/* hub.c */
JoxView *jox_view_create(void);
void jox_view_free(JoxView *view);
JoxMessage *jox_message_create(const JoxView *view, size_t length);
void jox_view_tell(JoxView *view, uint32_t client, JoxViewTaken what, const char *text,
                   size_t length);
/* serving.c: the serving thread's side, without the transport. */
/* Takes what the stepping thread left. */
void jox_serving_gather(JoxView *view);
bool jox_serving_has_work(const JoxView *view, const JoxClient *client);
/* Chooses what is sent next; false where there is nothing. */
bool jox_serving_choose(JoxView *view, JoxClient *client);
/* Ends a message that was sent. */
void jox_serving_sent(JoxView *view, JoxClient *client);
JoxClient *jox_serving_join(JoxView *view, struct lws *wsi);
void jox_serving_leave(JoxView *view, JoxClient *client);
/* A part of a message of the client; `now` in seconds. */
void jox_serving_receive(JoxView *view, JoxClient *client, const void *data, size_t length,
                         bool last, bool text, double now);

#endif
