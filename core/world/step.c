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
    return w->part == 0;
}

static bool is_last(const JoWorld *w) {
    return w->part + 1 == w->parts;
}

static void perceive(JoWorld *w) {
    if (is_first(w)) {
        jox_nav_sort(w->nav, &w->agents, w->tick);
        if (w->agents.count)
            memset(w->agents.failed, 0, w->agents.count);
    }
    jox_nav_perceive(w->nav, &w->agents, &w->neighbours, w->pool);
    jox_bodies_objects(w->bodies, &w->objects);
}

static void think(JoWorld *w) {
    JoxMind *mind = &w->mind;
    if (!is_first(w))
        return;
    mind->neighbours = &w->neighbours;
    mind->objects = &w->objects;
    mind->places = w->places;
    mind->place_count = w->place_count;
    mind->tick = (uint32_t)w->tick;
    mind->inputs = w->input.present;
    mind->input_count = w->input.present_count;
    jox_world_ways(w);
    jox_mind_think(mind, w->pool);
    w->statistics.transitions += mind->taken_count;
    w->statistics.kicks += mind->kick_count;
}

static void prefer(JoWorld *w) {
    jox_mind_prefer(&w->mind, w->pool);
}

static void push(JoWorld *w) {
    const JoxMind *mind = &w->mind;
    JoxForceStep step = {.agents = &w->agents,
                         .neighbours = &w->neighbours,
                         .objects = &w->objects,
                         .pool = w->pool,
                         .dt = w->part_dt,
                         .plan = w->plan,
                         .push_on = mind->push_on,
                         .push_nearest = mind->push_nearest,
                         .push_toward_x = mind->push_toward_x,
                         .push_toward_y = mind->push_toward_y};
    jox_force_begin(w->forces, &step);
    if (w->def.forces) {
        jox_force_push(w->forces);
        jox_force_contact(w->forces);
    }
    jox_force_sum(w->forces);
    if (w->inspection.count)
        jox_inspect_pushed(w);
    for (uint32_t i = 0; is_last(w) && i < w->agents.count; i++) /* given for this step alone */
        w->agents.ext_x[i] = w->agents.ext_y[i] = 0.0f;
}

static void solve(JoWorld *w) {
    w->statistics.walls_relaxed +=
        jox_nav_solve(w->nav, &w->agents, &w->neighbours, &w->objects, w->plan, w->pool);
    if (w->inspection.count)
        jox_inspect_solved(w);
}

static void move(JoWorld *w) {
    JoxAgents *a = &w->agents;
    jox_nav_move(w->nav, a, &w->neighbours, w->part_dt, w->plan, w->pool);
    for (uint32_t i = 0; w->parts > 1 && i < a->count; i++) {
        JoxV2 way = {a->x[i] - a->prev_x[i], a->y[i] - a->prev_y[i]};
        w->walked[i] = is_first(w) ? way : jox_add(w->walked[i], way);
    }
}

