/* The plot of stairs: a strip for each, with its flow and density over time, and the limits of
   both. danger_plots.c draws it. */
#include <math.h>
#include <stdio.h>

#include "base/format/quote.h"
#include "report/danger_output_parts.h"

/* Shares of the greatest value that an axis reaches, so that the limits lie apart. */
static const double FLOW_ROOM = 1.1, DENSITY_ROOM = 1.35;

/* Returns the number of stairs that more people passed or stood on than on stair k, or as many and
   they come before it. */
static int rank_stair(const JoxDangerStairs *s, uint32_t k) {
    int before = 0;
    for (uint32_t other = 0; other < s->count; other++) {
        const JoxDangerStair *a = &s->items[other], *b = &s->items[k];
        const uint32_t more = a->up + a->down, less = b->up + b->down;
        before += a->people_most && (more > less || (more == less && other < k));
    }
    return before;
}

static bool has_strip(const JoxDangerStairs *s, uint32_t k) {
    return s->items[k].people_most && s->items[k].row_count &&
           rank_stair(s, k) < JOX_MOST_STAIR_STRIPS;
}

int jox_danger_count_stair_strips(const JoxDanger *d) {
    int count = 0;
    for (uint32_t k = 0; k < d->stairs.count; k++)
        count += has_strip(&d->stairs, k);
    return count;
}

/* Writes a curve: a column of danger-stairs.csv of one stair. */
static void put_curve(FILE *script, const char *stair, int column, const char *style) {
    fputs("'danger-stairs.csv' skip 1 using (strcol(1) eq ", script);
    jox_quote_put(script, jox_quote_gnuplot, stair);
    fprintf(script, " ? $2 : NaN):(strcol(%d) eq '' ? NaN : $%d) with %s", column, column, style);
}

/* Returns the flow above which a stair is at level F, 1/(m s); NAN: it has no levels. */
static double find_flow_limit(const JoxStair *stair) {
    const JoxLevel *last = &jox_levels[JOX_LEVELS - 2];
    return stair->kind == JOX_STAIR_ESCALATOR ? NAN
           : stair->kind == JOX_STAIR_RAMP    ? last->walk_flow / 60.0
                                              : last->stair_flow / 60.0;
}

static void write_stair_strip(const JoxDangerStairs *s, uint32_t k, FILE *script) {
    const JoxStair *stair = &s->storeys->stairs[k];
    const JoxDangerStair *on = &s->items[k];
    const double flow_limit = find_flow_limit(stair);
    const double flow = fmax(fmax(on->flow_most, flow_limit), 0.1);
    const double density = fmax(fmax(on->mean_most, s->limit), 0.1);
    JoxText title = {0};
    jox_text_printf(&title, "%.80s: %u up, %u down, %.3g m wide", stair->name, on->up, on->down,
                    on->width);
    jox_strips_set_title(script, title.data);
    jox_text_free(&title);
    fprintf(script,
            "set ylabel 'per m and s'\nset y2label 'people per m\xc2\xb2'\nset ytics %s "
            "nomirror\nset y2tics autofreq\nset yrange [0:%g]\nset y2range [0:%g]\nunset "
            "arrow\nset key at graph 1.07,1 "
            "left top Left reverse\n",
            flow < 3.0 ? "0.5" : "autofreq", FLOW_ROOM * flow, DENSITY_ROOM * density);
    if (isfinite(flow_limit))
        fprintf(script,
                "set arrow from graph 0, first %.6g to graph 1, first %.6g nohead lc '#0072b2' dt "
                "2\n",
                flow_limit, flow_limit);
    fprintf(script,
            "set arrow from graph 0, second %.6g to graph 1, second %.6g nohead lc '#c00000' dt 2\n"
            "plot ",
            s->limit, s->limit);
    put_curve(script, stair->name, 6, "lines lw 2 lc '#0072b2' title 'flow', ");
    put_curve(script, stair->name, 7,
              "lines lw 2 lc '#e69f00' axes x1y2 title 'mean density (right)', ");
    if (isfinite(flow_limit))
        fputs("NaN with lines lc '#0072b2' dt 2 title 'level F, by flow', ", script);
    fprintf(script, "NaN with lines lc '#c00000' dt 2 title 'limit: %g per m\xc2\xb2'\n", s->limit);
}

void jox_danger_write_stair_strips(const void *danger, FILE *script) {
    const JoxDanger *d = danger;
    for (uint32_t k = 0; k < d->stairs.count; k++)
        if (has_strip(&d->stairs, k))
            write_stair_strip(&d->stairs, k, script);
}
