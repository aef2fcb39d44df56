/* Solves the impulses of all contacts together. Velocities start from what the other forces give
   (layout.c); Gauss-Seidel passes over the contacts (sequential impulses with accumulated
   clamping, E. Catto, Game Developers Conference 2006) repeat until a pass changes no force by more
   than the tolerance. Contacts of one colour share no agent, so that neither threads nor the order
   in memory change a bit. */
#include <math.h>

#include "base/mem.h"
#include "force/contact/contacts.h"

enum { PAIR_GRAIN = 1024, WALL_GRAIN = 256 };

/* One pass over a part of the contacts. */
typedef struct Pass {
    JoxForces *forces;
    uint32_t first;   /* first contact of the colour */
    float *residuals; /* per chunk: greatest change of an impulse, N s */
    uint32_t chunk;   /* index in `residuals` of the first chunk of the pass's part */
} Pass;

static inline void add_along(JoxV2 *velocity, JoxV2 normal, float change) {
    velocity->x += normal.x * change;
    velocity->y += normal.y * change;
}

/* Applies the impulses that the contacts of a colour start with. */
static void apply_colour_impulses(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const Pass *pass = context;
    JoxForces *f = pass->forces;
    JoxContactSolve *solve = &f->contacts->solve;
    for (uint32_t k = pass->first + begin; k < pass->first + end; k++) {
        const JoxPair *p = &f->contacts->pairs.items[k];
        float impulse = p->impulse + p->squeeze * (float)f->step.timing.dt;
        if (!(impulse > 0.0f))
            continue;
        add_along(&solve->velocities[p->first], p->normal, impulse * solve->inverse_mass[p->first]);
        add_along(&solve->velocities[p->second], p->normal,
                  -impulse * solve->inverse_mass[p->second]);
    }
}

/* Solves the contacts [begin, end) of a colour once: each impulse becomes what its target asks for
   at the present velocities, but never pulls. */
static void solve_colour(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const Pass *pass = context;
    JoxForces *f = pass->forces;
    JoxContactSolve *solve = &f->contacts->solve;
    float most = 0.0f;
    for (uint32_t k = pass->first + begin; k < pass->first + end; k++) {
        JoxPair *p = &f->contacts->pairs.items[k];
        JoxV2 *vi = &solve->velocities[p->first], *vj = &solve->velocities[p->second];
        float speed = (vi->x - vj->x) * p->normal.x + (vi->y - vj->y) * p->normal.y;
        float before = p->impulse;
        float after = jox_maxf(0.0f, before + (p->target - speed) * p->mass);
        float change = after - before;
        p->impulse = after;
        most = jox_maxf(most, fabsf(change));
        add_along(vi, p->normal, change * solve->inverse_mass[p->first]);
        add_along(vj, p->normal, -change * solve->inverse_mass[p->second]);
    }
    pass->residuals[pass->chunk + begin / PAIR_GRAIN] = most;
}

static void apply_wall_impulses(JoxForces *f) {
    JoxWallContacts *walls = &f->contacts->walls;
    JoxContactSolve *solve = &f->contacts->solve;
    for (uint32_t k = 0; k < walls->count; k++) {
        const JoxWallContact *w = &walls->items[k];
        add_along(&solve->velocities[w->agent], w->normal,
                  w->impulse * solve->inverse_mass[w->agent]);
    }
}

/* Solves the wall contacts of the groups [begin, end); a group is one agent at walls. */
static void solve_walls(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const Pass *pass = context;
    JoxForces *f = pass->forces;
    JoxWallContacts *walls = &f->contacts->walls;
    JoxContactSolve *solve = &f->contacts->solve;
    const JoxParameterColumn mass = f->step.agents->param[JOX_PARAM_mass];
    float most = 0.0f;
    for (uint32_t k = walls->groups[begin]; k < walls->groups[end]; k++) {
        JoxWallContact *w = &walls->items[k];
        float before = w->impulse, speed = jox_dot(solve->velocities[w->agent], w->normal);
        w->impulse = jox_maxf(0.0f, before + (w->target - speed) * jox_at(mass, w->agent));
        float change = w->impulse - before;
        most = jox_maxf(most, fabsf(change));
        add_along(&solve->velocities[w->agent], w->normal, change * solve->inverse_mass[w->agent]);
    }
    pass->residuals[pass->chunk + begin / WALL_GRAIN] = most;
}

static uint32_t count_chunks(uint32_t count, uint32_t grain) {
    return (count + grain - 1) / grain;
}

/* Runs one pass over all contacts; returns the greatest change of an impulse, N s. */
static float solve_once(JoxForces *f) {
    JoxContactSolve *solve = &f->contacts->solve;
    JoxWallContacts *walls = &f->contacts->walls;
    JoxPairs *p = &f->contacts->pairs;
    Pass pass = {.forces = f, .residuals = solve->residuals};
    for (uint32_t c = 0; c < p->colours; c++) {
        uint32_t count = p->starts[c + 1] - p->starts[c];
        pass.first = p->starts[c];
        jox_parallel_for(f->step.pool, count, PAIR_GRAIN, solve_colour, &pass);
        pass.chunk += count_chunks(count, PAIR_GRAIN);
    }
    jox_parallel_for(f->step.pool, walls->group_count, WALL_GRAIN, solve_walls, &pass);
    pass.chunk += count_chunks(walls->group_count, WALL_GRAIN);
    float most = jox_touches_solve_once(f);
    for (uint32_t k = 0; k < pass.chunk; k++)
        most = jox_maxf(most, solve->residuals[k]);
    return most;
}

/* Applies the kept impulses of all contacts, which make the solve converge sooner. */
static void apply_first_impulses(JoxForces *f) {
    JoxContactSolve *solve = &f->contacts->solve;
    const JoxPairs *p = &f->contacts->pairs;
    uint32_t chunks = count_chunks(f->contacts->walls.group_count, WALL_GRAIN);
    for (uint32_t c = 0; c < p->colours; c++)
        chunks += count_chunks(p->starts[c + 1] - p->starts[c], PAIR_GRAIN);
    JOX_RESERVE(solve->residuals, solve->residual_capacity, chunks);
    for (uint32_t c = 0; c < p->colours; c++) {
        Pass pass = {.forces = f, .first = p->starts[c]};
        jox_parallel_for(f->step.pool, p->starts[c + 1] - p->starts[c], PAIR_GRAIN,
                         apply_colour_impulses, &pass);
    }
    apply_wall_impulses(f);
    jox_touches_start_solve(f);
}

void jox_contacts_solve(JoxForces *f) {
    apply_first_impulses(f);
    f->totals.passes = 0;
    float enough = f->options.tolerance * (float)f->step.timing.dt, most = INFINITY;
    while (most > enough && f->totals.passes < f->options.iterations) {
        most = solve_once(f);
        f->totals.passes++;
    }
    f->totals.residual = most / (float)f->step.timing.dt;
}
