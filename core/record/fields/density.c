#include "record/fields/density.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "record/fields/density_parts.h"

enum { MOST_CELLS = 4000000, MOST_EDGE = 400 };

JoxDensity *jox_density_create(JoxV2 low, JoxV2 high, float cell, float kernel) {
    JoxDensity *d = jox_alloc(1, sizeof *d);
    float width = jox_maxf(high.x - low.x, 1.0f), height = jox_maxf(high.y - low.y, 1.0f);
    d->low = low;
    d->cell = jox_maxf(cell, sqrtf(width * height / MOST_CELLS));
    d->columns = (uint32_t)ceilf(width / d->cell);
    d->rows = (uint32_t)ceilf(height / d->cell);
    d->kernel = kernel;
    d->edge = (int)jox_clampf(3.0f * kernel / d->cell + 2.0f, 2.0f, MOST_EDGE);
    d->wide = (int)d->columns + 2 * d->edge;
    d->high = (int)d->rows + 2 * d->edge;
    d->now = jox_alloc((size_t)d->columns * d->rows, sizeof *d->now);
    d->sum = jox_alloc((size_t)d->columns * d->rows, sizeof *d->sum);
    return d;
}

static JoxV2 corner(const JoxDensity *d) { /* of all cells */
    return (JoxV2){d->low.x - (float)d->edge * d->cell, d->low.y - (float)d->edge * d->cell};
}

static size_t inner(const JoxDensity *d, size_t cell) { /* a cell that is read, among all */
    size_t row = cell / d->columns + (size_t)d->edge, column = cell % d->columns + (size_t)d->edge;
    return row * (size_t)d->wide + column;
}

/* The cell that (x, y) lies in, so that the cells around it exist too. */
static bool locate(const JoxDensity *d, float x, float y, int *column, int *row) {
    JoxV2 low = corner(d);
    float c = floorf((x - low.x) / d->cell), r = floorf((y - low.y) / d->cell);
    if (!(c >= 1.0f && r >= 1.0f && c < (float)(d->wide - 1) && r < (float)(d->high - 1)))
        return false;
    *column = (int)c;
    *row = (int)r;
    return true;
}

JoxDensityNode jox_density_node(const JoxDensity *d, float x, float y, int *column, int *row) {
    const JoxDensityFloor *f = d->floor;
    float nearest = INFINITY;
    const int c0 = *column, r0 = *row;
    const size_t own = (size_t)r0 * (size_t)d->wide + (size_t)c0;
    bool seen = false;
    if (f->per[own] > 0.0f && !jox_density_hidden(d, jox_v2(x, y), f->node[own]))
        return JOX_DENSITY_SEEN;
    for (int r = r0 > 0 ? r0 - 1 : 0; r <= r0 + 1 && r < d->high; r++)
        for (int c = c0 > 0 ? c0 - 1 : 0; c <= c0 + 1 && c < d->wide; c++) {
            size_t n = (size_t)r * (size_t)d->wide + (size_t)c;
            float away = jox_length2(jox_sub(f->node[n], jox_v2(x, y)));
            if (f->per[n] <= 0.0f || (seen && away >= nearest))
                continue;
            bool sees = !jox_density_hidden(d, jox_v2(x, y), f->node[n]);
            if (!sees && (seen || away >= nearest))
                continue;
            nearest = away;
            seen = sees;
            *column = c;
            *row = r;
        }
    return seen ? JOX_DENSITY_SEEN : nearest < INFINITY ? JOX_DENSITY_HIDDEN : JOX_DENSITY_NO_NODE;
}

