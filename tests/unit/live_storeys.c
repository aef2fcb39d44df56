/* Storeys in the messages of the live page: what they are, where people stand on them in frames, of
   a run and of its recording, and fields whose rows lie on one sheet each. */
#include "geom/storeys.h"
#include "live_recording.h"

static const char SCENE[] =
    "jostle: 1\n"
    "storeys: {ground: {height: -1}, first: {height: 3}, second: {height: 8}}\n"
    "stairs:\n"
    "  steps: {from: ground, to: first, path: [[4, 2], [11, 2]], width: 2}\n"
    "  belt: {kind: escalator, way: up, from: first, to: second, path: [[14, 2], [24, 2]], width: "
    "1.2}\n"
    "walls: [{line: [[0, 0], [40, 0], [40, 16], [0, 16]], closed: true, storey: [ground, first, "
    "second]}]\n"
    "places:\n"
    "  foot: {polygon: [[0.5, 1], [3, 1], [3, 8], [0.5, 8]]}\n"
    "  low: {polygon: [[30, 2], [38, 2], [38, 14], [30, 14]]}\n"
    "  high: {polygon: [[30, 2], [38, 2], [38, 14], [30, 14]], storey: second}\n"
    "groups:\n"
    "  climbers: {behaviour: own.lua, count: 12, in: foot}\n"
    "  standers: {behaviour: own.lua, count: 9, in: low, set: {speed: 0}}\n";
static const char CLIMBING[] =
    MACHINE_START "\"Climb\", states = { Climb = { steer = seek \"high\" } } }\n";

/* Place of a slot by a frame. */
typedef struct Stand {
    uint32_t deck;
    double x, y, height;
} Stand;

static Stand decode_stand(const JoxBytes *frame, uint32_t slot) {
    const uint8_t *at = frame->data;
    const uint32_t slots = get32(at + 16), bodies = get32(at + 20);
    const uint8_t *heights = at + JOX_LIVE_HEAD + JOX_LIVE_SLOT * slots + JOX_LIVE_BODY * bodies;
    const uint8_t *own = heights + 8 + 4 * (size_t)slot, *place = at + 48 + 8 * (size_t)slot;
    const Seen seen = {.x0 = get_float(at + 24),
                       .y0 = get_float(at + 28),
                       .sx = get_float(at + 32),
                       .sy = get_float(at + 36),
                       .slot = at + 48};
    assert_true(get32(at + 44) & 4);
    assert_true(frame->length >= (size_t)(heights + 8 + 4 * (size_t)slots - at));
    assert_true(place[5] != JOX_LIVE_NOBODY);
    return (Stand){own[0] | (uint32_t)own[1] << 8, x_of(&seen, slot), y_of(&seen, slot),
                   (double)get_float(heights) +
                       (double)get_float(heights + 4) * (own[2] | own[3] << 8)};
}

/* Returns how high the path is that leads over both stairs, at a point beside it. */
static double find_height_of_path(uint32_t deck, double x) {
    const double up = fmin(fmax((x - 4) / 7, 0), 1), on = fmin(fmax((x - 14) / 10, 0), 1);
    return deck == 3 ? -1 + 4 * up : deck == 4 ? 3 + 5 * on : deck == 0 ? -1 : deck == 1 ? 3 : 8;
}

/* Checks a frame against positions on sheets; adds how many stand on each deck. */
static void check_stands(const JoxBytes *frame, const JoxStoreys *s, const uint32_t *slot,
                         const float *x, const float *y, uint32_t count, uint32_t on[5]) {
    for (uint32_t i = 0; i < count; i++) {
        const Stand stand = decode_stand(frame, slot[i]);
        const uint32_t sheet = (uint32_t)floorf((y[i] - s->origin) / s->pitch);
        assert_true(stand.deck < 5);
        assert_int_equal(stand.deck < 3 ? stand.deck : s->stairs[stand.deck - 3].sheet, sheet);
        assert_near(stand.x, x[i], 2e-3);
        assert_near(stand.y, y[i] - (float)sheet * s->pitch, 2e-3);
        assert_near(stand.height, find_height_of_path(stand.deck, (double)x[i]), 3e-3);
        on[stand.deck]++;
    }
}

/* Checks the scene message of a run or of its recording. */
static void check_message(const JoxText *text) {
    parse_numbers(text);
    for (int k = 0; k < 3; k++)
        check_name_in(text, (const char *[]){"ground", "first", "second"}[k]);
    assert_near(number_at("storeys.list.%d.height", 2, 0, 0), 8, 1e-6);
    assert_near(number_at("storeys.stairs.0.lower", 0, 0, 0), 0, 0);
    assert_near(number_at("storeys.stairs.1.upper", 0, 0, 0), 2, 0);
    assert_near(number_at("storeys.stairs.0.flights.0.run", 0, 0, 0), 7, 1e-5);
    assert_near(number_at("storeys.stairs.0.flights.0.low", 0, 0, 0), -1, 1e-5);
    assert_near(number_at("storeys.stairs.1.flights.0.slope", 0, 0, 0), 0.5, 1e-5);
    assert_near(number_at("storeys.stairs.0.outline.%d.%d", 0, 1, 0), 1, 1e-5);
    assert_non_null(strstr(text->data, "\"kind\": \"escalator\", \"way\": \"up\""));
}

