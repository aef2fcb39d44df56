/* Tests of the parts that changed files connect, and of the watch on files and folders that come
 * and go. */
#include "base/mem.h"
#include "run/watch/changes.h"
#include "run/watch/watch.h"
#include "unit/test_folder.h"

/* Returns the next parts to load: "02" for parts 0 and 2, "p" for the scene's file, "" for none. */
static const char *try_next(JoxChanges *c) {
    static char text[JOX_PARTS + 1];
    bool parts[JOX_PARTS] = {false};
    double written;
    size_t n = 0;
    if (jox_changes_take_next(c, parts, &written))
        for (uint32_t p = 0; p < JOX_PARTS; p++)
            if (parts[p])
                text[n++] = p == JOX_PART_SCENE ? 'p' : (char)('0' + p);
    text[n] = 0;
    return text;
}

static void make_live(JoxChanges *c, const char *which) {
    bool parts[JOX_PARTS] = {false};
    for (; *which; which++)
        parts[*which == 'p' ? JOX_PART_SCENE : *which - '0'] = true;
    jox_changes_mark_live(c, parts);
}

/* Parts 0 and 1 share lib, 1 and 2 share more; 3 stands alone. */
static JoxChanges make_four_parts(void) {
    static const char *const USES[][2] = {{"0", "a"},    {"0", "lib"}, {"1", "b"},    {"1", "lib"},
                                          {"1", "more"}, {"2", "c"},   {"2", "more"}, {"3", "d"}};
    JoxChanges c = {0};
    for (size_t i = 0; i < sizeof USES / sizeof *USES; i++)
        jox_changes_add_use(&c, (uint32_t)(USES[i][0][0] - '0'), USES[i][1]);
    jox_changes_add_use(&c, JOX_PART_SCENE, "scene");
    return c;
}

static void only_parts_connected_by_changed_files_load_together(void **state) {
    (void)state;
    JoxChanges c = make_four_parts();
    assert_string_equal(try_next(&c), "");
    jox_changes_add_changed_file(&c, "a", 1.0);
    assert_string_equal(try_next(&c), "0"); /* lib has not changed */
    make_live(&c, "0");
    jox_changes_add_use(&c, 0, "a");
    jox_changes_add_use(&c, 0, "lib");
    jox_changes_add_changed_file(&c, "lib", 2.0);
    assert_string_equal(try_next(&c), "01");
    assert_string_equal(try_next(&c), ""); /* tried */
    jox_changes_add_changed_file(&c, "more", 3.0);
    assert_string_equal(try_next(&c), "012"); /* 0 and 1 are not live yet */
    jox_changes_add_changed_file(&c, "d", 4.0);
    jox_changes_add_changed_file(&c, "scene", 4.0);
    assert_true(jox_changes_has_untried(&c));
    assert_string_equal(try_next(&c), "3");
    assert_string_equal(try_next(&c), "p");
    assert_string_equal(try_next(&c), "");
    assert_false(jox_changes_has_untried(&c));
    jox_changes_free(&c);
}

static void live_parts_are_not_tried_again(void **state) {
    (void)state;
    JoxChanges c = make_four_parts();
    jox_changes_add_changed_file(&c, "lib", 1.0);
    jox_changes_add_changed_file(&c, "a", 1.0);
    assert_string_equal(try_next(&c), "01");
    jox_changes_add_changed_file(&c, "a", 2.0); /* saved again while it is being loaded */
    make_live(&c, "01");
    jox_changes_add_use(&c, 0, "a");
    jox_changes_add_use(&c, 1, "b");
    jox_changes_add_use(&c, 1, "lib");
    assert_string_equal(try_next(&c), "0"); /* it no longer uses lib */
    make_live(&c, "0");
    jox_changes_add_changed_file(&c, "b", 3.0);
    assert_string_equal(try_next(&c), "1");
    jox_changes_add_changed_file(&c, "nobody", 3.0);
    assert_string_equal(try_next(&c), "");
    assert_false(jox_changes_has_untried(&c));
    jox_changes_free(&c);
}

static void time_of_writing_is_that_of_the_last_file(void **state) {
    (void)state;
    JoxChanges c = make_four_parts();
    bool parts[JOX_PARTS];
    double written;
    jox_changes_add_changed_file(&c, "b", 7.0);
    jox_changes_add_changed_file(&c, "lib", 5.0);
    jox_changes_add_changed_file(&c, "d", 9.0);
    assert_true(jox_changes_take_next(&c, parts, &written));
    assert_true(parts[0] && parts[1] && !parts[3] && written == 7.0);
    jox_changes_free(&c);
}

/* ---- the watch ---- */

static char seen[400];

static void list_change(void *context, const char *path, double written) {
    (void)context;
    assert_true(written > 1e9);
    snprintf(seen + strlen(seen), sizeof seen - strlen(seen), "%s ",
             path + strlen(test_folder) + 1);
}

/* Waits up to 0.4 s for changes. Returns the changed paths. */
static const char *wait_for_change(JoxWatch *watch) {
    seen[0] = 0;
    for (int i = 0; i < 40 && !seen[0]; i++)
        jox_watch_wait(watch, -1, 0.01, list_change, NULL);
    return seen;
}

static void watch_follows_files_and_folders_that_come_and_go(void **state) {
    (void)state;
    JoxWatch *watch = jox_watch_create();
    write_test_file("here", "1");
    assert_true(jox_watch_add(watch, test_path("here")));
    assert_true(jox_watch_add(watch, test_path("missing")));
    assert_true(jox_watch_add(watch, test_path("deep/er/file")));
    assert_string_equal(wait_for_change(watch), "");
    write_test_file("here", "1");
    assert_string_equal(wait_for_change(watch), ""); /* unchanged content */
    write_test_file("here", "2");
    assert_string_equal(wait_for_change(watch), "here ");
    write_test_file("missing", "1");
    assert_string_equal(wait_for_change(watch), "missing ");
    unlink(test_path("here"));
    assert_string_equal(wait_for_change(watch), "");
    write_test_file("other", "3");
    rename(test_path("other"), test_path("here"));
    assert_string_equal(wait_for_change(watch), "here ");
    for (int i = 0; i < 3; i++) { /* folders are made, removed, made again, replaced */
        char text[2] = {(char)('0' + i), 0};
        mkdir(test_path("deep"), 0755);
        if (i == 0)
            usleep(20000);
        mkdir(test_path("deep/er"), 0755);
        write_test_file("deep/er/file", text);
        assert_string_equal(wait_for_change(watch), "deep/er/file ");
        write_test_file("deep/er/file", "x");
        assert_string_equal(wait_for_change(watch), "deep/er/file ");
        if (i == 0) {
            rename(test_path("deep/er"), test_path("away"));
            mkdir(test_path("deep/er"), 0755);
            write_test_file("deep/er/file", "y");
            assert_string_equal(wait_for_change(watch), "deep/er/file ");
            write_test_file("away/file", "z");
            assert_string_equal(wait_for_change(watch), "");
        }
        unlink(test_path("deep/er/file"));
        rmdir(test_path("deep/er"));
        rmdir(test_path("deep"));
        assert_string_equal(wait_for_change(watch), "");
    }
    jox_watch_free(watch);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_parts_connected_by_changed_files_load_together),
        cmocka_unit_test(live_parts_are_not_tried_again),
        cmocka_unit_test(time_of_writing_is_that_of_the_last_file),
        cmocka_unit_test(watch_follows_files_and_folders_that_come_and_go),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
