/* Static walls as linked vertices (van den Berg et al. 2011): solid polygons and thin polylines. */
#ifndef JOX_GEOM_WALLS_H
#define JOX_GEOM_WALLS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"

/* Vertex i starts the edge i -> next. Solid matter lies to the LEFT of each edge (solids are rings
   counter-clockwise); a polyline is a ring there and back, so both sides are walls. */
typedef struct JoxWallVertex {
    JoxV2 point;
    JoxV2 direction; /* unit vector to next */
    uint32_t next, previous;
    bool convex;    /* the ring turns left here (ends of polylines count as convex) */
    bool came;      /* the edge rose after people were last cleared out of walls that came */
    bool covered;   /* of an image: an edge lies there already, and grids leave this one out */
    bool continued; /* no corner to touch: a wall goes on in one line with an image, see
                       wall_images.h */
} JoxWallVertex;

typedef struct JoxWalls {
    JoxWallVertex *vertices;
    uint32_t count, capacity;
    /* Rings as given, for output: first vertex and length; solid or polyline. */
    struct JoxWallRing {
        uint32_t first, count;
        bool solid;
        bool outline; /* a plan says that what lies inside can be walked, and nothing else */
        float height; /* m; INFINITY unless given */
        char *name;   /* of walls that open and close; owned; else NULL */
        bool open;    /* taken away: nothing stands there */
        bool set;     /* opened or closed since it was made */
    } * rings;
    uint32_t ring_count, ring_capacity;
} JoxWalls;

/* A piece of the edge of a wall, at most a metre long, and what contacts press on it. */
typedef struct JoxWallLoad {
    uint32_t edge;  /* its vertex */
    JoxV2 from, to; /* m */
    float load;     /* N: sum of the magnitudes of the forces across it */
} JoxWallLoad;

/* Adds a solid polygon (turned counter-clockwise if it is not) of at least 3 points. */
void jox_walls_add_solid(JoxWalls *walls, const JoxV2 *ring, uint32_t count, float height);
/* Adds a thin wall along a polyline of at least 2 points; `closed` joins the last to the first and
   gives a thin closed wall, whose inside can be walked. */
void jox_walls_add_polyline(JoxWalls *walls, const JoxV2 *points, uint32_t count, bool closed,
                            float height);
/* The same of a closed one, whose inside is the area, or one of the areas, that can be walked. */
void jox_walls_add_outline(JoxWalls *walls, const JoxV2 *points, uint32_t count, float height);
/* Whether there are outlines, and every point lies within one. */
bool jox_walls_outline_all(const JoxWalls *walls, const JoxV2 *points, uint32_t count);
/* The points of a ring, to be freed by jox_free. */
JoxV2 *jox_walls_ring_points(const JoxWalls *walls, uint32_t ring);
/* Gives the rings from `first` on that have none a name (copied); open ones do not stand. */
void jox_walls_name(JoxWalls *walls, uint32_t first, const char *name, bool open);
/* Makes `out` the walls of `all` that stand, without their names; with `gates` false, of these only
   such as never open. Keeps its memory. */
void jox_walls_standing(JoxWalls *out, const JoxWalls *all, bool gates);
/* Points of a ring as they were given, from its first vertex on, and whether the last is joined to
   the first. A closed line is two rings, of which *twin says that the next repeats this one. */
uint32_t jox_walls_given(const JoxWalls *walls, uint32_t ring, bool *closed, bool *twin);
/* What walls leave of a line, in its direction: the part about its middle, and others between two
   walls, as the gates of a line of gates, if they are 0.25 m wide. What lies beyond the walls at
   its ends is left out; where walls leave nothing it is all of the line. */
enum { JOX_WALL_OPENINGS = 64 }; /* at most */
typedef struct JoxWallOpenings {
    JoxV2 ends[JOX_WALL_OPENINGS][2];
    uint32_t count; /* at least one */
    float width;    /* m, of all */
} JoxWallOpenings;
void jox_walls_openings(const JoxWalls *walls, const JoxV2 line[2], JoxWallOpenings *out);
/* Marks all edges of a ring as came. */
void jox_walls_ring_came(JoxWalls *walls, uint32_t ring);
/* Marks the edges of standing rings that did not stand before, between the same points and of a
   solid or of none, or that had come then. Returns whether there is one. */
bool jox_walls_mark_new(JoxWalls *walls, const JoxWalls *before);
/* Marks no edge as came. */
void jox_walls_clear_came(JoxWalls *walls);
void jox_walls_free(JoxWalls *walls);

#endif
