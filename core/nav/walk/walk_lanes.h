/* Parts of the walking law for all lanes of a packet: precedence among neighbours, tempers
   (eagerness and the present time gap), and the approach to the chosen velocity. Included by the
   kernels of walk, and by pair_lanes.h. */
#ifndef JOX_NAV_WALK_LANES_H
#define JOX_NAV_WALK_LANES_H

#include "agents/fold_lanes.h"
#include "agents/param_lanes.h"
#include "agents/stair_law.h"
#include "base/number/exponential.h"
#include "base/number/pi.h"
#include "base/number/random.h"
#include "geom/storeys.h"
#include "nav/walk/walk.h"
#include "simd/vectors.h"

/* Cosines and sines of the judged directions, left positive: 0, then +-15 to +-75 degrees. */
static const float jox_walk_cosine[JOX_WALK_DIRECTIONS] = {
    1.0f,        0.96592583f, 0.96592583f, 0.86602540f, 0.86602540f, 0.70710678f,
    0.70710678f, 0.5f,        0.5f,        0.25881905f, 0.25881905f};
static const float jox_walk_sine[JOX_WALK_DIRECTIONS] = {
    0.0f,         0.25881905f, -0.25881905f, 0.5f,        -0.5f,       0.70710678f,
    -0.70710678f, 0.86602540f, -0.86602540f, 0.96592583f, -0.96592583f};

#define JOX_SAME_WAY 0.5f /* cosine of 60 degrees: headings within it go the same way */
/* Sine of 3 degrees: ways that turn together by more converge wholly. */
#define JOX_CONVERGES 0.05f

/* Lanes that mind their neighbour as one ahead, to be followed, or as one crossing, to be passed;
   in neither set: not at all. */
typedef struct JoxMindsLanes {
    JoxMask ahead, crossing;
} JoxMindsLanes;

/* Finds how agents from `first` on mind one neighbour each, at `offset` (m). Of two bound for the
   same place, the one with less way left goes first, so that no two agents wait for each other; on
   a tie the older one. Otherwise the agent ahead goes first, if it heads within 60 degrees of the
   same direction. A neighbour that goes first is ahead; one that crosses, comes the other way or
   stands, is crossing. `heading`: the neighbours' JoxHeading, member by member. */
static inline JoxMindsLanes jox_minds_lanes(const JoxAgents *a, uint32_t first, JoxInts others,
                                            const JoxFloats heading[4], JoxVector offset) {
    const JoxFloats zero = jf_set(0.0f), way = jf_load(a->way_left + first);
    const JoxVector own = {jf_load(a->aim_x + first), jf_load(a->aim_y + first)};
    // cppcheck-suppress ctuArrayIndex
    const JoxVector aim = {heading[0], heading[1]};
    const JoxMask stands = jf_le(jf_abs(aim.x) + jf_abs(aim.y), zero);
    const JoxInts bound = ji_load(a->bound + first);
    const JoxMask alike = jm_and(ji_equal(bound, jf_bits(heading[3])), ji_less(ji_set(0), bound));
    JoxMask goes_first = jf_lt(heading[2], way);
    const JoxMask tie = jm_without(jm_without(alike, goes_first), jf_lt(way, heading[2]));
    if (jm_bits(tie)) { /* rare */
        const JoxInts sign = ji_set(INT32_MIN);
        const JoxMask older =
            ji_less(ji_add(ji_pick(a->id, others), sign), ji_add(ji_load(a->id + first), sign));
        goes_first = jm_or(goes_first, jm_and(tie, older));
    }
    const JoxMask along = jf_lt(jf_set(JOX_SAME_WAY), jv_dot(own, aim));
    const JoxMask before = jm_and(along, jf_lt(zero, jv_dot(offset, own)));
    const JoxMask ahead = jm_or(jm_and(alike, goes_first), jm_without(before, alike));
    const JoxMask other_bound = jm_without(jm_of_bits(~0u), alike);
    return (JoxMindsLanes){jm_without(ahead, stands),
                           jm_or(stands, jm_without(other_bound, along))};
}

