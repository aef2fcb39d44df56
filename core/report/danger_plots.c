/* Plots of danger over time, in strips one below the other: greatest values, people over limits,
   flows; people who have left; levels of service. jox_danger_write is the entry point. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/format/quote.h"
#include "picture/palette.h"
#include "picture/plot.h"
#include "report/danger_output_parts.h"

/* Returns whether a measure has a strip: compression only in older recordings, which have it
   instead of load; crowd pressure only if it was measured (the page says so in words). */
static bool has_measure_strip(const JoxDanger *d, int measure) {
    return measure == JOX_DANGER_COMPRESSION ? d->has_compression && !d->has_load
           : measure == JOX_DANGER_LOAD      ? d->has_load
           : measure == JOX_DANGER_DOSE      ? false
                                             : jox_danger_has_measure(d, (JoxDangerMeasure)measure);
}

static bool is_anybody_over_a_limit(const JoxDanger *d) {
    for (int l = 0; l < JOX_DANGER_LIMITS; l++)
        if (d->counts[l].people > 0)
            return true;
    return false;
}

static bool has_flows(const JoxDanger *d) {
    return d->lines.count > 0 && d->row_count > 0;
}

int jox_danger_count_strips(const JoxDanger *d) {
    int count = is_anybody_over_a_limit(d) + has_flows(d);
    for (int m = 0; m < JOX_DANGER_MAPPED; m++)
        count += has_measure_strip(d, m);
    return count;
}

int jox_danger_count_level_strips(const JoxDanger *d) {
    int levels = 0;
    for (int k = 0; k < JOX_LEVELS; k++)
        levels += d->level_s[k] > 0.0;
    return levels < 2 ? 0 : d->areas.count ? 2 : 1;
}

int jox_danger_level_strip_height(const JoxDanger *d) {
    enum {
        ROOM = 90,
        ROW = 17,
        LEAST = 250,
        MOST = 500
    }; /* px: for title and axis, for the name of an area */
    const int height = ROOM + ROW * (int)d->areas.count;
    return height < LEAST ? LEAST : height > MOST ? MOST : height;
}

/* Writes the title of a limit without its kernel, which the strip's title names, for the margin. */
static const char *short_limit_title(int limit, char out[64]) {
    const char *title = jox_danger_limits[limit].title;
    const char *kernel = strstr(title, " (");
    snprintf(out, 64, "%.*s", kernel ? (int)(kernel - title) : 63, title);
    return out;
}

/* Writes the strip of a measure: its greatest value over time, and its limits as labelled lines. */
static void write_measure_strip(const JoxDanger *d, JoxDangerMeasure measure, FILE *script) {
    static const char *const TITLES[JOX_DANGER_MAPPED] = {
        "Greatest density anywhere, by a Gaussian of R = 1 m", "Greatest crowd pressure anywhere",
        "Greatest compression of a person", "Greatest load of a person, from one side"};
    static const char *const UNITS[JOX_DANGER_MAPPED] = {"people per m\xc2\xb2", "per s\xc2\xb2",
                                                         "N/m", "N"};
    double top = 0.0;
    char name[64];
    for (uint32_t r = 0; r < d->row_count; r++)
        top = fmax(top, (double)d->rows[r].most[measure]);
    fprintf(script, "set ylabel '%s'\nunset arrow\nunset label\n", UNITS[measure]);
    jox_strips_set_title(script, TITLES[measure]);
    for (int l = 0; l < JOX_DANGER_LIMITS; l++) {
        double limit = jox_danger_limits[l].value;
        if (jox_danger_limits[l].measure != measure || limit > 2.0 * fmax(top, limit / 2.1))
            continue;
        if (limit > 1.6 * top && l > 0 && jox_danger_limits[l - 1].measure == measure)
            continue; /* far above the curve, which it would flatten */
        fprintf(script,
                "set arrow from graph 0, first %.6g to graph 1, first %.6g nohead lc '#c00000' dt "
                "2\nset label 'limit: %s' at graph 1.01, first %.6g left tc '#c00000' "
                "noenhanced\n",
                limit, limit, short_limit_title(l, name), limit);
        top = fmax(top, limit);
    }
    fprintf(script,
            "set yrange [0:%g]\nplot 'danger.csv' skip 1 using 1:%d with lines lw 2 lc '#0072b2' "
            "notitle\n",
            top > 0.0 ? 1.2 * top : 1.0, 3 + (int)measure);
}

