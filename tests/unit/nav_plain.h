/* The laws of navigation for one agent in plain C, as references for the kernels and for core at
   width 1: ORCA; the linear programs (de Berg et al., Computational Geometry, ch. 4; van den Berg
   et al. 2011 for three dimensions); precedence by the walking law; and the velocity of one agent.
   Written independently of core/nav. */
#ifndef TESTS_NAV_PLAIN_H
#define TESTS_NAV_PLAIN_H

#include <math.h>

#include "base/assert.h"
#include "base/number/random.h"
#include "nav/near/perceive.h"
#include "nav/orca/solve.h"
#include "nav/walk/walk.h"

/* ---- ORCA ---- */

/* Returns the half-plane with outward normal n whose border passes through own + share * u, where
   u, the least change of the relative velocity, is along n and `change` long, m/s. */
static inline JoxHalfPlane plain_plane_through(JoxV2 normal, JoxV2 own, float change, float share) {
    JOX_ASSERT(jox_is_unit(normal));
    return (JoxHalfPlane){normal, jox_dot(normal, own) + change * share};
}

/* Returns the half-plane for a disc of the velocity obstacle, with its centre at `centre` in
   velocity space. */
static inline JoxHalfPlane plain_disc_plane(JoxV2 v, JoxV2 centre, float radius, JoxV2 own,
                                            float share, JoxV2 away) {
    JoxV2 w = jox_sub(v, centre);
    float length = jox_length(w);
    JoxV2 normal = length > 1e-6f ? jox_scale(w, 1.0f / length) : away;
    return plain_plane_through(normal, own, radius - length, share);
}

static inline JoxHalfPlane plain_orca(JoxV2 p, JoxV2 v, float radius, float tau, float dt,
                                      JoxV2 own, float share, JoxV2 away) {
    JOX_ASSERT(tau > 0.0f && dt > 0.0f && radius >= 0.0f);
    float d2 = jox_length2(p), r2 = radius * radius;
    if (d2 <= r2) /* overlapping: they part within one step */
        return plain_disc_plane(v, jox_scale(p, 1.0f / dt), radius / dt, own, share, away);
    float inverse = 1.0f / tau;
    JoxV2 w = jox_sub(v, jox_scale(p, inverse));
    float along = jox_dot(w, p);
    if (along < 0.0f && along * along > r2 * jox_length2(w)) /* the cut-off disc is nearest */
        return plain_disc_plane(v, jox_scale(p, inverse), radius * inverse, own, share, away);
    /* Else one of the cone's legs: the left one if w points to the left of p. */
    float leg = sqrtf(d2 - r2), by = 1.0f / d2;
    bool left = jox_det(p, w) > 0.0f;
    JoxV2 direction = left ? (JoxV2){p.x * leg - p.y * radius, p.x * radius + p.y * leg}
                           : (JoxV2){-p.x * leg - p.y * radius, p.x * radius - p.y * leg};
    JoxV2 normal = jox_left(jox_scale(direction, by));
    return plain_plane_through(normal, own, -jox_dot(normal, v), share);
}

/* ---- the linear programs ---- */

static const float PROGRAM_EPSILON = 1e-5f;
enum { MOST_HALF_PLANES = 128 };

/* Objective of a program: the velocity nearest to `wanted`; or, where directed, the one farthest
   along `direction`, ties, which lead there by less than `least`, by the distance to `wanted`. */
typedef struct Objective {
    JoxV2 wanted, direction;
    float least;
    bool directed;
} Objective;

/* Finds the best velocity on the border of half_planes[last] within the speed limit that meets
   half_planes[0..last). False if there is none. */
