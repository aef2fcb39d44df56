/* What danger leaves: danger.csv and danger-map.csv, and both as pictures. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/format/quote.h"
#include "picture/plot.h"
#include "record/danger/danger_parts.h"
#include "report/danger_files.h"

enum { MOST_CELLS_DRAWN = 250000, STRIP = 260, PANEL = 620 };

static const char *const WHAT[] = {"density (1/m^2)", "crowd pressure (1/s^2)",
                                   "compression held for 1 s (N/m)"};

static bool write_times(const JoxDanger *d, const char *folder, JoxText *error) {
    FILE *out = jox_plot_open(folder, "danger.csv", error);
    if (!out)
        return false;
    fputs("time [s],people", out);
    for (int m = 0; m < JOX_DANGER_MEASURES; m++)
        fprintf(out, ",%s_max [%s]", jox_danger_names[m], jox_danger_units[m]);
    for (int l = 0; l < JOX_DANGER_LIMITS; l++)
        fprintf(out, ",over_%s", jox_danger_limits[l].key);
    fputs(",left", out);
    for (uint32_t e = 0; e < d->exit_count; e++) {
        JoxText head = {0};
        jox_text_printf(&head, "left_%s", d->exit_names[e]);
        fputc(',', out);
        jox_quote_put(out, jox_quote_csv, head.data);
        jox_text_free(&head);
    }
    fputc('\n', out);
    for (uint32_t r = 0; r < d->row_count; r++) {
        const JoxDangerRow *row = &d->rows[r];
        fprintf(out, "%.9g,%u", row->time, row->people);
        for (int m = 0; m < JOX_DANGER_MEASURES; m++)
            fprintf(out, ",%.5g", (double)row->most[m]);
        for (int l = 0; l < JOX_DANGER_LIMITS; l++)
            fprintf(out, ",%u", row->over[l]);
        fprintf(out, ",%u", row->left);
        for (uint32_t e = 0; e < d->exit_count; e++)
            fprintf(out, ",%u", row->exits[e]);
        fputc('\n', out);
    }
    return jox_plot_close(out, "danger.csv", error);
}

/* Means are over samples, of compression over the people who stood in the cell. */
static double mean_of(const JoxDanger *d, int measure, size_t cell) {
    double n = measure == JOX_DANGER_COMPRESSION ? d->stood[cell]
               : measure == JOX_DANGER_PRESSURE  ? d->pressure_samples
                                                 : d->samples;
    return n > 0.0 ? d->sum[measure][cell] / n : 0.0;
}

static bool write_map(const JoxDanger *d, const char *folder, JoxText *error) {
    const JoxDensity *g = d->grid;
    uint32_t skip = 1;
    while ((g->columns / skip) * (g->rows / skip) > MOST_CELLS_DRAWN)
        skip++;
    FILE *out = jox_plot_open(folder, "danger-map.csv", error);
    if (!out)
        return false;
    fputs("x [m],y [m]", out);
    for (int m = 0; m < JOX_DANGER_MEASURES; m++)
        fprintf(out, ",%s_mean [%s],%s_max [%s]", jox_danger_names[m], jox_danger_units[m],
                jox_danger_names[m], jox_danger_units[m]);
    fputc('\n', out);
    for (uint32_t row = 0; row < g->rows; row += skip) {
        for (uint32_t column = 0; column < g->columns; column += skip) {
            size_t cell = (size_t)row * g->columns + column;
            fprintf(out, "%.3f,%.3f", g->low.x + ((float)column + 0.5f) * g->cell,
                    g->low.y + ((float)row + 0.5f) * g->cell);
            for (int m = 0; m < JOX_DANGER_MEASURES; m++)
                fprintf(out, ",%.4g,%.4g", mean_of(d, m, cell), (double)d->greatest[m][cell]);
            fputc('\n', out);
        }
        fputc('\n', out);
    }
    return jox_plot_close(out, "danger-map.csv", error);
}

/* Opens a script and says, for PNG and SVG, how large and under which title. */
static void begin_picture(FILE *script, const char *name, bool svg, int width, int height,
                          const char *title) {
    jox_plot_begin(script, name, svg, width, height);
    fputs("set datafile separator comma\nheading = ", script);
    jox_quote_put(script, jox_quote_gnuplot, title);
    fputc('\n', script);
}