/* Writes the strip of the number of people over each limit that anyone passed. */
static void write_count_strip(const JoxDanger *d, FILE *script) {
    static const char *const COLOURS[] = {"#0072b2", "#e69f00", "#009e73", "#d55e00", "#56b4e9",
                                          "#cc79a7", "#000000", "#999933", "#882255"};
    const char *lead = "plot ";
    char name[64];
    fputs("unset arrow\nunset label\nset yrange [0:*]\nset ylabel 'people'\nset key at graph "
          "1.01,1 left top Left reverse\n",
          script);
    jox_strips_set_title(script,
                         "People over a limit of density (Gaussian R = 1 m, or Voronoi), crowd "
                         "pressure or load");
    for (int l = 0; l < JOX_DANGER_LIMITS; l++)
        if (d->counts[l].people > 0) {
            fprintf(script,
                    "%s'danger.csv' skip 1 using 1:%d with lines lw 2 lc '%s' title '%s' "
                    "noenhanced",
                    lead, 3 + JOX_DANGER_MEASURES + l, COLOURS[l], short_limit_title(l, name));
            lead = ", ";
        }
    fputc('\n', script);
}

static bool has_leavers(const JoxDanger *d) {
    return d->row_count > 0 && d->rows[d->row_count - 1].left > 0;
}

/* Writes the strip of people inside and people who have left, in all and by exit. */
static void write_leaving_strip(const void *danger, FILE *script) {
    const JoxDanger *d = danger;
    const int column = 3 + JOX_DANGER_MEASURES + JOX_DANGER_LIMITS + JOX_LEVELS + 1;
    fputs("set yrange [0:*]\nset ylabel 'people'\nset key at graph 1.01,1 left top Left "
          "reverse\n",
          script);
    jox_strips_set_title(script, "People who have left, and who are inside");
    fputs("plot 'danger.csv' skip 1 using 1:2 with lines lw 2 lc '#999999' dt 2 title 'inside', '' "
          "skip 1 using 1:",
          script);
    fprintf(script, "%d with lines lw 2 lc 'black' title 'left, all'", column);
    for (uint32_t e = 0; e < d->exit_count; e++) {
        fprintf(script, ", '' skip 1 using 1:%d with lines lw 2 title ", column + 1 + (int)e);
        JoxText name = {0};
        jox_text_printf(&name, "by %s", d->exit_names[e]);
        jox_quote_put(script, jox_quote_gnuplot, name.data);
        jox_text_free(&name);
        fputs(" noenhanced", script);
    }
    fputc('\n', script);
}

/* Writes the strip of the flow over each line, and the flow below which dense crowds stop and
   go. */
static void write_flow_strip(const JoxDanger *d, FILE *script) {
    double top = JOX_STOP_FLOW;
    for (uint32_t l = 0; l < d->lines.count; l++)
        top = fmax(top, d->lines.items[l].flow_most);
    jox_strips_set_title(script, "Flow over lines in ten seconds; crosses: stop-and-go");
    fprintf(
        script,
        "unset arrow\nunset label\nset yrange [0:%g]\nset ylabel 'per m and s'\nset key at "
        "graph 1.01,1 left top Left reverse\nset arrow from graph 0, first %g to graph 1, first %g "
        "nohead lc "
        "'#c00000' dt 2\nset label 'limit: stop-and-go, if dense' at graph 0.005, first %g left "
        "offset 0,0.6 "
        "tc '#c00000'\nplot NaN notitle",
        1.2 * top, JOX_STOP_FLOW, JOX_STOP_FLOW, JOX_STOP_FLOW);
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
    fputs("\nunset arrow\nunset label\n", script);
}

/* ---- plots ---- */

/* Writes the strips of danger.plt: measures, people over limits, and flows if there are lines. */
static void write_time_strips(const void *danger, FILE *script) {
    const JoxDanger *d = danger;
    for (int m = 0; m < JOX_DANGER_MAPPED; m++)
        if (has_measure_strip(d, m))
            write_measure_strip(d, (JoxDangerMeasure)m, script);
    if (is_anybody_over_a_limit(d))
        write_count_strip(d, script);
    if (has_flows(d))
        write_flow_strip(d, script);
}

/* Writes the colour of a level of service; A is pale, F dark. */
static void write_level_colour(int level, FILE *script) {
    const JoxInk ink = jox_palette_value(0.04f + 0.96f * (float)level / (JOX_LEVELS - 1));
    fprintf(script, "lc rgb '#%02x%02x%02x'", ink.r, ink.g, ink.b);
}

