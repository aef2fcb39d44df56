/* A point among places, in words. */
#include <math.h>

#include "geom/place.h"

static const float NEAR = 10.0f; /* m: what is farther is not mentioned */

/* The smallest area in which the point lies; NULL: none. */
static const JoxPlace *area_about(const JoxPlace *places, uint32_t count, JoxV2 at) {
    const JoxPlace *found = NULL;
    double least = INFINITY;
    for (uint32_t p = 0; p < count; p++) {
        const JoxPlace *place = &places[p];
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

static const JoxPlace *place_near(const JoxPlace *places, uint32_t count, JoxV2 at, float *away) {
    const JoxPlace *found = NULL;
    *away = NEAR;
    for (uint32_t p = 0; p < count; p++) {
        if (places[p].kind == JOX_PLACE_SET || !places[p].name || places[p].count == 0)
            continue;
        const float distance = jox_place_distance(places, p, at);
        if (distance < *away) {
            *away = distance;
            found = &places[p];
        }
    }
    return found;
}

void jox_place_where(const JoxPlace *places, uint32_t count, JoxV2 at, bool near, JoxText *out) {
    float away;
    const JoxPlace *place = area_about(places, count, at);
    if (place) {
        jox_text_printf(out, ", in %.60s", place->name);
        return;
    }
    place = near ? place_near(places, count, at, &away) : NULL;
    if (place)
        jox_text_printf(out, ", %.1f m from %.60s", (double)away, place->name);
}
