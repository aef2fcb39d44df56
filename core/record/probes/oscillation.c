/* Probe `oscillation`: whether a crowd turns round as a whole, as dense crowds do (Gu et al. 2025,
   doi 10.1038/s41586-024-08514-6). The area is cut into windows; the velocity of a window is the
   mean over its people and over an interval. Its direction n, a unit vector taken as a complex
   number, gives a power spectrum: the average over windows and over segments of the series that
   overlap by half, each with its mean removed and weighted by Hann's window (Welch 1967, doi
   10.1109/TAU.1967.1161901). Positive frequencies turn anti-clockwise, negative ones clockwise.
   Random directions in each interval have the power 1 everywhere; a crowd that turns has a peak,
   and one that does not has most power at the lowest frequencies. */
#include <math.h>

#include "base/mem.h"
#include "record/probes/probe_parts.h"

enum { MOST_WINDOWS = 10000, MOST_CELLS = 1 << 24, LEAST_SAMPLES = 16, LEAST_BIN = 2 };
/* Least share of the intervals in which a window must have people. */
static const double LEAST_SHARE = 0.8;

typedef struct Cell {
    double vx, vy; /* m/s: sums during an interval; double, as people come in any order */
    double people; /* person-frames */
} Cell;

typedef struct Oscillation {
    Cell *cells; /* windows of the first interval, then of the next */
    uint32_t count, capacity;
    uint32_t columns, rows, intervals;
    uint32_t *frames; /* frames in each interval */
    uint32_t frame_count, frame_capacity;
} Oscillation;

/* Power by frequency, in bins 0 to bins - 1; bin k is at k * step. */
typedef struct Spectrum {
    double *anticlockwise, *clockwise, *speed;
    /* tables over the samples of a segment; `fade` is Hann's window */
    double *cosine, *sine, *fade;
    uint32_t bins, samples; /* samples in a segment */
    double step;            /* rad/s between bins */
    double segments;        /* segments summed, over all windows */
} Spectrum;

static uint32_t count_windows(const Oscillation *o) {
    return o->columns * o->rows;
}

static void begin_oscillation(const JoxProbeDef *def, void *state) {
    Oscillation *o = state;
    const double columns = floor((def->high.x - def->low.x) / def->window + 1e-6);
    const double rows = floor((def->high.y - def->low.y) / def->window + 1e-6);
    o->columns = (uint32_t)fmin(fmax(columns, 1.0), MOST_WINDOWS);
    o->rows = (uint32_t)fmin(fmax(rows, 1.0), MOST_WINDOWS / o->columns);
}

static void take_oscillation_frame(const JoxProbeDef *def, void *state, const JoxFrame *frame,
                                   const uint8_t *seen) {
    Oscillation *o = state;
    /* A frame at the end of an interval belongs to it. */
    const double at = (frame->time - def->from) / def->every - 1e-6;
    const uint32_t windows = count_windows(o);
    const uint32_t interval = at > 0.0 ? (uint32_t)fmin(at, MOST_CELLS) : 0;
    if (interval + 1 > MOST_CELLS / windows)
        return;
    JOX_RESERVE(o->cells, o->capacity, (interval + 1) * windows);
    JOX_RESERVE(o->frames, o->frame_capacity, interval + 1);
    while (o->count < (interval + 1) * windows)
        o->cells[o->count++] = (Cell){0};
    while (o->frame_count <= interval)
        o->frames[o->frame_count++] = 0;
    o->intervals = o->frame_count;
    o->frames[interval]++;
    for (uint32_t i = 0; i < frame->count; i++) {
        const double x = (frame->x[i] - def->low.x) / def->window;
        const double y = (frame->y[i] - def->low.y) / def->window;
        if (!seen[i] || !(x >= 0.0 && y >= 0.0 && x < o->columns && y < o->rows))
            continue;
        Cell *cell = &o->cells[interval * windows + (uint32_t)y * o->columns + (uint32_t)x];
        cell->vx += frame->vx[i];
        cell->vy += frame->vy[i];
        cell->people += 1.0;
    }
}

