/* Graph of blocks and bonds: creates, searches, splits it. bond_loads_and_breaks.c computes the
 * loads. */
#include "body/bonds.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"

static const uint32_t NONE = UINT32_MAX;

void jox_bonds_free(JoxBondGraph *g) {
    if (!g)
        return;
    void *owned[] = {g->at,   g->cell,         g->bonds,   g->impulse,
                     g->load, g->displacement, g->scratch, g->label};
    for (size_t i = 0; i < sizeof owned / sizeof *owned; i++)
        jox_free(owned[i]);
    jox_free(g);
}

static uint32_t *find_cell_entry(const JoxBondGraph *g, const uint32_t cell[3]) {
    uint32_t x = cell[0] - g->low[0], y = cell[1] - g->low[1], z = cell[2] - g->low[2];
    return &g->at[x + g->range[0] * (y + g->range[1] * z)];
}

void jox_bonds_block_centre(const JoxBondGraph *g, uint32_t block, double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = g->origin[i] + (g->cell[block][i] + 0.5) * g->size[i];
}

/* Inverts a symmetric, positive matrix: adjugate over determinant. */
static void invert_inertia(const double m[9], double out[9]) {
    double a = m[4] * m[8] - m[5] * m[7], b = m[5] * m[6] - m[3] * m[8];
    double c = m[3] * m[7] - m[4] * m[6], d = m[0] * a + m[1] * b + m[2] * c;
    double adjugate[9] = {a, m[2] * m[7] - m[1] * m[8], m[1] * m[5] - m[2] * m[4],
                          b, m[0] * m[8] - m[2] * m[6], m[2] * m[3] - m[0] * m[5],
                          c, m[1] * m[6] - m[0] * m[7], m[0] * m[4] - m[1] * m[3]};
    for (int i = 0; i < 9; i++)
        out[i] = adjugate[i] / d;
}

static void compute_inertia(JoxBondGraph *g) {
    double p[3];
    memset(g->centre, 0, sizeof g->centre);
    memset(g->inertia, 0, sizeof g->inertia);
    for (uint32_t n = 0; n < g->count; n++) {
        jox_bonds_block_centre(g, n, p);
        for (int i = 0; i < 3; i++)
            g->centre[i] += p[i] / g->count;
    }
    for (uint32_t n = 0; n < g->count; n++) {
        double square = 0.0;
        jox_bonds_block_centre(g, n, p);
        for (int i = 0; i < 3; i++) {
            p[i] -= g->centre[i];
            square += p[i] * p[i] + g->size[i] * g->size[i] / 12.0;
        }
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                double own = i == j ? square - g->size[i] * g->size[i] / 12.0 : 0.0;
                g->inertia[3 * i + j] += g->block_mass * (own - p[i] * p[j]);
            }
    }
    invert_inertia(g->inertia, g->inverse);
}

static void allocate_block_arrays(JoxBondGraph *g) {
    g->at = jox_alloc((size_t)g->range[0] * g->range[1] * g->range[2], sizeof *g->at);
    memset(g->at, 0xff, (size_t)g->range[0] * g->range[1] * g->range[2] * sizeof *g->at);
    g->cell = jox_alloc(g->count, sizeof *g->cell);
    g->impulse = jox_alloc(g->count, sizeof *g->impulse);
    g->load = jox_alloc(g->count, sizeof *g->load);
    g->displacement = jox_alloc(g->count, sizeof *g->displacement);
    g->scratch = jox_alloc(4 * (size_t)g->count, sizeof *g->scratch);
    g->label = jox_alloc(g->count, sizeof *g->label);
    g->bonds = jox_alloc(3 * (size_t)g->count, sizeof *g->bonds);
}

JoxBondGraph *jox_bonds_allocate(const uint32_t low[3], const uint32_t range[3], uint32_t count) {
    JoxBondGraph *g = jox_alloc(1, sizeof *g);
    memcpy(g->low, low, sizeof g->low);
    memcpy(g->range, range, sizeof g->range);
    g->count = count;
    allocate_block_arrays(g);
    return g;
}

void jox_bonds_index(JoxBondGraph *g) {
    for (uint32_t n = 0; n < g->count; n++)
        *find_cell_entry(g, g->cell[n]) = n;
    compute_inertia(g);
    JOX_CHECK(jox_bonds_check(g));
}

JoxBondGraph *jox_bonds_create(const uint32_t count[3], const double size[3], double block_mass,
                               double strength) {
    uint64_t blocks = 1;
    bool good = block_mass > 0.0 && isfinite(block_mass) && strength > 0.0 && isfinite(strength);
    for (int i = 0; i < 3; i++) {
        good = good && count[i] > 0 && size[i] > 0.0 && isfinite(size[i]);
        blocks = blocks > JOX_BONDS_MOST_BLOCKS ? blocks : blocks * count[i];
    }
    if (!good || blocks > JOX_BONDS_MOST_BLOCKS)
        return NULL;
    JoxBondGraph *g = jox_alloc(1, sizeof *g);
    g->block_mass = block_mass;
    g->count = (uint32_t)blocks;
    for (int i = 0; i < 3; i++) {
        g->size[i] = size[i];
        g->origin[i] = -0.5 * count[i] * size[i];
        g->range[i] = count[i];
    }
    allocate_block_arrays(g);
    uint32_t stride[3] = {1, count[0], count[0] * count[1]};
    for (uint32_t n = 0; n < g->count; n++) {
        uint32_t cell[3] = {n % count[0], n / count[0] % count[1], n / stride[2]};
        memcpy(g->cell[n], cell, sizeof cell);
        g->at[n] = n;
        for (uint32_t axis = 0; axis < 3; axis++)
            if (cell[axis] + 1 < count[axis])
                g->bonds[g->bond_count++] = (JoxBond){n, n + stride[axis], axis, strength};
    }
    compute_inertia(g);
    JOX_CHECK(jox_bonds_check(g));
    return g;
}

