/* A side that is one recording: its figures are those of a report, its curves and field are sampled
   from its frames. */
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

static bool add_figure(void *context, const JoxJsonItem *item) {
    JoxSide *side = context;
    /* Its greatest density is that of a run's summary, and "people" who were ever there. */
    const char *name = strcmp(item->path, "danger.density_max") == 0 ? "density_max" : item->path;
    if (item->kind == JOX_JSON_NUMBER &&
        (strcmp(name, "people") == 0 || jox_summary_kind(name) == JOX_SUMMARY_FIGURE))
        jox_side_figure(side, name)->values[0] = item->number;
    return true;
}

static JoxSideCurve *curve(JoxSide *side, uint32_t n, const char *name, const char *unit) {
    while (side->curve_count <= n) {
        JOX_RESERVE(side->curves, side->curve_capacity, side->curve_count + 1);
        side->curves[side->curve_count++] = (JoxSideCurve){0};
    }
    if (!side->curves[n].name) {
        side->curves[n].name = jox_strdup(name);
        side->curves[n].unit = jox_strdup(unit);
    }
    return &side->curves[n];
}

static void add_point(JoxSideCurve *c, double time, double value) {
    JOX_RESERVE(c->points, c->capacity, c->count + 1);
    c->points[c->count++] = (struct JoxSidePoint){time, value, value, value, value, value, value};
}

static double mean_speed(const JoxFrame *frame) {
    double sum = 0;
    for (uint32_t i = 0; i < frame->count; i++)
        sum += sqrt((double)frame->vx[i] * frame->vx[i] + (double)frame->vy[i] * frame->vy[i]);
    return frame->count ? sum / frame->count : NAN;
}

/* Curves of all frames, and the greatest density of each cell. */
static void sample(JoxSide *side, const JoxTrajectories *t, JoxLocal *local, float *most) {
    const size_t cells = (size_t)local->grid->columns * local->grid->rows;
    const double length = (double)(t->last - t->number[0]) / t->fps;
    const double every = length / SAMPLES;
    double next = -INFINITY, now = NAN;
    JoxFrame frame;
    for (uint32_t f = 0; jox_trajectories_frame(t, f, &frame); f++) {
        frame.walls = &t->walls;
        if (jox_local_frame(local, &frame, NULL))
            for (size_t k = 0; k < cells; k++) {
                most[k] = jox_maxf(most[k], local->grid->now[k]);
                now = fmax(now, (double)local->grid->now[k]);
            }
        if (frame.time < next)
            continue;
        next = frame.time + every;
        add_point(curve(side, 0, "people inside", ""), frame.time, frame.count);
        if (isfinite(now))
            add_point(curve(side, 1, "greatest density", "1/m2"), frame.time, now);
        add_point(curve(side, 2, "mean speed", "m/s"), frame.time, mean_speed(&frame));
        now = NAN;
    }
}

static void put_field(JoxSide *side, const JoxDensity *grid, const float *most) {
    const size_t cells = (size_t)grid->columns * grid->rows;
    side->fields[JOX_FIELD_GREATEST] = (JoxSweepField){.name = jox_strdup("greatest density"),
                                                       .unit = jox_strdup("1/m2"),
                                                       .low_x = (double)grid->low.x,
                                                       .low_y = (double)grid->low.y,
                                                       .cell = (double)grid->cell,
                                                       .columns = grid->columns,
                                                       .rows = grid->rows,
                                                       .values = jox_alloc(cells, sizeof(float))};
    for (size_t k = 0; k < cells; k++)
        side->fields[JOX_FIELD_GREATEST].values[k] = jox_density_area(grid, k) > 0 ? most[k] : NAN;
}

/* The outlines of the recording, or the scene's walls and places. */
static void put_plan(JoxSide *side, const JoxTrajectories *t, JoxV2 low, JoxV2 high) {
    JoxText out = {0};
    JoxJson json = jox_json_begin(&out, 0);
    jox_json_object(&json, NULL);
    jox_json_numbers_of(
        &json, "area",
        (const double[]){(double)low.x, (double)low.y, (double)high.x, (double)high.y}, 4, 9);
    jox_sweep_put_walls(&json, &t->walls);
    jox_json_end(&json);
    side->plan = out.data;
}

bool jox_sides_add_recording(JoxSides *sides, const char *path, const char *summary,
                             const JoCompareDef *def, JoError *error) {
    JoxDiagnostics diagnostics = {0};
    const JoxTrajectoryOptions options = {.fps = def->fps, .unit = def->unit};
    JoxTrajectories *t = jox_trajectories_read(path, &options, &diagnostics);
    jox_run_report(def->message, def->message_context, &diagnostics, error);
    if (!t)
        return false;
    JoxSide *side = jox_sides_add(sides, path);
    side->recorded = true;
    side->runs = 1;
    side->seeds = jox_alloc(1, sizeof *side->seeds);
    const JoxV2 low = jox_sub(t->low, (JoxV2){EDGE, EDGE}),
                high = jox_add(t->high, (JoxV2){EDGE, EDGE});
    JoxLocal *local = jox_local_create(low, high);
    float *most = jox_alloc((size_t)local->grid->columns * local->grid->rows, sizeof *most);
    sample(side, t, local, most);
    put_field(side, local->grid, most);
    put_plan(side, t, low, high);
    jox_free(most);
    jox_local_free(local);
    jox_trajectories_free(t);
    const bool good = jox_json_read(summary, jox_json_own_files, add_figure, side);
    if (!good)
        jox_error(error, JO_INPUT, "the figures of %.300s cannot be read", path);
    return good;
}
