/* Tests points against solid walls. A line of constant y lies inside solids on stretches of x
   between crossings with their outlines; lines are cached, since many points of a row of cells
   share their y. A point is inside if jox_polygon_contains says so for one of the solids. */
#include <math.h>

#include "base/mem.h"
#include "base/number/bits.h"
#include "base/sort.h"
#include "geom/polygon.h"
#include "record/fields/density_parts.h"

enum { LINES = 1 << 14 }; /* cached lines, hashed by the bits of y */

typedef struct Edge {
    JoxV2 a, b;
    uint32_t solid;
} Edge;

typedef struct Crossing {
    uint32_t solid;
    float x;
} Crossing;

/* Points from <= x < to, m. */
typedef struct Stretch {
    float from, to;
} Stretch;

typedef struct Line {
    float y;
    bool built;
    Stretch *stretches; /* ascending and disjoint */
    uint32_t count, capacity;
} Line;

struct JoxDensitySolids {
    const JoxDensity *floor_of; /* a point without floor of storeys is inside, too; NULL: none */
    struct Box {
        JoxV2 low, high;
    } * boxes; /* bounding boxes by solid */
    Edge *edges;
    uint32_t edge_count;
    float low, cell; /* m: lower end and height of the rows */
    int rows;
    uint32_t *first, *list; /* edges that reach into each row of cells */
    Crossing *crossings;    /* scratch: room for all edges */
    Line *lines;
};

/* ---- edges by row ---- */

static int find_edge_row(const JoxDensitySolids *s, float y) {
    return jox_density_clamp_index(((double)y - s->low) / s->cell, s->rows - 1);
}

static void enter_solid_edge(JoxDensitySolids *s, uint32_t edge, bool fill) {
    const Edge *e = &s->edges[edge];
    const int last = find_edge_row(s, jox_maxf(e->a.y, e->b.y));
    for (int row = find_edge_row(s, jox_minf(e->a.y, e->b.y)); row <= last; row++) {
        if (fill)
            s->list[--s->first[row]] = edge;
        else
            s->first[row]++;
    }
}

static void list_row_edges(JoxDensitySolids *s) {
    s->first = jox_alloc((size_t)s->rows + 1, sizeof *s->first);
    for (uint32_t e = 0; e < s->edge_count; e++)
        enter_solid_edge(s, e, false);
    for (int row = 0; row < s->rows;
         row++) /* `first` becomes the end of each list; filling moves it down to the beginning */
        s->first[row + 1] += s->first[row];
    s->list = jox_alloc((size_t)s->first[s->rows] + 1, sizeof *s->list);
    for (uint32_t e = s->edge_count; e-- > 0;)
        enter_solid_edge(s, e, true);
}

static void add_solid_edges(JoxDensitySolids *s, uint32_t solid, const JoxV2 *ring,
                            uint32_t count) {
    struct Box *box = &s->boxes[solid];
    jox_bounds(ring, count, &box->low, &box->high);
    for (uint32_t i = 0, j = count - 1; i < count; j = i++)
        s->edges[s->edge_count++] = (Edge){ring[i], ring[j], solid};
}

JoxDensitySolids *jox_density_solids_create(const JoxDensity *d, const JoxWalls *walls) {
    JoxDensitySolids *s = jox_alloc(1, sizeof *s);
    uint32_t count = 0;
    s->floor_of = d->sheets && d->floor && d->floor->walled ? d : NULL;
    s->low = jox_density_corner(d).y;
    s->cell = d->cell;
    s->rows = d->high;
    s->boxes = jox_alloc((size_t)walls->ring_count + 1, sizeof *s->boxes);
    s->edges = jox_alloc((size_t)walls->count + 1, sizeof *s->edges);
    s->crossings = jox_alloc((size_t)walls->count + 1, sizeof *s->crossings);
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        if (!walls->rings[r].solid || walls->rings[r].open)
            continue;
        JoxV2 *ring = jox_walls_ring_points(walls, r);
        add_solid_edges(s, count++, ring, walls->rings[r].count);
        jox_free(ring);
    }
    if (s->edge_count) {
        list_row_edges(s);
        s->lines = jox_alloc(LINES, sizeof *s->lines);
    }
    return s;
}

