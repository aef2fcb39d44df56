/* Fields that the page draws on the floor: density by record/fields/density.h on cells of 0.5 m,
   wider while people are far apart; and the packing of any field, crowd pressure too, into bytes.
 */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/clock.h"
#include "base/mem.h"
#include "live/live.h"
#include "record/fields/density.h"

/* Cells of the density's grid; cells of a message; bytes of its head and of a block; its kind. */
enum { MOST_CELLS = 65536, MOST_SHOWN = 78000, HEAD = 32, BLOCK = 16, FIELD = 3 };
enum { MOST_BLOCKS = JOX_MOST_STOREYS + JOX_MOST_STAIRS };   /* one a sheet */
static const float KERNEL = JOX_DENSITY_KERNEL, CELL = 0.5f; /* m */
static const float LEAST_ROOM = 2.0f; /* m about people, for their next steps */

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
    jox_density_free(g->grid);
    *g = (JoxLiveGrid){0};
}

/* Returns the side of the cells, m, of a box with room for a crowd from `low` to `high`, m in plan,
   on all storeys. */
static float choose_cell(const JoxStoreys *storeys, JoxV2 low, JoxV2 high, float room) {
    const JoxV2 more = {room, room};
    const float depth = jox_density_depth(storeys, jox_sub(low, more), jox_add(high, more));
    return jox_maxf(CELL, sqrtf((high.x - low.x + 2.0f * room) * depth / MOST_CELLS));
}

/* Whether the grid does for people from `low` to `high`: they are all in it, and cells that are
   wide for others who have left could not be much finer. */
static bool is_grid_kept(const JoxLiveGrid *g, const JoxStoreys *storeys, JoxV2 low, JoxV2 high) {
    return g->grid && g->low.x <= low.x && g->low.y <= low.y && high.x <= g->high.x &&
           high.y <= g->high.y &&
           (g->grid->cell <= CELL ||
            choose_cell(storeys, low, high, LEAST_ROOM) > 0.8f * g->grid->cell);
}

/* Makes the grid for people from `low` to `high`, unless it does for them. Its cells lie on
   multiples of their side, so that values do not depend on who was where before. */
static void make_density_grid(JoxLiveGrid *g, const JoxStoreys *storeys, JoxV2 low, JoxV2 high) {
    if (is_grid_kept(g, storeys, low, high))
        return;
    jox_live_free_grid(g);
    const JoxV2 size = jox_sub(high, low);
    float room = LEAST_ROOM + 0.25f * jox_maxf(size.x, size.y); /* not made again at each step */
    if (choose_cell(storeys, low, high, room) > CELL)
        room = LEAST_ROOM;
    const float cell = choose_cell(storeys, low, high, room), kernel = jox_maxf(KERNEL, cell);
    const float edge = 3.5f * kernel; /* so that no kernel is cut at the border */
    g->low = jox_sub(low, (JoxV2){room, room});
    g->high = jox_add(high, (JoxV2){room, room});
    const JoxV2 first = {cell * floorf((g->low.x - edge) / cell),
                         cell * floorf((g->low.y - edge) / cell)};
    g->grid = jox_density_create_on_storeys(first, jox_add(g->high, (JoxV2){edge, edge}), cell,
                                            kernel, storeys);
}

void jox_live_spread(JoxLiveGrid *g, JoxLiveArea *area, const JoxLiveCrowd *crowd) {
    JoxV2 low, high;
    jox_live_cover_crowd(area, crowd);
    if (jox_live_find_crowd_box(crowd, &low, &high))
        make_density_grid(g, crowd->storeys, low, high);
    else if (!g->grid)
        make_density_grid(g, crowd->storeys, area->low, area->low);
    g->grid->most = 0.0f;
    jox_density_walls(g->grid, crowd->walls);
    jox_density_add(g->grid, crowd->period, crowd->x, crowd->y, crowd->count, 0.0);
}

float jox_live_density_at(const JoxLiveGrid *g, float x, float y) {
    size_t cell;
    return g->grid && jox_density_cell_of(g->grid, x, y, &cell) ? g->grid->now[cell] : 0.0f;
}

float jox_live_density_max(const JoxLiveGrid *g) {
    return g->grid ? g->grid->most : 0.0f;
}

float jox_live_density_r(const JoxLiveGrid *g) {
    return g->grid ? g->grid->kernel * sqrtf(2.0f) : NAN;
}

static uint8_t *put_little_endian(uint8_t *at, const void *number) {
    uint32_t bits;
    memcpy(&bits, number, sizeof bits);
    for (int i = 0; i < 4; i++)
        at[i] = (uint8_t)(bits >> (8 * i));
    return at + 4;
}

/* Returns the greatest value of `by` times `by` cells, from a column and a row on and before the
   row `end`; 0 if none was measured (NAN). */
static float find_block_maximum(const JoxDensity *d, const float *values, uint32_t column,
                                uint32_t row, uint32_t end, uint32_t by) {
    float most = 0.0f;
    for (uint32_t r = row; r < row + by && r < end; r++)
        for (uint32_t c = column; c < column + by && c < d->columns; c++) {
            const float value = values[(size_t)r * d->columns + c];
            most = value > most ? value : most;
        }
    return most;
}

/* Ranges of fields: fixed, and the least; 1/m2 and 1/s2. A crowd pressure of 0.02 1/s2 is critical
   (Helbing, Johansson and Al-Abideen 2007). */
