/* A temporary folder for the files of one test program: made by the setup of its group of tests in
   the folder that TMPDIR names, else in /tmp, removed by the teardown with all that the tests left
   in it. */
#ifndef JOX_TESTS_TEST_FOLDER_H
#define JOX_TESTS_TEST_FOLDER_H

#include <errno.h>
#include <ftw.h>
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

static char test_folder[64];

/* Path of a file in the folder; it holds until the 16th call after this. */
static inline const char *test_path(const char *name) {
    static char paths[16][320];
    static int turn;
    char *path = paths[turn++ % 16];
    snprintf(path, sizeof *paths, "%s/%s", test_folder, name);
    return path;
}

/* Writes a file in the folder, and makes the folders that its name has before a slash. */
static inline const char *write_test_file(const char *name, const char *text) {
    for (const char *slash = strchr(name, '/'); slash; slash = strchr(slash + 1, '/')) {
        char outer[256];
        snprintf(outer, sizeof outer, "%.*s", (int)(slash - name), name);
        mkdir(test_path(outer), 0700);
    }
    const char *path = test_path(name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
    return path;
}

static inline int make_test_folder(void **state) {
    (void)state;
    const char *outer = getenv("TMPDIR");
    snprintf(test_folder, sizeof test_folder, "%s/jostle-test-XXXXXX",
             outer && *outer == '/' && strlen(outer) <= 40 ? outer : "/tmp");
    if (mkdtemp(test_folder))
        return 0;
    print_error("cannot make %s: %s\n", test_folder, strerror(errno));
    return -1;
}

static inline int remove_found_file(const char *path, const struct stat *info, int kind,
                                    struct FTW *place) {
    (void)info;
    (void)kind;
    (void)place;
    return remove(path);
}

static inline int remove_test_folder(void **state) {
    (void)state;
    if (nftw(test_folder, remove_found_file, 16, FTW_DEPTH | FTW_PHYS) == 0)
        return 0;
    print_error("cannot remove %s, or it was removed before: %s\n", test_folder, strerror(errno));
    return -1;
}

#endif
