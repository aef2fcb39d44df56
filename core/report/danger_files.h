/* The files of danger. */
#ifndef JOX_REPORT_DANGER_FILES_H
#define JOX_REPORT_DANGER_FILES_H

#include "record/danger/danger.h"

/* danger.csv (over time), danger-map.csv (by place), danger-limits.csv, danger-levels.csv (of
   service), danger-areas.csv (the same by area and time), danger-leaving.csv, danger-people.csv
   (who bore what), danger-lines.csv and danger-walls.csv into a folder that is there; with a title,
   also danger, leaving and levels as PNG and SVG. False with a sentence in `error`. */
bool jox_danger_write(const JoxDanger *danger, const char *folder, const char *title,
                      JoxText *error);

#endif
