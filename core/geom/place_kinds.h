/* The kinds of places that a scene can have. place.c has their rows, and the keys of scenes name
   them; nothing else includes this file, so that a new kind changes nothing else. */
#ifndef JOX_GEOM_PLACE_KINDS_H
#define JOX_GEOM_PLACE_KINDS_H

enum {
    JOX_PLACE_POINT,   /* points[0]; inside means within `radius` */
    JOX_PLACE_LINE,    /* points[0] -> points[1]; crossing counts from its right to its left */
    JOX_PLACE_POLYGON, /* a closed ring, counter-clockwise */
    JOX_PLACE_QUEUE,   /* a polyline, points[0] is the head; `spacing` metres a person */
    JOX_PLACE_SET,     /* several places, one_of picks among `members` */
    JOX_PLACE_KINDS
};

#endif
