/* What hangs together by changed files; folders and files that come and go under a watch. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/mem.h"
#include "run/watch/changes.h"
#include "run/watch/watch.h"

/* "02" for parts 0 and 2, and "p" for the plan: the next to try; "" for none. */
static const char *next(JoxChanges *c) {
    static char text[JOX_PARTS + 1];
    bool parts[JOX_PARTS] = {false};
    double written;
    size_t n = 0;
    if (jox_changes_next(c, parts, &written))
        for (uint32_t p = 0; p < JOX_PARTS; p++)
            if (parts[p])
                text[n++] = p == JOX_PART_SCENE ? 'p' : (char)('0' + p);
    text[n] = 0;
    return text;
}

static void live(JoxChanges *c, const char *which) {
    bool parts[JOX_PARTS] = {false};
    for (; *which; which++)
        parts[*which == 'p' ? JOX_PART_SCENE : *which - '0'] = true;
    jox_changes_live(c, parts);
}

/* Parts 0 and 1 share lib, 1 and 2 share more; 3 stands alone. */
static JoxChanges four(void) {
    static const char *const USES[][2] = {{"0", "a"},    {"0", "lib"}, {"1", "b"},    {"1", "lib"},
                                          {"1", "more"}, {"2", "c"},   {"2", "more"}, {"3", "d"}};
    JoxChanges c = {0};
    for (size_t i = 0; i < sizeof USES / sizeof *USES; i++)
        jox_changes_uses(&c, (uint32_t)(USES[i][0][0] - '0'), USES[i][1]);
    jox_changes_uses(&c, JOX_PART_SCENE, "scene");
    return c;
}

static void only_what_changed_together_goes_together(void **state) {
    (void)state;
    JoxChanges c = four();
    assert_string_equal(next(&c), "");
    jox_changes_file(&c, "a", 1.0);
    assert_string_equal(next(&c), "0"); /* lib has not changed */
    live(&c, "0");
    jox_changes_uses(&c, 0, "a");
    jox_changes_uses(&c, 0, "lib");
    jox_changes_file(&c, "lib", 2.0);
    assert_string_equal(next(&c), "01");
    assert_string_equal(next(&c), ""); /* tried */
    jox_changes_file(&c, "more", 3.0);
    assert_string_equal(next(&c), "012"); /* 0 and 1 are not live yet */
    jox_changes_file(&c, "d", 4.0);
    jox_changes_file(&c, "scene", 4.0);
    assert_true(jox_changes_fresh(&c));
    assert_string_equal(next(&c), "3");
    assert_string_equal(next(&c), "p");
    assert_string_equal(next(&c), "");
    assert_false(jox_changes_fresh(&c));
    jox_changes_free(&c);
}

static void what_is_live_is_settled(void **state) {
    (void)state;
    JoxChanges c = four();
    jox_changes_file(&c, "lib", 1.0);
    jox_changes_file(&c, "a", 1.0);
    assert_string_equal(next(&c), "01");
    jox_changes_file(&c, "a", 2.0); /* saved once more while it is being loaded */
    live(&c, "01");
    jox_changes_uses(&c, 0, "a");
    jox_changes_uses(&c, 1, "b");
    jox_changes_uses(&c, 1, "lib");
    assert_string_equal(next(&c), "0"); /* no longer made of lib */
    live(&c, "0");
    jox_changes_file(&c, "b", 3.0);
    assert_string_equal(next(&c), "1");
    jox_changes_file(&c, "nobody", 3.0);
    assert_string_equal(next(&c), "");
    assert_false(jox_changes_fresh(&c));
    jox_changes_free(&c);
}

static void when_it_was_written_is_the_last_of_all(void **state) {
    (void)state;
    JoxChanges c = four();
    bool parts[JOX_PARTS];
    double written;
    jox_changes_file(&c, "b", 7.0);
    jox_changes_file(&c, "lib", 5.0);
    jox_changes_file(&c, "d", 9.0);
    assert_true(jox_changes_next(&c, parts, &written));
    assert_true(parts[0] && parts[1] && !parts[3] && written == 7.0);
    jox_changes_free(&c);
}

/* ---- the watch ---- */

static char folder[] = "/tmp/jostle-watch-XXXXXX";
static char seen[400];

static void changed(void *context, const char *path, double written) {
    (void)context;
    assert_true(written > 1e9);
    snprintf(seen + strlen(seen), sizeof seen - strlen(seen), "%s ", path + strlen(folder) + 1);
}

/* What the watch has to say within some time. */
static const char *look(JoxWatch *watch) {
    seen[0] = 0;
    for (int i = 0; i < 40 && !seen[0]; i++)
        jox_watch_wait(watch, -1, 0.01, changed, NULL);
    return seen;
}

static const char *at(const char *name) {
    static char path[2][200];
    static int turn;
    turn ^= 1;
    snprintf(path[turn], sizeof *path, "%s/%s", folder, name);
    return path[turn];
}

static void save(const char *name, const char *text) {
    FILE *file = fopen(at(name), "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void files_and_folders_come_and_go(void **state) {
    (void)state;
    assert_non_null(mkdtemp(folder));
    JoxWatch *watch = jox_watch_create();
    save("here", "1");
    assert_true(jox_watch_add(watch, at("here")));
    assert_true(jox_watch_add(watch, at("missing")));
    assert_true(jox_watch_add(watch, at("deep/er/file")));
    assert_string_equal(look(watch), "");
    save("here", "1");
    assert_string_equal(look(watch), ""); /* the same */
    save("here", "2");
    assert_string_equal(look(watch), "here ");
    save("missing", "1");
    assert_string_equal(look(watch), "missing ");
    unlink(at("here"));
    assert_string_equal(look(watch), "");
    save("other", "3");
    rename(at("other"), at("here"));
    assert_string_equal(look(watch), "here ");
    for (int i = 0; i < 3; i++) { /* made, removed and made again, or replaced by another */
        char text[2] = {(char)('0' + i), 0};
        mkdir(at("deep"), 0755);
        if (i == 0)
            usleep(20000);
        mkdir(at("deep/er"), 0755);
        save("deep/er/file", text);
        assert_string_equal(look(watch), "deep/er/file ");
        save("deep/er/file", "x");
        assert_string_equal(look(watch), "deep/er/file ");
        if (i == 0) {
            rename(at("deep/er"), at("away"));
            mkdir(at("deep/er"), 0755);
            save("deep/er/file", "y");
            assert_string_equal(look(watch), "deep/er/file ");
            save("away/file", "z");
            assert_string_equal(look(watch), "");
        }
        unlink(at("deep/er/file"));
        rmdir(at("deep/er"));
        rmdir(at("deep"));
        assert_string_equal(look(watch), "");
    }
    jox_watch_free(watch);
    unlink(at("away/file"));
    rmdir(at("away"));
    unlink(at("here"));
    unlink(at("missing"));
    assert_int_equal(rmdir(folder), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_what_changed_together_goes_together),
        cmocka_unit_test(what_is_live_is_settled),
        cmocka_unit_test(when_it_was_written_is_the_last_of_all),
        cmocka_unit_test(files_and_folders_come_and_go),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
