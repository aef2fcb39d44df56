/* What the files scene_*.c share: a scene that runs on its live page. */
#ifndef JOX_LIVE_SCENE_PAGE_H
#define JOX_LIVE_SCENE_PAGE_H

#include "base/mem.h"
#include "live/page.h"
#include "run/run.h"

/* Files that were saved and could not be loaded. */
typedef struct JoxLiveFileErrors {
    bool parts[JOX_PARTS]; /* what the files are parts of; none: a scene that was to begin anew */
    JoxDiagnostics errors;
} JoxLiveFileErrors;

/* A page that inspects an agent. */
typedef struct JoxLiveInspector {
    uint32_t client; /* 0: this row is free */
    uint32_t slot, id;
} JoxLiveInspector;

/* The push that an agent has been given by hand before the step that comes. */
typedef struct JoxHandPush {
    uint64_t tick;
    uint32_t agent;
    double x, y; /* N */
} JoxHandPush;

enum { JOX_HAND_PUSHES = 16 }; /* agents who are pushed at a time, at most */

typedef struct JoxScenePage {
    JoxLivePage page;
    const JoViewDef *def;
    JoSceneDef scene_def; /* with the seed of the present run */
    JoScene *scene;
    uint64_t steps; /* to be done while paused */
    double until;   /* s of simulated time, at which it pauses by itself */
    double began;   /* s of wall time at which the last step was due */
    double opened;  /* s of wall time at which it could first be looked at */
    bool seen;      /* time no longer waits for the first page */
    bool failed;    /* the run cannot go on, for this reason: */
    char failure[1024];
    bool reported; /* errors that pages were sent as data are being printed */
    JoxLiveInspector inspectors[JOX_VIEW_CLIENTS];
    JoxHandPush pushes[JOX_HAND_PUSHES];
    uint32_t push_count; /* ever; they are kept in a ring */
    JoxLiveFileErrors *errors;
    size_t error_count, error_capacity;
} JoxScenePage;

/* scene_page.c: what the page asks of a scene; `self` is a JoxScenePage. */
extern const JoxLiveSource jox_scene_page_source;
/* scene_load.c: loads the scene, with everything that is written of it; false with `error`, and
   the scene that ran before goes on. */
bool jox_scene_page_load(JoxScenePage *scene, JoError *error);
/* Ends the scene and what is written of it. */
bool jox_scene_page_end(JoxScenePage *scene, JoError *error);
/* scene_errors.c: a JoxDiagnosed whose context is the JoxScenePage. */
void jox_scene_page_diagnosed(void *scene, const bool *parts, const JoxDiagnostics *diagnostics);
/* Sends a client, or all, what is wrong with files. */
void jox_scene_page_send_errors(void *scene, uint32_t client);
void jox_scene_page_forget_errors(JoxScenePage *scene);
/* scene_verbs.c: what people do, by verb. */
void jox_scene_page_pause(void *scene, const JoxLiveRequest *request);
void jox_scene_page_step(void *scene, const JoxLiveRequest *request);
void jox_scene_page_restart(void *scene, const JoxLiveRequest *request);
void jox_scene_page_input(void *scene, const JoxLiveRequest *request);
void jox_scene_page_lua(void *scene, const JoxLiveRequest *request);
/* scene_inspectors.c: each page inspects an agent of its own, and is told of it with each status.
 */
void jox_scene_page_inspect(void *scene, const JoxLiveRequest *request);
void jox_scene_page_send_inspected(void *scene);
void jox_scene_page_left(void *scene, uint32_t client);

#endif
