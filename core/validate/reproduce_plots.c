/* Draws the plots of claims with gnuplot: figures as measured beside what their sources say. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/format/path.h"
#include "base/format/quote.h"
#include "base/mem.h"
#include "base/sort.h"
#include "picture/plot.h"
#include "validate/reproduce.h"

enum { MOST_CELLS = 40 }; /* cells of a map along one axis */

void jox_reproduce_plot_name(const JoxClaim *claim, const JoxClaimPlot *plot, char *out,
                             size_t size) {
    const char *file = jox_path_name(claim->path);
    snprintf(out, size, "%.*s-%s", (int)jox_path_stem(file), file, plot->name);
}

/* Writes a number for gnuplot; infinity becomes NaN, as gnuplot does not know it. */
static void put_plot_number(FILE *out, double value) {
    if (isfinite(value))
        fprintf(out, " %.7g", value);
    else
        fputs(" NaN", out);
}

/* ---- curves ---- */

/* Writes the data of all curves, separated by two blank lines: per point x, and for figures
   mean, least, greatest and band, else y. */
static void write_claim_curves(const JoxOutcome *outcome, const JoxClaimPlot *plot, FILE *out) {
    for (uint32_t c = 0; c < plot->curve_count; c++) {
        const JoxClaimCurve *curve = &plot->curves[c];
        for (uint32_t p = 0; p < curve->count; p++) {
            const JoxClaimPoint *point = &curve->points[p];
            const JoxVerdict *v = &outcome->own.verdicts[point->figure];
            const JoxClaimFigure *figure = &outcome->claim->figures[point->figure];
            put_plot_number(out, point->x);
            if (curve->kind == JOX_CURVE_FIGURES) {
                const double values[] = {v->mean, v->least, v->most, figure->low, figure->high};
                for (size_t k = 0; k < sizeof values / sizeof *values; k++)
                    put_plot_number(out, values[k]);
            } else {
                put_plot_number(out, point->y);
            }
            fputc('\n', out);
        }
        fputs("\n\n", out);
    }
}

/* Returns whether all figures of a curve have a band with two ends. */
static bool has_band(const JoxClaim *claim, const JoxClaimCurve *curve) {
    bool all = curve->kind == JOX_CURVE_FIGURES;
    for (uint32_t p = 0; all && p < curve->count; p++) {
        const JoxClaimFigure *figure = &claim->figures[curve->points[p].figure];
        all = isfinite(figure->low) && isfinite(figure->high) && !figure->reported;
    }
    return all;
}

/* Returns whether two curves have the same points x and bands. */
static bool has_same_band(const JoxClaim *claim, const JoxClaimCurve *a, const JoxClaimCurve *b) {
    bool same = a->count == b->count;
    for (uint32_t p = 0; same && p < a->count; p++) {
        const JoxClaimFigure *f = &claim->figures[a->points[p].figure];
        const JoxClaimFigure *g = &claim->figures[b->points[p].figure];
        same = a->points[p].x == b->points[p].x && f->low == g->low && f->high == g->high;
    }
    return same;
}

/* Adds an element to the plot command: a data set, drawn as `how` says, with a label. */
static void add_plot_element(FILE *out, const char *name, bool *first, uint32_t index,
                             const char *how, const char *label) {
    fputs(*first ? "plot " : ", \\\n  ", out);
    jox_plot_file(out, name, "dat");
    fprintf(out, " index %u using %s title ", index, how);
    jox_quote_put(out, jox_quote_gnuplot, label);
    fputs(" noenhanced", out);
    *first = false;
}

