#include "picture/plot.h"
#include "base/file.h"

#include <errno.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "base/format/quote.h"

extern char **environ;

bool jox_plot_folder(const char *folder, JoxText *error) {
    char path[1024];
    snprintf(path, sizeof path, "%s", folder);
    for (char *c = path + 1;; c++) {
        char was = *c;
        if (was && was != '/')
            continue;
        *c = 0;
        struct stat info;
        const bool made = mkdir(path, 0777) == 0, there = !made && errno == EEXIST;
        if (!made && !(there && stat(path, &info) == 0 && S_ISDIR(info.st_mode))) {
            jox_text_printf(error, "cannot make the folder '%s': %s", path,
                            there ? "it is no folder" : strerror(errno));
            return false;
        }
        *c = was;
        if (!was)
            return true;
    }
}

FILE *jox_plot_open(const char *folder, const char *name, JoxText *error) {
    char path[1100];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = jox_file_replace(path);
    if (!file)
        jox_text_printf(error, "cannot write '%s': %s", path, jox_file_why(errno));
    return file;
}

bool jox_plot_close(FILE *file, const char *what, JoxText *error) {
    const bool good = jox_file_close(file) == 0;
    if (!good)
        jox_text_printf(error, "cannot write %s: %s", what, strerror(errno));
    return good;
}

/* The child that runs gnuplot on a script of the folder, inside it; -1 if there is none. */
static pid_t spawn(const char *folder, const char *script) {
    char command[] = "gnuplot", usual[] = "-d"; /* -d: ~/.gnuplot is not read */
    JoxText path = {0};
    posix_spawn_file_actions_t actions;
    pid_t child = -1;
    if (posix_spawn_file_actions_init(&actions) != 0)
        return -1;
    jox_text_printf(&path, "./%s", script); /* nor does a name become an option */
    char *arguments[] = {command, usual, path.data, NULL};
    if (posix_spawn_file_actions_addchdir_np(&actions, folder) != 0 ||
        posix_spawnp(&child, command, &actions, NULL, arguments, environ) != 0)
        child = -1;
    posix_spawn_file_actions_destroy(&actions);
    jox_text_free(&path);
    return child;
}

bool jox_plot_draw(const char *folder, const char *script, JoxText *error) {
    pid_t child = spawn(folder, script), ended;
    int status = 0;
    do
        ended = child > 0 ? waitpid(child, &status, 0) : -1;
    while (ended < 0 && child > 0 && errno == EINTR);
    if (ended >= 0 && status == 0)
        return true;
    jox_text_printf(error, "gnuplot could not draw %s/%s (is gnuplot installed?)", folder, script);
    return false;
}

void jox_plot_file(FILE *script, const char *stem, const char *ending) {
    JoxText name = {0};
    jox_text_printf(&name, "%s.%s", stem, ending);
    jox_quote_put(script, jox_quote_gnuplot_file, name.data);
    jox_text_free(&name);
}

void jox_plot_begin(FILE *script, const char *stem, bool svg, int width, int height) {
    fprintf(script, "reset\nset terminal %s size %d,%d font 'sans,%d'\nset output ",
            svg ? "svg background '#ffffff'" : "pngcairo", width, height, svg ? 13 : 12);
    jox_plot_file(script, stem, svg ? "svg" : "png");
    fputs("\nset key noautotitle\n", script); /* names of files are no titles */
}

void jox_plot_title(FILE *script, const char *title) {
    fputs("set title ", script);
    jox_quote_put(script, jox_quote_gnuplot, title);
    fputs(" noenhanced font ',14'\n", script);
}

static uint32_t write_rings(FILE *data, const JoxWalls *walls, bool open) {
    uint32_t count = 0;
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        if (walls->rings[r].open != open)
            continue;
        count++;
        for (uint32_t i = 0; i <= walls->rings[r].count; i++) {
            JoxV2 p = walls->vertices[walls->rings[r].first + i % walls->rings[r].count].point;
            fprintf(data, "%g,%g\n", p.x, p.y);
        }
        fputs("\n", data);
    }
    return count;
}

bool jox_plot_walls(const char *folder, const JoxWalls *walls, JoxText *error) {
    FILE *data = jox_plot_open(folder, "walls.dat", error);
    if (!data)
        return false;
    if (write_rings(data, walls, false) == 0)
        fputs("0,NaN\n\n", data);
    fputs("\n", data); /* a second blank line: the next set */
    write_rings(data, walls, true);
    return jox_plot_close(data, "walls.dat", error);
}

