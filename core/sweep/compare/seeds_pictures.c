/* Draws the pictures of a sweep of one variant: curves over time with bands, and maps. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/format/quote.h"
#include "picture/html.h"
#include "picture/plot.h"
#include "report/maps.h"
#include "sweep/compare/compare.h"

/* ---- curves ---- */

enum { WIDE = 1300, STRIP = 270 };
/* Curves that get a strip of their own if the runs have them. All exits share one strip below. */
static const struct {
    const char *curve, *title, *unit;
} STRIPS[] = {
    {"people inside", "People inside", "people"},
    {"greatest density", "Greatest density anywhere " JOX_DENSITY_BY, "people per m\xc2\xb2"},
    {"mean speed", "Mean speed of all who are inside", "m/s"}};
enum { STRIP_COUNT = sizeof STRIPS / sizeof *STRIPS };
static const char EXIT[] = "left by ";

static const JoxSideCurve *find_drawn_curve(const JoxSide *side, const char *name) {
    for (uint32_t k = 0; k < side->curve_count; k++)
        if (strcmp(side->curves[k].name, name) == 0 && side->curves[k].count > 1)
            return &side->curves[k];
    return NULL;
}

static bool is_exit(const JoxSideCurve *curve) {
    return strncmp(curve->name, EXIT, sizeof EXIT - 1) == 0 && curve->count > 1;
}

/* Writes the data of spread.svg, a block for each curve: time, s, then least, 5 %, median, 95 % and
   greatest value over the runs. */
static bool write_spread_data(const JoxSide *side, const char *folder, JoxText *why) {
    FILE *out = jox_plot_open(folder, "spread.dat", why);
    if (!out)
        return false;
    for (uint32_t k = 0; k < side->curve_count; k++) {
        const JoxSideCurve *c = &side->curves[k];
        JoxText name = {0};
        jox_text_printf(&name, "%s%s%s", c->name, *c->unit ? ", " : "", c->unit);
        fputs("# ", out); /* a comment: control characters would end it */
        for (const char *at = name.data; *at; at++)
            fputc(*at < ' ' ? ' ' : *at, out);
        fputs(": time, least, 5 %, median, 95 %, greatest\n", out);
        jox_text_free(&name);
        for (size_t p = 0; p < c->count; p++)
            fprintf(out, "%.9g %.9g %.9g %.9g %.9g %.9g\n", c->points[p].time, c->points[p].least,
                    c->points[p].low, c->points[p].median, c->points[p].high, c->points[p].most);
        if (c->count == 0)
            fputs("0 NaN NaN NaN NaN NaN\n", out);
        fputs("\n\n", out);
    }
    return jox_plot_close(out, "spread.dat", why);
}

/* Adds the plot of a curve with its bands: all runs, 5 to 95 %, median. */
static void plot_bands(FILE *script, const JoxSide *side, const JoxSideCurve *curve) {
    const unsigned at = (unsigned)(curve - side->curves);
    fprintf(script,
            "plot 'spread.dat' index %u using 1:2:6 with filledcurves lc '#fde3c0' title 'all "
            "runs', '' index %u using 1:3:5 with filledcurves lc '#f8a140' title '5 to 95 %% of "
            "the runs', '' index %u using 1:4 with lines lw 2 lc '#4d0b3b' title 'median'\n",
            at, at, at);
}

/* Adds one plot with the curves of all exits. */
static void plot_exits(FILE *script, const JoxSide *side) {
    static const char *const COLOURS[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                          "#e69f00", "#56b4e9", "#555555", "#000000"};
    uint32_t n = 0;
    fputs("set title 'People who have left by each exit: medians, and 5 to 95 % of the "
          "runs'\nset ylabel 'people'\n",
          script);
    for (uint32_t k = 0; k < side->curve_count; k++) {
        const char *colour = COLOURS[n % (sizeof COLOURS / sizeof *COLOURS)];
        if (!is_exit(&side->curves[k]))
            continue;
        fprintf(script,
                "%s'spread.dat' index %u using 1:3:5 with filledcurves fc rgb '%s' fs transparent "
                "solid 0.25 noborder notitle, '' index %u using 1:4 with lines lw 2 lc '%s' title ",
                n++ ? ", " : "plot ", k, colour, k, colour);
        jox_quote_put(script, jox_quote_gnuplot, side->curves[k].name + sizeof EXIT - 1);
        fputs(" noenhanced", script);
    }
    fputc('\n', script);
}

/* Returns the number of strips of the plot of curves; sets `left` if one shows exits. */
static int count_spread_strips(const JoxSide *side, bool *left) {
    int strips = 0;
    *left = false;
    for (int k = 0; k < STRIP_COUNT; k++)
        strips += find_drawn_curve(side, STRIPS[k].curve) != NULL;
    for (uint32_t k = 0; k < side->curve_count; k++)
        *left |= is_exit(&side->curves[k]);
    return strips + *left;
}

