/* Fields on a grid, each by the Gaussian kernel w of density.h:
     density             sum of w, mean over the samples, 1/m2
     speed               sum of w |v| over sum of w, over all samples, m/s
     pressure            density times the local variance of velocity, sum of w |v|2 over sum of w
                         less |sum of w v over sum of w|2: the crowd pressure of Helbing, Johansson
                         and Al-Abideen 2007 (doi 10.1103/PhysRevE.75.046109, equations 1 to 6),
   1/s2; mean over the samples compression         sum of w c over sum of w, over all samples, N/m
     compression_most    greatest of anyone who stood in the cell, N/m */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "record/fields/density.h"
#include "record/probes/probe_parts.h"

enum { DENSITY, SPEED, VX, VY, SQUARE, COMPRESSION, FIELDS };
static const float LEAST = 0.02f; /* 1/m2: below this there is nobody to have a velocity */
enum { MOST_CELLS_DRAWN = 250000 };

typedef struct Map {
    JoxDensity *grid;
    float *now[FIELDS];
    double *density, *speed, *pressure, *compression; /* sums over samples */
    float *compression_most;
    double density_most, pressure_most, density_time, pressure_time; /* of any cell at any time */
    JoxV2 density_at, pressure_at;
    double speed_sum, compression_greatest;
    uint64_t people;
    uint32_t samples;
    bool has_compression;
} Map;

static void begin(const JoxProbeDef *def, void *state) {
    Map *m = state;
    m->grid = jox_density_create(def->low, def->high, (float)def->cell, (float)def->kernel);
    size_t cells = (size_t)m->grid->columns * m->grid->rows;
    for (int f = 0; f < FIELDS; f++)
        m->now[f] = jox_alloc(cells, sizeof(float));
    m->density = jox_alloc(cells, sizeof(double));
    m->speed = jox_alloc(cells, sizeof(double));
    m->pressure = jox_alloc(cells, sizeof(double));
    m->compression = jox_alloc(cells, sizeof(double));
    m->compression_most = jox_alloc(cells, sizeof(float));
}

static JoxV2 middle_of(const Map *m, size_t cell) {
    const JoxDensity *g = m->grid;
    return jox_v2(g->low.x + ((float)(cell % g->columns) + 0.5f) * g->cell,
                  g->low.y + ((float)(cell / g->columns) + 0.5f) * g->cell);
}

/* One person and the images over periodic edges. */
static void spread(Map *m, const JoxFrame *frame, uint32_t i, const float weights[FIELDS]) {
    const JoxDensity *g = m->grid;
    int across = frame->period.x > 0.0f, up = frame->period.y > 0.0f;
    float reach = ((float)g->reach + 1.0f) * g->cell;
    for (int c = -across; c <= across; c++)
        for (int r = -up; r <= up; r++) {
            float x = frame->x[i] + (float)c * frame->period.x - g->low.x;
            float y = frame->y[i] + (float)r * frame->period.y - g->low.y;
            if (x > -reach && x < (float)g->columns * g->cell + reach && y > -reach &&
                y < (float)g->rows * g->cell + reach)
                jox_density_spread(g, m->now, weights, FIELDS, x + g->low.x, y + g->low.y);
        }
}

static void note_compression(Map *m, const JoxFrame *frame, uint32_t i) {
    const JoxDensity *g = m->grid;
    float column = floorf((frame->x[i] - g->low.x) / g->cell);
    float row = floorf((frame->y[i] - g->low.y) / g->cell);
    if (!(column >= 0.0f && column < (float)g->columns && row >= 0.0f && row < (float)g->rows))
        return;
    float *most = &m->compression_most[(size_t)row * g->columns + (size_t)column];
    *most = jox_maxf(*most, frame->compression[i]);
    m->compression_greatest = fmax(m->compression_greatest, frame->compression[i]);
}

