#include "geom/place.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/pi.h"
#include "geom/place_kinds.h"
#include "simd/four.h"

static const float LINE_REACH = 0.5f; /* m: agents within this distance are at a line */

/* Returns the principal direction of a ring's corners about its centre: the eigenvector of the
   larger eigenvalue of their covariance. */
static JoxV2 find_principal_direction(const JoxPlace *place) {
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

/* Computes the stadium that orbits follow, from the extent along and across the principal
   direction. */
static void finish_axis(JoxPlace *place) {
    place->axis_a = place->axis_b = place->centre;
    if (!jox_place_is_area(place)) {
        place->axis_radius = place->radius;
        return;
    }
    JoxV2 along = find_principal_direction(place), across = jox_left(along);
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

/* ---- the kinds ---- */

static JoxV2 find_first_point(const JoxPlace *place) {
    return place->points[0];
}

/* Tests and nearest points by kind, for the table below; see jox_place_contains. */
static bool is_in_point(const JoxPlace *places, const JoxPlace *place, JoxV2 point) {
    (void)places;
    return jox_length(jox_sub(point, place->centre)) <= place->radius;
}

static JoxV2 nearest_is_centre(const JoxPlace *places, const JoxPlace *place, JoxV2 point) {
    (void)places, (void)point;
    return place->centre;
}

static JoxV2 find_line_middle(const JoxPlace *place) {
    return jox_scale(jox_add(place->points[0], place->points[1]), 0.5f);
}

static JoxV2 find_nearest_on_line(const JoxPlace *places, const JoxPlace *place, JoxV2 point) {
    (void)places;
    return jox_segment_nearest(place->points[0], place->points[1], point);
}

static bool is_near_line(const JoxPlace *places, const JoxPlace *place, JoxV2 point) {
    return jox_length(jox_sub(point, find_nearest_on_line(places, place, point))) <= LINE_REACH;
}

static JoxV2 find_centroid(const JoxPlace *place) {
    return jox_polygon_centroid(place->points, place->count);
}

static bool is_in_polygon(const JoxPlace *places, const JoxPlace *place, JoxV2 point) {
    (void)places;
    JOX_ASSERT(place->low.x <= place->high.x); /* the place is finished */
    return jox_is_within(point, place->low, place->high) &&
           jox_polygon_contains(place->points, place->count, point);
}

static JoxV2 find_nearest_on_polygon(const JoxPlace *places, const JoxPlace *place, JoxV2 point) {
    JoxV2 best = place->centre;
    float least = INFINITY;
    if (is_in_polygon(places, place, point))
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
}

static bool is_at_head(const JoxPlace *places, const JoxPlace *place, JoxV2 point) {
    (void)places;
    return jox_length(jox_sub(point, place->centre)) <= place->spacing / 2.0f;
}

/* Returns which of four boxes contain a point, one bit each. */
static inline uint32_t find_boxes_around(const JoxPlaceBoxes *boxes, JoxV2 point) {
    const JoxFour x = {point.x, point.x, point.x, point.x};
    const JoxFour y = {point.y, point.y, point.y, point.y};
    const JoxFourMask in = (x >= jox_load_four(boxes->low_x)) &
                           (x <= jox_load_four(boxes->high_x)) &
                           (y >= jox_load_four(boxes->low_y)) & (y <= jox_load_four(boxes->high_y));
    uint64_t halves[2];
    memcpy(halves, &in, sizeof halves);
    if (!(halves[0] | halves[1])) /* the common case: of many exits a point is at one at most */
        return 0;
    return (uint32_t)((in[0] & 1) | (in[1] & 2) | (in[2] & 4) | (in[3] & 8));
}

static bool is_in_member(const JoxPlace *places, const JoxPlace *place, JoxV2 point) {
    for (uint32_t first = 0; first < place->member_count; first += 4) {
        const uint32_t left = place->member_count - first;
        uint32_t in = place->boxes ? find_boxes_around(&place->boxes[first / 4], point)
                                   : (1u << (left < 4 ? left : 4)) - 1;
        for (; in; in &= in - 1) {
            const int32_t member = place->members[first + (uint32_t)__builtin_ctz(in)];
            if (jox_place_contains(places, (uint32_t)member, point))
                return true;
        }
    }
    return false;
}

static JoxV2 find_nearest_on_member(const JoxPlace *places, const JoxPlace *place, JoxV2 point) {
    JoxV2 best = place->centre;
    float least = INFINITY;
    for (uint32_t i = 0; i < place->member_count; i++) {
        JoxV2 q = jox_place_nearest(places, (uint32_t)place->members[i], point);
        float d = jox_length2(jox_sub(point, q));
        if (d < least) {
            least = d;
            best = q;
        }
    }
    return best;
}

const JoxPlaceKindInfo jox_place_kinds[JOX_PLACE_KINDS] = {
    [JOX_PLACE_POINT] = {.name = "point",
                         .form = JOX_FORM_SPOT,
                         .least_points = 1,
                         .most_points = 1,
                         .outline = JOX_OUTLINE_CIRCLE,
                         .goal_points = 1,
                         .centre = find_first_point,
                         .contains = is_in_point,
                         .nearest = nearest_is_centre,
                         .meaning = "a spot with a `radius`. Agents are inside while they are "
                                    "nearer than that."},
    [JOX_PLACE_LINE] = {.name = "line",
                        .form = JOX_FORM_LINE,
                        .least_points = 2,
                        .most_points = 2,
                        .outline = JOX_OUTLINE_OPEN,
                        .centre = find_line_middle,
                        .contains = is_near_line,
                        .nearest = find_nearest_on_line,
                        .meaning =
                            "two points. `crosses` is true in the step in which an agent passes "
                            "from the right of the line to its left, looking from the first point "
                            "to the second."},
    [JOX_PLACE_POLYGON] = {.name = "polygon",
                           .form = JOX_FORM_AREA,
                           .least_points = 3,
                           .most_points = UINT32_MAX,
                           .outline = JOX_OUTLINE_RING,
                           .centre = find_centroid,
                           .contains = is_in_polygon,
                           .nearest = find_nearest_on_polygon,
                           .meaning = "an area. Agents go about it (`orbit`), and with a `start` "
                                      "line their circuits are counted, anti-clockwise."},
    [JOX_PLACE_QUEUE] = {.name = "queue",
                         .form = JOX_FORM_QUEUE,
                         .least_points = 2,
                         .most_points = UINT32_MAX,
                         .outline = JOX_OUTLINE_OPEN,
                         .goal_points = 1,
                         .centre = find_first_point,
                         .contains = is_at_head,
                         .nearest = nearest_is_centre,
                         .meaning = "a line with bends in which people stand one behind the "
                                    "other, `spacing` apart; its first point is the head."},
    [JOX_PLACE_SET] = {.name = "set",
                       .form = JOX_FORM_SET,
                       .contains = is_in_member,
                       .nearest = find_nearest_on_member,
                       .meaning = "several places under one name: to be in one of them is to be "
                                  "in the set."},
};

const uint32_t jox_place_kind_count = JOX_PLACE_KINDS;

/* ---- functions of places ---- */

static const JoxPlaceKindInfo *get_kind(const JoxPlace *place) {
    JOX_ASSERT(place->kind < JOX_PLACE_KINDS && jox_place_kinds[place->kind].name);
    return &jox_place_kinds[place->kind];
}

JoxPlaceOutline jox_place_outline(const JoxPlace *place) {
    return get_kind(place)->outline;
}

uint32_t jox_place_goal_points(const JoxPlace *place) {
    const uint32_t goals = get_kind(place)->goal_points;
    return goals && goals < place->count ? goals : place->count;
}

float jox_place_radius(const JoxPlace *place) {
    return get_kind(place)->outline == JOX_OUTLINE_CIRCLE ? place->radius : 0.0f;
}

void jox_place_finish(JoxPlace *place) {
    if (!get_kind(place)->centre)
        return;
    JOX_ASSERT(place->count >= get_kind(place)->least_points);
    place->centre = get_kind(place)->centre(place);
    jox_bounds(place->points, place->count, &place->low, &place->high);
    finish_axis(place);
}

double jox_place_floor(const JoxPlace *place) {
    switch (jox_place_form(place)) {
    case JOX_FORM_SPOT:
        return JOX_PI * (double)place->radius * (double)place->radius;
    case JOX_FORM_AREA:
        return fabs(jox_polygon_area(place->points, place->count));
    case JOX_FORM_SET:
        return INFINITY;
    default:
        return 2.0 * (double)LINE_REACH *
               (double)jox_length(jox_sub(place->points[1], place->points[0]));
    }
}

void jox_place_make_spot(JoxPlace *place, JoxV2 at, float radius) {
    place->kind = JOX_PLACE_POINT;
    place->points[0] = at;
    place->count = 1;
    place->radius = radius;
}

void jox_place_make_line(JoxPlace *place) {
    JOX_ASSERT(place->count >= 2);
    place->kind = JOX_PLACE_LINE;
    place->count = 2;
}

void jox_place_make_area(JoxPlace *place) {
    JOX_ASSERT(place->count >= 3);
    place->kind = JOX_PLACE_POLYGON;
}

void jox_place_make_set(JoxPlace *place, uint32_t first, uint32_t count) {
    place->kind = JOX_PLACE_SET;
    place->members = jox_alloc((size_t)count + 1, sizeof *place->members);
    place->member_count = count;
    for (uint32_t m = 0; m < count; m++)
        place->members[m] = (int32_t)(first + m);
}

/* Returns the distance from its points within which people are at a place, m. */
static float find_place_reach(const JoxPlace *place) {
    const float HAIR = 0.01f; /* m: exceeds the rounding of distances */
    switch (jox_place_form(place)) {
    case JOX_FORM_SPOT:
        return place->radius + HAIR;
    case JOX_FORM_LINE:
        return LINE_REACH + HAIR;
    case JOX_FORM_QUEUE:
        return place->spacing / 2.0f + HAIR;
    default:
        return 0.0f;
    }
}

void jox_place_finish_set(const JoxPlace *places, JoxPlace *set, JoxPlaceBoxes *boxes) {
    JOX_ASSERT(jox_place_is_set(set));
    set->boxes = boxes;
    set->low = (JoxV2){INFINITY, INFINITY};
    set->high = (JoxV2){-INFINITY, -INFINITY};
    for (size_t i = 0; i < 4 * JOX_PLACE_FOURS(set->member_count); i++) {
        JoxV2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
        if (i < set->member_count) {
            const JoxPlace *member = &places[set->members[i]];
            const float reach = find_place_reach(member);
            JOX_ASSERT(!jox_place_is_set(member));
            low = (JoxV2){member->low.x - reach, member->low.y - reach};
            high = (JoxV2){member->high.x + reach, member->high.y + reach};
        }
        boxes[i / 4].low_x[i % 4] = low.x;
        boxes[i / 4].low_y[i % 4] = low.y;
        boxes[i / 4].high_x[i % 4] = high.x;
        boxes[i / 4].high_y[i % 4] = high.y;
        set->low = (JoxV2){jox_minf(set->low.x, low.x), jox_minf(set->low.y, low.y)};
        set->high = (JoxV2){jox_maxf(set->high.x, high.x), jox_maxf(set->high.y, high.y)};
    }
}

bool jox_place_contains(const JoxPlace *places, uint32_t index, JoxV2 point) {
    return get_kind(&places[index])->contains(places, &places[index], point);
}

void jox_place_contains_each(const JoxPlace *places, uint32_t index, const JoxV2 *points,
                             uint32_t count, bool *in) {
    const JoxPlace *place = &places[index];
    /* For a few members, one test of their boxes rejects nearly all points. */
    const bool boxed = jox_place_is_set(place) && place->boxes && place->member_count <= 4;
    for (uint32_t k = 0; k < count; k++)
        in[k] = (!boxed || find_boxes_around(place->boxes, points[k])) &&
                get_kind(place)->contains(places, place, points[k]);
}

float jox_place_distance(const JoxPlace *places, uint32_t index, JoxV2 point) {
    const JoxPlace *place = &places[index];
    if (jox_place_is_set(place)) { /* the nearest member: it may be a polygon with the point */
        float best = INFINITY;
        for (uint32_t i = 0; i < place->member_count; i++)
            best = jox_minf(best, jox_place_distance(places, (uint32_t)place->members[i], point));
        return best;
    }
    if (jox_place_is_area(place))
        return is_in_polygon(places, place, point)
                   ? 0.0f
                   : jox_polygon_distance(place->points, place->count, point, false);
    return jox_length(jox_sub(point, jox_place_nearest(places, index, point)));
}

JoxV2 jox_place_nearest(const JoxPlace *places, uint32_t index, JoxV2 point) {
    return get_kind(&places[index])->nearest(places, &places[index], point);
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

/* ---- copies ---- */

void jox_place_copy(JoxPlace *to, const JoxPlace *from) {
    *to = *from;
    to->name = jox_strdup(from->name);
    to->points = jox_copy_array(from->points, from->count, sizeof *to->points);
    to->members = jox_copy_array(from->members, from->member_count, sizeof *to->members);
    const size_t fours = from->boxes ? JOX_PLACE_FOURS(from->member_count) : 0;
    to->boxes = fours ? jox_alloc(fours, sizeof *to->boxes) : NULL;
    if (fours)
        memcpy(to->boxes, from->boxes, fours * sizeof *to->boxes);
}

void jox_place_free(JoxPlace *place) {
    jox_free(place->name);
    jox_free(place->points);
    jox_free(place->members);
    jox_free(place->boxes);
    *place = (JoxPlace){0};
}

static bool has_same_boxes(const JoxPlace *a, const JoxPlace *b) {
    return !a->boxes == !b->boxes &&
           (!a->boxes ||
            !memcmp(a->boxes, b->boxes, JOX_PLACE_FOURS(a->member_count) * sizeof *a->boxes));
}

bool jox_place_same(const JoxPlace *a, const JoxPlace *b) {
    return a->kind == b->kind && a->count == b->count && a->radius == b->radius &&
           a->spacing == b->spacing && a->start == b->start &&
           a->landing_radius == b->landing_radius &&
           !memcmp(&a->landing, &b->landing, sizeof a->landing) &&
           a->member_count == b->member_count &&
           (!a->count || !memcmp(a->points, b->points, a->count * sizeof *a->points)) &&
           (!a->member_count ||
            !memcmp(a->members, b->members, a->member_count * sizeof *a->members)) &&
           has_same_boxes(a, b);
}

/* ---- descriptions of positions ---- */

static const float NEAR = 10.0f; /* m: places farther away are not mentioned */

/* Returns the smallest area that contains the point; NULL: none. */
static const JoxPlace *find_area_around(const JoxPlace *places, uint32_t count, JoxV2 at) {
    const JoxPlace *found = NULL;
    double least = INFINITY;
    for (uint32_t p = 0; p < count; p++) {
        const JoxPlace *place = &places[p];
        if (!jox_place_is_area(place) || !place->name ||
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

/* Returns the nearest named place within NEAR and its distance `away`, m; NULL: none. */
static const JoxPlace *find_place_near(const JoxPlace *places, uint32_t count, JoxV2 at,
                                       float *away) {
    const JoxPlace *found = NULL;
    *away = NEAR;
    for (uint32_t p = 0; p < count; p++) {
        if (jox_place_is_set(&places[p]) || !places[p].name || places[p].count == 0)
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
    const JoxPlace *place = find_area_around(places, count, at);
    if (place) {
        jox_text_printf(out, ", in %.60s", place->name);
        return;
    }
    place = near ? find_place_near(places, count, at, &away) : NULL;
    if (place)
        jox_text_printf(out, ", %.1f m from %.60s", (double)away, place->name);
}

JoxPlace *jox_places_copy_goal(const JoxPlace *places, uint32_t place, uint32_t *count) {
    const JoxPlace *from = &places[place];
    JoxPlace *goal = jox_alloc(1 + (size_t)from->member_count, sizeof *goal);
    *count = 1 + from->member_count;
    jox_place_copy(&goal[0], from);
    for (uint32_t m = 0; m < from->member_count; m++) {
        JOX_ASSERT(from->members[m] >= 0);
        jox_place_copy(&goal[m + 1], &places[from->members[m]]);
        goal[0].members[m] = (int32_t)m + 1;
    }
    return goal;
}

void jox_places_free_goal(JoxPlace *places, uint32_t count) {
    for (uint32_t p = 0; p < count; p++)
        jox_place_free(&places[p]);
    jox_free(places);
}
