/* Public interface of Jostle's tools: live pages, pictures, reports, sweeps, comparisons, checks,
 * tests of behaviours and claims. The program `jostle` is made of these calls and those of
 * jostle.h. They are in libjostle-tools, which also contains all of libjostle: a program links one
 * or the other.
 *
 * What holds for all of them, besides what jostle.h says of units, errors and misuse:
 * - Fill a Def struct by its jo_default function, which sets `cookie`, then change fields. Texts,
 *   arrays and callbacks that a Def names must stay valid during the call; they are not kept.
 * - A call blocks until its work is done, or until another thread or a signal handler sets the int
 *   at the Def's `stop`. Callbacks run in the calling thread, unless their comment says otherwise.
 * - `message` receives text for people, lines that end with '\n', among it every error in the files
 *   that were read. `error` gets the first of these errors, and may be NULL.
 * - A result of type char * is UTF-8, belongs to the caller, and is freed with jo_free. It is NULL
 *   if memory ran out. */
#ifndef JOSTLE_TOOLS_H
#define JOSTLE_TOOLS_H

#include "jostle.h"
#include "jostle_live.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- text about a run -------------------------------------------------------------------- */

/* Writes `text` to a file atomically: into a temporary file beside it, which then takes the name
   `path`. False with `error`, whose text is the reason alone, without the path. */
JO_API bool jo_write(const char *path, const char *text, JoError *error);

/* Returns the figures of a run so far (jo_scene_figures) as one JSON object, the content of the
   file that `jostle run --summary` writes. */
JO_API char *jo_scene_summary(const JoScene *scene);
/* Aggregates `count` texts of jo_scene_summary, one per run, into one JSON object: {"runs": count,
   "given": {PATH: VALUE}, "figures": {PATH: {"mean", "p5", "p95"}}}. PATH is as in JoFigure.path.
   "figures" has results and costs, with their mean and the 5th and 95th percentile over the runs;
   "given" everything else (inputs, texts, coordinates), where VALUE is a list with one item per run
   if the runs differ. NULL with `error` (JO_INPUT) if a text is not JSON. */
JO_API char *jo_summaries_aggregate(const char *const *summaries, size_t count, JoError *error);

/* Sums up a run so far as a paragraph in English: how many people left, how many are in each state,
   how often bodies hit people, where people stand still, warnings. */
JO_API char *jo_scene_closing(const JoScene *scene);

/* Describes the agent in a slot (JoAgent.slot), its goal and its neighbourhood as one JSON object.
   The first call starts to trace the steps of this agent; tracing ends when no call follows within
   5 simulated seconds. "planes" are the half-planes of the last step: each has a point and a
   direction, m/s, and allows the velocities to the left of the direction. "forces" are the terms of
   the net force, N; "last" is the last transition, and why it was taken; "why" has the transitions
   out of its state with the terms of their conditions, as jo_scene_why has them. Returns {"agent":
   null} if the slot is empty, and once after the traced agent has left. Does not change the run. */
JO_API char *jo_scene_inspect(JoScene *scene, uint32_t slot);

/* A question about agents of a scene: why they stay in their states. */
typedef struct JoWhyDef {
    bool has_agent; /* about the agent with the id `agent`; else about all whom the next two
                       fields mean, state by state */
    uint32_t agent;
    const char *group; /* agents of this group; NULL: of all */
    const char *state; /* agents in this state; if nobody is, `to` that state; NULL: in any */
    const char *to;    /* agents whose states lead to this one, and the transitions that do; if no
                          state with agents does, all of them; of one agent, the transitions to it,
                          or to the next state on the shortest way there; NULL: all transitions */
    bool json;         /* answer as a JSON object, else as lines for people */
    uint32_t cookie;
} JoWhyDef;
JO_API JoWhyDef jo_default_why_def(void);
/* Sets a breakpoint, besides those that were set before: "agent 17 enters Hide", "anybody leaves
   Lesson", "GROUP calls SIGNAL". Agents that come in enter their first state. False with `error`
   (JO_USAGE) if it is not understood, or the scene has no such group, state or signal. */
JO_API bool jo_scene_break(JoScene *scene, const char *text, JoError *error);
/* Returns a line for each breakpoint that was met in the last step, which says when, by whom and,
   of an agent that it names, why; NULL if none was. Valid until the next step. */
JO_API const char *jo_scene_broke(const JoScene *scene);
/* Returns a line for each breakpoint that was not met so far, with what is known of the reason, as
   that its agent never came in; NULL if each was met. Free it by jo_free. */
