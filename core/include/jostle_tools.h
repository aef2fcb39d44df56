/* Jostle's tools: what its commands call besides jostle.h. Live pages, pictures, reports, checks,
 * tests of behaviours and claims. Units and errors are as in jostle.h. They are in libjostle-tools,
 * which holds all of libjostle besides: a program links the one or the other.
 */
#ifndef JOSTLE_TOOLS_H
#define JOSTLE_TOOLS_H

#include "jostle.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Writes a text to a file, which has its name only once it is whole. False with `error`, whose text
   is the reason alone. */
JO_API bool jo_write(const char *path, const char *text, JoError *error);

/* The figures of a run so far (jo_scene_figures) as the file that `jostle run --summary` writes,
   one JSON object; free with jo_free. */
JO_API char *jo_scene_summary(const JoScene *scene);
/* From several such files: {"runs", "given": {PATH: value, or a list by run where they differ},
   "figures": {PATH: {"mean", "p5", "p95"}}}. Figures are statistics of a run; what it was given,
   coordinates and texts are not. Free with jo_free. */
JO_API char *jo_summaries_aggregate(const char *const *summaries, size_t count, JoError *error);

/* What a run comes to so far, as a paragraph: who left and who is in which state, hits and the
   like, who stood still, warnings. Free with jo_free. */
JO_API char *jo_scene_closing(const JoScene *scene);

/* What the agent in a slot (JoAgent.slot) is, wants and meets, as one JSON object; free with
   jo_free. From the first call on, and as long as it is asked for at least every 5 simulated
   seconds, its steps are looked at closely: "planes" are the half-planes of its last step, m/s,
   each allowing what lies to the left of its direction; "forces" the parts of its net force, N;
   "last" its last transition, and why. {"agent": null} once where nobody is in the slot, or who was
   inspected there has left. Nothing of it changes the run. */
JO_API char *jo_scene_inspect(JoScene *scene, uint32_t slot);

/* ---- files of a run ---------------------------------------------------------------------- */

/* Collects density and regional speeds from here on; jo_scene_finish draws them, and what the
   scene's probes measured, into `directory` (made if it is missing). */
JO_API bool jo_scene_report(JoScene *scene, const char *directory, JoError *error);
/* The scene of `def` once more, with the seed of one that was loaded from it, half its step, and
   no messages; it collects what a report does, and draws nothing. NULL with `error`. */
JO_API JoScene *jo_scene_half_step(const JoSceneDef *def, const JoScene *scene, JoError *error);
/* After jo_scene_finish: writes index.html into the report's `directory`, with the figures of the
   run and, beside each, those of `half`, the same run at half the step. NULL: the page says that
   there was none, because `why`. False with `error` if it cannot be written. */
JO_API bool jo_scene_page(const JoScene *scene, const JoScene *half, const char *why,
                          const char *directory, JoError *error);
/* At jo_scene_finish only the probes' CSV files are written, into `directory` (made if it is
   missing). */
JO_API bool jo_scene_data(JoScene *scene, const char *directory, JoError *error);

/* ---- files of others --------------------------------------------------------------------- */

/* Is told of a file that was read. */
typedef void JoRead(void *context, const char *path, const char *text, size_t length);
/* What is to be read of a scene that runs. */
typedef struct JoVetting {
    bool whole;                    /* all of it, as jo_scene_load does; else what was edited: */
    const char *const *behaviours; /* paths of their files, */
    size_t behaviour_count;
    bool scene;   /* and whether the scene's own files were */
    int stop;     /* a file descriptor that can be read when it is no longer wanted; -1: none */
    JoRead *read; /* told of each file */
    void *read_context;
    char file[1024], why[240]; /* where it is refused: at which file, and what happened there */
} JoVetting;
/* Whoever has the files of others read before the program reads them itself: `vet` reads them in a
   process that can do no harm, and returns once it has; what is wrong with their text is no reason
   to refuse. False where that process was ended. It is called by the thread that loads, beside the
   steps, and by the one that runs a live page; `trust` is how the user does without, for
   messages. */