void jox_density_solids_free(JoxDensitySolids *s) {
    jox_free(s->boxes);
    jox_free(s->edges);
    jox_free(s->crossings);
    jox_free(s->first);
    jox_free(s->list);
    for (int n = 0; s->lines && n < LINES; n++)
        jox_free(s->lines[n].stretches);
    jox_free(s->lines);
    jox_free(s);
}

/* ---- lines ---- */

static int compare_crossings(const void *left, const void *right, const void *context) {
    const Crossing *a = left, *b = right;
    (void)context;
    if (a->solid != b->solid)
        return a->solid < b->solid ? -1 : 1;
    return (a->x > b->x) - (a->x < b->x);
}

static int compare_stretches(const void *left, const void *right, const void *context) {
    const Stretch *a = left, *b = right;
    (void)context;
    return (a->from > b->from) - (a->from < b->from);
}

/* Finds the crossings of outlines with the line at y, sorted by solid, then x: an even number for
   each solid. Returns their number. */
static uint32_t find_crossings(JoxDensitySolids *s, float y) {
    uint32_t count = 0;
    const int row = find_edge_row(s, y);
    for (uint32_t k = s->first[row]; k < s->first[row + 1]; k++) {
        const Edge *e = &s->edges[s->list[k]];
        const JoxV2 a = e->a, b = e->b;
        if ((a.y > y) != (b.y > y))
            s->crossings[count++] =
                (Crossing){e->solid, (b.x - a.x) * (y - a.y) / (b.y - a.y) + a.x};
    }
    jox_sort(s->crossings, count, sizeof *s->crossings, compare_crossings, NULL, NULL);
    return count;
}

/* Sorts the stretches of a line and merges those that overlap. */
static void merge_stretches(Line *line) {
    uint32_t kept = 0;
    jox_sort(line->stretches, line->count, sizeof *line->stretches, compare_stretches, NULL, NULL);
    for (uint32_t k = 0; k < line->count; k++) {
        const Stretch *next = &line->stretches[k];
        Stretch *last = &line->stretches[kept - (kept > 0)];
        if (kept && next->from <= last->to)
            last->to = jox_maxf(last->to, next->to);
        else
            line->stretches[kept++] = *next;
    }
    line->count = kept;
}

/* Builds the stretches of the line at y: solid by solid between pairs of crossings. */
static void build_line(JoxDensitySolids *s, Line *line, float y) {
    const uint32_t count = find_crossings(s, y);
    line->y = y;
    line->built = true;
    line->count = 0;
    JOX_RESERVE(line->stretches, line->capacity, count / 2 + 1);
    for (uint32_t k = 0; k + 1 < count; k += 2) {
        const Crossing *c = &s->crossings[k];
        const struct Box *box = &s->boxes[c->solid]; /* limits the rounding of crossings */
        const Stretch within = {jox_maxf(c[0].x, box->low.x),
                                jox_minf(c[1].x, nextafterf(box->high.x, INFINITY))};
        if (within.from < within.to)
            line->stretches[line->count++] = within;
    }
    merge_stretches(line);
}

static Line *find_line(JoxDensitySolids *s, float y) {
    Line *line = &s->lines[(jox_float_bits(y) * 2654435761u) >> 16 & (LINES - 1)];
    if (!line->built || line->y != y)
        build_line(s, line, y);
    return line;
}

bool jox_density_is_within_solid(JoxDensitySolids *s, JoxV2 p) {
    if (s->floor_of && jox_density_is_off_floor(s->floor_of, p))
        return true;
    if (s->edge_count == 0)
        return false;
    const Line *line = find_line(s, p.y);
    uint32_t low = 0, high = line->count;
    while (low < high) { /* find the first stretch that ends beyond the point */
        const uint32_t middle = (low + high) / 2;
        if (line->stretches[middle].to > p.x)
            high = middle;
        else
            low = middle + 1;
    }
    return low < line->count && line->stretches[low].from <= p.x;
}