static inline bool plain_best_on_border(const JoxHalfPlane *half_planes, uint32_t last,
                                        float speed_limit, const Objective *objective,
                                        JoxV2 *result) {
    JoxV2 normal = half_planes[last].normal, direction = {normal.y, -normal.x};
    float offset = half_planes[last].offset, half2 = speed_limit * speed_limit - offset * offset;
    if (half2 < 0.0f)
        return false;                       /* every allowed velocity lies outside */
    JoxV2 foot = jox_scale(normal, offset); /* nearest point of the border to the origin */
    float half = sqrtf(half2), low = -half, high = half;
    for (uint32_t i = 0; i < last; i++) {
        float across = jox_dot(half_planes[i].normal, direction);
        float missing = half_planes[i].offset - jox_dot(half_planes[i].normal, foot);
        if (across <= PROGRAM_EPSILON && across >= -PROGRAM_EPSILON) { /* parallel */
            if (missing > PROGRAM_EPSILON)
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
    /* Ties are broken slightly to the right: two agents that meet head-on would else stand
       forever. */
    if (objective->directed)
        wanted = jox_sub(wanted, jox_scale(jox_left(wanted), JOX_ASIDE_RIGHT_FIRST));
    float t = jox_clampf(jox_dot(direction, jox_sub(wanted, foot)), low, high);
    float gain = objective->directed ? jox_dot(objective->direction, direction) : 0.0f;
    if (fabsf(gain) > objective->least)
        t = gain > 0.0f ? high : low;
    *result = jox_add(foot, jox_scale(direction, t));
    return true;
}

/* Solves the program in two dimensions. Returns `count` if all half-planes are met, else the first
   one that cannot be; *result then meets those before it. */
static inline uint32_t plain_solve_2d(const JoxHalfPlane *half_planes, uint32_t count,
                                      float speed_limit, const Objective *objective,
                                      JoxV2 *result) {
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
            if (!plain_best_on_border(half_planes, i, speed_limit, objective, result)) {
                *result = before;
                return i;
            }
        }
    return count;
}

/* Minimises the greatest violation of half_planes[hard..count) while the hard ones hold, starting
   from the first that failed. */
static inline void plain_solve_3d(const JoxHalfPlane *half_planes, uint32_t count, uint32_t hard,
                                  uint32_t begin, float speed_limit, JoxV2 wanted, float least,
                                  JoxV2 *result) {
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
           c_i. */
        uint32_t n = hard;
        for (uint32_t j = hard; j < i; j++) {
            JoxV2 difference = jox_sub(half_planes[j].normal, worst.normal);
            float length = jox_length(difference);
            if (length <= PROGRAM_EPSILON)
                continue; /* equal directions: the one farther out decides by itself */
            projected[n++] = (JoxHalfPlane){jox_scale(difference, 1.0f / length),
                                            (half_planes[j].offset - worst.offset) / length};
            JOX_ASSERT(jox_is_unit(projected[n - 1].normal));
        }
        JoxV2 before = *result;
        Objective objective = {wanted, worst.normal, least, true};
        if (plain_solve_2d(projected, n, speed_limit, &objective, result) < n)
            *result = before; /* fails only by rounding: the present result already lies there */
        violation = worst.offset - jox_dot(worst.normal, *result);
    }
}

static inline bool plain_program(const JoxHalfPlane *half_planes, uint32_t count, uint32_t hard,
                                 float speed_limit, JoxV2 wanted, bool stands, JoxV2 *velocity,
                                 bool *relaxed) {
    JOX_ASSERT(hard <= count && count <= MOST_HALF_PLANES);
    JOX_ASSERT(!(speed_limit < 0.0f));
    *relaxed = false;
    Objective objective = {.wanted = wanted};
    uint32_t met = plain_solve_2d(half_planes, count, speed_limit, &objective, velocity);
    if (met == count) {
        JOX_CHECK(jox_linear_program_check(half_planes, count, speed_limit, *velocity));
        return true;
    }
    if (met < hard) { /* the walls alone contradict each other: find the least violation */
        *relaxed = true;
        plain_solve_3d(half_planes, hard, 0, met, speed_limit, wanted, PROGRAM_EPSILON, velocity);
        return false;
    }
    plain_solve_3d(half_planes, count, hard, met, speed_limit, wanted,
                   stands ? 0.1f : PROGRAM_EPSILON, velocity);
    return false;
}

/* ---- precedence ---- */

