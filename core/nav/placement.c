/* Frees agents that were born inside a wall or deep inside another agent, or that a wall came upon.
 */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "geom/polygon.h"
#include "geom/wall_way.h"
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

/* The searches about p for somebody as wide. */
static struct Searched *searched_about(const Occupied *t, JoxV2 p, float radius, bool beyond) {
    const int32_t x = (int32_t)floorf(p.x / NEARBY), y = (int32_t)floorf(p.y / NEARBY);
    struct Searched *s =
        &t->searched[((uint32_t)x * 73856093u ^ (uint32_t)y * 19349663u ^ beyond) % SEARCHES];
    if (s->x != x || s->y != y || s->beyond != beyond || s->radius > radius)
        *s = (struct Searched){x, y, radius, 0.0f, beyond};
    return s;
}

/* Where a search may end: `beyond` walls too, or beyond those of rings that are `passable`, which
   may be NULL. */
typedef struct Allowed {
    bool beyond;
    const bool *passable;
} Allowed;

static bool is_allowed(const JoxWallGrid *grid, JoxV2 p, JoxV2 q, Allowed allowed) {
    return allowed.beyond || !grid->walls ||
           !jox_walls_lie_between(grid->walls, p, q, allowed.passable);
}

/* Spots on a spiral about p, half a radius apart: the first that is free and allowed. */
static bool find_spot(Occupied *t, const JoxWallGrid *grid, JoxV2 p, float radius, Allowed allowed,
                      JoxV2 *spot) {
    struct Searched own = {0}; /* about passable walls nobody else searches alike */
    struct Searched *s = allowed.passable ? &own : searched_about(t, p, radius, allowed.beyond);
    const float step = jox_maxf(radius * 0.5f, 0.05f);
    float angle = 0.0f, distance = jox_maxf(step, s->reached - 2.0f * NEARBY);
    for (; distance < FARTHEST && t->work < MOST_WORK; t->work += t->each) {
        *spot =
            (JoxV2){p.x + distance * (float)jox_cos(angle), p.y + distance * (float)jox_sin(angle)};
        if (is_free(t, grid, *spot, radius) && is_allowed(grid, p, *spot, allowed))
            break;
        angle += step / distance;
        distance += step * step / (6.2831853f * distance);
    }
    s->reached = distance;
    return distance < FARTHEST && t->work < MOST_WORK;
}

/* Puts an agent on a spot that was found for it, or counts it as stuck. */
static void relocate(JoxNav *nav, JoxAgents *a, uint32_t i, bool found, JoxV2 spot,
                     JoxPlacement *result) {
    if (!found) {
        if (result->stuck++ == 0)
            result->first_stuck = i;
        return;
    }
    result->farthest =
        jox_maxf(result->farthest, jox_length(jox_sub(spot, jox_v2(a->x[i], a->y[i]))));
    a->x[i] = spot.x;
    a->y[i] = spot.y;
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

/* Where somebody may be put who has none yet: on this side of every wall, else beyond. */
static bool find_any_spot(Occupied *t, const JoxWallGrid *grid, JoxV2 p, float radius,
                          JoxV2 *spot) {
    return find_spot(t, grid, p, radius, (Allowed){0}, spot) ||
           find_spot(t, grid, p, radius, (Allowed){.beyond = true}, spot);
}

bool jox_nav_free_spot(JoxNav *nav, const JoxAgents *a, uint32_t agent, JoxV2 *at) {
    Occupied t = begin_spots(nav, a);
    const float radius = jox_param(a, JOX_PARAM_radius, agent);
    const JoxV2 p = *at;
    JOX_ASSERT(agent < a->count);
    for (uint32_t i = 0; i < a->count; i++)
        if (i != agent)
            occupy(&t, i);
    const bool good =
        is_free(&t, &nav->grid, p, radius) || find_any_spot(&t, &nav->grid, p, radius, at);
    end_spots(&t);
    return good;
}

JoxPlacement jox_nav_place_newborn(JoxNav *nav, JoxAgents *a, uint32_t first_id) {
    JoxPlacement result = {0};
    Occupied t = begin_spots(nav, a);
    for (uint32_t i = 0; i < a->count; i++) /* those who stay take their spots first */
        if (a->id[i] < first_id)
            occupy(&t, i);
    for (uint32_t rank = 0; rank < a->count; rank++) {
        const uint32_t i = a->by_rank[rank];
        const JoxV2 p = {a->x[i], a->y[i]};
        const float radius = jox_param(a, JOX_PARAM_radius, i);
        JoxV2 spot;
        if (a->id[i] < first_id)
            continue;
        if (!is_free(&t, &nav->grid, p, radius)) {
            const bool found = find_any_spot(&t, &nav->grid, p, radius, &spot);
            relocate(nav, a, i, found, spot, &result);
        }
        start_at(a, i);
        occupy(&t, i);
    }
    JOX_ASSERT(result.moved + result.stuck <= a->count);
    JOX_ASSERT(result.farthest <= FARTHEST * 1.001f);
    end_spots(&t);
    return result;
}

/* ---- walls that came ---- */

/* The solids of which an edge came. */
typedef struct NewSolids {
    struct NewSolid {
        JoxV2 low, high; /* m: a box about it */
        uint32_t ring;
    } * items;
    uint32_t count;
    bool *holds; /* by ring: that it came over the agent in question */
} NewSolids;

static NewSolids list_new_solids(const JoxWalls *walls) {
    NewSolids solids = {.items = jox_alloc((size_t)walls->ring_count + 1, sizeof *solids.items),
                        .holds = jox_alloc((size_t)walls->ring_count + 1, sizeof *solids.holds)};
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        struct NewSolid *solid = &solids.items[solids.count];
        bool came = false;
        *solid = (struct NewSolid){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}, r};
        for (uint32_t i = ring->first; i < ring->first + ring->count; i++) {
            const JoxV2 p = walls->vertices[i].point;
            came |= walls->vertices[i].came;
            solid->low = (JoxV2){jox_minf(solid->low.x, p.x), jox_minf(solid->low.y, p.y)};
            solid->high = (JoxV2){jox_maxf(solid->high.x, p.x), jox_maxf(solid->high.y, p.y)};
        }
        solids.count += ring->solid && came;
    }
    return solids;
}

