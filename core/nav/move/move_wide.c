/* The kernels of move; a lane is an agent. The first integrates velocities; the second writes the
   positions once overlaps are resolved, with agents near walls, and agents that leave over a
   periodic edge, one at a time. */
#include <math.h>

#include "geom/wall_grid_lanes.h"
#include "nav/move/move.h"
#include "nav/near/seam_lanes.h"
#include "nav/step_back_lanes.h"
#include "simd/vectors.h"

/* Turns the chests of a packet by their spin. */
static inline void turn_chests(const JoxMove *m, uint32_t i) {
    JoxAgents *a = m->step.agents;
    const JoxVector chest = jv_load(a->chest_x, a->chest_y, i);
    const JoxFloats half =
        (jf_load(a->spin + i) + jf_load(a->parted_spin + i)) * (0.5f * (float)m->step.timing.dt);
    const JoxFloats one = jf_set(1.0f), by = one / (one + half * half);
    const JoxFloats c = (one - half * half) * by, s = (half + half) * by;
    const JoxVector to = {c * chest.x - s * chest.y, s * chest.x + c * chest.y};
    const JoxFloats inverse = one / jf_sqrt(jv_dot(to, to));
    jv_store(a->chest_x, a->chest_y, i, jv_end_decay(jv_scale(to, inverse)));
}

void JOX_WIDE(jox_move_integrate)(const JoxMove *m, uint32_t begin, uint32_t end) {
    JoxAgents *a = m->step.agents;
    const JoxFloats on_the_way = jf_set((float)m->step.timing.on_the_way),
                    response = jf_set((float)m->step.timing.response);
    const JoxFloats dt = jf_set((float)m->step.timing.dt);
    const bool has_torsos = m->step.neighbours->has_torsos;
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        const JoxVector at = jv_load(a->x, a->y, i);
        const JoxVector forced = jv_load(a->forced_x, a->forced_y, i);
        const JoxVector rest = jv_sub(jv_load(a->next_x, a->next_y, i), forced);
        JoxVector mean = jv_add(forced, jv_scale(rest, on_the_way));
        JoxVector ends = jv_add(forced, jv_scale(rest, response));
        float x[JOX_WIDTH], y[JOX_WIDTH];
        jv_store(a->prev_x, a->prev_y, i, at);
        if (has_torsos) {
            const JoxVector borne = jv_load(a->borne_x, a->borne_y, i);
            mean = jv_add(jv_add(mean, borne), jv_load(a->parted_x, a->parted_y, i));
            ends = jv_add(ends, borne);
            turn_chests(m, i);
        }
        jv_store(a->vx, a->vy, i, jv_end_decay(ends));
        jv_store(x, y, 0, jv_add(at, jv_scale(mean, dt)));
        for (uint32_t lane = 0; lane < JOX_WIDTH && i + lane < end; lane++)
            m->position[0][i + lane] = (JoxV2){x[lane], y[lane]};
    }
}

/* Adds dt to the time that agents have stood still; starts it anew for agents that have moved. */
static inline void update_still_time(const JoxMove *m, uint32_t i, JoxVector at) {
    JoxAgents *a = m->step.agents;
    const JoxFloats zero = jf_set(0.0f), reach2 = jf_set(JOX_STILL_REACH * JOX_STILL_REACH);
    const JoxVector still = jv_load(a->still_x, a->still_y, i), away = jv_sub(at, still);
    const JoxMask moved = jf_lt(reach2, jv_dot(away, away));
    const JoxFloats time = jf_load(a->still + i) + (float)m->step.timing.dt;
    jf_store(a->still + i, jf_select(moved, zero, time));
    jv_store(a->still_x, a->still_y, i, jv_select(moved, at, still));
}

/* Returns the lanes outside of the period from `origin` on, m; none where there is no period
   (0). */
static inline JoxMask find_outside(JoxFloats x, float origin, float period) {
    const JoxFloats from = x - origin, zero = jf_set(0.0f);
    const JoxMask within = jm_and(jf_le(zero, from), jf_lt(from, jf_set(period)));
    return period > 0.0f ? jm_without(jm_of_bits(JOX_ALL_LANES), within) : jm_of_bits(0);
}

/* Moves agents of a packet that stand beyond a seam to its other sheet, together with the positions
   of the step's beginning. Returns the lanes that it moved. */
static uint32_t cross_seams(JoxAgents *a, uint32_t i, uint32_t lanes) {
    const JoxStoreys *s = a->storeys;
    const JoxVector at = jv_load(a->x, a->y, i);
    uint32_t first, last, crossed = 0;
    jox_find_seams(s, a->y + i, lanes, &first, &last);
    for (uint32_t k = first; k < last; k++) {
        const uint32_t beyond = lanes & ~crossed & jox_find_beyond_seam(s, &s->seams[k], at);
        for (uint32_t left = beyond; left; left &= left - 1) {
            const uint32_t j = i + (uint32_t)__builtin_ctz(left);
            a->y[j] += s->seams[k].shift;
            a->prev_y[j] += s->seams[k].shift;
            a->still_y[j] += s->seams[k].shift;
        }
        crossed |= beyond;
    }
    return crossed;
}

/* Returns the lanes that a wall may stop or is too near to: agents near a wall, and agents that go
   farther than distances to walls are known. */
