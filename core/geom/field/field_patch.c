/* Patches: nine samples in each cell at a wall, each directed by the nodes that it sees. Samples
   that see none (in crevices) follow a neighbour that does; samples in solids lead out. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "geom/field/field_parts.h"

/* UNREACHABLE: no way leads from there; ON_EDGE: on an edge, on neither of its sides. */
typedef enum { UNKNOWN, FOUND, UNREACHABLE, SOLID, ON_EDGE } State;

typedef struct Patching {
    JoxFieldWork *w;
    uint8_t *states;  /* State of each sample */
    int32_t *towards; /* per sample: the farthest sample that it follows in a straight line */
} Patching;

/* ---- one sample ---- */

/* The node of the patch's own cell, or of a cell on its ring, as samples read it. */
typedef struct Near {
    int cell; /* -1: beyond the border, or blocked */
    bool reached;
    JoxV2 at, way, unit; /* m; direction, and direction with length 1 */
    float length;        /* m */
} Near;
enum { NEAR = 3, NEAR_MIDDLE = 4 }; /* nodes per row; index of the own node */

typedef struct Blend {
    JoxV2 way;
    float length, weight;
    bool unreachable; /* a visible node has no way to the goal */
} Blend;

/* Lists the nodes of a cell and its ring. */
static void list_near_nodes(const JoxFieldWork *w, int column, int row, Near near[NEAR * NEAR]) {
    const JoxField *f = w->f;
    for (int k = -1; k < 8; k++) {
        const int right = k < 0 ? 0 : JOX_FIELD_RING[k][0], up = k < 0 ? 0 : JOX_FIELD_RING[k][1];
        const int cell = k < 0 ? row * f->columns + column : jox_field_next_to(f, column, row, k);
        Near *n = &near[NEAR_MIDDLE + NEAR * up + right];
        n->cell = cell < 0 || w->walled.node[cell] == JOX_FIELD_BLOCKED ? -1 : cell;
        n->reached = n->cell >= 0 && w->time[cell] < INFINITY;
        if (!n->reached)
            continue;
        n->at = jox_field_node(w, cell);
        n->way = (JoxV2){f->cells[cell].x, f->cells[cell].y};
        n->unit = jox_unit(n->way);
        n->length = f->cells[cell].length;
    }
}

/* Interpolates the way from a point between those of the four nodes around it that it sees. */
static Blend interpolate_sample(const Near *near, const JoxFieldSpot *spot, JoxFieldSight sight) {
    const JoxV2 p = jox_field_spot_at(spot);
    Blend m = {.unreachable = false};
    for (int k = 0; k < 4; k++) {
        if (!(sight >> k & 1))
            continue;
        const int right = spot->x->first + (k & 1) - spot->column;
        const int up = spot->y->first + (k >> 1) - spot->row;
        const Near *n = &near[NEAR_MIDDLE + NEAR * up + right];
        JOX_ASSERT(n->cell >= 0);
        if (!n->reached) {
            m.unreachable = true;
            continue;
        }
        /* inlined: jox_field_about, jox_field_slope */
        const float weight = spot->x->share[k & 1] * spot->y->share[k >> 1];
        const float slope = jox_dot(n->unit, jox_sub(p, n->at));
        m.way = jox_add(m.way, jox_scale(n->way, weight));
        m.length += weight * (n->length - slope);
        m.weight += weight;
    }
    if (m.weight > 0.0f) {
        m.way = jox_scale(m.way, 1.0f / m.weight);
        m.length = jox_maxf(0.0f, m.length / m.weight);
    }
    return m;
}

/* Returns whether a sample sees a node: that of its own cell (`place` 0), or of ring neighbour
   `place - 1`. */
static bool sees_node(const JoxFieldWork *w, const JoxFieldSpot *spot, int node, int place,
                      JoxFieldSight *sight) {
    const JoxV2 p = jox_field_spot_at(spot);
    if (!(*sight & (JoxFieldSight)JOX_SIGHT_KNOWN << place)) {
        *sight |= (JoxFieldSight)JOX_SIGHT_KNOWN << place;
        if (jox_field_sees_near(w, spot->cell, p, jox_field_node(w, node),
                                JOX_FIELD_KEEP * w->f->clearance))
            *sight |= (JoxFieldSight)JOX_SIGHT_SEEN << place;
    }
    return *sight & (JoxFieldSight)JOX_SIGHT_SEEN << place;
}

