#include "world/falls.h"

#include <math.h>
#include <string.h>

#include "agents/torso.h"
#include "base/assert.h"
#include "base/mem.h"

/* 1/s: sqrt(g/l) of an inverted pendulum whose mass is l = 1 m above the ground. A body that moves
   at v comes to rest above feet that are v / RATE ahead of it (Hof, Gazendam, Sinke 2005). */
static const float RATE = 3.13f;
static const float FEET = 0.14f;   /* m: how far ahead of it feet hold that cannot step: the toes */
static const float SUPPORT = 0.3f; /* m: who stands within this gap ahead holds an agent up */
static const float AHEAD = 0.7f;   /* cosine of the angle within which agents are ahead */
static const float PRESSED = 50.0f; /* N: who is pressed harder does not get up */

bool jox_falls_lies_any(const JoxAgents *a) {
    return !jox_mem_is(a->fallen, 0, a->count * sizeof *a->fallen);
}

bool jox_falls_matter(const JoxAgents *a, bool literal) {
    return !literal && a->count &&
           (jox_param_greatest(a, JOX_PARAM_balance) > 0.0f || jox_falls_lies_any(a) ||
            !jox_mem_is(a->lean_x, 0, a->count * sizeof *a->lean_x));
}

void jox_falls_hold(JoxAgents *a) {
    for (uint32_t i = 0; i < a->count; i++)
        if (a->fallen[i] > 0.0f)
            a->pref_x[i] = a->pref_y[i] = 0.0f;
}

void jox_falls_plan(JoxAgents *a) {
    for (uint32_t i = 0; i < a->count; i++)
        if (a->fallen[i] > 0.0f)
            a->next_x[i] = a->next_y[i] = 0.0f;
}

static void reserve_agents(JoxFalls *f, uint32_t count) {
    if (count <= f->capacity)
        return;
    jox_falls_free(f);
    f->capacity = count + count / 2;
    f->onto = jox_alloc(f->capacity, sizeof *f->onto);
    f->now = jox_alloc(f->capacity, sizeof *f->now);
}

/* Sums, from the contacts of the step, how those who stand press on those who lie. */
static void sum_contacts(JoxFalls *f, const JoxStep *step, const JoxForces *forces) {
    const JoxAgents *a = step->agents;
    size_t count;
    const JoxKeptImpulse *kept = jox_force_kept_impulses(forces, JOX_KEPT_PAIRS, &count);
    memset(f->onto, 0, a->count * sizeof *f->onto);
    if (!jox_falls_lies_any(a))
        return;
    for (size_t k = 0; k < count; k++) {
        const uint32_t i = jox_agents_find(a, kept[k].id), j = jox_agents_find(a, kept[k].other);
        if (i == JOX_NO_INDEX || j == JOX_NO_INDEX ||
            (a->fallen[i] > 0.0f) == (a->fallen[j] > 0.0f))
            continue;
        const bool stands = a->fallen[j] > 0.0f; /* i does */
        const JoxV2 way = jox_unit(jox_offset(a, stands ? i : j, stands ? j : i));
        JoxV2 *onto = &f->onto[stands ? i : j];
        *onto = jox_add(*onto, jox_scale(way, kept[k].impulse / (float)step->timing.dt));
    }
}

/* Moves the lean of agent i on by a step: where, from its centre, feet would have to be to hold it
   against the forces on it, m. Those who lie stop its feet alone; and its own momentum, which the
   contact with them stops, throws it nowhere. */
static JoxV2 update_lean(const JoxFalls *f, const JoxStep *step, uint32_t i) {
    JoxAgents *a = step->agents;
    const float dt = (float)step->timing.dt, mass = jox_param(a, JOX_PARAM_mass, i);
    const JoxV2 force = jox_add((JoxV2){a->force_x[i], a->force_y[i]}, f->onto[i]);
    const JoxV2 before = {a->lean_x[i], a->lean_y[i]};
    JoxV2 lean = jox_add(jox_scale(before, 1.0f - RATE * dt), jox_scale(force, dt / (mass * RATE)));
    if (jox_length2(lean) < 1e-8f)
        lean = (JoxV2){0.0f, 0.0f};
    a->lean_x[i] = lean.x;
    a->lean_y[i] = lean.y;
    return lean;
}

