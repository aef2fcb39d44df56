/* Path of a kinematic body: position and velocity at a given time. bullet_drive.cc calls it at
   each substep. */
#ifndef JOX_BODY_DRIVE_PATH_H
#define JOX_BODY_DRIVE_PATH_H

#include <stdbool.h>
#include <stdint.h>

#include "jostle.h"

enum { JOX_PATH_POINTS = 256 };

/* Straight legs from point to point, at one speed. No points: no path. */
typedef struct JoxBodyPath {
    double *points; /* x, y, z, m; the first is the start. Owned by the owner of the path. */
    uint32_t count; /* 0, or 2 to JOX_PATH_POINTS */
    uint32_t end;   /* JoPathEnd */
    double speed;   /* m/s */
    double after;   /* s: delay before the start */
    double wait;    /* s: stop at each point */
    /* at its force limit the body goes back to the start of the leg; else it stands */
    bool reopens;
} JoxBodyPath;

typedef struct JoxPathSpot {
    double at[3], velocity[3]; /* position, m; velocity with which it goes on, m/s */
} JoxPathSpot;

/* Returns NULL, or a sentence that says what is wrong with a path that has points. */
const char *jox_path_find_fault(const JoxBodyPath *path);
/* Returns the position and velocity at a time, s since the body was made. */
JoxPathSpot jox_path_spot(const JoxBodyPath *path, double time);

/* Returns the start time, s, of the present leg, or, while the body stops at a point, of the leg
   that led there. */
double jox_path_leg_began(const JoxBodyPath *path, double time);

#endif