typedef struct JoVetter {
    bool (*vet)(void *context, JoVetting *what);
    void *context;
    const char *trust;
} JoVetter;
/* Before jo_scene_watch: files that are edited are loaded from what `vetter` had read of them; it
   must outlive the scene. NULL: they are read at once. */
JO_API void jo_scene_vet(JoScene *scene, const JoVetter *vetter);
/* Of a scene that is `dry`: reads and compiles what was edited as the scene that runs would, and
   takes nothing of it; false where memory ran out. For a vetter, in its process. */
JO_API bool jo_scene_try(JoScene *scene, const JoVetting *what);

/* ---- live pages -------------------------------------------------------------------------- */

/* A scene on a live page: a browser on this machine shows it and lets people act on it. */
typedef struct JoViewDef {
    JoSceneDef scene;
    const char *address;      /* to listen at; NULL: 127.0.0.1, for this machine alone */
    int port;                 /* 0: 8730, or the next that is free */
    const char *page;         /* folder of the page's files; NULL: where they were installed */
    const char *three;        /* folder of three.js; NULL: Debian's */
    bool fast;                /* as fast as it can go, not in real time */
    double wait;              /* s that time stands still at most, until the first page is open */
    bool watch;               /* files that are edited are reloaded; on by default */
    const JoVetter *vetter;   /* who reads them first, and the scene at a restart; NULL: nobody */
    double seconds;           /* simulated, after which it pauses; 0: the scene's duration */
    const char *record;       /* file for trajectories, or NULL; a restart begins it anew */
    double record_every;      /* s between its frames, as for jo_scene_record */
    const char *log_input;    /* file for what people do, or NULL; a restart begins it anew */
    const volatile int *stop; /* it ends once a signal or another thread sets this; NULL: never */
    JoMessage *opened;        /* NULL, or told the page's address once it can be opened */
    void *opened_context;
    /* NULL, or called with the scene when it begins, and once more after each restart, for what
       else is to be written of it, as jo_scene_checkpoint does. False with `error`: it stands. */
    bool (*begun)(void *context, JoScene *scene, JoError *error);
    void *begun_context;
    char **summary; /* NULL, or for the figures of the run as it ended; free with jo_free */
    uint32_t cookie;
} JoViewDef;
JO_API JoViewDef jo_default_view_def(void);
/* Returns when it was stopped. False with `error` if the page cannot be served or the scene does
   not load; every error of the scene went to its `message`. */
JO_API bool jo_view(const JoViewDef *def, JoError *error);

/* Shows a recording on that page: any that jo_report takes. */
typedef struct JoViewRecordingDef {
    const char *recording;
    const char *scene;   /* whose walls, places and bodies are drawn; NULL: the recording's walls */
    double fps;          /* frames a second; 0: as the recording says */
    double unit;         /* m, of its lengths; 0: as it says */
    const char *address; /* these three and the port as in JoViewDef */
    const char *page;
    const char *three;
    int port;
    const volatile int *stop; /* it ends once a signal or another thread sets this; NULL: never */
    JoMessage *opened;        /* NULL, or told the page's address once it can be opened */
    void *opened_context;
    JoMessage *message; /* NULL: to stderr */
    void *message_context;
    uint32_t cookie;
} JoViewRecordingDef;
JO_API JoViewRecordingDef jo_default_view_recording_def(void);
/* Returns when it was stopped. False with `error` if the page cannot be served or there is no such
   recording; all that is wrong with it went to `message`. */
JO_API bool jo_view_recording(const JoViewRecordingDef *def, JoError *error);

/* What is measured of a recording: an SQLite file of jo_scene_record or of JuPedSim, or text with
   the columns id, frame, x, y as PeTrack writes it, or CSV with a line of names. */