/* Finds the quickest way through one of the visible nodes on the ring or in the own cell; false if
   none is visible. */
static bool find_way_by_node(const JoxFieldWork *w, const JoxFieldSpot *spot, JoxFieldSight *sight,
                             Blend *m) {
    const JoxField *f = w->f;
    const JoxV2 p = jox_field_spot_at(spot);
    float best = INFINITY;
    for (int k = -1; k < 8; k++) {
        int other = k < 0 ? spot->cell : jox_field_next_to(f, spot->column, spot->row, k);
        if (other < 0 || w->walled.node[other] == JOX_FIELD_BLOCKED)
            continue;
        JoxV2 way = jox_sub(jox_field_node(w, other), p);
        float far = jox_length(way), time = w->time[other] + far * w->slowness[other];
        bool reached = time < INFINITY;
        if ((reached && time >= best) || (!reached && m->unreachable) ||
            !sees_node(w, spot, other, k + 1, sight))
            continue;
        m->unreachable = m->unreachable || !reached;
        if (!reached)
            continue;
        best = time;
        m->length = f->cells[other].length + far;
        m->way = far > 0.01f * f->size ? jox_scale(way, 1.0f / far)
                                       : (JoxV2){f->cells[other].x, f->cells[other].y};
    }
    return best < INFINITY;
}

static void set_sample(JoxFieldPatch *patch, int s, JoxV2 way, float length) {
    patch->x[s] = way.x;
    patch->y[s] = way.y;
    patch->length[s] = length;
}

/* Returns whether an interpolated way leads on, not into a wall or corner. */
static bool is_way_open(const JoxFieldWork *w, const JoxFieldSpot *spot, const Blend *m,
                        JoxFieldSight sight) {
    const JoxField *f = w->f;
    const JoxV2 p = jox_field_spot_at(spot);
    const float along = jox_length(m->way), goal = f->clearance + f->size;
    if (!(m->weight > 0.0f && along > (m->length < goal ? JOX_FIELD_ARRIVED : 0.2f)))
        return false;
    if (sight & JOX_SIGHT_OPEN)
        return true;
    const float look = jox_minf(JOX_FIELD_AHEAD * f->size, m->length);
    const JoxV2 ahead = jox_add(p, jox_scale(m->way, look / along));
    return jox_field_sees_near(w, spot->cell, p, ahead,
                               m->length < goal ? 0.0f : JOX_FIELD_KEEP * f->clearance);
}

/* Finds the way of one sample, and returns its state. */
static State direct_sample(const JoxFieldWork *w, JoxFieldPatch *patch, const Near *near,
                           const JoxFieldSpot *spot, JoxFieldSight *seen) {
    const JoxField *f = w->f;
    const JoxFieldSight sight = *seen;
    const int s = spot->sample;
    patch->length[s] = INFINITY;
    if (sight & JOX_SIGHT_DEEP)
        return UNKNOWN;
    if (sight & JOX_SIGHT_SOLID)
        return SOLID;
    const JoxV2 off = {patch->x[s], patch->y[s]};
    set_sample(patch, s, (JoxV2){0.0f, 0.0f}, INFINITY);
    if (patch->on_edge >> s & 1)
        return ON_EDGE;
    Blend m = interpolate_sample(near, spot, sight);
    if (m.weight > 0.0f && jox_length(m.way) < JOX_FIELD_ARRIVED && m.length < f->size) {
        set_sample(patch, s, (JoxV2){0.0f, 0.0f}, m.length);
        return FOUND;
    }
    if (!is_way_open(w, spot, &m, sight) && !find_way_by_node(w, spot, seen, &m))
        return m.unreachable ? UNREACHABLE : UNKNOWN;
    m.way = jox_unit(m.way);
    if (sight & JOX_SIGHT_BY_WALL && m.length > f->clearance + f->size)
        m.way = jox_unit(jox_add(m.way, off));
    set_sample(patch, s, m.way, m.length);
    return FOUND;
}

