/* Plans and maps of the floor: one drawing, all panels of one size. */
#ifndef JOX_REPORT_MAPS_H
#define JOX_REPORT_MAPS_H

#include "picture/draw.h"
#include "report/subject.h"

/* An upper end of a scale: 1, 2, 3, 4, 5, 6, 8 or 10 times a power of ten. */
float jox_maps_scale_end(double most);
/* What all pictures of a subject show. */
JoxPicture jox_maps_begin(const JoxSubject *subject, const JoxFrame *frame);
/* As NAME.png, where this build makes images, and, unless there are too many people in it, as
   NAME.svg. */
bool jox_maps_put(const JoxSubject *subject, const JoxPicture *picture, const char *name,
                  JoxText *error);
/* plan.svg: every place, probe and exit, with their names; what lies far outside of what is
   measured is left out. */
bool jox_maps_draw_plan(const JoxSubject *subject, JoxText *error);

/* A field over the subject's grid. */
typedef struct JoxMapField {
    const char *file, *title, *when, *legend;
    JoxShow show;
    const float *values; /* by cell; NAN: not known */
    double most;         /* of the scale, which ends at a round number */
    const JoxDrawnLoad *wall_loads;
    uint32_t wall_load_count;
} JoxMapField;
bool jox_maps_draw_field(const JoxSubject *subject, const JoxMapField *field, JoxText *error);
/* Begins panels of the page for them. */
void jox_maps_panels(FILE *out, const JoxSubject *subject);

#endif
