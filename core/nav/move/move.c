/* The stage move: integrates velocities and positions, resolves overlaps weakly, and keeps agents
   from passing walls. The kernels of the run's instruction set (move_wide.c) do the first and the
   last. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "geom/wall_images.h"
#include "nav/move/move.h"

#define X(name, isa) [isa] = {jox_move_integrate_##name, jox_move_settle_##name},
static const struct Kernels {
    JoxMoveKernel *integrate;
    JoxSettleKernel *settle;
} KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

static const float STIFFNESS =
    0.2f; /* share of an overlap that one sweep resolves in a step of STIFF_STEP */
static const float STIFF_STEP = 0.05f; /* s; shorter steps resolve proportionally less */
enum { SWEEPS = 2 };

/* Adds to positions how far escalators carry agents: no motion of their own nor one by others, so
   velocities, contacts and displacements leave it out. */
static void carry_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const JoxMove *m = context;
    const JoxNeighbours *n = m->step.neighbours;
    const float dt = (float)m->step.timing.dt;
    for (uint32_t i = begin; i < end; i++) {
        const JoxV2 belt = {n->belt_x[i], n->belt_y[i]};
        m->position[0][i] = jox_add(m->position[0][i], jox_scale(belt, dt));
    }
}

static void integrate_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const JoxMove *m = context;
    KERNELS[m->nav->isa].integrate(m, begin, end);
}

/* Returns agent i's share, by mass, of the shift that resolves its overlap with agent j, m.
   `apart`: sum of their radii, m. */
static inline JoxV2 find_overlap_shift(const JoxMove *m, const JoxV2 *from, uint32_t i, uint32_t j,
                                       float apart) {
    const JoxAgents *a = m->step.agents;
    const JoxParameterColumn mass = a->param[JOX_PARAM_mass];
    JOX_ASSERT(j < a->count && j != i);
    JoxV2 d = jox_fold(a, jox_sub(from[i], from[j]));
    float d2 = jox_length2(d);
    if (d2 >= apart * apart || d2 == 0.0f)
        return (JoxV2){0.0f, 0.0f};
    float distance = sqrtf(d2);
    float part =
        m->stiffness * (apart - distance) * jox_at(mass, j) / (jox_at(mass, i) + jox_at(mass, j));
    return jox_scale(d, part / distance);
}

/* Shifts each agent of the range out of its neighbours by its own share of every overlap. All
   positions are read from the previous sweep, so that the order of the agents does not matter. */
static void sweep_neighbours(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxMove *m = context;
    const JoxParameterColumn radius = m->step.agents->param[JOX_PARAM_radius];
    const JoxV2 *from = m->position[m->from];
    JoxV2 *to = m->position[!m->from];
    for (uint32_t i = begin; i < end; i++) {
        JoxV2 shift = {0.0f, 0.0f};
        for (uint32_t k = 0; k < m->step.neighbours->count[i]; k++) {
            uint32_t j = m->step.neighbours->index[jox_neighbour_at(m->step.neighbours, i, k)];
            shift = jox_add(
                shift, find_overlap_shift(m, from, i, j, jox_at(radius, i) + jox_at(radius, j)));
        }
        to[i] = jox_add(from[i], shift);
    }
}

/* Returns whether none of the eight agents from `begin` on has a contact. */
static inline bool touch_nothing_in_eight(const JoxContactPlanes *t, uint32_t begin) {
    uint64_t people, bodies;
    memcpy(&people, t->people + begin, sizeof people);
    memcpy(&bodies, t->bodies + begin, sizeof bodies);
    return (people | bodies) == 0;
}

/* Returns agent i's share, by mass, of the shift that resolves its overlap with one that it
   touches, m. */
static inline JoxV2 find_contact_shift(const JoxMove *m, const JoxV2 *from, uint32_t i,
                                       const JoxContactPlane *plane) {
    const JoxAgents *a = m->step.agents;
    const JoxParameterColumn mass = a->param[JOX_PARAM_mass];
    const uint32_t j = plane->other;
    const float depth =
        plane->apart - jox_dot(jox_fold(a, jox_sub(from[i], from[j])), plane->normal);
    const float share = jox_at(mass, j) / (jox_at(mass, i) + jox_at(mass, j));
    return jox_scale(plane->normal, m->stiffness * share * jox_maxf(0.0f, depth));
}

