/* Probe `measure`: people in a polygon, per interval of `every` seconds. In each frame it takes

   - the number of people inside
   - the classical density, number over area
   - the Voronoi density, the mean over the area of one over the cell's area (Steffen and Seyfried
     2010, equation 5); cells end at walls, and people behind a wall are no neighbours
   - the mean speed of the people inside
   - the specific flow, Voronoi density times mean speed

   An interval has the mean over its frames, for speed and flow over the frames with people inside.
   Figures are means over the intervals with people inside; of these, a probe with a line `during`
   takes only intervals whose middle lies between the first and the last of the middle 60 % of the
   passages over that line. The deviation of speeds and the share of standing people, slower than
   0.05 m/s, are over all people and frames of these intervals: they contain slow steps and sway,
   not only differences between people. */
#include <math.h>

#include "base/mem.h"
#include "base/number/statistics.h"
#include "geom/polygon.h"
#include "record/fields/seam_images.h"
#include "record/fields/voronoi.h"
#include "record/probes/probe_parts.h"

static const double STANDS = 0.05; /* m/s: slower people count as standing */

typedef struct Interval {
    int64_t number;
    double people, classical, voronoi, speed, flow; /* sums over frames */
    double speeds, squares, standing;               /* sums over frames and people */
    uint32_t frames, walked;                        /* walked: frames with people inside */
} Interval;

typedef struct Measure {
    JoxV2 low, high;
    double area; /* m2 */
    JoxSites sites;
    JoxBars bars; /* edges of walls that may cut a cell */
    JoxSeamWalls seam_walls;
    Interval *rows;
    uint32_t count, capacity;
    void *line; /* flow over the line `during`; NULL without one */
} Measure;

static void begin_measure(const JoxProbeDef *def, void *state) {
    Measure *m = state;
    jox_bounds(def->points, def->count, &m->low, &m->high);
    m->area = fabs(jox_polygon_area(def->points, def->count));
    if (def->during_count == 2)
        m->line = jox_flow_create();
}

static bool is_near_polygon(const Measure *m, JoxV2 p, float reach) {
    return p.x >= m->low.x - reach && p.x <= m->high.x + reach && p.y >= m->low.y - reach &&
           p.y <= m->high.y + reach;
}

/* Collects all people, and their images across periodic edges and seams, that may shape a cell
   reaching into the polygon. */
static void gather_people(const JoxProbeDef *def, Measure *m, const JoxFrame *frame) {
    int across = frame->period.x > 0.0f, up = frame->period.y > 0.0f;
    const float reach = 3.0f * (float)def->cutoff;
    jox_sites_clear(&m->sites);
    m->sites.storeys = frame->storeys;
    for (uint32_t i = 0; i < frame->count; i++)
        for (int c = -across; c <= across; c++)
            for (int r = -up; r <= up; r++) {
                JoxV2 p = {frame->x[i] + (float)c * frame->period.x,
                           frame->y[i] + (float)r * frame->period.y};
                if (is_near_polygon(m, p, reach))
                    jox_sites_add(&m->sites, p, i);
            }
    for (uint32_t i = 0; frame->storeys && i < frame->count; i++)
        jox_seam_images_add(&m->sites, frame->storeys, (JoxV2){frame->x[i], frame->y[i]}, i, reach);
    jox_sites_sort(&m->sites, def->cutoff);
}

/* Collects wall edges near the polygon. A cell extends at most `cutoff` from its person, who is at
   most `cutoff` from the polygon. */
static void gather_walls_near_polygon(const JoxProbeDef *def, Measure *m, const JoxFrame *frame) {
    float reach = 2.0f * (float)def->cutoff;
    const JoxWalls *walls = jox_seam_walls_of(&m->seam_walls, frame->walls, frame->storeys);
    m->bars.count = 0;
    for (uint32_t w = 0; walls && w < walls->count; w++) {
        JoxV2 a = walls->vertices[w].point;
        JoxV2 b = walls->vertices[walls->vertices[w].next].point;
        if (walls->vertices[w].covered || jox_maxf(a.x, b.x) < m->low.x - reach ||
            jox_minf(a.x, b.x) > m->high.x + reach || jox_maxf(a.y, b.y) < m->low.y - reach ||
            jox_minf(a.y, b.y) > m->high.y + reach)
            continue;
        JOX_RESERVE(m->bars.items, m->bars.capacity, m->bars.count + 1);
        m->bars.items[m->bars.count++] = (struct JoxBar){a, b};
    }
}

