#include "picture/probe_files.h"

#include <stdio.h>

#include "picture/plot.h"

/* Writes NAME.plt: the same commands for both terminals. */
static bool write_script(const JoxProbe *p, const char *folder, const char *name, bool walls,
                         const char *title, JoxText *error) {
    FILE *script = jox_plot_open(folder, name, error);
    JoxText body = {0};
    if (!script)
        return false;
    int width, height;
    jox_probe_plot(p, walls, &body, &width, &height);
    for (int svg = 0; svg < 2; svg++) {
        fprintf(script, "reset\nset terminal %s size %d,%d font 'sans,%d'\nset output '%s.%s'\n",
                svg ? "svg background '#ffffff'" : "pngcairo", width, height, svg ? 13 : 12,
                jox_probe_def(p)->name, svg ? "svg" : "png");
        jox_plot_title(script, title);
        fputs("heading = ", script); /* for pages of several plots */
        jox_plot_quote(script, title);
        fprintf(script, "\nset datafile separator comma\nset grid\n%s", body.data ? body.data : "");
        fputs("unset multiplot\nset output\n", script);
    }
    jox_text_free(&body);
    return jox_plot_close(script, name, error);
}

bool jox_probe_write(const JoxProbe *p, const char *folder, const JoxWalls *walls,
                     const char *title, JoxText *error) {
    char name[128], heading[400];
    snprintf(name, sizeof name, "%s.csv", jox_probe_def(p)->name);
    FILE *file = jox_plot_open(folder, name, error);
    if (!file)
        return false;
    jox_probe_csv(p, file);
    if (!jox_plot_close(file, name, error))
        return false;
    if (!title)
        return true;
    bool drawn = walls && walls->ring_count > 0;
    if (drawn && !jox_plot_walls(folder, walls, error))
        return false;
    snprintf(name, sizeof name, "%s.plt", jox_probe_def(p)->name);
    snprintf(heading, sizeof heading, "%.200s: %.100s", title, jox_probe_def(p)->name);
    return write_script(p, folder, name, drawn, heading, error) &&
           jox_plot_draw(folder, name, error);
}
