/* The stage perceive: each agent's nearest neighbours, by the kernel of the run's instruction set.
 */
#include "nav/near/perceive.h"

#include "agents/torso.h"
#include "base/assert.h"
#include "geom/storeys.h"
#include "simd/four.h"

#define X(name, isa) [isa] = jox_perceive_packets_##name,
static JoxPerceiveKernel *const KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

#define X(name, isa) [isa] = jox_shape_packets_##name,
static JoxPerceiveKernel *const SHAPES[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

/* Adds to motions how belts carry agents [begin, end), and notes it. */
static void add_belts(JoxNeighbours *out, const JoxAgents *a, uint32_t begin, uint32_t end) {
    for (uint32_t i = begin; i < end; i++) {
        const JoxV2 belt = jox_belt_at(a->flights, (JoxV2){a->x[i], a->y[i]});
        out->belt_x[i] = belt.x;
        out->belt_y[i] = belt.y;
        out->motions[i].vx += belt.x;
        out->motions[i].vy += belt.y;
    }
}

static void perceive_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const JoxPerceive *p = context;
    const JoxAgents *a = p->agents;
    jox_interleave(&p->out->motions[begin], a->x + begin, a->y + begin, a->vx + begin,
                   a->vy + begin, end - begin);
    if (p->out->has_belts)
        add_belts(p->out, a, begin, end);
    SHAPES[p->nav->isa](p, begin, end);
    KERNELS[p->nav->isa](p, begin, end);
}

static void reserve_neighbours(const JoxNav *nav, JoxNeighbours *out, const JoxAgents *a) {
    const uint32_t most = (uint32_t)jox_param_greatest(a, JOX_PARAM_neighbours);
    jox_neighbours_reserve(out, a->count, most > 0 ? most : 1);
    out->widest = jox_agents_widest(a, nav->literal);
    out->has_torsos = !nav->literal && jox_agents_have_torsos(a);
    out->has_belts = jox_has_belts(a->flights);
    if (out->has_belts)
        jox_neighbours_reserve_belts(out);
}

void jox_nav_perceive(JoxNav *nav, JoxAgents *agents, JoxNeighbours *out, JoxPool *pool) {
    reserve_neighbours(nav, out, agents);
    nav->unhidden_reach = -1.0f;
    JoxPerceive perceive = {nav, agents, out, jox_nav_sight(agents)};
    jox_parallel_for(pool, agents->count, JOX_NAV_GRAIN, perceive_range, &perceive);
    JOX_CHECK(jox_neighbours_check(out, agents));
}
