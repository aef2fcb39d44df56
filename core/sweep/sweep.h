/* Types and calls that the files of sweep/ and sweep/compare/ share: the plan of a sweep, the
   results of one run, and their layout as pieces that a child process hands to its parent. */
#ifndef JOX_SWEEP_SWEEP_H
#define JOX_SWEEP_SWEEP_H

#include <stdbool.h>
#include <stdint.h>

#include "base/format/json_writer.h"
#include "base/text.h"
#include "geom/walls.h"
#include "jostle_tools.h"
#include "record/frame.h"

/* ---- the plan ---- */

/* A setting and the values that it takes in turn. */
typedef struct JoxSweepAxis {
    char *path;
    char **values;
    uint32_t count;
    size_t capacity;
} JoxSweepAxis;

/* One combination of values. sets: "PATH=VALUE" of each axis, in order. */
typedef struct JoxSweepVariant {
    char **sets;
    uint32_t set_count;
    char *key; /* the sets, one a line; identifies the variant */
} JoxSweepVariant;

typedef struct JoxSweepPlan {
    JoxSweepAxis *axes;
    uint32_t axis_count;
    JoxSweepVariant *variants; /* in order; the last axis varies fastest */
    uint32_t variant_count;
    uint64_t first_seed;
    uint32_t seeds; /* per variant */
} JoxSweepPlan;

enum { JOX_SWEEP_RUNS = 100000 }; /* most runs of a plan */

/* Makes the plan of settings "PATH=A,B,C": every combination of their values. A comma within
   brackets, braces or quotes separates nothing. Returns false with JO_USAGE in `error`; free the
   plan even then. */
bool jox_sweep_make_plan(JoxSweepPlan *plan, const char *const *sets, size_t count,
                         uint64_t first_seed, uint32_t seeds, JoError *error);
void jox_sweep_free_plan(JoxSweepPlan *plan);

/* Names variants by the settings in which they differ: "count=100, speed=1.2". A path is shortened
   to its last name where that is unambiguous. `keys` are those of JoxSweepVariant. A single variant
   has the empty name. The caller frees each name. */
void jox_sweep_name_variants(const char *const *keys, uint32_t count, char **names);
/* Names the variants of a plan. The caller frees each name and the list. */
char **jox_sweep_name_plan(const JoxSweepPlan *plan);

/* ---- one run ---- */

typedef enum JoxSweepState {
    JOX_SWEEP_DONE,
    JOX_SWEEP_TROUBLED, /* reached its end, but something did not go as written: see
                           jo_scene_troubles */
    JOX_SWEEP_FAILED
} JoxSweepState;
extern const char *const jox_sweep_states[3]; /* "done", "troubled", "failed" */

typedef struct JoxSweepRun {
    const JoSceneDef *def; /* scene, with the variant's settings and the seed */
    double seconds;        /* simulated time; NAN: the scene's duration */
    uint64_t steps;        /* 0: `seconds` counts */
    const char *data;      /* folder for the probes' CSV files, or NULL */
} JoxSweepRun;

/* Curves and fields are sampled at the same times and places in every run, whatever its seed: about
   so many points of a curve, and at most so many cells of a field. */
enum { JOX_SWEEP_SAMPLES = 240, JOX_SWEEP_CELLS = 20000 };

/* Simulates a run and appends its results to `pieces` (base/format/piece_file.h): "state" (a
   number), "reason" (text, unless done), "said" (all messages), and if it ended "numbers"
   (JoxSweepNumbers), "summary", "plan" (JSON of plan_json.c), "curve" and "field". Called in a
   child process. */
void jox_sweep_simulate(const JoxSweepRun *run, JoxText *pieces);

typedef struct JoxSweepNumbers {
    uint64_t hash, steps;
    double simulated_s, cpu_s, wall_s;
} JoxSweepNumbers;

typedef struct JoxSweepCurve {
    char *name, *unit;
    double *points; /* pairs of time, s, and value; NAN: no value */
    size_t count;   /* pairs */
    size_t capacity;
} JoxSweepCurve;
typedef struct JoxSweepField {
    char *name, *unit;
    double low_x, low_y, cell; /* m */
    uint32_t columns, rows;
    float *values; /* by row, from the lowest y; NAN: no floor */
} JoxSweepField;
void jox_sweep_put_curve(JoxText *pieces, const JoxSweepCurve *curve);
void jox_sweep_put_field(JoxText *pieces, const JoxSweepField *field);
/* Decodes such a piece into memory of its own, to be freed; false if it is damaged. */
bool jox_sweep_get_curve(const char *data, size_t length, JoxSweepCurve *out);
bool jox_sweep_get_field(const char *data, size_t length, JoxSweepField *out);
void jox_sweep_free_curve(JoxSweepCurve *curve);
void jox_sweep_free_field(JoxSweepField *field);

/* curves.c: samples curves and fields of the scene from now on, for a run of `seconds` s. */
bool jox_sweep_collect(JoScene *scene, double seconds, JoError *error);
/* Returns the mean speed of the people in a frame, m/s; NAN if it has none. */
double jox_sweep_mean_speed(const JoxFrame *frame);
/* Appends the sampled curves and fields as pieces. */
void jox_sweep_put_collected(const JoScene *scene, JoxText *pieces);
/* plan_json.c: writes walls, places, probes and bodies of a scene as they are at its beginning. */
void jox_sweep_write_plan(const JoScene *scene, JoxText *out);
/* Writes the walls as a member "walls" of an open JSON object. */
void jox_sweep_put_walls(JoxJson *json, const JoxWalls *walls);
/* Writes storeys, stairs and where their sheets lie; nothing without storeys. */
void jox_sweep_put_storeys(JoxJson *json, const JoxStoreys *storeys);

#endif