typedef struct JoReportDef {
    const char *recording;
    const char *scene; /* whose probes measure and whose walls are drawn; NULL, or without probes:
                          a map of all and densities and speeds over time */
    const char *directory; /* for CSV files and pictures, made if it is missing; NULL: none */
    double fps;            /* frames a second; 0: as the recording says */
    double unit;           /* m, of its lengths: 1, or 0.01 for centimetres; 0: as it says */
    JoMessage *message;    /* NULL: to stderr */
    void *message_context;
    uint32_t cookie;
} JoReportDef;
JO_API JoReportDef jo_default_report_def(void);
/* Shows every frame to the probes and returns their figures as one JSON object; free with jo_free.
   NULL if anything is wrong: every error went to `message`, the first is in `error`. */
JO_API char *jo_report(const JoReportDef *def, JoError *error);

/* A top view, as a picture, as frames or as a video: of a scene, which is run for it, or of a
   recording (as for JoReportDef). */
typedef struct JoRenderDef {
    const JoSceneDef *scene; /* runs this, */
    const char *recording;   /* or reads this; */
    const char *plan;        /* then the walls and places of this scene are drawn; or NULL */
    double recorded_fps;     /* frames a second of the recording; 0: as it says */
    double unit;             /* m, of its lengths; 0: as it says */
    const char *out;         /* FILE.svg or FILE.png: one picture; FILE.mp4, .mkv or .webm: a video
                                (needs ffmpeg); else a folder for frame-000001.png, ... */
    double at;               /* s, of a picture; default NAN: the beginning */
    double from, until;      /* s, of frames and videos; default NAN: from beginning to end */
    double fps;              /* of frames and videos; 0: as of the steps or the recording, but at
                                most 30 a second */
    uint32_t width, height;  /* pixels, 320 to 8192; 0: what suits the area */
    const double *area;      /* x0, y0, x1, y1, m; NULL: all */
    const char *colour;      /* "state", "group", "speed", "force", "compression", "load",
                                "density", "direction" or "none", or as "speed:1.5" with the value at
                                the bar's end; NULL: what the scene's `view` says */
    const char *field;       /* "density" or "pressure", or with a value; NULL: a bare floor */
    bool paths;              /* draws where people went until then */
    bool progress;           /* on stderr, as jo_scene_show_progress */
    JoMessage *message;      /* NULL: to stderr */
    void *message_context;
    uint32_t cookie;
} JoRenderDef;
JO_API JoRenderDef jo_default_render_def(void);
/* What was written goes to `message`, and everything that is wrong with a scene or a recording.
   False with `error` if anything failed: JO_USAGE if the def makes no sense, JO_INPUT if the scene
   or recording is wrong or has no such time, JO_FAILED if writing failed. */
JO_API bool jo_render(const JoRenderDef *def, JoError *error);
/* Whether this build makes images and videos; else SVG alone. */
JO_API bool jo_render_has_images(void);

/* Whether steps of the world are timed; at first they are not. What they were up to now. */
JO_API void jo_world_set_timed(JoWorld *world, bool timed);
JO_API JoStats jo_world_stats(const JoWorld *world);

/* What a step of a scene costs: what jo_plot_times draws. */
typedef struct JoTiming {
    const char *scene, *isa; /* names */
    uint32_t agents;
    bool in_series;      /* one of several sizes of the same crowd */
    double ns, least_ns; /* processor time per agent and step, ns: median and least */
    double stage_ns[JO_STAGE_COUNT];
} JoTiming;
/* Draws bench.svg into `directory` (made if it is missing), beside its script and data: scenes and
   stages as bars, the series as a curve for each instruction set. Needs gnuplot. */
JO_API bool jo_plot_times(const JoTiming *timings, size_t count, const char *directory,
                          JoError *error);

/* ---- sweeps ------------------------------------------------------------------------------ */

/* Every combination of the values that settings of a scene take, with several seeds each, as
   processes of their own. */