static const struct {
    float most, least;
} RANGES[JOX_LIVE_FIELDS] = {
    [JOX_LIVE_DENSITY] = {8.0f, 2.0f}, [JOX_LIVE_PRESSURE] = {0.1f, 0.02f}};

/* Returns the value of byte 255, adapted to the field. */
static float choose_field_range(JoxLiveScales *scales, const JoxDensity *d, const float *values,
                                JoxLiveField field) {
    const double now = jox_clock_wall();
    const size_t cells = (size_t)d->columns * d->rows;
    if (!scales) {
        float most = 0.0f;
        for (size_t c = 0; c < cells; c++)
            most = values[c] > most ? values[c] : most;
        return most > 0.0f ? most : 1.0f;
    }
    if (scales->fixed)
        return RANGES[field].most;
    JoxLiveScale *scale = &scales->fields[field];
    if (jox_live_scale_is_due(scale, now)) {
        /* Mostly nobody is about: cells without a value are not counted. */
        const float trace = 0.02f * RANGES[field].least;
        uint32_t count = 0, n = 0;
        JoxLiveSample sample = {.count = 0};
        for (size_t c = 0; c < cells; c++)
            count += values[c] > trace;
        for (size_t c = 0; c < cells; c++)
            if (values[c] > trace)
                jox_live_sample_value(&sample, count / JOX_LIVE_SAMPLE + 1, n++, values[c]);
        jox_live_adapt_scale(scale, &sample, RANGES[field].least, now);
    }
    return scale->most;
}

/* Rows of a grid that lie on one sheet, or on the one plane. */
typedef struct Block {
    uint32_t sheet, first, end; /* rows first to end - 1 */
    float low;                  /* m in plan: y of the lower end of its first row */
} Block;

/* Lists the blocks of a grid, MOST_BLOCKS at most; returns how many there are. */
static uint32_t list_blocks(const JoxDensity *d, Block *blocks) {
    const JoxStoreys *storeys = jox_density_storeys_of(d);
    uint32_t count = 0;
    if (!storeys) {
        *blocks = (Block){.end = d->rows, .low = d->low.y};
        return 1;
    }
    JOX_ASSERT(storeys->sheet_count <= MOST_BLOCKS);
    bool between = true;
    for (uint32_t r = 0; r < d->rows; r++) {
        const JoxV2 middle = jox_density_middle(d, (size_t)r * d->columns);
        if (!isnan(middle.y) && between)
            blocks[count++] = (Block){.sheet = jox_sheet_of(storeys, middle.y),
                                      .first = r,
                                      .low = jox_in_plan(storeys, middle).y - 0.5f * d->cell};
        between = isnan(middle.y);
        if (!between)
            blocks[count - 1].end = r + 1;
    }
    return count;
}

static uint32_t count_shown_rows(const Block *blocks, uint32_t count, uint32_t by) {
    uint32_t rows = 0;
    for (uint32_t b = 0; b < count; b++)
        rows += (blocks[b].end - blocks[b].first + by - 1) / by;
    return rows;
}

/* Writes the cells, block by block, and behind them with storeys the sheet of each block, its first
   row, how many it has, and the lower end. */
static void put_blocks(uint8_t *at, const JoxDensity *d, const float *values, const Block *blocks,
                       uint32_t count, uint32_t by, float most) {
    const uint32_t columns = (d->columns + by - 1) / by;
    for (uint32_t b = 0; b < count; b++)
        for (uint32_t r = blocks[b].first; r < blocks[b].end; r += by)
            for (uint32_t c = 0; c < columns; c++) {
                const float value = find_block_maximum(d, values, c * by, r, blocks[b].end, by);
                *at++ = (uint8_t)(jox_minf(value / most, 1.0f) * 255.0f + 0.5f);
            }
    uint32_t row = 0;
    for (uint32_t b = 0; b < count && jox_density_storeys_of(d); b++) {
        const uint32_t rows = count_shown_rows(&blocks[b], 1, by);
        const uint32_t whole[3] = {blocks[b].sheet, row, rows};
        for (int i = 0; i < 3; i++)
            at = put_little_endian(at, &whole[i]);
        at = put_little_endian(at, &blocks[b].low);
        row += rows;
    }
}

void jox_live_pack_field(const JoxDensity *d, const float *values, JoxLiveField field,
                         JoxLiveScales *scales, JoxBytes *out) {
    uint32_t by = 1;
    Block blocks[MOST_BLOCKS];
    const uint32_t count = list_blocks(d, blocks);
    JOX_ASSERT(field < JOX_LIVE_FIELDS);
    while ((d->columns / by) * (d->rows / by) > MOST_SHOWN)
        by++;
    const uint32_t columns = (d->columns + by - 1) / by, rows = count_shown_rows(blocks, count, by);
    const float most = choose_field_range(scales, d, values, field);
    const uint32_t head[4] = {FIELD, (uint32_t)field, columns, rows};
    const float more[4] = {d->low.x, d->low.y, d->cell * (float)by, most};
    out->length =
        HEAD + (size_t)columns * rows + (jox_density_storeys_of(d) ? (size_t)count * BLOCK : 0);
    JOX_RESERVE(out->data, out->capacity, out->length);
    uint8_t *at = out->data;
    for (int i = 0; i < 4; i++)
        at = put_little_endian(at, &head[i]);
    for (int i = 0; i < 4; i++)
        at = put_little_endian(at, &more[i]);
    put_blocks(at, d, values, blocks, count, by, most);
}
