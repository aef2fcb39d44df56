/* Cuts Voronoi cells by the neighbouring sites, which are found through bins. voronoi_walls.c cuts
   cells by walls. */
#include "record/fields/voronoi.h"

#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "base/number/pi.h"
#include "base/sort.h"
#include "geom/polygon.h"

enum { MOST_BINS = 1 << 20, CROWDED = 200 /* sites in a bin that are too many for people */ };

void jox_cell_begin(JoxCell *cell, double cutoff) {
    cell->count = JOX_CELL_CORNERS;
    for (uint32_t c = 0; c < cell->count; c++) {
        cell->x[c] = cutoff * cos(JOX_TURN * c / JOX_CELL_CORNERS);
        cell->y[c] = cutoff * sin(JOX_TURN * c / JOX_CELL_CORNERS);
    }
}

/* Copies the used corners only: most cells have six of 256. */
static void copy_cell(JoxCell *to, const JoxCell *from) {
    to->count = from->count;
    for (uint32_t c = 0; c < from->count; c++) {
        to->x[c] = from->x[c];
        to->y[c] = from->y[c];
    }
}

bool jox_cell_cut(JoxCell *cell, double x, double y) {
    double half = 0.5 * (x * x + y * y);
    JoxCell kept; /* 4 KB: only the used part is set */
    bool cuts = false;
    if (half == 0.0)
        return false;
    for (uint32_t c = 0; c < cell->count && !cuts; c++)
        cuts = cell->x[c] * x + cell->y[c] * y > half;
    kept.count = 0;
    for (uint32_t c = 0; cuts && c < cell->count; c++) {
        uint32_t n = c + 1 < cell->count ? c + 1 : 0;
        double here = cell->x[c] * x + cell->y[c] * y - half;
        double next = cell->x[n] * x + cell->y[n] * y - half;
        if (here <= 0.0 && kept.count < JOX_MOST_CORNERS) {
            kept.x[kept.count] = cell->x[c];
            kept.y[kept.count++] = cell->y[c];
        }
        if ((here < 0.0 && next > 0.0) || (here > 0.0 && next < 0.0)) {
            double share = here / (here - next);
            if (kept.count < JOX_MOST_CORNERS) {
                kept.x[kept.count] = cell->x[c] + share * (cell->x[n] - cell->x[c]);
                kept.y[kept.count++] = cell->y[c] + share * (cell->y[n] - cell->y[c]);
            }
        }
    }
    if (!cuts)
        return false;
    copy_cell(cell, &kept);
    return true;
}

double jox_cell_reach2(const JoxCell *cell) {
    double most = 0.0;
    for (uint32_t c = 0; c < cell->count; c++) {
        const double away2 = cell->x[c] * cell->x[c] + cell->y[c] * cell->y[c];
        most = away2 > most ? away2 : most;
    }
    return most;
}

static double measure_polygon_area(const double *x, const double *y, uint32_t count) {
    double sum = 0.0;
    for (uint32_t c = 0; c < count; c++) {
        uint32_t n = c + 1 < count ? c + 1 : 0;
        sum += x[c] * y[n] - x[n] * y[c];
    }
    return 0.5 * sum;
}

double jox_cell_area(const JoxCell *cell) {
    return measure_polygon_area(cell->x, cell->y, cell->count);
}

/* Uses Green's theorem over the edges of the ring, which may have any shape: each edge a-b adds the
   area that the cell shares with the triangle of person, a and b, with the sign of its orientation.
   The person lies inside the convex cell. */
double jox_cell_area_within(const JoxCell *cell, JoxV2 at, const JoxV2 *ring, uint32_t count) {
    double sum = 0.0;
    for (uint32_t e = 0; e < count; e++) {
        JoxV2 from = ring[e], to = ring[e + 1 < count ? e + 1 : 0];
        double x[2][JOX_MOST_CORNERS + 4], y[2][JOX_MOST_CORNERS + 4];
        uint32_t corners = 3, now = 0;
        x[0][0] = 0.0, y[0][0] = 0.0;
        x[0][1] = (double)from.x - at.x, y[0][1] = (double)from.y - at.y;
        x[0][2] = (double)to.x - at.x, y[0][2] = (double)to.y - at.y;
        /* Clip by the sides of the cell. */
        for (uint32_t c = 0; c < cell->count && corners > 0; c++) {
            uint32_t n = c + 1 < cell->count ? c + 1 : 0, kept = 0;
            double sx = cell->x[n] - cell->x[c], sy = cell->y[n] - cell->y[c];
            for (uint32_t k = 0; k < corners; k++) {
                uint32_t m = k + 1 < corners ? k + 1 : 0;
                double here = sx * (y[now][k] - cell->y[c]) - sy * (x[now][k] - cell->x[c]);
                double next = sx * (y[now][m] - cell->y[c]) - sy * (x[now][m] - cell->x[c]);
                if (here >= 0.0) {
                    x[!now][kept] = x[now][k];
                    y[!now][kept++] = y[now][k];
                }
                if ((here < 0.0 && next > 0.0) || (here > 0.0 && next < 0.0)) {
                    double share = here / (here - next);
                    x[!now][kept] = x[now][k] + share * (x[now][m] - x[now][k]);
                    y[!now][kept++] = y[now][k] + share * (y[now][m] - y[now][k]);
                }
            }
            corners = kept;
            now = !now;
        }
        /* Clockwise triangles count as negative. */
        sum += measure_polygon_area(x[now], y[now], corners);
    }
    return fabs(sum);
}

