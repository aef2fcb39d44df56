/* Loads of bonds: spreads contact impulses over blocks, solves for the forces in bonds, and cuts
   overloaded ones. bullet_bonds.cc calls it once per step. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/number/elementary.h"
#include "body/bonds.h"

static const double ACROSS = 0.4; /* stiffness of a bond across its axis; 1 along it */
static const double TOLERANCE =
    1e-4; /* residual at which the solver stops, relative to the loads */
enum { MOST_PASSES = 60, MOST_ROUNDS = 16, MOST_DROPS = 6 };

typedef double Three[3];

static double dot_double(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross_double(const double a[3], const double b[3], double out[3]) {
    double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
    out[0] = x;
    out[1] = y;
}

static void multiply_matrix(const double m[9], const double v[3], double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = m[3 * i] * v[0] + m[3 * i + 1] * v[1] + m[3 * i + 2] * v[2];
}

void jox_bonds_add_impulse(JoxBondGraph *g, const double point[3], const double impulse[3]) {
    double *to = g->impulse[jox_bonds_block_at(g, point)];
    for (int i = 0; i < 3; i++)
        to[i] += impulse[i];
}

/* ---- contacts with one other body ---- */

/* Solves a symmetric 3 x 3 system m x = b by Gaussian elimination with pivots on the diagonal.
   Directions without stiffness get 0: points in a row resist no moment about the row. */
static void solve_three(double m[9], double b[3], double x[3]) {
    double scale = m[0] + m[4] + m[8];
    for (int i = 0; i < 3; i++)
        m[4 * i] += 1e-6 * scale;
    memset(x, 0, 3 * sizeof *x);
    if (!(scale > 0.0))
        return;
    for (int k = 0; k < 3; k++)
        for (int i = k + 1; i < 3; i++) {
            double f = m[3 * i + k] / m[4 * k];
            for (int j = k; j < 3; j++)
                m[3 * i + j] -= f * m[3 * k + j];
            b[i] -= f * b[k];
        }
    for (int k = 2; k >= 0; k--) {
        double sum = b[k];
        for (int j = k + 1; j < 3; j++)
            sum -= m[3 * k + j] * x[j];
        x[k] = sum / m[4 * k];
    }
}

/* Writes impulses J/n + w x d_i, with J the total force, d_i the arm from the centre of the
   points, and w such that their total moment is `moment`. */
static void spread_impulses(JoxBondContact *c, uint32_t n, const double force[3],
                            const double moment[3]) {
    double middle[3] = {0, 0, 0}, m[9] = {0}, rest[3], w[3], d[3];
    for (uint32_t k = 0; k < n; k++)
        for (int i = 0; i < 3; i++)
            middle[i] += c[k].point[i] / n;
    for (uint32_t k = 0; k < n; k++) {
        for (int i = 0; i < 3; i++)
            d[i] = c[k].point[i] - middle[i];
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                m[3 * i + j] += (i == j ? dot_double(d, d) : 0.0) - d[i] * d[j];
    }
    cross_double(middle, force, rest);
    for (int i = 0; i < 3; i++)
        rest[i] = moment[i] - rest[i];
    solve_three(m, rest, w);
    for (uint32_t k = 0; k < n; k++) {
        for (int i = 0; i < 3; i++)
            d[i] = c[k].point[i] - middle[i];
        cross_double(w, d, c[k].impulse);
        for (int i = 0; i < 3; i++)
            c[k].impulse[i] += force[i] / n;
    }
}

/* Merges contacts into one per block, at the centre of its touching side; returns how many. */
static uint32_t merge_contacts(const JoxBondGraph *g, JoxBondContact *c, uint32_t n,
                               const double normal[3]) {
    uint32_t kept = 0;
    double away[3];
    for (uint32_t k = 0; k < n; k++)
        g->label[c[k].block] = UINT32_MAX;
    for (uint32_t k = 0; k < n; k++) {
        if (g->label[c[k].block] != UINT32_MAX)
            continue;
        g->label[c[k].block] = 0;
        c[kept] = c[k];
        jox_bonds_block_centre(g, c[k].block, away);
        for (int i = 0; i < 3; i++)
            away[i] -= c[kept].point[i];
        double height = dot_double(away, normal);
        for (int i = 0; i < 3; i++)
            c[kept].point[i] += away[i] - height * normal[i];
        kept++;
    }
    return kept;
}

void jox_bonds_add_contacts(JoxBondGraph *g, JoxBondContact *c, uint32_t n,
                            const double normal[3]) {
    double force[3] = {0, 0, 0}, moment[3] = {0, 0, 0}, m[3];
    for (uint32_t k = 0; k < n; k++) {
        cross_double(c[k].point, c[k].impulse, m);
        for (int i = 0; i < 3; i++) {
            force[i] += c[k].impulse[i];
            moment[i] += m[i];
        }
    }
    n = merge_contacts(g, c, n, normal);
    JOX_ASSERT(n <= g->count);
    for (int drops = 0; n > 0; drops++) {
        spread_impulses(c, n, force, moment);
        uint32_t pushing = 0;
        for (uint32_t k = 0; k < n; k++)
            pushing += dot_double(c[k].impulse, normal) >= 0.0;
        if (pushing == n || pushing == 0 || drops == MOST_DROPS)
            break;
        uint32_t kept = 0;
        for (uint32_t k = 0; k < n; k++)
            if (dot_double(c[k].impulse, normal) >= 0.0)
                c[kept++] = c[k];
        n = kept;
    }
    JOX_CHECK(jox_bonds_contacts_check(g, c, n, force));
    for (uint32_t k = 0; k < n; k++)
        for (int i = 0; i < 3; i++)
            g->impulse[c[k].block][i] += c[k].impulse[i];
}

/* ---- equilibrium ---- */

/* Filters the impulses of a step into loads, N. */
static void filter_impulses(JoxBondGraph *g, double dt) {
    double share = 1.0 - jox_exp(-dt / JOX_BONDS_LOAD_TIME);
    for (uint32_t n = 0; n < g->count; n++)
        for (int i = 0; i < 3; i++) {
            g->load[n][i] += share * (g->impulse[n][i] / dt - g->load[n][i]);
            g->impulse[n][i] = 0.0;
        }
}

/* Writes f, the loads less mass times acceleration of the rigid whole, N. Returns half the sum
   of their magnitudes, which no bond's force exceeds. */
static double remove_rigid_motion(const JoxBondGraph *g, const double spin[3], Three *f) {
    double force[3] = {0, 0, 0}, moment[3] = {0, 0, 0}, m[3], p[3], turn[3], sum = 0.0;
    for (uint32_t n = 0; n < g->count; n++) {
        jox_bonds_block_centre(g, n, p);
        for (int i = 0; i < 3; i++) {
            p[i] -= g->centre[i];
            force[i] += g->load[n][i];
        }
        cross_double(p, g->load[n], m);
        for (int i = 0; i < 3; i++)
            moment[i] += m[i];
    }
    /* Euler's equation in the body's frame: I alpha = M - spin x (I spin). */
    multiply_matrix(g->inertia, spin, m);
    cross_double(spin, m, m);
    for (int i = 0; i < 3; i++)
        moment[i] -= m[i];
    multiply_matrix(g->inverse, moment, turn);
    for (uint32_t n = 0; n < g->count; n++) {
        double swing[3], round[3], size = 0.0;
        jox_bonds_block_centre(g, n, p);
        for (int i = 0; i < 3; i++)
            p[i] -= g->centre[i];
        cross_double(turn, p, swing);
        cross_double(spin, p, round);
        cross_double(spin, round, round);
        for (int i = 0; i < 3; i++) {
            f[n][i] = g->load[n][i] - force[i] / g->count - g->block_mass * (swing[i] + round[i]);
            size += f[n][i] * f[n][i];
        }
        sum += 0.5 * sqrt(size);
    }
    return sum;
}

/* Three numbers of a block, two of them in one SIMD register: the same sums in fewer
   instructions. */
typedef double Pair __attribute__((vector_size(16)));
typedef struct Block {
    Pair xy;
    double z;
} Block;

static inline Block load_block(const Three v) {
    Block block = {.z = v[2]};
    memcpy(&block.xy, v, sizeof block.xy);
    return block;
}

static inline void store_block(Three to, Block block) {
    memcpy(to, &block.xy, sizeof block.xy);
    to[2] = block.z;
}

static inline Block add_blocks(Block a, Block b) {
    return (Block){a.xy + b.xy, a.z + b.z};
}

static inline Block subtract_blocks(Block a, Block b) {
    return (Block){a.xy - b.xy, a.z - b.z};
}

static inline Block multiply_blocks(Block a, Block b) {
    return (Block){a.xy * b.xy, a.z * b.z};
}

/* Computes out = A u for the three weighted Laplacians at once. */
static void apply_laplacian(const JoxBondGraph *g, const Three *u, Three *out) {
    const Block weights[] = {
        {{1.0, ACROSS}, ACROSS}, {{ACROSS, 1.0}, ACROSS}, {{ACROSS, ACROSS}, 1.0}};
    memset(out, 0, g->count * sizeof *out);
    for (uint32_t k = 0; k < g->bond_count; k++) {
        const JoxBond *bond = &g->bonds[k];
        const Block pull = multiply_blocks(
            weights[bond->axis], subtract_blocks(load_block(u[bond->b]), load_block(u[bond->a])));
        store_block(out[bond->a], subtract_blocks(load_block(out[bond->a]), pull));
        store_block(out[bond->b], add_blocks(load_block(out[bond->b]), pull));
    }
}

/* Sums the products a b over all blocks, for each component. */
static void sum_products(const JoxBondGraph *g, const Three *a, const Three *b, double out[3]) {
    Block sum = {{0.0, 0.0}, 0.0};
    for (uint32_t n = 0; n < g->count; n++)
        sum = add_blocks(sum, multiply_blocks(load_block(a[n]), load_block(b[n])));
    store_block(out, sum);
}

/* Moves the solution by `step` along the direction p, with q = A p, and updates the residual r;
   `left` becomes the sum of its squares. */
static void advance_solution(const JoxBondGraph *g, const double step[3], const Three *p,
                             const Three *q, Three *r, double left[3]) {
    const Block by = load_block(step);
    Block sum = {{0.0, 0.0}, 0.0};
    for (uint32_t n = 0; n < g->count; n++) {
        store_block(g->displacement[n], add_blocks(load_block(g->displacement[n]),
                                                   multiply_blocks(by, load_block(p[n]))));
        const Block rest = subtract_blocks(load_block(r[n]), multiply_blocks(by, load_block(q[n])));
        store_block(r[n], rest);
        sum = add_blocks(sum, multiply_blocks(rest, rest));
    }
    store_block(left, sum);
}

/* Solves for the displacements by conjugate gradients, x, y and z side by side, started from the
   last solution. The body must be in one piece: then the loads sum to zero, as the singular
   systems need. */
static void solve_equilibrium(JoxBondGraph *g, const Three *f) {
    Three *u = g->displacement, *r = g->scratch, *p = r + g->count, *q = p + g->count;
    double before[3], after[3], along[3], enough[3];
    apply_laplacian(g, u, q);
    for (uint32_t n = 0; n < g->count; n++)
        for (int i = 0; i < 3; i++)
            p[n][i] = r[n][i] = f[n][i] - q[n][i];
    sum_products(g, f, f, enough);
    sum_products(g, r, r, before);
    for (int i = 0; i < 3; i++)
        enough[i] *= TOLERANCE * TOLERANCE;
    for (int pass = 0; pass < MOST_PASSES; pass++) {
        bool all = true;
        for (int i = 0; i < 3; i++)
            all = all && before[i] <= enough[i];
        if (all)
            return;
        apply_laplacian(g, p, q);
        sum_products(g, p, q, along);
        double step[3], share[3];
        for (int i = 0; i < 3; i++)
            step[i] = before[i] > enough[i] && along[i] > 0.0 ? before[i] / along[i] : 0.0;
        advance_solution(g, step, p, q, r, after);
        for (int i = 0; i < 3; i++)
            share[i] = before[i] > 0.0 ? after[i] / before[i] : 0.0;
        for (uint32_t n = 0; n < g->count; n++)
            store_block(p[n], add_blocks(load_block(r[n]),
                                         multiply_blocks(load_block(share), load_block(p[n]))));
        memcpy(before, after, sizeof before);
    }
}

/* Returns the force of a bond over its strength. */
static double compute_load_ratio(const JoxBondGraph *g, const JoxBond *bond) {
    double tension = 0.0, shear2 = 0.0;
    for (uint32_t i = 0; i < 3; i++) {
        double pull = g->displacement[bond->b][i] - g->displacement[bond->a][i];
        if (bond->axis == i)
            tension = pull > 0.0 ? pull : 0.0;
        else
            shear2 += ACROSS * ACROSS * pull * pull;
    }
    return sqrt(tension * tension + shear2) / bond->strength;
}

/* Cuts every overloaded bond whose load ratio is at least 0.95 times the greatest one; the other
   bonds' loads change by that, and are solved again. Returns how many were cut. */
static uint32_t cut_worst(JoxBondGraph *g) {
    g->peak_load = 0.0;
    for (uint32_t k = 0; k < g->bond_count; k++) {
        double share = compute_load_ratio(g, &g->bonds[k]);
        g->peak_load = share > g->peak_load ? share : g->peak_load;
    }
    if (!(g->peak_load > 1.0))
        return 0;
    double limit = 0.95 * g->peak_load > 1.0 ? 0.95 * g->peak_load : 1.0;
    limit = limit < DBL_MAX ? limit
                            : DBL_MAX; /* the ratio of a bond with almost no strength is infinite */
    uint32_t kept = 0, all = g->bond_count;
    for (uint32_t k = 0; k < all; k++)
        if (compute_load_ratio(g, &g->bonds[k]) <= limit)
            g->bonds[kept++] = g->bonds[k];
    JOX_ASSERT(kept < all); /* at least the bond with the greatest ratio is cut */
    g->bond_count = kept;
    return all - kept;
}

uint32_t jox_bonds_step(JoxBondGraph *g, double dt, const double spin[3]) {
    Three *f = g->scratch + 3 * (size_t)g->count;
    double weakest = INFINITY;
    uint32_t cut = 0, bonds = g->bond_count;
    filter_impulses(g, dt);
    for (uint32_t k = 0; k < g->bond_count; k++)
        weakest = g->bonds[k].strength < weakest ? g->bonds[k].strength : weakest;
    g->peak_load = 0.0;
    const double most = remove_rigid_motion(g, spin, f);
    JOX_CHECK(jox_bonds_relieved_check(g, f));
    if (!(most > weakest))
        return 0;
    for (int round = 0; round < MOST_ROUNDS; round++) {
        solve_equilibrium(g, f);
        uint32_t now = cut_worst(g);
        cut += now;
        if (now == 0 || jox_bonds_label_pieces(g) > 1)
            break;
    }
    JOX_ASSERT(cut + g->bond_count == bonds);
    JOX_CHECK(jox_bonds_check(g));
    return cut;
}
