/* Rows of a density in a world with storeys. The working grid holds blocks of rows, one for each
   stretch of a sheet that has floor, without the empty space between sheets. Everything that enters
   the grid is packed, which moves it from its sheet to its block; a way through each seam joins the
   blocks on both sides. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "geom/polygon.h"
#include "record/fields/density_parts.h"

enum { AROUND = 2 }; /* rows round the outlines of stairs */

typedef struct Block {
    float low;     /* m: position along y of the lower end of its first row */
    int row, rows; /* in the working grid */
} Block;

struct JoxDensitySheets {
    JoxStoreys storeys; /* a copy */
    Block *blocks;
    uint32_t count;
    uint32_t *block_of; /* by sheet: 1 + its block; 0: none */
    /* The first block is an area of positions, which may span several sheets. */
    bool has_area;
    float *y; /* m: packed positions of a crowd */
    uint32_t y_capacity;
};

/* ---- blocks ---- */

static JoxDensitySheets *create_sheets(const JoxStoreys *storeys) {
    JoxDensitySheets *s = jox_alloc(1, sizeof *s);
    jox_storeys_copy(&s->storeys, storeys);
    s->blocks = jox_alloc((size_t)storeys->sheet_count + 1, sizeof *s->blocks);
    s->block_of = jox_alloc(storeys->sheet_count, sizeof *s->block_of);
    return s;
}

/* Returns the lengths along y, m in plan, of the floor of a sheet within an area in plan. Returns
   false if there is none. */
static bool find_sheet_range(const JoxStoreys *storeys, uint32_t sheet, JoxV2 low, JoxV2 high,
                             float around, float *from, float *to) {
    *from = low.y;
    *to = high.y;
    if (sheet < storeys->storey_count)
        return true;
    *from = INFINITY;
    *to = -INFINITY;
    for (uint32_t k = 0; k < storeys->sheets[sheet].stair_count; k++) {
        const JoxStair *stair =
            &storeys->stairs[storeys->sheet_stairs[storeys->sheets[sheet].first_stair + k]];
        JoxV2 least, most;
        jox_bounds(stair->outline, 2 * stair->path_count, &least, &most);
        *from = jox_minf(*from, least.y);
        *to = jox_maxf(*to, most.y);
    }
    *from = jox_maxf(*from - around, low.y);
    *to = jox_minf(*to + around, high.y);
    return *from < *to;
}

float jox_density_depth(const JoxStoreys *storeys, JoxV2 low, JoxV2 high) {
    float sum = 0.0f, from, to;
    if (!jox_has_storeys(storeys))
        return high.y - low.y;
    for (uint32_t sheet = 0; sheet < storeys->sheet_count; sheet++)
        if (find_sheet_range(storeys, sheet, low, high, 0.0f, &from, &to))
            sum += to - from;
    return sum;
}

/* Adds a block of a sheet from row `row` on, for a range along y, m in plan. Returns the row after
   it. */
static int add_block(JoxDensitySheets *s, uint32_t sheet, float from, float to, float cell,
                     int row) {
    const int rows = (int)ceilf((to - from) / cell - 1e-3f);
    s->blocks[s->count++] = (Block){from + (float)sheet * s->storeys.pitch, row, rows};
    s->block_of[sheet] = s->count;
    return row + rows;
}

int jox_density_add_sheets(JoxDensity *d, const JoxStoreys *storeys, JoxV2 low, JoxV2 high) {
    JoxDensitySheets *s = d->sheets = create_sheets(storeys);
    const float around = AROUND * d->cell;
    float from, to;
    int end = d->edge;
    for (uint32_t sheet = 0; sheet < storeys->sheet_count; sheet++)
        if (find_sheet_range(storeys, sheet, low, high, around, &from, &to))
            end = add_block(s, sheet, from, to, d->cell, end + (s->count > 0));
    return end - d->edge;
}

/* Widens the range that the area of a density needs of the sheet beyond a seam. */
static void widen_seam_range(const JoxDensity *d, const JoxSeam *seam, float *from, float *to) {
    const JoxStoreys *storeys = &d->sheets->storeys;
    const JoxV2 corner = jox_density_corner(d), a = jox_on_sheet(storeys, seam->here, seam->a);
    const JoxV2 b = jox_on_sheet(storeys, seam->here, seam->b);
    const JoxV2 end = {corner.x + (float)d->wide * d->cell, corner.y + (float)d->high * d->cell};
    const float beyond = a.y + seam->shift, reach = (float)d->edge * d->cell;
    if (!jox_boxes_meet(corner, end, a, b) || (beyond >= corner.y && beyond < end.y))
        return;
    *from = jox_minf(*from, jox_minf(seam->a.y, seam->b.y) - reach);
    *to = jox_maxf(*to, jox_maxf(seam->a.y, seam->b.y) + reach);
}

