/* Steering terms that lead to places or along them, by batch. Most agents head for the same place
   as the one before them in the batch, or for a point, which is left to the kernel. */
#include <math.h>

#include "machine/kernels.h"

/* Returns the direction of a line or queue at its point nearest to p. */
static JoxV2 way_along(const JoxPlace *place, JoxV2 p) {
    JoxV2 best = {0.0f, 0.0f};
    float least = INFINITY;
    for (uint32_t k = 0; k + 1 < place->count; k++) {
        const JoxV2 a = place->points[k], b = place->points[k + 1];
        const bool one = place->count == 2; /* a single side is the nearest */
        const float d2 = one ? 0.0f : jox_length2(jox_sub(p, jox_segment_nearest(a, b, p)));
        if (d2 < least) {
            least = d2;
            best = jox_unit(jox_place_is_queue(place) ? jox_sub(a, b) : jox_sub(b, a));
        }
    }
    return best;
}

/* Computes the term along for a batch. The direction along a single side is the same everywhere, so
   the last few places are cached, as a crowd mostly heads for a few. */
static void steer_along(const JoxMachineRun *run, const int32_t *places, JoxSteer *s) {
    enum { KNOWN = 4 };
    const JoxAgents *a = run->agents;
    int32_t known[KNOWN] = {-1, -1, -1, -1};
    JoxV2 ways[KNOWN];
    for (uint32_t n = 0; n < s->count; n++) {
        const uint32_t slot = (uint32_t)places[n] % KNOWN, i = s->index[n];
        JoxV2 way = {0.0f, 0.0f};
        if (places[n] >= 0 && places[n] == known[slot]) {
            way = ways[slot];
        } else if (places[n] >= 0) {
            const JoxPlace *place = &run->places[places[n]];
            way = way_along(place, (JoxV2){a->x[i], a->y[i]});
            known[slot] = place->count <= 2 ? places[n] : -1;
            ways[slot] = way;
        }
        s->way_x[n] = way.x;
        s->way_y[n] = way.y;
    }
}

/* Directs the agents of a batch straight to their targets; those whose place is `away` keep the way
   that they have. `away` is NULL in a world of one sheet. */
static void steer_straight(const JoxMachineRun *run, const int32_t *places, const int32_t *away,
                           int32_t target, JoxSteer *s) {
    for (uint32_t n = 0; n < s->count; n++) {
        const JoxPlace *place = places[n] < 0 ? NULL : &run->places[places[n]];
        const bool is_away = away && away[n] >= 0;
        const bool arrives = place && !is_away && jox_place_is_spot(place);
        JoxV2 way = {0.0f, 0.0f}, to = {0.0f, 0.0f};
        if (is_away)
            way = (JoxV2){s->way_x[n], s->way_y[n]};
        else if (arrives)
            to = place->centre;
        else if (jox_weight_counts(s->by[n]))
            way = jox_steer_seek(run, s->index[n], target);
        s->arrives[n] = arrives ? UINT32_MAX : 0;
        s->to_x[n] = to.x;
        s->to_y[n] = to.y;
        s->way_x[n] = way.x;
        s->way_y[n] = way.y;
    }
}

void jox_steer_place(const JoxMachineRun *run, const JoxMachine *machine, const JoxSteerTerm *term,
                     JoxSteer *s) {
    int32_t places[JOX_BATCH];
    jox_target_places(run, machine, term->target, s->index, s->count, places);
    if (term->kind == JOX_STEER_ALONG) {
        steer_along(run, places, s);
        return;
    }
    if (!run->agents->storeys) {
        steer_straight(run, places, NULL, term->target, s);
        return;
    }
    int32_t away[JOX_BATCH]; /* places that stairs lead to, else -1 */
    bool any = false;
    for (uint32_t n = 0; n < s->count; n++) {
        const JoxV2 at = {run->agents->x[s->index[n]], run->agents->y[s->index[n]]};
        const bool is_away = places[n] >= 0 && jox_is_place_elsewhere(run, (uint32_t)places[n], at);
        away[n] = is_away ? places[n] : -1;
        any |= is_away;
    }
    if (any) /* over stairs, as flow leads */
        jox_steer_to_places(run, term, s, away);
    steer_straight(run, places, away, term->target, s);
}
