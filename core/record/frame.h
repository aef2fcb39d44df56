/* One moment of a crowd, in a running world or in a recording. Probes, danger, local densities and
   pictures read it. The arrays belong to the caller that made the frame and stay valid until it
   makes the next one; "person i" is the one at index i of them. */
#ifndef JOX_RECORD_FRAME_H
#define JOX_RECORD_FRAME_H

#include <stdint.h>

#include "base/format/colour.h"
#include "base/vec.h"
#include "geom/lifts.h"
#include "geom/objects.h"
#include "geom/storeys.h"
#include "geom/walls.h"

typedef struct JoxFrame {
    double time; /* s */
    uint32_t count;
    JoxV2 period;  /* m: lengths of periodic edges along x and y; 0: not periodic */
    uint32_t keys; /* upper bound of all keys up to this frame */
    /* number of each person, the same in every frame, never given to another person */
    const uint32_t *key;
    uint32_t slots; /* upper bound of all slots up to this frame */
    /* row of each person in tables such as JoxTrack; given to another person after the first has
       left. NULL: use the key */
    const uint32_t *slot;
    const float *x, *y;   /* m */
    const float *vx, *vy; /* m/s: displacement over a step, or over a few frames around this one */
    /* Each is NULL where it is unknown, as in a recording of another program. */
    const float *radius; /* m */
    bool one_radius;     /* `radius` has one element, which is everybody's radius */
    /* Torsos: from the centre to the left end of the axis, and the distance of the surface from the
       axis, m. NULL, too, where all are discs; one disc among others has no axis. */
    const float *axis_x, *axis_y, *contact_radius;
    const float *fallen;       /* s: time since the person fell; 0: it stands */
    const float *force;        /* magnitude of the net force, N */
    const float *compression;  /* sum of contact force magnitudes over circumference, N/m */
    const float *load;         /* greatest push borne from any one direction, N */
    const uint8_t *failed;     /* 1 where the two-dimensional linear program had no solution */
    const uint16_t *group;     /* index in `groups` */
    const char *const *groups; /* names */
    uint32_t group_count;
    const JoxColour *group_colours; /* colours from the scene; NULL: no group has one */
    const uint32_t *state;          /* index in `states` */
    const char *const *states;      /* names of the states of all machines */
    uint32_t state_count;
    const JoxColour *state_colours; /* colours from the scene; NULL: no state has one */
    /* Bodies by index + 1; 0: none. The body that the person kicked or threw in this step, and the
       fast body that hit the person. */
    const uint32_t *kicked, *struck;
    const JoxObjects *objects;     /* bodies at the beginning of this step, as agents saw them */
    const JoxWalls *walls;         /* walls that stand at this moment */
    const JoxWalls *dividing;      /* the same and all doors of lifts, which divide the floor of
                                      densities;      NULL: there are no lifts */
    const JoxWallLoad *wall_loads; /* load of each wall piece; NULL: unknown */
    uint32_t wall_load_count;
    /* Storeys and stairs: x and y, walls and objects are positions on their sheets. NULL: one
       plane. */
    const JoxStoreys *storeys;
    const JoxLift *lifts;   /* laid out */
    const JoxCarLook *cars; /* one for each lift */
    uint32_t lift_count;
} JoxFrame;

/* Returns the walls that divide the floor. */
static inline const JoxWalls *jox_frame_dividing_walls(const JoxFrame *frame) {
    return frame->dividing ? frame->dividing : frame->walls;
}
/* Returns the radius of person i, m, or `unknown` where the frame has no radii. */
static inline float jox_frame_radius(const JoxFrame *frame, uint32_t i, float unknown) {
    return frame->radius ? frame->radius[frame->one_radius ? 0 : i] : unknown;
}

#endif
