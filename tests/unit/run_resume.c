/* Tests of checkpoints: a damaged file is refused with the reason, and memory that runs out while
 * reading or writing is an error of the call. */
#include <sys/stat.h>

#include "unit/scene_loader.h"

#define YARD                                                                                       \
    "jostle: 1\nwalls: [{line: [[0, -2], [9, -2]]}]\n"                                             \
    "groups: {people: {behaviour: own.lua, at: [[0, 0], [1, 0.1], [2, -0.3], [3, 0.2]]}}\n"
#define WALK                                                                                       \
    MACHINE_START                                                                                  \
    "\"A\", states = { A = { steer = drift(1, 0), { to = \"A\", when = after(1) } } } }\n"

static char latest[400], target[320];

static JoScene *load_yard(JoError *error) {
    JoSceneDef def = define_scene(test_path("scene.yaml"));
    def.message = ignore_message; /* takes no memory while there is none */
    def.resumable = true;
    return jo_scene_load(&def, error);
}

static JoScene *resume_yard(const char *path, char **note, JoError *error) {
    JoSceneDef def = jo_default_scene_def();
    def.message = ignore_message;
    return jo_scene_resume(&def, path, note, error);
}

/* Runs ten steps with a checkpoint after each. Returns the hash, or 0 with `error`. */
static uint64_t write_checkpoints(JoError *error) {
    JoScene *scene = load_yard(error);
    bool good = scene && jo_scene_checkpoint(scene, target, 0.05, "a note\n", error);
    for (int n = 0; good && n < 10; n++)
        good = jo_scene_step(scene, error);
    const uint64_t hash = good ? jo_world_hash(jo_scene_world(scene)) : 0;
    jo_scene_free(scene);
    return hash;
}

static void write_yard_and_checkpoint(void) {
    JoError error = {0};
    write_test_file("own.lua", WALK);
    write_test_file("scene.yaml", YARD);
    snprintf(target, sizeof target, "%s/checkpoints", test_folder);
    snprintf(latest, sizeof latest, "%s/latest.checkpoint", target);
    if (!write_checkpoints(&error))
        fail_msg("%s", error.text);
}

static void checkpoint_holds_state_and_note(void **state) {
    (void)state;
    JoError error = {0};
    char *note = NULL;
    write_yard_and_checkpoint();
    const uint64_t hash = write_checkpoints(&error);
    JoScene *scene = resume_yard(latest, &note, &error);
    if (!scene)
        fail_msg("%s", error.text);
    assert_string_equal(note, "a note\n");
    assert_int_equal(jo_world_tick(jo_scene_world(scene)), 10);
    assert_true(jo_world_hash(jo_scene_world(scene)) == hash);
    jo_free(note);
    jo_scene_free(scene);
    scene = load_yard(&error);
    step_scene(scene, 1);
    assert_false(jo_scene_record_on(scene, latest, &error)); /* it was not resumed */
    jo_scene_free(scene);
}

static void assert_checkpoint_refused(const char *bytes, size_t length, const char *what,
                                      size_t at) {
    const char *path = test_path("bad.checkpoint");
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, length, file), length);
    assert_int_equal(fclose(file), 0);
    JoError error = {0};
    char *note = NULL;
    if (resume_yard(path, &note, &error))
        fail_msg("%s at byte %zu was taken", what, at);
    assert_int_equal(error.code, JO_INPUT);
    assert_true(strlen(error.text) > 20 && !note);
}

static void damaged_checkpoint_is_refused(void **state) {
    (void)state;
    write_yard_and_checkpoint();
    size_t length;
    char *bytes = jox_read_file(latest, 1 << 24, &length);
    assert_non_null(bytes);
    for (size_t at = 0; at < length; at += at < 400 ? 1 : 61) {
        bytes[at] ^= 0x20;
        assert_checkpoint_refused(bytes, length, "another bit", at);
        bytes[at] ^= 0x20;
    }
    for (size_t at = 0; at < length; at += at < 200 ? 7 : 997)
        assert_checkpoint_refused(bytes, at, "an end", at);
    assert_checkpoint_refused(bytes, length - 1, "an end", length - 1);
    char *longer = jox_alloc(length + 1, 1);
    memcpy(longer, bytes, length);
    assert_checkpoint_refused(longer, length + 1, "a byte more", length);
    jox_free(longer);
    jox_free(bytes);
}

static bool out_of_memory(const JoError *error) {
    return error->code == JO_FAILED && strstr(error->text, "out of memory");
}

static void out_of_memory_is_an_error_of_the_call(void **state) {
    (void)state;
    write_yard_and_checkpoint();
    int failures = 0;
    for (uint64_t n = 0, stride = 1;; n += stride, stride += stride / 16 + (n > 64)) {
        JoError error = {0};
        char *note = NULL;
        jox_alloc_fail_after(n);
        JoScene *scene = resume_yard(latest, &note, &error);
        jox_alloc_fail_after(UINT64_MAX);
        jo_free(note);
        jo_scene_free(scene);
        if (scene)
            break;
        assert_true(out_of_memory(&error));
        failures++;
    }
    for (uint64_t n = 0, stride = 1;; n += stride, stride += stride / 16 + (n > 64)) {
        JoError error = {0};
        jox_alloc_fail_after(n);
        const bool good = write_checkpoints(&error) != 0;
        jox_alloc_fail_after(UINT64_MAX);
        JoError other = {0};
        char *note = NULL;
        JoScene *scene =
            resume_yard(target, &note, &other); /* the previous checkpoint, or the new one */
        if (!scene)
            fail_msg("allocation %llu: %s", (unsigned long long)n, other.text);
        jo_free(note);
        jo_scene_free(scene);
        if (good)
            break;
        assert_true(out_of_memory(&error));
        failures++;
    }
    assert_true(failures > 20);
}

/* Fails where a checkpoint was left half written beside the whole ones. */
static int remove_checkpoints(void **state) {
    unlink(test_path("checkpoints/latest.checkpoint"));
    unlink(test_path("checkpoints/before.checkpoint"));
    return rmdir(target) == 0 ? remove_scene_folder(state) : -1;
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(checkpoint_holds_state_and_note),
                                       cmocka_unit_test(damaged_checkpoint_is_refused),
                                       cmocka_unit_test(out_of_memory_is_an_error_of_the_call)};
    return cmocka_run_group_tests(tests, make_test_folder, remove_checkpoints);
}
