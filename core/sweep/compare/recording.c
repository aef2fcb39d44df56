/* Reads recordings as the runs of one side. Figures are those of their reports; curves and fields
   are sampled from the frames, all at the same times and places. */
#include <math.h>
#include <string.h>

#include "base/format/json.h"
#include "base/guard.h"
#include "record/aggregate.h"
#include "record/local_samples.h"
#include "record/trajectories.h"
#include "run/messages.h"
#include "sweep/compare/compare.h"

static const float EDGE = 0.5f; /* m: margin of the area around all people */
enum { SAMPLES = 240 };

typedef struct Figures {
    JoxSide *side;
    uint32_t run;
} Figures;

static bool add_report_figure(void *context, const JoxJsonItem *item) {
    const Figures *figures = context;
    /* "danger.density_max" of a report corresponds to "density_max" of a run. "people" counts all
       who were ever there; only recordings have this figure. */
    const char *name = strcmp(item->path, "danger.density_max") == 0 ? "density_max" : item->path;
    if (item->kind == JOX_JSON_NUMBER &&
        (strcmp(name, "people") == 0 || jox_summary_kind(name) == JOX_SUMMARY_FIGURE))
        jox_side_add_figure(figures->side, name)->values[figures->run] = item->number;
    return true;
}

/* ---- curves and fields ---- */

enum { INSIDE, DENSITY, SPEED, CURVES };
static const char *const CURVE_NAMES[CURVES][2] = {
    {"people inside", ""}, {"greatest density", "1/m2"}, {"mean speed", "m/s"}};

/* Samples of all recordings of a side. */
typedef struct Samples {
    JoxSide *side;
    JoxV2 low, high;    /* m: bounds of all people in all recordings, with a margin */
    JoxStoreys storeys; /* of the first recording; empty: one plane. `low` and `high` are in plan */
    double length;      /* s: of the longest recording */
    double *values;     /* [curve][time][run]; NAN: not measured */
    JoxLocal *local;    /* this and the next two: of the recording that is being read */
    float *most;        /* 1/m2: greatest density of each cell so far */
    size_t cells;
} Samples;

/* Returns the place of a sample in `values`. */
static double *get_sample(const Samples *s, int curve, int time, uint32_t run) {
    return &s->values[((size_t)curve * SAMPLES + (size_t)time) * s->side->runs + run];
}

/* Measures a frame: updates the greatest density of each cell and returns the greatest of all,
   1/m2; NAN if the frame was not measured. */
static double measure_frame(Samples *s, const JoxFrame *frame) {
    double now = NAN;
    if (jox_local_frame(s->local, frame, NULL))
        for (size_t k = 0; k < s->cells; k++) {
            s->most[k] = jox_maxf(s->most[k], s->local->grid->now[k]);
            now = fmax(now, (double)s->local->grid->now[k]);
        }
    return now;
}

/* Samples one recording: the greatest density of each interval of time; people and speed of the
   first frame in it. */
static void sample_recording(Samples *s, const JoxTrajectories *t, uint32_t run) {
    const double every = s->length > 0 ? s->length / (SAMPLES - 1) : 1;
    JoxFrame frame;
    int last = -1;
    for (uint32_t f = 0; jox_trajectories_frame(t, f, &frame); f++) {
        const double since = frame.time - (double)t->number[0] / t->fps;
        const int time = (int)fmin(fmax(since / every, 0), SAMPLES - 1);
        double *density = get_sample(s, DENSITY, time, run);
        *density = fmax(*density, measure_frame(s, &frame));
        if (time == last)
            continue;
        last = time;
        *get_sample(s, INSIDE, time, run) = frame.count;
        *get_sample(s, SPEED, time, run) = jox_sweep_mean_speed(&frame);
    }
}

/* Adds the field of one recording to the side. */
static void add_recording_field(Samples *s) {
    const JoxDensity *grid = s->local->grid;
    const JoxSweepField field = {.low_x = (double)grid->low.x,
                                 .low_y = (double)grid->low.y,
                                 .cell = (double)grid->cell,
                                 .columns = grid->columns,
                                 .rows = grid->rows};
    for (size_t k = 0; k < s->cells; k++)
        if (!(jox_density_area(grid, k) > 0))
            s->most[k] = NAN;
    jox_side_add_field(s->side, true, &field, s->most);
}

/* Adds the curves to the side, at times for which at least half of the recordings have a value. */
static void add_recording_curves(Samples *s) {
    const double every = s->length > 0 ? s->length / (SAMPLES - 1) : 1;
    for (int curve = 0; curve < CURVES; curve++) {
        JoxSideCurve *c = jox_side_add_curve(s->side, CURVE_NAMES[curve][0], CURVE_NAMES[curve][1]);
        for (int time = 0; time < SAMPLES; time++) {
            double *values = get_sample(s, curve, time, 0);
            size_t known = 0;
            for (uint32_t run = 0; run < s->side->runs; run++)
                if (isfinite(values[run]))
                    values[known++] = values[run];
            if (known && 2 * known >= s->side->runs)
                jox_side_add_point(c, time * every, values, known);
        }
    }
}

