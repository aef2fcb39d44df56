/* Probes: they see the frames of a run or of a recording one by one, and leave figures, a CSV file
   and a picture. What each kind measures and by which formula stands in its own file. */
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

/* Figures by name, in SI units; NAN where nothing was seen that could give one. */
typedef struct JoxFigures {
    struct JoxFigure {
        const char *name, *title, *unit; /* key, the same in words, and "" without a unit */
        double value;
        const char *why; /* there is no value, in words; NULL: nobody was seen that gives one */
    } items[JOX_MOST_FIGURES];
    uint32_t count;
} JoxFigures;

/* Copies the def. */
JoxProbe *jox_probe_create(const JoxProbeDef *def);
/* Whether it wants a frame of time t, s: most look ten times a second, some at every step. */
bool jox_probe_is_due(const JoxProbe *probe, double t);
/* Frames in ascending time; those that are not due, or outside from..until, are passed over. */
void jox_probe_frame(JoxProbe *probe, const JoxFrame *frame);
/* All that it has seen, for one of the same def. */
void jox_probe_sections(JoxProbe *probe, JoxSections *sections);
/* The figures so far. */
JoxFigures jox_probe_figures(const JoxProbe *probe);
/* Passages of a flow that stand so far; 0 of other kinds. */
uint32_t jox_probe_passages(const JoxProbe *probe);
/* Of a flow that nobody has passed along its direction: how often it was crossed against it. */
uint32_t jox_probe_against(const JoxProbe *probe);
/* Appends when and whom it measures, where that is not everybody all the time: "from 80 s on",
   "from 10 to 60 s, one group". */
void jox_probe_window(const JoxProbe *probe, JoxText *out);
/* Adds {"flow": 1.15, ..., "why": {"flow": "..."} for those that have no value, "from": 80,
 * "until": null}; until is null without an end. */
void jox_probe_json(const JoxProbe *probe, JoxJson *json, const char *key);
/* Writes the table: a first line with names and units in brackets, then rows. */
void jox_probe_csv(const JoxProbe *probe, FILE *out);
/* Appends the gnuplot commands that draw NAME.csv, and gives the picture's size in pixels. With
   `walls`, walls.dat is drawn too. */
void jox_probe_plot(const JoxProbe *probe, bool walls, JoxText *commands, int *width, int *height);
const JoxProbeDef *jox_probe_def(const JoxProbe *probe);
/* "flow", "measure", ... */
const char *jox_probe_kind_name(const JoxProbe *probe);
void jox_probe_free(JoxProbe *probe);

#endif
