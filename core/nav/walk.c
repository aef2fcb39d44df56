/* The walking law: the velocity that one wants who walks among others (core/walking.md). Eleven
   directions about the way are judged, by the kernel of the run's instruction set (walk_wide.c).

   The law of a direction e: those ahead leave a gap g, and the speed keeps the time gap T to it;
   those who cross and walls leave a free path, which is not used up within a fixed time. Of the
   directions the one that gets on best is taken. */
#include <math.h>

#include "base/mem.h"
#include "base/number/elementary.h"
#include "base/number/random.h"
#include "nav/kernels.h"
#include "simd/four.h"

static const float SIGHT = 1.5f; /* m: so near, walls hide people */
static const double KNOTS = 2.0; /* s between the knots of what a time gap wanders by */

#define X(name, isa) [isa] = {jox_walk_aim_##name, jox_walk_packets_##name, jox_wall_clear_##name},
static const struct Kernels {
    JoxAimKernel *aim;
    JoxWalkKernel *walk;
    JoxWallClearKernel *clear;
} KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

static void aim_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const JoxWalk *w = context;
    w->nav->chunk_reach[begin / JOX_NAV_GRAIN] = KERNELS[w->nav->isa].aim(w, begin, end);
}

/* How each heads, for those who look at many others, and how far off walls may hide some. */
static void head_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const JoxWalk *w = context;
    const JoxAgents *a = w->agents;
    jox_interleave(&w->nav->headings[begin], a->aim_x + begin, a->aim_y + begin, a->way + begin,
                   a->bound + begin, end - begin);
    KERNELS[w->nav->isa].clear(&w->nav->grid, a->x + begin, a->y + begin, end - begin,
                               w->nav->clear2 + begin);
}

static void walk_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const JoxWalk *w = context;
    KERNELS[w->nav->isa].walk(w, begin, end);
}

/* Where everybody heads, and whether anybody walks by the law; *reach: how far walls matter, m. */
static bool aim_all(JoxWalk *w, float *reach, JoxPool *pool) {
    bool any = false;
    *reach = SIGHT;
    jox_parallel_for(pool, w->agents->count, JOX_NAV_GRAIN, aim_range, w);
    for (uint32_t i = 0; i < w->agents->count; i += JOX_NAV_GRAIN) {
        any |= w->nav->chunk_reach[i / JOX_NAV_GRAIN] >= 0.0f;
        *reach = jox_maxf(*reach, w->nav->chunk_reach[i / JOX_NAV_GRAIN]);
    }
    return any;
}

/* Time gaps are drawn anew where they are drawn by something else now. */
static void keep_gap_draws(const JoxWalk *w) {
    JoxNav *nav = w->nav;
    const bool there = nav->gap_room >= w->agents->count;
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
        nav->gap_draws[i / JOX_LANES].of[i % JOX_LANES] = JOX_NO_INDEX;
    nav->gap_stream = w->stream;
    nav->gap_knots[0] = w->knots[0];
    nav->gap_knots[1] = w->knots[1];
}

static float share_of(double interval, double time) {
    return (float)(1.0 - jox_exp(-interval / time));
}

void jox_nav_walk(JoxNav *nav, JoxAgents *agents, const JoxNeighbours *neighbours, uint64_t seed,
                  double time, double interval, bool plans, JoxPool *pool) {
    const JoxWalkLaw *law = nav->walk;
    float reach;
    const double knot = floor(time / KNOTS);
    JoxWalk walk = {.nav = nav, .agents = agents, .neighbours = neighbours, .law = law};
    JOX_ASSERT(nav->capacity >= agents->count);
    if (!aim_all(&walk, &reach, pool) || !plans)
        return;
    if (nav->grid.walls)
        jox_wall_grid_fit(&nav->grid, reach);
    walk.interval = interval;
    walk.stream = jox_random_stream(seed);
    walk.knots[0] = jox_random_moment((uint64_t)knot, JOX_DRAW_GAP);
    walk.knots[1] = jox_random_moment((uint64_t)knot + 1, JOX_DRAW_GAP);
    walk.own = jox_random_moment(0, JOX_DRAW_GAP);
    keep_gap_draws(&walk);
    walk.between = time / KNOTS - knot;
    walk.rise = share_of(interval, law->eager_rise);
    walk.fall = share_of(interval, law->eager_fall);
    walk.course = share_of(interval, law->course_time);
    walk.start = jox_minf(1.0f, (float)(interval / law->start_time));
    walk.stop = jox_minf(1.0f, (float)(interval / law->stop_time));
    jox_parallel_for(pool, agents->count, JOX_NAV_GRAIN, head_range, &walk);
    nav->clear_reach = nav->grid.reach;
    jox_parallel_for(pool, agents->count, JOX_NAV_GRAIN, walk_range, &walk);
}
