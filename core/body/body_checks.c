/* Assertions on blocks and bonds, the grid of discs and footprints; builds with assertions call
   them. */
#include <math.h>

#include "base/assert.h"
#include "body/ball_hits.h"
#include "body/bonds.h"
#include "body/footprint.h"

static bool is_finite_triple(const double v[3]) {
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

/* Returns the block in the table entry for the cell of block n. */
static uint32_t find_entered_block(const JoxBondGraph *g, uint32_t n) {
    uint32_t c[3];
    for (int i = 0; i < 3; i++) {
        c[i] = g->cell[n][i] - g->low[i];
        JOX_ASSERT(c[i] < g->range[i]);
    }
    return g->at[c[0] + g->range[0] * (c[1] + g->range[1] * c[2])];
}

void jox_bonds_check(const JoxBondGraph *g) {
    const uint32_t cells = g->range[0] * g->range[1] * g->range[2];
    JOX_ASSERT(g->count > 0 && g->count <= JOX_BONDS_MOST_BLOCKS && g->count <= cells);
    JOX_ASSERT(g->bond_count <= 3 * g->count);
    JOX_ASSERT(g->block_mass > 0.0 && is_finite_triple(g->centre));
    for (int i = 0; i < 3; i++)
        JOX_ASSERT(g->inertia[4 * i] > 0.0 && g->inverse[4 * i] > 0.0);
    uint32_t filled = 0;
    for (uint32_t c = 0; c < cells; c++)
        filled += g->at[c] != UINT32_MAX;
    JOX_ASSERT(filled == g->count);
    for (uint32_t n = 0; n < g->count; n++) {
        JOX_ASSERT(find_entered_block(g, n) == n);
        JOX_ASSERT(is_finite_triple(g->impulse[n]) && is_finite_triple(g->load[n]));
        JOX_ASSERT(is_finite_triple(g->displacement[n]));
    }
    for (uint32_t k = 0; k < g->bond_count; k++) {
        const JoxBond *bond = &g->bonds[k];
        JOX_ASSERT(bond->a < bond->b && bond->b < g->count && bond->axis < 3);
        JOX_ASSERT(bond->strength > 0.0);
    }
}

void jox_bonds_pieces_check(const JoxBondGraph *g, uint32_t pieces) {
    uint32_t seen = 0;
    for (uint32_t n = 0; n < g->count; n++) {
        JOX_ASSERT(g->label[n] <= seen); /* pieces are numbered by their least block */
        seen += g->label[n] == seen;
    }
    JOX_ASSERT(seen == pieces);
    JOX_ASSERT((uint64_t)pieces + g->bond_count >=
               g->count); /* each bond joins at most two pieces */
    for (uint32_t k = 0; k < g->bond_count; k++)
        JOX_ASSERT(g->label[g->bonds[k].a] == g->label[g->bonds[k].b]);
}

void jox_bonds_relieved_check(const JoxBondGraph *g, const double (*loads)[3]) {
    double sum[3] = {0, 0, 0}, size = 0.0;
    for (uint32_t n = 0; n < g->count; n++)
        for (int i = 0; i < 3; i++) {
            sum[i] += loads[n][i];
            size += fabs(loads[n][i]);
        }
    for (int i = 0; i < 3; i++)
        JOX_ASSERT(!(fabs(sum[i]) > 1e-6 * (1.0 + size)));
}

void jox_bonds_contacts_check(const JoxBondGraph *g, const JoxBondContact *contacts, uint32_t count,
                              const double force[3]) {
    double sum[3] = {0, 0, 0}, size = 0.0;
    for (uint32_t k = 0; k < count; k++) {
        JOX_ASSERT(contacts[k].block < g->count);
        for (int i = 0; i < 3; i++) {
            sum[i] += contacts[k].impulse[i];
            size += fabs(contacts[k].impulse[i]);
        }
    }
    for (int i = 0; i < 3 && count > 0; i++)
        JOX_ASSERT(!(fabs(sum[i] - force[i]) > 1e-6 * (1.0 + size)));
}

void jox_disc_grid_check(const JoxDiscGrid *g, const JoxDisc *discs, uint32_t count) {
    const uint32_t cells = g->columns * g->rows;
    JOX_ASSERT(cells > 0 && g->cell > 0.0f && isfinite(g->reach));
    JOX_ASSERT(g->starts[0] == 0 && g->starts[cells] == count);
    for (uint32_t c = 0; c < cells; c++) {
        JOX_ASSERT(g->starts[c] <= g->starts[c + 1]);
        for (uint32_t k = g->starts[c]; k < g->starts[c + 1]; k++) {
            JOX_ASSERT(g->items[k] < count);
            JOX_ASSERT(k == g->starts[c] || g->items[k - 1] < g->items[k]);
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        JOX_ASSERT(discs[i].mass > 0.0f && discs[i].radius >= 0.0f);
        JOX_ASSERT(isfinite(discs[i].vx) && isfinite(discs[i].vy));
    }
}

void jox_sweep_hit_check(const JoxSweep *sweep, const JoxSweepHit *hit) {
    const JoxV3 n = hit->normal;
    JOX_ASSERT(hit->time >= 0.0f && hit->time <= sweep->span);
    JOX_ASSERT(!(fabsf(n.x * n.x + n.y * n.y + n.z * n.z - 1.0f) > 1e-3f));
}

void jox_footprint_check(const JoxObject *o) {
    const uint32_t n = o->footprint_count;
    JOX_ASSERT(n <= JOX_FOOTPRINT_POINTS && (n == 0 || n >= 3));
    JOX_ASSERT(o->in_band == (n > 0));
    JOX_ASSERT(!o->in_band || (o->low >= JOX_BAND_LOW && o->high <= JOX_BAND_HIGH));
    float area = 0.0f;
    for (uint32_t i = 0; i < n; i++) {
        JoxV2 a = jox_sub(o->footprint[(i + 1) % n], o->footprint[i]);
        JoxV2 b = jox_sub(o->footprint[(i + 2) % n], o->footprint[(i + 1) % n]);
        JOX_ASSERT(!(jox_det(a, b) < -1e-5f * (1.0f + jox_length(a) * jox_length(b))));
        area += jox_det(jox_sub(o->footprint[i], o->footprint[0]), a);
    }
    JOX_ASSERT(n == 0 || area > 0.0f); /* counter-clockwise */
}
