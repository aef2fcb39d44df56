/* The live page: the loop over a source (source.h), the browsers that are connected, and what each
   of them is sent. scene_page.c and replay_page.c open, run and close it; all is on one thread,
   that of the caller; the server (view/view.h) has its own. */
#ifndef JOX_LIVE_PAGE_H
#define JOX_LIVE_PAGE_H

#include "live/source.h"
#include "view/view.h"

/* Channels of the server in addition to those of view.h. */
enum {
    JOX_LIVE_PEOPLE_CHANNEL = JOX_VIEW_FIRST_TEXT - 1,
    JOX_LIVE_TIME_CHANNEL = JOX_VIEW_STATUS + 1 /* used by recordings alone */
};

/* A connected browser, and the colour and field that it asked for. */
typedef struct JoxLiveWatcher {
    uint32_t client; /* the server's number of it; 0: this row is free */
    JoxLiveColour colour;
    JoxLiveField field;
} JoxLiveWatcher;

typedef struct JoxLivePage {
    const JoxLiveSource *source;
    void *self; /* passed to the source's functions */
    JoxView *server;
    JoxLiveSession session;
    JoxLiveScales scales;
    JoxLiveWatcher watchers[JOX_VIEW_CLIENTS];
    uint64_t version;               /* the source's version when the scene was last sent */
    double last_frame, last_status; /* wall time, s; 0: the next is due at once */
    bool changed;                   /* the source has changed since the last frame was sent */
    bool people_sent;               /* the people message was sent since the last scene message */
    JoxBytes bytes, people;         /* scratch; the last people message */
    JoxText text;                   /* scratch */
} JoxLivePage;

/* Starts the server. A folder of NULL in `options` is that of the installation. False with
   `error` if the address cannot be served. */
bool jox_live_page_open(JoxLivePage *page, const JoxViewOptions *options, JoError *error);
/* Ends all connections and frees the page's buffers. A page that was not opened is fine. */
void jox_live_page_close(JoxLivePage *page);
/* Does one turn of the loop: handles the commands of browsers, advances the source, and sends what
   is due. Returns the time until the next turn is due, s. */
double jox_live_page_turn(JoxLivePage *page);
/* Runs the loop until `*stop` is set (NULL: for ever). */
void jox_live_page_run(JoxLivePage *page, const volatile int *stop);
/* Sends all browsers the scene message, and forgets what was sent before: the source shows another
   scene or run from now on. */
void jox_live_page_begin(JoxLivePage *page);

/* Sends {"type": "say", ...} to all clients; `level` is "info", "warning" or "error". */
void jox_live_say(JoxLivePage *page, const char *level, const char *text);
/* Answers a command that cannot be carried out by {"type": "refused", ...}. */
void jox_live_refuse(const JoxLiveRequest *request, const char *why);

/* page_commands.c: parses a browser's command and carries it out, or refuses it. */
void jox_live_run_command(JoxLivePage *page, JoxLiveWatcher *watcher, const char *json);
/* Tells the server which channels a browser receives. */
void jox_live_set_channels(JoxLivePage *page, const JoxLiveWatcher *watcher);

#endif
