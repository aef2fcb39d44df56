/* Probe `lanes`: order parameter of lanes. The area is cut into rows along the walking direction.
   In a row of n people, s of them walking one way and o the other, each person has (s - o)^2 / n^2;
   the order parameter is the mean over all people (Rex and Loewen 2007, doi
   10.1103/PhysRevE.75.051402; Nowak and Schadschneider 2012, doi 10.1103/PhysRevE.85.066128). It is
   1 where each row walks one way. People placed at random have about the number of rows over the
   number of people: `random`. If the probe names two groups, these are the two ways; else the sign
   of the velocity along the rows is. */
#include <math.h>

#include "base/mem.h"
#include "record/probes/probe_parts.h"

static const float STANDS = 0.02f; /* m/s: slower people count as standing */
enum { MOST_ROWS = 10000 };

typedef struct LaneRow {
    double time, order, random, density, speed;
    uint32_t people;
} LaneRow;

typedef struct Lanes {
    uint32_t *ahead, *back; /* number of people in each row, by way */
    uint32_t rows;
    LaneRow *items;
    uint32_t count, capacity;
} Lanes;

static void begin_lanes(const JoxProbeDef *def, void *state) {
    Lanes *l = state;
    double across = def->along_y ? def->high.x - def->low.x : def->high.y - def->low.y;
    l->rows = (uint32_t)fmin(ceil(across / def->rows - 1e-6), MOST_ROWS);
    l->rows = l->rows ? l->rows : 1;
    l->ahead = jox_alloc(l->rows, sizeof *l->ahead);
    l->back = jox_alloc(l->rows, sizeof *l->back);
}

/* Returns the way of person i, +1 or -1; 0: standing. */
static int find_walking_way(const JoxProbeDef *def, const JoxFrame *frame, uint32_t i) {
    if (def->group_count == 2 && frame->group)
        return frame->group[i] == def->groups[0] ? 1 : -1;
    float v = def->along_y ? frame->vy[i] : frame->vx[i];
    return v > STANDS ? 1 : v < -STANDS ? -1 : 0;
}

/* Counts walkers by row and way, and adds the order parameter of this frame. */
static void take_lanes_frame(const JoxProbeDef *def, void *state, const JoxFrame *frame,
                             const uint8_t *seen) {
    Lanes *l = state;
    LaneRow now = {.time = frame->time};
    uint32_t used = 0;
    double order = 0.0, speed = 0.0;
    for (uint32_t r = 0; r < l->rows; r++)
        l->ahead[r] = l->back[r] = 0;
    for (uint32_t i = 0; i < frame->count; i++) {
        float x = frame->x[i], y = frame->y[i];
        int way = seen[i] ? find_walking_way(def, frame, i) : 0;
        if (way == 0 || x < def->low.x || x >= def->high.x || y < def->low.y || y >= def->high.y)
            continue;
        double across = def->along_y ? x - def->low.x : y - def->low.y;
        uint32_t row = (uint32_t)(across / def->rows);
        row = row < l->rows ? row : l->rows - 1;
        *(way > 0 ? &l->ahead[row] : &l->back[row]) += 1;
        now.people++;
        speed += fabs(def->along_y ? frame->vy[i] : frame->vx[i]);
    }
    for (uint32_t r = 0; r < l->rows; r++) {
        double all = l->ahead[r] + l->back[r], more = (double)l->ahead[r] - l->back[r];
        used += all > 0.0;
        order += all > 0.0 ? more * more / all : 0.0; /* n people with (s - o)^2 / n^2 each */
    }
    if (now.people == 0)
        return;
    now.order = order / now.people;
    now.random = (double)used / now.people;
    now.density =
        now.people / (((double)def->high.x - def->low.x) * ((double)def->high.y - def->low.y));
    now.speed = speed / now.people;
    JOX_RESERVE(l->items, l->capacity, l->count + 1);
    l->items[l->count++] = now;
}

static void add_lanes_figures(const JoxProbeDef *def, const void *state, JoxFigures *out) {
    (void)def;
    const Lanes *l = state;
    double order = 0, random = 0, density = 0, speed = 0, n = l->count ? l->count : NAN;
    for (uint32_t i = 0; i < l->count; i++) {
        order += l->items[i].order;
        random += l->items[i].random;
        density += l->items[i].density;
        speed += l->items[i].speed;
    }
    jox_figure_add(out, "samples", "samples", "", l->count);
    jox_figure_add(out, "order", "order of the lanes, mean (1: all in lanes)", "", order / n);
    jox_figure_add(out, "order_last", "order of the lanes at the end", "",
                   l->count ? l->items[l->count - 1].order : NAN);
    jox_figure_add(out, "random", "order of people placed at random", "", random / n);
    jox_figure_add(out, "density", "density by counting, mean", "1/m2", density / n);
    jox_figure_add(out, "speed", "speed, mean", "m/s", speed / n);
}

static void list_lanes_sections(void *state, JoxSections *s) {
    Lanes *l = state;
    JOX_SECTION_ARRAY(s, "items", l->items, l->count, l->capacity);
}

static void write_lanes_csv(const JoxProbeDef *def, const void *state, FILE *out) {
    (void)def;
    const Lanes *l = state;
    fputs("time [s],order,random,people,density [1/m2],speed [m/s]\n", out);
    for (uint32_t i = 0; i < l->count; i++)
        fprintf(out, "%.4f,%.5g,%.5g,%u,%.5g,%.5g\n", l->items[i].time, l->items[i].order,
                l->items[i].random, l->items[i].people, l->items[i].density, l->items[i].speed);
}

static void plot_lanes(const JoxProbeDef *def, const void *state, bool walls, JoxText *out) {
    (void)def;
    const Lanes *l = state;
    (void)walls;
    if (l->count == 0) {
        jox_plot_reason(out, "nobody walked in the area");
        return;
    }
    jox_text_printf(out, "set xlabel 'time (s)'\nset ylabel 'order parameter of lanes'\n"
                         "set yrange [0:1.05]\nset key bottom right opaque\n"
                         "plot csv skip 1 using 1:2 with lines lw 2 lc '#1f77b4' title 'measured', "
                         "'' skip 1 using 1:3 with lines lw 1.5 dt 2 lc '#999999' title "
                         "'of people placed at random'\n");
}

const JoxProbeCalls jox_probe_lanes = {
    JOX_PROBE_KIND(Lanes, lanes, 1000, 600),
    .frame = take_lanes_frame,
    .pace = JOX_PACE_EVERY,
    .begin = begin_lanes,
    .owned = {JOX_OWNED(Lanes, ahead), JOX_OWNED(Lanes, back), JOX_OWNED(Lanes, items)},
};
