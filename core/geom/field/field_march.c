/* Fast marching: computes times from the goal outwards, each node from the triangles with its
   finished neighbours (Sethian 1999, as for unstructured meshes). */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "geom/field/field_front.h"
#include "geom/field/field_lifts.h"
#include "geom/field/field_sheets.h"

static const float SEED_CELLS = 4.5f; /* cells: so near the goal, ways are straight and lengths
                                         exact */
static const float STRAIGHT = 0.97f;  /* least cosine between two estimates of the direction */
static const float SEED_MOST = 5.0f;  /* m: greatest distance from which a goal inside a wall is
                                         reached */
/* In cells: a node is later by at least this much than a neighbour beside it, or across a corner.
   Exact would be the roots of 0.5 and of 2; these leave a margin for rounding. */
static const float LEAST_BESIDE = 0.69f, LEAST_ACROSS = 1.40f;
/* s per metre of cell size: beyond this time, rounding exceeds that margin. */
static const float MOST_TIME = 1e4f;
/* s per metre of cell size: time that the front sorts at once. Few cells in such a stretch are
   reached from each other. */
static const float STRETCH = 1.0f;

/* For functions with the number of a ring neighbour as argument: each call is compiled for its
   number. */
#define INLINE inline __attribute__((always_inline))

typedef struct March {
    JoxFieldWork *w;
    JoxFieldTwins twins;
    JoxFieldStops stops;
    int steps[8];   /* offset of the index from a cell to each ring neighbour */
    float least[2]; /* m: least advance by a neighbour beside it, across a corner */
    JoxFront front;
} March;

/* ---- seeds ---- */

/* Offers a node the straight way from the goal, along `way`. */
static void offer_goal(March *m, int cell, float distance, JoxV2 way) {
    const JoxField *f = m->w->f;
    JoxFrontNode *n = &m->front.nodes[cell];
    const float time = distance * n->slowness;
    if (!(time < n->time))
        return;
    JOX_ASSERT(m->w->walled.node[cell] < JOX_FIELD_BLOCKED && time >= 0.0f);
    const JoxV2 unit = jox_scale(way, 1.0f / jox_maxf(distance, JOX_FIELD_CLOSE * f->size));
    n->time = time;
    n->length = distance;
    n->ends = JOX_FRONT_GOAL;
    f->cells[cell].x = unit.x;
    f->cells[cell].y = unit.y;
    jox_front_reach(&m->front, cell);
}

/* Returns whether a goal's nearest point is visible from p. If a polygon lies along a wall, its
   nearest point is on the wall, and its inside must be visible. */
static bool sees_goal(const JoxFieldWork *w, const JoxPlace *place, JoxV2 goal, JoxV2 p) {
    const float inside = 0.03f; /* m */
    if (!jox_field_sees(w, goal, p, 0.85f * w->f->clearance))
        return false;
    JoxV2 beyond = jox_add(goal, jox_scale(jox_unit(jox_sub(goal, p)), inside));
    return !jox_place_is_area(place) || jox_field_sees(w, p, beyond, 0.0f);
}

/* Seeds the nodes within `reach` of a place that is no set, and returns their number. `blindly`:
   also nodes that do not see it. */
static int seed_within(March *m, const JoxPlace *place, float reach, bool blindly) {
    const JoxFieldWork *w = m->w;
    JoxField *f = w->f;
    JoxV2 low, high;
    jox_bounds(place->points, jox_place_goal_points(place), &low, &high);
    int c0, c1, r0, r1, seeds = 0;
    jox_field_span(low.x - reach, high.x + reach, f->low.x, f->size, f->columns, &c0, &c1);
    jox_field_span(low.y - reach, high.y + reach, f->low.y, f->size, f->rows, &r0, &r1);
    jox_field_keep_to_sheet(f, place->points[0].y, &r0, &r1);
    for (int r = r0; r <= r1; r++)
        for (int c = c0; c <= c1; c++) {
            int cell = r * f->columns + c;
            if (w->walled.node[cell] == JOX_FIELD_BLOCKED || m->front.nodes[cell].repeats)
                continue;
            JoxV2 p = jox_field_node(w, cell), goal = jox_place_nearest(place, 0, p);
            float distance = jox_length(jox_sub(goal, p));
            if (distance > reach || (!blindly && !sees_goal(w, place, goal, p)))
                continue;
            seeds++;
            offer_goal(m, cell, distance, jox_sub(goal, p));
        }
    return seeds;
}