JO_API char *jo_scene_unmet(const JoScene *scene);
/* Whether the round of the scene's game (`game` in its file) is over; false if it has none. */
JO_API bool jo_scene_over(const JoScene *scene);
/* Writes a checkpoint of a scene for which jo_scene_checkpoint was called, beyond those that are
   due. *written: whether the present state could be saved exactly; if not, it is written after the
   first step from now on after which it can be. False with `error` if writing failed. */
JO_API bool jo_scene_checkpoint_now(JoScene *scene, bool *written, JoError *error);

/* Watches the agent with this id from now on, in place of the one before: jo_scene_why then also
   tells its last transition, and what was drawn for chances. */
JO_API void jo_scene_follow(JoScene *scene, uint32_t agent);
/* Answers between two steps: how long the agents have been in their states, and for every
   transition out of them each term of its condition, with its value and its bound, and what there
   is where it does not hold; the transition that is nearest to firing comes first. The conditions
   are those that the next step will evaluate; counters of turns are those of the last. Does not
   change the run. NULL with `error` (JO_USAGE) if there is no such agent, group or state. */
JO_API char *jo_scene_why(JoScene *scene, const JoWhyDef *def, JoError *error);

/* ---- reports of a run --------------------------------------------------------------------
 *
 * Order of calls: jo_scene_load, jo_scene_report, steps, jo_scene_finish, then, for a page,
 * jo_scene_half_step, as many seconds of steps of that second scene, jo_scene_finish of it, and
 * jo_scene_page. */

/* Whether the run so far meets all `criteria` of its scene; true if it has none. */
JO_API bool jo_scene_meets_criteria(const JoScene *scene);
/* Starts collecting what a report shows: densities, speeds by region, danger. Call it once, between
   two steps. jo_scene_finish then writes these, and the measurements of the scene's probes, as CSV
   files and pictures into `directory` (made if it is missing). */
JO_API bool jo_scene_report(JoScene *scene, const char *directory, JoError *error);
/* Loads the scene of `def` a second time, to show how much the figures depend on the time step:
   with the seed of `scene`, which was loaded from the same `def`, and half its time step. The
   result collects data for jo_scene_page, sends no messages and draws nothing; step it, finish it
   and free it as any scene. NULL with `error`, and nothing to compare, if people acted on `scene`
   (input log, live page, jostle_act.h) or its files changed since. */
JO_API JoScene *jo_scene_half_step(const JoSceneDef *def, const JoScene *scene, JoError *error);
/* Writes the report's page, index.html, into the `directory` of jo_scene_report, after
   jo_scene_finish. It shows the figures of `scene`, each beside that of `half` (of
   jo_scene_half_step, also finished). With `half` NULL the page says that there was no such run,
   and gives `why` as the reason. False with `error` if the page cannot be written. */
JO_API bool jo_scene_page(const JoScene *scene, const JoScene *half, const char *why,
                          const char *directory, JoError *error);
/* Makes jo_scene_finish write the measurements of the scene's probes as CSV files, without
   pictures, into `directory` (made if it is missing). Call it once, between two steps. */
JO_API bool jo_scene_data(JoScene *scene, const char *directory, JoError *error);

/* ---- files of unknown origin -------------------------------------------------------------
 *
 * Vetting: files that a scene reloads while it runs may come from strangers. A program can have
 * each of them read first in another process, without rights to do harm, so that a file that
 * exploits a fault of a parser takes over that process alone. The program provides a JoVetter, and
 * names it in JoViewDef or by jo_scene_vet. The engine calls its `vet` with a JoVetting. `vet` asks
 * the other process, which has loaded the same scene with JoSceneDef.dry and calls jo_scene_try
 * (or, for `whole`, jo_scene_load), collects the texts of all files read there, and passes them to
 * JoVetting.read. The engine then loads the scene from these texts, not from the disk. */

/* Receives a file that was read: its path and its text of `length` bytes. The texts are copied. */
typedef void JoRead(void *context, const char *path, const char *text, size_t length);
/* Request to read files of a running scene, and its result. All pointers are valid during the call
   of `vet` alone. */
