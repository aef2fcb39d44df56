/* The interface of a live page's source: a running scene (scene_page.c) or a recording
   (replay_page.c). The page's loop (page.c) uses this interface alone. */
#ifndef JOX_LIVE_SOURCE_H
#define JOX_LIVE_SOURCE_H

#include "live/live.h"
#include "view/command.h"

/* X(verb, needs): the commands of pages, as {"do": "pause", "on": true}, with the members that each
   takes. `needs` is the answer of a source without that command. */
#define JOX_LIVE_VERBS(X)                                                                          \
    X(pause, "")   /* "on": true pauses, false continues */                                        \
    X(step, "")    /* "n": steps of a scene; frames of a recording, may be negative */             \
    X(speed, "")   /* "factor": pace, simulated seconds per second */                              \
    X(restart, "") /* "seed": of a scene; without it the present one */                            \
    X(play, JOX_LIVE_NEEDS_SCENE) /* the next round of a game, or "level": a new match */          \
    X(colour, "")                 /* "by": a name of JOX_LIVE_COLOURS */                           \
    X(scale, "") /* "fixed": whether ranges of values are the same for all scenes */               \
    X(field, "") /* "of": density, pressure or none */                                             \
    X(seek, JOX_LIVE_NEEDS_RECORDING) /* "time": s */                                              \
    X(input, JOX_LIVE_NEEDS_SCENE)    /* "line": as in an input log */                             \
    X(lua, JOX_LIVE_NEEDS_SCENE)      /* "machine", "state", "parameter", "value" */               \
    X(inspect, JOX_LIVE_NEEDS_SCENE)  /* "slot" of an agent, or "find": id, state or group */
#define JOX_LIVE_NEEDS_RECORDING "only a recording can be played from another time"
#define JOX_LIVE_NEEDS_SCENE "a recording cannot be changed: it can be played, paused and looked at"
typedef enum JoxLiveVerb {
#define X(verb, needs) JOX_LIVE_VERB_##verb,
    JOX_LIVE_VERBS(X)
#undef X
        JOX_LIVE_VERB_COUNT
} JoxLiveVerb;

/* A command and the browser that sent it. Valid within the call. */
typedef struct JoxLiveRequest {
    struct JoxLivePage *page;
    uint32_t client;
    const JoxCommand *command;
} JoxLiveRequest;

/* The functions of a source; `self` is the source itself. All are called by the page's loop,
   between two steps. Functions that write a message replace the content of `out`. */
typedef struct JoxLiveSource {
    /* The colour and the field that a browser begins with. */
    JoxLiveColour (*colour)(const void *self);
    JoxLiveField (*field)(const void *self);
    /* {"type": "scene", ...}; and a number that changes when that message does. */
    void (*scene)(void *self, JoxText *out);
    uint64_t (*version)(const void *self);
    /* {"type": "status", ...}; `now`: wall time, s. */
    void (*status)(void *self, double now, JoxText *out);
    /* Binary messages, see live.h. */
    void (*pack_frame)(void *self, JoxLiveColour colour, JoxBytes *out);
    bool (*pack_people)(void *self, JoxBytes *out);
    void (*pack_field)(void *self, JoxLiveField field, JoxBytes *out);
    /* Each may be NULL. `greet` sends further messages to a client (or JOX_VIEW_ALL) after the
       scene message; `report` sends further messages with each status; `left` is called when a
       client has disconnected. */
    void (*greet)(void *self, uint32_t client);
    void (*report)(void *self);
    void (*left)(void *self, uint32_t client);
    /* Steps or plays if that is due at wall time `now`, s; returns the time until the next call is
       due, s, 0 for at once. */
    double (*advance)(void *self, double now);
    /* By command. NULL: the source lacks it, or page_commands.c handles it (colour, field, scale,
     * speed).
     */
    void (*verbs[JOX_LIVE_VERB_COUNT])(void *self, const JoxLiveRequest *request);
} JoxLiveSource;

#endif