/* Writes the commands that draw the curves of a plot, with their bands behind them. */
static void write_curve_plot(const JoxClaim *claim, const JoxClaimPlot *plot, const char *name,
                             FILE *out) {
    static const char *const COLOURS[] = {"#3b528b", "#d55e00", "#21918c",
                                          "#9a2c8f", "#5a9a20", "#8a6d00"};
    char how[200];
    bool first = true;
    fputs("set key outside top center horizontal\nset grid\nset offsets graph 0.04, graph 0.04, "
          "graph 0.06, graph 0.06\n",
          out);
    /* bands first, so that they are behind the curves; equal bands once */
    for (uint32_t c = 0; c < plot->curve_count; c++) {
        bool drawn = !has_band(claim, &plot->curves[c]);
        for (uint32_t b = 0; b < c && !drawn; b++)
            drawn = has_band(claim, &plot->curves[b]) &&
                    has_same_band(claim, &plot->curves[b], &plot->curves[c]);
        if (!drawn)
            add_plot_element(
                out, name, &first, c,
                "1:5:6 with filledcurves fillcolor rgb '#777777' fillstyle transparent solid 0.2",
                "band");
    }
    for (uint32_t c = 0; c < plot->curve_count; c++) {
        const JoxClaimCurve *curve = &plot->curves[c];
        const char *colour = COLOURS[c % 6];
        if (curve->kind == JOX_CURVE_FIGURES)
            snprintf(how, sizeof how, "1:2:3:4 with yerrorlines lw 2 pt 7 ps 0.9 lc '%s'", colour);
        else if (curve->kind == JOX_CURVE_POINTS)
            snprintf(how, sizeof how, "1:2 with points lw 2 pt 6 ps 1.6 lc '%s'", colour);
        else
            snprintf(how, sizeof how, "1:2 with lines lw 2 dt 2 lc '%s'", colour);
        add_plot_element(out, name, &first, c, how, curve->label);
    }
    fputc('\n', out);
}

/* ---- maps ---- */

/* Lists the different values of an axis in ascending order, at most MOST_CELLS, and returns
   their number. */
static uint32_t list_axis_values(const JoxClaimCurve *map, bool y, double out[MOST_CELLS]) {
    uint32_t n = 0;
    double *all = jox_alloc(map->count, sizeof *all);
    for (uint32_t p = 0; p < map->count; p++)
        all[p] = y ? map->points[p].y : map->points[p].x;
    jox_sort_doubles(all, map->count);
    for (uint32_t p = 0; p < map->count; p++)
        if ((n == 0 || all[p] > out[n - 1]) && n < MOST_CELLS)
            out[n++] = all[p];
    jox_free(all);
    return n;
}

/* Returns the verdict on a map's figure at x, y; NULL if there is none. */
static const JoxVerdict *find_cell_verdict(const JoxOutcome *outcome, const JoxClaimCurve *map,
                                           double x, double y) {
    for (uint32_t p = 0; p < map->count; p++)
        if (map->points[p].x == x && map->points[p].y == y)
            return &outcome->own.verdicts[map->points[p].figure];
    return NULL;
}

/* Writes a map's data: column, row and value; NaN where there is none. */
static void write_map_data(const JoxOutcome *outcome, const JoxClaimCurve *map, FILE *out) {
    double x[MOST_CELLS], y[MOST_CELLS];
    uint32_t columns = list_axis_values(map, false, x), rows = list_axis_values(map, true, y);
    for (uint32_t r = 0; r < rows; r++) {
        for (uint32_t c = 0; c < columns; c++) {
            const JoxVerdict *v = find_cell_verdict(outcome, map, x[c], y[r]);
            fprintf(out, "%u %u", c, r);
            put_plot_number(out, v ? v->mean : NAN);
            fputc('\n', out);
        }
        fputc('\n', out);
    }
}

/* Writes an axis with one labelled tick per cell. */
static void put_ticks(FILE *out, char axis, const double *values, uint32_t count) {
    fprintf(out, "set %ctics (", axis);
    for (uint32_t k = 0; k < count; k++)
        fprintf(out, "%s'%g' %u", k ? ", " : "", values[k], k);
    fprintf(out, ") scale 0\nset %crange [-0.5:%g]\n", axis, count - 0.5);
}

