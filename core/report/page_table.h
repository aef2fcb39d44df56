/* Tables of report pages. A table is filled row by row, then written twice: into the page, without
   rows and columns that are 0 throughout, and with all of them as table-NAME.csv beside the
   page. */
#ifndef JOX_REPORT_PAGE_TABLE_H
#define JOX_REPORT_PAGE_TABLE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "base/text.h"

enum { JOX_TABLE_COLUMNS = 16 }; /* most columns */

typedef struct JoxTableCell {
    char *text; /* owned; NULL: a number */
    double value;
    bool is_unit; /* the text is a unit: spelled out on the page, as "1/m2" in the file */
} JoxTableCell;

typedef struct JoxPageTable {
    const char *name, *folder; /* of table-NAME.csv */
    JoxText *error;            /* gets a sentence if the file cannot be written */
    /* Column heads separated by '|'; a leading '>' marks numbers; a unit stands in brackets at the
       end: "crossed|>width [m]". Units are those of html.h. */
    const char *heads;
    /* Beginning of the sentence that lists rows of zeros and unknown numbers, by their first cell:
       "Nobody was over". NULL: such rows are written. */
    const char *zero_rows;
    uint32_t most_rows; /* rows on the page; 0: all */
    JoxTableCell *cells;
    uint32_t columns, count, capacity; /* columns of the heads; cells */
} JoxPageTable;

/* Add cells, from left to right and row by row: a text, a unit of html.h, a number (NAN: not
   known). */
void jox_table_text(JoxPageTable *table, const char *text);
void jox_table_unit(JoxPageTable *table, const char *unit);
void jox_table_number(JoxPageTable *table, double value);
/* Writes the page's table, the sentences on what it leaves out, the link to the file, and the file;
   frees the cells. A table without rows writes nothing. */
void jox_table_put(FILE *out, JoxPageTable *table);

#endif
