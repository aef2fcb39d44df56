/* Probes measure frames of a run or of a recording, and leave figures, a CSV table and a plot. The
   file of each kind begins with what it measures and by which formula; probe.c calls it through
   JoxProbeCalls (probe_parts.h). A run or an analysis of a recording creates a probe from its
   definition in the scene, gives each frame by jox_probe_frame, reads the results, and frees it. */
#ifndef JOX_RECORD_PROBES_PROBE_H
#define JOX_RECORD_PROBES_PROBE_H

#include <stdbool.h>
#include <stdio.h>

#include "base/format/json_writer.h"
#include "base/sections.h"
#include "base/text.h"
#include "geom/walls.h"
#include "record/frame.h"
#include "world/probe.h"

typedef struct JoxProbe JoxProbe;
enum { JOX_MOST_FIGURES = 16 };

/* Figures by name, in SI units; NAN where nothing was seen that gives a value. */
typedef struct JoxFigures {
    struct JoxFigure {
        const char *name, *title, *unit; /* key, title in words, and unit; "" without a unit */
        double value;
        const char *why; /* why there is no value; NULL: nobody was seen that gives one */
    } items[JOX_MOST_FIGURES];
    uint32_t count;
} JoxFigures;

/* Creates a probe; copies its definition. */
JoxProbe *jox_probe_create(const JoxProbeDef *def);
/* Returns whether the probe takes a frame at time t, s: most kinds take ten per second, some each
   step. */
bool jox_probe_is_due(const JoxProbe *probe, double t);
/* Takes a frame, in ascending order of time. Frames that are not due, or outside from..until, are
   skipped. */
void jox_probe_frame(JoxProbe *probe, const JoxFrame *frame);
/* Lists the state. It can be restored into a probe with the same definition. */
void jox_probe_sections(JoxProbe *probe, JoxSections *sections);
/* Returns the figures so far. */
JoxFigures jox_probe_figures(const JoxProbe *probe);
/* Returns the number of valid passages of a flow so far; 0 for other kinds. */
uint32_t jox_probe_passages(const JoxProbe *probe);
/* Returns the number of crossings against the direction of a flow if nobody crossed in its
   direction, else 0; 0 for other kinds. */
uint32_t jox_probe_against(const JoxProbe *probe);
/* Appends when and for whom it measures, unless that is everybody all the time: "from 80 s on",
   "from 10 to 60 s, one group". */
void jox_probe_window(const JoxProbe *probe, JoxText *out);
/* Writes {"flow": 1.15, ..., "why": {"flow": "..."}, "from": 80, "until": null}. "why" has the
   figures without a value; "until" is null without an end. */
void jox_probe_json(const JoxProbe *probe, JoxJson *json, const char *key);
/* Writes the table: a header with names and units in brackets, then rows. */
void jox_probe_csv(const JoxProbe *probe, FILE *out);
/* Appends the gnuplot commands that draw NAME.csv, and sets the size of the plot in pixels. With
   `walls`, walls.dat is drawn too. */
void jox_probe_plot(const JoxProbe *probe, bool walls, JoxText *commands, int *width, int *height);
/* Returns the size of that plot, px. */
void jox_probe_plot_size(const JoxProbe *probe, int *width, int *height);
const JoxProbeDef *jox_probe_def(const JoxProbe *probe);
/* Returns the name of its kind: "flow", "measure", ... */
const char *jox_probe_kind_name(const JoxProbe *probe);
void jox_probe_free(JoxProbe *probe);

#endif
