/* Static walls as linked vertices (van den Berg et al. 2011): solid polygons and thin polylines.
   Gates are walls with a name that open and close. */
#ifndef JOX_GEOM_WALLS_H
#define JOX_GEOM_WALLS_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"

/* Vertex i starts the edge i -> next. Solid matter lies to the LEFT of each edge (solids are
   counter-clockwise rings); a polyline is a ring there and back, so both of its sides are walls. */
typedef struct JoxWallVertex {
    JoxV2 point;
    JoxV2 direction; /* unit vector to next */
    uint32_t next, previous;
    bool convex;    /* the ring turns left here (ends of polylines count as convex) */
    bool is_new;    /* the edge was closed or added after people were last moved out of new walls */
    bool covered;   /* images: an edge already lies there, so grids omit this one */
    bool absent;    /* images: no edge leads to the next vertex, as only parts of a wall are laid */
    bool continued; /* images: no corner, as a wall continues straight here (wall_images.h) */
} JoxWallVertex;

typedef struct JoxWalls {
    JoxWallVertex *vertices;
    uint32_t count, capacity;
    /* Rings as they were given: first vertex and length; solid or polyline. */
    struct JoxWallRing {
        uint32_t first, count;
        bool solid;
        bool outline;      /* boundary of the walkable area; its inside is walkable */
        float height;      /* m; INFINITY: not given */
        float drawn;       /* m: height up to which the live page draws it; 0: its height */
        char *name;        /* name of a gate; owned; NULL for other walls */
        bool open;         /* open gate: no obstacle */
        bool set;          /* opened or closed since it was made */
        bool is_lift_door; /* the lift opens and closes it; ways lead through it as if it were open
                            */
    } * rings;
    uint32_t ring_count, ring_capacity;
} JoxWalls;

/* Returns whether a ring is a closed gate that ways do not lead through. */
static inline bool jox_wall_is_shut_gate(const JoxWalls *walls, uint32_t ring) {
    return walls->rings[ring].name && !walls->rings[ring].open && !walls->rings[ring].is_lift_door;
}

/* A segment of a wall's edge, at most 1 m long, with the load of contacts on it. */
typedef struct JoxWallLoad {
    uint32_t edge;  /* index of its vertex */
    JoxV2 from, to; /* m */
    float load;     /* N: sum of the magnitudes of normal forces */
} JoxWallLoad;

/* Adds a solid polygon of at least 3 points; clockwise ones are reversed. */
void jox_walls_add_solid(JoxWalls *walls, const JoxV2 *ring, uint32_t count, float height);
/* Adds a thin wall along a polyline of at least 2 points. `closed` joins the last point to the
   first, which makes a thin closed wall with a walkable inside. */
void jox_walls_add_polyline(JoxWalls *walls, const JoxV2 *points, uint32_t count, bool closed,
                            float height);
/* Adds a closed polyline whose inside is the walkable area, or one of several such areas. */
void jox_walls_add_outline(JoxWalls *walls, const JoxV2 *points, uint32_t count, float height);
/* Returns whether there are outlines, and each point lies inside one. */
bool jox_walls_outline_all(const JoxWalls *walls, const JoxV2 *points, uint32_t count);
/* Returns the points of a ring; the caller frees them (jox_free). */
JoxV2 *jox_walls_ring_points(const JoxWalls *walls, uint32_t ring);
/* Names the unnamed rings from `first` on (the name is copied), which makes them gates; `open` ones
   are no obstacle. */
void jox_walls_name(JoxWalls *walls, uint32_t first, const char *name, bool open);
/* Copies the closed walls of `all` to `out`, without names; without `gates`, only walls that never
   open. Reuses the memory of `out`. */
void jox_walls_standing(JoxWalls *out, const JoxWalls *all, bool gates);
/* Does the same without the doors of lifts, which ways lead through. */
void jox_walls_for_ways(JoxWalls *out, const JoxWalls *all, bool gates);
/* Copies the closed walls of `all` to `out`, and all doors of lifts, open or not: what divides the
   floor. */
void jox_walls_dividing(JoxWalls *out, const JoxWalls *all);
/* Returns the number of points of a ring as it was given, from its first vertex on, and whether the
   last is joined to the first. A closed polyline is stored as two rings, and *twin tells that the
   next ring repeats this one. */
uint32_t jox_walls_given(const JoxWalls *walls, uint32_t ring, bool *closed, bool *twin);
/* The parts of a line that walls leave free, in the line's direction: the part at its middle, and
   parts at least 0.25 m wide between two walls, as in a row of gates. Parts beyond the outermost
   walls are omitted. If nothing is free, the result is the whole line. */
enum { JOX_WALL_OPENINGS = 64 }; /* greatest number of parts */
typedef struct JoxWallOpenings {
    JoxV2 ends[JOX_WALL_OPENINGS][2];
    uint32_t count; /* at least one */
    float width;    /* m: sum over all parts */
} JoxWallOpenings;
void jox_walls_openings(const JoxWalls *walls, const JoxV2 line[2], JoxWallOpenings *out);
/* Marks all edges of a ring as new. */
void jox_walls_mark_ring_new(JoxWalls *walls, uint32_t ring);
/* Marks closed edges as new that were not closed in `before` between the same points and with the
   same solidity, or that were marked there. Returns whether there are any. */
bool jox_walls_mark_new(JoxWalls *walls, const JoxWalls *before);
/* Removes all marks of new edges. */
void jox_walls_clear_new_marks(JoxWalls *walls);
void jox_walls_free(JoxWalls *walls);

#endif
