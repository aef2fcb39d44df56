/* Public interface of Jostle's tools, which the program `jostle` calls besides jostle.h: live
 * pages, pictures, reports, checks, tests of behaviours and claims. Units and errors are as in
 * jostle.h. The functions are in libjostle-tools, which also contains all of libjostle: a
 * program links one or the other. */
#ifndef JOSTLE_TOOLS_H
#define JOSTLE_TOOLS_H

#include "jostle.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Writes a text to a file atomically: the file gets its name only once it is whole. False with
   `error`, whose text is the reason alone. */
JO_API bool jo_write(const char *path, const char *text, JoError *error);

/* The figures of a run so far (jo_scene_figures) as the file that `jostle run --summary` writes,
   one JSON object; free with jo_free. */
JO_API char *jo_scene_summary(const JoScene *scene);
/* Aggregates several such files into {"runs", "given": {PATH: value, or a list by run where they
   differ}, "figures": {PATH: {"mean", "p5", "p95"}}}. "figures" has results and costs of runs,
   "given" everything else: inputs, texts and coordinates. Free with jo_free. */
JO_API char *jo_summaries_aggregate(const char *const *summaries, size_t count, JoError *error);

/* Sums up a run so far as a paragraph: how many people left, how many are in each state, hits
   and the like, people standing still, warnings. Free with jo_free. */
JO_API char *jo_scene_closing(const JoScene *scene);

/* Describes the agent in a slot (JoAgent.slot), its goal and its neighbourhood as one JSON
   object; free with jo_free. Its steps are traced from the first call on, as long as one follows
   at least every 5 simulated seconds: "planes" are the half-planes of its last step, m/s, each
   allowing the side to the left of its direction; "forces" the terms of its net force, N; "last"
   its last transition, and why it fired. {"agent": null} once if the slot is empty, or the
   inspected agent has left. The run does not change by it. */
JO_API char *jo_scene_inspect(JoScene *scene, uint32_t slot);

/* ---- files of a run ---------------------------------------------------------------------- */

/* Starts collecting density and regional speeds; jo_scene_finish draws them, and the
   measurements of the scene's probes, into `directory` (made if it is missing). */
JO_API bool jo_scene_report(JoScene *scene, const char *directory, JoError *error);
/* Loads the scene of `def` once more, with the seed of `scene`, which was loaded from it, half
   its time step, and no messages; it collects the data of a report, and draws nothing. NULL with
   `error`. */
JO_API JoScene *jo_scene_half_step(const JoSceneDef *def, const JoScene *scene, JoError *error);
/* Writes index.html into the report's `directory`; call it after jo_scene_finish. The page shows
   the figures of the run and, beside each, that of `half`, the same run at half the time step.
   NULL: the page says that there was none, and gives `why` as the reason. False with `error` if
   it cannot be written. */
JO_API bool jo_scene_page(const JoScene *scene, const JoScene *half, const char *why,
                          const char *directory, JoError *error);
/* Makes jo_scene_finish write only the probes' CSV files, into `directory` (made if it is
   missing). */
JO_API bool jo_scene_data(JoScene *scene, const char *directory, JoError *error);

/* ---- files of others --------------------------------------------------------------------- */

/* Receives each file that was read. */
typedef void JoRead(void *context, const char *path, const char *text, size_t length);
/* Request to read files of a running scene, and its result. */
typedef struct JoVetting {
    bool whole; /* read all files, as jo_scene_load does; else only the edited ones: */
    const char *const *behaviours; /* paths of edited behaviours' files */
    size_t behaviour_count;
    bool scene; /* the scene's own files were edited */
    int stop;   /* file descriptor that becomes readable when the request is cancelled; -1: none */
    JoRead *read; /* receives each file */
    void *read_context;
    char file[1024], why[240]; /* if refused: the file at which the process ended, and how */
} JoVetting;
/* Reads files of unknown origin before the program reads them itself. `vet` reads them in a
   process without rights to do harm, and returns when that has finished; errors in their text
   are no reason to refuse. False if that process was killed. It is called by the thread that
   loads files while steps run, and by the thread that runs a live page. `trust` is text for
   messages: how the user switches vetting off. */
