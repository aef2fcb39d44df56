/* Several sides held against one of them: variants of sweeps, and recordings. */
#ifndef JOX_SWEEP_COMPARE_COMPARE_H
#define JOX_SWEEP_COMPARE_COMPARE_H

#include "base/number/statistics.h"
#include "picture/draw.h"
#include "report/subject.h"
#include "sweep/compare/plan.h"
#include "sweep/store.h"
#include "sweep/sweep.h"

/* ---- a side ---- */

typedef struct JoxSideFigure {
    char *name;
    double *values; /* by run; NAN where the run has none */
} JoxSideFigure;

/* A curve over the runs of a side. */
typedef struct JoxSideCurve {
    char *name, *unit;
    struct JoxSidePoint {
        double time, mean, low, high; /* s; low and high: 5 and 95 % of the runs */
        double median, least, most;   /* of the runs */
    } * points;
    size_t count, capacity;
} JoxSideCurve;

/* Fields over the floor, of all runs of a side. */
typedef enum JoxSideFieldKind {
    JOX_FIELD_GREATEST, /* 1/m2: the greatest density of each place, mean over runs */
    JOX_FIELD_WORST,    /* 1/m2: the same, of the worst run at each place */
    JOX_FIELD_OFTEN,    /* %: runs in which it was JOX_FIELD_DENSE or more there */
    JOX_FIELD_MEAN,     /* 1/m2: density, mean over time and runs */
    JOX_FIELDS
} JoxSideFieldKind;
#define JOX_FIELD_DENSE 5.0f /* 1/m2 */

/* A run as it ended, whether it is compared or left out. */
typedef struct JoxSideRun {
    uint64_t seed;
    JoxSweepState state;
    char *reason, *hash; /* "" where there is none */
} JoxSideRun;

/* What was noted of the file: a key and its value, or an input's path and its SHA-256. */
typedef struct JoxSideNote {
    char *key, *value;
} JoxSideNote;
typedef struct JoxSideNotes {
    JoxSideNote *items;
    uint32_t count;
    size_t capacity;
} JoxSideNotes;

typedef struct JoxSide {
    char *name, *source; /* what it is called; its file */
    char *settings;      /* of a variant: "PATH=VALUE" a line; "" */
    uint64_t *seeds;     /* of its runs, ascending */
    uint32_t runs;       /* with figures, that went as they were written */
    uint32_t left_out;   /* that failed, or did not go as they were written */
    bool recorded;       /* its runs are recordings: no seeds */
    JoxSideRun *all;     /* ascending by seed, those left out too; of recordings none */
    uint32_t all_count;
    size_t all_capacity;
    size_t run_capacity;
    JoxSideFigure *figures;
    uint32_t figure_count;
    size_t figure_capacity;
    JoxSideCurve *curves;
    uint32_t curve_count;
    size_t curve_capacity;
    JoxSweepField fields[JOX_FIELDS]; /* values NULL: none */
    char *plan;                       /* JSON (plan_json.c), or NULL */
    char *title;                      /* of its scene, or NULL */
    JoxSideNotes notes, inputs;
} JoxSide;

typedef struct JoxSides {
    JoxSide *items;
    uint32_t count;
    size_t capacity;
} JoxSides;

/* side_sweep.c: adds each variant of a sweep's file. False with `error`. */
bool jox_sides_add_sweep(JoxSides *sides, const char *path, JoError *error);
/* recording.c: adds recordings as the runs of one side; of each, `summaries` has what jo_report
   says. */
bool jox_sides_add_recordings(JoxSides *sides, const char *source, const char *const *paths,
                              const char *const *summaries, uint32_t count, const JoCompareDef *def,
                              JoError *error);
/* side_fields.c: those of a variant. */
bool jox_side_read_fields(const JoxSweepStore *store, int64_t variant, JoxSide *side,
                          JoError *error);
/* Adds the field of one run, of greatest densities or of mean ones; `cells` are floats by row, NAN
   where nobody can walk. False where the side has one on another grid. After the last of `count`
   runs means are made of sums. */
bool jox_side_add_field(JoxSide *side, bool greatest, const JoxSweepField *grid, const void *cells);
void jox_side_end_fields(JoxSide *side, bool greatest, uint32_t count);
/* side.c */
JoxSide *jox_sides_add(JoxSides *sides, const char *source);
void jox_sides_free(JoxSides *sides);
/* The figure of a name, added where there is none, with NAN for every run. */
JoxSideFigure *jox_side_figure(JoxSide *side, const char *name);
/* The same that is NULL where there is none. */
const JoxSideFigure *jox_side_find(const JoxSide *side, const char *name);
/* Adds a curve; and to it the mean and the spread of the runs' values at a time, s, which it sorts.
 */
JoxSideCurve *jox_side_curve(JoxSide *side, const char *name, const char *unit);
void jox_side_point(JoxSideCurve *curve, double time, double *values, size_t count);

/* plans.c: what a side's plan and maps are drawn of; false where it has no plan. To be ended even
   then. */
typedef struct JoxSideDrawn {
    JoxSidePlan plan;
    JoxDensity grid; /* of its fields, which it has not */
    JoxExits exits;  /* their names alone */
    JoxSubject subject;
} JoxSideDrawn;
bool jox_side_draw_begin(JoxSideDrawn *drawn, const JoxSide *side, const char *folder);
void jox_side_draw_end(JoxSideDrawn *drawn);
/* The greatest value of a field; of one that makes sense. */
double jox_side_field_most(const JoxSide *side, JoxSideFieldKind kind);
/* s: until when the curves go on. */
double jox_side_until(const JoxSide *side);

