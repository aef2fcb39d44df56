/* The walking law: how far away walls count, and the speeds that they allow one agent. Walls are
   kept at a share of how far the torso reaches across the way, less by eager people: they pass with
   a shoulder turned. Plain loops over the directions, which compilers vectorise with the same bits
   on each instruction set. */
#include <math.h>

#include "agents/torso_lanes.h"
#include "geom/polygon.h"
#include "nav/walk/walk.h"
#include "nav/walk/walk_lanes.h"

enum { EDGE_LANES = 12 }; /* directions, padded to whole vectors; the last repeats the one before */

/* An agent that seeks a way past walls, and the speed that walls allow in each direction, m/s; more
   than the wanted speed has no effect. */
typedef struct Seeker {
    JoxV2 at;
    float keep, speed, per_time; /* m: distance kept from walls; m/s: wanted; 1/s: inverse of the
                                    time in which a free path is used up */
    float x[EDGE_LANES], y[EDGE_LANES], allowed[EDGE_LANES];
} Seeker;

/* Limits the speed in direction k to that of a free path (m), which ends at distance `keep` from an
   edge. */
static inline void limit_direction(Seeker *p, int k, float path) {
    const float allowed = path > 0.0f ? path * p->per_time : 0.0f;
    p->allowed[k] = allowed < p->allowed[k] ? allowed : p->allowed[k];
}

/* Allows an agent closer than `keep` to an edge, which is at `off` from it, only directions away
   from the edge. */
static void limit_near_edge(Seeker *p, JoxV2 off) {
    for (int k = 0; k < EDGE_LANES; k++)
        limit_direction(p, k, off.x * p->x[k] + off.y * p->y[k] > 0.0f ? 0.0f : INFINITY);
}

/* Limits directions by the line parallel to an edge at distance `keep`, between the edge's ends; a
   line behind the agent does not count. t: unit vector along the edge; n: normal towards it; far:
   distance of the edge, m. */
static void limit_by_line(Seeker *p, JoxV2 t, JoxV2 n, float far, float from_t, float length) {
    for (int k = 0; k < EDGE_LANES; k++) {
        const float ex = p->x[k], ey = p->y[k], toward = ex * n.x + ey * n.y;
        const float path = (far - p->keep) / (toward > 1e-4f ? toward : 1e-4f);
        const float at = path * (ex * t.x + ey * t.y) - from_t;
        const bool meets = toward > 1e-4f && path >= 0.0f && at >= 0.0f && at <= length;
        limit_direction(p, k, meets ? path : INFINITY);
    }
}

/* Limits directions by the disc of radius `keep` around an edge's end. */
static void limit_by_end(Seeker *p, JoxV2 end) {
    const float keep2 = p->keep * p->keep, d2 = jox_length2(end);
    for (int k = 0; k < EDGE_LANES; k++) {
        const float along = end.x * p->x[k] + end.y * p->y[k], rest = keep2 - (d2 - along * along);
        const float path = along - sqrtf(rest > 0.0f ? rest : 0.0f);
        limit_direction(p, k, rest > 0.0f && along > 0.0f ? path : INFINITY);
    }
}

/* Limits directions by one edge; parts out of reach allow more than the wanted speed and are
   skipped. */
static void limit_by_edge(Seeker *p, const JoxWallVertex *edge, JoxV2 to) {
    const float SLACK = 1.001f; /* more than the rounding of paths */
    const float keep = p->keep, ahead = p->speed / p->per_time, reach = keep + ahead;
    const JoxV2 off = jox_sub(jox_segment_nearest(edge->point, to, p->at), p->at);
    const float off2 = jox_length2(off), reach2 = SLACK * reach * reach;
    if (off2 > reach * reach)
        return;
    if (off2 < keep * keep) {
        limit_near_edge(p, off);
        return;
    }
    const JoxV2 a = jox_sub(edge->point, p->at), b = jox_sub(to, p->at), t = edge->direction;
    const JoxV2 way = jox_sub(to, edge->point);
    const JoxV2 n = jox_scale(jox_left(t), jox_det(way, a) > 0.0f ? 1.0f : -1.0f);
    const float far = jox_dot(a, n);
    if (far - keep <= SLACK * ahead)
        limit_by_line(p, t, n, far, jox_dot(a, t), jox_length(way));
    if (jox_length2(a) <= reach2)
        limit_by_end(p, a);
    if (jox_length2(b) <= reach2)
        limit_by_end(p, b);
}

