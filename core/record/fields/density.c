#include "record/fields/density.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "record/fields/density_parts.h"

enum { MOST_CELLS = 2000000, MOST_EDGE = 400 };

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

static size_t inner(const JoxDensity *d, size_t cell) { /* a cell that is read, among all */
    size_t row = cell / d->columns + (size_t)d->edge, column = cell % d->columns + (size_t)d->edge;
    return row * (size_t)d->wide + column;
}

void jox_density_begin(JoxDensity *d, int fields) {
    const size_t cells = (size_t)d->wide * (size_t)d->high;
    JOX_ASSERT(fields > 0 && fields <= JOX_DENSITY_FIELDS);
    if (!d->spare)
        d->spare = jox_alloc(cells, sizeof *d->spare);
    if (!d->marks)
        d->marks = jox_alloc((size_t)d->high, sizeof *d->marks);
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

static bool are_empty(const float *cells, size_t count) {
    int some = 0;
    for (size_t c = 0; c < count; c++)
        some |= cells[c] != 0.0f;
    return !some;
}

void jox_density_note(JoxDensity *d, double t, bool mean) {
    enum { AT_ONCE = 16 };
    const size_t cells = (size_t)d->columns * d->rows;
    for (size_t c = 0; c < cells; c++) {
        if (c % AT_ONCE == 0 && c + AT_ONCE <= cells && are_empty(d->now + c, AT_ONCE)) {
            c += AT_ONCE - 1; /* nothing is added, and nothing is greater */
            continue;
        }
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
    if (!jox_density_locate(d, x, y, &column, &row))
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

void jox_density_sections(JoxDensity *d, JoxSections *s) {
    const size_t cells = (size_t)d->columns * d->rows;
    jox_section(s, "now", d->now, sizeof *d->now, cells);
    jox_section(s, "sum", d->sum, sizeof *d->sum, cells);
    JOX_SECTION(s, "frames", d->frames);
    JOX_SECTION(s, "most", d->most);
    JOX_SECTION(s, "most_at", d->most_at);
    JOX_SECTION(s, "most_time", d->most_time);
}

void jox_density_free(JoxDensity *d) {
    if (!d)
        return;
    jox_density_free_floor(d->floor);
    for (int f = 0; f < JOX_DENSITY_FIELDS; f++)
        jox_free(d->mass[f]);
    jox_free(d->spare);
    jox_free(d->marks);
    jox_free(d->now);
    jox_free(d->sum);
    jox_free(d);
}
