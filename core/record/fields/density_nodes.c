/* Finds the nodes that a person is shared among, and whether walls hide a node from a point, among
   the edges that have been added. */
#include <math.h>

#include "base/mem.h"
#include "record/fields/density_parts.h"

static const double TOUCHES = 1e-9; /* share of a length that counts as touching */

JoxV2 jox_density_corner(const JoxDensity *d) {
    return (JoxV2){d->low.x - (float)d->edge * d->cell, d->low.y - (float)d->edge * d->cell};
}

int jox_density_clamp_index(double value, int most) {
    return value < 0.0 ? 0 : value > most ? most : (int)value;
}

void jox_density_add_bar(JoxDensity *d, JoxV2 a, JoxV2 b) {
    JoxDensityFloor *f = d->floor;
    JOX_RESERVE(f->bars, f->bar_capacity, f->bar_count + 1);
    f->bars[f->bar_count++] = (struct JoxDensityBar){a.x, a.y, b.x, b.y};
}

/* Returns whether segment a-b touches a bar, within rounding of both lengths. */
static bool touches_bar(const struct JoxDensityBar *bar, double ax, double ay, double bx,
                        double by) {
    double wx = bar->bx - bar->ax, wy = bar->by - bar->ay, px = bx - ax, py = by - ay;
    double a = wx * (ay - bar->ay) - wy * (ax - bar->ax);
    double b = wx * (by - bar->ay) - wy * (bx - bar->ax);
    double c = px * (bar->ay - ay) - py * (bar->ax - ax);
    double e = px * (bar->by - ay) - py * (bar->bx - ax);
    double slack = TOUCHES * (wx * wx + wy * wy + px * px + py * py);
    return !((a > slack && b > slack) || (a < -slack && b < -slack) || (c > slack && e > slack) ||
             (c < -slack && e < -slack));
}

bool jox_density_is_hidden(const JoxDensity *d, JoxV2 a, JoxV2 b) {
    const JoxDensityFloor *f = d->floor;
    const JoxV2 low = jox_density_corner(d);
    double ax = (a.x - low.x) / d->cell, ay = (a.y - low.y) / d->cell;
    double bx = (b.x - low.x) / d->cell, by = (b.y - low.y) / d->cell;
    int right = jox_density_clamp_index(fmax(ax, bx), d->wide - 1),
        above = jox_density_clamp_index(fmax(ay, by), d->high - 1);
    for (int r = jox_density_clamp_index(fmin(ay, by), d->high - 1); r <= above; r++)
        for (int c = jox_density_clamp_index(fmin(ax, bx), d->wide - 1); c <= right; c++) {
            size_t cell = (size_t)r * (size_t)d->wide + (size_t)c;
            for (uint32_t k = f->first[cell]; k < f->first[cell + 1]; k++)
                if (touches_bar(&f->bars[f->passing[k]], a.x, a.y, b.x, b.y))
                    return true;
        }
    return false;
}

bool jox_density_holds(const JoxDensity *d, JoxV2 at) {
    int column, row;
    return jox_density_locate(d, at.x, at.y, &column, &row);
}

bool jox_density_locate(const JoxDensity *d, float x, float y, int *column, int *row) {
    JoxV2 low = jox_density_corner(d);
    const float c = (x - low.x) / d->cell, r = (y - low.y) / d->cell;
    if (!(c >= 1.0f && r >= 1.0f && c < (float)(d->wide - 1) && r < (float)(d->high - 1)))
        return false;
    *column = (int)c;
    *row = (int)r;
    return true;
}

JoxV2 jox_density_node_at(const JoxDensity *d, int column, int row) {
    const JoxDensityFloor *f = d->floor;
    const JoxV2 low = jox_density_corner(d);
    const size_t cell = (size_t)row * (size_t)d->wide + (size_t)column;
    if (jox_density_has_wall(f, cell))
        return f->node[f->first[cell]];
    return jox_v2(low.x + ((float)column + 0.5f) * d->cell, low.y + ((float)row + 0.5f) * d->cell);
}

