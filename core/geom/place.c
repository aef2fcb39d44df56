#include "geom/place.h"

#include <string.h>

#include "base/mem.h"

static const float LINE_REACH = 0.5f; /* m: a line counts as entered within this distance */

/* Principal direction of a ring's corners about `centre`: the eigenvector of the larger eigenvalue
   of their covariance. */
static JoxV2 principal(const JoxPlace *place) {
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (uint32_t i = 0; i < place->count; i++) {
        JoxV2 d = jox_sub(place->points[i], place->centre);
        xx += (double)d.x * d.x;
        xy += (double)d.x * d.y;
        yy += (double)d.y * d.y;
    }
    double half = (xx - yy) / 2.0, root = sqrt(half * half + xy * xy);
    JoxV2 axis = half >= 0.0 ? (JoxV2){(float)(half + root), (float)xy}
                             : (JoxV2){(float)xy, (float)(root - half)};
    return jox_length2(axis) > 0.0f ? jox_unit(axis) : (JoxV2){1.0f, 0.0f};
}

static void finish_axis(JoxPlace *place) {
    place->axis_a = place->axis_b = place->centre;
    if (place->kind != JOX_PLACE_POLYGON) {
        place->axis_radius = place->radius;
        return;
    }
    JoxV2 along = principal(place), across = jox_left(along);
    float low_l = INFINITY, high_l = -INFINITY, low_w = INFINITY, high_w = -INFINITY;
    for (uint32_t i = 0; i < place->count; i++) {
        JoxV2 d = jox_sub(place->points[i], place->centre);
        float l = jox_dot(d, along), w = jox_dot(d, across);
        low_l = jox_minf(low_l, l);
        high_l = jox_maxf(high_l, l);
        low_w = jox_minf(low_w, w);
        high_w = jox_maxf(high_w, w);
    }
    float radius = (high_w - low_w) / 2.0f;
    JoxV2 middle = jox_add(place->centre, jox_scale(across, (low_w + high_w) / 2.0f));
    float from = low_l + radius, to = high_l - radius;
    if (from > to)
        from = to = (low_l + high_l) / 2.0f;
    place->axis_a = jox_add(middle, jox_scale(along, from));
    place->axis_b = jox_add(middle, jox_scale(along, to));
    place->axis_radius = radius;
}

void jox_place_finish(JoxPlace *place) {
    switch (place->kind) {
    case JOX_PLACE_POLYGON:
        place->centre = jox_polygon_centroid(place->points, place->count);
        break;
    case JOX_PLACE_LINE:
        place->centre = jox_scale(jox_add(place->points[0], place->points[1]), 0.5f);
        break;
    case JOX_PLACE_POINT:
    case JOX_PLACE_QUEUE:
        place->centre = place->points[0];
        break;
    case JOX_PLACE_SET:
        return;
    }
    finish_axis(place);
}

bool jox_place_contains(const JoxPlace *places, uint32_t index, JoxV2 point) {
    const JoxPlace *place = &places[index];
    switch (place->kind) {
    case JOX_PLACE_POLYGON:
        return jox_polygon_contains(place->points, place->count, point);
    case JOX_PLACE_SET:
        for (uint32_t i = 0; i < place->member_count; i++)
            if (jox_place_contains(places, (uint32_t)place->members[i], point))
                return true;
        return false;
    case JOX_PLACE_LINE:
        return jox_place_distance(places, index, point) <= LINE_REACH;
    case JOX_PLACE_QUEUE:
        return jox_place_distance(places, index, point) <= place->spacing / 2.0f;
    case JOX_PLACE_POINT:
        return jox_length(jox_sub(point, place->centre)) <= place->radius;
    }
    return false;
}

float jox_place_distance(const JoxPlace *places, uint32_t index, JoxV2 point) {
    const JoxPlace *place = &places[index];
    if (place->kind == JOX_PLACE_SET) {
        float best = INFINITY;
        for (uint32_t i = 0; i < place->member_count; i++)
            best = jox_minf(best, jox_place_distance(places, (uint32_t)place->members[i], point));
        return best;
    }
    if (place->kind == JOX_PLACE_POLYGON)
        return jox_polygon_distance(place->points, place->count, point, true);
    return jox_length(jox_sub(point, jox_place_nearest(places, index, point)));
}

JoxV2 jox_place_nearest(const JoxPlace *places, uint32_t index, JoxV2 point) {
    const JoxPlace *place = &places[index];
    JoxV2 best = place->centre;
    float least = INFINITY;
    switch (place->kind) {
    case JOX_PLACE_LINE:
        return jox_segment_nearest(place->points[0], place->points[1], point);
    case JOX_PLACE_POLYGON:
        if (jox_polygon_contains(place->points, place->count, point))
            return point;
        for (uint32_t i = 0; i < place->count; i++) {
            JoxV2 q =
                jox_segment_nearest(place->points[i], place->points[(i + 1) % place->count], point);
            float d = jox_length2(jox_sub(point, q));
            if (d < least) {
                least = d;
                best = q;
            }
        }
        return best;
    case JOX_PLACE_SET:
        for (uint32_t i = 0; i < place->member_count; i++) {
            JoxV2 q = jox_place_nearest(places, (uint32_t)place->members[i], point);
            float d = jox_length2(jox_sub(point, q));
            if (d < least) {
                least = d;
                best = q;
            }
        }
        return best;
    case JOX_PLACE_POINT:
    case JOX_PLACE_QUEUE:
        break;
    }
    return best;
}

JoxV2 jox_place_queue_point(const JoxPlace *place, float distance) {
    JoxV2 at = place->points[0], along = {0.0f, 0.0f};
    for (uint32_t i = 1; i < place->count; i++) {
        JoxV2 step = jox_sub(place->points[i], at);
        float length = jox_length(step);
        if (length > 0.0f)
            along = jox_scale(step, 1.0f / length);
        if (distance <= length)
            return jox_add(at, jox_scale(along, distance));
        distance -= length;
        at = place->points[i];
    }
    return jox_add(at, jox_scale(along, distance));
}

int jox_place_find(const JoxPlace *places, uint32_t count, const char *name) {
    for (uint32_t i = 0; i < count; i++)
        if (strcmp(places[i].name, name) == 0)
            return (int)i;
    return -1;
}

void jox_place_copy(JoxPlace *to, const JoxPlace *from) {
    *to = *from;
    to->name = jox_strdup(from->name);
    to->points = jox_alloc((size_t)from->count + 1, sizeof *to->points);
    to->members = jox_alloc((size_t)from->member_count + 1, sizeof *to->members);
    if (from->count)
        memcpy(to->points, from->points, from->count * sizeof *to->points);
    if (from->member_count)
        memcpy(to->members, from->members, from->member_count * sizeof *to->members);
}

void jox_place_free(JoxPlace *place) {
    jox_free(place->name);
    jox_free(place->points);
    jox_free(place->members);
    *place = (JoxPlace){0};
}
