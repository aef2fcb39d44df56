#include "body/ball_hits.h"

#include <string.h>

#include "base/assert.h"
#include "base/mem.h"

enum { MOST_CELLS_A_SIDE = 512 };

static JoxV2 compute_halfway_point(const JoxDisc *d) {
    return jox_v2(d->x + 0.5f * d->move_x, d->y + 0.5f * d->move_y);
}

static uint32_t clamp_cell_index(float value, float low, float cell, uint32_t cells) {
    float at = (value - low) / cell;
    return !(at > 0.0f) ? 0 : at >= (float)cells ? cells - 1 : (uint32_t)at;
}

static uint32_t find_disc_cell(const JoxDiscGrid *g, JoxV2 p) {
    return clamp_cell_index(p.y, g->low_y, g->cell, g->rows) * g->columns +
           clamp_cell_index(p.x, g->low_x, g->cell, g->columns);
}

static void measure_disc_grid(JoxDiscGrid *g, const JoxDisc *discs, uint32_t count) {
    JoxV2 low = compute_halfway_point(&discs[0]), high = low;
    g->reach = 0.0f;
    for (uint32_t i = 0; i < count; i++) {
        JoxV2 p = compute_halfway_point(&discs[i]);
        low = jox_v2(jox_minf(low.x, p.x), jox_minf(low.y, p.y));
        high = jox_v2(jox_maxf(high.x, p.x), jox_maxf(high.y, p.y));
        float way = 0.5f * jox_length(jox_v2(discs[i].move_x, discs[i].move_y));
        g->reach = jox_maxf(g->reach, discs[i].radius + way);
    }
    float side = jox_maxf(high.x - low.x, high.y - low.y);
    g->cell = jox_maxf(1.0f, side / (float)(MOST_CELLS_A_SIDE - 1));
    g->low_x = low.x;
    g->low_y = low.y;
    g->columns = (uint32_t)((high.x - low.x) / g->cell) + 1;
    g->rows = (uint32_t)((high.y - low.y) / g->cell) + 1;
}

void jox_disc_grid_build(JoxDiscGrid *grid, const JoxDisc *discs, uint32_t count) {
    grid->columns = grid->rows = 0;
    if (count == 0)
        return;
    measure_disc_grid(grid, discs, count);
    uint32_t cells = grid->columns * grid->rows;
    JOX_RESERVE(grid->starts, grid->start_capacity, cells + 2);
    JOX_RESERVE(grid->items, grid->item_capacity, count);
    memset(grid->starts, 0, (cells + 2) * sizeof *grid->starts);
    /* Counting sort: starts[c + 1] is where the next item of cell c goes. */
    for (uint32_t i = 0; i < count; i++)
        grid->starts[find_disc_cell(grid, compute_halfway_point(&discs[i])) + 2]++;
    for (uint32_t c = 2; c < cells + 2; c++)
        grid->starts[c] += grid->starts[c - 1];
    for (uint32_t i = 0; i < count; i++)
        grid->items[grid->starts[find_disc_cell(grid, compute_halfway_point(&discs[i])) + 1]++] = i;
    JOX_CHECK(jox_disc_grid_check(grid, discs, count));
}

void jox_disc_grid_free(JoxDiscGrid *grid) {
    jox_free(grid->starts);
    jox_free(grid->items);
    *grid = (JoxDiscGrid){0};
}

/* Finds the hit of a ball that, seen from above, already overlaps the disc: against its side, or
   from above on the head. */
static bool find_overlap_hit(const JoxSweep *s, JoxV2 p, JoxV2 w, float radius, JoxSweepHit *hit) {
    float above = s->from.z - s->height;
    if (above <= 0.0f) {
        if (jox_dot(p, w) >= 0.0f)
            return false;
        JoxV2 n = jox_length2(p) > 1e-12f ? jox_unit(p) : jox_scale(jox_unit(w), -1.0f);
        hit->time = 0.0f;
        hit->normal = (JoxV3){n.x, n.y, 0.0f};
        return true;
    }
    if (s->velocity.z >= 0.0f || jox_length2(p) > radius * radius)
        return false;
    hit->time = jox_maxf(0.0f, (above - s->radius) / -s->velocity.z);
    hit->normal = (JoxV3){0.0f, 0.0f, 1.0f};
    return hit->time <= s->span;
}

/* Returns the first time, s, at which |p + w t| = reach, or -1. */
static float solve_reach_time(JoxV2 p, JoxV2 w, float reach) {
    float a = jox_length2(w), b = jox_dot(p, w), c = jox_length2(p) - reach * reach;
    float inside = b * b - a * c;
    if (b >= 0.0f || a <= 0.0f || inside < 0.0f)
        return -1.0f;
    /* Numerically stable form of (-b - sqrt) / a. */
    return c <= 0.0f ? 0.0f : c / (-b + sqrtf(inside));
}

