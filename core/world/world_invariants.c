/* Invariants of whole parts of a world: builds with assertions check them before and after each
   step, all builds after reading a state. Each find_*_fault returns the first that does not hold.
 */
#include <math.h>

#include "base/assert.h"
#include "world/world.h"

/* Returns whether an index is valid or -1. */
static bool is_index(int32_t index, uint32_t count) {
    return index == -1 || (index >= 0 && (uint32_t)index < count);
}

static const char *find_machine_fault(const JoWorld *w, uint32_t i) {
    const JoxAgents *a = &w->state.agents;
    if (a->machine[i] == JOX_NO_MACHINE)
        return NULL;
    JOX_MUST(a->machine[i] < w->model.machines.count);
    JOX_MUST(a->state[i] < w->model.machines.items[a->machine[i]]->state_count);
    JOX_MUST(a->entered[i] <= w->state.tick);
    JOX_MUST(a->queued[i] <= w->state.tick || a->queued[i] == JOX_NO_TURN);
    return NULL;
}

static const char *find_agents_fault(const JoWorld *w) {
    const JoxAgents *a = &w->state.agents;
    JOX_MUST(w->state.tick < UINT32_MAX && w->machines.tick <= w->state.tick);
    const uint32_t bodies = jox_bodies_rows(w->state.bodies);
    JOX_MUST(a->count <= a->capacity && a->count <= a->next_id);
    JOX_MUST(a->count + a->free_count == a->slot_count);
    for (uint32_t r = 0; r < a->count; r++) {
        const uint32_t i = a->by_rank[r];
        JOX_MUST(i < a->count && a->rank[i] == r && a->rank_id[r] == a->id[i]);
        JOX_MUST(a->id[i] < a->next_id);
        JOX_MUST(r == 0 || a->rank_id[r - 1] < a->rank_id[r]);
        JOX_MUST(a->slot[i] < a->slot_count && a->slot_index[a->slot[i]] == i);
        JOX_MUST(a->slot_generation[a->slot[i]] > 0);
        JOX_MUST(!a->removed[i]);
        JOX_MUST(a->group[i] == 0 || a->group[i] < w->model.group_count);
        JOX_MUST(is_index(a->goal[i], w->model.place_count));
        JOX_MUST(a->bound[i] <= w->model.place_count && a->queue_at[i] <= w->model.place_count);
        JOX_MUST(a->arrived_at[i] <= w->model.place_count && a->kept_off[i] >= 0.0f);
        JOX_MUST(a->kicked[i] <= bodies && a->struck[i] <= bodies && a->approach[i] <= bodies);
        JOX_MUST(a->parting[i] <= bodies);
        JOX_MUST(jox_param(a, JOX_PARAM_radius, i) > 0.0f &&
                 jox_param(a, JOX_PARAM_mass, i) > 0.0f);
        JOX_MUST(jox_is_unit(jox_v2(a->face_x[i], a->face_y[i])));
        JOX_MUST(jox_is_unit(jox_v2(a->chest_x[i], a->chest_y[i])));
        const char *fault = find_machine_fault(w, i);
        if (fault)
            return fault;
    }
    return NULL;
}

void jox_world_check_agents(const JoWorld *w) {
    JOX_NO_FAULT(find_agents_fault(w));
}

static bool all_within(const float *column, uint32_t count, float most) {
    bool good = true;
    for (uint32_t i = 0; i < count; i++)
        good &= fabsf(column[i]) <= most;
    return good;
}

/* m/s, N, N/m, s: far more than agents reach, with finite squares. */
static const float MOST = 1e9f;

