/* Claims: results that scenes are expected to show, as Lua files. A claim file returns claim {
   id, title, source, text, runs, quick, null, measure, expect, plots, pictures, tried }; see
   scenes/claims/README.md. Its function `measure` computes figures from what the runs left
   (summary, CSV files of probes) and never sees the expected values. reproduce.c runs and
   measures claims, check.c only loads them. */
#ifndef JOX_VALIDATE_CLAIMS_H
#define JOX_VALIDATE_CLAIMS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/format/diag.h"
#include "base/text.h"

/* A run of a scene that a claim needs, with a number of seeds. */
typedef struct JoxClaimRun {
    /* `scene`: path of its file, resolved against the claim's file */
    char *name, *scene;
    char **sets; /* settings "PATH=VALUE" */
    uint32_t set_count, seeds;
    uint64_t first_seed;
    double dt, duration; /* s; 0: as the scene has it */
    bool first;          /* takes long, so it is started before others */
} JoxClaimRun;

/* A figure that `measure` returns, and its expected band. */
typedef struct JoxClaimFigure {
    char *name, *unit; /* key in the table that `measure` returns; unit */
    char *what;        /* description */
    char *expected;    /* value as the source states it, or "" */
    double low, high;  /* edges of the band; -INFINITY or INFINITY: open */
    bool reported;     /* shown without a verdict */
    bool sure;         /* the whole 95 % bound of the mean must lie in the band */
} JoxClaimFigure;

/* A picture of a run's report that the page shows. */
typedef struct JoxClaimPicture {
    char *run, *file;
} JoxClaimPicture;

/* Kinds of curves. FIGURES: x, and a figure's mean with its least and greatest value and its
   band. MAP: x, y, and a figure's mean as colour. POINTS and LINE: x and y as given, from a
   source or a law. */
typedef enum { JOX_CURVE_FIGURES, JOX_CURVE_POINTS, JOX_CURVE_LINE, JOX_CURVE_MAP } JoxCurveKind;
typedef struct JoxClaimPoint {
    double x, y;
    uint32_t figure; /* index, for FIGURES and MAP */
} JoxClaimPoint;
typedef struct JoxClaimCurve {
    char *label; /* NULL for a map */
    JoxCurveKind kind;
    JoxClaimPoint *points;
    uint32_t count;
} JoxClaimCurve;
typedef struct JoxClaimPlot {
    char *name, *title, *x, *y, *z; /* labels of the axes with units; z: label of a map's colours */
    JoxClaimCurve *curves;          /* exactly one for a map */
    uint32_t curve_count;
} JoxClaimPlot;

typedef struct JoxClaim {
    char *path, *id, *title, *source, *text;
    char *also;  /* id of the same test in another standard; "" if there is none */
    char *level; /* haste of the people: calm, normal, keen; "" if none walk */
    /* data that constants were chosen with, or that were held out from it; at most one is not "" */
    char *calibrated, *held_out;
    JoxClaimRun *runs;
    /* The null: the same runs with the cause of the result taken out, or with a wrong input, which
       must miss the band of some figure. null_runs[r] belongs to runs[r]; both NULL: no null. */
    char *null_text;
    JoxClaimRun *null_runs;
    char *no_null; /* why there is no null; "" if there is one, or no word of it */
    JoxClaimFigure *figures;
    JoxClaimPicture *pictures;
    JoxClaimPlot *plots;
    char **tried; /* sentences on what was tried, for a claim that misses its band */
    uint32_t run_count, figure_count, picture_count, plot_count, tried_count;
    bool too_long;     /* `quick = false`: no smaller run would show the result */
    bool cut;          /* read with `quick`, which made some of its runs fewer or smaller */
    JoxClaimRun spare; /* the run of `quick` or `null` that is being read */
    struct JoxClaimCode *code;
} JoxClaim;

/* Loads a claim file; returns NULL with diagnostics. With `quick`, the claim's smaller runs
   replace the full ones, and runs for which it gives no seeds have one. jox_claim_free frees the
   claim. */
JoxClaim *jox_claim_load(const char *path, bool quick, JoxDiagnostics *diagnostics);
/* Calls `measure` once. folders[r] is the folder in which run r left summary.json and its CSV
   files. Sets values[f] of each figure, NAN if it was not returned. Returns false with a
   sentence in `why`; with `whole` also if a figure with a band was not returned. */
bool jox_claim_measure(const JoxClaim *claim, const char *const *folders, bool whole,
                       double *values, JoxText *why);
/* Appends settings ("PATH=VALUE") to all runs of the claim and of its null, except those that the
   null is made of. */
void jox_claim_add_sets(JoxClaim *claim, const char *const *sets, size_t count);
void jox_claim_free(JoxClaim *claim);

#endif
