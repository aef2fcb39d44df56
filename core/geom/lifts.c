#include "geom/lifts.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/sort.h"
#include "base/text.h"
#include "geom/polygon.h"

static const float WIDEST = 0.7f;   /* m: between riders where there is room */
static const float CLOSEST = 0.25f; /* m */
static const float TIGHTER = 0.95f; /* from one spacing to the next that is tried */

const char *const jox_lift_mode_names[] = {"in_use", "out_of_use", "firemen"};

bool jox_lift_contains(const JoxLift *lift, JoxV2 plan) {
    return jox_is_within(plan, lift->low, lift->high) &&
           jox_polygon_contains(lift->outline, lift->point_count, plan);
}

int32_t jox_lift_stop_at(const JoxLift *lift, uint32_t storey) {
    for (uint32_t s = 0; s < lift->stop_count; s++)
        if (lift->stops[s].storey == storey)
            return (int32_t)s;
    return -1;
}

/* Returns the unit vector out of the car through a stop's door. */
static JoxV2 find_way_out(const JoxLift *lift, const JoxLiftStop *stop) {
    const JoxV2 normal = jox_left(jox_unit(jox_sub(stop->door[1], stop->door[0])));
    const JoxV2 middle = jox_scale(jox_add(stop->door[0], stop->door[1]), 0.5f);
    const JoxV2 inside = jox_add(middle, jox_scale(normal, 0.05f));
    return jox_polygon_contains(lift->outline, lift->point_count, inside) ? jox_scale(normal, -1.0f)
                                                                          : normal;
}

JoxV2 jox_lift_point_outside(const JoxLift *lift, uint32_t stop, float metres) {
    const JoxLiftStop *at = &lift->stops[stop];
    const JoxV2 middle = jox_scale(jox_add(at->door[0], at->door[1]), 0.5f);
    return jox_add(middle, jox_scale(find_way_out(lift, at), metres));
}

JoxV2 jox_lift_outside(const JoxLift *lift, uint32_t stop, const JoxStoreys *storeys) {
    return jox_on_sheet(storeys, lift->stops[stop].storey,
                        jox_lift_point_outside(lift, stop, 0.6f));
}

double jox_lift_travel_time(const JoxLift *lift, double metres) {
    const double way = fabs(metres), v = (double)lift->speed, a = (double)lift->acceleration;
    return way >= v * v / a ? way / v + v / a : 2.0 * sqrt(way / a);
}

double jox_lift_usual_time(const JoxLift *lift, uint32_t from, uint32_t to) {
    const JoxLiftStop *stops = lift->stops;
    const double height = (double)stops[lift->stop_count - 1].height - (double)stops[0].height;
    return jox_lift_travel_time(lift, 0.5 * height) +
           jox_lift_travel_time(lift, (double)stops[to].height - (double)stops[from].height) +
           (double)lift->opening + (double)lift->closing + (double)lift->dwell;
}

static void lay_out_stop(const JoxLift *lift, JoxLiftStop *stop, const JoxStoreys *storeys) {
    stop->middle = jox_scale(jox_add(stop->door[0], stop->door[1]), 0.5f);
    stop->half = 0.5f * jox_length(jox_sub(stop->door[1], stop->door[0]));
    stop->height = storeys->storeys[stop->storey].height;
    stop->out = find_way_out(lift, stop);
}

static int compare_depths(const void *left, const void *right, const void *context) {
    const JoxLiftStop *stop = context;
    const JoxV2 *a = left, *b = right;
    const float da = jox_dot(jox_sub(*a, stop->middle), stop->out);
    const float db = jox_dot(jox_sub(*b, stop->middle), stop->out);
    if (da != db)
        return da < db ? -1 : 1;
    const JoxV2 along = jox_left(stop->out);
    const float aside = jox_dot(jox_sub(*a, *b), along);
    return aside < 0.0f ? -1 : aside > 0.0f;
}

/* Writes the points of a grid of this spacing in the car, in line with the first door, that are not
   nearer to its sides than `clear`; returns how many, at most `most`. */
static uint32_t lay_grid(const JoxLift *lift, float spacing, float clear, JoxV2 *out,
                         uint32_t most) {
    const JoxLiftStop *stop = &lift->stops[0];
    const JoxV2 along = jox_left(stop->out);
    float low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (uint32_t k = 0; k < lift->point_count; k++) {
        const JoxV2 from = jox_sub(lift->outline[k], stop->middle);
        const float at[2] = {jox_dot(from, along), jox_dot(from, stop->out)};
        for (int c = 0; c < 2; c++) {
            low[c] = jox_minf(low[c], at[c]);
            high[c] = jox_maxf(high[c], at[c]);
        }
    }
    int n[2];
    float first[2];
    for (int c = 0; c < 2; c++) { /* centred in the box */
        const float room = jox_maxf(high[c] - low[c] - 2.0f * clear, 0.0f);
        n[c] = (int)floorf(room / spacing + 1e-3f) + 1;
        first[c] = 0.5f * (low[c] + high[c] - (float)(n[c] - 1) * spacing);
    }
    uint32_t count = 0;
    for (int i = 0; i < n[1]; i++)
        for (int j = 0; j < n[0] && count < most; j++) {
            const JoxV2 at =
                jox_add(stop->middle, jox_add(jox_scale(along, first[0] + (float)j * spacing),
                                              jox_scale(stop->out, first[1] + (float)i * spacing)));
            if (jox_lift_contains(lift, at) &&
                jox_polygon_distance(lift->outline, lift->point_count, at, false) >= 0.9f * clear)
                out[count++] = at;
        }
    return count;
}

