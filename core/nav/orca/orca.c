/* The half-plane of one pair by ORCA: pair_lanes.h at width 1. For bodies, agents whose centres
   coincide, and inspected agents. */
#define JOX_ISA_scalar
#include "base/assert.h"
#include "nav/orca/pair_lanes.h"
#include "nav/orca/solve.h"

JoxHalfPlane jox_orca_half_plane(JoxV2 p, JoxV2 v, float radius, float tau, float dt, JoxV2 own,
                                 float share, JoxV2 away) {
    JOX_ASSERT(tau > 0.0f && dt > 0.0f && radius >= 0.0f);
    const JoxPair pair = {p.x, p.y, v.x, v.y, radius};
    const JoxOrcaSelf self = {{own.x, own.y}, 1.0f / tau, share};
    uint32_t coincide = 0;
    const JoxOrcaHalf half = jox_orca_begin(&pair, &self, dt, 1, &coincide);
    const JoxPlaneLanes plane = jox_orca_end(&pair, &self, &half);
    JoxHalfPlane out = {{plane.x, plane.y}, plane.offset};
    if (half.disc && !(half.length > JOX_ORCA_LEAST_W))
        out = (JoxHalfPlane){away, jox_dot(away, own) + (half.round - half.length) * share};
    JOX_ASSERT(jox_is_unit(out.normal));
    return out;
}