/* Bounds that number_guard.c or the writer of a number keeps. */
static const char *find_numbers_fault(const JoWorld *w) {
    const JoxAgents *a = &w->state.agents;
    const uint32_t n = a->count;
    const float *const positions[] = {a->x, a->y, a->prev_x, a->prev_y, a->still_x, a->still_y};
    const float *const others[] = {
        a->vx,          a->vy,     a->pref_x,      a->pref_y,      a->next_x,   a->next_y,
        a->eager,       a->still,  a->force_x,     a->force_y,     a->course_x, a->course_y,
        a->compression, a->load,   a->displaced_x, a->displaced_y, a->settled,  a->spin,
        a->fallen,      a->lean_x, a->lean_y};
#define COLUMNS_OF_STATE(name) a->name##_x, a->name##_y,
#define COLUMNS_OF_SCRATCH(name)
#define TERM_COLUMNS(X, keep, role, name, label) COLUMNS_OF_##keep(name)
    const float *const terms[] = {JOX_FORCE_TERMS(TERM_COLUMNS, )};
    for (size_t c = 0; c < sizeof positions / sizeof *positions; c++)
        JOX_MUST(all_within(positions[c], n, JOX_WORLD_FARTHEST));
    for (size_t c = 0; c < sizeof others / sizeof *others; c++)
        JOX_MUST(all_within(others[c], n, MOST));
    for (size_t c = 0; c < sizeof terms / sizeof *terms; c++)
        JOX_MUST(all_within(terms[c], n, MOST));
    for (int p = 0; p < JOX_PARAM_COUNT; p++)
        for (uint32_t i = 0; i < n; i++)
            JOX_MUST(jox_parameter_is_stored((JoxParameter)p, jox_param(a, p, i)));
    for (uint32_t i = 0; i < n; i++)
        JOX_MUST(!isnan(a->lasts[i]));
    return NULL;
}

/* Starts, sources and parties. */
static const char *find_population_fault(const JoWorld *w) {
    const JoxPopulation *p = &w->state.population;
    JOX_MUST(p->all_until <= w->model.start_count);
    for (uint32_t s = 0; s < w->model.start_count; s++)
        JOX_MUST(p->entered[s] <= 1);
    for (uint32_t s = 0; s < w->model.source_count; s++)
        JOX_MUST(w->state.sources.made[s] >= 0.0 && w->state.sources.made[s] < 1e9 &&
                 w->state.sources.arrivals[s].next >= 0.0 &&
                 w->state.sources.arrivals[s].next < 1e12);
    for (uint32_t g = 0; g < w->model.group_count; g++) {
        if (p->party_left[g] == 0)
            continue;
        JOX_MUST(p->party_left[g] < w->model.groups[g].party);
        JOX_MUST(p->party_team[g] > w->model.group_count && p->party_team[g] <= UINT16_MAX);
    }
    return NULL;
}

static void check_walls(const JoxWalls *walls) {
    uint32_t vertices = 0;
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        JOX_ASSERT(ring->name || (!ring->open && !ring->set));
        JOX_ASSERT(ring->first == vertices);
        vertices += ring->count;
    }
    JOX_ASSERT(vertices == walls->count);
}

void jox_world_check_model(const JoWorld *w) {
    const JoxWorldModel *m = &w->model;
    JOX_ASSERT(m->scene_places <= m->place_count && m->place_count <= m->place_capacity);
    for (uint32_t p = 0; p < m->place_count; p++)
        for (uint32_t k = 0; k < m->places[p].member_count; k++)
            JOX_ASSERT(m->places[p].members[k] >= 0 &&
                       (uint32_t)m->places[p].members[k] < m->scene_places);
    for (uint32_t s = 0; s < m->source_count; s++) {
        JOX_ASSERT(m->sources[s].place < m->scene_places);
        JOX_ASSERT(m->sources[s].like < m->group_count);
    }
    JOX_NO_FAULT(find_population_fault(w));
    for (uint32_t s = 0; s < m->sink_count; s++) {
        JOX_ASSERT(m->sinks[s].place < m->scene_places);
        JOX_ASSERT(m->sinks[s].group < (int64_t)m->group_count);
    }
    JOX_ASSERT(w->machines.set == &m->machines && w->machines.state == &w->state.machines);
    check_walls(&m->all_walls);
}

