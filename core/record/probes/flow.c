/* Probe `flow`: flow through a line. N(t) counts the passages; the mean flow is that of the middle
   60 % of them, which leaves out how a crowd arrives at a door and how it ends. Specific flow is
   the flow per metre of clear width, the part of the line that walls leave open about its middle. A
   person who steps back over the line revokes the last passage. Probe `measure` uses a flow, too
   (jox_flow_*). */
#include <math.h>

#include "base/mem.h"
#include "base/number/statistics.h"
#include "base/sort.h"
#include "record/probes/probe_parts.h"

static const double TAIL = 0.2;  /* share of the passages left out at each end */
static const double LEAST = 1.0; /* s: shortest duration for a flow; below it, two people passing
                                    side by side would give a great one */
static const char FEW[] = "not known: fewer than two passages, or all within a second";

typedef struct Crossing {
    double time; /* s */
    uint32_t key;
    int direction;
    uint8_t valid;     /* 0 or 1: a forward passage that was not revoked */
    uint32_t previous; /* 1 + index of the person's last valid passage before this one; 0: none */
} Crossing;

typedef struct Flow {
    JoxTrack track;
    uint32_t *latest; /* by key: 1 + index of the last valid passage; 0: none */
    uint32_t latest_capacity;
    Crossing *crossings;
    uint32_t count, capacity, forward, back, valid_count;
    double width; /* m: clear width about the middle of the line; 0 before the first frame */
} Flow;

/* Adds a crossing. A backward one revokes the last valid passage of that person, and the one
   before becomes the last. */
static void add_flow_crossing(Flow *f, uint32_t key, int direction, double time) {
    JOX_RESERVE(f->crossings, f->capacity, f->count + 1);
    Crossing *c = &f->crossings[f->count++];
    *c = (Crossing){time, key, direction, direction > 0, 0};
    uint32_t *latest = &f->latest[key];
    if (direction > 0) {
        f->forward++;
        f->valid_count++;
        c->previous = *latest;
        *latest = f->count;
        return;
    }
    f->back++;
    if (*latest) {
        f->crossings[*latest - 1].valid = false;
        f->valid_count--;
        *latest = f->crossings[*latest - 1].previous;
    }
}

void jox_flow_frame(const JoxV2 line[2], void *state, const JoxFrame *frame, const uint8_t *seen) {
    Flow *f = state;
    JoxStretch stretch;
    double time;
    uint32_t had = f->latest_capacity;
    JoxWallOpenings openings;
    jox_walls_openings(frame->walls, line, &openings);
    f->width = (double)openings.width;
    jox_track_reserve(&f->track, frame);
    JOX_RESERVE(f->latest, f->latest_capacity, frame->keys);
    for (uint32_t k = had; k < f->latest_capacity; k++)
        f->latest[k] = 0;
    for (uint32_t i = 0; i < frame->count; i++) {
        if (!seen[i] || !jox_track_step(&f->track, frame, i, &stretch))
            continue;
        int direction = jox_stretch_crosses(&stretch, line[0], line[1], &time);
        if (direction)
            add_flow_crossing(f, frame->key[i], direction, time);
    }
}

static void take_flow_frame(const JoxProbeDef *def, void *state, const JoxFrame *frame,
                            const uint8_t *seen) {
    jox_flow_frame(def->points, state, frame, seen);
}

void *jox_flow_create(void) {
    return jox_alloc(1, sizeof(Flow));
}

void jox_flow_free(void *state) {
    Flow *f = state;
    if (!f)
        return;
    jox_free(f->track.items);
    jox_free(f->latest);
    jox_free(f->crossings);
    jox_free(f);
}

/* Returns whether all indices of passages are in range, as after a restore. */
static bool are_passages_in_range(const Flow *f) {
    for (uint32_t k = 0; k < f->latest_capacity; k++)
        if (f->latest[k] > f->count)
            return false;
    for (uint32_t c = 0; c < f->count; c++)
        if (f->crossings[c].previous > c)
            return false;
    return true;
}

