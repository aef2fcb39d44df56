/* Probe `transit`: time from a person's last crossing of the first line, in either direction, to
   the next crossing of the second. Probe `visit`: time from entering one state to entering another.
   A person who comes again counts again. Inversions are the share of the pairs under way at the
   same time in which the one that began later ended first; 0 keeps the order, 0.5 is random
   order. */
#include <math.h>
#include <string.h>

#include "base/format/name.h"
#include "base/mem.h"
#include "base/number/statistics.h"
#include "record/probes/probe_parts.h"

/* s: if all began within this time, the plot treats them as one start. */
static const double COMMON_BEGINNING = 0.5;

typedef struct Passage {
    uint32_t key;
    double from, until; /* s */
} Passage;

typedef struct Transit {
    JoxTrack track;
    /* by key: time of the last crossing of the first line, or of entering the first state; NAN:
       not under way */
    double *since;
    uint32_t since_capacity;
    uint8_t *last_state; /* visit, by key: 1 in the first state, 2 in the second, else 0 */
    uint32_t last_state_capacity;
    Passage *passages;
    uint32_t count, capacity;
} Transit;

static void reserve_times(Transit *t, const JoxFrame *frame) {
    uint32_t had = t->since_capacity;
    JOX_RESERVE(t->since, t->since_capacity, frame->keys);
    for (uint32_t k = had; k < t->since_capacity; k++)
        t->since[k] = NAN;
}

static void add_transit(Transit *t, uint32_t key, double time) {
    JOX_RESERVE(t->passages, t->capacity, t->count + 1);
    t->passages[t->count++] = (Passage){key, t->since[key], time};
    t->since[key] = NAN;
}

static void take_transit_frame(const JoxProbeDef *def, void *state, const JoxFrame *frame,
                               const uint8_t *seen) {
    Transit *t = state;
    JoxStretch stretch;
    double time;
    jox_track_reserve(&t->track, frame);
    reserve_times(t, frame);
    for (uint32_t i = 0; i < frame->count; i++) {
        if (!seen[i] || !jox_track_step(&t->track, frame, i, &stretch))
            continue;
        double *since = &t->since[frame->key[i]];
        if (jox_stretch_crosses(&stretch, def->points[0], def->points[1], &time))
            *since = time;
        if (isfinite(*since) &&
            jox_stretch_crosses(&stretch, def->points[2], def->points[3], &time) && time >= *since)
            add_transit(t, frame->key[i], time);
    }
}

static uint8_t classify_state(const JoxProbeDef *def, const char *name) {
    return jox_name_is_within(name, def->states[0])   ? 1
           : jox_name_is_within(name, def->states[1]) ? 2
                                                      : 0;
}

/* Takes a frame of the probe `visit`: notes who enters the first state and who completes a visit
   by entering the second. */
static void take_visit_frame(const JoxProbeDef *def, void *state, const JoxFrame *frame,
                             const uint8_t *seen) {
    Transit *t = state;
    uint8_t states_of_interest[256] = {0};
    if (!frame->state)
        return;
    for (uint32_t s = 0; s < frame->state_count && s < 256; s++)
        states_of_interest[s] = classify_state(def, frame->states[s]);
    reserve_times(t, frame);
    JOX_RESERVE_ZEROED(t->last_state, t->last_state_capacity, frame->keys);
    for (uint32_t i = 0; i < frame->count; i++) {
        uint32_t key = frame->key[i];
        uint8_t now = frame->state[i] < 256 ? states_of_interest[frame->state[i]] : 0;
        if (seen[i] && now == 1 && t->last_state[key] != 1)
            t->since[key] = frame->time;
        if (seen[i] && now == 2 && t->last_state[key] != 2 && isfinite(t->since[key]))
            add_transit(t, key, frame->time);
        t->last_state[key] = now;
    }
}

/* Returns the share of the pairs under way at the same time that changed their order; NAN without
   pairs. */
static double measure_inversions(const Transit *t) {
    uint64_t pairs = 0, changed = 0;
    for (uint32_t a = 0; a < t->count; a++)
        for (uint32_t b = 0; b < a; b++) {
            const Passage *p = &t->passages[a], *q = &t->passages[b];
            if (p->from == q->from || p->from > q->until || q->from > p->until)
                continue;
            pairs++;
            changed += (p->from < q->from) != (p->until < q->until);
        }
    return pairs ? (double)changed / (double)pairs : NAN;
}

