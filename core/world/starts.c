#include "world/starts.h"

#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/sort.h"
#include "world/world.h"

/* Radii of another within which nobody comes in: nearer ones would be moved aside (nav/placement.c).
 */
static const float CLEAR = 1.5f;

static int by_time(const void *left, const void *right, const void *context) {
    const JoxStart *a = left, *b = right;
    (void)context;
    return a->time < b->time ? -1 : a->time > b->time;
}

void jox_world_list_starts(JoWorld *world) {
    JoxWorldModel *model = &world->model;
    uint32_t count = 0;
    JOX_ASSERT(!model->starts && model->start_count == 0);
    for (uint32_t g = 0; g < model->group_count; g++)
        if (model->groups[g].starts)
            count += model->groups[g].start_count - model->groups[g].count;
    if (count == 0)
        return;
    model->starts = jox_alloc(count, sizeof *model->starts);
    for (uint32_t g = 0; g < model->group_count; g++)
        for (uint32_t s = model->groups[g].count; s < model->groups[g].start_count; s++) {
            model->starts[model->start_count] = model->groups[g].starts[s];
            model->starts[model->start_count++].group = g;
        }
    JOX_ASSERT(model->start_count == count);
    jox_sort(model->starts, count, sizeof *model->starts, by_time, NULL, NULL);
    world->state.population.entered = jox_alloc(count, sizeof *world->state.population.entered);
}

void jox_world_set_going(JoWorld *world, uint32_t agent, JoxV2 velocity) {
    JoxAgents *a = &world->state.agents;
    JOX_ASSERT(agent < a->count);
    if (!isfinite(velocity.x))
        return;
    a->vx[agent] = velocity.x;
    a->vy[agent] = velocity.y;
    const float speed = jox_length(velocity);
    if (speed < 1e-3f)
        return;
    a->face_x[agent] = velocity.x / speed;
    a->face_y[agent] = velocity.y / speed;
}

static bool is_free(const JoxAgents *a, JoxV2 at) {
    for (uint32_t i = 0; i < a->count; i++) {
        const float least = CLEAR * a->param[JOX_PARAM_radius][i];
        if (jox_length2(jox_sub(at, jox_v2(a->x[i], a->y[i]))) < least * least)
            return false;
    }
    return true;
}

void jox_world_starts(JoWorld *world) {
    const JoxWorldModel *model = &world->model;
    JoxPopulation *p = &world->state.population;
    const double time = (double)world->state.tick * model->def.dt + 1e-9;
    for (uint32_t s = p->all_until; s < model->start_count && model->starts[s].time <= time; s++) {
        const JoxStart *start = &model->starts[s];
        if (p->entered[s] || !is_free(&world->state.agents, start->at))
            continue;
        const JoxGroup *group = &model->groups[start->group];
        jox_world_set_going(world,
                            jox_world_spawn(world, start->group, start->at, group->memory,
                                            group->memory_count),
                            start->velocity);
        p->entered[s] = 1;
    }
    while (p->all_until < model->start_count && p->entered[p->all_until])
        p->all_until++;
}
