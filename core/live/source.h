/* What a live page shows: a running scene (scene_page.c) or a recording (replay_page.c). The page
   itself (page.c) knows no more of either than this interface. */
#ifndef JOX_LIVE_SOURCE_H
#define JOX_LIVE_SOURCE_H

#include "live/live.h"
#include "view/command.h"

/* X(verb, needs): the commands of pages, {"do": "pause", "on": true}. `needs` is what a source that
   has no such verb answers. */
#define JOX_LIVE_VERBS(X)                                                                          \
    X(pause, "")   /* "on"; false: go on */                                                        \
    X(step, "")    /* "n": steps of a scene, frames of a recording, which may be negative */       \
    X(speed, "")   /* "factor": seconds shown in a second */                                       \
    X(restart, "") /* "seed": of a scene, the same unless it is given */                           \
    X(colour, "")  /* "by": a name of JOX_LIVE_COLOURS */                                          \
    X(field, "")   /* "of": density, pressure or none */                                           \
    X(seek, JOX_LIVE_NEEDS_RECORDING) /* "time": s */                                              \
    X(input, JOX_LIVE_NEEDS_SCENE)    /* "line": as in an input log */                             \
    X(lua, JOX_LIVE_NEEDS_SCENE)      /* "machine", "state", "parameter", "value" */               \
    X(inspect, JOX_LIVE_NEEDS_SCENE)  /* "slot"; null: nobody */
#define JOX_LIVE_NEEDS_RECORDING "a running scene has no other times: only a recording does"
#define JOX_LIVE_NEEDS_SCENE "what is recorded has happened: it can be played, paused and looked at"
typedef enum JoxLiveVerb {
#define X(verb, needs) JOX_LIVE_VERB_##verb,
    JOX_LIVE_VERBS(X)
#undef X
        JOX_LIVE_VERB_COUNT
} JoxLiveVerb;

/* A command of a page, as a source is handed it. */
typedef struct JoxLiveRequest {
    struct JoxLivePage *page;
    uint32_t client;
    const JoxCommand *command;
} JoxLiveRequest;

/* Of a source: `self` is the source's own. All are called between two steps. The functions that
   write a message replace what `out` held. */
typedef struct JoxLiveSource {
    /* What is shown first. */
    JoxLiveColour (*colour)(const void *self);
    JoxLiveField (*field)(const void *self);
    /* {"type": "scene", ...}, and another number whenever it says something else. */
    void (*scene)(void *self, JoxText *out);
    uint64_t (*version)(const void *self);
    /* {"type": "status", ...}; `now`: s of wall time. */
    void (*status)(void *self, double now, JoxText *out);
    /* Binary messages, see live.h. */
    void (*pack_frame)(void *self, JoxLiveColour colour, JoxBytes *out);
    bool (*pack_people)(void *self, JoxBytes *out);
    void (*pack_field)(void *self, JoxLiveField field, JoxBytes *out);
    /* Sends what else there is: to a client (or JOX_VIEW_ALL) that was sent the scene; with each
       status. A client left. NULL: nothing to do. */
    void (*greet)(void *self, uint32_t client);
    void (*report)(void *self);
    void (*left)(void *self, uint32_t client);
    /* Does what is due; s of wall time until something is due again, 0: at once. */
    double (*advance)(void *self, double now);
    /* NULL: the source has no such verb, or it is common to all: colour, field, speed. */
    void (*verbs[JOX_LIVE_VERB_COUNT])(void *self, const JoxLiveRequest *request);
} JoxLiveSource;

#endif
