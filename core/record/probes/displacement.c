/* Probe `displacement`: distance of each person from its place of rest, the mean position in the
   first `rest` seconds: at the end (residual), at most, and when it first exceeded `onset`; in all
   directions, or along one. Where a push travels through standing people, a least-squares fit of
   onset time over distance from the first person to move gives the speed of the front. */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "base/number/statistics.h"
#include "record/probes/probe_parts.h"
#include "record/storey_figures.h"

typedef struct Person {
    uint8_t known;        /* 0 or 1; not a bool, since a checkpoint may hold any byte */
    float x, y;           /* m: first position */
    float dx, dy;         /* m: displacement since then, along the path where edges are periodic */
    float base_x, base_y; /* m: mean displacement while at rest */
    uint32_t rested;      /* frames at rest */
    float now, most;      /* m: distance from the place of rest, now and at most */
    /* s: time of the first position; time at which `onset` metres were exceeded, NAN: not yet */
    double since, onset;
} Person;

typedef struct Displacement {
    JoxTrack track;
    Person *people; /* by key */
    uint32_t capacity;
    double pace; /* s: longest time between two frames */
} Displacement;

/* Returns the distance from the place of rest, m: along the direction of the probe, else in any
   direction. */
static float measure_displacement(const JoxProbeDef *def, const Person *p) {
    JoxV2 away = {p->dx - p->base_x, p->dy - p->base_y};
    return def->count ? fabsf(jox_dot(away, jox_unit(def->points[0]))) : jox_length(away);
}

/* Adds a step to the displacement: to the place of rest in the first `rest` seconds, then to
   maximum and onset. */
static void move_person(const JoxProbeDef *def, Person *p, const JoxStretch *stretch) {
    p->dx += stretch->by.x;
    p->dy += stretch->by.y;
    if (stretch->ended - p->since < def->rest - 1e-9) {
        p->base_x += (p->dx - p->base_x) / (float)(p->rested + 1);
        p->base_y += (p->dy - p->base_y) / (float)(p->rested + 1);
        p->rested++;
        return;
    }
    float before = p->now;
    p->now = measure_displacement(def, p);
    p->most = jox_maxf(p->most, p->now);
    if (isnan(p->onset) && p->now > def->onset) {
        double share = p->now > before ? (def->onset - before) / (p->now - before) : 1.0;
        p->onset = stretch->begun + share * (stretch->ended - stretch->begun);
    }
}

static void take_displacement_frame(const JoxProbeDef *def, void *state, const JoxFrame *frame,
                                    const uint8_t *seen) {
    Displacement *d = state;
    jox_track_reserve(&d->track, frame);
    JOX_RESERVE_ZEROED(d->people, d->capacity, frame->keys);
    for (uint32_t i = 0; i < frame->count; i++) {
        if (!seen[i])
            continue;
        Person *p = &d->people[frame->key[i]];
        JoxStretch stretch;
        if (!jox_track_step(&d->track, frame, i, &stretch))
            *p = (Person){.known = true,
                          .x = frame->x[i],
                          .y = frame->y[i],
                          .rested = 1,
                          .since = frame->time,
                          .onset = NAN};
        else {
            move_person(def, p, &stretch);
            d->pace = fmax(d->pace, stretch.ended - stretch.begun);
        }
    }
}

/* Returns the speed of the front, m/s; NAN with a reason if there is none. Times are no finer than
   frames: if everybody begins to move within the time between two frames, the front has no
   measurable speed. The slope of time over distance must exceed twice its standard error. */
static double fit_front_speed(const JoxProbeDef *def, const Displacement *d, const char **why) {
    const Person *first = NULL;
    double n = 0, s = 0, t = 0, ss = 0, st = 0, tt = 0, last = 0;
    for (uint32_t k = 0; k < d->capacity; k++)
        if (d->people[k].known && isfinite(d->people[k].onset) &&
            (!first || d->people[k].onset < first->onset))
            first = &d->people[k];
    for (uint32_t k = 0; first && k < d->capacity; k++) {
        const Person *p = &d->people[k];
        if (!p->known || !isfinite(p->onset))
            continue;
        JoxV2 apart = {p->x + p->base_x - first->x - first->base_x,
                       p->y + p->base_y - first->y - first->base_y};
        double away =
            def->count ? fabsf(jox_dot(apart, jox_unit(def->points[0]))) : jox_length(apart);
        double after = p->onset - first->onset;
        n++, s += away, t += after;
        ss += away * away, st += away * after, tt += after * after;
        last = fmax(last, after);
    }
    const double spread = n * ss - s * s;
    *why = NULL;
    if (n < 3)
        *why = "not known: fewer than three people were moved";
    else if (last <= d->pace)
        *why = "not known: all began to move at once, within the time between two frames";
    else if (!(spread > 0.0))
        *why = "not known: all who moved stood equally far from the first";
    if (*why)
        return NAN;
    const double slope = (n * st - s * t) / spread;
    const double rest = fmax(tt - t * t / n - slope * slope * spread / n, 0.0);
    const double error = sqrt(n * rest / ((n - 2.0) * spread));
    if (slope > 2.0 * error && slope > 0.0)
        return 1.0 / slope;
    *why = "not known: those farther off did not begin to move later";
    return NAN;
}