typedef struct JoVetting {
    bool whole; /* read all files of the scene, as jo_scene_load does, for a restart; the next three
                   fields are then unused. Else read only the edited files: */
    const char *const *behaviours; /* paths of edited behaviours */
    size_t behaviour_count;
    bool scene;   /* the scene's file, or a file that it includes, was edited */
    int stop;     /* file descriptor that becomes readable when the result is no longer wanted; -1:
                     none */
    JoRead *read; /* to be called with each file that was read */
    void *read_context;
    char file[1024], why[240]; /* filled by `vet` before it returns false: the file at which reading
                                  ended, and the reason, a sentence without its full stop */
} JoVetting;
/* Reads files on request in another process. `vet` returns true once all of them were passed to
   `read`, also if their text has errors: the engine finds these again and reports them. It returns
   false if the other process ended before, and the edited files are then refused. It is called by
   the thread that loads edited files during steps, and by the thread that runs jo_view, possibly at
   the same time. `trust` is a text for messages: how the user switches vetting off. */
typedef struct JoVetter {
    bool (*vet)(void *context, JoVetting *what);
    void *context;
    const char *trust;
} JoVetter;
/* Sets the vetter of edited files, which must outlive the scene; call it before jo_scene_watch.
   NULL, as at first: the scene reads edited files itself. */
JO_API void jo_scene_vet(JoScene *scene, const JoVetter *vetter);
/* For the process of a vetter: reads and compiles the edited files of `what` as the running scene
   would, and discards the result. `scene` must be loaded with JoSceneDef.dry. Returns true also if
   the files have errors; false if memory ran out. */
JO_API bool jo_scene_try(JoScene *scene, const JoVetting *what);

/* ---- recordings, pictures, costs --------------------------------------------------------- */

/* What the title block of a report states; NULL: what the scene's `report` states, or nothing. */
typedef struct JoReportHead {
    const char *title, *author, *organisation, *project, *reference;
    const char *checked_by, *approved_by, *date;
} JoReportHead;

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
    JoReportHead head;
    JoMessage *message; /* NULL: to stderr */
    void *message_context;
    uint32_t cookie;
} JoReportDef;
JO_API JoReportDef jo_default_report_def(void);
/* Passes every frame of the recording to the probes, and returns their figures as one JSON object.
   NULL with `error` if the recording or the scene is wrong, or a file cannot be written. */
JO_API char *jo_report(const JoReportDef *def, JoError *error);

/* Definition of a top view of a scene, which is run for it, or of a recording (as for JoReportDef):
   one picture, a folder of frames, or a video. */
typedef struct JoRenderDef {
    const JoSceneDef *scene; /* scene to run; or NULL with `recording` */
    const char *recording;   /* recording to read; or NULL with `scene` */
    const char *plan;    /* scene whose walls and places are drawn under the recording, or NULL */
    double recorded_fps; /* frames a second of the recording; 0: as it says */
    double unit;         /* m: unit of the recording's lengths; 0: as it says */
    const char *out;     /* FILE.svg or FILE.png: one picture; FILE.mp4, .mkv or .webm: a video
                            (needs ffmpeg); else a folder for frame-000001.png, ... */
    double at;           /* s: time of the one picture; default NAN: the beginning */
    double from, until;  /* s: interval of frames and videos; default NAN: from beginning to end */
    double fps; /* frames a second of frames and videos, 0.001 to 1000; 0: as many as there are
                   steps or recorded frames, but at most 30 */
    uint32_t width, height; /* pixels, 320 to 8192, even for a video; 0: chosen by the area */
    const double *area;     /* part to draw: x0, y0, x1, y1, m; NULL: all */
    const char *colour;     /* quantity that colours people: "state", "group", "speed", "force",
                               "compression", "load", "density", "direction" or "none". "speed:1.5"
                               also sets the value at the end of the colour bar. NULL: as the
                               scene's `view` says */
    const char *field;  /* field drawn on the floor: "density" or "pressure"; "density:4" also sets
                           the value at the end of the colour bar. NULL: none */
    bool paths;         /* draws the paths of people up to the time of the picture */
    bool progress;      /* shows progress on stderr, as jo_scene_show_progress does */
    JoMessage *message; /* NULL: to stderr */
    void *message_context;
    uint32_t cookie;
} JoRenderDef;
JO_API JoRenderDef jo_default_render_def(void);
/* Draws the view; the names of written files go to `message` too. False with `error`: JO_USAGE if
   fields of the def contradict each other, JO_INPUT if the scene or recording is wrong or does not
   reach the times asked for, JO_FAILED if writing failed. */
JO_API bool jo_render(const JoRenderDef *def, JoError *error);
/* Returns whether this build can make PNG images and videos; if not, only SVG. */
JO_API bool jo_render_has_images(void);