typedef struct JoVetter {
    bool (*vet)(void *context, JoVetting *what);
    void *context;
    const char *trust;
} JoVetter;
/* Sets the vetter of edited files; call it before jo_scene_watch. A file is then loaded from the
   text that `vetter` read; it must outlive the scene. NULL: files are read at once. */
JO_API void jo_scene_vet(JoScene *scene, const JoVetter *vetter);
/* Reads and compiles edited files as the running scene would, and discards the result; `scene`
   must be loaded as `dry`. False if memory ran out. For a vetter, in its process. */
JO_API bool jo_scene_try(JoScene *scene, const JoVetting *what);

/* ---- live pages -------------------------------------------------------------------------- */

/* Definition of a live page: a browser on this machine shows a running scene and lets people act
   on it. */
typedef struct JoViewDef {
    JoSceneDef scene;
    const char *address; /* address to listen at; NULL: 127.0.0.1, for this machine alone */
    int port;            /* 0: 8730, or the next free port */
    const char *page;    /* folder of the page's files; NULL: where they were installed */
    const char *three;   /* folder of three.js; NULL: Debian's */
    bool fast;           /* run as fast as possible, not in real time */
    double wait;         /* s: longest pause at the start, until the first page is open */
    bool watch;          /* reload edited files; on by default */
    /* reads edited files first, and the scene at a restart; NULL: no vetting */
    const JoVetter *vetter;
    double seconds;     /* simulated time, s, after which the run pauses; 0: the scene's duration */
    const char *record; /* file for trajectories, or NULL; a restart overwrites it */
    double record_every;      /* s between recorded frames, as for jo_scene_record */
    const char *log_input;    /* file for the input log, or NULL; a restart overwrites it */
    const volatile int *stop; /* it ends once a signal or another thread sets this; NULL: never */
    JoMessage *opened;        /* receives the page's address once it can be opened; may be NULL */
    void *opened_context;
    /* Called with the scene when it begins, and again after each restart, to set up further
       outputs such as jo_scene_checkpoint; may be NULL. False with `error` stops the page. */
    bool (*begun)(void *context, JoScene *scene, JoError *error);
    void *begun_context;
    char **summary; /* receives the figures at the end of the run, free with jo_free; may be NULL */
    uint32_t cookie;
} JoViewDef;
JO_API JoViewDef jo_default_view_def(void);
/* Serves the page and returns when it was stopped. False with `error` if the page cannot be
   served or the scene does not load; every error of the scene went to its `message`. */
JO_API bool jo_view(const JoViewDef *def, JoError *error);

/* Definition of a live page that shows a recording: any that jo_report reads. */
typedef struct JoViewRecordingDef {
    const char *recording;
    /* scene whose walls, places and bodies are drawn; NULL: the recording's walls */
    const char *scene;
    double fps;          /* frames a second; 0: as the recording says */
    double unit;         /* m: unit of the recording's lengths; 0: as it says */
    const char *address; /* address, page, three and port are as in JoViewDef */
    const char *page;
    const char *three;
    int port;
    const volatile int *stop; /* it ends once a signal or another thread sets this; NULL: never */
    JoMessage *opened;        /* receives the page's address once it can be opened; may be NULL */
    void *opened_context;
    JoMessage *message; /* NULL: to stderr */
    void *message_context;
    uint32_t cookie;
} JoViewRecordingDef;
JO_API JoViewRecordingDef jo_default_view_recording_def(void);
/* Serves the page and returns when it was stopped. False with `error` if the page cannot be
   served or there is no such recording; every error in the recording went to `message`. */
JO_API bool jo_view_recording(const JoViewRecordingDef *def, JoError *error);

/* Definition of a report on a recording: an SQLite file of jo_scene_record or of JuPedSim, or
   text with the columns id, frame, x, y as PeTrack writes it, or CSV with a line of column
   names. */
