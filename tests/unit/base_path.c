/* Paths: their parts, files that a file names, and files outside a folder. */
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

#include "base/format/installed.h"
#include "base/format/mod.h"
#include "base/format/path.h"
#include "jostle.h"

static char root[64];

static const char *make_tree_path(const char *name) {
    static char path[256];
    snprintf(path, sizeof path, "%s/%s", root, name);
    return path;
}

static void make_empty_file(const char *name) {
    FILE *file = fopen(make_tree_path(name), "w");
    assert_non_null(file);
    assert_int_equal(fclose(file), 0);
}

static int make_tree(void **state) {
    (void)state;
    strcpy(root, "/tmp/jostle-path-XXXXXX");
    assert_non_null(mkdtemp(root));
    static const char *const FOLDERS[] = {"scenes", "behaviours", "m", "m/behaviours"};
    for (size_t f = 0; f < sizeof FOLDERS / sizeof *FOLDERS; f++)
        assert_int_equal(mkdir(make_tree_path(FOLDERS[f]), 0700), 0);
    make_empty_file("scenes/a.yaml");
    make_empty_file("scenes/near.lua");
    make_empty_file("behaviours/near.lua");
    make_empty_file("behaviours/far.lua");
    make_empty_file("m/behaviours/own.lua");
    char link[256];
    snprintf(link, sizeof link, "%s", make_tree_path("scenes/out"));
    return symlink("/etc/passwd", link);
}

static int remove_tree(void **state) {
    (void)state;
    static const char *const FILES[] = {"scenes/out",         "scenes/a.yaml",
                                        "scenes/near.lua",    "behaviours/near.lua",
                                        "behaviours/far.lua", "m/behaviours/own.lua"};
    static const char *const FOLDERS[] = {"m/behaviours", "m", "behaviours", "scenes", ""};
    for (size_t f = 0; f < sizeof FILES / sizeof *FILES; f++)
        unlink(make_tree_path(FILES[f]));
    for (size_t f = 0; f < sizeof FOLDERS / sizeof *FOLDERS; f++)
        rmdir(make_tree_path(FOLDERS[f]));
    return 0;
}

static void parts_of_a_path(void **state) {
    (void)state;
    assert_int_equal(jox_path_folder("a/b/c.d.e"), 4);
    assert_int_equal(jox_path_folder("c"), 0);
    assert_string_equal(jox_path_name("a/b/c.d.e"), "c.d.e");
    assert_string_equal(jox_path_name("a/"), "");
    assert_int_equal(jox_path_stem("c.d.e"), 1);
}

static void names_are_relative_to_the_file(void **state) {
    (void)state;
    char path[JOX_LONGEST_PATH], longer[JOX_LONGEST_PATH];
    assert_true(jox_path_beside("s/a.yaml", "b.lua", path));
    assert_string_equal(path, "s/b.lua");
    assert_true(jox_path_beside("a.yaml", "b.lua", path));
    assert_string_equal(path, "b.lua");
    assert_true(jox_path_beside("s/a.yaml", "/b.lua", path));
    assert_string_equal(path, "/b.lua");
    memset(longer, 'x', sizeof longer - 1);
    longer[sizeof longer - 1] = 0;
    assert_false(jox_path_beside("s/a.yaml", longer, path));
}

static void folders_are_searched_in_order(void **state) {
    (void)state;
    static const char *const FOLDERS[] = {"", "../behaviours/", NULL};
    char path[JOX_LONGEST_PATH], scene[256];
    snprintf(scene, sizeof scene, "%s", make_tree_path("scenes/a.yaml"));
    assert_true(jox_path_find(scene, "near", ".lua", FOLDERS, path));
    assert_string_equal(path, make_tree_path("scenes/near.lua"));
    assert_true(jox_path_find(scene, "far.lua", ".lua", FOLDERS, path));
    jox_path_clean(path);
    assert_string_equal(path, make_tree_path("behaviours/far.lua"));
    assert_false(jox_path_find(scene, "none", ".lua", FOLDERS, path));
    assert_false(jox_path_find(scene, "a", ".lua", FOLDERS, path));
}

static void behaviours_of_mods(void **state) {
    (void)state;
    char path[JOX_LONGEST_PATH], folder[256];
    snprintf(folder, sizeof folder, "%s", make_tree_path("m"));
    const JoxMod mods[] = {{.name = (char *)"other", .folder = root},
                           {.name = (char *)"m", .folder = folder}};
    assert_true(jox_mod_find(mods, 2, "m:own", path));
    assert_string_equal(path, make_tree_path("m/behaviours/own.lua"));
    static const char *const NONE[] = {"own",     "other:own", "m:../../behaviours/far",
                                       "m:gone",  "n:own",     "m:/etc/passwd",
                                       "m:own.c", "m:"};
    for (size_t n = 0; n < sizeof NONE / sizeof *NONE; n++)
        if (jox_mod_find(mods, 2, NONE[n], path))
            fail_msg("found: %s", NONE[n]);
}

static void links_out_of_the_folder_are_foreign(void **state) {
    (void)state;
    char folder[256], inside[300];
    snprintf(folder, sizeof folder, "%s", make_tree_path("scenes"));
    assert_true(jox_path_below(make_tree_path("scenes/a.yaml"), folder));
    assert_false(jox_path_below(make_tree_path("scenes/out"), folder));
    assert_false(jox_path_below(make_tree_path("scenes/../behaviours/far.lua"), folder));
    assert_false(jox_path_below(folder, folder));
    assert_false(jox_path_below(make_tree_path("scenes/none"), folder));
    snprintf(inside, sizeof inside, "%s/../scenes/a.yaml", folder);
    char *real = jox_path_real_below(inside, folder);
    assert_non_null(real);
    assert_string_equal(real, make_tree_path("scenes/a.yaml"));
    free(real);
}

static void installed_files_are_where_the_build_says(void **state) {
    (void)state;
    assert_string_equal(jo_data_folder(), JOX_DATADIR);
    assert_string_equal(jox_page_folder(), JOX_PAGEDIR);
    assert_ptr_equal(jo_data_folder(), jox_data_folder());
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(parts_of_a_path),
                                       cmocka_unit_test(names_are_relative_to_the_file),
                                       cmocka_unit_test(folders_are_searched_in_order),
                                       cmocka_unit_test(behaviours_of_mods),
                                       cmocka_unit_test(links_out_of_the_folder_are_foreign),
                                       cmocka_unit_test(installed_files_are_where_the_build_says)};
    return cmocka_run_group_tests(tests, make_tree, remove_tree);
}
