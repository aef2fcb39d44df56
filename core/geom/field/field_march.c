/* The marching: times from the goal outwards, each node from the triangles of its finished
   neighbours (Sethian 1999, as for unstructured meshes). */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "geom/field/field_parts.h"

static const float SEED_CELLS = 4.5f; /* so near the goal, ways are straight and lengths exact */
static const float STRAIGHT = 0.97f;  /* cosine of how far two slopes may differ */
static const float SEED_MOST = 5.0f;  /* m: a goal in a wall is reached from so far */

/* ---- a heap of cells by time; of equal times the lesser cell first, so that there is one order
   ---- */

enum { CHILDREN = 4, NOT_YET = -1, FINISHED = -2 };

typedef struct Heap {
    uint64_t *items; /* time and cell: see key_of */
    int *place;      /* of a cell in items, or what of the above */
    int count;
} Heap;

/* Numbers of at least 0 are in the order of their bits. */
static uint64_t key_of(float time, int cell) {
    uint32_t bits;
    memcpy(&bits, &time, sizeof bits);
    return (uint64_t)bits << 32 | (uint32_t)cell;
}

static int cell_of(uint64_t key) {
    return (int)(uint32_t)key;
}

static void put(Heap *h, int at, uint64_t key) {
    h->items[at] = key;
    h->place[cell_of(key)] = at;
}

static void rise(Heap *h, int cell, float time) {
    const uint64_t key = key_of(time, cell);
    int at = h->place[cell] == NOT_YET ? h->count++ : h->place[cell];
    JOX_ASSERT(at >= 0);
    for (; at > 0 && key < h->items[(at - 1) / CHILDREN]; at = (at - 1) / CHILDREN)
        put(h, at, h->items[(at - 1) / CHILDREN]);
    put(h, at, key);
}

static int pop(Heap *h) {
    const uint64_t top = h->items[0], last = h->items[--h->count];
    int at = 0;
    for (;;) {
        const int first = CHILDREN * at + 1, end = first + CHILDREN;
        uint64_t least = last;
        int child = at;
        for (int k = first; k < end && k < h->count; k++) {
            child = h->items[k] < least ? k : child;
            least = h->items[k] < least ? h->items[k] : least;
        }
        if (child == at)
            break;
        put(h, at, least);
        at = child;
    }
    if (h->count > 0)
        put(h, at, last);
    h->place[cell_of(top)] = FINISHED;
    JOX_ASSERT(h->count == 0 || top < h->items[0]);
    return cell_of(top);
}

/* ---- seeds ---- */

/* A way to a cell's node, along `way`, which is `far` long. */
static inline void offer(JoxFieldWork *w, Heap *h, int cell, float time, float length, JoxV2 way,
                         float far) {
    if (!(time < w->time[cell]))
        return;
    JOX_ASSERT(w->walled.node[cell] < JOX_FIELD_BLOCKED && time >= 0.0f && length >= 0.0f);
    const JoxV2 unit = jox_scale(way, 1.0f / far);
    w->time[cell] = time;
    w->f->cells[cell].length = length;
    w->f->cells[cell].x = unit.x;
    w->f->cells[cell].y = unit.y;
    rise(h, cell, time);
}

/* Whether a goal's nearest point is seen from p. A polygon may lie along a wall: then the point is
   on it, and what counts is whether the polygon's inside is seen. */
static bool sees_goal(const JoxFieldWork *w, const JoxPlace *place, JoxV2 goal, JoxV2 p) {
    const float inside = 0.03f; /* m */
    if (!jox_field_sees(w, goal, p, 0.85f * w->f->clearance))
        return false;
    JoxV2 beyond = jox_add(goal, jox_scale(jox_unit(jox_sub(goal, p)), inside));
    return place->kind != JOX_PLACE_POLYGON || jox_field_sees(w, p, beyond, 0.0f);
}

/* Seeds the nodes within `reach` of a place that is no set; returns how many see it. Those that do
   not are seeded too once `blindly`. */
static int seed_within(JoxFieldWork *w, Heap *h, const JoxPlace *place, float reach, bool blindly) {
    JoxField *f = w->f;
    JoxV2 low, high;
    jox_bounds(place->points, jox_place_goal_points(place), &low, &high);
    int c0, c1, r0, r1, seeds = 0;
    jox_field_span(low.x - reach, high.x + reach, f->low.x, f->size, f->columns, &c0, &c1);
    jox_field_span(low.y - reach, high.y + reach, f->low.y, f->size, f->rows, &r0, &r1);
    for (int r = r0; r <= r1; r++)
        for (int c = c0; c <= c1; c++) {
            int cell = r * f->columns + c;
            if (w->walled.node[cell] == JOX_FIELD_BLOCKED)
                continue;
            JoxV2 p = jox_field_node(w, cell), goal = jox_place_nearest(place, 0, p);
            float distance = jox_length(jox_sub(goal, p));
            if (distance > reach || (!blindly && !sees_goal(w, place, goal, p)))
                continue;
            seeds++;
            offer(w, h, cell, distance * w->slowness[cell], distance, jox_sub(goal, p),
                  jox_maxf(distance, JOX_FIELD_CLOSE * f->size));
        }
    return seeds;
}

