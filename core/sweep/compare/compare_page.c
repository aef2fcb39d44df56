/* Writes index.html of a comparison of several sides, or of recordings. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "picture/html.h"
#include "picture/plot.h"
#include "record/fields/density.h"
#include "sweep/compare/compare.h"

/* Writes a mean; from 1000 on without decimals, which would need powers of ten. */
static void put_mean(FILE *out, double value, const char *unit) {
    jox_html_cell_number(out, fabs(value) >= 1000 ? round(value) : value, unit);
}

/* ---- in sentences ---- */

/* Returns whether a figure is in the summary and in the table of percentiles. */
static bool is_summarised(const JoxCompared *f) {
    return f->varies && f->words.is_key;
}

/* Appends a number with three digits, or all before the point; with `sign`, also "+". */
static void add_number(JoxText *out, double value, bool sign) {
    if ((value == floor(value) || fabs(value) >= 100) && fabs(value) < 1e9)
        jox_text_printf(out, sign ? "%+.0f" : "%.0f", value);
    else
        jox_text_printf(out, sign ? "%+.3g" : "%.3g", value);
}

/* "greatest density: 4.1 instead of 5.2 1/m2 (-1.1, from -1.6 to -0.6)" */
static void add_finding(const JoxCompared *figure, uint32_t s, JoxText *out) {
    const JoxDifference *d = &figure->sides[s];
    jox_text_printf(out, "%s%s: ", out->length ? "; " : "", figure->words.text);
    add_number(out, d->other.mean, false);
    jox_text_add(out, " instead of ");
    add_number(out, d->base.mean, false);
    jox_text_printf(out, "%s%s (", *figure->words.unit ? " " : "",
                    jox_figure_unit(figure->words.unit));
    add_number(out, d->effect.difference, true);
    jox_text_add(out, ", from ");
    add_number(out, d->effect.low, true);
    jox_text_add(out, " to ");
    add_number(out, d->effect.high, true);
    jox_text_add(out, ")");
}

static void put_item(FILE *out, JoxText *text) {
    fputs("<li>", out);
    jox_html_text(out, text->data);
    fputs("\n", out);
    jox_text_free(text);
}

/* Lists the key figures in which a side differs from the base, and those that need more runs. */
static void put_findings(FILE *out, const JoxComparison *c, uint32_t s) {
    enum { MOST = 8 };
    const bool has_spread = c->sides.items[s].runs > 1 && c->sides.items[c->base].runs > 1;
    JoxText thin = {0};
    uint32_t count = 0;
    jox_html_statement(
        out, c->sides.items[s].name,
        has_spread ? ""
        : c->sides.items[s].runs == 0
            ? "None of its runs has figures; the reasons are below."
            : "Two runs of each side are needed to tell how certain a difference is.");
    fputs("<ul>\n", out);
    for (uint32_t f = 0; f < c->count; f++) {
        const JoxCompared *figure = &c->figures[f];
        const JoxDifference *d = &figure->sides[s];
        const char *verdict = jox_compare_verdict(d);
        JoxText text = {0};
        if (!is_summarised(figure))
            continue;
        if (!strcmp(verdict, "differs") && count++ < MOST) {
            add_finding(figure, s, &text);
            put_item(out, &text);
        } else if (!strcmp(verdict, "not told apart") && d->effect.difference != 0) {
            jox_text_printf(&thin, "%s%s", thin.length ? "; " : "", figure->words.text);
            if (d->runs)
                jox_text_printf(&thin, " (about %zu)", d->runs);
        }
    }
    JoxText text = {0};
    if (count == 0 && has_spread)
        jox_text_add(&text, "no key figure is told apart from the base");
    else if (count > MOST)
        jox_text_printf(&text, "and %u more, in the table", count - MOST);
    if (text.length)
        put_item(out, &text);
    if (thin.length) {
        jox_text_printf(&text,
                        "too few runs to tell these apart (in brackets, the runs of each side that "
                        "it would take): %s",
                        thin.data);
        put_item(out, &text);
    }
    fputs("</ul>\n", out);
    jox_text_free(&thin);
}