typedef struct JoReportDef {
    const char *recording;
    /* scene whose probes measure and whose walls are drawn; NULL, or a scene without probes: a map
       of the whole area, and densities and speeds over time */
    const char *scene;
    /* folder for CSV files and pictures, made if it is missing; NULL: none */
    const char *directory;
    double fps;  /* frames a second; 0: as the recording says */
    double unit; /* m: unit of the recording's lengths: 1, or 0.01 for centimetres; 0: as it says */
    JoMessage *message; /* NULL: to stderr */
    void *message_context;
    uint32_t cookie;
} JoReportDef;
JO_API JoReportDef jo_default_report_def(void);
/* Passes every frame to the probes and returns their figures as one JSON object; free with
   jo_free. NULL if anything is wrong: every error went to `message`, the first is in `error`. */
JO_API char *jo_report(const JoReportDef *def, JoError *error);

/* Definition of a top view, as a picture, as frames or as a video, of a scene, which is run for
   it, or of a recording (as for JoReportDef). */
typedef struct JoRenderDef {
    const JoSceneDef *scene; /* scene to run, or NULL */
    const char *recording;   /* recording to read in place of a scene, or NULL */
    const char *plan;    /* scene whose walls and places are drawn under the recording, or NULL */
    double recorded_fps; /* frames a second of the recording; 0: as it says */
    double unit;         /* m: unit of the recording's lengths; 0: as it says */
    const char *out;     /* FILE.svg or FILE.png: one picture; FILE.mp4, .mkv or .webm: a video
                            (needs ffmpeg); else a folder for frame-000001.png, ... */
    double at;           /* s: time of a picture; default NAN: the beginning */
    double from, until;  /* s: interval of frames and videos; default NAN: from beginning to end */
    double fps; /* frames a second of frames and videos; 0: as many as steps or recorded frames, but
                   at most 30 */
    uint32_t width, height; /* pixels, 320 to 8192; 0: what suits the area */
    const double *area;     /* x0, y0, x1, y1, m; NULL: all */
    const char *colour;     /* "state", "group", "speed", "force", "compression", "load",
                               "density", "direction" or "none", or as "speed:1.5" with the value at
                               the bar's end; NULL: what the scene's `view` says */
    const char *field;  /* field drawn on the floor: "density" or "pressure", or with the value at
                           the bar's end; NULL: none */
    bool paths;         /* draws the paths of people up to the time of the picture */
    bool progress;      /* on stderr, as jo_scene_show_progress */
    JoMessage *message; /* NULL: to stderr */
    void *message_context;
    uint32_t cookie;
} JoRenderDef;
JO_API JoRenderDef jo_default_render_def(void);
/* Draws the view. The names of written files go to `message`, and every error in a scene or a
   recording. False with `error` if anything failed: JO_USAGE if the def makes no sense, JO_INPUT
   if the scene or recording is wrong or has no such time, JO_FAILED if writing failed. */
JO_API bool jo_render(const JoRenderDef *def, JoError *error);
/* Whether this build can make PNG images and videos; else SVG alone. */
JO_API bool jo_render_has_images(void);

/* Switches the timing of a world's steps on or off (at first off), and reads the times so far. */
JO_API void jo_world_set_timed(JoWorld *world, bool timed);
JO_API JoStats jo_world_stats(const JoWorld *world);

/* Cost of a step of a scene, as jo_plot_times draws it. */
typedef struct JoTiming {
    const char *scene, *isa; /* names of the scene and the instruction set */
    uint32_t agents;
    bool in_series;      /* belongs to a series of sizes of the same crowd */
    double ns, least_ns; /* processor time per agent and step, ns: median and least */
    double stage_ns[JO_STAGE_COUNT];
} JoTiming;
/* Draws bench.svg into `directory` (made if it is missing), beside its script and data: scenes and
   stages as bars, the series as a curve for each instruction set. Needs gnuplot. */
JO_API bool jo_plot_times(const JoTiming *timings, size_t count, const char *directory,
                          JoError *error);

/* ---- sweeps ------------------------------------------------------------------------------ */

/* Definition of a sweep: every combination of the values of some settings of a scene, with
   several seeds each; each run is a process of its own. */
