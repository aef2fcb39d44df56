/* One step of a world: calls the nine stages (stages.h), and what runs before and after them.

   Forces change velocities at once. Agents that walk also plan a velocity about each PLANNING_TIME
   and approach it with the time constant RESPONSE_TIME, so that what they do and bear hardly
   depends on the length of the step. A step longer than PLANNING_TIME is divided into substeps. The
   paper as printed does everything within one step of any length; `literal` does so here. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "world/turn_chests.h"
#include "world/world.h"

static const double PLANNING_TIME = 0.05; /* s: between plans of an agent that walks */
static const double RESPONSE_TIME = 0.05; /* s: after it 63 % of the change to the plan is made */

static void run_perceive(JoWorld *w, const JoxSubstep *substep) {
    jox_stage_perceive(&(JoxPerceiveStage){.substep = substep,
                                           .tick = w->state.tick,
                                           .timed = w->scratch.timed,
                                           .pool = w->scratch.pool,
                                           .bodies = w->state.bodies,
                                           .nav = w->scratch.nav,
                                           .agents = &w->state.agents,
                                           .neighbours = &w->scratch.neighbours,
                                           .objects = &w->scratch.objects,
                                           .statistics = &w->state.statistics});
}

JoxRouteStage jox_world_route_stage(JoWorld *w) {
    return (JoxRouteStage){.places = w->model.places,
                           .place_count = w->model.place_count,
                           .all_walls = &w->model.all_walls,
                           .walls_version = w->state.walls_version,
                           .agents = &w->state.agents,
                           .objects = &w->scratch.objects,
                           .tick = w->state.tick,
                           .dt = w->model.def.dt,
                           .crowd_slowing = w->model.walking.crowd_slowing,
                           .isa = w->model.def.isa,
                           .pool = w->scratch.pool,
                           .machines = &w->machines,
                           .routes = w->state.routes};
}

static void run_think(JoWorld *w, const JoxSubstep *substep) {
    const JoxRouteStage route = jox_world_route_stage(w);
    JoxMachineRun *machines = &w->machines;
    machines->neighbours = &w->scratch.neighbours;
    machines->objects = &w->scratch.objects;
    machines->places = w->model.places;
    machines->place_count = w->model.place_count;
    machines->walls_version = w->state.walls_version;
    machines->tick = (uint32_t)w->state.tick;
    machines->inputs = w->state.input.present;
    machines->input_count = w->state.input.present_count;
    jox_stage_think(&(JoxThinkStage){.substep = substep,
                                     .pool = w->scratch.pool,
                                     .route = &route,
                                     .machines = machines,
                                     .statistics = &w->state.statistics});
    if (machines->notes.length) {
        jox_text_append(&w->scratch.messages, machines->notes.data, machines->notes.length);
        machines->notes.length = 0;
    }
}

static void run_prefer(JoWorld *w, const JoxSubstep *substep) {
    jox_stage_prefer(&(JoxPreferStage){.substep = substep,
                                       .literal = w->model.def.literal,
                                       .nav = w->scratch.nav,
                                       .machines = &w->machines,
                                       .statistics = &w->state.statistics});
}

static void run_push(JoWorld *w, const JoxSubstep *substep) {
    jox_stage_push(&(JoxPushStage){.substep = substep,
                                   .forces = w->model.def.forces,
                                   .literal = w->model.def.literal,
                                   .nav = w->scratch.nav,
                                   .machines = &w->machines,
                                   .forces_of = w->scratch.forces,
                                   .inspection = &w->scratch.inspection});
}

static void run_solve(JoWorld *w, const JoxSubstep *substep) {
    jox_stage_solve(&(JoxSolveStage){.substep = substep,
                                     .forces_of = w->scratch.forces,
                                     .nav = w->scratch.nav,
                                     .inspection = &w->scratch.inspection,
                                     .statistics = &w->state.statistics});
}

static void run_move(JoWorld *w, const JoxSubstep *substep) {
    jox_stage_move(
        &(JoxMoveStage){.substep = substep, .nav = w->scratch.nav, .walked = w->scratch.walked});
}

