/* The live page's server: files of the page and one web socket, on a thread of its own. What is
   published never waits for a browser; what browsers say is taken between two steps.

   All functions but jox_view_wait return at once. They are for one thread, which steps. */
#ifndef JOX_VIEW_VIEW_H
#define JOX_VIEW_VIEW_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/text.h"

enum {
    JOX_VIEW_PORT = 8730,        /* the first that is tried */
    JOX_VIEW_PORTS = 100,        /* how many are tried */
    JOX_VIEW_CLIENTS = 16,       /* at once */
    JOX_VIEW_MOST_COMMAND = 4096 /* bytes of a command */
};

/* What is published goes by channels; of each only the newest is sent. Those from
   JOX_VIEW_FIRST_TEXT on are JSON, the others bytes. */
enum {
    JOX_VIEW_FRAMES = 0,  /* and what is coloured otherwise: up to 12 */
    JOX_VIEW_FIELDS = 12, /* up to 3 */
    JOX_VIEW_FIRST_TEXT = 16,
    JOX_VIEW_STATUS = 16,
    JOX_VIEW_CHANNELS = 20
};
enum { JOX_VIEW_ALL = 0 }; /* in place of a client */

typedef struct JoxViewOptions {
    const char *address; /* to listen at; NULL: 127.0.0.1, and requests must name this machine */
    int port;            /* 0: JOX_VIEW_PORT and upwards, the first that is free */
    const char *page;    /* folder with index.html */
    const char *three;   /* folder that is served at /three/ */
    double patience;     /* s that a connection may take over its headers; 0: 5 */
} JoxViewOptions;

typedef struct JoxView JoxView;

/* NULL, with what is wrong and the way out appended to `why`. */
JoxView *jox_view_open(const JoxViewOptions *options, JoxText *why);
/* Ends all connections. NULL is fine. */
void jox_view_close(JoxView *view);
/* "http://127.0.0.1:8730/?token=..." */
const char *jox_view_address(const JoxView *view);
/* How many are connected. */
uint32_t jox_view_clients(const JoxView *view);
/* Messages of browsers that were dropped: too long, too many, no JSON, no command. */
uint64_t jox_view_dropped(const JoxView *view);
/* Counts one more of them. */
void jox_view_drop(JoxView *view);

/* What a channel shows from here on, copied; it takes the place of what was not sent yet. */
void jox_view_publish(JoxView *view, uint32_t channel, const void *bytes, size_t length);
/* Sends JSON to one client or JOX_VIEW_ALL, in order, and before what is published after
   it. A client that leaves more than 32 MiB unread is cut off. */
void jox_view_send(JoxView *view, uint32_t client, const char *text);
/* From here on this client gets the channels of a mask (1 << channel); none at first. */
void jox_view_listen(JoxView *view, uint32_t client, uint32_t channels);
/* Forgets what was published: another scene begins. */
void jox_view_forget(JoxView *view);

typedef enum JoxViewTaken {
    JOX_VIEW_NOTHING,
    JOX_VIEW_COMMAND, /* `text` is a JSON object that jox_command_read reads */
    JOX_VIEW_JOINED,  /* a new client, which knows nothing yet */
    JOX_VIEW_LEFT
} JoxViewTaken;
/* The next that happened; `text` has room for JOX_VIEW_MOST_COMMAND + 1 bytes. */
JoxViewTaken jox_view_take(JoxView *view, uint32_t *client, char *text, size_t capacity);
/* Waits until something can be taken, at most `seconds`. */
void jox_view_wait(JoxView *view, double seconds);

#endif
