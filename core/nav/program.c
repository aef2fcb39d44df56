/* The two-dimensional linear program over half-planes and a disc (de Berg et al., Computational
   Geometry, ch. 4; van den Berg et al. 2011 for the fallback in three dimensions). */
#include "nav/internal.h"

static const float EPSILON = 1e-5f;
static const float SIDE = 0.25f; /* of the wanted speed: how far a tie is broken to the right */
enum { MOST_PLANES = 128 };

/* What a program looks for: the point nearest to `wanted`, or, with a direction, the farthest along
   it, and of those that are as far the nearest to `wanted`. */
typedef struct Aim {
    JoxV2 wanted, direction;
    bool directed;
} Aim;

/* Along the border of planes[last]: the best point that meets planes[0..last) and the disc. */
static bool along_border(const JoxPlane *planes, uint32_t last, float disc, const Aim *aim,
                         JoxV2 *result) {
    JoxV2 normal = planes[last].normal, direction = {normal.y, -normal.x};
    float offset = planes[last].offset, half2 = disc * disc - offset * offset;
    if (half2 < 0.0f)
        return false;                       /* the disc lies wholly outside */
    JoxV2 foot = jox_scale(normal, offset); /* nearest point of the border to the origin */
    float half = sqrtf(half2), low = -half, high = half;
    for (uint32_t i = 0; i < last; i++) {
        float across = jox_dot(planes[i].normal, direction);
        float missing = planes[i].offset - jox_dot(planes[i].normal, foot);
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
    JoxV2 wanted = aim->wanted;
    if (aim->directed) /* somewhat to the right: who meets head-on would else stand for ever */
        wanted = jox_sub(wanted, jox_scale(jox_left(wanted), SIDE));
    float t = jox_clampf(jox_dot(direction, jox_sub(wanted, foot)), low, high);
    float gain = aim->directed ? jox_dot(aim->direction, direction) : 0.0f;
    if (gain > EPSILON || gain < -EPSILON)
        t = gain > 0.0f ? high : low;
    *result = jox_add(foot, jox_scale(direction, t));
    return true;
}

/* Returns `count` if all planes could be met, else the first that could not; *result then meets
   those before it. */
static uint32_t incremental(const JoxPlane *planes, uint32_t count, float disc, const Aim *aim,
                            JoxV2 *result) {
    float length2 = jox_length2(aim->wanted);
    if (aim->directed)
        *result = jox_scale(aim->direction, disc);
    else if (length2 > disc * disc)
        *result = jox_scale(aim->wanted, disc / sqrtf(length2));
    else
        *result = aim->wanted;
    for (uint32_t i = 0; i < count; i++)
        if (jox_dot(planes[i].normal, *result) < planes[i].offset) {
            JoxV2 before = *result;
            if (!along_border(planes, i, disc, aim, result)) {
                *result = before;
                return i;
            }
        }
    return count;
}

/* Minimises the greatest violation of planes[hard..count) while the hard ones hold, starting from
   the first that failed. */
static void least_violation(const JoxPlane *planes, uint32_t count, uint32_t hard, uint32_t begin,
                            float disc, JoxV2 wanted, JoxV2 *result) {
    JoxPlane projected[MOST_PLANES];
    float violation = 0.0f;
    for (uint32_t i = 0; i < hard; i++)
        projected[i] = planes[i];
    for (uint32_t i = begin; i < count; i++) {
        JoxPlane worst = planes[i];
        if (worst.offset - jox_dot(worst.normal, *result) <= violation)
            continue;
        /* Where plane i is violated at least as much as plane j: (n_j - n_i) . v >= c_j - c_i. */
        uint32_t n = hard;
        for (uint32_t j = hard; j < i; j++) {
            JoxV2 difference = jox_sub(planes[j].normal, worst.normal);
            float length = jox_length(difference);
            if (length <= EPSILON)
                continue; /* the same direction: whichever is farther out decides by itself */
            projected[n++] = (JoxPlane){jox_scale(difference, 1.0f / length),
                                        (planes[j].offset - worst.offset) / length};
        }
        JoxV2 before = *result;
        Aim aim = {wanted, worst.normal, true};
        if (incremental(projected, n, disc, &aim, result) < n)
            *result = before; /* only by rounding: the present result already lies there */
        violation = worst.offset - jox_dot(worst.normal, *result);
    }
}

bool jox_program_solve(const JoxPlane *planes, uint32_t count, uint32_t hard, float disc,
                       JoxV2 wanted, JoxV2 *velocity, bool *relaxed) {
    *relaxed = false;
    Aim aim = {.wanted = wanted};
    uint32_t met = incremental(planes, count, disc, &aim, velocity);
    if (met == count)
        return true;
    if (met < hard) { /* the walls alone leave nothing: the deepest offset that can be met */
        *relaxed = true;
        least_violation(planes, hard, 0, met, disc, wanted, velocity);
        return false;
    }
    least_violation(planes, count, hard, met, disc, wanted, velocity);
    return false;
}