static void add_displacement_figures(const JoxProbeDef *def, const void *state, JoxFigures *out) {
    const Displacement *d = state;
    double *ends = jox_alloc(d->capacity + 1, sizeof *ends), sum = 0.0, peaks = 0.0, peak = NAN;
    uint32_t count = 0, moved = 0;
    for (uint32_t k = 0; k < d->capacity; k++) {
        const Person *p = &d->people[k];
        if (!p->known)
            continue;
        sum += ends[count++] = p->now;
        peaks += p->most;
        peak = isnan(peak) || p->most > peak ? p->most : peak;
        moved += isfinite(p->onset) != 0;
    }
    jox_figure_add(out, "people", "people", "", count);
    jox_figure_add(out, "moved", "people who were moved", "", moved);
    jox_figure_add(out, "mean", "mean displacement at the end", "m", count ? sum / count : NAN);
    jox_figure_add(out, "median", "median displacement at the end", "m",
                   jox_quantile(ends, count, 0.5));
    jox_figure_add(out, "greatest", "greatest displacement at the end", "m",
                   jox_quantile(ends, count, 1.0));
    jox_figure_add(out, "peak_mean", "mean of the greatest displacements", "m",
                   count ? peaks / count : NAN);
    jox_figure_add(out, "peak", "greatest displacement at any time", "m", peak);
    const char *why;
    const double front = fit_front_speed(def, d, &why);
    jox_figure_add(out, "front_speed", "speed of the push front", "m/s", front);
    jox_figure_set_reason(out, why);
    jox_free(ends);
}

static void list_displacement_sections(void *state, JoxSections *s) {
    Displacement *d = state;
    jox_track_sections(&d->track, s);
    JOX_SECTION_ROOM(s, "people", d->people, d->capacity);
    JOX_SECTION(s, "pace", d->pace);
}

static void write_displacement_csv(const JoxProbeDef *def, const void *state, FILE *out) {
    const Displacement *d = state;
    fputs("person,x [m],y [m],dx [m],dy [m],residual [m],peak [m],onset [s]", out);
    jox_csv_put_storey_title(out, def->storeys);
    fputc('\n', out);
    for (uint32_t k = 0; k < d->capacity; k++) {
        const Person *p = &d->people[k];
        if (!p->known)
            continue;
        const JoxV2 at = {(float)(p->x + p->base_x), (float)(p->y + p->base_y)};
        const JoxV2 plan = jox_in_plan(def->storeys, at);
        fprintf(out, "%u,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,", k, (double)plan.x, (double)plan.y,
                p->dx - p->base_x, p->dy - p->base_y, p->now, p->most);
        fprintf(out, isfinite(p->onset) ? "%.4f" : "nan", p->onset);
        jox_csv_put_storey(out, def->storeys, at, true);
        fputc('\n', out);
    }
}

static void plot_displacement(const JoxProbeDef *def, const void *state, bool walls, JoxText *out) {
    (void)def;
    const Displacement *d = state;
    JoxV2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (uint32_t k = 0; k < d->capacity; k++) {
        const Person *p = &d->people[k];
        if (!p->known)
            continue;
        low = jox_v2(jox_minf(low.x, jox_minf(p->x, p->x + p->dx)),
                     jox_minf(low.y, jox_minf(p->y, p->y + p->dy)));
        high = jox_v2(jox_maxf(high.x, jox_maxf(p->x, p->x + p->dx)),
                      jox_maxf(high.y, jox_maxf(p->y, p->y + p->dy)));
    }
    if (low.x > high.x) {
        jox_plot_reason(out, "nobody was seen");
        return;
    }
    /* Give gnuplot a colour range: it warns where all values are equal. */
    double most = 0.0;
    for (uint32_t k = 0; k < d->capacity; k++)
        most = d->people[k].known ? fmax(most, d->people[k].now) : most;
    float margin = 0.3f + 0.03f * jox_maxf(high.x - low.x, high.y - low.y);
    jox_text_printf(out,
                    "set size ratio -1\nset xlabel 'x (m)'\nset ylabel 'y (m)'\nunset key\n"
                    "set cblabel 'distance from where first seen (m)'\nset cbrange [0:%g]\n"
                    "set xrange [%g:%g]\nset yrange [%g:%g]\nplot ",
                    most > 0.0 ? most : 1.0, low.x - margin, high.x + margin, low.y - margin,
                    high.y + margin);
    if (walls)
        jox_text_add(out, "'walls.dat' using 1:2 with lines lw 2 lc 'black', ");
    jox_text_printf(out,
                    "csv skip 1 using 2:3 with points pt 6 ps 0.8 lc '#888888', "
                    "'' skip 1 using 2:3:4:5:6 with vectors head filled size graph 0.012,20 lw 1.5 "
                    "lc palette\n");
}

const JoxProbeCalls jox_probe_displacement = {
    JOX_PROBE_KIND(Displacement, displacement, 1000, 900),
    .frame = take_displacement_frame,
    .pace = JOX_PACE_ALL, /* a front passes a person in less than a tenth of a second */
    .owned = {JOX_OWNED(Displacement, track.items), JOX_OWNED(Displacement, people)},
};
