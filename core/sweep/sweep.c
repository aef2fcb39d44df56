/* jo_sweep: reads the inputs, lists the runs that the file lacks, and does these in child
   processes. A run whose process crashes is stored as failed; the others go on. */
#include "sweep/sweep.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/assert.h"
#include "base/clock.h"
#include "base/format/piece_file.h"
#include "base/guard.h"
#include "run/messages.h"
#include "sweep/inputs.h"
#include "sweep/store.h"
#include "task/children.h"
#include "task/processors.h"

enum { SWEEP_COOKIE = 0x4a4f5357 };

JoSweepDef jo_default_sweep_def(void) {
    return (JoSweepDef){
        .scene = jo_default_scene_def(), .seeds = 1, .seconds = NAN, .cookie = SWEEP_COOKIE};
}

typedef struct Job {
    uint32_t variant;
    int64_t id; /* id of the variant in the file's tables */
    uint64_t seed;
} Job;

typedef struct Sweep {
    const JoSweepDef *def;
    JoxSweepPlan plan;
    JoxSweepStore store;
    bool whole;           /* the file is made in memory, and written at the end */
    JoxOverlay files;     /* texts of all files that the runs read */
    char **names;         /* by variant */
    bool *heard;          /* by variant: messages of one of its runs were passed on */
    char **refused;       /* by variant: why it does not load, or NULL */
    Job *jobs;            /* runs that the file lacks */
    uint32_t count, next; /* jobs; the first that is not started */
    size_t capacity;
    JoSweepCounts counts;
    double begun, shown; /* s of wall time: start of the runs; last progress line */
    uint32_t tenth;      /* tenths done at the last progress line */
} Sweep;

static bool is_stopped(const Sweep *s) {
    return s->def->stop && __atomic_load_n(s->def->stop, __ATOMIC_RELAXED);
}

static void pass_sweep_message(const Sweep *s, const char *text) {
    jox_run_send_message(s->def->message, s->def->message_context, text);
}

/* "scenes/a.yaml, count=100, seed 7" */
static void name_run(const Sweep *s, uint32_t variant, uint64_t seed, JoxText *out) {
    jox_text_printf(out, "%s, %s%sseed %llu", s->def->scene.path, s->names[variant],
                    *s->names[variant] ? ", " : "", (unsigned long long)seed);
}

/* ---- in the child ---- */

/* Runs in the child: simulates one job from the texts that were read. */
static void run_job_in_child(void *context, uint64_t number, JoxText *result) {
    const Sweep *s = context;
    const Job *job = &s->jobs[number];
    char *folder = NULL;
    JoSceneDef scene = jox_sweep_scene_def(s->def, &s->plan.variants[job->variant], job->seed);
    if (s->def->data) {
        JoxText text = {0};
        jox_text_printf(&text, "%s/seed-%llu", s->def->data, (unsigned long long)job->seed);
        folder = text.data;
    }
    jox_overlay_use(&s->files);
    jox_sweep_simulate(&(JoxSweepRun){&scene, s->def->seconds, s->def->steps, folder}, result);
}

/* ---- the jobs ---- */

/* Counts a run and makes it a job, unless the file has it already. */
static bool add_sweep_job(Sweep *s, uint32_t variant, uint64_t seed, JoError *error) {
    Job job = {.variant = variant, .seed = seed};
    int state;
    if (!jox_sweep_find_variant(&s->store, s->plan.variants[variant].key, &job.id, error) ||
        !jox_sweep_find_state(&s->store, job.id, seed, &state, error))
        return false;
    s->counts.runs++;
    if (state < 0 || s->def->data || (state == JOX_SWEEP_FAILED && s->def->again)) {
        JOX_RESERVE(s->jobs, s->capacity, s->count + 1);
        s->jobs[s->count++] = job;
        return true;
    }
    s->counts.kept++;
    s->counts.done += state != JOX_SWEEP_FAILED;
    s->counts.troubled += state == JOX_SWEEP_TROUBLED;
    s->counts.failed += state == JOX_SWEEP_FAILED;
    return true;
}

/* Lists the jobs seed by seed, each of all variants, so that early results compare all variants. */
static bool list_jobs(Sweep *s, JoError *error) {
    const JoxSweepPlan *plan = &s->plan;
    const uint32_t only = s->def->only;
    for (uint32_t n = 0; n < plan->seeds; n++)
        for (uint32_t v = 0; v < plan->variant_count; v++)
            if ((!only || only == 1 + v * plan->seeds + n) &&
                !add_sweep_job(s, v, plan->first_seed + n, error))
                return false;
    return true;
}

