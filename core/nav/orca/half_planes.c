/* The half-planes of one agent, in plain C: of walls, contacts, neighbours, bodies and force. The
   kernel of solve calls the makers of walls, contacts and bodies, and that of neighbours only where
   centres coincide; jox_nav_constraints and jox_nav_plan make all half-planes here. */
#define JOX_ISA_scalar
#include "base/assert.h"
#include "base/number/bits.h"
#include "base/number/random.h"
#include "nav/orca/pair_lanes.h"
#include "nav/orca/solve.h"

/* Returns the unit vector along which agent `id` leaves agent `other` where their centres coincide:
   opposite for the two, and a function of both ids alone. */
static JoxV2 find_parting(uint32_t id, uint32_t other) {
    uint32_t low = id < other ? id : other, high = id < other ? other : id;
    uint64_t bits = jox_random_bits(0, low, high, JOX_DRAW_AIM, 0);
    JoxV2 d = {(float)(bits & 0xffff) - 32767.5f, (float)(bits >> 16 & 0xffff) - 32767.5f};
    return jox_unit(id < other ? d : jox_scale(d, -1.0f));
}

uint32_t jox_solve_contacts(const JoxSolve *s, uint32_t i, JoxHalfPlane *out) {
    const JoxContactPlanes *t = s->step.touched;
    uint32_t count = t ? t->people[i] + t->bodies[i] : 0;
    JOX_ASSERT(count <= JOX_MOST_CONTACTS);
    for (uint32_t k = 0; k < count; k++) {
        const JoxContactPlane *plane = &t->planes[t->starts[i] + k];
        out[k] = (JoxHalfPlane){plane->normal, plane->offset};
    }
    return count;
}

/* Returns whether agent i touches agent j: the plane of their contact then replaces that of
   avoidance. */
static bool is_touched(const JoxContactPlanes *t, uint32_t i, uint32_t j) {
    for (uint32_t k = 0; k < t->people[i]; k++)
        if (t->planes[t->starts[i] + k].other == j)
            return true;
    return false;
}

/* Returns whether a wall stands between two agents that would else touch, or soon could: then
   neither avoids the other. */
static bool is_hidden_by_wall(const JoxSolve *s, uint32_t i, JoxV2 offset, float radii) {
    const float near = radii + JOX_TOUCH_LEAST + JOX_TOUCH_MOST, d2 = jox_length2(offset);
    if (!s->step.touched || d2 > near * near || (s->unhidden2 && d2 < s->unhidden2[i]))
        return false;
    return jox_nav_is_behind_wall(s->nav, (JoxV2){s->step.agents->x[i], s->step.agents->y[i]},
                                  offset);
}

bool jox_solve_passes_over(const JoxSolve *s, uint32_t i, uint32_t j) {
    const JoxAgents *a = s->step.agents;
    const JoxParameterColumn radius = a->param[JOX_PARAM_radius];
    return (a->tags[j] & a->ignore[i]) ||
           (s->step.touched &&
            (jox_approaches_or_holds(a, i, j) || is_touched(s->step.touched, i, j))) ||
           is_hidden_by_wall(s, i, jox_offset(a, i, j), jox_at(radius, i) + jox_at(radius, j));
}

/* Makes the half-plane of agent i for agent j by the walking law; `q` is j relative to i. Returns
   false where the law gives none. */
static bool find_walker_plane(const JoxSolve *s, uint32_t i, uint32_t j, const JoxSelf *self,
                              const JoxPair *q, JoxHalfPlane *out) {
    const JoxAgents *a = s->step.agents;
    const JoxVector velocity = {a->vx[j], a->vy[j]};
    const JoxFloats heading[4] = {a->aim_x[j], a->aim_y[j], a->way_left[j],
                                  jox_float_of((uint32_t)a->bound[j])};
    const JoxWalkerGap gap = jox_walker_gap(s->nav->walk, self, q);
    const JoxMindsLanes minds = jox_minds_lanes(a, i, (JoxInts)j, heading, (JoxVector){q->x, q->y});
    JoxVector towards = jv_scale((JoxVector){q->x, q->y}, 1.0f / gap.distance);
    JoxMask there;
    if (!(gap.distance > 0.0f)) {
        const JoxV2 away = find_parting(a->id[i], a->id[j]);
        towards = (JoxVector){-away.x, -away.y};
    }
    const JoxPlaneLanes plane =
        jox_walker_plane(s->nav->walk, &gap, &minds, towards, velocity, &there);
    *out = (JoxHalfPlane){{plane.x, plane.y}, plane.offset};
    return there;
}

