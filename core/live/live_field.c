/* Fields for the floor: people spread by the Gaussian kernel of record/fields/density.h with R =
   0.7 m, on cells of 0.5 m, or wider where the area is large. Pressure is density times the local
   variance of velocity, as of the probe `map` (Helbing, Johansson and Al-Abideen 2007), of one
   moment. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "live/live.h"
#include "record/fields/density.h"

enum { W, VX, VY, SQUARE, SUMS, MOST_CELLS = 65536, HEAD = 32, FIELD = 3 };
static const float KERNEL = JOX_DENSITY_KERNEL, CELL = 0.5f; /* m */
static const float LEAST = 0.02f; /* 1/m2: below this there is nobody to have a velocity */

static const char *const NAMES[] = {"density", "pressure", "none"};

const char *jox_live_field_name(JoxLiveField field) {
    return NAMES[field];
}

int jox_live_field_named(const char *name) {
    for (int f = 0; f <= JOX_LIVE_FIELDS; f++)
        if (strcmp(NAMES[f], name) == 0)
            return f;
    return -1;
}

void jox_live_free_grid(JoxLiveGrid *g) {
    for (int f = 0; f < SUMS; f++)
        jox_free(g->fields[f]);
    jox_density_free(g->grid);
    *g = (JoxLiveGrid){0};
}

/* Grid over the area, made again where that has grown. */
static void make(JoxLiveGrid *g, const JoxLiveArea *area) {
    if (g->grid && jox_length(jox_sub(g->low, area->low)) == 0.0f &&
        jox_length(jox_sub(g->high, area->high)) == 0.0f)
        return;
    jox_live_free_grid(g);
    g->low = area->low;
    g->high = area->high;
    JoxV2 size = jox_sub(area->high, area->low);
    float cell = jox_maxf(CELL, sqrtf(size.x * size.y / MOST_CELLS));
    float kernel = jox_maxf(KERNEL, cell);
    JoxV2 edge = {3.5f * kernel, 3.5f * kernel}; /* all of everybody is on it */
    g->grid = jox_density_create(jox_sub(area->low, edge), jox_add(area->high, edge), cell, kernel);
    g->cells = (size_t)g->grid->columns * g->grid->rows;
    JOX_ASSERT(g->cells > 0);
    for (int f = 0; f < SUMS; f++)
        g->fields[f] = jox_alloc(g->cells, sizeof(float));
}

void jox_live_spread(JoxLiveGrid *g, JoxLiveArea *area, const JoxLiveCrowd *crowd, bool moves) {
    const int sums = moves ? SUMS : 1;
    jox_live_cover_crowd(area, crowd);
    make(g, area);
    jox_density_walls(g->grid, crowd->walls);
    jox_density_begin(g->grid, sums);
    for (uint32_t i = 0; i < crowd->count; i++) {
        float vx = crowd->vx[i], vy = crowd->vy[i];
        const float weights[SUMS] = {1.0f, vx, vy, vx * vx + vy * vy};
        jox_density_put(g->grid, crowd->period, crowd->x[i], crowd->y[i], weights);
    }
    jox_density_end(g->grid, g->fields);
    g->most = 0.0f;
    for (size_t c = 0; c < g->cells; c++)
        g->most = jox_maxf(g->most, g->fields[W][c]);
}

float jox_live_density_at(const JoxLiveGrid *g, float x, float y) {
    size_t cell;
    return g->grid && jox_density_cell_of(g->grid, x, y, &cell) ? g->fields[W][cell] : 0.0f;
}

static float value(const JoxLiveGrid *g, JoxLiveField field, size_t c) {
    float density = g->fields[W][c];
    if (field == JOX_LIVE_DENSITY)
        return density;
    if (density < LEAST)
        return 0.0f;
    float vx = g->fields[VX][c] / density, vy = g->fields[VY][c] / density;
    return density * jox_maxf(g->fields[SQUARE][c] / density - vx * vx - vy * vy, 0.0f);
}

static uint8_t *put(uint8_t *at, const void *number) {
    uint32_t bits;
    memcpy(&bits, number, sizeof bits);
    for (int i = 0; i < 4; i++)
        at[i] = (uint8_t)(bits >> (8 * i));
    return at + 4;
}

void jox_live_pack_field(const JoxLiveGrid *g, JoxLiveField field, JoxBytes *out) {
    const JoxDensity *d = g->grid;
    float most = 0.0f;
    JOX_ASSERT(field < JOX_LIVE_FIELDS && d);
    for (size_t c = 0; c < g->cells; c++)
        most = jox_maxf(most, value(g, field, c));
    most = most > 0.0f ? most : 1.0f;
    const uint32_t head[4] = {FIELD, (uint32_t)field, d->columns, d->rows};
    const float more[4] = {d->low.x, d->low.y, d->cell, most};
    JOX_RESERVE(out->data, out->capacity, HEAD + g->cells);
    out->length = HEAD + g->cells;
    uint8_t *at = out->data;
    for (int i = 0; i < 4; i++)
        at = put(at, &head[i]);
    for (int i = 0; i < 4; i++)
        at = put(at, &more[i]);
    for (size_t c = 0; c < g->cells; c++)
        *at++ = (uint8_t)(value(g, field, c) / most * 255.0f + 0.5f);
}