static const char *find_input_fault(const JoxInputLog *log) {
    JOX_MUST(log->next <= log->count);
    for (size_t e = log->next; e < log->count; e++)
        JOX_MUST(e == 0 || log->entries[e - 1].tick <= log->entries[e].tick);
    for (uint32_t p = 0; p < log->present_count; p++) {
        JOX_MUST(isfinite(log->present[p].vx) && isfinite(log->present[p].vy));
        for (uint32_t q = 0; q < p; q++)
            JOX_MUST(log->present[q].agent_id != log->present[p].agent_id);
    }
    return NULL;
}

/* Boxes are listed oldest first, and ids of bodies only grow. */
static const char *find_drags_fault(const JoxDrags *drags, const JoxBodies *bodies) {
    JOX_MUST(drags->box_count <= JOX_MOST_BOXES && drags->grab_count <= JOX_MOST_GRABS);
    for (uint32_t b = 1; b < drags->box_count; b++)
        JOX_MUST(drags->boxes[b - 1] < drags->boxes[b]);
    for (uint32_t g = 0; g < drags->grab_count; g++) {
        const JoxV3 to = drags->grabs[g].to;
        JOX_MUST(drags->grabs[g].row < jox_bodies_rows(bodies));
        JOX_MUST(isfinite(to.x) && isfinite(to.y) && isfinite(to.z));
        for (uint32_t k = 0; k < g; k++)
            JOX_MUST(drags->grabs[k].id != drags->grabs[g].id);
    }
    return NULL;
}

static void check_inspection(const JoxInspection *all, const JoWorld *w) {
    JOX_ASSERT(all->count <= JOX_MOST_INSPECTED && w->machines.watched_count == all->count);
    for (uint32_t n = 0; n < all->count; n++) {
        JOX_ASSERT(all->watched[n].agent_id == all->agents[n].id);
        JOX_ASSERT(all->agents[n].slot < w->state.agents.slot_count);
        JOX_ASSERT(all->agents[n].plane_count <= JOX_MOST_CONSTRAINTS);
    }
}

static const char *find_figures_fault(const JoWorld *w) {
    const JoxStatistics *s = &w->state.statistics;
    uint64_t samples = 0;
    for (int bin = 0; bin < JOX_OVERLAP_BINS; bin++)
        samples += s->overlap[bin];
    JOX_MUST(samples == s->overlap_samples && samples <= s->agent_steps);
    JOX_MUST(s->second_failures <= s->failures && s->failures <= s->agent_steps);
    JOX_MUST(s->turned_aside <= s->agent_steps && s->plans_bounded <= s->agent_steps);
    JOX_MUST(s->removed + w->state.agents.count <= s->spawned);
    JOX_MUST(s->bonds.rows <= s->bonds.people);
    uint64_t people = 0;
    for (uint32_t e = 0; e < w->state.exits.count; e++)
        people += w->state.exits.items[e].people;
    JOX_MUST(people <= w->state.exits.left && w->state.exits.left <= s->removed);
    return NULL;
}

static const char *find_lists_fault(const JoWorld *w) {
    const char *fault = find_input_fault(&w->state.input);
    fault = fault ? fault : find_drags_fault(&w->state.drags, w->state.bodies);
    return fault ? fault : find_figures_fault(w);
}

void jox_world_check_lists(const JoWorld *w) {
    check_inspection(&w->scratch.inspection, w);
    JOX_NO_FAULT(find_lists_fault(w));
}

const char *jox_world_find_fault(const JoWorld *w) {
    const char *fault = find_agents_fault(w);
    fault = fault ? fault : find_population_fault(w);
    fault = fault ? fault : find_numbers_fault(w);
    return fault ? fault : find_lists_fault(w);
}
