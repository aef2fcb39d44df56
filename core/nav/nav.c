/* Creates, frees and grows the state that navigation keeps between steps. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "nav/nav_state.h"

/* m: more than radii, time gaps and speeds together amount to */
static const float MOST_WALL_REACH = 1e4f;

#define X(name, isa) [isa] = jox_wall_unhidden_##name,
static JoxWallUnhiddenKernel *const KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

JoxNav *jox_nav_create(const JoxWalkLaw *walk) {
    JoxNav *nav = jox_alloc(1, sizeof *nav);
    nav->walk = walk;
    nav->unhidden_reach = -1.0f;
    nav->isa = jox_isa_resolve(JO_ISA_WIDEST);
    nav->memory = &nav->own_memory;
    return nav;
}

void jox_nav_set_literal(JoxNav *nav, bool literal) {
    nav->literal = literal;
}

void jox_nav_set_isa(JoxNav *nav, JoIsa isa) {
    JOX_ASSERT(jox_isa_runs(isa));
    nav->isa = isa;
}

void jox_nav_set_memory(JoxNav *nav, JoxStageMemory *memory) {
    nav->memory = memory;
}

void jox_nav_set_walls(JoxNav *nav, const JoxWalls *walls) {
    jox_wall_grid_free(&nav->grid);
    jox_spots_free(&nav->spots);
    nav->grid.walls = walls;
    nav->unhidden_reach = -1.0f;
}

typedef struct Unhidden {
    JoxNav *nav;
    const JoxAgents *agents;
} Unhidden;

static void find_unhidden_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const Unhidden *u = context;
    KERNELS[u->nav->isa](&u->nav->grid, u->agents->x + begin, u->agents->y + begin, end - begin,
                         u->nav->unhidden2 + begin);
}

void jox_nav_find_unhidden(JoxNav *nav, const JoxStep *step) {
    Unhidden unhidden = {nav, step->agents};
    if (nav->unhidden_reach == nav->grid.reach)
        return;
    JOX_ASSERT(nav->capacity >= step->agents->count);
    jox_parallel_for(step->pool, step->agents->count, JOX_NAV_GRAIN, find_unhidden_range,
                     &unhidden);
    nav->unhidden_reach = nav->grid.reach;
}

const JoxWallGrid *jox_nav_touching_walls(JoxNav *nav, const JoxStep *step, float passing) {
    const JoxAgents *agents = step->agents;
    const JoxNeighbours *neighbours = step->neighbours;
    if (!nav->grid.walls || nav->grid.walls->count == 0 || agents->count == 0)
        return NULL;
    float gap = passing;
    for (uint32_t i = 0; i < agents->count; i++)
        gap = jox_maxf(gap, jox_param(agents, JOX_PARAM_push_reach, i));
    float halfway = neighbours->widest + 0.5f * gap;
    jox_wall_grid_fit(&nav->grid,
                      jox_maxf(jox_touch_reach(neighbours, neighbours->widest), halfway));
    jox_nav_find_unhidden(nav, step);
    return &nav->grid;
}

const float *jox_nav_unhidden2(const JoxNav *nav) {
    return nav->unhidden_reach == nav->grid.reach ? nav->unhidden2 : NULL;
}

void jox_nav_sections(JoxNav *nav, JoxSections *s) {
    jox_sections_module(s, "nav");
    JOX_SECTION(s, "wall_reach", nav->grid.reach);
    if (s->mode == JOX_SECTIONS_RESTORE &&
        !(nav->grid.reach >= 0.0f && nav->grid.reach <= MOST_WALL_REACH)) {
        jox_sections_fail(s, "wall_reach", "no agent reaches this far");
        nav->grid.reach = 0.0f;
    }
    if (s->mode == JOX_SECTIONS_RESTORE)
        jox_wall_grid_reset(&nav->grid, nav->grid.reach);
}

void jox_nav_invalidate_order(JoxNav *nav) {
    nav->drift = jox_drift_unknown();
    jox_spots_free(&nav->spots);
}

void jox_nav_free(JoxNav *nav) {
    if (!nav)
        return;
    jox_wall_grid_free(&nav->grid);
    jox_spots_free(&nav->spots);
    jox_free(nav->cell_first);
    jox_free(nav->bands);
    jox_free(nav->chunk_drift);
    jox_free(nav->chunk_relaxed);
    jox_free(nav->walker_headings);
    jox_free(nav->chunk_reach);
    jox_free(nav->unhidden2);
    jox_free(nav->gap_draws);
    jox_stage_memory_free(&nav->own_memory);
    jox_free(nav);
}

void jox_nav_reserve(JoxNav *nav, uint32_t count) {
    if (count <= nav->capacity)
        return;
    uint32_t n = nav->capacity = count + count / 4 + 64;
    nav->chunk_drift = jox_realloc(nav->chunk_drift, n / JOX_NAV_GRAIN + 1, sizeof(JoxDrift));
    nav->chunk_relaxed = jox_realloc(nav->chunk_relaxed, n / JOX_NAV_GRAIN + 1, sizeof(uint32_t));
    nav->chunk_reach = jox_realloc(nav->chunk_reach, n / JOX_NAV_GRAIN + 1, sizeof(float));
    nav->unhidden2 = jox_realloc(nav->unhidden2, n + JOX_LANES, sizeof(float));
}
