/* Where people went from one frame to the next. */
#ifndef JOX_RECORD_TRACK_H
#define JOX_RECORD_TRACK_H

#include "base/sections.h"
#include "record/frame.h"

/* Where each person was in the frame before. */
typedef struct JoxTrack {
    struct JoxTracked {
        float x, y;
        double time;
        bool known;
    } * items; /* by key */
    uint32_t capacity;
} JoxTrack;

/* A stretch of somebody's way: from `from` by `by`, the shorter way round where edges are periodic,
   to `to`, which is elsewhere than from + by if an edge was passed. */
typedef struct JoxStretch {
    JoxV2 from, by, to;
    double begun, ended; /* s */
} JoxStretch;

/* Notes person i's place in the frame; false where it is the first. Call jox_track_reserve before
   the first of a frame. */
void jox_track_reserve(JoxTrack *track, uint32_t keys);
void jox_track_sections(JoxTrack *track, JoxSections *sections);
bool jox_track_step(JoxTrack *track, const JoxFrame *frame, uint32_t i, JoxStretch *stretch);
/* +1 or -1, and the time, if the stretch crosses a-b; else 0. */
int jox_stretch_crosses(const JoxStretch *stretch, JoxV2 a, JoxV2 b, double *time);

#endif
