/* Writes a comparison as text for a terminal. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "sweep/compare/compare.h"

enum { WORDS = 46, NUMBER = 11 };

/* Appends a number with four digits, right-aligned; "-" if it is not finite. */
static void add_number_column(JoxText *out, double value, int width, bool sign) {
    char text[40];
    if (!isfinite(value))
        snprintf(text, sizeof text, "-");
    else if ((value == floor(value) || fabs(value) >= 1000) && fabs(value) < 1e9)
        snprintf(text, sizeof text, sign ? "%+.0f" : "%.0f", value);
    else
        snprintf(text, sizeof text, sign ? "%+.4g" : "%.4g", value);
    jox_text_printf(out, "%*s", width, text);
}

static void add_sides(const JoxComparison *c, JoxText *out) {
    for (uint32_t s = 0; s < c->sides.count; s++) {
        const JoxSide *side = &c->sides.items[s];
        jox_text_printf(out, "%2u  %s: ", s + 1, side->name);
        if (side->recorded && side->runs == 1)
            jox_text_add(out, "one recording");
        else if (side->recorded)
            jox_text_printf(out, "%u recordings", side->runs);
        else
            jox_text_printf(out, "%u run%s", side->runs, side->runs == 1 ? "" : "s");
        if (side->runs && !side->recorded)
            jox_text_printf(out, ", seeds %llu to %llu", (unsigned long long)side->seeds[0],
                            (unsigned long long)side->seeds[side->runs - 1]);
        if (side->left_out)
            jox_text_printf(out, "; %u that failed or went wrong left out", side->left_out);
        jox_text_add(out, s == c->base && c->sides.count > 1 ? "  (the base of the comparison)\n"
                                                             : "\n");
    }
}

/* Appends how many runs would detect the difference, if the present ones do not. */
static void add_runs_needed(const JoxDifference *d, JoxText *out) {
    const JoxEffect *e = &d->effect;
    const size_t have = e->a < e->b ? e->a : e->b;
    if (!isfinite(e->low) || e->low > 0 || e->high < 0 || (e->low == 0 && e->high == 0))
        return;
    if (d->runs > have)
        jox_text_printf(out, "; about %zu %s would tell a difference of this size", d->runs,
                        e->pairs ? "seeds" : "runs of each");
    else if (e->difference != 0 && d->runs == 0)
        jox_text_add(out, "; it would take more than a million runs to tell");
}

/* Appends the words of a figure and its unit as the first column; if they are longer than the
   column, the rest of the row goes on the next line. */
static void add_figure_column(const JoxCompared *figure, JoxText *out) {
    char words[240];
    snprintf(words, sizeof words, "%s%s%s", figure->words.text, *figure->words.unit ? ", " : "",
             figure->words.unit);
    jox_text_printf(out, "%-*s", WORDS, words);
    if (strlen(words) >= WORDS)
        jox_text_printf(out, "\n%*s", WORDS, "");
}

static bool is_figure_listed(const JoxComparison *c, const JoxCompared *f) {
    return f->varies && (c->def->all || f->words.is_key);
}

/* Appends the differences of a side from the base, one figure a line. */
static void add_differences(const JoxComparison *c, uint32_t s, JoxText *out) {
    uint32_t differ = 0, told = 0, thin = 0;
    jox_text_printf(out, "\n%s minus %s:\n%-*s%*s%*s%*s  %.0f %% interval\n",
                    c->sides.items[s].name, c->sides.items[c->base].name, WORDS, "mean of the runs",
                    NUMBER, "base", NUMBER, "this", NUMBER, "difference", 100 * c->def->share);
    for (uint32_t f = 0; f < c->count; f++) {
        const JoxCompared *figure = &c->figures[f];
        const JoxDifference *d = &figure->sides[s];
        if (!is_figure_listed(c, figure) || (!d->base.count && !d->other.count))
            continue;
        add_figure_column(figure, out);
        add_number_column(out, d->base.mean, NUMBER, false);
        add_number_column(out, d->other.mean, NUMBER, false);
        add_number_column(out, d->effect.difference, NUMBER, true);
        if (isfinite(d->effect.low)) {
            jox_text_add(out, "  ");
            add_number_column(out, d->effect.low, 0, true);
            jox_text_add(out, " to ");
            add_number_column(out, d->effect.high, 0, true);
        }
        jox_text_printf(out, "  %s%s", jox_compare_verdict(d), d->adjusted ? " *" : "");
        add_runs_needed(d, out);
        if (d->base_known < c->sides.items[c->base].runs || d->other_known < c->sides.items[s].runs)
            jox_text_printf(out, " (%zu of %u and %zu of %u runs have one)", d->base_known,
                            c->sides.items[c->base].runs, d->other_known, c->sides.items[s].runs);
        jox_text_add(out, "\n");
        const bool differs = strcmp(jox_compare_verdict(d), "differs") == 0;
        told++;
        differ += differs;
        thin += isfinite(d->effect.low) && !differs && d->effect.difference != 0;
    }
    if (told == 0)
        jox_text_add(out, "  no figure differs in any run\n");
    jox_text_printf(out, "%u of %u figures differ", differ, told);
    if (thin)
        jox_text_printf(out, "; for %u there are too few runs to say", thin);
    jox_text_add(out, "\n");
}

