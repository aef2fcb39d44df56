/* Frames as bytes: positions as 16-bit steps over an area, headings as 256ths of a turn. */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "live/live.h"

enum { STEPS = 65535, PEOPLE_HEAD = 16, FRAME = 1, PEOPLE = 2 };

const JoxLiveColourInfo jox_live_colours[JOX_LIVE_COLOUR_COUNT] = {
#define X(name, most, unit) {#name, unit, most},
    JOX_LIVE_COLOURS(X)
#undef X
};

int jox_live_colour(const char *name) {
    for (int c = 0; c < JOX_LIVE_COLOUR_COUNT; c++)
        if (strcmp(jox_live_colours[c].name, name) == 0)
            return c;
    return -1;
}

void jox_bytes_free(JoxBytes *bytes) {
    jox_free(bytes->data);
    *bytes = (JoxBytes){0};
}

static void resize(JoxBytes *bytes, size_t length) {
    JOX_RESERVE(bytes->data, bytes->capacity, length);
    bytes->length = length;
}

/* ---- little-endian numbers, whatever the machine's order ---- */

static inline uint8_t *put16(uint8_t *at, uint16_t value) {
    at[0] = (uint8_t)value;
    at[1] = (uint8_t)(value >> 8);
    return at + 2;
}

static inline uint8_t *put32(uint8_t *at, uint32_t value) {
    return put16(put16(at, (uint16_t)value), (uint16_t)(value >> 16));
}

static uint8_t *put_float(uint8_t *at, float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return put32(at, bits);
}

static uint8_t *put_double(uint8_t *at, double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return put32(put32(at, (uint32_t)bits), (uint32_t)(bits >> 32));
}

/* ---- the area ---- */

static void cover_axis(float *low, float *high, float from, float to, bool known) {
    float more = known ? 0.25f * (*high - *low) : 0.0f;
    if (from < *low)
        *low = jox_minf(from, *low - more);
    if (to > *high)
        *high = jox_maxf(to, *high + more);
}

void jox_live_cover(JoxLiveArea *area, JoxV2 low, JoxV2 high) {
    if (!(low.x <= high.x && low.y <= high.y))
        return; /* nothing, or not a number */
    if (!area->known) {
        area->low = low;
        area->high = high;
    }
    cover_axis(&area->low.x, &area->high.x, low.x, high.x, area->known);
    cover_axis(&area->low.y, &area->high.y, low.y, high.y, area->known);
    area->known = true;
    /* an area without width has steps all the same */
    area->steps = (JoxV2){STEPS / jox_maxf(area->high.x - area->low.x, 1.0f),
                          STEPS / jox_maxf(area->high.y - area->low.y, 1.0f)};
}

/* ---- frames ---- */

void jox_live_begin_frame(JoxBytes *out, const JoxLiveHead *head) {
    const JoxLiveArea *area = head->area;
    size_t people = (size_t)head->slots * JOX_LIVE_SLOT;
    resize(out, JOX_LIVE_HEAD + people + (size_t)head->bodies * JOX_LIVE_BODY);
    uint8_t *at = put32(put32(out->data, FRAME), head->tick);
    at = put_double(at, head->time);
    at = put32(put32(at, head->slots), head->bodies);
    at = put_float(put_float(at, area->low.x), area->low.y);
    at = put_float(put_float(at, 1.0f / area->steps.x), 1.0f / area->steps.y);
    at = put32(put_float(at, head->most), 0);
    static const uint8_t NOBODY[JOX_LIVE_SLOT] = {[5] = JOX_LIVE_NOBODY};
    for (uint32_t s = 0; s < head->slots; s++, at += JOX_LIVE_SLOT)
        memcpy(at, NOBODY, JOX_LIVE_SLOT);
}

/* Angle of (x, y) in 256ths of a turn, to within a hundredth of one: atan by a polynomial on the
   octant. */
static inline uint8_t heading(float x, float y) {
    float across = fabsf(x), up = fabsf(y);
    float longer = jox_maxf(across, up), shorter = jox_minf(across, up);
    float t = longer > 0.0f ? shorter / longer : 0.0f, s = t * t;
    float angle = t * (1.0f + s * (-0.327622764f + s * (0.15931422f - 0.0464964749f * s)));
    angle = up > across ? 1.57079633f - angle : angle;
    angle = x < 0.0f ? 3.14159265f - angle : angle;
    angle = y < 0.0f ? -angle : angle;
    return (uint8_t)(int)(angle * (256.0f / 6.28318531f) + 256.5f);
}

static inline uint16_t steps(float away, float per_metre) {
    return (uint16_t)jox_clampf(away * per_metre + 0.5f, 0.0f, STEPS);
}

void jox_live_put_person(JoxBytes *frame, const JoxLiveArea *area, uint32_t slot,
                         const JoxLivePerson *person) {
    uint8_t *at = frame->data + JOX_LIVE_HEAD + (size_t)slot * JOX_LIVE_SLOT;
    at = put16(at, steps(person->x - area->low.x, area->steps.x));
    at = put16(at, steps(person->y - area->low.y, area->steps.y));
    at[0] = heading(person->face_x, person->face_y);
    at[1] = person->state;
    at[2] = (uint8_t)(jox_clampf(person->value, 0.0f, 1.0f) * 255.0f + 0.5f);
    at[3] = person->flags;
}

void jox_live_put_body(JoxBytes *frame, uint32_t slots, uint32_t row, JoxV3 position,
                       const float turn[4]) {
    uint8_t *at =
        frame->data + JOX_LIVE_HEAD + (size_t)slots * JOX_LIVE_SLOT + (size_t)row * JOX_LIVE_BODY;
    at = put_float(put_float(put_float(at, position.x), position.y), position.z);
    for (int i = 0; i < 4; i++)
        at = put16(at, (uint16_t)(int16_t)lrintf(jox_clampf(turn[i], -1.0f, 1.0f) * 32767.0f));
}

/* ---- people ---- */

void jox_live_begin_people(JoxBytes *out, uint32_t slots) {
    size_t before = out->length, length = PEOPLE_HEAD + 2 * (size_t)slots;
    resize(out, length);
    if (length > before) /* who was there already is compared */
        memset(out->data + before, 0, length - before);
    put32(put32(put32(put32(out->data, PEOPLE), 0), slots), 0);
}

bool jox_live_put_people(JoxBytes *people, uint32_t slot, float radius, uint32_t group) {
    uint8_t *at = people->data + PEOPLE_HEAD + 2 * (size_t)slot;
    uint8_t r = (uint8_t)(jox_clampf(radius, 0.0f, 2.55f) * 100.0f + 0.5f);
    uint8_t g = (uint8_t)(group < 255 ? group : 255);
    bool differs = at[0] != r || at[1] != g;
    at[0] = r;
    at[1] = g;
    return differs;
}
