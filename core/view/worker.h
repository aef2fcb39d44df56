/* The calls of the host of a page that has no server (worker.c): it passes the messages of one
   browser on by itself, as a browser's worker does for the page in the same tab. Only in builds
   whose view is worker.c (scripts/wasm). */
#ifndef JOX_VIEW_WORKER_H
#define JOX_VIEW_WORKER_H

#include "view/view.h"

/* Connects the page and returns its number as a client; 0 if there is one already. */
uint32_t jox_worker_join(JoxView *view);
/* Receives a command of the page: `length` bytes of JSON. It counts as dropped if it is none. */
void jox_worker_receive(JoxView *view, const char *json, size_t length);

typedef struct JoxWorkerMessage {
    const void *bytes; /* JSON, or bytes of a channel below JOX_VIEW_FIRST_TEXT */
    size_t length;
    int32_t channel; /* -1: one of jox_view_send */
} JoxWorkerMessage;
/* Takes the next message for the page: first what was queued, then of each channel the newest. It
   stays valid until the next call for the view. False if there is none. A host that takes messages
   only after the page has handled the last ones thus never falls behind. */
bool jox_worker_next(JoxView *view, JoxWorkerMessage *message);

#endif
