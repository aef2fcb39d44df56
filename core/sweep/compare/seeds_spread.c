/* Computes how the figures of a side spread over its runs, and writes spreads as text. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "base/mem.h"
#include "sweep/compare/compare.h"

JoxSpread jox_spread_of(const JoxSide *side, const char *name) {
    const JoxSideFigure *figure = jox_side_find_figure(side, name);
    JoxSpread s = {NAN, NAN, NAN, NAN, NAN, NAN, 0, 0, 0};
    double *values = jox_alloc(side->runs + 1, sizeof *values);
    for (uint32_t r = 0; figure && r < side->runs; r++) {
        const double value = figure->values[r];
        if (!isfinite(value))
            continue;
        if (!(s.least <= value)) {
            s.least = value;
            s.least_seed = side->seeds[r];
        }
        if (!(s.most >= value)) {
            s.most = value;
            s.most_seed = side->seeds[r];
        }
        values[s.runs++] = value;
    }
    if (s.runs) {
        s.mean = jox_moments(values, s.runs).mean;
        s.p5 = jox_quantile(values, s.runs, 0.05);
        s.median = jox_quantile(values, s.runs, 0.5);
        s.p95 = jox_quantile(values, s.runs, 0.95);
    }
    jox_free(values);
    return s;
}

JoxSpread jox_spread_of_path(const JoxSide *side, const char *format, ...) {
    char name[300];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(name, sizeof name, format, arguments);
    va_end(arguments);
    return jox_spread_of(side, name);
}

uint32_t jox_spread_count_positive(const JoxSide *side, const char *name) {
    const JoxSideFigure *figure = jox_side_find_figure(side, name);
    uint32_t count = 0;
    for (uint32_t r = 0; figure && r < side->runs; r++)
        count += figure->values[r] > 0;
    return count;
}

/* Appends a number: three digits, or four from 100 on and all digits from 1000 on. */
static void add_short_number(JoxText *out, double value) {
    jox_text_printf(out,
                    value == floor(value) || fabs(value) >= 1000 ? "%.0f"
                    : fabs(value) >= 100                         ? "%.1f"
                                                                 : "%.3g",
                    value);
}

void jox_spread_add_text(const JoxSpread *s, const char *unit, bool low, JoxText *out) {
    const char *words = jox_figure_unit(unit), *blank = *words ? " " : "";
    add_short_number(out, s->median);
    jox_text_printf(out, "%s%s", blank, words);
    if (s->runs < 2 || s->least == s->most)
        return;
    jox_text_add(out, " (");
    add_short_number(out, s->p5);
    jox_text_add(out, " to ");
    add_short_number(out, s->p95);
    jox_text_add(out, low ? "; at least " : "; at most ");
    add_short_number(out, low ? s->least : s->most);
    jox_text_printf(out, ", seed %llu)", (unsigned long long)(low ? s->least_seed : s->most_seed));
}