/* Makes the half-plane of agent i for agent j by ORCA; `q` is j relative to i. */
static JoxHalfPlane find_orca_plane(const JoxSolve *s, uint32_t i, uint32_t j, const JoxSelf *self,
                                    const JoxPair *q) {
    const JoxAgents *a = s->step.agents;
    const bool coincide = q->x == 0.0f && q->y == 0.0f;
    const JoxV2 away = coincide ? find_parting(a->id[i], a->id[j]) : (JoxV2){1.0f, 0.0f};
    return jox_orca_half_plane(
        (JoxV2){q->x, q->y}, (JoxV2){q->vx, q->vy}, q->radii, jox_param(a, JOX_PARAM_horizon, i),
        (float)s->step.timing.planning_time, (JoxV2){a->vx[i], a->vy[i]}, self->orca.share, away);
}

uint32_t jox_solve_neighbours(const JoxSolve *s, uint32_t i, JoxHalfPlane *out) {
    const JoxAgents *a = s->step.agents;
    const JoxParameterColumn radius = a->param[JOX_PARAM_radius];
    const bool walks = jox_solve_walks(s, i);
    const JoxSelf self = jox_self_of(s, i, walks);
    uint32_t made = 0;
    for (uint32_t k = 0; k < s->step.neighbours->count[i]; k++) {
        uint32_t j = s->step.neighbours->index[jox_neighbour_at(s->step.neighbours, i, k)];
        if (jox_solve_passes_over(s, i, j))
            continue;
        const JoxV2 p = jox_offset(a, i, j);
        JoxPair q = {p.x, p.y, a->vx[i] - a->vx[j], a->vy[i] - a->vy[j],
                     jox_at(radius, i) + jox_at(radius, j)};
        if (jox_may_be_pressed(&s->step) && !walks)
            q.radii = jox_radii_of_torsos(&s->step, i, &j, &q);
        if (!walks)
            out[made++] = find_orca_plane(s, i, j, &self, &q);
        else
            made += find_walker_plane(s, i, j, &self, &q, &out[made]);
    }
    return made;
}

uint32_t jox_solve_walls(const JoxSolve *s, uint32_t i, JoxHalfPlane *out) {
    const JoxAgents *a = s->step.agents;
    const bool pressed = a->half_plane_x[i] != 0.0f || a->half_plane_y[i] != 0.0f;
    const JoxWallShape shape = {{a->axis_x[i], a->axis_y[i]},
                                a->contact_radius[i],
                                pressed ? 0.0f : jox_param(a, JOX_PARAM_radius, i)};
    const float tau = jox_param(a, JOX_PARAM_wall_horizon, i);
    const float reach = jox_maxf(shape.radius + jox_length(shape.axis), shape.keeps);
    const float range = tau * jox_param(a, JOX_PARAM_max_speed, i) + reach;
    if (!s->nav->grid.first || jox_wall_grid_is_clear(s->unhidden2, i, range))
        return 0;
    return jox_orca_walls(&s->nav->grid, (JoxV2){a->x[i], a->y[i]}, (JoxV2){a->vx[i], a->vy[i]},
                          &shape, tau, range, out, JOX_MOST_WALLS);
}

uint32_t jox_solve_objects(const JoxSolve *s, uint32_t i, JoxHalfPlane *out) {
    if (!s->step.objects || !s->step.objects->count)
        return 0;
    return jox_orca_objects(s, i, out, JOX_MOST_OBJECTS);
}

uint32_t jox_solve_force(const JoxSolve *s, uint32_t i, JoxHalfPlane *out) {
    const JoxAgents *a = s->step.agents;
    *out = (JoxHalfPlane){{a->half_plane_x[i], a->half_plane_y[i]}, a->half_plane_offset[i]};
    return out->normal.x != 0.0f || out->normal.y != 0.0f;
}

JoxHalfPlaneCounts jox_solve_half_planes(const JoxSolve *s, uint32_t i, JoxHalfPlane *out) {
    JoxHalfPlaneCounts made = {0};
    uint32_t n = made.walls = jox_solve_walls(s, i, out);
    n += made.contacts = jox_solve_contacts(s, i, out + n);
    n += made.agents = jox_solve_neighbours(s, i, out + n);
    n += made.objects = jox_solve_objects(s, i, out + n);
    n += made.force = jox_solve_force(s, i, out + n);
    JOX_ASSERT(made.walls <= JOX_MOST_WALLS && made.agents <= JOX_MOST_NEIGHBOURS);
    JOX_CHECK(jox_half_planes_check(out, n));
    return made;
}
