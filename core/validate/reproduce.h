/* What the files of jo_reproduce share: claims, the runs that they need, and what came of them. */
#ifndef JOX_VALIDATE_REPRODUCE_H
#define JOX_VALIDATE_REPRODUCE_H

#include <stdio.h>
#include <sys/types.h>

#include "jostle_tools.h"
#include "run/run.h"
#include "validate/claims.h"
#include "validate/verdict.h"

typedef enum { JOX_JOB_WAITS, JOX_JOB_RUNS, JOX_JOB_DONE, JOX_JOB_FAILED } JoxJobState;

/* One run of a scene, as a process of its own. */
typedef struct JoxJob {
    char *key; /* all that it depends on but the contents of files */
    char *folder;
    const JoxClaimRun *run;
    uint64_t seed;
    bool pictures; /* of its report; else only the data */
    JoxJobState state;
    pid_t process;
    bool reused;
    char *failure; /* what it said, where it failed */
} JoxJob;

typedef struct JoxOutcome {
    JoxClaim *claim;
    uint32_t **jobs;      /* [run][seed], index of the job; rows are claim->runs[r].seeds long */
    uint32_t seeds;       /* the most of its runs */
    JoxVerdict *verdicts; /* by figure */
    char *failure;        /* why it could not be measured, or NULL */
    bool inside, thin;    /* thin: of one of its figures */
} JoxOutcome;

typedef struct JoxReproduction {
    const JoReproduceDef *def;
    JoxOutcome *outcomes;
    uint32_t outcome_count;
    JoxJob *jobs;
    uint32_t job_count;
    size_t job_capacity;
    char program_sha256[65];
    uint64_t first_seed;
    uint32_t seeds;   /* in place of those of each claim; 0: those */
    double seconds;   /* wall time of all */
    JoxText left_out; /* ids of claims that have no quick runs */
} JoxReproduction;

/* reproduce_runs.c: does all jobs that are not done already, several at once; false where it was
   interrupted. */
bool jox_reproduce_run(JoxReproduction *all);
/* reproduce_plots.c: plots of figures, plots/NAME.png of the folder of results, for each claim that
   was measured. */
bool jox_reproduce_plots(const JoxReproduction *all, JoxText *error);
/* NAME of a plot: of its claim's file and its own. */
void jox_reproduce_plot_name(const JoxClaim *claim, const JoxClaimPlot *plot, char *out,
                             size_t size);
/* reproduce_deviations.c: a table of what the claims' scenes and behaviours set otherwise than the
   engine. */
void jox_reproduce_deviations(const JoxReproduction *all, FILE *out);
/* reproduce_standards.c: whether a claim is a test of a standard; and one of the group "rimea",
   "imo", "nist", or "standards", which are all of them. */
bool jox_is_standard(const JoxClaim *claim);
bool jox_standards_have(const JoxClaim *claim, const char *group);
/* standards.html in the folder of results. */
bool jox_reproduce_standards(const JoxReproduction *all, JoxText *error);
/* reproduce_page.c: what was run, when and where, in a line; the pictures of a claim. */
void jox_reproduce_when(const JoxReproduction *all, char *out, size_t size);
void jox_reproduce_pictures(FILE *out, const JoxReproduction *all, const JoxOutcome *outcome);
/* reproduce_page.c: index.html, table.md and results.json in the folder of results. */
bool jox_reproduce_write(const JoxReproduction *all, JoxText *error);

#endif