/* Returns the walls of a recording and the area as JSON that side_plan.c reads; to be freed. */
static char *write_recording_plan(const JoxWalls *walls, const JoxStoreys *storeys, JoxV2 low,
                                  JoxV2 high) {
    JoxText out = {0};
    JoxJson json = jox_json_begin(&out, 0);
    jox_json_object(&json, NULL);
    jox_json_numbers_of(
        &json, "area",
        (const double[]){(double)low.x, (double)low.y, (double)high.x, (double)high.y}, 4, 9);
    jox_sweep_put_storeys(&json, storeys);
    jox_sweep_put_walls(&json, walls);
    jox_json_end(&json);
    return out.data;
}

/* ---- the side ---- */

static JoxTrajectories *open_recording(const char *path, const JoCompareDef *def, JoError *error) {
    JoxDiagnostics diagnostics = {0};
    const JoxTrajectoryOptions options = {.fps = def->fps, .unit = def->unit};
    JoxTrajectories *t = jox_trajectories_read(path, &options, &diagnostics);
    jox_run_report_diagnostics(def->message, def->message_context, &diagnostics, error);
    return t;
}

/* Returns whether positions of both lie on the same sheets. */
static bool has_same_storeys(const JoxStoreys *a, const JoxStoreys *b) {
    return a->sheet_count == b->sheet_count && a->pitch == b->pitch && a->origin == b->origin;
}

/* Finds the area and the longest duration over all recordings. */
static bool measure_extent(Samples *s, const char *const *paths, const JoCompareDef *def,
                           JoError *error) {
    for (uint32_t run = 0; run < s->side->runs; run++) {
        JoxTrajectories *t = open_recording(paths[run], def, error);
        if (!t)
            return false;
        JoxV2 low, high;
        const JoxStoreys *storeys = jox_trajectories_plan_area(t, &low, &high);
        low = jox_sub(low, (JoxV2){EDGE, EDGE});
        high = jox_add(high, (JoxV2){EDGE, EDGE});
        if (run == 0 && storeys)
            jox_storeys_copy(&s->storeys, storeys);
        if (!has_same_storeys(&s->storeys, &t->storeys)) {
            jox_error(error, JO_INPUT,
                      "%.300s has other storeys than %.300s. Give recordings of one building, or "
                      "each as a side of its own",
                      paths[run], paths[0]);
            jox_trajectories_free(t);
            return false;
        }
        s->low = run ? jox_v2(jox_minf(low.x, s->low.x), jox_minf(low.y, s->low.y)) : low;
        s->high = run ? jox_v2(jox_maxf(high.x, s->high.x), jox_maxf(high.y, s->high.y)) : high;
        s->length = fmax(s->length, (double)(t->last - t->number[0]) / t->fps);
        jox_trajectories_free(t);
    }
    return true;
}

static const JoxStoreys *get_storeys(const Samples *s) {
    return jox_has_storeys(&s->storeys) ? &s->storeys : NULL;
}

/* Reads each recording again, samples it, and adds its field; the first one provides the plan. */
static bool sample_all(Samples *s, const char *const *paths, const JoCompareDef *def,
                       JoError *error) {
    for (uint32_t run = 0; run < s->side->runs; run++) {
        JoxTrajectories *t = open_recording(paths[run], def, error);
        if (!t)
            return false;
        s->local = jox_local_create(s->low, s->high, get_storeys(s));
        s->cells = (size_t)s->local->grid->columns * s->local->grid->rows;
        s->most = jox_alloc(s->cells, sizeof *s->most);
        sample_recording(s, t, run);
        add_recording_field(s);
        if (run == 0)
            s->side->plan = write_recording_plan(&t->walls, get_storeys(s), s->low, s->high);
        jox_free(s->most);
        jox_local_free(s->local);
        jox_trajectories_free(t);
    }
    jox_side_average_fields(s->side, true, s->side->runs);
    return true;
}

static bool read_report_figures(JoxSide *side, const char *const *paths,
                                const char *const *summaries, JoError *error) {
    for (uint32_t run = 0; run < side->runs; run++) {
        Figures figures = {side, run};
        if (!jox_json_read(summaries[run], jox_json_own_files, add_report_figure, &figures)) {
            jox_error(error, JO_INPUT, "the figures of %.300s cannot be read", paths[run]);
            return false;
        }
    }
    return true;
}

bool jox_sides_add_recordings(JoxSides *sides, const char *source, const char *const *paths,
                              const char *const *summaries, uint32_t count, const JoCompareDef *def,
                              JoError *error) {
    JoxSide *side = jox_sides_add(sides, source);
    Samples s = {.side = side};
    side->recorded = true;
    side->runs = count;
    side->seeds = jox_alloc(count, sizeof *side->seeds);
    bool good = measure_extent(&s, paths, def, error);
    s.values = jox_alloc((size_t)CURVES * SAMPLES * count, sizeof *s.values);
    for (size_t v = 0; v < (size_t)CURVES * SAMPLES * count; v++)
        s.values[v] = NAN;
    good = good && sample_all(&s, paths, def, error);
    if (good)
        add_recording_curves(&s);
    jox_free(s.values);
    jox_storeys_free(&s.storeys);
    return good && read_report_figures(side, paths, summaries, error);
}