/* Returns the lanes that ignore agents or mean to touch one: their neighbours need scalar tests. */
static inline uint32_t jox_scalar_test_lanes(const JoxAgents *a, uint32_t first) {
    uint32_t scalar_tested = 0;
    uint64_t ignoring = 0;
    for (uint32_t lane = 0; lane < JOX_WIDTH; lane++)
        ignoring |= a->ignore[first + lane];
    for (uint32_t lane = 0; ignoring && lane < JOX_WIDTH; lane++)
        scalar_tested |= (uint32_t)(a->ignore[first + lane] != 0) << lane;
    const JoxInts close = ji_or(ji_load(a->approached + first),
                                ji_or(ji_load(a->grasped + first), ji_load_bytes(a->held + first)));
    return scalar_tested | ~jm_bits(ji_equal(close, ji_set(0)));
}

/* ---- tempers ---- */

static inline JoxFloats jox_share_lanes(JoxFloats x) { /* clamped to 0 ... 1 */
    return jf_min(jf_max(x, jf_set(0.0f)), jf_set(1.0f));
}

/* Returns the density about agents by the nearest of their neighbours, 1/m2; 0 of those who have
   fewer. */
static inline JoxFloats jox_density_lanes(const JoxWalk *w, uint32_t first) {
    const JoxNeighbours *n = w->step.neighbours;
    uint32_t crowded = 0;
    for (uint32_t lane = 0; lane < JOX_WIDTH; lane++)
        crowded |= (uint32_t)(n->count[first + lane] > JOX_CROWD_RANK) << lane;
    const JoxFloats d2 = jf_load(n->crowding2 + first);
    const JoxFloats area = (float)JOX_PI * jf_max(d2, jf_set(1e-4f));
    return jf_select(jm_of_bits(crowded), (float)(JOX_CROWD_RANK + 1) / area, jf_set(0.0f));
}

/* Returns the share of the sum of radii at which the ways of agents and others who cross pass: in
   a crowd of this density (1/m2) with a shoulder turned to each other, that is, as near as depths
   of chests allow. Others are taken to be built like the agents. */
static inline JoxFloats jox_cross_width(const JoxWalk *w, uint32_t first, JoxFloats density) {
    const JoxAgents *a = w->step.agents;
    const JoxFloats one = jf_set(1.0f), turned = jox_share_lanes(density - (float)w->law->turned);
    const JoxFloats chest =
        jf_load(a->contact_radius + first) / jox_param_lanes(a, JOX_PARAM_radius, first);
    return (float)w->law->width_cross * (one + (chest - one) * turned);
}

/* Returns how many neighbours of `lanes` (bits) are rivals: bound for the same place, on ways that
   converge with the agents'. A neighbour beside the agent whose way turns towards the agent's line
   counts 1, less by the sine of its direction where it is ahead or behind. One whose way parts
   counts against, so that small differences of parallel ways cancel out; so do neighbours who are
   not bound for the same place: who makes way for others does not compete. */
static inline JoxFloats jox_count_rivals(const JoxWalk *w, uint32_t first, uint32_t lanes) {
    const JoxAgents *a = w->step.agents;
    const JoxNeighbours *n = w->step.neighbours;
    const JoxFloats zero = jf_set(0.0f), one = jf_set(1.0f), against = jf_set(-1.0f);
    const JoxVector own = {jf_load(a->aim_x + first), jf_load(a->aim_y + first)};
    const JoxVector at = jv_load(a->x, a->y, first);
    const JoxInts none = ji_set(0), bound = ji_load(a->bound + first);
    const JoxInts counts = ji_select(jm_of_bits(lanes), ji_load_bytes(n->count + first), none);
    JoxFloats rivals = zero;
    JoxMask there;
    for (uint32_t k = 0; jm_bits(there = ji_less(ji_set((int32_t)k), counts)); k++) {
        const JoxInts others =
            ji_select(there, ji_load(n->index + jox_neighbour_at(n, first, k)), none);
        JoxFloats motion[4], heading[4];
        jf_records(&n->motions[0].x, others, motion);
        jf_records(&w->nav->headings[0].aim_x, others, heading);
        JoxVector offset = {motion[0] - at.x, motion[1] - at.y};
        if (jox_folds(a))
            offset = jox_fold_lanes(a, offset);
        const JoxFloats far2 = jf_max(jv_dot(offset, offset), jf_set(1e-6f));
        const JoxFloats aside = jv_det(own, offset) / jf_sqrt(far2);
        const JoxFloats left = jv_det(own, (JoxVector){heading[0], heading[1]});
        const JoxFloats turn = jf_max(against, jf_min(one, left * (1.0f / JOX_CONVERGES)));
        const JoxMask alike = ji_equal(bound, jf_bits(heading[3]));
        const JoxFloats rival = jf_select(alike, zero - turn * aside, against);
        rivals += jf_select(there, rival, zero);
    }
    return rivals;
}