typedef struct JoSweepDef {
    JoSceneDef scene; /* of every run; its overrides are not lists. Its seed is the first of the
                         seeds (1 unless it has one); `threads` 0 is one a run */
    const char *const *sets; /* "PATH=A,B,C"; a comma within brackets or quotes parts nothing */
    size_t set_count;
    uint32_t seeds;   /* of each combination; default 1 */
    double seconds;   /* simulated; default NAN: as the scene says */
    uint64_t steps;   /* 0: by seconds */
    const char *out;  /* SQLite file, with which a sweep goes on if it is there; NULL: in memory */
    const char *data; /* NULL, or a folder in which each seed has its CSV files, in seed-N */
    uint32_t jobs;    /* processes at once; 0: one for each processor that this one may use */
    uint32_t only;    /* the number of one run, from 1: all seeds of the first combination, then of
                         the next; 0: all runs */
    bool again;       /* runs that failed before are done once more */
    bool renew;       /* a file of other inputs is begun anew, not refused, and other seeds are
                         taken out of it */
    bool quiet;       /* no progress on stderr */
    /* NULL, or called with each combination before it is loaded; false refuses, with `error`,
       having said why. */
    bool (*vet)(void *context, const JoSceneDef *scene, JoError *error);
    void *vet_context;
    const volatile int *stop; /* it ends once a signal or another thread sets this; NULL: never */
    JoMessage *message;       /* NULL: to stderr */
    void *message_context;
    uint32_t cookie;
} JoSweepDef;
JO_API JoSweepDef jo_default_sweep_def(void);
typedef struct JoSweepCounts {
    uint32_t runs, done; /* in all; with figures */
    uint32_t kept;       /* of all, those from before */
    uint32_t troubled;   /* of those done: see jo_scene_troubles */
    uint32_t failed, missing;
} JoSweepCounts;
/* Runs what is not there yet. A run that fails is kept with its reason, and ends nothing. *summary,
   unless NULL, is what jo_summaries_aggregate makes of all runs with figures; free with jo_free.
   So are the runs of a combination that does not load.
   False with `error`: JO_USAGE if the def makes no sense, JO_INPUT if no combination loads, or the
   file is none of a sweep's or of other inputs (all that is wrong went to `message`),
   JO_FAILED if it cannot be written, or it was stopped. What was done is kept then. */
JO_API bool jo_sweep(const JoSweepDef *def, JoSweepCounts *counts, char **summary, JoError *error);
/* How many runs there are, without running any; 0 with `error`. */
JO_API uint32_t jo_sweep_runs(const JoSweepDef *def, JoError *error);
/* Puts the runs of files of the same sweep, as those of `only`, into one: made, or gone on with.
   False with `error` if one of them is no such file, or two say different things of a run. */
JO_API bool jo_sweep_merge(const char *out, const char *const *parts, size_t count,
                           JoSweepCounts *counts, JoError *error);
/* Writes the runs of a sweep's file as CSV, a row each; "-" is standard output. */
JO_API bool jo_sweep_csv(const char *sweep, const char *csv, JoError *error);

/* ---- comparisons ------------------------------------------------------------------------- */

/* Variants of sweeps, and recordings, held against one of them. */
typedef struct JoCompareDef {
    const char *const *sides; /* files of sweeps, each variant of which is a side, or recordings */
    size_t side_count;
    /* NULL, or for each of `sides` NULL or, of a recording, what jo_report says of it. */
    const char *const *summaries;
    /* NULL, or for each of `sides` NULL or what several recordings, one after the other, have in
       common, as the folder that they lie in: they are the runs of one side, which it names. */
    const char *const *folders;
    double fps, unit;          /* of recordings, as for jo_report; 0: as they say */
    const char *const *labels; /* what sides are called, in their order; of the rest by what tells
                                  them apart */
    size_t label_count;
    const char *base;  /* what the others are compared with: a side's number from 1, its name or its
                          file; NULL: the first */
    const char *out;   /* folder for a page, index.html, made if it is missing; NULL: none */
    double share;      /* of intervals; default 0.95 */
    double percentile; /* 0, or the per cent of which the value above so many, the worst case and a
                          bound are told */
    uint32_t resamples; /* intervals by so many bootstrap samples; 0: by Student's t */
    bool all;           /* the text tells all figures, not only those that one asks for first */
    JoMessage *message; /* NULL: to stderr */
    void *message_context;
    uint32_t cookie;
} JoCompareDef;
JO_API JoCompareDef jo_default_compare_def(void);
/* The comparison as text; *json, unless NULL, as JSON. Free both with jo_free. NULL with `error`:
   JO_INPUT if a file is none of a sweep's or a recording, JO_FAILED if the page cannot be written.
 */