void jox_density_storeys(JoxDensity *d, const JoxStoreys *storeys) {
    if (d->sheets || !jox_has_storeys(storeys))
        return;
    JoxDensitySheets *s = d->sheets = create_sheets(storeys);
    JOX_ASSERT(!d->floor);
    s->has_area = true;
    s->blocks[s->count++] = (Block){jox_density_corner(d).y, 0, d->high};
    int end = d->high;
    for (uint32_t sheet = 0; sheet < storeys->sheet_count; sheet++) {
        float from = INFINITY, to = -INFINITY;
        for (uint32_t k = 0; k < storeys->seam_count; k++)
            if (storeys->seams[k].there == sheet)
                widen_seam_range(d, &storeys->seams[k], &from, &to);
        if (from < to)
            end = add_block(s, sheet, from, to, d->cell, end + 1);
    }
    d->high = end + (end > d->high);
}

void jox_density_free_sheets(JoxDensitySheets *s) {
    if (!s)
        return;
    jox_storeys_free(&s->storeys);
    jox_free(s->blocks);
    jox_free(s->block_of);
    jox_free(s->y);
    jox_free(s);
}

/* ---- positions ---- */

const JoxStoreys *jox_density_storeys_of(const JoxDensity *d) {
    return d->sheets ? &d->sheets->storeys : NULL;
}

static float find_block_end(const JoxDensity *d, const Block *block) {
    return block->low + (float)block->rows * d->cell;
}

/* Returns the block of a position along y; NULL if there is none. */
static const Block *find_block(const JoxDensity *d, float y) {
    const JoxDensitySheets *s = d->sheets;
    if (s->has_area && y >= s->blocks[0].low && y < find_block_end(d, &s->blocks[0]))
        return &s->blocks[0];
    const uint32_t of = isfinite(y) ? s->block_of[jox_sheet_of(&s->storeys, y)] : 0;
    const Block *block = of ? &s->blocks[of - 1] : NULL;
    return block && y >= block->low && y < find_block_end(d, block) ? block : NULL;
}

static float pack_into_block(const JoxDensity *d, const Block *block, float y) {
    const float row = (y - block->low) / d->cell;
    return block == d->sheets->blocks && d->sheets->has_area
               ? y
               : jox_density_corner(d).y + ((float)block->row + row) * d->cell;
}

float jox_density_pack(const JoxDensity *d, float y) {
    const Block *block = d->sheets ? find_block(d, y) : NULL;
    return !d->sheets ? y : block ? pack_into_block(d, block, y) : NAN;
}

float jox_density_unpack(const JoxDensity *d, float packed) {
    const JoxDensitySheets *s = d->sheets;
    if (!s)
        return packed;
    const float row = (packed - jox_density_corner(d).y) / d->cell;
    if (s->has_area && row < (float)s->blocks[0].rows)
        return packed;
    for (uint32_t k = 0; k < s->count; k++) {
        const float from = row - (float)s->blocks[k].row;
        if (from >= 0.0f && from < (float)s->blocks[k].rows)
            return s->blocks[k].low + from * d->cell;
    }
    return NAN;
}

bool jox_density_is_off_floor(const JoxDensity *d, JoxV2 packed) {
    const float y = jox_density_unpack(d, packed.y);
    return isnan(y) || !jox_is_floor(&d->sheets->storeys, (JoxV2){packed.x, y});
}

JoxDensityCrowd jox_density_pack_crowd(JoxDensity *d, const JoxDensityCrowd *crowd) {
    JoxDensitySheets *s = d->sheets;
    JoxDensityCrowd packed = *crowd;
    if (!s)
        return packed;
    JOX_RESERVE(s->y, s->y_capacity, crowd->count + 1);
    for (uint32_t i = 0; i < crowd->count; i++)
        s->y[i] = jox_density_pack(d, crowd->y[i]);
    packed.y = s->y;
    packed.period.y = 0.0f;
    return packed;
}

/* ---- walls ---- */

