/* Probe `failures`: the share of agent-steps whose two-dimensional linear program had no solution,
   in bins of `every` seconds. */
#include <math.h>

#include "base/mem.h"
#include "record/probes/probe_parts.h"

typedef struct Bin {
    uint64_t failed, all; /* number of agent-steps */
} Bin;

typedef struct Failures {
    Bin *bins;
    uint32_t count, capacity;
} Failures;

static void take_failures_frame(const JoxProbeDef *def, void *state, const JoxFrame *frame,
                                const uint8_t *seen) {
    Failures *f = state;
    /* A step that ends at the edge of a bin belongs to the bin before. */
    double at = (frame->time - def->from) / def->every - 1e-6;
    uint32_t bin = at > 0.0 ? (uint32_t)at : 0;
    JOX_RESERVE(f->bins, f->capacity, bin + 1);
    while (f->count <= bin)
        f->bins[f->count++] = (Bin){0, 0};
    for (uint32_t i = 0; frame->failed && i < frame->count; i++) {
        f->bins[bin].failed += seen[i] && frame->failed[i];
        f->bins[bin].all += seen[i];
    }
}

static double compute_failure_share(Bin bin) {
    return bin.all ? (double)bin.failed / (double)bin.all : NAN;
}

static void add_failures_figures(const JoxProbeDef *def, const void *state, JoxFigures *out) {
    const Failures *f = state;
    Bin sum = {0, 0};
    double peak = NAN, peak_time = NAN;
    for (uint32_t b = 0; b < f->count; b++) {
        sum.failed += f->bins[b].failed;
        sum.all += f->bins[b].all;
        if (f->bins[b].all && !(compute_failure_share(f->bins[b]) <= peak)) {
            peak = compute_failure_share(f->bins[b]);
            peak_time = def->from + (b + 0.5) * def->every;
        }
    }
    jox_figure_add(out, "agent_steps", "steps of people measured", "", (double)sum.all);
    jox_figure_add(out, "share", "share in which no velocity met all constraints", "",
                   compute_failure_share(sum));
    jox_figure_add(out, "peak", "greatest share of an interval", "", peak);
    jox_figure_add(out, "peak_time", "time of the greatest share", "s", peak_time);
}

static void list_failures_sections(void *state, JoxSections *s) {
    Failures *f = state;
    JOX_SECTION_ARRAY(s, "bins", f->bins, f->count, f->capacity);
}

static void write_failures_csv(const JoxProbeDef *def, const void *state, FILE *out) {
    const Failures *f = state;
    fputs("time [s],agent_steps,failed,share\n", out);
    for (uint32_t b = 0; b < f->count; b++)
        fprintf(out, "%.4f,%llu,%llu,%.6g\n", def->from + (b + 0.5) * def->every,
                (unsigned long long)f->bins[b].all, (unsigned long long)f->bins[b].failed,
                compute_failure_share(f->bins[b]));
}

static void plot_failures(const JoxProbeDef *def, const void *state, bool walls, JoxText *out) {
    const Failures *f = state;
    double most = NAN;
    (void)walls;
    for (uint32_t b = 0; b < f->count; b++)
        most = f->bins[b].all ? fmax(100.0 * compute_failure_share(f->bins[b]), most) : most;
    if (isnan(most)) {
        jox_plot_reason(out, "nobody was there");
        return;
    }
    jox_text_printf(
        out,
        "set xlabel 'time (s)'\nset ylabel 'linear programs without solution (%%)'\nunset key\n"
        "set yrange [0:%g]\nset xrange [%g:%g]\nset boxwidth %g\n"
        "set style fill solid 0.9\n"
        "plot csv skip 1 using 1:(100*$4) with boxes lc '#1f77b4'\n",
        fmax(1.1 * most, 1.0), def->from, def->from + f->count * def->every, 0.9 * def->every);
}

const JoxProbeCalls jox_probe_failures = {
    JOX_PROBE_KIND(Failures, failures, 1000, 600),
    .frame = take_failures_frame,
    .pace = JOX_PACE_ALL,
    .owned = {JOX_OWNED(Failures, bins)},
};