/* Returns how much agents compete in a crowd of this density (1/m2), 0 to 1, by their rivals; 0 of
   those who are bound for no place, and where it would not make them eager. */
static inline JoxFloats jox_rivalry(const JoxWalk *w, uint32_t first, uint32_t walkers,
                                    JoxFloats density) {
    const JoxWalkLaw *law = w->law;
    const JoxMask is_bound = ji_less(ji_set(0), ji_load(w->step.agents->bound + first));
    const JoxMask dense = jf_lt(jf_set((float)law->crowded_bound), density);
    const uint32_t lanes = walkers & jm_bits(jm_and(is_bound, dense));
    if (!lanes)
        return jf_set(0.0f);
    const JoxFloats rivals = jox_count_rivals(w, first, lanes) - (float)law->rivals;
    return jox_share_lanes(rivals * (1.0f / (float)law->rivals_more));
}

/* Returns the eagerness that a crowd of this density (1/m2) would give agents, 0 to 1, within the
   bounds of their haste, which rivals raise. Agents bound for a place grow eager sooner. */
static inline JoxFloats jox_eagerness_wanted(const JoxWalk *w, uint32_t first, JoxFloats density,
                                             JoxFloats rivalry) {
    const JoxFloats one = jf_set(1.0f), normal = jf_set((float)w->law->eager_normal);
    const JoxFloats haste = jox_param_lanes(w->step.agents, JOX_PARAM_haste, first);
    const JoxFloats twice = 2.0f * haste;
    const JoxFloats most = jf_set((float)w->law->eager_most);
    const JoxFloats keen = jox_share_lanes(twice - one); /* haste beyond normal */
    const JoxFloats least = normal * jox_share_lanes(twice) + (one - normal) * keen;
    const JoxFloats bound = most + (one - most) * jf_max(keen, rivalry);
    const JoxMask is_bound = ji_less(ji_set(0), ji_load(w->step.agents->bound + first));
    const JoxFloats from =
        jf_select(is_bound, jf_set((float)w->law->crowded_bound), jf_set((float)w->law->crowded));
    const JoxFloats crowd = jox_share_lanes(density - from);
    return jf_max(least, jf_min(bound, crowd));
}

/* Returns the eagerness of `walkers` (bits) at the end of the step: it approaches the wanted
   one. */
static inline JoxFloats jox_eagerness(const JoxWalk *w, uint32_t first, uint32_t walkers,
                                      JoxFloats density) {
    const JoxFloats now = jf_load(w->step.agents->eager + first);
    const JoxFloats rivalry = jox_rivalry(w, first, walkers, density);
    const JoxFloats wanted = jox_eagerness_wanted(w, first, density, rivalry);
    const JoxFloats rate = jf_select(jf_lt(now, wanted), jf_set(w->rise), jf_set(w->fall));
    return now + (wanted - now) * rate;
}

/* Maps random bits to -1 ... 1. */
static inline double jox_drawn(uint64_t bits) {
    return 2.0 * jox_random_share(bits) - 1.0;
}

/* Draws the time gaps of `lanes` (bits). */
static inline void jox_draw_gaps(const JoxWalk *w, uint32_t first, uint32_t lanes) {
    JoxGapDraws *draws = &w->nav->gap_draws[first / JOX_LANES];
    for (; lanes; lanes &= lanes - 1) {
        const uint32_t lane = (uint32_t)__builtin_ctz(lanes), at = first % JOX_LANES + lane;
        const uint64_t id = (uint64_t)w->step.agents->id[first + lane]
                            << 32; /* as jox_random_of draws */
        const uint64_t bits = jox_random_mix(w->stream ^ id);
        draws->from[at] = jox_drawn(jox_random_mix(bits ^ w->knots[0]));
        draws->to[at] = jox_drawn(jox_random_mix(bits ^ w->knots[1]));
        draws->own[at] = jox_drawn(jox_random_mix(jox_random_mix(w->stream ^ (id | 1)) ^ w->own));
        draws->id[at] = w->step.agents->id[first + lane];
    }
}

