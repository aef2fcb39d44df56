/* What the files of sweep share: a plan, what one run leaves, and the file that keeps all runs. */
#ifndef JOX_SWEEP_SWEEP_H
#define JOX_SWEEP_SWEEP_H

#include <stdbool.h>
#include <stdint.h>

#include "base/format/json_writer.h"
#include "base/overlay.h"
#include "base/text.h"
#include "geom/walls.h"
#include "jostle_tools.h"

/* ---- the plan ---- */

/* A setting with all the values that it takes. */
typedef struct JoxSweepAxis {
    char *path;
    char **values;
    uint32_t count;
    size_t capacity;
} JoxSweepAxis;

/* One combination of values: "PATH=VALUE" for each axis, in order. */
typedef struct JoxSweepVariant {
    char **sets;
    uint32_t set_count;
    char *key; /* the sets, a line each */
} JoxSweepVariant;

typedef struct JoxSweepPlan {
    JoxSweepAxis *axes;
    uint32_t axis_count;
    JoxSweepVariant *variants; /* the last axis changes first */
    uint32_t variant_count;
    uint64_t first_seed;
    uint32_t seeds; /* of each variant */
} JoxSweepPlan;

enum { JOX_SWEEP_RUNS = 100000 }; /* of a plan, at most */

/* Of "PATH=A,B,C" texts. A comma within brackets, braces or quotes parts nothing. False with
   JO_USAGE in `error`. */
bool jox_sweep_plan(JoxSweepPlan *plan, const char *const *sets, size_t count, uint64_t first_seed,
                    uint32_t seeds, JoError *error);
void jox_sweep_plan_free(JoxSweepPlan *plan);

/* Names of variants by what tells them apart: "count=100, speed=1.2" of the settings that differ,
   each by the end of its path where that is enough. `keys` are those of JoxSweepVariant. Of one
   variant alone the name is empty. To be freed one by one. */
void jox_sweep_names(const char *const *keys, uint32_t count, char **names);

/* ---- one run ---- */

typedef enum JoxSweepState {
    JOX_SWEEP_DONE,
    JOX_SWEEP_TROUBLED, /* it went on to its end, but not as it was written: see jo_scene_troubles
                         */
    JOX_SWEEP_FAILED
} JoxSweepState;
extern const char *const jox_sweep_states[3]; /* "done", "troubled", "failed" */

typedef struct JoxSweepRun {
    const JoSceneDef *def; /* with sets and seed */
    double seconds;        /* simulated; NAN: the scene's */
    uint64_t steps;        /* 0: by seconds */
    const char *data;      /* folder for CSV files, or NULL */
} JoxSweepRun;

/* Curves and fields of a run are sampled at the same times and places, whatever the seed. */
enum { JOX_SWEEP_SAMPLES = 240, JOX_SWEEP_CELLS = 20000 };

/* Loads and simulates, and writes what came of it as pieces (base/format/pieces.h): "state" (a
   number), "reason" (of those that are not done), "said" (all messages), and where there is
   something to keep "numbers" (JoxSweepNumbers), "summary", "plan" (JSON, of plan_json.c), "curve"
   and "field". */
void jox_sweep_do(const JoxSweepRun *run, JoxText *pieces);

typedef struct JoxSweepNumbers {
    uint64_t hash, steps;
    double simulated_s, cpu_s, wall_s;
} JoxSweepNumbers;

typedef struct JoxSweepCurve {
    char *name, *unit;
    double *points; /* time, s, and value; NAN where there is none */
    size_t count;   /* of pairs */
    size_t capacity;
} JoxSweepCurve;
typedef struct JoxSweepField {
    char *name, *unit;
    double low_x, low_y, cell; /* m */
    uint32_t columns, rows;
    float *values; /* row by row from the lowest y; NAN where nobody can walk */
} JoxSweepField;
void jox_sweep_put_curve(JoxText *pieces, const JoxSweepCurve *curve);
void jox_sweep_put_field(JoxText *pieces, const JoxSweepField *field);
/* Of the bytes of such a piece, with memory of its own; false where they are damaged. */
bool jox_sweep_get_curve(const char *data, size_t length, JoxSweepCurve *out);
bool jox_sweep_get_field(const char *data, size_t length, JoxSweepField *out);
void jox_sweep_free_curve(JoxSweepCurve *curve);
void jox_sweep_free_field(JoxSweepField *field);

/* curves.c: collects curves and fields of a run from here on, which is to take so many seconds. */
bool jox_sweep_collect(JoScene *scene, double seconds, JoError *error);
/* Adds what was collected. */
void jox_sweep_put_collected(const JoScene *scene, JoxText *pieces);
/* plan_json.c: walls, places and probes of a scene as they are at its beginning. */
void jox_sweep_write_plan(const JoScene *scene, JoxText *out);
/* Of these, the walls: a member "walls". */
void jox_sweep_put_walls(JoxJson *json, const JoxWalls *walls);

#endif
