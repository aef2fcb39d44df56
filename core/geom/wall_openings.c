/* Finds the parts of a line that walls leave free (jox_walls_openings), for probes at lines
   (record). */
#include <math.h>

#include "base/sort.h"
#include "geom/walls.h"

enum { MOST = 512 /* greatest number of wall stretches on a line */ };
static const float NARROW = 0.25f; /* m: too narrow for people */

typedef struct Stretch {
    float first, last; /* shares of the line's length */
} Stretch;

/* Finds the part of a wall's edge within 1 cm of a line, as shares of the line's length; false if
   there is none. */
static bool clip_to_line(JoxV2 from, JoxV2 along, JoxV2 p, JoxV2 q, float *first, float *last) {
    const float length = jox_length(along), hair = 0.01f;
    const JoxV2 unit = jox_scale(along, 1.0f / length);
    const float beside_p = jox_det(unit, jox_sub(p, from));
    const float by = jox_det(unit, jox_sub(q, from)) - beside_p;
    float low = 0.0f, high = 1.0f; /* shares of the edge */
    if (by == 0.0f) {
        if (fabsf(beside_p) > hair)
            return false;
    } else {
        const float in = (-hair - beside_p) / by, out = (hair - beside_p) / by;
        low = jox_maxf(low, jox_minf(in, out));
        high = jox_minf(high, jox_maxf(in, out));
    }
    if (low > high)
        return false;
    const JoxV2 edge = jox_sub(q, p);
    const float one = jox_dot(unit, jox_sub(jox_add(p, jox_scale(edge, low)), from)) / length;
    const float two = jox_dot(unit, jox_sub(jox_add(p, jox_scale(edge, high)), from)) / length;
    *first = jox_minf(one, two);
    *last = jox_maxf(one, two);
    return true;
}

static int compare_wall_stretches(const void *a, const void *b, const void *context) {
    const float x = ((const Stretch *)a)->first, y = ((const Stretch *)b)->first;
    (void)context;
    return (x > y) - (x < y);
}

/* Lists the stretches of walls on the line, by their beginning. Returns their number, MOST + 1 if
   there are more. */
static uint32_t find_stretches(const JoxWalls *walls, JoxV2 from, JoxV2 along, Stretch *out) {
    uint32_t count = 0;
    for (uint32_t r = 0; walls && r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        for (uint32_t v = ring->first; !ring->open && v < ring->first + ring->count; v++) {
            const JoxWallVertex *vertex = &walls->vertices[v];
            Stretch s;
            if (!clip_to_line(from, along, vertex->point, walls->vertices[vertex->next].point,
                              &s.first, &s.last) ||
                s.last < 0.0f || s.first > 1.0f)
                continue;
            if (count == MOST)
                return MOST + 1;
            out[count++] = s;
        }
    }
    if (count)
        jox_sort(out, count, sizeof *out, compare_wall_stretches, NULL, NULL);
    return count;
}

/* Returns whether a point is inside a solid, by crossing number. */
static bool is_inside_solid(const JoxWalls *walls, JoxV2 at) {
    for (uint32_t r = 0; walls && r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        bool within = false;
        for (uint32_t v = ring->first; ring->solid && v < ring->first + ring->count; v++) {
            const JoxV2 p = walls->vertices[v].point;
            const JoxV2 q = walls->vertices[walls->vertices[v].next].point;
            if ((p.y > at.y) != (q.y > at.y) &&
                at.x < p.x + (q.x - p.x) * (at.y - p.y) / (q.y - p.y))
                within = !within;
        }
        if (within)
            return true;
    }
    return false;
}

/* Adds the free part from `low` to `high`, shares of the line's length, if it counts. */
static void add_opening(JoxWallOpenings *out, const JoxWalls *walls, const JoxV2 line[2], float low,
                        float high) {
    const JoxV2 along = jox_sub(line[1], line[0]);
    const float width = jox_length(along) * (high - low);
    const bool middle = low < 0.5f && high > 0.5f;
    /* Parts beyond the outermost walls belong to another place, unless they contain the middle. */
    if (!middle && (low <= 0.0f || high >= 1.0f || width < NARROW))
        return;
    if (out->count == JOX_WALL_OPENINGS ||
        is_inside_solid(walls, jox_add(line[0], jox_scale(along, 0.5f * (low + high)))))
        return;
    out->ends[out->count][0] = jox_add(line[0], jox_scale(along, low));
    out->ends[out->count++][1] = jox_add(line[0], jox_scale(along, high));
    out->width += width;
}

void jox_walls_openings(const JoxWalls *walls, const JoxV2 line[2], JoxWallOpenings *out) {
    const JoxV2 along = jox_sub(line[1], line[0]);
    Stretch stretches[MOST];
    *out = (JoxWallOpenings){0};
    const uint32_t count =
        jox_dot(along, along) > 0.0f ? find_stretches(walls, line[0], along, stretches) : 0;
    float free_from = 0.0f;
    for (uint32_t s = 0; count <= MOST && s < count; s++) {
        if (stretches[s].first > free_from)
            add_opening(out, walls, line, free_from, stretches[s].first);
        free_from = jox_maxf(free_from, stretches[s].last);
    }
    if (count <= MOST && free_from < 1.0f)
        add_opening(out, walls, line, free_from, 1.0f);
    if (out->count)
        return;
    out->ends[0][0] = line[0];
    out->ends[0][1] = line[1];
    out->count = 1;
    out->width = jox_length(along);
}
