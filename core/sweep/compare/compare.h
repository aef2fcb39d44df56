/* Types and calls of jo_compare. A side is a variant of a sweep, or a set of recordings; every
   other side is compared with one of them, the base. compare.c reads the sides, effects.c computes
   the differences, and the writers of text, JSON and pages present them. */
#ifndef JOX_SWEEP_COMPARE_COMPARE_H
#define JOX_SWEEP_COMPARE_COMPARE_H

#include "base/number/statistics.h"
#include "picture/draw.h"
#include "report/subject.h"
#include "sweep/compare/side_plan.h"
#include "sweep/store.h"
#include "sweep/sweep.h"

/* ---- a side ---- */

typedef struct JoxSideFigure {
    char *name;
    double *values; /* by run; NAN: the run has no value */
} JoxSideFigure;

/* A curve over time, with the spread of its values over the runs of a side. */
typedef struct JoxSideCurve {
    char *name, *unit;
    struct JoxSidePoint {
        double time, mean, low, high; /* time: s; low, high: 5 % and 95 % quantiles of the runs */
        double median, least, most;   /* over the runs */
    } * points;
    size_t count, capacity;
} JoxSideCurve;

/* Fields over the floor, each reduced over all runs of a side. */
typedef enum JoxSideFieldKind {
    JOX_FIELD_GREATEST, /* 1/m2: greatest density at each place, mean over runs */
    JOX_FIELD_WORST,    /* 1/m2: greatest density at each place in any run */
    JOX_FIELD_OFTEN,    /* %: share of runs in which it reached JOX_FIELD_DENSE */
    JOX_FIELD_MEAN,     /* 1/m2: mean density over time and runs */
    JOX_FIELDS
} JoxSideFieldKind;
#define JOX_FIELD_DENSE 5.0f /* 1/m2 */

/* How a run of a sweep ended; also runs that are left out of the comparison. */
typedef struct JoxSideRun {
    uint64_t seed;
    JoxSweepState state;
    char *reason, *hash; /* "": none */
} JoxSideRun;

/* A row that the file stores for all runs: a key and its value, or an input's path and its
   SHA-256. */
typedef struct JoxSideNote {
    char *key, *value;
} JoxSideNote;
typedef struct JoxSideNotes {
    JoxSideNote *items;
    uint32_t count;
    size_t capacity;
} JoxSideNotes;

typedef struct JoxSide {
    char *name, *source; /* name: as people read it; source: path of its file */
    char *settings;      /* settings of the variant: "PATH=VALUE", one a line; "": none */
    uint64_t *seeds;     /* ascending, one for each of `runs` */
    uint32_t runs;       /* compared: those with figures that went as written */
    uint32_t left_out;   /* runs that failed or did not go as written */
    bool recorded;       /* the runs are recordings, without seeds */
    JoxSideRun *all;     /* ascending by seed, with those left out; empty for recordings */
    uint32_t all_count;
    size_t all_capacity;
    size_t run_capacity;
    JoxSideFigure *figures;
    uint32_t figure_count;
    size_t figure_capacity;
    JoxSideCurve *curves;
    uint32_t curve_count;
    size_t curve_capacity;
    JoxSweepField fields[JOX_FIELDS]; /* by JoxSideFieldKind; values NULL: none */
    char *plan;                       /* JSON (plan_json.c), or NULL */
    char *title;                      /* title of its scene, or NULL */
    JoxSideNotes notes, inputs;
} JoxSide;

typedef struct JoxSides {
    JoxSide *items;
    uint32_t count;
    size_t capacity;
} JoxSides;

/* side_sweep.c: adds each variant of a sweep's file as a side. Returns false with `error`. */
bool jox_sides_add_sweep(JoxSides *sides, const char *path, JoError *error);
/* recording.c: adds `count` recordings as the runs of one side. summaries[i] is the JSON that
   jo_report makes of paths[i]. Returns false with `error`. */