/* Allocates a spectrum, and sets the length of its segments and the tables over them. */
static void begin_spectrum(Spectrum *s, const JoxProbeDef *def, uint32_t intervals) {
    const double wanted = fmin(round(def->span / def->every), intervals);
    s->samples = wanted < LEAST_SAMPLES ? 0 : (uint32_t)wanted;
    s->bins = s->samples / 2;
    s->step = s->samples ? 2.0 * M_PI / (s->samples * def->every) : 0.0;
    double **const parts[] = {&s->anticlockwise, &s->clockwise, &s->speed};
    for (int p = 0; p < 3; p++)
        *parts[p] = jox_alloc(s->bins + 1, sizeof(double));
    double **const tables[] = {&s->cosine, &s->sine, &s->fade};
    for (int p = 0; p < 3; p++)
        *tables[p] = jox_alloc(s->samples + 1, sizeof(double));
    double power = 0.0;
    for (uint32_t t = 0; t < s->samples; t++) {
        const double angle = 2.0 * M_PI * t / s->samples;
        s->cosine[t] = cos(angle);
        s->sine[t] = sin(angle);
        s->fade[t] = 0.5 - 0.5 * s->cosine[t];
        power += s->fade[t] * s->fade[t];
    }
    for (uint32_t t = 0; t < s->samples; t++)
        s->fade[t] /= sqrt(power);
}

static void free_spectrum(Spectrum *s) {
    double *const all[] = {s->anticlockwise, s->clockwise, s->speed, s->cosine, s->sine, s->fade};
    for (int p = 0; p < 6; p++)
        jox_free(all[p]);
}

/* Computes directions and speeds of one segment of a window, without their means and weighted by
   `fade`. Returns false if the window was empty too often. */
static bool fill_segment(const Oscillation *o, const Spectrum *s, uint32_t window, uint32_t first,
                         double *nx, double *ny, double *speed) {
    double mean[3] = {0.0, 0.0, 0.0}, spread = 0.0;
    uint32_t there = 0;
    for (uint32_t t = 0; t < s->samples; t++) {
        const Cell *c = &o->cells[(first + t) * count_windows(o) + window];
        const double v = hypot(c->vx, c->vy);
        nx[t] = v > 0.0 ? c->vx / v : 0.0;
        ny[t] = v > 0.0 ? c->vy / v : 0.0;
        speed[t] = c->people > 0.0 ? v / c->people : 0.0;
        there += c->people > 0.0;
        mean[0] += nx[t] / s->samples;
        mean[1] += ny[t] / s->samples;
        mean[2] += speed[t] / s->samples;
    }
    if (there < LEAST_SHARE * s->samples)
        return false;
    for (uint32_t t = 0; t < s->samples; t++)
        spread += (speed[t] - mean[2]) * (speed[t] - mean[2]) / s->samples;
    for (uint32_t t = 0; t < s->samples; t++) {
        nx[t] = (nx[t] - mean[0]) * s->fade[t];
        ny[t] = (ny[t] - mean[1]) * s->fade[t];
        speed[t] = spread > 0.0 ? (speed[t] - mean[2]) / sqrt(spread) * s->fade[t] : 0.0;
    }
    return true;
}

/* Computes the powers of the complex series x + iy at bins k and -k. */
static void compute_powers(const Spectrum *s, const double *x, const double *y, uint32_t k,
                           double out[2]) {
    double xc = 0.0, xs = 0.0, yc = 0.0, ys = 0.0;
    for (uint32_t t = 0; t < s->samples; t++) {
        const uint32_t at = (uint32_t)((uint64_t)t * k % s->samples);
        xc += x[t] * s->cosine[at];
        xs += x[t] * s->sine[at];
        yc += y[t] * s->cosine[at];
        ys += y[t] * s->sine[at];
    }
    out[0] = (xc + ys) * (xc + ys) + (yc - xs) * (yc - xs);
    out[1] = (xc - ys) * (xc - ys) + (yc + xs) * (yc + xs);
}

/* Calls `visit` with each segment of each window. */
typedef void (*SegmentCall)(Spectrum *s, const double *nx, const double *ny, const double *speed,
                            void *context);
