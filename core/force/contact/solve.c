/* Solves the impulses of all contacts together. Velocities start from what the other forces give
   (layout.c); Gauss-Seidel passes over the contacts (sequential impulses with accumulated
   clamping, E. Catto, Game Developers Conference 2006) repeat until a pass changes no force by more
   than the tolerance. Contacts of one colour share no agent, so that neither threads nor the order
   in memory change a bit. */
#include <math.h>

#include "base/mem.h"
#include "force/contact/contacts.h"

#define X(name, isa) [isa] = jox_solve_pairs_##name,
static JoxSolvePairsKernel *const KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

#define X(name, isa)                                                                               \
    [isa] = {jox_start_bearing_##name, jox_end_bearing_##name, jox_end_parting_##name},
static const struct Bearing {
    JoxMotionKernel *start, *end, *end_parting;
} BEARING[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

static const float BEARS = 4.0f; /* tolerance of plans, in tolerances of forces */
/* Factor of the corrections of plans (successive over-relaxation, D. M. Young 1954): in as many
   passes they come about as far through a crowd as with four times the passes at 1. */
static const float BEARS_RELAXATION = 1.3f;
enum { PAIR_GRAIN = 1024, WALL_GRAIN = 256, TOUCH_GRAIN = 256, FEET_GRAIN = 256 };

/* One pass over a part of the contacts. */
typedef struct Pass {
    JoxForces *forces;
    bool bears;       /* the contacts bear plans, which cause no friction */
    bool parts;       /* torsos that overlap part */
    uint32_t first;   /* first contact of the colour */
    float *residuals; /* per chunk: greatest change of an impulse, N s */
    uint32_t chunk;   /* index in `residuals` of the first chunk of the pass's part */
} Pass;

/* Returns by how much an impulse that starts a solve differs from that of the solve before: the one
   that parts adds what it added in the last step. */
static inline float start_impulse(bool parts, float *impulse, float parted) {
    const float before = parts ? *impulse : 0.0f;
    if (parts)
        *impulse = jox_maxf(0.0f, before + parted);
    return *impulse - before;
}

/* Applies the impulses that the contacts of a colour start with. */
static void apply_colour_impulses(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const Pass *pass = context;
    JoxForces *f = pass->forces;
    JoxContactSolve *solve = &f->contacts->solve;
    for (uint32_t k = pass->first + begin; k < pass->first + end; k++) {
        JoxPair *p = &f->contacts->pairs.items[k];
        const float change = start_impulse(pass->parts, &p->impulse, p->at.parted);
        if (change == 0.0f)
            continue;
        jox_add_impulse(&solve->motions[p->first], p->at.normal, p->at.levers[0], change);
        jox_add_impulse(&solve->motions[p->second], p->at.normal, p->at.levers[1], -change);
    }
}

static void solve_colour(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const Pass *pass = context;
    const JoxForces *f = pass->forces;
    pass->residuals[pass->chunk + begin / PAIR_GRAIN] = KERNELS[f->isa](
        f->contacts->pairs.items + pass->first + begin, end - begin, f->contacts->solve.motions,
        pass->bears ? 0.0f : f->options.friction, pass->bears ? BEARS_RELAXATION : 1.0f);
}

static void apply_wall_impulses(JoxForces *f, bool parts) {
    JoxWallContacts *walls = &f->contacts->walls;
    JoxContactSolve *solve = &f->contacts->solve;
    for (uint32_t k = 0; k < walls->count; k++) {
        JoxWallContact *w = &walls->items[k];
        const float change = start_impulse(parts, &w->impulse, w->parted);
        jox_add_impulse(&solve->motions[w->agent], w->normal, w->lever, change);
    }
}

/* Solves the wall contacts of the groups [begin, end); a group is one agent at walls. */
static void solve_walls(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const Pass *pass = context;
    JoxForces *f = pass->forces;
    JoxWallContacts *walls = &f->contacts->walls;
    JoxContactSolve *solve = &f->contacts->solve;
    const float relaxation = pass->bears ? BEARS_RELAXATION : 1.0f;
    float most = 0.0f;
    for (uint32_t k = walls->groups[begin]; k < walls->groups[end]; k++) {
        JoxWallContact *w = &walls->items[k];
        JoxContactMotion *motion = &solve->motions[w->agent];
        float before = w->impulse, speed = jox_speed_along(motion, w->normal, w->lever);
        w->impulse = jox_maxf(0.0f, before + relaxation * (w->target - speed) * w->mass);
        float change = w->impulse - before;
        most = jox_maxf(most, fabsf(change));
        jox_add_impulse(motion, w->normal, w->lever, change);
        if (!(w->slip_mass > 0.0f) || pass->bears)
            continue;
        const JoxV2 tangent = jox_left(w->normal);
        const float bound = f->options.friction * w->impulse, last = w->slip;
        w->slip = jox_clampf(last - jox_speed_along(motion, tangent, w->slip_lever) * w->slip_mass,
                             -bound, bound);
        most = jox_maxf(most, fabsf(w->slip - last));
        jox_add_impulse(motion, tangent, w->slip_lever, w->slip - last);
    }
    pass->residuals[pass->chunk + begin / WALL_GRAIN] = most;
}

static void solve_feet(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const Pass *pass = context;
    pass->residuals[pass->chunk + begin / FEET_GRAIN] =
        jox_feet_solve_once(pass->forces, begin, end);
}

/* Solves for plans the touches of agents whose first touch is in [begin, end): bodies keep the
   motion that forces gave them. */
static void bear_touches(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const Pass *pass = context;
    JoxForces *f = pass->forces;
    JoxContactMotion *motions = f->contacts->solve.motions;
    const JoxTouches *touches = &f->contacts->touches;
    float most = 0.0f;
    for (uint32_t k = begin; k < touches->count; k++) {
        JoxTouch *t = &touches->items[k];
        const uint32_t first = touches->first[t->agent];
        if (first >= end)
            break;
        if (first < begin)
            continue;
        const float speed = jox_speed_along(&motions[t->agent], t->normal, t->lever);
        const float last = t->before;
        t->before = jox_maxf(0.0f, last + (t->target - speed) * t->mass);
        jox_add_impulse(&motions[t->agent], t->normal, t->lever, t->before - last);
        most = jox_maxf(most, fabsf(t->before - last));
    }
    pass->residuals[pass->chunk + begin / TOUCH_GRAIN] = most;
}

static uint32_t count_chunks(uint32_t count, uint32_t grain) {
    return (count + grain - 1) / grain;
}

/* Runs one pass over all contacts, of forces or of plans (`bears`); returns the greatest change of
 * an impulse, N s. */
static float solve_once(JoxForces *f, bool bears) {
    JoxContactSolve *solve = &f->contacts->solve;
    JoxWallContacts *walls = &f->contacts->walls;
    JoxPairs *p = &f->contacts->pairs;
    Pass pass = {.forces = f, .bears = bears, .residuals = solve->residuals};
    for (uint32_t c = 0; c < p->colours; c++) {
        uint32_t count = p->starts[c + 1] - p->starts[c];
        pass.first = p->starts[c];
        jox_parallel_for(f->step.pool, count, PAIR_GRAIN, solve_colour, &pass);
        pass.chunk += count_chunks(count, PAIR_GRAIN);
    }
    jox_parallel_for(f->step.pool, walls->group_count, WALL_GRAIN, solve_walls, &pass);
    pass.chunk += count_chunks(walls->group_count, WALL_GRAIN);
    float most = bears ? 0.0f : jox_touches_solve_once(f);
    if (!bears) {
        jox_parallel_for(f->step.pool, f->contacts->feet.count, FEET_GRAIN, solve_feet, &pass);
        pass.chunk += count_chunks(f->contacts->feet.count, FEET_GRAIN);
    } else {
        jox_parallel_for(f->step.pool, f->contacts->touches.count, TOUCH_GRAIN, bear_touches,
                         &pass);
        pass.chunk += count_chunks(f->contacts->touches.count, TOUCH_GRAIN);
    }
    for (uint32_t k = 0; k < pass.chunk; k++)
        most = jox_maxf(most, solve->residuals[k]);
    return most;
}

/* Applies the impulses that contacts with agents and walls start with. */
static void apply_impulses(JoxForces *f, bool parts) {
    const JoxPairs *p = &f->contacts->pairs;
    for (uint32_t c = 0; c < p->colours; c++) {
        Pass pass = {.forces = f, .parts = parts, .first = p->starts[c]};
        jox_parallel_for(f->step.pool, p->starts[c + 1] - p->starts[c], PAIR_GRAIN,
                         apply_colour_impulses, &pass);
    }
    apply_wall_impulses(f, parts);
}

/* Applies the kept impulses of all contacts, which make the solve converge sooner. */
static void apply_first_impulses(JoxForces *f) {
    JoxContactSolve *solve = &f->contacts->solve;
    const JoxPairs *p = &f->contacts->pairs;
    uint32_t chunks = count_chunks(f->contacts->walls.group_count, WALL_GRAIN) +
                      count_chunks(f->contacts->touches.count, TOUCH_GRAIN) +
                      count_chunks(f->contacts->feet.count, FEET_GRAIN);
    for (uint32_t c = 0; c < p->colours; c++)
        chunks += count_chunks(p->starts[c + 1] - p->starts[c], PAIR_GRAIN);
    JOX_RESERVE(solve->residuals, solve->residual_capacity, chunks);
    apply_impulses(f, false);
    jox_touches_start_solve(f);
}

void jox_contacts_solve(JoxForces *f) {
    apply_first_impulses(f);
    f->totals.passes = 0;
    float enough = f->options.tolerance * (float)f->step.timing.dt, most = INFINITY;
    while (most > enough && f->totals.passes < f->options.iterations) {
        most = solve_once(f, false);
        f->totals.passes++;
    }
    f->totals.residual = most / (float)f->step.timing.dt;
}

/* Starts the pairs [begin, end) with the impulses that bore plans in the last step. */
static void start_bearing_pairs(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const JoxForces *f = context;
    for (uint32_t k = begin; k < end; k++) {
        JoxPair *p = &f->contacts->pairs.items[k];
        p->impulse = p->at.borne;
        p->slip = 0.0f;
    }
}

/* Runs a kernel of bearing for agents [begin, end). */
static void start_bearing(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    BEARING[f->isa].start(f, begin, end);
}
static void write_borne(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    BEARING[f->isa].end(f, begin, end);
}
static void write_parted(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxForces *f = context;
    BEARING[f->isa].end_parting(f, begin, end);
}

/* Raises targets to the parting speed of an overlap; returns whether it is higher. */
static inline bool raise_target(const JoxForces *f, float gap, float *target) {
    const float speed = jox_parting_speed(f, gap);
    if (!(speed > *target))
        return false;
    *target = speed;
    return true;
}

/* Ends bearing for the pairs [begin, end), and raises the targets of those that overlap. */
static void end_bearing_pairs(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const JoxForces *f = context;
    bool parts = false;
    for (uint32_t k = begin; k < end; k++) {
        JoxPair *p = &f->contacts->pairs.items[k];
        p->at.borne = p->impulse;
        parts |= raise_target(f, p->at.gap, &p->at.target);
    }
    f->contacts->solve.residuals[begin / PAIR_GRAIN] = parts ? 1.0f : 0.0f;
}

/* Ends bearing, and raises the targets of contacts that overlap to their parting speeds; returns
   whether any does. */
static bool end_bearing(JoxForces *f) {
    JoxWallContacts *walls = &f->contacts->walls;
    const JoxPairs *pairs = &f->contacts->pairs;
    bool parts = jox_touches_start_parting(f);
    jox_parallel_for(f->step.pool, pairs->count, PAIR_GRAIN, end_bearing_pairs, f);
    for (uint32_t k = 0; k < count_chunks(pairs->count, PAIR_GRAIN); k++)
        parts |= f->contacts->solve.residuals[k] > 0.0f;
    for (uint32_t k = 0; k < walls->count; k++) {
        JoxWallContact *w = &walls->items[k];
        w->borne = w->impulse;
        parts |= raise_target(f, w->gap, &w->target);
    }
    return parts;
}

static void solve_bearing(JoxForces *f) {
    const float enough = BEARS * f->options.tolerance * (float)f->step.timing.dt;
    float most = INFINITY;
    for (uint32_t pass = 0; most > enough && pass < f->options.iterations; pass++)
        most = solve_once(f, true);
}

void jox_force_bear(JoxForces *f) {
    JoxAgents *a = f->step.agents;
    JoxPairs *pairs = &f->contacts->pairs;
    JoxWallContacts *walls = &f->contacts->walls;
    if (!f->step.neighbours->has_torsos)
        return;
    if (!f->contacts->known || f->options.literal ||
        !(pairs->count || walls->count || f->contacts->touches.count)) {
        float *const columns[] = {a->borne_x, a->borne_y, a->parted_x, a->parted_y, a->parted_spin};
        for (size_t k = 0; k < sizeof columns / sizeof *columns; k++)
            jox_mem_fill(columns[k], 0, a->count * sizeof *columns[k]);
        return;
    }
    jox_parallel_for(f->step.pool, pairs->count, PAIR_GRAIN, start_bearing_pairs, f);
    for (uint32_t k = 0; k < walls->count; k++) {
        walls->items[k].impulse = walls->items[k].borne;
        walls->items[k].slip = 0.0f;
    }
    jox_touches_start_bearing(f);
    jox_parallel_for(f->step.pool, a->count, JOX_FORCE_GRAIN, start_bearing, f);
    apply_impulses(f, false);
    solve_bearing(f);
    jox_parallel_for(f->step.pool, a->count, JOX_FORCE_GRAIN, write_borne, f);
    if (end_bearing(f)) {
        apply_impulses(f, true);
        solve_bearing(f);
    }
    jox_parallel_for(f->step.pool, a->count, JOX_FORCE_GRAIN, write_parted, f);
    jox_contacts_keep_plans(f);
}
