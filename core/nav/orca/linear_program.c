/* The linear program of one agent: program_lanes.h at width 1. */
#define JOX_ISA_scalar
#include "base/assert.h"
#include "nav/orca/program_lanes.h"
#include "nav/orca/solve.h"

bool jox_linear_program_solve(const JoxHalfPlane *half_planes, uint32_t count, uint32_t hard,
                              float speed_limit, JoxV2 wanted, bool stands, JoxV2 *velocity,
                              bool *relaxed) {
    const JoxVector wish = {wanted.x, wanted.y};
    JoxRow rows[JOX_MOST_CONSTRAINTS];
    JoxVector best;
    JoxInts failed_at;
    JOX_ASSERT(hard <= count && count <= JOX_MOST_CONSTRAINTS);
    JOX_ASSERT(!(speed_limit < 0.0f));
    for (uint32_t k = 0; k < count; k++) {
        const JoxHalfPlane *h = &half_planes[k];
        rows[k] = (JoxRow){{h->normal.x}, {h->normal.y}, {h->offset}};
    }
    const bool failed =
        jox_program_lanes(rows, count, true, speed_limit, wish, NULL, &best, &failed_at);
    *relaxed = failed && failed_at < (int32_t)hard;
    if (*relaxed) /* the hard half-planes alone contradict each other: minimise their greatest
                     violation */
        jox_least_violation_lanes(rows, hard, 0, true, failed_at, speed_limit, wish,
                                  JOX_TOWARDS_ROUNDING, &best);
    else if (failed)
        jox_least_violation_lanes(rows, count, hard, true, failed_at, speed_limit, wish,
                                  jox_least_towards(stands), &best);
    *velocity = (JoxV2){best.x, best.y};
    if (!failed)
        JOX_CHECK(jox_linear_program_check(half_planes, count, speed_limit, *velocity));
    return !failed;
}
