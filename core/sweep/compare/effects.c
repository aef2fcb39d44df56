/* Computes the differences of figures between each side and the base, their intervals, and how many
   runs would detect them. */
#include <math.h>
#include <stdio.h>

#include "base/mem.h"
#include "base/sort.h"
#include "sweep/compare/compare.h"

/* Probability of detecting the difference, from which the number of runs needed is computed. */
static const double POWER = 0.8;

/* The values of one figure on two sides, of the runs that have it. */
typedef struct Samples {
    double *a, *b;
    size_t a_count, b_count;
    size_t a_known, b_known; /* including runs without a partner */
    bool paired;
} Samples;

double *jox_side_sorted_values(const JoxSide *side, const char *name, size_t *count) {
    const JoxSideFigure *figure = jox_side_find_figure(side, name);
    double *values = jox_alloc(side->runs + 1, sizeof *values);
    *count = 0;
    for (uint32_t r = 0; figure && r < side->runs; r++)
        if (isfinite(figure->values[r]))
            values[(*count)++] = figure->values[r];
    jox_sort_doubles(values, *count);
    return values;
}

/* Collects the values of both sides. Runs of the same seed are paired if at least half of the
   smaller side's runs have a partner. */
static Samples pair_samples(const JoxSide *base, const JoxSide *other, const char *name) {
    const JoxSideFigure *f = jox_side_find_figure(base, name),
                        *g = jox_side_find_figure(other, name);
    Samples s = {0};
    uint32_t i = 0, k = 0;
    size_t pairs = 0;
    s.a = jox_side_sorted_values(base, name, &s.a_count);
    s.b = jox_side_sorted_values(other, name, &s.b_count);
    s.a_known = s.a_count;
    s.b_known = s.b_count;
    if (!f || !g || base->recorded || other->recorded)
        return s;
    double *a = jox_alloc(base->runs + 1, sizeof *a), *b = jox_alloc(base->runs + 1, sizeof *b);
    while (i < base->runs && k < other->runs) {
        if (base->seeds[i] == other->seeds[k] && isfinite(f->values[i]) && isfinite(g->values[k])) {
            a[pairs] = f->values[i];
            b[pairs++] = g->values[k];
        }
        const uint64_t u = base->seeds[i], v = other->seeds[k];
        i += u <= v;
        k += v <= u;
    }
    const size_t fewer = s.a_count < s.b_count ? s.a_count : s.b_count;
    s.paired = pairs >= 2 && 2 * pairs >= fewer;
    double *const old[] = {s.paired ? s.a : a, s.paired ? s.b : b};
    jox_free(old[0]);
    jox_free(old[1]);
    if (s.paired) {
        s.a = a;
        s.b = b;
        s.a_count = s.b_count = pairs;
    }
    return s;
}

/* Computes the difference of a figure between a side and the base: paired or not, by t or by
   bootstrap, as the def says. */
static JoxDifference measure_difference(const JoxComparison *c, const JoxSide *other,
                                        const char *name) {
    const JoxSide *base = &c->sides.items[c->base];
    const double share = c->def->share;
    Samples s = pair_samples(base, other, name);
    JoxDifference d = {.base = jox_moments(s.a, s.a_count), .other = jox_moments(s.b, s.b_count)};
    d.effect = s.paired ? jox_effect_paired(s.a, s.b, s.a_count, share)
                        : jox_effect_apart(s.a, s.a_count, s.b, s.b_count, share);
    if (c->def->resamples)
        jox_effect_bootstrap(&d.effect, s.a, s.b, c->def->resamples, share);
    d.base_known = s.a_known;
    d.other_known = s.b_known;
    d.runs = jox_effect_runs(&d.effect, share, POWER);
    jox_free(s.a);
    jox_free(s.b);
    return d;
}

/* Returns whether a figure has two different values in any runs of any sides. */
static bool is_varied(const JoxComparison *c, const char *name) {
    double first = NAN;
    for (uint32_t s = 0; s < c->sides.count; s++) {
        const JoxSide *side = &c->sides.items[s];
        const JoxSideFigure *figure = jox_side_find_figure(side, name);
        for (uint32_t r = 0; figure && r < side->runs; r++) {
            if (isfinite(figure->values[r]) && isnan(first))
                first = figure->values[r];
            if (isfinite(figure->values[r]) && figure->values[r] != first)
                return true;
        }
    }
    return false;
}

/* Returns whether two figures have the same value in every run of every side. */
static bool are_figures_equal(const JoxComparison *c, const char *a, const char *b) {
    for (uint32_t s = 0; s < c->sides.count; s++) {
        const JoxSide *side = &c->sides.items[s];
        const JoxSideFigure *f = jox_side_find_figure(side, a), *g = jox_side_find_figure(side, b);
        for (uint32_t r = 0; r < side->runs; r++)
            if (!f || !g || f->values[r] != g->values[r]) /* two NAN count as different */
                return false;
    }
    return true;
}