/* Shifts each agent of the range out of the agents and bodies that it touches. Velocities stay as
   they are, so that overlaps add no energy. */
static void sweep_contacts(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxMove *m = context;
    const JoxContactPlanes *t = m->step.touched;
    const JoxV2 *from = m->position[m->from];
    JoxV2 *to = m->position[!m->from];
    memcpy(to + begin, from + begin, (end - begin) * sizeof *to);
    for (uint32_t i = begin; i < end; i++) {
        if (!t->people[i] && !t->bodies[i]) {
            i += i + 8 <= end && touch_nothing_in_eight(t, i) ? 7 : 0;
            continue;
        }
        const JoxContactPlane *planes = t->planes + t->starts[i];
        JoxV2 shift = {0.0f, 0.0f};
        for (uint32_t k = 0; k < t->people[i]; k++)
            shift = jox_add(shift, find_contact_shift(m, from, i, &planes[k]));
        for (uint32_t k = 0; k < t->bodies[i]; k++) {
            const JoxObject *body = &m->step.objects->rows[planes[t->people[i] + k].other];
            JoxFootprintPoint side = jox_footprint_nearest(body, from[i]);
            float overlap = m->step.agents->contact_radius[i] - side.gap;
            shift = jox_add(shift, jox_scale(side.normal, m->stiffness * jox_maxf(0.0f, overlap)));
        }
        to[i] = jox_add(from[i], shift);
    }
}

static void settle_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const JoxMove *m = context;
    m->nav->chunk_drift[begin / JOX_NAV_GRAIN] = KERNELS[m->nav->isa].settle(m, begin, end);
}

/* Adds the drift of this step to that since the sort, widened for the rounding of sums. */
static void add_step_drift(JoxNav *nav, uint32_t agents) {
    if (agents == 0)
        return;
    JoxDrift step = nav->chunk_drift[0], *all = &nav->drift;
    for (uint32_t chunk = 1; chunk * JOX_NAV_GRAIN < agents; chunk++)
        step = jox_drift_of_both(step, nav->chunk_drift[chunk]);
    const float slack = 1e-4f * step.farthest;
    all->farthest += step.farthest + slack;
    all->least = jox_sub(jox_add(all->least, step.least), (JoxV2){slack, slack});
    all->most = jox_add(jox_add(all->most, step.most), (JoxV2){slack, slack});
}

void jox_nav_move(JoxNav *nav, const JoxStep *step) {
    JoxAgents *agents = step->agents;
    const JoxTiming *timing = &step->timing;
    JOX_ASSERT(timing->dt > 0.0 && timing->response > 0.0 && timing->response <= 1.0);
    JOX_ASSERT(timing->on_the_way > 0.0 && timing->on_the_way <= timing->response);
    JoxMove move = {.nav = nav,
                    .step = jox_nav_step(step),
                    .unhidden2 = jox_nav_unhidden2(nav),
                    .served = jox_minf(nav->grid.reach, jox_wall_images_reach(agents->period))};
    jox_stage_memory_begin(nav->memory, 2 * jox_stage_memory_bytes(agents->count, sizeof(JoxV2)));
    for (int i = 0; i < 2; i++)
        move.position[i] =
            jox_stage_memory_take(nav->memory, agents->count, sizeof *move.position[i]);
    move.stiffness = STIFFNESS * jox_minf(1.0f, (float)timing->dt / STIFF_STEP);
    jox_parallel_for(step->pool, agents->count, JOX_NAV_GRAIN, integrate_range, &move);
    if (step->neighbours->has_belts)
        jox_parallel_for(step->pool, agents->count, JOX_NAV_GRAIN, carry_range, &move);
    for (int i = 0; i < SWEEPS && !nav->literal; i++) {
        jox_parallel_for(step->pool, agents->count, JOX_NAV_GRAIN,
                         move.step.touched ? sweep_contacts : sweep_neighbours, &move);
        move.from = !move.from;
    }
    jox_parallel_for(step->pool, agents->count, JOX_NAV_GRAIN, settle_range, &move);
    nav->unhidden_reach = -1.0f;
    add_step_drift(nav, agents->count);
    jox_nav_place_strays(nav, agents);
}
