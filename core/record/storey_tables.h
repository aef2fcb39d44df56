/* Storeys and stairs in recordings: the tables jostle_storey and jostle_stair. recorder_storeys.c
   writes them, the readers of recordings read them. */
#ifndef JOX_RECORD_STOREY_TABLES_H
#define JOX_RECORD_STOREY_TABLES_H

#include "base/text.h"
#include "geom/storeys.h"

struct JoxDatabase;
extern const char *const jox_stair_kind_names[]; /* by JoxStairKind: "stairs", ... */
extern const char *const jox_stair_way_names[];  /* by JoxStairWay: "both", ... */

/* Reads and lays out the storeys of a recording, which the caller frees; leaves them empty where
   there are none. Returns false with a sentence in `why` that names the table, row and column if
   they are damaged. */
bool jox_storey_tables_read(struct JoxDatabase *db, JoxStoreys *out, JoxText *why);
/* Moves a point in plan to the sheet of a row's storey, and stair if that is not 0. Returns false
   if there are no such storey and stair. */
bool jox_storey_tables_place(const JoxStoreys *storeys, int64_t storey, int64_t stair, float *y);

#endif