bool jox_sides_add_recordings(JoxSides *sides, const char *source, const char *const *paths,
                              const char *const *summaries, uint32_t count, const JoCompareDef *def,
                              JoError *error);
/* side_fields.c: reads the fields of all runs of a variant, and averages them. */
bool jox_side_read_fields(const JoxSweepStore *store, int64_t variant, JoxSide *side,
                          JoError *error);
/* Adds the field of one run to the side's sums: greatest densities, or mean ones. `cells` are
   floats by row; NAN: no floor. Returns false if the side's field has another grid. After the last
   of `count` runs jox_side_average_fields turns the sums into means. */
bool jox_side_add_field(JoxSide *side, bool greatest, const JoxSweepField *grid, const void *cells);
void jox_side_average_fields(JoxSide *side, bool greatest, uint32_t count);
/* side.c: adds an empty side, which the list owns. */
JoxSide *jox_sides_add(JoxSides *sides, const char *source);
void jox_sides_free(JoxSides *sides);
/* Finds the figure of a name, and adds it if missing, with NAN for every run. */
JoxSideFigure *jox_side_add_figure(JoxSide *side, const char *name);
/* Finds the figure of a name; NULL if missing. */
const JoxSideFigure *jox_side_find_figure(const JoxSide *side, const char *name);
/* Adds an empty curve; then appends to it mean and spread of the runs' values at a time, s. Sorts
   `values`. */
JoxSideCurve *jox_side_add_curve(JoxSide *side, const char *name, const char *unit);
void jox_side_add_point(JoxSideCurve *curve, double time, double *values, size_t count);

/* Input for drawing the plan and the maps of a side, filled by side_maps.c; false if the side has
   no plan. Call jox_side_draw_end even then. */
typedef struct JoxSideDrawn {
    JoxSidePlan plan;
    JoxDensity *grid; /* geometry of the maps; its densities are not set */
    bool fields;      /* the side's fields have that geometry */
    JoxExits exits;   /* only the names are set */
    JoxSubject subject;
} JoxSideDrawn;
bool jox_side_draw_begin(JoxSideDrawn *drawn, const JoxSide *side, const char *folder);
void jox_side_draw_end(JoxSideDrawn *drawn);
/* Returns the greatest plausible value of a field (below 1000). */
double jox_side_field_max(const JoxSide *side, JoxSideFieldKind kind);

/* ---- figures in words ---- */

typedef struct JoxFigureWords {
    char text[200];
    const char *unit;
    bool is_key;       /* a key figure: listed first, and in summaries */
    bool low_is_worse; /* true for flows and speeds; false for times, densities and loads */
} JoxFigureWords;
/* Returns words and unit of a figure, given its path in a run's summary. */
JoxFigureWords jox_figure_words(const char *path);
/* Returns a unit as people read it: "per s" for "1/s". */
const char *jox_figure_unit(const char *unit);
/* Orders the paths of figures for display, as strcmp: below 0 if `a` comes before `b`. */
int jox_figure_compare_paths(const char *a, const char *b);

/* ---- one side alone ---- */

