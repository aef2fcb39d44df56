/* The stages of a step, each a function over its context. */
#include "world/stages.h"

#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "world/falls.h"

/* Checks that a substep is the only one if and only if it is the first and the last. */
static void check_substep(const JoxSubstep *s) {
    JOX_ASSERT(s->only == (s->first && s->last));
    JOX_ASSERT(s->step.timing.dt > 0.0 && s->step.timing.planning_time > 0.0 && s->end > 0.0);
}

void jox_stage_perceive(const JoxPerceiveStage *s) {
    JOX_CHECK(check_substep(s->substep));
    if (s->substep->first) {
        jox_nav_sort(s->nav, s->agents, s->tick);
        jox_mem_fill(s->agents->failed, 0, s->agents->count);
        jox_mem_fill(s->agents->plan_notes, 0, s->agents->count);
    }
    jox_nav_perceive(s->nav, s->agents, s->neighbours, s->pool);
    const double begun = s->timed ? jox_clock_wall() : 0.0;
    jox_bodies_objects(s->bodies, s->objects);
    jox_objects_lay(s->objects);
    s->statistics->objects_s += s->timed ? jox_clock_wall() - begun : 0.0;
    JOX_ASSERT(s->objects->count == jox_bodies_rows(s->bodies));
    JOX_ASSERT(s->neighbours->agents >= s->agents->count);
}

void jox_stage_think(const JoxThinkStage *s) {
    if (!s->substep->first)
        return;
    jox_routes_update(s->route);
    jox_machines_think(s->machines, s->pool);
    JOX_ASSERT(s->machines->taken_count <= s->machines->agents->count);
    JOX_ASSERT(s->machines->kick_count <= s->machines->agents->count);
    s->statistics->transitions += s->machines->taken_count;
    s->statistics->kicks += s->machines->kick_count;
}

void jox_stage_prefer(const JoxPreferStage *s) {
    const JoxStep *step = &s->substep->step;
    jox_machines_prefer(s->machines, step->pool);
    if (s->substep->fallen)
        jox_falls_hold(step->agents);
    if (s->machines->without_spot > s->statistics->most_without_spot)
        s->statistics->most_without_spot = s->machines->without_spot;
    if (s->machines->without_way > s->statistics->most_without_way)
        s->statistics->most_without_way = s->machines->without_way;
    if (!s->literal)
        jox_nav_walk(s->nav, step);
}

/* Keeps the external force of the substep in `last`, for its moves and for display; zeroes the
   force, which is given for one step, in the `final` substep. */
static void use_up_external(float *ext, float *last, uint32_t count, bool final) {
    const size_t size = count * sizeof *ext;
    if (size && memcmp(last, ext, size) != 0)
        memcpy(last, ext, size);
    if (final)
        jox_mem_fill(ext, 0, size);
}

void jox_stage_push(const JoxPushStage *s) {
    const JoxStep *step = &s->substep->step;
    JoxAgents *a = step->agents;
    const JoxForceInputs inputs = {
        .walls = jox_nav_touching_walls(s->nav, step, jox_force_passing_reach(s->forces_of)),
        .unhidden2 = jox_nav_unhidden2(s->nav),
        .push_on = s->machines->push_on,
        .push_nearest = s->machines->push_nearest,
        .push_toward_x = s->machines->push_toward_x,
        .push_toward_y = s->machines->push_toward_y};
    jox_force_begin(s->forces_of, step, &inputs);
    if (s->forces) {
        jox_force_push(s->forces_of);
        jox_force_contact(s->forces_of);
    }
    jox_force_sum(s->forces_of);
    jox_inspect_after_push(s->inspection, a, s->forces_of);
    use_up_external(a->ext_x, a->last_ext_x, a->count, s->substep->last);
    use_up_external(a->ext_y, a->last_ext_y, a->count, s->substep->last);
}

void jox_stage_solve(const JoxSolveStage *s) {
    const JoxStep *step = &s->substep->step;
    JoxForceTotals totals = jox_force_totals(s->forces_of);
    jox_mem_fill(step->agents->index_drop, 0,
                 step->agents->count * sizeof *step->agents->index_drop);
    s->statistics->contact_passes += totals.passes;
    if (totals.residual > s->statistics->contact_residual)
        s->statistics->contact_residual = (double)totals.residual;
    s->statistics->walls_relaxed += jox_nav_solve(s->nav, step);
    if (s->substep->fallen)
        jox_falls_plan(step->agents);
    jox_force_bear(s->forces_of);
    jox_inspect_after_solve(s->inspection, s->nav, step);
}

void jox_stage_move(const JoxMoveStage *s) {
    const JoxAgents *a = s->substep->step.agents;
    JOX_ASSERT(s->substep->only || a->count == 0 || s->walked);
    jox_nav_move(s->nav, &s->substep->step);
    for (uint32_t i = 0; !s->substep->only && i < a->count; i++) {
        JoxV2 way = {a->x[i] - a->prev_x[i], a->y[i] - a->prev_y[i]};
        s->walked[i] = s->substep->first ? way : jox_add(s->walked[i], way);
    }
}

void jox_stage_bodies(const JoxBodyStage *s) {
    if (jox_bodies_count(s->bodies) == 0)
        return;
    if (s->substep->first)
        jox_bodies_reset_impulse_sums(s->bodies);
    jox_stage_carry_bodies(s);
    jox_stage_drag_bodies(s);
    if (!s->statistics->bonds.touched)
        jox_stage_note_bond_touch(s);
    JoxBodiesReport report = jox_stage_step_bodies(s);
    jox_stage_note_bond_breaks(s, &report);
    jox_step_events_add_bodies(s->step_events, &report, s->discs->discs);
    s->statistics->bodies_lost += report.gone_count;
    s->statistics->bullet_s += report.bullet_s;
    if (report.gone_count)
        *s->lost = report.gone[0];
}

void jox_stage_infer(const JoxInferStage *s) {
    if (s->forces)
        jox_force_infer(s->forces_of);
    jox_inspect_after_infer(s->inspection, s->agents, s->forces_of);
}

void jox_stage_observe(const JoxObserveStage *s) {
    JoxAgents *a = s->agents;
    if (!s->substep->last)
        return;
    for (uint32_t i = 0; !s->substep->only && i < a->count;
         i++) { /* position at the start of the whole step */
        a->prev_x[i] = a->x[i] - s->walked[i].x;
        a->prev_y[i] = a->y[i] - s->walked[i].y;
    }
    jox_statistics_observe(s->statistics, a, s->neighbours, s->tick, s->dt);
    for (uint32_t i = 0; i < a->count; i++) {
        if (!a->removed[i])
            continue;
        JOX_RESERVE(s->departures->items, s->departures->capacity, s->departures->count + 1);
        s->departures->items[s->departures->count++] = (JoxV2){a->x[i], a->y[i]};
    }
    JOX_ASSERT(s->departures->count <= a->count);
    s->statistics->removed += jox_agents_compact(a);
}