void jox_plot_wall_lines(FILE *script, const JoxWalls *walls, const char *width) {
    bool open = false;
    for (uint32_t r = 0; r < walls->ring_count; r++)
        open |= walls->rings[r].open;
    if (walls->ring_count)
        fprintf(script, ", \\\n  'walls.dat' index 0 using 1:2 with lines lw %s lc 'black' notitle",
                width);
    if (open)
        fprintf(script,
                ", \\\n  'walls.dat' index 1 using 1:2 with lines lw %s lc '#808080' dt 2 notitle",
                width);
    fputs("\n", script);
}

bool jox_plot_density(const char *folder, const JoxDensity *d, const JoxWalls *walls,
                      const char *title, JoxText *error) {
    FILE *data = jox_plot_open(folder, "density.csv", error);
    if (!data)
        return false;
    uint32_t skip = d->columns * d->rows > 250000 ? 2 : 1; /* enough for the picture's pixels */
    double most = 0.0;
    fputs("x_m,y_m,mean_density_per_m2\n", data);
    for (uint32_t row = 0; row < d->rows; row += skip) {
        for (uint32_t column = 0; column < d->columns; column += skip) {
            double mean = jox_density_mean(d, column, row);
            most = mean > most ? mean : most;
            fprintf(data, "%.2f,%.2f,%.4g\n", d->low.x + ((float)column + 0.5f) * d->cell,
                    d->low.y + ((float)row + 0.5f) * d->cell, mean);
        }
        fputs("\n", data);
    }
    if (!jox_plot_close(data, "density.csv", error) || !jox_plot_walls(folder, walls, error) ||
        !(data = jox_plot_open(folder, "density.plt", error)))
        return false;
    float width = d->cell * (float)d->columns, height = d->cell * (float)d->rows;
    int tall = (int)(1000.0f * jox_clampf(height / width, 0.3f, 2.0f)) + 120;
    jox_plot_begin(data, "density", false, 1200, tall);
    jox_plot_title(data, title);
    fprintf(
        data,
        "set datafile separator comma\nset view map\nset size ratio -1\n"
        "set xlabel 'x (m)'\nset ylabel 'y (m)'\nset cblabel 'people per m^2 (mean)'\n"
        "set palette defined (0 '#ffffff', 0.02 '#440154', 0.27 '#3b528b', 0.52 '#21918c', "
        "0.77 '#5ec962', 1 '#fde725')\nset cbrange [0:%g]\nset xrange [%g:%g]\n"
        "set yrange [%g:%g]\nunset key\nset clip two\n"
        "set label 1 sprintf('greatest at any time: %%.1f per m^2 at (%%.0f, %%.0f) m, t = %%.0f "
        "s',"
        " %g, %g, %g, %g) at graph 0, 0 offset 1, 0.8 front tc "
        "'#c00000'\n"
        "plot 'density.csv' skip 1 using 1:2:3 with image",
        most > 0.0 ? most : 1.0, d->low.x, d->low.x + width, d->low.y, d->low.y + height, d->most,
        d->most_at.x, d->most_at.y, d->most_time);
    jox_plot_wall_lines(data, walls, "1.5");
    return jox_plot_close(data, "density.plt", error) &&
           jox_plot_draw(folder, "density.plt", error);
}

bool jox_plot_regions(const char *folder, const JoxRegions *regions, const char *title,
                      JoxText *error) {
    FILE *data = jox_plot_open(folder, "regions.csv", error);
    if (!data)
        return false;
    fputs("region,mean_speed_m_per_s,people_frames\n", data);
    for (uint32_t r = 0; r < regions->count; r++) {
        jox_quote_put(data, jox_quote_csv, regions->items[r].name);
        fprintf(data, ",%.4f,%llu\n", jox_region_speed(&regions->items[r]),
                (unsigned long long)regions->items[r].people);
    }
    if (!jox_plot_close(data, "regions.csv", error) ||
        !(data = jox_plot_open(folder, "regions.plt", error)))
        return false;
    jox_plot_begin(data, "regions", false, 1200, 600);
    jox_plot_title(data, title);
    fputs("set datafile separator comma\nset style fill solid 0.9\nset boxwidth 0.6\nunset key\n"
          "set yrange [0:*]\nset offsets 0.5, 0.5, 0.05, 0\nset grid ytics\n"
          "set xtics noenhanced\nset xlabel 'region'\nset ylabel 'mean speed (m/s)'\n"
          "plot 'regions.csv' skip 1 using 0:2:xtic(1) with boxes lc '#21918c', "
          "'' skip 1 using 0:2:(sprintf('%.2f', $2)) with labels offset 0,0.7\n",
          data);
    return jox_plot_close(data, "regions.plt", error) &&
           jox_plot_draw(folder, "regions.plt", error);
}
