/* Draws curves with bands, and effects with their intervals, by gnuplot. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/format/quote.h"
#include "picture/plot.h"
#include "sweep/compare/compare.h"

/* A palette for colour-blind readers and for print: M. Okabe and K. Ito, 2008. */
static const char *const COLOURS[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                      "#e69f00", "#56b4e9", "#555555", "#000000"};
enum { COLOUR_COUNT = sizeof COLOURS / sizeof *COLOURS };

static void put_data_value(FILE *out, double value) {
    if (isfinite(value))
        fprintf(out, " %.9g", value);
    else
        fputs(" NaN", out);
}

static const JoxSideCurve *find_side_curve(const JoxSide *side, const char *name) {
    for (uint32_t k = 0; k < side->curve_count; k++)
        if (strcmp(side->curves[k].name, name) == 0)
            return &side->curves[k];
    return NULL;
}

static bool has_line(const JoxSideCurve *curve) {
    return curve && curve->count > 1;
}

const JoxSideCurve *jox_compare_curve(const JoxComparison *c, uint32_t n) {
    for (uint32_t s = 0; s < c->sides.count; s++)
        for (uint32_t k = 0; k < c->sides.items[s].curve_count; k++) {
            const JoxSideCurve *curve = &c->sides.items[s].curves[k];
            bool before = false;
            for (uint32_t t = 0; t < s && !before; t++)
                before = has_line(find_side_curve(&c->sides.items[t], curve->name));
            if (!before && has_line(curve) && n-- == 0)
                return curve;
        }
    return NULL;
}

/* Writes the data of curve-N.svg, a block for each side: time, mean, 5 % and 95 %. */
static bool write_comparison_curve(const JoxComparison *c, uint32_t n, JoxText *why) {
    char name[40];
    snprintf(name, sizeof name, "curve-%u.dat", n + 1);
    FILE *out = jox_plot_open(c->def->out, name, why);
    if (!out)
        return false;
    for (uint32_t s = 0; s < c->sides.count; s++) {
        const JoxSideCurve *curve =
            find_side_curve(&c->sides.items[s], jox_compare_curve(c, n)->name);
        for (size_t p = 0; curve && p < curve->count; p++) {
            put_data_value(out, curve->points[p].time);
            put_data_value(out, curve->points[p].mean);
            put_data_value(out, curve->points[p].low);
            put_data_value(out, curve->points[p].high);
            fputc('\n', out);
        }
        if (!curve || curve->count == 0)
            fputs("0 NaN NaN NaN\n", out);
        fputs("\n\n", out);
    }
    return jox_plot_close(out, name, why);
}

/* Adds one plot of a curve's data to a plot command. */
static void add_plot_part(FILE *script, bool *first, uint32_t n, uint32_t s, const char *how) {
    fprintf(script, "%s 'curve-%u.dat' index %u %s", *first ? "plot" : ", \\\n ", n + 1, s, how);
    *first = false;
}

/* Adds the commands of curve-N.svg to the script: bands first, lines over them. */
static void draw_curve(const JoxComparison *c, uint32_t n, FILE *script) {
    const JoxSideCurve *curve = jox_compare_curve(c, n);
    char stem[40], how[160];
    bool first = true;
    JoxText label = {0};
    snprintf(stem, sizeof stem, "curve-%u", n + 1);
    jox_plot_begin(script, stem, true, 760, 460);
    jox_text_printf(&label, "%s%s%s%s", curve->name, *curve->unit ? " (" : "", curve->unit,
                    *curve->unit ? ")" : "");
    fputs("set xlabel 'time (s)'\nset ylabel ", script);
    jox_quote_put(script, jox_quote_gnuplot, label.data);
    fputs(" noenhanced\nset yrange [0:0.1<*]\nset key outside top center horizontal noenhanced\n"
          "set grid lc '#dddddd'\nset border 3\nset tics nomirror\n",
          script);
    jox_text_free(&label);
    for (uint32_t s = 0; s < c->sides.count; s++)
        if (c->sides.items[s].runs > 1) {
            snprintf(how, sizeof how,
                     "using 1:3:4 with filledcurves fc rgb '%s' fs transparent solid 0.16 noborder",
                     COLOURS[s % COLOUR_COUNT]);
            add_plot_part(script, &first, n, s, how);
        }
    for (uint32_t s = 0; s < c->sides.count; s++) {
        snprintf(how, sizeof how, "using 1:2 with lines lw 2.2 dt %u lc '%s' title ",
                 1 + s / COLOUR_COUNT, COLOURS[s % COLOUR_COUNT]);
        add_plot_part(script, &first, n, s, how);
        jox_quote_put(script, jox_quote_gnuplot, c->sides.items[s].name);
    }
    fputs("\n", script);
}

