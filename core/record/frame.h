/* One moment of a crowd, as probes see it: the same for a running world and for a recording. The
   arrays belong to who made the frame and hold until the next one. */
#ifndef JOX_RECORD_FRAME_H
#define JOX_RECORD_FRAME_H

#include <stdint.h>

#include "base/format/colour.h"
#include "base/vec.h"
#include "geom/objects.h"
#include "geom/walls.h"

typedef struct JoxFrame {
    double time; /* s */
    uint32_t count;
    JoxV2 period;  /* m: of periodic edges along x and y; 0 without. Who passes one comes round. */
    uint32_t keys; /* every key so far is below this */
    const uint32_t *key;  /* of each person: the same in every frame, never another's */
    uint32_t slots;       /* every slot is below this */
    const uint32_t *slot; /* of each person: the same while they are there, then another's; NULL: as
                             the key */
    const float *x, *y;   /* m */
    const float *vx, *vy; /* m/s: displacement over a step, or over a stretch about the moment */
    /* NULL where they are not known, as in a recording made by others. */
    const float *radius;       /* m */
    bool one_radius;           /* it is one number, that of all */
    const float *force;        /* magnitude of the net force, N */
    const float *compression;  /* sum of contact force magnitudes over circumference, N/m */
    const float *load;         /* greatest push borne from any one direction, N */
    const uint8_t *failed;     /* 1 where the 2-D program had no solution */
    const uint16_t *group;     /* index of the scene's group */
    const char *const *groups; /* their names */
    uint32_t group_count;
    const JoxColour *group_colours; /* that they were given; NULL: none was */
    const uint32_t *state;          /* row of the person's state in `states` */
    const char *const *states;      /* their names, of all machines */
    uint32_t state_count;
    const JoxColour *state_colours; /* that they were given; NULL: none was */
    /* Bodies, each as its index + 1, or 0: what the person kicked or threw in this step, and what
       fast one hit them. */
    const uint32_t *kicked, *struck;
    const JoxObjects *objects;     /* bodies as people saw them when this step began */
    const JoxWalls *walls;         /* as they stand now */
    const JoxWallLoad *wall_loads; /* by piece; NULL where they are not known */
    uint32_t wall_load_count;
} JoxFrame;

/* m: of person i, or `unknown`. */
static inline float jox_frame_radius(const JoxFrame *frame, uint32_t i, float unknown) {
    return frame->radius ? frame->radius[frame->one_radius ? 0 : i] : unknown;
}

#endif
