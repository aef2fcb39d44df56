/* Who is put on the nodes of a strip of rows, and which stretches of them then hold something. */
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "record/fields/density_kernels.h"
#include "record/fields/density_parts.h"

#define X(name, isa) [isa] = jox_density_place_##name,
static JoxDensityPlaceKernel *const PLACE[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

/* ---- the strip ---- */

void jox_density_strip(JoxDensity *d, int fields, int first, int end) {
    JoxDensityWork *w = &d->work;
    const size_t wide = (size_t)d->wide, cells = (size_t)(end - first) * wide;
    JOX_ASSERT(fields > 0 && fields <= JOX_DENSITY_FIELDS && first < end && end <= d->high);
    if (cells > w->room) {
        for (int f = 0; f < JOX_DENSITY_FIELDS; f++) {
            jox_free(w->mass[f]);
            w->mass[f] = NULL;
        }
        w->room = cells;
    }
    for (int f = 0; f < fields; f++) {
        if (!w->mass[f])
            w->mass[f] = jox_alloc(w->room, sizeof(float));
        memset(w->mass[f], 0, cells * sizeof(float));
    }
    if (!w->marks)
        w->marks = jox_alloc((size_t)d->high, sizeof *w->marks);
    memset(w->marks + first, 0, (size_t)(end - first) * sizeof *w->marks);
    w->first = first;
    w->end = end;
    w->fields = fields;
}

/* ---- people ---- */

/* A part of somebody goes to a node; of the strip's alone. */
static void give(JoxDensity *d, int column, int row, float share, const float *weights) {
    JoxDensityWork *w = &d->work;
    const size_t node = (size_t)(row - w->first) * (size_t)d->wide + (size_t)column;
    for (int f = 0; f < w->fields; f++)
        w->mass[f][node] += share * weights[f];
}

static void mark(JoxDensity *d, int column, int row) {
    d->work.marks[row] |= UINT64_C(1) << (column >> d->stretch);
}

/* Somebody within sight of a wall or a solid. */
static void put_near(JoxDensity *d, float x, float y, const float *weights) {
    uint32_t nodes[4];
    float shares[4];
    const int count = jox_density_share(d, x, y, nodes, shares);
    for (int k = 0; k < count; k++) {
        const int column = (int)nodes[k] % d->wide, row = (int)nodes[k] / d->wide;
        if (shares[k] == 0.0f)
            continue;
        give(d, column, row, shares[k], weights);
        mark(d, column, row);
    }
}

/* Somebody between four nodes, of which this is the lowest. */
static void put_between(JoxDensity *d, int column, int row, float right, float above,
                        const float *weights) {
    const float left = 1.0f - right, below = 1.0f - above;
    if (row >= d->work.first) {
        give(d, column, row, left * below, weights);
        give(d, column + 1, row, right * below, weights);
        mark(d, column, row);
        mark(d, column + 1, row);
    }
    if (row + 1 < d->work.end) {
        give(d, column, row + 1, left * above, weights);
        give(d, column + 1, row + 1, right * above, weights);
        mark(d, column, row + 1);
        mark(d, column + 1, row + 1);
    }
}

typedef struct Chunk {
    JoxDensityPlaced across, up;
} Chunk;

static bool is_near(const JoxDensity *d, int column, int row, float right, float above) {
    const int own_column = column + (right >= 0.5f), own_row = row + (above >= 0.5f);
    return d->floor && d->floor->near[own_row * d->wide + own_column];
}

/* Person i of the crowd, the k-th of the chunk, with all images. */
static void put_images(JoxDensity *d, const JoxDensityCrowd *crowd, const Chunk *chunk, uint32_t i,
                       uint32_t k) {
    float weights[JOX_DENSITY_FIELDS];
    for (int f = 0; f < d->work.fields; f++)
        weights[f] = crowd->weights[f] ? crowd->weights[f][i] : 1.0f;
    for (uint32_t c = chunk->across.images[k]; c; c &= c - 1)
        for (uint32_t r = chunk->up.images[k]; r; r &= r - 1) {
            const int a = __builtin_ctz(c), b = __builtin_ctz(r);
            const int column = (int)chunk->across.node[a][k], row = (int)chunk->up.node[b][k];
            const float right = chunk->across.share[a][k], above = chunk->up.share[b][k];
            if (is_near(d, column, row, right, above))
                put_near(d, crowd->x[i] + (float)(a - 1) * crowd->period.x,
                         crowd->y[i] + (float)(b - 1) * crowd->period.y, weights);
            else
                put_between(d, column, row, right, above, weights);
        }
}

void jox_density_put(JoxDensity *d, const JoxDensityCrowd *crowd) {
    JoxDensityPlaceKernel *const place = PLACE[jox_isa_resolve(d->isa)];
    const JoxDensityWork *w = &d->work;
    const JoxV2 low = jox_density_corner(d);
    /* There are cells around each; between nodes of which one is in the strip. */
    const JoxDensityAxis across = {low.x, d->cell, 1.0f, (float)(d->wide - 1), crowd->period.x};
    const JoxDensityAxis up = {low.y, d->cell, jox_maxf((float)w->first - 0.5f, 1.0f),
                               jox_minf((float)w->end + 0.5f, (float)(d->high - 1)),
                               crowd->period.y};
    JOX_ASSERT(!d->floor || (w->first == 0 && w->end == d->high));
    Chunk chunk;
    for (uint32_t from = 0; from < crowd->count; from += JOX_DENSITY_AT_ONCE) {
        const uint32_t left = crowd->count - from;
        const uint32_t count = left < JOX_DENSITY_AT_ONCE ? left : JOX_DENSITY_AT_ONCE;
        if (!place(&up, crowd->y + from, count, &chunk.up) ||
            !place(&across, crowd->x + from, count, &chunk.across))
            continue;
        for (uint32_t k = 0; k < count; k++)
            if (!crowd->seen || crowd->seen[from + k])
                put_images(d, crowd, &chunk, from + k, k);
    }
}
