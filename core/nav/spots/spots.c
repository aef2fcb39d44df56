#include "nav/spots/spots.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "base/number/elementary.h"
#include "base/number/pi.h"
#include "geom/polygon.h"
#include "geom/wall_way.h"

static const float DEEP = 0.25f;     /* share of the smaller diameter that may overlap */
static const float TOUCHING = 0.99f; /* radii: least distance from a wall */
static const float NEARBY =
    0.25f; /* m: searches about points in one square of this size share their results */
static const float FAR = 1.0f; /* m: a shared search goes on only from this distance on */
enum { SEARCHES = 8192, FEW = 1000 };

static uint32_t hash_cell(int32_t x, int32_t y) {
    return (uint32_t)x * 73856093u ^ (uint32_t)y * 19349663u;
}

static uint32_t bucket_of(const JoxSpots *t, int32_t x, int32_t y) {
    const uint32_t h = hash_cell(x, y);
    return (h ^ h >> 15) & t->mask;
}

static int32_t find_cell(const JoxSpots *t, float at) {
    return (int32_t)floorf(at / t->cell);
}

JoxSpots jox_spots_begin(JoxWallGrid *grid, const JoxAgents *a, float widest) {
    for (uint32_t i = 0; i < a->count; i++)
        widest = jox_maxf(widest, jox_param(a, JOX_PARAM_radius, i));
    if (grid->walls)
        jox_wall_grid_fit(grid, jox_maxf(widest, 1.0f));
    JoxSpots t = {.agents = a,
                  .widest = widest,
                  .cell = 2.0f * jox_maxf(widest, 0.1f),
                  .mask = 1023,
                  .blocking = UINT32_MAX};
    while (t.mask < a->capacity)
        t.mask = t.mask * 2 + 1;
    t.next_capacity = a->capacity + 1;
    t.head = jox_alloc((size_t)t.mask + 1, sizeof *t.head);
    t.next = jox_alloc(t.next_capacity, sizeof *t.next);
    t.searched = jox_alloc(SEARCHES, sizeof *t.searched);
    memset(t.head, 0xff, ((size_t)t.mask + 1) * sizeof *t.head);
    return t;
}

void jox_spots_free(JoxSpots *t) {
    jox_free(t->head);
    jox_free(t->next);
    jox_free(t->searched);
    jox_free(t->edges);
    *t = (JoxSpots){0};
}

void jox_spots_enter(JoxSpots *t, uint32_t i) {
    const JoxAgents *a = t->agents;
    const uint32_t b = bucket_of(t, find_cell(t, a->x[i]), find_cell(t, a->y[i]));
    JOX_ASSERT(i < a->count && b <= t->mask && t->head[b] != i);
    JOX_RESERVE(t->next, t->next_capacity, i + 1);
    t->next[i] = t->head[b];
    t->head[b] = i;
}

/* Returns whether a disc overlaps an agent of a cell by more than DEEP. */
static bool is_taken_in_cell(const JoxSpots *t, int32_t x, int32_t y, JoxV2 p, float radius) {
    const JoxAgents *a = t->agents;
    for (uint32_t j = t->head[bucket_of(t, x, y)]; j != JOX_NO_INDEX; j = t->next[j]) {
        const float other = jox_param(a, JOX_PARAM_radius, j);
        const float least = radius + other - DEEP * 2.0f * jox_minf(radius, other);
        if (jox_length2((JoxV2){a->x[j] - p.x, a->y[j] - p.y}) < least * least)
            return true;
    }
    return false;
}

