/* Lists the state of a world as sections, which are hashed, saved, restored and compared. */
#include <math.h>
#include <string.h>

#include "base/guard.h"
#include "base/mem.h"
#include "base/number/bits.h"
#include "world/world.h"

/* Appends the added walls of a restored state; none if the state is damaged. */
static void restore_added_walls(JoWorld *w, JoxSections *s) {
    bool good = w->state.added_count <= JOX_MOST_ADDED_WALLS;
    for (uint32_t m = 0; good && m < w->state.added_count; m++) {
        const JoxAddedWall *made = &w->state.added_walls[m];
        good = (made->count == 2 || made->count == 4) && made->open <= 1 && made->is_new <= 1 &&
               made->name[0] && memchr(made->name, 0, sizeof made->name);
        for (uint32_t p = 0; good && p < 4; p++)
            good = fabsf(made->points[p].x) <= 1e4f && fabsf(made->points[p].y) <= 1e4f;
    }
    if (!good) {
        w->state.added_count = 0;
        jox_sections_fail(s, "made", "a wall that was added makes no sense");
    }
    jox_world_append_added_walls(w);
}

/* Lists the state of walls: which gates are open, and added walls. */
static void list_walls(JoWorld *w, JoxSections *s) {
    JoxWalls *walls = &w->model.all_walls;
    JoxHash shape = jox_hash_begin();
    const uint32_t own = w->state.added_count > 0 ? w->model.added_vertex : walls->count;
    if (s->mode == JOX_SECTIONS_RESTORE) {
        jox_world_mark_added_walls(w);
        jox_walls_clear_new_marks(walls);
    }
    for (uint32_t v = 0; v < own; v++)
        jox_hash_add(&shape, &walls->vertices[v].point, sizeof walls->vertices[v].point);
    jox_section_model(s, "walls", jox_hash_end(&shape));
    JOX_SECTION_ARRAY(s, "made", w->state.added_walls, w->state.added_count,
                      w->state.added_capacity);
    if (s->mode == JOX_SECTIONS_RESTORE) /* also after a failure, so that walls and state agree */
        restore_added_walls(w, s);
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        struct JoxWallRing *ring = &walls->rings[r];
        if (!ring->name)
            continue;
        JOX_SECTION(s, "open", ring->open);
        JOX_SECTION(s, "set", ring->set);
    }
    for (uint32_t k = 0; k < w->model.storeys.stair_count; k++)
        JOX_SECTION(s, "closed", w->model.storeys.stairs[k].closed);
    JOX_SECTION(s, "walls_version", w->state.walls_version);
    JOX_SECTION(s, "walls_set", w->state.walls_applied);
    JOX_SECTION(s, "walls_came", w->state.has_new_walls);
    for (uint32_t v = 0; w->state.has_new_walls && v < own;
         v++) /* added walls have their own is_new */
        JOX_SECTION(s, "came", walls->vertices[v].is_new);
    if (s->mode == JOX_SECTIONS_RESTORE && !s->failed && w->state.walls_applied) {
        w->state.walls_applied = false;
        jox_world_apply_walls(w);
    }
}

/* Lists the present inputs of players, and how far the log has been played. */
static void list_input(JoxInputLog *log, JoxSections *s) {
    jox_sections_module(s, "input");
    JOX_SECTION_ARRAY(s, "present", log->present, log->present_count, log->present_capacity);
    jox_sections_unhashed(s, true); /* a replay and a live run have the same hash */
    JOX_SECTION(s, "next", log->next);
    jox_sections_unhashed(s, false);
    if (s->mode == JOX_SECTIONS_RESTORE && log->next > log->count)
        jox_sections_fail(s, "next", "the log is shorter");
}

/* Lists parts of the def on which the future depends besides the state. */
static void list_def(const JoWorldDef *def, JoxSections *s) {
    jox_section_model(s, "seed", def->seed);
    jox_section_model(s, "forces", def->forces);
    jox_section_model(s, "literal", def->literal);
    jox_section_model(s, "dt", jox_double_bits(def->dt));
    jox_section_model(s, "gravity", jox_double_bits(def->gravity));
}

