/* Probe `map`: fields on a grid.

   - density: people per m2, mean over the samples, by fields/density.h: R = 1 m and within walls,
     unless the scene sets another kernel or lets it pass through walls
   - speed, m/s: sum of w |v| over sum of w, with the same weights w, over all samples
   - pressure: crowd pressure by fields/pressure.h, 1/s2, mean over the times at which it was
     measured. It is sampled every half second, independent of `every`
   - compression, N/m: sum of w c over sum of w, over all samples
   - compression_most, N/m: greatest compression of a person in the cell */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "record/fields/density.h"
#include "record/local_samples.h"
#include "record/probes/probe_parts.h"
#include "record/storey_figures.h"

enum { DENSITY, SPEED, COMPRESSION, FIELDS };
static const float LEAST = 0.02f; /* 1/m2: at lower density a cell has no velocity */
enum { MOST_CELLS_DRAWN = 250000 };

typedef struct Map {
    JoxDensity *grid;
    JoxLocal *local; /* local densities, for crowd pressure */
    float *now[FIELDS];
    float *speeds; /* m/s: speeds of the people in the last sample */
    uint32_t speed_capacity;
    double *density, *speed, *compression; /* sums over samples */
    float *compression_most;
    /* sums and counts over samples of `local` that measured pressure, by cells of its grid */
    double *pressure;
    uint32_t *measured;
    /* greatest of any cell and time, 1/m2 and 1/s2, and their times, s */
    double density_most, pressure_most, density_time, pressure_time;
    JoxV2 density_at, pressure_at;
    double speed_sum, compression_greatest;
    uint64_t people;
    int64_t interval; /* number of the interval of `every` seconds that the last sample lies in */
    uint32_t samples;
    bool has_compression;
} Map;

static size_t count_map_cells(const JoxDensity *g) {
    return (size_t)g->columns * g->rows;
}

static void begin_map(const JoxProbeDef *def, void *state) {
    Map *m = state;
    const JoxStoreys *storeys = def->all_storeys ? def->storeys : NULL;
    m->grid = jox_density_create_on_storeys(def->low, def->high, (float)def->cell,
                                            (float)def->kernel, storeys);
    m->local = jox_local_create(def->low, def->high, storeys);
    jox_local_enable_pressure(m->local);
    size_t cells = count_map_cells(m->grid), local_cells = count_map_cells(m->local->grid);
    for (int f = 0; f < FIELDS; f++)
        m->now[f] = jox_alloc(cells, sizeof(float));
    m->density = jox_alloc(cells, sizeof(double));
    m->speed = jox_alloc(cells, sizeof(double));
    m->compression = jox_alloc(cells, sizeof(double));
    m->compression_most = jox_alloc(cells, sizeof(float));
    m->pressure = jox_alloc(local_cells, sizeof(double));
    m->measured = jox_alloc(local_cells, sizeof *m->measured);
    m->density_most = m->pressure_most = NAN;
    m->interval = INT64_MIN;
}

/* Returns the number of the interval that t lies in. Times are sums of steps and may fall short of
   a multiple by rounding. */
static int64_t find_map_interval(const JoxProbeDef *def, double t) {
    return (int64_t)floor(t / def->every + 1e-6);
}

static bool is_map_due(const JoxProbeDef *def, const void *state, double t) {
    const Map *m = state;
    return find_map_interval(def, t) != m->interval || jox_local_is_due(m->local, t);
}

static void note_compression(Map *m, const JoxFrame *frame, uint32_t i) {
    size_t cell;
    if (!jox_density_cell_of(m->grid, frame->x[i], frame->y[i], &cell))
        return;
    m->compression_most[cell] = jox_maxf(m->compression_most[cell], frame->compression[i]);
    m->compression_greatest = fmax(m->compression_greatest, frame->compression[i]);
}

/* Adds the fields of this sample to the sums. */
static void add_map_sample(Map *m, double t) {
    for (size_t c = 0; c < count_map_cells(m->grid); c++) {
        double density = m->now[DENSITY][c];
        m->density[c] += density;
        if (!(density <= m->density_most)) {
            m->density_most = density;
            m->density_time = t;
            m->density_at = jox_density_middle(m->grid, c);
        }
        if (density < LEAST)
            continue;
        m->speed[c] += m->now[SPEED][c];
        m->compression[c] += m->now[COMPRESSION][c];
    }
    m->samples++;
}