/* Switches the timing of a world's steps on or off; it is off at first, and costs time itself. */
JO_API void jo_world_set_timed(JoWorld *world, bool timed);
/* Returns the counts and the times that were measured so far. */
JO_API JoStats jo_world_stats(const JoWorld *world);

/* Cost of a step of a scene, measured by the caller. */
typedef struct JoTiming {
    const char *scene, *isa; /* names of the scene and the instruction set */
    uint32_t agents;
    bool in_series;      /* belongs to a series: the same crowd in several sizes */
    double ns, least_ns; /* processor time per agent and step, ns: median and least of the rounds */
    double stage_ns[JO_STAGE_COUNT];
} JoTiming;
/* Returns how many processors the process may use, by its affinity and the quotas of its control
   groups; 1 to 64. */
JO_API uint32_t jo_count_processors(void);
/* Draws bench.svg into `directory` (made if it is missing), and leaves gnuplot's script and data
   beside it: a bar for each item of `timings`, another one divided into its stages, and for each
   instruction set the series as a curve over the number of agents. Needs gnuplot. */
JO_API bool jo_plot_times(const JoTiming *timings, size_t count, const char *directory,
                          JoError *error);

/* ---- sweeps ------------------------------------------------------------------------------
 *
 * A sweep runs a scene many times: a variant is one combination of the settings that it varies, and
 * each variant is run with the same seeds. Each run is a process of its own (by fork: call jo_sweep
 * from a program that has no other threads). The results are kept in one SQLite file, so that a
 * sweep that was interrupted, or that lacks seeds, is continued by the same call. */

typedef struct JoSweepDef {
    /* scene of every run. `overrides` hold for all variants; `seed` is the first of the seeds,
       which count up from it (without `has_seed`: from 1); `threads` 0 means one thread per run */
    JoSceneDef scene;
    /* settings to vary, each "PATH=A,B,C"; a comma within brackets or quotes does not separate
       values. The variants are all combinations of the values. */
    const char *const *sets;
    size_t set_count;
    uint32_t seeds;   /* number of seeds for each variant; default 1 */
    double seconds;   /* simulated time of a run, s; default NAN: as the scene says */
    uint64_t steps;   /* steps of a run; 0: by `seconds` */
    const char *out;  /* SQLite file of the sweep; an existing one is continued; NULL: in memory */
    const char *data; /* folder for the probes' CSV files of each seed, in seed-N, for which runs
                         that the file holds are repeated; NULL: none */
    uint32_t jobs;    /* runs at the same time; 0: as many as processors that this process may use,
                         divided by the threads of a run */
    uint32_t only; /* does one run alone, given by its number from 1, which counts all seeds of the
                      first variant, then those of the next; 0: all runs */
    bool again;    /* repeat runs that the file holds as failed */
    bool renew;    /* where the file was made from other inputs (scene, behaviours, settings):
                      overwrite it instead of refusing it. Also removes runs of other seeds */
    bool quiet;    /* no progress on stderr */
    /* Reads the files of a variant before it is loaded, and may refuse it: false with `error`,
       after sending the reason to people; the variant's runs then count as failed. NULL: none. */
    bool (*vet)(void *context, const JoSceneDef *scene, JoError *error);
    void *vet_context;
    const volatile int *stop; /* the call returns once this int is not 0; NULL: never earlier */
    JoMessage *message;       /* NULL: to stderr */
    void *message_context;
    uint32_t cookie;
} JoSweepDef;
JO_API JoSweepDef jo_default_sweep_def(void);
/* Numbers of runs of a sweep. */
typedef struct JoSweepCounts {
    uint32_t runs, done; /* all runs (with `only` 1); those with figures */
    uint32_t kept;       /* done and failed runs that the file held before this call */
    uint32_t troubled;   /* done runs with troubles (jo_scene_troubles) */
    uint32_t failed;     /* runs that ended without figures; the file holds the reason */
    uint32_t missing;    /* runs that were not done, as the sweep was stopped, or that no part of
                            a merge has */
} JoSweepCounts;
/* Does the runs that the file lacks. A run that fails, or whose variant does not load, is stored
   with its reason and does not end the sweep. *summary, unless `summary` is NULL, becomes
   jo_summaries_aggregate of all runs with figures. False with `error`, and finished runs are kept:
   JO_USAGE if the def makes no sense, JO_INPUT if no variant loads, or if the file is not that of a
   sweep or was made from other inputs, JO_FAILED if the file cannot be written or the sweep was
   stopped. */