/* Refuses a file that was begun with other inputs; the differences are sent as a message. */
static bool refuse_file(const Sweep *s, const JoxText *differences, JoError *error) {
    JoxText text = {0};
    jox_text_printf(&text, "%s:\n%s", s->def->out, differences->data);
    pass_sweep_message(s, text.data);
    jox_text_free(&text);
    jox_error(error, JO_INPUT,
              "%s was begun with other inputs, so its runs cannot be compared with these: give "
              "another --out, or bring back the former inputs",
              s->def->out);
    return false;
}

/* Opens the file, stores what all runs share, and lists the jobs. If the file was begun with other
   inputs, fills `differences` and writes nothing. A file of one run is made in memory, to appear
   as a whole once the run has ended: what is there is never a part of a result. */
static bool try_file(Sweep *s, JoxText *differences, JoError *error) {
    JoError ignored;
    struct stat info;
    s->whole = s->def->only && s->def->out && lstat(s->def->out, &info) != 0;
    if (!(s->whole ? jox_sweep_open_in_memory(&s->store, s->def->out, error)
                   : jox_sweep_open(&s->store, s->def->out, error)) ||
        !jox_sweep_execute(&s->store, "BEGIN IMMEDIATE", error) ||
        !jox_sweep_note_inputs(&s->store, s->def, &s->files, differences, error))
        return false;
    if (differences->length)
        return jox_sweep_execute(&s->store, "ROLLBACK", &ignored);
    return (!s->def->renew ||
            jox_sweep_keep_seeds(&s->store, s->plan.first_seed, s->plan.seeds, error)) &&
           jox_sweep_note_plan(&s->store, &s->plan, error) && list_jobs(s, error) &&
           jox_sweep_execute(&s->store, "COMMIT", error);
}

/* Opens the file; one of other inputs is deleted and begun anew if the def says `renew`. */
static bool open_file(Sweep *s, JoError *error) {
    JoxText differences = {0};
    bool good = try_file(s, &differences, error);
    if (good && differences.length && s->def->renew) {
        jox_sweep_close(&s->store);
        differences.length = 0;
        good = unlink(s->def->out) == 0;
        if (good)
            good = try_file(s, &differences, error);
        else
            jox_error(error, JO_FAILED, "cannot replace '%.300s': %s", s->def->out,
                      strerror(errno));
    }
    if (good && differences.length)
        good = refuse_file(s, &differences, error);
    jox_text_free(&differences);
    return good;
}

/* ---- the runs ---- */

/* Shows on stderr how many runs have ended, and an estimate of the time left: on a terminal one
   line that is rewritten, else a line for each tenth of the runs. */
static void show_sweep_progress(Sweep *s, uint32_t running, bool last) {
    const uint32_t all = s->counts.runs, ended = s->counts.done + s->counts.failed;
    const uint32_t own = ended - s->counts.kept, tenth = all ? 10 * ended / all : 10;
    const bool terminal = isatty(2);
    const double now = jox_clock_wall(), spent = now - s->begun;
    if (s->def->quiet || (terminal ? now - s->shown < 0.2 && !last : tenth == s->tenth && !last) ||
        (last && !terminal && s->tenth == tenth && ended > 0))
        return;
    s->shown = now;
    s->tenth = tenth;
    fprintf(stderr, "%s%u of %u %s done", terminal ? "\r\033[K" : "", ended, all,
            all == 1 ? "run" : "runs");
    if (s->counts.kept || s->counts.failed)
        fputs(" (", stderr);
    if (s->counts.kept)
        fprintf(stderr, "%u from before%s", s->counts.kept, s->counts.failed ? ", " : "");
    if (s->counts.failed)
        fprintf(stderr, "%u failed", s->counts.failed);
    if (s->counts.kept || s->counts.failed)
        fputs(")", stderr);
    fprintf(stderr, ", %u running, %.0f s", running, spent);
    if (own > 0 && ended < all)
        fprintf(stderr, ", about %.0f s left", spent / own * (all - ended));
    if (!terminal || last)
        fputs("\n", stderr);
}

/* Passes on the messages of the first run of each variant, and the reason of every run that went
   wrong. */
static void report_run(Sweep *s, const Job *job, JoxSweepState state, const char *reason,
                       const char *said) {
    JoxText text = {0};
    if (said && *said && !s->heard[job->variant])
        jox_text_add(&text, said);
    s->heard[job->variant] |= said != NULL;
    if (state != JOX_SWEEP_DONE) {
        name_run(s, job->variant, job->seed, &text);
        jox_text_printf(&text, "%s: %s\n", state == JOX_SWEEP_FAILED ? " failed" : "",
                        reason ? reason : "it is not known why");
    }
    if (text.length)
        pass_sweep_message(s, text.data);
    jox_text_free(&text);
}

