/* Where hands can hold a body: not beyond or across a wall, nor a body that stands fast. */
#ifndef JOX_GEOM_HANDS_H
#define JOX_GEOM_HANDS_H

#include "geom/objects.h"
#include "geom/walls.h"

/* m: height at which the middle of a body is carried, leaves a thrower and arrives. */
#define JOX_HAND_HEIGHT 1.2f

/* What is in the way of hands near a place, and the body that they hold. Zero-initialise; keeps its
   memory. */
typedef struct JoxHands {
    struct JoxHandEdge {
        JoxV2 a, b;
    } * edges; /* of walls and of footprints */
    uint32_t count, capacity;
    JoxV2
        ring[JOX_FOOTPRINT_POINTS]; /* the body seen from above, about its middle, a little wider */
    uint32_t ring_count;
} JoxHands;

/* Lists what is in the way of hands that hold body `row` within `reach` m of a point: walls, and
   bodies that are static, driven or heavier than 200 kg, unless they lie about the point. What is
   lower than the body's lowest point is reached over; the body's middle is at JOX_HAND_HEIGHT, or
   where it lies if that is higher. `images`: of walls, beyond joined edges. All three may be NULL.
 */
void jox_hands_look(JoxHands *hands, const JoxWalls *walls, const JoxWalls *images,
                    const JoxObjects *objects, uint32_t row, JoxV2 from, float reach);
/* Whether nothing that was listed crosses the way from a point to another. */
bool jox_hands_reach(const JoxHands *hands, JoxV2 from, JoxV2 to);
/* Whether nothing that was listed lies between a point and any part of the body, whose middle is at
   `at`, or in the body. */
bool jox_hands_hold(const JoxHands *hands, JoxV2 from, JoxV2 at);
/* Finds where the body can be held, at most `gap` m from a point: as far as possible along `way`, a
   unit vector; else, if `around`, along the nearest of seven other directions. False if nowhere. */
bool jox_hands_find(const JoxHands *hands, JoxV2 from, JoxV2 way, float gap, bool around,
                    JoxV2 *at);
void jox_hands_free(JoxHands *hands);

#endif
