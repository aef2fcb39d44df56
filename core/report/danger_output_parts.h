/* Declarations shared by the tables, plots and maps of danger; private to report. */
#ifndef JOX_REPORT_DANGER_OUTPUT_PARTS_H
#define JOX_REPORT_DANGER_OUTPUT_PARTS_H

#include "record/danger/danger_parts.h"
#include "report/danger_outputs.h"

/* strip_plots.c: a plot of strips over time, NAME.plt, NAME.png and NAME.svg. */
typedef struct JoxStripPlot {
    const char *name, *title;                      /* title: of jox_strips_title */
    int strips, height;                            /* number; px of each */
    void (*write)(const void *what, FILE *script); /* writes the commands of all strips */
    const void *what;
} JoxStripPlot;

/* Fills the text with which the title of the first strip begins. */
enum { JOX_STRIP_TITLE = 400 };
void jox_strips_title(const char *title, char out[JOX_STRIP_TITLE]);
/* Writes the command for the title of a strip; that of the first one begins with the plot's. */
void jox_strips_set_title(FILE *script, const char *title);
/* Draws a plot over the time that was measured, as PNG and SVG; nothing without strips. Returns
   false with a sentence in `error`. */
bool jox_danger_draw_strips(const JoxDanger *danger, const char *folder, const JoxStripPlot *plot,
                            JoxText *error);
/* stair_plots.c: writes the strips of stairs. */
void jox_danger_write_stair_strips(const void *danger, FILE *script);

/* Returns a measure's greatest value in a cell; NAN where crowd pressure was never measured. */
double jox_danger_cell_greatest(const JoxDanger *danger, int measure, size_t cell);
/* Writes danger.csv and danger-*.csv; those of unknown quantities are not written. Returns false
   with a sentence in `error`. */
bool jox_danger_write_tables(const JoxDanger *danger, const char *folder, JoxText *error);

#endif
