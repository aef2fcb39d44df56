/* Samples curves over time and fields over the floor while one run goes on. simulate.c attaches
   this as a listener of the scene and fetches the result as pieces. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "run/figure_listeners.h"
#include "run/present_frame.h"
#include "run/probe_listener.h"
#include "run/run.h"
#include "sweep/sweep.h"

typedef struct Collected {
    uint64_t every; /* steps between two points of a curve */
    JoxSweepCurve *curves;
    uint32_t count;
    size_t capacity;
    double *times;    /* s: times of the points so far, the same for all curves */
    uint32_t samples; /* points so far */
    size_t time_capacity;
    float *most;    /* 1/m2: greatest density of each cell so far */
    float now;      /* 1/m2: greatest density anywhere since the last point; NAN: not measured */
    double noted_s; /* time, s, of the last density frame that was used */
} Collected;

/* Returns the interval between points, s, for a run of `seconds`: the least round one that gives at
   most JOX_SWEEP_SAMPLES points. */
static double choose_interval(double seconds) {
    static const double STEPS[] = {0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1800};
    const size_t count = sizeof STEPS / sizeof *STEPS;
    for (size_t s = 0; s < count; s++)
        if (seconds / STEPS[s] <= JOX_SWEEP_SAMPLES)
            return STEPS[s];
    return seconds / JOX_SWEEP_SAMPLES;
}

/* Appends a value at the present time to the curve `name`. A curve that begins later was 0
   before. */
static void add_sample(Collected *c, const char *name, const char *unit, double value) {
    uint32_t k = 0;
    while (k < c->count && strcmp(c->curves[k].name, name) != 0)
        k++;
    if (k == c->count) {
        JOX_RESERVE(c->curves, c->capacity, c->count + 1);
        c->curves[c->count++] = (JoxSweepCurve){.name = jox_strdup(name), .unit = jox_strdup(unit)};
    }
    JoxSweepCurve *curve = &c->curves[k];
    JOX_RESERVE(curve->points, curve->capacity, 2 * (size_t)c->samples);
    while (curve->count < c->samples) {
        curve->points[2 * curve->count] = c->times[curve->count];
        curve->points[2 * curve->count + 1] = curve->count + 1 < c->samples ? 0 : value;
        curve->count++;
    }
}

double jox_sweep_mean_speed(const JoxFrame *frame) {
    double sum = 0;
    for (uint32_t i = 0; i < frame->count; i++)
        sum += sqrt((double)frame->vx[i] * frame->vx[i] + (double)frame->vy[i] * frame->vy[i]);
    return frame->count ? sum / frame->count : NAN;
}

static void sample_curves(Collected *c, JoScene *scene) {
    const JoxExits *exits = &scene->world->state.exits;
    const JoxProbe *probe;
    char name[200];
    JOX_RESERVE(c->times, c->time_capacity, c->samples + 1);
    c->times[c->samples++] = jo_world_time(scene->world);
    add_sample(c, "people inside", "", scene->world->state.agents.count);
    add_sample(c, "people who left", "", (double)exits->left);
    for (uint32_t e = 0; e < exits->count; e++) {
        snprintf(name, sizeof name, "left by %.150s", exits->items[e].name);
        add_sample(c, name, "", exits->items[e].people);
    }
    add_sample(c, "greatest density", "1/m2", c->now);
    add_sample(c, "mean speed", "m/s",
               c->samples > 1
                   ? jox_sweep_mean_speed(jox_run_present_frame(scene, JOX_FRAME_VELOCITIES))
                   : NAN);
    for (uint32_t p = 0; (probe = jox_run_probe(scene, p)); p++)
        if (jox_probe_def(probe)->kind == JOX_PROBE_FLOW) {
            snprintf(name, sizeof name, "passed %.150s", jox_probe_def(probe)->name);
            add_sample(c, name, "", jox_probe_passages(probe));
        }
    c->now = NAN;
}

static bool begin_curves(void *self, JoScene *scene, const void *seconds, JoError *error) {
    Collected *c = self;
    const double dt = scene->world->model.def.dt, of = choose_interval(*(const double *)seconds);
    const JoxDensity *grid = jox_run_local_densities(scene)->grid;
    (void)error;
    *c = (Collected){.every = (uint64_t)fmax(1.0, of / dt + 0.5), .now = NAN, .noted_s = NAN};
    c->most = jox_alloc((size_t)grid->columns * grid->rows, sizeof *c->most);
    sample_curves(c, scene);
    return true;
}

static bool update_curves(void *self, JoScene *scene, JoError *error) {
    Collected *c = self;
    const JoxLocal *local = jox_run_local_densities(scene);
    (void)error;
    if (local->time != c->noted_s && !isnan(local->time)) {
        const size_t cells = (size_t)local->grid->columns * local->grid->rows;
        c->noted_s = local->time;
        for (size_t k = 0; k < cells; k++) {
            c->most[k] = jox_maxf(c->most[k], local->grid->now[k]);
            c->now = fmaxf(c->now, local->grid->now[k]);
        }
    }
    if (scene->world->state.tick % c->every == 0)
        sample_curves(c, scene);
    return true;
}

