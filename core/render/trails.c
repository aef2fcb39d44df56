/* The trails of people and bodies in pictures: where they went up to the present frame. */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "render/render.h"

/* Above MOST_FOLLOWED people, only a sample of them gets trails. */
enum { MOST_FOLLOWED = 500, MOST_TRAILS = 2000, MOST_BODY_TRAILS = 200 };
static const float STRIDE = 0.1f; /* m between points of a trail */

/* Appends a position to a trail once it is STRIDE away from the last. Where somebody crossed a
   periodic edge, a NAN point interrupts the line. */
static void extend_trail(JoxTrail *trail, JoxV2 at, JoxV2 period) {
    JoxV2 last = trail->count ? trail->points[trail->count - 1] : jox_v2(INFINITY, 0.0f);
    JoxV2 step = jox_sub(at, last);
    if (trail->count && jox_length2(step) < STRIDE * STRIDE)
        return;
    JOX_RESERVE(trail->points, trail->capacity, trail->count + 2);
    if (trail->count && ((period.x > 0.0f && fabsf(step.x) > 0.5f * period.x) ||
                         (period.y > 0.0f && fabsf(step.y) > 0.5f * period.y)))
        trail->points[trail->count++] = (JoxV2){NAN, NAN}; /* crossed a periodic edge */
    trail->points[trail->count++] = at;
}

static JoxTrail *add_trail(JoxRender *r, uint32_t key, uint16_t group, bool body) {
    JOX_RESERVE(r->trails, r->trail_capacity, r->trail_count + 1);
    r->trails[r->trail_count] = (JoxTrail){.key = key, .group = group, .body = body};
    return &r->trails[r->trail_count++];
}

void jox_render_extend_people_trails(JoxRender *r) {
    const JoxFrame *f = &r->frame;
    if (f->keys > r->trail_keys) {
        r->trail_of = jox_realloc(r->trail_of, f->keys, sizeof *r->trail_of);
        memset(r->trail_of + r->trail_keys, 0, (f->keys - r->trail_keys) * sizeof *r->trail_of);
        r->trail_keys = f->keys;
    }
    if (r->trail_stride == 0)
        r->trail_stride = 1 + (r->crowd ? r->crowd->people : f->count) / (MOST_FOLLOWED + 1);
    for (uint32_t i = 0; i < f->count; i++) {
        uint32_t *of = &r->trail_of[f->key[i]];
        if (f->key[i] % r->trail_stride != 0 || (!*of && r->trail_count >= MOST_TRAILS))
            continue;
        if (!*of) {
            add_trail(r, f->key[i], f->group ? f->group[i] : 0, false);
            *of = r->trail_count;
            r->picture.trail_people++;
        }
        extend_trail(&r->trails[*of - 1], jox_v2(f->x[i], f->y[i]), f->period);
    }
}

void jox_render_extend_body_trails(JoxRender *r) {
    const JoxObjects *objects = &r->scene->world->scratch.objects;
    uint32_t count = 0;
    for (uint32_t o = 0; o < objects->count; o++) {
        const JoxObject *object = &objects->rows[o];
        JoxTrail *trail = NULL;
        if (!object->live || !object->moves || ++count > MOST_BODY_TRAILS)
            continue;
        for (uint32_t t = 0; t < r->trail_count && !trail; t++)
            if (r->trails[t].body && r->trails[t].key == object->id)
                trail = &r->trails[t];
        if (!trail)
            trail = add_trail(r, object->id, 0, true);
        extend_trail(trail, jox_v2(object->position.x, object->position.y), (JoxV2){0, 0});
    }
}