static void put_comparison_summary(FILE *out, const JoxComparison *c) {
    JoxText text = {0};
    jox_html_heading(out, "Summary");
    fputs("<div class=summary>\n", out);
    jox_text_printf(
        &text,
        "%s. Figures are means of the runs; in brackets, the difference and its %.0f %% interval.",
        c->sides.items[c->base].name, 100 * c->def->share);
    jox_html_statement(out, "All are compared with", text.data);
    for (uint32_t s = 0; s < c->sides.count; s++)
        if (s != c->base)
            put_findings(out, c, s);
    fputs("</div>\n", out);
    jox_text_free(&text);
}

/* ---- sides ---- */

/* Says how many runs of each side are left out, and why the first one is. */
static void put_left_out_runs(FILE *out, const JoxComparison *c) {
    bool begun = false;
    for (uint32_t s = 0; s < c->sides.count; s++) {
        const JoxSide *side = &c->sides.items[s];
        uint32_t r = 0;
        while (r < side->all_count && side->all[r].state == JOX_SWEEP_DONE)
            r++;
        if (r == side->all_count)
            continue;
        if (!begun)
            jox_html_paragraph(out, "Runs that failed or did not go as written are left out; the "
                                    "means are those of the other runs.");
        begun = true;
        JoxText text = {0};
        jox_text_printf(&text, "%s, %u of %u runs: seed %llu, %s", side->name, side->left_out,
                        side->all_count, (unsigned long long)side->all[r].seed,
                        side->all[r].reason);
        jox_html_paragraph(out, text.data);
        jox_text_free(&text);
    }
}

static void put_sides_table(FILE *out, const JoxComparison *c) {
    jox_html_heading(out, "What is compared");
    jox_html_table(out, "side|settings|>runs|seeds|>left out|from");
    for (uint32_t s = 0; s < c->sides.count; s++) {
        const JoxSide *side = &c->sides.items[s];
        char seeds[64] = "";
        if (side->recorded)
            snprintf(seeds, sizeof seeds, side->runs == 1 ? "a recording" : "recordings");
        else if (side->runs)
            snprintf(seeds, sizeof seeds, "%llu to %llu", (unsigned long long)side->seeds[0],
                     (unsigned long long)side->seeds[side->runs - 1]);
        jox_html_row(out);
        jox_html_cell(out, side->name);
        JoxText settings = {0};
        for (const char *at = side->settings ? side->settings : ""; *at; at++)
            jox_text_append(&settings, *at == '\n' ? ", " : at, *at == '\n' ? 2 : 1);
        jox_html_cell(out, settings.data ? settings.data : "");
        jox_text_free(&settings);
        jox_html_cell_number(out, side->runs, "");
        jox_html_cell(out, seeds);
        jox_html_cell_number(out, side->left_out, "");
        jox_html_cell(out, side->source);
    }
    jox_html_table_end(out);
    put_left_out_runs(out, c);
}

/* ---- figures ---- */

/* Writes a cell with the verdict; if the sides are not told apart, also with the number of runs
   needed. */
static void put_verdict_cell(FILE *out, const JoxDifference *d) {
    const char *verdict = jox_compare_verdict(d);
    char text[160];
    snprintf(text, sizeof text, "%s%s", verdict, d->adjusted ? " *" : "");
    if (!strcmp(verdict, "not told apart") && d->runs)
        snprintf(text, sizeof text, "%s; %zu %s would", verdict, d->runs,
                 d->effect.pairs ? "seeds" : "runs of each");
    fputs(strcmp(verdict, "differs") == 0 ? "<td><b>" : "<td>", out);
    jox_html_text(out, text);
    fputs(strcmp(verdict, "differs") == 0 ? "</b>" : "", out);
}

