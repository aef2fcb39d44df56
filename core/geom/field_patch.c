/* Patches: nine samples in each cell at a wall, judged by what each of them sees. Samples that see
   nothing (in crevices) follow a neighbour that does; those in solids lead out. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "geom/field_parts.h"

static const float KEEP = 0.85f;  /* of the clearance, as between nodes */
static const float TOUCH = 1e-3f; /* m: samples so near an edge lie upon it, on neither side */

/* UNREACHABLE: no way leads from there; ON_EDGE: lies on an edge, on neither side of it. */
typedef enum { UNKNOWN, FOUND, UNREACHABLE, SOLID, ON_EDGE } State;

typedef struct Patching {
    JoxFieldWork *w;
    int32_t *cell;    /* of each patch */
    uint8_t *states;  /* of each sample */
    int32_t *towards; /* the farthest sample that each follows straight */
} Patching;

static bool is_clear(const JoxFieldWork *w, int cell) {
    if (w->node[cell] != JOX_FIELD_MIDDLE)
        return false;
    for (int k = 0; k < 8; k++) {
        int other = jox_field_next(w->f, cell, k);
        int after = jox_field_next(w->f, cell, (k + 1) & 7);
        if (other >= 0 && (!(w->links[cell] >> k & 1) || w->node[other] != JOX_FIELD_MIDDLE))
            return false;
        if (other >= 0 && after >= 0 && !(w->corners[cell] >> k & 1))
            return false;
    }
    return true;
}

/* ---- one sample ---- */

typedef struct Blend {
    JoxV2 way;
    float length, weight;
    bool unreachable; /* it sees a node from which no way leads */
} Blend;

/* The way from a point, blended from the nodes of the four cells about it that it sees. */
static Blend blend(const JoxFieldWork *w, JoxV2 p) {
    const JoxField *f = w->f;
    float x = (p.x - f->low.x) / f->size - 0.5f, y = (p.y - f->low.y) / f->size - 0.5f;
    int column = (int)floorf(x), row = (int)floorf(y);
    Blend m = {.unreachable = false};
    for (int k = 0; k < 4; k++) {
        int c = column + (k & 1), r = row + (k >> 1), cell = r * f->columns + c;
        if (c < 0 || r < 0 || c >= f->columns || r >= f->rows || w->node[cell] == JOX_FIELD_BLOCKED)
            continue;
        JoxV2 node = jox_field_node(w, cell);
        float weight = (1.0f - fabsf(x - (float)c)) * (1.0f - fabsf(y - (float)r));
        if (weight <= 1e-4f || !jox_field_sees(w, p, node, KEEP * f->clearance))
            continue;
        if (!(w->time[cell] < INFINITY)) {
            m.unreachable = true;
            continue;
        }
        JoxV2 way = {f->cells[cell].x, f->cells[cell].y};
        m.way = jox_add(m.way, jox_scale(way, weight));
        m.length +=
            weight * (f->cells[cell].length - jox_field_slope(&f->cells[cell], jox_sub(p, node)));
        m.weight += weight;
    }
    if (m.weight > 0.0f) {
        m.way = jox_scale(m.way, 1.0f / m.weight);
        m.length = jox_maxf(0.0f, m.length / m.weight);
    }
    return m;
}