static void seed_place(March *m, const JoxPlace *places, uint32_t index) {
    const JoxPlace *place = &places[index];
    for (uint32_t k = 0; k < place->member_count; k++)
        seed_place(m, places, (uint32_t)place->members[k]);
    if (place->count == 0)
        return;
    float least = SEED_CELLS * m->w->f->size, most = jox_maxf(SEED_MOST, 2.0f * least);
    for (int blindly = 0; blindly < 2; blindly++)
        for (float reach = least; reach <= most; reach *= 1.25f)
            if (seed_within(m, place, reach, blindly) > 0)
                return;
}

/* ---- marching ---- */

/* The quickest way to a node so far, with its numbers as bits. */
typedef struct Best {
    uint32_t time, share, ends;
} Best;

/* Selects without a branch, as the outcome cannot be predicted. */
static inline uint32_t select_bits(bool second, uint32_t a, uint32_t b) {
    return a ^ ((a ^ b) & -(uint32_t)second);
}

static inline uint32_t join_ends(int a, int b) {
    return (uint32_t)(a | b << 8);
}

static inline Best start_best(const JoxFrontNode *n) {
    return (Best){jox_float_bits(n->time), jox_float_bits(n->share), n->ends};
}

/* Replaces the best way by another one, if that counts and is quicker. */
static inline void keep_sooner(Best *best, bool counts, float time, float share, uint32_t ends) {
    const bool sooner = counts & (jox_float_bits(time) < best->time);
    best->time = select_bits(sooner, best->time, jox_float_bits(time));
    best->share = select_bits(sooner, best->share, jox_float_bits(share));
    best->ends = select_bits(sooner, best->ends, ends);
}

/* Tries the ways from node n through points between two finished neighbours, a and b. */
static inline void try_side(const March *m, const JoxFrontNode *n, int a, int b, Best *best) {
    const JoxFrontNode *from = n + m->steps[a], *to = n + m->steps[b];
    const JoxV2 side = {to->at[0] - from->at[0], to->at[1] - from->at[1]},
                out = {n->at[0] - from->at[0], n->at[1] - from->at[1]};
    const float long2 = jox_length2(side), slowness = n->slowness;
    const float rise = to->time - from->time;
    /* The time rises linearly along the side between them; away from it, the way costs `slowness`
       per metre. The quickest point is where the two balance. */
    const float rest2 = slowness * slowness * long2 - rise * rise;
    const float along = jox_dot(out, side) - fabsf(jox_det(out, side)) * rise / sqrtf(rest2);
    const float t = along / long2;
    const bool between = (rest2 > 0.0f) & (along > 0.0f) & (along < long2) & (t > 0.0f) &
                         (t < 1.0f); /* the ends are tried by themselves */
    const JoxV2 way = {from->at[0] + side.x * t - n->at[0], from->at[1] + side.y * t - n->at[1]};
    keep_sooner(best, between, from->time + t * rise + slowness * jox_length(way), t,
                join_ends(a, b));
}

/* Does the same for even nodes, with the same bits: `from` is beside n along an axis, and `to` is
   beside `from` across that axis. */
