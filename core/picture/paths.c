#include "picture/paths.h"

#include <stdio.h>

#include "base/format/quote.h"
#include "base/mem.h"
#include "picture/palette.h"
#include "picture/plot.h"

JoxPaths *jox_paths_create(void) {
    return jox_alloc(1, sizeof(JoxPaths));
}

void jox_paths_add(JoxPaths *paths, uint32_t id, bool body, uint32_t series, float t, float x,
                   float y) {
    JoxWalkedPath *path = NULL;
    for (uint32_t p = 0; p < paths->count && !path; p++)
        if (paths->items[p].id == id && paths->items[p].body == body)
            path = &paths->items[p];
    if (!path) {
        if (paths->count == JOX_MOST_PATHS)
            return;
        JOX_RESERVE(paths->items, paths->capacity, paths->count + 1);
        path = &paths->items[paths->count++];
        *path = (JoxWalkedPath){.id = id, .body = body, .series = series};
    }
    JOX_RESERVE(path->points, path->capacity, path->count + 1);
    path->points[path->count++] = (JoxPathPoint){t, x, y};
}

void jox_paths_sections(JoxPaths *paths, JoxSections *s) {
    uint32_t count = (uint32_t)jox_section_count(s, "paths", paths->count, 1);
    if (count > JOX_MOST_PATHS) {
        jox_sections_fail(s, "paths", "there are too many");
        return;
    }
    JOX_RESERVE(paths->items, paths->capacity, count);
    for (; paths->count < count; paths->count++)
        paths->items[paths->count] = (JoxWalkedPath){0};
    for (uint32_t p = 0; p < count; p++) {
        JoxWalkedPath *path = &paths->items[p];
        JOX_SECTION(s, "id", path->id);
        JOX_SECTION(s, "series", path->series);
        JOX_SECTION(s, "body", path->body);
        JOX_SECTION_ARRAY(s, "points", path->points, path->count, path->capacity);
    }
}

void jox_paths_free(JoxPaths *paths) {
    for (uint32_t p = 0; paths && p < paths->count; p++)
        jox_free(paths->items[p].points);
    if (paths)
        jox_free(paths->items);
    jox_free(paths);
}

/* Writes the points of all paths of a series as a data set of gnuplot. `part` 0: all points, a
   blank line after each path; 1: first points; 2: last points. */
static void write_path_series(FILE *data, const JoxPaths *paths, uint32_t series, bool body,
                              int part) {
    for (uint32_t p = 0; p < paths->count; p++) {
        const JoxWalkedPath *path = &paths->items[p];
        if (path->body != body || path->series != series || path->count == 0)
            continue;
        uint32_t first = part == 2 ? path->count - 1 : 0, last = part == 1 ? 1 : path->count;
        for (uint32_t i = first; i < last; i++)
            fprintf(data, "%u,%.2f,%.3f,%.3f\n", path->id, path->points[i].t, path->points[i].x,
                    path->points[i].y);
        if (part == 0)
            fputs("\n", data);
    }
    fputs("\n\n", data); /* two blank lines begin the next data set */
}

static bool has_path_series(const JoxPaths *paths, uint32_t series, bool body) {
    for (uint32_t p = 0; p < paths->count; p++)
        if (paths->items[p].body == body && paths->items[p].series == series &&
            paths->items[p].count)
            return true;
    return false;
}

/* Appends the plot elements of a series: its lines, first points and last points, which are data
   sets `set` to `set` + 2. */
static void append_series_plot(JoxText *plot, uint32_t set, const char *colour, const char *width,
                               const char *name) {
    jox_text_printf(plot, "%s'paths.dat' index %u using 3:4 with lines lw %s lc '%s' title ",
                    plot->length ? ", \\\n  " : "", set, width, colour);
    jox_quote_gnuplot(plot, name);
    jox_text_printf(plot,
                    ", '' index %u using 3:4 with points pt 7 ps 0.7 lc '%s' notitle, "
                    "'' index %u using 3:4 with points pt 6 ps 1.6 lw 2 lc '%s' notitle",
                    set + 1, colour, set + 2, colour);
}