/* ---- figures in words ---- */

typedef struct JoxFigureWords {
    char text[200];
    const char *unit;
    bool is_key;       /* of those that one asks for first */
    bool low_is_worse; /* as of flows and speeds; not of times, densities and loads */
} JoxFigureWords;
/* Of a figure by its path in summaries. */
JoxFigureWords jox_figure_words(const char *path);
/* A unit as people read it: "per s" of "1/s". */
const char *jox_figure_unit(const char *unit);
/* Whether `a` is to be told before `b`: below 0. */
int jox_figure_order(const char *a, const char *b);

/* ---- one side alone ---- */

/* How a figure spreads over the runs that have it; NAN where none has. */
typedef struct JoxSpread {
    double mean, least, p5, median, p95, most;
    uint32_t runs;
    uint64_t least_seed, most_seed; /* the first that has them */
} JoxSpread;
JoxSpread jox_spread_of(const JoxSide *side, const char *figure);
/* Of the same with a path that is made of parts. */
JoxSpread jox_spread_at(const JoxSide *side, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* In how many runs a figure is greater than 0. */
uint32_t jox_spread_runs_over(const JoxSide *side, const char *figure);
/* "45.2 s (43 to 48.1; at most 49, seed 7)": the median, 5 to 95 % of the runs, and the greatest,
   or where less is worse (`low`) the least; of one value in all runs that alone. */
void jox_spread_say(const JoxSpread *spread, const char *unit, bool low, JoxText *out);
/* A cell with its median and 5 to 95 % of the runs, without a unit. */
void jox_spread_cell(FILE *out, const JoxSpread *spread);

/* seeds_summary.c: the first section; seeds_pictures.c: bands over time and maps, and their part of
   the page; seeds_page.c: index.html of runs that differ by their seeds alone. */
void jox_seeds_summary(FILE *out, const JoxSide *side, const JoxSideDrawn *drawn);
bool jox_seeds_draw(const JoxSide *side, const JoxSideDrawn *drawn, JoxText *why);
void jox_seeds_curves(FILE *out, const JoxSideDrawn *drawn);
void jox_seeds_maps(FILE *out, const JoxSide *side, const JoxSideDrawn *drawn);

/* What was noted under a key; "" where nothing was. */
const char *jox_side_note(const JoxSide *side, const char *key);

/* ---- what is compared ---- */

/* A figure of one side against that of the base. */
typedef struct JoxDifference {
    JoxEffect effect;
    JoxMoments base, other;
    bool adjusted; /* differs after Holm's correction for the number of figures, too */
    size_t base_known, other_known; /* runs that have the figure */
    size_t runs; /* of each side that would tell a difference of this size; 0: not known */
} JoxDifference;

typedef struct JoxCompared {
    const char *figure;
    JoxFigureWords words;
    JoxDifference *sides; /* by side; of the base nothing is compared */
    bool varies;          /* is not the same number in all runs of all sides */
} JoxCompared;

typedef struct JoxComparison {
    const JoCompareDef *def;
    JoxSides sides;
    uint32_t base;
    JoxCompared *figures;
    uint32_t count;
    uint32_t tested; /* figures that a difference could be found in */
} JoxComparison;

/* effects.c: fills figures. */
void jox_compare_effects(JoxComparison *c);
/* What an interval says: "differs", "not told apart", ...; never NULL. */
const char *jox_compare_verdict(const JoxDifference *d);
/* "Student's t of the differences of 20 seeds", ...: how the intervals of a side were made. */
void jox_compare_method(const JoxComparison *c, const JoxDifference *d, char *out, size_t size);
/* Whether a side has so few runs that their spread is hardly known. */
bool jox_compare_is_thin(const JoxComparison *c);
/* The values of a figure that are known, ascending, to be freed; how many. */
double *jox_side_values(const JoxSide *side, const char *figure, size_t *count);

/* table.c, compare_json.c: as text, and as JSON. */
void jox_compare_text(const JoxComparison *c, JoxText *out);
void jox_compare_json(const JoxComparison *c, JoxText *out);
/* plots.c: curve-N.svg and effects.svg; plans.c: plan-N.svg, and PNG; page.c: index.html, of which
   these are parts. False with a sentence in `why`. */
bool jox_compare_plots(const JoxComparison *c, JoxText *why);
bool jox_compare_plans(const JoxComparison *c, JoxText *why);
void jox_compare_plan_figures(FILE *out, const JoxComparison *c);
bool jox_compare_page(const JoxComparison *c, JoxText *why);
void jox_compare_percentiles(FILE *out, const JoxComparison *c);
/* seeds_page.c: the page of one side of a sweep alone. */
bool jox_seeds_page(const JoxComparison *c, JoxText *why);
enum { JOX_COMPARE_CURVES = 24 }; /* that are drawn, at most */
/* The n-th curve by its name, of the first side that has one; NULL behind the last. */
const JoxSideCurve *jox_compare_curve(const JoxComparison *c, uint32_t n);
/* Figures that the effects are drawn of: keys with a base that is not 0 and an interval; and how
   many there are. */
bool jox_compare_is_drawn(const JoxComparison *c, uint32_t figure, uint32_t side);
uint32_t jox_compare_rows(const JoxComparison *c);

#endif