static void direct_patch(Patching *g, uint32_t patch) {
    const JoxFieldWork *w = g->w;
    const size_t first = (size_t)patch * JOX_FIELD_SAMPLES;
    const JoxFieldSpot corner = jox_field_spot(w, w->walled.patched[patch], 0);
    Near near[NEAR * NEAR];
    list_near_nodes(w, corner.column, corner.row, near);
    for (int s = 0; s < JOX_FIELD_SAMPLES; s++) {
        JoxFieldSpot spot = corner;
        spot.sample = s;
        spot.x += s % JOX_FIELD_SIDE;
        spot.y += s / JOX_FIELD_SIDE;
        g->states[first + (size_t)s] = (uint8_t)direct_sample(w, &w->f->patches[patch], near, &spot,
                                                              &w->walled.sight[first + (size_t)s]);
    }
}

/* ---- samples that see no node ---- */

/* Returns the neighbour of a sample on one of four sides, -1 if its cell has no patch. */
static int32_t find_adjacent_sample(const Patching *g, int32_t sample, int side) {
    const JoxField *f = g->w->f;
    int32_t patch = sample / JOX_FIELD_SAMPLES;
    int s = sample % JOX_FIELD_SAMPLES, cell = g->w->walled.patched[patch];
    int x = s % JOX_FIELD_SIDE + JOX_FIELD_RING[2 * side][0];
    int y = s / JOX_FIELD_SIDE + JOX_FIELD_RING[2 * side][1];
    if (x < 0 || y < 0 || x == JOX_FIELD_SIDE || y == JOX_FIELD_SIDE) {
        int other = jox_field_next(f, cell, 2 * side);
        if (other < 0 || f->cells[other].patch < 0)
            return -1;
        patch = f->cells[other].patch;
        x = (x + JOX_FIELD_SIDE) % JOX_FIELD_SIDE;
        y = (y + JOX_FIELD_SIDE) % JOX_FIELD_SIDE;
    }
    return patch * JOX_FIELD_SAMPLES + y * JOX_FIELD_SIDE + x;
}

static JoxV2 locate_sample(const Patching *g, int32_t sample) {
    return jox_field_sample(g->w->f, g->w->walled.patched[sample / JOX_FIELD_SAMPLES],
                            sample % JOX_FIELD_SAMPLES);
}

static bool is_in_solid(const Patching *g, int32_t sample) {
    return g->w->walled.solid[g->w->walled.patched[sample / JOX_FIELD_SAMPLES]] >>
               sample % JOX_FIELD_SAMPLES &
           1;
}

static bool sees_adjacent(const Patching *g, int32_t j, int32_t i) {
    const int cell = g->w->walled.patched[j / JOX_FIELD_SAMPLES];
    return jox_field_sees_near(g->w, cell, locate_sample(g, j), locate_sample(g, i), 0.0f);
}

/* Makes sample j follow i, or directly the sample that i follows if nothing is between them; adds a
   direction off walls. */
static void follow_sample(Patching *g, int32_t j, int32_t i) {
    JoxField *f = g->w->f;
    JoxV2 p = locate_sample(g, j), near_at = p;
    int32_t to = g->towards[i];
    if (!is_in_solid(g, j) && !jox_field_sees(g->w, p, locate_sample(g, to), 0.0f))
        to = i;
    g->towards[j] = to;
    g->states[j] = g->states[i];
    if (g->states[i] == UNREACHABLE)
        return;
    JoxV2 way = jox_sub(locate_sample(g, to), p);
    float far = jox_length(way);
    JOX_ASSERT(far > 0.0f);
    const JoxFieldPatch *led = &f->patches[to / JOX_FIELD_SAMPLES];
    JoxFieldPatch *patch = &f->patches[j / JOX_FIELD_SAMPLES];
    way = jox_scale(way, 1.0f / far);
    float near = jox_field_nearest(f, patch->first, patch->first + patch->count, p, &near_at, NULL);
    if (!is_in_solid(g, j) && near < f->clearance)
        way = jox_unit(
            jox_add(way, jox_scale(jox_sub(p, near_at), (1.0f - near / f->clearance) / near)));
    set_sample(patch, j % JOX_FIELD_SAMPLES, way, led->length[to % JOX_FIELD_SAMPLES] + far);
}