/* Draws spread.svg and PNG, strips below each other; nothing if there are no curves. */
static bool draw_spread(const JoxSide *side, const JoxSideDrawn *drawn, JoxText *why) {
    const char *folder = drawn->subject.folder;
    bool left;
    const int strips = count_spread_strips(side, &left);
    if (strips == 0)
        return true;
    FILE *script = jox_plot_open(folder, "spread.plt", why);
    if (!script)
        return false;
    for (int svg = 0; svg < 2; svg++) {
        jox_plot_begin(script, "spread", svg, WIDE, strips * STRIP);
        fprintf(
            script,
            "set multiplot layout %d,1\nset grid\nset lmargin 10\nset rmargin 29\nset xlabel "
            "'time (s)'\nset xrange [0:%g]\nset yrange [0:0.1<*]\nset key at graph 1.01,1 left top "
            "Left reverse\nset style fill solid 1 noborder\n",
            strips, fmax(drawn->subject.until, 1.0));
        for (int k = 0; k < STRIP_COUNT; k++) {
            const JoxSideCurve *curve = find_drawn_curve(side, STRIPS[k].curve);
            if (!curve)
                continue;
            fprintf(script, "set title '%s'\nset ylabel '%s'\n", STRIPS[k].title, STRIPS[k].unit);
            plot_bands(script, side, curve);
        }
        if (left)
            plot_exits(script, side);
        fputs("unset multiplot\nset output\n", script);
    }
    return jox_plot_close(script, "spread.plt", why) && jox_plot_draw(folder, "spread.plt", why);
}

void jox_seeds_put_curves(FILE *out, const JoxSide *side, const JoxSideDrawn *drawn) {
    bool left;
    jox_html_strips(
        out, drawn->subject.folder, "spread",
        "Over time: the median of the runs, what nine in ten lie between, and all. At "
        "each moment for itself: no run needs to be the median all the time.",
        &(JoxStrips){.count = count_spread_strips(side, &left), .width = WIDE, .height = STRIP});
}

/* ---- maps ---- */

static const struct {
    const char *file, *title, *legend, *caption;
    JoxSideFieldKind kind;
    bool density;
} MAPS[] = {{"density", "Mean density", "people per m\xc2\xb2 " JOX_DENSITY_BY,
             "Mean density " JOX_DENSITY_BY " over time and runs", JOX_FIELD_MEAN, true},
            {"density-greatest", "Greatest, mean of runs", "people per m\xc2\xb2 " JOX_DENSITY_BY,
             "Greatest density " JOX_DENSITY_BY " of all times, mean of the runs",
             JOX_FIELD_GREATEST, true},
            {"density-worst", "Greatest, worst of runs", "people per m\xc2\xb2 " JOX_DENSITY_BY,
             "Greatest density " JOX_DENSITY_BY " of all times and runs", JOX_FIELD_WORST, true},
            {"density-often", "5 per m\xc2\xb2 or more", "% of the runs",
             "Share of the runs, %, in which the density " JOX_DENSITY_BY
             " was 5 per m\xc2\xb2 or more at some time",
             JOX_FIELD_OFTEN, false}};
enum { MAP_COUNT = sizeof MAPS / sizeof *MAPS };

/* Returns whether a map shows anything. */
static bool has_map(const JoxSide *side, const JoxSideDrawn *drawn, int map) {
    return drawn->fields && side->fields[MAPS[map].kind].values &&
           (MAPS[map].density || jox_side_field_max(side, MAPS[map].kind) > 0);
}

bool jox_seeds_draw(const JoxSide *side, const JoxSideDrawn *drawn, JoxText *why) {
    bool good = jox_maps_draw_plan(&drawn->subject, why) &&
                write_spread_data(side, drawn->subject.folder, why) &&
                draw_spread(side, drawn, why);
    char when[48];
    snprintf(when, sizeof when, "0 to %.4g s", drawn->subject.until);
    for (int m = 0; good && m < MAP_COUNT; m++)
        if (has_map(side, drawn, m))
            good = jox_maps_draw_field(
                &drawn->subject,
                &(JoxMapField){.file = MAPS[m].file,
                               .title = MAPS[m].title,
                               .when = when,
                               .legend = MAPS[m].legend,
                               .show = MAPS[m].density ? JOX_SHOW_DENSITY : JOX_SHOW_LOAD,
                               .values = side->fields[MAPS[m].kind].values,
                               .most = MAPS[m].density ? jox_side_field_max(side, JOX_FIELD_WORST)
                                                       : 100.0},
                why);
    return good;
}

void jox_seeds_put_maps(FILE *out, const JoxSide *side, const JoxSideDrawn *drawn) {
    jox_maps_panels(out, &drawn->subject);
    for (int m = 0; m < MAP_COUNT; m++)
        if (has_map(side, drawn, m))
            jox_html_figure(out, drawn->subject.folder, MAPS[m].file, MAPS[m].caption, false);
    jox_html_panels_end(out);
}
