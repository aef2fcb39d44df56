/* The live page of a running scene, shared by the files scene_*.c. scene_page.c has the source
   (source.h) that page.c steps. */
#ifndef JOX_LIVE_SCENE_PAGE_H
#define JOX_LIVE_SCENE_PAGE_H

#include "base/mem.h"
#include "live/page.h"
#include "run/run.h"

/* Errors of one attempt to load files. */
typedef struct JoxLiveFileErrors {
    bool parts[JOX_PARTS]; /* parts of the scene that the files hold; all false: a restart */
    JoxDiagnostics errors;
} JoxLiveFileErrors;

/* A browser and the agent that it inspects. */
typedef struct JoxLiveInspector {
    uint32_t client;   /* 0: this row is free */
    uint32_t slot, id; /* the inspected agent; the id tells whether the slot still holds it */
} JoxLiveInspector;

/* The force that browsers have put on an agent for the coming step. */
typedef struct JoxHandPush {
    uint64_t tick;
    uint32_t agent; /* id */
    double x, y;    /* N */
} JoxHandPush;

enum { JOX_HAND_PUSHES = 16 }; /* the most agents that can be pushed by hand in a step */

typedef struct JoxScenePage {
    JoxLivePage page;
    const JoViewDef *def;
    JoSceneDef scene_def; /* with the seed of the present run */
    JoScene *scene;
    uint64_t steps;         /* still to be made while paused (command `step`) */
    double until;           /* simulated time at which the run pauses by itself, s */
    double began;           /* wall time at which the last step was due, s */
    double opened;          /* wall time of the first call of `advance`, s */
    bool has_started;       /* the run no longer waits for its first browser */
    uint32_t files;         /* number of the present run's files; 1: as `def` names them */
    const char **overrides; /* settings of the present match's level; NULL: those of `def` */
    char *level;            /* the setting that chooses the level */
    bool embedded;          /* the scene belongs to the program (embedded_page.c) */
    bool have_left;         /* all agents had left for good at the end of the last step */
    bool failed;            /* the run cannot continue; `failure` says why */
    char failure[1024];
    bool reported; /* messages being printed are errors that browsers already have as data */
    JoxLiveInspector inspectors[JOX_VIEW_CLIENTS];
    JoxHandPush pushes[JOX_HAND_PUSHES]; /* a ring buffer */
    uint32_t push_count;                 /* pushes ever put into the ring */
    JoxLiveFileErrors *errors;
    size_t error_count, error_capacity;
} JoxScenePage;

/* scene_page.c: functions of the source; `self` is a JoxScenePage. */
extern const JoxLiveSource jox_scene_page_source;
/* Opens the page of `def`, which must outlive it; jox_scene_page_load then loads the scene. False
   with `error`. */
bool jox_scene_page_open(JoxScenePage *scene, const JoViewDef *def, JoError *error);
/* Ends the scene, all connections, and the page. False with `error` if a file is not whole. */
bool jox_scene_page_close(JoxScenePage *scene, JoError *error);
/* scene_load.c: loads the scene in place of the one that runs, and starts its recording, log and
   watch. False with `error`; the scene that ran before goes on if the new one could not be
   loaded. */
bool jox_scene_page_load(JoxScenePage *scene, JoError *error);
/* Notes that the run cannot go on, and pauses it. */
void jox_scene_page_fail(JoxScenePage *scene, const JoError *error);
/* Forwards a message of the scene to the caller's function, and to browsers unless they have it as
   data; `page` is the JoxScenePage. */
void jox_scene_page_forward(void *page, const char *text);
/* Returns the path of a file of the present run: `path` of the first, NAME-2.EXT of the second and
   so on, so that each run keeps its files. NULL for NULL. Free it by jox_free. */
char *jox_scene_page_path(const JoxScenePage *scene, const char *path);
/* Appends "; written to FILE and FILE", the recording and the input log of the present run. Returns
   false, and appends nothing, if it writes neither. */
bool jox_scene_page_add_files(const JoxScenePage *scene, JoxText *out);
/* Finishes recording and log, and frees the scene. False with `error` if a file is not whole. */
bool jox_scene_page_end(JoxScenePage *scene, JoError *error);
/* scene_errors.c: keeps the errors of loaded files and sends them; a JoxDiagnosed whose context is
   the JoxScenePage. */
void jox_scene_page_diagnosed(void *scene, const bool *parts, const JoxDiagnostics *diagnostics);
/* Sends a client, or JOX_VIEW_ALL, the errors that are kept. */
void jox_scene_page_send_errors(void *scene, uint32_t client);
void jox_scene_page_forget_errors(JoxScenePage *scene);
/* scene_commands.c: commands of browsers, by verb. */
void jox_scene_page_pause(void *scene, const JoxLiveRequest *request);
void jox_scene_page_step(void *scene, const JoxLiveRequest *request);
void jox_scene_page_restart(void *scene, const JoxLiveRequest *request);
void jox_scene_page_input(void *scene, const JoxLiveRequest *request);
void jox_scene_page_lua(void *scene, const JoxLiveRequest *request);
/* scene_match.c: the rounds of a match. Counts a round that is over; then the run is paused. */
void jox_scene_page_judge(JoxScenePage *scene);
void jox_scene_page_play(void *scene, const JoxLiveRequest *request);
/* A run begins anew by the command `restart`: the present round again, or the end of the match. */
void jox_scene_page_replay_round(JoxScenePage *scene);
/* scene_inspectors.c: each browser can inspect one agent, and gets a message with each status. */
/* Makes a browser, or all (JOX_VIEW_ALL), inspect the agent with this id. */
void jox_scene_page_show_agent(JoxScenePage *s, uint32_t client, uint32_t id);
void jox_scene_page_inspect(void *scene, const JoxLiveRequest *request);
void jox_scene_page_send_inspected(void *scene);
void jox_scene_page_end_inspection(void *scene, uint32_t client);

#endif
