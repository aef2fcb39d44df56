/* What the files view*.c share: a scene that runs on its live page. */
#ifndef JOX_LIVE_VIEW_PARTS_H
#define JOX_LIVE_VIEW_PARTS_H

#include "live/live.h"
#include "run/run.h"
#include "view/command.h"
#include "view/view.h"

/* What each page wants to be shown. */
typedef struct JoxWatcher {
    uint32_t client; /* 0: this place is free */
    JoxLiveColour colour;
    JoxLiveField field;
} JoxWatcher;

/* Files that were saved and could not go live. */
typedef struct JoxMistake {
    bool parts[JOX_PARTS]; /* what they are parts of; none: a scene that was to begin anew */
    JoxDiagnostics errors;
} JoxMistake;

typedef struct JoxViewing {
    const JoViewDef *def;
    JoSceneDef scene_def; /* with the seed of the present run */
    JoxView *view;
    JoScene *scene;
    JoxLiveSession session;
    uint64_t steps; /* to be done while paused */
    double until;   /* s, at which it pauses by itself */
    bool failed;    /* the run cannot go on, for this reason: */
    char failure[1024];
    bool changed; /* what is shown is not what is there */
    bool told;    /* diagnostics that were handed over are being printed */
    JoxWatcher watchers[JOX_VIEW_CLIENTS];
    uint32_t inspector; /* the client who looks at somebody closely; 0: nobody */
    uint32_t inspected; /* the slot of whom */
    uint64_t version;   /* of the hello that was sent */
    JoxMistake *mistakes;
    size_t mistake_count, mistake_capacity;
    double due, showed, spoke; /* s of wall time: next step, last frame, last status */
    bool people_known;
    JoxBytes frame, people, field;
    JoxText text;
} JoxViewing;

/* {"type": "say", ...} */
void jox_view_say(JoxView *view, uint32_t client, const char *level, const char *text);
/* {"type": "refused", ...} */
void jox_view_refuse(JoxView *view, uint32_t client, const char *verb, const char *text);

/* view_load.c: loads the scene, with everything that is written of it; false with `error`, and
   the scene that ran before goes on. */
bool jox_viewing_load(JoxViewing *viewing, JoError *error);
/* Ends the scene and what is written of it. */
bool jox_viewing_end(JoxViewing *viewing, JoError *error);
/* view_mistakes.c: a JoxDiagnosed whose context is the viewing. */
void jox_viewing_diagnosed(void *viewing, const bool *parts, const JoxDiagnostics *diagnostics);
/* Tells a client, or all, what is wrong with files. */
void jox_viewing_tell_mistakes(JoxViewing *viewing, uint32_t client);
void jox_viewing_forget_mistakes(JoxViewing *viewing);
/* view_do.c: whatever pages said since, done. */
void jox_viewing_take(JoxViewing *viewing);
/* view_show.c: sends what is due; `step`: after a step. */
void jox_viewing_show(JoxViewing *viewing, double now);
/* Sends what is known of the one who is inspected; of nobody, and there is an end of it. */
void jox_viewing_inspect(JoxViewing *viewing);
void jox_viewing_greet(JoxViewing *viewing, uint32_t client);
/* Which channels a page is to hear. */
uint32_t jox_viewing_channels(const JoxWatcher *watcher);

#endif
