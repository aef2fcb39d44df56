/* Creates and frees densities, samples them by one of the two kernels, and keeps means and
   maxima. */
#include "record/fields/density.h"

#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "record/fields/density_parts.h"

enum { MOST_CELLS = 2000000, MOST_EDGE = JOX_DENSITY_MOST_REACH + 2 };

JoxDensity *jox_density_create_on_storeys(JoxV2 low, JoxV2 high, float cell, float kernel,
                                          const JoxStoreys *storeys) {
    JoxDensity *d = jox_alloc(1, sizeof *d);
    const float width = jox_maxf(high.x - low.x, 1.0f);
    const float height = jox_maxf(jox_density_depth(storeys, low, high), 1.0f);
    d->low = low;
    d->cell = jox_maxf(cell, sqrtf(width * height / MOST_CELLS));
    d->columns = (uint32_t)ceilf(width / d->cell);
    d->kernel = kernel;
    d->edge = (int)jox_clampf(3.0f * kernel / d->cell + 2.0f, 2.0f, MOST_EDGE);
    d->rows = jox_has_storeys(storeys) ? (uint32_t)jox_density_add_sheets(d, storeys, low, high)
                                       : (uint32_t)ceilf(height / d->cell);
    d->wide = (int)d->columns + 2 * d->edge;
    d->high = (int)d->rows + 2 * d->edge;
    d->isa = JO_ISA_WIDEST;
    while ((d->wide - 1) >> d->stretch > 63)
        d->stretch++;
    d->now = jox_alloc((size_t)d->columns * d->rows, sizeof *d->now);
    return d;
}

JoxDensity *jox_density_create(JoxV2 low, JoxV2 high, float cell, float kernel) {
    return jox_density_create_on_storeys(low, high, cell, kernel, NULL);
}

static size_t index_in_working_grid(const JoxDensity *d,
                                    size_t cell) { /* index with the edge of a cell without it */
    size_t row = cell / d->columns + (size_t)d->edge, column = cell % d->columns + (size_t)d->edge;
    return row * (size_t)d->wide + column;
}

/* Samples within walls, on the whole floor at once. */
static void sample_floor(JoxDensity *d, const JoxDensityCrowd *crowd, int fields,
                         float *const *out) {
    const float per = 1.0f / (d->cell * d->cell);
    jox_density_clear_strip(d, fields, 0, d->high);
    jox_density_put_crowd(d, crowd);
    for (int f = 0; f < fields; f++) {
        jox_density_diffuse(d, f);
        for (uint32_t row = 0; row < d->rows; row++) {
            const float *from =
                d->work.mass[f] + index_in_working_grid(d, (size_t)row * d->columns);
            float *to = out[f] + (size_t)row * d->columns;
            for (uint32_t c = 0; c < d->columns; c++)
                to[c] = from[c] * per;
        }
    }
}

void jox_density_sample(JoxDensity *d, const JoxDensityCrowd *crowd, int fields,
                        float *const *out) {
    const JoxDensityCrowd packed = jox_density_pack_crowd(d, crowd);
    (d->floor ? sample_floor : jox_density_spread)(d, &packed, fields, out);
}

void jox_density_want_mean(JoxDensity *d) {
    if (!d->sum)
        d->sum = jox_alloc((size_t)d->columns * d->rows, sizeof *d->sum);
}

static void add_to_mean(JoxDensity *d) {
    const size_t cells = (size_t)d->columns * d->rows;
    const float *restrict now = d->now;
    double *restrict sum = d->sum;
    for (size_t c = 0; c < cells; c++)
        sum[c] += (double)now[c];
    d->frames++;
}

void jox_density_update_statistics(JoxDensity *d, double t, bool mean) {
    enum { AT_ONCE = 64 };
    const size_t cells = (size_t)d->columns * d->rows;
    const float *now = d->now;
    if (mean && d->sum)
        add_to_mean(d);
    for (size_t c = 0; c < cells; c += AT_ONCE) {
        const size_t end = c + AT_ONCE < cells ? c + AT_ONCE : cells;
        int some = 0; /* a cell in the block is greater than any before */
        for (size_t k = c; k < end; k++)
            some |= now[k] > d->most;
        for (size_t k = c; k < end && some; k++)
            if (now[k] > d->most) {
                d->most = now[k];
                d->most_time = t;
                d->most_at = jox_density_middle(d, k);
            }
    }
}

void jox_density_add(JoxDensity *d, JoxV2 period, const float *x, const float *y, uint32_t count,
                     double t) {
    const JoxDensityCrowd crowd = {.count = count, .x = x, .y = y, .period = period};
    jox_density_sample(d, &crowd, 1, &d->now);
    jox_density_update_statistics(d, t, true);
}

bool jox_density_cell_of(const JoxDensity *d, float x, float y, size_t *cell) {
    int column, row;
    y = jox_density_pack(d, y);
    if (!jox_density_locate(d, x, y, &column, &row))
        return false;
    /* A person inside a wall is read at the cell that received the person's mass. */
    if (d->floor && d->floor->near[row * d->wide + column])
        (void)jox_density_find_node(d, x, y, &column, &row);
    column -= d->edge;
    row -= d->edge;
    if (column < 0 || row < 0 || column >= (int)d->columns || row >= (int)d->rows)
        return false;
    *cell = (size_t)row * d->columns + (size_t)column;
    return true;
}

JoxV2 jox_density_middle(const JoxDensity *d, size_t cell) {
    const float y = d->low.y + ((float)(cell / d->columns) + 0.5f) * d->cell;
    return jox_v2(d->low.x + ((float)(cell % d->columns) + 0.5f) * d->cell,
                  jox_density_unpack(d, y));
}

float jox_density_area(const JoxDensity *d, size_t cell) {
    return d->cell * d->cell * (d->floor ? d->floor->area[index_in_working_grid(d, cell)] : 1.0f);
}

double jox_density_mean(const JoxDensity *d, uint32_t column, uint32_t row) {
    return d->frames ? d->sum[(size_t)row * d->columns + column] / d->frames : 0.0;
}

/* Lists the sums for means. Without means it lists zeros, so that the format is always the same,
   and frees the sums unless a restored state has some. */
static void list_sum_sections(JoxDensity *d, JoxSections *s) {
    const bool wanted = d->sum != NULL;
    jox_density_want_mean(d);
    jox_section(s, "sum", d->sum, sizeof *d->sum, (size_t)d->columns * d->rows);
    JOX_SECTION(s, "frames", d->frames);
    if (!wanted && d->frames == 0) {
        jox_free(d->sum);
        d->sum = NULL;
    }
}

void jox_density_sections(JoxDensity *d, JoxSections *s) {
    const size_t cells = (size_t)d->columns * d->rows;
    jox_section(s, "now", d->now, sizeof *d->now, cells);
    list_sum_sections(d, s);
    JOX_SECTION(s, "most", d->most);
    JOX_SECTION(s, "most_at", d->most_at);
    JOX_SECTION(s, "most_time", d->most_time);
}

void jox_density_free(JoxDensity *d) {
    if (!d)
        return;
    jox_density_free_floor(d->floor);
    jox_density_free_sheets(d->sheets);
    for (int f = 0; f < JOX_DENSITY_FIELDS; f++) {
        jox_free(d->work.mass[f]);
        jox_free(d->work.lines[f]);
    }
    jox_free(d->work.spare);
    jox_free(d->work.spans);
    jox_free(d->work.reached[0]);
    jox_free(d->work.reached[1]);
    jox_free(d->work.marks);
    jox_free(d->now);
    jox_free(d->sum);
    jox_free(d);
}
