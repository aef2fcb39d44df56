/* What the tables of danger and its pictures share. */
#ifndef JOX_REPORT_DANGER_FILES_PARTS_H
#define JOX_REPORT_DANGER_FILES_PARTS_H

#include "record/danger/danger_parts.h"
#include "report/danger_files.h"

/* Of a cell: over samples, of what is borne over the people who stood there. */
double jox_danger_mean(const JoxDanger *danger, int measure, size_t cell);
/* NAN where it was never measured. */
double jox_danger_greatest(const JoxDanger *danger, int measure, size_t cell);
/* danger.csv and danger-*.csv; those of what is not known are not written. */
bool jox_danger_write_tables(const JoxDanger *danger, const char *folder, JoxText *error);

#endif
