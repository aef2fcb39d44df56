/* The walking law in plain C, for one agent: people's tempers, and what walls allow. The kernel
   (walk_wide.c) does all else. */
#include <math.h>

#include "base/number/elementary.h"
#include "base/number/random.h"
#include "geom/polygon.h"
#include "nav/kernels.h"

enum { EDGE_LANES = 12 }; /* directions, for whole vectors; the last repeats the one before */
static const float PI = 3.14159265f;
static const uint32_t CROWD_RANK = 3; /* the neighbour whose distance tells how crowded it is */

/* Of 0 and +-15 to +-75 degrees. */
const float jox_walk_cosine[JOX_WALK_DIRECTIONS] = {
    1.0f,        0.96592583f, 0.96592583f, 0.86602540f, 0.86602540f, 0.70710678f,
    0.70710678f, 0.5f,        0.5f,        0.25881905f, 0.25881905f};
const float jox_walk_sine[JOX_WALK_DIRECTIONS] = {
    0.0f,         0.25881905f, -0.25881905f, 0.5f,        -0.5f,       0.70710678f,
    -0.70710678f, 0.86602540f, -0.86602540f, 0.96592583f, -0.96592583f};

static float clamp01(float x) {
    return jox_clampf(x, 0.0f, 1.0f);
}

/* ---- a person's temper ---- */

/* The crowd makes people eager, between the bounds of their haste. */
static float eagerness_wanted(const JoxWalk *w, uint32_t i) {
    const JoxAgents *a = w->agents;
    const JoxWalkLaw *law = w->law;
    float density = 0.0f, haste = a->param[JOX_PARAM_haste][i];
    if (w->neighbours->count[i] > CROWD_RANK) {
        float d2 = w->neighbours->distance2[jox_neighbour_at(w->neighbours, i, CROWD_RANK)];
        density = (float)(CROWD_RANK + 1) / (PI * jox_maxf(d2, 1e-4f));
    }
    float normal = (float)law->eager_normal, most = (float)law->eager_most;
    float keen = clamp01(2.0f * haste - 1.0f); /* beyond normal */
    float least = normal * clamp01(2.0f * haste) + (1.0f - normal) * keen;
    most += (1.0f - most) * keen;
    return jox_maxf(least, jox_minf(most, clamp01(density - (float)law->crowded)));
}

/* From -1 to 1. */
static double drawn(const JoxWalk *w, uint32_t id, uint32_t sub, uint64_t moment) {
    return 2.0 * jox_random_share(jox_random_of(w->stream, id, sub, moment)) - 1.0;
}

static float time_gap(const JoxWalk *w, uint32_t i) {
    const JoxAgents *a = w->agents;
    const JoxWalkLaw *law = w->law;
    const uint32_t id = a->id[i];
    double wander = drawn(w, id, 0, w->knots[0]) * (1.0 - w->between) +
                    drawn(w, id, 0, w->knots[1]) * w->between;
    double own = drawn(w, id, 1, w->own);
    double gap =
        (double)a->param[JOX_PARAM_time_gap][i] * (1.0 - law->gap_eager * (double)a->eager[i]);
    return (float)(gap * (1.0 + law->gap_spread * own) * jox_exp(law->gap_noise * wander));
}

float jox_walk_temper(const JoxWalk *w, uint32_t i) {
    float *eager = w->agents->eager, wanted = eagerness_wanted(w, i);
    eager[i] += (wanted - eager[i]) * (wanted > eager[i] ? w->rise : w->fall);
    return time_gap(w, i);
}

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