static void add_methods(const JoxComparison *c, JoxText *out) {
    char method[200];
    for (uint32_t s = 0; s < c->sides.count; s++) {
        if (s == c->base || c->count == 0)
            continue;
        uint32_t most = 0; /* index of the figure that most runs have */
        for (uint32_t f = 0; f < c->count; f++)
            if (c->figures[f].sides[s].effect.b > c->figures[most].sides[s].effect.b)
                most = f;
        jox_compare_describe_method(c, &c->figures[most].sides[s], method, sizeof method);
        jox_text_printf(out, "Intervals of %s: %s.\n", c->sides.items[s].name, method);
    }
    jox_text_printf(out,
                    "* still differs after Holm's correction for %u figures; of the others, about "
                    "one in %.0f seems to differ by chance.\n",
                    c->tested, 1 / (1 - c->def->share));
    if (jox_compare_is_thin(c))
        jox_text_add(out, "With fewer than five runs the spread itself is uncertain, and so is the "
                          "number of runs needed.\n");
}

/* ---- one side alone ---- */

/* Appends how the figures of a single side spread over its runs. */
static void add_spread_table(const JoxComparison *c, JoxText *out) {
    const JoxSide *side = &c->sides.items[0];
    jox_text_printf(out, "\n%-*s%*s%*s%*s%*s  of\n", WORDS, "over the runs", NUMBER, "median",
                    NUMBER, "5 %", NUMBER, "95 %", NUMBER, "greatest");
    for (uint32_t f = 0; f < c->count; f++) {
        const JoxCompared *figure = &c->figures[f];
        const JoxSpread s = jox_spread_of(side, figure->figure);
        const double values[] = {s.median, s.p5, s.p95, s.most};
        if (!s.runs || !(c->def->all || (figure->words.is_key && (figure->varies || s.most != 0))))
            continue;
        add_figure_column(figure, out);
        for (size_t v = 0; v < sizeof values / sizeof *values; v++)
            add_number_column(out, values[v], NUMBER, false);
        jox_text_printf(out, "  %u run%s\n", s.runs, s.runs == 1 ? "" : "s");
    }
}

/* ---- percentiles ---- */

/* Appends the percentile, the worst value and the bound of a figure of one side. */
static void add_percentile_row(const JoxComparison *c, const JoxCompared *figure, uint32_t s,
                               JoxText *out) {
    const double q = c->def->percentile / 100;
    size_t count;
    double *values = jox_side_sorted_values(&c->sides.items[s], figure->figure, &count);
    const size_t above = jox_rank_above(count, q), bound = jox_rank_bound(count, q, c->def->share);
    if (count) {
        jox_text_printf(out, "  %-28s", c->sides.items[s].name);
        add_number_column(out, above ? values[above - 1] : NAN, NUMBER, false);
        add_number_column(out, values[count - 1], NUMBER, false);
        add_number_column(out, bound ? values[bound - 1] : NAN, NUMBER, false);
        jox_text_printf(out, "  of %zu run%s", count, count == 1 ? "" : "s");
        if (count < c->sides.items[s].runs)
            jox_text_printf(out, ", %zu have none", c->sides.items[s].runs - count);
        jox_text_add(out, "\n");
    }
    jox_free(values);
}

static void add_percentiles(const JoxComparison *c, JoxText *out) {
    const double q = c->def->percentile / 100;
    jox_text_printf(out, "\n%-30s%*.4g %%%*s%*s\n", "The value above so many of all", NUMBER - 2,
                    c->def->percentile, NUMBER, "worst", NUMBER, "bound");
    for (uint32_t f = 0; f < c->count; f++) {
        const JoxCompared *figure = &c->figures[f];
        if (!is_figure_listed(c, figure) || figure->words.low_is_worse)
            continue;
        jox_text_printf(out, "%s%s%s\n", figure->words.text, *figure->words.unit ? ", " : "",
                        figure->words.unit);
        for (uint32_t s = 0; s < c->sides.count; s++)
            add_percentile_row(c, figure, s, out);
    }
    jox_text_printf(
        out,
        "The first column follows MSC.1/Circ.1533: of all values ranked from the lowest, the one "
        "that %.4g %% of them are below; it takes %zu runs at least. The bound lies above the true "
        "%.4g %% value with a probability of %.0f %%, whatever the distribution (Wilks 1941); it "
        "takes %zu runs. The circular asks for 50 runs or more of each case. Flows and numbers of "
        "people who left are not listed here, as less of them is worse.\n",
        c->def->percentile, (size_t)floor(1 / (1 - q) + 1e-9), c->def->percentile,
        100 * c->def->share, jox_rank_runs(q, c->def->share));
}

void jox_compare_write_text(const JoxComparison *c, JoxText *out) {
    add_sides(c, out);
    for (uint32_t s = 0; s < c->sides.count; s++)
        if (s != c->base)
            add_differences(c, s, out);
    if (c->sides.count > 1)
        add_methods(c, out);
    else
        add_spread_table(c, out);
    if (c->def->percentile > 0)
        add_percentiles(c, out);
}