static bool finish_curves(void *self, JoScene *scene, JoError *error) {
    Collected *c = self;
    (void)error;
    if (c->times[c->samples - 1] < jo_world_time(scene->world))
        sample_curves(c, scene);
    return true;
}

static void free_curves(void *self) {
    Collected *c = self;
    for (uint32_t k = 0; k < c->count; k++)
        jox_sweep_free_curve(&c->curves[k]);
    jox_free(c->curves);
    jox_free(c->times);
    jox_free(c->most);
}

static const JoxListenerKind CURVES = {.name = "curves and fields",
                                       .size = sizeof(Collected),
                                       .begin = begin_curves,
                                       .frame = update_curves,
                                       .end = finish_curves,
                                       .release = free_curves};

bool jox_sweep_collect(JoScene *scene, double seconds, JoError *error) {
    return jox_run_collect_danger(scene, error) && /* it measures the densities */
           jox_run_attach_listener(scene, &CURVES, &seconds, error);
}

/* ---- fields ---- */

/* Reduces a block of cells to one value, 1/m2: the mean over its floor, or the greatest density;
   NAN without floor. */
static float reduce_block(const Collected *c, const JoxDensity *grid, uint32_t size,
                          uint32_t column, uint32_t row, bool mean) {
    double area = 0, sum = 0;
    float most = 0;
    for (uint32_t y = row * size; y < (row + 1) * size && y < grid->rows; y++)
        for (uint32_t x = column * size; x < (column + 1) * size && x < grid->columns; x++) {
            const size_t cell = (size_t)y * grid->columns + x;
            const double floor_m2 = (double)jox_density_area(grid, cell);
            if (!(floor_m2 > 0))
                continue;
            area += floor_m2;
            sum += floor_m2 * jox_density_mean(grid, x, y);
            most = jox_maxf(most, c->most[cell]);
        }
    return area > 0 ? (mean ? (float)(sum / area) : most) : NAN;
}

/* Reduces a density of storeys to a coarser one of the same storeys: each cell to that in which its
   middle lies. */
static void reduce_on_storeys(const Collected *c, const JoxDensity *grid, const JoxDensity *coarse,
                              bool mean, float *values) {
    const size_t cells = (size_t)coarse->columns * coarse->rows;
    double *area = jox_alloc(2 * cells, sizeof *area), *sum = area + cells;
    for (size_t k = 0; k < (size_t)grid->columns * grid->rows; k++) {
        const JoxV2 at = jox_density_middle(grid, k);
        const double floor_m2 = (double)jox_density_area(grid, k);
        size_t to;
        if (!isfinite(at.y) || !(floor_m2 > 0) || !jox_density_cell_of(coarse, at.x, at.y, &to))
            continue;
        const uint32_t row = (uint32_t)(k / grid->columns), column = (uint32_t)(k % grid->columns);
        area[to] += floor_m2;
        sum[to] += floor_m2 * jox_density_mean(grid, column, row);
        values[to] = jox_maxf(values[to], c->most[k]);
    }
    for (size_t k = 0; k < cells; k++)
        values[k] = area[k] > 0 ? (mean ? (float)(sum[k] / area[k]) : values[k]) : NAN;
    jox_free(area);
}

static void put_density_field(const Collected *c, const JoScene *scene, const char *name, bool mean,
                              JoxText *pieces) {
    const JoxDensity *grid = jox_run_local_densities(scene)->grid;
    const double cells = (double)grid->columns * grid->rows;
    const uint32_t size = (uint32_t)ceil(sqrt(fmax(1.0, cells / JOX_SWEEP_CELLS)));
    JoxV2 low, high;
    const JoxStoreys *storeys = jox_run_find_plan_area(scene, &low, &high);
    JoxDensity *coarse = storeys
                             ? jox_density_create_on_storeys(low, high, grid->cell * (float)size,
                                                             JOX_DENSITY_KERNEL, storeys)
                             : NULL;
    JoxSweepField field = {.name = jox_strdup(name),
                           .unit = jox_strdup("1/m2"),
                           .low_x = (double)grid->low.x,
                           .low_y = (double)grid->low.y,
                           .cell = coarse ? (double)coarse->cell : (double)grid->cell * size,
                           .columns = coarse ? coarse->columns : (grid->columns + size - 1) / size,
                           .rows = coarse ? coarse->rows : (grid->rows + size - 1) / size};
    field.values = jox_alloc((size_t)field.columns * field.rows, sizeof *field.values);
    if (coarse)
        reduce_on_storeys(c, grid, coarse, mean, field.values);
    for (uint32_t row = 0; !coarse && row < field.rows; row++)
        for (uint32_t column = 0; column < field.columns; column++)
            field.values[(size_t)row * field.columns + column] =
                reduce_block(c, grid, size, column, row, mean);
    jox_density_free(coarse);
    jox_sweep_put_field(pieces, &field);
    jox_sweep_free_field(&field);
}

void jox_sweep_put_collected(const JoScene *scene, JoxText *pieces) {
    const Collected *c = jox_run_find_listener(scene, &CURVES);
    JOX_ASSERT(c);
    for (uint32_t k = 0; k < c->count; k++)
        jox_sweep_put_curve(pieces, &c->curves[k]);
    put_density_field(c, scene, "greatest density", false, pieces);
    put_density_field(c, scene, "mean density", true, pieces);
}