JO_API char *jo_compare(const JoCompareDef *def, char **json, JoError *error);

/* ---- checks, tests, claims, references --------------------------------------------------- */

/* Checks scenes and behaviours (or folders of them) without running; everything wrong goes to
   `message`, as text that ends with how much it is, or as one JSON array. Returns the number of
   errors, or SIZE_MAX with `error` if it could not be done. */
JO_API size_t jo_check(const char *const *paths, size_t count, bool json, JoMessage *message,
                       void *context, JoError *error);
/* Runs tests of behaviours: files, or folders with files that end with _test.lua. `only`, if not
   NULL, is part of a test's name. Each result goes to `message`, as text or, at the end, as one
   JSON array. Counts what passed and failed; false with what is wrong sent to `message` if a file
   cannot be run, or with `error` if nothing more can be done. */
JO_API bool jo_test(const char *const *paths, size_t count, const char *only, bool json,
                    JoMessage *message, void *context, size_t *passed, size_t *failed,
                    JoError *error);
/* What a claim file says is measured and compared (scenes/claims/README.md). */
typedef struct JoReproduceDef {
    const char *folder;        /* of claim files */
    const char *const *claims; /* ids, or names of files; none: all */
    size_t claim_count;
    const char *const *sets; /* "PATH=VALUE": what every run has otherwise than its claim says */
    size_t set_count;
    const char *out;          /* folder for runs, pictures and the page */
    const char *program;      /* path of the command `jostle`, which runs the scenes */
    uint32_t jobs;            /* processes at once */
    const char *seeds;        /* "101" or "101-110", in place of those of each claim; or NULL */
    bool quick;               /* the smaller runs of each claim */
    bool fresh;               /* runs that are there already are done again */
    bool standards;           /* of all claims the tests of standards; and a page for authorities */
    bool list;                /* names the claims, runs nothing */
    bool quiet;               /* no progress on stderr */
    const volatile int *stop; /* it ends once a signal or another thread sets this; NULL: never */
    JoMessage *message;       /* NULL: to stdout */
    void *message_context;
} JoReproduceDef;
JO_API JoReproduceDef jo_default_reproduce_def(void);
/* Runs what claims need, measures, sends a table to `message` and writes index.html, table.md and
   results.json into `out`, with `standards` also standards.html. *missed counts the claims out of
   band. False with `error` if it could not be done; what is wrong with claim files went to
   `message`. */
JO_API bool jo_reproduce(const JoReproduceDef *def, size_t *missed, JoError *error);
/* A generated page or file by name, as `jostle reference` lists them: "behaviours", "scenes",
   "lua-ls", "luacheck", "scene-schema", "mod-schema", "inputs". NULL if there is none; free with
   jo_free. */
JO_API char *jo_reference(const char *what);
/* What the mods define that a run of def's scene would take (path NULL: those that are named or
   on): their behaviours, and the functions and values of the files that others require, with the
   comments before them, as Markdown; free with jo_free. What is wrong goes to def->message. */
JO_API char *jo_mods_reference(const JoSceneDef *def);
/* The reference of the scene format, as text; free with jo_free. */
JO_API char *jo_scene_reference(void);

#ifdef __cplusplus
}
#endif
#endif
