/* Ways of the steering term `field` to people, bodies and points, for which there are no distance
   fields: searches over the whole floor, round walls and fixed bodies. They share scratch, so that
   they are made before the batches of prefer. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "machine/gather.h"
#include "machine/kernels.h"

static const float BEFORE = 0.3f; /* m: distance from a fixed body at which ways to it end */
/* How far the end of a way may move before the way is searched anew: m, and a share of the straight
   distance to it. */
static const float MOVED = 0.25f, MOVED_SHARE = 0.1f;

/* Returns where the way to a spot ends: that of a fixed body ends before it. */
static JoxV2 find_way_end(const JoxMachineRun *run, JoxV2 from, const JoxSpot *spot) {
    const JoxV2 to = {spot->x, spot->y};
    if (spot->object < 0 || !jox_standable_is_fixed(&run->objects->rows[spot->object]))
        return to;
    const float inward = spot->radius + BEFORE;
    return jox_add(to, jox_scale(jox_unit(jox_sub(from, to)), inward));
}

static JoxV2 get_way_point(const double *way, uint32_t slot) {
    return jox_v2(way[slot], way[slot + 1]);
}

static void set_way_point(double *way, uint32_t slot, JoxV2 point) {
    way[slot] = point.x;
    way[slot + 1] = point.y;
}

/* Returns whether the next point of a way that was found before still leads to its end: it is in
   reach straight, the one after it is not yet, and the end has hardly moved. */
static bool still_leads(const JoxMachineRun *run, const JoxStandable *floor, const double *way,
                        JoxV2 at, JoxV2 to) {
    const JoxV2 moved = jox_sub(get_way_point(way, JOX_LEAD_END), to);
    return way[JOX_LEAD_TICK] + 1.0 >= (double)run->tick &&
           jox_length(moved) <= MOVED + MOVED_SHARE * jox_length(jox_sub(to, at)) &&
           jox_standable_is_straight(floor, at, get_way_point(way, JOX_LEAD_NEXT)) &&
           !jox_standable_is_straight(floor, at, get_way_point(way, JOX_LEAD_THEN));
}

/* Searches a way; false if there is none. */
static bool search_lead(JoxStandable *floor, double *way, JoxV2 at, JoxV2 to) {
    JoxV2 next, then;
    if (!(jox_standable_way(floor, at, to, &next) < INFINITY))
        return false;
    jox_standable_way(floor, next, to, &then);
    set_way_point(way, JOX_LEAD_NEXT, next);
    set_way_point(way, JOX_LEAD_THEN, then);
    set_way_point(way, JOX_LEAD_END, to);
    return true;
}

/* Returns the direction of an agent's way to a target; (0, 0) where it is straight. Ways are kept
   in memory, since a search costs more than a step of an agent. */
static JoxV2 find_lead(JoxMachineRun *run, JoxStandable *floor, uint32_t i,
                       const JoxSteerTerm *term) {
    const JoxAgents *a = run->agents;
    const JoxV2 at = {a->x[i], a->y[i]};
    const JoxSpot spot = jox_target_find(run, i, term->target);
    if (!spot.found || spot.place >= 0)
        return (JoxV2){0.0f, 0.0f};
    const JoxV2 to = find_way_end(run, at, &spot);
    if (jox_standable_is_straight(floor, at, to))
        return (JoxV2){0.0f, 0.0f};
    double *way = a->memory + (size_t)i * a->memory_stride + term->lead - 1;
    if (!still_leads(run, floor, way, at, to) && !search_lead(floor, way, at, to)) {
        run->without_way += jox_standable_cell(floor, at) != JOX_NO_CELL &&
                            jox_standable_cell(floor, to) != JOX_NO_CELL;
        return (JoxV2){0.0f, 0.0f};
    }
    way[JOX_LEAD_TICK] = (double)run->tick;
    return jox_unit(jox_sub(get_way_point(way, JOX_LEAD_NEXT), at));
}

void jox_leads_form(JoxMachineRun *run) {
    JoxMachineScratch *s = run->scratch;
    run->without_way = 0;
    for (uint32_t b = 0; b < s->batch_count; b++) {
        const JoxBatchRange *batch = &s->batches[b];
        const JoxMachine *machine = run->set->items[batch->machine];
        const JoxState *state = &machine->states[batch->state];
        uint32_t number = 0;
        for (uint32_t t = 0; t < state->steer_count; t++) {
            const JoxSteerTerm *term = &state->steer[t];
            if (!term->lead)
                continue;
            JoxStandable *floor = &jox_gather_ground(run, JOX_WHOLE_FLOOR)->cells;
            JOX_RESERVE(s->leads, s->lead_capacity, (size_t)s->capacity * (number + 1));
            JoxV2 *leads = s->leads + (size_t)s->capacity * number++;
            for (uint32_t n = 0; n < batch->count; n++) {
                const uint32_t i = s->grouped[batch->begin + n];
                leads[i] = floor->part ? find_lead(run, floor, i, term) : (JoxV2){0.0f, 0.0f};
            }
        }
    }
}

JoxV2 jox_steer_lead(const JoxMachineRun *run, const JoxMachine *machine, const JoxSteerTerm *term,
                     uint32_t i) {
    const JoxMachineScratch *s = run->scratch;
    if (!term->lead) /* a place that is not known */
        return (JoxV2){0.0f, 0.0f};
    size_t at = i;
    for (const JoxSteerTerm *t = machine->states[run->agents->state[i]].steer; t < term; t++)
        at += t->lead ? s->capacity : 0;
    const JoxV2 lead = s->leads[at];
    return jox_length2(lead) > 0.0f ? lead : jox_steer_seek(run, i, term->target);
}
