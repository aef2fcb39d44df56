/* Distance fields: the walking distance to a place round walls, on a grid, and the direction of the
   shortest way from everywhere. World makes them beside the steps; machine looks ways up, from many
   threads at once, as a field never changes once it is made. */
#ifndef JOX_GEOM_FIELD_H
#define JOX_GEOM_FIELD_H

#include "base/sections.h"
#include "geom/lifts.h"
#include "geom/place.h"
#include "geom/storeys.h"
#include "geom/walls.h"
#include "simd/isa.h"

typedef struct JoxField JoxField;
typedef struct JoxFieldMarks JoxFieldMarks;

/* People under way, and how much each is held up: 0 not at all, 1 at a stand. */
typedef struct JoxFieldCrowd {
    JoxV2 *at;   /* m */
    float *held; /* 0 to 1 */
    uint32_t count;
    float slowing; /* m2: relative increase of a way's time per person per m2 */
    JoIsa isa;     /* instruction set of the kernel; it changes no result */
} JoxFieldCrowd;

/* Lifts by which ways lead, too. A ride counts as the way that people walk in its usual time. */
typedef struct JoxFieldLifts {
    const JoxLift *lifts; /* laid out, borrowed */
    uint32_t count;
    bool stepless;                 /* for people who cannot use stairs: firemen take them, too */
    uint8_t modes[JOX_MOST_LIFTS]; /* JoxLiftMode of each */
} JoxFieldLifts;

/* Makes the field to a place of any kind (a set: to its nearest member; a queue: to its head) over
   the box low..high and the place, for people who keep `clearance` m (at least 0.05) from walls.
   People are slower within 0.5 m of walls, so that ways keep off them where there is room, and
   where `crowd` is held up (NULL: nobody is). `cell` is 0.1 to 2 m, and grows so that at most
   4,000,000 cells are made. Gaps count by their true width, not by the grid: gaps wider than 2
   clearances and 0.6 cells are open, gaps narrower than 1.7 clearances are closed; between these it
   depends on the grid's position. `marks`, if not NULL, caches the effect of walls between calls
   (*marks is NULL at first): the same walls over the same box are not evaluated again, which
   changes no result. `storeys`: NULL, or laid out; then the box counts along x alone, and seams
   that may not be crossed are closed. It is borrowed. `lifts`: NULL, or the lifts of the storeys by
   which ways lead. Returns a field that the caller frees; never NULL. */
JoxField *jox_field_create(const JoxWalls *walls, const JoxPlace *places, uint32_t place, JoxV2 low,
                           JoxV2 high, float cell, float clearance, const JoxFieldCrowd *crowd,
                           const JoxStoreys *storeys, const JoxFieldLifts *lifts,
                           JoxFieldMarks **marks);
/* Returns the height of the grid of a field over storeys with cells of this size, m. */
float jox_field_height_of_sheets(const JoxStoreys *storeys, float cell);
/* Gives a field that was restored its storeys; NULL: none. */
void jox_field_set_storeys(JoxField *field, const JoxStoreys *storeys);
void jox_field_marks_free(JoxFieldMarks *marks);
/* Returns the length of the way from a point, m: 0 inside a polygon that is the goal; INFINITY
   inside solids and where no way leads. From outside the box: straight to it, and on from there. */
float jox_field_distance(const JoxField *field, JoxV2 point);
/* Returns whether the way from a point leads by a lift, of a field made with lifts: the first one,
   and the stop at which people take it. */
bool jox_field_first_lift(const JoxField *field, const JoxLift *lifts, uint32_t lift_count,
                          JoxV2 point, uint32_t *lift, uint32_t *stop);
/* Returns the unit vector of the way: continuous between cells, never towards the other side of a
   wall. Nearer to a wall than the clearance it also leads off the wall; inside a solid it leads
   out. (0, 0) at the goal and where no way leads. */
JoxV2 jox_field_direction(const JoxField *field, JoxV2 point);
/* Points to look up at once, at most JOX_FIELD_POINTS. Entries beyond `count`, up to a whole
   packet, may hold any numbers. */
enum { JOX_FIELD_POINTS = 256 };
typedef struct JoxFieldPoints {
    uint32_t count;
    float x[JOX_FIELD_POINTS], y[JOX_FIELD_POINTS]; /* m */
    float way_x[JOX_FIELD_POINTS], way_y[JOX_FIELD_POINTS], length[JOX_FIELD_POINTS];
} JoxFieldPoints;
/* Kernel: jox_field_direction and jox_field_distance of all points, with the same bits. */
typedef void JoxFieldKernel(const JoxField *field, JoxFieldPoints *points);
#define X(name, isa) JoxFieldKernel jox_field_look_##name;
JOX_ISAS(X)
#undef X
/* Lists a field for saving; when restoring, makes one and stores it in *field. `by_lifts`: it is
   one made with lifts. */
void jox_field_sections(JoxField **field, bool by_lifts, JoxSections *sections);
uint32_t jox_field_cells(const JoxField *field);
/* Returns the box of its cells, m, and their size. A field made for this box has the same cells. */
void jox_field_box(const JoxField *field, JoxV2 *low, JoxV2 *high, float *cell);
void jox_field_free(JoxField *field);

#endif