typedef struct JoSweepDef {
    /* scene of every run; its overrides are single values. Its seed is the first of the seeds (1 if
       it has none); `threads` 0 means one thread for each run */
    JoSceneDef scene;
    /* "PATH=A,B,C"; a comma within brackets or quotes does not separate values */
    const char *const *sets;
    size_t set_count;
    uint32_t seeds;   /* number of seeds for each combination; default 1 */
    double seconds;   /* simulated time, s; default NAN: as the scene says */
    uint64_t steps;   /* steps of each run; 0: by `seconds` */
    const char *out;  /* SQLite file of the sweep; an existing one is continued; NULL: in memory */
    const char *data; /* folder for the CSV files of each seed, in seed-N; NULL: none */
    uint32_t jobs;    /* processes at once; 0: as many as processors that this process may use */
    uint32_t only; /* number of the only run to do, from 1: all seeds of the first combination, then
                      of the next; 0: all runs */
    bool again;    /* repeat runs that failed before */
    bool renew;    /* overwrite a file that was made from other inputs in place of refusing it, and
                      remove runs of other seeds from it */
    bool quiet;    /* no progress on stderr */
    /* Called with each combination before it is loaded; may be NULL. False refuses the
       combination, with `error`, after the function has reported the reason. */
    bool (*vet)(void *context, const JoSceneDef *scene, JoError *error);
    void *vet_context;
    const volatile int *stop; /* it ends once a signal or another thread sets this; NULL: never */
    JoMessage *message;       /* NULL: to stderr */
    void *message_context;
    uint32_t cookie;
} JoSweepDef;
JO_API JoSweepDef jo_default_sweep_def(void);
typedef struct JoSweepCounts {
    uint32_t runs, done; /* all runs; those with figures */
    uint32_t kept;       /* runs found in the file, done before this call */
    uint32_t troubled;   /* done runs with troubles: see jo_scene_troubles */
    uint32_t failed, missing;
} JoSweepCounts;
/* Does the runs that the file lacks. A run that fails, or whose combination does not load, is
   stored with its reason and does not end the sweep. *summary, unless NULL, is the result of
   jo_summaries_aggregate over all runs with figures; free with jo_free. False with `error`:
   JO_USAGE if the def makes no sense, JO_INPUT if no combination loads, or the file is not a
   sweep's or was made from other inputs (every error went to `message`), JO_FAILED if it cannot
   be written, or the sweep was stopped. Finished runs are kept then. */
JO_API bool jo_sweep(const JoSweepDef *def, JoSweepCounts *counts, char **summary, JoError *error);
/* Number of runs of a sweep, without doing any; 0 with `error`. */
JO_API uint32_t jo_sweep_runs(const JoSweepDef *def, JoError *error);
/* Merges files of the same sweep, made with JoSweepDef.only for instance, into `out`, which is
   created or continued. False with `error` if one of them is no such file, or two have different
   results for a run. */
JO_API bool jo_sweep_merge(const char *out, const char *const *parts, size_t count,
                           JoSweepCounts *counts, JoError *error);
/* Writes the runs of a sweep's file as CSV, one row per run; "-" is standard output. */
JO_API bool jo_sweep_csv(const char *sweep, const char *csv, JoError *error);

/* ---- comparisons ------------------------------------------------------------------------- */

/* Definition of a comparison: variants of sweeps, and recordings, are compared with one of them,
   the base. Each variant or recording is a side. */
