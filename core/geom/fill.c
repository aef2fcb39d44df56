/* Lattices over areas, and a drawn subset of their points. */
#include "geom/fill.h"

#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/random.h"

/* Whether an edge is out of the way of p: neither nearer than `clear` nor on a ray to the right. */
static bool is_away(JoxV2 a, JoxV2 b, JoxV2 p, float clear) {
    const float far = clear + 1e-3f;
    return p.y > jox_maxf(a.y, b.y) + far || p.y < jox_minf(a.y, b.y) - far ||
           p.x > jox_maxf(a.x, b.x) + far;
}

static bool inside(const JoxArea *area, JoxV2 p) {
    bool in = false;
    for (uint32_t i = 0; i < area->in_count && !in; i++)
        in = jox_place_contains(area->places, area->in[i], p);
    for (uint32_t i = 0; i < area->out_count && in; i++)
        in = !jox_place_contains(area->places, area->out[i], p);
    if (!in || !area->walls)
        return in;
    for (uint32_t r = 0; r < area->walls->ring_count; r++) {
        const struct JoxWallRing *ring = &area->walls->rings[r];
        bool odd = false;
        for (uint32_t v = ring->first; v < ring->first + ring->count; v++) {
            JoxV2 a = area->walls->vertices[v].point;
            JoxV2 b = area->walls->vertices[area->walls->vertices[v].next].point;
            if (is_away(a, b, p, area->clear))
                continue;
            JoxV2 d = jox_sub(p, jox_segment_nearest(a, b, p));
            if (jox_length2(d) < area->clear * area->clear)
                return false;
            if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
                odd = !odd;
        }
        if (ring->solid && odd)
            return false;
    }
    return true;
}

static void widen(const JoxPlace *place, JoxV2 *low, JoxV2 *high) {
    float r = jox_place_outline(place) == JOX_OUTLINE_CIRCLE ? place->radius : 0.5f;
    for (uint32_t i = 0; i < place->count; i++) {
        low->x = jox_minf(low->x, place->points[i].x - r);
        low->y = jox_minf(low->y, place->points[i].y - r);
        high->x = jox_maxf(high->x, place->points[i].x + r);
        high->y = jox_maxf(high->y, place->points[i].y + r);
    }
}

/* False where the area is empty. */
static bool extent(const JoxArea *area, JoxV2 *low, JoxV2 *high) {
    *low = (JoxV2){INFINITY, INFINITY};
    *high = (JoxV2){-INFINITY, -INFINITY};
    for (uint32_t i = 0; i < area->in_count; i++) {
        const JoxPlace *place = &area->places[area->in[i]];
        widen(place, low, high);
        for (uint32_t m = 0; m < place->member_count; m++)
            widen(&area->places[place->members[m]], low, high);
    }
    return low->x < high->x && low->y < high->y;
}

/* m between the points by which an area is measured. */
static double sampling(JoxV2 low, JoxV2 high) {
    return fmax(0.1, sqrt(((double)high.x - low.x) * ((double)high.y - low.y) / 1e6));
}

double jox_area_size(const JoxArea *area) {
    JoxV2 low, high;
    if (!extent(area, &low, &high))
        return 0;
    double w = (double)high.x - low.x, h = (double)high.y - low.y;
    double step = sampling(low, high);
    double nx = floor(w / step) + 1, ny = floor(h / step) + 1, hits = 0;
    if (!(nx * ny <= 4e6))
        return 0; /* too thin or too large to sample */
    for (double j = 0; j < ny; j++)
        for (double i = 0; i < nx; i++)
            hits += inside(area, (JoxV2){(float)(low.x + (i + 0.5) * w / nx),
                                         (float)(low.y + (j + 0.5) * h / ny)});
    return hits / (nx * ny) * w * h;
}

/* Points of a lattice inside the area, row by row; the caller frees them. */
static uint32_t lattice(const JoxArea *area, bool hex, double step, JoxV2 **out) {
    JoxV2 low, high;
    *out = NULL;
    if (!extent(area, &low, &high) || !(step > 0))
        return 0;
    double rise = hex ? step * 0.8660254037844386 : step;
    double nx = floor(((double)high.x - low.x) / step) + 2;
    double ny = floor(((double)high.y - low.y) / rise) + 1;
    uint32_t count = 0, capacity = 0;
    if (!(nx * ny <= 5e7))
        return 0;
    for (double j = 0; j < ny; j++)
        for (double i = 0; i < nx; i++) {
            double shift = hex && fmod(j, 2) > 0 ? 0 : 0.5;
            JoxV2 p = {(float)(low.x + (i + shift) * step), (float)(low.y + (j + 0.5) * rise)};
            if (!inside(area, p))
                continue;
            JOX_RESERVE(*out, capacity, count + 1);
            JOX_ASSERT(count < capacity);
            (*out)[count++] = p;
        }
    return count;
}

uint32_t jox_fill(const JoxArea *area, JoxFillMode mode, uint32_t count, float spacing,
                  uint64_t seed, uint32_t stream, JoxV2 **positions) {
    bool hex = mode != JOX_FILL_GRID;
    double step = spacing;
    if (!(step > 0) && count > 0)
        step = sqrt(jox_area_size(area) / count * (hex ? 1.1547005383792515 : 1.0));
    double apart = mode == JOX_FILL_RANDOM && spacing > 0 ? step / 0.75 : step;
    uint32_t have = lattice(area, hex, apart, positions);
    /* A border may cost a row, and few points may all miss a narrow area: close up until the count
       fits. A spacing that was asked for is kept, but by one agent, who has nobody to keep it from.
     */
    JoxV2 low, high;
    bool closes = (!(spacing > 0) || (count == 1 && have == 0)) && extent(area, &low, &high);
    double finest = closes ? sampling(low, high) : 0;
    for (int i = 0; have < count && closes && (i < 40 || apart > finest); i++) {
        jox_free(*positions);
        apart *= 0.985;
        have = lattice(area, hex, apart, positions);
    }
    JoxV2 *p = *positions;
    JOX_ASSERT(have == 0 || p);
    if (have <= count && mode != JOX_FILL_RANDOM)
        return have;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < have && kept < count; i++) {
        /* Selection sampling: each point with the share still wanted of those still to come. */
        double u = jox_random_unit(seed, i, stream, JOX_DRAW_FILL, 0);
        if (u * (have - i) >= count - kept)
            continue;
        p[kept] = p[i];
        if (mode == JOX_FILL_RANDOM) {
            double ux = jox_random_unit(seed, i, stream, JOX_DRAW_FILL, 1) * 2 - 1;
            double uy = jox_random_unit(seed, i, stream, JOX_DRAW_FILL, 2) * 2 - 1;
            float most = (float)(apart * 0.0883883); /* an eighth, over the root of two */
            JoxV2 moved = {p[i].x + (float)ux * most, p[i].y + (float)uy * most};
            if (inside(area, moved))
                p[kept] = moved;
        }
        kept++;
    }
    JOX_ASSERT(kept <= count && kept <= have);
    return kept;
}