static void frames_tell_where_people_stand(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(SCENE, CLIMBING);
    const JoxAgents *a = &scene->world->state.agents;
    JoError error = {0};
    JoxBytes frame = {0};
    JoxText text = {0};
    uint32_t on[5] = {0};
    snprintf(path, sizeof path, "%s/storeys.sqlite", test_folder);
    assert_true(jo_scene_record(scene, path, 0.5, &error));
    jox_live_scene(scene, false, &text);
    check_message(&text);
    for (int t = 0; t < 80; t++) {
        step_scene(scene, 10);
        jox_live_frame(scene, JOX_LIVE_COLOUR_state, NULL, &frame);
        check_stands(&frame, &scene->world->model.storeys, a->slot, a->x, a->y, a->count, on);
    }
    for (int k = 0; k < 5; k++)
        assert_true(on[k] > 10);
    assert_true(jo_scene_finish(scene, &error));
    jo_scene_free(scene);
    jox_bytes_free(&frame);
    jox_text_free(&text);
}

static void frames_of_recordings_tell_where_people_stand(void **state) {
    (void)state;
    JoxReplay *replay = open_replay(path, NULL, 0);
    JoxBytes frame = {0};
    JoxText text = {0}, why = {0};
    uint32_t on[5] = {0}, leaps = 0;
    uint8_t parity[64] = {0};
    jox_replay_scene(replay, &text);
    check_message(&text);
    for (uint32_t f = 0; f < jox_replay_frames(replay); f++) {
        assert_true(jox_replay_show(replay, f, &why));
        jox_replay_frame(replay, JOX_LIVE_COLOUR_state, NULL, &frame);
        for (uint32_t s = 0; s < get32(frame.data + 16); s++) {
            const Stand stand = decode_stand(&frame, s);
            assert_near(stand.height, find_height_of_path(stand.deck, stand.x), 5e-3);
            on[stand.deck]++;
            const uint8_t bit = frame.data[48 + 8 * (size_t)s + 7] & 1;
            leaps += f > 0 && parity[s] != bit;
            parity[s] = bit;
        }
    }
    for (int k = 0; k < 5; k++)
        assert_true(on[k] > 10);
    assert_int_equal(leaps, 0); /* nobody leaps where they come to another sheet */
    jox_replay_close(replay);
    jox_bytes_free(&frame);
    jox_text_free(&text);
    jox_text_free(&why);
}

/* The rows of a field's block hold the people of its sheet. */
static void fields_have_a_block_for_each_sheet(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(SCENE, CLIMBING);
    const JoWorld *world = scene->world;
    JoxBytes field = {0};
    step_scene(scene, 1);
    jox_live_field(scene, JOX_LIVE_DENSITY, NULL, &field);
    const uint8_t *at = field.data;
    const uint32_t columns = get32(at + 8), rows = get32(at + 12);
    const double cell = (double)get_float(at + 24), top = (double)get_float(at + 28);
    const uint8_t *blocks = at + 32 + (size_t)columns * rows;
    const uint32_t count = (uint32_t)((field.length - (size_t)(blocks - at)) / 16);
    double people[5] = {0};
    uint32_t next = 0;
    assert_true(count >= 3 && count <= world->model.storeys.sheet_count);
    for (uint32_t b = 0; b < count; b++) {
        const uint8_t *block = blocks + 16 * (size_t)b;
        const uint32_t sheet = get32(block), first = get32(block + 4),
                       end = first + get32(block + 8);
        assert_true(sheet < 5 && first == next && end <= rows);
        next = end;
        for (uint32_t c = first * columns; c < end * columns; c++)
            people[sheet] += at[32 + c] / 255.0 * top * cell * cell;
    }
    assert_int_equal(next, rows);
    assert_near(people[0], 21, 0.4);
    for (int sheet = 1; sheet < 5; sheet++)
        assert_near(people[sheet], 0, 0.2);
    jox_bytes_free(&field);
    jo_scene_free(scene);
}

static void one_plane_has_no_storeys(void **state) {
    (void)state;
    JoScene *scene = load_scene_file("scenes/dodgeball.yaml", NULL, 0);
    JoxBytes frame = {0};
    JoxText text = {0};
    jox_live_scene(scene, false, &text);
    assert_non_null(strstr(text.data, "\"storeys\": null"));
    jox_live_frame(scene, JOX_LIVE_COLOUR_state, NULL, &frame);
    decode_frame(&frame, scene->world); /* of the length without stands */
    assert_int_equal(get32(frame.data + 44) & 4, 0);
    jox_bytes_free(&frame);
    jox_text_free(&text);
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_tell_where_people_stand),
        cmocka_unit_test(frames_of_recordings_tell_where_people_stand),
        cmocka_unit_test(fields_have_a_block_for_each_sheet),
        cmocka_unit_test(one_plane_has_no_storeys),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
