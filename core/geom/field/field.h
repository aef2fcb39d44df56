/* Ways round walls: the walking distance to a place on a grid, and the direction of the shortest
   way from everywhere. Immutable once made; sampled by many threads. */
#ifndef JOX_GEOM_FIELD_H
#define JOX_GEOM_FIELD_H

#include "base/sections.h"
#include "geom/place.h"
#include "geom/walls.h"
#include "simd/isa.h"

typedef struct JoxField JoxField;
typedef struct JoxFieldMarks JoxFieldMarks;

/* People who are on their way and how far each is held up: 0 not at all, 1 at a stand. */
typedef struct JoxFieldCrowd {
    JoxV2 *at;   /* m */
    float *held; /* 0 to 1 */
    uint32_t count;
    float slowing; /* m2: part of its free time that a way takes more for each person per m2 */
    JoIsa isa;     /* of the kernel, which changes no result */
} JoxFieldCrowd;

/* The field to a place of any kind (a set: to its nearest member; a queue: its head) over the box
   low..high and the place, for people who keep `clearance` m (at least 0.05) off walls. They walk
   more slowly within 0.5 m of walls, so that ways keep off where there is room; and where a crowd
   is held up (NULL: there is none). `cell` is 0.1 to 2 m, and grows so that at most 4,000,000 cells
   are made. Gaps are judged by their true width, not by the grid: a gap wider than 2 clearances and
   0.6 cells is open, one narrower than 1.7 clearances is shut; what lies between depends on how the
   grid falls. `marks`, or NULL: what walls do to the field, of the one that was made before with
   them, *marks NULL at first; the same walls over the same box are not looked at again, which
   changes no result. Never NULL. */
JoxField *jox_field_create(const JoxWalls *walls, const JoxPlace *places, uint32_t place, JoxV2 low,
                           JoxV2 high, float cell, float clearance, const JoxFieldCrowd *crowd,
                           JoxFieldMarks **marks);
void jox_field_marks_free(JoxFieldMarks *marks);
/* Length of the way from a point, m: 0 inside a place that is a polygon; INFINITY where no way
   leads and inside solids. Outside the box: the straight way to it and on from there. */
float jox_field_distance(const JoxField *field, JoxV2 point);
/* Unit vector of the way: even between cells, never towards the other side of a wall. Closer to a
   wall than the clearance it also leads off the wall; inside a solid it leads out. (0, 0) at the
   goal and where no way leads. */
JoxV2 jox_field_direction(const JoxField *field, JoxV2 point);
/* Points to be looked up at once, at most JOX_FIELD_POINTS; behind `count`, up to a whole packet of
   lanes, any numbers stand. */
enum { JOX_FIELD_POINTS = 256 };
typedef struct JoxFieldPoints {
    uint32_t count;
    float x[JOX_FIELD_POINTS], y[JOX_FIELD_POINTS]; /* m */
    float way_x[JOX_FIELD_POINTS], way_y[JOX_FIELD_POINTS], length[JOX_FIELD_POINTS];
} JoxFieldPoints;
/* The kernel: jox_field_direction and jox_field_distance, to the bit, of all points. */
typedef void JoxFieldKernel(const JoxField *field, JoxFieldPoints *points);
#define X(name, isa) JoxFieldKernel jox_field_look_##name;
JOX_ISAS(X)
#undef X
/* Lists a field as it was made; restoring, makes one in place of *field. */
void jox_field_sections(JoxField **field, JoxSections *sections);
uint32_t jox_field_cells(const JoxField *field);
/* The box of which its cells were made, m: one that is created for it has the same cells, of `cell`
   metres. */
void jox_field_box(const JoxField *field, JoxV2 *low, JoxV2 *high, float *cell);
void jox_field_free(JoxField *field);

#endif