static INLINE void try_even_side(const JoxFrontNode *n, const JoxFrontNode *from,
                                 const JoxFrontNode *to, int axis, uint32_t ends, Best *best) {
    const float off = from->at[axis] - n->at[axis], base = n->at[!axis];
    const float side = to->at[!axis] - base, long2 = side * side, slowness = n->slowness;
    const float rise = to->time - from->time;
    const float rest2 = slowness * slowness * long2 - rise * rise;
    const float along = -(fabsf(off * side) * rise / sqrtf(rest2)), t = along / long2;
    const bool between =
        (rest2 > 0.0f) & (along > 0.0f) & (along < long2) & (t > 0.0f) & (t < 1.0f);
    const float across = base + side * t - base;
    const float far = sqrtf(off * off + across * across);
    keep_sooner(best, between, from->time + t * rise + slowness * far, t, ends);
}

static INLINE void store_best(March *m, JoxFrontNode *n, const Best *best) {
    if (best->time == jox_float_bits(n->time))
        return;
    n->time = jox_float_of(best->time);
    n->share = jox_float_of(best->share);
    n->ends = (uint16_t)best->ends;
    jox_front_reach(&m->front, (int)(n - m->front.nodes));
}

/* Offers node n the ways through its neighbour `back` on the ring, which was just finished;
   `finished`: neighbours finished before. */
static void reach_node(March *m, JoxFrontNode *n, int back, uint32_t finished) {
    const JoxFrontNode *from = n + m->steps[back];
    const int after = (back + 1) & 7, before = (back + 7) & 7;
    const float far = jox_length((JoxV2){from->at[0] - n->at[0], from->at[1] - n->at[1]});
    Best best = start_best(n);
    keep_sooner(&best, true, from->time + n->slowness * far, 0.0f, join_ends(back, back));
    if (n->corners >> back & finished >> after & 1)
        try_side(m, n, back, after, &best);
    if (n->corners >> before & finished >> before & 1)
        try_side(m, n, back, before, &best);
    store_best(m, n, &best);
}

/* Does the same for an even node and a neighbour beside it. */
static INLINE void reach_even_beside(March *m, JoxFrontNode *n, int back, uint32_t finished) {
    const JoxFrontNode *from = n + m->steps[back];
    const int after = (back + 1) & 7, before = (back + 7) & 7, axis = back >> 1 & 1;
    const float far = fabsf(from->at[axis] - n->at[axis]);
    Best best = start_best(n);
    keep_sooner(&best, true, from->time + n->slowness * far, 0.0f, join_ends(back, back));
    if (n->corners >> back & finished >> after & 1)
        try_even_side(n, from, n + m->steps[after], axis, join_ends(back, after), &best);
    if (n->corners >> before & finished >> before & 1)
        try_even_side(n, from, n + m->steps[before], axis, join_ends(back, before), &best);
    store_best(m, n, &best);
}

/* Does the same for an even node and a neighbour across a corner. */
static INLINE void reach_even_across(March *m, JoxFrontNode *n, int back) {
    const JoxFrontNode *from = n + m->steps[back];
    const float far = jox_length((JoxV2){from->at[0] - n->at[0], from->at[1] - n->at[1]});
    Best best = start_best(n);
    keep_sooner(&best, true, from->time + n->slowness * far, 0.0f, join_ends(back, back));
    store_best(m, n, &best);
}

/* Finishes a node, whose quickest way is known: computes its length and direction. */
static inline void finish_node(March *m, int cell) {
    JoxFrontNode *n = &m->front.nodes[cell];
    JoxFieldCell *out = &m->w->f->cells[cell];
    m->w->time[cell] = n->time;
    if (n->ends != JOX_FRONT_GOAL) {
        const JoxFrontNode *a = n + m->steps[n->ends & 0xff], *b = n + m->steps[n->ends >> 8];
        const float t = n->share;
        const JoxV2 way = {a->at[0] + (b->at[0] - a->at[0]) * t - n->at[0],
                           a->at[1] + (b->at[1] - a->at[1]) * t - n->at[1]};
        const float far = jox_length(way);
        const JoxV2 unit = jox_scale(way, 1.0f / far);
        n->length = a->length + t * (b->length - a->length) + far;
        if (m->w->f->first_stops)
            m->w->f->first_stops[cell] = m->w->f->first_stops[a - m->front.nodes];
        out->x = unit.x;
        out->y = unit.y;
    }
    out->length = n->length;
}

