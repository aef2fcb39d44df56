/* Where people went from one frame to the next. */
#ifndef JOX_RECORD_TRACK_H
#define JOX_RECORD_TRACK_H

#include <math.h>

#include "base/sections.h"
#include "geom/polygon.h"
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

/* Call it before the first of a frame. */
void jox_track_reserve(JoxTrack *track, const JoxFrame *frame);
void jox_track_sections(JoxTrack *track, JoxSections *sections);

/* The shorter way round. */
static inline float jox_track_way(float d, float period) {
    if (period > 0.0f && fabsf(d) > 0.5f * period)
        d -= d > 0.0f ? period : -period;
    return d;
}

/* Notes person i's place in the frame; false where it is the first. */
static inline bool jox_track_step(JoxTrack *track, const JoxFrame *frame, uint32_t i,
                                  JoxStretch *stretch) {
    const uint32_t key = frame->key[i];
    struct JoxTracked *last = &track->items[frame->slot ? frame->slot[i] : key];
    const struct JoxTracked now = {frame->x[i], frame->y[i], frame->time, key + 1, 0};
    const bool known = last->person == now.person;
    if (known)
        *stretch = (JoxStretch){.from = {last->x, last->y},
                                .by = {jox_track_way(now.x - last->x, frame->period.x),
                                       jox_track_way(now.y - last->y, frame->period.y)},
                                .to = {now.x, now.y},
                                .begun = last->time,
                                .ended = now.time};
    *last = now;
    return known;
}

/* Of stretches by a-b: see jox_stretch_crosses. */
int jox_stretch_crosses_near(const JoxStretch *stretch, JoxV2 a, JoxV2 b, double *time);
/* +1 or -1, and the time, if the stretch crosses a-b; else 0. Most are elsewhere. */
static inline int jox_stretch_crosses(const JoxStretch *s, JoxV2 a, JoxV2 b, double *time) {
    const JoxV2 end = jox_add(s->from, s->by), begin = jox_sub(s->to, s->by);
    const bool by = jox_boxes_meet(a, b, s->from, end) || jox_boxes_meet(a, b, begin, s->to);
    return by ? jox_stretch_crosses_near(s, a, b, time) : 0;
}

#endif
