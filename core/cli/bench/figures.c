/* Computes the figures of a round from the statistics of a run, or of many worlds, at its beginning
   and end. */
#include <string.h>

#include "cli/bench/bench.h"

/* Returns the mean of a figure per agent-step between two moments, given its mean from the
   beginning of the run to each. */
static double get_mean_between(const JoStats *from, const JoStats *to, double before,
                               double after) {
    const double steps = (double)(to->agent_steps - from->agent_steps);
    const double sum = after * (double)to->agent_steps - before * (double)from->agent_steps;
    return steps > 0 ? sum / steps : 0.0;
}

void bench_note(BenchCase *c, const JoStats *from, const JoStats *to) {
    const double steps = (double)(to->steps - from->steps);
    const double agent_steps = (double)(to->agent_steps - from->agent_steps);
    const double cpu = to->cpu_s - from->cpu_s, wall = to->wall_s - from->wall_s;
    const double each = agent_steps > 0 ? 1.0 / agent_steps : 0.0;
    const uint64_t round = c->measured++;
    c->last = *to;
    c->steps_per_s[round] = steps / wall;
    c->times_real_time[round] = steps * to->dt / wall;
    c->ns[round] = cpu * 1e9 * each;
    for (int s = 0; s < JO_STAGE_COUNT; s++)
        c->stages[s][round] = get_mean_between(from, to, from->stage_ns[s], to->stage_ns[s]);
    c->bullet[round] = get_mean_between(from, to, from->bullet_ns, to->bullet_ns);
    c->bodies[round] = get_mean_between(from, to, from->objects_ns, to->objects_ns);
    for (int s = 0; s < JO_STAGE_COUNT; s++)
        if (strcmp(jo_stage_name(s), "bodies") == 0)
            c->bodies[round] += c->stages[s][round];
}