/* Returns how far feet can get along a unit vector, m; INFINITY where one who stands ahead holds
   agent i up. */
static float find_reach(const JoxStep *step, uint32_t i, JoxV2 way) {
    const JoxAgents *a = step->agents;
    const JoxNeighbours *near = step->neighbours;
    float reach = jox_param(a, JOX_PARAM_balance, i);
    for (uint32_t k = 0; k < near->count[i]; k++) {
        const uint32_t j = near->index[jox_neighbour_at(near, i, k)];
        const JoxV2 offset = jox_offset(a, i, j);
        if (jox_dot(offset, way) < AHEAD * jox_length(offset))
            continue;
        const float gap = jox_torso_gap(a, i, j);
        if (!(a->fallen[j] > 0.0f) && gap < SUPPORT)
            return INFINITY;
        if (a->fallen[j] > 0.0f)
            reach = jox_minf(reach, FEET + jox_maxf(0.0f, gap));
    }
    return reach;
}

/* Returns whether agent i, which leans, loses its balance: because it is pressed onto those who
   lie, or because it moves along the lean and its feet do not come as far. */
static bool loses_balance(const JoxFalls *f, const JoxStep *step, uint32_t i, JoxV2 lean) {
    const JoxAgents *a = step->agents;
    const JoxV2 velocity = {a->vx[i], a->vy[i]};
    const float speed = jox_length(velocity);
    if (jox_dot(lean, jox_unit(f->onto[i])) > FEET)
        return true;
    if (!(speed > FEET * RATE))
        return false;
    const JoxV2 way = jox_scale(velocity, 1.0f / speed);
    const float needed = jox_minf(jox_dot(lean, way), speed / RATE);
    return needed > FEET && needed > find_reach(step, i, way);
}

/* A step of a range of agents, each of which writes its own columns alone. */
typedef struct Range {
    JoxFalls *falls;
    const JoxStep *step;
} Range;

static void find_falling(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const Range *r = context;
    JoxAgents *a = r->step->agents;
    for (uint32_t i = begin; i < end; i++) {
        r->falls->now[i] = false;
        if (a->fallen[i] > 0.0f || !(jox_param(a, JOX_PARAM_balance, i) > 0.0f))
            continue;
        r->falls->now[i] = loses_balance(r->falls, r->step, i, update_lean(r->falls, r->step, i));
    }
}

/* Lets agent i lie on for a step. Those who hold on to it help it up. */
static void lie_on(JoxAgents *a, uint32_t i, float dt) {
    a->fallen[i] += dt * (float)(1 + a->held[i]);
    if (a->fallen[i] <= jox_param(a, JOX_PARAM_rise, i) || a->load[i] > PRESSED)
        return;
    a->fallen[i] = a->displaced_x[i] = a->displaced_y[i] = a->settled[i] = 0.0f;
}

void jox_falls_step(JoxFalls *f, const JoxStep *step, const JoxForces *forces,
                    JoxStatistics *statistics) {
    enum { GRAIN = 256 };
    JoxAgents *a = step->agents;
    uint64_t lying = 0;
    Range range = {f, step};
    reserve_agents(f, a->count);
    sum_contacts(f, step, forces);
    jox_parallel_for(step->pool, a->count, GRAIN, find_falling, &range);
    for (uint32_t i = 0; i < a->count; i++) {
        const float dt = (float)step->timing.dt;
        if (a->fallen[i] > 0.0f) {
            lie_on(a, i, dt);
        } else if (f->now[i]) {
            a->fallen[i] = dt;
            a->lean_x[i] = a->lean_y[i] = 0.0f;
            statistics->falls++;
        }
        lying += a->fallen[i] > 0.0f;
    }
    if (lying > statistics->most_fallen)
        statistics->most_fallen = lying;
}

void jox_falls_free(JoxFalls *f) {
    jox_free(f->onto);
    jox_free(f->now);
    *f = (JoxFalls){0};
}
