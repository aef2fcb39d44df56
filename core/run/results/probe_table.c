/* Tables of probes as columns of numbers and texts, for programs that embed the engine: parsed from
   the CSV that the probe writes for reports. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "base/result_block.h"
#include "jostle_tools.h"
#include "run/probe_listener.h"
#include "run/run.h"

enum { HEAD, COLUMNS, NUMBERS, TEXTS }; /* parts of the pack */

/* Returns the CSV of a probe, to be freed by `free`; NULL if memory is out. */
static char *write_probe_csv(const JoxProbe *probe) {
    char *text = NULL;
    size_t length = 0;
    FILE *file = open_memstream(&text, &length);
    if (!file)
        return NULL;
    const JoxNumeric before = jox_numeric_use(jox_numeric_plain());
    jox_probe_csv(probe, file);
    jox_numeric_use(before);
    if (fclose(file) == 0)
        return text;
    free(text);
    return NULL;
}

/* Cells of a table, row by row; the first row has the names of the columns. */
typedef struct Cells {
    char **items; /* zero-terminated in place, in the CSV */
    size_t count, capacity;
    uint32_t columns;
} Cells;

/* Reads the cell at *at, zero-terminates it in place and moves *at behind it. Returns whether it
   is the last of its line. */
static bool read_cell(char **at, char **cell) {
    char *from = *at, *to;
    if (*from == '"') { /* doubled quotes within */
        *cell = to = ++from;
        while (*from && !(*from == '"' && from[1] != '"')) {
            from += *from == '"';
            *to++ = *from++;
        }
        from += *from == '"';
    } else {
        *cell = from;
        from += strcspn(from, ",\n");
        to = from;
    }
    const bool last = *from != ',';
    *at = from + (*from != 0);
    *to = 0;
    return last;
}

static void read_cells(char *text, Cells *cells) {
    while (*text) {
        if (*text == '\n') { /* an empty line separates the blocks of a map */
            text++;
            continue;
        }
        uint32_t columns = 0;
        bool last = false;
        while (!last) {
            JOX_RESERVE(cells->items, cells->capacity, cells->count + 1);
            last = read_cell(&text, &cells->items[cells->count++]);
            columns++;
        }
        cells->columns = cells->columns ? cells->columns : columns;
        JOX_ASSERT(columns == cells->columns);
    }
}

static bool parse_number(const char *cell, double *number) {
    char *end;
    *number = strtod(cell, &end);
    if (*cell && !*end)
        return true;
    *number = NAN;
    return false;
}

/* Adds the column `c`, whose first row reads "name [unit]": its numbers, NaN for other texts, and
   its texts if it has any. */
static void add_column(const Cells *cells, uint32_t c, uint32_t rows, JoxPack *pack) {
    char *name = cells->items[c], *unit = strchr(name, '[');
    JoTableColumn *column = jox_pack_add(pack, COLUMNS, sizeof *column);
    if (unit) {
        unit[strcspn(unit, "]")] = 0;
        *unit++ = 0;
    }
    for (size_t n = strlen(name); n > 0 && name[n - 1] == ' '; n--)
        name[n - 1] = 0;
    jox_pack_text(pack, COLUMNS, &column->name, name);
    jox_pack_text(pack, COLUMNS, &column->unit, unit ? unit : "");
    jox_pack_list(pack, COLUMNS, &column->numbers, NUMBERS);
    bool texts = false;
    for (uint32_t r = 1; r <= rows; r++) {
        double *number = jox_pack_add(pack, NUMBERS, sizeof *number);
        const char *cell = cells->items[(size_t)r * cells->columns + c];
        texts |= !parse_number(cell, number) && *cell;
    }
    if (!texts)
        return;
    jox_pack_list(pack, COLUMNS, &column->texts, TEXTS);
    for (uint32_t r = 1; r <= rows; r++) {
        const char **text = jox_pack_add(pack, TEXTS, sizeof *text);
        jox_pack_text(pack, TEXTS, text, cells->items[(size_t)r * cells->columns + c]);
    }
}

static JoTable *parse_probe_csv(char *text) {
    Cells cells = {0};
    JoxPack pack = {0};
    JoTable *head = jox_pack_add(&pack, HEAD, sizeof *head);
    read_cells(text, &cells);
    head->column_count = cells.columns;
    head->row_count = cells.columns ? (uint32_t)(cells.count / cells.columns) - 1 : 0;
    jox_pack_list(&pack, HEAD, &head->columns, COLUMNS);
    for (uint32_t c = 0; c < head->column_count; c++)
        add_column(&cells, c, head->row_count, &pack);
    jox_free(cells.items);
    return jox_pack_end(&pack);
}

JoTable *jo_scene_probe_table(const JoScene *scene, uint32_t n) {
    JOX_REQUIRE(scene, NULL);
    const JoxProbe *probe = jox_run_probe(scene, n);
    char *text = probe ? write_probe_csv(probe) : NULL;
    if (!text)
        return NULL;
    JOX_GUARD (NULL, NULL) {
        free(text);
        return NULL;
    }
    JoTable *table = jox_disown(parse_probe_csv(text));
    free(text);
    return table;
}