void jox_flow_sections(void *state, JoxSections *s) {
    Flow *f = state;
    jox_track_sections(&f->track, s);
    JOX_SECTION_ROOM(s, "latest", f->latest, f->latest_capacity);
    JOX_SECTION_ARRAY(s, "crossings", f->crossings, f->count, f->capacity);
    JOX_SECTION(s, "forward", f->forward);
    JOX_SECTION(s, "back", f->back);
    JOX_SECTION(s, "standing", f->valid_count);
    JOX_SECTION(s, "width", f->width);
    if (!s->failed && !are_passages_in_range(f))
        jox_sections_fail(s, "crossings", "an index of a passage is out of range");
    if (s->failed)
        f->count = f->latest_capacity = 0;
}

static void list_flow_sections(void *state, JoxSections *s) {
    jox_flow_sections(state, s);
}

uint32_t jox_flow_passages(const void *state) {
    return ((const Flow *)state)->valid_count;
}

uint32_t jox_flow_backward_crossings(const void *state) {
    const Flow *f = state;
    return f->forward ? 0 : f->back;
}

/* Returns the times of the valid passages, s, in ascending order; the caller frees them. */
static double *collect_passage_times(const Flow *f, size_t *count) {
    double *times = jox_alloc(f->count + 1, sizeof *times);
    *count = 0;
    for (uint32_t c = 0; c < f->count; c++)
        if (f->crossings[c].valid)
            times[(*count)++] = f->crossings[c].time;
    jox_quantile(times, *count, 0.0); /* sorts them */
    return times;
}

/* Sets the first and last passage of the middle 60 %; returns false for fewer than two. */
static bool find_middle_passages(size_t count, size_t *first, size_t *last) {
    *first = (size_t)floor(TAIL * (double)count);
    *last = (size_t)ceil((1.0 - TAIL) * (double)count);
    *last = *last ? *last - 1 : 0;
    return count >= 2 && *last > *first;
}

static double compute_flow(const double *times, size_t first, size_t last) {
    double spent = times[last] - times[first];
    return spent >= LEAST ? (double)(last - first) / spent : NAN;
}

static void add_flow_figures(const JoxProbeDef *def, const void *state, JoxFigures *out) {
    (void)def;
    const Flow *f = state;
    size_t count, first, last;
    double *times = collect_passage_times(f, &count),
           *lapses = jox_alloc(count + 1, sizeof *lapses);
    double flow =
        find_middle_passages(count, &first, &last) ? compute_flow(times, first, last) : NAN;
    for (size_t i = 1; i < count; i++)
        lapses[i - 1] = times[i] - times[i - 1];
    size_t gaps = count ? count - 1 : 0;
    jox_figure_add(out, "passages", "people who passed, less those who came back", "",
                   (double)count);
    jox_figure_add(out, "forward", "crossings from right to left of the line", "", f->forward);
    jox_figure_add(out, "back", "crossings from left to right of the line", "", f->back);
    jox_figure_add(out, "flow", "flow over the middle 60 % of the passages", "1/s", flow);
    jox_figure_set_reason(out, FEW);
    jox_figure_add(out, "flow_all", "flow from the first to the last passage", "1/s",
                   count >= 2 ? compute_flow(times, 0, count - 1) : NAN);
    jox_figure_set_reason(out, FEW);
    jox_figure_add(out, "specific_flow", "flow over the middle 60 % per metre of the opening",
                   "1/(m s)", f->width > 0.0 ? flow / f->width : NAN);
    jox_figure_set_reason(out, FEW);
    jox_figure_add(out, "lapse_median", "median time between passages", "s",
                   jox_quantile(lapses, gaps, 0.5));
    jox_figure_add(out, "lapse_max", "longest time between passages", "s",
                   jox_quantile(lapses, gaps, 1.0));
    jox_figure_add(out, "first", "time of the first passage", "s", count ? times[0] : NAN);
    jox_figure_add(out, "last", "time of the last passage", "s", count ? times[count - 1] : NAN);
    jox_figure_add(out, "duration", "time from the first to the last passage", "s",
                   count ? times[count - 1] - times[0] : NAN);
    jox_free(times);
    jox_free(lapses);
}

