/* Live pages: a browser on this machine shows a running scene or a recording, and lets people act
 * on the scene. Part of libjostle-tools; jostle_tools.h includes this header, and says what holds
 * for its calls. */
#ifndef JOSTLE_LIVE_H
#define JOSTLE_LIVE_H

#include "jostle.h"

#ifdef __cplusplus
extern "C" {
#endif

struct JoVetter;

/* Definition of a live page: a browser on this machine shows a running scene and lets people act
   on it. */
typedef struct JoViewDef {
    JoSceneDef scene;
    const char *address; /* address to listen at; NULL: 127.0.0.1, for this machine alone */
    int port;            /* 0: 8730, or the next free port */
    const char *page;    /* folder of the page's files; NULL: where they were installed */
    bool fast;           /* run as fast as possible, not in real time */
    double wait;         /* s: the run begins when a browser has opened the page, and at the latest
                            after this time; default 0. Ignored with `fast` */
    bool watch;          /* reload edited files; default true */
    /* reads edited files first, and all files at a restart; NULL: no vetting (JoVetter of
     * jostle_tools.h) */
    const struct JoVetter *vetter;
    double seconds; /* simulated time, s, after which the run pauses; 0: the scene's duration */
    /* files for trajectories and for the input log, or NULL; after a restart the run writes to
       NAME-2.EXT, the next restart to NAME-3.EXT; numbers that a file has already are left out */
    const char *record;
    double record_every; /* s between recorded frames, as for jo_scene_record */
    const char *log_input;
    const char *const *breaks; /* breakpoints, as of jo_scene_break, at which the page pauses */
    size_t break_count;
    const volatile int *stop; /* the call returns once this int is not 0; NULL: only on errors */
    JoMessage *opened;        /* receives the page's address once it can be opened; may be NULL */
    void *opened_context;
    /* Called with the scene before its first step, and again after each restart, to set up further
       outputs such as jo_scene_checkpoint; may be NULL. False with `error`: the run does
       not begin; jo_view fails with this error, or after a restart the page shows it. */
    bool (*begun)(void *context, JoScene *scene, JoError *error);
    /* Called before `begun` with the files that the run writes, or NULL; may be NULL. */
    void (*writes)(void *context, const char *record, const char *log_input);
    void *begun_context;
    char **summary; /* receives jo_scene_summary at the end of the run, to be freed with jo_free;
                       may be NULL */
    uint32_t cookie;
} JoViewDef;
JO_API JoViewDef jo_default_view_def(void);
/* Runs the scene and serves the page until `stop`. False with `error` if the page cannot be served,
   the scene does not load, or the run ended with troubles (jo_scene_troubles); every error of the
   scene went to the scene's `message`. */
JO_API bool jo_view(const JoViewDef *def, JoError *error);

/* A live page of a scene that the program itself loads, steps and frees. Unlike jo_view its calls
   do not block: a program calls jo_live_serve between its own steps, or instead of them, as from
   the loop of a notebook. All its calls and those of the scene come from one thread at a time. */
typedef struct JoLive JoLive;
typedef struct JoLiveDef {
    const char *address; /* address, port, and page are as in JoViewDef */
    int port;
    const char *page;
    /* pages that may show this one in a frame, as "http://localhost:8888 http://127.0.0.1:*":
       sources of the directive frame-ancestors of Content-Security-Policy, separated by spaces. The
       address then has its token in its path: who knows it acts on the scene. NULL: none may */
    const char *frame;
    bool running; /* begins to run at once; default: paused, so that only the program steps it */
    bool watch;   /* reload edited files from now on, as jo_scene_watch; default true */
    uint32_t cookie;
} JoLiveDef;
JO_API JoLiveDef jo_default_live_def(void);
/* Opens a page, paused, which shows the scene as it is. NULL with `error` if it cannot be served.
   Close it before the scene is freed. Messages of the scene also go to the page. */
JO_API JoLive *jo_live_open(JoScene *scene, const JoLiveDef *def, JoError *error);
/* Returns the address to open. */
JO_API const char *jo_live_address(const JoLive *live);
/* Returns the number of browsers that show the page now. */
JO_API uint32_t jo_live_watchers(const JoLive *live);
/* Serves the page for `seconds` of wall time, or, with 0, once: shows the scene as it is, carries
   out what people do on the page, and while they let it run makes the steps that are due. Returns
   the time until the next call is due, s, at most 0.05. A scene whose step fails stays paused; its
   next jo_scene_step tells why. Not to be called within a callback of the scene's steps. */
JO_API double jo_live_serve(JoLive *live, double seconds);
/* Serves the page once without making steps: for a program to call after its own, so that they are
   all that happens meanwhile. */
JO_API void jo_live_show(JoLive *live);
/* Ends all connections and frees the page; the scene goes on. NULL is fine. */
JO_API void jo_live_close(JoLive *live);

/* Definition of a live page that shows a recording, in any format that jo_report reads. */
typedef struct JoViewRecordingDef {
    const char *recording;
    /* scene whose places are drawn, and what else the recording lacks; NULL: the recording alone */
    const char *scene;
    double fps;          /* frames a second; 0: as the recording says */
    double unit;         /* m: unit of the recording's lengths; 0: as it says */
    const char *address; /* address, page and port are as in JoViewDef */
    const char *page;
    int port;
    const char *frame;        /* as in JoLiveDef */
    const volatile int *stop; /* the call returns once this int is not 0; NULL: only on errors */
    JoMessage *opened;        /* receives the page's address once it can be opened; may be NULL */
    void *opened_context;
    JoMessage *message; /* NULL: to stderr */
    void *message_context;
    uint32_t cookie;
} JoViewRecordingDef;
JO_API JoViewRecordingDef jo_default_view_recording_def(void);
/* Serves the page until `stop`. False with `error` if the page cannot be served or the recording
   cannot be read; every error in the recording went to `message`. */
JO_API bool jo_view_recording(const JoViewRecordingDef *def, JoError *error);

/* Describes what pages draw of a scene besides people, as one JSON object: the message "scene" of
   core/live/README.md, with "title", "walls", "places", "regions", "groups" and "states", each with
   its colour. Does not change the run. */
JO_API char *jo_scene_plan(JoScene *scene);

#ifdef __cplusplus
}
#endif

#endif
