/* Tests whether points lie in an area, and measures its size. */
#include "geom/area.h"

#include <math.h>

#include "base/assert.h"
#include "base/mem.h"

enum {
    MOST_STRIPS = 1024,
    MOST_TIMES = 8
}; /* greatest number of strips; greatest mean number of strips per edge */

/* Least number of samples of a floor, over its bounding box. */
enum { FLOOR_SAMPLES = 250000 };
static const float APART = 1e-3f; /* m: edges farther than `clear` plus this cannot matter, whatever
                                     the rounding */

/* Edges by horizontal strips of equal height. An edge is listed in each strip that its range of y
   touches. The strip of a point is computed by the same arithmetic as those of the range's ends, so
   no edge at its height is missed. */
typedef struct Strips {
    float low, height; /* m */
    uint32_t count;    /* 0: no edges */
    uint32_t *first;   /* count + 1 */
    uint32_t *edges;   /* by strip, ascending in each */
} Strips;

typedef struct Range {
    float least, most;
} Range;

struct JoxAreaIndex {
    const JoxArea *area;
    Strips walls;
    Strips *places; /* for `in`, then `out`; empty for places that are no polygons */
};

/* ---- strips ---- */

static uint32_t find_strip(const Strips *s, float y) {
    const float strip = floorf((y - s->low) / s->height);
    return strip <= 0.0f ? 0 : strip >= (float)s->count ? s->count - 1 : (uint32_t)strip;
}

/* Returns the total number of entries of edges in strips. */
static size_t count_strip_entries(const Strips *s, const Range *ranges, uint32_t count) {
    size_t sum = 0;
    for (uint32_t e = 0; e < count; e++)
        sum += find_strip(s, ranges[e].most) - find_strip(s, ranges[e].least) + 1;
    return sum;
}

/* Makes as many strips as edges; fewer if long edges would have too many entries. */
static Strips make_strips(const Range *ranges, uint32_t count) {
    Strips s = {.low = INFINITY};
    float high = -INFINITY;
    for (uint32_t e = 0; e < count; e++) {
        s.low = jox_minf(s.low, ranges[e].least);
        high = jox_maxf(high, ranges[e].most);
    }
    if (count == 0)
        return s;
    s.count = count < MOST_STRIPS ? count : MOST_STRIPS;
    size_t all;
    for (;; s.count = (s.count + 1) / 2) {
        s.height = jox_maxf((high - s.low) / (float)s.count, 1e-3f);
        all = count_strip_entries(&s, ranges, count);
        if (s.count == 1 || all <= (size_t)count * MOST_TIMES)
            break;
    }
    s.first = jox_alloc(s.count + 1, sizeof *s.first);
    s.edges = jox_alloc(all, sizeof *s.edges);
    for (uint32_t e = 0; e < count; e++)
        for (uint32_t k = find_strip(&s, ranges[e].least); k <= find_strip(&s, ranges[e].most); k++)
            s.first[k]++;
    uint32_t sum = 0;
    for (uint32_t k = 0; k <= s.count; k++)
        s.first[k] = sum += s.first[k];
    JOX_ASSERT(sum == all);
    for (uint32_t e = count; e-- > 0;)
        for (uint32_t k = find_strip(&s, ranges[e].least); k <= find_strip(&s, ranges[e].most); k++)
            s.edges[--s.first[k]] = e;
    return s;
}

static void free_strips(Strips *s) {
    jox_free(s->first);
    jox_free(s->edges);
}

/* ---- an area's edges ---- */

/* Returns the edge that leads to point e of a polygon. */
static void polygon_edge(const JoxPlace *place, uint32_t e, JoxV2 *from, JoxV2 *to) {
    *from = place->points[e > 0 ? e - 1 : place->count - 1];
    *to = place->points[e];
}

static Strips polygon_strips(const JoxPlace *place) {
    if (!jox_place_is_area(place))
        return (Strips){0};
    Range *ranges = jox_alloc(place->count + 1, sizeof *ranges);
    for (uint32_t e = 0; e < place->count; e++) {
        JoxV2 a, b;
        polygon_edge(place, e, &a, &b);
        ranges[e] = (Range){jox_minf(a.y, b.y), jox_maxf(a.y, b.y)};
    }
    Strips s = make_strips(ranges, place->count);
    jox_free(ranges);
    return s;
}

/* Makes strips of walls: an edge matters to points nearer than `clear`, and to points whose ray to
   the right crosses it. */
static Strips wall_strips(const JoxWalls *walls, float clear) {
    const float far = clear + APART;
    Range *ranges = jox_alloc(walls->count + 1, sizeof *ranges);
    for (uint32_t v = 0; v < walls->count; v++) {
        JoxV2 a = walls->vertices[v].point, b = walls->vertices[walls->vertices[v].next].point;
        ranges[v] = (Range){jox_minf(a.y, b.y) - far, jox_maxf(a.y, b.y) + far};
    }
    Strips s = make_strips(ranges, walls->count);
    jox_free(ranges);
    return s;
}

