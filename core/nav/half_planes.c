/* Half-planes of one agent, in plain C: of walls, of what it touches, of force, and by the walking
   law; the kernel of solve makes those of its neighbours by ORCA. All of one agent's for who
   inspects it. */
#include "base/assert.h"
#include "base/number/random.h"
#include "nav/kernels.h"
#include "nav/walk.h"

/* Where two centres coincide they part in opposite directions that depend on their ids alone. */
static JoxV2 parting(uint32_t id, uint32_t other) {
    uint32_t low = id < other ? id : other, high = id < other ? other : id;
    uint64_t bits = jox_random_bits(0, low, high, JOX_DRAW_AIM, 0);
    JoxV2 d = {(float)(bits & 0xffff) - 32767.5f, (float)(bits >> 16 & 0xffff) - 32767.5f};
    return jox_unit(id < other ? d : jox_scale(d, -1.0f));
}

uint32_t jox_solve_contacts(const JoxSolve *s, uint32_t i, JoxHalfPlane *out) {
    const JoxContactPlanes *t = s->touched;
    uint32_t count = t ? t->people[i] + t->bodies[i] : 0;
    JOX_ASSERT(count <= JOX_MOST_CONTACTS);
    for (uint32_t k = 0; k < count; k++) {
        const JoxContactPlane *plane = &t->planes[t->starts[i] + k];
        out[k] = (JoxHalfPlane){plane->normal, plane->offset};
    }
    return count;
}

/* Whether agent i touches j: then the plane of the contact stands for it. */
static bool is_touched(const JoxContactPlanes *t, uint32_t i, uint32_t j) {
    for (uint32_t k = 0; k < t->people[i]; k++)
        if (t->planes[t->starts[i] + k].other == j)
            return true;
    return false;
}

/* Whether a wall stands between two who would else touch, or soon could: then neither minds the
   other. */
static bool is_hidden(const JoxSolve *s, uint32_t i, JoxV2 offset, float radii) {
    const float near = radii + JOX_TOUCH_LEAST + JOX_TOUCH_MOST, d2 = jox_length2(offset);
    if (!s->touched || d2 > near * near || (s->clear2 && d2 < s->clear2[i]))
        return false;
    return jox_nav_is_behind_wall(s->nav, (JoxV2){s->agents->x[i], s->agents->y[i]}, offset);
}

bool jox_solve_passes_over(const JoxSolve *s, uint32_t i, uint32_t j) {
    const JoxAgents *a = s->agents;
    const JoxParameterColumn radius = a->param[JOX_PARAM_radius];
    return (a->tags[j] & a->ignore[i]) ||
           (s->touched && (jox_is_close_to(a, i, j) || is_touched(s->touched, i, j))) ||
           is_hidden(s, i, jox_offset(a, i, j), jox_at(radius, i) + jox_at(radius, j));
}

/* ORCA's half-plane of agent i for j, who is at p from it. */
static JoxHalfPlane orca_half_plane(const JoxSolve *s, uint32_t i, uint32_t j, JoxV2 p,
                                    float radii) {
    const JoxAgents *a = s->agents;
    float share = s->nav->literal ? 0.5f : jox_param(a, JOX_PARAM_yield, i); /* (3) prints u/2 */
    JoxV2 velocity = {a->vx[i], a->vy[i]}, away = {1.0f, 0.0f};
    if (p.x == 0.0f && p.y == 0.0f)
        away = parting(a->id[i], a->id[j]);
    return jox_orca_half_plane(p, jox_v2(velocity.x - a->vx[j], velocity.y - a->vy[j]), radii,
                               jox_param(a, JOX_PARAM_horizon, i), s->planning_time, velocity,
                               share, away);
}

/* The half-plane of one who walks by the law, in place of ORCA's: those it minds are not approached
   faster than uses up the gap within `close_time`, half of it where they cross. False: the law has
   none for j. */
static bool walker_half_plane(const JoxSolve *s, uint32_t i, uint32_t j, JoxV2 p,
                              JoxHalfPlane *out) {
    const JoxAgents *a = s->agents;
    const JoxWalkLaw *law = s->nav->walk;
    JoxMinds minds = jox_minds(a, i, j, p);
    if (minds == JOX_MINDS_NOT)
        return false;
    float distance = jox_length(p);
    float gap = distance - jox_walk_width(law, a, i, j, minds);
    if (gap >= (float)law->close)
        return false;
    JoxV2 towards = distance > 0.0f ? jox_scale(p, 1.0f / distance)
                                    : jox_scale(parting(a->id[i], a->id[j]), -1.0f);
    float share = minds == JOX_MINDS_CROSSING ? 0.5f : 1.0f;
    float leaves = towards.x * a->vx[j] + towards.y * a->vy[j];
    float most = jox_maxf(0.0f, leaves) + share * jox_maxf(gap, 0.0f) / (float)law->close_time;
    *out = (JoxHalfPlane){jox_scale(towards, -1.0f), -most};
    return true;
}

uint32_t jox_solve_neighbours(const JoxSolve *s, uint32_t i, JoxHalfPlane *out) {
    const JoxAgents *a = s->agents;
    const JoxParameterColumn radius = a->param[JOX_PARAM_radius];
    const bool walker = jox_solve_walks(s, i);
    uint32_t made = 0;
    for (uint32_t k = 0; k < s->neighbours->count[i]; k++) {
        uint32_t j = s->neighbours->index[jox_neighbour_at(s->neighbours, i, k)];
        if (jox_solve_passes_over(s, i, j))
            continue;
        JoxV2 p = jox_offset(a, i, j);
        if (!walker)
            out[made++] = orca_half_plane(s, i, j, p, jox_at(radius, i) + jox_at(radius, j));
        else if (walker_half_plane(s, i, j, p, &out[made]))
            made++;
    }
    return made;
}

uint32_t jox_solve_walls(const JoxSolve *s, uint32_t i, JoxHalfPlane *out) {
    const JoxAgents *a = s->agents;
    const float tau = jox_param(a, JOX_PARAM_wall_horizon, i), radius = a->breadth[i];
    const float range = tau * jox_param(a, JOX_PARAM_max_speed, i) + radius;
    if (!s->nav->grid.first || jox_wall_grid_is_clear(s->clear2, i, range))
        return 0;
    return jox_orca_walls(&s->nav->grid, (JoxV2){a->x[i], a->y[i]}, (JoxV2){a->vx[i], a->vy[i]},
                          radius, tau, range, out, JOX_MOST_WALLS);
}

uint32_t jox_solve_objects(const JoxSolve *s, uint32_t i, JoxHalfPlane *out) {
    if (!s->objects || !s->objects->count)
        return 0;
    return jox_orca_objects(s->nav, s->agents, i, s->objects, s->touched, s->planning_time, out,
                            JOX_MOST_OBJECTS);
}

uint32_t jox_solve_force(const JoxSolve *s, uint32_t i, JoxHalfPlane *out) {
    const JoxAgents *a = s->agents;
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