/* ---- neighbours ---- */

void jox_sites_clear(JoxSites *s) {
    s->count = 0;
}

static void add_site(JoxSites *s, JoxV2 point, uint32_t person, uint32_t seam) {
    JOX_RESERVE(s->points, s->capacity, s->count + 1);
    JOX_RESERVE(s->person, s->person_capacity, s->count + 1);
    JOX_RESERVE(s->seam, s->seam_capacity, s->count + 1);
    s->points[s->count] = point;
    s->seam[s->count] = seam;
    s->person[s->count++] = person;
}

void jox_sites_add(JoxSites *s, JoxV2 point, uint32_t person) {
    add_site(s, point, person, 0);
}

void jox_sites_add_image(JoxSites *s, JoxV2 point, uint32_t person, uint32_t seam) {
    add_site(s, point, person, seam + 1);
}

static uint32_t find_bin_column(const JoxSites *s, float x) {
    return (uint32_t)fmin(fmax((x - s->low.x) / s->bin, 0.0), s->columns - 1);
}
static uint32_t find_bin_row(const JoxSites *s, float y) {
    return (uint32_t)fmin(fmax((y - s->low.y) / s->bin, 0.0), s->rows - 1);
}
static uint32_t find_bin(const JoxSites *s, JoxV2 p) {
    return find_bin_row(s, p.y) * s->columns + find_bin_column(s, p.x);
}

/* Counts the sites of each bin, in the element of `first` after it. With `repeated`, repeated sites
   are left out. Returns the greatest count. */
static uint32_t fill_bins(JoxSites *s, double wide, double tall, bool repeated) {
    uint32_t most = 0;
    s->columns = (uint32_t)(wide / s->bin) + 1;
    s->rows = (uint32_t)(tall / s->bin) + 1;
    const uint32_t bins = s->columns * s->rows;
    JOX_RESERVE(s->first, s->first_capacity, bins + 1);
    memset(s->first, 0, (bins + 1) * sizeof *s->first);
    for (uint32_t i = 0; i < s->count; i++) {
        if (repeated && s->repeated[i])
            continue;
        const uint32_t now = ++s->first[find_bin(s, s->points[i]) + 1];
        most = now > most ? now : most;
    }
    return most;
}

static int compare_site_points(const void *a, const void *b, const void *context) {
    const JoxV2 p = ((const JoxV2 *)context)[*(const uint32_t *)a],
                q = ((const JoxV2 *)context)[*(const uint32_t *)b];
    return p.x != q.x ? (p.x > q.x ? 1 : -1) : p.y != q.y ? (p.y > q.y ? 1 : -1) : 0;
}

/* Marks all but the first of the sites at the same point: cutting a cell by one of them is
   enough. */
static void mark_repeated_sites(JoxSites *s) {
    JOX_RESERVE(s->repeated, s->repeated_capacity, s->count + 1);
    JOX_RESERVE(s->sort_scratch, s->sort_scratch_capacity, JOX_SORT_SPARE(s->count));
    for (uint32_t i = 0; i < s->count; i++)
        s->order[i] = i;
    jox_sort(s->order, s->count, sizeof *s->order, compare_site_points, s->points, s->sort_scratch);
    for (uint32_t k = 0; k < s->count; k++)
        s->repeated[s->order[k]] =
            k > 0 && compare_site_points(&s->order[k - 1], &s->order[k], s->points) == 0;
}