/* Greatest value over time, with the limits as lines that say what they are. */
static void strip(const JoxDanger *d, JoxDangerMeasure measure, FILE *script) {
    double top = 0.0;
    for (uint32_t r = 0; r < d->row_count; r++)
        top = fmax(top, d->rows[r].most[measure]);
    fprintf(script, "set ylabel '%s'\nunset arrow\nunset label\n", jox_danger_units[measure]);
    int first = 0;
    while (jox_danger_limits[first].measure != measure)
        first++;
    fprintf(script, "set title 'greatest %s of anyone; first limit: %.4g'\n", WHAT[measure],
            jox_danger_limits[first].value);
    for (int l = 0; l < JOX_DANGER_LIMITS; l++) {
        double limit = jox_danger_limits[l].value;
        if ((int)jox_danger_limits[l].measure != (int)measure ||
            limit > 2.0 * fmax(top, limit / 2.1))
            continue;
        if (limit > 1.6 * top && l > 0 && (int)jox_danger_limits[l - 1].measure == (int)measure)
            continue; /* far above: it would only flatten the line */
        fprintf(script,
                "set arrow from graph 0, first %.6g to graph 1, first %.6g nohead lc '#c00000' dt "
                "2\nset label '%s' at graph 1.01, first %.6g left tc '#c00000' "
                "noenhanced\n",
                limit, limit, jox_danger_limits[l].key, limit);
        top = fmax(top, limit);
    }
    fprintf(script,
            "set yrange [0:%g]\nplot 'danger.csv' skip 1 using 1:%d with lines lw 2 lc '#3b528b' "
            "notitle\n",
            top > 0.0 ? 1.2 * top : 1.0, 3 + measure);
}

/* People over each limit that anyone passed, and who left. */
static void counts(const JoxDanger *d, FILE *script) {
    static const char *const COLOURS[] = {"#440154", "#3b528b", "#21918c", "#5ec962",
                                          "#e69f00", "#d55e00", "#a40000"};
    bool any = false;
    fputs("unset arrow\nunset label\nset yrange [0:*]\nset ylabel 'people'\nset key outside "
          "right top\nset title 'people over a limit'\n",
          script);
    for (int l = 0; l < JOX_DANGER_LIMITS; l++)
        if (d->counts[l].people > 0) {
            fprintf(
                script,
                "%s'danger.csv' skip 1 using 1:%d with lines lw 2 lc '%s' title '%s' noenhanced",
                any ? ", " : "plot ", 3 + JOX_DANGER_MEASURES + l, COLOURS[l],
                jox_danger_limits[l].key);
            any = true;
        }
    if (!any)
        fputs("set yrange [0:1]\nset label 1 'nobody was over any limit' at graph 0.5,0.5 "
              "center\nplot 'danger.csv' skip 1 using 1:(0) with lines lc '#808080' notitle",
              script);
    fputc('\n', script);
}

static bool has_left(const JoxDanger *d) {
    return d->row_count > 0 && d->rows[d->row_count - 1].left > 0;
}

static void leavers(const JoxDanger *d, FILE *script) {
    int column = 3 + JOX_DANGER_MEASURES + JOX_DANGER_LIMITS;
    fputs(
        "unset label\nset yrange [0:*]\nset title 'people who have left'\nplot 'danger.csv' skip 1 "
        "using 1:",
        script);
    fprintf(script, "%d with lines lw 2 lc 'black' title 'all'", column);
    for (uint32_t e = 0; e < d->exit_count; e++) {
        fprintf(script, ", '' skip 1 using 1:%d with lines lw 2 title ", column + 1 + (int)e);
        jox_quote_put(script, jox_quote_gnuplot, d->exit_names[e]);
        fputs(" noenhanced", script);
    }
    fputc('\n', script);
}