/* If two key figures have the same value in every run, as of a single exit and of all exits, the
   later one is no key figure. */
static void demote_duplicates(JoxComparison *c) {
    for (uint32_t f = 1; f < c->count; f++)
        for (uint32_t g = 0; g < f && c->figures[f].words.is_key; g++)
            if (c->figures[g].words.is_key &&
                are_figures_equal(c, c->figures[f].figure, c->figures[g].figure))
                c->figures[f].words.is_key = false;
}

/* ---- Holm's correction ---- */

typedef struct Test {
    double p;
    JoxDifference *of;
} Test;

static int compare_p(const void *a, const void *b, const void *context) {
    const double x = ((const Test *)a)->p, y = ((const Test *)b)->p;
    (void)context;
    return x < y ? -1 : x > y;
}

/* Applies Holm's correction over the figures of a side: the least of m values of p is compared with
   alpha / m, the next with alpha / (m - 1), and so on, until one is above. S. Holm, "A simple
   sequentially rejective multiple test procedure", Scandinavian Journal of Statistics 6, 1979. */
static void apply_holm(JoxComparison *c, uint32_t side) {
    Test *tests = jox_alloc(c->count + 1, sizeof *tests);
    uint32_t count = 0;
    for (uint32_t f = 0; f < c->count; f++)
        if (isfinite(c->figures[f].sides[side].effect.p) && c->figures[f].varies)
            tests[count++] = (Test){c->figures[f].sides[side].effect.p, &c->figures[f].sides[side]};
    jox_sort(tests, count, sizeof *tests, compare_p, NULL, NULL);
    for (uint32_t t = 0; t < count && tests[t].p <= (1 - c->def->share) / (count - t); t++)
        tests[t].of->adjusted = true;
    c->tested = count > c->tested ? count : c->tested;
    jox_free(tests);
}

/* ---- the whole ---- */

static int compare_figures(const void *a, const void *b, const void *context) {
    (void)context;
    return jox_figure_compare_paths(((const JoxCompared *)a)->figure,
                                    ((const JoxCompared *)b)->figure);
}

void jox_compare_effects(JoxComparison *c) {
    size_t capacity = 0;
    for (uint32_t s = 0; s < c->sides.count; s++)
        for (uint32_t f = 0; f < c->sides.items[s].figure_count; f++) {
            const char *name = c->sides.items[s].figures[f].name;
            bool there = false;
            for (uint32_t k = 0; k < s && !there; k++)
                there = jox_side_find_figure(&c->sides.items[k], name);
            if (there)
                continue;
            JOX_RESERVE(c->figures, capacity, c->count + 1);
            c->figures[c->count++] = (JoxCompared){.figure = name};
        }
    if (c->count)
        jox_sort(c->figures, c->count, sizeof *c->figures, compare_figures, NULL, NULL);
    for (uint32_t f = 0; f < c->count; f++) {
        JoxCompared *figure = &c->figures[f];
        figure->words = jox_figure_words(figure->figure);
        figure->varies = is_varied(c, figure->figure);
        figure->sides = jox_alloc(c->sides.count, sizeof *figure->sides);
        for (uint32_t s = 0; s < c->sides.count; s++)
            figure->sides[s] = measure_difference(c, &c->sides.items[s], figure->figure);
    }
    demote_duplicates(c);
    for (uint32_t s = 0; s < c->sides.count; s++)
        if (s != c->base)
            apply_holm(c, s);
}

bool jox_compare_is_thin(const JoxComparison *c) {
    enum { FEW = 5 };
    for (uint32_t s = 0; s < c->sides.count; s++)
        if (c->sides.items[s].runs < FEW)
            return true;
    return false;
}

const char *jox_compare_verdict(const JoxDifference *d) {
    const JoxEffect *e = &d->effect;
    if (!isfinite(e->difference))
        return "not known of both";
    if (!isfinite(e->low))
        return "one run: not known how sure";
    if (e->low == 0 && e->high == 0)
        return "the same";
    return e->low > 0 || e->high < 0 ? "differs" : "not told apart";
}

void jox_compare_describe_method(const JoxComparison *c, const JoxDifference *d, char *out,
                                 size_t size) {
    const JoxEffect *e = &d->effect;
    if (e->pairs && c->def->resamples)
        snprintf(out, size, "bootstrap of the differences of %zu seeds, %u resamples", e->pairs,
                 c->def->resamples);
    else if (e->pairs)
        snprintf(out, size, "Student's t of the differences of %zu seeds", e->pairs);
    else if (e->a < 2 || e->b < 2)
        snprintf(out, size, "none: it takes two runs of each");
    else if (c->def->resamples)
        snprintf(out, size, "bootstrap of %zu and %zu runs, %u resamples", e->a, e->b,
                 c->def->resamples);
    else
        snprintf(out, size, "Welch's t of %zu and %zu runs", e->a, e->b);
}