static void free_new_solids(NewSolids *solids) {
    jox_free(solids->items);
    jox_free(solids->holds);
}

/* Marks the new solids that hold a point, and says whether there is one. */
static bool mark_holding(const JoxWalls *walls, NewSolids *solids, JoxV2 p) {
    bool any = false;
    for (uint32_t s = 0; s < solids->count; s++) {
        const struct NewSolid *solid = &solids->items[s];
        const bool holds = jox_is_within(p, solid->low, solid->high) &&
                           jox_walls_ring_holds(walls, solid->ring, p);
        solids->holds[solid->ring] = holds;
        any |= holds;
    }
    return any;
}

/* Whether an edge that came is nearer to p than `clear`, and no older one lies before it. */
static bool is_on_new_edge(const JoxWallGrid *grid, JoxV2 p, float clear) {
    uint32_t count;
    const uint32_t *edges = jox_wall_grid_at(grid, p, &count);
    const JoxWallVertex *vertices = grid->walls->vertices;
    for (uint32_t e = 0; e < count; e++) {
        const JoxWallVertex *v = &vertices[edges[e]];
        const JoxV2 q = jox_segment_nearest(v->point, vertices[v->next].point, p);
        bool seen = v->came && jox_length2(jox_sub(p, q)) < clear * clear;
        for (uint32_t o = 0; o < count && seen; o++) {
            const JoxWallVertex *other = &vertices[edges[o]];
            seen = other->came ||
                   !jox_edge_lies_between(other->point, vertices[other->next].point, p, q);
        }
        if (seen)
            return true;
    }
    return false;
}

/* Clears one agent: to the nearest free spot with no wall between, but for the solids that came
   over its centre, out of which it has to go. */
static void clear_agent(Occupied *t, JoxNav *nav, JoxAgents *a, uint32_t i, NewSolids *solids,
                        JoxPlacement *result) {
    const JoxWalls *walls = nav->grid.walls;
    const JoxV2 p = {a->x[i], a->y[i]};
    const bool inside = mark_holding(walls, solids, p);
    const Allowed allowed = {.passable = inside ? solids->holds : NULL};
    JoxV2 spot;
    const bool found =
        find_spot(t, &nav->grid, p, jox_param(a, JOX_PARAM_radius, i), allowed, &spot);
    JOX_ASSERT(!found || !jox_walls_lie_between(walls, p, spot, allowed.passable));
    relocate(nav, a, i, found, spot, result);
    start_at(a, i);
}

JoxPlacement jox_nav_clear_new_walls(JoxNav *nav, JoxAgents *a) {
    JoxPlacement result = {0};
    const JoxWalls *walls = nav->grid.walls;
    if (!walls || walls->count == 0 || a->count == 0)
        return result;
    Occupied t = begin_spots(nav, a);
    NewSolids solids = list_new_solids(walls);
    bool *moves = jox_alloc(a->count, sizeof *moves);
    for (uint32_t i = 0; i < a->count; i++) { /* those who stay take their spots first */
        const JoxV2 p = {a->x[i], a->y[i]};
        moves[i] = mark_holding(walls, &solids, p) ||
                   is_on_new_edge(&nav->grid, p, STANDING * jox_param(a, JOX_PARAM_radius, i));
        if (!moves[i])
            occupy(&t, i);
    }
    for (uint32_t rank = 0; rank < a->count; rank++) {
        const uint32_t i = a->by_rank[rank];
        if (!moves[i])
            continue;
        clear_agent(&t, nav, a, i, &solids, &result);
        occupy(&t, i);
    }
    JOX_ASSERT(result.moved + result.stuck <= a->count);
    end_spots(&t);
    free_new_solids(&solids);
    jox_free(moves);
    return result;
}