static bool find_disc_hit(const JoxSweep *s, const JoxDisc *d, JoxSweepHit *hit) {
    float share = s->begin / s->dt;
    JoxV2 p =
        jox_v2(s->from.x - (d->x + d->move_x * share), s->from.y - (d->y + d->move_y * share));
    JoxV2 w = jox_v2(s->velocity.x - d->move_x / s->dt, s->velocity.y - d->move_y / s->dt);
    float reach = d->radius + s->radius;
    if (s->from.z - s->radius > s->height + jox_maxf(0.0f, -s->velocity.z) * s->span)
        return false;
    if (jox_length2(p) <= reach * reach)
        return find_overlap_hit(s, p, w, d->radius, hit);
    float t = solve_reach_time(p, w, reach);
    if (t < 0.0f || t > s->span)
        return false;
    /* Above the head only the lower part of the ball can hit. */
    float above = s->from.z + s->velocity.z * t - s->height;
    if (above > 0.0f) {
        if (above >= s->radius)
            return false;
        t = solve_reach_time(p, w, d->radius + sqrtf(s->radius * s->radius - above * above));
        if (t < 0.0f || t > s->span)
            return false;
    }
    JoxV2 n = jox_unit(jox_add(p, jox_scale(w, t)));
    hit->time = t;
    hit->normal = (JoxV3){n.x, n.y, 0.0f};
    return true;
}

bool jox_sweep(const JoxDiscGrid *grid, const JoxDisc *discs, const JoxSweep *sweep,
               JoxSweepHit *hit) {
    if (grid->columns == 0)
        return false;
    float reach = grid->reach + sweep->radius;
    JoxV2 a = jox_v2(sweep->from.x, sweep->from.y);
    JoxV2 b = jox_v2(a.x + sweep->velocity.x * sweep->span, a.y + sweep->velocity.y * sweep->span);
    uint32_t x0 =
        clamp_cell_index(jox_minf(a.x, b.x) - reach, grid->low_x, grid->cell, grid->columns);
    uint32_t x1 =
        clamp_cell_index(jox_maxf(a.x, b.x) + reach, grid->low_x, grid->cell, grid->columns);
    uint32_t y0 = clamp_cell_index(jox_minf(a.y, b.y) - reach, grid->low_y, grid->cell, grid->rows);
    uint32_t y1 = clamp_cell_index(jox_maxf(a.y, b.y) + reach, grid->low_y, grid->cell, grid->rows);
    bool found = false;
    for (uint32_t y = y0; y <= y1; y++)
        for (uint32_t k = grid->starts[y * grid->columns + x0];
             k < grid->starts[y * grid->columns + x1 + 1]; k++) {
            JoxSweepHit h = {.disc = grid->items[k]};
            if (discs[h.disc].parting == sweep->row + 1 ||
                !find_disc_hit(sweep, &discs[h.disc], &h))
                continue;
            JOX_CHECK(jox_sweep_hit_check(sweep, &h));
            if (!found || h.time < hit->time ||
                (h.time == hit->time && discs[h.disc].id < discs[hit->disc].id))
                *hit = h;
            found = true;
        }
    return found;
}

static JoxV3 cross_v3(JoxV3 a, JoxV3 b) {
    return (JoxV3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static float dot_v3(JoxV3 a, JoxV3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

float jox_sweep_impulse(JoxV3 velocity, JoxV3 spin, float inverse_mass,
                        const float inverse_inertia[9], JoxV3 arm, JoxV3 normal,
                        const JoxDisc *person, float restitution) {
    JoxV3 turning = cross_v3(spin, arm);
    float approach = dot_v3(velocity, normal) + dot_v3(turning, normal) - person->vx * normal.x -
                     person->vy * normal.y;
    if (approach >= 0.0f)
        return 0.0f;
    const float *m = inverse_inertia;
    JoxV3 c = cross_v3(arm, normal);
    JoxV3 ic = {m[0] * c.x + m[1] * c.y + m[2] * c.z, m[3] * c.x + m[4] * c.y + m[5] * c.z,
                m[6] * c.x + m[7] * c.y + m[8] * c.z};
    float level = normal.x * normal.x + normal.y * normal.y;
    float softness = inverse_mass + dot_v3(c, ic) + level / person->mass;
    return softness > 0.0f ? -(1.0f + restitution) * approach / softness : 0.0f;
}
