#include "body/drive_path.h"

#include <math.h>
#include <stddef.h>

#include "base/assert.h"

static const double FASTEST = 100.0; /* m/s */
static const double LONGEST = 1e9;   /* s: longest stop or delay */

static const double *get_path_point(const JoxBodyPath *p, uint32_t n) {
    return p->points + 3 * (size_t)(n % p->count);
}

static double compute_point_distance(const double a[3], const double b[3]) {
    const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    return sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

const char *jox_path_find_fault(const JoxBodyPath *p) {
    if (p->count < 2 || p->count > JOX_PATH_POINTS)
        return "a path has 1 to 255 points beside the one where the body begins";
    if (!(p->speed > 0.0 && p->speed <= FASTEST))
        return "the speed of a path must be above 0 and at most 100 m/s";
    if (!(p->after >= 0.0 && p->after <= LONGEST) || !(p->wait >= 0.0 && p->wait <= LONGEST))
        return "a body on a path waits for 0 to 1e9 s";
    if (p->end > JO_PATH_ROUND)
        return "the end of a path is unknown";
    for (uint32_t k = 0; k < 3 * p->count; k++)
        if (!(fabs(p->points[k]) <= 1e4))
            return "the points of a path must lie within 10 km of the origin";
    for (uint32_t n = 0; n + 1 < p->count; n++)
        if (!(compute_point_distance(get_path_point(p, n), get_path_point(p, n + 1)) >= 1e-3))
            return "two points of a path that follow each other are 1 mm apart at least";
    return NULL;
}

/* Writes both ends of leg n, counted within one round (count_legs). */
static void find_leg_ends(const JoxBodyPath *p, uint32_t n, const double **from,
                          const double **to) {
    const uint32_t last = p->count - 1;
    const bool returns = p->end == JO_PATH_BACK && n >= last;
    *from = returns ? get_path_point(p, 2 * last - n) : get_path_point(p, n);
    *to = returns ? get_path_point(p, 2 * last - n - 1) : get_path_point(p, n + 1);
}

/* Number of legs until the path ends or repeats. */
static uint32_t count_legs(const JoxBodyPath *p) {
    return p->end == JO_PATH_STAY   ? p->count - 1
           : p->end == JO_PATH_BACK ? 2 * (p->count - 1)
                                    : p->count;
}

static double compute_leg_time(const JoxBodyPath *p, uint32_t n) {
    const double *from, *to;
    find_leg_ends(p, n, &from, &to);
    return compute_point_distance(from, to) / p->speed;
}

/* Returns the spot `time` seconds along leg n; `still`: the body stands there. */
static JoxPathSpot compute_leg_spot(const JoxBodyPath *p, uint32_t n, double time, bool still) {
    const double *from, *to, whole = compute_leg_time(p, n);
    const double share = whole > 0.0 ? fmin(1.0, time / whole) : 1.0;
    JoxPathSpot spot = {0};
    find_leg_ends(p, n, &from, &to);
    for (int k = 0; k < 3; k++) {
        spot.at[k] = share >= 1.0 ? to[k] : from[k] + share * (to[k] - from[k]);
        spot.velocity[k] = still || whole <= 0.0 ? 0.0 : (to[k] - from[k]) / whole;
    }
    return spot;
}

JoxPathSpot jox_path_spot(const JoxBodyPath *p, double time) {
    const uint32_t legs = count_legs(p);
    double left = time - p->after, round = 0.0;
    JOX_ASSERT(p->count >= 2 && p->speed > 0.0);
    if (left < 0.0)
        return compute_leg_spot(p, 0, 0.0, true);
    for (uint32_t n = 0; n < legs; n++)
        round += compute_leg_time(p, n) + p->wait;
    if (p->end != JO_PATH_STAY)
        left = fmod(left, round);
    for (uint32_t n = 0; n < legs; n++) {
        const double way = compute_leg_time(p, n);
        if (left < way)
            return compute_leg_spot(p, n, left, false);
        if (left < way + p->wait)
            return compute_leg_spot(p, n, way, true);
        left -= way + p->wait;
    }
    return compute_leg_spot(p, legs - 1, compute_leg_time(p, legs - 1), true);
}

double jox_path_leg_began(const JoxBodyPath *p, double time) {
    const uint32_t legs = count_legs(p);
    double began = p->after, round = 0.0;
    for (uint32_t n = 0; n < legs; n++)
        round += compute_leg_time(p, n) + p->wait;
    if (p->end != JO_PATH_STAY && time > p->after)
        began += floor((time - p->after) / round) * round;
    for (uint32_t n = 0; n + 1 < legs; n++) {
        const double next = began + compute_leg_time(p, n) + p->wait;
        if (!(time >= next))
            break;
        began = next;
    }
    return began;
}
