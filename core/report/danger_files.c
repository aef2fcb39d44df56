/* What danger leaves, as pictures. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/format/quote.h"
#include "picture/plot.h"
#include "report/danger_files_parts.h"

enum { STRIP = 260, PANEL = 620 };
static const float FLAT = 0.4f; /* height of an area by its width */

static const char *const WHAT[] = {"density (1/m^2)", "crowd pressure (1/s^2)",
                                   "compression held for 1 s (N/m)",
                                   "load from one side, held for 1 s (N)", "dose of load"};

static const char *const NOTHING[] = {"nobody was here", "nothing anywhere", "nobody was pressed",
                                      "nobody was pressed"};

/* Why crowd pressure was measured nowhere (fields/pressure.h). */
static const char UNMEASURED[] =
    "measured nowhere: never 20 s at 5 per m^2\\nor more on 12 m^2 without a change of the flow";

/* Whether a measure is drawn: compression only where it stands in for load, in older recordings. */
static bool is_drawn(const JoxDanger *d, int measure) {
    return measure == JOX_DANGER_COMPRESSION ? d->has_compression && !d->has_load
           : measure == JOX_DANGER_LOAD || measure == JOX_DANGER_DOSE ? d->has_load
                                                                      : true;
}

static int drawn(const JoxDanger *d, int measures) {
    int count = 0;
    for (int m = 0; m < measures; m++)
        count += is_drawn(d, m);
    return count;
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
    if (!jox_danger_reads(d, measure)) {
        fprintf(script,
                "set title '%s'\nset label 1 \"%s\" at graph 0.5,0.5 center\nset yrange [0:1]\n"
                "plot NaN notitle\nunset label 1\n",
                WHAT[measure], UNMEASURED);
        return;
    }
    fprintf(script, "set title 'greatest %s", WHAT[measure]);
    if (isfinite(jox_danger_least(measure)))
        fprintf(script, "; first limit: %.4g", jox_danger_least(measure));
    fputs("'\n", script);
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
    const int column = 3 + JOX_DANGER_MEASURES + JOX_DANGER_LIMITS + JOX_LEVELS + 1;
    fputs("unset label\nset yrange [0:*]\nset ylabel 'people'\nset title 'people who have "
          "left'\nplot 'danger.csv' skip 1 "
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

/* Flow over each line, with that below which people stop and go. */
static void flows(const JoxDanger *d, FILE *script) {
    double top = JOX_STOP_FLOW;
    for (uint32_t l = 0; l < d->lines.count; l++)
        top = fmax(top, d->lines.items[l].flow_most);
    fprintf(script,
            "unset arrow\nunset label\nset yrange [0:%g]\nset ylabel '1/(m s)'\nset key outside "
            "right top\nset title 'flow over lines in ten seconds; crosses: stop-and-go'\nset "
            "arrow from graph 0, first %g to graph 1, first %g nohead lc '#c00000' dt 2\nplot NaN "
            "notitle",
            1.2 * top, JOX_STOP_FLOW, JOX_STOP_FLOW);
    for (uint32_t l = 0; l < d->lines.count; l++)
        for (int stops = 0; stops < 2; stops++) {
            fputs(", 'danger-lines.csv' skip 1 using (strcol(1) eq ", script);
            jox_quote_put(script, jox_quote_gnuplot, d->lines.items[l].name);
            fprintf(script, "%s ? $2 : NaN):7 with %s lc %u ", stops ? " && $11 == 1" : "",
                    stops ? "points pt 2 ps 0.6" : "lines lw 2", l + 1);
            fputs(stops ? "notitle" : "title ", script);
            if (!stops) {
                jox_quote_put(script, jox_quote_gnuplot, d->lines.items[l].name);
                fputs(" noenhanced", script);
            }
        }
    fputs("\nunset arrow\n", script);
}

static bool draw_times(const JoxDanger *d, const char *folder, const char *title, JoxText *error) {
    FILE *script = jox_plot_open(folder, "danger.plt", error);
    if (!script)
        return false;
    /* A run begins at 0, though its first sample lies a step behind; a recording anywhere. */
    double begun = d->begun > 1.0 ? d->begun : 0.0;
    const bool passed = d->lines.count > 0 && d->row_count > 0;
    const int strips = drawn(d, JOX_DANGER_MEASURES) + 1 + passed + has_left(d);
    for (int svg = 0; svg < 2; svg++) {
        begin_picture(script, "danger", svg, 1200, 60 + strips * STRIP, title);
        fprintf(script,
                "set multiplot layout %d,1 title heading font ',14' noenhanced\nset grid\n"
                "set lmargin 11\nset rmargin 19\nset xlabel 't (s)'\nset xrange [%g:%g]\n",
                strips, begun,
                d->row_count ? fmax(d->rows[d->row_count - 1].time, begun + 1.0) : begun + 1.0);
        for (int m = 0; m < JOX_DANGER_MEASURES; m++)
            if (is_drawn(d, m))
                strip(d, (JoxDangerMeasure)m, script);
        counts(d, script);
        if (passed)
            flows(d, script);
        if (has_left(d))
            leavers(d, script);
        fputs("unset multiplot\nset output\n", script);
    }
    return jox_plot_close(script, "danger.plt", error) &&
           jox_plot_draw(folder, "danger.plt", error);
}

/* Beside the scale of densities, from where on Fruin's levels for queues are; only what is apart
   enough to be read. */
static void level_scale(double top, FILE *script) {
    bool any = false;
    for (int k = 1; k < JOX_LEVELS; k++) {
        const double from = 1.0 / jox_levels[k - 1].queue_area;
        const double next = jox_levels[k].queue_area > 0.0 ? 1.0 / jox_levels[k].queue_area : top;
        if (from > top || (k < JOX_LEVELS - 1 && next - from < 0.06 * top))
            continue;
        fprintf(script, "%s'         %s' %g", any ? ", " : "set cbtics add (", jox_levels[k].name,
                from);
        any = true;
    }
    fputs(any ? ")\n" : "", script);
}

/* Pieces of walls, in the colours of loads. */
static void wall_loads(const JoxDanger *d, bool greatest, FILE *script) {
    if (d->walls.known && d->walls.count)
        fprintf(script,
                ", 'danger-walls.csv' skip 1 using 1:2:($3-$1):($4-$2):%d with vectors nohead lw 5 "
                "lc palette notitle",
                greatest ? 6 : 5);
}

/* One field; the range of colours is given, since gnuplot would warn where all is 0. */
static void panel(const JoxDanger *d, int measure, bool greatest, const JoxWalls *walls,
                  FILE *script) {
    size_t cells = (size_t)d->local->grid->columns * d->local->grid->rows;
    double top = 0.0;
    for (size_t c = 0; c < cells; c++)
        top = fmax(top,
                   greatest ? jox_danger_greatest(d, measure, c) : jox_danger_mean(d, measure, c));
    if (measure == JOX_DANGER_LOAD)
        for (uint32_t p = 0; p < d->walls.count; p++)
            top = fmax(top, (double)(greatest ? d->walls.items[p].most : d->walls.items[p].load));
    if (top <= 0.0) { /* else one would look for it */
        fprintf(script, "set title '%s'\nset label 1 \"%s\" at graph 0.5,0.5 center front\n",
                WHAT[measure],
                jox_danger_reads(d, (JoxDangerMeasure)measure) ? NOTHING[measure] : UNMEASURED);
        fputs("unset colorbox\nplot NaN notitle", script);
        if (walls)
            jox_plot_wall_lines(script, walls, "1.2");
        fputs("\nset colorbox\nunset label 1\n", script);
        return;
    }
    const bool levels = measure == JOX_DANGER_DENSITY;
    const bool loads = measure == JOX_DANGER_LOAD && d->walls.known;
    fprintf(script, "set cbtics autofreq\nset title '%s %s%s'\nset cbrange [0:%g]\n",
            greatest ? "greatest" : "mean", WHAT[measure],
            levels     ? "; levels of service"
            : !loads   ? ""
            : greatest ? "; of walls too"
                       : "; of walls at the end",
            top);
    if (levels)
        level_scale(top, script);
    fprintf(script, "plot 'danger-map.csv' skip 1 using 1:2:%d with image notitle",
            3 + 2 * measure + greatest);
    if (loads)
        wall_loads(d, greatest, script);
    if (walls)
        jox_plot_wall_lines(script, walls, "1.2");
    else
        fputc('\n', script);
}

static bool draw_map(const JoxDanger *d, const char *folder, const JoxWalls *walls,
                     const char *title, JoxText *error) {
    const JoxDensity *g = d->local->grid;
    float width = (float)g->columns * g->cell, height = (float)g->rows * g->cell;
    /* Panels of flat areas stand one below the other, as wide as the picture. */
    const bool flat = height < FLAT * width;
    const int fields = drawn(d, JOX_DANGER_MAPPED), columns = flat ? 1 : fields;
    const int wide = flat ? 2 * PANEL : PANEL, rows = 2 * fields / columns;
    const int tall =
        (int)((float)wide * jox_clampf(height / width, 0.05f, 1.6f)) + (flat ? 110 : 0);
    FILE *script = jox_plot_open(folder, "danger-map.plt", error);
    if (!script)
        return false;
    for (int svg = 0; svg < 2; svg++) {
        begin_picture(script, "danger-map", svg, columns * wide, 60 + rows * tall, title);
        fprintf(script,
                "set multiplot layout %d,%d title heading font ',14' noenhanced\nset size ratio "
                "-1\nset xlabel 'x (m)'\nset ylabel 'y (m)'\nunset key\n"
                "set palette defined (0 '#ffffff', 0.02 '#440154', 0.27 '#3b528b', 0.52 "
                "'#21918c', 0.77 '#5ec962', 1 '#fde725')\nset xrange [%g:%g]\nset yrange "
                "[%g:%g]\n",
                rows, columns, g->low.x, g->low.x + width, g->low.y, g->low.y + height);
        for (int greatest = 0; greatest < 2; greatest++)
            for (int m = 0; m < JOX_DANGER_MAPPED; m++)
                if (is_drawn(d, m))
                    panel(d, m, greatest, walls, script);
        fputs("unset multiplot\nset output\n", script);
    }
    return jox_plot_close(script, "danger-map.plt", error) &&
           jox_plot_draw(folder, "danger-map.plt", error);
}

bool jox_danger_write(const JoxDanger *d, const char *folder, const JoxWalls *walls,
                      const char *title, JoxText *error) {
    char heading[400];
    if (!jox_danger_write_tables(d, folder, error))
        return false;
    if (!title || d->row_count == 0)
        return true;
    const bool walled = walls && walls->ring_count > 0;
    if (walled && !jox_plot_walls(folder, walls, error))
        return false;
    snprintf(heading, sizeof heading, "%.200s: where people are squeezed", title);
    return draw_times(d, folder, heading, error) &&
           draw_map(d, folder, walled ? walls : NULL, heading, error);
}
