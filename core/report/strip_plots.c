/* Plots of strips over time, one below the other: danger_plots.c, stair_plots.c and lift_times.c
   write the strips. */
#include <math.h>
#include <stdio.h>

#include "base/format/quote.h"
#include "picture/plot.h"
#include "report/danger_output_parts.h"

static const int LEFT = 10, RIGHT = 34; /* margins in characters, equal in all strips */

void jox_strips_title(const char *title, char out[JOX_STRIP_TITLE]) {
    snprintf(out, JOX_STRIP_TITLE, "%.200s: ", title);
}

void jox_strips_set_title(FILE *script, const char *title) {
    fputs("set title heading.", script);
    jox_quote_put(script, jox_quote_gnuplot, title);
    fputs(" noenhanced\nheading = ''\n", script);
}

/* Begins a script: size and output file for PNG or SVG, separator, and the variable `heading`, with
   which the title of the first strip begins. */
static void begin_danger_script(FILE *script, const char *name, bool svg, int width, int height,
                                const char *title) {
    jox_plot_begin(script, name, svg, width, height);
    fputs("set datafile separator comma\nheading = ", script);
    jox_quote_put(script, jox_quote_gnuplot, title);
    fputc('\n', script);
}

/* Begins a plot of strips over time. The axis of a run begins at 0 although its first sample is
   one step later; that of a recording begins anywhere. */
static void begin_strip_plot(const JoxDanger *d, const JoxStripPlot *plot, bool svg, FILE *script) {
    const double begun = d->begun > 1.0 ? d->begun : 0.0;
    begin_danger_script(script, plot->name, svg, JOX_DANGER_STRIPS_WIDE,
                        plot->strips * plot->height, plot->title);
    fprintf(script,
            "set multiplot layout %d,1\nset grid\n"
            "set lmargin %d\nset rmargin %d\nset xlabel 'time (s)'\nset xrange [%g:%g]\n",
            plot->strips, LEFT, RIGHT, begun,
            d->row_count ? fmax(d->rows[d->row_count - 1].time, begun + 1.0) : begun + 1.0);
}

bool jox_danger_draw_strips(const JoxDanger *d, const char *folder, const JoxStripPlot *plot,
                            JoxText *error) {
    char file[40];
    if (plot->strips == 0)
        return true;
    snprintf(file, sizeof file, "%s.plt", plot->name);
    FILE *script = jox_plot_open(folder, file, error);
    if (!script)
        return false;
    for (int svg = 0; svg < 2; svg++) {
        begin_strip_plot(d, plot, svg, script);
        plot->write(plot->what, script);
        fputs("unset multiplot\nset output\n", script);
    }
    return jox_plot_close(script, file, error) && jox_plot_draw(folder, file, error);
}
