/* The live page's server: it serves the page's files and one web socket per browser, on a thread of
   its own. core/live publishes frames and status here, and takes the commands of browsers between
   two steps. Publishing never waits for a browser.

   All functions except jox_view_wait return at once. Only the stepping thread may call them. */
#ifndef JOX_VIEW_VIEW_H
#define JOX_VIEW_VIEW_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/text.h"

enum {
    JOX_VIEW_PORT = 8730,        /* first port that is tried */
    JOX_VIEW_PORTS = 100,        /* ports that are tried */
    JOX_VIEW_CLIENTS = 16,       /* browsers at once */
    JOX_VIEW_MOST_COMMAND = 4096 /* bytes of a command from a browser */
};

/* Channels: of each, a browser gets only the newest message. Channels from JOX_VIEW_FIRST_TEXT on
   are JSON, the others binary. */
enum {
    JOX_VIEW_FRAMES = 0,  /* frames, one channel per colouring: 12 channels */
    JOX_VIEW_FIELDS = 12, /* fields: 3 channels */
    JOX_VIEW_FIRST_TEXT = 16,
    JOX_VIEW_STATUS = 16,
    JOX_VIEW_CHANNELS = 20
};
enum { JOX_VIEW_ALL = 0 }; /* all clients */

typedef struct JoxViewOptions {
    const char *address; /* to listen at; NULL: 127.0.0.1, with requests for local names only */
    int port;            /* 0: the first free one from JOX_VIEW_PORT on */
    const char *page;    /* folder with index.html */
    double patience;     /* s that a connection has to send its headers; 0: 5 */
    /* Pages that may show this page in a frame: sources as of the directive frame-ancestors of
       Content-Security-Policy, separated by spaces. The address then has its token in the path,
       and no cookie is set: browsers send none to a frame of another site. NULL: no page may. */
    const char *frame;
} JoxViewOptions;

typedef struct JoxView JoxView;

/* Starts the server. On failure returns NULL and appends the fault and a way out to `why`. */
JoxView *jox_view_open(const JoxViewOptions *options, JoxText *why);
/* Closes all connections, ends the thread, and frees the view. NULL is fine. */
void jox_view_close(JoxView *view);
/* Returns the page's address with its token: "http://127.0.0.1:8730/?token=...", or
   "http://127.0.0.1:8730/TOKEN/" of a page for frames. */
const char *jox_view_address(const JoxView *view);
/* Returns the number of connected browsers. */
uint32_t jox_view_clients(const JoxView *view);
/* Returns how many messages of browsers were dropped: too long, too many, no JSON, no command. */
uint64_t jox_view_dropped(const JoxView *view);
/* Counts one more dropped message. */
void jox_view_drop(JoxView *view);

/* Publishes a copy of `bytes` on a channel, in place of what was not sent yet. */
void jox_view_publish(JoxView *view, uint32_t channel, const void *bytes, size_t length);
/* Queues JSON for one client or JOX_VIEW_ALL; it is sent before anything that is published later. A
   client that leaves more than 32 MiB unread is disconnected. */
void jox_view_send(JoxView *view, uint32_t client, const char *text);
/* Sets the channels that a client gets, as a mask of 1 << channel; at first none. */
void jox_view_listen(JoxView *view, uint32_t client, uint32_t channels);
/* Withdraws all that was published, as another scene begins. */
void jox_view_withdraw_all(JoxView *view);

typedef enum JoxViewTaken {
    JOX_VIEW_NOTHING,
    JOX_VIEW_COMMAND, /* `text` is a JSON object that jox_command_read reads */
    JOX_VIEW_JOINED,  /* a new client: it gets nothing until jox_view_listen */
    JOX_VIEW_LEFT
} JoxViewTaken;
/* Takes the next event and its client; `text`, with room for JOX_VIEW_MOST_COMMAND + 1 bytes,
   receives a command. */
JoxViewTaken jox_view_next_event(JoxView *view, uint32_t *client, char *text, size_t capacity);
/* Waits until there is an event to take, at most `seconds`. */
void jox_view_wait(JoxView *view, double seconds);

#endif
