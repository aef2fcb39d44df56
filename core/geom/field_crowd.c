/* People who are held up make the floor about them slow, so that ways lead round a crowd where
   that is sooner. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "geom/field_parts.h"

static const float REACH = 2.0f; /* m: a person is spread as a cone of this radius */

/* The cells that a person is spread over. */
typedef struct Span {
    int c0, c1, r0, r1;
} Span;

static float share_at(const JoxFieldWork *w, int cell, JoxV2 at) {
    if (w->node[cell] == JOX_FIELD_BLOCKED)
        return 0.0f;
    float far2 = jox_length2(jox_sub(jox_field_node(w, cell), at));
    return far2 < REACH * REACH ? 1.0f - sqrtf(far2) / REACH : 0.0f;
}

/* A person is spread as a cone over the floor that can be walked, and nothing into walls: else the
   floor along walls would seem free. `shares`: room for the span's cells. */
static void spread(JoxFieldWork *w, const Span *s, JoxV2 at, float slowing, float *shares) {
    const JoxField *f = w->f;
    float sum = 0.0f, area = f->size * f->size, *share = shares;
    for (int r = s->r0; r <= s->r1; r++)
        for (int c = s->c0; c <= s->c1; c++)
            sum += *share++ = share_at(w, r * f->columns + c, at);
    if (!(sum > 0.0f))
        return;
    share = shares;
    for (int r = s->r0; r <= s->r1; r++)
        for (int c = s->c0; c <= s->c1; c++)
            w->slowness[r * f->columns + c] += slowing * *share++ / (sum * area);
}

void jox_field_crowd(JoxFieldWork *w, const JoxFieldCrowd *crowd) {
    const JoxField *f = w->f;
    float *shares = NULL;
    size_t capacity = 0;
    for (uint32_t n = 0; crowd && n < crowd->count; n++) {
        JoxV2 at = crowd->at[n];
        Span s;
        JOX_ASSERT(crowd->held[n] >= 0.0f && crowd->held[n] <= 1.0f);
        jox_field_span(at.x - REACH, at.x + REACH, f->low.x, f->size, f->columns, &s.c0, &s.c1);
        jox_field_span(at.y - REACH, at.y + REACH, f->low.y, f->size, f->rows, &s.r0, &s.r1);
        if (s.c0 > s.c1 || s.r0 > s.r1)
            continue;
        JOX_RESERVE(shares, capacity, (size_t)(s.c1 - s.c0 + 1) * (size_t)(s.r1 - s.r0 + 1));
        spread(w, &s, at, crowd->slowing * crowd->held[n], shares);
    }
    jox_free(shares);
}
