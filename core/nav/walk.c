/* The walking law: the velocity that one wants who walks among others (core/walking.md). Twelve
   directions about the way are judged side by side; each loop over lanes is one vector operation.

   The law of a direction e: those ahead leave a gap g, and the speed keeps the time gap T to it;
   those who cross and walls leave a free path, which is not used up within a fixed time. Of the
   directions the one that gets on best is taken. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/elementary.h"
#include "base/random.h"
#include "geom/polygon.h"
#include "nav/internal.h"
#include "nav/walk.h"

enum { LANES = 12 }; /* directions; the last repeats the one before */
static const float PI = 3.14159265f;
static const float AS_FREE = 0.98f;   /* of the wanted speed: who gets that far goes straight on */
static const float WORST = -0.2f;     /* m/s: no direction is judged worse */
static const float SIGHT = 1.5f;      /* m: so near, walls hide people */
static const double KNOTS = 2.0;      /* s between the knots of what a time gap wanders by */
static const uint32_t CROWD_RANK = 3; /* the neighbour whose distance tells how crowded it is */

/* Cosine and sine of 0 and +-15 to +-75 degrees from the way, left positive. */
static const float COSINE[LANES] = {1.0f,        0.96592583f, 0.96592583f, 0.86602540f,
                                    0.86602540f, 0.70710678f, 0.70710678f, 0.5f,
                                    0.5f,        0.25881905f, 0.25881905f, 0.25881905f};
static const float SINE[LANES] = {0.0f,         0.25881905f, -0.25881905f, 0.5f,
                                  -0.5f,        0.70710678f, -0.70710678f, 0.86602540f,
                                  -0.86602540f, 0.96592583f, -0.96592583f, -0.96592583f};

typedef struct Walk {
    JoxNav *nav;
    JoxAgents *agents;
    const JoxNeighbours *neighbours;
    const JoxWalkLaw *law;
    uint64_t seed;
    double time, interval;    /* s: now; since people planned last */
    float rise, fall, course; /* shares of the way gone in `interval` */
    float start, stop;        /* likewise, of a change of velocity */
} Walk;

/* One who walks, and what each direction allows: the speed, and what it is worth, m/s. */
typedef struct Walker {
    uint32_t i;
    JoxV2 at, aim;
    float speed, gap; /* m/s wanted; time gap, s */
    float side;       /* share of the time gap that is spared beside others */
    float x[LANES], y[LANES], allowed[LANES], worth[LANES];
} Walker;

static float clamp01(float x) {
    return jox_clampf(x, 0.0f, 1.0f);
}

/* ---- a person's temper ---- */