/* Returns the mean Voronoi density of the polygon, 1/m2: each cell contributes its part inside
   the polygon over its area. */
static double measure_voronoi_density(const JoxProbeDef *def, Measure *m, const uint8_t *seen) {
    double sum = 0.0;
    for (uint32_t s = 0; s < m->sites.count; s++) {
        JoxV2 at = m->sites.points[s];
        JoxCell cell;
        if (!seen[m->sites.person[s]] || !is_near_polygon(m, at, (float)def->cutoff))
            continue;
        jox_sites_cell(&m->sites, s, def->cutoff, &cell);
        double whole, within;
        jox_cell_visible_area(&cell, at, &m->bars, def->points, def->count, &whole, &within);
        if (whole > 0.0)
            sum += within / whole;
    }
    return sum / m->area;
}

static Interval *find_measure_interval(const JoxProbeDef *def, Measure *m, double t) {
    /* A step that ends at the edge of an interval belongs to the interval before. */
    int64_t number = (int64_t)ceil((t - def->from) / def->every - 1e-6) - 1;
    number = number > 0 ? number : 0;
    if (m->count == 0 || m->rows[m->count - 1].number != number) {
        JOX_RESERVE(m->rows, m->capacity, m->count + 1);
        m->rows[m->count++] = (Interval){.number = number};
    }
    return &m->rows[m->count - 1];
}

static void take_measure_frame(const JoxProbeDef *def, void *state, const JoxFrame *frame,
                               const uint8_t *seen) {
    Measure *m = state;
    if (m->line)
        jox_flow_frame(def->during, m->line, frame, seen);
    Interval *row = find_measure_interval(def, m, frame->time);
    uint32_t people = 0;
    double speed = 0.0;
    for (uint32_t i = 0; i < frame->count; i++) {
        JoxV2 p = {frame->x[i], frame->y[i]};
        if (!seen[i] || !is_near_polygon(m, p, 0.0f) ||
            !jox_polygon_contains(def->points, def->count, p))
            continue;
        const double square =
            (double)frame->vx[i] * frame->vx[i] + (double)frame->vy[i] * frame->vy[i];
        people++;
        speed += sqrt(square);
        row->squares += square;
        row->standing += square < STANDS * STANDS;
    }
    gather_people(def, m, frame);
    gather_walls_near_polygon(def, m, frame);
    m->sites.bars = &m->bars;
    double density = measure_voronoi_density(def, m, seen);
    row->frames++;
    row->speeds += speed;
    row->people += people;
    row->classical += people / m->area;
    row->voronoi += density;
    if (people) {
        row->walked++;
        row->speed += speed / people;
        row->flow += density * speed / people;
    }
}

/* Returns a sum over frames divided by their number; NAN if there are none. */
static double divide_or_nan(double sum, uint32_t frames) {
    return frames ? sum / frames : NAN;
}

/* Returns the middle of an interval, s. */
static double find_interval_middle(const JoxProbeDef *def, const Interval *row) {
    return def->from + ((double)row->number + 0.5) * def->every;
}