/* Lengthens the time gaps of `lanes` (bits) on stairs, by the slope in the direction of the aim. */
static inline void jox_lengthen_gaps(const JoxWalk *w, uint32_t first, uint32_t lanes, float *gap) {
    const JoxAgents *a = w->step.agents;
    for (; lanes; lanes &= lanes - 1) {
        const uint32_t lane = (uint32_t)__builtin_ctz(lanes), i = first + lane;
        const JoxFlight *flight = jox_flight_at(a->flights, (JoxV2){a->x[i], a->y[i]});
        if (!flight)
            continue;
        const float up = jox_dot(flight->along, (JoxV2){a->aim_x[i], a->aim_y[i]});
        gap[lane] *= jox_slope_gap(w->law, flight->slope * up);
    }
}

/* Returns the time gaps of `lanes` (bits), s: they differ between agents, wander in time, fall
   with eagerness, and grow on stairs. */
static inline JoxFloats jox_time_gaps(const JoxWalk *w, uint32_t first, uint32_t lanes,
                                      JoxFloats eagerness) {
    const JoxWalkLaw *law = w->law;
    const float *base = jox_params(w->step.agents, JOX_PARAM_time_gap, first);
    const JoxGapDraws *draws = &w->nav->gap_draws[first / JOX_LANES];
    const uint32_t at = first % JOX_LANES;
    const JoxMask known = ji_equal(ji_load(w->step.agents->id + first), ji_load(draws->id + at));
    if (lanes & ~jm_bits(known))
        jox_draw_gaps(w, first, lanes & ~jm_bits(known));
    float eager[JOX_WIDTH], gap[JOX_WIDTH];
    jf_store(eager, eagerness);
    for (uint32_t lane = 0; lane < JOX_WIDTH; lane++) {
        const double own = draws->own[at + lane];
        const double wander =
            draws->from[at + lane] * (1.0 - w->between) + draws->to[at + lane] * w->between;
        const double calm = (double)base[lane] * (1.0 - law->gap_eager * (double)eager[lane]);
        gap[lane] =
            (float)(calm * (1.0 + law->gap_spread * own) * jox_exp_within(law->gap_noise * wander));
    }
    if (w->step.agents->flights)
        jox_lengthen_gaps(w, first, lanes, gap);
    return jf_load(gap);
}

/* ---- velocities ---- */

/* Returns the velocity after a step of approach to speed `allowed` along e, m/s. Agents speed up
   slowly, and slow down and turn fast; turning by up to 60 degrees costs no speed. */
static inline JoxVector jox_approach(const JoxWalk *w, uint32_t first, JoxVector e,
                                     JoxFloats allowed) {
    const JoxAgents *a = w->step.agents;
    const JoxFloats one = jf_set(1.0f), zero = jf_set(0.0f);
    const JoxFloats stop = jf_set(w->stop), keeps = one - stop;
    const JoxFloats speed = jf_max(allowed, zero);
    const JoxVector v = {jf_load(a->vx + first), jf_load(a->vy + first)};
    const JoxFloats now = jf_sqrt(jv_dot(v, v)), along = jv_dot(v, e);
    const JoxVector aside = {v.x - e.x * along, v.y - e.y * along};
    JoxFloats kept = jf_max(zero, jf_min(now, along + along));
    const JoxFloats rate = jf_select(jf_lt(kept, speed), jf_set(w->start), stop);
    kept += (speed - kept) * rate;
    return (JoxVector){e.x * kept + aside.x * keeps, e.y * kept + aside.y * keeps};
}

/* Returns the course after a step of turning it to the direction e; a course opposite to e becomes
   e. */
static inline JoxVector jox_turn_course(const JoxWalk *w, uint32_t first, JoxVector e) {
    const JoxAgents *a = w->step.agents;
    const JoxFloats share = jf_set(w->course), zero = jf_set(0.0f);
    JoxVector course = {jf_load(a->course_x + first), jf_load(a->course_y + first)};
    course.x += (e.x - course.x) * share;
    course.y += (e.y - course.y) * share;
    const JoxFloats length2 = jv_dot(course, course), by = 1.0f / jf_sqrt(length2);
    const JoxMask turns = jf_lt(zero, length2);
    return (JoxVector){jf_select(turns, course.x * by, e.x), jf_select(turns, course.y * by, e.y)};
}

#endif
