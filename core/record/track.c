#include "record/track.h"

#include <math.h>

#include "base/mem.h"
#include "geom/polygon.h"

void jox_track_reserve(JoxTrack *track, const JoxFrame *frame) {
    JOX_RESERVE_ZEROED(track->items, track->capacity, frame->slot ? frame->slots : frame->keys);
}

void jox_track_sections(JoxTrack *track, JoxSections *s) {
    JOX_SECTION_ROOM(s, "tracked", track->items, track->capacity);
}

static float shortest(float d, float period) {
    if (period > 0.0f && fabsf(d) > 0.5f * period)
        d -= d > 0.0f ? period : -period;
    return d;
}

bool jox_track_step(JoxTrack *track, const JoxFrame *frame, uint32_t i, JoxStretch *stretch) {
    const uint32_t key = frame->key[i];
    struct JoxTracked *last = &track->items[frame->slot ? frame->slot[i] : key];
    struct JoxTracked now = {frame->x[i], frame->y[i], frame->time, key + 1, 0};
    bool known = last->person == now.person;
    if (known)
        *stretch = (JoxStretch){.from = {last->x, last->y},
                                .by = {shortest(now.x - last->x, frame->period.x),
                                       shortest(now.y - last->y, frame->period.y)},
                                .to = {now.x, now.y},
                                .begun = last->time,
                                .ended = now.time};
    *last = now;
    return known;
}

int jox_stretch_crosses(const JoxStretch *s, JoxV2 a, JoxV2 b, double *time) {
    JoxV2 from = s->from, to = jox_add(s->from, s->by);
    int crosses = jox_segment_crossing(a, b, from, to);
    if (crosses == 0 && (to.x != s->to.x || to.y != s->to.y)) { /* seen from the other edge */
        from = jox_sub(s->to, s->by), to = s->to;
        crosses = jox_segment_crossing(a, b, from, to);
    }
    if (crosses == 0)
        return 0;
    JoxV2 along = jox_sub(b, a);
    double before = fabs((double)jox_det(along, jox_sub(from, a)));
    double after = fabs((double)jox_det(along, jox_sub(to, a)));
    double share = before + after > 0.0 ? before / (before + after) : 0.0;
    *time = s->begun + share * (s->ended - s->begun);
    return crosses;
}