bool jox_flow_middle(const void *state, double *from, double *to) {
    size_t count, first, last;
    double *times = collect_passage_times(state, &count);
    const bool any = find_middle_passages(count, &first, &last);
    if (any) {
        *from = times[first];
        *to = times[last];
    }
    jox_free(times);
    return any;
}

static int compare_crossing_times(const void *a, const void *b, const void *context) {
    (void)context;
    const Crossing *x = a, *y = b;
    if (x->time != y->time)
        return x->time < y->time ? -1 : 1;
    return (x->key > y->key) - (x->key < y->key);
}

static void write_flow_csv(const JoxProbeDef *def, const void *state, FILE *out) {
    (void)def;
    const Flow *f = state;
    Crossing *sorted = jox_alloc(f->count + 1, sizeof *sorted);
    for (uint32_t c = 0; c < f->count; c++)
        sorted[c] = f->crossings[c];
    jox_sort(sorted, f->count, sizeof *sorted, compare_crossing_times, NULL, NULL);
    fputs("time [s],person,direction,passages,lapse [s]\n", out);
    double before = NAN;
    uint32_t passed = 0;
    for (uint32_t c = 0; c < f->count; c++) {
        const Crossing *s = &sorted[c];
        passed += s->valid != 0;
        fprintf(out, "%.4f,%u,%d,%u,", s->time, s->key, s->direction, passed);
        if (s->valid && isfinite(before))
            fprintf(out, "%.4f\n", s->time - before);
        else
            fputs("nan\n", out);
        before = s->valid ? s->time : before;
    }
    jox_free(sorted);
}

static void plot_flow(const JoxProbeDef *def, const void *state, bool walls, JoxText *out) {
    (void)def;
    (void)walls;
    const Flow *f = state;
    size_t count, first, last;
    if (f->count == 0) {
        jox_plot_reason(out, "nobody crossed the line");
        return;
    }
    double *times = collect_passage_times(f, &count);
    double flow =
        find_middle_passages(count, &first, &last) ? compute_flow(times, first, last) : NAN;
    jox_text_printf(out,
                    "unset title\nset multiplot layout 2,1 title heading font ',14' noenhanced\n"
                    "set key top left\nset xlabel 'time (s)'\nset xrange [%g:%g]\n"
                    "set ylabel 'passages'\nset yrange [0:%g]\n"
                    "plot csv skip 1 using 1:4 with steps lw 2 lc '#1f77b4' title 'N(t)'",
                    floor(f->crossings[0].time) - 1, f->crossings[f->count - 1].time + 1,
                    1.1 * (double)count + 1);
    if (isfinite(flow))
        jox_text_printf(out,
                        ", [%g:%g] %zu + %.9g * (x - %.9g) with lines lw 2 dt 2 lc '#d62728' "
                        "title sprintf('middle 60 %%%%: %%.3g people/s', %.9g)",
                        times[first], times[last], first + 1, flow, times[first], flow);
    if (count >= 2)
        jox_text_printf(out, "\nset ylabel 'lapse since the one before (s)'\nset yrange [0:*]\n"
                             "plot csv skip 1 using 1:5 with impulses lw 2 lc '#1f77b4' notitle\n");
    else
        jox_text_add(out, "\n");
    jox_free(times);
}

const JoxProbeCalls jox_probe_flow = {
    JOX_PROBE_KIND(Flow, flow, 1000, 800),
    .frame = take_flow_frame,
    .owned = {JOX_OWNED(Flow, track.items), JOX_OWNED(Flow, latest), JOX_OWNED(Flow, crossings)},
};
