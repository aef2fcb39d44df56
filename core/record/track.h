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
        uint32_t person; /* key, plus 1; 0: nobody was there */
        uint32_t unused; /* 0: cells of sections have no padding */
    } * items;           /* by slot: as many as there were people at a time */
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
void jox_track_reserve(JoxTrack *track, const JoxFrame *frame);
void jox_track_sections(JoxTrack *track, JoxSections *sections);
bool jox_track_step(JoxTrack *track, const JoxFrame *frame, uint32_t i, JoxStretch *stretch);
/* +1 or -1, and the time, if the stretch crosses a-b; else 0. */
int jox_stretch_crosses(const JoxStretch *stretch, JoxV2 a, JoxV2 b, double *time);

#endif