/* People as fast bodies meet them, in ascending id: where they were and how they moved. */
static uint32_t list_discs(JoWorld *w) {
    const JoxAgents *a = &w->agents;
    if (a->count > w->disc_capacity) {
        w->disc_capacity = a->count + a->count / 4 + 16;
        w->discs = jox_realloc(w->discs, w->disc_capacity, sizeof *w->discs);
        w->disc_agents = jox_realloc(w->disc_agents, w->disc_capacity, sizeof *w->disc_agents);
    }
    jox_agents_by_id(a, w->disc_agents);
    for (uint32_t n = 0; n < a->count; n++) {
        uint32_t i = w->disc_agents[n];
        w->discs[n] = (JoxDisc){.id = a->id[i],
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
    JoxAgents *a = &w->agents;
    for (uint32_t h = 0; h < report->hit_count; h++) {
        const JoxDiscHit *hit = &report->hits[h];
        uint32_t i = w->disc_agents[hit->disc];
        float mass = a->param[JOX_PARAM_mass][i], dt = (float)w->part_dt;
        a->vx[i] += hit->impulse.x / mass;
        a->vy[i] += hit->impulse.y / mass;
        a->force_x[i] += hit->impulse.x / dt;
        a->force_y[i] += hit->impulse.y / dt;
        a->compression[i] +=
            jox_length(hit->impulse) / dt / (6.2831853f * a->param[JOX_PARAM_radius][i]);
        a->contacts[i] += a->contacts[i] < 255;
    }
    w->statistics.hits += report->hit_count;
}

/* People's pushes and contacts, and whether contacts give bodies what they take from people. */
static void give_impulses(JoWorld *w, const JoxImpulse *impulses, uint32_t count) {
    JoxExchange *exchange = &w->statistics.exchange;
    JoxForceTotals totals = jox_force_totals(w->forces);
    double before[3], after[3];
    if (count == 0)
        return;
    jox_bodies_momentum(w->bodies, before);
    jox_bodies_impulses(w->bodies, impulses, count);
    jox_bodies_momentum(w->bodies, after);
    double x = totals.touched_x + (after[0] - before[0] - totals.pushed_x);
    double y = totals.touched_y + (after[1] - before[1] - totals.pushed_y);
    exchange->contacts += totals.touches;
    exchange->impulse += totals.touched;
    exchange->residual += sqrt(x * x + y * y);
}

static void bodies(JoWorld *w) {
    if (jox_bodies_count(w->bodies) == 0)
        return;
    if (is_first(w))
        jox_world_carry(w);
    jox_world_pull(w);
    uint32_t count;
    const JoxImpulse *impulses = jox_force_impulses(w->forces, &count);
    if (!w->statistics.bonds.touched)
        jox_world_note_touch(w);
    give_impulses(w, impulses, count);
    if (is_first(w))
        jox_bodies_impulses(w->bodies, w->mind.kicks, w->mind.kick_count);
    bool fast = w->def.forces && jox_bodies_any_fast(w->bodies, (float)w->part_dt);
    uint32_t discs = fast ? list_discs(w) : 0;
    JoxBodiesReport report =
        jox_bodies_step(w->bodies, (float)w->part_dt, fast ? w->discs : NULL, discs);
    take_hits(w, &report);
    w->statistics.exchange.contacts += report.hit_count;
    w->statistics.exchange.impulse += report.hit_impulse;
    w->statistics.exchange.residual += report.hit_residual;
    jox_world_note_breaks(w, &report);
    w->statistics.bodies_lost += report.gone_count;
}

static void infer(JoWorld *w) {
    if (w->def.forces)
        jox_force_infer(w->forces);
    if (w->inspection.count)
        jox_inspect_inferred(w);
}

static void observe(JoWorld *w) {
    JoxAgents *a = &w->agents;
    if (!is_last(w))
        return;
    for (uint32_t i = 0; w->parts > 1 && i < a->count; i++) { /* where the whole step began */
        a->prev_x[i] = a->x[i] - w->walked[i].x;
        a->prev_y[i] = a->y[i] - w->walked[i].y;
    }
    jox_statistics_observe(&w->statistics, a, &w->neighbours, w->tick, w->def.dt);
    for (uint32_t i = 0; i < a->count; i++) {
        if (!a->removed[i])
            continue;
        JOX_RESERVE(w->gone, w->gone_capacity, w->gone_count + 1);
        w->gone[w->gone_count++] = (JoxV2){a->x[i], a->y[i]};
    }
    w->statistics.removed += jox_agents_compact(a);
}

/* Into how many parts the step is cut. */
static void divide(JoWorld *w) {
    double dt = w->def.dt;
    w->parts = w->def.literal || dt <= PLAN ? 1 : (uint32_t)ceil(dt / PLAN - 1e-6);
    w->part_dt = dt / w->parts;
    w->plan = w->def.literal ? dt : PLAN;
    if (w->parts > 1)
        JOX_RESERVE(w->walked, w->walked_capacity, w->agents.count);
}

bool jox_world_step(JoWorld *w) {
    static void (*const STAGES[JO_STAGE_COUNT])(JoWorld *) = {
        perceive, think, prefer, push, solve, move, bodies, infer, observe};
    if (w->failure[0])
        return false;
    double begin = jox_clock_wall(), cpu = jox_clock_cpu(), last = begin;
    jox_world_resolve_placement(w);
    if (w->tick % JOX_BODIES_REINSERT_STEPS == 0) /* a state saved before this step goes on alike */
        jox_bodies_reinsert(w->bodies);
    jox_inspect_expire(w);
    divide(w);
    w->gone_count = 0;
    bool good = true;
    for (w->part = 0; w->part < w->parts && good; w->part++) {
        for (int stage = 0; stage < JO_STAGE_COUNT; stage++) {
            STAGES[stage](w);
            double now = jox_clock_wall();
            w->statistics.stage_s[stage] += now - last;
            last = now;
        }
        good = jox_world_is_finite(w);
    }
    w->tick++;
    w->statistics.wall_s += last - begin;
    w->statistics.cpu_s += jox_clock_cpu() - cpu;
    return good;
}
