/* Transit: the time from a person's last crossing of the first line, in either direction, to the
   crossing of the second that follows. Who comes round again counts again. */
#include <math.h>

#include "base/mem.h"
#include "record/probe_parts.h"

typedef struct Passage {
    uint32_t key;
    double from, until; /* s */
} Passage;

typedef struct Transit {
    JoxTrack track;
    double *since; /* by key: when the first line was crossed; NAN: not on the way */
    uint32_t since_capacity;
    Passage *passages;
    uint32_t count, capacity;
} Transit;

static void frame(const JoxProbeDef *def, void *state, const JoxFrame *frame, const uint8_t *seen) {
    Transit *t = state;
    JoxStretch stretch;
    double time;
    uint32_t had = t->since_capacity;
    jox_track_reserve(&t->track, frame->keys);
    JOX_RESERVE(t->since, t->since_capacity, frame->keys);
    for (uint32_t k = had; k < t->since_capacity; k++)
        t->since[k] = NAN;
    for (uint32_t i = 0; i < frame->count; i++) {
        if (!seen[i] || !jox_track_step(&t->track, frame, i, &stretch))
            continue;
        double *since = &t->since[frame->key[i]];
        if (jox_stretch_crosses(&stretch, def->points[0], def->points[1], &time))
            *since = time;
        if (isfinite(*since) &&
            jox_stretch_crosses(&stretch, def->points[2], def->points[3], &time) &&
            time >= *since) {
            JOX_RESERVE(t->passages, t->capacity, t->count + 1);
            t->passages[t->count++] = (Passage){frame->key[i], *since, time};
            *since = NAN;
        }
    }
}

static void figures(const JoxProbeDef *def, const void *state, JoxFigures *out) {
    (void)def;
    const Transit *t = state;
    double *times = jox_alloc(t->count + 1, sizeof *times), sum = 0.0;
    uint32_t under_way = 0;
    for (uint32_t p = 0; p < t->count; p++)
        sum += times[p] = t->passages[p].until - t->passages[p].from;
    for (uint32_t k = 0; k < t->since_capacity; k++)
        under_way += isfinite(t->since[k]) != 0;
    jox_figure_add(out, "passages", "", t->count);
    jox_figure_add(out, "under_way", "", under_way);
    jox_figure_add(out, "mean", "s", t->count ? sum / t->count : NAN);
    jox_figure_add(out, "median", "s", jox_quantile(times, t->count, 0.5));
    jox_figure_add(out, "p95", "s", jox_quantile(times, t->count, 0.95));
    jox_figure_add(out, "least", "s", jox_quantile(times, t->count, 0.0));
    jox_figure_add(out, "greatest", "s", jox_quantile(times, t->count, 1.0));
    jox_free(times);
}

static void csv(const JoxProbeDef *def, const void *state, FILE *out) {
    (void)def;
    const Transit *t = state;
    fputs("person,from [s],until [s],transit [s]\n", out);
    for (uint32_t p = 0; p < t->count; p++)
        fprintf(out, "%u,%.4f,%.4f,%.4f\n", t->passages[p].key, t->passages[p].from,
                t->passages[p].until, t->passages[p].until - t->passages[p].from);
}

static void plot(const JoxProbeDef *def, const void *state, bool walls, JoxText *out) {
    (void)walls;
    const Transit *t = state;
    if (t->count == 0) {
        jox_plot_nothing(out, "nobody crossed both lines");
        return;
    }
    double first = INFINITY, last = -INFINITY;
    for (uint32_t p = 0; p < t->count; p++) {
        first = fmin(first, t->passages[p].from);
        last = fmax(last, t->passages[p].from);
    }
    jox_text_printf(out,
                    "set xlabel 'time of the first line (s)'\nset ylabel 'transit time (s)'\n"
                    "set xrange [%g:%g]\nset yrange [0:*]\nset offsets 0, 0, 0.1, 0\nunset key\n"
                    "plot '%s.csv' skip 1 using 2:4 with points pt 7 ps 0.8 lc '#1f77b4'\n",
                    first - 1.0, last + 1.0, def->name);
}

static void release(void *state) {
    Transit *t = state;
    jox_free(t->track.items);
    jox_free(t->since);
    jox_free(t->passages);
}

const JoxProbeCalls jox_probe_transit = {.size = sizeof(Transit),
                                         .frame = frame,
                                         .figures = figures,
                                         .csv = csv,
                                         .plot = plot,
                                         .width = 1000,
                                         .height = 600,
                                         .release = release};
