/* Types and calls shared by the server's two threads: the stepping thread (publish.c), which
   creates the messages, and the serving thread (serving.c, lws_*.c), which sends them and owns the
   clients. Messages are handed over by atomic exchanges, so that neither thread waits for the
   other. */
#ifndef JOX_VIEW_VIEW_THREADS_H
#define JOX_VIEW_VIEW_THREADS_H

#include <stdatomic.h>

#include "base/mem.h"
#include "view/view.h"

enum {
    JOX_VIEW_FRAGMENT = 32768,       /* bytes written to a socket at once */
    JOX_VIEW_MOST_UNREAD = 32 << 20, /* bytes queued for one client */
    JOX_VIEW_MOST_WAITING = 1024,    /* commands that the stepping thread has not taken */
    JOX_VIEW_RATE = 200              /* commands per second of one client */
};

/* Requests to the serving thread. */
typedef enum JoxRequest { JOX_REQUEST_TEXT, JOX_REQUEST_LISTEN, JOX_REQUEST_FORGET } JoxRequest;

typedef struct JoxMessage {
    struct JoxMessage *next;
    size_t length, capacity;
    uint32_t client, refs;      /* refs: uses of a published message by the serving thread */
    uint32_t what;              /* JoxRequest to the serving thread, JoxViewTaken from it */
    uint32_t mask, epoch;       /* epoch: jox_view_withdraw_all calls before the message */
    struct JoxChannel *channel; /* its channel, if published; else NULL */
    unsigned char data[];
} JoxMessage;

/* A queue of messages from one thread to the other, without locks. */
typedef struct JoxPost {
    _Atomic(JoxMessage *) newest;
} JoxPost;
void jox_post_put(JoxPost *post, JoxMessage *message);
/* Takes all messages of the queue, the oldest first. */
JoxMessage *jox_post_take(JoxPost *post);

/* A stream of which browsers get the newest message only. Messages go from `spare` to `fresh` to
   `newest`, and back by `used`. */
typedef struct JoxChannel {
    _Atomic(JoxMessage *) fresh; /* published, not seen by the serving thread */
    JoxPost used;                /* sent, on the way back to the stepping thread */
    JoxMessage *spare;           /* the stepping thread's: messages to reuse */
    JoxMessage *newest;          /* the serving thread's: what clients are sent */
    uint64_t number;             /* counts `newest` messages; 0: none yet */
} JoxChannel;

/* A connected browser. Only the serving thread uses it. */
typedef struct JoxClient {
    struct lws *wsi;
    uint32_t id, mask;                       /* mask: channels that it gets, 1 << channel */
    JoxMessage *first, *last;                /* queue of messages that go to this client */
    size_t unread;                           /* bytes of the queue and of `sending` */
    JoxMessage *sending;                     /* message that is partly sent, or NULL */
    size_t sent;                             /* bytes of `sending` that are sent */
    bool text;                               /* `sending` is text, not binary */
    uint64_t seen[JOX_VIEW_CHANNELS];        /* number of the last message of each channel */
    uint32_t turn;                           /* channel that is considered next */
    char command[JOX_VIEW_MOST_COMMAND + 1]; /* command that is being received */
    size_t length;                           /* bytes received of it, also if it is too long */
    double allowance, since;                 /* commands that it may send now; s: last update */
    bool bad;                                /* to be disconnected */
} JoxClient;

struct JoxView {
    JoxHeap *heap; /* heap of all messages and clients */
    JoxChannel channels[JOX_VIEW_CHANNELS];
    JoxPost out, in;              /* requests to the serving thread; events from it */
    JoxMessage *taken;            /* the stepping thread's: rest of what it took from `in` */
    uint32_t epoch;               /* the stepping thread's: jox_view_withdraw_all calls */
    int wake;                     /* eventfd, readable when `in` has events */
    atomic_uint clients, waiting; /* connected; commands in `in` */
    atomic_ullong dropped;
    atomic_bool stop;
    struct JoxTransport *transport;
    void (*wake_transport)(JoxView *view); /* wakes the serving thread */
    JoxClient *connected[JOX_VIEW_CLIENTS];
    uint32_t next_id;
    char token[33]; /* in the address: opens page and socket */
    char pass[33];  /* in the cookie: opens the page's files only */
    int port;
    bool any_host;   /* an address was given: any Host header is accepted */
    char frame[512]; /* JoxViewOptions.frame; "" if no page may frame this one */
    char page[4096]; /* folder that is served */
    char address[320];
};

/* publish.c */
JoxView *jox_view_create(void);
void jox_view_free(JoxView *view);
JoxMessage *jox_message_create(const JoxView *view, size_t length);
/* Called by the serving thread: reports a command, or that a client joined or left. */
void jox_view_post_event(JoxView *view, uint32_t client, JoxViewTaken what, const char *text,
                         size_t length);
/* serving.c: the serving thread's side, independent of the transport. */
/* Takes the published messages and does the requests of the stepping thread. */
void jox_serving_fetch(JoxView *view);
/* Returns whether a client has something to be sent, or is to be disconnected. */
bool jox_serving_has_work(const JoxView *view, const JoxClient *client);
/* Sets client->sending to the next message: queued ones first, then the channels in turn. Returns
   false if there is none. */
bool jox_serving_choose_message(JoxView *view, JoxClient *client);
/* Releases client->sending after all of it was sent. */
void jox_serving_finish_message(JoxView *view, JoxClient *client);
/* Adds a client; NULL if JOX_VIEW_CLIENTS are connected. */
JoxClient *jox_serving_join(JoxView *view, struct lws *wsi);
void jox_serving_leave(JoxView *view, JoxClient *client);
/* Receives a part of a message from a client. A whole command is handed to the stepping thread,
   unless it is too long, too frequent or malformed. `now`: s of wall time. */
void jox_serving_receive(JoxView *view, JoxClient *client, const void *data, size_t length,
                         bool last, bool text, double now);

#endif
