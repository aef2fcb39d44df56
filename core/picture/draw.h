/* Top views of a crowd: walls and gates, places, bodies as footprints, people as discs with what is
   known of them as colours, a field on the floor, and a legend. Metres, seconds; one drawing code
   for every kind of canvas. */
#ifndef JOX_PICTURE_DRAW_H
#define JOX_PICTURE_DRAW_H

#include "body/body.h"
#include "geom/place.h"
#include "picture/canvas.h"
#include "record/fields/density.h"
#include "record/frame.h"
#include "record/trajectory_reader.h"

/* What colours tell of people, or of the floor. */
typedef enum JoxShow {
    JOX_SHOW_NOTHING, /* people as rings, the floor bare */
    JOX_SHOW_STATE,
    JOX_SHOW_GROUP,
    JOX_SHOW_SPEED,
    JOX_SHOW_FORCE,
    JOX_SHOW_COMPRESSION,
    JOX_SHOW_LOAD,
    JOX_SHOW_DENSITY,
    JOX_SHOW_DIRECTION, /* in which people walk; who stands: look */
    JOX_SHOW_PRESSURE,  /* of the floor alone */
    JOX_SHOWS
} JoxShow;
/* Name, how legends call it (unit and all), and the value at the bar's upper end unless another is
   asked for; 0 for classes. */
extern const struct JoxShown {
    const char *name, *legend;
    float most;
} jox_shown[JOX_SHOWS];

enum { JOX_OUTLINE_POINTS = 32 };

/* A part of a body, convex. */
typedef struct JoxDrawnBody {
    const char *name; /* "" without one */
    JoxV2 ring[JOX_OUTLINE_POINTS];
    uint32_t count; /* of the ring; 0: a disc */
    JoxV2 at;
    float radius;   /* of the disc, m */
    float low, top; /* heights between which it is, m */
    bool high;      /* where nobody touches it: above heads, or flat upon the ground */
} JoxDrawnBody;

/* The outline of a part from above, of a body at a point (of the shape's own frame, m) and turned;
   false where it is nowhere. */
bool jox_draw_outline(const JoxBodyLook *look, JoxV3 at, const float turn[4], JoxDrawnBody *out);
/* Sets `high` of all parts of one body. */
void jox_draw_reach(JoxDrawnBody *parts, size_t count);

typedef struct JoxDrawnBodies {
    JoxDrawnBody *items;
    size_t count, capacity;
} JoxDrawnBodies;
/* Adds those of a world as they are now; their names are the world's. */
void jox_draw_add_bodies(JoxDrawnBodies *out, const JoxBodies *bodies);
/* Adds those of a recording in the last frame up to a time, s; nothing where it has none. */
void jox_draw_add_recorded(JoxDrawnBodies *out, JoxTrajectoryReader *reader, double time);

/* Where somebody, or a body, went. A point that is not finite parts it. */
typedef struct JoxTrail {
    uint32_t key;
    uint16_t group;
    bool body;
    JoxV2 *points;
    uint32_t count, capacity;
} JoxTrail;

/* What a probe measures in: a line, lines or an area. */
typedef struct JoxDrawnProbe {
    const char *name;
    const JoxV2 *points;
    uint32_t count;
    bool closed;
} JoxDrawnProbe;

/* A piece of a wall and what it bears, in the colours of the field on the floor. */
typedef struct JoxDrawnLoad {
    JoxV2 ends[2];
    float value;
} JoxDrawnLoad;

typedef struct JoxPicture {
    const char *title;
    const char *when; /* beside the title; NULL: the frame's time */
    const JoxFrame *frame;
    const float *face_x, *face_y; /* unit vectors; NULL: along the velocities */
    const float *density;         /* 1/m2, of each person; NULL: not known */
    const JoxWalls *walls;        /* all of them, open gates too */
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
    uint32_t trail_count, trail_people; /* how many people are followed */
    const JoxDensity *grid;             /* of the field; NULL: a bare floor */
    const float *field;
    JoxShow colour, floor;
    float colour_most, floor_most; /* at the bars' upper ends */
    const char *field_legend;      /* what the field is; NULL: by `floor` */
    bool panel;                    /* one of several: the legend is a strip below the map */
    float radius;                  /* m, of everyone, where the frame does not say */
    JoxV2 low, high;               /* what is shown */
} JoxPicture;

/* The size in pixels that suits an area, both even; of a panel, and whether it takes a whole line
   of a page rather than half of one. */
void jox_draw_size(JoxV2 low, JoxV2 high, uint32_t *width, uint32_t *height);
bool jox_draw_panel_size(JoxV2 low, JoxV2 high, uint32_t *width, uint32_t *height);
void jox_draw(JoxCanvas *canvas, const JoxPicture *picture);

#endif