void JOX_WIDE(jox_walk_mind_walls)(const JoxWalk *w, uint32_t i, uint32_t lane,
                                   JoxWalkTable *table) {
    const JoxAgents *a = w->step.agents;
    const JoxWallGrid *grid = &w->nav->grid;
    const JoxV2 aim = {a->aim_x[i], a->aim_y[i]};
    const float room = 1.0f - (float)w->law->room_eager * a->eager[i];
    Seeker p = {.at = {a->x[i], a->y[i]},
                .keep = (float)w->law->wall_reach * room * jox_torso_reach(a, i, jox_left(aim)),
                .speed = jox_length((JoxV2){a->pref_x[i], a->pref_y[i]}),
                .per_time = 1.0f / (float)w->law->wall_time};
    for (int k = 0; k < EDGE_LANES; k++) {
        const int d = k < JOX_WALK_DIRECTIONS ? k : JOX_WALK_DIRECTIONS - 1;
        p.x[k] = jox_walk_cosine[d] * aim.x - jox_walk_sine[d] * aim.y;
        p.y[k] = jox_walk_cosine[d] * aim.y + jox_walk_sine[d] * aim.x;
        p.allowed[k] = INFINITY;
    }
    uint32_t count;
    const JoxNearEdge *near = jox_wall_grid_nearest(grid, p.at, &count);
    const float reach = p.keep + p.speed / p.per_time;
    for (uint32_t k = 0; k < count && near[k].away <= reach; k++) {
        const JoxWallVertex *edge = &grid->walls->vertices[near[k].edge];
        limit_by_edge(&p, edge, grid->walls->vertices[edge->next].point);
    }
    for (int k = 1; k < JOX_WALK_DIRECTIONS; k++)
        table->allowed[k][lane] = p.allowed[k];
}

/* Computes the aims of agents and returns how far away walls count for walkers, m; -1 without
   walkers. */
float JOX_WIDE(jox_walk_aim)(const JoxWalk *w, uint32_t begin, uint32_t end) {
    JoxAgents *a = w->step.agents;
    const JoxFloats zero = jf_set(0.0f), none = jf_set(-1.0f);
    JoxFloats reach = none;
    for (uint32_t i = begin; i < end; i += JOX_WIDTH) {
        const uint32_t lanes = jox_first_lanes(end - i);
        const JoxVector preferred = jv_load(a->pref_x, a->pref_y, i);
        const JoxFloats speed = jf_sqrt(jv_dot(preferred, preferred));
        const JoxVector unit = jv_scale(preferred, 1.0f / speed);
        const JoxVector aim = jv_select(jf_lt(zero, speed), unit, (JoxVector){zero, zero});
        const JoxMask walks =
            jm_and(jf_lt(zero, jox_param_lanes(a, JOX_PARAM_time_gap, i)), jm_of_bits(lanes));
        const JoxFloats keep = (float)w->law->wall_reach * jox_outer_lanes(a, i);
        const JoxFloats far = keep + speed * (float)w->law->wall_time;
        reach = jf_max(reach, jf_select(walks, far, none));
        float x[JOX_WIDTH], y[JOX_WIDTH];
        jv_store(x, y, 0, aim);
        for (uint32_t lane = 0; lanes >> lane & 1 && lane < JOX_WIDTH; lane++) {
            a->aim_x[i + lane] = x[lane];
            a->aim_y[i + lane] = y[lane];
        }
    }
    float reaches[JOX_WIDTH], most = -1.0f;
    jf_store(reaches, reach);
    for (uint32_t lane = 0; lane < JOX_WIDTH; lane++)
        most = reaches[lane] > most ? reaches[lane] : most;
    return most;
}
