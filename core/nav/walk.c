/* The walking law: the velocity that one wants who walks among others (core/walking.md). Eleven
   directions about the way are judged, by the kernel of the run's instruction set (walk_wide.c).

   The law of a direction e: those ahead leave a gap g, and the speed keeps the time gap T to it;
   those who cross and walls leave a free path, which is not used up within a fixed time. Of the
   directions the one that gets on best is taken. */
#include <math.h>

#include "base/number/elementary.h"
#include "base/number/random.h"
#include "nav/kernels.h"

static const float SIGHT = 1.5f; /* m: so near, walls hide people */
static const double KNOTS = 2.0; /* s between the knots of what a time gap wanders by */

#define X(name, isa) [isa] = jox_walk_packets_##name,
static JoxWalkKernel *const KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

static void walk_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const JoxWalk *w = context;
    KERNELS[w->nav->isa](w, begin, end);
}

/* Where everybody heads, and whether anybody walks by the law; *reach: how far walls matter, m. */
static bool aim_all(JoxAgents *a, const JoxWalkLaw *law, float *reach) {
    bool any = false;
    *reach = SIGHT;
    for (uint32_t i = 0; i < a->count; i++) {
        JoxV2 preferred = {a->pref_x[i], a->pref_y[i]}, aim = jox_unit(preferred);
        a->aim_x[i] = aim.x;
        a->aim_y[i] = aim.y;
        if (!jox_walks(a, i))
            continue;
        any = true;
        float keep = (float)law->wall_radius * a->param[JOX_PARAM_radius][i];
        *reach = jox_maxf(*reach, keep + jox_length(preferred) * (float)law->wall_time);
    }
    return any;
}

static float share_of(double interval, double time) {
    return (float)(1.0 - jox_exp(-interval / time));
}

void jox_nav_walk(JoxNav *nav, JoxAgents *agents, const JoxNeighbours *neighbours, uint64_t seed,
                  double time, double interval, bool plans, JoxPool *pool) {
    const JoxWalkLaw *law = nav->walk;
    float reach;
    if (!aim_all(agents, law, &reach) || !plans)
        return;
    if (nav->grid.walls)
        jox_wall_grid_fit(&nav->grid, reach);
    const double knot = floor(time / KNOTS);
    JoxWalk walk = {.nav = nav,
                    .agents = agents,
                    .neighbours = neighbours,
                    .law = law,
                    .interval = interval,
                    .stream = jox_random_stream(seed),
                    .knots = {jox_random_moment((uint64_t)knot, JOX_DRAW_GAP),
                              jox_random_moment((uint64_t)knot + 1, JOX_DRAW_GAP)},
                    .own = jox_random_moment(0, JOX_DRAW_GAP),
                    .between = time / KNOTS - knot,
                    .rise = share_of(interval, law->eager_rise),
                    .fall = share_of(interval, law->eager_fall),
                    .course = share_of(interval, law->course_time),
                    .start = jox_minf(1.0f, (float)(interval / law->start_time)),
                    .stop = jox_minf(1.0f, (float)(interval / law->stop_time))};
    jox_parallel_for(pool, agents->count, JOX_NAV_GRAIN, walk_range, &walk);
}