static void visit_segments(const Oscillation *o, Spectrum *s, SegmentCall visit, void *context) {
    double *series = jox_alloc(3 * (size_t)s->samples + 1, sizeof *series);
    double *nx = series, *ny = series + s->samples, *speed = ny + s->samples;
    for (uint32_t first = 0; s->samples && first + s->samples <= o->intervals;
         first += s->samples / 2)
        for (uint32_t w = 0; w < count_windows(o); w++)
            if (fill_segment(o, s, w, first, nx, ny, speed))
                visit(s, nx, ny, speed, context);
    jox_free(series);
}

/* Adds the powers of a segment, for direction and speed, to the spectrum. */
static void add_segment_powers(Spectrum *s, const double *nx, const double *ny, const double *speed,
                               void *context) {
    (void)context;
    s->segments += 1.0;
    for (uint32_t k = 0; k < s->bins; k++) {
        double turning[2], alone[2];
        compute_powers(s, nx, ny, k, turning);
        /* Power of (1 + i) speed, which is twice the power of speed. */
        compute_powers(s, speed, speed, k, alone);
        s->anticlockwise[k] += turning[0];
        s->clockwise[k] += turning[1];
        s->speed[k] += 0.5 * alone[0];
    }
}

static Spectrum compute_spectrum(const JoxProbeDef *def, const Oscillation *o) {
    Spectrum s = {0};
    begin_spectrum(&s, def, o->intervals);
    visit_segments(o, &s, add_segment_powers, NULL);
    for (uint32_t k = 0; k < s.bins && s.segments > 0.0; k++) {
        s.anticlockwise[k] /= s.segments;
        s.clockwise[k] /= s.segments;
        s.speed[k] /= s.segments;
    }
    return s;
}

/* Returns the bin of the greatest power (of `power` plus `other`, unless that is NULL), and in
   `rises` its ratio to the least power at lower bins; 0 if there is no spectrum. The first
   LEAST_BIN bins are left out: removing the mean lowers them. */
static uint32_t find_spectrum_peak(const Spectrum *s, const double *power, const double *other,
                                   double *rises) {
    uint32_t peak = 0;
    double least = INFINITY, greatest = 0.0;
    *rises = NAN;
    for (uint32_t k = LEAST_BIN; k < s->bins && s->segments > 0.0; k++) {
        const double p = power[k] + (other ? other[k] : 0.0);
        if (p > greatest) {
            greatest = p;
            peak = k;
        }
    }
    for (uint32_t k = LEAST_BIN; k <= peak; k++)
        least = fmin(least, power[k] + (other ? other[k] : 0.0));
    if (peak)
        *rises = greatest / least;
    return peak;
}

/* Counts over segments, at the peak: anticlockwise ones, and how far one sense of rotation
   prevails. */
typedef struct Turns {
    uint32_t peak;
    double anticlockwise, one_way, all;
} Turns;

/* Adds the sense of rotation of a segment, by the powers in three bins at the peak. */
static void add_segment_turn(Spectrum *s, const double *nx, const double *ny, const double *speed,
                             void *context) {
    (void)speed;
    Turns *turns = context;
    double sum[2] = {0.0, 0.0};
    for (uint32_t k = turns->peak - 1; k <= turns->peak + 1; k++) {
        double power[2];
        compute_powers(s, nx, ny, k, power);
        sum[0] += power[0];
        sum[1] += power[1];
    }
    const double both = sum[0] + sum[1];
    turns->all += 1.0;
    turns->anticlockwise += sum[0] > sum[1];
    turns->one_way += both > 0.0 ? fabs(sum[0] - sum[1]) / both : 0.0;
}