static void seed(JoxFieldWork *w, Heap *h, const JoxPlace *places, uint32_t index) {
    const JoxPlace *place = &places[index];
    for (uint32_t k = 0; k < place->member_count; k++)
        seed(w, h, places, (uint32_t)place->members[k]);
    if (place->count == 0)
        return;
    float least = SEED_CELLS * w->f->size, most = jox_maxf(SEED_MOST, 2.0f * least);
    for (int blindly = 0; blindly < 2; blindly++)
        for (float reach = least; reach <= most; reach *= 1.25f)
            if (seed_within(w, h, place, reach, blindly) > 0)
                return;
}

/* ---- marching ---- */

/* The soonest way from node p by a point between two finished nodes a and b. */
static inline void by_side(JoxFieldWork *w, Heap *h, int cell, JoxV2 p, int a, int b) {
    JoxV2 from = jox_field_node(w, a), to = jox_field_node(w, b);
    JoxV2 side = jox_sub(to, from), out = jox_sub(p, from);
    float long2 = jox_length2(side), slowness = w->slowness[cell];
    float rise_ab = w->time[b] - w->time[a];
    /* The time rises linearly along the side; away from it, the way costs `slowness` a metre. The
       point of least time splits the side where the two balance. */
    float rest2 = slowness * slowness * long2 - rise_ab * rise_ab;
    if (!(rest2 > 0.0f))
        return;
    float along = jox_dot(out, side) - fabsf(jox_det(out, side)) * rise_ab / sqrtf(rest2);
    if (!(along > 0.0f && along < long2))
        return; /* the ends are tried on their own */
    float t = along / long2;
    if (!(t > 0.0f && t < 1.0f))
        return;
    JoxV2 way = jox_sub(jox_add(from, jox_scale(side, t)), p);
    float far = jox_length(way);
    float la = w->f->cells[a].length, lb = w->f->cells[b].length;
    offer(w, h, cell, w->time[a] + t * rise_ab + slowness * far, la + t * (lb - la) + far, way,
          far);
}

static void march(JoxFieldWork *w, Heap *h) {
    const JoxField *f = w->f;
    int steps[8];
    for (int k = 0; k < 8; k++)
        steps[k] = JOX_FIELD_RING[k][1] * f->columns + JOX_FIELD_RING[k][0];
    while (h->count > 0) {
        int i = pop(h);
        JoxV2 from = jox_field_node(w, i);
        for (int k = 0; k < 8; k++) {
            int j = i + steps[k];
            if (!(w->walled.links[i] >> k & 1) || h->place[j] == FINISHED)
                continue;
            JOX_ASSERT(j >= 0 && j < w->count && w->walled.links[j] >> ((k + 4) & 7) & 1);
            JoxV2 p = jox_field_node(w, j), way = jox_sub(from, p);
            float far = jox_length(way);
            offer(w, h, j, w->time[i] + w->slowness[j] * far, f->cells[i].length + far, way, far);
            int back = (k + 4) & 7, left = (back + 1) & 7, right = (back + 7) & 7;
            if (w->walled.corners[j] >> back & 1 && h->place[j + steps[left]] == FINISHED)
                by_side(w, h, j, p, i, j + steps[left]);
            if (w->walled.corners[j] >> right & 1 && h->place[j + steps[right]] == FINISHED)
                by_side(w, h, j, p, i, j + steps[right]);
        }
    }
}

/* Away from walls, directions become central differences of the times, which are more exact than
   the one-sided ones of the marching; not where ways from two sides meet, as a central difference
   there points at neither. */
static void straighten(JoxFieldWork *w) {
    JoxField *f = w->f;
    const float *t = w->time;
    int up = f->columns;
    for (int i = 0; i < w->count; i++) {
        JoxFieldCell *cell = &f->cells[i];
        if (w->walled.links[i] != 0xff || w->walled.corners[i] != 0xff ||
            jox_field_has_edges(w, i) || !(t[i] < INFINITY))
            continue;
        JoxV2 way = {2.0f * (t[i - 1] - t[i + 1]) + (t[i - 1 - up] - t[i + 1 - up]) +
                         (t[i - 1 + up] - t[i + 1 + up]),
                     2.0f * (t[i - up] - t[i + up]) + (t[i - up - 1] - t[i + up - 1]) +
                         (t[i - up + 1] - t[i + up + 1])};
        way = jox_unit(way);
        if (cell->length < SEED_CELLS * f->size ||
            jox_dot(way, (JoxV2){cell->x, cell->y}) < STRAIGHT)
            continue;
        cell->x = way.x;
        cell->y = way.y;
    }
}

void jox_field_march(JoxFieldWork *w, const JoxPlace *places, uint32_t place) {
    Heap heap = {.items = jox_alloc((size_t)w->count + 1, sizeof(uint64_t)),
                 .place = jox_alloc((size_t)w->count, sizeof(int))};
    for (int i = 0; i < w->count; i++) {
        heap.place[i] = NOT_YET;
        w->time[i] = INFINITY;
        w->f->cells[i].length = INFINITY;
    }
    seed(w, &heap, places, place);
    march(w, &heap);
    straighten(w);
    jox_free(heap.items);
    jox_free(heap.place);
}
