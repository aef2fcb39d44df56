/* Local density, flow and crowd pressure on one grid, sampled every half second from the frames of
   a run or of a recording (fields/density.h, fields/pressure.h). Maps, danger, tables and summaries
   read it; jox_local_free frees all of it. */
#ifndef JOX_RECORD_LOCAL_SAMPLES_H
#define JOX_RECORD_LOCAL_SAMPLES_H

#include <stdbool.h>

#include "base/sections.h"
#include "record/fields/density.h"
#include "record/fields/pressure.h"
#include "record/frame.h"
#include "record/frame_track.h"

typedef struct JoxLocal {
    /* 1/m2: `now` is the last sample, `most` the greatest of any place and time */
    JoxDensity *grid;
    float *flow_x, *flow_y; /* 1/(m s): density times velocity; NULL without crowd pressure */
    JoxPressure *pressure;  /* NULL until jox_local_enable_pressure */
    float *vx, *vy;  /* m/s: velocities of the people in the last sample; used with pressure only */
    uint32_t people; /* room in vx and vy */
    double time;     /* s: time of the last sample; NAN before the first */
    double mean_from; /* s: samples from this time on count in means over time */
    uint32_t samples;
    JoxTrack track; /* positions in the last sample */
    bool tracked;   /* the last sample had a track, so that velocities are known at the next */
    int64_t half_second;
} JoxLocal;

/* Creates a grid for local densities: cells of 0.2 m, up to 0.4 m where the area is large. With
   storeys, `low` to `high` is in plan and the grid has all storeys; without, it is an area of
   positions, also in a world with storeys. */
JoxDensity *jox_local_grid(JoxV2 low, JoxV2 high, const JoxStoreys *storeys);
JoxLocal *jox_local_create(JoxV2 low, JoxV2 high, const JoxStoreys *storeys);
/* Measures flow and crowd pressure from the next sample on, too. */
void jox_local_enable_pressure(JoxLocal *local);
/* Returns whether a frame at time t, s, would be sampled. */
bool jox_local_is_due(const JoxLocal *local, double t);
/* Takes a frame, in ascending order of time, and samples it if it is the first in its half second.
   `seen` selects the people who count, by 1; NULL selects all. Returns whether it was sampled. */
bool jox_local_frame(JoxLocal *local, const JoxFrame *frame, const uint8_t *seen);
void jox_local_sections(JoxLocal *local, JoxSections *sections);
/* Returns the crowd pressure of a cell, 1/s2; NAN where it is not measured. */
float jox_local_pressure(const JoxLocal *local, size_t cell);
void jox_local_free(JoxLocal *local);

#endif
