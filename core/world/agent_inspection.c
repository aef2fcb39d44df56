#include "world/agent_inspection.h"

#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "world/world.h"

const char *const jox_force_part_names[JOX_FORCE_PARTS] = {[JOX_FORCE_PART_body] = "body",
                                                           [JOX_FORCE_PART_deceleration] =
                                                               "deceleration",
#define NAME(X, keep, role, name, label) [JOX_FORCE_PART_##name] = label,
                                                           JOX_FORCE_TERMS(NAME, )
#undef NAME
};

static const double FORGOTTEN = 5.0; /* s of simulated time after which an inspection ends */

static void end_inspection(JoWorld *w, uint32_t n) {
    JoxInspection *all = &w->scratch.inspection;
    JOX_ASSERT(n < all->count);
    jox_watched_end(&all->watched[n]);
    all->count--;
    memmove(&all->agents[n], &all->agents[n + 1], (all->count - n) * sizeof *all->agents);
    memmove(&all->watched[n], &all->watched[n + 1], (all->count - n) * sizeof *all->watched);
    w->machines.watched_count = all->count;
}

/* Copies the forces of the last step. */
static void copy_forces(const JoWorld *w, uint32_t i, JoxInspected *seen) {
    const JoxAgents *a = &w->state.agents;
    const JoxV2 body = jox_force_of_bodies(w->scratch.forces, i + a->index_drop[i]);
#define PART(X, keep, role, name, label)                                                           \
    seen->forces[JOX_FORCE_PART_##name] = (JoxV2){a->name##_x[i], a->name##_y[i]};
    JOX_FORCE_TERMS(PART, )
#undef PART
    seen->forces[JOX_FORCE_PART_ext] = (JoxV2){a->last_ext_x[i], a->last_ext_y[i]};
    seen->forces[JOX_FORCE_PART_contact] = jox_sub(seen->forces[JOX_FORCE_PART_contact], body);
    seen->forces[JOX_FORCE_PART_body] = body;
}

/* Returns whether the agent was in the last step, so that its scratch columns are valid: not if it
   entered since, or the world was restored since. */
static bool was_in_step(const JoWorld *w, uint32_t i) {
    return w->scratch.substep.step.timing.dt > 0.0 && w->state.agents.contact_radius[i] > 0.0f;
}

/* Computes what the agent would choose in the present state; nothing if it was not in the last
   step. */
static void inspect_now(JoWorld *w, uint32_t i, JoxInspected *seen) {
    const JoxAgents *a = &w->state.agents;
    if (!was_in_step(w, i))
        return;
    JoxPlan *plan = jox_alloc(1, sizeof *plan);
    jox_bodies_objects(w->state.bodies, &w->scratch.objects);
    jox_objects_lay(&w->scratch.objects);
    JoxStep step = w->scratch.substep.step;
    step.timing.time = (double)w->state.tick * w->model.def.dt;
    jox_nav_plan(w->scratch.nav, &step, i, plan);
    memcpy(seen->planes, plan->planes, plan->count * sizeof *plan->planes);
    seen->plane_count = plan->count;
    seen->chosen = plan->chosen;
    seen->failed = plan->failed;
    seen->preferred = (JoxV2){a->pref_x[i], a->pref_y[i]};
    seen->speed_limit = a->speed_limit[i];
    seen->seen = true;
    copy_forces(w, i, seen);
    jox_free(plan);
}

static JoxInspected *begin_inspection(JoWorld *w, uint32_t slot, uint32_t id) {
    JoxInspection *all = &w->scratch.inspection;
    uint32_t oldest = 0;
    for (uint32_t n = 1; n < all->count; n++)
        if (all->agents[n].asked < all->agents[oldest].asked)
            oldest = n;
    if (all->count == JOX_MOST_INSPECTED)
        end_inspection(w, oldest);
    JOX_ASSERT(all->count < JOX_MOST_INSPECTED);
    uint32_t n = all->count++;
    all->agents[n] = (JoxInspected){.slot = slot, .id = id};
    all->watched[n] = (JoxWatched){.agent_id = id, .begun = (uint32_t)w->state.tick};
    w->machines.watched = all->watched;
    w->machines.watched_count = all->count;
    return &all->agents[n];
}

JoxInspected *jox_world_inspect(JoWorld *w, uint32_t slot, const JoxWatched **watched) {
    JoxInspection *all = &w->scratch.inspection;
    uint32_t i =
        slot < w->state.agents.slot_count ? w->state.agents.slot_index[slot] : JOX_NO_INDEX;
    JoxInspected *found = NULL;
    for (uint32_t n = 0; n < all->count && !found; n++) {
        if (all->agents[n].slot != slot)
            continue;
        if (i == JOX_NO_INDEX || w->state.agents.id[i] != all->agents[n].id) {
            end_inspection(w, n);
            return NULL;
        }
        found = &all->agents[n];
    }
    if (!found && i != JOX_NO_INDEX) {
        found = begin_inspection(w, slot, w->state.agents.id[i]);
        inspect_now(w, i, found);
    }
    if (!found)
        return NULL;
    found->asked = (uint32_t)w->state.tick;
    *watched = &all->watched[found - all->agents];
    return found;
}

void jox_inspect_end_old(JoWorld *w) {
    for (uint32_t n = w->scratch.inspection.count; n-- > 0;)
        if ((double)(w->state.tick - w->scratch.inspection.agents[n].asked) * w->model.def.dt >
            FORGOTTEN)
            end_inspection(w, n);
}

/* Checks that the parts of a net force add up to it. */
static void check_sum(const JoxInspected *seen, JoxV2 force) {
    JoxV2 left = force;
    float size = jox_length(force);
    for (int part = 0; part < JOX_FORCE_PARTS; part++) {
        left = jox_sub(left, seen->forces[part]);
        size += jox_length(seen->forces[part]);
    }
    JOX_ASSERT(!(jox_length(left) > 1e-2f + 1e-4f * size));
}

void jox_inspect_after_push(JoxInspection *all, const JoxAgents *a, const JoxForces *forces_of) {
    for (uint32_t n = 0; n < all->count; n++) {
        JoxInspected *seen = &all->agents[n];
        uint32_t i = jox_agents_find(a, seen->id);
        if (i == JOX_NO_INDEX)
            continue;
        JoxV2 *forces = seen->forces, body = jox_force_of_bodies(forces_of, i);
#define PART(X, keep, role, name, label)                                                           \
    forces[JOX_FORCE_PART_##name] = (JoxV2){a->name##_x[i], a->name##_y[i]};
        JOX_FORCE_TERMS(PART, )
#undef PART
        forces[JOX_FORCE_PART_contact] = jox_sub(forces[JOX_FORCE_PART_contact], body);
        forces[JOX_FORCE_PART_body] = body;
        forces[JOX_FORCE_PART_inferred] = jox_sub(forces[JOX_FORCE_PART_inferred], seen->slowed);
        forces[JOX_FORCE_PART_deceleration] = seen->slowed;
        seen->summed = (JoxV2){a->force_x[i], a->force_y[i]};
        JOX_CHECK(check_sum(seen, seen->summed));
    }
}

void jox_inspect_after_solve(JoxInspection *all, const JoxNav *nav, const JoxStep *step) {
    const JoxAgents *a = step->agents;
    for (uint32_t n = 0; n < all->count; n++) {
        JoxInspected *seen = &all->agents[n];
        uint32_t i = jox_agents_find(a, seen->id);
        if (i == JOX_NO_INDEX)
            continue;
        seen->plane_count = jox_nav_constraints(nav, step, i, seen->planes);
        JOX_ASSERT(seen->plane_count <= JOX_MOST_CONSTRAINTS);
        seen->preferred = (JoxV2){a->pref_x[i], a->pref_y[i]};
        seen->chosen = (JoxV2){a->next_x[i], a->next_y[i]};
        seen->speed_limit = a->speed_limit[i];
        seen->failed = a->failed[i];
        seen->seen = true;
    }
}

void jox_inspect_after_infer(JoxInspection *all, const JoxAgents *a, const JoxForces *forces_of) {
    for (uint32_t n = 0; n < all->count; n++) {
        JoxInspected *seen = &all->agents[n];
        uint32_t i = jox_agents_find(a, seen->id);
        if (i == JOX_NO_INDEX)
            continue;
        float kept;
        JoxV2 hit = jox_sub((JoxV2){a->force_x[i], a->force_y[i]}, seen->summed);
        seen->forces[JOX_FORCE_PART_body] = jox_add(seen->forces[JOX_FORCE_PART_body], hit);
        JOX_CHECK(check_sum(seen, (JoxV2){a->force_x[i], a->force_y[i]}));
        JoxV2 added = jox_force_from_slowing(forces_of, i, &kept);
        seen->slowed = jox_add(jox_scale(seen->slowed, kept), added);
    }
}

void jox_inspection_free(JoxInspection *inspection) {
    for (uint32_t n = 0; n < inspection->count; n++)
        jox_watched_end(&inspection->watched[n]);
}