static void add_oscillation_figures(const JoxProbeDef *def, const void *state, JoxFigures *out) {
    const Oscillation *o = state;
    Spectrum s = compute_spectrum(def, o);
    double people = 0.0, frames = 0.0, square = 0.0, filled = 0.0;
    for (uint32_t t = 0; t < o->intervals; t++) {
        frames += o->frames[t];
        for (uint32_t w = 0; w < count_windows(o); w++) {
            const Cell *c = &o->cells[t * count_windows(o) + w];
            people += c->people;
            if (c->people > 0.0) {
                const double v = hypot(c->vx, c->vy) / c->people;
                square += v * v;
                filled += 1.0;
            }
        }
    }
    double rises, speed_rises;
    const uint32_t peak = find_spectrum_peak(&s, s.anticlockwise, s.clockwise, &rises);
    const uint32_t speed_peak = find_spectrum_peak(&s, s.speed, NULL, &speed_rises);
    Turns turns = {.peak = peak};
    if (peak)
        visit_segments(o, &s, add_segment_turn, &turns);
    const double area = count_windows(o) * def->window * def->window, known = peak ? 1.0 : NAN;
    jox_figure_add(out, "intervals", "intervals measured", "", o->intervals);
    jox_figure_add(out, "windows", "windows", "", count_windows(o));
    jox_figure_add(out, "density", "density by counting, mean", "1/m2",
                   frames > 0.0 ? people / frames / area : NAN);
    jox_figure_add(out, "speed", "speed, root mean square", "m/s",
                   filled > 0.0 ? sqrt(square / filled) : NAN);
    jox_figure_add(out, "frequency", "frequency of the orientation", "rad/s",
                   known * peak * s.step);
    jox_figure_add(out, "rises", "peak of the orientation over the least power below it", "",
                   rises);
    jox_figure_add(out, "speed_frequency", "frequency of the speed", "rad/s",
                   known * speed_peak * s.step);
    jox_figure_add(out, "speed_rises", "peak of the speed over the least power below it", "",
                   speed_rises);
    jox_figure_add(out, "anticlockwise", "share that turns anti-clockwise", "",
                   known * turns.anticlockwise / turns.all);
    jox_figure_add(out, "one_way", "predominance of one sense of rotation", "",
                   known * turns.one_way / turns.all);
    free_spectrum(&s);
}

static void list_oscillation_sections(void *state, JoxSections *s) {
    Oscillation *o = state;
    JOX_SECTION_ARRAY(s, "cells", o->cells, o->count, o->capacity);
    JOX_SECTION_ARRAY(s, "frames", o->frames, o->frame_count, o->frame_capacity);
    if (s->failed || (uint64_t)o->frame_count * count_windows(o) != o->count) {
        jox_sections_fail(s, "cells", "their number does not fit the windows");
        o->count = o->frame_count = 0;
    }
    o->intervals = o->frame_count;
}

static void write_oscillation_csv(const JoxProbeDef *def, const void *state, FILE *out) {
    Spectrum s = compute_spectrum(def, state);
    fputs("frequency [rad/s],direction,anticlockwise,clockwise,speed\n", out);
    for (uint32_t k = 1; k < s.bins && s.segments > 0.0; k++)
        fprintf(out, "%.5f,%.5g,%.5g,%.5g,%.5g\n", k * s.step,
                0.5 * (s.anticlockwise[k] + s.clockwise[k]), s.anticlockwise[k], s.clockwise[k],
                s.speed[k]);
    free_spectrum(&s);
}

static void plot_oscillation(const JoxProbeDef *def, const void *state, bool walls, JoxText *out) {
    const Oscillation *o = state;
    (void)walls;
    if (fmin(round(def->span / def->every), o->intervals) < LEAST_SAMPLES) {
        jox_plot_reason(out, "too few intervals for a spectrum");
        return;
    }
    jox_text_printf(out,
                    "set xlabel 'frequency (rad/s)'\nset ylabel 'power (1: by chance)'\n"
                    "set xrange [0:3]\nset yrange [0:*]\nset key top right opaque\n"
                    "plot csv skip 1 using 1:2 with lines lw 2 lc '#1f77b4' title 'direction', "
                    "'' skip 1 using 1:3 with lines lw 1 dt 2 lc '#1f77b4' title "
                    "'anti-clockwise', "
                    "'' skip 1 using 1:4 with lines lw 1 dt 3 lc '#1f77b4' title 'clockwise', "
                    "'' skip 1 using 1:5 with lines lw 1.5 lc '#999999' title 'speed'\n");
}

const JoxProbeCalls jox_probe_oscillation = {
    JOX_PROBE_KIND(Oscillation, oscillation, 1000, 600),
    .frame = take_oscillation_frame,
    .pace = JOX_PACE_TENTH,
    .begin = begin_oscillation,
    .owned = {JOX_OWNED(Oscillation, cells), JOX_OWNED(Oscillation, frames)},
};
