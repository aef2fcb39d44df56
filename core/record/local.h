/* Local density, flow and crowd pressure over the frames of a run or of a recording, on one grid:
   what maps, tables and summaries take them from (fields/density.h, fields/pressure.h). */
#ifndef JOX_RECORD_LOCAL_H
#define JOX_RECORD_LOCAL_H

#include <stdbool.h>

#include "base/sections.h"
#include "record/fields/density.h"
#include "record/fields/pressure.h"
#include "record/frame.h"
#include "record/track.h"

typedef struct JoxLocal {
    JoxDensity *grid; /* its `now` is the last sample's, 1/m2; its `most` of any place and time */
    float *flow_x, *flow_y; /* density times velocity, 1/(m s); NULL unless asked for */
    JoxPressure *pressure;  /* NULL unless asked for */
    float *vx, *vy;         /* m/s: of the last sample's people, where pressure is asked for */
    uint32_t people;        /* that there is room for in them */
    double time;            /* s: of the last sample; NAN before the first */
    double mean_from;       /* s: means over time begin then */
    uint32_t samples;
    JoxTrack track; /* from sample to sample */
    bool tracked;   /* at the last */
    int64_t stretch;
} JoxLocal;

/* A grid for such densities: cells of 0.2 m, up to 0.4 m where the area is large. */
JoxDensity *jox_local_grid(JoxV2 low, JoxV2 high);
JoxLocal *jox_local_create(JoxV2 low, JoxV2 high);
/* From here on flow and crowd pressure, too. */
void jox_local_want_pressure(JoxLocal *local);
/* Whether a frame of time t, s, would be a sample. */
bool jox_local_is_due(const JoxLocal *local, double t);
/* Frames in ascending time, of everyone or (not NULL) of those for whom `seen` is 1. True if this
   one is a sample: one in each half second is. */
bool jox_local_frame(JoxLocal *local, const JoxFrame *frame, const uint8_t *seen);
void jox_local_sections(JoxLocal *local, JoxSections *sections);
/* Of a cell, 1/s2; NAN: not measured. */
float jox_local_pressure(const JoxLocal *local, size_t cell);
void jox_local_free(JoxLocal *local);

#endif
