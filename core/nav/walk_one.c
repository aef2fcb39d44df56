/* The walking law in plain C, for one agent: what walls allow. The kernel (walk_wide.c) does all
   else. */
#include <math.h>

#include "geom/polygon.h"
#include "nav/kernels.h"

enum { EDGE_LANES = 12 }; /* directions, for whole vectors; the last repeats the one before */

/* Of 0 and +-15 to +-75 degrees. */
const float jox_walk_cosine[JOX_WALK_DIRECTIONS] = {
    1.0f,        0.96592583f, 0.96592583f, 0.86602540f, 0.86602540f, 0.70710678f,
    0.70710678f, 0.5f,        0.5f,        0.25881905f, 0.25881905f};
const float jox_walk_sine[JOX_WALK_DIRECTIONS] = {
    0.0f,         0.25881905f, -0.25881905f, 0.5f,        -0.5f,       0.70710678f,
    -0.70710678f, 0.86602540f, -0.86602540f, 0.96592583f, -0.96592583f};

/* ---- what walls allow ---- */

/* One who seeks a way past walls, and what they allow in each direction, m/s. */
typedef struct Seeker {
    JoxV2 at;
    float keep, speed; /* m from walls; m/s wanted */
    float x[EDGE_LANES], y[EDGE_LANES], allowed[EDGE_LANES];
} Seeker;

/* The free path of a disc before a wall's edge is not used up within `wall_time`. */
static void mind_edge(const JoxWalk *w, Seeker *p, JoxV2 from, JoxV2 to) {
    const float per_time = 1.0f / (float)w->law->wall_time, keep = p->keep, keep2 = keep * keep;
    const JoxV2 edge = jox_sub(to, from), near = jox_segment_nearest(from, to, p->at);
    const JoxV2 off = jox_sub(near, p->at), a = jox_sub(from, p->at), b = jox_sub(to, p->at);
    const float reach = keep + p->speed / per_time;
    if (jox_length2(off) > reach * reach)
        return;
    const float length = jox_length(edge), side = jox_det(edge, a) > 0.0f ? 1.0f : -1.0f;
    const JoxV2 t = jox_unit(edge), n = jox_scale(jox_left(t), side); /* towards the wall's line */
    const float far = jox_dot(a, n), from_t = jox_dot(a, t);
    const bool inside = jox_length2(off) < keep2;
    for (int k = 0; k < EDGE_LANES; k++) {
        float ex = p->x[k], ey = p->y[k], best = INFINITY;
        /* The line at the distance `keep`, between the ends; what lies behind is not in the way. */
        float toward = ex * n.x + ey * n.y, path = (far - keep) / (toward > 1e-4f ? toward : 1e-4f);
        float at = path * (ex * t.x + ey * t.y) - from_t;
        best = toward > 1e-4f && path >= 0.0f && at >= 0.0f && at <= length ? path : best;
        /* The discs about the ends. */
        float a_along = a.x * ex + a.y * ey, b_along = b.x * ex + b.y * ey;
        float a_rest = keep2 - (jox_length2(a) - a_along * a_along);
        float b_rest = keep2 - (jox_length2(b) - b_along * b_along);
        float a_path = a_along - sqrtf(a_rest > 0.0f ? a_rest : 0.0f);
        float b_path = b_along - sqrtf(b_rest > 0.0f ? b_rest : 0.0f);
        best = a_rest > 0.0f && a_along > 0.0f && a_path < best ? a_path : best;
        best = b_rest > 0.0f && b_along > 0.0f && b_path < best ? b_path : best;
        best = inside ? (off.x * ex + off.y * ey > 0.0f ? 0.0f : INFINITY) : best;
        float allowed = best > 0.0f ? best * per_time : 0.0f;
        p->allowed[k] = allowed < p->allowed[k] ? allowed : p->allowed[k];
    }
}

void jox_walk_mind_walls(const JoxWalk *w, uint32_t i, uint32_t lane, JoxWalkTable *table) {
    const JoxAgents *a = w->agents;
    const JoxWallGrid *grid = &w->nav->grid;
    const JoxV2 aim = {a->aim_x[i], a->aim_y[i]};
    Seeker p = {.at = {a->x[i], a->y[i]},
                .keep = (float)w->law->wall_radius * a->param[JOX_PARAM_radius][i],
                .speed = jox_length((JoxV2){a->pref_x[i], a->pref_y[i]})};
    for (int k = 0; k < EDGE_LANES; k++) {
        const int d = k < JOX_WALK_DIRECTIONS ? k : JOX_WALK_DIRECTIONS - 1;
        p.x[k] = jox_walk_cosine[d] * aim.x - jox_walk_sine[d] * aim.y;
        p.y[k] = jox_walk_cosine[d] * aim.y + jox_walk_sine[d] * aim.x;
        p.allowed[k] = INFINITY;
    }
    uint32_t count;
    const uint32_t *edges = jox_wall_grid_at(grid, p.at, &count);
    for (uint32_t k = 0; k < count; k++) {
        const JoxWallVertex *from = &grid->walls->vertices[edges[k]];
        mind_edge(w, &p, from->point, grid->walls->vertices[from->next].point);
    }
    for (int k = 1; k < JOX_WALK_DIRECTIONS; k++) {
        table->allowed[k][lane] = jox_minf(table->allowed[k][lane], p.allowed[k]);
        table->worth[k][lane] = jox_minf(table->worth[k][lane], p.allowed[k]);
    }
}
