/* People who are held up make the floor about them slow, so that ways lead round a crowd where
   that is sooner. */
#include <math.h>

#include "base/assert.h"
#include "geom/field_parts.h"

static const float REACH = 1.5f;   /* m: a person is spread as a cone of this radius */

void jox_field_crowd(JoxFieldWork *w, const JoxFieldCrowd *crowd) {
    const JoxField *f = w->f;
    const float peak = 3.0f / (3.14159265f * REACH * REACH); /* the cone's volume is 1 */
    for (uint32_t n = 0; crowd && n < crowd->count; n++) {
        JoxV2 at = crowd->at[n];
        int c0, c1, r0, r1;
        JOX_ASSERT(crowd->held[n] >= 0.0f && crowd->held[n] <= 1.0f);
        jox_field_span(at.x - REACH, at.x + REACH, f->low.x, f->size, f->columns, &c0, &c1);
        jox_field_span(at.y - REACH, at.y + REACH, f->low.y, f->size, f->rows, &r0, &r1);
        for (int r = r0; r <= r1; r++)
            for (int c = c0; c <= c1; c++) {
                int cell = r * f->columns + c;
                if (w->node[cell] == JOX_FIELD_BLOCKED)
                    continue;
                float far = jox_length(jox_sub(jox_field_node(w, cell), at));
                float share = jox_maxf(0.0f, 1.0f - far / REACH);
                w->slowness[cell] += crowd->slowing * crowd->held[n] * peak * share;
            }
    }
}
