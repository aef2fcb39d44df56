/* Files of danger measures: tables, and plots over time. Runs' reports (run_report.c) and
   recordings' (report.c) write them at their end. */
#ifndef JOX_REPORT_DANGER_OUTPUTS_H
#define JOX_REPORT_DANGER_OUTPUTS_H

#include "record/danger/danger.h"

/* Writes into an existing folder danger.csv (over time), danger-map.csv (by cell),
   danger-limits.csv, danger-levels.csv (levels of service), danger-congestion.csv,
   danger-areas.csv (levels by area and time), danger-leaving.csv, danger-people.csv (people with
   high loads), danger-lines.csv and danger-walls.csv; tables of unknown quantities are left out.
   With a title, also plots danger, leaving and levels as PNG and SVG. Returns false with a
   sentence in `error`. */
bool jox_danger_write(const JoxDanger *danger, const char *folder, const char *title,
                      JoxText *error);

#endif