/* Offers ways to neighbour k of a node that was just finished, if it is one of the `open` ones.
   Ways that cannot be the quickest are skipped: an even node has none that gain less than
   LEAST_BESIDE or LEAST_ACROSS on a neighbour; and on the side between a neighbour across a corner
   and one beside the node that was finished before, the quickest point is the latter. Both need
   nodes that are finished in order of time and are not too late, which `plain` says. */
static INLINE void visit_neighbour(March *m, const JoxFrontNode *from, int k, uint32_t open,
                                   bool plain) {
    const int back = (k + 4) & 7;
    if (!(open >> k & 1))
        return;
    JoxFrontNode *n = &m->front.nodes[from - m->front.nodes + m->steps[k]];
    const uint32_t finished = n->finished;
    JOX_ASSERT(!n->is_done && n->links >> back & 1);
    n->finished = (uint8_t)(finished | 1u << back);
    if (!(plain && n->even))
        reach_node(m, n, back, finished);
    else if (n->time <= from->time + n->slowness * m->least[k & 1])
        return;
    else if (k & 1)
        reach_even_across(m, n, back);
    else
        reach_even_beside(m, n, back, finished);
}

/* Returns the first of the twins of a cell; they end where the cell changes. */
static const JoxFieldTwin *find_twins(const March *m, int of) {
    uint32_t low = 0, high = m->twins.count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (m->twins.items[middle].of < of)
            low = middle + 1;
        else
            high = middle;
    }
    return &m->twins.items[low];
}

/* Finishes the cells beyond seams that repeat one that was just finished. */
static void finish_twins(March *m, int of, bool plain) {
    const JoxFrontNode *from = &m->front.nodes[of];
    JoxField *f = m->w->f;
    for (const JoxFieldTwin *twin = find_twins(m, of);
         twin < m->twins.items + m->twins.count && twin->of == of; twin++) {
        JoxFrontNode *n = &m->front.nodes[twin->copy];
        n->time = from->time;
        n->length = from->length;
        n->is_done = true;
        m->w->time[twin->copy] = n->time;
        f->cells[twin->copy].length = n->length;
        f->cells[twin->copy].x = f->cells[of].x;
        f->cells[twin->copy].y = f->cells[of].y;
        if (f->first_stops)
            f->first_stops[twin->copy] = f->first_stops[of];
        for (int k = 0; k < 8; k++)
            if ((n->links & ~(uint32_t)n->finished) >> k & 1 && !(n + m->steps[k])->is_done)
                visit_neighbour(m, n, k, 1u << k, plain);
    }
}

/* Offers the ways into a lift at its other stops, once the way on from one is known. */
static void offer_rides(March *m, int cell) {
    JoxFieldRide ride = {.from = cell};
    while (jox_field_next_ride(m->w, &m->stops, &ride)) {
        JoxFrontNode *n = &m->front.nodes[ride.to];
        const float time = m->front.nodes[cell].time + ride.length;
        if (n->is_done || !(time < n->time))
            continue;
        n->time = time;
        n->length = m->front.nodes[cell].length + ride.length;
        n->ends = JOX_FRONT_GOAL;
        m->w->f->cells[ride.to].x = ride.in.x;
        m->w->f->cells[ride.to].y = ride.in.y;
        m->w->f->first_stops[ride.to] = ride.label;
        jox_front_reach(&m->front, ride.to);
    }
}

/* Lets cells that repeat others be reached by no neighbour: to their neighbours they count as
   finished, and have no time until they are. */
