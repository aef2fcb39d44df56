/* The stage walk: the velocity that the walking law wants among other agents (core/walking.md). The
   kernel walk_wide.c judges eleven directions around the way.

   The law of a direction e: agents ahead leave a gap g, and the speed keeps the time gap T to it;
   crossing agents and walls leave a free path, and the speed does not use it up within a fixed
   time. The direction with the best progress is taken. */
#include <math.h>

#include "base/mem.h"
#include "base/number/elementary.h"
#include "base/number/random.h"
#include "nav/walk/walk.h"
#include "simd/four.h"

static const float SIGHT = 1.5f; /* m: least distance within which walls hide agents */
static const double KNOTS = 2.0; /* s between the knots of the random walk of a time gap */

#define X(name, isa) [isa] = {jox_walk_aim_##name, jox_walk_packets_##name},
static const struct Kernels {
    JoxAimKernel *aim;
    JoxWalkKernel *walk;
} KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

static void aim_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const JoxWalk *w = context;
    w->nav->chunk_reach[begin / JOX_NAV_GRAIN] = KERNELS[w->nav->isa].aim(w, begin, end);
}

/* Makes room for the headings of all agents, which outlasts the stage if some walk by the law. */
static void reserve_headings(JoxNav *nav, uint32_t agents, bool walks) {
    if (!walks) {
        jox_stage_memory_begin(nav->memory, jox_stage_memory_bytes(agents, sizeof(JoxHeading)));
        nav->headings = jox_stage_memory_take(nav->memory, agents, sizeof(JoxHeading));
        return;
    }
    if (nav->heading_room < nav->capacity) {
        nav->heading_room = nav->capacity;
        nav->walker_headings =
            jox_realloc(nav->walker_headings, nav->heading_room, sizeof(JoxHeading));
    }
    nav->headings = nav->walker_headings;
}

/* Packs the headings of agents for lookup by neighbours. */
static void head_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const JoxWalk *w = context;
    const JoxAgents *a = w->step.agents;
    jox_interleave(&w->nav->headings[begin], a->aim_x + begin, a->aim_y + begin,
                   a->way_left + begin, a->bound + begin, end - begin);
}

static void walk_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const JoxWalk *w = context;
    KERNELS[w->nav->isa].walk(w, begin, end);
}

#define X(name, isa) [isa] = jox_torso_packets_##name,
static JoxWalkKernel *const TORSOS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

static void turn_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const JoxWalk *w = context;
    TORSOS[w->nav->isa](w, begin, end);
}

/* Computes the aims of all agents; *reach: how far walls matter, m. Returns whether any agent walks
   by the law. */
static bool aim_agents(JoxWalk *w, float *reach) {
    bool any = false;
    *reach = SIGHT;
    jox_parallel_for(w->step.pool, w->step.agents->count, JOX_NAV_GRAIN, aim_range, w);
    for (uint32_t i = 0; i < w->step.agents->count; i += JOX_NAV_GRAIN) {
        any |= w->nav->chunk_reach[i / JOX_NAV_GRAIN] >= 0.0f;
        *reach = jox_maxf(*reach, w->nav->chunk_reach[i / JOX_NAV_GRAIN]);
    }
    return any;
}

/* Discards the draws of time gaps if the random stream or the knots have changed. */
static void refresh_gap_draws(const JoxWalk *w) {
    JoxNav *nav = w->nav;
    const bool there = nav->gap_room >= w->step.agents->count;
    if (there && nav->gap_stream == w->stream && nav->gap_knots[0] == w->knots[0] &&
        nav->gap_knots[1] == w->knots[1])
        return;
    if (!there) {
        nav->gap_room = 0;
        jox_free(nav->gap_draws);
        nav->gap_draws = NULL;
        const uint32_t packets = nav->capacity / JOX_LANES + 1;
        nav->gap_draws = jox_alloc(packets, sizeof *nav->gap_draws);
        nav->gap_room = packets * JOX_LANES;
    }
    for (uint32_t i = 0; i < nav->gap_room; i++)
        nav->gap_draws[i / JOX_LANES].id[i % JOX_LANES] = JOX_NO_INDEX;
    nav->gap_stream = w->stream;
    nav->gap_knots[0] = w->knots[0];
    nav->gap_knots[1] = w->knots[1];
}

/* Returns the share of an exponential approach with time constant `time` that an interval covers,
   both in s. */
static float compute_share(double interval, double time) {
    return (float)(1.0 - jox_exp(-interval / time));
}

void jox_nav_walk(JoxNav *nav, const JoxStep *step) {
    const JoxWalkLaw *law = nav->walk;
    const double time = step->timing.time, interval = step->timing.interval;
    float reach;
    const double knot = floor(time / KNOTS);
    JoxWalk walk = {.nav = nav, .step = *step, .law = law};
    JOX_ASSERT(nav->capacity >= step->agents->count);
    const bool walks = aim_agents(&walk, &reach), turns = step->neighbours->has_torsos;
    if (turns)
        reach = jox_maxf(reach, 1.0f);
    if (nav->grid.walls && (walks || turns))
        jox_wall_grid_fit(&nav->grid, reach);
    if (walks || turns)
        reserve_headings(nav, step->agents->count, walks);
    if ((walks && step->timing.plans) || turns)
        jox_parallel_for(step->pool, step->agents->count, JOX_NAV_GRAIN, head_range, &walk);
    if (turns)
        jox_parallel_for(step->pool, step->agents->count, JOX_NAV_GRAIN, turn_range, &walk);
    if (!walks || !step->timing.plans)
        return;
    walk.stream = jox_random_stream(step->timing.seed);
    walk.knots[0] = jox_random_moment((uint64_t)knot, JOX_DRAW_GAP);
    walk.knots[1] = jox_random_moment((uint64_t)knot + 1, JOX_DRAW_GAP);
    walk.own = jox_random_moment(0, JOX_DRAW_GAP);
    refresh_gap_draws(&walk);
    walk.between = time / KNOTS - knot;
    walk.rise = compute_share(interval, law->eager_rise);
    walk.fall = compute_share(interval, law->eager_fall);
    walk.course = compute_share(interval, law->course_time);
    walk.start = jox_minf(1.0f, (float)(interval / law->start_time));
    walk.stop = jox_minf(1.0f, (float)(interval / law->stop_time));
    jox_nav_find_unhidden(nav, step);
    jox_parallel_for(step->pool, step->agents->count, JOX_NAV_GRAIN, walk_range, &walk);
}