static bool can_lead(State state) {
    return state == FOUND || state == UNREACHABLE || state == SOLID;
}

/* Lists the samples that an adjacent unknown sample may follow, in their order; returns how
   many. */
static int32_t list_leaders(Patching *g, int32_t *queue) {
    const int32_t count = (int32_t)g->w->f->patch_count * JOX_FIELD_SAMPLES;
    int32_t listed = 0;
    for (int32_t i = 0; i < count; i++)
        for (int side = 0; g->states[i] == UNKNOWN && side < 4; side++) {
            const int32_t j = find_adjacent_sample(g, i, side);
            if (j >= 0)
                g->towards[j] = j;
        }
    for (int32_t i = 0; i < count; i++)
        if (g->towards[i] == i && can_lead(g->states[i]))
            queue[listed++] = i;
    return listed;
}

static void follow_leaders(Patching *g) {
    int32_t count = (int32_t)g->w->f->patch_count * JOX_FIELD_SAMPLES;
    int32_t *queue = jox_alloc((size_t)count + 1, sizeof *queue);
    memset(g->towards, -1, (size_t)count * sizeof *g->towards);
    int32_t filled = list_leaders(g, queue);
    for (int32_t k = 0; k < filled; k++)
        for (int side = 0; side < 4; side++) {
            int32_t i = queue[k], j = find_adjacent_sample(g, i, side);
            if (j < 0 || g->states[j] != UNKNOWN)
                continue;
            /* Samples outside solids follow visible samples outside; samples inside follow those
               inside. */
            if (is_in_solid(g, j) != is_in_solid(g, i) ||
                (!is_in_solid(g, j) && !sees_adjacent(g, j, i)))
                continue;
            JOX_ASSERT(filled < count);
            follow_sample(g, j, i);
            queue[filled++] = j;
        }
    jox_free(queue);
}

/* Directs cells deep in solids, which have no patches, towards cells that have, row by row
   outwards. */
static void direct_solid_cells(JoxFieldWork *w) {
    JoxField *f = w->f;
    int *queue = jox_alloc((size_t)w->count, sizeof *queue), filled = 0;
    for (int i = 0; i < w->count; i++)
        if (f->cells[i].patch >= 0 && w->walled.solid[i])
            queue[filled++] = i;
    for (int k = 0; k < filled; k++)
        for (int side = 0; side < 8; side++) {
            int i = queue[k], j = jox_field_next(f, i, side);
            if (j < 0 || f->cells[j].patch != JOX_FIELD_PLAIN || f->cells[j].x != 0.0f ||
                f->cells[j].y != 0.0f)
                continue;
            JoxV2 way = {-(float)JOX_FIELD_RING[side][0], -(float)JOX_FIELD_RING[side][1]};
            way = jox_unit(way);
            f->cells[j].x = way.x;
            f->cells[j].y = way.y;
            queue[filled++] = j;
        }
    jox_free(queue);
}

/* Returns whether some cells lie in solids away from all edges; these have no patch and are not
   interpolated. */
static bool has_deep_cells(const JoxFieldWork *w) {
    for (int i = 0; i < w->count; i++)
        if (w->f->cells[i].patch == JOX_FIELD_PLAIN && !jox_field_has_edges(w, i))
            return true;
    return false;
}

void jox_field_patch(JoxFieldWork *w) {
    JoxField *f = w->f;
    const size_t samples = (size_t)f->patch_count * JOX_FIELD_SAMPLES;
    Patching g = {.w = w};
    g.towards = jox_alloc(samples + 1, sizeof *g.towards);
    g.states = jox_alloc(samples + 1, 1);
    for (uint32_t p = 0; p < f->patch_count; p++)
        direct_patch(&g, p);
    follow_leaders(&g);
    if (has_deep_cells(w))
        direct_solid_cells(w);
    jox_free(g.states);
    jox_free(g.towards);
}
