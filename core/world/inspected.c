#include "world/inspected.h"

#include <string.h>

#include "world/world.h"

const char *const jox_force_part_names[JOX_FORCE_PARTS] = {[JOX_FORCE_PART_body] = "body",
                                                           [JOX_FORCE_PART_deceleration] =
                                                               "deceleration",
#define NAME(X, keep, name, label) [JOX_FORCE_PART_##name] = label,
                                                           JOX_FORCE_TERMS(NAME, )
#undef NAME
};

static const double FORGOTTEN = 5.0; /* s, simulated, without a look */

static void end(JoWorld *w, uint32_t n) {
    JoxInspection *all = &w->scratch.inspection;
    jox_text_free(&all->watched[n].why);
    all->count--;
    memmove(&all->agents[n], &all->agents[n + 1], (all->count - n) * sizeof *all->agents);
    memmove(&all->watched[n], &all->watched[n + 1], (all->count - n) * sizeof *all->watched);
    w->machines.watched_count = all->count;
}

static JoxInspected *begin(JoWorld *w, uint32_t slot, uint32_t id) {
    JoxInspection *all = &w->scratch.inspection;
    uint32_t oldest = 0;
    for (uint32_t n = 1; n < all->count; n++)
        if (all->agents[n].asked < all->agents[oldest].asked)
            oldest = n;
    if (all->count == JOX_MOST_INSPECTED)
        end(w, oldest);
    uint32_t n = all->count++;
    all->agents[n] = (JoxInspected){.slot = slot, .id = id};
    all->watched[n] = (JoxWatched){.agent_id = id};
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
            end(w, n);
            return NULL;
        }
        found = &all->agents[n];
    }
    if (!found && i != JOX_NO_INDEX)
        found = begin(w, slot, w->state.agents.id[i]);
    if (!found)
        return NULL;
    found->asked = (uint32_t)w->state.tick;
    *watched = &all->watched[found - all->agents];
    return found;
}

void jox_inspect_expire(JoWorld *w) {
    for (uint32_t n = w->scratch.inspection.count; n-- > 0;)
        if ((double)(w->state.tick - w->scratch.inspection.agents[n].asked) * w->model.def.dt >
            FORGOTTEN)
            end(w, n);
}

void jox_inspect_pushed(JoxInspection *all, const JoxAgents *a, const JoxForces *forces_of) {
    for (uint32_t n = 0; n < all->count; n++) {
        JoxInspected *seen = &all->agents[n];
        uint32_t i = jox_agents_find(a, seen->id);
        if (i == JOX_NO_INDEX)
            continue;
        JoxV2 *forces = seen->forces, body = jox_force_of_bodies(forces_of, i);
#define PART(X, keep, name, label)                                                                 \
    forces[JOX_FORCE_PART_##name] = (JoxV2){a->name##_x[i], a->name##_y[i]};
        JOX_FORCE_TERMS(PART, )
#undef PART
        forces[JOX_FORCE_PART_contact] = jox_sub(forces[JOX_FORCE_PART_contact], body);
        forces[JOX_FORCE_PART_body] = body;
        forces[JOX_FORCE_PART_inferred] = jox_sub(forces[JOX_FORCE_PART_inferred], seen->slowed);
        forces[JOX_FORCE_PART_deceleration] = seen->slowed;
        seen->summed = (JoxV2){a->force_x[i], a->force_y[i]};
    }
}

void jox_inspect_solved(JoxInspection *all, const JoxAgents *a, const JoxNav *nav,
                        const JoxNeighbours *neighbours, const JoxObjects *objects,
                        double planning_time) {
    for (uint32_t n = 0; n < all->count; n++) {
        JoxInspected *seen = &all->agents[n];
        uint32_t i = jox_agents_find(a, seen->id);
        if (i == JOX_NO_INDEX)
            continue;
        seen->plane_count =
            jox_nav_constraints(nav, a, neighbours, objects, planning_time, i, seen->planes);
        seen->preferred = (JoxV2){a->pref_x[i], a->pref_y[i]};
        seen->chosen = (JoxV2){a->next_x[i], a->next_y[i]};
        seen->speed_limit = a->speed_limit[i];
        seen->failed = a->failed[i];
        seen->seen = true;
    }
}

void jox_inspect_inferred(JoxInspection *all, const JoxAgents *a, const JoxForces *forces_of) {
    for (uint32_t n = 0; n < all->count; n++) {
        JoxInspected *seen = &all->agents[n];
        uint32_t i = jox_agents_find(a, seen->id);
        if (i == JOX_NO_INDEX)
            continue;
        float kept;
        JoxV2 hit = jox_sub((JoxV2){a->force_x[i], a->force_y[i]}, seen->summed);
        seen->forces[JOX_FORCE_PART_body] = jox_add(seen->forces[JOX_FORCE_PART_body], hit);
        JoxV2 added = jox_force_slowed(forces_of, i, &kept);
        seen->slowed = jox_add(jox_scale(seen->slowed, kept), added);
    }
}

void jox_inspection_free(JoxInspection *inspection) {
    for (uint32_t n = 0; n < inspection->count; n++)
        jox_text_free(&inspection->watched[n].why);
}
