/* Positions of people in the last frame, and crossings of lines by the path since then. */
#include "record/frame_track.h"

#include <math.h>

#include "base/mem.h"

void jox_track_reserve(JoxTrack *track, const JoxFrame *frame) {
    JOX_RESERVE_ZEROED(track->items, track->capacity, frame->slot ? frame->slots : frame->keys);
}

void jox_track_sections(JoxTrack *track, JoxSections *s) {
    JOX_SECTION_ROOM(s, "tracked", track->items, track->capacity);
}

int jox_stretch_crosses_exactly(const JoxStretch *s, JoxV2 a, JoxV2 b, double *time) {
    JoxV2 from = s->from, to = jox_add(s->from, s->by);
    int crosses = jox_segment_crossing(a, b, from, to);
    if (crosses == 0 &&
        (to.x != s->to.x || to.y != s->to.y)) { /* the path may cross a-b behind the edge or seam */
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