static bool draw_times(const JoxDanger *d, const char *folder, const char *title, JoxText *error) {
    FILE *script = jox_plot_open(folder, "danger.plt", error);
    if (!script)
        return false;
    /* A run begins at 0, though its first sample lies a step behind; a recording anywhere. */
    double begun = d->begun > 1.0 ? d->begun : 0.0;
    int strips = 3 + d->has_compression + has_left(d);
    for (int svg = 0; svg < 2; svg++) {
        begin_picture(script, "danger", svg, 1200, 60 + strips * STRIP, title);
        fprintf(script,
                "set multiplot layout %d,1 title heading font ',14' noenhanced\nset grid\n"
                "set lmargin 11\nset rmargin 19\nset xlabel 't (s)'\nset xrange [%g:%g]\n",
                strips, begun,
                d->row_count ? fmax(d->rows[d->row_count - 1].time, begun + 1.0) : begun + 1.0);
        for (int m = 0; m < JOX_DANGER_MEASURES; m++)
            if (m != JOX_DANGER_COMPRESSION || d->has_compression)
                strip(d, (JoxDangerMeasure)m, script);
        counts(d, script);
        if (has_left(d))
            leavers(d, script);
        fputs("unset multiplot\nset output\n", script);
    }
    return jox_plot_close(script, "danger.plt", error) &&
           jox_plot_draw(folder, "danger.plt", error);
}

/* One field; the range of colours is given, since gnuplot would warn where all is 0. */
static void panel(const JoxDanger *d, int measure, bool greatest, const JoxWalls *walls,
                  FILE *script) {
    size_t cells = (size_t)d->grid->columns * d->grid->rows;
    double top = 0.0;
    for (size_t c = 0; c < cells; c++)
        top = fmax(top, greatest ? d->greatest[measure][c] : mean_of(d, measure, c));
    if (top <= 0.0) { /* else one would look for it */
        fprintf(script, "set title '%s'\nset label 1 '%s' at graph 0.5,0.5 center front\n",
                WHAT[measure],
                measure == JOX_DANGER_PRESSURE ? "nowhere dense enough, or too short"
                                               : "nobody was pressed");
        fputs("unset colorbox\nplot NaN notitle\nset colorbox\nunset label 1\n", script);
        return;
    }
    fprintf(script,
            "set title '%s %s'\nset cbrange [0:%g]\nplot 'danger-map.csv' skip 1 using 1:2:%d with "
            "image notitle",
            greatest ? "greatest" : "mean", WHAT[measure], top, 3 + 2 * measure + greatest);
    if (walls)
        jox_plot_wall_lines(script, walls, "1.2");
    else
        fputc('\n', script);
}

static bool draw_map(const JoxDanger *d, const char *folder, const JoxWalls *walls,
                     const char *title, JoxText *error) {
    const JoxDensity *g = d->grid;
    float width = (float)g->columns * g->cell, height = (float)g->rows * g->cell;
    int columns = 2 + d->has_compression;
    int tall = (int)(PANEL * jox_clampf(height / width, 0.35f, 1.6f));
    FILE *script = jox_plot_open(folder, "danger-map.plt", error);
    if (!script)
        return false;
    for (int svg = 0; svg < 2; svg++) {
        begin_picture(script, "danger-map", svg, columns * PANEL, 60 + 2 * tall, title);
        fprintf(script,
                "set multiplot layout 2,%d title heading font ',14' noenhanced\nset size ratio "
                "-1\nset xlabel 'x (m)'\nset ylabel 'y (m)'\nunset key\n"
                "set palette defined (0 '#ffffff', 0.02 '#440154', 0.27 '#3b528b', 0.52 "
                "'#21918c', 0.77 '#5ec962', 1 '#fde725')\nset xrange [%g:%g]\nset yrange "
                "[%g:%g]\n",
                columns, g->low.x, g->low.x + width, g->low.y, g->low.y + height);
        for (int greatest = 0; greatest < 2; greatest++)
            for (int m = 0; m < columns; m++)
                panel(d, m, greatest, walls, script);
        fputs("unset multiplot\nset output\n", script);
    }
    return jox_plot_close(script, "danger-map.plt", error) &&
           jox_plot_draw(folder, "danger-map.plt", error);
}

bool jox_danger_write(const JoxDanger *d, const char *folder, const JoxWalls *walls,
                      const char *title, JoxText *error) {
    char heading[400];
    if (!write_times(d, folder, error) || !write_map(d, folder, error))
        return false;
    if (!title || d->row_count == 0)
        return true;
    bool drawn = walls && walls->ring_count > 0;
    if (drawn && !jox_plot_walls(folder, walls, error))
        return false;
    snprintf(heading, sizeof heading, "%.200s: where people are squeezed", title);
    return draw_times(d, folder, heading, error) &&
           draw_map(d, folder, drawn ? walls : NULL, heading, error);
}
