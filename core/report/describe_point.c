/* Describes a point of the plan in words, for pages and summaries. */
#include "geom/polygon.h"
#include "geom/storey_text.h"
#include "report/subject.h"

static const float NEAR_LINE = 4.0f; /* m: lines farther away are not mentioned */

/* Returns the nearest line of a flow probe and its distance, m; NULL if none is near. */
static const JoxProbeDef *find_nearest_line(const JoxSubject *s, JoxV2 at, float *away) {
    const JoxProbeDef *found = NULL;
    *away = NEAR_LINE;
    for (uint32_t p = 0; p < s->probe_count; p++) {
        const JoxProbeDef *def = jox_probe_def(s->probes[p]);
        if (def->kind != JOX_PROBE_FLOW)
            continue;
        const JoxV2 on = jox_segment_nearest(def->points[0], def->points[1], at);
        const float distance = jox_length(jox_sub(on, at));
        if (distance < *away) {
            *away = distance;
            found = def;
        }
    }
    return found;
}

void jox_describe_point(const JoxSubject *s, JoxV2 at, JoxText *out) {
    float away;
    const JoxProbeDef *line = find_nearest_line(s, at, &away);
    jox_text_position(out, s->storeys, at, 1);
    if (line)
        jox_text_printf(out, ", %.1f m from the line %.60s", (double)away, line->name);
    jox_place_where(s->places, s->place_count, at, !line, out);
}
