/* Claims: what a scene is to show, written in Lua. A claim file returns claim { id, title, source,
   text, runs, quick, measure, expect, plots, pictures, tried }; see scenes/claims/README.md. Its
   function measure works on what the runs left (summary, CSV files of probes) and never sees what
   is expected. */
#ifndef JOX_VALIDATE_CLAIMS_H
#define JOX_VALIDATE_CLAIMS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/format/diag.h"
#include "base/text.h"

typedef struct JoxClaimRun {
    char *name, *scene; /* the scene's path, beside the claim's file */
    char **sets;        /* "PATH=VALUE" */
    uint32_t set_count, seeds;
    uint64_t first_seed;
    double dt, duration; /* s; 0: the scene's */
    bool first;          /* takes long: begun before others */
} JoxClaimRun;

typedef struct JoxClaimFigure {
    char *name, *unit, *what,
        *expected;    /* expected: as the source has it, "" where it says nothing */
    double low, high; /* the band; -INFINITY, INFINITY: open */
    bool reported;    /* shown, not judged */
} JoxClaimFigure;

typedef struct JoxClaimPicture {
    char *run, *file;
} JoxClaimPicture;

/* What is drawn of figures. Points of FIGURES are at x and a figure's mean, with its least and most
   and its band; of a MAP at x and y, with a figure's mean as the colour; others as they are given,
   from a source or a law. */
typedef enum { JOX_CURVE_FIGURES, JOX_CURVE_POINTS, JOX_CURVE_LINE, JOX_CURVE_MAP } JoxCurveKind;
typedef struct JoxClaimPoint {
    double x, y;
    uint32_t figure;
} JoxClaimPoint;
typedef struct JoxClaimCurve {
    char *label; /* NULL of a map */
    JoxCurveKind kind;
    JoxClaimPoint *points;
    uint32_t count;
} JoxClaimCurve;
typedef struct JoxClaimPlot {
    char *name, *title, *x, *y, *z; /* of axes, with units; z of a map's colours */
    JoxClaimCurve *curves;          /* one of a map */
    uint32_t curve_count;
} JoxClaimPlot;

typedef struct JoxClaim {
    char *path, *id, *title, *source, *text;
    char *level;                 /* haste of its people: calm, normal, keen; "" where none walk */
    char *calibrated, *held_out; /* what constants were chosen on, and with it, or without; or "" */
    JoxClaimRun *runs;
    JoxClaimFigure *figures;
    JoxClaimPicture *pictures;
    JoxClaimPlot *plots;
    char **tried; /* what was tried where it misses, sentence by sentence */
    uint32_t run_count, figure_count, picture_count, plot_count, tried_count;
    bool too_long;     /* quick = false: nothing smaller would show it */
    JoxClaimRun spare; /* while a file is read */
    struct JoxClaimCode *code;
} JoxClaim;

/* NULL with diagnostics. `quick`: with the smaller runs of its `quick`. */
JoxClaim *jox_claim_load(const char *path, bool quick, JoxDiagnostics *diagnostics);
/* Calls measure once: folders[r] is where run r left summary.json and its CSV files. values[f] by
   figure, NAN where it is not given. False with a sentence in `why`. */
bool jox_claim_measure(const JoxClaim *claim, const char *const *folders, double *values,
                       JoxText *why);
/* Has every run of the claim take values ("PATH=VALUE") besides its own. */
void jox_claim_set(JoxClaim *claim, const char *const *sets, size_t count);
void jox_claim_free(JoxClaim *claim);

#endif