/* ---- effects ---- */

/* Returns whether effects.svg shows a figure of a side: key figures with an interval and a base
   that is not 0. */
static bool is_drawn(const JoxComparison *c, uint32_t f, uint32_t s) {
    const JoxCompared *figure = &c->figures[f];
    const JoxDifference *d = &figure->sides[s];
    return s != c->base && figure->words.is_key && figure->varies && isfinite(d->effect.low) &&
           fabs(d->base.mean) > 0;
}

static bool is_row(const JoxComparison *c, uint32_t f) {
    for (uint32_t s = 0; s < c->sides.count; s++)
        if (is_drawn(c, f, s))
            return true;
    return false;
}

uint32_t jox_compare_count_effect_rows(const JoxComparison *c) {
    uint32_t rows = 0;
    for (uint32_t f = 0; f < c->count; f++)
        rows += is_row(c, f);
    return rows;
}

/* Returns half the range of the plot, %. Changes above 100 % are not plotted; they are labelled
   with numbers instead. */
static double get_effect_range(const JoxComparison *c) {
    double most = 0;
    for (uint32_t f = 0; f < c->count; f++)
        for (uint32_t s = 0; s < c->sides.count; s++)
            if (is_drawn(c, f, s)) {
                const JoxDifference *d = &c->figures[f].sides[s];
                const double change = 100 * fabs(d->effect.difference / d->base.mean);
                most = change <= 100 ? fmax(most, change) : most;
            }
    return fmax(10, 1.4 * most);
}

/* Writes the data of effects.svg: row, change in % of the base's mean, and its interval. */
static bool write_effects(const JoxComparison *c, JoxText *why) {
    const double most = get_effect_range(c);
    const uint32_t rows = jox_compare_count_effect_rows(c), others = c->sides.count - 1;
    FILE *out = jox_plot_open(c->def->out, "effects.dat", why);
    if (!out)
        return false;
    for (uint32_t s = 0, place = 0; s < c->sides.count; s++) {
        if (s == c->base)
            continue;
        uint32_t row = 0;
        for (uint32_t f = 0; f < c->count; f++) {
            if (!is_row(c, f))
                continue;
            row++;
            if (!is_drawn(c, f, s))
                continue;
            const JoxDifference *d = &c->figures[f].sides[s];
            const double part = 100 / fabs(d->base.mean);
            if (part * fabs(d->effect.difference) > most)
                continue;
            put_data_value(out, rows - row + 0.3 - 0.6 * (place + 0.5) / others);
            put_data_value(out, part * d->effect.difference);
            put_data_value(out, part * d->effect.low);
            put_data_value(out, part * d->effect.high);
            fputc('\n', out);
        }
        place++;
        fputs("0 NaN NaN NaN\n\n\n", out);
    }
    return jox_plot_close(out, "effects.dat", why);
}

