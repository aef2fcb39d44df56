/* Packing of frames and people into bytes, of a running scene or of a recording: positions as
   16-bit fractions of an area, headings as 256ths of a turn. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/clock.h"
#include "base/mem.h"
#include "base/number/bits.h"
#include "base/number/pi.h"
#include "live/live.h"

enum { STEPS = 65535, PEOPLE_HEAD = 16, FRAME = 1, PEOPLE = 2 };
enum { PERSON = 2, PERSON_WITH_TORSO = 4, CHEST = 1, STAND = 4 }; /* bytes of a slot */
enum { HEIGHTS = 8 };             /* bytes of the range of heights of a frame with storeys */
static const float RADIUS = 0.2f; /* m, for people whose radius is unknown */

const JoxLiveColourInfo jox_live_colours[JOX_LIVE_COLOUR_COUNT] = {
#define X(name, most, least, unit) {#name, unit, most, least},
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

static void resize_bytes(JoxBytes *bytes, size_t length) {
    JOX_RESERVE(bytes->data, bytes->capacity, length);
    bytes->length = length;
}

/* ---- little-endian numbers, whatever the machine's order ---- */

/* Each writes a number at `at` and returns the address behind it. */
static inline uint8_t *put16(uint8_t *at, uint16_t value) {
    at[0] = (uint8_t)value;
    at[1] = (uint8_t)(value >> 8);
    return at + 2;
}

static inline uint8_t *put32(uint8_t *at, uint32_t value) {
    return put16(put16(at, (uint16_t)value), (uint16_t)(value >> 16));
}

static uint8_t *put_float(uint8_t *at, float value) {
    return put32(at, jox_float_bits(value));
}

static uint8_t *put_double(uint8_t *at, double value) {
    const uint64_t bits = jox_double_bits(value);
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
        return; /* an empty box, or NAN */
    low = jox_in_plan(area->storeys, low);
    high = jox_in_plan(area->storeys, high);
    if (!area->known) {
        area->low = low;
        area->high = high;
    }
    cover_axis(&area->low.x, &area->high.x, low.x, high.x, area->known);
    cover_axis(&area->low.y, &area->high.y, low.y, high.y, area->known);
    area->known = true;
    /* at least 1 m, so that an area without width does not divide by zero */
    area->steps = (JoxV2){STEPS / jox_maxf(area->high.x - area->low.x, 1.0f),
                          STEPS / jox_maxf(area->high.y - area->low.y, 1.0f)};
}

bool jox_live_find_crowd_box(const JoxLiveCrowd *crowd, JoxV2 *low, JoxV2 *high) {
    *low = (JoxV2){INFINITY, INFINITY};
    *high = (JoxV2){-INFINITY, -INFINITY};
    for (uint32_t i = 0; i < crowd->count; i++) {
        const JoxV2 at = jox_in_plan(crowd->storeys, jox_v2(crowd->x[i], crowd->y[i]));
        *low = jox_v2(jox_minf(low->x, at.x), jox_minf(low->y, at.y));
        *high = jox_v2(jox_maxf(high->x, at.x), jox_maxf(high->y, at.y));
    }
    return low->x <= high->x && low->y <= high->y;
}

void jox_live_cover_crowd(JoxLiveArea *area, const JoxLiveCrowd *crowd) {
    JoxV2 low, high;
    if (jox_live_find_crowd_box(crowd, &low, &high))
        jox_live_cover(area, low, high);
}

/* ---- frames ---- */

/* Writes the head, and marks all slots as empty. `most`: the value that byte 255 stands for.
   `more`: bytes of a slot behind the bodies, CHEST and STAND. `room`: other bytes there. */
static void write_frame_head(JoxBytes *out, const JoxLiveHead *head, uint32_t slots, float most,
                             uint32_t more, size_t room) {
    const JoxLiveArea *area = head->area;
    const size_t people = (size_t)slots * (JOX_LIVE_SLOT + more);
    resize_bytes(out, JOX_LIVE_HEAD + people + (size_t)head->bodies * JOX_LIVE_BODY + room);
    uint8_t *at = put32(put32(out->data, FRAME), head->tick);
    at = put_double(at, head->time);
    at = put32(put32(at, slots), head->bodies);
    at = put_float(put_float(at, area->low.x), area->low.y);
    at = put_float(put_float(at, 1.0f / area->steps.x), 1.0f / area->steps.y);
    at = put32(put_float(at, most), more);
    static const uint8_t NOBODY[JOX_LIVE_SLOT] = {[5] = JOX_LIVE_NOBODY};
    for (uint32_t s = 0; s < slots; s++, at += JOX_LIVE_SLOT)
        memcpy(at, NOBODY, JOX_LIVE_SLOT);
}

/* Returns the angle of (x, y) in 256ths of a turn, with an error below 0.01 of them: arctangent by
   a polynomial on one octant. */
static inline uint8_t encode_heading(float x, float y) {
    float across = fabsf(x), up = fabsf(y);
    float longer = jox_maxf(across, up), shorter = jox_minf(across, up);
    float t = longer > 0.0f ? shorter / longer : 0.0f, s = t * t;
    float angle = t * (1.0f + s * (-0.327622764f + s * (0.15931422f - 0.0464964749f * s)));
    angle = up > across ? (float)(JOX_PI / 2.0) - angle : angle;
    angle = x < 0.0f ? (float)JOX_PI - angle : angle;
    angle = y < 0.0f ? -angle : angle;
    return (uint8_t)(int)(angle * (256.0f / (float)JOX_TURN) + 256.5f);
}

static inline uint16_t encode_position(float away, float per_metre) {
    return (uint16_t)jox_clampf(away * per_metre + 0.5f, 0.0f, STEPS);
}

static inline float compute_person_speed(const JoxLiveCrowd *crowd, uint32_t i) {
    return sqrtf(crowd->vx[i] * crowd->vx[i] + crowd->vy[i] * crowd->vy[i]);
}

double jox_live_mean_speed(const JoxLiveCrowd *crowd) {
    double sum = 0.0;
    for (uint32_t i = 0; i < crowd->count; i++)
        sum += (double)compute_person_speed(crowd, i);
    return crowd->count ? sum / crowd->count : 0.0;
}

static inline float find_colour_value(const JoxLiveCrowd *crowd, uint32_t i, JoxLiveColour colour) {
    switch (colour) {
    case JOX_LIVE_COLOUR_speed:
        return compute_person_speed(crowd, i);
    case JOX_LIVE_COLOUR_group:
        return crowd->group ? crowd->group[i] : 0.0f;
    default:
        return crowd->value ? crowd->value[i] : 0.0f;
    }
}

/* Returns the value of byte 255: the end of the colour's range, adapted to the crowd. */
static float choose_range(JoxLiveScales *scales, const JoxLiveCrowd *crowd, JoxLiveColour colour) {
    const JoxLiveColourInfo *info = &jox_live_colours[colour];
    const double now = jox_clock_wall();
    if (!scales || scales->fixed || info->least == 0.0f)
        return info->most;
    JoxLiveScale *scale = &scales->colours[colour];
    if (jox_live_scale_is_due(scale, now)) {
        const uint32_t stride = crowd->count / JOX_LIVE_SAMPLE + 1;
        JoxLiveSample sample = {.count = 0};
        for (uint32_t i = 0; i < crowd->count; i += stride)
            jox_live_sample_value(&sample, stride, i, find_colour_value(crowd, i, colour));
        jox_live_adapt_scale(scale, &sample, info->least, now);
    }
    return scale->most;
}

/* Writes the range of heights, and for each slot its deck and its height as a share of that range.
 */
static void put_stands(uint8_t *at, const JoxLiveCrowd *crowd) {
    float low, high;
    jox_live_find_heights(crowd->storeys, &low, &high);
    const float steps = STEPS / jox_maxf(high - low, 1.0f);
    at = put_float(put_float(at, low), 1.0f / steps);
    memset(at, 0, (size_t)STAND * crowd->slots);
    for (uint32_t i = 0; i < crowd->count; i++) {
        const JoxLiveStand stand = jox_live_find_stand(crowd, (JoxV2){crowd->x[i], crowd->y[i]});
        put16(put16(at + (size_t)STAND * crowd->slot[i], stand.deck),
              encode_position(stand.height - low, steps));
    }
}

void jox_live_pack_frame(const JoxLiveHead *head, const JoxLiveCrowd *crowd, JoxLiveColour colour,
                         JoxBytes *out) {
    const JoxLiveArea *area = head->area;
    const float most = choose_range(head->scales, crowd, colour);
    const float scale = most > 0.0f ? 1.0f / most : 0.0f;
    const bool stacked = jox_has_storeys(crowd->storeys);
    JOX_ASSERT(area->known && area->steps.x > 0.0f && area->steps.y > 0.0f);
    write_frame_head(out, head, crowd->slots, most,
                     (crowd->axis_x ? CHEST : 0u) + (stacked ? STAND : 0u), stacked ? HEIGHTS : 0);
    for (uint32_t i = 0; i < crowd->count; i++) {
        JOX_ASSERT(crowd->slot[i] < crowd->slots && crowd->state[i] != JOX_LIVE_NOBODY);
        uint8_t *at = out->data + JOX_LIVE_HEAD + (size_t)crowd->slot[i] * JOX_LIVE_SLOT;
        const bool faces = crowd->face_x && (crowd->face_x[i] != 0.0f || crowd->face_y[i] != 0.0f);
        const float value = find_colour_value(crowd, i, colour) * scale;
        const JoxV2 plan = jox_in_plan(crowd->storeys, (JoxV2){crowd->x[i], crowd->y[i]});
        at = put16(at, encode_position(plan.x - area->low.x, area->steps.x));
        at = put16(at, encode_position(plan.y - area->low.y, area->steps.y));
        at[0] = faces ? encode_heading(crowd->face_x[i], crowd->face_y[i])
                      : encode_heading(crowd->vx[i], crowd->vy[i]);
        at[1] = crowd->state[i];
        at[2] = (uint8_t)(jox_clampf(value, 0.0f, 1.0f) * 255.0f + 0.5f);
        at[3] = crowd->flags[i];
    }
    if (stacked) /* behind the bodies */
        put_stands(out->data + JOX_LIVE_HEAD + (size_t)crowd->slots * JOX_LIVE_SLOT +
                       (size_t)head->bodies * JOX_LIVE_BODY,
                   crowd);
    uint8_t *chests = out->data + out->length - crowd->slots; /* last */
    for (uint32_t i = 0; crowd->axis_x && i < crowd->count; i++)
        chests[crowd->slot[i]] = encode_heading(crowd->axis_y[i], -crowd->axis_x[i]);
}

void jox_live_put_body(JoxBytes *frame, uint32_t slots, uint32_t row, JoxV3 position,
                       const float turn[4]) {
    uint8_t *at =
        frame->data + JOX_LIVE_HEAD + (size_t)slots * JOX_LIVE_SLOT + (size_t)row * JOX_LIVE_BODY;
    at = put_float(put_float(put_float(at, position.x), position.y), position.z);
    for (int i = 0; i < 4; i++)
        at = put16(at, (uint16_t)(int16_t)lrintf(jox_clampf(turn[i], -1.0f, 1.0f) * 32767.0f));
}

void jox_live_add_cars(JoxBytes *frame, const JoxCarLook *cars, uint32_t count) {
    const size_t before = frame->length;
    resize_bytes(frame, before + (size_t)count * JOX_LIVE_CAR);
    uint8_t *at = frame->data + before;
    for (uint32_t l = 0; l < count; l++) {
        at = put_float(at, cars[l].height);
        *at++ = (uint8_t)(jox_clampf(cars[l].open, 0.0f, 1.0f) * 255.0f + 0.5f);
        *at++ = (uint8_t)cars[l].stop;
        *at++ = (uint8_t)(cars[l].people < 255 ? cars[l].people : 255);
        *at++ = (uint8_t)cars[l].mode;
    }
}

/* ---- people ---- */

/* Sizes the message for `slots` of `person` bytes each and writes its head. Bytes of slots that
   were there stay, so that the caller can compare them, unless they had another size. */
static void write_people_head(JoxBytes *out, uint32_t slots, uint32_t person) {
    const size_t length = PEOPLE_HEAD + person * (size_t)slots;
    const size_t before = out->length && out->data[12] == person ? out->length : 0;
    resize_bytes(out, length);
    if (length > before)
        memset(out->data + before, 0, length - before);
    put32(put32(put32(put32(out->data, PEOPLE), 0), slots), person);
}

/* Returns a length in cm. */
static inline uint8_t encode_length(float metres) {
    return (uint8_t)(jox_clampf(metres, 0.0f, 2.55f) * 100.0f + 0.5f);
}

bool jox_live_pack_people(const JoxLiveCrowd *crowd, JoxBytes *out) {
    const size_t before = out->length;
    const uint32_t size = crowd->axis_x ? PERSON_WITH_TORSO : PERSON;
    write_people_head(out, crowd->slots, size);
    bool differs = out->length != before;
    for (uint32_t i = 0; i < crowd->count; i++) {
        JOX_ASSERT(crowd->slot[i] < crowd->slots);
        uint8_t *at = out->data + PEOPLE_HEAD + size * (size_t)crowd->slot[i];
        const float radius = !crowd->radius ? RADIUS : crowd->radius[crowd->one_radius ? 0 : i];
        const uint32_t group = crowd->group ? crowd->group[i] : 0;
        uint8_t person[PERSON_WITH_TORSO] = {encode_length(radius),
                                             (uint8_t)(group < 255 ? group : 255)};
        if (crowd->axis_x) {
            const float depth = 2.0f * crowd->contact_radius[i];
            const float axis = jox_length(jox_v2(crowd->axis_x[i], crowd->axis_y[i]));
            person[2] = encode_length(depth + 2.0f * axis);
            person[3] = encode_length(depth);
        }
        differs |= memcmp(at, person, size) != 0;
        memcpy(at, person, size);
    }
    return differs;
}
