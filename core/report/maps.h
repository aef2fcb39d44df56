/* The plan and the maps of a report. maps.c and snapshots.c draw with them, as does sweep for
   comparisons; all panels of a page have one size. */
#ifndef JOX_REPORT_MAPS_H
#define JOX_REPORT_MAPS_H

#include "picture/draw.h"
#include "report/subject.h"

/* Returns the upper end of a colour scale for a greatest value: 1, 2, 3, 4, 5, 6, 8 or 10 times
   a power of ten. */
float jox_maps_scale_end(double most);
/* Returns a picture with the parts common to all of a subject: walls, places, bodies and area. */
JoxPicture jox_maps_new_picture(const JoxSubject *subject, const JoxFrame *frame);
/* Draws a picture into the subject's folder: NAME.png if the build has images, and NAME.svg
   unless there are too many people in it. Returns false with a sentence in `error`. */
bool jox_maps_write_picture(const JoxSubject *subject, const JoxPicture *picture, const char *name,
                            JoxText *error);
/* Draws plan.svg and plan.png: places, probes and exits with their names. Places and probes far
   outside of the measured area do not widen the plan. */
bool jox_maps_draw_plan(const JoxSubject *subject, JoxText *error);

/* A field to draw over the subject's grid. */
typedef struct JoxMapField {
    const char *file, *title;  /* stem of the file name; heading */
    const char *when, *legend; /* time span in words; heading of the colour scale */
    JoxShow show;
    const float *values; /* per cell; NAN: not known */
    double most;         /* greatest value; the scale ends at the next round number */
    bool change;         /* values are differences, from -most to most */
    const JoxDrawnLoad *wall_loads;
    uint32_t wall_load_count;
} JoxMapField;
bool jox_maps_draw_field(const JoxSubject *subject, const JoxMapField *field, JoxText *error);
/* Opens the grid of a page's panels for such maps (jox_html_panels). */
void jox_maps_panels(FILE *out, const JoxSubject *subject);

#endif