static void lay_spots(JoxLift *lift) {
    const uint32_t most = JOX_CAR_SPOTS(lift->capacity);
    lift->spots = jox_realloc(lift->spots, most + JOX_SORT_SPARE(most), sizeof *lift->spots);
    lift->spot_count = 0;
    for (float spacing = WIDEST; spacing > CLOSEST && lift->spot_count < lift->capacity;
         spacing *= TIGHTER)
        lift->spot_count =
            lay_grid(lift, spacing, jox_minf(0.25f, 0.5f * spacing), lift->spots, most);
    if (lift->spot_count == 0)
        lift->spots[lift->spot_count++] = jox_polygon_centroid(lift->outline, lift->point_count);
    for (uint32_t k = 0; lift->spot_count < lift->capacity; k++) /* more people than fit */
        lift->spots[lift->spot_count++] = lift->spots[k];
    jox_sort(lift->spots, lift->spot_count, sizeof *lift->spots, compare_depths, &lift->stops[0],
             lift->spots + most);
}

void jox_lift_lay_out(JoxLift *lift, const JoxStoreys *storeys) {
    JOX_ASSERT(lift->stop_count > 0 && lift->point_count >= 3 && lift->capacity > 0);
    jox_bounds(lift->outline, lift->point_count, &lift->low, &lift->high);
    for (uint32_t s = 0; s < lift->stop_count; s++)
        lay_out_stop(lift, &lift->stops[s], storeys);
    lay_spots(lift);
}

/* ---- walls ---- */

/* Returns the edge of the outline on which a point lies, the nearest one. */
static uint32_t find_edge(const JoxLift *lift, JoxV2 at) {
    uint32_t best = 0;
    float least = INFINITY;
    for (uint32_t k = 0; k < lift->point_count; k++) {
        const JoxV2 a = lift->outline[k], b = lift->outline[(k + 1) % lift->point_count];
        const float gap = jox_length2(jox_sub(jox_segment_nearest(a, b, at), at));
        if (gap < least) {
            least = gap;
            best = k;
        }
    }
    return best;
}

/* Adds the outline on a storey except for the door, from one end of the door round to the other. */
static void add_shaft_with_door(const JoxLift *lift, const JoxLiftStop *stop,
                                const JoxStoreys *storeys, JoxWalls *walls) {
    const JoxV2 middle = jox_scale(jox_add(stop->door[0], stop->door[1]), 0.5f);
    const uint32_t n = lift->point_count, edge = find_edge(lift, middle);
    JoxV2 *points = jox_alloc((size_t)n + 2, sizeof *points), door[2];
    const JoxV2 towards = jox_sub(lift->outline[(edge + 1) % n], lift->outline[edge]);
    const bool ahead = jox_dot(jox_sub(stop->door[1], stop->door[0]), towards) > 0.0f;
    door[0] = jox_on_sheet(storeys, stop->storey, stop->door[ahead ? 0 : 1]);
    door[1] = jox_on_sheet(storeys, stop->storey, stop->door[ahead ? 1 : 0]);
    uint32_t count = 0;
    points[count++] = door[1];
    for (uint32_t k = 1; k <= n; k++) {
        const JoxV2 at = jox_on_sheet(storeys, stop->storey, lift->outline[(edge + k) % n]);
        if (jox_length(jox_sub(at, points[count - 1])) > 1e-3f &&
            (k < n || jox_length(jox_sub(at, door[0])) > 1e-3f))
            points[count++] = at;
    }
    points[count++] = door[0];
    jox_walls_add_polyline(walls, points, count, false, INFINITY);
    const uint32_t gate = walls->ring_count;
    jox_walls_add_polyline(walls, door, 2, false, INFINITY);
    jox_walls_name(walls, gate, stop->name, false);
    walls->rings[gate].is_lift_door = true;
    jox_free(points);
}

void jox_lift_add_walls(const JoxLift *lift, const JoxStoreys *storeys, JoxWalls *walls) {
    const uint32_t last = lift->stops[lift->stop_count - 1].storey;
    for (uint32_t storey = lift->stops[0].storey; storey <= last; storey++) {
        const int32_t s = jox_lift_stop_at(lift, storey);
        if (s >= 0) {
            add_shaft_with_door(lift, &lift->stops[s], storeys, walls);
            continue;
        }
        JoxV2 *points = jox_alloc(lift->point_count, sizeof *points);
        for (uint32_t k = 0; k < lift->point_count; k++)
            points[k] = jox_on_sheet(storeys, storey, lift->outline[k]);
        jox_walls_add_solid(walls, points, lift->point_count, INFINITY);
        jox_free(points);
    }
}

/* ---- memory ---- */

char *jox_lift_stop_name(const char *lift, const char *storey) {
    JoxText name = {0};
    jox_text_printf(&name, "%.100s.%.100s", lift, storey);
    return name.data;
}

void jox_lift_copy(JoxLift *to, const JoxLift *from) {
    *to = *from;
    to->name = jox_strdup(from->name);
    to->outline = jox_alloc(from->point_count, sizeof *to->outline);
    memcpy(to->outline, from->outline, from->point_count * sizeof *to->outline);
    to->stops = jox_alloc(from->stop_count, sizeof *to->stops);
    memcpy(to->stops, from->stops, from->stop_count * sizeof *to->stops);
    for (uint32_t s = 0; s < from->stop_count; s++)
        to->stops[s].name = jox_strdup(from->stops[s].name);
    to->spots = NULL;
    to->spot_count = 0;
}

void jox_lift_free(JoxLift *lift) {
    for (uint32_t s = 0; s < lift->stop_count; s++)
        jox_free(lift->stops[s].name);
    jox_free(lift->name);
    jox_free(lift->outline);
    jox_free(lift->stops);
    jox_free(lift->spots);
    *lift = (JoxLift){0};
}
