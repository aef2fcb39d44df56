/* The stage move: integration, weak projection of overlaps, and walls that nobody passes. */
#include <math.h>

#include "base/assert.h"
#include "geom/polygon.h"
#include "nav/kernels.h"

#define X(name, isa) [isa] = {jox_move_integrate_##name, jox_move_settle_##name},
static const struct Kernels {
    JoxMoveKernel *integrate;
    JoxSettleKernel *settle;
} KERNELS[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

static const float STIFFNESS = 0.2f;   /* share of an overlap removed by one sweep, in a step of */
static const float STIFF_STEP = 0.05f; /* s; less in proportion in shorter ones */
static const float SKIN = 0.001f;      /* m: kept from a wall that was about to be passed */
#define MOST_PIECES 1e5f               /* of a way; who goes farther is beyond the world's end */
enum { SWEEPS = 2 };

static void integrate(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const JoxMove *m = context;
    KERNELS[m->nav->isa].integrate(m, begin, end);
}

/* Agent i's part of its overlap with j, by mass. */
static inline JoxV2 part_from(const JoxMove *m, const JoxV2 *from, uint32_t i, uint32_t j,
                              float apart) {
    const JoxAgents *a = m->agents;
    const float *mass = a->param[JOX_PARAM_mass];
    JOX_ASSERT(j < a->count && j != i);
    JoxV2 d = jox_wrap(a, jox_sub(from[i], from[j]));
    float d2 = jox_length2(d);
    if (d2 >= apart * apart || d2 == 0.0f)
        return (JoxV2){0.0f, 0.0f};
    float distance = sqrtf(d2);
    float part = m->stiffness * (apart - distance) * mass[j] / (mass[i] + mass[j]);
    return jox_scale(d, part / distance);
}

/* Each agent takes its own part of every overlap with its neighbours, all read from the old
   positions, so that no order matters. */
static void sweep_seen(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxMove *m = context;
    const float *radius = m->agents->param[JOX_PARAM_radius];
    const JoxV2 *from = m->nav->position[m->from];
    JoxV2 *to = m->nav->position[!m->from];
    for (uint32_t i = begin; i < end; i++) {
        JoxV2 shift = {0.0f, 0.0f};
        for (uint32_t k = 0; k < m->neighbours->count[i]; k++) {
            uint32_t j = m->neighbours->index[jox_neighbour_at(m->neighbours, i, k)];
            shift = jox_add(shift, part_from(m, from, i, j, radius[i] + radius[j]));
        }
        to[i] = jox_add(from[i], shift);
    }
}

/* The same of those that it touches, and out of bodies. No velocity comes of it, so that overlap
   gives no energy. */
static void sweep_touched(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    JoxMove *m = context;
    const JoxContactPlanes *t = m->touched;
    const JoxV2 *from = m->nav->position[m->from];
    JoxV2 *to = m->nav->position[!m->from];
    for (uint32_t i = begin; i < end; i++) {
        const JoxContactPlane *planes = t->planes + t->starts[i];
        JoxV2 shift = {0.0f, 0.0f};
        for (uint32_t k = 0; k < t->people[i]; k++)
            shift = jox_add(shift, part_from(m, from, i, planes[k].other, planes[k].apart));
        for (uint32_t k = 0; k < t->bodies[i]; k++) {
            const JoxObject *body = &m->objects->rows[planes[t->people[i] + k].other];
            JoxFootprintPoint side = jox_footprint_nearest(body, from[i]);
            float overlap = m->agents->breadth[i] - side.gap;
            shift = jox_add(shift, jox_scale(side.normal, m->stiffness * jox_maxf(0.0f, overlap)));
        }
        to[i] = jox_add(from[i], shift);
    }
}

/* First edge that the way p -> q passes from its outer side; t in [0, 1] along the way. */
static bool first_passed(const JoxWallGrid *grid, JoxV2 p, JoxV2 q, uint32_t *edge, float *t) {
    uint32_t count;
    const uint32_t *edges = jox_wall_grid_at(grid, p, &count);
    float best = 2.0f;
    JoxV2 way = jox_sub(q, p);
    for (uint32_t i = 0; i < count; i++) {
        const JoxWallVertex *v = &grid->walls->vertices[edges[i]];
        JoxV2 a = v->point, b = grid->walls->vertices[v->next].point;
        float before = jox_det(v->direction, jox_sub(p, a));
        float after = jox_det(v->direction, jox_sub(q, a));
        /* Outside is to the right: negative. Who stands on the line itself counts as outside. */
        if (before > 0.0f || after < 0.0f || before == after)
            continue;
        float at = before / (before - after);
        float along = jox_dot(jox_sub(jox_add(p, jox_scale(way, at)), a), v->direction);
        if (along < -SKIN || along > jox_length(jox_sub(b, a)) + SKIN || at >= best)
            continue;
        best = at;
        *edge = edges[i];
        *t = at;
    }
    return best <= 1.0f;
}

/* Stops a way at the wall that it would pass and lets it slide along it. */
static JoxV2 stop_at_walls(const JoxWallGrid *grid, JoxV2 p, JoxV2 q) {
    for (int round = 0; round < 3; round++) {
        uint32_t edge = 0;
        float t;
        if (!first_passed(grid, p, q, &edge, &t))
            return q;
        JOX_ASSERT(edge < grid->walls->count && t >= 0.0f && t <= 1.0f);
        JoxV2 normal = jox_scale(jox_left(grid->walls->vertices[edge].direction), -1.0f);
        JoxV2 a = grid->walls->vertices[edge].point;
        float outside = jox_dot(jox_sub(q, a), normal);
        q = jox_add(q, jox_scale(normal, SKIN - outside));
    }
    return p; /* a corner narrower than the step: stay */
}

/* A way that is longer than the grid tells walls for, in pieces that are not: where the piece
   begins in which a wall ends it, or the last; *q is then that piece's end. */
static JoxV2 piece_of_way(const JoxWallGrid *grid, JoxV2 p, JoxV2 *q) {
    const JoxV2 way = jox_sub(*q, p);
    const float length = jox_length(way), pieces = ceilf(length / grid->reach);
    if (!(pieces > 1.0f && pieces < MOST_PIECES))
        return p;
    JoxV2 from = p, to = p;
    for (float n = 1.0f; n <= pieces; n++) {
        uint32_t edge;
        float t;
        from = to;
        to = jox_add(p, jox_scale(way, n / pieces));
        if (first_passed(grid, from, to, &edge, &t))
            break;
    }
    *q = to;
    return from;
}

/* They come in at the other side, with the step's start beyond the edge. */
bool jox_move_over_edge(JoxAgents *a, uint32_t i) {
    JoxV2 before = {a->x[i], a->y[i]};
    if (a->period.x > 0.0f) {
        float turns = floorf((a->x[i] - a->origin.x) / a->period.x);
        a->x[i] -= turns * a->period.x;
    }
    if (a->period.y > 0.0f) {
        float turns = floorf((a->y[i] - a->origin.y) / a->period.y);
        a->y[i] -= turns * a->period.y;
    }
    JOX_ASSERT(!(a->period.x > 0.0f && fabsf(a->x[i] - a->origin.x) > 1.001f * a->period.x));
    JOX_ASSERT(!(a->period.y > 0.0f && fabsf(a->y[i] - a->origin.y) > 1.001f * a->period.y));
    JoxV2 shift = jox_sub((JoxV2){a->x[i], a->y[i]}, before);
    if (!isfinite(shift.x + shift.y)) /* the guard will put it back to where it was */
        return true;
    a->prev_x[i] += shift.x;
    a->prev_y[i] += shift.y;
    a->still_x[i] += shift.x;
    a->still_y[i] += shift.y;
    return shift.x != 0.0f || shift.y != 0.0f;
}

/* Out of walls that are nearer than the radius. */
static JoxV2 keep_clear(const JoxWallGrid *grid, JoxV2 p, float radius) {
    uint32_t count;
    const uint32_t *edges = jox_wall_grid_at(grid, p, &count);
    for (uint32_t i = 0; i < count; i++) {
        const JoxWallVertex *v = &grid->walls->vertices[edges[i]];
        JoxV2 a = v->point, b = grid->walls->vertices[v->next].point;
        if (jox_det(v->direction, jox_sub(p, a)) >= 0.0f)
            continue;
        JoxV2 out = jox_sub(p, jox_segment_nearest(a, b, p));
        float d2 = jox_length2(out);
        if (d2 >= radius * radius || d2 == 0.0f)
            continue;
        float distance = sqrtf(d2);
        p = jox_add(p, jox_scale(out, (radius - distance) / distance));
    }
    return p;
}

JoxV2 jox_move_by_walls(const JoxMove *m, uint32_t i, JoxV2 to) {
    const JoxAgents *a = m->agents;
    const JoxWallGrid *grid = &m->nav->grid;
    JoxV2 from = {a->prev_x[i], a->prev_y[i]};
    uint32_t near;
    if (jox_length2(jox_sub(to, from)) > grid->reach * grid->reach)
        from = piece_of_way(grid, from, &to);
    jox_wall_grid_at(grid, from, &near);
    if (near == 0)
        return to;
    const JoxV2 clear = keep_clear(grid, stop_at_walls(grid, from, to), a->breadth[i]);
    return stop_at_walls(grid, from, clear);
}

static void settle(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const JoxMove *m = context;
    m->nav->chunk_drift[begin / JOX_NAV_GRAIN] = KERNELS[m->nav->isa].settle(m, begin, end);
}

void jox_nav_move(JoxNav *nav, JoxAgents *agents, const JoxNeighbours *neighbours,
                  const JoxObjects *objects, const JoxContactPlanes *touched, double dt,
                  double response, double on_the_way, JoxPool *pool) {
    JOX_ASSERT(dt > 0.0 && response > 0.0 && response <= 1.0);
    JOX_ASSERT(on_the_way > 0.0 && on_the_way <= response);
    JoxMove move = {.nav = nav,
                    .agents = agents,
                    .neighbours = neighbours,
                    .objects = objects,
                    .touched = touched && touched->agents ? touched : NULL,
                    .dt = (float)dt,
                    .response = (float)response,
                    .on_the_way = (float)on_the_way};
    move.stiffness = STIFFNESS * jox_minf(1.0f, (float)dt / STIFF_STEP);
    jox_parallel_for(pool, agents->count, JOX_NAV_GRAIN, integrate, &move);
    for (int i = 0; i < SWEEPS && !nav->literal; i++) {
        jox_parallel_for(pool, agents->count, JOX_NAV_GRAIN,
                         move.touched ? sweep_touched : sweep_seen, &move);
        move.from = !move.from;
    }
    jox_parallel_for(pool, agents->count, JOX_NAV_GRAIN, settle, &move);
    float farthest2 = 0.0f;
    for (uint32_t chunk = 0; chunk * JOX_NAV_GRAIN < agents->count; chunk++)
        farthest2 = jox_maxf(farthest2, nav->chunk_drift[chunk]);
    nav->drift += sqrtf(farthest2) * 1.0001f;
}
