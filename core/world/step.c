/* The step: nine stages, each one function of a lower floor.

   People plan the velocity that they will have PLAN seconds later: the linear program, the velocity
   that a force gives (equation 11) and the parting of overlaps look that far ahead, and within a
   shorter step velocities go the corresponding part of the way. A longer step is done in parts. So
   the size of the step is not a property of people, and what they do hardly depends on it. As
   printed, everything happens within one step of whatever length: with `literal` it does here. */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "world/world.h"

static const double PLAN = 0.05; /* s */

static bool is_first(const JoWorld *w) {
    return w->scratch.part == 0;
}

static bool is_last(const JoWorld *w) {
    return w->scratch.part + 1 == w->scratch.parts;
}

static void perceive(JoWorld *w) {
    if (is_first(w)) {
        jox_nav_sort(w->scratch.nav, &w->state.agents, w->state.tick);
        if (w->state.agents.count)
            memset(w->state.agents.failed, 0, w->state.agents.count);
    }
    jox_nav_perceive(w->scratch.nav, &w->state.agents, &w->scratch.neighbours, w->scratch.pool);
    jox_bodies_objects(w->state.bodies, &w->scratch.objects);
}

static void think(JoWorld *w) {
    JoxMachineRun *machines = &w->machines;
    if (!is_first(w))
        return;
    machines->neighbours = &w->scratch.neighbours;
    machines->objects = &w->scratch.objects;
    machines->places = w->model.places;
    machines->place_count = w->model.place_count;
    machines->tick = (uint32_t)w->state.tick;
    machines->inputs = w->state.input.present;
    machines->input_count = w->state.input.present_count;
    jox_world_routes(w);
    jox_machines_think(machines, w->scratch.pool);
    w->state.statistics.transitions += machines->taken_count;
    w->state.statistics.kicks += machines->kick_count;
}

static void prefer(JoWorld *w) {
    jox_machines_prefer(&w->machines, w->scratch.pool);
}

static void push(JoWorld *w) {
    const JoxMachineRun *machines = &w->machines;
    JoxForceStep step = {.agents = &w->state.agents,
                         .neighbours = &w->scratch.neighbours,
                         .objects = &w->scratch.objects,
                         .pool = w->scratch.pool,
                         .dt = w->scratch.part_dt,
                         .plan = w->scratch.plan,
                         .push_on = machines->push_on,
                         .push_nearest = machines->push_nearest,
                         .push_toward_x = machines->push_toward_x,
                         .push_toward_y = machines->push_toward_y};
    jox_force_begin(w->scratch.forces, &step);
    if (w->model.def.forces) {
        jox_force_push(w->scratch.forces);
        jox_force_contact(w->scratch.forces);
    }
    jox_force_sum(w->scratch.forces);
    if (w->scratch.inspection.count)
        jox_inspect_pushed(w);
    for (uint32_t i = 0; is_last(w) && i < w->state.agents.count;
         i++) /* given for this step alone */
        w->state.agents.ext_x[i] = w->state.agents.ext_y[i] = 0.0f;
}

static void solve(JoWorld *w) {
    w->state.statistics.walls_relaxed +=
        jox_nav_solve(w->scratch.nav, &w->state.agents, &w->scratch.neighbours, &w->scratch.objects,
                      w->scratch.plan, w->scratch.pool);
    if (w->scratch.inspection.count)
        jox_inspect_solved(w);
}

static void move(JoWorld *w) {
    JoxAgents *a = &w->state.agents;
    jox_nav_move(w->scratch.nav, a, &w->scratch.neighbours, w->scratch.part_dt, w->scratch.plan,
                 w->scratch.pool);
    for (uint32_t i = 0; w->scratch.parts > 1 && i < a->count; i++) {
        JoxV2 way = {a->x[i] - a->prev_x[i], a->y[i] - a->prev_y[i]};
        w->scratch.walked[i] = is_first(w) ? way : jox_add(w->scratch.walked[i], way);
    }
}

/* People as fast bodies meet them, in ascending id: where they were and how they moved. */
static uint32_t list_discs(JoWorld *w) {
    const JoxAgents *a = &w->state.agents;
    if (a->count > w->scratch.disc_capacity) {
        w->scratch.disc_capacity = a->count + a->count / 4 + 16;
        w->scratch.discs =
            jox_realloc(w->scratch.discs, w->scratch.disc_capacity, sizeof *w->scratch.discs);
        w->scratch.disc_agents = jox_realloc(w->scratch.disc_agents, w->scratch.disc_capacity,
                                             sizeof *w->scratch.disc_agents);
    }
    jox_agents_by_id(a, w->scratch.disc_agents);
    for (uint32_t n = 0; n < a->count; n++) {
        uint32_t i = w->scratch.disc_agents[n];
        w->scratch.discs[n] = (JoxDisc){.id = a->id[i],
                                        .x = a->prev_x[i],
                                        .y = a->prev_y[i],
                                        .move_x = a->x[i] - a->prev_x[i],
                                        .move_y = a->y[i] - a->prev_y[i],
                                        .radius = a->param[JOX_PARAM_radius][i],
                                        .mass = a->param[JOX_PARAM_mass][i],
                                        .vx = a->vx[i],
                                        .vy = a->vy[i]};
    }
    return a->count;
}