static void add_measure_figures(const JoxProbeDef *def, const void *state, JoxFigures *out) {
    const Measure *m = state;
    double begin = -INFINITY, end = INFINITY;
    if (m->line && !jox_flow_middle(m->line, &begin, &end))
        begin = INFINITY;
    double *densities = jox_alloc(m->count + 1, sizeof *densities);
    double people = 0, classical = 0, voronoi = 0, speed = 0, flow = 0;
    double all = 0, speeds = 0, squares = 0, standing = 0;
    uint32_t n = 0;
    for (uint32_t r = 0; r < m->count; r++) {
        const Interval *row = &m->rows[r];
        if (!row->walked || find_interval_middle(def, row) < begin ||
            find_interval_middle(def, row) > end)
            continue;
        people += row->people / row->frames;
        classical += row->classical / row->frames;
        voronoi += densities[n++] = row->voronoi / row->frames;
        speed += row->speed / row->walked;
        flow += row->flow / row->walked;
        all += row->people;
        speeds += row->speeds;
        squares += row->squares;
        standing += row->standing;
    }
    const double middle = all > 0 ? speeds / all : NAN;
    jox_figure_add(out, "intervals", "intervals measured", "", n);
    jox_figure_add(out, "people", "people there, mean", "", divide_or_nan(people, n));
    jox_figure_add(out, "density_classical", "density by counting, mean", "1/m2",
                   divide_or_nan(classical, n));
    jox_figure_add(out, "density", "density by Voronoi cells, mean", "1/m2",
                   divide_or_nan(voronoi, n));
    jox_figure_add(out, "density_median", "density by Voronoi cells, median", "1/m2",
                   jox_quantile(densities, n, 0.5));
    jox_figure_add(out, "density_p90", "density by Voronoi cells, 90th percentile", "1/m2",
                   jox_quantile(densities, n, 0.9));
    jox_figure_add(out, "density_max", "density by Voronoi cells, greatest", "1/m2",
                   jox_quantile(densities, n, 1.0));
    jox_figure_add(out, "speed", "speed, mean", "m/s", divide_or_nan(speed, n));
    jox_figure_add(out, "specific_flow", "specific flow, mean", "1/(m s)", divide_or_nan(flow, n));
    jox_figure_add(out, "speed_deviation", "standard deviation of the speeds", "m/s",
                   all > 0 ? sqrt(fmax(squares / all - middle * middle, 0.0)) : NAN);
    jox_figure_add(out, "standing", "share of the people who stand", "",
                   all > 0 ? standing / all : NAN);
    jox_free(densities);
}

static void list_measure_sections(void *state, JoxSections *s) {
    Measure *m = state;
    JOX_SECTION_ARRAY(s, "intervals", m->rows, m->count, m->capacity);
    if (m->line)
        jox_flow_sections(m->line, s);
}

static void write_measure_csv(const JoxProbeDef *def, const void *state, FILE *out) {
    const Measure *m = state;
    fputs("time [s],people,density_classical [1/m2],density [1/m2],speed [m/s],"
          "specific_flow [1/(m s)]\n",
          out);
    for (uint32_t r = 0; r < m->count; r++) {
        const Interval *row = &m->rows[r];
        fprintf(out, "%.4f,%.4f,%.5g,%.5g,", find_interval_middle(def, row),
                divide_or_nan(row->people, row->frames), divide_or_nan(row->classical, row->frames),
                divide_or_nan(row->voronoi, row->frames));
        if (row->walked)
            fprintf(out, "%.5g,%.5g\n", divide_or_nan(row->speed, row->walked),
                    divide_or_nan(row->flow, row->walked));
        else
            fputs("nan,nan\n", out);
    }
}

static void plot_measure(const JoxProbeDef *def, const void *state, bool walls, JoxText *out) {
    (void)def;
    const Measure *m = state;
    bool any = false;
    (void)walls;
    for (uint32_t r = 0; r < m->count; r++)
        any |= m->rows[r].walked > 0;
    if (!any) {
        jox_plot_reason(out, "nobody was in the polygon");
        return;
    }
    jox_text_printf(out,
                    "unset title\nset multiplot layout 2,2 title heading font ',14' "
                    "noenhanced\nset key above\nset yrange [0:*]\n"
                    "set xlabel 'time (s)'\nset ylabel 'density (1/m\xc2\xb2)'\n"
                    "plot csv skip 1 using 1:4 with lines lw 2 lc '#1f77b4' title 'Voronoi', "
                    "'' skip 1 using 1:3 with lines lw 1 lc '#999999' title 'classical'\n"
                    "set ylabel 'mean speed (m/s)'\n"
                    "plot csv skip 1 using 1:5 with lines lw 2 lc '#d62728' notitle\n"
                    "set xrange [0:*]\nset xlabel 'Voronoi density (1/m\xc2\xb2)'\n"
                    "plot csv skip 1 using 4:5 with points pt 7 ps 0.7 lc '#1f77b4' notitle\n"
                    "set ylabel 'specific flow (1/(m s))'\n"
                    "plot csv skip 1 using 4:6 with points pt 7 ps 0.7 lc '#1f77b4' notitle\n");
}

static void free_measure(void *state) {
    Measure *m = state;
    jox_sites_free(&m->sites);
    jox_free(m->bars.items);
    jox_seam_walls_free(&m->seam_walls);
    jox_free(m->rows);
    jox_flow_free(m->line);
}

const JoxProbeCalls jox_probe_measure = {
    JOX_PROBE_KIND(Measure, measure, 1200, 900),
    .frame = take_measure_frame,
    .begin = begin_measure,
    .release = free_measure,
};
