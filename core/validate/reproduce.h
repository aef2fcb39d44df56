/* State of jo_reproduce, shared by reproduce*.c. reproduce.c has claims loaded, plans their runs as
   jobs, has reproduce_runs.c execute these, measures, and has the other files write the results. */
#ifndef JOX_VALIDATE_REPRODUCE_H
#define JOX_VALIDATE_REPRODUCE_H

#include <stdio.h>
#include <sys/types.h>

#include "jostle_tools.h"
#include "run/run.h"
#include "validate/claims.h"
#include "validate/verdict.h"

typedef enum { JOX_JOB_WAITS, JOX_JOB_RUNS, JOX_JOB_DONE, JOX_JOB_FAILED } JoxJobState;

/* One run of a scene with one seed, in its own process. Claims that need the same run share a
   job. */
typedef struct JoxJob {
    char *key;    /* all that the run depends on, except the contents of files */
    char *folder; /* where it leaves its files */
    const JoxClaimRun *run;
    uint64_t seed;
    bool pictures; /* writes a report with pictures; else only data files */
    JoxJobState state;
    pid_t process;
    bool reused;   /* done by an earlier call */
    char *failure; /* the end of its output, if it failed; else NULL */
} JoxJob;

/* The runs of a claim, or of its null, with their jobs and the figures measured from them. */
typedef struct JoxMeasured {
    JoxClaimRun *runs; /* the claim's; NULL: it has no null */
    /* [run][seed]: index of the job; row r has runs[r].seeds elements */
    uint32_t **jobs;
    uint32_t fewest_seeds, seeds; /* fewest and greatest number of seeds of the runs */
    JoxVerdict *verdicts;         /* per figure */
    char *failure;                /* reason if it could not be measured, or NULL */
} JoxMeasured;

/* Number of figures with a band, and how many of them are in it. */
typedef struct JoxFigureCount {
    uint32_t inside, banded;
} JoxFigureCount;

/* A claim with its jobs and the verdicts on its figures. */
typedef struct JoxOutcome {
    JoxClaim *claim;
    JoxMeasured own, null;
    JoxFigureCount count;
    bool inside, thin;   /* all figures are in band; the verdict on a figure is thin */
    bool proves_nothing; /* no figure of the null misses its band */
} JoxOutcome;

/* Returns whether a claim is in band and its null is not. */
static inline bool jox_outcome_holds(const JoxOutcome *outcome) {
    return outcome->inside && !outcome->proves_nothing;
}
/* Returns the verdict on a claim in words. */
static inline const char *jox_outcome_verdict(const JoxOutcome *outcome) {
    return !outcome->inside          ? "misses"
           : outcome->null.failure   ? "no evidence: the null could not be measured"
           : outcome->proves_nothing ? "no evidence: the null misses no band"
                                     : "in band";
}

/* Stands on the pages of quick runs before the ids of the claims that were cut. */
#define JOX_SAYS_QUICK                                                                             \
    "Verdicts of quick runs are not the published ones. Cut to fewer seeds or shorter runs: "

typedef struct JoxReproduction {
    const JoReproduceDef *def;
    JoxOutcome *outcomes;
    uint32_t outcome_count;
    JoxFigureCount count; /* figures in band, over all claims */
    JoxJob *jobs;         /* jobs of all claims */
    uint32_t job_count;
    size_t job_capacity;
    char program_sha256[65];
    uint64_t first_seed;
    uint32_t seeds;   /* number of seeds from first_seed on; 0: as each claim has them */
    double seconds;   /* s: wall time of all runs */
    JoxText left_out; /* ids of claims left out because they have no quick runs */
    JoxText cut;      /* ids of claims with fewer or smaller runs for `quick` */
} JoxReproduction;

/* reproduce_claims.c: loads the selected claims of the folder, sorted by id, with errors for
   unknown selections. */
void jox_reproduce_load_claims(JoxReproduction *all, JoxDiagnostics *diagnostics);
/* reproduce_runs.c: executes all jobs that are not done already, several at once. Returns false
   if it was interrupted. */
bool jox_reproduce_run(JoxReproduction *all);
/* Returns the text of a file that a job left, for the caller to free, or NULL. */
char *jox_job_read(const JoxJob *job, const char *name);
/* reproduce_plots.c: draws the plots of all measured claims as plots/NAME.png in the folder of
   results. Returns false with a sentence in `error`. */
bool jox_reproduce_draw_plots(const JoxReproduction *all, JoxText *error);
/* Writes NAME of a plot, made of the names of the claim's file and the plot. */
void jox_reproduce_plot_name(const JoxClaim *claim, const JoxClaimPlot *plot, char *out,
                             size_t size);
/* reproduce_deviations.c: writes a table of the parameters that the claims' scenes and
   behaviours set to other values than the engine's defaults. */
void jox_reproduce_put_deviations(const JoxReproduction *all, FILE *out);
/* reproduce_failures.c: write a table of how often people had no solution, by scene, as HTML and as
   Markdown. */
void jox_reproduce_put_failures(const JoxReproduction *all, FILE *out);
void jox_reproduce_write_failures(const JoxReproduction *all, FILE *out);
/* reproduce_standards.c: return whether a claim is a test of any standard, and of one of the
   group "rimea", "imo", "nist", "iso" or "standards" (all of them). */
bool jox_claim_is_standard(const JoxClaim *claim);
bool jox_claim_is_in_standard(const JoxClaim *claim, const char *group);
/* Writes standards.html in the folder of results. Returns false with a sentence in `error`. */
bool jox_reproduce_write_standards(const JoxReproduction *all, JoxText *error);
/* reproduce_page.c: writes a line on what was run, when and where; and the plots and pictures of
   a claim as HTML. */
void jox_reproduce_describe_run(const JoxReproduction *all, char *out, size_t size);
void jox_reproduce_put_pictures(FILE *out, const JoxReproduction *all, const JoxOutcome *outcome);
/* reproduce_table.c: write table.md and results.json in the folder of results. Return false with a
   sentence in `error`. */
bool jox_reproduce_write_table(const JoxReproduction *all, const char *when, JoxText *error);
bool jox_reproduce_write_json(const JoxReproduction *all, JoxText *error);
/* Appends the number of figures in band, of all claims and of each: "3 of 4 figures in band
   (75.0 %): B1 2 of 2, B2 1 of 2"; nothing if no figure has a band. */
void jox_reproduce_add_counts(const JoxReproduction *all, JoxText *out);
/* Writes a figure's band, or `dash` if it has none; returns the verdict on it in words. */
void jox_reproduce_put_band(FILE *out, const JoxClaimFigure *figure, const char *dash);
const char *jox_figure_verdict(const JoxClaimFigure *figure, const JoxVerdict *verdict);
/* reproduce_page.c: writes index.html, table.md and results.json in the folder of results.
   Returns false with a sentence in `error`. */
bool jox_reproduce_write(const JoxReproduction *all, JoxText *error);

#endif
