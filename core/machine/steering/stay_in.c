/* Keeps agents within the place of their state's `stays_in`, as players within the lines of a
   court. prefer.c calls it when all preferred velocities are known. */
#include <math.h>

#include "machine/kernels.h"

/* s. An agent may walk towards an edge as fast as it would come there in the time in which it can
   stop: by its damping, and four response times of its velocity (world/step.c) at least, so that
   its momentum does not carry it over the edge. */
static const float SHORTEST_STOP = 0.2f, LONGEST_STOP = 2.0f, RESPONDING = 0.1f;

static float find_stopping_time(const JoxAgents *a, uint32_t i) {
    const float damping = jox_maxf(jox_param(a, JOX_PARAM_damping, i), 0.1f);
    return jox_clampf(1.0f / damping + RESPONDING, SHORTEST_STOP, LONGEST_STOP);
}

/* Returns the unit vector from a point to the nearest point of an edge, whose inside is on its
   left; and the distance between them in *gap, m. */
static JoxV2 find_way_to_edge(JoxV2 at, JoxV2 a, JoxV2 b, float *gap) {
    const JoxV2 way = jox_sub(jox_segment_nearest(a, b, at), at);
    *gap = jox_length(way);
    return *gap > 1e-3f ? jox_scale(way, 1.0f / *gap)
                        : jox_scale(jox_left(jox_unit(jox_sub(b, a))), -1.0f);
}

/* Returns the velocity nearest to `wanted`, by one edge after the other, with which an agent of a
   radius and stopping time, s, stops before the edges of a polygon that it is in. */
static JoxV2 stop_at_edges(const JoxPlace *place, JoxV2 at, float radius, float stopping,
                           JoxV2 wanted) {
    enum { PASSES = 2 }; /* in a corner one edge may lead over another */
    for (uint32_t k = 0; k < PASSES * place->count; k++) {
        const JoxV2 a = place->points[k % place->count];
        const JoxV2 b = place->points[(k + 1) % place->count];
        float gap;
        const JoxV2 out = find_way_to_edge(at, a, b, &gap);
        const float over = jox_dot(wanted, out) - (gap - radius) / stopping;
        if (over > 0.0f)
            wanted = jox_sub(wanted, jox_scale(out, over));
    }
    return wanted;
}

static void keep_agent(const JoxMachineRun *run, uint32_t i, int32_t target) {
    JoxAgents *a = run->agents;
    const int32_t index = jox_target_place(run, i, target);
    const JoxV2 at = {a->x[i], a->y[i]}, wanted = {a->pref_x[i], a->pref_y[i]};
    if (index < 0 || !jox_place_is_area(&run->places[index]))
        return;
    const float fastest =
        jox_minf(jox_param(a, JOX_PARAM_speed, i), jox_param(a, JOX_PARAM_max_speed, i));
    const bool in = jox_place_contains(run->places, (uint32_t)index, at);
    const JoxV2 back = jox_sub(jox_place_nearest(run->places, (uint32_t)index, at), at);
    const JoxV2 kept =
        in ? stop_at_edges(&run->places[index], at, jox_param(a, JOX_PARAM_radius, i),
                           find_stopping_time(a, i), wanted)
           : jox_scale(jox_unit(back), fastest);
    const float speed = jox_length(kept), most = jox_maxf(fastest, jox_length(wanted));
    const JoxV2 v = speed > most ? jox_scale(kept, most / speed) : kept;
    a->pref_x[i] = v.x;
    a->pref_y[i] = v.y;
}

void jox_machines_stay_in(JoxMachineRun *run) {
    for (uint32_t b = 0; b < run->scratch->batch_count; b++) {
        const JoxBatchRange *batch = &run->scratch->batches[b];
        const int16_t target = run->set->items[batch->machine]->states[batch->state].stays_in;
        for (uint32_t n = 0; target >= 0 && n < batch->count; n++)
            keep_agent(run, run->scratch->grouped[batch->begin + n], target);
    }
}
