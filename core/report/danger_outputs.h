/* Files of danger measures: tables, and plots over time. Runs' reports (run_report.c) and
   recordings' (report.c) write them at their end. */
#ifndef JOX_REPORT_DANGER_OUTPUTS_H
#define JOX_REPORT_DANGER_OUTPUTS_H

#include "record/danger/danger.h"

/* Writes into an existing folder danger.csv (over time), danger-map.csv (by cell),
   danger-limits.csv, danger-levels.csv (levels of service), danger-congestion.csv,
   danger-areas.csv (levels by area and time), danger-leaving.csv, danger-people.csv (people with
   high loads), danger-lines.csv, danger-stairs.csv and danger-walls.csv; tables of unknown
   quantities are left out. With a title, also plots danger, leaving, levels and stairs as PNG and
   SVG. Returns false with a sentence in `error`. */
bool jox_danger_write(const JoxDanger *danger, const char *folder, const char *title,
                      JoxText *error);

/* px: width of the plots, and height of each strip of those of danger and leaving */
enum { JOX_DANGER_STRIPS_WIDE = 1300, JOX_DANGER_STRIP = 215 };
/* Returns the number of strips of the plot of danger. */
int jox_danger_count_strips(const JoxDanger *danger);
/* Returns the number of strips of the plot of levels of service, and their height, px; 0: there is
   no plot, as at most one level occurred. */
int jox_danger_count_level_strips(const JoxDanger *danger);
int jox_danger_level_strip_height(const JoxDanger *danger);
/* Returns the number of strips of the plot of stairs: one for each stair that people were on, at
   most JOX_MOST_STAIR_STRIPS, those with the most people. */
enum { JOX_MOST_STAIR_STRIPS = 20 };
int jox_danger_count_stair_strips(const JoxDanger *danger);

#endif
