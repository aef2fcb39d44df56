/* The velocity of one agent, in plain C: for inspected agents, and for agents that the kernel of
   solve leaves over because a hard half-plane has to be relaxed. Reach and rounding are those of
   rest_lanes.h at width 1; only this file relaxes walls. */
#define JOX_ISA_scalar
#include <math.h>

#include "nav/orca/rest_lanes.h"
#include "nav/orca/solve.h"

/* Relaxes wall planes for an agent that others carry towards a wall: it may come as near as they
   carry it, as the contact with the wall itself stops it. Then the forced velocity meets every hard
   half-plane. */
static void relax_walls(const JoxSolve *s, uint32_t i, JoxHalfPlane *walls, uint32_t count) {
    JoxV2 carried = {s->step.agents->forced_x[i], s->step.agents->forced_y[i]};
    for (uint32_t k = 0; k < count; k++)
        walls[k].offset = jox_minf(walls[k].offset, jox_dot(walls[k].normal, carried));
}

/* Returns whether half-plane k is imposed by walls, contacts or force; the others are of
   avoidance. */
static bool is_imposed(uint32_t k, const JoxHalfPlaneCounts *made) {
    uint32_t hard = made->walls + made->contacts;
    return k < hard || k >= hard + made->agents + made->objects;
}

/* Returns how far, m/s, walls alone take an agent from the velocity that it wants. */
static float find_wall_deviation(const JoxSolve *s, uint32_t i, const JoxHalfPlane *walls,
                                 uint32_t count, JoxV2 wanted) {
    JoxV2 nearest;
    bool relaxed;
    if (count == 0)
        return 0.0f;
    jox_linear_program_solve(walls, count, count, s->step.agents->speed_limit[i], wanted, false,
                             &nearest, &relaxed);
    return jox_length(jox_sub(nearest, wanted)) * 1.001f + 1e-4f; /* covers rounding */
}

/* Keeps the velocity within reach. Contacts and forces may leave only velocities far along a valley
   between two nearly opposite half-planes, where feet would throw people. So an agent's own motion
   takes it no farther from the wanted velocity than forces or walls do, avoidance aside. Lowers the
   imposed half-planes, except walls, which all allow standing still, to the best velocity within
   that distance. Returns false where all imposed half-planes can be met there. */
static bool keep_within_reach(const JoxSolve *s, uint32_t i, const JoxHalfPlaneCounts *made,
                              JoxHalfPlane *half_planes, const JoxPressed *pressed,
                              JoxV2 velocity) {
    const JoxV2 wanted = {pressed->wanted.x, pressed->wanted.y};
    uint32_t hard = made->walls + made->contacts, n = 0;
    uint32_t all = hard + made->agents + made->objects + made->force;
    if (!jox_out_of_reach_lanes(pressed, (JoxVector){velocity.x, velocity.y}))
        return false;
    const float off = find_wall_deviation(s, i, half_planes, made->walls, wanted);
    const float reach2 = jox_maxf(jox_reach2_lanes(pressed), off * off);
    JoxHalfPlane imposed[JOX_MOST_CONSTRAINTS] = {0};
    for (uint32_t k = 0; k < all; k++)
        if (is_imposed(k, made)) {
            imposed[n] = half_planes[k];
            imposed[n++].offset -= jox_dot(half_planes[k].normal, wanted);
        }
    JoxV2 change;
    bool relaxed;
    jox_linear_program_solve(imposed, n, hard, sqrtf(reach2), (JoxV2){0.0f, 0.0f}, pressed->stands,
                             &change, &relaxed);
    JoxV2 best = jox_add(wanted, change);
    bool lowered = false;
    for (uint32_t k = made->walls; k < all; k++) {
        float least = jox_dot(half_planes[k].normal, best);
        if (!is_imposed(k, made) || half_planes[k].offset <= least + 1e-5f)
            continue;
        half_planes[k].offset = least - 1e-5f;
        lowered = true;
    }
    return lowered;
}

static bool meets_walls(const JoxHalfPlane *walls, uint32_t count, JoxV2 velocity) {
    const float least = 1e-3f; /* m/s */
    for (uint32_t k = 0; k < count; k++)
        if (jox_dot(walls[k].normal, velocity) < walls[k].offset - least)
            return false;
    return true;
}

/* Returns the forces on agent i and the velocity that it wants, at width 1. */
static JoxPressed find_pressed(const JoxSolve *s, uint32_t i, const JoxHalfPlaneCounts *made,
                               JoxV2 wanted) {
    const JoxAgents *a = s->step.agents;
    const bool touching = made->contacts > 0;
    return (JoxPressed){{wanted.x, wanted.y},
                        {a->forced_x[i], a->forced_y[i]},
                        {a->half_plane_x[i], a->half_plane_y[i], a->half_plane_offset[i]},
                        touching,
                        !s->nav->literal && (touching || made->force),
                        !s->nav->literal && jox_stands(a, i)};
}

bool jox_solve_one(const JoxSolve *s, uint32_t i, const JoxHalfPlaneCounts *made,
                   JoxHalfPlane *half_planes, JoxV2 wanted) {
    JoxAgents *a = s->step.agents;
    const uint32_t hard = made->walls + made->contacts;
    const uint32_t count = hard + made->agents + made->objects + made->force;
    JoxV2 velocity;
    bool relaxed;
    const JoxPressed pressed = find_pressed(s, i, made, wanted);
    bool met = jox_linear_program_solve(half_planes, count, hard, a->speed_limit[i], wanted,
                                        pressed.stands, &velocity, &relaxed);
    if (relaxed && made->contacts) {
        relax_walls(s, i, half_planes, made->walls);
        jox_linear_program_solve(half_planes, count, hard, a->speed_limit[i], wanted,
                                 pressed.stands, &velocity, &relaxed);
        relaxed = relaxed && !meets_walls(half_planes, made->walls, velocity);
    }
    bool still; /* ignored: whether a wall gives way was settled above */
    if (keep_within_reach(s, i, made, half_planes, &pressed, velocity)) {
        a->plan_notes[i] |= JOX_NOTE_BOUNDED;
        jox_linear_program_solve(half_planes, count, hard, a->speed_limit[i], wanted,
                                 pressed.stands, &velocity, &still);
    }
    const JoxVector planned =
        jox_snap_to_forced_lanes(&pressed, (JoxVector){velocity.x, velocity.y});
    a->failed[i] |= !met;
    a->next_x[i] = planned.x;
    a->next_y[i] = planned.y;
    return relaxed;
}