typedef struct JoCompareDef {
    /* files of sweeps, each variant of which becomes a side, or recordings */
    const char *const *sides;
    size_t side_count;
    /* One entry per item of `sides`: for a recording the JSON of jo_report, else NULL. NULL:
       none. */
    const char *const *summaries;
    /* One entry per item of `sides`: a name shared by consecutive recordings, such as their
       folder, which makes them runs of one side with that name, or NULL. NULL: none. */
    const char *const *folders;
    double fps, unit; /* frames a second and unit of recordings, as for jo_report; 0: as they say */
    const char *const *labels; /* names of sides, in their order; further sides are named by what
                                  distinguishes them */
    size_t label_count;
    const char *base; /* side with which the others are compared: its number from 1, its name or its
                         file; NULL: the first */
    const char *out;  /* folder for a page, index.html, made if it is missing; NULL: none */
    double share;     /* confidence level of intervals; default 0.95 */
    double percentile; /* per cent, or 0: adds to the result this percentile, a bound for it and the
                          worst case */
    uint32_t resamples; /* number of bootstrap samples for intervals; 0: Student's t */
    bool all;           /* write all figures into the text, not only the main ones */
    JoMessage *message; /* NULL: to stderr */
    void *message_context;
    uint32_t cookie;
} JoCompareDef;
JO_API JoCompareDef jo_default_compare_def(void);
/* Compares the sides and returns the result as text; *json, unless NULL, is the same as JSON.
   Free both with jo_free. NULL with `error`: JO_INPUT if a file is neither a sweep's nor a
   recording, JO_FAILED if the page cannot be written. */
JO_API char *jo_compare(const JoCompareDef *def, char **json, JoError *error);

/* ---- checks, tests, claims, references --------------------------------------------------- */

/* Checks scenes and behaviours (or folders of them) without running them; every error goes to
   `message`, as text that ends with their number, or as one JSON array. Returns the number of
   errors, or SIZE_MAX with `error` if the check could not be done. */
JO_API size_t jo_check(const char *const *paths, size_t count, bool json, JoMessage *message,
                       void *context, JoError *error);
/* Runs tests of behaviours: files, or folders with files that end with _test.lua. `only`, if not
   NULL, selects tests whose name contains it. Each result goes to `message`, as text or, at the
   end, as one JSON array. Counts passed and failed tests; false if a file cannot be run, with
   its errors sent to `message`, or, with `error`, if the tests could not go on. */
JO_API bool jo_test(const char *const *paths, size_t count, const char *only, bool json,
                    JoMessage *message, void *context, size_t *passed, size_t *failed,
                    JoError *error);
/* Definition of the reproduction of claims: the quantities that claim files name are measured
   and compared with their bands (scenes/claims/README.md). */
typedef struct JoReproduceDef {
    const char *folder;        /* folder of claim files */
    const char *const *claims; /* ids of claims, or names of files; none: all */
    size_t claim_count;
    const char *const *sets; /* "PATH=VALUE": settings of every run that override its claim */
    size_t set_count;
    const char *out;     /* folder for runs, pictures and the page */
    const char *program; /* path of the command `jostle`, which runs the scenes */
    uint32_t jobs;       /* processes at once */
    const char *seeds;   /* "101" or "101-110": seeds that override those of each claim; or NULL */
    bool quick;          /* use the smaller runs of each claim */
    bool fresh;          /* repeat runs that are there already */
    /* only claims that are tests of standards; also writes a page for authorities */
    bool standards;
    bool list;                /* list the claims, run nothing */
    bool quiet;               /* no progress on stderr */
    const volatile int *stop; /* it ends once a signal or another thread sets this; NULL: never */
    JoMessage *message;       /* NULL: to stdout */
    void *message_context;
} JoReproduceDef;
JO_API JoReproduceDef jo_default_reproduce_def(void);
/* Does the runs that claims need, measures, sends a table to `message` and writes index.html,
   table.md and results.json into `out`, with `standards` also standards.html. *missed counts the
   claims out of band. False with `error` if it could not be done; errors in claim files went to
   `message`. */
JO_API bool jo_reproduce(const JoReproduceDef *def, size_t *missed, JoError *error);
/* Returns a generated page or file by name, as `jostle reference` lists them: "behaviours",
   "scenes", "lua-ls", "luacheck", "scene-schema", "mod-schema", "inputs". NULL if there is none;
   free with jo_free. */
JO_API char *jo_reference(const char *what);
/* Documents the mods that a run of def's scene would load (path NULL: those that are named or
   turned on): their behaviours, and the functions and values of the files that others require,
   with the comments before them, as Markdown; free with jo_free. Errors go to def->message. */
JO_API char *jo_mods_reference(const JoSceneDef *def);
/* Returns the reference of the scene format as text; free with jo_free. */
JO_API char *jo_scene_reference(void);

#ifdef __cplusplus
}
#endif
#endif