typedef enum Minds {
    MINDS_NOT,
    MINDS_AHEAD,   /* goes the same way, and first: is followed */
    MINDS_CROSSING /* crosses, comes the other way or stands: is passed */
} Minds;

/* Returns how agent i minds j, at `offset` from it. Of two bound for the same place, the one with
   less way left goes first, so that no two agents wait for each other; ties go to the older.
   Otherwise the one ahead goes first, if it heads within 60 degrees of the same direction. */
static inline Minds plain_minds(const JoxAgents *a, uint32_t i, uint32_t j, JoxV2 offset) {
    JoxV2 own = {a->aim_x[i], a->aim_y[i]}, other = {a->aim_x[j], a->aim_y[j]};
    if (other.x == 0.0f && other.y == 0.0f)
        return MINDS_CROSSING;
    if (a->bound[i] && a->bound[i] == a->bound[j]) {
        bool first = a->way_left[j] != a->way_left[i] ? a->way_left[j] < a->way_left[i]
                                                      : a->id[j] < a->id[i];
        return first ? MINDS_AHEAD : MINDS_NOT;
    }
    if (jox_dot(own, other) > 0.5f)
        return jox_dot(offset, own) > 0.0f ? MINDS_AHEAD : MINDS_NOT;
    return MINDS_CROSSING;
}

/* Returns the distance of the centres, m, within which the ways of i and j are one, by how i minds
   j. */
static inline float plain_walk_width(const JoxWalkLaw *law, const JoxAgents *a, uint32_t i,
                                     uint32_t j, Minds minds) {
    const JoxParameterColumn radius = a->param[JOX_PARAM_radius];
    float radii = jox_at(radius, i) + jox_at(radius, j);
    if (minds == MINDS_CROSSING)
        return radii * ((float)law->width_cross * a->contact_radius[i] / jox_at(radius, i));
    return radii * (float)law->width * (1.0f - (float)law->room_eager * a->eager[i]);
}

/* ---- half-planes of neighbours ---- */

/* Returns the direction in which agent `id` leaves `other` where their centres coincide: opposite
   for the two, by their ids alone. */
static inline JoxV2 plain_parting(uint32_t id, uint32_t other) {
    uint32_t low = id < other ? id : other, high = id < other ? other : id;
    uint64_t bits = jox_random_bits(0, low, high, JOX_DRAW_AIM, 0);
    JoxV2 d = {(float)(bits & 0xffff) - 32767.5f, (float)(bits >> 16 & 0xffff) - 32767.5f};
    return jox_unit(id < other ? d : jox_scale(d, -1.0f));
}

/* Returns ORCA's half-plane of agent i for j, which is at p from it. */
static inline JoxHalfPlane plain_orca_plane(const JoxSolve *s, uint32_t i, uint32_t j, JoxV2 p,
                                            float radii) {
    const JoxAgents *a = s->step.agents;
    float share = s->nav->literal ? 0.5f : jox_param(a, JOX_PARAM_yield, i); /* (3) prints u/2 */
    JoxV2 velocity = {a->vx[i], a->vy[i]}, away = {1.0f, 0.0f};
    if (p.x == 0.0f && p.y == 0.0f)
        away = plain_parting(a->id[i], a->id[j]);
    return plain_orca(p, jox_v2(velocity.x - a->vx[j], velocity.y - a->vy[j]), radii,
                      jox_param(a, JOX_PARAM_horizon, i), (float)s->step.timing.planning_time,
                      velocity, share, away);
}

/* Makes the half-plane of a walker, instead of ORCA's: it approaches agents that it minds no faster
   than uses up the gap within `close_time`, or half of the gap where they cross. False: none for
   j. */
