/* Files of a probe: its table and its plot. Runs and reports write them at their end. */
#ifndef JOX_PICTURE_PROBE_FILES_H
#define JOX_PICTURE_PROBE_FILES_H

#include "record/probes/probe.h"

enum { JOX_PROBE_STEM = 120 };
/* Makes the stem of the probe's file names from its name. */
void jox_probe_stem(const JoxProbe *probe, char stem[JOX_PROBE_STEM]);
/* Writes STEM.csv and, with a title, STEM.plt, STEM.png and STEM.svg into an existing folder.
   Returns false with a sentence in `error`. */
bool jox_probe_write(const JoxProbe *probe, const char *folder, const JoxWalls *walls,
                     const char *title, JoxText *error);

#endif