void jox_sites_sort(JoxSites *s, double cutoff) {
    JoxV2 high = {-INFINITY, -INFINITY};
    double wide = 0.0, tall = 0.0;
    s->low = (JoxV2){INFINITY, INFINITY};
    for (uint32_t i = 0; i < s->count; i++) {
        s->low = jox_v2(jox_minf(s->low.x, s->points[i].x), jox_minf(s->low.y, s->points[i].y));
        high = jox_v2(jox_maxf(high.x, s->points[i].x), jox_maxf(high.y, s->points[i].y));
    }
    jox_cell_begin(&s->lone_cell, cutoff);
    s->bin = 0.5 * cutoff;
    if (s->count) {
        wide = (double)high.x - s->low.x, tall = (double)high.y - s->low.y;
        s->bin = fmax(s->bin, sqrt((wide + 1.0) * (tall + 1.0) / MOST_BINS));
    }
    JOX_RESERVE(s->order, s->order_capacity, s->count + 1);
    /* Denser than people can stand: use smaller bins and each point once, so that the work does not
       grow with the square of the number of sites. */
    uint32_t most = fill_bins(s, wide, tall, false);
    for (int halved = 0; most > CROWDED && halved < 3; halved++) {
        if (4.0 * s->columns * s->rows > MOST_BINS)
            break;
        s->bin *= 0.5;
        most = fill_bins(s, wide, tall, false);
    }
    const bool repeated = most > CROWDED;
    if (repeated) {
        mark_repeated_sites(s);
        fill_bins(s, wide, tall, true);
    }
    const uint32_t bins = s->columns * s->rows;
    for (uint32_t b = 0; b < bins; b++)
        s->first[b + 1] += s->first[b];
    const uint32_t kept = s->first[bins];
    for (uint32_t i = s->count; i-- > 0;) /* backwards: bins keep the order of the sites */
        if (!repeated || !s->repeated[i])
            s->order[--s->first[find_bin(s, s->points[i]) + 1]] = i;
    for (uint32_t b = 0; b < bins;
         b++) /* `first` has moved from the end of each bin to its beginning */
        s->first[b] = s->first[b + 1];
    s->first[bins] = kept;
}

static bool is_behind_bar(const JoxSites *s, JoxV2 a, JoxV2 b) {
    bool crossed = false;
    for (uint32_t k = 0; s->bars && k < s->bars->count && !crossed; k++)
        crossed = jox_segment_crossing(s->bars->items[k].from, s->bars->items[k].to, a, b) != 0;
    return crossed;
}

/* Returns whether one of two sites is an image that the other does not see through its seam. Images
   beyond different seams do not see each other. */
static bool is_behind_seam(const JoxSites *s, uint32_t a, uint32_t b) {
    if (s->seam[a] == s->seam[b])
        return false;
    if (s->seam[a] && s->seam[b])
        return true;
    const uint32_t image = s->seam[a] ? a : b, own = s->seam[a] ? b : a;
    return !jox_seam_lets_see(&s->storeys->seams[s->seam[image] - 1],
                              jox_in_plan(s->storeys, s->points[image]),
                              jox_in_plan(s->storeys, s->points[own]));
}

/* Cuts a cell by the visible sites of the bins at a distance of `ring` bins. */
static void cut_ring(const JoxSites *s, uint32_t site, int ring, JoxCell *out) {
    JoxV2 at = s->points[site];
    int column = (int)find_bin_column(s, at.x), row = (int)find_bin_row(s, at.y);
    double reach2 = jox_cell_reach2(out);
    for (int r = row - ring; r <= row + ring; r++) {
        if (r < 0 || r >= (int)s->rows)
            continue;
        int step = r == row - ring || r == row + ring ? 1 : 2 * ring;
        for (int c = column - ring; c <= column + ring; c += step ? step : 1) {
            if (c < 0 || c >= (int)s->columns)
                continue;
            uint32_t bin = (uint32_t)r * s->columns + (uint32_t)c;
            for (uint32_t k = s->first[bin]; k < s->first[bin + 1]; k++) {
                JoxV2 other = s->points[s->order[k]];
                double x = (double)other.x - at.x, y = (double)other.y - at.y;
                if (s->order[k] == site || x * x + y * y >= 4.0 * reach2 ||
                    is_behind_seam(s, site, s->order[k]) || is_behind_bar(s, at, other))
                    continue;
                if (jox_cell_cut(out, x, y))
                    reach2 = jox_cell_reach2(out);
            }
        }
    }
}

void jox_sites_cell(const JoxSites *s, uint32_t site, double cutoff, JoxCell *out) {
    copy_cell(out, &s->lone_cell);
    for (int ring = 0; ring <= 2 || (ring - 1) * s->bin < 2.0 * cutoff; ring++) {
        /* Sites in bins `ring` bins away are at least (ring - 1) * bin distant. */
        double away = (ring - 1) * s->bin;
        if (ring > 1 && away * away >= 4.0 * jox_cell_reach2(out))
            break;
        cut_ring(s, site, ring, out);
    }
}

void jox_sites_free(JoxSites *s) {
    jox_free(s->points);
    jox_free(s->person);
    jox_free(s->seam);
    jox_free(s->first);
    jox_free(s->order);
    jox_free(s->repeated);
    jox_free(s->sort_scratch);
    *s = (JoxSites){0};
}
