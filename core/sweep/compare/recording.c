/* A side of recordings, each of which is a run: figures are those of reports, curves and fields are
   sampled from the frames, all at the same times and places. */
#include <math.h>
#include <string.h>

#include "base/format/json.h"
#include "base/guard.h"
#include "record/aggregate.h"
#include "record/local.h"
#include "record/trajectories.h"
#include "run/run.h"
#include "sweep/compare/compare.h"

static const float EDGE = 0.5f; /* m about everyone */
enum { SAMPLES = 240 };

typedef struct Figures {
    JoxSide *side;
    uint32_t run;
} Figures;

static bool add_figure(void *context, const JoxJsonItem *item) {
    const Figures *figures = context;
    /* Its greatest density is that of a run's summary, and "people" who were ever there. */
    const char *name = strcmp(item->path, "danger.density_max") == 0 ? "density_max" : item->path;
    if (item->kind == JOX_JSON_NUMBER &&
        (strcmp(name, "people") == 0 || jox_summary_kind(name) == JOX_SUMMARY_FIGURE))
        jox_side_figure(figures->side, name)->values[figures->run] = item->number;
    return true;
}

/* ---- curves and fields ---- */

enum { INSIDE, DENSITY, SPEED, CURVES };
static const char *const CURVE_NAMES[CURVES][2] = {
    {"people inside", ""}, {"greatest density", "1/m2"}, {"mean speed", "m/s"}};

/* What is sampled of all recordings of a side. */
typedef struct Samples {
    JoxSide *side;
    JoxV2 low, high; /* m: everyone of all recordings, and a margin */
    double length;   /* s: the longest */
    double *values;  /* [curve][time][run], NAN where nothing is known */
    JoxLocal *local; /* of one recording, as are the following */
    float *most;     /* 1/m2: the greatest density of each cell */
    size_t cells;
} Samples;

static double *value_at(const Samples *s, int curve, int time, uint32_t run) {
    return &s->values[((size_t)curve * SAMPLES + (size_t)time) * s->side->runs + run];
}

static double mean_speed(const JoxFrame *frame) {
    double sum = 0;
    for (uint32_t i = 0; i < frame->count; i++)
        sum += sqrt((double)frame->vx[i] * frame->vx[i] + (double)frame->vy[i] * frame->vy[i]);
    return frame->count ? sum / frame->count : NAN;
}

/* The greatest density of a frame, which is noted for each cell; NAN where it was not measured. */
static double measure(Samples *s, const JoxFrame *frame) {
    double now = NAN;
    if (jox_local_frame(s->local, frame, NULL))
        for (size_t k = 0; k < s->cells; k++) {
            s->most[k] = jox_maxf(s->most[k], s->local->grid->now[k]);
            now = fmax(now, (double)s->local->grid->now[k]);
        }
    return now;
}

/* Of each interval of time the greatest density of its frames, and else the first frame. */
static void sample(Samples *s, const JoxTrajectories *t, uint32_t run) {
    const double every = s->length > 0 ? s->length / (SAMPLES - 1) : 1;
    JoxFrame frame;
    int last = -1;
    for (uint32_t f = 0; jox_trajectories_frame(t, f, &frame); f++) {
        const double since = frame.time - (double)t->number[0] / t->fps;
        const int time = (int)fmin(fmax(since / every, 0), SAMPLES - 1);
        double *density = value_at(s, DENSITY, time, run);
        *density = fmax(*density, measure(s, &frame));
        if (time == last)
            continue;
        last = time;
        *value_at(s, INSIDE, time, run) = frame.count;
        *value_at(s, SPEED, time, run) = mean_speed(&frame);
    }
}

/* The grid that fields of all recordings are on. */
static void put_fields(Samples *s) {
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

static void put_curves(Samples *s) {
    const double every = s->length > 0 ? s->length / (SAMPLES - 1) : 1;
    for (int curve = 0; curve < CURVES; curve++) {
        JoxSideCurve *c = jox_side_curve(s->side, CURVE_NAMES[curve][0], CURVE_NAMES[curve][1]);
        for (int time = 0; time < SAMPLES; time++) {
            double *values = value_at(s, curve, time, 0);
            size_t known = 0;
            for (uint32_t run = 0; run < s->side->runs; run++)
                if (isfinite(values[run]))
                    values[known++] = values[run];
            if (known && 2 * known >= s->side->runs)
                jox_side_point(c, time * every, values, known);
        }
    }
}

/* The outlines of a recording, in an area. */
static char *plan_of(const JoxWalls *walls, JoxV2 low, JoxV2 high) {
    JoxText out = {0};
    JoxJson json = jox_json_begin(&out, 0);
    jox_json_object(&json, NULL);
    jox_json_numbers_of(
        &json, "area",
        (const double[]){(double)low.x, (double)low.y, (double)high.x, (double)high.y}, 4, 9);
    jox_sweep_put_walls(&json, walls);
    jox_json_end(&json);
    return out.data;
}

/* ---- the side ---- */

static JoxTrajectories *open_recording(const char *path, const JoCompareDef *def, JoError *error) {
    JoxDiagnostics diagnostics = {0};
    const JoxTrajectoryOptions options = {.fps = def->fps, .unit = def->unit};
    JoxTrajectories *t = jox_trajectories_read(path, &options, &diagnostics);
    jox_run_report(def->message, def->message_context, &diagnostics, error);
    return t;
}

/* Where and how long people are in any of them. */
static bool measure_extent(Samples *s, const char *const *paths, const JoCompareDef *def,
                           JoError *error) {
    for (uint32_t run = 0; run < s->side->runs; run++) {
        JoxTrajectories *t = open_recording(paths[run], def, error);
        if (!t)
            return false;
        const JoxV2 low = jox_sub(t->low, (JoxV2){EDGE, EDGE}),
                    high = jox_add(t->high, (JoxV2){EDGE, EDGE});
        s->low = run ? jox_v2(jox_minf(low.x, s->low.x), jox_minf(low.y, s->low.y)) : low;
        s->high = run ? jox_v2(jox_maxf(high.x, s->high.x), jox_maxf(high.y, s->high.y)) : high;
        s->length = fmax(s->length, (double)(t->last - t->number[0]) / t->fps);
        jox_trajectories_free(t);
    }
    return true;
}

static bool sample_all(Samples *s, const char *const *paths, const JoCompareDef *def,
                       JoError *error) {
    for (uint32_t run = 0; run < s->side->runs; run++) {
        JoxTrajectories *t = open_recording(paths[run], def, error);
        if (!t)
            return false;
        s->local = jox_local_create(s->low, s->high);
        s->cells = (size_t)s->local->grid->columns * s->local->grid->rows;
        s->most = jox_alloc(s->cells, sizeof *s->most);
        sample(s, t, run);
        put_fields(s);
        if (run == 0)
            s->side->plan = plan_of(&t->walls, s->low, s->high);
        jox_free(s->most);
        jox_local_free(s->local);
        jox_trajectories_free(t);
    }
    jox_side_end_fields(s->side, true, s->side->runs);
    return true;
}

static bool read_figures(JoxSide *side, const char *const *paths, const char *const *summaries,
                         JoError *error) {
    for (uint32_t run = 0; run < side->runs; run++) {
        Figures figures = {side, run};
        if (!jox_json_read(summaries[run], jox_json_own_files, add_figure, &figures)) {
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
        put_curves(&s);
    jox_free(s.values);
    return good && read_figures(side, paths, summaries, error);
}