/* The soonest way by one of the nodes about a cell that a point sees; false if it sees none. */
static bool by_a_node(const JoxFieldWork *w, int cell, JoxV2 p, Blend *m) {
    const JoxField *f = w->f;
    float best = INFINITY;
    for (int k = -1; k < 8; k++) {
        int other = k < 0 ? cell : jox_field_next(f, cell, k);
        if (other < 0 || w->node[other] == JOX_FIELD_BLOCKED)
            continue;
        JoxV2 way = jox_sub(jox_field_node(w, other), p);
        float far = jox_length(way), time = w->time[other] + far * w->slowness[other];
        bool reached = time < INFINITY;
        if ((reached && time >= best) || (!reached && m->unreachable) ||
            !jox_field_sees(w, p, jox_field_node(w, other), KEEP * f->clearance))
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

static void set(JoxFieldPatch *patch, int s, JoxV2 way, float length) {
    patch->x[s] = way.x;
    patch->y[s] = way.y;
    patch->length[s] = length;
}

/* Straight out of matter: towards the nearest edge, or off the edge it lies upon. */
static JoxV2 out_of_solid(const JoxField *f, JoxV2 p, JoxV2 at, uint32_t edge) {
    JoxV2 out = jox_sub(at, p);
    if (jox_length(out) > TOUCH)
        return jox_unit(out);
    return jox_unit(jox_scale(jox_left(jox_sub(f->edges[edge].b, f->edges[edge].a)), -1.0f));
}

static State judge(const JoxFieldWork *w, JoxFieldPatch *patch, int cell, int s) {
    const JoxField *f = w->f;
    JoxV2 p = jox_field_sample(f, cell, s), at = p;
    uint32_t edge = 0;
    float near = jox_field_nearest(f, patch->first, patch->first + patch->count, p, &at, &edge);
    float half = 0.5f * f->size / (float)JOX_FIELD_SIDE;
    if (near < 1.5f * half) /* more than half its diagonal */
        patch->cut |= (uint16_t)(1 << s);
    set(patch, s, (JoxV2){0.0f, 0.0f}, INFINITY);
    if (w->solid[cell] >> s & 1) {
        if (patch->count == 0)
            return UNKNOWN; /* no edge near: it follows a neighbour later */
        set(patch, s, out_of_solid(f, p, at, edge), INFINITY);
        return SOLID;
    }
    if (near < TOUCH) {
        patch->on_edge |= (uint16_t)(1 << s);
        return ON_EDGE;
    }
    Blend m = blend(w, p);
    float along = jox_length(m.way), goal = f->clearance + f->size;
    if (m.weight > 0.0f && along < JOX_FIELD_ARRIVED && m.length < f->size) {
        set(patch, s, (JoxV2){0.0f, 0.0f}, m.length);
        return FOUND;
    }
    bool fits = m.weight > 0.0f && along > (m.length < goal ? JOX_FIELD_ARRIVED : 0.2f);
    if (fits) { /* but not where such ways lead into a wall or a corner */
        float look = jox_minf(0.75f * f->size, m.length);
        JoxV2 ahead = jox_add(p, jox_scale(m.way, look / along));
        fits = jox_field_sees(w, p, ahead, m.length < goal ? 0.0f : KEEP * f->clearance);
    }
    if (!fits && !by_a_node(w, cell, p, &m))
        return m.unreachable ? UNREACHABLE : UNKNOWN;
    m.way = jox_unit(m.way);
    if (near < f->clearance && m.length > goal) /* and off the wall */
        m.way = jox_unit(
            jox_add(m.way, jox_scale(jox_sub(p, at), (1.0f - near / f->clearance) / near)));
    set(patch, s, m.way, m.length);
    return FOUND;
}

/* ---- samples that see nothing ---- */

/* The neighbour of a sample to one of four sides, -1 if its cell has no patch. */
static int32_t beside(const Patching *g, int32_t sample, int side) {
    const JoxField *f = g->w->f;
    int32_t patch = sample / JOX_FIELD_SAMPLES;
    int s = sample % JOX_FIELD_SAMPLES, cell = g->cell[patch];
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

static JoxV2 place_of(const Patching *g, int32_t sample) {
    return jox_field_sample(g->w->f, g->cell[sample / JOX_FIELD_SAMPLES],
                            sample % JOX_FIELD_SAMPLES);
}

static bool is_matter(const Patching *g, int32_t sample) {
    return g->w->solid[g->cell[sample / JOX_FIELD_SAMPLES]] >> sample % JOX_FIELD_SAMPLES & 1;
}

/* Sample j follows i, or straight what i follows if nothing is between; and keeps off walls. */
static void follow(Patching *g, int32_t j, int32_t i) {
    JoxField *f = g->w->f;
    JoxV2 p = place_of(g, j), near_at = p;
    int32_t to = g->towards[i];
    if (!is_matter(g, j) && !jox_field_sees(g->w, p, place_of(g, to), 0.0f))
        to = i;
    g->towards[j] = to;
    g->states[j] = g->states[i];
    if (g->states[i] == UNREACHABLE)
        return;
    JoxV2 way = jox_sub(place_of(g, to), p);
    float far = jox_length(way);
    JOX_ASSERT(far > 0.0f);
    const JoxFieldPatch *led = &f->patches[to / JOX_FIELD_SAMPLES];
    JoxFieldPatch *patch = &f->patches[j / JOX_FIELD_SAMPLES];
    way = jox_scale(way, 1.0f / far);
    float near = jox_field_nearest(f, patch->first, patch->first + patch->count, p, &near_at, NULL);
    if (!is_matter(g, j) && near < f->clearance)
        way = jox_unit(
            jox_add(way, jox_scale(jox_sub(p, near_at), (1.0f - near / f->clearance) / near)));
    set(patch, j % JOX_FIELD_SAMPLES, way, led->length[to % JOX_FIELD_SAMPLES] + far);
}

static void follow_all(Patching *g) {
    int32_t count = (int32_t)g->w->f->patch_count * JOX_FIELD_SAMPLES, filled = 0;
    int32_t *queue = jox_alloc((size_t)count + 1, sizeof *queue);
    for (int32_t i = 0; i < count; i++) {
        g->towards[i] = i;
        if (g->states[i] == FOUND || g->states[i] == UNREACHABLE || g->states[i] == SOLID)
            queue[filled++] = i;
    }
    for (int32_t k = 0; k < filled; k++)
        for (int side = 0; side < 4; side++) {
            int32_t i = queue[k], j = beside(g, i, side);
            if (j < 0 || g->states[j] != UNKNOWN)
                continue;
            /* Samples outside solids follow such samples that they see; samples inside follow those
             * inside. */
            if (is_matter(g, j) != is_matter(g, i) ||
                (!is_matter(g, j) && !jox_field_sees(g->w, place_of(g, j), place_of(g, i), 0.0f)))
                continue;
            JOX_ASSERT(filled < count);
            follow(g, j, i);
            queue[filled++] = j;
        }
    jox_free(queue);
}

/* Cells deep in solids have no patches: they lead towards cells that do, row by row outwards. */
static void lead_out(JoxFieldWork *w) {
    JoxField *f = w->f;
    int *queue = jox_alloc((size_t)w->count, sizeof *queue), filled = 0;
    for (int i = 0; i < w->count; i++)
        if (f->cells[i].patch >= 0 && w->solid[i])
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

void jox_field_patch(JoxFieldWork *w) {
    JoxField *f = w->f;
    Patching g = {.w = w};
    bool deep = false;
    for (int i = 0; i < w->count; i++) {
        bool clear = is_clear(w, i), edges = jox_field_has_edges(w, i);
        f->cells[i].patch = clear ? JOX_FIELD_CLEAR : JOX_FIELD_PLAIN;
        deep = deep || (!clear && !edges);
        if (clear || !edges)
            continue;
        JOX_RESERVE(f->patches, f->patch_capacity, f->patch_count + 1);
        f->cells[i].patch = (int32_t)f->patch_count;
        f->patches[f->patch_count++] =
            (JoxFieldPatch){.first = w->first[i], .count = w->first[i + 1] - w->first[i]};
    }
    g.cell = jox_alloc((size_t)f->patch_count + 1, sizeof *g.cell);
    g.towards = jox_alloc((size_t)f->patch_count + 1, JOX_FIELD_SAMPLES * sizeof *g.towards);
    g.states = jox_alloc((size_t)f->patch_count + 1, JOX_FIELD_SAMPLES);
    for (int i = 0; i < w->count; i++) {
        int32_t p = f->cells[i].patch;
        if (p < 0)
            continue;
        g.cell[p] = i;
        for (int s = 0; s < JOX_FIELD_SAMPLES; s++)
            g.states[p * JOX_FIELD_SAMPLES + s] = (uint8_t)judge(w, &f->patches[p], i, s);
    }
    JOX_ASSERT(f->patch_count <= (uint32_t)w->count);
    follow_all(&g);
    if (deep)
        lead_out(w);
    jox_free(g.cell);
    jox_free(g.states);
    jox_free(g.towards);
}
