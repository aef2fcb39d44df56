/* Statistics of bonded bodies: when an agent first touches one, how many bonds break, and how many
   rows of agents press when the first does. The stage bodies calls them. */
#include <math.h>

#include "agents/torso.h"
#include "base/assert.h"
#include "base/mem.h"
#include "geom/polygon.h"
#include "world/stages.h"

static const float SKIN = 0.02f;     /* m: agents nearer than this touch */
static const float FRONT = 0.30f;    /* m: gap to the body within which agents count as in front */
static const float ROUNDING = 0.01f; /* m: more than the rounding error of a distance */
static const double FRONT_TIME =
    1.0; /* s: time over which the speed of agents in front is averaged */

/* Returns the gap between the torso of agent i and the footprint of a body, m; within it minus the
   torso's least radius. */
static float measure_gap(const JoxAgents *a, const JoxObject *body, uint32_t i) {
    JoxV2 at = {a->x[i], a->y[i]}, towards = {0.0f, 0.0f};
    float least = INFINITY;
    if (body->footprint_count >= 3 &&
        jox_polygon_contains(body->footprint, body->footprint_count, at))
        return -a->contact_radius[i];
    for (uint32_t k = 0; k < body->footprint_count; k++) {
        JoxV2 side = jox_segment_nearest(body->footprint[k],
                                         body->footprint[(k + 1) % body->footprint_count], at);
        const JoxV2 offset = jox_sub(side, at);
        if (jox_length2(offset) >= least)
            continue;
        least = jox_length2(offset);
        towards = offset;
    }
    return sqrtf(least) - jox_torso_reach(a, i, jox_unit(towards));
}

/* Until an agent touches a bonded body: averages the speed of agents in front over the last
   second. */
void jox_stage_note_bond_touch(const JoxBodyStage *stage) {
    JoxBondStatistics *s = &stage->statistics->bonds;
    const JoxAgents *a = stage->agents;
    JoxBodyBonds bonds;
    for (uint32_t o = 0; o < stage->objects->count && !s->touched; o++) {
        if (!jox_bodies_bonds(stage->bodies, o, &bonds))
            continue;
        JOX_ASSERT(stage->objects->rows[o].live);
        uint32_t front = 0;
        double sum = 0.0;
        const JoxObject *body = &stage->objects->rows[o];
        for (uint32_t i = 0; i < a->count; i++) {
            const float reach = a->contact_radius[i] + jox_torso_half(a, i) + FRONT + ROUNDING;
            if (!jox_object_reaches(body, (JoxV2){a->x[i], a->y[i]}, reach))
                continue;
            float gap = measure_gap(a, body, i);
            if (gap > FRONT)
                continue;
            s->touched = s->touched || gap <= 0.0f;
            front++;
            sum += sqrt((double)a->vx[i] * a->vx[i] + (double)a->vy[i] * a->vy[i]);
        }
        if (s->touched)
            s->touch_s = stage->substep->end;
        else if (front)
            s->front_speed +=
                (sum / front - s->front_speed) *
                (s->front == 0 ? 1.0 : fmin(1.0, stage->substep->step.timing.dt / FRONT_TIME));
        s->front = front > s->front ? front : s->front;
    }
}

/* Returns whether agent i presses on what is `gap` m away: touches it while it is compressed, or
   pushes it. */
static bool is_pressing(const JoxAgents *a, uint32_t i, float gap) {
    return (gap < SKIN && a->compression[i] > 0.0f) ||
           (gap < jox_param(a, JOX_PARAM_push_reach, i) && jox_param(a, JOX_PARAM_push, i) > 0.0f);
}

/* Returns how many rows, from the first on, have at least half as many agents as the first. `row`
   is the row by agent; the queue holds agents in ascending rows. */
static uint32_t count_full_rows(const uint32_t *row, const uint32_t *queue, uint32_t count) {
    uint32_t first = 0, rows = 0;
    for (uint32_t begin = 0, end; begin < count; begin = end) {
        for (end = begin; end < count && row[queue[end]] == row[queue[begin]]; end++)
            ;
        first = begin == 0 ? end : first;
        if (2 * (end - begin) < first)
            break;
        rows++;
    }
    return rows;
}

/* Counts the rows of agents that press on a body, the first on the body, each on the one before,
   and all agents in them. A breadth-first search from the body. */
static void count_rows(const JoxBodyStage *stage, const JoxObject *body) {
    const JoxAgents *a = stage->agents;
    const JoxNeighbours *near = stage->neighbours;
    uint32_t *row = jox_alloc((size_t)a->count + 1, sizeof *row);
    uint32_t *queue = jox_alloc((size_t)a->count + 1, sizeof *queue), end = 0;
    for (uint32_t i = 0; i < a->count; i++)
        if (is_pressing(a, i, measure_gap(a, body, i))) {
            row[i] = 1;
            queue[end++] = i;
        }
    for (uint32_t at = 0; at < end; at++) {
        uint32_t i = queue[at];
        for (uint32_t k = 0; k < near->count[i] && a->compression[i] > 0.0f; k++) {
            uint32_t j = near->index[jox_neighbour_at(near, i, k)];
            if (row[j] || !is_pressing(a, j, jox_torso_gap(a, i, j)))
                continue;
            JOX_ASSERT(row[i] > 0); /* the queue holds reached agents only */
            row[j] = row[i] + 1;
            queue[end++] = j;
        }
    }
    JOX_ASSERT(end <= a->count);
    stage->statistics->bonds.people = end;
    stage->statistics->bonds.rows = count_full_rows(row, queue, end);
    jox_free(row);
    jox_free(queue);
}

void jox_stage_note_bond_breaks(const JoxBodyStage *stage, const JoxBodiesReport *report) {
    JoxBondStatistics *s = &stage->statistics->bonds;
    for (uint32_t k = 0; k < report->break_count; k++) {
        const JoxBodyBreak *broken = &report->breaks[k];
        JOX_ASSERT(broken->row < stage->objects->count);
        JOX_ASSERT(broken->bonds > 0 && broken->pieces > 0);
        JOX_ASSERT(k == 0 || report->breaks[k - 1].id < broken->id);
        if (s->broken == 0) {
            s->first_s = stage->substep->end;
            count_rows(stage,
                       &stage->objects
                            ->rows[broken->row]); /* objects as they were before the bodies moved */
        }
        s->broken += broken->bonds;
        s->pieces += broken->pieces - 1;
    }
}