/* Tests the cell of p first, which mostly decides for a spot that is taken. */
static bool is_taken_at(const JoxSpots *t, JoxV2 p, float radius) {
    static const int8_t AROUND[9][2] = {{0, 0},   {-1, 0}, {1, 0},  {0, -1}, {0, 1},
                                        {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    const int32_t x = find_cell(t, p.x), y = find_cell(t, p.y);
    for (int k = 0; k < 9; k++)
        if (is_taken_in_cell(t, x + AROUND[k][0], y + AROUND[k][1], p, radius))
            return true;
    return false;
}

/* Returns whether a disc overlaps an agent, or an image of one, by more than DEEP. */
static bool is_spot_taken(const JoxSpots *t, JoxV2 p, float radius) {
    const JoxV2 period = t->agents->period, low = t->agents->origin;
    if (!(period.x > 0.0f || period.y > 0.0f))
        return is_taken_at(t, p, radius);
    const JoxV2 reach = {t->cell, t->cell}, within = jox_agents_wrapped(t->agents, p);
    const JoxV2 from = jox_sub(low, reach), to = jox_add(jox_add(low, period), reach);
    const int turns_x = period.x > 0.0f, turns_y = period.y > 0.0f;
    for (int x = -turns_x; x <= turns_x; x++)
        for (int y = -turns_y; y <= turns_y; y++) {
            const JoxV2 image = jox_add(within, (JoxV2){(float)x * period.x, (float)y * period.y});
            const bool beside = (turns_x && (image.x < from.x || image.x > to.x)) ||
                                (turns_y && (image.y < from.y || image.y > to.y));
            if (!beside && is_taken_at(t, image, radius))
                return true;
        }
    return false;
}

/* Returns whether a disc overlaps an agent beyond a seam by more than DEEP. */
static bool is_taken_beyond_seam(const JoxSpots *t, JoxV2 p, float radius) {
    const JoxStoreys *s = t->agents->storeys;
    const JoxSheet *sheet = &s->sheets[jox_sheet_of(s, p.y)];
    const JoxV2 plan = jox_in_plan(s, p);
    for (uint32_t k = sheet->first_seam; k < sheet->first_seam + sheet->seam_count; k++) {
        const JoxSeam *seam = &s->seams[k];
        const JoxV2 nearest = jox_segment_nearest(seam->a, seam->b, plan);
        if (jox_length2(jox_sub(nearest, plan)) < t->cell * t->cell &&
            is_taken_at(t, jox_v2(p.x, p.y + seam->shift), radius))
            return true;
    }
    return false;
}

bool jox_spots_is_free(const JoxSpots *t, const JoxWallGrid *grid, JoxV2 p, float radius) {
    JOX_ASSERT(2.0f * jox_maxf(radius, t->widest) <= t->cell * 1.001f);
    if (t->agents->storeys &&
        (!jox_is_floor(t->agents->storeys, p) || is_taken_beyond_seam(t, p, radius)))
        return false;
    return !is_spot_taken(t, p, radius) && !jox_wall_grid_is_near(grid, p, TOUCHING * radius);
}

/* ---- walls between ---- */

/* Lists the edges that may lie between a wish's point and a spot. */
static void list_edges(JoxSpots *t, const JoxWalls *walls, const JoxSpotWish *wish) {
    const float far =
        JOX_SPOTS_FARTHEST + 2.0f * NEARBY; /* the spiral may start from a point nearby */
    const JoxV2 reach = {far, far};
    const JoxV2 low = jox_sub(wish->at, reach), high = jox_add(wish->at, reach);
    t->edge_count = 0;
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        for (uint32_t v = ring->first; v < ring->first + ring->count; v++) {
            const JoxV2 a = walls->vertices[v].point;
            const JoxV2 b = walls->vertices[walls->vertices[v].next].point;
            if ((wish->passable && wish->passable[r]) || !jox_boxes_meet(a, b, low, high))
                continue;
            JOX_RESERVE(t->edges, t->edge_capacity, t->edge_count + 1);
            t->edges[t->edge_count++] = v;
        }
    }
}

static bool lies_between(const JoxWalls *walls, uint32_t edge, JoxV2 p, JoxV2 q) {
    const JoxWallVertex *v = &walls->vertices[edge];
    return jox_edge_lies_between(v->point, walls->vertices[v->next].point, p, q);
}

/* Returns whether a wall lies between; tests the edge that blocked the last spot first. */
static bool is_behind_edge(JoxSpots *t, const JoxWalls *walls, JoxV2 p, JoxV2 q) {
    if (t->blocking != UINT32_MAX && lies_between(walls, t->blocking, p, q))
        return true;
    for (uint32_t e = 0; e < t->edge_count; e++)
        if (lies_between(walls, t->edges[e], p, q)) {
            t->blocking = t->edges[e];
            return true;
        }
    return false;
}

/* ---- the search ---- */

static bool is_same_point(JoxV2 p, JoxV2 q) {
    return p.x == q.x && p.y == q.y;
}

/* Returns the record of searches about a point. */
static JoxSearched *find_search_record(const JoxSpots *t, const JoxSpotWish *wish) {
    const int32_t x = (int32_t)floorf(wish->at.x / NEARBY);
    const int32_t y = (int32_t)floorf(wish->at.y / NEARBY);
    return &t->searched[(hash_cell(x, y) ^ wish->kind * 2654435761u) % SEARCHES];
}

/* Returns where a search begins: where the last one about this point ended, as spots that were
   taken then are still taken. A search about a point nearby, on the same side of all walls, goes on
   with the other's spiral once that is far from both. */
static JoxSearched resume_search(const JoxSearched *last, const JoxWallGrid *grid,
                                 const JoxSpotWish *wish, float step) {
    JoxSearched own = {wish->at, wish->radius, 0.0f, step, wish->kind, true, false};
    if (wish->passable || !last->known || last->kind != wish->kind || last->radius > wish->radius)
        return own;
    if (is_same_point(last->at, wish->at) && last->radius == wish->radius)
        return *last;
    if (floorf(last->at.x / NEARBY) != floorf(wish->at.x / NEARBY) ||
        floorf(last->at.y / NEARBY) != floorf(wish->at.y / NEARBY) ||
        (grid->walls && jox_walls_lie_between(grid->walls, last->at, wish->at, NULL)))
        return own;
    return last->distance > FAR || last->failed ? *last : own;
}

/* Returns how far a search looks, m: no farther than a corner of its place. */
static float limit_distance(const JoxSpotWish *wish) {
    if (!wish->contains)
        return JOX_SPOTS_FARTHEST;
    const JoxV2 corner = {jox_maxf(wish->at.x - wish->low.x, wish->high.x - wish->at.x),
                          jox_maxf(wish->at.y - wish->low.y, wish->high.y - wish->at.y)};
    return jox_minf(JOX_SPOTS_FARTHEST, jox_length(corner));
}

static bool is_in_place(const JoxSpots *t, const JoxSpotWish *wish, JoxV2 spot) {
    const JoxStoreys *s = t->agents->storeys;
    if (s && jox_sheet_of(s, spot.y) != jox_sheet_of(s, wish->at.y))
        return false;
    return !wish->contains ||
           (jox_is_within(spot, wish->low, wish->high) && wish->contains(wish->place, spot));
}

/* Returns whether a free spot can be reached: no wall lies between, and no solid covers it.
 *listed: the edges are listed. */
static bool is_reachable(JoxSpots *t, const JoxWalls *walls, const JoxSpotWish *wish, JoxV2 spot,
                         bool *listed) {
    if (!walls)
        return true;
    if (!*listed)
        list_edges(t, walls, wish);
    *listed = true;
    return !is_behind_edge(t, walls, wish->at, spot) && !jox_walls_contain(walls, spot);
}

bool jox_spots_find(JoxSpots *t, const JoxWallGrid *grid, const JoxSpotWish *wish, JoxV2 *spot) {
    const float radius = wish->radius, step = jox_maxf(radius * 0.5f, 0.05f);
    const JoxWalls *walls = grid->walls && grid->walls->count > 0 ? grid->walls : NULL;
    JoxSearched *kept = find_search_record(t, wish);
    JoxSearched s = resume_search(kept, grid, wish, step);
    bool found = false, listed = false;
    const float farthest = limit_distance(wish);
    for (uint32_t looked = 0; s.distance < farthest && !s.failed; looked++, t->looked++) {
        if (t->looked >= JOX_SPOTS_MOST && looked >= FEW)
            break;
        *spot = (JoxV2){s.at.x + s.distance * (float)jox_cos(s.angle),
                        s.at.y + s.distance * (float)jox_sin(s.angle)};
        found = is_in_place(t, wish, *spot) && jox_spots_is_free(t, grid, *spot, radius) &&
                is_reachable(t, walls, wish, *spot, &listed);
        if (found)
            break;
        s.angle += step / s.distance;
        s.distance += step * step / ((float)JOX_TURN * s.distance);
    }
    t->blocking = UINT32_MAX;
    s.failed |= s.distance >= farthest;
    t->ended = !found && !s.failed;
    if (!wish->passable)
        *kept = s;
    return found;
}
