/* Where hands can hold a body: not across a wall or a fixed body. Machine asks for picking up,
   world for carrying. */
#ifndef JOX_GEOM_HAND_REACH_H
#define JOX_GEOM_HAND_REACH_H

#include "geom/objects.h"
#include "geom/walls.h"

/* m: height at which the middle of a body is carried, leaves a thrower and arrives. */
#define JOX_HAND_HEIGHT 1.2f

/* Obstacles for hands near a point, and the outline of the body that they hold. Zero-initialise;
   memory is reused. */
typedef struct JoxHands {
    struct JoxHandEdge {
        JoxV2 a, b;
    } * edges; /* edges of walls and of footprints */
    uint32_t count, capacity;
    JoxV2 ring[JOX_FOOTPRINT_POINTS]; /* outline of the body from above about its centre, slightly
                                         enlarged */
    uint32_t ring_count;
} JoxHands;

/* Lists the obstacles of hands that hold body `row` within `reach` m of a point: walls, and bodies
   that are static, driven or heavier than 200 kg, unless they contain the point. Obstacles lower
   than the held body's lowest point are ignored; its centre is at JOX_HAND_HEIGHT, or higher if it
   lies higher. `images`: of walls beyond joined edges. `walls`, `images` and `objects` may be
   NULL. */
void jox_hands_look(JoxHands *hands, const JoxWalls *walls, const JoxWalls *images,
                    const JoxObjects *objects, uint32_t row, JoxV2 from, float reach);
/* Returns whether no obstacle crosses the segment between two points. */
bool jox_hands_reach(const JoxHands *hands, JoxV2 from, JoxV2 to);
/* Returns whether no obstacle lies between a point and any part of the body with its centre at
   `at`, nor inside the body. */
bool jox_hands_can_hold(const JoxHands *hands, JoxV2 from, JoxV2 at);
/* Finds a position for the body at most `gap` m from a point: as far as possible along `way`, a
   unit vector; else, if `around`, in the nearest of seven other directions. Returns false if there
   is none. */
bool jox_hands_find(const JoxHands *hands, JoxV2 from, JoxV2 way, float gap, bool around,
                    JoxV2 *at);
void jox_hands_free(JoxHands *hands);

#endif
