/* Top views of a crowd: walls and gates, places, bodies as outlines, people as discs or torsos in
   colours, a field on the floor, and a legend. Callers (render, report, sweep) fill in a JoxPicture
   and draw it on any canvas with jox_draw. Lengths are in metres, times in seconds. */
#ifndef JOX_PICTURE_DRAW_H
#define JOX_PICTURE_DRAW_H

#include "body/body.h"
#include "geom/place.h"
#include "geom/storeys.h"
#include "picture/canvas.h"
#include "record/fields/density.h"
#include "record/frame.h"
#include "record/trajectory_reader.h"
#include "scene/scenery.h"

/* Quantity that the colours of people, or of the floor, show. */
typedef enum JoxShow {
    JOX_SHOW_NOTHING, /* people are drawn as rings, the floor is left bare */
    JOX_SHOW_STATE,
    JOX_SHOW_GROUP,
    JOX_SHOW_SPEED,
    JOX_SHOW_FORCE,
    JOX_SHOW_COMPRESSION,
    JOX_SHOW_LOAD,
    JOX_SHOW_DENSITY,
    JOX_SHOW_DIRECTION, /* direction of walking; for people who stand, of looking */
    JOX_SHOW_PRESSURE,  /* crowd pressure, for the floor only */
    JOX_SHOWS
} JoxShow;
/* Per quantity: its name in options, its heading in legends with its unit, and the default value
   at the upper end of its colour bar (0 where colours stand for classes, not values). */
extern const struct JoxShown {
    const char *name, *legend;
    float most;
} jox_shown[JOX_SHOWS];

enum { JOX_OUTLINE_POINTS = 32 }; /* greatest number of an outline's corners */

/* Outline from above of one convex part of a body: a ring of corners or a disc. */
typedef struct JoxDrawnBody {
    const char *name; /* the body's name; "" if it has none */
    JoxV2 ring[JOX_OUTLINE_POINTS];
    uint32_t count; /* corners of the ring; 0: the part is a disc */
    JoxV2 at;       /* m: centre */
    float radius;   /* m: of the disc */
    float low, top; /* m: heights of its lower and upper end */
    /* the body is out of reach of people: above their heads or flat on the ground */
    bool high;
} JoxDrawnBody;

/* Computes the outline of a part from above, for a body at a point (origin of the shape's frame,
   m) with a rotation (quaternion x, y, z, w). Returns false where it has no finite position or
   outline. */
bool jox_draw_outline(const JoxBodyLook *look, JoxV3 at, const float turn[4], JoxDrawnBody *out);
/* Sets `high` of all parts of one body: none of them reaches the height band in which people
   touch things. */
void jox_draw_mark_high(JoxDrawnBody *parts, size_t count);

/* A growing list of outlines. The owner frees `items` with jox_free. */
typedef struct JoxDrawnBodies {
    JoxDrawnBody *items;
    size_t count, capacity;
} JoxDrawnBodies;
/* Appends the outlines of a world's bodies as they are now. Their names belong to the world. */
void jox_draw_add_bodies(JoxDrawnBodies *out, const JoxBodies *bodies);
/* Appends the outlines of a recording's bodies in the last frame at or before a time, s; nothing
   if the recording has no bodies. */
void jox_draw_add_recorded(JoxDrawnBodies *out, JoxTrajectoryReader *reader, double time);

/* The path of a person or body. A point that is not finite interrupts it. */
typedef struct JoxTrail {
    uint32_t key; /* the person's JoxFrame.key, or the body's id */
    uint16_t group;
    bool body;
    JoxV2 *points;
    uint32_t count, capacity;
} JoxTrail;

/* Geometry of a probe: a line, a pair of lines (4 points, not closed) or an area (closed). */
typedef struct JoxDrawnProbe {
    const char *name;
    const JoxV2 *points;
    uint32_t count;
    bool closed;
} JoxDrawnProbe;

/* A piece of a wall and its load, drawn in the floor's colour scale. */
typedef struct JoxDrawnLoad {
    JoxV2 ends[2]; /* m */
    float value;   /* in the unit of the field on the floor */
} JoxDrawnLoad;

/* Input of jox_draw. All pointers are borrowed for the call. */
typedef struct JoxPicture {
    const char *title;
    const char *when; /* text at the right of the title; NULL: the frame's time */
    const JoxFrame *frame;
    /* unit vectors of looking, per person; NULL: along the velocities */
    const float *face_x, *face_y;
    const float *density;  /* 1/m2, per person; NULL: not known */
    const JoxWalls *walls; /* with the open gates */
    uint32_t ground;       /* index of jox_floor_names */
    const JoxScenery *scenery;
    uint32_t scenery_count;
    const JoxPlace *places;
    uint32_t place_count;
    const char *const *exits; /* names of places where people leave */
    uint32_t exit_count;
    const JoxDrawnProbe *probes;
    uint32_t probe_count;
    const JoxDrawnLoad *wall_loads;
    uint32_t wall_load_count;
    const JoxDrawnBody *bodies;
    uint32_t body_count;
    const JoxTrail *trails;
    uint32_t trail_count, trail_people; /* how many people have a trail */
    const JoxDensity *grid;             /* grid of the field; NULL: the floor is bare */
    const float *field;                 /* one value per cell of the grid */
    JoxShow colour, floor;
    float colour_most, floor_most; /* values at the upper ends of the colour bars */
    const char *field_legend;      /* heading of the field's legend; NULL: chosen by `floor` */
    bool change; /* the field is a difference, from -floor_most (blue) to floor_most */
    /* drawn as one of several panels of a page: the legend is a strip below the map */
    bool panel;
    float radius;    /* m: of every person, used if the frame has no radii */
    JoxV2 low, high; /* m: lower and upper corner of the area shown; with storeys, in plan */
    const JoxStoreys *storeys; /* each is drawn in a panel of its own; NULL: one plane */
    const JoxLift *lifts;      /* laid out */
    uint32_t lift_count;
    const JoxCarLook *cars; /* one for each lift; NULL: shafts alone are drawn */
} JoxPicture;

/* Choose a picture's size in pixels, both even, for its area and storeys. The second is for a panel
   and returns true if the panel takes a whole line of a page, false if half of one. */
void jox_draw_size(const JoxPicture *picture, uint32_t *width, uint32_t *height);
bool jox_draw_panel_size(const JoxPicture *picture, uint32_t *width, uint32_t *height);
/* Draws a picture on a canvas, whose former content is dropped. */
void jox_draw(JoxCanvas *canvas, const JoxPicture *picture);

#endif