/* Writes a row for each side that has the figure, except the base. */
static void put_figure_rows(FILE *out, const JoxComparison *c, const JoxCompared *figure) {
    bool first = true;
    for (uint32_t s = 0; s < c->sides.count; s++) {
        const JoxDifference *d = &figure->sides[s];
        if (s == c->base || (!d->base.count && !d->other.count))
            continue;
        JoxText interval = {0};
        jox_html_row(out);
        jox_html_cell(out, first ? figure->words.text : "");
        if (c->sides.count > 2)
            jox_html_cell(out, c->sides.items[s].name);
        put_mean(out, d->base.mean, figure->words.unit);
        put_mean(out, d->other.mean, figure->words.unit);
        if (isfinite(d->effect.difference)) {
            add_number(&interval, d->effect.difference, true);
            if (isfinite(d->base.mean) && d->base.mean != 0)
                jox_text_printf(&interval, " (%+.3g %%)",
                                100 * d->effect.difference / fabs(d->base.mean));
        }
        fputs("<td class=n>", out);
        jox_html_text(out, interval.length ? interval.data : "\xe2\x80\x93");
        interval.length = 0;
        if (isfinite(d->effect.low)) {
            add_number(&interval, d->effect.low, true);
            jox_text_add(&interval, " to ");
            add_number(&interval, d->effect.high, true);
        }
        fputs("<td class=n>", out);
        jox_html_text(out, interval.length ? interval.data : "\xe2\x80\x93");
        put_verdict_cell(out, d);
        if (d->effect.a == d->effect.b)
            jox_html_cell_number(out, (double)d->effect.a, "");
        else {
            fputs("<td class=n>", out);
            fprintf(out, "%zu, %zu", d->effect.a, d->effect.b);
        }
        jox_text_free(&interval);
        first = false;
    }
}

/* Writes the table of all key figures that vary, or of all others. */
static void put_figures_table(FILE *out, const JoxComparison *c, bool keys) {
    const JoxSide *base = &c->sides.items[c->base];
    const bool two = c->sides.count == 2;
    char heads[400];
    snprintf(heads, sizeof heads,
             "figure%s|>%.80s|>%.80s|>difference|>%.0f %% interval|which says|>runs",
             two ? "" : "|side", base->name, two ? c->sides.items[!c->base].name : "this side",
             100 * c->def->share);
    jox_html_table(out, heads);
    for (uint32_t f = 0; f < c->count; f++)
        if (c->figures[f].varies && c->figures[f].words.is_key == keys)
            put_figure_rows(out, c, &c->figures[f]);
    jox_html_table_end(out);
}

static void put_methods_paragraph(FILE *out, const JoxComparison *c) {
    char method[200];
    JoxText text = {0};
    for (uint32_t s = 0; s < c->sides.count; s++) {
        if (s == c->base || c->count == 0)
            continue;
        uint32_t most = 0;
        for (uint32_t f = 0; f < c->count; f++)
            if (c->figures[f].sides[s].effect.b > c->figures[most].sides[s].effect.b)
                most = f;
        jox_compare_describe_method(c, &c->figures[most].sides[s], method, sizeof method);
        jox_text_printf(&text, "Intervals of %s: %s. ", c->sides.items[s].name, method);
    }
    jox_text_printf(
        &text,
        "An interval contains the true difference with a probability of %.0f %%; if it contains 0, "
        "the runs do not tell the sides apart. The number of runs that would is that with which an "
        "effect of the size seen is detected with a probability of 80 %%. Figures may also differ "
        "by chance: of %u figures compared, about one in %.0f does. Those with * still differ "
        "after Holm's correction for the number of figures.%s",
        100 * c->def->share, c->tested, 1 / (1 - c->def->share),
        jox_compare_is_thin(c) ? " With fewer than five runs the spread itself is uncertain, and "
                                 "so is the number of runs needed."
                               : "");
    jox_html_paragraph(out, text.data);
    jox_text_free(&text);
}

/* ---- percentiles ---- */

void jox_compare_put_percentiles(FILE *out, const JoxComparison *c) {
    const double q = c->def->percentile / 100;
    char heads[200];
    JoxText text = {0};
    snprintf(heads, sizeof heads, "%.4g %% values and worst cases", c->def->percentile);
    jox_html_heading(out, heads);
    snprintf(heads, sizeof heads, "figure|side|>above %.4g %% of all|>worst|>bound|>runs",
             c->def->percentile);
    jox_html_table(out, heads);
    for (uint32_t f = 0; f < c->count; f++) {
        const JoxCompared *figure = &c->figures[f];
        bool first = true;
        for (uint32_t s = 0;
             is_summarised(figure) && !figure->words.low_is_worse && s < c->sides.count; s++) {
            size_t count;
            double *values = jox_side_sorted_values(&c->sides.items[s], figure->figure, &count);
            const size_t above = jox_rank_above(count, q);
            const size_t bound = jox_rank_bound(count, q, c->def->share);
            if (count) {
                jox_html_row(out);
                jox_html_cell(out, first ? figure->words.text : "");
                jox_html_cell(out, c->sides.items[s].name);
                put_mean(out, above ? values[above - 1] : NAN, figure->words.unit);
                put_mean(out, values[count - 1], figure->words.unit);
                put_mean(out, bound ? values[bound - 1] : NAN, figure->words.unit);
                jox_html_cell_number(out, (double)count, "");
                first = false;
            }
            jox_free(values);
        }
    }
    jox_html_table_end(out);
    jox_text_printf(
        &text,
        "The first column follows MSC.1/Circ.1533: of all values ranked from the lowest, the one "
        "that %.4g %% of them are below. The bound lies above the true %.4g %% value with a "
        "probability of %.0f %%, whatever the distribution (Wilks 1941), which takes %zu runs; a "
        "dash means that there are too few. The circular asks for 50 runs or more of each case.",
        c->def->percentile, c->def->percentile, 100 * c->def->share,
        jox_rank_runs(q, c->def->share));
    jox_html_paragraph(out, text.data);
    jox_text_free(&text);
}