static inline uint32_t find_near_walls(const JoxMove *m, uint32_t first, JoxVector from,
                                       JoxVector way) {
    const JoxWallGrid *grid = &m->nav->grid;
    if (!grid->first)
        return 0;
    const JoxFloats way2 = jv_dot(way, way), served = jf_set(m->served);
    const JoxFloats reach = jf_sqrt(way2) + jf_load(m->step.agents->contact_radius + first);
    const JoxMask far = jf_lt(served * served, way2);
    const JoxMask clear =
        jm_and(jf_le(reach, served), jox_wall_grid_clear_lanes(m->unhidden2, first, reach));
    if (jm_bits(clear) == JOX_ALL_LANES)
        return 0;
    const JoxMask near = jm_without(jox_wall_grid_near_lanes(grid, from.x, from.y), clear);
    return jm_bits(jm_or(far, near));
}

/* The displacements of agents in a step, by lane: the square of the longest, m2, and bounds along
   each axis, m. */
typedef struct Ways {
    JoxFloats longest2;
    JoxVector least, most;
} Ways;

static inline Ways make_empty_ways(void) {
    const JoxFloats far = jf_set(INFINITY), near = jf_set(-INFINITY);
    return (Ways){jf_set(0.0f), {far, far}, {near, near}};
}

static inline void extend_ways(Ways *w, JoxMask there, JoxVector way) {
    const JoxVector least = {jf_min(w->least.x, way.x), jf_min(w->least.y, way.y)};
    const JoxVector most = {jf_max(w->most.x, way.x), jf_max(w->most.y, way.y)};
    w->longest2 = jf_select(there, jf_max(w->longest2, jv_dot(way, way)), w->longest2);
    w->least = jv_select(there, least, w->least);
    w->most = jv_select(there, most, w->most);
}

/* Reduces the displacements of the first `lanes` lanes, those that had an agent, to one drift. */
static inline JoxDrift reduce_ways(const Ways *w, uint32_t lanes) {
    float longest2[JOX_WIDTH], low_x[JOX_WIDTH], low_y[JOX_WIDTH], high_x[JOX_WIDTH],
        high_y[JOX_WIDTH];
    jf_store(longest2, w->longest2);
    jv_store(low_x, low_y, 0, w->least);
    jv_store(high_x, high_y, 0, w->most);
    JoxDrift all = {0.0f, {INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (uint32_t lane = 0; lane < lanes; lane++) {
        const JoxDrift own = {
            longest2[lane], {low_x[lane], low_y[lane]}, {high_x[lane], high_y[lane]}};
        all = jox_drift_of_both(all, own);
    }
    all.farthest = sqrtf(all.farthest);
    return all;
}

JoxDrift JOX_WIDE(jox_move_settle)(const JoxMove *m, uint32_t begin, uint32_t end) {
    JoxAgents *a = m->step.agents;
    Ways ways = make_empty_ways();
    float farthest = 0.0f;
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        const JoxVector from = jv_load(a->prev_x, a->prev_y, i);
        const uint32_t there = jox_first_lanes(end - i);
        float x[JOX_WIDTH] = {0.0f}, y[JOX_WIDTH] = {0.0f};
        for (uint32_t lane = 0; there >> lane; lane++) {
            x[lane] = m->position[0][i + lane].x;
            y[lane] = m->position[0][i + lane].y;
        }
        const uint32_t walled = there & find_near_walls(m, i, from, jv_sub(jv_load(x, y, 0), from));
        for (uint32_t lane = 0; walled >> lane; lane++) {
            if (!(walled >> lane & 1))
                continue;
            const JoxV2 at =
                jox_nav_move_past_walls(m, (JoxV2){a->prev_x[i + lane], a->prev_y[i + lane]},
                                        (JoxV2){x[lane], y[lane]}, a->contact_radius[i + lane]);
            x[lane] = at.x;
            y[lane] = at.y;
        }
        const JoxVector at = jv_load(x, y, 0), way = jv_sub(at, from);
        jv_store(a->x, a->y, i, at);
        extend_ways(&ways, jm_of_bits(there), way);
        if (!m->nav->literal) {
            JoxFloats motion[4]; /* of before the step */
            jf_fours((const float *)&m->step.neighbours->motions[i], 4, motion);
            JoxVector own = way, before = {motion[2], motion[3]};
            const JoxNeighbours *n = m->step.neighbours;
            if (n->has_belts) { /* they displace nobody */
                const JoxVector belt = jv_load(n->belt_x, n->belt_y, i);
                own = jv_sub(own, jv_scale(belt, jf_set((float)m->step.timing.dt)));
                before = jv_sub(before, belt);
            }
            jox_note_displacement_lanes(a, i, own, before, (float)m->step.timing.dt);
        }
        const uint32_t out = there & jm_bits(jm_or(find_outside(at.x, a->origin.x, a->period.x),
                                                   find_outside(at.y, a->origin.y, a->period.y)));
        for (uint32_t lane = 0; out >> lane; lane++)
            if ((out >> lane & 1) && jox_agents_wrap(a, i + lane)) {
                if (isfinite(a->x[i + lane]) && isfinite(a->y[i + lane]))
                    jox_nav_list_stray(m->nav, i + lane);
                else
                    farthest = INFINITY; /* its new position is not known yet */
            }
        for (uint32_t left = a->storeys ? cross_seams(a, i, there) : 0; left; left &= left - 1)
            jox_nav_list_stray(m->nav, i + (uint32_t)__builtin_ctz(left));
        update_still_time(m, i, jv_load(a->x, a->y, i));
    }
    JoxDrift drift = reduce_ways(&ways, end - begin < JOX_WIDTH ? end - begin : JOX_WIDTH);
    drift.farthest = jox_maxf(drift.farthest, farthest);
    return drift;
}