static void run_bodies(JoWorld *w, const JoxSubstep *substep) {
    JoxBodyGone lost = {.row = JOX_NO_BODY};
    JoxDriveLoad overload = {.row = JOX_NO_BODY};
    jox_stage_bodies(&(JoxBodyStage){.substep = substep,
                                     .forces = w->model.def.forces,
                                     .gravity = w->model.def.gravity,
                                     .neighbours = &w->scratch.neighbours,
                                     .objects = &w->scratch.objects,
                                     .machines = &w->machines,
                                     .forces_of = w->scratch.forces,
                                     .discs = &w->scratch.discs,
                                     .hands = &w->scratch.hands,
                                     .agents = &w->state.agents,
                                     .bodies = w->state.bodies,
                                     .drags = &w->state.drags,
                                     .statistics = &w->state.statistics,
                                     .lost = &lost,
                                     .overload = &overload,
                                     .step_events = &w->scratch.step_events});
    if (lost.row != JOX_NO_BODY)
        jox_world_report_lost_body(w, &lost);
    if (overload.row != JOX_NO_BODY)
        jox_world_end_overloaded(w, &overload);
}

static void run_infer(JoWorld *w, const JoxSubstep *substep) {
    (void)substep;
    jox_stage_infer(&(JoxInferStage){.forces = w->model.def.forces,
                                     .forces_of = w->scratch.forces,
                                     .agents = &w->state.agents,
                                     .inspection = &w->scratch.inspection});
}

static void run_observe(JoWorld *w, const JoxSubstep *substep) {
    if (jox_falls_matter(&w->state.agents, w->model.def.literal))
        jox_falls_step(&w->scratch.falls, &substep->step, w->scratch.forces, &w->state.statistics);
    jox_stage_observe(&(JoxObserveStage){.substep = substep,
                                         .tick = w->state.tick,
                                         .dt = w->model.def.dt,
                                         .neighbours = &w->scratch.neighbours,
                                         .walked = w->scratch.walked,
                                         .agents = &w->state.agents,
                                         .departures = &w->scratch.departures,
                                         .statistics = &w->state.statistics});
}

/* Returns into how many substeps a step is divided. */
static uint32_t count_substeps(const JoWorldDef *def) {
    return def->literal || def->dt <= PLANNING_TIME
               ? 1
               : (uint32_t)ceil(def->dt / PLANNING_TIME - 1e-6);
}

double jox_world_substep_length(const JoWorld *w) {
    return w->model.def.dt / count_substeps(&w->model.def);
}

static uint32_t prepare_substeps(JoWorld *w) {
    double dt = w->model.def.dt;
    const uint32_t substeps = count_substeps(&w->model.def);
    if (substeps > 1)
        JOX_RESERVE(w->scratch.walked, w->scratch.walked_capacity, w->state.agents.count);
    JOX_ASSERT(substeps > 0 && (w->model.def.literal || dt / substeps <= PLANNING_TIME + 1e-6));
    return substeps;
}

/* Returns for how long, s, a force would have to act at the beginning of so many steps to have the
   same effect at their end as it has when it acts in each of them. */
static double compute_forced_time(double dt, uint32_t steps) {
    double kept = jox_exp(-dt / RESPONSE_TIME), time = 0.0;
    for (uint32_t k = 0; k < steps; k++)
        time = time / kept + dt;
    return time;
}

/* Returns the times that all substeps of this length have in common, and how many substeps there
   are from plan to plan. */
static JoxTiming find_timing(const JoWorldDef *def, double dt, uint32_t *plan_every) {
    const double every = PLANNING_TIME / dt + 0.5;
    *plan_every = def->literal || every < 2.0 ? 1 : (uint32_t)every;
    if (def->literal)
        return jox_timing_at_once(dt);
    const double response = 1.0 - jox_exp(-dt / RESPONSE_TIME);
    return (JoxTiming){.dt = dt,
                       .planning_time = PLANNING_TIME,
                       .response = response,
                       .on_the_way = 1.0 - response * RESPONSE_TIME / dt,
                       .interval = dt * *plan_every,
                       .interval_forced = compute_forced_time(dt, *plan_every),
                       .interval_response = 1.0 - jox_exp(-dt * *plan_every / RESPONSE_TIME)};
}

