/* Shared by draw*.c alone. */
#ifndef JOX_PICTURE_DRAW_PARTS_H
#define JOX_PICTURE_DRAW_PARTS_H

#include "picture/draw.h"

enum { JOX_DRAW_BINS = 32, JOX_DRAW_LABELS = 256 };
#define JOX_DRAW_STRIP 92.0f /* units: height of the legend below a panel's map */

typedef struct JoxDrawing {
    JoxCanvas *canvas;
    const JoxPicture *picture;
    float unit;       /* px: what is one in a picture of the usual size */
    float scale;      /* px/m */
    JoxV2 low, high;  /* px: of the map, upper left and lower right */
    float panel;      /* px: where the legend begins */
    JoxInk *inks;     /* by class; NULL where people are not coloured by classes */
    uint32_t *people; /* by class, or bin of the value */
    uint32_t classes;
    struct {
        JoxV2 low, high;
    } labels[JOX_DRAW_LABELS]; /* px: taken by names */
    uint32_t label_count;
    bool headings, outside; /* are drawn; some people are not, as they are outside the area */
} JoxDrawing;

extern const JoxInk jox_ink_text, jox_ink_faint, jox_ink_wall, jox_ink_solid, jox_ink_gate,
    jox_ink_place, jox_ink_body, jox_ink_body_line, jox_ink_path, jox_ink_probe, jox_ink_exit;
static inline JoxInk jox_ink_with(JoxInk ink, float a) {
    ink.a = a;
    return ink;
}

static inline JoxV2 jox_draw_at(const JoxDrawing *d, JoxV2 p) {
    return (JoxV2){d->low.x + (p.x - d->picture->low.x) * d->scale,
                   d->high.y - (p.y - d->picture->low.y) * d->scale};
}
/* The width that writing takes in about any sans-serif type, px. */
float jox_draw_width(const char *text, float size, bool bold);
/* Copies text, cut with an ellipsis where it would be wider than so many px. */
void jox_draw_fit(char *out, size_t capacity, const char *text, float size, bool bold, float wide);
/* Colour and name of the n-th class. */
JoxInk jox_draw_class(const JoxDrawing *drawing, uint32_t n, const char **name);
/* Sets `classes` and `inks`. */
void jox_draw_classes(JoxDrawing *drawing);
bool jox_draw_is_class(JoxShow show);
/* Colour of the n-th of JOX_DRAW_BINS steps of what people's colours tell, where it is a value or a
   direction. */
JoxInk jox_draw_value_ink(const JoxPicture *picture, uint32_t n);
/* Colour of the n-th of JOX_DRAW_BINS steps on the floor: greys where people's colours are of a
   value as well. */
JoxInk jox_draw_floor_ink(const JoxPicture *picture, uint32_t n);

/* The number of points that draw ring r of the walls, 0 for the second side of a thin one, and
   whether they are to be closed. */
uint32_t jox_draw_ring_points(const JoxWalls *walls, uint32_t r, bool *closed);
/* A line of the plan. */
void jox_draw_plan_line(const JoxDrawing *drawing, const JoxV2 *points, uint32_t count, bool closed,
                        const char *name);
/* Whether people leave at a place of this name. */
bool jox_draw_is_exit(const JoxPicture *picture, const char *name);

void jox_draw_field(JoxDrawing *drawing);
void jox_draw_people(JoxDrawing *drawing);
void jox_draw_probes(JoxDrawing *drawing);
void jox_draw_names(JoxDrawing *drawing);
void jox_draw_legend(JoxDrawing *drawing);

#endif