/* Adds the fields of this sample to the sums. */
static void sum_up(Map *m, double t) {
    size_t cells = (size_t)m->grid->columns * m->grid->rows;
    for (size_t c = 0; c < cells; c++) {
        double density = m->now[DENSITY][c];
        m->density[c] += density;
        if (density > m->density_most) {
            m->density_most = density;
            m->density_time = t;
            m->density_at = middle_of(m, c);
        }
        if (density < LEAST)
            continue;
        double vx = m->now[VX][c] / density, vy = m->now[VY][c] / density;
        double variance = fmax(m->now[SQUARE][c] / density - vx * vx - vy * vy, 0.0);
        m->speed[c] += m->now[SPEED][c];
        m->compression[c] += m->now[COMPRESSION][c];
        m->pressure[c] += density * variance;
        if (density * variance > m->pressure_most) {
            m->pressure_most = density * variance;
            m->pressure_time = t;
            m->pressure_at = middle_of(m, c);
        }
    }
    m->samples++;
}

static void frame(const JoxProbeDef *def, void *state, const JoxFrame *frame, const uint8_t *seen) {
    (void)def;
    Map *m = state;
    size_t cells = (size_t)m->grid->columns * m->grid->rows;
    for (int f = 0; f < FIELDS; f++)
        memset(m->now[f], 0, cells * sizeof(float));
    for (uint32_t i = 0; i < frame->count; i++) {
        if (!seen[i])
            continue;
        float vx = frame->vx[i], vy = frame->vy[i], square = vx * vx + vy * vy;
        float pressed = frame->compression ? frame->compression[i] : 0.0f;
        spread(m, frame, i, (float[FIELDS]){1.0f, sqrtf(square), vx, vy, square, pressed});
        if (frame->compression)
            note_compression(m, frame, i);
        m->speed_sum += sqrtf(square);
        m->people++;
    }
    m->has_compression |= frame->compression != NULL;
    sum_up(m, frame->time);
}

static void figures(const JoxProbeDef *def, const void *state, JoxFigures *out) {
    (void)def;
    const Map *m = state;
    size_t cells = (size_t)m->grid->columns * m->grid->rows;
    double density = 0.0, pressure = 0.0, n = m->samples ? m->samples : NAN;
    for (size_t c = 0; c < cells; c++) {
        density = fmax(density, m->density[c]);
        pressure = fmax(pressure, m->pressure[c]);
    }
    jox_figure_add(out, "samples", "", m->samples);
    jox_figure_add(out, "density_max", "1/m2", m->samples ? m->density_most : NAN);
    jox_figure_add(out, "density_max_x", "m", m->samples ? m->density_at.x : NAN);
    jox_figure_add(out, "density_max_y", "m", m->samples ? m->density_at.y : NAN);
    jox_figure_add(out, "density_max_time", "s", m->samples ? m->density_time : NAN);
    jox_figure_add(out, "density_mean_max", "1/m2", density / n);
    jox_figure_add(out, "speed", "m/s", m->people ? m->speed_sum / (double)m->people : NAN);
    jox_figure_add(out, "pressure_max", "1/s2", m->samples ? m->pressure_most : NAN);
    jox_figure_add(out, "pressure_max_x", "m", m->samples ? m->pressure_at.x : NAN);
    jox_figure_add(out, "pressure_max_y", "m", m->samples ? m->pressure_at.y : NAN);
    jox_figure_add(out, "pressure_max_time", "s", m->samples ? m->pressure_time : NAN);
    jox_figure_add(out, "pressure_mean_max", "1/s2", pressure / n);
    jox_figure_add(out, "compression_max", "N/m",
                   m->has_compression ? m->compression_greatest : NAN);
}

