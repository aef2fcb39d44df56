/* Decoding of a live page's messages, as a browser does it: numbers of JSON by path, and frames
   from their bytes. */
#ifndef JOX_TESTS_HOST_BYTES_H
#define JOX_TESTS_HOST_BYTES_H

#include "base/format/json.h"
#include "live/live.h"
#include "unit/assert_near.h"
#include "unit/scene_loader.h"

/* ---- JSON: its numbers by path ---- */

typedef struct Numbers {
    struct {
        char path[64];
        double value;
    } items[20000];
    int count;
} Numbers;
static Numbers numbers;

static inline void keep_number(void *context, const char *path, double value) {
    Numbers *n = context;
    assert_true(n->count < 20000);
    snprintf(n->items[n->count].path, sizeof n->items->path, "%s", path);
    n->items[n->count++].value = value;
}

static inline double number_at(const char *format, int a, int b, int c) {
    char path[64];
    snprintf(path, sizeof path, format, a, b, c);
    for (int i = 0; i < numbers.count; i++)
        if (strcmp(numbers.items[i].path, path) == 0)
            return numbers.items[i].value;
    return NAN;
}

static inline void parse_numbers(const JoxText *text) {
    numbers.count = 0;
    if (!jox_json_numbers(text->data, keep_number, &numbers))
        fail_msg("no JSON: %s", text->data);
}

static inline void check_name_in(const JoxText *text, const char *name) {
    JoxText quoted = {0};
    jox_text_json(&quoted, name);
    if (!strstr(text->data, quoted.data))
        fail_msg("%s is not named", quoted.data);
    jox_text_free(&quoted);
}

/* ---- binary ---- */

static inline uint32_t get32(const uint8_t *at) {
    return at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

static inline float get_float(const uint8_t *at) {
    const uint32_t bits = get32(at);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline double get_double(const uint8_t *at) {
    const uint64_t bits = get32(at) | (uint64_t)get32(at + 4) << 32;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

typedef struct Seen {
    uint32_t tick;
    double time;
    uint32_t slots, bodies;
    float x0, y0, sx, sy, most;
    const uint8_t *slot, *body;
} Seen;

static inline Seen decode_bytes(const uint8_t *at, size_t length) {
    assert_true(length >= 48);
    assert_int_equal(get32(at), 1);
    Seen seen = {.tick = get32(at + 4),
                 .time = get_double(at + 8),
                 .slots = get32(at + 16),
                 .bodies = get32(at + 20),
                 .x0 = get_float(at + 24),
                 .y0 = get_float(at + 28),
                 .sx = get_float(at + 32),
                 .sy = get_float(at + 36),
                 .most = get_float(at + 40),
                 .slot = at + 48};
    seen.body = seen.slot + 8 * (size_t)seen.slots;
    const size_t person = 8 + get32(at + 44); /* bytes of a slot and its chest */
    assert_int_equal(length, 48 + person * (size_t)seen.slots + 20 * (size_t)seen.bodies);
    return seen;
}

static inline double x_of(const Seen *seen, uint32_t slot) {
    const uint8_t *at = seen->slot + 8 * (size_t)slot;
    return (double)seen->x0 + (double)seen->sx * (at[0] | at[1] << 8);
}

static inline double y_of(const Seen *seen, uint32_t slot) {
    const uint8_t *at = seen->slot + 8 * (size_t)slot;
    return (double)seen->y0 + (double)seen->sy * (at[2] | at[3] << 8);
}

static inline Seen decode_frame(const JoxBytes *frame, const JoWorld *world) {
    const Seen seen = decode_bytes(frame->data, frame->length);
    assert_int_equal(seen.tick, world->state.tick);
    assert_near(seen.time, (double)world->state.tick * world->model.def.dt, 1e-9);
    return seen;
}

/* Checks that a frame has all agents at their positions, within half a unit, and no others. */
static inline void check_frame_people(const JoScene *scene, const Seen *seen) {
    const JoxAgents *a = &scene->world->state.agents;
    uint32_t people = 0;
    assert_true(seen->sx < 0.01f && seen->sy < 0.01f);
    for (uint32_t s = 0; s < seen->slots; s++) {
        const uint8_t *at = seen->slot + 8 * (size_t)s;
        if (at[5] == 255)
            continue;
        people++;
        const uint32_t i = a->slot_index[s];
        assert_int_not_equal(i, JOX_NO_INDEX);
        assert_near(x_of(seen, s), a->x[i], 0.501 * (double)seen->sx + 1e-5);
        assert_near(y_of(seen, s), a->y[i], 0.501 * (double)seen->sy + 1e-5);
        double turned = at[4] * 2 * M_PI / 256 - atan2(a->face_y[i], a->face_x[i]);
        assert_near(remainder(turned, 2 * M_PI), 0, 0.51 * 2 * M_PI / 256);
        assert_int_equal(at[7] >> 1 & 1, a->failed[i]);
    }
    assert_int_equal(people, a->count);
}

static inline JoScene *load_tawaf(const char *count) {
    char people[64], keep[64];
    snprintf(people, sizeof people, "groups.pilgrims.count=%s", count);
    snprintf(keep, sizeof keep, "sources.0.keep=%s", count);
    const char *sets[] = {people, keep};
    return load_scene_file("scenes/tawaf.yaml", sets, 2);
}

#endif
