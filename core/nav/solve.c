/* The stage solve: every agent's half-planes, and the best velocity that they leave. */
#include <assert.h>
#include <math.h>

#include "base/assert.h"
#include "base/random.h"
#include "nav/internal.h"
#include "nav/walk.h"

enum {
    MOST_WALLS = 16,
    MOST_OBJECTS = 24,
    MOST_CONTACTS = JOX_MOST_TOUCHED + JOX_MOST_BODIES_TOUCHED,
    MOST = MOST_WALLS + MOST_CONTACTS + JOX_MOST_NEIGHBOURS + MOST_OBJECTS + 1
};

typedef struct Solve {
    JoxNav *nav;
    JoxAgents *agents;
    const JoxNeighbours *neighbours;
    const JoxObjects *objects;
    const JoxContactPlanes *touched; /* NULL: contacts were not looked for */
    float planning_time;             /* s */
    bool plans; /* else those who want to get on go on with what they planned */
} Solve;

/* Where two centres coincide they part in opposite directions that depend on their ids alone. */
static JoxV2 parting(uint32_t id, uint32_t other) {
    uint32_t low = id < other ? id : other, high = id < other ? other : id;
    uint64_t bits = jox_random_bits(0, low, high, JOX_DRAW_AIM, 0);
    JoxV2 d = {(float)(bits & 0xffff) - 32767.5f, (float)(bits >> 16 & 0xffff) - 32767.5f};
    return jox_unit(id < other ? d : jox_scale(d, -1.0f));
}