static void add_pressure_sample(Map *m, double t) {
    for (size_t c = 0; c < count_map_cells(m->local->grid); c++) {
        float pressure = jox_local_pressure(m->local, c);
        if (isnan(pressure))
            continue;
        m->pressure[c] += pressure;
        m->measured[c]++;
        if (!(pressure <= m->pressure_most)) {
            m->pressure_most = pressure;
            m->pressure_time = t;
            m->pressure_at = jox_density_middle(m->local->grid, c);
        }
    }
}

/* Returns the mean crowd pressure at a point, 1/s2; NAN: never measured. */
static double mean_pressure(const Map *m, JoxV2 at) {
    size_t c;
    bool known = jox_density_cell_of(m->local->grid, at.x, at.y, &c) && m->measured[c];
    return known ? m->pressure[c] / m->measured[c] : NAN;
}

/* Samples density, speed and compression into the sums. */
static void sample_map(const JoxProbeDef *def, Map *m, const JoxFrame *frame, const uint8_t *seen) {
    jox_density_storeys(m->grid, frame->storeys);
    jox_density_walls(m->grid, def->through_walls ? NULL : jox_frame_dividing_walls(frame));
    JOX_RESERVE(m->speeds, m->speed_capacity, frame->count + 1);
    for (uint32_t i = 0; i < frame->count; i++) {
        if (!seen[i])
            continue;
        const float vx = frame->vx[i], vy = frame->vy[i];
        m->speeds[i] = sqrtf(vx * vx + vy * vy);
        if (frame->compression)
            note_compression(m, frame, i);
        m->speed_sum += m->speeds[i];
        m->people++;
    }
    const JoxDensityCrowd crowd = {.count = frame->count,
                                   .x = frame->x,
                                   .y = frame->y,
                                   .period = frame->period,
                                   .seen = seen,
                                   .weights = {NULL, m->speeds, frame->compression}};
    if (!frame->compression)
        memset(m->now[COMPRESSION], 0, count_map_cells(m->grid) * sizeof(float));
    jox_density_sample(m->grid, &crowd, frame->compression ? FIELDS : COMPRESSION, m->now);
    m->has_compression |= frame->compression != NULL;
    add_map_sample(m, frame->time);
}

static void take_map_frame(const JoxProbeDef *def, void *state, const JoxFrame *frame,
                           const uint8_t *seen) {
    Map *m = state;
    if (jox_local_frame(m->local, frame, seen))
        add_pressure_sample(m, frame->time);
    if (find_map_interval(def, frame->time) == m->interval)
        return;
    m->interval = find_map_interval(def, frame->time);
    sample_map(def, m, frame, seen);
}

static void add_map_figures(const JoxProbeDef *def, const void *state, JoxFigures *out) {
    const Map *m = state;
    double density = 0.0, pressure = NAN, n = m->samples ? m->samples : NAN;
    bool pressed = !isnan(m->pressure_most);
    for (size_t c = 0; c < count_map_cells(m->grid); c++)
        density = fmax(density, m->density[c]);
    for (size_t c = 0; c < count_map_cells(m->local->grid); c++)
        pressure = fmax(pressure, m->measured[c] ? m->pressure[c] / m->measured[c] : NAN);
    jox_figure_add(out, "samples", "samples", "", m->samples);
    jox_figure_add(out, "density_max", "greatest density (Gaussian of the caption)", "1/m2",
                   m->samples ? m->density_most : NAN);
    jox_figure_add(out, "density_max_x", "x of the greatest density", "m",
                   m->samples ? m->density_at.x : NAN);
    jox_figure_add(out, "density_max_y", "y of the greatest density", "m",
                   m->samples ? jox_in_plan(def->storeys, m->density_at).y : NAN);
    jox_figure_add(out, "density_max_time", "time of the greatest density", "s",
                   m->samples ? m->density_time : NAN);
    jox_figure_add(out, "density_mean_max", "greatest mean density of a cell", "1/m2", density / n);
    jox_figure_add(out, "speed", "speed, mean", "m/s",
                   m->people ? m->speed_sum / (double)m->people : NAN);
    jox_figure_add(out, "pressure_max", "greatest crowd pressure", "1/s2", m->pressure_most);
    jox_figure_add(out, "pressure_max_x", "x of the greatest crowd pressure", "m",
                   pressed ? m->pressure_at.x : NAN);
    jox_figure_add(out, "pressure_max_y", "y of the greatest crowd pressure", "m",
                   pressed ? jox_in_plan(def->storeys, m->pressure_at).y : NAN);
    jox_figure_add(out, "pressure_max_time", "time of the greatest crowd pressure", "s",
                   pressed ? m->pressure_time : NAN);
    jox_figure_add(out, "pressure_mean_max", "greatest mean crowd pressure of a cell", "1/s2",
                   pressure);
    jox_figure_add(out, "compression_max", "greatest compression of any moment", "N/m",
                   m->has_compression ? m->compression_greatest : NAN);
}