static inline bool plain_walker_plane(const JoxSolve *s, uint32_t i, uint32_t j, JoxV2 p,
                                      JoxHalfPlane *out) {
    const JoxAgents *a = s->step.agents;
    const JoxWalkLaw *law = s->nav->walk;
    Minds minds = plain_minds(a, i, j, p);
    if (minds == MINDS_NOT)
        return false;
    float distance = jox_length(p);
    float gap = distance - plain_walk_width(law, a, i, j, minds);
    if (gap >= (float)law->close)
        return false;
    JoxV2 towards = distance > 0.0f ? jox_scale(p, 1.0f / distance)
                                    : jox_scale(plain_parting(a->id[i], a->id[j]), -1.0f);
    float share = minds == MINDS_CROSSING ? 0.5f : 1.0f;
    float leaves = towards.x * a->vx[j] + towards.y * a->vy[j];
    float most = jox_maxf(0.0f, leaves) + share * jox_maxf(gap, 0.0f) / (float)law->close_time;
    *out = (JoxHalfPlane){jox_scale(towards, -1.0f), -most};
    return true;
}

static inline uint32_t plain_neighbours(const JoxSolve *s, uint32_t i, JoxHalfPlane *out) {
    const JoxAgents *a = s->step.agents;
    const JoxParameterColumn radius = a->param[JOX_PARAM_radius];
    const bool walker = jox_solve_walks(s, i);
    uint32_t made = 0;
    for (uint32_t k = 0; k < s->step.neighbours->count[i]; k++) {
        uint32_t j = s->step.neighbours->index[jox_neighbour_at(s->step.neighbours, i, k)];
        if (jox_solve_passes_over(s, i, j))
            continue;
        JoxV2 p = jox_offset(a, i, j);
        if (!walker)
            out[made++] = plain_orca_plane(s, i, j, p, jox_at(radius, i) + jox_at(radius, j));
        else if (plain_walker_plane(s, i, j, p, &out[made]))
            made++;
    }
    return made;
}

/* ---- one agent ---- */

/* Relaxes wall planes for an agent that others carry towards a wall, which the contact with the
   wall itself stops. Then the forced velocity meets every hard half-plane. */
static inline void plain_relax_walls(const JoxSolve *s, uint32_t i, JoxHalfPlane *walls,
                                     uint32_t count) {
    JoxV2 carried = {s->step.agents->forced_x[i], s->step.agents->forced_y[i]};
    for (uint32_t k = 0; k < count; k++)
        walls[k].offset = jox_minf(walls[k].offset, jox_dot(walls[k].normal, carried));
}

/* Returns whether half-plane k is imposed by walls, contacts or force; the others are of
   avoidance. */
static inline bool plain_is_imposed(uint32_t k, const JoxHalfPlaneCounts *made) {
    uint32_t hard = made->walls + made->contacts;
    return k < hard || k >= hard + made->agents + made->objects;
}

/* Returns whether the program of an agent is that of one that wants to stand. */
static inline bool plain_stands(const JoxSolve *s, uint32_t i) {
    return !s->nav->literal && jox_stands(s->step.agents, i);
}

/* Returns how far, m/s, walls alone take an agent from the velocity that it wants. */
static inline float plain_wall_deviation(const JoxSolve *s, uint32_t i, const JoxHalfPlane *walls,
                                         uint32_t count, JoxV2 wanted) {
    JoxV2 nearest;
    bool relaxed;
    if (count == 0)
        return 0.0f;
    plain_program(walls, count, count, s->step.agents->speed_limit[i], wanted, false, &nearest,
                  &relaxed);
    return jox_length(jox_sub(nearest, wanted)) * 1.001f + 1e-4f; /* covers rounding */
}

/* Keeps the velocity within reach: an agent's own motion takes it no farther from the wanted
   velocity than forces or walls do, avoidance aside. Contacts and forces may leave only velocities
   far along a valley between two nearly opposite half-planes, where feet would throw people. Lowers
   the imposed half-planes, except walls, to the best velocity within that distance; returns false
   where all of them can be met there. */