JoxDensityNode jox_density_find_node(const JoxDensity *d, float x, float y, int *column, int *row) {
    const JoxDensityFloor *f = d->floor;
    float nearest = INFINITY;
    const int c0 = *column, r0 = *row;
    const size_t own = (size_t)r0 * (size_t)d->wide + (size_t)c0;
    bool seen = false;
    if (f->per[own] > 0.0f &&
        !jox_density_is_hidden(d, jox_v2(x, y), jox_density_node_at(d, c0, r0)))
        return JOX_DENSITY_SEEN;
    for (int r = r0 > 0 ? r0 - 1 : 0; r <= r0 + 1 && r < d->high; r++)
        for (int c = c0 > 0 ? c0 - 1 : 0; c <= c0 + 1 && c < d->wide; c++) {
            size_t n = (size_t)r * (size_t)d->wide + (size_t)c;
            const JoxV2 node = jox_density_node_at(d, c, r);
            float away = jox_length2(jox_sub(node, jox_v2(x, y)));
            if (f->per[n] <= 0.0f || (seen && away >= nearest))
                continue;
            bool sees = !jox_density_is_hidden(d, jox_v2(x, y), node);
            if (!sees && (seen || away >= nearest))
                continue;
            nearest = away;
            seen = sees;
            *column = c;
            *row = r;
        }
    return seen ? JOX_DENSITY_SEEN : nearest < INFINITY ? JOX_DENSITY_HIDDEN : JOX_DENSITY_NO_NODE;
}

/* Sets the shares of the nearest node and three beside it; nodes behind walls get none. Returns the
   number of nodes. */
static int share_near_wall(const JoxDensity *d, float x, float y, int column, int row,
                           uint32_t nodes[4], float shares[4]) {
    if (jox_density_find_node(d, x, y, &column, &row) == JOX_DENSITY_NO_NODE)
        return 0;
    const JoxDensityFloor *f = d->floor;
    const JoxV2 low = jox_density_corner(d);
    const int wide = d->wide;
    float right = (x - low.x) / d->cell - (float)column - 0.5f;
    float above = (y - low.y) / d->cell - (float)row - 0.5f;
    const int n = row * wide + column, x_step = right < 0.0f ? -1 : 1;
    const int y_step = above < 0.0f ? -wide : wide;
    right = jox_minf(fabsf(right), 0.5f);
    above = jox_minf(fabsf(above), 0.5f);
    const int beside = n + x_step, over = n + y_step, across = over + x_step;
    const int left = x_step < 0 ? -1 : 0, below = y_step < 0 ? -wide : 0;
    bool to_side = f->open_x[n + left] > 0.0f, to_over = f->open_y[n + below] > 0.0f;
    bool to_across =
        (to_side && f->open_y[beside + below] > 0.0f) || (to_over && f->open_x[over + left] > 0.0f);
    nodes[0] = (uint32_t)n, nodes[1] = (uint32_t)beside;
    nodes[2] = (uint32_t)over, nodes[3] = (uint32_t)across;
    shares[1] = to_side ? right * (1.0f - above) : 0.0f;
    shares[2] = to_over ? above * (1.0f - right) : 0.0f;
    shares[3] = to_across ? above * right : 0.0f;
    shares[0] = 1.0f - shares[1] - shares[2] - shares[3];
    return 4;
}

int jox_density_share_person(const JoxDensity *d, float x, float y, uint32_t nodes[4],
                             float shares[4]) {
    int column, row;
    if (!jox_density_locate(d, x, y, &column, &row))
        return 0;
    if (d->floor && d->floor->near[row * d->wide + column])
        return share_near_wall(d, x, y, column, row, nodes, shares);
    const JoxV2 low = jox_density_corner(d);
    float right = (x - low.x) / d->cell - 0.5f, above = (y - low.y) / d->cell - 0.5f;
    const int c = (int)floorf(right), r = (int)floorf(above);
    right -= (float)c;
    above -= (float)r;
    for (int k = 0; k < 4; k++) {
        nodes[k] = (uint32_t)((r + k / 2) * d->wide + c + k % 2);
        shares[k] = (k % 2 ? right : 1.0f - right) * (k / 2 ? above : 1.0f - above);
    }
    return 4;
}