/* Writes a map's plot: cells of equal size whatever the steps of the axes, each labelled with
   its value. */
static void write_map_plot(const JoxOutcome *outcome, const JoxClaimPlot *plot, const char *name,
                           FILE *out) {
    const JoxClaimCurve *map = &plot->curves[0];
    double x[MOST_CELLS], y[MOST_CELLS], least = INFINITY, most = -INFINITY;
    uint32_t columns = list_axis_values(map, false, x), rows = list_axis_values(map, true, y);
    for (uint32_t p = 0; p < map->count; p++) {
        least = fmin(least, outcome->own.verdicts[map->points[p].figure].mean);
        most = fmax(most, outcome->own.verdicts[map->points[p].figure].mean);
    }
    put_ticks(out, 'x', x, columns);
    put_ticks(out, 'y', y, rows);
    if (!(least <= most)) { /* no value is finite */
        fputs("set label 1 'not measured' at graph 0.5,0.5 center\nplot NaN notitle\n", out);
        return;
    }
    fputs("set palette defined (0 '#ffffff', 1 '#f0a050')\nset cblabel ", out);
    jox_quote_put(out, jox_quote_gnuplot, plot->z);
    fprintf(out, " noenhanced\nset cbrange [%g:%g]\nunset key\nplot ", fmin(least, 0.0),
            most > fmin(least, 0.0) ? most : fmin(least, 0.0) + 1.0);
    jox_plot_file(out, name, "dat");
    fputs(
        " using 1:2:3 with image, '' using 1:2:($3 == $3 ? sprintf('%.3g', $3) : '-') with labels "
        "font ',14'\n",
        out);
}

/* ---- all plots ---- */

/* Writes the data file and script of a plot and draws it. */
static bool draw_claim_plot(const JoxOutcome *outcome, const JoxClaimPlot *plot, const char *folder,
                            JoxText *error) {
    char name[200], file[220];
    bool map = plot->curves[0].kind == JOX_CURVE_MAP;
    jox_reproduce_plot_name(outcome->claim, plot, name, sizeof name);
    snprintf(file, sizeof file, "%s.dat", name);
    FILE *out = jox_plot_open(folder, file, error);
    if (!out)
        return false;
    if (map)
        write_map_data(outcome, &plot->curves[0], out);
    else
        write_claim_curves(outcome, plot, out);
    if (!jox_plot_close(out, file, error))
        return false;
    snprintf(file, sizeof file, "%s.plt", name);
    if (!(out = jox_plot_open(folder, file, error)))
        return false;
    jox_plot_begin(out, name, false, 900, 640);
    jox_plot_title(out, plot->title);
    fputs("set xlabel ", out);
    jox_quote_put(out, jox_quote_gnuplot, plot->x);
    fputs(" noenhanced\nset ylabel ", out);
    jox_quote_put(out, jox_quote_gnuplot, plot->y);
    fputs(" noenhanced\n", out);
    if (map)
        write_map_plot(outcome, plot, name, out);
    else
        write_curve_plot(outcome->claim, plot, name, out);
    return jox_plot_close(out, file, error) && jox_plot_draw(folder, file, error);
}

bool jox_reproduce_draw_plots(const JoxReproduction *all, JoxText *error) {
    JoxText folder = {0};
    jox_text_printf(&folder, "%s/plots", all->def->out);
    bool good = true;
    for (uint32_t o = 0; o < all->outcome_count; o++) {
        const JoxOutcome *outcome = &all->outcomes[o];
        for (uint32_t p = 0; good && !outcome->own.failure && p < outcome->claim->plot_count; p++)
            good = jox_plot_folder(folder.data, error) &&
                   draw_claim_plot(outcome, &outcome->claim->plots[p], folder.data, error);
    }
    jox_text_free(&folder);
    return good;
}
