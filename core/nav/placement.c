/* Frees agents that were born inside a wall or deep inside another agent, or that a wall came upon.
 */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "geom/polygon.h"
#include "nav/internal.h"

static const float DEEP = 0.25f;     /* share of the smaller diameter that may overlap */
static const float TOUCHING = 0.99f; /* radii from a wall */
static const float STANDING = 0.7f;  /* the same of those whom the next step does not push out */
static const float FARTHEST = 25.0f; /* m: how far a free spot is looked for */
static const float NEARBY = 0.25f;   /* m: who is born so near to another searches where it ended */
enum { SEARCHES = 1024, MOST_WORK = 20000000 };

/* A hash of cells to the agents that already have their spot. */
typedef struct Occupied {
    const JoxAgents *agents;
    float cell;
    uint32_t mask;
    uint32_t *head, *next; /* by bucket; by agent index */
    /* How far about a square of NEARBY searches have found everything taken. Spots only fill, so
       that the next one need not begin at its own feet. */
    struct Searched {
        int32_t x, y;
        float radius, reached; /* m */
        bool beyond;           /* walls, too */
    } * searched;
    uint32_t work, each; /* done, and of looking at one spot: crowds that nowhere fit must end */
} Occupied;

static uint32_t bucket_of(const Occupied *t, int32_t x, int32_t y) {
    uint32_t h = (uint32_t)x * 73856093u ^ (uint32_t)y * 19349663u;
    return (h ^ h >> 15) & t->mask;
}

static int32_t cell_of(const Occupied *t, float at) {
    return (int32_t)floorf(at / t->cell);
}

static void occupy(Occupied *t, uint32_t i) {
    uint32_t b = bucket_of(t, cell_of(t, t->agents->x[i]), cell_of(t, t->agents->y[i]));
    JOX_ASSERT(b <= t->mask && t->head[b] != i);
    t->next[i] = t->head[b];
    t->head[b] = i;
}

/* Within `clear` m of a wall, or inside one. */
static bool in_wall(const JoxWallGrid *grid, JoxV2 p, float clear) {
    if (!grid->walls || grid->walls->count == 0)
        return false;
    uint32_t count;
    const uint32_t *edges = jox_wall_grid_at(grid, p, &count);
    for (uint32_t i = 0; i < count; i++) {
        const JoxWallVertex *v = &grid->walls->vertices[edges[i]];
        JoxV2 q = jox_segment_nearest(v->point, grid->walls->vertices[v->next].point, p);
        if (jox_length2(jox_sub(p, q)) < clear * clear)
            return true;
    }
    return jox_walls_contain(grid->walls, p);
}

static bool is_free(const Occupied *t, const JoxWallGrid *grid, JoxV2 p, float radius) {
    const JoxAgents *a = t->agents;
    int32_t cx = cell_of(t, p.x), cy = cell_of(t, p.y);
    for (int32_t y = cy - 1; y <= cy + 1; y++)
        for (int32_t x = cx - 1; x <= cx + 1; x++)
            for (uint32_t j = t->head[bucket_of(t, x, y)]; j != JOX_NO_INDEX; j = t->next[j]) {
                float other = jox_param(a, JOX_PARAM_radius, j);
                float least = radius + other - DEEP * 2.0f * jox_minf(radius, other);
                if (jox_length2((JoxV2){a->x[j] - p.x, a->y[j] - p.y}) < least * least)
                    return false;
            }
    return !in_wall(grid, p, TOUCHING * radius);
}

/* Whether no wall lies between two points, but for those that p itself is closer to than `near`. */
static bool sees(const JoxWalls *walls, JoxV2 p, JoxV2 q, float near) {
    for (uint32_t e = 0; walls && e < walls->count; e++) {
        JoxV2 a = walls->vertices[e].point, b = walls->vertices[walls->vertices[e].next].point;
        if (jox_segment_crossing(a, b, p, q) != 0 &&
            jox_length2(jox_sub(p, jox_segment_nearest(a, b, p))) >= near * near)
            return false;
    }
    return true;
}

/* The searches about p for somebody as wide. */
static struct Searched *searched_about(const Occupied *t, JoxV2 p, float radius, bool beyond) {
    const int32_t x = (int32_t)floorf(p.x / NEARBY), y = (int32_t)floorf(p.y / NEARBY);
    struct Searched *s =
        &t->searched[((uint32_t)x * 73856093u ^ (uint32_t)y * 19349663u ^ beyond) % SEARCHES];
    if (s->x != x || s->y != y || s->beyond != beyond || s->radius > radius)
        *s = (struct Searched){x, y, radius, 0.0f, beyond};
    return s;
}

/* Spots on a spiral about p, half a radius apart, the first free one that is not beyond walls other
   than those nearer to p than `near`; INFINITY: it may lie beyond any. */