/* Writes two strips: the number of people at each level, stacked, and the level of each area
   over time. */
static void write_level_strips(const void *danger, FILE *script) {
    const JoxDanger *d = danger;
    const int first = 3 + JOX_DANGER_MEASURES + JOX_DANGER_LIMITS;
    fputs("set yrange [0:*]\nset ylabel 'people'\nset key at graph 1.01,1.05 left top Left reverse "
          "invert maxcols 1 spacing 0.9 font ',10'\nset style fill solid 1 noborder\n",
          script);
    jox_strips_set_title(script, "People at each level of service (A: most room, F: least)");
    fputs("plot ", script);
    /* stacked: the sum of all levels first, smaller sums over it */
    for (int k = JOX_LEVELS - 1; k >= 0; k--) {
        fprintf(script, "%s'danger.csv' skip 1 using 1:(%d", k < JOX_LEVELS - 1 ? ", " : "", 0);
        for (int below = 0; below <= k; below++)
            fprintf(script, "+$%d", first + below);
        fputs(") with filledcurves y1=0 ", script);
        write_level_colour(k, script);
        fprintf(script, " title 'level %s'", jox_levels[k].name);
    }
    fputc('\n', script);
    if (d->areas.count == 0)
        return;
    fprintf(script, "set yrange [%u.5:-0.5]\nunset ylabel\nset key noinvert\nset grid noytics\n",
            d->areas.count - 1);
    jox_strips_set_title(script, "Level of service of each area (blank: nobody is there)");
    fputs("set ytics (", script);
    for (uint32_t a = 0; a < d->areas.count; a++) {
        fputs(a ? ", " : "", script);
        jox_quote_put(script, jox_quote_gnuplot, d->areas.items[a].name);
        fprintf(script, " %u", a);
    }
    fputs(") noenhanced\nplot ", script);
    for (int k = 0; k < JOX_LEVELS; k++) {
        fprintf(script,
                "%s'levels.dat' using ($4 == %d ? $1 : NaN):3:1:2:($3-0.4):($3+0.4) with "
                "boxxyerror ",
                k ? ", " : "", k);
        write_level_colour(k, script);
        fprintf(script, " title 'level %s'", jox_levels[k].name);
    }
    fputc('\n', script);
}

/* Writes levels.dat, the stretches of time that an area is at one level: from (s), until (s),
   index of the area, level. */
static bool write_level_stretches(const JoxDanger *d, const char *folder, JoxText *error) {
    FILE *out = jox_plot_open(folder, "levels.dat", error);
    if (!out)
        return false;
    fputs("NaN,NaN,NaN,NaN\n", out); /* gnuplot needs at least one line */
    for (uint32_t a = 0; a < d->areas.count; a++) {
        const JoxDangerArea *area = &d->areas.items[a];
        for (uint32_t r = 0, end; r < area->row_count; r = end) {
            for (end = r + 1;
                 end < area->row_count && area->rows[end].level == area->rows[r].level;)
                end++;
            const double until = area->rows[end < area->row_count ? end : end - 1].time;
            if (area->rows[r].level >= 0)
                fprintf(out, "%.9g,%.9g,%u,%d\n", area->rows[r].time, until, a,
                        area->rows[r].level);
        }
    }
    return jox_plot_close(out, "levels.dat", error);
}

bool jox_danger_write(const JoxDanger *d, const char *folder, const char *title, JoxText *error) {
    char heading[JOX_STRIP_TITLE];
    if (!jox_danger_write_tables(d, folder, error))
        return false;
    if (!title || d->row_count == 0)
        return true;
    jox_strips_title(title, heading);
    const JoxStripPlot plots[] = {
        {"danger", heading, jox_danger_count_strips(d), JOX_DANGER_STRIP, write_time_strips, d},
        {"leaving", heading, has_leavers(d), JOX_DANGER_STRIP, write_leaving_strip, d},
        {"levels", heading, jox_danger_count_level_strips(d), jox_danger_level_strip_height(d),
         write_level_strips, d},
        {"stairs", heading, jox_danger_count_stair_strips(d), JOX_DANGER_STRIP,
         jox_danger_write_stair_strips, d}};
    bool good = write_level_stretches(d, folder, error);
    for (size_t p = 0; p < sizeof plots / sizeof *plots && good; p++)
        good = jox_danger_draw_strips(d, folder, &plots[p], error);
    return good;
}
