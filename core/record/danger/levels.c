/* Table of levels of service, and look-up of a level by density or flow. */
#include "record/danger/levels.h"

#include <math.h>
#include <stdbool.h>

enum { CROWDED = 4 }; /* index of level E */

/* Fruin's areas in square feet per person: 35, 25, 15, 10 and 5 for walkways, 13, 10, 7, 3 and 2
   for queues, 20, 15, 10, 7 and 4 for stairs; his flows: 7, 10, 15, 20 and 25 people per foot and
   minute on walkways, 5, 7, 10, 13 and 17 on stairs. */
const JoxLevel jox_levels[JOX_LEVELS] = {
    {"A", 1.21, 3.25, 23.0, 1.86, 16.4, "people stand and pass freely"},
    {"B", 0.93, 2.32, 33.0, 1.39, 23.0, "people stand freely, and pass with some care"},
    {"C", 0.65, 1.39, 49.0, 0.93, 33.0,
     "people stand without touching; passing through disturbs others"},
    {"D", 0.28, 0.93, 66.0, 0.65, 43.0,
     "people stand without touching; nobody can pass, all move as a group"},
    {"E", 0.19, 0.46, 82.0, 0.37, 56.0, "contact cannot be avoided; bearable for short times only"},
    {"F", 0.0, 0.0, INFINITY, 0.0, INFINITY,
     "everybody is in contact on all sides; nobody can move"},
};
const char jox_levels_source[] =
    "J. J. Fruin, Pedestrian planning and design, 1971, in SI units as commonly quoted";

int jox_level_of_queue(double density) {
    int level = 0;
    while (level < JOX_LEVELS - 1 && density * jox_levels[level].queue_area > 1.0)
        level++;
    return level;
}

/* Returns the level by a flow, 1/(m s), and for levels E and F by a density, 1/m2, too. */
static int find_level(double flow, double density, bool on_stair) {
    int level = 0;
    while (level < JOX_LEVELS - 1 &&
           flow * 60.0 > (on_stair ? jox_levels[level].stair_flow : jox_levels[level].walk_flow))
        level++;
    for (int k = CROWDED; k < JOX_LEVELS; k++) {
        const JoxLevel *last = &jox_levels[k - 1];
        if (level < k && density * (on_stair ? last->stair_area : last->walk_area) > 1.0)
            level = k;
    }
    return level;
}

int jox_level_of_walkway(double flow, double density) {
    return find_level(flow, density, false);
}

int jox_level_of_stair(double flow, double density) {
    return find_level(flow, density, true);
}