static void list_map_sections(void *state, JoxSections *s) {
    Map *m = state;
    const size_t cells = count_map_cells(m->grid), local_cells = count_map_cells(m->local->grid);
    jox_section(s, "density", m->density, sizeof *m->density, cells);
    jox_section(s, "speed", m->speed, sizeof *m->speed, cells);
    jox_section(s, "compression", m->compression, sizeof *m->compression, cells);
    jox_section(s, "compression_most", m->compression_most, sizeof *m->compression_most, cells);
    jox_section(s, "pressure", m->pressure, sizeof *m->pressure, local_cells);
    jox_section(s, "measured", m->measured, sizeof *m->measured, local_cells);
    JOX_SECTION(s, "density_greatest", m->density_most);
    JOX_SECTION(s, "pressure_greatest", m->pressure_most);
    JOX_SECTION(s, "density_time", m->density_time);
    JOX_SECTION(s, "pressure_time", m->pressure_time);
    JOX_SECTION(s, "density_at", m->density_at);
    JOX_SECTION(s, "pressure_at", m->pressure_at);
    JOX_SECTION(s, "speed_sum", m->speed_sum);
    JOX_SECTION(s, "compression_greatest", m->compression_greatest);
    JOX_SECTION(s, "people", m->people);
    JOX_SECTION(s, "stretch", m->interval);
    JOX_SECTION(s, "samples", m->samples);
    JOX_SECTION(s, "has_compression", m->has_compression);
    jox_local_sections(m->local, s);
}

static void write_map_csv(const JoxProbeDef *def, const void *state, FILE *out) {
    const Map *m = state;
    const JoxDensity *g = m->grid;
    uint32_t skip = 1;
    while ((g->columns / skip) * (g->rows / skip) > MOST_CELLS_DRAWN)
        skip++;
    double n = m->samples ? m->samples : 1.0;
    fputs("x [m],y [m],density [1/m2],speed [m/s],pressure [1/s2],compression [N/m],"
          "compression_most [N/m]",
          out);
    jox_csv_put_storey_title(out, def->storeys);
    fputs(jox_has_storeys(def->storeys) ? ",drawn_y [m]\n" : "\n", out);
    for (uint32_t row = 0; row < g->rows; row += skip) {
        if (isnan(jox_density_middle(g, (size_t)row * g->columns).y))
            continue; /* between the rows of two storeys */
        for (uint32_t column = 0; column < g->columns; column += skip) {
            size_t c = (size_t)row * g->columns + column;
            double weight = m->density[c];
            JoxV2 at = jox_density_middle(g, c);
            const JoxV2 plan = jox_in_plan(def->storeys, at);
            fprintf(out, "%.3f,%.3f,%.4g,", (double)plan.x, (double)plan.y, weight / n);
            if (weight < LEAST * n)
                fprintf(out, "nan,%.4g,", mean_pressure(m, at));
            else
                fprintf(out, "%.4g,%.4g,", m->speed[c] / weight, mean_pressure(m, at));
            if (m->has_compression)
                fprintf(out, "%.4g,%.4g", weight < LEAST * n ? 0.0 : m->compression[c] / weight,
                        m->compression_most[c]);
            else
                fputs("nan,nan", out);
            jox_csv_put_storey(out, def->storeys, at, true);
            if (jox_has_storeys(def->storeys))
                fprintf(out, ",%.3f", (double)(g->low.y + ((float)row + 0.5f) * g->cell));
            fputs("\n", out);
        }
        fputs("\n", out);
    }
}

