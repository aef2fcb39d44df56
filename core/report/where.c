/* A point of the plan in words. */
#include <math.h>

#include "geom/polygon.h"
#include "report/subject.h"

static const float NEAR_LINE = 4.0f, NEAR_PLACE = 10.0f; /* m: what is farther is not mentioned */

/* The line of a probe that is nearest; NULL where none is near. */
static const JoxProbeDef *line_near(const JoxSubject *s, JoxV2 at, float *away) {
    const JoxProbeDef *found = NULL;
    *away = NEAR_LINE;
    for (uint32_t p = 0; p < s->probe_count; p++) {
        const JoxProbeDef *def = jox_probe_def(s->probes[p]);
        if (def->kind != JOX_PROBE_FLOW)
            continue;
        const JoxV2 on = jox_segment_nearest(def->points[0], def->points[1], at);
        const float distance = jox_length(jox_sub(on, at));
        if (distance < *away) {
            *away = distance;
            found = def;
        }
    }
    return found;
}

/* The smallest area among the places in which the point lies; NULL: none. */
static const JoxPlace *area_about(const JoxSubject *s, JoxV2 at) {
    const JoxPlace *found = NULL;
    double least = INFINITY;
    for (uint32_t p = 0; p < s->place_count; p++) {
        const JoxPlace *place = &s->places[p];
        if (place->kind != JOX_PLACE_POLYGON || !place->name ||
            !jox_polygon_contains(place->points, place->count, at))
            continue;
        const double area = fabs(jox_polygon_area(place->points, place->count));
        if (area < least) {
            least = area;
            found = place;
        }
    }
    return found;
}

static const JoxPlace *place_near(const JoxSubject *s, JoxV2 at, float *away) {
    const JoxPlace *found = NULL;
    *away = NEAR_PLACE;
    for (uint32_t p = 0; p < s->place_count; p++) {
        const JoxPlace *place = &s->places[p];
        if (place->kind == JOX_PLACE_SET || !place->name || place->count == 0)
            continue;
        const float distance = jox_place_distance(s->places, p, at);
        if (distance < *away) {
            *away = distance;
            found = place;
        }
    }
    return found;
}

void jox_where(const JoxSubject *s, JoxV2 at, JoxText *out) {
    float away;
    const JoxProbeDef *line = line_near(s, at, &away);
    const JoxPlace *area = area_about(s, at);
    jox_text_printf(out, "(%.1f, %.1f) m", (double)at.x, (double)at.y);
    if (line)
        jox_text_printf(out, ", %.1f m from the line %.60s", (double)away, line->name);
    if (area)
        jox_text_printf(out, ", in %.60s", area->name);
    const JoxPlace *near = line || area ? NULL : place_near(s, at, &away);
    if (near)
        jox_text_printf(out, ", %.1f m from %.60s", (double)away, near->name);
}