JoxAreaIndex *jox_area_index(const JoxArea *area) {
    JoxAreaIndex *index = jox_alloc(1, sizeof *index);
    const uint32_t places = area->in_count + area->out_count;
    index->area = area;
    index->places = jox_alloc(places + 1, sizeof *index->places);
    for (uint32_t i = 0; i < places; i++)
        index->places[i] = polygon_strips(
            &area->places[i < area->in_count ? area->in[i] : area->out[i - area->in_count]]);
    if (area->walls)
        index->walls = wall_strips(area->walls, area->clear);
    return index;
}

void jox_area_index_free(JoxAreaIndex *index) {
    for (uint32_t i = 0; i < index->area->in_count + index->area->out_count; i++)
        free_strips(&index->places[i]);
    free_strips(&index->walls);
    jox_free(index->places);
    jox_free(index);
}

/* ---- points ---- */

/* Returns what jox_polygon_contains would, from the edges at the point's height alone. */
static bool is_in_indexed_place(const JoxAreaIndex *index, uint32_t number, uint32_t place,
                                JoxV2 p) {
    const Strips *s = &index->places[number];
    if (s->count == 0)
        return jox_place_contains(index->area->places, place, p);
    const uint32_t strip = find_strip(s, p.y);
    bool in = false;
    for (uint32_t k = s->first[strip]; k < s->first[strip + 1]; k++) {
        JoxV2 a, b;
        polygon_edge(&index->area->places[place], s->edges[k], &b, &a);
        if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x)
            in = !in;
    }
    return in;
}

/* Returns whether a point is at least `clear` from all edges and outside all solids. Edges of a
   ring are consecutive. */
static bool is_clear_of_walls(const JoxAreaIndex *index, JoxV2 p) {
    const JoxWalls *walls = index->area->walls;
    const float clear = index->area->clear;
    const Strips *s = &index->walls;
    if (s->count == 0)
        return true;
    const uint32_t strip = find_strip(s, p.y);
    uint32_t ring = 0;
    bool odd = false;
    for (uint32_t k = s->first[strip]; k < s->first[strip + 1]; k++) {
        const uint32_t v = s->edges[k];
        JoxV2 a = walls->vertices[v].point, b = walls->vertices[walls->vertices[v].next].point;
        JOX_ASSERT(ring < walls->ring_count);
        for (; v >= walls->rings[ring].first + walls->rings[ring].count; ring++, odd = false)
            if (odd && walls->rings[ring].solid)
                return false;
        if (p.x > jox_maxf(a.x, b.x) + clear + APART)
            continue;
        const bool near = p.x >= jox_minf(a.x, b.x) - clear - APART;
        if (near && jox_length2(jox_sub(p, jox_segment_nearest(a, b, p))) < clear * clear)
            return false;
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
            odd = !odd;
    }
    return !(odd && walls->rings[ring].solid);
}

bool jox_area_contains(const JoxAreaIndex *index, JoxV2 p) {
    const JoxArea *area = index->area;
    bool in = false;
    for (uint32_t i = 0; i < area->in_count && !in; i++)
        in = is_in_indexed_place(index, i, area->in[i], p);
    for (uint32_t i = 0; i < area->out_count && in; i++)
        in = !is_in_indexed_place(index, area->in_count + i, area->out[i], p);
    return in && jox_is_floor(area->storeys, p) && is_clear_of_walls(index, p);
}

/* ---- size ---- */

static void extend_bounds(const JoxPlace *place, JoxV2 *low, JoxV2 *high) {
    float r = jox_place_outline(place) == JOX_OUTLINE_CIRCLE ? place->radius : 0.5f;
    for (uint32_t i = 0; i < place->count; i++) {
        low->x = jox_minf(low->x, place->points[i].x - r);
        low->y = jox_minf(low->y, place->points[i].y - r);
        high->x = jox_maxf(high->x, place->points[i].x + r);
        high->y = jox_maxf(high->y, place->points[i].y + r);
    }
}

bool jox_area_extent(const JoxArea *area, JoxV2 *low, JoxV2 *high) {
    *low = (JoxV2){INFINITY, INFINITY};
    *high = (JoxV2){-INFINITY, -INFINITY};
    for (uint32_t i = 0; i < area->in_count; i++) {
        const JoxPlace *place = &area->places[area->in[i]];
        extend_bounds(place, low, high);
        for (uint32_t m = 0; m < place->member_count; m++)
            extend_bounds(&area->places[place->members[m]], low, high);
    }
    return low->x < high->x && low->y < high->y;
}

