/* Reduces the density fields of all runs of a side to means, worst cases and shares of runs. */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "sweep/compare/compare.h"

enum { MOST_CELLS = 1 << 22 };

/* Reads the grid of a row, without values. Returns false if it makes no sense or does not match the
   number of cells. */
static bool read_grid(sqlite3_stmt *s, JoxSweepField *grid) {
    const int64_t columns = sqlite3_column_int64(s, 3), rows = sqlite3_column_int64(s, 4);
    *grid = (JoxSweepField){.low_x = sqlite3_column_double(s, 0),
                            .low_y = sqlite3_column_double(s, 1),
                            .cell = sqlite3_column_double(s, 2)};
    if (columns < 1 || rows < 1 || columns > MOST_CELLS || rows > MOST_CELLS / columns ||
        (size_t)sqlite3_column_bytes(s, 5) != sizeof(float) * (size_t)(columns * rows) ||
        !(grid->cell > 0))
        return false;
    grid->columns = (uint32_t)columns;
    grid->rows = (uint32_t)rows;
    return true;
}

/* Returns the values of the side's field of a kind, created on first use; NULL if the field has
   another grid. */
static float *get_field_values(JoxSide *side, JoxSideFieldKind kind, const JoxSweepField *grid) {
    JoxSweepField *f = &side->fields[kind];
    if (!f->values) {
        *f = *grid;
        f->name = jox_strdup("");
        f->unit = jox_strdup("");
        f->values = jox_alloc((size_t)f->columns * f->rows, sizeof *f->values);
    }
    return f->columns == grid->columns && f->rows == grid->rows && f->low_x == grid->low_x &&
                   f->low_y == grid->low_y && f->cell == grid->cell
               ? f->values
               : NULL;
}

bool jox_side_add_field(JoxSide *side, bool greatest, const JoxSweepField *grid,
                        const void *cells) {
    float *sum = get_field_values(side, greatest ? JOX_FIELD_GREATEST : JOX_FIELD_MEAN, grid);
    if (!sum)
        return false;
    float *worst = greatest ? get_field_values(side, JOX_FIELD_WORST, grid) : NULL;
    float *often = greatest ? get_field_values(side, JOX_FIELD_OFTEN, grid) : NULL;
    for (size_t k = 0; k < (size_t)grid->columns * grid->rows; k++) {
        float value;
        memcpy(&value, (const char *)cells + sizeof value * k, sizeof value);
        sum[k] += value; /* NAN: no floor */
        if (!greatest)
            continue;
        worst[k] = value > worst[k] || isnan(value) ? value : worst[k];
        often[k] = isnan(value) ? value : often[k] + (value >= JOX_FIELD_DENSE ? 1.0f : 0.0f);
    }
    return true;
}

/* Adds the field of the present row; false if its data make no sense. */
static bool add_run_field(JoxSide *side, sqlite3_stmt *s, bool greatest) {
    JoxSweepField grid;
    const void *cells = sqlite3_column_blob(s, 5);
    return cells && read_grid(s, &grid) && jox_side_add_field(side, greatest, &grid, cells);
}

static void scale_field(JoxSweepField *f, float by) {
    for (size_t k = 0; f->values && k < (size_t)f->columns * f->rows; k++)
        f->values[k] *= by;
}

void jox_side_average_fields(JoxSide *side, bool greatest, uint32_t count) {
    if (!count)
        return;
    scale_field(&side->fields[greatest ? JOX_FIELD_GREATEST : JOX_FIELD_MEAN], 1.0f / (float)count);
    if (greatest)
        scale_field(&side->fields[JOX_FIELD_OFTEN], 100.0f / (float)count);
}

static bool read_variant_field(const JoxSweepStore *store, int64_t variant, JoxSide *side,
                               bool greatest, JoError *error) {
    sqlite3_stmt *s =
        jox_sweep_prepare(store,
                          "SELECT f.low_x, f.low_y, f.cell, f.columns, f.rows, f.cells"
                          " FROM field f JOIN run r ON r.variant = f.variant AND r.seed = f.seed"
                          " WHERE f.variant = ? AND f.name = ? AND r.state = 'done'",
                          error);
    uint32_t count = 0;
    int code;
    if (!s)
        return false;
    sqlite3_bind_int64(s, 1, variant);
    sqlite3_bind_text(s, 2, greatest ? "greatest density" : "mean density", -1, SQLITE_STATIC);
    while ((code = sqlite3_step(s)) == SQLITE_ROW)
        count += add_run_field(side, s, greatest);
    jox_side_average_fields(side, greatest, count);
    const bool good = code == SQLITE_DONE || jox_sweep_set_error(store, error);
    jox_sweep_finalize(store, s);
    return good;
}

bool jox_side_read_fields(const JoxSweepStore *store, int64_t variant, JoxSide *side,
                          JoError *error) {
    return read_variant_field(store, variant, side, true, error) &&
           read_variant_field(store, variant, side, false, error);
}