/* What fast bodies did to people: a change of velocity now, a contact force in the columns. */
static void take_hits(JoWorld *w, const JoxBodiesReport *report) {
    JoxAgents *a = &w->state.agents;
    for (uint32_t h = 0; h < report->hit_count; h++) {
        const JoxDiscHit *hit = &report->hits[h];
        uint32_t i = w->scratch.disc_agents[hit->disc];
        float mass = a->param[JOX_PARAM_mass][i], dt = (float)w->scratch.part_dt;
        a->vx[i] += hit->impulse.x / mass;
        a->vy[i] += hit->impulse.y / mass;
        a->force_x[i] += hit->impulse.x / dt;
        a->force_y[i] += hit->impulse.y / dt;
        a->compression[i] +=
            jox_length(hit->impulse) / dt / (6.2831853f * a->param[JOX_PARAM_radius][i]);
        a->contacts[i] += a->contacts[i] < 255;
    }
    w->state.statistics.hits += report->hit_count;
}

/* People's pushes and contacts, and whether contacts give bodies what they take from people. */
static void give_impulses(JoWorld *w, const JoxImpulse *impulses, uint32_t count) {
    JoxExchange *exchange = &w->state.statistics.exchange;
    JoxForceTotals totals = jox_force_totals(w->scratch.forces);
    double before[3], after[3];
    if (count == 0)
        return;
    jox_bodies_momentum(w->state.bodies, before);
    jox_bodies_impulses(w->state.bodies, impulses, count);
    jox_bodies_momentum(w->state.bodies, after);
    double x = totals.touched_x + (after[0] - before[0] - totals.pushed_x);
    double y = totals.touched_y + (after[1] - before[1] - totals.pushed_y);
    exchange->contacts += totals.touches;
    exchange->impulse += totals.touched;
    exchange->residual += sqrt(x * x + y * y);
}

static void bodies(JoWorld *w) {
    if (jox_bodies_count(w->state.bodies) == 0)
        return;
    if (is_first(w))
        jox_world_carry(w);
    jox_world_pull(w);
    uint32_t count;
    const JoxImpulse *impulses = jox_force_impulses(w->scratch.forces, &count);
    if (!w->state.statistics.bonds.touched)
        jox_world_note_touch(w);
    give_impulses(w, impulses, count);
    if (is_first(w))
        jox_bodies_impulses(w->state.bodies, w->machines.kicks, w->machines.kick_count);
    bool fast =
        w->model.def.forces && jox_bodies_any_fast(w->state.bodies, (float)w->scratch.part_dt);
    uint32_t discs = fast ? list_discs(w) : 0;
    JoxBodiesReport report = jox_bodies_step(w->state.bodies, (float)w->scratch.part_dt,
                                             fast ? w->scratch.discs : NULL, discs);
    take_hits(w, &report);
    w->state.statistics.exchange.contacts += report.hit_count;
    w->state.statistics.exchange.impulse += report.hit_impulse;
    w->state.statistics.exchange.residual += report.hit_residual;
    jox_world_note_breaks(w, &report);
    w->state.statistics.bodies_lost += report.gone_count;
}

static void infer(JoWorld *w) {
    if (w->model.def.forces)
        jox_force_infer(w->scratch.forces);
    if (w->scratch.inspection.count)
        jox_inspect_inferred(w);
}

static void observe(JoWorld *w) {
    JoxAgents *a = &w->state.agents;
    if (!is_last(w))
        return;
    for (uint32_t i = 0; w->scratch.parts > 1 && i < a->count;
         i++) { /* where the whole step began */
        a->prev_x[i] = a->x[i] - w->scratch.walked[i].x;
        a->prev_y[i] = a->y[i] - w->scratch.walked[i].y;
    }
    jox_statistics_observe(&w->state.statistics, a, &w->scratch.neighbours, w->state.tick,
                           w->model.def.dt);
    for (uint32_t i = 0; i < a->count; i++) {
        if (!a->removed[i])
            continue;
        JOX_RESERVE(w->scratch.gone, w->scratch.gone_capacity, w->scratch.gone_count + 1);
        w->scratch.gone[w->scratch.gone_count++] = (JoxV2){a->x[i], a->y[i]};
    }
    w->state.statistics.removed += jox_agents_compact(a);
}

/* Into how many parts the step is cut. */
static void divide(JoWorld *w) {
    double dt = w->model.def.dt;
    w->scratch.parts = w->model.def.literal || dt <= PLAN ? 1 : (uint32_t)ceil(dt / PLAN - 1e-6);
    w->scratch.part_dt = dt / w->scratch.parts;
    w->scratch.plan = w->model.def.literal ? dt : PLAN;
    if (w->scratch.parts > 1)
        JOX_RESERVE(w->scratch.walked, w->scratch.walked_capacity, w->state.agents.count);
}

bool jox_world_step(JoWorld *w) {
    static void (*const STAGES[JO_STAGE_COUNT])(JoWorld *) = {
        perceive, think, prefer, push, solve, move, bodies, infer, observe};
    if (w->failure[0])
        return false;
    jox_world_events(w);
    jox_world_sources(w);
    double begin = jox_clock_wall(), cpu = jox_clock_cpu(), last = begin;
    jox_world_resolve_placement(w);
    if (w->state.tick % JOX_BODIES_REINSERT_STEPS ==
        0) /* a state saved before this step goes on alike */
        jox_bodies_reinsert(w->state.bodies);
    jox_inspect_expire(w);
    divide(w);
    w->scratch.gone_count = 0;
    bool good = true;
    for (w->scratch.part = 0; w->scratch.part < w->scratch.parts && good; w->scratch.part++) {
        for (int stage = 0; stage < JO_STAGE_COUNT; stage++) {
            STAGES[stage](w);
            double now = jox_clock_wall();
            w->state.statistics.stage_s[stage] += now - last;
            last = now;
        }
        good = jox_world_is_finite(w);
    }
    w->state.tick++;
    w->state.statistics.wall_s += last - begin;
    w->state.statistics.cpu_s += jox_clock_cpu() - cpu;
    if (good)
        jox_world_exits(w);
    return good;
}
