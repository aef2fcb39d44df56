/* Probe `winding`: turns of each person about a point, anti-clockwise positive, and the least
   running sum: at -1 or below, the person went a whole lap clockwise at some time. A turn between
   two frames is taken the short way, so nobody may pass the point within one frame. */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "base/number/pi.h"
#include "base/number/statistics.h"
#include "record/probes/probe_parts.h"

typedef struct Turning {
    uint8_t known; /* 0 or 1; not a bool, since a checkpoint may hold any byte */
    double angle, turns, least, greatest, since, until; /* rad; turns; turns; turns; s; s */
} Turning;

typedef struct Winding {
    Turning *people; /* by key */
    uint32_t capacity;
} Winding;

static void take_winding_frame(const JoxProbeDef *def, void *state, const JoxFrame *frame,
                               const uint8_t *seen) {
    Winding *w = state;
    JOX_RESERVE_ZEROED(w->people, w->capacity, frame->keys);
    for (uint32_t i = 0; i < frame->count; i++) {
        if (!seen[i])
            continue;
        Turning *p = &w->people[frame->key[i]];
        double angle =
            atan2((double)frame->y[i] - def->points[0].y, (double)frame->x[i] - def->points[0].x);
        if (p->known) {
            p->turns += remainder(angle - p->angle, JOX_TURN) / JOX_TURN;
            p->least = fmin(p->least, p->turns);
            p->greatest = fmax(p->greatest, p->turns);
        } else {
            p->since = frame->time;
        }
        p->until = frame->time;
        p->known = true;
        p->angle = angle;
    }
}

static void add_winding_figures(const JoxProbeDef *def, const void *state, JoxFigures *out) {
    (void)def;
    const Winding *w = state;
    double *turns = jox_alloc(w->capacity + 1, sizeof *turns), sum = 0.0, lowest = NAN;
    uint32_t count = 0, clockwise = 0;
    for (uint32_t k = 0; k < w->capacity; k++) {
        const Turning *p = &w->people[k];
        if (!p->known)
            continue;
        sum += turns[count++] = p->turns;
        clockwise += p->least <= -1.0;
        lowest = p->least < lowest || isnan(lowest) ? p->least : lowest;
    }
    jox_figure_add(out, "people", "people", "", count);
    jox_figure_add(out, "mean", "turns, mean", "turns", count ? sum / count : NAN);
    jox_figure_add(out, "median", "turns, median", "turns", jox_quantile(turns, count, 0.5));
    jox_figure_add(out, "least", "turns, least", "turns", jox_quantile(turns, count, 0.0));
    jox_figure_add(out, "greatest", "turns, greatest", "turns", jox_quantile(turns, count, 1.0));
    jox_figure_add(out, "least_running", "least running sum of turns", "turns", lowest);
    jox_figure_add(out, "clockwise_laps", "people with a whole clockwise lap", "", clockwise);
    jox_free(turns);
}

static void list_winding_sections(void *state, JoxSections *s) {
    Winding *w = state;
    JOX_SECTION_ROOM(s, "people", w->people, w->capacity);
}

static void write_winding_csv(const JoxProbeDef *def, const void *state, FILE *out) {
    (void)def;
    const Winding *w = state;
    fputs("person,since [s],turns,least_running,greatest_running,until [s]\n", out);
    for (uint32_t k = 0; k < w->capacity; k++)
        if (w->people[k].known)
            fprintf(out, "%u,%.3f,%.5f,%.5f,%.5f,%.3f\n", k, w->people[k].since, w->people[k].turns,
                    w->people[k].least, w->people[k].greatest, w->people[k].until);
}

static void plot_winding(const JoxProbeDef *def, const void *state, bool walls, JoxText *out) {
    (void)def;
    const Winding *w = state;
    double least = INFINITY, greatest = -INFINITY;
    (void)walls;
    for (uint32_t k = 0; k < w->capacity; k++)
        if (w->people[k].known) {
            least = fmin(least, w->people[k].least);
            greatest = fmax(greatest, w->people[k].greatest);
        }
    if (least > greatest) {
        jox_plot_reason(out, "nobody was seen");
        return;
    }
    double most = fmax(greatest, -least);
    double wide = most > 20.0  ? 1.0
                  : most > 4.0 ? 0.25
                  : most > 1.0 ? 0.1
                               : 0.05; /* turns: width of a bin */
    jox_text_printf(out,
                    "w = %g\nset xlabel 'turns, anti-clockwise'\nset ylabel 'people'\n"
                    "set key top right opaque\nset yrange [0:*]\nset boxwidth w\n"
                    "set style fill transparent solid 0.6\nset xrange [%g:%g]\n"
                    "plot csv skip 1 using (w * (floor($3 / w) + 0.5)):(1) smooth frequency "
                    "with boxes lc '#1f77b4' title 'at the end', '' skip 1 using "
                    "(w * (floor($4 / w) + 0.5)):(1) smooth frequency with boxes lc '#d62728' "
                    "title 'least at any time'\n",
                    wide, (floor(least / wide) - 1.0) * wide,
                    (floor(greatest / wide) + 2.0) * wide);
}

const JoxProbeCalls jox_probe_winding = {
    JOX_PROBE_KIND(Winding, winding, 1000, 600),
    .frame = take_winding_frame,
    .owned = {JOX_OWNED(Winding, people)},
};