static uint32_t contact_half_planes(const Solve *s, uint32_t i, JoxHalfPlane *out) {
    const JoxContactPlanes *t = s->touched;
    uint32_t count = t ? t->people[i] + t->bodies[i] : 0;
    JOX_ASSERT(count <= MOST_CONTACTS);
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
static bool is_hidden(const Solve *s, uint32_t i, JoxV2 offset, float radii) {
    float near = radii + JOX_TOUCH_LEAST + JOX_TOUCH_MOST;
    if (!s->touched || !s->nav->grid.first || jox_length2(offset) > near * near)
        return false;
    JoxV2 at = {s->agents->x[i], s->agents->y[i]};
    return jox_wall_grid_separates(&s->nav->grid, at, jox_add(at, offset));
}

static uint32_t agent_half_planes(const Solve *s, uint32_t i, JoxHalfPlane *out) {
    const JoxAgents *a = s->agents;
    const float *radius = a->param[JOX_PARAM_radius];
    JoxV2 velocity = {a->vx[i], a->vy[i]};
    float tau = a->param[JOX_PARAM_horizon][i];
    float share = s->nav->literal ? 0.5f : a->param[JOX_PARAM_yield][i]; /* (3) prints u/2 */
    uint32_t made = 0;
    for (uint32_t k = 0; k < s->neighbours->count[i]; k++) {
        uint32_t j = s->neighbours->index[jox_neighbour_at(s->neighbours, i, k)];
        if ((a->tags[j] & a->ignore[i]) || (s->touched && is_touched(s->touched, i, j)))
            continue;
        JoxV2 p = jox_offset(a, i, j);
        if (is_hidden(s, i, p, radius[i] + radius[j]))
            continue;
        JoxV2 v = {velocity.x - a->vx[j], velocity.y - a->vy[j]};
        JoxV2 away = {1.0f, 0.0f};
        if (p.x == 0.0f && p.y == 0.0f)
            away = parting(a->id[i], a->id[j]);
        out[made++] = jox_orca_half_plane(p, v, radius[i] + radius[j], tau, s->planning_time,
                                          velocity, share, away);
    }
    return made;
}

/* The half-planes of one who walks by the law, in place of ORCA's: those it minds are not
   approached faster than uses up the gap within `close_time`, half of it where they cross. */
static uint32_t walker_half_planes(const Solve *s, uint32_t i, JoxHalfPlane *out) {
    const JoxAgents *a = s->agents;
    const JoxWalkLaw *law = &s->nav->walk;
    const float *radius = a->param[JOX_PARAM_radius];
    uint32_t made = 0;
    for (uint32_t k = 0; k < s->neighbours->count[i]; k++) {
        uint32_t j = s->neighbours->index[jox_neighbour_at(s->neighbours, i, k)];
        if ((a->tags[j] & a->ignore[i]) || (s->touched && is_touched(s->touched, i, j)))
            continue;
        JoxV2 p = jox_offset(a, i, j);
        JoxMinds minds = jox_minds(a, i, j, p);
        if (minds == JOX_MINDS_NOT)
            continue;
        float distance = jox_length(p);
        float gap = distance - jox_walk_width(law, a, i, j, minds);
        if (gap >= (float)law->close || is_hidden(s, i, p, radius[i] + radius[j]))
            continue;
        JoxV2 towards = distance > 0.0f ? jox_scale(p, 1.0f / distance)
                                        : jox_scale(parting(a->id[i], a->id[j]), -1.0f);
        float share = minds == JOX_MINDS_CROSSING ? 0.5f : 1.0f;
        float leaves = towards.x * a->vx[j] + towards.y * a->vy[j];
        float most = jox_maxf(0.0f, leaves) + share * jox_maxf(gap, 0.0f) / (float)law->close_time;
        out[made++] = (JoxHalfPlane){jox_scale(towards, -1.0f), -most};
    }
    return made;
}

static bool walks(const Solve *s, uint32_t i) {
    return !s->nav->literal && jox_walks(s->agents, i);
}

/* How many half-planes of each kind, in their order, which is that of JoxConstraintKind. */
typedef struct Counts {
    uint32_t walls, contacts, agents, objects, force;
} Counts;

static inline Counts make_half_planes(const Solve *s, uint32_t i, JoxHalfPlane *half_planes) {
    const JoxAgents *a = s->agents;
    float tau = a->param[JOX_PARAM_wall_horizon][i], radius = a->breadth[i];
    Counts made = {0};
    if (s->nav->grid.first)
        made.walls = jox_orca_walls(
            &s->nav->grid, (JoxV2){a->x[i], a->y[i]}, (JoxV2){a->vx[i], a->vy[i]}, radius, tau,
            tau * a->param[JOX_PARAM_max_speed][i] + radius, half_planes, MOST_WALLS);
    uint32_t n = made.walls;
    n += made.contacts = contact_half_planes(s, i, half_planes + n);
    n += made.agents = walks(s, i) ? walker_half_planes(s, i, half_planes + n)
                                   : agent_half_planes(s, i, half_planes + n);
    if (s->objects && s->objects->count)
        n += made.objects = jox_orca_objects(s->nav, a, i, s->objects, s->touched, s->planning_time,
                                             half_planes + n, MOST_OBJECTS);
    made.force = a->half_plane_x[i] != 0.0f || a->half_plane_y[i] != 0.0f;
    if (made.force)
        half_planes[n++] =
            (JoxHalfPlane){{a->half_plane_x[i], a->half_plane_y[i]}, a->half_plane_offset[i]};
    JOX_ASSERT(made.walls <= MOST_WALLS && made.agents <= JOX_MOST_NEIGHBOURS);
    JOX_CHECK(jox_half_planes_check(half_planes, n));
    return made;
}

static const JoxContactPlanes *in_force(const JoxContactPlanes *touched) {
    return touched && touched->agents ? touched : NULL;
}

uint32_t jox_nav_constraints(const JoxNav *nav, const JoxAgents *agents,
                             const JoxNeighbours *neighbours, const JoxObjects *objects,
                             const JoxContactPlanes *touched, double planning_time, uint32_t agent,
                             JoxConstraint out[JOX_MOST_CONSTRAINTS]) {
    static_assert((int)MOST == (int)JOX_MOST_CONSTRAINTS, "room for all");
    JOX_ASSERT(agent < agents->count);
    const Solve solve = {(JoxNav *)nav,     (JoxAgents *)agents,  neighbours, objects,
                         in_force(touched), (float)planning_time, true};
    JoxHalfPlane half_planes[MOST];
    Counts made = make_half_planes(&solve, agent, half_planes);
    const uint32_t hard = made.walls + made.contacts;
    const uint32_t ends[] = {made.walls, hard, hard + made.agents,
                             hard + made.agents + made.objects, UINT32_MAX};
    uint32_t count = ends[3] + made.force, kind = 0;
    for (uint32_t p = 0; p < count; p++) {
        while (p >= ends[kind])
            kind++;
        out[p] =
            (JoxConstraint){(JoxConstraintKind)kind, half_planes[p].normal, half_planes[p].offset};
    }
    return count;
}

/* Who is carried towards a wall by others may come as near as they do: the wall itself stops them
   in the contacts. With that the velocity that the forces give meets every hard half-plane. */
static void give_way_at_walls(const Solve *s, uint32_t i, JoxHalfPlane *walls, uint32_t count) {
    JoxV2 carried = {s->agents->forced_x[i], s->agents->forced_y[i]};
    for (uint32_t k = 0; k < count; k++)
        walls[k].offset = jox_minf(walls[k].offset, jox_dot(walls[k].normal, carried));
}

/* The half-planes that an agent's surroundings and forces impose, those of avoidance apart. */
static bool is_imposed(uint32_t k, const Counts *made) {
    uint32_t hard = made->walls + made->contacts;
    return k < hard || k >= hard + made->agents + made->objects;
}

/* What an agent is pressed by may leave only velocities far along a valley between half-planes that
   are nearly opposite: then feet would throw people. Nobody's feet, avoidance apart, take them
   farther from what they want than the forces do. Lowers what is imposed to the best that there is
   as near as that, walls apart, which all allow to stand still; false where all that is imposed can
   be met there. */
static bool keep_within_reach(const Solve *s, uint32_t i, const Counts *made,
                              JoxHalfPlane *half_planes, JoxV2 wanted, JoxV2 velocity) {
    JoxV2 forced = {s->agents->forced_x[i], s->agents->forced_y[i]};
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
    JoxHalfPlane imposed[MOST];
    for (uint32_t k = 0; k < all; k++)
        if (is_imposed(k, made)) {
            imposed[n] = half_planes[k];
            imposed[n++].offset -= jox_dot(half_planes[k].normal, wanted);
        }
    JoxV2 change;
    bool relaxed;
    jox_linear_program_solve(imposed, n, hard, sqrtf(reach2), (JoxV2){0.0f, 0.0f}, &change,
                             &relaxed);
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

/* Whether feet do nothing but for the program's rounding: contact alone then keeps momentum. */
static bool is_as_forced(const JoxAgents *a, uint32_t i, JoxV2 velocity) {
    const float rounding = 2e-5f; /* m/s */
    JoxV2 by_feet = {velocity.x - a->forced_x[i], velocity.y - a->forced_y[i]};
    return jox_length2(by_feet) < rounding * rounding;
}

static bool meets(const JoxHalfPlane *walls, uint32_t count, JoxV2 velocity) {
    const float least = 1e-3f; /* m/s */
    for (uint32_t k = 0; k < count; k++)
        if (jox_dot(walls[k].normal, velocity) < walls[k].offset - least)
            return false;
    return true;
}

/* Whether a half-plane keeps off what is wanted, straight against it. */
static bool is_head_on(const JoxHalfPlane *other, JoxV2 wanted) {
    const float tie = 0.02f; /* of the way ahead: as far aside is no tie */
    float against = -jox_dot(other->normal, wanted);
    return against > 0.0f && fabsf(jox_det(other->normal, wanted)) < tie * against;
}

/* What agent i wants. Who has come to a stand before others wants to go somewhat more to the right,
   or two who meet head-on would stand for ever; and so does who pushes somebody straight ahead, or
   would push them along for ever. `others`: half-planes of people, touched or not. */
static JoxV2 wish_of(const Solve *s, uint32_t i, const JoxHalfPlane *others, uint32_t count) {
    const float slow = 0.2f; /* of the wanted speed */
    JoxV2 wanted = {s->agents->pref_x[i], s->agents->pref_y[i]};
    JoxV2 velocity = {s->agents->vx[i], s->agents->vy[i]};
    if (walks(s, i))
        return (JoxV2){s->agents->walk_x[i], s->agents->walk_y[i]};
    if (jox_stands(s->agents, i))
        return wanted;
    bool gets_on = jox_dot(velocity, wanted) > slow * jox_length2(wanted);
    if (gets_on && !(s->agents->param[JOX_PARAM_push][i] > 0.0f))
        return wanted;
    for (uint32_t k = 0; k < count; k++)
        if (jox_dot(others[k].normal, wanted) < others[k].offset &&
            (!gets_on || is_head_on(&others[k], wanted)))
            return jox_sub(wanted, jox_scale(jox_left(wanted), JOX_RIGHT_SHARE));
    return wanted;
}

static void solve_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    Solve *s = context;
    JoxAgents *a = s->agents;
    uint32_t relaxations = 0;
    for (uint32_t i = begin; i < end; i++) {
        if (!s->plans && (walks(s, i) || !jox_stands_pressed(a, i)))
            continue;
        JoxHalfPlane half_planes[MOST];
        Counts made = make_half_planes(s, i, half_planes);
        uint32_t hard = made.walls + made.contacts;
        uint32_t count = hard + made.agents + made.objects + made.force;
        JoxV2 velocity;
        bool relaxed;
        const JoxV2 wanted = wish_of(s, i, half_planes + made.walls, made.contacts + made.agents);
        bool met = jox_linear_program_solve(half_planes, count, hard, a->speed_limit[i], wanted,
                                            &velocity, &relaxed);
        if (relaxed && made.contacts) {
            give_way_at_walls(s, i, half_planes, made.walls);
            jox_linear_program_solve(half_planes, count, hard, a->speed_limit[i], wanted, &velocity,
                                     &relaxed);
            relaxed = relaxed && !meets(half_planes, made.walls, velocity);
        }
        bool still; /* whether a wall gives is settled above: nothing asks more of one here */
        if ((made.contacts || made.force) &&
            keep_within_reach(s, i, &made, half_planes, wanted, velocity))
            jox_linear_program_solve(half_planes, count, hard, a->speed_limit[i], wanted, &velocity,
                                     &still);
        if (made.contacts && is_as_forced(a, i, velocity))
            velocity = jox_v2(a->forced_x[i], a->forced_y[i]);
        a->failed[i] |= !met;
        relaxations += relaxed;
        a->next_x[i] = velocity.x;
        a->next_y[i] = velocity.y;
    }
    s->nav->chunk_relaxed[begin / JOX_NAV_GRAIN] = relaxations;
}

/* The farthest that any agent may have to look for walls, m: as far as it plans ahead, and as far
   as it can get in a step, thrown or shifted. */
static float wall_reach(const JoxAgents *a, float planning_time) {
    float reach = 0.0f;
    for (uint32_t i = 0; i < a->count; i++) {
        float radius = a->param[JOX_PARAM_radius][i];
        float planned = a->param[JOX_PARAM_wall_horizon][i] * a->param[JOX_PARAM_max_speed][i];
        reach =
            jox_maxf(reach, radius + jox_maxf(planned, a->speed_limit[i] * planning_time + 0.5f));
    }
    return reach;
}

uint32_t jox_nav_solve(JoxNav *nav, JoxAgents *agents, const JoxNeighbours *neighbours,
                       const JoxObjects *objects, const JoxContactPlanes *touched,
                       double planning_time, bool plans, JoxPool *pool) {
    Solve solve = {nav,  agents, neighbours, objects, in_force(touched), (float)planning_time,
                   plans};
    if (nav->grid.walls)
        jox_wall_grid_fit(&nav->grid, wall_reach(agents, (float)planning_time));
    jox_parallel_for(pool, agents->count, JOX_NAV_GRAIN, solve_range, &solve);
    uint32_t relaxed = 0;
    for (uint32_t chunk = 0; chunk * JOX_NAV_GRAIN < agents->count; chunk++)
        relaxed += nav->chunk_relaxed[chunk];
    return relaxed;
}