static void add_transit_figures(const JoxProbeDef *def, const void *state, JoxFigures *out) {
    const Transit *t = state;
    double *times = jox_alloc(t->count + 1, sizeof *times), sum = 0.0;
    uint32_t under_way = 0;
    for (uint32_t p = 0; p < t->count; p++)
        sum += times[p] = t->passages[p].until - t->passages[p].from;
    for (uint32_t k = 0; k < t->since_capacity; k++)
        under_way += isfinite(t->since[k]) != 0;
    jox_figure_add(out, "passages", "completed transits", "", t->count);
    jox_figure_add(out, "under_way", "people who are under way at the end", "", under_way);
    jox_figure_add(out, "mean", "time taken, mean", "s", t->count ? sum / t->count : NAN);
    jox_figure_add(out, "median", "time taken, median", "s", jox_quantile(times, t->count, 0.5));
    jox_figure_add(out, "p95", "time taken, 95th percentile", "s",
                   jox_quantile(times, t->count, 0.95));
    jox_figure_add(out, "least", "time taken, least", "s", jox_quantile(times, t->count, 0.0));
    jox_figure_add(out, "greatest", "time taken, greatest", "s",
                   jox_quantile(times, t->count, 1.0));
    if (def->kind == JOX_PROBE_VISIT)
        jox_figure_add(out, "inversions", "share of pairs that changed order", "",
                       measure_inversions(t));
    jox_free(times);
}

static void list_transit_sections(void *state, JoxSections *s) {
    Transit *t = state;
    jox_track_sections(&t->track, s);
    JOX_SECTION_ROOM(s, "since", t->since, t->since_capacity);
    JOX_SECTION_ROOM(s, "was", t->last_state, t->last_state_capacity);
    JOX_SECTION_ARRAY(s, "passages", t->passages, t->count, t->capacity);
}

static void write_transit_csv(const JoxProbeDef *def, const void *state, FILE *out) {
    (void)def;
    const Transit *t = state;
    fputs("person,from [s],until [s],transit [s]\n", out);
    for (uint32_t p = 0; p < t->count; p++)
        fprintf(out, "%u,%.4f,%.4f,%.4f\n", t->passages[p].key, t->passages[p].from,
                t->passages[p].until, t->passages[p].until - t->passages[p].from);
}

static void plot_transit(const JoxProbeDef *def, const void *state, bool walls, JoxText *out) {
    (void)walls;
    const Transit *t = state;
    if (t->count == 0) {
        jox_plot_reason(out, def->kind == JOX_PROBE_VISIT ? "nobody entered both states"
                                                          : "nobody crossed both lines");
        return;
    }
    double first = INFINITY, last = -INFINITY;
    for (uint32_t p = 0; p < t->count; p++) {
        first = fmin(first, t->passages[p].from);
        last = fmax(last, t->passages[p].from);
    }
    if (last - first < COMMON_BEGINNING) {
        jox_text_printf(out,
                        "set xlabel 'time to the end (s)'\nset ylabel 'people within that time'\n"
                        "set xrange [0:*]\nset yrange [0:*]\nset offsets 0, 0, 0.05, 0\nunset key\n"
                        "plot csv skip 1 using 4:(1) smooth cumulative with steps lw 2 lc "
                        "'#1f77b4'\n");
        return;
    }
    jox_text_printf(out,
                    "set xlabel 'time of the beginning (s)'\nset ylabel 'time to the end (s)'\n"
                    "set xrange [%g:%g]\nset yrange [0:*]\nset offsets 0, 0, 0.1, 0\nunset key\n"
                    "plot csv skip 1 using 2:4 with points pt 7 ps 0.8 lc '#1f77b4'\n",
                    first - 1.0, last + 1.0);
}

#define KIND(frames)                                                                               \
    {                                                                                              \
        JOX_PROBE_KIND(Transit, transit, 1000, 600), .frame = frames, .owned = {                   \
            JOX_OWNED(Transit, track.items),                                                       \
            JOX_OWNED(Transit, since),                                                             \
            JOX_OWNED(Transit, last_state),                                                        \
            JOX_OWNED(Transit, passages)                                                           \
        }                                                                                          \
    }
const JoxProbeCalls jox_probe_transit = KIND(take_transit_frame),
                    jox_probe_visit = KIND(take_visit_frame);
