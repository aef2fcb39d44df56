/* Adds people to the nodes of a strip of rows. */
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "record/fields/density_kernels.h"
#include "record/fields/density_parts.h"

#define X(name, isa) [isa] = jox_density_place_##name,
static JoxDensityPlaceKernel *const PLACE[JOX_ISA_ROOM] = {JOX_ISAS(X)};
#undef X

/* ---- the strip ---- */

void jox_density_clear_strip(JoxDensity *d, int fields, int first, int end) {
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
    w->first = first;
    w->end = end;
    w->fields = fields;
}

/* ---- people ---- */

/* Adds a person near a wall or solid. */
static void put_near_wall(JoxDensity *d, float x, float y, const float *weights) {
    uint32_t nodes[4];
    float shares[4];
    const int count = jox_density_share_person(d, x, y, nodes, shares);
    for (int k = 0; k < count; k++)
        for (int f = 0; f < d->work.fields; f++)
            d->work.mass[f][nodes[k]] += shares[k] * weights[f];
}

/* Adds `weight` by shares to four nodes of a strip, `at` being the lower left one. `below` and
   `above` tell which of the two rows the strip has. */
static inline void add_node_shares(float *at, ptrdiff_t wide, const float shares[4], float weight,
                                   bool below, bool above) {
    if (below) {
        at[0] += shares[0] * weight;
        at[1] += shares[1] * weight;
    }
    if (above) {
        at[wide] += shares[2] * weight;
        at[wide + 1] += shares[3] * weight;
    }
}

/* A chunk of the crowd. */
typedef struct Chunk {
    JoxDensityPlaced across, up;
    uint32_t from, count; /* range of its people */
} Chunk;

static bool is_near_wall(const JoxDensity *d, int column, int row, float right, float above) {
    const int own_column = column + (right >= 0.5f), own_row = row + (above >= 0.5f);
    return d->floor && d->floor->near[own_row * d->wide + own_column];
}

/* Adds person k of the chunk, as image a along x and b along y. */
static inline void put_image(JoxDensity *d, const JoxDensityCrowd *crowd, const Chunk *chunk,
                             uint32_t k, int a, int b, int fields, const float *weights) {
    const JoxDensityWork *w = &d->work;
    const int column = (int)chunk->across.node[a][k], row = (int)chunk->up.node[b][k];
    const float right = chunk->across.share[a][k], above = chunk->up.share[b][k];
    if (is_near_wall(d, column, row, right, above)) {
        put_near_wall(d, crowd->x[chunk->from + k] + (float)(a - 1) * crowd->period.x,
                      crowd->y[chunk->from + k] + (float)(b - 1) * crowd->period.y, weights);
        return;
    }
    const float left = 1.0f - right, below = 1.0f - above;
    const float shares[4] = {left * below, right * below, left * above, right * above};
    const ptrdiff_t node = (ptrdiff_t)(row - w->first) * d->wide + column;
    for (int f = 0; f < fields; f++)
        add_node_shares(w->mass[f] + node, d->wide, shares, weights[f], row >= w->first,
                        row + 1 < w->end);
}

static inline __attribute__((always_inline)) void
put_chunk(JoxDensity *d, const JoxDensityCrowd *crowd, const Chunk *chunk, int fields) {
    float weights[JOX_DENSITY_FIELDS] = {0.0f};
    for (uint32_t k = 0; k < chunk->count; k++) {
        const uint32_t i = chunk->from + k;
        if (crowd->seen && !crowd->seen[i])
            continue;
        for (int f = 0; f < fields; f++)
            weights[f] = crowd->weights[f] ? crowd->weights[f][i] : 1.0f;
        for (uint32_t c = chunk->across.images[k]; c; c &= c - 1)
            for (uint32_t r = chunk->up.images[k]; r; r &= r - 1)
                put_image(d, crowd, chunk, k, __builtin_ctz(c), __builtin_ctz(r), fields, weights);
    }
}

void jox_density_put_crowd(JoxDensity *d, const JoxDensityCrowd *crowd) {
    JoxDensityPlaceKernel *const place = PLACE[jox_isa_resolve(d->isa)];
    const JoxDensityWork *w = &d->work;
    const JoxV2 low = jox_density_corner(d);
    /* Positions need cells on all sides; along y, at least one of the two nodes must lie in the
       strip. */
    const JoxDensityAxis across = {low.x, d->cell, 1.0f, (float)(d->wide - 1), crowd->period.x};
    const JoxDensityAxis up = {low.y, d->cell, jox_maxf((float)w->first - 0.5f, 1.0f),
                               jox_minf((float)w->end + 0.5f, (float)(d->high - 1)),
                               crowd->period.y};
    JOX_ASSERT(!d->floor || (w->first == 0 && w->end == d->high));
    Chunk chunk;
    for (uint32_t from = 0; from < crowd->count; from += JOX_DENSITY_AT_ONCE) {
        const uint32_t left = crowd->count - from;
        chunk.from = from;
        chunk.count = left < JOX_DENSITY_AT_ONCE ? left : JOX_DENSITY_AT_ONCE;
        if (!place(&up, crowd->y + from, chunk.count, &chunk.up) ||
            !place(&across, crowd->x + from, chunk.count, &chunk.across))
            continue;
        if (w->fields == 1) /* lets the compiler unroll for one field, the common case */
            put_chunk(d, crowd, &chunk, 1);
        else
            put_chunk(d, crowd, &chunk, w->fields);
    }
}
