/* Checked values of a recording's tables, which strangers may have written. A value that makes no
   sense is told with its table, the row's keys and its column; the readers of storeys, lifts and
   walls use it. */
#ifndef JOX_RECORD_TABLE_ROWS_H
#define JOX_RECORD_TABLE_ROWS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/database.h"
#include "base/text.h"
#include "base/vec.h"

/* Way out that errors about tables give. */
#define JOX_ROW_HINT "Copy or record it anew, or mend that row"

/* One row of a query. Once a value is damaged, `why` has the sentence and later ones are left
   unchecked. */
typedef struct JoxTableRow {
    sqlite3_stmt *values;
    const char *table;
    int keys;     /* the first columns of the query, whole numbers that messages name the row by */
    JoxText *why; /* empty while the row is sound */
} JoxTableRow;

/* Reads a row into `context`; returns false at damage, with a sentence in row->why. */
typedef bool JoxReadRow(JoxTableRow *row, void *context);
/* Reads all rows of a query. Returns false with a sentence in `why` if a row is damaged, or the
   table is missing or cannot be read. */
bool jox_table_read(JoxDatabase *db, const char *table, const char *query, int keys,
                    JoxReadRow *read, void *context, JoxText *why);
/* Adds the sentence "table T, KEY N: COLUMN is VALUE: MUST" and returns false. */
bool jox_row_fail(const JoxTableRow *row, int column, const char *must);
/* Returns whether no value was damaged so far. */
bool jox_row_is_sound(const JoxTableRow *row);
/* Returns a number of a column; `least` unless it is a number from `least` to `greatest`. */
double jox_row_number(const JoxTableRow *row, int column, double least, double greatest);
/* The same for whole numbers. */
int64_t jox_row_whole(const JoxTableRow *row, int column, int64_t least, int64_t greatest);
/* Returns a copy of a name, which the caller frees; damage if it is missing or empty. */
char *jox_row_name(const JoxTableRow *row, int column);
/* Returns the index of a column's text among names. */
uint32_t jox_row_choice(const JoxTableRow *row, int column, const char *const *names,
                        uint32_t count);
/* Reads "x y, x y, ..." into `points`, of which the caller frees the array, and returns their
   number; damage unless it is at least `least`. NULL and "" are no points. */
uint32_t jox_row_points(const JoxTableRow *row, int column, uint32_t least, JoxV2 **points);

#endif