/* The crowd makes people eager, between the bounds of their haste. */
static float eagerness_wanted(const Walk *w, uint32_t i) {
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

static double knot(const Walk *w, uint32_t id, double number) {
    return 2.0 * jox_random_unit(w->seed, id, (uint64_t)number, JOX_DRAW_GAP, 0) - 1.0;
}

/* A person's time gap at present, s: it differs between people, wanders in time, and falls with
   eagerness. */
static float time_gap(const Walk *w, uint32_t i) {
    const JoxAgents *a = w->agents;
    const JoxWalkLaw *law = w->law;
    double number = floor(w->time / KNOTS), share = w->time / KNOTS - number;
    double wander =
        knot(w, a->id[i], number) * (1.0 - share) + knot(w, a->id[i], number + 1) * share;
    double own = 2.0 * jox_random_unit(w->seed, a->id[i], 0, JOX_DRAW_GAP, 1) - 1.0;
    double gap =
        (double)a->param[JOX_PARAM_time_gap][i] * (1.0 - law->gap_eager * (double)a->eager[i]);
    return (float)(gap * (1.0 + law->gap_spread * own) * jox_exp(law->gap_noise * wander));
}

/* ---- what others and walls allow ---- */

static void take_least(Walker *p, const float *allowed, const float *worth) {
    for (int k = 0; k < LANES; k++) {
        p->allowed[k] = p->allowed[k] < allowed[k] ? p->allowed[k] : allowed[k];
        p->worth[k] = p->worth[k] < worth[k] ? p->worth[k] : worth[k];
    }
}

/* Speed that keeps the time gap to one ahead at `along`, `aside` of a direction. They take up
   `length` along the way, less towards their sides; their own speed along it is foreseen for a
   share of the time gap. */
static inline float follow_at(const Walker *p, float share, float width, float length, float along,
                              float aside, float ahead_speed) {
    float q = fabsf(aside) / width, q2 = q * q, rest = 1.0f - q2 * q2 * q2;
    float round = sqrtf(rest > 0.0f ? rest : 0.0f);
    float gap = p->gap * (1.0f - p->side * q), foreseen = share * gap;
    float ahead = ahead_speed > 0.0f ? ahead_speed : 0.0f;
    float speed = (along - length * round + foreseen * ahead) / (gap + foreseen);
    return q < 1.0f && along > 0.0f ? speed : INFINITY;
}

static void follow(const Walk *w, Walker *p, uint32_t j, JoxV2 d, float width, int lanes) {
    const JoxAgents *a = w->agents;
    const float *radius = a->param[JOX_PARAM_radius];
    const float room = 1.0f - (float)w->law->room_eager * a->eager[p->i];
    const float length = (float)w->law->length * room * (radius[p->i] + radius[j]);
    const float share = (float)w->law->ahead_share, vx = a->vx[j], vy = a->vy[j];
    float allowed[LANES];
    for (int k = 0; k < lanes; k++)
        allowed[k] = follow_at(p, share, width, length, d.x * p->x[k] + d.y * p->y[k],
                               p->x[k] * d.y - p->y[k] * d.x, vx * p->x[k] + vy * p->y[k]);
    if (lanes == LANES) {
        take_least(p, allowed, allowed);
    } else {
        p->allowed[0] = jox_minf(p->allowed[0], allowed[0]);
        p->worth[0] = jox_minf(p->worth[0], allowed[0]);
    }
}

/* Who crosses leaves a free path, and a direction in which the two would meet soon is worth less.
 */
static void cross(const Walk *w, Walker *p, uint32_t j, JoxV2 d, float width, int lanes) {
    const JoxAgents *a = w->agents;
    const float width2 = width * width, per_time = 1.0f / (float)w->law->cross_time;
    const float worth_time = p->speed / (float)w->law->contact_time;
    const float apart2 = jox_maxf(jox_length2(d) - width2, 0.0f);
    float allowed[LANES], worth[LANES];
    for (int k = 0; k < lanes; k++) {
        float along = d.x * p->x[k] + d.y * p->y[k], aside = p->x[k] * d.y - p->y[k] * d.x;
        float rest = width2 - aside * aside;
        float path = (along - sqrtf(rest > 0.0f ? rest : 0.0f)) * per_time;
        allowed[k] = rest > 0.0f && along > 0.0f ? path : INFINITY;
        /* When their discs meet, at the wanted speed and the other's present velocity. */
        float ux = p->speed * p->x[k] - a->vx[j], uy = p->speed * p->y[k] - a->vy[j];
        float closing = d.x * ux + d.y * uy, u2 = ux * ux + uy * uy;
        float meets = closing * closing - u2 * apart2;
        float time = (closing - sqrtf(meets > 0.0f ? meets : 0.0f)) / (u2 > 1e-6f ? u2 : 1e-6f);
        float soon = meets > 0.0f && closing > 0.0f ? worth_time * time : INFINITY;
        worth[k] = soon < allowed[k] ? soon : allowed[k];
    }
    if (lanes == LANES) {
        take_least(p, allowed, worth);
    } else {
        p->allowed[0] = jox_minf(p->allowed[0], allowed[0]);
        p->worth[0] = jox_minf(p->worth[0], worth[0]);
    }
}

/* The free path of a disc before a wall's edge is not used up within `wall_time`. Straight on the
   way itself leads round walls. */
static void mind_edge(const Walk *w, Walker *p, JoxV2 from, JoxV2 to, float keep) {
    const float per_time = 1.0f / (float)w->law->wall_time, keep2 = keep * keep;
    const JoxV2 edge = jox_sub(to, from), near = jox_segment_nearest(from, to, p->at);
    const JoxV2 off = jox_sub(near, p->at), a = jox_sub(from, p->at), b = jox_sub(to, p->at);
    const float reach = keep + p->speed / per_time;
    if (jox_length2(off) > reach * reach)
        return;
    const float length = jox_length(edge), side = jox_det(edge, a) > 0.0f ? 1.0f : -1.0f;
    const JoxV2 t = jox_unit(edge), n = jox_scale(jox_left(t), side); /* towards the wall's line */
    const float far = jox_dot(a, n), from_t = jox_dot(a, t);
    const bool inside = jox_length2(off) < keep2;
    float allowed[LANES];
    for (int k = 0; k < LANES; k++) {
        float ex = p->x[k], ey = p->y[k], best = INFINITY;
        /* The line at the distance `keep`, between the ends. */
        float toward = ex * n.x + ey * n.y, path = (far - keep) / (toward > 1e-4f ? toward : 1e-4f);
        float at = path * (ex * t.x + ey * t.y) - from_t;
        best = toward > 1e-4f && at >= 0.0f && at <= length ? path : best;
        /* The discs about the ends. */
        float a_along = a.x * ex + a.y * ey, b_along = b.x * ex + b.y * ey;
        float a_rest = keep2 - (jox_length2(a) - a_along * a_along);
        float b_rest = keep2 - (jox_length2(b) - b_along * b_along);
        float a_path = a_along - sqrtf(a_rest > 0.0f ? a_rest : 0.0f);
        float b_path = b_along - sqrtf(b_rest > 0.0f ? b_rest : 0.0f);
        best = a_rest > 0.0f && a_along > 0.0f && a_path < best ? a_path : best;
        best = b_rest > 0.0f && b_along > 0.0f && b_path < best ? b_path : best;
        best = inside ? (off.x * ex + off.y * ey > 0.0f ? 0.0f : INFINITY) : best;
        allowed[k] = best > 0.0f ? best * per_time : 0.0f;
    }
    allowed[0] = INFINITY;
    take_least(p, allowed, allowed);
}

static void mind_walls(const Walk *w, Walker *p) {
    uint32_t count;
    const JoxWallGrid *grid = &w->nav->grid;
    const uint32_t *edges = grid->first ? jox_wall_grid_at(grid, p->at, &count) : NULL;
    const float keep = (float)w->law->wall_radius * w->agents->param[JOX_PARAM_radius][p->i];
    for (uint32_t k = 0; edges && k < count; k++) {
        const JoxWallVertex *from = &grid->walls->vertices[edges[k]];
        mind_edge(w, p, from->point, grid->walls->vertices[from->next].point, keep);
    }
}

static void mind_people(const Walk *w, Walker *p, int lanes) {
    const JoxAgents *a = w->agents;
    const JoxNeighbours *n = w->neighbours;
    for (uint32_t k = 0; k < n->count[p->i]; k++) {
        uint32_t j = n->index[jox_neighbour_at(n, p->i, k)];
        if (a->tags[j] & a->ignore[p->i])
            continue;
        JoxV2 d = jox_offset(a, p->i, j);
        JoxMinds minds = jox_minds(a, p->i, j, d);
        if (minds == JOX_MINDS_NOT)
            continue;
        if (w->nav->grid.first && jox_wall_grid_separates(&w->nav->grid, p->at, jox_add(p->at, d)))
            continue;
        float width = jox_walk_width(w->law, a, p->i, j, minds);
        if (minds == JOX_MINDS_AHEAD)
            follow(w, p, j, d, width, lanes);
        else
            cross(w, p, j, d, width, lanes);
    }
}

/* ---- the choice ---- */

static void clear(Walker *p, int lanes) {
    for (int k = 0; k < lanes; k++) {
        p->x[k] = COSINE[k] * p->aim.x - SINE[k] * p->aim.y;
        p->y[k] = COSINE[k] * p->aim.y + SINE[k] * p->aim.x;
        p->allowed[k] = p->worth[k] = p->speed;
    }
}

/* The direction that gets on best: straight on where that is as good as free, else by what each is
   worth along the way, less what turning costs. */
static int choose(const Walk *w, Walker *p) {
    const JoxWalkLaw *law = w->law;
    const float turn = (float)law->turn_cost * p->speed, right = (float)law->right * p->speed;
    const float *cx = w->agents->course_x, *cy = w->agents->course_y;
    clear(p, 1);
    mind_people(w, p, 1);
    if (p->worth[0] >= AS_FREE * p->speed)
        return 0;
    clear(p, LANES);
    mind_people(w, p, LANES);
    mind_walls(w, p);
    float most = -INFINITY;
    int best = 0;
    for (int k = 0; k < LANES; k++) {
        float turned = 1.0f - (p->x[k] * cx[p->i] + p->y[k] * cy[p->i]);
        float worth = jox_maxf(p->worth[k], WORST) * COSINE[k] - turn * turned;
        worth += SINE[k] < 0.0f ? right : 0.0f;
        if (worth > most) {
            most = worth;
            best = k;
        }
    }
    return best;
}

/* People get up to a speed slowly, and slow down and turn fast; turning by up to 60 degrees costs
   them no speed. */
static JoxV2 approach(const Walk *w, JoxV2 velocity, JoxV2 e, float speed) {
    float now = jox_length(velocity), along = jox_dot(velocity, e);
    float kept = now > 0.0f ? now * clamp01(2.0f * along / now) : 0.0f;
    JoxV2 aside = jox_sub(velocity, jox_scale(e, along));
    kept += (speed - kept) * (speed > kept ? w->start : w->stop);
    return jox_add(jox_scale(e, kept), jox_scale(aside, 1.0f - w->stop));
}

static void turn_course(const Walk *w, uint32_t i, JoxV2 e) {
    JoxAgents *a = w->agents;
    JoxV2 course = {a->course_x[i], a->course_y[i]};
    course = jox_unit(jox_add(course, jox_scale(jox_sub(e, course), w->course)));
    if (course.x == 0.0f && course.y == 0.0f)
        course = e;
    a->course_x[i] = course.x;
    a->course_y[i] = course.y;
}

static void walk_one(const Walk *w, uint32_t i) {
    JoxAgents *a = w->agents;
    float wanted = eagerness_wanted(w, i);
    a->eager[i] += (wanted - a->eager[i]) * (wanted > a->eager[i] ? w->rise : w->fall);
    JoxV2 preferred = {a->pref_x[i], a->pref_y[i]};
    Walker p = {.i = i,
                .at = {a->x[i], a->y[i]},
                .aim = {a->aim_x[i], a->aim_y[i]},
                .speed = jox_length(preferred),
                .gap = time_gap(w, i),
                .side = (float)w->law->gap_side * a->eager[i]};
    JoxV2 velocity = {0.0f, 0.0f};
    if (p.speed > 0.0f) {
        int k = choose(w, &p);
        JoxV2 e = {p.x[k], p.y[k]};
        velocity = approach(w, (JoxV2){a->vx[i], a->vy[i]}, e, jox_maxf(p.allowed[k], 0.0f));
        turn_course(w, i, e);
    }
    a->walk_x[i] = velocity.x;
    a->walk_y[i] = velocity.y;
}

static void walk_range(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    const Walk *w = context;
    for (uint32_t i = begin; i < end; i++)
        if (jox_walks(w->agents, i))
            walk_one(w, i);
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
    const JoxWalkLaw *law = &nav->walk;
    float reach;
    if (!aim_all(agents, law, &reach) || !plans)
        return;
    if (nav->grid.walls)
        jox_wall_grid_fit(&nav->grid, reach);
    Walk walk = {.nav = nav,
                 .agents = agents,
                 .neighbours = neighbours,
                 .law = law,
                 .seed = seed,
                 .time = time,
                 .interval = interval,
                 .rise = share_of(interval, law->eager_rise),
                 .fall = share_of(interval, law->eager_fall),
                 .course = share_of(interval, law->course_time),
                 .start = jox_minf(1.0f, (float)(interval / law->start_time)),
                 .stop = jox_minf(1.0f, (float)(interval / law->stop_time))};
    jox_parallel_for(pool, agents->count, JOX_NAV_GRAIN, walk_range, &walk);
}