/* Labels the changes that are outside the range with their numbers, at the edge of the plot. */
static void label_cut_effects(const JoxComparison *c, FILE *script) {
    const uint32_t rows = jox_compare_count_effect_rows(c), others = c->sides.count - 1;
    uint32_t row = 0;
    for (uint32_t f = 0; f < c->count; f++) {
        if (!is_row(c, f))
            continue;
        row++;
        for (uint32_t s = 0, place = 0; s < c->sides.count; s++) {
            const JoxDifference *d = &c->figures[f].sides[s];
            const double change = 100 * d->effect.difference / fabs(d->base.mean);
            if (s == c->base)
                continue;
            if (is_drawn(c, f, s) && fabs(change) > get_effect_range(c))
                fprintf(
                    script,
                    "set label '%+.0f %% (%+.0f to %+.0f)' at graph %s, first %.3f %s tc '%s'\n",
                    change, 100 * d->effect.low / fabs(d->base.mean),
                    100 * d->effect.high / fabs(d->base.mean), change > 0 ? "0.995" : "0.005",
                    rows - row + 0.3 - 0.6 * (place + 0.5) / others, change > 0 ? "right" : "left",
                    COLOURS[s % COLOUR_COUNT]);
            place++;
        }
    }
}

/* Writes a label of an axis; gnuplot takes labels as formats of numbers. */
static void put_tic(FILE *script, const char *text) {
    JoxText label = {0};
    for (; *text; text++)
        jox_text_append(&label, *text == '%' ? "%%" : text, *text == '%' ? 2 : 1);
    jox_quote_put(script, jox_quote_gnuplot, label.data);
    jox_text_free(&label);
}

/* Adds the commands of effects.svg to the script: a row for each figure, a colour for each side. */
static void draw_effects(const JoxComparison *c, FILE *script) {
    const uint32_t rows = jox_compare_count_effect_rows(c);
    const uint32_t each = 22 + 9 * (c->sides.count - 2);
    jox_plot_begin(script, "effects", true, 1100, (int)(110 + rows * (each < 120 ? each : 120)));
    fputs("set xlabel ", script);
    JoxText label = {0};
    jox_text_printf(&label, "change against %s, %%", c->sides.items[c->base].name);
    jox_quote_put(script, jox_quote_gnuplot, label.data);
    jox_text_free(&label);
    fprintf(script,
            " noenhanced\nset xrange [%.4g:%.4g]\nset yrange [-0.7:%u.7]\nset key outside top "
            "center horizontal "
            "noenhanced\nset grid xtics lc '#dddddd'\nset border 1\nset tics nomirror\n"
            "set ytics scale 0 noenhanced (",
            -get_effect_range(c), get_effect_range(c), rows - 1);
    for (uint32_t f = 0, row = 0; f < c->count; f++)
        if (is_row(c, f)) {
            row++;
            fputs(row > 1 ? ", " : "", script);
            put_tic(script, c->figures[f].words.text);
            fprintf(script, " %u", rows - row);
        }
    fputs(")\nset arrow from 0, graph 0 to 0, graph 1 nohead lc '#333333' lw 1 back\n", script);
    label_cut_effects(c, script);
    for (uint32_t s = 0, place = 0; s < c->sides.count; s++) {
        if (s == c->base)
            continue;
        fprintf(script,
                "%s 'effects.dat' index %u using 2:1:3:4 with xerrorbars pt 7 ps 0.7 lw 2 lc '%s' "
                "title ",
                place ? ", \\\n " : "plot", place, COLOURS[s % COLOUR_COUNT]);
        jox_quote_put(script, jox_quote_gnuplot, c->sides.items[s].name);
        place++;
    }
    fputs("\n", script);
}

bool jox_compare_draw_plots(const JoxComparison *c, JoxText *why) {
    uint32_t n = 0;
    bool good = true;
    for (; good && n < JOX_COMPARE_CURVES && jox_compare_curve(c, n); n++)
        good = write_comparison_curve(c, n, why);
    const bool effects = jox_compare_count_effect_rows(c) > 0;
    good = good && (!effects || write_effects(c, why));
    FILE *script = good && (n || effects) ? jox_plot_open(c->def->out, "compare.plt", why) : NULL;
    if (!script)
        return good && !n && !effects;
    for (uint32_t k = 0; k < n; k++)
        draw_curve(c, k, script);
    if (effects)
        draw_effects(c, script);
    return jox_plot_close(script, "compare.plt", why) &&
           jox_plot_draw(c->def->out, "compare.plt", why);
}
