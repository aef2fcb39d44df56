/* Displacement of each person from one frame to the next, and crossings of lines. Probes, danger
   and local densities each keep a JoxTrack and call jox_track_reserve, then jox_track_step for each
   person, in every frame that they read. */
#ifndef JOX_RECORD_FRAME_TRACK_H
#define JOX_RECORD_FRAME_TRACK_H

#include <math.h>

#include "base/sections.h"
#include "geom/polygon.h"
#include "record/frame.h"

/* Position of each person in the previous frame. The owner frees `items`. */
typedef struct JoxTrack {
    struct JoxTracked {
        float x, y;
        double time;
        uint32_t person; /* key + 1; 0: the slot is empty */
        uint32_t unused; /* always 0: cells of sections have no padding */
    } * items;           /* by slot, or by key in frames without slots */
    uint32_t capacity;
} JoxTrack;

/* Path of a person between two frames: the straight line from `from` along `by`, the shorter way
   where edges are periodic, to `to`. `to` differs from from + by if the person crossed a periodic
   edge, or a seam between sheets of storeys, or rode a lift. */
typedef struct JoxStretch {
    JoxV2 from, by, to;
    double begun, ended; /* s: times of the two frames */
} JoxStretch;

/* Makes room for everybody in the frame. Call it before the first jox_track_step of a frame. */
void jox_track_reserve(JoxTrack *track, const JoxFrame *frame);
void jox_track_sections(JoxTrack *track, JoxSections *sections);

/* Returns a coordinate difference d, m, over the shorter way across a periodic edge. */
static inline float jox_track_way(float d, float period) {
    if (period > 0.0f && fabsf(d) > 0.5f * period)
        d -= d > 0.0f ? period : -period;
    return d;
}

/* Returns a difference d of positions along y, m, without whole pitches between sheets: nobody
   walks half a pitch between two frames. */
static inline float jox_track_fold(const JoxStoreys *storeys, float d) {
    return fabsf(d) > 0.5f * storeys->pitch ? d - storeys->pitch * rintf(d / storeys->pitch) : d;
}

/* Stores the position of person i and sets `stretch` to the path since the previous frame. Returns
   false, with `stretch` unset, where the person has no previous position. */
static inline bool jox_track_step(JoxTrack *track, const JoxFrame *frame, uint32_t i,
                                  JoxStretch *stretch) {
    const uint32_t key = frame->key[i];
    struct JoxTracked *last = &track->items[frame->slot ? frame->slot[i] : key];
    const struct JoxTracked now = {frame->x[i], frame->y[i], frame->time, key + 1, 0};
    const bool known = last->person == now.person;
    if (known)
        *stretch =
            (JoxStretch){.from = {last->x, last->y},
                         .by = {jox_track_way(now.x - last->x, frame->period.x),
                                frame->storeys ? jox_track_fold(frame->storeys, now.y - last->y)
                                               : jox_track_way(now.y - last->y, frame->period.y)},
                         .to = {now.x, now.y},
                         .begun = last->time,
                         .ended = now.time};
    *last = now;
    return known;
}

/* The exact part of jox_stretch_crosses, for stretches whose bounding boxes meet a-b. */
int jox_stretch_crosses_exactly(const JoxStretch *stretch, JoxV2 a, JoxV2 b, double *time);
/* Returns +1 where a stretch crosses the segment a-b from its right to its left, -1 from left to
   right, and sets `time`, s; returns 0 where it does not cross. Bounding boxes exclude most
   stretches first. */
static inline int jox_stretch_crosses(const JoxStretch *s, JoxV2 a, JoxV2 b, double *time) {
    const JoxV2 end = jox_add(s->from, s->by), begin = jox_sub(s->to, s->by);
    const bool by = jox_boxes_meet(a, b, s->from, end) || jox_boxes_meet(a, b, begin, s->to);
    return by ? jox_stretch_crosses_exactly(s, a, b, time) : 0;
}

#endif
