/* Plots of a claim's own figures, beside what its source says. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/format/path.h"
#include "base/format/quote.h"
#include "base/mem.h"
#include "base/sort.h"
#include "picture/plot.h"
#include "validate/reproduce.h"

enum { MOST_CELLS = 40 }; /* of a map along an axis */

void jox_reproduce_plot_name(const JoxClaim *claim, const JoxClaimPlot *plot, char *out,
                             size_t size) {
    const char *file = jox_path_name(claim->path);
    snprintf(out, size, "%.*s-%s", (int)jox_path_stem(file), file, plot->name);
}

/* A number for gnuplot, which knows NaN and no infinity. */
static void put(FILE *out, double value) {
    if (isfinite(value))
        fprintf(out, " %.7g", value);
    else
        fputs(" NaN", out);
}

/* ---- curves ---- */

/* x, then of figures mean, least, most and band, else y; curves parted by two blank lines. */
static void write_curves(const JoxOutcome *outcome, const JoxClaimPlot *plot, FILE *out) {
    for (uint32_t c = 0; c < plot->curve_count; c++) {
        const JoxClaimCurve *curve = &plot->curves[c];
        for (uint32_t p = 0; p < curve->count; p++) {
            const JoxClaimPoint *point = &curve->points[p];
            const JoxVerdict *v = &outcome->verdicts[point->figure];
            const JoxClaimFigure *figure = &outcome->claim->figures[point->figure];
            put(out, point->x);
            if (curve->kind == JOX_CURVE_FIGURES) {
                const double values[] = {v->mean, v->least, v->most, figure->low, figure->high};
                for (size_t k = 0; k < sizeof values / sizeof *values; k++)
                    put(out, values[k]);
            } else {
                put(out, point->y);
            }
            fputc('\n', out);
        }
        fputs("\n\n", out);
    }
}

/* Whether all of a curve's figures have a band with two ends. */
static bool has_band(const JoxClaim *claim, const JoxClaimCurve *curve) {
    bool all = curve->kind == JOX_CURVE_FIGURES;
    for (uint32_t p = 0; all && p < curve->count; p++) {
        const JoxClaimFigure *figure = &claim->figures[curve->points[p].figure];
        all = isfinite(figure->low) && isfinite(figure->high) && !figure->reported;
    }
    return all;
}

static bool same_bands(const JoxClaim *claim, const JoxClaimCurve *a, const JoxClaimCurve *b) {
    bool same = a->count == b->count;
    for (uint32_t p = 0; same && p < a->count; p++) {
        const JoxClaimFigure *f = &claim->figures[a->points[p].figure];
        const JoxClaimFigure *g = &claim->figures[b->points[p].figure];
        same = a->points[p].x == b->points[p].x && f->low == g->low && f->high == g->high;
    }
    return same;
}

static void part(FILE *out, const char *name, bool *first, uint32_t index, const char *how,
                 const char *label) {
    fputs(*first ? "plot " : ", \\\n  ", out);
    jox_plot_file(out, name, "dat");
    fprintf(out, " index %u using %s title ", index, how);
    jox_quote_put(out, jox_quote_gnuplot, label);
    fputs(" noenhanced", out);
    *first = false;
}