uint32_t jox_bonds_block_at(const JoxBondGraph *g, const double point[3]) {
    uint32_t cell[3];
    for (int i = 0; i < 3; i++) {
        double at = floor((point[i] - g->origin[i]) / g->size[i]) - g->low[i];
        double last = g->range[i] - 1.0;
        cell[i] = g->low[i] + (uint32_t)(at > last ? last : at > 0.0 ? at : 0.0);
    }
    uint32_t found = *find_cell_entry(g, cell);
    if (found != NONE)
        return found;
    double least = INFINITY, p[3];
    found = 0;
    for (uint32_t n = 0; n < g->count; n++) {
        jox_bonds_block_centre(g, n, p);
        double away = 0.0;
        for (int i = 0; i < 3; i++)
            away += (p[i] - point[i]) * (p[i] - point[i]);
        if (away < least) {
            least = away;
            found = n;
        }
    }
    JOX_ASSERT(found < g->count);
    return found;
}

/* Spreads the least label of each piece along the bonds until none changes. Bonds ascend, so few
   passes suffice. */
uint32_t jox_bonds_label_pieces(JoxBondGraph *g) {
    for (uint32_t n = 0; n < g->count; n++)
        g->label[n] = n;
    for (bool changed = true; changed;) {
        changed = false;
        for (uint32_t k = 0; k < 2 * g->bond_count;
             k++) { /* first in ascending, then in descending order */
            const JoxBond *bond = &g->bonds[k < g->bond_count ? k : 2 * g->bond_count - 1 - k];
            uint32_t *a = &g->label[bond->a], *b = &g->label[bond->b];
            changed = changed || *a != *b;
            *a = *b = *a < *b ? *a : *b;
        }
    }
    /* The label of a piece is its least block up to here; number the pieces instead. */
    uint32_t pieces = 0;
    for (uint32_t n = 0; n < g->count; n++)
        g->label[n] = g->label[n] == n ? pieces++ : g->label[g->label[n]];
    JOX_CHECK(jox_bonds_pieces_check(g, pieces));
    return pieces;
}

/* Copies the blocks with a label into `part`; renamed[n] becomes the new index of block n. */
static void copy_blocks(const JoxBondGraph *g, JoxBondGraph *part, uint32_t label,
                        uint32_t *renamed) {
    uint32_t high[3] = {0, 0, 0};
    memset(part->low, 0xff, sizeof part->low);
    part->count = 0;
    for (uint32_t n = 0; n < g->count; n++) {
        if (g->label[n] != label)
            continue;
        renamed[n] = part->count++;
        for (int i = 0; i < 3; i++) {
            uint32_t c = g->cell[n][i];
            part->low[i] = c < part->low[i] ? c : part->low[i];
            high[i] = c > high[i] ? c : high[i];
        }
    }
    JOX_ASSERT(part->count > 0);
    for (int i = 0; i < 3; i++)
        part->range[i] = high[i] - part->low[i] + 1;
    allocate_block_arrays(part);
    for (uint32_t n = 0; n < g->count; n++) {
        if (g->label[n] != label)
            continue;
        uint32_t to = renamed[n];
        memcpy(part->cell[to], g->cell[n], sizeof part->cell[to]);
        memcpy(part->impulse[to], g->impulse[n], sizeof part->impulse[to]);
        memcpy(part->load[to], g->load[n], sizeof part->load[to]);
        memcpy(part->displacement[to], g->displacement[n], sizeof part->displacement[to]);
        *find_cell_entry(part, part->cell[to]) = to;
    }
}

JoxBondGraph *jox_bonds_extract(const JoxBondGraph *g, uint32_t label, bool own_frame,
                                double centre[3]) {
    JoxBondGraph *part = jox_alloc(1, sizeof *part);
    memcpy(part->size, g->size, sizeof part->size);
    memcpy(part->origin, g->origin, sizeof part->origin);
    part->block_mass = g->block_mass;
    uint32_t *renamed = jox_alloc(g->count, sizeof *renamed);
    copy_blocks(g, part, label, renamed);
    for (uint32_t k = 0; k < g->bond_count; k++) {
        const JoxBond *bond = &g->bonds[k];
        if (g->label[bond->a] == label && g->label[bond->b] == label)
            part->bonds[part->bond_count++] =
                (JoxBond){renamed[bond->a], renamed[bond->b], bond->axis, bond->strength};
    }
    jox_free(renamed);
    compute_inertia(part);
    memset(centre, 0, 3 * sizeof *centre);
    if (own_frame) {
        for (int i = 0; i < 3; i++) {
            centre[i] = part->centre[i];
            part->origin[i] -= centre[i];
        }
        compute_inertia(part);
    }
    JOX_CHECK(jox_bonds_check(part));
    return part;
}