JO_API bool jo_sweep(const JoSweepDef *def, JoSweepCounts *counts, char **summary, JoError *error);
/* Returns how many runs a sweep has, without doing any; 0 with `error`. */
JO_API uint32_t jo_sweep_runs(const JoSweepDef *def, JoError *error);
/* A run of a sweep: its number (as JoSweepDef.only takes it), seed, and state: "done", "troubled",
   "failed", "missing" if no file has it, or "unreadable" if its part cannot be read. The texts are
   valid within the call. */
typedef struct JoSweepRunState {
    uint32_t number;
    uint64_t seed;
    const char *variant; /* "count=100, speed=1.2"; "" for a single variant */
    const char *state;
    const char *part;   /* file for this run alone */
    const char *reason; /* of "unreadable"; else NULL */
} JoSweepRunState;
typedef void JoSweepEachRun(void *context, const JoSweepRunState *run);
/* Calls `each` for every run of a sweep in the order of their numbers, without doing any. The state
   is that in JoSweepDef.out, or else in FOLDER/run-NNNNNN.sqlite, the run's part. False with
   `error`. */
JO_API bool jo_sweep_states(const JoSweepDef *def, const char *folder, JoSweepEachRun *each,
                            void *context, JoError *error);

typedef struct JoSweepMergeDef {
    const char *out; /* created, or continued */
    /* files of the same sweep, made on several machines with JoSweepDef.only for instance */
    const char *const *parts;
    size_t part_count;
    bool partial;       /* merge also if planned runs are missing */
    JoMessage *message; /* gets the names of missing runs; NULL: to stderr */
    void *message_context;
    uint32_t cookie;
} JoSweepMergeDef;
JO_API JoSweepMergeDef jo_default_sweep_merge_def(void);
/* Merges files of a sweep. False with `error`: JO_INPUT if planned runs are missing (then nothing
   is written), if a file belongs to no sweep or another one, or if two have different results for
   the same run. */
JO_API bool jo_sweep_merge(const JoSweepMergeDef *def, JoSweepCounts *counts, JoError *error);
/* Rewrites a sweep's file in the order of its plans, without what differs between machines and
   repetitions: times of computation, the instruction set, the number of threads. Files of the same
   runs then are the same bytes (of the same SQLite). False with `error`; the file is as before. */
JO_API bool jo_sweep_make_canonical(const char *path, JoError *error);
/* Writes the runs of a sweep's file as CSV to the file `csv` ("-": standard output): one row per
   run, with the variant's settings, seed, state and figures as columns. */
JO_API bool jo_sweep_csv(const char *sweep, const char *csv, JoError *error);

/* ---- comparisons -------------------------------------------------------------------------
 *
 * A comparison sets sides against each other: a side is a variant of a sweep, with its runs, or one
 * or more recordings. One side is the base; for each figure the differences of the others from it
 * are estimated, with confidence intervals. */

typedef struct JoCompareDef {
    /* paths of sweeps' files, each variant of which becomes a side, and of recordings */
    const char *const *sides;
    size_t side_count;
    /* one entry per item of `sides`: for a recording the result of jo_report, which has its
       figures, for a sweep's file NULL. NULL if there are no recordings. */
    const char *const *summaries;
    /* one entry per item of `sides`: consecutive recordings with the same name here, such as their
       folder's, become the runs of one side of that name; NULL for a side of its own. NULL: all are
       sides of their own. */
    const char *const *folders;
    double fps, unit; /* frames a second and unit of length of recordings, m, as for jo_report; 0:
                         as they say */
    const char *const *labels; /* names of the first `label_count` sides, in the order of `sides`;
                                  further ones are named by what distinguishes them */
    size_t label_count;
    const char *base;   /* the base: number of a side from 1, name or file; NULL: the first */
    const char *out;    /* folder for a page, index.html, made if it is missing; NULL: none */
    JoReportHead head;  /* head of the page of one side, whose runs differ by seeds */
    double share;       /* confidence level of intervals, 0.5 to below 1; default 0.95 */
    double percentile;  /* per cent, 0 to below 100: adds to the result this percentile of each
                           figure over a side's runs, an upper confidence bound for it, and the worst
                           run; default 0: none */
    uint32_t resamples; /* number of bootstrap samples for intervals; default 0: Student's t */
    bool all;           /* write all figures into the text, not only the main ones */
    JoMessage *message; /* NULL: to stderr */
    void *message_context;
    uint32_t cookie;
} JoCompareDef;
JO_API JoCompareDef jo_default_compare_def(void);
/* Compares the sides and returns the result as text, a table for people; *json, unless `json` is
   NULL, becomes the same as JSON, to be freed with jo_free. NULL with `error`: JO_INPUT if a file
   is neither a sweep's nor a recording, JO_FAILED if the page cannot be written. */