/* The spread of a figure over the runs that have it; NAN if none has. */
typedef struct JoxSpread {
    double mean, least, p5, median, p95, most;
    uint32_t runs;
    uint64_t least_seed, most_seed; /* the first run with the least, the greatest value */
} JoxSpread;
/* seeds_spread.c: computes the spread of a figure, given its path. */
JoxSpread jox_spread_of(const JoxSide *side, const char *figure);
/* The same, with a path that is formatted as by printf. */
JoxSpread jox_spread_of_path(const JoxSide *side, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* Counts the runs in which a figure is greater than 0. */
uint32_t jox_spread_count_positive(const JoxSide *side, const char *figure);
/* Appends "45.2 s (43 to 48.1; at most 49, seed 7)": the median, the 5 % and 95 % quantiles, and
   the greatest value, or the least one if `low`. If all runs have the same value, only that. */
void jox_spread_add_text(const JoxSpread *spread, const char *unit, bool low, JoxText *out);

/* The page of a sweep of one variant, whose runs differ by their seeds only. seeds_page.c writes
   index.html; its summary is in seeds_summary.c, its curves and maps in seeds_pictures.c. */
void jox_seeds_put_summary(FILE *out, const JoxSide *side, const JoxSideDrawn *drawn);
bool jox_seeds_draw(const JoxSide *side, const JoxSideDrawn *drawn, JoxText *why);
void jox_seeds_put_curves(FILE *out, const JoxSide *side, const JoxSideDrawn *drawn);
void jox_seeds_put_maps(FILE *out, const JoxSide *side, const JoxSideDrawn *drawn);

/* Returns the value that the file stores for all runs under a key; "" if none. */
const char *jox_side_find_note(const JoxSide *side, const char *key);

/* ---- differences ---- */

/* The difference of one figure: a side (one of the variants compared) minus the base. */
typedef struct JoxDifference {
    JoxEffect effect;
    JoxMoments base, other;
    bool adjusted;                  /* still significant after Holm's correction */
    size_t base_known, other_known; /* runs that have the figure, paired or not */
    size_t runs; /* runs of each side needed to detect a difference of this size; 0: not known */
} JoxDifference;

/* One figure of all sides. */
typedef struct JoxCompared {
    const char *figure;
    JoxFigureWords words;
    JoxDifference *sides; /* by side; the base's own entry is not used */
    bool varies;          /* the value is not the same in all runs of all sides */
} JoxCompared;

typedef struct JoxComparison {
    const JoCompareDef *def;
    JoxSides sides;
    uint32_t base;
    JoxCompared *figures;
    uint32_t count;
    uint32_t tested; /* figures tested for a difference: the number in Holm's correction */
} JoxComparison;

/* effects.c: fills `figures` from `sides`. */
void jox_compare_effects(JoxComparison *c);
/* Returns what the interval says in words: "differs", "not told apart", ...; never NULL. */
const char *jox_compare_verdict(const JoxDifference *d);
/* Describes how the intervals were computed: "Student's t of the differences of 20 seeds", ... */
void jox_compare_describe_method(const JoxComparison *c, const JoxDifference *d, char *out,
                                 size_t size);
/* Returns whether a side has fewer than 5 runs, so that even its spread is uncertain. */
bool jox_compare_is_thin(const JoxComparison *c);
/* Returns the finite values of a figure, ascending, and their number; to be freed. */
double *jox_side_sorted_values(const JoxSide *side, const char *figure, size_t *count);

/* table.c, compare_json.c: write the comparison as text for a terminal, and as JSON. */
void jox_compare_write_text(const JoxComparison *c, JoxText *out);
void jox_compare_write_json(const JoxComparison *c, JoxText *out);
/* Write into the def's folder: plots.c curve-N.svg and effects.svg, side_maps.c plan-N.svg and PNG,
   compare_page.c index.html, which contains these. They return false with a sentence in `why`. */
bool jox_compare_draw_plots(const JoxComparison *c, JoxText *why);
bool jox_compare_draw_plans(const JoxComparison *c, JoxText *why);
void jox_compare_put_plans(FILE *out, const JoxComparison *c);
bool jox_compare_write_page(const JoxComparison *c, JoxText *why);
void jox_compare_put_percentiles(FILE *out, const JoxComparison *c);
/* seeds_page.c: writes index.html for a single variant. */
bool jox_seeds_write_page(const JoxComparison *c, JoxText *why);
enum { JOX_COMPARE_CURVES = 24 }; /* most curves that are drawn */
/* Returns the n-th curve to draw, taken from the first side that has it; NULL after the last. */
const JoxSideCurve *jox_compare_curve(const JoxComparison *c, uint32_t n);
/* Returns how many figures effects.svg shows for any side. */
uint32_t jox_compare_count_effect_rows(const JoxComparison *c);

#endif