static void draw_curves(const JoxClaim *claim, const JoxClaimPlot *plot, const char *name,
                        FILE *out) {
    static const char *const COLOURS[] = {"#3b528b", "#d55e00", "#21918c",
                                          "#9a2c8f", "#5a9a20", "#8a6d00"};
    char how[200];
    bool first = true;
    fputs("set key outside top center horizontal\nset grid\nset offsets graph 0.04, graph 0.04, "
          "graph 0.06, graph 0.06\n",
          out);
    for (uint32_t c = 0; c < plot->curve_count; c++) { /* behind everything else */
        bool drawn = !has_band(claim, &plot->curves[c]);
        for (uint32_t b = 0; b < c && !drawn; b++)
            drawn = has_band(claim, &plot->curves[b]) &&
                    same_bands(claim, &plot->curves[b], &plot->curves[c]);
        if (!drawn)
            part(out, name, &first, c,
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
        part(out, name, &first, c, how, curve->label);
    }
    fputc('\n', out);
}

/* ---- maps ---- */

/* The different values of an axis, in order; at most MOST_CELLS. */
static uint32_t values_of(const JoxClaimCurve *map, bool y, double out[MOST_CELLS]) {
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

static const JoxVerdict *cell(const JoxOutcome *outcome, const JoxClaimCurve *map, double x,
                              double y) {
    for (uint32_t p = 0; p < map->count; p++)
        if (map->points[p].x == x && map->points[p].y == y)
            return &outcome->verdicts[map->points[p].figure];
    return NULL;
}

/* Column, row and value, NaN where there is none. */
static void write_map(const JoxOutcome *outcome, const JoxClaimCurve *map, FILE *out) {
    double x[MOST_CELLS], y[MOST_CELLS];
    uint32_t columns = values_of(map, false, x), rows = values_of(map, true, y);
    for (uint32_t r = 0; r < rows; r++) {
        for (uint32_t c = 0; c < columns; c++) {
            const JoxVerdict *v = cell(outcome, map, x[c], y[r]);
            fprintf(out, "%u %u", c, r);
            put(out, v ? v->mean : NAN);
            fputc('\n', out);
        }
        fputc('\n', out);
    }
}

static void put_ticks(FILE *out, char axis, const double *values, uint32_t count) {
    fprintf(out, "set %ctics (", axis);
    for (uint32_t k = 0; k < count; k++)
        fprintf(out, "%s'%g' %u", k ? ", " : "", values[k], k);
    fprintf(out, ") scale 0\nset %crange [-0.5:%g]\n", axis, count - 0.5);
}

/* Cells of one size, whatever the steps between their values; each says its figure. */
static void draw_map(const JoxOutcome *outcome, const JoxClaimPlot *plot, const char *name,
                     FILE *out) {
    const JoxClaimCurve *map = &plot->curves[0];
    double x[MOST_CELLS], y[MOST_CELLS], least = INFINITY, most = -INFINITY;
    uint32_t columns = values_of(map, false, x), rows = values_of(map, true, y);
    for (uint32_t p = 0; p < map->count; p++) {
        least = fmin(least, outcome->verdicts[map->points[p].figure].mean);
        most = fmax(most, outcome->verdicts[map->points[p].figure].mean);
    }
    put_ticks(out, 'x', x, columns);
    put_ticks(out, 'y', y, rows);
    if (!(least <= most)) { /* nothing was measured */
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

/* ---- all ---- */

static bool draw(const JoxOutcome *outcome, const JoxClaimPlot *plot, const char *folder,
                 JoxText *error) {
    char name[200], file[220];
    bool map = plot->curves[0].kind == JOX_CURVE_MAP;
    jox_reproduce_plot_name(outcome->claim, plot, name, sizeof name);
    snprintf(file, sizeof file, "%s.dat", name);
    FILE *out = jox_plot_open(folder, file, error);
    if (!out)
        return false;
    if (map)
        write_map(outcome, &plot->curves[0], out);
    else
        write_curves(outcome, plot, out);
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
        draw_map(outcome, plot, name, out);
    else
        draw_curves(outcome->claim, plot, name, out);
    return jox_plot_close(out, file, error) && jox_plot_draw(folder, file, error);
}

bool jox_reproduce_plots(const JoxReproduction *all, JoxText *error) {
    JoxText folder = {0};
    jox_text_printf(&folder, "%s/plots", all->def->out);
    bool good = true;
    for (uint32_t o = 0; o < all->outcome_count; o++) {
        const JoxOutcome *outcome = &all->outcomes[o];
        for (uint32_t p = 0; good && !outcome->failure && p < outcome->claim->plot_count; p++)
            good = jox_plot_folder(folder.data, error) &&
                   draw(outcome, &outcome->claim->plots[p], folder.data, error);
    }
    jox_text_free(&folder);
    return good;
}
