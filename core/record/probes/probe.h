/* Probes: they see the frames of a run or of a recording one by one, and leave figures, a CSV file
   and a picture. What each kind measures and by which formula stands in its own file. */
#ifndef JOX_RECORD_PROBES_PROBE_H
#define JOX_RECORD_PROBES_PROBE_H

#include <stdbool.h>

#include "base/text.h"
#include "geom/walls.h"
#include "record/frame.h"
#include "world/probe.h"

typedef struct JoxProbe JoxProbe;
enum { JOX_MOST_FIGURES = 16, JOX_PROBE_STEM = 120 };

/* Figures by name, in SI units; NAN where nothing was seen that could give one. */
typedef struct JoxFigures {
    struct JoxFigure {
        const char *name, *unit; /* "" without a unit */
        double value;
    } items[JOX_MOST_FIGURES];
    uint32_t count;
} JoxFigures;

/* Copies the def. */
JoxProbe *jox_probe_create(const JoxProbeDef *def);
/* Whether it wants a frame of time t, s: most look ten times a second, some at every step. */
bool jox_probe_is_due(const JoxProbe *probe, double t);
/* Frames in ascending time; those that are not due, or outside from..until, are passed over. */
void jox_probe_frame(JoxProbe *probe, const JoxFrame *frame);
/* The figures so far. */
JoxFigures jox_probe_figures(const JoxProbe *probe);
/* Passages of a flow that stand so far; 0 of other kinds. */
uint32_t jox_probe_passages(const JoxProbe *probe);
/* Adds {"flow": 1.15, ...}. */
void jox_probe_json(const JoxProbe *probe, JoxText *out);
/* NAME of the probe's files: its name, fit for one. */
void jox_probe_stem(const JoxProbe *probe, char stem[JOX_PROBE_STEM]);
/* NAME.csv, and with a title NAME.png and NAME.svg, into a folder that is there. False with a
 * sentence in `error`. */
bool jox_probe_write(const JoxProbe *probe, const char *folder, const JoxWalls *walls,
                     const char *title, JoxText *error);
const JoxProbeDef *jox_probe_def(const JoxProbe *probe);
void jox_probe_free(JoxProbe *probe);

#endif
