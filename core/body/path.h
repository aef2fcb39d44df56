/* Where a body that follows a path is at a time. */
#ifndef JOX_BODY_PATH_H
#define JOX_BODY_PATH_H

#include <stdbool.h>
#include <stdint.h>

#include "jostle.h"

enum { JOX_PATH_POINTS = 256 };

/* Straight from point to point, at one speed. Without points it is none. */
typedef struct JoxBodyPath {
    double *points; /* x, y, z, m; the first is where it begins. Owned by whoever has the path. */
    uint32_t count; /* 0, or 2 to JOX_PATH_POINTS */
    uint32_t end;   /* JoPathEnd */
    double speed;   /* m/s */
    double after;   /* s until it starts */
    double wait;    /* s at each point that it comes to */
    bool reopens;   /* goes back to where the leg began where it would press harder than its limit;
                       else it stands */
} JoxBodyPath;

typedef struct JoxPathSpot {
    double at[3], velocity[3]; /* m, m/s: as it goes on from there */
} JoxPathSpot;

/* NULL, or what is wrong with a path that has points. */
const char *jox_path_wrong(const JoxBodyPath *path);
/* `time`: s since the body was made. */
JoxPathSpot jox_path_spot(const JoxBodyPath *path, double time);

/* The time at which the leg that it is on, or that it came to the end of last, began, s. */
double jox_path_leg_began(const JoxBodyPath *path, double time);

#endif