/* ---- pictures ---- */

static void put_comparison_pictures(FILE *out, const JoxComparison *c) {
    jox_html_heading(out, "Over time");
    jox_html_paragraph(
        out, "Lines are means of the runs; nine runs in ten are within the bands, from 5 to 95 %.");
    jox_html_panels(out, false);
    for (uint32_t n = 0; n < JOX_COMPARE_CURVES && jox_compare_curve(c, n); n++) {
        char name[40];
        snprintf(name, sizeof name, "curve-%u", n + 1);
        jox_html_figure(out, c->def->out, name, jox_compare_curve(c, n)->name, false);
    }
    jox_html_panels_end(out);
    jox_html_heading(out, "Plans");
    jox_html_paragraph(
        out, "The greatest density " JOX_DENSITY_BY
             " at each place at any time, as a mean over the runs; the same scale for all.");
    jox_compare_put_plans(out, c);
}

static void put_validity_paragraph(FILE *out) {
    jox_html_heading(out, "What the intervals cover");
    jox_html_paragraph(
        out, "An interval covers chance alone, with the scene, behaviours and parameters as they "
             "are. It says nothing about how well these represent people: a difference that is "
             "certain within the model may be smaller than the model's own error. Runs of the same "
             "seed begin with the same people, so pairs of them reveal smaller differences. "
             "`jostle reproduce` shows what is validated of the engine.");
}

/* Writes the title: that of the scene if all sides have the same one. */
static void put_title(FILE *out, const JoxComparison *c) {
    const char *title = c->sides.items[0].title;
    JoxText text = {0};
    for (uint32_t s = 1; s < c->sides.count; s++)
        if (title && (!c->sides.items[s].title || strcmp(c->sides.items[s].title, title) != 0))
            title = NULL;
    const char *what = c->sides.count > 1 ? "variants compared" : "runs";
    if (title && *title)
        jox_text_printf(&text, "%s: %s", title, what);
    else
        jox_text_printf(&text, "%s", c->sides.count > 1 ? "Plans compared" : "Runs");
    jox_html_begin(out, text.data);
    jox_text_free(&text);
}

bool jox_compare_write_page(const JoxComparison *c, JoxText *why) {
    FILE *out = jox_plot_open(c->def->out, "index.html", why);
    if (!out)
        return false;
    put_title(out, c);
    if (c->sides.count > 1)
        put_comparison_summary(out, c);
    put_sides_table(out, c);
    if (c->sides.count > 1) {
        jox_html_heading(out, "Figures");
        if (jox_compare_count_effect_rows(c))
            jox_html_figure(out, c->def->out, "effects",
                            "Changes of the means, with their intervals. Changes by more than the "
                            "base itself are given as numbers at the edge.",
                            true);
        put_figures_table(out, c, true);
        put_methods_paragraph(out, c);
    }
    if (c->def->percentile > 0)
        jox_compare_put_percentiles(out, c);
    put_comparison_pictures(out, c);
    if (c->sides.count > 1) {
        jox_html_heading(out, "All other figures");
        fputs("<details><summary>by their names in summaries</summary>\n", out);
        put_figures_table(out, c, false);
        fputs("</details>\n", out);
    }
    put_validity_paragraph(out);
    char made[100];
    snprintf(made, sizeof made, "Made by Jostle %s.", jo_version());
    jox_html_paragraph(out, made);
    jox_html_end(out);
    return jox_plot_close(out, "index.html", why);
}