/* Writes the data sets of all series and appends their plot elements to `plot`. Groups have the
   same colours as in pictures and on the live page. */
static void write_path_data(FILE *data, JoxText *plot, const JoxPaths *paths,
                            const char *const *names, const JoxColour *colours,
                            uint32_t name_count) {
    uint32_t set = 0;
    JoxInk *inks = jox_alloc(name_count + 1, sizeof *inks);
    jox_palette_classes(colours, name_count, inks);
    for (uint32_t s = 0; s <= name_count; s++) { /* the last series is that of bodies */
        bool body = s == name_count;
        char colour[8];
        if (!has_path_series(paths, body ? 0 : s, body))
            continue;
        for (int part = 0; part < 3; part++)
            write_path_series(data, paths, body ? 0 : s, body, part);
        jox_colour_write(jox_palette_colour(inks[s]), colour);
        append_series_plot(plot, set, body ? "#606060" : colour, body ? "1.2 dt 2" : "1.6",
                           body ? "bodies" : names[s]);
        set += 3;
    }
    jox_free(inks);
}

/* Writes paths.csv: a row for each point, by group and id; bodies last. */
static bool write_path_table(const char *folder, const JoxPaths *paths, const char *const *names,
                             uint32_t name_count, JoxText *error) {
    FILE *out = jox_plot_open(folder, "paths.csv", error);
    if (!out)
        return false;
    fputs("group,id,time [s],x [m],y [m]\n", out);
    for (uint32_t s = 0; s <= name_count; s++)
        for (uint32_t p = 0; p < paths->count; p++) {
            const JoxWalkedPath *path = &paths->items[p];
            if (s < name_count ? path->body || path->series != s : !path->body)
                continue;
            for (uint32_t i = 0; i < path->count; i++) {
                jox_quote_put(out, jox_quote_csv, path->body ? "bodies" : names[s]);
                fprintf(out, ",%u,%.2f,%.3f,%.3f\n", path->id, path->points[i].t, path->points[i].x,
                        path->points[i].y);
            }
        }
    return jox_plot_close(out, "paths.csv", error);
}

bool jox_plot_paths(const char *folder, const JoxPaths *paths, const char *const *names,
                    const JoxColour *colours, uint32_t name_count, const JoxWalls *walls, JoxV2 low,
                    JoxV2 high, const char *title, JoxText *error) {
    FILE *data = jox_plot_open(folder, "paths.dat", error), *script;
    JoxText plot = {0};
    if (!data)
        return false;
    write_path_data(data, &plot, paths, names, colours, name_count);
    bool written = jox_plot_close(data, "paths.dat", error) &&
                   write_path_table(folder, paths, names, name_count, error) &&
                   jox_plot_walls(folder, walls, error);
    script = written ? jox_plot_open(folder, "paths.plt", error) : NULL;
    if (script) {
        float tall = jox_clampf((high.y - low.y) / (high.x - low.x), 0.3f, 1.6f);
        jox_plot_begin(script, "paths", false, 1100, (int)(1000.0f * tall) + 140);
        jox_plot_title(script, title);
        fprintf(
            script,
            "set datafile separator comma\nset size ratio -1\nset xlabel 'x (m)'\n"
            "set ylabel 'y (m)'\nset xrange [%g:%g]\nset yrange [%g:%g]\nset key below noenhanced\n"
            "plot %s",
            low.x, high.x, low.y, high.y, plot.length ? plot.data : "NaN notitle");
        jox_plot_wall_lines(script, walls, "2");
    }
    jox_text_free(&plot);
    return script && jox_plot_close(script, "paths.plt", error) &&
           jox_plot_draw(folder, "paths.plt", error);
}
