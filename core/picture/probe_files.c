#include "picture/probe_files.h"

#include <stdio.h>

#include "base/format/quote.h"
#include "picture/plot.h"

/* Writes STEM.plt, which draws the same plot as PNG and as SVG. */
static bool write_probe_script(const JoxProbe *p, const char *folder, const char *stem, bool walls,
                               const char *title, JoxText *error) {
    char name[128];
    snprintf(name, sizeof name, "%s.plt", stem);
    FILE *script = jox_plot_open(folder, name, error);
    JoxText body = {0};
    if (!script)
        return false;
    int width, height;
    jox_probe_plot(p, walls, &body, &width, &height);
    for (int svg = 0; svg < 2; svg++) {
        jox_plot_begin(script, stem, svg, width, height);
        jox_plot_title(script, title);
        /* variable of the table's file name, which plots of all kinds use */
        fputs("csv = ", script);
        jox_plot_file(script, stem, "csv");
        /* variable of the title, for kinds with several plots on a page */
        fputs("\nheading = ", script);
        jox_quote_put(script, jox_quote_gnuplot, title);
        fprintf(script, "\nset datafile separator comma\nset grid\n%s", body.data ? body.data : "");
        fputs("unset multiplot\nset output\n", script);
    }
    jox_text_free(&body);
    return jox_plot_close(script, name, error);
}

void jox_probe_stem(const JoxProbe *p, char stem[JOX_PROBE_STEM]) {
    JoxText name = {0};
    jox_quote_file_name(&name, jox_probe_def(p)->name);
    snprintf(stem, JOX_PROBE_STEM, "%s", name.data);
    jox_text_free(&name);
}

bool jox_probe_write(const JoxProbe *p, const char *folder, const JoxWalls *walls,
                     const char *title, JoxText *error) {
    char stem[JOX_PROBE_STEM], name[128], heading[400];
    jox_probe_stem(p, stem);
    snprintf(name, sizeof name, "%s.csv", stem);
    FILE *file = jox_plot_open(folder, name, error);
    if (!file)
        return false;
    jox_probe_csv(p, file);
    if (!jox_plot_close(file, name, error))
        return false;
    if (!title)
        return true;
    bool drawn = walls && walls->ring_count > 0;
    if (drawn && !jox_plot_walls(folder, walls, NULL, error))
        return false;
    snprintf(name, sizeof name, "%s.plt", stem);
    snprintf(heading, sizeof heading, "%.200s: %.100s", title, jox_probe_def(p)->name);
    return write_probe_script(p, folder, stem, drawn, heading, error) &&
           jox_plot_draw(folder, name, error);
}
