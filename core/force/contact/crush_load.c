/* Measures what contacts press agents and walls with; stage.c calls it once the contacts are
   solved.

   Compression is the sum of |f.n| over all contacts of an agent, with agents, walls and bodies,
   divided by the girth 2 pi r, N/m. Load is the greatest, over all directions d, of the sum of the
   positive parts of f.d: the force that the agent bears from one side, N. An agent held between two
   forces of 600 N has a load of 600 N. Pushes received and given count as contacts; external
   forces, and forces passed on (equations 8 and 9), do not. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "force/forces.h"
#include "simd/four.h"

enum { MOST_FORCES = 64 };

/* Four forces, or four sums of forces, N. */
typedef struct Forces {
    JoxFour x, y;
} Forces;

static inline JoxFour fill_four(float x) {
    return (JoxFour){x, x, x, x};
}

/* Adds a force to the marked ones of four sums. */
static inline void add_where(Forces *sums, JoxFourMask marks, Forces force) {
    sums->x += jox_keep_four(marks, force.x);
    sums->y += jox_keep_four(marks, force.y);
}

static inline JoxFour keep_greater_length2(JoxFour most, Forces of) {
    const JoxFour length2 = of.x * of.x + of.y * of.y;
    return jox_keep_four(length2 > most, length2) + jox_keep_four(length2 <= most, most);
}

/* Forces that press on one agent, N, padded with zeros to a multiple of four. */
typedef struct Pressing {
    uint32_t count;
    float x[MOST_FORCES + 4], y[MOST_FORCES + 4];
} Pressing;

static inline JoxV2 get_force(const Pressing *p, uint32_t k) {
    return (JoxV2){p->x[k], p->y[k]};
}

/* Returns whether another force fits; more than MOST_FORCES are dropped. */
static inline bool has_room(const Pressing *p) {
    return p->count < MOST_FORCES;
}

/* Returns the greatest squared length of the sums of forces on either side of four borders, each
   along one force; forces on a border are tried on the left, on the right and on neither side. */
static JoxFour find_border_pushes(Forces border, const Pressing *p, JoxFour most2) {
    const JoxFour zero = {0.0f};
    Forces left = {zero, zero}, right = left, along = left;
    for (uint32_t m = 0; m < p->count; m++) {
        const Forces here = {fill_four(p->x[m]), fill_four(p->y[m])};
        const JoxFour side = border.x * here.y - border.y * here.x;
        const JoxFour ahead = border.x * here.x + border.y * here.y;
        add_where(&left, side > zero, here);
        add_where(&right, side < zero, here);
        add_where(&along, (side == zero) & (ahead > zero), here);
    }
    most2 = keep_greater_length2(keep_greater_length2(most2, left), right);
    left = (Forces){left.x + along.x, left.y + along.y};
    right = (Forces){right.x + along.x, right.y + along.y};
    return keep_greater_length2(keep_greater_length2(most2, left), right);
}

/* Returns the greatest length, over half-planes, of the sum of the forces within, which equals the
   greatest sum of positive parts over directions. Only borders along a force matter; it may lie
   within or outside of the half-plane. */
static float find_greatest_push(const Pressing *p) {
    const JoxV2 one = get_force(p, 0), other = get_force(p, 1);
    if (p->count == 0)
        return 0.0f;
    if (p->count == 1)
        return jox_length(one);
    if (p->count == 2)
        return sqrtf(jox_maxf(jox_length2(jox_add(one, other)),
                              jox_maxf(jox_length2(one), jox_length2(other))));
    JoxFour most2 = {0.0f};
    for (uint32_t k = 0; k < p->count; k += 4) {
        const Forces border = {jox_load_four(p->x + k), jox_load_four(p->y + k)};
        most2 = find_border_pushes(border, p, most2);
    }
    return sqrtf(jox_maxf(jox_maxf(most2[0], most2[1]), jox_maxf(most2[2], most2[3])));
}

/* Adds a force if it counts; without a branch, which would be mispredicted. */
static inline void add_force_if(Pressing *p, JoxV2 force, bool counts) {
    p->x[p->count] = force.x;
    p->y[p->count] = force.y;
    p->count += counts;
}