static inline bool plain_keep_within_reach(const JoxSolve *s, uint32_t i,
                                           const JoxHalfPlaneCounts *made,
                                           JoxHalfPlane *half_planes, JoxV2 wanted,
                                           JoxV2 velocity) {
    JoxV2 forced = {s->step.agents->forced_x[i], s->step.agents->forced_y[i]};
    uint32_t hard = made->walls + made->contacts, n = 0;
    uint32_t all = hard + made->agents + made->objects + made->force;
    float reach2 = jox_length2(jox_sub(forced, wanted));
    if (made->force) {
        const JoxHalfPlane *force = &half_planes[all - 1];
        float missing = jox_maxf(0.0f, force->offset - jox_dot(force->normal, wanted));
        reach2 = jox_maxf(reach2, missing * missing);
    }
    if (jox_length2(jox_sub(velocity, wanted)) <= reach2)
        return false;
    const float off = plain_wall_deviation(s, i, half_planes, made->walls, wanted);
    reach2 = jox_maxf(reach2, off * off);
    JoxHalfPlane imposed[JOX_MOST_CONSTRAINTS] = {0};
    for (uint32_t k = 0; k < all; k++)
        if (plain_is_imposed(k, made)) {
            imposed[n] = half_planes[k];
            imposed[n++].offset -= jox_dot(half_planes[k].normal, wanted);
        }
    JoxV2 change;
    bool relaxed;
    plain_program(imposed, n, hard, sqrtf(reach2), (JoxV2){0.0f, 0.0f}, plain_stands(s, i), &change,
                  &relaxed);
    JoxV2 best = jox_add(wanted, change);
    bool lowered = false;
    for (uint32_t k = made->walls; k < all; k++) {
        float least = jox_dot(half_planes[k].normal, best);
        if (!plain_is_imposed(k, made) || half_planes[k].offset <= least + 1e-5f)
            continue;
        half_planes[k].offset = least - 1e-5f;
        lowered = true;
    }
    return lowered;
}

/* Returns whether the planned velocity is the forced one but for rounding: contact alone then keeps
   momentum. */
static inline bool plain_is_as_forced(const JoxAgents *a, uint32_t i, JoxV2 velocity) {
    const float rounding = 2e-5f; /* m/s */
    JoxV2 by_feet = {velocity.x - a->forced_x[i], velocity.y - a->forced_y[i]};
    return jox_length2(by_feet) < rounding * rounding;
}

static inline bool plain_meets(const JoxHalfPlane *walls, uint32_t count, JoxV2 velocity) {
    const float least = 1e-3f; /* m/s */
    for (uint32_t k = 0; k < count; k++)
        if (jox_dot(walls[k].normal, velocity) < walls[k].offset - least)
            return false;
    return true;
}

static inline bool plain_solve_one(const JoxSolve *s, uint32_t i, const JoxHalfPlaneCounts *made,
                                   JoxHalfPlane *half_planes, JoxV2 wanted) {
    JoxAgents *a = s->step.agents;
    const uint32_t hard = made->walls + made->contacts;
    const uint32_t count = hard + made->agents + made->objects + made->force;
    JoxV2 velocity;
    bool relaxed;
    bool met = plain_program(half_planes, count, hard, a->speed_limit[i], wanted,
                             plain_stands(s, i), &velocity, &relaxed);
    if (relaxed && made->contacts) {
        plain_relax_walls(s, i, half_planes, made->walls);
        plain_program(half_planes, count, hard, a->speed_limit[i], wanted, plain_stands(s, i),
                      &velocity, &relaxed);
        relaxed = relaxed && !plain_meets(half_planes, made->walls, velocity);
    }
    bool still; /* ignored: whether a wall gives way was settled above */
    if (!s->nav->literal && (made->contacts || made->force) &&
        plain_keep_within_reach(s, i, made, half_planes, wanted, velocity)) {
        a->plan_notes[i] |= JOX_NOTE_BOUNDED;
        plain_program(half_planes, count, hard, a->speed_limit[i], wanted, plain_stands(s, i),
                      &velocity, &still);
    }
    if (made->contacts && plain_is_as_forced(a, i, velocity))
        velocity = jox_v2(a->forced_x[i], a->forced_y[i]);
    a->failed[i] |= !met;
    a->next_x[i] = velocity.x;
    a->next_y[i] = velocity.y;
    return relaxed;
}

#endif
