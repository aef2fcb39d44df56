/* Writes the walkable area of a recording as well-known text (jox_wkt, jox_wkt_outlines). */
#include "base/mem.h"
#include "geom/polygon.h"
#include "record/recorder.h"

/* Appends ", (x y, ...)", the closed ring of a wall; no comma before the first. */
static void append_ring(const JoxWalls *walls, uint32_t ring, bool first, JoxText *out) {
    const struct JoxWallRing *r = &walls->rings[ring];
    jox_text_add(out, first ? "(" : ", (");
    for (uint32_t i = 0; i <= r->count; i++) {
        JoxV2 p = walls->vertices[r->first + i % r->count].point;
        jox_text_printf(out, "%s%.7g %.7g", i ? ", " : "", p.x, p.y);
    }
    jox_text_add(out, ")");
}

/* Returns whether a solid wall lies within an outline entirely: a hole must not extend beyond
   it. */
static bool is_hole_of_outline(const JoxWalls *walls, uint32_t solid, const JoxV2 *outline,
                               uint32_t count) {
    const struct JoxWallRing *s = &walls->rings[solid];
    bool within = s->solid;
    for (uint32_t i = s->first; within && i < s->first + s->count; i++)
        within = jox_polygon_contains(outline, count, walls->vertices[i].point);
    return within;
}

static void append_outline(const JoxWalls *walls, uint32_t ring, JoxText *out) {
    JoxV2 *outline = jox_walls_ring_points(walls, ring);
    jox_text_add(out, "(");
    append_ring(walls, ring, true, out);
    for (uint32_t r = 0; r < walls->ring_count; r++)
        if (is_hole_of_outline(walls, r, outline, walls->rings[ring].count))
            append_ring(walls, r, false, out);
    jox_text_add(out, ")");
    jox_free(outline);
}

void jox_wkt_outlines(const JoxWalls *walls, JoxText *out) {
    uint32_t outlines = 0, put = 0;
    for (uint32_t r = 0; r < walls->ring_count; r++)
        outlines += walls->rings[r].outline;
    jox_text_add(out, outlines > 1 ? "MULTIPOLYGON (" : "POLYGON ");
    for (uint32_t r = 0; r < walls->ring_count; r++)
        if (walls->rings[r].outline) {
            jox_text_add(out, put++ ? ", " : "");
            append_outline(walls, r, out);
        }
    jox_text_add(out, outlines > 1 ? ")" : "");
}

void jox_wkt(const JoxWalls *walls, JoxV2 low, JoxV2 high, JoxText *out) {
    jox_text_printf(out, "POLYGON ((%g %g, %g %g, %g %g, %g %g, %g %g)", low.x, low.y, high.x,
                    low.y, high.x, high.y, low.x, high.y, low.x, low.y);
    for (uint32_t r = 0; r < walls->ring_count; r++)
        if (walls->rings[r].solid)
            append_ring(walls, r, false, out);
    jox_text_add(out, ")");
}