double jox_area_sampling(JoxV2 low, JoxV2 high) {
    return fmax(0.1, sqrt(((double)high.x - low.x) * ((double)high.y - low.y) / 1e6));
}

/* Where the edges of an area's polygons cross a horizontal line. */
typedef struct Crossings {
    float *x;        /* m: of all polygons, one after the other */
    uint32_t *first; /* by place of the index; where they begin, and their number at the end */
} Crossings;

static Crossings make_crossings(const JoxAreaIndex *index) {
    const JoxArea *area = index->area;
    const uint32_t places = area->in_count + area->out_count;
    size_t edges = 0;
    for (uint32_t i = 0; i < places; i++)
        edges +=
            area->places[i < area->in_count ? area->in[i] : area->out[i - area->in_count]].count;
    return (Crossings){.x = jox_alloc(edges + 1, sizeof(float)),
                       .first = jox_alloc((size_t)places + 1, sizeof(uint32_t))};
}

/* Lists the crossings at height y, m, by the arithmetic of is_in_indexed_place. */
static void list_crossings(const JoxAreaIndex *index, float y, Crossings *out) {
    const JoxArea *area = index->area;
    uint32_t count = 0;
    for (uint32_t i = 0; i < area->in_count + area->out_count; i++) {
        const Strips *s = &index->places[i];
        const uint32_t place = i < area->in_count ? area->in[i] : area->out[i - area->in_count];
        const uint32_t strip = s->count ? find_strip(s, y) : 0;
        out->first[i] = count;
        for (uint32_t k = s->count ? s->first[strip] : 0; s->count && k < s->first[strip + 1];
             k++) {
            JoxV2 a, b;
            polygon_edge(&area->places[place], s->edges[k], &b, &a);
            if ((a.y > y) != (b.y > y))
                out->x[count++] = (b.x - a.x) * (y - a.y) / (b.y - a.y) + a.x;
        }
    }
    out->first[area->in_count + area->out_count] = count;
}

/* Returns what is_in_indexed_place would for a point at the height of the crossings. */
static bool is_between_crossings(const JoxAreaIndex *index, const Crossings *c, uint32_t number,
                                 uint32_t place, JoxV2 p) {
    bool in = false;
    if (index->places[number].count == 0)
        return jox_place_contains(index->area->places, place, p);
    for (uint32_t k = c->first[number]; k < c->first[number + 1]; k++)
        in ^= p.x < c->x[k];
    return in;
}

/* Returns what jox_area_contains would for a point at the height of the crossings. */
static bool is_in_area(const JoxAreaIndex *index, const Crossings *c, JoxV2 p) {
    const JoxArea *area = index->area;
    bool in = false;
    for (uint32_t i = 0; i < area->in_count && !in; i++)
        in = is_between_crossings(index, c, i, area->in[i], p);
    for (uint32_t i = 0; i < area->out_count && in; i++)
        in = !is_between_crossings(index, c, area->in_count + i, area->out[i], p);
    return in && jox_is_floor(area->storeys, p) && is_clear_of_walls(index, p);
}

/* Returns the size of an area, m2, by samples `step` m apart; low, high: its extent. */
static double sample_size(const JoxArea *area, JoxV2 low, JoxV2 high, double step) {
    const double w = (double)high.x - low.x, h = (double)high.y - low.y;
    double nx = floor(w / step) + 1, ny = floor(h / step) + 1, hits = 0;
    if (!(nx * ny <= 4e6))
        return 0; /* too thin or too large to sample */
    JoxAreaIndex *index = jox_area_index(area);
    Crossings crossings = make_crossings(index);
    for (double j = 0; j < ny; j++) {
        const float y = (float)(low.y + (j + 0.5) * h / ny);
        list_crossings(index, y, &crossings);
        for (double i = 0; i < nx; i++)
            hits += is_in_area(index, &crossings, (JoxV2){(float)(low.x + (i + 0.5) * w / nx), y});
    }
    jox_free(crossings.x);
    jox_free(crossings.first);
    jox_area_index_free(index);
    return hits / (nx * ny) * w * h;
}

double jox_area_size(const JoxArea *area) {
    JoxV2 low, high;
    if (!jox_area_extent(area, &low, &high))
        return 0;
    return sample_size(area, low, high, jox_area_sampling(low, high));
}

double jox_area_floor(const JoxArea *area) {
    JoxArea floor = *area;
    JoxV2 low, high;
    if (!jox_area_extent(area, &low, &high))
        return 0;
    floor.clear = 0.0f;
    const double fine = sqrt(((double)high.x - low.x) * ((double)high.y - low.y) / FLOOR_SAMPLES);
    return sample_size(&floor, low, high, fmin(fine, jox_area_sampling(low, high)));
}
