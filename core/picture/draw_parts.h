/* State of one drawing and helpers, private to draw*.c. jox_draw (draw.c) calls the others'
   functions layer by layer. */
#ifndef JOX_PICTURE_DRAW_PARTS_H
#define JOX_PICTURE_DRAW_PARTS_H

#include "picture/draw.h"

/* Steps of a colour scale; greatest number of names on a map. */
enum { JOX_DRAW_BINS = 32, JOX_DRAW_LABELS = 256 };
/* height of the legend below a panel's map, in units (JoxDrawing.unit) */
#define JOX_DRAW_STRIP 92.0f

/* Where the plans of storeys lie in a picture, m in the picture's own plane; without storeys the
   area alone. */
typedef struct JoxPanels {
    const JoxStoreys *storeys;
    uint32_t columns, rows;
    JoxV2 step;                /* m: from panel to panel */
    JoxV2 plan_low, plan_high; /* m in plan: corners of a panel */
    JoxV2 low, high;           /* m: corners of all */
} JoxPanels;

/* A picture while it is drawn. People are drawn by class, which is a state, a group or a bin of
   a value. */
typedef struct JoxDrawing {
    JoxCanvas *canvas;
    const JoxPicture *picture;
    JoxPanels panels;
    float unit;        /* scale of type and line widths: px per px of a picture of the usual size */
    float scale;       /* px/m */
    JoxV2 low, high;   /* px: the map's upper left and lower right corner */
    float legend_left; /* px: left edge of the legend */
    JoxInk *inks;      /* colour per class; NULL where colours stand for values */
    uint32_t *people;  /* number of people per class */
    uint32_t classes;  /* number of classes */
    struct {
        JoxV2 low, high;
    } labels[JOX_DRAW_LABELS]; /* px: boxes taken by names so far */
    uint32_t label_count;
    /* headings were drawn; people who have fallen were; some people are outside the area and were
       not drawn */
    bool headings, fallen, outside;
} JoxDrawing;

extern const JoxInk jox_ink_text, jox_ink_faint, jox_ink_wall, jox_ink_solid, jox_ink_gate,
    jox_ink_place, jox_ink_body, jox_ink_body_line, jox_ink_path, jox_ink_probe, jox_ink_exit;
/* Returns a colour with another opacity. */
static inline JoxInk jox_ink_with(JoxInk ink, float a) {
    ink.a = a;
    return ink;
}

/* draw_storeys.c: lays the panels of a picture out; returns the panel of a position, where a point
   of the plan lies in a panel, and where a position lies; draws the panels' floors, a field of
   which `levels` has a level for each cell of the grid, and the stairs. */
JoxPanels jox_draw_lay_panels(const JoxPicture *picture);
uint32_t jox_draw_panel_of(const JoxPanels *panels, JoxV2 at);
JoxV2 jox_draw_in_panel(const JoxPanels *panels, uint32_t panel, JoxV2 plan);
JoxV2 jox_draw_in_panels(const JoxPanels *panels, JoxV2 at);
void jox_draw_panel_floors(JoxDrawing *drawing, JoxInk ground);
void jox_draw_panel_fields(JoxDrawing *drawing, const uint8_t *levels, const JoxInk *ink);
/* Converts a point of the plan on a storey to pixels. */
JoxV2 jox_draw_plan_pixels(const JoxDrawing *drawing, uint32_t storey, JoxV2 plan);
void jox_draw_stairs(JoxDrawing *drawing);
/* draw_lifts.c: draws the shafts and cars of lifts. */
void jox_draw_lifts(JoxDrawing *drawing);

/* Converts a point of the picture's own plane, m, to pixels. */
static inline JoxV2 jox_draw_panel_pixels(const JoxDrawing *d, JoxV2 p) {
    return (JoxV2){d->low.x + (p.x - d->panels.low.x) * d->scale,
                   d->high.y - (p.y - d->panels.low.y) * d->scale};
}
/* Converts a position, m, to pixels. */
static inline JoxV2 jox_draw_to_pixels(const JoxDrawing *d, JoxV2 p) {
    return jox_draw_panel_pixels(d, d->panels.storeys ? jox_draw_in_panels(&d->panels, p) : p);
}
/* Estimates the width of text, px, on the wide side for common sans-serif fonts. `size` is the
   font size, px. */
float jox_draw_text_width(const char *text, float size, bool bold);
/* Copies text, shortened with an ellipsis to a width of at most `wide` px. */
void jox_draw_fit_text(char *out, size_t capacity, const char *text, float size, bool bold,
                       float wide);
/* Returns the colour of class n and sets its name. */
JoxInk jox_draw_class_ink(const JoxDrawing *drawing, uint32_t n, const char **name);
/* Sets `classes` and `inks` of the drawing. */
void jox_draw_choose_classes(JoxDrawing *drawing);
/* Returns whether a quantity has classes (state, group) rather than values. */
bool jox_draw_is_class(JoxShow show);
/* Returns the colour of bin n (below JOX_DRAW_BINS) of the people's quantity, if that is a value
   or a direction. */
JoxInk jox_draw_value_ink(const JoxPicture *picture, uint32_t n);
/* Returns the colour of bin n on the floor: grey where the people's colours show a value too. */
JoxInk jox_draw_floor_ink(const JoxPicture *picture, uint32_t n);

/* Returns how many vertices of wall ring r have to be drawn, 0 for the second side of a thin
   wall, and whether the line is to be closed. */
uint32_t jox_draw_ring_points(const JoxWalls *walls, uint32_t r, bool *closed);
/* Draws a line given in metres; `name`, or NULL, is its tooltip. */
void jox_draw_plan_line(const JoxDrawing *drawing, const JoxV2 *points, uint32_t count, bool closed,
                        const char *name);
/* Returns whether a place of this name is an exit. */
bool jox_draw_is_exit(const JoxPicture *picture, const char *name);

/* draw_scenery.c: colour of the floor; scenery beneath people. */
JoxInk jox_draw_ground_ink(const JoxPicture *picture);
void jox_draw_scenery(const JoxDrawing *drawing);
/* Returns whether a thing stands in a solid wall and covers half of its box at least. */
bool jox_draw_fills_wall(const JoxPicture *picture, const struct JoxWallRing *ring);
void jox_draw_field(JoxDrawing *drawing);
void jox_draw_people(JoxDrawing *drawing);
void jox_draw_probes(JoxDrawing *drawing);
void jox_draw_names(JoxDrawing *drawing);
void jox_draw_legend(JoxDrawing *drawing);

#endif
