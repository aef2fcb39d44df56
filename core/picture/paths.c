#include "picture/paths.h"

#include <stdio.h>

#include "base/format/quote.h"
#include "base/mem.h"
#include "picture/draw_parts.h"
#include "picture/palette.h"
#include "picture/plot.h"
#include "record/storey_figures.h"

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

/* Writes a point of a path, with a blank line before it where the path goes on in another panel. */
static void write_path_point(FILE *data, const JoxPanels *panels, const JoxWalkedPath *path,
                             uint32_t i, bool first) {
    const JoxPathPoint *point = &path->points[i];
    JoxV2 at = {point->x, point->y};
    if (panels->storeys) {
        const uint32_t panel = jox_draw_panel_of(panels, at);
        if (!first && panel != jox_draw_panel_of(panels, (JoxV2){point[-1].x, point[-1].y}))
            fputs("\n", data);
        at = jox_draw_in_panels(panels, at);
    }
    fprintf(data, "%u,%.2f,%.3f,%.3f\n", path->id, point->t, at.x, at.y);
}

/* Writes the points of all paths of a series as a data set of gnuplot. `part` 0: all points, a
   blank line after each path; 1: first points; 2: last points. */
static void write_path_series(FILE *data, const JoxPaths *paths, const JoxPanels *panels,
                              uint32_t series, bool body, int part) {
    for (uint32_t p = 0; p < paths->count; p++) {
        const JoxWalkedPath *path = &paths->items[p];
        if (path->body != body || path->series != series || path->count == 0)
            continue;
        uint32_t first = part == 2 ? path->count - 1 : 0, last = part == 1 ? 1 : path->count;
        for (uint32_t i = first; i < last; i++)
            write_path_point(data, panels, path, i, i == first);
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
                            const JoxPanels *panels, const char *const *names,
                            const JoxColour *colours, uint32_t name_count) {
    uint32_t set = 0;
    JoxInk *inks = jox_alloc(name_count + 1, sizeof *inks);
    jox_palette_classes(colours, name_count, inks);
    for (uint32_t s = 0; s <= name_count; s++) { /* the last series is that of bodies */
        bool body = s == name_count;
        char colour[8];
        if (!has_path_series(paths, body ? 0 : s, body))
            continue;
        for (int part = 0; part < 3; part++)
            write_path_series(data, paths, panels, body ? 0 : s, body, part);
        jox_colour_write(jox_palette_colour(inks[s]), colour);
        append_series_plot(plot, set, body ? "#606060" : colour, body ? "1.2 dt 2" : "1.6",
                           body ? "bodies" : names[s]);
        set += 3;
    }
    jox_free(inks);
}

/* Writes paths.csv: a row for each point, by group and id; bodies last. */
static bool write_path_table(const char *folder, const JoxPaths *paths, const JoxStoreys *storeys,
                             const char *const *names, uint32_t name_count, JoxText *error) {
    FILE *out = jox_plot_open(folder, "paths.csv", error);
    if (!out)
        return false;
    fputs("group,id,time [s],x [m],y [m]", out);
    jox_csv_put_storey_title(out, storeys);
    fputc('\n', out);
    for (uint32_t s = 0; s <= name_count; s++)
        for (uint32_t p = 0; p < paths->count; p++) {
            const JoxWalkedPath *path = &paths->items[p];
            if (s < name_count ? path->body || path->series != s : !path->body)
                continue;
            for (uint32_t i = 0; i < path->count; i++) {
                const JoxV2 at = {path->points[i].x, path->points[i].y};
                const JoxV2 plan = jox_in_plan(storeys, at);
                jox_quote_put(out, jox_quote_csv, path->body ? "bodies" : names[s]);
                fprintf(out, ",%u,%.2f,%.3f,%.3f", path->id, path->points[i].t, plan.x, plan.y);
                jox_csv_put_storey(out, storeys, at, true);
                fputc('\n', out);
            }
        }
    return jox_plot_close(out, "paths.csv", error);
}

/* Writes the axes: of the area, or without numbers of the panels, with the names of storeys. */
static void write_path_axes(FILE *script, const JoxPanels *panels) {
    fprintf(script, "set xrange [%g:%g]\nset yrange [%g:%g]\n", panels->low.x, panels->high.x,
            panels->low.y, panels->high.y);
    if (!panels->storeys) {
        fputs("set xlabel 'x (m)'\nset ylabel 'y (m)'\n", script);
        return;
    }
    fputs("unset xtics\nunset ytics\n", script);
    for (uint32_t k = 0; k < panels->storeys->storey_count; k++) {
        const JoxV2 at =
            jox_draw_in_panel(panels, k, jox_v2(panels->plan_low.x, panels->plan_high.y));
        fputs("set label ", script);
        jox_quote_put(script, jox_quote_gnuplot, panels->storeys->storeys[k].name);
        fprintf(script, " at %g,%g left offset 0,0.6 noenhanced\n", at.x, at.y);
    }
}

bool jox_plot_paths(const char *folder, const JoxPaths *paths, const char *const *names,
                    const JoxColour *colours, uint32_t name_count, const JoxWalls *walls,
                    const JoxStoreys *storeys, JoxV2 low, JoxV2 high, const char *title,
                    JoxText *error) {
    const JoxPicture shown = {.low = low, .high = high, .storeys = storeys};
    const JoxPanels panels = jox_draw_lay_panels(&shown);
    FILE *data = jox_plot_open(folder, "paths.dat", error), *script;
    JoxText plot = {0};
    if (!data)
        return false;
    write_path_data(data, &plot, paths, &panels, names, colours, name_count);
    bool written = jox_plot_close(data, "paths.dat", error) &&
                   write_path_table(folder, paths, storeys, names, name_count, error) &&
                   jox_plot_walls(folder, walls, &panels, error);
    script = written ? jox_plot_open(folder, "paths.plt", error) : NULL;
    if (script) {
        const JoxV2 size = jox_sub(panels.high, panels.low);
        float tall = jox_clampf(size.y / size.x, 0.3f, 1.6f);
        jox_plot_begin(script, "paths", false, 1100, (int)(1000.0f * tall) + 140);
        jox_plot_title(script, title);
        write_path_axes(script, &panels);
        fprintf(
            script,
            "set datafile separator comma\nset size ratio -1\nset key below noenhanced\nplot %s",
            plot.length ? plot.data : "NaN notitle");
        jox_plot_wall_lines(script, walls, "2");
    }
    jox_text_free(&plot);
    return script && jox_plot_close(script, "paths.plt", error) &&
           jox_plot_draw(folder, "paths.plt", error);
}
