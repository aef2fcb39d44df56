/* The live page: the browsers that look at a source, what each of them is shown, and when. */
#ifndef JOX_LIVE_PAGE_H
#define JOX_LIVE_PAGE_H

#include "live/source.h"
#include "view/view.h"

/* Channels of the server, beside those that it names. */
enum {
    JOX_LIVE_PEOPLE_CHANNEL = JOX_VIEW_FIRST_TEXT - 1,
    JOX_LIVE_TIME_CHANNEL = JOX_VIEW_STATUS + 1 /* of recordings */
};

/* What a browser wants to be shown. */
typedef struct JoxLiveWatcher {
    uint32_t client; /* 0: this row is free */
    JoxLiveColour colour;
    JoxLiveField field;
} JoxLiveWatcher;

typedef struct JoxLivePage {
    const JoxLiveSource *source;
    void *self; /* the source's own */
    JoxView *server;
    JoxLiveSession session;
    JoxLiveWatcher watchers[JOX_VIEW_CLIENTS];
    uint64_t version;               /* of the scene message that was sent last */
    double last_frame, last_status; /* s of wall time; 0: the next is due at once */
    bool changed;                   /* what is shown is not what is there */
    bool people_sent;               /* since the last scene message */
    JoxBytes bytes, people;
    JoxText text;
} JoxLivePage;

/* Serves the page. `folder`, `three`: NULL, or where its files and three.js are. */
bool jox_live_page_open(JoxLivePage *page, const char *address, int port, const char *folder,
                        const char *three, JoError *error);
/* Ends all connections, and frees what the page holds; of one that was not opened too. */
void jox_live_page_close(JoxLivePage *page);
/* Does what browsers ask, advances the source, and shows it, until `*stop` (NULL: for ever). */
void jox_live_page_run(JoxLivePage *page, const volatile int *stop);
/* What was sent before is of another scene: browsers get the whole anew. */
void jox_live_page_begin(JoxLivePage *page);

/* {"type": "say", ...} to a client or JOX_VIEW_ALL; `level` is "info", "warning" or "error". */
void jox_live_say(JoxLivePage *page, uint32_t client, const char *level, const char *text);
/* {"type": "refused", ...}: the answer to a command that cannot be done. */
void jox_live_refuse(const JoxLiveRequest *request, const char *why);

/* page_verbs.c: does a command of a watcher, as it came. */
void jox_live_do(JoxLivePage *page, JoxLiveWatcher *watcher, const char *json);
/* Tells the server which channels a browser is to get. */
void jox_live_listen(JoxLivePage *page, const JoxLiveWatcher *watcher);

#endif