static void count_state(Sweep *s, JoxSweepState state) {
    s->counts.done += state != JOX_SWEEP_FAILED;
    s->counts.troubled += state == JOX_SWEEP_TROUBLED;
    s->counts.failed += state == JOX_SWEEP_FAILED;
}

/* Stores the results of a child that ended well, and counts and reports the run. */
static bool take_result(Sweep *s, const Job *job, const JoxText *pieces, JoError *error) {
    const char *reason = NULL, *said = NULL;
    uint32_t state = JOX_SWEEP_FAILED;
    JoxPiece piece;
    char why[200];
    for (size_t at = 0; jox_pieces_next(pieces, &at, &piece, why);) {
        if (!strcmp(piece.name, "state") && piece.length == sizeof state)
            memcpy(&state, piece.data, sizeof state);
        else if (!strcmp(piece.name, "reason"))
            reason = piece.data;
        else if (!strcmp(piece.name, "said"))
            said = piece.data;
    }
    if (!jox_sweep_put_run(&s->store, job->id, job->seed, pieces, error))
        return false;
    count_state(s, (JoxSweepState)state);
    report_run(s, job, (JoxSweepState)state, reason, said);
    return true;
}

/* Stores what a child left: its results, or why it failed. */
static bool take_end(Sweep *s, const JoxChildEnd *end, JoError *error) {
    const Job *job = &s->jobs[end->job];
    if (end->good)
        return take_result(s, job, &end->result, error);
    if (end->killed && s->def->only) { /* says nothing about the scene: leaves the run to be done */
        jox_error(error, JO_FAILED,
                  "run %u: %s. Nothing is stored: the same command does the run again",
                  s->def->only, end->why);
        return false;
    }
    if (!jox_sweep_put_failure(&s->store, job->id, job->seed, end->why, error))
        return false;
    count_state(s, JOX_SWEEP_FAILED);
    report_run(s, job, JOX_SWEEP_FAILED, end->why, NULL);
    return true;
}

/* Stores the run of a variant that does not load as failed, without starting a process. */
static bool take_refused(Sweep *s, const Job *job, JoError *error) {
    const char *why = s->refused[job->variant];
    if (!jox_sweep_put_failure(&s->store, job->id, job->seed, why, error))
        return false;
    count_state(s, JOX_SWEEP_FAILED);
    if (!s->heard[job->variant])
        report_run(s, job, JOX_SWEEP_FAILED, why, NULL);
    s->heard[job->variant] = true;
    return true;
}

/* Starts jobs while there is room, and stores each result, until all are done or the def's `stop`
   is set. */
static bool run_jobs(Sweep *s, JoxChildren *children, JoError *error) {
    while (!is_stopped(s) && (s->next < s->count || jox_children_count(children))) {
        if (s->next < s->count && s->refused[s->jobs[s->next].variant]) {
            if (!take_refused(s, &s->jobs[s->next++], error))
                return false;
            continue;
        }
        if (s->next < s->count && jox_children_has_room(children)) {
            if (jox_children_start(children, s->next, run_job_in_child, s)) {
                s->next++;
                continue;
            }
            if (jox_children_count(children) == 0) {
                jox_error(error, JO_FAILED, "no process can be started: %s", strerror(errno));
                return false;
            }
        }
        JoxChildEnd end;
        show_sweep_progress(s, jox_children_count(children), false);
        if (jox_children_wait(children, &end)) {
            const bool good = take_end(s, &end, error);
            jox_text_free(&end.result);
            if (!good)
                return false;
        }
    }
    return true;
}

/* Returns the aggregate of all stored summaries as JSON, to be freed; NULL with `error`. */
static char *aggregate_summaries(Sweep *s, JoError *error) {
    sqlite3_stmt *ask = jox_sweep_prepare(
        &s->store, "SELECT summary FROM run WHERE summary NOT NULL ORDER BY variant, seed", error);
    char **texts = NULL;
    size_t texts_count = 0, capacity = 0;
    int code = ask ? SQLITE_ROW : SQLITE_ERROR;
    while (ask && (code = sqlite3_step(ask)) == SQLITE_ROW) {
        JOX_RESERVE(texts, capacity, texts_count + 1);
        texts[texts_count++] = jox_strdup((const char *)sqlite3_column_text(ask, 0));
    }
    char *all = NULL;
    if (code == SQLITE_DONE)
        all = jo_summaries_aggregate((const char *const *)texts, texts_count, error);
    else if (ask)
        jox_sweep_set_error(&s->store, error);
    jox_sweep_finalize(&s->store, ask);
    for (size_t t = 0; t < texts_count; t++)
        jox_free(texts[t]);
    jox_free(texts);
    return all;
}