/* Fills the substep of that number. */
static const JoxSubstep *begin_substep(JoWorld *w, uint32_t number, uint32_t substeps) {
    const JoWorldDef *def = &w->model.def;
    const double dt = def->dt / substeps;
    JoxSubstep *s = &w->scratch.substep;
    JoxTiming timing = s->step.timing;
    if (timing.dt != dt)
        timing = find_timing(def, dt, &s->plan_every);
    s->first = number == 0;
    s->last = number + 1 == substeps;
    s->only = substeps == 1;
    s->fallen = jox_falls_lies_any(&w->state.agents);
    s->end = (double)w->state.tick * def->dt + (number + 1) * dt;
    timing.seed = def->seed;
    timing.time = s->end - dt;
    timing.plans = w->state.tick % s->plan_every == 0;
    s->step = (JoxStep){.timing = timing,
                        .agents = &w->state.agents,
                        .neighbours = &w->scratch.neighbours,
                        .objects = &w->scratch.objects,
                        .touched = jox_force_contact_planes(w->scratch.forces),
                        .pool = w->scratch.pool};
    return s;
}

bool jox_world_step(JoWorld *w) {
    static void (*const STAGES[JO_STAGE_COUNT])(JoWorld *, const JoxSubstep *) = {
        [JOX_STAGE_PERCEIVE] = run_perceive, [JOX_STAGE_THINK] = run_think,
        [JOX_STAGE_PREFER] = run_prefer,     [JOX_STAGE_PUSH] = run_push,
        [JOX_STAGE_SOLVE] = run_solve,       [JOX_STAGE_MOVE] = run_move,
        [JOX_STAGE_BODIES] = run_bodies,     [JOX_STAGE_INFER] = run_infer,
        [JOX_STAGE_OBSERVE] = run_observe};
    if (w->failure[0])
        return false;
    const bool timed = w->scratch.timed || jox_pool_threads(w->scratch.pool) > 1;
    const double entered = timed ? jox_clock_wall() : 0.0;
    jox_world_run_events(w);
    jox_world_run_lifts(w);
    jox_world_settle_walls(w);
    const uint32_t before = w->state.agents.count;
    jox_world_run_sources(w);
    jox_world_spawn_due_starts(w);
    jox_world_turn_newcomers(w, before);
    jox_nav_end_births(w->scratch.nav);
    JOX_CHECK(jox_world_check_model(w));
    JOX_CHECK(jox_world_check_agents(w));
    const double begin = timed ? jox_clock_wall() : 0.0, cpu = timed ? jox_clock_cpu() : 0.0;
    double last = begin;
    w->state.statistics.enter_s += begin - entered;
    if (w->model.reinserts_bodies &&
        w->state.tick % JOX_BODIES_REINSERT_STEPS == 0) /* a state saved now continues exactly */
        jox_bodies_reinsert(w->state.bodies);
    jox_inspect_end_old(w);
    w->scratch.departures.count = 0;
    jox_step_events_clear(&w->scratch.step_events);
    bool good = true;
    const uint32_t substeps = prepare_substeps(w);
    for (uint32_t number = 0; number < substeps && good; number++) {
        const JoxSubstep *substep = begin_substep(w, number, substeps);
        for (int stage = 0; stage < JO_STAGE_COUNT; stage++) {
            if (stage == JOX_STAGE_OBSERVE && !jox_world_guard_numbers(w)) {
                good = false;
                break;
            }
            STAGES[stage](w, substep);
            if (!timed)
                continue;
            const double now = jox_clock_wall();
            w->state.statistics.stage_s[stage] += now - last;
            last = now;
        }
    }
    w->state.tick++;
    w->state.statistics.wall_s += last - begin;
    jox_pool_note_duration(w->scratch.pool, last - begin);
    w->state.statistics.cpu_s += timed ? jox_clock_cpu() - cpu : 0.0;
    if (!good)
        return false;
    jox_world_remove_lost(w);
    jox_world_empty_sinks(w);
    w->state.statistics.leave_s += timed ? jox_clock_wall() - last : 0.0;
    JOX_CHECK(jox_world_check_agents(w));
    JOX_CHECK(jox_world_check_lists(w));
    return true;
}