/* Plots one field as a colour map, of several storeys one above the other (column 9). The colour
   range is given, since gnuplot warns where all values are 0. */
static void plot_field(bool walls, bool storeys, int column, const char *title, double most,
                       JoxText *out) {
    jox_text_printf(out,
                    "set title '%s'\nset cbrange [0:%g]\n"
                    "plot csv skip 1 using 1:%d:%d with image%s\n",
                    title, most > 0.0 ? most : 1.0, storeys ? 9 : 2, column,
                    walls && !storeys ? ", 'walls.dat' using 1:2 with lines lw 1.5 lc 'black'"
                                      : "");
}

static void plot_map(const JoxProbeDef *def, const void *state, bool walls, JoxText *out) {
    const Map *m = state;
    const JoxDensity *g = m->grid;
    double density = 0.0, speed = 0.0, pressure = 0.0, n = m->samples;
    for (size_t c = 0; c < count_map_cells(g); c++) {
        density = fmax(density, m->density[c] / n);
        pressure = fmax(pressure, mean_pressure(m, jox_density_middle(g, c)));
        if (m->density[c] >= LEAST * n)
            speed = fmax(speed, m->speed[c] / m->density[c]);
    }
    if (density <= 0.0) {
        jox_plot_reason(out, "nobody was in the area");
        return;
    }
    jox_text_printf(
        out,
        "unset title\nset multiplot layout 2,2 title heading font ',14' noenhanced\n"
        "set view map\nset size ratio -1\nset xlabel 'x (m)'\nset ylabel 'y (m)'\nunset key\n"
        "unset grid\nset xrange [%g:%g]\nset yrange [%g:%g]\n",
        g->low.x, g->low.x + (float)g->columns * g->cell, g->low.y,
        g->low.y + (float)g->rows * g->cell);
    const bool storeys = jox_has_storeys(def->storeys);
    if (storeys)
        jox_text_add(out, "set ylabel 'y (m), storeys from below, then stairs'\n");
    char title[96];
    snprintf(title, sizeof title, "density (1/m\xc2\xb2), Gaussian, R = %.3g m%s",
             def->kernel * sqrt(2.0), def->through_walls ? ", through walls" : "");
    plot_field(walls, storeys, 3, title, density, out);
    plot_field(walls, storeys, 4, "speed (m/s)", speed, out);
    if (isnan(m->pressure_most))
        jox_text_printf(
            out,
            "set title 'crowd pressure: not measured'\nunset colorbox\nset label 1 'nowhere %g per "
            "m\xc2\xb2 for %g s' at graph 0.5,0.5 center\nplot NaN notitle\nunset label 1\n"
            "set colorbox\n",
            (double)JOX_PRESSURE_LEAST, JOX_PRESSURE_SPAN);
    else
        plot_field(walls, storeys, 5, "crowd pressure (1/s\xc2\xb2), where it was measured",
                   pressure, out);
    if (m->has_compression)
        plot_field(walls, storeys, 7, "greatest compression (N/m)", m->compression_greatest, out);
}

static void free_map(void *state) {
    Map *m = state;
    jox_density_free(m->grid);
    for (int f = 0; f < FIELDS; f++)
        jox_free(m->now[f]);
    jox_free(m->density);
    jox_free(m->speeds);
    jox_free(m->speed);
    jox_free(m->pressure);
    jox_free(m->measured);
    jox_local_free(m->local);
    jox_free(m->compression);
    jox_free(m->compression_most);
}

const JoxProbeCalls jox_probe_map = {
    JOX_PROBE_KIND(Map, map, 1300, 0),
    .frame = take_map_frame,
    .is_due = is_map_due,
    .begin = begin_map,
    .release = free_map,
};