/* Shares between the nearest node and those beside it, of which some may be behind walls. */
static int share_near(const JoxDensity *d, float x, float y, int column, int row, uint32_t nodes[4],
                      float shares[4]) {
    if (jox_density_node(d, x, y, &column, &row) == JOX_DENSITY_NO_NODE)
        return 0;
    const JoxDensityFloor *f = d->floor;
    const JoxV2 low = corner(d);
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

int jox_density_share(const JoxDensity *d, float x, float y, uint32_t nodes[4], float shares[4]) {
    int column, row;
    if (!locate(d, x, y, &column, &row))
        return 0;
    if (d->floor && d->floor->near[row * d->wide + column])
        return share_near(d, x, y, column, row, nodes, shares);
    const JoxV2 low = corner(d);
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

void jox_density_begin(JoxDensity *d, int fields) {
    const size_t cells = (size_t)d->wide * (size_t)d->high;
    JOX_ASSERT(fields > 0 && fields <= JOX_DENSITY_FIELDS);
    if (!d->spare)
        d->spare = jox_alloc(cells, sizeof *d->spare);
    d->fields = fields;
    for (int f = 0; f < fields; f++) {
        if (!d->mass[f])
            d->mass[f] = jox_alloc(cells, sizeof(float));
        memset(d->mass[f], 0, cells * sizeof(float));
    }
    d->from_x = d->wide;
    d->from_y = d->high;
    d->to_x = d->to_y = -1;
}

static void put_once(JoxDensity *d, float x, float y, const float *weights) {
    uint32_t nodes[4];
    float shares[4];
    int count = jox_density_share(d, x, y, nodes, shares);
    for (int k = 0; k < count; k++) {
        int column = (int)nodes[k] % d->wide, row = (int)nodes[k] / d->wide;
        if (shares[k] == 0.0f)
            continue;
        for (int f = 0; f < d->fields; f++)
            d->mass[f][nodes[k]] += shares[k] * weights[f];
        d->from_x = column < d->from_x ? column : d->from_x;
        d->to_x = column > d->to_x ? column : d->to_x;
        d->from_y = row < d->from_y ? row : d->from_y;
        d->to_y = row > d->to_y ? row : d->to_y;
    }
}

void jox_density_put(JoxDensity *d, JoxV2 period, float x, float y, const float *weights) {
    int across = period.x > 0.0f, up = period.y > 0.0f;
    for (int c = -across; c <= across; c++)
        for (int r = -up; r <= up; r++)
            put_once(d, x + (float)c * period.x, y + (float)r * period.y, weights);
}

void jox_density_end(JoxDensity *d, float *const *out) {
    const float per = 1.0f / (d->cell * d->cell);
    for (int f = 0; f < d->fields; f++) {
        jox_density_spread(d, f);
        for (uint32_t row = 0; row < d->rows; row++) {
            size_t from = inner(d, (size_t)row * d->columns);
            float *to = out[f] + (size_t)row * d->columns;
            for (uint32_t c = 0; c < d->columns; c++)
                to[c] = d->mass[f][from + c] * per;
        }
    }
}

void jox_density_note(JoxDensity *d, double t, bool mean) {
    size_t cells = (size_t)d->columns * d->rows;
    for (size_t c = 0; c < cells; c++) {
        d->sum[c] += mean ? d->now[c] : 0.0f;
        if (d->now[c] > d->most) {
            d->most = d->now[c];
            d->most_time = t;
            d->most_at = jox_density_middle(d, c);
        }
    }
    d->frames += mean;
}

void jox_density_add(JoxDensity *d, JoxV2 period, const float *x, const float *y, uint32_t count,
                     double t) {
    const float one = 1.0f;
    jox_density_begin(d, 1);
    for (uint32_t i = 0; i < count; i++)
        jox_density_put(d, period, x[i], y[i], &one);
    jox_density_end(d, &d->now);
    jox_density_note(d, t, true);
}

bool jox_density_cell_of(const JoxDensity *d, float x, float y, size_t *cell) {
    int column, row;
    if (!locate(d, x, y, &column, &row))
        return false;
    if (d->floor && d->floor->near[row * d->wide + column])
        (void)jox_density_node(d, x, y, &column, &row); /* who stands in a wall: their own cell */
    column -= d->edge;
    row -= d->edge;
    if (column < 0 || row < 0 || column >= (int)d->columns || row >= (int)d->rows)
        return false;
    *cell = (size_t)row * d->columns + (size_t)column;
    return true;
}

JoxV2 jox_density_middle(const JoxDensity *d, size_t cell) {
    return jox_v2(d->low.x + ((float)(cell % d->columns) + 0.5f) * d->cell,
                  d->low.y + ((float)(cell / d->columns) + 0.5f) * d->cell);
}

float jox_density_area(const JoxDensity *d, size_t cell) {
    return d->cell * d->cell * (d->floor ? d->floor->area[inner(d, cell)] : 1.0f);
}

double jox_density_mean(const JoxDensity *d, uint32_t column, uint32_t row) {
    return d->frames ? d->sum[(size_t)row * d->columns + column] / d->frames : 0.0;
}

void jox_density_free(JoxDensity *d) {
    if (!d)
        return;
    jox_density_free_floor(d->floor);
    for (int f = 0; f < JOX_DENSITY_FIELDS; f++)
        jox_free(d->mass[f]);
    jox_free(d->spare);
    jox_free(d->now);
    jox_free(d->sum);
    jox_free(d);
}