static bool find_spot(Occupied *t, const JoxWallGrid *grid, JoxV2 p, float radius, float near,
                      JoxV2 *spot) {
    struct Searched *s = searched_about(t, p, radius, near == INFINITY);
    const float step = jox_maxf(radius * 0.5f, 0.05f);
    float angle = 0.0f, distance = jox_maxf(step, s->reached - 2.0f * NEARBY);
    for (; distance < FARTHEST && t->work < MOST_WORK; t->work += t->each) {
        *spot =
            (JoxV2){p.x + distance * (float)jox_cos(angle), p.y + distance * (float)jox_sin(angle)};
        if (is_free(t, grid, *spot, radius) &&
            (near == INFINITY || sees(grid->walls, p, *spot, near)))
            break;
        angle += step / distance;
        distance += step * step / (6.2831853f * distance);
    }
    s->reached = distance;
    return distance < FARTHEST && t->work < MOST_WORK;
}

/* Looks for a free spot for an agent that has none where it is. Who has been born stays on that
   side of every wall; one that a wall came upon may go to either side of it. */
static void relocate(Occupied *t, JoxNav *nav, JoxAgents *a, uint32_t i, bool born,
                     JoxPlacement *result) {
    JoxV2 p = {a->x[i], a->y[i]}, spot;
    float radius = jox_param(a, JOX_PARAM_radius, i);
    if (!find_spot(t, &nav->grid, p, radius, born ? 0.0f : TOUCHING * radius, &spot) &&
        !find_spot(t, &nav->grid, p, radius, INFINITY, &spot)) {
        if (result->stuck++ == 0)
            result->first_stuck = i;
        return;
    }
    a->x[i] = spot.x;
    a->y[i] = spot.y;
    result->farthest = jox_maxf(result->farthest, jox_length(jox_sub(spot, p)));
    result->moved++;
    nav->drift = jox_drift_unknown(); /* the order in memory no longer follows space */
}

static void start_at(JoxAgents *a, uint32_t i) {
    a->prev_x[i] = a->still_x[i] = a->x[i];
    a->prev_y[i] = a->still_y[i] = a->y[i];
}

/* Spots for people as wide as these are, of whom nobody has one yet. */
static Occupied begin_spots(JoxNav *nav, const JoxAgents *a) {
    float widest = 0.0f;
    for (uint32_t i = 0; i < a->count; i++)
        widest = jox_maxf(widest, jox_param(a, JOX_PARAM_radius, i));
    if (nav->grid.walls)
        jox_wall_grid_fit(&nav->grid, jox_maxf(widest, 1.0f));
    Occupied t = {.agents = a, .cell = 2.0f * jox_maxf(widest, 0.1f), .mask = 1023, .each = 4};
    if (nav->grid.walls) /* whether a spot lies in one asks all of them */
        t.each += nav->grid.walls->count / 32;
    while (t.mask < a->count)
        t.mask = t.mask * 2 + 1;
    t.head = jox_alloc((size_t)t.mask + 1, sizeof *t.head);
    t.next = jox_alloc((size_t)a->count + 1, sizeof *t.next);
    t.searched = jox_alloc(SEARCHES, sizeof *t.searched);
    memset(t.head, 0xff, ((size_t)t.mask + 1) * sizeof *t.head);
    return t;
}

static void end_spots(Occupied *t) {
    jox_free(t->head);
    jox_free(t->next);
    jox_free(t->searched);
}

bool jox_nav_free_spot(JoxNav *nav, const JoxAgents *a, uint32_t agent, JoxV2 *at) {
    Occupied t = begin_spots(nav, a);
    const float radius = jox_param(a, JOX_PARAM_radius, agent);
    const JoxV2 p = *at;
    JOX_ASSERT(agent < a->count);
    for (uint32_t i = 0; i < a->count; i++)
        if (i != agent)
            occupy(&t, i);
    const bool good = is_free(&t, &nav->grid, p, radius) ||
                      find_spot(&t, &nav->grid, p, radius, 0.0f, at) ||
                      find_spot(&t, &nav->grid, p, radius, INFINITY, at);
    end_spots(&t);
    return good;
}

JoxPlacement jox_nav_resolve_placement(JoxNav *nav, JoxAgents *a, uint32_t first_id,
                                       bool walls_came) {
    JoxPlacement result = {0};
    Occupied t = begin_spots(nav, a);
    bool *moves = jox_alloc((size_t)a->count + 1, sizeof *moves);
    for (uint32_t i = 0; i < a->count; i++) { /* those who stay take their spots first */
        JoxV2 p = {a->x[i], a->y[i]};
        moves[i] = a->id[i] >= first_id;
        if (walls_came && !moves[i])
            moves[i] = in_wall(&nav->grid, p, STANDING * jox_param(a, JOX_PARAM_radius, i));
        if (!moves[i])
            occupy(&t, i);
    }
    for (uint32_t rank = 0; rank < a->count; rank++) {
        uint32_t i = a->by_rank[rank], id = a->id[i];
        if (!moves[i])
            continue;
        JoxV2 p = {a->x[i], a->y[i]};
        if (id < first_id || !is_free(&t, &nav->grid, p, jox_param(a, JOX_PARAM_radius, i)))
            relocate(&t, nav, a, i, id >= first_id, &result);
        start_at(a, i);
        occupy(&t, i);
    }
    JOX_ASSERT(result.moved + result.stuck <= a->count);
    JOX_ASSERT(result.farthest <= FARTHEST * 1.001f);
    end_spots(&t);
    jox_free(moves);
    return result;
}
