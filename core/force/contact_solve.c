/* The impulses of all contacts at once: velocities start from what the other forces give, and
   Gauss-Seidel passes over the contacts (sequential impulses with accumulated clamping, as E.
   Catto, Game Developers Conference 2006) go on until a pass changes no force by more than the
   tolerance. Contacts of one colour share no agent, so that threads and the order in memory change
   no bit. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "force/internal.h"

enum { PAIR_GRAIN = 1024, WALL_GRAIN = 256 };

/* What a pass over a part of the contacts needs. */
typedef struct Pass {
    JoxForces *forces;
    uint32_t first;   /* of the colour */
    float *residuals; /* per chunk: greatest change of an impulse, N s */
    uint32_t chunk;   /* of the first of them */
} Pass;

static void start_velocities(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    const JoxAgents *a = f->step.agents;
    const float *mass = a->param[JOX_PARAM_mass];
    const float dt = (float)f->step.dt;
    for (uint32_t i = begin; i < end; i++) {
        float lightness = 1.0f / mass[i];
        f->lightness[i] = lightness;
        JoxV2 force = jox_moving_force(a, i);
        JoxV2 begins = {a->vx[i] + force.x * lightness * dt, a->vy[i] + force.y * lightness * dt};
        /* What is no number stays with whom it came from, who is named when the step has ended. */
        bool finite = isfinite(begins.x) && isfinite(begins.y);
        f->work[i] = finite ? begins : jox_v2(0.0f, 0.0f);
    }
}

static inline void move_by(JoxV2 *velocity, float nx, float ny, float change) {
    velocity->x += nx * change;
    velocity->y += ny * change;
}

/* The impulses that contacts begin with: velocities that fit them. */
static void warm_colour(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const Pass *pass = context;
    JoxForces *f = pass->forces;
    const JoxPairs *p = &f->pairs;
    for (uint32_t k = pass->first + begin; k < pass->first + end; k++) {
        float impulse = p->impulse[k] + p->squeeze[k] * (float)f->step.dt;
        if (!(impulse > 0.0f))
            continue;
        uint32_t i = p->first[k], j = p->second[k];
        move_by(&f->work[i], p->nx[k], p->ny[k], impulse * f->lightness[i]);
        move_by(&f->work[j], p->nx[k], p->ny[k], -impulse * f->lightness[j]);
    }
}

static void solve_colour(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const Pass *pass = context;
    JoxForces *f = pass->forces;
    JoxPairs *p = &f->pairs;
    float most = 0.0f;
    for (uint32_t k = pass->first + begin; k < pass->first + end; k++) {
        uint32_t i = p->first[k], j = p->second[k];
        JoxV2 *vi = &f->work[i], *vj = &f->work[j];
        float speed = (vi->x - vj->x) * p->nx[k] + (vi->y - vj->y) * p->ny[k];
        float before = p->impulse[k];
        float after = jox_maxf(0.0f, before + (p->target[k] - speed) * p->mass[k]);
        float change = after - before;
        p->impulse[k] = after;
        most = jox_maxf(most, fabsf(change));
        move_by(vi, p->nx[k], p->ny[k], change * f->lightness[i]);
        move_by(vj, p->nx[k], p->ny[k], -change * f->lightness[j]);
    }
    pass->residuals[pass->chunk + begin / PAIR_GRAIN] = most;
}

static void warm_walls(JoxForces *f) {
    for (uint32_t k = 0; k < f->wall_count; k++) {
        const JoxWallContact *w = &f->wall[k];
        move_by(&f->work[w->agent], w->normal.x, w->normal.y, w->impulse * f->lightness[w->agent]);
    }
}

/* Over the walls of agents [begin, end) of those that touch any. */
static void solve_walls(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const Pass *pass = context;
    JoxForces *f = pass->forces;
    const float *mass = f->step.agents->param[JOX_PARAM_mass];
    float most = 0.0f;
    for (uint32_t k = f->wall_group[begin]; k < f->wall_group[end]; k++) {
        JoxWallContact *w = &f->wall[k];
        float before = w->impulse, speed = jox_dot(f->work[w->agent], w->normal);
        w->impulse = jox_maxf(0.0f, before + (w->target - speed) * mass[w->agent]);
        float change = w->impulse - before;
        most = jox_maxf(most, fabsf(change));
        move_by(&f->work[w->agent], w->normal.x, w->normal.y, change * f->lightness[w->agent]);
    }
    pass->residuals[pass->chunk + begin / WALL_GRAIN] = most;
}

static uint32_t chunks_of(uint32_t count, uint32_t grain) {
    return (count + grain - 1) / grain;
}

/* One pass over everything; returns the greatest change of an impulse, N s. */
static float pass_over(JoxForces *f) {
    JoxPairs *p = &f->pairs;
    Pass pass = {.forces = f, .residuals = f->residuals};
    for (uint32_t c = 0; c < p->colours; c++) {
        uint32_t count = p->starts[c + 1] - p->starts[c];
        pass.first = p->starts[c];
        jox_parallel_for(f->step.pool, count, PAIR_GRAIN, solve_colour, &pass);
        pass.chunk += chunks_of(count, PAIR_GRAIN);
    }
    jox_parallel_for(f->step.pool, f->wall_groups, WALL_GRAIN, solve_walls, &pass);
    pass.chunk += chunks_of(f->wall_groups, WALL_GRAIN);
    float most = jox_touches_pass(f);
    for (uint32_t k = 0; k < pass.chunk; k++)
        most = jox_maxf(most, f->residuals[k]);
    return most;
}

static void begin_solve(JoxForces *f) {
    const JoxPairs *p = &f->pairs;
    uint32_t chunks = chunks_of(f->wall_groups, WALL_GRAIN);
    for (uint32_t c = 0; c < p->colours; c++)
        chunks += chunks_of(p->starts[c + 1] - p->starts[c], PAIR_GRAIN);
    JOX_RESERVE(f->residuals, f->residual_capacity, chunks);
    jox_parallel_for(f->step.pool, f->step.agents->count, JOX_FORCE_GRAIN, start_velocities, f);
    for (uint32_t c = 0; c < p->colours; c++) {
        Pass pass = {.forces = f, .first = p->starts[c]};
        jox_parallel_for(f->step.pool, p->starts[c + 1] - p->starts[c], PAIR_GRAIN, warm_colour,
                         &pass);
    }
    warm_walls(f);
    jox_touches_begin(f);
}

void jox_contacts_solve(JoxForces *f) {
    JOX_RESERVE(f->work, f->work_capacity, f->step.agents->count);
    JOX_RESERVE(f->lightness, f->lightness_capacity, f->step.agents->count);
    begin_solve(f);
    f->totals.passes = 0;
    float enough = f->options.tolerance * (float)f->step.dt, most = INFINITY;
    while (most > enough && f->totals.passes < f->options.iterations) {
        most = pass_over(f);
        f->totals.passes++;
    }
    f->totals.residual = most / (float)f->step.dt;
}