/* Returns the point of a line, from a to b, at a position along y. */
static JoxV2 cut_at(JoxV2 a, JoxV2 b, float y) {
    return jox_v2(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y), y);
}

/* Adds the part of an edge that lies in a block. */
static void add_bar_of_block(JoxDensity *d, const Block *block, JoxV2 a, JoxV2 b) {
    const float low = block->low, high = find_block_end(d, block);
    if (jox_minf(a.y, b.y) > high || jox_maxf(a.y, b.y) < low)
        return;
    const JoxV2 from = a.y < low ? cut_at(a, b, low) : a.y > high ? cut_at(a, b, high) : a;
    const JoxV2 to = b.y < low ? cut_at(a, b, low) : b.y > high ? cut_at(a, b, high) : b;
    jox_density_add_bar(d, jox_v2(from.x, pack_into_block(d, block, from.y)),
                        jox_v2(to.x, pack_into_block(d, block, to.y)));
}

static void add_packed_bar(JoxDensity *d, JoxV2 a, JoxV2 b) {
    for (uint32_t k = 0; k < d->sheets->count; k++)
        add_bar_of_block(d, &d->sheets->blocks[k], a, b);
}

/* Adds the outline of a stair on each sheet that has it. */
static void add_outline_bars(JoxDensity *d, const JoxStair *stair, uint32_t sheet) {
    const JoxStoreys *storeys = &d->sheets->storeys;
    const uint32_t count = 2 * stair->path_count;
    for (uint32_t k = 0, last = count - 1; k < count; last = k++)
        add_packed_bar(d, jox_on_sheet(storeys, sheet, stair->outline[last]),
                       jox_on_sheet(storeys, sheet, stair->outline[k]));
}

void jox_density_add_packed_bars(JoxDensity *d, const JoxWalls *walls) {
    const JoxStoreys *storeys = &d->sheets->storeys;
    for (uint32_t k = 0; k < storeys->seam_count; k++) {
        const JoxSeam *seam = &storeys->seams[k];
        add_packed_bar(d, jox_on_sheet(storeys, seam->here, seam->a),
                       jox_on_sheet(storeys, seam->here, seam->b));
    }
    for (uint32_t k = 0; walls && k < storeys->stair_count; k++) {
        const JoxStair *stair = &storeys->stairs[k];
        if (stair->lower == stair->upper)
            continue;
        add_outline_bars(d, stair, stair->sheet);
        for (uint32_t storey = stair->lower; storey <= stair->upper; storey++)
            add_outline_bars(d, stair, storey);
    }
    for (uint32_t r = 0; walls && r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        for (uint32_t v = ring->first; v < ring->first + ring->count && !ring->open; v++)
            add_packed_bar(d, walls->vertices[v].point,
                           walls->vertices[walls->vertices[v].next].point);
    }
}

/* Cuts a polygon at a line of constant y and keeps what lies above it, or below. Returns the number
   of corners, at most twice as many. */
static uint32_t cut_polygon(const JoxV2 *ring, uint32_t count, float y, bool above, JoxV2 *out) {
    uint32_t kept = 0;
    for (uint32_t k = 0, last = count - 1; k < count; last = k++) {
        const bool was = above ? ring[last].y >= y : ring[last].y <= y;
        const bool is = above ? ring[k].y >= y : ring[k].y <= y;
        if (was != is)
            out[kept++] = cut_at(ring[last], ring[k], y);
        if (is)
            out[kept++] = ring[k];
    }
    return kept;
}

void jox_density_pack_solids(const JoxDensity *d, const JoxWalls *walls, JoxWalls *out) {
    for (uint32_t r = 0; walls && r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        if (!ring->solid || ring->open)
            continue;
        JoxV2 *points = jox_walls_ring_points(walls, r);
        JoxV2 *cut = jox_alloc(6 * (size_t)ring->count, sizeof *cut);
        JoxV2 *half = cut + 4 * (size_t)ring->count;
        for (uint32_t k = 0; k < d->sheets->count; k++) {
            const Block *block = &d->sheets->blocks[k];
            uint32_t count = cut_polygon(points, ring->count, block->low, true, half);
            count = cut_polygon(half, count, find_block_end(d, block), false, cut);
            for (uint32_t c = 0; c < count; c++)
                cut[c].y = pack_into_block(d, block, cut[c].y);
            if (count >= 3)
                jox_walls_add_solid(out, cut, count, ring->height);
        }
        jox_free(points);
        jox_free(cut);
    }
}