void jox_world_sections(JoWorld *w, JoxSections *s) {
    jox_sections_module(s, "world");
    list_def(&w->model.def, s);
    JOX_SECTION(s, "tick", w->state.tick);
    list_walls(w, s);
    jox_sources_sections(w, s);
    jox_population_sections(w, s);
    jox_lifts_sections(w, s);
    jox_agents_sections(&w->state.agents, s);
    jox_machines_sections(&w->machines, s);
    list_input(&w->state.input, s);
    const JoxRouteStage route = jox_world_route_stage(w);
    jox_routes_sections(&route, s);
    jox_nav_sections(w->scratch.nav, s);
    jox_forces_sections(w->scratch.forces, s);
    jox_drags_sections(&w->state.drags, s);
    jox_bodies_sections(w->state.bodies, s);
    jox_exits_sections(&w->state.exits, s);
    jox_sections_module(s, "figures");
    jox_sections_unhashed(s, true);
    JOX_SECTION(s, "statistics", w->state.statistics);
    jox_lift_figures_sections(w, s);
    jox_sections_unhashed(s, false);
}

bool jox_world_snapshot_is_exact(const JoWorld *world) {
    return jox_bodies_count(world->state.bodies) == 0 ||
           (world->model.reinserts_bodies && world->state.tick % JOX_BODIES_REINSERT_STEPS == 0);
}

static void save_state(JoWorld *world, JoxText *out) {
    jox_nav_end_births(world->scratch.nav); /* a restored world begins without them, too */
    JoxSections s = jox_sections_save(out);
    jox_world_sections(world, &s);
    jox_sections_end(&s);
}

bool jox_world_snapshot(JoWorld *world, JoxText *out, JoError *error) {
    if (!jox_world_snapshot_is_exact(world)) {
        jox_error(
            error, JO_INPUT,
            "with bodies a state can be saved after every %d steps, not after %llu, of a world "
            "that re-inserts them",
            JOX_BODIES_REINSERT_STEPS, (unsigned long long)world->state.tick);
        return false;
    }
    save_state(world, out);
    return true;
}

/* Reads the sections into a world; false with an error if they do not fit. */
static bool restore_state(JoWorld *w, const void *data, size_t size, JoError *error) {
    JoxSections s = jox_sections_restore(data, size);
    if (!s.failed)
        jox_world_sections(w, &s);
    if (!jox_sections_end(&s)) {
        jox_error(error, JO_INPUT, "the state cannot be restored: %s", s.wrong);
        return false;
    }
    const char *fault = jox_world_find_fault(w);
    if (fault) {
        jox_error(error, JO_INPUT, "the state cannot be restored: it is none of a run (%s)", fault);
        return false;
    }
    w->scratch.departures.count = 0;
    w->failure[0] = 0;
    jox_world_forget(w);
    return true;
}

bool jox_world_restore(JoWorld *world, const void *data, size_t size, JoError *error) {
    JoxText before = {0};
    save_state(world, &before);
    bool good = restore_state(world, data, size, error);
    if (!good)
        restore_state(world, before.data, before.length, NULL);
    jox_text_free(&before);
    return good;
}

void jox_world_forget(JoWorld *w) {
    jox_agents_forget(&w->state.agents);
    jox_machines_forget(&w->machines);
    jox_nav_invalidate_order(w->scratch.nav);
    w->scratch.substep = (JoxSubstep){0}; /* no step was done since */
    jox_bodies_objects(w->state.bodies, &w->scratch.objects);
}

uint64_t jox_world_hash(const JoWorld *world) {
    return jox_world_hash_without(world, NULL);
}

uint64_t jox_world_hash_without(const JoWorld *world, const char *module) {
    JOX_GUARD (world->heap, NULL) /* may allocate memory for routes */
        return 0;
    JoxSections s = jox_sections_hash();
    s.skipped = module;
    jox_world_sections((JoWorld *)world, &s); /* in this mode it writes no state */
    return jox_hash_end(&s.hash);
}
