/* The two-dimensional linear program over half-planes and a disc of velocities (de Berg et al.,
   Computational Geometry, ch. 4; van den Berg et al. 2011 for the fallback in three dimensions). */
#include "base/assert.h"
#include "nav/internal.h"

static const float EPSILON = 1e-5f;
enum { MOST_HALF_PLANES = 128 };

/* What is optimised: the velocity nearest to `wanted`; or, where directed, the one farthest along
   `direction`, and of several such the nearest to `wanted`. */
typedef struct Objective {
    JoxV2 wanted, direction;
    bool directed;
} Objective;

/* Along the border of half_planes[last]: the best velocity within the speed limit that meets
   half_planes[0..last). False if there is none. */
static bool along_border(const JoxHalfPlane *half_planes, uint32_t last, float speed_limit,
                         const Objective *objective, JoxV2 *result) {
    JoxV2 normal = half_planes[last].normal, direction = {normal.y, -normal.x};
    float offset = half_planes[last].offset, half2 = speed_limit * speed_limit - offset * offset;
    if (half2 < 0.0f)
        return false;                       /* every allowed velocity lies outside */
    JoxV2 foot = jox_scale(normal, offset); /* nearest point of the border to the origin */
    float half = sqrtf(half2), low = -half, high = half;
    for (uint32_t i = 0; i < last; i++) {
        float across = jox_dot(half_planes[i].normal, direction);
        float missing = half_planes[i].offset - jox_dot(half_planes[i].normal, foot);
        if (across <= EPSILON && across >= -EPSILON) { /* parallel */
            if (missing > EPSILON)
                return false;
            continue;
        }
        float t = missing / across;
        if (across > 0.0f)
            low = jox_maxf(low, t);
        else
            high = jox_minf(high, t);
        if (low > high)
            return false;
    }
    JoxV2 wanted = objective->wanted;
    /* Ties are broken somewhat to the right: two who meet head-on would else stand for ever. */
    if (objective->directed)
        wanted = jox_sub(wanted, jox_scale(jox_left(wanted), JOX_RIGHT_SHARE));
    float t = jox_clampf(jox_dot(direction, jox_sub(wanted, foot)), low, high);
    float gain = objective->directed ? jox_dot(objective->direction, direction) : 0.0f;
    if (gain > EPSILON || gain < -EPSILON)
        t = gain > 0.0f ? high : low;
    *result = jox_add(foot, jox_scale(direction, t));
    return true;
}

/* Returns `count` if all half-planes could be met, else the first that could not; *result then
   meets those before it. */
static uint32_t incremental(const JoxHalfPlane *half_planes, uint32_t count, float speed_limit,
                            const Objective *objective, JoxV2 *result) {
    float length2 = jox_length2(objective->wanted);
    if (objective->directed)
        *result = jox_scale(objective->direction, speed_limit);
    else if (length2 > speed_limit * speed_limit)
        *result = jox_scale(objective->wanted, speed_limit / sqrtf(length2));
    else
        *result = objective->wanted;
    for (uint32_t i = 0; i < count; i++)
        if (jox_dot(half_planes[i].normal, *result) < half_planes[i].offset) {
            JoxV2 before = *result;
            if (!along_border(half_planes, i, speed_limit, objective, result)) {
                *result = before;
                return i;
            }
        }
    return count;
}

/* Minimises the greatest violation of half_planes[hard..count) while the hard ones hold, starting
   from the first that failed. */
static void least_violation(const JoxHalfPlane *half_planes, uint32_t count, uint32_t hard,
                            uint32_t begin, float speed_limit, JoxV2 wanted, JoxV2 *result) {
    JOX_ASSERT(hard <= begin && begin < count);
    JoxHalfPlane projected[MOST_HALF_PLANES];
    float violation = 0.0f;
    for (uint32_t i = 0; i < hard; i++)
        projected[i] = half_planes[i];
    for (uint32_t i = begin; i < count; i++) {
        JoxHalfPlane worst = half_planes[i];
        if (worst.offset - jox_dot(worst.normal, *result) <= violation)
            continue;
        /* Where half-plane i is violated at least as much as half-plane j: (n_j - n_i) . v >= c_j -
         * c_i. */
        uint32_t n = hard;
        for (uint32_t j = hard; j < i; j++) {
            JoxV2 difference = jox_sub(half_planes[j].normal, worst.normal);
            float length = jox_length(difference);
            if (length <= EPSILON)
                continue; /* the same direction: whichever is farther out decides by itself */
            projected[n++] = (JoxHalfPlane){jox_scale(difference, 1.0f / length),
                                            (half_planes[j].offset - worst.offset) / length};
            JOX_ASSERT(jox_is_unit(projected[n - 1].normal));
        }
        JoxV2 before = *result;
        Objective objective = {wanted, worst.normal, true};
        if (incremental(projected, n, speed_limit, &objective, result) < n)
            *result = before; /* only by rounding: the present result already lies there */
        violation = worst.offset - jox_dot(worst.normal, *result);
    }
}

bool jox_linear_program_solve(const JoxHalfPlane *half_planes, uint32_t count, uint32_t hard,
                              float speed_limit, JoxV2 wanted, JoxV2 *velocity, bool *relaxed) {
    JOX_ASSERT(hard <= count && count <= MOST_HALF_PLANES);
    JOX_ASSERT(!(speed_limit < 0.0f));
    *relaxed = false;
    Objective objective = {.wanted = wanted};
    uint32_t met = incremental(half_planes, count, speed_limit, &objective, velocity);
    if (met == count) {
        JOX_CHECK(jox_linear_program_check(half_planes, count, speed_limit, *velocity));
        return true;
    }
    if (met < hard) { /* the walls alone leave nothing: the deepest offset that can be met */
        *relaxed = true;
        least_violation(half_planes, hard, 0, met, speed_limit, wanted, velocity);
        return false;
    }
    least_violation(half_planes, count, hard, met, speed_limit, wanted, velocity);
    return false;
}