static void csv(const JoxProbeDef *def, const void *state, FILE *out) {
    (void)def;
    const Map *m = state;
    const JoxDensity *g = m->grid;
    uint32_t skip = g->columns * g->rows > MOST_CELLS_DRAWN ? 2 : 1;
    double n = m->samples ? m->samples : 1.0;
    fputs("x [m],y [m],density [1/m2],speed [m/s],pressure [1/s2],compression [N/m],"
          "compression_most [N/m]\n",
          out);
    for (uint32_t row = 0; row < g->rows; row += skip) {
        for (uint32_t column = 0; column < g->columns; column += skip) {
            size_t c = (size_t)row * g->columns + column;
            double weight = m->density[c];
            JoxV2 at = middle_of(m, c);
            fprintf(out, "%.3f,%.3f,%.4g,", at.x, at.y, weight / n);
            if (weight < LEAST * n)
                fprintf(out, "nan,%.4g,", m->pressure[c] / n);
            else
                fprintf(out, "%.4g,%.4g,", m->speed[c] / weight, m->pressure[c] / n);
            if (m->has_compression)
                fprintf(out, "%.4g,%.4g\n", weight < LEAST * n ? 0.0 : m->compression[c] / weight,
                        m->compression_most[c]);
            else
                fputs("nan,nan\n", out);
        }
        fputs("\n", out);
    }
}

/* One field; the range of colours is given: gnuplot would warn where all is 0. */
static void panel(bool walls, int column, const char *what, double most, JoxText *out) {
    jox_text_printf(out,
                    "set title '%s'\nset cbrange [0:%g]\n"
                    "set palette defined (%s0.02 '#440154', 0.27 '#3b528b', 0.52 '#21918c', "
                    "0.77 '#5ec962', 1 '#fde725')\n"
                    "plot csv skip 1 using 1:2:%d with image%s\n",
                    what, most > 0.0 ? most : 1.0,
                    column == 4 ? "" : "0 '#ffffff', ", /* where all is still, too, one sees it */
                    column, walls ? ", 'walls.dat' using 1:2 with lines lw 1.5 lc 'black'" : "");
}

static void plot(const JoxProbeDef *def, const void *state, bool walls, JoxText *out) {
    (void)def;
    const Map *m = state;
    const JoxDensity *g = m->grid;
    double density = 0.0, speed = 0.0, pressure = 0.0, n = m->samples;
    for (size_t c = 0; c < (size_t)g->columns * g->rows; c++) {
        density = fmax(density, m->density[c] / n);
        pressure = fmax(pressure, m->pressure[c] / n);
        if (m->density[c] >= LEAST * n)
            speed = fmax(speed, m->speed[c] / m->density[c]);
    }
    if (density <= 0.0) {
        jox_plot_nothing(out, "nobody was in the area");
        return;
    }
    jox_text_printf(
        out,
        "unset title\nset multiplot layout 2,2 title heading font ',14' noenhanced\n"
        "set view map\nset size ratio -1\nset xlabel 'x (m)'\nset ylabel 'y (m)'\nunset key\n"
        "unset grid\nset xrange [%g:%g]\nset yrange [%g:%g]\n",
        g->low.x, g->low.x + (float)g->columns * g->cell, g->low.y,
        g->low.y + (float)g->rows * g->cell);
    panel(walls, 3, "density (1/m^2)", density, out);
    panel(walls, 4, "speed (m/s)", speed, out);
    panel(walls, 5, "crowd pressure (1/s^2)", pressure, out);
    if (m->has_compression)
        panel(walls, 7, "greatest compression (N/m)", m->compression_greatest, out);
}

static void release(void *state) {
    Map *m = state;
    jox_density_free(m->grid);
    for (int f = 0; f < FIELDS; f++)
        jox_free(m->now[f]);
    jox_free(m->density);
    jox_free(m->speed);
    jox_free(m->pressure);
    jox_free(m->compression);
    jox_free(m->compression_most);
}

const JoxProbeCalls jox_probe_map = {
    JOX_PROBE_KIND(Map, 1300, 0), .frame = frame, .pace = JOX_PACE_EVERY, .begin = begin,
    .release = release,
};
