/* The part of cmocka's interface that tests/unit/simd_lanes.c uses, for tests/wasm/run.sh: Debian
   has no cmocka for WebAssembly. */
#ifndef TESTS_WASM_CMOCKA_H
#define TESTS_WASM_CMOCKA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

static int cmocka_failures;

static inline void cmocka_expect(bool holds, const char *text, const char *file, int line) {
    if (!holds && ++cmocka_failures <= 10)
        printf("%s:%d: %s\n", file, line, text);
}

#define assert_true(condition) cmocka_expect((condition), #condition, __FILE__, __LINE__)
#define assert_int_equal(a, b)                                                                     \
    cmocka_expect((long long)(a) == (long long)(b), #a " == " #b, __FILE__, __LINE__)
#define assert_memory_equal(a, b, size)                                                            \
    cmocka_expect(memcmp((a), (b), (size)) == 0, #a " == " #b, __FILE__, __LINE__)
#define cmocka_unit_test(test)                                                                     \
    { #test, test }
#define cmocka_run_group_tests(tests, begin, end)                                                  \
    cmocka_run_tests((tests), sizeof(tests) / sizeof *(tests))

struct CMUnitTest {
    const char *name;
    void (*run)(void **state);
};

static int cmocka_run_tests(const struct CMUnitTest *tests, size_t count) {
    for (size_t t = 0; t < count; t++) {
        const int before = cmocka_failures;
        tests[t].run(NULL);
        printf("%s %s\n", cmocka_failures == before ? "ok" : "not ok", tests[t].name);
    }
    return cmocka_failures;
}

#endif