/* Lists all forces that press on agent i. */
static void list_pressing(const JoxForces *f, uint32_t i, Pressing *out) {
    const JoxPair *pairs = f->pairs.items;
    const float per_second = 1.0f / (float)f->step.dt;
    out->count = 0;
    for (uint32_t k = f->end_starts[i]; k < f->end_starts[i + 1] && has_room(out); k++) {
        const JoxPair *p = &pairs[f->ends[k].pair];
        const float force = p->impulse * per_second + p->squeeze;
        add_force_if(out, jox_scale(p->normal, p->first == i ? force : -force), force > 0.0f);
    }
    for (uint32_t k = 0; k < jox_touches_of(f, i) && has_room(out); k++) {
        const JoxTouch *t = &f->touch[f->touch_first[i] + k];
        add_force_if(out, jox_scale(t->normal, t->impulse * per_second), t->impulse > 0.0f);
    }
    for (uint32_t k = 0; k < f->wall_number[i] && has_room(out); k++) {
        const JoxWallContact *w = &f->wall[f->wall_first[i] + k];
        add_force_if(out, jox_scale(w->normal, w->impulse * per_second), w->impulse > 0.0f);
    }
    for (uint32_t k = f->pushed ? f->starts[i] : 0;
         f->pushed && k < f->starts[i + 1] && has_room(out); k++)
        add_force_if(out, jox_v2(f->sorted[k].x, f->sorted[k].y),
                     f->sorted[k].from_id != f->step.agents->id[i]);
    if ((f->braced[i].x != 0.0f || f->braced[i].y != 0.0f) && has_room(out))
        add_force_if(out, f->braced[i], true);
    memset(out->x + out->count, 0, 4 * sizeof *out->x);
    memset(out->y + out->count, 0, 4 * sizeof *out->y);
}

bool jox_loads_are_none(const JoxForces *f, uint32_t begin, uint32_t end) {
    uint32_t loads = f->pushed ? f->starts[end] - f->starts[begin] : 0;
    float braced = 0.0f;
    for (uint32_t i = begin; i < end; i++) {
        loads |= f->wall_number[i];
        braced += fabsf(f->braced[i].x) + fabsf(f->braced[i].y);
    }
    return loads == 0 && braced == 0.0f;
}

void jox_load_measure(JoxForces *f, uint32_t i) {
    JoxAgents *a = f->step.agents;
    Pressing pressing; /* only the entries in use are initialised */
    list_pressing(f, i, &pressing);
    float sum = 0.0f;
    if (pressing.count == 0) {
        a->compression[i] = a->load[i] = 0.0f;
        return;
    }
    for (uint32_t k = 0; k < pressing.count; k++)
        sum += jox_length(get_force(&pressing, k));
    a->compression[i] = sum / jox_circumference(jox_param(a, JOX_PARAM_radius, i));
    a->load[i] = find_greatest_push(&pressing);
    JOX_ASSERT(!(a->load[i] > sum * 1.001f + 1e-3f));
}

/* Longest piece of an edge. */
static const float PIECE = 1.0f; /* m */

static float measure_edge(const JoxWalls *walls, uint32_t edge) {
    const JoxWallVertex *v = &walls->vertices[edge];
    return jox_length(jox_sub(walls->vertices[v->next].point, v->point));
}

void jox_forces_set_walls(JoxForces *f, const JoxWalls *walls, const JoxWallImages *images) {
    f->walls = walls;
    f->images = images;
    uint32_t edges = walls ? walls->count : 0, pieces = 0;
    JOX_RESERVE(f->piece_first, f->piece_first_capacity, (size_t)edges + 1);
    for (uint32_t e = 0; e < edges; e++) {
        f->piece_first[e] = pieces;
        pieces += (uint32_t)ceilf(jox_maxf(measure_edge(walls, e) / PIECE - 1e-3f, 1e-3f));
    }
    f->piece_first[edges] = pieces;
    JOX_RESERVE(f->pieces, f->piece_capacity, pieces);
    f->piece_count = pieces;
    for (uint32_t e = 0; e < edges; e++) {
        const JoxWallVertex *v = &walls->vertices[e];
        uint32_t n = f->piece_first[e + 1] - f->piece_first[e];
        float length = measure_edge(walls, e) / (float)n;
        for (uint32_t k = 0; k < n; k++)
            f->pieces[f->piece_first[e] + k] = (JoxWallLoad){
                .edge = e,
                .from = jox_add(v->point, jox_scale(v->direction, (float)k * length)),
                .to = jox_add(v->point, jox_scale(v->direction, (float)(k + 1) * length))};
    }
}

void jox_wall_loads_measure(JoxForces *f) {
    for (uint32_t k = 0; k < f->piece_count; k++)
        f->pieces[k].load = 0.0f;
    for (uint32_t k = 0; k < f->wall_count && f->walls; k++) {
        const JoxWallContact *w = &f->wall[k];
        uint32_t first = f->piece_first[w->edge], n = f->piece_first[w->edge + 1] - first;
        float length = measure_edge(f->walls, w->edge) / (float)n;
        uint32_t piece = length > 0.0f ? (uint32_t)(w->along / length) : 0;
        JOX_ASSERT(w->edge < f->walls->count && n > 0);
        f->pieces[first + (piece < n ? piece : n - 1)].load += w->impulse / (float)f->step.dt;
    }
}

const JoxWallLoad *jox_force_wall_loads(const JoxForces *f, uint32_t *count) {
    *count = f->piece_count;
    return f->pieces;
}