static void begin_twins(March *m) {
    for (uint32_t t = 0; t < m->twins.count; t++) {
        JoxFrontNode *n = &m->front.nodes[m->twins.items[t].copy];
        m->front.nodes[m->twins.items[t].of].is_copied = true;
        n->repeats = true;
        for (int k = 0; k < 8; k++)
            if (n->links >> k & 1)
                (n + m->steps[k])->finished |= (uint8_t)(1u << ((k + 4) & 7));
    }
}

/* Finishes nodes in order of time until none is left. */
static void march_all(March *m) {
    const float most = MOST_TIME * m->w->f->size;
    float latest = 0.0f;
    for (int i = jox_front_take(&m->front); i >= 0; i = jox_front_take(&m->front)) {
        const JoxFrontNode *n = &m->front.nodes[i];
        const bool plain = n->time >= latest && n->time < most;
        latest = jox_maxf(latest, n->time);
        finish_node(m, i);
        const uint32_t open = n->links & ~(uint32_t)n->finished;
        visit_neighbour(m, n, 0, open, plain);
        visit_neighbour(m, n, 1, open, plain);
        visit_neighbour(m, n, 2, open, plain);
        visit_neighbour(m, n, 3, open, plain);
        visit_neighbour(m, n, 4, open, plain);
        visit_neighbour(m, n, 5, open, plain);
        visit_neighbour(m, n, 6, open, plain);
        visit_neighbour(m, n, 7, open, plain);
        if (n->is_copied)
            finish_twins(m, i, plain);
        if (n->has_stop)
            offer_rides(m, i);
    }
}

/* Replaces directions away from walls by central differences of the times, which are more accurate
   than the one-sided differences of the marching. Not where ways from two sides meet, since a
   central difference points along neither. */
static void refine_directions(JoxFieldWork *w) {
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

static JoxFrontNode *make_front_nodes(const JoxFieldWork *w) {
    const JoxFieldWalled *of = &w->walled;
    JoxFrontNode *nodes = jox_alloc_aligned((size_t)w->count, sizeof *nodes);
    for (int i = 0; i < w->count; i++)
        nodes[i] = (JoxFrontNode){.at = {of->x[i], of->y[i]},
                                  .slowness = w->slowness[i],
                                  .time = INFINITY,
                                  .links = of->links[i],
                                  .corners = of->corners[i],
                                  .even = w->exact && of->even[i]};
    return nodes;
}

void jox_field_march(JoxFieldWork *w, const JoxPlace *places, uint32_t place) {
    const JoxField *f = w->f;
    March m = {.w = w};
    jox_front_begin(&m.front, make_front_nodes(w), w->count, STRETCH * f->size);
    m.least[0] = LEAST_BESIDE * f->size;
    m.least[1] = LEAST_ACROSS * f->size;
    for (int k = 0; k < 8; k++)
        m.steps[k] = JOX_FIELD_RING[k][1] * f->columns + JOX_FIELD_RING[k][0];
    for (int i = 0; i < w->count; i++) {
        w->time[i] = INFINITY;
        f->cells[i].length = INFINITY;
    }
    m.twins = jox_field_list_twins(w, true);
    begin_twins(&m);
    m.stops = jox_field_list_stops(w);
    for (uint32_t s = 0; s < m.stops.count; s++)
        m.front.nodes[m.stops.items[s].cell].has_stop = true;
    seed_place(&m, places, place);
    march_all(&m);
    refine_directions(w);
    for (uint32_t t = 0; t < m.twins.count; t++) { /* refined alike */
        const JoxFieldCell *of = &f->cells[m.twins.items[t].of];
        JoxFieldCell *copy = &f->cells[m.twins.items[t].copy];
        copy->x = of->x;
        copy->y = of->y;
    }
    jox_free(m.twins.items);
    jox_free(m.stops.items);
    jox_front_end(&m.front);
}