/* Reads the inputs, opens the file and does the runs. *summary, unless NULL, becomes the aggregate
   of all runs. Returns false with `error`, also if the sweep was stopped. */
static bool run_sweep(Sweep *s, char **summary, JoError *error) {
    s->refused = jox_alloc(s->plan.variant_count, sizeof *s->refused);
    if (!jox_sweep_load_inputs(s->def, &s->plan, (const char *const *)s->names, &s->files,
                               s->refused, error) ||
        !open_file(s, error))
        return false;
    const uint32_t threads = s->def->scene.threads ? s->def->scene.threads : 1;
    const uint32_t each = jox_count_processors() / threads; /* children that this leaves room for */
    const uint32_t jobs = s->def->jobs ? s->def->jobs : each ? each : 1;
    s->heard = jox_alloc(s->plan.variant_count, sizeof *s->heard);
    s->begun = jox_clock_wall();
    JoxChildren *children = jox_children_create(jobs < s->count ? jobs : s->count ? s->count : 1);
    const bool good = run_jobs(s, children, error);
    jox_children_free(children);
    show_sweep_progress(s, 0, true);
    s->counts.missing = s->counts.runs - s->counts.done - s->counts.failed;
    if (good && s->whole && s->counts.missing == 0 && !jox_sweep_write_file(&s->store, error))
        return false;
    if (good && is_stopped(s)) {
        jox_error(error, JO_FAILED,
                  s->whole && s->counts.missing
                      ? "interrupted; nothing is stored, and the same command does the run"
                  : s->def->out ? "interrupted; %u of %u runs are kept in %s, and the same command "
                                  "continues with it"
                                : "interrupted",
                  s->counts.done + s->counts.failed, s->counts.runs, s->def->out);
        return false;
    }
    if (good && summary && !(*summary = aggregate_summaries(s, error)))
        return false;
    return good;
}

static void free_sweep(Sweep *s) {
    jox_sweep_close(&s->store);
    for (uint32_t v = 0; s->names && v < s->plan.variant_count; v++) {
        jox_free(s->names[v]);
        jox_free(s->refused ? s->refused[v] : NULL);
    }
    jox_free(s->refused);
    jox_free(s->names);
    jox_free(s->heard);
    jox_free(s->jobs);
    jox_overlay_free(&s->files);
    jox_sweep_free_plan(&s->plan);
}

/* Makes the plan of the def, and names its variants. */
static bool plan_sweep(Sweep *s, JoError *error) {
    const JoSweepDef *def = s->def;
    const uint64_t first = def->scene.has_seed ? def->scene.seed : 1;
    if (!jox_sweep_make_plan(&s->plan, def->sets, def->set_count, first, def->seeds, error))
        return false;
    const uint32_t variants = s->plan.variant_count;
    if (def->only > variants * def->seeds) {
        jox_error(error, JO_USAGE, "there is no run %u: the sweep has %u", def->only,
                  variants * def->seeds);
        return false;
    }
    s->names = jox_sweep_name_plan(&s->plan);
    return true;
}

uint32_t jo_sweep_runs(const JoSweepDef *def, JoError *error) {
    JOX_REQUIRE(def && def->cookie == SWEEP_COOKIE && def->seeds > 0, 0);
    JOX_GUARD (NULL, error)
        return 0;
    Sweep s = {.def = def};
    const uint32_t runs = plan_sweep(&s, error) ? s.plan.variant_count * s.plan.seeds : 0;
    free_sweep(&s);
    return runs;
}

bool jo_sweep(const JoSweepDef *def, JoSweepCounts *counts, char **summary, JoError *error) {
    JOX_REQUIRE(def && def->cookie == SWEEP_COOKIE && def->scene.path && counts, false);
    JOX_REQUIRE(def->seeds > 0 && !(def->seconds < 0), false);
    JOX_GUARD (NULL, error) {
        jox_run_send_message(def->message, def->message_context, "out of memory\n");
        return false;
    }
    Sweep s = {.def = def};
    *counts = (JoSweepCounts){0};
    const bool good = plan_sweep(&s, error) && run_sweep(&s, summary, error);
    *counts = s.counts;
    if (good && summary)
        jox_disown(*summary);
    free_sweep(&s);
    return good;
}
