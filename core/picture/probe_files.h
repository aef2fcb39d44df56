/* The files of a probe: its table, and its picture. */
#ifndef JOX_PICTURE_PROBE_FILES_H
#define JOX_PICTURE_PROBE_FILES_H

#include "record/probes/probe.h"

enum { JOX_PROBE_STEM = 120 };
/* NAME of the probe's files: its name, fit for one. */
void jox_probe_stem(const JoxProbe *probe, char stem[JOX_PROBE_STEM]);
/* NAME.csv, and with a title NAME.png and NAME.svg, into a folder that is there. False with a
   sentence in `error`. */
bool jox_probe_write(const JoxProbe *probe, const char *folder, const JoxWalls *walls,
                     const char *title, JoxText *error);

#endif
