/* Declarations shared by the tables, plots and maps of danger; private to report. */
#ifndef JOX_REPORT_DANGER_OUTPUT_PARTS_H
#define JOX_REPORT_DANGER_OUTPUT_PARTS_H

#include "record/danger/danger_parts.h"
#include "report/danger_outputs.h"

/* Returns a measure's greatest value in a cell; NAN where crowd pressure was never measured. */
double jox_danger_cell_greatest(const JoxDanger *danger, int measure, size_t cell);
/* Writes danger.csv and danger-*.csv; those of unknown quantities are not written. Returns false
   with a sentence in `error`. */
bool jox_danger_write_tables(const JoxDanger *danger, const char *folder, JoxText *error);

#endif