JO_API char *jo_compare(const JoCompareDef *def, char **json, JoError *error);

/* ---- checks, tests, claims, reference pages ---------------------------------------------- */

/* Checks `count` paths of scenes, behaviours and mods, or folders of them, without running them.
   The errors go to `message` in one call: as text that ends with their number, or with `json` as
   one JSON array. Returns the number of errors, or SIZE_MAX with `error` if memory ran out. */
JO_API size_t jo_check(const char *const *paths, size_t count, bool json, JoMessage *message,
                       void *context, JoError *error);
/* Runs tests of behaviours in `count` paths: files, or folders with files that end with _test.lua.
   `only`, if not NULL, selects the tests whose name contains it. Results go to `message`: as text
   after each test, or with `json` as one JSON array at the end. Writes how many tests passed and
   failed. False if a file cannot be run or there are no tests, with the reason sent to `message`,
   or, with `error`, if memory ran out. */
JO_API bool jo_test(const char *const *paths, size_t count, const char *only, bool json,
                    JoMessage *message, void *context, size_t *passed, size_t *failed,
                    JoError *error);
/* Definition of a reproduction of claims. A claim is a file that names a published result, the runs
   that ought to show it, and the band in which the measured value must lie
   (scenes/claims/README.md). */
typedef struct JoReproduceDef {
    const char *folder;        /* folder of claim files; default scenes/claims */
    const char *const *claims; /* ids of claims, or names of files; none: all */
    size_t claim_count;
    const char *const *sets; /* "PATH=VALUE": settings of every run, which override its claim's */
    size_t set_count;
    const char *out;     /* folder for runs, pictures and the page; default build/out/reproduce */
    const char *program; /* path of the command `jostle`, which is started for each run */
    uint32_t jobs;       /* runs at the same time; default: the number of processors */
    const char *seeds;   /* "101" or "101-110": seeds that override those of each claim; or NULL */
    bool quick;          /* fewer and smaller runs; leaves out claims that need the full ones */
    bool fresh;          /* repeat runs whose results are in `out` already */
    /* only claims that are tests of standards; also writes a page for authorities */
    bool standards;
    bool list;                /* list the claims, run nothing */
    bool quiet;               /* no progress on stderr */
    const volatile int *stop; /* the call returns once this int is not 0; NULL: never earlier */
    JoMessage *message;       /* NULL: to stdout */
    void *message_context;
} JoReproduceDef;
JO_API JoReproduceDef jo_default_reproduce_def(void);
/* Does the runs that claims need, measures them, sends a table to `message` and writes index.html,
   table.md and results.json into `out`, with `standards` also standards.html. *missed becomes the
   number of claims out of band. False with `error` if that could not be done, or was stopped;
   errors in claim files went to `message`. */
JO_API bool jo_reproduce(const JoReproduceDef *def, size_t *missed, JoError *error);
/* Returns the graph of a behaviour in the language of Graphviz: states as boxes, transitions with
   their conditions. def->path is the file of a behaviour (.lua), or a scene, of whose behaviours
   `behaviour` names one (NULL: the only one). Errors of files go to def->message. NULL with
   `error`, to be freed with jo_free. */
JO_API char *jo_graph(const JoSceneDef *def, const char *behaviour, JoError *error);
/* Draws such a graph into a file .svg, .png or .pdf, by Graphviz' program dot. False with `error`.
 */
JO_API bool jo_graph_draw(const char *graph, const char *path, JoError *error);
/* Returns a generated page or file by name, as `jostle reference` prints them: "behaviours" and
   "scenes" (Markdown), "inputs" (entries of the input log, Markdown), "lua-ls" and "luacheck"
   (definitions for editors), "scene-schema" and "mod-schema" (JSON Schema). NULL if there is no
   page of that name. */
JO_API char *jo_reference(const char *what);
/* Documents, as Markdown, the mods that a run of def's scene would load (path NULL: the mods that
   `def` names and those that the user turned on): their behaviours, and the functions and values of
   the files that others may require, with the comments before them. Errors go to def->message. */
JO_API char *jo_mods_reference(const JoSceneDef *def);
/* Returns the reference of the scene format as plain text. */
JO_API char *jo_scene_reference(void);

#ifdef __cplusplus
}
#endif
#endif
